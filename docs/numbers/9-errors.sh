# Chapter 9: the errors that demo 9 prints, and by how much 64 of Sobol's samples are better.
build/demo09 80 60 --no-window --samples 1 --out build/numbers/9.png | awk '
    /^error/ { print "```"; on = 1 }
    /^demo09/ { exit }
    on
    $1 == 64 { random = $NF }
    END { print "```"; print "random64: " random; printf "times64: %.2f\n", random / 64 }'

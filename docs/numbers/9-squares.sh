# Chapter 9: the points that demo 9 prints first, and the errors that it prints next.
build/demo09 80 60 --no-window --samples 1 --out build/numbers/9.png |
    awk '/^error/ { exit } NR > 1' | sed -e '1i ```' -e '$a ```'

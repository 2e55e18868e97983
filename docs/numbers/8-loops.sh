# Chapter 8: the table that demo 8 prints first, on two threads, and times from it.
build/demo08 --no-window --samples 1 --threads 2 --out build/numbers/8.png | awk '
    /^demo08/ { exit }
    NR == 1 { print "```" }
    { print }
    function say(key, one, all) { keys = keys key "-one: " one "\n" key "-two: " all "\n" key "-speed: " $(NF - 1) "\n" }
    /^without/ { say("plain", $(NF - 5), $(NF - 3)); plain = $(NF - 3) }
    /^pragma/ { say("inner", $(NF - 5), $(NF - 3)) }
    /^one gen/ { say("rand", $(NF - 5), $(NF - 3)) }
    /^one var/ { say("variable", $(NF - 5), $(NF - 3)) }
    /^right/ { say("right", $(NF - 5), $(NF - 3)); gain = $(NF - 5) / $(NF - 3); right = $(NF - 1) }
    /^packets/ { say("packets", $(NF - 5), $(NF - 3)); printf "```\n%sgain: %.2f\nagain: %.0f\n", keys, gain, $(NF - 1) / right }'

# Chapter 7: the report's flags and ours, 160 x 120 on two threads, except in two rows of
# the table. Slow: it compiles four times.
seconds() { # CFLAGS OPENMP ARGS...
    make -s "BUILD=build/numbers/flags" build/numbers/flags/demo07 \
        "CFLAGS=$1" "OPENMP=$2" >/dev/null || exit
    shift 2
    for run in 1 2 3; do
        build/numbers/flags/demo07 160 120 --no-window --out build/numbers/7.png "$@" |
            sed -n 's/^demo07: \([0-9.]*\) s,.*/\1/p'
    done | sort -n | head -1
    rm -rf build/numbers/flags
}
openmp=$(.ci/deps openmp "${CC:-cc}") flags="-O3 -fno-math-errno"
printf '%s\n' "$(seconds -O0 "")" "$(seconds -O0 "$openmp")" "$(seconds "$flags" "")" \
    "$(seconds "$flags" "$openmp")" | awk '
    { time[NR] = $1 }
    END {
        what[1] = "`-O0`, no OpenMP: the report'\''s line | 1"
        what[2] = "`-O0 -fopenmp` | 2"
        what[3] = "our flags, no OpenMP | 1"
        what[4] = "our flags, with OpenMP | 2"
        print "| compiled with | threads | time |\n|---|---|---|"
        for (i = 1; i <= 4; i++) printf "| %s | %.1f |\n", what[i], time[i] / time[4]
        printf "times: %.0f\nthreads: %.1f\n", time[1] / time[4], time[3] / time[4]
    }'

# Chapter 18: what parts, joining them, and messages cost; then what 1000 machines would take.
# Slow: it renders the same picture some forty times.
make -s build/demo18 >/dev/null || exit
folder=build/numbers/18
mkdir -p $folder
fastest() { # COMMAND: seconds, the least of three
    for run in 1 2 3; do
        rm -f $folder/*.part
        start=$(date +%s%N)
        eval "$1" >/dev/null 2>&1 || exit
        echo $((($(date +%s%N) - start) / 1000)) # in millionths
    done | sort -n | awk 'NR == 1 { printf "%.4f\n", $1 / 1e6 }'
}
options="--samples 64 --threads 1 --quiet --out $folder/a.png"
[ "$(id -u)" != 0 ] || export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1
whole=$(fastest "build/demo08 $options --no-window")
parts=$(fastest "for k in \$(seq 60); do build/demo08 $options --part \$k/60; done")
two=$(fastest "seq 60 | xargs -P 2 -I@ build/demo08 $options --part @/60")
mkdir -p $folder/join && for k in $(seq 60); do # where the parts stay
    build/demo08 $options --part $k/60 --out $folder/join/a.png || exit
done
again=$(fastest "for k in \$(seq 60); do build/demo08 $options --part \$k/60 --out $folder/join/a.png; done")
join=$(fastest "build/demo08 $options --join 60 --out $folder/join/a.png")
few="--samples 1 --threads 1 --quiet" # and many parts, to see what one more costs
for n in 60 600; do
    for k in $(seq $n); do build/demo08 $few --part $k/$n --out $folder/join/b.png || exit; done
    eval "join$n=\$(fastest 'for i in 1 2 3 4 5 6 7 8 9 10; do build/demo08 $few --join $n --out $folder/join/b.png; done')"
done
for n in 1 2 4; do eval "mpi$n=\$(fastest 'mpirun -np $n build/demo18 $options --no-window')"; done
part() { # PIXELS NAME: the demo with parts of so many pixels
    sed "s/PART = 1024/PART = $1/" demos/demo18_many_machines.c >$folder/$2.c
    $(make -s -n -B build/demo18 | grep -- '-o build/demo18 ' | sed "s,demos/demo18_many_machines.c,-Idemos $folder/$2.c,; s,-o build/demo18,-o $folder/$2,") || exit
}
part 1 one && part 1000000 all
for name in one all; do eval "mpi$name=\$(fastest 'mpirun -np 2 $folder/$name $options --no-window')"; done
awk -v whole="$whole" -v parts="$parts" -v two="$two" -v again="$again" -v join="$join" -v join60="$join60" -v join600="$join600" -v mpi1="$mpi1" \
    -v mpi2="$mpi2" -v mpi4="$mpi4" -v mpione="$mpione" -v mpiall="$mpiall" 'BEGIN {
    print "| 640×480, 64 samples, one thread in each process | seconds |\n|---|---|"
    printf "| one process | %.2f |\n| 60 parts, one after the other | %.2f |\n", whole, parts
    printf "| 60 parts, two at a time | %.2f |\n| 60 parts that are there already | %.2f |\n| to join them | %.2f |\n", two, again, join
    printf "| MPI, 1 process | %.2f |\n| MPI, 2 processes | %.2f |\n| MPI, 4 processes | %.2f |\n", mpi1, mpi2, mpi4
    printf "one: %.2f\nall: %.2f\ntwo: %.2f\n", mpione, mpiall, mpi2
    c = (parts - whole) / 59; printf "model: %.2f\nmeasured: %.2f\n", (whole + 60 * c) / 2 + whole / 60, two
    j = (join600 - join60) / 5400; J = join - 60 * j
    printf "part-ms: %.0f\njoin-ms: %.3f\n", 1000 * c, 1000 * j
    N = 1000; T = 36000; p = int(sqrt(T / (c / N + j)))
    t = T / N + T / p + p * (c / N + j) + J
    printf "best: %.0f\nhours: %.0f\ntime: %.0f\nuse: %.0f\n", p, T / 3600, t, 100 * T / N / t
    T = 60; p = int(sqrt(T / (c / N + j))); t = T / N + T / p + p * (c / N + j) + J
    printf "minute-best: %.0f\nminute-time: %.2f\nminute-use: %.0f\n", p, t, 100 * T / N / t
}'

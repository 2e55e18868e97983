#!/bin/sh
# Chapter 18 by MPI, for "tests/check machines": the bits of one machine from any number, what is left
# after Ctrl-C, and after the death of one. The programs are in build/, the files go to the folder $1.
set -e
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 OMPI_MCA_rmaps_base_oversubscribe=1
folder=$1 log=$1/log.txt
trap 'status=$?; [ $status = 0 ] || cat "$log"' EXIT
fail() { echo "$*"; exit 1; }
parts() { ls "$folder" | grep -c '\.part$'; }
until_there() { # COMMAND: for 20 seconds at most
    for i in $(seq 400); do ! eval "$1" || return 0; sleep 0.05; done
    fail "not after 20 s: $1"
}

build/demo08 161 121 --samples 4 --no-window --quiet --out "$folder/one.pfm"
for count in 1 2 3; do
    [ $count = 3 ] || mpirun -np $count build/tests/machines >"$log" 2>&1
    mpirun -np $count build/demo18 161 121 --samples 4 --threads 1 --no-window --out "$folder/mpi.pfm" >"$log" 2>&1
    cmp "$folder/one.pfm" "$folder/mpi.pfm"
done

# Two machines with a network between them: the counter's machine must answer while it renders.
tests/lab mpirun --hostfile lab "$PWD/build/tests/machines" >"$log" 2>&1
if grep -q '^note:' "$log"; then cat "$log"; else
    grep -q 'machine 1 renders' "$log"
    tests/lab mpirun --hostfile lab "$PWD/build/demo18" 161 121 --samples 1500 --threads 1 --part all/30 >"$log" 2>&1
    mine=$(grep -c 'wrote demo18-part' "$log")
    [ "$mine" -ge 3 ] && [ "$mine" -le 27 ] || fail "of 30 parts machine 0 rendered $mine"
fi

# While machine 0 works alone, the other sleeps.
seconds() { # that each of the two has worked, the lazy one first
    echo $(ps -A -o ppid=,comm=,cputimes= | awk -v mpirun="$run" '$1 == mpirun && $2 == "demo18" { print $3 }' | sort -n)
}
mpirun -np 2 build/demo18 --time 60 --threads 1 --no-window --out "$folder/some.png" >"$log" 2>&1 &
run=$!
until_there 'case "$(seconds)" in *" "[3-9]) true ;; *) false ;; esac'
worked=$(seconds)
kill -TERM $run
! wait $run || fail "an interrupted run succeeds"
[ "${worked% *}" = 0 ] || fail "seconds of work of each: $worked"

# Ctrl-C, which mpirun takes as it takes this signal: a picture of what there is.
mpirun -np 2 build/demo18 --samples 100000 --threads 1 --no-window --out "$folder/some.png" >"$log" 2>&1 &
until_there 'grep -q bounces "$log"'
sleep 0.5
kill -TERM $!
! wait $! || fail "an interrupted run succeeds"
grep -q 'wrote .*some.png (interrupted at ' "$log"
[ -s "$folder/some.png" ]

# The death of one: only the parts that were begun are lost.
all="161 121 --samples 1500 --threads 1 --out $folder/all.pfm"
mpirun -np 2 build/demo18 $all --part all/30 >"$log" 2>&1 &
until_there '[ $(parts) -ge 4 ]'
kill -KILL $(ps -A -o pid=,ppid=,comm= | awk -v mpirun=$! '$2 == mpirun && $3 == "demo18" { print $1; exit }')
! wait $! || fail "a run with a dead process succeeds"
there=$(parts)
mpirun -np 2 build/demo18 $all --part all/30 >"$log" 2>&1
[ "$there" -ge 4 ] && [ "$there" -lt 30 ] && [ "$(parts)" = 30 ]
build/demo18 $all --join 30 >"$log" 2>&1
build/demo08 161 121 --samples 1500 --no-window --quiet --out "$folder/one.pfm"
cmp "$folder/one.pfm" "$folder/all.pfm"

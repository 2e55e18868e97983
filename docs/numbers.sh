#!/bin/sh
# The numbers that the chapters quote: runs docs/numbers/*.c and *.sh, each of which prints a
# table, or lines "key: value", or both, into build/numbers/NAME.txt; and docs/changed.sh for
# each chapter. docs/renew.sh puts what they print into the text.
#   docs/numbers.sh            all of them
#   docs/numbers.sh --times    and record new times, on an idle machine
# Times differ from run to run: what docs/numbers/NAME.txt has recorded stays, as long as
# today's run differs from it only in its digits (for the slow ones it always stays).
cc=${CC:-cc} out=${BUILD:-build}/numbers
flags="-std=c99 -O2 -fno-math-errno -ffp-contract=off $(.ci/deps openmp "$cc")"
mkdir -p "$out" || exit 1
export OMP_WAIT_POLICY=passive
MAKEFLAGS= make -s build/demo07 build/demo08 build/demo09 || exit 1 # *.sh run these

# rt.h is compiled once for all of them, except for those that replace something in it.
$cc $flags -w -I. -DRT_IMPLEMENTATION -c -o "$out/rt.o" -x c rt.h || exit 1
linked() { grep -q '^#define rt_' "$1" || echo "-DRT_IMPLEMENTED $out/rt.o"; }

masked() { sed -e 's/[0-9][0-9.]*/N/g' -e 's/  */ /g' "$1"; }

for file in docs/numbers/*.c docs/numbers/*.sh; do
    name=$(basename "${file%.*}")
    record=docs/numbers/$name.txt
    if [ "$1" != --times ] && grep -q 'Slow: ' "$file"; then cp "$record" "$out"; continue; fi
    case $file in
    *.c) $cc $flags -w -I. -o "$out/$name" "$file" $(linked "$file") -lm && "$out/$name" ;;
    *) sh "$file" ;;
    esac >"$out/$name.txt" 2>"$out/errors" && [ -s "$out/$name.txt" ] ||
        { cat "$out/errors" >&2; echo "$file failed" >&2; exit 1; }
    [ -e "$record" ] || continue
    if [ "$1" = --times ]; then cp "$out/$name.txt" "$record"; continue; fi
    masked "$record" >"$out/was" && masked "$out/$name.txt" | diff "$out/was" - ||
        { echo "$record is stale: docs/numbers.sh --times" >&2; exit 1; }
    cp "$record" "$out"
done
for chapter in 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17; do
    docs/changed.sh $chapter "$out/scenes.txt" >"$out/$chapter-changed.txt" || exit 1
done

#!/bin/sh
# The pictures of the chapters that no demo makes: docs/pictures/NAME.c renders
# docs/images/NAME.png, with the options that its first comment names.
#   docs/pictures.sh            render them
#   docs/pictures.sh --check    fail if one of them is not what this would make
cc=${CC:-cc} build=${BUILD:-build}
work=$(mktemp -d "$build/pictures.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
export OMP_WAIT_POLICY=passive
libs="$(pkg-config --libs sdl2 $(pkg-config --exists SDL2_ttf && echo SDL2_ttf)) $(pkg-config --libs assimp 2>/dev/null) -lm"
for file in docs/pictures/*.c; do
    name=$(basename "$file" .c)
    $cc -std=c99 -O2 -fno-math-errno -ffp-contract=off -w -I. $(.ci/deps openmp "$cc") -o "$work/$name" \
        "$file" "$build/program.a" $libs &&
        "$work/$name" $(sed -n 's/^ \* Options: \(.*\) \*\/$/\1/p' "$file") --no-window --quiet \
            --out "$work/$name.png" || exit 1
    picture=docs/images/$name.png
    if [ "$1" = --check ]; then
        cmp -s "$work/$name.png" "$picture" || { echo "$picture is stale: docs/pictures.sh"; exit 1; }
    else
        cp "$work/$name.png" "$picture" || exit 1
    fi
done

#!/bin/sh
# The live pictures of the chapters: docs/live/build.sh FOLDER puts there what their pages need. Each
# demo becomes a script with its WebAssembly module in base64, so that file:// works, too. To be run
# at the top of the repository. Exit status 3, with one line, where a tool is missing.
[ $# = 1 ] || { sed -n '2,4s/^# //p' "$0" >&2; exit 2; }
folder=$1 build=${BUILD:-build}/web
.ci/deps wasm || {
    echo "note: no compiler for WebAssembly (make deps-web): no live pictures"
    exit 3
}
mkdir -p "$folder" "$build" || exit
# Two steps and no -O for the linker: else it would ask an optimiser that knows no SIMD.
compile() { # SOURCE OBJECT
    [ "$2" -nt "$1" ] && [ -z "$(find rt.h demos -name '*.h' -newer "$2")" ] ||
        clang --target=wasm32-wasi -std=c11 -O3 -fno-math-errno -ffp-contract=off -msimd128 \
            -Wall -Wextra -Wpedantic -Werror -c -o "$2" "$1"
}
compile demos/viewer.c "$build/viewer.o" && compile demos/page.c "$build/page.o" || exit
for source in demos/demo[01]*.c; do
    demo=$(basename "$source" | sed 's/_.*//')
    [ -e "docs/images/$demo.png" ] || continue # chapter 18 has no picture of its own
    compile "$source" "$build/$demo.o" &&
        clang --target=wasm32-wasi -mexec-model=reactor -Wl,--strip-all -o "$build/$demo.wasm" \
            "$build/$demo.o" "$build/viewer.o" "$build/page.o" || exit
    printf '(window.rt_live ??= {}).%s = "%s";\n' "$demo" "$(base64 <"$build/$demo.wasm" | tr -d '\n')" \
        >"$folder/$demo.js" || exit
done
{
    echo "'use strict'; (() => {"
    cat docs/live/work.js docs/live/words.js docs/live/charts.js docs/live/live.js
    echo "})();"
} >"$folder/live.js"
cp docs/live/live.css "$folder"

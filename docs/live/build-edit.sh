#!/bin/sh
# All that "write it yourself" needs in the pages of the site: docs/live/build-edit.sh FOLDER
# A page then has in its head
#   <script defer src="FOLDER/edit.js"></script>
# and, where the editor is to be,
#   <div class="edit" data-routines="rt_hit_sphere rt_camera_ray" data-live="live-demo01"></div>
# The compiler in the page compiles tests/classroom/pupil_page.c with what the reader wrote, and links
# it with the viewer that docs/live/build.sh has made. To be run at the top of the repository. Exit
# status 3, with one line, where a tool is missing.
set -e
[ $# = 1 ] || { sed -n '2,9s/^# //p' "$0" >&2; exit 2; }
folder=$1
here=docs/live
packages=${BUILD:-build}/web
source=tests/classroom/pupil_page.c
command -v node >/dev/null && [ -d "$packages/node_modules" ] || {
    echo "note: no node, or no packages of npm (make deps-web): no editor in the pages"
    exit 3
}
mkdir -p "$folder" "$packages"
work=$(mktemp -d "$packages/work.XXXXXX")
trap 'rm -rf "$work"' EXIT

clang=$packages/node_modules/@yowasp/clang
version=$(sed -n 's/.*"version": "\(.*\)".*/\1/p' "$clang/package.json")

# The compiler: 105 MB, of which C for WebAssembly needs less; it is packed once.
packed=$packages/compiler-$version
[ -e "$packed/libc.bin" ] || {
    rm -rf "$packed" && mkdir -p "$packed"
    node $here/trim.mjs "$clang/gen/llvm-resources.tar" "$work/libc.tar"
    gzip -9nc "$work/libc.tar" >"$packed/libc.new"
    gzip -9nc "$clang/gen/llvm.core.wasm" >"$packed/clang.bin"
    mv "$packed/libc.new" "$packed/libc.bin"
}
cp "$packed"/*.bin "$clang"/gen/llvm.core[234].wasm "$folder"
megabytes=$(cat "$folder"/*.bin | wc -c | awk '{ printf "%.0f", $1 / 1e6 }')

# What it compiles: all of ours that the source includes, and what says which routines it has,
# and that rt.h, which came after the #define, has none of that name.
names=$(sed -n 's/^#ifndef \(rt_[a-z_]*\)$/\1/p' rt.h)
tests/classroom/starter "$work/starters" >/dev/null
files=$(clang --target=wasm32-wasi -std=c99 -I. -MM "$source" \
    "-DSUBMISSION=\"$work/starters/my_reflect.c\"" | tr -s ' \\\n' '\n' |
    grep -v -e '\.o:$' -e my_reflect.c -e '^$' | while read -r file; do
    (cd "$(dirname "$file")" && echo "$(pwd)/$(basename "$file")")
done | sed "s|^$(pwd)/||" | sort -u)
cp "$packages/viewer.o" "$packages/page.o" "$folder"
for name in $names; do
    echo "#ifdef $name"
    echo "#undef $name"
    echo "typedef int $name;"
    echo "PUPIL_ANSWERS($name, call_${name#rt_})"
    echo "#endif"
done | OBJECTS="viewer.o page.o" node $here/pack.mjs "$source" $files >"$folder/edit-files.json"

# Who judges; the texts to begin with; the scripts.
clang --target=wasm32-wasi -mexec-model=reactor -std=c99 -O2 -ffp-contract=off -Wall \
    -Wl,--strip-all -o "$folder/grade.wasm" tests/classroom/grade_page.c
node -e 'const fs = require("fs"), all = {};
for (const name of process.argv.slice(2))
    all[name] = fs.readFileSync(`${process.argv[1]}/my_${name.slice(3)}.c`, "utf8");
console.log(JSON.stringify(all))' "$work/starters" $names >"$work/starters.json"
bundle() {
    NODE_PATH=$packages/node_modules "$packages/node_modules/.bin/esbuild" "$@" --bundle --minify \
        --target=es2022 --external:node:* --outdir="$folder" --log-level=warning \
        --legal-comments=none "--banner:js=/* licences: licences.txt */" \
        "--define:MEGABYTES=$megabytes" "--define:VERSION=\"$version\"" \
        "--alias:starters=./$work/starters.json"
}
bundle $here/edit.js $here/editor.js $here/edit-run.js --format=iife
bundle $here/edit-worker.js --format=esm
cp $here/edit.css "$folder"
for package in @codemirror/commands @codemirror/lang-cpp \
    @codemirror/language @codemirror/lint @codemirror/state @codemirror/view @lezer/common \
    @lezer/cpp @lezer/highlight @lezer/lr @marijn/find-cluster-break \
    @yowasp/clang crelt style-mod w3c-keyname; do
    echo "== $package" # where the package has no licence's text, its name
    cat "$packages/node_modules/$package"/LICENSE* 2>/dev/null ||
        sed -n 's/.*"license": "\(.*\)".*/\1/p' "$packages/node_modules/$package/package.json"
done >"$folder/licences.txt"

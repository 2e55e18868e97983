#!/bin/sh
# All that "write it yourself" needs in the pages of the site: docs/live/build-edit.sh FOLDER
# A page then has in its head
#   <script defer src="FOLDER/edit.js"></script>
# and, where the editor is to be,
#   <div class="edit" data-routines="rt_hit_sphere rt_camera_ray" data-live="live-demo01"></div>
# The compiler in the page compiles EDIT_SOURCE (tests/classroom/pupil_page.c), with EDIT_FLAGS
# (-DRT_STATIC), and links it with the objects EDIT_OBJECTS (none), made for wasm32-wasi. To be
# run at the top of the repository; needs node, npm, clang and wasm-ld (Debian: lld wasi-libc
# libclang-rt-14-dev-wasm32). The packages of npm come to EDIT_PACKAGES (build/web), once.
set -e
[ $# = 1 ] || { sed -n '2,11s/^# //p' "$0" >&2; exit 2; }
for tool in node npm clang wasm-ld; do
    command -v $tool >/dev/null || { echo "build-edit.sh: $tool is missing" >&2; exit 1; }
done
folder=$1
here=docs/live
packages=${EDIT_PACKAGES:-${BUILD:-build}/web}
source=${EDIT_SOURCE:-tests/classroom/pupil_page.c}
flags=${EDIT_FLAGS--DRT_STATIC}
mkdir -p "$folder" "$packages"
work=$(mktemp -d "$packages/work.XXXXXX")
trap 'rm -rf "$work"' EXIT

cmp -s $here/package-lock.json "$packages/package-lock.json" && [ -d "$packages/node_modules" ] || {
    cp $here/package.json $here/package-lock.json "$packages"
    npm ci --prefix "$packages" --no-audit --no-fund --loglevel=error
}
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
files=$(clang --target=wasm32-wasi -std=c99 -I. $flags -MM "$source" \
    "-DSUBMISSION=\"$work/starters/my_reflect.c\"" | tr -s ' \\\n' '\n' |
    grep -v -e '\.o:$' -e my_reflect.c -e '^$' | while read -r file; do
    (cd "$(dirname "$file")" && echo "$(pwd)/$(basename "$file")")
done | sed "s|^$(pwd)/||" | sort -u)
objects=
for object in $EDIT_OBJECTS; do
    cp "$object" "$folder"
    objects="$objects $(basename "$object")"
done
for name in $names; do
    echo "#ifdef $name"
    echo "#undef $name"
    echo "typedef int $name;"
    echo "PUPIL_ANSWERS($name, call_${name#rt_})"
    echo "#endif"
done | FLAGS=$flags OBJECTS=$objects node $here/pack.mjs "$source" $files >"$folder/edit-files.json"

# Who judges; the texts to begin with; the scripts.
clang --target=wasm32-wasi -mexec-model=reactor -std=c99 -O2 -ffp-contract=off -Wall -DRT_STATIC \
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

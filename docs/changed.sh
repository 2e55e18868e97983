#!/bin/sh
# What demo N has and the demo before it has not, in Markdown: docs/changed.sh N SCENES, where
# SCENES is what docs/numbers/scenes.c prints.
new=$(ls demos/demo$(printf %02d "$1")_*.c) old=$(ls demos/demo$(printf %02d $(($1 - 1)))_*.c)
work=$(mktemp -d) || exit 1
trap 'rm -rf "$work"' EXIT
export LC_ALL=C

functions() { sed -n 's/^static [a-z].*[ *]\([a-z_0-9]*\)(.*/\1/p' "$1" | grep -v '^pixel$' | sort; }
calls() { # except those of vectors, which are everywhere
    sed 's/\/\*.*//; /^ \*/d' "$1" | grep -oE 'rt_[a-z_]+\(' | tr -d '(' | sort -u |
        grep -vxE 'rt_(vec|add|sub|mul|scale|dot|length|at)'
}
scene() { grep -oE 'scene_[a-z_]+' "$1" | head -1; }
list() { sed 's/.*/`&`/' | paste -s -d , | sed 's/,/, /g'; }
say() { [ -z "$2" ] || printf '%s\n' "- $1: $2"; }

for what in functions calls; do
    $what "$old" >"$work/old" && $what "$new" >"$work/new"
    comm -13 "$work/old" "$work/new" >"$work/$what.new"
    comm -23 "$work/old" "$work/new" >"$work/$what.gone"
done
say "New in the demo, written by hand" "$(list <"$work/functions.new")"
say "No longer in the demo, since rt.h has it" "$(list <"$work/functions.gone")"
say "Now taken from rt.h" "$(list <"$work/calls.new")"
was=$(grep "^$(scene "$old"):" "$2") is=$(grep "^$(scene "$new"):" "$2")
[ "$was" = "$is" ] || say "In the scene" "${is#*: }; before: ${was#*: }"

pixel() { sed -n '/^static rt_vec3 pixel(/,/^}/p' "$1"; }
pixel "$old" >"$work/old" && pixel "$new" >"$work/new"
if [ -s "$work/old" ] && [ -s "$work/new" ]; then
    printf '\n```diff\n'
    diff -U 99 "$work/old" "$work/new" | sed 1,3d
    printf '```\n'
fi

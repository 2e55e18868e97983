#!/bin/sh
# The gallery of mistakes: docs/mistakes.md from docs/mistakes/*.c. Each of them is a routine
# of rt.h with one mistake in it, rendered and tested for real.
#   docs/gallery.sh            render the pictures, find the tests that go red, write the page
#   docs/gallery.sh --check    fail if anything there is not what this would make
cc=${CC:-cc} build=${BUILD:-build} page=docs/mistakes.md pictures=docs/images/mistakes
work=$(mktemp -d "$build/gallery.XXXXXX") || exit 1
trap 'rm -rf "$work"' EXIT
export OMP_WAIT_POLICY=passive LC_ALL=C
flags="-std=c99 -O1 -fno-math-errno -ffp-contract=off -w -I."
openmp=$(.ci/deps openmp "$cc")
libs="$(pkg-config --libs sdl2 $(pkg-config --exists SDL2_ttf && echo SDL2_ttf)) $(pkg-config --libs assimp 2>/dev/null) -lm"

field() { # FILE NAME: from the comment at the top of a mistake, on one line
    awk -v name="$2" 'index($0, " * " name ":") == 1 { on = 1; sub(/^ \* [A-Z][a-z]*: */, ""); print; next }
        /^ \* [A-Z][a-z]*:/ || /^ \*\// { on = 0 }
        on { sub(/^ \* */, ""); print }' "$1" | paste -s -d ' '
}

stage() { # NAME: the picture of its chapter, if that is 11 or later
    case $1 in 1[1-7]-*) echo "-DSTAGE=$((${1%%-*} - 3))" ;; esac
}

render() { # NAME SUBMISSION OPTIONS
    grep -q RT_IMPLEMENTATION "$2" && static=-DRT_STATIC || static= # program.a has another
    case $3 in
    edges) show=show_edges with="256 256 --samples 1" ;; # a wall, its rays along edges
    *) show=show with="240 180 --samples 16 $3" ;;
    esac
    $cc $flags $static $openmp $(stage "$1") "-DSUBMISSION=\"$2\"" -o "$work/$1" tests/classroom/$show.c \
        "$build/program.a" $libs &&
        "$work/$1" --no-window --quiet --out "$work/$1.png" $with
}

red() { # NAME FILE: the first test of its chapter that goes red on it
    case $1 in 10-*) test=18 ;; 1[1-7]-*) test=$((${1%%-*} + 9)) ;; *) test=0${1%%-*} ;; esac
    test=$(basename "$(ls tests/"$test"_*.c)" .c)
    case $1 in 12-* | 16-*) level=-O1 ;; *) level=-O0 ;; esac # what comes before the red one takes long there
    $cc -std=c99 $level -ffp-contract=off -w -I. -include "$2" -o "$work/$1.test" "tests/$test.c" \
        $(pkg-config --cflags --libs cmocka libcjson) -lm || return
    { said=$(CMOCKA_TEST_ABORT=1 timeout 100 "$work/$1.test" 2>&1); } 2>/dev/null
    [ $? != 134 ] || # it was red, and aborted
        echo "$said" | sed -n "s/^\[ RUN      \] \(.*\)/\`\1\` in \`tests\/$test.c\`/p" | tail -n 1
}

one() { # FILE: render it, and write its part of the page
    name=$(basename "$1" .c) options=$(field "$1" Options)
    render "$name" "$1" "$options" || exit 1
    test=$(red "$name" "$1")
    [ -n "$test" ] || { echo "$1: no test goes red" >&2; exit 1; }
    case $name in 1[1-7]-*) right=${name%%-*}-right ;; *) case $options in '') right=right ;; *denoise*) right=right-clean ;; *) right=right-direct ;; esac ;; esac
    [ "$options" = edges ] && right=16-edges thing="a wall without holes" || thing="the room as it should be"
    title=$(sed -n '1s/^\/\* //p' "$1")
    cat >"$work/$name.md" <<END

### $title

| right | wrong |
|---|---|
| ![$thing](images/mistakes/$right.png) | ![$title](images/mistakes/$name.png) |

**Symptom:** $(field "$1" Symptom). **Cause:** $(field "$1" Cause). **Cure:** $(field "$1" Cure).
Red: $test. The code: [mistakes/$name.c](mistakes/$name.c).
END
}

echo '#include "rt.h"' >"$work/none.c"
render right "$work/none.c" "" && render right-direct "$work/none.c" "--bounces 0" &&
    render right-clean "$work/none.c" --denoise && render 16-edges "$work/none.c" edges || exit 1
for chapter in $(ls docs/mistakes | sed -n 's/^\(1[1-7]\)-.*/\1/p' | uniq); do
    render "$chapter-right" "$work/none.c" "" || exit 1
done
for file in docs/mistakes/*.c; do
    one "$file" &
    [ -z "$other" ] && other=$! || { wait; other=; } # two at a time
done
wait
for file in docs/mistakes/*.c; do
    [ -e "$work/$(basename "$file" .c).md" ] || { echo "$file: not done"; exit 1; }
done

{
    sed '/^<!-- gallery -->$/q' "$page"
    for file in $(ls docs/mistakes/*.c | sort -s -t/ -k3,3n); do
        name=$(basename "$file" .c) n=${name%%-*}
        [ "$n" = "$last" ] || printf '\n## %s\n' \
            "$(sed -n '1s/^# //p' "$(ls docs/"$(printf %02d "$n")"-*.md)" | sed "s/^\([0-9]*\)\. /Chapter \1: /")"
        last=$n
        cat "$work/$name.md"
    done
    echo
    sed -n '/^<!-- \/gallery -->$/,$p' "$page"
} >"$work/page.md"

if [ "$1" = --check ]; then
    cmp -s "$work/page.md" "$page" || { diff "$page" "$work/page.md" | head; echo "$page is stale: docs/gallery.sh"; exit 1; }
    for picture in "$work"/*.png; do
        cmp -s "$picture" "$pictures/$(basename "$picture")" ||
            { echo "$pictures/$(basename "$picture") is stale: docs/gallery.sh"; exit 1; }
    done
else
    mkdir -p "$pictures" && cp "$work"/*.png "$pictures" && cp "$work/page.md" "$page"
fi

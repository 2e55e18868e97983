#!/bin/sh
# The documentation as a site, build/site/index.html, and as one document to print,
# build/rt.pdf: by pandoc and chromium, without the network.
command -v pandoc >/dev/null ||
    { echo "note: pandoc is missing (make deps-docs): no site, no PDF"; exit 0; }
site=${BUILD:-build}/site pdf=${BUILD:-build}/rt.pdf
chapters=$(basename -s .md docs/[0-9]*.md)
others="window python mistakes words report teaching performance correctness"
rm -rf "$site"
mkdir -p "$site" || exit 1
cp -r docs/images docs/site.css "$site" || exit 1

# What the pages link to in the repository.
sed -n 's/.*\](\(\.\.\/[^)#]*\).*/\1/p; s/.*\](\(mistakes\/[^)#]*\).*/docs\/\1/p; s/.*\](\(python\/[^)#]*\).*/docs\/\1/p' docs/*.md README.md |
    sed 's/^\.\.\///' | sort -u | while read -r file; do
    case $file in docs/*.md | README.md | *..*) ;; *) [ -e "$file" ] && mkdir -p "$site/$(dirname "$file")" &&
        cp -r "$file" "$site/$(dirname "$file")/" ;; esac
done
cp rt.h LICENSE CHANGELOG.md "$site" && mkdir -p "$site/docs" && cp -r docs/mistakes "$site/docs/" || exit 1

# The pictures that are alive: see docs/live. Without them the pages are without a script.
live= edit=
docs/live/build.sh "$site/live"
case $? in 0) live=1 ;; 3) ;; *) exit 1 ;; esac
if [ -n "$live" ]; then
    docs/live/build-edit.sh "$site/edit"
    case $? in 0) edit=1 ;; 3) ;; *) exit 1 ;; esac
fi

title() { # NAME of a page
    case $1 in index) source=README.md ;; *) source=docs/$1.md ;; esac
    sed -n '1s/^# //p' "$source"
}

contents() { # NAME of the page that shows them
    echo '<nav class="contents"><details><summary>Contents</summary><ul>'
    for each in index $chapters $others; do
        [ "$each" = "$1" ] && here=' aria-current="page"' || here=
        echo "<li><a href=\"$each.html\"$here>$(title "$each")</a></li>"
    done
    echo '</ul></details></nav>'
}

page() { # SOURCE NAME DEMO
    contents "$2" >"$site/contents.html"
    [ -e "docs/images/$3.png" ] || set -- "$1" "$2" # chapter 18 has no picture of its own
    demo=${live:+$3} routines=${edit:+$(docs/live/routines.sh "${3#demo}")}
    pandoc -f gfm-tex_math_dollars -t html5 -s --mathml --lua-filter docs/site.lua --css site.css \
        --include-before-body "$site/contents.html" \
        ${demo:+--css live/live.css -M "demo=$demo"} ${routines:+-M "routines=$routines"} \
        --metadata pagetitle="$(title "$2") - rt.h" --metadata lang=en -o "$site/$2.html" "$1" || exit 1
}
page README.md index
for name in $chapters; do
    page "docs/$name.md" "$name" "demo$(echo "$name" | cut -c1-2)"
done
for name in $others; do
    page "docs/$name.md" "$name"
done
rm "$site/contents.html"

# All of it, to print; the links between the pages become links within.
for name in $chapters $others; do
    echo "<section id=\"$name\">"
    pandoc -f gfm-tex_math_dollars -t html5 --mathml --lua-filter docs/site.lua \
        --id-prefix "$name-" "docs/$name.md" |
        sed -e 's/href="\([0-9a-z-]*\)\.html#/href="#\1-/g' -e 's/href="\([0-9a-z-]*\)\.html"/href="#\1"/g' \
            -e '/^<p>Previous: /,/<\/p>$/d'
    echo '</section>'
done >"$site/body.html"
echo '`x`{.c}' | # code, so that the colours for it are there
    pandoc -f markdown -t html5 -s --mathml --css site.css --metadata pagetitle="rt.h" --metadata lang=en -o "$site/frame.html" || exit 1
{
    sed '/<body>/q' "$site/frame.html"
    echo '<header id="index"><p class="title" id="index-the-chapters">rt.h</p><p>A small ray tracer in one C header, and its textbook.</p><ul>'
    for name in $chapters $others; do
        echo "<li><a href=\"#$name\">$(title "$name")</a></li>"
    done
    echo '</ul></header>'
    cat "$site/body.html"
    echo '</body></html>'
} >"$site/print.html"
rm "$site/body.html" "$site/frame.html"
echo "$site/index.html"

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "note: chromium is missing (make deps-docs): no PDF"; exit 0; }
root=$([ "$(id -u)" = 0 ] && echo --no-sandbox)
profile=$(mktemp -d) || exit 1
trap 'rm -rf "$profile"' EXIT
print() {
    "$chromium" --headless --disable-gpu $root --user-data-dir="$profile" --no-first-run \
        --disable-background-networking --disable-component-update --disable-sync \
        --no-pdf-header-footer --generate-pdf-document-outline --print-to-pdf="$pdf" \
        "file://$(cd "$site" && pwd)/print.html" >"$profile/log" 2>&1 && [ -s "$pdf" ] ||
        { tail -5 "$profile/log"; exit 1; }
}
rm -f "$pdf"
print

# Chromium does not know the pages of links: they are in the first PDF, for the second one's contents.
if command -v pdfinfo >/dev/null; then
    pdfinfo -dests "$pdf" | awk -F'[#"]' '
        NR == FNR { page[$(NF - 1)] = $1 + 0; next }
        /^<li><a href="#/ { sub("</a>", " <span>" page[$3] "</span></a>") }
        { print }' - "$site/print.html" >"$profile/print.html" &&
        cp "$profile/print.html" "$site" || exit 1
    print
else
    echo "note: pdfinfo is missing (make deps-docs): no page numbers in the PDF's contents"
fi
echo "$pdf"

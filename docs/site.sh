#!/bin/sh
# The documentation as a site, build/site/index.html, and as one document to print,
# build/rt.pdf: by pandoc and chromium, without the network.
command -v pandoc >/dev/null ||
    { echo "note: pandoc is missing (Debian: apt-get install pandoc): no site, no PDF"; exit 0; }
site=${BUILD:-build}/site
chapters="01-sphere 02-walls 03-cube 04-shadows 05-gamma 06-mirror 07-monte-carlo 08-faster 09-less-noise 10-clean 11-glass 12-lamps 13-gloss 14-lens-and-sky 15-patterns 16-triangles 17-own-shape"
others="window mistakes words report teaching performance correctness"
rm -rf "$site"
mkdir -p "$site" || exit 1
cp -r docs/images docs/site.css "$site" || exit 1

# What the pages link to in the repository.
sed -n 's/.*\](\(\.\.\/[^)#]*\).*/\1/p; s/.*\](\(mistakes\/[^)#]*\).*/docs\/\1/p' docs/*.md README.md |
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

page() { # SOURCE TARGET DEMO
    title=$(sed -n '1s/^# //p' "$1")
    demo=${live:+$3} routines=${edit:+$(docs/live/routines.sh "${3#demo}")}
    pandoc -f gfm-tex_math_dollars -t html5 -s --mathml --lua-filter docs/site.lua --css site.css \
        ${demo:+--css live/live.css -M "demo=$demo"} ${routines:+-M "routines=$routines"} \
        --metadata pagetitle="$title - rt.h" --metadata lang=en -o "$site/$2" "$1" || exit 1
}
page README.md index.html
for name in $chapters; do
    page "docs/$name.md" "$name.html" "demo$(echo "$name" | cut -c1-2)"
done
for name in $others; do
    page "docs/$name.md" "$name.html"
done

# All of it, to print; the links between the pages become links within.
for name in $chapters $others; do
    echo "<a id=\"$name\"></a>"
    pandoc -f gfm-tex_math_dollars -t html5 --mathml --lua-filter docs/site.lua \
        --id-prefix "$name-" "docs/$name.md" |
        sed -e 's/href="\([0-9a-z-]*\)\.html#/href="#\1-/g' -e 's/href="\([0-9a-z-]*\)\.html"/href="#\1"/g' \
            -e '/^<p>Previous: /,/<\/p>$/d'
done >"$site/body.html"
echo '`x`{.c}' | # code, so that the colours for it are there
    pandoc -f markdown -t html5 -s --mathml --css site.css --metadata pagetitle="rt.h" --metadata lang=en -o "$site/frame.html" || exit 1
{
    sed '/<body>/q' "$site/frame.html"
    echo '<header id="index"><p class="title" id="index-the-chapters">rt.h</p><p>A small ray tracer in one C header, and its textbook.</p><ul>'
    for name in $chapters $others; do
        echo "<li><a href=\"#$name\">$(sed -n '1s/^# //p' "docs/$name.md")</a></li>"
    done
    echo '</ul></header>'
    cat "$site/body.html"
    echo '</body></html>'
} >"$site/print.html"
rm "$site/body.html" "$site/frame.html"
echo "$site/index.html"

chromium=$(command -v chromium || command -v chromium-browser || command -v google-chrome) ||
    { echo "note: chromium is missing (Debian: apt-get install chromium): no PDF"; exit 0; }
root=$([ "$(id -u)" = 0 ] && echo --no-sandbox)
profile=$(mktemp -d) || exit 1
"$chromium" --headless --disable-gpu $root --user-data-dir="$profile" --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync \
    --no-pdf-header-footer --print-to-pdf="${BUILD:-build}/rt.pdf" "file://$(cd "$site" && pwd)/print.html" \
    >"$profile/log" 2>&1 && [ -s "${BUILD:-build}/rt.pdf" ] && echo "${BUILD:-build}/rt.pdf"
status=$?
[ $status = 0 ] || tail -5 "$profile/log"
rm -rf "$profile"
exit $status

#!/bin/sh
# The live pictures by themselves, one page for each chapter: build/web/pages/index.html, to be
# opened as a file or from a web server. "make docs" puts the same pictures into the chapters.
web=${BUILD:-build}/web/pages
rm -rf "$web" && mkdir -p "$web/images" || exit
docs/live/build.sh "$web/live" || exit
edit=
docs/live/build-edit.sh "$web/edit"
case $? in 0) edit=1 ;; 3) ;; *) exit 1 ;; esac
cp docs/images/demo[01]?.png "$web/images"
cp docs/site.css "$web"
page() { # FILE TITLE, its body on standard input
    cat >"$web/$1" <<END
<!DOCTYPE html>
<html lang="en">
<head><meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">
<title>$2 - rt.h</title><link rel="icon" href="data:,"><link rel="stylesheet" href="site.css"><link rel="stylesheet" href="live/live.css"></head>
<body>
$(cat)
</body>
</html>
END
}
for chapter in docs/[01]*.md; do
    number=$(basename "$chapter" | cut -c1-2)
    [ -e "docs/images/demo$number.png" ] || continue
    title=$(sed -n '1s/^# //p' "$chapter")
    alt=$(sed -n "s/^!\\[\\(.*\\)\\](images\\/demo$number\\.png)\$/\\1/p" "$chapter")
    try=$(sed -n 's/^\*\*\(Try this:\)\*\*/\1/p' "$chapter" | tr -d '*`')
    routines=${edit:+$(docs/live/routines.sh "$number")}
    editor=${routines:+"<div class=\"edit\" data-routines=\"$routines\" data-live=\"live-demo$number\"></div>
<script defer src=\"edit/edit.js\"></script>"}
    page "demo$number.html" "$title" <<END
<nav class="top"><a href="index.html">all pictures</a></nav>
<main>
<h1>$title</h1>
<div class="live" id="live-demo$number" data-demo="demo$number"><p><img src="images/demo$number.png" alt="$alt"></p></div>
<p>$try</p>
$editor
</main>
<script src="live/demo$number.js"></script>
<script src="live/live.js"></script>
END
    echo "<li><a href=\"demo$number.html\">$title</a></li>"
done >"$web/list"
page index.html "The live pictures" <<END
<main><h1>The live pictures</h1>
<ul style="list-style: none; padding: 0">
$(cat "$web/list")
</ul></main>
END
rm "$web/list"
echo "$web/index.html"

#!/bin/sh
# Is each term of docs/words.md used where the table says that it is explained?
#   docs/words.sh    name the terms that are not, and exit 1
# To be run at the top of the repository. A term must occur in the prose of the chapter that its
# link names or, if the link names a section, there. Code and links do not count. Symbols of one
# letter are not looked for.
program='
function plain(line) { # without marks, inline code and the targets of links
    gsub(/<!--[^>]*-->/, "", line)
    gsub(/`[^`]*`/, "", line)
    gsub(/\]\([^)]*\)/, "", line)
    gsub(/[][*_]/, "", line)
    return tolower(line)
}
function anchor(heading) { # as GitHub makes it
    heading = tolower(heading)
    sub(/^#+ */, "", heading)
    gsub(/[^a-z0-9 -]/, "", heading)
    gsub(/ /, "-", heading)
    return heading
}
function prose(path, section,    line, status, fence, inside, level, text) {
    inside = section == ""
    while ((status = (getline line < path)) > 0) {
        if (line ~ /^ *```/) fence = !fence
        else if (!fence && line ~ /^#/ && section != "") {
            match(line, /^#+/)
            if (inside && RLENGTH <= level) break
            if (!inside && anchor(line) == section) { inside = 1; level = RLENGTH }
        }
        if (inside && !fence) text = text " " plain(line)
    }
    close(path)
    if (status < 0) text = ""
    gsub(/ +/, " ", text)
    return text
}
function complain(text) { print "docs/words.md: " text; failed = 1 }
BEGIN { FS = " [|] " }
/^[|] .*[|] \[[0-9]+\]\(.*\) [|]$/ {
    rows++
    sub(/^[|] /, "", $1)
    target = $4
    sub(/^\[[0-9]+\]\(/, "", target)
    sub(/\) [|]$/, "", target)
    hash = index(target, "#")
    path = "docs/" (hash ? substr(target, 1, hash - 1) : target)
    text = prose(path, hash ? substr(target, hash + 1) : "")
    if (text == "") complain(target " is not there")
    n = split($1, terms, ", ")
    for (i = 1; i <= n; i++)
        if (length(terms[i]) > 2 && !index(text, tolower(terms[i])))
            complain("\"" terms[i] "\" is not in " target)
}
END { if (rows < 90) complain("only " rows + 0 " rows were found"); exit failed }'
LC_ALL=C awk "$program" docs/words.md

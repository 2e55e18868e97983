#!/bin/sh
# Puts the code that the chapters show into them, by name, so that it cannot grow old.
#   docs/excerpts.sh FILE.md...          rewrite the files that are stale
#   docs/excerpts.sh --check FILE.md...  write nothing: name the stale files, and exit 1
# To be run at the top of the repository. Between "<!-- snip: PATH#NAME -->" and
# "<!-- /snip -->" comes the definition of NAME in PATH: a function, a struct, an enum, or
# the program below the heading NAME in a comment.
program='
function fail(text) {
    print "excerpts.sh: " FILENAME ": " text > "/dev/stderr"
    failed = 1
    exit 1
}
function excerpt(path, name,    line, status, end, part, found, result) {
    while ((status = (getline line < path)) > 0) {
        if (end == "") { # not inside anything: does it begin here?
            part = ""
            if (line == " * " name) { end = "^ [*]     }$"; continue }
            if (line ~ ("^typedef [a-z]+ " name " [{]$")) end = "^} " name ";$"
            if (line ~ ("^[A-Za-z](.*[^A-Za-z0-9_])?" name "[(]")) end = ";"
            if (end == "") continue
        }
        if (end == ";" && line ~ /[{]$/) end = "^}$" # a definition, not a declaration
        part = part "\n" line
        if (line ~ end) {
            if (end != ";") { found++; result = part }
            end = ""
        }
    }
    close(path)
    if (status < 0) fail("cannot read " path)
    if (found != 1) fail(path "#" name (found ? " is defined twice" : " was not found"))
    gsub(/\n [*](     )?/, "\n", result) # the frame of the comment
    sub(/^\n+/, "", result)
    return "```c\n" result "\n```"
}
/^<!-- snip: .*#.* -->$/ && open != "" { fail(open " is not closed") }
/^<!-- \/snip -->$/ { open = "" }
open == "" { print }
/^<!-- snip: .*#.* -->$/ {
    open = substr($0, 12, length($0) - 15)
    print excerpt(substr(open, 1, index(open, "#") - 1), substr(open, index(open, "#") + 1))
}
END { if (!failed && open != "") fail(open " is not closed") }'

check=false stale=0
[ "$1" = --check ] && { check=true; shift; }
for file; do
    new=$(awk "$program" "$file") || exit 1
    [ "$new" = "$(cat "$file")" ] && continue
    stale=1
    if $check; then echo "$file: stale excerpt: run docs/excerpts.sh $file"
    else printf '%s\n' "$new" > "$file" || exit 1; fi
done
! $check || exit $stale

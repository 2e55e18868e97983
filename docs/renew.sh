#!/bin/sh
# Puts the code and the numbers that the pages show into them, so that they cannot go stale.
#   docs/renew.sh FILE.md...          rewrite the files that are stale
#   docs/renew.sh --check FILE.md...  write nothing: name the stale files, and exit 1
# Run it at the top of the repository, after docs/numbers.sh.
#   <!-- snip: PATH#NAME -->   the definition of NAME in PATH: a function or its type, a struct, an enum,
#   <!-- /snip -->             or the program below the heading NAME in a comment; without #NAME all of PATH
#   <!-- put: NAME -->         what build/numbers/NAME.txt has, except its lines "key: value"
#   <!-- /put -->
#   <!--NAME KEY-->...<!--/--> the value in the line "KEY: value" there, within a sentence
program='
function fail(text) {
    print "renew.sh: " FILENAME ": " text > "/dev/stderr"
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
            if (line ~ ("^typedef [a-z]+ " name "[(]")) end = "[)];$"
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
function whole(path,    line, status, result) {
    while ((status = (getline line < path)) > 0) result = result line "\n"
    close(path)
    if (status < 0) fail("cannot read " path)
    return "```" (path ~ /[.]py$/ ? "python" : path ~ /[.]sh$/ ? "sh" : "c") "\n" result "```"
}
function numbers(name, key,    path, line, status, result, fence) { # without a key: the rest
    path = build "/numbers/" name ".txt"
    while ((status = (getline line < path)) > 0) {
        if (line ~ /^```/) fence = !fence
        else if (key == "" && !fence && line ~ /^[^ |]+: /) continue
        if (key == "") result = result line "\n"
        else if (key != "" && index(line, key ": ") == 1) result = substr(line, length(key) + 3)
    }
    close(path)
    if (status < 0) fail("cannot read " path ": run docs/numbers.sh")
    if (result == "") fail(path " has no " key)
    if (key == "") sub(/\n$/, "", result)
    return result
}
function within(line,    before, mark, part) { # the numbers in a line of text
    while (match(line, /<!--[^ <>]+ [^ <>]+-->/)) {
        before = before substr(line, 1, RSTART + RLENGTH - 1)
        mark = substr(line, RSTART + 4, RLENGTH - 7)
        line = substr(line, RSTART + RLENGTH)
        if (!index(line, "<!--/-->")) fail(mark " is not closed in its line")
        split(mark, part, " ")
        before = before numbers(part[1], part[2]) "<!--/-->"
        line = substr(line, index(line, "<!--/-->") + 8)
    }
    return before line
}
/^<!-- (snip|put): .* -->$/ && open != "" { fail(open " is not closed") }
/^<!-- \/(snip|put) -->$/ { open = "" }
open == "" { print within($0) }
/^<!-- snip: .* -->$/ {
    open = substr($0, 12, length($0) - 15)
    hash = index(open, "#")
    print hash ? excerpt(substr(open, 1, hash - 1), substr(open, hash + 1)) : whole(open)
}
/^<!-- put: .* -->$/ {
    open = substr($0, 11, length($0) - 14)
    print numbers(open, "")
}
END { if (!failed && open != "") fail(open " is not closed") }'

check=false stale=0
[ "$1" = --check ] && { check=true; shift; }
for file; do
    new=$(awk -v build="${BUILD:-build}" "$program" "$file") || exit 1
    [ "$new" = "$(cat "$file")" ] && continue
    stale=1
    if $check; then echo "$file: stale: run docs/renew.sh $file"
    else printf '%s\n' "$new" > "$file" || exit 1; fi
done
! $check || exit $stale

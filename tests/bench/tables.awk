# One table, in Markdown and aligned, of the rows that tests/bench/run has collected, or with
# topic=plot-error or plot-growth the rows for plot.awk:
#   awk -F'\t' -v topic=speed -f tables.awk results.txt
# Of several measurements of the same thing the best counts.

function show(value) { # three digits that say something
    if (value == "") return "-"
    return sprintf(value >= 100 ? "%.0f" : value >= 10 ? "%.1f" : value >= 1 ? "%.2f" : "%.3f", value)
}
function times(a, b) { return a == "" || !b ? "-" : show(a / b) "\303\227" } # UTF-8, a cross

function line(a, b, c, d, e, f, g,    i) {
    split("", cell)
    cell[1] = a; cell[2] = b; cell[3] = c; cell[4] = d; cell[5] = e; cell[6] = f; cell[7] = g
    lines++
    for (i = 1; i <= columns; i++) {
        text[lines, i] = cell[i]
        if (size(cell[i]) > width[i]) width[i] = size(cell[i])
    }
}
function size(s) { # in characters, whatever awk counts
    gsub(/\303\227/, "x", s)
    return length(s)
}
function pad(s, n, left) {
    while (size(s) < n) s = left ? s " " : " " s
    return s
}
function print_table(    i, j, out) {
    for (i = 1; i <= lines; i++) {
        out = "|"
        for (j = 1; j <= columns; j++) out = out " " pad(text[i, j], width[j], j <= 1 + second) " |"
        print out
        if (i == 1) {
            out = "|"
            for (j = 1; j <= columns; j++)
                out = out " " pad("", width[j]) (j <= 1 + second ? " " : ":") "|"
            gsub(/ /, "-", out)
            gsub(/\|-/, "| ", out)
            gsub(/-\|/, " |", out)
            print out
        }
    }
}

function plot(key, label,    i) {
    for (i = 1; i <= count[key]; i++)
        print label "\t" order[key, i] "\t" best[key, order[key, i]]
}

function keep(topic, label, value, largest,    key) {
    key = topic SUBSEP label
    if (!(key in best)) { order[topic, ++count[topic]] = label; best[key] = value }
    if (largest ? value > best[key] : value < best[key]) best[key] = value
}

$1 == "machine" { machine = $2 }
$1 == "speed" {
    keep("speed", $2, $3 + 0, 1)
    rays[$2] = $4 + 0
    if ($2 ~ /1 thread$/) most_lanes = $2 # the last of them
}
$1 == "flags" { keep("flags", $2, $3 + 0, 1) }
$1 == "picture" { keep("picture", $2, $3 + 0, $2 != 3) }
$1 == "direct" { keep("direct", $2, $4 + 0, 1) }
$1 == "mitsuba" { keep("mitsuba", $2, $3 + 0, 1) }
$1 == "part2" { keep("part2 " $3, $2, $4 + 0, 1) }
$1 == "growth" { keep("ns " $2, $3, $4 + 0, 0) }
$1 == "growth" && $2 != "linear" { keep("built", $3, $6 + 0, 0) }
$1 == "rays" {
    who = $3 SUBSEP $5
    for (i = 6; i <= 10; i++) keep("rays " i, who, $i + 0, i <= 8)
    shapes[who] = $4; bytes[who] = $11; differ[who] = $12
}
$1 == "denoise" { at[++pictures] = $2; noisy[$2] = $3; clean[$2] = $4; one[$2] = $5; two[$2] = $6 }
$1 == "oidn" { theirs[$2] = $3; took[$2] = $4 }
$1 == "oidn-split" { split_up[$2] = $3 }
$1 == "error" { samples[++errors] = $3 + 0; random[errors] = $4 + 0; sobol[errors] = $5 + 0 }

END {
    base = best["speed", "report's way, -O2"]
    per_sample = rays["rt.h, scalar, 1 thread"]
    packets = best["speed", most_lanes]
    if (topic == "machine") { print machine "."; exit }
    if (topic == "part2") {
        columns = 5
        line("scene", "rt.h, scalar", "rt.h, lanes", "Mitsuba, llvm", "rt.h against it")
        for (i = 1; i <= count["part2 lanes"]; i++) {
            scene = order["part2 lanes", i]
            lanes = best["part2 lanes", scene]
            theirs2 = best["part2 mitsuba", scene]
            line(scene, show(best["part2 scalar", scene]), show(lanes), show(theirs2),
                times(lanes, theirs2))
        }
        print_table()
        exit
    }
    if (topic == "speed") {
        columns = 3
        line("camera ray, 5 bounces, shadow rays", "Mrays/s", "against report's way, -O2")
        for (i = 1; i <= count["speed"]; i++) {
            label = order["speed", i]
            line(label, show(best["speed", label]), times(best["speed", label], base))
        }
    }
    if (topic == "flags") {
        columns = 3
        line("compiler's flags", "Mrays/s", "against make")
        for (i = 1; i <= count["flags"]; i++) {
            label = order["flags", i]
            line(label, show(best["flags", label]),
                times(best["flags", label], best["flags", order["flags", 1]]))
        }
    }
    if (topic == "pictures") {
        columns = 3
        line("640 x 480", "rt.h, 2 threads", "report's way, -O2")
        slow = base ? 640 * 480 * 64 * per_sample / base / 1e6 : ""
        line("64 samples, 5 bounces", show(best["picture", 3]) " s", show(slow) " s")
        line("1 sample, 5 bounces", show(best["picture", 2]) " a second",
            show(slow ? 64 / slow : "") " a second")
        line("1 sample, direct light only", show(best["picture", 1]) " a second", "")
    }
    if (topic == "others") {
        columns = 4
        line("one thread", "Mrays/s", "rt.h, same rays", "rt.h is faster by")
        for (i = 1; i <= count["mitsuba"]; i++) {
            label = order["mitsuba", i]
            value = best["mitsuba", label] * per_sample # rays: it traces as many a sample
            line(label, show(value), show(packets), times(packets, value))
        }
        label = "POV-Ray, direct light"
        if (count["direct"] > 1)
            line(label, show(best["direct", label]),
                show(best["direct", "rt.h"]),
                times(best["direct", "rt.h"], best["direct", label]))
    }
    if (topic == "growth") {
        columns = 6
        line("spheres", "every shape asked", "tree, scalar", "tree, packets", "packets, against 10", "built in")
        for (i = 1; i <= count["ns packets"]; i++) {
            n = order["ns packets", i]
            time = best["ns packets", n]
            line(n, i > count["ns linear"] ? "" : show(best["ns linear", n]) " ns",
                show(best["ns scalar", n]) " ns", show(time) " ns",
                times(time, best["ns packets", 10]), show(best["built", n]) " ms")
        }
    }
    if (topic == "rays" || topic == "trees") {
        second = 1 # this column is words, too
        for (i = 1; i <= count["rays 6"]; i++) {
            who = order["rays 6", i]
            split(who, part, SUBSEP)
            against = part[1] SUBSEP "Embree, robust"
            ratios = ""
            for (k = 6; k <= 8; k++)
                ratios = ratios " " times(best["rays " k, who], best["rays " k, against])
            scene = part[1] == last ? "" : part[1]
            last = part[1]
            if (topic == "rays") {
                columns = ratios ~ /-/ ? 5 : 6
                if (i == 1)
                    line("one core, Mrays/s", "tree", "from the eye", "to the light",
                        "diffuse", "against Embree, robust")
                line(scene, part[2], show(best["rays 6", who]), show(best["rays 7", who]),
                    show(best["rays 8", who]), substr(ratios, 2))
            } else {
                columns = 7
                if (i == 1)
                    line("scene", "tree", "shapes", "built by one thread", "by all",
                        "bytes a shape", "rays that differ")
                line(scene, part[2], scene ? shapes[who] : "",
                    show(1e3 * best["rays 9", who]) " ms",
                    show(1e3 * best["rays 10", who]) " ms", show(bytes[who]), differ[who])
            }
        }
    }
    if (topic == "plot-growth") {
        plot("ns linear", "every shape asked")
        plot("ns scalar", "tree, scalar")
        plot("ns packets", "tree, packets")
        exit
    }
    if (topic == "plot-error") {
        for (i = 1; i <= errors; i++) {
            print "random numbers\t" samples[i] "\t" random[i]
            print "Sobol points\t" samples[i] "\t" sobol[i]
            print "slope \342\210\2221/2\t" samples[i] "\t" 0.75 * random[1] / sqrt(samples[i]) "\tdashed"
        }
        exit
    }
    if (topic == "denoise") {
        columns = 6
        line("samples", "noisy", "rt_denoise", "seconds, 1 and 2 threads", "Open Image Denoise, seconds", "the same on our light")
        for (i = 1; i <= pictures; i++) {
            k = at[i]
            line(k, show(noisy[k]), show(clean[k]), show(one[k]) " " show(two[k]),
                 show(theirs[k]) (k in took ? " " show(took[k]) : ""), show(split_up[k]))
        }
    }
    if (topic == "error") {
        columns = 4
        line("samples", "random numbers", "Sobol points", "times fewer samples")
        for (i = 1; i <= errors; i++)
            line(samples[i], show(random[i]), show(sobol[i]), times((random[i] / sobol[i]) ^ 2, 1))
    }
    print_table()
}

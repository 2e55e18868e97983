# A log-log plot as SVG: awk -F'\t' -v title= -v x= -v y= -f plot.awk; rows "series x y [dashed]".

function log10(v) { return log(v) / log(10) }
function px(v) { return left + (log10(v) - x0) / (x1 - x0) * (right - left) }
function py(v) { return bottom - (log10(v) - y0) / (y1 - y0) * (bottom - top) }
function words(x, y, anchor, colour, s) {
    printf "<text x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" fill=\"%s\">%s</text>\n", x, y, anchor, colour, s
}
function stroke(xa, ya, xb, yb, colour) {
    printf "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\"/>\n", xa, ya, xb, yb, colour
}
{
    if (!($1 in points)) name[++series] = $1
    n = ++points[$1]
    xs[$1, n] = $2 + 0
    ys[$1, n] = $3 + 0
    dashed[$1] = $4
    ticks[$2 + 0]
    if (NR == 1 || $2 + 0 < low_x) low_x = $2 + 0
    if (NR == 1 || $2 + 0 > high_x) high_x = $2 + 0
    if (NR == 1 || $3 + 0 < low_y) low_y = $3 + 0
    if (NR == 1 || $3 + 0 > high_y) high_y = $3 + 0
}
END {
    left = 80; right = 480; top = 50; bottom = 320
    x0 = log10(low_x); x1 = log10(high_x)
    y0 = log10(low_y / 1.2); y1 = log10(high_y * 1.2)
    split("#1f6fb4 #c2410c #4d7c0f #777777", colours, " ")

    print "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 640 380\" width=\"640\" height=\"380\"" \
        " font-family=\"sans-serif\" font-size=\"13\">"
    print "<title>" title "</title>" # the background is ours: dark pages show the same
    print "<rect x=\"0.5\" y=\"0.5\" width=\"639\" height=\"379\" rx=\"6\" fill=\"#ffffff\" stroke=\"#cccccc\"/>"
    print "<g font-size=\"15\" font-weight=\"bold\">"
    words(left, 28, "start", "#222222", title)
    print "</g>"
    for (v in ticks) {
        stroke(px(v), top, px(v), bottom, "#e5e5e5")
        if (log10(v) == int(log10(v)) || x0 + 3 > x1) # not all, if they are many
            words(px(v), bottom + 18, "middle", "#444444", v + 0)
    }
    for (e = -4; e <= 7; e++)
        for (m = 1; m <= 5; m = m == 2 ? 5 : m + m % 2) { # 1, 2, 5
            v = m * 10 ^ e
            if (log10(v) < y0 || log10(v) > y1) continue
            stroke(left, py(v), right, py(v), m == 1 ? "#cccccc" : "#ececec")
            words(left - 8, py(v) + 4, "end", "#444444", v)
        }
    stroke(left, bottom, right, bottom, "#444444")
    stroke(left, top, left, bottom, "#444444")
    words((left + right) / 2, bottom + 42, "middle", "#222222", x)
    print "<g transform=\"rotate(-90)\">"
    words(-(top + bottom) / 2, 22, "middle", "#222222", y)
    print "</g>"

    for (i = 1; i <= series; i++) {
        s = name[i]
        colour[i] = dashed[s] ? "#777777" : colours[i]
        path = ""
        for (j = 1; j <= points[s]; j++)
            path = path sprintf("%.1f,%.1f ", px(xs[s, j]), py(ys[s, j]))
        printf "<polyline points=\"%s\" fill=\"none\" stroke=\"%s\" stroke-width=\"%s\"%s/>\n", path,
            colour[i], dashed[s] ? 1 : 2.5, dashed[s] ? " stroke-dasharray=\"5 4\"" : ""
        for (j = 1; j <= points[s] && !dashed[s]; j++)
            printf "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"3.5\" fill=\"%s\"/>\n", px(xs[s, j]), py(ys[s, j]), colour[i]
        at[i] = py(ys[s, points[s]]) + 4
    }
    for (round = 1; round <= 50; round++) # labels that are too close push each other away
        for (i = 1; i <= series; i++)
            for (j = 1; j <= series; j++)
                if (at[i] >= at[j] && i != j && at[i] - at[j] < 16 && close_by(i, j)) {
                    at[i] += 1
                    at[j] -= 1
                }
    for (i = 1; i <= series; i++)
        words(px(xs[name[i], points[name[i]]]) + 10, at[i], "start", colour[i], name[i])
    print "</svg>"
}
function close_by(i, j) {
    return xs[name[i], points[name[i]]] == xs[name[j], points[name[j]]]
}

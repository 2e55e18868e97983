#!/bin/sh
# The room of demos/scene.h as a scene for POV-Ray: direct light and the mirror only, since its
# indirect light is found another way. Reads what "bench room" prints.
# POV-Ray's x points the other way (hence "right -4/3*x"), its angles are horizontal, its surfaces
# lack the factor 1/pi, and its light falls off as 2 / (1 + d^2).
exec awk -F'\t' '
function vector(i) { return "<" $i ", " $(i + 1) ", " $(i + 2) ">" }
function matt(i) { return " pigment { rgb " vector(i) " } finish { ambient 0 diffuse 1 }" }
BEGIN {
    pi = atan2(0, -1)
    print "#version 3.7;\nglobal_settings { assumed_gamma 1 max_trace_level 6 }"
}
$1 == "camera" {
    half = $8 * pi / 360
    angle = 360 / pi * atan2(4 / 3 * sin(half) / cos(half), 1)
    printf "camera { location %s right -4/3*x angle %.9g look_at %s + %s }\n", vector(2), angle,
        vector(2), vector(5)
}
$1 == "light" {
    print "light_source { " vector(2) " rgb " vector(5) " / " 2 * pi \
        " fade_distance 1 fade_power 2 }"
}
$1 == "sphere" { print "sphere { " vector(2) ", " $5 matt(6) " }" }
$1 == "mirror_sphere" {
    print "sphere { " vector(2) ", " $5 " pigment { rgb 0 }" \
        " finish { ambient 0 diffuse 0 reflection { rgb " vector(6) " } } }"
}
$1 == "box" { print "box { " vector(2) ", " vector(5) matt(8) " }" }'

#!/bin/sh
# The routines of a chapter that a reader may write: docs/live/routines.sh 4. That of the camera comes
# last, as in the exercise.
awk -v chapter="$1" '/^ \* Chapter [0-9]+\./ { n = $3 + 0 }
    /^#ifndef rt_[a-z_]*$/ && n == chapter + 0 { print ($2 == "rt_camera_ray"), $2 }' rt.h |
    sort -s -k1,1 | cut -d' ' -f2 | paste -s -d ' ' -

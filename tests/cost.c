/* What exactness costs: the best of some runs of the room, one ray at a time, in seconds.
 * tests/check cost builds it twice, with rt.h as it is, and -DPLAIN with the plain float sphere of a
 * first lecture in its place, and compares. */
#ifdef PLAIN
#include "plain_sphere.h"
#endif

#define RT_IMPLEMENTATION
#include "../demos/scene.h"

#include <stdio.h>

int main(void)
{
    static rt_vec3 pixels[160 * 120];
    double best = 1e9;
    for (int run = 0; run < 15; run++) {
        rt_image image = {.width = 160, .height = 120, .pixels = pixels};
        rt_options options = {.samples = 4, .bounces = 5, .threads = 1, .lanes = 1};
        const double start = rt__seconds();
        if (rt_render(&scene_indirect, &room_camera, &options, &image) != RT_OK)
            return 1;
        const double took = rt__seconds() - start;
        best = took < best ? took : best;
    }
    printf("%.6f\n", best);
    return 0;
}

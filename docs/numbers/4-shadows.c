/* Chapter 4, exercises 2 and 4: the area of a shadow, and the edge of a soft one. */
#include "rt.h"
#include <stdio.h>

int main(void)
{
    const rt_vec3 up = {0, 1, 0};
    const rt_sphere ball = {{0, 5, 0}, 1, {{1, 1, 1}, false}};
    const rt_scene below = {.spheres = &ball, .sphere_count = 1};
    int dark = 0;
    for (int i = -500; i < 500; i++)
        for (int j = -500; j < 500; j++) {
            const rt_vec3 P = {0.01f * (i + 0.5f), 0, 0.01f * (j + 0.5f)};
            dark += !rt_visible(&below, P, up, rt_vec(0, 10, 0));
        }
    printf("area: %.2f\n", dark * 1e-4);

    const rt_box flat = {{-100, 5, -100}, {0, 5, 100}, {{1, 1, 1}, false}};
    const rt_scene half = {.boxes = &flat, .box_count = 1};
    printf("| $`x`$ | -1 | -0.5 | 0 | 0.5 | 1 |\n|---|---|---|---|---|---|\n| seen |");
    for (float x = -1; x <= 1; x += 0.5f) {
        rt_rng rng = rt_rng_start(0, 0, 1);
        int seen = 0;
        for (int i = 0; i < 10000; i++) {
            const float r1 = rt_random(&rng);
            const float r2 = rt_random(&rng);
            const rt_vec3 S = {2 * r1 - 1, 10, 2 * r2 - 1};
            seen += rt_visible(&half, rt_vec(x, 0, 0), up, S);
        }
        printf(" %.3f |", seen / 10000.0);
    }
    printf("\n");
}

/* Chapter 12, exercises: how many rays find a lamp by chance, and what noise that makes; how wide
 * the edge of a shadow is. */
#include "rt.h"
#include <stdio.h>

static const double pi = 3.14159265358979;

/* The light of the floor at x, under a lamp, n samples. */
static double light(const rt_scene *scene, float x, uint32_t n)
{
    double sum = 0;
    for (uint32_t i = 0; i < n; i++) {
        rt_rng rng = rt_rng_start(i, 0, 0);
        const rt_ray ray = {{x, 0.1f, 0}, {0, -1, 0}};
        sum += (double)rt_radiance_mis(scene, &ray, 0, &rng).x / n;
    }
    return sum;
}

int main(void)
{
    /* by chance: a lamp of radius 6, 40 above a floor */
    const rt_lamp lamp = {
        .center = {0, 40, 0}, .radius = 6, .intensity = {3380, 3380, 3380}};
    enum { N = 10000000 };
    int found = 0;
    rt_rng rng = rt_rng_start(0, 0, 0);
    for (int i = 0; i < N; i++) {
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_ray ray = {{0, 0, 0}, rt_sample_cosine(rt_vec(0, 1, 0), r1, r2)};
        found += rt_meet_lamp(&lamp, &ray, FLT_MAX) > 0;
    }
    const double p = 36.0 / 1600;
    printf("part: %.2f\n", 100 * p);
    printf("found: %.2f\n", 100.0 * found / N);
    printf("chance-noise: %.0f\n", 100 * sqrt((1 - p) / p / 16));
    printf("cone: %.4f\ncone-density: %.1f\n", p / (1 + sqrt(1 - p)),
           (double)rt_lamp_density(&lamp, rt_vec(0, 0, 0), rt_vec(0, 1, 0)));
    printf("weight: %.5f\n",
           (double)rt_mis(rt_lamp_density(&lamp, rt_vec(0, 0, 0), rt_vec(0, 1, 0)),
                          0.318309886f));

    /* a shadow: the lamp 10 above the floor, an edge at the height 2 */
    for (int k = 0; k < 2; k++) {
        const rt_box boxes[2] = {
            {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}},
            {{-50, 2, -50}, {0, 2, 50}, {{0, 0, 0}, false}}};
        const rt_lamp above = {
            .center = {0, 10, 0}, .radius = k ? 2 : 1, .intensity = {100, 100, 100}};
        const rt_scene scene = {
            .boxes = boxes, .box_count = 2, .lamps = &above, .lamp_count = 1};
        double from = 1, to = -1;
        for (int i = -100; i <= 100; i++) {
            const float x = 0.01f * (float)i;
            const double d = sqrt((double)x * (double)x + 100);
            const double part =
                light(&scene, x, 20000) / (0.5 / pi * 100 * 10 / (d * d * d));
            if (part > 1e-4 && from > 0.99)
                from = (double)x;
            if (part < 1 - 1e-4)
                to = (double)x;
        }
        printf("shadow%d: %.2f\n", k + 1, to - from);
    }
}

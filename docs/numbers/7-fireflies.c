/* Chapter 7: fireflies. A closed room of 10 x 10 x 10, albedo 0.5, and a lamp 1, 0.1 or
 * 0.01 below the middle of the ceiling. Four million samples of one pixel, which shows
 * the middle of the floor, with one bounce. Only the indirect light counts: the direct
 * light is the same in each sample, and is subtracted. How many times the mean is the
 * largest sample, and what part of the mean is lost if no sample may be above 10 times
 * the mean? */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdio.h>

enum { N = 4000000 };

static float samples[N];

int main(void)
{
    const float gaps[3] = {1, 0.1f, 0.01f};
    printf(
        "| lamp to ceiling | largest sample / mean | lost if cut at 10 times the mean |\n"
        "|---|---|---|\n");
    for (int k = 0; k < 3; k++) {
        const rt_box room = {{-5, -5, -5}, {5, 5, 5}, {{0.5f, 0.5f, 0.5f}, false}};
        const rt_light lamp = {{0, 5 - gaps[k], 0}, {100, 100, 100}};
        const rt_scene scene = {
            .boxes = &room, .box_count = 1, .lights = &lamp, .light_count = 1};
        const rt_ray ray = {{0, 0, 3}, {0, -5, -3}};
        rt_rng rng = rt_rng_start(0, 0, 0);
        const float direct = rt_radiance(&scene, &ray, 0, &rng).x;
        double sum = 0, largest = 0, cut = 0;
        for (int i = 0; i < N; i++) {
            rng = rt_rng_start(0, (uint32_t)i, 0);
            samples[i] = rt_radiance(&scene, &ray, 1, &rng).x - direct;
            sum += (double)samples[i];
            largest = fmax(largest, (double)samples[i]);
        }
        for (int i = 0; i < N; i++)
            cut += fmin((double)samples[i], 10 * sum / N);
        printf("| %g | %.*f | %.0f %% |\n", (double)gaps[k], k == 0, largest / (sum / N),
               100 * (1 - cut / sum));
    }
}

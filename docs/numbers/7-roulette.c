/* Chapter 7: bounces up to a limit, and all of them by Russian roulette. 160 x 120, 64
 * samples: mean of the picture, rays per sample, the part of the light that is missing
 * compared with all bounces, and the noise as rt_image_error estimates it. And the
 * exercise: the mean of 100 000 paths in a closed sphere of albedo 0.9. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { PIXELS = 160 * 120, SAMPLES = 64 };

static rt_vec3 pixels[PIXELS], half[PIXELS];

static void exercise(void)
{
    const rt_sphere room = {{0, 0, 0}, 10, {{0.9f, 0.9f, 0.9f}, false}};
    const rt_light lamp = {{0, 0, 0}, {628.3185f, 628.3185f, 628.3185f}};
    const rt_scene scene = {
        .spheres = &room, .sphere_count = 1, .lights = &lamp, .light_count = 1};
    const rt_ray ray = {{0, 0, 0}, {1, 0, 0}};
    rt_rng rng = rt_rng_start(0, 0, 0);
    printf("five: %.2f\n", (double)rt_radiance(&scene, &ray, 5, &rng).x);
    double sum = 0, squares = 0;
    for (int i = 0; i < 100000; i++) {
        rng = rt_rng_start(0, (uint32_t)i, 0);
        const double value = (double)rt_radiance(&scene, &ray, RT_ALL_BOUNCES, &rng).x;
        sum += value;
        squares += value * value;
    }
    const double mean = sum / 1e5;
    printf("all: %.2f\nall-error: %.2f\n", mean,
           sqrt((squares / 1e5 - mean * mean) / 1e5));
}

int main(void)
{
    exercise();
    const int bounces[8] = {0, 1, 2, 5, 10, 20, 50, RT_ALL_BOUNCES};
    double mean[8] = {0}, rays[8], error[8];
    for (int k = 0; k < 8; k++) {
        rt_image image = {.width = 160, .height = 120, .pixels = pixels, .half = half};
        const rt_options options = {
            .samples = SAMPLES, .bounces = bounces[k], .sampler = RT_RANDOM};
        rt_render(&scene_indirect, &room_camera, &options, &image);
        for (int i = 0; i < PIXELS; i++)
            mean[k] += (double)(pixels[i].x + pixels[i].y + pixels[i].z) / (3.0 * PIXELS);
        rays[k] = (double)image.rays / ((double)PIXELS * SAMPLES);
        error[k] = (double)rt_image_error(&image);
    }
    printf("missing5: %.1f\n", 100 * (1 - mean[3] / mean[7]));
    printf("| bounces | mean | missing | rays per sample | noise "
           "|\n|---|---|---|---|---|\n");
    for (int k = 0; k < 8; k++) {
        char name[20] = "all";
        if (k < 7)
            sprintf(name, "%d", bounces[k]);
        printf("| %s | %.4f | %.1f %% | %.1f | %.1f %% |\n", name, mean[k],
               fabs(100 * (1 - mean[k] / mean[7])), rays[k], 100 * error[k]);
    }
}

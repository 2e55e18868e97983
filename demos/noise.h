/* What demo 09 shows around its sampler: where the points fall, and how large the error of the
 * picture is, with random numbers and with Sobol's. */
#ifndef NOISE_H
#define NOISE_H

#include "demo.h"
#include "scene.h"
#include <stdio.h>

/* The first 64 points (number 0, number 1) of pixel 0, counted in 8 x 8 squares. */
static void print_points(float (*sobol)(uint32_t key, uint32_t sample,
                                        uint32_t dimension))
{
    int counts[2][8][8] = {{{0}}};
    const uint32_t key = rt_rng_start(0, 0, 0).key;
    for (uint32_t sample = 0; sample < 64; sample++) {
        rt_rng rng = rt_rng_start(0, sample, 0);
        const float x = rt_random(&rng);
        const float y = rt_random(&rng);
        counts[0][(int)(8.0f * y)][(int)(8.0f * x)]++;
        counts[1][(int)(8.0f * sobol(key, sample, 1))]
              [(int)(8.0f * sobol(key, sample, 0))]++;
    }
    printf("64 points in 8 x 8 squares, random and Sobol:\n");
    for (int y = 0; y < 8; y++) {
        for (int which = 0; which < 2; which++) {
            printf("    ");
            for (int x = 0; x < 8; x++)
                if (counts[which][y][x] == 0)
                    printf(" .");
                else
                    printf(" %d", counts[which][y][x]);
        }
        printf("\n");
    }
}

static double error_of(rt_sampler sampler, int samples, int threads)
{
    enum { WIDTH = 80, HEIGHT = 60 };
    static rt_vec3 pixels[WIDTH * HEIGHT], half[WIDTH * HEIGHT];
    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels, .half = half};
    const rt_options options = {
        .samples = samples, .bounces = 5, .threads = threads, .sampler = sampler};
    rt_render(&scene_indirect, &room_camera, &options, &image);
    return (double)rt_image_error(&image);
}

static void print_errors(int threads)
{
    printf("error, estimated from two halves: random   Sobol   random samples for "
           "Sobol's error\n");
    for (int samples = 4; samples <= 256; samples *= 4) {
        const double by_random = error_of(RT_RANDOM, samples, threads);
        const double by_sobol = error_of(RT_SOBOL, samples, threads);
        printf("%22d samples %8.2f %% %7.2f %% %9.0f\n", samples, 100.0 * by_random,
               100.0 * by_sobol,
               samples * (by_random / by_sobol) * (by_random / by_sobol));
    }
}

#endif

/* What demo 08 needs around its loops: paths of light through a small picture, the loop
 * without OpenMP and rt_render to compare with, and the table of the times. */
#ifndef LOOPS_H
#define LOOPS_H

#include "demo.h"
#include "scene.h"
#include <stdio.h>
#include <stdlib.h>

#ifndef _OPENMP /* the pragmas do nothing then, and we know it */
#pragma GCC diagnostic ignored "-Wunknown-pragmas"
#endif

enum { WIDTH = 96, HEIGHT = 72, COUNT = WIDTH * HEIGHT, SAMPLES = 32 };

/* What the loops compute, each sample of each pixel, and on how many threads. */
static rt_vec3 value[COUNT][SAMPLES];
static int workers;

/* The light along one path through pixel i: direct, and by one bounce. Its four numbers come
 * from draw(&rng). */
static rt_vec3 follow(int i, float (*draw)(rt_rng *rng), rt_rng rng)
{
    const float dx = draw(&rng);
    const float dy = draw(&rng);
    rt_ray ray = rt_camera_ray(&room_camera, WIDTH, HEIGHT, (float)(i % WIDTH) + dx,
                               (float)(i / WIDTH) + dy);
    rt_hit hit;
    if (!rt_intersect(&scene_cube, &ray, &hit))
        return rt_vec(0, 0, 0);
    const rt_vec3 direct = rt_direct(&scene_cube, &hit, &rng);
    const float r1 = draw(&rng);
    const float r2 = draw(&rng);
    ray.direction = rt_sample_cosine(hit.normal, r1, r2);
    ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
    const rt_vec3 indirect = rt_radiance(&scene_cube, &ray, 0, &rng);
    return rt_add(direct, rt_mul(hit.material->albedo, indirect));
}

/* With numbers that are a function of pixel and sample, as in chapter 7. */
static rt_vec3 trace(int i, int k)
{
    return follow(i, rt_random, rt_rng_start((uint32_t)i, (uint32_t)k, 0));
}

/* With numbers from rand(), which has one state, behind a lock, for all threads. */
static float from_rand(rt_rng *rng)
{
    rng->key = (uint32_t)rand(); /* NOLINT(cert-msc30-c,cert-msc50-cpp) */
    rng->dimension = 0;
    return rt_random(rng);
}

static rt_vec3 trace_by_rand(int i)
{
    return follow(i, from_rand, rt_rng_start(0, 0, 0));
}

/* What is left of each loop if the compiler does not know OpenMP. */
static void without_openmp(void)
{
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < SAMPLES; k++)
            value[i][k] = trace(i, k);
}

static void by_rt_render(rt_vec3 *pixels)
{
    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels};
    const rt_options options = {
        .samples = SAMPLES, .bounces = 1, .threads = workers, .sampler = RT_RANDOM};
    rt_render(&scene_cube, &room_camera, &options, &image);
}

typedef struct loop {
    const char *what;
    void (*run)(void); /* NULL: by_rt_render */
} loop;

/* The time that the loop takes on so many threads, and its picture. */
static double time_loop(loop l, int threads, rt_vec3 *picture)
{
    workers = threads;
    srand(1);
    const double start = demo_seconds();
    if (l.run)
        l.run();
    else
        by_rt_render(picture);
    const double took = demo_seconds() - start;
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < SAMPLES && l.run; k++) { /* the mean, summed as rt.h does */
            const rt_vec3 mean = k == 0 ? rt_vec(0, 0, 0) : picture[i];
            picture[i] =
                rt_add(mean, rt_scale(rt_sub(value[i][k], mean), 1.0f / (float)(k + 1)));
        }
    return took;
}

/* One line: the time on one thread and on all, how many times faster than the plain loop that
 * is, and whether the two pictures are the same, bit for bit. */
static void print_line(loop l, int threads, double plain)
{
    static rt_vec3 alone[COUNT], together[COUNT];
    const double one = time_loop(l, 1, alone), all = time_loop(l, threads, together);
    printf("%-30s %8.3f s %8.3f s %7.2f   %s\n", l.what, one, all, plain / all,
           memcmp(alone, together, sizeof alone) == 0 ? "yes" : "no");
}

static void print_table(const loop *loops, int count, int threads)
{
    static rt_vec3 picture[COUNT];
    const loop plain = {"without -fopenmp", without_openmp};
    time_loop(plain, 1, picture); /* the first run is slower: memory is new */
    const double start = time_loop(plain, 1, picture);
    printf(
        "%d x %d, %d samples            1 thread  %2d thread%s   speed   same picture\n",
        WIDTH, HEIGHT, SAMPLES, threads, threads == 1 ? " " : "s");
    print_line(plain, threads, start);
    for (int n = 0; n < count; n++)
        print_line(loops[n], threads, start);
    print_line((loop){"packets: rt_render", NULL}, threads, start);
}

#endif

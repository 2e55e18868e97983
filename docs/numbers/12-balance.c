/* Chapter 12: the light that chapter 6 missed is back. A closed cube of side 1, the wall
 * at x = 1 a mirror, a lamp in the middle. Computed: what the five other walls send out,
 * as a mean over their area, with all bounces.
 *
 * White: only the lamp takes light; it is black and has the radiance 1. Then everything
 * has the radiance 1. Grey: albedo 1/2, a lamp of 1 W/sr. The walls take all that it
 * sends, or it takes it itself:
 *
 *     4 pi I = (1 - rho) 5 E + what the lamp takes,   and they send out rho E / pi. */
#include "rt.h"
#include <stdio.h>

static const double pi = 3.14159265358979;
static rt_box walls[6];

static void make_walls(float rho)
{
    for (int k = 0; k < 6; k++) {
        float low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
        low[k / 2] = high[k / 2] = k % 2 ? 1 : 0;
        walls[k].min = rt_vec(low[0], low[1], low[2]);
        walls[k].max = rt_vec(high[0], high[1], high[2]);
        walls[k].material.mirror = k == 1;
        const float albedo = k == 1 ? 1 : rho;
        walls[k].material.albedo = rt_vec(albedo, albedo, albedo);
    }
}

static double light(const rt_scene *scene, uint32_t n, double *off)
{
    double sum = 0, squares = 0;
    rt_rng rng = rt_rng_start(0, 0, 1);
    for (uint32_t i = 0; i < n; i++) {
        const int wall = i % 5 == 0 ? 0 : 1 + (int)(i % 5); /* not the mirror */
        float p[3] = {rt_random(&rng), rt_random(&rng), rt_random(&rng)};
        float normal[3] = {0, 0, 0};
        normal[wall / 2] = wall % 2 ? -1 : 1;
        p[wall / 2] = (wall % 2 ? 1 : 0) + 1e-3f * normal[wall / 2]; /* from close by */
        const rt_ray ray = {rt_vec(p[0], p[1], p[2]),
                            rt_vec(-normal[0], -normal[1], -normal[2])};
        rt_rng path = rt_rng_start(i, 0, 0);
        const double v = (double)rt_radiance_mis(scene, &ray, RT_ALL_BOUNCES, &path).x;
        sum += v;
        squares += v * v;
    }
    *off = sqrt((squares / n - sum / n * (sum / n)) / n);
    return sum / n;
}

int main(void)
{
    const rt_vec3 middle = {0.5f, 0.5f, 0.5f}, one = {1, 1, 1};
    const float r = 0.1f, area = 3.14159265f * r * r;
    const rt_light point = {middle, one};
    rt_scene scene = {.boxes = walls, .box_count = 6, .lights = &point, .light_count = 1};
    double off;
    make_walls(0.5f);
    printf("balance: %.3f\n", 0.5 / pi * 4 * pi / (0.5 * 5));
    printf("point-part: %.3f\n", 0.8 * 5 / 6);
    printf("point: %.3f\n", light(&scene, 200000, &off));
    printf("point-off: %.3f\n", off);

    rt_lamp lamp = {.center = middle, .radius = r, .intensity = one};
    scene.light_count = 0;
    scene.lamps = &lamp;
    scene.lamp_count = 1;
    const double grey = light(&scene, 400000, &off);
    printf("lamp: %.3f\nlamp-off: %.3f\n", grey, off);
    /* what comes to the lamp: the radiance on its surface, 4 pi R^2, from all sides */
    double comes = 0;
    enum { N = 100000 };
    rt_rng rng = rt_rng_start(0, 0, 2);
    for (uint32_t i = 0; i < N; i++) {
        const float z = 2 * rt_random(&rng) - 1, side = sqrtf(1 - z * z);
        float s, c;
        rt_sincos(rt_random(&rng), &s, &c);
        const rt_vec3 n = {side * c, side * s, z};
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_ray ray = {rt_add(middle, rt_scale(n, 1.001f * r)),
                            rt_sample_cosine(n, r1, r2)};
        rt_rng path = rt_rng_start(i, 0, 3);
        comes += (double)rt_radiance_mis(&scene, &ray, RT_ALL_BOUNCES, &path).x / N;
    }
    const double takes = pi * 4 * pi * (double)(r * r) * comes;
    printf("lamp-takes: %.1f\nlamp-balance: %.3f\n", 100 * takes / (4 * pi),
           0.5 / pi * (4 * pi - takes) / (0.5 * 5));

    /* A larger one: with many bounces and few ends, roulette is too much of a gamble. */
    make_walls(1);
    lamp.radius = 0.2f;
    lamp.intensity = rt_scale(one, 4 * area);
    printf("white: %.3f\n", light(&scene, 500000, &off));
    printf("white-off: %.3f\n", off);
}

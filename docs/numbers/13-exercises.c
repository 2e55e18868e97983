/* Chapter 13, exercises 2 to 5: a mirror ball in a beam, 1/21, the furnace by samples, and a
 * lacquer whose sampler forgets one of its two lobes. */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdio.h>

static const rt_vec3 N = {0, 0, 1};
static rt_rng rng;

/* Parallel rays straight down onto a mirror ball: how many leave in each quarter of all heights. */
static void beam(void)
{
    const rt_sphere ball = {{0, 0, 0}, 1, {{1, 1, 1}, true}};
    int count[4] = {0};
    for (int i = 0; i < 1000000;) {
        const float x = 2 * rt_random(&rng) - 1, y = 2 * rt_random(&rng) - 1;
        const rt_ray ray = {{x, y, 5}, {0, 0, -1}};
        rt_hit hit;
        if (!rt_hit_sphere(&ball, &ray, FLT_MAX, &hit))
            continue;
        const float z = rt_reflect(ray.direction, hit.normal).z;
        count[z < -0.5f ? 0 : z < 0 ? 1 : z < 0.5f ? 2 : 3]++;
        i++;
    }
    printf("beam: %.1f, %.1f, %.1f and %.1f\n", count[0] / 1e4, count[1] / 1e4,
           count[2] / 1e4, count[3] / 1e4);
}

/* The mean of (1 - c)^5 over directions drawn with the cosine. */
static void fifth(void)
{
    double sum = 0;
    for (int i = 0; i < 1000000; i++) {
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        sum += pow(1 - (double)rt_sample_cosine(N, r1, r2).z, 5) / 1e6;
    }
    printf("fifth: %.4f\nschlick: %.4f\n", sum, 0.04 + 0.96 * sum);
}

static rt_vec3 eye_at(double degrees)
{
    const double a = degrees * 3.14159265358979 / 180;
    return rt_vec((float)sin(a), 0, (float)cos(a));
}

/* What a white metal of shininess 50 sends on if light 1 comes from everywhere; and the
 * same with samples that point below the surface counted as good ones. */
static void furnace(void)
{
    const rt_vec3 eye = eye_at(60);
    double sum = 0;
    int below = 0;
    for (int i = 0; i < 1000000; i++) {
        float density;
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 L = rt_sample_gloss(N, eye, 50, r1, r2);
        const float value = rt_gloss(N, eye, L, 50, &density);
        if (density > 0)
            sum += (double)(value / density) / 1e6;
        else
            below++;
    }
    printf("furnace: %.3f\nbelow: %.1f\n", sum, below / 1e4);
}

/* A white lacquer of shininess 300 in the furnace: all of it over the density of the mixture;
 * all of it over the density of the lobe that was drawn. */
static void mixture(void)
{
    const rt_vec3 eye = eye_at(45);
    const rt_brdf finish = {{1, 1, 1}, 300, false};
    const float chance = rt__gloss_chance(&finish, N, eye);
    double right = 0, right2 = 0, wrong = 0;
    const int n = 4000000;
    for (int i = 0; i < n; i++) {
        float both, gloss;
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 L = rt_sample_brdf(&finish, N, eye, r1, r2);
        const float value = rt_scatter(&finish, N, eye, L, &both).x;
        rt_gloss(N, eye, L, 300, &gloss);
        if (!(both > 0))
            continue;
        const float own = r1 < chance ? chance * gloss : (1 - chance) * L.z / 3.14159265f;
        right += (double)(value / both) / n;
        right2 += pow((double)(value / both), 2) / n;
        wrong += own > 0 ? (double)(value / own) / n : 0;
    }
    printf("right: %.3f\nright-sigma: %.2f\nwrong: %.3f\nchance: %.1f\n", right,
           sqrt(right2 - right * right), wrong, 100 * chance);
}

int main(void)
{
    rng = rt_rng_start(0, 0, 0);
    beam();
    fifth();
    furnace();
    mixture();
}

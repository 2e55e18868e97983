/* Chapter 4: does a closed box let rays out? A box seen from its middle, no lamp, and a
 * bright background, which nobody inside must see. Twelve million paths of 5 bounces: how
 * many get out, (a) with hits as rt_intersect gives them, with the point pulled into the
 * box, and (b) as rt_hit_box does, with the point exactly on the plane of the face? */
#define RT_IMPLEMENTATION
#define rt_intersect one_box
#include "rt.h"
#include <stdio.h>

enum { N = 12000000 };

static bool pull;

static inline bool one_box(const rt_scene *scene, const rt_ray *ray, rt_hit *hit)
{
    if (!pull)
        return rt_hit_box(scene->boxes, ray, FLT_MAX, hit);
    const float t = rt__meet_box(scene->boxes, ray, FLT_MAX); /* what rt_intersect does */
    return t > 0 && rt__hit_shape(scene, 0, ray, (double)t, hit);
}

static int leaks(rt_vec3 min, rt_vec3 max)
{
    const rt_box box = {min, max, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_scene scene = {.boxes = &box, .box_count = 1, .background = {1, 1, 1}};
    int count = 0;
#pragma omp parallel for reduction(+ : count)
    for (int i = 0; i < N; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 0);
        rt_ray ray = {rt_scale(rt_add(min, max), 0.5f), {0, 0, 0}};
        ray.direction.x = rt_random(&rng) - 0.5f;
        ray.direction.y = rt_random(&rng) - 0.5f;
        ray.direction.z = rt_random(&rng) - 0.5f;
        count += rt_radiance(&scene, &ray, 5, &rng).x > 0;
    }
    return count;
}

int main(void)
{
    int n[2][2];
    for (int i = 0; i < 2; i++) {
        pull = i == 0;
        n[i][0] = leaks(rt_vec(-50, -20, -66), rt_vec(50, 41, 105));
        n[i][1] = leaks(rt_vec(1000, 1000, 1000), rt_vec(1008, 1006, 1010));
    }
    printf("| of %d paths get out | pulled into the box | not pulled |\n|---|---|---|\n"
           "| box of 100 x 61 x 171 around the origin | %d | %d |\n"
           "| box of 8 x 6 x 10 at (1000, 1000, 1000) | %d | %d |\n",
           N, n[0][0], n[1][0], n[0][1], n[1][1]);
}

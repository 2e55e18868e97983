/* Chapter 8, exercise 3: microseconds for a ray, without the tree and with it. */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <omp.h>
#include <stdio.h>
#include <stdlib.h>

static rt_sphere spheres[64000];

static double microseconds(const rt_scene *scene, int rays, double *sum)
{
    rt_rng rng = rt_rng_start(1, 0, 0);
    const double start = omp_get_wtime();
    *sum = 0;
    for (int k = 0; k < rays; k++) {
        float r[4];
        for (int i = 0; i < 4; i++)
            r[i] = rt_random(&rng);
        const rt_ray ray = {{r[0], r[1], -1}, {r[2] - r[0], r[3] - r[1], 2}};
        rt_hit hit;
        if (rt_intersect(scene, &ray, &hit) && k < 2000)
            *sum += (double)hit.t;
    }
    return (omp_get_wtime() - start) / rays * 1e6;
}

int main(void)
{
    const int counts[3] = {1000, 8000, 64000};
    double without[3], with[3];
    for (int i = 0; i < 3; i++) {
        rt_rng rng = rt_rng_start(0, 0, 0);
        for (int k = 0; k < counts[i]; k++) {
            float r[3];
            for (int j = 0; j < 3; j++)
                r[j] = rt_random(&rng);
            spheres[k].center = rt_vec(r[0], r[1], r[2]);
            spheres[k].radius = 0.3f / cbrtf((float)counts[i]);
        }
        rt_scene scene = {.spheres = spheres, .sphere_count = counts[i]};
        rt_bvh bvh;
        double plain_sum, tree_sum;
        without[i] = microseconds(&scene, 2000, &plain_sum);
        if (rt_build_bvh(&scene, &bvh) != RT_OK)
            return 1;
        scene.bvh = &bvh;
        with[i] = microseconds(&scene, 50000, &tree_sum);
        rt_free_bvh(&bvh);
        if (plain_sum != tree_sum)
            return 1;
    }
    printf("| spheres | 1000 | 8000 | 64 000 |\n|---|---|---|---|\n"
           "| without, millionths of a second for a ray | %.1f | %.0f | %.0f |\n"
           "| with the tree | %.2f | %.2f | %.2f |\n",
           without[0], without[1], without[2], with[0], with[1], with[2]);
}

/* Chapter 8, exercise 2: boxes around spheres, one level. Questions asked for each ray. */
#include "rt.h"
#include <stdio.h>

enum { N = 8000, MOST = 16 };
static rt_sphere spheres[N], sorted[N];
static rt_box boxes[MOST * MOST * MOST];
static int start[MOST * MOST * MOST + 1];

static void sort(int g)
{
    const float r = 0.015f, size = 1.0f / (float)g;
    int n = 0;
    for (int c = 0; c < g * g * g; c++) {
        const int ix = c / (g * g), iy = c / g % g, iz = c % g;
        start[c] = n;
        for (int i = 0; i < N; i++) {
            const rt_vec3 O = rt_scale(spheres[i].center, (float)g);
            if ((int)O.x == ix && (int)O.y == iy && (int)O.z == iz)
                sorted[n++] = spheres[i];
        }
        boxes[c].min =
            rt_vec((float)ix * size - r, (float)iy * size - r, (float)iz * size - r);
        boxes[c].max =
            rt_add(boxes[c].min, rt_vec(size + 2 * r, size + 2 * r, size + 2 * r));
    }
    start[g * g * g] = n;
}

int main(void)
{
    rt_rng spheres_rng = rt_rng_start(0, 0, 0);
    for (int i = 0; i < N; i++) {
        float r[3];
        for (int k = 0; k < 3; k++)
            r[k] = rt_random(&spheres_rng);
        spheres[i] = (rt_sphere){{r[0], r[1], r[2]}, 0.015f, {{1, 1, 1}, false}};
    }
    const rt_scene scene = {.spheres = spheres, .sphere_count = N};
    for (int g = 2; g <= MOST; g *= 2) {
        rt_rng rng = spheres_rng;
        int questions = 0, hits = 0, same = 0;
        sort(g);
        for (int k = 0; k < 2000; k++) {
            float r[4];
            for (int i = 0; i < 4; i++)
                r[i] = rt_random(&rng);
            const rt_ray ray = {{r[0], r[1], -1}, {r[2] - r[0], r[3] - r[1], 2}};
            rt_hit hit;
            float t = FLT_MAX;
            for (int c = 0; c < g * g * g; c++) {
                questions++;
                if (!rt_hit_box(&boxes[c], &ray, t, &hit))
                    continue;
                for (int i = start[c]; i < start[c + 1]; i++) {
                    questions++;
                    if (rt_hit_sphere(&sorted[i], &ray, t, &hit))
                        t = hit.t;
                }
            }
            const bool found = rt_intersect(&scene, &ray, &hit);
            hits += found;
            same += t == (found ? hit.t : FLT_MAX);
        }
        printf("by%d: %d\nsame%d: %d\nhits: %d\n", g, questions / 2000, g, same, hits);
    }
}

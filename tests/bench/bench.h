/* What the programs that measure share: wall-clock time, and a scene that grows. */
#ifndef BENCH_H
#define BENCH_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "../../demos/scene.h"
#include "../meshes.h" /* need */

static inline double seconds(void)
{
    struct timespec now;
    clock_gettime(CLOCK_MONOTONIC, &now);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

/* count spheres at random places in the room, which together always fill a twentieth of it: so
 * a ray meets about as much whatever the count, and what grows is the search. Every tenth is a
 * mirror. The first five are the walls. */
static inline rt_sphere *many_spheres(int count)
{
    rt_sphere *spheres = need(malloc((size_t)(count + 5) * sizeof *spheres));
    const rt_vec3 low = {-45, -18, -55}, size = {90, 54, 95};
    const double volume = (double)size.x * (double)size.y * (double)size.z;
    const float radius = (float)cbrt(0.05 * volume / (4.18879 * count));
    memcpy(spheres, room_spheres + 1, 5 * sizeof *spheres);
    rt_rng rng = rt_rng_start((uint32_t)count, 0, 0);
    for (int i = 5; i < count + 5;) {
        const float x = rt_random(&rng), y = rt_random(&rng), z = rt_random(&rng);
        const rt_vec3 center = rt_add(low, rt_mul(size, rt_vec(x, y, z)));
        const rt_vec3 to_light = rt_sub(room_dim_light.position, center);
        if (rt_length(to_light) < radius + 1.0f)
            continue; /* a lamp within a sphere lights nothing else */
        spheres[i].center = center;
        spheres[i].radius = radius;
        spheres[i].material.mirror = i % 10 == 0;
        spheres[i].material.albedo =
            rt_vec(0.5f + 0.4f * x, 0.5f + 0.4f * y, 0.5f + 0.4f * z);
        i++;
    }
    return spheres;
}

#endif

/* Chapter 6, exercises 2 and 3: what is seen in a mirror, and a corner of three. */
#include "rt.h"
#include <stdio.h>

static void go_on(rt_ray *ray, const rt_hit *hit)
{
    ray->direction = rt_reflect(ray->direction, hit->normal);
    ray->origin = rt_leave(hit->point, hit->normal, ray->direction);
}

int main(void)
{
    const rt_box mirror = {{-10, -10, 0}, {10, 10, 0}, {{1, 1, 1}, true}};
    const rt_sphere ball = {{1, 2, 5}, 1, {{1, 1, 1}, false}};
    const rt_sphere image = {{1, 2, -5}, 1, {{1, 1, 1}, false}};
    const rt_vec3 C = {-3, 0, 8};
    rt_ray ray = {C, rt_normalize(rt_sub(image.center, C))};
    rt_hit first, second, straight;
    rt_hit_sphere(&image, &ray, FLT_MAX, &straight);
    rt_hit_box(&mirror, &ray, FLT_MAX, &first);
    go_on(&ray, &first);
    rt_hit_sphere(&ball, &ray, FLT_MAX, &second);
    printf("sum: %g + %g = %g\nstraight: %g\n", first.t, second.t, first.t + second.t,
           straight.t);

    const rt_box corner[3] = {{{0, 0, 0}, {0, 100, 100}, {{1, 1, 1}, true}},
                              {{0, 0, 0}, {100, 0, 100}, {{1, 1, 1}, true}},
                              {{0, 0, 0}, {100, 100, 0}, {{1, 1, 1}, true}}};
    const rt_scene scene = {.boxes = corner, .box_count = 3};
    rt_rng rng = rt_rng_start(0, 0, 0);
    int three = 0, exact = 0;
    for (int i = 0; i < 1000; i++) {
        float r[6];
        for (int k = 0; k < 6; k++)
            r[k] = rt_random(&rng);
        const rt_vec3 to =
            rt_vec(0.3f + 0.1f * r[0], 0.3f + 0.1f * r[1], 0.3f + 0.1f * r[2]);
        const rt_vec3 from = rt_vec(1 + r[3], 1 + r[4], 1 + r[5]);
        ray = (rt_ray){from, rt_normalize(rt_sub(to, from))};
        const rt_vec3 u = ray.direction;
        int bounces = 0;
        for (rt_hit hit; rt_intersect(&scene, &ray, &hit); bounces++)
            go_on(&ray, &hit);
        three += bounces == 3;
        exact += rt_length(rt_add(u, ray.direction)) == 0;
    }
    printf("three: %d\nexact: %d\n", three, exact);
}

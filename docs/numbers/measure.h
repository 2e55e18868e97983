/* The volume of a shape, from the lengths of rays in it: chapter 17. */
#ifndef MEASURE_H
#define MEASURE_H

#include "rt.h"

static double volume_of(const rt_custom_shape *shape)
{
    enum { GRID = 400 }; /* rays in each direction */
    const rt_vec3 middle = rt_scale(rt_add(shape->min, shape->max), 0.5f);
    const float size = rt_length(rt_sub(shape->max, shape->min)); /* more than enough */
    const rt_vec3 u = rt_normalize(rt_vec(1, -2, 3));
    rt_vec3 x, y;
    rt_basis(u, &x, &y);
    double sum = 0;
    for (int i = 0; i < GRID * GRID; i++) {
        const float right = size * (((float)(i % GRID) + 0.5f) / GRID - 0.5f);
        const float up = size * (((float)(i / GRID) + 0.5f) / GRID - 0.5f);
        const rt_vec3 beside = rt_add(rt_scale(x, right), rt_scale(y, up));
        rt_ray ray = {rt_sub(rt_add(middle, beside), rt_scale(u, size)), u};
        rt_hit hit;
        for (int n = 0; n < 99 && rt_hit_custom_shape(shape, &ray, FLT_MAX, &hit); n++) {
            if (hit.inside)
                sum += (double)hit.t;
            ray.origin = rt_leave(hit.point, hit.normal, u);
        }
    }
    return sum * pow((double)size / GRID, 2);
}

#endif

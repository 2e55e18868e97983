/* Writes out of bounds. */
#define rt_reflect my_reflect
#include "rt.h"

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    rt_vec3 two[2] = {incident, normal};
    volatile rt_vec3 *out = two;
    for (int i = 0; i < 10000000; i++)
        out[i] = incident;
    return rt_sub(two[0], rt_scale(two[1], 2 * rt_dot(two[0], two[1])));
}

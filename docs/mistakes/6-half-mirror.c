/* Half a reflection
 *
 * Symptom: the mirror shows a shrunken, speckled image
 * Cause:   I - <I,N> N subtracts the part along the normal once, so the ray runs along
 *          the surface
 * Cure:    subtract it twice: I - 2 <I,N> N
 * Options:
 */
#define rt_reflect my_reflect
#include "rt.h"

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_sub(incident, rt_scale(normal, rt_dot(incident, normal)));
}

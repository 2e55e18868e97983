/* The mirror that is not there
 *
 * Symptom: a black or see-through ball in place of the mirror
 * Cause:   R = I: the direction was not changed
 * Cure:    I - 2 <I,N> N
 * Options:
 */
#define rt_reflect my_reflect
#include "rt.h"

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    (void)normal;
    return incident;
}

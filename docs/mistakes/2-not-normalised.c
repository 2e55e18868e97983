/* L not made a unit vector
 *
 * Symptom: burnt to white, exactly like "d for d squared": a cosine that is d times too
 *          large, divided by d squared, is the same
 * Cause:   <N,L> with L = S - P, whose length is d, is the cosine times d
 * Cure:    divide L by its length first
 * Options:
 */
#define rt_lambert my_lambert
#include "rt.h"

static inline rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    const float dd = rt_dot(to_light, to_light);
    const float cosine = rt_dot(normal, to_light);
    return rt_scale(rt_mul(albedo, intensity),
                    cosine > 0 ? cosine / (3.14159265f * dd) : 0);
}

/* d for d squared
 *
 * Symptom: burnt to white, near the lamp and far from it
 * Cause:   the light was divided by the distance, not by its square
 * Cure:    I / d^2
 * Options:
 */
#define rt_lambert my_lambert
#include "rt.h"

static inline rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    const float dd = rt_dot(to_light, to_light);
    const float cosine = rt_dot(normal, to_light) / sqrtf(dd);
    return rt_scale(rt_mul(albedo, intensity),
                    cosine > 0 ? cosine / (3.14159265f * sqrtf(dd)) : 0);
}

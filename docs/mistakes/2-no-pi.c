/* 1/pi forgotten
 *
 * Symptom: more than three times too bright; bright parts are plain white
 * Cause:   a matt surface spreads its light over the hemisphere: albedo *by pi*
 * Cure:    albedo / pi
 * Options:
 */
#define rt_lambert my_lambert
#include "rt.h"

static inline rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    const float dd = rt_dot(to_light, to_light);
    const float cosine = rt_dot(normal, to_light) / sqrtf(dd);
    return rt_scale(rt_mul(albedo, intensity), cosine > 0 ? cosine / (dd) : 0);
}

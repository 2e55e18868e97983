/* Without 1/pi. */
#define rt_lambert my_lambert
#include "rt.h"

static inline rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    const float d = rt_length(to_light);
    const float cosine = rt_dot(normal, to_light) / d;
    return rt_scale(rt_mul(albedo, intensity), (cosine > 0 ? cosine : 0) / (d * d));
}

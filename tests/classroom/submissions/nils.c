/* Schlick's approximation with the angle inside, and total reflection forgotten. */
#define rt_fresnel my_fresnel
#define rt_refract my_refract
#include "rt.h"

static inline float my_fresnel(float cosine, float eta)
{
    const float r = (1 - eta) / (1 + eta);
    return r * r + (1 - r * r) * powf(1 - cosine, 5);
}

static inline bool my_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted)
{
    const rt_vec3 flat =
        rt_scale(rt_sub(incident, rt_scale(normal, rt_dot(incident, normal))), 1 / eta);
    *refracted = rt_sub(flat, rt_scale(normal, sqrtf(fabsf(1 - rt_dot(flat, flat)))));
    return true;
}

/* Phong's lobe
 *
 * Symptom: metal gets darker towards its rim, where real things get brighter
 * Cause:   not an error of the program: this lobe loses light. Part of it is below the
 *          surface, and at 60 degrees the cosine <N,L> has halved the rest, whatever the
 *          exponent
 * Cure:    facets
 * Options:
 */
#define rt_sample_gloss my_sample_gloss
#define rt_gloss my_gloss
#include "rt.h"

static inline rt_vec3 my_mirrored(rt_vec3 normal, rt_vec3 to_eye)
{
    return rt_sub(rt_scale(normal, 2.0f * rt_dot(normal, to_eye)), to_eye);
}

static inline rt_vec3 my_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2)
{
    const rt_vec3 mirrored = my_mirrored(normal, to_eye);
    const float z = powf(r2, 1.0f / (shininess + 1.0f)), r = sqrtf(1.0f - z * z);
    float sine, cosine;
    rt_vec3 a, b;
    rt_sincos(r1, &sine, &cosine);
    rt_basis(mirrored, &a, &b);
    return rt_add(rt_add(rt_scale(a, cosine * r), rt_scale(b, sine * r)),
                  rt_scale(mirrored, z));
}

static inline float my_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density)
{
    const float light = rt_dot(normal, to_light);
    const float c = rt_dot(my_mirrored(normal, to_eye), to_light);
    *density = 0.0f;
    if (!(rt_dot(normal, to_eye) > 0.0f && light > 0.0f && c > 0.0f))
        return 0.0f;
    const float lobe = powf(c, shininess) / 6.28318530718f;
    *density = (shininess + 1.0f) * lobe;
    return (shininess + 2.0f) * lobe * light;
}

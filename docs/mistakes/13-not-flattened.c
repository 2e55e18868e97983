/* A hemisphere of facets
 *
 * Symptom: metal is dark and grainy; only the highlight of the lamp, which is aimed at,
 *          is as it should be
 * Cause:   the normal was chosen on the stretched surface, and used without going back.
 *          So the facets face all ways with the same probability, whatever the shininess
 * Cure:    back to the real surface: x and y of the normal times a, then length 1
 * Options:
 */
#define rt_sample_gloss my_sample_gloss
#include "rt.h"

static inline rt_vec3 my_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2)
{
    const float a = sqrtf(2.0f / (shininess + 2.0f));
    rt_vec3 x, y;
    rt_basis(normal, &x, &y);
    const rt_vec3 eye = rt_normalize(
        rt_vec(a * rt_dot(x, to_eye), a * rt_dot(y, to_eye), rt_dot(normal, to_eye)));
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const float z = (1.0f - r2) * (1.0f + eye.z) - eye.z, zz = 1.0f - z * z;
    const float r = sqrtf(zz > 0.0f ? zz : 0.0f);
    const rt_vec3 half = rt_vec(r * cosine + eye.x, r * sine + eye.y, z + eye.z);
    const rt_vec3 facet = rt_normalize(rt_add(
        rt_add(rt_scale(x, half.x), rt_scale(y, half.y)), rt_scale(normal, half.z)));
    return rt_sub(rt_scale(facet, 2.0f * rt_dot(to_eye, facet)), to_eye);
}

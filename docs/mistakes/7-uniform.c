/* Uniform directions without the cosine
 *
 * Symptom: hard to see: corners and edges are a little too dark, and what faces a bright
 *          floor or wall at a flat angle is too bright. Two pictures with many samples
 *          show it, or the mean of the light
 * Cause:   the directions are uniform on the hemisphere, but the estimate leaves out the
 *          cosine, as if their density had it
 * Cure:    cosine-weighted directions; or uniform ones, and 2 <N,w> as a factor
 * Options:
 */
#define rt_sample_cosine my_sample_cosine
#include "rt.h"

static inline rt_vec3 my_sample_cosine(rt_vec3 normal, float r1, float r2)
{
    const float radius = sqrtf(1 - r2 * r2);
    float sine, cosine;
    rt_vec3 a, b;
    rt_sincos(r1, &sine, &cosine);
    rt_basis(normal, &a, &b);
    return rt_add(rt_add(rt_scale(a, cosine * radius), rt_scale(b, sine * radius)),
                  rt_scale(normal, r2));
}

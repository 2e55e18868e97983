/* N x a fixed vector
 *
 * Symptom: one side of the cube has no indirect light: it is too dark, and without grain.
 *          In other programs there are black specks
 * Cause:   the cross product with (1,0,0) is zero where the normal is (1,0,0) itself.
 *          Divided by its length it is NaN, and a ray along NaN meets nothing
 * Cure:    a basis that works for every normal (rt_basis)
 * Options:
 */
#define rt_sample_cosine my_sample_cosine
#include "rt.h"

static inline rt_vec3 my_sample_cosine(rt_vec3 normal, float r1, float r2)
{
    const rt_vec3 wide = rt_cross(normal, rt_vec(1, 0, 0)); /* zero on the cube's sides */
    const rt_vec3 a = rt_scale(wide, 1 / rt_length(wide)), b = rt_cross(normal, a);
    const float radius = sqrtf(1 - r2);
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    return rt_add(rt_add(rt_scale(a, cosine * radius), rt_scale(b, sine * radius)),
                  rt_scale(normal, sqrtf(r2)));
}

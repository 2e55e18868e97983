/* 1.5 both ways
 *
 * Symptom: the picture in the ball is upright and not upside down, in a ring of floor,
 *          and a dark patch hangs in it; the cube hardly differs
 * Cause:   1.5 is the index of glass over that of air; on the way out, it must be air
 *          over glass
 * Cure:    1 / 1.5 for a ray that comes from inside
 * Options:
 */
#define rt_refract my_refract
#include "rt.h"

static inline bool my_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted)
{
    eta = eta < 1 ? 1 / eta : eta;
    const float cosine = -rt_dot(incident, normal);
    const float sin2 = (1 - cosine) * (1 + cosine) / (eta * eta);
    if (!(sin2 < 1))
        return false;
    *refracted = rt_add(rt_scale(incident, 1 / eta),
                        rt_scale(normal, cosine / eta - sqrtf(1 - sin2)));
    return true;
}

/* Bent away from the normal
 *
 * Symptom: a black ring in the ball, with the room upright and small in its middle, and
 *          mirrored all around it
 * Cause:   sin t = eta sin i: Snell's law the wrong way round
 * Cure:    sin i = eta sin t; into glass a ray is bent *towards* the normal
 * Options:
 */
#define rt_refract my_refract
#include "rt.h"

static inline bool my_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted)
{
    const float cosine = -rt_dot(incident, normal);
    const float sin2 = (1 - cosine) * (1 + cosine) * (eta * eta);
    if (!(sin2 < 1))
        return false;
    *refracted =
        rt_add(rt_scale(incident, eta), rt_scale(normal, eta * cosine - sqrtf(1 - sin2)));
    return true;
}

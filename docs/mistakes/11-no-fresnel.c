/* All of it goes through
 *
 * Symptom: no reflections: the top of the ball has lost the sheen of the ceiling, its
 *          right edge is plain red, and one looks straight through the top and the
 *          left side of the cube, which should be pale with reflections
 * Cause:   every ray that can be refracted is; glass reflects, too, and at a flat angle
 *          nearly all
 * Cure:    Fresnel's F, and a coin
 * Options:
 */
#define rt_fresnel my_fresnel
#include "rt.h"

static inline float my_fresnel(float cosine, float eta)
{
    const float sin2 = (1 - cosine * cosine) / (eta * eta);
    return sin2 < 1 ? 0.0f : 1.0f;
}

/* All of it goes through
 *
 * Symptom: no reflections: the top of the ball has lost the sheen of the ceiling, its
 *          right edge is plain red, and the top and the left side of the cube, which
 *          should be pale with reflections, are clear
 * Cause:   every ray that can be refracted is refracted; but glass also reflects, and at
 *          a flat angle it reflects nearly everything
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

/* Schlick with the angle inside
 *
 * Symptom: hard to see: reflections inside the glass are too weak just before the
 *          critical angle; the cube and the edge of the ball are a little off. A test
 *          sees it
 * Cause:   (1 - cos)^5 needs the angle in air. From inside it got the angle in the glass,
 *          and F jumps from 0.04 to 1 at the critical angle
 * Cure:    the larger of the two angles; or Fresnel's own formula, which takes either
 * Options:
 */
#define rt_fresnel my_fresnel
#include "rt.h"

static inline float my_fresnel(float cosine, float eta)
{
    if ((1 - cosine * cosine) / (eta * eta) >= 1)
        return 1;
    const float f0 = (1 - eta) * (1 - eta) / ((1 + eta) * (1 + eta));
    const float x = 1 - cosine;
    return f0 + (1 - f0) * x * x * x * x * x;
}

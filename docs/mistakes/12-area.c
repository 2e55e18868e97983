/* Area for solid angle
 *
 * Symptom: burnt to white; near the lamp it is only too bright, or even too dark, because
 *          the distance no longer counts
 * Cause:   1 / area of the lamp is a density per square unit, but the sum is over
 *          directions, per steradian: d^2 / cos is missing
 * Cure:    1 / (2 pi (1 - cos a)), or d^2 / (A cos b)
 * Options:
 */
#define rt_lamp_density my_lamp_density
#include "rt.h"

static inline float my_lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    (void)point, (void)direction;
    return 1 / (3.14159265359f * lamp->radius * lamp->radius);
}

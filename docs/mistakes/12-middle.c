/* Always the middle of the lamp
 *
 * Symptom: the shadows have hard edges, as in chapter 4; everything else is right
 * Cause:   every surface aims at the same point, so the lamp is that of chapter 4
 * Cure:    a random direction in the cone, drawn with the density by which it is divided
 * Options:
 */
#define rt_sample_lamp my_sample_lamp
#include "rt.h"

static inline rt_vec3 my_sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2)
{
    (void)point, (void)r1, (void)r2;
    return lamp->center;
}

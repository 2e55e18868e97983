/* Points all over the ball
 *
 * Symptom: hard to see: the edges of shadows are soft, but of another shape. The tests
 *          see it
 * Cause:   the point is drawn uniformly on the whole ball, its back included, but the
 *          density is that of the cone
 * Cure:    draw what you divide by: 1 - cos uniform in (0, 1 - cos a)
 * Options:
 */
#define rt_sample_lamp my_sample_lamp
#include "rt.h"

static inline rt_vec3 my_sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2)
{
    float s, c;
    rt_sincos(r1, &s, &c);
    const float z = 1 - 2 * r2, side = sqrtf(1 - z * z);
    (void)point;
    return rt_add(lamp->center, rt_scale(rt_vec(side * c, side * s, z), lamp->radius));
}

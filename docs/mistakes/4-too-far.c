/* Too large a step
 *
 * Symptom: light leaks in where things touch: shadows do not begin at the foot of
 *          the cube and ball
 * Cause:   the step off the surface jumps over what is near
 * Cure:    as small as rounding allows: 1e-6 of the coordinates
 * Options: --bounces 0
 */
#define rt_leave my_leave
#include "rt.h"

static inline rt_vec3 my_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)
{
    const float step = rt_dot(normal, direction) < 0 ? -5.0f : 5.0f;
    return rt_add(point, rt_scale(normal, step));
}

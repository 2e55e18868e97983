/* A step to the wrong side
 *
 * Symptom: black: everything is in its own shadow
 * Cause:   the step goes against the normal, below the surface
 * Cure:    along the normal, on the side of the ray
 * Options:
 */
#define rt_leave my_leave
#include "rt.h"

static inline rt_vec3 my_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)
{
    const float step = rt_dot(normal, direction) < 0 ? 1e-3f : -1e-3f;
    return rt_add(point, rt_scale(normal, step));
}

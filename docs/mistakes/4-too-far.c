/* Too large a step
 *
 * Symptom: dark lines along the edges of the room, and all shadows shifted
 * Cause:   so far above the surface, a point near an edge is already in the next wall,
 *          and the shadow is that of another point
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

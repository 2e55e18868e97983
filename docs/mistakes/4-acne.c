/* No step off the surface
 *
 * Symptom: salt and pepper, and everything a third darker: shadow acne. Only the cube,
 *          whose points are exact, is as bright as before
 * Cause:   the point is rounded, and half of the time it lies below its surface,
 *          which then shadows itself
 * Cure:    start a little off the surface, on the side to which the ray goes (rt_leave)
 * Options:
 */
#define rt_leave my_leave
#include "rt.h"

static inline rt_vec3 my_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)
{
    (void)normal, (void)direction;
    return point;
}

/* Never gets in
 *
 * Symptom: dark, speckled glass: all that you see is reflection; what should come from
 *          behind arrives late or never
 * Cause:   every ray starts on the side of the normal, which is right for a reflection.
 *          But a refracted ray goes to the other side, and meets the surface that it has
 *          just left, again and again
 * Cure:    start a little off the surface, on the side to which the ray *goes* (rt_leave)
 * Options:
 */
#define rt_leave my_leave
#include "rt.h"

static inline rt_vec3 my_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)
{
    (void)direction;
    return rt_add(point, rt_scale(normal, 1e-3f));
}

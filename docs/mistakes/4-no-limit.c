/* A shadow ray without an end
 *
 * Symptom: a closed room is almost entirely black
 * Cause:   the ceiling, which is *behind* the lamp, counts as standing in front of it
 * Cure:    only hits nearer than the lamp: t < 1 for a direction S - P
 * Options:
 */
#define rt_visible my_visible
#include "rt.h"

static inline bool my_visible(const rt_scene *scene, rt_vec3 point, rt_vec3 normal,
                              rt_vec3 light)
{
    rt_ray shadow;
    shadow.origin = rt_leave(point, normal, rt_sub(light, point));
    shadow.direction = rt_sub(light, shadow.origin);
    return !rt_occluded(scene, &shadow, FLT_MAX);
}

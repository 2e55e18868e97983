/* The last hit, not the nearest
 *
 * Symptom: what comes first in the list vanishes behind what comes last: the ball is
 *          gone, and all walls but the last are nearly black
 * Cause:   the loop over the shapes keeps the last hit in place of the nearest
 * Cure:    keep a hit only if its t is smaller than the smallest so far
 * Options:
 */
#define rt_intersect my_intersect
#include "rt.h"

static inline bool my_intersect(const rt_scene *scene, const rt_ray *ray, rt_hit *hit)
{
    bool found = false;
    for (int i = 0; i < scene->sphere_count; i++)
        found = rt_hit_sphere(&scene->spheres[i], ray, FLT_MAX, hit) || found;
    for (int i = 0; i < scene->box_count; i++)
        found = rt_hit_box(&scene->boxes[i], ray, FLT_MAX, hit) || found;
    return found;
}

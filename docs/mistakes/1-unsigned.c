/* An unsigned difference
 *
 * Symptom: three quarters of the picture have no shape, only grain; the last quarter is
 *          right, but in another place
 * Cause:   x - width / 2 in unsigned numbers: left of the middle it is not negative
 *          but four billion
 * Cure:    signed numbers, or float, before the subtraction
 * Options:
 */
#define rt_camera_ray my_camera_ray
#include "rt.h"

static inline rt_ray my_camera_ray(const rt_camera *camera, int width, int height,
                                   float x, float y)
{
    const rt_vec3 forward = rt_normalize(camera->direction);
    const rt_vec3 right = rt_normalize(rt_cross(forward, camera->up));
    const rt_vec3 top = rt_cross(right, forward);
    const float size = 2 * tanf(camera->fov_y * 3.14159265f / 360) / (float)height;
    const float to_right = size * (float)((unsigned)x - (unsigned)width / 2);
    const float to_top = size * (float)((unsigned)height / 2 - (unsigned)y);
    rt_ray ray;
    ray.origin = camera->position;
    ray.direction = rt_normalize(
        rt_add(forward, rt_add(rt_scale(right, to_right), rt_scale(top, to_top))));
    return ray;
}

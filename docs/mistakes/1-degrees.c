/* Degrees for radians
 *
 * Symptom: far too wide: the room is a small thing at the end of a tunnel; or the picture
 *          is upside down, or empty
 * Cause:   tan() wants radians, and got 23 for 23 degrees
 * Cure:    degrees * pi / 180, in one place
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
    const float size = 2 * tanf(camera->fov_y / 2) / (float)height;
    const float to_right = size * (x - 0.5f * (float)width);
    const float to_top = size * (0.5f * (float)height - y);
    rt_ray ray;
    ray.origin = camera->position;
    ray.direction = rt_normalize(
        rt_add(forward, rt_add(rt_scale(right, to_right), rt_scale(top, to_top))));
    return ray;
}

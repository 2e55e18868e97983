/* Sharp on a sphere
 *
 * Symptom: hard to see: sharp in the middle, but towards the sides nearer things are
 *          sharp instead
 * Cause:   the focus is taken along the ray, and not along the axis, so the sharp points
 *          lie on a sphere around the camera
 * Cure:    focus / <direction, forward> along the ray, of length 1
 * Options:
 */
#define rt_lens_ray my_lens_ray
#include "rt.h"

static inline rt_ray my_lens_ray(const rt_camera *camera, const rt_lens *lens,
                                 const rt_ray *pinhole, float r1, float r2)
{
    const rt_vec3 forward = rt_normalize(camera->direction);
    const rt_vec3 right = rt_normalize(rt_cross(camera->direction, camera->up));
    const rt_vec3 top = rt_cross(right, forward);
    const float radius = lens->radius * sqrtf(r2);
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const rt_vec3 aside =
        rt_add(rt_scale(right, radius * cosine), rt_scale(top, radius * sine));
    rt_ray ray = *pinhole;
    ray.origin = rt_add(ray.origin, aside);
    const rt_vec3 sharp = rt_scale(pinhole->direction, lens->focus);
    ray.direction = rt_normalize(rt_sub(sharp, aside));
    return ray;
}

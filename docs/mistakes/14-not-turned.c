/* The ray not turned
 *
 * Symptom: everything is blurred by the size of the lens, and nothing is sharp, wherever
 *          the focus is set. Only something infinitely far away would be sharp
 * Cause:   the ray begins at a point of the lens, but keeps the direction of the pinhole's ray
 * Cure:    aim at the point where the pinhole's ray meets the sharp plane
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
    return ray;
}

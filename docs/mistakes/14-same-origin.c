/* The direction turned, the origin not
 *
 * Symptom: nothing is sharp at any distance, and far things are blurred most
 * Cause:   the ray points away from a point of the lens, but still begins at the pinhole
 * Cure:    move the origin, too
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
    const rt_vec3 sharp =
        rt_scale(pinhole->direction, lens->focus / rt_dot(pinhole->direction, forward));
    ray.direction = rt_normalize(rt_sub(sharp, aside));
    return ray;
}

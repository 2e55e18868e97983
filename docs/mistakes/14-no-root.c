/* Too often the middle of the lens
 *
 * Symptom: hard to see: what is out of focus has a sharp core in a wide veil
 * Cause:   the radius times r2 puts half of the points into the inner quarter of the area
 * Cure:    the radius times sqrt(r2): within s lies the part s^2 of the area
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
    const float radius = lens->radius * r2;
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const rt_vec3 aside =
        rt_add(rt_scale(right, radius * cosine), rt_scale(top, radius * sine));
    rt_ray ray = *pinhole;
    ray.origin = rt_add(ray.origin, aside);
    const rt_vec3 sharp =
        rt_scale(pinhole->direction, lens->focus / rt_dot(pinhole->direction, forward));
    ray.direction = rt_normalize(rt_sub(sharp, aside));
    return ray;
}

/* The colour of what casts the shadow
 *
 * Symptom: surfaces have the colour of other things, in patches
 * Cause:   the hit record of the shadow ray was written over that of the surface
 * Cure:    a hit record of its own for the shadow ray
 * Options: --bounces 0
 */
#define rt_direct my_direct
#include "rt.h"

static inline rt_vec3 my_direct(const rt_scene *scene, const rt_hit *hit, rt_rng *rng)
{
    const rt_light *light = &scene->lights[0];
    const rt_vec3 to_light = rt_sub(light->position, hit->point);
    rt_hit same = *hit;
    rt_ray shadow;
    rng->rays++;
    shadow.origin = rt_leave(hit->point, hit->normal, to_light);
    shadow.direction = to_light;
    const bool hidden = rt_intersect(scene, &shadow, &same) && same.t < 1;
    const rt_vec3 light_here =
        rt_lambert(same.material->albedo, hit->normal, to_light, light->intensity);
    return hidden ? rt_scale(light_here, 0.3f) : light_here;
}

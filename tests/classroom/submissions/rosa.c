/* Facets as often as there are, not as often as the eye sees them; a density without the 4; a lens
 * with too many rays through its middle, and a sharp sphere for a sharp plane. */
#define rt_sample_gloss my_sample_gloss
#define rt_gloss my_gloss
#define rt_lens_ray my_lens_ray
#include "rt.h"

static inline rt_vec3 my_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2)
{
    const float a2 = 2 / (shininess + 2), cc = (1 - r2) / (1 + (a2 - 1) * r2);
    const float turn = 6.2831853f * r1, sine = sqrtf(1 - cc);
    rt_vec3 x, y;
    rt_basis(normal, &x, &y);
    const rt_vec3 h =
        rt_add(rt_add(rt_scale(x, sine * cosf(turn)), rt_scale(y, sine * sinf(turn))),
               rt_scale(normal, sqrtf(cc)));
    return rt_sub(rt_scale(h, 2 * rt_dot(h, to_eye)), to_eye);
}

static inline float my_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density)
{
    const float a2 = 2 / (shininess + 2);
    const float e = rt_dot(normal, to_eye), l = rt_dot(normal, to_light);
    *density = 0;
    if (e <= 0 || l <= 0)
        return 0;
    const float c = rt_dot(normal, rt_normalize(rt_add(to_eye, to_light)));
    const float k = c * c * (a2 - 1) + 1, d = a2 / (3.14159265f * k * k);
    const float g1 = 2 / (1 + sqrtf(1 + a2 * (1 / (e * e) - 1)));
    const float g2 = 2 / (1 + sqrtf(1 + a2 * (1 / (l * l) - 1)));
    *density = g1 * d / e;
    return g1 * g2 * d / (4 * e);
}

static inline rt_ray my_lens_ray(const rt_camera *camera, const rt_lens *lens,
                                 const rt_ray *pinhole, float r1, float r2)
{
    rt_vec3 a, b;
    rt_basis(rt_normalize(camera->direction), &a, &b);
    const float r = lens->radius * r2, turn = 6.2831853f * r1;
    const rt_vec3 aside =
        rt_add(rt_scale(a, r * cosf(turn)), rt_scale(b, r * sinf(turn)));
    rt_ray ray = *pinhole;
    ray.origin = rt_add(ray.origin, aside);
    ray.direction =
        rt_normalize(rt_sub(rt_scale(pinhole->direction, lens->focus), aside));
    return ray;
}

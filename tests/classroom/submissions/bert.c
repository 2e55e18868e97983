/* Right only while a = 1, and only in float. */
#define rt_hit_sphere my_hit_sphere
#include "rt.h"

static inline bool my_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                                 rt_hit *hit)
{
    const rt_vec3 u = ray->direction, f = rt_sub(ray->origin, sphere->center);
    const float a = rt_dot(u, u), b = 2 * rt_dot(f, u);
    const float c = rt_dot(f, f) - sphere->radius * sphere->radius;
    const float D = b * b - 4 * a * c;
    if (!(D >= 0))
        return false;
    float t = (-b - sqrtf(D)) / 2 * a;
    if (!(t > 0))
        t = (-b + sqrtf(D)) / 2 * a;
    if (!(t > 0 && t < t_max))
        return false;
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_normalize(rt_sub(hit->point, sphere->center));
    if (rt_dot(hit->normal, u) > 0)
        hit->normal = rt_scale(hit->normal, -1);
    hit->material = &sphere->material;
    return true;
}

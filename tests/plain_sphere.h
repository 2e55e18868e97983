/* The sphere of a first lecture, in float: for tests/cost.c only. */
#define rt_hit_sphere plain_hit_sphere
#include "../rt.h"

static inline bool plain_hit_sphere(const rt_sphere *sphere, const rt_ray *ray,
                                    float t_max, rt_hit *hit)
{
    const rt_vec3 f = rt_sub(ray->origin, sphere->center);
    const float a = rt_dot(ray->direction, ray->direction);
    const float b = rt_dot(f, ray->direction);
    const float c = rt_dot(f, f) - sphere->radius * sphere->radius;
    const float discriminant = b * b - a * c;
    if (discriminant < 0.0f)
        return false;
    float t = (-b - sqrtf(discriminant)) / a;
    if (t <= 1e-3f)
        t = (-b + sqrtf(discriminant)) / a;
    if (t <= 1e-3f || t >= t_max)
        return false;
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_scale(rt_sub(hit->point, sphere->center), 1.0f / sphere->radius);
    if (rt_dot(hit->normal, ray->direction) > 0.0f)
        hit->normal = rt_scale(hit->normal, -1.0f);
    hit->material = &sphere->material;
    return true;
}

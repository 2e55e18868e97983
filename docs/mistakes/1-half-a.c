/* / 2*a
 *
 * Symptom: everything is where it should be, but shadows are missing or in the
 *          wrong place
 * Cause:   (-b - sqrt(D)) / 2 * a divides by 2 and *multiplies* by a. That is right while
 *          a = 1, but shadow rays are longer
 * Cure:    brackets: / (2 * a); and test with directions of any length
 * Options:
 */
#define rt_hit_sphere my_hit_sphere
#include "rt.h"

static inline bool my_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                                 rt_hit *hit)
{
    const rt_dvec3 u = rt_to_double(ray->direction), o = rt_to_double(sphere->center);
    const rt_dvec3 f = rt_dsub(rt_to_double(ray->origin), o);
    const double r = (double)sphere->radius, a = rt_ddot(u, u), b = rt_ddot(f, u);
    const double root = sqrt(b * b - a * (rt_ddot(f, f) - r * r));
    double t = (-2 * b - 2 * root) / 2 * a;
    if (!(t > 0))
        t = (-2 * b + 2 * root) / 2 * a;
    if (!(t > 0 && t < (double)t_max))
        return false;
    const rt_dvec3 n = rt_dscale(rt_dmad(f, t, u), 1 / r);
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(o, r, n));
    hit->normal = rt_to_float(rt_dscale(n, rt_ddot(n, u) > 0 ? -1 : 1));
    hit->material = &sphere->material;
    return true;
}

/* The far side of the sphere
 *
 * Symptom: nearly black: the ball, the mirror and the walls are gone, and only the cube
 *          is left
 * Cause:   + in place of -: of the two roots, the larger one was taken
 * Cure:    first the smaller root, (-b - sqrt(D)) / a; the larger one only if that
 *          is not positive
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
    const double t = (-b + root) / a;
    if (!(t > 0 && t < (double)t_max))
        return false;
    const rt_dvec3 n = rt_dscale(rt_dmad(f, t, u), 1 / r);
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(o, r, n));
    hit->normal = rt_to_float(rt_dscale(n, rt_ddot(n, u) > 0 ? -1 : 1));
    hit->material = &sphere->material;
    return true;
}

/* Only from one side
 *
 * Symptom: the teapot is dark and speckled: one looks through its front, and sees the inside of its
 *          back. (With the other sign there is hardly anything to see, but a glass teapot is gone.)
 * Cause:   only one sign of the three areas counts as a hit, so a triangle is there from one side
 *          only; here it is the back
 * Cure:    all three at least 0, or all three at most 0
 * Options:
 */
#define rt_hit_triangle my_hit_triangle
#include "rt.h"

static inline bool my_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    const rt_dvec3 u = rt_to_double(ray->direction), o = rt_to_double(ray->origin);
    const rt_dvec3 a = rt_dsub(rt_to_double(rt_corner(mesh, triangle, 0)), o);
    const rt_dvec3 b = rt_dsub(rt_to_double(rt_corner(mesh, triangle, 1)), o);
    const rt_dvec3 c = rt_dsub(rt_to_double(rt_corner(mesh, triangle, 2)), o);
    const double w_a = rt_ddot(u, rt_dcross(c, b)), w_b = rt_ddot(u, rt_dcross(a, c));
    const double w_c = rt_ddot(u, rt_dcross(b, a)), sum = w_a + w_b + w_c;
    if (!(w_a <= 0 && w_b <= 0 && w_c <= 0))
        return false;
    const rt_dvec3 p =
        rt_dmad(rt_dmad(rt_dscale(a, w_a / sum), w_b / sum, b), w_c / sum, c);
    const double t = rt_ddot(p, u) / rt_ddot(u, u);
    if (!(t > 0 && t < (double)t_max))
        return false;
    const rt_dvec3 n = rt_dnormalize(rt_dcross(rt_dsub(b, a), rt_dsub(c, a)));
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(p, 1, o));
    hit->inside = rt_ddot(n, u) > 0;
    hit->normal = rt_to_float(rt_dscale(n, hit->inside ? -1 : 1));
    hit->material = &mesh->material;
    hit->u = (float)(w_b / sum);
    hit->v = (float)(w_c / sum);
    return true;
}

/* Nobody has the edges
 *
 * Symptom: in the room there is nothing to see; but a ray that goes exactly along an edge, or
 *          through a corner, gets through: here all edges of the right half, and many on the left
 * Cause:   w > 0 was asked in place of w >= 0, by both triangles
 * Cure:    what lies on the edge is inside, for both of them: better two hits than none
 * Options: edges
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
    if (!(w_a > 0 && w_b > 0 && w_c > 0) && !(w_a < 0 && w_b < 0 && w_c < 0))
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

/* Möller and Trumbore, in float
 *
 * Symptom: nothing to see in the room. But where rays run along edges there are holes,
 *          one pixel large, through which you see what is behind, here red
 * Cause:   each triangle computes its edges from its own corner A, in float, and rounds
 *          differently from its neighbour. Close to the edge between them, each may leave
 *          the ray to the other
 * Cure:    both use the same two products for the edge that they share
 * Options: edges
 */
#define rt_hit_triangle my_hit_triangle
#include "rt.h"

static inline bool my_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    const rt_vec3 a = rt_corner(mesh, triangle, 0);
    const rt_vec3 ab = rt_sub(rt_corner(mesh, triangle, 1), a);
    const rt_vec3 ac = rt_sub(rt_corner(mesh, triangle, 2), a);
    const rt_vec3 p = rt_cross(ray->direction, ac);
    const float det = rt_dot(ab, p);
    if (fabsf(det) < 1e-8f)
        return false;
    const rt_vec3 s = rt_sub(ray->origin, a), q = rt_cross(s, ab);
    const float u = rt_dot(s, p) / det, v = rt_dot(ray->direction, q) / det;
    const float t = rt_dot(ac, q) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < t_max))
        return false;
    const rt_vec3 n = rt_normalize(rt_cross(ab, ac));
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->inside = rt_dot(n, ray->direction) > 0;
    hit->normal = rt_scale(n, hit->inside ? -1.0f : 1.0f);
    hit->material = &mesh->material;
    hit->u = u;
    hit->v = v;
    return true;
}

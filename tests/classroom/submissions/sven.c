/* As most tutorials have it, in float: rays slip through between triangles. */
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
    if (det == 0)
        return false;
    const rt_vec3 s = rt_sub(ray->origin, a), q = rt_cross(s, ab);
    const float u = rt_dot(s, p) / det, v = rt_dot(ray->direction, q) / det;
    const float t = rt_dot(ac, q) / det;
    if (!(u >= 0 && v >= 0 && u + v <= 1 && t > 0 && t < t_max))
        return false;
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_normalize(rt_cross(ab, ac));
    hit->inside = det < 0;
    if (hit->inside)
        hit->normal = rt_scale(hit->normal, -1);
    hit->material = &mesh->material;
    hit->part = triangle;
    hit->u = u;
    hit->v = v;
    return true;
}

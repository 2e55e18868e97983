/* Right: the two axes across the ray from its largest component, and in double. */
#define rt_hit_triangle my_hit_triangle
#include "rt.h"

static inline bool my_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    const double d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    int k = fabs(d[0]) > fabs(d[1]) ? 0 : 1;
    k = fabs(d[k]) > fabs(d[2]) ? k : 2;
    const int i = (k + 1) % 3, j = (k + 2) % 3;
    double x[3], y[3], z[3], area[3], sum = 0;
    int left = 0, right = 0;
    if (d[k] == 0)
        return false;
    for (int n = 0; n < 3; n++) {
        const rt_vec3 v = rt_corner(mesh, triangle, n);
        const double c[3] = {v.x, v.y, v.z};
        z[n] = (c[k] - o[k]) / d[k];
        x[n] = c[i] - o[i] - z[n] * d[i];
        y[n] = c[j] - o[j] - z[n] * d[j];
    }
    for (int n = 0; n < 3; n++) {
        const int a = (n + 1) % 3, b = (n + 2) % 3;
        area[n] = x[a] * y[b] - y[a] * x[b];
        left += area[n] < 0;
        right += area[n] > 0;
        sum += area[n];
    }
    const rt_dvec3 a = rt_to_double(rt_corner(mesh, triangle, 0));
    const rt_dvec3 n = rt_dcross(rt_dsub(rt_to_double(rt_corner(mesh, triangle, 1)), a),
                                 rt_dsub(rt_to_double(rt_corner(mesh, triangle, 2)), a));
    const double t = (area[0] * z[0] + area[1] * z[1] + area[2] * z[2]) / sum;
    if ((left > 0 && right > 0) || sum == 0 || rt_ddot(n, n) == 0 ||
        !(t > 0 && t < (double)t_max))
        return false;
    hit->t = (float)t;
    hit->point =
        rt_to_float(rt_dmad(rt_to_double(ray->origin), t, rt_to_double(ray->direction)));
    hit->inside = rt_ddot(n, rt_to_double(ray->direction)) > 0;
    hit->normal = rt_to_float(rt_dnormalize(rt_dscale(n, hit->inside ? -1 : 1)));
    hit->material = &mesh->material;
    hit->part = triangle;
    hit->u = (float)(area[1] / sum);
    hit->v = (float)(area[2] / sum);
    return true;
}

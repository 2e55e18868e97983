/* The normal into the pot
 *
 * Symptom: the teapot is black
 * Cause:   (C - A) x (B - A) points inward, because the corners go round
 *          counterclockwise, and it was not turned to the side of the ray
 * Cure:    let the ray decide: the normal is on the side from which the ray comes
 * Options:
 */
#define rt_hit_triangle my_hit_triangle
#include "rt.h"

static inline bool my_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    const double o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const double u[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const double x = fabs(u[0]), y = fabs(u[1]), z = fabs(u[2]);
    const int k = x >= y && x >= z ? 0 : y >= z ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
    const double sz = u[k] != 0 ? 1 / u[k] : 0, sx = u[i] * sz, sy = u[j] * sz;
    rt_dvec3 corner[3], p[3];
    double w[3], t = 0;
    for (int c = 0; c < 3; c++) {
        corner[c] = rt_to_double(rt_corner(mesh, triangle, c));
        const double v[3] = {corner[c].x, corner[c].y, corner[c].z};
        const double far = v[k] - o[k];
        p[c] = rt_dvec(v[i] - o[i] - sx * far, v[j] - o[j] - sy * far, far);
    }
    for (int c = 0; c < 3; c++) {
        const rt_dvec3 a = p[(c + 1) % 3], b = p[(c + 2) % 3];
        w[c] = b.x * a.y - b.y * a.x;
        t += w[c] * p[c].z;
    }
    const double sum = w[0] + w[1] + w[2];
    t = t * sz / sum;
    const rt_dvec3 n = rt_dnormalize(
        rt_dcross(rt_dsub(corner[1], corner[0]), rt_dsub(corner[2], corner[0])));
    const bool left = w[0] >= 0 && w[1] >= 0 && w[2] >= 0;
    const bool right = w[0] <= 0 && w[1] <= 0 && w[2] <= 0;
    if (!((left || right) && t >= FLT_MIN && (float)t < t_max && rt_ddot(n, n) > 0))
        return false;
    for (int c = 0; c < 3; c++)
        w[c] *= 1 / sum;
    hit->t = (float)t;
    hit->point = rt_to_float(
        rt_dmad(rt_dmad(rt_dscale(corner[0], w[0]), w[1], corner[1]), w[2], corner[2]));
    hit->inside = rt_ddot(n, rt_to_double(ray->direction)) > 0;
    hit->normal = rt_to_float(rt_dscale(n, -1));
    hit->material = &mesh->material;
    hit->shape = 0;
    hit->part = triangle;
    hit->u = (float)w[1];
    hit->v = (float)w[2];
    return true;
}

/* The normal into the box
 *
 * Symptom: the cube is dull, because it gets no light from the lamp; without indirect
 *          light it is black
 * Cause:   the sign of the normal is that of the direction
 * Cure:    against the direction: u > 0 gives -1
 * Options:
 */
#define rt_hit_box my_hit_box
#include "rt.h"

static inline bool my_hit_box(const rt_box *box, const rt_ray *ray, float t_max,
                              rt_hit *hit)
{
    const float o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const float u[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const float min[3] = {box->min.x, box->min.y, box->min.z};
    const float max[3] = {box->max.x, box->max.y, box->max.z};
    float t_in = -FLT_MAX, t_out = FLT_MAX, n[3] = {0, 0, 0};
    int in = 0, out = 0;
    for (int k = 0; k < 3; k++) {
        if (u[k] == 0 && (o[k] < min[k] || o[k] > max[k]))
            return false;
        if (u[k] == 0)
            continue;
        const float a = (min[k] - o[k]) / u[k], b = (max[k] - o[k]) / u[k];
        if (fminf(a, b) > t_in) {
            t_in = fminf(a, b);
            in = k;
        }
        if (fmaxf(a, b) < t_out) {
            t_out = fmaxf(a, b);
            out = k;
        }
    }
    const int axis = t_in > 0 ? in : out;
    const float t = t_in > 0 ? t_in : t_out;
    if (!(t_in <= t_out && t > 0 && t < t_max))
        return false;
    n[axis] = u[axis] > 0 ? 1 : -1;
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_vec(n[0], n[1], n[2]);
    hit->material = &box->material;
    return true;
}

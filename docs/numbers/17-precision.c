/* Chapter 17: how often a ray that leaves a cylinder meets it again at once. It is convex, so it
 * should never. */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdio.h>

enum { IN_FLOAT, T_ROUNDED, IN_DOUBLE, PUT_BACK, WAYS };

/* Radius 1, from y = 0 to 1: the number below is how the side is computed. */
static bool hit(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const int way = *(const int *)data;
    const rt_dvec3 u = rt_to_double(ray->direction), f = rt_to_double(ray->origin);
    double in = -DBL_MAX, out = DBL_MAX;
    if (way == IN_FLOAT) {
        const rt_vec3 d = ray->direction, o = ray->origin;
        const float a = d.x * d.x + d.z * d.z, b = o.x * d.x + o.z * d.z;
        const float c = o.x * o.x + o.z * o.z - 1, D = b * b - a * c;
        if (D < 0)
            return false;
        in = (-b - sqrtf(D)) / a;
        out = (-b + sqrtf(D)) / a;
    } else {
        const double a = u.x * u.x + u.z * u.z, b = f.x * u.x + f.z * u.z;
        const double D = b * b - a * (f.x * f.x + f.z * f.z - 1);
        if (D < 0)
            return false;
        in = (-b - sqrt(D)) / a;
        out = (-b + sqrt(D)) / a;
    }
    const double low = (u.y > 0 ? -f.y : 1 - f.y) / u.y;
    const double high = (u.y > 0 ? 1 - f.y : -f.y) / u.y;
    const bool side_in = in > low, side_out = out < high;
    in = side_in ? in : low;
    out = side_out ? out : high;
    const double t = in > 0 ? in : out;
    const bool side = in > 0 ? side_in : side_out, top = (in > 0) == (u.y < 0);
    if (!(in < out && t > 0 && t < (double)t_max))
        return false;
    rt_dvec3 p = rt_dmad(f, t, u);
    hit->t = (float)t;
    hit->normal = side ? rt_vec((float)p.x, 0, (float)p.z) : rt_vec(0, top ? 1 : -1, 0);
    hit->point = way == IN_DOUBLE ? rt_to_float(p) : rt_at(ray, hit->t);
    if (way == PUT_BACK) {
        const double k = side ? 1 / sqrt(p.x * p.x + p.z * p.z) : 1;
        hit->point = rt_to_float(rt_dvec(k * p.x, side ? p.y : top ? 1 : 0, k * p.z));
    }
    return true;
}

int main(void)
{
    static const char *const names[WAYS] = {
        "all in `float`", "t in `double`, P in `float`", "P in `double`, too",
        "P put back onto the side"};
    static const float far[4] = {3, 300, 3e4f, 3e6f};
    enum { RAYS = 200000 };
    long found = 0, should = 0; /* from the largest distance */
    printf("| | from 3 | 300 | 30 000 | 3 000 000 radii away |\n|---|---|---|---|---|\n");
    for (int way = 0; way < WAYS; way++) {
        const rt_custom_shape shape = {
            {-1, 0, -1}, {1, 1, 1}, {{0, 0, 0}, false}, hit, &way};
        printf("| %s |", names[way]);
        for (int k = 0; k < 4; k++) {
            rt_rng rng = rt_rng_start((uint32_t)k, 0, 0);
            int again = 0, met = 0;
            for (int i = 0; i < RAYS; i++) {
                const float r1 = rt_random(&rng), r2 = rt_random(&rng);
                const float r3 = rt_random(&rng), r4 = rt_random(&rng);
                const rt_vec3 eye =
                    rt_scale(rt_sample_cosine(rt_vec(0, 1, 0), r1, r2), far[k]);
                const rt_vec3 to = {2 * r3 - 1, 0.5f, 2 * r4 - 1};
                const rt_ray ray = {eye, rt_normalize(rt_sub(to, eye))};
                rt_hit h, next;
                if (!rt_hit_custom_shape(&shape, &ray, FLT_MAX, &h))
                    continue;
                met++;
                const float r5 = rt_random(&rng), r6 = rt_random(&rng);
                rt_ray on;
                on.direction = rt_sample_cosine(h.normal, r5, r6);
                on.origin = rt_leave(h.point, h.normal, on.direction);
                again += rt_hit_custom_shape(&shape, &on, FLT_MAX, &next);
            }
            printf(" %.2g %% |", 100.0 * again / met);
            if (k == 3 && way == IN_FLOAT)
                found = met;
            if (k == 3 && way == PUT_BACK)
                should = met;
        }
        printf("\n");
    }
    printf("found: %.0f\n", 100.0 * (double)found / (double)should);
}

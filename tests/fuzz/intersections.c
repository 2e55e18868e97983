/* libFuzzer: the bytes are a ray and a shape. Whatever they are, a hit is finite, in front of
 * the ray and before t_max, with a unit normal; a miss leaves the hit alone. */
#include <stdlib.h>
#include <string.h>

#define RT_IMPLEMENTATION
#include "../../rt.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(bool good)
{
    if (!good)
        abort();
}

static void check_hit(bool is_hit, const rt_hit *hit, float t_max)
{
    if (!is_hit) {
        demand(hit->t == -7.0f && hit->normal.x == 7.0f && !hit->material);
        return;
    }
    demand(hit->t >= 0.0f && hit->t < t_max && hit->t <= FLT_MAX);
    demand(fabsf(rt_length(hit->normal) - 1.0f) < 1e-5f);
    demand(hit->material != NULL);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const rt_hit untouched = {-7, {0, 0, 0}, {7, 0, 0}, NULL};
    rt_ray ray;
    rt_sphere sphere;
    rt_box box;
    float f[14];
    if (size < sizeof f)
        return 0;
    memcpy(f, data, sizeof f);
    ray.origin = rt_vec(f[0], f[1], f[2]);
    ray.direction = rt_vec(f[3], f[4], f[5]);
    memset(&sphere, 0, sizeof sphere);
    memset(&box, 0, sizeof box);
    sphere.center = box.min = rt_vec(f[6], f[7], f[8]);
    sphere.radius = f[9];
    box.max = rt_vec(f[10], f[11], f[12]);

    rt_hit hit = untouched;
    check_hit(rt_hit_sphere(&sphere, &ray, f[13], &hit), &hit, f[13]);
    hit = untouched;
    check_hit(rt_hit_box(&box, &ray, f[13], &hit), &hit, f[13]);
    demand(rt_encode(f[0], (double)f[1]) <= 255);
    float sine, cosine;
    rt_sincos(f[0], &sine, &cosine);
    demand(fabsf(sine * sine + cosine * cosine - 1.0f) < 1e-6f);
    return 0;
}

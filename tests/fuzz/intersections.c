/* libFuzzer: the bytes are a ray and a shape, or what a custom shape's function says.
 * Whatever they are, a hit is finite, in front of the ray and before t_max, with a unit
 * normal; a miss leaves the hit alone. */
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

/* Whatever the bytes say. */
static bool say(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const float *f = data;
    (void)ray, (void)t_max;
    hit->t = f[0];
    hit->point = rt_vec(f[1], f[2], f[3]);
    hit->normal = rt_vec(f[4], f[5], f[6]);
    return true;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static const rt_hit untouched = {.t = -7, .normal = {7, 0, 0}};
    rt_ray ray;
    rt_sphere sphere;
    rt_box box;
    static const int face[3] = {0, 1, 2};
    rt_vec3 corners[3];
    float f[16];
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

    for (int k = 0; k < 3; k++)
        corners[k] = rt_vec(f[6 + 3 * k], f[7 + 3 * k], f[8 + 3 * k]);
    const rt_mesh mesh = {corners, face, 3, 1, {{0, 0, 0}, false}};
    hit = untouched;
    check_hit(rt_hit_triangle(&mesh, 0, &ray, f[15], &hit), &hit, f[15]);
    demand(hit.t == -7.0f || (hit.u >= 0.0f && hit.v >= 0.0f && hit.u + hit.v < 1.001f));
    const rt_custom_shape shape = {box.min, box.max, box.material, say, f};
    hit = untouched;
    check_hit(rt_hit_custom_shape(&shape, &ray, f[13], &hit), &hit, f[13]);
    demand(rt_encode(f[0], (double)f[1]) <= 255);
    float sine, cosine;
    rt_sincos(f[0], &sine, &cosine);
    demand(fabsf(sine * sine + cosine * cosine - 1.0f) < 1e-6f);
    return 0;
}

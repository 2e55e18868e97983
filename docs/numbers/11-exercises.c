/* Chapter 11, exercises: the ball as a lens, the sides of a cube, a bubble of air, and the coin
 * against both ways. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

/* Through both surfaces of a ball of radius 1 at the origin, from (b, 0, -9) along z: where the
 * ray then crosses the axis. */
static double crosses(float b, float eta)
{
    const rt_sphere ball = {{0, 0, 0}, 1, {{0, 0, 0}, false}};
    rt_ray ray = {{b, 0, -9}, {0, 0, 1}};
    for (int k = 0; k < 2; k++) {
        rt_hit hit;
        rt_vec3 next;
        if (!rt_hit_sphere(&ball, &ray, FLT_MAX, &hit) ||
            !rt_refract(ray.direction, hit.normal, k ? 1 / eta : eta, &next))
            return NAN;
        ray.origin = rt_leave(hit.point, hit.normal, next);
        ray.direction = next;
    }
    return (double)(ray.origin.z - ray.origin.x / ray.direction.x * ray.direction.z);
}

/* Of the rays that enter a cube through its front from all sides: the share that meets
 * one of the four sides first, and of those the share that gets out there. */
static void sides(float eta, double *met, double *out)
{
    const rt_box cube = {{-1, -1, -1}, {1, 1, 1}, {{0, 0, 0}, false}};
    rt_rng rng = rt_rng_start(0, 0, 0);
    int side = 0, left = 0, all = 0;
    for (int i = 0; i < 1000000; i++) {
        const float x = 2 * rt_random(&rng) - 1, y = 2 * rt_random(&rng) - 1;
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 front = {0, 0, 1};
        const rt_vec3 from = rt_scale(rt_sample_cosine(front, r1, r2), -1);
        rt_vec3 in, on;
        rt_hit hit;
        if (!rt_refract(from, front, eta, &in))
            continue;
        rt_ray ray = {rt_leave(rt_vec(x, y, 1), front, in), in};
        if (!rt_hit_box(&cube, &ray, FLT_MAX, &hit))
            continue;
        all++;
        if (hit.normal.z != 0)
            continue;
        side++;
        left += rt_refract(in, hit.normal, 1 / eta, &on);
    }
    *met = 100.0 * side / all;
    *out = 100.0 * left / side;
}

/* The light along a ray in the room of demo 11, as there; but at the first surface of
 * glass it takes both ways, each with its part, and tosses no coin. */
static rt_vec3 split(rt_ray ray, int bounces, rt_rng *rng)
{
    rt_hit hit;
    if (!rt_intersect(&scene_glass, &ray, &hit))
        return rt_vec(0, 0, 0);
    const rt_surface *surface = rt_surface_of(&scene_glass, &hit);
    if (!(surface->eta > 0))
        return rt_radiance_mis(&scene_glass, &ray, bounces, rng);
    rng->rays++;
    const float f = rt_fresnel(-rt_dot(ray.direction, hit.normal), surface->eta);
    rt_vec3 sum = {0, 0, 0};
    for (int way = 0; way < 2; way++) {
        rt_ray on;
        on.direction = rt_reflect(ray.direction, hit.normal);
        if (way == 1)
            rt_refract(ray.direction, hit.normal, surface->eta, &on.direction);
        on.origin = rt_leave(hit.point, hit.normal, on.direction);
        const rt_vec3 light = rt_radiance_mis(&scene_glass, &on, bounces - 1, rng);
        sum = rt_add(sum, rt_scale(light, way == 1 ? 1 - f : f));
    }
    return sum;
}

/* The noise of one sample, over the pixels of the ball of glass; and its rays. */
static void noise(bool both, double *deviation, double *rays)
{
    enum { SAMPLES = 64 };
    double squares = 0, sum = 0;
    uint64_t count = 0;
    int pixels = 0;
    for (int y = 140; y < 220; y += 2)
        for (int x = 132; x < 210; x += 2) {
            const rt_ray ray =
                rt_camera_ray(&room_camera, 320, 240, (float)x + 0.5f, (float)y + 0.5f);
            rt_hit hit;
            if (!rt_intersect(&scene_glass, &ray, &hit) || hit.shape != ROOM_GLASS)
                continue;
            double mean = 0, square = 0;
            for (uint32_t k = 0; k < SAMPLES; k++) {
                rt_rng rng = rt_rng_start((uint32_t)(320 * y + x), k, 0);
                const double v =
                    (double)(both ? split(ray, 8, &rng)
                                  : rt_radiance_mis(&scene_glass, &ray, 8, &rng))
                        .y;
                count += rng.rays;
                mean += v / SAMPLES;
                square += v * v / SAMPLES;
            }
            squares += (square - mean * mean) * SAMPLES / (SAMPLES - 1);
            sum += mean;
            pixels++;
        }
    *deviation = sqrt(squares / pixels) / (sum / pixels);
    *rays = (double)count / pixels / SAMPLES;
}

int main(void)
{
    printf("lens: %.3f\nlens-half: %.3f\nlens-edge: %.3f\n", crosses(0.01f, 1.5f),
           crosses(0.5f, 1.5f), crosses(0.9f, 1.5f));
    printf("lens-2: %.3f\n", crosses(0.01f, 2));
    printf("room-lens: %.1f\n", 11 * crosses(0.01f, 1.5f));
    double met, out;
    sides(1.5f, &met, &out);
    printf("cube-met: %.0f\ncube-out: %g\n", met, out);
    sides(1.33f, &met, &out);
    printf("water-out: %.1f\n", out);
    sides(1.42f, &met, &out);
    printf("just-out: %g\n", out);
    sides(1.41f, &met, &out);
    printf("below-out: %.3f\n", out);

    /* a bubble of air in glass: how far from the middle a ray still gets in */
    float low = 0, high = 1;
    for (int i = 0; i < 30; i++) {
        const float b = (low + high) / 2;
        rt_vec3 t;
        const rt_vec3 n = {0, b,
                           sqrtf(1 - b * b)}; /* where a ray along -z meets the ball */
        *(rt_refract(rt_vec(0, 0, -1), n, 1 / 1.5f, &t) ? &low : &high) = b;
    }
    printf("bubble: %.3f\n", (double)low);

    double coin, coin_rays, two, two_rays;
    noise(false, &coin, &coin_rays);
    noise(true, &two, &two_rays);
    printf("coin: %.0f\ncoin-rays: %.1f\nsplit: %.0f\nsplit-rays: %.1f\n", 100 * coin,
           coin_rays, 100 * two, two_rays);
    printf("loss: %.0f\n", 100 * (two / coin * sqrt(two_rays / coin_rays) - 1));
}

/* Chapter 15, exercises: rings of wood, a map around a ball, stretch, a checker far away. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

/* Rings about the y axis, 4 apart, a quarter of each dark. */
static rt_vec3 wood(const void *unused, rt_vec3 P, rt_vec3 N)
{
    (void)unused;
    (void)N;
    const float ring = sqrtf(P.x * P.x + P.z * P.z) / 4;
    return ring - floorf(ring) < 0.75f ? rt_vec(0.70f, 0.45f, 0.25f)
                                       : rt_vec(0.35f, 0.20f, 0.10f);
}

/* An endless floor of tiles, seen at a flat angle: rows of a picture 64 wide, one far
 * row. The checker that fades knows the eye, and how long a pixel is there. */
typedef struct faded {
    pattern_checks tiles;
    rt_vec3 eye;
} faded;

static rt_vec3 faded_checker(const void *data, rt_vec3 P, rt_vec3 N)
{
    const faded *f = data;
    const rt_vec3 way = rt_sub(P, f->eye), sharp = checker_pattern(&f->tiles, P, N);
    const float pixel =
        rt_dot(way, way) / fabsf(way.y) / 240; /* its length on the floor */
    const float share = f->tiles.size / pixel, keep = share < 1 ? share * share : 1;
    const rt_vec3 mean = rt_scale(rt_add(f->tiles.even, f->tiles.odd), 0.5f);
    return rt_add(rt_scale(sharp, keep), rt_scale(mean, 1 - keep));
}

static void far_rows(const char *name, rt_pattern_function *pattern, const void *data,
                     int n)
{
    double sum = 0, square = 0;
    rt_rng rng = rt_rng_start(0, 0, 1);
    for (int i = 0; i < 20000; i++) {
        double pixel = 0;
        const float x0 = (float)(i % 320), y0 = 3 + (float)(i / 320 % 4);
        for (int k = 0; k < n; k++) { /* eye 10 above the floor, a pixel is 1/240 */
            const float x = (x0 + rt_random(&rng) - 160) / 240,
                        y = (y0 + rt_random(&rng)) / 240;
            const rt_vec3 P = rt_vec(x * 10 / y, -10, -10 / y);
            pixel += (double)pattern(data, P, rt_vec(0, 1, 0)).x / n;
        }
        sum += pixel / 20000;
        square += pixel * pixel / 20000;
    }
    printf("%s: %.2f\n%s-grain: %.2f\n", name, sum, name, sqrt(square - sum * sum));
}

int main(void)
{
    printf("wood: %.2f, %.2f, %.2f, %.2f\n",
           wood(NULL, rt_vec(1, 5, 0), rt_vec(0, 1, 0)).x,
           wood(NULL, rt_vec(-3.5f, 0, 0), rt_vec(0, 1, 0)).x,
           wood(NULL, rt_vec(0, -7, -4.5f), rt_vec(0, 1, 0)).x,
           wood(NULL, rt_vec(3, 0, -4), rt_vec(0, 1, 0)).x);
    double mean = 0;
    rt_rng rng = rt_rng_start(0, 0, 0);
    for (int i = 0; i < 1000000; i++) {
        const float x = rt_random(&rng), z = rt_random(&rng);
        mean +=
            (double)wood(NULL, rt_vec(1000 * x, 0, 1000 * z), rt_vec(0, 1, 0)).x / 1e6;
    }
    printf("wood-mean: %.3f\n", mean);

    /* how many times longer than wide is what a small square of the picture covers, at
     * this angle to the line of sight: 1 / cosine if projected; for the map around, 1 /
     * cosine of the latitude */
    for (int degrees = 0; degrees <= 60; degrees += 30) {
        const double h = 1e-4, a = degrees * 3.14159265358979 / 180;
        const double arc = asin(sin(a) + h) - asin(sin(a));
        printf("stretch%d: %.2f\n", degrees, arc / h);
    }
    /* the share of a sphere that a map's top tenth of rows covers, and one projected from
     * the front */
    printf("map-top: %.2f\nthrown-top: %.2f\n",
           100 * (1 - cos(3.14159265358979 / 10)) / 2, 100 * 0.1);

    const faded f = {{10, {0.8f, 0.8f, 0.8f}, {0.12f, 0.12f, 0.12f}}, {0, 0, 0}};
    far_rows("one", checker_pattern, &f.tiles, 1);
    far_rows("sixteen", checker_pattern, &f.tiles, 16);
    far_rows("faded", faded_checker, &f, 1);
}

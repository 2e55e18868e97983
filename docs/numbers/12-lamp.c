/* Chapter 12: the cone under which a ball is seen, and how many digits two ways to write it keep;
 * that a ball lights like a point, and a square does not. */
#include "rt.h"
#include <stdio.h>

static const double pi = 3.14159265358979;

/* The light of a floor of albedo 1/2, straight below a lamp at the height 1. */
static double floor_light(const rt_lamp *lamp, double *off)
{
    const rt_box box = {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_scene scene = {
        .boxes = &box, .box_count = 1, .lamps = lamp, .lamp_count = 1};
    enum { N = 200000 };
    double sum = 0, squares = 0;
    for (uint32_t i = 0; i < N; i++) {
        rt_rng rng = rt_rng_start(i, 0, 0);
        const rt_ray ray = {{0, 0.1f, 0}, {0, -1, 0}};
        const double v = (double)rt_radiance_mis(&scene, &ray, 0, &rng).x;
        sum += v;
        squares += v * v;
    }
    *off = sqrt((squares / N - sum / N * (sum / N)) / N);
    return sum / N;
}

int main(void)
{
    printf("| R / d | 1 − cos a | 1 − sqrt(1 − s), in float | s / (1 + sqrt(1 − s)), in "
           "float |\n"
           "|---|---|---|---|\n");
    const double ratios[] = {0.5, 0.1, 1e-2, 1e-3, 1e-4};
    for (int i = 0; i < 5; i++) {
        const double s = ratios[i] * ratios[i];
        const float f = (float)s;
        printf("| %g | %.7g | %.7g | %.7g |\n", ratios[i], s / (1 + sqrt(1 - s)),
               (double)(1.0f - sqrtf(1.0f - f)), (double)(f / (1.0f + sqrtf(1.0f - f))));
    }
    const float f = 1e-6f;
    const double right = 1e-6 / (1 + sqrt(1 - 1e-6));
    printf("naive: %.0f\n", 100 * fabs((double)(1.0f - sqrtf(1.0f - f)) / right - 1));

    /* a ball: I = 1 W/sr, R = 0.5, at the height 1: rho / pi I cos / d^2 */
    const rt_lamp ball = {.center = {0, 1, 0}, .radius = 0.5f, .intensity = {1, 1, 1}};
    const rt_lamp square = {
        .center = {0, 1, 0}, .u = {1, 0, 0}, .v = {0, 0, 1}, .intensity = {1, 1, 1}};
    double off;
    printf("point: %.4f\n", 0.5 / pi);
    printf("ball: %.4f\n", floor_light(&ball, &off));
    printf("ball-off: %.4f\n", off);
    printf("square: %.4f\n", floor_light(&square, &off));
    printf("square-off: %.4f\n", off);
    /* J. Lambert's formula for a rectangle, four corners of 1 x 1 at the distance 1; L = I / 4 */
    const double corner = 2 / sqrt(2) * atan(1 / sqrt(2)) / (2 * pi);
    printf("square-exact: %.4f\n", 0.5 / pi * pi / 4 * 4 * corner);
    printf("square-part: %.0f\n", 100 * pi * corner);
    const rt_lamp small = {.center = {0, 1, 0},
                           .u = {0.1f, 0, 0},
                           .v = {0, 0, 0.1f},
                           .intensity = {1, 1, 1}};
    printf("square-small: %.4f\n", floor_light(&small, &off));
}

/* Chapter 15: value noise along a line: how far it goes, and how much its slope jumps, with
 * and without smoothing. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

/* Without the curve: straight from one lattice point to the next. */
static float straight(float x)
{
    const float f = floorf(x);
    return (1 - (x - f)) * lattice_value((int)f, 0, 0) +
           (x - f) * lattice_value((int)f + 1, 0, 0);
}

/* The largest change of the slope at the points of the lattice: a crease. */
static double crease(bool smooth)
{
    double most = 0;
    const float h = 1.0f / 256;
    for (int i = 1; i < 200; i++) {
        float v[3];
        for (int k = 0; k < 3; k++) {
            const float x = (float)i + (float)(k - 1) * h;
            v[k] = smooth ? value_noise(rt_vec(x, 0, 0)) : straight(x);
        }
        const double change = fabs((double)((v[2] - v[1]) - (v[1] - v[0]))) / (double)h;
        most = change > most ? change : most;
    }
    return most;
}

int main(void)
{
    double low = 1, high = 0, mean = 0, square = 0;
    rt_rng rng = rt_rng_start(0, 0, 0);
    const int n = 1000000;
    for (int i = 0; i < n; i++) {
        const float x = rt_random(&rng), y = rt_random(&rng), z = rt_random(&rng);
        const double v = (double)value_noise(rt_scale(rt_vec(x, y, z), 500));
        low = v < low ? v : low;
        high = v > high ? v : high;
        mean += v / n;
        square += v * v / n;
    }
    printf("low: %.2f\nhigh: %.2f\nmean: %.3f\nsigma: %.3f\n", low, high, mean,
           sqrt(square - mean * mean));
    printf("crease-straight: %.2f\ncrease-smooth: %.2f\n", crease(false), crease(true));
}

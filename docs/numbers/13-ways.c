/* Chapter 13: three ways to the light of a lamp on a ball of rough metal: aim at the
 * lamp, go by chance, and both with the weights of chapter 12. The noise of 32 samples,
 * over all of the ball that is seen. */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdio.h>

enum { AIM, CHANCE, BOTH, WAYS, POINTS = 20000, SAMPLES = 64 };

static float one(int way, const rt_lamp *lamp, const rt_brdf *finish, rt_vec3 P,
                 rt_vec3 N, rt_vec3 eye, rt_rng *rng)
{
    float r[4], sum = 0, density;
    for (int k = 0; k < 4; k++)
        r[k] = rt_random(rng);
    const float light = rt_lamp_radiance(lamp).x;
    if (way != CHANCE) {
        const rt_vec3 L = rt_normalize(rt_sub(rt_sample_lamp(lamp, P, r[0], r[1]), P));
        const float aimed = rt_lamp_density(lamp, P, L);
        const float f = rt_scatter(finish, N, eye, L, &density).x;
        sum += f * light / aimed * (way == BOTH ? rt_mis(aimed, density) : 1);
    }
    if (way != AIM) {
        const rt_vec3 L = rt_sample_brdf(finish, N, eye, r[2], r[3]);
        const float f = rt_scatter(finish, N, eye, L, &density).x;
        const rt_ray ray = {P, L};
        if (density > 0 && rt_meet_lamp(lamp, &ray, FLT_MAX) > 0)
            sum += f * light / density *
                   (way == BOTH ? rt_mis(density, rt_lamp_density(lamp, P, L)) : 1);
    }
    return sum;
}

/* The root of the mean variance of a pixel of 32 samples, over the mean of all pixels. */
static double noise_of(int way, const rt_lamp *lamp, const rt_brdf *finish)
{
    rt_rng rng = rt_rng_start(0, 0, 7);
    double mean = 0, variance = 0;
    for (int i = 0; i < POINTS; i++) {
        const float r = sqrtf(rt_random(&rng)), turn = rt_random(&rng);
        float sine, cosine;
        rt_sincos(turn, &sine, &cosine);
        const rt_vec3 N = {r * cosine, r * sine, sqrtf(1 - r * r)}, P = rt_scale(N, 18);
        double sum = 0, square = 0;
        for (int k = 0; k < SAMPLES; k++) {
            const double v =
                one(way, lamp, finish, P, N, rt_vec(0, 0, 1), &rng); /* from far away */
            sum += v / SAMPLES;
            square += v * v / SAMPLES;
        }
        mean += sum / POINTS;
        variance += (square - sum * sum) * SAMPLES / (SAMPLES - 1) / POINTS;
    }
    return sqrt(variance / 32) / mean;
}

int main(void)
{
    static const float sharp[] = {10, 10, 300, 2000, 2000}, radii[] = {1, 12, 12, 1, 12};
    printf("| shininess | radius of the lamp | aim | chance | both |\n"
           "|---|---|---|---|---|\n");
    for (int row = 0; row < 5; row++) {
        const rt_lamp lamp = {
            .center = {-10, 33, 57}, .radius = radii[row], .intensity = {1, 1, 1}};
        const rt_brdf finish = {{1, 1, 1}, sharp[row], true};
        double noise[WAYS];
        printf("| %g | %g |", sharp[row], radii[row]);
        for (int way = 0; way < WAYS; way++) {
            noise[way] = noise_of(way, &lamp, &finish);
            printf(" %.*f %% |", noise[way] < 0.1 ? 1 : 0, 100 * noise[way]);
        }
        printf("\n");
        if (row == 4)
            printf("aim: %.0f\nchance: %.1f\n", pow(noise[AIM] / noise[BOTH], 2),
                   pow(noise[CHANCE] / noise[BOTH], 2));
    }
}

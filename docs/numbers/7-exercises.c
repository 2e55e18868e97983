/* Chapter 7, exercises 2, 4 and 5: pi, a closed room, Russian roulette, directions. */
#include "rt.h"
#include <stdio.h>

static double error_of_pi(int n)
{
    double squares = 0;
    for (uint32_t seed = 0; seed < 1000; seed++) {
        rt_rng rng = rt_rng_start(0, 0, seed);
        int inside = 0;
        for (int i = 0; i < n; i++) {
            const float x = rt_random(&rng);
            const float y = rt_random(&rng);
            inside += x * x + y * y < 1;
        }
        squares += pow(4.0 * inside / n - 3.14159265358979, 2);
    }
    return sqrt(squares / 1000);
}

static double roulette(const rt_scene *scene, rt_ray ray, rt_rng *rng, int *hits)
{
    rt_vec3 sum = {0, 0, 0}, throughput = {1, 1, 1};
    for (;;) {
        rt_hit hit;
        if (!rt_intersect(scene, &ray, &hit))
            return (double)sum.x;
        ++*hits;
        sum = rt_add(sum, rt_mul(throughput, rt_direct(scene, &hit, rng)));
        const rt_vec3 albedo = hit.material->albedo;
        const float q = fmaxf(albedo.x, fmaxf(albedo.y, albedo.z));
        if (rt_random(rng) >= q)
            return (double)sum.x;
        throughput = rt_scale(rt_mul(throughput, albedo), 1 / q);
        const float r1 = rt_random(rng);
        const float r2 = rt_random(rng);
        ray.direction = rt_sample_cosine(hit.normal, r1, r2);
        ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
    }
}

int main(void)
{
    printf("pi: %.4f, %.4f and %.4f\n", error_of_pi(100), error_of_pi(1000),
           error_of_pi(10000));

    const rt_sphere room = {{0, 0, 0}, 10, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_light lamp = {{0, 0, 0}, {628.3185f, 628.3185f, 628.3185f}};
    const rt_scene scene = {
        .spheres = &room, .sphere_count = 1, .lights = &lamp, .light_count = 1};
    const rt_ray ray = {{1, 2, 3}, {0, 0, -1}};
    const int bounces[4] = {0, 1, 2, 5};
    printf("room:");
    for (int i = 0; i < 4; i++) {
        rt_rng rng = rt_rng_start(0, 0, 0);
        printf("%s %.6g",
               i == 0  ? ""
               : i < 3 ? ","
                       : " and",
               (double)rt_radiance(&scene, &ray, bounces[i], &rng).x);
    }
    const int paths = 100000;
    double sum = 0, squares = 0;
    int hits = 0;
    for (uint32_t k = 0; k < (uint32_t)paths; k++) {
        rt_rng rng = rt_rng_start(0, k, 0);
        const double light = roulette(&scene, ray, &rng, &hits);
        sum += light;
        squares += light * light;
    }
    const double mean = sum / paths;
    printf("\nroulette: %.3f\nroulette-error: %.3f\nhits: %.2f\n", mean,
           sqrt((squares / paths - mean * mean) / paths), (double)hits / paths);

    double by_cosine = 0, even = 0;
    rt_rng rng = rt_rng_start(0, 0, 0);
    for (int i = 0; i < 1000000; i++) {
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        by_cosine += (double)rt_sample_cosine(rt_vec(0, 1, 0), r1, r2).y;
        even += (double)r2; /* z = r2 */
    }
    printf("cosines: %.4f and %.4f\n", even / 1e6, by_cosine / 1e6);
}

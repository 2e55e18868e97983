/* Chapter 12: the noise of four ways to find a lamp. A ball of rough metal, alone under a lamp,
 * 64 x 64 pixels, 32 random samples for each of them. The noise is the rms difference of two
 * pictures of different seeds over sqrt(2), over the pixels that see the ball, and over their mean;
 * the mean of 8 pairs.
 *
 * rt_radiance_mis makes all of them, each with its own rt_mis. Which way asks it? If a
 * surface aims, density is what rt_lamp_density has just returned; if a path has met the
 * lamp, other is. */
#define rt_lamp_density my_lamp_density
#define rt_mis my_mis
#include "rt.h"
#include <stdio.h>

enum { AIM, CHANCE, BALANCE, POWER, WAYS };
static int way;
static float last;

static inline float my_lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    (void)direction;
    return last = 1 / (6.28318530718f * rt__cap(lamp, point));
}

static inline float my_mis(float density, float other)
{
    const bool aimed = density == last;
    const double ratio = (double)other / (double)density;
    switch (way) {
    case AIM: return aimed ? 1 : 0;
    case CHANCE: return aimed ? 0 : 1;
    case BALANCE: return (float)(1 / (1 + ratio));
    default: return (float)(1 / (1 + ratio * ratio));
    }
}

enum { SIZE = 64, SAMPLES = 32, PAIRS = 8, ROWS = 5 };

static double mean_of(const rt_scene *scene, int x, int y, uint32_t seed)
{
    const rt_camera camera = {.position = {0, 0, 5}, .fov_y = 25};
    double sum = 0;
    for (uint32_t k = 0; k < SAMPLES; k++) {
        rt_rng rng = rt_rng_start((uint32_t)(SIZE * y + x), k, seed);
        const float u = rt_random(&rng), v = rt_random(&rng);
        const rt_ray ray = rt_camera_ray(&camera, SIZE, SIZE, (float)x + u, (float)y + v);
        sum += (double)rt_radiance_mis(scene, &ray, 0, &rng).x;
    }
    return sum / SAMPLES;
}

static double noise_of(const rt_scene *scene)
{
    double squares = 0, sum = 0;
    int count = 0;
    for (int y = 0; y < SIZE; y++)
        for (int x = 0; x < SIZE; x++) {
            const float dx = (float)x + 0.5f - SIZE / 2, dy = (float)y + 0.5f - SIZE / 2;
            if (dx * dx + dy * dy > 26 * 26) /* the edge of the ball is at 29 */
                continue;
            for (uint32_t pair = 0; pair < PAIRS; pair++) {
                const double a = mean_of(scene, x, y, 2 * pair);
                const double b = mean_of(scene, x, y, 2 * pair + 1);
                squares += (a - b) * (a - b) / 2;
                sum += (a + b) / 2;
                count++;
            }
        }
    return sqrt(squares / count) / (sum / count);
}

int main(void)
{
    const struct {
        const char *name;
        bool metal;
        float shininess, radius;
    } rows[ROWS] = {{"rough metal", true, 10, 1},
                    {"rough metal", true, 10, 12},
                    {"smooth metal", true, 2000, 1},
                    {"smooth metal", true, 2000, 12},
                    {"smooth lacquer", false, 2000, 12}};
    double noise[ROWS][WAYS];
    printf("| the ball | shininess | radius of the lamp | aim | chance | both, balance | "
           "both, "
           "power |\n|---|---|---|---|---|---|---|\n");
    for (int row = 0; row < ROWS; row++) {
        const float radius = rows[row].radius;
        const rt_sphere ball = {{0, 0, 0}, 1, {{0.8f, 0.8f, 0.8f}, rows[row].metal}};
        const rt_surface finish = {.shininess = rows[row].shininess};
        const float i = 3.14159265f * radius * radius; /* radiance 1 */
        const rt_lamp lamp = {
            .center = {12, 16, 12}, .radius = radius, .intensity = {i, i, i}};
        const rt_scene scene = {.spheres = &ball,
                                .sphere_count = 1,
                                .surfaces = &finish,
                                .lamps = &lamp,
                                .lamp_count = 1};
        printf("| %s | %g | %g |", rows[row].name, (double)rows[row].shininess,
               (double)radius);
        for (way = 0; way < WAYS; way++) {
            noise[row][way] = noise_of(&scene);
            printf(" %.*f |", noise[row][way] < 1 ? 3 : 2, noise[row][way]);
        }
        printf("\n");
    }
    printf("metal-aim: %.0f\nsmall-chance: %.0f\n",
           pow(noise[3][AIM] / noise[3][POWER], 2),
           pow(noise[1][CHANCE] / noise[1][POWER], 2));
    printf("lacquer-aim: %.1f\nlacquer-chance: %.0f\n",
           pow(noise[4][AIM] / noise[4][POWER], 2),
           pow(noise[4][CHANCE] / noise[4][POWER], 2));
    printf("rough-chance: %.2g\n", pow(noise[0][CHANCE] / noise[0][POWER], 2));
}

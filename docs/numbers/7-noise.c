/* Chapter 7: the noise, from two pictures of different seeds. 160 x 120. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

static rt_vec3 pixels[2][160 * 120];

int main(void)
{
    const int counts[6] = {1, 4, 15, 16, 64, 256};
    printf("| samples $`n`$ |");
    for (int i = 0; i < 6; i++)
        printf(" %d |", counts[i]);
    printf("\n|---|---|---|---|---|---|---|\n| noise |");
    for (int i = 0; i < 6; i++) {
        for (unsigned seed = 0; seed < 2; seed++) {
            rt_image image = {.width = 160, .height = 120, .pixels = pixels[seed]};
            const rt_options options = {.samples = counts[i],
                                        .bounces = 5,
                                        .seed = seed + 1,
                                        .sampler = RT_RANDOM};
            rt_render(&scene_indirect, &room_camera, &options, &image);
        }
        double square = 0, sum = 0;
        for (int k = 0; k < 160 * 120; k++) {
            const rt_vec3 d = rt_sub(pixels[0][k], pixels[1][k]), c = pixels[0][k];
            square += (double)rt_dot(d, d);
            sum += (double)(c.x + c.y + c.z);
        }
        const double n = 3 * 160 * 120;
        printf(" %.1f %% |", 100 * sqrt(square / n / 2) / (sum / n));
    }
    printf("\n| $`1/\\sqrt n`$ |");
    for (int i = 0; i < 6; i++)
        printf(" %.3g |", sqrt(1.0 / counts[i]));
    printf("\n");
}

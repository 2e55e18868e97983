/* Chapter 7: how much of the light is there after so many bounces? 160 x 120, 256 samples. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

static rt_vec3 pixels[160 * 120];

static double light(int bounces)
{
    rt_image image = {.width = 160, .height = 120, .pixels = pixels};
    const rt_options options = {.samples = 256, .bounces = bounces, .sampler = RT_RANDOM};
    rt_render(&scene_indirect, &room_camera, &options, &image);
    double sum = 0;
    for (int i = 0; i < 160 * 120; i++)
        sum += (double)(pixels[i].x + pixels[i].y + pixels[i].z);
    if (bounces == 5)
        printf("rays: %.1f\nmillion: %.0f\n", (double)image.rays / (256.0 * 160 * 120),
               (double)image.rays / (256.0 * 160 * 120) * 256 * 640 * 480 / 1e6);
    return sum;
}

int main(void)
{
    const int bounces[5] = {0, 1, 2, 3, 5};
    const double all = light(20);
    char row[200] = "| light in the picture |";
    for (int i = 0; i < 5; i++)
        sprintf(row + strlen(row), " %.0f %% |", 100 * light(bounces[i]) / all);
    printf("| bounces | 0 | 1 | 2 | 3 | 5 |\n|---|---|---|---|---|---|\n%s\n", row);
}

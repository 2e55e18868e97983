/* The room with 64 x 48 pixels, and how far a picture is from one with 8192 samples. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { COUNT = 64 * 48, SEEDS = 2 };
static rt_vec3 truth[COUNT], picture[COUNT], half[COUNT];

static rt_image render(rt_vec3 *pixels, rt_vec3 *halves, int samples, uint32_t seed,
                       rt_sampler sampler)
{
    rt_image image = {.width = 64, .height = 48, .pixels = pixels, .half = halves};
    const rt_options options = {
        .samples = samples, .bounces = 5, .seed = seed, .sampler = sampler};
    rt_render(&scene_indirect, &room_camera, &options, &image);
    return image;
}

static double distance_from_truth(void)
{
    double squares = 0, sum = 0;
    for (int i = 0; i < COUNT; i++) {
        const rt_vec3 d = rt_sub(picture[i], truth[i]), c = truth[i];
        squares += (double)rt_dot(d, d);
        sum += (double)(c.x + c.y + c.z);
    }
    return sqrt(squares / (3 * COUNT)) / (sum / (3 * COUNT));
}

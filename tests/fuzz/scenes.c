/* libFuzzer: the bytes are a whole small scene and the options. rt_render refuses it, or makes
 * a picture without NaN, infinity or negative values. */
#include <stdlib.h>
#include <string.h>

#define RT_IMPLEMENTATION
#include "../../rt.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

typedef struct input {
    rt_sphere spheres[3];
    rt_box boxes[2];
    rt_light lights[2];
    rt_camera camera;
    rt_vec3 background;
    int8_t counts[3], width, height, samples, bounces, threads;
    uint8_t mirrors;
} input;

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size)
{
    static input in;
    static rt_vec3 pixels[16];
    memset(&in, 0, sizeof in);
    memcpy(&in, data, size < sizeof in ? size : sizeof in);
    for (int i = 0; i < 3; i++) /* a bool that is neither 0 nor 1 is undefined */
        memset(&in.spheres[i].material.mirror, in.mirrors >> i & 1, sizeof(bool));
    for (int i = 0; i < 2; i++)
        memset(&in.boxes[i].material.mirror, in.mirrors >> (3 + i) & 1, sizeof(bool));

    rt_scene scene;
    rt_options options;
    static rt_vec3 half[16];
    rt_image image;
    memset(&image, 0, sizeof image);
    image.width = in.width % 5;
    image.height = in.height % 5;
    image.pixels = pixels;
    image.half = (in.mirrors >> 7 & 1) != 0 ? half : NULL;
    memset(&scene, 0, sizeof scene);
    memset(&options, 0, sizeof options);
    scene.spheres = in.spheres;
    scene.sphere_count = in.counts[0] % 4;
    scene.boxes = in.boxes;
    scene.box_count = in.counts[1] % 3;
    scene.lights = in.lights;
    scene.light_count = in.counts[2] % 3;
    scene.background = in.background;
    options.samples = in.samples % 3;
    options.bounces = in.bounces;
    options.threads = in.threads % 2;
    options.sampler = (in.mirrors >> 5 & 1) != 0 ? RT_RANDOM : RT_SOBOL;
    options.lanes = in.mirrors >> 6 & 1; /* 1: one ray at a time, 0: packets */
    if (rt_render(&scene, &in.camera, &options, &image) != RT_OK)
        return 0;
    for (int i = 0; i < image.width * image.height; i++)
        if (!(pixels[i].x >= 0.0f && pixels[i].y >= 0.0f && pixels[i].z >= 0.0f &&
              pixels[i].x <= FLT_MAX && pixels[i].y <= FLT_MAX && pixels[i].z <= FLT_MAX))
            abort();
    return 0;
}

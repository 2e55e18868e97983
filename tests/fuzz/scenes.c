/* libFuzzer: the bytes are a whole small scene, with meshes and what a custom shape's
 * function says, and the options. rt_render refuses it, or makes a picture without NaN,
 * infinity or negative values. */
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
    rt_vec3 background, corners[5], own[2], answer[2];
    float answer_t;
    int8_t indices[9], mesh_counts[4], positions;
    int8_t counts[3], width, height, samples, bounces, threads;
    uint8_t mirrors;
} input;

/* Whatever the bytes say. */
static bool say(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const input *in = data;
    hit->t = in->answer_t > 0.0f ? in->answer_t : t_max * 0.5f;
    hit->point = in->answer_t > 1.0f ? rt_at(ray, hit->t) : in->answer[0];
    hit->normal = in->answer[1];
    return in->answer[1].x < 1e3f || ray->direction.x > 0.0f;
}

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
    static int indices[9]; /* -1 and one too many among them */
    rt_mesh meshes[2];
    rt_custom_shape shape;
    for (int i = 0; i < 9; i++)
        indices[i] = in.indices[i] % 7 == 0 ? in.indices[i] : (in.indices[i] & 127) % 5;
    memset(meshes, 0, sizeof meshes);
    memset(&shape, 0, sizeof shape);
    for (int i = 0; i < 2; i++) {
        meshes[i].positions = in.corners;
        meshes[i].position_count = in.positions % 6;
        meshes[i].indices = indices + 3 * i;
        meshes[i].triangle_count = in.mesh_counts[i] % 3;
        meshes[i].material = in.spheres[i].material;
    }
    scene.meshes = meshes;
    scene.mesh_count = in.mesh_counts[2] % 3;
    shape.min = in.own[0];
    shape.max = in.own[1];
    shape.material = in.spheres[2].material;
    shape.hit = say;
    shape.data = &in;
    scene.custom_shapes = &shape;
    scene.custom_shape_count = in.mesh_counts[3] % 2;
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

/* One frame of a film, for any scheduler: "frame 3 60" writes the third of 60 frames to frame-3.ppm. */
#define RT_IMPLEMENTATION
#include "rt.h"

#include <stdio.h>
#include <stdlib.h>

enum { WIDTH = 320, HEIGHT = 240 };
static const rt_sphere spheres[] = {{{0, 0, 0}, 1, {{0.85f, 0.10f, 0.08f}, false}},
                                    {{2, -0.5f, 0}, 0.5f, {{0.1f, 0.3f, 0.8f}, false}},
                                    {{0, -101, 0}, 100, {{0.8f, 0.8f, 0.8f}, false}}};
static const rt_light lights[] = {{{3, 4, 3}, {150, 150, 150}}};
static const rt_scene scene = {
    .spheres = spheres, .sphere_count = 3, .lights = lights, .light_count = 1};
static rt_vec3 pixels[WIDTH * HEIGHT];

/* Once around the balls: a turn is 2 pi. */
static rt_camera camera_at(float turn)
{
    return (rt_camera){.position = {6 * sinf(turn), 1, 6 * cosf(turn)},
                       .direction = {-sinf(turn), -0.15f, -cosf(turn)},
                       .up = {0, 1, 0},
                       .fov_y = 45};
}

int main(int argc, char **argv)
{
    const int k = argc == 3 ? atoi(argv[1]) : 0, n = argc == 3 ? atoi(argv[2]) : 0;
    if (k < 1 || k > n)
        return 2;
    const rt_camera camera = camera_at(6.2831853f * (float)k / (float)n);
    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels};
    char name[50], unfinished[80];
    snprintf(name, sizeof name, "frame-%d.ppm", k);
    snprintf(unfinished, sizeof unfinished, "%s.unfinished", name);
    if (fopen(name, "rb"))
        return 0;
    const rt_status status = rt_render(
        &scene, &camera, &(rt_options){.bounces = 5, .seed = (uint32_t)k}, &image);
    FILE *file = status == RT_OK ? fopen(unfinished, "wb") : NULL;
    if (!file || fprintf(file, "P6 %d %d 255\n", WIDTH, HEIGHT) < 0)
        return 1;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const float rgb[3] = {pixels[i].x, pixels[i].y, pixels[i].z};
        for (int c = 0; c < 3; c++)
            putc(rt_encode(rgb[c], 2.2), file);
    }
    return ferror(file) || fclose(file) != 0 || rename(unfinished, name) != 0;
}

/* One part of a picture, for any scheduler: "job 3 60" writes the third of 60 parts to
 * part-3-of-60.raw. If that is there, there is nothing to do. */
#define RT_IMPLEMENTATION
#include "rt.h"

#include <stdio.h>
#include <stdlib.h>

static const rt_sphere spheres[] = {{{0, 0, -5}, 1, {{0.85f, 0.10f, 0.08f}, false}},
                                    {{0, -101, -5}, 100, {{0.8f, 0.8f, 0.8f}, false}}};
static const rt_light lights[] = {{{3, 4, -2}, {150, 150, 150}}};
static const rt_scene scene = {
    .spheres = spheres, .sphere_count = 2, .lights = lights, .light_count = 1};

int main(int argc, char **argv)
{
    const long long all = 640 * 480;
    const long long k = argc == 3 ? atoi(argv[1]) : 0, n = argc == 3 ? atoi(argv[2]) : 0;
    if (k < 1 || k > n || n > all)
        return 2;
    char name[80], unfinished[100];
    snprintf(name, sizeof name, "part-%lld-of-%lld.raw", k, n);
    snprintf(unfinished, sizeof unfinished, "%s.unfinished", name);
    if (fopen(name, "rb"))
        return 0; /* somebody has done it */

    rt_image image = {.width = 640, .height = 480};
    image.first = (int)(all * (k - 1) / n);
    image.count = (int)(all * k / n) - image.first;
    image.pixels = malloc((size_t)image.count * sizeof *image.pixels);
    const rt_status status =
        rt_render(&scene, &(rt_camera){.fov_y = 60}, &(rt_options){.bounces = 5}, &image);

    FILE *file = status == RT_OK ? fopen(unfinished, "wb") : NULL;
    const size_t size = (size_t)image.count * sizeof *image.pixels;
    return !file || fwrite(image.pixels, 1, size, file) != size || fclose(file) != 0 ||
           rename(unfinished, name) != 0;
}

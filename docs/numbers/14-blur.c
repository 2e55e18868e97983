/* Chapter 14: how large is the picture of a point that is out of focus? Tiny balls that shine,
 * on the axis of the room's camera, seen through the room's lens; against the formula. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { WIDTH = 48, HEIGHT = 48, TALL = 480 }; /* the middle of a picture 640 x 480 */
static rt_vec3 pixels[WIDTH * HEIGHT];

/* The width of a pixel of 640 x 480 in the sharp plane. */
static double pixel_size(double focus, double fov)
{
    return 2 * tan(fov * 3.14159265358979 / 360) * focus / TALL;
}

static double formula(double z, double R, double f, double fov)
{
    return R * fabs(z - f) / z / pixel_size(f, fov);
}

/* The light of a ball at distance z is spread over a disc. For an even one of radius r,
 * the mean of the squared distance from the middle is r^2 / 2. */
static double measured(double z)
{
    rt_camera camera = room_camera;
    camera.position = rt_vec(0, 0, 0);
    camera.direction = rt_vec(0, 0, -1);
    camera.fov_y =
        (float)(2 * 57.29577951 * atan(tan(46 / 57.29577951 / 2) * HEIGHT / TALL));
    const rt_sphere ball = {{0, 0, -(float)z}, 0.1f, {{0, 0, 0}, false}};
    const rt_surface shines = {.emission = {1, 1, 1}};
    const rt_scene scene = {.spheres = &ball, .sphere_count = 1, .surfaces = &shines};
    const rt_options options = {.samples = 1024, .lens = room_lens};
    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels};
    memset(pixels, 0, sizeof pixels);
    rt_render(&scene, &camera, &options, &image);
    double light = 0, square = 0;
    for (int i = 0; i < WIDTH * HEIGHT; i++) {
        const double x = i % WIDTH + 0.5 - WIDTH / 2, y = i / WIDTH + 0.5 - HEIGHT / 2;
        light += (double)pixels[i].x;
        square += (double)pixels[i].x * (x * x + y * y);
    }
    return sqrt(2 * square / light);
}

int main(void)
{
    const double z[] = {40, 60, 75, 81, 87, 120, 165}, R = (double)room_lens.radius;
    const double f = (double)room_lens.focus;
    printf("| distance z | 40 | 60 | 75 | 81 | 87 | 120 | 165 |\n"
           "|---|---|---|---|---|---|---|---|\n| formula, pixels |");
    for (int i = 0; i < 7; i++)
        printf(" %.1f |", formula(z[i], R, f, 46));
    printf("\n| measured, pixels |");
    for (int i = 0; i < 7; i++)
        printf(" %.1f |", measured(z[i]));
    const double one = pixel_size(f, 46) / R; /* r = 1: |z - f| / z = this */
    printf("\nwall: %.1f\nnear: %.1f\nfar: %.1f\nhalf-near: %.1f\nhalf-far: %.1f\n"
           "pixel: %.3f\nlimit: %.1f\ninfinity: %.1f\n",
           formula(165, R, f, 46), f / (1 + one), f / (1 - one), f / (1 + one * 2),
           f / (1 - one * 2), pixel_size(f, 46), R / pixel_size(f, 46),
           R / 165 / pixel_size(1, 46));
}

/* Chapter 14: the sun as a lamp far away, and as a bright spot in the sky. The light of a
 * white floor under it, and the noise of 16 samples; the same for the room; and the light
 * of the evening's sky on an open floor. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

static const rt_box white = {{-50, -1, -50}, {50, 0, 50}, {{1, 1, 1}, false}};

typedef struct spot {
    rt_vec3 toward;
    float cosine; /* of the angle between its middle and its rim */
    float radiance;
} spot;

static rt_vec3 spot_sky(const void *data, rt_vec3 direction)
{
    const spot *s = data;
    const float l = rt_dot(direction, s->toward) > s->cosine ? s->radiance : 0;
    return rt_vec(l, l, l);
}

/* The mean of what a ray onto the floor brings back, and its noise with 16 samples. */
static double look(const rt_scene *scene, int n, double *noise)
{
    const rt_ray ray = {{0, 1, 0}, {0, -1, 0}};
    double sum = 0, square = 0;
    for (int i = 0; i < n; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 3);
        const double v = (double)rt_radiance_mis(scene, &ray, 1, &rng).x;
        sum += v / n;
        square += v * v / n;
    }
    *noise = sqrt((square - sum * sum) / 16) / sum;
    return sum;
}

static void row(const char *key, double degrees)
{
    const double pi = 3.14159265358979, far = 1e5, sine = sin(degrees * pi / 180);
    const rt_vec3 toward = rt_vec(0.6f, 0.8f, 0);
    rt_lamp sun = {.center = rt_scale(toward, (float)far),
                   .radius = (float)(far * sine),
                   .intensity = {1e10f, 1e10f, 1e10f}};
    const spot s = {toward, (float)cos(degrees * pi / 180), rt_lamp_radiance(&sun).x};
    rt_scene lamp = {.boxes = &white, .box_count = 1, .lamps = &sun, .lamp_count = 1};
    rt_scene sky = {.boxes = &white, .box_count = 1, .sky = spot_sky, .sky_data = &s};
    double of_lamp, of_sky;
    const double exact = 1e10 * 0.8 / (far * far) / pi;
    const double a = look(&lamp, 200000, &of_lamp), b = look(&sky, 20000000, &of_sky);
    printf(" %.4f | %.4f | %.4f | %.2f %% | %.0f %% |\n", exact, a, b, 100 * of_lamp,
           100 * of_sky);
    printf("%s-rays: %.0f\n", key, 1 / (sine * sine * 0.8));
}

static rt_vec3 sky_with_sun(const void *data, rt_vec3 direction)
{
    const rt_vec3 sky = room_sky(NULL, direction), light = rt_lamp_radiance(&room_sun);
    const spot *s = data;
    return rt_dot(direction, s->toward) > s->cosine ? rt_add(sky, light) : sky;
}

/* The error of demo 14's room, 80 x 60 pixels and 64 samples. */
static double room(bool lamp, bool glass)
{
    enum { COUNT = 80 * 60 };
    static rt_vec3 pixels[COUNT], half[COUNT];
    const float d = rt_length(room_sun.center), sine = room_sun.radius / d;
    const spot s = {rt_scale(room_sun.center, 1 / d), sqrtf(1 - sine * sine), 0};
    const rt_surface no_glass[ROOM_SHAPES] = {
        [ROOM_BALL] = {.shininess = 300}, [ROOM_MIRROR] = {.shininess = 60}};
    rt_scene scene = scene_sky;
    if (!lamp) {
        scene.lamp_count = 0;
        scene.sky = sky_with_sun;
        scene.sky_data = &s;
    }
    if (!glass)
        scene.surfaces = no_glass;
    memset(pixels, 0, sizeof pixels);
    rt_image image = {.width = 80, .height = 60, .pixels = pixels, .half = half};
    const rt_options options = {.samples = 64, .bounces = 8, .lens = room_lens};
    rt_render(&scene, &room_camera, &options, &image);
    return 100 * (double)rt_image_error(&image);
}

int main(void)
{
    printf("| half the angle of the sun | light by formula | as a lamp | in the sky | "
           "noise as a "
           "lamp | noise in the sky |\n|---|---|---|---|---|---|\n");
    printf("| 6.9°: the demo's |");
    row("demo", 6.9);
    printf("| 0.27°: ours |");
    row("ours", 0.267);
    /* exercise 5: the evening's sky on an open white floor */
    const rt_scene open = {.boxes = &white, .box_count = 1, .sky = room_sky};
    const rt_ray ray = {{0, 1, 0}, {0, -1, 0}};
    double sum[3] = {0};
    for (int i = 0; i < 1000000; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 4);
        const rt_vec3 v = rt_radiance_mis(&open, &ray, 1, &rng);
        sum[0] += (double)v.x / 1e6;
        sum[1] += (double)v.y / 1e6;
        sum[2] += (double)v.z / 1e6;
    }
    printf("sky: (%.3f, %.3f, %.3f)\n", sum[0], sum[1], sum[2]);
    printf("room-lamp: %.0f\nroom-sky: %.0f\nglass-lamp: %.0f\nglass-sky: %.0f\n",
           room(true, false), room(false, false), room(true, true), room(false, true));
    /* the demo's sun: how far, how large, and what it gives a surface that faces it */
    const double d = (double)rt_length(room_sun.center);
    printf("distance: %.0f\nangle: %.1f\nfacing: %.2f\nradiance: %.0f\n", d,
           57.29577951 * asin((double)room_sun.radius / d),
           (double)room_sun.intensity.x / d / d, (double)rt_lamp_radiance(&room_sun).x);
}

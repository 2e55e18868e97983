/* What the tests share: cmocka, comparisons that reject NaN, random inputs, reference files.
 * Each test file is a program of its own. Tests run in the top folder of the project. */
#ifndef TEST_H
#define TEST_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#ifndef LINKED /* with rt.o, as most are: rt.h takes long to compile */
#define RT_IMPLEMENTATION
#endif
#include "../rt.h"

#define COUNT(array) (sizeof(array) / sizeof((array)[0]))

/* cmocka's assert_float_equal accepts NaN; these do not. */
#define assert_close(actual, expected, tolerance)                                        \
    do {                                                                                 \
        const double a_ = (double)(actual), e_ = (double)(expected);                     \
        if (!(fabs(a_ - e_) <= (double)(tolerance)))                                     \
            fail_msg("%s = %.9g, expected %.9g within %.3g", #actual, a_, e_,            \
                     (double)(tolerance));                                               \
    } while (0)

#define assert_vec(actual, X, Y, Z, tolerance)                                           \
    do {                                                                                 \
        const rt_vec3 v_ = (actual);                                                     \
        if (!(fabs((double)v_.x - (double)(X)) <= (double)(tolerance) &&                 \
              fabs((double)v_.y - (double)(Y)) <= (double)(tolerance) &&                 \
              fabs((double)v_.z - (double)(Z)) <= (double)(tolerance)))                  \
            fail_msg("%s = (%.9g, %.9g, %.9g), expected (%.9g, %.9g, %.9g) within %.3g", \
                     #actual, (double)v_.x, (double)v_.y, (double)v_.z, (double)(X),     \
                     (double)(Y), (double)(Z), (double)(tolerance));                     \
    } while (0)

/* ---- random inputs, the same in every run
 * ------------------------------------------- */

static inline float uniform(rt_rng *rng, float low, float high)
{
    return low + (high - low) * rt_random(rng);
}

static inline rt_vec3 random_point(rt_rng *rng, float size)
{
    const float x = uniform(rng, -size, size);
    const float y = uniform(rng, -size, size);
    const float z = uniform(rng, -size, size);
    return rt_vec(x, y, z);
}

static inline rt_vec3 random_direction(rt_rng *rng)
{
    for (;;) {
        const rt_vec3 v = random_point(rng, 1.0f);
        if (rt_length(v) <= 1.0f && rt_length(v) > 0.01f)
            return rt_normalize(v);
    }
}

static inline rt_vec3 random_colour(rt_rng *rng)
{
    const float r = rt_random(rng);
    const float g = rt_random(rng);
    const float b = rt_random(rng);
    return rt_vec(r, g, b);
}

static inline rt_ray ray_of(rt_vec3 origin, rt_vec3 direction)
{
    rt_ray ray;
    ray.origin = origin;
    ray.direction = direction;
    return ray;
}

/* A hit that no function has written to. */
static const rt_hit untouched = {
    .t = -7, .point = {1, 2, 3}, .normal = {4, 5, 6}, .shape = -7};

#define assert_untouched(hit)                                                            \
    do {                                                                                 \
        assert_memory_equal(&(hit), &untouched,                                          \
                            offsetof(rt_hit, normal) + sizeof(rt_vec3));                 \
        assert_null((hit).material);                                                     \
    } while (0)

/* Some spheres, boxes and lights in a cube of 20 units, one mirror in four shapes. */
typedef struct random_scene {
    rt_sphere spheres[5];
    rt_box boxes[4];
    rt_light lights[3];
    rt_scene scene;
} random_scene;

static inline void make_random_scene(random_scene *r, rt_rng *rng)
{
    for (size_t i = 0; i < COUNT(r->spheres); i++) {
        r->spheres[i].center = random_point(rng, 10.0f);
        r->spheres[i].radius = uniform(rng, 1.0f, 5.0f);
        r->spheres[i].material.albedo = random_colour(rng);
        r->spheres[i].material.mirror = rt_random(rng) < 0.25f;
    }
    for (size_t i = 0; i < COUNT(r->boxes); i++) {
        const rt_vec3 size = random_colour(rng);
        r->boxes[i].min = random_point(rng, 10.0f);
        r->boxes[i].max = rt_add(r->boxes[i].min, rt_scale(size, 5.0f));
        r->boxes[i].material.albedo = random_colour(rng);
        r->boxes[i].material.mirror = rt_random(rng) < 0.25f;
    }
    for (size_t i = 0; i < COUNT(r->lights); i++) {
        r->lights[i].position = random_point(rng, 10.0f);
        r->lights[i].intensity = rt_scale(random_colour(rng), 100.0f);
    }
    memset(&r->scene, 0, sizeof r->scene);
    r->scene.spheres = r->spheres;
    r->scene.sphere_count = (int)COUNT(r->spheres);
    r->scene.boxes = r->boxes;
    r->scene.box_count = (int)COUNT(r->boxes);
    r->scene.lights = r->lights;
    r->scene.light_count = (int)COUNT(r->lights);
}

/* A ray from about the scene through the middle of it. */
static inline rt_ray random_ray(rt_rng *rng)
{
    const rt_vec3 origin = random_point(rng, 12.0f);
    return ray_of(origin, rt_sub(random_point(rng, 8.0f), origin));
}

/* ---- images ------------------------------------------------------------------------- */

static inline rt_image new_image(int width, int height)
{
    rt_image image = {.width = width, .height = height};
    image.pixels = calloc((size_t)width * (size_t)height, sizeof *image.pixels);
    assert_non_null(image.pixels);
    return image;
}

static inline bool same_pixels(const rt_image *a, const rt_image *b)
{
    const size_t size = (size_t)a->width * (size_t)a->height * sizeof *a->pixels;
    return a->width == b->width && a->height == b->height &&
           memcmp(a->pixels, b->pixels, size) == 0;
}

/* ---- the chapter's demo: DEMO names its file; main and demo_main are ours ----------- */

#ifdef DEMO
#include "../demos/demo.h"

static demo the_demo; /* what the demo's main hands to demo_main */

int demo_main(int argc, char **argv, const demo *d)
{
    (void)argc;
    (void)argv;
    the_demo = *d;
    return 0;
}

unsigned char demo_linear(float value)
{
    return rt_encode(value, 1.0);
}

unsigned char demo_gamma(float value)
{
    return rt_encode(value, 2.2);
}

double demo_seconds(void)
{
    return 0.0;
}

#define LIVE_H /* nobody looks through a window here: less to compile */
#include "../demos/explain.h"
#include "../demos/scene.h"
static const demo_live live_room;

#define main main_of_the_demo
#include DEMO
#undef main

static rt_vec3 call_the_demo(const void *view, float x, float y, rt_rng *rng)
{
    return the_demo.pixel(view, x, y, rng);
}

/* The demo's picture with the bounces and the sampler that it has by default; free the pixels
 * and, which may be NULL, half. */
static inline rt_image render_the_demo(int width, int height, int samples, uint32_t seed)
{
    rt_image image = new_image(width, height);
    main_of_the_demo(0, NULL);
    const demo_view view = {width, height, the_demo.bounces};
    const rt_options options = {.samples = samples,
                                .bounces = the_demo.bounces,
                                .seed = seed,
                                .sampler = the_demo.sobol ? RT_SOBOL : RT_RANDOM};
    if (the_demo.estimate)
        image.half = calloc((size_t)width * (size_t)height, sizeof *image.half);
    assert_true(image.half || !the_demo.estimate);
    assert_int_equal(the_demo.render
                         ? the_demo.render(&options, &image)
                         : rt_render_pixels(call_the_demo, &view, &options, &image),
                     RT_OK);
    return image;
}

/* The demo's picture of this scene is rt_render's, to the bit, whatever the lanes. (Here
 * rt.h has its own routines; 09_command_line compares with those of the demo.) */
static inline void check_against_rt_render(const rt_scene *scene)
{
    rt_image theirs = render_the_demo(40, 30, 4, 1), ours = new_image(40, 30);
    const rt_options options = {.samples = 4, .bounces = the_demo.bounces, .seed = 1};
    assert_int_equal(rt_render(scene, &room_camera, &options, &ours), RT_OK);
    assert_memory_equal(theirs.pixels, ours.pixels, 40 * 30 * sizeof *ours.pixels);
    free(theirs.pixels);
    free(ours.pixels);
}

/* The picture, small, is what it was when somebody last looked at it and found it right:
 * tests/references/demoNN.ppm, recorded by "make golden". Byte for byte. */
static inline void check_golden(void)
{
    enum { W = 64, H = 48 };
    static unsigned char bytes[W * H * 3], golden[W * H * 3];
    rt_image image = render_the_demo(W, H, 4, 0);
    for (int i = 0; i < W * H; i++) {
        bytes[3 * i + 0] = the_demo.encode(image.pixels[i].x);
        bytes[3 * i + 1] = the_demo.encode(image.pixels[i].y);
        bytes[3 * i + 2] = the_demo.encode(image.pixels[i].z);
    }
    free(image.pixels);
    free(image.half);

    char path[100];
    const char *mode = getenv("GOLDEN");
    const bool record = mode && strcmp(mode, "record") == 0;
    snprintf(path, sizeof path, "tests/references/%s.ppm", the_demo.name);
    FILE *file = fopen(path, record ? "wb" : "rb");
    if (!file)
        fail_msg("cannot open %s", path);
    if (record) {
        fprintf(file, "P6 %d %d 255\n", W, H);
        assert_int_equal(fwrite(bytes, 1, sizeof bytes, file), sizeof bytes);
    } else {
        int width = 0, height = 0;
        assert_int_equal(fscanf(file, "P6 %d %d 255", &width, &height), 2);
        assert_int_equal(fgetc(file), '\n');
        assert_int_equal(width, W);
        assert_int_equal(height, H);
        assert_int_equal(fread(golden, 1, sizeof golden, file), sizeof golden);
        for (int i = 0; i < W * H * 3; i++)
            if (bytes[i] != golden[i])
                fail_msg("%s: pixel (%d, %d) channel %d is %d, was %d", path, i / 3 % W,
                         i / 3 / W, i % 3, bytes[i], golden[i]);
    }
    assert_int_equal(fclose(file), 0);
}
#endif /* DEMO */

#endif

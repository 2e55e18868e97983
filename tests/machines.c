/* Chapter 18's loop by MPI against rt_render alone: bits, rays, and what goes wrong on one machine. */
#include "../demos/live.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FAILS_ON_ONE = 77 }; /* a seed */

static rt_status render_or_fail(const rt_scene *scene, const rt_camera *camera,
                                const rt_options *options, rt_image *image);

#define rt_render render_or_fail
#define main demo18_main
#include "../demos/demo18_many_machines.c"
#undef main
#undef rt_render

/* Machine 1 has no memory for its second part. */
static rt_status render_or_fail(const rt_scene *scene, const rt_camera *camera,
                                const rt_options *options, rt_image *image)
{
    const bool fails = options->seed == FAILS_ON_ONE && machine == 1 && image->rays > 0;
    return fails ? RT_NO_MEMORY : rt_render(scene, camera, options, image);
}

static bool until_half(void *user, float part)
{
    (void)user;
    return part < 0.5f;
}

static int failures;

static void expect_that(bool holds, const char *what)
{
    if (!holds)
        printf("%d machines: not so: %s\n", machines, what);
    failures += !holds;
}

/* In the place of the demos' program. */
int demo_main(int argc, char **argv, const demo *d)
{
    enum {
        WIDTH = 150,
        HEIGHT = 101,
        ALL = WIDTH * HEIGHT,
        PARTS = (ALL - 1) / PART + 1
    };
    static rt_vec3 pixels[ALL], expected[ALL];
    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels};
    rt_image alone = {.width = WIDTH, .height = HEIGHT, .pixels = expected};
    rt_options options = {.samples = 8, .bounces = 5, .threads = 1};
    (void)argc, (void)argv;
    expect_that(d->render(&options, &image) == RT_OK, "a picture is rendered");
    rt_render(&scene_indirect, &room_camera, &options, &alone);
    expect_that(memcmp(pixels, expected, sizeof pixels) == 0,
                "it has the bits of one machine");
    expect_that(image.rays == alone.rays, "and its rays");
    expect_that(image.samples == 8, "and its samples");

    rt_image_clear(&image);
    memset(pixels, 0, sizeof pixels);
    options.samples = 100;
    options.progress = until_half;
    expect_that(d->render(&options, &image) == RT_CANCELLED,
                "a picture can be cancelled");
    expect_that(machines == 1 || take(0) >= PARTS, "then nobody takes another part");
    expect_that(machines == 1 || image.samples == 0, "it has not all samples");
    expect_that(pixels[0].x > 0, "what was done is there");

    rt_image_clear(&image);
    options = (rt_options){.samples = 8, .threads = 1, .seed = FAILS_ON_ONE};
    expect_that(d->render(&options, &image) == (machines > 1 ? RT_NO_MEMORY : RT_OK),
                "a failure on another machine is one of the whole");
    rt_image_clear(&image);
    options = (rt_options){.samples = -1};
    expect_that(d->render(&options, &image) == RT_BAD_SAMPLES, "bad options are refused");
    return failures > 0;
}

int main(int argc, char **argv)
{
    return demo18_main(argc, argv);
}

/* Chapter 18's loop by MPI against rt_render alone: bits, rays, and what goes wrong on one machine. */
#include "../demos/live.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { FAILS_ON_ONE = 77 /* a seed */, SLOW = 1001 /* samples, which need image.rest */ };

static rt_status render_or_fail(const rt_scene *scene, const rt_camera *camera,
                                const rt_options *options, rt_image *image);

#define rt_render render_or_fail
#define main demo18_main
#include "../demos/demo18_many_machines.c"
#undef main
#undef rt_render

/* Machine 1 fails at its second part; the others say that they take part. */
static rt_status render_or_fail(const rt_scene *scene, const rt_camera *camera,
                                const rt_options *options, rt_image *image)
{
    static int parts = 0;
    parts += options->samples == SLOW;
    const bool fails = options->seed == FAILS_ON_ONE && machine == 1 && parts > 1;
    if (parts == 3 && machine > 0)
        fprintf(stderr, "machine %d renders\n", machine);
    return fails ? RT_NO_MEMORY : rt_render(scene, camera, options, image);
}

static int failures;

static void expect_that(bool holds, const char *what)
{
    if (!holds)
        fprintf(stderr, "%d machines: %s: not so\n", machines, what);
    failures += !holds;
}

enum { WIDTH = 150, HEIGHT = 101, ALL = WIDTH * HEIGHT };

/* Render a picture by both ways, twice as many samples if it is to be resumed. */
static void compare(const demo *d, rt_options options, bool half, bool rest, bool resumed,
                    const char *what)
{
    static rt_vec3 memory[2][5][ALL];
    rt_image images[2];
    memset(memory, 0, sizeof memory);
    for (int i = 0; i < 2; i++) {
        images[i] = (rt_image){.width = WIDTH, .height = HEIGHT, .pixels = memory[i][0]};
        images[i].half = half ? memory[i][1] : NULL;
        images[i].rest = rest ? memory[i][2] : NULL;
        rt_status status = RT_OK;
        for (int times = resumed ? 2 : 1; status == RT_OK && times > 0; times--)
            status = i == 0
                         ? d->render(&options, &images[0])
                         : rt_render(&scene_indirect, &room_camera, &options, &images[1]);
        expect_that(status == RT_OK, what);
    }
    expect_that(memcmp(memory[0], memory[1], 2 * sizeof memory[0][0]) == 0, what);
    expect_that(images[0].rays == images[1].rays && images[0].rays > 0, what);
    expect_that(images[0].samples == images[1].samples, what);
}

static bool keep(void *user, float part)
{
    *(float *)user = part;
    return true;
}

/* Stop after some milliseconds. */
static bool soon(void *user, float part)
{
    (void)part;
    return ++*(int *)user < 4;
}

static bool some(const rt_vec3 *pixels)
{
    int i = 0;
    while (i < ALL && pixels[i].x == 0.0f)
        i++;
    return i < ALL;
}

/* In the place of the demos' program. */
int demo_main(int argc, char **argv, const demo *d)
{
    static rt_vec3 pixels[ALL];
    (void)argc, (void)argv;
    rt_options options = {.samples = 8, .bounces = 5, .threads = 1};
    compare(d, options, false, false, false, "a picture");
    compare(d, options, true, false, false, "a picture with half");
    compare(d, options, false, false, true, "a picture resumed");
    options.error = 0.5f;
    compare(d, options, true, false, false, "a picture with an error");
    options.error = 0.0f;
    options.samples = SLOW;
    compare(d, options, false, true, false, "a picture of many samples");

    float done = 0.0f;
    options.progress = keep;
    options.user = &done;
    of_the_whole(&(whole){&options, 100, 50, 200}, 0.5f);
    expect_that(done == 0.625f, "progress in a part is progress of the whole");

    rt_image image = {.width = WIDTH, .height = HEIGHT, .pixels = pixels};
    int calls = 0;
    options.progress = soon;
    options.user = &calls;
    expect_that(d->render(&options, &image) == RT_CANCELLED, "a picture is cancelled");
    expect_that(machines == 1 || take(0) > ALL / PART, "then nobody takes another part");
    expect_that(machines == 1 || image.samples == 0, "it has not all samples");
    expect_that(some(pixels), "what was done is there");

    rt_image_clear(&image);
    options = (rt_options){.samples = SLOW, .threads = 1, .seed = FAILS_ON_ONE};
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

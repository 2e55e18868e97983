/* Chapter 8: rt_render, on one thread and on many, whole and in pieces. */
#include "../demos/scene.h"
#include "test.h"

static const rt_options defaults; /* all zero */

static rt_image render(int width, int height, rt_options options)
{
    rt_image image = new_image(width, height);
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    return image;
}

static rt_options with(int samples, int threads)
{
    rt_options options = defaults;
    options.samples = samples;
    options.threads = threads;
    options.bounces = 3;
    return options;
}

/* ---- the same bits ------------------------------------------------------------------ */

static void test_threads_do_not_change_a_bit(void **state)
{
    (void)state;
    rt_image one = render(101, 67, with(3, 1));
    const int threads[] = {2, 3, 7, 8, 0};
    for (size_t i = 0; i < COUNT(threads); i++) {
        rt_image many = render(101, 67, with(3, threads[i]));
        assert_true(same_pixels(&one, &many));
        assert_int_equal(one.rays, many.rays);
        free(many.pixels);
    }
    free(one.pixels);
}

static void test_samples_in_pieces_do_not_change_a_bit(void **state)
{
    (void)state;
    rt_image whole = render(50, 40, with(9, 0)), pieces = new_image(50, 40);
    const int parts[] = {1, 3, 5};
    for (size_t i = 0; i < COUNT(parts); i++) {
        const rt_options options = with(parts[i], (int)i + 1);
        assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &pieces),
                         RT_OK);
    }
    assert_int_equal(pieces.samples, 9);
    assert_int_equal(pieces.rays, whole.rays);
    assert_true(same_pixels(&whole, &pieces));
    free(whole.pixels);
    free(pieces.pixels);
}

static void test_the_image_need_not_be_cleared(void **state)
{
    (void)state;
    rt_image clean = render(20, 20, with(2, 0)), dirty = new_image(20, 20);
    const rt_options options = with(2, 0);
    memset(dirty.pixels, 0xff, 20 * 20 * sizeof *dirty.pixels); /* NaN */
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &dirty), RT_OK);
    assert_true(same_pixels(&clean, &dirty));
    free(clean.pixels);
    free(dirty.pixels);
}

static void test_two_seeds_two_noises_one_picture(void **state)
{
    (void)state;
    rt_options options = with(64, 0);
    rt_image a = render(20, 15, options);
    options.seed = 1;
    rt_image b = render(20, 15, options);
    double difference = 0, sum = 0;
    int same = 0;
    for (int i = 0; i < 20 * 15; i++) {
        difference += (double)(a.pixels[i].x - b.pixels[i].x);
        sum += (double)a.pixels[i].x;
        same += a.pixels[i].x == b.pixels[i].x;
    }
    assert_true(same < 20 * 15 / 10);
    assert_close(difference / sum, 0, 0.03);
    free(a.pixels);
    free(b.pixels);
}

static rt_vec3 where_and_when(const void *context, float x, float y, rt_rng *rng)
{
    (void)context;
    rng->rays = 2;
    return rt_vec(x, y, rt_random(rng));
}

static void test_samples_fill_the_square_of_their_pixel(void **state)
{
    /* The mean of the place is the pixel's centre; no sample lies outside its square. */
    (void)state;
    enum { W = 5, H = 3, N = 4000 };
    rt_image image = new_image(W, H);
    rt_options options = defaults;
    options.samples = 1;
    double smallest = 1, largest = 0;
    for (int n = 0; n < N; n++) {
        const rt_vec3 before = image.pixels[7];
        assert_int_equal(rt_render_pixels(where_and_when, NULL, &options, &image), RT_OK);
        const double x = ((double)image.pixels[7].x * (n + 1) - (double)before.x * n) - 2;
        smallest = x < smallest ? x : smallest;
        largest = x > largest ? x : largest;
    }
    assert_in_range((int)(1000 * smallest + 10), 0, 20); /* rounding of the means: 0.01 */
    assert_in_range((int)(1000 * largest), 980, 1010);
    for (int i = 0; i < W * H; i++)
        assert_vec(image.pixels[i], i % W + 0.5, i / W + 0.5, 0.5,
                   4 * sqrt(1.0 / 12 / N) + 1e-3);
    assert_int_equal(image.samples, N);
    assert_int_equal(image.rays, 2 * N * W * H);
    free(image.pixels);
}

/* ---- defaults and shapes ------------------------------------------------------------ */

static void test_options_of_zero_or_null_are_the_defaults(void **state)
{
    (void)state;
    rt_image a = new_image(8, 6), b = new_image(8, 6), c = new_image(8, 6);
    rt_options options = defaults;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, NULL, &a), RT_OK);
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &b), RT_OK);
    options.samples = 16;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &c), RT_OK);
    assert_int_equal(a.samples, 16);
    assert_true(same_pixels(&a, &b));
    assert_true(same_pixels(&a, &c));
    free(a.pixels);
    free(b.pixels);
    free(c.pixels);
}

static void test_pictures_of_one_pixel_row_or_column(void **state)
{
    (void)state;
    const int sizes[][2] = {{1, 1}, {1, 300}, {300, 1}, {2, 1}};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        rt_image image = render(sizes[i][0], sizes[i][1], with(1, 0));
        for (int k = 0; k < sizes[i][0] * sizes[i][1]; k++)
            assert_true(image.pixels[k].x >= 0 && image.pixels[k].x <= FLT_MAX);
        free(image.pixels);
    }
}

static void test_an_empty_scene_is_the_background(void **state)
{
    (void)state;
    rt_scene scene;
    memset(&scene, 0, sizeof scene);
    scene.background = rt_vec(0.1f, 0.2f, 0.3f);
    rt_image image = new_image(7, 5);
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_OK);
    for (int i = 0; i < 7 * 5; i++)
        assert_vec(image.pixels[i], 0.1, 0.2, 0.3, 1e-7);
    assert_int_equal(image.rays, 7 * 5 * 16);
    free(image.pixels);
}

static void test_no_light_is_a_black_picture(void **state)
{
    (void)state;
    rt_scene scene = scene_indirect;
    scene.light_count = 0;
    rt_image image = new_image(7, 5);
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_OK);
    for (int i = 0; i < 7 * 5; i++)
        assert_vec(image.pixels[i], 0, 0, 0, 0);
    free(image.pixels);
}

static void test_more_samples_less_noise(void **state)
{
    /* Four times the samples halve the error: what the report wanted to know. */
    (void)state;
    rt_image best = render(40, 30, with(1024, 0));
    double error[2];
    for (int i = 0; i < 2; i++) {
        rt_options options = with(i == 0 ? 16 : 64, 0);
        options.seed = 1;
        options.sampler = RT_RANDOM;
        rt_image image = render(40, 30, options);
        double sum = 0;
        for (int k = 0; k < 40 * 30; k++) {
            const double d = (double)(image.pixels[k].y - best.pixels[k].y);
            sum += d * d;
        }
        error[i] = sqrt(sum);
        free(image.pixels);
    }
    assert_close(error[0] / error[1], 2, 0.2);
    free(best.pixels);
}

/* ---- progress and cancelling -------------------------------------------------------- */

typedef struct watch {
    int calls, stop_at; /* stop at this call; 0: never */
    float last, first;
} watch;

static bool watch_progress(void *user, float part)
{
    watch *w = user;
    if (!(part >= w->last && part <= 1)) /* the same if a task took long */
        fail_msg("progress from %g to %g", (double)w->last, (double)part);
    w->last = part;
    if (w->calls == 0)
        w->first = part;
    return ++w->calls != w->stop_at;
}

static void test_progress_rises_to_one(void **state)
{
    (void)state;
    watch w = {0, 0, 0, 0};
    rt_options options = with(4, 2);
    options.progress = watch_progress;
    options.user = &w;
    rt_image image = render(160, 120, options);
    assert_true(w.calls >= 3); /* after two parts of the first sample, and the end */
    assert_close(w.last, 1, 0);
    w.calls = 0;
    w.last = 0;
    options.samples = 32; /* and again from 0 to 1 when more samples are added */
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    assert_close(w.last, 1, 0);
    assert_true(w.first < 0.6f);
    free(image.pixels);
}

static void test_progress_counts_from_where_the_image_was(void **state)
{
    /* All but one pixel of the first of two samples are done: at its end we are at 0. */
    (void)state;
    watch w = {0, 0, 0, 0};
    rt_options options = with(2, 1);
    rt_image image = new_image(100, 100);
    image.done = 100 * 100 - 1;
    options.progress = watch_progress;
    options.user = &w;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    assert_in_range((int)(1000 * w.first), 0, 10);
    assert_close(w.last, 1, 0);
    free(image.pixels);
}

static bool stop(void *user, float part)
{
    (void)user;
    return part < 1;
}

static void test_a_finished_picture_is_not_cancelled(void **state)
{
    (void)state;
    rt_options options = with(2, 2);
    options.progress = stop;
    rt_image image = new_image(60, 40);
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    assert_int_equal(image.samples, 2);
    free(image.pixels);
}

static bool count_calls(void *user, float part)
{
    (void)part;
    ++*(int *)user;
    return true;
}

static rt_vec3 slow_pixel(const void *context, float x, float y, rt_rng *rng)
{
    double sum = 0;
    (void)context;
    for (int i = 0; i < 20000; i++)
        sum += (double)rt_random(rng);
    return rt_vec(x, y, (float)sum);
}

static void test_progress_is_called_often_for_slow_pixels(void **state)
{
    /* 4000 pixels of 0.1 ms or so. */
    (void)state;
    int calls = 0;
    rt_options options = with(1, 1);
    rt_image image = new_image(80, 50);
    options.progress = count_calls;
    options.user = &calls;
    assert_int_equal(rt_render_pixels(slow_pixel, NULL, &options, &image), RT_OK);
    assert_in_range(calls, 5,
                    1000); /* every 15 ms, even on a busy machine; not for each pixel */
    free(image.pixels);
}

static void test_a_cancelled_picture_goes_on_to_the_same_bits(void **state)
{
    /* Stop at the first call, in the middle of the first sample, then go on and stop at the
     * second, and so on, on different numbers of threads. */
    (void)state;
    rt_image whole = render(160, 120, with(20, 0)), image = new_image(160, 120);
    int stops = 0, within = 0;
    for (int calls = 1; image.samples < 20; calls++) {
        rt_options options = with(20 - image.samples, 1 + calls % 3);
        watch w = {0, calls, 0, 0};
        options.progress = watch_progress;
        options.user = &w;
        const rt_status status =
            rt_render(&scene_indirect, &room_camera, &options, &image);
        assert_int_equal(status, image.samples < 20 ? RT_CANCELLED : RT_OK);
        assert_in_range(image.done, 0, 160 * 120 - 1);
        stops += status == RT_CANCELLED;
        within += image.done > 0;
    }
    assert_true(stops >= 2);
    assert_true(within >= 1);
    assert_int_equal(image.samples, 20);
    assert_int_equal(image.done, 0);
    assert_int_equal(image.rays, whole.rays);
    assert_true(same_pixels(&whole, &image));
    free(image.pixels);
    free(whole.pixels);
}

/* ---- bad input ---------------------------------------------------------------------- */

static void test_null_is_refused(void **state)
{
    (void)state;
    rt_image image = new_image(4, 4), no_pixels = image;
    rt_scene scene = scene_indirect;
    no_pixels.pixels = NULL;
    assert_int_equal(rt_render(NULL, &room_camera, NULL, &image), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene, NULL, NULL, &image), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene, &room_camera, NULL, NULL), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &no_pixels), RT_BAD_POINTER);
    assert_int_equal(rt_render_pixels(NULL, NULL, NULL, &image), RT_BAD_POINTER);
    assert_int_equal(rt_render_pixels(where_and_when, NULL, NULL, NULL), RT_BAD_POINTER);
    scene.spheres = NULL;
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_BAD_POINTER);
    scene = scene_indirect;
    scene.boxes = NULL;
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_BAD_POINTER);
    scene = scene_indirect;
    scene.lights = NULL;
    assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_BAD_POINTER);
    scene = scene_indirect;
    int *const counts[] = {&scene.sphere_count, &scene.box_count, &scene.light_count};
    for (size_t i = 0; i < COUNT(counts); i++) {
        scene = scene_indirect;
        *counts[i] = -1;
        assert_int_equal(rt_render(&scene, &room_camera, NULL, &image), RT_BAD_POINTER);
    }
    for (int i = 0; i < 3; i++) { /* one object in an array that is missing */
        rt_scene one = {0};
        int index = 7;
        *(i == 0 ? &one.sphere_count : i == 1 ? &one.box_count : &one.light_count) = 1;
        assert_int_equal(rt_check_scene(&one, &index), RT_BAD_POINTER);
        assert_int_equal(index, 0);
    }
    assert_int_equal(rt_check_camera(NULL), RT_BAD_POINTER);
    assert_int_equal(rt_check_scene(NULL, NULL), RT_BAD_POINTER);
    free(image.pixels);
}

static void test_bad_sizes_are_refused(void **state)
{
    (void)state;
    rt_vec3 pixel = {7, 7, 7};
    const int sizes[][2] = {{0, 5},         {5, 0},         {-1, 5},     {5, -1},
                            {65536, 65536}, {65537, 65536}, {INT_MAX, 2}};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        rt_image image = {.width = sizes[i][0], .height = sizes[i][1], .pixels = &pixel};
        assert_int_equal(rt_render(&scene_indirect, &room_camera, NULL, &image),
                         RT_BAD_SIZE);
    }
    rt_image image = {.width = 1,
                      .height = 1,
                      .pixels = &pixel,
                      .done = 1}; /* done: more than there is */
    assert_int_equal(rt_render(&scene_indirect, &room_camera, NULL, &image), RT_BAD_SIZE);
    image.done = -1;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, NULL, &image), RT_BAD_SIZE);
    assert_vec(pixel, 7, 7, 7, 0);
}

static void test_bad_options_are_refused(void **state)
{
    (void)state;
    rt_vec3 pixel = {7, 7, 7};
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    const struct {
        int samples, bounces, threads, had;
        rt_status status;
    } cases[] = {
        {-1, 0, 0, 0, RT_BAD_SAMPLES},          {1, -1, 0, 0, RT_BAD_BOUNCES},
        {1, 0, -1, 0, RT_BAD_THREADS},          {1, 0, 1025, 0, RT_BAD_THREADS},
        {2, 0, 0, INT_MAX - 1, RT_BAD_SAMPLES}, {0, 0, 0, INT_MAX - 15, RT_BAD_SAMPLES},
        {1, 0, 0, -1, RT_BAD_SAMPLES},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        rt_options options = defaults;
        options.samples = cases[i].samples;
        options.bounces = cases[i].bounces;
        options.threads = cases[i].threads;
        image.samples = cases[i].had;
        assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image),
                         cases[i].status);
        assert_vec(pixel, 7, 7, 7, 0);
    }
}

static void test_a_thousand_threads(void **state)
{
    (void)state;
    rt_image one = render(3, 2, with(1, 1)), many = render(3, 2, with(1, 1024));
    assert_true(same_pixels(&one, &many));
    free(one.pixels);
    free(many.pixels);
}

static void test_bad_cameras_are_refused(void **state)
{
    (void)state;
    rt_vec3 pixel = {7, 7, 7};
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    const rt_camera cameras[] = {
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 180},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, -1},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, NAN},
        {{0, NAN, 0}, {0, 0, 0}, {0, 0, 0}, 0},
        {{0, 0, 0}, {INFINITY, 0, 0}, {0, 0, 0}, 0},
        {{0, 0, 0}, {0, 0, 0}, {0, 0, NAN}, 0},
    };
    for (size_t i = 0; i < COUNT(cameras); i++)
        assert_int_equal(rt_render(&scene_indirect, &cameras[i], NULL, &image),
                         RT_BAD_CAMERA);
    assert_vec(pixel, 7, 7, 7, 0);
}

static void test_check_scene_finds_the_offender(void **state)
{
    (void)state;
    const float bad[] = {NAN, INFINITY, -1e-3f};
    random_scene r;
    rt_rng rng = rt_rng_start(0, 0, 31);
    make_random_scene(&r, &rng);
    int index = -1;
    assert_int_equal(rt_check_scene(&r.scene, &index), RT_OK);
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_OK);
    for (size_t i = 0; i < COUNT(bad); i++) {
        float *const places[] = {&r.spheres[3].radius, &r.spheres[3].material.albedo.y,
                                 &r.boxes[2].material.albedo.z, &r.lights[1].intensity.x,
                                 &r.scene.background.y};
        const rt_status status[] = {RT_BAD_SPHERE, RT_BAD_SPHERE, RT_BAD_BOX,
                                    RT_BAD_LIGHT, RT_BAD_BACKGROUND};
        const int where[] = {3, 3, 2, 1, 0};
        for (size_t k = 0; k < COUNT(places); k++) {
            const float good = *places[k];
            *places[k] = bad[i];
            assert_int_equal(rt_check_scene(&r.scene, &index), status[k]);
            assert_int_equal(index, where[k]);
            *places[k] = good;
        }
    }
    for (size_t i = 0; i < 2; i++) {
        float *const places[] = {&r.spheres[4].center.z, &r.boxes[3].min.x,
                                 &r.boxes[3].max.y, &r.lights[2].position.y};
        const rt_status status[] = {RT_BAD_SPHERE, RT_BAD_BOX, RT_BAD_BOX, RT_BAD_LIGHT};
        for (size_t k = 0; k < COUNT(places); k++) {
            const float good = *places[k];
            *places[k] = bad[i];
            assert_int_equal(rt_check_scene(&r.scene, NULL), status[k]);
            *places[k] = good;
        }
    }
    r.spheres[0].radius = 0;
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_BAD_SPHERE);
    r.spheres[0].radius = 1;
    r.boxes[1].material.albedo.x = 1.001f;
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_BAD_BOX);
    r.boxes[1].material.albedo.x = 1;
    for (int k = 0; k < 3; k++) {
        rt_vec3 *const min = &r.boxes[0].min, *const max = &r.boxes[0].max, good = *min;
        *min = rt_vec(k == 0 ? max->x + 1 : min->x, k == 1 ? max->y + 1 : min->y,
                      k == 2 ? max->z + 1 : min->z);
        assert_int_equal(rt_check_scene(&r.scene, &index), RT_BAD_BOX);
        assert_int_equal(index, 0);
        *min = good;
    }
    r.lights[0].position.x = 1.1e15f; /* large, and larger than is allowed */
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_BAD_LIGHT);
    r.lights[0].position.x = -1e15f;
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_OK);
}

static void test_check_accepts_what_is_at_the_limits(void **state)
{
    (void)state;
    random_scene r;
    rt_rng rng = rt_rng_start(0, 0, 33);
    make_random_scene(&r, &rng);
    r.boxes[0].min = r.boxes[0].max = rt_vec(1, 2, 3); /* a point */
    r.spheres[0].radius = 1e15f;
    r.spheres[0].center = rt_vec(-1e15f, 1e15f, 0);
    r.spheres[0].material.albedo = rt_vec(0, 1, 0);
    r.lights[0].intensity = rt_vec(0, 0.5f, 1e15f);
    r.scene.background = rt_vec(0, 0.5f, 1e15f);
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_OK);
    r.spheres[0].material.albedo.y = 1.001f;
    assert_int_equal(rt_check_scene(&r.scene, NULL), RT_BAD_SPHERE);

    rt_camera camera = {{1e15f, 0, 0}, {0, 0, -1e15f}, {0, 1, 0}, 0};
    assert_int_equal(rt_check_camera(&camera), RT_OK);
    camera.fov_y = 0.5f;
    assert_int_equal(rt_check_camera(&camera), RT_OK);
    camera.fov_y = 179.9f;
    assert_int_equal(rt_check_camera(&camera), RT_OK);
    camera.up.y = 1.1e15f;
    assert_int_equal(rt_check_camera(&camera), RT_BAD_CAMERA);
}

static void test_every_status_has_a_text_of_its_own(void **state)
{
    (void)state;
    for (int i = RT_OK; i <= RT_BAD_LENS + 1; i++)
        for (int k = RT_OK; k < i; k++)
            assert_string_not_equal(rt_status_text((rt_status)i),
                                    rt_status_text((rt_status)k));
    assert_string_equal(rt_status_text((rt_status)99), "unknown status");
}

static void test_thread_count(void **state)
{
    (void)state;
    assert_int_equal(rt_thread_count(1), 1);
    assert_true(rt_thread_count(0) >= 1);
    assert_int_equal(rt_thread_count(-5), 1);
#ifdef _OPENMP
    assert_int_equal(rt_thread_count(3), 3);
    assert_int_equal(rt_thread_count(5000), 1024);
#else
    assert_int_equal(rt_thread_count(3), 1);
#endif
}

/* A picture cut at random places has the bits of the whole, in all that it records. */
static void test_parts(void **state)
{
    (void)state;
    enum { W = 20, H = 15, ALL = W * H, CUTS = 60 };
    static rt_vec3 whole[ALL], half[ALL], parts[ALL], part_half[ALL];
    static rt_guide guides[ALL], part_guides[ALL];
    rt_image image = {W, H, whole, .half = half, .guides = guides};
    const rt_options options = {.samples = 5, .bounces = 3, .threads = 2};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    rt_rng rng = rt_rng_start(0, 0, 0);
    for (int cut = 0; cut < CUTS; cut++) {
        uint64_t rays = 0;
        memset(parts, 0xff, sizeof parts);
        for (int first = 0, count; first < ALL; first += count) {
            count = 1 + (int)(rt_random(&rng) * (cut % 3 == 0 ? 9.0f : 150.0f));
            count = count < ALL - first ? count : ALL - first;
            rt_image part = {W, H, parts + first, .half = part_half + first};
            part.guides = part_guides + first;
            part.first = first;
            part.count = count;
            for (int samples = 2; samples <= 3; samples++) { /* and continued */
                const rt_options some = {.samples = samples,
                                         .bounces = 3,
                                         .threads = 1 + cut % 2,
                                         .lanes = cut % 5 == 0};
                assert_int_equal(rt_render(&scene_indirect, &room_camera, &some, &part),
                                 RT_OK);
            }
            assert_int_equal(part.samples, 5);
            rays += part.rays;
        }
        assert_memory_equal(parts, whole, sizeof whole);
        assert_memory_equal(part_half, half, sizeof half);
        assert_memory_equal(part_guides, guides, sizeof guides);
        assert_int_equal(rays, image.rays);
    }
}

static void test_bad_parts(void **state)
{
    (void)state;
    static rt_vec3 pixels[12], half[12];
    static const struct {
        int first, count;
        float error, seconds;
        rt_status status;
    } bad[] = {
        {-1, 2, 0, 0, RT_BAD_SIZE},     {0, -1, 0, 0, RT_BAD_SIZE},
        {11, 2, 0, 0, RT_BAD_SIZE},     {1, INT_MAX, 0, 0, RT_BAD_SIZE},
        {3, 0, 0, 0, RT_BAD_SIZE},      {INT_MAX, 1, 0, 0, RT_BAD_SIZE},
        {0, 12, 0.1f, 0, RT_BAD_ERROR}, {2, 3, 0, 0.1f, RT_BAD_SECONDS},
        {11, 1, 0, 0, RT_OK},           {0, 12, 0, 0, RT_OK},
    };
    for (size_t i = 0; i < sizeof bad / sizeof bad[0]; i++) {
        rt_image image = {4, 3, pixels, .half = half};
        image.first = bad[i].first;
        image.count = bad[i].count;
        const rt_options options = {
            .samples = 2, .error = bad[i].error, .seconds = bad[i].seconds};
        assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image),
                         bad[i].status);
    }
    rt_image image = {.width = 4,
                      .height = 3,
                      .pixels = pixels}; /* a path of any pixel may be asked for */
    image.first = 11;
    image.count = 1;
    rt_path path = {0};
    const rt_options timed = {.seconds = 1.0f}; /* rendering a part refuses that */
    assert_int_equal(
        rt_trace_pixel(&scene_indirect, &room_camera, &timed, &image, 0, 0, 0, &path),
        RT_OK);
}

/* Memory for a picture or a part of it, as much as rt.h asks for, between canaries. */
enum { CANARY = 64, WORST = 1 << 15 /* bytes */ };

typedef struct guarded {
    unsigned char bytes[WORST];
    size_t size;
} guarded;

static void *guard(guarded *g, size_t size)
{
    assert_in_range(size + 2 * CANARY, 0, WORST);
    memset(g->bytes, 0xa5, sizeof g->bytes);
    g->size = size;
    return g->bytes + CANARY;
}

static void check_canaries(const guarded *g)
{
    for (size_t i = 0; i < WORST; i++)
        if ((i < CANARY || i >= CANARY + g->size) && g->bytes[i] != 0xa5)
            fail_msg("byte %ld of %zu is written", (long)i - CANARY, g->size);
}

typedef struct four_arrays {
    guarded pixels, half, rest, guides;
} four_arrays;

/* All that an image can have, for count pixels. */
static rt_image image_in(four_arrays *memory, int width, int height, int count)
{
    const size_t n = (size_t)count, vectors = n * sizeof(rt_vec3);
    rt_image image = {.width = width, .height = height};
    image.pixels = guard(&memory->pixels, vectors);
    image.half = guard(&memory->half, vectors);
    image.rest = guard(&memory->rest, 2 * vectors);
    image.guides = guard(&memory->guides, n * sizeof(rt_guide));
    return image;
}

/* Parts of odd sizes, with half, rest and guides: each has the whole's bits in all four,
 * and writes to no other memory. */
static void test_parts_with_a_rest(void **state)
{
    (void)state;
    enum { W = 9, H = 7, ALL = W * H };
    static four_arrays of_whole, of_part;
    const int cuts[] = {0, 1, 2, 7, 20, 61, ALL};
    const rt_options options = {.samples = 1101, .bounces = 2};
    const rt_image whole = image_in(&of_whole, W, H, ALL);
    memset(whole.rest, 0, 2 * ALL * sizeof *whole.rest); /* no canaries: all is written */
    rt_image image = whole;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    for (size_t i = 0; i + 1 < COUNT(cuts); i++) {
        const int first = cuts[i], count = cuts[i + 1] - first;
        const size_t size = (size_t)count * sizeof(rt_vec3);
        rt_image part = image_in(&of_part, W, H, count);
        part.first = first;
        part.count = count;
        for (int samples = 500; samples <= 601; samples += 101) { /* and continued */
            rt_options some = options;
            some.samples = samples;
            assert_int_equal(rt_render(&scene_indirect, &room_camera, &some, &part),
                             RT_OK);
        }
        assert_memory_equal(part.pixels, whole.pixels + first, size);
        assert_memory_equal(part.half, whole.half + first, size);
        assert_memory_equal(part.rest, whole.rest + first, size);
        assert_memory_equal(part.rest + count, whole.rest + ALL + first, size);
        assert_memory_equal(part.guides, whole.guides + first,
                            (size_t)count * sizeof(rt_guide));
        const guarded *const arrays[] = {&of_part.pixels, &of_part.half, &of_part.rest,
                                         &of_part.guides};
        for (size_t k = 0; k < COUNT(arrays); k++)
            check_canaries(arrays[k]);
    }

    static rt_vec3 rounded[ALL]; /* the rest does change the means */
    rt_image without = {W, H, rounded, .half = whole.half};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &without), RT_OK);
    assert_memory_not_equal(rounded, whole.pixels, sizeof rounded);
}

/* A part lacks neighbours of its pixels. Here its memory would do for the whole. */
static void test_parts_are_not_denoised(void **state)
{
    (void)state;
    enum { W = 9, H = 7, ALL = W * H };
    static rt_vec3 pixels[ALL], half[ALL], clean[ALL], before[ALL];
    static rt_guide guides[ALL];
    const int places[][2] = {{0, 20}, {20, 43}, {62, 1}, {0, ALL}};
    rt_image image = {W, H, pixels, .half = half, .guides = guides};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, NULL, &image), RT_OK);
    memset(before, 0xa5, sizeof before);
    memcpy(clean, before, sizeof clean);
    rt_image result = {.width = W, .height = H, .pixels = clean};
    for (size_t i = 0; i < COUNT(places); i++) {
        rt_image part = image, part_result = result;
        part.first = part_result.first = places[i][0];
        part.count = part_result.count = places[i][1];
        assert_int_equal(rt_denoise(&part, 0, &result), RT_BAD_SIZE);
        assert_int_equal(rt_denoise(&image, 0, &part_result), RT_BAD_SIZE);
        assert_int_equal(rt_denoise(&part, 0, &part_result), RT_BAD_SIZE);
        assert_true(isinf(rt_denoised_error(&part, 0)));
        assert_memory_equal(clean, before, sizeof clean);
        assert_int_equal(result.samples, 0);
        assert_int_equal(part_result.samples, 0);
    }
    assert_int_equal(rt_denoise(&image, 0, &result), RT_OK); /* the whole is */
    assert_true(rt_denoised_error(&image, 0) <= FLT_MAX);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_threads_do_not_change_a_bit),
        cmocka_unit_test(test_samples_in_pieces_do_not_change_a_bit),
        cmocka_unit_test(test_the_image_need_not_be_cleared),
        cmocka_unit_test(test_two_seeds_two_noises_one_picture),
        cmocka_unit_test(test_samples_fill_the_square_of_their_pixel),
        cmocka_unit_test(test_options_of_zero_or_null_are_the_defaults),
        cmocka_unit_test(test_pictures_of_one_pixel_row_or_column),
        cmocka_unit_test(test_an_empty_scene_is_the_background),
        cmocka_unit_test(test_no_light_is_a_black_picture),
        cmocka_unit_test(test_more_samples_less_noise),
        cmocka_unit_test(test_progress_rises_to_one),
        cmocka_unit_test(test_progress_counts_from_where_the_image_was),
        cmocka_unit_test(test_a_finished_picture_is_not_cancelled),
        cmocka_unit_test(test_progress_is_called_often_for_slow_pixels),
        cmocka_unit_test(test_a_cancelled_picture_goes_on_to_the_same_bits),
        cmocka_unit_test(test_null_is_refused),
        cmocka_unit_test(test_bad_sizes_are_refused),
        cmocka_unit_test(test_bad_options_are_refused),
        cmocka_unit_test(test_a_thousand_threads),
        cmocka_unit_test(test_bad_cameras_are_refused),
        cmocka_unit_test(test_check_scene_finds_the_offender),
        cmocka_unit_test(test_check_accepts_what_is_at_the_limits),
        cmocka_unit_test(test_every_status_has_a_text_of_its_own),
        cmocka_unit_test(test_thread_count),
        cmocka_unit_test(test_parts),
        cmocka_unit_test(test_bad_parts),
        cmocka_unit_test(test_parts_with_a_rest),
        cmocka_unit_test(test_parts_are_not_denoised),
    };
    return cmocka_run_group_tests_name("8 pictures", tests, NULL, NULL);
}

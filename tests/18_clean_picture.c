/* Chapter 10: guides, and finished pictures. */
#include <stddef.h>
#include <stdlib.h>

static int taken, fail_at = -1;

static void *failing_malloc(size_t size)
{
    return taken++ == fail_at ? NULL : malloc(size);
}

#define RT_MALLOC(size) failing_malloc(size)
#define RT_FREE(memory) free(memory)
#define DEMO "../demos/demo10_clean.c"
#include "test.h"

#include "scene_file.h"

/* An image with all that denoising needs, and memory for the outcome. */
typedef struct picture {
    rt_image image, result;
} picture;

static picture new_picture(int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
    picture p = {new_image(width, height), new_image(width, height)};
    p.image.half = calloc(count, sizeof *p.image.half);
    p.image.guides = calloc(count, sizeof *p.image.guides);
    assert_true(p.image.half && p.image.guides);
    return p;
}

static void free_picture(picture *p)
{
    free(p->image.pixels);
    free(p->image.half);
    free(p->image.guides);
    free(p->result.pixels);
}

static picture room(int width, int height, int samples, uint32_t seed)
{
    picture p = new_picture(width, height);
    const rt_options options = {.samples = samples, .bounces = 5, .seed = seed};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &p.image), RT_OK);
    return p;
}

static bool same_guides(const rt_image *a, const rt_image *b)
{
    const size_t count = (size_t)a->width * (size_t)a->height;
    return memcmp(a->guides, b->guides, count * sizeof *a->guides) == 0;
}

/* Root mean square of the difference over the mean, without the noise of the truth. */
static double distance(const rt_image *a, const rt_image *truth)
{
    const double noise = truth->half ? (double)rt_image_error(truth) : 0;
    double squares = 0, sum = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        const rt_vec3 d = rt_sub(a->pixels[i], truth->pixels[i]), c = truth->pixels[i];
        squares += (double)rt_dot(d, d);
        sum += (double)(c.x + c.y + c.z);
    }
    const double values = 3.0 * a->width * a->height;
    const double error = sqrt(squares / values) / (sum / values);
    return sqrt(error * error - noise * noise);
}

/* ---- guides --------------------------------------------------------------------------- */

static void test_guides_change_no_bit_of_the_picture(void **state)
{
    (void)state;
    for (int k = 0; k < 8; k++) {
        picture with = new_picture(37, 21), without = new_picture(37, 21);
        rt_guide *guides = without.image.guides;
        without.image.guides = NULL;
        const rt_options options = {.samples = 3,
                                    .bounces = k < 4 ? 5 : RT_ALL_BOUNCES,
                                    .lanes = k % 2,
                                    .sampler = k & 2 ? RT_RANDOM : RT_SOBOL};
        rt_render(&scene_indirect, &room_camera, &options, &with.image);
        rt_render(&scene_indirect, &room_camera, &options, &without.image);
        assert_true(same_pixels(&with.image, &without.image));
        assert_memory_equal(with.image.half, without.image.half,
                            37 * 21 * sizeof *with.image.half);
        assert_int_equal(with.image.rays, without.image.rays);
        without.image.guides = guides;
        free_picture(&with);
        free_picture(&without);
    }
}

static void test_guides_are_the_same_however_they_are_recorded(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 1801);
    for (int k = 0; k < 24; k++) {
        random_scene r;
        make_random_scene(&r, &rng);
        r.scene.background = k % 2 ? rt_vec(0.5f, 0.7f, 1) : rt_vec(0, 0, 0);
        r.spheres[1].material.albedo = rt_vec(0, 0, 0); /* a mirror of 0 means 1 */
        r.spheres[1].material.mirror = true;
        const rt_camera camera = {.position = rt_vec(0, 0, 14), .fov_y = 60};
        rt_options options = {.samples = 5,
                              .bounces = k % 3 == 0   ? 0
                                         : k % 3 == 1 ? 7
                                                      : RT_ALL_BOUNCES,
                              .lanes = 1,
                              .threads = 1,
                              .sampler = k & 1 ? RT_RANDOM : RT_SOBOL};
        picture one = new_picture(33, 17), other = new_picture(33, 17);
        rt_render(&r.scene, &camera, &options, &one.image);
        options.lanes = 0;
        options.threads = 2;
        options.samples = 2;
        rt_render(&r.scene, &camera, &options, &other.image);
        options.samples = 3;
        rt_render(&r.scene, &camera, &options, &other.image);
        assert_true(same_pixels(&one.image, &other.image));
        assert_true(same_guides(&one.image, &other.image));
        free_picture(&one);
        free_picture(&other);
    }
}

static void test_a_first_look(void **state)
{
    /* A mirror of half the light at z = 0 shows a red wall at z = 10, behind the camera. */
    (void)state;
    const rt_box boxes[2] = {
        {{-5, -5, -1}, {5, 5, 0}, {{0.5f, 0.5f, 0.5f}, true}},
        {{-50, -50, 10}, {50, 50, 11}, {{0.8f, 0.1f, 0}, false}},
    };
    const rt_light light = {{0, 3, 5}, {100, 100, 100}};
    rt_scene scene = {.boxes = boxes, .box_count = 2, .lights = &light, .light_count = 1};
    scene.background = rt_vec(3, 2, 1);
    rt_rng rng = rt_rng_start(0, 0, 0);
    rt_ray ray = ray_of(rt_vec(0, 0, 5), rt_vec(0, 0, -1));
    rt_guide g = rt_first_look(&scene, &ray, 5, &rng);
    assert_vec(g.normal, 0, 0, -1, 1e-6);
    assert_vec(g.point, 0, 0, 10, 1e-5);
    assert_vec(g.albedo, 0.4f, 0.05f, 0, 1e-6);
    const rt_vec3 sent = rt_lambert(rt_vec(0.8f, 0.1f, 0), rt_vec(0, 0, -1),
                                    rt_vec(0, 3, -5), light.intensity);
    assert_vec(g.direct, 0.5f * sent.x, 0.5f * sent.y, 0, 1e-5);
    assert_int_equal(rng.rays, 1); /* one question to the lamp */
    /* no bounce: the mirror itself, which is then black */
    g = rt_first_look(&scene, &ray, 0, &rng);
    assert_vec(g.point, 0, 0, 0, 0);
    assert_vec(g.albedo, 0.5f, 0.5f, 0.5f, 0);
    assert_vec(g.direct, 0, 0, 0, 0);
    /* past the mirror there is nothing */
    ray.direction = rt_vec(0, 2, -1);
    g = rt_first_look(&scene, &ray, 5, &rng);
    assert_vec(g.direct, 3, 2, 1, 0);
    assert_vec(g.albedo, 0, 0, 0, 0);
    assert_vec(g.normal, 0, 0, 0, 0);
}

static void test_a_look_ends_on_the_fifth_mirror(void **state)
{
    /* Between two mirrors, 2 apart, it would never end; it stops after four. */
    (void)state;
    const rt_box mirrors[2] = {{{-9, -9, -2}, {9, 9, -1}, {{0.9f, 0.9f, 0.9f}, true}},
                               {{-9, -9, 1}, {9, 9, 2}, {{0.9f, 0.9f, 0.9f}, true}}};
    const rt_scene scene = {.boxes = mirrors, .box_count = 2};
    rt_rng rng = rt_rng_start(0, 0, 0);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0.25f, 0, -1));
    for (int bounces = 0; bounces < 8; bounces++) {
        const int last = bounces < RT__ROULETTE ? bounces : RT__ROULETTE;
        const rt_guide g = rt_first_look(&scene, &ray, bounces, &rng);
        assert_close(g.albedo.x, pow(0.9, last + 1), 1e-6);
        assert_close(g.point.x, 0.25 * (1 + 2 * last), 1e-4);
    }
    assert_int_equal(rng.rays, 0);
}

static void test_a_look_in_lanes_ends_there_too(void **state)
{
    (void)state;
    const rt_box mirrors[2] = {{{-9, -9, -2}, {9, 9, -1}, {{0.9f, 0.9f, 0.9f}, true}},
                               {{-9, -9, 6}, {9, 9, 7}, {{0.8f, 0.8f, 0.8f}, true}}};
    const rt_light light = {{0, 3, 5}, {100, 100, 100}};
    const rt_scene scene = {
        .boxes = mirrors, .box_count = 2, .lights = &light, .light_count = 1};
    const rt_camera camera = {.position = {0, 0, 5}, .fov_y = 40};
    for (int bounces = 0; bounces < 8; bounces++) {
        picture one = new_picture(20, 9), all = new_picture(20, 9);
        rt_options options = {.samples = 2, .bounces = bounces, .lanes = 1};
        rt_render(&scene, &camera, &options, &one.image);
        options.lanes = 0;
        rt_render(&scene, &camera, &options, &all.image);
        assert_true(same_guides(&one.image, &all.image));
        free_picture(&one);
        free_picture(&all);
    }
}

static void test_direct_light_is_all_without_bounces(void **state)
{
    (void)state;
    picture p = new_picture(40, 30);
    const rt_options options = {.samples = 4};
    rt_render(&scene_cube, &room_camera, &options, &p.image);
    for (int i = 0; i < 40 * 30; i++) {
        const rt_vec3 pixel = p.image.pixels[i], direct = p.image.guides[i].direct;
        assert_vec(direct, pixel.x, pixel.y, pixel.z, 0);
        const rt_vec3 even = p.image.half[i], half = p.image.guides[i].half;
        assert_vec(half, even.x, even.y, even.z, 0);
    }
    free_picture(&p);
}

static rt_vec3 grey(const void *context, float x, float y, rt_rng *rng)
{
    (void)context;
    (void)rng;
    return rt_vec(x, y, 0.5f);
}

static void test_your_own_pixels_have_no_guides(void **state)
{
    (void)state;
    picture p = new_picture(8, 6);
    memset(p.image.guides, 7, 48 * sizeof *p.image.guides);
    const rt_options options = {.samples = 2};
    assert_int_equal(rt_render_pixels(grey, NULL, &options, &p.image), RT_OK);
    for (size_t i = 0; i < 48 * sizeof *p.image.guides; i++)
        assert_int_equal(((const char *)p.image.guides)[i], 7);
    free_picture(&p);
}

/* ---- what comes out ------------------------------------------------------------------- */

static void test_it_is_what_the_demo_does_by_hand(void **state)
{
    (void)state;
    static const int sizes[][3] = {{1, 1, 4},   {1, 9, 2},   {9, 1, 3},   {2, 2, 16},
                                   {17, 5, 5},  {16, 16, 4}, {33, 40, 7}, {64, 48, 16},
                                   {15, 31, 2}, {100, 3, 4}};
    main_of_the_demo(0, NULL);
    for (size_t k = 0; k < COUNT(sizes); k++) {
        picture p = room(sizes[k][0], sizes[k][1], sizes[k][2], (uint32_t)k);
        rt_image by_hand = new_image(sizes[k][0], sizes[k][1]);
        assert_int_equal(the_demo.finish(&p.image, 1, &by_hand), RT_OK);
        for (int threads = 1; threads <= 7; threads += 2) {
            memset(p.result.pixels, 0, sizeof *p.result.pixels);
            assert_int_equal(rt_denoise(&p.image, threads, &p.result), RT_OK);
            if (!same_pixels(&p.result, &by_hand))
                fail_msg("%d x %d, %d threads: not the same bits", sizes[k][0],
                         sizes[k][1], threads);
        }
        assert_int_equal(p.result.samples, p.image.samples);
        assert_int_equal(p.result.rays, p.image.rays);
        free(by_hand.pixels);
        free_picture(&p);
    }
}

static void test_a_channel_that_sends_nothing_on(void **state)
{
    /* It shows no light, so the mean of the others is taken: as by hand. */
    (void)state;
    main_of_the_demo(0, NULL);
    rt_sphere spheres[7];
    memcpy(spheres, room_spheres, sizeof spheres);
    spheres[0].material.albedo = rt_vec(1, 0, 0);
    spheres[4].material.albedo = rt_vec(0, 0.7f, 0.7f);
    rt_scene scene = scene_indirect;
    scene.spheres = spheres;
    const rt_options options = {.samples = 6, .bounces = 5};
    picture p = new_picture(48, 36);
    rt_image by_hand = new_image(48, 36);
    rt_render(&scene, &room_camera, &options, &p.image);
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_int_equal(the_demo.finish(&p.image, 1, &by_hand), RT_OK);
    assert_true(same_pixels(&p.result, &by_hand));
    assert_vec(rt__per_albedo(rt_vec(0.3f, 0, 0), rt_vec(0.5f, 0, 0.25f)), 0.6f, 0.4f, 0,
               1e-6);
    free(by_hand.pixels);
    free_picture(&p);
}

static void test_background_is_left_alone(void **state)
{
    (void)state;
    main_of_the_demo(0, NULL);
    const rt_sphere ball = {{0, 0, -5}, 1, {{0.8f, 0, 0.5f}, false}};
    const rt_scene scene = {
        .spheres = &ball, .sphere_count = 1, .background = {0.3f, 0.6f, 0.9f}};
    const rt_camera camera = {.fov_y = 45};
    const rt_options options = {.samples = 8, .bounces = 5};
    picture p = new_picture(40, 30);
    rt_render(&scene, &camera, &options, &p.image);
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_vec(p.result.pixels[0], 0.3f, 0.6f, 0.9f, 0);
    /* and the ball, convex, sees nothing but it: all bits of light are known */
    assert_vec(p.result.pixels[15 * 40 + 20], 0.8f * 0.3f, 0, 0.5f * 0.9f, 1e-6);
    rt_image by_hand = new_image(40, 30);
    assert_int_equal(the_demo.finish(&p.image, 1, &by_hand), RT_OK);
    assert_true(same_pixels(&p.result, &by_hand));
    free(by_hand.pixels);
    free_picture(&p);
}

static void test_the_image_goes_on_as_before(void **state)
{
    (void)state;
    picture p = room(40, 30, 4, 0), other = room(40, 30, 4, 0);
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_true(rt_denoised_error(&p.image, 0) > 0.0f);
    assert_true(same_pixels(&p.image, &other.image));
    assert_true(same_guides(&p.image, &other.image));
    const rt_options options = {.samples = 4, .bounces = 5};
    rt_render(&scene_indirect, &room_camera, &options, &p.image);
    rt_render(&scene_indirect, &room_camera, &options, &other.image);
    assert_true(same_pixels(&p.image, &other.image));
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_int_equal(rt_denoise(&other.image, 0, &other.result), RT_OK);
    assert_true(same_pixels(&p.result, &other.result));
    assert_int_equal(p.result.samples, 8);
    free_picture(&p);
    free_picture(&other);
}

static void test_it_is_nearer_to_the_truth(void **state)
{
    /* At most a quarter of the error at 16 samples, half of it at every count, and no
     * harm where hardly any noise is left. */
    (void)state;
#ifdef RENDER_ONLY /* see 10_references.c: other tests have the same code */
    skip();
#endif
    picture truth = room(160, 120, 1024, 99);
    double before = 1;
    for (int samples = 4; samples <= 1024; samples *= 4) {
        picture p = room(160, 120, samples, 7);
        const double noisy = distance(&p.image, &truth.image);
        assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
        const double clean = distance(&p.result, &truth.image);
        const double estimate = (double)rt_denoised_error(&p.image, 0);
        print_message("%4d samples: error %.2f %%, finished %.2f %%, estimate %.2f %%\n",
                      samples, 100 * noisy, 100 * clean, 100 * estimate);
        assert_true(clean < before);
        assert_true(samples != 16 || clean <= 0.25 * noisy);
        assert_true(samples > 256 || clean <= 0.5 * noisy);
        assert_true(clean <= 1.02 * noisy);
        assert_true(samples > 256 || (estimate > 0.7 * clean && estimate < 1.8 * clean));
        before = clean;
        free_picture(&p);
    }
    free_picture(&truth);
}

static void test_it_is_nearer_to_the_picture_of_another_renderer(void **state)
{
    /* Mitsuba's room, with 4096 samples (references/README.md). */
    (void)state;
    static scene_file file;
    assert_true(read_scene("tests/references/scenes/B_report_indirect.json", &file));
    picture p = new_picture(file.width, file.height);
    rt_image truth = {.width = file.width, .height = file.height};
    truth.pixels =
        read_pfm("tests/references/ref/B_report_indirect.pfm", file.width, file.height);
    assert_non_null(truth.pixels);
    const rt_options options = {.samples = 16, .bounces = file.bounces};
    rt_render(&file.scene, &file.camera, &options, &p.image);
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    const double noisy = distance(&p.image, &truth), clean = distance(&p.result, &truth);
    print_message("%d x %d, 16 samples against Mitsuba: %.2f %%, finished %.2f %%\n",
                  file.width, file.height, 100 * noisy, 100 * clean);
    assert_true(clean < 0.3 * noisy);
    free(truth.pixels);
    free_scene(&file);
    free_picture(&p);
}

static void test_it_keeps_the_light(void **state)
{
    (void)state;
    picture p = room(96, 72, 64, 3);
    double noisy = 0, clean = 0;
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    for (int i = 0; i < 96 * 72; i++) {
        noisy += (double)rt__mean(p.image.pixels[i]);
        clean += (double)rt__mean(p.result.pixels[i]);
    }
    assert_close(clean / noisy, 1, 0.01);
    free_picture(&p);
}

static void test_twice_the_light_is_twice_the_picture(void **state)
{
    /* and a scene a thousand times as large, with light for it, the same */
    (void)state;
    picture p = room(48, 36, 8, 0), q = room(48, 36, 8, 0);
    for (int i = 0; i < 48 * 36; i++) {
        rt_guide *g = &q.image.guides[i];
        q.image.pixels[i] = rt_scale(q.image.pixels[i], 1024);
        q.image.half[i] = rt_scale(q.image.half[i], 1024);
        g->direct = rt_scale(g->direct, 1024);
        g->half = rt_scale(g->half, 1024);
        g->point = rt_scale(g->point, 4096);
    }
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_int_equal(rt_denoise(&q.image, 0, &q.result), RT_OK);
    for (int i = 0; i < 48 * 36; i++)
        p.result.pixels[i] = rt_scale(p.result.pixels[i], 1024);
    assert_true(same_pixels(&p.result, &q.result));
    free_picture(&p);
    free_picture(&q);
}

/* ---- bad input ------------------------------------------------------------------------ */

static void test_bad_arguments(void **state)
{
    (void)state;
    picture p = room(8, 6, 4, 0);
    rt_image image = p.image, result = p.result;
    const rt_image untouched_result = p.result;
    rt_vec3 before[48];
    memset(p.result.pixels, 5, sizeof before);
    memcpy(before, p.result.pixels, sizeof before);
#define REFUSED(status)                                                                  \
    assert_int_equal(rt_denoise(&image, 0, &result), status);                            \
    image = p.image;                                                                     \
    result = untouched_result
    assert_int_equal(rt_denoise(NULL, 0, &result), RT_BAD_POINTER);
    assert_int_equal(rt_denoise(&image, 0, NULL), RT_BAD_POINTER);
    image.pixels = NULL;
    REFUSED(RT_BAD_POINTER);
    result.pixels = NULL;
    REFUSED(RT_BAD_POINTER);
    result.width = 7;
    REFUSED(RT_BAD_SIZE);
    result.height = 8;
    REFUSED(RT_BAD_SIZE);
    image.width = result.width = 0;
    REFUSED(RT_BAD_SIZE);
    image.width = result.width = image.height = result.height = 50000;
    REFUSED(RT_BAD_SIZE);
    image.width = result.width = INT_MAX; /* refused before memory is asked for */
    image.height = result.height = 1;
    REFUSED(RT_NO_MEMORY);
    image.width = result.width = 1;
    image.height = result.height = INT_MAX;
    REFUSED(RT_NO_MEMORY);
    image.done = 48;
    REFUSED(RT_BAD_SIZE);
    image.half = NULL;
    assert_true(isinf(rt_denoised_error(&image, 0)));
    REFUSED(RT_BAD_GUIDES);
    image.guides = NULL;
    assert_true(isinf(rt_denoised_error(&image, 0)));
    REFUSED(RT_BAD_GUIDES);
    image.samples = 0;
    REFUSED(RT_BAD_SAMPLES);
    image.samples = 1;
    assert_true(isinf(rt_denoised_error(&image, 0)));
    REFUSED(RT_BAD_SAMPLES);
    assert_int_equal(rt_denoise(&image, -1, &result), RT_BAD_THREADS);
    assert_int_equal(rt_denoise(&image, 1025, &result), RT_BAD_THREADS);
    assert_true(isinf(rt_denoised_error(NULL, 0)));
    taken = fail_at = 0;
    REFUSED(RT_NO_MEMORY);
    for (fail_at = 0; fail_at < 3;
         fail_at++) { /* for both outcomes, and to finish each */
        taken = 0;
        assert_true(isinf(rt_denoised_error(&image, 0)));
    }
    fail_at = -1;
    assert_memory_equal(p.result.pixels, before, sizeof before);
    assert_int_equal(p.result.samples, 0);
    free_picture(&p);
}

static bool is_finite(rt_vec3 v)
{
    return isfinite(v.x) && isfinite(v.y) && isfinite(v.z);
}

static void test_what_is_no_number_stays_where_it_is(void **state)
{
    (void)state;
    static const float bad[] = {NAN, INFINITY, -INFINITY, 1e30f};
    enum { W = 33, H = 20, AT = 7 * 33 + 11 };
    picture unknown = room(W, H, 4, 0);
    unknown.image.guides[AT].albedo = rt_vec(0, 0, 0); /* nobody asks this pixel */
    assert_int_equal(rt_denoise(&unknown.image, 0, &unknown.result), RT_OK);
    for (size_t k = 0; k < 6 * COUNT(bad); k++) {
        picture p = room(W, H, 4, 0);
        rt_guide *g = &p.image.guides[AT];
        rt_vec3 *const where[] = {
            &p.image.pixels[AT], &p.image.half[AT], &g->normal,
            &g->point,           &g->albedo,        &g->direct,
        };
        where[k % 6]->y = bad[k / 6];
        assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
        assert_memory_equal(&p.result.pixels[AT], &p.image.pixels[AT], sizeof(rt_vec3));
        for (int i = 0; i < W * H; i++)
            if (i != AT) {
                assert_true(is_finite(p.result.pixels[i]));
                assert_memory_equal(&p.result.pixels[i], &unknown.result.pixels[i],
                                    sizeof(rt_vec3));
            }
        free_picture(&p);
    }
    free_picture(&unknown);
}

static void test_black_bright_and_dark(void **state)
{
    (void)state;
    for (int k = 0; k < 5; k++) {
        static const float intensities[] = {0, 1e14f, 1e10f, 1e-20f, 1e-38f};
        rt_light light = room_light;
        light.intensity = rt_scale(rt_vec(1, 1, 1), intensities[k]);
        rt_scene scene = scene_mirror;
        scene.lights = &light;
        const rt_options options = {.samples = 4, .bounces = 5};
        picture p = new_picture(33, 20);
        rt_render(&scene, &room_camera, &options, &p.image);
        assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
        for (int i = 0; i < 33 * 20; i++) {
            const rt_vec3 c = p.result.pixels[i];
            assert_true(is_finite(c) && c.x >= 0 && c.y >= 0 && c.z >= 0);
            assert_true(k > 0 || rt_is_zero(c));
        }
        const float error = rt_denoised_error(&p.image, 0);
        assert_true(k > 0 ? error >= 0.0f : error == 0.0f);
        free_picture(&p);
    }
}

static void test_a_picture_that_was_stopped(void **state)
{
    /* The first pixels have one sample more than the others. */
    (void)state;
    picture p = room(40, 30, 5, 0), fewer = room(40, 30, 4, 0);
    for (int i = 600; i < 1200; i++) {
        p.image.pixels[i] = fewer.image.pixels[i];
        p.image.half[i] = fewer.image.half[i];
        p.image.guides[i] = fewer.image.guides[i];
    }
    p.image.samples = 4;
    p.image.done = 600;
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    assert_int_equal(p.result.done, 600);
    /* odd = (5 all - 3 even) / 2 for pixels with one more sample, 2 all - even
     * elsewhere */
    const rt_vec3 one = {1, 1, 1}, two = {2, 2, 2};
    assert_vec(rt__part_of(&p.image, RT__ODD, 599, one, two), -0.5f, -0.5f, -0.5f, 1e-6);
    assert_close(rt__spread(&p.image, RT__ODD, 599), sqrt(3.75), 1e-6);
    assert_vec(rt__part_of(&p.image, RT__ODD, 600, one, two), 0, 0, 0, 0);
    assert_close(rt__spread(&p.image, RT__ODD, 600), sqrt(2), 1e-6);
    free_picture(&p);
    free_picture(&fewer);
}

/* A picture of only the even samples, or only the odd ones, with its variance. */
static picture half_of(const rt_image *image, bool odd)
{
    picture p = new_picture(image->width, image->height);
    for (int i = 0; i < image->width * image->height; i++) {
        const rt_guide *g = &image->guides[i];
        const rt_vec3 d = rt_sub(image->half[i], image->pixels[i]);
        const rt_vec3 e = rt_sub(g->half, g->direct);
        const float side = odd ? -1 : 1;
        p.image.pixels[i] = rt_add(image->pixels[i], rt_scale(d, side));
        p.image.half[i] = rt_add(p.image.pixels[i], rt_scale(d, sqrtf(2)));
        p.image.guides[i] = *g;
        p.image.guides[i].direct = rt_add(g->direct, rt_scale(e, side));
        p.image.guides[i].half = rt_add(p.image.guides[i].direct, rt_scale(e, sqrtf(2)));
    }
    p.image.samples = image->samples;
    assert_int_equal(rt_denoise(&p.image, 0, &p.result), RT_OK);
    return p;
}

static double squares(const rt_image *a, const rt_image *b)
{
    double sum = 0;
    for (int i = 0; i < a->width * a->height; i++) {
        const rt_vec3 d = rt_sub(a->pixels[i], b->pixels[i]);
        sum += (double)rt_dot(d, d);
    }
    return sum / (3.0 * a->width * a->height);
}

static void test_the_estimate_by_its_definition(void **state)
{
    (void)state;
    picture p = room(64, 48, 16, 0);
    picture even = half_of(&p.image, false), odd = half_of(&p.image, true);
    double mean = 0;
    for (int i = 0; i < 64 * 48; i++)
        mean += (double)rt__mean(p.image.pixels[i]) / (64 * 48);
    const double expected = sqrt(0.5 * (squares(&even.result, &odd.image) +
                                        squares(&odd.result, &even.image) -
                                        squares(&even.image, &odd.image)));
    assert_close(rt_denoised_error(&p.image, 0), expected / mean, 1e-3 * expected / mean);
    free_picture(&p);
    free_picture(&even);
    free_picture(&odd);
}

static void test_an_estimate_of_any_threads(void **state)
{
    (void)state;
    picture p = room(64, 48, 16, 0);
    const float one = rt_denoised_error(&p.image, 1);
    for (int threads = 2; threads < 6; threads++)
        assert_true(rt_denoised_error(&p.image, threads) == one);
    assert_true(one > 0.01f && one < 0.1f);
    free_picture(&p);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_guides_change_no_bit_of_the_picture),
        cmocka_unit_test(test_guides_are_the_same_however_they_are_recorded),
        cmocka_unit_test(test_a_first_look),
        cmocka_unit_test(test_a_look_ends_on_the_fifth_mirror),
        cmocka_unit_test(test_a_look_in_lanes_ends_there_too),
        cmocka_unit_test(test_direct_light_is_all_without_bounces),
        cmocka_unit_test(test_your_own_pixels_have_no_guides),
        cmocka_unit_test(test_it_is_what_the_demo_does_by_hand),
        cmocka_unit_test(test_a_channel_that_sends_nothing_on),
        cmocka_unit_test(test_background_is_left_alone),
        cmocka_unit_test(test_the_image_goes_on_as_before),
        cmocka_unit_test(test_it_is_nearer_to_the_truth),
        cmocka_unit_test(test_it_is_nearer_to_the_picture_of_another_renderer),
        cmocka_unit_test(test_it_keeps_the_light),
        cmocka_unit_test(test_twice_the_light_is_twice_the_picture),
        cmocka_unit_test(test_bad_arguments),
        cmocka_unit_test(test_what_is_no_number_stays_where_it_is),
        cmocka_unit_test(test_black_bright_and_dark),
        cmocka_unit_test(test_a_picture_that_was_stopped),
        cmocka_unit_test(test_the_estimate_by_its_definition),
        cmocka_unit_test(test_an_estimate_of_any_threads),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

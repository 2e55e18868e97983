/* Chapter 14: a lens and a sky. */
#define DEMO "../demos/demo14_lens_and_sky.c"
#include "test.h"

static const rt_scene empty; /* all zero */
static const double pi = 3.14159265358979;

static rt_camera any_camera(rt_rng *rng)
{
    rt_camera camera = {.position = random_point(rng, 10),
                        .direction =
                            rt_scale(random_direction(rng), uniform(rng, 0.1f, 9)),
                        .up = random_direction(rng),
                        .fov_y = uniform(rng, 5, 120)};
    return camera;
}

static rt_lens any_lens(rt_rng *rng)
{
    const rt_lens lens = {uniform(rng, 0.01f, 3), uniform(rng, 0.5f, 40)};
    return lens;
}

/* ---- the lens ----------------------------------------------------------------------- */

static void test_all_of_the_lens_sees_one_point_of_the_sharp_plane(void **state)
{
    /* The ray from any point of the lens meets the plane at the distance focus, along the
     * axis, at the same point as the ray through the middle. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 260);
    for (int i = 0; i < 100000; i++) {
        const rt_camera camera = any_camera(&rng);
        const rt_lens lens = any_lens(&rng);
        const float x = uniform(&rng, 0, 40), y = uniform(&rng, 0, 30);
        const rt_ray pinhole = rt_camera_ray(&camera, 40, 30, x, y);
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_ray ray = rt_lens_ray(&camera, &lens, &pinhole, r1, r2);
        const rt_dvec3 axis = rt_dnormalize(rt_to_double(camera.direction));
        const rt_dvec3 c = rt_to_double(camera.position),
                       u = rt_to_double(pinhole.direction);
        const rt_dvec3 o = rt_to_double(ray.origin), v = rt_to_double(ray.direction);
        const double f = (double)lens.focus;
        const rt_dvec3 sharp = rt_dmad(c, f / rt_ddot(u, axis), u);
        const double way = (f - rt_ddot(rt_dsub(o, c), axis)) / rt_ddot(v, axis);
        const rt_dvec3 met = rt_dmad(o, way, v);
        const double far = sqrt(rt_ddot(rt_dsub(sharp, c), rt_dsub(sharp, c)));
        const rt_dvec3 off = rt_dsub(met, sharp);
        assert_close(sqrt(rt_ddot(off, off)), 0, 3e-6 * (far + 20));
        assert_close(rt_length(ray.direction), 1, 2e-7);
        assert_close(rt_ddot(rt_dsub(o, c), axis), 0, 1e-5);
    }
}

static void test_the_sharp_plane_is_no_sphere(void **state)
{
    /* The corner of a wide picture: the sharp point is focus / cosine away. */
    (void)state;
    const rt_camera camera = {.fov_y = 90};
    const rt_lens lens = {0.5f, 10};
    const rt_ray pinhole = rt_camera_ray(&camera, 40, 40, 40, 20); /* 45 degrees */
    for (int i = 0; i < 8; i++) {
        const rt_ray ray =
            rt_lens_ray(&camera, &lens, &pinhole, ((float)i + 0.5f) / 8, 0.999f);
        const float t = -10 / ray.direction.z;
        assert_vec(rt_at(&ray, t), 10, 0, -10, 2e-5);
    }
}

static void test_points_of_the_lens_are_uniform_on_a_disc(void **state)
{
    /* 10 rings and 10 sectors of the same area each; in the plane of right and top. */
    (void)state;
    enum { N = 200000 };
    rt_rng rng = rt_rng_start(0, 0, 261);
    const rt_camera camera = {
        .position = {1, 2, 3}, .direction = {1, 2, -2}, .up = {0, 0, 1}, .fov_y = 30};
    const rt_lens lens = {0.7f, 5};
    const rt_ray pinhole = rt_camera_ray(&camera, 40, 30, 11, 22);
    const rt_vec3 axis = rt_normalize(camera.direction);
    const rt_vec3 right = rt_normalize(rt_cross(camera.direction, camera.up)),
                  top = rt_cross(right, axis);
    int counts[100] = {0};
    for (int i = 0; i < N; i++) {
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_ray ray = rt_lens_ray(&camera, &lens, &pinhole, r1, r2);
        const rt_vec3 d = rt_sub(ray.origin, camera.position);
        const double x = (double)(rt_dot(d, right) / lens.radius),
                     y = (double)(rt_dot(d, top) / lens.radius);
        const int ring = (int)((x * x + y * y) * 10);
        const int sector = (int)((atan2(y, x) / (2 * pi) + 0.5) * 10);
        assert_in_range(ring, 0, 10);
        counts[(ring < 10 ? ring : 9) + 10 * (sector < 10 ? sector : 9)]++;
    }
    double chi = 0;
    for (int k = 0; k < 100; k++)
        chi += (counts[k] - N / 100.0) * (counts[k] - N / 100.0) / (N / 100.0);
    assert_close(chi, 99, 4 * sqrt(2 * 99.0));
}

static rt_image rendered(const rt_scene *scene, const rt_camera *camera,
                         const rt_options *options)
{
    rt_image image = new_image(32, 24);
    assert_int_equal(rt_render(scene, camera, options, &image), RT_OK);
    return image;
}

static const rt_sphere spheres[2] = {{{0, 0, -6}, 1, {{0.8f, 0.5f, 0.2f}, false}},
                                     {{0, -101, -6}, 100, {{0.7f, 0.7f, 0.7f}, false}}};
static const rt_light light = {{4, 5, -2}, {90, 80, 70}};

static rt_scene two_balls(void)
{
    rt_scene scene = empty;
    scene.spheres = spheres;
    scene.sphere_count = 2;
    scene.lights = &light;
    scene.light_count = 1;
    scene.background = rt_vec(0.2f, 0.4f, 0.8f);
    return scene;
}

static void test_radius_0_has_the_bits_of_the_pinhole(void **state)
{
    /* Whatever the focus, which does not count then. */
    (void)state;
    const rt_scene scene = two_balls();
    const rt_camera camera = {.fov_y = 60};
    const float focus[] = {5, 0, -1, NAN, INFINITY};
    rt_options options = {.samples = 3, .bounces = 3};
    rt_image pinhole = rendered(&scene, &camera, &options);
    for (size_t i = 0; i < COUNT(focus); i++) {
        options.lens.focus = focus[i];
        rt_image image = rendered(&scene, &camera, &options);
        assert_true(same_pixels(&pinhole, &image));
        assert_int_equal(pinhole.rays, image.rays);
        free(image.pixels);
    }
    options.lens.radius = 0.3f;
    options.lens.focus = 5;
    rt_image image = rendered(&scene, &camera, &options);
    assert_false(same_pixels(&pinhole, &image));
    free(image.pixels);
    free(pinhole.pixels);
}

static rt_vec3 by_hand(const void *context, float x, float y, rt_rng *rng)
{
    const rt_camera *camera = context;
    const rt_lens lens = {0.3f, 5};
    const rt_scene scene = two_balls();
    const rt_ray pinhole = rt_camera_ray(camera, 32, 24, x, y);
    const float r1 = rt_random(rng);
    const float r2 = rt_random(rng);
    const rt_ray ray = rt_lens_ray(camera, &lens, &pinhole, r1, r2);
    return rt_radiance(&scene, &ray, 3, rng);
}

static void test_rt_render_takes_rt_lens_ray(void **state)
{
    /* rt_render's film gives the rays of rt_lens_ray, to the bit; a pair of numbers for
     * each ray. */
    (void)state;
    const rt_scene scene = two_balls();
    const rt_camera camera = {
        .fov_y = 60, .position = {1, 0.5f, 1}, .direction = {-1, 0, -6}};
    const rt_options options = {.samples = 4, .bounces = 3, .lens = {0.3f, 5}};
    rt_image a = rendered(&scene, &camera, &options), b = new_image(32, 24);
    assert_int_equal(rt_render_pixels(by_hand, &camera, &options, &b), RT_OK);
    assert_true(same_pixels(&a, &b));
    free(a.pixels);
    free(b.pixels);
}

static void test_what_is_in_focus_is_sharp(void **state)
{
    /* A wall with one edge, black and white; the part of the picture that is neither. */
    (void)state;
    int blurred[3] = {0};
    const float focus[3] = {5, 10, 20};
    for (int k = 0; k < 3; k++) {
        const rt_box wall = {{0, -90, -11}, {90, 90, -10}, {{1, 1, 1}, false}};
        rt_scene scene = empty;
        const rt_surface shines = {.emission = {1, 1, 1}};
        scene.boxes = &wall;
        scene.box_count = 1;
        scene.surfaces = &shines;
        const rt_camera camera = {.fov_y = 30};
        const rt_options options = {.samples = 64, .lens = {0.5f, focus[k]}};
        rt_image image = rendered(&scene, &camera, &options);
        for (int i = 0; i < 32 * 24; i++)
            blurred[k] += image.pixels[i].x > 0.02f && image.pixels[i].x < 0.98f;
        free(image.pixels);
    }
    assert_true(blurred[1] <= 24); /* at most the column with the edge */
    assert_true(blurred[0] >= 24 * 4 && blurred[2] >= 24 * 2);
}

static void test_a_lens_where_there_is_no_camera(void **state)
{
    (void)state;
    const rt_camera camera = {.direction = {0, NAN, 0}};
    const rt_lens lens = {1, 5};
    const rt_ray none = rt_camera_ray(&camera, 4, 3, 1, 1);
    const rt_ray ray = rt_lens_ray(&camera, &lens, &none, 0.5f, 0.5f);
    assert_vec(ray.direction, 0, 0, 0, 0);
    const rt_camera ahead = {.fov_y = 60}; /* nor behind one */
    const rt_ray behind = ray_of(rt_vec(1, 2, 3), rt_vec(0, 0.6f, 0.8f));
    const rt_ray same = rt_lens_ray(&ahead, &lens, &behind, 0.5f, 0.5f);
    assert_memory_equal(&same, &behind, sizeof same);
}

static void test_lenses_that_are_refused(void **state)
{
    (void)state;
    const rt_scene scene = two_balls();
    const rt_camera camera = {.fov_y = 60};
    const rt_lens bad[] = {{-1, 5},  {NAN, 5},      {INFINITY, 5}, {1, 0},      {1, -5},
                           {1, NAN}, {1, INFINITY}, {1.1e15f, 1},  {1, 1.1e15f}};
    const rt_lens good[] = {
        {1e15f, 1e15f}, {1e-30f, 1e-30f}, {0, 0}, {1e15f, 1}, {1, 1e15f}};
    for (size_t i = 0; i < COUNT(bad) + COUNT(good); i++) {
        const bool is_bad = i < COUNT(bad);
        const rt_options options = {
            .samples = 1, .bounces = 2, .lens = is_bad ? bad[i] : good[i - COUNT(bad)]};
        rt_image image = new_image(32, 24);
        const rt_status status = rt_render(&scene, &camera, &options, &image);
        assert_int_equal(status, is_bad ? RT_BAD_LENS : RT_OK);
        for (int k = 0; k < 32 * 24; k++)
            assert_true(image.pixels[k].x >= 0 && image.pixels[k].x <= FLT_MAX);
        free(image.pixels);
    }
    assert_non_null(strstr(rt_status_text(RT_BAD_LENS), "lens"));
}

/* ---- the sky ------------------------------------------------------------------------ */

typedef struct counted {
    rt_vec3 colour;
    int calls;
    rt_vec3 last;
} counted;

static rt_vec3 one_colour(const void *data, rt_vec3 direction)
{
    counted *c = *(counted *const *)data;
    c->calls++;
    c->last = direction;
    return c->colour;
}

static void test_a_sky_of_one_colour_is_a_background(void **state)
{
    (void)state;
    counted c = {.colour = {0.2f, 0.4f, 0.8f}};
    counted *const data = &c;
    const rt_camera camera = {.fov_y = 60};
    for (int bounces = 0; bounces < 4; bounces++) {
        const rt_options options = {.samples = 3, .bounces = bounces, .threads = 1};
        const rt_scene background = two_balls();
        rt_scene sky = background;
        sky.background = rt_vec(9, 9, 9); /* not asked for */
        sky.sky = one_colour;
        sky.sky_data = &data;
        rt_image a = rendered(&background, &camera, &options),
                 b = rendered(&sky, &camera, &options);
        assert_true(same_pixels(&a, &b));
        assert_int_equal(a.rays, b.rays);
        free(a.pixels);
        free(b.pixels);
    }
    assert_true(c.calls > 1000);
    assert_close(rt_length(c.last), 1, 1e-6);
}

static void test_the_sky_gets_a_unit_vector(void **state)
{
    (void)state;
    counted c = {.colour = {1, 1, 1}};
    counted *const data = &c;
    rt_scene scene = empty;
    scene.sky = one_colour;
    scene.sky_data = &data;
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 30, 40));
    rt_rng rng = rt_rng_start(0, 0, 0);
    rt_radiance_mis(&scene, &ray, 0, &rng);
    assert_int_equal(c.calls, 1);
    assert_vec(c.last, 0, 0.6, 0.8, 1e-7);
}

static void test_the_sky_is_asked_after_as_many_bounces_as_a_background(void **state)
{
    /* The ray that is sent after the last bounce, where there are lamps, is not for the sky. */
    (void)state;
    counted c = {.colour = {1, 1, 1}};
    counted *const data = &c;
    const rt_box floor = {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_lamp lamp = {.center = {0, 90, 0}, .radius = 1, .intensity = {1, 1, 1}};
    rt_scene scene = empty;
    scene.boxes = &floor;
    scene.box_count = 1;
    scene.sky = one_colour;
    scene.sky_data = &data;
    for (int lamps = 0; lamps < 2; lamps++) {
        scene.lamps = &lamp;
        scene.lamp_count = lamps;
        for (uint32_t i = 0; i < 100; i++) {
            const rt_ray ray = ray_of(rt_vec(0, 1, 0), rt_vec(0.6f, -0.8f, 0));
            rt_rng rng = rt_rng_start(i, 0, 262);
            c.calls = 0;
            const rt_vec3 none = rt_radiance_mis(&scene, &ray, 0, &rng);
            assert_int_equal(c.calls, 0);
            assert_true(none.x < 1e-3f);
            const rt_vec3 once = rt_radiance_mis(&scene, &ray, 1, &rng);
            assert_true(c.calls == 1 || lamps);
            assert_close(once.x, 0.5, 1e-3);
        }
    }
}

static void test_what_a_sky_returns_is_bounded(void **state)
{
    (void)state;
    counted c = {.colour = {NAN, -1, 1e30f}};
    counted *const data = &c;
    rt_scene scene = empty;
    scene.sky = one_colour;
    scene.sky_data = &data;
    assert_vec(rt_sky(&scene, rt_vec(0, 1, 0)), 0, 0, (double)1e15f, 0);
    c.colour = rt_vec(INFINITY, -INFINITY, 1e15f);
    assert_vec(rt_sky(&scene, rt_vec(0, 1, 0)), (double)1e15f, 0, (double)1e15f, 0);
    c.colour = rt_vec(0, 1e-40f, 0.5f);
    assert_vec(rt_sky(&scene, rt_vec(0, 1, 0)), 0, 1e-40, 0.5, 1e-45);
    scene.sky = NULL;
    scene.background = rt_vec(1, 2, 3);
    assert_vec(rt_sky(&scene, rt_vec(0, 1, 0)), 1, 2, 3, 0);
}

static void test_a_sun_is_a_lamp_far_away(void **state)
{
    /* As large as ours, half a degree, at 1e6: E = pi L sin^2 a cos. Chance alone would find it
     * once in 50000 rays; nearly no noise here. */
    (void)state;
    const rt_box floor = {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}};
    const float far = 1e6f, sine = 0.00465f;
    rt_lamp sun = {.center = {0.6f * far, 0.8f * far, 0}, .radius = sine * far};
    const float i = 1000 * 3.14159265359f * sun.radius * sun.radius; /* L = 1000 */
    sun.intensity = rt_vec(i, i, i);
    rt_scene scene = empty;
    scene.boxes = &floor;
    scene.box_count = 1;
    scene.lamps = &sun;
    scene.lamp_count = 1;
    assert_int_equal(rt_check_scene(&scene, NULL), RT_OK);
    const double exact = 0.5 / pi * pi * 1000 * (double)sine * (double)sine * 0.8;
    double sum = 0;
    for (uint32_t k = 0; k < 2000; k++) {
        const rt_ray ray = ray_of(rt_vec(0, 1, 0), rt_vec(0.6f, -0.8f, 0));
        rt_rng rng = rt_rng_start(k, 0, 263);
        sum += (double)rt_radiance_mis(&scene, &ray, 0, &rng).x;
    }
    assert_close(sum / 2000 / exact, 1, 1e-3);
}

static void test_light_from_a_sky(void **state)
{
    /* A sky as bright as the cosine to the zenith: E = pi times 2/3. */
    (void)state;
    const rt_box floor = {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}};
    rt_scene scene = empty;
    scene.boxes = &floor;
    scene.box_count = 1;
    counted c = {.colour = {0, 0, 0}};
    counted *const data = &c;
    scene.sky = one_colour;
    scene.sky_data = &data;
    double sum = 0;
    for (uint32_t k = 0; k < 20000; k++) {
        const rt_ray ray = ray_of(rt_vec(0, 1, 0), rt_vec(0.6f, -0.8f, 0));
        rt_rng rng = rt_rng_start(k, 0, 264), again = rng;
        rt_radiance_mis(&scene, &ray, 1, &rng); /* tells where it looks */
        c.colour = rt_vec(c.last.y, 0, 0);
        sum += (double)rt_radiance_mis(&scene, &ray, 1, &again).x;
    }
    assert_close(sum / 20000, 0.5 * 2 / 3, 5e-3);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_ray_is_rt_lens_ray(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 265);
    for (int i = 0; i < 100000; i++) {
        const rt_camera camera = any_camera(&rng);
        const rt_lens lens = any_lens(&rng);
        const float x = uniform(&rng, 0, 40), y = uniform(&rng, 0, 30);
        const rt_ray pinhole = rt_camera_ray(&camera, 40, 30, x, y);
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_ray a = lens_ray(&camera, &lens, pinhole, r1, r2),
                     b = rt_lens_ray(&camera, &lens, &pinhole, r1, r2);
        assert_vec(a.origin, b.origin.x, b.origin.y, b.origin.z, 3e-6);
        assert_vec(a.direction, b.direction.x, b.direction.y, b.direction.z, 1e-5);
    }
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    /* But for roundings. */
    (void)state;
    rt_image theirs = render_the_demo(40, 30, 4, 1), ours = new_image(40, 30);
    const rt_options options = {.samples = 4, .bounces = 8, .seed = 1, .lens = room_lens};
    assert_int_equal(rt_render(&scene_sky, &room_camera, &options, &ours), RT_OK);
    double off = 0; /* the lens' ray is rounded in another way */
    for (int i = 0; i < 40 * 30; i++)
        off += (double)fabsf(theirs.pixels[i].x - ours.pixels[i].x) / (40 * 30);
    assert_close(off, 0, 1e-2);
    free(theirs.pixels);
    free(ours.pixels);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_all_of_the_lens_sees_one_point_of_the_sharp_plane),
        cmocka_unit_test(test_the_sharp_plane_is_no_sphere),
        cmocka_unit_test(test_points_of_the_lens_are_uniform_on_a_disc),
        cmocka_unit_test(test_radius_0_has_the_bits_of_the_pinhole),
        cmocka_unit_test(test_rt_render_takes_rt_lens_ray),
        cmocka_unit_test(test_what_is_in_focus_is_sharp),
        cmocka_unit_test(test_a_lens_where_there_is_no_camera),
        cmocka_unit_test(test_lenses_that_are_refused),
        cmocka_unit_test(test_a_sky_of_one_colour_is_a_background),
        cmocka_unit_test(test_the_sky_gets_a_unit_vector),
        cmocka_unit_test(test_the_sky_is_asked_after_as_many_bounces_as_a_background),
        cmocka_unit_test(test_what_a_sky_returns_is_bounded),
        cmocka_unit_test(test_a_sun_is_a_lamp_far_away),
        cmocka_unit_test(test_light_from_a_sky),
        cmocka_unit_test(test_demo_ray_is_rt_lens_ray),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("14 lens and sky", tests, NULL, NULL);
}

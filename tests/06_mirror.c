/* Chapter 6: mirrors. */
#define DEMO "../demos/demo06_mirror.c"
#include "test.h"

static const rt_scene empty; /* all zero */

static void test_reflect_on_the_floor(void **state)
{
    (void)state;
    assert_vec(rt_reflect(rt_vec(1, -2, 3), rt_vec(0, 1, 0)), 1, 2, 3, 0);
    assert_vec(rt_reflect(rt_vec(0, -1, 0), rt_vec(0, 1, 0)), 0, 1, 0,
               0); /* straight back */
    assert_vec(rt_reflect(rt_vec(1, 0, 0), rt_vec(0, 1, 0)), 1, 0, 0, 0); /* along it */
}

static void test_reflect_on_a_slanting_mirror(void **state)
{
    /* At 45 degrees, x comes out as -y. */
    (void)state;
    const float h = 0.70710678f;
    assert_vec(rt_reflect(rt_vec(1, 0, 0), rt_vec(h, h, 0)), 0, -1, 0, 2e-7);
}

static void test_reflect_properties(void **state)
{
    /* R is as long as I, at the same angle to N, in the plane of I and N, and the same
     * for -N; reflecting twice changes nothing. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 21);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 v = random_direction(&rng), n = random_direction(&rng);
        const rt_vec3 r = rt_reflect(v, n), same = rt_reflect(v, rt_scale(n, -1));
        const rt_vec3 back = rt_reflect(r, n);
        assert_close(rt_length(r), 1, 1e-6);
        assert_close(rt_dot(r, n), -rt_dot(v, n), 1e-6);
        assert_close(rt_dot(r, rt_cross(v, n)), 0, 1e-6);
        assert_vec(same, r.x, r.y, r.z, 0);
        assert_vec(back, v.x, v.y, v.z, 1e-6);
    }
}

/* A mirror floor below, and above it a lit ceiling that the camera sees in the floor. */
static rt_vec3 radiance_in_the_floor(rt_vec3 floor_albedo, int bounces, uint32_t *rays)
{
    const rt_box boxes[2] = {{{-9, -1, -9}, {9, 0, 9}, {floor_albedo, true}},
                             {{-9, 4, -9}, {9, 5, 9}, {{0.5f, 0.5f, 0.5f}, false}}};
    const rt_light light = {{0, 2, 0}, {4, 4, 4}};
    rt_scene scene = empty;
    scene.boxes = boxes;
    scene.box_count = 2;
    scene.lights = &light;
    scene.light_count = 1;
    const rt_ray ray =
        ray_of(rt_vec(-2, 2, 0), rt_vec(1, -1, 0)); /* meets y = 4 at x = 4 */
    rt_rng rng = rt_rng_start(0, 0, 0);
    const rt_vec3 value = rt_radiance(&scene, &ray, bounces, &rng);
    *rays = rng.rays;
    return value;
}

static void test_a_mirror_shows_what_the_reflected_ray_meets(void **state)
{
    /* The ceiling at (4, 4, 0): to the lamp (-4, -2, 0), d^2 = 20, cosine 2/sqrt(20). */
    (void)state;
    const double direct = 0.5 / 3.14159265 * 4 * (2 / sqrt(20.0)) / 20;
    uint32_t rays;
    assert_vec(radiance_in_the_floor(rt_vec(1, 1, 1), 1, &rays), direct, direct, direct,
               1e-6);
    assert_int_equal(rays, 3); /* camera, reflected, shadow */
}

static void test_the_albedo_of_a_mirror_tints_and_zero_means_one(void **state)
{
    (void)state;
    const double direct = 0.5 / 3.14159265 * 4 * (2 / sqrt(20.0)) / 20;
    uint32_t rays;
    assert_vec(radiance_in_the_floor(rt_vec(1, 0.5f, 0), 1, &rays), direct, 0.5 * direct,
               0, 1e-6);
    assert_vec(radiance_in_the_floor(rt_vec(0, 0, 0), 1, &rays), direct, direct, direct,
               1e-6);
}

static void test_a_mirror_without_bounces_is_black(void **state)
{
    (void)state;
    uint32_t rays;
    assert_vec(radiance_in_the_floor(rt_vec(1, 1, 1), 0, &rays), 0, 0, 0, 0);
    assert_int_equal(rays, 1);
    assert_vec(radiance_in_the_floor(rt_vec(1, 1, 1), -3, &rays), 0, 0, 0, 0);
}

static void test_two_mirrors_end_after_the_bounces(void **state)
{
    (void)state;
    const rt_box boxes[2] = {{{-9, -1, -9}, {9, 0, 9}, {{1, 1, 1}, true}},
                             {{-9, 4, -9}, {9, 5, 9}, {{1, 1, 1}, true}}};
    rt_scene scene = empty;
    scene.boxes = boxes;
    scene.box_count = 2;
    const rt_ray ray = ray_of(rt_vec(0, 2, 0), rt_vec(0, 1, 0));
    const int bounces[] = {0, 1, 5, 100000};
    for (size_t i = 0; i < COUNT(bounces); i++) {
        rt_rng rng = rt_rng_start(0, 0, 0);
        assert_vec(rt_radiance(&scene, &ray, bounces[i], &rng), 0, 0, 0, 0);
        assert_int_equal(rng.rays, bounces[i] + 1);
    }
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_reflect_is_rt_reflect(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 22);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 v = random_point(&rng, 3.0f), n = random_direction(&rng);
        const rt_vec3 theirs = reflect(v, n), ours = rt_reflect(v, n);
        assert_vec(theirs, ours.x, ours.y, ours.z, 0);
    }
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reflect_on_the_floor),
        cmocka_unit_test(test_reflect_on_a_slanting_mirror),
        cmocka_unit_test(test_reflect_properties),
        cmocka_unit_test(test_a_mirror_shows_what_the_reflected_ray_meets),
        cmocka_unit_test(test_the_albedo_of_a_mirror_tints_and_zero_means_one),
        cmocka_unit_test(test_a_mirror_without_bounces_is_black),
        cmocka_unit_test(test_two_mirrors_end_after_the_bounces),
        cmocka_unit_test(test_demo_reflect_is_rt_reflect),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("6 mirror", tests, NULL, NULL);
}

/* Chapter 2: the nearest hit, Lambert's law. */
#define DEMO "../demos/demo02_walls.c"
#include "test.h"

static const rt_scene empty; /* all zero */

static void test_the_nearest_of_three(void **state)
{
    (void)state;
    const rt_sphere spheres[3] = {
        {{0, 0, -9}, 1, {{1, 0, 0}, false}},
        {{0, 0, -5}, 1, {{0, 1, 0}, false}},
        {{0, 0, 5}, 1, {{0, 0, 1}, false}},
    };
    rt_scene scene = empty;
    scene.spheres = spheres;
    scene.sphere_count = 3;
    rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_true(rt_intersect(&scene, &ray, &hit));
    assert_close(hit.t, 4, 0);
    assert_ptr_equal(hit.material, &spheres[1].material);
    ray.direction.z = 1;
    assert_true(rt_intersect(&scene, &ray, &hit));
    assert_ptr_equal(hit.material, &spheres[2].material);
}

static void test_a_miss_leaves_the_hit_alone(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, -5}, 1, {{1, 0, 0}, false}};
    rt_scene scene = empty;
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 1, 0));
    rt_hit hit = untouched;
    assert_false(rt_intersect(&scene, &ray, &hit)); /* empty, with NULL arrays */
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    assert_false(rt_intersect(&scene, &ray, &hit));
    assert_untouched(hit);
}

static void test_of_two_in_the_same_place_the_first_wins(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 7);
    for (int i = 0; i < 1000; i++) {
        rt_sphere spheres[2] = {{{0, 0, 0}, 1, {{1, 0, 0}, false}},
                                {{0, 0, 0}, 1, {{0, 1, 0}, false}}};
        const float radius = uniform(&rng, 0.5f, 3.0f);
        spheres[0].radius = spheres[1].radius = radius;
        rt_scene scene = empty;
        scene.spheres = spheres;
        scene.sphere_count = 2;
        const rt_vec3 origin = rt_scale(random_direction(&rng), 10.0f);
        const rt_vec3 target = random_point(&rng, 0.2f);
        const rt_ray ray = ray_of(origin, rt_sub(target, origin));
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        assert_ptr_equal(hit.material, &spheres[0].material);
    }
}

static void test_spheres_go_before_boxes_at_the_same_distance(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, -5}, 1, {{1, 0, 0}, false}};
    const rt_box box = {{-1, -1, -6}, {1, 1, -4}, {{0, 1, 0}, false}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.boxes = &box;
    scene.box_count = 1;
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_true(rt_intersect(&scene, &ray, &hit));
    assert_ptr_equal(hit.material, &sphere.material);
}

static void test_intersect_is_the_smallest_of_all_single_hits(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 8);
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        const rt_ray ray = random_ray(&rng);
        const rt_material *material = NULL;
        float t = FLT_MAX;
        for (size_t k = 0; k < COUNT(r.spheres) + COUNT(r.boxes); k++) {
            const size_t b = k - COUNT(r.spheres);
            rt_hit one = untouched;
            const bool is_hit = k < COUNT(r.spheres)
                                    ? rt_hit_sphere(&r.spheres[k], &ray, FLT_MAX, &one)
                                    : rt_hit_box(&r.boxes[b], &ray, FLT_MAX, &one);
            if (is_hit && one.t < t) {
                t = one.t;
                material = one.material;
            }
        }
        rt_hit hit = untouched;
        assert_int_equal(rt_intersect(&r.scene, &ray, &hit), material != NULL);
        assert_ptr_equal(hit.material, material);
        if (material)
            assert_close(hit.t, t, 0);
        hits += material != NULL;
    }
    assert_in_range(hits, 5000, 19000);
}

/* ---- Lambert's law, by hand --------------------------------------------------------- */

static void test_lambert_straight_above(void **state)
{
    /* rho/pi . I . 1 / 2^2 with I = 4 pi: rho itself. */
    (void)state;
    const float i = 4.0f * 3.14159265f;
    const rt_vec3 v = rt_lambert(rt_vec(0.2f, 0.5f, 1), rt_vec(0, 1, 0), rt_vec(0, 2, 0),
                                 rt_vec(i, i, i));
    assert_vec(v, 0.2, 0.5, 1.0, 2e-7);
}

static void test_lambert_at_sixty_degrees(void **state)
{
    /* to_light = (3, sqrt(3), 0): d^2 = 12, cosine = sqrt(3)/sqrt(12) = 1/2. */
    (void)state;
    const rt_vec3 v = rt_lambert(rt_vec(0.6f, 0.6f, 0.6f), rt_vec(0, 1, 0),
                                 rt_vec(3, 1.7320508f, 0), rt_vec(24, 48, 0));
    assert_vec(v, 0.6 / 3.14159265, 1.2 / 3.14159265, 0, 1e-7);
}

static void test_lambert_twice_as_far_is_a_quarter(void **state)
{
    (void)state;
    const rt_vec3 one = {1, 1, 1}, n = {0, 0, 1}, l = {0.3f, -0.4f, 1.2f};
    const rt_vec3 a = rt_lambert(one, n, l, one);
    const rt_vec3 b = rt_lambert(one, n, rt_scale(l, 2), one);
    assert_close(b.x / a.x, 0.25, 1e-6);
}

static void test_lambert_from_behind_or_in_the_point_is_black(void **state)
{
    (void)state;
    const rt_vec3 one = {1, 1, 1}, up = {0, 1, 0};
    assert_vec(rt_lambert(one, up, rt_vec(0, -1, 0), one), 0, 0, 0, 0);
    assert_vec(rt_lambert(one, up, rt_vec(1, 0, 0), one), 0, 0, 0, 0);
    assert_vec(rt_lambert(one, up, rt_vec(0, 0, 0), one), 0, 0, 0, 0);
    assert_vec(rt_lambert(one, up, rt_vec(0, 1e-20f, 0), one), 0, 0, 0, 0);
    assert_vec(rt_lambert(one, up, rt_vec(0, NAN, 0), one), 0, 0, 0, 0);
    assert_vec(rt_lambert(one, up, rt_vec(0, 1e30f, 0), one), 0, 0, 0, 0);
}

static void test_lambert_sends_no_more_than_it_gets(void **state)
{
    /* Light all around: the mean of rho/pi . cosine over the hemisphere, times its 2 pi
     * sr, is rho. By the midpoint rule over the cosine. */
    (void)state;
    double sum = 0;
    for (int i = 0; i < 1000; i++) {
        const float z = ((float)i + 0.5f) / 1000.0f;
        const rt_vec3 l = rt_vec(sqrtf(1 - z * z), 0, z);
        sum +=
            (double)rt_lambert(rt_vec(0.7f, 0, 0), rt_vec(0, 0, 1), l, rt_vec(1, 1, 1)).x;
    }
    assert_close(sum / 1000 * 2 * 3.14159265, 0.7, 1e-5);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_nearest_is_rt_intersect(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 9);
    for (int i = 0; i < 20000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        r.scene.box_count = 0; /* chapter 2 has no boxes yet */
        const rt_ray ray = random_ray(&rng);
        rt_hit theirs = untouched, ours = untouched;
        assert_int_equal(nearest(&r.scene, &ray, &theirs),
                         rt_intersect(&r.scene, &ray, &ours));
        assert_ptr_equal(theirs.material, ours.material);
        assert_close(theirs.t, ours.t, 0);
    }
}

static void test_demo_lambert_is_rt_lambert(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 10);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 albedo = random_colour(&rng), n = random_direction(&rng);
        const rt_vec3 l = random_point(&rng, 3.0f), intensity = random_colour(&rng);
        const rt_vec3 theirs = lambert(albedo, n, l, intensity);
        const rt_vec3 ours = rt_lambert(albedo, n, l, intensity);
        const double full = 1.0 / (3.14159 * (double)rt_dot(l, l)); /* with cosine 1 */
        assert_vec(theirs, ours.x, ours.y, ours.z, 1e-6 * full);
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
        cmocka_unit_test(test_the_nearest_of_three),
        cmocka_unit_test(test_a_miss_leaves_the_hit_alone),
        cmocka_unit_test(test_of_two_in_the_same_place_the_first_wins),
        cmocka_unit_test(test_spheres_go_before_boxes_at_the_same_distance),
        cmocka_unit_test(test_intersect_is_the_smallest_of_all_single_hits),
        cmocka_unit_test(test_lambert_straight_above),
        cmocka_unit_test(test_lambert_at_sixty_degrees),
        cmocka_unit_test(test_lambert_twice_as_far_is_a_quarter),
        cmocka_unit_test(test_lambert_from_behind_or_in_the_point_is_black),
        cmocka_unit_test(test_lambert_sends_no_more_than_it_gets),
        cmocka_unit_test(test_demo_nearest_is_rt_intersect),
        cmocka_unit_test(test_demo_lambert_is_rt_lambert),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("2 walls", tests, NULL, NULL);
}

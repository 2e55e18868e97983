/* Chapter 4: leaving a surface, shadows, direct light. */
#define DEMO "../demos/demo04_shadows.c"
#include "test.h"

static const rt_scene empty; /* all zero */

/* ---- leaving a surface -------------------------------------------------------------- */

static void test_leave_goes_to_the_side_of_the_ray(void **state)
{
    (void)state;
    const rt_vec3 p = {0, 5, 0}, n = {0, 1, 0};
    assert_true(rt_leave(p, n, rt_vec(1, 0.1f, 0)).y > 5);
    assert_true(rt_leave(p, n, rt_vec(1, -0.1f, 0)).y < 5);
    assert_close(rt_leave(p, n, rt_vec(1, 0.1f, 0)).x, 0, 0);
}

static void test_leave_is_eight_roundings_of_the_largest_coordinate(void **state)
{
    (void)state;
    const rt_vec3 n = {0, 1, 0}, d = {0, 1, 0};
    assert_close(rt_leave(rt_vec(0, 0, 0), n, d).y, 8 * FLT_EPSILON, 0);
    assert_close(rt_leave(rt_vec(-64, 0, 0), n, d).y, 512 * FLT_EPSILON, 0);
    assert_close(rt_leave(rt_vec(0, 0, 64), n, d).y, 512 * FLT_EPSILON, 0);
    assert_close(rt_leave(rt_vec(0, 64, 0), n, d).y, 64 + 512 * FLT_EPSILON, 0);
    const float in_the_room = rt_leave(rt_vec(60, 0, 60), n, d).y;
    assert_true(in_the_room <= 1e-4f * 120.0f);
}

/* A convex sphere is never hit again by a ray that leaves it outwards. */
static void check_no_self_hit(float radius)
{
    rt_rng rng = rt_rng_start(0, (uint32_t)radius, 13);
    int self_hits = 0;
    for (int i = 0; i < 1000000; i++) {
        /* a wall whose near side passes through the room: what the room sees of it */
        const rt_vec3 out = random_direction(&rng);
        rt_sphere sphere = {{0, 0, 0}, radius, {{1, 1, 1}, false}};
        sphere.center = rt_sub(random_point(&rng, 50.0f), rt_scale(out, radius));
        const rt_vec3 near_side = rt_add(sphere.center, rt_scale(out, radius));
        const rt_vec3 jitter = random_point(&rng, radius < 30.0f ? 0.5f * radius : 30.0f);
        const rt_vec3 origin = rt_add(near_side, rt_scale(out, 20.0f));
        const rt_ray ray = ray_of(origin, rt_sub(rt_add(near_side, jitter), origin));
        rt_hit hit = untouched;
        if (!rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit))
            continue;
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 d = rt_sample_cosine(hit.normal, r1, r2);
        const rt_ray next = ray_of(rt_leave(hit.point, hit.normal, d), d);
        self_hits += rt_hit_sphere(&sphere, &next, FLT_MAX, &hit);
    }
    print_message("radius %g: %d self-hits\n", (double)radius, self_hits);
    assert_int_equal(self_hits, 0);
}

static void test_no_self_hits_on_spheres(void **state)
{
    (void)state;
    check_no_self_hit(1);
    check_no_self_hit(940);
    check_no_self_hit(1e5f);
}

static void test_no_self_hits_on_boxes(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 14);
    int self_hits = 0, hits = 0;
    for (int i = 0; i < 100000; i++) {
        rt_box box = {{0, 0, 0}, {0, 0, 0}, {{1, 1, 1}, false}};
        box.min = random_point(&rng, 50.0f);
        box.max = rt_add(box.min, rt_scale(random_colour(&rng), 30.0f));
        const rt_vec3 origin = random_point(&rng, 60.0f);
        const rt_vec3 target = rt_scale(rt_add(box.min, box.max), 0.5f);
        const rt_ray ray = ray_of(origin, rt_sub(target, origin));
        rt_hit hit = untouched;
        if (rt_dot(ray.direction, ray.direction) < 1500.0f ||
            !rt_hit_box(&box, &ray, FLT_MAX, &hit))
            continue;
        hits++;
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 d = rt_sample_cosine(hit.normal, r1, r2);
        const rt_ray next = ray_of(rt_leave(hit.point, hit.normal, d), d);
        self_hits += rt_hit_box(&box, &next, FLT_MAX, &hit);
    }
    assert_true(hits > 50000);
    assert_int_equal(self_hits, 0);
}

/* ---- shadows ------------------------------------------------------------------------ */

static const rt_vec3 floor_point = {0, 0, 0}, floor_normal = {0, 1, 0}, lamp = {0, 10, 0};

static void test_a_sphere_in_between_hides_the_light(void **state)
{
    (void)state;
    rt_sphere sphere = {{0, 5, 0}, 1, {{1, 1, 1}, false}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    assert_false(rt_visible(&scene, floor_point, floor_normal, lamp));
    sphere.center.x = 1.001f; /* just beside */
    assert_true(rt_visible(&scene, floor_point, floor_normal, lamp));
}

static void test_a_box_in_between_hides_the_light(void **state)
{
    (void)state;
    rt_box box = {{-1, 4, -1}, {1, 5, 1}, {{1, 1, 1}, false}};
    rt_scene scene = empty;
    scene.boxes = &box;
    scene.box_count = 1;
    assert_false(rt_visible(&scene, floor_point, floor_normal, lamp));
    box.min.x = 0.001f;
    assert_true(rt_visible(&scene, floor_point, floor_normal, lamp));
}

static void test_what_is_behind_the_light_or_the_point_does_not_count(void **state)
{
    (void)state;
    const rt_sphere spheres[2] = {{{0, 12, 0}, 1, {{1, 1, 1}, false}},
                                  {{0, -2, 0}, 1, {{1, 1, 1}, false}}};
    rt_scene scene = empty;
    scene.spheres = spheres;
    scene.sphere_count = 2;
    assert_true(rt_visible(&scene, floor_point, floor_normal, lamp));
}

static void test_any_of_several_hides_the_light(void **state)
{
    (void)state;
    const rt_sphere spheres[3] = {{{5, 5, 0}, 1, {{1, 1, 1}, false}},
                                  {{0, 2, 0}, 1, {{1, 1, 1}, false}},
                                  {{0, 8, 0}, 1, {{1, 1, 1}, false}}};
    rt_scene scene = empty;
    scene.spheres = spheres;
    for (int count = 0; count <= 3; count++) {
        scene.sphere_count = count;
        assert_int_equal(rt_visible(&scene, floor_point, floor_normal, lamp), count < 2);
    }
}

static void test_visible_both_ways(void **state)
{
    /* Whether two points of a scene see each other does not depend on which of them
     * asks. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 15);
    int seen = 0, total = 0;
    for (int i = 0; i < 20000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        const rt_ray ray = random_ray(&rng);
        rt_hit hit = untouched;
        if (!rt_intersect(&r.scene, &ray, &hit))
            continue;
        const rt_vec3 to_camera = rt_sub(ray.origin, hit.point);
        if (rt_dot(hit.normal, rt_normalize(to_camera)) < 0.01f)
            continue; /* too flat to tell */
        total++;
        seen += rt_visible(&r.scene, hit.point, hit.normal, ray.origin);
    }
    assert_true(total > 5000);
    assert_int_equal(seen, total); /* the camera saw the point */
}

static void test_occluded_is_intersect_nearer_than_t_max(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 16);
    int occluded = 0;
    for (int i = 0; i < 20000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        const rt_ray ray = random_ray(&rng);
        const float t_max = rt_random(&rng);
        rt_hit hit = untouched;
        const bool expected = rt_intersect(&r.scene, &ray, &hit) && hit.t < t_max;
        assert_int_equal(rt_occluded(&r.scene, &ray, t_max), expected);
        occluded += expected;
    }
    assert_in_range(occluded, 2000, 18000);
}

/* ---- direct light ------------------------------------------------------------------- */

static rt_hit hit_on_floor(const rt_material *material)
{
    rt_hit hit = {.t = 1, .normal = {0, 1, 0}};
    hit.material = material;
    return hit;
}

static void test_direct_light_adds_the_lights_that_are_seen(void **state)
{
    /* Lamps 1 above (cosine 1, d 1), at (4, 3, 0) (cosine 3/5, d 5), one in the shadow of
     * the sphere, and one below the floor: only the first two give light. */
    (void)state;
    const rt_material grey = {{0.5f, 0.5f, 0.5f}, false};
    const rt_sphere sphere = {{-4, 4, 0}, 1, {{1, 1, 1}, false}};
    const rt_light lights[4] = {{{0, 1, 0}, {1, 0, 0}},
                                {{4, 3, 0}, {0, 1, 0}},
                                {{-8, 8, 0}, {9, 9, 9}},
                                {{0, -1, 0}, {9, 9, 9}}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.lights = lights;
    scene.light_count = 4;
    const rt_hit hit = hit_on_floor(&grey);
    rt_rng rng = rt_rng_start(0, 0, 0);
    const double pi = 3.14159265;
    assert_vec(rt_direct(&scene, &hit, &rng), 0.5 / pi, 0.5 / pi * 0.6 / 25, 0, 1e-7);
    assert_int_equal(rng.rays, 3);                  /* no shadow ray to the lamp below */
    const rt_light beside = {{5, 0, 0}, {9, 9, 9}}; /* in the plane of the floor */
    scene.lights = &beside;
    scene.light_count = 1;
    assert_vec(rt_direct(&scene, &hit, &rng), 0, 0, 0, 0);
    assert_int_equal(rng.rays, 3);
}

static void test_no_light_is_black(void **state)
{
    (void)state;
    const rt_material white = {{1, 1, 1}, false};
    const rt_hit hit = hit_on_floor(&white);
    rt_rng rng = rt_rng_start(0, 0, 0);
    assert_vec(rt_direct(&empty, &hit, &rng), 0, 0, 0, 0);
    assert_int_equal(rng.rays, 0);
}

static void test_a_closed_room_is_not_black(void **state)
{
    /* The shadow ray ends at the lamp: the wall behind it does not hide it. */
    (void)state;
    const rt_sphere room = {{0, 0, 0}, 10, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_light light = {{0, 0, 0}, {100, 100, 100}};
    rt_scene scene = empty;
    scene.spheres = &room;
    scene.sphere_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    rt_rng rng = rt_rng_start(0, 0, 17);
    for (int i = 0; i < 10000; i++) {
        const rt_ray ray = ray_of(random_point(&rng, 5.0f), random_direction(&rng));
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        assert_close(rt_direct(&scene, &hit, &rng).x, 0.5 / 3.14159265, 1e-6);
    }
}

static void test_a_light_on_or_in_a_surface_gives_no_infinity(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, 0}, 1, {{1, 1, 1}, false}};
    rt_light light = {{0, 1, 0}, {1, 1, 1}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    rt_rng rng = rt_rng_start(0, 0, 18);
    for (int i = 0; i < 10000; i++) {
        const rt_vec3 origin = rt_scale(random_direction(&rng), 5.0f);
        const rt_ray ray = ray_of(origin, rt_sub(rt_vec(0, 0.99f, 0), origin));
        rt_hit hit = untouched;
        if (!rt_intersect(&scene, &ray, &hit))
            continue;
        light.position = i % 2 ? hit.point : rt_vec(0, 1, 0);
        const rt_vec3 v = rt_direct(&scene, &hit, &rng);
        assert_true(v.x >= 0 && v.x <= FLT_MAX);
    }
    light.position = rt_vec(0, 0, 0); /* in the sphere: dark outside */
    const rt_ray ray = ray_of(rt_vec(0, 5, 0), rt_vec(0, -1, 0));
    rt_hit hit = untouched;
    assert_true(rt_intersect(&scene, &ray, &hit));
    assert_vec(rt_direct(&scene, &hit, &rng), 0, 0, 0, 0);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_visible_is_rt_visible(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 19);
    int seen = 0;
    for (int i = 0; i < 50000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        const rt_ray ray = random_ray(&rng);
        rt_hit hit = untouched;
        if (!rt_intersect(&r.scene, &ray, &hit))
            continue;
        const rt_vec3 s = r.lights[i % 3].position;
        const bool ours = rt_visible(&r.scene, hit.point, hit.normal, s);
        assert_int_equal(visible(&r.scene, hit.point, hit.normal, s), ours);
        seen += ours;
    }
    assert_in_range(seen, 5000, 40000);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_leave_goes_to_the_side_of_the_ray),
        cmocka_unit_test(test_leave_is_eight_roundings_of_the_largest_coordinate),
        cmocka_unit_test(test_no_self_hits_on_spheres),
        cmocka_unit_test(test_no_self_hits_on_boxes),
        cmocka_unit_test(test_a_sphere_in_between_hides_the_light),
        cmocka_unit_test(test_a_box_in_between_hides_the_light),
        cmocka_unit_test(test_what_is_behind_the_light_or_the_point_does_not_count),
        cmocka_unit_test(test_any_of_several_hides_the_light),
        cmocka_unit_test(test_visible_both_ways),
        cmocka_unit_test(test_occluded_is_intersect_nearer_than_t_max),
        cmocka_unit_test(test_direct_light_adds_the_lights_that_are_seen),
        cmocka_unit_test(test_no_light_is_black),
        cmocka_unit_test(test_a_closed_room_is_not_black),
        cmocka_unit_test(test_a_light_on_or_in_a_surface_gives_no_infinity),
        cmocka_unit_test(test_demo_visible_is_rt_visible),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("4 shadows", tests, NULL, NULL);
}

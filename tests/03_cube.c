/* Chapter 3: boxes. */
#define DEMO "../demos/demo03_cube.c"
#include "test.h"

static rt_box box_of(float x0, float y0, float z0, float x1, float y1, float z1)
{
    const rt_box box = {{x0, y0, z0}, {x1, y1, z1}, {{1, 1, 1}, false}};
    return box;
}

static bool hits(const rt_box *box, rt_vec3 origin, rt_vec3 direction, rt_hit *hit)
{
    const rt_ray ray = ray_of(origin, direction);
    *hit = untouched;
    return rt_hit_box(box, &ray, FLT_MAX, hit);
}

/* ---- examples ----------------------------------------------------------------------- */

static void test_the_six_faces(void **state)
{
    /* From the point 10 in front of each face of a cube, towards its centre. */
    (void)state;
    const rt_box box = box_of(-1, -1, -1, 1, 1, 1);
    const rt_vec3 axes[6] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                             {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    for (int i = 0; i < 6; i++) {
        const rt_vec3 n = axes[i];
        rt_hit hit;
        assert_true(hits(&box, rt_scale(n, 11), rt_scale(n, -1), &hit));
        assert_close(hit.t, 10, 0);
        assert_vec(hit.point, n.x, n.y, n.z, 0);
        assert_vec(hit.normal, n.x, n.y, n.z, 0);
        assert_ptr_equal(hit.material, &box.material);
    }
}

static void test_slanting(void **state)
{
    /* From (0, 0, 4), going 1 right and 2 down the z axis: at z = 1, x is 1.5. */
    (void)state;
    const rt_box box = box_of(0, -1, -1, 2, 1, 1);
    rt_hit hit;
    assert_true(hits(&box, rt_vec(0, 0, 4), rt_vec(1, 0, -2), &hit));
    assert_close(hit.t, 1.5, 0);
    assert_vec(hit.point, 1.5, 0, 1, 0);
    assert_false(hits(&box, rt_vec(0, 0, 4), rt_vec(4, 0, -2), &hit));
    assert_untouched(hit);
}

static void test_from_inside_it_is_the_way_out(void **state)
{
    (void)state;
    const rt_box box = box_of(-1, -2, -3, 1, 2, 3);
    const rt_vec3 axes[6] = {{1, 0, 0},  {-1, 0, 0}, {0, 1, 0},
                             {0, -1, 0}, {0, 0, 1},  {0, 0, -1}};
    const float distances[3] = {1, 2, 3};
    for (int i = 0; i < 6; i++) {
        const rt_vec3 d = axes[i];
        rt_hit hit;
        assert_true(hits(&box, rt_vec(0, 0, 0), d, &hit));
        assert_close(hit.t, distances[i / 2], 0);
        assert_vec(hit.normal, -d.x, -d.y, -d.z, 0);
        assert_close(rt_dot(hit.point, d), distances[i / 2], 0);
    }
}

static void test_behind_and_beyond_t_max_are_misses(void **state)
{
    (void)state;
    const rt_box box = box_of(-1, -1, -6, 1, 1, -4);
    const rt_ray away = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, 1));
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_false(rt_hit_box(&box, &away, FLT_MAX, &hit));
    assert_false(rt_hit_box(&box, &ray, 4, &hit));
    assert_untouched(hit);
    assert_true(rt_hit_box(&box, &ray, nextafterf(4, 5), &hit));
}

static void test_zero_components_of_either_sign(void **state)
{
    (void)state;
    const rt_box box = box_of(-1, -1, -1, 1, 1, 1);
    const float zeros[2] = {0.0f, -0.0f};
    for (int i = 0; i < 4; i++) {
        const rt_vec3 d = rt_vec(zeros[i & 1], zeros[i >> 1], -1);
        const float inside[] = {-1, -0.5f, 0, 1}, outside[] = {-1.0000001f, 1.5f};
        rt_hit hit;
        for (size_t k = 0; k < COUNT(inside); k++) {
            assert_true(hits(&box, rt_vec(inside[k], 0, 3), d, &hit));
            assert_close(hit.t, 2, 0);
            assert_true(hits(&box, rt_vec(0, inside[k], 3), d, &hit));
        }
        for (size_t k = 0; k < COUNT(outside); k++) {
            assert_false(hits(&box, rt_vec(outside[k], 0, 3), d, &hit));
            assert_false(hits(&box, rt_vec(0, outside[k], 3), d, &hit));
        }
    }
}

static void test_edges_and_corners_go_x_before_y_before_z(void **state)
{
    (void)state;
    const rt_box box = box_of(-1, -1, -1, 1, 1, 1);
    rt_hit hit;
    assert_true(hits(&box, rt_vec(2, 2, 2), rt_vec(-1, -1, -1), &hit));
    assert_vec(hit.normal, 1, 0, 0, 0);
    assert_true(hits(&box, rt_vec(0, 2, 2), rt_vec(0, -1, -1), &hit));
    assert_vec(hit.normal, 0, 1, 0, 0);
    assert_true(hits(&box, rt_vec(2, 0, 2), rt_vec(-1, 0, -1), &hit));
    assert_vec(hit.normal, 1, 0, 0, 0);
    assert_true(hits(&box, rt_vec(0, 0, 0), rt_vec(1, 1, 1), &hit)); /* out of a corner */
    assert_vec(hit.normal, -1, 0, 0, 0);
}

static void test_on_a_face(void **state)
{
    (void)state;
    const rt_box box = box_of(-1, -1, -1, 1, 1, 1);
    rt_hit hit;
    assert_false(hits(&box, rt_vec(1, 0, 0), rt_vec(1, 0, 0), &hit)); /* leaving */
    assert_true(hits(&box, rt_vec(1, 0, 0), rt_vec(-1, 0, 0), &hit)); /* entering */
    assert_close(hit.t, 2, 0);
    assert_true(hits(&box, rt_vec(1, 0, 0), rt_vec(0, 1, 0), &hit)); /* along the face */
    assert_close(hit.t, 1, 0);
    assert_true(hits(&box, rt_vec(1, -3, 0), rt_vec(0, 1, 0), &hit)); /* in its plane */
    assert_close(hit.t, 2, 0);
    assert_vec(hit.normal, 0, -1, 0, 0);
}

static void test_flat_and_point_boxes(void **state)
{
    (void)state;
    const rt_box flat = box_of(-1, 0, -1, 1, 0, 1), point = box_of(1, 2, 3, 1, 2, 3);
    rt_hit hit;
    assert_true(hits(&flat, rt_vec(0, 5, 0), rt_vec(0, -1, 0), &hit));
    assert_close(hit.t, 5, 0);
    assert_vec(hit.normal, 0, 1, 0, 0);
    assert_true(hits(&flat, rt_vec(0, -5, 0), rt_vec(0, 1, 0), &hit));
    assert_vec(hit.normal, 0, -1, 0, 0);
    assert_true(hits(&flat, rt_vec(-3, 0, 0), rt_vec(1, 0, 0), &hit)); /* edge on */
    assert_close(hit.t, 2, 0);
    assert_vec(hit.normal, -1, 0, 0, 0);
    assert_false(hits(&flat, rt_vec(-3, 1e-30f, 0), rt_vec(1, 0, 0), &hit));
    assert_true(hits(&point, rt_vec(1, 2, 0), rt_vec(0, 0, 1), &hit));
    assert_close(hit.t, 3, 0);
    assert_vec(hit.normal, 0, 0, -1, 0);
}

/* ---- properties --------------------------------------------------------------------- */

/* The part of the ray inside the closed box, in long double; empty if in > out. */
static void reference_slabs(const rt_box *box, const rt_ray *ray, long double *in,
                            long double *out)
{
    const float o[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const float d[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const float lo[3] = {box->min.x, box->min.y, box->min.z};
    const float hi[3] = {box->max.x, box->max.y, box->max.z};
    *in = -INFINITY;
    *out = INFINITY;
    for (int k = 0; k < 3; k++) {
        if (d[k] == 0) {
            if (o[k] < lo[k] || o[k] > hi[k])
                *in = INFINITY;
            continue;
        }
        const long double a = ((long double)lo[k] - o[k]) / d[k];
        const long double b = ((long double)hi[k] - o[k]) / d[k];
        *in = fmaxl(*in, fminl(a, b));
        *out = fminl(*out, fmaxl(a, b));
    }
}

static void test_random_boxes_against_long_double(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 11);
    int counted = 0, hit_count = 0;
    for (int i = 0; i < 300000; i++) {
        const rt_vec3 corner = random_point(&rng, 10.0f), size = random_colour(&rng);
        rt_box box = box_of(0, 0, 0, 0, 0, 0);
        box.min = corner;
        box.max = rt_add(corner, rt_scale(size, 8.0f));
        const rt_vec3 origin = random_point(&rng, 20.0f),
                      about = random_point(&rng, 8.0f);
        const rt_ray ray =
            ray_of(origin, rt_normalize(rt_sub(rt_add(box.min, about), origin)));
        long double in, out;
        reference_slabs(&box, &ray, &in, &out);
        const long double t = in > 0 ? in : out;
        rt_hit hit = untouched;
        const bool is_hit = rt_hit_box(&box, &ray, FLT_MAX, &hit);
        /* at an edge, within rounding, either answer is right */
        if (fabsl(in - out) <= 1e-5L * (1 + fabsl(out)) || fabsl(out) < 1e-6L)
            continue;
        counted++;
        if (is_hit != (in <= out && t > 0))
            fail_msg("ray %d: hit %d, but from %Lg to %Lg", i, is_hit, in, out);
        if (!is_hit)
            continue;
        hit_count++;
        assert_close((hit.t - t) / t, 0, 1.2e-7 * (1 + 20 / (double)t));
        assert_close(rt_length(hit.normal), 1, 0);
        assert_true(rt_dot(hit.normal, ray.direction) < 0);
        const rt_vec3 n = hit.normal, p = hit.point;
        assert_close(fabsf(n.x) + fabsf(n.y) + fabsf(n.z), 1, 0);
        assert_true((n.x != 0 && (p.x == box.min.x || p.x == box.max.x)) ||
                    (n.y != 0 && (p.y == box.min.y || p.y == box.max.y)) ||
                    (n.z != 0 && (p.z == box.min.z || p.z == box.max.z)));
        assert_true(p.x >= box.min.x - 2e-5f && p.x <= box.max.x + 2e-5f);
        assert_true(p.y >= box.min.y - 2e-5f && p.y <= box.max.y + 2e-5f);
        assert_true(p.z >= box.min.z - 2e-5f && p.z <= box.max.z + 2e-5f);
    }
    assert_in_range(counted, 290000, 300000);
    assert_in_range(hit_count, 20000, 200000);
}

static void test_special_numbers_against_long_double(void **state)
{
    /* Every combination of corners, origins and directions that lie on planes, on zero of
     * either sign or among the denormals, of numbers for which float division is exact. */
    (void)state;
    const float sides[][2] = {{-1, 1}, {0, 1}, {-0.0f, 0.0f}, {1, 1}, {-2, -1}};
    const float origins[] = {-2, -1, -0.0f, 0, 1, 2};
    const float directions[] = {-1, -0.0f, 0, 1, 1e-40f, -1e-40f, 2};
    int hit_count = 0, misses = 0;
    for (int i = 0; i < 5 * 5; i++)
        for (int o = 0; o < 6 * 6 * 6; o++)
            for (int d = 0; d < 7 * 7 * 7; d++) {
                const rt_box box = box_of(sides[i % 5][0], sides[i / 5][0], -1,
                                          sides[i % 5][1], sides[i / 5][1], 1);
                const rt_ray ray = ray_of(
                    rt_vec(origins[o % 6], origins[o / 6 % 6], origins[o / 36]),
                    rt_vec(directions[d % 7], directions[d / 7 % 7], directions[d / 49]));
                long double in, out;
                reference_slabs(&box, &ray, &in, &out);
                const long double t = in > 0 ? in : out;
                const bool expected = in <= out && t > 0 && t < (long double)FLT_MAX;
                rt_hit hit = untouched;
                if (rt_hit_box(&box, &ray, FLT_MAX, &hit) != expected)
                    fail_msg("box %d, origin %d, direction %d: expected %d", i, o, d,
                             expected);
                if (expected)
                    assert_close(hit.t / t, 1, 1e-7);
                hit_count += expected;
                misses += !expected;
            }
    assert_true(hit_count > 100000);
    assert_true(misses > 100000);
}

/* ---- bad input ---------------------------------------------------------------------- */

static void test_bad_boxes_and_rays_miss(void **state)
{
    (void)state;
    const float nan = NAN;
    const rt_box good = box_of(-1, -1, -1, 1, 1, 1);
    const rt_box bad[] = {
        box_of(1e-6f, -1, -1, 0, 1, 1), box_of(1, -1, -1, -1, 1, 1),
        box_of(-1, 1, -1, 1, -1, 1),    box_of(-1, -1, 1, 1, 1, -1),
        box_of(nan, -1, -1, 1, 1, 1),   box_of(-1, nan, -1, 1, 1, 1),
        box_of(-1, -1, nan, 1, 1, 1),   box_of(-1, -1, -1, nan, 1, 1),
        box_of(-1, -1, -1, 1, nan, 1),  box_of(-1, -1, -1, 1, 1, nan),
    };
    const rt_vec3 bad_vectors[] = {{nan, 0, 5},      {0, nan, 5},       {0, 0, nan},
                                   {INFINITY, 0, 5}, {0, -INFINITY, 5}, {0, 0, INFINITY}};
    const rt_vec3 origin = {0.1f, 0.2f, 5}, direction = {0, 0, -1},
                  slant = {1e-3f, 1e-3f, -1};
    rt_hit hit;
    for (size_t i = 0; i < COUNT(bad); i++) {
        assert_false(hits(&bad[i], origin, direction, &hit));
        assert_untouched(hit);
        assert_false(hits(&bad[i], origin, slant, &hit));
    }
    for (size_t i = 0; i < COUNT(bad_vectors); i++) {
        assert_false(hits(&good, bad_vectors[i], direction, &hit));
        assert_false(hits(&good, origin, bad_vectors[i], &hit));
        assert_untouched(hit);
    }
    assert_false(hits(&good, origin, rt_vec(0, 0, 0), &hit));
    const rt_ray inside = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, 0));
    assert_false(rt_hit_box(&good, &inside, INFINITY, &hit));
}

static void test_unbounded_boxes_miss(void **state)
{
    (void)state;
    const float inf = INFINITY;
    const rt_box below = box_of(-inf, -inf, -inf, inf, 0, inf);
    rt_hit hit;
    assert_false(hits(&below, rt_vec(1, 5, 2), rt_vec(0.5f, -1, 0), &hit));
    assert_false(hits(&below, rt_vec(1, -5, 2), rt_vec(0.5f, -1, 0), &hit));
    const rt_box largest = box_of(-1, -1, -FLT_MAX, 1, 1, FLT_MAX); /* just bounded */
    assert_true(hits(&largest, rt_vec(5, 0, 0), rt_vec(-1, 0, 0), &hit));
    assert_close(hit.t, 4, 0);
    const rt_box open_below = box_of(-1, -inf, -1, 1, 1, 1);
    const rt_box open_above = box_of(-1, -1, -1, 1, inf, 1);
    assert_false(hits(&open_below, rt_vec(0, 0, 5), rt_vec(0, 0, -1), &hit));
    assert_false(hits(&open_above, rt_vec(0, 0, 5), rt_vec(0, 0, -1), &hit));
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_hit_box_is_rt_hit_box(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 12);
    int count = 0;
    for (int i = 0; i < 200000; i++) {
        const rt_vec3 corner = random_point(&rng, 5.0f), size = random_colour(&rng);
        rt_box box = box_of(0, 0, 0, 0, 0, 0);
        box.min = corner;
        box.max = rt_add(corner, rt_scale(size, 8.0f));
        const rt_vec3 about = random_point(&rng, 4.0f);
        rt_ray ray = ray_of(random_point(&rng, 6.0f), rt_vec(0, 0, 0));
        ray.direction = rt_sub(rt_add(box.min, about), ray.origin);
        if (i % 4 == 0)
            ray.direction.x = 0;
        if (i % 6 == 0)
            ray.direction.z = 0;
        const float t_max = uniform(&rng, 0.0f, 5.0f);
        rt_hit theirs = untouched, ours = untouched;
        const bool is_hit = rt_hit_box(&box, &ray, t_max, &ours);
        assert_int_equal(hit_box(&box, &ray, t_max, &theirs), is_hit);
        assert_close(theirs.t, ours.t, 0);
        assert_vec(theirs.normal, ours.normal.x, ours.normal.y, ours.normal.z, 0);
        assert_vec(theirs.point, ours.point.x, ours.point.y, ours.point.z, 1e-5);
        assert_ptr_equal(theirs.material, ours.material);
        count += is_hit;
    }
    assert_in_range(count, 20000, 180000);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_six_faces),
        cmocka_unit_test(test_slanting),
        cmocka_unit_test(test_from_inside_it_is_the_way_out),
        cmocka_unit_test(test_behind_and_beyond_t_max_are_misses),
        cmocka_unit_test(test_zero_components_of_either_sign),
        cmocka_unit_test(test_edges_and_corners_go_x_before_y_before_z),
        cmocka_unit_test(test_on_a_face),
        cmocka_unit_test(test_flat_and_point_boxes),
        cmocka_unit_test(test_random_boxes_against_long_double),
        cmocka_unit_test(test_special_numbers_against_long_double),
        cmocka_unit_test(test_bad_boxes_and_rays_miss),
        cmocka_unit_test(test_unbounded_boxes_miss),
        cmocka_unit_test(test_demo_hit_box_is_rt_hit_box),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("3 cube", tests, NULL, NULL);
}

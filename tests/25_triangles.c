/* Chapter 16: triangles. */
#define DEMO "../demos/demo16_triangles.c"
#pragma push_macro("rt_hit_triangle") /* yours, if the file that you try has one */
#include "test.h"
#pragma pop_macro("rt_hit_triangle") /* below it is that, or rt.h's, and not the demo's */
#include "exact.h"

/* ---- exact: against numbers that are not rounded -------------------------------------- */

/* Each edge belongs to two triangles, once in each direction, and the outside is outside:
 * otherwise a leak would prove nothing. */
static void test_exact_meshes_are_closed(void **state)
{
    (void)state;
    for (int k = 0; k < EXACT_MESHES; k++) {
        exact_case c = make_exact_case(k);
        double volume = 0;
        uint64_t edges = 0;
        for (int i = 0; i < c.mesh.triangle_count; i++) {
            rt_dvec3 corner[3];
            for (int j = 0; j < 3; j++) {
                const uint32_t p = (uint32_t)c.mesh.indices[3 * i + j];
                const uint32_t q = (uint32_t)c.mesh.indices[3 * i + (j + 1) % 3];
                corner[j] = rt_to_double(rt_sub(rt_corner(&c.mesh, i, j), c.center));
                edges +=
                    p < q ? rt_hash(p + rt_hash(q)) : -(uint64_t)rt_hash(q + rt_hash(p));
            }
            volume += rt_ddot(corner[0], rt_dcross(corner[1], corner[2])) / 6;
        }
        volume /= pow((double)c.size, 3);
        assert_true(edges == 0);
        assert_true(volume > 3.5 && volume <= 8.00001);
        free_mesh(&c.mesh);
    }
}

static void test_exact_numbers(void **state)
{
    /* Three that cancel but for 2^-60, in any order; and a corner on the ray itself. */
    (void)state;
    const double tiny = ldexp(1, -60);
    const double terms[4] = {1, tiny, -1, 3};
    for (int first = 0; first < 4; first++) {
        exact_sum s;
        s.count = 0;
        for (int i = 0; i < 4; i++)
            exact_add(&s, terms[(first + i) % 4]);
        exact_add(&s, -3);
        assert_close(exact_value(&s), tiny, 0);
    }
    const rt_ray ray = {{0.1f, 0.2f, 0.3f}, {0.4f, -0.8f, 1.6f}};
    const rt_vec3 on = {0.1f, 0.2f, 0.3f}, beside = {0.7f, 0.1f, -0.3f};
    assert_int_equal(side_of(&ray, on, beside), 0);
    assert_int_equal(side_of(&ray, beside, beside), 0);
}

/* 0 leaks, 0 triangles missed, 0 hit in error, and t as near as a float can be, even for
 * the rays that are aimed at edges and corners. */
static void test_exact_on_seven_meshes(void **state)
{
    (void)state;
    triangle_function *const way = rt_hit_triangle;
    for (int k = 0; k < EXACT_MESHES; k++) {
        exact_case c = make_exact_case(k);
        exact_count count = {0, 0, 0, 0};
        exact_rays asked = {0, 0};
        judge(&c, 700, &way, 1, &count, &asked);
        if (count.leaks + count.misses + count.hits + count.off > 0)
            fail_msg("%s, %d rays: %d leaks, %d misses, %d hits, %d times t", c.name,
                     asked.rays, count.leaks, count.misses, count.hits, count.off);
        assert_true(asked.rays > 2700);
        assert_true(asked.touching > 100); /* hard ones */
        free_mesh(&c.mesh);
    }
}

/* ---- one triangle, by hand ------------------------------------------------------------ */

static const rt_scene empty; /* all zero */
static const float inf = INFINITY, nan_ = NAN;
static const int one_face[3] = {0, 1, 2};

/* A, B, C counterclockwise as seen from the side of +z. */
static const rt_vec3 plate[3] = {{0, 0, 0}, {4, 0, 0}, {0, 2, 0}};

static rt_mesh mesh_of(const rt_vec3 *corners)
{
    const rt_mesh mesh = {corners, one_face, 3, 1, {{0.5f, 0.25f, 1}, false}};
    return mesh;
}

static rt_scene scene_of(const rt_mesh *meshes, int count)
{
    rt_scene scene = empty;
    scene.meshes = meshes;
    scene.mesh_count = count;
    return scene;
}

/* The coordinates rotated by so many axes, and mirrored if odd is set. */
static rt_vec3 moved_round(rt_vec3 v, int by, bool odd)
{
    const rt_vec3 w = by == 0   ? v
                      : by == 1 ? rt_vec(v.y, v.z, v.x)
                                : rt_vec(v.z, v.x, v.y);
    return odd ? rt_vec(-w.x, -w.y, -w.z) : w;
}

static void test_a_triangle_by_hand(void **state)
{
    /* P = (1, 0.5, 0) is A + 1/4 (B - A) + 1/4 (C - A). From above, from below, askew; along
     * each axis, in both directions. */
    (void)state;
    for (int view = 0; view < 6; view++) {
        rt_vec3 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = moved_round(plate[k], view % 3, view > 2);
        const rt_mesh mesh = mesh_of(corners);
        const struct {
            rt_vec3 from, direction;
            float t;
            bool inside;
        } cases[] = {{{1, 0.5f, 3}, {0, 0, -1}, 3, false},
                     {{1, 0.5f, -3}, {0, 0, 1}, 3, true},
                     {{1, 0.5f, 3}, {0, 0, -4}, 0.75f, false},
                     {{3, -1.5f, 4}, {-1, 1, -2}, 2, false},
                     {{0, 0.5f, -8}, {0.5f, 0, 4}, 2, true}};
        for (size_t i = 0; i < COUNT(cases); i++) {
            const rt_ray ray =
                ray_of(moved_round(cases[i].from, view % 3, view > 2),
                       moved_round(cases[i].direction, view % 3, view > 2));
            const rt_vec3 p = moved_round(rt_vec(1, 0.5f, 0), view % 3, view > 2);
            /* a mirrored triangle turns the other way round */
            const bool inside = cases[i].inside != (view > 2);
            rt_vec3 n = moved_round(rt_vec(0, 0, 1), view % 3, view > 2);
            n = cases[i].inside ? rt_scale(n, -1) : n;
            rt_hit hit = untouched;
            assert_true(rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit));
            assert_close(hit.t, cases[i].t, 0);
            assert_vec(hit.point, p.x, p.y, p.z, 0);
            assert_vec(hit.normal, n.x, n.y, n.z, 0);
            assert_close(hit.u, 0.25, 0);
            assert_close(hit.v, 0.25, 0);
            assert_int_equal(hit.inside, inside);
            assert_int_equal(hit.shape, 0);
            assert_int_equal(hit.part, 0);
            assert_ptr_equal(hit.material, &mesh.material);
        }
    }
}

static void test_the_corners_and_what_u_and_v_are(void **state)
{
    /* At A, B, C; in the middles of the edges; and next to each of them, where it ends. */
    (void)state;
    const rt_mesh mesh = mesh_of(plate);
    const struct {
        float x, y, u, v;
    } in[] = {{0, 0, 0, 0},    {4, 0, 1, 0},       {0, 2, 0, 1},
              {2, 0, 0.5f, 0}, {2, 1, 0.5f, 0.5f}, {0, 1, 0, 0.5f}};
    const float out[][2] = {{2, -1e-6f},    {2, 1.000001f}, {-1e-6f, 1}, {4.000001f, 0},
                            {0, 2.000001f}, {-1e-6f, 0},    {4, 1e-6f},  {3, 1}};
    for (size_t i = 0; i < COUNT(in); i++) {
        const rt_ray ray = ray_of(rt_vec(in[i].x, in[i].y, 2), rt_vec(0, 0, -1));
        rt_hit hit = untouched;
        assert_true(rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit));
        assert_vec(hit.point, in[i].x, in[i].y, 0, 0);
        assert_close(hit.u, in[i].u, 0);
        assert_close(hit.v, in[i].v, 0);
    }
    for (size_t i = 0; i < COUNT(out); i++) {
        const rt_ray ray = ray_of(rt_vec(out[i][0], out[i][1], 2), rt_vec(0, 0, -1));
        rt_hit hit = untouched;
        assert_false(rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit));
        assert_untouched(hit);
    }
}

static void test_winding_says_what_is_inside(void **state)
{
    /* B and C exchanged: everything else is the same, and u is v. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 260);
    int both = 0;
    for (int i = 0; i < 20000; i++) {
        const rt_vec3 corners[3] = {random_point(&rng, 5), random_point(&rng, 5),
                                    random_point(&rng, 5)};
        const rt_vec3 turned[3] = {corners[0], corners[2], corners[1]};
        const rt_mesh a = mesh_of(corners), b = mesh_of(turned);
        const rt_ray ray = random_ray(&rng);
        rt_hit one = untouched, two = untouched;
        const bool found = rt_hit_triangle(&a, 0, &ray, FLT_MAX, &one);
        assert_int_equal(rt_hit_triangle(&b, 0, &ray, FLT_MAX, &two), found);
        if (!found)
            continue;
        both++;
        assert_close(two.t, one.t, 1e-6 * (double)one.t);
        assert_vec(two.point, one.point.x, one.point.y, one.point.z, 1e-5);
        assert_vec(two.normal, one.normal.x, one.normal.y, one.normal.z, 1e-6);
        assert_close(two.u, one.v, 1e-6);
        assert_close(two.v, one.u, 1e-6);
        assert_int_equal(two.inside, !one.inside);
        const rt_vec3 outside =
            rt_cross(rt_sub(corners[1], corners[0]), rt_sub(corners[2], corners[0]));
        if (fabsf(rt_dot(rt_normalize(outside), rt_normalize(ray.direction))) > 1e-4f)
            assert_int_equal(one.inside, rt_dot(outside, ray.direction) > 0);
    }
    assert_true(both > 500);
}

/* t, and how far P is from the plane, from the ray, and from what u and v say. Double has
 * 29 bits more than float: unless the answer depends on the last of them, it is exact. */
static void test_against_cramers_rule_in_double(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 261);
    int hits = 0, wrong = 0;
    double worst_t = 0, worst_p = 0, worst_n = 0, worst_uv = 0;
    for (int i = 0; i < 200000; i++) {
        const float scale = powf(10, uniform(&rng, -3, 4));
        const rt_vec3 middle = random_point(&rng, 10 * scale);
        rt_vec3 corners[3];
        for (int k = 0; k < 3; k++)
            corners[k] = rt_add(middle, random_point(&rng, 4 * scale));
        const rt_mesh mesh = mesh_of(corners);
        const rt_vec3 from = rt_add(middle, random_point(&rng, 30 * scale));
        const rt_vec3 to = rt_add(middle, random_point(&rng, 2 * scale));
        const rt_ray ray = ray_of(from, rt_sub(to, from));
        const rt_dvec3 o = rt_to_double(from), d = rt_to_double(ray.direction);
        const rt_dvec3 a = rt_to_double(corners[0]);
        const rt_dvec3 e = rt_dsub(rt_to_double(corners[1]), a),
                       f = rt_dsub(rt_to_double(corners[2]), a), s = rt_dsub(o, a);
        const rt_dvec3 h = rt_dcross(d, f), q = rt_dcross(s, e);
        const double det = rt_ddot(e, h), u = rt_ddot(s, h) / det,
                     v = rt_ddot(d, q) / det, t = rt_ddot(f, q) / det;
        const bool expected = u >= 0 && v >= 0 && u + v <= 1 && t > 0;
        rt_hit hit = untouched;
        const bool found = rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit);
        if (fabs(u) > 1e-9 && fabs(v) > 1e-9 && fabs(u + v - 1) > 1e-9)
            wrong += found != expected;
        if (!found || !expected)
            continue;
        hits++;
        const double size = fabs(o.x) + fabs(o.y) + fabs(o.z) + 40 * (double)scale;
        const double flat =
            fabs(det) / sqrt(rt_ddot(d, d) * rt_ddot(e, e) * rt_ddot(f, f));
        const rt_dvec3 p = rt_dmad(rt_dmad(a, u, e), v, f);
        const rt_dvec3 off = rt_dsub(rt_to_double(hit.point), p);
        const rt_dvec3 n = rt_dnormalize(rt_dcross(e, f));
        if (flat > 1e-3) {
            worst_t = fmax(worst_t, fabs((double)hit.t - t) / t);
            worst_p = fmax(worst_p, sqrt(rt_ddot(off, off)) / size);
            worst_uv =
                fmax(worst_uv, fmax(fabs((double)hit.u - u), fabs((double)hit.v - v)));
            worst_n = fmax(worst_n, 1 - fabs(rt_ddot(n, rt_to_double(hit.normal))));
        }
        assert_close(rt_length(hit.normal), 1, 1e-6);
        assert_true(rt_dot(hit.normal, ray.direction) <= 0);
        assert_true(hit.u >= 0 && hit.v >= 0 && hit.u + hit.v <= 1.000001f);
    }
    assert_true(hits > 20000);
    assert_int_equal(wrong, 0);
    assert_close(worst_t, 0, 6.1e-8); /* half a rounding of a float */
    assert_close(worst_p, 0, 6.1e-8);
    assert_close(worst_uv, 0, 6.1e-8);
    assert_close(worst_n, 0, 1e-7);
}

static void test_directions_of_any_length(void **state)
{
    /* By a power of two t changes by exactly that, and P, u, v, N not at all. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 262);
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        const rt_vec3 corners[3] = {random_point(&rng, 5), random_point(&rng, 5),
                                    random_point(&rng, 5)};
        const rt_mesh mesh = mesh_of(corners);
        const rt_ray ray = random_ray(&rng);
        rt_hit hit = untouched;
        const bool found = rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit);
        const int powers[] = {-100, -3, 1, 20, 99};
        for (size_t k = 0; k < COUNT(powers); k++) {
            const float scale = ldexpf(1, powers[k]);
            const rt_ray other = ray_of(ray.origin, rt_scale(ray.direction, scale));
            rt_hit same = untouched;
            assert_int_equal(rt_hit_triangle(&mesh, 0, &other, FLT_MAX, &same), found);
            if (!found)
                continue;
            assert_close(same.t * scale, hit.t, 0);
            assert_memory_equal(&same.point, &hit.point, sizeof hit.point);
            assert_memory_equal(&same.normal, &hit.normal, sizeof hit.normal);
            assert_true(same.u == hit.u && same.v == hit.v);
        }
        hits += found;
    }
    assert_true(hits > 500);
    const rt_mesh mesh = mesh_of(plate);
    const rt_ray short_one = ray_of(rt_vec(1, 0.5f, 3), rt_vec(0, 0, -1e-45f)),
                 long_one = ray_of(rt_vec(1, 0.5f, 3), rt_vec(0, 0, -FLT_MAX));
    rt_hit hit = untouched;
    assert_false(rt_hit_triangle(&mesh, 0, &short_one, FLT_MAX, &hit)); /* t 2e45 */
    assert_false(
        rt_hit_triangle(&mesh, 0, &long_one, FLT_MAX, &hit)); /* t below FLT_MIN */
    assert_untouched(hit);
}

static void test_t_is_below_t_max_and_above_0(void **state)
{
    (void)state;
    const rt_mesh mesh = mesh_of(plate);
    const rt_ray ray = ray_of(rt_vec(1, 0.5f, 3), rt_vec(0, 0, -1));
    const float no[] = {3, 2.9999998f, 1, 0, -0.0f, -3, -inf, nan_};
    const float yes[] = {3.0000002f, 4, FLT_MAX, inf};
    rt_hit hit = untouched;
    for (size_t i = 0; i < COUNT(no); i++)
        assert_false(rt_hit_triangle(&mesh, 0, &ray, no[i], &hit));
    assert_untouched(hit);
    for (size_t i = 0; i < COUNT(yes); i++) {
        assert_true(rt_hit_triangle(&mesh, 0, &ray, yes[i], &hit));
        assert_close(hit.t, 3, 0);
    }
    hit = untouched;
    const float z[] = {0, -0.0f, -1e-30f, -3,
                       1e-45f}; /* on it, behind it; t a denormal */
    for (size_t i = 0; i < COUNT(z); i++) {
        const rt_ray other = ray_of(rt_vec(1, 0.5f, z[i]), rt_vec(0, 0, -1));
        assert_false(rt_hit_triangle(&mesh, 0, &other, FLT_MAX, &hit));
    }
    assert_untouched(hit);
    const rt_ray near_it = ray_of(rt_vec(1, 0.5f, 2e-38f), rt_vec(0, 0, -1));
    assert_true(rt_hit_triangle(&mesh, 0, &near_it, FLT_MAX, &hit));
}

/* ---- what is no triangle, and no ray -------------------------------------------------- */

static void test_without_area_there_is_nothing(void **state)
{
    /* A point, and a line: aimed at from everywhere. Half of the corners are random numbers, so
     * that what the ray sees of the line is rounded. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 263);
    for (int i = 0; i < 60000; i++) {
        const bool whole = i % 2 == 0;
        const rt_vec3 a = random_point(&rng, 5);
        const rt_vec3 start = whole ? rt_vec(floorf(a.x), floorf(a.y), floorf(a.z)) : a;
        const rt_vec3 way = rt_vec(floorf(9 * rt_random(&rng)) - 4, 2, 1);
        const float along[3] = {0, (float)(i % 5), (float)(i % 3)};
        rt_vec3 corners[3];
        for (int k = 0; k < 3; k++) /* with whole numbers exactly on a line */
            corners[k] = whole        ? rt_add(start, rt_scale(way, along[k]))
                         : i % 4 == 1 ? start
                         : k == 0     ? start
                                      : rt_add(start, way); /* two of them are equal */
        const rt_mesh mesh = mesh_of(corners);
        const rt_vec3 from = random_point(&rng, 12);
        const rt_vec3 aim =
            rt_add(corners[0], rt_scale(rt_sub(corners[1], corners[0]), rt_random(&rng)));
        const rt_ray ray = ray_of(from, rt_sub(aim, from));
        rt_hit hit = untouched;
        assert_false(rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit));
        assert_untouched(hit);
        const rt_scene scene = scene_of(&mesh, 1);
        assert_false(rt_intersect(&scene, &ray, &hit));
        assert_false(rt_occluded(&scene, &ray, FLT_MAX));
    }
}

static void test_slivers(void **state)
{
    /* As thin as floats can be: a hit, if there is one, is finite and makes sense. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 264);
    int hits = 0;
    for (int i = 0; i < 60000; i++) {
        const rt_vec3 a = random_point(&rng, 5), b = random_point(&rng, 5);
        const float part = rt_random(&rng);
        const rt_vec3 corners[3] = {a, b, rt_add(a, rt_scale(rt_sub(b, a), part))};
        const rt_mesh mesh = mesh_of(corners);
        const rt_vec3 from = random_point(&rng, 12);
        const rt_vec3 aim = rt_scale(rt_add(rt_add(a, b), corners[2]), 1 / 3.0f);
        const rt_ray ray = ray_of(from, rt_sub(aim, from));
        rt_hit hit = untouched;
        if (!rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit)) {
            assert_untouched(hit);
            continue;
        }
        hits++;
        assert_close(rt_length(hit.normal), 1, 1e-5);
        assert_true(hit.t > 0 && hit.t <= FLT_MAX && hit.u >= 0 && hit.v >= 0 &&
                    hit.u + hit.v <= 1.00001f);
        const rt_scene scene = scene_of(&mesh, 1);
        assert_true(rt_intersect(&scene, &ray, &hit));
        assert_vec(rt_cross(rt_sub(hit.point, a), rt_normalize(rt_sub(b, a))), 0, 0, 0,
                   1e-4);
    }
    assert_true(hits > 100);
}

static void test_from_the_edge_there_is_nothing_to_see(void **state)
{
    (void)state;
    const rt_mesh mesh = mesh_of(plate);
    const rt_ray rays[] = {{{-1, 0.5f, 0}, {1, 0, 0}},     {{1, 9, 0}, {0, -1, 0}},
                           {{-1, -1, 0}, {2, 1.5f, 0}},    {{1, 0.5f, 0}, {1, 1, 0}},
                           {{-1, 0, 0}, {1, 0, 0}},        {{5, -0.5f, 0}, {-4, 2, 0}},
                           {{1, 0.5f, 0}, {-3, -1.5f, 0}}, {{0, -3, 0}, {0, 1, 0}}};
    rt_hit hit = untouched;
    for (size_t i = 0; i < COUNT(rays); i++) {
        assert_false(rt_hit_triangle(&mesh, 0, &rays[i], FLT_MAX, &hit));
        assert_untouched(hit);
    }
}

/* Rays in the planes of triangles, all in whole numbers: where rounding gives them an
 * area, the ray must still meet the box around the triangle. (But the place on it is
 * rounding, so one that lies behind may seem to lie ahead, once in 40 000 times.) */
static void test_nothing_is_met_far_out_in_its_plane(void **state)
{
    (void)state;
    const rt_vec3 slanting[3] = {{-3, -1, 2}, {-1, -1, -4}, {-2, -3, 3}};
    const rt_mesh seen = mesh_of(slanting);
    const rt_ray along = {{-3, -2, 4}, {-1, 4, -5}};
    rt_hit hit = untouched;
    assert_false(rt_hit_triangle(&seen, 0, &along, FLT_MAX, &hit));
    rt_rng rng = rt_rng_start(0, 0, 276);
    int hits = 0, far_out = 0;
    for (int i = 0; i < 500000; i++) {
        float n[13];
        for (int k = 0; k < 13; k++)
            n[k] = floorf(9 * rt_random(&rng)) - 4;
        const rt_vec3 A = rt_vec(n[0], n[1], n[2]), e = rt_vec(n[3], n[4], n[5]);
        const rt_vec3 f = rt_vec(n[6], n[7], n[8]);
        const rt_vec3 corners[3] = {A, rt_add(A, e), rt_add(A, f)};
        const rt_mesh mesh = mesh_of(corners);
        const rt_ray ray =
            ray_of(rt_add(A, rt_add(rt_scale(e, n[9]), rt_scale(f, n[10]))),
                   rt_add(rt_scale(e, n[11]), rt_scale(f, n[12])));
        if (!rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit))
            continue;
        rt_box box = {{A.x, A.y, A.z}, {A.x, A.y, A.z}, {{0, 0, 0}, false}};
        for (int k = 0; k < 3; k++) {
            const rt_vec3 c = corners[k], more = rt_vec(0.001f, 0.001f, 0.001f);
            const rt_vec3 low = rt_sub(c, more), high = rt_add(c, more);
            box.min = rt_vec(fminf(box.min.x, low.x), fminf(box.min.y, low.y),
                             fminf(box.min.z, low.z));
            box.max = rt_vec(fmaxf(box.max.x, high.x), fmaxf(box.max.y, high.y),
                             fmaxf(box.max.z, high.z));
        }
        far_out += !rt_hit_box(&box, &ray, FLT_MAX, &hit);
        hits++;
    }
    assert_true(hits > 1000 && far_out < hits / 1000);
}

static void test_what_is_not_finite_misses(void **state)
{
    (void)state;
    const float bad[] = {nan_, inf, -inf};
    rt_hit hit = untouched;
    for (int place = 0; place < 15; place++)
        for (size_t i = 0; i < COUNT(bad); i++) {
            float numbers[15] = {1, 0.5f, 3, 0.1f, 0.1f, -1, 0, 0, 0, 4, 0, 0, 0, 2, 0};
            numbers[place] = bad[i];
            const float *f = numbers + 6;
            const rt_ray ray = ray_of(rt_vec(numbers[0], numbers[1], numbers[2]),
                                      rt_vec(numbers[3], numbers[4], numbers[5]));
            const rt_vec3 corners[3] = {rt_vec(f[0], f[1], f[2]),
                                        rt_vec(f[3], f[4], f[5]),
                                        rt_vec(f[6], f[7], f[8])};
            const rt_mesh mesh = mesh_of(corners);
            assert_false(rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit));
        }
    const rt_mesh mesh = mesh_of(plate);
    const rt_ray nowhere = ray_of(rt_vec(1, 0.5f, 0), rt_vec(0, 0, 0));
    assert_false(rt_hit_triangle(&mesh, 0, &nowhere, FLT_MAX, &hit));
    const rt_ray away = ray_of(rt_vec(1, 0.5f, 3), rt_vec(0, 0, 0));
    assert_false(rt_hit_triangle(&mesh, 0, &away, FLT_MAX, &hit));
    assert_untouched(hit);
}

static void test_huge_and_tiny_is_the_same(void **state)
{
    /* All lengths times 2^50, about 1e15, or 2^-100, about 1e-30: all results scale
     * likewise. */
    (void)state;
    const int powers[] = {-110, -100, -40, 30, 50};
    rt_rng rng = rt_rng_start(0, 0, 265);
    int hits = 0;
    for (int i = 0; i < 20000; i++) {
        const rt_vec3 corners[3] = {random_point(&rng, 1), random_point(&rng, 1),
                                    random_point(&rng, 1)};
        const rt_mesh mesh = mesh_of(corners);
        const rt_vec3 from = random_point(&rng, 1);
        const rt_ray ray = ray_of(from, random_direction(&rng));
        rt_hit hit = untouched;
        const bool found = rt_hit_triangle(&mesh, 0, &ray, FLT_MAX, &hit);
        hits += found;
        for (size_t k = 0; k < COUNT(powers); k++) {
            const float scale = ldexpf(1, powers[k]);
            rt_vec3 other[3];
            for (int c = 0; c < 3; c++)
                other[c] = rt_scale(corners[c], scale);
            const rt_mesh large = mesh_of(other);
            const rt_ray ray2 = ray_of(rt_scale(from, scale), ray.direction);
            rt_hit same = untouched;
            assert_int_equal(rt_hit_triangle(&large, 0, &ray2, FLT_MAX, &same), found);
            if (!found)
                continue;
            const rt_vec3 p = rt_scale(hit.point, scale);
            assert_close(same.t, hit.t * scale, 0);
            assert_vec(same.point, p.x, p.y, p.z, 0);
            assert_memory_equal(&same.normal, &hit.normal, sizeof hit.normal);
            assert_true(same.u == hit.u && same.v == hit.v && same.inside == hit.inside);
        }
    }
    assert_true(hits > 500);
}

/* ---- in a scene ----------------------------------------------------------------------- */

/* A wall as a custom shape at z = -4. */
static bool hit_wall(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    (void)data;
    const float t = (-4 - ray->origin.z) / ray->direction.z;
    hit->t = t;
    hit->point = rt_vec(ray->origin.x + t * ray->direction.x,
                        ray->origin.y + t * ray->direction.y, -4);
    hit->normal = rt_vec(0, 0, 1);
    hit->part = 5;
    return t > 0 && t < t_max;
}

static void with_and_without_tree(rt_scene *scene, const rt_ray *ray, bool expected,
                                  int shape, int part)
{
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(scene, &bvh), RT_OK);
    for (int tree = 0; tree < 2; tree++) {
        scene->bvh = tree ? &bvh : NULL;
        rt_hit hit = untouched;
        assert_int_equal(rt_intersect(scene, ray, &hit), expected);
        assert_int_equal(rt_occluded(scene, ray, FLT_MAX), expected);
        if (!expected)
            continue;
        assert_int_equal(hit.shape, shape);
        assert_int_equal(hit.part, part);
        assert_false(rt_occluded(scene, ray, hit.t));
        assert_true(rt_occluded(scene, ray, nextafterf(hit.t, FLT_MAX)));
    }
    scene->bvh = NULL;
    rt_free_bvh(&bvh);
}

static void test_of_several_in_one_place_the_first_wins(void **state)
{
    /* All of them are met at t = 4. One after the other is taken away; the numbers of the rest
     * move up. */
    (void)state;
    const rt_sphere sphere = {{0, 0, -5}, 1, {{1, 1, 1}, false}};
    const rt_box box = {{-1, -1, -6}, {1, 1, -4}, {{1, 1, 1}, false}};
    const rt_vec3 corners[4] = {{-9, -9, -4}, {9, -9, -4}, {0, 9, -4}, {0, 0, -9}};
    const int faces[] = {0, 1, 3, 0, 1, 2, 0, 1, 2}; /* the first of them is elsewhere */
    const rt_mesh meshes[2] = {{corners, faces, 4, 3, {{1, 1, 1}, false}},
                               {corners, faces + 3, 4, 2, {{1, 1, 1}, false}}};
    const rt_custom_shape walls[2] = {
        {{-9, -9, -4}, {9, 9, -4}, {{1, 1, 1}, false}, hit_wall, NULL},
        {{-9, -9, -4}, {9, 9, -4}, {{1, 1, 1}, false}, hit_wall, NULL}};
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    for (int kinds = 0; kinds < 32; kinds++) { /* which of the kinds are there */
        rt_scene scene = empty;
        scene.spheres = &sphere;
        scene.sphere_count = kinds & 1;
        scene.boxes = &box;
        scene.box_count = kinds >> 1 & 1;
        scene.meshes = kinds & 4 ? meshes : meshes + 1;
        scene.mesh_count = (kinds >> 2 & 1) + (kinds >> 3 & 1);
        scene.custom_shapes = walls;
        scene.custom_shape_count = 2 * (kinds >> 4 & 1);
        const int part = kinds & 3 ? 0 : kinds & 4 ? 1 : kinds & 8 ? 0 : 5;
        with_and_without_tree(&scene, &ray, kinds != 0, 0, part);
    }
}

static void test_how_shapes_are_counted(void **state)
{
    /* Two spheres, a box, three meshes of which the second is empty, two walls of one's own, side
     * by side: each finds its number, its surface and its material. */
    (void)state;
    const rt_sphere spheres[2] = {{{0, 0, -5}, 1, {{0.1f, 0, 0}, false}},
                                  {{4, 0, -5}, 1, {{0.2f, 0, 0}, false}}};
    const rt_box box = {{7, -1, -6}, {9, 1, -4}, {{0.3f, 0, 0}, false}};
    rt_mesh meshes[3] = {
        make_icosphere(1), {NULL, NULL, 0, 0, {{0.5f, 0, 0}, false}}, make_icosphere(0)};
    place_mesh(&meshes[0], rt_vec(12, 0, -5), 1, 0);
    place_mesh(&meshes[2], rt_vec(16, 0, -5), 1, 0);
    meshes[0].material.albedo.x = 0.4f;
    meshes[2].material.albedo.x = 0.6f;
    const rt_custom_shape walls[2] = {
        {{19, -1, -4}, {21, 1, -4}, {{0.7f, 0, 0}, false}, hit_wall, NULL},
        {{23, -1, -4}, {25, 1, -4}, {{0.8f, 0, 0}, false}, hit_wall, NULL}};
    rt_surface surfaces[8];
    memset(surfaces, 0, sizeof surfaces);
    rt_scene scene = empty;
    scene.spheres = spheres;
    scene.sphere_count = 2;
    scene.boxes = &box;
    scene.box_count = 1;
    scene.meshes = meshes;
    scene.mesh_count = 3;
    scene.custom_shapes = walls;
    scene.custom_shape_count = 2;
    scene.surfaces = surfaces;
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    const int numbers[] = {0, 1, 2, 3, 5, 6, 7};
    for (int tree = 0; tree < 2; tree++)
        for (int i = 0; i < 7; i++) {
            const rt_ray ray =
                ray_of(rt_vec(4 * (float)i, 0.1f, 0), rt_vec(0, 0.01f, -1));
            rt_hit hit = untouched;
            scene.bvh = tree ? &bvh : NULL;
            assert_true(rt_intersect(&scene, &ray, &hit));
            assert_int_equal(hit.shape, numbers[i]);
            assert_ptr_equal(rt_surface_of(&scene, &hit), &surfaces[numbers[i]]);
            assert_close(hit.material->albedo.x, 0.1 * (numbers[i] + 1), 1e-7);
            assert_false(rt_is_inside(&scene, &hit));
            if (i < 3) /* nothing of part two */
                assert_true(hit.part == 0 && hit.u == 0 && hit.v == 0 && !hit.inside);
            if (i == 3 || i == 4) {
                const rt_mesh *mesh = &meshes[numbers[i] - 3];
                rt_hit same = untouched;
                assert_true(rt_hit_triangle(mesh, hit.part, &ray, FLT_MAX, &same));
                assert_close(hit.t, same.t, 0);
            }
        }
    scene.bvh = NULL;
    rt_free_bvh(&bvh);
    free_mesh(&meshes[0]);
    free_mesh(&meshes[2]);
}

/* Corners of a tetrahedron, so 70 degrees between its faces; or, flat, less. */
static rt_mesh make_tetrahedron(float flat)
{
    growing_mesh m = new_mesh(4, 4);
    for (int k = 0; k < 4; k++)
        add_corner(&m, k < 2 ? 1 : -1, k % 2 ? -(double)flat : (double)flat,
                   k == 0 || k == 3 ? 1 : -1);
    add_triangle(&m, 0, 1, 2);
    add_triangle(&m, 0, 3, 1);
    add_triangle(&m, 0, 2, 3);
    add_triangle(&m, 1, 3, 2);
    return finished_mesh(m);
}

/* A pot with thick walls, open above. */
static rt_mesh make_pot(void)
{
    static const double profile[9][2] = {{0, -1},    {0.6, -1},   {1, -0.4},
                                         {0.9, 0.4}, {0.7, 0.7},  {0.6, 0.65},
                                         {0.8, 0.3}, {0.8, -0.4}, {0, -0.8}};
    return make_lathe(profile, 9, 24);
}

/* The closed meshes of the tests that follow, and a point in each of them. */
typedef struct closed_mesh {
    const char *name;
    rt_mesh mesh;
    rt_vec3 in;
    float size; /* about its radius */
    bool convex;
} closed_mesh;

enum { CLOSED = 12 };

static closed_mesh make_closed(int kind)
{
    static const char *const names[CLOSED] = {"icosphere",
                                              "icosphere, small",
                                              "icosphere, far away",
                                              "icosahedron",
                                              "cube",
                                              "cube of cells",
                                              "tetrahedron",
                                              "tetrahedron, far away",
                                              "flat wedge",
                                              "thin slivers",
                                              "pot",
                                              "star"};
    closed_mesh c;
    c.name = names[kind];
    c.in = rt_vec(0, 0, 0);
    c.size = 1;
    c.convex = kind < 10;
    c.mesh = kind <= 2    ? make_icosphere(3)
             : kind == 3  ? make_icosphere(0)
             : kind <= 5  ? make_cells(kind == 4 ? 1 : 12, is_any_cell)
             : kind <= 8  ? make_tetrahedron(kind == 8 ? 0.3f : 1)
             : kind == 9  ? make_globe(6, 200)
             : kind == 10 ? make_pot()
                          : make_icosphere(2);
    if (kind == 1)
        place_mesh(&c.mesh, c.in, c.size = 1e-3f, 0);
    if (kind == 2)
        place_mesh(&c.mesh, c.in = rt_vec(1000, -500, 2000), 1, 0);
    if (kind == 7)
        place_mesh(&c.mesh, c.in = rt_vec(100, 50, -70), c.size = 30, 0);
    if (kind == 10)
        c.in = rt_vec(0, -0.9f, 0); /* in its bottom */
    if (kind == 11)
        place_mesh(&c.mesh, c.in, 1, 0.9f);
    return c;
}

static rt_scene with_tree(const rt_mesh *mesh, rt_bvh *bvh)
{
    rt_scene scene = scene_of(mesh, 1);
    assert_int_equal(rt_build_bvh(&scene, bvh), RT_OK);
    scene.bvh = bvh;
    return scene;
}

static void test_the_meshes_are_closed(void **state)
{
    /* From the point in each of them, every ray meets its inside; from outside, its outside. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 266);
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k);
        rt_bvh bvh;
        const rt_scene scene = with_tree(&c.mesh, &bvh);
        for (int i = 0; i < 500; i++) {
            const rt_vec3 d = random_direction(&rng);
            const rt_ray out = ray_of(c.in, d),
                         in = ray_of(rt_add(c.in, rt_scale(d, 4 * c.size)),
                                     rt_scale(d, -1));
            rt_hit hit = untouched;
            assert_true(rt_intersect(&scene, &out, &hit) && hit.inside);
            assert_true(rt_is_inside(&scene, &hit));
            assert_true(rt_intersect(&scene, &in, &hit) && !hit.inside);
        }
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
    }
}

/* A direction from the point of this hit: by chance, as in a mirror, or to a point of an
 * edge or a corner, which random numbers never hit. */
static rt_vec3 way_on(const rt_mesh *mesh, const rt_hit *hit, rt_vec3 from, int how,
                      rt_rng *rng)
{
    const float r1 = rt_random(rng);
    const float r2 = rt_random(rng);
    if (how == 1)
        return rt_reflect(from, hit->normal);
    if (how == 2) {
        const int triangle = (int)(r1 * (float)mesh->triangle_count), k = (int)(3 * r2);
        const float part = fmaxf(0, rt_random(rng) * 1.1f - 0.1f);
        const rt_vec3 a = rt_corner(mesh, triangle, k),
                      b = rt_corner(mesh, triangle, (k + 1) % 3);
        const rt_vec3 d =
            rt_sub(rt_add(rt_scale(a, 1 - part), rt_scale(b, part)), hit->point);
        if (rt_dot(d, hit->normal) > 1e-3f * rt_length(d))
            return rt_normalize(d);
    }
    return rt_sample_cosine(hit->normal, r1, r2);
}

static void test_no_path_leaves_a_closed_mesh(void **state)
{
    /* 1.3 million bounces. In a mesh that is not convex, a ray that is aimed at an edge
     * may touch it from inside; either answer would be good, so no ray is aimed. */
    (void)state;
    enum { BOUNCES = 40000 };
    rt_rng rng = rt_rng_start(0, 0, 267);
    int leaks = 0, bounces = 0;
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k);
        rt_bvh bvh;
        const rt_scene scene = with_tree(&c.mesh, &bvh);
        for (int how = 0; how < (c.convex ? 3 : 2); how++) {
            rt_ray ray = ray_of(c.in, random_direction(&rng));
            int lost = 0;
            for (int i = 0; i < BOUNCES; i++, bounces++) {
                rt_hit hit = untouched;
                if (!rt_intersect(&scene, &ray, &hit) || !hit.inside) {
                    lost++;
                    ray = ray_of(c.in, random_direction(&rng));
                    continue;
                }
                ray.direction = way_on(&c.mesh, &hit, ray.direction, how, &rng);
                ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
                if (i % 1000 == 999) /* a mirror's path may go round and round */
                    ray = ray_of(c.in, random_direction(&rng));
            }
            if (lost > 0)
                print_message("%s: %d of %d bounces left it\n", c.name, lost, BOUNCES);
            leaks += lost;
        }
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
    }
    assert_true(bounces > 1300000);
    assert_int_equal(leaks, 0);
}

static void test_no_ray_meets_the_triangle_that_it_leaves(void **state)
{
    /* From 3 to 300 radii away. What leaves a convex mesh meets nothing; what goes in meets the
     * inside of another triangle, or of its own neighbourhood, at t > 0. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 268);
    int left = 0, wrong = 0;
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k);
        rt_bvh bvh;
        const rt_scene scene = with_tree(&c.mesh, &bvh);
        for (int i = 0; i < 4000; i++) {
            const float away = c.size * (i % 2 ? 3.0f : 300.0f) * uniform(&rng, 0.9f, 1);
            const rt_vec3 from = rt_add(c.in, rt_scale(random_direction(&rng), away));
            const rt_vec3 aim = rt_add(c.in, random_point(&rng, 0.7f * c.size));
            rt_ray ray = ray_of(from, rt_normalize(rt_sub(aim, from)));
            rt_hit hit = untouched, next = untouched;
            if (!rt_intersect(&scene, &ray, &hit) || hit.inside)
                continue;
            const rt_vec3 out = way_on(&c.mesh, &hit, ray.direction, i / 2 % 3, &rng);
            for (int in = 0; in < 2; in++) {
                const rt_vec3 d = in ? rt_scale(out, -1) : out;
                ray = ray_of(rt_leave(hit.point, hit.normal, d), d);
                const bool found = rt_intersect(&scene, &ray, &next);
                left++;
                wrong += found && next.part == hit.part;
                if (in)
                    wrong += !found || !next.inside;
                else if (c.convex)
                    wrong += found;
            }
        }
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
        if (wrong > 0)
            fail_msg("%s: %d of %d rays", c.name, wrong, left);
    }
    assert_true(left > 50000);
}

static void test_the_tree_finds_what_the_loop_finds(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 269);
    int hits = 0;
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k), d = make_closed((k + 5) % CLOSED);
        place_mesh(&d.mesh, rt_vec(0.3f, 0, 0), 0.8f, 0.1f);
        const rt_mesh both[2] = {c.mesh, d.mesh};
        rt_scene scene = scene_of(both, 2);
        rt_bvh bvh;
        assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
        for (int i = 0; i < 600; i++) {
            const rt_vec3 from = rt_add(c.in, random_point(&rng, 3 * c.size));
            const rt_vec3 to = i % 3 ? rt_add(c.in, random_point(&rng, c.size))
                                     : c.mesh.positions[i % c.mesh.position_count];
            rt_ray ray = ray_of(from, rt_sub(to, from));
            if (i % 7 == 0)
                ray.direction = rt_vec(0, i % 2 ? 1 : -1, 0);
            const float t_max = 2 * rt_random(&rng);
            rt_hit one, two;
            memset(&one, 0, sizeof one);
            memset(&two, 0, sizeof two);
            scene.bvh = NULL;
            const bool found = rt_intersect(&scene, &ray, &one);
            const bool hidden = rt_occluded(&scene, &ray, t_max);
            scene.bvh = &bvh;
            assert_int_equal(rt_intersect(&scene, &ray, &two), found);
            assert_int_equal(rt_occluded(&scene, &ray, t_max), hidden);
            assert_int_equal(hidden, found && one.t < t_max);
            assert_memory_equal(&one.point, &two.point, sizeof one.point);
            assert_memory_equal(&one.normal, &two.normal, sizeof one.normal);
            assert_true(one.t == two.t && one.shape == two.shape &&
                        one.part == two.part && one.u == two.u && one.v == two.v &&
                        one.inside == two.inside && one.material == two.material);
            hits += found;
        }
        scene.bvh = NULL;
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
        free_mesh(&d.mesh);
    }
    assert_true(hits > 2000);
}

/* ---- light ---------------------------------------------------------------------------- */

static void test_a_furnace_of_triangles(void **state)
{
    /* Within a closed mesh whose walls send E and reflect rho, the n-th bounce brings E
     * rho^n, and the ray after the last one still looks. All paths bring the same,
     * without noise, if none gets out and none is lost. */
    (void)state;
    const int bounces[] = {0, 1, 5, 40};
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k);
        c.mesh.material.albedo = rt_vec(0.8f, 0.5f, 1);
        const rt_surface glow = {.emission = {1, 2, 0.25f}};
        rt_bvh bvh;
        rt_scene scene = with_tree(&c.mesh, &bvh);
        scene.surfaces = &glow;
        scene.background = rt_vec(1e6f, 1e6f, 1e6f); /* a leak would be seen */
        for (uint32_t i = 0; i < 400; i++) {
            rt_rng rng = rt_rng_start(i, (uint32_t)k, 270);
            const int n = bounces[i % COUNT(bounces)];
            const rt_ray ray = ray_of(c.in, random_direction(&rng));
            const rt_vec3 seen = rt_radiance_mis(&scene, &ray, n, &rng);
            assert_close(seen.x, (1 - pow(0.8, n + 2)) / 0.2, 1e-4);
            assert_close(seen.y, 2 * (1 - pow(0.5, n + 2)) / 0.5, 1e-4);
            assert_close(seen.z, 0.25 * (n + 2), 1e-4);
        }
        scene.surfaces = NULL;
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
    }
}

/* Points of the mesh, equally likely per area, and a direction by the cosine from each: how many
 * of these rays arrive at the other mesh? *area is the mesh's. */
static double sent(const rt_scene *scene, int from, int to, int count, double *area)
{
    const rt_mesh *mesh = &scene->meshes[from];
    double sums[400];
    assert_true(mesh->triangle_count <= (int)COUNT(sums));
    *area = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        const rt__corners corners = rt__corners_of(mesh, i);
        const rt_dvec3 n = rt__across(&corners);
        sums[i] = *area += 0.5 * sqrt(rt_ddot(n, n));
    }
    double arrived = 0;
    for (int i = 0; i < count; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, (uint32_t)from, 271);
        const double pick = (double)rt_random(&rng) * *area;
        int t = 0;
        while (sums[t] < pick && t < mesh->triangle_count - 1)
            t++;
        const float root = sqrtf(rt_random(&rng));
        const float v = root * rt_random(&rng);
        const rt__corners corners = rt__corners_of(mesh, t);
        rt_hit hit = untouched;
        hit.point =
            rt__blend(&corners, rt_dvec(1 - (double)root, (double)(root - v), (double)v));
        hit.normal = rt_to_float(rt_dnormalize(rt__across(&corners)));
        const rt_vec3 d = way_on(mesh, &hit, hit.normal, 0, &rng);
        const rt_ray ray = ray_of(rt_leave(hit.point, hit.normal, d), d);
        arrived += rt_intersect(scene, &ray, &hit) && hit.shape == to;
    }
    return arrived;
}

static void test_reciprocity_of_meshes(void **state)
{
    /* What a sends to b, b sends to a, with something in between: area times the part that
     * arrives is the same both ways. */
    (void)state;
    enum { N = 200000 };
    rt_mesh meshes[3] = {make_pot(), make_icosphere(1), make_tetrahedron(1)};
    place_mesh(&meshes[1], rt_vec(1, 2, -1), 0.8f, 0.2f);
    place_mesh(&meshes[2], rt_vec(0.6f, 1.1f, -0.4f), 0.2f, 0);
    rt_scene scene = scene_of(meshes, 3);
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    scene.bvh = &bvh;
    double a, b;
    const double there = sent(&scene, 0, 1, N, &a), back = sent(&scene, 1, 0, N, &b);
    const double sigma = sqrt(1 / there + 1 / back);
    assert_true(sigma < 0.03);
    assert_close(there * a / (back * b), 1, 4 * sigma);
    scene.bvh = NULL;
    rt_free_bvh(&bvh);
    for (int i = 0; i < 3; i++)
        free_mesh(&meshes[i]);
}

static rt_vec3 smooth_sky(const void *data, rt_vec3 d)
{
    (void)data;
    return rt_vec(0.5f + 0.4f * d.x, 0.5f + 0.4f * d.y, 0.5f + 0.4f * d.z);
}

enum { W = 32, H = 24 };

/* The picture of a scene from (0, 0, 0) towards -z; returns its mean, too. */
static rt_vec3 picture_of(const rt_scene *scene, int bounces, int samples,
                          rt_image *image)
{
    const rt_camera camera = {.fov_y = 40};
    const rt_options options = {.samples = samples, .bounces = bounces};
    rt_vec3 sum = {0, 0, 0};
    *image = new_image(W, H);
    assert_int_equal(rt_render(scene, &camera, &options, image), RT_OK);
    for (int i = 0; i < W * H; i++)
        sum = rt_add(sum, image->pixels[i]);
    return rt_scale(sum, 1.0f / (W * H));
}

/* The root of the mean square of their differences. */
static double difference(const rt_image *a, const rt_image *b)
{
    double squares = 0;
    for (int i = 0; i < W * H; i++) {
        const rt_vec3 d = rt_sub(a->pixels[i], b->pixels[i]);
        squares += (double)rt_dot(d, d);
    }
    return sqrt(squares / (W * H));
}

static void test_a_ball_of_triangles_is_a_ball(void **state)
{
    /* Of glass, of coloured glass, matt, a mirror: a sphere, and 20480 triangles. Glass
     * that takes outside for inside makes another picture. */
    (void)state;
    const rt_surface kinds[] = {{.eta = 1.5f},
                                {.eta = 1.5f, .absorption = {2, 0.5f, 0.1f}},
                                {.shininess = 20},
                                {.eta = 0}};
    rt_mesh mesh = make_icosphere(5);
    place_mesh(&mesh, rt_vec(0, 0, -4), 1, 0);
    for (int kind = 0; kind < 5; kind++) {
        const rt_light light = {{3, 4, 0}, {20, 20, 20}};
        rt_sphere sphere = {{0, 0, -4}, 1, {{0.9f, 0.5f, 0.7f}, kind == 4}};
        rt_scene scene = empty;
        scene.sky = smooth_sky;
        scene.lights = &light;
        scene.light_count = 1;
        scene.surfaces = kind < 4 ? &kinds[kind] : NULL;
        rt_scene of_mesh = scene;
        scene.spheres = &sphere;
        scene.sphere_count = 1;
        mesh.material = sphere.material;
        of_mesh.meshes = &mesh;
        of_mesh.mesh_count = 1;
        rt_image a, b;
        const rt_vec3 one = picture_of(&scene, 12, 16, &a),
                      two = picture_of(&of_mesh, 12, 16, &b);
        const double rms = difference(&a, &b);
        assert_vec(two, one.x, one.y, one.z, 2e-3);
        if (!(rms < 0.02))
            fail_msg("kind %d: rms %g", kind, rms);
        free(b.pixels);
        if (kind < 2) { /* inside out */
            int *indices = (int *)(uintptr_t)mesh.indices;
            for (int turn = 0; turn < 2; turn++) {
                for (int i = 0; i < mesh.triangle_count; i++) {
                    const int c = indices[3 * i + 1];
                    indices[3 * i + 1] = indices[3 * i + 2];
                    indices[3 * i + 2] = c;
                }
                picture_of(&of_mesh, 12, 16, &b);
                assert_int_equal(difference(&a, &b) > 0.05, turn == 0);
                free(b.pixels);
            }
        }
        free(a.pixels);
    }
    free_mesh(&mesh);
}

static void test_clear_glass_vanishes_in_an_even_light(void **state)
{
    /* Reflected or not, every ray ends in the same light, however often it meets an edge: half
     * of the rays are aimed next to corners. */
    (void)state;
    const rt_surface glass = {.eta = 1.5f};
    for (int k = 0; k < CLOSED; k++) {
        closed_mesh c = make_closed(k);
        rt_bvh bvh;
        rt_scene scene = with_tree(&c.mesh, &bvh);
        scene.surfaces = &glass;
        scene.background = rt_vec(1, 1, 1);
        for (uint32_t i = 0; i < 1500; i++) {
            rt_rng rng = rt_rng_start(i, (uint32_t)k, 272);
            const rt_vec3 from =
                rt_add(c.in, rt_scale(random_direction(&rng), 9 * c.size));
            const rt_vec3 corner = c.mesh.positions[i % (uint32_t)c.mesh.position_count];
            const rt_vec3 aim = i % 2
                                    ? rt_add(c.in, random_point(&rng, c.size))
                                    : rt_add(corner, random_point(&rng, 1e-3f * c.size));
            const rt_ray ray = ray_of(from, rt_normalize(rt_sub(aim, from)));
            assert_vec(rt_radiance_mis(&scene, &ray, 100000, &rng), 1, 1, 1, 0);
            assert_in_range(rng.rays, 1, 5000);
        }
        scene.surfaces = NULL;
        rt_free_bvh(&bvh);
        free_mesh(&c.mesh);
    }
}

static void test_a_floor_of_two_triangles_is_a_box(void **state)
{
    /* With a ball on it, lights, shadows, indirect light: the same random numbers meet the same
     * surfaces, so the pictures differ by roundings, not by noise. */
    (void)state;
    const rt_vec3 corners[4] = {
        {-50, -1, -60}, {50, -1, -60}, {50, -1, 40}, {-50, -1, 40}};
    const int faces[6] = {0, 2, 1, 0, 3, 2};
    const rt_mesh mesh = {corners, faces, 4, 2, {{0.5f, 0.7f, 0.9f}, false}};
    const rt_box box = {{-50, -2, -60}, {50, -1, 40}, {{0.5f, 0.7f, 0.9f}, false}};
    const rt_sphere ball = {{0, 0, -5}, 1, {{0.8f, 0.4f, 0.2f}, false}};
    const rt_light light = {{3, 6, -3}, {90, 80, 70}};
    const rt_lamp lamp = {.center = {-3, 4, -4}, .radius = 1, .intensity = {40, 40, 40}};
    for (int part_two = 0; part_two < 2; part_two++) {
        rt_scene scene = empty;
        scene.spheres = &ball;
        scene.sphere_count = 1;
        scene.lights = &light;
        scene.light_count = 1;
        scene.lamps = &lamp;
        scene.lamp_count = part_two;
        scene.background = rt_vec(0.1f, 0.2f, 0.3f);
        rt_scene other = scene;
        scene.boxes = &box;
        scene.box_count = 1;
        other.meshes = &mesh;
        other.mesh_count = 1;
        rt_image a, b;
        const rt_vec3 one = picture_of(&scene, 3, 4, &a),
                      two = picture_of(&other, 3, 4, &b);
        int far = 0;
        for (int i = 0; i < W * H; i++)
            far += rt_length(rt_sub(a.pixels[i], b.pixels[i])) > 1e-3f;
        assert_true(far < 8); /* where rounding decides what a ray meets */
        assert_vec(one, two.x, two.y, two.z, 1e-3);
        assert_true(one.x > 0.05f);
        free(a.pixels);
        free(b.pixels);
    }
}

/* ---- what is refused ------------------------------------------------------------------ */

static void refused(const rt_scene *scene, rt_status status, int index)
{
    rt_bvh bvh;
    rt_vec3 pixel = {7, 7, 7};
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    const rt_camera camera = {.fov_y = 40};
    const rt_options options = {.samples = 1};
    int which = -7;
    assert_int_equal(rt_check_scene(scene, &which), status);
    assert_int_equal(which, index);
    assert_int_equal(rt_check_scene(scene, NULL), status);
    assert_int_equal(rt_render(scene, &camera, &options, &image), status);
    assert_int_equal(rt_build_bvh(scene, &bvh), status);
    rt_free_bvh(&bvh);
    assert_vec(pixel, 7, 7, 7, 0);
    assert_true(strlen(rt_status_text(status)) > 20 &&
                strcmp(rt_status_text(status), "unknown status") != 0);
}

static void test_every_bad_number_is_refused(void **state)
{
    (void)state;
    rt_vec3 corners[4] = {
        {0, 0, -4}, {4, 0, -4}, {0, 2, -4}, {1, 1, 1}}; /* one of no face */
    int faces[6] = {0, 1, 2, 2, 1, 0};
    rt_mesh meshes[2];
    meshes[0] = mesh_of(plate);
    meshes[1] = mesh_of(corners);
    meshes[1].indices = faces;
    meshes[1].position_count = 4;
    meshes[1].triangle_count = 2;
    const rt_mesh good = meshes[1];
    rt_scene scene = scene_of(meshes, 2);
    assert_int_equal(rt_check_scene(&scene, NULL), RT_OK);

    const int bad_indices[] = {-1, 4, 5, INT_MAX, INT_MIN};
    for (int i = 0; i < 6; i++)
        for (size_t k = 0; k < COUNT(bad_indices); k++) {
            const int kept = faces[i];
            faces[i] = bad_indices[k];
            refused(&scene, RT_BAD_MESH, 1);
            faces[i] = kept;
        }
    const float bad_places[] = {nan_, inf, -inf, 1.01e15f, -1.01e15f, 1e30f};
    for (int i = 0; i < 12; i++)
        for (size_t k = 0; k < COUNT(bad_places); k++) {
            float *number = i % 3 == 0   ? &corners[i / 3].x
                            : i % 3 == 1 ? &corners[i / 3].y
                                         : &corners[i / 3].z;
            const float kept = *number;
            *number = bad_places[k];
            refused(&scene, RT_BAD_MESH, 1);
            *number = kept;
        }
    const float bad_albedos[] = {-0.1f, 1.1f, nan_, inf};
    for (size_t k = 0; k < 3 * COUNT(bad_albedos); k++) {
        rt_vec3 *albedo = &meshes[1].material.albedo;
        *(k % 3 == 0   ? &albedo->x
          : k % 3 == 1 ? &albedo->y
                       : &albedo->z) = bad_albedos[k / 3];
        refused(&scene, RT_BAD_MESH, 1);
        meshes[1] = good;
    }
    for (int what = 0; what < 6; what++) {
        meshes[1].positions = what == 0 ? NULL : good.positions;
        meshes[1].indices = what == 1 ? NULL : good.indices;
        meshes[1].position_count = what == 2 ? -1 : what == 3 ? 0 : good.position_count;
        meshes[1].triangle_count = what == 4   ? -1
                                   : what == 5 ? INT_MIN
                                               : good.triangle_count;
        refused(&scene, RT_BAD_MESH, 1);
        meshes[1] = good;
    }
    corners[0].x = 1e15f; /* just good */
    assert_int_equal(rt_check_scene(&scene, NULL), RT_OK);
    scene.mesh_count = -1;
    refused(&scene, RT_BAD_POINTER, 0);
    scene.mesh_count = 1;
    scene.meshes = NULL;
    refused(&scene, RT_BAD_POINTER, 0);
    rt_surface table[2] = {{.eta = 0}, {.eta = -1}};
    scene = scene_of(meshes, 2);
    scene.surfaces = table; /* one for each mesh */
    refused(&scene, RT_BAD_SURFACE, 1);
}

static void test_empty_meshes_are_nothing(void **state)
{
    (void)state;
    const rt_mesh none[3] = {{NULL, NULL, 0, 0, {{1, 1, 1}, false}},
                             {plate, NULL, 3, 0, {{1, 1, 1}, false}},
                             {plate, one_face, 3, 0, {{1, 1, 1}, false}}};
    rt_scene scene = scene_of(none, 3);
    const rt_ray ray = ray_of(rt_vec(1, 0.5f, 3), rt_vec(0, 0, -1));
    with_and_without_tree(&scene, &ray, false, 0, 0);
    scene.background = rt_vec(0.25f, 0.5f, 0.75f);
    rt_image image;
    picture_of(&scene, 2, 1, &image);
    for (int i = 0; i < W * H; i++)
        assert_vec(image.pixels[i], 0.25, 0.5, 0.75, 0);
    free(image.pixels);
}

static void test_too_many_triangles_for_an_int(void **state)
{
    /* Their arrays would have to be there to be checked; the count alone must not overflow. */
    (void)state;
    rt_mesh many[3] = {mesh_of(plate), mesh_of(plate), mesh_of(plate)};
    rt_scene scene = scene_of(many, 3);
    for (int most = 1500000000; most > 0; most = most < INT_MAX ? INT_MAX : 0) {
        for (int i = 0; i < 3; i++)
            many[i].triangle_count = most;
        assert_int_equal(rt__triangle_count(&scene), INT_MAX);
    }
    many[0].triangle_count = INT_MAX;
    assert_int_equal(rt__primitive_count(&scene), INT_MAX);
    scene.mesh_count = 1;
    scene.sphere_count = scene.custom_shape_count = INT_MAX;
    assert_int_equal(rt__primitive_count(&scene), INT_MAX);
    many[0].triangle_count = 7;
    scene.sphere_count = scene.custom_shape_count = 2;
    assert_int_equal(rt__primitive_count(&scene), 11);
}

/* ---- the inspector -------------------------------------------------------------------- */

static void test_a_traced_path_says_which_triangle(void **state)
{
    (void)state;
    rt_mesh meshes[2] = {make_tetrahedron(1), make_icosphere(2)};
    place_mesh(&meshes[0], rt_vec(2, 0, -6), 1, 0);
    place_mesh(&meshes[1], rt_vec(-0.5f, 0, -5), 1.2f, 0);
    const rt_light light = {{3, 4, 0}, {90, 90, 90}};
    rt_scene scene = scene_of(meshes, 2);
    scene.lights = &light;
    scene.light_count = 1;
    const rt_surface table[2] = {{.eta = 1.5f}, {.shininess = 30}};
    const rt_camera camera = {.fov_y = 40};
    const rt_options options = {.samples = 1, .bounces = 3};
    rt_image image = new_image(W, H);
    int told = 0, inside = 0;
    for (int part_two = 0; part_two < 2; part_two++) {
        scene.surfaces = part_two ? table : NULL;
        for (int i = 0; i < W * H; i += 3) {
            rt_vertex vertices[8];
            rt_shadow shadows[16];
            rt_path path;
            memset(&path, 0, sizeof path);
            path.vertices = vertices;
            path.max_vertices = 8;
            path.shadows = shadows;
            path.max_shadows = 16;
            assert_int_equal(
                rt_trace_pixel(&scene, &camera, &options, &image, i % W, i / W, 0, &path),
                RT_OK);
            for (int k = 0; k < path.vertex_count; k++) {
                const rt_vertex *v = &vertices[k];
                if (v->shape < 0)
                    continue;
                rt_hit hit = untouched;
                assert_true(rt_intersect(&scene, &v->ray, &hit));
                assert_int_equal(v->shape, hit.shape);
                assert_int_equal(v->hit.shape, hit.shape);
                assert_int_equal(v->hit.part, hit.part);
                assert_true(v->hit.u == hit.u && v->hit.v == hit.v &&
                            v->hit.inside == hit.inside);
                const rt_mesh *mesh = &meshes[hit.shape];
                const rt_dvec3 w = rt_dvec(1 - (double)hit.u - (double)hit.v,
                                           (double)hit.u, (double)hit.v);
                const rt__corners corners = rt__corners_of(mesh, hit.part);
                const rt_vec3 p = rt__blend(&corners, w);
                assert_vec(hit.point, p.x, p.y, p.z, 1e-5);
                told++;
                inside += hit.inside;
            }
        }
    }
    assert_true(told > 200 && inside > 10);
    free(image.pixels);
    free_mesh(&meshes[0]);
    free_mesh(&meshes[1]);
}

/* ---- the demo ------------------------------------------------------------------------- */

static void test_demo_routine_is_that_of_rt_h(void **state)
{
    /* To the bit: at random, through edges and corners, and what is no triangle. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 273);
    int hits = 0;
    for (int i = 0; i < 100000; i++) {
        rt_vec3 corners[3];
        for (int k = 0; k < 3; k++) {
            const rt_vec3 p = random_point(&rng, 4);
            corners[k] = i % 2 ? rt_vec(floorf(p.x), floorf(p.y), floorf(p.z)) : p;
        }
        const rt_mesh mesh = mesh_of(corners);
        const rt_vec3 from = random_point(&rng, 9);
        const float part = i % 3 ? rt_random(&rng) : 0;
        const rt_vec3 to = i % 4 == 0 ? random_point(&rng, 3)
                                      : rt_add(rt_scale(corners[0], 1 - part),
                                               rt_scale(corners[1 + i % 2], part));
        const rt_ray ray =
            ray_of(i % 8 < 4 ? rt_vec(floorf(from.x), 3, 5) : from, rt_sub(to, from));
        const float t_max = i % 5 ? FLT_MAX : 2 * rt_random(&rng);
        rt_hit a = untouched, b = untouched;
        const bool found = rt_hit_triangle(&mesh, 0, &ray, t_max, &a);
        assert_int_equal(hit_triangle(&mesh, 0, &ray, t_max, &b), found);
        hits += found;
        assert_memory_equal(&a.point, &b.point, sizeof a.point);
        assert_memory_equal(&a.normal, &b.normal, sizeof a.normal);
        assert_true(a.t == b.t && a.shape == b.shape && a.part == b.part && a.u == b.u &&
                    a.v == b.v && a.inside == b.inside && a.material == b.material);
    }
    assert_true(hits > 5000);
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    check_against_rt_render(&scene_triangles);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_meshes_are_closed),
        cmocka_unit_test(test_exact_numbers),
        cmocka_unit_test(test_exact_on_seven_meshes),
        cmocka_unit_test(test_a_triangle_by_hand),
        cmocka_unit_test(test_the_corners_and_what_u_and_v_are),
        cmocka_unit_test(test_winding_says_what_is_inside),
        cmocka_unit_test(test_against_cramers_rule_in_double),
        cmocka_unit_test(test_directions_of_any_length),
        cmocka_unit_test(test_t_is_below_t_max_and_above_0),
        cmocka_unit_test(test_without_area_there_is_nothing),
        cmocka_unit_test(test_slivers),
        cmocka_unit_test(test_from_the_edge_there_is_nothing_to_see),
        cmocka_unit_test(test_nothing_is_met_far_out_in_its_plane),
        cmocka_unit_test(test_what_is_not_finite_misses),
        cmocka_unit_test(test_huge_and_tiny_is_the_same),
        cmocka_unit_test(test_of_several_in_one_place_the_first_wins),
        cmocka_unit_test(test_how_shapes_are_counted),
        cmocka_unit_test(test_the_meshes_are_closed),
        cmocka_unit_test(test_no_path_leaves_a_closed_mesh),
        cmocka_unit_test(test_no_ray_meets_the_triangle_that_it_leaves),
        cmocka_unit_test(test_the_tree_finds_what_the_loop_finds),
        cmocka_unit_test(test_a_furnace_of_triangles),
        cmocka_unit_test(test_reciprocity_of_meshes),
        cmocka_unit_test(test_a_ball_of_triangles_is_a_ball),
        cmocka_unit_test(test_clear_glass_vanishes_in_an_even_light),
        cmocka_unit_test(test_a_floor_of_two_triangles_is_a_box),
        cmocka_unit_test(test_every_bad_number_is_refused),
        cmocka_unit_test(test_empty_meshes_are_nothing),
        cmocka_unit_test(test_too_many_triangles_for_an_int),
        cmocka_unit_test(test_a_traced_path_says_which_triangle),
        cmocka_unit_test(test_demo_routine_is_that_of_rt_h),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("16 triangles", tests, NULL, NULL);
}

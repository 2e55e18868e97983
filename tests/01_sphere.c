/* Chapter 1: rays, the camera, the ray-sphere intersection. */
#define DEMO "../demos/demo01_sphere.c"
#include "test.h"

static rt_sphere sphere_of(float x, float y, float z, float radius)
{
    const rt_sphere sphere = {{x, y, z}, radius, {{1, 1, 1}, false}};
    return sphere;
}

/* ---- examples ----------------------------------------------------------------------- */

static void test_head_on(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, -5, 1);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_close(hit.t, 4, 0);
    assert_vec(hit.point, 0, 0, -4, 0);
    assert_vec(hit.normal, 0, 0, 1, 0);
    assert_ptr_equal(hit.material, &sphere.material);
}

static void test_thirty_degrees_off(void **state)
{
    /* From distance 2, at 30 degrees to the axis, the ray just touches the unit sphere, at
     * distance sqrt(3); at an offset of 3/5 it comes in at depth 1 - 4/5. */
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, 0, 1);
    rt_ray ray = ray_of(rt_vec(0.6f, 0, 3), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_close(hit.t, 2.2, 1e-6);
    assert_vec(hit.normal, 0.6, 0, 0.8, 1e-6);
    ray = ray_of(rt_vec(0, 0, 2), rt_vec(0.49999f, 0, -0.8660254f));
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_close(hit.t, 1.7320508, 0.01);
    ray.direction.x = 0.50001f;
    assert_false(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
}

static void test_from_inside_it_is_the_way_out(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(1, 2, 3, 2);
    const rt_ray ray = ray_of(rt_vec(1, 2, 3), rt_vec(0, 1, 0));
    rt_hit hit = untouched;
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_close(hit.t, 2, 0);
    assert_vec(hit.point, 1, 4, 3, 0);
    assert_vec(hit.normal, 0, -1, 0, 0);
}

static void test_behind_is_a_miss(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, 5, 1);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_false(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_untouched(hit);
}

static void test_tangent_is_a_hit_and_beside_it_is_not(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, 0, 3);
    rt_ray ray = ray_of(rt_vec(3, 0, 10), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    assert_close(hit.t, 10, 0);
    assert_vec(hit.normal, 1, 0, 0, 0);
    ray.origin.x = nextafterf(3, 4);
    assert_false(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
}

static void test_nothing_at_or_beyond_t_max(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, -5, 1);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_false(rt_hit_sphere(&sphere, &ray, 4, &hit));
    assert_untouched(hit);
    assert_true(rt_hit_sphere(&sphere, &ray, nextafterf(4, 5), &hit));
}

static void test_direction_of_any_length(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, -5, 1);
    const float scales[] = {1e-3f, 1, 1e3f, 1e30f, 1e-30f};
    for (size_t i = 0; i < COUNT(scales); i++) {
        const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -scales[i]));
        rt_hit hit = untouched;
        assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
        assert_close(hit.t * scales[i], 4, 1e-6);
        assert_vec(hit.point, 0, 0, -4, 0);
    }
}

static void test_from_the_surface(void **state)
{
    (void)state;
    const rt_sphere sphere = sphere_of(0, 0, 0, 2);
    rt_ray ray = ray_of(rt_vec(2, 0, 0), rt_vec(1, 0, 0));
    rt_hit hit = untouched;
    assert_false(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit)); /* leaving */
    ray.direction.x = -1;
    assert_true(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit)); /* entering */
    assert_close(hit.t, 4, 0);
    assert_vec(hit.normal, 1, 0, 0, 0);
}

/* ---- properties, against quadruple precision ----------------------------------------- */

#ifdef __SIZEOF_FLOAT128__
__extension__ typedef __float128 quad; /* 113 bits: the products of floats are exact */
#else
typedef long double quad;
#endif

static quad quad_sqrt(quad v)
{
    if (!(v > 0))
        return 0;
    quad root = (quad)sqrtl((long double)v); /* a step of Newton's method doubles the
                                                number of right digits */
    root = (root + v / root) / 2;
    return (root + v / root) / 2;
}

/* The same question in quadruple precision: 0 for a miss, else the hit's t. */
static quad reference_t(const rt_sphere *s, const rt_ray *ray)
{
    const quad ux = ray->direction.x, uy = ray->direction.y, uz = ray->direction.z;
    const quad fx = (quad)ray->origin.x - s->center.x;
    const quad fy = (quad)ray->origin.y - s->center.y;
    const quad fz = (quad)ray->origin.z - s->center.z;
    const quad r = s->radius;
    const quad a = ux * ux + uy * uy + uz * uz;
    const quad b = fx * ux + fy * uy + fz * uz;
    const quad c = fx * fx + fy * fy + fz * fz - r * r;
    const quad discriminant = b * b - a * c;
    if (discriminant < 0)
        return 0;
    /* the root without cancellation, and the other one from the product of the roots */
    const quad q = b > 0 ? -b - quad_sqrt(discriminant) : -b + quad_sqrt(discriminant);
    const quad t0 = b > 0 ? q / a : c / q;
    const quad t1 = b > 0 ? c / q : q / a;
    return t0 > 0 ? t0 : t1 > 0 ? t1 : 0;
}

/* Rays about a sphere: kind 0 aimed at it from outside, 1 grazing, 2 from inside. */
static void check_radius(float radius, double tolerance)
{
    double worst = 0;
    int hits = 0;
    rt_rng rng = rt_rng_start(0, (uint32_t)radius, 4);
    for (int i = 0; i < 600000; i++) {
        const int kind = i % 3;
        const rt_vec3 center = random_point(&rng, kind == 0 ? 60.0f : 1.0f);
        const rt_sphere sphere = sphere_of(center.x, center.y, center.z, radius);
        const rt_vec3 out = random_direction(&rng), d = random_direction(&rng);
        const rt_vec3 side = rt_normalize(rt_cross(out, d));
        rt_ray ray;
        if (kind == 0) {
            const float distance = radius + uniform(&rng, 1.0f, 100.0f);
            const rt_vec3 target = rt_add(center, rt_scale(d, 0.999f * radius));
            ray.origin = rt_add(center, rt_scale(out, distance));
            ray.direction = rt_normalize(rt_sub(target, ray.origin));
        } else if (kind == 1) {
            const float exponent = uniform(&rng, -7.0f, -3.0f);
            const float sign = rt_random(&rng) < 0.5f ? -1.0f : 1.0f;
            const float beside = 1.0f + sign * powf(10.0f, exponent);
            ray.direction = rt_normalize(rt_cross(out, side));
            ray.origin = rt_add(rt_add(center, rt_scale(out, radius * beside)),
                                rt_scale(ray.direction, -uniform(&rng, 1.0f, 100.0f)));
        } else {
            ray.origin = rt_add(center, rt_scale(out, 0.999f * radius));
            ray.direction = d;
        }
        rt_hit hit = untouched;
        const bool is_hit = rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit);
        const quad t = reference_t(&sphere, &ray);
        if (is_hit != (t > 0))
            fail_msg("ray %d, radius %g: hit %d, but t = %g", i, (double)radius, is_hit,
                     (double)t);
        if (!is_hit) {
            assert_untouched(hit);
            continue;
        }
        /* relative to t, except for rays that start within 0.01 of the surface: there the
         * rounding of |C - O|^2 - R^2 in double is left, below 1e-8 for R = 1e5 */
        const double error = fabs((double)(hit.t - t)) / fmax((double)t, 0.01);
        assert_true(error <= tolerance);
        worst = error > worst ? error : worst;
        hits++;
        const rt_vec3 from_center = rt_sub(hit.point, center);
        assert_close(rt_length(hit.normal), 1, 2e-7);
        assert_true(rt_dot(hit.normal, ray.direction) <= 1e-6f);
        assert_close(rt_length(from_center) / radius, 1, 1e-6 + 1e-5 / (double)radius);
        const float cosine = fabsf(rt_dot(hit.normal, rt_normalize(from_center)));
        assert_close(cosine, 1, 1e-5);
    }
    print_message("radius %g: 0 wrong of 600000 rays, %d hits, error of t up to %.2g\n",
                  (double)radius, hits, worst);
    assert_in_range(hits, 450000, 550000);
}

static void test_radius_1_against_quad(void **state)
{
    (void)state;
    check_radius(1, 1.2e-7);
}

static void test_radius_940_against_quad(void **state)
{
    (void)state;
    check_radius(940, 1.2e-7);
}

static void test_radius_1e5_against_quad(void **state)
{
    (void)state;
    check_radius(1e5f, 1e-6);
}

static void test_the_point_is_put_back_onto_the_sphere(void **state)
{
    /* From a million units away t is right to 0.03 only, but P is on the sphere. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 32);
    const rt_sphere sphere = sphere_of(0, 0, 0, 1);
    for (int i = 0; i < 10000; i++) {
        const rt_vec3 origin = rt_scale(random_direction(&rng), 1e6f);
        const rt_ray ray =
            ray_of(origin, rt_scale(rt_sub(random_point(&rng, 0.5f), origin), 1e-6f));
        rt_hit hit = untouched;
        if (rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit))
            assert_close(rt_length(hit.point), 1, 2e-7);
    }
}

static void test_walls_of_radius_1e5_are_flat_within_the_room(void **state)
{
    /* The point on a wall of radius 1e5 at x = -50, seen from within a room of size 100. */
    (void)state;
    const rt_sphere wall = sphere_of(-100050, 0, 0, 1e5f);
    rt_rng rng = rt_rng_start(0, 0, 5);
    for (int i = 0; i < 10000; i++) {
        const rt_vec3 target =
            rt_vec(-50, uniform(&rng, -30, 30), uniform(&rng, -30, 30));
        const rt_vec3 origin = random_point(&rng, 40.0f);
        const rt_ray ray = ray_of(origin, rt_sub(target, origin));
        rt_hit hit = untouched;
        assert_true(rt_hit_sphere(&wall, &ray, FLT_MAX, &hit));
        const double y = (double)hit.point.y, z = (double)hit.point.z;
        assert_close(hit.point.x, -100050 + sqrt(1e10 - y * y - z * z), 1e-5);
    }
}

/* ---- bad input ---------------------------------------------------------------------- */

static void test_bad_rays_and_spheres_miss(void **state)
{
    (void)state;
    const rt_sphere good = sphere_of(0, 0, -5, 1);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    const float bad[] = {NAN, INFINITY, -INFINITY};
    rt_hit hit = untouched;
    for (size_t i = 0; i < COUNT(bad); i++)
        for (int k = 0; k < 3; k++) {
            const float x = k == 0 ? bad[i] : 0, y = k == 1 ? bad[i] : 0;
            const float z = k == 2 ? bad[i] : -1;
            const rt_ray bad_origin = ray_of(rt_vec(x, y, z), rt_vec(0, 0, -1));
            const rt_ray bad_direction = ray_of(rt_vec(0, 0, 0), rt_vec(x, y, z));
            const rt_sphere bad_center = sphere_of(x, y, z, 1);
            assert_false(rt_hit_sphere(&good, &bad_origin, FLT_MAX, &hit));
            assert_false(rt_hit_sphere(&good, &bad_direction, FLT_MAX, &hit));
            assert_false(rt_hit_sphere(&bad_center, &ray, FLT_MAX, &hit));
        }
    const float radii[] = {0, -1, NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < COUNT(radii); i++) {
        const rt_sphere sphere = sphere_of(0, 0, -5, radii[i]);
        assert_false(rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit));
    }
    const rt_ray nowhere = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, 0));
    assert_false(rt_hit_sphere(&good, &nowhere, FLT_MAX, &hit));
    assert_false(rt_hit_sphere(&good, &ray, NAN, &hit));
    assert_untouched(hit);
}

static void test_tiny_numbers_give_no_infinity(void **state)
{
    (void)state;
    const rt_sphere point = sphere_of(0, 0, 0, 1e-40f), good = sphere_of(0, 0, -5, 1);
    const rt_ray through = ray_of(rt_vec(0, 0, 1), rt_vec(0, 0, -1));
    const rt_ray slow = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1e-40f));
    rt_hit hit = untouched;
    if (rt_hit_sphere(&point, &through, FLT_MAX, &hit))
        assert_close(rt_length(hit.normal), 1, 1e-6);
    if (rt_hit_sphere(&good, &slow, INFINITY, &hit))
        assert_true(hit.t <= FLT_MAX);
}

/* ---- the camera --------------------------------------------------------------------- */

static void test_camera_looks_along_its_direction(void **state)
{
    (void)state;
    const rt_camera camera = {{1, 2, 3}, {0, 0, 7}, {0, 1, 0}, 60};
    const rt_ray ray = rt_camera_ray(&camera, 64, 48, 32, 24);
    assert_vec(ray.origin, 1, 2, 3, 0);
    assert_vec(ray.direction, 0, 0, 1, 1e-7);
}

static void test_camera_corners(void **state)
{
    /* fov_y = 90 degrees: the film is 2 high at distance 1, and 4 wide for 200 x 100. */
    (void)state;
    const rt_camera camera = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 90};
    const struct {
        float x, y, film_x, film_y;
    } cases[] = {
        {0, 0, -2, 1},     {200, 0, 2, 1},  {0, 100, -2, -1},
        {200, 100, 2, -1}, {150, 50, 1, 0},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        const rt_ray ray = rt_camera_ray(&camera, 200, 100, cases[i].x, cases[i].y);
        const rt_vec3 d = rt_normalize(rt_vec(cases[i].film_x, cases[i].film_y, -1));
        assert_vec(ray.direction, d.x, d.y, d.z, 1e-6);
    }
}

static void test_camera_right_is_forward_cross_up(void **state)
{
    /* Looking along x with y up, the right of the picture is at z. */
    (void)state;
    const rt_camera camera = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, 40};
    assert_true(rt_camera_ray(&camera, 10, 10, 9.5f, 5).direction.z > 0.1f);
    assert_true(rt_camera_ray(&camera, 10, 10, 5, 0.5f).direction.y > 0.1f);
}

static void test_camera_of_zeros_is_the_documented_default(void **state)
{
    (void)state;
    const rt_camera zero = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
    const rt_camera same = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 45};
    const rt_ray a = rt_camera_ray(&zero, 30, 20, 3, 4);
    const rt_ray b = rt_camera_ray(&same, 30, 20, 3, 4);
    assert_memory_equal(&a, &b, sizeof a);
    assert_close(rt_length(a.direction), 1, 1e-6);
}

static void test_camera_without_up_takes_y(void **state)
{
    (void)state;
    const rt_camera zero = {{0, 0, 0}, {3, -1, -2}, {0, 0, 0}, 50};
    const rt_camera same = {{0, 0, 0}, {3, -1, -2}, {0, 1, 0}, 50};
    const rt_vec3 a = rt_camera_ray(&zero, 30, 20, 3, 4).direction;
    const rt_vec3 b = rt_camera_ray(&same, 30, 20, 3, 4).direction;
    assert_vec(a, b.x, b.y, b.z, 0);
}

static void test_camera_of_small_angles_and_pictures(void **state)
{
    (void)state;
    const rt_camera tele = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0.5f};
    const double half = 0.25 / 180 * 3.14159265;
    assert_close(rt_camera_ray(&tele, 10, 10, 5, 0).direction.y, sin(half), 1e-7);
    assert_close(rt_camera_ray(&tele, 1, 10, 0.5f, 0).direction.y, sin(half), 1e-7);
    assert_close(rt_camera_ray(&tele, 10, 1, 5, 0).direction.y, sin(half), 1e-7);
}

static void test_camera_looking_straight_up(void **state)
{
    (void)state;
    const rt_camera camera = {{0, 0, 0}, {0, 3, 0}, {0, 1, 0}, 90};
    assert_vec(rt_camera_ray(&camera, 20, 20, 10, 10).direction, 0, 1, 0, 1e-7);
    const rt_vec3 left = rt_camera_ray(&camera, 20, 20, 0, 10).direction;
    const rt_vec3 top = rt_camera_ray(&camera, 20, 20, 10, 0).direction;
    assert_close(left.y, sqrt(0.5), 1e-6);
    assert_close(top.y, sqrt(0.5), 1e-6);
    assert_close(rt_dot(left, top), 0.5, 1e-6);
}

static void test_camera_out_of_range_hits_nothing(void **state)
{
    (void)state;
    const rt_camera cameras[] = {
        {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 180},
        {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, -1},
        {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, NAN},
        {{0, 0, 0}, {0, NAN, -1}, {0, 1, 0}, 40},
        {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 1e9f},
    };
    for (size_t i = 0; i < COUNT(cameras); i++)
        assert_vec(rt_camera_ray(&cameras[i], 20, 20, 5, 5).direction, 0, 0, 0, 0);
    const rt_camera good = {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 40};
    assert_vec(rt_camera_ray(&good, 0, 20, 5, 5).direction, 0, 0, 0, 0);
    assert_vec(rt_camera_ray(&good, 20, -1, 5, 5).direction, 0, 0, 0, 0);
}

static void test_point_on_a_ray(void **state)
{
    (void)state;
    const rt_ray ray = ray_of(rt_vec(1, 2, 3), rt_vec(0, -1, 2));
    assert_vec(rt_at(&ray, 3), 1, -1, 9, 0);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_hit_sphere_is_rt_hit_sphere(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 6);
    int hits = 0;
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 c = random_point(&rng, 10.0f);
        const rt_sphere sphere = sphere_of(c.x, c.y, c.z, uniform(&rng, 0.1f, 10.0f));
        const rt_vec3 origin = random_point(&rng, 10.0f), d = random_point(&rng, 2.0f);
        const rt_ray ray = ray_of(origin, d);
        const float t_max = uniform(&rng, 0.0f, 20.0f);
        rt_hit theirs = untouched, ours = untouched;
        const bool hit = hit_sphere(&sphere, &ray, t_max, &theirs);
        assert_int_equal(hit, rt_hit_sphere(&sphere, &ray, t_max, &ours));
        assert_memory_equal(&theirs.t, &ours.t, sizeof ours.t);
        assert_ptr_equal(theirs.material, ours.material);
        assert_vec(theirs.point, ours.point.x, ours.point.y, ours.point.z, 2e-6);
        assert_vec(theirs.normal, ours.normal.x, ours.normal.y, ours.normal.z, 1e-6);
        hits += hit;
    }
    assert_in_range(hits, 10000, 90000);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_head_on),
        cmocka_unit_test(test_thirty_degrees_off),
        cmocka_unit_test(test_from_inside_it_is_the_way_out),
        cmocka_unit_test(test_behind_is_a_miss),
        cmocka_unit_test(test_tangent_is_a_hit_and_beside_it_is_not),
        cmocka_unit_test(test_nothing_at_or_beyond_t_max),
        cmocka_unit_test(test_direction_of_any_length),
        cmocka_unit_test(test_from_the_surface),
        cmocka_unit_test(test_radius_1_against_quad),
        cmocka_unit_test(test_radius_940_against_quad),
        cmocka_unit_test(test_radius_1e5_against_quad),
        cmocka_unit_test(test_the_point_is_put_back_onto_the_sphere),
        cmocka_unit_test(test_walls_of_radius_1e5_are_flat_within_the_room),
        cmocka_unit_test(test_bad_rays_and_spheres_miss),
        cmocka_unit_test(test_tiny_numbers_give_no_infinity),
        cmocka_unit_test(test_camera_looks_along_its_direction),
        cmocka_unit_test(test_camera_corners),
        cmocka_unit_test(test_camera_right_is_forward_cross_up),
        cmocka_unit_test(test_camera_of_zeros_is_the_documented_default),
        cmocka_unit_test(test_camera_without_up_takes_y),
        cmocka_unit_test(test_camera_of_small_angles_and_pictures),
        cmocka_unit_test(test_camera_looking_straight_up),
        cmocka_unit_test(test_camera_out_of_range_hits_nothing),
        cmocka_unit_test(test_point_on_a_ray),
        cmocka_unit_test(test_demo_hit_sphere_is_rt_hit_sphere),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("1 sphere", tests, NULL, NULL);
}

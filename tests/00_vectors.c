/* Chapter 0: vectors, the basis, sine and cosine. */
#include "test.h"

static void test_sums_and_products(void **state)
{
    (void)state;
    const rt_vec3 a = rt_vec(1, 2, 3), b = rt_vec(4, -5, 6);
    assert_vec(rt_add(a, b), 5, -3, 9, 0);
    assert_vec(rt_sub(a, b), -3, 7, -3, 0);
    assert_vec(rt_mul(a, b), 4, -10, 18, 0);
    assert_vec(rt_scale(a, 2), 2, 4, 6, 0);
    assert_close(rt_dot(a, b), 4 - 10 + 18, 0);
    assert_close(rt_length(rt_vec(2, 3, 6)), 7, 0);
}

static void test_cross_is_right_handed(void **state)
{
    (void)state;
    assert_vec(rt_cross(rt_vec(1, 0, 0), rt_vec(0, 1, 0)), 0, 0, 1, 0);
    assert_vec(rt_cross(rt_vec(0, 1, 0), rt_vec(0, 0, 1)), 1, 0, 0, 0);
    assert_vec(rt_cross(rt_vec(1, 2, 3), rt_vec(4, 5, 6)), -3, 6, -3, 0);
}

static void test_is_zero_looks_at_every_component(void **state)
{
    (void)state;
    assert_true(rt_is_zero(rt_vec(0, -0.0f, 0)));
    assert_false(rt_is_zero(rt_vec(1e-40f, 0, 0)));
    assert_false(rt_is_zero(rt_vec(0, -1, 0)));
    assert_false(rt_is_zero(rt_vec(0, 0, 1)));
    assert_false(rt_is_zero(rt_vec(0, NAN, 0)));
}

static void test_normalize(void **state)
{
    (void)state;
    assert_vec(rt_normalize(rt_vec(3, 0, 4)), 0.6, 0, 0.8, 1e-7);
    assert_vec(rt_normalize(rt_vec(0, -1e30f, 0)), 0, -1, 0, 0);
    assert_vec(rt_normalize(rt_vec(0, 0, 1e-40f)), 0, 0, 1, 0);
    rt_rng rng = rt_rng_start(0, 0, 1);
    for (int i = 0; i < 10000; i++) {
        const rt_vec3 v = random_point(&rng, 100.0f), n = rt_normalize(v);
        assert_close(rt_length(n), 1, 2e-7);
        assert_vec(rt_scale(n, rt_length(v)), v.x, v.y, v.z, 2e-5);
    }
}

static void test_normalize_without_a_direction_is_zero(void **state)
{
    (void)state;
    assert_vec(rt_normalize(rt_vec(0, 0, 0)), 0, 0, 0, 0);
    assert_vec(rt_normalize(rt_vec(NAN, 1, 0)), 0, 0, 0, 0);
    assert_vec(rt_normalize(rt_vec(0, INFINITY, 1)), 0, 0, 0, 0);
    assert_vec(rt_normalize(rt_vec(1, 0, -INFINITY)), 0, 0, 0, 0);
}

static void test_double_vectors(void **state)
{
    (void)state;
    const rt_dvec3 a = rt_dvec(1, 2, 3), b = rt_to_double(rt_vec(4, -5, 6));
    assert_close(rt_ddot(a, b), 12, 0);
    assert_vec(rt_to_float(rt_dsub(a, b)), -3, 7, -3, 0);
    assert_vec(rt_to_float(rt_dmad(a, 2, b)), 9, -8, 15, 0);
    assert_vec(rt_to_float(rt_dscale(a, -2)), -2, -4, -6, 0);
}

static void check_basis(rt_vec3 n)
{
    rt_vec3 a, b;
    rt_basis(n, &a, &b);
    assert_close(rt_dot(a, a), 1, 1e-6);
    assert_close(rt_dot(b, b), 1, 1e-6);
    assert_close(rt_dot(a, b), 0, 1e-6);
    assert_close(rt_dot(a, n), 0, 1e-6);
    assert_close(rt_dot(b, n), 0, 1e-6);
    assert_vec(rt_cross(a, b), n.x, n.y, n.z, 1e-6);
}

static void test_basis_on_the_axes(void **state)
{
    (void)state;
    check_basis(rt_vec(1, 0, 0));
    check_basis(rt_vec(-1, 0, 0));
    check_basis(rt_vec(0, 1, 0));
    check_basis(rt_vec(0, -1, 0));
    check_basis(rt_vec(0, 0, 1));
    check_basis(rt_vec(0, 0, -1));
}

static void test_basis_of_random_normals(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 2);
    for (int i = 0; i < 2000000; i++)
        check_basis(random_direction(&rng));
}

static void test_basis_near_the_poles(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 3);
    for (int i = 0; i < 1000000; i++) {
        const float x = uniform(&rng, -1e-3f, 1e-3f);
        const float y = uniform(&rng, -1e-3f, 1e-3f);
        check_basis(rt_normalize(rt_vec(x, y, -1)));
        check_basis(rt_normalize(rt_vec(x, y, 1)));
    }
}

static void test_sincos_against_libm(void **state)
{
    (void)state;
    for (int i = 0; i <= 1 << 20; i++) {
        const float turns = (float)i / (float)(1 << 20);
        float s, c;
        rt_sincos(turns, &s, &c);
        assert_close(s, sin(6.283185307179586 * (double)turns), 1e-7);
        assert_close(c, cos(6.283185307179586 * (double)turns), 1e-7);
    }
}

static void test_sincos_of_whole_quarters_is_exact(void **state)
{
    (void)state;
    const float sines[5] = {0, 1, 0, -1, 0}, cosines[5] = {1, 0, -1, 0, 1};
    for (int i = 0; i < 5; i++) {
        float s, c;
        rt_sincos(0.25f * (float)i, &s, &c);
        assert_close(s, sines[i], 0);
        assert_close(c, cosines[i], 0);
    }
}

static void test_sincos_out_of_range_is_that_of_zero(void **state)
{
    (void)state;
    const float bad[] = {-0.001f, 1.001f, 1e30f, INFINITY, -INFINITY, NAN};
    for (size_t i = 0; i < COUNT(bad); i++) {
        float s = 7, c = 7;
        rt_sincos(bad[i], &s, &c);
        assert_close(s, 0, 0);
        assert_close(c, 1, 0);
    }
}

static
#ifdef __GNUC__
    __attribute__((noinline))
#endif
    void
    there_and_back(const double *p, double *q)
{
    const rt_dvec3 a = rt_dvec(p[0], p[1], p[2]);
    const rt_dvec3 b = rt_to_double(rt_to_float(rt_dscale(a, p[3])));
    q[0] = b.x;
    q[1] = b.y;
    q[2] = b.z;
}

static void test_to_float_rounds(void **state)
{
    /* gcc 12 with -O2 would not: see RT__ROUND. */
    (void)state;
    const double p[4] = {1, 2, 4, 1.0 / 3};
    double q[3];
    there_and_back(p, q);
    for (int i = 0; i < 3; i++) {
        volatile float rounded = (float)(p[i] * p[3]);
        assert_close(q[i], (double)rounded, 0);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_to_float_rounds),
        cmocka_unit_test(test_sums_and_products),
        cmocka_unit_test(test_cross_is_right_handed),
        cmocka_unit_test(test_is_zero_looks_at_every_component),
        cmocka_unit_test(test_normalize),
        cmocka_unit_test(test_normalize_without_a_direction_is_zero),
        cmocka_unit_test(test_double_vectors),
        cmocka_unit_test(test_basis_on_the_axes),
        cmocka_unit_test(test_basis_of_random_normals),
        cmocka_unit_test(test_basis_near_the_poles),
        cmocka_unit_test(test_sincos_against_libm),
        cmocka_unit_test(test_sincos_of_whole_quarters_is_exact),
        cmocka_unit_test(test_sincos_out_of_range_is_that_of_zero),
    };
    return cmocka_run_group_tests_name("0 vectors", tests, NULL, NULL);
}

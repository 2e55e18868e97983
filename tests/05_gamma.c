/* Chapter 5: from linear light to bytes. */
#define DEMO "../demos/demo05_gamma.c"
#include "test.h"

static void test_known_values(void **state)
{
    (void)state;
    assert_int_equal(rt_encode(0, 2.2), 0);
    assert_int_equal(rt_encode(1, 2.2), 255);
    assert_int_equal(rt_encode(0.5f, 2.2), 186);    /* 255 . 0.5^(1/2.2) = 186.08 */
    assert_int_equal(rt_encode(0.18f, 2.2), 117);   /* middle grey: 116.97 */
    assert_int_equal(rt_encode(0.2140f, 2.2), 127); /* 126.5... */
}

static void test_linear(void **state)
{
    (void)state;
    for (int byte = 0; byte <= 255; byte++)
        assert_int_equal(rt_encode((float)byte / 255.0f, 1), byte);
}

static void test_it_rounds_to_the_nearest(void **state)
{
    (void)state;
    for (int byte = 0; byte < 255; byte++) {
        const float middle = ((float)byte + 0.5f) / 255.0f;
        assert_int_equal(rt_encode(middle - 1e-5f, 1), byte);
        assert_int_equal(rt_encode(middle + 1e-5f, 1), byte + 1);
    }
}

static void test_out_of_range_is_clamped(void **state)
{
    (void)state;
    const double gammas[] = {1, 2.2, 0.5};
    for (size_t i = 0; i < COUNT(gammas); i++) {
        assert_int_equal(rt_encode(-0.5f, gammas[i]), 0);
        assert_int_equal(rt_encode(-INFINITY, gammas[i]), 0);
        assert_int_equal(rt_encode(1.5f, gammas[i]), 255);
        assert_int_equal(rt_encode(1e30f, gammas[i]), 255);
        assert_int_equal(rt_encode(INFINITY, gammas[i]), 255);
        assert_int_equal(rt_encode(NAN, gammas[i]), 0);
    }
}

static void test_gamma_that_is_no_gamma_is_2_2(void **state)
{
    (void)state;
    const double gammas[] = {0, -1, (double)NAN, (double)INFINITY};
    for (size_t i = 0; i < COUNT(gammas); i++)
        assert_int_equal(rt_encode(0.5f, gammas[i]), 186);
    assert_int_equal(rt_encode(0.5f, DBL_MAX), 255); /* 0.5^0 */
}

static void test_brighter_light_never_gives_a_smaller_byte(void **state)
{
    (void)state;
    int last = 0;
    for (int i = 0; i <= 100000; i++) {
        const int byte = rt_encode((float)i / 100000.0f, 2.2);
        assert_in_range(byte, last, last + 20);
        last = byte;
    }
    assert_int_equal(last, 255);
}

static void test_every_byte_shown_as_light_comes_back(void **state)
{
    /* A screen shows byte b as (b/255)^2.2. */
    (void)state;
    for (int byte = 0; byte <= 255; byte++)
        assert_int_equal(rt_encode(powf((float)byte / 255.0f, 2.2f), 2.2), byte);
}

static void test_no_float_is_so_close_to_a_middle_that_libms_could_differ(void **state)
{
    /* Between bytes b and b+1 lies x = ((b + 1/2)/255)^2.2. The floats on either side of it
     * give values of 255 x^(1/2.2) that are more than 1e-9 away from the middle; a pow that is
     * wrong in its last bit is wrong by 1e-13 at most. */
    (void)state;
    for (int byte = 0; byte < 255; byte++) {
        const long double middle = byte + 0.5L;
        const float x = (float)powl(middle / 255, 2.2L);
        const float about[3] = {nextafterf(x, 0), x, nextafterf(x, 1)};
        for (int i = 0; i < 3; i++) {
            const long double value = 255 * powl(about[i], 1 / 2.2L);
            assert_true(fabsl(value - middle) > 1e-9L);
            assert_int_equal(rt_encode(about[i], 2.2), value > middle ? byte + 1 : byte);
        }
    }
}

static void test_demo_encode_is_rt_encode(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 20);
    for (int i = 0; i < 200000; i++) {
        const float value = uniform(&rng, -0.2f, 1.3f);
        assert_int_equal(encode(value), rt_encode(value, 2.2));
    }
    const float special[] = {NAN, INFINITY, -INFINITY, 0, -0.0f, 1};
    for (size_t i = 0; i < COUNT(special); i++)
        assert_int_equal(encode(special[i]), rt_encode(special[i], 2.2));
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_known_values),
        cmocka_unit_test(test_linear),
        cmocka_unit_test(test_it_rounds_to_the_nearest),
        cmocka_unit_test(test_out_of_range_is_clamped),
        cmocka_unit_test(test_gamma_that_is_no_gamma_is_2_2),
        cmocka_unit_test(test_brighter_light_never_gives_a_smaller_byte),
        cmocka_unit_test(test_every_byte_shown_as_light_comes_back),
        cmocka_unit_test(test_no_float_is_so_close_to_a_middle_that_libms_could_differ),
        cmocka_unit_test(test_demo_encode_is_rt_encode),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("5 gamma", tests, NULL, NULL);
}

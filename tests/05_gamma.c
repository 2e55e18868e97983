/* Chapter 5: from linear light to bytes. */
#define DEMO "../demos/demo05_gamma.c"
#include "test.h"

static void test_known_values(void **state)
{
    (void)state;
    assert_int_equal(rt_encode(0, 2.2f), 0);
    assert_int_equal(rt_encode(1, 2.2f), 255);
    assert_int_equal(rt_encode(0.5f, 2.2f), 186);    /* 255 . 0.5^(1/2.2) = 186.08 */
    assert_int_equal(rt_encode(0.18f, 2.2f), 117);   /* middle grey: 116.97 */
    assert_int_equal(rt_encode(0.2140f, 2.2f), 127); /* 126.5... */
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
    const float gammas[] = {1, 2.2f, 0.5f};
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
    const float gammas[] = {0, -1, NAN, -INFINITY};
    for (size_t i = 0; i < COUNT(gammas); i++)
        assert_int_equal(rt_encode(0.5f, gammas[i]), 186);
}

static void test_brighter_light_never_gives_a_smaller_byte(void **state)
{
    (void)state;
    int last = 0;
    for (int i = 0; i <= 100000; i++) {
        const int byte = rt_encode((float)i / 100000.0f, 2.2f);
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
        assert_int_equal(rt_encode(powf((float)byte / 255.0f, 2.2f), 2.2f), byte);
}

static void test_demo_encode_is_rt_encode(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 20);
    for (int i = 0; i < 200000; i++) {
        const float value = uniform(&rng, -0.2f, 1.3f);
        assert_int_equal(encode(value), rt_encode(value, 2.2f));
    }
    const float special[] = {NAN, INFINITY, -INFINITY, 0, -0.0f, 1};
    for (size_t i = 0; i < COUNT(special); i++)
        assert_int_equal(encode(special[i]), rt_encode(special[i], 2.2f));
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
        cmocka_unit_test(test_demo_encode_is_rt_encode),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("5 gamma", tests, NULL, NULL);
}

/* Chapter 16: triangles. */
#include "test.h"
#include "exact.h"

/* ---- exact: against numbers that are not rounded -------------------------------------- */

/* Each edge is the edge of two triangles, once in each direction, and the outside is outside:
 * else a leak would say nothing. */
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

/* 0 leaks, 0 triangles missed, 0 hit in error, and t as near as a float can be; of all these
 * rays, too, that are aimed at edges and corners. */
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

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_exact_meshes_are_closed),
        cmocka_unit_test(test_exact_numbers),
        cmocka_unit_test(test_exact_on_seven_meshes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Chapter 7: random numbers, the hemisphere, radiance. */
#define DEMO "../demos/demo07_monte_carlo.c"
#include "test.h"

static const rt_scene empty; /* all zero */

/* ---- random numbers ----------------------------------------------------------------- */

static void test_hash_is_one_to_one(void **state)
{
    /* Both steps can be undone, so no two inputs share an output; here for 2^20 of them. */
    (void)state;
    static unsigned char seen[1 << 29]; /* a bit for each of the 2^32 outputs */
    for (uint32_t i = 0; i < 1u << 20; i++) {
        const uint32_t h = rt_hash(i * 4093u);
        assert_false(seen[h >> 3] >> (h & 7) & 1);
        seen[h >> 3] = (unsigned char)(seen[h >> 3] | 1 << (h & 7));
    }
}

static void test_random_is_uniform_and_below_one(void **state)
{
    /* 256 bins of 2^20 numbers: chi-square has mean 255, standard deviation 22.6. */
    (void)state;
    enum { N = 1 << 20, BINS = 256 };
    int bins[BINS] = {0};
    float largest = 0;
    for (uint32_t i = 0; i < N / 16; i++) {
        rt_rng rng = rt_rng_start(i, 0, 0);
        for (int k = 0; k < 16; k++) {
            const float r = rt_random(&rng);
            assert_true(r > 0 && r < 1);
            assert_true(r * 8388608.0f - 0.5f == floorf(r * 8388608.0f)); /* exact */
            largest = r > largest ? r : largest;
            bins[(int)(r * BINS)]++;
        }
    }
    double chi2 = 0;
    for (int i = 0; i < BINS; i++)
        chi2 += pow(bins[i] - N / BINS, 2) / (N / BINS);
    assert_in_range((int)chi2, 255 - 90, 255 + 90);
    assert_true(largest > 0.99999f);
}

static void test_the_largest_random_number_is_below_one(void **state)
{
    (void)state;
    assert_true(((float)(UINT32_MAX >> 9) + 0.5f) * (1.0f / 8388608.0f) < 1.0f);
}

static void test_numbers_of_different_samples_are_independent(void **state)
{
    /* Pairs of neighbours - next number, next pixel, next sample, next seed - fill a grid of
     * 16 x 16 evenly: chi-square has mean 255, standard deviation 22.6. */
    (void)state;
    enum { N = 1 << 16 };
    for (int kind = 0; kind < 4; kind++) {
        int bins[256] = {0};
        for (uint32_t i = 0; i < N; i++) {
            rt_rng a = rt_rng_start(i, 3, 5);
            rt_rng b = rt_rng_start(i + (kind == 1), 3 + (kind == 2), 5 + (kind == 3));
            if (kind == 0)
                rt_random(&b);
            const float u = rt_random(&a), v = rt_random(&b);
            bins[(int)(u * 16) * 16 + (int)(v * 16)]++;
        }
        double chi2 = 0;
        for (int i = 0; i < 256; i++)
            chi2 += pow(bins[i] - N / 256, 2) / (N / 256);
        assert_in_range((int)chi2, 255 - 90, 255 + 90);
    }
}

static void test_the_same_numbers_again(void **state)
{
    (void)state;
    rt_rng a = rt_rng_start(7, 8, 9), b = rt_rng_start(7, 8, 9),
           c = rt_rng_start(7, 8, 10);
    int different = 0;
    for (int i = 0; i < 100; i++) {
        const float x = rt_random(&a), y = rt_random(&b), z = rt_random(&c);
        assert_close(x, y, 0);
        different += x != z;
    }
    assert_true(different > 90);
}

/* ---- the hemisphere ----------------------------------------------------------------- */

static void test_sample_cosine_by_hand(void **state)
{
    /* About z the basis is x, y: r1 = 0 points to x, a quarter turn to y. */
    (void)state;
    const rt_vec3 z = {0, 0, 1};
    assert_vec(rt_sample_cosine(z, 0, 0.36f), 0.8, 0, 0.6, 1e-7);
    assert_vec(rt_sample_cosine(z, 0.25f, 0.36f), 0, 0.8, 0.6, 1e-7);
    assert_vec(rt_sample_cosine(z, 0.5f, 0.75f), -0.5, 0, 0.8660254, 1e-7);
    assert_vec(rt_sample_cosine(z, 0, 0), 1, 0, 0, 0);
}

static void test_sample_cosine_is_of_unit_length_and_above(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 23);
    for (int i = 0; i < 200000; i++) {
        const rt_vec3 n = random_direction(&rng);
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 d = rt_sample_cosine(n, r1, r2);
        assert_close(rt_length(d), 1, 5e-7);
        assert_close(rt_dot(d, n), sqrtf(r2), 5e-7);
    }
}

static void test_sample_cosine_has_the_density_of_the_cosine(void **state)
{
    /* 20 x 20 bins of equal probability: in the angle about N, and in cosine^2, which is
     * uniform when the density is cosine/pi. Measured by dot products with the test's own
     * basis. chi-square: 399 degrees, standard deviation 28. */
    (void)state;
    enum { N = 1000000, SIDE = 20 };
    const rt_vec3 normals[] = {{0, 0, 1}, {0, 0, -1}, {0.6f, 0, 0.8f}, {0, -1, 0}};
    const rt_vec3 tangents[] = {{1, 0, 0}, {0, 1, 0}, {0, 1, 0}, {0.6f, 0, 0.8f}};
    for (size_t k = 0; k < COUNT(normals); k++) {
        int bins[SIDE * SIDE] = {0};
        const rt_vec3 a = tangents[k], b = rt_cross(normals[k], a);
        for (uint32_t i = 0; i < N; i++) {
            rt_rng rng = rt_rng_start(i, 0, 24);
            const float r1 = rt_random(&rng);
            const float r2 = rt_random(&rng);
            const rt_vec3 d = rt_sample_cosine(normals[k], r1, r2);
            const float cosine = rt_dot(d, normals[k]);
            const double turn = atan2((double)rt_dot(d, b), (double)rt_dot(d, a));
            const int row = (int)(SIDE * 0.999999f * cosine * cosine);
            const int column = (int)(SIDE * 0.999999 * (turn / 6.283185307 + 0.5));
            bins[row * SIDE + column]++;
        }
        double chi2 = 0;
        for (int i = 0; i < SIDE * SIDE; i++)
            chi2 += pow(bins[i] - N / SIDE / SIDE, 2) / (N / SIDE / SIDE);
        print_message("chi-square of the hemisphere: %.1f of 399\n", chi2);
        assert_in_range((int)chi2, 399 - 112, 399 + 112);
    }
}

/* ---- radiance, where it is known exactly -------------------------------------------- */

/* A closed sphere of radius 10 about a light of 100 pi W/sr, albedo 1/2: direct light is
 * rho/pi . I / R^2 = 1/2 everywhere, and every bounce adds rho times the one before. */
static void test_the_integrating_sphere(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, 0}, 10, {{0.5f, 0.5f, 0.5f}, false}};
    const rt_light light = {{0, 0, 0}, {314.15927f, 314.15927f, 314.15927f}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    const rt_camera camera = {{2, 1, 5}, {-2, -1, -5}, {0, 1, 0}, 70};
    const int bounces[] = {0, 1, 2, 5};
    const double exact[] = {0.5, 0.75, 0.875, 0.984375};
    for (size_t i = 0; i < COUNT(bounces); i++) {
        rt_image image = new_image(80, 60);
        rt_options options = {0};
        options.samples = 4;
        options.bounces = bounces[i];
        assert_int_equal(rt_render(&scene, &camera, &options, &image), RT_OK);
        for (int k = 0; k < 80 * 60; k++)
            assert_vec(image.pixels[k], exact[i], exact[i], exact[i], 1e-5);
        free(image.pixels);
    }
}

/* A closed sphere of radius 10 and grey albedo rho with the light anywhere inside. What
 * the light sends to a point is rho/pi . I cos/d^2; bounced light comes back evenly from
 * all sides, wherever it first fell, since a sphere lights itself evenly:
 *
 *     rho/pi . (I cos/d^2 + I/R^2 . sum of rho^k, k = 1..n).
 *
 * The mean ratio of N estimates to that, within 4 standard errors and half a per cent. */
static void check_furnace(float rho, int bounces, rt_vec3 lamp)
{
    enum { N = 20000 };
    const double pi = 3.14159265358979;
    const rt_sphere sphere = {{0, 0, 0}, 10, {{rho, rho, rho}, false}};
    const rt_light light = {lamp, {60, 90, 120}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    double series = 0, sum = 0, squares = 0;
    for (int k = 1; k <= bounces; k++)
        series += pow((double)rho, k);
    rt_rng directions = rt_rng_start(0, (uint32_t)bounces, 25);
    for (uint32_t i = 0; i < N; i++) {
        const rt_ray ray = ray_of(rt_vec(-4, 2, 5), random_direction(&directions));
        rt_rng rng = rt_rng_start(i, 0, 26);
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        const rt_vec3 l = rt_sub(lamp, hit.point);
        const double dd = (double)rt_dot(l, l);
        const double cosine = (double)rt_dot(hit.normal, l) / sqrt(dd);
        const double exact = (double)rho / pi * (cosine / dd + series / 100);
        const rt_vec3 value = rt_radiance(&scene, &ray, bounces, &rng);
        const double ratio = (double)value.x / 60 / exact;
        assert_close((double)value.y / 90 / exact, ratio, 1e-5 * ratio);
        assert_close((double)value.z / 120 / exact, ratio, 1e-5 * ratio);
        sum += ratio / N;
        squares += ratio * ratio / N;
    }
    const double sigma = sqrt(fmax(squares - sum * sum, 0) / N);
    assert_close(sum, 1, 4 * sigma + 1e-5);
    assert_close(sum, 1, 0.005);
}

static void test_furnaces(void **state)
{
    (void)state;
    const float albedos[] = {0.3f, 0.5f, 0.8f};
    const int bounces[] = {0, 1, 2, 5, 20};
    const rt_vec3 lamps[] = {{0, 0, 0}, {3, -2, 1}, {-5, 0, 5}};
    for (size_t i = 0; i < COUNT(albedos); i++)
        for (size_t j = 0; j < COUNT(bounces); j++)
            for (size_t k = 0; k < COUNT(lamps); k++)
                check_furnace(albedos[i], bounces[j], lamps[k]);
}

/* How many of N rays that leave sphere a, evenly spread and by cosine, meet sphere b. */
static double hits_from(const rt_sphere *a, const rt_sphere *b, uint32_t n)
{
    uint32_t hits = 0;
    for (uint32_t i = 0; i < n; i++) {
        rt_rng rng = rt_rng_start(i, 0, 27);
        const rt_vec3 normal = random_direction(&rng);
        const rt_vec3 point = rt_add(a->center, rt_scale(normal, a->radius));
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_vec3 d = rt_sample_cosine(normal, r1, r2);
        const rt_ray ray = ray_of(rt_leave(point, normal, d), d);
        rt_hit hit = untouched;
        hits += rt_hit_sphere(b, &ray, FLT_MAX, &hit);
    }
    return hits;
}

static void test_reciprocity(void **state)
{
    /* What a sends to b, b sends to a. The area times the part of its light that arrives
     * is the same both ways, A_a F_ab = A_b F_ba. */
    (void)state;
    const rt_sphere a = {{0, 0, 0}, 1, {{1, 1, 1}, false}};
    const rt_sphere b = {{1, 2, -5}, 3, {{1, 1, 1}, false}};
    const uint32_t n = 400000;
    const double there = hits_from(&a, &b, n), back = hits_from(&b, &a, n);
    const double ratio = there / (9 * back);
    const double sigma = sqrt(1 / there + 1 / back);
    assert_true(sigma < 0.02);
    assert_close(ratio, 1, 4 * sigma);
}

static void test_a_white_sphere_in_white_surroundings_cannot_be_seen(void **state)
{
    /* Background 1 from everywhere: a convex body of albedo rho sends back exactly rho. */
    (void)state;
    rt_sphere sphere = {{0, 0, -5}, 2, {{1, 0.5f, 0}, false}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    scene.background = rt_vec(1, 1, 1);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0.1f, 0.2f, -1));
    for (uint32_t i = 0; i < 10000; i++) {
        rt_rng rng = rt_rng_start(i, 0, 27);
        assert_vec(rt_radiance(&scene, &ray, 1 + (int)(i % 4), &rng), 1, 0.5, 0, 0);
    }
    const rt_ray past = ray_of(rt_vec(0, 0, 0), rt_vec(0, 1, 0));
    rt_rng rng = rt_rng_start(0, 0, 27);
    assert_vec(rt_radiance(&scene, &past, 0, &rng), 1, 1, 1, 0);
    assert_vec(rt_radiance(&scene, &ray, 0, &rng), 0, 0, 0, 0);
    sphere.material.mirror = true;
    sphere.material.albedo = rt_vec(0.3f, 0.2f, 0.1f);
    assert_vec(rt_radiance(&scene, &ray, 1, &rng), 0.3, 0.2, 0.1, 1e-7);
}

static void test_black_ends_the_path(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, 0}, 10, {{0, 0, 0}, false}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_rng rng = rt_rng_start(0, 0, 0);
    assert_vec(rt_radiance(&scene, &ray, 1000000, &rng), 0, 0, 0, 0);
    assert_int_equal(rng.rays, 1);
}

static void test_a_million_bounces_end(void **state)
{
    /* Half of the light is lost at each bounce: after 150 or so nothing is left. */
    (void)state;
    const rt_sphere sphere = {{0, 0, 0}, 10, {{0.5f, 0.5f, 0.5f}, false}};
    rt_scene scene = empty;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_rng rng = rt_rng_start(0, 0, 0);
    rt_radiance(&scene, &ray, 1000000, &rng);
    assert_in_range(rng.rays, 100, 200);
}

static void test_a_ray_that_is_no_ray_sees_the_background(void **state)
{
    (void)state;
    rt_scene scene = scene_indirect;
    scene.background = rt_vec(1, 2, 3);
    const rt_ray bad[] = {ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, 0)),
                          ray_of(rt_vec(NAN, 0, 0), rt_vec(0, 0, -1)),
                          ray_of(rt_vec(0, 0, 0), rt_vec(0, INFINITY, 0))};
    for (size_t i = 0; i < COUNT(bad); i++) {
        rt_rng rng = rt_rng_start(0, 0, 0);
        assert_vec(rt_radiance(&scene, &bad[i], 5, &rng), 1, 2, 3, 0);
    }
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_sample_cosine_is_rt_sample_cosine(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 28);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 n = random_direction(&rng);
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 theirs = sample_cosine(n, r1, r2),
                      ours = rt_sample_cosine(n, r1, r2);
        assert_vec(theirs, ours.x, ours.y, ours.z, 0);
    }
}

static void test_demo_radiance_is_rt_radiance(void **state)
{
    /* The same random numbers, the same path, the same bits, in scenes of all kinds. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 29);
    int bright = 0;
    for (uint32_t i = 0; i < 20000; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        for (size_t k = 0; k < COUNT(r.spheres);
             k++) /* the demo's mirrors lose nothing */
            if (r.spheres[k].material.mirror)
                r.spheres[k].material.albedo = rt_vec(1, 1, 1);
        for (size_t k = 0; k < COUNT(r.boxes); k++)
            if (r.boxes[k].material.mirror)
                r.boxes[k].material.albedo = rt_vec(0, 0, 0); /* means 1 */
        const rt_ray ray = random_ray(&rng);
        const int bounces = (int)(i % 7);
        rt_rng a = rt_rng_start(i, 1, 30), b = a;
        const rt_vec3 theirs = radiance(&r.scene, ray, bounces, &a);
        const rt_vec3 ours = rt_radiance(&r.scene, &ray, bounces, &b);
        assert_vec(theirs, ours.x, ours.y, ours.z, 0);
        assert_int_equal(a.rays, b.rays);
        bright += ours.x > 0;
    }
    assert_in_range(bright, 2000, 19000);
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    rt_image theirs = render_the_demo(80, 60, 3, 5), ours = new_image(80, 60);
    rt_options options = {.samples = 3, .bounces = 5, .seed = 5, .sampler = RT_RANDOM};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &ours), RT_OK);
    assert_true(same_pixels(&theirs, &ours));
    assert_int_equal(theirs.rays, ours.rays);
    free(theirs.pixels);
    free(ours.pixels);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_hash_is_one_to_one),
        cmocka_unit_test(test_random_is_uniform_and_below_one),
        cmocka_unit_test(test_the_largest_random_number_is_below_one),
        cmocka_unit_test(test_numbers_of_different_samples_are_independent),
        cmocka_unit_test(test_the_same_numbers_again),
        cmocka_unit_test(test_sample_cosine_by_hand),
        cmocka_unit_test(test_sample_cosine_is_of_unit_length_and_above),
        cmocka_unit_test(test_sample_cosine_has_the_density_of_the_cosine),
        cmocka_unit_test(test_the_integrating_sphere),
        cmocka_unit_test(test_furnaces),
        cmocka_unit_test(test_reciprocity),
        cmocka_unit_test(test_a_white_sphere_in_white_surroundings_cannot_be_seen),
        cmocka_unit_test(test_black_ends_the_path),
        cmocka_unit_test(test_a_million_bounces_end),
        cmocka_unit_test(test_a_ray_that_is_no_ray_sees_the_background),
        cmocka_unit_test(test_demo_sample_cosine_is_rt_sample_cosine),
        cmocka_unit_test(test_demo_radiance_is_rt_radiance),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("7 Monte Carlo", tests, NULL, NULL);
}

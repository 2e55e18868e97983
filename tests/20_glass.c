/* Chapter 11: glass. */
#define DEMO "../demos/demo11_glass.c"
#include "test.h"

static const rt_scene empty; /* all zero */
static const double pi = 3.14159265358979;

/* Fresnel's formula in double; sin^2 t, 1 and more where there is no way through, in *sin2. */
static double exact_fresnel(double cosine, double eta, double *sin2)
{
    *sin2 = (1 - cosine * cosine) / (eta * eta);
    if (*sin2 >= 1)
        return 1;
    const double through = sqrt(1 - *sin2);
    const double p = (eta * cosine - through) / (eta * cosine + through);
    const double s = (cosine - eta * through) / (cosine + eta * through);
    return (p * p + s * s) / 2;
}

static double schlick(double cosine, double eta)
{
    const double f0 = (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1));
    return f0 + (1 - f0) * pow(1 - cosine, 5);
}

static float any_eta(rt_rng *rng)
{
    const float eta = uniform(rng, 1.0f, 4.0f);
    return rt_random(rng) < 0.5f ? eta : 1.0f / eta;
}

/* A direction onto a surface with this normal, all angles equally likely. */
static rt_vec3 onto(rt_rng *rng, rt_vec3 normal)
{
    const rt_vec3 d = random_direction(rng);
    return rt_dot(d, normal) < 0.0f ? d : rt_scale(d, -1.0f);
}

/* ---- how much is reflected ---------------------------------------------------------- */

static void test_fresnel_straight_on_and_flat(void **state)
{
    (void)state;
    assert_close(rt_fresnel(1, 1.5f), 0.04, 1e-8);
    assert_close(rt_fresnel(1, 1 / 1.5f), 0.04, 2e-8);
    assert_close(rt_fresnel(1, 2.42f), pow(1.42 / 3.42, 2), 1e-7);
    assert_close(rt_fresnel(0, 1.5f), 1, 0);
    assert_close(rt_fresnel(0, 1 / 1.5f), 1, 0);
    assert_close(rt_fresnel(0.5f, 1 / 1.5f), 1, 0); /* 60 degrees; critical are 41.8 */
}

static void test_fresnel_at_brewsters_angle(void **state)
{
    /* At tan i = eta, p is 0: i and t make a right angle, cos t = sin i. */
    (void)state;
    const double cosine = 1 / sqrt(1 + 1.5 * 1.5);
    assert_close(acos(cosine) * 180 / pi, 56.31, 0.005);
    assert_close(rt_fresnel((float)cosine, 1.5f), 0.0739645, 1e-7);
}

static void test_fresnel_against_double(void **state)
{
    /* Within 2e-5, except near the critical angle, where F rises like a root. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 200);
    double worst = 0, worst_near = 0;
    for (int i = 0; i < 1000000; i++) {
        const float cosine = rt_random(&rng), eta = any_eta(&rng);
        double sin2;
        const double f = exact_fresnel((double)cosine, (double)eta, &sin2);
        const double error = fabs((double)rt_fresnel(cosine, eta) - f);
        double *most = fabs(1 - sin2) < 1e-3 ? &worst_near : &worst;
        *most = error > *most ? error : *most;
    }
    assert_close(worst, 0, 2e-5);
    assert_close(worst_near, 0, 2e-3);
}

static void test_fresnel_both_ways_is_the_same(void **state)
{
    /* From outside at the angle i, and from inside at the corresponding angle t. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 201);
    for (int i = 0; i < 100000; i++) {
        const float cosine = uniform(&rng, 0.05f, 1), eta = uniform(&rng, 1.05f, 4);
        const double sin2 = (1 - (double)cosine * (double)cosine) / ((double)eta * eta);
        const float through = (float)sqrt(1 - sin2);
        assert_close(rt_fresnel(through, 1 / eta), rt_fresnel(cosine, eta), 2e-4);
    }
}

/* The mean over all directions from which light falls: of F 2 cos d(cos). */
static double mean_fresnel(float eta)
{
    enum { N = 1000000 };
    double sum = 0;
    for (int i = 0; i < N; i++) {
        const double cosine = (i + 0.5) / N;
        sum += (double)rt_fresnel((float)cosine, eta) * 2 * cosine;
    }
    return sum / N;
}

static void test_fresnel_in_the_mean(void **state)
{
    /* Outside 0.091778. Inside, only directions within the critical angle get out, the
     * part 1 / eta^2 of all, and with as much of their light as gets in: 1 - (1 -
     * 0.091778) / 2.25. */
    (void)state;
    const double outside = mean_fresnel(1.5f), inside = mean_fresnel(1 / 1.5f);
    assert_close(outside, 0.091778, 1e-6);
    assert_close(inside, 0.596346, 2e-6);
    assert_close(inside, 1 - (1 - outside) / 2.25, 2e-6);
}

static void test_schlick_and_his_trap(void **state)
{
    /* His approximation is off by 0.036 from outside. From inside it is as good with the angle
     * outside, and with the angle inside it is off by 0.771. */
    (void)state;
    double from_air = 0, outer_angle = 0, inner_angle = 0;
    for (int i = 0; i <= 100000; i++) {
        const double cosine = i / 100000.0, sin2 = (1 - cosine * cosine) * 2.25;
        const double outer = sin2 < 1 ? sqrt(1 - sin2) : 0;
        const double air =
            fabs(schlick(cosine, 1.5) - (double)rt_fresnel((float)cosine, 1.5f));
        const double inside = (double)rt_fresnel((float)cosine, 1 / 1.5f);
        from_air = air > from_air ? air : from_air;
        if (sin2 >= 1) /* total reflection is another case of the listing */
            continue;
        const double good = fabs(schlick(outer, 1.5) - inside);
        const double bad = fabs(schlick(cosine, 1.5) - inside);
        outer_angle = good > outer_angle ? good : outer_angle;
        inner_angle = bad > inner_angle ? bad : inner_angle;
    }
    assert_close(from_air, 0.036, 1e-3);
    assert_close(outer_angle, 0.036, 1e-3);
    assert_in_range((int)(1000 * inner_angle), 700, 960);
}

static void test_eta_1_reflects_nothing(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 202);
    for (int i = 0; i < 100000; i++) {
        const float cosine = uniform(&rng, 0.01f, 1);
        assert_close(rt_fresnel(cosine, 1), 0, 1e-7);
    }
}

/* ---- where the rest goes ------------------------------------------------------------ */

static void test_refract_is_snells_law(void **state)
{
    /* |eta sin t - sin i| and ||T| - 1|; T is in the plane of I and N, behind the surface. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 203);
    double worst_law = 0, worst_length = 0;
    int through = 0;
    for (int i = 0; i < 300000; i++) {
        const rt_vec3 n = random_direction(&rng), d = onto(&rng, n);
        const float eta = any_eta(&rng);
        rt_vec3 t;
        if (!rt_refract(d, n, eta, &t))
            continue;
        through++;
        const rt_dvec3 dn = rt_to_double(n);
        const rt_dvec3 across = rt_dcross(rt_to_double(d), dn),
                       on = rt_dcross(rt_to_double(t), dn);
        const rt_dvec3 differ = rt_dmad(across, -(double)eta, on);
        /* relative to its terms: I / eta is up to 4 long */
        const double size = eta > 1 ? (double)eta : 1;
        const double law = sqrt(rt_ddot(differ, differ)) / size;
        const double length = fabs((double)rt_length(t) - 1);
        worst_law = law > worst_law ? law : worst_law;
        worst_length = length > worst_length ? length : worst_length;
        assert_true(rt_dot(t, n) < 1e-6f);
    }
    assert_true(through > 150000);
    assert_close(worst_law, 0, 3e-7);
    assert_close(worst_length, 0, 2e-6);
}

static void test_refract_straight_on_goes_straight_on(void **state)
{
    (void)state;
    rt_vec3 t = {7, 7, 7};
    assert_true(rt_refract(rt_vec(0, -1, 0), rt_vec(0, 1, 0), 1.5f, &t));
    assert_vec(t, 0, -1, 0, 1e-7);
    assert_true(rt_refract(rt_vec(0, -1, 0), rt_vec(0, 1, 0), 1 / 1.5f, &t));
    assert_vec(t, 0, -1, 0, 1e-7);
    /* 45 degrees into glass: sin t = 0.4714, toward the normal */
    const float h = 0.70710678f;
    assert_true(rt_refract(rt_vec(h, -h, 0), rt_vec(0, 1, 0), 1.5f, &t));
    assert_vec(t, 0.47140452, -0.88191710, 0, 1e-6);
}

static void test_refract_there_and_back(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 204);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 n = random_direction(&rng), d = onto(&rng, n);
        const float eta = uniform(&rng, 1.05f, 4);
        rt_vec3 t = {7, 7, 7}, back = t;
        assert_true(rt_refract(d, n, eta, &t));
        if (rt_dot(d, n) > -0.05f) /* too flat to tell */
            continue;
        assert_true(rt_refract(rt_scale(t, -1), rt_scale(n, -1), 1 / eta, &back));
        assert_vec(back, -d.x, -d.y, -d.z, 1e-4);
    }
}

static void test_total_reflection_where_it_should_be(void **state)
{
    /* 0 wrong of a million; within a rounding of the critical angle either answer will
     * do. Where there is no direction, *refracted is left alone, and F is 1. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 205);
    int total = 0, wrong = 0;
    for (int i = 0; i < 1000000; i++) {
        const float cosine = rt_random(&rng), eta = 1 / uniform(&rng, 1, 4);
        const float sine = sqrtf((1 - cosine) * (1 + cosine));
        const rt_vec3 d = {sine, -cosine, 0}, n = {0, 1, 0};
        rt_vec3 t = {7, 7, 7};
        double sin2;
        exact_fresnel((double)cosine, (double)eta, &sin2);
        const bool found = rt_refract(d, n, eta, &t);
        if (fabs(sin2 - 1) > 1e-6)
            wrong += found != (sin2 < 1);
        if (!found) {
            total++;
            assert_vec(t, 7, 7, 7, 0);
            assert_close(rt_fresnel(cosine, eta), 1, 0);
        }
    }
    assert_int_equal(wrong, 0);
    assert_in_range(total, 400000, 950000);
}

/* ---- Beer's law --------------------------------------------------------------------- */

static void test_transmittance_is_the_exponential(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 206);
    double worst = 0;
    for (int i = 0; i < 1000000; i++) {
        const float x = 87 * rt_random(&rng);
        const double part = (double)rt_transmittance(rt_vec(x, 0, 0), 1).x;
        const double error = fabs(part / exp(-(double)x) - 1);
        worst = error > worst ? error : worst;
    }
    assert_close(worst, 0, 2e-7);
}

static void test_transmittance_of_odd_numbers(void **state)
{
    (void)state;
    const float below = nextafterf(87, 0);
    assert_vec(rt_transmittance(rt_vec(0, 1e-30f, -1), 1), 1, 1, 1, 0);
    assert_vec(rt_transmittance(rt_vec(87, 1e15f, INFINITY), 1), 0, 0, 0, 0);
    assert_vec(rt_transmittance(rt_vec(NAN, 0, 1), 1), 1, 1, exp(-1), 3e-8);
    assert_true(rt_transmittance(rt_vec(below, 0, 0), 1).x > 1.6e-38f);
    assert_vec(rt_transmittance(rt_vec(1e15f, 1, 0), FLT_MAX), 0, 0, 1, 0);
    assert_vec(rt_transmittance(rt_vec(0.5f, 1, 2), 3), exp(-1.5), exp(-3), exp(-6),
               1e-7);
}

static void test_two_ways_are_one_long_way(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 207);
    for (int i = 0; i < 100000; i++) {
        const float a = 10 * rt_random(&rng), b = 10 * rt_random(&rng);
        const rt_vec3 one = {1, 1, 1};
        const double both = (double)rt_transmittance(one, a + b).x;
        const double each =
            (double)rt_transmittance(one, a).x * (double)rt_transmittance(one, b).x;
        assert_close(each / both, 1, 3e-6);
    }
}

/* ---- shapes ------------------------------------------------------------------------- */

static rt_vec3 seen_by_a_sky(const void *data, rt_vec3 direction)
{
    rt_vec3 *seen = *(rt_vec3 *const *)data;
    *seen = direction;
    return rt_vec(1, 1, 1);
}

static const rt_sphere ball = {{0, 0, -5}, 1, {{0, 0, 0}, false}};
static const rt_box slab = {{-50, -50, -6}, {50, 50, -4}, {{0, 0, 0}, false}};

static rt_scene of_sphere(const rt_sphere *sphere, const rt_surface *surface)
{
    rt_scene scene = empty;
    scene.spheres = sphere;
    scene.sphere_count = 1;
    scene.surfaces = surface;
    return scene;
}

static rt_scene of_box(const rt_box *box, const rt_surface *surface)
{
    rt_scene scene = empty;
    scene.boxes = box;
    scene.box_count = 1;
    scene.surfaces = surface;
    return scene;
}

static void test_the_table_has_spheres_and_then_boxes(void **state)
{
    (void)state;
    rt_surface table[4] = {{0}};
    const rt_sphere spheres[2] = {{{-3, 0, -5}, 1, {{1, 1, 1}, false}},
                                  {{0, 0, -5}, 1, {{1, 1, 1}, false}}};
    const rt_box boxes[2] = {{{2, -1, -6}, {3, 1, -4}, {{1, 1, 1}, false}},
                             {{5, -1, -6}, {6, 1, -4}, {{1, 1, 1}, false}}};
    rt_scene scene = empty;
    scene.spheres = spheres;
    scene.sphere_count = 2;
    scene.boxes = boxes;
    scene.box_count = 2;
    const float x[4] = {-3, 0, 2.5f, 5.5f};
    for (int i = 0; i < 4; i++)
        for (int with = 0; with < 2; with++) {
            const rt_ray ray = ray_of(rt_vec(x[i], 0, 0), rt_vec(0, 0, -1));
            rt_hit hit = untouched;
            scene.surfaces = with ? table : NULL;
            assert_true(rt_intersect(&scene, &ray, &hit));
            const rt_surface *surface = rt_surface_of(&scene, &hit);
            if (with) {
                assert_ptr_equal(surface, &table[i]);
                continue;
            }
            assert_true(surface->eta == 0 && surface->shininess == 0 &&
                        rt_is_zero(surface->absorption) &&
                        rt_is_zero(surface->emission) && !surface->pattern);
        }
}

static void test_inside_is_inside(void **state)
{
    /* Rays that begin in or out of balls and boxes of any place and proportion. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 208);
    int in = 0, out = 0;
    for (int i = 0; i < 200000; i++) {
        const rt_sphere sphere = {.center = random_point(&rng, 30),
                                  .radius = uniform(&rng, 0.1f, 20)};
        const rt_vec3 corner = random_point(&rng, 30), size = random_colour(&rng);
        const rt_box box = {.min = corner, .max = rt_add(corner, rt_scale(size, 20))};
        const bool use_box = i % 2 != 0;
        const rt_scene scene = use_box ? of_box(&box, NULL) : of_sphere(&sphere, NULL);
        const rt_vec3 middle =
            use_box ? rt_scale(rt_add(box.min, box.max), 0.5f) : sphere.center;
        const rt_vec3 from =
            i % 4 < 2 ? random_point(&rng, 60) : rt_add(middle, random_point(&rng, 0.3f));
        const rt_ray ray =
            ray_of(from, rt_add(rt_sub(middle, from), random_point(&rng, 0.5f)));
        rt_hit hit = untouched;
        if (!rt_intersect(&scene, &ray, &hit))
            continue;
        const bool inside = use_box ? from.x > box.min.x && from.x < box.max.x &&
                                          from.y > box.min.y && from.y < box.max.y &&
                                          from.z > box.min.z && from.z < box.max.z
                                    : rt_length(rt_sub(from, middle)) < sphere.radius;
        assert_int_equal(rt_is_inside(&scene, &hit), inside);
        in += inside;
        out += !inside;
    }
    assert_true(in > 50000 && out > 50000);
}

/* The sample with the first seed for which the path takes this many rays. */
static rt_vec3 with_rays(const rt_scene *scene, const rt_ray *ray, int bounces,
                         uint32_t rays)
{
    for (uint32_t seed = 0; seed < 10000; seed++) {
        rt_rng rng = rt_rng_start(0, 0, seed);
        const rt_vec3 value = rt_radiance_mis(scene, ray, bounces, &rng);
        if (rng.rays == rays)
            return value;
    }
    fail_msg("no path of %d rays", (int)rays);
    return rt_vec(0, 0, 0);
}

static void test_a_surface_of_glass_is_one_bounce(void **state)
{
    /* Straight through a ball: two surfaces. With one bounce the path ends inside; the
     * extra ray that is then sent is for lamps only. */
    (void)state;
    const rt_surface glass = {.eta = 1.5f};
    rt_scene scene = of_sphere(&ball, &glass);
    scene.background = rt_vec(1, 2, 3);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    assert_vec(with_rays(&scene, &ray, 2, 3), 1, 2, 3, 0);
    assert_vec(with_rays(&scene, &ray, 3, 3), 1, 2, 3, 0);
    assert_vec(with_rays(&scene, &ray, 1, 3), 0, 0, 0, 0);
    assert_vec(with_rays(&scene, &ray, 1, 2), 1, 2, 3, 0); /* reflected at once */
    assert_vec(with_rays(&scene, &ray, 0, 2), 0, 0, 0, 0);
    assert_vec(with_rays(&scene, &ray, 5, 6), 1, 2, 3, 0); /* three times to and fro */
}

static void test_the_coin_shows_reflected_as_often_as_fresnel_says(void **state)
{
    (void)state;
    enum { N = 100000 };
    const rt_surface glass = {.eta = 1.5f};
    rt_vec3 seen, *const to = &seen;
    rt_scene scene = of_box(&slab, &glass);
    scene.sky = seen_by_a_sky;
    scene.sky_data = &to;
    const float cosines[] = {1, 0.7f, 0.4f, 0.15f};
    for (size_t k = 0; k < COUNT(cosines); k++) {
        const float sine = sqrtf(1 - cosines[k] * cosines[k]);
        const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(sine, 0, -cosines[k]));
        int reflected = 0;
        for (uint32_t i = 0; i < N; i++) {
            rt_rng rng = rt_rng_start(i, 0, 209);
            rt_radiance_mis(&scene, &ray, 100, &rng);
            reflected += rng.rays == 2;
        }
        const double f = (double)rt_fresnel(cosines[k], 1.5f);
        assert_close(reflected / (double)N, f, 4 * sqrt(f * (1 - f) / N));
    }
}

static void test_a_ball_bends_a_ray_twice(void **state)
{
    /* A ray that passes the middle at the distance b comes in at the angle i, sin i = b / R, and
     * goes out turned by 2 (i - t). */
    (void)state;
    const rt_surface glass = {.eta = 1.5f};
    rt_vec3 seen, *const to = &seen;
    rt_scene scene = of_sphere(&ball, &glass);
    scene.sky = seen_by_a_sky;
    scene.sky_data = &to;
    for (int k = 0; k < 20; k++) {
        const float b = (float)k * 0.05f;
        const rt_ray ray = ray_of(rt_vec(b, 0, 0), rt_vec(0, 0, -1));
        with_rays(&scene, &ray, 2, 3);
        const double turn = 2 * (asin((double)b) - asin((double)b / 1.5));
        assert_vec(seen, -sin(turn), 0, -cos(turn), 1e-5);
    }
}

static void test_a_slab_lets_rays_go_on_as_they_came(void **state)
{
    (void)state;
    const rt_surface glass = {.eta = 1.5f};
    rt_vec3 seen, *const to = &seen;
    rt_scene scene = of_box(&slab, &glass);
    scene.sky = seen_by_a_sky;
    scene.sky_data = &to;
    rt_rng rng = rt_rng_start(0, 0, 210);
    for (int i = 0; i < 2000; i++) {
        const rt_vec3 d = onto(&rng, rt_vec(0, 0, 1));
        if (d.z > -0.2f)
            continue;
        const rt_ray ray = ray_of(rt_vec(0, 0, 0), d);
        with_rays(&scene, &ray, 2, 3);
        assert_vec(seen, d.x, d.y, d.z, 1e-6);
    }
}

static rt_vec3 half_a_sky(const void *data, rt_vec3 direction)
{
    (void)data;
    return direction.z < 0 ? rt_vec(1, 1, 1) : rt_vec(0, 0, 0);
}

static void test_a_slab_of_coloured_glass(void **state)
{
    /* Each way through it, at the angle t to the normal, leaves exp(-a d / cos t). All
     * ways together, each further trip to and fro adding a factor F^2:
     *
     *     (1 - F)^2 e / (1 - F^2 e^2),      e = exp(-a d / cos t). */
    (void)state;
    enum { N = 100000 };
    const rt_surface amber = {.eta = 1.5f, .absorption = {0, 0.1f, 0.5f}};
    rt_scene scene = of_box(&slab, &amber);
    scene.sky = half_a_sky;
    const float cosines[] = {1, 0.6f, 0.3f};
    for (size_t k = 0; k < COUNT(cosines); k++) {
        const double c = (double)cosines[k], way = 2 / sqrt(1 - (1 - c * c) / 2.25);
        const float sine = sqrtf(1 - cosines[k] * cosines[k]);
        const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(sine, 0, -cosines[k]));
        const double once[3] = {1, exp(-0.1 * way), exp(-0.5 * way)};
        assert_vec(with_rays(&scene, &ray, 2, 3), 1, once[1], once[2], 5e-6);
        assert_vec(with_rays(&scene, &ray, 9, 5), 1, pow(once[1], 3), pow(once[2], 3),
                   1e-5);
        double sum[3] = {0}, squares[3] = {0};
        for (uint32_t i = 0; i < N; i++) {
            rt_rng rng = rt_rng_start(i, 0, 211);
            const rt_vec3 v = rt_radiance_mis(&scene, &ray, 50, &rng);
            const double values[3] = {(double)v.x, (double)v.y, (double)v.z};
            for (int j = 0; j < 3; j++) {
                sum[j] += values[j];
                squares[j] += values[j] * values[j];
            }
        }
        const double f = (double)rt_fresnel(cosines[k], 1.5f);
        for (int j = 0; j < 3; j++) {
            const double e = once[j], mean = sum[j] / N;
            const double exact = (1 - f) * (1 - f) * e / (1 - f * f * e * e);
            assert_close(mean, exact, 4 * sqrt((squares[j] / N - mean * mean) / N));
        }
    }
}

static void test_only_what_is_inside_is_absorbed(void **state)
{
    (void)state;
    const rt_surface ink = {.eta = 1.5f, .absorption = {1e15f, 1e15f, 1e15f}};
    rt_scene scene = of_sphere(&ball, &ink);
    scene.background = rt_vec(1, 1, 1);
    const rt_ray ray = ray_of(rt_vec(0.9f, 0, 0), rt_vec(0, 0, -1));
    int reflected = 0;
    for (uint32_t i = 0; i < 1000; i++) {
        rt_rng rng = rt_rng_start(i, 0, 212);
        const rt_vec3 value = rt_radiance_mis(&scene, &ray, 50, &rng);
        const bool back = rng.rays == 2 && value.x == 1;
        assert_true(back || value.x == 0);
        reflected += back;
    }
    assert_in_range(reflected, 100, 250); /* F at sin i = 0.9: 0.163 */
}

static void test_the_material_of_glass_does_not_count(void **state)
{
    (void)state;
    const rt_surface glass = {.eta = 1.5f}, wet = {.eta = 1.5f, .shininess = 100};
    for (uint32_t i = 0; i < 200; i++) {
        rt_vec3 first = {0, 0, 0};
        for (int kind = 0; kind < 4; kind++) {
            rt_sphere sphere = ball;
            sphere.material.mirror = kind % 2 != 0;
            sphere.material.albedo = rt_scale(rt_vec(0.5f, 0.2f, 1), kind > 1 ? 1 : 0);
            rt_scene scene = of_sphere(&sphere, kind == 3 ? &wet : &glass);
            scene.sky = half_a_sky;
            const rt_ray ray = ray_of(rt_vec(0.5f, 0.1f, 0), rt_vec(0, 0, -1));
            rt_rng rng = rt_rng_start(i, 0, 213);
            const rt_vec3 value = rt_radiance_mis(&scene, &ray, 50, &rng);
            if (kind == 0)
                first = value;
            assert_memory_equal(&value, &first, sizeof first);
        }
    }
}

/* ---- pictures ----------------------------------------------------------------------- */

static rt_status render_glass(const rt_scene *scene, const rt_camera *camera, int bounces,
                              rt_image *image)
{
    const rt_options options = {.samples = 16, .bounces = bounces};
    return rt_render(scene, camera, &options, image);
}

static void test_clear_glass_vanishes_in_an_even_light(void **state)
{
    /* Reflected or not, every ray ends in the same light: a white furnace. Ball and box, of
     * several indices; every pixel is exactly 1. */
    (void)state;
    const float etas[] = {1, 1.33f, 1.5f, 2.42f, 4};
    for (size_t k = 0; k < COUNT(etas); k++) {
        const rt_surface glass[2] = {{.eta = etas[k]}, {.eta = etas[k]}};
        const rt_box box = {{1.5f, -1, -6}, {3, 0.5f, -4}, {{0, 0, 0}, false}};
        rt_scene scene = of_sphere(&ball, glass);
        scene.boxes = &box;
        scene.box_count = 1;
        scene.background = rt_vec(1, 1, 1);
        const rt_camera camera = {.position = {0.5f, 0.3f, 0}};
        rt_image image = new_image(40, 30);
        assert_int_equal(render_glass(&scene, &camera, 100000, &image), RT_OK);
        for (int i = 0; i < 40 * 30; i++)
            assert_vec(image.pixels[i], 1, 1, 1, 0);
        assert_true(image.rays > 40 * 30 * 16 + 10000);
        free(image.pixels);
    }
}

static void test_eta_1_is_invisible(void **state)
{
    /* A floor behind it, lit from the side: with two more bounces, the same values. */
    (void)state;
    const rt_sphere spheres[2] = {{{0, 0, -12}, 4, {{0.9f, 0.5f, 0.2f}, false}}, ball};
    const rt_surface table[2] = {{.eta = 0}, {.eta = 1}};
    const rt_light light = {{9, 9, -4}, {400, 300, 200}};
    rt_scene without = of_sphere(spheres, table), with = without;
    without.lights = with.lights = &light;
    without.light_count = with.light_count = 1;
    without.background = with.background = rt_vec(0.1f, 0.2f, 0.4f);
    with.sphere_count = 2;
    const rt_camera camera = {.position = {0, 0, 0}};
    rt_rng rng = rt_rng_start(0, 0, 214);
    int through = 0;
    for (int i = 0; i < 20000; i++) {
        const float x = uniform(&rng, 0, 40), y = uniform(&rng, 0, 30);
        const rt_ray ray = rt_camera_ray(&camera, 40, 30, x, y);
        rt_rng a = rt_rng_start(0, 0, 0), b = a;
        const rt_vec3 seen = rt_radiance_mis(&with, &ray, 2, &a),
                      expected = rt_radiance_mis(&without, &ray, 0, &b);
        rt_hit hit = untouched;
        if (!rt_intersect(&with, &ray, &hit) || hit.shape != 1)
            continue; /* where the two bounces would be different ones */
        through++;
        rt_hit behind = untouched;
        const bool found = rt_intersect(&without, &ray, &behind);
        /* at the very edge of the ball behind it, rounding decides what the ray meets */
        if (!found || rt_dot(behind.normal, ray.direction) < -0.1f)
            assert_vec(seen, expected.x, expected.y, expected.z, 1e-4);
    }
    assert_in_range(through, 1000, 19000);
}

static void test_no_ray_meets_the_surface_that_it_leaves(void **state)
{
    /* Inside a ball the next point is a chord away, 2 R cos t; outside there is none. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 215);
    int inside_hits = 0, left = 0, wrong = 0;
    for (int i = 0; i < 300000; i++) {
        const rt_sphere sphere = {.center = random_point(&rng, 40),
                                  .radius = uniform(&rng, 0.1f, 30)};
        const rt_scene scene = of_sphere(&sphere, NULL);
        const float eta = uniform(&rng, 1.05f, 4);
        const rt_vec3 n = random_direction(&rng), d = onto(&rng, n);
        rt_ray ray = ray_of(
            rt_add(rt_add(sphere.center, rt_scale(n, sphere.radius)), rt_scale(d, -3)),
            d);
        rt_hit hit = untouched;
        if (!rt_intersect(&scene, &ray, &hit) || rt_is_inside(&scene, &hit))
            continue;
        for (int k = 0; k < 4; k++) {
            const bool inside = rt_is_inside(&scene, &hit);
            rt_vec3 next;
            if (inside && k == 3)
                next = rt_reflect(ray.direction, hit.normal);
            else if (!rt_refract(ray.direction, hit.normal, inside ? 1 / eta : eta,
                                 &next))
                next = rt_reflect(ray.direction, hit.normal);
            const bool goes_in = rt_dot(hit.normal, next) < 0.0f ? !inside : inside;
            const float chord = 2 * sphere.radius * fabsf(rt_dot(hit.normal, next));
            ray = ray_of(rt_leave(hit.point, hit.normal, next), next);
            const bool found = rt_intersect(&scene, &ray, &hit);
            if (goes_in) {
                inside_hits++;
                wrong += !found || !(fabsf(hit.t - chord) < 1e-2f * chord + 1e-3f);
            } else {
                left++;
                wrong += found;
            }
            if (!found)
                break;
        }
    }
    assert_int_equal(wrong, 0);
    assert_true(inside_hits > 200000 && left > 200000);
}

static void test_a_box_of_glass_has_no_leaks(void **state)
{
    /* What goes in comes out through some face, at last: the path is never dark, even
     * through edges and corners, and the absorption fits the length of its way. */
    (void)state;
    const rt_box box = {{-1, -1, -6}, {1, 1, -4}, {{0, 0, 0}, false}};
    const rt_surface glass = {.eta = 1.5f};
    rt_scene scene = of_box(&box, &glass);
    scene.background = rt_vec(1, 1, 1);
    rt_rng rng = rt_rng_start(0, 0, 216);
    for (uint32_t i = 0; i < 100000; i++) {
        const rt_vec3 corner = {i % 2 ? 1 : -1.0f, i % 4 < 2 ? 1 : -1.0f,
                                i % 8 < 4 ? -4 : -6.0f};
        const rt_vec3 aim = i % 3 ? rt_add(rt_vec(0, 0, -5), random_point(&rng, 1))
                                  : rt_add(corner, random_point(&rng, 1e-4f));
        const rt_vec3 from =
            rt_add(rt_vec(0, 0, -5), rt_scale(random_direction(&rng), 9));
        const rt_ray ray = ray_of(from, rt_normalize(rt_sub(aim, from)));
        rt_rng path = rt_rng_start(i, 0, 217);
        assert_vec(rt_radiance_mis(&scene, &ray, 100000, &path), 1, 1, 1, 0);
        assert_in_range(path.rays, 1, 500);
    }
}

static void test_guides_look_through_glass(void **state)
{
    /* Behind a pane of glass the guide is the wall behind, its albedo less what the two surfaces
     * reflect. */
    (void)state;
    const rt_box boxes[2] = {{{-50, -50, -6}, {50, 50, -5}, {{0, 0, 0}, false}},
                             {{-50, -50, -11}, {50, 50, -10}, {{0.5f, 0.25f, 1}, false}}};
    const rt_surface table[2] = {{.eta = 1.5f}, {.eta = 0}};
    const rt_light light = {{0, 0, -8}, {1, 1, 1}};
    rt_scene scene = of_box(boxes, table);
    scene.box_count = 2;
    scene.lights = &light;
    scene.light_count = 1;
    rt_image image = new_image(4, 3);
    const rt_camera camera = {.fov_y = 1};
    image.half = new_image(4, 3).pixels;
    image.guides = calloc(12, sizeof *image.guides);
    assert_non_null(image.guides);
    assert_int_equal(render_glass(&scene, &camera, 4, &image), RT_OK);
    for (int i = 0; i < 12; i++) {
        const rt_guide *g = &image.guides[i];
        assert_close(g->point.z, -10, 1e-5);
        assert_close(g->normal.z, 1, 1e-5);
        assert_vec(g->albedo, 0.5 * 0.96 * 0.96, 0.25 * 0.96 * 0.96, 0.96 * 0.96, 1e-3);
        /* E = I cos / d^2, close to 1 / 4 here */
        assert_close(g->direct.z, 0.96 * 0.96 / 4 / pi, 1e-3);
    }
    free(image.guides);
    free(image.half);
    free(image.pixels);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_routines_are_those_of_rt_h(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 218);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 n = random_direction(&rng), d = onto(&rng, n);
        const float eta = any_eta(&rng), cosine = -rt_dot(d, n);
        rt_vec3 a = {7, 7, 7}, b = a;
        assert_close(fresnel(cosine, eta), rt_fresnel(cosine, eta), 0);
        assert_int_equal(refract(d, n, eta, &a), rt_refract(d, n, eta, &b));
        assert_memory_equal(&a, &b, sizeof a);
    }
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    check_against_rt_render(&scene_glass);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_fresnel_straight_on_and_flat),
        cmocka_unit_test(test_fresnel_at_brewsters_angle),
        cmocka_unit_test(test_fresnel_against_double),
        cmocka_unit_test(test_fresnel_both_ways_is_the_same),
        cmocka_unit_test(test_fresnel_in_the_mean),
        cmocka_unit_test(test_schlick_and_his_trap),
        cmocka_unit_test(test_eta_1_reflects_nothing),
        cmocka_unit_test(test_refract_is_snells_law),
        cmocka_unit_test(test_refract_straight_on_goes_straight_on),
        cmocka_unit_test(test_refract_there_and_back),
        cmocka_unit_test(test_total_reflection_where_it_should_be),
        cmocka_unit_test(test_transmittance_is_the_exponential),
        cmocka_unit_test(test_transmittance_of_odd_numbers),
        cmocka_unit_test(test_two_ways_are_one_long_way),
        cmocka_unit_test(test_the_table_has_spheres_and_then_boxes),
        cmocka_unit_test(test_inside_is_inside),
        cmocka_unit_test(test_a_surface_of_glass_is_one_bounce),
        cmocka_unit_test(test_the_coin_shows_reflected_as_often_as_fresnel_says),
        cmocka_unit_test(test_a_ball_bends_a_ray_twice),
        cmocka_unit_test(test_a_slab_lets_rays_go_on_as_they_came),
        cmocka_unit_test(test_a_slab_of_coloured_glass),
        cmocka_unit_test(test_only_what_is_inside_is_absorbed),
        cmocka_unit_test(test_the_material_of_glass_does_not_count),
        cmocka_unit_test(test_clear_glass_vanishes_in_an_even_light),
        cmocka_unit_test(test_eta_1_is_invisible),
        cmocka_unit_test(test_no_ray_meets_the_surface_that_it_leaves),
        cmocka_unit_test(test_a_box_of_glass_has_no_leaks),
        cmocka_unit_test(test_guides_look_through_glass),
        cmocka_unit_test(test_demo_routines_are_those_of_rt_h),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("11 glass", tests, NULL, NULL);
}

/* Chapter 13: gloss, and the loop that puts part two together. */
/* The demo replaces these by its own routines; the tests do not want that. */
#pragma push_macro("rt_sample_gloss")
#pragma push_macro("rt_gloss")
#define DEMO "../demos/demo13_gloss.c"
#include "test.h"
#pragma pop_macro("rt_sample_gloss")
#pragma pop_macro("rt_gloss")

static const rt_scene empty; /* all zero */
static const double pi = 3.14159265358979;
static const rt_vec3 up = {0, 0, 1};

/* A direction at this cosine to the normal z. */
static rt_vec3 at_cosine(float cosine, float turn)
{
    float s, c;
    rt_sincos(turn, &s, &c);
    const float sine = sqrtf((1 - cosine) * (1 + cosine));
    return rt_vec(sine * c, sine * s, cosine);
}

static rt_vec3 any_above(rt_rng *rng)
{
    const float cosine = rt_random(rng);
    const float turn = rt_random(rng);
    return at_cosine(cosine, turn);
}

static rt_brdf finish_of(float shininess, bool metal, float albedo)
{
    rt_brdf finish = {{albedo, albedo, albedo}, shininess, metal};
    return finish;
}

typedef struct mean {
    double sum, squares;
    int count;
} mean;

static void add(mean *m, double value)
{
    m->sum += value;
    m->squares += value * value;
    m->count++;
}

static double mean_of(const mean *m)
{
    return m->sum / m->count;
}

static double variance_of(const mean *m)
{
    const double x = mean_of(m), variance = m->squares / m->count - x * x;
    return variance > 0 ? variance : 0;
}

/* 4 standard errors */
static double doubt(const mean *m)
{
    return 4 * sqrt(variance_of(m) / m->count) + 1e-6 * fabs(mean_of(m));
}

/* ---- the lobe ----------------------------------------------------------------------- */

/* The formulas of the chapter in double, as textbooks have them. */
static double lobe(rt_vec3 eye, rt_vec3 light, double shininess, double *density)
{
    const double a2 = 2 / (shininess + 2);
    const rt_dvec3 e = rt_to_double(eye), l = rt_to_double(light);
    const rt_dvec3 h = rt_dnormalize(rt_dmad(e, 1, l));
    const double k = h.z * h.z * (a2 - 1) + 1, d = a2 / (pi * k * k);
    const double g_eye = 2 * e.z / (e.z + sqrt(a2 + (1 - a2) * e.z * e.z));
    const double g_light = 2 * l.z / (l.z + sqrt(a2 + (1 - a2) * l.z * l.z));
    *density = g_eye * d / (4 * e.z);
    return d * g_eye * g_light / (4 * e.z);
}

static void test_gloss_is_the_formula(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 240);
    const float sizes[] = {0.5f, 2, 10, 50, 1000, 1e5f};
    for (int i = 0; i < 200000; i++) {
        const float n = sizes[i % 6];
        const rt_vec3 eye = any_above(&rng);
        rt_vec3 light = any_above(&rng);
        if (i % 2) /* close to the mirror's direction, where the lobe is */
            light = rt_normalize(rt_add(rt_vec(-eye.x, -eye.y, eye.z),
                                        random_point(&rng, 3 / sqrtf(n + 2))));
        float density;
        const float value = rt_gloss(up, eye, light, n, &density);
        if (!(light.z > 0)) {
            assert_true(value == 0 && density == 0);
            continue;
        }
        double exact_density;
        const double exact = lobe(eye, light, (double)n, &exact_density);
        /* floats know h to 1e-7, and the lobe is 1/sqrt(n) wide */
        const double relative = 3e-5 + 4e-6 * sqrt((double)n) / (double)(eye.z + light.z);
        assert_close(value, exact, relative * exact + 1e-12);
        assert_close(density, exact_density, relative * exact_density + 1e-12);
    }
}

static void test_below_the_surface_there_is_none(void **state)
{
    (void)state;
    const rt_vec3 above = at_cosine(0.5f, 0.1f), below = rt_scale(above, -1);
    float density = 7;
    assert_close(rt_gloss(up, above, rt_vec(0.6f, 0, -0.8f), 10, &density), 0, 0);
    assert_close(density, 0, 0);
    density = 7;
    assert_close(rt_gloss(up, below, above, 10, &density), 0, 0);
    assert_close(density, 0, 0);
    density = 7;
    assert_close(rt_gloss(up, rt_vec(1, 0, 0), above, 10, &density), 0, 0);
    assert_close(density, 0, 0);
    for (int k = 0; k < 3; k++) {
        const rt_brdf finish = finish_of(k ? 50 : 0, k == 1, 1);
        density = 7;
        assert_vec(rt_scatter(&finish, up, above, below, &density), 0, 0, 0, 0);
        assert_close(density, 0, 0);
        density = 7;
        assert_vec(rt_scatter(&finish, up, below, above, &density), 0, 0, 0, 0);
        assert_close(density, 0, 0);
    }
}

static void test_light_may_go_either_way(void **state)
{
    /* What goes from a to b goes from b to a, both as radiance: without the cosine of the
     * light, which rt_gloss and rt_scatter include. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 241);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 a = any_above(&rng), b = any_above(&rng);
        if (a.z < 0.01f || b.z < 0.01f)
            continue;
        const float n = i % 2 ? 20 : 400;
        const rt_brdf finishes[3] = {finish_of(0, false, 0.7f), finish_of(n, true, 0.7f),
                                     finish_of(n, false, 0.7f)};
        for (int k = 0; k < 3; k++) {
            float density;
            const float there = rt_scatter(&finishes[k], up, a, b, &density).x / b.z;
            const float back = rt_scatter(&finishes[k], up, b, a, &density).x / a.z;
            assert_close(there, back, 2e-4 * (double)there + 1e-9);
        }
    }
}

/* ---- drawing directions ------------------------------------------------------------- */

/* How often a direction is drawn, and how often it should be by the stated density. Cells
 * are in the slopes of h, halfway between the eye and the direction, in units of the
 * lobe's width: coarse cells could not tell a sharp lobe from a wrong one. With h = (s,
 * t, 1) / |.| a piece ds dt of the slopes is h.z^3 ds dt of the directions h, and 4 <eye,
 * h> times that of the directions sought. The rest is elsewhere, as below the surface. */
enum { CELLS = 32, FINE = 16, DRAWN = 200000 };

/* Slopes of up to 30 in cells that grow with them: s = width (e^(k u) - 1), u from 0 to 1. */
static double growth(double width)
{
    return log(1 + 30 / width);
}

static int cell_of(double slope, double width)
{
    const double u = log(1 + fabs(slope) / width) / growth(width);
    const int cell = (int)floor(((slope < 0 ? -u : u) + 1) * 0.5 * CELLS);
    return cell >= 0 && cell < CELLS ? cell : -1;
}

/* The slope at u, -1 to 1, and how fast it grows there. */
static double slope_at(double u, double width, double *speed)
{
    const double k = growth(width), e = exp(k * fabs(u));
    *speed = width * k * e;
    return u < 0 ? -width * (e - 1) : width * (e - 1);
}

static void check_chi_square(const rt_brdf *finish, bool whole, float cosine,
                             uint32_t seed)
{
    static double expected[CELLS * CELLS];
    static int counts[CELLS * CELLS];
    memset(expected, 0, sizeof expected);
    memset(counts, 0, sizeof counts);
    const rt_vec3 eye = at_cosine(cosine, 0.13f);
    const double width = sqrt(2 / ((double)finish->shininess + 2));
    rt_rng rng = rt_rng_start(0, 0, seed);
    int elsewhere = 0;
    for (int n = 0; n < DRAWN; n++) {
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_vec3 d = whole ? rt_sample_brdf(finish, up, eye, r1, r2)
                                : rt_sample_gloss(up, eye, finish->shininess, r1, r2);
        assert_close(rt_length(d), 1, 2e-6);
        if (!(d.z > 0)) {
            elsewhere++;
            continue;
        }
        const rt_dvec3 h = rt_dmad(rt_to_double(eye), 1, rt_to_double(d));
        const int i = cell_of(h.x / h.z, width), j = cell_of(h.y / h.z, width);
        if (i < 0 || j < 0)
            elsewhere++;
        else
            counts[i + CELLS * j]++;
    }
    const int n = CELLS * FINE;
    double above = 0;
    for (int j = 0; j < n; j++)
        for (int i = 0; i < n; i++) {
            double wide, high;
            const double x = slope_at(2 * (i + 0.5) / n - 1, width, &wide),
                         y = slope_at(2 * (j + 0.5) / n - 1, width, &high);
            const rt_dvec3 h = rt_dnormalize(rt_dvec(x, y, 1));
            const double toward = rt_ddot(h, rt_to_double(eye));
            const rt_vec3 d =
                rt_to_float(rt_dmad(rt_dscale(rt_to_double(eye), -1), 2 * toward, h));
            float density;
            if (!(toward > 0 && d.z > 0))
                continue;
            if (whole)
                rt_scatter(finish, up, eye, d, &density);
            else
                rt_gloss(up, eye, d, finish->shininess, &density);
            const double mass = (double)density * 4 * toward * h.z * h.z * h.z * wide *
                                high * 4 / n / n * DRAWN;
            expected[i / FINE + j / FINE * CELLS] += mass;
            above += mass;
        }
    double chi = 0, rest = DRAWN - above;
    int rest_count = elsewhere, cells = 0;
    for (int k = 0; k < CELLS * CELLS; k++) {
        if (expected[k] < 20) {
            rest += expected[k];
            rest_count += counts[k];
            continue;
        }
        cells++;
        chi += (counts[k] - expected[k]) * (counts[k] - expected[k]) / expected[k];
    }
    if (rest > 20) {
        cells++;
        chi += (rest_count - rest) * (rest_count - rest) / rest;
    }
    const double z = (chi - cells) / sqrt(2.0 * cells);
    if (!(z < 4 && cells > 40))
        fail_msg(
            "shininess %g, cosine %g: chi-square %.1f sigma off, %d cells, %d elsewhere",
            (double)finish->shininess, (double)cosine, z, cells, elsewhere);
}

static const float sharpness[] = {2, 50, 500, 2000}, cosines[] = {1, 0.6f, 0.2f};

static void test_gloss_is_drawn_with_the_density_said(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        const rt_brdf metal = finish_of(sharpness[k / 3], true, 1);
        check_chi_square(&metal, false, cosines[k % 3], 242 + (uint32_t)k);
    }
}

static void test_a_coat_is_drawn_with_the_density_said(void **state)
{
    (void)state;
    for (int k = 0; k < 12; k++) {
        const rt_brdf plastic = finish_of(sharpness[k / 3], false, 1);
        check_chi_square(&plastic, true, cosines[k % 3], 260 + (uint32_t)k);
    }
    for (int k = 0; k < 3; k++) {
        const rt_brdf metal = finish_of(50, true, 1), matt = finish_of(0, false, 1);
        check_chi_square(&metal, true, cosines[k], 280 + (uint32_t)k);
        check_chi_square(&matt, true, cosines[k], 290 + (uint32_t)k);
    }
}

static void test_the_chance_of_the_gloss_is_a_chance(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 243);
    const rt_brdf plastic = finish_of(50, false, 1), metal = finish_of(50, true, 1),
                  matt = finish_of(0, false, 1);
    for (int i = 0; i < 10000; i++) {
        const rt_vec3 eye = any_above(&rng);
        const float chance = rt__gloss_chance(&plastic, up, eye);
        assert_true(chance > 0.27f && chance <= 1);
        assert_close(rt__gloss_chance(&metal, up, eye), 1, 0);
        assert_close(rt__gloss_chance(&matt, up, eye), 0, 0);
    }
}

/* ---- energy ------------------------------------------------------------------------- */

/* The part of the light from all sides that is sent to the eye. */
static mean albedo_of(const rt_brdf *finish, float cosine, int n)
{
    mean m = {0};
    const rt_vec3 eye = at_cosine(cosine, 0.4f);
    rt_rng rng = rt_rng_start(0, 0, 244);
    for (int i = 0; i < n; i++) {
        /* a grid, moved a little: few points tell much */
        const float r1 = ((float)(i % 300) + rt_random(&rng)) / 300;
        const float r2 = ((float)(i / 300 % 300) + rt_random(&rng)) / 300;
        const rt_vec3 d = rt_sample_brdf(finish, up, eye, r1, r2);
        float density;
        const float f = rt_scatter(finish, up, eye, d, &density).x;
        add(&m, density > 0 ? (double)(f / density) : 0);
    }
    return m;
}

static void test_the_lobes_albedo(void **state)
{
    /* The table of docs/13-gloss.md, by quadrature of another program. A lobe of
     * all-white facets loses what is reflected twice. */
    (void)state;
    const double degrees[] = {0, 30, 60, 75, 85};
    const double n50[] = {0.950, 0.941, 0.897, 0.853, 0.868},
                 n10[] = {0.779, 0.766, 0.744, 0.764, 0.812};
    for (int k = 0; k < 5; k++) {
        const float cosine = (float)cos(degrees[k] * pi / 180);
        const rt_brdf sharp = finish_of(50, true, 1), wide = finish_of(10, true, 1);
        const mean a = albedo_of(&sharp, cosine, 90000),
                   b = albedo_of(&wide, cosine, 90000);
        assert_close(mean_of(&a), n50[k], 1e-3);
        assert_close(mean_of(&b), n10[k], 1e-3);
    }
    const rt_brdf two = finish_of(2, true, 1);
    const mean m = albedo_of(&two, 1, 90000);
    assert_in_range((int)(1000 * mean_of(&m)), 450, 560);
}

static void test_no_finish_makes_light(void **state)
{
    (void)state;
    for (int k = 0; k < 20; k++)
        for (int metal = 0; metal < 2; metal++) {
            const rt_brdf finish = finish_of(powf(10, (float)(k % 5)), metal != 0, 1);
            const float cosine = (float)(k / 5 + 1) * 0.25f;
            const mean m = albedo_of(&finish, cosine, 90000);
            if (!(mean_of(&m) <= 1.001 + doubt(&m) / 8 && mean_of(&m) > 0.4))
                fail_msg("shininess %g, cosine %g, %s: albedo %g",
                         (double)finish.shininess, (double)cosine,
                         metal ? "metal" : "plastic", mean_of(&m));
        }
}

static void test_the_body_under_the_coat(void **state)
{
    /* A body without the coat's reflections, under light from all sides: the formula is
     * chosen so that the mean over all eyes is albedo . 0.96, since 1.05 (1 - 1/21) =
     * 1. */
    (void)state;
    mean m = {0};
    rt_rng rng = rt_rng_start(0, 0, 245);
    const rt_brdf white = finish_of(1e6f, false, 1), black = finish_of(1e6f, false, 0);
    for (int i = 0; i < 400000; i++) {
        float r[4], density;
        for (int k = 0; k < 4; k++)
            r[k] = rt_random(&rng);
        const rt_vec3 eye = rt_sample_cosine(up, r[0], r[1]),
                      light = rt_sample_cosine(up, r[2], r[3]);
        const double with = (double)rt_scatter(&white, up, eye, light, &density).x;
        const double without = (double)rt_scatter(&black, up, eye, light, &density).x;
        add(&m, (with - without) * pi / (double)light.z);
    }
    assert_close(mean_of(&m), 0.96 * (1 - 1 / 21.0), doubt(&m) + 1e-4);
}

static void test_a_glossy_ball_in_an_even_light(void **state)
{
    /* In the middle of the ball, rt_radiance_mis gives the albedo by quadrature. */
    (void)state;
    const rt_sphere ball = {{0, 0, -5}, 1, {{0.9f, 0.9f, 0.9f}, true}};
    for (int metal = 0; metal < 2; metal++) {
        rt_sphere sphere = ball;
        sphere.material.mirror = metal != 0;
        const rt_surface surface = {.shininess = 50};
        const rt_brdf finish = finish_of(50, metal != 0, 0.9f);
        rt_scene scene = empty;
        scene.spheres = &sphere;
        scene.sphere_count = 1;
        scene.surfaces = &surface;
        scene.background = rt_vec(1, 1, 1);
        const rt_ray ray = ray_of(rt_vec(0.8f, 0, 0), rt_vec(0, 0, -1));
        mean m = {0};
        for (uint32_t i = 0; i < 40000; i++) {
            rt_rng rng = rt_rng_start(i, 0, 246);
            add(&m, (double)rt_radiance_mis(&scene, &ray, 1, &rng).x);
        }
        const mean exact = albedo_of(&finish, 0.6f, 90000);
        assert_close(mean_of(&m), mean_of(&exact), doubt(&m) + 1e-3);
    }
}

/* ---- lights ------------------------------------------------------------------------- */

static const rt_box floor_box = {{-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, true}};

static rt_scene on_the_floor(const rt_box *box, const rt_surface *surface)
{
    rt_scene scene = empty;
    scene.boxes = box;
    scene.box_count = 1;
    scene.surfaces = surface;
    return scene;
}

static void test_a_light_that_is_a_point_on_gloss(void **state)
{
    /* I / d^2 times the formula; the light at the other side of the mirror's direction, and off. */
    (void)state;
    const rt_vec3 normal = {0, 1, 0};
    for (int k = 0; k < 24; k++) {
        const float n = sharpness[k % 4];
        const rt_surface surface = {.shininess = n};
        rt_box box = floor_box;
        box.material.mirror = k % 2 != 0;
        const rt_light light = {{3, 4, 0.1f * (float)k}, {50, 100, 200}};
        rt_scene scene = on_the_floor(&box, &surface);
        scene.lights = &light;
        scene.light_count = 1;
        const rt_vec3 from = {-3, 4, 0}, to_eye = rt_normalize(from);
        const rt_ray ray = ray_of(from, rt_scale(to_eye, -1));
        rt_rng rng = rt_rng_start(0, 0, 0);
        const rt_vec3 seen = rt_radiance_mis(&scene, &ray, 0, &rng);
        const rt_brdf finish = finish_of(n, k % 2 != 0, 0.5f);
        float density;
        const rt_vec3 f =
            rt_scatter(&finish, normal, to_eye, rt_normalize(light.position), &density);
        const double dd = (double)rt_dot(light.position, light.position);
        assert_true(f.x > 0);
        assert_close(seen.x, (double)f.x * 50 / dd, 1e-3 * (double)seen.x);
        assert_close(seen.z, (double)f.z * 200 / dd, 1e-3 * (double)seen.z);
    }
}

static void test_three_ways_to_a_lamp_one_mean(void **state)
{
    /* On a rough metal: aiming, chance, and both. The means agree, and both is not much noisier
     * than the better of the two, whichever that is; by chance alone the variance is up to a
     * hundred million times that of aiming, and by aiming alone two thousand times that of chance.
     */
    (void)state;
    enum { N = 60000 };
    const float radii[] = {0.1f, 0.8f, 2.5f};
    const rt_vec3 normal = {0, 1, 0}, origin = {0, 0, 0}, from = {-3, 4, 0.5f};
    const rt_vec3 to_eye = rt_normalize(from);
    for (int k = 0; k < 12; k++) {
        const float n = k % 6 < 3 ? 10 : 2000;
        const rt_lamp lamp = {
            .center = {3, 4, -0.5f}, .radius = radii[k % 3], .intensity = {40, 40, 40}};
        rt_box box = floor_box;
        box.material.mirror = k < 6;
        const rt_surface surface = {.shininess = n};
        const rt_brdf finish = finish_of(n, k < 6, 0.5f);
        rt_scene scene = on_the_floor(&box, &surface);
        scene.lamps = &lamp;
        scene.lamp_count = 1;
        const float l = rt_lamp_radiance(&lamp).x;
        const rt_ray ray = ray_of(from, rt_scale(to_eye, -1));
        mean aim = {0}, chance = {0}, both = {0};
        rt_rng rng = rt_rng_start(0, 0, 247);
        for (uint32_t i = 0; i < N; i++) {
            float density;
            const float r1 = rt_random(&rng);
            const float r2 = rt_random(&rng);
            const rt_vec3 u = rt_normalize(rt_sample_lamp(&lamp, origin, r1, r2));
            float f = rt_scatter(&finish, normal, to_eye, u, &density).x;
            add(&aim, (double)(f * l / rt_lamp_density(&lamp, origin, u)));
            const float r3 = rt_random(&rng);
            const float r4 = rt_random(&rng);
            const rt_vec3 w = rt_sample_brdf(&finish, normal, to_eye, r3, r4);
            f = rt_scatter(&finish, normal, to_eye, w, &density).x;
            const rt_ray way = ray_of(origin, w);
            const bool met = density > 0 && rt_meet_lamp(&lamp, &way, FLT_MAX) > 0;
            add(&chance, met ? (double)(f / density * l) : 0);
            rt_rng path = rt_rng_start(i, 0, 248);
            add(&both, (double)rt_radiance_mis(&scene, &ray, 0, &path).x);
        }
        assert_close(mean_of(&aim), mean_of(&both), doubt(&aim) + doubt(&both));
        assert_close(mean_of(&chance), mean_of(&both), doubt(&chance) + doubt(&both));
        const double a = variance_of(&aim), c = variance_of(&chance),
                     better = a < c ? a : c;
        if (!(variance_of(&both) < 1.5 * better + 0.15 * mean_of(&both) * mean_of(&both)))
            fail_msg("case %d: variance %g by aim, %g by chance, %g by both", k, a, c,
                     variance_of(&both));
        /* in between it is better than either: the table of the chapter */
        if (k == 11)
            assert_true(variance_of(&both) < 0.2 * better);
    }
}

static void test_the_weights_are_one_together(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 249);
    for (int i = 0; i < 100000; i++) {
        const float a = powf(10, uniform(&rng, -37, 37)),
                    b = powf(10, uniform(&rng, -37, 37));
        assert_close(rt_mis(a, b) + rt_mis(b, a), 1, 2e-7);
        const double ratio = (double)b / (double)a;
        assert_close(rt_mis(a, b), 1 / (1 + ratio * ratio), 1e-6);
    }
    assert_close(rt_mis(1, 1), 0.5, 0);
    assert_close(rt_mis(2, 1), 0.8, 1e-7);
    assert_close(rt_mis(0, 0), 0, 0);
    assert_close(rt_mis(0, 1), 0, 0);
    assert_close(rt_mis(1, 0), 1, 0);
    assert_close(rt_mis(FLT_MAX, FLT_MAX), 0.5, 0);
    assert_close(rt_mis(FLT_MIN, FLT_MIN), 0.5, 0);
    assert_close(rt_mis(FLT_MAX, FLT_MIN), 1, 0);
    assert_close(rt_mis(FLT_MIN, FLT_MAX), 0, 0);
    assert_close(rt_mis(1e-45f, 1e-45f), 0.5, 0);
    assert_close(rt_mis(NAN, 1), 0, 0);
    assert_close(rt_mis(1, NAN), 0, 0);
}

/* ---- the limits: a perfect mirror, and part one ------------------------------------- */

static rt_vec3 smooth_sky(const void *data, rt_vec3 d)
{
    (void)data;
    return rt_vec(0.5f + 0.4f * d.x, 0.5f + 0.4f * d.y, 0.5f + 0.4f * d.z);
}

static void test_the_sharpest_gloss_is_a_mirror(void **state)
{
    (void)state;
    const rt_sphere spheres[2] = {{{0, 0, -5}, 1, {{0.9f, 0.8f, 0.7f}, true}},
                                  {{1.5f, 0.5f, -4}, 0.5f, {{0, 0, 0}, true}}};
    const rt_surface table[2] = {{.shininess = 1e6f}, {.shininess = 1e6f}};
    rt_scene mirror = empty;
    mirror.spheres = spheres;
    mirror.sphere_count = 2;
    mirror.sky = smooth_sky;
    rt_scene gloss = mirror;
    gloss.surfaces = table;
    const rt_camera camera = {.fov_y = 40};
    const rt_options options = {.samples = 64, .bounces = 2};
    rt_image a = new_image(32, 24), b = new_image(32, 24);
    assert_int_equal(rt_render(&mirror, &camera, &options, &a), RT_OK);
    assert_int_equal(rt_render(&gloss, &camera, &options, &b), RT_OK);
    double squares = 0;
    for (int i = 0; i < 32 * 24; i++) {
        const rt_vec3 d = rt_sub(a.pixels[i], b.pixels[i]);
        squares += (double)rt_dot(d, d);
    }
    const double rms = sqrt(squares / (32 * 24));
    assert_close(rms, 0, 5e-3);
    free(a.pixels);
    free(b.pixels);
}

static void test_part_one_by_the_loop_of_part_two(void **state)
{
    /* The same bits and as many rays: a few bounces, all of them, Sobol's numbers and random ones,
     * with a background and without. And the same bits with a table in which all is 0. */
    (void)state;
    static const rt_surface zeros[9];
    const int bounces[] = {-1, 0, 1, 5, 40, RT_ALL_BOUNCES};
    rt_rng rng = rt_rng_start(0, 0, 250);
    uint32_t rays = 0;
    for (int i = 0; i < 60; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        if (i % 2)
            r.scene.background = random_colour(&rng);
        for (uint32_t k = 0; k < 200; k++) {
            rt_ray ray = random_ray(&rng);
            ray.direction = rt_normalize(ray.direction);
            rt_rng a = k % 2 ? rt_sobol_start(k, k / 2, 7) : rt_rng_start(k, k / 2, 7);
            rt_rng b = a, c = a;
            const int n = bounces[(size_t)k / 2 % COUNT(bounces)];
            const rt_vec3 one = rt_radiance(&r.scene, &ray, n, &a);
            const rt_vec3 two = rt_radiance_mis(&r.scene, &ray, n, &b);
            assert_memory_equal(&one, &two, sizeof one);
            assert_int_equal(a.rays, b.rays);
            assert_int_equal(a.dimension, b.dimension);
            r.scene.surfaces = zeros;
            const rt_vec3 three = rt_radiance_mis(&r.scene, &ray, n, &c);
            r.scene.surfaces = NULL;
            assert_memory_equal(&one, &three, sizeof one);
            rays += a.rays;
        }
    }
    assert_true(rays > 20000);
}

static void test_a_picture_of_part_one_with_a_table_of_zeros(void **state)
{
    (void)state;
    static const rt_surface zeros[9];
    rt_rng rng = rt_rng_start(0, 0, 251);
    random_scene r;
    make_random_scene(&r, &rng);
    r.scene.background = rt_vec(0.1f, 0.2f, 0.3f);
    const rt_camera camera = {.position = {0, 0, 15}, .fov_y = 90};
    for (int k = 0; k < 4; k++) {
        const rt_options options = {.samples = 3,
                                    .bounces = k % 2 ? 5 : RT_ALL_BOUNCES,
                                    .sampler = k < 2 ? RT_SOBOL : RT_RANDOM,
                                    .lanes = 1};
        rt_image a = new_image(32, 24), b = new_image(32, 24);
        r.scene.surfaces = NULL;
        assert_int_equal(rt_render(&r.scene, &camera, &options, &a), RT_OK);
        r.scene.surfaces = zeros;
        assert_int_equal(rt_render(&r.scene, &camera, &options, &b), RT_OK);
        assert_true(same_pixels(&a, &b));
        free(a.pixels);
        free(b.pixels);
    }
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_routines_are_those_of_rt_h(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 252);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 eye = any_above(&rng), light = any_above(&rng);
        const float n = powf(10, uniform(&rng, -1, 5));
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_vec3 a = sample_gloss(up, eye, n, r1, r2),
                      b = rt_sample_gloss(up, eye, n, r1, r2);
        assert_memory_equal(&a, &b, sizeof a);
        float theirs, ours;
        assert_close(gloss(up, eye, light, n, &theirs),
                     rt_gloss(up, eye, light, n, &ours), 0);
        assert_close(theirs, ours, 0);
    }
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    check_against_rt_render(&scene_gloss);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_gloss_is_the_formula),
        cmocka_unit_test(test_below_the_surface_there_is_none),
        cmocka_unit_test(test_light_may_go_either_way),
        cmocka_unit_test(test_gloss_is_drawn_with_the_density_said),
        cmocka_unit_test(test_a_coat_is_drawn_with_the_density_said),
        cmocka_unit_test(test_the_chance_of_the_gloss_is_a_chance),
        cmocka_unit_test(test_the_lobes_albedo),
        cmocka_unit_test(test_no_finish_makes_light),
        cmocka_unit_test(test_the_body_under_the_coat),
        cmocka_unit_test(test_a_glossy_ball_in_an_even_light),
        cmocka_unit_test(test_a_light_that_is_a_point_on_gloss),
        cmocka_unit_test(test_three_ways_to_a_lamp_one_mean),
        cmocka_unit_test(test_the_weights_are_one_together),
        cmocka_unit_test(test_the_sharpest_gloss_is_a_mirror),
        cmocka_unit_test(test_part_one_by_the_loop_of_part_two),
        cmocka_unit_test(test_a_picture_of_part_one_with_a_table_of_zeros),
        cmocka_unit_test(test_demo_routines_are_those_of_rt_h),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("13 gloss", tests, NULL, NULL);
}

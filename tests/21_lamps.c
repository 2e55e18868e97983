/* Chapter 12: lamps with a size. */
/* The demo replaces these by its own routines; the tests do not want that. */
#pragma push_macro("rt_sample_lamp")
#pragma push_macro("rt_lamp_density")
#pragma push_macro("rt_mis")
#define DEMO "../demos/demo12_lamps.c"
#include "test.h"
#pragma pop_macro("rt_sample_lamp")
#pragma pop_macro("rt_lamp_density")
#pragma pop_macro("rt_mis")

static const rt_scene empty; /* all zero */
static const double pi = 3.14159265358979;

static rt_lamp ball_lamp(rt_vec3 center, float radius, float radiance)
{
    rt_lamp lamp = {.center = center, .radius = radius};
    const float i = radiance * 3.14159265359f * radius * radius;
    lamp.intensity = rt_vec(i, i, i);
    return lamp;
}

static rt_lamp flat_lamp(rt_vec3 center, rt_vec3 u, rt_vec3 v, float radiance)
{
    rt_lamp lamp = {.center = center, .u = u, .v = v};
    const float i = radiance * 4 * rt_length(rt_cross(u, v));
    lamp.intensity = rt_vec(i, i, i);
    return lamp;
}

/* Any lamp in a cube of 20 units, not too thin. */
static rt_lamp any_lamp(rt_rng *rng, bool flat)
{
    const rt_vec3 center = random_point(rng, 10);
    const float size = powf(10, uniform(rng, -3, 0.7f));
    if (!flat)
        return ball_lamp(center, size, 1);
    const rt_vec3 a = random_direction(rng), b = random_direction(rng);
    const rt_vec3 v = rt_dot(a, b) > 0.95f || rt_dot(a, b) < -0.95f ? rt_cross(a, b) : b;
    return flat_lamp(center, rt_scale(a, size), rt_scale(v, 2 * size), 1);
}

static rt_vec3 toward_lamp(const rt_lamp *lamp, rt_vec3 point, rt_rng *rng)
{
    const float r1 = rt_random(rng);
    const float r2 = rt_random(rng);
    return rt_normalize(rt_sub(rt_sample_lamp(lamp, point, r1, r2), point));
}

/* The mean of a number of values, and how far off it may be: 4 standard errors. */
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

static double doubt(const mean *m)
{
    const double x = mean_of(m), variance = m->squares / m->count - x * x;
    return 4 * sqrt((variance > 0 ? variance : 0) / m->count) + 1e-6 * fabs(x);
}

/* ---- the ray meets the lamp --------------------------------------------------------- */

static void test_radiance_is_intensity_over_the_area_seen(void **state)
{
    (void)state;
    const rt_lamp ball = {.radius = 2, .intensity = {1, 2, 3}};
    const rt_lamp flat = {.u = {3, 0, 0}, .v = {0, 0, 0.5f}, .intensity = {6, 3, 0}};
    const double a = 4 * pi;
    assert_vec(rt_lamp_radiance(&ball), 1 / a, 2 / a, 3 / a, 1e-7);
    assert_vec(rt_lamp_radiance(&flat), 1, 0.5, 0, 1e-6);
}

static void test_meeting_a_ball(void **state)
{
    (void)state;
    const rt_lamp lamp = ball_lamp(rt_vec(0, 0, -5), 1, 1);
    rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    assert_close(rt_meet_lamp(&lamp, &ray, FLT_MAX), 4, 0);
    assert_close(rt_meet_lamp(&lamp, &ray, 4), 0, 0); /* t < t_max */
    assert_close(rt_meet_lamp(&lamp, &ray, 4.001f), 4, 0);
    ray.direction.z = 1;
    assert_close(rt_meet_lamp(&lamp, &ray, FLT_MAX), 0, 0);
    ray.origin.z = -5; /* inside: the way out */
    assert_close(rt_meet_lamp(&lamp, &ray, FLT_MAX), 1, 0);
}

static void test_meeting_a_parallelogram(void **state)
{
    /* Sides that are not at right angles; from above and from below; just beside each side. */
    (void)state;
    const rt_vec3 u = {2, 0, 1}, v = {0.5f, 0, 1}, center = {1, 3, -2};
    const rt_lamp lamp = flat_lamp(center, u, v, 1);
    for (int k = 0; k < 2 * 13 * 13; k++) {
        const float a = (float)(k % 13 - 6) * 0.19f, b = (float)(k / 13 % 13 - 6) * 0.19f;
        const rt_vec3 p = rt_add(center, rt_add(rt_scale(u, a), rt_scale(v, b)));
        const rt_vec3 from = rt_add(p, rt_vec(0.3f, k < 169 ? 4 : -4.0f, -0.7f));
        const rt_ray ray = ray_of(from, rt_scale(rt_sub(p, from), 0.5f));
        const bool on = fabsf(a) < 1 && fabsf(b) < 1;
        assert_close(rt_meet_lamp(&lamp, &ray, FLT_MAX), on ? 2 : 0, 1e-5);
        assert_close(rt_meet_lamp(&lamp, &ray, 1.99f), 0, 0);
        const rt_ray away = ray_of(from, rt_scale(ray.direction, -1));
        assert_close(rt_meet_lamp(&lamp, &away, FLT_MAX), 0, 0);
    }
    const rt_ray along = ray_of(rt_vec(-9, 3, -2), rt_vec(1, 0, 0));
    assert_close(rt_meet_lamp(&lamp, &along, FLT_MAX), 0, 0); /* on edge */
}

/* ---- aiming at it ------------------------------------------------------------------- */

static void test_no_sampled_direction_misses(void **state)
{
    /* 0 wrong of a million, even for balls that are tiny, far away, or close to the
     * point. S itself lies on the lamp, on the side that is seen. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 220);
    int missed = 0;
    for (int i = 0; i < 1000000; i++) {
        const bool flat = i % 4 == 0;
        const rt_lamp lamp = any_lamp(&rng, flat);
        rt_vec3 point = random_point(&rng, i % 3 ? 12 : 200.0f);
        if (!flat && i % 3 == 2) /* just outside */
            point = rt_add(lamp.center,
                           rt_scale(random_direction(&rng), 1.01f * lamp.radius));
        if (rt_length(rt_sub(point, lamp.center)) < 1.001f * lamp.radius)
            continue;
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_vec3 end = rt_sample_lamp(&lamp, point, r1, r2);
        const rt_ray ray = ray_of(point, rt_sub(end, point));
        if (flat) { /* at the edge rounding decides, of numbers up to 200 */
            const float inner = 0.4999f - 4e-4f / rt_length(lamp.u);
            const bool edge = fabsf(r1 - 0.5f) > inner || fabsf(r2 - 0.5f) > inner;
            const rt_vec3 n = rt_normalize(rt_cross(lamp.u, lamp.v));
            const float way = fabsf(rt_dot(rt_sub(lamp.center, point), n));
            const bool on_edge = way < 0.05f * rt_length(rt_sub(lamp.center, point));
            missed += !edge && !on_edge && !(rt_meet_lamp(&lamp, &ray, 2) > 0);
            continue;
        }
        const double d = (double)rt_length(rt_sub(point, lamp.center));
        const rt_dvec3 off = rt_dsub(rt_to_double(end), rt_to_double(lamp.center));
        const double r = (double)lamp.radius;
        assert_close(sqrt(rt_ddot(off, off)), r, 2e-4 * r + 1e-6 * (d + 20));
        /* not farther than where rays just touch the ball: the near side */
        assert_true((double)rt_length(ray.direction) <
                    sqrt((d - r) * (d + r)) + 1e-3 * r + 1e-6 * (d + 20));
        const rt_dvec3 to = rt_dsub(rt_to_double(lamp.center), rt_to_double(point));
        const rt_dvec3 u = rt_dnormalize(rt_to_double(ray.direction));
        const rt_dvec3 beside = rt_dcross(u, to);
        /* within a rounding of the points' coordinates */
        missed += !(sqrt(rt_ddot(beside, beside)) < r + 1e-6 * d + 2e-6 * 200);
    }
    assert_int_equal(missed, 0);
}

static void test_the_density_is_one_in_all(void **state)
{
    /* Over the directions that meet the lamp; it is not asked about others. */
    (void)state;
    enum { N = 40000 };
    rt_rng rng = rt_rng_start(0, 0, 221);
    for (int k = 0; k < 40; k++) {
        const bool flat = k % 2 == 0;
        const rt_vec3 point = random_point(&rng, 3);
        const rt_lamp lamp =
            flat ? flat_lamp(random_point(&rng, 3), rt_scale(random_direction(&rng), 3),
                             rt_scale(random_direction(&rng), 3), 1)
                 : ball_lamp(random_point(&rng, 3), uniform(&rng, 0.7f, 2), 1);
        if (rt_length(rt_sub(point, lamp.center)) < 1.01f * lamp.radius)
            continue;
        mean m = {0};
        for (int i = 0; i < N; i++) {
            const rt_ray ray = ray_of(point, random_direction(&rng));
            const bool met = rt_meet_lamp(&lamp, &ray, FLT_MAX) > 0;
            add(&m,
                met ? 4 * pi * (double)rt_lamp_density(&lamp, point, ray.direction) : 0);
        }
        if (m.squares / N <
            2000) /* otherwise the lamp is seen so flat that nothing is proved */
            assert_close(mean_of(&m), 1, doubt(&m) * 1.25);
    }
}

/* How often rt_sample_lamp chooses a direction in each of 16 x 16 cells, and how often it
 * should by rt_lamp_density: chi-square, as a deviation z of a normal variable. */
static void check_chi_square(const rt_lamp *lamp, rt_vec3 point, uint32_t seed)
{
    enum { CELLS = 16, N = 200000, FINE = 1600 };
    static double expected[CELLS * CELLS];
    static int counts[CELLS * CELLS];
    memset(expected, 0, sizeof expected);
    memset(counts, 0, sizeof counts);
    rt_vec3 x, y, axis = rt_normalize(rt_sub(lamp->center, point));
    rt_basis(axis, &x, &y);
    /* how far it reaches from the axis, in tangents */
    const float d = rt_length(rt_sub(lamp->center, point)), r = lamp->radius;
    float most = r / sqrtf((d - r) * (d + r));
    for (int i = 0; i < 4 && r == 0; i++) {
        const rt_vec3 corner =
            rt_sub(rt_add(lamp->center, rt_add(rt_scale(lamp->u, i % 2 ? 1 : -1.0f),
                                               rt_scale(lamp->v, i < 2 ? 1 : -1.0f))),
                   point);
        const float z = rt_dot(corner, axis), s = fabsf(rt_dot(corner, x)) / z,
                    t = fabsf(rt_dot(corner, y)) / z;
        assert_true(z > 0.1f);
        most = s > most ? s : most;
        most = t > most ? t : most;
    }
    most *= 1.0001f;
    rt_rng rng = rt_rng_start(0, 0, seed);
    for (int i = 0; i < N; i++) {
        const rt_vec3 u = toward_lamp(lamp, point, &rng);
        const float z = rt_dot(u, axis);
        const int a = (int)((rt_dot(u, x) / z / most + 1) * 0.5f * CELLS);
        const int b = (int)((rt_dot(u, y) / z / most + 1) * 0.5f * CELLS);
        assert_in_range(a, 0, CELLS - 1);
        assert_in_range(b, 0, CELLS - 1);
        counts[a + b * CELLS]++;
    }
    /* a square of the plane at distance 1 takes up cos^3 of its area */
    for (int j = 0; j < FINE; j++)
        for (int i = 0; i < FINE; i++) {
            const float s = (2 * ((float)i + 0.5f) / FINE - 1) * most,
                        t = (2 * ((float)j + 0.5f) / FINE - 1) * most;
            const rt_vec3 w = rt_add(axis, rt_add(rt_scale(x, s), rt_scale(y, t)));
            const float cosine = 1 / rt_length(w);
            const rt_ray ray = ray_of(point, rt_scale(w, cosine));
            if (rt_meet_lamp(lamp, &ray, FLT_MAX) > 0)
                expected[i * CELLS / FINE + j * CELLS / FINE * CELLS] +=
                    (double)(rt_lamp_density(lamp, point, ray.direction) * cosine *
                             cosine * cosine * 4 * most * most / FINE / FINE) *
                    N;
        }
    double chi = 0, rest = 0, all = 0;
    int rest_count = 0, cells = 0;
    for (int k = 0; k < CELLS * CELLS; k++) {
        all += expected[k];
        if (expected[k] < 20) {
            rest += expected[k];
            rest_count += counts[k];
            continue;
        }
        cells++;
        chi += (counts[k] - expected[k]) * (counts[k] - expected[k]) / expected[k];
    }
    assert_close(all / N, 1, 3e-3);
    if (rest > 20)
        chi += (rest_count - rest) * (rest_count - rest) / rest;
    const double z = (chi - cells) / sqrt(2.0 * cells);
    if (!(z < 4 && cells > 20))
        fail_msg("chi-square is %.1f sigma off, in %d cells", z, cells);
}

static void test_directions_are_chosen_with_the_density_said(void **state)
{
    (void)state;
    const rt_vec3 point = {0.3f, -0.2f, 0.1f};
    const rt_lamp lamps[] = {
        ball_lamp(rt_vec(3, 2, -4), 0.05f, 1),
        ball_lamp(rt_vec(3, 2, -4), 2, 1),
        ball_lamp(rt_vec(3, 2, -4), 4.5f, 1),
        flat_lamp(rt_vec(1, 3, -2), rt_vec(2, 0, 1), rt_vec(0.5f, 0, 1), 1),
        flat_lamp(rt_vec(2, 2, 1), rt_vec(0.5f, 1, 0), rt_vec(0, 0.7f, 1), 1),
    };
    for (size_t i = 0; i < COUNT(lamps); i++)
        check_chi_square(&lamps[i], point, 222 + (uint32_t)i);
}

static void test_small_balls_keep_their_digits(void **state)
{
    /* 1 - cos a of a ball that is seen as large as 1e-6 of its distance, within 2e-6 of itself. */
    (void)state;
    for (float size = 0.99f; size > 1e-6f; size *= 0.7f) {
        const rt_lamp lamp = ball_lamp(rt_vec(0, 0, 1), size, 1);
        const long double s = (long double)size * (long double)size;
        const double cap = (double)(s / (1 + sqrtl(1 - s)));
        const double density =
            (double)rt_lamp_density(&lamp, rt_vec(0, 0, 0), rt_vec(0, 0, 1));
        assert_close(density * 2 * pi * cap, 1, 3e-6);
    }
}

static void test_a_point_within_a_ball_cannot_aim(void **state)
{
    (void)state;
    const rt_lamp lamp = ball_lamp(rt_vec(0, 0, 0), 1, 1);
    assert_close(rt_lamp_density(&lamp, rt_vec(0.5f, 0, 0), rt_vec(1, 0, 0)), 0, 0);
    assert_close(rt_lamp_density(&lamp, rt_vec(0, 0, 0), rt_vec(1, 0, 0)), 0, 0);
    assert_close(rt_lamp_density(&lamp, rt_vec(1, 0, 0), rt_vec(1, 0, 0)), 0, 0);
    assert_close(rt_lamp_density(&lamp, rt_vec(1e15f, 1e15f, 0), rt_vec(-1, 0, 0)), 0, 0);
}

/* ---- how bright it makes a floor ---------------------------------------------------- */

/* A floor at y = 0, and the light that comes from its point (0, 0, 0) up to the eye. */
static const rt_box floor_box = {
    {-50, -1, -50}, {50, 0, 50}, {{0.5f, 0.5f, 0.5f}, false}};

static rt_scene on_the_floor(const rt_lamp *lamps, int count)
{
    rt_scene scene = empty;
    scene.boxes = &floor_box;
    scene.box_count = 1;
    scene.lamps = lamps;
    scene.lamp_count = count;
    return scene;
}

static mean light_from(const rt_scene *scene, rt_vec3 from, int n, int bounces)
{
    mean m = {0};
    for (int i = 0; i < n; i++) {
        const rt_ray ray = ray_of(from, rt_normalize(rt_scale(from, -1)));
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 230);
        add(&m, (double)rt_radiance_mis(scene, &ray, bounces, &rng).x);
    }
    return m;
}

/* The light of the lamps on the floor, found in three ways: by aiming alone, by chance
 * alone, and by both with rt_radiance_mis; each is 0.5 E / pi. */
static void check_three_ways(const rt_lamp *lamp, double irradiance, double tolerance)
{
    enum { N = 100000 };
    const rt_scene scene = on_the_floor(lamp, 1);
    const rt_vec3 origin = {0, 0, 0}, up = {0, 1, 0};
    const double exact = 0.5 * irradiance / pi;
    mean aim = {0}, chance = {0};
    rt_rng rng = rt_rng_start(0, 0, 231);
    for (int i = 0; i < N; i++) {
        const rt_vec3 u = toward_lamp(lamp, origin, &rng);
        const double density = (double)rt_lamp_density(lamp, origin, u);
        const double cosine = u.y > 0 ? (double)u.y : 0;
        add(&aim, 0.5 / pi * cosine * (double)rt_lamp_radiance(lamp).x / density);
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_ray ray = ray_of(origin, rt_sample_cosine(up, r1, r2));
        add(&chance, rt_meet_lamp(lamp, &ray, FLT_MAX) > 0
                         ? 0.5 * (double)rt_lamp_radiance(lamp).x
                         : 0);
    }
    const mean both = light_from(&scene, rt_vec(0.1f, 1, 0.1f), N, 0);
    assert_close(mean_of(&aim), exact, doubt(&aim) + tolerance * exact);
    assert_close(mean_of(&chance), exact, doubt(&chance) + tolerance * exact);
    assert_close(mean_of(&both), exact, doubt(&both) + tolerance * exact);
    assert_true(doubt(&both) < 0.02 * exact);
}

static void test_irradiance_of_a_ball(void **state)
{
    /* E = pi L R^2 cos / d^2, as long as all of it is above the floor. */
    (void)state;
    const float radii[] = {0.3f, 1, 1.9f};
    for (size_t i = 0; i < COUNT(radii); i++) {
        const rt_lamp lamp = ball_lamp(rt_vec(3, 2, -1), radii[i], 5);
        const double dd = 14, r = (double)radii[i];
        check_three_ways(&lamp, pi * 5 * r * r * (2 / sqrt(dd)) / dd, 1e-5);
    }
}

/* Lambert's formula for a polygon, 1760: E = L/2 sum over its sides of the angle at which each is
 * seen times <n, N>, with n the normal of the plane through the point and the side. */
static double polygon_irradiance(const rt_lamp *lamp, rt_dvec3 up)
{
    const rt_dvec3 c = rt_to_double(lamp->center), u = rt_to_double(lamp->u),
                   v = rt_to_double(lamp->v);
    const double sides[4][2] = {{1, 1}, {-1, 1}, {-1, -1}, {1, -1}};
    double sum = 0;
    for (int i = 0; i < 4; i++) {
        const double *s = sides[i], *t = sides[(i + 1) % 4];
        const rt_dvec3 a = rt_dmad(rt_dmad(c, s[0], u), s[1], v),
                       b = rt_dmad(rt_dmad(c, t[0], u), t[1], v);
        const rt_dvec3 across = rt_dcross(a, b);
        const double angle = atan2(sqrt(rt_ddot(across, across)), rt_ddot(a, b));
        sum += angle * rt_ddot(rt_dnormalize(across), up);
    }
    return fabs(sum) / 2;
}

static void test_irradiance_of_a_parallelogram(void **state)
{
    (void)state;
    const rt_lamp lamps[] = {
        flat_lamp(rt_vec(0, 2, 0), rt_vec(1, 0, 0), rt_vec(0, 0, 1), 1),
        flat_lamp(rt_vec(1, 3, -2), rt_vec(2, 0, 1), rt_vec(0.5f, 1, 1), 3),
        flat_lamp(rt_vec(-2, 1, 1), rt_vec(0, 0.9f, 0), rt_vec(0.3f, 0, 1), 2),
    };
    for (size_t i = 0; i < COUNT(lamps); i++) {
        const double l = (double)rt_lamp_radiance(&lamps[i]).x;
        check_three_ways(&lamps[i], l * polygon_irradiance(&lamps[i], rt_dvec(0, 1, 0)),
                         1e-5);
    }
    /* a square of 2 x 2 at height 2 overhead */
    assert_close(polygon_irradiance(&lamps[0], rt_dvec(0, 1, 0)), 0.7517, 1e-3);
}

static void test_a_lamp_becomes_a_point(void **state)
{
    /* The smaller it is, the closer to chapter 4: within (R/d)^2 or so, and with no noise. */
    (void)state;
    const rt_light light = {{3, 4, -1}, {60, 50, 40}};
    const rt_camera camera = {.position = {0, 3, 6}, .direction = {0, -0.5f, -1}};
    const rt_sphere ball = {{0, 1, -1}, 1, {{0.9f, 0.4f, 0.2f}, false}};
    rt_scene point = on_the_floor(NULL, 0);
    point.spheres = &ball;
    point.sphere_count = 1;
    rt_scene small = point;
    point.lights = &light;
    point.light_count = 1;
    const float radii[] = {1e-2f, 1e-3f, 1e-5f};
    for (size_t k = 0; k < COUNT(radii); k++) {
        const rt_lamp lamp = {
            .center = light.position, .radius = radii[k], .intensity = light.intensity};
        small.lamps = &lamp;
        small.lamp_count = 1;
        int unlike = 0;
        for (int i = 0; i < 2000; i++) {
            rt_rng a = rt_rng_start((uint32_t)i, 0, 232), b = a;
            const float x = rt_random(&a) * 40, y = rt_random(&a) * 30;
            const rt_ray ray = rt_camera_ray(&camera, 40, 30, x, y);
            const rt_vec3 seen = rt_radiance_mis(&small, &ray, 0, &b),
                          expected = rt_radiance(&point, &ray, 0, &a);
            const float off = fabsf(seen.x - expected.x);
            unlike += off > 1e-3f * expected.x + 3 * radii[k] * radii[k] + 1e-6f;
        }
        /* the edges of shadows are soft now */
        if (unlike > 2000 * (int)(1000 * radii[k] + 1) / 100)
            fail_msg("radius %g: %d of 2000 differ", (double)radii[k], unlike);
    }
}

static void test_far_away_it_lights_like_a_point(void **state)
{
    (void)state;
    const rt_vec3 far = {600, 800, 0}, i = {1e6f, 2e6f, 3e6f};
    const rt_light light = {far, i};
    const rt_lamp ball = {.center = far, .radius = 5, .intensity = i};
    /* one that faces the floor's point */
    const rt_lamp flat = {.center = far, .u = {-4, 3, 0}, .v = {0, 0, 5}, .intensity = i};
    rt_scene point = on_the_floor(NULL, 0);
    point.lights = &light;
    point.light_count = 1;
    const mean expected = light_from(&point, rt_vec(0.1f, 1, 0.1f), 1, 0);
    const rt_scene by_ball = on_the_floor(&ball, 1), by_flat = on_the_floor(&flat, 1);
    const mean a = light_from(&by_ball, rt_vec(0.1f, 1, 0.1f), 1000, 0);
    const mean b = light_from(&by_flat, rt_vec(0.1f, 1, 0.1f), 1000, 0);
    assert_close(mean_of(&a) / mean_of(&expected), 1, 1e-4);
    assert_close(mean_of(&b) / mean_of(&expected), 1, 1e-4);
}

/* ---- how it looks ------------------------------------------------------------------- */

static void test_a_lamp_is_seen_with_its_radiance(void **state)
{
    /* Seen by the camera, in a mirror, through glass, whatever the number of bounces; in
     * a mirror that takes light, less by that. */
    (void)state;
    const rt_box boxes[2] = {{{-50, -1, -50}, {50, 0, 50}, {{1, 0.5f, 0.25f}, true}},
                             {{-50, 8, -50}, {50, 9, 50}, {{0, 0, 0}, false}}};
    const rt_surface table[2] = {{.eta = 0}, {.eta = 1}};
    const rt_lamp lamp = ball_lamp(rt_vec(0, 4, -4), 1, 7);
    const rt_lamp above =
        flat_lamp(rt_vec(0, 12, 0), rt_vec(3, 0, 0), rt_vec(0, 0, 3), 2);
    const rt_lamp both[2] = {lamp, above};
    rt_scene scene = on_the_floor(both, 2);
    scene.boxes = boxes;
    scene.box_count = 2;
    scene.surfaces = table;
    const float l = rt_lamp_radiance(&lamp).x;
    assert_close(l, 7, 1e-6);
    for (int bounces = 0; bounces < 4; bounces++) {
        rt_rng rng = rt_rng_start(0, 0, 0);
        const rt_ray straight = ray_of(rt_vec(0, 4, 4), rt_vec(0, 0, -1));
        assert_vec(rt_radiance_mis(&scene, &straight, bounces, &rng), l, l, l, 0);
        assert_int_equal(rng.rays, 1);
        const rt_ray down =
            ray_of(rt_vec(0, 4, 4), rt_vec(0, -0.70710678f, -0.70710678f));
        assert_vec(rt_radiance_mis(&scene, &down, bounces, &rng), l, l / 2, l / 4, 1e-6);
        const rt_ray through = ray_of(rt_vec(0, 4, 0), rt_vec(0, 1, 0));
        assert_close(rt_radiance_mis(&scene, &through, bounces, &rng).x,
                     bounces > 0 ? 2 : 0, 1e-6);
    }
}

static void test_a_lamp_stands_in_the_way(void **state)
{
    /* A lamp hides what is behind it: the wall, another lamp, a light that is a point. */
    (void)state;
    const rt_lamp near = ball_lamp(rt_vec(0, 3, 0), 1, 1),
                  screen =
                      flat_lamp(rt_vec(0, 3, 0), rt_vec(2, 0, 0), rt_vec(0, 0, 2), 1),
                  far = ball_lamp(rt_vec(0, 10, 0), 0.5f, 100);
    const rt_light light = {{0, 10, 0}, {300, 300, 300}};
    const rt_lamp *const in_front[2] = {&near, &screen};
    for (int k = 0; k < 2; k++) {
        const rt_lamp two[2] = {far, *in_front[k]}, same[2] = {*in_front[k], far};
        rt_scene scene = on_the_floor(in_front[k], 1);
        const mean alone = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 20000, 0);
        scene = on_the_floor(two, 2);
        const mean with = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 20000, 0);
        scene = on_the_floor(same, 2);
        const mean turned = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 20000, 0);
        scene = on_the_floor(in_front[k], 1);
        scene.lights = &light;
        scene.light_count = 1;
        const mean point = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 20000, 0);
        assert_close(mean_of(&with), mean_of(&alone), doubt(&with) + doubt(&alone));
        assert_close(mean_of(&turned), mean_of(&alone), doubt(&turned) + doubt(&alone));
        assert_close(mean_of(&point), mean_of(&alone), doubt(&point) + doubt(&alone));
        rt_rng rng = rt_rng_start(0, 0, 0);
        const rt_ray up = ray_of(rt_vec(0, 0.5f, 0), rt_vec(0, 1, 0));
        scene = on_the_floor(two, 2);
        assert_close(rt_radiance_mis(&scene, &up, 3, &rng).x, 1, 1e-6);
        scene = on_the_floor(same, 2);
        assert_close(rt_radiance_mis(&scene, &up, 3, &rng).x, 1, 1e-6);
    }
    /* and the light comes back where nothing stands in the way */
    rt_scene scene = on_the_floor(&near, 1);
    scene.lights = &light;
    scene.light_count = 1;
    const rt_lamp beside = ball_lamp(rt_vec(9, 3, 0), 1, 1e-6f);
    scene.lamps = &beside;
    const mean lit = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 100, 0);
    assert_close(mean_of(&lit), 0.5 / pi * 3, 1e-3);
}

static void test_shapes_shadow_lamps_in_part(void **state)
{
    /* A screen that covers half of the lamp, as the floor's point sees it: half of the light. */
    (void)state;
    const rt_box boxes[2] = {floor_box, {{0, 2, -50}, {50, 2, 50}, {{0, 0, 0}, false}}};
    const rt_lamp lamps[2] = {
        ball_lamp(rt_vec(0, 4, 0), 1, 3),
        flat_lamp(rt_vec(0, 4, 0), rt_vec(1, 0, 0), rt_vec(0, 0, 1), 3)};
    for (int k = 0; k < 2; k++) {
        rt_scene scene = on_the_floor(&lamps[k], 1);
        const mean whole = light_from(&scene, rt_vec(-0.1f, 1, 0.1f), 50000, 0);
        scene.boxes = boxes;
        scene.box_count = 2;
        const mean half = light_from(&scene, rt_vec(-0.1f, 1, 0.1f), 50000, 0);
        assert_close(mean_of(&half), mean_of(&whole) / 2,
                     doubt(&half) + doubt(&whole) / 2);
    }
}

static void test_a_lamp_within_a_wall_is_dark(void **state)
{
    (void)state;
    const rt_lamp lamps[2] = {
        ball_lamp(rt_vec(0, -0.5f, 0), 0.4f, 1e6f),
        flat_lamp(rt_vec(0, -0.5f, 0), rt_vec(1, 0, 0), rt_vec(0, 0.1f, 1), 1e6f)};
    const rt_scene scene = on_the_floor(lamps, 2);
    const mean m = light_from(&scene, rt_vec(0.1f, 1, 0.1f), 10000, 3);
    assert_close(m.squares, 0, 0);
}

static void test_within_a_lamp_all_is_as_bright_as_it(void **state)
{
    /* A camera in the lamp sees its radiance. So does a ball in it, which sends back the
     * part albedo of it; one more bounce adds nothing else. */
    (void)state;
    const rt_lamp lamp = ball_lamp(rt_vec(0, 0, 0), 10, 2);
    const rt_sphere ball = {{0, 0, -4}, 1, {{0.5f, 0.25f, 1}, false}};
    rt_scene scene = empty;
    scene.lamps = &lamp;
    scene.lamp_count = 1;
    scene.spheres = &ball;
    scene.sphere_count = 1;
    const float l = rt_lamp_radiance(&lamp).x;
    for (uint32_t i = 0; i < 500; i++) {
        rt_rng rng = rt_rng_start(i, 0, 233);
        const rt_ray past = ray_of(rt_vec(0, 0, 0), rt_vec(0, 1, 0));
        assert_vec(rt_radiance_mis(&scene, &past, 2, &rng), l, l, l, 0);
        const rt_ray onto = ray_of(rt_vec(0.5f, 0.2f, 0), rt_vec(0, 0, -1));
        assert_vec(rt_radiance_mis(&scene, &onto, 0, &rng), l / 2, l / 4, l, 1e-6);
    }
}

/* ---- closed rooms ------------------------------------------------------------------- */

/* A cube of side 1, the wall at x = 1 a mirror, each wall a flat box. */
static void make_cube(rt_box walls[6], float rho, bool mirror)
{
    for (int k = 0; k < 6; k++) {
        rt_box *box = &walls[k];
        float low[3] = {0, 0, 0}, high[3] = {1, 1, 1};
        low[k / 2] = high[k / 2] = k % 2 ? 1.0f : 0.0f;
        box->min = rt_vec(low[0], low[1], low[2]);
        box->max = rt_vec(high[0], high[1], high[2]);
        box->material.albedo = rt_vec(rho, rho, rho);
        box->material.mirror = false;
    }
    walls[1].material.mirror = mirror;
    if (mirror)
        walls[1].material.albedo = rt_vec(1, 1, 1);
}

/* The mean light that the five other walls send out, with all bounces. */
static mean light_of_walls(const rt_scene *scene, int n)
{
    mean m = {0};
    rt_rng rng = rt_rng_start(0, 0, 234);
    for (int i = 0; i < n; i++) {
        const int wall = i % 5 == 0 ? 0 : 1 + i % 5; /* not 1 */
        float p[3];
        p[0] = rt_random(&rng);
        p[1] = rt_random(&rng);
        p[2] = rt_random(&rng);
        p[wall / 2] = wall % 2 ? 1.0f : 0.0f;
        float n3[3] = {0, 0, 0};
        n3[wall / 2] = wall % 2 ? -1.0f : 1.0f;
        const rt_vec3 point = {p[0], p[1], p[2]}, normal = {n3[0], n3[1], n3[2]};
        /* from close by, so that nothing stands between */
        const rt_ray ray =
            ray_of(rt_add(point, rt_scale(normal, 1e-3f)), rt_scale(normal, -1));
        rt_rng path = rt_rng_start((uint32_t)i, 0, 235);
        add(&m, (double)rt_radiance_mis(scene, &ray, RT_ALL_BOUNCES, &path).x);
    }
    return m;
}

static void test_a_white_room_is_as_bright_as_its_lamp(void **state)
{
    /* Only the lamp takes light; it is black. So everything is as bright as the lamp,
     * whatever the shapes are. That is exact only if each way to the lamp counts once: by
     * aiming, by chance, and by way of the mirror. */
    (void)state;
    rt_box walls[6];
    const rt_lamp lamps[2] = {ball_lamp(rt_vec(0.4f, 0.6f, 0.5f), 0.2f, 1),
                              flat_lamp(rt_vec(0.4f, 0.6f, 0.5f), rt_vec(0.2f, 0.1f, 0),
                                        rt_vec(0, 0.1f, 0.2f), 1)};
    for (int k = 0; k < 4; k++) {
        make_cube(walls, 1, k < 2);
        rt_scene scene = empty;
        scene.boxes = walls;
        scene.box_count = 6;
        scene.lamps = &lamps[k % 2];
        scene.lamp_count = 1;
        const mean m = light_of_walls(&scene, 20000);
        assert_close(mean_of(&m), 1, doubt(&m));
        assert_true(doubt(&m) < 0.08);
    }
}

static void test_grey_walls_that_shine_in_balance(void **state)
{
    /* Walls that shine as much as they take, (1 - rho) L: then nothing shows that they
     * are there. Whatever its way, every path brings L on average. */
    (void)state;
    rt_box walls[6];
    rt_surface table[6] = {{.eta = 0}};
    make_cube(walls, 0.5f, true);
    for (int k = 0; k < 6; k++)
        if (k != 1)
            table[k].emission = rt_vec(0.5f, 0.5f, 0.5f);
    const rt_lamp lamp = ball_lamp(rt_vec(0.4f, 0.6f, 0.5f), 0.2f, 1);
    rt_scene scene = empty;
    scene.boxes = walls;
    scene.box_count = 6;
    scene.surfaces = table;
    scene.lamps = &lamp;
    scene.lamp_count = 1;
    const mean m = light_of_walls(&scene, 20000);
    assert_close(mean_of(&m), 1, doubt(&m));
    assert_true(doubt(&m) < 0.02);
}

static void test_the_light_that_a_mirror_lost_is_back(void **state)
{
    /* A closed cube of side 1, a mirror for one wall, a lamp of 1 W/sr in the middle, albedo 1/2.
     * What comes in is what is taken: with E the mean irradiance of the five walls,
     *
     *     4 pi I = (1 - rho) 5 E + what the lamp takes itself,
     *
     * and they send out rho E / pi: 0.8 if the lamp were a point. A point light gives 5/6
     * of that: no path finds what it sends to the mirror. A lamp takes pi R^2 times 4
     * times the mean light that comes to it. */
    (void)state;
    rt_box walls[6];
    make_cube(walls, 0.5f, true);
    const float r = 0.1f;
    const rt_light light = {{0.5f, 0.5f, 0.5f}, {1, 1, 1}};
    const rt_lamp lamp = {
        .center = light.position, .radius = r, .intensity = light.intensity};
    rt_scene scene = empty;
    scene.boxes = walls;
    scene.box_count = 6;
    scene.lights = &light;
    scene.light_count = 1;
    const mean lost = light_of_walls(&scene, 100000);
    assert_close(mean_of(&lost), 0.8 * 5 / 6, doubt(&lost));
    scene.light_count = 0;
    scene.lamps = &lamp;
    scene.lamp_count = 1;
    const mean m = light_of_walls(&scene, 200000);
    mean comes = {0}; /* to the lamp */
    rt_rng rng = rt_rng_start(0, 0, 236);
    for (uint32_t i = 0; i < 20000; i++) {
        const rt_vec3 n = random_direction(&rng);
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_ray ray = ray_of(rt_add(lamp.center, rt_scale(n, 1.001f * r)),
                                  rt_sample_cosine(n, r1, r2));
        rt_rng path = rt_rng_start(i, 0, 237);
        add(&comes, (double)rt_radiance_mis(&scene, &ray, RT_ALL_BOUNCES, &path).x);
    }
    const double taken = pi * 4 * pi * (double)(r * r) * mean_of(&comes);
    const double exact = 0.5 / pi * (4 * pi - taken) / (0.5 * 5);
    assert_close(mean_of(&m), exact, doubt(&m));
    assert_true(doubt(&m) < 0.03 * exact && exact > 0.72 && exact < 0.8);
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_routines_are_those_of_rt_h(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 238);
    for (int i = 0; i < 100000; i++) {
        const rt_lamp lamp = any_lamp(&rng, false);
        const rt_vec3 point = random_point(&rng, 12);
        if (rt_length(rt_sub(point, lamp.center)) < 1.01f * lamp.radius)
            continue;
        const float r1 = rt_random(&rng);
        const float r2 = rt_random(&rng);
        const rt_vec3 a = sample_lamp(&lamp, point, r1, r2),
                      b = rt_sample_lamp(&lamp, point, r1, r2);
        assert_memory_equal(&a, &b, sizeof a);
        assert_close(lamp_density(&lamp, point, b), rt_lamp_density(&lamp, point, b), 0);
        assert_close(mis(r1, r2), rt_mis(r1, r2), 0);
    }
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    check_against_rt_render(&scene_lamps);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_radiance_is_intensity_over_the_area_seen),
        cmocka_unit_test(test_meeting_a_ball),
        cmocka_unit_test(test_meeting_a_parallelogram),
        cmocka_unit_test(test_no_sampled_direction_misses),
        cmocka_unit_test(test_the_density_is_one_in_all),
        cmocka_unit_test(test_directions_are_chosen_with_the_density_said),
        cmocka_unit_test(test_small_balls_keep_their_digits),
        cmocka_unit_test(test_a_point_within_a_ball_cannot_aim),
        cmocka_unit_test(test_irradiance_of_a_ball),
        cmocka_unit_test(test_irradiance_of_a_parallelogram),
        cmocka_unit_test(test_a_lamp_becomes_a_point),
        cmocka_unit_test(test_far_away_it_lights_like_a_point),
        cmocka_unit_test(test_a_lamp_is_seen_with_its_radiance),
        cmocka_unit_test(test_a_lamp_stands_in_the_way),
        cmocka_unit_test(test_shapes_shadow_lamps_in_part),
        cmocka_unit_test(test_a_lamp_within_a_wall_is_dark),
        cmocka_unit_test(test_within_a_lamp_all_is_as_bright_as_it),
        cmocka_unit_test(test_a_white_room_is_as_bright_as_its_lamp),
        cmocka_unit_test(test_grey_walls_that_shine_in_balance),
        cmocka_unit_test(test_the_light_that_a_mirror_lost_is_back),
        cmocka_unit_test(test_demo_routines_are_those_of_rt_h),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("12 lamps", tests, NULL, NULL);
}

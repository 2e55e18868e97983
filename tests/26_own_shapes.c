/* Chapter 17: shapes of one's own; those of the demo and of the exercises, and some that lie. */
#define DEMO "../demos/demo17_own_shape.c"
#include "test.h"
#include "meshes.h"
#include "shapes.h"

static const rt_scene empty; /* all zero */
static const float inf = INFINITY, nan_ = NAN;

/* ---- shapes, and what is inside them -------------------------------------------------- */

/* F(P), below 0 inside, computed in another way than by the shape's function. */
typedef double inside_function(rt_dvec3 p);

typedef struct specimen {
    const char *name;
    rt_custom_shape shape;
    inside_function *f;
    double volume;
    bool convex;
} specimen;

static double larger(double a, double b)
{
    return a > b ? a : b;
}

static double smaller(double a, double b)
{
    return a < b ? a : b;
}

/* How F changes, in steps of h. */
static rt_dvec3 gradient(inside_function *f, rt_dvec3 p, double h)
{
    const double x = f(rt_dvec(p.x + h, p.y, p.z)) - f(rt_dvec(p.x - h, p.y, p.z));
    const double y = f(rt_dvec(p.x, p.y + h, p.z)) - f(rt_dvec(p.x, p.y - h, p.z));
    const double z = f(rt_dvec(p.x, p.y, p.z + h)) - f(rt_dvec(p.x, p.y, p.z - h));
    return rt_dscale(rt_dvec(x, y, z), 0.5 / h);
}

static double round_f(rt_dvec3 p, double x, double y, double z, double radius)
{
    const rt_dvec3 d = rt_dsub(p, rt_dvec(x, y, z));
    return sqrt(rt_ddot(d, d)) - radius;
}

static const cylinder a_cylinder = {{1, -1, 2}, 2, 3};
static double cylinder_f(rt_dvec3 p)
{
    const double side = sqrt((p.x - 1) * (p.x - 1) + (p.z - 2) * (p.z - 2)) - 2;
    return larger(side, fabs(p.y - 0.5) - 1.5);
}

static double any_cone_f(rt_dvec3 p, double radius, double height)
{
    const double side = sqrt(p.x * p.x + p.z * p.z) - radius * (1 - p.y / height);
    return larger(larger(side, -p.y), p.y - height);
}

static const cone a_cone = {{0, 0, 0}, 2, 3}, flat_cone = {{1, 2, 3}, 3, 0.5f},
                  needle = {{0, 0, 0}, 0.1f, 4};
static double cone_f(rt_dvec3 p)
{
    return any_cone_f(p, 2, 3);
}
static double flat_cone_f(rt_dvec3 p)
{
    return any_cone_f(rt_dsub(p, rt_dvec(1, 2, 3)), 3, 0.5);
}
static double needle_f(rt_dvec3 p)
{
    return any_cone_f(p, (double)0.1f, 4);
}

/* 0.36 + 0.64 = 1: turned about z, then about x. */
static const rt_box brick = {{-0.5f, -1, -1.5f}, {0.5f, 1, 1.5f}, {{0, 0, 0}, false}};
static const rt_custom_shape brick_shape = {
    {-0.5f, -1, -1.5f}, {0.5f, 1, 1.5f}, {{0, 0, 0}, false}, cube_hit, &brick};
static const turned askew = {{3, -2, 1},
                             {0.6f, 0.8f, 0},
                             {-0.48f, 0.36f, 0.8f},
                             {0.64f, -0.48f, 0.6f},
                             &brick_shape};
static double askew_f(rt_dvec3 p)
{
    const rt_dvec3 d = rt_dsub(p, rt_dvec(3, -2, 1));
    const double x = fabs(0.6 * d.x + 0.8 * d.y) - 0.5;
    const double y = fabs(-0.48 * d.x + 0.36 * d.y + 0.8 * d.z) - 1;
    return larger(larger(x, y), fabs(0.64 * d.x - 0.48 * d.y + 0.6 * d.z) - 1.5);
}

static const rt_sphere unit_ball = {{0, 0, 0}, 1, {{0, 0, 0}, false}};
static const rt_custom_shape ball_shape = {
    {-1, -1, -1}, {1, 1, 1}, {{0, 0, 0}, false}, ball_hit, &unit_ball};
static const turned an_egg = {
    {0, 1, 0}, {0.6f, 0.8f, 0}, {-1.6f, 1.2f, 0}, {0, 0, 0.5f}, &ball_shape};
static double egg_f(rt_dvec3 p)
{
    const double x = 0.6 * p.x + 0.8 * (p.y - 1), y = -0.8 * p.x + 0.6 * (p.y - 1);
    return sqrt(x * x + y * y / 4 + p.z * p.z * 4) - 1;
}

static const ring a_ring = {{0, 0, 0}, 2, 0.5f};
static const field ring_field = {ring_distance, &a_ring};
static double ring_f(rt_dvec3 p)
{
    const double c = rt_ddot(p, p) + 4 - 0.25; /* the quartic */
    return (c * c - 16 * (p.x * p.x + p.z * p.z)) / 32;
}

static const rt_sphere left_ball = {{0, 0, 0}, 2, {{0, 0, 0}, false}},
                       right_ball = {{2, 0, 0}, 2, {{0, 0, 0}, false}};
static const rt_custom_shape left_shape = {
    {-2, -2, -2}, {2, 2, 2}, {{0, 0, 0}, false}, ball_hit, &left_ball};
static const rt_custom_shape right_shape = {
    {0, -2, -2}, {4, 2, 2}, {{0, 0, 0}, false}, ball_hit, &right_ball};
static const pair together = {A_OR_B, &left_shape, &right_shape};
static const pair lens = {A_AND_B, &left_shape, &right_shape};
static const pair moon = {A_WITHOUT_B, &left_shape, &right_shape};
static double together_f(rt_dvec3 p)
{
    return smaller(round_f(p, 0, 0, 0, 2), round_f(p, 2, 0, 0, 2));
}
static double lens_f(rt_dvec3 p)
{
    return larger(round_f(p, 0, 0, 0, 2), round_f(p, 2, 0, 0, 2));
}
static double moon_f(rt_dvec3 p)
{
    return larger(round_f(p, 0, 0, 0, 2), -round_f(p, 2, 0, 0, 2));
}

/* A ball with a hole; and a pair of which one is a pair: that ball without the ring in
 * its hole. */
static const cylinder drill = {{0, -3, 0}, 1, 6};
static const rt_custom_shape drill_shape = {
    {-1, -3, -1}, {1, 3, 1}, {{0, 0, 0}, false}, cylinder_hit, &drill};
static const pair napkin_ring = {A_WITHOUT_B, &left_shape, &drill_shape};
static double napkin_f(rt_dvec3 p)
{
    return larger(round_f(p, 0, 0, 0, 2), 1 - sqrt(p.x * p.x + p.z * p.z));
}
static const rt_custom_shape napkin_shape = {
    {-2, -2, -2}, {2, 2, 2}, {{0, 0, 0}, false}, pair_hit, &napkin_ring};
static const rt_box half_box = {{-3, -3, -3}, {3, 0.25f, 3}, {{0, 0, 0}, false}};
static const rt_custom_shape half_shape = {
    {-3, -3, -3}, {3, 0.25f, 3}, {{0, 0, 0}, false}, cube_hit, &half_box};
static const pair bowl = {A_AND_B, &napkin_shape, &half_shape};
static double bowl_f(rt_dvec3 p)
{
    return larger(napkin_f(p), p.y - 0.25);
}

#define PI 3.14159265358979
#define GREY                                                                             \
    {                                                                                    \
        {0.7f, 0.6f, 0.5f}, false                                                        \
    }

static const specimen specimens[] = {
    {"cylinder",
     {{-1, -1, 0}, {3, 2, 4}, GREY, cylinder_hit, &a_cylinder},
     cylinder_f,
     12 * PI,
     true},
    {"cone", {{-2, 0, -2}, {2, 3, 2}, GREY, cone_hit, &a_cone}, cone_f, 4 * PI, true},
    {"flat cone",
     {{-2, 2, 0}, {4, 2.5f, 6}, GREY, cone_hit, &flat_cone},
     flat_cone_f,
     1.5 * PI,
     true},
    {"needle",
     {{-0.1f, 0, -0.1f}, {0.1f, 4, 0.1f}, GREY, cone_hit, &needle},
     needle_f,
     0.04 / 3 * PI,
     true},
    {"box askew", {{1, -4, -1}, {5, 0, 3}, GREY, turned_hit, &askew}, askew_f, 6, true},
    {"egg",
     {{-2, -1, -0.5f}, {2, 3, 0.5f}, GREY, turned_hit, &an_egg},
     egg_f,
     4 * PI / 3,
     true},
    {"ring",
     {{-2.5f, -0.5f, -2.5f}, {2.5f, 0.5f, 2.5f}, GREY, field_hit, &ring_field},
     ring_f,
     PI *PI,
     false},
    {"A or B",
     {{-2, -2, -2}, {4, 2, 2}, GREY, pair_hit, &together},
     together_f,
     64 * PI / 3 - 10 * PI / 3,
     false},
    {"A and B",
     {{0, -2, -2}, {2, 2, 2}, GREY, pair_hit, &lens},
     lens_f,
     10 * PI / 3,
     true},
    {"A without B",
     {{-2, -2, -2}, {2, 2, 2}, GREY, pair_hit, &moon},
     moon_f,
     32 * PI / 3 - 10 * PI / 3,
     false},
    {"napkin ring",
     {{-2, -2, -2}, {2, 2, 2}, GREY, pair_hit, &napkin_ring},
     napkin_f,
     4 * 1.7320508 * PI,
     false},
    {"bowl",
     {{-2, -2, -2}, {2, 0.25f, 2}, GREY, pair_hit, &bowl},
     bowl_f,
     (3 * (0.25 + 1.7320508) - (0.25 * 0.0625 + 5.1961524) / 3) * PI,
     false},
};

enum { SPECIMENS = sizeof specimens / sizeof *specimens };

static float size_of(const specimen *s)
{
    return rt_length(rt_sub(s->shape.max, s->shape.min));
}

static rt_vec3 middle_of_box(const specimen *s)
{
    return rt_scale(rt_add(s->shape.min, s->shape.max), 0.5f);
}

static rt_vec3 in_the_box(const specimen *s, rt_rng *rng)
{
    return rt_add(s->shape.min,
                  rt_mul(random_colour(rng), rt_sub(s->shape.max, s->shape.min)));
}

static rt_scene scene_of(const rt_custom_shape *shapes, int count)
{
    rt_scene scene = empty;
    scene.custom_shapes = shapes;
    scene.custom_shape_count = count;
    return scene;
}

/* ---- each of them --------------------------------------------------------------------- */

/* Does F say the same? Before t the ray is always inside or always outside, as hit.inside says;
 * at t it changes. Without a hit nothing of the shape is on the ray. */
static void check_ray(const specimen *s, const rt_ray *ray, rt_rng *rng)
{
    const float size = size_of(s);
    const rt_dvec3 o = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const double length = sqrt(rt_ddot(u, u));
    const double close = 2e-6 * (double)(size + rt_length(ray->origin)) / length;
    rt_hit hit = untouched;
    const bool found = rt_hit_custom_shape(&s->shape, ray, FLT_MAX, &hit);
    const bool inside = found && hit.inside;
    const double end =
        found ? (double)hit.t : ((double)size + sqrt(rt_ddot(o, o))) / length;
    for (int i = 0; i < 40; i++) {
        const double t = close + (end - 2 * close) * (double)rt_random(rng);
        const double f = s->f(rt_dmad(o, t, u));
        if (t > close && (inside ? f > 1e-5 : f < -1e-5))
            fail_msg("%s: at %g, before t = %g, F is %g", s->name, t, end, f);
    }
    if (!found)
        return;
    const double behind = s->f(rt_dmad(o, end + 20 * close, u));
    const double at = s->f(rt_to_double(hit.point));
    const double along = fabs((double)rt_dot(hit.normal, ray->direction)) / length;
    const rt_dvec3 slope = gradient(s->f, rt_to_double(hit.point), 1e-4);
    const double steep = larger(1, sqrt(rt_ddot(slope, slope)));
    if (!(fabs(at) / steep < 2e-7 * (double)(1 + rt_length(hit.point))))
        fail_msg("%s: P is off by %g", s->name, at);
    rt_hit next = untouched;
    const rt_ray on =
        ray_of(rt_leave(hit.point, hit.normal, ray->direction), ray->direction);
    const bool thin = rt_hit_custom_shape(&s->shape, &on, FLT_MAX, &next) &&
                      (double)next.t < 30 * close;
    if (!thin && along > 0.5 && fabs(behind) > 1e-5 && (behind < 0) == inside)
        fail_msg("%s: behind t = %g, F is %g", s->name, end, behind);
    assert_vec(rt_at(ray, hit.t), hit.point.x, hit.point.y, hit.point.z,
               3e-6 * (double)(size + rt_length(ray->origin)));
    assert_true(hit.part >= 0 && hit.part <= 2 && hit.shape == 0);
    assert_ptr_equal(hit.material, &s->shape.material);
}

static void test_each_shape_is_where_it_should_be(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 280);
    for (int k = 0; k < SPECIMENS; k++)
        for (int i = 0; i < 3000; i++) {
            const specimen *s = &specimens[k];
            const rt_vec3 to = in_the_box(s, &rng);
            const rt_vec3 from =
                i % 3 == 0 ? in_the_box(s, &rng)
                           : rt_add(middle_of_box(s),
                                    rt_scale(random_direction(&rng), 2 * size_of(s)));
            rt_ray ray = ray_of(from, rt_sub(to, from));
            if (i % 5 == 0) /* along an axis */
                ray.direction = rt_vec(i % 3 == 0, i % 3 == 1, i % 3 == 2 ? -1.0f : 0.0f);
            if (i % 5 == 1)
                ray.direction = rt_scale(ray.direction, powf(10, uniform(&rng, -3, 3)));
            check_ray(s, &ray, &rng);
        }
}

static void test_by_hand(void **state)
{
    (void)state;
    const rt_ray rays[] = {{{0, 1.5f, -5}, {0, 0, 1}}, {{0, 1.5f, 0}, {0, 0, 2}},
                           {{0.5f, -3, 0}, {0, 1, 0}}, {{0, 3.5f, 0}, {0, -1, 0}},
                           {{0, 1.5f, -5}, {1, 0, 0}}, {{0, 15, -4}, {0, -3, 1}},
                           {{1, 0.5f, 0}, {0, -2, 0}}};
    const struct {
        float t, x, y, z, n_x, n_y, n_z;
        bool inside;
    } expected[] = {
        {4, 0, 1.5f, -1, 0, 2, -3, false}, {0.5f, 0, 1.5f, 1, 0, -2, -3, true},
        {3, 0.5f, 0, 0, 0, -1, 0, false},  {0.5f, 0, 3, 0, 0, 1, 0, false},
        {0, 0, 0, 0, 0, 0, 0, false},      {4, 0, 3, 0, 0, 1, 0, false},
        {0.25f, 1, 0, 0, 0, 1, 0, true}};
    const specimen *s = &specimens[1]; /* radius 2, height 3 */
    for (size_t i = 0; i < COUNT(rays); i++) {
        rt_hit hit = untouched;
        assert_int_equal(rt_hit_custom_shape(&s->shape, &rays[i], FLT_MAX, &hit),
                         expected[i].t > 0);
        if (expected[i].t == 0)
            continue;
        const rt_vec3 n =
            rt_normalize(rt_vec(expected[i].n_x, expected[i].n_y, expected[i].n_z));
        assert_close(hit.t, expected[i].t, 1e-6);
        assert_vec(hit.point, expected[i].x, expected[i].y, expected[i].z, 1e-6);
        if (i != 5) /* the tip, askew: any normal */
            assert_vec(hit.normal, n.x, n.y, n.z, 1e-6);
        assert_int_equal(hit.inside, expected[i].inside);
    }
}

/* A plane through (0,-1,0), up; its box cuts it off at 5 in x and z. */
static void test_a_plane(void **state)
{
    (void)state;
    const plane p = {{0, -1, 0}, {0, 7, 0}}; /* of any length */
    const rt_custom_shape shape = {{-5, -1, -5}, {5, -1, 5}, GREY, plane_hit, &p};
    const struct {
        rt_ray ray;
        float t;
        bool inside;
    } cases[] = {
        {{{0, 3, 0}, {1, -2, 0}}, 2, false},   {{{0, 3, 0}, {1, 0, 0}}, 0, false},
        {{{0, -1, 0}, {1, 0, 0}}, 0, false},   {{{0, 3, 0}, {0, 1, 0}}, 0, false},
        {{{0, -4, 0}, {0, 1.5f, 0}}, 2, true}, {{{0, 3, 0}, {5.2f, -4, 0}}, 0, false},
        {{{0, 3, 0}, {5, -4, 5}}, 1, false},   {{{9, 3, 0}, {0, -1, 0}}, 0, false}};
    for (size_t i = 0; i < COUNT(cases); i++) {
        rt_hit hit = untouched;
        const bool found = rt_hit_custom_shape(&shape, &cases[i].ray, FLT_MAX, &hit);
        assert_int_equal(found, cases[i].t > 0);
        if (!found) {
            assert_untouched(hit);
            continue;
        }
        assert_close(hit.t, cases[i].t, 0);
        assert_close(hit.point.y, -1, 0);
        assert_vec(hit.normal, 0, cases[i].inside ? -1 : 1, 0, 0);
        assert_int_equal(hit.inside, cases[i].inside);
    }
}

static void test_volumes(void **state)
{
    /* The ways of parallel rays inside, times the area that each stands for. */
    (void)state;
    enum { GRID = 160 };
    const rt_vec3 u = rt_normalize(rt_vec(1, -2, 3));
    rt_vec3 x, y;
    rt_basis(u, &x, &y);
    for (int k = 0; k < SPECIMENS; k++) {
        const specimen *s = &specimens[k];
        const float size = size_of(s);
        double sum = 0;
        for (int i = 0; i < GRID * GRID; i++) {
            const float right = size * (((float)(i % GRID) + 0.5f) / GRID - 0.5f);
            const float up = size * (((float)(i / GRID) + 0.5f) / GRID - 0.5f);
            const rt_vec3 beside = rt_add(rt_scale(x, right), rt_scale(y, up));
            rt_ray ray =
                ray_of(rt_sub(rt_add(middle_of_box(s), beside), rt_scale(u, size)), u);
            rt_hit hit = untouched;
            for (int n = 0; rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &hit); n++) {
                assert_int_equal(hit.inside, n % 2); /* in and out, in and out */
                sum += hit.inside ? (double)hit.t : 0;
                ray.origin = rt_leave(hit.point, hit.normal, u);
            }
        }
        const double volume = sum * pow((double)size / GRID, 2);
        if (!(fabs(volume / s->volume - 1) < (k == 3 ? 0.05 : 0.005)))
            fail_msg("%s: volume %g, should be %g", s->name, volume, s->volume);
    }
}

static void test_normals_are_the_slope(void **state)
{
    /* The gradient of F, by differences; but not across an edge, where it has a step. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 281);
    for (int k = 0; k < SPECIMENS; k++) {
        const specimen *s = &specimens[k];
        int compared = 0, edges = 0;
        for (int i = 0; i < 3000; i++) {
            const rt_vec3 from = rt_add(middle_of_box(s),
                                        rt_scale(random_direction(&rng), 2 * size_of(s)));
            const rt_vec3 to = in_the_box(s, &rng);
            rt_hit hit = untouched;
            rt_ray ray = ray_of(from, rt_sub(to, from));
            for (int n = 0; n < 2 && rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &hit);
                 n++, ray.origin = rt_leave(hit.point, hit.normal, ray.direction)) {
                const rt_dvec3 p = rt_to_double(hit.point);
                const rt_dvec3 a = rt_dnormalize(gradient(s->f, p, 1e-4)),
                               b = rt_dnormalize(gradient(s->f, p, 1e-3));
                assert_close(rt_length(hit.normal), 1, 1e-6);
                assert_true(rt_dot(hit.normal, ray.direction) <= 0);
                if (rt_ddot(a, b) < 0.9999) {
                    edges++;
                    continue;
                }
                const rt_dvec3 n_out =
                    rt_dscale(rt_to_double(hit.normal), hit.inside ? -1 : 1);
                compared++;
                if (!(rt_ddot(a, n_out) > 0.9999))
                    fail_msg(
                        "%s: at (%g, %g, %g) normal (%g, %g, %g), slope (%g, %g, %g)",
                        s->name, p.x, p.y, p.z, n_out.x, n_out.y, n_out.z, a.x, a.y, a.z);
            }
        }
        assert_true(compared > 1000 && edges < compared / 5);
    }
}

/* The same as a mesh of so many triangles that it is almost round. */
static rt_mesh fine_mesh(int k)
{
    static const double upright[4][2] = {{0, 0}, {2, 0}, {2, 3}, {0, 3}},
                        pointed[3][2] = {{0, 0}, {2, 0}, {0, 3}};
    rt_mesh m = k == 0   ? make_lathe(upright, 4, 400)
                : k == 1 ? make_lathe(pointed, 3, 400)
                : k == 5 ? make_icosphere(5)
                         : make_ring(2, 0.5, 200, 80);
    rt_vec3 *p = (rt_vec3 *)(uintptr_t)m.positions;
    for (int i = 0; k == 5 && i < m.position_count; i++)
        p[i] = rt_add(rt_add(an_egg.middle, rt_scale(an_egg.x, p[i].x)),
                      rt_add(rt_scale(an_egg.y, p[i].y), rt_scale(an_egg.z, p[i].z)));
    if (k == 0)
        place_mesh(&m, a_cylinder.base, 1, 0);
    return m;
}

static void test_against_a_fine_mesh(void **state)
{
    (void)state;
    const int which[] = {0, 1, 5, 6};
    rt_rng rng = rt_rng_start(0, 0, 282);
    for (size_t k = 0; k < COUNT(which); k++) {
        const specimen *s = &specimens[which[k]];
        rt_mesh mesh = fine_mesh(which[k]);
        rt_scene scene = empty;
        scene.meshes = &mesh;
        scene.mesh_count = 1;
        rt_bvh bvh;
        assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
        scene.bvh = &bvh;
        int both = 0, one = 0;
        for (int i = 0; i < 4000; i++) {
            const rt_vec3 from =
                i % 3 == 0 ? in_the_box(s, &rng)
                           : rt_add(middle_of_box(s),
                                    rt_scale(random_direction(&rng), 2 * size_of(s)));
            const rt_vec3 to = in_the_box(s, &rng);
            const rt_ray ray = ray_of(from, rt_normalize(rt_sub(to, from)));
            rt_hit a = untouched, b = untouched;
            const bool found = rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &a);
            const bool other = rt_intersect(&scene, &ray, &b);
            one += found != other || (found && a.inside != b.inside); /* at the rim */
            if (!found || !other || a.inside != b.inside)
                continue;
            both++;
            const float flat = fmaxf(0.02f, -rt_dot(a.normal, ray.direction));
            one += fabsf(a.t - b.t) * flat > 3e-3f || rt_dot(a.normal, b.normal) < 0.98f;
        }
        if (!(both > 1000 && one < 30))
            fail_msg("%s: %d alike, %d not", s->name, both, one);
        scene.bvh = NULL;
        rt_free_bvh(&bvh);
        free_mesh(&mesh);
    }
}

/* A point inside: by trying. */
static rt_vec3 a_point_inside(const specimen *s, rt_rng *rng)
{
    for (;;) {
        const rt_vec3 p = in_the_box(s, rng);
        if (s->f(rt_to_double(p)) < -0.01)
            return p;
    }
}

static void test_no_path_leaves_a_closed_shape(void **state)
{
    /* And outside, a ray that leaves a convex one does not meet it again. From 3 to 300
     * sizes away. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 283);
    for (int k = 0; k < SPECIMENS; k++) {
        const specimen *s = &specimens[k];
        rt_ray ray = ray_of(a_point_inside(s, &rng), random_direction(&rng));
        rt_hit hit = untouched;
        int lost = 0, again = 0;
        for (int i = 0; i < 20000; i++) {
            const bool found = rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &hit);
            if (!found || !hit.inside) {
                lost++;
                ray.origin = a_point_inside(s, &rng);
                continue;
            }
            const float r1 = rt_random(&rng);
            const float r2 = rt_random(&rng);
            ray.direction = rt_sample_cosine(hit.normal, r1, r2);
            ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
        }
        for (int i = 0; i < 10000; i++) {
            const float away = size_of(s) * (i % 2 ? 3.0f : 300.0f);
            const rt_vec3 from =
                rt_add(middle_of_box(s), rt_scale(random_direction(&rng), away));
            ray = ray_of(from, rt_normalize(rt_sub(in_the_box(s, &rng), from)));
            if (!rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &hit))
                continue;
            const float r1 = rt_random(&rng);
            const float r2 = rt_random(&rng);
            ray.direction = rt_sample_cosine(hit.normal, r1, r2);
            ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
            /* one that is not convex may be met again, but not at once */
            again += rt_hit_custom_shape(&s->shape, &ray, FLT_MAX, &hit) &&
                     (s->convex || (s->shape.hit == field_hit && hit.t < 1e-4f));
        }
        if (lost + again > 0)
            fail_msg("%s: %d of 20000 bounces left it, %d of 10000 rays met it again",
                     s->name, lost, again);
    }
}

static void test_the_box_may_be_tight(void **state)
{
    /* To a thousandth; what sticks out by more is not there, with a tree and without. */
    (void)state;
    const rt_ray ray = ray_of(rt_vec(0, 0, -5), rt_vec(0, 0, 1));
    for (int i = 0; i < 40; i++) {
        const float cut = 0.0001f * (float)i; /* of 2 */
        const rt_custom_shape shape = {
            {-1, -1, cut - 1}, {1, 1, 1}, GREY, ball_hit, &unit_ball};
        rt_scene scene = scene_of(&shape, 1);
        rt_bvh bvh;
        assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
        for (int tree = 0; tree < 2; tree++) {
            scene.bvh = tree ? &bvh : NULL;
            rt_hit hit = untouched;
            assert_int_equal(rt_intersect(&scene, &ray, &hit), i <= 20);
            assert_int_equal(rt_occluded(&scene, &ray, FLT_MAX), i <= 20);
        }
        scene.bvh = NULL;
        rt_free_bvh(&bvh);
    }
}

/* ---- in scenes ------------------------------------------------------------------------ */

static void many_shapes(rt_custom_shape *shapes, turned *places, int count, rt_rng *rng)
{
    static rt_custom_shape around[SPECIMENS]; /* balls: whatever they are turned by */
    for (int k = 0; k < SPECIMENS; k++)
        around[k] = specimens[k].shape;
    for (int i = 0; i < count; i++) {
        const specimen *s = &specimens[i % SPECIMENS];
        const float scale = uniform(rng, 0.1f, 0.4f);
        turned *t = &places[i];
        t->z = random_direction(rng);
        rt_basis(t->z, &t->x, &t->y);
        t->x = rt_scale(t->x, scale);
        t->y = rt_scale(t->y, scale);
        t->z = rt_scale(t->z, scale);
        t->middle = random_point(rng, 6);
        t->shape = &around[i % SPECIMENS];
        const float r = 1.01f * scale *
                        (size_of(s) + rt_length(middle_of_box(s))); /* more than enough */
        shapes[i].min = rt_sub(t->middle, rt_vec(r, r, r));
        shapes[i].max = rt_add(t->middle, rt_vec(r, r, r));
        shapes[i].material.albedo = random_colour(rng);
        shapes[i].material.mirror = i % 4 == 0;
        shapes[i].hit = turned_hit;
        shapes[i].data = t;
    }
}

static void test_the_tree_finds_what_the_loop_finds(void **state)
{
    (void)state;
    enum { MANY = 60 };
    static rt_custom_shape shapes[MANY];
    static turned places[MANY];
    rt_rng rng = rt_rng_start(0, 0, 284);
    many_shapes(shapes, places, MANY, &rng);
    const int counts[] = {1, 5, MANY};
    int hits = 0;
    for (size_t k = 0; k < COUNT(counts); k++) {
        rt_scene scene = scene_of(shapes, counts[k]);
        rt_bvh bvh;
        assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
        for (int i = 0; i < 3000; i++) {
            const rt_vec3 from = random_point(&rng, 8);
            const rt_vec3 to = places[i % counts[k]].middle;
            const rt_ray ray =
                ray_of(from, rt_sub(rt_add(to, random_point(&rng, 0.5f)), from));
            const float t_max = 2 * rt_random(&rng);
            rt_hit a, b;
            memset(&a, 0, sizeof a);
            memset(&b, 0, sizeof b);
            scene.bvh = NULL;
            const bool found = rt_intersect(&scene, &ray, &a);
            const bool hidden = rt_occluded(&scene, &ray, t_max);
            scene.bvh = &bvh;
            assert_int_equal(rt_intersect(&scene, &ray, &b), found);
            assert_int_equal(rt_occluded(&scene, &ray, t_max), hidden);
            assert_memory_equal(&a.point, &b.point, sizeof a.point);
            assert_memory_equal(&a.normal, &b.normal, sizeof a.normal);
            assert_true(a.t == b.t && a.shape == b.shape && a.part == b.part &&
                        a.inside == b.inside && a.material == b.material);
            hits += found;
        }
        scene.bvh = NULL;
        rt_free_bvh(&bvh);
    }
    assert_true(hits > 3000);
}

enum { W = 24, H = 18 };

static rt_image drawn(const rt_scene *scene, int lanes, int bounces)
{
    const rt_camera camera = {.position = {0, 0, 13}, .fov_y = 60};
    const rt_options options = {.samples = 2, .bounces = bounces, .lanes = lanes};
    rt_image image = new_image(W, H);
    assert_int_equal(rt_render(scene, &camera, &options, &image), RT_OK);
    for (int i = 0; i < W * H; i++) {
        const rt_vec3 p = image.pixels[i];
        assert_true(p.x >= 0 && p.y >= 0 && p.z >= 0 && p.x <= FLT_MAX &&
                    p.y <= FLT_MAX && p.z <= FLT_MAX);
    }
    return image;
}

static rt_vec3 stripes(const void *data, rt_vec3 point, rt_vec3 normal)
{
    (void)data;
    return rt_vec(point.x - floorf(point.x), 0.5f, fabsf(normal.y));
}

static void test_lanes_draw_what_one_ray_draws(void **state)
{
    /* Few and many, with spheres, boxes and a mesh among them; matt, and glass, gloss, patterns. */
    (void)state;
    enum { MANY = 40, ALL = 4 + MANY };
    static rt_custom_shape shapes[MANY];
    static turned places[MANY];
    static rt_surface surfaces[ALL];
    rt_rng rng = rt_rng_start(0, 0, 285);
    many_shapes(shapes, places, MANY, &rng);
    const rt_sphere spheres[2] = {{{0, -108, 0}, 100, GREY}, {{-3, 0, 4}, 1, GREY}};
    const rt_box box = {{2, -2, 3}, {4, 0, 5}, GREY};
    rt_mesh mesh = make_ring(3, 0.4, 16, 8);
    const rt_light light = {{5, 8, 9}, {300, 300, 300}};
    for (int i = 0; i < ALL; i++) {
        surfaces[i].eta = i % 5 == 1 ? 1.5f : 0;
        surfaces[i].shininess = i % 3 == 1 ? 40 : 0;
        surfaces[i].pattern = i % 4 == 2 ? stripes : NULL;
        surfaces[i].absorption = rt_vec(0.3f, 0, 0.1f);
    }
    const int counts[] = {1, 3, 12, MANY};
    for (size_t k = 0; k < 2 * COUNT(counts); k++) {
        rt_scene scene = scene_of(shapes, counts[k / 2]);
        scene.spheres = spheres;
        scene.sphere_count = k < 6 ? 2 : 0;
        scene.boxes = &box;
        scene.box_count = k % 3 == 0;
        scene.meshes = &mesh;
        scene.mesh_count = k % 4 < 2;
        scene.surfaces = k % 2 ? surfaces : NULL;
        scene.lights = &light;
        scene.light_count = 1;
        scene.background = rt_vec(0.2f, 0.3f, 0.4f);
        rt_image one = drawn(&scene, 1, 4), all = drawn(&scene, rt_lane_count(0), 4);
        assert_true(same_pixels(&one, &all));
        assert_int_equal(one.rays, all.rays);
        free(one.pixels);
        free(all.pixels);
    }
    free_mesh(&mesh);
}

static void test_glass_of_ones_own(void **state)
{
    /* A ball by its own function is rt.h's ball. Any closed shape of clear glass vanishes
     * in an even light. */
    (void)state;
    const rt_surface glass = {.eta = 1.5f, .absorption = {0.2f, 0, 0.4f}};
    const rt_sphere ball = {{0, 0, 0}, 4, GREY};
    const rt_custom_shape own = {{-4, -4, -4}, {4, 4, 4}, GREY, ball_hit, &ball};
    for (int kind = 0; kind < 2; kind++) {
        rt_scene a = empty, b = scene_of(&own, 1);
        a.spheres = &ball;
        a.sphere_count = 1;
        a.surfaces = b.surfaces = kind ? &glass : NULL;
        const rt_light light = {{5, 8, 9}, {300, 300, 300}};
        a.lights = b.lights = &light;
        a.light_count = b.light_count = 1;
        a.background = b.background = rt_vec(0.2f, 0.3f, 0.4f);
        rt_image one = drawn(&a, 0, 6), two = drawn(&b, 0, 6);
        for (int i = 0; i < W * H; i++)
            assert_vec(one.pixels[i], two.pixels[i].x, two.pixels[i].y, two.pixels[i].z,
                       1e-5);
        free(one.pixels);
        free(two.pixels);
    }
    const rt_surface clear = {.eta = 1.5f};
    rt_rng rng = rt_rng_start(0, 0, 286);
    for (int k = 0; k < SPECIMENS; k++)
        for (uint32_t i = 0; i < 500; i++) {
            const specimen *s = &specimens[k];
            rt_scene scene = scene_of(&s->shape, 1);
            scene.surfaces = &clear;
            scene.background = rt_vec(1, 1, 1);
            const rt_vec3 from = rt_add(middle_of_box(s),
                                        rt_scale(random_direction(&rng), 2 * size_of(s)));
            const rt_ray ray =
                ray_of(from, rt_normalize(rt_sub(in_the_box(s, &rng), from)));
            assert_vec(rt_radiance_mis(&scene, &ray, 100000, &rng), 1, 1, 1, 0);
        }
}

/* ---- functions that lie --------------------------------------------------------------- */

typedef struct lie {
    float t;
    rt_vec3 point, normal;
    bool yes;
} lie;

static bool say(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const lie *l = (const lie *)data;
    (void)ray, (void)t_max;
    hit->t = l->t;
    hit->point = l->point;
    hit->normal = l->normal;
    hit->part = 9;
    hit->u = 0.25f;
    hit->v = 0.5f;
    hit->shape = 12345; /* none of these is its to say */
    hit->inside = true;
    hit->material = NULL;
    return l->yes;
}

/* An answer that makes no sense is a miss, and leaves *hit alone; one that does is
 * completed. */
static void test_what_makes_no_sense_is_a_miss(void **state)
{
    (void)state;
    static const struct {
        const char *what;
        lie lie;
        float t_max;
        bool found;
    } cases[] = {
        {"good", {2, {0, 0, 1}, {0, 0, 1}, true}, 3, true},
        {"no", {2, {0, 0, 1}, {0, 0, 1}, false}, 3, false},
        {"t NaN", {NAN, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t infinite", {INFINITY, {0, 0, 1}, {0, 0, 1}, true}, FLT_MAX, false},
        {"t infinite, t_max too",
         {INFINITY, {0, 0, 1}, {0, 0, 1}, true},
         INFINITY,
         false},
        {"t 0", {0, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t -0", {-0.0f, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t below 0", {-1, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t a denormal", {1e-45f, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t is t_max", {3, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t beyond t_max", {4, {0, 0, 1}, {0, 0, 1}, true}, 3, false},
        {"t_max NaN", {2, {0, 0, 1}, {0, 0, 1}, true}, NAN, false},
        {"no normal", {2, {0, 0, 1}, {0, 0, 0}, true}, 3, false},
        {"normal NaN", {2, {0, 0, 1}, {NAN, 0, 1}, true}, 3, false},
        {"normal infinite", {2, {0, 0, 1}, {0, 0, INFINITY}, true}, 3, false},
        {"normal long", {2, {0, 0, 1}, {0, 0, 1e38f}, true}, 3, true},
        {"normal short", {2, {0, 0, 1}, {0, 0, 1e-38f}, true}, 3, true},
        {"P NaN", {2, {0, NAN, 1}, {0, 0, 1}, true}, 3, false},
        {"P infinite", {2, {0, 0, INFINITY}, {0, 0, 1}, true}, 3, false},
        {"P in the box", {2, {0.5f, 0, -0.5f}, {0, 0, 1}, true}, 3, true},
        {"P a little outside", {2, {0, 0, 1.0019f}, {0, 0, 1}, true}, 3, true},
        {"P outside", {2, {0, 0, 1.0021f}, {0, 0, 1}, true}, 3, false},
        {"P far outside", {2, {0, -9, 0}, {0, 0, 1}, true}, 3, false},
    };
    const rt_ray ray = ray_of(rt_vec(0, 0, 3), rt_vec(0, 0, -1));
    for (size_t i = 0; i < COUNT(cases); i++)
        for (int turn = 0; turn < 2; turn++) {
            lie l = cases[i].lie;
            l.normal = turn ? rt_scale(l.normal, -1) : l.normal;
            const rt_custom_shape shape = {{-1, -1, -1}, {1, 1, 1}, GREY, say, &l};
            rt_hit hit = untouched;
            const bool found = rt_hit_custom_shape(&shape, &ray, cases[i].t_max, &hit);
            if (found != cases[i].found)
                fail_msg("%s: %d", cases[i].what, found);
            if (!found) {
                assert_untouched(hit);
                continue;
            }
            assert_close(hit.t, l.t, 0);
            assert_vec(hit.normal, 0, 0, 1, 0); /* to the ray, of length 1 */
            assert_int_equal(hit.inside, turn);
            assert_int_equal(hit.shape, 0);
            assert_int_equal(hit.part, 9);
            assert_true(hit.u == 0.25f && hit.v == 0.5f);
            assert_ptr_equal(hit.material, &shape.material);
        }
}

/* Whatever they are asked: yes, and close. */
static bool always(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const float part = *(const float *)data;
    hit->t = part > 0 ? part * t_max : 2e-38f;
    hit->point = rt_vec(0, 0, 0);
    hit->normal = rt_scale(ray->direction, part > 0.5f ? 1 : -1);
    return true;
}

/* Yes, no, anywhere: another answer for each t_max, and each ray. */
static bool at_random(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    uint32_t bits[7];
    float numbers[7];
    memcpy(bits, ray, 6 * sizeof *bits);
    memcpy(bits + 6, &t_max, sizeof *bits);
    uint32_t h = *(const float *)data > 0 ? 1 : 2;
    for (int i = 0; i < 7; i++)
        h = rt_hash(h ^ bits[i]);
    for (int i = 0; i < 7; i++) { /* any bits at all, now and then */
        h = rt_hash(h + 1);
        numbers[i] = (float)(h >> 8) / 8388608.0f - 1;
        if (h % 11 == 0)
            memcpy(&numbers[i], &h, sizeof h);
    }
    hit->t = 10 * fabsf(numbers[0]);
    hit->point = rt_vec(numbers[1], numbers[2], numbers[3]);
    hit->normal = rt_vec(numbers[4], numbers[5], numbers[6]);
    return h % 3 != 0;
}

/* It finds nothing the second time, when rt_intersect asks for the point. */
static bool only_within(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    return t_max < FLT_MAX && always(data, ray, t_max, hit);
}

static void test_lies_do_no_harm(void **state)
{
    /* A finite picture, with the same bits for all lanes; no crash, no endless path. */
    (void)state;
    static const float parts[] = {0, 0.25f, 0.999f};
    rt_hit_function *const functions[] = {always, at_random, only_within};
    const rt_surface surfaces[3] = {{.eta = 1.5f}, {.shininess = 9}, {.eta = 0}};
    const rt_light light = {{5, 8, 9}, {300, 300, 300}};
    const rt_sphere ball = {{2, 0, 0}, 2, GREY};
    for (int i = 0; i < 27; i++) {
        rt_custom_shape shapes[2] = {
            {{-1, -1, -1}, {1, 1, 1}, GREY, functions[i / 3 % 3], &parts[i % 3]},
            {{-1, -1, -1}, {1, 1, 1}, GREY, functions[i / 9], &parts[i % 3]}};
        shapes[0].material.mirror = i % 2 == 0;
        rt_scene scene = scene_of(shapes, 2);
        scene.spheres = &ball;
        scene.sphere_count = 1;
        scene.lights = &light;
        scene.light_count = 1;
        scene.surfaces = i % 4 ? surfaces : NULL;
        scene.background = rt_vec(1, 1, 1);
        rt_image one = drawn(&scene, 1, 30), all = drawn(&scene, rt_lane_count(0), 30);
        /* a tree that asks in another order may hear other lies */
        if (functions[i / 3 % 3] == say)
            assert_true(same_pixels(&one, &all));
        free(one.pixels);
        free(all.pixels);
    }
}

static void test_bad_boxes_and_no_function_are_refused(void **state)
{
    (void)state;
    rt_custom_shape shapes[2] = {specimens[0].shape, specimens[1].shape};
    const rt_custom_shape good = shapes[1];
    rt_scene scene = scene_of(shapes, 2);
    rt_bvh bvh;
    int index = -7;
    assert_int_equal(rt_check_scene(&scene, &index), RT_OK);
    const float bad[] = {nan_, inf, -inf, 1.01e15f, -1.01e15f};
    for (int i = 0; i < 43; i++) {
        rt_custom_shape *s = &shapes[1];
        float *const numbers[6] = {&s->min.x, &s->min.y, &s->min.z,
                                   &s->max.x, &s->max.y, &s->max.z};
        float *const albedo[3] = {&s->material.albedo.x, &s->material.albedo.y,
                                  &s->material.albedo.z};
        if (i < 30)
            *numbers[i % 6] = bad[i / 6];
        else if (i < 33) /* min above max */
            *numbers[i - 30] = nextafterf(*numbers[i - 27], 1e9f);
        else if (i < 36)
            *albedo[i - 33] = -0.1f;
        else if (i < 39)
            *albedo[i - 36] = 1.1f;
        else if (i < 42)
            *albedo[i - 39] = nan_;
        else
            s->hit = NULL;
        assert_int_equal(rt_check_scene(&scene, &index), RT_BAD_CUSTOM_SHAPE);
        assert_int_equal(index, 1);
        assert_int_equal(rt_build_bvh(&scene, &bvh), RT_BAD_CUSTOM_SHAPE);
        *s = good;
    }
    assert_true(strlen(rt_status_text(RT_BAD_CUSTOM_SHAPE)) > 20);
    shapes[1].data = NULL;         /* is nobody's business */
    shapes[1].min = shapes[1].max; /* nor is a point */
    assert_int_equal(rt_check_scene(&scene, &index), RT_OK);
    scene.custom_shape_count = -1;
    assert_int_equal(rt_check_scene(&scene, &index), RT_BAD_POINTER);
    scene.custom_shape_count = 1;
    scene.custom_shapes = NULL;
    assert_int_equal(rt_check_scene(&scene, &index), RT_BAD_POINTER);
}

static void test_a_traced_path_says_which_part(void **state)
{
    (void)state;
    const rt_custom_shape shape =
        specimens[0].shape; /* 0 the side, 1 the bottom, 2 the top */
    const rt_scene scene = scene_of(&shape, 1);
    const rt_camera camera = {
        .position = {1, 9, 9}, .direction = {0, -1, -0.8f}, .fov_y = 60};
    const rt_options options = {.samples = 1};
    rt_image image = new_image(W, H);
    int seen[3] = {0, 0, 0};
    for (int i = 0; i < W * H; i++) {
        rt_vertex vertices[2];
        rt_path path;
        memset(&path, 0, sizeof path);
        path.vertices = vertices;
        path.max_vertices = 2;
        assert_int_equal(
            rt_trace_pixel(&scene, &camera, &options, &image, i % W, i / W, 0, &path),
            RT_OK);
        if (vertices[0].shape < 0)
            continue;
        const rt_hit *hit = &vertices[0].hit;
        seen[hit->part]++;
        assert_int_equal(hit->shape, 0);
        assert_true(hit->part == 2 ? hit->normal.y > 0.99f
                                   : fabsf(hit->normal.y) < 1e-6f);
        assert_false(hit->inside);
    }
    free(image.pixels);
    assert_true(seen[0] > 10 && seen[1] == 0 && seen[2] > 10);
}

/* ---- the demo ------------------------------------------------------------------------- */

static void test_demo_routine_is_that_of_shapes_h(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 287);
    int hits = 0;
    for (int i = 0; i < 100000; i++) {
        const rt_ray ray = ray_of(random_point(&rng, 6), random_direction(&rng));
        const float t_max = i % 3 ? FLT_MAX : 9 * rt_random(&rng);
        rt_hit a = untouched, b = untouched;
        const bool found = hit_cylinder(&a_cylinder, &ray, t_max, &a);
        assert_int_equal(cylinder_hit(&a_cylinder, &ray, t_max, &b), found);
        hits += found;
        assert_true(!found || (a.t == b.t && a.part == b.part));
        assert_memory_equal(&a.point, &b.point, sizeof a.point);
        assert_memory_equal(&a.normal, &b.normal, sizeof a.normal);
    }
    assert_true(hits > 5000);
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_each_shape_is_where_it_should_be),
        cmocka_unit_test(test_by_hand),
        cmocka_unit_test(test_a_plane),
        cmocka_unit_test(test_volumes),
        cmocka_unit_test(test_normals_are_the_slope),
        cmocka_unit_test(test_against_a_fine_mesh),
        cmocka_unit_test(test_no_path_leaves_a_closed_shape),
        cmocka_unit_test(test_the_box_may_be_tight),
        cmocka_unit_test(test_the_tree_finds_what_the_loop_finds),
        cmocka_unit_test(test_lanes_draw_what_one_ray_draws),
        cmocka_unit_test(test_glass_of_ones_own),
        cmocka_unit_test(test_what_makes_no_sense_is_a_miss),
        cmocka_unit_test(test_lies_do_no_harm),
        cmocka_unit_test(test_bad_boxes_and_no_function_are_refused),
        cmocka_unit_test(test_a_traced_path_says_which_part),
        cmocka_unit_test(test_demo_routine_is_that_of_shapes_h),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("17 own shapes", tests, NULL, NULL);
}

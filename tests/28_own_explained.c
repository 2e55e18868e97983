/* What the window tells of a picture that a student's routines have made: here some that are wrong,
 * in the place of rt.h's in the whole program. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#define rt_hit_sphere my_hit_sphere
#define rt_lambert my_lambert
#define rt_reflect my_reflect
#define rt_direct my_direct
#define rt_sample_gloss my_sample_gloss
#include "../demos/viewer.c"

#include "../demos/live.h"
#include "explained.h"

double demo_seconds(void)
{
    return 0;
}

/* A little too far away. */
static bool my_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                          rt_hit *hit)
{
    const rt_vec3 f = rt_sub(ray->origin, sphere->center), u = ray->direction;
    const float a = rt_dot(u, u), b = rt_dot(f, u);
    const float d = b * b - a * (rt_dot(f, f) - sphere->radius * sphere->radius);
    if (!(d > 0))
        return false;
    float t = (-b - sqrtf(d)) / a;
    if (!(t > 0))
        t = (-b + sqrtf(d)) / a;
    if (!(t > 0 && t < t_max))
        return false;
    hit->t = t * 1.001f < t_max ? t * 1.001f : t;
    hit->point = rt_at(ray, hit->t);
    hit->normal = rt_scale(rt_sub(hit->point, sphere->center),
                           0.9f / sphere->radius); /* too short */
    hit->material = &sphere->material;
    return true;
}

/* No pi, and light from behind. */
static rt_vec3 my_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                          rt_vec3 intensity)
{
    const float d = rt_length(to_light);
    return rt_scale(rt_mul(albedo, intensity),
                    fabsf(rt_dot(normal, to_light)) / (d * d * d));
}

static rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_add(rt_sub(incident, rt_scale(normal, 2 * rt_dot(incident, normal))),
                  rt_vec(0.1f, 0, 0));
}

/* No shadows: it asks the scene nothing. */
static rt_vec3 my_direct(const rt_scene *scene, const rt_hit *hit, rt_rng *rng)
{
    (void)rng;
    rt_vec3 sum = {0, 0, 0};
    for (int i = 0; i < scene->light_count; i++)
        sum = rt_add(sum, rt_lambert(hit->material->albedo, hit->normal,
                                     rt_sub(scene->lights[i].position, hit->point),
                                     scene->lights[i].intensity));
    return sum;
}

static rt_vec3 my_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess, float r1,
                               float r2)
{
    (void)to_eye, (void)shininess;
    return rt_sample_cosine(normal, r1, r2);
}

/* As tests/classroom/show.c has it. */
static int own_stage;

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const live_context stage = live_stage(own_stage, view);
    return live_pixel(&stage, x, y, rng);
}

static void test_what_is_told_of_a_students_picture(void **state)
{
    (void)state;
    for (own_stage = 1; own_stage <= VIEWER_STAGES; own_stage++) {
        const demo mine = {
            .pixel = pixel, .live = &live_room, .stage = own_stage, .encode = demo_gamma};
        const rt_options options = {.samples = 1, .bounces = own_stage < 8 ? 5 : 8};
        viewer v;
        assert_true(viewer_open(&v, &mine, 40, 30, &options, false));
        assert_int_equal(viewer_render(&v, &options), RT_OK);
        const int own = expect_stage_explained(&v);
        if (own_stage == STAGE_INDIRECT) /* rt_radiance calls my_direct, unheard */
            assert_true(own > EXPLAINED / 2);
        else
            assert_int_equal(own, 0);
        viewer_close(&v);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_is_told_of_a_students_picture),
    };
    return cmocka_run_group_tests_name("28 own explained", tests, NULL, NULL);
}

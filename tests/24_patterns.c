/* Chapter 15: patterns. */
#define DEMO "../demos/demo15_patterns.c"
#include "test.h"

static const rt_scene empty; /* all zero */

static rt_vec3 constant(const void *data, rt_vec3 point, rt_vec3 normal)
{
    (void)point;
    (void)normal;
    return *(const rt_vec3 *)data;
}

/* White and black squares, one unit large. */
static rt_vec3 checker(const void *data, rt_vec3 point, rt_vec3 normal)
{
    (void)data;
    (void)normal;
    const int x = (int)floorf(point.x), z = (int)floorf(point.z);
    return (x + z) % 2 == 0 ? rt_vec(1, 1, 1) : rt_vec(0, 0, 0);
}

typedef struct noted {
    rt_vec3 point, normal;
    int calls;
} noted;

static rt_vec3 noting(const void *data, rt_vec3 point, rt_vec3 normal)
{
    noted *n = *(noted *const *)data;
    n->point = point;
    n->normal = normal;
    n->calls++;
    return rt_vec(0.5f, 0.25f, 1);
}

static const rt_box floor_box = {
    {-50, -1, -50}, {50, 0, 50}, {{0.9f, 0.8f, 0.7f}, false}};

static rt_scene of_box(const rt_box *box, const rt_surface *surface)
{
    rt_scene scene = empty;
    scene.boxes = box;
    scene.box_count = 1;
    scene.surfaces = surface;
    return scene;
}

static void test_what_a_pattern_returns_is_an_albedo(void **state)
{
    (void)state;
    const rt_vec3 odd[] = {{NAN, -1, 2},
                           {INFINITY, -INFINITY, 1e30f},
                           {0, 1, 0.3f},
                           {-0.0f, 1e-40f, 1.0001f}};
    const rt_vec3 albedos[] = {{0, 0, 1}, {1, 0, 1}, {0, 1, 0.3f}, {0, 1e-40f, 1}};
    for (size_t i = 0; i < COUNT(odd); i++) {
        const rt_surface surface = {.pattern = constant, .pattern_data = &odd[i]};
        const rt_scene scene = of_box(&floor_box, &surface);
        const rt_ray ray = ray_of(rt_vec(0, 1, 0), rt_vec(0, -1, 0));
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        const rt_vec3 rho = rt_albedo(&surface, &hit);
        assert_vec(rho, albedos[i].x, albedos[i].y, albedos[i].z, 0);
        const rt_surface none = {.eta = 0};
        assert_vec(rt_albedo(&none, &hit), (double)0.9f, (double)0.8f, (double)0.7f, 0);
    }
}

static void test_a_pattern_gets_the_point_and_the_normal(void **state)
{
    (void)state;
    noted n = {.calls = 0};
    noted *const data = &n;
    const rt_surface surfaces[2] = {{.pattern = noting, .pattern_data = &data},
                                    {.pattern = noting, .pattern_data = &data}};
    const rt_sphere ball = {{1, 2, -5}, 1, {{1, 1, 1}, false}};
    rt_scene scene = of_box(&floor_box, surfaces);
    scene.spheres = &ball;
    scene.sphere_count = 1;
    rt_rng rng = rt_rng_start(0, 0, 270);
    int on_ball = 0;
    for (int i = 0; i < 1000; i++) {
        const rt_vec3 from = rt_add(rt_vec(1, 4, -5), random_point(&rng, 1.5f));
        const rt_ray ray = ray_of(from, rt_normalize(rt_vec(0.1f, -1, 0.2f)));
        rt_hit hit = untouched;
        if (!rt_intersect(&scene, &ray, &hit))
            continue;
        n.calls = 0;
        rt_radiance_mis(&scene, &ray, 0, &rng);
        assert_int_equal(n.calls, 1);
        assert_memory_equal(&n.point, &hit.point, sizeof hit.point);
        assert_memory_equal(&n.normal, &hit.normal, sizeof hit.normal);
        on_ball += hit.shape == 0;
    }
    assert_in_range(on_ball, 100, 900);
}

static void test_a_checker_on_the_floor(void **state)
{
    /* White squares are as bright as chapter 4 says, black ones black. */
    (void)state;
    const rt_surface surface = {.pattern = checker};
    const rt_light light = {{0, 3, 0}, {30, 30, 30}};
    rt_scene scene = of_box(&floor_box, &surface);
    scene.lights = &light;
    scene.light_count = 1;
    rt_rng rng = rt_rng_start(0, 0, 271);
    int white = 0;
    for (int i = 0; i < 2000; i++) {
        const rt_vec3 end = {uniform(&rng, -5, 5), 0, uniform(&rng, -5, 5)};
        const rt_vec3 from = {0.3f, 2, -0.4f};
        const rt_ray ray = ray_of(from, rt_normalize(rt_sub(end, from)));
        const rt_vec3 seen = rt_radiance_mis(&scene, &ray, 0, &rng);
        const double dd = (double)(end.x * end.x + end.z * end.z) + 9;
        const float off_x = fabsf(end.x - rintf(end.x)),
                    off_z = fabsf(end.z - rintf(end.z));
        if (off_x < 1e-4f || off_z < 1e-4f)
            continue; /* on the line between two squares */
        const bool is_white = ((int)floorf(end.x) + (int)floorf(end.z)) % 2 == 0;
        white += is_white;
        assert_close(seen.x, is_white ? 30 / 3.14159265 * 3 / sqrt(dd) / dd : 0, 1e-5);
    }
    assert_in_range(white, 800, 1200);
}

static void test_light_goes_on_with_the_pattern(void **state)
{
    /* In an even light a ball shows its pattern; twice where the light came by way of the
     * ball. */
    (void)state;
    const rt_surface surface = {.pattern = checker};
    rt_scene scene = of_box(&floor_box, &surface);
    scene.background = rt_vec(1, 1, 1);
    rt_rng rng = rt_rng_start(0, 0, 272);
    for (int i = 0; i < 2000; i++) {
        const rt_vec3 end = {uniform(&rng, -5, 5), 0, uniform(&rng, -5, 5)};
        const rt_vec3 from = {0.3f, 2, -0.4f};
        const rt_ray ray = ray_of(from, rt_normalize(rt_sub(end, from)));
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        const rt_vec3 rho = checker(NULL, hit.point, hit.normal);
        assert_vec(rt_radiance_mis(&scene, &ray, 1, &rng), rho.x, rho.y, rho.z, 1e-6);
    }
}

static const rt_lamp lamp = {.center = {3, 5, 2}, .radius = 1, .intensity = {60, 50, 40}};
static const rt_light light = {{-4, 5, 0}, {30, 40, 50}};

/* A ball of each kind on a floor: matt, mirror, metal, plastic. */
static rt_image picture_of(bool by_pattern, rt_vec3 colour)
{
    const bool mirror[4] = {false, true, true, false};
    const float shininess[4] = {0, 0, 60, 60};
    rt_sphere balls[4] = {{{0, 0, 0}, 1, {{0, 0, 0}, false}}};
    rt_surface surfaces[5] = {{.eta = 0}};
    for (int i = 0; i < 4; i++) {
        balls[i].center = rt_vec(2.2f * (float)i - 3.3f, 1, -7);
        balls[i].radius = 1;
        balls[i].material.mirror = mirror[i];
        surfaces[i].shininess = shininess[i];
        if (by_pattern) {
            balls[i].material.albedo = rt_vec(0.1f, 0.9f, 0.4f); /* does not count */
            surfaces[i].pattern = constant;
            surfaces[i].pattern_data = &colour;
        } else {
            balls[i].material.albedo = colour;
        }
    }
    rt_scene scene = of_box(&floor_box, surfaces);
    scene.spheres = balls;
    scene.sphere_count = 4;
    scene.lamps = &lamp;
    scene.lamp_count = 1;
    scene.lights = &light;
    scene.light_count = 1;
    scene.background = rt_vec(0.2f, 0.3f, 0.4f);
    const rt_camera camera = {.position = {0, 2, 0}, .direction = {0, -0.2f, -1}};
    const rt_options options = {.samples = 4, .bounces = 4};
    rt_image image = new_image(40, 20);
    image.half = new_image(40, 20).pixels;
    image.guides = calloc(40 * 20, sizeof *image.guides);
    assert_non_null(image.guides);
    assert_int_equal(rt_render(&scene, &camera, &options, &image), RT_OK);
    return image;
}

static void free_all(rt_image *image)
{
    free(image->pixels);
    free(image->half);
    free(image->guides);
}

static void test_a_pattern_of_one_colour_is_an_albedo(void **state)
{
    /* The same bits on matt, mirror, metal and plastic, and in the guides. */
    (void)state;
    rt_image a = picture_of(false, rt_vec(0.8f, 0.5f, 0.3f)),
             b = picture_of(true, rt_vec(0.8f, 0.5f, 0.3f)),
             c = picture_of(true, rt_vec(0.3f, 0.5f, 0.8f));
    assert_true(same_pixels(&a, &b));
    assert_memory_equal(a.guides, b.guides, 40 * 20 * sizeof *a.guides);
    assert_false(same_pixels(&a, &c));
    free_all(&a);
    free_all(&b);
    free_all(&c);
}

static void test_black_of_a_pattern_is_black_on_a_mirror(void **state)
{
    /* An albedo of 0 in the material of a mirror means 1, since a material may be all
     * zero; what a pattern returns means what it says. */
    (void)state;
    const rt_surface surfaces[2] = {{.pattern = checker},
                                    {.pattern = checker, .shininess = 100}};
    rt_box mirror = floor_box;
    mirror.material.mirror = true;
    for (int k = 0; k < 2; k++) {
        rt_scene scene = of_box(&mirror, &surfaces[k]);
        scene.background = rt_vec(1, 2, 3);
        const rt_ray white = ray_of(rt_vec(0.5f, 2, 0.5f), rt_vec(0, -1, 0)),
                     black = ray_of(rt_vec(1.5f, 2, 0.5f), rt_vec(0, -1, 0));
        rt_rng rng = rt_rng_start(0, 0, 273);
        assert_true(rt_radiance_mis(&scene, &white, 1, &rng).x > 0.5f);
        assert_vec(rt_radiance_mis(&scene, &black, 1, &rng), 0, 0, 0, 0);
        const rt_surface plain = {.shininess = surfaces[k].shininess};
        rt_box zero = mirror;
        zero.material.albedo = rt_vec(0, 0, 0);
        scene = of_box(&zero, &plain);
        scene.background = rt_vec(1, 2, 3);
        assert_true(rt_radiance_mis(&scene, &black, 1, &rng).x > 0.5f);
    }
}

static void test_a_black_pattern_with_any_number_of_lanes(void **state)
{
    (void)state;
    const rt_surface surfaces[2] = {{.pattern = checker},
                                    {.pattern = checker, .shininess = 100}};
    for (int k = 0; k < 2; k++) {
        rt_box mirror = floor_box;
        mirror.material.mirror = true;
        rt_scene scene = of_box(&mirror, &surfaces[k]);
        scene.background = rt_vec(1, 2, 3);
        const rt_camera camera = {.position = {0, 4, 0}, .direction = {0, -0.5f, -1}};
        rt_options options = {.samples = 2, .bounces = 2};
        rt_image a = new_image(40, 20), b = new_image(40, 20);
        assert_int_equal(rt_render(&scene, &camera, &options, &a), RT_OK);
        options.lanes = 1;
        assert_int_equal(rt_render(&scene, &camera, &options, &b), RT_OK);
        assert_true(same_pixels(&a, &b));
        int black = 0;
        for (int i = 0; i < 40 * 20; i++)
            black += rt_is_zero(b.pixels[i]);
        assert_in_range(black, 100, 700);
        free(a.pixels);
        free(b.pixels);
    }
}

static void test_a_coat_shines_over_a_black_pattern(void **state)
{
    (void)state;
    const rt_surface surface = {.pattern = checker, .shininess = 2000};
    const rt_light above = {{0.5f, 4, 0.5f}, {10, 10, 10}};
    rt_scene scene = of_box(&floor_box, &surface);
    scene.lights = &above;
    scene.light_count = 1;
    rt_rng rng = rt_rng_start(0, 0, 274);
    const rt_ray black = ray_of(rt_vec(1.5f, 2, 0.5f), rt_normalize(rt_vec(0, -1, 0)));
    const rt_ray gleam = ray_of(rt_vec(2.5f, 4, 0.5f), rt_normalize(rt_vec(-1, -4, 0)));
    const float dark = rt_radiance_mis(&scene, &black, 0, &rng).x;
    const float bright = rt_radiance_mis(&scene, &gleam, 0, &rng).x;
    assert_true(dark < 0.01f && bright > 0.1f);
}

static void test_the_guides_show_the_pattern(void **state)
{
    (void)state;
    rt_image image = picture_of(true, rt_vec(0.8f, 0.5f, 0.3f));
    int balls = 0, floors = 0;
    for (int i = 0; i < 40 * 20; i++) {
        const rt_vec3 a = image.guides[i].albedo;
        balls += fabsf(a.x - 0.8f) < 1e-3f && fabsf(a.z - 0.3f) < 1e-3f;
        floors += fabsf(a.x - 0.9f) < 1e-3f && fabsf(a.z - 0.7f) < 1e-3f;
    }
    assert_true(balls > 40 && floors > 100);
    free_all(&image);
}

/* The demo's tiles are those of patterns.h; with negative numbers, too, none is twice as wide. */
static void test_demo_tile_is_that_of_patterns_h(void **state)
{
    (void)state;
    const rt_vec3 up = {0, 1, 0};
    rt_rng rng = rt_rng_start(0, 0, 15);
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 P = random_point(&rng, 60.0f);
        const rt_vec3 theirs = tile(&room_tiles, P, up);
        const rt_vec3 ours = checker_pattern(&room_tiles, P, up);
        const rt_vec3 next =
            tile(&room_tiles, rt_add(P, rt_vec(room_tiles.size, 0, 0)), up);
        assert_memory_equal(&theirs, &ours, sizeof ours);
        assert_true(next.x != ours.x);
    }
}

static void test_marble_and_picture_are_albedos(void **state)
{
    (void)state;
    const rt_vec3 up = {0, 1, 0};
    rt_rng rng = rt_rng_start(0, 0, 16);
    const rt_vec3 pixels[2] = {{0.25f, 0.5f, 0.75f}, {1, 0, 0}};
    pattern_picture two = {.ball = &room_spheres[0], .pixels = pixels, .width = 2};
    two.height = 1;
    float least = 1, most = 0;
    for (int i = 0; i < 100000; i++) {
        const rt_vec3 P = random_point(&rng, 50.0f), v = marble_pattern(NULL, P, up);
        const rt_vec3 at =
            rt_add(room_spheres[0].center,
                   rt_scale(random_direction(&rng), room_spheres[0].radius));
        const rt_vec3 seen = picture_pattern(&two, at, up);
        const bool right = at.x > room_spheres[0].center.x;
        assert_true(v.x >= 0.2f && v.x <= 0.86f && v.z >= 0.3f && v.z <= 0.8f);
        least = v.x < least ? v.x : least;
        most = v.x > most ? v.x : most;
        if (fabsf(at.x - room_spheres[0].center.x) > 1e-3f)
            assert_true(seen.x == pixels[right].x);
    }
    assert_true(least < 0.25f && most > 0.85f); /* there are veins, and there is stone */
}

static void test_demo_picture(void **state)
{
    (void)state;
    check_golden();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_what_a_pattern_returns_is_an_albedo),
        cmocka_unit_test(test_a_pattern_gets_the_point_and_the_normal),
        cmocka_unit_test(test_a_checker_on_the_floor),
        cmocka_unit_test(test_light_goes_on_with_the_pattern),
        cmocka_unit_test(test_a_pattern_of_one_colour_is_an_albedo),
        cmocka_unit_test(test_black_of_a_pattern_is_black_on_a_mirror),
        cmocka_unit_test(test_a_black_pattern_with_any_number_of_lanes),
        cmocka_unit_test(test_a_coat_shines_over_a_black_pattern),
        cmocka_unit_test(test_the_guides_show_the_pattern),
        cmocka_unit_test(test_demo_tile_is_that_of_patterns_h),
        cmocka_unit_test(test_marble_and_picture_are_albedos),
        cmocka_unit_test(test_demo_picture),
    };
    return cmocka_run_group_tests_name("15 patterns", tests, NULL, NULL);
}

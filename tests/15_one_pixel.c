/* rt_trace_pixel: what it writes down is what rt_render does. */
#include "../demos/scene.h"
#include "test.h"

enum { W = 12, H = 9, MOST = 64 };

static rt_vertex vertices[MOST];
static rt_shadow shadows[MOST];

static rt_path empty_path(void)
{
    rt_path path;
    memset(&path, 0, sizeof path);
    path.vertices = vertices;
    path.max_vertices = MOST;
    path.shadows = shadows;
    path.max_shadows = MOST;
    return path;
}

/* Two lamps, a background that some rays reach, a mirror that takes light, nothing behind. */
static const rt_sphere spheres[] = {
    {{-1, 0, -6}, 1, {{0.7f, 0.5f, 0.3f}, false}},
    {{1.5f, 0, -7}, 1.2f, {{0.9f, 0.8f, 0.7f}, true}},
    {{0, -101, -6}, 100, {{0.8f, 0.8f, 0.8f}, false}},
};
static const rt_box box = {
    {-0.5f, -1, -5}, {0.2f, -0.5f, -4}, {{0.2f, 0.3f, 0.9f}, false}};
static const rt_light lamps[] = {{{2, 3, -3}, {60, 50, 40}}, {{-4, 5, -8}, {20, 40, 60}}};
static const rt_scene open_air = {.spheres = spheres,
                                  .sphere_count = 3,
                                  .boxes = &box,
                                  .box_count = 1,
                                  .lights = lamps,
                                  .light_count = 2,
                                  .background = {0.2f, 0.3f, 0.5f}};
static const rt_camera camera; /* all defaults */

static const struct view {
    const rt_scene *scene;
    const rt_camera *camera;
    rt_options options;
    bool half;
} views[] = {
    {&scene_indirect, &room_camera, {.samples = 4, .bounces = 5}, false},
    {&scene_indirect, &room_camera, {.samples = 5, .bounces = 2, .seed = 7}, true},
    {&scene_mirror, &room_camera, {.samples = 1, .bounces = 0}, false},
    {&open_air, &camera, {.samples = 3, .bounces = 8, .sampler = RT_RANDOM}, false},
    {&open_air, &camera, {.samples = 6, .bounces = 3, .sampler = RT_RANDOM}, true},
};

static bool same_bits(rt_vec3 a, rt_vec3 b)
{
    return memcmp(&a, &b, sizeof a) == 0;
}

static rt_image rendered(const struct view *v)
{
    rt_image image = new_image(W, H);
    if (v->half)
        image.half = new_image(W, H).pixels;
    assert_int_equal(rt_render(v->scene, v->camera, &v->options, &image), RT_OK);
    return image;
}

static void free_image(rt_image *image)
{
    free(image->pixels);
    free(image->half);
}

static rt_path traced(const struct view *v, const rt_image *image, int x, int y,
                      int sample)
{
    rt_path path = empty_path();
    assert_int_equal(
        rt_trace_pixel(v->scene, v->camera, &v->options, image, x, y, sample, &path),
        RT_OK);
    assert_true(path.vertex_count <= MOST && path.shadow_count <= MOST);
    return path;
}

static void test_the_samples_are_those_of_the_picture(void **state)
{
    (void)state;
    for (size_t n = 0; n < COUNT(views); n++) {
        rt_image image = rendered(&views[n]);
        uint64_t rays = 0;
        for (int i = 0; i < W * H; i++) {
            rt_vec3 mean = {0, 0, 0};
            for (int k = 0; k < views[n].options.samples; k++) {
                const rt_path path = traced(&views[n], &image, i % W, i / W, k);
                rt__add_to_mean(&mean, NULL, k, path.value);
                rays += path.rays;
            }
            assert_true(same_bits(mean, image.pixels[i]));
        }
        assert_int_equal(rays, image.rays);
        free_image(&image);
    }
}

static void test_what_the_points_add_is_the_sample(void **state)
{
    (void)state;
    int mirrors = 0, missed = 0;
    for (size_t n = 0; n < COUNT(views); n++) {
        rt_image image = rendered(&views[n]);
        for (int i = 0; i < W * H; i++) {
            const rt_path path = traced(&views[n], &image, i % W, i / W, 0);
            rt_vec3 sum = {0, 0, 0};
            assert_in_range(path.vertex_count, 1, views[n].options.bounces + 1);
            assert_int_equal(path.rays, path.vertex_count + path.shadow_count);
            for (int k = 0; k < path.vertex_count; k++) {
                const rt_vertex *v = &vertices[k];
                sum = rt_add(sum, rt_mul(v->throughput, v->light));
                mirrors += v->shape >= 0 && v->hit.material->mirror;
                missed += v->shape < 0;
            }
            assert_true(same_bits(sum, path.value));
        }
        free_image(&image);
    }
    assert_true(mirrors > 50 && missed > 50);
}

/* Each point is where its ray says, and the next ray starts there. */
static void test_the_path_hangs_together(void **state)
{
    (void)state;
    for (size_t n = 0; n < COUNT(views); n++) {
        rt_image image = rendered(&views[n]);
        for (int i = 0; i < W * H; i++) {
            const rt_path path = traced(&views[n], &image, i % W, i / W, 0);
            const rt_scene *scene = views[n].scene;
            for (int k = 0; k < path.vertex_count; k++) {
                const rt_vertex *v = &vertices[k];
                rt_hit hit;
                assert_int_equal(rt_intersect(scene, &v->ray, &hit), v->shape >= 0);
                if (v->shape < 0) {
                    assert_int_equal(k, path.vertex_count - 1);
                    assert_true(same_bits(v->light, scene->background));
                    continue;
                }
                assert_true(hit.t == v->hit.t && same_bits(hit.point, v->hit.point) &&
                            same_bits(hit.normal, v->hit.normal));
                assert_ptr_equal(
                    hit.material,
                    v->shape < scene->sphere_count
                        ? &scene->spheres[v->shape].material
                        : &scene->boxes[v->shape - scene->sphere_count].material);
                if (k + 1 < path.vertex_count)
                    assert_true(same_bits(
                        vertices[k + 1].ray.origin,
                        rt_leave(hit.point, hit.normal, vertices[k + 1].ray.direction)));
            }
        }
        free_image(&image);
    }
}

static void test_the_lights_were_asked_for(void **state)
{
    (void)state;
    int seen = 0, hidden[5] = {0}, of[2] = {0};
    const struct view *view = &views[3];
    rt_image image = rendered(view);
    for (int i = 0; i < W * H; i++) {
        const rt_path path = traced(view, &image, i % W, i / W, 1);
        for (int k = 0; k < path.shadow_count; k++) {
            const rt_shadow *s = &shadows[k];
            const rt_vertex *v = &vertices[s->vertex];
            const rt_light *light = &open_air.lights[s->light];
            const rt_vec3 to_light = rt_sub(light->position, v->hit.point);
            of[s->light]++;
            assert_true(k == 0 || s->vertex >= s[-1].vertex);
            assert_close(s->dd, rt_dot(to_light, to_light), 0);
            assert_close(s->cosine, rt_dot(v->hit.normal, to_light) / sqrtf(s->dd), 0);
            assert_true(s->cosine > 0);
            const bool sees =
                rt_visible(&open_air, v->hit.point, v->hit.normal, light->position);
            assert_int_equal(s->blocker < 0, sees);
            if (sees) {
                seen++;
                assert_true(same_bits(s->light_sent,
                                      rt_lambert(v->hit.material->albedo, v->hit.normal,
                                                 to_light, light->intensity)));
                continue;
            }
            hidden[s->blocker]++;
            rt_hit between = {0};
            assert_true(rt_intersect(&open_air, &s->ray, &between));
            assert_true(between.t == s->t && s->t > 0 && s->t < 1);
            assert_true(rt_is_zero(s->light_sent));
        }
    }
    free_image(&image);
    assert_true(seen > 20 && of[0] > 20 && of[1] > 20);
    assert_true(hidden[0] > 0 && hidden[1] > 0 && hidden[3] > 0); /* spheres and box */
}

static void test_what_has_no_place_is_counted(void **state)
{
    (void)state;
    const struct view *view = &views[0];
    rt_image image = rendered(view);
    const rt_path whole = traced(view, &image, 6, 6, 0);
    assert_true(whole.vertex_count > 3 && whole.shadow_count > 2);
    for (int room = 0; room < 3; room++) {
        rt_path path = empty_path();
        memset(vertices, 0x55, sizeof vertices);
        memset(shadows, 0x55, sizeof shadows);
        path.max_vertices = room;
        path.max_shadows = room;
        if (room == 0) {
            path.vertices = NULL;
            path.shadows = NULL;
        }
        assert_int_equal(rt_trace_pixel(view->scene, view->camera, &view->options, &image,
                                        6, 6, 0, &path),
                         RT_OK);
        assert_int_equal(path.vertex_count, whole.vertex_count);
        assert_int_equal(path.shadow_count, whole.shadow_count);
        assert_true(same_bits(path.value, whole.value));
        const unsigned char *after = (const unsigned char *)&vertices[room],
                            *behind = (const unsigned char *)&shadows[room];
        for (size_t i = 0; i < sizeof vertices[0]; i++)
            assert_int_equal(after[i], 0x55);
        for (size_t i = 0; i < sizeof shadows[0]; i++)
            assert_int_equal(behind[i], 0x55);
    }
    free_image(&image);
}

static void test_shadows_without_a_place_still_bring_light(void **state)
{
    (void)state;
    rt_image image = rendered(&views[0]);
    rt_path path = empty_path();
    path.max_shadows = 0;
    assert_int_equal(rt_trace_pixel(views[0].scene, views[0].camera, &views[0].options,
                                    &image, 6, 6, 0, &path),
                     RT_OK);
    rt_vec3 sum = {0, 0, 0};
    for (int k = 0; k < path.vertex_count; k++)
        sum = rt_add(sum, rt_mul(vertices[k].throughput, vertices[k].light));
    assert_true(path.value.x > 0);
    assert_true(same_bits(sum, path.value));
    free_image(&image);
}

static void test_with_a_tree_the_same(void **state)
{
    (void)state;
    rt_image image = rendered(&views[0]);
    rt_scene scene = scene_indirect;
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    const rt_bvh before = bvh;
    scene.bvh = &bvh;
    for (int i = 0; i < W * H; i++) {
        rt_path with = empty_path();
        assert_int_equal(rt_trace_pixel(&scene, &room_camera, &views[0].options, &image,
                                        i % W, i / W, 3, &with),
                         RT_OK);
        const rt_path without = traced(&views[0], &image, i % W, i / W, 3);
        assert_true(same_bits(with.value, without.value));
        assert_int_equal(with.vertex_count, without.vertex_count);
    }
    assert_memory_equal(&before, &bvh, sizeof bvh);
    rt_free_bvh(&bvh);
    free_image(&image);
}

static void test_bad_arguments(void **state)
{
    (void)state;
    rt_image image = new_image(W, H);
    const rt_options none = {0};
    rt_options negative = none;
    rt_path path = empty_path();
    negative.bounces = -1;
    const rt_scene *s = &scene_indirect;
    const rt_camera *c = &room_camera;
    assert_int_equal(rt_trace_pixel(NULL, c, &none, &image, 0, 0, 0, &path),
                     RT_BAD_POINTER);
    assert_int_equal(rt_trace_pixel(s, NULL, &none, &image, 0, 0, 0, &path),
                     RT_BAD_POINTER);
    assert_int_equal(rt_trace_pixel(s, c, &none, NULL, 0, 0, 0, &path), RT_BAD_POINTER);
    assert_int_equal(rt_trace_pixel(s, c, &none, &image, 0, 0, 0, NULL), RT_BAD_POINTER);
    assert_int_equal(rt_trace_pixel(s, c, &negative, &image, 0, 0, 0, &path),
                     RT_BAD_BOUNCES);
    const int wrong[][3] = {{-1, 0, 0}, {W, 0, 0}, {0, -1, 0}, {0, H, 0}, {0, 0, -1}};
    for (size_t i = 0; i < COUNT(wrong); i++)
        assert_int_equal(rt_trace_pixel(s, c, &none, &image, wrong[i][0], wrong[i][1],
                                        wrong[i][2], &path),
                         RT_BAD_PIXEL);
    assert_int_equal(path.vertex_count, 0); /* untouched */
    path.vertices = NULL;
    assert_int_equal(rt_trace_pixel(s, c, &none, &image, 0, 0, 0, &path), RT_BAD_POINTER);
    path = empty_path();
    path.shadows = NULL;
    assert_int_equal(rt_trace_pixel(s, c, &none, &image, 0, 0, 0, &path), RT_BAD_POINTER);
    path = empty_path();
    assert_int_equal(rt_trace_pixel(s, c, NULL, &image, W - 1, H - 1, 0, &path), RT_OK);
    free(image.pixels);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_samples_are_those_of_the_picture),
        cmocka_unit_test(test_what_the_points_add_is_the_sample),
        cmocka_unit_test(test_the_path_hangs_together),
        cmocka_unit_test(test_the_lights_were_asked_for),
        cmocka_unit_test(test_what_has_no_place_is_counted),
        cmocka_unit_test(test_shadows_without_a_place_still_bring_light),
        cmocka_unit_test(test_with_a_tree_the_same),
        cmocka_unit_test(test_bad_arguments),
    };
    return cmocka_run_group_tests_name("one pixel", tests, NULL, NULL);
}

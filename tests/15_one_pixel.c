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

/* The samples of each view have the mean and the rays of the picture, to the bit. */
static void check_samples(const struct view *list, size_t count)
{
    for (size_t n = 0; n < count; n++) {
        rt_image image = rendered(&list[n]);
        uint64_t rays = 0;
        for (int i = 0; i < W * H; i++) {
            rt_vec3 mean = {0, 0, 0};
            for (int k = 0; k < list[n].options.samples; k++) {
                const rt_path path = traced(&list[n], &image, i % W, i / W, k);
                rt__add_to_mean(&mean, NULL, k, path.value);
                rays += path.rays;
            }
            assert_true(same_bits(mean, image.pixels[i]));
        }
        assert_int_equal(rays, image.rays);
        free_image(&image);
    }
}

static void test_the_samples_are_those_of_the_picture(void **state)
{
    (void)state;
    check_samples(views, COUNT(views));
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

/* ---- part two ----------------------------------------------------------------------- */

static rt_vec3 squares(const void *data, rt_vec3 point, rt_vec3 normal)
{
    (void)data;
    (void)normal;
    return ((int)floorf(point.x) + (int)floorf(point.z)) % 2 == 0
               ? rt_vec(0.8f, 0.7f, 0.6f)
               : rt_vec(0.2f, 0.3f, 0.4f);
}

static rt_vec3 evening(const void *data, rt_vec3 d)
{
    (void)data;
    return rt_vec(0.3f + 0.1f * d.y, 0.3f, 0.3f - 0.1f * d.y);
}

enum { GLASS, MIRROR, METAL, PLASTIC, MATT, FLOOR, GLOW, SHAPES };

static const rt_sphere balls[5] = {{{-1, 0, -5}, 1, {{0, 0, 0}, false}},
                                   {{1.2f, 0, -6.5f}, 1, {{0.9f, 0.8f, 0.9f}, true}},
                                   {{3, 0, -6}, 0.9f, {{0.9f, 0.7f, 0.4f}, true}},
                                   {{0.3f, -0.4f, -4}, 0.6f, {{0.2f, 0.5f, 0.8f}, false}},
                                   {{-3, 0, -6}, 1, {{0.7f, 0.3f, 0.2f}, false}}};
static const rt_box floor_and_glow[2] = {
    {{-9, -2, -12}, {9, -1, 0}, {{1, 1, 1}, false}},
    {{-9, 6, -12}, {9, 7, -3}, {{0.5f, 0.5f, 0.5f}, false}}}; /* behind the lamps */
static const rt_surface finishes[SHAPES] = {
    [GLASS] = {.eta = 1.5f, .absorption = {0.1f, 0.3f, 0.2f}},
    [METAL] = {.shininess = 40},
    [PLASTIC] = {.shininess = 300},
    [FLOOR] = {.pattern = squares},
    [GLOW] = {.emission = {0.3f, 0.2f, 0.1f}}};
/* the second may stand before the first */
static const rt_lamp two_lamps[2] = {
    {.center = {1, 4, -5}, .radius = 1.2f, .intensity = {15, 14, 13}},
    {.center = {-2, 3, -6},
     .u = {0.6f, 0.2f, 0},
     .v = {0, 0, 0.7f},
     .intensity = {9, 8, 7}}};
static const rt_scene part_two = {.spheres = balls,
                                  .sphere_count = 5,
                                  .boxes = floor_and_glow,
                                  .box_count = 2,
                                  .lights = lamps,
                                  .light_count = 1,
                                  .surfaces = finishes,
                                  .lamps = two_lamps,
                                  .lamp_count = 2,
                                  .sky = evening};

#define LENS                                                                             \
    {                                                                                    \
        0.1f, 6                                                                          \
    }
static const struct view views_two[] = {
    {&part_two, &camera, {.samples = 4, .bounces = 5, .lens = LENS}, false},
    {&part_two, &camera, {.samples = 5, .bounces = 2, .seed = 7}, true},
    {&part_two, &camera, {.samples = 2, .bounces = 0, .lens = LENS}, false},
    {&part_two, &camera, {.samples = 3, .bounces = 12, .sampler = RT_RANDOM}, false},
    {&part_two, &camera, {.samples = 3, .bounces = RT_ALL_BOUNCES, .lens = LENS}, false},
};

static void test_two_the_samples_are_those_of_the_picture(void **state)
{
    (void)state;
    check_samples(views_two, COUNT(views_two));
}

static void assert_near(rt_vec3 a, rt_vec3 b)
{
    assert_vec(a, b.x, b.y, b.z, 1e-5 * (0.1 + (double)b.x + (double)b.y + (double)b.z));
}

static void test_two_what_the_points_add_is_the_sample(void **state)
{
    /* Up to rounding. For each point it is what shines by itself, or the sky, or the lamp
     * that was met by chance, and what the shadow rays brought. */
    (void)state;
    for (size_t n = 0; n < COUNT(views_two); n++) {
        rt_image image = rendered(&views_two[n]);
        for (int i = 0; i < W * H; i++) {
            const rt_path path = traced(&views_two[n], &image, i % W, i / W, 1);
            const int bounces = views_two[n].options.bounces;
            rt_vec3 sum = {0, 0, 0}, lights[MOST];
            assert_true(path.vertex_count >= 1 && path.vertex_count - 2 <= bounces);
            assert_int_equal(path.rays, path.vertex_count + path.shadow_count);
            for (int k = 0; k < path.vertex_count; k++) {
                const rt_vertex *v = &vertices[k];
                sum = rt_add(sum, rt_mul(v->throughput, v->light));
                lights[k] = rt_vec(0, 0, 0);
                if (v->lamp >= 0)
                    lights[k] =
                        rt_scale(rt_lamp_radiance(&two_lamps[v->lamp]), v->weight);
                else if (v->shape >= 0)
                    lights[k] = finishes[v->shape].emission;
                else if (k - 1 < bounces)
                    lights[k] = evening(NULL, rt_normalize(v->ray.direction));
            }
            for (int k = 0; k < path.shadow_count; k++)
                lights[shadows[k].vertex] =
                    rt_add(lights[shadows[k].vertex], shadows[k].light_sent);
            for (int k = 0; k < path.vertex_count; k++)
                assert_near(vertices[k].light, lights[k]);
            assert_near(path.value, sum);
        }
        free_image(&image);
    }
}

/* The path went on from v as its event says, and the next throughput is what that
 * leaves. */
static void check_event(const rt_vertex *v, const rt_vertex *next, bool roulette)
{
    const rt_surface *surface = &finishes[v->shape];
    const rt_vec3 u = v->ray.direction, n = v->hit.normal, w = next->ray.direction;
    const bool inside = rt_is_inside(&part_two, &v->hit);
    const rt_brdf finish = rt__brdf_of(surface, &v->hit);
    rt_vec3 part = {1, 1, 1}, expected = {0, 0, 0};
    float density = 0;
    switch (v->event) {
    case RT_EVENT_REFLECTED:
    case RT_EVENT_REFRACTED:
        assert_int_equal(v->shape, GLASS);
        assert_int_equal(v->inside, inside);
        if (v->event == RT_EVENT_REFLECTED)
            expected = rt_reflect(u, n);
        else
            assert_true(rt_refract(u, n, inside ? 1 / 1.5f : 1.5f, &expected));
        if (inside)
            part = rt_transmittance(surface->absorption, v->hit.t);
        break;
    case RT_EVENT_MIRROR:
        assert_int_equal(v->shape, MIRROR);
        expected = rt_reflect(u, n);
        part = finish.albedo;
        break;
    default:
        assert_true(v->event == RT_EVENT_GLOSS || v->event == RT_EVENT_MATT);
        assert_true(v->shape >= METAL);
        assert_true(v->event == RT_EVENT_MATT || v->shape <= PLASTIC);
        assert_true(v->event == RT_EVENT_GLOSS || v->shape != METAL);
        assert_false(v->inside);
        part = rt_scatter(&finish, n, rt_scale(u, -1), w, &density);
        part = rt_scale(part, 1 / density);
        expected = w;
    }
    assert_true(same_bits(expected, w));
    assert_true(same_bits(next->ray.origin, rt_leave(v->hit.point, n, w)));
    assert_close(v->density, density, 1e-6 * (double)density);
    if (!roulette)
        assert_near(next->throughput, rt_mul(v->throughput, part));
}

static void test_two_events_are_what_happened(void **state)
{
    (void)state;
    int seen[RT_EVENT_LAMP + 1] = {0}, by_chance = 0, inside = 0;
    for (size_t n = 0; n < COUNT(views_two); n++) {
        rt_image image = rendered(&views_two[n]);
        for (int i = 0; i < W * H; i++) {
            const rt_path path = traced(&views_two[n], &image, i % W, i / W, 1);
            for (int k = 0; k < path.vertex_count; k++) {
                const rt_vertex *v = &vertices[k], *before = k > 0 ? v - 1 : NULL;
                seen[v->event]++;
                inside += v->inside;
                if (v->lamp >= 0 || v->shape < 0) {
                    assert_int_equal(v->event,
                                     v->lamp >= 0 ? RT_EVENT_LAMP : RT_EVENT_GONE);
                    assert_int_equal(k, path.vertex_count - 1);
                    assert_int_equal(v->shape, -1);
                    assert_null(v->hit.material);
                }
                if (v->lamp >= 0) {
                    const rt_lamp *lamp = &two_lamps[v->lamp];
                    assert_true(rt_meet_lamp(lamp, &v->ray, FLT_MAX) > 0);
                    const bool aimed = before && before->density > 0;
                    const float weight =
                        aimed ? rt_mis(before->density,
                                       rt_lamp_density(lamp, before->hit.point,
                                                       v->ray.direction))
                              : 1;
                    assert_close(v->weight, weight, 1e-6);
                    by_chance += aimed;
                } else {
                    assert_close(v->weight, 1, 0);
                }
                if (k + 1 < path.vertex_count)
                    check_event(v, v + 1,
                                views_two[n].options.bounces == RT_ALL_BOUNCES &&
                                    k >= RT__ROULETTE);
                else if (v->shape >= 0) /* the end: what the surface is */
                    assert_true(v->shape == GLASS ? v->event == RT_EVENT_REFLECTED ||
                                                        v->event == RT_EVENT_REFRACTED
                                : v->shape == MIRROR ? v->event == RT_EVENT_MIRROR
                                : v->shape == METAL
                                    ? v->event == RT_EVENT_GLOSS
                                    : v->event == RT_EVENT_MATT || v->shape == PLASTIC);
            }
        }
        free_image(&image);
    }
    for (int k = 0; k <= RT_EVENT_LAMP; k++)
        assert_true(seen[k] > 3);
    assert_true(by_chance > 3 && inside > 20);
}

static void test_two_each_lamp_was_aimed_at(void **state)
{
    (void)state;
    int of[3] = {0}, hidden = 0;
    const struct view *view = &views_two[3];
    rt_image image = rendered(view);
    for (int i = 0; i < W * H; i++) {
        const rt_path path = traced(view, &image, i % W, i / W, 1);
        for (int k = 0; k < path.shadow_count; k++) {
            const rt_shadow *s = &shadows[k];
            const rt_vertex *v = &vertices[s->vertex];
            const rt_vec3 n = v->hit.normal, to_eye = rt_scale(v->ray.direction, -1);
            const rt_vec3 end = rt_at(&s->ray, 1), way = rt_sub(end, v->hit.point);
            const rt_brdf finish = rt__brdf_of(&finishes[v->shape], &v->hit);
            assert_true(v->shape >= METAL);
            assert_true((s->light < 0) != (s->lamp < 0));
            assert_close(s->dd, rt_dot(way, way), 1e-4 * (double)s->dd);
            assert_close(s->cosine, rt_dot(n, way) / rt_length(way), 1e-4);
            of[s->lamp + 1]++;
            float density;
            const rt_vec3 u = rt_normalize(way);
            const rt_vec3 f = rt_scatter(&finish, n, to_eye, u, &density);
            rt_vec3 sent;
            if (s->lamp < 0) {
                assert_int_equal(s->light, 0);
                assert_close(s->weight, 1, 0);
                sent = rt_scale(rt_mul(f, lamps[0].intensity), 1 / s->dd);
            } else {
                const rt_lamp *lamp = &two_lamps[s->lamp];
                const float aimed = rt_lamp_density(lamp, v->hit.point, u);
                const float weight = rt_mis(aimed, density);
                assert_close(s->weight, weight, 1e-3);
                sent = rt_scale(rt_mul(f, rt_lamp_radiance(lamp)), weight / aimed);
            }
            const bool sees = rt_visible(&part_two, v->hit.point, n, end);
            assert_int_equal(s->blocker < 0, sees);
            const rt_ray ray = ray_of(v->hit.point, rt_scale(way, 0.99f));
            if (!sees || rt__nearest_lamp(&part_two, &ray, 1, s->lamp) >= 0) {
                hidden++;
                assert_true(rt_is_zero(s->light_sent));
            } else {
                assert_vec(s->light_sent, sent.x, sent.y, sent.z,
                           2e-3 * (double)sent.x + 1e-5);
            }
        }
    }
    free_image(&image);
    assert_true(of[0] > 60 && of[1] > 60 && of[2] > 60 && hidden > 40);
}

static void test_two_what_has_no_place_is_counted(void **state)
{
    (void)state;
    const struct view *view = &views_two[0];
    rt_image image = rendered(view);
    for (int i = 0; i < W * H; i++) {
        const int x = i % W, y = i / W;
        const rt_path whole = traced(view, &image, x, y, 0);
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
            assert_int_equal(rt_trace_pixel(view->scene, view->camera, &view->options,
                                            &image, x, y, 0, &path),
                             RT_OK);
            assert_int_equal(path.vertex_count, whole.vertex_count);
            assert_int_equal(path.shadow_count, whole.shadow_count);
            assert_true(same_bits(path.value, whole.value));
            const unsigned char *after = (const unsigned char *)&vertices[room],
                                *behind = (const unsigned char *)&shadows[room];
            for (size_t k = 0; k < sizeof vertices[0]; k++)
                assert_int_equal(after[k], 0x55);
            for (size_t k = 0; k < sizeof shadows[0]; k++)
                assert_int_equal(behind[k], 0x55);
        }
        /* shadows without a place still bring light */
        rt_path path = empty_path();
        path.max_shadows = 0;
        assert_int_equal(rt_trace_pixel(view->scene, view->camera, &view->options, &image,
                                        x, y, 0, &path),
                         RT_OK);
        rt_vec3 sum = {0, 0, 0};
        for (int k = 0; k < path.vertex_count; k++)
            sum = rt_add(sum, rt_mul(vertices[k].throughput, vertices[k].light));
        assert_near(path.value, sum);
    }
    free_image(&image);
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
        cmocka_unit_test(test_two_the_samples_are_those_of_the_picture),
        cmocka_unit_test(test_two_what_the_points_add_is_the_sample),
        cmocka_unit_test(test_two_events_are_what_happened),
        cmocka_unit_test(test_two_each_lamp_was_aimed_at),
        cmocka_unit_test(test_two_what_has_no_place_is_counted),
    };
    return cmocka_run_group_tests_name("one pixel", tests, NULL, NULL);
}

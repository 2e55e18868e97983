/* The last section of rt.h: packets of rays make the picture that the chapters make, to
 * the bit. Compiled with RT_NO_PACKETS, this is a program that prints what rt.h makes
 * without them. */
#define _XOPEN_SOURCE 700 /* scandir, mkstemp, popen */
#ifdef RT_NO_PACKETS
#define RT_IMPLEMENTATION
#include "../demos/scene.h"
#include <stdio.h>
#include <string.h>
#else
#include <dirent.h>
#include <unistd.h>

#include "../demos/scene.h"
#include "meshes.h"
#include "scene_file.h"
#include "test.h"
#endif

/* A number for all bits of a picture of the room: FNV-1a. */
static uint64_t hash_of_the_room(int lanes)
{
    enum { W = 37, H = 21 };
    static rt_vec3 pixels[W * H];
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 3, .bounces = 5, .lanes = lanes};
    if (rt_render(&scene_indirect, &room_camera, &options, &image) != RT_OK)
        return 0;
    uint64_t hash = 14695981039346656037u ^ image.rays;
    for (int i = 0; i < W * H; i++) {
        uint32_t bits[3];
        memcpy(bits, &pixels[i], sizeof bits);
        for (int k = 0; k < 3; k++)
            hash = (hash ^ bits[k]) * 1099511628211u;
    }
    return hash;
}

#ifdef RT_NO_PACKETS

int main(void)
{
    rt_vec3 pixel;
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    const rt_options four = {.lanes = 4};
    if (rt_lane_count(0) != 1 || rt_lane_count(8) != 1 ||
        rt_render(&scene_indirect, &room_camera, &four, &image) != RT_BAD_LANES)
        return 1;
    printf("%016llx\n", (unsigned long long)hash_of_the_room(0));
    return 0;
}

#else

/* ---- the same picture with every number of lanes ------------------------------------ */

typedef struct picture {
    rt_scene scene;
    rt_camera camera;
    rt_options options;
    int width, height, first; /* first: number of the first sample */
    bool guides;
    int first_pixel, pixel_count; /* of a part; 0, 0: all */
} picture;

static rt_image draw(const picture *p, int lanes)
{
    rt_image image = new_image(p->width, p->height);
    rt_options options = p->options;
    image.samples = p->first;
    image.first = p->first_pixel;
    image.count = p->pixel_count;
    if (p->guides) {
        image.guides = calloc((size_t)(p->width * p->height), sizeof *image.guides);
        assert_non_null(image.guides);
    }
    options.lanes = lanes;
    const rt_status status = rt_render(&p->scene, &p->camera, &options, &image);
    if (status != RT_OK)
        fail_msg("%d lanes: %s", lanes, rt_status_text(status));
    return image;
}

/* After 1 all lanes that there are; 0: no more. */
static int more_lanes(int lanes)
{
    return lanes < rt_lane_count(0) ? rt_lane_count(0) : 0;
}

static int bright; /* how many pictures of compare were not black */

static void compare(const picture *p, const char *name, int number)
{
    rt_image expected = draw(p, 1);
    const int count = p->width * p->height;
    for (int lanes = more_lanes(1); lanes != 0; lanes = more_lanes(lanes)) {
        rt_image image = draw(p, lanes);
        for (int i = 0; i < count; i++) {
            const rt_vec3 a = expected.pixels[i], b = image.pixels[i];
            if (memcmp(&a, &b, sizeof a) != 0)
                fail_msg(
                    "%s %d: pixel (%d, %d) is (%.9g, %.9g, %.9g), with %d lanes (%.9g, "
                    "%.9g, %.9g)",
                    name, number, i % p->width, i / p->width, (double)a.x, (double)a.y,
                    (double)a.z, lanes, (double)b.x, (double)b.y, (double)b.z);
        }
        if (image.rays != expected.rays)
            fail_msg("%s %d: %llu rays, with %d lanes %llu", name, number,
                     (unsigned long long)expected.rays, lanes,
                     (unsigned long long)image.rays);
        for (int i = 0; p->guides && i < count; i++)
            if (memcmp(&expected.guides[i], &image.guides[i], sizeof *image.guides) != 0)
                fail_msg("%s %d: pixel (%d, %d), with %d lanes another guide", name,
                         number, i % p->width, i / p->width, lanes);
        free(image.pixels);
        free(image.guides);
    }
    for (int i = 0; i < count; i++)
        if (expected.pixels[i].x > 0) {
            bright++;
            break;
        }
    free(expected.pixels);
    free(expected.guides);
}

static picture picture_of(const rt_scene *scene, const rt_camera *camera)
{
    picture p;
    memset(&p, 0, sizeof p);
    p.scene = *scene;
    p.camera = *camera;
    p.width = 16;
    p.height = 12;
    p.options.samples = 2;
    p.options.bounces = 5;
    return p;
}

static void test_which_lanes_there_are(void **state)
{
    (void)state;
    const int most = rt_lane_count(0);
    assert_true(most == 1 || most == 4 || most == 8 || most == 16);
    if (most == 1)
        print_message("note: no packets here: not tested\n");
    for (int wanted = -3; wanted < 40; wanted++)
        assert_int_equal(rt_lane_count(wanted), wanted <= 0 || wanted >= most ? most : 1);
    assert_int_equal(rt_lane_count(INT_MAX), most);
}

static void test_other_numbers_of_lanes_are_refused(void **state)
{
    (void)state;
    const int bad[] = {-1, -4, 2, 3, 5, 6, 7, 9, 12, 15, 17, 32, 64, INT_MAX, INT_MIN};
    rt_vec3 pixel = {7, 7, 7};
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    rt_options options = {.samples = 1};
    for (size_t i = 0; i < COUNT(bad); i++) {
        options.lanes = bad[i];
        assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image),
                         RT_BAD_LANES);
    }
    for (int lanes = 4; lanes <= 16; lanes *= 2)
        if (lanes != rt_lane_count(0)) {
            options.lanes = lanes;
            assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image),
                             RT_BAD_LANES);
        }
    assert_vec(pixel, 7, 7, 7, 0);
    assert_int_equal(image.samples, 0);
}

static void test_the_room(void **state)
{
    (void)state;
    const int bounces[] = {0, 1, 5, 12};
    const int before = bright;
    for (size_t i = 0; i < COUNT(bounces); i++)
        for (uint32_t seed = 0; seed < 3; seed++)
            for (int kind = 0; kind < 2; kind++) {
                picture p = picture_of(&scene_indirect, &room_camera);
                p.width = 61;
                p.height = 37;
                p.options.bounces = bounces[i];
                p.options.seed = seed;
                p.options.sampler = kind == 0 ? RT_SOBOL : RT_RANDOM;
                p.first = 1000 * (int)seed;
                compare(&p, "scene_indirect, bounces", bounces[i]);
                p.scene = scene_mirror;
                compare(&p, "scene_mirror, bounces", bounces[i]);
            }
    assert_int_equal(bright - before, 48);
}

static int is_scene(const struct dirent *entry)
{
    const size_t length = strlen(entry->d_name);
    return length > 5 && strcmp(entry->d_name + length - 5, ".json") == 0;
}

static void test_the_scenes_of_the_references(void **state)
{
    (void)state;
    static scene_file file;
    struct dirent **entries;
    int compared = 0;
    const int count = scandir("tests/references/scenes", &entries, is_scene, alphasort);
    assert_true(count > 0);
    for (int i = 0; i < count; i++) {
        char path[300];
        snprintf(path, sizeof path, "tests/references/scenes/%s", entries[i]->d_name);
        if (!read_scene(path, &file))
            fail_msg("%s: %s", path, file.error);
        if (!file.mirror_direct) { /* that scene uses a function of its own: no packets */
            picture p = picture_of(&file.scene, &file.camera);
            p.width = file.width;
            p.height = file.height;
            p.options.bounces = file.bounces;
            compare(&p, entries[i]->d_name, 0);
            compared++;
        }
        free_scene(&file);
        free(entries[i]);
    }
    free(entries);
    assert_true(compared >= 6);
}

static void test_samples_and_threads_and_lanes_in_any_order(void **state)
{
    /* Some samples with these lanes, some with those, with and without half. */
    (void)state;
    for (int half = 0; half < 2; half++) {
        rt_image whole = new_image(50, 41), pieces = new_image(50, 41);
        if (half == 1) {
            whole.half = new_image(50, 41).pixels;
            pieces.half = new_image(50, 41).pixels;
        }
        rt_options options = {.samples = 10, .bounces = 4, .threads = 1, .lanes = 1};
        assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &whole),
                         RT_OK);
        const int threads[] = {1, 2, 5};
        for (int i = 0, lanes = 1; i < 10; i++) {
            options.samples = 1;
            options.threads = threads[i % 3];
            options.lanes = lanes;
            assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &pieces),
                             RT_OK);
            lanes = more_lanes(lanes) != 0 ? more_lanes(lanes) : 1;
        }
        assert_true(same_pixels(&whole, &pieces));
        assert_int_equal(whole.rays, pieces.rays);
        if (half == 1)
            assert_memory_equal(whole.half, pieces.half, 50 * 41 * sizeof *whole.half);
        free(whole.pixels);
        free(whole.half);
        free(pieces.pixels);
        free(pieces.half);
    }
}

static bool stop_at_call(void *user, float part)
{
    (void)part;
    return --*(int *)user != 0;
}

static void test_cancelled_packets_go_on_to_the_same_bits(void **state)
{
    (void)state;
    enum { W = 157, H = 111, N = 3 };
    rt_image whole = new_image(W, H);
    rt_options options = {.samples = N, .bounces = 3, .lanes = 1};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &whole), RT_OK);
    for (int lanes = more_lanes(1); lanes != 0; lanes = more_lanes(lanes)) {
        rt_image image = new_image(W, H);
        int within = 0;
        for (int calls = 1; image.samples < N; calls++) {
            int left = calls;
            options.samples = N - image.samples;
            options.threads = 1 + calls % 2;
            options.lanes = lanes;
            options.progress = stop_at_call;
            options.user = &left;
            const rt_status status =
                rt_render(&scene_indirect, &room_camera, &options, &image);
            assert_int_equal(status, image.samples < N ? RT_CANCELLED : RT_OK);
            within += image.done > 0;
        }
        assert_true(within >= 1);
        assert_true(same_pixels(&whole, &image));
        assert_int_equal(whole.rays, image.rays);
        free(image.pixels);
    }
    free(whole.pixels);
}

static void test_without_packets(void **state)
{
    /* This file, compiled with RT_NO_PACKETS by the compiler that CC names. */
    (void)state;
    char program[] = "/tmp/rt-no-packets-XXXXXX", command[500], said[100] = "", ours[100];
    const char *cc = getenv("CC");
    if (system("command -v ${CC:-cc} >/dev/null 2>&1") != 0) {
        print_message("note: no C compiler (%s): RT_NO_PACKETS not tested\n",
                      cc ? cc : "cc");
        return;
    }
    const int file = mkstemp(program);
    assert_true(file >= 0);
    close(file);
    snprintf(command, sizeof command,
             "${CC:-cc} -std=c99 -O1 -ffp-contract=off -DRT_NO_PACKETS -o %s "
             "tests/13_packets.c -lm 2>&1 && %s",
             program, program);
    FILE *pipe = popen(command, "r");
    assert_non_null(pipe);
    assert_non_null(fgets(said, sizeof said, pipe));
    assert_int_equal(pclose(pipe), 0);
    assert_int_equal(remove(program), 0);
    snprintf(ours, sizeof ours, "%016llx\n", (unsigned long long)hash_of_the_room(0));
    assert_string_equal(said, ours);
    assert_true(hash_of_the_room(1) == hash_of_the_room(0));
}

/* ---- cases that were wrong once ----------------------------------------------------- */

static rt_material grey(float albedo)
{
    const rt_material material = {{albedo, 0.8f * albedo, 0.6f * albedo}, false};
    return material;
}

static void test_spheres_in_spheres(void **state)
{
    /* Copies and almost copies, seen from inside: the far root must not come out too large. */
    (void)state;
    const float centers[] = {4, 4, 4.000001f, 4}, radii[] = {13, 13, 13, 13.000001f};
    for (int i = 0; i < 4; i++) {
        const rt_sphere spheres[] = {{{4, 1, 4}, 13, grey(0.5f)},
                                     {{centers[i], 1, 4}, radii[i], grey(0.9f)}};
        const rt_light light = {{0.055f, 5e-6f, 2.5f}, {70, 70, 70}};
        const rt_scene scene = {
            .spheres = spheres, .sphere_count = 2, .lights = &light, .light_count = 1};
        const rt_camera camera = {{4, 1, 3}, {9, -20, 2}, {0, 1, 0}, 90};
        picture p = picture_of(&scene, &camera);
        compare(&p, "spheres in spheres", i);
        const rt_camera outside = {{40, 1, 3}, {-9, 0, 0.2f}, {0, 1, 0}, 50};
        p.camera = outside;
        compare(&p, "spheres in spheres, from outside", i);
    }
}

static void test_a_small_sphere_inside_which_we_are(void **state)
{
    /* Its size is far below that of its coordinates; another one touches it. */
    (void)state;
    const rt_sphere spheres[] = {
        {{-21.9236374f, 1.62970185f, -4.49607086f}, 0.25f, grey(0.5f)},
        {{-25.7481995f, 2.79394579f, -5.93820667f}, 4, grey(0.9f)}};
    const rt_scene scene = {
        .spheres = spheres, .sphere_count = 2, .background = {0.3f, 0.6f, 0.4f}};
    const rt_camera camera = {
        {-22.0550442f, 1.62970185f, -4.49607086f}, {24, 0.2f, 5.6f}, {0, 1, 0}, 0};
    picture p = picture_of(&scene, &camera);
    p.options.samples = 20;
    compare(&p, "in a small sphere", 0);
}

static void test_rays_in_the_plane_of_a_face(void **state)
{
    /* A box is closed: a ray along its face hits it. The picture has no width: all rays have
     * the same direction, along an axis or in a plane, with components that are zero. */
    (void)state;
    const rt_box boxes[2] = {{{0, 0, -8}, {8, 4, -2}, grey(0.5f)},
                             {{-3, 0, -5}, {0, 4, 1}, grey(0.7f)}};
    const rt_light light = {{8, 9, 6}, {100, 100, 100}};
    rt_scene scene = {.boxes = boxes, .box_count = 2, .lights = &light, .light_count = 1};
    scene.background = rt_vec(0.5f, 0.25f, 0.125f);
    const rt_camera cameras[] = {
        {{8, 4, 10}, {0, 0, -1}, {0, 1, 0}, 0},  {{0, 2, 10}, {0, 0, -1}, {0, 1, 0}, 0},
        {{8, 2, 10}, {0, 0, -1}, {0, 1, 0}, 0},  {{20, 4, -3}, {-1, 0, 0}, {0, 1, 0}, 0},
        {{4, -9, -2}, {0, 1, 0}, {1, 0, 0}, 0},  {{-3, 9, -8}, {1, -1, 0}, {1, 0, 0}, 0},
        {{8, 0, 10}, {-1, 0, -2}, {0, 1, 0}, 0}, {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 0},
    };
    const float angles[] = {1e-44f, 1e-35f, 1e-30f, 1e-20f, 1e-10f, 1e-3f};
    for (size_t i = 0; i < COUNT(cameras); i++)
        for (size_t k = 0; k < COUNT(angles); k++) {
            picture p = picture_of(&scene, &cameras[i]);
            p.width = 7;
            p.height = 3;
            p.camera.fov_y = angles[k];
            compare(&p, "in the plane of a face", (int)(10 * i + k));
        }
}

static void test_rays_almost_parallel_to_a_face(void **state)
{
    /* Components below 1e-29, which have no inverse in packets, and a camera so close to
     * a face that the ray still meets it soon. */
    (void)state;
    const rt_sphere sphere = {{20, -10, -40}, 30, {{0.1f, 0.8f, 0.9f}, true}};
    const rt_box box = {{0, -10, -40}, {20, 10, 20}, grey(0.5f)};
    const rt_scene scene = {.spheres = &sphere,
                            .sphere_count = 1,
                            .boxes = &box,
                            .box_count = 1,
                            .background = {0.3f, 0.6f, 0.4f}};
    const rt_camera cameras[] = {
        {{1.4e-45f, 9.99999714f, -5.4f}, {0, 0, -1}, {0.81f, 0.37f, -0.45f}, 1e-30f},
        {{1e-35f, -9.5f, 19}, {0, 0.5f, -1}, {0.1f, 0.4f, 0}, 1e-33f},
        {{-1e-35f, -9.5f, 19}, {0, 0.5f, -1}, {0.1f, 0.4f, 0}, 1e-33f},
    };
    for (size_t i = 0; i < COUNT(cameras); i++) {
        const picture p = picture_of(&scene, &cameras[i]);
        compare(&p, "almost parallel to a face", (int)i);
    }
}

static void test_spheres_smaller_than_the_step_off_them(void **state)
{
    /* rt_leave goes farther than through the whole sphere: the ray is outside, not inside. */
    (void)state;
    const rt_sphere sphere = {
        {88087.6484f, -12.1278229f, 2.12936258f}, 0.0374866575f, grey(1)};
    const rt_light light = {{1680, -260, 2841}, {4e7f, 4e7f, 4e7f}};
    const rt_scene scene = {
        .spheres = &sphere, .sphere_count = 1, .lights = &light, .light_count = 1};
    const rt_camera camera = {sphere.center, {0, 0.04f, 0}, {1, 0, 0}, 90};
    const picture p = picture_of(&scene, &camera);
    const int before = bright;
    compare(&p, "a sphere smaller than the step", 0);
    assert_int_equal(bright, before + 1);
}

static void test_lights_on_the_surface(void **state)
{
    /* Rounding puts it a little above, or below: then chapter 4 finds the sphere in the
     * way. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 65);
    for (int i = 0; i < 60; i++) {
        const rt_sphere sphere = {rt_vec(145, -3, 33), 5, grey(0.5f)};
        const rt_vec3 n = random_direction(&rng), r = rt_scale(n, 5);
        const rt_light light = {rt_add(sphere.center, r), {2, 2, 2}};
        const rt_scene scene = {
            .spheres = &sphere, .sphere_count = 1, .lights = &light, .light_count = 1};
        const rt_camera camera = {
            rt_add(sphere.center, rt_scale(n, 200)), rt_scale(n, -1), {0, 1, 0}, 1e-3f};
        picture p = picture_of(&scene, &camera);
        p.options.bounces = 0;
        compare(&p, "light on the surface", i);
    }
}

static void test_on_the_surface(void **state)
{
    /* The camera exactly on a sphere and on a box: t = 0 is no hit. With many spheres, too. */
    (void)state;
    rt_sphere spheres[30];
    rt_rng rng = rt_rng_start(0, 0, 61);
    for (int i = 0; i < 30; i++) {
        spheres[i].center = random_point(&rng, 20);
        spheres[i].radius = uniform(&rng, 1, 4);
        spheres[i].material = grey(0.6f);
    }
    spheres[0].center = rt_vec(0, 0, 0);
    spheres[0].radius = 5;
    const rt_box box = {{3, -1, -1}, {5, 6, 7}, grey(0.4f)};
    const rt_light light = {{0, 4, 0}, {50, 50, 50}};
    for (int count = 1; count <= 30; count += 29)
        for (int i = 0; i < 6; i++) {
            const rt_scene scene = {.spheres = spheres,
                                    .sphere_count = count,
                                    .boxes = &box,
                                    .box_count = i % 2,
                                    .lights = &light,
                                    .light_count = 1,
                                    .background = {0.1f, 0.2f, 0.3f}};
            const rt_vec3 places[] = {{5, 0, 0}, {0, -5, 0}, {3, 0, 4}};
            const rt_camera camera = {places[i / 2], {-1, 0.5f, 0.25f}, {0, 1, 0}, 120};
            const picture p = picture_of(&scene, &camera);
            compare(&p, "on the surface", 10 * count + i);
        }
}

static void test_a_ray_that_grazes_a_mirror(void **state)
{
    /* So close that rounding makes the reflected ray start below the surface. */
    (void)state;
    const rt_sphere spheres[1] = {
        {{0.756089509f, 0.358208299f, -5.40043497f}, 1.05996764f, {{1, 1, 1}, true}}};
    const rt_camera camera = {{0, 0, 0}, {0.3f, 0.2f, -1}, {0, 1, 0}, 1e-44f};
    for (int i = 0; i < 1; i++) {
        const rt_scene scene = {
            .spheres = &spheres[i], .sphere_count = 1, .background = {0.3f, 0.6f, 0.4f}};
        const rt_ray ray = rt_camera_ray(&camera, 1, 1, 0.5f, 0.5f);
        rt_hit hit = untouched;
        assert_true(rt_intersect(&scene, &ray, &hit));
        assert_true(rt_dot(hit.normal, rt_reflect(ray.direction, hit.normal)) < 0);
        for (int bounces = 0; bounces < 20; bounces++) {
            picture p = picture_of(&scene, &camera);
            p.options.bounces = bounces;
            compare(&p, "grazing a mirror, bounces", bounces);
        }
    }
}

/* ---- random scenes, and odd ones ---------------------------------------------------- */

enum { MOST = 120, CORNERS = 200, TRIANGLES = 400, MESHES = 20, OWN = 30 };

/* The shapes of a random scene; scale is the unit of length. */
typedef struct odd_scene {
    rt_sphere spheres[MOST];
    rt_box boxes[MOST];
    rt_light lights[3];
    rt_vec3 positions[CORNERS];
    int indices[3 * TRIANGLES];
    rt_mesh meshes[MESHES];
    rt_custom_shape own[OWN];
    rt_sphere own_balls[OWN];
    rt_surface surfaces[2 * MOST + MESHES + OWN];
    rt_lamp lamps[4];
    picture p;
    float scale;
    rt_rng *rng;
} odd_scene;

static int below(rt_rng *rng, int n)
{
    return (int)(rt_random(rng) * (float)n);
}

static bool chance(rt_rng *rng, float part)
{
    return rt_random(rng) < part;
}

/* Few values, so that shapes touch, coincide and line up; or any. */
static float coordinate(odd_scene *s, int style)
{
    const float whole = (float)(below(s->rng, 11) - 5);
    if (style == 0)
        return s->scale * whole;
    if (style == 1) /* a few roundings off */
        return s->scale * whole * (1.0f + FLT_EPSILON * (float)(below(s->rng, 7) - 3));
    return s->scale * uniform(s->rng, -6, 6);
}

static rt_vec3 place(odd_scene *s, int style)
{
    const float x = coordinate(s, style);
    const float y = coordinate(s, style);
    const float z = coordinate(s, style);
    return rt_vec(x, y, z);
}

static float length_of(odd_scene *s, int style)
{
    if (style == 2)
        return s->scale * uniform(s->rng, 0.1f, 4);
    return s->scale * (float)(1 + below(s->rng, 4)) *
           (style == 0 ? 1.0f : 1.0f + FLT_EPSILON * (float)(below(s->rng, 7) - 3));
}

static rt_material material(odd_scene *s)
{
    const float values[] = {0, 1, 0.5f, 1e-20f};
    rt_material m;
    m.albedo = random_colour(s->rng);
    m.mirror = chance(s->rng, 0.3f);
    if (chance(s->rng, 0.25f)) /* black, or a mirror that loses nothing */
        m.albedo.x = m.albedo.y = m.albedo.z = values[below(s->rng, (int)COUNT(values))];
    if (chance(s->rng, 0.1f))
        m.albedo.y = 0;
    return m;
}

static rt_sphere *sphere_at(odd_scene *s, rt_vec3 center, float radius)
{
    assert_true(s->p.scene.sphere_count < MOST);
    rt_sphere *sphere = &s->spheres[s->p.scene.sphere_count++];
    sphere->center = center;
    sphere->radius = radius;
    sphere->material = material(s);
    return sphere;
}

static void box_between(odd_scene *s, rt_vec3 a, rt_vec3 b)
{
    assert_true(s->p.scene.box_count < MOST);
    rt_box *box = &s->boxes[s->p.scene.box_count++];
    box->min = rt__min(a, b);
    box->max = rt__max(a, b);
    box->material = material(s);
}

static void some_shapes(odd_scene *s, int spheres, int boxes, int style)
{
    for (int i = 0; i < spheres; i++)
        sphere_at(s, place(s, style), length_of(s, style));
    for (int i = 0; i < boxes; i++)
        box_between(s, place(s, style), place(s, style));
}

enum { ROOM, NESTED, CHAIN, CLOSED, COPIES, SIZES, FAR, TREE, SOME, KINDS = SOME + 3 };

static void odd_shapes(odd_scene *s, int kind)
{
    rt_rng *rng = s->rng;
    const int style = below(rng, 3);
    const float scale = s->scale;
    rt_vec3 at = place(s, style);
    float radius = length_of(s, style);
    switch (kind) {
    case ROOM: { /* walls of giants, some of them missing */
        const float giant = scale * powf(10, uniform(rng, 1, 6)), half = 6 * scale;
        for (int k = 0; k < 6; k++) {
            const float x = k % 2 == 0 ? giant + half : -giant - half;
            if (chance(rng, 0.8f))
                sphere_at(
                    s, rt_vec(k / 2 == 0 ? x : 0, k / 2 == 1 ? x : 0, k / 2 == 2 ? x : 0),
                    giant);
        }
        some_shapes(s, below(rng, 4), below(rng, 3), style);
        break;
    }
    case NESTED: /* one in the other, with the same centre, some of the same size */
        for (int i = 1 + below(rng, 6); i > 0; i--) {
            sphere_at(s, at, radius);
            radius *= i % 3 == 0 ? 1.0f : i % 3 == 1 ? 1.0f + FLT_EPSILON : 1.5f;
        }
        break;
    case CHAIN: /* each touches the one before */
        for (int i = 2 + below(rng, 6); i > 0; i--) {
            const rt_vec3 along =
                chance(rng, 0.5f) ? rt_vec(0, 1, 0) : random_direction(rng);
            const float next = length_of(s, style);
            sphere_at(s, at, radius);
            at = rt_add(at, rt_scale(along, radius + next));
            radius = next;
        }
        some_shapes(s, 0, below(rng, 3), style);
        break;
    case CLOSED: /* in a sphere or a box */
        if (chance(rng, 0.5f))
            sphere_at(s, rt_scale(at, 0.1f), 20 * scale);
        else
            box_between(s, rt_vec(-20 * scale, -20 * scale, -20 * scale),
                        rt_vec(20 * scale, 20 * scale, 20 * scale));
        some_shapes(s, below(rng, 5), below(rng, 4), style);
        break;
    case COPIES: {
        const rt_vec3 corner = place(s, style);
        for (int i = 1 + below(rng, 20); i > 0; i--) {
            if (chance(rng, 0.5f))
                sphere_at(s, at, radius);
            else
                box_between(s, at, corner);
            if (chance(rng, 0.2f))
                radius *= 1.0f + FLT_EPSILON;
        }
        break;
    }
    case SIZES:
        for (int i = 1 + below(rng, 12); i > 0; i--) {
            const float size = scale * powf(10, uniform(rng, -3, 4));
            const rt_vec3 p = rt_scale(random_direction(rng), size * uniform(rng, 0, 3));
            if (chance(rng, 0.6f))
                sphere_at(s, p, size);
            else
                box_between(s, p, rt_add(p, rt_scale(random_direction(rng), size)));
        }
        break;
    case FAR: /* from the origin: few digits are left */
        at = rt_scale(random_direction(rng), scale * powf(10, uniform(rng, 2, 6)));
        some_shapes(s, 1 + below(rng, 4), below(rng, 4), style);
        for (int i = 0; i < s->p.scene.sphere_count; i++)
            s->spheres[i].center = rt_add(s->spheres[i].center, at);
        for (int i = 0; i < s->p.scene.box_count; i++) {
            s->boxes[i].min = rt_add(s->boxes[i].min, at);
            s->boxes[i].max = rt_add(s->boxes[i].max, at);
        }
        break;
    case TREE:
        s->scale = 5 * scale;
        some_shapes(s, 1 + below(rng, 60), below(rng, 60), style);
        s->scale = scale;
        break;
    default: some_shapes(s, below(rng, 6), below(rng, 5), style); break;
    }
}

/* Somewhere, or in, on or near a shape. */
static rt_vec3 some_place(odd_scene *s)
{
    rt_rng *rng = s->rng;
    const rt_scene *scene = &s->p.scene;
    const int what = below(rng, 9);
    if (what < 4 && scene->sphere_count > 0) {
        const rt_sphere *sphere = &s->spheres[below(rng, scene->sphere_count)];
        const rt_vec3 axes[] = {{1, 0, 0}, {0, -1, 0}, {0, 0, 1}};
        const rt_vec3 n = chance(rng, 0.5f) ? axes[below(rng, 3)] : random_direction(rng);
        const float out = what == 0   ? 0.0f
                          : what == 1 ? 1.0f
                          : what == 2 ? rt_random(rng)
                                      : 1.0f + powf(10, uniform(rng, -7, 0));
        return rt_add(sphere->center, rt_scale(n, out * sphere->radius));
    }
    if (what < 7 && scene->box_count > 0) {
        const rt_box *box = &s->boxes[below(rng, scene->box_count)];
        const rt_vec3 part = random_colour(rng);
        rt_vec3 p = rt_add(box->min, rt_mul(part, rt_sub(box->max, box->min)));
        p.x = part.x < 0.4f ? box->min.x : p.x;
        p.y = part.y < 0.4f ? box->max.y : p.y;
        p.z = part.z < 0.4f ? box->min.z : p.z;
        return p;
    }
    return place(s, below(rng, 3));
}

static void make_odd_scene(odd_scene *s, rt_rng *rng)
{
    const float scales[] = {1, 1, 1, 10, 100, 1e-3f, 1e3f, 1e6f, 1e7f, 1e8f};
    const float angles[] = {0,  40, 90,    120,   170,    179,
                            10, 1,  1e-3f, 1e-6f, 1e-35f, 1e-44f};
    const int sizes[][2] = {{1, 1}, {7, 3}, {13, 5}, {8, 6}, {16, 3}, {3, 11}, {19, 1}};
    const int bounces[] = {0, 1, 2, 5, 5, 12};
    memset(s, 0, sizeof *s);
    s->rng = rng;
    s->scale = scales[below(rng, (int)COUNT(scales))];
    picture *p = &s->p;
    odd_shapes(s, below(rng, KINDS));
    p->scene.spheres = s->spheres;
    p->scene.boxes = s->boxes;
    p->scene.lights = s->lights;
    p->scene.light_count = chance(rng, 0.7f) ? 1 : below(rng, 4);
    for (int i = 0; i < p->scene.light_count; i++) {
        const float size = s->scale < 1e5f ? s->scale : 1e5f;
        const float power = size * size * powf(10, uniform(rng, 0, 3));
        s->lights[i].position = some_place(s);
        s->lights[i].intensity = rt_vec(power, power, chance(rng, 0.1f) ? 0 : power);
    }
    if (chance(rng, 0.3f))
        p->scene.background = random_colour(rng);
    p->camera.position = some_place(s);
    const rt_vec3 towards = chance(rng, 0.1f) ? s->lights[0].position : some_place(s);
    const float x = (float)below(rng, 3);
    p->camera.direction = chance(rng, 0.3f) ? rt_vec(x - 1, 0, x == 1 ? -1.0f : 0.0f)
                                            : rt_sub(towards, p->camera.position);
    if (chance(rng, 0.3f))
        p->camera.up = random_direction(rng);
    p->camera.fov_y = angles[below(rng, (int)COUNT(angles))];
    const int size = below(rng, (int)COUNT(sizes));
    p->width = sizes[size][0];
    p->height = sizes[size][1];
    p->options.samples = 1 + below(rng, 2);
    p->options.bounces = bounces[below(rng, (int)COUNT(bounces))];
    p->options.threads = 1;
    p->options.seed = (uint32_t)below(rng, 1000);
    p->options.sampler = chance(rng, 0.3f) ? RT_RANDOM : RT_SOBOL;
    p->first = chance(rng, 0.3f) ? below(rng, 1000) : 0;
}

static void test_odd_scenes(void **state)
{
    (void)state;
    static odd_scene s;
    const int before = bright;
    enum { SCENES = 2500 };
    for (int i = 0; i < SCENES; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 62);
        make_odd_scene(&s, &rng);
        compare(&s.p, "odd scene", i);
    }
    print_message("%d odd scenes, %d of them not black\n", SCENES, bright - before);
    assert_true(bright - before > SCENES / 4);
}

/* ---- part two -------------------------------------------------------------------------- */

/* A pattern and a sky, which are not always what they should be. */
static rt_vec3 checked(const void *data, rt_vec3 point, rt_vec3 normal)
{
    const rt_vec3 p = rt_scale(point, 1 / *(const float *)data);
    const float sum = floorf(p.x) + floorf(p.y) + floorf(p.z);
    return rt_vec(fmodf(sum, 2), normal.x, sum > 9 ? NAN : 0.7f);
}

static rt_vec3 blue(const void *data, rt_vec3 direction)
{
    const float up = direction.y * *(const float *)data;
    return rt_vec(0.5f - up, up > 0.9f ? NAN : 0.5f, direction.z < 0 ? 1 : 0.9f * up);
}

static rt_surface odd_surface(odd_scene *s)
{
    const float etas[] = {1, 1.0001f, 1.33f, 1.5f, 2.4f, 4};
    rt_rng *rng = s->rng;
    rt_surface surface;
    memset(&surface, 0, sizeof surface);
    const int what = below(rng, 8);
    if (what < 2)
        surface.eta = etas[below(rng, (int)COUNT(etas))];
    if (what < 2 && chance(rng, 0.5f))
        surface.absorption =
            rt_vec(powf(10, uniform(rng, -3, 3)) / s->scale, 0.1f / s->scale, 0);
    if (what > 0 && what < 5)
        surface.shininess = powf(10, uniform(rng, -1, 6));
    if (chance(rng, 0.1f))
        surface.emission = random_colour(rng);
    if (chance(rng, 0.2f))
        surface.pattern = checked;
    surface.pattern_data = &s->scale;
    return surface;
}

static rt_lamp odd_lamp(odd_scene *s)
{
    rt_rng *rng = s->rng;
    const float size = s->scale < 1e5f ? s->scale : 1e5f;
    const float power = size * size * powf(10, uniform(rng, 0, 3));
    rt_lamp lamp;
    memset(&lamp, 0, sizeof lamp);
    lamp.center = some_place(s);
    lamp.intensity = rt_vec(power, power, chance(rng, 0.1f) ? 0 : power);
    if (chance(rng, 0.4f)) {
        const float width = length_of(s, below(rng, 3));
        const rt_vec3 normal =
            chance(rng, 0.5f) ? rt_vec(0, -1, 0) : random_direction(rng);
        rt_basis(normal, &lamp.u, &lamp.v);
        lamp.u = rt_scale(lamp.u, width);
        lamp.v = rt_add(rt_scale(lamp.v, length_of(s, 2)), /* askew */
                        rt_scale(lamp.u, (float)below(rng, 2)));
        return lamp;
    }
    lamp.radius = 0.5f * length_of(s, below(rng, 3));
    if (chance(rng, 0.3f) && s->p.scene.sphere_count > 0) { /* it touches a sphere */
        const rt_sphere *sphere = &s->spheres[below(rng, s->p.scene.sphere_count)];
        const float out = chance(rng, 0.5f) ? sphere->radius + lamp.radius
                                            : sphere->radius - lamp.radius;
        lamp.center = rt_add(sphere->center, rt_scale(random_direction(rng), out));
    }
    if (chance(rng, 0.1f)) /* a sun */
        lamp.center = rt_scale(lamp.center, powf(10, uniform(rng, 1, 8)));
    return lamp;
}

/* Make it a scene of part two, with at least one of surfaces, lamps, sky and lens. */
static void add_part_two(odd_scene *s)
{
    rt_rng *rng = s->rng;
    picture *p = &s->p;
    const int what = 1 + below(rng, 15);
    for (int i = 0; i < 2 * MOST + MESHES + OWN; i++)
        s->surfaces[i] = odd_surface(s);
    if ((what & 1) != 0)
        p->scene.surfaces = s->surfaces;
    for (int i = 0; (what & 2) != 0 && i < (chance(rng, 0.7f) ? 1 : 4); i++)
        s->lamps[p->scene.lamp_count++] = odd_lamp(s);
    p->scene.lamps = s->lamps;
    if ((what & 4) != 0)
        p->scene.sky = blue;
    p->scene.sky_data = &s->scale;
    if ((what & 8) != 0) {
        p->options.lens.radius = 0.1f * length_of(s, below(rng, 3));
        p->options.lens.focus = length_of(s, below(rng, 3));
    }
    if (chance(rng, 0.05f))
        p->options.bounces = RT_ALL_BOUNCES;
    p->guides = chance(rng, 0.3f);
    if (chance(rng, 0.1f)) {
        p->first_pixel = below(rng, p->width * p->height);
        p->pixel_count = 1 + below(rng, p->width * p->height - p->first_pixel);
    }
}

static void test_odd_scenes_of_part_two(void **state)
{
    (void)state;
    static odd_scene s;
    const int before = bright;
    enum { SCENES = 4000 };
    int compared = 0;
    for (int i = 0; i < SCENES; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 66);
        make_odd_scene(&s, &rng);
        add_part_two(&s);
        if (rt_check_scene(&s.p.scene, NULL) != RT_OK)
            continue; /* a lamp farther than 1e15 */
        compare(&s.p, "odd scene of part two", i);
        compared++;
    }
    print_message("%d odd scenes of part two, %d of them not black\n", compared,
                  bright - before);
    assert_true(compared > SCENES * 9 / 10);
    assert_true(bright - before > SCENES / 2);
}

/* A room with everything in it, in a size for which packets are meant: few shapes, or so many
 * that they have a tree. */
static void test_a_room_of_part_two(void **state)
{
    (void)state;
    enum { BALLS = 700 };
    static rt_sphere spheres[5 + BALLS];
    static rt_surface surfaces[5 + BALLS];
    const float scale = 9;
    const rt_lamp lamps[] = {{{-4, 26, 19}, 6, {3380, 3380, 3380}, {0, 0, 0}, {0, 0, 0}},
                             {{0, 39.5f, 0}, 0, {900, 700, 500}, {9, 0, 0}, {3, 0, 7}},
                             {{30, 0, 10}, 1, {400, 400, 900}, {0, 0, 0}, {0, 0, 0}}};
    rt_rng rng = rt_rng_start(0, 0, 67);
    memcpy(spheres, room_spheres + 1, 5 * sizeof *spheres);
    surfaces[1].pattern = surfaces[3].pattern = checked; /* the ceiling, the floor */
    for (int i = 0; i < 5; i++)
        surfaces[i].pattern_data = &scale;
    for (int i = 5; i < 5 + BALLS; i++) {
        spheres[i].center = random_point(&rng, 30);
        spheres[i].radius = uniform(&rng, 0.5f, 3);
        spheres[i].material.albedo = random_colour(&rng);
        spheres[i].material.mirror = i % 3 == 0;
        surfaces[i].shininess = i % 2 == 0 ? powf(10, uniform(&rng, 0, 4)) : 0;
        surfaces[i].eta = i % 5 == 0 ? 1.5f : 0;
        surfaces[i].absorption = rt_vec(0.1f, 0, 0.2f);
        if (i % 7 == 0)
            surfaces[i].emission = rt_vec(0.3f, 0.2f, 0);
    }
    const int before = bright, counts[] = {0, 3, 12, 60, BALLS};
    for (int i = 0; i < 30; i++) {
        const rt_scene scene = {.spheres = spheres,
                                .sphere_count = 5 + counts[i % 5],
                                .lights = &room_dim_light,
                                .light_count = i % 2,
                                .surfaces = surfaces,
                                .lamps = lamps,
                                .lamp_count = i % 4};
        picture p = picture_of(&scene, &room_camera);
        p.width = 37;
        p.height = 23;
        p.guides = i % 3 == 0;
        p.options.bounces = i % 9;
        p.options.sampler = i % 7 < 5 ? RT_SOBOL : RT_RANDOM;
        p.options.lens.radius = i % 8 == 0 ? 2 : 0;
        p.options.lens.focus = 100;
        compare(&p, "a room of part two", i);
    }
    assert_true(bright - before >= 28);
}

/* A sphere as a custom shape, and a flat disc at the height of its middle. */
static bool hit_own_ball(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_sphere *sphere = data;
    if (!rt_hit_sphere(sphere, ray, t_max, hit))
        return false;
    hit->normal = rt_sub(hit->point, sphere->center);
    return true;
}

static bool hit_own_disc(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_sphere *s = data;
    const double u = (double)ray->direction.y;
    const double t = u != 0 ? ((double)s->center.y - (double)ray->origin.y) / u : -1;
    if (!(t > 0 && t < (double)t_max))
        return false;
    hit->t = (float)t;
    hit->point =
        rt_to_float(rt_dmad(rt_to_double(ray->origin), t, rt_to_double(ray->direction)));
    hit->point.y = s->center.y;
    hit->normal = rt_vec(0, 3, 0);
    return rt_length(rt_sub(hit->point, s->center)) <= s->radius;
}

/* Meshes of few or many triangles, which touch, coincide, or have no area; most have
 * corners all over the scene, some are small and closed. And custom shapes. There are few
 * of these two kinds, as in most scenes, or as many as there is room for. */
static void add_meshes_and_own_shapes(odd_scene *s)
{
    rt_rng *rng = s->rng;
    rt_scene *scene = &s->p.scene;
    const int style = below(rng, 3);
    const bool many = chance(rng, 0.3f);
    for (int i = 0; i < CORNERS; i++)
        s->positions[i] =
            i % 4 == 3 && chance(rng, 0.5f) ? s->positions[i - 1] : place(s, style);
    for (int i = 0; i < 3 * TRIANGLES; i++)
        s->indices[i] = below(rng, CORNERS);
    const rt_vec3 at = place(s, style); /* four of the corners are a tetrahedron */
    const float size = length_of(s, style);
    const int faces[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    for (int k = 0; k < 4; k++)
        s->positions[k] = rt_add(
            at, rt_scale(rt_vec(k < 2 ? 1 : -1, k % 2 ? -1 : 1, k % 3 ? -1 : 1), size));
    memcpy(s->indices, faces, sizeof faces);
    scene->meshes = s->meshes;
    scene->mesh_count = chance(rng, 0.2f) ? 0 : 1 + below(rng, many ? MESHES : 3);
    for (int i = 0, first = 0; i < scene->mesh_count; i++) {
        const int left = TRIANGLES - first;
        int count = i == 0 ? 4 : below(rng, many ? 40 : 9);
        if (i == 1 && chance(rng, 0.2f))
            count = left;
        s->meshes[i].triangle_count = count < left ? count : left;
        s->meshes[i].positions = s->positions;
        s->meshes[i].position_count = CORNERS;
        s->meshes[i].indices = s->indices + 3 * first;
        s->meshes[i].material = material(s);
        first += s->meshes[i].triangle_count;
    }
    scene->custom_shapes = s->own;
    scene->custom_shape_count = chance(rng, 0.3f) ? 0 : below(rng, many ? OWN : 4);
    for (int i = 0; i < scene->custom_shape_count; i++) {
        const bool flat = chance(rng, 0.3f);
        rt_sphere *ball = &s->own_balls[i];
        ball->center = chance(rng, 0.3f) ? at : place(s, style);
        ball->radius = length_of(s, style);
        const float r = ball->radius;
        s->own[i].min = rt_sub(ball->center, rt_vec(r, flat ? 0 : r, r));
        s->own[i].max = rt_add(ball->center, rt_vec(r, flat ? 0 : r, r));
        s->own[i].material = material(s);
        s->own[i].hit = flat ? hit_own_disc : hit_own_ball;
        s->own[i].data = ball;
    }
}

static void test_odd_scenes_with_meshes_and_own_shapes(void **state)
{
    /* With and without spheres and boxes, and what else part two has. */
    (void)state;
    static odd_scene s;
    const int before = bright;
    enum { SCENES = 1500 };
    int compared = 0;
    for (int i = 0; i < SCENES; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 68);
        make_odd_scene(&s, &rng);
        if (i % 3 == 0)
            s.p.scene.sphere_count = s.p.scene.box_count = 0;
        add_meshes_and_own_shapes(&s);
        if (i % 4 > 0)
            add_part_two(&s);
        if (rt_check_scene(&s.p.scene, NULL) != RT_OK)
            continue;
        compare(&s.p, "odd scene with meshes and own shapes", i);
        compared++;
    }
    print_message("%d odd scenes with meshes and own shapes, %d of them not black\n",
                  compared, bright - before);
    assert_true(compared > SCENES * 9 / 10);
    assert_true(bright - before > SCENES / 3);
}

static void test_a_room_with_a_mesh(void **state)
{
    /* A sphere of triangles, a ring, and a custom ball in the room: each matt, of glass
     * and of gloss, with a pattern, by lamps and by points of light. */
    (void)state;
    static rt_surface surfaces[6 + 2 + 1];
    const float scale = 9;
    const rt_lamp lamp = {{-4, 26, 19}, 6, {3380, 3380, 3380}, {0, 0, 0}, {0, 0, 0}};
    const rt_sphere ball = {{-20, -10, 20}, 9, grey(1)};
    const rt_custom_shape own = {
        {-29, -19, 11}, {-11, -1, 29}, grey(0.6f), hit_own_ball, &ball};
    rt_mesh meshes[2] = {make_icosphere(3), make_ring(12, 4, 40, 20)};
    place_mesh(&meshes[0], rt_vec(10, -8, 15), 11, 0);
    place_mesh(&meshes[1], rt_vec(-10, -15, -10), 1, 0);
    const int before = bright;
    for (int i = 0; i < 48; i++) {
        rt_scene scene = {.spheres = room_spheres,
                          .sphere_count = 6,
                          .lights = &room_dim_light,
                          .light_count = i % 2,
                          .surfaces = i % 3 ? surfaces : NULL,
                          .lamps = &lamp,
                          .lamp_count = 1 - i % 2,
                          .meshes = meshes,
                          .mesh_count = 1 + i / 2 % 2,
                          .custom_shapes = &own,
                          .custom_shape_count = i / 4 % 2};
        memset(surfaces, 0, sizeof surfaces);
        for (int k = 6; k < 9; k++) {
            const int kind = (i / 3 + k) % 4;
            surfaces[k].eta = kind == 1 ? 1.5f : 0;
            surfaces[k].shininess = kind == 2 ? 60 : 0;
            surfaces[k].pattern = kind == 3 ? checked : NULL;
            surfaces[k].pattern_data = &scale;
            surfaces[k].absorption = rt_vec(0.05f, 0, 0.1f);
        }
        meshes[0].material = grey(0.9f);
        meshes[0].material.mirror = i % 5 == 0;
        picture p = picture_of(&scene, &room_camera);
        p.width = 37;
        p.height = 23;
        p.guides = i % 3 == 0;
        p.options.bounces = i % 9;
        p.options.sampler = i % 7 < 5 ? RT_SOBOL : RT_RANDOM;
        p.options.lens.radius = i % 8 == 0 ? 2 : 0;
        p.options.lens.focus = 100;
        compare(&p, "a room with a mesh", i);
    }
    assert_true(bright - before >= 45);
    free_mesh(&meshes[0]);
    free_mesh(&meshes[1]);
}

static void test_guides_behind_dark_mirrors(void **state)
{
    /* They leave so little of the light that the path ends, but the look goes on. */
    (void)state;
    const rt_material dark = {{1e-20f, 1e-20f, 1e-20f}, true};
    const rt_sphere spheres[] = {{{-1, 0, 0}, 1, dark}, {{1, 0, 0}, 1, dark}};
    const rt_box box = {{-9, -9, -9}, {9, 9, 9}, grey(0.5f)};
    const rt_scene scene = {.spheres = spheres,
                            .sphere_count = 2,
                            .boxes = &box,
                            .box_count = 1,
                            .lights = &room_dim_light,
                            .light_count = 1};
    const rt_camera camera = {{0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 0};
    picture p = picture_of(&scene, &camera);
    p.guides = true;
    p.width = p.height = 40;
    compare(&p, "dark mirrors", 1);
    p.scene.sky = blue;
    const float one = 1;
    p.scene.sky_data = &one;
    compare(&p, "dark mirrors", 2);
}

static void test_random_scenes(void **state)
{
    (void)state;
    const int before = bright;
    rt_rng rng = rt_rng_start(0, 0, 63);
    for (int i = 0; i < 150; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        const rt_ray ray = random_ray(&rng);
        const rt_camera camera = {ray.origin, ray.direction, {0, 1, 0}, 60};
        picture p = picture_of(&r.scene, &camera);
        p.options.seed = (uint32_t)i;
        p.options.bounces = i % 7;
        p.options.sampler = i % 2 == 0 ? RT_SOBOL : RT_RANDOM;
        compare(&p, "random scene", i);
    }
    assert_true(bright - before > 100);
}

static void test_huge_scenes(void **state)
{
    /* Too large for the packets' floats: 1e9 to 1e14 and more. */
    (void)state;
    static odd_scene s;
    for (int i = 0; i < 150; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 64);
        memset(&s, 0, sizeof s);
        s.rng = &rng;
        s.scale = powf(10, (float)(9 + i % 5));
        odd_shapes(&s, CLOSED);
        s.p.scene.spheres = s.spheres;
        s.p.scene.boxes = s.boxes;
        s.p.scene.lights = s.lights;
        s.p.scene.light_count = 1;
        s.p.scene.background = rt_vec(0.5f, 0.5f, 0.5f);
        s.lights[0].position = some_place(&s);
        s.lights[0].intensity = rt_vec(1e14f, 1e13f, 1e12f);
        s.p.camera.position = some_place(&s);
        s.p.camera.fov_y = 100;
        s.p.width = 9;
        s.p.height = 5;
        s.p.options.samples = 1;
        s.p.options.bounces = i % 4;
        s.p.options.threads = 1;
        compare(&s.p, "huge scene", i);
    }
}

static void test_lights_next_to_small_spheres_seen_from_afar(void **state)
{
    /* Where the end of a shadow ray is rounded by more than its distance from the sphere. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 65);
    for (int i = 0; i < 60; i++) {
        const float size = powf(10, 3 + (float)(i % 8) / 2);
        const rt_sphere sphere = {
            {5, 0, 0}, 3, {{1, 0.4f, 1}, i % 3 == 0}}; /* and lights around it */
        const rt_box box = {{-size, -size, -size}, {size, size, size}, {{1, 0.5f, 1}, 0}};
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 out = rt_sample_cosine(rt_vec(0, i % 2 == 0 ? 1 : -1, 0), r1, r2);
        const rt_light light = {
            rt_add(sphere.center, rt_scale(out, 3.0f + powf(10, (float)(i % 5 - 4)))),
            {4, 4, 4}};
        const rt_scene scene = {.spheres = &sphere,
                                .sphere_count = 1,
                                .boxes = &box,
                                .box_count = 1,
                                .lights = &light,
                                .light_count = 1};
        const rt_camera camera = {{2, 8, -4}, {0.7f, -0.1f, 0.7f}, {0, 1, 0}, 90};
        const picture p = picture_of(&scene, &camera);
        compare(&p, "light next to a sphere", i);
    }
}

/* Nothing else would notice that packets are missing: they are only faster. */
static void test_the_room_is_asked_shape_by_shape(void **state)
{
    (void)state;
#if RT__LANES > 1
    const rt_lens pinhole = {0, 0};
    assert_true(rt__are_few(&scene_indirect, &room_camera, &pinhole));
#endif
}

static void test_no_shapes(void **state)
{
    (void)state;
    const rt_light light = {{0, 4, 0}, {50, 50, 50}};
    const rt_scene scenes[] = {
        {.background = {0.1f, 0.2f, 0.3f}},
        {.lights = &light, .light_count = 1},
        {.lights = &light, .light_count = 1, .background = {0.1f, 0.2f, 0.3f}},
    };
    for (int i = 0; i < 3; i++) {
        const picture p = picture_of(&scenes[i], &room_camera);
        compare(&p, "no shapes", i);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_which_lanes_there_are),
        cmocka_unit_test(test_other_numbers_of_lanes_are_refused),
        cmocka_unit_test(test_the_room),
        cmocka_unit_test(test_the_scenes_of_the_references),
        cmocka_unit_test(test_samples_and_threads_and_lanes_in_any_order),
        cmocka_unit_test(test_cancelled_packets_go_on_to_the_same_bits),
        cmocka_unit_test(test_without_packets),
        cmocka_unit_test(test_spheres_in_spheres),
        cmocka_unit_test(test_a_small_sphere_inside_which_we_are),
        cmocka_unit_test(test_rays_in_the_plane_of_a_face),
        cmocka_unit_test(test_rays_almost_parallel_to_a_face),
        cmocka_unit_test(test_spheres_smaller_than_the_step_off_them),
        cmocka_unit_test(test_on_the_surface),
        cmocka_unit_test(test_lights_on_the_surface),
        cmocka_unit_test(test_a_ray_that_grazes_a_mirror),
        cmocka_unit_test(test_odd_scenes),
        cmocka_unit_test(test_odd_scenes_of_part_two),
        cmocka_unit_test(test_a_room_of_part_two),
        cmocka_unit_test(test_odd_scenes_with_meshes_and_own_shapes),
        cmocka_unit_test(test_a_room_with_a_mesh),
        cmocka_unit_test(test_guides_behind_dark_mirrors),
        cmocka_unit_test(test_random_scenes),
        cmocka_unit_test(test_huge_scenes),
        cmocka_unit_test(test_lights_next_to_small_spheres_seen_from_afar),
        cmocka_unit_test(test_no_shapes),
        cmocka_unit_test(test_the_room_is_asked_shape_by_shape),
    };
    return cmocka_run_group_tests_name("packets", tests, NULL, NULL);
}
#endif

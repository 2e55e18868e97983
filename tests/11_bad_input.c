/* More than a hundred bad or odd inputs, each with what is documented to happen. The numbers are those of
 * the table in docs/correctness.md. */
#define _DARWIN_C_SOURCE  /* mkdtemp on macOS */
#define _XOPEN_SOURCE 700 /* mkdtemp, popen, realpath, symlink, nftw */
#include "../demos/scene.h"
#include "programs.h"

/* ---- helpers ------------------------------------------------------------------------ */

static const float inf = INFINITY, nan_ = NAN;
static const rt_sphere ball = {{0, 0, -5}, 1, {{1, 1, 1}, false}};
static const rt_box cube = {{-1, -1, -6}, {1, 1, -4}, {{1, 1, 1}, false}};
static const rt_vec3 zero = {0, 0, 0}, ahead = {0, 0, -1};

static rt_hit hit; /* of the last question */

static bool on_sphere(const rt_sphere *sphere, rt_vec3 origin, rt_vec3 direction)
{
    const rt_ray ray = ray_of(origin, direction);
    hit = untouched;
    const bool is_hit = rt_hit_sphere(sphere, &ray, FLT_MAX, &hit);
    if (!is_hit)
        assert_untouched(hit);
    else
        assert_true(hit.t > 0 && hit.t <= FLT_MAX &&
                    fabsf(rt_length(hit.normal) - 1) < 1e-5f);
    return is_hit;
}

static bool on_box(const rt_box *box, rt_vec3 origin, rt_vec3 direction)
{
    const rt_ray ray = ray_of(origin, direction);
    hit = untouched;
    const bool is_hit = rt_hit_box(box, &ray, FLT_MAX, &hit);
    if (!is_hit)
        assert_untouched(hit);
    else
        assert_true(hit.t > 0 && hit.t <= FLT_MAX && rt_length(hit.normal) == 1);
    return is_hit;
}

static void both_miss(rt_vec3 origin, rt_vec3 direction)
{
    assert_false(on_sphere(&ball, origin, direction));
    assert_false(on_box(&cube, origin, direction));
}

static rt_sphere sphere_of(float radius)
{
    rt_sphere sphere = ball;
    sphere.radius = radius;
    return sphere;
}

static rt_box box_of(rt_vec3 min, rt_vec3 max)
{
    rt_box box = cube;
    box.min = min;
    box.max = max;
    return box;
}

/* rt_render of a 4 x 3 picture; the pixels stay in picture. */
static rt_vec3 picture[12];

static rt_status render(const rt_scene *scene, const rt_camera *camera,
                        rt_options options)
{
    rt_image image = {.width = 4, .height = 3, .pixels = picture};
    if (options.samples == 0)
        options.samples = 2;
    return rt_render(scene, camera, &options, &image);
}

static rt_status render_scene(const rt_scene *scene)
{
    rt_options options = {.bounces = 3};
    const rt_status status = render(scene, &room_camera, options);
    for (size_t i = 0; i < COUNT(picture) && status == RT_OK; i++)
        assert_true(picture[i].x >= 0 && picture[i].x <= FLT_MAX && picture[i].y >= 0 &&
                    picture[i].y <= FLT_MAX && picture[i].z >= 0 &&
                    picture[i].z <= FLT_MAX);
    return status;
}

static rt_status render_sphere(rt_sphere sphere)
{
    rt_scene scene = scene_walls;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    return render_scene(&scene);
}

static rt_status render_light(float x, float y, float z, float intensity)
{
    const rt_light light = {{x, y, z}, {intensity, intensity, intensity}};
    rt_scene scene = scene_indirect;
    scene.lights = &light;
    return render_scene(&scene);
}

static rt_status render_camera(rt_vec3 position, rt_vec3 direction, float fov_y)
{
    const rt_camera camera = {position, direction, {0, 1, 0}, fov_y};
    rt_options options = {0};
    return render(&scene_indirect, &camera, options);
}

static rt_status render_options(int samples, int bounces, int threads)
{
    rt_options options = {.samples = samples, .bounces = bounces, .threads = threads};
    return render(&scene_indirect, &room_camera, options);
}

static rt_status render_size(int width, int height)
{
    rt_image image = {.width = width, .height = height, .pixels = picture};
    rt_options options = {.samples = 1};
    return rt_render(&scene_indirect, &room_camera, &options, &image);
}

/* A command that must end with this status; it finds the top folder in $TOP, the demos in
 * $DEMOS. */
static void shell(int status, const char *words, const char *command)
{
    const int actual = run(command);
    if (actual != status || !strstr(said, words))
        fail_msg("%s: status %d, expected %d; it said: %s", command, actual, status,
                 said);
}

#define CC_STRICT                                                                        \
    "${CC:-cc} -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion "       \
    "-Werror "

/* ---- 1 to 9: rays ------------------------------------------------------------------- */

static void direction_zero(void)
{
    both_miss(zero, zero);
    both_miss(rt_vec(0, 0, -5), zero);
}

static void origin_nan(void)
{
    both_miss(rt_vec(nan_, 0, 0), ahead);
    both_miss(rt_vec(0, nan_, 0), ahead);
    both_miss(rt_vec(0, 0, nan_), ahead);
}

static void direction_nan(void)
{
    both_miss(zero, rt_vec(nan_, 0, -1));
    both_miss(zero, rt_vec(0, nan_, -1));
    both_miss(zero, rt_vec(0, 0, nan_));
}

static void origin_infinite(void)
{
    both_miss(rt_vec(inf, 0, 0), rt_vec(-1, 0, 0));
    both_miss(rt_vec(0, 0, inf), ahead);
    both_miss(rt_vec(0, -inf, 0), rt_vec(0, 1, 0));
}

static void direction_infinite(void)
{
    both_miss(zero, rt_vec(0, 0, -inf));
    both_miss(zero, rt_vec(inf, 0, -1));
}

static void direction_denormal(void)
{
    both_miss(zero, rt_vec(0, 0, -1e-45f)); /* t would be 4e45 */
    both_miss(zero, rt_vec(1e-40f, 0, 0));
}

static void direction_minus_zero(void)
{
    assert_true(on_sphere(&ball, zero, rt_vec(-0.0f, -0.0f, -1)) && hit.t == 4);
    assert_true(on_box(&cube, zero, rt_vec(-0.0f, -0.0f, -1)) && hit.t == 4);
    assert_true(on_box(&cube, rt_vec(1, 1, 0), rt_vec(-0.0f, 0.0f, -1)) && hit.t == 4);
}

static void direction_of_any_length(void)
{
    const float lengths[] = {1e-3f, 1e3f};
    for (size_t i = 0; i < COUNT(lengths); i++) {
        assert_true(on_sphere(&ball, zero, rt_scale(ahead, lengths[i])));
        assert_close(hit.t * lengths[i], 4, 1e-6);
        assert_true(on_box(&cube, zero, rt_scale(ahead, lengths[i])));
        assert_close(hit.t * lengths[i], 4, 1e-6);
    }
}

static void direction_1e30(void)
{
    assert_true(on_sphere(&ball, zero, rt_vec(0, 0, -1e30f)));
    assert_vec(hit.point, 0, 0, -4, 0);
    assert_true(on_box(&cube, zero, rt_vec(0, 0, -1e30f)));
    assert_vec(hit.point, 0, 0, -4, 0);
}

/* ---- 10 to 19: spheres -------------------------------------------------------------- */

static void radius_zero(void)
{
    const rt_sphere sphere = sphere_of(0);
    assert_false(on_sphere(&sphere, zero, ahead));
    assert_int_equal(render_sphere(sphere), RT_BAD_SPHERE);
}

static void radius_negative(void)
{
    const rt_sphere sphere = sphere_of(-1);
    assert_false(on_sphere(&sphere, zero, ahead));
    assert_int_equal(render_sphere(sphere), RT_BAD_SPHERE);
}

static void radius_not_finite(void)
{
    const float bad[] = {nan_, inf, -inf};
    for (size_t i = 0; i < COUNT(bad); i++) {
        const rt_sphere sphere = sphere_of(bad[i]);
        assert_false(on_sphere(&sphere, zero, ahead));
        assert_int_equal(render_sphere(sphere), RT_BAD_SPHERE);
    }
}

static void origin_at_the_centre(void)
{
    assert_true(on_sphere(&ball, ball.center, rt_vec(0, 4, 0)));
    assert_close(hit.t, 0.25, 0);
}

static void origin_on_the_sphere(void)
{
    assert_false(on_sphere(&ball, rt_vec(0, 0, -4), rt_vec(0, 0, 1)));
    assert_true(on_sphere(&ball, rt_vec(0, 0, -4), ahead) && hit.t == 2);
}

static void tangent(void)
{
    assert_true(on_sphere(&ball, rt_vec(1, 0, 0), ahead));
    assert_close(hit.t, 5, 0);
    assert_vec(hit.normal, 1, 0, 0, 0);
}

static void just_beside(void)
{
    assert_false(on_sphere(&ball, rt_vec(nextafterf(1, 2), 0, 0), ahead));
}

static void giant_walls(void)
{
    const float radii[] = {1e5f, 1e7f};
    for (size_t i = 0; i < COUNT(radii); i++) {
        rt_sphere wall = sphere_of(radii[i]);
        wall.center = rt_vec(-radii[i] - 50, 0, 0);
        rt_rng rng = rt_rng_start(0, 0, 1);
        for (int k = 0; k < 1000; k++) {
            const rt_vec3 origin = random_point(&rng, 40.0f),
                          target = random_point(&rng, 30.0f);
            const rt_vec3 d = rt_sub(rt_vec(-51, target.y, target.z), origin);
            assert_true(on_sphere(&wall, origin, d));
            const double y = (double)hit.point.y, z = (double)hit.point.z;
            const double r = (double)radii[i], x = (double)wall.center.x;
            assert_close(hit.point.x, x + sqrt(r * r - y * y - z * z), 1e-4 * 120);
        }
    }
}

static void sphere_behind(void)
{
    assert_false(on_sphere(&ball, zero, rt_vec(0, 0, 1)));
}

static void two_in_one_place(void)
{
    const rt_sphere two[2] = {ball, ball};
    rt_scene scene = scene_sphere;
    scene.spheres = two;
    scene.sphere_count = 2;
    const rt_ray ray = ray_of(zero, ahead);
    assert_true(rt_intersect(&scene, &ray, &hit));
    assert_ptr_equal(hit.material, &two[0].material);
}

/* ---- 20 to 29: boxes ---------------------------------------------------------------- */

static void box_inverted(void)
{
    const rt_box box = box_of(rt_vec(1, -1, -6), rt_vec(-1, 1, -4));
    assert_false(on_box(&box, zero, ahead));
    rt_scene scene = scene_cube;
    scene.boxes = &box;
    assert_int_equal(render_scene(&scene), RT_BAD_BOX);
}

static void box_flat(void)
{
    const rt_box box = box_of(rt_vec(-1, 0, -6), rt_vec(1, 0, -4));
    assert_true(on_box(&box, rt_vec(0, 3, -5), rt_vec(0, -1, 0)) && hit.t == 3);
    assert_vec(hit.normal, 0, 1, 0, 0);
    assert_true(on_box(&box, zero, ahead) && hit.t == 4); /* edge on */
    assert_vec(hit.normal, 0, 0, 1, 0);
}

static void box_point(void)
{
    const rt_box box = box_of(rt_vec(0, 0, -5), rt_vec(0, 0, -5));
    assert_true(on_box(&box, zero, ahead) && hit.t == 5);
    assert_false(on_box(&box, rt_vec(0, 1e-30f, 0), ahead));
}

static void along_a_face(void)
{
    assert_true(on_box(&cube, rt_vec(0, 1, -5), rt_vec(1, 0, 0)) && hit.t == 1);
    assert_true(on_box(&cube, rt_vec(-3, 1, -5), rt_vec(1, 0, 0)) && hit.t == 2);
}

static void leaving_a_face(void)
{
    assert_false(on_box(&cube, rt_vec(0, 0, -4), rt_vec(0, 0, 1)));
    assert_false(on_box(&cube, rt_vec(0, 0, -4), rt_vec(1, 0, 0.1f)));
}

static void inside_a_box(void)
{
    assert_true(on_box(&cube, rt_vec(0, 0, -5), rt_vec(0, 2, 0)) && hit.t == 0.5f);
    assert_vec(hit.normal, 0, -1, 0, 0);
}

static void through_edge_and_corner(void)
{
    assert_true(on_box(&cube, rt_vec(2, 2, -3), rt_vec(-1, -1, -1)));
    assert_vec(hit.normal, 1, 0, 0, 0);
    assert_true(on_box(&cube, rt_vec(0, 2, -3), rt_vec(0, -1, -1)));
    assert_vec(hit.normal, 0, 1, 0, 0);
}

static void through_both_corners(void)
{
    assert_true(on_box(&cube, rt_vec(-3, -3, -8), rt_vec(1, 1, 1)));
    assert_vec(hit.point, -1, -1, -6, 0);
}

static void box_without_bounds(void)
{
    const rt_box box = box_of(rt_vec(-inf, -inf, -inf), rt_vec(inf, 0, inf));
    assert_false(on_box(&box, rt_vec(0, 5, 0), rt_vec(0, -1, 0)));
}

static void box_nan(void)
{
    const rt_box boxes[] = {box_of(rt_vec(nan_, -1, -6), cube.max),
                            box_of(cube.min, rt_vec(1, 1, nan_))};
    for (size_t i = 0; i < COUNT(boxes); i++)
        assert_false(on_box(&boxes[i], zero, ahead));
}

/* ---- 30 to 58: scenes and pictures -------------------------------------------------- */

static void camera_inside_a_shape(void)
{
    rt_scene scene =
        scene_indirect; /* black inside: the lamp is outside, and no infinity */
    const rt_camera in_ball = {{-20, -4, 8}, {0, 0, -1}, {0, 1, 0}, 60};
    const rt_camera in_cube = {{30, -10, -10}, {0, 0, -1}, {0, 1, 0}, 60};
    rt_options options = {.samples = 4, .bounces = 3};
    assert_int_equal(render(&scene, &in_ball, options), RT_OK);
    assert_vec(picture[0], 0, 0, 0, 0);
    assert_int_equal(render(&scene, &in_cube, options), RT_OK);
    assert_vec(picture[0], 0, 0, 0, 0);
    const rt_light lamp = {{-20, -4, 9}, {100, 100, 100}}; /* and lit without acne */
    scene.lights = &lamp;
    assert_int_equal(render(&scene, &in_ball, options), RT_OK);
    for (size_t i = 0; i < COUNT(picture); i++)
        assert_true(picture[i].x > 0.05f);
}

static void camera_at_the_light(void)
{
    assert_int_equal(render_camera(room_light.position, ahead, 40), RT_OK);
    assert_true(picture[5].x > 0);
}

static void bad_angles(void)
{
    const float bad[] = {180, 360, -1, nan_, inf};
    for (size_t i = 0; i < COUNT(bad); i++)
        assert_int_equal(render_camera(zero, ahead, bad[i]), RT_BAD_CAMERA);
    assert_int_equal(render_camera(zero, ahead, 0), RT_OK); /* 0 is the default: 45 */
}

static void camera_straight_up(void)
{
    assert_int_equal(render_camera(zero, rt_vec(0, 1, 0), 40), RT_OK);
    assert_true(picture[5].x > 0);
}

static void camera_without_a_direction(void)
{
    assert_int_equal(render_camera(rt_vec(0, 0, 50), zero, 40), RT_OK); /* means -z */
    assert_int_equal(render_camera(zero, rt_vec(0, nan_, 0), 40), RT_BAD_CAMERA);
}

static void light_on_a_surface(void)
{
    assert_int_equal(render_light(0, 40, 0, 1000), RT_OK);
    assert_int_equal(render_light(-20, -4, 8, 1000), RT_OK);
    assert_int_equal(render_light(-990, 0, 0, 1000), RT_OK);
}

static void light_in_the_point(void)
{
    const rt_vec3 one = {1, 1, 1}, up = {0, 1, 0};
    assert_vec(rt_lambert(one, up, zero, one), 0, 0, 0, 0);
}

static void bad_intensities(void)
{
    const float bad[] = {-1, nan_, inf};
    for (size_t i = 0; i < COUNT(bad); i++)
        assert_int_equal(render_light(0, 30, 0, bad[i]), RT_BAD_LIGHT);
}

static void no_lights(void)
{
    rt_scene scene = scene_indirect;
    scene.light_count = 0;
    assert_int_equal(render_scene(&scene), RT_OK);
    assert_vec(picture[5], 0, 0, 0, 0);
}

static void empty_scene(void)
{
    rt_scene scene = {0};
    scene.background = rt_vec(0.5f, 0.25f, 1);
    assert_int_equal(render_scene(&scene), RT_OK);
    assert_vec(picture[5], 0.5, 0.25, 1, 0);
}

static void bad_albedos(void)
{
    const float bad[] = {1.001f, -0.001f, nan_};
    for (size_t i = 0; i < COUNT(bad); i++) {
        rt_sphere sphere = ball;
        sphere.material.albedo.y = bad[i];
        assert_int_equal(render_sphere(sphere), RT_BAD_SPHERE);
    }
}

static void facing_mirrors(void)
{
    const rt_box mirrors[2] = {{{-9, -1, -9}, {9, 0, 9}, {{1, 1, 1}, true}},
                               {{-9, 4, -9}, {9, 5, 9}, {{1, 1, 1}, true}}};
    rt_scene scene = {0};
    scene.boxes = mirrors;
    scene.box_count = 2;
    const rt_ray ray = ray_of(rt_vec(0, 2, 0), rt_vec(0, 1, 0));
    rt_rng rng = rt_rng_start(0, 0, 0);
    rt_radiance(&scene, &ray, 1000000, &rng);
    assert_int_equal(rng.rays, 1000001);
}

static void bounces_zero(void)
{
    assert_int_equal(render_options(1, 0, 0), RT_OK);
}

static void bounces_negative(void)
{
    assert_int_equal(render_options(1, -1, 0), RT_BAD_BOUNCES);
}

static void bounces_a_million(void)
{
    assert_int_equal(render_options(1, 1000000, 0), RT_OK);
}

static void samples_zero_or_negative(void)
{
    rt_image image = {.width = 4, .height = 3, .pixels = picture};
    assert_int_equal(rt_render(&scene_sphere, &room_camera, NULL, &image), RT_OK);
    assert_int_equal(image.samples, 16); /* 0 is the default */
    assert_int_equal(render_options(-1, 0, 0), RT_BAD_SAMPLES);
    expect(2, "--samples: '0'", "demo01 --samples 0");
}

static void samples_1e9_and_ctrl_c(void)
{
    assert_int_equal(
        run_and_signal("INT",
                       "demo07 100 80 --samples 1000000000 --no-window --out a.png"),
        130);
    assert_non_null(strstr(said, "(interrupted at "));
    assert_true(exists("a.png"));
}

static void size_zero(void)
{
    assert_int_equal(render_size(0, 3), RT_BAD_SIZE);
    assert_int_equal(render_size(4, 0), RT_BAD_SIZE);
}

static void size_negative(void)
{
    assert_int_equal(render_size(-4, 3), RT_BAD_SIZE);
    expect(2, "WIDTH: '-4'", "demo01 -4 3");
}

static void size_too_large(void)
{
    assert_int_equal(render_size(65536, 65536), RT_BAD_SIZE);
    assert_int_equal(render_size(INT_MAX, 2), RT_BAD_SIZE);
    expect(2, "65536 x 65536 is too large", "demo01 65536 65536");
}

static void no_memory(void)
{
    const char *command = "ulimit -v 600000; \"$DEMOS\"/demo01 8000 8000 --threads 1 "
                          "--no-window --out m.png";
    run(command);
    if (strstr(said, "AddressSanitizer")) {
        print_message("note: no memory limit under AddressSanitizer: not tested there\n");
        return;
    }
    shell(1, "not enough memory for 8000 x 8000 pixels", command);
    assert_false(exists("m.png"));
}

static void one_pixel(void)
{
    assert_int_equal(render_size(1, 1), RT_OK);
    assert_int_equal(render_size(1, 12), RT_OK);
    assert_int_equal(render_size(12, 1), RT_OK);
}

static void ten_thousand_objects(void)
{
    static rt_sphere many[10000];
    rt_rng rng = rt_rng_start(0, 0, 2);
    for (size_t i = 0; i < COUNT(many); i++) {
        many[i] = sphere_of(0.5f);
        many[i].center = random_point(&rng, 50.0f);
    }
    rt_scene scene = scene_walls;
    scene.spheres = many;
    scene.sphere_count = (int)COUNT(many);
    assert_int_equal(render_scene(&scene), RT_OK);
}

static void null_pointers(void)
{
    rt_image image = {.width = 4, .height = 3};
    assert_int_equal(rt_render(NULL, &room_camera, NULL, &image), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene_sphere, NULL, NULL, &image), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene_sphere, &room_camera, NULL, NULL), RT_BAD_POINTER);
    assert_int_equal(rt_render(&scene_sphere, &room_camera, NULL, &image),
                     RT_BAD_POINTER);
    assert_int_equal(rt_check_scene(NULL, NULL), RT_BAD_POINTER);
}

static void free_twice(void)
{
    rt_bvh bvh;
    rt_free_bvh(NULL);
    assert_int_equal(rt_build_bvh(&scene_indirect, &bvh), RT_OK);
    rt_free_bvh(&bvh);
    assert_null(bvh.nodes);
    rt_free_bvh(&bvh);
}

static void two_renders_at_once(void)
{
    static rt_vec3 pixels[3][40 * 30];
    rt_status status[3];
    rt_options options = {.samples = 3, .bounces = 3, .threads = 2};
#ifdef _OPENMP
#pragma omp parallel for num_threads(3)
#endif
    for (int i = 0; i < 3; i++) {
        rt_image image = {.width = 40, .height = 30, .pixels = pixels[i]};
        status[i] = rt_render(&scene_indirect, &room_camera, &options, &image);
    }
    for (int i = 0; i < 3; i++) {
        assert_int_equal(status[i], RT_OK);
        assert_memory_equal(pixels[i], pixels[0], sizeof pixels[0]);
    }
}

static void french_locale(void)
{
    shell(1, "",
          "LC_ALL=fr_FR.UTF-8 \"$DEMOS\"/demo01 20 20 --error 0.5 --no-window --out "
          "l.png | "
          "grep '[0-9],[0-9]'");
    assert_true(exists("l.png"));
}

static void bad_pixels(void)
{
    assert_int_equal(rt_encode(nan_, 2.2), 0);
    assert_int_equal(rt_encode(inf, 2.2), 255);
    assert_int_equal(rt_encode(-1, 2.2), 0);
}

static void bad_gammas(void)
{
    assert_int_equal(rt_encode(0.5f, 0), 186);
    assert_int_equal(rt_encode(0.5f, -1), 186);
    assert_int_equal(rt_encode(0.5f, (double)nan_), 186);
}

/* ---- 59 to 66: files ---------------------------------------------------------------- */

static void unwritable_folder(void)
{
    expect(1, "cannot write '/proc/a.png'", "demo01 9 9 --no-window --out /proc/a.png");
    expect(1, "cannot write 'none/a.png'", "demo01 9 9 --no-window --out none/a.png");
}

static void folder_as_file(void)
{
    assert_true(mkdir("d.png", 0777) == 0);
    expect(1, "cannot write 'd.png': Is a directory",
           "demo01 9 9 --no-window --out d.png");
    shell(1, "cannot write 'e.png': Is a directory; the picture is in '",
          "(sleep 0.3; mkdir e.png) & \"$DEMOS\"/demo01 64 48 --time 1 --no-window "
          "--out e.png; status=$?; wait; exit $status");
    shell(0, "PNG", "head -c 4 .rt-1.part; rm .rt-1.part");
}

static void full_device(void)
{
    if (!exists("/dev/full")) {
        print_message("note: no /dev/full here: a full disk is not tested\n");
        return;
    }
    assert_int_equal(symlink("/dev/full", "f.png"), 0);
    expect(1, "cannot write 'f.png': No space", "demo01 9 9 --no-window --out f.png");
}

static void full_half_way(void)
{
    write_text("h.pfm", "precious");
    shell(1, "cannot write 'h.pfm': File too large",
          "trap '' XFSZ; ulimit -f 8; \"$DEMOS\"/demo01 99 99 --no-window --out h.pfm");
    shell(0, "precious", "cat h.pfm; ls -A .rt-* 2>/dev/null; true");
    assert_null(strstr(said, ".rt-"));
}

static void odd_file_names(void)
{
    static char long_name[6000] = "demo01 9 9 --no-window --out ";
    expect(2, "--out: ''", "demo01 9 9 --out ''");
    memset(long_name + strlen(long_name), 'n', 5000);
    strcat(long_name, ".png");
    expect(1, "File name too long", long_name);
    expect(0, "wrote a b.png", "demo01 9 9 --no-window --out 'a b.png'");
    expect(0, "wrote -a.png", "demo01 9 9 --no-window --out -a.png");
}

static void unknown_ending(void)
{
    expect(2, "'a.jpg' does not end in .png or .pfm", "demo01 9 9 --out a.jpg");
    assert_false(exists("a.jpg"));
}

static void closed_pipe(void)
{
    shell(0, "9 x 9", "\"$DEMOS\"/demo01 9 9 --no-window --out p.png | head -n 1");
    assert_true(exists("p.png"));
}

static void file_kept_on_failure(void)
{
    write_text("k.png", "precious");
    expect(2, "--samples", "demo01 9 9 --no-window --out k.png --samples x");
    shell(0, "precious", "cat k.png");
}

/* ---- 67 to 80: programs ------------------------------------------------------------- */

static void no_argument_and_help(void)
{
    expect(0, "640 x 480", "demo01");
    expect(0, "--samples", "demo01 --help");
    expect(0, "--samples", "demo01 -h");
}

static void unknown_option(void)
{
    expect(2, "unknown option '--colour'", "demo01 --colour");
}

static void bad_numbers(void)
{
    const char *const bad[] = {
        "abc", "12x", "1e99", "''", "-5", "' 5'", "99999999999999999999"};
    for (size_t i = 0; i < COUNT(bad); i++) {
        char arguments[100];
        snprintf(arguments, sizeof arguments, "demo01 --samples %s", bad[i]);
        expect(2, "is not a whole number", arguments);
    }
    const char *const not_above_zero[] = {"0", "-1", "nan", "inf", "1e99", "''", "x"};
    for (size_t i = 0; i < COUNT(not_above_zero); i++) {
        char arguments[100];
        snprintf(arguments, sizeof arguments, "demo01 --error %s", not_above_zero[i]);
        expect(2, "the wanted error must be a decimal number above 0", arguments);
        snprintf(arguments, sizeof arguments, "demo01 --time %s", not_above_zero[i]);
        expect(2, "the time in seconds must be a decimal number above 0", arguments);
    }
}

static void option_without_value(void)
{
    expect(2, "--seed: a number is missing", "demo01 --seed");
    expect(2, "--error: a number is missing", "demo01 --error");
    expect(2, "--sampler: a name is missing", "demo01 --sampler");
}

static void odd_omp_num_threads(void)
{
    shell(0, "wrote", "OMP_NUM_THREADS=0 \"$DEMOS\"/demo01 9 9 --no-window --out o.png");
    shell(0, "wrote",
          "OMP_NUM_THREADS=1000 \"$DEMOS\"/demo01 9 9 --no-window --out o.png");
}

static void no_display(void)
{
    expect(0, "no window", "demo01 9 9 --out n.png");
    assert_true(exists("n.png"));
}

static void window_closed_while_rendering(void)
{
    if (run("command -v Xvfb && command -v xdotool") != 0) {
        print_message(
            "note: no Xvfb and xdotool here: closing the window is not tested\n");
        return;
    }
    /* the X server starts while others use it, so keys may be lost: three tries */
    for (int i = 0; i < 3; i++) {
        if (run("until_ok() { for i in $(seq 100); do \"$@\" >/dev/null 2>&1 && return; "
                "sleep 0.05; done; }; "
                "Xvfb :96 -noreset -screen 0 800x600x24 >/dev/null 2>&1 & server=$!; "
                "export DISPLAY=:96 ASAN_OPTIONS=detect_leaks=0; "
                "until_ok xdotool getdisplaygeometry; "
                "\"$DEMOS\"/demo07 --samples 100000 --out x.png & demo=$!; "
                "until_ok xdotool search --name Indirect; "
                "for i in $(seq 30); do sleep 0.1; kill -0 $demo 2>/dev/null || break; "
                "xdotool search --name Indirect windowfocus key q 2>/dev/null; done; "
                "kill -KILL $demo 2>/dev/null; wait $demo; status=$?; "
                "kill $server; wait $server; exit $status") == 0)
            break;
        print_message("no key arrived, try %d\n", i + 1);
    }
    assert_non_null(strstr(said, "before the end"));
    assert_false(exists("x.png"));
}

static void interrupted_by_a_signal(void)
{
    assert_int_equal(
        run_and_signal("TERM", "demo07 100 80 --samples 1000000 --no-window --out s.png"),
        130);
    assert_non_null(strstr(said, "(interrupted at "));
    shell(2, "", "ls .rt-*");
    assert_true(exists("s.png"));
}

static void without_openmp(void)
{
    shell(0, "",
          "cd \"$TOP\" && ${CC:-cc} -O1 -std=c99 -ffp-contract=off "
          "-DDEMO='\"../demos/demo07_monte_carlo.c\"' -o $OLDPWD/hash tests/hash.c -lm");
    shell(0, "", "./hash | grep -qxf - \"$TOP\"/tests/references/hashes.txt");
}

static void strict_c99(void)
{
    shell(0, "",
          "cd \"$TOP\" && " CC_STRICT "-std=c99 -fsyntax-only tests/compile/two_?.c");
}

static void fast_math(void)
{
    shell(1, "fast-math",
          "cd \"$TOP\" && ${CC:-cc} -ffast-math -fsyntax-only tests/compile/late.c");
}

static void macros_of_others(void)
{
    shell(0, "",
          "cd \"$TOP\" && " CC_STRICT "-std=c99 -fsyntax-only tests/compile/private.c");
}

static void thirty_two_bits(void)
{
    if (run("cd \"$TOP\" && ${CC:-cc} -m32 -O1 -std=c99 "
            "-DDEMO='\"../demos/demo07_monte_carlo.c\"' "
            "-o $OLDPWD/hash32 tests/hash.c -lm") != 0) {
        print_message("note: no -m32 here: 32 bits are not tested\n");
        return;
    }
    shell(0, "demo07", "./hash32");
}

static void small_stacks(void)
{
    shell(0, "demo07", "ulimit -s 512; OMP_STACKSIZE=512k ./hash");
    shell(0, "wrote",
          "ulimit -s 512; OMP_STACKSIZE=512k \"$DEMOS\"/demo07 40 30 --samples 1 "
          "--threads 4 --no-window --out t.png");
}

/* ---- 81 to 100: part two ------------------------------------------------------------ */

/* A ball and a cube, with a surface each, a lamp, a light, a sky or not. Packets and
 * single rays must make the same picture, of moderate numbers. */
static rt_sphere two_ball;
static rt_box two_cube;
static rt_surface two_surfaces[4];
static rt_lamp two_lamps[2];
static rt_lens two_lens;
static rt_camera two_camera;
static rt_scene two;

static void part_two(void)
{
    static const rt_light light = {{3, 4, -2}, {50, 50, 50}};
    const rt_lamp round = {.center = {-2, 3, -4}, .radius = 0.5f, .intensity = {9, 9, 9}};
    const rt_lamp flat = {
        .center = {2, 3, -5}, .u = {1, 0, 0}, .v = {0, 0, 1}, .intensity = {9, 9, 9}};
    const rt_box floor = {{-20, -2, -20}, {20, -1, 20}, {{0.8f, 0.8f, 0.8f}, false}};
    memset(two_surfaces, 0, sizeof two_surfaces);
    memset(&two_lens, 0, sizeof two_lens);
    memset(&two_camera, 0, sizeof two_camera);
    memset(&two, 0, sizeof two);
    two_ball = ball;
    two_ball.material.albedo = rt_vec(0.9f, 0.5f, 0.2f);
    two_cube = floor;
    two_lamps[0] = round;
    two_lamps[1] = flat;
    two.spheres = &two_ball;
    two.sphere_count = 1;
    two.boxes = &two_cube;
    two.box_count = 1;
    two.lights = &light;
    two.light_count = 1;
    two.background = rt_vec(0.2f, 0.3f, 0.4f);
    two.surfaces = two_surfaces;
    two.lamps = two_lamps;
    two.lamp_count = 2;
}

static rt_status render_two(void)
{
    rt_vec3 alone[COUNT(picture)];
    rt_options options = {.samples = 16, .bounces = 6, .lens = two_lens, .lanes = 1};
    const rt_status status = render(&two, &two_camera, options);
    memcpy(alone, picture, sizeof alone);
    options.lanes = 0;
    assert_int_equal(render(&two, &two_camera, options), status);
    if (status != RT_OK)
        return status;
    assert_memory_equal(alone, picture, sizeof alone);
    for (size_t i = 0; i < COUNT(picture); i++)
        assert_true(picture[i].x >= 0 && picture[i].x <= FLT_MAX && picture[i].y >= 0 &&
                    picture[i].y <= FLT_MAX && picture[i].z >= 0 &&
                    picture[i].z <= FLT_MAX);
    return status;
}

/* In this place of the scene each of the numbers is refused, and the index says where. */
static void refused(float *number, const float *bad, size_t count, rt_status expected,
                    int where)
{
    const float good = *number;
    assert_int_equal(rt_check_scene(&two, NULL), RT_OK);
    for (size_t i = 0; i < count; i++) {
        int index = -7;
        *number = bad[i];
        if (rt_check_scene(&two, &index) != expected || index != where)
            fail_msg("%g: %s, index %d", (double)bad[i],
                     rt_status_text(rt_check_scene(&two, &index)), index);
        assert_int_equal(render_two(), expected);
    }
    *number = good;
}

static void bad_eta(void)
{
    part_two();
    const float bad[] = {0.5f, 0.999f, 1e-30f, 4.001f, 1e30f, -1, -1.5f, nan_, inf, -inf};
    refused(&two_surfaces[0].eta, bad, COUNT(bad), RT_BAD_SURFACE, 0);
    refused(&two_surfaces[1].eta, bad, COUNT(bad), RT_BAD_SURFACE, 1);
    const float good[] = {0, -0.0f, 1, 4};
    for (size_t i = 0; i < COUNT(good); i++) {
        two_surfaces[0].eta = good[i];
        assert_int_equal(render_two(), RT_OK);
    }
}

static void bad_shininess(void)
{
    part_two();
    const float bad[] = {-1, -1e-30f, 1.001e6f, nan_, inf, -inf};
    refused(&two_surfaces[0].shininess, bad, COUNT(bad), RT_BAD_SURFACE, 0);
    refused(&two_surfaces[1].shininess, bad, COUNT(bad), RT_BAD_SURFACE, 1);
}

static void bad_absorption_and_emission(void)
{
    part_two();
    const float bad[] = {-1, -1e-30f, 1.001e15f, nan_, inf, -inf};
    rt_surface *s = two_surfaces;
    float *const numbers[] = {&s[0].absorption.x, &s[0].absorption.y, &s[0].absorption.z,
                              &s[1].absorption.z, &s[0].emission.x,   &s[0].emission.y,
                              &s[0].emission.z,   &s[1].emission.x};
    for (size_t i = 0; i < COUNT(numbers); i++)
        refused(numbers[i], bad, COUNT(bad), RT_BAD_SURFACE, i == 3 || i == 7);
}

static void lamp_without_an_area(void)
{
    const rt_vec3 sides[][2] = {{{0, 0, 0}, {0, 0, 0}},
                                {{1, 0, 0}, {0, 0, 0}},
                                {{1, 2, 3}, {1, 2, 3}},
                                {{1, 2, 3}, {-2, -4, -6}},
                                {{1e-7f, 0, 0}, {0, 1e-7f, 0}}};
    for (size_t i = 0; i < COUNT(sides); i++)
        for (int k = 0; k < 2; k++) {
            part_two();
            int index = -7;
            two_lamps[k].radius = 0;
            two_lamps[k].u = sides[i][0];
            two_lamps[k].v = sides[i][1];
            assert_int_equal(rt_check_scene(&two, &index), RT_BAD_LAMP);
            assert_int_equal(index, k);
            assert_int_equal(render_two(), RT_BAD_LAMP);
        }
}

static void bad_lamp_radius(void)
{
    part_two();
    const float bad[] = {-1, -1e-30f, 1e-30f, 1e-7f, 1.001e15f, nan_, inf, -inf};
    refused(&two_lamps[0].radius, bad, COUNT(bad), RT_BAD_LAMP, 0);
    refused(&two_lamps[1].radius, bad, COUNT(bad), RT_BAD_LAMP, 1);
    two_lamps[0].radius = 1e-6f;
    assert_int_equal(render_two(), RT_OK);
}

static void bad_lamp_numbers(void)
{
    part_two();
    const float bad[] = {1.001e15f, nan_, inf, -inf}, negative[] = {-1, -1e-30f};
    rt_lamp *l = two_lamps;
    float *const numbers[] = {&l[0].center.x, &l[1].center.y,    &l[0].center.z,
                              &l[0].u.x,      &l[1].u.y,         &l[1].v.z,
                              &l[0].v.y,      &l[0].intensity.x, &l[1].intensity.y};
    const int where[] = {0, 1, 0, 0, 1, 1, 0, 0, 1};
    for (size_t i = 0; i < COUNT(numbers); i++)
        refused(numbers[i], bad, COUNT(bad), RT_BAD_LAMP, where[i]);
    refused(&l[0].intensity.z, negative, COUNT(negative), RT_BAD_LAMP, 0);
    refused(&l[1].intensity.x, negative, COUNT(negative), RT_BAD_LAMP, 1);
}

static void no_array_of_lamps(void)
{
    part_two();
    two.lamps = NULL;
    assert_int_equal(render_two(), RT_BAD_POINTER);
    two.lamp_count = -1;
    assert_int_equal(render_two(), RT_BAD_POINTER);
    two.lamps = two_lamps;
    assert_int_equal(render_two(), RT_BAD_POINTER);
    two.lamps = NULL;
    two.lamp_count = 0;
    two.surfaces = NULL;
    assert_int_equal(render_two(), RT_OK);
}

static void bad_lens_radius(void)
{
    part_two();
    const float bad[] = {-1, -1e-30f, 1.001e15f, nan_, inf, -inf};
    for (size_t i = 0; i < 2 * COUNT(bad); i++) {
        two_lens.radius = bad[i / 2];
        two_lens.focus = i % 2 ? 5 : 0;
        assert_int_equal(render_two(), RT_BAD_LENS);
    }
}

static void bad_lens_focus(void)
{
    part_two();
    const float bad[] = {0, -1, -1e-30f, 1.001e15f, nan_, inf, -inf};
    for (size_t i = 0; i < COUNT(bad); i++) {
        two_lens.focus = bad[i];
        two_lens.radius = 1e-30f;
        assert_int_equal(render_two(), RT_BAD_LENS);
        two_lens.radius = 0; /* a pinhole has no focus */
        assert_int_equal(render_two(), RT_OK);
    }
}

static void camera_inside_glass(void)
{
    part_two();
    two_surfaces[0].eta = 1.5f;
    two_surfaces[0].absorption = rt_vec(0, 1, 1e15f);
    two_camera.position = two_ball.center;
    assert_int_equal(render_two(), RT_OK);
    assert_true(picture[5].x > 0.01f && picture[5].y < picture[5].x);
    assert_vec(picture[5], picture[5].x, picture[5].y, 0, 0);
    two_camera.position.z += two_ball.radius; /* in its surface */
    assert_int_equal(render_two(), RT_OK);
}

static void glass_in_one_place(void)
{
    part_two();
    const rt_sphere same[3] = {two_ball, two_ball, two_ball};
    const rt_surface glass[4] = {{.eta = 1.5f}, {.eta = 1.3f}, {.eta = 4}, {.eta = 0}};
    two.spheres = same;
    two.sphere_count = 3;
    two.surfaces = glass;
    assert_int_equal(render_two(), RT_OK);
    assert_true(picture[5].x > 0);
    two_lens.radius = 0.1f;
    two_lens.focus = 4;
    assert_int_equal(render_two(), RT_OK);
}

static void glass_in_glass(void)
{
    part_two();
    const rt_sphere outer = {{0, 0, -5}, 2.5f, {{0, 0, 0}, false}};
    const rt_box boxes[3] = {
        cube, two_cube, {{-1, 0, -9}, {1, 0, -2}, {{0, 0, 0}, false}}};
    const rt_surface glass[4] = {{.eta = 1.5f}, {.eta = 2.4f}, {.eta = 0}, {.eta = 1.5f}};
    two.spheres = &outer;
    two.boxes = boxes;
    two.box_count = 3;
    two.surfaces = glass;
    assert_int_equal(render_two(), RT_OK);
    assert_true(picture[5].x > 0);
    two_camera.position = rt_vec(0, 0, -5);
    assert_int_equal(render_two(), RT_OK);
}

static void lamp_in_a_wall(void)
{
    part_two();
    two.background = zero;
    two.light_count = 0;
    two_lamps[0].center = rt_vec(0, -1.5f, -5); /* in the floor's box, unseen */
    two_lamps[0].radius = 0.25f;
    two_lamps[1].center = rt_vec(0, -1.5f, -5);
    assert_int_equal(render_two(), RT_OK);
    for (size_t i = 0; i < COUNT(picture); i++)
        assert_true(rt_is_zero(picture[i]));
    two_lamps[0].center.y = two_lamps[1].center.y = -1; /* half in it; in its face */
    assert_int_equal(render_two(), RT_OK);
    two_lamps[0].center = two_ball.center; /* in the ball, of its size, and larger */
    two_lamps[0].radius = 1;
    assert_int_equal(render_two(), RT_OK);
    two_lamps[0].radius = 1.5f;
    assert_int_equal(render_two(), RT_OK);
    assert_true(picture[5].x > 0.1f);
}

static void camera_inside_a_lamp(void)
{
    part_two();
    two_lamps[0].center = zero;
    const float l = rt_lamp_radiance(&two_lamps[0]).x;
    assert_int_equal(render_two(), RT_OK);
    for (size_t i = 0; i < COUNT(picture); i++)
        assert_vec(picture[i], l, l, l, 1e-5 * (double)l);
    two_lamps[1].center = zero; /* in the plane of the other */
    two_lamps[0].center = rt_vec(9, 9, 9);
    assert_int_equal(render_two(), RT_OK);
}

static void lamp_around_all(void)
{
    part_two();
    two_lamps[0].center = zero;
    two_lamps[0].radius = 1000;
    two_lamps[0].intensity = rt_vec(3.14159265e6f, 0, 0);
    two_surfaces[0].shininess = 50;
    assert_int_equal(render_two(), RT_OK);
    assert_true(picture[0].x > 0.5f && picture[0].x < 3);
    two_lamps[1] = two_lamps[0]; /* two in one place: either */
    assert_int_equal(render_two(), RT_OK);
}

static rt_vec3 odd_numbers(const void *data, rt_vec3 a, rt_vec3 b)
{
    (void)a;
    (void)b;
    return *(const rt_vec3 *)data;
}

static rt_vec3 odd_sky(const void *data, rt_vec3 direction)
{
    (void)direction;
    return *(const rt_vec3 *)data;
}

static const rt_vec3 odd[] = {{NAN, NAN, NAN},
                              {-1, -1e30f, -INFINITY},
                              {1e30f, INFINITY, 1e38f},
                              {NAN, -1, INFINITY},
                              {1e-40f, -1e-40f, 1.0001f}};

static void odd_patterns(void)
{
    for (size_t i = 0; i < COUNT(odd); i++)
        for (int k = 0; k < 6; k++) {
            part_two();
            for (int n = 0; n < 2; n++) {
                two_surfaces[n].pattern = odd_numbers;
                two_surfaces[n].pattern_data = &odd[i];
                two_surfaces[n].shininess = k / 2 == 0 ? 0 : k / 2 == 1 ? 10 : 1e6f;
            }
            two_ball.material.mirror = two_cube.material.mirror = k % 2 != 0;
            assert_int_equal(render_two(), RT_OK);
        }
}

static void odd_skies(void)
{
    for (size_t i = 0; i < COUNT(odd); i++) {
        part_two();
        two.sky = odd_sky;
        two.sky_data = &odd[i];
        two_surfaces[0].eta = 1.5f;
        assert_int_equal(render_two(), RT_OK);
        for (size_t k = 0; k < COUNT(picture); k++)
            assert_true(picture[k].x <= 1.001e15f && picture[k].y <= 1.001e15f);
        /* no table and no lamps: the sky alone */
        two.surfaces = NULL;
        two.lamp_count = 0;
        assert_int_equal(render_two(), RT_OK);
    }
}

static void lens_far_off(void)
{
    const float sizes[] = {1e15f, 1e8f, 1, 1e-30f, 1e-45f};
    for (int i = 0; i < 25; i++) {
        part_two();
        two_lens.radius = sizes[i % 5];
        two_lens.focus = sizes[i / 5];
        assert_int_equal(render_two(), RT_OK);
        two_camera.position = rt_vec(1e15f, -1e15f, 1e15f);
        two_camera.direction = rt_vec(-1, 1, -1);
        two_camera.fov_y = i % 2 ? 179.99f : 1e-20f;
        assert_int_equal(render_two(), RT_OK);
    }
}

static void surfaces_at_their_limits(void)
{
    const rt_surface limits[] = {
        {.eta = 4, .absorption = {1e15f, 1e-30f, 0}},
        {.eta = 1, .shininess = 1e6f, .absorption = {1e-40f, 1, 0}},
        {.shininess = 1e6f},
        {.shininess = 1e-40f},
        {.emission = {1e15f, 1e-40f, 0}},
        {.shininess = 1e6f, .emission = {1e15f, 1e15f, 1e15f}},
    };
    for (size_t i = 0; i < 2 * COUNT(limits); i++) {
        part_two();
        two_surfaces[0] = limits[i / 2];
        two_surfaces[1] = limits[(i / 2 + 1) % COUNT(limits)];
        two_ball.material.mirror = i % 2 != 0;
        two_lamps[0].intensity = rt_vec(1e15f, 1e15f, 1e15f);
        two_lamps[0].radius = i % 4 < 2 ? 1e-6f : 0.5f;
        assert_int_equal(render_two(), RT_OK);
    }
}

static void part_two_of_nothing(void)
{
    part_two();
    two.sphere_count = two.box_count = two.light_count = 0;
    assert_int_equal(render_two(), RT_OK);
    two.lamp_count = 0;
    assert_int_equal(render_two(), RT_OK);
    assert_vec(picture[5], two.background.x, two.background.y, two.background.z, 1e-6);
    two.spheres = NULL;
    two.boxes = NULL;
    two.lights = NULL;
    two.lamps = NULL;
    two.sky = odd_sky;
    two.sky_data = &ahead;
    assert_int_equal(render_two(), RT_OK);
    assert_vec(picture[5], 0, 0, 0, 0);
}

/* ---- 101 to 110: meshes and shapes of one's own (each number: 25_triangles, 26_own_shapes) - */

static rt_vec3 corners[4];
static int faces[12];
static rt_mesh two_mesh;
static rt_custom_shape two_shape;
static float two_data;

static bool own_disc(const void *data, const rt_ray *ray, float t_max, rt_hit *hit_)
{
    const float t = ray->direction.z == 0 ? 0 : (-3 - ray->origin.z) / ray->direction.z;
    (void)data;
    hit_->t = t;
    hit_->point = rt_at(ray, t);
    hit_->normal = rt_vec(0, 0, 1);
    return t > 0 && t < t_max && rt_length(rt_sub(hit_->point, rt_vec(0, 0, -3))) < 1;
}

/* The scene of part two, with a tetrahedron around its ball and a disc in front. */
static void with_mesh(void)
{
    const rt_vec3 at[4] = {{3, 3, -2}, {3, -3, -8}, {-3, 3, -8}, {-3, -3, -2}};
    const int tetrahedron[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    part_two();
    memcpy(corners, at, sizeof corners);
    memcpy(faces, tetrahedron, sizeof faces);
    const rt_mesh mesh = {corners, faces, 4, 4, {{0.5f, 0.6f, 0.7f}, false}};
    const rt_custom_shape shape = {
        {-1, -1, -3}, {1, 1, -3}, {{1, 1, 1}, false}, own_disc, &two_data};
    two_mesh = mesh;
    two_shape = shape;
    two.meshes = &two_mesh;
    two.mesh_count = 1;
    two.custom_shapes = &two_shape;
    two.custom_shape_count = 1;
    assert_int_equal(render_two(), RT_OK);
}

static void index_out_of_range(void)
{
    const int bad[] = {-1, 4, INT_MAX, INT_MIN};
    with_mesh();
    for (size_t i = 0; i < COUNT(bad); i++) {
        faces[11] = bad[i];
        assert_int_equal(rt_check_scene(&two, NULL), RT_BAD_MESH);
        assert_int_equal(render_two(), RT_BAD_MESH);
    }
}

static void bad_positions(void)
{
    const float bad[] = {nan_, inf, -inf, 1e30f, -1.001e15f};
    with_mesh();
    refused(&corners[3].z, bad, COUNT(bad), RT_BAD_MESH, 0);
}

static void no_arrays_of_a_mesh(void)
{
    with_mesh();
    two_mesh.positions = NULL;
    assert_int_equal(render_two(), RT_BAD_MESH);
    with_mesh();
    two_mesh.indices = NULL;
    assert_int_equal(render_two(), RT_BAD_MESH);
    with_mesh();
    two_mesh.triangle_count = -1;
    assert_int_equal(render_two(), RT_BAD_MESH);
    with_mesh();
    two_mesh.position_count = -1;
    assert_int_equal(render_two(), RT_BAD_MESH);
    with_mesh();
    two.mesh_count = -1;
    assert_int_equal(render_two(), RT_BAD_POINTER);
    two.mesh_count = 1;
    two.meshes = NULL;
    assert_int_equal(render_two(), RT_BAD_POINTER);
    with_mesh();
    two.custom_shapes = NULL;
    assert_int_equal(render_two(), RT_BAD_POINTER);
}

static void mesh_of_nothing(void)
{
    rt_vec3 without[COUNT(picture)];
    with_mesh();
    two.mesh_count = 0;
    two.surfaces = NULL; /* the disc has another number there */
    assert_int_equal(render_two(), RT_OK);
    memcpy(without, picture, sizeof without);
    two.mesh_count = 1;
    two_mesh.triangle_count = 0;
    assert_int_equal(render_two(), RT_OK);
    assert_memory_equal(picture, without, sizeof without);
    two_mesh.triangle_count = 4; /* all of them one point, or a line */
    for (int i = 0; i < 12; i++)
        faces[i] = i % 3 == 2;
    assert_int_equal(render_two(), RT_OK);
    assert_memory_equal(picture, without, sizeof without);
}

static void mesh_of_1e15(void)
{
    const float sizes[] = {1e14f, 3e14f, 1e9f, 1e-20f, 1e-38f};
    for (size_t i = 0; i < COUNT(sizes); i++) {
        with_mesh();
        for (int k = 0; k < 4; k++)
            corners[k] = rt_scale(corners[k], sizes[i] / 3);
        assert_int_equal(render_two(), RT_OK);
        two_surfaces[2].eta = 1.5f;
        assert_int_equal(render_two(), RT_OK);
    }
}

static void one_triangle_a_hundred_times(void)
{
    static int copies[300];
    with_mesh();
    for (int i = 0; i < 300; i++)
        copies[i] = faces[i % 3];
    two_mesh.indices = copies;
    two_mesh.triangle_count = 100;
    assert_int_equal(render_two(), RT_OK);
    two_surfaces[2].eta = 1.5f;
    assert_int_equal(render_two(), RT_OK);
    const rt_ray ray = ray_of(rt_vec(5, 0, -6.5f), rt_vec(-1, 0, 0));
    two.sphere_count = two.box_count = 0;
    hit = untouched;
    assert_true(rt_intersect(&two, &ray, &hit));
    assert_int_equal(hit.part, 0);
}

static void open_mesh_of_glass(void)
{
    with_mesh(); /* which has two sides only, and the camera may be in it */
    two_mesh.triangle_count = 2;
    two_surfaces[2].eta = 1.5f;
    two_surfaces[2].absorption = rt_vec(0, 1, 1e15f);
    assert_int_equal(render_two(), RT_OK);
    two_camera.position = rt_vec(0, 0, -5);
    assert_int_equal(render_two(), RT_OK);
    two_mesh.triangle_count = 4;
    assert_int_equal(render_two(), RT_OK);
    two_camera.position = corners[0];
    assert_int_equal(render_two(), RT_OK);
}

static void bad_custom_shape(void)
{
    const float bad[] = {nan_, inf, -inf, 1.001e15f}, inverted[] = {1.001f, 1e9f};
    with_mesh();
    refused(&two_shape.min.x, bad, COUNT(bad), RT_BAD_CUSTOM_SHAPE, 0);
    refused(&two_shape.max.z, bad, COUNT(bad), RT_BAD_CUSTOM_SHAPE, 0);
    refused(&two_shape.min.y, inverted, COUNT(inverted), RT_BAD_CUSTOM_SHAPE, 0);
    two_shape.hit = NULL;
    assert_int_equal(render_two(), RT_BAD_CUSTOM_SHAPE);
}

static rt_hit lie;

static bool lying(const void *data, const rt_ray *ray, float t_max, rt_hit *hit_)
{
    (void)data, (void)ray, (void)t_max;
    *hit_ = lie;
    return true;
}

static void answers_that_make_no_sense(void)
{
    rt_vec3 without[COUNT(picture)];
    with_mesh();
    two.custom_shape_count = 0;
    assert_int_equal(render_two(), RT_OK);
    memcpy(without, picture, sizeof without);
    two.custom_shape_count = 1;
    two_shape.hit = lying;
    for (int i = 0; i < 9; i++) {
        const rt_hit good = {.t = 1, .point = {0, 0, -3}, .normal = {0, 0, 1}};
        const float t[] = {nan_, inf, 0, -1, 1e-45f};
        lie = good;
        if (i < 5)
            lie.t = t[i];
        else if (i < 7)
            lie.normal.z = i == 5 ? 0 : nan_;
        else
            lie.point.x = i == 7 ? nan_ : 1.01f;
        assert_int_equal(render_two(), RT_OK);
        assert_memory_equal(picture, without, sizeof without);
    }
}

static bool always_yes(const void *data, const rt_ray *ray, float t_max, rt_hit *hit_)
{
    (void)data, (void)t_max;
    hit_->t = 2e-38f;
    hit_->point = rt_vec(0, 0, -3);
    hit_->normal = rt_scale(ray->direction, -1);
    return true;
}

static void always_a_hit(void)
{
    with_mesh();
    two_shape.hit = always_yes;
    for (int i = 0; i < 4; i++) {
        two_shape.material.mirror = i == 1;
        two_surfaces[3].eta = i == 2 ? 1.5f : 0;
        two_surfaces[3].shininess = i == 3 ? 9 : 0;
        for (int lanes = 0; lanes < 2; lanes++) {
            /* with a tree it is asked by rays that meet its box, without by all: two pictures */
            const rt_options options = {.samples = 16, .bounces = 6, .lanes = lanes};
            assert_int_equal(render(&two, &two_camera, options), RT_OK);
            for (size_t k = 0; k < COUNT(picture); k++)
                assert_true(picture[k].x >= 0 && picture[k].x <= FLT_MAX);
        }
    }
}

/* ---- the table ---------------------------------------------------------------------- */

static const struct row {
    const char *what;
    void (*check)(void);
} rows[] = {
    {"1 direction (0,0,0): miss", direction_zero},
    {"2 NaN in the origin: miss", origin_nan},
    {"3 NaN in the direction: miss", direction_nan},
    {"4 infinite origin: miss", origin_infinite},
    {"5 infinite direction: miss", direction_infinite},
    {"6 denormal direction: miss or finite t", direction_denormal},
    {"7 direction -0 is 0", direction_minus_zero},
    {"8 direction of length 1e-3, 1e3: same point", direction_of_any_length},
    {"9 direction of length 1e30: no overflow", direction_1e30},
    {"10 radius 0: miss, refused", radius_zero},
    {"11 radius negative: miss, refused", radius_negative},
    {"12 radius NaN or infinite: miss, refused", radius_not_finite},
    {"13 origin at the centre: t = R/|u|", origin_at_the_centre},
    {"14 origin on the sphere: far side or nothing", origin_on_the_sphere},
    {"15 tangent: one hit", tangent},
    {"16 one rounding beside: miss", just_beside},
    {"17 walls of radius 1e5, 1e7: on the surface", giant_walls},
    {"18 sphere behind: miss", sphere_behind},
    {"19 two spheres in one place: the first", two_in_one_place},
    {"20 box with min > max: miss, refused", box_inverted},
    {"21 flat box: hit from above and edge on", box_flat},
    {"22 box that is a point: hit", box_point},
    {"23 along a face: hit", along_a_face},
    {"24 leaving a face: miss", leaving_a_face},
    {"25 inside a box: the way out", inside_a_box},
    {"26 edge or corner: x before y before z", through_edge_and_corner},
    {"27 diagonal through both corners: hit", through_both_corners},
    {"28 box without bounds: miss", box_without_bounds},
    {"29 NaN in a box: miss", box_nan},
    {"30 camera inside a shape: sees its inside", camera_inside_a_shape},
    {"31 camera at the light: a picture", camera_at_the_light},
    {"32 fov 180, negative, NaN: refused; 0: 45", bad_angles},
    {"33 camera straight up: a picture", camera_straight_up},
    {"34 camera without direction: -z; NaN: refused", camera_without_a_direction},
    {"35 light on or in a surface: finite", light_on_a_surface},
    {"36 light in the very point: black", light_in_the_point},
    {"37 intensity negative, NaN, infinite: refused", bad_intensities},
    {"38 no light: black", no_lights},
    {"39 empty scene: background", empty_scene},
    {"40 albedo outside 0..1: refused", bad_albedos},
    {"41 two facing mirrors: end after the bounces", facing_mirrors},
    {"42 bounces 0: direct light", bounces_zero},
    {"43 bounces negative: refused", bounces_negative},
    {"44 bounces 1000000: ends", bounces_a_million},
    {"45 samples 0: 16; negative: refused", samples_zero_or_negative},
    {"46 samples 1e9: Ctrl-C works", samples_1e9_and_ctrl_c},
    {"47 size 0: refused", size_zero},
    {"48 size negative: refused", size_negative},
    {"49 size that overflows: refused", size_too_large},
    {"50 no memory: error, no file", no_memory},
    {"51 1 x 1, 1 x N: a picture", one_pixel},
    {"52 10000 objects: a picture", ten_thousand_objects},
    {"53 NULL: refused", null_pointers},
    {"54 rt_free_bvh of NULL, and twice: fine", free_twice},
    {"55 renders at the same time: same bytes", two_renders_at_once},
    {"56 French locale: decimal points", french_locale},
    {"57 pixel NaN, infinite, negative: 0, 255, 0", bad_pixels},
    {"58 gamma 0, negative, NaN: 2.2", bad_gammas},
    {"59 unwritable folder: error", unwritable_folder},
    {"60 folder as file: error", folder_as_file},
    {"61 full device: error", full_device},
    {"62 disk full half-way: error, old file intact", full_half_way},
    {"63 file name empty or too long: error", odd_file_names},
    {"64 unknown ending: wrong use", unknown_ending},
    {"65 closed pipe: picture saved, no hang", closed_pipe},
    {"66 existing file kept on failure", file_kept_on_failure},
    {"67 no argument: defaults; --help", no_argument_and_help},
    {"68 unknown option: wrong use", unknown_option},
    {"69 bad numbers: wrong use", bad_numbers},
    {"70 option without value: wrong use", option_without_value},
    {"71 odd OMP_NUM_THREADS: a picture", odd_omp_num_threads},
    {"72 no display: said, saved", no_display},
    {"73 window closed while rendering: ends", window_closed_while_rendering},
    {"74 signal while rendering: saved once, whole", interrupted_by_a_signal},
    {"75 without OpenMP: the same bytes", without_openmp},
    {"76 strict C99, two files: no warning", strict_c99},
    {"77 -ffast-math: refused", fast_math},
    {"78 macros min, max, near, far, PI, I: compiles", macros_of_others},
    {"79 -m32: works", thirty_two_bits},
    {"80 stacks of 512 kB: enough", small_stacks},
    {"81 eta below 1, above 4, negative, NaN: refused", bad_eta},
    {"82 shininess negative, above 1e6, NaN: refused", bad_shininess},
    {"83 absorption, emission negative, NaN: refused", bad_absorption_and_emission},
    {"84 lamp without radius and area: refused", lamp_without_an_area},
    {"85 lamp's radius negative, below 1e-6, NaN: refused", bad_lamp_radius},
    {"86 lamp's other numbers infinite, NaN: refused", bad_lamp_numbers},
    {"87 lamp_count negative, or no array: refused", no_array_of_lamps},
    {"88 lens' radius negative, NaN: refused", bad_lens_radius},
    {"89 lens' focus 0, negative, NaN: refused", bad_lens_focus},
    {"90 camera inside glass: a picture", camera_inside_glass},
    {"91 glass and glass in one place: finite", glass_in_one_place},
    {"92 glass in glass, and a flat box of it: finite", glass_in_glass},
    {"93 lamp in a wall: dark; half in it: finite", lamp_in_a_wall},
    {"94 camera inside a lamp: its radiance", camera_inside_a_lamp},
    {"95 lamp around all; two in one place: finite", lamp_around_all},
    {"96 pattern NaN, negative, 1e30: 0, 0, 1", odd_patterns},
    {"97 sky NaN, negative, 1e30: 0, 0, 1e15", odd_skies},
    {"98 lens of 1e15, and of 1e-45: finite", lens_far_off},
    {"99 surfaces at their limits: finite", surfaces_at_their_limits},
    {"100 surfaces, lamps or sky of no shapes: a picture", part_two_of_nothing},
    {"101 index of a mesh out of range: refused", index_out_of_range},
    {"102 positions NaN, infinite, 1e30: refused", bad_positions},
    {"103 mesh without arrays, counts negative: refused", no_arrays_of_a_mesh},
    {"104 mesh of no triangle, a point, a line: nothing", mesh_of_nothing},
    {"105 mesh of 1e15, and of 1e-38: finite", mesh_of_1e15},
    {"106 a triangle a hundred times: the first", one_triangle_a_hundred_times},
    {"107 open mesh of glass, camera in it: finite", open_mesh_of_glass},
    {"108 own shape: bad box, no function: refused", bad_custom_shape},
    {"109 own shape: t NaN, 0, no normal, P far: miss", answers_that_make_no_sense},
    {"110 own shape that is always hit: ends", always_a_hit},
};

static void check_row(void **state)
{
    const struct row *row = *state;
    row->check();
}

int main(void)
{
    struct CMUnitTest tests[COUNT(rows)];
    for (size_t i = 0; i < COUNT(rows); i++) {
        if (atoi(rows[i].what) != (int)i + 1)
            return fprintf(stderr, "row %d has another number\n", (int)i + 1), 1;
        tests[i] = (struct CMUnitTest){rows[i].what, check_row, NULL, NULL, NULL};
        tests[i].initial_state = (void *)(uintptr_t)&rows[i];
    }
    return _cmocka_run_group_tests("bad input", tests, COUNT(rows), set_up, tear_down);
}

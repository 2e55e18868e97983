/* The viewer: what the reader does with a picture, without a window and without a page. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "../demos/viewer.c"

#include "../demos/live.h"
#include "explained.h"

enum { W = 48, H = 36, ALL = W * H };

static double clock_says;

double demo_seconds(void)
{
    return clock_says;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return rt_radiance(&scene_indirect, &ray, view->bounces, rng);
}

static const demo the_demo = {.name = "demo07",
                              .title = "a test",
                              .pixel = pixel,
                              .live = &live_room,
                              .stage = 7,
                              .encode = demo_gamma,
                              .samples = 4,
                              .bounces = 5};

static viewer v;

static int set_up(void **state)
{
    (void)state;
    const rt_options options = {.samples = 4, .bounces = 5, .sampler = RT_RANDOM};
    clock_says = 0.0;
    return viewer_open(&v, &the_demo, W, H, &options, false) && viewer_show(&v) ? 0 : 1;
}

static int tear_down(void **state)
{
    (void)state;
    live_reset();
    viewer_close(&v);
    return 0;
}

/* All that is to be done until there is nothing to do; so many drafts were among it. */
static int settle(void)
{
    int drafts = 0;
    for (int i = 0; i < 100; i++)
        switch (viewer_next(&v, clock_says)) {
        case DRAW_A_DRAFT:
            viewer_begin_anew(&v);
            viewer_draft(&v);
            drafts++;
            break;
        case REST: clock_says = v.rests; break;
        case REFINE:
            assert_int_equal(viewer_refine(&v, NULL, NULL), RT_OK);
            v.finished = true;
            break;
        case NOTHING: return drafts;
        }
    fail();
    return drafts;
}

/* The bytes that are shown; the next call overwrites them. */
static const unsigned char *shown(void)
{
    static unsigned char bytes[2][ALL * 3];
    static int turn;
    turn = !turn;
    viewer_encode(&v, v.hold, viewer_shown(&v), 3, bytes[turn]);
    return bytes[turn];
}

static void test_the_first_picture_is_the_demos(void **state)
{
    (void)state;
    rt_vec3 pixels[ALL];
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 4, .bounces = 5, .sampler = RT_RANDOM};
    assert_int_equal(viewer_next(&v, 0.0), REFINE);
    assert_int_equal(settle(), 0);
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    assert_memory_equal(v.image.pixels, pixels, sizeof pixels);
}

static void test_parts_of_the_picture_are_the_picture(void **state)
{
    (void)state;
    rt_vec3 pixels[ALL];
    settle();
    for (int first = 0; first < ALL; first += 500) {
        rt_image part = {.width = W, .height = H, .pixels = pixels + first};
        part.first = first;
        part.count = ALL - first < 500 ? ALL - first : 500;
        assert_int_equal(viewer_add_samples(&v, false, &v.options, &part), RT_OK);
    }
    assert_memory_equal(v.image.pixels, pixels, sizeof pixels);
}

/* Where the ball is in the picture. */
static const float ball_x = 0.32f * W, ball_y = 0.62f * H;

static void test_a_press_that_trembles_is_a_click(void **state)
{
    (void)state;
    settle();
    v.slack = 2.0f;
    viewer_press(&v, ball_x, ball_y, BUTTON_MAIN);
    viewer_move(&v, ball_x + 1.0f, ball_y - 0.5f, false);
    viewer_release(&v);
    assert_true(v.inspect && v.tell && !v.changed);
    assert_int_equal(v.x, (int)ball_x);
    assert_int_equal(v.y, (int)ball_y);
    assert_int_equal(viewer_next(&v, 0.0), NOTHING);
}

static void test_a_drag_moves_the_ball_at_once_and_then_in_earnest(void **state)
{
    (void)state;
    const rt_vec3 before = room_spheres[0].center, eye = room_camera.position;
    settle();
    viewer_press(&v, ball_x, ball_y, BUTTON_MAIN);
    viewer_move(&v, ball_x + 10.0f, ball_y, false);
    assert_int_equal(viewer_next(&v, 1.0), DRAW_A_DRAFT);
    viewer_begin_anew(&v);
    viewer_draft(&v);
    assert_ptr_equal(viewer_shown(&v), &v.draft);
    assert_int_equal(viewer_next(&v, 1.1), REST);
    assert_int_equal(viewer_next(&v, 1.2), REFINE);
    viewer_release(&v);
    assert_false(v.inspect || v.tell);
    assert_true(room_spheres[0].center.x > before.x + 5.0f);
    assert_true(fabsf(room_spheres[0].center.y - before.y) < 0.01f);
    assert_true(rt_length(rt_sub(room_camera.position, eye)) == 0.0f);
    assert_ptr_equal(viewer_shown(&v), &v.draft); /* until there is a sample */
    clock_says = 2.0;
    settle();
    assert_ptr_equal(viewer_shown(&v), &v.image);
}

static void test_elsewhere_a_drag_goes_round(void **state)
{
    (void)state;
    const rt_vec3 ball = room_spheres[0].center, eye = room_camera.position;
    v.slack = 1.0f;
    viewer_press(&v, 2.0f, 2.0f, BUTTON_MAIN);
    viewer_move(&v, 4.0f, 2.0f, false);
    viewer_release(&v);
    assert_true(rt_length(rt_sub(room_spheres[0].center, ball)) == 0.0f);
    assert_true(rt_length(rt_sub(room_camera.position, eye)) > 1.0f);
    assert_true(v.changed);
}

static void test_what_is_pressed_outside_of_the_picture_is_nothing(void **state)
{
    (void)state;
    settle();
    viewer_press(&v, -3.0f, 5.0f, BUTTON_MAIN);
    viewer_move(&v, 20.0f, 5.0f, false);
    viewer_release(&v);
    assert_false(v.changed || v.inspect);
}

static void test_every_stage_has_its_picture(void **state)
{
    (void)state;
    unsigned char before[ALL * 3];
    memcpy(before, shown(), sizeof before);
    for (int stage = 6; stage >= 1; stage--) {
        viewer_key(&v, '0' + stage, false);
        assert_int_equal(settle(), 1);
        const unsigned char *now = shown();
        assert_memory_not_equal(before, now, sizeof before);
        memcpy(before, now, sizeof before);
    }
}

/* What rt_render makes of the scene, is it what is shown? */
static void shows(const rt_scene *scene, const rt_lens *lens, int stage)
{
    rt_vec3 pixels[ALL];
    rt_image image = {.width = W, .height = H, .pixels = pixels, .half = NULL};
    rt_options options = {.samples = 4, .bounces = 5, .sampler = RT_RANDOM};
    if (lens)
        options.lens = *lens;
    assert_int_equal(v.stage, stage);
    assert_int_equal(rt_render(scene, &room_camera, &options, &image), RT_OK);
    assert_memory_equal(v.image.pixels, pixels, sizeof pixels);
}

static void test_the_pictures_of_part_two(void **state)
{
    (void)state;
    settle();
    viewer_key(&v, '8', false);
    assert_int_equal(settle(), 1);
    shows(&scene_glass, NULL, 8);
    viewer_key(&v, '9', false);
    settle();
    shows(&scene_lamps, NULL, 9);
    viewer_key(&v, '0', false);
    settle();
    shows(&scene_gloss, NULL, 10);
    viewer_key(&v, '.', false);
    settle();
    shows(&scene_sky, &room_lens, 11);
    viewer_key(&v, '.', false);
    settle();
    shows(&scene_patterns, NULL, 12);
    viewer_key(&v, ',', false);
    settle();
    shows(&scene_sky, &room_lens, 11);
    viewer_set_stage(&v, 13);
    settle();
    shows(&scene_triangles, NULL, 13);
    viewer_key(&v, '.', false);
    viewer_key(&v, '.', false); /* there are no more */
    settle();
    shows(&scene_own_shape, NULL, 14);
    viewer_key(&v, '1', false);
    viewer_key(&v, ',', false);
    settle();
    assert_int_equal(v.stage, 1);
}

/* Where the ball of glass is, the lamp, and the mirror. */
static const float glass_x = 0.53f * W, glass_y = 0.77f * H, lamp_x = 0.455f * W,
                   lamp_y = 0.18f * H, mirror_x = 0.54f * W, mirror_y = 0.47f * H;

static void test_the_wheel_changes_what_it_is_over(void **state)
{
    (void)state;
    char words[200];
    const float z = room_camera.position.z;
    viewer_move(&v, lamp_x, lamp_y, false);
    viewer_wheel(&v, 1); /* a point: there is nothing to change, and the camera moves */
    assert_true(room_camera.position.z < z && room_lamp.radius == 6.0f);
    live_reset();
    viewer_set_stage(&v, 9);
    settle();
    unsigned char before[ALL * 3];
    memcpy(before, shown(), sizeof before);
    viewer_wheel(&v, 2);
    assert_true(room_camera.position.z == z);
    assert_true(fabsf(room_lamp.radius - 6.0f * 1.21f) < 1e-4f);
    assert_int_equal(settle(), 1);
    assert_memory_not_equal(before, shown(), sizeof before);
    demo_text out = text_in(words, sizeof words);
    viewer_say_stage(&v, &out);
    assert_string_equal(words, "12 lamps, the lamp, radius 7.26, ");
    viewer_wheel(&v, 100);
    assert_true(room_lamp.radius == 9.0f); /* it still fits under the ceiling */
    viewer_wheel(&v, -1000);
    assert_true(room_lamp.radius == 0.1f);
    viewer_move(&v, glass_x, glass_y, false);
    viewer_wheel(&v, -100);
    assert_true(glass_surfaces[ROOM_GLASS].eta == 1.0f &&
                pattern_surfaces[ROOM_GLASS].eta == 1.0f);
    viewer_set_stage(&v, 10);
    viewer_move(&v, mirror_x, mirror_y, false);
    viewer_wheel(&v, 1);
    assert_true(gloss_surfaces[ROOM_MIRROR].shininess > 60.0f);
    viewer_move(&v, 1, 1, false); /* a wall */
    viewer_wheel(&v, 1);
    assert_true(room_camera.position.z < z);
    viewer_key(&v, 'r', false);
    assert_true(room_lamp.radius == 6.0f && glass_surfaces[ROOM_GLASS].eta == 1.5f &&
                gloss_surfaces[ROOM_MIRROR].shininess == 60.0f);
}

static void test_exposure_is_a_factor(void **state)
{
    (void)state;
    settle();
    viewer_key(&v, 'e', false);
    viewer_key(&v, 'e', false); /* a whole stop */
    const unsigned char *bytes = shown();
    for (int i = 0; i < ALL; i++)
        assert_int_equal(bytes[3 * i], demo_gamma(2.0f * v.image.pixels[i].x));
    viewer_key(&v, 'w', false);
    viewer_key(&v, 'w', false);
    bytes = shown();
    for (int i = 0; i < ALL; i++)
        assert_int_equal(bytes[3 * i], demo_gamma(v.image.pixels[i].x));
    viewer_set_exposure(&v, 1e9f);
    assert_true(v.exposure == 20.0f);
    viewer_key(&v, 'r', false);
    assert_true(v.exposure == 0.0f);
}

/* The teapot on the floor, and on the pedestal; the pedestal. */
static const float pot_x = 0.76f * W, pot_y = 0.77f * H, pedestal_y = 0.81f * H;

/* What a drag does to the picture, it has also done to the tree: the same by a new one. */
static void test_mesh_and_pedestal_move(void **state)
{
    (void)state;
    for (int stage = 13; stage <= 14; stage++) {
        const float y = stage == 13 ? pot_y : pedestal_y;
        viewer_set_stage(&v, stage);
        settle();
        unsigned char before[ALL * 3];
        memcpy(before, shown(), sizeof before);
        const rt_vec3 foot = room_foot, base = room_cylinder.base;
        const rt_sphere ball = room_spheres[0];
        viewer_press(&v, pot_x, y, BUTTON_MAIN);
        assert_int_equal(v.thing, stage == 13 ? MESH : PEDESTAL);
        viewer_move(&v, pot_x - 6, y, true);
        viewer_release(&v);
        assert_true(room_foot.x < foot.x - 5 && room_foot.y == foot.y);
        assert_true((room_cylinder.base.x < base.x - 5) == (stage == 14));
        assert_true(rt_is_zero(rt_sub(room_spheres[0].center, ball.center)));
        settle();
        assert_memory_not_equal(before, shown(), sizeof before);
        rt_scene plain = *live_scene(stage);
        plain.bvh = NULL;
        shows(&plain, NULL, stage);
        live_reset();
        viewer_set_stage(&v, stage);
        settle();
        assert_memory_equal(before, shown(), sizeof before);
    }
}

static void test_the_wheel_on_mesh_and_pedestal(void **state)
{
    (void)state;
    viewer_set_stage(&v, 14);
    settle();
    viewer_move(&v, pot_x, 0.66f * H, false);
    viewer_wheel(&v, 1);
    assert_int_equal(v.tuned, MESH);
    assert_true(mesh_surfaces[ROOM_MESH].shininess > 500);
    const float height = room_cylinder.height;
    viewer_move(&v, pot_x, pedestal_y, false);
    viewer_wheel(&v, -1);
    assert_int_equal(v.tuned, PEDESTAL);
    assert_true(room_cylinder.height < height);
    settle(); /* and with it what stands on it */
    shows(&scene_own_shape, NULL, 14);
}

/* Paths of part two are told as they happen. */
static void test_the_path_says_what_happens(void **state)
{
    (void)state;
    static const char *const expected[] = {"refracted, in",    "refracted, out",
                                           "aimed at, weight", "by chance, weight",
                                           "by the gloss",     "by the matt body"};
    static char words[1 << 16];
    unsigned found = 0;
    viewer_set_stage(&v, 10);
    for (v.sample = 0; v.sample < 60; v.sample++)
        for (int at = 0; at < 2; at++) {
            demo_text out = text_in(words, sizeof words);
            rt_vec3 value;
            v.inspect = true;
            v.x = (int)(at ? glass_x : mirror_x);
            v.y = (int)(at ? glass_y : mirror_y);
            assert_int_equal(viewer_explain(&v, &out, &value), RT_OK);
            for (int i = 0; i < 6; i++)
                found |= strstr(words, expected[i]) ? 1u << i : 0;
        }
    assert_int_equal(found, 63);
}

/* In every stage, as its own chapter has it: with and without bounces, with both kinds of numbers,
 * in halves and not. */
static void test_what_is_told_is_the_sample_that_is_shown(void **state)
{
    (void)state;
    for (int stage = 1; stage <= VIEWER_STAGES; stage++)
        for (int sobol = 0; sobol <= 1; sobol++) {
            v.options.sampler = sobol ? RT_SOBOL : RT_RANDOM;
            viewer_set_bounces(&v, stage < 6 ? 0 : stage < 8 ? 5 : 8);
            viewer_set_stage(&v, stage);
            viewer_set_samples(&v, 1);
            settle();
            assert_int_equal(expect_stage_explained(&v), 0);
        }
}

/* Also while another picture is held, and of a demo that does something else than rt.h. */
static void test_what_is_told_of_another_picture(void **state)
{
    (void)state;
    viewer_set_samples(&v, 1);
    viewer_set_stage(&v, 5);
    v.comparison = BEFORE;
    viewer_key(&v, 'b', false);
    settle();
    memcpy(v.image.pixels, v.other.pixels, ALL * sizeof(rt_vec3));
    assert_int_equal(expect_stage_explained(&v), 0);
}

static rt_vec3 brighter_pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    return rt_add(pixel(view, x, y, rng), rt_vec(0.1f, 0, 0));
}

static void test_what_is_told_of_a_demo_with_a_mistake(void **state)
{
    (void)state;
    demo mistaken = the_demo;
    mistaken.pixel = brighter_pixel;
    v.d = &mistaken;
    viewer_set_samples(&v, 1);
    settle();
    assert_int_equal(expect_stage_explained(&v), EXPLAINED);
    v.d = &the_demo;
}

static void test_held_is_the_chapter_before(void **state)
{
    (void)state;
    unsigned char four[ALL * 3];
    viewer_key(&v, '4', false);
    settle();
    memcpy(four, shown(), sizeof four);
    viewer_key(&v, '5', false);
    settle();
    assert_memory_not_equal(four, shown(), sizeof four);
    viewer_key(&v, 'b', false);
    settle();
    assert_memory_equal(four, shown(), sizeof four);
    viewer_key_up(&v, 'b');
    settle();
    assert_memory_not_equal(four, shown(), sizeof four);
}

static void test_other_numbers(void **state)
{
    (void)state;
    settle();
    v.comparison = OTHER_NUMBERS;
    viewer_key(&v, 'b', false);
    settle();
    rt_vec3 pixels[ALL];
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options sobol = {.samples = 4, .bounces = 5, .sampler = RT_SOBOL};
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &sobol, &image), RT_OK);
    assert_memory_equal(v.other.pixels, pixels, sizeof pixels);
}

static void test_samples_and_bounces_have_limits(void **state)
{
    (void)state;
    for (int i = 0; i < 40; i++)
        viewer_key(&v, '+', false);
    assert_int_equal(v.samples, 1 << 20);
    for (int i = 0; i < 40; i++)
        viewer_key(&v, '-', false);
    assert_int_equal(v.samples, 1);
    for (int i = 0; i < 200; i++)
        viewer_key(&v, i % 2 ? ']' : 'm', false);
    assert_int_equal(v.options.bounces, RT_ALL_BOUNCES);
    for (int i = 0; i < 200; i++)
        viewer_key(&v, i % 2 ? '[' : 'n', false);
    assert_int_equal(v.options.bounces, 0);
    assert_int_equal(v.view.bounces, 0);
}

static void test_more_samples_keep_what_there_is(void **state)
{
    (void)state;
    settle();
    const uint64_t rays = v.image.rays;
    viewer_key(&v, '+', false);
    assert_int_equal(viewer_next(&v, 0.0), REFINE);
    settle();
    assert_int_equal(v.image.samples, 8);
    assert_true(v.image.rays > rays + rays / 2);
}

static void test_r_brings_everything_back(void **state)
{
    (void)state;
    unsigned char first[ALL * 3];
    settle();
    memcpy(first, shown(), sizeof first);
    static const char keys[] = "3]]lgp+zvd";
    for (const char *key = keys; *key; key++)
        viewer_key(&v, *key, false);
    for (int key = KEY_LEFT; key <= KEY_FARTHER; key++)
        viewer_key(&v, key, false);
    for (int thing = BALL; thing <= LAMP; thing++)
        viewer_nudge(&v, thing, 1, 1, false);
    settle();
    assert_memory_not_equal(first, shown(), sizeof first);
    viewer_key(&v, 'r', false);
    settle();
    assert_memory_equal(first, shown(), sizeof first);
}

static void test_the_room_can_be_taken_elsewhere(void **state)
{
    (void)state;
    unsigned char room[DEMO_STATE], moved[ALL * 3];
    viewer_nudge(&v, 0, 2, 1, false);
    for (int thing = BALL; thing <= LAMP; thing++)
        viewer_nudge(&v, thing, 1, 0.5f, true);
    settle();
    memcpy(moved, shown(), sizeof moved);
    assert_true(live_save(room) <= sizeof room);
    viewer_key(&v, 'r', false);
    settle();
    assert_memory_not_equal(moved, shown(), sizeof moved);
    live_load(room);
    viewer_key(&v, '7', false);
    settle();
    assert_memory_equal(moved, shown(), sizeof moved);
}

static void test_drafts_are_as_large_as_time_allows(void **state)
{
    (void)state;
    viewer_key(&v, '7', false);
    for (int i = 0; i < 20; i++)
        viewer_draft_took(&v, 0.1);
    viewer_draft(&v);
    assert_int_equal(v.draft.width, W / 4);
    assert_int_equal(v.draft.height, H / 4);
    for (int i = 0; i < 20; i++)
        viewer_draft_took(&v, 0.001);
    viewer_draft(&v);
    assert_int_equal(v.draft.width, W);
}

static void test_without_noise(void **state)
{
    (void)state;
    rt_vec3 pixels[ALL], half[ALL], clean[ALL];
    rt_guide guides[ALL];
    settle();
    viewer_key(&v, 'd', false);
    settle();
    const rt_image *image = viewer_shown(&v);
    assert_ptr_equal(image, &v.clean);
    rt_image same = {.width = W, .height = H, .pixels = pixels, .half = half};
    rt_image result = {.width = W, .height = H, .pixels = clean};
    const rt_options options = {.samples = 4, .bounces = 5, .sampler = RT_RANDOM};
    same.guides = guides;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &same), RT_OK);
    assert_int_equal(rt_denoise(&same, 0, &result), RT_OK);
    assert_memory_equal(image->pixels, clean, sizeof clean);
    viewer_key(&v, 'b', false); /* with its noise */
    assert_ptr_equal(viewer_shown(&v), &v.image);
    viewer_key_up(&v, 'b');
    viewer_nudge(&v, BALL, 1, 0, false);
    assert_int_equal(viewer_next(&v, clock_says), DRAW_A_DRAFT);
    viewer_begin_anew(&v);
    viewer_draft(&v); /* in motion, too */
    assert_int_equal(v.draft.samples, 2);
    assert_ptr_equal(viewer_shown(&v), &v.clean);
}

static void test_the_plan_fits(void **state)
{
    (void)state;
    static viewer_plan plan = {.width = 200, .height = 150, .letter = 9};
    char words[4000];
    for (int side = 0; side <= 1; side++)
        for (int stage = 1; stage <= VIEWER_STAGES; stage++) {
            demo_text table = text_in(words, sizeof words);
            viewer_set_stage(&v, stage);
            v.side = side == 1;
            viewer_inspect(&v, (int)ball_x, (int)ball_y);
            viewer_draw_plan(&v, &plan, &table);
            int outlines = 0;
            for (int i = 0; i < plan.line_count; i++) {
                const viewer_line *l = &plan.lines[i];
                const float ends[4] = {l->x0, l->x1, l->y0, l->y1};
                for (int k = 0; k < 4; k++)
                    assert_true(ends[k] > -0.01f &&
                                ends[k] < (k < 2 ? 200.01f : 150.01f));
                outlines += l->kind == LINE_ROOM;
            }
            assert_true(outlines > 0 && outlines < plan.line_count);
            assert_non_null(strstr(words, "the red sphere"));
            if (stage <= VIEWER_INDIRECT)
                assert_true((strstr(words, "seen") != NULL) == (stage >= 4));
        }
}

/* Every thing has its name, whole and beside the others. */
static void test_names_in_the_plan(void **state)
{
    (void)state;
    static viewer_plan plan = {.width = 320, .height = 240, .letter = 10};
    static const char *const names[] = {"camera",   "lamp",       "red sphere",
                                        "mirror",   "glass ball", "teapot",
                                        "pedestal", "back wall"};
    char words[4000];
    for (int side = 0; side <= 1; side++) {
        demo_text table = text_in(words, sizeof words);
        viewer_set_stage(&v, VIEWER_STAGES);
        v.side = side == 1;
        viewer_draw_plan(&v, &plan, &table);
        for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
            int found = 0;
            for (int k = 0; k < plan.label_count; k++)
                found += strcmp(plan.labels[k].name, names[i]) == 0;
            assert_int_equal(found, 1);
        }
        for (int i = 0; i < plan.label_count; i++) {
            const viewer_label *a = &plan.labels[i];
            const float half = 0.3f * 10 * (float)strlen(a->name);
            assert_true(a->x >= half && a->x <= 320 - half && a->y >= 5 && a->y <= 235);
            for (int k = 0; k < i; k++)
                assert_false(overlap(a, &plan.labels[k], 10));
        }
    }
}

/* What leaves the scene leaves the plan, too: its line ends at the edge. */
static void test_a_path_that_leaves_is_drawn_to_the_edge(void **state)
{
    (void)state;
    static viewer_plan plan = {.width = 200, .height = 150, .letter = 9};
    char words[4000];
    demo_text table = text_in(words, sizeof words);
    viewer_set_stage(&v, 1);
    viewer_inspect(&v, 2, 2); /* there is only the ball */
    viewer_draw_plan(&v, &plan, &table);
    int rays = 0;
    for (int i = 0; i < plan.line_count; i++)
        if (plan.lines[i].kind == LINE_CAMERA) {
            const viewer_line *l = &plan.lines[i];
            const float edge =
                fminf(fminf(l->x1, 200 - l->x1), fminf(l->y1, 150 - l->y1));
            assert_true(fabsf(edge) < 0.01f);
            rays++;
        }
    assert_int_equal(rays, 1);
    assert_non_null(strstr(words, "nothing"));
}

static void test_too_long_a_text_is_cut(void **state)
{
    (void)state;
    char words[8];
    demo_text t = text_in(words, sizeof words);
    text_add(&t, "%d", 12345);
    assert_string_equal(words, "12345");
    text_add(&t, "%s", "67890");
    assert_string_equal(words, "1234567");
    text_add(&t, "more");
    assert_string_equal(words, "1234567");
}

int main(void)
{
#define TEST(name) cmocka_unit_test_setup_teardown(name, set_up, tear_down)
    const struct CMUnitTest tests[] = {
        TEST(test_the_first_picture_is_the_demos),
        TEST(test_parts_of_the_picture_are_the_picture),
        TEST(test_a_press_that_trembles_is_a_click),
        TEST(test_a_drag_moves_the_ball_at_once_and_then_in_earnest),
        TEST(test_elsewhere_a_drag_goes_round),
        TEST(test_what_is_pressed_outside_of_the_picture_is_nothing),
        TEST(test_every_stage_has_its_picture),
        TEST(test_the_pictures_of_part_two),
        TEST(test_the_wheel_changes_what_it_is_over),
        TEST(test_mesh_and_pedestal_move),
        TEST(test_the_wheel_on_mesh_and_pedestal),
        TEST(test_exposure_is_a_factor),
        TEST(test_the_path_says_what_happens),
        TEST(test_what_is_told_is_the_sample_that_is_shown),
        TEST(test_what_is_told_of_another_picture),
        TEST(test_what_is_told_of_a_demo_with_a_mistake),
        TEST(test_held_is_the_chapter_before),
        TEST(test_other_numbers),
        TEST(test_samples_and_bounces_have_limits),
        TEST(test_more_samples_keep_what_there_is),
        TEST(test_r_brings_everything_back),
        TEST(test_the_room_can_be_taken_elsewhere),
        TEST(test_drafts_are_as_large_as_time_allows),
        TEST(test_without_noise),
        TEST(test_the_plan_fits),
        TEST(test_names_in_the_plan),
        TEST(test_a_path_that_leaves_is_drawn_to_the_edge),
        TEST(test_too_long_a_text_is_cut),
    };
    return cmocka_run_group_tests_name("19 viewer", tests, NULL, NULL);
}

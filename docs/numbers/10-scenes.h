/* Twelve scenes to measure chapter 10 with. Its constants were chosen with the first
 * four. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>
#include <string.h>

typedef struct test_scene {
    const char *name;
    rt_scene scene;
    rt_camera camera;
    int bounces;
    rt_sphere spheres[400];
    rt_box boxes[100];
    rt_light lights[2];
} test_scene;

enum { SCENES = 12, CHOSEN_WITH = 4 };

static rt_material matt(float r, float g, float b)
{
    return (rt_material){{r, g, b}, false};
}

static rt_material mirror(float r, float g, float b)
{
    return (rt_material){{r, g, b}, true};
}

static void ball(test_scene *s, float x, float y, float z, float radius, rt_material m)
{
    s->spheres[s->scene.sphere_count++] = (rt_sphere){{x, y, z}, radius, m};
}

static void box(test_scene *s, rt_vec3 min, rt_vec3 max, rt_material m)
{
    s->boxes[s->scene.box_count++] = (rt_box){min, max, m};
}

static void lamp(test_scene *s, float x, float y, float z, float r, float g, float b)
{
    s->lights[s->scene.light_count++] = (rt_light){{x, y, z}, {r, g, b}};
}

/* The walls of the room, darker by a factor; and its lamp. */
static void walls(test_scene *s, float factor)
{
    for (int i = 1; i <= 5; i++) {
        s->spheres[s->scene.sphere_count] = room_spheres[i];
        rt_material *m = &s->spheres[s->scene.sphere_count++].material;
        m->albedo = rt_scale(m->albedo, factor);
    }
}

static void the_lamp(test_scene *s)
{
    s->lights[s->scene.light_count++] = room_dim_light;
}

static float any(uint32_t *state)
{
    return (float)(rt_hash((*state)++) >> 8) / 16777216.0f;
}

static rt_material any_matt(uint32_t *state, float low, float high)
{
    const float r = any(state), g = any(state), b = any(state);
    return matt(low + (high - low) * r, low + (high - low) * g, low + (high - low) * b);
}

static void room_itself(test_scene *s)
{
    s->scene = scene_indirect;
}

static void furnace(test_scene *s)
{
    s->scene.background = rt_vec(1, 1, 1);
    ball(s, 0, 0, -5, 2, matt(0.8f, 0.8f, 0.8f));
    ball(s, 3, -0.5f, -6, 1.5f, matt(0.8f, 0.5f, 0.3f));
    ball(s, -3, -0.5f, -4, 1.5f, matt(0.5f, 0.8f, 0.8f));
    ball(s, 0, -102, -5, 100, matt(0.7f, 0.7f, 0.7f));
    s->camera = (rt_camera){{0, 0, 3}, {0, 0, -1}, {0, 1, 0}, 50};
}

static void dark(test_scene *s) /* a roof over nearly all of it */
{
    walls(s, 0.6f);
    ball(s, -20, -4.24f, 8, 16, matt(0.51f, 0.06f, 0.05f));
    box(s, rt_vec(-30, 20, -10), rt_vec(30, 21, 50), matt(0.5f, 0.5f, 0.5f));
    box(s, rt_vec(5, -20, -30), rt_vec(20, 5, -15), matt(0.3f, 0.3f, 0.8f));
    lamp(s, 0, 30, 19, 6000, 6000, 6000);
}

static void fine_detail(test_scene *s) /* boards and marbles */
{
    uint32_t state = 3000;
    walls(s, 1);
    for (int i = 0; i < 24; i++) {
        const float x = -46 + 4 * (float)i, z = -20 + 0.5f * (float)i;
        box(s, rt_vec(x, -20, z), rt_vec(x + 1, 25, z + 1), any_matt(&state, 0.2f, 0.8f));
    }
    for (int i = 0; i < 30; i++) {
        const float x = any(&state), z = any(&state);
        ball(s, -40 + 80 * x, -18, 10 + 40 * z, 1.8f, any_matt(&state, 0, 1));
    }
    the_lamp(s);
}

static void mirrors(test_scene *s)
{
    walls(s, 1);
    ball(s, -20, -4.24f, 8, 16, mirror(0.85f, 0.1f, 0.08f));
    ball(s, 6, -2.77f, -38, 18, mirror(1, 1, 1));
    ball(s, 30, -12, 20, 8, mirror(0.9f, 0.7f, 0.3f));
    ball(s, 10, -14, 30, 6, matt(0.8f, 0.3f, 0.2f));
    box(s, rt_vec(-49.9f, -15, -40), rt_vec(-49, 30, 30), mirror(0.9f, 0.9f, 0.9f));
    the_lamp(s);
}

static void many_spheres(test_scene *s)
{
    uint32_t state = 5000;
    walls(s, 1);
    for (int i = 0; i < 300; i++) {
        const float radius = 1 + 3 * any(&state), x = any(&state), y = any(&state);
        const float z = any(&state);
        ball(s, -45 + 90 * x, -20 + radius + 30 * y * y, -50 + 110 * z, radius,
             any_matt(&state, 0.1f, 0.9f));
    }
    the_lamp(s);
}

static void outdoors(test_scene *s) /* sun, sky, and pebbles, some of them mirrors */
{
    uint32_t state = 6000;
    s->scene.background = rt_vec(0.5f, 0.7f, 1);
    ball(s, 0, -1001, 0, 1000, matt(0.5f, 0.5f, 0.4f));
    ball(s, 0, 0, -6, 1, matt(0.8f, 0.2f, 0.2f));
    ball(s, 2.3f, 0, -6, 1, mirror(1, 1, 1));
    for (int i = 0; i < 40; i++) {
        const float radius = 0.1f + 0.2f * any(&state), x = any(&state), z = any(&state);
        rt_material m = any_matt(&state, 0, 1);
        m.mirror = i % 4 == 0;
        ball(s, -6 + 12 * x, radius - 1, -8 + 6 * z, radius, m);
    }
    box(s, rt_vec(-3.5f, -1, -8), rt_vec(-2, 1.5f, -6.5f), matt(0.7f, 0.7f, 0.2f));
    lamp(s, 20, 30, 10, 9000, 8500, 7500);
    s->camera = (rt_camera){{0, 1, 2}, {0, -0.15f, -1}, {0, 1, 0}, 50};
}

static void corridor(test_scene *s) /* two lamps of different colours, pillars, 8
                                       bounces */
{
    box(s, rt_vec(-10, -1, -60), rt_vec(10, 0, 10), matt(0.6f, 0.6f, 0.6f));
    box(s, rt_vec(-10, 10, -60), rt_vec(10, 11, 10), matt(0.8f, 0.8f, 0.8f));
    box(s, rt_vec(-11, 0, -60), rt_vec(-10, 10, 10), matt(0.7f, 0.3f, 0.3f));
    box(s, rt_vec(10, 0, -60), rt_vec(11, 10, 10), matt(0.3f, 0.3f, 0.7f));
    box(s, rt_vec(-10, 0, -61), rt_vec(10, 10, -60), matt(0.8f, 0.8f, 0.8f));
    for (int i = 0; i < 6; i++) {
        const float z = -50 + 9 * (float)i;
        box(s, rt_vec(-10, 0, z), rt_vec(-8, 10, z + 2), matt(0.6f, 0.6f, 0.5f));
        box(s, rt_vec(8, 0, z), rt_vec(10, 10, z + 2), matt(0.6f, 0.6f, 0.5f));
    }
    ball(s, 0, 2, -25, 2, matt(0.9f, 0.9f, 0.9f));
    lamp(s, -5, 9, -20, 60, 40, 20);
    lamp(s, 5, 9, -45, 20, 40, 90);
    s->camera = (rt_camera){{0, 5, 8}, {0, -0.05f, -1}, {0, 1, 0}, 60};
    s->bounces = 8;
}

static void behind_a_door(test_scene *s) /* all light comes through a gap */
{
    walls(s, 1);
    box(s, rt_vec(-50, -20, -8), rt_vec(-6, 40, -6), matt(0.7f, 0.7f, 0.7f));
    box(s, rt_vec(6, -20, -8), rt_vec(50, 40, -6), matt(0.7f, 0.7f, 0.7f));
    ball(s, -15, -12, 20, 8, matt(0.8f, 0.4f, 0.1f));
    ball(s, 20, -14, 30, 6, matt(0.3f, 0.8f, 0.4f));
    lamp(s, 20, 20, -40, 20000, 20000, 20000);
}

static void town(test_scene *s) /* no lamp, only sky */
{
    uint32_t state = 9000;
    s->scene.background = rt_vec(0.8f, 0.85f, 1);
    for (int i = 0; i < 36; i++) {
        const float x = -12 + 4 * (float)(i / 6), z = -24 + 4 * (float)(i % 6);
        const float a = any(&state), b = any(&state);
        box(s, rt_vec(x, 0, z), rt_vec(x + 2.8f, 1 + 6 * a * b, z + 2.8f),
            any_matt(&state, 0.4f, 0.9f));
    }
    box(s, rt_vec(-100, -1, -100), rt_vec(100, 0, 100), matt(0.4f, 0.4f, 0.4f));
    s->camera = (rt_camera){{2, 9, 8}, {-0.1f, -0.5f, -1}, {0, 1, 0}, 50};
}

static void fence(test_scene *s) /* thin boards against the light */
{
    walls(s, 1);
    for (int i = 0; i < 60; i++) {
        const float x = -45 + 1.5f * (float)i;
        box(s, rt_vec(x, -20, 0), rt_vec(x + 0.7f, 15, 0.5f), matt(0.8f, 0.8f, 0.8f));
    }
    ball(s, -15, -8, -30, 12, matt(0.9f, 0.3f, 0.1f));
    ball(s, 20, -10, -30, 10, mirror(1, 1, 1));
    lamp(s, -4, 30, -40, 3000, 3000, 3000);
}

static void white(test_scene *s) /* a white room, 20 bounces */
{
    walls(s, 1);
    ball(s, -20, -4.24f, 8, 16, matt(0, 0, 0));
    for (int i = 0; i < 6; i++)
        s->spheres[i].material.albedo = rt_vec(0.85f, 0.85f, 0.85f);
    box(s, rt_vec(10, -20, -20), rt_vec(30, 0, 0), matt(0.85f, 0.85f, 0.85f));
    the_lamp(s);
    s->bounces = 20;
}

static const struct {
    const char *name;
    void (*make)(test_scene *s);
} all_scenes[SCENES] = {
    {"the room", room_itself},
    {"balls under an even sky", furnace},
    {"dark", dark},
    {"fine detail", fine_detail},
    {"mirrors", mirrors},
    {"300 spheres", many_spheres},
    {"outdoors", outdoors},
    {"a corridor, two lamps", corridor},
    {"behind a door", behind_a_door},
    {"a town, sky only", town},
    {"a fence", fence},
    {"a white room", white},
};

static void make_scene(int number, test_scene *s)
{
    memset(s, 0, sizeof *s);
    s->name = all_scenes[number].name;
    s->scene.spheres = s->spheres;
    s->scene.boxes = s->boxes;
    s->scene.lights = s->lights;
    s->camera = room_camera;
    s->bounces = 5;
    all_scenes[number].make(s);
}

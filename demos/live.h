/* The room that moves: what the viewer asks of the scene of a demo, in place of scene.h. The
 * stages are the chapters' pictures of the same view, by rt.h, 1 to 7 and then those of part
 * two; the demo's own function takes the place of one of them. */
#ifndef LIVE_H
#define LIVE_H

#define MOVABLE /* before scene.h: no constants here */
#include "demo.h"
#include "explain.h"
#include "scene.h"

static const rt_scene *live_scene(int stage)
{
    static const rt_scene *const scenes[] = {
        NULL,         &scene_sphere, &scene_walls,    &scene_cube,      &scene_cube,
        &scene_cube,  &scene_mirror, &scene_indirect, &scene_glass,     &scene_lamps,
        &scene_gloss, &scene_sky,    &scene_patterns, &scene_triangles, &scene_own_shape,
    };
    return scenes[stage];
}

/* The stages of indirect light and of part two: their samples are rt_radiance's and
 * rt_radiance_mis's, and those before have live_pixel's. */
enum {
    STAGE_INDIRECT = 7,
    STAGE_GLASS,
    STAGE_LAMPS,
    STAGE_GLOSS,
    STAGE_SKY,
    STAGE_PATTERNS,
    STAGE_TRIANGLES,
    STAGE_OWN_SHAPE
};

/* What the stage wants besides what the reader does. */
static rt_options live_options(int stage, const rt_options *options)
{
    rt_options o = *options;
    if (stage == STAGE_SKY)
        o.lens = room_lens;
    return o;
}

/* -------------------------------------------------------------------------------------
 * The stages
 * ------------------------------------------------------------------------------------- */

static void live_prepare(int stage); /* below: where things are */

typedef struct live_context {
    int stage;
    const demo_view *view;
    const rt_scene *scene; /* the stage's; path, unless NULL, hears what is asked of it */
    rt_path *path;
} live_context;

static live_context live_stage(int stage, const demo_view *view)
{
    return (live_context){stage, view, live_scene(stage), NULL};
}

/* Tell, if somebody listens, that the last point of the path adds this light. */
static rt_vec3 live_add(const live_context *c, rt_vec3 light)
{
    rt_path *path = c->path;
    if (path && path->vertex_count > 0 && path->vertex_count <= path->max_vertices)
        path->vertices[path->vertex_count - 1].light = light;
    return light;
}

/* Chapters 2 and 3: the lamp's light, whatever is in the way. */
static rt_vec3 live_unshadowed(const live_context *c, const rt_hit *hit)
{
    const rt_vec3 to_light = rt_sub(room_light.position, hit->point);
    const rt_vec3 sent =
        rt_lambert(hit->material->albedo, hit->normal, to_light, room_light.intensity);
    const float dd = rt_dot(to_light, to_light), along = rt_dot(hit->normal, to_light);
    rt_path *path = c->path;
    if (path && path->vertex_count == 1 && along > 0)
        path->shadows[path->shadow_count++] = (rt_shadow){.ray = {hit->point, to_light},
                                                          .lamp = -1,
                                                          .cosine = along / sqrtf(dd),
                                                          .dd = dd,
                                                          .blocker = -1,
                                                          .light_sent = sent};
    return live_add(c, sent);
}

/* The sample of every stage. Each of chapters 1 to 6 asks one question more than the last. */
static rt_vec3 live_pixel(const void *context, float x, float y, rt_rng *rng)
{
    const live_context *c = context;
    rt_ray ray = rt_camera_ray(&room_camera, c->view->width, c->view->height, x, y);
    if (c->stage == STAGE_SKY) {
        const float r1 = rt_random(rng);
        const float r2 = rt_random(rng);
        ray = rt_lens_ray(&room_camera, &room_lens, &ray, r1, r2);
    }
    if (c->stage == STAGE_INDIRECT)
        return rt_radiance(c->scene, &ray, c->view->bounces, rng);
    if (c->stage > STAGE_INDIRECT)
        return rt_radiance_mis(c->scene, &ray, c->view->bounces, rng);
    for (int bounce = 0; bounce <= c->view->bounces; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(c->scene, &ray, &hit))
            break;
        if (c->stage < STAGE_LIGHT)
            return live_add(c, hit.material->albedo);
        if (c->stage < STAGE_SHADOWS)
            return live_unshadowed(c, &hit);
        if (!hit.material->mirror)
            return live_add(c, rt_direct(c->scene, &hit, rng));
        const rt_vec3 direction = rt_reflect(ray.direction, hit.normal);
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return rt_vec(0, 0, 0);
}

static rt_status live_render(int stage, const demo_view *view, const rt_options *options,
                             rt_image *image)
{
    const live_context context = live_stage(stage, view);
    const rt_options o = live_options(stage, options);
    live_prepare(stage);
    if (stage >= STAGE_INDIRECT)
        return rt_render(live_scene(stage), &room_camera, &o, image);
    return rt_render_pixels(live_pixel, &context, options, image);
}

static unsigned char live_encode(int stage, float value)
{
    if (stage == STAGE_SKY) /* as demo14 does */
        value = (float)(1 - exp(-(double)value));
    return rt_encode(value, stage < 5 ? 1.0 : 2.2);
}

/* Direct light, at once: all lanes without bounces, in part two with a few. In part one, what is
 * black then may be a mirror: these pixels are asked again, one ray at a time. */
static rt_status live_draft(int stage, const demo_view *view, const rt_options *options,
                            rt_image *image)
{
    if (stage < 4)
        return live_render(stage, view, options, image);
    rt_options direct = live_options(stage, options);
    direct.bounces = stage >= STAGE_GLASS ? 3 : 0; /* through glass, and what is behind */
    live_prepare(stage);
    const rt_status status = rt_render(live_scene(stage), &room_camera, &direct, image);
    demo_view mirrors = *view;
    mirrors.bounces = view->bounces > 0 ? view->bounces : 5;
    const live_context context = live_stage(stage == 7 ? 6 : stage, &mirrors);
    const int width = image->width, count = width * image->height;
    const float dim = room_dim_light.intensity.x / room_light.intensity.x;
    if (status != RT_OK || stage < 6 || stage >= STAGE_GLASS)
        return status;
#ifdef _OPENMP
    const int threads = rt_thread_count(options->threads);
#pragma omp parallel for num_threads(threads) schedule(dynamic, 512)
#endif
    for (int i = 0; i < count; i++)
        if (rt_is_zero(image->pixels[i])) {
            rt_rng rng = rt_rng_start((uint32_t)i, 0, 0);
            const rt_vec3 light = live_pixel(&context, (float)(i % width) + 0.5f,
                                             (float)(i / width) + 0.5f, &rng);
            image->pixels[i] = stage == 7 ? rt_scale(light, dim) : light;
        }
    return RT_OK;
}

/* -------------------------------------------------------------------------------------
 * The camera
 * ------------------------------------------------------------------------------------- */

static rt_vec3 live_pivot = {0, 7, 0}; /* which it goes round */

/* Its right, up and forward, each of length 1. */
static void live_axes(rt_vec3 *right, rt_vec3 *up, rt_vec3 *forward)
{
    *forward = rt_normalize(room_camera.direction);
    *right = rt_normalize(rt_cross(*forward, rt_vec(0, 1, 0)));
    *up = rt_cross(*right, *forward);
}

/* v turned by an angle, in turns, about the axis, of length 1 (Rodrigues' formula). */
static rt_vec3 live_turned(rt_vec3 v, rt_vec3 axis, float turns)
{
    float sine, cosine;
    rt_sincos(turns - floorf(turns), &sine, &cosine);
    const rt_vec3 along = rt_scale(axis, rt_dot(axis, v));
    return rt_add(along, rt_add(rt_scale(rt_sub(v, along), cosine),
                                rt_scale(rt_cross(axis, v), sine)));
}

/* Walls stop the camera: inside a wall there is nothing to see. */
static void live_camera_to(rt_vec3 position, rt_vec3 pivot)
{
    for (int i = 1; i <= 5; i++)
        if (rt_length(rt_sub(position, room_spheres[i].center)) < room_spheres[i].radius)
            return;
    room_camera.position = position;
    live_pivot = pivot;
}

static void live_orbit(float right_turns, float up_turns)
{
    rt_vec3 right, up, forward;
    live_axes(&right, &up, &forward);
    const rt_vec3 from = rt_sub(room_camera.position, live_pivot);
    const rt_vec3 old = room_camera.position, y = {0, 1, 0};
    const rt_vec3 raised = live_turned(forward, right, -up_turns);
    if (fabsf(raised.y) > 0.98f) /* not over the top */
        return;
    const rt_vec3 round =
        live_turned(live_turned(from, right, -up_turns), y, right_turns);
    live_camera_to(rt_add(live_pivot, round), live_pivot);
    if (rt_length(rt_sub(room_camera.position, old)) > 0.0f)
        room_camera.direction = rt_scale(live_turned(raised, y, right_turns), 105.0f);
}

/* What a pixel is wide, at so far away. */
static float live_pixel_size(const demo_view *view, float distance)
{
    const float half = 0.5f * room_camera.fov_y / 57.29578f;
    return 2.0f * tanf(half) * distance / (float)view->height;
}

static void live_pan(const demo_view *view, float right_pixels, float up_pixels)
{
    rt_vec3 right, up, forward;
    live_axes(&right, &up, &forward);
    const float size =
        live_pixel_size(view, rt_length(rt_sub(room_camera.position, live_pivot)));
    const rt_vec3 by =
        rt_add(rt_scale(right, size * right_pixels), rt_scale(up, size * up_pixels));
    live_camera_to(rt_add(room_camera.position, by), rt_add(live_pivot, by));
}

/* Nearer to the pivot, or farther away. */
static void live_zoom(float factor)
{
    const rt_vec3 from = rt_sub(room_camera.position, live_pivot);
    const float distance = factor * rt_length(from);
    if (distance > 1.0f && distance < 2000.0f)
        live_camera_to(rt_add(live_pivot, rt_scale(from, factor)), live_pivot);
}

/* -------------------------------------------------------------------------------------
 * Things: the ball, the mirror, the cube, the lamp, the ball of glass, the mesh, the pedestal
 * ------------------------------------------------------------------------------------- */

enum { BALL = 1, MIRROR, CUBE, LAMP, GLASS, MESH, PEDESTAL, THINGS };

static const char *live_name(int thing)
{
    static const char *const names[THINGS] = {"nothing",  "the ball",    "the mirror",
                                              "the cube", "the lamp",    "the glass ball",
                                              "",         "the pedestal"};
    return thing == MESH ? room_model.name : names[thing];
}

static rt_vec3 live_middle(int thing)
{
    switch (thing) {
    case BALL: return room_spheres[0].center;
    case MIRROR: return room_spheres[ROOM_MIRROR].center;
    case GLASS: return room_spheres[ROOM_GLASS].center;
    case CUBE: return rt_scale(rt_add(room_cube.min, room_cube.max), 0.5f);
    case MESH: return room_foot;
    case PEDESTAL: return room_cylinder.base;
    default: return room_light.position;
    }
}

/* How far it reaches about its middle: what must stay off the walls. */
static float live_reach(int thing)
{
    switch (thing) {
    case BALL: return room_spheres[0].radius;
    case MIRROR: return room_spheres[ROOM_MIRROR].radius;
    case GLASS: return room_spheres[ROOM_GLASS].radius;
    case CUBE: return 0.5f * (room_cube.max.x - room_cube.min.x);
    case MESH: return 13;
    case PEDESTAL: return room_cylinder.radius;
    default: return room_lamp.radius;
    }
}

static void live_place(int thing, rt_vec3 middle)
{
    const rt_vec3 by = rt_sub(middle, live_middle(thing));
    if (thing == BALL)
        room_spheres[0].center = middle;
    if (thing == MIRROR)
        room_spheres[ROOM_MIRROR].center = middle;
    if (thing == GLASS)
        room_spheres[ROOM_GLASS].center = middle;
    if (thing == CUBE) {
        room_cube.min = rt_add(room_cube.min, by);
        room_cube.max = rt_add(room_cube.max, by);
    }
    if (thing == MESH)
        room_foot = middle;
    if (thing == PEDESTAL)
        room_cylinder.base = middle;
    if (thing == LAMP)
        room_light.position = room_dim_light.position = room_lamp.center = middle;
}

/* Mesh or pedestal, if the ray meets one of them before t_max; or 0. The scene is not asked: it
 * gets mesh and tree anew only before a picture, and other threads may be rendering one. */
static int live_pick_mesh(int stage, const rt_ray *ray, float t_max)
{
    if (stage < STAGE_TRIANGLES)
        return 0;
    if (!room_model.positions)
        room_make_teapot();
    const float scale = room_model.scale;
    const rt_vec3 at = room_mesh_place(stage - STAGE_TRIANGLES);
    const rt_vec3 from = rt_scale(rt_sub(ray->origin, at), 1 / scale);
    const rt_ray scaled = {rt_add(room_model.foot, from),
                           rt_scale(ray->direction, 1 / scale)};
    const rt_mesh mesh = {room_model.positions,
                          room_model.indices,
                          room_model.position_count,
                          room_model.triangle_count,
                          {{0, 0, 0}, false}};
    const rt_scene alone = {.meshes = &mesh, .mesh_count = 1};
    rt_hit hit;
    int thing = 0;
    if (rt_intersect(&alone, &scaled, &hit) && hit.t < t_max) {
        t_max = hit.t;
        thing = MESH;
    }
    if (stage == STAGE_OWN_SHAPE && room_pedestal.hit(&room_cylinder, ray, t_max, &hit))
        thing = PEDESTAL;
    return thing;
}

/* A bulb that can be taken; the sun is too far away. */
static bool live_has_lamp(int stage)
{
    return stage >= STAGE_LIGHT && stage != STAGE_SKY;
}

/* The thing under the point (x, y) of the film; 0: nothing that can be moved. */
static int live_pick(int stage, const demo_view *view, float x, float y)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    const rt_vec3 to_lamp = rt_sub(room_light.position, ray.origin);
    const float t = rt_dot(to_lamp, ray.direction); /* where the ray comes by the lamp */
    const float beside = rt_length(rt_sub(to_lamp, rt_scale(ray.direction, t)));
    const float size = stage >= STAGE_LAMPS ? room_lamp.radius : 2.0f;
    rt_hit hit = {.t = FLT_MAX};
    rt_scene scene = *live_scene(stage);
    scene.bvh = NULL;
    scene.mesh_count = scene.custom_shape_count = 0;
    const bool found = rt_intersect(&scene, &ray, &hit);
    const int other = live_pick_mesh(stage, &ray, hit.t);
    if (live_has_lamp(stage) && t > 0.0f && beside < size && hit.t > t)
        return LAMP;
    if (other != 0 || !found)
        return other;
    return hit.material == &room_spheres[0].material             ? BALL
           : hit.material == &room_spheres[ROOM_MIRROR].material ? MIRROR
           : hit.material == &room_spheres[ROOM_GLASS].material  ? GLASS
           : hit.material == &room_cube.material                 ? CUBE
                                                                 : 0;
}

static float live_clamp(float x, float low, float high)
{
    return x < low ? low : x > high ? high : x;
}

/* Move it by so many pixels, parallel to the film, or over the floor; walls stop it. */
static void live_drag(int thing, const demo_view *view, float right_pixels,
                      float up_pixels, bool over_the_floor)
{
    rt_vec3 right, up, forward;
    live_axes(&right, &up, &forward);
    rt_vec3 middle = live_middle(thing);
    const float depth = rt_dot(rt_sub(middle, room_camera.position), forward);
    const float size = live_pixel_size(view, depth > 1.0f ? depth : 1.0f);
    if (over_the_floor)
        up = rt_normalize(rt_vec(forward.x, 0, forward.z));
    middle = rt_add(middle, rt_add(rt_scale(right, size * right_pixels),
                                   rt_scale(up, size * up_pixels)));
    const float reach = live_reach(thing);
    middle.x = live_clamp(middle.x, -49 + reach, 49 - reach);
    /* of mesh and pedestal it is the middle of the foot */
    const float below = thing >= MESH ? 0.4f : reach;
    middle.y = live_clamp(middle.y, -20.8f + below, 39 - reach);
    middle.z = live_clamp(middle.z, -59 + reach, 90 - reach);
    if (thing == PEDESTAL) /* with what stands on it */
        live_place(MESH, rt_add(room_foot, rt_sub(middle, room_cylinder.base)));
    live_place(thing, middle);
}

/* What a thing has besides its place: one number, from this stage to that, wherever it stands. */
typedef struct live_number {
    const char *name;
    int first, last;
    float low, high, factor; /* for one notch of the wheel */
    float *places[4];
} live_number;

static const live_number live_numbers[THINGS] = {
    [BALL] = {"shininess",
              STAGE_GLOSS,
              STAGE_OWN_SHAPE,
              1,
              100000,
              1.4f,
              {&gloss_surfaces[ROOM_BALL].shininess,
               &pattern_surfaces[ROOM_BALL].shininess,
               &mesh_surfaces[ROOM_BALL].shininess}},
    [MIRROR] = {"shininess",
                STAGE_GLOSS,
                STAGE_OWN_SHAPE,
                1,
                100000,
                1.4f,
                {&gloss_surfaces[ROOM_MIRROR].shininess,
                 &pattern_surfaces[ROOM_MIRROR].shininess,
                 &mesh_surfaces[ROOM_MIRROR].shininess}},
    [CUBE] = {"refractive index",
              STAGE_GLASS,
              STAGE_SKY,
              1,
              2.5f,
              1.02f,
              {&glass_surfaces[ROOM_CUBE].eta, &gloss_surfaces[ROOM_CUBE].eta}},
    [LAMP] = {"radius", STAGE_LAMPS, STAGE_OWN_SHAPE, 0.1f, 9, 1.1f, {&room_lamp.radius}},
    [GLASS] = {"refractive index",
               STAGE_GLASS,
               STAGE_OWN_SHAPE,
               1,
               2.5f,
               1.02f,
               {&glass_surfaces[ROOM_GLASS].eta, &gloss_surfaces[ROOM_GLASS].eta,
                &pattern_surfaces[ROOM_GLASS].eta, &mesh_surfaces[ROOM_GLASS].eta}},
    [MESH] = {"shininess",
              STAGE_TRIANGLES,
              STAGE_OWN_SHAPE,
              1,
              100000,
              1.4f,
              {&mesh_surfaces[ROOM_MESH].shininess}},
    [PEDESTAL] = {"height",
                  STAGE_OWN_SHAPE,
                  STAGE_OWN_SHAPE,
                  1,
                  30,
                  1.1f,
                  {&room_cylinder.height}},
};

static void live_set_number(int thing, float value)
{
    const live_number *n = &live_numbers[thing];
    for (int i = 0; i < 4; i++)
        if (n->places[i])
            *n->places[i] = live_clamp(value, n->low, n->high);
}

static bool live_has_number(int stage, int thing)
{
    const live_number *n = &live_numbers[thing];
    return n->name && stage >= n->first && stage <= n->last &&
           (thing != LAMP || live_has_lamp(stage));
}

static bool live_tune(int stage, int thing, float notches)
{
    if (!live_has_number(stage, thing))
        return false;
    const live_number *n = &live_numbers[thing];
    live_set_number(thing, *n->places[0] * powf(n->factor, notches));
    return true;
}

static void live_say(int stage, int thing, demo_text *out)
{
    text_add(out, "%s", live_name(thing));
    if (live_has_number(stage, thing))
        text_add(out, ", %s %.3g", live_numbers[thing].name,
                 (double)*live_numbers[thing].places[0]);
}

/* -------------------------------------------------------------------------------------
 * The view: back to the first, and as C code
 * ------------------------------------------------------------------------------------- */

/* All that moves. */
typedef struct live_state {
    rt_camera camera;
    rt_vec3 pivot;
    rt_vec3 places[THINGS]; /* of the middles */
    rt_box cube;
    float numbers[THINGS];
} live_state;

static size_t live_save(void *to)
{
    live_state now;
    memset(&now, 0, sizeof now); /* the gaps, too */
    now.camera = room_camera;
    now.pivot = live_pivot;
    now.cube = room_cube;
    for (int thing = BALL; thing < THINGS; thing++) {
        now.places[thing] = live_middle(thing);
        now.numbers[thing] = *live_numbers[thing].places[0];
    }
    memcpy(to, &now, sizeof now);
    return sizeof now;
}

static void live_load(const void *from)
{
    live_state then;
    memcpy(&then, from, sizeof then);
    room_camera = then.camera;
    live_pivot = then.pivot;
    for (int thing = BALL; thing < THINGS; thing++) {
        live_place(thing, then.places[thing]);
        live_set_number(thing, then.numbers[thing]);
    }
    room_cube = then.cube; /* not by its middle, which is rounded */
}

/* The two scenes with a tree: it is made anew if anything has moved since. */
static void live_prepare(int stage)
{
    static live_state made[MESH_SCENES];
    if (stage < STAGE_TRIANGLES)
        return;
    const int which = stage - STAGE_TRIANGLES;
    live_state now;
    live_save(&now);
    memset(&now.camera, 0, sizeof now.camera); /* may move */
    now.pivot = rt_vec(0, 0, 0);
    if (memcmp(&now, &made[which], sizeof now) == 0)
        return;
    made[which] = now;
    room_prepare(which);
}

static void live_reset(void)
{
    static live_state first;
    static bool started;
    if (!started) /* the first call keeps what there is */
        live_save(&first);
    started = true;
    live_load(&first);
}

static void live_print_vec(demo_text *out, const char *before, rt_vec3 v,
                           const char *after)
{
    text_add(out, "%s{%#.9gf, %#.9gf, %#.9gf}%s", before, (double)v.x, (double)v.y,
             (double)v.z, after);
}

/* As the lines of scene.h that would show it. (%.9g brings each float back exactly; the #
 * gives it a point.) */
static void live_print(demo_text *out)
{
    live_print_vec(out, "rt_camera room_camera = {", room_camera.position, ", ");
    live_print_vec(out, "", room_camera.direction, ", ");
    live_print_vec(out, "", room_camera.up, "");
    text_add(out, ", %#.9gf};\n", (double)room_camera.fov_y);
    live_print_vec(out, "ball ", room_spheres[0].center, ", ");
    live_print_vec(out, "mirror ", room_spheres[6].center, ", ");
    live_print_vec(out, "cube ", room_cube.min, " to ");
    live_print_vec(out, "", room_cube.max, ", ");
    live_print_vec(out, "lamp ", room_light.position, "\n");
    live_print_vec(out, "mesh ", room_foot, ", ");
    live_print_vec(out, "pedestal ", room_cylinder.base, "\n");
}

/* -------------------------------------------------------------------------------------
 * The ray inspector: lines in the room, and words
 * ------------------------------------------------------------------------------------- */

static void live_line(demo_lines *l, demo_kind kind, float weight, rt_vec3 from,
                      rt_vec3 to)
{
    if (l->count < l->most)
        l->lines[l->count++] = (demo_line){from, to, kind, weight};
}

static void live_box(demo_lines *l, rt_vec3 a, rt_vec3 b)
{
    for (int i = 0; i < 8; i++)
        for (int k = 0; k < 3; k++)
            if ((i >> k & 1) == 0) {
                const int j = i | 1 << k;
                live_line(
                    l, LINE_ROOM, 1,
                    rt_vec(i & 1 ? b.x : a.x, i & 2 ? b.y : a.y, i & 4 ? b.z : a.z),
                    rt_vec(j & 1 ? b.x : a.x, j & 2 ? b.y : a.y, j & 4 ? b.z : a.z));
            }
}

/* Two circles: one is round from above, the other from the side. */
static void live_ball(demo_lines *l, rt_vec3 O, float R)
{
    enum { PARTS = 32 };
    for (int i = 0; i < PARTS; i++) {
        float s0, c0, s1, c1;
        rt_sincos((float)i / (float)PARTS, &s0, &c0);
        rt_sincos((float)(i + 1) / (float)PARTS, &s1, &c1);
        live_line(l, LINE_ROOM, 1, rt_add(O, rt_vec(R * c0, 0, R * s0)),
                  rt_add(O, rt_vec(R * c1, 0, R * s1)));
        live_line(l, LINE_ROOM, 1, rt_add(O, rt_vec(0, R * c0, R * s0)),
                  rt_add(O, rt_vec(0, R * c1, R * s1)));
    }
}

/* A box around the mesh, and one around the pedestal. */
static void live_outline_mesh(demo_lines *l, int which)
{
    rt_vec3 low = {FLT_MAX, FLT_MAX, FLT_MAX}, high = {-FLT_MAX, -FLT_MAX, -FLT_MAX};
    const rt_mesh *mesh = &room_meshes[which];
    for (int i = 0; i < mesh->position_count; i++) {
        const rt_vec3 p = mesh->positions[i];
        low = rt_vec(fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z));
        high = rt_vec(fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z));
    }
    if (mesh->position_count > 0)
        live_box(l, low, high);
    if (which == ON_THE_PEDESTAL)
        live_box(l, room_pedestal.min, room_pedestal.max);
}

static void live_outlines(int stage, const demo_view *view, demo_lines *l)
{
    if (stage >= STAGE_LIGHT)
        live_box(l, rt_vec(-50, -20, -60), rt_vec(50, 40, 60));
    live_ball(l, room_spheres[0].center, room_spheres[0].radius);
    if (stage >= 3 && stage < STAGE_TRIANGLES)
        live_box(l, room_cube.min, room_cube.max);
    if (stage >= STAGE_TRIANGLES)
        live_outline_mesh(l, stage - STAGE_TRIANGLES);
    if (stage >= 6)
        live_ball(l, room_spheres[ROOM_MIRROR].center, room_spheres[ROOM_MIRROR].radius);
    if (stage >= STAGE_GLASS)
        live_ball(l, room_spheres[ROOM_GLASS].center, room_spheres[ROOM_GLASS].radius);
    if (live_has_lamp(stage))
        live_ball(l, room_light.position, stage >= STAGE_LAMPS ? room_lamp.radius : 1.0f);
    for (int i = 0; i < 4; i++) { /* the camera: rays through the corners of the film */
        const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height,
                                         i == 0 || i == 3 ? 0.0f : (float)view->width,
                                         i < 2 ? 0.0f : (float)view->height);
        live_line(l, LINE_ROOM, 1, ray.origin, rt_at(&ray, 15.0f));
    }
}

/* Where the name of a shape stands. Of the walls it is a place in the open, near the camera. */
static rt_vec3 live_label_place(const rt_scene *scene, int shape)
{
    static const rt_vec3 walls[] = {
        {-50, 10, 48}, {0, 40, 20}, {50, 10, 48}, {0, -20, 20}, {-20, 10, -60}};
    const int other = shape - scene->sphere_count;
    return shape >= 1 && shape <= 5                       ? walls[shape - 1]
           : other < 0                                    ? scene->spheres[shape].center
           : other < scene->box_count                     ? live_middle(CUBE)
           : other < scene->box_count + scene->mesh_count ? live_middle(MESH)
                                                          : live_middle(PEDESTAL);
}

static int live_labels(int stage, bool side, demo_label labels[DEMO_LABELS])
{
    const rt_scene *scene = live_scene(stage);
    const int shapes = scene->sphere_count + scene->box_count + scene->mesh_count +
                       scene->custom_shape_count;
    int count = 0;
    labels[count++] = (demo_label){room_camera.position, "camera", true};
    if (live_has_lamp(stage))
        labels[count++] = (demo_label){room_light.position, "lamp", true};
    for (int shape = 0; shape < shapes && count < DEMO_LABELS; shape++) {
        const bool across = side ? shape == ROOM_LEFT || shape == ROOM_RIGHT
                                 : shape == ROOM_CEILING || shape == ROOM_FLOOR;
        if (!across) /* such a wall is the whole plan */
            labels[count++] =
                (demo_label){live_label_place(scene, shape),
                             shape_name(scene, shape) + strlen("the "), false};
    }
    return count;
}

/* How a ray was sent on, as a kind of line. */
static demo_kind live_kind(rt_event event)
{
    switch (event) {
    case RT_EVENT_MIRROR: return LINE_MIRROR;
    case RT_EVENT_GLOSS: return LINE_GLOSS;
    case RT_EVENT_REFLECTED:
    case RT_EVENT_REFRACTED: return LINE_GLASS;
    default: return LINE_DIFFUSE;
    }
}

/* So far out is nothing of the room: there a line has left every plan. */
enum { LIVE_FAR = 1000 };

/* Where the ray of this point ends. */
static rt_vec3 live_end(const rt_scene *scene, const rt_vertex *v)
{
    const float far_t = (float)LIVE_FAR / rt_length(v->ray.direction);
    if (v->lamp < 0)
        return v->shape < 0 ? rt_at(&v->ray, far_t) : v->hit.point;
    const float t = rt_meet_lamp(&scene->lamps[v->lamp], &v->ray, FLT_MAX);
    return rt_at(&v->ray, live_clamp(t, 0, far_t));
}

static void live_draw_path(const explanation *e, demo_lines *l)
{
    const rt_path *path = &e->path;
    for (int n = 0; n < path->vertex_count && n < path->max_vertices; n++) {
        const rt_vertex *v = &path->vertices[n];
        const rt_vec3 P = live_end(e->scene, v);
        const float weight = (v->throughput.x + v->throughput.y + v->throughput.z) / 3.0f;
        live_line(l, n == 0 ? LINE_CAMERA : live_kind(path->vertices[n - 1].event),
                  weight, v->ray.origin, P);
        if (v->shape >= 0)
            live_line(l, LINE_NORMAL, 1, P, rt_add(P, rt_scale(v->hit.normal, 7.0f)));
        for (int i = 0; i < path->shadow_count; i++) {
            const rt_shadow *s = &path->shadows[i];
            if (s->vertex != n)
                continue;
            const float far_t =
                (float)LIVE_FAR / rt_length(s->ray.direction); /* as the sun */
            const float t = s->blocker >= 0 ? s->t : far_t < 1.0f ? far_t : 1.0f;
            live_line(l, LINE_LIT, weight, s->ray.origin, rt_at(&s->ray, t));
            if (s->blocker >= 0)
                live_line(l, LINE_BLOCKED, 1, rt_at(&s->ray, t), rt_at(&s->ray, 1.0f));
        }
    }
}

/* What came of the lamp. */
static void live_tell_lamp(const explanation *e, int n, demo_text *out)
{
    const rt_vertex *v = &e->path.vertices[n];
    bool asked = false;
    for (int i = 0; i < e->path.shadow_count && i < e->path.max_shadows; i++) {
        const rt_shadow *s = &e->path.shadows[i];
        if (s->vertex != n)
            continue;
        const bool seen = s->blocker < 0, shadows = e->stage >= STAGE_SHADOWS;
        text_add(out, "%d%s%s", seen ? LINE_LIT : LINE_BLOCKED,
                 !shadows ? "no shadows yet"
                 : seen   ? "seen"
                          : "behind ",
                 seen ? "" : shape_name(e->scene, s->blocker));
        if (s->lamp >= 0 && seen)
            text_add(out, ", weight %.2f", (double)s->weight);
        asked = true;
    }
    if (v->lamp >= 0 && n > 0)
        text_add(out, "0by chance, weight %.2f", (double)v->weight);
    else if (!asked && v->shape >= 0 && v->event != RT_EVENT_MIRROR &&
             v->event != RT_EVENT_REFLECTED && v->event != RT_EVENT_REFRACTED &&
             lights_are_behind(e, v))
        text_add(out, "0behind the surface");
    else if (!asked)
        text_add(out, "0");
}

/* One row. */
static void live_tell_vertex(const explanation *e, int n, demo_text *out)
{
    const rt_vertex *v = &e->path.vertices[n];
    const rt_vec3 N = v->hit.normal, T = v->throughput, adds = rt_mul(T, v->light);
    const demo_kind came =
        n == 0 ? LINE_CAMERA : live_kind(e->path.vertices[n - 1].event);
    text_add(out, "%d%d\t0%s", came, n,
             v->lamp >= 0 ? "the lamp" : shape_name(e->scene, v->shape));
    text_add(out, "\t0");
    print_place(out, e->scene, v);
    if (v->shape >= 0)
        text_add(out, "\t0%.2f\t0%.2f %.2f %.2f\t", (double)v->hit.t, (double)N.x,
                 (double)N.y, (double)N.z);
    else
        text_add(out, "\t0\t0\t");
    live_tell_lamp(e, n, out);
    if (n + 1 < e->path.vertex_count)
        text_add(out, "\t%d%s", live_kind(v->event), event_name(v));
    else
        text_add(out, "\t0");
    text_add(out, "\t0%.3f %.3f %.3f\t0%.4f %.4f %.4f\n", (double)T.x, (double)T.y,
             (double)T.z, (double)adds.x, (double)adds.y, (double)adds.z);
}

static void live_tell(const explanation *e, demo_text *out)
{
    const int more = e->path.vertex_count - e->path.max_vertices;
    text_add(out, "0\t0meets\t0on it\t0t\t%dN\t0lamp\t0goes on\t0throughput\t0adds\n",
             LINE_NORMAL);
    for (int n = 0; n < e->path.vertex_count && n < e->path.max_vertices; n++)
        live_tell_vertex(e, n, out);
    if (more > 0)
        text_add(out, "0\t0and %d more", more);
    else if (!rt_is_zero(e->rest))
        text_add(out, "0\t0a function of your own");
    if (more > 0 || !rt_is_zero(e->rest))
        text_add(out, "\t0\t0\t0\t0\t0\t0\t0%.4f %.4f %.4f\n", (double)e->rest.x,
                 (double)e->rest.y, (double)e->rest.z);
}

/* A sample that is made once more, by the loop that makes the pictures. */
typedef struct live_again {
    const live_context *stage;
    demo_pixel *own; /* NULL: it is the stage's */
    rt_vec3 *value;
} live_again;

static rt_vec3 live_catch(const void *context, float x, float y, rt_rng *rng)
{
    const live_again *again = context;
    *again->value = again->own ? again->own(again->stage->view, x, y, rng)
                               : live_pixel(again->stage, x, y, rng);
    return *again->value;
}

static rt_status live_do_again(const live_context *stage, demo_pixel *own,
                               const demo_sample *s, rt_vec3 *value)
{
    const live_again again = {stage, own, value};
    const int width = s->image->width;
    rt_vec3 mean[2] = {{0, 0, 0}, {0, 0, 0}};
    rt_image one = {.width = width, .height = s->image->height, .pixels = mean};
    one.half = s->image->half ? mean + 1 : NULL; /* then it takes other numbers */
    one.samples = s->number;
    one.first = s->y * width + s->x;
    one.count = 1;
    const rt_options options = {.samples = 1,
                                .threads = 1,
                                .seed = s->options->seed,
                                .sampler = s->options->sampler};
    return rt_render_pixels(live_catch, &again, &options, &one);
}

/* live_pixel again, while the scene tells the path what it is asked: by this file's functions,
 * so by those of the reader's that take the place of rt.h's. */
static rt_status live_listen(const demo_sample *s, rt_path *path)
{
    live_context stage = live_stage(s->stage, s->view);
    rt_scene watched = *stage.scene;
    rt_bvh watch;
    memset(&watch, 0, sizeof watch);
    watch.path = path;
    watched.bvh = &watch;
    path->scene = stage.scene;
    path->bounces = s->view->bounces;
    path->told = s->stage > STAGE_INDIRECT;
    path->vertex_count = path->shadow_count = 0;
    stage.scene = &watched;
    stage.path = path;
    return live_do_again(&stage, NULL, s, &path->value);
}

/* The sample that is shown, and nothing like it: rt_render's, live_pixel's, or the demo's own. The
 * last cannot be listened to. It should do what live_pixel does. If its value is another, the
 * rest says so. */
static rt_status live_path(const demo_sample *s, demo_lines *lines, demo_text *table,
                           demo_text *words, rt_vec3 *value)
{
    explanation e = {live_scene(s->stage), s->stage, empty_path(), {0, 0, 0}};
    const rt_options options = live_options(s->stage, s->options);
    const live_context stage = live_stage(s->stage, s->view);
    live_prepare(s->stage);
    rt_status status = s->stage < STAGE_INDIRECT || s->own
                           ? live_listen(s, &e.path)
                           : rt_trace_pixel(e.scene, &room_camera, &options, s->image,
                                            s->x, s->y, s->number, &e.path);
    if (status == RT_OK && s->own)
        status = live_do_again(&stage, s->own, s, &e.path.value);
    if (status != RT_OK)
        return status;
    find_rest(&e);
    if (lines)
        live_draw_path(&e, lines);
    if (table)
        live_tell(&e, table);
    if (words)
        print_sample(words, &e, s->number);
    *value = e.path.value;
    return RT_OK;
}

static const demo_live live_room = {
    .render = live_render,
    .draft = live_draft,
    .prepare = live_prepare,
    .encode = live_encode,
    .orbit = live_orbit,
    .pan = live_pan,
    .zoom = live_zoom,
    .reset = live_reset,
    .pick = live_pick,
    .name = live_name,
    .drag = live_drag,
    .tune = live_tune,
    .say = live_say,
    .print = live_print,
    .outlines = live_outlines,
    .labels = live_labels,
    .path = live_path,
    .save = live_save,
    .load = live_load,
};

#endif

/* The room of the report, built up chapter by chapter.
 *
 * Its walls are the outsides of giant spheres: close by, a sphere of radius 940 is almost
 * a plane. The room is 100 units wide and 60 high; a unit is about a foot.
 *
 *     y (up)          The spheres are in the order in which the chapters need them, so that
 *     |               a scene is the first few of them: chapter 1 takes one, chapter 2 adds
 *     +---- x         the five walls, chapter 3 the cube, chapter 6 the mirror,
 *    /                chapter 11 a ball of glass.
 *   z (to the viewer) */
#ifndef SCENE_H
#define SCENE_H

#include "../rt.h"
#ifndef __cplusplus
#include "patterns.h"
#include "shapes.h"
#include "teapot.h"

#include <stdlib.h>
#endif

/* In the window things can be moved, so live.h defines MOVABLE as nothing. */
#ifndef MOVABLE
#define MOVABLE const
#endif

static MOVABLE rt_sphere room_spheres[8] = {
    {{-20, -4.242709f, 8}, 16, {{0.85f, 0.10f, 0.08f}, false}}, /* red sphere, in front */
    {{-990, 0, 0}, 940, {{0.15f, 0.60f, 0.15f}, false}},        /* left wall, green */
    {{0, 980, 0}, 940, {{0.65f, 0.12f, 0.10f}, false}},         /* ceiling, red */
    {{990, 0, 0}, 940, {{0.15f, 0.25f, 0.70f}, false}},         /* right wall, blue */
    {{0, -960, 0}, 940, {{0.80f, 0.80f, 0.80f}, false}},        /* floor, white */
    {{0, 0, -1000}, 940, {{0.50f, 0.50f, 0.50f}, false}},       /* back wall, grey */
    {{6, -2.772754f, -38}, 18, {{1, 1, 1}, true}}, /* mirror sphere, behind */
    {{3, -9.42f, 24}, 11, {{1, 1, 1}, false}},     /* a ball of glass, in front */
};

static MOVABLE rt_box room_cube = {
    {19, -20.5f, -17}, {38, -1.5f, 2}, {{0.90f, 0.75f, 0.10f}, false}}; /* yellow */

/* A bulb under the ceiling; in chapter 7, where the walls give light too, a dimmer one. */
static MOVABLE rt_light room_light = {{-4, 30, 19}, {5200, 5200, 5200}};
static MOVABLE rt_light room_dim_light = {{-4, 30, 19}, {3380, 3380, 3380}};

static MOVABLE rt_camera room_camera = {{0, 8, 105}, {0, -1, -105}, {0, 1, 0}, 46};

static const rt_scene scene_sphere = {.spheres = room_spheres, .sphere_count = 1};

static const rt_scene scene_walls = {
    .spheres = room_spheres, .sphere_count = 6, .lights = &room_light, .light_count = 1};

static const rt_scene scene_cube = {.spheres = room_spheres,
                                    .sphere_count = 6,
                                    .boxes = &room_cube,
                                    .box_count = 1,
                                    .lights = &room_light,
                                    .light_count = 1};

static const rt_scene scene_mirror = {.spheres = room_spheres,
                                      .sphere_count = 7,
                                      .boxes = &room_cube,
                                      .box_count = 1,
                                      .lights = &room_light,
                                      .light_count = 1};

static const rt_scene scene_indirect = {.spheres = room_spheres,
                                        .sphere_count = 7,
                                        .boxes = &room_cube,
                                        .box_count = 1,
                                        .lights = &room_dim_light,
                                        .light_count = 1};

#ifndef __cplusplus /* which knows no [ROOM_BALL] = below, and needs no part two */

/* Part two. Surfaces are numbered like the shapes: the spheres above, then the cube, or
 * in its place the mesh and then the pedestal. */
enum {
    ROOM_BALL = 0,
    ROOM_LEFT,
    ROOM_CEILING,
    ROOM_RIGHT,
    ROOM_FLOOR,
    ROOM_MIRROR = 6,
    ROOM_GLASS,
    ROOM_CUBE,
    ROOM_MESH = ROOM_CUBE,
    ROOM_PEDESTAL,
    ROOM_SHAPES
};

static MOVABLE rt_surface glass_surfaces[ROOM_SHAPES] = {
    [ROOM_GLASS] = {.eta = 1.5f},
    [ROOM_CUBE] = {.eta = 1.5f, .absorption = {0.004f, 0.016f, 0.090f}}, /* amber */
};

/* The bulb of chapter 7, now with a size. */
static MOVABLE rt_lamp room_lamp = {
    .center = {-4, 30, 19}, .radius = 6, .intensity = {3380, 3380, 3380}};

static MOVABLE rt_surface gloss_surfaces[ROOM_SHAPES] = {
    [ROOM_BALL] = {.shininess = 300},  /* red lacquer */
    [ROOM_MIRROR] = {.shininess = 60}, /* brushed metal */
    [ROOM_GLASS] = {.eta = 1.5f},
    [ROOM_CUBE] = {.eta = 1.5f, .absorption = {0.004f, 0.016f, 0.090f}},
};

/* Evening: the sun is low in front of the open side of the room, and the sky is yellow at
 * the horizon and blue higher up. */
static MOVABLE rt_lamp room_sun = {.center = {-22000, 16000, 96000},
                                   .radius = 12000,
                                   .intensity = {5e10f, 3.4e10f, 1.8e10f}};

static inline rt_vec3 room_sky(const void *unused, rt_vec3 direction)
{
    (void)unused;
    const rt_vec3 horizon = {1.0f, 0.75f, 0.45f}, zenith = {0.15f, 0.35f, 0.90f};
    const float up = direction.y > 0.0f ? direction.y : 0.0f;
    const float blue = up < 0.5f ? 2.0f * up : 1.0f;
    return rt_add(rt_scale(horizon, 1.0f - blue), rt_scale(zenith, blue));
}

static MOVABLE rt_lens room_lens = {.radius = 2.5f, .focus = 81};

static const pattern_checks room_tiles = {
    10, {0.80f, 0.80f, 0.80f}, {0.12f, 0.12f, 0.14f}};
static pattern_picture room_picture = {.ball = &room_spheres[ROOM_BALL]};

static rt_surface pattern_surfaces[ROOM_SHAPES] = {
    [ROOM_BALL] = {.shininess = 300,
                   .pattern = picture_pattern,
                   .pattern_data = &room_picture},
    [ROOM_FLOOR] = {.pattern = checker_pattern, .pattern_data = &room_tiles},
    [ROOM_MIRROR] = {.shininess = 60},
    [ROOM_GLASS] = {.eta = 1.5f},
    [ROOM_CUBE] = {.pattern = marble_pattern},
};

static const rt_scene scene_glass = {.spheres = room_spheres,
                                     .sphere_count = 8,
                                     .boxes = &room_cube,
                                     .box_count = 1,
                                     .lights = &room_dim_light,
                                     .light_count = 1,
                                     .surfaces = glass_surfaces};

static const rt_scene scene_lamps = {.spheres = room_spheres,
                                     .sphere_count = 8,
                                     .boxes = &room_cube,
                                     .box_count = 1,
                                     .lamps = &room_lamp,
                                     .lamp_count = 1,
                                     .surfaces = glass_surfaces};

static const rt_scene scene_gloss = {.spheres = room_spheres,
                                     .sphere_count = 8,
                                     .boxes = &room_cube,
                                     .box_count = 1,
                                     .lamps = &room_lamp,
                                     .lamp_count = 1,
                                     .surfaces = gloss_surfaces};

static const rt_scene scene_sky = {.spheres = room_spheres,
                                   .sphere_count = 8,
                                   .boxes = &room_cube,
                                   .box_count = 1,
                                   .lamps = &room_sun,
                                   .lamp_count = 1,
                                   .sky = room_sky,
                                   .surfaces = gloss_surfaces};

static const rt_scene scene_patterns = {.spheres = room_spheres,
                                        .sphere_count = 8,
                                        .boxes = &room_cube,
                                        .box_count = 1,
                                        .lamps = &room_lamp,
                                        .lamp_count = 1,
                                        .surfaces = pattern_surfaces};

/* ---- chapters 16 and 17: a mesh, on the floor and on a pedestal ------------------------- */

enum { ON_THE_FLOOR, ON_THE_PEDESTAL, MESH_SCENES };

/* The mesh as it came (NULL: the teapot), and how it is put into the room. */
static struct room_model {
    const char *name;
    const rt_vec3 *positions;
    const int *indices;
    int position_count, triangle_count;
    rt_vec3 foot; /* the point of it that stands where room_foot is */
    float scale;
} room_model = {.name = "the teapot", .scale = 5.5f};

static MOVABLE rt_vec3 room_foot = {30, -20.4f, 6}; /* on the floor */
static MOVABLE cylinder room_cylinder = {{30, -20.4f, 6}, 10, 8};

/* The mesh in the room, for each of the two scenes, as room_prepare makes it. */
static rt_mesh room_meshes[MESH_SCENES];
static rt_custom_shape room_pedestal = {.material = {{0.32f, 0.13f, 0.06f}, false},
                                        .hit = cylinder_hit,
                                        .data = &room_cylinder};
static rt_bvh room_trees[MESH_SCENES];

static MOVABLE rt_surface mesh_surfaces[ROOM_SHAPES] = {
    [ROOM_BALL] = {.shininess = 300},
    [ROOM_FLOOR] = {.pattern = checker_pattern, .pattern_data = &room_tiles},
    [ROOM_MIRROR] = {.shininess = 60},
    [ROOM_GLASS] = {.eta = 1.5f},
    [ROOM_MESH] = {.shininess = 400},     /* porcelain */
    [ROOM_PEDESTAL] = {.shininess = 200}, /* polished wood */
};

static MOVABLE rt_scene scene_triangles = {.spheres = room_spheres,
                                           .sphere_count = 8,
                                           .bvh = &room_trees[ON_THE_FLOOR],
                                           .lamps = &room_lamp,
                                           .lamp_count = 1,
                                           .surfaces = mesh_surfaces,
                                           .meshes = &room_meshes[ON_THE_FLOOR],
                                           .mesh_count = 1};

static MOVABLE rt_scene scene_own_shape = {.spheres = room_spheres,
                                           .sphere_count = 8,
                                           .bvh = &room_trees[ON_THE_PEDESTAL],
                                           .lamps = &room_lamp,
                                           .lamp_count = 1,
                                           .surfaces = mesh_surfaces,
                                           .meshes = &room_meshes[ON_THE_PEDESTAL],
                                           .mesh_count = 1,
                                           .custom_shapes = &room_pedestal,
                                           .custom_shape_count = 1};

/* The teapot, turned a little. */
static inline void room_make_teapot(void)
{
    static rt_vec3 positions[TEAPOT_POSITIONS];
    static int indices[3 * TEAPOT_TRIANGLES];
    teapot pot = {positions, indices, 0, 0};
    teapot_make(&pot);
    for (int i = 0; i < pot.position_count; i++) {
        const rt_vec3 p = positions[i];
        positions[i] = rt_vec(0.6f * p.x - 0.8f * p.z, p.y, 0.8f * p.x + 0.6f * p.z);
    }
    room_model.positions = positions;
    room_model.indices = indices;
    room_model.position_count = pot.position_count;
    room_model.triangle_count = pot.triangle_count;
}

/* Take a mesh in place of the teapot, and make it as large: its lowest point stands on
 * the floor, or on the pedestal. The arrays must stay. */
static inline void room_take_mesh(const rt_mesh *mesh)
{
    rt_dvec3 low = {DBL_MAX, DBL_MAX, DBL_MAX}, high = {-DBL_MAX, -DBL_MAX, -DBL_MAX};
    for (int i = 0; i < mesh->position_count; i++) {
        const rt_dvec3 p = rt_to_double(mesh->positions[i]);
        low = rt_dvec(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = rt_dvec(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    const rt_dvec3 size = rt_dsub(high, low);
    room_model.name = "the mesh";
    room_model.positions = mesh->positions;
    room_model.indices = mesh->indices;
    room_model.position_count = mesh->position_count;
    room_model.triangle_count = mesh->triangle_count;
    room_model.foot =
        rt_to_float(rt_dvec(0.5 * (low.x + high.x), low.y, 0.5 * (low.z + high.z)));
    room_model.scale = (float)(22 / fmax(fmax(size.x, size.y), size.z));
}

/* Where its foot stands. */
static inline rt_vec3 room_mesh_place(int which)
{
    const float up = which == ON_THE_PEDESTAL ? room_cylinder.height + 0.01f : 0.0f;
    return rt_add(room_foot, rt_vec(0, up, 0));
}

/* Put the mesh where it stands in one of the two scenes, and build the tree anew: before
 * the first picture, and whenever something has moved. If memory runs out, rt_render
 * refuses the scene. */
static inline void room_prepare(int which)
{
    static rt_vec3 *placed[MESH_SCENES];
    const rt_scene *scenes[MESH_SCENES] = {&scene_triangles, &scene_own_shape};
    if (!room_model.positions)
        room_make_teapot();
    const rt_vec3 *model = room_model.positions;
    const int count = room_model.position_count;
    const rt_vec3 to = room_mesh_place(which);
    const float R = room_cylinder.radius;
    room_pedestal.min = rt_sub(room_cylinder.base, rt_vec(R, 0, R));
    room_pedestal.max = rt_add(room_cylinder.base, rt_vec(R, room_cylinder.height, R));
    rt_free_bvh(&room_trees[which]);
    if (room_meshes[which].position_count != count) {
        free(placed[which]);
        placed[which] = malloc((size_t)(count + 1) * sizeof(rt_vec3));
        room_meshes[which].position_count = 0;
    }
    if (!placed[which] || !model)
        return;
    for (int i = 0; i < count; i++) {
        const rt_vec3 p = rt_sub(model[i], room_model.foot);
        placed[which][i] = rt_add(to, rt_scale(p, room_model.scale));
    }
    room_meshes[which] = (rt_mesh){.positions = placed[which],
                                   .indices = room_model.indices,
                                   .position_count = count,
                                   .triangle_count = room_model.triangle_count,
                                   .material = {{0.88f, 0.87f, 0.84f}, false}};
    rt_build_bvh(scenes[which], &room_trees[which]);
}

#endif /* __cplusplus */
#endif

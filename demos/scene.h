/* The room of the report, built up chapter by chapter.
 *
 * Its walls are the outsides of giant spheres: close by, a sphere of radius 940 is almost a
 * plane. Lengths are in units of which the room is 100 wide and 60 high (about feet).
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
#endif

/* In the window things can be moved; live.h has no const here. */
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

/* Part two. Surfaces have the numbers of the shapes: the spheres above, then the cube. */
enum {
    ROOM_BALL = 0,
    ROOM_FLOOR = 4,
    ROOM_MIRROR = 6,
    ROOM_GLASS,
    ROOM_CUBE,
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

/* In the evening: the sun stands low before the open side of the room, and the sky above it is
 * yellow at the horizon and blue higher up. */
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

#endif /* __cplusplus */
#endif

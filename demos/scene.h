/* The room of the report, built up chapter by chapter.
 *
 * Its walls are the outsides of giant spheres: close by, a sphere of radius 940 is almost a
 * plane. Lengths are in units of which the room is 100 wide and 60 high (about feet).
 *
 *     y (up)          The spheres are in the order in which the chapters need them, so that
 *     |               a scene is the first few of them: chapter 1 takes one, chapter 2 adds
 *     +---- x         the five walls, chapter 3 the cube, chapter 6 the mirror.
 *    /
 *   z (to the viewer) */
#ifndef SCENE_H
#define SCENE_H

#include "../rt.h"

/* In the window things can be moved; live.h has no const here. */
#ifndef MOVABLE
#define MOVABLE const
#endif

static MOVABLE rt_sphere room_spheres[7] = {
    {{-20, -4.242709f, 8}, 16, {{0.85f, 0.10f, 0.08f}, false}}, /* red sphere, in front */
    {{-990, 0, 0}, 940, {{0.15f, 0.60f, 0.15f}, false}},        /* left wall, green */
    {{0, 980, 0}, 940, {{0.65f, 0.12f, 0.10f}, false}},         /* ceiling, red */
    {{990, 0, 0}, 940, {{0.15f, 0.25f, 0.70f}, false}},         /* right wall, blue */
    {{0, -960, 0}, 940, {{0.80f, 0.80f, 0.80f}, false}},        /* floor, white */
    {{0, 0, -1000}, 940, {{0.50f, 0.50f, 0.50f}, false}},       /* back wall, grey */
    {{6, -2.772754f, -38}, 18, {{1, 1, 1}, true}}, /* mirror sphere, behind */
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

#endif

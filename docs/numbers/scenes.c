/* What is in the scenes of the demos, for docs/changed.sh. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

static void describe(const char *name, const rt_scene *scene)
{
    printf("scene_%s: %d sphere%s", name, scene->sphere_count,
           scene->sphere_count == 1 ? "" : "s");
    if (scene->box_count > 0)
        printf(", %d box", scene->box_count);
    for (int i = 0; i < scene->sphere_count; i++)
        if (scene->spheres[i].material.mirror)
            printf(", one of the spheres a mirror");
    for (int i = 0; i < scene->light_count; i++)
        printf(", a lamp of %g W/sr", scene->lights[i].intensity.x);
    for (int i = 0; scene->surfaces && i < scene->sphere_count; i++) {
        const rt_surface *s = &scene->surfaces[i];
        if (s->eta > 0)
            printf(", one of glass");
        if (s->shininess > 0)
            printf(", one with a gloss of %g", s->shininess);
        if (s->pattern)
            printf(", one with a pattern");
    }
    if (scene->box_count > 0 && scene->surfaces && scene->surfaces[ROOM_CUBE].eta > 0)
        printf(", the box of amber");
    if (scene->box_count > 0 && scene->surfaces && scene->surfaces[ROOM_CUBE].pattern)
        printf(", the box with a pattern");
    for (int i = 0; i < scene->mesh_count; i++)
        printf(", a mesh of %d triangles with a gloss of %g",
               scene->meshes[i].triangle_count, scene->surfaces[ROOM_MESH].shininess);
    if (scene->custom_shape_count > 0)
        printf(", a shape of one's own with a gloss of %g",
               scene->surfaces[ROOM_PEDESTAL].shininess);
    for (int i = 0; i < scene->lamp_count; i++)
        printf(", a lamp of radius %g and %g W/sr", scene->lamps[i].radius,
               scene->lamps[i].intensity.x);
    if (scene->sky)
        printf(", a sky");
    printf("\n");
}

int main(void)
{
    describe("sphere", &scene_sphere);
    describe("walls", &scene_walls);
    describe("cube", &scene_cube);
    describe("mirror", &scene_mirror);
    describe("indirect", &scene_indirect);
    describe("glass", &scene_glass);
    describe("lamps", &scene_lamps);
    describe("gloss", &scene_gloss);
    describe("sky", &scene_sky);
    describe("patterns", &scene_patterns);
    room_prepare(ON_THE_FLOOR);
    room_prepare(ON_THE_PEDESTAL);
    describe("triangles", &scene_triangles);
    describe("own_shape", &scene_own_shape);
}

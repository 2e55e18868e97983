/* What is in the scenes of the demos, for docs/changed.sh. */
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
    printf("\n");
}

int main(void)
{
    describe("sphere", &scene_sphere);
    describe("walls", &scene_walls);
    describe("cube", &scene_cube);
    describe("mirror", &scene_mirror);
    describe("indirect", &scene_indirect);
}

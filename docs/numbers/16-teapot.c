/* Chapter 16: the teapot of demo 16 in numbers. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

int main(void)
{
    room_prepare(ON_THE_FLOOR);
    const rt_mesh *mesh = scene_triangles.meshes;
    printf("triangles: %d\npositions: %d\n", mesh->triangle_count, mesh->position_count);
    printf("shared: %.1f\n", (double)(mesh->position_count * (int)sizeof(rt_vec3) +
                                      mesh->triangle_count * 3 * (int)sizeof(int)) /
                                 1e3);
    printf("alone: %.1f\n", (double)mesh->triangle_count * 3 * sizeof(rt_vec3) / 1e3);
}

/* Chapter 11: what is left of white light after the cube of amber in scene.h, straight through
 * two of its faces; and what passes a plain slab of glass, all ways together. */
#include "demos/scene.h"
#include <stdio.h>

int main(void)
{
    const rt_surface *amber = &glass_surfaces[ROOM_CUBE];
    const float d = room_cube.max.z - room_cube.min.z, f = rt_fresnel(1, amber->eta);
    const rt_vec3 once = rt_transmittance(amber->absorption, d);
    const rt_vec3 half = rt_transmittance(amber->absorption, d / 2);
    printf("side: %g\n", (double)d);
    printf("absorption: %g, %g and %g\n", (double)amber->absorption.x,
           (double)amber->absorption.y, (double)amber->absorption.z);
    printf("left: %.2f, %.2f and %.2f\n", (double)once.x, (double)once.y, (double)once.z);
    printf("half: %.2f, %.2f and %.2f\n", (double)half.x, (double)half.y, (double)half.z);
    printf("through: %.4f\n", (double)((1 - f) * (1 - f)));
    printf("slab: %.4f\n", (double)((1 - f) / (1 + f)));

    /* and by paths: a clear slab before a sky that is white behind it and black in front */
    const rt_box box = {{-50, -50, -6}, {50, 50, -4}, {{0, 0, 0}, false}};
    const rt_box wall = {{-50, -50, -9}, {50, 50, -8}, {{0, 0, 0}, false}};
    const rt_box boxes[2] = {box, wall};
    const rt_surface surfaces[2] = {{.eta = 1.5f}, {.emission = {1, 1, 1}}};
    const rt_scene scene = {.boxes = boxes, .box_count = 2, .surfaces = surfaces};
    const rt_ray ray = {{0, 0, 0}, {0, 0, -1}};
    double sum = 0;
    enum { N = 1000000 };
    for (uint32_t i = 0; i < N; i++) {
        rt_rng rng = rt_rng_start(i, 0, 0);
        sum += (double)rt_radiance_mis(&scene, &ray, 50, &rng).x;
    }
    printf("slab-paths: %.3f\n", sum / N);
}

/* Chapter 4, exercise 3: what part of the lit points shadows itself? */
#include "demos/scene.h"
#include <stdio.h>

int main(void)
{
    const float steps[5] = {0, 0.25f, 0.5f, 1, 8};
    const rt_vec3 S = room_light.position;
    int lit = 0, cube = 0, lost[5] = {0}, cube_lost = 0;
    for (int y = 0; y < 480; y++)
        for (int x = 0; x < 640; x++) {
            const rt_ray ray = rt_camera_ray(&room_camera, 640, 480, x + 0.5f, y + 0.5f);
            rt_hit hit;
            if (!rt_intersect(&scene_cube, &ray, &hit) ||
                rt_dot(hit.normal, rt_sub(S, hit.point)) <= 0 ||
                !rt_visible(&scene_cube, hit.point, hit.normal, S))
                continue;
            const rt_vec3 P = hit.point;
            const float size =
                fmaxf(fmaxf(fabsf(P.x), fabsf(P.y)), fmaxf(fabsf(P.z), 1.0f));
            const bool on_cube = hit.material == &room_cube.material;
            lit++;
            cube += on_cube;
            for (int i = 0; i < 5; i++) {
                const float step = steps[i] * FLT_EPSILON * size;
                rt_ray shadow = {rt_add(P, rt_scale(hit.normal, step)), {0, 0, 0}};
                shadow.direction = rt_sub(S, shadow.origin);
                const bool dark = rt_occluded(&scene_cube, &shadow, 1);
                lost[i] += dark;
                cube_lost += dark && on_cube && i == 0;
            }
        }
    printf("lit: %d\ncube: %d\ncube-lost: %d\n| $`k`$ |", lit, cube, cube_lost);
    for (int i = 0; i < 5; i++)
        printf(" %g |", steps[i]);
    printf("\n|---|---|---|---|---|---|\n| shadow themselves |");
    for (int i = 0; i < 5; i++)
        printf(" %.2f %% |", 100.0 * lost[i] / lit);
    printf("\n");
}

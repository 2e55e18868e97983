/* Chapter 2, exercises 2 and 3: the floor below the lamp, and how far a wall bends. */
#include "demos/scene.h"
#include <stdio.h>

static float below(rt_vec3 S)
{
    const rt_ray down = {S, {0, -1, 0}};
    rt_hit hit;
    rt_intersect(&scene_walls, &down, &hit);
    const rt_vec3 light = rt_lambert(hit.material->albedo, hit.normal,
                                     rt_sub(S, hit.point), room_light.intensity);
    if (S.y == room_light.position.y)
        printf("prints: `d %g, light %g, byte %d`\n", hit.t, light.x,
               rt_encode(light.x, 1));
    return light.x;
}

static float bend(float R)
{
    const rt_sphere floor = {{0, -20 - R, 0}, R, {{1, 1, 1}, false}};
    const rt_ray ray = {{50, 0, 0}, {0, -1, 0}};
    rt_hit hit;
    rt_hit_sphere(&floor, &ray, FLT_MAX, &hit);
    return hit.t - 20;
}

int main(void)
{
    const rt_vec3 S = room_light.position, lower = {S.x, S.y - 25, S.z};
    const float one = below(S), two = below(lower);
    printf("lower: %g\ntimes: %.2f\n", two, two / one);
    printf("bend: %g\nflatter: %g\n", bend(940), bend(125000));
}

/* Chapter 6: the light that no path finds: from the lamp to a mirror, and from there to a
 * diffuse surface. All shares are parts of the power that diffuse surfaces get from the lamp
 * without another diffuse surface in between, directly and by way of the mirror.
 *
 * Wall: a closed box whose wall at the greatest x is a mirror. Random points of the other
 * five walls get cosine / d^2 from the lamp, and as much from its image behind the
 * mirror. The box is convex, so every point sees both. Cube: the lamp is in the middle,
 * so the share must be 1/6. Room: the box 100 x 60 x 165 around the room of scene.h, with
 * its lamp.
 *
 * Ball: the room of scene.h itself. Rays leave its lamp equally in all directions, each
 * with the same power, and are reflected until they meet a diffuse surface. What leaves
 * the room through its open side is not counted. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { N = 4000000 };

/* What a point gets from a lamp, up to a factor. */
static double get(rt_vec3 point, rt_vec3 normal, rt_vec3 lamp)
{
    const rt_vec3 to_lamp = rt_sub(lamp, point);
    const double d = (double)rt_length(to_lamp);
    return (double)rt_dot(normal, to_lamp) / (d * d * d);
}

static double wall(rt_vec3 min, rt_vec3 max, rt_vec3 lamp)
{
    const rt_vec3 size = rt_sub(max, min);
    const rt_vec3 image = rt_vec(2 * max.x - lamp.x, lamp.y, lamp.z);
    const float yz = size.y * size.z, zx = size.z * size.x, xy = size.x * size.y;
    const float areas[5] = {yz, zx, zx, xy, xy};
    const rt_vec3 normals[5] = {{1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
    rt_rng rng = rt_rng_start(0, 0, 0);
    double direct = 0, by_mirror = 0;
    for (int i = 0; i < N; i++) {
        const rt_vec3 n = normals[i % 5];
        const float x = rt_random(&rng), y = rt_random(&rng), z = rt_random(&rng);
        rt_vec3 p = rt_vec(min.x + x * size.x, min.y + y * size.y, min.z + z * size.z);
        p.x = n.x != 0 ? min.x : p.x;
        p.y = n.y != 0 ? (n.y > 0 ? min.y : max.y) : p.y;
        p.z = n.z != 0 ? (n.z > 0 ? min.z : max.z) : p.z;
        direct += (double)areas[i % 5] * get(p, n, lamp);
        by_mirror += (double)areas[i % 5] * get(p, n, image);
    }
    return 100 * by_mirror / (direct + by_mirror);
}

static double ball(void)
{
    rt_rng rng = rt_rng_start(0, 0, 0);
    int direct = 0, by_mirror = 0;
    for (int i = 0; i < N; i++) {
        const float z = 1 - 2 * rt_random(&rng);
        float s, c;
        rt_sincos(rt_random(&rng), &s, &c);
        const float r = sqrtf(1 - z * z);
        rt_ray ray = {room_light.position, {r * c, r * s, z}};
        rt_hit hit;
        int mirrors = 0;
        while (rt_intersect(&scene_mirror, &ray, &hit)) {
            if (!hit.material->mirror) {
                *(mirrors > 0 ? &by_mirror : &direct) += 1;
                break;
            }
            mirrors++;
            ray.direction = rt_reflect(ray.direction, hit.normal);
            ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
        }
    }
    return 100.0 * by_mirror / (direct + by_mirror);
}

int main(void)
{
    printf("cube: %.1f\n", wall(rt_vec(-1, -1, -1), rt_vec(1, 1, 1), rt_vec(0, 0, 0)));
    printf("room: %.1f\n",
           wall(rt_vec(-50, -20, -60), rt_vec(50, 40, 105), room_light.position));
    printf("ball: %.1f\n", ball());
}

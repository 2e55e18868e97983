/* Chapters 11 and 12: where the lamp's light goes in the room of scene.h. Rays leave the
 * lamp, a point, equally in all directions, each with the same power, and go on by
 * mirrors and glass (by the coin, and what the amber leaves) until they meet a matt
 * surface. What leaves the room through its open side is not counted. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { N = 4000000 };

int main(void)
{
    rt_rng rng = rt_rng_start(0, 0, 0);
    double direct = 0, by_mirror = 0, by_glass = 0;
    for (int i = 0; i < N; i++) {
        const float z = 1 - 2 * rt_random(&rng);
        float s, c;
        rt_sincos(rt_random(&rng), &s, &c);
        const float r = sqrtf(1 - z * z);
        rt_ray ray = {room_dim_light.position, {r * c, r * s, z}};
        rt_hit hit;
        int mirrors = 0, glasses = 0;
        double power = 1;
        for (int k = 0; k < 1000 && rt_intersect(&scene_glass, &ray, &hit); k++) {
            const rt_surface *surface = rt_surface_of(&scene_glass, &hit);
            rt_vec3 next = rt_reflect(ray.direction, hit.normal);
            if (surface->eta > 0) {
                const bool inside = rt_is_inside(&scene_glass, &hit);
                const float eta = inside ? 1 / surface->eta : surface->eta;
                glasses++;
                if (inside) {
                    const rt_vec3 left = rt_transmittance(surface->absorption, hit.t);
                    power *= (double)(left.x + left.y + left.z) / 3;
                }
                if (rt_random(&rng) >=
                    rt_fresnel(-rt_dot(ray.direction, hit.normal), eta))
                    rt_refract(ray.direction, hit.normal, eta, &next);
            } else if (hit.material->mirror) {
                mirrors++;
            } else {
                *(glasses > 0 ? &by_glass : mirrors > 0 ? &by_mirror : &direct) += power;
                break;
            }
            ray.origin = rt_leave(hit.point, hit.normal, next);
            ray.direction = next;
        }
    }
    const double all = direct + by_mirror + by_glass;
    printf("glass: %.1f\nmirror: %.1f\nboth: %.1f\n", 100 * by_glass / all,
           100 * by_mirror / all, 100 * (by_glass + by_mirror) / all);
}

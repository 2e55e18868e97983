/* Demo 06: a mirror.
 *
 * Before  every surface sends light in all directions.
 * Now     the sphere at the back is a mirror: reflect the ray, and ask again what it
 *         meets. Two mirrors could go on for ever, so the ray is sent on 5 times at most;
 *         with one mirror, as here, once is enough.
 * Run     make demo06 */
#include "live.h"

/* R = I - 2 <I,N> N: the part of I along N is reversed. */
static rt_vec3 reflect(rt_vec3 I, rt_vec3 N)
{
    return rt_sub(I, rt_scale(N, 2.0f * rt_dot(I, N)));
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    for (int bounce = 0; bounce <= view->bounces; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(&scene_mirror, &ray, &hit))
            break;
        if (!hit.material->mirror)
            return rt_direct(&scene_mirror, &hit, rng);
        const rt_vec3 direction = reflect(ray.direction, hit.normal);
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
    return rt_vec(0, 0, 0); /* out of the room, or out of bounces */
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo06",
                             .title = "6. A mirror",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 6,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 5});
}

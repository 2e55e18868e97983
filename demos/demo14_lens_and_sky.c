/* Demo 14: a lens and a sky.
 *
 * Before  the camera is a pinhole: all is sharp. Where the room is open, it is black.
 * Now     it has a lens: what is as far away as the ball of glass is sharp. Outside it is
 *         evening; the sun is a lamp, far away. Its light is much brighter than a screen
 *         can show, so the bytes follow the curve of a film.
 * Run     make demo14                                      (or ARGS="--exposure -1") */
#include "live.h"

/* The ray through a random point of the lens that meets the pinhole's ray where it is sharp. */
static rt_ray lens_ray(const rt_camera *camera, const rt_lens *lens, rt_ray ray, float r1,
                       float r2)
{
    const rt_vec3 forward = rt_normalize(camera->direction);
    const rt_vec3 right = rt_normalize(rt_cross(camera->direction, camera->up));
    const rt_vec3 top = rt_cross(right, forward);
    const rt_vec3 sharp =
        rt_scale(ray.direction, lens->focus / rt_dot(ray.direction, forward));
    const float radius = lens->radius * sqrtf(r2);
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const rt_vec3 aside =
        rt_add(rt_scale(right, radius * cosine), rt_scale(top, radius * sine));
    ray.origin = rt_add(ray.origin, aside);
    ray.direction = rt_normalize(rt_sub(sharp, aside));
    return ray;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    const float r1 = rt_random(rng);
    const float r2 = rt_random(rng);
    const rt_ray bent = lens_ray(&room_camera, &room_lens, ray, r1, r2);
    return rt_radiance_mis(&scene_sky, &bent, view->bounces, rng);
}

/* The more light a film has had, the less it is blackened by more: 1 - e^-v. */
static unsigned char encode(float value)
{
    return rt_encode((float)(1 - exp(-(double)value)), 2.2);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo14",
                             .title = "14. A lens and a sky",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 11,
                             .encode = encode,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

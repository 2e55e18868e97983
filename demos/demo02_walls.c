/* Demo 02: walls.
 *
 * Before  one sphere, a flat disc.
 * Now     six spheres: five of them so large that they pass for walls. The ray asks all and
 *         keeps the nearest hit; a lamp and Lambert's law make it look solid.
 * Run     make demo02 */
#include "live.h"

/* The nearest hit: each sphere is only asked for something nearer than the best so far. */
static bool nearest(const rt_scene *scene, const rt_ray *ray, rt_hit *hit)
{
    float t_max = FLT_MAX;
    for (int i = 0; i < scene->sphere_count; i++)
        if (rt_hit_sphere(&scene->spheres[i], ray, t_max, hit))
            t_max = hit->t;
    return t_max < FLT_MAX;
}

/* rho/pi . I . <N,L> / d^2, for the light at P + to_light; nothing from behind. */
static rt_vec3 lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                       rt_vec3 intensity)
{
    const float pi = 3.14159265f;
    const float d = rt_length(to_light);
    if (d == 0.0f)
        return rt_vec(0, 0, 0);
    const float cosine = rt_dot(normal, rt_scale(to_light, 1.0f / d));
    if (cosine <= 0.0f)
        return rt_vec(0, 0, 0);
    return rt_scale(rt_mul(albedo, intensity), cosine / (pi * d * d));
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    const rt_light *light = &scene_walls.lights[0];
    rt_hit hit = {0};
    rng->rays++;
    if (!nearest(&scene_walls, &ray, &hit))
        return rt_vec(0, 0, 0);
    const rt_vec3 to_light = rt_sub(light->position, hit.point);
    return lambert(hit.material->albedo, hit.normal, to_light, light->intensity);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo02",
                             .title = "2. Walls, and Lambert's law",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 2,
                             .encode = demo_linear,
                             .samples = 16});
}

/* Demo 04: shadows.
 *
 * Before  light goes through everything.
 * Now     a second ray, from the point towards the lamp: if it meets anything on the way,
 *         the point gets no light. Two details decide whether it works: where this ray
 *         starts, and where it ends.
 * Run     make demo04 */
#include "live.h"

/* Does the lamp at S see the point P of a surface with normal N? */
static bool visible(const rt_scene *scene, rt_vec3 P, rt_vec3 N, rt_vec3 S)
{
    /* Start a little above the surface: P is rounded and may lie just below it, where the
     * ray would hit the surface that it leaves. The step is 8 roundings of the largest
     * coordinate. */
    const float size = fmaxf(fmaxf(fabsf(P.x), fabsf(P.y)), fmaxf(fabsf(P.z), 1.0f));
    const float above = rt_dot(N, rt_sub(S, P)) < 0.0f ? -1.0f : 1.0f;
    rt_ray shadow;
    shadow.origin = rt_add(P, rt_scale(N, above * 8.0f * FLT_EPSILON * size));

    /* Not normalised: the lamp is at t = 1, and what lies behind it does not count. */
    shadow.direction = rt_sub(S, shadow.origin);

    rt_hit hit;
    for (int i = 0; i < scene->sphere_count; i++)
        if (rt_hit_sphere(&scene->spheres[i], &shadow, 1.0f, &hit))
            return false;
    for (int i = 0; i < scene->box_count; i++)
        if (rt_hit_box(&scene->boxes[i], &shadow, 1.0f, &hit))
            return false;
    return true;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    const rt_light *light = &scene_cube.lights[0];
    rt_hit hit;
    rng->rays++;
    if (!rt_intersect(&scene_cube, &ray, &hit))
        return rt_vec(0, 0, 0);
    rng->rays++;
    if (!visible(&scene_cube, hit.point, hit.normal, light->position))
        return rt_vec(0, 0, 0);
    const rt_vec3 to_light = rt_sub(light->position, hit.point);
    return rt_lambert(hit.material->albedo, hit.normal, to_light, light->intensity);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo04",
                             .title = "4. Shadows",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 4,
                             .encode = demo_linear,
                             .samples = 16});
}

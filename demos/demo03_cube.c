/* Demo 03: a cube.
 *
 * Before  spheres only.
 * Now     a box: the part of the ray between two planes, three times over. What all three
 *         parts have in common is inside the box; the last plane entered gives the normal.
 * Run     make demo03 */
#include "live.h"

static bool hit_box(const rt_box *box, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const float C[3] = {ray->origin.x, ray->origin.y, ray->origin.z};
    const float u[3] = {ray->direction.x, ray->direction.y, ray->direction.z};
    const float B0[3] = {box->min.x, box->min.y, box->min.z};
    const float B1[3] = {box->max.x, box->max.y, box->max.z};
    float t_in = -FLT_MAX, t_out = FLT_MAX; /* the ray is inside for t_in < t < t_out */
    int axis_in = 0, axis_out = 0;
    for (int k = 0; k < 3; k++) {
        if (u[k] == 0.0f) { /* parallel to these two planes: between them, or never */
            if (C[k] < B0[k] || C[k] > B1[k])
                return false;
            continue;
        }
        const float t0 = (B0[k] - C[k]) / u[k];
        const float t1 = (B1[k] - C[k]) / u[k];
        if (fminf(t0, t1) > t_in) {
            t_in = fminf(t0, t1);
            axis_in = k;
        }
        if (fmaxf(t0, t1) < t_out) {
            t_out = fmaxf(t0, t1);
            axis_out = k;
        }
    }
    const float t = t_in > 0.0f ? t_in : t_out; /* from inside we see the way out */
    const int axis = t_in > 0.0f ? axis_in : axis_out;
    if (t_in > t_out || t <= 0.0f || t >= t_max)
        return false;
    const float against = u[axis] > 0.0f ? -1.0f : 1.0f;
    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal =
        rt_vec(axis == 0 ? against : 0, axis == 1 ? against : 0, axis == 2 ? against : 0);
    hit->material = &box->material;
    return true;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    const rt_light *light = &scene_walls.lights[0];
    rt_hit hit = {.t = FLT_MAX};
    rng->rays++;
    const bool wall = rt_intersect(&scene_walls, &ray, &hit);
    if (!hit_box(&room_cube, &ray, hit.t, &hit) && !wall)
        return rt_vec(0, 0, 0);
    const rt_vec3 to_light = rt_sub(light->position, hit.point);
    return rt_lambert(hit.material->albedo, hit.normal, to_light, light->intensity);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo03",
                             .title = "3. A cube",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 3,
                             .encode = demo_linear,
                             .samples = 16});
}

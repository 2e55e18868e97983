/* Chapter 3, exercises 3 and 4: walls that are flat, and a cube that is turned. */
#include "demos/scene.h"
#include <stdio.h>

/* The first row whose centre shows the first shape of the scene. */
static int first_row(const rt_scene *scene, const rt_material *floor, int column)
{
    for (int row = 0; row < 480; row++) {
        const rt_ray ray =
            rt_camera_ray(&room_camera, 640, 480, column + 0.5f, row + 0.5f);
        rt_hit hit;
        if (rt_intersect(scene, &ray, &hit) && hit.material == floor)
            return row;
    }
    return -1;
}

static bool hit_turned(const rt_box *box, float turns, const rt_ray *ray, rt_hit *hit)
{
    float s, c;
    rt_sincos(turns, &s, &c);
    const rt_vec3 M = rt_scale(rt_add(box->min, box->max), 0.5f);
    const rt_vec3 o = rt_sub(ray->origin, M), u = ray->direction;
    const rt_ray back = {
        rt_add(M, rt_vec(c * o.x - s * o.z, o.y, s * o.x + c * o.z)),
        {c * u.x - s * u.z, u.y, s * u.x + c * u.z},
    };
    if (!rt_hit_box(box, &back, FLT_MAX, hit))
        return false;
    const rt_vec3 n = hit->normal;
    hit->normal = rt_vec(c * n.x + s * n.z, n.y, c * n.z - s * n.x);
    hit->point = rt_at(ray, hit->t);
    return true;
}

/* Its area in square units, seen along u by 400 x 400 rays about its middle. */
static int area(int degrees, rt_vec3 u)
{
    const rt_vec3 M = rt_scale(rt_add(room_cube.min, room_cube.max), 0.5f);
    const rt_vec3 right = {1, 0, 0}, up = {0, u.z, -u.y};
    int hits = 0;
    for (int i = -200; i < 200; i++)
        for (int j = -200; j < 200; j++) {
            const rt_vec3 across = rt_add(rt_scale(right, 0.1f * (i + 0.5f)),
                                          rt_scale(up, 0.1f * (j + 0.5f)));
            const rt_ray ray = {rt_add(M, rt_sub(across, rt_scale(u, 60))), u};
            rt_hit hit;
            hits += hit_turned(&room_cube, degrees / 360.0f, &ray, &hit);
        }
    return (int)(0.01 * hits + 0.5);
}

int main(void)
{
    const rt_box planes[2] = {
        {{-1000, -1000, -1000}, {1000, -20, 1000}, {{0.8f, 0.8f, 0.8f}, false}},
        {{-1000, -1000, -1000}, {1000, 1000, -60}, {{0.5f, 0.5f, 0.5f}, false}},
    };
    const rt_scene flat = {.boxes = planes, .box_count = 2};
    const rt_scene round = {.spheres = room_spheres + 4, .sphere_count = 2};
    printf("| column | 120 | 220 | 320 | 420 | 520 |\n|---|---|---|---|---|---|\n"
           "| two boxes |");
    for (int column = 120; column <= 520; column += 100)
        printf(" %d |", first_row(&flat, &planes[0].material, column));
    printf("\n| two spheres |");
    for (int column = 120; column <= 520; column += 100)
        printf(" %d |", first_row(&round, &room_spheres[4].material, column));
    printf("\n");
    const rt_vec3 down = {0, -1, 0}, back = {0, 0, -1};
    for (int degrees = 0; degrees <= 90; degrees += 30)
        printf("above%d: %d\nfront%d: %d\n", degrees, area(degrees, down), degrees,
               area(degrees, back));
    const rt_ray middle = {{28.5f, -11, 60}, back};
    rt_hit hit;
    hit_turned(&room_cube, 30 / 360.0f, &middle, &hit);
    const float t = hit.t;
    const rt_ray right = {{30.5f, -11, 60}, back};
    hit_turned(&room_cube, 30 / 360.0f, &right, &hit);
    printf("slope: %.3f\n", hit.normal.x > 0 ? hit.t - t : t - hit.t);
}

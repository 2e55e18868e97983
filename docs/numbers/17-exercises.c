/* Chapter 17, exercises: the volumes of tests/shapes.h, and what is computed by hand. */
#define RT_IMPLEMENTATION
#include "demos/shapes.h"
#include "tests/shapes.h"
#include "measure.h"
#include <stdio.h>

static double volume(rt_hit_function *hit, const void *data, rt_vec3 min, rt_vec3 max)
{
    const rt_custom_shape shape = {min, max, {{0, 0, 0}, false}, hit, data};
    return volume_of(&shape);
}

/* A ball of this radius with a hole along y, so wide that the rest has this height. */
static double with_a_hole(float radius, float height)
{
    const float half = height / 2, hole = sqrtf(radius * radius - half * half);
    const rt_sphere ball = {{0, 0, 0}, radius, {{0, 0, 0}, false}};
    const cylinder drill = {{0, -2 * radius, 0}, hole, 4 * radius};
    const rt_vec3 all = {radius, radius, radius}, wide = {hole, 2 * radius, hole};
    const rt_custom_shape a = {
        rt_scale(all, -1), all, {{0, 0, 0}, false}, ball_hit, &ball};
    const rt_custom_shape b = {
        rt_scale(wide, -1), wide, {{0, 0, 0}, false}, cylinder_hit, &drill};
    const pair without = {A_WITHOUT_B, &a, &b};
    return volume(pair_hit, &without, rt_scale(all, -1), all);
}

int main(void)
{
    const cylinder c = {{0, 0, 0}, 2, 3};
    printf("cylinder: %.2f\n",
           volume(cylinder_hit, &c, rt_vec(-2, 0, -2), rt_vec(2, 3, 2)));

    const plane floor = {{0, -1, 0}, {0, 1, 0}};
    const rt_ray down = {{0, 3, 0}, {1, -2, 0}}, flat = {{0, 3, 0}, {1, 0, 0}};
    rt_hit hit;
    const bool met = plane_hit(&floor, &down, FLT_MAX, &hit);
    printf("plane: %s t = %g, P = (%g, %g, %g)\n", met ? "hit" : "miss", hit.t,
           hit.point.x, hit.point.y, hit.point.z);
    printf("plane-flat: %s\n", plane_hit(&floor, &flat, FLT_MAX, &hit) ? "hit" : "miss");

    const cone tip = {{0, 0, 0}, 2, 3};
    const rt_ray ahead = {{0, 1.5f, -5}, {0, 0, 1}};
    printf("cone: %.2f\n", volume(cone_hit, &tip, rt_vec(-2, 0, -2), rt_vec(2, 3, 2)));
    cone_hit(&tip, &ahead, FLT_MAX, &hit);
    const rt_vec3 n = rt_normalize(hit.normal);
    printf("cone-hand: t = %g, N = (%.4f, %.4f, %.4f)\n", hit.t, n.x, n.y, n.z);

    const rt_box box = {{-0.5f, -1, -1.5f}, {0.5f, 1, 1.5f}, {{0, 0, 0}, false}};
    const rt_custom_shape own = {box.min, box.max, {{0, 0, 0}, false}, cube_hit, &box};
    const rt_vec3 z = rt_normalize(rt_vec(3, -1, 2));
    turned askew = {.middle = {5, 6, 7}, .z = z, .shape = &own};
    rt_basis(z, &askew.x, &askew.y);
    printf("box: %.2f\n", volume(turned_hit, &askew, rt_vec(3, 4, 5), rt_vec(7, 8, 9)));

    const rt_sphere ball = {{0, 0, 0}, 1, {{0, 0, 0}, false}};
    const rt_custom_shape round = {
        {-1, -1, -1}, {1, 1, 1}, {{0, 0, 0}, false}, ball_hit, &ball};
    const turned egg = {{0, 0, 0}, rt_scale(askew.x, 2), askew.y, rt_scale(z, 3), &round};
    printf("egg: %.2f\n", volume(turned_hit, &egg, rt_vec(-3, -3, -3), rt_vec(3, 3, 3)));

    const ring r = {{0, 0, 0}, 2, 0.5f};
    const field f = {ring_distance, &r};
    printf("ring: %.2f\n",
           volume(field_hit, &f, rt_vec(-2.5f, -0.5f, -2.5f), rt_vec(2.5f, 0.5f, 2.5f)));

    const float high = 2 * sqrtf(3);
    printf("napkin: %.2f\nnapkin-5: %.2f\n", with_a_hole(2, high), with_a_hole(5, high));
}

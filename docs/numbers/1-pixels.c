/* Chapter 1, exercises 2 and 4: how many pixels do a ball and a disc cover? */
#include "rt.h"
#include <stdio.h>

static bool hit_disc(rt_vec3 O, float R, rt_vec3 N, const rt_ray *ray)
{
    const float slope = rt_dot(ray->direction, N);
    const float t = rt_dot(rt_sub(O, ray->origin), N) / slope;
    return slope != 0 && t > 0 && rt_length(rt_sub(rt_at(ray, t), O)) <= R;
}

int main(void)
{
    const rt_sphere ball = {{0, 0, -5}, 1, {{1, 1, 1}, false}};
    const rt_camera camera = {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0};
    int covered = 0, facing = 0, turned = 0;
    for (int y = 0; y < 240; y++)
        for (int x = 0; x < 320; x++) {
            const rt_ray ray = rt_camera_ray(&camera, 320, 240, x + 0.5f, y + 0.5f);
            rt_hit hit;
            covered += rt_hit_sphere(&ball, &ray, FLT_MAX, &hit);
            facing += hit_disc(ball.center, 1, rt_vec(0, 0, 1), &ray);
            turned += hit_disc(ball.center, 1, rt_vec(sqrtf(0.5f), 0, sqrtf(0.5f)), &ray);
        }
    const double pixel = 2 * tan(22.5 * 3.14159265 / 180) / 240;
    printf("ball: %d\n", covered);
    printf("tangent: %.0f\n", 3.14159265 * (0.2 / pixel) * (0.2 / pixel));
    printf("facing: %d\nturned: %d\n", facing, turned);
}

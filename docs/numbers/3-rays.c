/* Chapter 3, exercise 2: where four rays meet a box. */
#include "rt.h"
#include <stdio.h>

int main(void)
{
    const rt_box box = {{2, 1, -1}, {4, 5, 1}, {{1, 1, 1}, false}};
    const rt_ray rays[4] = {{{0, 0, 0}, {3, 2, 1}},
                            {{0, 0, -5}, {0, 0, 1}},
                            {{3, 3, 0}, {0, 0, 2}},
                            {{0, 0, 0}, {2, 1, 0}}};
    const char *why[4] = {"", "", ": from inside", ": an edge, and x goes before y"};
    printf("| ray | *you are right if* |\n|---|---|\n");
    for (int i = 0; i < 4; i++) {
        const rt_vec3 C = rays[i].origin, u = rays[i].direction;
        rt_hit hit;
        printf("| from (%g, %g, %g) along (%g, %g, %g) | ", C.x, C.y, C.z, u.x, u.y, u.z);
        if (rt_hit_box(&box, &rays[i], FLT_MAX, &hit))
            printf("t = %g, P = (%g, %g, %g), N = (%g, %g, %g)%s |\n", hit.t, hit.point.x,
                   hit.point.y, hit.point.z, hit.normal.x, hit.normal.y, hit.normal.z,
                   why[i]);
        else
            printf("a miss |\n");
    }
}

/* Points all over the ball, also of its far side; a density that loses its digits, and that of
 * areas for the parallelogram; squares that overflow. */
#define rt_sample_lamp my_sample_lamp
#define rt_lamp_density my_lamp_density
#define rt_mis my_mis
#include "rt.h"

static inline rt_vec3 my_sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2)
{
    (void)point;
    const float z = 1 - 2 * r1, r = sqrtf(1 - z * z), turn = 6.2831853f * r2;
    if (lamp->radius == 0)
        return rt_add(lamp->center, rt_add(rt_scale(lamp->u, r1), rt_scale(lamp->v, r2)));
    return rt_add(lamp->center,
                  rt_scale(rt_vec(r * cosf(turn), r * sinf(turn), z), lamp->radius));
}

static inline float my_lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    (void)direction;
    const rt_vec3 way = rt_sub(lamp->center, point);
    if (lamp->radius == 0)
        return 1 / (4 * rt_length(rt_cross(lamp->u, lamp->v)));
    const float s = lamp->radius * lamp->radius / rt_dot(way, way);
    return 1 / (6.2831853f * (1 - sqrtf(1 - s)));
}

static inline float my_mis(float density, float other)
{
    return density * density / (density * density + other * other);
}

/* Right: lamps, with the two random numbers the other way round, and in double. */
#define rt_sample_lamp my_sample_lamp
#define rt_lamp_density my_lamp_density
#define rt_mis my_mis
#include "rt.h"

static inline rt_vec3 my_sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2)
{
    const rt_dvec3 p = rt_to_double(point), c = rt_to_double(lamp->center);
    if (lamp->radius == 0)
        return rt_to_float(rt_dmad(rt_dmad(c, 2 * (double)r2 - 1, rt_to_double(lamp->u)),
                                   1 - 2 * (double)r1, rt_to_double(lamp->v)));
    const rt_dvec3 way = rt_dsub(c, p);
    const double d = sqrt(rt_ddot(way, way)), r = (double)lamp->radius;
    const double cosine = 1 - (double)r1 * (1 - sqrt(1 - r * r / (d * d)));
    const double sine = sqrt(1 - cosine * cosine), turn = 6.283185307179586 * (double)r2;
    rt_vec3 a, b;
    rt_basis(rt_to_float(rt_dscale(way, 1 / d)), &a, &b);
    const rt_dvec3 u =
        rt_dmad(rt_dmad(rt_dscale(way, cosine / d), sine * cos(turn), rt_to_double(a)),
                sine * sin(turn), rt_to_double(b));
    const double half = r * r - d * d * sine * sine;
    return rt_to_float(rt_dmad(p, d * cosine - sqrt(half > 0 ? half : 0), u));
}

static inline float my_lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    const rt_dvec3 way = rt_dsub(rt_to_double(lamp->center), rt_to_double(point));
    const double dd = rt_ddot(way, way), r = (double)lamp->radius;
    if (r > 0)
        return dd <= r * r
                   ? 0
                   : (float)(1 / (6.283185307179586 * (1 - sqrt(1 - r * r / dd))));
    const rt_dvec3 n = rt_dcross(rt_to_double(lamp->u), rt_to_double(lamp->v));
    const double area = sqrt(rt_ddot(n, n)), along = rt_ddot(rt_to_double(direction), n);
    const double t = rt_ddot(way, n) / along;
    return (float)(t * t / (4 * fabs(along)) * (area > 0));
}

static inline float my_mis(float density, float other)
{
    const double a = (double)density, b = (double)other;
    return a > 0 ? (float)(a * a / (a * a + b * b)) : 0;
}

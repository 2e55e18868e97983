/* Right: glass in double. */
#define rt_fresnel my_fresnel
#define rt_refract my_refract
#include "rt.h"

static inline float my_fresnel(float cosine, float eta)
{
    const double c = (double)cosine, n = (double)eta, sine = sqrt(1 - c * c) / n;
    if (sine >= 1)
        return 1;
    const double i = acos(c), t = asin(sine);
    if (i < 1e-3)
        return (float)((n - 1) * (n - 1) / ((n + 1) * (n + 1)));
    const double s = sin(i - t) / sin(i + t), p = tan(i - t) / tan(i + t);
    return (float)((s * s + p * p) / 2);
}

static inline bool my_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted)
{
    const rt_dvec3 n = rt_to_double(normal), i = rt_to_double(incident);
    const rt_dvec3 flat = rt_dscale(rt_dmad(i, -rt_ddot(i, n), n), 1 / (double)eta);
    const double rest = 1 - rt_ddot(flat, flat);
    if (rest < 0)
        return false;
    *refracted = rt_to_float(rt_dmad(flat, -sqrt(rest), n));
    return true;
}

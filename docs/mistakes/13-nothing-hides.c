/* Facets that hide nothing
 *
 * Symptom: metal and lacquer are too bright towards their rims, and grainy: seen at a flat angle
 *          they send more light than they get
 * Cause:   D without G: facets that are hidden behind others count as seen and as lit
 * Cure:    D G(eye) G(light) / (4 <N,eye>)
 * Options:
 */
#define rt_gloss my_gloss
#include "rt.h"

static inline float my_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density)
{
    const float a2 = 2.0f / (shininess + 2.0f);
    const float eye = rt_dot(normal, to_eye), light = rt_dot(normal, to_light);
    const rt_vec3 h = rt_normalize(rt_add(to_eye, to_light)),
                  across = rt_cross(normal, h);
    const float up = rt_dot(normal, h), k = rt_dot(across, across) + a2 * up * up;
    const float facets = a2 / (3.14159265359f * k * k);
    *density = 0.0f;
    if (!(eye > 0.0f && light > 0.0f && up > 0.0f))
        return 0.0f;
    *density = facets / (2.0f * (eye + sqrtf(a2 + (1.0f - a2) * eye * eye)));
    return facets / (4.0f * eye);
}

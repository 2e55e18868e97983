/* The density of the facets for that of the directions
 *
 * Symptom: metal is far too dark, as if it reflected only a quarter of the light; the
 *          highlight of the lamp, which is aimed at, is as bright as it should be
 * Cause:   the density is the one with which a facet is chosen. The reflected direction
 *          turns by twice the angle, so its density is smaller, by the factor 4 <h,eye>
 * Cure:    density of the facet / (4 <h,eye>)
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
    const float seen = 2.0f * eye / (eye + sqrtf(a2 + (1.0f - a2) * eye * eye));
    const float lit = 2.0f * light / (light + sqrtf(a2 + (1.0f - a2) * light * light));
    *density = facets * seen * rt_dot(h, to_eye) / eye;
    return facets * seen * lit / (4.0f * eye);
}

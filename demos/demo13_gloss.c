/* Demo 13: gloss.
 *
 * Before  a surface is matt, or a perfect mirror.
 * Now     there is everything in between: tiny mirrors that do not all face the same way.
 *         The ball at the back becomes brushed metal, the red one gets a coat of lacquer.
 * Run     make demo13                                      (or ARGS="--samples 64") */
#define rt_sample_gloss sample_gloss
#define rt_gloss gloss
#include "live.h"

/* v, scaled to length 1. */
static rt_vec3 direction_of(rt_vec3 v)
{
    const float dd = rt_dot(v, v);
    return rt_scale(v, dd > 1e-20f ? 1 / sqrtf(dd) : 0);
}

/* Seen at this cosine to the normal, 2 cosine / this of the facets are not hidden. */
static float hidden(float cosine, float a2)
{
    return cosine + sqrtf(a2 + (1 - a2) * cosine * cosine);
}

/* The part of the light that facets send to the eye, and how likely sample_gloss chooses it. */
static float gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light, float shininess,
                   float *density)
{
    const float a2 = 2 / (shininess + 2);
    const float eye = rt_dot(normal, to_eye), light = rt_dot(normal, to_light);
    const rt_vec3 h = direction_of(rt_add(to_eye, to_light)); /* of facets that send it */
    const rt_vec3 across = rt_cross(normal, h);
    const float up = rt_dot(normal, h), k = rt_dot(across, across) + a2 * up * up;
    *density = 0;
    if (!(eye > 0 && light > 0 && up > 0))
        return 0;
    *density = a2 / (3.14159265359f * k * k) / (2 * hidden(eye, a2));
    return *density * (2 * light / hidden(light, a2));
}

/* The eye's ray, reflected by a facet that the eye sees. */
static rt_vec3 sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess, float r1,
                            float r2)
{
    const float a = sqrtf(2 / (shininess + 2));
    rt_vec3 x, y;
    rt_basis(normal, &x, &y);
    /* stretched by 1/a along the normal, the facets are those of a hemisphere */
    const rt_vec3 v = direction_of(
        rt_vec(a * rt_dot(x, to_eye), a * rt_dot(y, to_eye), rt_dot(normal, to_eye)));
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const float z = (1 - r2) * (1 + v.z) - v.z, zz = 1 - z * z;
    const float r = sqrtf(zz > 0 ? zz : 0);
    const rt_vec3 h = rt_vec(a * (r * cosine + v.x), a * (r * sine + v.y), z + v.z);
    const rt_vec3 facet = direction_of(
        rt_add(rt_add(rt_scale(x, h.x), rt_scale(y, h.y)), rt_scale(normal, h.z)));
    return rt_sub(rt_scale(facet, 2 * rt_dot(to_eye, facet)), to_eye);
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return rt_radiance_mis(&scene_gloss, &ray, view->bounces, rng);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo13",
                             .title = "13. Gloss",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 10,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

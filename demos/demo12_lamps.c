/* Demo 12: lamps with a size.
 *
 * Before  the lamp is a point, which no ray meets: mirrors and glass cast no light.
 * Now     it is a ball. A surface aims at a random point of it, and a ray may meet it by
 *         chance. Both ways count, each with a weight, so that nothing counts twice.
 * Run     make demo12                                      (or ARGS="--samples 64") */
#define rt_sample_lamp sample_lamp /* in rt.h, too: see "Your own routines" there */
#define rt_lamp_density lamp_density
#define rt_mis mis
#include "live.h"

/* Of all directions, the lamp takes up (1 - cos a) / 2, where sin a = R / d. */
static float one_minus_cosine(const rt_lamp *lamp, rt_vec3 point)
{
    const rt_vec3 to_center = rt_sub(lamp->center, point);
    const float s = lamp->radius * lamp->radius / rt_dot(to_center, to_center);
    return s / (1 + sqrtf(1 - s)); /* = 1 - sqrt(1 - s), but no digits are lost */
}

/* A point of the lamp, each direction to it as likely as any other. */
static rt_vec3 sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1, float r2)
{
    const rt_vec3 to_center = rt_sub(lamp->center, point);
    const float d = rt_length(to_center);
    const float down =
        r2 * one_minus_cosine(lamp, point); /* 1 - cosine of the direction */
    const float sine = sqrtf(down * (2 - down));
    float s, c;
    rt_sincos(r1, &s, &c);
    rt_vec3 a, b, n = rt_scale(to_center, 1 / d);
    rt_basis(n, &a, &b);
    const rt_vec3 direction = rt_add(rt_add(rt_scale(a, c * sine), rt_scale(b, s * sine)),
                                     rt_scale(n, 1 - down));
    const float off = d * sine, rest = lamp->radius * lamp->radius - off * off;
    const float t = d * (1 - down) - sqrtf(rest > 0 ? rest : 0); /* to its near side */
    return rt_add(point, rt_scale(direction, t));
}

/* The density of that choice, the same for all directions that meet the lamp. */
static float lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    (void)direction;
    return 1 / (6.28318530718f * one_minus_cosine(lamp, point));
}

/* How much a way of finding light counts, if another might have found it, too. */
static float mis(float density, float other)
{
    if (!(density > 1e-15f * other)) /* the square would be too large for a float */
        return 0;
    const float ratio = other / density;
    return 1 / (1 + ratio * ratio);
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return rt_radiance_mis(&scene_lamps, &ray, view->bounces, rng);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo12",
                             .title = "12. Lamps with a size",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 9,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

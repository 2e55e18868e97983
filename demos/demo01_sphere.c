/* Demo 01: a sphere.
 *
 * Before  a black window.
 * Now     every pixel asks one question: does my ray hit the sphere? Yes: the colour of the
 *         sphere. No: black. The picture is a flat disc; light comes in chapter 2.
 * Run     make demo01 */
#include "live.h"

/* The points C + t u of the ray at distance R from O: with f = C - O,
 * t^2 <u,u> + 2 t <f,u> + <f,f> - R^2 = 0. In double, so that giant spheres work, too. */
static bool hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                       rt_hit *hit)
{
    const rt_dvec3 u = rt_to_double(ray->direction);
    const rt_dvec3 O = rt_to_double(sphere->center);
    const rt_dvec3 f = rt_dsub(rt_to_double(ray->origin), O);
    const double R = (double)sphere->radius;

    const double a = rt_ddot(u, u);
    const double b = 2.0 * rt_ddot(f, u);
    const double c = rt_ddot(f, f) - R * R;
    const double discriminant = b * b - 4.0 * a * c;
    if (discriminant < 0.0)
        return false; /* the ray passes by */

    double t = (-b - sqrt(discriminant)) / (2.0 * a); /* the way in ... */
    if (t <= 0.0)
        t = (-b + sqrt(discriminant)) / (2.0 * a); /* ... or, from inside, the way out */
    if (t <= 0.0 || (float)t >= t_max)
        return false; /* the sphere is behind us, or too far away */

    const rt_dvec3 n = rt_dmad(f, t, u); /* P - O */
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(O, 1.0, n));
    hit->normal = rt_to_float(rt_dscale(n, 1.0 / R));
    if (rt_dot(hit->normal, ray->direction) > 0.0f)
        hit->normal = rt_scale(hit->normal, -1.0f); /* towards the side we come from */
    hit->material = &sphere->material;
    return true;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    rt_hit hit;
    rng->rays++;
    if (!hit_sphere(&scene_sphere.spheres[0], &ray, FLT_MAX, &hit))
        return rt_vec(0, 0, 0);
    return hit.material->albedo;
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo01",
                             .title = "1. A sphere",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 1,
                             .encode = demo_linear,
                             .samples = 16});
}

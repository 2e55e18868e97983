/* Demo 17: your own shape.
 *
 * Before  the shapes that rt.h knows.
 * Now     any shape, if you can say where a ray meets it first: a cylinder of wood, as a
 *         pedestal for the teapot.
 * Run     make demo17                              (or ARGS="--mesh bunny.obj") */
#include "live.h"

/* With O the middle of its foot and f = C - O, the ray is less than R from the axis while
 *
 *     (f_x + t u_x)^2 + (f_z + t u_z)^2 < R^2,
 *
 * and between the ends while 0 < f_y + t u_y < H. What both have in common is inside the
 * cylinder, as in chapter 3. */
static bool hit_cylinder(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const cylinder *c = data;
    const rt_dvec3 C = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const rt_dvec3 f = rt_dsub(C, rt_to_double(c->base));
    const double R = (double)c->radius, H = (double)c->height;
    const double a = u.x * u.x + u.z * u.z, b = f.x * u.x + f.z * u.z;
    const double q = f.x * f.x + f.z * f.z - R * R, d = b * b - a * q;
    if ((a > 0 ? d <= 0 : q > 0) || (u.y == 0 && (f.y < 0 || f.y > H)))
        return false; /* past it, whatever t is */
    double t_in = -DBL_MAX, t_out = DBL_MAX;
    bool end_in = false, end_out = false; /* by one of the ends? */
    if (a > 0) {
        t_in = (-b - sqrt(d)) / a;
        t_out = (-b + sqrt(d)) / a;
    }
    if (u.y != 0) {
        const double t0 = -f.y / u.y, t1 = (H - f.y) / u.y;
        end_in = fmin(t0, t1) > t_in;
        end_out = fmax(t0, t1) < t_out;
        t_in = fmax(t_in, fmin(t0, t1));
        t_out = fmin(t_out, fmax(t0, t1));
    }
    const double t = t_in > 0 ? t_in : t_out; /* from inside we see the way out */
    if (t_in >= t_out || !((float)t > 0 && (float)t < t_max))
        return false;
    const bool end = t_in > 0 ? end_in : end_out;
    const rt_dvec3 P = rt_dmad(f, t, u);
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(C, t, u));
    hit->normal = rt_to_float(end ? rt_dvec(0, P.y - H / 2, 0) : rt_dvec(P.x, 0, P.z));
    hit->part = end ? P.y > H / 2 ? 2 : 1 : 0; /* the side, the bottom, the top */
    return true;
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_own_shape, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    room_pedestal.hit = hit_cylinder;
    room_prepare(ON_THE_PEDESTAL);
    return demo_main(argc, argv,
                     &(demo){.name = "demo17",
                             .title = "17. Your own shape",
                             .render = render,
                             .mesh = room_take_mesh,
                             .live = &live_room,
                             .stage = 14,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

/* Demo 16: triangles.
 *
 * Before  spheres and boxes.
 * Now     25 440 triangles, which make a teapot. Seen along the ray a triangle is flat, and
 *         the ray is a point: it meets the triangle if it lies on the same side of all three
 *         edges. Or a model of your own: OBJ, PLY, STL or glTF.
 * Run     make demo16                              (or ARGS="--mesh bunny.obj") */
#define rt_hit_triangle hit_triangle /* in rt.h, too: see "Your own routines" there */
#include "live.h"

/* The corner as the ray sees it: the ray starts at the origin and runs straight along z,
 * the axis along which u is longest. A step of 1 along z is *step of t. */
static rt_dvec3 seen_from(const rt_ray *ray, rt_vec3 corner, double *step)
{
    const rt_dvec3 v = rt_to_double(ray->direction);
    const rt_dvec3 d = rt_dsub(rt_to_double(corner), rt_to_double(ray->origin));
    const double u[3] = {v.x, v.y, v.z}, p[3] = {d.x, d.y, d.z};
    const int longer = fabs(u[0]) >= fabs(u[1]) ? 0 : 1;
    const int z = fabs(u[longer]) >= fabs(u[2]) ? longer : 2;
    const int x = (z + 1) % 3, y = (z + 2) % 3;
    *step = u[z] != 0 ? 1 / u[z] : 0;
    return rt_dvec(p[x] - u[x] * *step * p[z], p[y] - u[y] * *step * p[z], p[z]);
}

static bool hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                         float t_max, rt_hit *hit)
{
    rt_dvec3 corner[3], v[3];
    double step;
    for (int k = 0; k < 3; k++) {
        corner[k] = rt_to_double(rt_corner(mesh, triangle, k));
        v[k] = seen_from(ray, rt_corner(mesh, triangle, k), &step);
    }
    double w[3]; /* on which side of the edge across from a corner is the ray? */
    for (int k = 0; k < 3; k++) {
        const rt_dvec3 a = v[(k + 1) % 3], b = v[(k + 2) % 3];
        w[k] = b.x * a.y - b.y * a.x;
    }
    const bool left = w[0] < 0 || w[1] < 0 || w[2] < 0;
    const bool right = w[0] > 0 || w[1] > 0 || w[2] > 0;
    const double sum = w[0] + w[1] + w[2];
    if ((left && right) || sum == 0)
        return false;
    const double t = (w[0] * v[0].z + w[1] * v[1].z + w[2] * v[2].z) * step / sum;
    const rt_dvec3 N = rt_dnormalize(
        rt_dcross(rt_dsub(corner[1], corner[0]), rt_dsub(corner[2], corner[0])));
    if (!((float)t > 0 && (float)t < t_max) || rt_ddot(N, N) == 0)
        return false;
    rt_dvec3 P = rt_dvec(0, 0, 0); /* w, made to add up to 1: so much of each corner */
    for (int k = 0; k < 3; k++) {
        w[k] *= 1 / sum;
        P = rt_dmad(P, w[k], corner[k]);
    }
    hit->t = (float)t;
    hit->point = rt_to_float(P);
    hit->inside = rt_ddot(N, rt_to_double(ray->direction)) > 0;
    hit->normal = rt_to_float(rt_dscale(N, hit->inside ? -1 : 1));
    hit->material = &mesh->material;
    hit->shape = 0;
    hit->part = triangle;
    hit->u = (float)w[1];
    hit->v = (float)w[2];
    return true;
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return rt_radiance_mis(&scene_triangles, &ray, view->bounces, rng);
}

int main(int argc, char **argv)
{
    room_prepare(ON_THE_FLOOR);
    return demo_main(argc, argv,
                     &(demo){.name = "demo16",
                             .title = "16. Triangles",
                             .pixel = pixel,
                             .mesh = room_take_mesh,
                             .live = &live_room,
                             .stage = 13,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

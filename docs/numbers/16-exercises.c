/* Chapter 16, its examples and exercises: a triangle by hand, leaks along edges, icospheres, smooth
 * normals, a mesh that is turned. */
#define RT_IMPLEMENTATION
#include "tests/meshes.h"

static rt_dvec3 across(const rt_mesh *mesh, int i)
{
    const rt_dvec3 a = rt_to_double(rt_corner(mesh, i, 0));
    return rt_dcross(rt_dsub(rt_to_double(rt_corner(mesh, i, 1)), a),
                     rt_dsub(rt_to_double(rt_corner(mesh, i, 2)), a));
}

static double area(const rt_mesh *mesh)
{
    double sum = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        const rt_dvec3 n = across(mesh, i);
        sum += sqrt(rt_ddot(n, n)) / 2;
    }
    return sum;
}

static double volume(const rt_mesh *mesh)
{
    double sum = 0;
    for (int i = 0; i < mesh->triangle_count; i++)
        sum += rt_ddot(across(mesh, i), rt_to_double(rt_corner(mesh, i, 0))) / 6;
    return sum;
}

/* T. Moeller and B. Trumbore, in float. */
static bool cramer(const rt_mesh *mesh, int i, const rt_ray *ray)
{
    const rt_vec3 a = rt_corner(mesh, i, 0);
    const rt_vec3 ab = rt_sub(rt_corner(mesh, i, 1), a);
    const rt_vec3 ac = rt_sub(rt_corner(mesh, i, 2), a);
    const rt_vec3 p = rt_cross(ray->direction, ac);
    const float det = rt_dot(ab, p);
    const rt_vec3 s = rt_sub(ray->origin, a), q = rt_cross(s, ab);
    const float u = rt_dot(s, p) / det, v = rt_dot(ray->direction, q) / det;
    return det != 0 && u >= 0 && v >= 0 && u + v <= 1 && rt_dot(ac, q) / det > 0;
}

static bool ours(const rt_mesh *mesh, int i, const rt_ray *ray)
{
    rt_hit hit;
    return rt_hit_triangle(mesh, i, ray, FLT_MAX, &hit);
}

/* rt.h's, but a b - c d is rounded once less, by fma, as a compiler may do. */
static bool contracted(const rt_mesh *mesh, int i, const rt_ray *ray)
{
    const rt__shear shear = rt__shear_of(ray);
    rt_dvec3 c[3];
    for (int k = 0; k < 3; k++)
        c[k] = rt__sheared(&shear, rt_corner(mesh, i, k));
    const double w_a = fma(c[2].x, c[1].y, -(c[2].y * c[1].x));
    const double w_b = fma(c[0].x, c[2].y, -(c[0].y * c[2].x));
    const double w_c = fma(c[1].x, c[0].y, -(c[1].y * c[0].x));
    if ((w_a < 0 || w_b < 0 || w_c < 0) && (w_a > 0 || w_b > 0 || w_c > 0))
        return false;
    return (w_a * c[0].z + w_b * c[1].z + w_c * c[2].z) * shear.z / (w_a + w_b + w_c) > 0;
}

typedef bool way(const rt_mesh *mesh, int i, const rt_ray *ray);

/* Rays from E, inside, to A + s (B - A) of each triangle, s = 0.05, 0.15 ... 0.95; or,
 * where all coordinates have few digits, exactly to the middle. How many meet no
 * triangle? */
static int leaks(const rt_mesh *mesh, rt_vec3 e, bool middle, way *hits)
{
    int count = 0;
    for (int i = 0; i < mesh->triangle_count; i++)
        for (int k = 0; k < (middle ? 1 : 10); k++) {
            const rt_vec3 a = rt_corner(mesh, i, 0), b = rt_corner(mesh, i, 1);
            const float s = middle ? 0.5f : (float)k / 10 + 0.05f;
            const rt_vec3 p = rt_add(a, rt_scale(rt_sub(b, a), s));
            const rt_ray ray = {e, rt_sub(p, e)};
            bool met = false;
            for (int j = 0; j < mesh->triangle_count && !met; j++)
                met = hits(mesh, j, &ray);
            count += !met;
        }
    return count;
}

/* The most by which the mixed normals of the corners differ from those of the
 * triangles. */
static double tilt(const rt_mesh *mesh)
{
    double most = 0;
    for (int i = 0; i < mesh->triangle_count; i++) {
        const rt_dvec3 n = rt_dnormalize(across(mesh, i));
        for (int k = 0; k < 3; k++) {
            const rt_dvec3 smooth = rt_dnormalize(rt_to_double(rt_corner(mesh, i, k)));
            const double angle = acos(rt_ddot(n, smooth)) * 57.29577951308232;
            most = angle > most ? angle : most;
        }
    }
    return most;
}

int main(void)
{
    static const rt_vec3 corners[3] = {{3, 1, 4}, {2, 4, 4}, {0, 2, 6}};
    static const int three[3] = {0, 1, 2};
    const rt_mesh one = {corners, three, 3, 1, {{0, 0, 0}, false}};
    const rt_ray ray = {{0, 0, 0}, {1, 1, 2}};
    rt_hit hit;
    rt_hit_triangle(&one, 0, &ray, FLT_MAX, &hit);
    printf("hand: t = %.4f, P = (%.4f, %.4f, %.4f), u = %.4f, v = %.4f\n", hit.t,
           hit.point.x, hit.point.y, hit.point.z, hit.u, hit.v);

    printf("| triangles | positions | volume | area | most tilt of a normal |\n");
    printf("|---|---|---|---|---|\n");
    for (int level = 0; level < 5; level++) {
        rt_mesh m = make_icosphere(level);
        printf("| %d | %d | %.4f | %.4f | %.1f° |\n", m.triangle_count, m.position_count,
               volume(&m), area(&m), tilt(&m));
        free_mesh(&m);
    }
    rt_mesh m = make_icosphere(3);
    const rt_vec3 e = {0.3f, 0.2f, 0.1f};
    printf("leak-rays: %d\nleaks-float: %d\nleaks-ours: %d\n", 10 * m.triangle_count,
           leaks(&m, e, false, cramer), leaks(&m, e, false, ours));

    rt_vec3 *p = (rt_vec3 *)(uintptr_t)m.positions;
    const double before = volume(&m);
    for (int i = 0; i < m.position_count; i++) /* a third of a turn around y, and away */
        p[i] = rt_vec(-0.5f * p[i].x + 0.8660254f * p[i].z + 10, p[i].y - 5,
                      -0.8660254f * p[i].x - 0.5f * p[i].z);
    printf("turned-volume: %.4f\nturned-differs: %.0e\n", volume(&m),
           fabs(volume(&m) / before - 1));
    free_mesh(&m);

    m = make_icosphere(3);
    p = (rt_vec3 *)(uintptr_t)m.positions;
    for (int i = 0; i < m.position_count; i++) /* few digits */
        p[i] = rt_vec(roundf(4096 * p[i].x) / 4096, roundf(4096 * p[i].y) / 4096,
                      roundf(4096 * p[i].z) / 4096);
    int with = 0, without = 0;
    for (int k = 0; k < 10; k++) {
        const rt_vec3 eye = {(float)k / 32, (float)(k * 7 % 10) / 32,
                             (float)(k * 3 % 10) / 64};
        with += leaks(&m, eye, true, contracted);
        without += leaks(&m, eye, true, ours);
    }
    printf("middle-rays: %d\nmiddle-contracted: %d\nmiddle-ours: %d\n",
           10 * m.triangle_count, with, without);
    free_mesh(&m);
}

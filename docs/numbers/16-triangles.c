/* Chapter 16: ways to meet a triangle, on the seven closed meshes of tests/exact.h, against
 * numbers that are not rounded. */
#define RT_IMPLEMENTATION
#include "tests/exact.h"

#define REAL float
#define NAME(way) way##_float
#include "16-ways.h"
#undef REAL
#undef NAME
#define REAL double
#define NAME(way) way##_double
#include "16-ways.h"

static bool cramer_epsilon(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                           float t_max, rt_hit *hit)
{
    return cramer_float(mesh, triangle, ray, 1e-6f, hit) && hit->t < t_max;
}

static bool cramer_0(const rt_mesh *mesh, int triangle, const rt_ray *ray, float t_max,
                     rt_hit *hit)
{
    return cramer_float(mesh, triangle, ray, 0, hit) && hit->t < t_max;
}

static bool cramer_twice(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                         float t_max, rt_hit *hit)
{
    return cramer_double(mesh, triangle, ray, 0, hit) && hit->t < t_max;
}

static bool sheared_in_float(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                             float t_max, rt_hit *hit)
{
    return sheared_float(mesh, triangle, ray, true, t_max, hit);
}

static bool sheared_outside(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                            float t_max, rt_hit *hit)
{
    return sheared_double(mesh, triangle, ray, false, t_max, hit);
}

int main(void)
{
    triangle_function *const ways[] = {cramer_epsilon,  cramer_0,
                                       cramer_twice,    sheared_in_float,
                                       sheared_outside, rt_hit_triangle};
    enum { WAYS = sizeof ways / sizeof *ways };
    static const char *const names[WAYS] = {
        "Möller and Trumbore, float, less than 1e-6 is parallel",
        "Möller and Trumbore, float",
        "Möller and Trumbore, double",
        "sheared, float",
        "sheared, double, but 0 is outside",
        "sheared, double: ours"};
    static const char *const keys[WAYS] = {"epsilon", "float",   "double",
                                           "sheared", "outside", "ours"};
    exact_count counts[WAYS] = {{0, 0, 0, 0}};
    exact_rays asked = {0, 0};
    for (int k = 0; k < EXACT_MESHES; k++) {
        exact_case c = make_exact_case(k);
        judge(&c, 500, ways, WAYS, counts, &asked);
        free_mesh(&c.mesh);
    }
    printf("| way | rays that leak out | triangles missed | hit in error | wrong t |\n"
           "|---|---:|---:|---:|---:|\n");
    for (int w = 0; w < WAYS; w++)
        printf("| %s | %d | %d | %d | %d |\n", names[w], counts[w].leaks,
               counts[w].misses, counts[w].hits, counts[w].off);
    printf("rays: %d\ntouching: %d\n", asked.rays, asked.touching);
    for (int w = 0; w < WAYS; w++)
        printf("%s-leaks: %d\n%s-errors: %d\n", keys[w], counts[w].leaks, keys[w],
               counts[w].misses + counts[w].hits);
}

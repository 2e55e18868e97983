/* A routine that meets rays with triangles, against the exact answer, on seven closed meshes:
 * what a ray really hits is decided with numbers that are not rounded. */
#ifndef EXACT_H
#define EXACT_H

#include "meshes.h"

/* ---- sums without rounding ------------------------------------------------------------ */

/* A number as a sum of doubles that do not overlap, the smallest first; so the last has
 * the sign of the sum, and is nearly all of it (J. Shewchuk, "Adaptive precision
 * floating-point arithmetic", 1997). */
typedef struct exact_sum {
    double part[112];
    int count;
} exact_sum;

static inline void exact_add(exact_sum *s, double x)
{
    int kept = 0;
    for (int i = 0; i < s->count; i++) {
        const double a = s->part[i], sum = a + x, of_x = sum - a;
        const double lost = (a - (sum - of_x)) + (x - of_x);
        if (lost != 0.0)
            s->part[kept++] = lost;
        x = sum;
    }
    if (x != 0.0)
        s->part[kept++] = x;
    s->count = kept;
}

/* x y z of floats: x y fits into a double, and is cut into two numbers of at most 27 bits (G.
 * Dekker, 1971), so that each of them times z fits, too. */
static inline void exact_add_product(exact_sum *s, float x, float y, double z)
{
    const double xy = (double)x * (double)y, large = 134217729.0 * xy; /* 2^27 + 1 */
    const double head = large - (large - xy);
    exact_add(s, head * z);
    exact_add(s, (xy - head) * z);
}

/* sign * a (b x c) */
static inline void exact_add_box(exact_sum *s, double sign, rt_vec3 a, rt_vec3 b,
                                 rt_vec3 c)
{
    exact_add_product(s, a.x, b.y, sign * (double)c.z);
    exact_add_product(s, a.x, b.z, -sign * (double)c.y);
    exact_add_product(s, a.y, b.z, sign * (double)c.x);
    exact_add_product(s, a.y, b.x, -sign * (double)c.z);
    exact_add_product(s, a.z, b.x, sign * (double)c.y);
    exact_add_product(s, a.z, b.y, -sign * (double)c.x);
}

static inline double exact_value(const exact_sum *s)
{
    double sum = 0.0;
    for (int i = 0; i < s->count; i++)
        sum += s->part[i];
    return sum;
}

static inline int sign_of(double v)
{
    return (v > 0.0) - (v < 0.0);
}

/* ---- the exact answer ----------------------------------------------------------------- */

typedef enum verdict { MISSES, TOUCHES, HITS } verdict;

/* u ((p - O) x (q - O)), without differences, which would be rounded. */
static inline void exact_add_side(exact_sum *s, const rt_ray *ray, rt_vec3 p, rt_vec3 q)
{
    exact_add_box(s, 1.0, ray->direction, p, q);
    exact_add_box(s, -1.0, ray->direction, p, ray->origin);
    exact_add_box(s, -1.0, ray->direction, ray->origin, q);
}

/* The sign in double, where that is beyond doubt; otherwise the exact one. */
static inline int side_of(const rt_ray *ray, rt_vec3 p, rt_vec3 q)
{
    const rt_dvec3 o = rt_to_double(ray->origin), u = rt_to_double(ray->direction);
    const rt_dvec3 a = rt_dsub(rt_to_double(p), o), b = rt_dsub(rt_to_double(q), o);
    const double v = rt_ddot(u, rt_dcross(a, b));
    if (v * v > 1e-24 * rt_ddot(u, u) * rt_ddot(a, a) * rt_ddot(b, b))
        return sign_of(v);
    exact_sum s;
    s.count = 0;
    exact_add_side(&s, ray, p, q);
    return sign_of(exact_value(&s));
}

/* On the same side of all edges, and in front? Then *t is exact but for its last digits. On an
 * edge, or along the triangle, both answers are good. */
static inline verdict exact_answer(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   double *t)
{
    const rt_vec3 a = rt_corner(mesh, triangle, 0), b = rt_corner(mesh, triangle, 1);
    const rt_vec3 c = rt_corner(mesh, triangle, 2), o = ray->origin;
    const int ab = side_of(ray, a, b), bc = side_of(ray, b, c);
    if (ab * bc < 0)
        return MISSES;
    const int ca = side_of(ray, c, a);
    if (ab * ca < 0 || bc * ca < 0)
        return MISSES;
    exact_sum across, volume;
    across.count = volume.count = 0;
    exact_add_side(&across, ray, a, b);
    exact_add_side(&across, ray, b, c);
    exact_add_side(&across, ray, c, a);
    exact_add_box(&volume, 1.0, a, b, c);
    exact_add_box(&volume, -1.0, o, b, c);
    exact_add_box(&volume, -1.0, a, o, c);
    exact_add_box(&volume, -1.0, a, b, o);
    const double u_n = exact_value(&across), w_n = exact_value(&volume);
    if (u_n == 0.0 || w_n == 0.0)
        return TOUCHES;
    *t = w_n / u_n;
    if (*t < 0.0)
        return MISSES;
    return ab != 0 && bc != 0 && ca != 0 ? HITS : TOUCHES;
}

/* ---- meshes and rays ------------------------------------------------------------------ */

enum { EXACT_MESHES = 7, EXACT_KINDS = 4 };

typedef struct exact_case {
    const char *name;
    rt_mesh mesh;
    rt_vec3 center;
    float size;
} exact_case;

static inline exact_case make_exact_case(int k)
{
    static const char *const names[EXACT_MESHES] = {
        "sphere",           "sphere far away", "slivers",     "cube",
        "cube of integers", "tiny sphere",     "large sphere"};
    static const rt_vec3 centers[EXACT_MESHES] = {
        {0, 0, 0},   {1000, -500, 2000}, {3, 2, 1}, {0, 0, 0},
        {8, 16, -8}, {0, 0, 0},          {0, 0, 0}};
    static const float sizes[EXACT_MESHES] = {1, 1, 1, 1, 16, 1e-3f, 1e4f};
    const bool round = k < 2 || k > 4;
    const exact_case c = {names[k],
                          round    ? make_icosphere(k == 6 ? 2 : 3)
                          : k == 2 ? make_globe(6, 400)
                                   : make_cells(k == 3 ? 12 : 16, is_any_cell),
                          centers[k], sizes[k]};
    rt_mesh mesh = c.mesh;
    place_mesh(&mesh, c.center, c.size, round ? 0.05f : 0.0f);
    return c;
}

static inline float any_in(rt_rng *rng, float low, float high)
{
    return low + (high - low) * rt_random(rng);
}

static inline rt_vec3 any_point(rt_rng *rng, float size)
{
    const float x = any_in(rng, -size, size), y = any_in(rng, -size, size);
    return rt_vec(x, y, any_in(rng, -size, size));
}

static inline float *coordinate(rt_vec3 *v, int axis)
{
    return axis == 0 ? &v->x : axis == 1 ? &v->y : &v->z;
}

/* A ray from inside or from outside: to anywhere (kind 0), to a point of an edge (1), to a corner
 * (2), and exactly to a corner (3), along an axis or from where all have few digits. */
static inline rt_ray exact_ray(const exact_case *c, int kind, bool inside, rt_rng *rng)
{
    const int triangle = (int)(rt_random(rng) * (float)c->mesh.triangle_count);
    const rt_vec3 a = rt_corner(&c->mesh, triangle, 0);
    const rt_vec3 b = rt_corner(&c->mesh, triangle, 1);
    const float far = any_in(rng, 2, 6), near = any_in(rng, 0, 0.4f), s = rt_random(rng);
    const rt_vec3 way = rt_normalize(any_point(rng, 1));
    rt_vec3 end = kind == 1 ? rt_add(rt_scale(a, 1 - s), rt_scale(b, s)) : a;
    if (kind == 0)
        end = rt_add(c->center, any_point(rng, 0.8f * c->size));
    rt_ray ray;
    ray.origin = rt_add(c->center, rt_scale(way, c->size * (inside ? near : far)));
    if (kind == 3 && s < 0.5f) {
        const int axis = (int)(6 * s);
        rt_vec3 o = a, center = c->center;
        *coordinate(&o, axis) = *coordinate(&center, axis);
        if (rt_length(rt_sub(o, center)) < 0.7f * c->size) { /* else it may be outside */
            if (!inside)
                *coordinate(&o, axis) += 4 * c->size;
            ray.origin = o;
        }
    } else if (kind == 3) {
        ray.origin = rt_vec(roundf(8 * ray.origin.x) / 8, roundf(8 * ray.origin.y) / 8,
                            roundf(8 * ray.origin.z) / 8);
    }
    ray.direction = rt_sub(end, ray.origin);
    return ray;
}

/* ---- the judgement -------------------------------------------------------------------- */

typedef bool triangle_function(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                               float t_max, rt_hit *hit);

/* What a routine got wrong: rays from inside that got out, triangles missed and hit
 * against the exact answer, t more than one float off. */
typedef struct exact_count {
    int leaks, misses, hits, off;
} exact_count;

typedef struct exact_rays { /* what it was asked */
    int rays, touching;
} exact_rays;

/* Ask so many rays of each kind against all triangles, in each of the ways. */
static inline void judge(const exact_case *c, int rays, triangle_function *const *ways,
                         int way_count, exact_count *counts, exact_rays *asked)
{
    rt_rng rng = rt_rng_start(7, 0, 0);
    for (int i = 0; i < EXACT_KINDS * rays; i++) {
        const bool inside = i / EXACT_KINDS % 2 == 1;
        const rt_ray ray = exact_ray(c, i % EXACT_KINDS, inside, &rng);
        bool found[16] = {false}, touching = false;
        if (rt_is_zero(ray.direction))
            continue;
        for (int k = 0; k < c->mesh.triangle_count; k++) {
            double t = 0.0;
            const verdict v = exact_answer(&c->mesh, k, &ray, &t);
            const float above = nextafterf((float)t, INFINITY);
            const float below = nextafterf((float)t, 0);
            touching |= v == TOUCHES;
            for (int w = 0; w < way_count; w++) {
                rt_hit hit;
                const bool hits = ways[w](&c->mesh, k, &ray, FLT_MAX, &hit);
                found[w] |= hits;
                counts[w].misses += v == HITS && !hits;
                counts[w].hits += v == MISSES && hits;
                counts[w].off += v == HITS && hits && !(hit.t >= below && hit.t <= above);
            }
        }
        for (int w = 0; w < way_count; w++)
            counts[w].leaks += inside && !found[w];
        asked->rays++;
        asked->touching += touching;
    }
}

#endif

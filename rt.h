/* rt.h - a small ray tracer that is also its own textbook.             version 0.1.0
 *
 * Do this in ONE .c or .cpp file:            In all others, just:
 *
 *     #define RT_IMPLEMENTATION                  #include "rt.h"
 *     #include "rt.h"
 *
 * and compile with optimisation and OpenMP:
 *
 *     cc -O2 -fopenmp -ffp-contract=off program.c -lm
 *
 * THE SMALLEST COMPLETE PROGRAM
 *
 *     #define RT_IMPLEMENTATION
 *     #include "rt.h"
 *     #include <stdio.h>
 *
 *     static rt_vec3 pixels[320 * 240]; // static: all zero, that is, all defaults
 *     static rt_scene scene;
 *     static rt_camera camera;
 *     static rt_options options;
 *     static rt_image image;
 *
 *     int main(void)
 *     {
 *         const rt_sphere spheres[2] = {
 *             {{0, 0, -5}, 1, {{0.85f, 0.10f, 0.08f}, false}},
 *             {{0, -101, -5}, 100, {{0.80f, 0.80f, 0.80f}, false}},
 *         };
 *         const rt_light light = {{3, 4, -2}, {150, 150, 150}};
 *         scene.spheres = spheres;
 *         scene.sphere_count = 2;
 *         scene.lights = &light;
 *         scene.light_count = 1;
 *         options.bounces = 5;
 *         image.width = 320;
 *         image.height = 240;
 *         image.pixels = pixels;
 *         const rt_status status = rt_render(&scene, &camera, &options, &image);
 *         if (status != RT_OK)
 *             return fprintf(stderr, "rt_render: %s\n", rt_status_text(status)), 1;
 *
 *         FILE *file = fopen("picture.ppm", "wb");
 *         if (!file)
 *             return perror("picture.ppm"), 1;
 *         fprintf(file, "P6 320 240 255\n");
 *         for (int i = 0; i < 320 * 240; i++) {
 *             putc(rt_encode(pixels[i].x, 2.2), file);
 *             putc(rt_encode(pixels[i].y, 2.2), file);
 *             putc(rt_encode(pixels[i].z, 2.2), file);
 *         }
 *         return fclose(file) != 0;
 *     }
 *
 * WHAT IT IS      Spheres, axis-aligned boxes, point lights, mirrors, diffuse surfaces,
 *                 direct and indirect light, on all cores. C99 and C++17, libc and libm.
 * WHAT IT IS NOT  No meshes, no textures, no glass, no lights with a size; no files, no
 *                 windows. It does not print, exit, allocate, or keep global state.
 *
 * HOW TO READ IT  From top to bottom. Chapters 0 to 7 are plain C, each on top of the
 *                 ones before; demos/demoNN and docs/NN- have the same numbers. The
 *                 machinery that runs them on all cores stands last, under
 *                 RT_IMPLEMENTATION.
 *
 * OPTIONS         Define before the include:
 *                 RT_IMPLEMENTATION  also compile the functions marked RTDEF
 *                 RT_STATIC          make those private to this file
 *                 RTDEF              or say yourself how they are declared
 *
 * CONVENTIONS     Right-handed world, y up; any unit of length in which no detail is
 *                 smaller than 1e-4 (see rt_leave). Colours are linear RGB. Pixel (0,0)
 *                 is top left and covers [0,1] x [0,1] of the film; its centre is (0.5,
 *                 0.5); its value is the mean of the light over its square. A light's
 *                 intensity is in W/sr per channel. Surfaces have two sides. A scene,
 *                 camera, material or options that are all zero are valid; 0 stands for
 *                 the documented default. Vectors pass by value, larger things by
 *                 pointer, results come last. Notation of the formulas: ray C + t u,
 *                 sphere of centre O and radius R, point P, normal N, light S at distance
 *                 d in the direction L (|L| = 1), albedo rho, <a,b> scalar product.
 *
 * THREADS         Every function may run at the same time on several threads, as long as
 *                 nobody writes what another reads. rt_render starts threads by itself.
 *                 Where other programs keep the cores busy, too, set
 *                 OMP_WAIT_POLICY=passive in the environment, or its threads lose time by
 *                 waiting for each other.
 * SAME BITS       The picture depends on what is rendered, not on how: not on the number
 *                 of threads, nor on how the samples are split over several calls. For
 *                 the same bits on other machines and compilers pass -ffp-contract=off
 *                 (gcc contracts a*b+c by default); -ffast-math is refused.
 * ROBUSTNESS      Spheres are intersected in double precision, so that walls of radius
 *                 1e5 work in a room of size 100: no wrong hit or miss in 1.8 million
 *                 rays, t within one rounding. Boxes in float, exact on planes, edges and
 *                 corners. A ray that leaves a surface starts 8 roundings beside it
 *                 (rt_leave): no self-hit in 3 million bounces. NaN and infinity in a ray
 *                 or a shape are a miss, never a crash. Sine and cosine are our own, so
 *                 that libm cannot change a path. How all this is tested:
 *                 docs/correctness.md.
 * ERRORS          Only rt_render, rt_render_pixels and rt_check_... can fail. They return
 *                 an rt_status, and rt_status_text says in English what was wrong.
 *
 * CONTENTS        0 vectors            rt_vec3, rt_dot, rt_normalize, rt_basis, rt_sincos
 *                 1 rays and spheres   rt_ray, rt_camera_ray, rt_hit_sphere
 *                 2 scenes             rt_scene, rt_intersect, rt_lambert
 *                 3 boxes              rt_hit_box
 *                 4 light and shadow   rt_leave, rt_visible, rt_direct
 *                 5 pixels             rt_encode
 *                 6 mirrors            rt_reflect
 *                 7 indirect light     rt_random, rt_sample_cosine, rt_radiance
 *                 8 pictures           rt_image, rt_options, rt_render
 *
 * Licence (MIT or public domain) at the end of the file; changes in CHANGELOG.md.
 */
#ifndef RT_H
#define RT_H

#define RT_VERSION_MAJOR 0
#define RT_VERSION_MINOR 1
#define RT_VERSION_PATCH 0

#include <float.h>
#include <limits.h>
#include <math.h>
#include <stddef.h>
#include <stdint.h>
#ifndef __cplusplus
#include <stdbool.h>
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "rt.h: without -ffast-math, -Ofast, -ffinite-math-only please: NaN tests would go."
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF /* undone at the end of the header; gcc needs the flag */
#endif

#ifndef RTDEF
#ifdef RT_STATIC
#define RTDEF static inline
#elif defined(__cplusplus)
#define RTDEF extern "C"
#else
#define RTDEF extern
#endif
#endif

/* ====================================================================================
 * Chapter 0. Vectors
 *
 * One type serves for points, directions and colours (x, y, z = red, green, blue).
 * ==================================================================================== */

typedef struct rt_vec3 {
    float x, y, z;
} rt_vec3;

static inline rt_vec3 rt_vec(float x, float y, float z)
{
    rt_vec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline rt_vec3 rt_add(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline rt_vec3 rt_sub(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

/* Component by component: what is left of light a on a surface of colour b. */
static inline rt_vec3 rt_mul(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.x * b.x, a.y * b.y, a.z * b.z);
}

static inline rt_vec3 rt_scale(rt_vec3 v, float k)
{
    return rt_vec(k * v.x, k * v.y, k * v.z);
}

/* <a,b> = |a| |b| cos(angle between a and b). */
static inline float rt_dot(rt_vec3 a, rt_vec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

/* Perpendicular to a and b, |a| |b| sin(angle) long, right-handed: x cross y is z. */
static inline rt_vec3 rt_cross(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline float rt_length(rt_vec3 v)
{
    return sqrtf(rt_dot(v, v));
}

/* The same in double precision, for the few places where float is not enough. */
typedef struct rt_dvec3 {
    double x, y, z;
} rt_dvec3;

static inline rt_dvec3 rt_dvec(double x, double y, double z)
{
    rt_dvec3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

static inline rt_dvec3 rt_to_double(rt_vec3 v)
{
    return rt_dvec((double)v.x, (double)v.y, (double)v.z);
}

static inline rt_vec3 rt_to_float(rt_dvec3 v)
{
    return rt_vec((float)v.x, (float)v.y, (float)v.z);
}

static inline double rt_ddot(rt_dvec3 a, rt_dvec3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline rt_dvec3 rt_dscale(rt_dvec3 v, double k)
{
    return rt_dvec(k * v.x, k * v.y, k * v.z);
}

static inline rt_dvec3 rt_dsub(rt_dvec3 a, rt_dvec3 b)
{
    return rt_dvec(a.x - b.x, a.y - b.y, a.z - b.z);
}

/* a + k b. */
static inline rt_dvec3 rt_dmad(rt_dvec3 a, double k, rt_dvec3 b)
{
    return rt_dvec(a.x + k * b.x, a.y + k * b.y, a.z + k * b.z);
}

/* v / |v|. A vector without a direction (zero, infinite or NaN) becomes (0,0,0). In
 * double, because the square of 1e20 does not fit into a float. */
static inline rt_vec3 rt_normalize(rt_vec3 v)
{
    const rt_dvec3 d = rt_to_double(v);
    const double length = sqrt(rt_ddot(d, d));
    if (!(length > 0.0 && length <= DBL_MAX)) /* so written that NaN fails, too */
        return rt_vec(0.0f, 0.0f, 0.0f);
    return rt_to_float(rt_dscale(d, 1.0 / length));
}

static inline bool rt_is_zero(rt_vec3 v)
{
    return v.x == 0.0f && v.y == 0.0f && v.z == 0.0f;
}

/* Two unit vectors that make a right-handed orthonormal basis (a, b, n) with the unit
 * vector n: <a,b> = <a,n> = <b,n> = 0 within 1e-6 for every n.
 * The usual "cross n with a fixed vector" fails where the two are parallel; this does
 * not. Duff et al., "Building an orthonormal basis, revisited", JCGT 6(1), 2017. */
static inline void rt_basis(rt_vec3 n, rt_vec3 *a, rt_vec3 *b)
{
    const float sign = n.z < 0.0f ? -1.0f : 1.0f;
    const float k = -1.0f / (sign + n.z);
    const float m = n.x * n.y * k;
    *a = rt_vec(1.0f + sign * n.x * n.x * k, sign * m, -sign * n.x);
    *b = rt_vec(m, sign + n.y * n.y * k, -n.y);
}

/* Sine and cosine of an angle given in turns (1 turn = 360 degrees = 2 pi), for turns in
 * [0, 1], absolute error below 1e-7; for anything else those of 0. Whole quarters of a
 * turn are taken off, which is exact, and the rest, at most an eighth of a turn either
 * way, goes into two short polynomials. Why not sinf and cosf: every libm rounds
 * differently, and the pictures would differ. Coefficients: S. Moshier, Cephes library
 * (sinf, cosf), minimax on [-pi/4, pi/4]. */
static inline void rt_sincos(float turns, float *sine, float *cosine)
{
    if (!(turns >= 0.0f && turns <= 1.0f))
        turns = 0.0f;
    const int quarter = (int)(turns * 4.0f + 0.5f);
    const float x = (turns * 4.0f - (float)quarter) * 1.57079632679f;
    const float xx = x * x;
    const float s3 = -1.6666654611e-1f + xx * (8.3321608736e-3f - xx * 1.9515295891e-4f);
    const float c4 = 4.1666645683e-2f + xx * (-1.3887316255e-3f + xx * 2.4433157118e-5f);
    const float s = x + x * xx * s3; /* the small terms first, then one rounding */
    const float c = 1.0f + (xx * xx * c4 - 0.5f * xx);
    const bool odd = (quarter & 1) != 0; /* a quarter turn on, sine is cosine */
    *sine = ((quarter & 2) != 0 ? -1.0f : 1.0f) * (odd ? c : s);
    *cosine = (((quarter + 1) & 2) != 0 ? -1.0f : 1.0f) * (odd ? s : c);
}

/* ====================================================================================
 * Chapter 1. Rays, the camera, spheres
 *
 * A ray is a half-line: the points C + t u with t > 0. Every question that a ray tracer
 * asks is of the kind "what does this ray meet first?".
 * ==================================================================================== */

typedef struct rt_ray {
    rt_vec3 origin;    /* C */
    rt_vec3 direction; /* u, of any length: t counts in units of |u| */
} rt_ray;

/* The point C + t u. */
static inline rt_vec3 rt_at(const rt_ray *ray, float t)
{
    return rt_add(ray->origin, rt_scale(ray->direction, t));
}

typedef struct rt_camera {
    rt_vec3 position;
    rt_vec3 direction; /* where it looks, any length; (0,0,0) means (0,0,-1) */
    rt_vec3 up;        /* what is up in the picture; (0,0,0) means (0,1,0) */
    float fov_y;       /* full vertical angle of view in degrees, 0 < fov_y < 180;
                          0 means 45 */
} rt_camera;

/* The ray from the camera through the point (x, y) of a film of width x height pixels;
 * (0,0) is the top left corner of the film, (0.5, 0.5) the centre of the top left pixel.
 *
 * With forward = the camera's direction, right = forward x up and top = right x forward,
 * all made unit vectors, the film stands at distance 1 and is 2 tan(fov_y/2) high; pixels
 * are square:
 *
 *     forward + 2 tan(fov_y/2) / height . ((x - width/2) right + (height/2 - y) top),
 *
 * normalised. y is subtracted because rows count downwards. Where up is parallel to the
 * direction, or not finite, some perpendicular takes its place. A width or height below
 * 1, an angle out of range or a direction that is not finite gives direction (0,0,0): a
 * ray that hits nothing. */
static inline rt_ray rt_camera_ray(const rt_camera *camera, int width, int height,
                                   float x, float y)
{
    rt_ray ray;
    ray.origin = camera->position;
    ray.direction = rt_vec(0.0f, 0.0f, 0.0f);

    const float fov_y = camera->fov_y == 0.0f ? 45.0f : camera->fov_y;
    const rt_vec3 forward = rt_is_zero(camera->direction)
                                ? rt_vec(0.0f, 0.0f, -1.0f)
                                : rt_normalize(camera->direction);
    const rt_vec3 up =
        rt_is_zero(camera->up) ? rt_vec(0.0f, 1.0f, 0.0f) : rt_normalize(camera->up);
    if (!(fov_y > 0.0f && fov_y < 180.0f && width > 0 && height > 0) ||
        rt_is_zero(forward))
        return ray;

    rt_vec3 right = rt_normalize(rt_cross(forward, up)), top;
    if (rt_is_zero(right))
        rt_basis(forward, &right, &top);
    top = rt_cross(right, forward);

    float sine, cosine;
    rt_sincos(fov_y / 720.0f, &sine, &cosine);
    const float size = 2.0f * sine / cosine / (float)height; /* of a pixel */
    const float to_right = size * (x - 0.5f * (float)width);
    const float to_top = size * (0.5f * (float)height - y);
    ray.direction = rt_normalize(
        rt_add(forward, rt_add(rt_scale(right, to_right), rt_scale(top, to_top))));
    return ray;
}

/* What a surface does with light. It is explained in chapter 2 (albedo) and 6 (mirror);
 * the shapes carry one, so it is declared here. */
typedef struct rt_material {
    rt_vec3 albedo; /* rho: the part of the light that is sent back, 0 to 1 per channel.
                       For a mirror (0,0,0) means (1,1,1): nothing is lost. */
    bool mirror;    /* false: in all directions (diffuse); true: in one (mirror) */
} rt_material;

typedef struct rt_sphere {
    rt_vec3 center; /* O */
    float radius;   /* R > 0 */
    rt_material material;
} rt_sphere;

/* Where a ray meets a surface. */
typedef struct rt_hit {
    float t;                     /* the point is C + t u */
    rt_vec3 point;               /* P, on the surface within rounding */
    rt_vec3 normal;              /* N, unit length, on the side that the ray comes from */
    const rt_material *material; /* of the shape that was hit */
} rt_hit;

/* The first point of the sphere on the ray with 0 < t < t_max.
 *
 * P = C + t u lies on the sphere when |P - O|^2 = R^2. With f = C - O that is
 *
 *     t^2 <u,u> + 2 t <f,u> + <f,f> - R^2 = 0,     a t^2 + 2 b t + c = 0,
 *
 * whose roots are t = (-b -+ sqrt(b^2 - a c)) / a. No real root: the ray passes by. The
 * smaller root is the way in; if it lies behind us (t <= 0) we are inside, and the larger
 * one is the way out.
 *
 * Returns false, and leaves *hit alone, on a miss; NaN or infinity anywhere, a direction
 * of length 0 and a radius that is not positive are misses.
 *
 * The formula is the textbook's, but in double: for a wall of radius 1e5, c is a small
 * difference of two numbers near 1e10, of which a float keeps seven digits: none is left.
 * P is then put back onto the sphere, O + R N, so that its error does not grow with t. */
static inline bool rt_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                                 rt_hit *hit)
{
    const rt_dvec3 u = rt_to_double(ray->direction);
    const rt_dvec3 center = rt_to_double(sphere->center);
    const double radius = (double)sphere->radius;
    const rt_dvec3 f = rt_dsub(rt_to_double(ray->origin), center); /* C - O */

    const double a = rt_ddot(u, u);
    const double b = rt_ddot(f, u);
    const double c = rt_ddot(f, f) - radius * radius;
    const double discriminant = b * b - a * c;
    /* so written, here and below, that NaN is a miss */
    if (!(discriminant >= 0.0 && a > 0.0 && radius > 0.0))
        return false;

    const double root = sqrt(discriminant);
    double t = (-b - root) / a;
    if (!((float)t > 0.0f))
        t = (-b + root) / a;
    if (!((float)t > 0.0f && t <= (double)FLT_MAX && (float)t < t_max))
        return false;

    const rt_dvec3 n = rt_dmad(f, t, u); /* P - O, as long as R but for rounding */
    const double length = sqrt(rt_ddot(n, n));
    if (!(length > 0.0))
        return false;
    const bool inside = rt_ddot(n, u) > 0.0;
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(center, radius / length, n));
    hit->normal = rt_to_float(rt_dscale(n, (inside ? -1.0 : 1.0) / length));
    hit->material = &sphere->material;
    return true;
}

/* ====================================================================================
 * Chapter 2. Scenes, the nearest hit, Lambert's law
 * ==================================================================================== */

/* An axis-aligned box, explained in chapter 3; a light, explained in chapter 4. */
typedef struct rt_box {
    rt_vec3 min, max; /* two opposite corners, min <= max in each of x, y, z */
    rt_material material;
} rt_box;

typedef struct rt_light {
    rt_vec3 position;  /* S */
    rt_vec3 intensity; /* I in W/sr per channel, not negative */
} rt_light;

/* The arrays are yours: they must live as long as the scene is used. NULL with 0 is fine.
 */
typedef struct rt_scene {
    const rt_sphere *spheres;
    int sphere_count;
    const rt_box *boxes;
    int box_count;
    const rt_light *lights;
    int light_count;
    rt_vec3 background; /* the light that comes from where nothing is hit; 0 is black */
} rt_scene;

static inline bool rt_hit_box(const rt_box *box, const rt_ray *ray, float t_max,
                              rt_hit *hit); /* chapter 3 */

/* The nearest hit of the ray in the scene: ask every shape for a hit that is nearer than
 * the nearest so far. Of two at exactly the same distance the first wins, spheres before
 * boxes. Returns false, and leaves *hit alone, if there is none. */
static inline bool rt_intersect(const rt_scene *scene, const rt_ray *ray, rt_hit *hit)
{
    rt_hit best = {FLT_MAX, {0.0f, 0.0f, 0.0f}, {0.0f, 0.0f, 0.0f}, NULL};
    for (int i = 0; i < scene->sphere_count; i++)
        rt_hit_sphere(&scene->spheres[i], ray, best.t, &best);
    for (int i = 0; i < scene->box_count; i++)
        rt_hit_box(&scene->boxes[i], ray, best.t, &best);
    if (!best.material)
        return false;
    *hit = best;
    return true;
}

/* Lambert's law: the radiance that a diffuse surface sends, in every direction alike,
 * when a point light of intensity I stands at P + to_light and nothing is in between,
 *
 *     rho/pi . I . max(0, <N,L>) / d^2     with L = to_light / d, d = |to_light|.
 *
 * The intensity spreads over a sphere of area 4 pi d^2: hence 1/d^2. The same light falls
 * on more surface when it comes in flat: hence the cosine. And 1/pi, because a surface
 * that sends radiance 1 in all directions sends pi W per m^2 in all, and must not send
 * more than it gets. A light behind the surface, or nearer than 1e-10 (I / d^2 must stay
 * a float), gives black. */
static inline rt_vec3 rt_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity)
{
    const float dd = rt_dot(to_light, to_light);
    const float toward = rt_dot(normal, to_light); /* d <N,L> */
    if (!(toward > 0.0f && dd > 1e-20f && dd <= FLT_MAX))
        return rt_vec(0.0f, 0.0f, 0.0f);
    const float cosine = toward / sqrtf(dd);
    return rt_scale(rt_mul(albedo, intensity), cosine / (3.14159265359f * dd));
}

/* ====================================================================================
 * Chapter 3. Boxes
 * ==================================================================================== */

/* What is left of a ray between the planes seen so far: it enters the last of their slabs
 * at t_in through a plane of axis axis_in, and leaves the first at t_out. */
typedef struct rt__slabs {
    float t_in, t_out;
    int axis_in, axis_out; /* 0, 1, 2 stand for x, y, z */
} rt__slabs;

/* Cut with the slab low <= x <= high, on one axis: the ray crosses its two planes at
 * t = (low - C) / u and (high - C) / u. False when nothing is left of the ray. */
static inline bool rt__cut(rt__slabs *slabs, int axis, float low, float high,
                           float origin, float direction)
{
    if (!(low <= high && low >= -FLT_MAX && high <= FLT_MAX)) /* no slab, or no bounds */
        return false;
    if (direction == 0.0f) /* parallel to the planes: always between them, or never */
        return low <= origin && origin <= high;
    const float t_low = (low - origin) / direction;
    const float t_high = (high - origin) / direction;
    const float t_in = direction > 0.0f ? t_low : t_high;
    const float t_out = direction > 0.0f ? t_high : t_low;
    if (t_in > slabs->t_in) {
        slabs->t_in = t_in;
        slabs->axis_in = axis;
    }
    if (t_out < slabs->t_out) {
        slabs->t_out = t_out;
        slabs->axis_out = axis;
    }
    return t_in <= t_out && slabs->t_in <= slabs->t_out; /* NaN: false */
}

/* The first point of the box's surface on the ray with 0 < t < t_max.
 *
 * A box is what three slabs have in common, and so is the part of the ray inside it: it
 * begins at the largest of the three ways in and ends at the smallest of the three ways
 * out. If it ends before it begins, the ray passes by. From inside (way in at t <= 0) the
 * hit is the way out. The normal is that of the plane through which the ray comes or
 * goes; on an edge or corner x goes before y, y before z. The box is closed: a ray in the
 * plane of a face hits it. A flat box (min.y = max.y, say) is a rectangle.
 *
 * Returns false, and leaves *hit alone, on a miss; NaN, infinity and min > max are
 * misses.
 *
 * Dividing by the direction, not multiplying by 1/u, and treating 0 apart keeps 0 . inf
 * away; float is enough here, since nothing is squared. Method: T. Kay, J. Kajiya, "Ray
 * tracing complex scenes", SIGGRAPH 1986. */
static inline bool rt_hit_box(const rt_box *box, const rt_ray *ray, float t_max,
                              rt_hit *hit)
{
    const rt_vec3 o = ray->origin, u = ray->direction;
    rt__slabs slabs = {-FLT_MAX, FLT_MAX, 0, 0};
    if (!rt__cut(&slabs, 0, box->min.x, box->max.x, o.x, u.x) ||
        !rt__cut(&slabs, 1, box->min.y, box->max.y, o.y, u.y) ||
        !rt__cut(&slabs, 2, box->min.z, box->max.z, o.z, u.z))
        return false;
    const bool inside = !(slabs.t_in > 0.0f);
    const float t = inside ? slabs.t_out : slabs.t_in;
    if (!(t > 0.0f && t < t_max && t < FLT_MAX)) /* FLT_MAX: no plane bounds the ray */
        return false;

    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_vec(0.0f, 0.0f, 0.0f);
    hit->material = &box->material;
    /* the normal against the ray, and the point exactly onto the plane */
    switch (inside ? slabs.axis_out : slabs.axis_in) {
    case 0:
        hit->normal.x = u.x > 0.0f ? -1.0f : 1.0f;
        hit->point.x = (u.x > 0.0f) == inside ? box->max.x : box->min.x;
        break;
    case 1:
        hit->normal.y = u.y > 0.0f ? -1.0f : 1.0f;
        hit->point.y = (u.y > 0.0f) == inside ? box->max.y : box->min.y;
        break;
    default:
        hit->normal.z = u.z > 0.0f ? -1.0f : 1.0f;
        hit->point.z = (u.z > 0.0f) == inside ? box->max.z : box->min.z;
        break;
    }
    return true;
}

/* ====================================================================================
 * Chapter 4. Light and shadow
 * ==================================================================================== */

/* Where a ray starts that leaves the surface at P in the given direction: a little off
 * the surface, along the normal, on the side to which the ray goes,
 *
 *     P +- 8 eps max(1, |x|, |y|, |z|) N,     eps = 2^-23, the spacing of floats at 1.
 *
 * P is rounded, so half of the time it lies just below the surface, and the ray would hit
 * the very surface that it leaves: the black dots called shadow acne. Skipping small t
 * instead does not help rays that leave flat, along the surface. In a room of 120 units
 * the offset is 1.1e-4 at most. */
static inline rt_vec3 rt_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction)
{
    float size = 1.0f;
    size = fabsf(point.x) > size ? fabsf(point.x) : size;
    size = fabsf(point.y) > size ? fabsf(point.y) : size;
    size = fabsf(point.z) > size ? fabsf(point.z) : size;
    const float offset = 8.0f * FLT_EPSILON * size;
    return rt_add(point,
                  rt_scale(normal, rt_dot(normal, direction) < 0.0f ? -offset : offset));
}

/* Is there anything on the ray with 0 < t < t_max? Any hit will do, so the search ends
 * with the first one found. */
static inline bool rt_occluded(const rt_scene *scene, const rt_ray *ray, float t_max)
{
    rt_hit unused;
    for (int i = 0; i < scene->sphere_count; i++)
        if (rt_hit_sphere(&scene->spheres[i], ray, t_max, &unused))
            return true;
    for (int i = 0; i < scene->box_count; i++)
        if (rt_hit_box(&scene->boxes[i], ray, t_max, &unused))
            return true;
    return false;
}

/* Does the point S see the point P of a surface with normal N? A ray from P along S - P
 * has S at t = 1: what it meets before stands in between, what it meets later does not
 * count. A light exactly on a surface is seen or not as the rounding goes. */
static inline bool rt_visible(const rt_scene *scene, rt_vec3 point, rt_vec3 normal,
                              rt_vec3 light)
{
    rt_ray shadow;
    shadow.origin = rt_leave(point, normal, rt_sub(light, point));
    shadow.direction = rt_sub(light, shadow.origin);
    return !rt_occluded(scene, &shadow, 1.0f);
}

/* What one sample of one pixel carries along. The random numbers come in chapter 7; rays
 * are counted from here on. */
typedef struct rt_rng {
    uint32_t key;       /* made from pixel, sample and seed */
    uint32_t dimension; /* how many numbers were drawn */
    uint32_t rays;      /* how many rays were traced: for statistics only */
} rt_rng;

/* Direct light: the sum of Lambert's law over the lights that the point sees. Shadow rays
 * are traced to the lights in front of the surface only, and counted in *rng. */
static inline rt_vec3 rt_direct(const rt_scene *scene, const rt_hit *hit, rt_rng *rng)
{
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < scene->light_count; i++) {
        const rt_light *light = &scene->lights[i];
        const rt_vec3 to_light = rt_sub(light->position, hit->point);
        if (!(rt_dot(hit->normal, to_light) > 0.0f))
            continue;
        rng->rays++;
        if (rt_visible(scene, hit->point, hit->normal, light->position))
            sum = rt_add(sum, rt_lambert(hit->material->albedo, hit->normal, to_light,
                                         light->intensity));
    }
    return sum;
}

/* ====================================================================================
 * Chapter 5. Pixels: from light to bytes
 * ==================================================================================== */

/* The byte that shows a linear value on a screen:
 *
 *     round(255 . clamp(value, 0, 1)^(1/gamma)).
 *
 * A screen makes light ~ byte^2.2, because the eye tells dark tones apart better than
 * bright ones and 256 steps have to do. Without the power 1/2.2 here, half of full
 * light would be shown as a fifth of it. gamma 1 encodes linearly; 0 means 2.2, and so
 * does a gamma that is negative, infinite or NaN. The clamp comes before the power (a
 * negative base has no power 1/2.2) and is so written that NaN becomes 0; infinity
 * becomes 255. In double, so that every libm gives the same byte: with gamma 2.2 no float
 * is so close to the middle of two bytes that it matters. */
static inline unsigned char rt_encode(float value, double gamma)
{
    const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    const double exponent = 1.0 / (gamma > 0.0 && gamma <= DBL_MAX ? gamma : 2.2);
    return (unsigned char)(255.0 * pow((double)clamped, exponent) + 0.5);
}

/* ====================================================================================
 * Chapter 6. Mirrors
 * ==================================================================================== */

/* The direction of the ray I after a mirror with unit normal N: what goes into the mirror
 * is turned round, the rest stays,
 *
 *     R = I - 2 <I,N> N.
 *
 * As long as I, and the same for N and -N. */
static inline rt_vec3 rt_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_sub(incident, rt_scale(normal, 2.0f * rt_dot(incident, normal)));
}

/* ====================================================================================
 * Chapter 7. Indirect light: random numbers, the hemisphere, radiance
 * ==================================================================================== */

/* 32 bits well mixed into 32 others, one to one. The "PCG hash" of M. Jarzynski and M.
 * Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020, after M. O'Neill's PCG. */
static inline uint32_t rt_hash(uint32_t v)
{
    const uint32_t state = v * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/* The random numbers of one sample of one pixel; pixel = row * width + column and sample
 * = 0, 1, 2 ... They are no sequence drawn from a common source, which threads would have
 * to share, but a function of (pixel, sample, seed) and of how many were asked for
 * before: the same on every machine, in whatever order and on however many threads pixels
 * are done. */
static inline rt_rng rt_rng_start(uint32_t pixel, uint32_t sample, uint32_t seed)
{
    rt_rng rng;
    rng.key = rt_hash(pixel + rt_hash(sample + rt_hash(seed)));
    rng.dimension = 0;
    rng.rays = 0;
    return rng;
}

/* The next random number, uniform in (0, 1): the middle of one of 2^23 equal parts. That
 * is exact as a float, and neither 0 nor 1 comes up: with them a direction of the
 * hemisphere could lie in the surface itself. Draw one number per statement: in
 * f(rt_random(r), rt_random(r)) the compiler chooses which of the two comes first, and
 * compilers differ. */
static inline float rt_random(rt_rng *rng)
{
    const uint32_t bits = rt_hash(rng->key + rng->dimension++);
    return ((float)(bits >> 9) + 0.5f) * (1.0f / 8388608.0f);
}

/* A direction on the side of the unit normal N, drawn with density <N,direction> / pi,
 * from two uniform numbers r1, r2 in (0, 1): in a basis with z along N,
 *
 *     x = cos(2 pi r1) sqrt(1 - r2),  y = sin(2 pi r1) sqrt(1 - r2),  z = sqrt(r2).
 *
 * That is a uniform point of the unit disc, lifted up onto the hemisphere (Malley's
 * method). Unit length within 3e-7. r2 = 0 gives a direction in the surface itself. */
static inline rt_vec3 rt_sample_cosine(rt_vec3 normal, float r1, float r2)
{
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const float radius = sqrtf(1.0f - r2);
    rt_vec3 a, b;
    rt_basis(normal, &a, &b);
    return rt_add(rt_add(rt_scale(a, cosine * radius), rt_scale(b, sine * radius)),
                  rt_scale(normal, sqrtf(r2)));
}

/* The radiance that comes back along the ray: an estimate from one random path, whose
 * mean over many paths is right.
 *
 * The light that leaves P is the direct light plus what all other surfaces send to P,
 *
 *     Lo = direct + integral of rho/pi . Li(w) . <N,w> dw over the hemisphere.
 *
 * One direction w, drawn with density <N,w>/pi, estimates the integral by the integrand
 * divided by the density: rho . Li(w). Cosine and pi cancel, and Li(w) is the same
 * question again, asked from P. So the path goes on and multiplies by rho at every
 * bounce; that product is its throughput. A mirror leaves no choice of direction: w = R.
 *
 * bounces is how often the ray may be sent on after its first hit, by mirror or
 * diffusely; 0 is direct light only; negative counts as 0 here, and rt_render refuses it.
 * What would have come after is left out: in a closed room of albedo rho the picture
 * lacks the part rho^(bounces+1). A loop, not a recursion: any number of bounces needs
 * the same stack. Random numbers and the count of rays come from *rng.
 *
 * J. Kajiya, "The rendering equation", SIGGRAPH 1986. */
static inline rt_vec3 rt_radiance(const rt_scene *scene, const rt_ray *camera_ray,
                                  int bounces, rt_rng *rng)
{
    rt_ray ray = *camera_ray;
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    rt_vec3 throughput = rt_vec(1.0f, 1.0f, 1.0f);
    for (int bounce = 0;; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(scene, &ray, &hit))
            return rt_add(sum, rt_mul(throughput, scene->background));

        const rt_material *material = hit.material;
        if (!material->mirror)
            sum = rt_add(sum, rt_mul(throughput, rt_direct(scene, &hit, rng)));
        if (bounce >= bounces)
            return sum;

        rt_vec3 direction;
        if (material->mirror) {
            direction = rt_reflect(ray.direction, hit.normal);
            if (!rt_is_zero(material->albedo)) /* which would mean 1 */
                throughput = rt_mul(throughput, material->albedo);
        } else {
            const float r1 = rt_random(rng);
            const float r2 = rt_random(rng);
            direction = rt_sample_cosine(hit.normal, r1, r2);
            throughput = rt_mul(throughput, material->albedo);
        }
        if (rt_is_zero(throughput))
            return sum; /* nothing that comes from here on would count */
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
}

/* ====================================================================================
 * Chapter 8. Pictures
 * ==================================================================================== */

/* A picture of linear RGB, row by row from the top: pixel (x, y) is pixels[y * width +
 * x]. The memory is yours, width * height vectors; it need not be cleared. At any time a
 * pixel holds the mean of its samples so far. To begin again, set samples, done and rays
 * to 0. */
typedef struct rt_image {
    int width, height;
    rt_vec3 *pixels;
    int samples; /* how many samples every pixel has */
    int done;    /* how many pixels, from the first on, have one more (after a cancel) */
    uint64_t rays; /* how many rays were traced for it, camera and shadow rays included */
} rt_image;

/* How to render. Zero everywhere is valid. */
typedef struct rt_options {
    int samples;   /* per pixel, to be added to those the image has; 0 means 16 */
    int bounces;   /* see rt_radiance; 0 is direct light only */
    int threads;   /* 1 to 1024; 0 means as many as OpenMP offers */
    uint32_t seed; /* another seed, another noise */

    /* Called on the thread that called rt_render, many times a second, while no other
     * thread works: it may read the image. part goes from 0 to 1. Return false to stop.
     */
    bool (*progress)(void *user, float part);
    void *user; /* handed to progress */
} rt_options;

/* How it went; rt_status_text says it in words. */
typedef enum rt_status {
    RT_OK,
    RT_CANCELLED,
    RT_BAD_POINTER,
    RT_BAD_SIZE,
    RT_BAD_SAMPLES,
    RT_BAD_BOUNCES,
    RT_BAD_THREADS,
    RT_BAD_CAMERA,
    RT_BAD_SPHERE,
    RT_BAD_BOX,
    RT_BAD_LIGHT,
    RT_BAD_BACKGROUND
} rt_status;

/* The colour seen through the point (x, y) of the film, an estimate with the numbers of
 * *rng; context is the caller's. Called on many threads at once. */
typedef rt_vec3 rt_pixel_function(const void *context, float x, float y, rt_rng *rng);

/* Add options->samples samples to every pixel of the image: a random point in the square
 * of the pixel, the ray of the camera through it, rt_radiance along the ray, and the
 * mean. options may be NULL: all defaults. An empty scene gives the background, a scene
 * without lights the part of it that arrives.
 *
 * RT_CANCELLED if progress returned false before the end: the image holds what was done
 * by then, and the same call with what is left of the samples goes on from there, to the
 * same bits as without the stop. On any other status but RT_OK the image is untouched;
 * for a bad shape or light, rt_check_scene tells which. */
RTDEF rt_status rt_render(const rt_scene *scene, const rt_camera *camera,
                          const rt_options *options, rt_image *image);

/* The same loop over pixels, samples and threads with a function of your own in place of
 * camera ray and rt_radiance. options->bounces is not looked at. */
RTDEF rt_status rt_render_pixels(rt_pixel_function *pixel, const void *context,
                                 const rt_options *options, rt_image *image);

/* RT_OK if every shape and light of the scene makes sense: all numbers up to 1e15, radius
 * > 0, min <= max, albedo 0 to 1, intensity and background not negative, no count
 * negative, no array missing. Otherwise what is wrong, and in *index, unless NULL, the
 * number of the offender in its array. rt_render asks it first. */
RTDEF rt_status rt_check_scene(const rt_scene *scene, int *index);

/* RT_OK, or RT_BAD_CAMERA if a number is not finite or above 1e15, or fov_y not in [0,
 * 180). */
RTDEF rt_status rt_check_camera(const rt_camera *camera);

/* The number of threads that rt_render uses for options->threads = wanted; always 1 without
 * OpenMP. What rt_render refuses counts as the nearest that it takes, 1 or 1024. */
RTDEF int rt_thread_count(int wanted);

/* What a status means, in English, without a full stop. Never NULL. */
RTDEF const char *rt_status_text(rt_status status);

#ifdef __clang__
#pragma STDC FP_CONTRACT DEFAULT
#endif
#endif /* RT_H */

/* ====================================================================================
 * The machinery
 * ==================================================================================== */
#if defined(RT_IMPLEMENTATION) && !defined(RT_IMPLEMENTED)
#define RT_IMPLEMENTED

#ifdef __clang__
#pragma STDC FP_CONTRACT OFF
#endif
#ifdef _OPENMP
#include <omp.h>
#else
#include <time.h>
#endif

RTDEF const char *rt_status_text(rt_status status)
{
    switch (status) {
    case RT_OK: return "no error";
    case RT_CANCELLED: return "stopped by the progress function";
    case RT_BAD_POINTER:
        return "an argument is NULL, or an array of the scene is, or a count is negative";
    case RT_BAD_SIZE:
        return "image: width and height at least 1, their product an int, done less than "
               "it";
    case RT_BAD_SAMPLES: return "samples must not be negative, nor pass 2^31 - 1 in all";
    case RT_BAD_BOUNCES: return "bounces must not be negative";
    case RT_BAD_THREADS: return "threads must be 0 to 1024";
    case RT_BAD_CAMERA: return "camera: numbers up to 1e15, and 0 <= fov_y < 180";
    case RT_BAD_SPHERE: return "sphere: numbers up to 1e15, radius > 0, albedo 0 to 1";
    case RT_BAD_BOX: return "box: numbers up to 1e15, min <= max, albedo 0 to 1";
    case RT_BAD_LIGHT: return "light: numbers up to 1e15, intensity not negative";
    case RT_BAD_BACKGROUND: return "background: numbers up to 1e15, not negative";
    }
    return "unknown status";
}

/* All three components in [low, high]; NaN is not. */
static inline bool rt__within(rt_vec3 v, float low, float high)
{
    return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low &&
           v.z <= high;
}

/* The largest number allowed: its square, and I / d^2, must still be floats. */
#define RT__LARGEST 1e15f

static inline bool rt__good_place(rt_vec3 v)
{
    return rt__within(v, -RT__LARGEST, RT__LARGEST);
}

RTDEF rt_status rt_check_scene(const rt_scene *scene, int *index)
{
    int nowhere = 0;
    int *i = index ? index : &nowhere;
    *i = 0;
    if (!scene || scene->sphere_count < 0 ||
        (scene->sphere_count > 0 && !scene->spheres) || scene->box_count < 0 ||
        (scene->box_count > 0 && !scene->boxes) || scene->light_count < 0 ||
        (scene->light_count > 0 && !scene->lights))
        return RT_BAD_POINTER;
    for (*i = 0; *i < scene->sphere_count; ++*i) {
        const rt_sphere *s = &scene->spheres[*i];
        if (!(rt__good_place(s->center) && s->radius > 0.0f && s->radius <= RT__LARGEST &&
              rt__within(s->material.albedo, 0.0f, 1.0f)))
            return RT_BAD_SPHERE;
    }
    for (*i = 0; *i < scene->box_count; ++*i) {
        const rt_box *b = &scene->boxes[*i];
        if (!(rt__good_place(b->min) && rt__good_place(b->max) && b->min.x <= b->max.x &&
              b->min.y <= b->max.y && b->min.z <= b->max.z &&
              rt__within(b->material.albedo, 0.0f, 1.0f)))
            return RT_BAD_BOX;
    }
    for (*i = 0; *i < scene->light_count; ++*i) {
        const rt_light *l = &scene->lights[*i];
        if (!(rt__good_place(l->position) && rt__within(l->intensity, 0.0f, RT__LARGEST)))
            return RT_BAD_LIGHT;
    }
    *i = 0;
    return rt__within(scene->background, 0.0f, RT__LARGEST) ? RT_OK : RT_BAD_BACKGROUND;
}

RTDEF rt_status rt_check_camera(const rt_camera *camera)
{
    if (!camera)
        return RT_BAD_POINTER;
    const bool good = rt__good_place(camera->position) &&
                      rt__good_place(camera->direction) && rt__good_place(camera->up) &&
                      camera->fov_y >= 0.0f && camera->fov_y < 180.0f;
    return good ? RT_OK : RT_BAD_CAMERA;
}

RTDEF int rt_thread_count(int wanted)
{
#ifdef _OPENMP
    if (wanted == 0)
        wanted = omp_get_max_threads();
    return wanted < 1 ? 1 : wanted > 1024 ? 1024 : wanted;
#else
    (void)wanted;
    return 1;
#endif
}

/* One more sample of pixel number i; returns how many rays it took.
 * The mean of n+1 values is the mean of n plus the (n+1)th part of the difference, so the
 * image is a picture after every sample, and the order of the sums is always the same. */
static inline uint32_t rt__add_sample(rt_pixel_function *pixel, const void *context,
                                      uint32_t seed, rt_image *image, int i)
{
    rt_rng rng = rt_rng_start((uint32_t)i, (uint32_t)image->samples, seed);
    const float dx = rt_random(&rng);
    const float dy = rt_random(&rng);
    const int column = i % image->width, row = i / image->width;
    const rt_vec3 value = pixel(context, (float)column + dx, (float)row + dy, &rng);
    rt_vec3 *mean = &image->pixels[i];
    if (image->samples == 0)
        *mean = value;
    else
        *mean = rt_add(
            *mean, rt_scale(rt_sub(value, *mean), 1.0f / (float)(image->samples + 1)));
    return rng.rays;
}

/* Seconds since some moment. */
static inline double rt__seconds(void)
{
#ifdef _OPENMP
    return omp_get_wtime();
#else
    return (double)clock() / (double)CLOCKS_PER_SEC;
#endif
}

/* One sample for every pixel, and again. The pixels are shared out among the threads in
 * bands, so that between two bands all threads rest and the caller can look at the
 * picture. In a band each thread takes the next 32 pixels that nobody has
 * (schedule(dynamic)): a fixed share each would leave one waiting for the other. Every
 * pixel is written by one thread, and everything else that is written is declared inside
 * the loop: that is all it takes for "#pragma omp parallel for" to be right, and -fopenmp
 * for it to be obeyed.
 *
 * A band should last 20 to 60 ms: short enough for a window to answer, long enough not to
 * waste time on waiting for the slowest thread. */
RTDEF rt_status rt_render_pixels(rt_pixel_function *pixel, const void *context,
                                 const rt_options *options, rt_image *image)
{
    static const rt_options defaults = {0, 0, 0, 0, NULL, NULL};
    const rt_options o = options ? *options : defaults;
    if (!pixel || !image || !image->pixels)
        return RT_BAD_POINTER;
    if (image->width < 1 || image->height < 1 || image->width > INT_MAX / image->height)
        return RT_BAD_SIZE;
    const int count = image->width * image->height;
    if (image->done < 0 || image->done >= count)
        return RT_BAD_SIZE;
    const int samples = o.samples == 0 ? 16 : o.samples;
    if (samples < 0 || image->samples < 0 || samples > INT_MAX - image->samples)
        return RT_BAD_SAMPLES;
    if (o.threads < 0 || o.threads > 1024)
        return RT_BAD_THREADS;

    const int threads = rt_thread_count(o.threads);
    const int target = image->samples + samples;
    const double begun = image->samples + (double)image->done / count;
    int band = 1024 * threads;
    while (image->samples < target) {
        const int first = image->done;
        const int last = count - first > band ? first + band : count;
        const double start = rt__seconds();
        uint64_t rays = 0;
#ifdef _OPENMP
#pragma omp parallel for num_threads(threads) schedule(dynamic, 32) reduction(+ : rays)
#endif
        for (int i = first; i < last; i++)
            rays += rt__add_sample(pixel, context, o.seed, image, i);
        const double took = rt__seconds() - start;
        if (took < 0.02)
            band = band > INT_MAX / 2 ? INT_MAX : 2 * band;
        else if (took > 0.06 && band > 64)
            band = band / 2;

        image->rays += rays;
        image->done = last;
        if (last == count) {
            image->done = 0;
            image->samples++;
        }
        const double now = image->samples + (double)image->done / count;
        const float part = (float)((now - begun) / (target - begun));
        if (o.progress && !o.progress(o.user, part) && image->samples < target)
            return RT_CANCELLED;
    }
    return RT_OK;
}

typedef struct rt__view {
    const rt_scene *scene;
    const rt_camera *camera;
    int width, height, bounces;
} rt__view;

static inline rt_vec3 rt__pixel(const void *context, float x, float y, rt_rng *rng)
{
    const rt__view *view = (const rt__view *)context;
    const rt_ray ray = rt_camera_ray(view->camera, view->width, view->height, x, y);
    return rt_radiance(view->scene, &ray, view->bounces, rng);
}

RTDEF rt_status rt_render(const rt_scene *scene, const rt_camera *camera,
                          const rt_options *options, rt_image *image)
{
    if (!scene || !camera || !image)
        return RT_BAD_POINTER;
    const rt_status status = rt_check_scene(scene, NULL);
    if (status != RT_OK)
        return status;
    if (rt_check_camera(camera) != RT_OK)
        return RT_BAD_CAMERA;
    if (options && options->bounces < 0)
        return RT_BAD_BOUNCES;
    rt__view view = {scene, camera, image->width, image->height,
                     options ? options->bounces : 0};
    return rt_render_pixels(rt__pixel, &view, options, image);
}

#ifdef __clang__
#pragma STDC FP_CONTRACT DEFAULT
#endif
#endif /* RT_IMPLEMENTATION */

/*
 * Licence: take whichever of the two you prefer.
 *
 * 1. MIT. Copyright (c) 2026 the rt.h authors. Permission is hereby granted, free of
 * charge, to any person obtaining a copy of this software and associated documentation
 * files (the "Software"), to deal in the Software without restriction, including without
 * limitation the rights to use, copy, modify, merge, publish, distribute, sublicense,
 * and/or sell copies of the Software, and to permit persons to whom the Software is
 * furnished to do so, subject to the following conditions: The above copyright notice
 * and this permission notice shall be included in all copies or substantial portions of
 * the Software. THE SOFTWARE IS PROVIDED "AS IS", WITHOUT WARRANTY OF ANY KIND, EXPRESS
 * OR IMPLIED, INCLUDING BUT NOT LIMITED TO THE WARRANTIES OF MERCHANTABILITY, FITNESS
 * FOR A PARTICULAR PURPOSE AND NONINFRINGEMENT. IN NO EVENT SHALL THE AUTHORS OR
 * COPYRIGHT HOLDERS BE LIABLE FOR ANY CLAIM, DAMAGES OR OTHER LIABILITY, WHETHER IN AN
 * ACTION OF CONTRACT, TORT OR OTHERWISE, ARISING FROM, OUT OF OR IN CONNECTION WITH THE
 * SOFTWARE OR THE USE OR OTHER DEALINGS IN THE SOFTWARE.
 *
 * 2. Public domain (Unlicense). This is free and unencumbered software released into the
 * public domain. Anyone is free to copy, modify, publish, use, compile, sell, or
 * distribute this software, either in source code form or as a compiled binary, for any
 * purpose, commercial or non-commercial, and by any means. The authors dedicate any and
 * all copyright interest in the software to the public domain.
 */

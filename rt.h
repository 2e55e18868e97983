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
 *                 direct and indirect light, on all cores. Part two: glass, gloss,
 *                 patterns, lamps with a size, a sky, a lens, meshes of triangles, shapes
 *                 of your own. C99 and C++17, libc, libm.
 * WHAT IT IS NOT  It opens no files and no windows. It does not print, exit or keep
 *                 global state. It allocates memory only for rt_build_bvh, and while
 *                 rt_render or rt_denoise runs.
 *
 * HOW TO READ IT  From top to bottom. Chapters 0 to 17 are plain C, and each builds on
 *                 those before it; demos/demoNN and docs/NN- have the same numbers. The
 *                 machinery that runs them on all cores, several rays at a time, comes
 *                 last, under RT_IMPLEMENTATION.
 *
 * OPTIONS         Define before the include:
 *                 RT_IMPLEMENTATION  also compile the functions marked RTDEF
 *                 RT_STATIC          make those private to this file
 *                 RTDEF              your own way of declaring them
 *                 RT_NO_PACKETS      one ray at a time only: compiles sooner, runs slower
 *                 RT_PACKETS         packets even without optimisation (slow: for tests)
 *                 RT_MALLOC, RT_FREE in place of malloc and free
 *                 RT_ASSERT          in place of assert, for what cannot happen
 *                 rt_reflect ...     your routine in place of that one: see below
 *
 * CONVENTIONS     Right-handed world, y up; any unit of length in which no detail is
 *                 smaller than 1e-4 (see rt_leave). Colours are linear RGB. Pixel (0,0)
 *                 is top left and covers [0,1] x [0,1] of the film; its centre is (0.5,
 *                 0.5); its value is the mean of the light over its square. A light's
 *                 intensity is in W/sr per channel. Surfaces have two sides. A scene,
 *                 camera, material or options with all fields zero are valid; 0 stands
 *                 for the documented default. Vectors are passed by value, larger things
 *                 by pointer; results come last. Notation of the formulas: ray C + t u,
 *                 sphere of centre O and radius R, point P, normal N, light S at distance
 *                 d in the direction L (|L| = 1), albedo rho, <a,b> scalar product.
 *
 * THREADS         Every function may run at the same time on several threads, as long as
 *                 nobody writes what another reads. rt_render starts its own threads, and
 *                 they meet only when it ends. For more than 65536 shapes rt_build_bvh
 *                 starts some, too, as many as OpenMP offers. After that, GNU's OpenMP
 *                 hangs in a child made by fork() as soon as it needs more than one
 *                 thread: there, set options.threads = 1 and let rt_render build the
 *                 tree, or fork before the first picture.
 * SAME BITS       The picture depends on what is rendered, not on how: not on the number
 *                 of threads or lanes, nor on how samples are split over calls (but see
 *                 rt_render on more than 4096 in one call). Pass -ffp-contract=off for
 *                 that: otherwise gcc contracts a*b+c where the machine allows it
 *                 (-march=native), but not at the same places every time. The flag also
 *                 makes the bits the same on all machines and compilers. -ffast-math is
 *                 refused.
 * ROBUSTNESS      Spheres are intersected in double precision, so that walls of radius
 *                 1e5 work in a room of size 100, and a sphere is hit from 1e12 radii
 *                 away: no wrong hit or miss in 1.8 million rays, t within one rounding.
 *                 Boxes are in float, exact on planes, edges and corners: of 1e9 rays
 *                 that were sent, none left a closed box or a room of six walls.
 *                 Triangles are in double: no ray gets through between two of them, none
 *                 of 19 600 aimed at edges and corners met a wrong one, and in 81 million
 *                 bounces no path left a closed mesh. A ray that leaves a surface starts
 *                 8 roundings off it (rt_leave): no self-hit in 3 million bounces. NaN
 *                 and infinity in a ray or a shape are a miss, never a crash. Sine and
 *                 cosine are our own, so that libm cannot change a path. A valid scene
 *                 raises no floating-point exception (invalid, divide, overflow), so you
 *                 may trap your own; clang needs -ftrapping-math for that. Packets do
 *                 raise some, but rt_render runs them with traps off and then restores
 *                 the flags. How all this is tested: docs/correctness.md.
 * IN C++          Include it outside any namespace, since it includes C headers.
 * ERRORS          rt_render, rt_render_pixels, rt_denoise, rt_build_bvh and rt_check_...
 *                 can fail. They return an rt_status, and rt_status_text says in English
 *                 what was wrong and what to do about it.
 *
 * CONTENTS        0 vectors            rt_vec3, rt_dot, rt_normalize, rt_basis, rt_sincos
 *                 1 rays and spheres   rt_ray, rt_camera_ray, rt_hit_sphere
 *                 2 scenes             rt_scene, rt_intersect, rt_lambert
 *                 3 boxes              rt_hit_box
 *                 4 light and shadow   rt_leave, rt_visible, rt_direct
 *                 5 pixels             rt_encode
 *                 6 mirrors            rt_reflect
 *                 7 indirect light     rt_random, rt_sample_cosine, rt_radiance
 *                 8 many shapes        rt_bvh
 *                 9 less noise         rt_sobol_start
 *                10 clean pictures     rt_guide, rt_first_look, rt_denoise
 *                11 glass              rt_surface, rt_fresnel, rt_refract
 *                12 lamps with a size  rt_lamp, rt_sample_lamp, rt_mis
 *                13 gloss              rt_sample_gloss, rt_gloss, rt_scatter
 *                14 a lens and a sky   rt_lens, rt_lens_ray, rt_sky
 *                15 patterns           rt_albedo
 *                16 triangles          rt_mesh, rt_hit_triangle
 *                17 your own shape     rt_custom_shape
 *                   all of part two    rt_radiance_mis
 *                   pictures           rt_image, rt_options, rt_render, rt_build_bvh
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
#include <string.h>
#ifndef __cplusplus
#include <stdbool.h>
#endif

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error "rt.h: please, no -ffast-math, -Ofast, -ffinite-math-only: they remove NaN tests."
#endif
#if defined(__TINYC__) && __TINYC__ <= 927
#error "rt.h: please, not tcc 0.9.27: it mixes up numbers passed to functions."
#endif
#ifdef _M_FP_FAST
#error "rt.h: please, /fp:precise instead of /fp:fast, which removes NaN tests."
#endif
#ifdef __clang__
#pragma STDC FP_CONTRACT OFF /* undone at the end of the header; gcc needs the flag */
#endif
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic push /* C has no other casts */
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif

#ifdef __GNUC__ /* for the few functions that must be inlined to be fast */
#define RT__INLINE static inline __attribute__((always_inline))
#else
#define RT__INLINE static inline
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

/* Component by component: what a surface of colour b leaves of light a. */
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

/* gcc 12 forgets to round in (double)(float)x when it vectorises x and y by itself. An
 * empty instruction that might change the float prevents that. */
#if defined(__GNUC__) && !defined(__clang__) && defined(__SSE2_MATH__)
#define RT__ROUND(x) __asm__("" : "+x"(x))
#elif defined(__GNUC__) && !defined(__clang__) && defined(__aarch64__)
#define RT__ROUND(x) __asm__("" : "+w"(x))
#else
#define RT__ROUND(x) (void)0
#endif

static inline rt_vec3 rt_to_float(rt_dvec3 v)
{
    rt_vec3 f = rt_vec((float)v.x, (float)v.y, (float)v.z);
    RT__ROUND(f.x);
    RT__ROUND(f.y);
    RT__ROUND(f.z);
    return f;
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

static inline rt_dvec3 rt_dcross(rt_dvec3 a, rt_dvec3 b)
{
    return rt_dvec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* v / |v|. A vector without a direction (zero, infinite or NaN) becomes (0,0,0). */
static inline rt_dvec3 rt_dnormalize(rt_dvec3 v)
{
    const double length = sqrt(rt_ddot(v, v));
    if (!(length > 0.0 && length <= DBL_MAX)) /* written so that NaN fails, too */
        return rt_dvec(0.0, 0.0, 0.0);
    return rt_dscale(v, 1.0 / length);
}

/* The same for floats; in double, because the square of 1e20 does not fit a float. */
static inline rt_vec3 rt_normalize(rt_vec3 v)
{
    return rt_to_float(rt_dnormalize(rt_to_double(v)));
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

/* Sine and cosine of an angle in turns (1 turn = 360 degrees = 2 pi). For turns in [0, 1]
 * the absolute error is below 1e-7; anything else counts as 0. Whole quarter turns are
 * subtracted, which is exact; the rest, at most an eighth of a turn either way, goes into
 * two short polynomials. sinf and cosf will not do: every libm rounds differently, so the
 * pictures would differ. Coefficients: S. Moshier, Cephes library (sinf, cosf), minimax
 * on [-pi/4, pi/4]. */
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
    const bool odd = (quarter & 1) != 0; /* odd quarters swap sine and cosine */
    *sine = ((quarter & 2) != 0 ? -1.0f : 1.0f) * (odd ? c : s);
    *cosine = (((quarter + 1) & 2) != 0 ? -1.0f : 1.0f) * (odd ? s : c);
}

/* ====================================================================================
 * Your own routines
 *
 * These are the functions that chapters 1 to 16 are about. You may write any of them
 * yourself. Say so in one line before the include, and define yours after it:
 *
 *     #define rt_reflect my_reflect
 *     #include "rt.h"
 *
 *     static inline rt_vec3 my_reflect(rt_vec3 incident, rt_vec3 normal)
 *     {
 *         ...
 *     }
 *
 * Now rt_reflect means yours, here and in your program: the definition below is left out,
 * its callers call yours, and rt_render traces one ray at a time, as the chapters do. The
 * lines #ifndef rt_reflect ... #endif around the definition are all it takes. This holds
 * for one file: rt_render is in the one with RT_IMPLEMENTATION. "make try
 * FILE=my_reflect.c" tests your routine and renders the room with it.
 * ==================================================================================== */

struct rt_camera; /* the chapters define them */
struct rt_ray;
struct rt_hit;
struct rt_sphere;
struct rt_box;
struct rt_scene;
struct rt_rng;
struct rt_lamp;
struct rt_lens;
struct rt_mesh;

static inline struct rt_ray rt_camera_ray(const struct rt_camera *camera, int width,
                                          int height, float x, float y);
static inline bool rt_hit_sphere(const struct rt_sphere *sphere, const struct rt_ray *ray,
                                 float t_max, struct rt_hit *hit);
static inline bool rt_intersect(const struct rt_scene *scene, const struct rt_ray *ray,
                                struct rt_hit *hit);
static inline rt_vec3 rt_lambert(rt_vec3 albedo, rt_vec3 normal, rt_vec3 to_light,
                                 rt_vec3 intensity);
static inline bool rt_hit_box(const struct rt_box *box, const struct rt_ray *ray,
                              float t_max, struct rt_hit *hit);
static inline rt_vec3 rt_leave(rt_vec3 point, rt_vec3 normal, rt_vec3 direction);
static inline bool rt_occluded(const struct rt_scene *scene, const struct rt_ray *ray,
                               float t_max);
static inline bool rt_visible(const struct rt_scene *scene, rt_vec3 point, rt_vec3 normal,
                              rt_vec3 light);
static inline rt_vec3 rt_direct(const struct rt_scene *scene, const struct rt_hit *hit,
                                struct rt_rng *rng);
static inline unsigned char rt_encode(float value, double gamma);
static inline rt_vec3 rt_reflect(rt_vec3 incident, rt_vec3 normal);
static inline float rt_random(struct rt_rng *rng);
static inline rt_vec3 rt_sample_cosine(rt_vec3 normal, float r1, float r2);
static inline rt_vec3 rt_radiance(const struct rt_scene *scene,
                                  const struct rt_ray *camera_ray, int bounces,
                                  struct rt_rng *rng);
static inline float rt_fresnel(float cosine, float eta);
static inline bool rt_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted);
static inline rt_vec3 rt_sample_lamp(const struct rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2);
static inline float rt_lamp_density(const struct rt_lamp *lamp, rt_vec3 point,
                                    rt_vec3 direction);
static inline float rt_mis(float density, float other);
static inline rt_vec3 rt_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2);
static inline float rt_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density);
static inline struct rt_ray rt_lens_ray(const struct rt_camera *camera,
                                        const struct rt_lens *lens,
                                        const struct rt_ray *pinhole, float r1, float r2);
static inline bool rt_hit_triangle(const struct rt_mesh *mesh, int triangle,
                                   const struct rt_ray *ray, float t_max,
                                   struct rt_hit *hit);

#if defined(rt_camera_ray) || defined(rt_hit_sphere) || defined(rt_intersect) ||         \
    defined(rt_lambert) || defined(rt_hit_box) || defined(rt_leave) ||                   \
    defined(rt_occluded) || defined(rt_visible) || defined(rt_direct) ||                 \
    defined(rt_reflect) || defined(rt_random) || defined(rt_sample_cosine) ||            \
    defined(rt_radiance) || defined(rt_fresnel) || defined(rt_refract) ||                \
    defined(rt_sample_lamp) || defined(rt_lamp_density) || defined(rt_mis) ||            \
    defined(rt_sample_gloss) || defined(rt_gloss) || defined(rt_lens_ray) ||             \
    defined(rt_hit_triangle)
#define RT__OWN /* no packets: they would not call it */
#endif

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

/* The film of a camera: what all rays of one picture have in common. In double, so that a
 * ray is rounded only once, at the end. */
typedef struct rt__film {
    rt_vec3 position;
    rt_dvec3 forward, right, top;   /* unit vectors; forward (0,0,0): no film */
    double half_width, half_height; /* in pixels */
    double size;                    /* of a pixel, at distance 1 */
} rt__film;

/* tan(degrees / 2) for 0 < degrees < 180, by Lambert's continued fraction,
 *
 *     tan x = x / (1 - x^2 / (3 - x^2 / (5 - ...))),
 *
 * From 90 degrees up it is 1 over the tangent of the other angle of the right-angled
 * triangle. Right to 1e-13, and the same everywhere, which libm's tan is not. J. Lambert,
 * 1761. */
static inline double rt__tan_half(float degrees)
{
    const bool narrow = degrees < 90.0f;
    const double x =
        (double)(narrow ? degrees : 180.0f - degrees) * (3.14159265358979323846 / 360.0);
    double rest = 0.0;
    for (int k = 17; k > 1; k -= 2)
        rest = x * x / (k - rest);
    return narrow ? x / (1.0 - rest) : (1.0 - rest) / x;
}

static inline rt__film rt__film_of(const rt_camera *camera, int width, int height)
{
    rt__film film;
    const float fov_y = camera->fov_y == 0.0f ? 45.0f : camera->fov_y;
    const rt_dvec3 direction = rt_to_double(
        rt_is_zero(camera->direction) ? rt_vec(0.0f, 0.0f, -1.0f) : camera->direction);
    const rt_dvec3 up =
        rt_to_double(rt_is_zero(camera->up) ? rt_vec(0.0f, 1.0f, 0.0f) : camera->up);
    film.position = camera->position;
    film.forward = film.right = film.top = rt_dvec(0.0, 0.0, 0.0);
    film.half_width = 0.5 * (double)width;
    film.half_height = 0.5 * (double)height;
    film.size = 0.0;
    if (!(fov_y > 0.0f && fov_y < 180.0f && width > 0 && height > 0))
        return film;
    film.forward = rt_dnormalize(direction);
    if (rt_ddot(film.forward, film.forward) == 0.0)
        return film;
    /* products of two floats are exact in double, so right is good even if short */
    film.right = rt_dnormalize(rt_dcross(direction, up));
    if (rt_ddot(film.right, film.right) == 0.0) {
        rt_vec3 a, b;
        rt_basis(rt_to_float(film.forward), &a, &b);
        film.right = rt_to_double(a);
    }
    film.top = rt_dcross(film.right, film.forward);
    film.size = 2.0 * rt__tan_half(fov_y) / (double)height;
    return film;
}

static inline rt_ray rt__film_ray(const rt__film *film, float x, float y)
{
    const double to_right = film->size * ((double)x - film->half_width);
    const double to_top = film->size * (film->half_height - (double)y);
    const rt_dvec3 toward =
        rt_dmad(rt_dmad(film->forward, to_right, film->right), to_top, film->top);
    rt_ray ray;
    ray.origin = film->position;
    ray.direction = rt_to_float(rt_dnormalize(toward));
    return ray;
}

/* The ray from the camera through the point (x, y) of a film of width x height pixels;
 * (0,0) is the top left corner of the film, (0.5, 0.5) the centre of the top left pixel.
 *
 * The film stands at distance 1 and is 2 tan(fov_y/2) high; pixels are square. With the
 * unit vectors forward along the camera's direction, right along forward x up, and top =
 * right x forward, the ray's direction is
 *
 *     forward + 2 tan(fov_y/2) / height . ((x - width/2) right + (height/2 - y) top),
 *
 * normalised. y is subtracted because rows count downwards. The three are perpendicular
 * within 1e-6, however close up is to the direction; where up is parallel to it, or not
 * finite, some perpendicular takes its place. The angle of view is right to 1e-5 degrees.
 * A width or height below 1, an angle out of range or a direction that is not finite
 * gives direction (0,0,0): a ray that hits nothing. */
#ifndef rt_camera_ray
static inline rt_ray rt_camera_ray(const rt_camera *camera, int width, int height,
                                   float x, float y)
{
    const rt__film film = rt__film_of(camera, width, height);
    return rt__film_ray(&film, x, y);
}
#endif

/* What a surface does with light. Chapters 2 (albedo) and 6 (mirror) explain it; shapes
 * carry one, so it is declared here. */
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
    int shape; /* its number in the scene: spheres first, then boxes; 0 from rt_hit_... */
    /* The rest is for part two, chapters 16 and 17; 0 for spheres and boxes. */
    int part;    /* of a mesh: which triangle */
    float u, v;  /* where on it */
    bool inside; /* does the ray come from inside the mesh or custom shape? */
} rt_hit;

/* What belongs to part two is 0. */
static inline void rt__only_part_one(rt_hit *hit)
{
    hit->part = 0;
    hit->u = hit->v = 0.0f;
    hit->inside = false;
}

/* The smallest t with 0 < t < t_max for which the ray meets the sphere, or 0.
 *
 * P = C + t u lies on the sphere when |P - O|^2 = R^2. With f = C - O that is
 *
 *     t^2 <u,u> + 2 t <f,u> + <f,f> - R^2 = 0,     a t^2 + 2 b t + c = 0,
 *
 * whose roots are t = (-b -+ sqrt(b^2 - a c)) / a. No real root: the ray passes by. If we
 * are outside (c > 0) and going away (b > 0), both are negative: the sphere is behind us.
 * Otherwise the smaller root is the way in; if it is negative, we are inside, and the
 * larger one is the way out.
 *
 * The formula is the textbook's, but in double. For a wall of radius 1e5, c is a small
 * difference of two numbers near 1e10, and a float keeps seven digits of each: none would
 * be left. Where the sphere is tiny and far away, b^2 - a c is such a difference, and
 * even double does not help. But it equals a (R^2 - |l|^2), where l is the vector f -
 * (b/a) u from the centre to the nearest point of the ray. That subtracts vectors,
 * component by component, and finds a sphere from 1e12 radii away (E. Haines et al.,
 * "Precision improvements for ray/sphere intersection", Ray Tracing Gems, 2019). All
 * comparisons are written so that NaN is a miss. */
#ifndef rt_hit_sphere
static inline double rt__meet_sphere(const rt_sphere *sphere, const rt_ray *ray,
                                     float t_max)
{
    const rt_dvec3 u = rt_to_double(ray->direction);
    const rt_dvec3 f = rt_dsub(rt_to_double(ray->origin), rt_to_double(sphere->center));
    const double radius = (double)sphere->radius;

    const double a = rt_ddot(u, u);
    const double b = rt_ddot(f, u);
    const double ff = rt_ddot(f, f), rr = radius * radius;
    const double c = ff - rr;
    double discriminant = b * b - a * c;
    if (!(a > 0.0 && radius > 0.0) || (c > 0.0 && b >= 0.0))
        return 0.0;
    if (rr < 1e-10 * ff) { /* few digits are left of it */
        const rt_dvec3 l = rt_dmad(f, -b / a, u);
        discriminant = a * (rr - rt_ddot(l, l));
    }
    if (!(discriminant >= 0.0))
        return 0.0;

    const double root = sqrt(discriminant);
    double t = (-b - root) / a;
    if (!(t >= (double)FLT_MIN)) /* a t so small counts as 0 */
        t = (-b + root) / a;
    return t >= (double)FLT_MIN && t <= (double)FLT_MAX && (float)t < t_max ? t : 0.0;
}

/* The hit at this t. In double again; P is put back onto the sphere, at O + R n, so that
 * its error does not grow with t. P - O has length R but for rounding, so one step of
 * Newton's method gives n length 1, unless the sphere is very far away. */
static inline bool rt__hit_sphere_at(const rt_sphere *sphere, const rt_ray *ray, double t,
                                     rt_hit *hit)
{
    const rt_dvec3 u = rt_to_double(ray->direction);
    const rt_dvec3 center = rt_to_double(sphere->center);
    const rt_dvec3 f = rt_dsub(rt_to_double(ray->origin), center);
    rt_dvec3 n = rt_dscale(rt_dmad(f, t, u), 1.0 / (double)sphere->radius);
    const double nn = rt_ddot(n, n);
    if (!(nn > 0.0))
        return false; /* so small and so far away that no direction is left */
    n = rt_dscale(n, fabs(nn - 1.0) < 1e-4 ? 1.5 - 0.5 * nn : 1.0 / sqrt(nn));
    hit->t = (float)t;
    hit->point = rt_to_float(rt_dmad(center, (double)sphere->radius, n));
    hit->normal = rt_to_float(rt_dscale(n, rt_ddot(n, u) > 0.0 ? -1.0 : 1.0));
    hit->material = &sphere->material;
    hit->shape = 0;
    rt__only_part_one(hit);
    return true;
}

/* The first point of the sphere on the ray with 0 < t < t_max: see above.
 *
 * Returns false, and leaves *hit alone, on a miss; NaN or infinity anywhere, a direction
 * of length 0 and a radius that is not positive are misses. */
static inline bool rt_hit_sphere(const rt_sphere *sphere, const rt_ray *ray, float t_max,
                                 rt_hit *hit)
{
    const double t = rt__meet_sphere(sphere, ray, t_max);
    return t > 0.0 && rt__hit_sphere_at(sphere, ray, t, hit);
}
#else /* by yours */
static inline double rt__meet_sphere(const rt_sphere *sphere, const rt_ray *ray,
                                     float t_max)
{
    rt_hit hit;
    return rt_hit_sphere(sphere, ray, t_max, &hit) ? (double)hit.t : 0.0;
}

static inline bool rt__hit_sphere_at(const rt_sphere *sphere, const rt_ray *ray, double t,
                                     rt_hit *hit)
{
    (void)t; /* yours finds it again */
    return rt_hit_sphere(sphere, ray, FLT_MAX, hit);
}
#endif

/* ====================================================================================
 * Chapter 2. Scenes, the nearest hit, Lambert's law
 * ==================================================================================== */

/* An axis-aligned box, explained in chapter 3. */
typedef struct rt_box {
    rt_vec3 min, max; /* two opposite corners, min <= max in each of x, y, z */
    rt_material material;
} rt_box;

typedef struct rt_light {
    rt_vec3 position;  /* S */
    rt_vec3 intensity; /* I in W/sr per channel, not negative */
} rt_light;

/* The light that arrives from far away in this direction: see chapter 14. */
typedef rt_vec3 rt_sky_function(const void *data, rt_vec3 direction);

struct rt_bvh;          /* chapter 8 */
struct rt_surface;      /* 11 */
struct rt_lamp;         /* 12 */
struct rt_mesh;         /* 16 */
struct rt_custom_shape; /* 17 */

/* The arrays are yours: they must live as long as the scene is used. NULL with a count of
 * 0 is fine.
 */
typedef struct rt_scene {
    const rt_sphere *spheres;
    int sphere_count;
    const rt_box *boxes;
    int box_count;
    const rt_light *lights;
    int light_count;
    rt_vec3 background;       /* the light where nothing is hit; 0 is black */
    const struct rt_bvh *bvh; /* for many shapes, see chapter 8; NULL: rt_intersect and
                                 rt_occluded ask each of them */
    /* The rest is for part two, chapters 11 to 17; all zero, it changes nothing. */
    const struct rt_surface *surfaces; /* NULL, or one for each sphere, then each box,
                                          each mesh, each custom shape */
    const struct rt_lamp *lamps;
    int lamp_count;
    rt_sky_function *sky; /* NULL, or in place of the background; gets sky_data */
    const void *sky_data;
    const struct rt_mesh *meshes;
    int mesh_count;
    const struct rt_custom_shape *custom_shapes;
    int custom_shape_count;
} rt_scene;

static inline float rt__meet_box(const rt_box *box, const rt_ray *ray,
                                 float t_max); /* chapter 3 */
static inline bool rt__hit_shape(const rt_scene *scene, int number, const rt_ray *ray,
                                 double t, rt_hit *hit); /* at its end */
static inline bool rt__intersect_bvh(const rt_scene *scene, const rt_ray *ray,
                                     rt_hit *hit); /* chapter 8 */
static inline int rt__nearest_other(const rt_scene *scene, const rt_ray *ray, float t_max,
                                    bool any); /* chapters 16, 17 */

/* The nearest hit of the ray in the scene: ask every shape for a t below the smallest so
 * far, then ask the last that had one for point and normal. Of two at exactly the same
 * distance the first wins, spheres before boxes; hit->shape is its number. Returns false,
 * and leaves *hit alone, if there is none. Part two adds two kinds of shapes, which come
 * after the boxes. */
#ifndef rt_intersect
static inline bool rt_intersect(const rt_scene *scene, const rt_ray *ray, rt_hit *hit)
{
    if (scene->bvh)
        return rt__intersect_bvh(scene, ray, hit); /* the same answer, sooner */
    int best = -1;
    double best_t = 0.0;
    float t_max = FLT_MAX;
    for (int i = 0; i < scene->sphere_count; i++) {
        const double t = rt__meet_sphere(&scene->spheres[i], ray, t_max);
        if (t > 0.0) {
            t_max = (float)t;
            best_t = t;
            best = i;
        }
    }
    for (int i = 0; i < scene->box_count; i++) {
        const float t = rt__meet_box(&scene->boxes[i], ray, t_max);
        if (t > 0.0f) {
            t_max = t;
            best = scene->sphere_count + i;
        }
    }
    const int more = rt__nearest_other(scene, ray, t_max, false);
    if (more >= 0)
        best = more;
    return best >= 0 && rt__hit_shape(scene, best, ray, best_t, hit);
}
#endif

/* Lambert's law: the radiance that a diffuse surface sends, the same in every direction,
 * when a point light of intensity I stands at P + to_light and nothing is in between,
 *
 *     rho/pi . I . max(0, <N,L>) / d^2     with L = to_light / d, d = |to_light|.
 *
 * The intensity spreads over a sphere of area 4 pi d^2: hence 1/d^2. Light that comes in
 * at a grazing angle is spread over more surface: hence the cosine. And 1/pi, because a
 * surface that sends radiance 1 in all directions sends pi W per m^2 in all, and must not
 * send more than it gets. A light behind the surface, or nearer than 1e-10 (I / d^2 must
 * stay a float), gives black. */
#ifndef rt_lambert
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
#endif

/* ====================================================================================
 * Chapter 3. Boxes
 * ==================================================================================== */

/* What is left of a ray between the planes seen so far. It enters the last of their slabs
 * at t_in, through a plane of axis axis_in, and leaves the first at t_out, through one of
 * axis_out. */
typedef struct rt__slabs {
    float t_in, t_out;
    int axis_in, axis_out; /* 0, 1, 2 stand for x, y, z */
} rt__slabs;

/* way / u, at most FLT_MAX: anything farther is as good as infinitely far, and a division
 * that overflows would stop a program that traps overflows. It can only do so where |u|
 * is below 1e-22, since no way is longer than 1e16. */
static inline float rt__quotient(float way, float u)
{
    if (fabsf(u) < 1e-22f && fabsf(way) > fabsf(u) * FLT_MAX)
        return (way > 0.0f) == (u > 0.0f) ? FLT_MAX : -FLT_MAX;
    return way / u;
}

/* Cut with the slab low <= x <= high, on one axis: the ray crosses its two planes at
 * t = (low - C) / u and (high - C) / u. False when nothing is left of the ray. */
static inline bool rt__cut(rt__slabs *slabs, int axis, float low, float high,
                           float origin, float direction)
{
    if (!(low <= high && low >= -FLT_MAX && high <= FLT_MAX)) /* no slab, or no bounds */
        return false;
    if (direction == 0.0f) /* parallel to the planes: always between them, or never */
        return low <= origin && origin <= high;
    const float t_low = rt__quotient(low - origin, direction);
    const float t_high = rt__quotient(high - origin, direction);
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

/* Cut with all three slabs. A box is what they have in common: the ray is inside from
 * its last way in to its first way out. On each axis it crosses the two planes at
 *
 *     t0 = (min - C) / u,     t1 = (max - C) / u,
 *
 * and so, over x, y and z,
 *
 *     t_in = max of min(t0, t1),     t_out = min of max(t0, t1).
 *
 * If t_in > t_out, the ray passes by. Returns the first t with 0 < t < t_max on the
 * surface: t_in or, from inside, t_out; else 0. */
static inline float rt__cut_box(const rt_box *box, const rt_ray *ray, float t_max,
                                rt__slabs *slabs)
{
    const rt_vec3 o = ray->origin, u = ray->direction;
    slabs->t_in = -FLT_MAX;
    slabs->t_out = FLT_MAX;
    slabs->axis_in = slabs->axis_out = 0;
    if (!rt__cut(slabs, 0, box->min.x, box->max.x, o.x, u.x) ||
        !rt__cut(slabs, 1, box->min.y, box->max.y, o.y, u.y) ||
        !rt__cut(slabs, 2, box->min.z, box->max.z, o.z, u.z))
        return 0.0f;
    const float t = slabs->t_in > 0.0f ? slabs->t_in : slabs->t_out;
    return t > 0.0f && t < t_max && t < FLT_MAX ? t : 0.0f; /* FLT_MAX: no plane */
}

/* The first point of the box's surface on the ray with 0 < t < t_max: see above.
 *
 * The normal is that of the plane through which the ray enters or, from inside, leaves;
 * on an edge or corner x comes before y, and y before z. The box is closed: a ray in the
 * plane of a face hits it. A flat box (min.y = max.y, say) is a rectangle.
 *
 * Returns false, and leaves *hit alone, on a miss; NaN, infinity and min > max are
 * misses.
 *
 * Dividing by u, not multiplying by 1/u, and treating u = 0 separately avoids 0 . inf.
 * Float is enough here, since nothing is squared. Method: T. Kay, J. Kajiya, "Ray tracing
 * complex scenes", SIGGRAPH 1986. */
#ifndef rt_hit_box
static inline bool rt_hit_box(const rt_box *box, const rt_ray *ray, float t_max,
                              rt_hit *hit)
{
    const rt_vec3 u = ray->direction;
    rt__slabs slabs;
    const float t = rt__cut_box(box, ray, t_max, &slabs);
    if (!(t > 0.0f))
        return false;
    const bool inside = !(slabs.t_in > 0.0f);

    hit->t = t;
    hit->point = rt_at(ray, t);
    hit->normal = rt_vec(0.0f, 0.0f, 0.0f);
    hit->material = &box->material;
    hit->shape = 0;
    rt__only_part_one(hit);
    /* the normal faces the ray, and the point goes exactly onto the plane */
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

static inline float rt__meet_box(const rt_box *box, const rt_ray *ray, float t_max)
{
    rt__slabs slabs;
    return rt__cut_box(box, ray, t_max, &slabs);
}
#else /* by yours */
static inline float rt__meet_box(const rt_box *box, const rt_ray *ray, float t_max)
{
    rt_hit hit;
    return rt_hit_box(box, ray, t_max, &hit) ? hit.t : 0.0f;
}
#endif

/* A coordinate of P, pulled back a little toward that of the ray's origin C, but not
 * beyond it.
 *
 * P = C + t u is rounded. Next to an edge it may end up on the far side of the
 * neighbouring wall, and from there a path leaves a closed room. The t of each wall is
 * wrong by two roundings at most, and so is t u; P adds one more. 4 eps |P - C| + eps |P|
 * is more than all of them together, so what was strictly between two walls stays
 * strictly between them. */
static inline float rt__pull(float p, float origin)
{
    const float step = FLT_EPSILON * (4.0f * fabsf(p - origin) + fabsf(p));
    const float pulled = p > origin ? p - step : p + step;
    return (pulled > origin) == (p > origin) ? pulled : origin;
}

static inline bool rt__hit_other(const rt_scene *scene, int number, const rt_ray *ray,
                                 rt_hit *hit); /* 16, 17 */

/* Pull P back along the face of a box. */
static inline void rt__pull_back(const rt_ray *ray, rt_hit *hit)
{
    const rt_vec3 p = hit->point, n = hit->normal, o = ray->origin;
    hit->point = rt_vec(n.x == 0.0f ? rt__pull(p.x, o.x) : p.x,
                        n.y == 0.0f ? rt__pull(p.y, o.y) : p.y,
                        n.z == 0.0f ? rt__pull(p.z, o.z) : p.z);
}

/* The hit of the shape with this number: of a sphere at t, unless t is 0. */
static inline bool rt__hit_shape(const rt_scene *scene, int number, const rt_ray *ray,
                                 double t, rt_hit *hit)
{
    const int box = number - scene->sphere_count;
    if (box >= scene->box_count)
        return rt__hit_other(scene, number, ray, hit);
    const rt_sphere *sphere = box < 0 ? &scene->spheres[number] : NULL;
    const bool found = !sphere   ? rt_hit_box(&scene->boxes[box], ray, FLT_MAX, hit)
                       : t > 0.0 ? rt__hit_sphere_at(sphere, ray, t, hit)
                                 : rt_hit_sphere(sphere, ray, FLT_MAX, hit);
    if (!found)
        return false;
    hit->shape = number;
    if (box >= 0)
        rt__pull_back(ray, hit);
    return true;
}

/* ====================================================================================
 * Chapter 4. Light and shadow
 * ==================================================================================== */

/* The start of a ray that leaves the surface at P in the given direction: a little off
 * the surface, along the normal, on the side to which the ray goes,
 *
 *     P +- 8 eps max(1, |x|, |y|, |z|) N,     eps = 2^-23, the spacing of floats at 1.
 *
 * P is rounded, so half of the time it lies just below the surface, and the ray would hit
 * the very surface that it leaves. That shows as black dots, called shadow acne. Skipping
 * small t instead does not help rays that leave at a grazing angle. In a room of 120
 * units the offset is 1.1e-4 at most. */
#ifndef rt_leave
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
#endif

static inline bool rt__occluded_bvh(const rt_scene *scene, const rt_ray *ray,
                                    float t_max); /* chapter 8 */

/* Is there anything on the ray with 0 < t < t_max? Any hit will do, so the search ends
 * with the first one found. */
#ifndef rt_occluded
static inline bool rt_occluded(const rt_scene *scene, const rt_ray *ray, float t_max)
{
    if (scene->bvh)
        return rt__occluded_bvh(scene, ray, t_max);
    for (int i = 0; i < scene->sphere_count; i++)
        if (rt__meet_sphere(&scene->spheres[i], ray, t_max) > 0.0)
            return true;
    for (int i = 0; i < scene->box_count; i++)
        if (rt__meet_box(&scene->boxes[i], ray, t_max) > 0.0f)
            return true;
    return rt__nearest_other(scene, ray, t_max, true) >= 0;
}
#endif

/* Does the point S see the point P of a surface with normal N? A ray from P along S - P
 * reaches S at t = 1: what it meets before is in between, what it meets later does not
 * count. If a light is exactly on a surface, rounding decides whether it is seen. */
#ifndef rt_visible
static inline bool rt_visible(const rt_scene *scene, rt_vec3 point, rt_vec3 normal,
                              rt_vec3 light)
{
    rt_ray shadow;
    shadow.origin = rt_leave(point, normal, rt_sub(light, point));
    shadow.direction = rt_sub(light, shadow.origin);
    return !rt_occluded(scene, &shadow, 1.0f);
}
#endif

/* Looks at the clock from time to time, even during a long path: see rt_render. */
typedef struct rt_watch {
    int ticks; /* look when they have gone by */
    void (*look)(struct rt_watch *watch);
} rt_watch;

/* What one sample of one pixel carries along. Chapter 7 draws the random numbers;
 * counting rays starts here. */
typedef struct rt_rng {
    uint32_t key;       /* made from pixel, sample and seed */
    uint32_t dimension; /* how many numbers were drawn */
    uint32_t rays;      /* how many rays were traced: for statistics only */
    bool sobol;         /* numbers of chapter 9, not random ones, ... */
    uint32_t sample;    /* ... for this sample */
    rt_watch *watch;    /* NULL: nobody looks at the clock */
} rt_rng;

static inline void rt__tick(rt_watch *watch)
{
    if (watch && --watch->ticks <= 0)
        watch->look(watch);
}

/* Direct light: the sum of Lambert's law over the lights that the point sees. Shadow rays
 * are traced only to the lights in front of the surface, and counted in *rng. */
#ifndef rt_direct
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
#endif

/* ====================================================================================
 * Chapter 5. Pixels: from light to bytes
 * ==================================================================================== */

/* The byte that shows a linear value on a screen:
 *
 *     round(255 . clamp(value, 0, 1)^(1/gamma)).
 *
 * The light of a screen goes with byte^2.2, because the eye tells dark tones apart better
 * than bright ones, and there are only 256 steps. Without the power 1/2.2 here, half of
 * full light would be shown as a fifth of it. gamma 1 encodes linearly; 0 means 2.2, and
 * so does a gamma that is negative, infinite or NaN. The clamp comes before the power (a
 * negative base has no power 1/2.2) and is written so that NaN becomes 0; infinity
 * becomes 255. The power is in double, so that every libm gives the same byte: with gamma
 * 2.2 no float is close enough to the middle between two bytes to matter. */
#ifndef rt_encode
static inline unsigned char rt_encode(float value, double gamma)
{
    const float clamped = value > 0.0f ? (value < 1.0f ? value : 1.0f) : 0.0f;
    const double exponent = 1.0 / (gamma > 0.0 && gamma <= DBL_MAX ? gamma : 2.2);
    return (unsigned char)(255.0 * pow((double)clamped, exponent) + 0.5);
}
#endif

/* ====================================================================================
 * Chapter 6. Mirrors
 * ==================================================================================== */

/* The direction in which a mirror with unit normal N reflects the ray I: the part along N
 * is reversed, the rest stays,
 *
 *     R = I - 2 <I,N> N.
 *
 * R is as long as I, and the same for N and -N. */
#ifndef rt_reflect
static inline rt_vec3 rt_reflect(rt_vec3 incident, rt_vec3 normal)
{
    return rt_sub(incident, rt_scale(normal, 2.0f * rt_dot(incident, normal)));
}
#endif

/* ====================================================================================
 * Chapter 7. Indirect light: random numbers, the hemisphere, radiance
 * ==================================================================================== */

/* Mixes 32 bits well into 32 others, one to one. The "PCG hash" of M. Jarzynski and M.
 * Olano, "Hash functions for GPU rendering", JCGT 9(3), 2020, after M. O'Neill's PCG. */
static inline uint32_t rt_hash(uint32_t v)
{
    const uint32_t state = v * 747796405u + 2891336453u;
    const uint32_t word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/* The random numbers of one sample of one pixel; pixel = row * width + column and sample
 * = 0, 1, 2 ... They do not come from one common source, which threads would have to
 * share. Each is a function of (pixel, sample, seed) and of how many were drawn before
 * it: the same on every machine, whatever the order of the pixels and the number of
 * threads. */
static inline rt_rng rt_rng_start(uint32_t pixel, uint32_t sample, uint32_t seed)
{
    rt_rng rng;
    rng.key = rt_hash(pixel + rt_hash(sample + rt_hash(seed)));
    rng.dimension = 0;
    rng.rays = 0;
    rng.sobol = false;
    rng.sample = sample;
    rng.watch = NULL;
    return rng;
}

static inline uint32_t rt__sobol(const rt_rng *rng); /* chapter 9 */

/* The next random number, uniform in (0, 1): the middle of one of 2^23 equal parts. That
 * is exact as a float, and never 0 or 1, for which a direction of the hemisphere could
 * lie in the surface itself. Draw one number per statement: in f(rt_random(r),
 * rt_random(r)) the compiler chooses which comes first, and compilers differ. */
#ifndef rt_random
static inline float rt_random(rt_rng *rng)
{
    const uint32_t bits =
        rng->sobol ? rt__sobol(rng) : rt_hash(rng->key + rng->dimension);
    rng->dimension++;
    return ((float)(bits >> 9) + 0.5f) * (1.0f / 8388608.0f);
}
#endif

/* A direction on the side of the unit normal N, drawn with density <N,direction> / pi,
 * from two uniform numbers r1, r2 in (0, 1): in a basis with z along N,
 *
 *     x = cos(2 pi r1) sqrt(1 - r2),  y = sin(2 pi r1) sqrt(1 - r2),  z = sqrt(r2).
 *
 * That is a uniform point of the unit disc, lifted up onto the hemisphere (Malley's
 * method). Unit length within 3e-7. r2 = 0 gives a direction in the surface itself. */
#ifndef rt_sample_cosine
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
#endif

/* Is nothing left of the light that a float can hold with all its digits? (A product may
 * get stuck at the smallest float, 1.4e-45, and never become 0: 0.8 times that is rounded
 * up to it again.) */
static inline bool rt__is_spent(rt_vec3 throughput)
{
    return throughput.x < FLT_MIN && throughput.y < FLT_MIN && throughput.z < FLT_MIN;
}

/* Russian roulette: the probability with which a path of this throughput goes on. The
 * less there is to expect, the sooner it ends; and it does end even in a white room. */
static inline float rt__chance(rt_vec3 throughput)
{
    float most = throughput.x > throughput.y ? throughput.x : throughput.y;
    most = most > throughput.z ? most : throughput.z;
    return most < 0.95f ? most : 0.95f;
}

/* As many bounces as it takes; roulette ends the path, and begins at this one. */
#define RT_ALL_BOUNCES INT_MAX
#define RT__ROULETTE 4

/* The radiance that comes back along the ray: an estimate from one random path. Its mean
 * over many paths is right.
 *
 * The light that leaves P is the direct light plus what all other surfaces send to P,
 *
 *     Lo = direct + integral of rho/pi . Li(w) . <N,w> dw over the hemisphere.
 *
 * One direction w, drawn with density <N,w>/pi, estimates the integral by the integrand
 * divided by the density: rho . Li(w). Cosine and pi cancel, and Li(w) is the same
 * question again, asked from P. So the path goes on and multiplies by rho at every
 * bounce; that product is its throughput. A mirror leaves no choice of direction: w = R.
 * A path ends when its throughput is spent.
 *
 * bounces is how often the ray may be sent on after its first hit, by mirror or
 * diffusely; 0 is direct light only; negative counts as 0 here, and rt_render refuses it.
 * All later light is left out: in a closed room of albedo rho the picture lacks the part
 * rho^(bounces+1). RT_ALL_BOUNCES leaves nothing out: a path goes on with probability p,
 * and then its throughput is divided by p, so that the mean is the same. That is Russian
 * roulette (J. Arvo, D. Kirk, "Particle transport and image synthesis", SIGGRAPH 1990). A
 * loop, not a recursion: any number of bounces needs the same stack. Random numbers and
 * the count of rays come from *rng.
 *
 * J. Kajiya, "The rendering equation", SIGGRAPH 1986. */
#ifndef rt_radiance
static inline rt_vec3 rt_radiance(const rt_scene *scene, const rt_ray *camera_ray,
                                  int bounces, rt_rng *rng)
{
    rt_ray ray = *camera_ray;
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    rt_vec3 throughput = rt_vec(1.0f, 1.0f, 1.0f);
    for (int bounce = 0;; bounce++) {
        rt_hit hit;
        rng->rays++;
        rt__tick(rng->watch);
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
            if (!rt_is_zero(material->albedo)) /* 0 would mean 1 */
                throughput = rt_mul(throughput, material->albedo);
        } else {
            const float r1 = rt_random(rng);
            const float r2 = rt_random(rng);
            direction = rt_sample_cosine(hit.normal, r1, r2);
            throughput = rt_mul(throughput, material->albedo);
        }
        if (rt__is_spent(throughput))
            return sum; /* no light from farther on would count */
        if (bounces == RT_ALL_BOUNCES && bounce >= RT__ROULETTE) {
            const float chance = rt__chance(throughput), r = rt_random(rng);
            rt_random(rng); /* not used: numbers come in pairs, see chapter 9 */
            if (r >= chance)
                return sum;
            throughput = rt_scale(throughput, 1.0f / chance);
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
}
#endif

/* ====================================================================================
 * Chapter 8. Many shapes
 *
 * If there are ten thousand shapes, rt_intersect as chapter 2 wrote it asks each of them
 * for every ray. But a ray that misses a box misses all that is in the box. So put boxes
 * around neighbouring shapes, boxes around neighbouring boxes, and so on up to one around
 * everything: a bounding volume hierarchy, BVH. A ray then asks some tens of boxes and a
 * handful of shapes, whether there are thousands or millions; the time grows with the
 * logarithm of their number. Nothing else changes: the hit is the same, to the bit.
 *
 * S. Rubin, T. Whitted, "A 3-dimensional representation for fast rendering of complex
 * scenes", SIGGRAPH 1980.
 * ==================================================================================== */

/* The nearest hit of the ray before t_max; or, if hit is NULL, is there any? */
typedef bool rt__search_function(const struct rt_scene *scene, const rt_ray *ray,
                                 float t_max, rt_hit *hit);

/* Up to eight boxes, and what is in each: a leaf of up to eight shapes of one kind, or
 * another node. There are eight, and one array for each coordinate, because a modern core
 * can look at that many at once (see the last section). */
typedef struct rt_bvh_node {
    float min_x[8], min_y[8], min_z[8], max_x[8], max_y[8], max_z[8];
    int inside[8]; /* -n: nodes[n]; else 4 r + kind: the leaf that begins at rows[r] */
    int count;     /* of the boxes */
    unsigned char order[28]; /* for the last section: the order in which rays meet them */
} rt_bvh_node;

/* The first row of a leaf has the numbers of its shapes, -1 for none. The rows that
 * follow are for the last section. They hold a copy of the shapes, column by column: */
typedef union rt_bvh_row {
    int number[8];
    float value[8];
} rt_bvh_row;

enum {
    RT__SPHERES,   /* x, y, z, radius */
    RT__BOXES,     /* min x, y, z, max x, y, z; and custom shapes: boxes around them */
    RT__TRIANGLES, /* A x, y, z, B x, y, z, C x, y, z */
    RT__KINDS
};

/* What rt_build_bvh makes of a scene. All zero is an empty one. */
typedef struct rt_bvh {
    rt_bvh_node *nodes; /* nodes[0] is around everything */
    rt_bvh_row *rows;
    int node_count, row_count;
    int sphere_count, box_count, triangle_count, custom_shape_count;
    int mesh_count;        /* and ... */
    int *triangles_before; /* ... each mesh and after the last, or NULL: few meshes */
    void *memory;          /* where nodes and rows lie */
    rt__search_function *search; /* NULL, or that of the last section */
    struct rt_path *path;        /* NULL, or where rt_trace_pixel notes what is asked */
} rt_bvh;

/* 1/u, but finite for u = 0: so large that what is outside stays outside. */
static inline float rt__inverse(float u)
{
    return fabsf(u) > 1e-37f ? 1.0f / u : u < 0.0f ? -1e37f : 1e37f;
}

/* Cut t_in, t_out down to the part of a ray between two planes of an axis. */
static inline void rt__trim(float low, float high, float origin, float inverse,
                            float *t_in, float *t_out)
{
    const float a = (low - origin) * inverse, b = (high - origin) * inverse;
    const float in = a < b ? a : b, out = a < b ? b : a;
    *t_in = in > *t_in ? in : *t_in;
    *t_out = out < *t_out ? out : *t_out;
}

/* The same in double, where nothing overflows. */
static inline void rt__trim_exactly(float low, float high, float origin, float direction,
                                    double *t_in, double *t_out)
{
    const double inverse = direction != 0.0f ? 1.0 / (double)direction : 1e200;
    const double a = ((double)low - (double)origin) * inverse;
    const double b = ((double)high - (double)origin) * inverse;
    const double in = a < b ? a : b, out = a < b ? b : a;
    *t_in = in > *t_in ? in : *t_in;
    *t_out = out < *t_out ? out : *t_out;
}

/* rt__enter for a ray that is parallel to an axis, or almost: there floats overflow,
 * which would stop a program that traps overflows. */
static inline unsigned rt__enter_parallel(const rt_bvh_node *node, const rt_ray *ray,
                                          float t_max, float *t)
{
    const rt_vec3 o = ray->origin, u = ray->direction;
    unsigned result = 0;
    for (int k = 0; k < node->count; k++) {
        double t_in = 0.0, t_out = (double)t_max;
        rt__trim_exactly(node->min_x[k], node->max_x[k], o.x, u.x, &t_in, &t_out);
        rt__trim_exactly(node->min_y[k], node->max_y[k], o.y, u.y, &t_in, &t_out);
        rt__trim_exactly(node->min_z[k], node->max_z[k], o.z, u.z, &t_in, &t_out);
        t_in *= 1.0 - 4.0 * (double)FLT_EPSILON;
        if (t_in <= t_out) {
            t[k] = (float)t_in;
            result |= 1u << k;
        }
    }
    return result;
}

/* Which of the node's boxes does the ray meet with 0 < t < t_max? Bit k of the result is
 * for box k, and t[k] is where the ray enters it. These are the slabs of chapter 3, with
 * products in place of quotients: the answer may be yes for a ray that misses by a
 * rounding, but never no for one that hits. The error is below 6 roundings: pbrt, section
 * 6.8.2. */
static inline unsigned rt__enter(const rt_bvh_node *node, const rt_ray *ray,
                                 rt_vec3 inverse, float t_max, float *t)
{
    const rt_vec3 o = ray->origin;
    unsigned result = 0;
    if (fabsf(inverse.x) > 1e22f || fabsf(inverse.y) > 1e22f || fabsf(inverse.z) > 1e22f)
        return rt__enter_parallel(node, ray, t_max, t);
    for (int k = 0; k < node->count; k++) {
        float t_in = 0.0f, t_out = t_max;
        rt__trim(node->min_x[k], node->max_x[k], o.x, inverse.x, &t_in, &t_out);
        rt__trim(node->min_y[k], node->max_y[k], o.y, inverse.y, &t_in, &t_out);
        rt__trim(node->min_z[k], node->max_z[k], o.z, inverse.z, &t_in, &t_out);
        t[k] = t_in * (1.0f - 4.0f * FLT_EPSILON);
        if (t[k] <= t_out)
            result |= 1u << k;
    }
    return result;
}

static inline bool rt__is_finite(rt_vec3 v)
{
    return v.x * 0.0f + v.y * 0.0f + v.z * 0.0f == 0.0f; /* infinity and NaN: NaN */
}

/* The number of the lowest bit that is set. */
static inline int rt__lowest(unsigned bits)
{
#ifdef __GNUC__
    return __builtin_ctz(bits);
#else
    int k = 0;
    while ((bits >> k & 1u) == 0)
        k++;
    return k;
#endif
}

static inline float rt__meet_other(const rt_scene *scene, int number, const rt_ray *ray,
                                   float t_max); /* 16, 17 */

/* The t at which the ray meets the shape with this number, or 0. */
static inline float rt__meet_shape(const rt_scene *scene, int number, const rt_ray *ray,
                                   float t_max)
{
    const int box = number - scene->sphere_count;
    return box < 0 ? (float)rt__meet_sphere(&scene->spheres[number], ray, t_max)
           : box < scene->box_count ? rt__meet_box(&scene->boxes[box], ray, t_max)
                                    : rt__meet_other(scene, number, ray, t_max);
}

/* What a ray on its way through the tree has yet to look at: a leaf or a node (inside,
 * see rt_bvh_node), and the t before which it has no hit. One number holds both, with t
 * as its upper half: floats above 0 are in the same order as their bits. */
typedef uint64_t rt__item;

/* So many of them may wait, and never more do. Each node that the search enters puts up
 * to eight on the stack, and one of these is taken off when the search goes further down.
 * So after L levels there are 7 L + 1 at most, and rt_build_bvh makes trees of at most
 * RT__LEVELS levels. */
enum { RT__LEVELS = 32, RT__WAITING = 7 * RT__LEVELS + 1 };

static inline rt__item rt__make_item(float t, int inside)
{
    uint32_t bits;
    memcpy(&bits, &t, sizeof bits);
    return (uint64_t)bits << 32 | (uint32_t)inside;
}

static inline float rt__item_t(rt__item item)
{
    const uint32_t bits = (uint32_t)(item >> 32);
    float t;
    memcpy(&t, &bits, sizeof t);
    return t;
}

/* The nearest shape so far, and where. */
typedef struct rt__best {
    int number; /* -1: none */
    float t;
} rt__best;

/* A little beyond t, since a tie counts. */
static inline float rt__beyond(float t)
{
    const float more = t * FLT_EPSILON + FLT_MIN;
    return t < FLT_MAX - more ? t + more : FLT_MAX;
}

/* Is a shape that is met at t (0: it is not) nearer? Of equals the first wins. */
static inline bool rt__is_better(const rt__best *best, int number, float t)
{
    return t > 0.0f && (t < best->t || (t == best->t && number < best->number));
}

/* Ask all shapes of a leaf. If any will do, returns whether one is met. */
static inline bool rt__ask_leaf(const rt_scene *scene, int leaf, const rt_ray *ray,
                                bool any, rt__best *best)
{
    const int *numbers = scene->bvh->rows[leaf >> 2].number;
    for (int k = 0; k < 8 && numbers[k] >= 0; k++) {
        const float limit = any ? best->t : rt__beyond(best->t);
        const float t = rt__meet_shape(scene, numbers[k], ray, limit);
        if (any && t > 0.0f)
            return true;
        if (rt__is_better(best, numbers[k], t)) {
            best->number = numbers[k];
            best->t = t;
        }
    }
    return false;
}

/* The number of the nearest shape that the ray meets before t_max (of several at the same
 * t, the first), or -1; or if any will do, 0 if there is one. The box that the ray enters
 * first is searched first, so that most of the others turn out to be too far away. */
static inline int rt__search(const rt_scene *scene, const rt_ray *ray, float t_max,
                             bool any)
{
    rt__item waiting[RT__WAITING];
    if (!rt__is_finite(ray->origin) || !rt__is_finite(ray->direction))
        return -1; /* or it would ask all shapes in vain */
    const rt_vec3 inverse =
        rt_vec(rt__inverse(ray->direction.x), rt__inverse(ray->direction.y),
               rt__inverse(ray->direction.z));
    const rt_bvh_node *node = scene->bvh->nodes;
    rt__best best;
    best.number = -1;
    best.t = t_max;
    float t[8];
    int count = 0;
    for (;;) {
        const int before = count;
        rt__item first = UINT64_MAX;
        for (unsigned in = rt__enter(node, ray, inverse, best.t, t); in != 0;
             in &= in - 1u) {
            const int k = rt__lowest(in);
            const rt__item item = rt__make_item(t[k], node->inside[k]);
            waiting[count++] = item > first ? item : first;
            first = item < first ? item : first;
        }
        if (count > before) {
            /* waiting[before] is UINT64_MAX, which nobody needs: the last item goes
             * there, and the nearest comes last, to be taken first */
            waiting[before] = waiting[count - 1];
            waiting[count - 1] = first;
        }
        for (node = NULL; !node;) {
            if (count == 0)
                return best.number;
            const rt__item item = waiting[--count];
            if (rt__item_t(item) > best.t)
                continue;
            const int inside = (int)(uint32_t)item;
            if (inside < 0)
                node = &scene->bvh->nodes[-inside];
            else if (rt__ask_leaf(scene, inside, ray, any, &best))
                return 0;
        }
    }
}

static inline bool rt__intersect_noted(const rt_scene *scene, const rt_ray *ray,
                                       rt_hit *hit); /* at the end */
static inline bool rt__occluded_noted(const rt_scene *scene, const rt_ray *ray,
                                      float t_max);

static inline bool rt__intersect_bvh(const rt_scene *scene, const rt_ray *ray,
                                     rt_hit *hit)
{
    if (scene->bvh->path)
        return rt__intersect_noted(scene, ray, hit);
#ifndef RT__OWN /* finds the same sooner, but calls no routine of yours */
    if (scene->bvh->search)
        return scene->bvh->search(scene, ray, FLT_MAX, hit);
#endif
    const int number = rt__search(scene, ray, FLT_MAX, false);
    return number >= 0 && rt__hit_shape(scene, number, ray, 0.0, hit);
}

static inline bool rt__occluded_bvh(const rt_scene *scene, const rt_ray *ray, float t_max)
{
    if (scene->bvh->path)
        return rt__occluded_noted(scene, ray, t_max);
#ifndef RT__OWN
    if (scene->bvh->search)
        return scene->bvh->search(scene, ray, t_max, NULL);
#endif
    return rt__search(scene, ray, t_max, true) >= 0;
}

/* ====================================================================================
 * Chapter 9. Less noise from the same rays
 *
 * Random numbers fall in clumps and leave gaps: of 16 in (0, 1), rarely does each
 * sixteenth get one. What falls into the gaps is missed, and that is noise. Numbers
 * chosen to fill the interval evenly, however many are taken, see more with the same
 * rays. With random numbers the error falls as 1/sqrt(n). With these it falls faster, the
 * more so the smoother the picture: in the room about as n^-0.6.
 * ==================================================================================== */

/* The 32 bits in reverse order: swap halves, then quarters, and so on. */
static inline uint32_t rt__reverse(uint32_t v)
{
    v = v << 16 | v >> 16;
    v = (v & 0x00ff00ffu) << 8 | (v >> 8 & 0x00ff00ffu);
    v = (v & 0x0f0f0f0fu) << 4 | (v >> 4 & 0x0f0f0f0fu);
    v = (v & 0x33333333u) << 2 | (v >> 2 & 0x33333333u);
    return (v & 0x55555555u) << 1 | (v >> 1 & 0x55555555u);
}

/* Owen's scrambling, of reversed bits: a random decision, which depends on the key and
 * the bits below, keeps or flips each bit. (In terms of the interval (0, 1): swap its
 * halves or not, then the halves of each half, each pair by its own coin, and so on. What
 * was evenly spread stays so.) One to one. The hash is that of N. Vegdahl, "Building a
 * better LK hash", 2021, after S. Laine, T. Karras 2011 and B. Burley, "Practical
 * hash-based Owen scrambling", JCGT 9(4), 2020. */
static inline uint32_t rt__scramble(uint32_t v, uint32_t key)
{
    v ^= v * 0x3d20adeau;
    v += key;
    v *= (key >> 16) | 1u;
    v ^= v * 0x05526c56u;
    return v ^ v * 0x53a22864u;
}

/* Turns the index of a sample into the second coordinate of Sobol's points, reversed: bit
 * i of the result is the sum modulo 2 of the bits k >= i of the index for which the
 * binomial coefficient (k over i) is odd, in 5 steps instead of 32. (The first coordinate
 * is the index itself, reversed.) I. Sobol, 1967. */
static inline uint32_t rt__second(uint32_t v)
{
    v ^= v >> 16 & 0x0000ffffu;
    v ^= v >> 8 & 0x00ff00ffu;
    v ^= v >> 4 & 0x0f0f0f0fu;
    v ^= v >> 2 & 0x33333333u;
    return v ^ (v >> 1 & 0x55555555u);
}

/* Like rt_rng_start: the numbers of one sample of one pixel, for rt_random to hand out.
 * Over the samples 0, 1, 2 ... of a pixel, each number fills its interval evenly, and
 * each pair (the 1st with the 2nd, the 3rd with the 4th) its square: cut the square into
 * 2^k equal rectangles, by halving again and again in any way, and one of the first 2^k
 * samples falls into each. They are Sobol's first two dimensions, scrambled by Owen's
 * method (A. Owen, 1997) with keys that differ from pixel to pixel. Each pair takes the
 * samples in an order of its own; otherwise all pairs would do the same, and the picture
 * would be wrong. */
static inline rt_rng rt_sobol_start(uint32_t pixel, uint32_t sample, uint32_t seed)
{
    rt_rng rng = rt_rng_start(pixel, 0, seed);
    rng.sobol = true;
    rng.sample = sample;
    return rng;
}

static inline uint32_t rt__sobol(const rt_rng *rng)
{
    const uint32_t key = rt_hash(rng->key + (rng->dimension >> 1)); /* of the pair */
    const uint32_t index = rt__reverse(rt__scramble(rt__reverse(rng->sample), key));
    if ((rng->dimension & 1u) == 0)
        return rt__reverse(rt__scramble(index, rt_hash(key + 1u)));
    return rt__reverse(rt__scramble(rt__second(index), rt_hash(key + 2u)));
}

/* ====================================================================================
 * Chapter 10. A clean picture from few rays
 *
 * With few rays every pixel is wrong, but each in its own way, and its neighbours mostly
 * see the same surface in nearly the same light. So a mean over neighbours is nearer to
 * the truth than any one of them, if the right ones are asked. The camera rays tell
 * which: what a pixel sees, and how much light the lamps send there directly, has hardly
 * any noise. So
 *
 *     pixel = direct + albedo . light,
 *
 * and only the light, which arrives by way of other surfaces, is taken from the
 * neighbours (rt_denoise, below):
 *
 *  1. Smooth. Take means over 5 x 5 pixels, then over 5 x 5 that are twice as far apart,
 *     then four times, then eight (a trous, "with holes"): four times 25 pixels reach as
 *     far as 61 x 61. A pixel that sees another surface, or light that differs by more
 *     than noise can explain, counts little.
 *  2. Edges. A pixel that sees two surfaces has no neighbours like itself. It is a
 *     mixture of two opposite ones, and the guides tell in what proportion.
 *  3. Doubt. Where the outcome is farther from the noisy pixels than their noise can
 *     explain, it is wrong, and part of the noisy pixels is put back. So with more
 *     samples the picture tends to the truth.
 *
 * H. Dammertz et al., "Edge-avoiding a-trous wavelet transform for fast global
 * illumination filtering", HPG 2010; C. Schied et al., "Spatiotemporal variance-guided
 * filtering", HPG 2017. Steps 2 and 3 are ours. What all this gains: docs/10-clean.md.
 * ==================================================================================== */

/* What the camera rays of a pixel tell at once about the first surface that is no mirror,
 * and about the light that comes without a detour. In an image these are means over its
 * samples. Where there is no surface, all but direct is zero. */
typedef struct rt_guide {
    rt_vec3 normal, point; /* of that surface; the point is in the world */
    rt_vec3 albedo;        /* the part of its light from other surfaces that arrives here:
                              its albedo, times that of the mirrors before it */
    rt_vec3 direct;        /* its direct light, or the background */
    rt_vec3 half;          /* of direct, the mean of every second sample */
} rt_guide;

/* Follow the camera ray to the first surface that is no mirror, as rt_radiance does with
 * so many bounces, over four mirrors at most. (What comes by way of more is smoothed on
 * the last of them.) If it meets none, direct is the background and all else 0. direct
 * is, to the bit, what rt_radiance adds up until then; it asks the lamps, and *rng counts
 * those rays. */
static inline rt_guide rt_first_look(const rt_scene *scene, const rt_ray *camera_ray,
                                     int bounces, rt_rng *rng)
{
    rt_ray ray = *camera_ray;
    rt_vec3 throughput = rt_vec(1.0f, 1.0f, 1.0f);
    rt_guide guide;
    memset(&guide, 0, sizeof guide);
    for (int bounce = 0;; bounce++) {
        rt_hit hit;
        if (!rt_intersect(scene, &ray, &hit)) {
            guide.direct = rt_mul(throughput, scene->background);
            return guide;
        }
        const rt_material *material = hit.material;
        if (!material->mirror)
            guide.direct = rt_mul(throughput, rt_direct(scene, &hit, rng));
        if (!(material->mirror && rt_is_zero(material->albedo)))
            throughput = rt_mul(throughput, material->albedo);
        if (!material->mirror || bounce >= bounces || bounce >= RT__ROULETTE) {
            guide.normal = hit.normal;
            guide.point = hit.point;
            guide.albedo = throughput;
            return guide;
        }
        const rt_vec3 direction = rt_reflect(ray.direction, hit.normal);
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
}

/* How unlike two pixels are, by what they see: 0 if it is the same plane, about 1 if
 * neither should ask the other. |N1 - N2|^2 counts, and so does how far each point lies
 * off the plane of the other, as the sine of an angle, which does not depend on the unit
 * of length. */
RT__INLINE float rt__unlike(rt_vec3 normal1, rt_vec3 point1, rt_vec3 normal2,
                            rt_vec3 point2)
{
    const rt_vec3 turned = rt_sub(normal1, normal2), way = rt_sub(point2, point1);
    const float off1 = rt_dot(normal1, way), off2 = rt_dot(normal2, way);
    return 20.0f * rt_dot(turned, turned) +
           50.0f * (off1 * off1 + off2 * off2) / (rt_dot(way, way) + FLT_MIN);
}

/* How much one pixel has to say to another, 0 to 1: about e^-x, without libm, where x is
 * how unlike they are, plus d^2 / noise. d is the difference of their light, and noise is
 * what is usual for pixels of these variances: six deviations still count as near, since
 * the pixels are yet to be smoothed. */
RT__INLINE float rt__say(float unlike, float light1, float variance1, float light2,
                         float variance2)
{
    const float d = light1 - light2, noise = 36.0f * (variance1 + variance2) + FLT_MIN;
    const float root = noise / (noise * (1.0f + 0.25f * unlike) + 0.25f * d * d);
    return root * root * root * root;
}

/* If a pixel is a mixture of two others, (1-t) of the left and t of the right, what is t?
 * The one that comes nearest, for a vector of normal, albedo and point: the foot of the
 * perpendicular. *off is the square of how far off it still is. */
RT__INLINE float rt__mixture(const rt_vec3 *pixel, const rt_vec3 *left,
                             const rt_vec3 *right, float *off)
{
    const rt_vec3 n = rt_sub(right[0], left[0]), n0 = rt_sub(pixel[0], left[0]);
    const rt_vec3 a = rt_sub(right[1], left[1]), a0 = rt_sub(pixel[1], left[1]);
    const rt_vec3 p = rt_sub(right[2], left[2]), p0 = rt_sub(pixel[2], left[2]);
    const float unit = 1.0f / (rt_dot(p, p) + rt_dot(p0, p0) + FLT_MIN);
    const float all = rt_dot(n, n) + rt_dot(a, a) + unit * rt_dot(p, p);
    const float part = rt_dot(n, n0) + rt_dot(a, a0) + unit * rt_dot(p, p0);
    float t = part / (all + FLT_MIN);
    t = t > 0.0f ? t < 1.0f ? t : 1.0f : 0.0f;
    const rt_vec3 n1 = rt_sub(n0, rt_scale(n, t)), a1 = rt_sub(a0, rt_scale(a, t));
    const rt_vec3 p1 = rt_sub(p0, rt_scale(p, t));
    *off = rt_dot(n1, n1) + rt_dot(a1, a1) + unit * rt_dot(p1, p1);
    return t;
}

/* How much of the noisy pixels comes back, 0 to 1. differ is the mean square of how far
 * they are from the outcome, and noise is their variance; the rest is the square of the
 * mistake. It is weighed against the noise as two variances are in a mean. Noise counts
 * twice, lest chance look like a mistake, and more while there are so few samples that
 * its variance is hardly known. */
RT__INLINE float rt__doubt(float differ, float noise, int samples)
{
    const float most = (2.0f + 8.0f / (float)samples) * noise;
    const float mistake = differ > most ? differ - most : 0.0f;
    return mistake / (mistake + noise + FLT_MIN);
}

/* ====================================================================================
 * Part two: what else a surface, a lamp and a camera can be
 *
 * Part one knows matt surfaces and mirrors, lamps that are points, and a camera that is a
 * pinhole. Chapters 11 to 17 bring the rest. None of it changes anything above: a scene
 * without a table of surfaces has those of part one. The loop that puts the chapters
 * together, rt_radiance_mis, comes at the end.
 *
 * Chapter 11. Glass
 * ==================================================================================== */

/* The albedo at the point P of a surface with normal N: see chapter 15. */
typedef rt_vec3 rt_pattern_function(const void *data, rt_vec3 point, rt_vec3 normal);

/* What a surface does beyond its rt_material. All zero: nothing. */
typedef struct rt_surface {
    float eta;          /* 0: not glass. Otherwise the shape is clear glass, and this is
                           its refractive index, 1 to 4: water 1.33, glass 1.5, diamond
                           2.42; its material does not count */
    rt_vec3 absorption; /* of the glass: what light loses per unit of length, see
                           rt_transmittance */
    float shininess;    /* chapter 13. 0: matt, or a perfect mirror. Above, up to 1e6: a
                           gloss, sharper the larger it is. A mirror becomes a rough
                           metal, a matt surface gets a coat of clear lacquer */
    rt_vec3 emission;   /* radiance that it sends by itself, the same in all directions.
                           Only chance finds it; make small lights an rt_lamp */
    rt_pattern_function *pattern; /* chapter 15: in place of the albedo; NULL: none */
    const void *pattern_data;     /* handed to it */
} rt_surface;

static inline int rt__other_number(const rt_scene *scene,
                                   const rt_material *material); /* 16, 17 */

/* The number of the shape that was hit. A routine of your own need not set it; then it is
 * the shape that has the material. -1 if there is none. */
static inline int rt__shape_number(const rt_scene *scene, const rt_hit *hit)
{
#ifdef rt_intersect
    for (int i = 0; i < scene->sphere_count; i++)
        if (&scene->spheres[i].material == hit->material)
            return i;
    for (int i = 0; i < scene->box_count; i++)
        if (&scene->boxes[i].material == hit->material)
            return scene->sphere_count + i;
    return rt__other_number(scene, hit->material);
#else
    (void)scene;
    return hit->shape;
#endif
}

/* The surface that was hit: from the scene's table, or all zero if there is none. */
static inline const rt_surface *rt_surface_of(const rt_scene *scene, const rt_hit *hit)
{
    static const rt_surface plain = {
        0.0f, {0.0f, 0.0f, 0.0f}, 0.0f, {0.0f, 0.0f, 0.0f}, NULL, NULL};
    const int number = scene->surfaces ? rt__shape_number(scene, hit) : -1;
    return number < 0 ? &plain : &scene->surfaces[number];
}

/* Did the ray come from inside the shape? Then N, which is on the ray's side, points
 * inward. */
static inline bool rt_is_inside(const rt_scene *scene, const rt_hit *hit)
{
    const int number = rt__shape_number(scene, hit), box = number - scene->sphere_count;
    if (number < 0)
        return false;
    if (box >= scene->box_count) /* chapters 16 and 17 */
        return hit->inside;
    const rt_vec3 middle =
        box < 0 ? scene->spheres[number].center
                : rt_scale(rt_add(scene->boxes[box].min, scene->boxes[box].max), 0.5f);
    return rt_dot(rt_sub(hit->point, middle), hit->normal) < 0.0f;
}

/* The part of the light that a surface of glass reflects, 0 to 1; the rest goes through.
 * The ray comes in at the angle i to the normal, cosine = cos i > 0, and would go on at
 * the angle t; eta is the refractive index behind the surface over the index before it.
 * Then
 *
 *     sin t = sin i / eta                                        (Snell's law)
 *     p = (eta cos i - cos t) / (eta cos i + cos t)
 *     s = (cos i - eta cos t) / (cos i + eta cos t)
 *     F = (p^2 + s^2) / 2                                        (A. Fresnel, 1823)
 *
 * for light that is polarised half one way, half the other. If sin t would be above 1,
 * all of it is reflected: 1. sin^2 i is computed as (1 - cos i)(1 + cos i), which loses
 * no digits near cos i = 1. Near the critical angle F rises like a root, and is right
 * only to 1e-4. */
#ifndef rt_fresnel
static inline float rt_fresnel(float cosine, float eta)
{
    const float sin2 = (1.0f - cosine) * (1.0f + cosine) / (eta * eta);
    if (!(sin2 < 1.0f))
        return 1.0f;
    const float through = sqrtf(1.0f - sin2);
    const float p = (eta * cosine - through) / (eta * cosine + through);
    const float s = (cosine - eta * through) / (cosine + eta * through);
    return 0.5f * (p * p + s * s);
}
#endif

/* The direction in which the ray I, of length 1, goes on behind the surface; N is on the
 * side that it comes from, eta the index behind the surface over the index before it:
 *
 *     T = I / eta + (cos i / eta - cos t) N.
 *
 * The part along the surface shrinks by eta, which is Snell's law; the part along -N
 * makes the length 1. Returns false, and leaves *refracted alone, where there is no such
 * direction: total reflection. */
#ifndef rt_refract
static inline bool rt_refract(rt_vec3 incident, rt_vec3 normal, float eta,
                              rt_vec3 *refracted)
{
    const float cosine = -rt_dot(incident, normal);
    const float sin2 = (1.0f - cosine) * (1.0f + cosine) / (eta * eta);
    if (!(sin2 < 1.0f))
        return false;
    *refracted = rt_add(rt_scale(incident, 1.0f / eta),
                        rt_scale(normal, cosine / eta - sqrtf(1.0f - sin2)));
    return true;
}
#endif

/* e^-x for x >= 0, with a relative error below 2e-7; 0 for x of 87 or more, 1 for NaN.
 * e^-x = 2^-k e^r, where k is x / ln 2, rounded, and r is the rest, between -0.35 and
 * 0.35. ln 2 is subtracted in two parts; the first is short, so that k times it is exact.
 * rt_sincos says why this is not expf; the coefficients are also Cephes' (expf). */
static inline float rt__exp_minus(float x)
{
    if (!(x < 87.0f))
        return x >= 87.0f ? 0.0f : 1.0f;
    if (!(x > 0.0f))
        return 1.0f;
    const int k = (int)(x * 1.44269504089f + 0.5f);
    const float r = ((float)k * 0.693359375f - x) - (float)k * 2.12194440e-4f;
    float e = 1.9875691500e-4f;
    e = e * r + 1.3981999507e-3f;
    e = e * r + 8.3334519073e-3f;
    e = e * r + 4.1665795894e-2f;
    e = e * r + 1.6666665459e-1f;
    e = e * r + 5.0000001201e-1f;
    e = e * r * r + r + 1.0f;
    const uint32_t bits = (uint32_t)(127 - k) << 23; /* 2^-k */
    float power;
    memcpy(&power, &bits, sizeof power);
    return e * power;
}

/* The part of light that is left after this distance in glass: exp(-absorption .
 * distance), for each channel (P. Bouguer, 1729; called Beer's law). */
static inline rt_vec3 rt_transmittance(rt_vec3 absorption, float distance)
{
    return rt_vec(rt__exp_minus(absorption.x * distance),
                  rt__exp_minus(absorption.y * distance),
                  rt__exp_minus(absorption.z * distance));
}

/* ====================================================================================
 * Chapter 12. Lamps with a size
 *
 * A lamp is a black body that shines. It has the same radiance from wherever it is seen,
 * and hides what is behind it, even another lamp. So lamps should not overlap.
 * ==================================================================================== */

typedef struct rt_lamp {
    rt_vec3 center;
    float radius;      /* of a ball, 1e-6 or more; 0: a parallelogram */
    rt_vec3 intensity; /* I in W/sr per channel: from far away, straight in front if it is
                          a parallelogram, it lights like an rt_light of this intensity */
    rt_vec3 u, v; /* if radius is 0: half of each of its two sides. The corners are center
                     +- u +- v; both faces shine */
} rt_lamp;

/* The area of a parallelogram; in double, since the square of 1e30 is no float. */
static inline float rt__lamp_area(const rt_lamp *lamp)
{
    const rt_dvec3 n = rt_dcross(rt_to_double(lamp->u), rt_to_double(lamp->v));
    return (float)(4.0 * sqrt(rt_ddot(n, n)));
}

/* The radiance of the lamp, from wherever it is seen: L = I over the area that it shows,
 * pi R^2 for a ball. */
static inline rt_vec3 rt_lamp_radiance(const rt_lamp *lamp)
{
    const float area = lamp->radius > 0.0f ? 3.14159265359f * lamp->radius * lamp->radius
                                           : rt__lamp_area(lamp);
    return rt_scale(lamp->intensity, 1.0f / area);
}

/* The t with 0 < t < t_max at which the ray meets the lamp, or 0. A parallelogram is met
 * where C + t u lies in its plane, and the point is center + a u + b v with |a|, |b| <=
 * 1. With n = u x v, w = v x n and so on, a = <P - center, w> / <u, w>. */
static inline float rt_meet_lamp(const rt_lamp *lamp, const rt_ray *ray, float t_max)
{
    if (lamp->radius > 0.0f) {
        rt_sphere ball;
        memset(&ball, 0, sizeof ball);
        ball.center = lamp->center;
        ball.radius = lamp->radius;
        return (float)rt__meet_sphere(&ball, ray, t_max);
    }
    const rt_vec3 n = rt_normalize(rt_cross(lamp->u, lamp->v));
    const float toward = rt_dot(ray->direction, n);
    const float way = rt_dot(rt_sub(lamp->center, ray->origin), n);
    if (!(1e-17f * fabsf(way) < fabsf(toward))) /* along the plane, or nearly so */
        return 0.0f;
    const float t = way / toward;
    if (!(t > 0.0f && t < t_max))
        return 0.0f;
    const rt_vec3 p = rt_sub(rt_at(ray, t), lamp->center);
    const rt_vec3 across_v = rt_cross(lamp->v, n), across_u = rt_cross(lamp->u, n);
    const bool met = fabsf(rt_dot(p, across_v)) <= fabsf(rt_dot(lamp->u, across_v)) &&
                     fabsf(rt_dot(p, across_u)) <= fabsf(rt_dot(lamp->v, across_u));
    return met ? t : 0.0f;
}

/* The number of the nearest lamp that the ray meets before t_max, except the lamp number
 * but; -1: none. */
static inline int rt__nearest_lamp(const rt_scene *scene, const rt_ray *ray, float t_max,
                                   int but)
{
    int best = -1;
    for (int i = 0; i < scene->lamp_count; i++) {
        const float t = i == but ? 0.0f : rt_meet_lamp(&scene->lamps[i], ray, t_max);
        if (t > 0.0f) {
            t_max = t;
            best = i;
        }
    }
    return best;
}

/* Seen from P, a ball reaches to the angle a on either side of its centre, sin a = R / d.
 * It takes up the part (1 - cos a) / 2 of all directions. This difference is
 *
 *     1 - cos a = s / (1 + sqrt(1 - s)),        s = sin^2 a,
 *
 * where no digits are lost if the ball is small. The result is 0 if P is inside the ball,
 * or so far away that the ball has no size any more. */
static inline float rt__cap(const rt_lamp *lamp, rt_vec3 point)
{
    const rt_vec3 to_center = rt_sub(lamp->center, point);
    const float dd = rt_dot(to_center, to_center), rr = lamp->radius * lamp->radius;
    if (!(rr < dd && rr > 1e-30f * dd))
        return 0.0f;
    const float s = rr / dd;
    return s / (1.0f + sqrtf(1.0f - s));
}

/* A point S of the lamp that P may see, from two uniform numbers r1, r2 in (0, 1), drawn
 * with the density of rt_lamp_density.
 *
 * P sees a ball within a cone of half-angle a, see above. All directions of the cone are
 * equally likely: 1 - cos is uniform in (0, 1 - cos a). S is where the direction first
 * meets the ball. On a parallelogram all points are equally likely. */
#ifndef rt_sample_lamp
static inline rt_vec3 rt_sample_lamp(const rt_lamp *lamp, rt_vec3 point, float r1,
                                     float r2)
{
    if (!(lamp->radius > 0.0f))
        return rt_add(lamp->center, rt_add(rt_scale(lamp->u, 2.0f * r1 - 1.0f),
                                           rt_scale(lamp->v, 2.0f * r2 - 1.0f)));
    const rt_vec3 to_center = rt_sub(lamp->center, point);
    const float d = rt_length(to_center), down = r2 * rt__cap(lamp, point); /* 1 - cos */
    const float sine = sqrtf(down * (2.0f - down));
    float s, c;
    rt_sincos(r1, &s, &c);
    rt_vec3 a, b, n = rt_scale(to_center, 1.0f / d);
    rt_basis(n, &a, &b);
    const rt_vec3 direction = rt_add(rt_add(rt_scale(a, c * sine), rt_scale(b, s * sine)),
                                     rt_scale(n, 1.0f - down));
    /* the way to the near side of the ball */
    const float off = d * sine, rest = lamp->radius * lamp->radius - off * off;
    const float t = d * (1.0f - down) - sqrtf(rest > 0.0f ? rest : 0.0f);
    return rt_add(point, rt_scale(direction, t));
}
#endif

/* The density, per steradian, with which rt_sample_lamp chooses this direction, of length
 * 1, from P; the direction must meet the lamp. 0: never.
 *
 * For a ball it is 1 / (2 pi (1 - cos a)) with sin a = R / d. For a parallelogram of area
 * A, seen at the angle b, it is d^2 / (A |cos b|): the farther away a square metre is,
 * and the flatter it is seen, the less of the sphere of directions it takes up. */
#ifndef rt_lamp_density
static inline float rt_lamp_density(const rt_lamp *lamp, rt_vec3 point, rt_vec3 direction)
{
    if (lamp->radius > 0.0f) {
        const float cap = rt__cap(lamp, point);
        return cap > 0.0f ? 1.0f / (6.28318530718f * cap) : 0.0f;
    }
    const rt_vec3 n = rt_normalize(rt_cross(lamp->u, lamp->v));
    const float area = rt__lamp_area(lamp), cosine = fabsf(rt_dot(direction, n));
    const float way = rt_dot(rt_sub(lamp->center, point), n);
    if (!(cosine > 1e-6f))
        return 0.0f; /* on edge */
    const float d = way / cosine, dd = d * d;
    return dd * 1e-14f < area ? dd / area / cosine : 0.0f;
}
#endif

/* The weight of a direction that either of two ways of drawing might have found. density
 * is that of the way that did find it, other that of the other way:
 *
 *     w = density^2 / (density^2 + other^2).
 *
 * Each of the two counts with its weight, and the two weights add up to 1: nothing is
 * counted twice, and the way that is likelier to find a direction counts for more. That
 * is multiple importance sampling, with the power heuristic: E. Veach, L. Guibas,
 * "Optimally combining sampling techniques for Monte Carlo rendering", SIGGRAPH 1995.
 * Squares of floats may overflow; their ratio, where it counts, does not. */
#ifndef rt_mis
static inline float rt_mis(float density, float other)
{
    if (!(density > 1e-15f * other))
        return 0.0f;
    const float ratio = other / density;
    return 1.0f / (1.0f + ratio * ratio);
}
#endif

/* ====================================================================================
 * Chapter 13. Gloss
 *
 * A rough surface is made of tiny mirrors, microfacets, that do not all face the same
 * way. The smoother it is, the more of them face along N, and the sharper its reflections
 * are.
 *
 * How many face which way follows T. Trowbridge and K. Reitz (1975), called GGX since B.
 * Walter et al., "Microfacet models for refraction through rough surfaces", EGSR 2007:
 *
 *     D(h) = a^2 / (pi (<N,h>^2 (a^2 - 1) + 1)^2),        a^2 = 2 / (shininess + 2).
 *
 * The name shininess comes from the exponent in B. Phong, "Illumination for computer
 * generated pictures", 1975. Along N there are as many facets here as in the lobe
 * (shininess + 2) / (2 pi) <N,h>^shininess. Phong's lobe itself loses half of the light
 * at 60 degrees, whatever the exponent: see docs/13-gloss.md.
 * ==================================================================================== */

static inline float rt__roughness2(float shininess)
{
    return 2.0f / (shininess + 2.0f);
}

/* v / |v| in float, for v of moderate length; 0 for 0. */
static inline rt_vec3 rt__unit(rt_vec3 v)
{
    const float dd = rt_dot(v, v);
    return rt_scale(v, dd > 1e-20f ? 1.0f / sqrtf(dd) : 0.0f);
}

/* G, the part of the facets that is seen at this cosine to the normal and not hidden by
 * others, is 2 cosine over this (B. Smith, 1967). */
static inline float rt__hidden(float cosine, float a2)
{
    return cosine + sqrtf(a2 + (1.0f - a2) * cosine * cosine);
}

/* A direction from which the gloss sends light to the eye, for the path to go on in: the
 * eye's ray, reflected by one of the facets that it sees, each as likely as its share of
 * the view. r1, r2 are uniform in (0, 1). It may point below the surface; then no light
 * comes.
 *
 * The surface is stretched by 1/a (see above) along N, so that the facets become a
 * hemisphere; there the wanted normal is halfway between the eye and a uniform direction
 * of a cap. J. Dupuy, A. Benyoub, "Sampling visible GGX normals with spherical caps", HPG
 * 2023, after E. Heitz, "Sampling the GGX distribution of visible normals", JCGT 7(4),
 * 2018. */
#ifndef rt_sample_gloss
static inline rt_vec3 rt_sample_gloss(rt_vec3 normal, rt_vec3 to_eye, float shininess,
                                      float r1, float r2)
{
    const float a = sqrtf(rt__roughness2(shininess));
    rt_vec3 x, y;
    rt_basis(normal, &x, &y);
    const rt_vec3 eye = rt__unit(
        rt_vec(a * rt_dot(x, to_eye), a * rt_dot(y, to_eye), rt_dot(normal, to_eye)));
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const float z = (1.0f - r2) * (1.0f + eye.z) - eye.z, zz = 1.0f - z * z;
    const float r = sqrtf(zz > 0.0f ? zz : 0.0f);
    const rt_vec3 half =
        rt_vec(a * (r * cosine + eye.x), a * (r * sine + eye.y), z + eye.z);
    const rt_vec3 facet = rt__unit(rt_add(
        rt_add(rt_scale(x, half.x), rt_scale(y, half.y)), rt_scale(normal, half.z)));
    return rt_sub(rt_scale(facet, 2.0f * rt_dot(to_eye, facet)), to_eye);
}
#endif

/* The part of the light from to_light that the gloss sends to the eye, times <N,to_light>
 * and per steradian, as if each facet reflected all of it. All directions have length 1:
 *
 *     D(h) G(eye) G(light) / (4 <N,eye>),         h halfway between the two,
 *     D(h) = a^2 / (pi (<N,h>^2 (a^2 - 1) + 1)^2),         a^2 = 2 / (shininess + 2),
 *     G(v) = 2 <N,v> / (<N,v> + sqrt(a^2 + (1 - a^2) <N,v>^2)),
 *
 * and in *density the density of rt_sample_gloss, which is the same without G(light).
 * Both are 0 if eye or light is below the surface. <N,h>^2 (a^2 - 1) + 1 is computed as
 * |N x h|^2 + a^2 <N,h>^2, which loses no digits when a is small. */
#ifndef rt_gloss
static inline float rt_gloss(rt_vec3 normal, rt_vec3 to_eye, rt_vec3 to_light,
                             float shininess, float *density)
{
    const float a2 = rt__roughness2(shininess);
    const float eye = rt_dot(normal, to_eye), light = rt_dot(normal, to_light);
    const rt_vec3 h = rt__unit(rt_add(to_eye, to_light)), across = rt_cross(normal, h);
    const float up = rt_dot(normal, h), k = rt_dot(across, across) + a2 * up * up;
    *density = 0.0f;
    if (!(eye > 0.0f && light > 0.0f && up > 0.0f))
        return 0.0f;
    *density = a2 / (3.14159265359f * k * k) / (2.0f * rt__hidden(eye, a2));
    return *density * (2.0f * light / rt__hidden(light, a2));
}
#endif

/* The BRDF (bidirectional reflectance distribution function) of a surface at one of its
 * points, if it is neither glass nor a perfect mirror. */
typedef struct rt_brdf {
    rt_vec3 albedo;
    float shininess; /* 0: matt */
    bool metal;      /* shininess above 0: all gloss, tinted by the albedo. If false: a
                        matt body under a coat of clear lacquer */
} rt_brdf;

/* What lacquer reflects of light straight from above, (1.5 - 1)^2 / (1.5 + 1)^2. For
 * flatter light: C. Schlick's approximation of Fresnel's F, 1994. */
#define RT__LACQUER 0.04f

static inline float rt__fifth_power(float v)
{
    return v * v * v * v * v;
}

static inline float rt__lacquer(float cosine)
{
    return RT__LACQUER + (1.0f - RT__LACQUER) * rt__fifth_power(1.0f - cosine);
}

/* The probability with which the way on is drawn from the gloss, not from the body. */
static inline float rt__gloss_chance(const rt_brdf *brdf, rt_vec3 normal, rt_vec3 to_eye)
{
    if (brdf->metal || !(brdf->shininess > 0.0f))
        return brdf->metal ? 1.0f : 0.0f;
    const float f = rt__lacquer(rt_dot(normal, to_eye));
    return f + 0.25f * (1.0f - f);
}

/* The part of the light from to_light that is sent to the eye, times <N,to_light>, per
 * steradian and channel; and in *density the density with which rt_sample_brdf chooses
 * to_light.
 *
 * For metal it is albedo . gloss. For lacquer it is F . gloss, with F of the facets, plus
 * the body, whose light gets through the lacquer twice:
 *
 *     albedo / pi . 1.05 (1 - 0.04) (1 - (1 - <N,eye>)^5) (1 - (1 - <N,light>)^5)
 *
 * (M. Ashikhmin, P. Shirley, "An anisotropic Phong BRDF model", 2000, with 1.05 = 1 / (1
 * - 1/21), so that a white body without the coat's reflections would lose nothing.) */
static inline rt_vec3 rt_scatter(const rt_brdf *brdf, rt_vec3 normal, rt_vec3 to_eye,
                                 rt_vec3 to_light, float *density)
{
    const float eye = rt_dot(normal, to_eye), light = rt_dot(normal, to_light);
    const float matt = light * 0.318309886184f;
    *density = 0.0f;
    if (!(eye > 0.0f && light > 0.0f))
        return rt_vec(0.0f, 0.0f, 0.0f);
    if (!(brdf->shininess > 0.0f)) {
        *density = matt;
        return rt_scale(brdf->albedo, matt);
    }
    float of_gloss;
    const float lobe = rt_gloss(normal, to_eye, to_light, brdf->shininess, &of_gloss);
    const float chance = rt__gloss_chance(brdf, normal, to_eye);
    *density = chance * of_gloss + (1.0f - chance) * matt;
    if (brdf->metal)
        return rt_scale(brdf->albedo, lobe);
    const rt_vec3 h = rt__unit(rt_add(to_eye, to_light));
    const float coat = lobe * rt__lacquer(rt_dot(h, to_light));
    const float body = 1.05f * (1.0f - RT__LACQUER) * matt *
                       (1.0f - rt__fifth_power(1.0f - light)) *
                       (1.0f - rt__fifth_power(1.0f - eye));
    return rt_add(rt_scale(brdf->albedo, body), rt_vec(coat, coat, coat));
}

/* A direction to go on in, drawn with the density above from r1, r2 in (0, 1). r1 decides
 * between gloss and body, and what is left of it is used again. */
static inline rt_vec3 rt_sample_brdf(const rt_brdf *brdf, rt_vec3 normal, rt_vec3 to_eye,
                                     float r1, float r2)
{
    const float chance = rt__gloss_chance(brdf, normal, to_eye);
    if (r1 < chance)
        return rt_sample_gloss(normal, to_eye, brdf->shininess, r1 / chance, r2);
    return rt_sample_cosine(normal, (r1 - chance) / (1.0f - chance), r2);
}

/* ====================================================================================
 * Chapter 14. A lens and a sky
 * ==================================================================================== */

/* A lens in the place of the pinhole. */
typedef struct rt_lens {
    float radius; /* of its opening; 0: a pinhole */
    float focus;  /* above 0: how far away, along the axis, the sharp plane is */
} rt_lens;

/* rt_lens_ray, see below, of a camera with this film. */
static inline rt_ray rt__film_lens_ray(const rt__film *film, const rt_lens *lens,
                                       const rt_ray *ray, float r1, float r2)
{
    const rt_vec3 right = rt_to_float(film->right), top = rt_to_float(film->top);
    const float along = rt_dot(ray->direction, rt_to_float(film->forward));
    if (!(along > 0.0f)) /* no camera: see rt_camera_ray */
        return *ray;
    const float radius = lens->radius * sqrtf(r2);
    float sine, cosine;
    rt_sincos(r1, &sine, &cosine);
    const rt_vec3 aside =
        rt_add(rt_scale(right, radius * cosine), rt_scale(top, radius * sine));
    const rt_vec3 sharp = rt_scale(ray->direction, lens->focus / along);
    rt_ray result;
    result.origin = rt_add(ray->origin, aside);
    result.direction = rt_normalize(rt_sub(sharp, aside));
    return result;
}

/* The ray of a camera with a lens; *pinhole is that of its pinhole, rt_camera_ray, and
 * r1, r2 are uniform in (0, 1).
 *
 * A thin lens sends all rays from one point of the sharp plane to one point of the film,
 * wherever they go through the lens; and the ray through its middle goes straight on. So
 * the pinhole's ray tells which point that is, and the ray from any other point of the
 * lens goes there, too. Points of the lens are uniform on a disc: its radius times
 * sqrt(r2), in the direction r1. Each of them sees what is off the plane in another
 * place. */
#ifndef rt_lens_ray
static inline rt_ray rt_lens_ray(const rt_camera *camera, const rt_lens *lens,
                                 const rt_ray *pinhole, float r1, float r2)
{
    const rt__film film = rt__film_of(camera, 1, 1);
    return rt__film_lens_ray(&film, lens, pinhole, r1, r2);
}
#endif

/* v, at least 0 and at most this; 0 for NaN. */
static inline float rt__at_most(float v, float most)
{
    return v > 0.0f ? v < most ? v : most : 0.0f;
}

/* The light where nothing is hit: the background, or in its place the sky in that
 * direction. scene->sky may be any function of a unit vector. It returns radiance in
 * linear RGB; negative values and NaN count as 0, values above 1e15 as 1e15. It is called
 * on many threads at once. Make what is small and bright, like the sun, an rt_lamp far
 * away, at which rays can aim. */
static inline rt_vec3 rt_sky(const rt_scene *scene, rt_vec3 direction)
{
    if (!scene->sky)
        return scene->background;
    const rt_vec3 light = scene->sky(scene->sky_data, rt_normalize(direction));
    return rt_vec(rt__at_most(light.x, 1e15f), rt__at_most(light.y, 1e15f),
                  rt__at_most(light.z, 1e15f));
}

/* ====================================================================================
 * Chapter 15. Patterns
 *
 * A pattern is an albedo that depends on the place: a function of the point. That is the
 * whole chapter. The function is called on many threads at once. Negative values and NaN
 * count as 0, values above 1 as 1: a surface sends back no light that it did not get.
 * ==================================================================================== */

static inline rt_vec3 rt_albedo(const rt_surface *surface, const rt_hit *hit)
{
    if (!surface->pattern)
        return hit->material->albedo;
    const rt_vec3 rho = surface->pattern(surface->pattern_data, hit->point, hit->normal);
    return rt_vec(rt__at_most(rho.x, 1.0f), rt__at_most(rho.y, 1.0f),
                  rt__at_most(rho.z, 1.0f));
}

/* ====================================================================================
 * Chapter 16. Triangles
 * ==================================================================================== */

/* A mesh of triangles: what a model from a file consists of. The arrays are yours. A
 * triangle names its corners A, B, C by number, so neighbours share positions, and a
 * corner that moves takes all of its triangles along. A model of several materials is
 * several meshes. */
typedef struct rt_mesh {
    const rt_vec3 *positions;
    const int *indices; /* three for each triangle, into positions: A, B, C,
                           counterclockwise as seen from outside (only glass asks for the
                           side) */
    int position_count, triangle_count;
    rt_material material;
} rt_mesh;

/* Corner k of a triangle: 0 is A, 1 is B, 2 is C. */
static inline rt_vec3 rt_corner(const rt_mesh *mesh, int triangle, int k)
{
    return mesh->positions[mesh->indices[3 * (size_t)triangle + (size_t)k]];
}

typedef struct rt__corners {
    rt_vec3 a, b, c;
} rt__corners;

static inline rt__corners rt__corners_of(const rt_mesh *mesh, int triangle)
{
    rt__corners corners;
    corners.a = rt_corner(mesh, triangle, 0);
    corners.b = rt_corner(mesh, triangle, 1);
    corners.c = rt_corner(mesh, triangle, 2);
    return corners;
}

/* (B - A) x (C - A): perpendicular to the triangle, outward, twice its area long. */
static inline rt_dvec3 rt__across(const rt__corners *corners)
{
    const rt_dvec3 a = rt_to_double(corners->a);
    return rt_dcross(rt_dsub(rt_to_double(corners->b), a),
                     rt_dsub(rt_to_double(corners->c), a));
}

/* The mean of the corners with these weights, whose sum must be 1. */
static inline rt_vec3 rt__blend(const rt__corners *corners, rt_dvec3 weights)
{
    const rt_dvec3 a = rt_dscale(rt_to_double(corners->a), weights.x);
    const rt_dvec3 ab = rt_dmad(a, weights.y, rt_to_double(corners->b));
    return rt_to_float(rt_dmad(ab, weights.z, rt_to_double(corners->c)));
}

#ifndef rt_hit_triangle
/* The world as the ray sees it: its start is the origin, and the ray is the z axis. The
 * axis along which u is longest becomes z; then a shear, which moves every point sideways
 * in proportion to its z, straightens the ray:
 *
 *     x = p_x - (u_x / u_z) p_z,     y = p_y - (u_y / u_z) p_z
 *
 * where p is the way to the point from the start of the ray. Now the ray meets what is at
 * x = y = 0. */
typedef struct rt__shear {
    rt_vec3 origin;
    int axis;       /* the one that becomes z: 0, 1, 2 stand for x, y, z */
    double x, y, z; /* u_x / u_z, u_y / u_z, 1 / u_z; z 0: no direction */
} rt__shear;

/* v with its coordinates rotated so that the axis comes last. */
static inline rt_dvec3 rt__turned(rt_vec3 v, int axis)
{
    const rt_dvec3 d = rt_to_double(v);
    return axis == 0 ? rt_dvec(d.y, d.z, d.x) : axis == 1 ? rt_dvec(d.z, d.x, d.y) : d;
}

static inline rt__shear rt__shear_of(const rt_ray *ray)
{
    const float x = fabsf(ray->direction.x), y = fabsf(ray->direction.y);
    const float z = fabsf(ray->direction.z);
    rt__shear shear;
    shear.origin = ray->origin;
    shear.axis = x >= y && x >= z ? 0 : y >= z ? 1 : 2;
    const rt_dvec3 u = rt__turned(ray->direction, shear.axis);
    shear.z = u.z != 0.0 ? 1.0 / u.z : 0.0;
    shear.x = u.x * shear.z;
    shear.y = u.y * shear.z;
    return shear;
}

static inline rt_dvec3 rt__sheared(const rt__shear *shear, rt_vec3 corner)
{
    const rt_dvec3 p =
        rt_dsub(rt__turned(corner, shear->axis), rt__turned(shear->origin, shear->axis));
    return rt_dvec(p.x - shear->x * p.z, p.y - shear->y * p.z, p.z);
}

/* Are all three above 0, or all below? */
static inline bool rt__beside(double a, double b, double c)
{
    return (a > 0.0 && b > 0.0 && c > 0.0) || (a < 0.0 && b < 0.0 && c < 0.0);
}

/* The t at which the ray meets the triangle A, B, C, or 0; and in *weights how much of
 * each corner is in P, up to a common factor.
 *
 * Seen along the ray, the triangle is flat, and the ray is the point (0,0). On which side
 * of the edge from A to B does it lie? The answer is the sign of
 *
 *     w_C = B_x A_y - B_y A_x,
 *
 * twice the area of (0,0), A, B. If all three edges have it on the same side, it is in
 * the triangle, and w_A : w_B : w_C are its barycentric coordinates. With them
 *
 *     z = (w_A A_z + w_B B_z + w_C C_z) / (w_A + w_B + w_C),     t = z / u_z.
 *
 * Nothing gets through between two triangles, not even where a ray meets their common
 * edge or corner. For each corner is sheared once, to the same numbers in every triangle
 * that it belongs to. For the common edge both triangles compute the same two products,
 * so one has w where the other has -w. Rounded products are in the order of the exact
 * ones or equal, so w has the right sign or is 0. And 0 counts as inside. (A compiler
 * that contracts a*b-c*d rounds only one of the products: one more reason for
 * -ffp-contract=off.) Float would prevent holes just as well, but a ray next to an edge
 * would often get the wrong neighbour; hence double.
 *
 * Seen almost edge-on, a triangle is almost a line, and far out on that line rounding can
 * also make w 0. So where a w is 0, (0,0) must also be between the corners in x and in y.
 * That opens no hole, since all points in the triangle are.
 *
 * Method: S. Woop, C. Benthin, I. Wald, "Watertight ray/triangle intersection", JCGT
 * 2(1), 2013. */
static inline double rt__meet_corners(const rt__shear *shear, const rt__corners *corners,
                                      float t_max, rt_dvec3 *weights)
{
    const rt_dvec3 a = rt__sheared(shear, corners->a);
    const rt_dvec3 b = rt__sheared(shear, corners->b);
    const rt_dvec3 c = rt__sheared(shear, corners->c);
    const double w_a = c.x * b.y - c.y * b.x;
    const double w_b = a.x * c.y - a.y * c.x;
    const double w_c = b.x * a.y - b.y * a.x;
    if ((w_a < 0.0 || w_b < 0.0 || w_c < 0.0) && (w_a > 0.0 || w_b > 0.0 || w_c > 0.0))
        return 0.0;
    const double sum = w_a + w_b + w_c;
    if (!(sum != 0.0)) /* seen edge-on, or no area */
        return 0.0;
    if ((w_a == 0.0 || w_b == 0.0 || w_c == 0.0) &&
        (rt__beside(a.x, b.x, c.x) || rt__beside(a.y, b.y, c.y)))
        return 0.0;
    const double t = (w_a * a.z + w_b * b.z + w_c * c.z) * shear->z / sum;
    if (!(t >= (double)FLT_MIN && t <= (double)FLT_MAX && (float)t < t_max))
        return 0.0;
    *weights = rt_dvec(w_a, w_b, w_c);
    const rt_dvec3 n = rt__across(corners);
    return rt_ddot(n, n) > 0.0 ? t : 0.0; /* rounding may give a line an area */
}

/* The hit at t, with these weights. P is the mean of the corners, in double and rounded
 * once, so it is as good from afar as from near. The normal is that of the flat
 * triangle. */
static inline void rt__hit_corners(const rt__corners *corners, const rt_ray *ray,
                                   double t, rt_dvec3 weights, rt_hit *hit)
{
    const rt_dvec3 w = rt_dscale(weights, 1.0 / (weights.x + weights.y + weights.z));
    const rt_dvec3 n = rt_dnormalize(rt__across(corners));
    hit->t = (float)t;
    hit->point = rt__blend(corners, w);
    hit->inside = rt_ddot(n, rt_to_double(ray->direction)) > 0.0;
    hit->normal = rt_to_float(rt_dscale(n, hit->inside ? -1.0 : 1.0));
    hit->shape = 0;
    hit->u = (float)w.y;
    hit->v = (float)w.z;
}

/* The point of the triangle on the ray, if 0 < t < t_max: see above. hit->part is the
 * triangle's number, and P = (1 - u - v) A + u B + v C.
 *
 * Returns false, and leaves *hit alone, on a miss. A triangle without area, one that is
 * seen exactly edge-on, NaN and infinity are misses. */
static inline bool rt_hit_triangle(const rt_mesh *mesh, int triangle, const rt_ray *ray,
                                   float t_max, rt_hit *hit)
{
    const rt__shear shear = rt__shear_of(ray);
    const rt__corners corners = rt__corners_of(mesh, triangle);
    rt_dvec3 weights;
    const double t = rt__meet_corners(&shear, &corners, t_max, &weights);
    if (!(t > 0.0))
        return false;
    rt__hit_corners(&corners, ray, t, weights, hit);
    hit->material = &mesh->material;
    hit->part = triangle;
    return true;
}
#endif

/* ====================================================================================
 * Chapter 17. Your own shape
 *
 * All that the rest asks of a shape is the question of chapter 1: where does this ray
 * meet it first? Whatever answers that is a new shape: a function, and a box around it
 * for the tree.
 * ==================================================================================== */

/* The first point of your shape on the ray with 0 < t < t_max, as rt_hit_sphere finds it
 * for a sphere. On a hit it sets t, point and normal, and returns true; the normal must
 * point outward, and may have any length. It may set part, u and v to what it likes. data
 * is the shape's. The ray's direction may have any length. It is called on many threads
 * at once. */
typedef bool rt_hit_function(const void *data, const rt_ray *ray, float t_max,
                             rt_hit *hit);

typedef struct rt_custom_shape {
    rt_vec3 min, max; /* opposite corners of a box around it, min <= max */
    rt_material material;
    rt_hit_function *hit;
    const void *data; /* handed to it */
} rt_custom_shape;

/* The box, larger by a thousandth of its longest side, so that tight boxes do no harm. */
static inline void rt__loosen(const rt_custom_shape *shape, rt_vec3 *low, rt_vec3 *high)
{
    const rt_vec3 size = rt_sub(shape->max, shape->min);
    float longest = size.x > size.y ? size.x : size.y;
    longest = longest > size.z ? longest : size.z;
    const rt_vec3 more = rt_scale(rt_vec(1.0f, 1.0f, 1.0f), 1e-3f * longest);
    *low = rt_sub(shape->min, more);
    *high = rt_add(shape->max, more);
}

/* Ask the shape's function, and complete its answer: the normal becomes a unit vector on
 * the side that the ray comes from, and hit->inside tells whether that is the inside.
 *
 * Returns false, and leaves *hit alone, on a miss. An answer that makes no sense is a
 * miss: t not between 0 and t_max, no normal, or a point outside the box by more than a
 * thousandth of its longest side, where the tree would not find it. */
static inline bool rt_hit_custom_shape(const rt_custom_shape *shape, const rt_ray *ray,
                                       float t_max, rt_hit *hit)
{
    rt_hit answer;
    memset(&answer, 0, sizeof answer);
    if (!shape->hit(shape->data, ray, t_max, &answer) ||
        !(answer.t >= FLT_MIN && answer.t < t_max))
        return false;
    rt_vec3 low, high;
    const rt_vec3 p = answer.point, n = rt_normalize(answer.normal);
    rt__loosen(shape, &low, &high);
    if (!(p.x >= low.x && p.y >= low.y && p.z >= low.z && p.x <= high.x &&
          p.y <= high.y && p.z <= high.z) ||
        rt_is_zero(n))
        return false;
    answer.inside = rt_dot(n, ray->direction) > 0.0f;
    answer.normal = answer.inside ? rt_scale(n, -1.0f) : n;
    answer.material = &shape->material;
    answer.shape = 0;
    *hit = answer;
    return true;
}

/* ---- both of them in a scene -----------------------------------------------------
 *
 * rt_hit.shape counts spheres, boxes, meshes, custom shapes. The tree, and the loop of
 * rt_intersect, ask every triangle; they count spheres, boxes, the triangles of the first
 * mesh, of the second, ..., custom shapes. */

/* How many triangles all meshes have, and how many of those numbers there are. More than
 * fits an int counts as INT_MAX. */
static inline int rt__triangle_count(const rt_scene *scene)
{
    int64_t count = 0;
    for (int i = 0; scene->meshes && i < scene->mesh_count && count < INT_MAX; i++)
        count += scene->meshes[i].triangle_count;
    return count < INT_MAX ? (int)count : INT_MAX;
}

static inline int rt__primitive_count(const rt_scene *scene)
{
    const int64_t count = (int64_t)scene->sphere_count + scene->box_count +
                          rt__triangle_count(scene) + scene->custom_shape_count;
    return count < INT_MAX ? (int)count : INT_MAX;
}

/* What such a number stands for: mesh and triangle, or mesh == scene->mesh_count and
 * custom shape.
 */
typedef struct rt__other {
    int mesh, part;
} rt__other;

static inline rt__other rt__other_of(const rt_scene *scene, int number)
{
    rt__other p;
    p.part = number - scene->sphere_count - scene->box_count;
    if (scene->bvh && scene->bvh->triangles_before) { /* the last with <= part */
        const int *before = scene->bvh->triangles_before;
        int end = scene->bvh->mesh_count + 1;
        for (p.mesh = 0; p.mesh + 1 < end;) {
            const int half = p.mesh + (end - p.mesh) / 2;
            p.mesh = before[half] <= p.part ? half : p.mesh;
            end = before[half] <= p.part ? end : half;
        }
        p.part -= before[p.mesh];
        return p;
    }
    for (p.mesh = 0; p.mesh < scene->mesh_count; p.mesh++) {
        if (p.part < scene->meshes[p.mesh].triangle_count)
            break;
        p.part -= scene->meshes[p.mesh].triangle_count;
    }
    return p;
}

static inline int rt__shape_count(const rt_scene *scene)
{
    return scene->sphere_count + scene->box_count + scene->mesh_count +
           scene->custom_shape_count;
}

static inline float rt__meet_one(const rt_scene *scene, rt__other p, const rt_ray *ray,
                                 float t_max)
{
    rt_hit hit;
    if (p.mesh == scene->mesh_count)
        return rt_hit_custom_shape(&scene->custom_shapes[p.part], ray, t_max, &hit)
                   ? hit.t
                   : 0.0f;
#ifdef rt_hit_triangle /* by yours */
    return rt_hit_triangle(&scene->meshes[p.mesh], p.part, ray, t_max, &hit) ? hit.t
                                                                             : 0.0f;
#else
    const rt__shear shear = rt__shear_of(ray);
    const rt__corners corners = rt__corners_of(&scene->meshes[p.mesh], p.part);
    rt_dvec3 weights;
    return (float)rt__meet_corners(&shear, &corners, t_max, &weights);
#endif
}

static inline float rt__meet_other(const rt_scene *scene, int number, const rt_ray *ray,
                                   float t_max)
{
    return rt__meet_one(scene, rt__other_of(scene, number), ray, t_max);
}

/* P, moved in from the edges of its triangle by 4 steps of rt_leave, or less in a tiny
 * triangle. In a corner between two walls rt_leave steps along the normal of one of them.
 * If they meet at less than a right angle, the step leads towards the other wall and,
 * close to the edge, through it: the path would be outside a closed mesh. From 4 steps
 * away that cannot happen down to 14 degrees, whose cotangent is 4. */
static inline void rt__draw_in(const rt__corners *corners, rt_hit *hit)
{
    const rt_dvec3 a = rt_to_double(corners->a);
    const rt_dvec3 ab = rt_dsub(rt_to_double(corners->b), a);
    const rt_dvec3 ac = rt_dsub(rt_to_double(corners->c), a);
    const rt_dvec3 bc = rt_dsub(ac, ab), n = rt_dcross(ab, ac);
    double longest = rt_ddot(ab, ab);
    longest = rt_ddot(ac, ac) > longest ? rt_ddot(ac, ac) : longest;
    longest = rt_ddot(bc, bc) > longest ? rt_ddot(bc, bc) : longest;
    rt_dvec3 w =
        rt_dvec(1.0 - (double)hit->u - (double)hit->v, (double)hit->u, (double)hit->v);
    const rt_vec3 step =
        rt_sub(rt_leave(hit->point, hit->normal, hit->normal), hit->point);
    const double steps = 16.0 * (double)rt_dot(step, step), nn = rt_ddot(n, n);
    double smallest = w.x < w.y ? w.x : w.y;
    smallest = smallest < w.z ? smallest : w.z;
    if (smallest * smallest * nn >= steps * longest)
        return;
    /* the least of the three heights is |n| / the longest edge */
    double least = sqrt(steps * longest / nn);
    least = least < 0.1 ? least : 0.1;
    if (smallest >= least)
        return;
    w = rt_dvec(w.x > least ? w.x : least, w.y > least ? w.y : least,
                w.z > least ? w.z : least);
    hit->point = rt__blend(corners, rt_dscale(w, 1.0 / (w.x + w.y + w.z)));
}

/* The number of the nearest of them (of several at the same t, the first), or of any if
 * any will do; or -1. */
static inline int rt__nearest_other(const rt_scene *scene, const rt_ray *ray, float t_max,
                                    bool any)
{
    int best = -1, number = scene->sphere_count + scene->box_count;
    rt__other p;
    for (p.mesh = 0; p.mesh <= scene->mesh_count; p.mesh++) {
        const int count = p.mesh < scene->mesh_count
                              ? scene->meshes[p.mesh].triangle_count
                              : scene->custom_shape_count;
        for (p.part = 0; p.part < count; p.part++, number++) {
            const float t = rt__meet_one(scene, p, ray, t_max);
            if (t > 0.0f) {
                t_max = t;
                best = number;
                if (any)
                    return best;
            }
        }
    }
    return best;
}

static inline bool rt__hit_other(const rt_scene *scene, int number, const rt_ray *ray,
                                 rt_hit *hit)
{
    const rt__other p = rt__other_of(scene, number);
    const int before = scene->sphere_count + scene->box_count;
    if (p.mesh == scene->mesh_count) {
        if (!rt_hit_custom_shape(&scene->custom_shapes[p.part], ray, FLT_MAX, hit))
            return false;
        hit->shape = before + scene->mesh_count + p.part;
        return true;
    }
    const rt_mesh *mesh = &scene->meshes[p.mesh];
    const rt__corners corners = rt__corners_of(mesh, p.part);
#ifdef rt_hit_triangle /* yours need not set all */
    hit->u = hit->v = -1.0f;
    hit->inside = rt_ddot(rt__across(&corners), rt_to_double(ray->direction)) > 0.0;
#endif
    if (!rt_hit_triangle(mesh, p.part, ray, FLT_MAX, hit))
        return false;
    hit->shape = before + p.mesh;
    hit->part = p.part;
    if (hit->u >= 0.0f && hit->v >= 0.0f)
        rt__draw_in(&corners, hit);
    return true;
}

/* The material of the shape with this rt_hit.shape. */
static inline const rt_material *rt__material_of(const rt_scene *scene, int shape)
{
    const int box = shape - scene->sphere_count, mesh = box - scene->box_count;
    const int custom = mesh - scene->mesh_count;
    return box < 0      ? &scene->spheres[shape].material
           : mesh < 0   ? &scene->boxes[box].material
           : custom < 0 ? &scene->meshes[mesh].material
                        : &scene->custom_shapes[custom].material;
}

static inline int rt__other_number(const rt_scene *scene, const rt_material *material)
{
    const int before = scene->sphere_count + scene->box_count;
    for (int i = 0; i < scene->mesh_count; i++)
        if (&scene->meshes[i].material == material)
            return before + i;
    for (int i = 0; i < scene->custom_shape_count; i++)
        if (&scene->custom_shapes[i].material == material)
            return before + scene->mesh_count + i;
    return -1;
}

/* ====================================================================================
 * Part two, all of it together
 * ==================================================================================== */

/* What a path does at one of its points: for rt_trace_pixel. */
typedef enum rt_event {
    RT_EVENT_GONE,      /* it leaves the scene, for the background or the sky */
    RT_EVENT_MATT,      /* goes on by chance, as from a matt surface */
    RT_EVENT_GLOSS,     /* by chance, by way of the gloss */
    RT_EVENT_MIRROR,    /* is reflected by a perfect mirror */
    RT_EVENT_REFLECTED, /* is reflected by glass */
    RT_EVENT_REFRACTED, /* goes through the surface of glass */
    RT_EVENT_LAMP       /* ends at a lamp with a size */
} rt_event;

static inline rt_brdf rt__brdf_of(const rt_surface *surface, const rt_hit *hit)
{
    rt_brdf brdf;
    brdf.albedo = rt_albedo(surface, hit);
    brdf.shininess = surface->shininess;
    brdf.metal = hit->material->mirror;
    if (brdf.metal && !surface->pattern && rt_is_zero(brdf.albedo)) /* chapter 6 */
        brdf.albedo = rt_vec(1.0f, 1.0f, 1.0f);
    return brdf;
}

/* A ray meets glass: the refractive index behind the surface over the index before it. If
 * the ray comes from inside, *throughput loses what the glass has absorbed. */
static inline float rt__meet_glass(const rt_scene *scene, const rt_surface *surface,
                                   const rt_hit *hit, rt_vec3 *throughput, bool *inside)
{
    *inside = rt_is_inside(scene, hit);
    if (!*inside)
        return surface->eta;
    *throughput = rt_mul(*throughput, rt_transmittance(surface->absorption, hit->t));
    return 1.0f / surface->eta;
}

/* rt_lambert for a surface with gloss. */
static inline rt_vec3 rt__glossy_point(const rt_brdf *brdf, rt_vec3 normal,
                                       rt_vec3 to_eye, rt_vec3 to_light,
                                       rt_vec3 intensity)
{
    const float dd = rt_dot(to_light, to_light);
    if (!(dd > 1e-20f && dd <= FLT_MAX))
        return rt_vec(0.0f, 0.0f, 0.0f);
    float density;
    const rt_vec3 f =
        rt_scatter(brdf, normal, to_eye, rt_scale(to_light, 1.0f / sqrtf(dd)), &density);
    return rt_scale(rt_mul(f, intensity), 1.0f / dd);
}

/* These tell rt_trace_pixel, if it listens, what the ray has met and what light that
 * gives; the answer to the last question for a light or, if light is -1, for a lamp; and
 * how the path goes on. They are defined at the end. */
static inline void rt__note_vertex(const rt_scene *scene, rt_vec3 throughput, int lamp,
                                   rt_vec3 light, float weight);
static inline void rt__note_light(const rt_scene *scene, int light, int lamp, rt_vec3 end,
                                  rt_vec3 sent, float weight);
static inline void rt__note_event(const rt_scene *scene, rt_event event, bool inside,
                                  float density);

static inline bool rt__is_watched(const rt_scene *scene)
{
    return scene->bvh && scene->bvh->path;
}

/* rt_direct on any surface but glass and perfect mirrors: the lights that are points. */
static inline rt_vec3 rt__direct_points(const rt_scene *scene, const rt_hit *hit,
                                        const rt_brdf *brdf, rt_vec3 to_eye, rt_rng *rng)
{
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < scene->light_count; i++) {
        const rt_light *light = &scene->lights[i];
        const rt_vec3 to_light = rt_sub(light->position, hit->point);
        if (!(rt_dot(hit->normal, to_light) > 0.0f))
            continue;
        rng->rays++;
        rt_ray way; /* no lamp may stand in it, either */
        way.origin = hit->point;
        way.direction = to_light;
        rt_vec3 sent = rt_vec(0.0f, 0.0f, 0.0f);
        if (rt_visible(scene, hit->point, hit->normal, light->position) &&
            rt__nearest_lamp(scene, &way, 1.0f, -1) < 0)
            sent = brdf->shininess > 0.0f ? rt__glossy_point(brdf, hit->normal, to_eye,
                                                             to_light, light->intensity)
                                          : rt_lambert(brdf->albedo, hit->normal,
                                                       to_light, light->intensity);
        sum = rt_add(sum, sent);
        if (rt__is_watched(scene))
            rt__note_light(scene, i, -1, light->position, sent, 1.0f);
    }
    return sum;
}

/* The same for lamps with a size: one direction to each of them, weighted by rt_mis,
 * since rt_sample_brdf might have found it, too. */
static inline rt_vec3 rt__direct_lamps(const rt_scene *scene, const rt_hit *hit,
                                       const rt_brdf *brdf, rt_vec3 to_eye, rt_rng *rng)
{
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    for (int i = 0; i < scene->lamp_count; i++) {
        const rt_lamp *lamp = &scene->lamps[i];
        const float r1 = rt_random(rng);
        const float r2 = rt_random(rng);
        const rt_vec3 end = rt_sample_lamp(lamp, hit->point, r1, r2);
        rt_ray way; /* no other lamp may stand in it, either */
        way.origin = hit->point;
        way.direction = rt_sub(end, hit->point);
        const rt_vec3 toward = rt__unit(way.direction);
        const float aimed = rt_lamp_density(lamp, hit->point, toward);
        float density;
        const rt_vec3 f = rt_scatter(brdf, hit->normal, to_eye, toward, &density);
        if (!(aimed > 0.0f && density > 0.0f &&
              rt_dot(hit->normal, way.direction) > 0.0f))
            continue; /* from within the lamp, or behind the surface */
        rng->rays++;
        const bool seen = rt_visible(scene, hit->point, hit->normal, end) &&
                          rt__nearest_lamp(scene, &way, 1.0f, i) < 0;
        const float weight = rt_mis(aimed, density);
        rt_vec3 sent = rt_vec(0.0f, 0.0f, 0.0f);
        if (seen)
            sent = rt_scale(rt_mul(f, rt_lamp_radiance(lamp)), weight / aimed);
        sum = rt_add(sum, sent);
        if (rt__is_watched(scene))
            rt__note_light(scene, -1, i, end, sent, weight);
    }
    return sum;
}

/* rt_radiance, with all of part two: the light that comes back along the ray, estimated
 * from one path. The ray's direction must have length 1. Without surfaces, lamps and sky
 * the result has the bits of rt_radiance.
 *
 * Where a ray meets glass, the part F of the light comes from the reflection and 1 - F
 * from behind. The path follows one of the two: it tosses a coin that shows "reflected"
 * with probability F. So neither needs a factor.
 *
 * A lamp may be found in two ways: a surface aims at it, or a path meets it by chance.
 * Both are needed, and rt_mis says how much each counts. After the camera, a mirror or
 * glass there was no choice of direction, so nobody could have aimed: the lamp counts in
 * full. One more ray is sent after the last bounce, for lamps and emission only; so both
 * ways find light after the same number of bounces.
 *
 * bounces are as in rt_radiance; a surface of glass counts as one, so a ray needs two to
 * get through a ball. Each surface that aims draws a pair of random numbers for each
 * lamp, then one for the way on. Shadow rays do not go through glass: the light behind
 * it, a caustic, is found only by chance, and that of an rt_light never.
 *
 * Radiance within glass is eta^2 of what it is outside. That factor is left out, since it
 * cancels when the path leaves the glass; to a camera inside everything is too dark by
 * it. Shapes of glass must not overlap or touch: a ray inside one knows of no other.
 * Other shapes inside the glass are seen without the absorption of the glass before them.
 * A flat box of glass has no inside: it bends a ray, and nothing bends it back. */
static inline rt_vec3 rt_radiance_mis(const rt_scene *scene, const rt_ray *camera_ray,
                                      int bounces, rt_rng *rng)
{
    const int last = bounces > 0 ? bounces : 0;
    const bool one_more = scene->lamp_count > 0 || scene->surfaces;
    const bool watched = rt__is_watched(scene);
    rt_ray ray = *camera_ray;
    rt_vec3 sum = rt_vec(0.0f, 0.0f, 0.0f);
    rt_vec3 throughput = rt_vec(1.0f, 1.0f, 1.0f);
    rt_vec3 from = ray.origin; /* the point that the ray has left */
    float density = 0.0f;      /* of its direction; 0: there was no choice */
    for (int bounce = 0;; bounce++) {
        rt_hit hit;
        rng->rays++;
        rt__tick(rng->watch);
        const bool found = rt_intersect(scene, &ray, &hit);
        const int lamp = rt__nearest_lamp(scene, &ray, found ? hit.t : FLT_MAX, -1);
        if (lamp >= 0) {
            const rt_lamp *met = &scene->lamps[lamp];
            const float weight =
                density > 0.0f
                    ? rt_mis(density, rt_lamp_density(met, from, ray.direction))
                    : 1.0f;
            const rt_vec3 light = rt_scale(rt_lamp_radiance(met), weight);
            if (watched)
                rt__note_vertex(scene, throughput, lamp, light, weight);
            return rt_add(sum, rt_mul(throughput, light));
        }
        rt_vec3 light = rt_vec(0.0f, 0.0f, 0.0f);
        const rt_surface *surface = NULL;
        if (found) {
            surface = rt_surface_of(scene, &hit);
            light = surface->emission;
        } else if (bounce <= last) {
            light = rt_sky(scene, ray.direction);
        }
        if (watched)
            rt__note_vertex(scene, throughput, -1, light, 1.0f);
        sum = rt_add(sum, rt_mul(throughput, light));
        if (!found || bounce > last)
            return sum;

        const rt_vec3 n = hit.normal, to_eye = rt_scale(ray.direction, -1.0f);
        const rt_brdf brdf = rt__brdf_of(surface, &hit);
        const bool shiny = brdf.shininess > 0.0f;
        rt_vec3 direction;
        rt_event event;
        bool inside = false;
        if (surface->eta > 0.0f) {
            const float eta = rt__meet_glass(scene, surface, &hit, &throughput, &inside);
            const float coin = rt_random(rng);
            rt_random(rng); /* not used: numbers come in pairs, see chapter 9 */
            event = RT_EVENT_REFRACTED;
            if (coin < rt_fresnel(rt_dot(n, to_eye), eta) ||
                !rt_refract(ray.direction, n, eta, &direction)) {
                direction = rt_reflect(ray.direction, n);
                event = RT_EVENT_REFLECTED;
            }
            density = 0.0f;
        } else if (brdf.metal && !shiny) {
            direction = rt_reflect(ray.direction, n);
            throughput = rt_mul(throughput, brdf.albedo);
            event = RT_EVENT_MIRROR;
            density = 0.0f;
        } else {
            const rt_vec3 direct =
                rt_add(rt__direct_points(scene, &hit, &brdf, to_eye, rng),
                       rt__direct_lamps(scene, &hit, &brdf, to_eye, rng));
            sum = rt_add(sum, rt_mul(throughput, direct));
            if (bounce >= last && !one_more)
                return sum;
            const float r1 = rt_random(rng);
            const float r2 = rt_random(rng);
            event =
                r1 < rt__gloss_chance(&brdf, n, to_eye) ? RT_EVENT_GLOSS : RT_EVENT_MATT;
            direction = rt_sample_brdf(&brdf, n, to_eye, r1, r2);
            const rt_vec3 f = rt_scatter(&brdf, n, to_eye, direction, &density);
            if (!(density > 0.0f))
                return sum; /* below the surface */
            throughput = rt_mul(throughput, shiny ? rt_scale(f, 1.0f / density)
                                                  : brdf.albedo); /* the same */
        }
        if (watched)
            rt__note_event(scene, event, inside, density);
        if ((bounce >= last && !one_more) || rt__is_spent(throughput))
            return sum;
        if (bounces == RT_ALL_BOUNCES && bounce >= RT__ROULETTE) {
            const float chance = rt__chance(throughput), r = rt_random(rng);
            rt_random(rng);
            if (r >= chance)
                return sum;
            throughput = rt_scale(throughput, 1.0f / chance);
        }
        from = hit.point;
        ray.origin = rt_leave(hit.point, n, direction);
        ray.direction = direction;
    }
}

/* rt_first_look, with all of part two: the first surface that is no mirror and no glass.
 * Through glass it looks straight on or, where that is impossible, along the reflection.
 * direct is what has little noise: lights that are points, and what shines by itself. */
static inline rt_guide rt__first_look_mis(const rt_scene *scene, const rt_ray *camera_ray,
                                          int bounces, rt_rng *rng)
{
    rt_ray ray = *camera_ray;
    rt_vec3 throughput = rt_vec(1.0f, 1.0f, 1.0f);
    rt_guide guide;
    memset(&guide, 0, sizeof guide);
    for (int bounce = 0;; bounce++) {
        rt_hit hit;
        const bool found = rt_intersect(scene, &ray, &hit);
        const int lamp = rt__nearest_lamp(scene, &ray, found ? hit.t : FLT_MAX, -1);
        if (!found || lamp >= 0) {
            guide.direct =
                rt_mul(throughput, lamp >= 0 ? rt_lamp_radiance(&scene->lamps[lamp])
                                             : rt_sky(scene, ray.direction));
            return guide;
        }
        const rt_surface *surface = rt_surface_of(scene, &hit);
        const rt_brdf brdf = rt__brdf_of(surface, &hit);
        const bool glass = surface->eta > 0.0f;
        const bool mirror = brdf.metal && !(brdf.shininess > 0.0f) && !glass;
        const rt_vec3 to_eye = rt_scale(ray.direction, -1.0f);
        rt_vec3 direction = rt_reflect(ray.direction, hit.normal);
        guide.direct = rt_mul(throughput, surface->emission);
        if (glass) {
            bool inside;
            const float eta = rt__meet_glass(scene, surface, &hit, &throughput, &inside);
            if (rt_refract(ray.direction, hit.normal, eta, &direction))
                throughput = rt_scale(throughput,
                                      1.0f - rt_fresnel(rt_dot(hit.normal, to_eye), eta));
        } else {
            if (!mirror)
                guide.direct =
                    rt_add(guide.direct,
                           rt_mul(throughput,
                                  rt__direct_points(scene, &hit, &brdf, to_eye, rng)));
            throughput = rt_mul(throughput, brdf.albedo);
        }
        if (!(mirror || glass) || bounce >= bounces || bounce >= RT__ROULETTE) {
            guide.normal = hit.normal;
            guide.point = hit.point;
            guide.albedo = throughput;
            return guide;
        }
        ray.origin = rt_leave(hit.point, hit.normal, direction);
        ray.direction = direction;
    }
}

/* ====================================================================================
 * Pictures
 * ==================================================================================== */

/* A picture of linear RGB, row by row from the top: pixel (x, y) is pixels[y * width +
 * x]. The memory is yours, width * height vectors; it need not be cleared. At any time a
 * pixel holds the mean of its samples so far, and rt_render adds to them. Call
 * rt_image_clear before another picture goes into the same memory; otherwise the two are
 * mixed. */
typedef struct rt_image {
    int width, height;
    rt_vec3 *pixels;
    int samples;   /* how many samples every pixel has */
    int done;      /* how many pixels, counted from the first, have one more (after a
                      cancel, or when time ran out) */
    uint64_t rays; /* how many rays were traced for it, camera and shadow rays included */
    rt_vec3 *half; /* NULL, or as many vectors again, for the mean of every second sample:
                      then rt_image_error can estimate the error. Do not add or remove it
                      while samples or done are above 0 */
    rt_vec3 *rest; /* NULL, or as many vectors again (with half, twice as many), for what
                      is lost when the means are rounded. Means of more than some
                      thousands of samples need it, see rt_render. Add or remove it only
                      as half */
    rt_guide *guides; /* NULL, or one for each pixel, for what rt_denoise wants to know:
                         means over the same samples. Add or remove it only as half */
    int first, count; /* 0, 0: the whole picture. Otherwise a part, and all the memory is
                         for only count pixels of the picture, starting at number first;
                         pixel (x, y) has number y * width + x. Parts that are rendered
                         separately, on any machines, together have the whole's bits */
} rt_image;

/* Begin a new picture in the same memory. */
static inline void rt_image_clear(rt_image *image)
{
    image->samples = image->done = 0;
    image->rays = 0;
}

typedef enum rt_sampler {
    RT_SOBOL, /* the numbers of chapter 9 */
    RT_RANDOM /* those of chapter 7 */
} rt_sampler;

/* How to render. Zero everywhere is valid. */
typedef struct rt_options {
    int samples;   /* per pixel, on top of those the image has; 0 means 16, or with error
                      or seconds as many as they allow */
    int bounces;   /* see rt_radiance; 0 is direct light only, RT_ALL_BOUNCES all light */
    int threads;   /* 1 to 1024; 0 means as many as OpenMP offers */
    uint32_t seed; /* another seed, another noise */

    /* Called on the thread that called rt_render, soon after the start and then every 15
     * ms or so, even during a path that takes longer. No thread writes to the image
     * meanwhile, so you may read it. part goes from 0 to 1. Return false to stop; the
     * threads first finish what they have begun. It must return: a longjmp or C++
     * exception out of it would lose threads and memory. */
    bool (*progress)(void *user, float part);
    void *user; /* handed to progress */

    rt_sampler sampler; /* where the numbers come from */
    float error;        /* stop when rt_image_error is down to this; it is asked after 16
                           more samples, then whenever there are an eighth more. The image
                           needs half. 0: never */
    float seconds;      /* stop after this time, with at least one sample; 0: never.
                           (Without OpenMP it is processor time if the C library is older
                           than C11, or told to be) */
    int lanes;          /* rays that rt_render traces at a time: 1, as the chapters do, or
                           rt_lane_count(0); 0 means the latter. The same picture */
    rt_lens lens;       /* chapter 14; radius 0: a pinhole */
} rt_options;

/* How it went; rt_status_text puts it in words. */
typedef enum rt_status {
    RT_OK,
    RT_CANCELLED,
    RT_NO_MEMORY,
    RT_BAD_POINTER,
    RT_BAD_SIZE,
    RT_BAD_SAMPLES,
    RT_BAD_BOUNCES,
    RT_BAD_THREADS,
    RT_BAD_SAMPLER,
    RT_BAD_ERROR,
    RT_BAD_SECONDS,
    RT_BAD_LANES,
    RT_BAD_BVH,
    RT_BAD_PIXEL,
    RT_BAD_CAMERA,
    RT_BAD_SPHERE,
    RT_BAD_BOX,
    RT_BAD_LIGHT,
    RT_BAD_BACKGROUND,
    RT_BAD_GUIDES,
    RT_BAD_SURFACE,
    RT_BAD_LAMP,
    RT_BAD_LENS,
    RT_BAD_MESH,
    RT_BAD_CUSTOM_SHAPE
} rt_status;

/* The colour seen through the point (x, y) of the film, estimated with the random numbers
 * of *rng; context is the caller's. Called on many threads at once. */
typedef rt_vec3 rt_pixel_function(const void *context, float x, float y, rt_rng *rng);

/* Add options->samples samples to every pixel of the image. A sample takes a random point
 * in the square of the pixel, the camera's ray through it, and rt_radiance along the ray
 * (in part two rt_lens_ray and rt_radiance_mis); the pixel is their mean. options may be
 * NULL: all defaults. An empty scene shows the background, a scene without lights the
 * part of the background that arrives. A scene without a bvh gets one for the duration of
 * the call; build it yourself if you render many shapes again and again.
 *
 * A mean of floats drifts: where most samples are dark and few are bright, each dark one
 * is rounded the same way. The mean of 2^18 samples may be wrong by 0.5 %, that of 2^25
 * by 5 %. With image->rest it is right to 1e-6, for 12 more bytes per pixel, 24 with
 * half. A call for more than 4096 samples borrows that much from RT_MALLOC while it runs;
 * set rest yourself if so many samples come in several calls.
 *
 * RT_OK when all samples are done, or the wanted error is reached, or time is up.
 * RT_CANCELLED if progress returned false before that: the image holds what was done by
 * then. The same call with the remaining samples goes on from there, and gives the same
 * bits as without the stop (where rest is borrowed, the same but for a rounding). On any
 * other status the image is untouched; for a bad shape or light, rt_check_scene tells
 * which. */
RTDEF rt_status rt_render(const rt_scene *scene, const rt_camera *camera,
                          const rt_options *options, rt_image *image);

/* The same loop over pixels, samples and threads, with a function of your own in place of
 * camera ray and rt_radiance. options->bounces and lanes are ignored. */
RTDEF rt_status rt_render_pixels(rt_pixel_function *pixel, const void *context,
                                 const rt_options *options, rt_image *image);

/* The estimated error of the image: the standard deviation of its noise over its mean,
 *
 *     sqrt(mean of variance over pixels and channels) / mean of the image,
 *
 * so 0.01 means that a pixel is typically off by a hundredth of the mean brightness. If
 * the even samples, with mean A, and the odd ones are independent, each pixel of mean M
 * tells its variance: (A - M)^2 n_even / n_odd. One pixel tells little, thousands tell
 * much. With image->half, rt_render keeps A there and draws even and odd samples from
 * separate sequences. (That costs a little: with RT_SOBOL each half is evenly spread,
 * both together less so.) Error from too few bounces is not noise, and not included. The
 * result is 0 for a black image, and INFINITY (unknown) with less than 2 samples or
 * without half. */
RTDEF float rt_image_error(const rt_image *image);

/* Finish a picture of few samples (chapter 10): result->pixels becomes the image without
 * most of its noise. The image must have half and guides, and at least two samples; it
 * stays as it is, so rendering may go on. threads is as in rt_options. The bits are the
 * same on every machine and for any number of threads. Meanwhile it borrows 88 bytes per
 * pixel from RT_MALLOC.
 *
 * result is an image of the same size with pixels of its own. It gets samples, done and
 * rays from image; its half and guides are ignored. A pixel that is not finite, or is
 * above 1e15, stays as it is, and no other asks it.
 *
 * What the guides do not show, such as a shadow in indirect light, is lost where it is
 * fainter than the noise. More samples bring more of it back. Behind glass the guides
 * themselves are noisy, and a dark pixel may come out a little below 0.
 *
 * RT_BAD_POINTER, RT_BAD_SIZE (also if result has another size, or one of them is a part
 * of a picture), RT_BAD_SAMPLES (less than 2), RT_BAD_GUIDES (no guides or no half),
 * RT_BAD_THREADS, RT_NO_MEMORY: then the result is untouched. */
RTDEF rt_status rt_denoise(const rt_image *image, int threads, rt_image *result);

/* The estimated error of what rt_denoise makes of the image, in units of rt_image_error.
 * It counts not only noise, but also what is smoothed and should not be. Even and odd
 * samples, with means A and B, are finished separately into A' and B'. A' has not seen B,
 * so |A' - B|^2 is the square of its error plus the variance of B; likewise for B'. The
 * two variances add up to |A - B|^2:
 *
 *     error^2 = 1/2 mean of |A' - B|^2 + |B' - A|^2 - |A - B|^2.
 *
 * That is the error with half of the samples, so it is a little too large. It takes twice
 * as long as rt_denoise, and 24 more bytes per pixel. INFINITY (unknown) where rt_denoise
 * would return an error. */
RTDEF float rt_denoised_error(const rt_image *image, int threads);

/* One point of a path: the ray that was followed, and what it met. */
typedef struct rt_vertex {
    rt_ray ray;
    rt_hit hit;         /* of the shape, all zero if it met none */
    int shape;          /* its number, as in rt_hit; -1: none, background */
    rt_vec3 throughput; /* how much of the light from here arrives at the camera */
    rt_vec3 light;      /* direct light here, or background; black on a mirror. It adds
                           throughput . light to the value of the sample */
    rt_event event;     /* how the path goes on; if it ends, what the surface is */
    int lamp;           /* part two: the lamp that it has met, -1: none; */
    float weight;       /* how much of that lamp counts, see rt_mis; */
    float density;      /* of the direction in which it goes on, 0: it had no choice; */
    bool inside;        /* and has the ray come through glass? */
} rt_vertex;

/* A question from one point of a path: does the point see this light? */
typedef struct rt_shadow {
    int vertex, light; /* their numbers; light -1: a lamp with a size, */
    int lamp;          /* this one; else -1 */
    rt_ray ray;        /* from the point, to the light at t = 1 */
    float cosine, dd;  /* <N,L> and d^2 */
    int blocker;       /* the nearest shape in between, at t; -1: none, the light is seen
                          (or a lamp with a size hides it, and light_sent is black) */
    float t;
    rt_vec3 light_sent; /* what comes from there: rt_lambert, or black */
    float weight;       /* of a lamp, already in light_sent: see rt_mis */
} rt_shadow;

/* All that happened to one sample of a pixel. The arrays are yours; say how long they
 * are. What does not fit is dropped, but still counted. There is at most one more vertex
 * than bounces (two more with lamps or surfaces), and for each vertex as many shadows as
 * there are lights and lamps. */
typedef struct rt_path {
    rt_vertex *vertices;
    int max_vertices, vertex_count;
    rt_shadow *shadows;
    int max_shadows, shadow_count;
    rt_vec3 value; /* of the sample: the sum of throughput . light over the vertices */
    uint32_t rays; /* how many it took */
    const rt_scene *scene; /* while it is traced, */
    int bounces;           /* and with so many; */
    bool told;             /* by rt_radiance_mis, which tells what it does */
} rt_path;

/* Follow one sample of the pixel (x, y) of the image once more, and write it down.
 * path->value is, to the bit, what rt_render with the same arguments makes of this
 * sample; the pixel is the running mean, mean += (value - mean) / (sample + 1). Samples
 * count from 0. The image is not changed; only its size counts, and whether it has a
 * half.
 *
 * What is written down are the questions that rt_radiance, or a routine of yours in its
 * place, asks of the scene through rt_intersect and rt_occluded. So nothing is slower
 * when nobody looks. rt_radiance_mis itself tells what it does.
 *
 * Returns the same errors as rt_render, or RT_BAD_PIXEL; *path is then untouched. */
RTDEF rt_status rt_trace_pixel(const rt_scene *scene, const rt_camera *camera,
                               const rt_options *options, const rt_image *image, int x,
                               int y, int sample, rt_path *path);

/* Build a tree over the shapes of the scene, in time n log n, on all cores; the tree is
 * the same on any number of them. *bvh is overwritten; then set scene->bvh = bvh. When a
 * shape or its material changes, build the tree anew. Memory comes from RT_MALLOC: about
 * 36 bytes for a sphere and 60 for a triangle, until rt_free_bvh, and 70 more for each
 * while the tree is built.
 *
 * RT_NO_MEMORY if memory runs out, or what rt_check_scene says; *bvh is then all zero. */
RTDEF rt_status rt_build_bvh(const rt_scene *scene, rt_bvh *bvh);

/* Give the memory back; *bvh is all zero afterwards, so set scene->bvh = NULL. If bvh is
 * NULL or all zero, nothing happens. */
RTDEF void rt_free_bvh(rt_bvh *bvh);

/* RT_OK if every shape and light of the scene makes sense: all numbers up to 1e15, radius
 * > 0, min <= max, albedo 0 to 1, intensity and background not negative, no count
 * negative, no array missing, bvh NULL or built for as many shapes; surfaces and lamps as
 * chapters 11 to 13 want them. Otherwise it says what is wrong, and sets *index, unless
 * NULL, to the number of the offender in its array. rt_render calls it first. */
RTDEF rt_status rt_check_scene(const rt_scene *scene, int *index);

/* RT_OK, or RT_BAD_CAMERA if a number is not finite or above 1e15, or fov_y not in [0,
 * 180). */
RTDEF rt_status rt_check_camera(const rt_camera *camera);

/* The number of threads that rt_render uses for options->threads = wanted; always 1
 * without OpenMP. What rt_render would refuse counts as the nearest that it takes, 1 or
 * 1024. */
RTDEF int rt_thread_count(int wanted);

/* How many rays rt_render traces at a time for options->lanes = wanted: 1 for 1, and for
 * 0 all that there are, which is the same number in a whole program. What rt_render would
 * refuse counts as the nearest below that it takes, and a negative number as 0.
 *
 * gcc and clang, told to optimise, compile packets of 8 rays for x86 (with AVX2 and FMA:
 * 1 on a machine that lacks them), of 16 if told that the machine has AVX-512, as by
 * -march=native, and of 4 for 64-bit ARM and for WebAssembly with -msimd128. Anywhere
 * else it is 1. */
RTDEF int rt_lane_count(int wanted);

/* What a status means, in English, without a full stop. Never NULL. */
RTDEF const char *rt_status_text(rt_status status);

/* ---- for rt_trace_pixel ---------------------------------------------------------- */

/* The part of the light that arrives by way of vertex number n, as in rt_radiance. */
static inline rt_vec3 rt__throughput(const rt_path *path, int n)
{
    const rt_vertex *v = &path->vertices[n];
    const rt_material *material = v->hit.material;
    if (!material)
        return v->throughput;
    rt_vec3 throughput = v->throughput;
    if (!(material->mirror && rt_is_zero(material->albedo)))
        throughput = rt_mul(throughput, material->albedo);
    if (path->bounces == RT_ALL_BOUNCES && n >= RT__ROULETTE)
        throughput = rt_scale(throughput, 1.0f / rt__chance(throughput));
    return throughput;
}

static inline bool rt__intersect_noted(const rt_scene *scene, const rt_ray *ray,
                                       rt_hit *hit)
{
    rt_path *path = scene->bvh->path;
    const bool found = rt_intersect(path->scene, ray, hit);
    const int n = path->vertex_count++;
    if (n < path->max_vertices) {
        rt_vertex *v = &path->vertices[n];
        memset(v, 0, sizeof *v);
        v->ray = *ray;
        v->throughput =
            n == 0 || path->told ? rt_vec(1.0f, 1.0f, 1.0f) : rt__throughput(path, n - 1);
        v->shape = -1;
        v->lamp = -1;
        if (found) {
            v->hit = *hit;
            v->shape = rt__shape_number(scene, hit);
            v->event = hit->material->mirror ? RT_EVENT_MIRROR : RT_EVENT_MATT;
        } else {
            v->light = scene->background;
        }
    }
    return found;
}

/* Where the light is, seen from the surface. */
static inline void rt__set_shadow(rt_shadow *shadow, const rt_vertex *v, rt_vec3 to_light)
{
    shadow->dd = rt_dot(to_light, to_light);
    shadow->cosine =
        shadow->dd > 0.0f ? rt_dot(v->hit.normal, to_light) / sqrtf(shadow->dd) : 0.0f;
}

static inline bool rt__occluded_noted(const rt_scene *scene, const rt_ray *ray,
                                      float t_max)
{
    rt_path *path = scene->bvh->path;
    const bool blocked = rt_occluded(path->scene, ray, t_max);
    const int n = path->shadow_count++, vertex = path->vertex_count - 1;
    if (vertex < 0 || vertex >= path->max_vertices)
        return blocked;
    rt_shadow here; /* even if it does not fit: the light still counts */
    rt_vertex *v = &path->vertices[vertex];
    memset(&here, 0, sizeof here);
    here.vertex = vertex;
    here.ray = *ray;
    here.blocker = -1;
    here.lamp = -1;
    rt_hit between;
    memset(&between, 0, sizeof between); /* an rt_intersect of your own may leave it so */
    if (blocked && rt_intersect(path->scene, ray, &between)) {
        here.blocker = rt__shape_number(scene, &between);
        here.t = between.t;
    }
    if (!path->told) { /* which light? the one at the end of the ray */
        const rt_vec3 end = rt_at(ray, 1.0f);
        float least = FLT_MAX;
        for (int i = 0; i < scene->light_count; i++) {
            const float distance = rt_length(rt_sub(scene->lights[i].position, end));
            if (distance < least) {
                least = distance;
                here.light = i;
            }
        }
        const rt_light *light = &scene->lights[here.light];
        const rt_vec3 to_light = rt_sub(light->position, v->hit.point);
        rt__set_shadow(&here, v, to_light);
        if (!blocked)
            here.light_sent = rt_lambert(v->hit.material->albedo, v->hit.normal, to_light,
                                         light->intensity);
        v->light = rt_add(v->light, here.light_sent);
    }
    if (n < path->max_shadows)
        path->shadows[n] = here;
    return blocked;
}

/* The point that was noted last; NULL: there was no room for it, or it was met by an
 * rt_intersect of yours, which tells nobody. */
static inline rt_vertex *rt__noted_last(const rt_path *path)
{
    const int n = path->vertex_count - 1;
    return n >= 0 && n < path->max_vertices ? &path->vertices[n] : NULL;
}

/* What rt_radiance_mis tells. */
static inline void rt__note_vertex(const rt_scene *scene, rt_vec3 throughput, int lamp,
                                   rt_vec3 light, float weight)
{
    rt_vertex *v = rt__noted_last(scene->bvh->path);
    if (!v)
        return;
    v->throughput = throughput;
    v->light = light;
    v->lamp = lamp;
    v->weight = weight;
    if (lamp >= 0) { /* in front of any shape */
        v->event = RT_EVENT_LAMP;
        v->shape = -1;
        memset(&v->hit, 0, sizeof v->hit);
    } else if (v->shape >= 0) { /* in case it ends here: what the surface is */
        const rt_surface *surface = rt_surface_of(scene, &v->hit);
        v->event = surface->eta > 0.0f         ? RT_EVENT_REFRACTED
                   : !v->hit.material->mirror  ? RT_EVENT_MATT
                   : surface->shininess > 0.0f ? RT_EVENT_GLOSS
                                               : RT_EVENT_MIRROR;
    }
}

static inline void rt__note_light(const rt_scene *scene, int light, int lamp, rt_vec3 end,
                                  rt_vec3 sent, float weight)
{
    const rt_path *path = scene->bvh->path;
    const int n = path->shadow_count - 1;
    rt_vertex *v = rt__noted_last(path);
    if (!v)
        return;
    v->light = rt_add(v->light, sent);
    if (n < 0 || n >= path->max_shadows || path->shadows[n].vertex != v - path->vertices)
        return; /* an rt_visible of yours may not have asked */
    rt_shadow *here = &path->shadows[n];
    here->light = light;
    here->lamp = lamp;
    here->light_sent = sent;
    here->weight = weight;
    rt__set_shadow(here, v, rt_sub(end, v->hit.point));
}

static inline void rt__note_event(const rt_scene *scene, rt_event event, bool inside,
                                  float density)
{
    rt_vertex *v = rt__noted_last(scene->bvh->path);
    if (!v)
        return;
    v->event = event;
    v->inside = inside;
    v->density = density;
}

#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
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
#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wold-style-cast"
#endif
#ifdef _OPENMP
#include <omp.h>
#if _OPENMP >= 200805
#define RT__TASKS
#endif
#else
#include <time.h>
#endif
#ifndef RT_ASSERT
#include <assert.h>
#define RT_ASSERT(condition) assert(condition)
#endif
#ifndef RT_MALLOC
#include <stdlib.h>
#define RT_MALLOC(size) malloc(size)
#define RT_FREE(memory) free(memory)
#endif

RTDEF const char *rt_status_text(rt_status status)
{
    switch (status) {
    case RT_OK: return "no error";
    case RT_CANCELLED:
        return "stopped by the progress function; render again to go on from there";
    case RT_NO_MEMORY:
        return "not enough memory: take fewer shapes, a smaller picture, or no more than "
               "4096 samples in one call";
    case RT_BAD_POINTER:
        return "an argument or an array of the scene is NULL, or a count is negative: "
               "set the pointer, or the count to 0";
    case RT_BAD_SIZE:
        return "image: make width and height at least 1, their product at most 2^31 - 1, "
               "done at least 0 and less than the product, and first and count 0 or a "
               "part of the picture; rt_denoise takes no parts, and needs a result of "
               "the same size";
    case RT_BAD_SAMPLES:
        return "samples: make options.samples and image.samples at least 0, and their "
               "sum at most 2^31 - 1; rt_denoise needs 2 in the image";
    case RT_BAD_BOUNCES:
        return "bounces: make it at least 0, or RT_ALL_BOUNCES for all light";
    case RT_BAD_THREADS: return "threads: make it 1 to 1024, or 0 for all cores";
    case RT_BAD_SAMPLER: return "sampler: make it RT_SOBOL or RT_RANDOM";
    case RT_BAD_ERROR:
        return "error: make it 0, or set image.half and make it above 0; for a part of a "
               "picture make it 0, since other parts would stop elsewhere";
    case RT_BAD_SECONDS:
        return "seconds: make it at least 0 (0: no limit); for a part of a picture make "
               "it 0, since other parts would stop elsewhere";
    case RT_BAD_LANES: return "lanes: make it 0, 1, or what rt_lane_count(0) returns";
    case RT_BAD_BVH:
        return "bvh: build it with rt_build_bvh after the last change of the scene, or "
               "set scene.bvh to NULL";
    case RT_BAD_PIXEL:
        return "pixel: make x and y those of a pixel of the image, and sample at least 0";
    case RT_BAD_CAMERA:
        return "camera: make all its numbers at most 1e15, and fov_y 0 (for 45) or above "
               "0 and below 180 degrees";
    case RT_BAD_SPHERE:
        return "sphere: make its numbers at most 1e15, the radius above 0, albedo 0 to "
               "1; rt_check_scene tells which sphere";
    case RT_BAD_BOX:
        return "box: make its numbers at most 1e15, min at most max in x, y and z, "
               "albedo 0 to 1; rt_check_scene tells which box";
    case RT_BAD_LIGHT:
        return "light: make its numbers at most 1e15, no intensity negative; "
               "rt_check_scene tells which light";
    case RT_BAD_GUIDES:
        return "guides: set image.half and image.guides before you render the image";
    case RT_BAD_SURFACE:
        return "surface: make eta 0 or 1 to 4, shininess 0 to 1e6, absorption and "
               "emission 0 to 1e15; rt_check_scene tells which surface";
    case RT_BAD_LAMP:
        return "lamp: make its numbers at most 1e15, no intensity negative, and radius "
               "at least 1e-6, or 0 with sides u and v that span an area of at least "
               "1e-12; rt_check_scene tells which lamp";
    case RT_BAD_LENS:
        return "lens: make radius 0 to 1e15 and, unless it is 0, focus above 0 and at "
               "most 1e15";
    case RT_BAD_MESH:
        return "mesh: make every index at least 0 and less than position_count, all "
               "coordinates at most 1e15, albedo 0 to 1, no count negative, and no array "
               "NULL; rt_check_scene tells which mesh";
    case RT_BAD_CUSTOM_SHAPE:
        return "custom shape: make its box's numbers at most 1e15, min at most max in x, "
               "y and z, albedo 0 to 1, and set its function; rt_check_scene tells which";
    case RT_BAD_BACKGROUND: return "background: make it 0 to 1e15 in red, green and blue";
    }
    return "unknown status";
}

/* Are all three components in [low, high]? NaN is not. */
static inline bool rt__within(rt_vec3 v, float low, float high)
{
    return v.x >= low && v.x <= high && v.y >= low && v.y <= high && v.z >= low &&
           v.z <= high;
}

/* The largest number allowed: its square, and I / d^2, must still fit a float. */
#define RT__LARGEST 1e15f

static inline bool rt__good_place(rt_vec3 v)
{
    return rt__within(v, -RT__LARGEST, RT__LARGEST);
}

static inline bool rt__good_surface(const rt_surface *s)
{
    return (s->eta == 0.0f || (s->eta >= 1.0f && s->eta <= 4.0f)) &&
           s->shininess >= 0.0f && s->shininess <= 1e6f &&
           rt__within(s->absorption, 0.0f, RT__LARGEST) &&
           rt__within(s->emission, 0.0f, RT__LARGEST);
}

static inline bool rt__good_lamp(const rt_lamp *l)
{
    if (!(rt__good_place(l->center) && rt__within(l->intensity, 0.0f, RT__LARGEST) &&
          rt__good_place(l->u) && rt__good_place(l->v)))
        return false;
    return l->radius == 0.0f ? rt__lamp_area(l) >= 1e-12f
                             : l->radius >= 1e-6f && l->radius <= RT__LARGEST;
}

static inline bool rt__good_mesh(const rt_mesh *m)
{
    if (!(m->position_count >= 0 && (m->position_count == 0 || m->positions) &&
          m->triangle_count >= 0 && (m->triangle_count == 0 || m->indices) &&
          rt__within(m->material.albedo, 0.0f, 1.0f)))
        return false;
    for (int i = 0; i < m->position_count; i++)
        if (!rt__good_place(m->positions[i]))
            return false;
    const size_t corners = 3 * (size_t)m->triangle_count;
    for (size_t i = 0; i < corners; i++)
        if (m->indices[i] < 0 || m->indices[i] >= m->position_count)
            return false;
    return true;
}

static inline bool rt__good_box(rt_vec3 low, rt_vec3 high, const rt_material *material)
{
    return rt__good_place(low) && rt__good_place(high) && low.x <= high.x &&
           low.y <= high.y && low.z <= high.z && rt__within(material->albedo, 0.0f, 1.0f);
}

/* Has each mesh as many triangles as when the tree was built? */
static inline bool rt__has_meshes(const rt_bvh *bvh, const rt_scene *scene)
{
    const int *before = bvh->triangles_before;
    if (bvh->mesh_count != scene->mesh_count)
        return false;
    for (int i = 0; before && i < scene->mesh_count; i++)
        if (before[i + 1] - before[i] != scene->meshes[i].triangle_count)
            return false;
    return true;
}

RTDEF rt_status rt_check_scene(const rt_scene *scene, int *index)
{
    int nowhere = 0;
    int *i = index ? index : &nowhere;
    *i = 0;
    if (!scene || scene->sphere_count < 0 ||
        (scene->sphere_count > 0 && !scene->spheres) || scene->box_count < 0 ||
        (scene->box_count > 0 && !scene->boxes) || scene->light_count < 0 ||
        (scene->light_count > 0 && !scene->lights) || scene->lamp_count < 0 ||
        (scene->lamp_count > 0 && !scene->lamps) || scene->mesh_count < 0 ||
        (scene->mesh_count > 0 && !scene->meshes) || scene->custom_shape_count < 0 ||
        (scene->custom_shape_count > 0 && !scene->custom_shapes))
        return RT_BAD_POINTER;
    for (*i = 0; *i < scene->sphere_count; ++*i) {
        const rt_sphere *s = &scene->spheres[*i];
        if (!(rt__good_place(s->center) && s->radius > 0.0f && s->radius <= RT__LARGEST &&
              rt__within(s->material.albedo, 0.0f, 1.0f)))
            return RT_BAD_SPHERE;
    }
    for (*i = 0; *i < scene->box_count; ++*i) {
        const rt_box *b = &scene->boxes[*i];
        if (!rt__good_box(b->min, b->max, &b->material))
            return RT_BAD_BOX;
    }
    for (*i = 0; *i < scene->mesh_count; ++*i)
        if (!rt__good_mesh(&scene->meshes[*i]))
            return RT_BAD_MESH;
    for (*i = 0; *i < scene->custom_shape_count; ++*i) {
        const rt_custom_shape *c = &scene->custom_shapes[*i];
        if (!(c->hit && rt__good_box(c->min, c->max, &c->material)))
            return RT_BAD_CUSTOM_SHAPE;
    }
    for (*i = 0; *i < scene->light_count; ++*i) {
        const rt_light *l = &scene->lights[*i];
        if (!(rt__good_place(l->position) && rt__within(l->intensity, 0.0f, RT__LARGEST)))
            return RT_BAD_LIGHT;
    }
    const int shapes = scene->surfaces ? rt__shape_count(scene) : 0;
    for (*i = 0; *i < shapes; ++*i)
        if (!rt__good_surface(&scene->surfaces[*i]))
            return RT_BAD_SURFACE;
    for (*i = 0; *i < scene->lamp_count; ++*i)
        if (!rt__good_lamp(&scene->lamps[*i]))
            return RT_BAD_LAMP;
    *i = 0;
    if (!rt__within(scene->background, 0.0f, RT__LARGEST))
        return RT_BAD_BACKGROUND;
    const rt_bvh *bvh = scene->bvh;
    if (bvh && (!bvh->nodes || bvh->sphere_count != scene->sphere_count ||
                bvh->box_count != scene->box_count || !rt__has_meshes(bvh, scene) ||
                bvh->triangle_count != rt__triangle_count(scene) ||
                bvh->custom_shape_count != scene->custom_shape_count))
        return RT_BAD_BVH;
    return RT_OK;
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

/* How many rays at a time? See the last section. Without optimisation there are no
 * packets, as they would take longer. RT_NO_PACKETS leaves them out, RT_PACKETS keeps
 * them in any case. */
#if defined(__GNUC__) && !defined(RT_NO_PACKETS) && !defined(RT__OWN) &&                 \
    (defined(__OPTIMIZE__) || defined(RT_PACKETS))
#if defined(__SSE2_MATH__)
#define RT__X86
#include <immintrin.h>
#if defined(__AVX512F__) && defined(__AVX512VL__) && defined(__AVX512BW__) &&            \
    defined(__AVX512DQ__) && defined(__FMA__)
#define RT__LANES 16
#else
#define RT__LANES 8 /* with AVX2, asked for when the program runs */
#endif
#elif defined(__aarch64__) && defined(__ARM_NEON)
#define RT__LANES 4
#include <arm_neon.h>
#elif defined(__wasm_simd128__)
#define RT__LANES 4
#include <wasm_simd128.h>
#endif
#endif
#ifdef RT__LANES
#include <fenv.h>
#else
#define RT__LANES 1
#endif

/* ---- the tree of chapter 8 ------------------------------------------------------- */

typedef struct rt__bounds {
    rt_vec3 min, max;
} rt__bounds;

static inline rt_vec3 rt__min(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.x < b.x ? a.x : b.x, a.y < b.y ? a.y : b.y, a.z < b.z ? a.z : b.z);
}

static inline rt_vec3 rt__max(rt_vec3 a, rt_vec3 b)
{
    return rt_vec(a.x > b.x ? a.x : b.x, a.y > b.y ? a.y : b.y, a.z > b.z ? a.z : b.z);
}

static inline rt__bounds rt__no_bounds(void)
{
    rt__bounds b;
    b.min = rt_vec(FLT_MAX, FLT_MAX, FLT_MAX);
    b.max = rt_vec(-FLT_MAX, -FLT_MAX, -FLT_MAX);
    return b;
}

static inline void rt__grow(rt__bounds *b, const rt__bounds *by)
{
    b->min = rt__min(b->min, by->min);
    b->max = rt__max(b->max, by->max);
}

/* Half the surface: rays from all sides meet a box in proportion to it. */
static inline double rt__area(const rt__bounds *b)
{
    const rt_dvec3 d = rt_dsub(rt_to_double(b->max), rt_to_double(b->min));
    return d.x * d.y + d.y * d.z + d.z * d.x;
}

/* Twice the middle of the box. */
static inline rt_vec3 rt__middle(const rt__bounds *b)
{
    return rt_add(b->min, b->max);
}

static inline float rt__component(rt_vec3 v, int axis)
{
    return axis == 0 ? v.x : axis == 1 ? v.y : v.z;
}

/* A box around a triangle or a custom shape. */
static inline rt__bounds rt__other_bounds(const rt_scene *scene, rt__other p)
{
    rt__bounds b = rt__no_bounds();
    if (p.mesh == scene->mesh_count) {
        rt__loosen(&scene->custom_shapes[p.part], &b.min, &b.max);
        return b;
    }
    for (int k = 0; k < 3; k++) {
        const rt_vec3 corner = rt_corner(&scene->meshes[p.mesh], p.part, k);
        b.min = rt__min(b.min, corner);
        b.max = rt__max(b.max, corner);
    }
    return b;
}

/* A box, and a little more: its coordinates are rounded, and a ray in the very plane of a
 * face must enter it (since rt__inverse turns 0/0 into 0). The margin is the same along
 * each axis: where a triangle appears to a ray is a sum over all three, and so is its
 * rounding. */
static inline rt__bounds rt__with_margin(rt__bounds b)
{
    const rt_vec3 size = rt__max(rt__max(b.max, rt_scale(b.max, -1.0f)),
                                 rt__max(b.min, rt_scale(b.min, -1.0f)));
    float most = size.x > size.y ? size.x : size.y;
    most = (most > size.z ? most : size.z) * (2.0f * FLT_EPSILON) + 1e-15f;
    const rt_vec3 margin = rt_vec(most, most, most);
    b.min = rt_sub(b.min, margin);
    b.max = rt_add(b.max, margin);
    return b;
}

/* A box around a shape. */
static inline rt__bounds rt__shape_bounds(const rt_scene *scene, int number)
{
    rt__bounds b;
    const int box = number - scene->sphere_count;
    if (box >= scene->box_count) {
        b = rt__other_bounds(scene, rt__other_of(scene, number));
    } else if (box >= 0) {
        b.min = scene->boxes[box].min;
        b.max = scene->boxes[box].max;
    } else {
        const rt_sphere *s = &scene->spheres[number];
        const float radius = 1.001f * s->radius; /* from far away double is no better */
        const rt_vec3 r = rt_vec(radius, radius, radius);
        b.min = rt_sub(s->center, r);
        b.max = rt_add(s->center, r);
    }
    return rt__with_margin(b);
}

/* A shape that is to be put into the tree. */
typedef struct rt__entry {
    rt__bounds bounds;
    int number;
} rt__entry;

/* Some shapes of one kind: entries[first] and those after it. */
typedef struct rt__group {
    rt__bounds bounds;
    int first, count;
} rt__group;

/* A node to be, and how many nodes and rows there are in it and below. */
typedef struct rt__branch {
    rt__group groups[8]; /* count 0: none */
    int nodes;
    int64_t rows;
} rt__branch;

static inline rt__bounds rt__middles_of(const rt__entry *entries, const rt__group *group)
{
    rt__bounds middles = rt__no_bounds();
    for (int i = group->first; i < group->first + group->count; i++) {
        rt__bounds middle;
        middle.min = middle.max = rt__middle(&entries[i].bounds);
        rt__grow(&middles, &middle);
    }
    return middles;
}

static inline rt__group rt__group_of(const rt__entry *entries, int first, int count)
{
    rt__group group;
    group.first = first;
    group.count = count;
    group.bounds = rt__no_bounds();
    for (int i = first; i < first + count; i++)
        rt__grow(&group.bounds, &entries[i].bounds);
    return group;
}

/* The part of a group between two places along an axis. */
typedef struct rt__bin {
    rt__bounds bounds, middles;
    int count;
} rt__bin;

enum { RT__BINS = 16 };

static inline void rt__add_bin(rt__bin *bin, const rt__bin *other)
{
    rt__grow(&bin->bounds, &other->bounds);
    rt__grow(&bin->middles, &other->middles);
    bin->count += other->count;
}

static inline rt__bin rt__no_bin(void)
{
    rt__bin bin;
    bin.bounds = bin.middles = rt__no_bounds();
    bin.count = 0;
    return bin;
}

/* Which bin a shape belongs to. */
static inline int rt__bin_of(const rt__entry *entry, int axis, float low, float scale)
{
    const float middle = rt__component(rt__middle(&entry->bounds), axis);
    const int bin = (int)((middle - low) * scale);
    return bin < RT__BINS ? bin : RT__BINS - 1;
}

/* The least number of leaves for so many shapes. */
static inline int rt__leaves(int count)
{
    return (count + 7) / 8;
}

/* The cheapest cut, the first of several; and in *one and *two the two parts. */
static inline int rt__cheapest_cut(const rt__bin *bins, rt__bin *one, rt__bin *two)
{
    rt__bin side = rt__no_bin(), after[RT__BINS];
    double best_cost = DBL_MAX;
    int best = 1;
    for (int k = RT__BINS - 1; k > 0; k--) {
        rt__add_bin(&side, &bins[k]);
        after[k] = side;
    }
    side = rt__no_bin();
    for (int k = 1; k < RT__BINS; k++) {
        rt__add_bin(&side, &bins[k - 1]);
        const double cost = rt__area(&side.bounds) * rt__leaves(side.count) +
                            rt__area(&after[k].bounds) * rt__leaves(after[k].count);
        if (cost < best_cost) {
            best_cost = cost;
            best = k;
            *one = side;
            *two = after[k];
        }
    }
    return best;
}

/* Cut a group into itself and another. middles is the box around the middles of all;
 * afterwards, those of the two.
 *
 * A ray enters a box with a chance in proportion to its surface, and then asks what is
 * inside, leaf by leaf. So the two cost A_left n_left + A_right n_right, if n counts
 * leaves. The cheapest of 15 cuts across the longest axis is taken: the surface area
 * heuristic, in bins (I. Wald, "On fast construction of SAH-based bounding volume
 * hierarchies", 2007). It cuts off a giant among small shapes at once, so the giant
 * spoils only the boxes above. */
static inline void rt__split(rt__entry *entries, bool in_halves, rt__group *group,
                             rt__bounds *middles, rt__group *other,
                             rt__bounds *other_middles)
{
    const rt_vec3 extents = rt_sub(middles->max, middles->min);
    const int axis = extents.x >= extents.y && extents.x >= extents.z ? 0
                     : extents.y >= extents.z                         ? 1
                                                                      : 2;
    const float low = rt__component(middles->min, axis);
    const float extent = rt__component(extents, axis);
    const int first = group->first, end = first + group->count;
    if (in_halves || !(extent > 1e-30f)) { /* all in one place: any cut will do */
        const int half = group->count / 2;
        *group = rt__group_of(entries, first, half);
        *other = rt__group_of(entries, first + half, end - first - half);
        *middles = rt__middles_of(entries, group);
        *other_middles = rt__middles_of(entries, other);
        return;
    }
    const float scale = (float)RT__BINS / extent;
    rt__bin bins[RT__BINS], one = rt__no_bin(), two = one;
    for (int k = 0; k < RT__BINS; k++)
        bins[k] = rt__no_bin();
    for (int i = first; i < end; i++) {
        rt__bin *bin = &bins[rt__bin_of(&entries[i], axis, low, scale)];
        rt__bounds middle;
        middle.min = middle.max = rt__middle(&entries[i].bounds);
        rt__grow(&bin->bounds, &entries[i].bounds);
        rt__grow(&bin->middles, &middle);
        bin->count++;
    }
    const int best = rt__cheapest_cut(bins, &one, &two);
    int left = first;
    for (int i = first; i < end; i++) { /* move those before the cut to the front */
        const rt__entry entry = entries[i];
        entries[i] = entries[left];
        entries[left] = entry;
        left += rt__bin_of(&entry, axis, low, scale) < best;
    }
    group->count = one.count;
    group->bounds = one.bounds;
    *middles = one.middles;
    other->first = left;
    other->count = two.count;
    other->bounds = two.bounds;
    *other_middles = two.middles;
}

/* Cut the groups of a branch until there are eight, or all are leaves: always the one
 * that costs most. With in_halves it is the one with the most shapes; then none of the
 * eight has more than an eighth of them, rounded up. */
static inline void rt__split_in_eight(rt__entry *entries, bool in_halves,
                                      rt__group *groups)
{
    rt__bounds middles[8];
    int count = 0;
    for (; count < 8 && groups[count].count > 0; count++)
        middles[count] = rt__middles_of(entries, &groups[count]);
    while (count < 8) {
        int worst = -1;
        double worst_cost = -1.0;
        for (int k = 0; k < count; k++) {
            const double area = in_halves ? 1.0 : rt__area(&groups[k].bounds);
            const double cost = area * groups[k].count;
            if (groups[k].count > 8 && cost > worst_cost) {
                worst_cost = cost;
                worst = k;
            }
        }
        if (worst < 0)
            break;
        rt__split(entries, in_halves, &groups[worst], &middles[worst], &groups[count],
                  &middles[count]);
        count++;
    }
}

/* The first level of the tree that is cut in halves. Above it the cheapest cut may take
 * off one shape at a time, as where they lie at 1, 2, 4, 8 ... At this level a node has
 * less than 2^31 shapes, and on each of the next ten levels at most an eighth as many:
 * 2^28, 2^25 ... 2. Eight or less are a leaf, so there are less than 21 + 11 levels. */
enum { RT__HALVES = RT__LEVELS - 11 };

/* Several threads build a tree of more shapes than the first number; the second is the
 * size of a task. */
enum { RT__SHARED = 65536, RT__TASK = 4096 };

/* A group of n > 8 shapes makes at most (n - 2) / 7 nodes, its own and those below. If
 * its node has only leaves, that holds since n >= 9. Otherwise it has eight groups, m of
 * them with more than eight shapes. If the bound holds for those, they make at most (n -
 * (8 - m) - 2 m) / 7 nodes, and with the node itself there are (n - 1 - m) / 7. So each
 * group has its own slice of the branches, whatever the threads do, and the tree is the
 * same for any number of threads. */
static inline int rt__most_nodes(int count)
{
    return count > 8 ? (count - 2) / 7 : 0;
}

/* All that building a tree needs. */
typedef struct rt__builder {
    const rt_scene *scene;
    rt__entry *entries;
    rt__branch *branches;
    rt_bvh *bvh;
} rt__builder;

/* The kind of the shape with this number, see rt_bvh_row, ... */
static inline int rt__kind_of(const rt_scene *scene, int number)
{
    const int box = number - scene->sphere_count;
    return box < 0                                                 ? RT__SPHERES
           : box < scene->box_count                                ? RT__BOXES
           : rt__other_of(scene, number).mesh == scene->mesh_count ? RT__BOXES
                                                                   : RT__TRIANGLES;
}

/* ... and how many rows a leaf of this kind has. */
static inline int rt__rows(int kind)
{
    return kind == RT__SPHERES ? 5 : kind == RT__BOXES ? 7 : 10;
}

/* Build branch number at, whose groups are set, and all below it. */
static inline void rt__build_branch(const rt__builder *b, int at, int depth)
{
    rt__branch *branch = &b->branches[at];
    RT_ASSERT(depth < RT__LEVELS);
    rt__split_in_eight(b->entries, depth >= RT__HALVES, branch->groups);
    int slice = at + 1;
    for (int k = 0; k < 8; k++) {
        const rt__group *group = &branch->groups[k];
        if (group->count <= 8)
            continue;
        memset(b->branches[slice].groups, 0, sizeof b->branches[slice].groups);
        b->branches[slice].groups[0] = *group;
#ifdef RT__TASKS
#pragma omp task if (group->count > RT__TASK)
#endif
        rt__build_branch(b, slice, depth + 1);
        slice += rt__most_nodes(group->count);
    }
#ifdef RT__TASKS
#pragma omp taskwait
#endif
    branch->nodes = 1;
    branch->rows = 0;
    slice = at + 1;
    for (int k = 0; k < 8; k++) {
        const rt__group *group = &branch->groups[k];
        if (group->count > 8) {
            branch->nodes += b->branches[slice].nodes;
            branch->rows += b->branches[slice].rows;
            slice += rt__most_nodes(group->count);
        } else if (group->count > 0) {
            branch->rows +=
                rt__rows(rt__kind_of(b->scene, b->entries[group->first].number));
        }
    }
}

static inline void rt__set_box(rt_bvh_node *node, int k, const rt__bounds *b)
{
    node->min_x[k] = b->min.x;
    node->min_y[k] = b->min.y;
    node->min_z[k] = b->min.z;
    node->max_x[k] = b->max.x;
    node->max_y[k] = b->max.y;
    node->max_z[k] = b->max.z;
}

static inline void rt__put_vec(float *to, rt_vec3 v)
{
    to[0] = v.x;
    to[1] = v.y;
    to[2] = v.z;
}

/* The numbers of a shape that its leaf holds. */
static inline void rt__set_values(const rt_scene *scene, int number, float *values)
{
    const int box = number - scene->sphere_count;
    if (box < 0) {
        rt__put_vec(values, scene->spheres[number].center);
        values[3] = scene->spheres[number].radius;
        return;
    }
    if (box < scene->box_count) {
        rt__put_vec(values, scene->boxes[box].min);
        rt__put_vec(values + 3, scene->boxes[box].max);
        return;
    }
    const rt__other p = rt__other_of(scene, number);
    if (p.mesh == scene->mesh_count) {
        const rt__bounds bounds = rt__other_bounds(scene, p);
        rt__put_vec(values, bounds.min);
        rt__put_vec(values + 3, bounds.max);
        return;
    }
    const rt__corners corners = rt__corners_of(&scene->meshes[p.mesh], p.part);
    rt__put_vec(values, corners.a);
    rt__put_vec(values + 3, corners.b);
    rt__put_vec(values + 6, corners.c);
}

/* Write the leaf at rows[at]; returns how a node refers to it. Columns without a shape
 * repeat the first. */
static inline int rt__set_leaf(const rt__builder *b, const rt__group *group, int at)
{
    const rt__entry *entries = &b->entries[group->first];
    const int kind = rt__kind_of(b->scene, entries->number), rows = rt__rows(kind);
    rt_bvh_row *row = &b->bvh->rows[at];
    for (int k = 0; k < 8; k++) {
        float values[9];
        row->number[k] = k < group->count ? entries[k].number : -1;
        rt__set_values(b->scene, entries[k < group->count ? k : 0].number, values);
        for (int i = 1; i < rows; i++)
            row[i].value[k] = values[i - 1];
    }
    return at << 2 | kind;
}

/* The order in which a ray meets the boxes, the last first: eight numbers of three bits
 * for each octant; bit 0, 1, 2 of the octant says that the ray goes down along x, y, z.
 * The order is a guess by the middles of the boxes. Only the time depends on it. */
static inline void rt__set_order(rt_bvh_node *node)
{
    for (int octant = 0; octant < 8; octant++) {
        float place[8] = {0.0f};
        uint32_t order = 0;
        for (int k = 0; k < node->count; k++) {
            const float x = node->min_x[k] + node->max_x[k];
            const float y = node->min_y[k] + node->max_y[k];
            const float z = node->min_z[k] + node->max_z[k];
            place[k] = ((octant & 1) != 0 ? -x : x) + ((octant & 2) != 0 ? -y : y) +
                       ((octant & 4) != 0 ? -z : z);
        }
        for (int k = 0; k < 8; k++) { /* how many come after it? */
            int after = k < node->count ? 0 : k;
            for (int i = 0; k < node->count && i < node->count; i++)
                after += place[i] > place[k] || (i < k && place[i] == place[k]);
            order |= (uint32_t)k << 3 * after;
        }
        for (int i = 0; i < 3; i++)
            node->order[3 * octant + i] = (unsigned char)(order >> 8 * i & 255u);
    }
}

/* The branch becomes the node with this number, and those below come after it. The same
 * goes for the rows. */
static inline void rt__set_node(const rt__builder *b, int at, int number, int row)
{
    const rt__branch *branch = &b->branches[at];
    rt_bvh_node *node = &b->bvh->nodes[number++];
    rt__bounds nothing;
    nothing.min = rt_vec(INFINITY, INFINITY, INFINITY);
    nothing.max = rt_scale(nothing.min, -1.0f);
    int slice = at + 1;
    memset(node, 0, sizeof *node);
    for (int k = 0; k < 8; k++) {
        const rt__group *group = &branch->groups[k];
        rt__set_box(node, k, group->count > 0 ? &group->bounds : &nothing);
        if (group->count == 0)
            continue;
        node->count = k + 1;
        if (group->count <= 8) {
            node->inside[k] = rt__set_leaf(b, group, row);
            row += rt__rows(rt__kind_of(b->scene, b->entries[group->first].number));
            continue;
        }
        node->inside[k] = -number;
#ifdef RT__TASKS
#pragma omp task if (group->count > RT__TASK)
#endif
        rt__set_node(b, slice, number, row);
        number += b->branches[slice].nodes;
        row += (int)b->branches[slice].rows;
        slice += rt__most_nodes(group->count);
    }
    rt__set_order(node);
}

/* One ray at a time asks up to so many shapes sooner without the tree. */
enum { RT__FEW_ALONE = 64 };

RTDEF void rt_free_bvh(rt_bvh *bvh)
{
    if (!bvh)
        return;
    RT_FREE(bvh->memory);
    RT_FREE(bvh->triangles_before);
    memset(bvh, 0, sizeof *bvh);
}

/* Get memory for nodes and rows, just enough, with nodes at whole cache lines. */
static inline bool rt__make_room(rt_bvh *bvh, int nodes, int rows)
{
    const size_t line = 64;
    bvh->memory = RT_MALLOC((size_t)nodes * sizeof *bvh->nodes +
                            (size_t)rows * sizeof *bvh->rows + line);
    if (!bvh->memory)
        return false;
    char *start = (char *)bvh->memory;
    start += line - (uintptr_t)start % line;
    bvh->nodes = (rt_bvh_node *)(void *)start;
    bvh->rows = (rt_bvh_row *)(void *)(bvh->nodes + nodes);
    bvh->node_count = nodes;
    bvh->row_count = rows;
    return true;
}

#if RT__LANES > 1
static bool rt__search_alone(const rt_scene *scene, const rt_ray *ray, float t_max,
                             rt_hit *hit); /* the last section */
#endif

/* List the shapes, kind by kind, and make a group of each kind. */
static inline void rt__set_groups(const rt__builder *b, int count)
{
    const rt_scene *scene = b->scene;
    const int spheres = scene->sphere_count, boxes = scene->box_count;
    const int custom = scene->custom_shape_count, others = spheres + boxes;
    const int counts[RT__KINDS] = {spheres, boxes + custom, count - others - custom};
    rt__group *groups = b->branches[0].groups;
    memset(groups, 0, sizeof b->branches[0].groups);
    for (int i = 0; i < count; i++) {
        const int number = i < others            ? i
                           : i < others + custom ? count - custom + i - others
                                                 : i - custom;
        b->entries[i].number = number;
        b->entries[i].bounds = rt__shape_bounds(scene, number);
    }
    for (int kind = 0, first = 0, k = 0; kind < RT__KINDS; first += counts[kind++])
        if (counts[kind] > 0)
            groups[k++] = rt__group_of(b->entries, first, counts[kind]);
}

/* Build the tree of a valid scene with so many threads. */
static inline bool rt__build(const rt__builder *b, int count, int threads)
{
    rt__set_groups(b, count);
    (void)threads;
#ifdef RT__TASKS
#pragma omp parallel num_threads(threads) if (count > RT__SHARED && threads > 1)
#pragma omp single
#endif
    rt__build_branch(b, 0, 0);
    const rt__branch *all = &b->branches[0];
    if (all->rows > INT_MAX / 4 || !rt__make_room(b->bvh, all->nodes, (int)all->rows))
        return false;
#ifdef RT__TASKS
#pragma omp parallel num_threads(threads) if (count > RT__SHARED && threads > 1)
#pragma omp single
#endif
    rt__set_node(b, 0, 0, 0);
    return true;
}

/* Count the triangles before those of each mesh. For a few meshes a loop is as quick. */
static inline bool rt__count_before(rt_bvh *bvh, const rt_scene *scene)
{
    const int count = bvh->mesh_count = scene->mesh_count;
    if (count <= 8)
        return true;
    int *before = (int *)RT_MALLOC(((size_t)count + 1) * sizeof *before);
    bvh->triangles_before = before;
    if (!before)
        return false;
    before[0] = 0;
    for (int i = 0; i < count; i++)
        before[i + 1] = before[i] + scene->meshes[i].triangle_count;
    return true;
}

static inline rt_status rt__build_bvh(const rt_scene *scene, int threads, rt_bvh *bvh)
{
    if (!scene || !bvh)
        return RT_BAD_POINTER;
    memset(bvh, 0, sizeof *bvh);
    const int count = rt__primitive_count(scene);
    if (count == INT_MAX)
        return RT_NO_MEMORY; /* their numbers would not be ints */
    rt_scene shapes = *scene;
    shapes.bvh = NULL;
    const rt_status status = rt_check_scene(&shapes, NULL);
    if (status != RT_OK)
        return status;
    if (!rt__count_before(bvh, scene)) {
        rt_free_bvh(bvh);
        return RT_NO_MEMORY;
    }
    shapes.bvh = bvh;
    const size_t n = (size_t)count + 1, branches = (size_t)rt__most_nodes(count) + 1;
    if (n > SIZE_MAX / 512) /* meshes may share arrays: maybe more than fits 32 bits */
        return RT_NO_MEMORY;
    rt__builder b;
    b.scene = &shapes;
    b.bvh = bvh;
    b.entries = (rt__entry *)RT_MALLOC(n * sizeof *b.entries);
    b.branches = (rt__branch *)RT_MALLOC(branches * sizeof *b.branches);
    const bool good = b.entries && b.branches && rt__build(&b, count, threads);
    RT_FREE(b.entries);
    RT_FREE(b.branches);
    if (!good) {
        rt_free_bvh(bvh);
        return RT_NO_MEMORY;
    }
    bvh->sphere_count = scene->sphere_count;
    bvh->box_count = scene->box_count;
    bvh->triangle_count = rt__triangle_count(scene);
    bvh->custom_shape_count = scene->custom_shape_count;
#if RT__LANES > 1
    if (rt_lane_count(0) > 1)
        bvh->search = rt__search_alone;
#endif
    return RT_OK;
}

RTDEF rt_status rt_build_bvh(const rt_scene *scene, rt_bvh *bvh)
{
    return rt__build_bvh(scene, rt_thread_count(0), bvh);
}

/* ---- the loop over samples and pixels -------------------------------------------- */

typedef struct rt__job rt__job;
typedef struct rt__table rt__table; /* see the last section */

/* Trace sample number sample of the pixels first to last - 1 into values and, unless
 * NULL, guides. Returns how many rays it took. */
typedef uint64_t rt__step(const rt__job *job, int sample, int first, int last,
                          rt_watch *watch, rt_vec3 *values, rt_guide *guides);

struct rt__job {
    rt__step *step;
    int together; /* it takes so many pixels at a time */
    int ticks;    /* so many ticks may pass between two looks at the clock */
    rt_image *image;
    rt_options options;
    rt_pixel_function *pixel; /* rt__step_pixels calls it with context */
    const void *context;
    const rt_scene *scene; /* what rt_render is about */
    const rt_camera *camera;
    rt__film film;
    const rt__table *table; /* for packets, if the shapes are few */
};

/* The random numbers that a sample takes: those of (the result, *seed). */
static inline uint32_t rt__sequence(const rt__job *job, int sample, uint32_t *seed)
{
    *seed = job->options.seed;
    if (job->options.sampler == RT_RANDOM || !job->image->half)
        return (uint32_t)sample;
    *seed ^= (uint32_t)sample << 31; /* two sequences in turn: see rt_image_error */
    return (uint32_t)sample >> 1;
}

/* The mean of n+1 values is the mean of n plus 1/(n+1) of the difference. So the image is
 * a picture after every sample, and the order of the sums is always the same. *rest,
 * unless NULL, is what rounding took from *mean; it goes back in. */
static inline void rt__add_to_mean(rt_vec3 *mean, rt_vec3 *rest, int n, rt_vec3 value)
{
    const rt_vec3 nothing = rt_vec(0.0f, 0.0f, 0.0f);
    if (n == 0) {
        *mean = value;
        if (rest)
            *rest = nothing;
        return;
    }
    const rt_dvec3 old =
        rt_dmad(rt_to_double(*mean), 1.0, rt_to_double(rest ? *rest : nothing));
    const rt_dvec3 sum =
        rt_dmad(old, 1.0 / ((double)n + 1.0), rt_dsub(rt_to_double(value), old));
    *mean = rt_to_float(sum);
    if (rest)
        *rest = rt_to_float(rt_dsub(sum, rt_to_double(*mean)));
}

/* How many pixels the image has memory for. */
static inline int rt__pixel_count(const rt_image *image)
{
    return image->count > 0 ? image->count : image->width * image->height;
}

static inline void rt__record(rt_image *image, int sample, int i, rt_vec3 value)
{
    rt_vec3 *rest = image->rest;
    rt__add_to_mean(&image->pixels[i], rest ? rest + i : NULL, sample, value);
    if (!image->half || sample % 2 != 0)
        return;
    rest = rest ? rest + (size_t)rt__pixel_count(image) + i : NULL;
    rt__add_to_mean(&image->half[i], rest, sample / 2, value);
}

static inline void rt__record_guide(rt_image *image, int sample, int i, rt_guide value)
{
    rt_guide *guide = &image->guides[i];
    rt__add_to_mean(&guide->normal, NULL, sample, value.normal);
    rt__add_to_mean(&guide->point, NULL, sample, value.point);
    rt__add_to_mean(&guide->albedo, NULL, sample, value.albedo);
    rt__add_to_mean(&guide->direct, NULL, sample, value.direct);
    if (sample % 2 == 0)
        rt__add_to_mean(&guide->half, NULL, sample / 2, value.direct);
}

/* A random point of pixel number i, and the colour there. */
static inline rt_vec3 rt__look(const rt__job *job, int i, rt_rng *rng)
{
    const int width = job->image->width, column = i % width, row = i / width;
    const float dx = rt_random(rng);
    const float dy = rt_random(rng);
    return job->pixel(job->context, (float)column + dx, (float)row + dy, rng);
}

/* The random numbers of a sample of pixel number i. */
static inline rt_rng rt__start(const rt__job *job, int sample, int i)
{
    uint32_t seed;
    const uint32_t index = rt__sequence(job, sample, &seed);
    return job->options.sampler == RT_RANDOM ? rt_rng_start((uint32_t)i, index, seed)
                                             : rt_sobol_start((uint32_t)i, index, seed);
}

static inline rt_ray rt__ray(const rt__job *job, float x, float y)
{
#ifdef rt_camera_ray /* yours knows nothing of films */
    return rt_camera_ray(job->camera, job->image->width, job->image->height, x, y);
#else
    return rt__film_ray(&job->film, x, y);
#endif
}

/* The ray through a point of the film; with a lens, through a random point of it. */
static inline rt_ray rt__random_ray(const rt__job *job, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt__ray(job, x, y);
    const rt_lens *lens = &job->options.lens;
    if (!(lens->radius > 0.0f))
        return ray;
    const float r1 = rt_random(rng);
    const float r2 = rt_random(rng);
#ifdef rt_lens_ray
    return rt_lens_ray(job->camera, lens, &ray, r1, r2);
#else
    return rt__film_lens_ray(&job->film, lens, &ray, r1, r2);
#endif
}

/* Does light need more than part one to find its way? */
static inline bool rt__is_part_two(const rt_scene *scene)
{
    return scene->surfaces || scene->lamp_count > 0 || scene->sky;
}

static inline rt_vec3 rt__pixel(const void *context, float x, float y, rt_rng *rng)
{
    const rt__job *job = (const rt__job *)context;
    const rt_ray ray = rt__random_ray(job, x, y, rng);
    const int bounces = job->options.bounces;
    return rt__is_part_two(job->scene) ? rt_radiance_mis(job->scene, &ray, bounces, rng)
                                       : rt_radiance(job->scene, &ray, bounces, rng);
}

/* The first look of the sample that has these random numbers. */
static inline rt_guide rt__guide(const rt__job *job, int i, rt_rng rng)
{
    const int width = job->image->width, column = i % width, row = i / width;
    const float dx = rt_random(&rng);
    const float dy = rt_random(&rng);
    const rt_ray ray = rt__random_ray(job, (float)column + dx, (float)row + dy, &rng);
    const int bounces = job->options.bounces;
    return rt__is_part_two(job->scene)
               ? rt__first_look_mis(job->scene, &ray, bounces, &rng)
               : rt_first_look(job->scene, &ray, bounces, &rng);
}

static inline uint64_t rt__step_pixels(const rt__job *job, int sample, int first,
                                       int last, rt_watch *watch, rt_vec3 *values,
                                       rt_guide *guides)
{
    uint64_t rays = 0;
    for (int i = first; i < last; i++) {
        rt_rng rng = rt__start(job, sample, i);
        rng.watch = watch;
        if (guides)
            guides[i - first] = rt__guide(job, i, rng);
        values[i - first] = rt__look(job, i, &rng);
        rays += rng.rays;
        rt__tick(watch);
    }
    return rays;
}

RTDEF float rt_image_error(const rt_image *image)
{
    if (!image || !image->pixels || !image->half || image->samples < 2)
        return INFINITY;
    const int count = rt__pixel_count(image);
    double squares = 0.0, sum = 0.0;
    for (int i = 0; i < count; i++) {
        const rt_dvec3 mean = rt_to_double(image->pixels[i]);
        const rt_dvec3 d = rt_dsub(rt_to_double(image->half[i]), mean);
        squares += rt_ddot(d, d);
        sum += mean.x + mean.y + mean.z;
    }
    const int odd = image->samples / 2, even = image->samples - odd;
    const double noise = sqrt(squares * even / odd / (3.0 * count));
    return sum > 0.0 ? (float)(noise / (sum / (3.0 * count))) : 0.0f;
}

/* Seconds since some moment. */
static inline double rt__seconds(void)
{
#ifdef _OPENMP
    return omp_get_wtime();
#elif defined(TIME_UTC) /* C11, C++17 */
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
#else
    return (double)clock() / (double)CLOCKS_PER_SEC;
#endif
}

static inline rt_status rt__check_image(const rt_image *image)
{
    if (!image || !image->pixels)
        return RT_BAD_POINTER;
    if (image->width < 1 || image->height < 1 || image->width > INT_MAX / image->height)
        return RT_BAD_SIZE;
    const int all = image->width * image->height;
    if (image->first < 0 || image->count < 0 || image->count > all - image->first ||
        (image->count == 0 && image->first > 0) || image->done < 0 ||
        image->done >= rt__pixel_count(image))
        return RT_BAD_SIZE;
    return RT_OK;
}

static inline rt_status rt__check_job(const rt_image *image, const rt_options *o)
{
    const rt_status status = rt__check_image(image);
    if (status != RT_OK)
        return status;
    if (o->samples < 0 || image->samples < 0 ||
        (o->samples == 0 ? 16 : o->samples) > INT_MAX - image->samples)
        return RT_BAD_SAMPLES;
    if (o->threads < 0 || o->threads > 1024)
        return RT_BAD_THREADS;
    if (o->sampler != RT_SOBOL && o->sampler != RT_RANDOM)
        return RT_BAD_SAMPLER;
    if (!(o->error >= 0.0f) || (o->error > 0.0f && (!image->half || image->count > 0)))
        return RT_BAD_ERROR;
    if (!(o->seconds >= 0.0f) || (o->seconds > 0.0f && image->count > 0))
        return RT_BAD_SECONDS;
    return RT_OK;
}

/* A lock that one thread at a time can hold; without OpenMP there is only one. */
#ifdef _OPENMP
typedef omp_lock_t rt__mutex;
#define rt__init_lock(mutex) omp_init_lock(mutex)
#define rt__lock(mutex) omp_set_lock(mutex)
#define rt__unlock(mutex) omp_unset_lock(mutex)
#define rt__destroy_lock(mutex) omp_destroy_lock(mutex)
#else
typedef char rt__mutex;
#define rt__init_lock(mutex) (void)(mutex)
#define rt__lock(mutex) (void)(mutex)
#define rt__unlock(mutex) (void)(mutex)
#define rt__destroy_lock(mutex) (void)(mutex)
#endif

/* A task: pixels with neighbouring numbers, and some samples of each. A thread finishes
 * it before it asks for more. */
enum { RT__CHUNK = 128 };
typedef struct rt__task {
    int chunk;    /* which pixels */
    int from, to; /* samples number from, from + 1 ... to - 1 */
} rt__task;

/* What the threads share. */
typedef struct rt__team {
    rt_watch watch; /* of the calling thread; first, so its address is the team's */
    const rt__job *job;
    int threads, chunk, chunks;    /* there are so many chunks of so many pixels */
    rt__mutex *writing;            /* each thread locks its own while it writes pixels */
    double start, asked, interval; /* progress was last asked then; again after so long */
    double looked;                 /* at the clock */
    double begun, wanted;          /* samples that the image had, and is to have */
    int first_sample, first_pixel; /* the first that the image lacks */
    int end;                       /* tasks go up to this sample, not included */
    float part_of_error;

    rt__mutex queue; /* lock it to read or write what follows */
    rt__task last;   /* the last task that was given out */
    int *recorded;   /* how many samples each chunk has in the image */
    double since;    /* when the samples of this task were begun */
    bool asked_once, cancelled, time_over;
} rt__team;

/* The next task, if there is one; *task was the thread's previous one, and took so many
 * rays. Tasks are given out in order, and each one given out is finished. So when a
 * picture is stopped, all pixels up to some number have one sample more than the others.
 * A task is one sample of its pixels. In small pictures it is several, lest it be too
 * short; then all pixels get them before anything stops. */
static inline bool rt__next_task(rt__team *team, rt__task *task, uint64_t rays)
{
    rt__task *last = &team->last;
    rt__lock(&team->queue);
    team->job->image->rays += rays;
    if (task->to > task->from)
        team->recorded[task->chunk] = task->to;
    const bool all = last->chunk == team->chunks - 1; /* all of them given out? */
    const bool over = team->time_over && (last->from > 0 || (all && last->to > 0));
    const bool may_stop = all || last->to - last->from == 1;
    const bool stop = (team->cancelled || over) && may_stop;
    const bool more = !stop && (!all || last->to < team->end);
    if (more && all) {
        const double now = rt__seconds(), seconds = now - team->since;
        int samples = last->to - last->from;
        samples = seconds < 0.0025 && samples < INT_MAX / 2 ? 2 * samples
                  : seconds > 0.05 && samples > 1           ? samples / 2
                                                            : samples;
        team->since = now;
        last->from = last->to;
        last->to += samples < team->end - last->to ? samples : team->end - last->to;
        last->chunk = -1;
    }
    if (more) {
        last->chunk++;
        *task = *last;
    }
    rt__unlock(&team->queue);
    return more;
}

/* May a thread record the task that it has traced? Yes, once all earlier samples are
 * recorded and progress was asked for the first time, so that a picture can be stopped
 * before much is done. */
static inline bool rt__may_record(rt__team *team, const rt__task *task, int thread)
{
    rt__lock(&team->queue);
    const bool may =
        team->recorded[task->chunk] == task->from && (thread == 0 || team->asked_once);
    rt__unlock(&team->queue);
    return may;
}

/* Set samples and done of the image: what all chunks have, and how many pixels at the
 * beginning have one more. Returns whether all tasks that were given out are recorded. */
static inline bool rt__count_samples(rt__team *team)
{
    rt_image *image = team->job->image;
    rt__lock(&team->queue);
    int least = INT_MAX, ahead = 0;
    for (int k = 0; k < team->chunks; k++)
        least = team->recorded[k] < least ? team->recorded[k] : least;
    while (ahead < team->chunks && team->recorded[ahead] > least)
        ahead++;
    bool all = true;
    for (int k = 0; k < team->chunks && all; k++)
        all = team->recorded[k] ==
              (k <= team->last.chunk ? team->last.to : team->last.from);
    image->samples = least;
    image->done = ahead * team->chunk;
    if (least == team->first_sample && image->done < team->first_pixel)
        image->done = team->first_pixel;
    rt__unlock(&team->queue);
    return all;
}

/* How much of what rt_render was called for is done, 0 to 1. */
static inline float rt__part(rt__team *team, double now)
{
    const double limit = (double)team->job->options.seconds;
    rt__lock(&team->queue);
    const rt__task *last = &team->last;
    const double samples =
        last->from + (last->to - last->from) * (last->chunk + 0.5) / team->chunks;
    rt__unlock(&team->queue);
    double part = (samples - team->begun) / team->wanted;
    part = part > (double)team->part_of_error ? part : (double)team->part_of_error;
    if (limit > 0.0 && (now - team->start) / limit > part)
        part = (now - team->start) / limit;
    return part < 0.0 ? 0.0f : part < 1.0 ? (float)part : 1.0f;
}

/* Now and then the thread that called rt_render looks up from its work. Is time up, and
 * is it time to ask progress? While progress reads the image, this thread holds the locks
 * of all others. They go on tracing, and wait only when they want to write: nobody waits
 * for the slowest before the very end. */
static inline void rt__look_up(rt_watch *watch)
{
    rt__team *team = (rt__team *)watch;
    const rt_options *o = &team->job->options;
    const double now = rt__seconds();
    const bool over = o->seconds > 0.0f && now - team->start >= (double)o->seconds;
    bool go_on = true;
    /* less often while rays are fast: some clocks are slow */
    watch->ticks = team->job->ticks * (now - team->looked < 1e-4 ? 16 : 1);
    team->looked = now;
    if (o->progress && !team->cancelled && now - team->asked >= team->interval) {
        for (int k = 1; k < team->threads; k++)
            rt__lock(&team->writing[k]);
        rt__count_samples(team);
        go_on = o->progress(o->user, rt__part(team, now));
        for (int k = 1; k < team->threads; k++)
            rt__unlock(&team->writing[k]);
        rt__lock(&team->queue);
        team->asked_once = true;
        rt__unlock(&team->queue);
        team->asked = rt__seconds();
        team->interval = team->interval < 0.0075 ? 2.0 * team->interval + 5e-5 : 0.015;
    }
    if (over || !go_on) {
        rt__lock(&team->queue);
        team->time_over = team->time_over || over;
        team->cancelled = team->cancelled || !go_on;
        rt__unlock(&team->queue);
    }
}

/* The work of one thread, from its first task to its last. */
static inline void rt__work(rt__team *team, int thread)
{
    const rt__job *job = team->job;
    rt_image *image = job->image;
    const int count = rt__pixel_count(image);
    const bool looks_up = job->options.progress || job->options.seconds > 0.0f;
    rt_watch *watch = thread == 0 && looks_up ? &team->watch : NULL;
    rt_vec3 values[RT__CHUNK];
    rt_guide guides[RT__CHUNK];
    rt_guide *const wanted = image->guides && job->scene ? guides : NULL;
    uint64_t rays = 0;
    rt__task task;
    task.chunk = task.from = task.to = 0;
    while (rt__next_task(team, &task, rays)) {
        int first = task.chunk * team->chunk;
        const int last = count - first > team->chunk ? first + team->chunk : count;
        if (task.from == team->first_sample && first < team->first_pixel)
            first = team->first_pixel;
        rays = 0;
        for (int sample = task.from; sample < task.to; sample++) {
            rays += job->step(job, sample, image->first + first, image->first + last,
                              watch, values, wanted);
            while (sample == task.from && !rt__may_record(team, &task, thread))
                rt__tick(watch);
            rt__lock(&team->writing[thread]);
            for (int i = first; i < last; i++)
                rt__record(image, sample, i, values[i - first]);
            for (int i = first; wanted && i < last; i++)
                rt__record_guide(image, sample, i, wanted[i - first]);
            rt__unlock(&team->writing[thread]);
        }
        if (watch)
            watch->look(watch);
    }
    if (watch)
        while (!rt__count_samples(team)) /* the others have not finished theirs */
            watch->look(watch);
}

/* Packets compute what some of their lanes do not need, and divide by zero there. A
 * program that traps its own exceptions must not stop for these, nor see their flags. */
static inline void rt__work_quietly(rt__team *team, int thread)
{
#if RT__LANES > 1
    if (team->job->together > 1) {
        fenv_t environment;
        feholdexcept(&environment);
        rt__work(team, thread);
        fesetenv(&environment);
        return;
    }
#endif
    rt__work(team, thread);
}

/* Give out tasks up to the sample team->end and wait until they are done. */
static inline void rt__work_together(rt__team *team)
{
    rt_image *image = team->job->image;
    team->first_sample = image->samples;
    team->first_pixel = image->done;
    team->last.chunk = image->done / team->chunk - 1;
    team->last.from = image->samples;
    team->last.to = image->samples + 1;
    for (int k = 0; k < team->chunks; k++)
        team->recorded[k] = image->samples + (k <= team->last.chunk ? 1 : 0);
#ifdef _OPENMP
#pragma omp parallel num_threads(team->threads)
    rt__work_quietly(team, omp_get_thread_num());
#else
    rt__work_quietly(team, 0);
#endif
    rt__count_samples(team);
}

/* Means of more samples than this in one call keep their rest, see rt_image. */
enum { RT__MANY = 4096 };

/* Take all samples. The error is checked whenever their number has grown by an eighth,
 * and is even; for that the threads have to meet. */
static inline void rt__run_team(rt__team *team, int target)
{
    const rt_options *o = &team->job->options;
    rt_image *image = team->job->image;
    int64_t look = (image->samples + (int64_t)17) / 2 * 2;
    while (image->samples < target && team->part_of_error < 1.0f && !team->cancelled &&
           !(team->time_over && image->samples > 0)) {
        team->end = o->error > 0.0f && look < target ? (int)look : target;
        rt__work_together(team);
        if (o->error > 0.0f && image->done == 0 && image->samples == look) {
            const float error = rt_image_error(image);
            const float part = error > o->error ? o->error / error : 1.0f;
            team->part_of_error = part * part;
            look += 2 * (look / 16 + 1);
        }
    }
}

/* A chunk takes a thousand rays or so, and each thread gets several, if possible. */
static inline void rt__share_out(rt__team *team, int count)
{
    const rt__job *job = team->job;
    const int bounces = job->options.bounces, each = count / (4 * team->threads);
    int pixels = bounces < 1024 ? 1024 / (bounces + 1) : 1;
    pixels = pixels < RT__CHUNK ? pixels : RT__CHUNK;
    pixels = pixels < each ? pixels : each;
    pixels = pixels > job->together ? pixels : job->together;
    team->chunk = pixels - pixels % job->together; /* whole packets */
    team->chunks = (count - 1) / team->chunk + 1;
    team->threads = team->chunks < team->threads ? team->chunks : team->threads;
}

static inline rt_status rt__run(const rt__job *job)
{
    const rt_options *o = &job->options;
    rt_image *image = job->image;
    const int count = rt__pixel_count(image);
    const size_t vectors = (size_t)count * (image->half ? 2 : 1);
    int samples = o->samples;
    if (samples == 0)
        samples = o->error > 0.0f || o->seconds > 0.0f ? INT_MAX - image->samples : 16;
    const int target = image->samples + samples;

    rt__team team;
    memset(&team, 0, sizeof team);
    team.watch.look = rt__look_up;
    team.watch.ticks = job->ticks;
    team.job = job;
    team.threads = rt_thread_count(o->threads);
    team.begun = image->samples + (double)image->done / count;
    team.wanted = samples;
    team.asked_once = !o->progress;
    team.start = team.since = rt__seconds();
    rt__share_out(&team, count);

    team.recorded = (int *)RT_MALLOC((size_t)team.chunks * sizeof *team.recorded);
    team.writing = (rt__mutex *)RT_MALLOC((size_t)team.threads * sizeof *team.writing);
    const bool borrow = !image->rest && samples > RT__MANY;
    if (borrow)
        image->rest = (rt_vec3 *)RT_MALLOC(vectors * sizeof *image->rest);
    const bool good = team.recorded && team.writing && (image->rest || !borrow);
    if (good) {
        if (borrow)
            memset(image->rest, 0, vectors * sizeof *image->rest);
        rt__init_lock(&team.queue);
        for (int k = 0; k < team.threads; k++)
            rt__init_lock(&team.writing[k]);
        rt__run_team(&team, target);
        for (int k = 0; k < team.threads; k++)
            rt__destroy_lock(&team.writing[k]);
        rt__destroy_lock(&team.queue);
    }
    RT_FREE(team.recorded);
    RT_FREE(team.writing);
    if (borrow) {
        RT_FREE(image->rest);
        image->rest = NULL;
    }
    if (!good)
        return RT_NO_MEMORY;
    if (image->samples < target && team.cancelled && team.part_of_error < 1.0f)
        return RT_CANCELLED;
    if (o->progress)
        o->progress(o->user, 1.0f);
    return RT_OK;
}

RTDEF rt_status rt_render_pixels(rt_pixel_function *pixel, const void *context,
                                 const rt_options *options, rt_image *image)
{
    rt__job job;
    memset(&job, 0, sizeof job);
    if (!pixel)
        return RT_BAD_POINTER;
    if (options)
        job.options = *options;
    const rt_status status = rt__check_job(image, &job.options);
    if (status != RT_OK)
        return status;
    job.step = rt__step_pixels;
    job.together = job.ticks = 1;
    job.image = image;
    job.pixel = pixel;
    job.context = context;
    return rt__run(&job);
}

RTDEF int rt_lane_count(int wanted)
{
#if RT__LANES > 1
    bool good = wanted <= 0 || wanted >= RT__LANES;
#if defined(RT__X86) && RT__LANES == 8
    good = good && __builtin_cpu_supports("avx2") && __builtin_cpu_supports("fma");
#endif
    return good ? RT__LANES : 1;
#else
    (void)wanted;
    return 1;
#endif
}

/* What rt_render and rt_trace_pixel have in common. */
static inline rt_status rt__set_job(rt__job *job, const rt_scene *scene,
                                    const rt_camera *camera, const rt_options *options,
                                    rt_image *image)
{
    memset(job, 0, sizeof *job);
    if (!scene || !camera || !image)
        return RT_BAD_POINTER;
    const rt_status status = rt_check_scene(scene, NULL);
    if (status != RT_OK)
        return status;
    if (rt_check_camera(camera) != RT_OK)
        return RT_BAD_CAMERA;
    if (options)
        job->options = *options;
    if (job->options.bounces < 0)
        return RT_BAD_BOUNCES;
    if (job->options.lanes != 0 &&
        job->options.lanes != rt_lane_count(job->options.lanes))
        return RT_BAD_LANES;
    const rt_lens *lens = &job->options.lens;
    if (!(lens->radius >= 0.0f && lens->radius <= RT__LARGEST &&
          (lens->radius == 0.0f || (lens->focus > 0.0f && lens->focus <= RT__LARGEST))))
        return RT_BAD_LENS;
    job->image = image;
    job->scene = scene;
    job->camera = camera;
    job->film = rt__film_of(camera, image->width, image->height);
    job->step = rt__step_pixels;
    job->together = 1;
    job->ticks = 16; /* rays through a tree may take a millisecond each */
    job->pixel = rt__pixel;
    job->context = job;
    return rt__check_job(image, &job->options);
}

RTDEF rt_status rt_trace_pixel(const rt_scene *scene, const rt_camera *camera,
                               const rt_options *options, const rt_image *image, int x,
                               int y, int sample, rt_path *path)
{
    rt__job job;
    rt_image copy; /* so that *image can be const */
    if (!image || !path || (path->max_vertices > 0 && !path->vertices) ||
        (path->max_shadows > 0 && !path->shadows))
        return RT_BAD_POINTER;
    copy = *image;
    copy.first = copy.count = 0; /* any pixel of the picture */
    const rt_status status = rt__set_job(&job, scene, camera, options, &copy);
    if (status != RT_OK)
        return status;
    if (x < 0 || x >= image->width || y < 0 || y >= image->height || sample < 0)
        return RT_BAD_PIXEL;
    rt_scene watched = *scene;
    rt_bvh watch;
    memset(&watch, 0, sizeof watch);
    watch.path = path;
    watched.bvh = &watch;
    job.scene = &watched;
    path->scene = scene;
    path->bounces = job.options.bounces;
    path->told = rt__is_part_two(scene);
    path->vertex_count = path->shadow_count = 0;
    rt_rng rng = rt__start(&job, sample, y * image->width + x);
    path->value = rt__look(&job, y * image->width + x, &rng);
    path->rays = rng.rays;
    path->scene = NULL;
    return RT_OK;
}

/* ---- finishing a picture: chapter 10, sixteen pixels at a time ------------------- */

/* All pixels take the same steps, row by row. The loops over the 16 pixels of a block
 * contain no if, so that a compiler can do several pixels at once. */
enum { RT__BLOCK = 16, RT__PASSES = 4, RT__MARGIN = 2 << (RT__PASSES - 1) };

/* Which samples of the image? */
typedef enum rt__samples { RT__ALL, RT__EVEN, RT__ODD } rt__samples;

/* Planes with a number for each pixel. All rows have margins, where the numbers are 0. */
typedef struct rt__finish {
    const rt_image *image;
    rt__samples part;
    rt_vec3 *result;
    int width, height, stride;
    int pass;     /* of the smoothing */
    float *known; /* 1; 0: in the margin, no surface, or no number */
    float *normal[3], *point[3], *albedo[3];
    float *indirect[3], *noise;       /* the noisy image without direct light */
    float *light[2][3], *variance[2]; /* per unit of albedo, this pass and the last */
} rt__finish;

enum { RT__PLANES = 1 + 3 * 3 + 3 + 1 + 2 * 3 + 2 };

static inline int rt__at_row(const rt__finish *f, int y)
{
    return y * f->stride + RT__MARGIN;
}

RT__INLINE rt_vec3 rt__get(float *const *planes, int i)
{
    return rt_vec(planes[0][i], planes[1][i], planes[2][i]);
}

RT__INLINE void rt__set(float *const *planes, int i, rt_vec3 v)
{
    planes[0][i] = v.x;
    planes[1][i] = v.y;
    planes[2][i] = v.z;
}

RT__INLINE float rt__mean(rt_vec3 v)
{
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

static inline bool rt__is_moderate(rt_vec3 v)
{
    return fabsf(v.x) <= 1e15f && fabsf(v.y) <= 1e15f && fabsf(v.z) <= 1e15f;
}

/* Light per unit of albedo. A channel in which the surface reflects nothing does not show
 * it; there the mean of all channels is taken. */
static inline rt_vec3 rt__per_albedo(rt_vec3 light, rt_vec3 albedo)
{
    const float mean = rt__mean(light) / rt__mean(albedo);
    return rt_vec(albedo.x > 0.0f ? light.x / albedo.x : mean,
                  albedo.y > 0.0f ? light.y / albedo.y : mean,
                  albedo.z > 0.0f ? light.z / albedo.z : mean);
}

/* How many even samples there are for each odd one. */
static inline float rt__even_to_odd(const rt_image *image, int i)
{
    const int n = image->samples + (i < image->done), odds = n / 2;
    return (float)(n - odds) / (float)odds;
}

/* The mean over a part of the samples, from the mean of all and that of the even ones. */
static inline rt_vec3 rt__part_of(const rt_image *image, rt__samples part, int i,
                                  rt_vec3 all, rt_vec3 even)
{
    const float ratio = rt__even_to_odd(image, i);
    return part == RT__ALL    ? all
           : part == RT__EVEN ? even
                              : rt_add(all, rt_scale(rt_sub(all, even), ratio));
}

/* The standard deviation of that mean, if the means of even and all differ by 1. */
static inline float rt__spread(const rt_image *image, rt__samples part, int i)
{
    const float ratio = rt__even_to_odd(image, i);
    return sqrtf(part == RT__ALL    ? ratio
                 : part == RT__EVEN ? 1.0f + ratio
                                    : (1.0f + ratio) * ratio);
}

static inline void rt__load_row(const rt__finish *f, int y)
{
    const rt_image *image = f->image;
    const size_t stride = (size_t)f->stride, plane = stride * (size_t)f->height;
    for (size_t k = 0; k < RT__PLANES; k++)
        memset(f->known + k * plane + (size_t)y * stride, 0, stride * sizeof(float));
    for (int x = 0; x < f->width; x++) {
        const int from = y * f->width + x, i = rt__at_row(f, y) + x;
        const rt_guide *g = &image->guides[from];
        const rt_vec3 mean = image->pixels[from], half = image->half[from];
        if (!(rt__is_moderate(mean) && rt__is_moderate(half) &&
              rt__is_moderate(g->normal) && rt__is_moderate(g->point) &&
              rt__is_moderate(g->albedo) && rt__is_moderate(g->direct) &&
              rt__is_moderate(g->half) && rt__mean(g->albedo) > 0.0f))
            continue;
        const rt_vec3 all = rt_sub(mean, g->direct), even = rt_sub(half, g->half);
        const rt_vec3 indirect = rt__part_of(image, f->part, from, all, even);
        const rt_vec3 differ =
            rt_scale(rt_sub(even, all), rt__spread(image, f->part, from));
        const rt_vec3 light = rt__per_albedo(indirect, g->albedo);
        const float d = rt__mean(rt__per_albedo(differ, g->albedo));
        if (!rt__is_moderate(light) || !(fabsf(d) <= 1e15f))
            continue;
        f->known[i] = 1.0f;
        rt__set(f->normal, i, g->normal);
        rt__set(f->point, i, g->point);
        rt__set(f->albedo, i, g->albedo);
        rt__set(f->indirect, i, indirect);
        rt__set(f->light[0], i, light);
        f->noise[i] = rt_dot(differ, differ);
        f->variance[1][i] = d * d;
    }
}

/* The mean of a plane over the known ones of 7 x 7 pixels: a single pixel tells little
 * about its variance. */
RT__INLINE void rt__average_row(const rt__finish *f, int y, const float *from, float *to)
{
    for (int x = 0; x < f->width; x += RT__BLOCK) {
        const int i = rt__at_row(f, y) + x;
        float sum[RT__BLOCK] = {0.0f}, count[RT__BLOCK] = {0.0f};
        for (int dy = y < 3 ? -y : -3; dy <= 3 && y + dy < f->height; dy++)
            for (int dx = -3; dx <= 3; dx++) {
                const int j = i + dy * f->stride + dx;
                for (int k = 0; k < RT__BLOCK; k++) {
                    sum[k] += f->known[j + k] * from[j + k];
                    count[k] += f->known[j + k];
                }
            }
        for (int k = 0; k < RT__BLOCK; k++)
            to[i + k] = sum[k] / (count[k] + FLT_MIN);
    }
}

static inline void rt__variance_row(const rt__finish *f, int y)
{
    rt__average_row(f, y, f->variance[1], f->variance[0]);
}

/* One pass of the filter with holes: the weights 1 4 6 4 1 (/ 16) of a spline in x and y,
 * times each pixel's say. The variance of a mean with weights w is the sum of w^2 times
 * the variances, over the square of the sum of w. */
static inline void rt__smooth_row(const rt__finish *f, int y)
{
    static const float spline[5] = {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f};
    const int step = 1 << f->pass, from = f->pass & 1;
    float *const *light = f->light[from];
    const float *variance = f->variance[from];
    for (int x = 0; x < f->width; x += RT__BLOCK) {
        const int i = rt__at_row(f, y) + x;
        float red[RT__BLOCK] = {0.0f}, green[RT__BLOCK] = {0.0f},
              blue[RT__BLOCK] = {0.0f};
        float noise[RT__BLOCK] = {0.0f}, weights[RT__BLOCK] = {0.0f};
        for (int dy = -2; dy <= 2; dy++) {
            if (y + dy * step < 0 || y + dy * step >= f->height)
                continue;
            for (int dx = -2; dx <= 2; dx++) {
                const int to = (dy * f->stride + dx) * step;
                const float part = spline[dy + 2] * spline[dx + 2];
                for (int k = i; k < i + RT__BLOCK; k++) {
                    const rt_vec3 here = rt__get(light, k),
                                  there = rt__get(light, k + to);
                    const float differ =
                        rt__unlike(rt__get(f->normal, k), rt__get(f->point, k),
                                   rt__get(f->normal, k + to), rt__get(f->point, k + to));
                    const float w = part * f->known[k + to] *
                                    rt__say(differ, rt__mean(here), variance[k],
                                            rt__mean(there), variance[k + to]);
                    red[k - i] += w * there.x;
                    green[k - i] += w * there.y;
                    blue[k - i] += w * there.z;
                    noise[k - i] += w * w * variance[k + to];
                    weights[k - i] += w;
                }
            }
        }
        for (int k = 0; k < RT__BLOCK; k++) {
            const float w = 1.0f / (weights[k] + FLT_MIN);
            rt__set(f->light[!from], i + k,
                    rt_vec(red[k] * w, green[k] * w, blue[k] * w));
            f->variance[!from][i + k] = noise[k] * w * w;
        }
    }
}

/* From light per unit of albedo back to the light that arrives. */
static inline void rt__unload_row(const rt__finish *f, int y)
{
    const int first = rt__at_row(f, y);
    float *const *light = f->light[RT__PASSES & 1];
    for (int i = first; i < first + f->width; i++)
        rt__set(light, i, rt_mul(rt__get(light, i), rt__get(f->albedo, i)));
}

/* Pixels with a neighbour that is unlike them: take the mean of the pixel and the four
 * mixtures of opposite neighbours, each weighted by its guides. */
static inline void rt__edge_row(const rt__finish *f, int y)
{
    const int from = RT__PASSES & 1;
    float *const *light = f->light[from];
    const int opposite[4] = {1, f->stride, f->stride + 1, f->stride - 1};
    const bool inside = y > 0 && y < f->height - 1;
    for (int x = 0; x < f->width; x += RT__BLOCK) {
        const int i = rt__at_row(f, y) + x;
        float red[RT__BLOCK], green[RT__BLOCK], blue[RT__BLOCK];
        float weights[RT__BLOCK], most[RT__BLOCK];
        for (int k = 0; k < RT__BLOCK; k++) {
            red[k] = light[0][i + k];
            green[k] = light[1][i + k];
            blue[k] = light[2][i + k];
            weights[k] = 1.0f;
            most[k] = 0.0f;
        }
        for (int n = 0; n < (inside ? 4 : 1); n++)
            for (int k = i; k < i + RT__BLOCK; k++) {
                const int j = k + opposite[n], l = k - opposite[n];
                const rt_vec3 middle[3] = {rt__get(f->normal, k), rt__get(f->albedo, k),
                                           rt__get(f->point, k)};
                const rt_vec3 left[3] = {rt__get(f->normal, j), rt__get(f->albedo, j),
                                         rt__get(f->point, j)};
                const rt_vec3 right[3] = {rt__get(f->normal, l), rt__get(f->albedo, l),
                                          rt__get(f->point, l)};
                float off;
                const float t = rt__mixture(middle, left, right, &off);
                const float w = f->known[j] * f->known[l] / (400.0f * off * off + 1e-4f);
                red[k - i] += w * ((1.0f - t) * light[0][j] + t * light[0][l]);
                green[k - i] += w * ((1.0f - t) * light[1][j] + t * light[1][l]);
                blue[k - i] += w * ((1.0f - t) * light[2][j] + t * light[2][l]);
                weights[k - i] += w;
                const rt_vec3 a = rt_sub(middle[1], left[1]),
                              b = rt_sub(middle[1], right[1]);
                const float unlike_left =
                    f->known[j] * (rt__unlike(middle[0], middle[2], left[0], left[2]) +
                                   10.0f * rt_dot(a, a));
                const float unlike_right =
                    f->known[l] * (rt__unlike(middle[0], middle[2], right[0], right[2]) +
                                   10.0f * rt_dot(b, b));
                most[k - i] = most[k - i] > unlike_left ? most[k - i] : unlike_left;
                most[k - i] = most[k - i] > unlike_right ? most[k - i] : unlike_right;
            }
        for (int k = 0; k < RT__BLOCK; k++) {
            const bool edge = most[k] > 1.0f;
            const rt_vec3 own = rt__get(light, i + k);
            rt__set(f->light[!from], i + k,
                    rt_vec(edge ? red[k] / weights[k] : own.x,
                           edge ? green[k] / weights[k] : own.y,
                           edge ? blue[k] / weights[k] : own.z));
        }
    }
}

/* How far the outcome is from the noisy pixels, squared. */
static inline void rt__differ_row(const rt__finish *f, int y)
{
    const int first = rt__at_row(f, y);
    float *const *light = f->light[!(RT__PASSES & 1)];
    float *differ = f->variance[0];
    for (int i = first; i < first + f->width; i++) {
        const rt_vec3 d = rt_sub(rt__get(light, i), rt__get(f->indirect, i));
        differ[i] = rt_dot(d, d);
    }
}

/* Store the outcome, and as much of the noisy pixels as there is doubt. */
static inline void rt__store_row(const rt__finish *f, int y)
{
    const rt_image *image = f->image;
    float *const *light = f->light[!(RT__PASSES & 1)];
    float *differ = f->light[RT__PASSES & 1][0], *noise = f->light[RT__PASSES & 1][1];
    rt__average_row(f, y, f->variance[0], differ);
    rt__average_row(f, y, f->noise, noise);
    for (int x = 0; x < f->width; x++) {
        const int to = y * f->width + x, i = rt__at_row(f, y) + x;
        const rt_vec3 outcome = rt__get(light, i);
        const rt_vec3 back = rt_scale(rt_sub(rt__get(f->indirect, i), outcome),
                                      rt__doubt(differ[i], noise[i], image->samples));
        const rt_guide *g = &image->guides[to];
        f->result[to] =
            f->known[i] > 0.0f
                ? rt_add(rt__part_of(image, f->part, to, g->direct, g->half),
                         rt_add(outcome, back))
                : rt__part_of(image, f->part, to, image->pixels[to], image->half[to]);
    }
}

/* One step for all rows. Threads share the rows and meet at the end. */
typedef void rt__row_step(const rt__finish *f, int y);

static inline void rt__all_rows(const rt__finish *f, int threads, rt__row_step *step)
{
    (void)threads;
#ifdef _OPENMP
#pragma omp parallel for num_threads(threads)
#endif
    for (int y = 0; y < f->height; y++)
        step(f, y);
}

static inline rt_status rt__check_finish(const rt_image *image, int threads)
{
    const rt_status status = rt__check_image(image);
    if (status != RT_OK)
        return status;
    if (image->count > 0) /* a part lacks neighbours of its pixels */
        return RT_BAD_SIZE;
    if (!image->half || !image->guides)
        return RT_BAD_GUIDES;
    if (image->samples < 2)
        return RT_BAD_SAMPLES;
    return threads < 0 || threads > 1024 ? RT_BAD_THREADS : RT_OK;
}

/* Finish a part of the image into result, width * height vectors. */
static inline rt_status rt__finish_part(const rt_image *image, rt__samples part,
                                        int threads, rt_vec3 *result)
{
    rt__finish f;
    memset(&f, 0, sizeof f);
    if (image->width > INT_MAX - 3 * RT__MARGIN)
        return RT_NO_MEMORY; /* positions would not be ints */
    f.image = image;
    f.part = part;
    f.result = result;
    f.width = image->width;
    f.height = image->height;
    f.stride = (f.width - 1) / RT__BLOCK * RT__BLOCK + RT__BLOCK + 2 * RT__MARGIN;
    const size_t plane = (size_t)f.stride * (size_t)f.height;
    float *next = NULL;
    if (f.stride <= INT_MAX / f.height && plane <= SIZE_MAX / (RT__PLANES * sizeof *next))
        next = (float *)RT_MALLOC(RT__PLANES * plane * sizeof *next);
    if (!next)
        return RT_NO_MEMORY;
    f.known = next;
    for (int k = 0; k < 3; k++) {
        f.normal[k] = next += plane;
        f.point[k] = next += plane;
        f.albedo[k] = next += plane;
        f.indirect[k] = next += plane;
        f.light[0][k] = next += plane;
        f.light[1][k] = next += plane;
    }
    f.noise = next += plane;
    f.variance[0] = next += plane;
    f.variance[1] = next + plane;
    threads = rt_thread_count(threads);
    rt__all_rows(&f, threads, rt__load_row);
    rt__all_rows(&f, threads, rt__variance_row);
    for (f.pass = 0; f.pass < RT__PASSES; f.pass++)
        rt__all_rows(&f, threads, rt__smooth_row);
    rt__all_rows(&f, threads, rt__unload_row);
    rt__all_rows(&f, threads, rt__edge_row);
    rt__all_rows(&f, threads, rt__differ_row);
    rt__all_rows(&f, threads, rt__store_row);
    RT_FREE(f.known);
    return RT_OK;
}

RTDEF rt_status rt_denoise(const rt_image *image, int threads, rt_image *result)
{
    if (!result || !result->pixels)
        return RT_BAD_POINTER;
    rt_status status = rt__check_finish(image, threads);
    if (status == RT_OK && (result->width != image->width ||
                            result->height != image->height || result->count > 0))
        status = RT_BAD_SIZE;
    if (status == RT_OK)
        status = rt__finish_part(image, RT__ALL, threads, result->pixels);
    if (status != RT_OK)
        return status;
    result->samples = image->samples;
    result->done = image->done;
    result->rays = image->rays;
    return RT_OK;
}

RTDEF float rt_denoised_error(const rt_image *image, int threads)
{
    if (rt__check_finish(image, threads) != RT_OK)
        return INFINITY;
    const size_t count = (size_t)image->width * (size_t)image->height;
    rt_vec3 *both = NULL;
    if (count <= SIZE_MAX / (2 * sizeof *both))
        both = (rt_vec3 *)RT_MALLOC(2 * count * sizeof *both);
    const bool good = both && rt__finish_part(image, RT__EVEN, threads, both) == RT_OK &&
                      rt__finish_part(image, RT__ODD, threads, both + count) == RT_OK;
    double squares = 0.0, sum = 0.0;
    for (size_t i = 0; good && i < count; i++) {
        const rt_dvec3 mean = rt_to_double(image->pixels[i]);
        const rt_dvec3 even = rt_to_double(image->half[i]);
        const rt_dvec3 odd = rt_to_double(
            rt__part_of(image, RT__ODD, (int)i, image->pixels[i], image->half[i]));
        const rt_dvec3 a = rt_dsub(rt_to_double(both[i]), odd);
        const rt_dvec3 b = rt_dsub(rt_to_double(both[count + i]), even);
        const rt_dvec3 noise = rt_dsub(even, odd);
        squares += 0.5 * (rt_ddot(a, a) + rt_ddot(b, b) - rt_ddot(noise, noise));
        sum += mean.x + mean.y + mean.z;
    }
    RT_FREE(both);
    if (!good)
        return INFINITY;
    const double error = sqrt((squares > 0.0 ? squares : 0.0) / (3.0 * (double)count));
    return sum > 0.0 ? (float)(error / (sum / (3.0 * (double)count))) : 0.0f;
}

/* ---- what packets of rays want to know of a scene -------------------------------- */

#if RT__LANES > 1
/* Up to so many shapes are asked one by one, without the tree; for more, the tree is
 * faster. A few meshes and custom shapes, which stay in the tree, are allowed besides. */
enum { RT__FEW = RT__LANES == 16 ? 480 : 50 * RT__LANES, RT__FEW_OTHERS = 16 };

typedef struct rt__column {
    float x[RT__FEW], y[RT__FEW], z[RT__FEW];
} rt__column;

/* The shapes of a scene, column by column, by their number in rt_hit; for meshes and
 * custom shapes the boxes around them, see rt__near_others. */
struct rt__table {
    bool few;                      /* if false, this is empty, and rays ask the tree */
    int spheres, count, all;       /* up to count are spheres and boxes */
    rt__column place, max, albedo; /* place is the center or min */
    float kind[RT__FEW];           /* see rt__hits */
    float radius[RT__FEW];         /* 0: a box */
    float power[RT__FEW];          /* |O|^2 - R^2, the power of the point (0,0,0) */
    float size[RT__FEW];           /* max(|O|, R), scaled by RT__DOUBT */
    float largest;                 /* of the sizes */
    float lights[RT__FEW];         /* the least |S - O|^2 - R^2 of all lights and lamps */
    float least_light;             /* of them */
    float eta[RT__FEW], shininess[RT__FEW]; /* part two, of the surfaces */
    rt__column absorption, emission;
    bool patterns, emits; /* has any a pattern, or emission? Even if not few */
};

#define RT__DOUBT 1.953125e-3f /* 2^-9, see rt__place */

/* A box around mesh or custom shape number i. */
static rt__bounds rt__around(const rt_scene *scene, int i)
{
    rt__bounds b = rt__no_bounds();
    if (i >= scene->mesh_count) {
        rt__loosen(&scene->custom_shapes[i - scene->mesh_count], &b.min, &b.max);
        return rt__with_margin(b);
    }
    const rt_mesh *mesh = &scene->meshes[i];
    for (int k = 0; k < mesh->position_count; k++) {
        b.min = rt__min(b.min, mesh->positions[k]);
        b.max = rt__max(b.max, mesh->positions[k]);
    }
    if (mesh->position_count == 0)
        b.min = b.max = rt_vec(0.0f, 0.0f, 0.0f);
    return rt__with_margin(b);
}

/* Are there few shapes, with numbers so moderate that their squares are good floats, and
 * no sphere so small that rt_leave's step leads to its other side? */
static bool rt__are_few(const rt_scene *scene, const rt_camera *camera,
                        const rt_lens *lens)
{
    const float most = 1e7f;
    const int64_t others = (int64_t)scene->mesh_count + scene->custom_shape_count;
    bool good = others <= RT__FEW_OTHERS &&
                (int64_t)scene->sphere_count + scene->box_count + others <= RT__FEW &&
                rt__within(camera->position, -most, most) && lens->radius <= most;
    for (int i = 0; good && i < scene->sphere_count; i++) {
        const rt_sphere *s = &scene->spheres[i];
        good = rt__within(s->center, -most, most) && s->radius <= most &&
               s->radius >= 1e-3f * (1.0f + rt_length(s->center) + s->radius);
    }
    for (int i = 0; good && i < scene->box_count; i++)
        good = rt__within(scene->boxes[i].min, -most, most) &&
               rt__within(scene->boxes[i].max, -most, most);
    for (int i = 0; good && i < (int)others; i++) {
        const rt__bounds b = rt__around(scene, i);
        good = rt__within(b.min, -most, most) && rt__within(b.max, -most, most);
    }
    for (int i = 0; good && i < scene->light_count; i++)
        good = rt__within(scene->lights[i].position, -most, most);
    for (int i = 0; good && i < scene->lamp_count; i++) {
        const rt_lamp *l = &scene->lamps[i];
        good = rt__within(l->center, -most, most) && rt__within(l->u, -most, most) &&
               rt__within(l->v, -most, most) && l->radius <= most;
    }
    return good;
}

/* All points of the lamp that rt_sample_lamp may choose are at least so far from O. The
 * points are rounded, by less than 2^-16 of the numbers that they are made of. */
static double rt__least_distance(const rt_lamp *lamp, rt_dvec3 o)
{
    const rt_dvec3 center = rt_to_double(lamp->center), way = rt_dsub(center, o);
    const rt_dvec3 u = rt_to_double(lamp->u), v = rt_to_double(lamp->v);
    const bool ball = lamp->radius > 0.0f;
    const double reach =
        ball ? (double)lamp->radius : sqrt(rt_ddot(u, u)) + sqrt(rt_ddot(v, v));
    const double off = ball ? 0.0 : fabs(rt_ddot(way, rt_dnormalize(rt_dcross(u, v))));
    const double nearest = sqrt(rt_ddot(way, way)) - reach;
    const double least = (nearest > off ? nearest : off) -
                         (sqrt(rt_ddot(center, center)) + reach) * (1.0 / 65536.0);
    return least > 0.0 ? least : 0.0;
}

static void rt__put(rt__column *c, int i, rt_vec3 v)
{
    c->x[i] = v.x;
    c->y[i] = v.y;
    c->z[i] = v.z;
}

static void rt__set_table(rt__table *s, const rt_scene *scene)
{
    s->least_light = 1e30f;
    s->spheres = scene->sphere_count;
    s->count = s->spheres + scene->box_count;
    s->all = rt__shape_count(scene);
    for (int i = 0; i < s->all; i++) {
        const rt_material *material = rt__material_of(scene, i);
        rt__put(&s->albedo, i, material->albedo);
        s->kind[i] = material->mirror ? 1.0f : 0.0f;
        if (scene->surfaces) {
            const rt_surface *surface = &scene->surfaces[i];
            s->eta[i] = surface->eta;
            s->shininess[i] = surface->shininess;
            rt__put(&s->absorption, i, surface->absorption);
            rt__put(&s->emission, i, surface->emission);
        }
        if (i >= s->spheres) {
            rt__bounds b;
            if (i < s->count) {
                b.min = scene->boxes[i - s->spheres].min;
                b.max = scene->boxes[i - s->spheres].max;
            } else {
                b = rt__around(scene, i - s->count);
            }
            rt__put(&s->place, i, b.min);
            rt__put(&s->max, i, b.max);
            continue;
        }
        const rt_sphere *sphere = &scene->spheres[i];
        rt__put(&s->place, i, sphere->center);
        const rt_dvec3 o = rt_to_double(sphere->center);
        const double oo = rt_ddot(o, o), r = (double)sphere->radius;
        s->radius[i] = sphere->radius;
        s->power[i] = (float)(oo - r * r);
        s->size[i] = RT__DOUBT * (float)(oo > r * r ? sqrt(oo) : r) + 1e-10f;
        s->largest = s->size[i] > s->largest ? s->size[i] : s->largest;
        s->lights[i] = 1e30f;
        for (int k = 0; k < scene->light_count; k++) {
            const rt_dvec3 f = rt_dsub(rt_to_double(scene->lights[k].position), o);
            const double c = rt_ddot(f, f) - r * r;
            s->lights[i] = c < (double)s->lights[i] ? (float)c : s->lights[i];
        }
        for (int k = 0; k < scene->lamp_count; k++) {
            const double d = rt__least_distance(&scene->lamps[k], o), c = d * d - r * r;
            s->lights[i] = c < (double)s->lights[i] ? (float)c : s->lights[i];
        }
        s->least_light = s->lights[i] < s->least_light ? s->lights[i] : s->least_light;
    }
}

static rt_status rt__run_packets(rt__job *job); /* the last section */
#endif

RTDEF rt_status rt_render(const rt_scene *scene, const rt_camera *camera,
                          const rt_options *options, rt_image *image)
{
    rt__job job;
    rt_scene indexed;
    rt_bvh bvh;
    rt_status status = rt__set_job(&job, scene, camera, options, image);
    if (status != RT_OK)
        return status;
    const int lanes = rt_lane_count(job.options.lanes);
    const int shapes = rt__primitive_count(scene);
    memset(&bvh, 0, sizeof bvh);
    indexed = *scene;
    if (scene->bvh) {
        bvh = *scene->bvh;
        indexed.bvh = &bvh;
    } else if (lanes > 1 || shapes > RT__FEW_ALONE) {
        status = rt__build_bvh(scene, rt_thread_count(job.options.threads), &bvh);
        if (status != RT_OK)
            return status;
        indexed.bvh = &bvh;
    }
    bvh.search = NULL; /* lanes have their own, and one ray alone follows the chapters */
    job.scene = &indexed;
#if RT__LANES > 1
    if (lanes > 1)
        status = rt__run_packets(&job);
    else
#endif
        status = rt__run(&job);
    if (!scene->bvh)
        rt_free_bvh(&bvh);
    return status;
}

/* ====================================================================================
 * Lanes: what a core does with 4, 8 or 16 numbers at once
 *
 * A modern core adds 4, 8 or 16 floats with one instruction, as fast as it adds one. The
 * vectors are those of gcc and clang, which take + - * / as numbers do; the rest is in a
 * table for each machine. A program has one number of lanes.
 * ==================================================================================== */
#if RT__LANES > 1

#if defined(RT__X86) && RT__LANES == 8 /* only what follows may use AVX2 */
#ifdef __clang__
#pragma clang attribute push(__attribute__((target("avx2,fma"))), apply_to = function)
#else
#pragma GCC push_options
#pragma GCC target("avx2,fma")
#pragma GCC optimize("fp-contract=off") /* otherwise only these would contract */
#endif
#endif

typedef float rt__f __attribute__((vector_size(4 * RT__LANES)));
typedef int32_t rt__i __attribute__((vector_size(4 * RT__LANES)));
typedef uint32_t rt__u __attribute__((vector_size(4 * RT__LANES)));
typedef double rt__d __attribute__((vector_size(4 * RT__LANES))); /* half of the lanes */
typedef int64_t rt__l __attribute__((vector_size(4 * RT__LANES)));

/* ---- what is the machine's own ---------------------------------------------------
 *
 *     less, same    a < b; a = b, of ints       no       not, of a mask
 *     and_less      m and a < b                 bits     a mask as bits, lane 0 lowest
 *     select        m ? a : b                   join     two halves, rounded to float
 *     min, max      a < b ? a : b, a > b ?      low      the first half in double
 *                   a : b; so b if one is NaN   high     the second half in double
 *     fma, fnma     a b + c, c - a b            pick     of a table of count floats, for
 *                                                        each lane the one at its place
 */
#if RT__LANES == 16 /* AVX-512: a mask has one bit for each lane */
typedef __mmask16 rt__m;
#define rt__less(a, b) _mm512_cmp_ps_mask(a, b, _CMP_LT_OQ)
#define rt__and_less(m, a, b) _mm512_mask_cmp_ps_mask(m, a, b, _CMP_LT_OQ)
#define rt__same(a, b) _mm512_cmpeq_epi32_mask((__m512i)(a), (__m512i)(b))
#define rt__no(m) ((rt__m) ~(m))
#define rt__bits(m) ((unsigned)(m))
#define rt__select(m, a, b) ((rt__f)_mm512_mask_blend_ps(m, b, a))
#define rt__fmin(a, b) ((rt__f)_mm512_maskz_min_ps(0xffff, a, b))
#define rt__fmax(a, b) ((rt__f)_mm512_maskz_max_ps(0xffff, a, b))
#define rt__fsqrt(v) ((rt__f)_mm512_maskz_sqrt_ps(0xffff, v))
#define rt__dsqrt(v) ((rt__d)_mm512_maskz_sqrt_pd(0xff, v))
#define rt__fma(a, b, c) ((rt__f)_mm512_fmadd_ps(a, b, c))
#define rt__fnma(a, b, c) ((rt__f)_mm512_fnmadd_ps(a, b, c))
#define rt__half(v, h) _mm512_maskz_extractf32x8_ps(0xff, v, h)
#define rt__low(v) ((rt__d)_mm512_maskz_cvtps_pd(0xff, rt__half(v, 0)))
#define rt__high(v) ((rt__d)_mm512_maskz_cvtps_pd(0xff, rt__half(v, 1)))
#define rt__narrow(v) _mm512_maskz_cvtpd_ps(0xff, v)
#define rt__join(a, b)                                                                   \
    ((rt__f)_mm512_maskz_insertf32x8(0xffff, _mm512_castps256_ps512(rt__narrow(a)),      \
                                     rt__narrow(b), 1))
#define rt__pick(table, at, count)                                                       \
    ((rt__f)((count) <= 16 ? _mm512_maskz_permutexvar_ps(0xffff, (__m512i)(at),          \
                                                         _mm512_loadu_ps(table))         \
                           : _mm512_mask_i32gather_ps(_mm512_setzero_ps(), 0xffff,       \
                                                      (__m512i)(at), table, 4)))
#else /* elsewhere -1 in each lane that is true, 0 in the others */
typedef rt__i rt__m;
#define rt__less(a, b) ((a) < (b))
#define rt__and_less(m, a, b) ((m) & ((a) < (b)))
#define rt__same(a, b) ((a) == (b))
#define rt__no(m) (~(m))
#endif

#if RT__LANES == 8 /* AVX2 and FMA */
#define rt__bits(m) ((unsigned)_mm256_movemask_ps((__m256)(m)))
#define rt__select(m, a, b) ((rt__f)_mm256_blendv_ps(b, a, (__m256)(m)))
#define rt__fmin(a, b) ((rt__f)_mm256_min_ps(a, b))
#define rt__fmax(a, b) ((rt__f)_mm256_max_ps(a, b))
#define rt__fsqrt(v) ((rt__f)_mm256_sqrt_ps(v))
#define rt__dsqrt(v) ((rt__d)_mm256_sqrt_pd(v))
#define rt__fma(a, b, c) ((rt__f)_mm256_fmadd_ps(a, b, c))
#define rt__fnma(a, b, c) ((rt__f)_mm256_fnmadd_ps(a, b, c))
#define rt__low(v) ((rt__d)_mm256_cvtps_pd(_mm256_castps256_ps128(v)))
#define rt__high(v) ((rt__d)_mm256_cvtps_pd(_mm256_extractf128_ps(v, 1)))
#define rt__join(a, b) ((rt__f)_mm256_set_m128(_mm256_cvtpd_ps(b), _mm256_cvtpd_ps(a)))
#define rt__pick(table, at, count)                                                       \
    ((rt__f)((count) <= 8                                                                \
                 ? _mm256_permutevar8x32_ps(_mm256_loadu_ps(table), (__m256i)(at))       \
                 : _mm256_i32gather_ps(table, (__m256i)(at), 4)))
#endif

#if RT__LANES == 4
RT__INLINE rt__f rt__select(rt__m m, rt__f a, rt__f b)
{
    return (rt__f)((m & (rt__i)a) | (~m & (rt__i)b));
}
RT__INLINE rt__f rt__fmin(rt__f a, rt__f b)
{
    return rt__select(a < b, a, b);
}
RT__INLINE rt__f rt__fmax(rt__f a, rt__f b)
{
    return rt__select(a > b, a, b);
}
RT__INLINE rt__f rt__pick(const float *table, rt__i at, int count)
{
    const rt__f picked = {table[at[0]], table[at[1]], table[at[2]], table[at[3]]};
    (void)count;
    return picked;
}
#ifdef __wasm_simd128__
#define rt__bits(m) ((unsigned)wasm_i32x4_bitmask((v128_t)(m)))
#define rt__fsqrt(v) ((rt__f)wasm_f32x4_sqrt((v128_t)(v)))
#define rt__dsqrt(v) ((rt__d)wasm_f64x2_sqrt((v128_t)(v)))
#define rt__fma(a, b, c) ((a) * (b) + (c)) /* rounded twice, which the bounds allow */
#define rt__fnma(a, b, c) ((c) - (a) * (b))
#define rt__low(v) ((rt__d)wasm_f64x2_promote_low_f32x4((v128_t)(v)))
#define rt__high(v) rt__low(wasm_i32x4_shuffle((v128_t)(v), (v128_t)(v), 2, 3, 2, 3))
#define rt__narrow(v) wasm_f32x4_demote_f64x2_zero((v128_t)(v))
#define rt__join(a, b)                                                                   \
    ((rt__f)wasm_i32x4_shuffle(rt__narrow(a), rt__narrow(b), 0, 1, 4, 5))
#else /* NEON */
RT__INLINE unsigned rt__bits(rt__m m)
{
    const rt__i weights = {1, 2, 4, 8};
    return (unsigned)vaddvq_s32((int32x4_t)(m & weights));
}
#define rt__fsqrt(v) ((rt__f)vsqrtq_f32((float32x4_t)(v)))
#define rt__dsqrt(v) ((rt__d)vsqrtq_f64((float64x2_t)(v)))
#define rt__fma(a, b, c) ((a) * (b) + (c))
#define rt__fnma(a, b, c) ((c) - (a) * (b))
#define rt__low(v) ((rt__d)vcvt_f64_f32(vget_low_f32((float32x4_t)(v))))
#define rt__high(v) ((rt__d)vcvt_high_f64_f32((float32x4_t)(v)))
#define rt__join(a, b) ((rt__f)vcvt_high_f32_f64(vcvt_f32_f64((float64x2_t)(a)), b))
#endif
#endif

#define RT__NOINLINE static __attribute__((noinline)) /* rare, so out of the way */
#define rt__any(m) (rt__bits(m) != 0)
#define rt__count(m) ((uint64_t)__builtin_popcount(rt__bits(m)))
#define rt__iselect(m, a, b) ((rt__i)rt__select(m, (rt__f)(a), (rt__f)(b)))

/* ---- chapter 0 ------------------------------------------------------------------- */

typedef struct rt__f3 {
    rt__f x, y, z;
} rt__f3;

typedef struct rt__d3 {
    rt__d x, y, z;
} rt__d3;

RT__INLINE rt__f rt__all(float v)
{
    const rt__f zero = {0.0f};
    return v - zero;
}

RT__INLINE rt__f rt__abs(rt__f v)
{
    return (rt__f)((rt__i)v & 0x7fffffff);
}

RT__INLINE rt__f3 rt__vec(rt__f x, rt__f y, rt__f z)
{
    rt__f3 v;
    v.x = x;
    v.y = y;
    v.z = z;
    return v;
}

RT__INLINE rt__f3 rt__vall(rt_vec3 v)
{
    return rt__vec(rt__all(v.x), rt__all(v.y), rt__all(v.z));
}

RT__INLINE rt__f3 rt__add(rt__f3 a, rt__f3 b)
{
    return rt__vec(a.x + b.x, a.y + b.y, a.z + b.z);
}

RT__INLINE rt__f3 rt__sub(rt__f3 a, rt__f3 b)
{
    return rt__vec(a.x - b.x, a.y - b.y, a.z - b.z);
}

RT__INLINE rt__f3 rt__mul(rt__f3 a, rt__f3 b)
{
    return rt__vec(a.x * b.x, a.y * b.y, a.z * b.z);
}

RT__INLINE rt__f3 rt__scale(rt__f3 v, rt__f k)
{
    return rt__vec(k * v.x, k * v.y, k * v.z);
}

RT__INLINE rt__f rt__dot(rt__f3 a, rt__f3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

RT__INLINE rt__f3 rt__vselect(rt__m m, rt__f3 a, rt__f3 b)
{
    return rt__vec(rt__select(m, a.x, b.x), rt__select(m, a.y, b.y),
                   rt__select(m, a.z, b.z));
}

RT__INLINE rt__d rt__ddot(rt__d3 a, rt__d3 b)
{
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

RT__INLINE rt__d3 rt__dsub(rt__d3 a, rt__d3 b)
{
    a.x = a.x - b.x;
    a.y = a.y - b.y;
    a.z = a.z - b.z;
    return a;
}

RT__INLINE rt__d3 rt__dmad(rt__d3 a, rt__d k, rt__d3 b)
{
    a.x = a.x + k * b.x;
    a.y = a.y + k * b.y;
    a.z = a.z + k * b.z;
    return a;
}

RT__INLINE rt__d3 rt__dscale(rt__d3 v, rt__d k)
{
    v.x = k * v.x;
    v.y = k * v.y;
    v.z = k * v.z;
    return v;
}

RT__INLINE rt__d rt__widen(rt__f v, int half)
{
    return half == 0 ? rt__low(v) : rt__high(v);
}

RT__INLINE rt__d3 rt__vwiden(rt__f3 v, int half)
{
    rt__d3 d;
    d.x = rt__widen(v.x, half);
    d.y = rt__widen(v.y, half);
    d.z = rt__widen(v.z, half);
    return d;
}

RT__INLINE rt__f3 rt__vjoin(const rt__d3 *two)
{
    return rt__vec(rt__join(two[0].x, two[1].x), rt__join(two[0].y, two[1].y),
                   rt__join(two[0].z, two[1].z));
}

/* ====================================================================================
 * Packets: 4, 8 or 16 rays at a time
 *
 * Here chapters 1 to 7, and then part two, are written once more for a packet of
 * neighbouring pixels, each in its lane:
 *
 *     lane               0     1     2     3   ...
 *     pixel             0,0   1,0   2,0   3,0        neighbours in a row
 *     a                -2.0   0.5   1.0   3.0        rt__f: a float in each lane
 *     b                 1.0   1.0   1.0   1.0
 *     a + b            -1.0   1.5   2.0   4.0        one addition for all
 *     m = a < b         yes   yes   no    no         rt__m: a mask
 *     select(m, a, b)  -2.0   0.5   1.0   1.0        what takes the place of if
 *
 * All lanes take the same steps: both sides of an if are computed, and each lane selects
 * its own. A comment before each function names the functions of the chapters that it
 * repeats.
 *
 * Every lane gets the bits that the chapters give. Mostly that is easy: the same
 * operations in the same order. The sphere is the exception. It needs double, and only
 * half as many doubles fit; and most spheres are not hit. So all shapes are first asked
 * in float, with a bound for the error, and only the nearest is computed as in chapter 1.
 * If it is nearer than any other can be, it is the hit. If not, this ray goes through the
 * tree of chapter 8 alone. Shadows likewise: yes, no, or if in doubt, alone.
 *
 * That is for few shapes. If there are many, all rays go through the tree alone.
 * ==================================================================================== */

/* ---- the shapes, and where rays start -------------------------------------------- */

RT__INLINE rt__f3 rt__vpick(const rt__column *c, rt__i at, int count)
{
    return rt__vec(rt__pick(c->x, at, count), rt__pick(c->y, at, count),
                   rt__pick(c->z, at, count));
}

RT__INLINE rt__f3 rt__row(const rt__column *c, int i)
{
    return rt__vall(rt_vec(c->x[i], c->y[i], c->z[i]));
}

/* Where the rays of a packet start. The rays to the lights and the next bounce start at
 * the same point, so for each sphere they share the c of chapter 1,
 *
 *     c = |C - O|^2 - R^2 = <C,C> - <O,2C> + (|O|^2 - R^2).
 *
 * That is a small difference of large numbers, in float but for the last term, which was
 * computed in double. With s = |C| + max(|O|, R), no term is larger than s^2, and each of
 * 9 roundings is at most 2^-24 of it. So, with some room for what comes below,
 *
 *     |error of c|  <  doubt = 2^-18 s^2,        low = c - doubt. */
typedef struct rt__place {
    rt__f3 origin; /* C */
    rt__f size;    /* |C|, scaled by RT__DOUBT */
    rt__i left;    /* the number n of the sphere that the ray leaves on its outside, ~n on
                      its inside, or RT__NOWHERE. It is met at t = 0, which is no hit */
    rt__f low[RT__FEW];   /* for each sphere: c is this or more */
    bool beside[RT__FEW]; /* does a ray start in or near it, or is a light there? */
    bool any_beside;      /* if false, beside is not set */
} rt__place;

#define RT__NOWHERE INT_MAX

RT__INLINE void rt__start_at(const rt__table *s, rt__place *p, rt__f3 origin, rt__i left)
{
    const rt__f oo = rt__dot(origin, origin);
    const rt__f3 two = rt__add(origin, origin);
    rt__i here = left & 0;
    rt__m close = {0};
    p->origin = origin;
    p->size = rt__fsqrt(oo) * RT__DOUBT;
    p->left = left;
    for (int i = 0; i < s->spheres; i++, here += 1) {
        const rt__f3 o = rt__row(&s->place, i);
        const rt__f size = p->size + s->size[i], doubt = size * size;
        const rt__f c = rt__fnma(
            o.x, two.x, rt__fnma(o.y, two.y, rt__fnma(o.z, two.z, oo + s->power[i])));
        const rt__f low = rt__select(rt__same(left, here), rt__all(1e30f), c - doubt);
        close |= rt__less(low, doubt);
        p->low[i] = low;
    }
    const rt__f most = p->size + s->largest;
    p->any_beside =
        rt__any(close) || rt__any(rt__less(rt__all(s->least_light), most * most));
    for (int i = 0; p->any_beside && i < s->spheres; i++) {
        const rt__f size = p->size + s->size[i];
        const rt__f least = rt__fmin(p->low[i], rt__all(s->lights[i]));
        p->beside[i] = rt__any(rt__less(least, size * size));
    }
}

/* ---- chapters 1 to 3: the nearest hit -------------------------------------------- */

/* What rt_hit says, for a packet, with what chapter 7 wants to know of the material. */
typedef struct rt__hits {
    rt__f kind; /* -1: nothing was hit; 0: a diffuse surface; 1: a mirror */
    rt__i left; /* of the next place */
    rt__f3 point, normal, albedo;
    rt__f t;      /* part two wants to know these, too; */
    rt__i shape;  /* for a miss they are anything, but shape is a valid number */
    rt__i inside; /* of a mesh or custom shape, see rt_hit */
} rt__hits;

/* The nearest shape so far, by key = -a t: the larger, the nearer. The key of shape
 * number at is best or less; that of every other shape is others or less. */
typedef struct rt__nearest {
    rt__f best, others;
    rt__i at;
} rt__nearest;

#define RT__NEVER -1e30f /* the key of nothing */

/* A shape with this key; NaN: none. */
RT__INLINE void rt__offer(rt__nearest *n, rt__f key, rt__i at)
{
    const rt__m nearer = rt__less(n->best, key);
    n->others = rt__fmax(rt__fmin(n->best, key), n->others);
    n->best = rt__fmax(key, n->best);
    n->at = rt__iselect(nearer, at, n->at);
}

/* b = <C - O, u> = <C,u> - <O,u>; the first term is the same for all spheres. The error
 * is 7 roundings of s |u|, less than 2^-21 s |u|. */
RT__INLINE rt__f rt__b(const rt__table *s, int i, rt__f3 u, rt__f cu)
{
    const rt__f3 o = rt__row(&s->place, i);
    return rt__fnma(o.x, u.x, rt__fnma(o.y, u.y, rt__fnma(o.z, u.z, cu)));
}

/* rt__meet_sphere: -a t = b + sqrt(b^2 - a c). With low in place of c that is never too
 * small, since (b^2 - a c) / a is wrong by 29 roundings of s^2, less than doubt. If the
 * rays start outside and go away, b > 0, then min(b, 0) leaves a negative discriminant,
 * whose root is NaN. */
RT__INLINE rt__f rt__sphere_key(const rt__table *s, const rt__place *p, int i, rt__i here,
                                rt__f b, rt__f a)
{
    const rt__f zero = rt__all(0.0f), low = p->low[i];
    const rt__f key = b + rt__fsqrt(rt__fnma(a, low, b * rt__fmin(b, zero)));
    if (__builtin_expect(!p->any_beside, 1) || !p->beside[i])
        return key;
    /* Inside it is the larger root. Too near to the surface to tell, t may be 0. */
    const rt__f size = p->size + s->size[i], doubt = size * size;
    const rt__m inside = rt__less(low, -3.0f * doubt) | rt__same(p->left, ~here);
    const rt__f root = rt__fsqrt(rt__fmax(rt__fnma(a, low + 2.0f * doubt, b * b), zero));
    return rt__select(inside, b - root, rt__select(rt__less(low, doubt), zero, key));
}

/* What rays do with boxes. With 1/u in place of u, they enter and leave within 3
 * roundings of t. For rays parallel to a face nothing is sure: they may run in its very
 * plane. */
typedef struct rt__slab_rays {
    rt__f3 origin, inverse;
    rt__m parallel;
} rt__slab_rays;

RT__INLINE rt__slab_rays rt__for_boxes(rt__f3 origin, rt__f3 u)
{
    rt__slab_rays r;
    r.origin = origin;
    r.inverse = rt__vec(1.0f / u.x, 1.0f / u.y, 1.0f / u.z);
    r.parallel = rt__less(rt__fmin(rt__abs(u.x), rt__fmin(rt__abs(u.y), rt__abs(u.z))),
                          rt__all(1e-29f));
    return r;
}

RT__INLINE void rt__slab(const rt__table *s, int i, const rt__slab_rays *r, rt__f *t_in,
                         rt__f *t_out, rt__f *doubt)
{
    const rt__f3 low = rt__mul(rt__sub(rt__row(&s->place, i), r->origin), r->inverse);
    const rt__f3 high = rt__mul(rt__sub(rt__row(&s->max, i), r->origin), r->inverse);
    *t_in = rt__fmax(rt__fmax(rt__fmin(low.x, high.x), rt__fmin(low.y, high.y)),
                     rt__fmin(low.z, high.z));
    *t_out = rt__fmin(rt__fmin(rt__fmax(low.x, high.x), rt__fmax(low.y, high.y)),
                      rt__fmax(low.z, high.z));
    *doubt = (rt__abs(*t_in) + rt__abs(*t_out)) * (4.0f * FLT_EPSILON);
}

/* rt_intersect, the loops: all shapes, one after the other. */
RT__INLINE rt__nearest rt__ask_all(const rt__table *s, const rt__place *p, rt__f3 u,
                                   rt__f a)
{
    const rt__f cu = rt__dot(p->origin, u), zero = rt__all(0.0f);
    rt__nearest n;
    n.best = n.others = rt__all(RT__NEVER);
    rt__i here = n.at = (rt__i)zero;
    for (int i = 0; i < s->spheres; i++, here += 1)
        rt__offer(&n, rt__sphere_key(s, p, i, here, rt__b(s, i, u, cu), a), here);
    if (s->spheres == s->count)
        return n;
    const rt__slab_rays r = rt__for_boxes(p->origin, u);
    for (int i = s->spheres; i < s->count; i++, here += 1) {
        rt__f t_in, t_out, doubt;
        rt__slab(s, i, &r, &t_in, &t_out, &doubt);
        const rt__m misses = rt__less(t_out + doubt, t_in) | rt__less(t_out, zero);
        const rt__f t = rt__select(rt__less(zero, t_in), t_in, t_out);
        const rt__f key = rt__select(misses, rt__all(RT__NEVER), (doubt - t) * a);
        rt__offer(&n, rt__select(r.parallel, zero, key), here);
    }
    return n;
}

/* rt__meet_sphere and rt__hit_sphere_at in double, each lane with its own sphere, but
 * without their rare cases: see rt__find. Returns t. */
RT__INLINE rt__f rt__finish_spheres(const rt__place *p, rt__f3 u, rt__f3 center,
                                    rt__f radius, rt__hits *hits)
{
    rt__d3 points[2], normals[2];
    rt__d t[2];
    for (int h = 0; h < 2; h++) {
        const rt__d3 v = rt__vwiden(u, h), o = rt__vwiden(center, h);
        const rt__d3 f = rt__dsub(rt__vwiden(p->origin, h), o);
        const rt__d r = rt__widen(radius, h);
        const rt__d a = rt__ddot(v, v), b = rt__ddot(f, v), c = rt__ddot(f, f) - r * r;
        const rt__d root = rt__dsqrt(b * b - a * c);
        rt__d key = b + root;
        if (__builtin_expect(p->any_beside, 0)) { /* inside, the other root */
            const rt__l in = key > 0.0;
            key = (rt__d)((in & (rt__l)(b - root)) | (~in & (rt__l)key));
        }
        t[h] = key / -a;
        const rt__d3 n = rt__dscale(rt__dmad(f, t[h], v), 1.0 / r);
        normals[h] = rt__dscale(n, 1.5 - 0.5 * rt__ddot(n, n));
        points[h] = rt__dmad(o, r, normals[h]);
    }
    hits->point = rt__vjoin(points);
    hits->normal = rt__vjoin(normals);
    return rt__join(t[0], t[1]);
}

/* rt__slabs, rt__quotient and rt__cut. */
typedef struct rt__cuts {
    rt__f t_in, t_out;
    rt__i axis_in, axis_out;
    rt__m miss;
} rt__cuts;

RT__INLINE void rt__cut_axis(rt__cuts *cuts, int axis, rt__f low, rt__f high, rt__f o,
                             rt__f u)
{
    const rt__f zero = rt__all(0.0f), all = rt__all(FLT_MAX);
    const rt__i here = (rt__i)zero + axis;
    const rt__m parallel = rt__no(rt__less(zero, rt__abs(u))), up = rt__less(zero, u);
    const rt__f t_low = rt__fmax(rt__fmin((low - o) / u, all), -all);
    const rt__f t_high = rt__fmax(rt__fmin((high - o) / u, all), -all);
    const rt__f t_in = rt__select(parallel, -all, rt__select(up, t_low, t_high));
    const rt__f t_out = rt__select(parallel, all, rt__select(up, t_high, t_low));
    const rt__m later = rt__less(cuts->t_in, t_in), sooner = rt__less(t_out, cuts->t_out);
    cuts->t_in = rt__select(later, t_in, cuts->t_in);
    cuts->t_out = rt__select(sooner, t_out, cuts->t_out);
    cuts->axis_in = rt__iselect(later, here, cuts->axis_in);
    cuts->axis_out = rt__iselect(sooner, here, cuts->axis_out);
    const rt__m outside = parallel & (rt__less(o, low) | rt__less(high, o));
    const rt__m past = rt__less(t_out, t_in) | rt__less(cuts->t_out, cuts->t_in);
    cuts->miss |= outside | past;
}

/* One coordinate of normal and point: on the plane, if the ray enters or leaves through
 * one of this axis; otherwise as in rt__pull. */
RT__INLINE void rt__face(rt__m here, rt__m inside, rt__f o, rt__f u, rt__f low,
                         rt__f high, rt__f *normal, rt__f *point)
{
    const rt__f p = *point, zero = rt__all(0.0f), one = rt__all(1.0f);
    const rt__f step = FLT_EPSILON * (4.0f * rt__abs(p - o) + rt__abs(p));
    const rt__m forth = rt__less(o, p), up = rt__less(zero, u);
    const rt__f back = rt__select(forth, p - step, p + step);
    const rt__f pulled = rt__select(rt__less(o, back) ^ forth, o, back);
    *normal = rt__select(here, rt__select(up, -one, one), zero);
    *point = rt__select(here, rt__select(up ^ inside, low, high), pulled);
}

/* rt_hit_box, for lanes whose nearest shape is a box, if its key is above limit; returns
 * those for which that is so. */
RT__NOINLINE rt__m rt__finish_boxes(const rt__table *s, const rt__f3 *origin,
                                    const rt__f3 *direction, rt__m lanes, const rt__i *at,
                                    const rt__f *limit, rt__hits *hits)
{
    const rt__f3 o = *origin, u = *direction;
    const rt__f3 low = rt__vpick(&s->place, *at, s->count);
    const rt__f3 high = rt__vpick(&s->max, *at, s->count);
    const rt__f zero = rt__all(0.0f);
    const rt__i x = (rt__i)zero, y = x + 1, z = x + 2;
    const rt__m none = {0};
    rt__cuts cuts;
    cuts.t_out = rt__all(FLT_MAX);
    cuts.t_in = -cuts.t_out;
    cuts.axis_in = cuts.axis_out = x;
    cuts.miss = none;
    rt__cut_axis(&cuts, 0, low.x, high.x, o.x, u.x);
    rt__cut_axis(&cuts, 1, low.y, high.y, o.y, u.y);
    rt__cut_axis(&cuts, 2, low.z, high.z, o.z, u.z);
    const rt__m inside = rt__no(rt__less(zero, cuts.t_in));
    const rt__f t = rt__select(inside, cuts.t_out, cuts.t_in);
    const rt__i axis = rt__iselect(inside, cuts.axis_out, cuts.axis_in);
    const rt__m good = lanes & rt__no(cuts.miss) & rt__less(zero, t) &
                       rt__less(*limit, rt__dot(u, u) * -t);
    rt__f3 normal, point = rt__add(o, rt__scale(u, t));
    rt__face(rt__same(axis, x), inside, o.x, u.x, low.x, high.x, &normal.x, &point.x);
    rt__face(rt__same(axis, y), inside, o.y, u.y, low.y, high.y, &normal.y, &point.y);
    rt__face(rt__same(axis, z), inside, o.z, u.z, low.z, high.z, &normal.z, &point.z);
    hits->normal = rt__vselect(good, normal, hits->normal);
    hits->point = rt__vselect(good, point, hits->point);
    hits->left = rt__iselect(good, x + RT__NOWHERE, hits->left);
    hits->t = rt__select(good, t, hits->t);
    return good;
}

static void rt__find_in_tree(const rt_scene *scene, const rt__f3 *origin,
                             const rt__f3 *direction, unsigned lanes, rt__hits *hits);

/* Rays ask meshes and custom shapes one after the other, in the tree. Which rays may meet
 * one before t_max? Those that enter the box around it, or are parallel to a face. */
RT__NOINLINE rt__m rt__near_others(const rt__table *s, const rt__f3 *origin,
                                   const rt__f3 *direction, const rt__f *t_max)
{
    const rt__slab_rays r = rt__for_boxes(*origin, *direction);
    const rt__f zero = rt__all(0.0f);
    rt__m near_any = r.parallel;
    for (int i = s->count; i < s->all; i++) {
        rt__f t_in, t_out, doubt;
        rt__slab(s, i, &r, &t_in, &t_out, &doubt);
        near_any |= rt__no(rt__less(t_out + doubt, rt__fmax(t_in, zero)) |
                           rt__less(*t_max + doubt, t_in));
    }
    return near_any;
}

/* rt_intersect of a scene with few shapes. */
RT__INLINE void rt__find(const rt__job *job, const rt__place *p, rt__f3 u, rt__m lanes,
                         rt__hits *hits)
{
    const rt__table *s = job->table;
    const rt__f a = rt__dot(u, u), zero = rt__all(0.0f);
    const rt__nearest n = rt__ask_all(s, p, u, a);
    const rt__m missed = rt__less(n.best, rt__all(0.5f * RT__NEVER));
    const rt__f r = rt__pick(s->radius, n.at, s->count);
    const rt__f3 center = rt__vpick(&s->place, n.at, s->count);
    const rt__f t = rt__finish_spheres(p, u, center, r, hits);
    const rt__f toward = rt__dot(hits->normal, u);
    const rt__m within = rt__less(zero, toward);
    hits->normal =
        rt__vselect(within, rt__scale(hits->normal, rt__all(-1.0f)), hits->normal);
    hits->left = rt__iselect(within, ~n.at, n.at);
    hits->kind = rt__select(missed, rt__all(-1.0f), rt__pick(s->kind, n.at, s->count));
    hits->albedo = rt__vpick(&s->albedo, n.at, s->count);
    hits->t = t;
    hits->shape = n.at;
    /* Nearer than any other? The key of another sphere has the error of b and two
     * roundings more, a and t of this one have some: in all less than 2^-19 s |u|. */
    const rt__f slack = (p->size + s->largest) * (1.9073486328125e-6f / RT__DOUBT);
    const rt__f limit = n.others + slack * (0.5f * a + 0.5f); /* not less than |u| */
    /* Left to chapter 1: t = 0; rays from afar, for which it has another formula; and
     * rays so flat that it is not sure which side they come from. */
    const rt__m sphere = rt__less(zero, r);
    const rt__m good = sphere & rt__less(rt__all(1e-30f), t) & rt__less(limit, a * -t) &
                       rt__less(t * t * a, r * r * 8e9f) &
                       rt__less(rt__all(4e-6f), rt__abs(toward));
    rt__m ask = lanes & rt__no(missed | good);
    const rt__m boxes = ask & rt__no(sphere);
    if (rt__any(boxes))
        ask &= rt__no(rt__finish_boxes(s, &p->origin, &u, boxes, &n.at, &limit, hits));
    if (s->count < s->all) {
        const rt__f t_max = rt__select(missed, rt__all(FLT_MAX), hits->t);
        hits->inside = n.at & 0;
        ask |= lanes & rt__near_others(s, &p->origin, &u, &t_max);
    }
    if (rt__any(ask))
        rt__find_in_tree(job->scene, &p->origin, &u, rt__bits(ask), hits);
}

/* ---- chapter 8: alone through the tree ------------------------------------------- */

#if RT__LANES == 16 /* a node has eight boxes, a leaf eight shapes */
typedef float rt__boxes __attribute__((vector_size(32)));
#define rt__bmin(a, b) ((rt__boxes)_mm256_min_ps(a, b))
#define rt__bmax(a, b) ((rt__boxes)_mm256_max_ps(a, b))
#define rt__bsqrt(v) ((rt__boxes)_mm256_sqrt_ps(v))
#define rt__bfma(a, b, c) ((rt__boxes)_mm256_fmadd_ps(a, b, c))
#define rt__bfnma(a, b, c) ((rt__boxes)_mm256_fnmadd_ps(a, b, c))
#define rt__bat_most(a, b) ((unsigned)_mm256_cmp_ps_mask(a, b, _CMP_LE_OQ))
#else
typedef rt__f rt__boxes;
#define rt__bmin(a, b) rt__fmin(a, b)
#define rt__bmax(a, b) rt__fmax(a, b)
#define rt__bsqrt(v) rt__fsqrt(v)
#define rt__bfma(a, b, c) rt__fma(a, b, c)
#define rt__bfnma(a, b, c) rt__fnma(a, b, c)
#define rt__bat_most(a, b) rt__bits((a) <= (b))
#endif
enum { RT__STEP = (int)(sizeof(rt__boxes) / sizeof(float)) }; /* 8, or twice 4 */

RT__INLINE rt__boxes rt__eight(const float *values)
{
    rt__boxes v;
    memcpy(&v, values, sizeof v);
    return v;
}

/* Which columns of a leaf hold a shape? */
RT__INLINE unsigned rt__columns(const rt_bvh_row *row)
{
#if RT__LANES > 4
    return ~(unsigned)_mm256_movemask_ps((__m256)rt__eight(row->value)) & 255u;
#else
    rt__i numbers[2];
    memcpy(numbers, row->number, sizeof numbers);
    return ~(rt__bits(numbers[0] < 0) | rt__bits(numbers[1] < 0) << 4) & 255u;
#endif
}

RT__INLINE rt__boxes rt__babs(rt__boxes v)
{
    return rt__bmax(v, -v);
}

/* A ray, and what all its questions share. */
typedef struct rt__probe {
    rt_ray ray;
    rt_vec3 inverse;
    int octant;              /* see rt__set_order */
    int in_x, in_y, in_z;    /* where in a node, in floats, the planes are ... */
    int out_x, out_y, out_z; /* ... through which it comes and goes */
    rt_vec3 in;              /* inverse, a little smaller */
    float over_a, over_root; /* 1 / <u,u>, 1 / |u| */
    rt__shear shear;         /* of chapter 16 ... */
    float origin[3], shear_x, shear_y; /* ... and in floats, turned */
    int row[3];                        /* where the coordinates that become x, y, z are */
} rt__probe;

/* Not all rays are fit: the squares of very short and long directions are no good floats.
 * And sums and products must not overflow, unless the ray is almost parallel to an axis.
 * Such rays stay in a box thanks to its margin of 1e-15, which rt__inverse turns into
 * 1e22. So no t may be that large, and none is: 3e16 / 1e-5 is less. */
RT__INLINE bool rt__set_probe(rt__probe *p, const rt_scene *scene, const rt_ray *ray)
{
    const rt_vec3 o = ray->origin, u = ray->direction;
    if (!rt__within(o, -1e16f, 1e16f) || !rt__within(u, -1e10f, 1e10f) ||
        !(rt_dot(u, u) >= 1e-10f))
        return false;
    p->ray = *ray;
    p->inverse = rt_vec(rt__inverse(u.x), rt__inverse(u.y), rt__inverse(u.z));
    p->in = rt_scale(p->inverse, 1.0f - 4.0f * FLT_EPSILON);
    const int x = p->inverse.x < 0.0f, y = p->inverse.y < 0.0f, z = p->inverse.z < 0.0f;
    p->octant = x | y << 1 | z << 2;
    p->in_x = 24 * x;
    p->in_y = 8 + 24 * y;
    p->in_z = 16 + 24 * z;
    p->out_x = 24 - p->in_x;
    p->out_y = 40 - p->in_y;
    p->out_z = 56 - p->in_z;
    if (scene->sphere_count > 0) {
        p->over_a = 1.0f / rt_dot(u, u);
        p->over_root = sqrtf(p->over_a);
    }
    if (scene->mesh_count == 0)
        return true;
    p->shear = rt__shear_of(ray);
    const int axis = p->shear.axis;
    rt__put_vec(p->origin, rt_to_float(rt__turned(o, axis)));
    p->shear_x = (float)p->shear.x;
    p->shear_y = (float)p->shear.y;
    p->row[0] = 1 + (axis + 1) % 3;
    p->row[1] = 1 + (axis + 2) % 3;
    p->row[2] = 1 + axis;
    return true;
}

/* rt__enter, for the boxes k to k + RT__STEP - 1: they are met if *t <= *out. The octant
 * tells through which plane of each axis the ray enters. Where there is no box the planes
 * are infinite, and never met. p->in in place of the inverse makes the ways in shorter by
 * 8 roundings; they were up to 4 too long, and the ways out up to 3 too short. */
RT__INLINE void rt__enter_boxes(const rt_bvh_node *node, const rt__probe *p, float t_max,
                                int k, rt__boxes *t, rt__boxes *out)
{
    const float *planes = node->min_x + k;
    const rt_vec3 o = p->ray.origin, inverse = p->inverse, less = p->in;
    const rt__boxes zero = {0.0f};
    const rt__boxes in_x = (rt__eight(planes + p->in_x) - o.x) * less.x;
    const rt__boxes in_y = (rt__eight(planes + p->in_y) - o.y) * less.y;
    const rt__boxes in_z = (rt__eight(planes + p->in_z) - o.z) * less.z;
    const rt__boxes out_x = (rt__eight(planes + p->out_x) - o.x) * inverse.x;
    const rt__boxes out_y = (rt__eight(planes + p->out_y) - o.y) * inverse.y;
    const rt__boxes out_z = (rt__eight(planes + p->out_z) - o.z) * inverse.z;
    *t = rt__bmax(rt__bmax(in_x, in_y), rt__bmax(in_z, zero));
    *out = rt__bmin(rt__bmin(out_x, out_y), rt__bmin(out_z, t_max - zero));
}

/* Which spheres of a leaf may the ray meet before t_max? The answer has all that it does
 * meet, and hardly any other. This is why none is missed.
 *
 * With g = O - C, the point nearest to the centre is at t = b = <g,u> / <u,u>. The ray
 * meets the sphere if l = g - b u is not longer than R, between b - h and b + h with h =
 * sqrt(R^2 - l^2) / |u|. Let e = 2^-24. The rounding of g, <g,u>, <u,u> and the quotient
 * puts b u wrong by 9 e |g| at most; with that of g itself and of l, l is wrong by less
 * than 14 e |g|. And for any k, (R + d)^2 <= (1 + k) R^2 + (1 + 1/k) d^2. So with k =
 * 0.0009
 *
 *     l^2 as computed  <=  (R + 14 e |g|)^2 (1 + 4e)  <  1.00091 R^2 + 8e-10 g^2,
 *
 * less than reach below; its 1e-30 makes up for squares too small for a float. Likewise,
 * with k = 0.0005, (|u| h)^2 as computed >= R^2 - l^2 + 0.0004 R^2, so h is too large by
 * 0.0001 R / |u| or more. b is wrong by 9 e |g| / |u|, and |g| <= |b u| + R. The part
 * from |b u|, with the rounding of t, is less than 1e-6 |b|; the part from R is less than
 * the excess of h. */
RT__INLINE unsigned rt__near_spheres(const rt_bvh_row *row, const rt__probe *p,
                                     float t_max, int k)
{
    const rt_vec3 o = p->ray.origin, u = p->ray.direction;
    const rt__boxes zero = {0.0f};
    const rt__boxes x = rt__eight(row[1].value + k) - o.x;
    const rt__boxes y = rt__eight(row[2].value + k) - o.y;
    const rt__boxes z = rt__eight(row[3].value + k) - o.z;
    const rt__boxes r = rt__eight(row[4].value + k);
    const rt__boxes ff = rt__bfma(x, x, rt__bfma(y, y, z * z));
    const rt__boxes b =
        rt__bfma(x, u.x - zero, rt__bfma(y, u.y - zero, z * u.z)) * p->over_a;
    const rt__boxes lx = rt__bfnma(b, u.x - zero, x);
    const rt__boxes ly = rt__bfnma(b, u.y - zero, y);
    const rt__boxes lz = rt__bfnma(b, u.z - zero, z);
    const rt__boxes ll = rt__bfma(lx, lx, rt__bfma(ly, ly, lz * lz));
    const rt__boxes reach = rt__bfma(ff, 2e-9f - zero, r * r * 1.001f + 1e-30f) - ll;
    const rt__boxes h = rt__bsqrt(rt__bmax(reach, zero)) * p->over_root;
    const rt__boxes slack = rt__babs(b) * 1e-6f;
    const rt__boxes begin = b - h - slack, end = b + h + slack;
    return rt__bat_most(zero, reach) & rt__bat_most(begin, t_max - zero) &
           rt__bat_most(zero, end);
}

/* Which boxes, or boxes around custom shapes? As in rt__enter_boxes; the boxes are made a
 * little larger, as in rt__with_margin. */
RT__INLINE unsigned rt__near_boxes(const rt_bvh_row *row, const rt__probe *p, float t_max,
                                   int k)
{
    rt__boxes t_in = {0.0f}, t_out = t_in + t_max;
    const float o[3] = {p->ray.origin.x, p->ray.origin.y, p->ray.origin.z};
    const float inverse[3] = {p->inverse.x, p->inverse.y, p->inverse.z};
    for (int axis = 0; axis < 3; axis++) {
        const rt__boxes low = rt__eight(row[1 + axis].value + k);
        const rt__boxes high = rt__eight(row[4 + axis].value + k);
        const rt__boxes more =
            rt__bmax(rt__babs(low), rt__babs(high)) * (2.0f * FLT_EPSILON) + 1e-15f;
        const rt__boxes a = (low - more - o[axis]) * inverse[axis];
        const rt__boxes b = (high + more - o[axis]) * inverse[axis];
        t_in = rt__bmax(rt__bmin(a, b), t_in);
        t_out = rt__bmin(rt__bmax(a, b), t_out);
    }
    return rt__bat_most(t_in * (1.0f - 4.0f * FLT_EPSILON), t_out);
}

/* One corner of each triangle, sheared; and the largest coordinates so far. */
RT__INLINE void rt__shear_corner(const rt_bvh_row *row, const rt__probe *p, int k,
                                 int corner, rt__boxes *x, rt__boxes *y, rt__boxes *most,
                                 rt__boxes *most_z)
{
    const rt_bvh_row *here = row + 3 * corner;
    const rt__boxes zero = {0.0f};
    const rt__boxes z = rt__eight(here[p->row[2]].value + k) - p->origin[2];
    *x = rt__bfnma(z, p->shear_x - zero,
                   rt__eight(here[p->row[0]].value + k) - p->origin[0]);
    *y = rt__bfnma(z, p->shear_y - zero,
                   rt__eight(here[p->row[1]].value + k) - p->origin[1]);
    *most = rt__bmax(*most, rt__bmax(rt__babs(*x), rt__babs(*y)));
    *most_z = rt__bmax(*most_z, rt__babs(z));
}

/* Which triangles? The weights of chapter 16 in float, and a bound for their error.
 *
 * Let e = 2^-24, R the largest sheared coordinate of a triangle, Z the largest z. p - C
 * is rounded once, and so are the factor u_x / u_z, which is at most 1, and the sum. So x
 * and y are wrong by e (2 R + 5 Z) at most. That is less than error = 6 e (R + Z), by so
 * much that the rounding of error and bound does not count. Then each of the two products
 * of a weight is wrong by 2 R error + error^2, and the three roundings add 4 e R^2; 1e-37
 * makes up for products too small for a float. The error of double, which chapter 16
 * takes, is next to nothing beside that. So if the ray is inside for chapter 16, no
 * weight is below -bound, or none is above bound. */
RT__INLINE unsigned rt__near_triangles(const rt_bvh_row *row, const rt__probe *p, int k)
{
    const float e = 0.5f * FLT_EPSILON;
    rt__boxes x[3], y[3], r = {0.0f}, z = r;
    for (int i = 0; i < 3; i++)
        rt__shear_corner(row, p, k, i, &x[i], &y[i], &r, &z);
    const rt__boxes a = x[2] * y[1] - y[2] * x[1];
    const rt__boxes b = x[0] * y[2] - y[0] * x[2];
    const rt__boxes c = x[1] * y[0] - y[1] * x[0];
    const rt__boxes error = (r + z) * (6.0f * e);
    const rt__boxes bound =
        r * (4.0f * error + (4.0f * e) * r) + 2.0f * error * error + 1e-37f;
    const rt__boxes least = rt__bmin(rt__bmin(a, b), c),
                    largest = rt__bmax(rt__bmax(a, b), c);
    return rt__bat_most(-bound, least) | rt__bat_most(largest, bound);
}

/* The nearest shape so far, and in which column of which leaf. */
typedef struct rt__found {
    rt__best best;
    double t;         /* before it was rounded */
    rt_dvec3 weights; /* of a triangle */
    int leaf, column;
} rt__found;

RT__INLINE rt_vec3 rt__column_vec(const rt_bvh_row *row, int column)
{
    return rt_vec(row[0].value[column], row[1].value[column], row[2].value[column]);
}

RT__INLINE rt_sphere rt__column_sphere(const rt_bvh_row *row, int column)
{
    rt_sphere sphere;
    memset(&sphere, 0, sizeof sphere);
    sphere.center = rt__column_vec(row + 1, column);
    sphere.radius = row[4].value[column];
    return sphere;
}

RT__INLINE rt_box rt__column_box(const rt_bvh_row *row, int column)
{
    rt_box box;
    memset(&box, 0, sizeof box);
    box.min = rt__column_vec(row + 1, column);
    box.max = rt__column_vec(row + 4, column);
    return box;
}

RT__INLINE rt__corners rt__column_corners(const rt_bvh_row *row, int column)
{
    rt__corners corners;
    corners.a = rt__column_vec(row + 1, column);
    corners.b = rt__column_vec(row + 4, column);
    corners.c = rt__column_vec(row + 7, column);
    return corners;
}

/* rt__meet_shape, from what the leaf holds of the shape. */
RT__INLINE double rt__meet_column(const rt_scene *scene, const rt_bvh_row *row, int kind,
                                  int column, const rt__probe *p, float t_max,
                                  rt_dvec3 *weights)
{
    if (kind == RT__SPHERES) {
        const rt_sphere sphere = rt__column_sphere(row, column);
        return rt__meet_sphere(&sphere, &p->ray, t_max);
    }
    if (kind == RT__TRIANGLES) {
        const rt__corners corners = rt__column_corners(row, column);
        return rt__meet_corners(&p->shear, &corners, t_max, weights);
    }
    const int number = row->number[column];
    if (number >= scene->sphere_count + scene->box_count)
        return (double)rt__meet_other(scene, number, &p->ray, t_max);
    const rt_box box = rt__column_box(row, column);
    return (double)rt__meet_box(&box, &p->ray, t_max);
}

/* rt__hit_shape, likewise. */
RT__INLINE bool rt__hit_column(const rt_scene *scene, const rt__found *found,
                               const rt__probe *p, rt_hit *hit)
{
    const rt_bvh_row *row = &scene->bvh->rows[found->leaf >> 2];
    const int number = found->best.number, kind = found->leaf & 3;
    const int box = number - scene->sphere_count;
    if (kind == RT__SPHERES) {
        const rt_sphere sphere = rt__column_sphere(row, found->column);
        if (!rt__hit_sphere_at(&sphere, &p->ray, found->t, hit))
            return false;
        hit->material = &scene->spheres[number].material;
        hit->shape = number;
        return true;
    }
    if (kind == RT__TRIANGLES) {
        const rt__corners corners = rt__column_corners(row, found->column);
        const rt__other other = rt__other_of(scene, number);
        rt__hit_corners(&corners, &p->ray, found->t, found->weights, hit);
        hit->material = &scene->meshes[other.mesh].material;
        hit->shape = scene->sphere_count + scene->box_count + other.mesh;
        hit->part = other.part;
        rt__draw_in(&corners, hit);
        return true;
    }
    if (box >= scene->box_count)
        return rt__hit_other(scene, number, &p->ray, hit);
    const rt_box copy = rt__column_box(row, found->column);
    if (!rt_hit_box(&copy, &p->ray, FLT_MAX, hit))
        return false;
    rt__pull_back(&p->ray, hit);
    hit->material = &scene->boxes[box].material;
    hit->shape = number;
    return true;
}

/* rt__ask_leaf: all shapes in float, then the few that may be met in double. */
RT__INLINE bool rt__ask_rows(const rt_scene *scene, int leaf, const rt__probe *p,
                             bool any, rt__found *found)
{
    const rt_bvh_row *row = &scene->bvh->rows[leaf >> 2];
    const int kind = leaf & 3;
    const float t_max = found->best.t;
    unsigned maybe = 0;
    for (int k = 0; k < 8; k += RT__STEP)
        maybe |= (kind == RT__TRIANGLES ? rt__near_triangles(row, p, k)
                  : kind == RT__SPHERES ? rt__near_spheres(row, p, t_max, k)
                                        : rt__near_boxes(row, p, t_max, k))
                 << k;
    maybe &= rt__columns(row);
    for (; maybe != 0; maybe &= maybe - 1u) {
        const int k = rt__lowest(maybe), number = row->number[k];
        const float limit = any ? t_max : rt__beyond(found->best.t);
        rt_dvec3 weights;
        const double t = rt__meet_column(scene, row, kind, k, p, limit, &weights);
        if (any && t > 0.0)
            return true;
        if (rt__is_better(&found->best, number, (float)t)) {
            found->t = t;
            if (kind == RT__TRIANGLES)
                found->weights = weights;
            found->leaf = leaf;
            found->column = k;
            found->best.number = number;
            found->best.t = (float)t;
        }
    }
    return false;
}

/* What waits: like rt__item, but in two arrays. They have room for eight more, which are
 * written at once though only some of them count. */
typedef struct rt__stack {
    float t[RT__WAITING + 8];
    int inside[RT__WAITING + 8];
    int count;
} rt__stack;

#if RT__LANES > 4
#if RT__LANES == 8
/* For each of 256 masks: the places of its ones, from the lowest up, three bits each. */
#define RT__ONES(m)                                                                      \
    (((m)&1u) + ((m) >> 1 & 1u) + ((m) >> 2 & 1u) + ((m) >> 3 & 1u) + ((m) >> 4 & 1u) +  \
     ((m) >> 5 & 1u) + ((m) >> 6 & 1u))
#define RT__ONE(m, k) (((m) >> (k)&1u) * (k##u << 3 * RT__ONES((m) & ((1u << (k)) - 1u))))
#define RT__PLACES(m)                                                                    \
    (RT__ONE(m, 1) | RT__ONE(m, 2) | RT__ONE(m, 3) | RT__ONE(m, 4) | RT__ONE(m, 5) |     \
     RT__ONE(m, 6) | RT__ONE(m, 7))
#define RT__PLACES4(m)                                                                   \
    RT__PLACES(m), RT__PLACES((m) + 1u), RT__PLACES((m) + 2u), RT__PLACES((m) + 3u)
#define RT__PLACES16(m)                                                                  \
    RT__PLACES4(m), RT__PLACES4((m) + 4u), RT__PLACES4((m) + 8u), RT__PLACES4((m) + 12u)
#define RT__PLACES64(m)                                                                  \
    RT__PLACES16(m), RT__PLACES16((m) + 16u), RT__PLACES16((m) + 32u),                   \
        RT__PLACES16((m) + 48u)
static const uint32_t rt__places[256] = {RT__PLACES64(0u), RT__PLACES64(64u),
                                         RT__PLACES64(128u), RT__PLACES64(192u)};
#endif

RT__INLINE __m256i rt__unpack(uint32_t places)
{
    return _mm256_srlv_epi32(_mm256_set1_epi32((int)places),
                             _mm256_setr_epi32(0, 3, 6, 9, 12, 15, 18, 21));
}

/* Enter a node. *met: is a box met? Returns what is inside the first; the others go onto
 * the stack, the next one last. They go all at once, since no core can predict how often
 * a loop over them would run. If any hit will do, so does any order. */
RT__INLINE int rt__enter_node(rt__stack *stack, const rt_bvh_node *node,
                              const rt__probe *p, float t_max, bool any, bool *met)
{
    rt__boxes t, out;
    rt__enter_boxes(node, p, t_max, 0, &t, &out);
    unsigned in = rt__bat_most(t, out);
    *met = in != 0;
    if (in == 0)
        return 0;
    if ((in & (in - 1u)) == 0)
        return node->inside[__builtin_ctz(in)];
    __m256i inside = _mm256_loadu_si256((const __m256i *)(const void *)node->inside);
    uint32_t places = 0;
    if (!any) {
        memcpy(&places, node->order + 3 * p->octant, sizeof places);
        const __m256i order = rt__unpack(places);
        t = (rt__boxes)_mm256_permutevar8x32_ps((__m256)t, order);
        out = (rt__boxes)_mm256_permutevar8x32_ps((__m256)out, order);
        inside = _mm256_permutevar8x32_epi32(inside, order);
        in = rt__bat_most(t, out);
    }
    int next;
    if (any) {
        next = node->inside[__builtin_ctz(in)];
        in &= in - 1u;
    } else {
        const int last = 31 - __builtin_clz(in);
        next = node->inside[places >> 3 * last & 7u];
        in ^= 1u << last;
    }
#if RT__LANES == 8
    const __m256i places_in = rt__unpack(rt__places[in]);
    const __m256 t_in = _mm256_permutevar8x32_ps((__m256)t, places_in);
    const __m256i inside_in = _mm256_permutevar8x32_epi32(inside, places_in);
#else
    const __m256 t_in = _mm256_maskz_compress_ps((__mmask8)in, (__m256)t);
    const __m256i inside_in = _mm256_maskz_compress_epi32((__mmask8)in, inside);
#endif
    _mm256_storeu_ps(stack->t + stack->count, t_in);
    _mm256_storeu_si256((__m256i *)(void *)(stack->inside + stack->count), inside_in);
    stack->count += __builtin_popcount(in);
    return next;
}
#else
RT__INLINE int rt__enter_node(rt__stack *stack, const rt_bvh_node *node,
                              const rt__probe *p, float t_max, bool any, bool *met)
{
    rt__boxes t[8 / RT__STEP], out;
    unsigned in = 0;
    for (int k = 0; k < 8; k += RT__STEP) {
        rt__enter_boxes(node, p, t_max, k, &t[k / RT__STEP], &out);
        in |= rt__bat_most(t[k / RT__STEP], out) << k;
    }
    uint32_t order;
    memcpy(&order, node->order + 3 * p->octant, sizeof order);
    (void)any;
    for (int i = 0; i < 8; i++, order >>= 3) {
        const unsigned k = order & 7u;
        stack->t[stack->count] = t[k / RT__STEP][k % RT__STEP];
        stack->inside[stack->count] = node->inside[k];
        stack->count += (int)(in >> k & 1u);
    }
    *met = in != 0;
    stack->count -= *met;
    return stack->inside[stack->count];
}
#endif

/* rt__search; but boxes come in the order of the octant, not of t, and the next one does
 * not pass through the stack. */
RT__INLINE bool rt__search_rows(const rt_scene *scene, const rt__probe *p, bool any,
                                rt__found *found)
{
    const rt_bvh_node *nodes = scene->bvh->nodes;
    rt__stack stack;
    int inside = 0;
    bool met;
    stack.count = 0;
    for (;;) {
        inside = rt__enter_node(&stack, nodes - inside, p, found->best.t, any, &met);
        while (!met || inside >= 0) {
            if (met && rt__ask_rows(scene, inside, p, any, found))
                return true;
            do {
                if (stack.count == 0)
                    return found->best.number >= 0;
                stack.count--;
            } while (stack.t[stack.count] > found->best.t);
            inside = stack.inside[stack.count];
            met = true;
        }
    }
}

/* The nearest hit, of a ray that is fit. */
RT__NOINLINE bool rt__nearest_of(const rt_scene *scene, const rt__probe *p, float t_max,
                                 rt_hit *hit)
{
    rt__found found;
    found.best.number = -1;
    found.weights = rt_dvec(0.0, 0.0, 0.0);
    found.best.t = t_max;
    return rt__search_rows(scene, p, false, &found) &&
           rt__hit_column(scene, &found, p, hit);
}

RT__NOINLINE bool rt__any_of(const rt_scene *scene, const rt__probe *p, float t_max)
{
    rt__found found;
    found.best.number = -1;
    found.best.t = t_max;
    return rt__search_rows(scene, p, true, &found);
}

/* rt__intersect_bvh and rt__occluded_bvh, for rays in lanes. */
RT__NOINLINE bool rt__nearest_in_tree(const rt_scene *scene, const rt_ray *ray,
                                      rt_hit *hit)
{
    rt__probe p;
    return rt__set_probe(&p, scene, ray) ? rt__nearest_of(scene, &p, FLT_MAX, hit)
                                         : rt__intersect_bvh(scene, ray, hit);
}

RT__NOINLINE bool rt__any_in_tree(const rt_scene *scene, const rt_ray *ray)
{
    rt__probe p;
    return rt__set_probe(&p, scene, ray) ? rt__any_of(scene, &p, 1.0f)
                                         : rt__occluded_bvh(scene, ray, 1.0f);
}

/* For callers with one ray. Only rays that are almost parallel to an axis raise
 * exceptions that the chapters do not, since products may overflow. For those, traps are
 * off and the flags are restored. (The empty instructions keep the search in between.) */
static bool rt__search_alone(const rt_scene *scene, const rt_ray *ray, float t_max,
                             rt_hit *hit)
{
    rt__probe p;
    if (!rt__set_probe(&p, scene, ray)) {
        const int number = rt__search(scene, ray, t_max, !hit);
        return number >= 0 && (!hit || rt__hit_shape(scene, number, ray, 0.0, hit));
    }
    if (rt__within(p.inverse, -1e22f, 1e22f))
        return hit ? rt__nearest_of(scene, &p, t_max, hit) : rt__any_of(scene, &p, t_max);
    fenv_t before;
    feholdexcept(&before);
    __asm__ volatile("" : "+r"(scene) : : "memory");
    int found =
        hit ? rt__nearest_of(scene, &p, t_max, hit) : rt__any_of(scene, &p, t_max);
    __asm__ volatile("" : "+r"(found) : : "memory");
    fesetenv(&before);
    return found != 0;
}

RT__INLINE rt_vec3 rt__lane(const rt__f3 *v, int lane)
{
    return rt_vec(v->x[lane], v->y[lane], v->z[lane]);
}

RT__INLINE void rt__set_lane(rt__f3 *v, int lane, rt_vec3 to)
{
    v->x[lane] = to.x;
    v->y[lane] = to.y;
    v->z[lane] = to.z;
}

/* rt_intersect, one ray after the other: for many shapes, and for lanes in doubt. A new
 * kind of shape that is rare would be asked here, too. */
RT__NOINLINE void rt__find_in_tree(const rt_scene *scene, const rt__f3 *origin,
                                   const rt__f3 *direction, unsigned lanes,
                                   rt__hits *hits)
{
    for (; lanes != 0; lanes &= lanes - 1u) {
        const int lane = rt__lowest(lanes);
        rt_ray ray;
        rt_hit hit;
        ray.origin = rt__lane(origin, lane);
        ray.direction = rt__lane(direction, lane);
        hits->kind[lane] = -1.0f;
        if (!rt__nearest_in_tree(scene, &ray, &hit))
            continue;
        hits->kind[lane] = hit.material->mirror ? 1.0f : 0.0f;
        hits->left[lane] = RT__NOWHERE;
        hits->t[lane] = hit.t;
        hits->shape[lane] = hit.shape;
        hits->inside[lane] = hit.inside;
        rt__set_lane(&hits->point, lane, hit.point);
        rt__set_lane(&hits->normal, lane, hit.normal);
        rt__set_lane(&hits->albedo, lane, hit.material->albedo);
    }
}

/* rt_occluded likewise, up to the light at t = 1. */
RT__NOINLINE rt__m rt__shade_in_tree(const rt_scene *scene, const rt__f3 *origin,
                                     const rt__f3 *direction, unsigned lanes)
{
    rt__f blocked = {0.0f};
    for (; lanes != 0; lanes &= lanes - 1u) {
        const int lane = rt__lowest(lanes);
        rt_ray ray;
        ray.origin = rt__lane(origin, lane);
        ray.direction = rt__lane(direction, lane);
        if (rt__any_in_tree(scene, &ray))
            blocked[lane] = 1.0f;
    }
    return rt__less(rt__all(0.0f), blocked);
}

/* ---- chapter 4: shadows ---------------------------------------------------------- */

/* Which lanes do not see the light at t = 1? */
typedef struct rt__shade {
    rt__m sure, may;
} rt__shade;

/* A sphere that a ray may start in, or end in. f(t) = a t^2 + 2 b t + c is negative
 * inside it, f(0) = c, f(1) = a + 2b + c: if one end is inside and the other is not, the
 * way crosses the surface. If both are outside, rt__shade_all tells. */
RT__INLINE void rt__shade_near(const rt__table *s, const rt__place *p, int i, rt__f b,
                               rt__f a, rt__shade *shade)
{
    const rt__f zero = rt__all(0.0f), bb = b * b;
    const rt__f size = p->size + s->size[i], doubt = size * size, twice = doubt + doubt;
    const rt__i here = (rt__i)zero + i;
    const rt__m left = rt__same(p->left, here);
    const rt__f c = p->low[i] + doubt, end = rt__fma(b, rt__all(2.0f), a) + c;
    const rt__f start = rt__select(rt__same(p->left, ~here), -2.0f * twice, c);
    const rt__m unclear = rt__less(rt__abs(start), twice) | rt__less(rt__abs(end), twice);
    const rt__m from = rt__less(start, zero), to = rt__less(end, zero);
    const rt__m ahead = rt__no(from | to) & rt__less(b, zero) & rt__less(-a, b);
    const rt__m sure = (from ^ to) | rt__and_less(ahead, a * (c + doubt), bb);
    const rt__m may = unclear | rt__and_less(ahead, a * (c - doubt), bb);
    shade->sure |= sure & rt__no(unclear | left);
    shade->may |= may & rt__no(left);
}

/* rt_occluded up to t = 1, of a scene with few shapes. No root is needed: where both ends
 * are outside, the sphere is in the way if the point nearest to its centre, t = -b/a, is
 * on it and inside, b^2 / a > c. (Both are outside by more than doubt; otherwise the
 * sphere is beside a ray: see rt__start_at. The end is the light but for the rounding of
 * u.) */
RT__INLINE rt__shade rt__shade_all(const rt__table *s, const rt__place *p, rt__f3 u)
{
    const rt__f a = rt__dot(u, u), cu = rt__dot(p->origin, u), zero = rt__all(0.0f);
    const rt__f over_a = 1.0f / a, minus_a = -a;
    const rt__m none = {0};
    rt__shade shade;
    shade.sure = shade.may = none;
    for (int i = 0; i < s->spheres; i++) {
        const rt__f b = rt__b(s, i, u, cu), bb_over_a = b * b * over_a;
        if (__builtin_expect(p->any_beside, 0) && p->beside[i]) {
            rt__shade_near(s, p, i, b, a, &shade);
            continue;
        }
        const rt__m ahead = rt__and_less(rt__less(b, zero), minus_a, b);
        const rt__f size = p->size + s->size[i], low = p->low[i];
        const rt__f high = rt__fma(size + size, size, low); /* c + doubt */
        shade.may |= rt__and_less(ahead, low, bb_over_a);
        shade.sure |= rt__and_less(ahead, high, bb_over_a);
    }
    if (s->spheres == s->count)
        return shade;
    const rt__slab_rays r = rt__for_boxes(p->origin, u);
    for (int i = s->spheres; i < s->count; i++) {
        rt__f t_in, t_out, doubt;
        rt__slab(s, i, &r, &t_in, &t_out, &doubt);
        const rt__f t = rt__select(rt__less(zero, t_in), t_in, t_out);
        const rt__m unclear = r.parallel | rt__less(rt__abs(t_out - t_in), doubt) |
                              rt__less(rt__abs(t - 1.0f), rt__all(8.0f * FLT_EPSILON));
        const rt__m blocks = rt__no(rt__less(t_out, t_in)) & rt__less(zero, t) &
                             rt__less(t, rt__all(1.0f));
        shade.sure |= blocks & rt__no(unclear);
        shade.may |= unclear;
    }
    return shade;
}

/* rt_leave, where <N,direction> < 0 in the lanes below. */
RT__INLINE rt__f3 rt__leave(rt__f3 point, rt__f3 normal, rt__m below)
{
    const rt__f size = rt__fmax(rt__fmax(rt__all(1.0f), rt__abs(point.x)),
                                rt__fmax(rt__abs(point.y), rt__abs(point.z)));
    const rt__f offset = size * (8.0f * FLT_EPSILON);
    return rt__add(point, rt__scale(normal, rt__select(below, -offset, offset)));
}

/* rt_visible: of the lit lanes, those with the light in front of the surface, which do
 * not see it? Rays start at the place. */
RT__INLINE rt__m rt__unseen(const rt__job *job, const rt__place *p, rt__m lit,
                            rt__f3 normal, rt__f3 light)
{
    const rt__f zero = rt__all(0.0f);
    const rt__f3 u = rt__sub(light, p->origin);
    const rt__m none = {0};
    rt__shade shade;
    shade.sure = none;
    shade.may = lit;
    if (job->table->few) { /* a light nearer than rt_leave's step is behind the ray */
        const rt__m behind = rt__less(rt__dot(normal, u), zero);
        shade = rt__shade_all(job->table, p, u);
        shade.sure &= rt__no(behind);
        shade.may |= behind;
        const rt__f end = rt__all(1.0f);
        if (job->table->count < job->table->all)
            shade.may |= rt__near_others(job->table, &p->origin, &u, &end);
    }
    const rt__m ask = lit & shade.may & rt__no(shade.sure);
    if (rt__any(ask))
        shade.sure |= rt__shade_in_tree(job->scene, &p->origin, &u, rt__bits(ask));
    return shade.sure;
}

/* rt_lambert, where the light is in front: the part of it that is sent on, or 0. */
RT__INLINE rt__f rt__lambert(rt__f toward, rt__f dd, rt__m *counts)
{
    *counts &= rt__less(rt__all(1e-20f), dd);
    *counts &= rt__no(rt__less(rt__all(FLT_MAX), dd));
    return toward / rt__fsqrt(dd) / (3.14159265359f * dd);
}

/* rt_direct, with rt_visible and rt_lambert. */
RT__INLINE rt__f3 rt__light(const rt__job *job, const rt__place *p, rt__m lanes,
                            const rt__hits *hits, uint64_t *rays)
{
    const rt_scene *scene = job->scene;
    const rt__f zero = rt__all(0.0f);
    rt__f3 sum = rt__vec(zero, zero, zero);
    for (int i = 0; i < scene->light_count; i++) {
        const rt__f3 position = rt__vall(scene->lights[i].position);
        const rt__f3 to_light = rt__sub(position, hits->point);
        const rt__f toward = rt__dot(hits->normal, to_light);
        const rt__m lit = lanes & rt__less(zero, toward);
        if (!rt__any(lit))
            continue;
        *rays += rt__count(lit);
        rt__m counts = lit & rt__no(rt__unseen(job, p, lit, hits->normal, position));
        const rt__f part = rt__lambert(toward, rt__dot(to_light, to_light), &counts);
        const rt__f3 light =
            rt__scale(rt__mul(hits->albedo, rt__vall(scene->lights[i].intensity)), part);
        sum = rt__vselect(counts, rt__add(sum, light), sum);
    }
    return sum;
}

/* ---- chapters 7 and 9: random numbers, directions -------------------------------- */

/* rt_hash. */
RT__INLINE rt__u rt__mix(rt__u v)
{
    const rt__u state = v * 747796405u + 2891336453u;
    const rt__u word = ((state >> ((state >> 28) + 4u)) ^ state) * 277803737u;
    return (word >> 22) ^ word;
}

/* rt__reverse. */
RT__INLINE rt__u rt__backwards(rt__u v)
{
    v = v << 16 | v >> 16;
    v = (v & 0x00ff00ffu) << 8 | (v >> 8 & 0x00ff00ffu);
    v = (v & 0x0f0f0f0fu) << 4 | (v >> 4 & 0x0f0f0f0fu);
    v = (v & 0x33333333u) << 2 | (v >> 2 & 0x33333333u);
    return (v & 0x55555555u) << 1 | (v >> 1 & 0x55555555u);
}

/* rt__scramble. */
RT__INLINE rt__u rt__owen(rt__u v, rt__u key)
{
    v ^= v * 0x3d20adeau;
    v += key;
    v *= (key >> 16) | 1u;
    v ^= v * 0x05526c56u;
    return v ^ v * 0x53a22864u;
}

typedef struct rt__numbers {
    rt__u key, dimension;
    rt__u sample; /* its bits in reverse order */
    bool sobol;
} rt__numbers;

RT__INLINE rt__f rt__to_unit(rt__u bits)
{
    return (__builtin_convertvector((rt__i)(bits >> 9), rt__f) + 0.5f) *
           (1.0f / 8388608.0f);
}

/* rt_random, twice, and rt__sobol with rt__second: all numbers are drawn in pairs. */
RT__INLINE void rt__draw(const rt__numbers *n, rt__f *r1, rt__f *r2)
{
    rt__u first, second;
    if (n->sobol) {
        const rt__u key = rt__mix(n->key + (n->dimension >> 1));
        rt__u index = rt__backwards(rt__owen(n->sample, key));
        first = rt__backwards(rt__owen(index, rt__mix(key + 1u)));
        index ^= index >> 16 & 0x0000ffffu;
        index ^= index >> 8 & 0x00ff00ffu;
        index ^= index >> 4 & 0x0f0f0f0fu;
        index ^= index >> 2 & 0x33333333u;
        index ^= index >> 1 & 0x55555555u;
        second = rt__backwards(rt__owen(index, rt__mix(key + 2u)));
    } else {
        first = rt__mix(n->key + n->dimension);
        second = rt__mix(n->key + n->dimension + 1u);
    }
    *r1 = rt__to_unit(first);
    *r2 = rt__to_unit(second);
}

/* rt_sincos of turns in [0, 1]. */
RT__INLINE void rt__sincos(rt__f turns, rt__f *sine, rt__f *cosine)
{
    const rt__i quarter = __builtin_convertvector(turns * 4.0f + 0.5f, rt__i);
    const rt__f x =
        (turns * 4.0f - __builtin_convertvector(quarter, rt__f)) * 1.57079632679f;
    const rt__f xx = x * x;
    const rt__f s3 = -1.6666654611e-1f + xx * (8.3321608736e-3f - xx * 1.9515295891e-4f);
    const rt__f c4 = 4.1666645683e-2f + xx * (-1.3887316255e-3f + xx * 2.4433157118e-5f);
    const rt__f s = x + x * xx * s3, c = 1.0f + (xx * xx * c4 - 0.5f * xx);
    const rt__m even = rt__same(quarter & 1, quarter & 0);
    *sine = (rt__f)((rt__i)rt__select(even, s, c) ^ ((quarter & 2) << 30)); /* its sign */
    *cosine = (rt__f)((rt__i)rt__select(even, c, s) ^ (((quarter + 1) & 2) << 30));
}

/* rt_basis. */
RT__INLINE void rt__basis(rt__f3 n, rt__f3 *a, rt__f3 *b)
{
    const rt__f one = rt__all(1.0f);
    const rt__f sign = rt__select(rt__less(n.z, one - one), -one, one);
    const rt__f k = -1.0f / (sign + n.z), m = n.x * n.y * k;
    *a = rt__vec(1.0f + sign * n.x * n.x * k, sign * m, -sign * n.x);
    *b = rt__vec(m, sign + n.y * n.y * k, -n.y);
}

/* rt_sample_cosine. */
RT__INLINE rt__f3 rt__cosine(rt__f3 n, rt__f r1, rt__f r2)
{
    rt__f sine, cosine;
    rt__f3 a, b;
    rt__sincos(r1, &sine, &cosine);
    rt__basis(n, &a, &b);
    const rt__f radius = rt__fsqrt(1.0f - r2);
    return rt__add(rt__add(rt__scale(a, cosine * radius), rt__scale(b, sine * radius)),
                   rt__scale(n, rt__fsqrt(r2)));
}

/* ---- the whole path -------------------------------------------------------------- */

/* A packet on its way. A lane whose path has ended stays until the last path ends. */
typedef struct rt__packet {
    rt__m lanes; /* in which the path goes on */
    rt__f3 direction, sum, throughput;
    rt__numbers numbers;
    rt__hits hits;
    rt__place place;
    rt__m looking; /* whose guide is wanted, and not there yet; */
    rt__m alone;   /* or not to be found on this path */
    rt__f3 guide_normal, guide_point, guide_albedo, guide_direct;
    rt__f3 from;   /* part two: the point that the ray has left, and the density */
    rt__f density; /* of its direction, 0: there was no choice */
} rt__packet;

/* rt_radiance, its loop in three parts. First the nearest hit, ... */
RT__INLINE void rt__extend(const rt__job *job, rt__packet *p)
{
    if (job->table->few)
        rt__find(job, &p->place, p->direction, p->lanes, &p->hits);
    else
        rt__find_in_tree(job->scene, &p->place.origin, &p->direction, rt__bits(p->lanes),
                         &p->hits);
}

/* The next rays start where this one hit; in the lanes below, behind the surface. */
RT__INLINE void rt__set_out(const rt__job *job, rt__packet *p, rt__m below)
{
    const rt__i nowhere = (p->hits.left & 0) + RT__NOWHERE;
    rt__start_at(job->table, &p->place, rt__leave(p->hits.point, p->hits.normal, below),
                 rt__iselect(below, nowhere, p->hits.left));
}

/* The first look of these lanes ends at a light that they see, ... */
RT__INLINE void rt__see_light(rt__packet *p, rt__m lanes, rt__f3 direct)
{
    lanes &= p->looking;
    p->looking &= rt__no(lanes);
    p->guide_direct = rt__vselect(lanes, direct, p->guide_direct);
}

/* ... or at a surface. */
RT__INLINE void rt__see_surface(rt__packet *p, rt__m lanes, rt__f3 albedo, rt__f3 direct)
{
    lanes &= p->looking;
    p->guide_normal = rt__vselect(lanes, p->hits.normal, p->guide_normal);
    p->guide_point = rt__vselect(lanes, p->hits.point, p->guide_point);
    p->guide_albedo = rt__vselect(lanes, rt__mul(p->throughput, albedo), p->guide_albedo);
    rt__see_light(p, lanes, direct);
}

/* In which lanes the first look ends there: on all but mirrors, and once it has gone far
 * enough. */
RT__INLINE rt__m rt__looked(const rt__job *job, const rt__packet *p, int bounce,
                            rt__m mirror)
{
    const bool last = bounce >= job->options.bounces || bounce >= RT__ROULETTE;
    return last ? p->lanes : p->lanes & rt__no(mirror);
}

/* rt_first_look, as part of the path. Where the path ends earlier, because no light is
 * left in it, the guide is still wanted: see rt__guides_of. */
RT__NOINLINE void rt__look_first(const rt__job *job, rt__packet *p, int bounce,
                                 rt__m missed, const rt__f3 *light)
{
    const rt__f one = rt__all(1.0f), zero = one - one;
    const rt__f3 rho = p->hits.albedo, white = rt__vec(one, one, one);
    const rt__m mirror = rt__less(zero, p->hits.kind);
    const rt__m clear =
        mirror & rt__no(rt__less(zero, rt__fmax(rho.x, rt__fmax(rho.y, rho.z))));
    rt__see_light(p, missed, rt__mul(p->throughput, rt__vall(job->scene->background)));
    rt__see_surface(p, rt__looked(job, p, bounce, mirror), rt__vselect(clear, white, rho),
                    rt__mul(p->throughput, *light));
}

/* ... then background and direct light, ... */
RT__INLINE void rt__collect(const rt__job *job, rt__packet *p, int bounce, uint64_t *rays)
{
    const rt__hits *hits = &p->hits;
    const rt__f zero = rt__all(0.0f);
    const rt__m none = {0};
    const rt__m missed = p->lanes & rt__less(hits->kind, zero);
    if (rt__any(missed)) {
        const rt__f3 light = rt__mul(p->throughput, rt__vall(job->scene->background));
        p->sum = rt__vselect(missed, rt__add(p->sum, light), p->sum);
        p->lanes &= rt__no(missed);
    }
    rt__set_out(job, p, none);
    const rt__m diffuse = p->lanes & rt__no(rt__less(zero, hits->kind));
    const rt__f3 light = rt__light(job, &p->place, diffuse, hits, rays);
    p->sum = rt__vselect(diffuse, rt__add(p->sum, rt__mul(p->throughput, light)), p->sum);
    if (rt__any(p->looking))
        rt__look_first(job, p, bounce, missed, &light);
}

/* Does it go on? rt__is_spent, rt__chance and the roulette. */
RT__INLINE void rt__go_on(const rt__job *job, rt__packet *p, int bounce)
{
    const rt__f most =
        rt__fmax(p->throughput.x, rt__fmax(p->throughput.y, p->throughput.z));
    p->lanes &= rt__no(rt__less(most, rt__all(FLT_MIN)));
    if (job->options.bounces == RT_ALL_BOUNCES && bounce >= RT__ROULETTE) {
        const rt__f chance = rt__fmin(most, rt__all(0.95f));
        rt__f r1, r2;
        rt__draw(&p->numbers, &r1, &r2);
        p->numbers.dimension += 2u;
        p->lanes &= rt__less(r1, chance);
        p->throughput = rt__scale(p->throughput, 1.0f / chance);
    }
}

/* ... and the way on. A new kind of material would compute its direction here, for all
 * lanes, and add one more select; a rare one would ask its chapter's function, lane by
 * lane. */
RT__INLINE void rt__bounce(const rt__job *job, rt__packet *p, int bounce)
{
    const rt__f zero = rt__all(0.0f);
    const rt__f3 n = p->hits.normal, u = p->direction, rho = p->hits.albedo;
    const rt__m mirror = rt__less(zero, p->hits.kind);
    const rt__i two = (rt__i)zero + 2;
    rt__f r1, r2;
    rt__draw(&p->numbers, &r1, &r2);
    p->numbers.dimension += (rt__u)rt__iselect(mirror, two - 2, two);
    const rt__f un = rt__dot(u, n);
    const rt__f3 reflected = rt__sub(u, rt__scale(n, 2.0f * un));
    p->direction = rt__vselect(mirror, reflected, rt__cosine(n, r1, r2));
    const rt__m lossless =
        mirror & rt__no(rt__less(zero, rt__fmax(rho.x, rt__fmax(rho.y, rho.z))));
    p->throughput = rt__vselect(lossless, p->throughput, rt__mul(p->throughput, rho));
    rt__go_on(job, p, bounce);
    /* a reflection so flat that rounding may send it through the surface */
    const rt__m flat = p->lanes & mirror & rt__less(rt__abs(un), rt__all(1e-5f));
    if (__builtin_expect(rt__any(flat), 0))
        rt__set_out(job, p, rt__less(rt__dot(n, p->direction), zero));
}

/* Two packets at a time: while one waits for a root, the core works on the other. */
enum { RT__FLIGHT = 2 };

RT__INLINE uint64_t rt__trace(const rt__job *job, rt__packet *packets, int count,
                              rt_watch *watch)
{
    uint64_t rays = 0;
    for (int bounce = 0;; bounce++) {
        bool done = true;
        for (int k = 0; k < count; k++) {
            rays += rt__count(packets[k].lanes);
            rt__tick(watch);
            rt__extend(job, &packets[k]);
        }
        for (int k = 0; k < count; k++)
            rt__collect(job, &packets[k], bounce, &rays);
        if (bounce >= job->options.bounces)
            return rays;
        for (int k = 0; k < count; k++) {
            rt__bounce(job, &packets[k], bounce);
            done = done && !rt__any(packets[k].lanes);
        }
        if (done)
            return rays;
    }
}

/* ---- part two: chapters 11 to 15 -------------------------------------------------
 *
 * The same again for rt_radiance_mis: what goes beyond part one is computed for all lanes
 * as soon as one of them wants it. Patterns and skies are the user's functions, called
 * for one lane after the other. All lanes share the lamps, so the chapters' own functions
 * tell about those. */

/* The float at this offset in rt_surface, for these shapes: where there are many shapes,
 * one lane after the other; ... */
RT__NOINLINE rt__f rt__gather(const rt_surface *surfaces, size_t offset, rt__i shape,
                              unsigned lanes)
{
    rt__f result = {0.0f};
    for (; lanes != 0; lanes &= lanes - 1u) {
        const int lane = rt__lowest(lanes);
        float value;
        memcpy(&value, (const char *)&surfaces[shape[lane]] + offset, sizeof value);
        result[lane] = value;
    }
    return result;
}

/* ... otherwise from the table. */
RT__INLINE rt__f rt__of_surface(const rt__job *job, const float *column, size_t offset,
                                rt__i shape, rt__m lanes)
{
    return job->table->few
               ? rt__pick(column, shape, job->table->all)
               : rt__gather(job->scene->surfaces, offset, shape, rt__bits(lanes));
}

RT__INLINE rt__f3 rt__vof_surface(const rt__job *job, const rt__column *column,
                                  size_t offset, rt__i shape, rt__m lanes)
{
    const size_t y = offset + sizeof(float), z = y + sizeof(float);
    return rt__vec(rt__of_surface(job, column->x, offset, shape, lanes),
                   rt__of_surface(job, column->y, y, shape, lanes),
                   rt__of_surface(job, column->z, z, shape, lanes));
}

RT__INLINE rt__f3 rt__emission(const rt__job *job, const rt__hits *hits, rt__m lanes)
{
    return rt__vof_surface(job, &job->table->emission, offsetof(rt_surface, emission),
                           hits->shape, lanes);
}

static rt_hit rt__hit_of(const rt_scene *scene, const rt__hits *hits, int lane)
{
    const int number = hits->shape[lane];
    rt_hit hit;
    hit.t = hits->t[lane];
    hit.point = rt__lane(&hits->point, lane);
    hit.normal = rt__lane(&hits->normal, lane);
    hit.material = rt__material_of(scene, number);
    hit.shape = number;
    rt__only_part_one(&hit);
    hit.inside = hits->inside[lane] != 0;
    return hit;
}

/* rt_albedo, where there is a pattern. */
RT__NOINLINE void rt__patterns(const rt_scene *scene, const rt__hits *hits,
                               unsigned lanes, rt__f3 *albedo)
{
    for (; lanes != 0; lanes &= lanes - 1u) {
        const int lane = rt__lowest(lanes);
        const rt_hit hit = rt__hit_of(scene, hits, lane);
        const rt_surface *surface = &scene->surfaces[hit.shape];
        if (surface->pattern)
            rt__set_lane(albedo, lane, rt_albedo(surface, &hit));
    }
}

/* rt_sky. */
RT__NOINLINE rt__f3 rt__sky(const rt_scene *scene, const rt__f3 *direction,
                            unsigned lanes)
{
    rt__f3 light = rt__vall(scene->background);
    for (; scene->sky && lanes != 0; lanes &= lanes - 1u) {
        const int lane = rt__lowest(lanes);
        rt__set_lane(&light, lane, rt_sky(scene, rt__lane(direction, lane)));
    }
    return light;
}

/* rt_is_inside. */
RT__NOINLINE rt__m rt__inside(const rt__job *job, const rt__hits *hits, rt__m lanes)
{
    const rt__table *s = job->table;
    const rt__f zero = rt__all(0.0f);
    rt__f inside = zero;
    if (s->few && s->count == s->all) {
        const rt__f3 place = rt__vpick(&s->place, hits->shape, s->count);
        const rt__f3 max = rt__vpick(&s->max, hits->shape, s->count);
        const rt__m sphere = rt__less(zero, rt__pick(s->radius, hits->shape, s->count));
        const rt__f3 middle =
            rt__vselect(sphere, place, rt__scale(rt__add(place, max), rt__all(0.5f)));
        return rt__less(rt__dot(rt__sub(hits->point, middle), hits->normal), zero);
    }
    for (unsigned left = rt__bits(lanes); left != 0; left &= left - 1u) {
        const int lane = rt__lowest(left);
        const rt_hit hit = rt__hit_of(job->scene, hits, lane);
        inside[lane] = rt_is_inside(job->scene, &hit) ? 1.0f : 0.0f;
    }
    return rt__less(zero, inside);
}

/* rt__exp_minus. */
RT__INLINE rt__f rt__exponential(rt__f x)
{
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f), most = rt__all(87.0f);
    const rt__m large = rt__no(rt__less(x, most)), positive = rt__less(zero, x);
    const rt__f v = rt__select(positive & rt__no(large), x, zero);
    const rt__i k = __builtin_convertvector(v * 1.44269504089f + 0.5f, rt__i);
    const rt__f whole = __builtin_convertvector(k, rt__f);
    const rt__f r = (whole * 0.693359375f - v) - whole * 2.12194440e-4f;
    rt__f e = r * 1.9875691500e-4f + 1.3981999507e-3f;
    e = e * r + 8.3334519073e-3f;
    e = e * r + 4.1665795894e-2f;
    e = e * r + 1.6666665459e-1f;
    e = e * r + 5.0000001201e-1f;
    e = e * r * r + r + 1.0f;
    e = e * (rt__f)((127 - k) << 23);
    return rt__select(positive, rt__select(large, zero, e), one);
}

/* Glass: rt_transmittance, rt_fresnel, rt_refract and the coin. */
RT__NOINLINE rt__m rt__through_glass(const rt__job *job, rt__packet *p, rt__m glass,
                                     rt__f eta, rt__f coin, rt__f3 *direction)
{
    const rt__hits *hits = &p->hits;
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f);
    const rt__f3 n = hits->normal, u = p->direction;
    const rt__m inside = rt__inside(job, hits, glass) & glass;
    if (rt__any(inside)) {
        const rt__f3 a =
            rt__vof_surface(job, &job->table->absorption,
                            offsetof(rt_surface, absorption), hits->shape, inside);
        const rt__f3 left =
            rt__vec(rt__exponential(a.x * hits->t), rt__exponential(a.y * hits->t),
                    rt__exponential(a.z * hits->t));
        p->throughput = rt__vselect(inside, rt__mul(p->throughput, left), p->throughput);
        eta = rt__select(inside, one / eta, eta);
    }
    const rt__f cosine = zero - rt__dot(n, u);
    const rt__f sin2 = (one - cosine) * (one + cosine) / (eta * eta);
    const rt__f cos2 = rt__fsqrt(one - sin2); /* NaN: total reflection */
    const rt__f across = (eta * cosine - cos2) / (eta * cosine + cos2);
    const rt__f along = (cosine - eta * cos2) / (cosine + eta * cos2);
    const rt__f fresnel = 0.5f * (across * across + along * along);
    const rt__m through = glass & rt__less(sin2, one) & rt__no(rt__less(coin, fresnel));
    const rt__f3 refracted =
        rt__add(rt__scale(u, one / eta), rt__scale(n, cosine / eta - cos2));
    *direction = rt__vselect(through, refracted, *direction);
    return through;
}

/* rt_mis. */
RT__INLINE rt__f rt__mis(rt__f density, rt__f other)
{
    const rt__f ratio = other / density;
    return rt__select(rt__less(1e-15f * other, density), 1.0f / (1.0f + ratio * ratio),
                      rt__all(0.0f));
}

/* rt__unit. */
RT__INLINE rt__f3 rt__unity(rt__f3 v)
{
    const rt__f dd = rt__dot(v, v);
    return rt__scale(v, rt__select(rt__less(rt__all(1e-20f), dd), 1.0f / rt__fsqrt(dd),
                                   rt__all(0.0f)));
}

RT__INLINE rt__f3 rt__cross(rt__f3 a, rt__f3 b)
{
    return rt__vec(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

/* rt__cap: rr is the square of the radius, dd that of the distance to the centre. */
RT__INLINE rt__f rt__caps(float rr, rt__f dd)
{
    const rt__f s = rr / dd, all = rt__all(rr);
    const rt__m good = rt__less(all, dd) & rt__less(1e-30f * dd, all);
    return rt__select(good, s / (1.0f + rt__fsqrt(1.0f - s)), rt__all(0.0f));
}

RT__INLINE rt__f rt__cap_density(rt__f cap)
{
    const rt__f zero = rt__all(0.0f);
    return rt__select(rt__less(zero, cap), 1.0f / (6.28318530718f * cap), zero);
}

/* rt_lamp_density. */
RT__INLINE rt__f rt__lamp_density(const rt_lamp *lamp, rt__f3 point, rt__f3 direction)
{
    const rt__f zero = rt__all(0.0f);
    const rt__f3 to_center = rt__sub(rt__vall(lamp->center), point);
    if (lamp->radius > 0.0f)
        return rt__cap_density(
            rt__caps(lamp->radius * lamp->radius, rt__dot(to_center, to_center)));
    const rt__f3 n = rt__vall(rt_normalize(rt_cross(lamp->u, lamp->v)));
    const float area = rt__lamp_area(lamp);
    const rt__f cosine = rt__abs(rt__dot(direction, n));
    const rt__f d = rt__dot(to_center, n) / cosine, dd = d * d;
    const rt__m good =
        rt__less(rt__all(1e-6f), cosine) & rt__less(dd * 1e-14f, rt__all(area));
    return rt__select(good, dd / area / cosine, zero);
}

/* rt_sample_lamp; then rt_lamp_density for the direction from P to S. */
RT__INLINE rt__f3 rt__aim(const rt_lamp *lamp, rt__f3 point, rt__f r1, rt__f r2,
                          rt__f3 *toward, rt__f *density)
{
    const rt__f zero = rt__all(0.0f);
    if (!(lamp->radius > 0.0f)) {
        const rt__f3 end =
            rt__add(rt__vall(lamp->center),
                    rt__add(rt__scale(rt__vall(lamp->u), 2.0f * r1 - 1.0f),
                            rt__scale(rt__vall(lamp->v), 2.0f * r2 - 1.0f)));
        *toward = rt__unity(rt__sub(end, point));
        *density = rt__lamp_density(lamp, point, *toward);
        return end;
    }
    const float rr = lamp->radius * lamp->radius;
    const rt__f3 to_center = rt__sub(rt__vall(lamp->center), point);
    const rt__f dd = rt__dot(to_center, to_center), d = rt__fsqrt(dd);
    const rt__f cap = rt__caps(rr, dd), down = r2 * cap;
    const rt__f sine = rt__fsqrt(down * (2.0f - down));
    const rt__f3 n = rt__scale(to_center, 1.0f / d);
    rt__f s, c;
    rt__f3 a, b;
    rt__sincos(r1, &s, &c);
    rt__basis(n, &a, &b);
    const rt__f3 direction =
        rt__add(rt__add(rt__scale(a, c * sine), rt__scale(b, s * sine)),
                rt__scale(n, 1.0f - down));
    const rt__f off = d * sine;
    const rt__f t = d * (1.0f - down) - rt__fsqrt(rt__fmax(rr - off * off, zero));
    const rt__f3 end = rt__add(point, rt__scale(direction, t));
    *toward = rt__unity(rt__sub(end, point));
    *density = rt__cap_density(cap);
    return end;
}

/* rt_meet_lamp of a ball, in double as in chapter 1, in these lanes; 0 in the others.
 * Rays from afar are left to it. */
RT__NOINLINE rt__f rt__meet_ball(const rt_lamp *lamp, const rt__f3 *origin,
                                 const rt__f3 *direction, rt__f t_max, rt__m lanes)
{
    const rt__f zero = rt__all(0.0f);
    const double r = (double)lamp->radius, rr = r * r;
    const rt__d none = {0.0};
    rt__d3 o;
    rt__d result[2];
    o.x = none + (double)lamp->center.x;
    o.y = none + (double)lamp->center.y;
    o.z = none + (double)lamp->center.z;
    for (int h = 0; h < 2; h++) {
        const rt__d3 u = rt__vwiden(*direction, h);
        const rt__d3 f = rt__dsub(rt__vwiden(*origin, h), o);
        const rt__d a = rt__ddot(u, u), b = rt__ddot(f, u), ff = rt__ddot(f, f);
        const rt__d c = ff - rr, discriminant = b * b - a * c;
        const rt__d root = rt__dsqrt(discriminant);
        const rt__d first = (-b - root) / a, second = (-b + root) / a;
        const rt__l ahead = first >= (double)FLT_MIN;
        const rt__d t = (rt__d)((ahead & (rt__l)first) | (~ahead & (rt__l)second));
        const rt__l met = (a > 0.0) & ~((c > 0.0) & (b >= 0.0)) & (discriminant >= 0.0) &
                          (t >= (double)FLT_MIN) & (t <= (double)FLT_MAX);
        const rt__l afar = rr < 1e-10 * ff;
        const rt__d minus = none - 1.0;
        result[h] = (rt__d)((afar & (rt__l)minus) | (~afar & met & (rt__l)t));
    }
    rt__f t = rt__join(result[0], result[1]);
    t = rt__select(lanes, t, zero);
    for (unsigned left = rt__bits(rt__less(t, zero)); left != 0; left &= left - 1u) {
        const int lane = rt__lowest(left);
        rt_ray ray;
        ray.origin = rt__lane(origin, lane);
        ray.direction = rt__lane(direction, lane);
        t[lane] = rt_meet_lamp(lamp, &ray, t_max[lane]);
    }
    return rt__select(rt__less(t, t_max), t, zero);
}

/* rt_meet_lamp of a parallelogram. */
RT__NOINLINE rt__f rt__meet_panel(const rt_lamp *lamp, const rt__f3 *origin,
                                  const rt__f3 *direction, rt__f t_max, rt__m lanes)
{
    const rt__f zero = rt__all(0.0f);
    const rt_vec3 n = rt_normalize(rt_cross(lamp->u, lamp->v));
    const rt_vec3 across_v = rt_cross(lamp->v, n), across_u = rt_cross(lamp->u, n);
    const rt__f most_u = rt__all(fabsf(rt_dot(lamp->u, across_v)));
    const rt__f most_v = rt__all(fabsf(rt_dot(lamp->v, across_u)));
    const rt__f3 center = rt__vall(lamp->center);
    const rt__f toward = rt__dot(*direction, rt__vall(n));
    const rt__f way = rt__dot(rt__sub(center, *origin), rt__vall(n)), t = way / toward;
    const rt__f3 p = rt__sub(rt__add(*origin, rt__scale(*direction, t)), center);
    const rt__f u = rt__abs(rt__dot(p, rt__vall(across_v)));
    const rt__f v = rt__abs(rt__dot(p, rt__vall(across_u)));
    const rt__m met = lanes & rt__less(1e-17f * rt__abs(way), rt__abs(toward)) &
                      rt__less(zero, t) & rt__less(t, t_max) &
                      (rt__less(u, most_u) | rt__same((rt__i)u, (rt__i)most_u)) &
                      (rt__less(v, most_v) | rt__same((rt__i)v, (rt__i)most_v));
    return rt__select(met, t, zero);
}

/* Those of the lanes whose ray may meet the ball. In float, |C - O|^2 and all else is
 * wrong by less than 2^-20 of itself: a ray that misses by more does miss. */
RT__INLINE rt__m rt__may_meet(const rt_lamp *lamp, rt__f3 origin, rt__f3 u, rt__m lanes)
{
    const float rr = lamp->radius * lamp->radius;
    const rt__f3 f = rt__sub(origin, rt__vall(lamp->center));
    const rt__f a = rt__dot(u, u), b = rt__dot(f, u), ff = rt__dot(f, f);
    const rt__f c = ff - rr, slack = (ff + rr) * 3.814697265625e-6f; /* 2^-18 */
    const rt__f zero = rt__all(0.0f);
    return lanes & rt__no(rt__less(b * b, a * (c - slack)) |
                          (rt__less(zero, b) & rt__less(slack, c)));
}

/* rt__nearest_lamp: its number, or -1 in lanes where there is none. */
RT__INLINE rt__i rt__nearest_lamps(const rt_scene *scene, const rt__f3 *origin,
                                   const rt__f3 *u, rt__m lanes, rt__f t_max, int but)
{
    const rt__f zero = rt__all(0.0f);
    const rt__i first = (rt__i)zero;
    rt__i nearest = first - 1;
    for (int i = 0; i < scene->lamp_count; i++) {
        const rt_lamp *lamp = &scene->lamps[i];
        const bool ball = lamp->radius > 0.0f;
        const rt__m may = i == but ? lanes & rt__no(lanes)
                          : ball   ? rt__may_meet(lamp, *origin, *u, lanes)
                                   : lanes;
        if (!rt__any(may))
            continue;
        const rt__f t = ball ? rt__meet_ball(lamp, origin, u, t_max, may)
                             : rt__meet_panel(lamp, origin, u, t_max, may);
        const rt__m met = rt__less(zero, t);
        t_max = rt__select(met, t, t_max);
        nearest = rt__iselect(met, first + i, nearest);
    }
    return nearest;
}

/* rt_surface and rt_brdf of the shapes that were hit, and which of the lanes ask the
 * lamps: all but glass and perfect mirrors. */
typedef struct rt__brdfs {
    rt__f3 albedo;
    rt__f eta, shininess;
    rt__m glass, metal, shiny, aims;
} rt__brdfs;

/* rt__brdf_of. */
RT__INLINE rt__brdfs rt__brdfs_of(const rt__job *job, const rt__hits *hits, rt__m lanes)
{
    const rt_scene *scene = job->scene;
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f);
    rt__brdfs f;
    f.metal = lanes & rt__less(zero, hits->kind);
    const rt__f most = rt__fmax(hits->albedo.x, rt__fmax(hits->albedo.y, hits->albedo.z));
    f.albedo = rt__vselect(f.metal & rt__no(rt__less(zero, most)), rt__vec(one, one, one),
                           hits->albedo);
    f.eta = f.shininess = zero;
    if (scene->surfaces) {
        f.eta = rt__of_surface(job, job->table->eta, offsetof(rt_surface, eta),
                               hits->shape, lanes);
        f.shininess = rt__of_surface(job, job->table->shininess,
                                     offsetof(rt_surface, shininess), hits->shape, lanes);
        if (job->table->patterns)
            rt__patterns(scene, hits, rt__bits(lanes), &f.albedo);
    }
    f.shiny = lanes & rt__less(zero, f.shininess);
    f.glass = lanes & rt__less(zero, f.eta);
    f.aims = lanes & rt__no(f.glass | (f.metal & rt__no(f.shiny)));
    return f;
}

/* rt__hidden. */
RT__INLINE rt__f rt__smith(rt__f cosine, rt__f a2)
{
    return cosine + rt__fsqrt(a2 + (1.0f - a2) * cosine * cosine);
}

/* 1 - rt__fifth_power, of 1 - cosine. */
RT__INLINE rt__f rt__fifth(rt__f cosine)
{
    const rt__f v = 1.0f - cosine;
    return v * v * v * v * v;
}

/* rt__lacquer. */
RT__INLINE rt__f rt__coat(rt__f cosine)
{
    return RT__LACQUER + (1.0f - RT__LACQUER) * rt__fifth(cosine);
}

/* rt__gloss_chance. */
RT__INLINE rt__f rt__chances(const rt__brdfs *f, rt__f eye)
{
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f), coat = rt__coat(eye);
    const rt__f chance = coat + 0.25f * (1.0f - coat);
    return rt__select(f->metal, one, rt__select(f->shiny, chance, zero));
}

/* rt_gloss and the rest of rt_scatter, where there is gloss. */
RT__INLINE rt__f3 rt__gloss(const rt__brdfs *f, rt__f3 n, rt__f3 to_eye, rt__f3 to_light,
                            rt__f *density)
{
    const rt__f zero = rt__all(0.0f);
    const rt__f a2 = 2.0f / (f->shininess + 2.0f);
    const rt__f eye = rt__dot(n, to_eye), light = rt__dot(n, to_light);
    const rt__f matt = light * 0.318309886184f;
    const rt__f3 h = rt__unity(rt__add(to_eye, to_light)), across = rt__cross(n, h);
    const rt__f up = rt__dot(n, h), k = rt__dot(across, across) + a2 * up * up;
    const rt__f facets =
        rt__select(rt__less(zero, up),
                   a2 / (3.14159265359f * k * k) / (2.0f * rt__smith(eye, a2)), zero);
    const rt__f gloss = facets * (2.0f * light / rt__smith(light, a2));
    const rt__f chance = rt__chances(f, eye);
    *density = chance * facets + (1.0f - chance) * matt;
    const rt__f coat = gloss * rt__coat(rt__dot(h, to_light));
    const rt__f body = 1.05f * (1.0f - RT__LACQUER) * matt * (1.0f - rt__fifth(light)) *
                       (1.0f - rt__fifth(eye));
    return rt__vselect(f->metal, rt__scale(f->albedo, gloss),
                       rt__add(rt__scale(f->albedo, body), rt__vec(coat, coat, coat)));
}

/* rt_scatter. */
RT__INLINE rt__f3 rt__scatter(const rt__brdfs *f, rt__m lanes, rt__f3 n, rt__f3 to_eye,
                              rt__f3 to_light, rt__f *density)
{
    const rt__f zero = rt__all(0.0f);
    const rt__f eye = rt__dot(n, to_eye), light = rt__dot(n, to_light);
    const rt__m above = rt__less(zero, eye) & rt__less(zero, light);
    const rt__m gloss = lanes & above & f->shiny;
    const rt__f matt = light * 0.318309886184f;
    rt__f3 sent = rt__scale(f->albedo, matt);
    *density = matt;
    if (rt__any(gloss)) {
        rt__f glossy;
        const rt__f3 two = rt__gloss(f, n, to_eye, to_light, &glossy);
        sent = rt__vselect(gloss, two, sent);
        *density = rt__select(gloss, glossy, matt);
    }
    *density = rt__select(above, *density, zero);
    return rt__vselect(above, sent, rt__vec(zero, zero, zero));
}

/* rt_sample_brdf, with rt_sample_gloss. Both it and rt_sample_cosine turn a basis. */
RT__INLINE rt__f3 rt__choose(const rt__brdfs *f, rt__m lanes, rt__f3 n, rt__f3 to_eye,
                             rt__f r1, rt__f r2)
{
    const rt__f zero = rt__all(0.0f);
    if (!rt__any(lanes & f->shiny))
        return rt__cosine(n, r1, r2);
    const rt__f chance = rt__chances(f, rt__dot(n, to_eye));
    const rt__m gloss = rt__less(r1, chance);
    const rt__f3 matt = rt__cosine(n, (r1 - chance) / (1.0f - chance), r2);
    const rt__f a = rt__fsqrt(2.0f / (f->shininess + 2.0f));
    rt__f3 x, y;
    rt__basis(n, &x, &y);
    const rt__f3 eye = rt__unity(
        rt__vec(a * rt__dot(x, to_eye), a * rt__dot(y, to_eye), rt__dot(n, to_eye)));
    rt__f sine, cosine;
    rt__sincos(r1 / chance, &sine, &cosine);
    const rt__f z = (1.0f - r2) * (1.0f + eye.z) - eye.z, zz = 1.0f - z * z;
    const rt__f r = rt__fsqrt(rt__fmax(zz, zero));
    const rt__f3 half =
        rt__vec(a * (r * cosine + eye.x), a * (r * sine + eye.y), z + eye.z);
    const rt__f3 facet = rt__unity(rt__add(
        rt__add(rt__scale(x, half.x), rt__scale(y, half.y)), rt__scale(n, half.z)));
    const rt__f3 mirrored =
        rt__sub(rt__scale(facet, 2.0f * rt__dot(to_eye, facet)), to_eye);
    return rt__vselect(gloss, mirrored, matt);
}

/* rt__direct_points, with rt__glossy_point. */
RT__INLINE rt__f3 rt__from_points(const rt__job *job, const rt__packet *p,
                                  const rt__brdfs *f, rt__f3 to_eye, uint64_t *rays)
{
    const rt_scene *scene = job->scene;
    const rt__hits *hits = &p->hits;
    const rt__f zero = rt__all(0.0f);
    rt__f3 sum = rt__vec(zero, zero, zero);
    for (int i = 0; i < scene->light_count; i++) {
        const rt__f3 position = rt__vall(scene->lights[i].position);
        const rt__f3 intensity = rt__vall(scene->lights[i].intensity);
        const rt__f3 to_light = rt__sub(position, hits->point);
        const rt__f toward = rt__dot(hits->normal, to_light);
        const rt__m lit = f->aims & rt__less(zero, toward);
        if (!rt__any(lit))
            continue;
        *rays += rt__count(lit);
        const rt__f dd = rt__dot(to_light, to_light);
        rt__m counts =
            lit & rt__no(rt__unseen(job, &p->place, lit, hits->normal, position));
        if (scene->lamp_count > 0)
            counts &= rt__same(rt__nearest_lamps(scene, &hits->point, &to_light, counts,
                                                 rt__all(1.0f), -1),
                               (rt__i)zero - 1);
        const rt__f part = rt__lambert(toward, dd, &counts);
        rt__f3 light = rt__scale(rt__mul(f->albedo, intensity), part);
        if (rt__any(f->shiny & counts)) {
            rt__f density;
            const rt__f3 sent =
                rt__scatter(f, counts, hits->normal, to_eye,
                            rt__scale(to_light, 1.0f / rt__fsqrt(dd)), &density);
            light = rt__vselect(f->shiny, rt__scale(rt__mul(sent, intensity), 1.0f / dd),
                                light);
        }
        sum = rt__vselect(counts, rt__add(sum, light), sum);
    }
    return sum;
}

/* rt__direct_lamps. */
RT__INLINE rt__f3 rt__from_lamps(const rt__job *job, const rt__packet *p,
                                 const rt__brdfs *f, rt__f3 to_eye, uint64_t *rays)
{
    const rt_scene *scene = job->scene;
    const rt__hits *hits = &p->hits;
    const rt__f zero = rt__all(0.0f);
    rt__numbers numbers = p->numbers;
    rt__f3 sum = rt__vec(zero, zero, zero);
    for (int i = 0; i < scene->lamp_count; i++) {
        const rt_lamp *lamp = &scene->lamps[i];
        rt__f r1, r2, aimed, density;
        rt__f3 toward;
        rt__draw(&numbers, &r1, &r2);
        numbers.dimension += 2u;
        const rt__f3 end = rt__aim(lamp, hits->point, r1, r2, &toward, &aimed);
        const rt__f3 sent =
            rt__scatter(f, f->aims, hits->normal, to_eye, toward, &density);
        const rt__f3 way = rt__sub(end, hits->point);
        const rt__m lit = f->aims & rt__less(zero, aimed) & rt__less(zero, density) &
                          rt__less(zero, rt__dot(hits->normal, way));
        if (!rt__any(lit))
            continue;
        *rays += rt__count(lit);
        rt__m counts = lit & rt__no(rt__unseen(job, &p->place, lit, hits->normal, end));
        if (scene->lamp_count > 1)
            counts &= rt__same(
                rt__nearest_lamps(scene, &hits->point, &way, counts, rt__all(1.0f), i),
                (rt__i)zero - 1);
        const rt__f3 light = rt__scale(rt__mul(sent, rt__vall(rt_lamp_radiance(lamp))),
                                       rt__mis(aimed, density) / aimed);
        sum = rt__vselect(counts, rt__add(sum, light), sum);
    }
    return sum;
}

/* The lamps that rays of these lanes have met, where their paths end. */
RT__NOINLINE void rt__meet_lamps(const rt__job *job, rt__packet *p, rt__i nearest,
                                 rt__m lanes)
{
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f);
    const rt__i none = (rt__i)zero;
    p->lanes &= rt__no(lanes);
    while (rt__any(lanes)) { /* one lamp after the other */
        const int number = nearest[rt__lowest(rt__bits(lanes))];
        const rt_lamp *lamp = &job->scene->lamps[number];
        const rt__m here = lanes & rt__same(nearest, none + number);
        const rt__f aimed = rt__lamp_density(lamp, p->from, p->direction);
        const rt__f weight =
            rt__select(rt__less(zero, p->density), rt__mis(p->density, aimed), one);
        const rt__f3 light =
            rt__mul(p->throughput, rt__scale(rt__vall(rt_lamp_radiance(lamp)), weight));
        p->sum = rt__vselect(here, rt__add(p->sum, light), p->sum);
        rt__see_light(p, here, light);
        lanes &= rt__no(here);
    }
}

/* rt_radiance_mis, after the nearest hit: what shines where the ray arrives. */
RT__INLINE void rt__arrive(const rt__job *job, rt__packet *p, int bounce)
{
    const rt_scene *scene = job->scene;
    const rt__hits *hits = &p->hits;
    const rt__f zero = rt__all(0.0f);
    if (scene->lamp_count > 0) {
        const rt__f t_max =
            rt__select(rt__less(hits->kind, zero), rt__all(FLT_MAX), hits->t);
        const rt__i nearest = rt__nearest_lamps(scene, &p->place.origin, &p->direction,
                                                p->lanes, t_max, -1);
        const rt__m met = p->lanes & rt__no(rt__same(nearest, (rt__i)zero - 1));
        if (rt__any(met))
            rt__meet_lamps(job, p, nearest, met);
    }
    const rt__m missed = p->lanes & rt__less(hits->kind, zero);
    if (rt__any(missed) && bounce <= job->options.bounces) {
        const rt__f3 light =
            rt__mul(p->throughput, rt__sky(scene, &p->direction, rt__bits(missed)));
        p->sum = rt__vselect(missed, rt__add(p->sum, light), p->sum);
        rt__see_light(p, missed, light);
    }
    p->lanes &= rt__no(missed);
    if (job->table->emits) {
        const rt__f3 light = rt__emission(job, hits, p->lanes);
        p->sum =
            rt__vselect(p->lanes, rt__add(p->sum, rt__mul(p->throughput, light)), p->sum);
    }
}

/* rt__first_look_mis, up to the first glass. Through glass it looks straight on, which
 * the path does not, so from there it goes alone: see rt__guides_of. */
RT__NOINLINE void rt__look_first_mis(const rt__job *job, rt__packet *p, int bounce,
                                     const rt__brdfs *f, rt__m mirror,
                                     const rt__f3 *points)
{
    const rt__m ends = rt__looked(job, p, bounce, mirror) & rt__no(f->glass);
    rt__f3 direct = rt__mul(p->throughput, *points);
    if (job->table->emits)
        direct =
            rt__add(rt__mul(p->throughput, rt__emission(job, &p->hits, ends)), direct);
    rt__see_surface(p, ends, f->albedo, direct);
    p->alone |= p->looking & f->glass;
    p->looking &= rt__no(p->alone);
}

/* Where the rays to the lights and those of the next bounce start: in the lanes below,
 * behind the surface. Rays that went through it are now on its other side. */
RT__INLINE void rt__set_out_mis(const rt__job *job, rt__packet *p, rt__m below,
                                rt__m through)
{
    const rt__hits *hits = &p->hits;
    const rt__i nowhere = (hits->left & 0) + RT__NOWHERE;
    const rt__m other = through & rt__no(rt__same(hits->left, nowhere));
    const rt__i left = rt__iselect(other, ~hits->left, nowhere);
    rt__start_at(job->table, &p->place, rt__leave(hits->point, hits->normal, below),
                 rt__iselect(below, left, hits->left));
}

/* In the lanes that aim: the light of the lamps, and the direction that is drawn. */
RT__INLINE void rt__draw_way(const rt__job *job, rt__packet *p, const rt__brdfs *f,
                             rt__f3 points, rt__f r1, rt__f r2, uint64_t *rays)
{
    const rt__f3 n = p->hits.normal;
    const rt__f3 to_eye = rt__scale(p->direction, rt__all(-1.0f));
    const rt__f3 direct = rt__add(points, rt__from_lamps(job, p, f, to_eye, rays));
    p->sum =
        rt__vselect(f->aims, rt__add(p->sum, rt__mul(p->throughput, direct)), p->sum);
    const rt__f3 direction = rt__choose(f, f->aims, n, to_eye, r1, r2);
    rt__f density;
    const rt__f3 sent = rt__scatter(f, f->aims, n, to_eye, direction, &density);
    const rt__f3 part = rt__vselect(f->shiny, rt__scale(sent, 1.0f / density), f->albedo);
    p->throughput = rt__vselect(f->aims, rt__mul(p->throughput, part), p->throughput);
    p->direction = rt__vselect(f->aims, direction, p->direction);
    p->density = rt__select(f->aims, density, p->density);
    p->lanes &= rt__no(f->aims & rt__no(rt__less(rt__all(0.0f), density)));
}

/* All of that, then direct light and the way on. Glass and mirrors know the way before
 * any light is asked, so the rays to the lights and the next bounce can share a place. */
RT__NOINLINE void rt__pass_on(const rt__job *job, rt__packet *p, int bounce,
                              uint64_t *rays)
{
    rt__arrive(job, p, bounce);
    if (bounce > job->options.bounces || !rt__any(p->lanes))
        return;
    const rt__f zero = rt__all(0.0f);
    const rt__u pair = (rt__u)zero + 2u, pairs = pair * (uint32_t)job->scene->lamp_count;
    const rt__f3 n = p->hits.normal, u = p->direction;
    const rt__brdfs f = rt__brdfs_of(job, &p->hits, p->lanes);
    const rt__m mirror = f.metal & rt__no(f.shiny | f.glass);
    const rt__m none = {0};

    /* the pair for the way on comes after those for the lamps, which only some draw */
    rt__numbers numbers = p->numbers;
    numbers.dimension += (rt__u)rt__iselect(f.aims, pairs, pair - 2u);
    rt__f r1, r2;
    rt__draw(&numbers, &r1, &r2);

    rt__f3 direction = rt__sub(u, rt__scale(n, 2.0f * rt__dot(u, n))); /* rt_reflect */
    rt__m through = none;
    if (rt__any(f.glass))
        through = rt__through_glass(job, p, f.glass, f.eta, r1, &direction);
    rt__set_out_mis(job, p, rt__no(f.aims) & rt__less(rt__dot(n, direction), zero),
                    through);
    rt__f3 points = rt__vec(zero, zero, zero);
    if (rt__any(f.aims))
        points = rt__from_points(job, p, &f, rt__scale(u, rt__all(-1.0f)), rays);
    if (rt__any(p->looking))
        rt__look_first_mis(job, p, bounce, &f, mirror, &points);
    p->throughput = rt__vselect(mirror, rt__mul(p->throughput, f.albedo), p->throughput);
    p->density = zero;
    if (rt__any(f.aims))
        rt__draw_way(job, p, &f, points, r1, r2, rays);
    p->direction = rt__vselect(f.aims, p->direction, direction);
    p->numbers.dimension =
        numbers.dimension + (rt__u)rt__iselect(mirror, pair - 2u, pair);
    p->from = p->hits.point;
    rt__go_on(job, p, bounce);
}

RT__INLINE uint64_t rt__trace_mis(const rt__job *job, rt__packet *packets, int count,
                                  rt_watch *watch)
{
    const int last = job->options.bounces;
    const bool one_more = job->scene->lamp_count > 0 || job->scene->surfaces;
    uint64_t rays = 0;
    for (int k = 0; k < count; k++) {
        packets[k].from = packets[k].place.origin;
        packets[k].density = rt__all(0.0f);
        packets[k].hits.shape = (rt__i)packets[k].density;
    }
    for (int bounce = 0;; bounce++) {
        bool done = true;
        for (int k = 0; k < count; k++) {
            rt__packet *p = &packets[k];
            if (!rt__any(p->lanes))
                continue;
            rays += rt__count(p->lanes);
            rt__tick(watch);
            rt__extend(job, p);
            rt__pass_on(job, p, bounce, &rays);
            done = done && !rt__any(p->lanes);
        }
        if (done || bounce > last || (bounce == last && !one_more))
            return rays;
    }
}

/* rt__film_lens_ray. */
RT__NOINLINE void rt__through_lens(const rt__job *job, rt__packet *p)
{
    const rt_lens *lens = &job->options.lens;
    const rt__film *film = &job->film;
    const rt__f zero = rt__all(0.0f);
    const rt__f3 right = rt__vall(rt_to_float(film->right));
    const rt__f3 top = rt__vall(rt_to_float(film->top)), u = p->direction;
    const rt__f along = rt__dot(u, rt__vall(rt_to_float(film->forward)));
    const rt__m good = rt__less(zero, along);
    rt__f r1, r2, sine, cosine;
    rt__draw(&p->numbers, &r1, &r2);
    p->numbers.dimension += 2u;
    const rt__f radius = lens->radius * rt__fsqrt(r2);
    rt__sincos(r1, &sine, &cosine);
    const rt__f3 aside =
        rt__add(rt__scale(right, radius * cosine), rt__scale(top, radius * sine));
    const rt__f3 way = rt__sub(rt__scale(u, lens->focus / along), aside);
    rt__d3 d[2];
    for (int h = 0; h < 2; h++) {
        d[h] = rt__vwiden(way, h);
        const rt__d length = rt__dsqrt(rt__ddot(d[h], d[h]));
        const rt__l there = length > 0.0;
        d[h] = rt__dscale(d[h], (rt__d)(there & (rt__l)(1.0 / length)));
    }
    p->hits.point = rt__vselect(good, rt__add(p->hits.point, aside), p->hits.point);
    p->direction = rt__vselect(good, rt__vjoin(d), u);
}

/* rt__start, rt__look and rt__film_ray: the pixels, starting at number first. */
RT__INLINE void rt__begin(const rt__job *job, int sample, int first, int last,
                          bool guided, rt__packet *p)
{
    const int width = job->image->width;
    const rt__film *film = &job->film;
    const bool sobol = job->options.sampler == RT_SOBOL;
    const rt__f zero = rt__all(0.0f), one = rt__all(1.0f);
    uint32_t seed;
    const uint32_t index = rt__sequence(job, sample, &seed);
    rt__i lane = (rt__i)zero;
    for (int k = 0; k < RT__LANES; k++)
        lane[k] = k;
    rt__i column = lane + first % width, row = (rt__i)zero + first / width;
    for (int most = first % width + RT__LANES - 1; most >= width; most -= width) {
        const rt__i over = (width - 1 - column) >> 31; /* -1: in the next row */
        column += over & -width;
        row -= over;
    }
    const rt__m none = {0};
    rt__numbers *numbers = &p->numbers;
    numbers->sobol = sobol;
    numbers->key =
        rt__mix((rt__u)(lane + first) + rt_hash((sobol ? 0 : index) + rt_hash(seed)));
    numbers->dimension = (rt__u)zero;
    numbers->sample = (rt__u)zero + rt__reverse(index);
    rt__f dx, dy;
    rt__draw(numbers, &dx, &dy);
    numbers->dimension += 2u;
    const rt__f x = __builtin_convertvector(column, rt__f) + dx;
    const rt__f y = __builtin_convertvector(row, rt__f) + dy;
    rt__d3 d[2];
    for (int h = 0; h < 2; h++) {
        const rt__d to_right = film->size * (rt__widen(x, h) - film->half_width);
        const rt__d to_top = film->size * (film->half_height - rt__widen(y, h));
        d[h].x = film->forward.x + to_right * film->right.x + to_top * film->top.x;
        d[h].y = film->forward.y + to_right * film->right.y + to_top * film->top.y;
        d[h].z = film->forward.z + to_right * film->right.z + to_top * film->top.z;
        d[h] = rt__dscale(d[h], 1.0 / rt__dsqrt(rt__ddot(d[h], d[h])));
    }
    p->direction = rt__vjoin(d);
    p->lanes = rt__less(zero, __builtin_convertvector(last - first - lane, rt__f));
    p->sum = rt__vec(zero, zero, zero);
    p->throughput = rt__vec(one, one, one);
    p->looking = guided ? p->lanes : none;
    p->alone = none;
    p->guide_normal = p->guide_point = p->guide_albedo = p->guide_direct = p->sum;
    p->hits.point = rt__vall(film->position);
    p->hits.normal = p->sum;
    p->hits.left = (rt__i)zero + RT__NOWHERE;
    p->hits.inside = (rt__i)zero;
    if (job->options.lens.radius > 0.0f)
        rt__through_lens(job, p);
    rt__set_out(job, p, none);
}

/* The guides of the pixels, starting at number first. The chapters look for those that
 * the path did not find: only few, unless glass is seen first. */
RT__NOINLINE void rt__guides_of(const rt__job *job, const rt__packet *p, int sample,
                                int first, int last, rt_guide *guides)
{
    const unsigned alone = rt__bits(p->looking | p->alone);
    for (int lane = 0; lane < RT__LANES && first + lane < last; lane++) {
        rt_guide *guide = &guides[lane];
        guide->normal = rt__lane(&p->guide_normal, lane);
        guide->point = rt__lane(&p->guide_point, lane);
        guide->albedo = rt__lane(&p->guide_albedo, lane);
        guide->direct = guide->half = rt__lane(&p->guide_direct, lane);
        if ((alone >> lane & 1u) != 0)
            *guide = rt__guide(job, first + lane, rt__start(job, sample, first + lane));
    }
}

/* rt__step_pixels with rt__pixel. */
RT__INLINE uint64_t rt__step_all(const rt__job *job, int sample, int first, int last,
                                 rt_watch *watch, rt_vec3 *values, rt_guide *guides,
                                 bool part_two)
{
    rt__packet packets[RT__FLIGHT];
    uint64_t rays = 0;
    for (int i = first; i < last;) {
        int count = 0;
        for (int from = i; count < RT__FLIGHT && from < last; from += RT__LANES)
            rt__begin(job, sample, from, last, guides != NULL, &packets[count++]);
        rays += part_two ? rt__trace_mis(job, packets, count, watch)
                         : rt__trace(job, packets, count, watch);
        for (int k = 0; k < count; k++) {
            if (guides)
                rt__guides_of(job, &packets[k], sample, i, last, guides + (i - first));
            for (int lane = 0; lane < RT__LANES && i < last; lane++, i++)
                values[i - first] = rt__lane(&packets[k].sum, lane);
        }
    }
    return rays;
}

static uint64_t rt__step_packets(const rt__job *job, int sample, int first, int last,
                                 rt_watch *watch, rt_vec3 *values, rt_guide *guides)
{
    return rt__step_all(job, sample, first, last, watch, values, guides, false);
}

static uint64_t rt__step_packets_mis(const rt__job *job, int sample, int first, int last,
                                     rt_watch *watch, rt_vec3 *values, rt_guide *guides)
{
    return rt__step_all(job, sample, first, last, watch, values, guides, true);
}

/* rt__run, in packets. The scene must have its tree. */
static rt_status rt__run_packets(rt__job *job)
{
    rt__table table;
    memset(&table, 0, sizeof table);
    const rt_scene *scene = job->scene;
    const int surfaces = scene->surfaces ? rt__shape_count(scene) : 0;
    table.few = rt__are_few(scene, job->camera, &job->options.lens);
    if (table.few)
        rt__set_table(&table, scene);
    for (int i = 0; i < surfaces; i++) {
        table.patterns = table.patterns || scene->surfaces[i].pattern;
        table.emits = table.emits || !rt_is_zero(scene->surfaces[i].emission);
    }
    job->table = &table;
    job->step = rt__is_part_two(scene) ? rt__step_packets_mis : rt__step_packets;
    job->together = RT__LANES * RT__FLIGHT;
    job->ticks = table.few && table.count == table.all ? 64 : 1;
    return rt__run(job);
}

#if defined(RT__X86) && RT__LANES == 8
#ifdef __clang__
#pragma clang attribute pop
#else
#pragma GCC pop_options
#endif
#endif
#endif /* RT__LANES > 1 */

#if defined(__cplusplus) && defined(__GNUC__)
#pragma GCC diagnostic pop
#endif
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

/* What demo 10 does around its filter: take a picture apart, mend the edges, doubt the
 * outcome, put it together again. It takes one pixel at a time; rt_denoise takes
 * sixteen. */
#ifndef CLEAN_H
#define CLEAN_H

#include "demo.h"
#include <stdlib.h>

typedef struct clean_pixel {
    bool known; /* does it see a surface? */
    rt_vec3 normal, point, albedo;
    rt_vec3 indirect; /* the noisy pixel without its direct light */
    rt_vec3 light;    /* the same per unit of albedo, soon less noisy */
    float variance;   /* of light */
    float noise;      /* of indirect: its squared length */
} clean_pixel;

typedef struct clean_picture {
    int width, height;
    clean_pixel *pixels;
} clean_picture;

/* What demo 10 writes by hand. */
typedef float unlike_function(const clean_pixel *a, const clean_pixel *b);
typedef clean_pixel smooth_function(const clean_picture *p, int x, int y, int step);

static inline bool is_inside(const clean_picture *p, int x, int y)
{
    return x >= 0 && y >= 0 && x < p->width && y < p->height;
}

static inline const clean_pixel *pixel_at(const clean_picture *p, int x, int y)
{
    return &p->pixels[y * p->width + x];
}

static inline float mean_of(rt_vec3 v)
{
    return (v.x + v.y + v.z) * (1.0f / 3.0f);
}

static inline rt_vec3 per_albedo(rt_vec3 light, rt_vec3 albedo)
{
    const float mean = mean_of(light) / mean_of(albedo);
    return rt_vec(albedo.x > 0 ? light.x / albedo.x : mean,
                  albedo.y > 0 ? light.y / albedo.y : mean,
                  albedo.z > 0 ? light.z / albedo.z : mean);
}

/* ---- 1. apart: pixel = direct + albedo . light ---------------------------------------- */

static inline clean_pixel take_apart(const rt_image *image, int i)
{
    const rt_guide *g = &image->guides[i];
    clean_pixel p = {.normal = g->normal, .point = g->point, .albedo = g->albedo};
    if (mean_of(g->albedo) == 0) /* nothing but background */
        return p;
    p.known = true;
    p.indirect = rt_sub(image->pixels[i], g->direct);
    p.light = per_albedo(p.indirect, p.albedo);
    /* even samples and odd ones: see chapter 9 */
    const int odd = image->samples / 2, even = image->samples - odd;
    const rt_vec3 differ = rt_scale(rt_sub(rt_sub(image->half[i], g->half), p.indirect),
                                    sqrtf((float)even / (float)odd));
    p.noise = rt_dot(differ, differ);
    const float d = mean_of(per_albedo(differ, p.albedo));
    p.variance = d * d;
    return p;
}

/* The mean of a number over 7 x 7 pixels: one pixel tells little about its variance. */
static inline float around(const clean_picture *p, const float *values, int x, int y)
{
    float sum = 0, count = 0;
    for (int dy = -3; dy <= 3; dy++)
        for (int dx = -3; dx <= 3; dx++)
            if (is_inside(p, x + dx, y + dy) && pixel_at(p, x + dx, y + dy)->known) {
                sum += values[(y + dy) * p->width + x + dx];
                count += 1;
            }
    return sum / (count + FLT_MIN);
}

/* values has room for one number per pixel. */
static inline void take_all_apart(const rt_image *image, clean_picture *p, float *values)
{
    for (int i = 0; i < p->width * p->height; i++) {
        p->pixels[i] = take_apart(image, i);
        values[i] = p->pixels[i].variance;
    }
    for (int i = 0; i < p->width * p->height; i++)
        p->pixels[i].variance = around(p, values, i % p->width, i / p->width);
}

/* ---- 3. edges: a pixel that sees two surfaces is a mixture of two neighbours ----------- */

/* For which t, from 0 to 1, is it nearest to (1-t) first + t second? *off: how far it is
 * off, squared. */
static inline float mixture(const clean_pixel *pixel, const clean_pixel *first,
                            const clean_pixel *second, float *off)
{
    const rt_vec3 n = rt_sub(second->normal, first->normal);
    const rt_vec3 a = rt_sub(second->albedo, first->albedo);
    const rt_vec3 p = rt_sub(second->point, first->point);
    const rt_vec3 n0 = rt_sub(pixel->normal, first->normal);
    const rt_vec3 a0 = rt_sub(pixel->albedo, first->albedo);
    const rt_vec3 p0 = rt_sub(pixel->point, first->point);
    const float unit = 1 / (rt_dot(p, p) + rt_dot(p0, p0) + FLT_MIN);
    const float all = rt_dot(n, n) + rt_dot(a, a) + unit * rt_dot(p, p);
    const float part = rt_dot(n, n0) + rt_dot(a, a0) + unit * rt_dot(p, p0);
    float t = part / (all + FLT_MIN);
    t = t > 0 ? t < 1 ? t : 1 : 0;
    const rt_vec3 n1 = rt_sub(n0, rt_scale(n, t)), a1 = rt_sub(a0, rt_scale(a, t));
    const rt_vec3 p1 = rt_sub(p0, rt_scale(p, t));
    *off = rt_dot(n1, n1) + rt_dot(a1, a1) + unit * rt_dot(p1, p1);
    return t;
}

/* The light that arrives by way of other surfaces. At an edge the four pairs of opposite
 * neighbours are asked, too, each with the weight that its guides deserve. */
static inline rt_vec3 mended(const clean_picture *p, int x, int y,
                             unlike_function *unlike)
{
    static const int dx[4] = {1, 0, 1, -1}, dy[4] = {0, 1, 1, 1};
    const clean_pixel *here = pixel_at(p, x, y);
    const rt_vec3 own = rt_mul(here->light, here->albedo);
    rt_vec3 sum = own;
    float weights = 1, most = 0;
    for (int i = 0; i < 4; i++) {
        for (int side = -1; side <= 1; side += 2) {
            const int X = x + side * dx[i], Y = y + side * dy[i];
            /* in the first and last row, only neighbours in the row are asked */
            if (!is_inside(p, X, Y) || (i > 0 && (y == 0 || y == p->height - 1)) ||
                !pixel_at(p, X, Y)->known)
                continue;
            const clean_pixel *there = pixel_at(p, X, Y);
            const rt_vec3 a = rt_sub(here->albedo, there->albedo);
            const float differ = unlike(here, there) + 10 * rt_dot(a, a);
            most = differ > most ? differ : most;
        }
        if (!is_inside(p, x + dx[i], y + dy[i]) || !is_inside(p, x - dx[i], y - dy[i]))
            continue;
        const clean_pixel *first = pixel_at(p, x + dx[i], y + dy[i]);
        const clean_pixel *second = pixel_at(p, x - dx[i], y - dy[i]);
        if (!first->known || !second->known)
            continue;
        float off;
        const float t = mixture(here, first, second, &off);
        const float weight = 1 / (400 * off * off + 1e-4f);
        const rt_vec3 mixed = rt_add(rt_scale(rt_mul(first->light, first->albedo), 1 - t),
                                     rt_scale(rt_mul(second->light, second->albedo), t));
        sum = rt_add(sum, rt_scale(mixed, weight));
        weights += weight;
    }
    return most > 1 ? rt_vec(sum.x / weights, sum.y / weights, sum.z / weights) : own;
}

/* ---- 4. doubt: what noise cannot explain is a mistake ---------------------------------- */

static inline float doubt(float differ, float noise, int samples)
{
    const float most = (2 + 8 / (float)samples) * noise;
    const float mistake = differ > most ? differ - most : 0;
    return mistake / (mistake + noise + FLT_MIN);
}

/* The edges, the doubt, and the direct light again. */
static inline void put_together(const rt_image *image, const clean_picture *p,
                                unlike_function *unlike, float *differ, float *noise,
                                rt_image *result)
{
    for (int i = 0; i < p->width * p->height; i++) {
        const clean_pixel *pixel = &p->pixels[i];
        result->pixels[i] = mended(p, i % p->width, i / p->width, unlike);
        const rt_vec3 d = rt_sub(result->pixels[i], pixel->indirect);
        differ[i] = rt_dot(d, d);
        noise[i] = pixel->noise;
    }
    for (int i = 0; i < p->width * p->height; i++) {
        const int x = i % p->width, y = i / p->width;
        const clean_pixel *pixel = &p->pixels[i];
        const rt_vec3 outcome = result->pixels[i];
        const float back =
            doubt(around(p, differ, x, y), around(p, noise, x, y), image->samples);
        result->pixels[i] =
            pixel->known
                ? rt_add(
                      image->guides[i].direct,
                      rt_add(outcome, rt_scale(rt_sub(pixel->indirect, outcome), back)))
                : image->pixels[i];
    }
    result->samples = image->samples;
    result->done = image->done;
    result->rays = image->rays;
}

/* ---- all of it ------------------------------------------------------------------------- */

static inline rt_status clean(const rt_image *image, int threads, unlike_function *unlike,
                              smooth_function *smooth, rt_image *result)
{
    const int width = image->width, count = width * image->height;
    clean_picture now = {width, image->height, calloc((size_t)count, sizeof *now.pixels)};
    clean_picture next = {width, image->height,
                          calloc((size_t)count, sizeof *now.pixels)};
    float *numbers = calloc((size_t)count, sizeof *numbers);
    float *more = calloc((size_t)count, sizeof *more);
    const bool good = now.pixels && next.pixels && numbers && more;
    if (good)
        take_all_apart(image, &now, numbers);
    for (int step = 1; good && step <= 8; step *= 2) {
#ifdef _OPENMP
#pragma omp parallel for num_threads(rt_thread_count(threads))
#endif
        for (int i = 0; i < count; i++)
            next.pixels[i] = smooth(&now, i % width, i / width, step);
        const clean_picture before = now;
        now = next;
        next = before;
    }
    if (good)
        put_together(image, &now, unlike, numbers, more, result);
    free(now.pixels);
    free(next.pixels);
    free(numbers);
    free(more);
    (void)threads;
    return good ? RT_OK : RT_NO_MEMORY;
}

#endif

/* Patterns for chapter 15: functions of a point, for rt_surface. */
#ifndef PATTERNS_H
#define PATTERNS_H

#include "../rt.h"

/* Tiles on the floor, in two alternating colours. */
typedef struct pattern_checks {
    float size;
    rt_vec3 even, odd;
} pattern_checks;

static inline rt_vec3 checker_pattern(const void *data, rt_vec3 P, rt_vec3 N)
{
    const pattern_checks *checks = data;
    (void)N;
    const int column = (int)floorf(P.x / checks->size);
    const int row = (int)floorf(P.z / checks->size);
    return (column + row) % 2 == 0 ? checks->even : checks->odd;
}

/* A random number from 0 to 1 for each point of a lattice of whole numbers. */
static inline float lattice_value(int x, int y, int z)
{
    const uint32_t bits =
        rt_hash((uint32_t)x + rt_hash((uint32_t)y + rt_hash((uint32_t)z)));
    return (float)(bits >> 8) / 16777216.0f;
}

/* The same for all points in between: a mean over the eight around it. 3 s^2 - 2 s^3
 * smooths out the kinks. (K. Perlin, "An image synthesizer", 1985, has slopes in place of
 * values.) */
static inline float value_noise(rt_vec3 P)
{
    const float x = floorf(P.x), y = floorf(P.y), z = floorf(P.z);
    const float s[3] = {P.x - x, P.y - y, P.z - z};
    float sum = 0;
    for (int i = 0; i < 8; i++) {
        float weight = 1;
        for (int k = 0; k < 3; k++) {
            const float w = s[k] * s[k] * (3 - 2 * s[k]);
            weight *= i >> k & 1 ? w : 1 - w;
        }
        sum += weight *
               lattice_value((int)x + (i & 1), (int)y + (i >> 1 & 1), (int)z + (i >> 2));
    }
    return sum;
}

/* Veins of marble: stripes bent by noise of several sizes, each half as large as the last
 * and half as strong. */
static inline rt_vec3 marble_pattern(const void *unused, rt_vec3 P, rt_vec3 N)
{
    (void)unused;
    (void)N;
    float bent = 0, size = 12;
    for (int k = 0; k < 5; k++, size /= 2)
        bent += size / 12 * value_noise(rt_scale(P, 1 / size));
    const float turns = P.x / 30 + P.y / 60 + bent;
    float sine, cosine;
    rt_sincos(turns - floorf(turns), &sine, &cosine);
    const float vein = 0.5f + 0.5f * cosine, dark = vein * vein * vein * vein;
    return rt_add(rt_scale(rt_vec(0.86f, 0.84f, 0.80f), 1 - dark),
                  rt_scale(rt_vec(0.20f, 0.25f, 0.30f), dark));
}

/* A picture on a ball, projected onto it from the front and the back; stripes, as long as
 * there is none. (Wrapping it like a map around the Earth would take atan2f and acosf,
 * which every libm rounds differently.) */
typedef struct pattern_picture {
    const rt_sphere *ball;
    const rt_vec3 *pixels; /* linear, row by row from the top */
    int width, height;
} pattern_picture;

static inline rt_vec3 picture_pattern(const void *data, rt_vec3 P, rt_vec3 N)
{
    const pattern_picture *p = data;
    const float R = p->ball->radius;
    const float right = 0.5f + 0.5f * (P.x - p->ball->center.x) / R; /* 0 to 1 */
    const float down = 0.5f - 0.5f * (P.y - p->ball->center.y) / R;
    (void)N;
    if (!p->pixels)
        return (int)(down * 9) % 2 == 0 ? rt_vec(0.85f, 0.10f, 0.08f)
                                        : rt_vec(0.85f, 0.80f, 0.70f);
    const int x = (int)(right * (float)(p->width - 1) + 0.5f);
    const int y = (int)(down * (float)(p->height - 1) + 0.5f);
    const bool inside = x >= 0 && y >= 0 && x < p->width && y < p->height;
    return inside ? p->pixels[y * p->width + x] : rt_vec(0, 0, 0);
}

#endif

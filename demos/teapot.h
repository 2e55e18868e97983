/* The teapot of M. Newell, 1975, from the control points that he published: see F. Crow,
 * "The origins of the teapot", IEEE Computer Graphics and Applications 7(1), 1987. It
 * consists of 32 Bezier patches of 4 x 4 points. 24 of them turn a curve about the y
 * axis, and are given here by that curve; each of the others is half of a pipe, handle or
 * spout. Newell's had no bottom. */
#ifndef TEAPOT_H
#define TEAPOT_H

#include "../rt.h"

/* Each side of a patch is cut into TEAPOT_FINE parts. Four patches go around. */
enum {
    TEAPOT_FINE = 20,
    TEAPOT_AROUND = 4 * TEAPOT_FINE,
    TEAPOT_POSITIONS = 32 * TEAPOT_FINE * TEAPOT_FINE + 12 * TEAPOT_FINE,
    TEAPOT_TRIANGLES = 64 * TEAPOT_FINE * TEAPOT_FINE
};

/* A mesh in the making, in the caller's memory. */
typedef struct teapot {
    rt_vec3 *positions; /* TEAPOT_POSITIONS of them */
    int *indices;       /* three for each of TEAPOT_TRIANGLES */
    int position_count, triangle_count;
} teapot;

/* A point of the Bezier curve with these four control points, t from 0 to 1. */
static inline float teapot_curve(float a, float b, float c, float d, float t)
{
    const float s = 1 - t;
    return s * s * s * a + 3 * s * s * t * b + 3 * s * t * t * c + t * t * t * d;
}

/* Add a triangle, unless it has no area: at the poles a side of a patch is one point. */
static inline void teapot_triangle(teapot *pot, int a, int b, int c)
{
    const rt_vec3 *p = pot->positions;
    if (rt_is_zero(rt_sub(p[a], p[b])) || rt_is_zero(rt_sub(p[b], p[c])) ||
        rt_is_zero(rt_sub(p[c], p[a])))
        return;
    int *corners = &pot->indices[3 * pot->triangle_count++];
    corners[0] = a;
    corners[1] = b;
    corners[2] = c;
}

/* Join the last two rings of so many points: two triangles for each field between
 * them. */
static inline void teapot_join_rings(teapot *pot, int around)
{
    const int below = pot->position_count - around, above = below - around;
    for (int i = 0; i < around; i++) {
        const int next = (i + 1) % around;
        teapot_triangle(pot, above + i, above + next, below + i);
        teapot_triangle(pot, above + next, below + next, below + i);
    }
}

/* Turn a curve of radius and height, in one or several pieces, about the y axis. */
static inline void teapot_turn(teapot *pot, const float (*curve)[2], int pieces)
{
    for (int row = 0; row <= pieces * TEAPOT_FINE; row++) {
        const int piece = row < pieces * TEAPOT_FINE ? row / TEAPOT_FINE : pieces - 1;
        const float(*c)[2] = &curve[3 * piece];
        const float t = (float)(row - piece * TEAPOT_FINE) / (float)TEAPOT_FINE;
        const float radius = teapot_curve(c[0][0], c[1][0], c[2][0], c[3][0], t);
        const float y = teapot_curve(c[0][1], c[1][1], c[2][1], c[3][1], t);
        for (int i = 0; i < TEAPOT_AROUND; i++) {
            const float part = (float)(i % TEAPOT_FINE) / (float)TEAPOT_FINE;
            float x = radius * teapot_curve(1, 1, 0.56f, 0, part); /* almost a circle */
            float z = radius * teapot_curve(0, 0.56f, 1, 1, part);
            for (int quarter = i / TEAPOT_FINE; quarter > 0; quarter--) {
                const float old = x;
                x = -z;
                z = old;
            }
            pot->positions[pot->position_count++] = rt_vec(x, y, z);
        }
        if (row > 0)
            teapot_join_rings(pot, TEAPOT_AROUND);
    }
}

/* A pipe in two pieces: x and y of a point on one side, of a point on the other, and its width. */
static inline void teapot_pipe(teapot *pot, const float (*pipe)[5])
{
    enum { AROUND = 2 * TEAPOT_FINE };
    for (int row = 0; row <= 2 * TEAPOT_FINE; row++) {
        const int piece = row < 2 * TEAPOT_FINE ? row / TEAPOT_FINE : 1;
        const float(*p)[5] = &pipe[3 * piece];
        const float t = (float)(row - piece * TEAPOT_FINE) / (float)TEAPOT_FINE;
        float now[5];
        for (int k = 0; k < 5; k++)
            now[k] = teapot_curve(p[0][k], p[1][k], p[2][k], p[3][k], t);
        for (int i = 0; i < AROUND; i++) {
            const bool back = i >= TEAPOT_FINE;
            const float part = (float)(back ? AROUND - i : i) / (float)TEAPOT_FINE;
            const float z = teapot_curve(0, now[4], now[4], 0, part);
            pot->positions[pot->position_count++] =
                rt_vec(teapot_curve(now[0], now[0], now[2], now[2], part),
                       teapot_curve(now[1], now[1], now[3], now[3], part), back ? -z : z);
        }
        if (row > 0)
            teapot_join_rings(pot, AROUND);
    }
}

/* The whole teapot: its axis is y, it is 3 high from 0, and its spout points along x. */
static inline void teapot_make(teapot *pot)
{
    static const float body[13][2] = {{1.4f, 2.25f},
                                      {1.3375f, 2.38125f},
                                      {1.4375f, 2.38125f},
                                      {1.5f, 2.25f},
                                      {1.75f, 1.725f},
                                      {2, 1.2f},
                                      {2, 0.75f},
                                      {2, 0.3f},
                                      {1.5f, 0.075f},
                                      {1.5f, 0},
                                      {1, 0},
                                      {0.5f, 0},
                                      {0, 0}};
    static const float lid[7][2] = {{0, 3},        {0.8f, 3},    {0, 2.7f},
                                    {0.2f, 2.55f}, {0.4f, 2.4f}, {1.3f, 2.4f},
                                    {1.3f, 2.25f}};
    static const float handle[7][5] = {
        {-1.6f, 1.875f, -1.5f, 2.1f, 0.3f}, {-2.3f, 1.875f, -2.5f, 2.1f, 0.3f},
        {-2.7f, 1.875f, -3, 2.1f, 0.3f},    {-2.7f, 1.65f, -3, 1.65f, 0.3f},
        {-2.7f, 1.425f, -3, 1.2f, 0.3f},    {-2.5f, 0.975f, -2.65f, 0.7875f, 0.3f},
        {-2, 0.75f, -1.9f, 0.45f, 0.3f}};
    static const float spout[7][5] = {
        {1.7f, 1.275f, 1.7f, 0.45f, 0.66f},      {2.6f, 1.275f, 3.1f, 0.675f, 0.66f},
        {2.3f, 1.95f, 2.4f, 1.875f, 0.25f},      {2.7f, 2.25f, 3.3f, 2.25f, 0.25f},
        {2.8f, 2.325f, 3.525f, 2.34375f, 0.25f}, {2.9f, 2.325f, 3.45f, 2.3625f, 0.15f},
        {2.8f, 2.25f, 3.2f, 2.25f, 0.15f}};
    pot->position_count = pot->triangle_count = 0;
    teapot_turn(pot, body, 4);
    teapot_turn(pot, lid, 2);
    teapot_pipe(pot, handle);
    teapot_pipe(pot, spout);
}

#endif

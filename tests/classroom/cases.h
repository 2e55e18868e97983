/* What grade.c asks of each routine, and when an answer is right. Inputs are random, but the same
 * for the same seed. */
#ifndef CASES_H
#define CASES_H

#include "routines.h"

#include <stdio.h>

enum { CASES = 200, MANY = 20000 };

/* A kind of input: what it is called, how to make the k-th, and, unless it is enough to compare
 * with rt.h's answer number by number, how to judge all answers together: the index of the
 * first wrong one, count if all are good, -1 if only their statistics are wrong: see why. */
typedef struct kind {
    const char *routine, *what;
    void (*make)(float *in, int k, uint32_t *state);
    int (*judge)(const float *in, const float *out, int count, char *why, size_t size);
    int count; /* 0: CASES */
} kind;

/* ---- making inputs ---------------------------------------------------------------------
 *
 * One number per statement: in which order the arguments of a call are worked out is the
 * compiler's choice, and the inputs of a seed are to be the same everywhere. */

static uint32_t first_state; /* made from the seed; all inputs of a kind start with it */

static rt_vec3 any_direction(uint32_t *state)
{
    for (;;) {
        const rt_vec3 v = vec_between(state, -1, 1);
        if (rt_length(v) > 0.1f && rt_length(v) < 1)
            return rt_normalize(v);
    }
}

/* Perpendicular to a unit vector, as any other. */
static rt_vec3 across(rt_vec3 n, uint32_t *state)
{
    for (;;) {
        const rt_vec3 v = rt_cross(n, any_direction(state));
        if (rt_length(v) > 0.2f)
            return rt_normalize(v);
    }
}

static rt_vec3 toward(rt_vec3 from, rt_vec3 to)
{
    return rt_normalize(rt_sub(to, from));
}

static void put_camera(float *in, rt_vec3 direction, rt_vec3 up, float fov_y, int width,
                       int height, uint32_t *state)
{
    put_vec(&in, vec_between(state, -9, 9));
    put_vec(&in, direction);
    put_vec(&in, up);
    *in++ = fov_y;
    *in++ = (float)width;
    *in++ = (float)height;
    *in++ = between(state, 0, (float)width);
    *in = between(state, 0, (float)height);
}

static void camera_straight(float *in, int k, uint32_t *state)
{
    (void)k;
    put_camera(in, rt_vec(0, 0, -1), rt_vec(0, 1, 0), 90, 100, 100, state);
}

static void camera_angles(float *in, int k, uint32_t *state)
{
    (void)k;
    put_camera(in, rt_vec(0, 0, -1), rt_vec(0, 1, 0), between(state, 5, 150), 100, 100,
               state);
}

static void camera_sizes(float *in, int k, uint32_t *state)
{
    put_camera(in, rt_vec(0, 0, -1), rt_vec(0, 1, 0), 46, k % 2 == 0 ? 640 : 101,
               k % 2 == 0 ? 480 : 303, state);
}

static void camera_defaults(float *in, int k, uint32_t *state)
{
    (void)k;
    put_camera(in, rt_vec(0, 0, 0), rt_vec(0, 0, 0), 0, 320, 240, state);
}

static void camera_anywhere(float *in, int k, uint32_t *state)
{
    const rt_vec3 direction = any_direction(state), side = across(direction, state);
    const float length = between(state, 0.1f, 50);
    (void)k;
    put_camera(in, rt_scale(direction, length), rt_add(side, rt_scale(direction, 0.3f)),
               46, 320, 240, state);
}

/* A number from low to high; where both are the same, that. */
typedef struct range {
    float low, high;
} range;

static float pick(range r, uint32_t *state)
{
    return r.low < r.high ? between(state, r.low, r.high) : r.low;
}

/* A sphere and a ray that comes by its centre at so many radii; from distance radii away. */
static void put_sphere(float *in, range radius, range beside, range distance,
                       range length, float t_max, uint32_t *state)
{
    const float l = pick(length, state);
    const float d = pick(distance, state);
    const float away = pick(beside, state);
    const float r = pick(radius, state);
    const rt_vec3 center = vec_between(state, -9, 9);
    const rt_vec3 u = any_direction(state);
    const rt_vec3 aim = rt_add(center, rt_scale(across(u, state), away * r));
    put_vec(&in, center);
    *in++ = r;
    put_vec(&in, rt_sub(aim, rt_scale(u, d * r)));
    put_vec(&in, rt_scale(u, l));
    *in = t_max;
}

static const range any_radius = {0.5f, 3}, through = {0, 0.95f}, one = {1, 1};

static void sphere_hit(float *in, int k, uint32_t *state)
{
    (void)k;
    put_sphere(in, any_radius, through, (range){1.1f, 9}, one, FLT_MAX, state);
}

static void sphere_long(float *in, int k, uint32_t *state)
{
    (void)k;
    put_sphere(in, any_radius, through, (range){1.1f, 9}, (range){0.1f, 20}, FLT_MAX,
               state);
}

static void sphere_miss(float *in, int k, uint32_t *state)
{
    (void)k;
    put_sphere(in, any_radius, (range){1.05f, 3}, (range){-9, 9}, one, FLT_MAX, state);
}

static void sphere_behind(float *in, int k, uint32_t *state)
{
    (void)k;
    put_sphere(in, any_radius, through, (range){-9, -1.1f}, one, FLT_MAX, state);
}

static void sphere_inside(float *in, int k, uint32_t *state)
{
    (void)k;
    put_sphere(in, any_radius, (range){0, 0.6f}, (range){-0.6f, 0.6f}, one, FLT_MAX,
               state);
}

static void sphere_limit(float *in, int k, uint32_t *state)
{
    /* met between t = 5 and 9; the way in may be before t_max and the way out not */
    put_sphere(in, (range){2, 2}, (range){0, 0.9f}, (range){3.5f, 3.5f}, one,
               k % 2 == 0 ? 4.9f : 9.5f, state);
}

static void sphere_wall(float *in, int k, uint32_t *state)
{
    const float radius = 1e5f;
    const rt_vec3 n = any_direction(state);
    const rt_vec3 about = vec_between(state, -9, 9);
    const rt_vec3 start = rt_add(rt_scale(n, -between(state, 1, 99)), about);
    (void)k;
    put_vec(&in, rt_scale(n, -radius - 120));
    *in++ = radius;
    put_vec(&in, start);
    put_vec(&in,
            rt_normalize(rt_add(rt_scale(n, -1), rt_scale(any_direction(state), 0.7f))));
    *in = FLT_MAX;
}

/* A small distance, of any size. */
static float any_gap(uint32_t *state)
{
    return powf(10, between(state, -5, -3.05f));
}

/* Toward something straight ahead, but not straight on. */
static rt_vec3 leaning(rt_vec3 ahead, uint32_t *state)
{
    return rt_normalize(rt_add(ahead, rt_scale(any_direction(state), 0.7f)));
}

/* From close to the surface, outside or inside: a hit, however small t is. Who leaves out small t,
 * in place of an offset where the ray starts, misses it. */
static void sphere_close(float *in, int k, uint32_t *state)
{
    const rt_vec3 center = vec_between(state, -3, 3);
    const rt_vec3 n = any_direction(state);
    const float radius = between(state, 0.5f, 3);
    const float side = k % 2 == 0 ? 1 : -1, gap = any_gap(state);
    put_vec(&in, center);
    *in++ = radius;
    put_vec(&in, rt_add(center, rt_scale(n, radius + side * gap)));
    put_vec(&in, leaning(rt_scale(n, -side), state));
    *in = FLT_MAX;
}

static void spoil(float *in, int first, int count, int k)
{
    const float bad[] = {NAN, INFINITY, -INFINITY};
    in[first + k % count] = bad[k % 3];
}

static void sphere_bad(float *in, int k, uint32_t *state)
{
    sphere_hit(in, k, state);
    if (k % 4 == 0)
        in[7] = in[8] = in[9] = 0; /* no direction */
    else
        spoil(in, 0, 10, k);
}

/* A box and a ray: to a point of the box from outside or inside, or to one beside it. */
static void put_box(float *in, bool inside, bool aims, float length, uint32_t *state)
{
    const rt_vec3 min = vec_between(state, -9, 5), size = vec_between(state, 0.5f, 4);
    const rt_vec3 part = vec_between(state, 0.05f, 0.95f),
                  other = vec_between(state, 0.05f, 0.95f);
    const rt_vec3 n = any_direction(state);
    rt_vec3 to = rt_add(min, rt_mul(part, size));
    rt_vec3 from = inside ? rt_add(min, rt_mul(other, size))
                          : rt_add(to, rt_scale(n, 6 + between(state, 3, 9)));
    if (!aims) { /* past the ball around the box */
        const float beside = 0.5f * rt_length(size) + between(state, 0.1f, 5);
        to =
            rt_add(rt_add(min, rt_scale(size, 0.5f)), rt_scale(across(n, state), beside));
        from = rt_add(to, rt_scale(n, between(state, -9, 9)));
    }
    const rt_vec3 direction = aims ? toward(from, to) : n;
    put_vec(&in, min);
    put_vec(&in, rt_add(min, size));
    put_vec(&in, from);
    put_vec(&in, rt_scale(direction, length));
    *in = FLT_MAX;
}

static void box_hit(float *in, int k, uint32_t *state)
{
    (void)k;
    put_box(in, false, true, 1, state);
}

static void box_long(float *in, int k, uint32_t *state)
{
    (void)k;
    put_box(in, false, true, between(state, 0.1f, 20), state);
}

static void box_miss(float *in, int k, uint32_t *state)
{
    (void)k;
    put_box(in, false, false, 1, state);
}

static void box_behind(float *in, int k, uint32_t *state)
{
    (void)k;
    put_box(in, false, true, -1, state);
}

static void box_inside(float *in, int k, uint32_t *state)
{
    (void)k;
    put_box(in, true, true, 1, state);
}

static void box_limit(float *in, int k, uint32_t *state)
{
    put_box(in, false, true, 1, state); /* met at t of 4 or more */
    in[12] = k % 2 == 0 ? 3.0f : 40.0f;
}

/* Along an axis: one or two components of the direction are zero. */
static void box_parallel(float *in, int k, uint32_t *state)
{
    put_box(in, false, true, 1, state);
    for (int axis = 0; axis < 3; axis++) {
        const float part = between(state, 0.1f, 0.9f);
        const bool beside = k % 5 == 0 && axis == k % 3;
        in[6 + axis] =
            in[axis] + part * (in[3 + axis] - in[axis]) + (beside ? 9.0f : 0.0f);
        in[9 + axis] = 0;
    }
    const int along = (k + 1) % 3;
    in[6 + along] -= 12;
    in[9 + along] = 1;
}

static void box_close(float *in, int k, uint32_t *state)
{
    const int axis = k % 3;
    const float side = k / 3 % 2 == 0 ? 1 : -1; /* outside, or inside */
    put_box(in, true, true, 1, state);
    float *at = in + 9, ahead[3] = {0, 0, 0};
    in[6 + axis] = in[3 + axis] + side * any_gap(state);
    ahead[axis] = -side;
    put_vec(&at, leaning(rt_vec(ahead[0], ahead[1], ahead[2]), state));
}

static void box_bad(float *in, int k, uint32_t *state)
{
    box_hit(in, k, state);
    if (k % 4 == 0)
        in[9] = in[10] = in[11] = 0;
    else
        spoil(in, 6, 6, k);
    if (k % 4 == 0)
        in[6] -= 40; /* so that it does not start in the box */
}

/* A triangle, and a ray to a point of it, or beside: from this side of it, from so far away, with
 * a direction of this length. */
static void put_triangle(float *in, float size, bool behind, bool aims, range distance,
                         range length, float t_max, uint32_t *state)
{
    const rt_vec3 middle = vec_between(state, -9, 9);
    const rt_vec3 n = any_direction(state), side = across(n, state);
    const rt_vec3 other = rt_cross(n, side);
    const float turn = between(state, -0.3f, 0.3f);
    const float d = pick(distance, state), l = pick(length, state);
    rt_vec3 corner[3];
    for (int k = 0; k < 3;
         k++) { /* counterclockwise round n, no angle below 20 degrees */
        const float x = k == 0 ? 1 : -0.5f, y = k == 0 ? turn : k == 1 ? 0.866f : -0.866f;
        const float r = size * between(state, 0.7f, 1.3f);
        corner[k] =
            rt_add(middle, rt_scale(rt_add(rt_scale(side, x), rt_scale(other, y)), r));
        put_vec(&in, corner[k]);
    }
    const float root = between(state, 0.1f, 0.9f), part = between(state, 0.1f, 0.9f);
    rt_vec3 to = rt_add(
        rt_scale(corner[0], 1 - root),
        rt_scale(rt_add(rt_scale(corner[1], 1 - part), rt_scale(corner[2], part)), root));
    if (!aims) /* as far beyond the edge between two corners */
        to = rt_sub(rt_add(corner[1], rt_scale(rt_sub(corner[2], corner[1]), part)),
                    rt_scale(rt_sub(corner[0], corner[1]), root));
    const rt_vec3 lean = rt_scale(any_direction(state), 0.7f);
    const rt_vec3 up = rt_normalize(rt_add(behind ? rt_scale(n, -1) : n, lean));
    put_vec(&in, rt_add(to, rt_scale(up, d)));
    put_vec(&in, rt_scale(up, -l));
    *in = t_max;
}

static const range near_by = {2, 9};

static void triangle_hit(float *in, int k, uint32_t *state)
{
    (void)k;
    put_triangle(in, 2, false, true, near_by, one, FLT_MAX, state);
}

static void triangle_back(float *in, int k, uint32_t *state)
{
    (void)k;
    put_triangle(in, 2, true, true, near_by, one, FLT_MAX, state);
}

static void triangle_long(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, k % 2 != 0, true, near_by, (range){1e-3f, 20}, FLT_MAX, state);
}

static void triangle_small(float *in, int k, uint32_t *state)
{
    put_triangle(in, 1e-3f, k % 2 != 0, true, (range){0.1f, 1}, one, FLT_MAX, state);
}

static void triangle_far(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, k % 2 != 0, true, (range){100, 3000}, one, FLT_MAX, state);
}

static void triangle_miss(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, k % 2 != 0, false, near_by, one, FLT_MAX, state);
}

static void triangle_behind(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, k % 2 != 0, true, (range){-9, -1}, one, FLT_MAX, state);
}

static void triangle_close(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, k % 2 != 0, true, (range){5e-5f, 9e-4f}, one, FLT_MAX, state);
}

static void triangle_limit(float *in, int k, uint32_t *state)
{
    put_triangle(in, 2, false, true, (range){5, 5}, one, k % 2 == 0 ? 4.9f : 5.1f, state);
}

/* A point, a line, or seen from the edge: coordinates for which that is exact. */
static void triangle_flat(float *in, int k, uint32_t *state)
{
    const float x = floorf(between(state, -5, 5)), y = floorf(between(state, -5, 5));
    const rt_vec3 a = {x, y, 2}, along = {2, 1, k % 3 == 0 ? 0 : 4};
    const rt_vec3 beside = {0, 0, k % 3 == 2 ? 3 : 0};
    const rt_vec3 b = rt_add(a, rt_scale(along, k % 3 == 0 ? 0 : 1));
    const rt_vec3 c = rt_add(rt_add(a, rt_scale(along, k % 3 == 0 ? 0 : 2)), beside);
    put_vec(&in, a);
    put_vec(&in, b);
    put_vec(&in, c);
    const rt_vec3 to = rt_add(b, rt_scale(beside, 0.25f));
    /* in the plane of the three, where they have one */
    const rt_vec3 away = k % 3 == 2 ? rt_vec(-4, -2, 1) : rt_vec(-4, 3, 5);
    put_vec(&in, rt_add(to, away));
    put_vec(&in, rt_scale(away, -1));
    *in = FLT_MAX;
}

static void triangle_bad(float *in, int k, uint32_t *state)
{
    triangle_hit(in, k, state);
    if (k % 4 == 0)
        in[12] = in[13] = in[14] = 0;
    else
        spoil(in, 0, 15, k);
}

/* Four triangles around a corner, one after the other, and one ray to the corner or to a point of
 * one of the four edges that begin there. Of some all coordinates are whole numbers. */
enum { FAN = 4 };

static void triangle_fan(float *in, int k, uint32_t *state)
{
    uint32_t group = rt_hash(first_state + (uint32_t)(k / FAN));
    const bool whole = k / FAN % 4 == 0;
    const rt_vec3 corner = vec_between(&group, -9, 9);
    const float size = between(&group, 0.2f, 2);
    rt_vec3 points[FAN + 2];
    for (int i = 0; i <= FAN; i++) { /* the corner comes last */
        const float x = (float)((i == 0) - (i == 2)), z = (float)((i == 1) - (i == 3));
        const float up = i < FAN ? between(&group, -0.3f, 0.3f) : 0;
        const float wide = between(&group, 0.7f, 1.4f);
        points[i] = rt_add(corner, rt_scale(rt_vec(wide * x, up, wide * z), size));
        if (whole)
            points[i] =
                rt_vec(floorf(corner.x) + 4 * x, floorf(corner.y) + floorf(4 * up),
                       floorf(corner.z) + 4 * z);
    }
    const float part = between(&group, -0.2f, 0.9f);
    const rt_vec3 edge = rt_sub(points[k / FAN / 4 % FAN], points[FAN]);
    const rt_vec3 to = rt_add(points[FAN], rt_scale(edge, part > 0 ? part : 0));
    rt_vec3 away = vec_between(&group, -3, 3);
    away.y = k / FAN % 2 ? 6 : -6;
    if (whole)
        away = rt_vec(floorf(away.x), away.y, floorf(away.z));
    (void)state;
    put_vec(&in, points[FAN]);
    put_vec(&in, points[k % FAN]);
    put_vec(&in, points[(k + 1) % FAN]);
    put_vec(&in, rt_add(to, away));
    put_vec(&in, rt_scale(away, -1)); /* so t is 1 */
    *in = FLT_MAX;
}

/* A ray through a world: in[0] its number. From outside, or from among the things. */
static void world_ray(float *in, int k, uint32_t *state)
{
    *in++ = (float)(k % 50 + 100 * (int)between(state, 0, 1000));
    const rt_vec3 from =
        k % 2 == 0 ? rt_scale(any_direction(state), 12) : vec_between(state, -5, 5);
    put_vec(&in, from);
    put_vec(&in, toward(from, vec_between(state, -5, 5)));
}

static void world_sky(float *in, int k, uint32_t *state)
{
    world_ray(in, k, state);
    rt_vec3 up = any_direction(state);
    up.y = fabsf(up.y) + 0.2f;
    in++;
    put_vec(&in, rt_vec(0, 9.5f, 0));
    put_vec(&in, up);
}

static void world_limit(float *in, int k, uint32_t *state)
{
    world_ray(in, k, state);
    in[7] = between(state, 0.1f, 25);
}

/* A point on a surface of a world, found with rt.h's rt_intersect, and a light. */
static void world_point(float *in, int k, uint32_t *state)
{
    world w;
    rt_hit hit;
    memset(&hit, 0, sizeof hit);
    do {
        const float *at = in + 1;
        world_ray(in, k, state);
        make_world(&w, in[0]);
        const rt_ray ray = take_ray(&at);
        if (!rt_intersect(&w.scene, &ray, &hit))
            hit.t = 0;
    } while (!(hit.t > 0));
    in++;
    put_vec(&in, hit.point);
    put_vec(&in, hit.normal);
    put_vec(&in, vec_between(state, -6, 6));
}

/* From close to a surface, toward it; not the floor, of which float knows less. */
static void world_close(float *in, int k, uint32_t *state)
{
    do
        world_point(in, k, state);
    while (in[2] < -6.5f);
    const float *at = in + 1;
    float *to = in + 1;
    const rt_vec3 point = take_vec(&at), normal = take_vec(&at);
    const float gap = any_gap(state);
    put_vec(&to, rt_add(point, rt_scale(normal, gap)));
    put_vec(&to, leaning(rt_scale(normal, -1), state));
    *to =
        k % 2 == 0 ? 1 : 0.25f * gap; /* rt_occluded: beyond the surface, or before it */
}

/* Seen for sure: nothing near the way to the light. */
static bool clear_way(const world *w, rt_vec3 from, rt_vec3 to)
{
    for (int i = 0; i <= 40; i++) {
        const float part = (float)i / 40.0f;
        const rt_vec3 p = rt_add(from, rt_scale(rt_sub(to, from), part));
        for (int s = 0; s < SPHERES; s++)
            if (i > 2 &&
                rt_length(rt_sub(p, w->spheres[s].center)) < w->spheres[s].radius + 0.02f)
                return false;
    }
    return true;
}

/* A light before, and one behind the next surface. */
static void visible_seen(float *in, int k, uint32_t *state)
{
    for (;;) {
        world w;
        const float *at = in + 1;
        world_point(in, k, state);
        make_world(&w, in[0]);
        const rt_vec3 point = take_vec(&at), normal = take_vec(&at),
                      light = take_vec(&at);
        if (rt_dot(normal, toward(point, light)) > 0.1f && clear_way(&w, point, light) &&
            rt_visible(&w.scene, point, normal, light))
            return;
    }
}

static void visible_hidden(float *in, int k, uint32_t *state)
{
    for (;;) {
        world w;
        const float *at = in + 1;
        world_point(in, k, state);
        make_world(&w, in[0]);
        const rt_vec3 point = take_vec(&at), normal = take_vec(&at),
                      light = take_vec(&at);
        if (rt_dot(normal, toward(point, light)) > 0.1f &&
            !rt_visible(&w.scene, point, normal, light))
            return;
    }
}

static void visible_or_not(float *in, int k, uint32_t *state)
{
    if (k % 2 == 0)
        visible_seen(in, k, state);
    else
        visible_hidden(in, k, state);
}

/* A light in front of what would hide one further away. */
static void visible_before(float *in, int k, uint32_t *state)
{
    world w;
    rt_hit blocker;
    const float *at = in + 1;
    visible_hidden(in, k, state);
    if (k % 2 == 0)
        return;
    make_world(&w, in[0]);
    const rt_vec3 point = take_vec(&at), normal = take_vec(&at), light = take_vec(&at);
    rt_ray ray;
    ray.origin = rt_leave(point, normal, rt_sub(light, point));
    ray.direction = rt_sub(light, ray.origin);
    float *to = in + 7;
    if (rt_intersect(&w.scene, &ray, &blocker))
        put_vec(&to, rt_at(&ray, 0.5f * blocker.t));
}

static void direct_lights(float *in, int k, uint32_t *state)
{
    float point[10];
    visible_seen(point, k, state);
    in[0] = point[0];
    in[1] = (float)(1 + k % 2);
    memcpy(in + 2, point + 1, 6 * sizeof *in);
}

static void direct_none(float *in, int k, uint32_t *state)
{
    direct_lights(in, k, state);
    in[1] = 0;
}

static void put_lambert(float *in, float cosine_from, float cosine_to, float d,
                        uint32_t *state)
{
    const rt_vec3 normal = any_direction(state);
    const float cosine = between(state, cosine_from, cosine_to);
    const rt_vec3 side = rt_scale(across(normal, state), sqrtf(1 - cosine * cosine));
    put_vec(&in, vec_between(state, 0.1f, 1));
    put_vec(&in, normal);
    put_vec(&in, rt_scale(rt_add(rt_scale(normal, cosine), side), d));
    put_vec(&in, vec_between(state, 1, 100));
}

static void lambert_above(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lambert(in, 1, 1, 1, state);
}

static void lambert_angle(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lambert(in, 0.05f, 1, 1, state);
}

static void lambert_far(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lambert(in, 0.05f, 1, between(state, 0.1f, 30), state);
}

static void lambert_behind(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lambert(in, -1, -0.01f, between(state, 0.1f, 30), state);
}

static void put_leave(float *in, float size, float side, uint32_t *state)
{
    const rt_vec3 normal = any_direction(state);
    put_vec(&in, vec_between(state, -size, size));
    put_vec(&in, normal);
    const rt_vec3 sideways = across(normal, state);
    put_vec(&in, rt_add(rt_scale(normal, side * between(state, 0.05f, 1)), sideways));
}

static void leave_above(float *in, int k, uint32_t *state)
{
    (void)k;
    put_leave(in, 50, 1, state);
}

static void leave_below(float *in, int k, uint32_t *state)
{
    (void)k;
    put_leave(in, 50, -1, state);
}

static void encode_between(float *in, int k, uint32_t *state)
{
    in[0] = ((float)k + between(state, 0, 1)) / CASES;
    in[1] = 2.2f;
}

static void encode_linear(float *in, int k, uint32_t *state)
{
    encode_between(in, k, state);
    in[1] = k % 2 == 0 ? 1 : between(state, 1.2f, 3);
}

static void encode_outside(float *in, int k, uint32_t *state)
{
    in[0] = k % 2 == 0 ? between(state, -5, 0) : between(state, 1, 50);
    in[1] = 2.2f;
}

static void encode_bad(float *in, int k, uint32_t *state)
{
    encode_linear(in, 1, state);
    spoil(in, 0, 1, k);
}

static void reflect_unit(float *in, int k, uint32_t *state)
{
    (void)k;
    put_vec(&in, any_direction(state));
    put_vec(&in, any_direction(state));
}

static void reflect_long(float *in, int k, uint32_t *state)
{
    (void)k;
    const float length = between(state, 0.1f, 30);
    put_vec(&in, rt_scale(any_direction(state), length));
    put_vec(&in, any_direction(state));
}

static void random_pixels(float *in, int k, uint32_t *state)
{
    (void)state;
    in[0] = (float)(k % 141);
    in[1] = (float)(k / 141);
    in[2] = (float)(first_state >> 8);
}

static void random_again(float *in, int k, uint32_t *state)
{
    (void)state;
    random_pixels(in, k % (CASES / 2), state);
}

static void cosine_any(float *in, int k, uint32_t *state)
{
    (void)k;
    put_vec(&in, any_direction(state));
    *in++ = between(state, 1e-4f, 1 - 1e-4f);
    *in = between(state, 1e-4f, 1 - 1e-4f);
}

static void cosine_axes(float *in, int k, uint32_t *state)
{
    cosine_any(in, k, state);
    in[0] = in[1] = in[2] = 0;
    in[k % 3] = k % 2 == 0 ? 1 : -1;
}

static void put_radiance(float *in, int bounces, int k, bool mirrors, uint32_t *state)
{
    world_ray(in, k, state);
    in[0] = 2 * floorf(in[0] / 2) + (mirrors ? 1.0f : 0.0f);
    in[7] = (float)bounces;
    in[8] = (float)k;
}

static void radiance_direct(float *in, int k, uint32_t *state)
{
    put_radiance(in, 0, k, false, state);
}

static void radiance_sky(float *in, int k, uint32_t *state)
{
    world_sky(in, k, state);
    in[7] = 5;
    in[8] = (float)k;
}

static void radiance_mirror(float *in, int k, uint32_t *state)
{
    for (;;) { /* rays that see something in the mirror */
        world w;
        rt_hit hit;
        const float *at = in + 1;
        put_radiance(in, 1, k, true, state);
        make_world(&w, in[0]);
        const rt_ray ray = take_ray(&at);
        if (rt_intersect(&w.scene, &ray, &hit) && hit.material->mirror)
            return;
    }
}

static void radiance_seen(float *in, uint32_t *state)
{
    for (;;) { /* a ray that sees something, not in the mirror */
        world w;
        rt_hit hit;
        const float *at = in + 1;
        put_radiance(in, 3, 0, false, state);
        make_world(&w, in[0]);
        const rt_ray ray = take_ray(&at);
        if (rt_intersect(&w.scene, &ray, &hit))
            return;
    }
}

/* One ray, again and again, with other random numbers. */
static void radiance_mean(float *in, int k, uint32_t *state)
{
    uint32_t same = first_state;
    (void)state;
    radiance_seen(in, &same);
    in[8] = (float)k;
}

/* ---- part two */

static void put_fresnel(float *in, float cosine, float eta)
{
    in[0] = cosine;
    in[1] = eta;
}

static void fresnel_straight(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    put_fresnel(in, 1, k % 2 == 0 ? eta : 1 / eta);
}

static void fresnel_outside(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    (void)k;
    put_fresnel(in, between(state, 0.02f, 1), eta);
}

/* From inside, at a cosine at which sin^2 t, behind the surface, is in this range: not so near 1
 * that it depends on roundings. */
static float inside_cosine(float eta, float low, float high, uint32_t *state)
{
    const float sin2 = between(state, low, high) / (eta * eta);
    return sqrtf(sin2 < 1 ? 1 - sin2 : 0);
}

static void fresnel_inside(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    (void)k;
    put_fresnel(in, inside_cosine(eta, 0, 0.98f, state), 1 / eta);
}

static void fresnel_total(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    (void)k;
    put_fresnel(in, inside_cosine(eta, 1.01f, eta * eta - 0.01f, state), 1 / eta);
}

static void put_refract(float *in, float cosine, float eta, uint32_t *state)
{
    const rt_vec3 normal = any_direction(state);
    const rt_vec3 side = rt_scale(across(normal, state), sqrtf(1 - cosine * cosine));
    put_vec(&in, rt_normalize(rt_sub(side, rt_scale(normal, cosine))));
    put_vec(&in, normal);
    *in = eta;
}

static void refract_straight(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    put_refract(in, 1, k % 2 == 0 ? eta : 1 / eta, state);
}

static void refract_into(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    const float cosine = between(state, 0.02f, 1);
    (void)k;
    put_refract(in, cosine, eta, state);
}

static void refract_out(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    const float cosine = inside_cosine(eta, 0, 0.98f, state);
    (void)k;
    put_refract(in, cosine, 1 / eta, state);
}

static void refract_total(float *in, int k, uint32_t *state)
{
    const float eta = between(state, 1.1f, 2.5f);
    const float cosine = inside_cosine(eta, 1.01f, eta * eta - 0.01f, state);
    (void)k;
    put_refract(in, cosine, 1 / eta, state);
}

/* A ball that is seen from the point, at so many radii; then where to write on. */
static float *put_ball_lamp(float *in, range distance, uint32_t *state)
{
    const float d = pick(distance, state);
    const float radius = between(state, 0.1f, 2);
    const rt_vec3 point = vec_between(state, -2, 2);
    put_vec(&in, rt_add(point, rt_scale(any_direction(state), d * radius)));
    *in++ = radius;
    put_vec(&in, rt_vec(0, 0, 0));
    put_vec(&in, rt_vec(0, 0, 0));
    put_vec(&in, point);
    return in;
}

/* A parallelogram that is not seen on edge. */
static float *put_flat_lamp(float *in, uint32_t *state)
{
    const rt_vec3 n = any_direction(state), a = across(n, state);
    const rt_vec3 b = rt_add(rt_cross(n, a), rt_scale(a, between(state, -0.6f, 0.6f)));
    const rt_vec3 u = rt_scale(a, between(state, 0.2f, 1.5f));
    const rt_vec3 v = rt_scale(b, between(state, 0.2f, 1.5f));
    const rt_vec3 center = vec_between(state, -5, 5);
    const float away = between(state, 1, 5) * (between(state, -1, 1) < 0 ? -1.0f : 1.0f);
    const rt_vec3 aside = rt_scale(across(n, state), between(state, 0, 2));
    put_vec(&in, center);
    *in++ = 0;
    put_vec(&in, u);
    put_vec(&in, v);
    put_vec(&in, rt_add(center, rt_add(rt_scale(n, away), aside)));
    return in;
}

static void put_two_numbers(float *in, float margin, uint32_t *state)
{
    in[0] = between(state, margin, 1 - margin);
    in[1] = between(state, margin, 1 - margin);
}

static void sample_ball(float *in, int k, uint32_t *state)
{
    (void)k;
    put_two_numbers(put_ball_lamp(in, (range){1.2f, 9}, state), 1e-4f, state);
}

static void sample_flat(float *in, int k, uint32_t *state)
{
    (void)k;
    put_two_numbers(put_flat_lamp(in, state), 1e-4f, state);
}

/* Toward any point of the lamp. */
static void put_toward(float *in, float *at, uint32_t *state)
{
    const float *from = in;
    const rt_lamp lamp = take_lamp(&from);
    const rt_vec3 point = take_vec(&from);
    const float a = between(state, 0.01f, 0.99f);
    const float b = between(state, 0.01f, 0.99f);
    put_vec(&at, toward(point, rt_sample_lamp(&lamp, point, a, b)));
}

static void density_ball(float *in, int k, uint32_t *state)
{
    (void)k;
    put_toward(in, put_ball_lamp(in, (range){1.2f, 9}, state), state);
}

static void density_small(float *in, int k, uint32_t *state)
{
    (void)k;
    put_toward(in, put_ball_lamp(in, (range){300, 3000}, state), state);
}

static void density_flat(float *in, int k, uint32_t *state)
{
    (void)k;
    put_toward(in, put_flat_lamp(in, state), state);
}

static void density_within(float *in, int k, uint32_t *state)
{
    float *at = put_ball_lamp(in, (range){0.01f, 0.9f}, state);
    (void)k;
    put_vec(&at, any_direction(state));
}

static void put_mis(float *in, float decades, uint32_t *state)
{
    in[0] = powf(10, between(state, -decades, decades));
    in[1] = powf(10, between(state, -decades, decades));
}

static void mis_both(float *in, int k, uint32_t *state)
{
    (void)k;
    put_mis(in, 1, state);
}

static void mis_extreme(float *in, int k, uint32_t *state)
{
    put_mis(in, 30, state);
    if (k % 2 == 0) /* far from 1, and like each other */
        in[1] = in[0] * between(state, 0.2f, 5);
}

static void mis_never(float *in, int k, uint32_t *state)
{
    put_mis(in, 1, state);
    in[k % 2] = 0;
}

/* N, and an eye at a cosine from low to 1. */
static float *put_eye(float *in, float low, uint32_t *state)
{
    const rt_vec3 n = any_direction(state);
    const float cosine = between(state, low, 1);
    const rt_vec3 side = rt_scale(across(n, state), sqrtf(1 - cosine * cosine));
    put_vec(&in, n);
    put_vec(&in, rt_normalize(rt_add(rt_scale(n, cosine), side)));
    return in;
}

static void gloss_drawn(float *in, int k, uint32_t *state)
{
    float *at = put_eye(in, 0.15f, state);
    (void)k;
    *at = between(state, 2, 200);
    put_two_numbers(at + 1, 1e-4f, state);
}

static void gloss_straight(float *in, int k, uint32_t *state)
{
    gloss_drawn(in, k, state);
    memcpy(in + 3, in, 3 * sizeof *in);
}

static void gloss_mirror(float *in, int k, uint32_t *state)
{
    gloss_drawn(in, k, state);
    in[6] = 1e6f;
    put_two_numbers(in + 7, 0.05f, state); /* not what is far off, and rare */
}

/* A light near where the mirror sends it, as far off as the lobe is wide, or anywhere above. */
static void put_gloss(float *in, float shininess, bool near, uint32_t *state)
{
    for (;;) {
        const float *from = in;
        float *at = put_eye(in, 0.1f, state);
        const rt_vec3 n = take_vec(&from), eye = take_vec(&from);
        const rt_vec3 mirrored = rt_sub(rt_scale(n, 2 * rt_dot(n, eye)), eye);
        const rt_vec3 off = rt_scale(any_direction(state), 2 / sqrtf(shininess));
        const rt_vec3 light =
            near ? rt_normalize(rt_add(mirrored, off)) : any_direction(state);
        put_vec(&at, light);
        *at = shininess;
        if (rt_dot(n, light) > 0.05f)
            return;
    }
}

static void gloss_wide(float *in, int k, uint32_t *state)
{
    const float shininess = between(state, 2, 50);
    put_gloss(in, shininess, k % 2 == 0, state);
}

static void gloss_sharp(float *in, int k, uint32_t *state)
{
    const float shininess = between(state, 200, 2000);
    (void)k;
    put_gloss(in, shininess, true, state);
}

static void gloss_below(float *in, int k, uint32_t *state)
{
    gloss_wide(in, k, state);
    float *const to = in + (k % 2 == 0 ? 3 : 6); /* the eye, or the light */
    for (int i = 0; i < 3; i++)
        to[i] = -to[i];
}

static void put_lens(float *in, bool anywhere, float radius, uint32_t *state)
{
    const rt_vec3 direction = anywhere ? any_direction(state) : rt_vec(0, 0, -1);
    const rt_vec3 up = anywhere ? across(direction, state) : rt_vec(0, 1, 0);
    put_vec(&in, vec_between(state, -9, 9));
    put_vec(&in, direction);
    put_vec(&in, up);
    *in++ = between(state, 20, 80);
    *in++ = radius;
    *in++ = between(state, 2, 30);
    *in++ = between(state, 0, 320);
    *in++ = between(state, 0, 240);
    put_two_numbers(in, 1e-4f, state);
}

static void lens_straight(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lens(in, false, between(state, 0.1f, 2), state);
}

static void lens_anywhere(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lens(in, true, between(state, 0.1f, 2), state);
}

static void lens_pinhole(float *in, int k, uint32_t *state)
{
    (void)k;
    put_lens(in, true, 0, state);
}

/* ---- judging answers ------------------------------------------------------------------- */

static int judge_leave(const float *in, const float *out, int count, char *why,
                       size_t size)
{
    for (int k = 0; k < count; k++) {
        const float *at = in + 9 * k, *start = out + 3 * k;
        const rt_vec3 point = take_vec(&at), normal = take_vec(&at),
                      direction = take_vec(&at);
        const rt_vec3 step = rt_sub(take_vec(&start), point);
        const float along =
            rt_dot(step, normal) * (rt_dot(normal, direction) < 0 ? -1.0f : 1.0f);
        const float aside =
            rt_length(rt_sub(step, rt_scale(normal, rt_dot(step, normal))));
        if (along > 1e-6f && along < 2e-2f && aside < 1e-4f)
            continue;
        snprintf(why, size, "%s",
                 !(along > 1e-6f)   ? "not on the side to which the ray goes"
                 : !(along < 2e-2f) ? "too far away from the surface"
                                    : "not straight above the surface");
        return k;
    }
    return count;
}

static int judge_encode(const float *in, const float *out, int count, char *why,
                        size_t size)
{
    (void)why, (void)size;
    for (int k = 0; k < count; k++) {
        const double value = (double)in[2 * k], gamma = (double)in[2 * k + 1];
        if (!(fabs((double)out[k] - 255.0 * pow(value, 1.0 / gamma)) <= 0.51))
            return k;
    }
    return count;
}

/* Chi-square of counts that should all be the same, as standard deviations of its normal
 * approximation (Wilson, Hilferty). Above LIMIT is wrong: a right routine gets there once in a
 * million times (one-sided, 4.75 sigma). */
#define LIMIT 4.75

static double surprise(const int *counts, int bins, int total)
{
    const double expected = (double)total / bins, n = bins - 1;
    double chi2 = 0.0;
    for (int i = 0; i < bins; i++)
        chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    return (cbrt(chi2 / n) - (1.0 - 2.0 / (9.0 * n))) / sqrt(2.0 / (9.0 * n));
}

static int bin_of(float v, int bins)
{
    const int bin = (int)(v * (float)bins);
    return bin < 0 ? 0 : bin < bins ? bin : bins - 1;
}

static int judge_uniform(const float *in, const float *out, int count, char *why,
                         size_t size)
{
    int counts[8][64] = {{0}}, squares[7][64] = {{0}}, neighbours[64] = {0};
    (void)in;
    for (int k = 0; k < count; k++) {
        const float *r = out + 8 * k;
        for (int i = 0; i < 8; i++) {
            if (!(r[i] > 0 && r[i] < 1))
                return snprintf(why, size, "%.9g is not in (0, 1)", (double)r[i]), k;
            counts[i][bin_of(r[i], 64)]++;
            if (i < 7)
                squares[i][8 * bin_of(r[i], 8) + bin_of(r[i + 1], 8)]++;
        }
        if (k > 0)
            neighbours[8 * bin_of(r[0], 8) + bin_of(r[-8], 8)]++;
    }
    for (int i = 0; i < 8; i++)
        if (surprise(counts[i], 64, count) > LIMIT)
            return snprintf(why, size, "number %d of a sample is not uniform", i), -1;
    for (int i = 0; i < 7; i++)
        if (surprise(squares[i], 64, count) > LIMIT)
            return snprintf(why, size,
                            "numbers %d and %d of a sample depend on each other", i,
                            i + 1),
                   -1;
    if (surprise(neighbours, 64, count - 1) > LIMIT)
        return snprintf(why, size,
                        "neighbouring pixels have numbers that depend on each other"),
               -1;
    return count;
}

static int judge_again(const float *in, const float *out, int count, char *why,
                       size_t size)
{
    (void)in;
    for (int k = count / 2; k < count; k++)
        if (memcmp(out + 8 * k, out + 8 * (k - count / 2), 8 * sizeof *out) != 0)
            return snprintf(why, size,
                            "another number when the same sample is asked again"),
                   k;
    return count;
}

static int judge_side(const float *in, const float *out, int count, char *why,
                      size_t size)
{
    for (int k = 0; k < count; k++) {
        const float *at = in + 5 * k, *to = out + 3 * k;
        const rt_vec3 normal = take_vec(&at), w = take_vec(&to);
        const float length = rt_length(w);
        if (!(fabsf(length - 1) < 1e-4f))
            return snprintf(why, size, "its length is %.6g, not 1", (double)length), k;
        if (!(rt_dot(w, normal) > -1e-6f))
            return snprintf(why, size, "it goes into the surface"), k;
    }
    return count;
}

static int judge_cosine(const float *in, const float *out, int count, char *why,
                        size_t size)
{
    int height[32] = {0}, around[32] = {0}, both[64] = {0};
    for (int k = 0; k < count; k++) {
        const float *at = in + 5 * k, *to = out + 3 * k;
        const rt_vec3 normal = take_vec(&at), w = take_vec(&to);
        rt_vec3 a, b;
        rt_basis(normal, &a, &b);
        const float z = rt_dot(w, normal);
        const float turn = 0.5f + atan2f(rt_dot(w, b), rt_dot(w, a)) / 6.2831853f;
        if (!(z >= -1e-6f && turn >= 0 && turn <= 1))
            return snprintf(why, size, "it goes into the surface"), k;
        height[bin_of(z * z, 32)]++; /* uniform, if the density is cosine / pi */
        around[bin_of(turn, 32)]++;
        both[8 * bin_of(z * z, 8) + bin_of(turn, 8)]++;
    }
    if (surprise(height, 32, count) > LIMIT)
        return snprintf(why, size, "too many directions are near the %s",
                        height[31] < count / 40 ? "surface" : "normal"),
               -1;
    if (surprise(around, 32, count) > LIMIT)
        return snprintf(why, size, "not the same all around the normal"), -1;
    if (surprise(both, 64, count) > LIMIT)
        return snprintf(why, size, "angle and height depend on each other"), -1;
    return count;
}

/* The mean of many paths against that of rt.h: both are known within their noise. */
static int judge_mean(const float *in, const float *out, int count, char *why,
                      size_t size)
{
    for (int c = 0; c < 3; c++) {
        double sum[2] = {0.0, 0.0}, squares[2] = {0.0, 0.0};
        for (int k = 0; k < count; k++) {
            float right[3];
            call_radiance(in + 9 * k, right);
            const double v[2] = {(double)out[3 * k + c], (double)right[c]};
            for (int i = 0; i < 2; i++) {
                sum[i] += v[i];
                squares[i] += v[i] * v[i];
            }
        }
        double variance = 0.0;
        for (int i = 0; i < 2; i++)
            variance += (squares[i] / count - sum[i] * sum[i] / count / count) / count;
        const double difference = fabs(sum[0] - sum[1]) / count;
        if (!(difference <= 5.0 * sqrt(variance) + 1e-5))
            return snprintf(
                       why, size,
                       "the mean of %d paths is %.4g, but %.4g is right (noise %.2g)",
                       count, sum[0] / count, sum[1] / count, sqrt(variance)),
                   -1;
    }
    return count;
}

/* ---- part two. Where a routine is free to use r1 and r2 in its own way, the answers are held
 * against what must be true of each, and their statistics against what they should be. */

static int judge_lamp_point(const float *in, const float *out, int count, char *why,
                            size_t size)
{
    for (int k = 0; k < count; k++) {
        const float *at = in + 15 * k, *to = out + 3 * k;
        const rt_lamp lamp = take_lamp(&at);
        const rt_vec3 point = take_vec(&at);
        const rt_vec3 off = rt_sub(take_vec(&to), lamp.center);
        if (lamp.radius > 0) {
            const float far = rt_length(off) / lamp.radius;
            if (!(fabsf(far - 1) < 1e-3f))
                return snprintf(why, size, "it is %.4g radii from the center",
                                (double)far),
                       k;
            /* at the rim of what is seen this is 0 */
            const rt_vec3 to_point = rt_sub(point, rt_add(lamp.center, off));
            if (!(rt_dot(off, to_point) > -5e-3f * lamp.radius * rt_length(to_point)))
                return snprintf(why, size, "it is on the far side of the ball"), k;
            continue;
        }
        const rt_vec3 n = rt_cross(lamp.u, lamp.v);
        const float nn = rt_dot(n, n);
        const float a = rt_dot(rt_cross(off, lamp.v), n) / nn,
                    b = rt_dot(rt_cross(lamp.u, off), n) / nn;
        if (!(fabsf(rt_dot(off, n)) < 1e-4f * sqrtf(nn) && fabsf(a) < 1.0001f &&
              fabsf(b) < 1.0001f))
            return snprintf(why, size, "it is not on the parallelogram"), k;
    }
    return count;
}

/* Two numbers for each answer that should be uniform in (0, 1), and independent. */
static int judge_two(const float (*two)[2], int count, const char *first,
                     const char *second, char *why, size_t size)
{
    int counts[2][32] = {{0}}, both[64] = {0};
    for (int k = 0; k < count; k++) {
        counts[0][bin_of(two[k][0], 32)]++;
        counts[1][bin_of(two[k][1], 32)]++;
        both[8 * bin_of(two[k][0], 8) + bin_of(two[k][1], 8)]++;
    }
    if (surprise(counts[0], 32, count) > LIMIT)
        return snprintf(why, size, "%s", first), -1;
    if (surprise(counts[1], 32, count) > LIMIT)
        return snprintf(why, size, "%s", second), -1;
    if (surprise(both, 64, count) > LIMIT)
        return snprintf(why, size, "the two random numbers depend on each other"), -1;
    return count;
}

static float uniform_pairs[MANY][2];

static float turn_of(float x, float y)
{
    return 0.5f + atan2f(y, x) / 6.2831853f;
}

/* Of a ball 1 - cos is uniform from 0 to that of the rim, and the turn around the middle; of a
 * parallelogram both coordinates are. */
static int judge_lamp_even(const float *in, const float *out, int count, char *why,
                           size_t size)
{
    const int wrong = judge_lamp_point(in, out, count, why, size);
    if (wrong != count)
        return wrong;
    for (int k = 0; k < count; k++) {
        const float *at = in + 15 * k, *to = out + 3 * k;
        const rt_lamp lamp = take_lamp(&at);
        const rt_vec3 point = take_vec(&at), end = take_vec(&to);
        float *two = uniform_pairs[k];
        if (lamp.radius > 0) {
            const rt_vec3 w = toward(point, end), to_center = rt_sub(lamp.center, point);
            const double s = (double)(lamp.radius * lamp.radius) /
                             (double)rt_dot(to_center, to_center);
            rt_vec3 a, b, n = rt_normalize(to_center);
            rt_basis(n, &a, &b);
            /* 1 - cos by the sine: no digits are lost */
            const double sine = (double)rt_length(rt_cross(w, n));
            const double down = sine * sine / (1 + (double)rt_dot(w, n));
            two[0] = (float)(down * (1 + sqrt(1 - s)) / s);
            two[1] = turn_of(rt_dot(w, a), rt_dot(w, b));
            continue;
        }
        const rt_vec3 off = rt_sub(end, lamp.center), n = rt_cross(lamp.u, lamp.v);
        const float nn = rt_dot(n, n);
        two[0] = 0.5f + 0.5f * rt_dot(rt_cross(off, lamp.v), n) / nn;
        two[1] = 0.5f + 0.5f * rt_dot(rt_cross(lamp.u, off), n) / nn;
    }
    const bool ball = in[3] > 0;
    return judge_two((const float(*)[2])uniform_pairs, count,
                     ball ? "not all directions within the cone are equally likely"
                          : "not all points along u are equally likely",
                     ball ? "not the same all around the middle of the ball"
                          : "not all points along v are equally likely",
                     why, size);
}

/* Within 2 %: 1 - <N,h>^2, as textbooks have it, is a small difference of large numbers in float, and
 * a lobe that is so sharp makes much of what is lost. */
static int judge_gloss(const float *in, const float *out, int count, char *why,
                       size_t size)
{
    for (int k = 0; k < count; k++) {
        float expected[2];
        call_gloss(in + 10 * k, expected);
        for (int i = 0; i < 2; i++)
            if (!(fabsf(out[2 * k + i] - expected[i]) <= 1e-4f + 0.02f * expected[i]))
                return snprintf(why, size, "%s is %.4g, %.4g is right",
                                i == 0 ? "gloss" : "density", (double)out[2 * k + i],
                                (double)expected[i]),
                       k;
    }
    return count;
}

static int judge_length(const float *in, const float *out, int count, char *why,
                        size_t size)
{
    (void)in;
    for (int k = 0; k < count; k++) {
        const float *to = out + 3 * k;
        const float length = rt_length(take_vec(&to));
        if (!(fabsf(length - 1) < 1e-4f))
            return snprintf(why, size, "its length is %.6g, not 1", (double)length), k;
    }
    return count;
}

static int judge_mirror(const float *in, const float *out, int count, char *why,
                        size_t size)
{
    for (int k = 0; k < count; k++) {
        const float *at = in + 9 * k, *to = out + 3 * k;
        const rt_vec3 n = take_vec(&at), eye = take_vec(&at);
        const rt_vec3 mirrored = rt_sub(rt_scale(n, 2 * rt_dot(n, eye)), eye);
        const float off = rt_length(rt_sub(take_vec(&to), mirrored));
        if (!(off < 0.1f))
            return snprintf(why, size, "far from the direction of a mirror"), k;
    }
    return count;
}

/* With the facet's normal h = (a x, a y, z) in a basis around N, (x, y, z) mirrors the eye, which
 * is stretched likewise, into a direction that is uniform on a cap: above -eye.z. */
static int judge_facets(const float *in, const float *out, int count, char *why,
                        size_t size)
{
    for (int k = 0; k < count; k++) {
        const float *at = in + 9 * k, *to = out + 3 * k;
        const rt_vec3 n = take_vec(&at), eye = take_vec(&at), w = take_vec(&to);
        const float a = sqrtf(2 / (take(&at) + 2));
        rt_vec3 x, y;
        rt_basis(n, &x, &y);
        const rt_vec3 h = rt_add(eye, w);
        const rt_vec3 m =
            rt_normalize(rt_vec(rt_dot(h, x) / a, rt_dot(h, y) / a, rt_dot(h, n)));
        const rt_vec3 e =
            rt_normalize(rt_vec(a * rt_dot(eye, x), a * rt_dot(eye, y), rt_dot(eye, n)));
        if (!(rt_length(w) > 0.99f && rt_length(w) < 1.01f))
            return snprintf(why, size, "its length is not 1"), k;
        const rt_vec3 c = rt_sub(rt_scale(m, 2 * rt_dot(e, m)), e);
        uniform_pairs[k][0] = (c.z + e.z) / (1 + e.z);
        uniform_pairs[k][1] = turn_of(c.x, c.y);
    }
    return judge_two((const float(*)[2])uniform_pairs, count,
                     "the facets are not chosen as often as the eye sees them",
                     "not the same all around", why, size);
}

/* From the lens, through the point that the pinhole's ray has in the sharp plane. */
static int judge_focus(const float *in, const float *out, int count, char *why,
                       size_t size)
{
    for (int k = 0; k < count; k++) {
        rt_camera camera;
        rt_lens lens;
        const float *at = in + 16 * k, *to = out + 6 * k;
        const rt_ray pinhole = take_pinhole(&at, &camera, &lens), ray = take_ray(&to);
        const rt_vec3 axis = rt_normalize(camera.direction);
        const rt_vec3 sharp =
            rt_scale(pinhole.direction, lens.focus / rt_dot(pinhole.direction, axis));
        const rt_vec3 off = rt_sub(ray.origin, camera.position);
        const rt_vec3 way = rt_sub(sharp, off);
        if (!(fabsf(rt_length(ray.direction) - 1) < 1e-4f))
            return snprintf(why, size, "its direction's length is not 1"), k;
        if (!(rt_length(off) < 1.001f * lens.radius + 1e-5f &&
              fabsf(rt_dot(off, axis)) < 1e-4f))
            return snprintf(why, size, "it does not begin on the lens"), k;
        if (!(rt_length(rt_cross(way, ray.direction)) < 1e-3f * rt_length(way) &&
              rt_dot(way, ray.direction) > 0))
            return snprintf(why, size, "it passes by the sharp point"), k;
    }
    return count;
}

static int judge_disc(const float *in, const float *out, int count, char *why,
                      size_t size)
{
    const int wrong = judge_focus(in, out, count, why, size);
    if (wrong != count)
        return wrong;
    for (int k = 0; k < count; k++) {
        rt_camera camera;
        rt_lens lens;
        const float *at = in + 16 * k, *to = out + 6 * k;
        take_pinhole(&at, &camera, &lens);
        rt_vec3 a, b;
        rt_basis(rt_normalize(camera.direction), &a, &b);
        const rt_vec3 off =
            rt_scale(rt_sub(take_vec(&to), camera.position), 1 / lens.radius);
        uniform_pairs[k][0] = rt_dot(off, off); /* of equal areas */
        uniform_pairs[k][1] = turn_of(rt_dot(off, a), rt_dot(off, b));
    }
    return judge_two(
        (const float(*)[2])uniform_pairs, count,
        "points of the lens are not equally likely near its middle and its rim",
        "not the same all around the lens", why, size);
}

/* Each ray goes through at least one triangle of its fan, and meets it at t = 1. */
static int judge_no_leak(const float *in, const float *out, int count, char *why,
                         size_t size)
{
    (void)in;
    for (int k = 0; k < count; k++) {
        const float *fan = out + 9 * (k / FAN * FAN);
        bool any = false;
        for (int i = 0; i < FAN; i++)
            any = any || fan[9 * i] > 0;
        if (!any)
            return snprintf(
                       why, size,
                       "a leak: the ray goes between this triangle and the next three, "
                       "which meet there"),
                   k;
        if (out[9 * k] > 0 && !(fabsf(out[9 * k + 1] - 1) < 1e-3f))
            return snprintf(why, size, "it is met at t = 1"), k;
    }
    return count;
}

/* ---- the table ------------------------------------------------------------------------- */

static const kind kinds[] = {
    {"rt_camera_ray", "looks along -z, 90 degrees", camera_straight, NULL, 0},
    {"rt_camera_ray", "other angles of view", camera_angles, NULL, 0},
    {"rt_camera_ray", "wide and high pictures", camera_sizes, NULL, 0},
    {"rt_camera_ray", "looks anywhere", camera_anywhere, NULL, 0},
    {"rt_camera_ray", "zeros: the defaults", camera_defaults, NULL, 0},
    {"rt_hit_sphere", "hits from outside", sphere_hit, NULL, 0},
    {"rt_hit_sphere", "directions of any length", sphere_long, NULL, 0},
    {"rt_hit_sphere", "passes by", sphere_miss, NULL, 0},
    {"rt_hit_sphere", "the sphere is behind", sphere_behind, NULL, 0},
    {"rt_hit_sphere", "from inside", sphere_inside, NULL, 0},
    {"rt_hit_sphere", "from close to the surface", sphere_close, NULL, 0},
    {"rt_hit_sphere", "t_max before or after the hit", sphere_limit, NULL, 0},
    {"rt_hit_sphere", "a wall of radius 1e5", sphere_wall, NULL, 0},
    {"rt_hit_sphere", "no direction, NaN, infinity", sphere_bad, NULL, 0},
    {"rt_intersect", "the nearest of eight shapes", world_ray, NULL, 0},
    {"rt_intersect", "nothing there", world_sky, NULL, 0},
    {"rt_intersect", "from close to a surface", world_close, NULL, 0},
    {"rt_lambert", "a light straight above, at distance 1", lambert_above, NULL, 0},
    {"rt_lambert", "at any angle", lambert_angle, NULL, 0},
    {"rt_lambert", "at any distance", lambert_far, NULL, 0},
    {"rt_lambert", "behind the surface", lambert_behind, NULL, 0},
    {"rt_hit_box", "hits from outside", box_hit, NULL, 0},
    {"rt_hit_box", "directions of any length", box_long, NULL, 0},
    {"rt_hit_box", "passes by", box_miss, NULL, 0},
    {"rt_hit_box", "the box is behind", box_behind, NULL, 0},
    {"rt_hit_box", "from inside", box_inside, NULL, 0},
    {"rt_hit_box", "from close to the surface", box_close, NULL, 0},
    {"rt_hit_box", "t_max before or after the hit", box_limit, NULL, 0},
    {"rt_hit_box", "along an axis", box_parallel, NULL, 0},
    {"rt_hit_box", "no direction, NaN, infinity", box_bad, NULL, 0},
    {"rt_leave", "on the outside", leave_above, judge_leave, 0},
    {"rt_leave", "through the surface", leave_below, judge_leave, 0},
    {"rt_occluded", "something in between, or beyond t_max", world_limit, NULL, 0},
    {"rt_occluded", "nothing there", world_sky, NULL, 0},
    {"rt_occluded", "from close to a surface", world_close, NULL, 0},
    {"rt_visible", "lights seen, and lights hidden", visible_or_not, NULL, 0},
    {"rt_visible", "lights in front of something", visible_before, NULL, 0},
    {"rt_direct", "one light or two", direct_lights, NULL, 0},
    {"rt_direct", "no light", direct_none, NULL, 0},
    {"rt_encode", "from 0 to 1, gamma 2.2", encode_between, judge_encode, 0},
    {"rt_encode", "other gammas", encode_linear, judge_encode, 0},
    {"rt_encode", "below 0 and above 1", encode_outside, NULL, 0},
    {"rt_encode", "NaN, infinity", encode_bad, NULL, 0},
    {"rt_reflect", "unit vectors", reflect_unit, NULL, 0},
    {"rt_reflect", "of any length", reflect_long, NULL, 0},
    {"rt_random", "uniform, and independent", random_pixels, judge_uniform, MANY},
    {"rt_random", "the same for the same sample", random_again, judge_again, 0},
    {"rt_sample_cosine", "unit length, on the side of N", cosine_any, judge_side, 0},
    {"rt_sample_cosine", "N along an axis", cosine_axes, judge_side, 0},
    {"rt_sample_cosine", "density cosine / pi", cosine_any, judge_cosine, MANY},
    {"rt_radiance", "direct light", radiance_direct, NULL, 0},
    {"rt_radiance", "background", radiance_sky, NULL, 0},
    {"rt_radiance", "one mirror", radiance_mirror, NULL, 0},
    {"rt_radiance", "indirect light", radiance_mean, judge_mean, MANY},
    {"rt_fresnel", "straight on", fresnel_straight, NULL, 0},
    {"rt_fresnel", "from outside, at any angle", fresnel_outside, NULL, 0},
    {"rt_fresnel", "from inside, where light comes out", fresnel_inside, NULL, 0},
    {"rt_fresnel", "from inside: total reflection", fresnel_total, NULL, 0},
    {"rt_refract", "straight on", refract_straight, NULL, 0},
    {"rt_refract", "into the glass", refract_into, NULL, 0},
    {"rt_refract", "out of the glass", refract_out, NULL, 0},
    {"rt_refract", "total reflection: no way through", refract_total, NULL, 0},
    {"rt_sample_lamp", "points of a ball that are seen", sample_ball, judge_lamp_point,
     0},
    {"rt_sample_lamp", "points of a parallelogram", sample_flat, judge_lamp_point, 0},
    {"rt_sample_lamp", "a ball, evenly", sample_ball, judge_lamp_even, MANY},
    {"rt_sample_lamp", "a parallelogram, evenly", sample_flat, judge_lamp_even, MANY},
    {"rt_lamp_density", "a ball", density_ball, NULL, 0},
    {"rt_lamp_density", "a small ball far away", density_small, NULL, 0},
    {"rt_lamp_density", "a parallelogram", density_flat, NULL, 0},
    {"rt_lamp_density", "from within a ball", density_within, NULL, 0},
    {"rt_mis", "both are likely", mis_both, NULL, 0},
    {"rt_mis", "one of the two never", mis_never, NULL, 0},
    {"rt_mis", "very large and very small densities", mis_extreme, NULL, 0},
    {"rt_sample_gloss", "unit length", gloss_drawn, judge_length, 0},
    {"rt_sample_gloss", "the sharpest: close to a mirror", gloss_mirror, judge_mirror, 0},
    {"rt_sample_gloss", "straight on, as dense as it should", gloss_straight,
     judge_facets, MANY},
    {"rt_sample_gloss", "at any angle, as dense as it should", gloss_drawn, judge_facets,
     MANY},
    {"rt_gloss", "shininess 2 to 50", gloss_wide, NULL, 0},
    {"rt_gloss", "shininess 200 to 2000", gloss_sharp, judge_gloss, 0},
    {"rt_gloss", "eye or light below the surface", gloss_below, NULL, 0},
    {"rt_lens_ray", "through the sharp point, looks along -z", lens_straight, judge_focus,
     0},
    {"rt_lens_ray", "looks anywhere", lens_anywhere, judge_focus, 0},
    {"rt_lens_ray", "points of the lens, evenly", lens_straight, judge_disc, MANY},
    {"rt_lens_ray", "radius 0: the pinhole's ray", lens_pinhole, NULL, 0},
    {"rt_hit_triangle", "hits from outside", triangle_hit, NULL, 0},
    {"rt_hit_triangle", "hits from inside", triangle_back, NULL, 0},
    {"rt_hit_triangle", "from close to it", triangle_close, NULL, 0},
    {"rt_hit_triangle", "directions of any length", triangle_long, NULL, 0},
    {"rt_hit_triangle", "small triangles", triangle_small, NULL, 0},
    {"rt_hit_triangle", "passes by", triangle_miss, NULL, 0},
    {"rt_hit_triangle", "the triangle is behind", triangle_behind, NULL, 0},
    {"rt_hit_triangle", "t_max before or after the hit", triangle_limit, NULL, 0},
    {"rt_hit_triangle", "without area, or from the edge", triangle_flat, NULL, 0},
    {"rt_hit_triangle", "no direction, NaN, infinity", triangle_bad, NULL, 0},
    {"rt_hit_triangle", "to a common edge or corner: no leak", triangle_fan,
     judge_no_leak, MANY},
    {"rt_hit_triangle", "far away", triangle_far, NULL, 0},
};

enum { KINDS = sizeof kinds / sizeof kinds[0] };

#endif

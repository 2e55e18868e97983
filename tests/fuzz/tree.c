/* The tree against the loop: random scenes of all kinds of shapes, of all sizes, with
 * copies, lattices and slivers, and rays that graze them. The search of the last section,
 * that of chapter 8 and the loop of chapter 2 must agree to the bit.
 *
 *     tree SECONDS [SEED]
 */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define RT_IMPLEMENTATION
#include "../../rt.h"

enum { MOST = 600 };

static rt_sphere spheres[MOST];
static rt_box boxes[MOST];
static rt_vec3 positions[3 * MOST];
static int indices[3 * MOST];
static rt_mesh meshes[4];
static rt_custom_shape custom[MOST];
static rt_sphere inner[MOST]; /* of the custom shapes */
static rt_scene scene;
static rt_rng rng;
static float scale;
static int lattice; /* coordinates are whole multiples of scale */

static float uniform(float low, float high)
{
    return low + (high - low) * rt_random(&rng);
}

static int below(int n)
{
    const int k = (int)(rt_random(&rng) * (float)n);
    return k < n ? k : n - 1;
}

static float coordinate(void)
{
    float x = uniform(-4, 4);
    if (lattice)
        x = floorf(x + 0.5f);
    else if (below(8) == 0)
        x *= powf(10, uniform(-7, 0));
    return x * scale;
}

static rt_vec3 point(void)
{
    const float x = coordinate(), y = coordinate(), z = coordinate();
    return rt_vec(x, y, z);
}

static float length(void)
{
    const float x = lattice ? (float)(1 + below(3)) : powf(10, uniform(-4, 0.7f));
    return x * scale;
}

/* A sphere as a custom shape. */
static bool hit_inner(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_sphere *s = (const rt_sphere *)data;
    if (!rt_hit_sphere(s, ray, t_max, hit))
        return false;
    hit->normal = rt_sub(hit->point, s->center);
    hit->part = 7;
    return true;
}

static void make_scene(void)
{
    const float scales[] = {1, 1, 1, 1e-3f, 1e3f, 1e6f, 3e13f, 1e-12f, 1e-30f, 1e-40f};
    const int most[] = {3, 12, 40, 150, MOST};
    scale = scales[below(10)];
    lattice = below(3) == 0;
    const int n = most[below(5)];
    memset(&scene, 0, sizeof scene);
    const int kinds = below(16); /* which to leave out */
    scene.sphere_count = (kinds & 1) != 0 ? 0 : below(n);
    scene.box_count = (kinds & 2) != 0 ? 0 : below(n);
    scene.custom_shape_count = (kinds & 4) != 0 ? 0 : below(n);
    const int triangles = (kinds & 8) != 0 ? 0 : below(n);
    for (int i = 0; i < scene.sphere_count; i++) {
        spheres[i].center = point();
        spheres[i].radius = length();
        if (!(spheres[i].radius > 0))
            spheres[i].radius = FLT_MIN;
        if (i > 0 && below(5) == 0)
            spheres[i] = spheres[below(i)];
    }
    for (int i = 0; i < scene.box_count; i++) {
        const rt_vec3 size = rt_vec(length(), length(), length());
        boxes[i].min = point();
        boxes[i].max = rt_add(boxes[i].min, size);
        if (below(4) == 0)
            boxes[i].max.x = boxes[i].min.x;
        if (below(6) == 0)
            boxes[i].max.z = boxes[i].min.z;
        if (i > 0 && below(5) == 0)
            boxes[i] = boxes[below(i)];
    }
    for (int i = 0; i < scene.custom_shape_count; i++) {
        inner[i].center = point();
        inner[i].radius = length();
        if (!(inner[i].radius > 0))
            inner[i].radius = FLT_MIN;
        if (i > 0 && below(5) == 0)
            inner[i] = inner[below(i)];
        const float r = inner[i].radius;
        custom[i].min = rt_sub(inner[i].center, rt_vec(r, r, r));
        custom[i].max = rt_add(inner[i].center, rt_vec(r, r, r));
        custom[i].hit = hit_inner;
        custom[i].data = &inner[i];
    }
    int corners = 1 + below(3 * n);
    for (int i = 0; i < corners; i++) {
        positions[i] = point();
        if (i > 0 && below(3) > 0) /* small triangles */
            positions[i] = rt_add(positions[below(i)],
                                  rt_vec(length(), lattice ? 0 : length(), -length()));
        if (!(rt_length(positions[i]) < 1e15f)) /* rt_check_scene would refuse it */
            positions[i] = point();
        if (below(10) == 0)
            positions[i].y = 0;
    }
    for (int i = 0; i < 3 * triangles; i++)
        indices[i] = i % 3 == 0 ? below(corners) : (indices[i - 1] + below(3)) % corners;
    for (int i = 6; i < 3 * triangles; i += 3)
        if (below(6) == 0) /* copies, turned */
            for (int k = 0; k < 3; k++)
                indices[i + k] = indices[i - 6 + (k + i) % 3];
    scene.mesh_count = 1 + below(4);
    for (int i = 0, first = 0; i < scene.mesh_count; i++) {
        rt_mesh *m = &meshes[i];
        m->positions = positions;
        m->position_count = corners;
        m->indices = indices + 3 * first;
        m->triangle_count =
            i == scene.mesh_count - 1 ? triangles - first : below(triangles - first + 1);
        first += m->triangle_count;
    }
    scene.spheres = spheres;
    scene.boxes = boxes;
    scene.meshes = meshes;
    scene.custom_shapes = custom;
}

/* A place related to a shape. */
static rt_vec3 target(void)
{
    const int kind = below(5);
    if (kind == 0 && scene.sphere_count > 0) {
        const rt_sphere *s = &spheres[below(scene.sphere_count)];
        const rt_vec3 d = rt_vec(uniform(-1, 1), uniform(-1, 1), uniform(-1, 1));
        return rt_add(s->center, rt_scale(rt_normalize(d), s->radius * (float)below(3)));
    }
    if (kind == 1 && scene.box_count > 0) {
        const rt_box *b = &boxes[below(scene.box_count)];
        return rt_vec(below(2) ? b->min.x : b->max.x,
                      below(2) ? b->min.y : uniform(b->min.y, b->max.y),
                      below(2) ? b->max.z : uniform(b->min.z, b->max.z));
    }
    if (kind <= 3) {
        const rt_mesh *m = &meshes[below(scene.mesh_count)];
        if (m->triangle_count > 0) {
            const int i = below(m->triangle_count), k = below(3);
            const rt_vec3 a = rt_corner(m, i, k), b = rt_corner(m, i, (k + 1) % 3);
            const rt_vec3 c = rt_corner(m, i, (k + 2) % 3);
            const float u = below(2) ? rt_random(&rng) : 0.5f * (float)below(3);
            const float v = below(2) ? 0 : (1 - u) * rt_random(&rng);
            return rt_add(rt_scale(a, 1 - u - v), rt_add(rt_scale(b, u), rt_scale(c, v)));
        }
    }
    return point();
}

static rt_ray make_ray(void)
{
    rt_ray ray;
    ray.origin = below(3) == 0 ? target() : point();
    if (below(4) == 0)
        ray.origin = rt_scale(ray.origin, powf(10, uniform(0, 3)));
    const rt_vec3 way = rt_sub(target(), ray.origin);
    ray.direction = below(2) ? way : rt_normalize(way);
    if (below(4) == 0)
        ray.direction.x = 0;
    if (below(4) == 0)
        ray.direction.y = -0.0f;
    if (below(8) == 0)
        ray.direction.z *= 1e-20f;
    if (below(6) == 0)
        ray.direction = rt_scale(ray.direction, powf(10, uniform(-30, 30)));
    return ray;
}

static bool same(const rt_hit *a, const rt_hit *b)
{
    return memcmp(&a->t, &b->t, sizeof a->t) == 0 && a->shape == b->shape &&
           a->part == b->part && memcmp(&a->u, &b->u, sizeof a->u) == 0 &&
           memcmp(&a->v, &b->v, sizeof a->v) == 0 &&
           memcmp(&a->point, &b->point, sizeof a->point) == 0 &&
           memcmp(&a->normal, &b->normal, sizeof a->normal) == 0 &&
           a->inside == b->inside && a->material == b->material;
}

static long rays, hits;

static void compare(const rt_scene *trees, const rt_ray *ray, uint32_t number)
{
    rt_hit loop, tree;
    memset(&loop, 0, sizeof loop);
    const bool hit = rt_intersect(&scene, ray, &loop);
    const float t_max = below(2) ? 1.0f : hit && below(2) ? loop.t : FLT_MAX;
    const bool blocked = rt_occluded(&scene, ray, t_max);
    rays++;
    hits += hit;
    for (int k = 0; k < 2; k++) {
        memset(&tree, 0, sizeof tree);
        if (rt_intersect(&trees[k], ray, &tree) == hit && same(&loop, &tree) &&
            rt_occluded(&trees[k], ray, t_max) == blocked)
            continue;
        printf("scene %u, search %d, scale %g: C %.9g %.9g %.9g u %.9g %.9g %.9g\n",
               number, k, (double)scale, (double)ray->origin.x, (double)ray->origin.y,
               (double)ray->origin.z, (double)ray->direction.x, (double)ray->direction.y,
               (double)ray->direction.z);
        printf("loop: %d shape %d part %d t %.9g; tree: shape %d part %d t %.9g; blocked "
               "%d\n",
               hit, loop.shape, loop.part, (double)loop.t, tree.shape, tree.part,
               (double)tree.t, blocked);
        exit(1);
    }
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 10;
    uint32_t number = argc > 2 ? (uint32_t)atol(argv[2]) : 0, first = number;
    const time_t start = time(NULL);
    for (; difftime(time(NULL), start) < seconds; number++) {
        rng = rt_rng_start(number, 1, 2);
        make_scene();
        rt_bvh bvhs[2];
        rt_scene trees[2] = {scene, scene};
        const rt_status status = rt_build_bvh(&scene, &bvhs[0]);
        if (status != RT_OK)
            return printf("scene %u: %s\n", number, rt_status_text(status)), 1;
        bvhs[1] = bvhs[0];
        bvhs[1].search = NULL;
        trees[0].bvh = &bvhs[0];
        trees[1].bvh = &bvhs[1];
        for (int i = 0; i < 400; i++) {
            const rt_ray ray = make_ray();
            compare(trees, &ray, number);
        }
        rt_free_bvh(&bvhs[0]);
    }
    printf("%u scenes, %ld rays, %ld hits, %d lanes\n", number - first, rays, hits,
           rt_lane_count(0));
    return 0;
}

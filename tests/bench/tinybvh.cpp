/* tinybvh as a candidate: meshes in its tree of eight boxes a node, BVH8_CPU; spheres in its tree
 * of two, BVH, the only one that knows shapes which are not triangles. They are asked by a
 * function of ours, in float. */
#include "candidate.h"
#include <cstdlib>
#include <cstring>
#define TINYBVH_IMPLEMENTATION
#include "tiny_bvh.h"

using namespace tinybvh;

/* Its trees ask for memory here, so that what they hold is counted. */
static void *counted(size_t size, void *bytes)
{
    size_t *memory = (size_t *)malloc64(size + 64);
    *(size_t *)bytes += *memory = size;
    return memory + 8;
}

static void give_back(void *memory, void *bytes)
{
    if (!memory)
        return;
    size_t *whole = (size_t *)memory - 8;
    *(size_t *)bytes -= *whole;
    free64(whole);
}

struct wide_tree {
    size_t bytes; /* first made, last destroyed */
    BVHContext context;
    BVH8_CPU wide;
    BVH binary;
    const rt_scene *scene;
    bvhvec4 *corners;

    explicit wide_tree(const rt_scene *of)
        : bytes(0), context{counted, give_back, &bytes}, wide(context), binary(context),
          scene(of), corners(nullptr)
    {
    }
};

static const rt_sphere *spheres; /* its functions are told the number only */

static void bounds(unsigned i, bvhvec3 &low, bvhvec3 &high)
{
    const rt_sphere &s = spheres[i];
    const bvhvec3 center(s.center.x, s.center.y, s.center.z), r(s.radius);
    low = center - r;
    high = center + r;
}

/* t of the sphere's first point within 0 < t < ray.hit.t, or 0. b^2 - c would be a difference of
 * two large numbers: see rt_hit_sphere. */
static float meet(const Ray &ray, unsigned i)
{
    const rt_sphere &s = spheres[i];
    const bvhvec3 f = ray.O - bvhvec3(s.center.x, s.center.y, s.center.z);
    const float b = tinybvh_dot(f, ray.D), rr = s.radius * s.radius;
    const bvhvec3 l = f - b * ray.D;
    const float squared = rr - tinybvh_dot(l, l);
    if (!(squared >= 0.0f))
        return 0.0f;
    const float root = sqrtf(squared), t = -b - root > 0.0f ? -b - root : -b + root;
    return t > 0.0f && t < ray.hit.t ? t : 0.0f;
}

static bool intersect(Ray &ray, unsigned i)
{
    const float t = meet(ray, i);
    if (!(t > 0.0f))
        return false;
    ray.hit.t = t;
    ray.hit.prim = i;
    return true;
}

static bool occluded(const Ray &ray, unsigned i)
{
    return meet(ray, i) > 0.0f;
}

static void *open(const rt_scene *scene, int threads)
{
    wide_tree *tree = new wide_tree(scene);
    tree->wide.bvh8.bvh.threadedBuild = tree->binary.threadedBuild = threads > 1;
    tree->binary.customIntersect = intersect;
    tree->binary.customIsOccluded = occluded;
    return tree;
}

static void build(void *of)
{
    wide_tree *tree = (wide_tree *)of;
    spheres = tree->scene->spheres;
    tree->binary.Build(bounds, (uint32_t)tree->scene->sphere_count);
}

static size_t bytes(void *tree)
{
    return ((wide_tree *)tree)->bytes;
}

/* It makes the direction a unit vector, so that t is another. */
static Ray asked_of(const rt_ray &r, float t_max, float *length)
{
    *length = rt_length(r.direction);
    return Ray(bvhvec3(r.origin.x, r.origin.y, r.origin.z),
               bvhvec3(r.direction.x, r.direction.y, r.direction.z),
               t_max < BVH_FAR ? t_max * *length : BVH_FAR);
}

static void nearest(void *of, const rt_ray *rays, int count, float *t)
{
    const wide_tree *tree = (const wide_tree *)of;
    for (int i = 0; i < count; i++) {
        float length;
        Ray ray = asked_of(rays[i], INFINITY, &length);
        tree->binary.Intersect(ray);
        t[i] = ray.hit.t < BVH_FAR ? ray.hit.t / length : INFINITY;
    }
}

static void blocked(void *of, const rt_ray *rays, int count, float *t)
{
    const wide_tree *tree = (const wide_tree *)of;
    for (int i = 0; i < count; i++) {
        float length;
        const Ray ray = asked_of(rays[i], 1.0f, &length);
        t[i] = tree->binary.IsOccluded(ray) ? 1.0f : INFINITY;
    }
}

static void close(void *of)
{
    wide_tree *tree = (wide_tree *)of;
    free(tree->corners);
    delete tree;
}

const candidate tinybvh_wide = {"tinybvh", open, build, bytes, nearest, blocked, close};

/* tinybvh as a candidate: meshes in its tree of eight boxes a node, BVH8_CPU; spheres in its tree
 * of two, BVH, the only one that knows shapes which are not triangles. They are asked by a
 * function of ours, in float. */
#include "candidate.h"
#include <cstdlib>
#include <cstring>
#include <vector>
#define TINYBVH_IMPLEMENTATION
#include "tiny_bvh.h"

using namespace tinybvh;

struct wide_tree {
    BVH8_CPU wide;
    BVH binary;
    const rt_scene *scene;
    std::vector<bvhvec4> corners; /* of the mesh, as it wants them */
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
    wide_tree *tree = new wide_tree;
    tree->scene = scene;
    tree->wide.bvh8.bvh.threadedBuild = tree->binary.threadedBuild = threads > 1;
    for (int i = 0; scene->mesh_count && i < scene->meshes->position_count; i++) {
        const rt_vec3 p = scene->meshes->positions[i];
        tree->corners.push_back(bvhvec4(p.x, p.y, p.z, 0));
    }
    tree->binary.customIntersect = intersect;
    tree->binary.customIsOccluded = occluded;
    return tree;
}

static void build(void *of)
{
    wide_tree *tree = (wide_tree *)of;
    spheres = tree->scene->spheres;
    if (tree->scene->mesh_count)
        tree->wide.Build(tree->corners.data(),
                         (const uint32_t *)tree->scene->meshes->indices,
                         (uint32_t)tree->scene->meshes->triangle_count);
    else
        tree->binary.Build(bounds, (uint32_t)tree->scene->sphere_count);
}

/* Of what it asks; the trees that it makes on the way stay, too, but need not. */
static size_t bytes(void *of)
{
    const wide_tree *tree = (const wide_tree *)of;
    return tree->scene->mesh_count ? tree->wide.usedBlocks * (size_t)64
                                   : tree->binary.usedNodes * sizeof(BVH::BVHNode) +
                                         tree->binary.idxCount * sizeof(uint32_t);
}

/* It makes the direction a unit vector, so that t is another. */
static Ray asked_of(const rt_ray &r, float t_max, float *length)
{
    *length = rt_length(r.direction);
    return Ray(bvhvec3(r.origin.x, r.origin.y, r.origin.z),
               bvhvec3(r.direction.x, r.direction.y, r.direction.z),
               t_max < BVH_FAR ? t_max * *length : BVH_FAR);
}

template <typename Tree>
static void all_nearest(const Tree &tree, const rt_ray *rays, int count, float *t)
{
    for (int i = 0; i < count; i++) {
        float length;
        Ray ray = asked_of(rays[i], INFINITY, &length);
        tree.Intersect(ray);
        t[i] = ray.hit.t < BVH_FAR ? ray.hit.t / length : INFINITY;
    }
}

template <typename Tree>
static void all_blocked(const Tree &tree, const rt_ray *rays, int count, float *t)
{
    for (int i = 0; i < count; i++) {
        float length;
        const Ray ray = asked_of(rays[i], 1.0f, &length);
        t[i] = tree.IsOccluded(ray) ? 1.0f : INFINITY;
    }
}

static void nearest(void *of, const rt_ray *rays, int count, float *t)
{
    const wide_tree *tree = (const wide_tree *)of;
    if (tree->scene->mesh_count)
        all_nearest(tree->wide, rays, count, t);
    else
        all_nearest(tree->binary, rays, count, t);
}

static void blocked(void *of, const rt_ray *rays, int count, float *t)
{
    const wide_tree *tree = (const wide_tree *)of;
    if (tree->scene->mesh_count)
        all_blocked(tree->wide, rays, count, t);
    else
        all_blocked(tree->binary, rays, count, t);
}

static void close(void *of)
{
    delete (wide_tree *)of;
}

const candidate tinybvh_wide = {"tinybvh", open, build, bytes, nearest, blocked, close};

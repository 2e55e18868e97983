/* Embree 3 as a candidate, ray by ray: as it is by default, and with its robust traversal and
 * the tree of the best quality. Spheres are its own kind of geometry. */
#include <embree3/rtcore.h>
#include <stdio.h>
#include <stdlib.h>
#include "candidate.h"

typedef struct embree_tree {
    RTCDevice device;
    RTCScene scene;
    float (*balls)[4];
    size_t bytes;
} embree_tree;

static bool count_bytes(void *tree, ssize_t bytes, bool after)
{
    (void)after;
    __atomic_fetch_add(&((embree_tree *)tree)->bytes, (size_t)bytes, __ATOMIC_RELAXED);
    return true;
}

static RTCGeometry spheres_of(embree_tree *e, const rt_scene *scene)
{
    const size_t count = (size_t)scene->sphere_count;
    e->balls = malloc(count * sizeof *e->balls);
    for (size_t i = 0; i < count; i++) {
        const rt_sphere *s = &scene->spheres[i];
        const float ball[4] = {s->center.x, s->center.y, s->center.z, s->radius};
        memcpy(e->balls[i], ball, sizeof ball);
    }
    RTCGeometry shape = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_SPHERE_POINT);
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT4,
                               e->balls, 0, sizeof *e->balls, count);
    return shape;
}

static RTCGeometry mesh_of(embree_tree *e, const rt_mesh *mesh)
{
    RTCGeometry shape = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                               mesh->positions, 0, sizeof *mesh->positions,
                               (size_t)mesh->position_count);
    rtcSetSharedGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                               mesh->indices, 0, 3 * sizeof *mesh->indices,
                               (size_t)mesh->triangle_count);
    return shape;
}

static void *open_scene(const rt_scene *scene, int threads, bool robust)
{
    char settings[40];
    embree_tree *e = calloc(1, sizeof *e);
    snprintf(settings, sizeof settings, "threads=%d", threads);
    e->device = rtcNewDevice(settings);
    rtcSetDeviceMemoryMonitorFunction(e->device, count_bytes, e);
    e->scene = rtcNewScene(e->device);
    if (robust) {
        rtcSetSceneFlags(e->scene, RTC_SCENE_FLAG_ROBUST);
        rtcSetSceneBuildQuality(e->scene, RTC_BUILD_QUALITY_HIGH);
    }
    RTCGeometry shape =
        scene->mesh_count ? mesh_of(e, &scene->meshes[0]) : spheres_of(e, scene);
    rtcCommitGeometry(shape);
    rtcAttachGeometry(e->scene, shape);
    rtcReleaseGeometry(shape);
    return e;
}

static void *open_default(const rt_scene *scene, int threads)
{
    return open_scene(scene, threads, false);
}

static void *open_robust(const rt_scene *scene, int threads)
{
    return open_scene(scene, threads, true);
}

static void build(void *tree)
{
    rtcCommitScene(((embree_tree *)tree)->scene);
}

static size_t bytes(void *tree)
{
    return ((embree_tree *)tree)->bytes;
}

static void set_ray(struct RTCRay *to, const rt_ray *ray, float t_max)
{
    to->org_x = ray->origin.x;
    to->org_y = ray->origin.y;
    to->org_z = ray->origin.z;
    to->dir_x = ray->direction.x;
    to->dir_y = ray->direction.y;
    to->dir_z = ray->direction.z;
    to->tnear = to->time = 0.0f;
    to->tfar = t_max;
    to->mask = ~0u;
    to->id = to->flags = 0;
}

static void nearest(void *tree, const rt_ray *rays, int count, float *t)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int i = 0; i < count; i++) {
        struct RTCRayHit asked;
        set_ray(&asked.ray, &rays[i], INFINITY);
        asked.hit.geomID = asked.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
        rtcIntersect1(((embree_tree *)tree)->scene, &context, &asked);
        t[i] = asked.hit.geomID == RTC_INVALID_GEOMETRY_ID ? INFINITY : asked.ray.tfar;
    }
}

static void blocked(void *tree, const rt_ray *rays, int count, float *t)
{
    struct RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    for (int i = 0; i < count; i++) {
        struct RTCRay asked;
        set_ray(&asked, &rays[i], 1.0f);
        rtcOccluded1(((embree_tree *)tree)->scene, &context, &asked);
        t[i] = asked.tfar < 0.0f ? 1.0f : INFINITY;
    }
}

static void close_scene(void *tree)
{
    embree_tree *e = tree;
    rtcReleaseScene(e->scene);
    rtcReleaseDevice(e->device);
    free(e->balls);
    free(e);
}

const candidate embree = {"Embree", open_default, build,      bytes,
                          nearest,  blocked,      close_scene};
const candidate embree_robust = {"Embree, robust", open_robust, build,      bytes,
                                 nearest,          blocked,     close_scene};

/* The routines that a student may replace, as functions from numbers to numbers: so that a
 * program that holds the student's (pupil.c) can be asked what another (grade.c), which holds
 * rt.h's, knows the answer to. Both include this file; the names rt_... below mean whichever
 * routine the program has. */
#ifndef ROUTINES_H
#define ROUTINES_H

#include "../../rt.h"

enum { MAX_IN = 16, MAX_OUT = 10, MAX_FIELDS = 10 };

typedef struct field {
    const char *name;
    int size; /* how many numbers */
} field;

typedef struct routine {
    const char *name;
    int chapter;
    field in[MAX_FIELDS], out[MAX_FIELDS]; /* up to one without a name */
    void (*call)(const float *in, float *out);
} routine;

static inline int field_count(const field *fields)
{
    int sum = 0;
    for (int i = 0; i < MAX_FIELDS && fields[i].name; i++)
        sum += fields[i].size;
    return sum;
}

/* ---- numbers to vectors and back; p moves on ----------------------------------------- */

static inline float take(const float **p)
{
    return *(*p)++;
}

static inline rt_vec3 take_vec(const float **p)
{
    *p += 3;
    return rt_vec((*p)[-3], (*p)[-2], (*p)[-1]);
}

static inline rt_ray take_ray(const float **p)
{
    rt_ray ray;
    ray.origin = take_vec(p);
    ray.direction = take_vec(p);
    return ray;
}

static inline void put_vec(float **p, rt_vec3 v)
{
    *(*p)++ = v.x;
    *(*p)++ = v.y;
    *(*p)++ = v.z;
}

/* What a hit says, all zero if there is none; shape is right if the material is. */
static inline void put_hit(float *out, bool found, const rt_hit *hit, float shape)
{
    *out++ = found ? 1.0f : 0.0f;
    *out++ = found ? hit->t : 0.0f;
    put_vec(&out, found ? hit->point : rt_vec(0, 0, 0));
    put_vec(&out, found ? hit->normal : rt_vec(0, 0, 0));
    *out = found ? shape : 0.0f;
}

/* ---- scenes, each the same whenever its number comes ---------------------------------- */

enum { SPHERES = 5, BOXES = 3, LIGHTS = 2 };

typedef struct world {
    rt_sphere spheres[SPHERES];
    rt_box boxes[BOXES];
    rt_light lights[LIGHTS];
    rt_scene scene;
} world;

static inline float between(uint32_t *state, float low, float high)
{
    *state = rt_hash(*state);
    return low + (high - low) * ((float)(*state >> 8) / 16777216.0f);
}

static inline rt_vec3 vec_between(uint32_t *state, float low, float high)
{
    const float x = between(state, low, high);
    const float y = between(state, low, high);
    const float z = between(state, low, high);
    return rt_vec(x, y, z);
}

/* A floor, four balls (number 4 is a mirror in scenes with an odd number), three boxes. */
static inline void make_world(world *w, float number)
{
    uint32_t state = rt_hash((uint32_t)number);
    memset(w, 0, sizeof *w);
    for (int i = 0; i < SPHERES; i++) {
        rt_sphere *s = &w->spheres[i];
        s->center = vec_between(&state, -5, 5);
        s->radius = between(&state, 0.5f, 2);
        s->material.albedo = vec_between(&state, 0.2f, 0.9f);
    }
    w->spheres[0].center = rt_vec(0, -107, 0);
    w->spheres[0].radius = 100;
    w->spheres[4].material.mirror = (int)number % 2 == 1;
    for (int i = 0; i < BOXES; i++) {
        rt_box *b = &w->boxes[i];
        b->min = vec_between(&state, -5, 4);
        b->max = rt_add(b->min, vec_between(&state, 0.5f, 2.5f));
        b->material.albedo = vec_between(&state, 0.2f, 0.9f);
    }
    for (int i = 0; i < LIGHTS; i++) {
        w->lights[i].position = vec_between(&state, -6, 6);
        w->lights[i].position.y = 9;
        w->lights[i].intensity = vec_between(&state, 100, 500);
    }
    w->scene.spheres = w->spheres;
    w->scene.sphere_count = SPHERES;
    w->scene.boxes = w->boxes;
    w->scene.box_count = BOXES;
    w->scene.lights = w->lights;
    w->scene.light_count = LIGHTS;
    w->scene.background = vec_between(&state, 0, 0.5f);
}

/* ---- the calls ------------------------------------------------------------------------- */

static inline void call_camera_ray(const float *in, float *out)
{
    rt_camera camera;
    camera.position = take_vec(&in);
    camera.direction = take_vec(&in);
    camera.up = take_vec(&in);
    camera.fov_y = take(&in);
    const rt_ray ray = rt_camera_ray(&camera, (int)in[0], (int)in[1], in[2], in[3]);
    put_vec(&out, ray.origin);
    put_vec(&out, ray.direction);
}

static inline void call_hit_sphere(const float *in, float *out)
{
    rt_sphere sphere;
    rt_hit hit;
    memset(&sphere, 0, sizeof sphere);
    memset(&hit, 0, sizeof hit);
    sphere.center = take_vec(&in);
    sphere.radius = take(&in);
    const rt_ray ray = take_ray(&in);
    const bool found = rt_hit_sphere(&sphere, &ray, *in, &hit);
    put_hit(out, found, &hit, hit.material == &sphere.material ? 1.0f : -1.0f);
}

static inline void call_hit_box(const float *in, float *out)
{
    rt_box box;
    rt_hit hit;
    memset(&box, 0, sizeof box);
    memset(&hit, 0, sizeof hit);
    box.min = take_vec(&in);
    box.max = take_vec(&in);
    const rt_ray ray = take_ray(&in);
    const bool found = rt_hit_box(&box, &ray, *in, &hit);
    put_hit(out, found, &hit, hit.material == &box.material ? 1.0f : -1.0f);
}

static inline void call_hit_triangle(const float *in, float *out)
{
    static const int face[3] = {0, 1, 2};
    rt_vec3 corners[3];
    rt_hit hit;
    memset(&hit, 0, sizeof hit);
    for (int k = 0; k < 3; k++)
        corners[k] = take_vec(&in);
    const rt_mesh mesh = {corners, face, 3, 1, {{0, 0, 0}, false}};
    const rt_ray ray = take_ray(&in);
    const bool found = rt_hit_triangle(&mesh, 0, &ray, *in, &hit);
    put_hit(out, found, &hit, hit.material == &mesh.material ? 1.0f : -1.0f);
}

static inline void call_intersect(const float *in, float *out)
{
    world w;
    rt_hit hit;
    memset(&hit, 0, sizeof hit);
    make_world(&w, take(&in));
    const rt_ray ray = take_ray(&in);
    const bool found = rt_intersect(&w.scene, &ray, &hit);
    int shape = 0; /* counted from 1 */
    for (int i = 0; i < SPHERES; i++)
        shape = hit.material == &w.spheres[i].material ? i + 1 : shape;
    for (int i = 0; i < BOXES; i++)
        shape = hit.material == &w.boxes[i].material ? SPHERES + i + 1 : shape;
    put_hit(out, found, &hit, (float)shape);
}

static inline void call_lambert(const float *in, float *out)
{
    const rt_vec3 albedo = take_vec(&in);
    const rt_vec3 normal = take_vec(&in);
    const rt_vec3 to_light = take_vec(&in);
    const rt_vec3 intensity = take_vec(&in);
    put_vec(&out, rt_lambert(albedo, normal, to_light, intensity));
}

static inline void call_leave(const float *in, float *out)
{
    const rt_vec3 point = take_vec(&in);
    const rt_vec3 normal = take_vec(&in);
    const rt_vec3 direction = take_vec(&in);
    put_vec(&out, rt_leave(point, normal, direction));
}

static inline void call_occluded(const float *in, float *out)
{
    world w;
    make_world(&w, take(&in));
    const rt_ray ray = take_ray(&in);
    *out = rt_occluded(&w.scene, &ray, *in) ? 1.0f : 0.0f;
}

static inline void call_visible(const float *in, float *out)
{
    world w;
    make_world(&w, take(&in));
    const rt_vec3 point = take_vec(&in);
    const rt_vec3 normal = take_vec(&in);
    const rt_vec3 light = take_vec(&in);
    *out = rt_visible(&w.scene, point, normal, light) ? 1.0f : 0.0f;
}

static inline void call_direct(const float *in, float *out)
{
    world w;
    rt_hit hit;
    rt_rng rng = rt_rng_start(0, 0, 0);
    make_world(&w, take(&in));
    w.scene.light_count = (int)take(&in);
    hit.t = 1;
    hit.point = take_vec(&in);
    hit.normal = take_vec(&in);
    hit.material = &w.spheres[1].material;
    put_vec(&out, rt_direct(&w.scene, &hit, &rng));
}

static inline void call_encode(const float *in, float *out)
{
    *out = rt_encode(in[0], (double)in[1]);
}

static inline void call_reflect(const float *in, float *out)
{
    const rt_vec3 incident = take_vec(&in);
    put_vec(&out, rt_reflect(incident, take_vec(&in)));
}

static inline void call_random(const float *in, float *out)
{
    rt_rng rng = rt_rng_start((uint32_t)in[0], (uint32_t)in[1], (uint32_t)in[2]);
    for (int i = 0; i < 8; i++)
        out[i] = rt_random(&rng);
}

static inline void call_sample_cosine(const float *in, float *out)
{
    const rt_vec3 normal = take_vec(&in);
    put_vec(&out, rt_sample_cosine(normal, in[0], in[1]));
}

static inline void call_radiance(const float *in, float *out)
{
    world w;
    make_world(&w, take(&in));
    const rt_ray ray = take_ray(&in);
    const int bounces = (int)take(&in);
    rt_rng rng = rt_rng_start((uint32_t)take(&in), 0, 0);
    put_vec(&out, rt_radiance(&w.scene, &ray, bounces, &rng));
}

static inline void call_fresnel(const float *in, float *out)
{
    *out = rt_fresnel(in[0], in[1]);
}

static inline void call_refract(const float *in, float *out)
{
    const rt_vec3 incident = take_vec(&in);
    const rt_vec3 normal = take_vec(&in);
    rt_vec3 refracted = {0, 0, 0};
    const bool found = rt_refract(incident, normal, *in, &refracted);
    *out++ = found ? 1.0f : 0.0f;
    put_vec(&out, found ? refracted : rt_vec(0, 0, 0));
}

static inline rt_lamp take_lamp(const float **p)
{
    rt_lamp lamp;
    lamp.center = take_vec(p);
    lamp.radius = take(p);
    lamp.u = take_vec(p);
    lamp.v = take_vec(p);
    lamp.intensity = rt_vec(1, 1, 1);
    return lamp;
}

static inline void call_sample_lamp(const float *in, float *out)
{
    const rt_lamp lamp = take_lamp(&in);
    const rt_vec3 point = take_vec(&in);
    put_vec(&out, rt_sample_lamp(&lamp, point, in[0], in[1]));
}

static inline void call_lamp_density(const float *in, float *out)
{
    const rt_lamp lamp = take_lamp(&in);
    const rt_vec3 point = take_vec(&in);
    *out = rt_lamp_density(&lamp, point, take_vec(&in));
}

static inline void call_mis(const float *in, float *out)
{
    *out = rt_mis(in[0], in[1]);
}

static inline void call_sample_gloss(const float *in, float *out)
{
    const rt_vec3 normal = take_vec(&in);
    const rt_vec3 to_eye = take_vec(&in);
    put_vec(&out, rt_sample_gloss(normal, to_eye, in[0], in[1], in[2]));
}

static inline void call_gloss(const float *in, float *out)
{
    const rt_vec3 normal = take_vec(&in);
    const rt_vec3 to_eye = take_vec(&in);
    const rt_vec3 to_light = take_vec(&in);
    out[1] = -1; /* in case that nobody writes there */
    out[0] = rt_gloss(normal, to_eye, to_light, *in, &out[1]);
}

/* The pinhole's ray is always rt.h's, of a film of 320 x 240. */
static inline rt_ray take_pinhole(const float **in, rt_camera *camera, rt_lens *lens)
{
    camera->position = take_vec(in);
    camera->direction = take_vec(in);
    camera->up = take_vec(in);
    camera->fov_y = take(in);
    lens->radius = take(in);
    lens->focus = take(in);
    const rt__film film = rt__film_of(camera, 320, 240);
    const float x = take(in);
    return rt__film_ray(&film, x, take(in));
}

static inline void call_lens_ray(const float *in, float *out)
{
    rt_camera camera;
    rt_lens lens;
    const rt_ray pinhole = take_pinhole(&in, &camera, &lens);
    const rt_ray ray = rt_lens_ray(&camera, &lens, &pinhole, in[0], in[1]);
    put_vec(&out, ray.origin);
    put_vec(&out, ray.direction);
}

#define RAY                                                                              \
    {"origin", 3},                                                                       \
    {                                                                                    \
        "direction", 3                                                                   \
    }
#define HIT                                                                              \
    {                                                                                    \
        {"hit", 1}, {"t", 1}, {"point", 3}, {"normal", 3},                               \
        {                                                                                \
            "material", 1                                                                \
        }                                                                                \
    }
#define SCENE                                                                            \
    {                                                                                    \
        "scene", 1                                                                       \
    }

#define LAMP                                                                             \
    {"center", 3}, {"radius", 1}, {"u", 3}, {"v", 3},                                    \
    {                                                                                    \
        "point", 3                                                                       \
    }

static const routine routines[] = {
    {"rt_camera_ray",
     1,
     {{"position", 3},
      {"direction", 3},
      {"up", 3},
      {"fov_y", 1},
      {"width", 1},
      {"height", 1},
      {"x", 1},
      {"y", 1}},
     {RAY},
     call_camera_ray},
    {"rt_hit_sphere",
     1,
     {{"center", 3}, {"radius", 1}, RAY, {"t_max", 1}},
     HIT,
     call_hit_sphere},
    {"rt_intersect", 2, {SCENE, RAY}, HIT, call_intersect},
    {"rt_lambert",
     2,
     {{"albedo", 3}, {"normal", 3}, {"to_light", 3}, {"intensity", 3}},
     {{"radiance", 3}},
     call_lambert},
    {"rt_hit_box", 3, {{"min", 3}, {"max", 3}, RAY, {"t_max", 1}}, HIT, call_hit_box},
    {"rt_leave",
     4,
     {{"point", 3}, {"normal", 3}, {"direction", 3}},
     {{"start", 3}},
     call_leave},
    {"rt_occluded", 4, {SCENE, RAY, {"t_max", 1}}, {{"occluded", 1}}, call_occluded},
    {"rt_visible",
     4,
     {SCENE, {"point", 3}, {"normal", 3}, {"light", 3}},
     {{"visible", 1}},
     call_visible},
    {"rt_direct",
     4,
     {SCENE, {"lights", 1}, {"point", 3}, {"normal", 3}},
     {{"light", 3}},
     call_direct},
    {"rt_encode", 5, {{"value", 1}, {"gamma", 1}}, {{"byte", 1}}, call_encode},
    {"rt_reflect", 6, {{"incident", 3}, {"normal", 3}}, {{"reflected", 3}}, call_reflect},
    {"rt_random",
     7,
     {{"pixel", 1}, {"sample", 1}, {"seed", 1}},
     {{"numbers", 8}},
     call_random},
    {"rt_sample_cosine",
     7,
     {{"normal", 3}, {"r1", 1}, {"r2", 1}},
     {{"direction", 3}},
     call_sample_cosine},
    {"rt_radiance",
     7,
     {SCENE, RAY, {"bounces", 1}, {"pixel", 1}},
     {{"radiance", 3}},
     call_radiance},
    {"rt_fresnel", 11, {{"cosine", 1}, {"eta", 1}}, {{"reflected", 1}}, call_fresnel},
    {"rt_refract",
     11,
     {{"incident", 3}, {"normal", 3}, {"eta", 1}},
     {{"goes through", 1}, {"refracted", 3}},
     call_refract},
    {"rt_sample_lamp",
     12,
     {LAMP, {"r1", 1}, {"r2", 1}},
     {{"point of the lamp", 3}},
     call_sample_lamp},
    {"rt_lamp_density",
     12,
     {LAMP, {"direction", 3}},
     {{"density", 1}},
     call_lamp_density},
    {"rt_mis", 12, {{"density", 1}, {"other", 1}}, {{"weight", 1}}, call_mis},
    {"rt_sample_gloss",
     13,
     {{"normal", 3}, {"to_eye", 3}, {"shininess", 1}, {"r1", 1}, {"r2", 1}},
     {{"direction", 3}},
     call_sample_gloss},
    {"rt_gloss",
     13,
     {{"normal", 3}, {"to_eye", 3}, {"to_light", 3}, {"shininess", 1}},
     {{"gloss", 1}, {"density", 1}},
     call_gloss},
    {"rt_lens_ray",
     14,
     {{"position", 3},
      {"direction", 3},
      {"up", 3},
      {"fov_y", 1},
      {"radius", 1},
      {"focus", 1},
      {"x", 1},
      {"y", 1},
      {"r1", 1},
      {"r2", 1}},
     {RAY},
     call_lens_ray},
    {"rt_hit_triangle",
     16,
     {{"A", 3}, {"B", 3}, {"C", 3}, RAY, {"t_max", 1}},
     HIT,
     call_hit_triangle},
};

enum { ROUTINES = sizeof routines / sizeof routines[0] };

#endif

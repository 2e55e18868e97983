/* Single rays on one core: rt.h's tree beside Embree and tinybvh, the same rays asked of each in
 * one run.
 *
 *     make bench-rays                     all scenes, with the peers that are there
 *     make bench-rays TINYBVH=directory   ... and tiny_bvh.h is there
 *     tests/bench/run --rays 3 sponge "10000 spheres"     3 rounds, only these
 *     build/bench/rays 3 1e6              afterwards, without compiling: a row each
 *
 * A SCENE is icosphere, landscape or sponge, meshes of 1.3, 1.0 and 0.7 million triangles; or a
 * number of spheres, at most 1e7. A row, tabs between its values: scene, shapes, who; millions of
 * rays per second, first the camera's rays of 640 x 480 pixels, then one to the light from each
 * hit that faces it, then one into a random direction (cosine) from each hit; seconds for the
 * build, on one thread and on all; bytes held per shape; how many of the rays hit something where
 * rt.h's hit nothing, or the other way round.
 *
 * The candidates take turns, and the best round counts. Work on one thread is timed by
 * the program's own clock, which stops while others have the core; the build on all
 * threads by wall-clock time. */
#define _POSIX_C_SOURCE 200112L /* clock_gettime, sysconf */
#include <stddef.h>
#include <stdlib.h>

/* The memory of rt.h is counted where it asks for it. */
static size_t held;

static void *counted_malloc(size_t size)
{
    size_t *memory = size > (size_t)-1 - 16 ? NULL : malloc(size + 16);
    if (!memory)
        return NULL;
    held += *memory = size;
    return (char *)memory + 16;
}

static void counted_free(void *memory)
{
    size_t *whole = memory ? (size_t *)(void *)((char *)memory - 16) : NULL;
    if (whole)
        held -= *whole;
    free(whole);
}

#define RT_MALLOC(size) counted_malloc(size)
#define RT_FREE(memory) counted_free(memory)
#define RT_IMPLEMENTATION
#include "bench.h"
#include "candidate.h"
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

enum { W = 640, H = 480, PRIMARY = 0, SHADOW, DIFFUSE, KINDS };

/* ---- rt.h as a candidate ------------------------------------------------------------- */

typedef struct own_tree {
    rt_scene scene;
    rt_bvh bvh;
} own_tree;

static void *own_open(const rt_scene *scene, int threads)
{
    own_tree *own = need(calloc(1, sizeof *own));
    own->scene = *scene;
    (void)threads;
#ifdef _OPENMP
    omp_set_num_threads(threads);
#endif
    return own;
}

static void own_build(void *tree)
{
    own_tree *own = tree;
    const rt_status status = rt_build_bvh(&own->scene, &own->bvh);
    if (status != RT_OK) {
        fprintf(stderr, "bench: %s\n", rt_status_text(status));
        exit(1);
    }
    own->scene.bvh = &own->bvh;
}

static size_t own_bytes(void *tree)
{
    (void)tree; /* it is the only one */
    return held;
}

static void own_nearest(void *tree, const rt_ray *rays, int count, float *t)
{
    const own_tree *own = tree;
    for (int i = 0; i < count; i++) {
        rt_hit hit;
        t[i] = rt_intersect(&own->scene, &rays[i], &hit) ? hit.t : INFINITY;
    }
}

static void own_blocked(void *tree, const rt_ray *rays, int count, float *t)
{
    const own_tree *own = tree;
    for (int i = 0; i < count; i++)
        t[i] = rt_occluded(&own->scene, &rays[i], 1.0f) ? 1.0f : INFINITY;
}

static void own_close(void *tree)
{
    own_tree *own = tree;
    rt_free_bvh(&own->bvh);
    free(own);
}

static const candidate own = {"rt.h",      own_open,    own_build, own_bytes,
                              own_nearest, own_blocked, own_close};

static const candidate *const candidates[] = {
    &own,
#ifdef WITH_EMBREE
    &embree_robust,
    &embree,
#endif
#ifdef WITH_TINYBVH
    &tinybvh_wide,
#endif
};
enum { CANDIDATES = sizeof candidates / sizeof *candidates };

/* ---- the rays ------------------------------------------------------------------------ */

typedef struct ray_list {
    rt_ray *rays;
    int count;
} ray_list;

static void add_ray(ray_list *list, rt_vec3 origin, rt_vec3 direction)
{
    const rt_ray ray = {origin, direction};
    list->rays[list->count++] = ray;
}

/* From rt.h's own hits, with its own chapters; but rays start this high above the
 * surface. rt.h does not need that, rt_leave is enough; but in float the others would hit
 * the large sphere that they leave, and be done sooner. */
static void make_rays(const rt_scene *scene, const rt_camera *camera, float above,
                      ray_list *lists)
{
    const rt_vec3 lamp = scene->lights[0].position;
    for (int k = 0; k < KINDS; k++) {
        lists[k].rays = need(malloc(W * H * sizeof *lists[k].rays));
        lists[k].count = 0;
    }
    for (int i = 0; i < W * H; i++) {
        rt_rng rng = rt_rng_start((uint32_t)i, 0, 1);
        const float x = (float)(i % W) + rt_random(&rng);
        const float y = (float)(i / W) + rt_random(&rng);
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_ray ray = rt_camera_ray(camera, W, H, x, y);
        rt_hit hit;
        add_ray(&lists[PRIMARY], ray.origin, ray.direction);
        if (!rt_intersect(scene, &ray, &hit))
            continue;
        const rt_vec3 p = rt_add(rt_leave(hit.point, hit.normal, hit.normal),
                                 rt_scale(hit.normal, above));
        const rt_vec3 to_lamp = rt_sub(lamp, p);
        if (rt_dot(hit.normal, to_lamp) > 0.0f)
            add_ray(&lists[SHADOW], p, to_lamp);
        add_ray(&lists[DIFFUSE], p, rt_sample_cosine(hit.normal, r1, r2));
    }
}

/* ---- asking -------------------------------------------------------------------------- */

typedef struct result {
    double build[2]; /* on one thread, on all */
    double took[KINDS];
    size_t bytes;
    int different;
} result;

static double program_seconds(void)
{
    return (double)clock() / CLOCKS_PER_SEC;
}

static void *build(const candidate *c, const rt_scene *scene, int threads, double *best)
{
    void *tree = c->open(scene, threads);
    const double start = threads == 1 ? program_seconds() : seconds();
    c->build(tree);
    *best = fmin(*best, (threads == 1 ? program_seconds() : seconds()) - start);
    return tree;
}

/* The trees stay only when all have been built for the last time: Embree has one team of threads
 * for all of its devices. */
static void build_in_turns(const rt_scene *scene, int rounds, void **trees,
                           result *results)
{
    const int processors = (int)sysconf(_SC_NPROCESSORS_ONLN);
    for (int round = 0; round < (rounds < 3 ? rounds : 3); round++)
        for (int c = 0; c < CANDIDATES; c++)
            for (int all = 0; all < 2; all++) {
                void *tree = build(candidates[c], scene, all ? processors : 1,
                                   &results[c].build[all]);
                results[c].bytes = candidates[c]->bytes(tree);
                candidates[c]->close(tree);
            }
    for (int c = 0; c < CANDIDATES; c++)
        trees[c] = build(candidates[c], scene, processors, &results[c].build[1]);
}

static void ask_in_turns(const ray_list *lists, int rounds, void **trees, result *results)
{
    float *expected = need(malloc(W * H * sizeof *expected)); /* rt.h's, it comes first */
    float *answers = need(malloc(W * H * sizeof *answers));
    for (int round = 0; round < rounds; round++)
        for (int kind = 0; kind < KINDS; kind++)
            for (int c = 0; c < CANDIDATES; c++) {
                const candidate *one = candidates[c];
                const ray_list *list = &lists[kind];
                float *t = c == 0 ? expected : answers;
                const double start = program_seconds();
                (kind == SHADOW ? one->blocked : one->nearest)(trees[c], list->rays,
                                                               list->count, t);
                const double took = program_seconds() - start;
                results[c].took[kind] = fmin(results[c].took[kind], took);
                for (int i = 0; round == 0 && i < list->count; i++)
                    results[c].different += (t[i] < INFINITY) != (expected[i] < INFINITY);
            }
    free(expected);
    free(answers);
}

static void measure(const char *name, const rt_scene *scene, const rt_camera *camera,
                    float above, int shapes, int rounds)
{
    result results[CANDIDATES];
    void *trees[CANDIDATES];
    ray_list lists[KINDS];
    for (int c = 0; c < CANDIDATES; c++)
        results[c] = (result){{1e30, 1e30}, {1e30, 1e30, 1e30}, 0, 0};
    build_in_turns(scene, rounds, trees, results);
    make_rays(&((own_tree *)trees[0])->scene, camera, above, lists);
    ask_in_turns(lists, rounds, trees, results);
    for (int c = 0; c < CANDIDATES; c++) {
        const result *r = &results[c];
        printf("%s\t%d\t%s", name, shapes, candidates[c]->name);
        for (int kind = 0; kind < KINDS; kind++)
            printf("\t%.4f", lists[kind].count / r->took[kind] / 1e6);
        printf("\t%.6f\t%.6f\t%.1f\t%d\n", r->build[0], r->build[1],
               (double)r->bytes / shapes, r->different);
        fflush(stdout);
        candidates[c]->close(trees[c]);
    }
    for (int kind = 0; kind < KINDS; kind++)
        free(lists[kind].rays);
}

static const rt_light sun = {{2, 3, 1}, {1, 1, 1}};
static const rt_camera eye = {{1.4f, 1, 2.2f}, {-1.4f, -1, -2.2f}, {0, 1, 0}, 40};

static void measure_mesh(const char *name, rt_mesh mesh, int rounds)
{
    const rt_scene scene = {
        .meshes = &mesh, .mesh_count = 1, .lights = &sun, .light_count = 1};
    measure(name, &scene, &eye, 0.0f, mesh.triangle_count, rounds);
    free_mesh(&mesh);
}

static void measure_spheres(const char *name, int count, int rounds)
{
    rt_sphere *spheres = many_spheres(count);
    const rt_scene scene = {.spheres = spheres,
                            .sphere_count = count + 5,
                            .lights = &room_dim_light,
                            .light_count = 1};
    measure(name, &scene, &room_camera, 1e-3f, count + 5, rounds);
    free(spheres);
}

int main(int argc, char **argv)
{
    static const char *const all[] = {"icosphere",      "landscape",      "sponge",
                                      "100 spheres",    "1000 spheres",   "10000 spheres",
                                      "100000 spheres", "1000000 spheres"};
    const int rounds = argc > 1 ? atoi(argv[1]) : 3;
    const int count = argc > 2 ? argc - 2 : (int)(sizeof all / sizeof *all);
    for (int i = 0; i < count; i++) {
        const char *name = argc > 2 ? argv[i + 2] : all[i];
        const double spheres = atof(name);
        if (rounds < 1)
            return fprintf(stderr, "bench: no rounds\n"), 1;
        if (strcmp(name, "icosphere") == 0)
            measure_mesh(name, make_icosphere(8), rounds);
        else if (strcmp(name, "landscape") == 0)
            measure_mesh(name, make_landscape(708), rounds);
        else if (strcmp(name, "sponge") == 0)
            measure_mesh(name, make_cells(81, is_sponge), rounds);
        else if (spheres >= 1 && spheres <= 1e7)
            measure_spheres(name, (int)spheres, rounds);
        else
            return fprintf(stderr, "bench: see the head of tests/bench/rays.c\n"), 1;
    }
    return 0;
}

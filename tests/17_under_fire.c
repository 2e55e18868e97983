/* Under fire: what outsiders found wrong, each fault with its whole kind. */
#define _GNU_SOURCE /* feenableexcept */
#include <fenv.h>
#include <stdlib.h>
#include <time.h>

/* Memory that runs out at the allocation with number fail_at. */
static long allocated, taken, fail_at = -1;

static void *failing_malloc(size_t size)
{
    if (taken++ == fail_at)
        return NULL;
    allocated++;
    return malloc(size);
}

static void counting_free(void *memory)
{
    allocated -= memory != NULL;
    free(memory);
}

#define RT_MALLOC(size) failing_malloc(size)
#define RT_FREE(memory) counting_free(memory)
#define RT_ASSERT(condition) assert_true(condition)
#include "../demos/scene.h"
#include "test.h"

static rt_image small_image(int width, int height, rt_vec3 *pixels)
{
    memset(pixels, 0, (size_t)width * (size_t)height * sizeof *pixels);
    rt_image image = {.width = width, .height = height, .pixels = pixels};
    return image;
}

/* log-uniform, of either sign */
static float any_size(rt_rng *rng, float low, float high)
{
    const float size = low * powf(high / low, rt_random(rng));
    return rt_random(rng) < 0.5f ? -size : size;
}

static bool same_hit(const rt_hit *a, const rt_hit *b)
{
    return a->t == b->t && a->shape == b->shape && a->material == b->material &&
           memcmp(&a->point, &b->point, sizeof a->point) == 0 &&
           memcmp(&a->normal, &b->normal, sizeof a->normal) == 0;
}

/* ---- deep trees --------------------------------------------------------------------- */

typedef struct shapes {
    rt_sphere *spheres;
    rt_box *boxes;
    rt_scene scene;
    rt_bvh bvh;
} shapes;

enum { BOXES = 1, SPHERES = 2, MIXED = BOXES | SPHERES };
enum { CUT_OFF, NESTED, CORNERED, EQUAL, LINE, DEEP_KINDS };

/* Put shape number k at x, of this size in y and z, and flat if it is a box. */
static void add_shape(shapes *s, int of, int k, float x, float y, float z)
{
    if (of == SPHERES || (of == MIXED && k % 2 == 0)) {
        rt_sphere *sphere = &s->spheres[s->scene.sphere_count++];
        sphere->center = rt_vec(x, 0, 0);
        sphere->radius = y > z ? y : z;
    } else {
        rt_box *box = &s->boxes[s->scene.box_count++];
        box->min = rt_vec(x, -y, -z);
        box->max = rt_vec(x, y, z);
    }
}

static shapes deep_shapes(int kind, int of, int bits)
{
    const int chain = 147, m = 1 << bits, n = chain + m;
    shapes s;
    memset(&s, 0, sizeof s);
    s.spheres = calloc((size_t)n, sizeof *s.spheres);
    s.boxes = calloc((size_t)n, sizeof *s.boxes);
    assert_non_null(s.spheres);
    assert_non_null(s.boxes);
    s.scene.spheres = s.spheres;
    s.scene.boxes = s.boxes;
    double x = 1e8;
    if (kind == CUT_OFF) {
        /* crosses, each 1.25 times nearer: the cheapest cut takes off one, seven at each
         * level; then the second half large, the first small and nearer, and so on within
         * it */
        for (int k = 0; k < chain; k++, x /= 1.25)
            if (of == SPHERES)
                add_shape(&s, of, k, (float)x, (float)x / 9, 1e-3f);
            else
                add_shape(&s, of, k, (float)x, k & 1 ? 1e15f : 1, k & 1 ? 1 : 1e15f);
        for (int i = 0; i < m; i++) {
            int level = 0, size = m;
            for (; size > 1 && i < size / 2; size /= 2)
                level++;
            const float half = (float)(1e15 * pow(0.3, level));
            add_shape(&s, of, i, (float)(x / 64 * (1 - level / 32.0)), half, half);
        }
    }
    for (int k = 0; k < n && kind != CUT_OFF; k++) {
        const float size = (float)(1e15 * pow(1e-26, k / (double)n));
        if (kind == NESTED)
            add_shape(&s, of, k, 0, size, size);
        else if (kind == CORNERED)
            add_shape(&s, of, k, size, size, size);
        else if (kind == EQUAL)
            add_shape(&s, of, k, 1, 1, 1);
        else
            add_shape(&s, of, k, (float)k, 0.3f, (float)(k & -k));
    }
    return s;
}

/* How deep the tree is, and how many items wait at most: from each node entered on the
 * way, all but the one that is entered next. */
static void look_at_tree(const rt_bvh *bvh, int number, int levels, int waiting,
                         int *deepest, int *most, int *found)
{
    const rt_bvh_node *node = &bvh->nodes[number];
    assert_in_range(node->count, levels == 1 ? 1 : 2, 8);
    *deepest = levels > *deepest ? levels : *deepest;
    *most = waiting + node->count > *most ? waiting + node->count : *most;
    for (int k = 0; k < node->count; k++)
        if (node->inside[k] < 0)
            look_at_tree(bvh, -node->inside[k], levels + 1, waiting + node->count - 1,
                         deepest, most, found);
        else
            for (int i = 0; i < 8; i++)
                *found += bvh->rows[node->inside[k] >> 2].number[i] >= 0;
}

static void check_deep(int kind, int of, int bits, int rays)
{
    shapes s = deep_shapes(kind, of, bits);
    assert_int_equal(rt_build_bvh(&s.scene, &s.bvh), RT_OK);
    int deepest = 0, most = 0, found = 0, hits = 0;
    look_at_tree(&s.bvh, 0, 1, 0, &deepest, &most, &found);
    assert_int_equal(found, s.scene.sphere_count + s.scene.box_count);
    assert_in_range(deepest, 1, RT__LEVELS);
    assert_in_range(most, 1, RT__WAITING);

    rt_rng rng = rt_rng_start((uint32_t)kind, (uint32_t)of, 100);
    for (int i = 0; i < rays;
         i++) { /* along the row, from either end; i = 0: all of it */
        const float far = i % 2 == 0 ? -1e15f : 1e15f,
                    size = any_size(&rng, 1e-6f, 1e15f);
        const rt_vec3 aim = rt_vec(0, i > 1 ? size : 0, i > 1 ? 0.7f * size : 0);
        const rt_vec3 from = rt_vec(far, i % 4 < 2 ? aim.y : 0, i % 4 < 2 ? aim.z : 0);
        const rt_ray ray = ray_of(from, rt_sub(aim, from));
        rt_scene loop = s.scene, tree = s.scene;
        tree.bvh = &s.bvh;
        rt_hit a = untouched, b = untouched;
        const bool hit = rt_intersect(&loop, &ray, &a);
        assert_int_equal(rt_intersect(&tree, &ray, &b), hit);
        assert_int_equal(rt_occluded(&tree, &ray, FLT_MAX), hit);
        assert_true(same_hit(&a, &b));
        hits += hit;
    }
    assert_true(hits > 0 || rays == 0);
    rt_free_bvh(&s.bvh);
    free(s.spheres);
    free(s.boxes);
}

static void test_no_tree_is_deeper_than_there_is_room_to_search(void **state)
{
    (void)state;
    int levels =
        0; /* in halves, each level leaves an eighth of the most that there may be */
    for (int64_t n = INT_MAX; n > 1; n = (n + 7) / 8)
        levels++;
    assert_in_range(RT__HALVES + levels, 1, RT__LEVELS);
    for (int kind = 0; kind < DEEP_KINDS; kind++)
        for (int of = BOXES; of <= MIXED; of++) {
            check_deep(kind, of, 11, 40);
            check_deep(kind, of, 3, 40);
        }
    check_deep(CUT_OFF, BOXES, 16, 6);
    check_deep(CUT_OFF, SPHERES, 16, 6);
    check_deep(CUT_OFF, MIXED, 15, 6);
    check_deep(CORNERED, MIXED, 15, 6);
}

/* ---- the camera --------------------------------------------------------------------- */

static rt_dvec3 film_ray(const rt_camera *camera, float x, float y)
{
    return rt_to_double(rt_camera_ray(camera, 64, 64, x, y).direction);
}

static double degrees_between(rt_dvec3 a, rt_dvec3 b)
{
    const rt_dvec3 c = rt_dcross(a, b);
    return atan2(sqrt(rt_ddot(c, c)), rt_ddot(a, b)) * 57.29577951308232;
}

/* The rays of the picture's edges, and the directions that follow from them. */
static void check_film(const rt_camera *camera)
{
    const rt_dvec3 f = film_ray(camera, 32, 32);
    const rt_dvec3 l = film_ray(camera, 0, 32), r = film_ray(camera, 64, 32);
    const rt_dvec3 t = film_ray(camera, 32, 0), b = film_ray(camera, 32, 64);
    const rt_dvec3 right = rt_dnormalize(rt_dsub(r, l)),
                   top = rt_dnormalize(rt_dsub(t, b));
    const double fov = camera->fov_y == 0 ? 45 : (double)camera->fov_y;
    assert_close(degrees_between(l, r), fov, 2e-5);
    assert_close(degrees_between(t, b), fov, 2e-5);
    assert_close(degrees_between(t, f), fov / 2, 2e-5);
    assert_close(rt_ddot(f, f), 1, 1e-6);
    assert_close(rt_ddot(f, right), 0, 1e-6);
    assert_close(rt_ddot(f, top), 0, 1e-6);
    assert_close(rt_ddot(right, top), 0, 1e-6);
    assert_close(rt_ddot(rt_dcross(right, top), f), -1, 1e-6); /* right-handed */

    const rt_dvec3 direction = rt_dnormalize(rt_to_double(camera->direction));
    const rt_dvec3 up = rt_dnormalize(rt_to_double(camera->up));
    if (rt_ddot(direction, direction) > 0)
        assert_close(rt_ddot(direction, f), 1, 1e-6);
    if (rt_ddot(up, up) > 0) { /* up is upwards, and not to the side */
        assert_true(rt_ddot(up, top) > -1e-6);
        assert_close(rt_ddot(up, right), 0, 1e-6);
    }
}

static void test_any_direction_and_any_up_make_a_film(void **state)
{
    (void)state;
    const float sizes[] = {1, 1e-40f, 1e-20f, 1e15f, 1e30f, FLT_MAX / 2};
    rt_rng rng = rt_rng_start(0, 0, 101);
    for (int i = 0; i < 40000; i++) {
        rt_camera camera = {.fov_y = 90};
        const rt_vec3 d = random_direction(&rng);
        rt_vec3 up = rt_scale(d, any_size(&rng, 0.1f, 10)); /* parallel, or so */
        if (i % 4 == 1)
            up = rt_add(up, random_point(&rng, any_size(&rng, 1e-9f, 1)));
        else if (i % 4 == 2)
            up = random_direction(&rng);
        else if (i % 4 == 3)
            up = rt_scale(d, i % 8 == 3 ? -2.0f : 0.5f); /* exactly */
        camera.direction = rt_scale(d, sizes[i / 4 % 6]);
        camera.up = rt_scale(rt_scale(up, 0.1f), sizes[i / 24 % 6]);
        check_film(&camera);
    }
}

static void test_an_up_close_to_the_direction_counts(void **state)
{
    /* The worst case of the report, and what right should be, in long double. */
    (void)state;
    const rt_camera worst = {.direction = {0.00806362648f, -0.285772115f, 0.0093642436f},
                             .up = {0.00957142562f, -0.339208007f, 0.0111152427f},
                             .fov_y = 40};
    check_film(&worst);
    rt_rng rng = rt_rng_start(0, 0, 102);
    for (int i = 0; i < 10000; i++) {
        rt_camera camera = {.direction = random_direction(&rng), .fov_y = 90};
        camera.up = rt_add(rt_scale(camera.direction, 1.7f),
                           random_point(&rng, any_size(&rng, 1e-7f, 1e-2f)));
        const rt_vec3 d = camera.direction, u = camera.up;
        const long double x = (long double)d.y * u.z - (long double)d.z * u.y,
                          y = (long double)d.z * u.x - (long double)d.x * u.z,
                          z = (long double)d.x * u.y - (long double)d.y * u.x,
                          length = sqrtl(x * x + y * y + z * z);
        if (length == 0)
            continue;
        const rt_dvec3 right =
            rt_dnormalize(rt_dsub(film_ray(&camera, 64, 32), film_ray(&camera, 0, 32)));
        assert_close(right.x, x / length, 1e-6);
        assert_close(right.y, y / length, 1e-6);
        assert_close(right.z, z / length, 1e-6);
    }
}

static void test_an_up_that_is_no_direction_is_replaced(void **state)
{
    (void)state;
    const float bad[] = {0, NAN, INFINITY, -INFINITY};
    for (size_t i = 0; i < COUNT(bad); i++) {
        const rt_camera camera = {
            .direction = {0, -1, 1e-30f}, .up = {0, bad[i], 0}, .fov_y = 90};
        check_film(&camera);
        const rt_camera all = {
            .direction = {1, 2, 3}, .up = {bad[i], bad[i], bad[i]}, .fov_y = 90};
        check_film(&all);
    }
}

static void test_the_angle_of_view_is_right(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 103);
    const float special[] = {1e-3f, 0.1f, 30, 45, 89.99999f, 90, 90.00001f, 135, 179.99f};
    for (int i = 0; i < 20000; i++) {
        rt_camera camera = {.direction = random_direction(&rng), .up = {0, 1, 0}};
        const float part = rt_random(&rng);
        camera.fov_y = i < (int)COUNT(special) ? special[i]
                       : i % 3 == 0            ? 180 * part
                       : i % 3 == 1            ? 1e-3f * powf(1.79e5f, part)
                                               : 180 - 1e-2f * powf(1e4f, part);
        if (i % 2 == 0)
            camera.direction = rt_vec(0, 0, -1);
        if (camera.fov_y < 1e-3f || camera.fov_y > 179.99f)
            continue;
        const double fov = (double)camera.fov_y;
        const rt_dvec3 t = film_ray(&camera, 32, 0), b = film_ray(&camera, 32, 64);
        assert_close(degrees_between(t, b), fov, 1e-5);
    }
}

/* ---- closed rooms ------------------------------------------------------------------- */

typedef struct room {
    rt_box boxes[100];
    rt_light lights[2];
    rt_scene scene;
    rt_vec3 eye;
} room;

enum {
    ONE_BOX,
    BOX_AT_THE_ORIGIN,
    ODD_BOX,
    VERY_FLAT_BOX,
    FLAT_WALLS,
    ODD_FLAT_WALLS,
    WALLS_THAT_OVERLAP,
    WALLS_THAT_TOUCH,
    TWO_BOXES,
    TWO_ROOMS_OF_WALLS,
    CUBE_IN_A_CORNER,
    ROOMS
};

static const char *const room_names[] = {"one box",
                                         "box with a corner at (0,0,0)",
                                         "box 100.4 x 61.2 x 170.8",
                                         "box 100 x 0.02 x 100",
                                         "six flat walls",
                                         "six flat walls, odd",
                                         "six walls that overlap",
                                         "six walls that touch",
                                         "two boxes with a wall in common",
                                         "two rooms of eleven flat walls",
                                         "cube in a corner"};

static void add_room_box(room *r, rt_vec3 min, rt_vec3 max)
{
    rt_box *box = &r->boxes[r->scene.box_count++];
    box->min = min;
    box->max = max;
}

/* Walls of a room from min to max, on its outside; those in skip are left out. */
static void add_walls(room *r, rt_vec3 min, rt_vec3 max, float thick, float longer,
                      unsigned skip)
{
    for (int i = 0; i < 6; i++) {
        rt_vec3 low = rt_sub(min, rt_vec(longer, longer, longer));
        rt_vec3 high = rt_add(max, rt_vec(longer, longer, longer));
        float *const l = i < 2 ? &low.x : i < 4 ? &low.y : &low.z;
        float *const h = i < 2 ? &high.x : i < 4 ? &high.y : &high.z;
        if (i % 2 == 0) {
            *h = *l + longer;
            *l = *h - thick;
        } else {
            *l = *h - longer;
            *h = *l + thick;
        }
        if ((skip >> i & 1u) == 0)
            add_room_box(r, low, high);
    }
}

/* A room from which nothing must be seen but its walls: white outside, and lights outside,
 * in the next room, in the cube. */
static room closed_room(int kind, bool mirror, rt_vec3 place, bool many)
{
    room r;
    memset(&r, 0, sizeof r);
    const bool odd = kind == ODD_BOX || kind == ODD_FLAT_WALLS;
    const rt_vec3 min = kind == BOX_AT_THE_ORIGIN ? rt_vec(0, 0, 0)
                        : kind == VERY_FLAT_BOX   ? rt_vec(-50, -0.01f, -50)
                        : odd                     ? rt_vec(-50.1f, -20.3f, -60.7f)
                                                  : rt_vec(-4, -3, -5);
    const rt_vec3 max = kind == BOX_AT_THE_ORIGIN ? rt_vec(8, 6, 10)
                        : kind == VERY_FLAT_BOX   ? rt_vec(50, 0.01f, 50)
                        : odd                     ? rt_vec(50.3f, 40.9f, 110.1f)
                                                  : rt_vec(4, 3, 5);
    const rt_vec3 size = rt_sub(max, min);
    const rt_vec3 next_min = rt_vec(max.x, min.y, min.z),
                  next_max = rt_vec(max.x + 8, max.y, max.z);
    r.lights[0].position = rt_add(max, rt_scale(size, 0.01f));
    r.lights[1].position = rt_sub(min, rt_scale(size, 0.3f));
    switch (kind) {
    case FLAT_WALLS:
    case ODD_FLAT_WALLS: add_walls(&r, min, max, 0, 0, 0); break;
    case WALLS_THAT_OVERLAP: add_walls(&r, min, max, 1, 1, 0); break;
    case WALLS_THAT_TOUCH: add_walls(&r, min, max, 1, 0, 0); break;
    case TWO_BOXES:
        add_room_box(&r, min, max);
        add_room_box(&r, next_min, next_max);
        r.lights[1].position = rt_vec(max.x + 0.1f, 0, 0);
        break;
    case TWO_ROOMS_OF_WALLS:
        add_walls(&r, min, max, 0, 0, 0);
        add_walls(&r, next_min, next_max, 0, 0, 1);
        r.lights[1].position = rt_vec(max.x + 0.1f, 0, 0);
        break;
    case CUBE_IN_A_CORNER:
        add_room_box(&r, min, max);
        add_room_box(&r, min, rt_add(min, rt_vec(2, 2, 2)));
        r.lights[1].position = rt_add(min, rt_vec(1.9f, 1.9f, 1.9f));
        break;
    default: add_room_box(&r, min, max);
    }
    for (int i = 0; i < 80 && many; i++) { /* so many that a tree is worth it */
        const float x = 100.0f + 3.0f * (float)i;
        add_room_box(&r, rt_vec(x, 0, 0), rt_vec(x + 1, 2, 1));
    }
    for (int i = 0; i < r.scene.box_count; i++) {
        r.boxes[i].min = rt_add(r.boxes[i].min, place);
        r.boxes[i].max = rt_add(r.boxes[i].max, place);
        r.boxes[i].material.albedo = rt_vec(1, 1, 1);
        r.boxes[i].material.mirror = mirror;
    }
    for (int i = 0; i < 2; i++) {
        r.lights[i].position = rt_add(r.lights[i].position, place);
        r.lights[i].intensity = rt_vec(1, 1, 1);
    }
    r.eye = rt_add(place, rt_add(min, rt_mul(size, rt_vec(0.51f, 0.53f, 0.52f))));
    r.scene.background = rt_vec(1, 1, 1);
    r.scene.light_count = 2;
    return r;
}

/* How many samples of a picture from the inside are not black. */
static long leaks(room *r, int bounces, int samples, int lanes, uint32_t seed,
                  uint64_t *rays)
{
    enum { W = 64, H = 48 };
    static rt_vec3 pixels[W * H];
    r->scene.boxes = r->boxes;
    r->scene.lights = r->lights;
    const rt_camera camera = {
        .position = r->eye, .direction = {0.3f, -0.2f, -1}, .fov_y = 90};
    const rt_options options = {
        .samples = samples, .bounces = bounces, .lanes = lanes, .seed = seed};
    rt_image image = small_image(W, H, pixels);
    assert_int_equal(rt_render(&r->scene, &camera, &options, &image), RT_OK);
    long bad = 0;
    for (int i = 0; i < W * H; i++)
        bad += !rt_is_zero(pixels[i]);
    *rays += image.rays;
    return bad;
}

static void check_room(int kind, bool mirror, float place, bool many, int lanes)
{
    room r = closed_room(kind, mirror, rt_vec(place, place, place), many);
    uint64_t rays = 0;
    const long bad = leaks(&r, 20, lanes == 1 || many ? 1 : 3, lanes, 0, &rays);
    if (bad != 0)
        fail_msg("%s%s at %g, lanes %d%s: %ld leaks of %lu rays", room_names[kind],
                 mirror ? " of mirrors" : "", (double)place, lanes,
                 many ? " and a tree" : "", bad, (unsigned long)rays);
}

static void test_no_ray_leaves_a_closed_room(void **state)
{
    (void)state;
    for (int kind = 0; kind < ROOMS; kind++)
        for (int k = 0; k < 8; k++)
            check_room(kind, k & 1, k & 2 ? 1000 : 0, k & 4, 0);
}

static void test_nor_with_one_ray_at_a_time(void **state)
{
    (void)state;
    for (int kind = 0; kind < ROOMS; kind++)
        for (int k = 0; k < 4; k++)
            check_room(kind, k & 1, 1000, k & 2, 1);
}

/* Follow a path by hand, diffuse or mirrored. In a box no wall is seen from itself. */
static void check_path(int kind, bool mirror, float place, bool tree, int steps)
{
    room r = closed_room(kind, mirror, rt_vec(place, place, place), tree);
    r.scene.boxes = r.boxes;
    r.scene.lights = r.lights;
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&r.scene, &bvh), RT_OK);
    r.scene.bvh = tree ? &bvh : NULL;
    rt_rng rng = rt_rng_start((uint32_t)kind, mirror, 104);
    rt_ray ray = ray_of(r.eye, random_direction(&rng));
    rt_hit hit, before = untouched;
    for (int i = 0; i < steps; i++) {
        if (!rt_intersect(&r.scene, &ray, &hit))
            fail_msg("%s at %g: ray %d leaves", room_names[kind], (double)place, i);
        if (kind <= VERY_FLAT_BOX && rt_dot(hit.normal, before.normal) == 1.0f)
            fail_msg("%s at %g: ray %d hits itself", room_names[kind], (double)place, i);
        const float r1 = rt_random(&rng), r2 = rt_random(&rng);
        const rt_vec3 d = mirror ? rt_reflect(ray.direction, hit.normal)
                                 : rt_sample_cosine(hit.normal, r1, r2);
        ray = ray_of(rt_leave(hit.point, hit.normal, d), d);
        before = hit;
    }
    rt_free_bvh(&bvh);
}

static void test_no_path_leaves_a_closed_room_or_hits_where_it_is(void **state)
{
    (void)state;
    for (int kind = 0; kind < ROOMS; kind++)
        for (int k = 0; k < 8; k++)
            check_path(kind, k & 1, k & 2 ? 1000 : 0, k & 4, 10000);
}

/* Rays that pass the top of a cube and come down beside it, on a wall or on the floor:
 * what they hit there is not in the cube, or the path would go on inside it. */
static void test_what_comes_down_beside_a_cube_is_not_in_it(void **state)
{
    (void)state;
    room r = closed_room(CUBE_IN_A_CORNER, false, rt_vec(1000, 1000, 1000), false);
    r.scene.boxes = r.boxes;
    const float z = r.boxes[1].max.z; /* 997 */
    const rt_ray rays[] = {{{998.241638f, 1002.99902f, 996.856995f},
                            {-0.488311261f, -0.872105539f, 0.0313691571f}},
                           {{1001.31329f, 1002.99902f, 996.990417f},
                            {-0.500216007f, -0.865899324f, 0.00150823384f}}};
    for (size_t i = 0; i < COUNT(rays); i++) {
        rt_hit hit = untouched;
        assert_true(rt_intersect(&r.scene, &rays[i], &hit));
        assert_int_equal(hit.shape, 0);
        assert_true(hit.point.z > z); /* by 8e-4 or more */
    }
}

/* ---- the mean ----------------------------------------------------------------------- */

/* A pixel that is sometimes bright, and the sum of what it gave. */
typedef struct flicker {
    float dark, bright, chance;
    double *sum; /* or NULL */
} flicker;

static rt_vec3 flickering(const void *context, float x, float y, rt_rng *rng)
{
    const flicker *f = context;
    const float r = rt_random(rng);
    const float value = f->chance == 0  ? f->dark * r
                        : r < f->chance ? f->bright
                                        : f->dark;
    (void)x;
    (void)y;
    if (f->sum)
        *f->sum += (double)value;
    return rt_vec(value, 0.5f * value, 2 * value);
}

static const flicker flickers[] = {
    {.dark = 0.3f, .bright = 0.3f, .chance = 0.5f},      {.dark = 1},
    {.dark = 0.5f, .bright = 100.5f, .chance = 1e-3f},   {.dark = 0.5f, 50.5f, 1e-4f},
    {.dark = 0.5f, .bright = 10.5f, .chance = 1e-2f},    {.dark = 0.01f, 100, 1e-5f},
    {.dark = 0.01f, .bright = 100, .chance = 1e-3f},     {.dark = 1e-4f, 1, 1e-4f},
    {.dark = 1e-30f, .bright = 1e-26f, .chance = 1e-3f}, {.dark = 100, 0.01f, 1e-2f},
};

/* How far the mean of 2^bits samples is from that in double, with the rest kept in
 * image.rest and the samples in so many calls, or with rest borrowed. */
static double bias(const flicker *f, int bits, int calls, bool lent, rt_sampler sampler)
{
    double sum = 0;
    flicker counted = *f;
    counted.sum = &sum;
    rt_vec3 pixel, half, rest[2];
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel, .half = &half};
    image.rest = lent ? rest : NULL;
    const rt_options options = {
        .samples = (1 << bits) / calls, .threads = 1, .sampler = sampler};
    for (int i = 0; i < calls; i++)
        assert_int_equal(rt_render_pixels(flickering, &counted, &options, &image), RT_OK);
    const double mean = sum / image.samples;
    assert_close((double)pixel.y / (double)pixel.x, 0.5, 1e-6);
    assert_close((double)pixel.z / (double)pixel.x, 2, 1e-6);
    return fabs((double)pixel.x / mean - 1);
}

static void test_the_mean_does_not_drift(void **state)
{
    (void)state;
    for (size_t i = 0; i < COUNT(flickers); i++)
        for (int sampler = 0; sampler < 2; sampler++) {
            const rt_sampler s = sampler == 0 ? RT_SOBOL : RT_RANDOM;
            assert_close(bias(&flickers[i], 17, 1, false, s), 0, 1e-6);
            assert_close(bias(&flickers[i], 17, 64, true, s), 0, 1e-6);
        }
    assert_close(bias(&flickers[5], 21, 1, false, RT_RANDOM), 0, 1e-6);
}

static void test_nor_does_that_of_a_picture_that_stops_by_itself(void **state)
{
    /* samples 0: as many as error or seconds allow, which may be many. */
    (void)state;
    double sum = 0;
    flicker f = flickers[2];
    f.sum = &sum;
    rt_vec3 pixel, half;
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel, .half = &half};
    const rt_options options = {.threads = 1, .seconds = 0.2f};
    assert_int_equal(rt_render_pixels(flickering, &f, &options, &image), RT_OK);
    assert_close(image.samples / sum * (double)pixel.x, 1, 1e-5);
}

static void test_samples_may_be_split_in_any_way(void **state)
{
    enum { W = 5, H = 3, N = 700 };
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 105);
    for (int k = 0; k < 24; k++) {
        rt_vec3 p[2][W * H], half[2][W * H], rest[2][2 * W * H];
        memset(rest, 0, sizeof rest);
        for (int split = 0; split < 2; split++) {
            rt_image image = small_image(W, H, p[split]);
            image.half = k & 1 ? half[split] : NULL;
            image.rest = k & 2 ? rest[split] : NULL;
            memset(rest[split], 0x7f, (k & 1 ? 2 : 1) * sizeof p[0]); /* it is cleared */
            while (image.samples < N) {
                int some = 1 + (int)(rt_random(&rng) * 2 * (float)(1 << k % 8));
                some = split == 0 || some > N - image.samples ? N - image.samples : some;
                const rt_options options = {.samples = k >= 20 && split ? 1 : some,
                                            .threads = k % 5 == 0 ? 2 : 1};
                assert_int_equal(
                    rt_render_pixels(flickering, &flickers[2], &options, &image), RT_OK);
            }
        }
        assert_memory_equal(p[0], p[1], sizeof p[0]);
        if (k & 1)
            assert_memory_equal(half[0], half[1], sizeof half[0]);
        if (k & 2)
            assert_memory_equal(rest[0], rest[1], (k & 1 ? 2 : 1) * sizeof p[0]);
    }
}

static void test_the_estimated_error_is_that_of_the_mean(void **state)
{
    enum { W = 32, H = 32 };
    (void)state;
    static rt_vec3 pixels[W * H], half[W * H];
    const flicker kinds[] = {flickers[1], flickers[2], {.dark = 1e-30f}};
    for (size_t i = 0; i < COUNT(kinds); i++) {
        const flicker *f = &kinds[i];
        rt_image image = small_image(W, H, pixels);
        image.half = half;
        const rt_options options = {.samples = 600, .sampler = RT_RANDOM};
        assert_int_equal(rt_render_pixels(flickering, f, &options, &image), RT_OK);
        const double p = (double)f->chance;
        const double mean = p == 0 ? 0.5 * (double)f->dark
                                   : (double)f->dark * (1 - p) + (double)f->bright * p;
        double squares = 0;
        for (int k = 0; k < W * H; k++)
            squares += pow(((double)pixels[k].x / mean - 1), 2) / (W * H);
        /* of three channels alike but for a factor: 1, 1/2, 2 */
        const double error = sqrt(squares * (1 + 0.25 + 4) / 3) / (3.5 / 3);
        assert_close((double)rt_image_error(&image) / error, 1, 0.12);
    }
}

static void test_a_mean_that_gets_no_memory_leaves_all_as_it_was(void **state)
{
    enum { W = 4, H = 3 };
    (void)state;
    static rt_vec3 pixels[W * H], half[W * H], before[W * H];
    allocated = 0;
    for (int lanes = 0; lanes < 2; lanes++)
        for (fail_at = 0;; fail_at++) {
            rt_image image = small_image(W, H, pixels);
            image.half = half;
            for (int i = 0; i < W * H; i++)
                pixels[i] = half[i] = before[i] = rt_vec((float)i, 2, 3);
            image.samples = 3;
            image.done = 2;
            image.rays = 77;
            const rt_options options = {.samples = 4097, .lanes = lanes};
            taken = 0;
            const rt_status status =
                rt_render(&scene_mirror, &room_camera, &options, &image);
            assert_int_equal(allocated, 0);
            assert_null(image.rest);
            if (status == RT_OK)
                break;
            assert_int_equal(status, RT_NO_MEMORY);
            assert_int_equal(image.samples, 3);
            assert_int_equal(image.done, 2);
            assert_int_equal(image.rays, 77);
            assert_memory_equal(pixels, before, sizeof pixels);
            assert_memory_equal(half, before, sizeof half);
            assert_true(fail_at < 20);
        }
    assert_true(fail_at >= 3);
}

static int memory_again(void **state)
{
    (void)state;
    fail_at = -1;
    return 0;
}

/* ---- endless paths ------------------------------------------------------------------ */

static uint32_t rays_of_path(rt_vec3 albedo, bool mirror, int bounces, uint32_t sample)
{
    const rt_box box = {{-1, -1, -1}, {1, 1, 1}, {albedo, mirror}};
    const rt_light light = {{0, 0.5f, 0}, {1, 1, 1}};
    const rt_scene scene = {
        .boxes = &box, .box_count = 1, .lights = &light, .light_count = 1};
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0.3f, 0.4f, 0.5f));
    rt_rng rng = rt_rng_start(1, sample, 106);
    const rt_vec3 value = rt_radiance(&scene, &ray, bounces, &rng);
    assert_true(rt__is_finite(value));
    return rng.rays;
}

static void test_a_path_ends_when_nothing_is_left(void **state)
{
    (void)state;
    assert_in_range(rays_of_path(rt_vec(0.8f, 0.8f, 0.8f), false, 10000000, 0), 700, 930);
    assert_in_range(rays_of_path(rt_vec(0.97f, 0.97f, 0.97f), false, 100000, 0), 4000,
                    20000);
    assert_in_range(rays_of_path(rt_vec(0.8f, 0.8f, 0.8f), true, 10000000, 0), 300, 930);
    for (int i = 1; i <= 9; i++) { /* each gets stuck at a denormal number of its own */
        const float rho = (float)i / 10;
        const uint32_t most = (uint32_t)(2 * (104 / -log((double)rho) + 2));
        assert_in_range(rays_of_path(rt_vec(rho, 0, 0), false, INT_MAX - 1, 0), 2, most);
        assert_in_range(rays_of_path(rt_vec(0, rho, 0.1f), false, INT_MAX - 1, 0), 2,
                        most);
    }
}

static void test_paths_of_all_bounces_end(void **state)
{
    (void)state;
    uint64_t sum = 0;
    for (uint32_t i = 0; i < 2000; i++) {
        const uint32_t white = rays_of_path(rt_vec(1, 1, 1), false, RT_ALL_BOUNCES, i);
        const uint32_t mirror = rays_of_path(rt_vec(0, 0, 0), true, RT_ALL_BOUNCES, i);
        assert_in_range(white, 1, 1000);
        assert_in_range(mirror, 5, 500);
        sum += mirror;
    }
    /* roulette begins after 5 rays, and 19 more follow, for p = 0.95 */
    assert_close((double)sum / 2000, 24, 24 * 0.1);
}

/* How many standard errors the mean of a picture of all bounces is off what each of its
 * pixels should be; and it has the same bits with any lanes and threads. */
static double off_by(const rt_scene *scene, const rt_camera *camera, double exact,
                     int samples, rt_sampler sampler)
{
    enum { W = 40, H = 30 };
    static rt_vec3 pixels[W * H], again[W * H];
    rt_options options = {
        .samples = samples, .bounces = RT_ALL_BOUNCES, .sampler = sampler, .threads = 2};
    rt_image image = small_image(W, H, pixels), other = small_image(W, H, again);
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    options.lanes = options.threads = 1;
    assert_int_equal(rt_render(scene, camera, &options, &other), RT_OK);
    assert_true(same_pixels(&image, &other));
    assert_int_equal(image.rays, other.rays);
    double sum = 0, squares = 0;
    for (int i = 0; i < W * H; i++) {
        sum += (double)pixels[i].x / (W * H);
        squares += pow((double)pixels[i].x, 2) / (W * H);
    }
    return (sum - exact) / sqrt((squares - sum * sum) / (W * H) + 1e-12);
}

static double furnace_off_by(float rho, int samples, rt_sampler sampler)
{
    /* direct light is rho everywhere, and later light is rho^2 + rho^3 ... */
    const rt_sphere sphere = {{0, 0, 0}, 10, {{rho, rho, rho}, false}};
    const float i = 314.15927f;
    const rt_light light = {{0, 0, 0}, {i, i, i}};
    const rt_scene scene = {
        .spheres = &sphere, .sphere_count = 1, .lights = &light, .light_count = 1};
    const rt_camera camera = {{2, 1, 5}, {-2, -1, -5}, {0, 1, 0}, 70};
    return off_by(&scene, &camera, (double)rho / (1 - (double)rho), samples, sampler);
}

static void test_all_bounces_are_all_the_light_in_a_furnace(void **state)
{
    (void)state;
    const float albedos[] = {0.3f, 0.8f, 0.95f};
    for (size_t i = 0; i < COUNT(albedos); i++) {
        assert_close(furnace_off_by(albedos[i], 16, RT_SOBOL), 0, 4);
        assert_close(furnace_off_by(albedos[i], 16, RT_RANDOM), 0, 4);
    }
}

/* White things and lossless mirrors, close together, in a white fog cannot be seen. */
static double fog_off_by(int samples)
{
    rt_sphere spheres[27];
    rt_box boxes[2] = {{{-40, -40, -40}, {40, -1.2f, 40}, {{1, 1, 1}, false}},
                       {{-40, 9.2f, -40}, {40, 40, 40}, {{0, 0, 0}, true}}};
    memset(spheres, 0, sizeof spheres);
    for (int i = 0; i < 27; i++) {
        spheres[i].center = rt_scale(
            rt_vec((float)(i % 3), (float)(i / 3 % 3), (float)(i / 9) - 4), 4.0f);
        spheres[i].radius = i % 2 == 0 ? 1.1f : 1.9f;
        spheres[i].material.mirror = i % 3 == 0;
        spheres[i].material.albedo = i % 2 == 0 ? rt_vec(1, 1, 1) : rt_vec(0, 0, 0);
        if (!spheres[i].material.mirror)
            spheres[i].material.albedo = rt_vec(1, 1, 1);
    }
    const rt_scene scene = {.spheres = spheres,
                            .sphere_count = 27,
                            .boxes = boxes,
                            .box_count = 2,
                            .background = {1, 1, 1}};
    const rt_camera camera = {.position = {4, 4, 6}};
    return off_by(&scene, &camera, 1, samples, RT_SOBOL);
}

/* Up a shaft of two mirrors that take a tenth: 0.9 to the power of the bounces, whatever
 * the roulette. */
static double shaft_off_by(uint32_t n)
{
    const rt_material mirror = {{0.9f, 0.9f, 0.9f}, true};
    const rt_box walls[2] = {{{-1, -50, -1}, {-1, 3.3f, 1}, mirror},
                             {{1, -50, -1}, {1, 3.3f, 1}, mirror}};
    const rt_scene scene = {.boxes = walls, .box_count = 2, .background = {1, 1, 1}};
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(1, 0.2f, 0));
    double sum = 0, squares = 0;
    rt_rng rng = rt_rng_start(0, 0, 107);
    const double exact = (double)rt_radiance(&scene, &ray, 1000, &rng).x;
    assert_close(exact, pow(0.9, 8), 1e-6);
    for (uint32_t i = 0; i < n; i++) {
        rng = rt_rng_start(i, 0, 107);
        const double value = (double)rt_radiance(&scene, &ray, RT_ALL_BOUNCES, &rng).x;
        sum += value / n;
        squares += value * value / n;
    }
    return (sum - exact) / sqrt((squares - sum * sum) / n);
}

static void test_all_bounces_are_all_the_light_with_mirrors(void **state)
{
    (void)state;
    assert_close(fog_off_by(16), 0, 4);
    assert_close(shaft_off_by(100000), 0, 4);
}

static void test_a_path_of_all_bounces_adds_up_to_its_sample(void **state)
{
    enum { MAX = 2000 };
    (void)state;
    static rt_vertex vertices[MAX];
    static rt_shadow shadows[MAX];
    rt_scene scene = scene_indirect;
    scene.background = rt_vec(0.1f, 0.2f, 0.3f);
    rt_vec3 pixels[16];
    int long_ones = 0;
    for (int sample = 0; sample < 20; sample++)
        for (int lanes = 0; lanes < 2; lanes++) {
            rt_image image = small_image(4, 4, pixels);
            image.samples = sample; /* then the pixel is (0 n + value) / (n + 1) ... */
            const rt_options options = {
                .samples = 1, .bounces = RT_ALL_BOUNCES, .lanes = lanes};
            assert_int_equal(rt_render(&scene, &room_camera, &options, &image), RT_OK);
            for (int i = 0; i < 16; i++) {
                rt_path path = {.vertices = vertices,
                                .max_vertices = MAX,
                                .shadows = shadows,
                                .max_shadows = MAX};
                assert_int_equal(rt_trace_pixel(&scene, &room_camera, &options, &image,
                                                i % 4, i / 4, sample, &path),
                                 RT_OK);
                assert_in_range(path.vertex_count, 1, MAX);
                rt_vec3 sum = rt_vec(0, 0, 0), part = rt_vec(1, 1, 1);
                for (int k = 0; k < path.vertex_count; k++) {
                    const rt_vertex *v = &vertices[k];
                    assert_memory_equal(&v->throughput, &part, sizeof part);
                    sum = rt_add(sum, rt_mul(v->throughput, v->light));
                    if (!v->hit.material)
                        continue;
                    part = rt_mul(part, v->hit.material->albedo);
                    const float most = fmaxf(part.x, fmaxf(part.y, part.z));
                    if (k >= RT__ROULETTE)
                        part = rt_scale(part, 1.0f / fminf(most, 0.95f));
                }
                assert_memory_equal(&sum, &path.value, sizeof sum);
                long_ones += path.vertex_count > 8;
                rt_vec3 mean = rt_vec(0, 0, 0); /* ... which is done in double */
                rt__add_to_mean(&mean, NULL, sample, path.value);
                assert_memory_equal(&mean, &pixels[i], sizeof mean);
            }
        }
    assert_in_range(long_ones, 10, 300);
}

/* ---- progress ----------------------------------------------------------------------- */

typedef struct watcher {
    const rt_image *image;
    double last, longest, until; /* the longest time without a call */
    double asleep, stopped;      /* when it first said stop */
    int calls, stop_at;
    bool changed, infinite, backwards;
    float part;
} watcher;

static uint32_t sum_of(const rt_image *image, bool *infinite)
{
    uint32_t sum = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        uint32_t bits[3];
        memcpy(bits, &image->pixels[i], sizeof bits);
        sum = rt_hash(sum + rt_hash(bits[0] + rt_hash(bits[1] + rt_hash(bits[2]))));
        *infinite = *infinite || !rt__is_finite(image->pixels[i]);
    }
    return sum;
}

static bool watch(void *user, float part)
{
    watcher *w = user;
    const double now = rt__seconds();
    w->longest = now - w->last > w->longest ? now - w->last : w->longest;
    const uint32_t before = sum_of(w->image, &w->infinite);
    for (double until = now + w->asleep; rt__seconds() < until;)
        ;
    w->changed = w->changed || sum_of(w->image, &w->infinite) != before;
    w->backwards = w->backwards || part < w->part || !(part >= 0 && part <= 1);
    w->part = part;
    w->calls++;
    w->last = rt__seconds();
    const bool go_on = w->last < w->until && w->calls != w->stop_at;
    if (!go_on && w->stopped == 0)
        w->stopped = w->last;
    return go_on;
}

/* The scenes in which a ray or a path takes long. */
enum { MANY_EQUAL, MIRRORS, WHITE, SLOW_KINDS };
static const char *const slow_names[] = {"10 000 equal spheres", "closed box of mirrors",
                                         "closed white box"};

typedef struct slow {
    rt_sphere spheres[10000];
    rt_box box;
    rt_light light;
    rt_scene scene;
    rt_bvh bvh;
    int bounces;
} slow;

static slow *slow_scene(int kind, int bounces)
{
    static slow s;
    memset(&s, 0, sizeof s);
    s.bounces = bounces;
    s.light.intensity = rt_vec(100, 100, 100);
    s.scene.lights = &s.light;
    s.scene.light_count = 1;
    s.box.min = rt_vec(-4, -3, -5);
    s.box.max = rt_vec(4, 3, 5);
    s.box.material.albedo = rt_vec(1, 1, 1);
    s.box.material.mirror = kind == MIRRORS;
    s.scene.boxes = &s.box;
    s.scene.box_count = kind != MANY_EQUAL;
    for (int i = 0; i < 10000 && kind == MANY_EQUAL; i++) {
        s.spheres[i].center = rt_vec(0, 0, -5);
        s.spheres[i].radius = 2;
        s.spheres[i].material.albedo = rt_vec(0.5f, 0.5f, 0.5f);
        s.scene.sphere_count = i + 1;
    }
    s.scene.spheres = s.spheres;
    assert_int_equal(rt_build_bvh(&s.scene, &s.bvh), RT_OK);
    s.scene.bvh = &s.bvh;
    return &s;
}

/* Render for a while, stop; in *stopping how long that took. */
static watcher render_slowly(const slow *s, int threads, int lanes, double seconds,
                             double asleep, double *stopping)
{
    enum { W = 160, H = 120 };
    static rt_vec3 pixels[W * H];
    rt_image image = small_image(W, H, pixels);
    watcher w = {.image = &image, .asleep = asleep};
    const rt_options options = {.samples = 1000,
                                .bounces = s->bounces,
                                .threads = threads,
                                .lanes = lanes,
                                .progress = watch,
                                .user = &w};
    const rt_camera camera = {.fov_y = 20};
    w.last = rt__seconds();
    w.until = w.last + seconds;
    assert_int_equal(rt_render(&s->scene, &camera, &options, &image), RT_CANCELLED);
    *stopping = rt__seconds() - w.stopped;
    return w;
}

/* A busy machine may keep a thread waiting for any time. What is late in every one of so
 * many tries is late by itself. */
enum { TRIES = 8 };

/* Asked every 15 ms, and at least every 50; here twice that is allowed. Meanwhile the
 * image does not change and makes sense. */
static void check_progress(int kind, int bounces, int threads, int lanes, double seconds,
                           double stop)
{
    slow *s = slow_scene(kind, bounces);
    double stopping = 0;
    watcher w;
    int tries = 0;
    bool in_time;
    do {
        w = render_slowly(s, threads, lanes, seconds, 1e-3, &stopping);
        in_time = w.longest < 0.1 && w.calls > 1 && stopping < stop;
        assert_false(w.changed);
        assert_false(w.infinite);
        assert_false(w.backwards);
    } while (!in_time && ++tries < TRIES);
    rt_free_bvh(&s->bvh);
    if (!in_time)
        fail_msg("%s, threads %d, lanes %d: asked %d times, once after %.3f s; stopped "
                 "after %.3f s",
                 slow_names[kind], threads, lanes, w.calls, w.longest, stopping);
}

/* Whoever stops waits for the end of a path. With a sanitizer each ray of it costs several times
 * as much. */
#ifdef __SANITIZE_ADDRESS__
enum { LONG_PATH = 50000 / 4 };
#else
enum { LONG_PATH = 50000 };
#endif

static void test_progress_is_asked_whatever_a_ray_costs(void **state)
{
    (void)state;
    for (int kind = 0; kind < SLOW_KINDS; kind++)
        for (int k = 0; k < 4; k++)
            check_progress(kind, LONG_PATH, 1 + k % 2, k / 2, 0.05, 0.3);
}

static void test_progress_is_asked_while_one_path_goes_on(void **state)
{
    (void)state;
    check_progress(MIRRORS, 4000000, 1, 1, 0.1, INFINITY);
    check_progress(WHITE, 1000000, 2, 0, 0.1, INFINITY);
}

static void test_seconds_are_kept_whatever_a_ray_costs(void **state)
{
    (void)state;
    slow *s = slow_scene(MANY_EQUAL, 0);
    rt_vec3 pixels[8 * 6];
    double seconds[4];
    for (int k = 0; k < 4; k++) {
        int tries = 0;
        do {
            rt_image image = small_image(8, 6, pixels);
            const rt_options options = {
                .seconds = 0.05f, .threads = 1 + k % 2, .lanes = k / 2};
            const rt_camera camera = {.fov_y = 20};
            const double start = rt__seconds();
            assert_int_equal(rt_render(&s->scene, &camera, &options, &image), RT_OK);
            seconds[k] = rt__seconds() - start;
            assert_true(image.samples > 0);
        } while (seconds[k] >= 0.15 && ++tries < TRIES);
    }
    rt_free_bvh(&s->bvh);
    for (int k = 0; k < 4; k++)
        assert_true(seconds[k] > 0.049 && seconds[k] < 0.15);
}

static void test_what_was_stopped_in_long_paths_goes_on_to_the_same_bits(void **state)
{
    enum { W = 9, H = 5, N = 3 };
    (void)state;
    rt_vec3 pixels[W * H], again[W * H];
    const rt_camera camera = {.fov_y = 60};
    int all_stops = 0;
    for (int kind = 1; kind < SLOW_KINDS; kind++) {
        slow *s = slow_scene(kind, kind == WHITE ? 2000 : 4000);
        s->scene.background = rt_vec(1, 1, 1);
        for (int k = 0; k < 4; k++) {
            rt_image whole = small_image(W, H, pixels), parts = small_image(W, H, again);
            rt_options options = {.samples = N,
                                  .bounces = s->bounces,
                                  .threads = 1 + k % 2,
                                  .lanes = k / 2};
            assert_int_equal(rt_render(&s->scene, &camera, &options, &whole), RT_OK);
            watcher w = {.image = &parts, .until = INFINITY};
            options.progress = watch;
            options.user = &w;
            int stops = 0;
            while (parts.samples < N) {
                options.samples = N - parts.samples;
                w.stop_at = w.calls + 1;
                const rt_status status = rt_render(&s->scene, &camera, &options, &parts);
                stops += status == RT_CANCELLED;
                assert_true(status == RT_OK || status == RT_CANCELLED);
                assert_true(stops < 10000);
            }
            all_stops += stops;
            assert_true(same_pixels(&whole, &parts));
            assert_int_equal(whole.rays, parts.rays);
        }
        rt_free_bvh(&s->bvh);
    }
    assert_true(all_stops > 8);
}

/* ---- rays that are none ------------------------------------------------------------- */

/* Seconds for so many rays of a kind, the least of five tries. */
static double seconds_of(const rt_scene *scene, const rt_ray *rays, int count, int *hits)
{
    double least = INFINITY;
    for (int attempt = 0; attempt < 5; attempt++) {
        const double start = rt__seconds();
        *hits = 0;
        for (int i = 0; i < count; i++) {
            rt_hit hit;
            *hits += rt_intersect(scene, &rays[i], &hit);
            *hits += rt_occluded(scene, &rays[i], FLT_MAX);
        }
        least = fmin(least, rt__seconds() - start);
    }
    return least;
}

static void test_rays_of_nan_or_infinity_cost_no_more_than_others(void **state)
{
    enum { N = 10000, RAYS = 1000 };
    (void)state;
    static rt_sphere spheres[N];
    static rt_ray rays[RAYS];
    rt_rng rng = rt_rng_start(0, 0, 108);
    for (int i = 0; i < N; i++) {
        spheres[i].center = random_point(&rng, 10);
        spheres[i].radius = 0.2f;
    }
    rt_scene scene = {.spheres = spheres, .sphere_count = N};
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    scene.bvh = &bvh;
    int hits = 0;
    for (int i = 0; i < RAYS; i++)
        rays[i] = random_ray(&rng);
    const double usual = seconds_of(&scene, rays, RAYS, &hits);
    assert_true(hits > RAYS);
    const float bad[] = {NAN, INFINITY, -INFINITY};
    for (int k = 0; k < 18; k++) {
        for (int i = 0; i < RAYS; i++) {
            rays[i] = random_ray(&rng);
            float *const numbers[] = {&rays[i].origin.x,    &rays[i].origin.y,
                                      &rays[i].origin.z,    &rays[i].direction.x,
                                      &rays[i].direction.y, &rays[i].direction.z};
            *numbers[k % 6] = bad[k / 6];
        }
        assert_true(seconds_of(&scene, rays, RAYS, &hits) < 3 * usual);
        assert_int_equal(hits, 0);
    }
    rt_free_bvh(&bvh);
}

/* ---- traps -------------------------------------------------------------------------- */

/* clang without -ftrapping-math computes what the program does not ask for. */
#if defined(__GLIBC__) && !defined(__clang__) && defined(__SSE2_MATH__)
#define TRAPS (FE_INVALID | FE_DIVBYZERO | FE_OVERFLOW)
#endif

#ifdef TRAPS
static rt_vec3 trap_pixels[32 * 24], trap_half[32 * 24];
static rt_guide trap_guides[32 * 24];
static rt_lens trap_lens; /* a pinhole, unless told */

/* The picture, with traps; with packets also with flags, which must stay. */
static void check_traps(const rt_scene *scene, const rt_camera *camera)
{
    rt_image image = small_image(32, 24, trap_pixels);
    rt_options options = {
        .samples = 2, .bounces = 3, .lanes = 1, .threads = 2, .lens = trap_lens};
    image.half = trap_half;
    image.guides = trap_guides;
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(TRAPS);
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    options.bounces = RT_ALL_BOUNCES;
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    static rt_vertex vertices[100];
    static rt_shadow shadows[100];
    for (int i = 0; i < 32 * 24; i += 5) {
        rt_path path = {.vertices = vertices,
                        .max_vertices = 100,
                        .shadows = shadows,
                        .max_shadows = 100};
        rt_trace_pixel(scene, camera, &options, &image, i % 32, i / 32, 0, &path);
    }
    rt_bvh bvh;
    rt_scene tree = *scene;
    assert_int_equal(rt_build_bvh(scene, &bvh), RT_OK);
    tree.bvh = &bvh;
    options.bounces = 3;
    assert_int_equal(rt_render(&tree, camera, &options, &image), RT_OK);
    assert_int_equal(fetestexcept(TRAPS), 0);

    options.lanes = 0;
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    assert_int_equal(rt_render(&tree, camera, &options, &image), RT_OK);
    assert_int_equal(fetestexcept(TRAPS), 0);
    assert_int_equal(fegetexcept(), TRAPS);
    fedisableexcept(FE_ALL_EXCEPT);
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    assert_int_equal(fetestexcept(TRAPS), 0);
    assert_int_equal(fegetexcept(), 0);
    feraiseexcept(FE_DIVBYZERO);
    assert_int_equal(rt_render(scene, camera, &options, &image), RT_OK);
    assert_int_equal(fetestexcept(TRAPS), FE_DIVBYZERO);
    feclearexcept(FE_ALL_EXCEPT);
    rt_free_bvh(&bvh);
}

static void check_traps_in_scenes(void)
{
    const rt_camera ahead = {.fov_y = 60};
    const rt_sphere two[2] = {{{0, -101, -5}, 100, {{1, 1, 1}, false}},
                              {{0, 0, -5}, 1, {{1, 1, 1}, false}}};
    rt_scene scene = {.spheres = two, .sphere_count = 2, .background = {1, 1, 1}};
    check_traps(&scene, &ahead);
    check_traps(&scene_indirect, &room_camera);
    rt_scene empty_one = {.background = {1, 1, 1}};
    check_traps(&empty_one, &ahead);

    /* lights in a wall, on an edge, in a corner, where the camera is; the camera in a wall */
    const rt_box box = {{-4, -3, -5}, {4, 3, 5}, {{1, 1, 1}, false}};
    const rt_light lights[] = {{{0, 3, 0}, {1e15f, 1e15f, 1e15f}},
                               {{4, 3, 0}, {1, 1, 1}},
                               {{4, 3, 5}, {1, 1, 1}},
                               {{0, 0, 0}, {1, 1, 1}},
                               {{1e15f, 1e15f, 1e15f}, {1, 1, 1}}};
    scene = (rt_scene){.boxes = &box, .box_count = 1, .lights = lights, .light_count = 5};
    check_traps(&scene, &ahead);
    const rt_camera in_the_wall = {.position = {4, 0, 0}, .direction = {0, 0, -1}};
    check_traps(&scene, &in_the_wall);
    const rt_camera narrow = {.fov_y = 1e-30f}, wide = {.fov_y = 179.999f};
    check_traps(&scene, &narrow);
    check_traps(&scene, &wide);

    /* as large, as small, as far away as allowed */
    const rt_sphere extreme[] = {{{1e15f, 1e15f, 1e15f}, 1e15f, {{1, 1, 1}, false}},
                                 {{-1e15f, 1e15f, -1e15f}, 1e-40f, {{1, 1, 1}, true}},
                                 {{0, 0, -1e-30f}, 1e-38f, {{1e-38f, 1, 1}, false}},
                                 {{0, 0, -9}, 1, {{1e-40f, 1e-30f, 1e-20f}, false}}};
    const rt_box boxes[] = {
        {{-1e15f, -1e15f, -1e15f}, {1e15f, 1e15f, 1e15f}, {{1, 1, 1}, 0}},
        {{0, 0, -1e15f}, {0, 0, 1e15f}, {{1, 1, 1}, true}},
        {{1e-40f, 1e-40f, -3}, {2e-40f, 2e-40f, -2}, {{1, 1, 1}, 0}},
        {{5, 5, 5}, {5, 5, 5}, {{1, 1, 1}, false}}};
    scene = (rt_scene){.spheres = extreme,
                       .sphere_count = 4,
                       .boxes = boxes,
                       .box_count = 4,
                       .lights = lights,
                       .light_count = 5};
    check_traps(&scene, &ahead);
    const rt_camera far = {.position = {1e15f, -1e15f, 1e15f}, .direction = {-1, 1, -1}};
    check_traps(&scene, &far);
    check_traps(&scene, &narrow);

    /* many */
    shapes s = deep_shapes(CUT_OFF, MIXED, 7);
    s.scene.lights = lights;
    s.scene.light_count = 5;
    check_traps(&s.scene, &ahead);
    check_traps(&s.scene, &far);
    free(s.spheres);
    free(s.boxes);
}

static rt_vec3 bright(const void *data, rt_vec3 direction)
{
    (void)data;
    return rt_scale(direction, 1e30f);
}

static rt_vec3 odd_albedo(const void *data, rt_vec3 point, rt_vec3 normal)
{
    (void)data;
    return rt_vec(point.x > 0 ? 1e30f : -1e30f, normal.y, 1e-40f);
}

/* All that part two has, with moderate numbers and with those at the limits. */
static void check_traps_in_part_two(void)
{
    const rt_camera ahead = {.fov_y = 60};
    const rt_camera inside = {.position = {-1, 0, -5}, .fov_y = 60};
    const rt_camera far = {.position = {1e15f, -1e15f, 1e15f}, .direction = {-1, 1, -1}};
    const rt_camera narrow = {.fov_y = 1e-30f}, wide = {.fov_y = 179.999f};
    const rt_camera *const cameras[] = {&ahead, &inside, &far, &narrow, &wide};
    const rt_sphere balls[4] = {{{0, -101, -5}, 100, {{0.8f, 0.8f, 0.8f}, false}},
                                {{-1, 0, -5}, 1, {{1, 1, 1}, false}},
                                {{1, 0, -5}, 1, {{0.9f, 0.8f, 0}, true}},
                                {{1, 0.5f, -3}, 0.5f, {{0, 0, 1}, false}}};
    const rt_box boxes[2] = {{{-3, -1, -6}, {-2, 1, -4}, {{0, 0, 0}, false}},
                             {{-9, -9, -9}, {9, 9, -9}, {{1, 1, 1}, true}}};
    const rt_surface glass = {.eta = 1.5f, .absorption = {0, 1, 1e15f}},
                     diamond = {.eta = 4, .absorption = {1e-40f, 1e-20f, 30}},
                     air = {.eta = 1}, plain = {.eta = 0}, soft = {.shininess = 1e-40f},
                     gloss = {.shininess = 50}, sharp = {.shininess = 1e6f},
                     glows = {.emission = {1e15f, 1e-40f, 0}},
                     odd = {.pattern = odd_albedo, .shininess = 1e6f};
    const rt_surface *const kinds[] = {&plain, &glass, &gloss, &sharp, &diamond,
                                       &air,   &soft,  &glows, &odd};
    const rt_lamp lamps[] = {
        {.center = {0, 3, -5}, .radius = 1, .intensity = {9, 9, 9}},
        {.center = {2, 3, -5}, .u = {1, 0, 0}, .v = {0, 0, 1}, .intensity = {9, 9, 9}},
        {.center = {0, -1, -5}, .radius = 1e-6f, .intensity = {1e15f, 1, 0}},
        {.center = {-1, 1, -5},
         .u = {1e-6f, 0, 0},
         .v = {0, 0, 1e-6f},
         .intensity = {1e15f, 0, 1}},
        {.center = {1e15f, 1e15f, 0}, .radius = 1e15f, .intensity = {1e15f, 1, 1}},
        {.center = {0, 0, 0}, .radius = 0.1f, .intensity = {1, 1e-40f, 1}},
        {.center = {0, 0, -5}, .radius = 1e-3f, .intensity = {1e15f, 1e15f, 1e15f}},
        {.center = {0, 1e15f, -5},
         .u = {1e15f, 0, 0},
         .v = {0, 0, 1e15f},
         .intensity = {1e15f, 1, 1}}};
    const rt_light light = {{0.01f, -0.9f, -3.9f}, {1e15f, 1, 1}};
    const rt_lens lenses[] = {
        {0, 0}, {0.1f, 5}, {1e15f, 1e-30f}, {1e-40f, 1e15f}, {1, 1e-40f}};
    for (size_t i = 0; i < 27; i++) {
        rt_surface table[6];
        for (size_t k = 0; k < 6; k++)
            table[k] = *kinds[(i + k * (i / 9 + 1)) % COUNT(kinds)];
        rt_scene scene = {.spheres = balls,
                          .sphere_count = 4,
                          .boxes = boxes,
                          .box_count = 2,
                          .lights = &light,
                          .light_count = 1,
                          .surfaces = table,
                          .lamps = &lamps[i % 7],
                          .lamp_count = 1 + (int)(i % 2),
                          .background = {1, 1, 1}};
        if (i % 3 == 0)
            scene.sky = bright;
        trap_lens = lenses[i / 5 % COUNT(lenses)];
        check_traps(&scene, cameras[i % 5]);
    }
    trap_lens = lenses[0];
}

/* A number of any size that is allowed, or 0, or 1. */
static float any_number(rt_rng *rng)
{
    const float r = rt_random(rng);
    return r < 0.1f    ? 0
           : r < 0.2f  ? 1
           : r < 0.3f  ? 1e15f
           : r < 0.38f ? -1e15f
           : r < 0.4f  ? 1e-40f
           : r < 0.6f  ? any_size(rng, 1e-20f, 1e15f)
                       : any_size(rng, 0.1f, 10);
}

static rt_vec3 any_numbers(rt_rng *rng)
{
    const float x = any_number(rng);
    const float y = any_number(rng);
    const float z = any_number(rng);
    return rt_vec(x, y, z);
}

static rt_vec3 any_light(rt_rng *rng)
{
    const rt_vec3 v = any_numbers(rng);
    return rt_vec(fabsf(v.x), fabsf(v.y), fabsf(v.z));
}

static void check_traps_in_odd_scenes(void)
{
    enum { ROUND = 3, SQUARE = 2, LAMPS = 3 };
    rt_rng rng = rt_rng_start(0, 0, 120);
    int rendered = 0;
    feclearexcept(FE_ALL_EXCEPT);
    feenableexcept(TRAPS);
    for (int i = 0; i < 5000; i++) {
        rt_sphere spheres[ROUND];
        rt_box boxes[SQUARE];
        rt_surface table[ROUND + SQUARE];
        rt_lamp lamps[LAMPS];
        rt_light light = {any_numbers(&rng), any_light(&rng)};
        for (int k = 0; k < ROUND; k++) {
            spheres[k].center = any_numbers(&rng);
            spheres[k].radius = fabsf(any_number(&rng)) + 1e-40f;
            spheres[k].material.albedo = random_colour(&rng);
            spheres[k].material.mirror = rt_random(&rng) < 0.5f;
        }
        for (int k = 0; k < SQUARE; k++) {
            boxes[k].min = any_numbers(&rng);
            boxes[k].max = rt_add(boxes[k].min, any_light(&rng));
            boxes[k].material.albedo = random_colour(&rng);
            boxes[k].material.mirror = rt_random(&rng) < 0.5f;
        }
        for (int k = 0; k < ROUND + SQUARE; k++) {
            const float kind = rt_random(&rng);
            memset(&table[k], 0, sizeof table[k]);
            if (kind < 0.4f)
                table[k].eta = kind < 0.1f ? 1 : uniform(&rng, 1, 4);
            else if (kind < 0.8f)
                table[k].shininess =
                    kind < 0.5f ? 1e6f : fabsf(any_size(&rng, 1e-30f, 1e6f));
            if (rt_random(&rng) < 0.5f)
                table[k].absorption = any_light(&rng);
            if (rt_random(&rng) < 0.3f)
                table[k].emission = any_light(&rng);
            if (rt_random(&rng) < 0.2f)
                table[k].pattern = odd_albedo;
        }
        for (int k = 0; k < LAMPS; k++) {
            lamps[k].center = any_numbers(&rng);
            lamps[k].radius =
                rt_random(&rng) < 0.4f ? 0 : fabsf(any_number(&rng)) + 1e-6f;
            lamps[k].u = any_numbers(&rng);
            lamps[k].v = any_numbers(&rng);
            lamps[k].intensity = any_light(&rng);
        }
        rt_scene scene = {.spheres = spheres,
                          .sphere_count = ROUND,
                          .boxes = boxes,
                          .box_count = SQUARE,
                          .lights = &light,
                          .light_count = 1,
                          .surfaces = table,
                          .lamps = lamps,
                          .lamp_count = LAMPS,
                          .background = any_light(&rng)};
        if (rt_random(&rng) < 0.2f)
            scene.sky = bright;
        rt_options options = {
            .samples = 2, .lanes = 1, .threads = 1, .seed = (uint32_t)i};
        options.bounces = i % 2 ? 3 : RT_ALL_BOUNCES;
        if (rt_random(&rng) < 0.5f) {
            options.lens.radius = fabsf(any_number(&rng));
            options.lens.focus = fabsf(any_number(&rng));
        }
        rt_camera camera = {.position = any_numbers(&rng),
                            .fov_y = uniform(&rng, 0, 179)};
        if (rt_random(&rng) < 0.8f) { /* at something */
            camera.direction =
                rt_sub(i % 2 ? spheres[0].center : lamps[0].center, camera.position);
        }
        rt_image image = small_image(4, 3, trap_pixels);
        image.half = trap_half;
        image.guides = trap_guides;
        if (rt_render(&scene, &camera, &options, &image) == RT_OK)
            rendered++;
        for (int k = 0; k < 12; k++)
            assert_true(trap_pixels[k].x >= 0 && trap_pixels[k].x <= FLT_MAX &&
                        trap_pixels[k].y >= 0 && trap_pixels[k].y <= FLT_MAX &&
                        trap_pixels[k].z >= 0 && trap_pixels[k].z <= FLT_MAX);
    }
    assert_int_equal(fetestexcept(TRAPS), 0);
    assert_true(rendered > 1000);
}

/* Rays along the axes, almost along them, and in the planes of the faces. */
static void check_traps_of_rays(void)
{
    const float c[] = {0, 1, -1, 1e-40f, -1e-30f, 1e15f, 1e-20f};
    const float o[] = {0, 1, -1, 1e15f, -1e-40f};
    const rt_box box = {{-1, -1, -1}, {1, 1, 1}, {{1, 1, 1}, false}};
    const rt_box large = {{-1e15f, 1, -1e15f}, {1e15f, 1, 1e15f}, {{1, 1, 1}, false}};
    const rt_sphere sphere = {{1e15f, 0, 0}, 1e-40f, {{1, 1, 1}, false}};
    rt_box both[2] = {box, large};
    rt_scene scene = {
        .spheres = &sphere, .sphere_count = 1, .boxes = both, .box_count = 2};
    rt_bvh bvh;
    feenableexcept(TRAPS);
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    for (int i = 0; i < 7 * 7 * 7 * 5 * 5 * 5; i++) {
        const int k = i / 343;
        const rt_ray ray = ray_of(rt_vec(o[k % 5], o[k / 5 % 5], o[k / 25]),
                                  rt_vec(c[i % 7], c[i / 7 % 7], c[i / 49 % 7]));
        rt_hit hit;
        rt_hit_box(&box, &ray, FLT_MAX, &hit);
        rt_hit_box(&large, &ray, FLT_MAX, &hit);
        rt_hit_sphere(&sphere, &ray, FLT_MAX, &hit);
        scene.bvh = i % 2 == 0 ? &bvh : NULL;
        rt_intersect(&scene, &ray, &hit);
        rt_occluded(&scene, &ray, 1.0f);
    }
    rt_free_bvh(&bvh);
}

static bool go_on(void *user, float part)
{
    (void)user;
    return part >= 0;
}

/* Only the first pixel takes long: this many times 1e-40 s is more than a float can hold. */
static rt_vec3 late_pixel(const void *user, float x, float y, rt_rng *rng)
{
    (void)user, (void)rng;
    const clock_t end = clock() + CLOCKS_PER_SEC / 16;
    while (x < 1 && y < 1 && clock() < end)
        ;
    return rt_vec(0, 0, 0);
}

static void check_traps_of_stops(void)
{
    /* an error of a black picture, and errors and seconds that are very large or small */
    const rt_options all[] = {{.samples = 40, .error = 0.01f},
                              {.samples = 40, .error = FLT_MAX},
                              {.samples = 40, .error = 1e-40f},
                              {.samples = 40, .seconds = 1e-40f, .progress = go_on},
                              {.samples = 40, .seconds = FLT_MAX, .progress = go_on}};
    for (size_t i = 0; i < 2 * COUNT(all); i++) {
        rt_options options = all[i / 2];
        options.lanes = 1;
        options.bounces = 1;
        rt_image image = small_image(32, 24, trap_pixels);
        image.half = trap_half;
        const rt_scene *scene = i % 2 == 0 ? &scene_sphere : &scene_indirect;
        feenableexcept(TRAPS);
        assert_int_equal(rt_render(scene, &room_camera, &options, &image), RT_OK);
        rt_image_error(&image);
        rt_encode(image.pixels[0].x, 2.2);
    }
    rt_image image = small_image(32, 24, trap_pixels);
    const rt_options late = {
        .samples = 1, .seconds = 1e-40f, .threads = 1, .progress = go_on};
    assert_int_equal(rt_render_pixels(late_pixel, NULL, &late, &image), RT_OK);
}

static void check_trapped(void (*check)(void))
{
    check();
    fedisableexcept(FE_ALL_EXCEPT);
    feclearexcept(FE_ALL_EXCEPT);
}

static int end_traps(void **state)
{
    (void)state;
    fedisableexcept(FE_ALL_EXCEPT);
    return 0;
}
#else
static void check_traps_in_scenes(void)
{
    print_message("note: no traps here, not tested\n");
}
#define check_traps_in_part_two() (void)0
#define check_traps_in_odd_scenes() (void)0
#define check_traps_of_rays() (void)0
#define check_traps_of_stops() (void)0
#define check_trapped(check) check()
#define end_traps NULL
#endif

static void test_valid_scenes_raise_no_exception(void **state)
{
    (void)state;
    check_trapped(check_traps_in_scenes);
}

static void test_nor_do_those_of_part_two(void **state)
{
    (void)state;
    check_trapped(check_traps_in_part_two);
}

static void test_nor_do_odd_scenes_of_part_two(void **state)
{
    (void)state;
    check_trapped(check_traps_in_odd_scenes);
}

static void test_nor_do_rays_along_the_axes(void **state)
{
    (void)state;
    check_trapped(check_traps_of_rays);
}

static void test_nor_does_what_ends_a_picture(void **state)
{
    (void)state;
    check_trapped(check_traps_of_stops);
}

/* ---- far spheres -------------------------------------------------------------------- */

static void test_a_sphere_is_hit_from_a_million_million_radii(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 109);
    for (int e = 3; e <= 15; e++)
        for (int i = 0; i < 20000; i++) {
            const float distance = powf(10, (float)e),
                        radius = any_size(&rng, 1e-3f, 1e2f);
            const rt_sphere s = {{0, 0, 0}, fabsf(radius), {{1, 1, 1}, false}};
            const rt_vec3 out = random_direction(&rng);
            rt_ray ray;
            ray.origin = rt_scale(out, distance * s.radius);
            ray.direction = rt_scale(ray.origin, -1);
            rt_hit hit = untouched;
            const bool hits = rt_hit_sphere(&s, &ray, FLT_MAX, &hit);
            if (e > 12) { /* if it is hit, it has a normal */
                if (hits)
                    assert_close(rt_length(hit.normal), 1, 1e-6);
                continue;
            }
            assert_true(hits);
            assert_close(hit.t, 1, 1.1 / (double)distance + 1e-7);
            assert_close(rt_ddot(rt_to_double(hit.normal), rt_to_double(hit.normal)), 1,
                         2e-6);
            assert_close(rt_dot(hit.normal, out), 1, 1e-2);

            /* aimed at its rim and beside it: the distance from the ray decides, unless
             * it is so close to the radius that no double can tell */
            const rt_vec3 side = rt_normalize(rt_cross(out, random_direction(&rng)));
            const float beside = i % 2 == 0 ? uniform(&rng, 0, 2) : 1.5f;
            ray.direction = rt_sub(rt_scale(side, beside * s.radius), ray.origin);
            const long double ox = ray.origin.x, oy = ray.origin.y, oz = ray.origin.z,
                              ux = ray.direction.x, uy = ray.direction.y,
                              uz = ray.direction.z, uu = ux * ux + uy * uy + uz * uz,
                              k = (ox * ux + oy * uy + oz * uz) / uu, x = ox - k * ux,
                              y = oy - k * uy, z = oz - k * uz;
            const double d = (double)(sqrtl(x * x + y * y + z * z) / s.radius);
            if (fabs(d - 1) < 1e-12 + 4e-16 * (double)distance)
                continue;
            assert_int_equal(rt_hit_sphere(&s, &ray, FLT_MAX, &hit), d < 1);
            if (d < 1)
                assert_close(rt_ddot(rt_to_double(hit.normal), rt_to_double(hit.normal)),
                             1, 2e-6);
        }
}

/* Rays that graze spheres which are tiny, and far away: tree and loop say the same. */
static void check_grazing(uint32_t seed, int rays, int *hits)
{
    enum { N = 24 };
    rt_sphere spheres[N];
    memset(spheres, 0, sizeof spheres);
    rt_rng rng = rt_rng_start(0, seed, 110);
    const float far = fabsf(any_size(&rng, 1, 1e12f));
    for (int i = 0; i < N; i++) {
        spheres[i].center = random_point(&rng, 1);
        spheres[i].radius = fabsf(any_size(&rng, 1e-9f, 0.3f));
        if (i % 3 == 0)
            spheres[i].center = rt_scale(spheres[i].center, i == 0 ? 0 : 1e5f);
    }
    rt_scene loop = {.spheres = spheres, .sphere_count = N}, tree = loop;
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&loop, &bvh), RT_OK);
    tree.bvh = &bvh;
    for (int i = 0; i < rays; i++) {
        const rt_sphere *s = &spheres[i % 11 < 4 ? 0 : i % N];
        rt_vec3 out = random_direction(&rng);
        rt_vec3 side = rt_normalize(rt_cross(out, random_direction(&rng)));
        if (i % 7 <
            3) { /* where the sphere touches the box that is around it in the tree */
            side = rt_vec(i % 7 == 0, i % 7 == 1, i % 7 == 2);
            out = rt_normalize(rt_cross(out, side));
        }
        rt_ray ray;
        ray.origin = rt_add(s->center, rt_scale(out, i % 5 == 0 ? far : far * s->radius));
        const float rim = s->radius * (i % 2 == 0 ? 1 : uniform(&rng, 0.998f, 1.002f));
        ray.direction = rt_sub(rt_add(s->center, rt_scale(side, rim)), ray.origin);
        if (i % 3 == 0)
            ray.direction = rt_normalize(ray.direction);
        rt_hit a = untouched, b = untouched;
        const bool hit = rt_intersect(&loop, &ray, &a);
        if (rt_intersect(&tree, &ray, &b) != hit || !same_hit(&a, &b) ||
            rt_occluded(&tree, &ray, FLT_MAX) != rt_occluded(&loop, &ray, FLT_MAX))
            fail_msg("seed %u, ray %d: loop %d t %.9g shape %d, tree t %.9g shape %d",
                     seed, i, hit, (double)a.t, a.shape, (double)b.t, b.shape);
        *hits += hit;
    }
    rt_free_bvh(&bvh);
}

static void test_tree_and_loop_agree_on_tiny_far_spheres(void **state)
{
    (void)state;
    int hits = 0;
    for (uint32_t seed = 0; seed < 150; seed++)
        check_grazing(seed, 1000, &hits);
    assert_in_range(hits, 15000, 135000);
}

static void test_packets_see_far_spheres_as_single_rays_do(void **state)
{
    (void)state;
    rt_vec3 pixels[16 * 12], again[16 * 12];
    rt_rng rng = rt_rng_start(0, 0, 112);
    for (int i = 0; i < 200; i++) {
        /* the camera at (0,0,0) and the spheres far away, or the other way round */
        const float far = fabsf(any_size(&rng, 1e2f, 1e12f));
        const rt_vec3 d = i % 5 == 0 ? rt_vec(1, 0, 0) : random_direction(&rng);
        const rt_vec3 from = rt_scale(d, i % 2 == 0 ? 0 : -far);
        const rt_vec3 c = rt_scale(d, i % 2 == 0 ? far : 0);
        const rt_sphere spheres[] = {
            {c, 1, {{1, 0.5f, 0.25f}, false}},
            {rt_add(c, rt_vec(0, 1.5f, 0)), 0.5f, {{0.25f, 0.5f, 1}, true}}};
        const rt_light light = {rt_add(c, rt_scale(d, -5)), {100, 100, 100}};
        const rt_scene scene = {.spheres = spheres,
                                .sphere_count = 1 + i / 2 % 2,
                                .lights = &light,
                                .light_count = 1,
                                .background = {0.1f, 0.1f, 0.1f}};
        const rt_camera camera = {.position = from, .direction = d, .fov_y = 200 / far};
        rt_options options = {.samples = 4, .bounces = 3};
        rt_image a = small_image(16, 12, pixels), b = small_image(16, 12, again);
        assert_int_equal(rt_render(&scene, &camera, &options, &a), RT_OK);
        options.lanes = 1;
        assert_int_equal(rt_render(&scene, &camera, &options, &b), RT_OK);
        if (!same_pixels(&a, &b))
            fail_msg("picture %d, from %g radii", i, (double)far);
    }
}

/* ---- whole numbers, texts, names ---------------------------------------------------- */

static void test_samples_close_to_the_largest_int(void **state)
{
    (void)state;
    rt_vec3 pixel, half, rest[2];
    const rt_scene scene = {.background = {2, 2, 2}};
    const rt_camera camera = {.fov_y = 45};
    for (int k = 0; k < 8; k++) {
        rt_image image = {.width = 1, .height = 1, .pixels = &pixel, .half = &half};
        image.samples = INT_MAX - 10;
        image.rest = k & 2 ? rest : NULL;
        memset(rest, 0, sizeof rest);
        pixel = half = rt_vec(1, 1, 1);
        rt_options options = {.samples = 4, .error = k & 1 ? 1e-9f : 0, .lanes = k / 4};
        assert_int_equal(rt_render(&scene, &camera, &options, &image), RT_OK);
        assert_int_equal(image.samples, INT_MAX - 6);
        assert_vec(pixel, 1, 1, 1, 1e-6);
        options.samples = 6;
        assert_int_equal(rt_render(&scene, &camera, &options, &image), RT_OK);
        assert_int_equal(image.samples, INT_MAX);
        assert_true(rt_image_error(&image) < 1e-3f);
        options.samples = 1;
        assert_int_equal(rt_render(&scene, &camera, &options, &image), RT_BAD_SAMPLES);
    }
}

static void test_a_cleared_image_takes_a_new_picture(void **state)
{
    (void)state;
    static rt_vec3 pixels[20 * 15], half[20 * 15], rest[2 * 20 * 15], fresh[20 * 15],
        fresh_rest[20 * 15];
    const rt_options options = {.samples = 3, .bounces = 2};
    rt_image image = small_image(20, 15, pixels), other = small_image(20, 15, fresh);
    image.half = half;
    image.rest = rest;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &image), RT_OK);
    image.done = 7;
    rt_image_clear(&image);
    assert_int_equal(image.samples, 0);
    assert_int_equal(image.done, 0);
    assert_int_equal(image.rays, 0);
    assert_int_equal(image.width, 20);
    assert_ptr_equal(image.half, half);
    assert_ptr_equal(image.rest, rest);
    image.half = NULL; /* so that other needs none */
    other.rest = fresh_rest;
    assert_int_equal(rt_render(&scene_cube, &room_camera, &options, &image), RT_OK);
    assert_int_equal(rt_render(&scene_cube, &room_camera, &options, &other), RT_OK);
    assert_true(same_pixels(&image, &other));
    assert_int_equal(image.rays, other.rays);
}

static void test_every_status_says_what_to_do(void **state)
{
    (void)state;
    const char *const verbs[] = {"make ", "set ", "take ", "build ", "render again"};
    for (int i = RT_OK; i <= RT_BAD_LENS; i++) {
        const char *text = rt_status_text((rt_status)i);
        const size_t length = strlen(text);
        assert_true(length > 5);
        assert_int_not_equal(text[length - 1], '.');
        assert_int_not_equal(text[length - 1], ' ');
        assert_null(strstr(text, "  "));
        bool says = i == RT_OK;
        for (size_t k = 0; k < COUNT(verbs); k++)
            says = says || strstr(text, verbs[k]);
        if (!says)
            fail_msg("status %d: %s", i, text);
        for (int k = RT_OK; k < i; k++)
            assert_string_not_equal(text, rt_status_text((rt_status)k));
    }
    assert_non_null(rt_status_text((rt_status)(RT_BAD_LENS + 1)));
}

static void test_a_hit_has_the_number_of_its_shape(void **state)
{
    (void)state;
    enum { W = 12, H = 9, MAX = 8 };
    rt_rng rng = rt_rng_start(0, 0, 111);
    int spheres = 0, boxes = 0;
    for (int i = 0; i < 40; i++) {
        random_scene r;
        make_random_scene(&r, &rng);
        rt_scene tree = r.scene;
        rt_bvh bvh;
        assert_int_equal(rt_build_bvh(&r.scene, &bvh), RT_OK);
        tree.bvh = &bvh;
        for (int k = 0; k < 200; k++) {
            const rt_ray ray = random_ray(&rng);
            rt_hit a = untouched, b = untouched;
            const bool hit = rt_intersect(&r.scene, &ray, &a);
            assert_int_equal(rt_intersect(&tree, &ray, &b), hit);
            assert_int_equal(a.shape, b.shape);
            if (!hit)
                continue;
            const int box = a.shape - r.scene.sphere_count;
            assert_ptr_equal(a.material, box < 0 ? &r.spheres[a.shape].material
                                                 : &r.boxes[box].material);
            spheres += box < 0;
            boxes += box >= 0;
        }
        rt_vertex vertices[MAX];
        rt_vec3 pixels[W * H];
        const rt_image image = small_image(W, H, pixels);
        const rt_camera camera = {.position = {0, 0, 15}, .fov_y = 90};
        const rt_options options = {.bounces = MAX - 1};
        for (int k = 0; k < W * H; k++)
            for (int by_tree = 0; by_tree < 2; by_tree++) {
                rt_path path = {.vertices = vertices, .max_vertices = MAX};
                const rt_scene *scene = by_tree ? &tree : &r.scene;
                assert_int_equal(rt_trace_pixel(scene, &camera, &options, &image, k % W,
                                                k / W, 0, &path),
                                 RT_OK);
                for (int v = 0; v < path.vertex_count; v++) {
                    rt_hit hit = untouched;
                    const bool found = rt_intersect(&tree, &vertices[v].ray, &hit);
                    assert_int_equal(vertices[v].shape, found ? hit.shape : -1);
                    assert_int_equal(vertices[v].hit.shape, found ? hit.shape : 0);
                }
            }
        rt_free_bvh(&bvh);
    }
    assert_in_range(spheres, 1000, 6000);
    assert_in_range(boxes, 300, 4000);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_no_tree_is_deeper_than_there_is_room_to_search),
        cmocka_unit_test(test_any_direction_and_any_up_make_a_film),
        cmocka_unit_test(test_an_up_close_to_the_direction_counts),
        cmocka_unit_test(test_an_up_that_is_no_direction_is_replaced),
        cmocka_unit_test(test_the_angle_of_view_is_right),
        cmocka_unit_test(test_no_ray_leaves_a_closed_room),
        cmocka_unit_test(test_nor_with_one_ray_at_a_time),
        cmocka_unit_test(test_no_path_leaves_a_closed_room_or_hits_where_it_is),
        cmocka_unit_test(test_what_comes_down_beside_a_cube_is_not_in_it),
        cmocka_unit_test(test_the_mean_does_not_drift),
        cmocka_unit_test(test_nor_does_that_of_a_picture_that_stops_by_itself),
        cmocka_unit_test(test_samples_may_be_split_in_any_way),
        cmocka_unit_test(test_the_estimated_error_is_that_of_the_mean),
        cmocka_unit_test_teardown(test_a_mean_that_gets_no_memory_leaves_all_as_it_was,
                                  memory_again),
        cmocka_unit_test(test_a_path_ends_when_nothing_is_left),
        cmocka_unit_test(test_paths_of_all_bounces_end),
        cmocka_unit_test(test_all_bounces_are_all_the_light_in_a_furnace),
        cmocka_unit_test(test_all_bounces_are_all_the_light_with_mirrors),
        cmocka_unit_test(test_a_path_of_all_bounces_adds_up_to_its_sample),
        cmocka_unit_test(test_progress_is_asked_whatever_a_ray_costs),
        cmocka_unit_test(test_progress_is_asked_while_one_path_goes_on),
        cmocka_unit_test(test_seconds_are_kept_whatever_a_ray_costs),
        cmocka_unit_test(test_what_was_stopped_in_long_paths_goes_on_to_the_same_bits),
        cmocka_unit_test(test_rays_of_nan_or_infinity_cost_no_more_than_others),
        cmocka_unit_test_teardown(test_valid_scenes_raise_no_exception, end_traps),
        cmocka_unit_test_teardown(test_nor_do_those_of_part_two, end_traps),
        cmocka_unit_test_teardown(test_nor_do_odd_scenes_of_part_two, end_traps),
        cmocka_unit_test_teardown(test_nor_do_rays_along_the_axes, end_traps),
        cmocka_unit_test_teardown(test_nor_does_what_ends_a_picture, end_traps),
        cmocka_unit_test(test_a_sphere_is_hit_from_a_million_million_radii),
        cmocka_unit_test(test_tree_and_loop_agree_on_tiny_far_spheres),
        cmocka_unit_test(test_packets_see_far_spheres_as_single_rays_do),
        cmocka_unit_test(test_samples_close_to_the_largest_int),
        cmocka_unit_test(test_a_cleared_image_takes_a_new_picture),
        cmocka_unit_test(test_every_status_says_what_to_do),
        cmocka_unit_test(test_a_hit_has_the_number_of_its_shape),
    };
    return cmocka_run_group_tests_name("17 under fire", tests, NULL, NULL);
}

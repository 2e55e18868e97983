/* Chapter 8: the tree over many shapes finds what asking each of them finds. */
#include <stdlib.h>

/* Memory that runs out at the allocation with number fail_at, and counts what is given back. */
static long allocated, taken, fail_at = -1;

static void *failing_malloc(size_t size)
{
    if (taken++ == fail_at)
        return NULL;
    void *memory = malloc(size);
    allocated += memory != NULL;
    return memory;
}

static void counting_free(void *memory)
{
    allocated -= memory != NULL;
    free(memory);
}

#define RT_MALLOC(size) failing_malloc(size)
#define RT_FREE(memory) counting_free(memory)
#include "../demos/scene.h"
#include "test.h"

/* ---- scenes ------------------------------------------------------------------------- */

typedef struct many {
    rt_sphere *spheres;
    rt_box *boxes;
    int room; /* in each of the arrays */
    rt_scene scene;
    rt_bvh bvh;
} many;

static many new_scene(int room)
{
    many m;
    memset(&m, 0, sizeof m);
    m.room = room;
    m.spheres = calloc((size_t)room + 1, sizeof *m.spheres);
    m.boxes = calloc((size_t)room + 1, sizeof *m.boxes);
    assert_non_null(m.spheres);
    assert_non_null(m.boxes);
    m.scene.spheres = m.spheres;
    m.scene.boxes = m.boxes;
    return m;
}

static void free_scene(many *m)
{
    rt_free_bvh(&m->bvh);
    free(m->spheres);
    free(m->boxes);
}

static void add_sphere(many *m, rt_vec3 center, float radius)
{
    assert_true(m->scene.sphere_count < m->room);
    rt_sphere *sphere = &m->spheres[m->scene.sphere_count++];
    sphere->center = center;
    sphere->radius = radius;
}

static void add_box(many *m, rt_vec3 a, rt_vec3 b)
{
    assert_true(m->scene.box_count < m->room);
    rt_box *box = &m->boxes[m->scene.box_count++];
    box->min = rt__min(a, b);
    box->max = rt__max(a, b);
}

static float log_uniform(rt_rng *rng, float low, float high)
{
    return low * powf(high / low, rt_random(rng));
}

/* The kinds of random scenes. */
enum { SMALL, GRID, SIZES, FLAT, GIANTS, COPIES, KINDS };

static void add_random_shape(many *m, int kind, bool sphere, rt_rng *rng)
{
    rt_vec3 p = random_point(rng, 10.0f), size = random_colour(rng);
    float radius = uniform(rng, 0.1f, 1.5f);
    if (kind == GRID) { /* whole numbers: shapes that touch, rays that graze */
        p = rt_vec(floorf(p.x), floorf(p.y), floorf(p.z));
        size = rt_vec(floorf(3 * size.x), floorf(3 * size.y), floorf(3 * size.z));
        radius = floorf(radius * 2) + 1;
    } else if (kind == SIZES) {
        const float scale = log_uniform(rng, 1e-3f, 1e3f);
        p = rt_scale(p, 0.1f * scale);
        size = rt_scale(size, scale);
        radius *= scale;
    } else if (kind == FLAT) {
        const float flat = rt_random(rng) < 0.5f ? 0.0f : 1e-6f;
        if (size.x < 0.6f)
            size.x = flat;
        else
            size.y = flat;
    } else if (kind == GIANTS && rt_random(rng) < 0.1f) {
        radius = log_uniform(rng, 1e3f, 1e6f);
        p = rt_scale(random_direction(rng), radius + 12.0f);
        size = rt_vec(1e4f, 1e4f, 1e4f);
    }
    if (sphere)
        add_sphere(m, p, radius);
    else
        add_box(m, p, rt_add(p, size));
    if (kind == COPIES)
        for (int i = 0; i < 3; i++) {
            if (sphere && m->scene.sphere_count < m->room)
                add_sphere(m, p, radius);
            else if (m->scene.box_count < m->room)
                add_box(m, p, rt_add(p, size));
        }
}

/* Spheres, boxes, or both. */
static many random_shapes(int kind, int count, int share, rt_rng *rng)
{
    many m = new_scene(4 * count);
    for (int i = 0; i < count; i++)
        add_random_shape(&m, kind, share == 0 || (share == 1 && i % 2 == 0), rng);
    assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
    return m;
}

/* ---- rays --------------------------------------------------------------------------- */

/* A point that has something to do with one of the shapes. */
static rt_vec3 point_about(const many *m, rt_rng *rng)
{
    const int number =
        (int)(rt_random(rng) * (float)(m->scene.sphere_count + m->scene.box_count));
    const float where = rt_random(rng);
    if (number < m->scene.sphere_count) {
        const rt_sphere *s = &m->spheres[number];
        const float out = where < 0.3f   ? rt_random(rng)
                          : where < 0.6f ? 1.0f
                                         : 1.0f + 3.0f * rt_random(rng);
        return rt_add(s->center, rt_scale(random_direction(rng), s->radius * out));
    }
    if (number >= m->scene.sphere_count + m->scene.box_count)
        return random_point(rng, 12.0f);
    const rt_box *b = &m->boxes[number - m->scene.sphere_count];
    const rt_vec3 part = random_colour(rng), size = rt_sub(b->max, b->min);
    rt_vec3 p = rt_add(b->min, rt_mul(part, size));
    if (where < 0.6f) /* on a face, an edge, or a corner */
        p = rt_vec(part.x < 0.4f ? b->min.x : p.x, part.y < 0.4f ? b->max.y : p.y,
                   part.z < 0.4f ? b->min.z : p.z);
    return p;
}

static float special(rt_rng *rng)
{
    const float values[] = {0, -0.0f, NAN, INFINITY, -INFINITY, FLT_MAX, 1e-40f, 1e20f};
    return values[(int)(rt_random(rng) * (float)COUNT(values))];
}

static rt_ray ray_about(const many *m, rt_rng *rng)
{
    const float how = rt_random(rng);
    rt_vec3 origin = how < 0.5f ? point_about(m, rng) : random_point(rng, 15.0f);
    rt_vec3 direction = rt_sub(point_about(m, rng), origin);
    const float what = rt_random(rng);
    if (what < 0.2f) { /* along an axis, or in a plane of two */
        const float kind = rt_random(rng);
        direction = rt_vec(kind < 0.6f ? 0.0f : 1.0f, kind < 0.3f ? -1.0f : -0.0f,
                           kind > 0.3f && kind < 0.8f ? 2.0f : 0.0f);
    } else if (what < 0.3f) { /* whole numbers */
        origin = rt_vec(floorf(origin.x), floorf(origin.y), floorf(origin.z));
        direction = rt_vec(floorf(direction.x), floorf(direction.y), floorf(direction.z));
    } else if (what < 0.5f) { /* of any length */
        direction = rt_scale(direction, log_uniform(rng, 1e-10f, 1e10f));
    } else if (what < 0.55f) { /* no ray at all, or almost none */
        float *const numbers[] = {&origin.x,    &origin.y,    &origin.z,
                                  &direction.x, &direction.y, &direction.z};
        *numbers[(int)(rt_random(rng) * 6.0f)] = special(rng);
    }
    return ray_of(origin, direction);
}

/* ---- the same hits ------------------------------------------------------------------ */

static long hits; /* that compare found: there must be some */

static void compare(const many *m, const rt_ray *ray)
{
    rt_scene plain = m->scene, tree = m->scene;
    tree.bvh = &m->bvh;
    rt_hit expected, hit;
    memset(&expected, 0x7f, sizeof expected);
    memset(&hit, 0x7f, sizeof hit);
    const bool is_hit = rt_intersect(&plain, ray, &expected);
    if (rt_intersect(&tree, ray, &hit) != is_hit ||
        memcmp(&hit, &expected, sizeof hit) != 0)
        fail_msg(
            "ray (%a, %a, %a) + t (%a, %a, %a) in %d spheres, %d boxes: %s at t = %.9g, "
            "with a tree %.9g",
            (double)ray->origin.x, (double)ray->origin.y, (double)ray->origin.z,
            (double)ray->direction.x, (double)ray->direction.y, (double)ray->direction.z,
            plain.sphere_count, plain.box_count, is_hit ? "hit" : "miss",
            (double)expected.t, (double)hit.t);
    hits += is_hit;
    const float t = is_hit ? expected.t : 1.0f;
    const float limits[] = {FLT_MAX,
                            t,
                            nextafterf(t, FLT_MAX),
                            nextafterf(t, 0.0f),
                            1.0f,
                            INFINITY,
                            NAN,
                            0.5f * t,
                            2.0f * t,
                            0.0f,
                            -1.0f};
    for (size_t i = 0; i < COUNT(limits); i++)
        if (rt_occluded(&plain, ray, limits[i]) != rt_occluded(&tree, ray, limits[i]))
            fail_msg("ray (%a, %a, %a) + t (%a, %a, %a): occluded before %a or not",
                     (double)ray->origin.x, (double)ray->origin.y, (double)ray->origin.z,
                     (double)ray->direction.x, (double)ray->direction.y,
                     (double)ray->direction.z, (double)limits[i]);
}

static void test_the_same_hits_as_without_a_tree(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 41);
    const int counts[] = {0, 1, 2, 9, 100, 2000};
    const int scenes[] = {2, 20, 20, 20, 4, 1}, rays[] = {100, 100, 100, 300, 1000, 60};
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t i = 0; i < COUNT(counts); i++)
            for (int share = 0; share < 3; share++)
                for (int k = 0; k < scenes[i]; k++) {
                    many m = random_shapes(kind, counts[i], share, &rng);
                    for (int n = 0; n < rays[i]; n++) {
                        const rt_ray ray = ray_about(&m, &rng);
                        compare(&m, &ray);
                    }
                    free_scene(&m);
                }
    assert_true(hits > 100000);
}

/* Rays that graze a sphere from far away, in the plane of a face of its box: where double
 * takes a miss for a hit, the box must not say no. */
static void test_grazing_rays_from_far_away(void **state)
{
    (void)state;
    const rt_sphere sphere = {{0, 0, 0}, 1, {{1, 1, 1}, false}};
    rt_scene scene = {0};
    rt_bvh bvh;
    scene.spheres = &sphere;
    scene.sphere_count = 1;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    rt_rng rng = rt_rng_start(5, 6, 7);
    int found = 0;
    for (int i = 0; i < 200000; i++) {
        const float distance = powf(10, uniform(&rng, 2, 6));
        const float beside = 1 + uniform(&rng, -1, 1) * 3e-16f * distance * distance;
        const rt_ray ray =
            i % 3 == 0   ? ray_of(rt_vec(beside, 0, distance), rt_vec(0, 0, -1))
            : i % 3 == 1 ? ray_of(rt_vec(distance, beside, 0), rt_vec(-1, 0, 0))
                         : ray_of(rt_vec(0, -distance, beside), rt_vec(0, 1, 0));
        rt_hit hit;
        scene.bvh = NULL;
        const bool without = rt_intersect(&scene, &ray, &hit);
        scene.bvh = &bvh;
        assert_int_equal(rt_intersect(&scene, &ray, &hit), without);
        found += without;
    }
    assert_in_range(found, 100000, 190000);
    rt_free_bvh(&bvh);
}

static void test_a_shape_without_size(void **state)
{
    /* Boxes that are points or lines, and rays straight at them. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 42);
    many m = new_scene(200);
    for (int i = 0; i < 200; i++) {
        const rt_vec3 p =
            rt_vec(floorf(uniform(&rng, -3, 3)), floorf(uniform(&rng, -3, 3)),
                   floorf(uniform(&rng, -3, 3)));
        add_box(&m, p, i % 2 == 0 ? p : rt_vec(p.x, p.y, p.z + 1));
    }
    assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
    const long before = hits;
    for (int i = 0; i < 5000; i++) {
        const rt_vec3 origin =
            rt_vec(floorf(uniform(&rng, -4, 4)), floorf(uniform(&rng, -4, 4)),
                   floorf(uniform(&rng, -4, 4)));
        const rt_vec3 target =
            rt_vec(floorf(uniform(&rng, -4, 4)), floorf(uniform(&rng, -4, 4)),
                   floorf(uniform(&rng, -4, 4)));
        const rt_ray ray = ray_of(origin, rt_sub(target, origin));
        compare(&m, &ray);
    }
    assert_true(hits > before + 500);
    free_scene(&m);
}

static void test_of_copies_the_first_wins(void **state)
{
    (void)state;
    many m = new_scene(300);
    for (int i = 0; i < 300; i++)
        add_sphere(&m, rt_vec(i % 3 == 1 ? 1.0f : 0.0f, 0, -5), 1);
    for (int i = 0; i < 300; i++)
        add_box(&m, rt_vec(-1, -1, -6), rt_vec(1, 1, -4));
    m.scene.bvh = &m.bvh;
    assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
    rt_hit hit = untouched;
    const rt_ray ahead = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    assert_true(rt_intersect(&m.scene, &ahead, &hit)); /* t = 4: spheres before boxes */
    assert_ptr_equal(hit.material, &m.spheres[0].material);
    const rt_ray beside = ray_of(rt_vec(-0.9f, 0.9f, 0), rt_vec(0, 0, -1));
    assert_true(rt_intersect(&m.scene, &beside, &hit));
    assert_ptr_equal(hit.material, &m.boxes[0].material);
    const rt_ray right = ray_of(rt_vec(1, 0, 0), rt_vec(0, 0, -1));
    assert_true(rt_intersect(&m.scene, &right, &hit));
    assert_ptr_equal(hit.material, &m.spheres[1].material);
    free_scene(&m);
}

static void test_an_empty_tree(void **state)
{
    (void)state;
    rt_scene nothing = {0};
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&nothing, &bvh), RT_OK);
    nothing.bvh = &bvh;
    assert_int_equal(rt_check_scene(&nothing, NULL), RT_OK);
    const rt_ray ray = ray_of(rt_vec(0, 0, 0), rt_vec(0, 0, -1));
    rt_hit hit = untouched;
    assert_false(rt_intersect(&nothing, &ray, &hit));
    assert_untouched(hit);
    assert_false(rt_occluded(&nothing, &ray, FLT_MAX));
    rt_free_bvh(&bvh);
}

static void test_pictures_with_a_tree_of_ones_own(void **state)
{
    /* rt_render builds the tree itself, or takes the one that is there. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 43);
    many m = random_shapes(GIANTS, 300, 1, &rng);
    const rt_light light = {{0, 0, 11}, {500, 500, 500}};
    m.scene.lights = &light;
    m.scene.light_count = 1;
    m.scene.background = rt_vec(0.5f, 0.6f, 0.7f);
    for (int i = 0; i < m.scene.sphere_count; i++)
        m.spheres[i].material.albedo = rt_vec(0.5f, 0.6f, 0.7f);
    const rt_camera camera = {{0, 0, 11}, {0, 0, -1}, {0, 1, 0}, 60};
    rt_options options = {0};
    options.samples = 2;
    options.bounces = 3;
    rt_image without = new_image(40, 30), with = new_image(40, 30);
    assert_int_equal(rt_render(&m.scene, &camera, &options, &without), RT_OK);
    m.scene.bvh = &m.bvh;
    const rt_bvh before = m.bvh;
    assert_int_equal(rt_render(&m.scene, &camera, &options, &with), RT_OK);
    assert_true(same_pixels(&without, &with));
    assert_int_equal(without.rays, with.rays);
    assert_true(without.pixels[20].x > 0);
    assert_memory_equal(&before, &m.bvh, sizeof before); /* it is still there */
    free(without.pixels);
    free(with.pixels);
    free_scene(&m);
}

/* ---- the tree itself ---------------------------------------------------------------- */

/* The k-th box of a node. */
static rt__bounds box_of(const rt_bvh_node *node, int k)
{
    rt__bounds b;
    b.min = rt_vec(node->min_x[k], node->min_y[k], node->min_z[k]);
    b.max = rt_vec(node->max_x[k], node->max_y[k], node->max_z[k]);
    return b;
}

static void assert_within(double inner, double low, double high)
{
    if (!(inner >= low && inner <= high))
        fail_msg("%.17g is not within %.17g to %.17g", inner, low, high);
}

static void assert_contains(const rt__bounds *b, double x, double y, double z, double r)
{
    assert_within(x - r, (double)b->min.x, (double)b->max.x);
    assert_within(y - r, (double)b->min.y, (double)b->max.y);
    assert_within(z - r, (double)b->min.z, (double)b->max.z);
    assert_within(x + r, (double)b->min.x, (double)b->max.x);
    assert_within(y + r, (double)b->min.y, (double)b->max.y);
    assert_within(z + r, (double)b->min.z, (double)b->max.z);
}

static void assert_holds(const rt__bounds *b, rt_vec3 p)
{
    assert_contains(b, (double)p.x, (double)p.y, (double)p.z, 0);
}

typedef struct tree_facts {
    unsigned char *seen; /* how often each shape was */
    int nodes, depth, shapes;
} tree_facts;

static void check_shape(const many *m, const rt__bounds *b, int number)
{
    if (number < m->scene.sphere_count) {
        const rt_sphere *s = &m->spheres[number];
        assert_contains(b, (double)s->center.x, (double)s->center.y, (double)s->center.z,
                        (double)s->radius);
    } else {
        assert_holds(b, m->boxes[number - m->scene.sphere_count].min);
        assert_holds(b, m->boxes[number - m->scene.sphere_count].max);
    }
}

/* A copy of each shape is beside its number. */
static void check_column(const many *m, const rt_bvh_row *rows, int k)
{
    const int number = rows->number[k];
    const float p[3] = {rows[1].value[k], rows[2].value[k], rows[3].value[k]};
    if (number < m->scene.sphere_count) {
        assert_memory_equal(p, &m->spheres[number].center, sizeof p);
        assert_true(rows[4].value[k] == m->spheres[number].radius);
    } else {
        const rt_box *box = &m->boxes[number - m->scene.sphere_count];
        const float q[3] = {rows[4].value[k], rows[5].value[k], rows[6].value[k]};
        assert_memory_equal(p, &box->min, sizeof p);
        assert_memory_equal(q, &box->max, sizeof q);
    }
}

static void check_leaf(const many *m, const rt__bounds *b, int leaf, tree_facts *facts)
{
    const rt_bvh_row *rows = &m->bvh.rows[leaf >> 2];
    const int kind = leaf & 3;
    assert_in_range(leaf >> 2, 0, m->bvh.row_count - 5);
    assert_true(rows->number[0] >= 0);
    for (int k = 0; k < 8; k++) {
        const int number = rows->number[k];
        if (number < 0) {
            assert_int_equal(number, -1);
            assert_true(rows[1].value[k] == rows[1].value[0]);
            continue;
        }
        assert_true(k == 0 || rows->number[k - 1] >= 0);
        assert_in_range(number, 0, m->scene.sphere_count + m->scene.box_count - 1);
        assert_int_equal(kind, number < m->scene.sphere_count ? RT__SPHERES : RT__BOXES);
        facts->seen[number]++;
        facts->shapes++;
        check_shape(m, b, number);
        check_column(m, rows, k);
    }
}

/* Every box contains what is in it. */
static void check_node(const many *m, int number, int depth, tree_facts *facts)
{
    const rt_bvh_node *node = &m->bvh.nodes[number];
    facts->nodes++;
    facts->depth = depth > facts->depth ? depth : facts->depth;
    assert_int_equal((uintptr_t)node % 64, 0);
    assert_in_range(node->count, depth == 1 ? 1 : 2, 8);
    for (int k = 0; k < node->count; k++) {
        const rt__bounds b = box_of(node, k);
        const int inside = node->inside[k];
        if (inside >= 0) {
            check_leaf(m, &b, inside, facts);
            continue;
        }
        assert_in_range(-inside, 1, m->bvh.node_count - 1);
        const rt_bvh_node *below = &m->bvh.nodes[-inside];
        for (int i = 0; i < below->count; i++) {
            const rt__bounds inner = box_of(below, i);
            assert_holds(&b, inner.min);
            assert_holds(&b, inner.max);
        }
        check_node(m, -inside, depth + 1, facts);
    }
}

static tree_facts check_tree(const many *m)
{
    const int count = m->scene.sphere_count + m->scene.box_count;
    tree_facts facts = {calloc((size_t)count, 1), 0, 0, 0};
    assert_non_null(facts.seen);
    check_node(m, 0, 1, &facts);
    for (int i = 0; i < count; i++)
        assert_int_equal(facts.seen[i], 1);
    assert_int_equal(facts.shapes, count);
    assert_int_equal(facts.nodes, m->bvh.node_count);
    assert_true(facts.nodes == 1 || facts.nodes <= (count - 2) / 7);
    assert_int_equal(m->bvh.sphere_count, m->scene.sphere_count);
    assert_int_equal(m->bvh.box_count, m->scene.box_count);
    /* each node on the way down leaves at most seven boxes to look at later */
    assert_true(7 * facts.depth + 1 <= RT__WAITING);
    free(facts.seen);
    facts.seen = NULL;
    return facts;
}

static void test_every_shape_is_in_the_tree_once(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 44);
    const int counts[] = {2, 3, 9, 17, 100, 2000};
    for (int kind = 0; kind < KINDS; kind++)
        for (size_t i = 0; i < COUNT(counts); i++)
            for (int share = 0; share < 3; share++) {
                many m = random_shapes(kind, counts[i], share, &rng);
                check_tree(&m);
                free_scene(&m);
            }
}

static void test_the_same_tree_by_any_number_of_threads(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 55);
    many m = random_shapes(SIZES, 90000, 1, &rng); /* enough for several threads */
    for (int threads = 1; threads < 6; threads += 2) {
        rt_bvh other;
        assert_int_equal(rt__build_bvh(&m.scene, threads, &other), RT_OK);
        assert_int_equal(other.node_count, m.bvh.node_count);
        assert_int_equal(other.row_count, m.bvh.row_count);
        assert_memory_equal(other.nodes, m.bvh.nodes,
                            (size_t)other.node_count * sizeof *other.nodes);
        assert_memory_equal(other.rows, m.bvh.rows,
                            (size_t)other.row_count * sizeof *other.rows);
        rt_free_bvh(&other);
    }
    check_tree(&m);
    free_scene(&m);
}

static void test_shapes_at_1_2_4_8(void **state)
{
    /* If the row is cut into parts of equal width, all shapes but one are always in the
     * same part: the tree would be as deep as there are shapes. Rows run in one
     * direction, in all, and towards zero, or end in a heap of many shapes. Hits are
     * compared with boxes only: chapter 1 cannot tell spheres so small and far away. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 45);
    int deepest = 0;
    for (int kind = 0; kind < 12; kind++) {
        many m = new_scene(600);
        for (int i = 0; i < 98; i++) {
            const float x = (kind % 2 == 0 ? 1.0f : -1.0f) * ldexpf(1, 48 - i);
            const rt_vec3 p = kind % 6 < 2   ? rt_vec(x, 0, 0)
                              : kind % 6 < 4 ? rt_vec(x, x, x)
                                             : rt_vec(x, -x, 1);
            if (kind < 6)
                add_sphere(&m, p, 0.25f * fabsf(x));
            else
                add_box(&m, p, rt_add(p, rt_vec(0.25f * x, 0.25f * x, 0)));
            for (int k = 0; k < 4; k++)
                add_box(&m, rt_vec(0, 0, (float)k * 1e-9f), rt_vec(1e-8f, 0, 0));
        }
        assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
        const tree_facts facts = check_tree(&m);
        deepest = facts.depth > deepest ? facts.depth : deepest;
        for (int i = 0; i < 500 && kind >= 6; i++) {
            const rt_ray ray = ray_about(&m, &rng);
            compare(&m, &ray);
        }
        free_scene(&m);
    }
    print_message("490 shapes at 1, 2, 4 ...: %d levels\n", deepest);
}

static void test_ten_thousand_equal_shapes(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 46);
    for (int kind = 0; kind < 3; kind++) {
        many m = new_scene(10000);
        for (int i = 0; i < 10000; i++)
            if (kind == 0)
                add_sphere(&m, rt_vec(1, 2, 3), 4);
            else
                add_box(&m, rt_vec(1, 2, 3),
                        kind == 1 ? rt_vec(2, 3, 4) : rt_vec(1, 2, 3));
        assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
        check_tree(&m);
        for (int i = 0; i < 20; i++) {
            const rt_ray ray = ray_about(&m, &rng);
            compare(&m, &ray);
        }
        free_scene(&m);
    }
}

static void test_concentric_spheres(void **state)
{
    /* All around one point, of all sizes: no cut separates them. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 47);
    many m = new_scene(1000);
    for (int i = 0; i < 1000; i++)
        add_sphere(&m, rt_vec(3, -2, 1), log_uniform(&rng, 1e-2f, 1e4f));
    assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
    check_tree(&m);
    for (int i = 0; i < 300; i++) {
        const rt_ray ray = ray_about(&m, &rng);
        compare(&m, &ray);
    }
    free_scene(&m);
}

/* ---- what it costs ------------------------------------------------------------------ */

/* The walls of the room, or not, and spheres evenly spread in it, which together always fill
 * a twentieth of it. */
static many spheres_in_the_room(int count, bool walls)
{
    rt_rng rng = rt_rng_start(0, 0, 48);
    many m = new_scene(count + 5);
    const float radius = cbrtf(0.05f * 90 * 54 * 95 / (4.18879f * (float)count));
    for (int i = 1; i < 6 && walls; i++)
        add_sphere(&m, room_spheres[i].center, room_spheres[i].radius);
    for (int i = 0; i < count; i++)
        add_sphere(&m,
                   rt_add(rt_vec(0, 9, -7.5f),
                          rt_mul(rt_vec(45, 27, 47.5f), random_point(&rng, 1))),
                   radius);
    assert_int_equal(rt_build_bvh(&m.scene, &m.bvh), RT_OK);
    return m;
}

/* A ray from somewhere in the room, to anywhere. */
static rt_ray ray_in_the_room(rt_rng *rng)
{
    const rt_vec3 p = random_point(rng, 1);
    return ray_of(rt_vec(45 * p.x, 9 + 27 * p.y, 47.5f * p.z - 7.5f),
                  random_direction(rng));
}

/* The nodes and shapes whose box begins before t on this ray: those a search must look at. */
static long to_look_at(const many *m, const rt_ray *ray, float t_max, int number)
{
    const rt_bvh_node *node = &m->bvh.nodes[number];
    const rt_vec3 inverse =
        rt_vec(rt__inverse(ray->direction.x), rt__inverse(ray->direction.y),
               rt__inverse(ray->direction.z));
    float t[8];
    const unsigned met = rt__enter(node, ray, inverse, t_max, t);
    long sum = 1;
    for (int k = 0; k < node->count; k++) {
        if ((met >> k & 1u) == 0)
            continue;
        if (node->inside[k] < 0)
            sum += to_look_at(m, ray, t_max, -node->inside[k]);
        for (int i = 0; i < 8 && node->inside[k] >= 0; i++)
            sum += m->bvh.rows[node->inside[k] >> 2].number[i] >= 0;
    }
    return sum;
}

/* Per ray. */
static double work_of(const many *m, int rays)
{
    rt_rng rng = rt_rng_start(0, 0, 49);
    rt_scene tree = m->scene;
    tree.bvh = &m->bvh;
    long looked_at = 0;
    for (int i = 0; i < rays; i++) {
        const rt_ray ray = ray_in_the_room(&rng);
        rt_hit hit;
        const bool found = rt_intersect(&tree, &ray, &hit);
        looked_at += to_look_at(m, &ray, found ? hit.t : FLT_MAX, 0);
    }
    return (double)looked_at / rays;
}

static void test_a_thousand_times_the_shapes_a_few_times_the_work(void **state)
{
    (void)state;
    enum { RAYS = 20000 };
    const int counts[] = {10, 10000};
    double work[2], seconds[2] = {1e9, 1e9};
    for (int i = 0; i < 2; i++) {
        many m = spheres_in_the_room(counts[i], true);
        rt_scene tree = m.scene;
        tree.bvh = &m.bvh;
        work[i] = work_of(&m, RAYS);
        for (int pass = 0; pass < 3; pass++) { /* the best of three */
            rt_rng rng = rt_rng_start(0, 0, 49);
            const double start = rt__seconds();
            for (int k = 0; k < RAYS; k++) {
                const rt_ray ray = ray_in_the_room(&rng);
                rt_hit hit = untouched;
                rt_intersect(&tree, &ray, &hit);
            }
            const double took = rt__seconds() - start;
            seconds[i] = took < seconds[i] ? took : seconds[i];
        }
        print_message(
            "%d spheres in the room: a ray looks at %.1f nodes and shapes, %.0f ns\n",
            counts[i], work[i], 1e9 * seconds[i] / RAYS);
        free_scene(&m);
    }
    assert_true(work[1] <= 8 * work[0]);
    assert_true(seconds[1] <=
                40 * seconds[0]); /* 600 without a tree; other programs run here, too */
}

static void test_a_hundred_thousand_shapes_soon(void **state)
{
    /* n log n: eight times the shapes take about nine times as long, not 64 times. */
    (void)state;
    double took[2];
    for (int i = 0; i < 2; i++) {
        const double start = rt__seconds();
        many m = spheres_in_the_room(i == 0 ? 12500 : 100000, true);
        took[i] = rt__seconds() - start;
        const tree_facts facts = check_tree(&m);
        print_message("%d spheres: %d nodes, %d levels, %.0f ms\n", m.scene.sphere_count,
                      facts.nodes, facts.depth, 1000 * took[i]);
        assert_in_range(facts.depth, 4, 15);
        free_scene(&m);
    }
    assert_true(took[1] < 5);
    assert_true(took[1] < 25 * took[0] + 0.1);
}

static void test_giants_do_not_spoil_it(void **state)
{
    (void)state;
    many alone = spheres_in_the_room(1000, false),
         walls = spheres_in_the_room(1000, true);
    const double without = work_of(&alone, 5000), with = work_of(&walls, 5000);
    print_message("1000 spheres: %.1f nodes and shapes, with the walls %.1f\n", without,
                  with);
    assert_true(with < 1.5 * without + 5);
    free_scene(&alone);
    free_scene(&walls);
}

/* ---- bad input ---------------------------------------------------------------------- */

static const rt_bvh empty; /* all zero */

static void expect_refused(const rt_scene *scene, rt_status status)
{
    rt_bvh bvh;
    memset(&bvh, 0x55, sizeof bvh); /* it need not be cleared before */
    assert_int_equal(rt_build_bvh(scene, &bvh), status);
    assert_memory_equal(&bvh, &empty, sizeof bvh);
}

/* In the very plane of flat boxes, a ray so short that t is beyond 1e22. */
static void test_far_along_a_short_ray(void **state)
{
    (void)state;
    rt_box boxes[9];
    memset(boxes, 0, sizeof boxes);
    for (int i = 0; i < 9; i++) {
        boxes[i].min = rt_vec(1e14f + 1e13f * (float)i, 0, -1e14f);
        boxes[i].max = rt_vec(2e14f, 0, 1e14f);
    }
    rt_scene scene;
    memset(&scene, 0, sizeof scene);
    scene.boxes = boxes;
    scene.box_count = 9;
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(&scene, &bvh), RT_OK);
    for (int power = -12; power <= 2; power++) {
        const rt_ray ray = {{0, 0, 0}, {powf(10, (float)power), 0, 0}};
        rt_hit loop, tree;
        memset(&loop, 0, sizeof loop);
        memset(&tree, 0, sizeof tree);
        scene.bvh = NULL;
        assert_true(rt_intersect(&scene, &ray, &loop));
        scene.bvh = &bvh;
        assert_true(rt_intersect(&scene, &ray, &tree));
        assert_true(tree.shape == loop.shape && tree.t == loop.t);
        assert_true(rt_occluded(&scene, &ray, FLT_MAX));
    }
    rt_free_bvh(&bvh);
}

static void test_bad_scenes_make_no_tree(void **state)
{
    (void)state;
    const float bad[] = {NAN, INFINITY, -INFINITY, 2e15f};
    random_scene r;
    rt_rng rng = rt_rng_start(0, 0, 51);
    make_random_scene(&r, &rng);
    rt_bvh bvh;
    assert_int_equal(rt_build_bvh(NULL, &bvh), RT_BAD_POINTER);
    assert_int_equal(rt_build_bvh(&r.scene, NULL), RT_BAD_POINTER);
    r.scene.sphere_count = INT_MAX; /* refused before anything is looked at */
    assert_int_equal(rt_build_bvh(&r.scene, &bvh), RT_NO_MEMORY);
    r.scene.sphere_count = (int)COUNT(r.spheres);
    const long before = allocated;
    for (size_t i = 0; i < COUNT(bad); i++) {
        float *const places[] = {&r.spheres[4].center.z, &r.spheres[0].radius,
                                 &r.boxes[3].min.x, &r.boxes[1].max.y};
        for (size_t k = 0; k < COUNT(places); k++) {
            const float good = *places[k];
            *places[k] = bad[i];
            expect_refused(&r.scene, k < 2 ? RT_BAD_SPHERE : RT_BAD_BOX);
            *places[k] = good;
        }
    }
    rt_scene scene = r.scene;
    scene.sphere_count = -1;
    expect_refused(&scene, RT_BAD_POINTER);
    scene = r.scene;
    scene.boxes = NULL;
    expect_refused(&scene, RT_BAD_POINTER);
    scene = r.scene;
    r.lights[1].intensity.x = -1;
    expect_refused(&scene, RT_BAD_LIGHT);
    assert_int_equal(allocated, before);
}

static void test_a_tree_of_another_scene_is_refused(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 52);
    many m = random_shapes(SMALL, 50, 1, &rng);
    rt_image image = new_image(2, 2);
    m.scene.bvh = &m.bvh;
    assert_int_equal(rt_check_scene(&m.scene, NULL), RT_OK);
    int *const counts[] = {&m.scene.sphere_count, &m.scene.box_count};
    for (int i = 0; i < 2; i++) {
        --*counts[i];
        assert_int_equal(rt_check_scene(&m.scene, NULL), RT_BAD_BVH);
        assert_int_equal(rt_render(&m.scene, &room_camera, NULL, &image), RT_BAD_BVH);
        ++*counts[i];
    }
    m.scene.sphere_count--; /* as many in all */
    m.scene.box_count++;
    assert_int_equal(rt_check_scene(&m.scene, NULL), RT_BAD_BVH);
    m.scene.sphere_count++;
    m.scene.box_count--;
    m.scene.bvh = &empty; /* freed, or never built */
    assert_int_equal(rt_check_scene(&m.scene, NULL), RT_BAD_BVH);
    rt_bvh fresh; /* rt_build_bvh ignores an old tree */
    assert_int_equal(rt_build_bvh(&m.scene, &fresh), RT_OK);
    rt_free_bvh(&fresh);
    assert_int_equal(image.samples, 0);
    free(image.pixels);
    free_scene(&m);
}

static void test_free_twice(void **state)
{
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 53);
    const long before = allocated;
    many m = random_shapes(SMALL, 50, 1, &rng);
    assert_true(allocated > before);
    rt_free_bvh(&m.bvh);
    assert_int_equal(allocated, before);
    assert_memory_equal(&m.bvh, &empty, sizeof empty);
    rt_free_bvh(&m.bvh);
    rt_free_bvh(NULL);
    assert_int_equal(allocated, before);
    free_scene(&m);
}

static void test_no_memory(void **state)
{
    /* Whichever allocation fails: the status, nothing leaked, the image untouched. Few shapes
     * and many. */
    (void)state;
    rt_rng rng = rt_rng_start(0, 0, 54);
    const int counts[] = {1, 12, 100};
    for (size_t i = 0; i < COUNT(counts); i++) {
        many m = random_shapes(SMALL, counts[i], 1, &rng);
        rt_free_bvh(&m.bvh);
        const long before = allocated;
        rt_vec3 pixel = {7, 7, 7};
        for (int render = 0; render < 2; render++) {
            rt_status status = RT_NO_MEMORY;
            int failures = -1;
            for (fail_at = 0; status != RT_OK; fail_at++) {
                rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
                taken = 0;
                memset(&m.bvh, 0x55, sizeof m.bvh);
                if (render == 1)
                    status = rt_render(&m.scene, &room_camera, NULL, &image);
                else
                    status = rt_build_bvh(&m.scene, &m.bvh);
                failures++;
                assert_true(status == RT_OK || status == RT_NO_MEMORY);
                if (status == RT_OK)
                    break;
                assert_int_equal(allocated, before);
                assert_vec(pixel, 7, 7, 7, 0);
                assert_int_equal(image.samples, 0);
                if (render == 0)
                    assert_memory_equal(&m.bvh, &empty, sizeof empty);
            }
            fail_at = -1;
            if (render == 0) {
                assert_true(failures >= 3);
                rt_free_bvh(&m.bvh);
            } else {
                assert_true(failures >= 3 || counts[i] < 20);
                assert_true(pixel.x != 7);
                memset(&m.bvh, 0, sizeof m.bvh);
            }
            assert_int_equal(allocated, before);
        }
        free_scene(&m);
    }
}

static void test_nothing_is_left_allocated(void **state)
{
    (void)state;
    assert_int_equal(allocated, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_the_same_hits_as_without_a_tree),
        cmocka_unit_test(test_grazing_rays_from_far_away),
        cmocka_unit_test(test_a_shape_without_size),
        cmocka_unit_test(test_of_copies_the_first_wins),
        cmocka_unit_test(test_an_empty_tree),
        cmocka_unit_test(test_pictures_with_a_tree_of_ones_own),
        cmocka_unit_test(test_every_shape_is_in_the_tree_once),
        cmocka_unit_test(test_the_same_tree_by_any_number_of_threads),
        cmocka_unit_test(test_shapes_at_1_2_4_8),
        cmocka_unit_test(test_ten_thousand_equal_shapes),
        cmocka_unit_test(test_concentric_spheres),
        cmocka_unit_test(test_a_thousand_times_the_shapes_a_few_times_the_work),
        cmocka_unit_test(test_a_hundred_thousand_shapes_soon),
        cmocka_unit_test(test_giants_do_not_spoil_it),
        cmocka_unit_test(test_far_along_a_short_ray),
        cmocka_unit_test(test_bad_scenes_make_no_tree),
        cmocka_unit_test(test_a_tree_of_another_scene_is_refused),
        cmocka_unit_test(test_free_twice),
        cmocka_unit_test(test_no_memory),
        cmocka_unit_test(test_nothing_is_left_allocated),
    };
    return cmocka_run_group_tests_name("8 many shapes", tests, NULL, NULL);
}

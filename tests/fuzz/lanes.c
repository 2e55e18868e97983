/* Random scenes, made to be awkward: does rt_render draw, with a tree and with 4, 8 and 16
 * lanes, the bits that the plain loop of chapters 1 to 7 draws? Any compiler will do:
 *
 *     cc -std=c99 -O2 -fno-math-errno -ffp-contract=off -o lanes tests/fuzz/lanes.c -lm
 *     ./lanes SECONDS [SEED]      0 seconds: only the scene of this seed
 *
 * A scene that differs is made smaller and printed as C, for a test in tests/13_packets.c. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#define RT_IMPLEMENTATION
#include "../../rt.h"

/* The scene, one at a time, and all else that its picture depends on. */
enum { SHAPES = 120, LIGHTS = 3, WIDEST = 19, HIGHEST = 9, PIXELS = WIDEST * HIGHEST };
static rt_sphere spheres[SHAPES];
static rt_box boxes[SHAPES];
static rt_light lights[LIGHTS];
static rt_scene scene = {.spheres = spheres, .boxes = boxes, .lights = lights};
static rt_camera camera;
static rt_options options = {.threads = 1};
static int width, height, first_sample;

/* ---- numbers ------------------------------------------------------------------------ */

/* No expression asks for two random numbers, as their order would be the compiler's: a seed
 * makes the same scene with all of them. */
static rt_rng rng;
static float unit;     /* of length */
static rt_vec3 middle; /* of the scene: far from (0,0,0) few digits are left */

/* The style of lengths: few different ones, so that things touch, coincide and line up; or
 * almost; or any. */
enum { FEW, ALMOST, ANY, ALL_SIZES, STYLES };
static int style;

static int below(int n)
{
    return (int)(rt_random(&rng) * (float)n);
}

static float magnitude(float low, float high) /* 1 to 10 as often as 10 to 100 */
{
    return low * powf(high / low, rt_random(&rng));
}

static float nudge(float x) /* some roundings up or down */
{
    return x * (1.0f + FLT_EPSILON * (float)(below(7) - 3));
}

static float size(void)
{
    static const float few[] = {0.25f, 0.5f, 1, 1, 2, 2, 3, 4, 5, 13};
    const float one = unit * few[below(10)];
    return style == FEW      ? one
           : style == ALMOST ? nudge(one)
           : style == ANY    ? unit * 6 * rt_random(&rng)
                             : unit * magnitude(1e-6f, 1e4f);
}

static rt_vec3 offset(void)
{
    float v[3];
    for (int k = 0; k < 3; k++) {
        const float sign = (float)(below(3) - 1); /* -1, 0, 1 */
        v[k] = sign * size();
    }
    return rt_vec(v[0], v[1], v[2]);
}

static rt_vec3 direction(void)
{
    return rt_normalize(offset()); /* often along an axis */
}

static rt_vec3 all(float x)
{
    return rt_vec(x, x, x);
}

/* ---- a scene ------------------------------------------------------------------------ */

static void add_shape(bool is_sphere, rt_vec3 p, float radius)
{
    const float red = below(4) > 0 ? rt_random(&rng) : (float)below(2);
    const float green = below(4) > 0 ? rt_random(&rng) : 1e-20f;
    const bool grey = below(2) == 0, mirror = below(4) == 0;
    const rt_material material = {{red, grey ? red : green, red}, mirror};
    const rt_vec3 half = is_sphere || below(2) == 0 ? all(radius) : offset();
    const rt_vec3 a = rt_sub(p, half), b = rt_add(p, half);
    const rt_sphere sphere = {p, radius, material};
    const rt_box box = {rt__min(a, b), rt__max(a, b), material};
    if (is_sphere)
        spheres[scene.sphere_count++] = sphere;
    else
        boxes[scene.box_count++] = box;
}

/* Each shape has a relation to the one before it, p and radius, or to the middle; most shapes
 * of a scene have the same. */
static void add_shapes(void)
{
    enum { RELATIONS = 7 };
    const int usual = below(RELATIONS), spheres_of_four = below(5);
    rt_vec3 p = middle;
    float radius = unit;
    for (int i = below(6) > 0 ? below(11) : below(SHAPES + 1); i > 0; i--) {
        const rt_vec3 anywhere = rt_add(middle, offset()), to = direction();
        const float next = size(), other = unit * magnitude(1e-6f, 1e6f);
        const float giant = unit * magnitude(10, 1e9f), part = rt_random(&rng);
        const float more = magnitude(1e-8f, 1), little = (float)below(2) * FLT_EPSILON;
        const struct {
            rt_vec3 from;
            float distance, radius;
        } relations[RELATIONS] = {
            {p, radius * little, radius},      /* equal, or almost */
            {p, 0, radius * (1 + more)},       /* around it, or almost equal */
            {p, radius + next, next},          /* touching it */
            {anywhere, 0, next},               /* none */
            {middle, 3 * other * part, other}, /* the larger, the farther */
            {middle, giant + 6 * unit, giant}, /* a wall of a room */
            {middle, unit * part, 20 * unit},  /* around all, or most */
        };
        const int relation = below(4) > 0 ? usual : below(RELATIONS);
        p = rt_add(relations[relation].from, rt_scale(to, relations[relation].distance));
        radius = relations[relation].radius;
        add_shape(below(4) < spheres_of_four, p, radius);
    }
}

/* A place for a light or the camera: in, on or near a shape, or anywhere. */
static rt_vec3 place(void)
{
    const int what = below(9);
    style = below(STYLES);
    rt_vec3 p = rt_add(middle, offset());
    if (what < 4 && scene.sphere_count > 0) {
        const rt_sphere *s = &spheres[below(scene.sphere_count)];
        const float beside = magnitude(1e-8f, 1), out[] = {0, 1 - beside, 1, 1 + beside};
        p = rt_add(s->center, rt_scale(direction(), out[what] * s->radius));
    } else if (what < 7 && scene.box_count > 0) {
        const rt_box *b = &boxes[below(scene.box_count)];
        p = rt__min(b->max, rt__max(b->min, rt_add(b->min, offset())));
    }
    p.x = below(9) > 0 ? p.x : nudge(p.x);
    return p;
}

static void make_scene(uint32_t seed)
{
    rng = rt_rng_start(seed, 0, 0);
    style = below(STYLES);
    unit = below(3) > 0 ? 1.0f : powf(10, (float)(below(20) - 5));
    const float away = below(9) > 0 ? 0.0f : unit * magnitude(1e2f, 1e7f);
    middle = rt_scale(direction(), away);
    scene.sphere_count = scene.box_count = 0;
    add_shapes();
    scene.background = all((float)below(2) * 0.5f);
    scene.light_count = below(4) > 0 ? 1 : below(LIGHTS + 1);
    for (int i = 0; i < LIGHTS; i++) {
        lights[i].position = place();
        lights[i].intensity = all(fminf(unit * unit * magnitude(1, 1000), 1e12f));
    }

    const rt_vec3 target = below(3) > 0 ? place() : lights[0].position;
    camera.position = place();
    camera.direction = rt_sub(target, camera.position);
    if (below(3) == 0) { /* along an axis, or a tangent */
        camera.direction = direction();
        if (scene.sphere_count > 0 && below(2) == 0) {
            const rt_vec3 n = rt_sub(target, spheres[below(scene.sphere_count)].center);
            camera.direction = rt_normalize(rt_cross(n, camera.direction));
        }
        camera.position = rt_sub(target, rt_scale(camera.direction, size()));
    }
    if (below(20) == 0)
        lights[0].position = camera.position;
    camera.up = below(3) > 0 ? all(0) : direction();
    camera.fov_y = below(2) > 0 ? 179 * rt_random(&rng) : magnitude(1e-10f, 179);

    width = 1 + below(WIDEST);
    height = 1 + below(HIGHEST);
    first_sample = below(3) > 0 ? 0 : below(1000);
    options.samples = 1 + below(3);
    options.bounces = below(4) > 0 ? below(6) : below(40);
    options.seed = seed;
    options.sampler = below(3) > 0 ? RT_SOBOL : RT_RANDOM;
}

/* ---- its pictures ------------------------------------------------------------------- */

static double rays; /* of all plain pictures */

static rt_vec3 plain_pixel(const void *context, float x, float y, rt_rng *numbers)
{
    (void)context;
    const rt_ray ray = rt_camera_ray(&camera, width, height, x, y);
    return rt_radiance(&scene, &ray, options.bounces, numbers);
}

/* With 0 lanes: the plain loop. One lane gets a tree, packets make one for themselves. */
static uint64_t draw(int lanes, const rt_bvh *bvh, rt_vec3 *pixels)
{
    rt_image image = {
        .width = width, .height = height, .pixels = pixels, .samples = first_sample};
    memset(pixels, 0, sizeof *pixels * PIXELS);
    options.lanes = lanes;
    scene.bvh = lanes == 1 ? bvh : NULL;
    if (lanes == 0)
        rt_render_pixels(plain_pixel, NULL, &options, &image);
    else
        rt_render(&scene, &camera, &options, &image);
    return image.rays;
}

/* The first number of lanes with other bits or other rays than the plain loop, or 0. */
static int wrong_lanes(void)
{
    static rt_vec3 expected[PIXELS], pixels[PIXELS];
    rt_bvh bvh;
    rt_build_bvh(&scene, &bvh);
    const uint64_t count = draw(0, NULL, expected);
    int lanes = 1;
    while (lanes != 0 && draw(lanes, &bvh, pixels) == count &&
           memcmp(pixels, expected, sizeof pixels) == 0)
        lanes = lanes == rt_lane_count(0) ? 0 : rt_lane_count(0);
    scene.bvh = NULL;
    rt_free_bvh(&bvh);
    rays += (double)count;
    return lanes;
}

/* ---- what differs ------------------------------------------------------------------- */

/* Leave out of an array of the scene what the difference does not need. */
static void reduce(void *array, size_t one, int *count, int lanes)
{
    for (int i = *count - 1; i >= 0; i--) {
        char *const at = (char *)array + (size_t)i * one, kept[sizeof(rt_box)];
        const size_t rest = (size_t)(--*count - i) * one;
        memcpy(kept, at, one);
        memmove(at, at + one, rest);
        if (wrong_lanes() != lanes) { /* put it back */
            memmove(at + one, at, rest);
            memcpy(at, kept, one);
            ++*count;
        }
    }
}

#define V "{%.8ef, %.8ef, %.8ef}"
#define XYZ(v) (double)(v).x, (double)(v).y, (double)(v).z

static void show_scene(int lanes)
{
    printf("/* seed %u, %d lanes, %d x %d pixels, samples from %d on */\n"
           "const rt_sphere spheres[] = {\n",
           options.seed, lanes, width, height, first_sample);
    for (const rt_sphere *s = spheres; s < spheres + scene.sphere_count; s++)
        printf("    {" V ", %.8ef, {" V ", %d}},\n", XYZ(s->center), (double)s->radius,
               XYZ(s->material.albedo), s->material.mirror);
    printf("};\nconst rt_box boxes[] = {\n");
    for (const rt_box *b = boxes; b < boxes + scene.box_count; b++)
        printf("    {" V ", " V ", {" V ", %d}},\n", XYZ(b->min), XYZ(b->max),
               XYZ(b->material.albedo), b->material.mirror);
    printf("};\nconst rt_light lights[] = {\n");
    for (const rt_light *l = lights; l < lights + scene.light_count; l++)
        printf("    {" V ", " V "},\n", XYZ(l->position), XYZ(l->intensity));
    printf("};\nconst rt_vec3 background = " V ";\n", XYZ(scene.background));
    printf("const rt_camera camera = {" V ", " V ", " V ", %.8ef};\n",
           XYZ(camera.position), XYZ(camera.direction), XYZ(camera.up),
           (double)camera.fov_y);
    printf("const rt_options options = {.samples = %d, .bounces = %d, .seed = %uu, "
           ".sampler = %d};\n",
           options.samples, options.bounces, options.seed, options.sampler);
}

int main(int argc, char **argv)
{
    const double seconds = argc > 1 ? atof(argv[1]) : 60, start = rt__seconds();
    uint32_t seed = rt_hash((uint32_t)time(NULL));
    int scenes = 0, found = 0;
    if (argc > 2)
        seed = (uint32_t)strtoul(argv[2], NULL, 10);
    do {
        make_scene(seed++);
        if (rt_check_scene(&scene, NULL) != RT_OK || rt_check_camera(&camera) != RT_OK)
            continue; /* numbers above 1e15 */
        const int lanes = wrong_lanes();
        scenes++;
        if (lanes != 0) {
            found++;
            reduce(spheres, sizeof *spheres, &scene.sphere_count, lanes);
            reduce(boxes, sizeof *boxes, &scene.box_count, lanes);
            reduce(lights, sizeof *lights, &scene.light_count, lanes);
            show_scene(lanes);
        }
    } while (rt__seconds() - start < seconds && found < 5);
    printf("%d scenes, %.3g rays, lanes 1", scenes, rays);
    if (rt_lane_count(0) > 1)
        printf(" %d", rt_lane_count(0));
    printf(": %d differ\n", found);
    return found != 0;
}

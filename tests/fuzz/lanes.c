/* Random scenes, made to be awkward: does rt_render draw, with a tree and with 4, 8 and 16
 * lanes, the bits that the plain loops of chapters 1 to 17 draw? Any compiler will do:
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
enum { MESHES = 20, FACES = 30, CORNERS = 60, OWN = 20, ALL = 2 * SHAPES + MESHES + OWN };
static rt_sphere spheres[SHAPES];
static rt_box boxes[SHAPES];
static rt_light lights[LIGHTS];
static rt_lamp lamps[LIGHTS];
static rt_vec3 positions[CORNERS];
static int indices[MESHES][3 * FACES];
static rt_mesh meshes[MESHES];
static rt_sphere own_balls[OWN]; /* of the shapes of one's own */
static rt_custom_shape own[OWN];
static rt_surface sphere_surfaces[SHAPES], box_surfaces[SHAPES];
static rt_surface mesh_surfaces[MESHES], own_surfaces[OWN];
static rt_scene scene = {.spheres = spheres,
                         .boxes = boxes,
                         .lights = lights,
                         .lamps = lamps,
                         .meshes = meshes,
                         .custom_shapes = own};
static rt_camera camera;
static rt_options options = {.threads = 1};
static int width, height, first_sample;
static int first_pixel, pixel_count; /* of the part that is drawn; 0, 0: all */
static bool with_surfaces, with_guides;

/* ---- numbers ------------------------------------------------------------------------ */

/* No expression asks for two random numbers, since the compiler would choose their order:
 * a seed makes the same scene with all compilers. */
static rt_rng rng;
static float unit;     /* of length */
static rt_vec3 middle; /* of the scene: far from (0,0,0) few digits are left */

/* The style of lengths: few different ones, so that things touch, coincide and line up;
 * nearly so; or any. */
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

/* Chapters 16 and 17: no meshes and own shapes, a few, or many. Each mesh has a relation to the
 * one before it, too; it is closed, or any triangles. */
static rt_material any_material(void)
{
    const float red = below(4) > 0 ? rt_random(&rng) : (float)below(2);
    const bool mirror = below(4) == 0;
    const rt_material material = {{red, 0.7f * red, below(5) > 0 ? red : 0}, mirror};
    return material;
}

static bool hit_own_ball(const void *data, const rt_ray *ray, float t_max, rt_hit *hit)
{
    const rt_sphere *sphere = (const rt_sphere *)data;
    if (!rt_hit_sphere(sphere, ray, t_max, hit))
        return false;
    hit->normal = rt_sub(hit->point, sphere->center);
    return true;
}

static void add_meshes(void)
{
    static const int tetrahedron[12] = {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2};
    const int most = below(3) > 0 ? 3 : MESHES;
    scene.mesh_count = below(3) > 0 ? below(most + 1) : 0;
    scene.custom_shape_count = below(3) > 0 ? below(most + 1) : 0;
    for (int i = 0; i < CORNERS; i++) {
        const rt_vec3 p = rt_add(middle, offset());
        positions[i] = below(4) > 0 || i == 0 ? p : positions[below(i)];
        positions[i].y = below(9) > 0 ? positions[i].y : middle.y;
    }
    for (int i = 0; i < scene.mesh_count; i++) {
        rt_mesh *m = &meshes[i];
        const int faces = 1 + below(below(4) > 0 ? 6 : FACES), copies = below(6);
        const bool closed = below(2) == 0;
        const int at = below(CORNERS - 3);
        const float half = size();
        const rt_vec3 p = positions[at];
        for (int k = 0; k < 4 && closed; k++)
            positions[at + k] =
                rt_add(p, rt_scale(rt_vec(k < 2 ? 1 : -1, k % 2 ? -1 : 1, k % 3 ? -1 : 1),
                                   half));
        for (int k = 0; k < 3 * FACES; k++)
            indices[i][k] = closed && k < 12 ? at + tetrahedron[k] : below(CORNERS);
        for (int k = 3; k < 3 * FACES && copies == 0; k++)
            indices[i][k] = indices[i][k - 3];
        m->positions = positions;
        m->indices = indices[i];
        m->position_count = CORNERS;
        m->triangle_count = closed ? 4 : faces;
        m->material = any_material();
    }
    for (int i = 0; i < scene.custom_shape_count; i++) {
        rt_sphere *ball = &own_balls[i];
        const rt_vec3 p = rt_add(middle, offset());
        ball->center = below(3) > 0 ? p : positions[below(CORNERS)];
        ball->radius = size();
        if (i > 0 && below(6) == 0)
            *ball = own_balls[i - 1];
        own[i].min = rt_sub(ball->center, all(ball->radius));
        own[i].max = rt_add(ball->center, all(ball->radius));
        own[i].material = any_material();
        own[i].hit = hit_own_ball;
        own[i].data = ball;
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
    } else if (scene.mesh_count > 0 && below(2) == 0) {
        p = positions[below(CORNERS)];
    }
    p.x = below(9) > 0 ? p.x : nudge(p.x);
    return p;
}

/* A pattern and a sky, which are not always what they should be. */
static rt_vec3 checked(const void *data, rt_vec3 point, rt_vec3 normal)
{
    const rt_vec3 p = rt_scale(point, 1 / *(const float *)data);
    const float sum = floorf(p.x) + floorf(p.y) + floorf(p.z);
    return rt_vec(fmodf(sum, 2), normal.x, sum > 9 ? NAN : 0.7f);
}

static rt_vec3 blue(const void *data, rt_vec3 direction)
{
    const float up = direction.y * *(const float *)data;
    return rt_vec(0.5f - up, up > 0.9f ? NAN : 0.5f, direction.z < 0 ? 1 : 0.9f * up);
}

static rt_surface surface(void)
{
    static const float etas[] = {1, 1.0001f, 1.33f, 1.5f, 4};
    rt_surface s;
    memset(&s, 0, sizeof s);
    const int what = below(8);
    if (what < 2)
        s.eta = below(3) > 0 ? etas[below(5)] : 1 + 3 * rt_random(&rng);
    if (what < 2 && below(2) == 0) {
        s.absorption = all(magnitude(1e-3f, 1e3f) / unit);
        s.absorption.y *= 0.1f * (float)below(2);
    }
    if (what > 0 && what < 5)
        s.shininess = below(5) > 0 ? magnitude(1, 1e4f) : magnitude(1e-6f, 1e6f);
    if (below(8) == 0)
        s.emission = rt_vec(rt_random(&rng), 0.5f, 0);
    if (below(6) == 0)
        s.pattern = checked;
    s.pattern_data = &unit;
    return s;
}

/* What chapters 11 to 17 add, or nothing. */
static void add_part_two(void)
{
    scene.lamp_count = 0;
    scene.sky = NULL;
    with_surfaces = false;
    options.lens.radius = options.lens.focus = 0;
    if (below(3) == 0)
        return;
    with_surfaces = below(4) > 0;
    for (int i = 0; i < SHAPES; i++) {
        sphere_surfaces[i] = surface();
        box_surfaces[i] = surface();
    }
    for (int i = 0; i < MESHES; i++)
        mesh_surfaces[i] = surface();
    for (int i = 0; i < OWN; i++)
        own_surfaces[i] = surface();
    if (below(4) > 0)
        scene.lamp_count = below(3) > 0 ? 1 : 1 + below(LIGHTS);
    for (int i = 0; i < LIGHTS; i++) {
        rt_lamp *l = &lamps[i];
        memset(l, 0, sizeof *l);
        l->center = place();
        l->intensity = all(fminf(unit * unit * magnitude(1, 1000), 1e12f));
        style = below(STYLES);
        if (below(3) > 0) {
            l->radius = fmaxf(size(), 1e-6f);
        } else {
            l->u = offset();
            l->v = offset();
        }
        if (below(9) == 0) /* far away */
            l->center = rt_scale(l->center, magnitude(1, 1e9f));
        if (below(4) == 0 && scene.sphere_count > 0) { /* it touches a sphere */
            const rt_sphere *s = &spheres[below(scene.sphere_count)];
            const float in =
                below(2) == 0 ? s->radius - l->radius : s->radius + l->radius;
            l->center = rt_add(s->center, rt_scale(direction(), in));
        }
    }
    if (below(3) == 0)
        scene.sky = blue;
    scene.sky_data = &unit;
    if (below(4) == 0) {
        options.lens.radius = below(9) > 0 ? 0.1f * size() : unit * magnitude(1, 1e9f);
        options.lens.focus = fmaxf(size(), 1e-9f);
    }
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
    if (below(6) == 0)
        scene.sphere_count = scene.box_count = 0;
    add_meshes();
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
    with_guides = below(4) == 0;
    add_part_two();
    if (below(20) == 0)
        options.bounces = RT_ALL_BOUNCES;
    first_pixel = pixel_count = 0;
    if (below(8) == 0) {
        first_pixel = below(width * height);
        pixel_count = 1 + below(width * height - first_pixel);
    }
}

/* ---- its pictures ------------------------------------------------------------------- */

static double rays; /* of all plain pictures */

static rt_vec3 plain_pixel(const void *context, float x, float y, rt_rng *numbers)
{
    (void)context;
    rt_ray ray = rt_camera_ray(&camera, width, height, x, y);
    if (options.lens.radius > 0) {
        const float r1 = rt_random(numbers);
        const float r2 = rt_random(numbers);
        ray = rt_lens_ray(&camera, &options.lens, &ray, r1, r2);
    }
    return scene.surfaces || scene.lamp_count > 0 || scene.sky
               ? rt_radiance_mis(&scene, &ray, options.bounces, numbers)
               : rt_radiance(&scene, &ray, options.bounces, numbers);
}

/* Of the four kinds of shapes. */
static rt_surface *const surfaces_of[4] = {sphere_surfaces, box_surfaces, mesh_surfaces,
                                           own_surfaces};

/* With 0 lanes: the plain loop. One lane gets a tree, packets make one for themselves. */
static uint64_t draw(int lanes, const rt_bvh *bvh, rt_vec3 *pixels, rt_guide *guides)
{
    static rt_surface surfaces[ALL];
    rt_surface *behind = surfaces;
    rt_image image = {.width = width,
                      .height = height,
                      .pixels = pixels,
                      .samples = first_sample,
                      .guides = with_guides && lanes > 0 ? guides : NULL,
                      .first = first_pixel,
                      .count = pixel_count};
    memset(pixels, 0, sizeof *pixels * PIXELS);
    memset(guides, 0, sizeof *guides * PIXELS);
    for (int k = 0; k < 4; k++) {
        const int count = k == 0   ? scene.sphere_count
                          : k == 1 ? scene.box_count
                          : k == 2 ? scene.mesh_count
                                   : scene.custom_shape_count;
        memcpy(behind, surfaces_of[k], sizeof *surfaces * (size_t)count);
        behind += count;
    }
    scene.surfaces = with_surfaces ? surfaces : NULL;
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
    static rt_guide expected_guides[PIXELS], guides[PIXELS];
    rt_bvh bvh;
    rt_build_bvh(&scene, &bvh);
    const uint64_t count = draw(0, NULL, expected, expected_guides);
    int lanes = 1;
    while (lanes != 0 && draw(lanes, &bvh, pixels, guides) == count &&
           memcmp(pixels, expected, sizeof pixels) == 0 &&
           (lanes == 1 || memcmp(guides, expected_guides, sizeof guides) == 0)) {
        if (lanes == 1) /* the plain loop has no guides */
            memcpy(expected_guides, guides, sizeof guides);
        lanes = lanes == rt_lane_count(0) ? 0 : rt_lane_count(0);
    }
    scene.bvh = NULL;
    rt_free_bvh(&bvh);
    rays += (double)count;
    return lanes;
}

/* ---- what differs ------------------------------------------------------------------- */

/* Take number i out of an array of so many, or put it back. */
static void take_out(void *array, size_t one, int i, int count, void *kept)
{
    char *const at = (char *)array + (size_t)i * one;
    memcpy(kept, at, one);
    memmove(at, at + one, (size_t)(count - 1 - i) * one);
}

static void put_back(void *array, size_t one, int i, int count, const void *kept)
{
    char *const at = (char *)array + (size_t)i * one;
    memmove(at + one, at, (size_t)(count - 1 - i) * one);
    memcpy(at, kept, one);
}

/* Leave out of an array of the scene, with its surfaces, what the difference does not
 * need. */
static void reduce(void *array, size_t one, rt_surface *surfaces, int *count, int lanes)
{
    char kept[sizeof(rt_box) + sizeof(rt_lamp) + sizeof(rt_custom_shape)];
    rt_surface kept_surface;
    for (int i = *count - 1; i >= 0; i--) {
        take_out(array, one, i, *count, kept);
        if (surfaces)
            take_out(surfaces, sizeof *surfaces, i, *count, &kept_surface);
        --*count;
        if (wrong_lanes() == lanes)
            continue;
        ++*count;
        put_back(array, one, i, *count, kept);
        if (surfaces)
            put_back(surfaces, sizeof *surfaces, i, *count, &kept_surface);
    }
}

/* And of all the rest: set to zero what may be zero. */
static void reduce_more(int lanes)
{
    const rt_options all_options = options;
    rt_sky_function *const sky = scene.sky;
    const bool surfaces = with_surfaces, guides = with_guides;
    options.lens.radius = 0;
    if (wrong_lanes() != lanes)
        options = all_options;
    scene.sky = NULL;
    if (wrong_lanes() != lanes)
        scene.sky = sky;
    with_surfaces = false;
    if (wrong_lanes() != lanes)
        with_surfaces = surfaces;
    with_guides = false;
    if (wrong_lanes() != lanes)
        with_guides = guides;
    const int counts[4] = {scene.sphere_count, scene.box_count, scene.mesh_count,
                           scene.custom_shape_count};
    for (int i = 0; with_surfaces && i < 4 * SHAPES; i++) {
        if (i % SHAPES >= counts[i / SHAPES])
            continue;
        rt_surface *s = &surfaces_of[i / SHAPES][i % SHAPES];
        for (int k = 0; k < 5; k++) {
            const rt_surface kept = *s;
            s->eta = k == 0 ? 0 : kept.eta;
            s->absorption = k == 1 ? all(0) : kept.absorption;
            s->shininess = k == 2 ? 0 : kept.shininess;
            s->emission = k == 3 ? all(0) : kept.emission;
            s->pattern = k == 4 ? NULL : kept.pattern;
            if (wrong_lanes() != lanes)
                *s = kept;
        }
    }
    for (int i = 0; i < scene.mesh_count; i++)
        reduce((void *)(uintptr_t)meshes[i].indices, 3 * sizeof **indices, NULL,
               &meshes[i].triangle_count, lanes);
    while (options.bounces > 0 && options.bounces < 100) {
        options.bounces--;
        if (wrong_lanes() != lanes) {
            options.bounces++;
            break;
        }
    }
}

#define V "{%.8ef, %.8ef, %.8ef}"
#define XYZ(v) (double)(v).x, (double)(v).y, (double)(v).z

static void show_surfaces(const rt_surface *surfaces, int count)
{
    for (const rt_surface *s = surfaces; with_surfaces && s < surfaces + count; s++)
        printf("    {%.8ef, " V ", %.8ef, " V ", %s, &unit},\n", (double)s->eta,
               XYZ(s->absorption), (double)s->shininess, XYZ(s->emission),
               s->pattern ? "checked" : "NULL");
}

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
    printf("};\nconst rt_vec3 positions[] = {\n");
    for (int i = 0; scene.mesh_count > 0 && i < CORNERS; i++)
        printf("    " V ",\n", XYZ(positions[i]));
    printf("};\n/* meshes: material, corners */\n");
    for (const rt_mesh *m = meshes; m < meshes + scene.mesh_count; m++) {
        printf("/* {" V ", %d}:", XYZ(m->material.albedo), m->material.mirror);
        for (int k = 0; k < 3 * m->triangle_count; k++)
            printf(" %d%s", m->indices[k], k % 3 == 2 ? "," : "");
        printf(" */\n");
    }
    printf("/* own shapes, balls of this centre and radius */\n");
    for (const rt_custom_shape *c = own; c < own + scene.custom_shape_count; c++) {
        const rt_sphere *s = (const rt_sphere *)c->data;
        printf("/* {" V ", %.8e}, {" V ", %d} */\n", XYZ(s->center), (double)s->radius,
               XYZ(c->material.albedo), c->material.mirror);
    }
    printf("const rt_light lights[] = {\n");
    for (const rt_light *l = lights; l < lights + scene.light_count; l++)
        printf("    {" V ", " V "},\n", XYZ(l->position), XYZ(l->intensity));
    printf("};\nconst rt_surface surfaces[] = {\n");
    show_surfaces(sphere_surfaces, scene.sphere_count);
    show_surfaces(box_surfaces, scene.box_count);
    show_surfaces(mesh_surfaces, scene.mesh_count);
    show_surfaces(own_surfaces, scene.custom_shape_count);
    printf("};\nconst rt_lamp lamps[] = {\n");
    for (const rt_lamp *l = lamps; l < lamps + scene.lamp_count; l++)
        printf("    {" V ", %.8ef, " V ", " V ", " V "},\n", XYZ(l->center),
               (double)l->radius, XYZ(l->intensity), XYZ(l->u), XYZ(l->v));
    printf("};\nconst rt_vec3 background = " V ";\n", XYZ(scene.background));
    printf("/* sky %d, guides %d, pixels %d + %d, unit %.8e */\n", scene.sky != NULL,
           with_guides, first_pixel, pixel_count, (double)unit);
    printf("const rt_camera camera = {" V ", " V ", " V ", %.8ef};\n",
           XYZ(camera.position), XYZ(camera.direction), XYZ(camera.up),
           (double)camera.fov_y);
    printf("const rt_options options = {.samples = %d, .bounces = %d, .seed = %uu, "
           ".sampler = %d, .lens = {%.8ef, %.8ef}};\n",
           options.samples, options.bounces, options.seed, options.sampler,
           (double)options.lens.radius, (double)options.lens.focus);
}

/* Not if a number is above 1e15, or a lamp has no size. */
static bool is_good(void)
{
    rt_vec3 pixel = {0, 0, 0};
    rt_image image = {.width = 1, .height = 1, .pixels = &pixel};
    rt_options one = options;
    one.samples = 1;
    one.bounces = 0;
    one.lanes = 1;
    return rt_render(&scene, &camera, &one, &image) == RT_OK;
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
        if (!is_good())
            continue;
        const int lanes = wrong_lanes();
        scenes++;
        if (lanes != 0) {
            found++;
            reduce(spheres, sizeof *spheres, sphere_surfaces, &scene.sphere_count, lanes);
            reduce(boxes, sizeof *boxes, box_surfaces, &scene.box_count, lanes);
            reduce(meshes, sizeof *meshes, mesh_surfaces, &scene.mesh_count, lanes);
            reduce(own, sizeof *own, own_surfaces, &scene.custom_shape_count, lanes);
            reduce(lights, sizeof *lights, NULL, &scene.light_count, lanes);
            reduce(lamps, sizeof *lamps, NULL, &scene.lamp_count, lanes);
            reduce_more(lanes);
            show_scene(lanes);
        }
    } while (rt__seconds() - start < seconds && found < 5);
    printf("%d scenes, %.3g rays, lanes 1", scenes, rays);
    if (rt_lane_count(0) > 1)
        printf(" %d", rt_lane_count(0));
    printf(": %d differ\n", found);
    return found != 0;
}

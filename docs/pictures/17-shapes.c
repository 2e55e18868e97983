/* Chapter 17: one of each of tests/shapes.h: a plane; a cone; a cylinder; a tilted box;
 * an egg; a ring; a ball and a cube: their difference, intersection and union.
 * Options: 720 360 --samples 64 */
#include "../../demos/shapes.h"
#include "../../tests/shapes.h"
#include "../../demos/demo.h"

static const plane table = {{0, 0, 0}, {0, 1, 0}};
static const cone tip = {{-6, 0, -3}, 1.4f, 3.4f};
static const cylinder pillar = {{-2.4f, 0, -4}, 1.2f, 2.6f};
static const ring doughnut = {{6.2f, 0.5f, -4.2f}, 1.5f, 0.5f};
static const field doughnut_field = {ring_distance, &doughnut};

/* Those in worlds of their own. */
static const rt_sphere ball = {{0, 0, 0}, 1, {{0, 0, 0}, false}};
static const rt_box cube = {
    {-0.8f, -0.8f, -0.8f}, {0.8f, 0.8f, 0.8f}, {{0, 0, 0}, false}};
static const cylinder drill = {{0, -2, 0}, 0.5f, 4};
static const rt_custom_shape own_ball = {
    {-1, -1, -1}, {1, 1, 1}, {{0, 0, 0}, false}, ball_hit, &ball};
static const rt_custom_shape own_cube = {
    {-0.8f, -0.8f, -0.8f}, {0.8f, 0.8f, 0.8f}, {{0, 0, 0}, false}, cube_hit, &cube};
static const rt_custom_shape own_drill = {
    {-0.5f, -2, -0.5f}, {0.5f, 2, 0.5f}, {{0, 0, 0}, false}, cylinder_hit, &drill};
static const pair pairs[3] = {{A_WITHOUT_B, &own_ball, &own_drill},
                              {A_AND_B, &own_ball, &own_cube},
                              {A_OR_B, &own_ball, &own_cube}};
static rt_custom_shape own_pairs[3];

static turned placed[5]; /* box, egg, pairs */
static rt_custom_shape shapes[9];
static const rt_lamp lamp = {
    .center = {-9, 16, 10}, .radius = 2.5f, .intensity = {620, 590, 540}};
static rt_scene scene = {.lamps = &lamp,
                         .lamp_count = 1,
                         .background = {0.24f, 0.29f, 0.37f},
                         .custom_shapes = shapes};
static const rt_camera camera = {{0.3f, 7, 16}, {0, -6.1f, -16}, {0, 1, 0}, 25};

static void add(rt_vec3 middle, rt_vec3 half, rt_vec3 albedo, rt_hit_function *hit,
                const void *data)
{
    rt_custom_shape *s = &shapes[scene.custom_shape_count++];
    s->min = rt_sub(middle, half);
    s->max = rt_add(middle, half);
    s->material.albedo = albedo;
    s->hit = hit;
    s->data = data;
}

/* A world of its own, turned so that its z points there, and scaled to this size. */
static void place(turned *t, rt_vec3 middle, rt_vec3 z, rt_vec3 size,
                  const rt_custom_shape *shape, rt_vec3 albedo)
{
    const float most = 1.8f * fmaxf(size.x, fmaxf(size.y, size.z));
    t->middle = middle;
    t->z = rt_normalize(z);
    rt_basis(t->z, &t->x, &t->y);
    t->x = rt_scale(t->x, size.x);
    t->y = rt_scale(t->y, size.y);
    t->z = rt_scale(t->z, size.z);
    t->shape = shape;
    add(middle, rt_vec(most, most, most), albedo, turned_hit, t);
}

static void prepare(void)
{
    for (int i = 0; i < 3; i++)
        own_pairs[i] = (rt_custom_shape){
            {-1, -1, -1}, {1, 1, 1}, {{0, 0, 0}, false}, pair_hit, &pairs[i]};
    add(rt_vec(0, 0, 0), rt_vec(30, 0.1f, 30), rt_vec(0.7f, 0.7f, 0.68f), plane_hit,
        &table);
    add(rt_vec(-6, 1.7f, -3), rt_vec(1.4f, 1.7f, 1.4f), rt_vec(0.85f, 0.25f, 0.1f),
        cone_hit, &tip);
    add(rt_vec(-2.4f, 1.3f, -4), rt_vec(1.2f, 1.3f, 1.2f), rt_vec(0.2f, 0.55f, 0.25f),
        cylinder_hit, &pillar);
    add(rt_vec(6.2f, 0.5f, -4.2f), rt_vec(2, 0.5f, 2), rt_vec(0.6f, 0.2f, 0.55f),
        field_hit, &doughnut_field);
    place(&placed[0], rt_vec(2, 1.45f, -3.6f), rt_vec(1, 1, 1), rt_vec(1.2f, 1.2f, 1.2f),
          &own_cube, rt_vec(0.9f, 0.7f, 0.1f));
    place(&placed[1], rt_vec(-4.4f, 0.85f, 0.8f), rt_vec(3, 0.3f, 1),
          rt_vec(0.85f, 0.85f, 1.35f), &own_ball, rt_vec(0.85f, 0.8f, 0.7f));
    place(&placed[2], rt_vec(-1, 1.2f, 1.5f), rt_vec(1, 1, -0.5f),
          rt_vec(1.2f, 1.2f, 1.2f), &own_pairs[0], rt_vec(0.15f, 0.4f, 0.75f));
    place(&placed[3], rt_vec(2.2f, 0.97f, 1.4f), rt_vec(0.4f, 0, 1),
          rt_vec(1.2f, 1.2f, 1.2f), &own_pairs[1], rt_vec(0.15f, 0.4f, 0.75f));
    place(&placed[4], rt_vec(5.1f, 1.0f, 1.2f), rt_vec(-0.5f, 0, 1),
          rt_vec(1.2f, 1.2f, 1.2f), &own_pairs[2], rt_vec(0.15f, 0.4f, 0.75f));
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene, &camera, options, image);
}

int main(int argc, char **argv)
{
    prepare();
    return demo_main(argc, argv,
                     &(demo){.name = "shapes",
                             .title = "Your own shapes",
                             .render = render,
                             .encode = demo_gamma,
                             .samples = 64,
                             .bounces = 4,
                             .sobol = true});
}

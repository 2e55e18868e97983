/* A scene of those that are asked ("scene 96601"), rendered by rt.h on the left and by the
 * student's routines on the right; its shapes, as C:
 *
 *     cc -DNUMBER=96601 -DSUBMISSION='"yours.h"' -c -o theirs.o show_scene.c
 *     cc -DNUMBER=96601 show_scene.c theirs.o submission.o program.a
 */
#ifdef SUBMISSION
#include SUBMISSION
#endif

#include "routines.h"

#include "../../demos/demo.h"

rt_vec3 radiance_by_theirs(const rt_scene *scene, const rt_ray *ray, int bounces,
                           rt_rng *rng);

#ifdef SUBMISSION
rt_vec3 radiance_by_theirs(const rt_scene *scene, const rt_ray *ray, int bounces,
                           rt_rng *rng)
{
    return rt_radiance(scene, ray, bounces, rng);
}
#else
static const rt_camera camera = {{0, 3, 17}, {0, -0.2f, -1}, {0, 1, 0}, 46};
static world shown;

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const float half = 0.5f * (float)view->width;
    const bool theirs = x >= half;
    const rt_ray ray =
        rt_camera_ray(&camera, view->width / 2, view->height, theirs ? x - half : x, y);
    return (theirs ? radiance_by_theirs : rt_radiance)(&shown.scene, &ray, view->bounces,
                                                       rng);
}

static void print_vec(const char *before, rt_vec3 v, const char *after)
{
    printf("%s{%.9g, %.9g, %.9g}%s", before, (double)v.x, (double)v.y, (double)v.z,
           after);
}

static void print_material(const rt_material *m)
{
    print_vec("{", m->albedo, m->mirror ? ", true}},\n" : ", false}},\n");
}

static void print_shapes(void)
{
    printf("const rt_sphere spheres[] = {\n");
    for (int i = 0; i < SPHERES; i++) {
        print_vec("    {", shown.spheres[i].center, "");
        printf(", %.9g, ", (double)shown.spheres[i].radius);
        print_material(&shown.spheres[i].material);
    }
    printf("};\nconst rt_box boxes[] = {\n");
    for (int i = 0; i < BOXES; i++) {
        print_vec("    {", shown.boxes[i].min, ", ");
        print_vec("", shown.boxes[i].max, ", ");
        print_material(&shown.boxes[i].material);
    }
    printf("};\nconst rt_light lights[] = {\n");
    for (int i = 0; i < LIGHTS; i++) {
        print_vec("    {", shown.lights[i].position, ", ");
        print_vec("", shown.lights[i].intensity, "},\n");
    }
    print_vec("};\nconst rt_vec3 background = ", shown.scene.background, ";\n");
    fflush(stdout);
}

int main(int argc, char **argv)
{
    make_world(&shown, NUMBER);
    print_shapes();
    return demo_main(argc, argv,
                     &(demo){.name = "scene",
                             .title = "By rt.h, and by yours",
                             .pixel = pixel,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 2});
}
#endif

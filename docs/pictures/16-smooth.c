/* Chapter 16, smooth normals: a ball of 80 triangles as it is; with normals that pretend
 * it is round; and the same with 5120.
 * Options: 720 240 --samples 16 */
#include "../../tests/meshes.h"
#include "../../demos/demo.h"

static rt_mesh meshes[3];
static rt_bvh trees[3];
static rt_scene scenes[3];

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const float side = (float)view->width / 3;
    const int ball = x < side ? 0 : x < 2 * side ? 1 : 2;
    const rt_camera camera = {{0, 0, 4}, {0, 0, -1}, {0, 1, 0}, 34};
    const rt_ray ray =
        rt_camera_ray(&camera, (int)side, view->height, x - side * (float)ball, y);
    const rt_light light = {{60, 20, 12}, {12000, 12000, 12000}};
    rt_hit hit;
    rng->rays++;
    if (!rt_intersect(&scenes[ball], &ray, &hit))
        return rt_vec(0.10f, 0.12f, 0.15f);
    const float u = hit.u, v = hit.v;
    const rt_vec3 a = rt_corner(&meshes[ball], hit.part, 0); /* the normal there, too */
    const rt_vec3 b = rt_corner(&meshes[ball], hit.part, 1);
    const rt_vec3 c = rt_corner(&meshes[ball], hit.part, 2);
    const rt_vec3 smooth = rt_normalize(
        rt_add(rt_scale(a, 1 - u - v), rt_add(rt_scale(b, u), rt_scale(c, v))));
    rng->rays++;
    if (!rt_visible(&scenes[ball], hit.point, hit.normal, light.position))
        return rt_vec(0, 0, 0);
    return rt_lambert(rt_vec(0.8f, 0.8f, 0.8f), ball == 0 ? hit.normal : smooth,
                      rt_sub(light.position, hit.point), light.intensity);
}

int main(int argc, char **argv)
{
    for (int i = 0; i < 3; i++) {
        meshes[i] = make_icosphere(i < 2 ? 1 : 4);
        scenes[i].meshes = &meshes[i];
        scenes[i].mesh_count = 1;
        if (rt_build_bvh(&scenes[i], &trees[i]) != RT_OK)
            return 1;
        scenes[i].bvh = &trees[i];
    }
    const int status = demo_main(argc, argv,
                                 &(demo){.name = "smooth",
                                         .title = "Smooth normals",
                                         .pixel = pixel,
                                         .encode = demo_gamma,
                                         .samples = 16});
    for (int i = 0; i < 3; i++) {
        rt_free_bvh(&trees[i]);
        free_mesh(&meshes[i]);
    }
    return status;
}

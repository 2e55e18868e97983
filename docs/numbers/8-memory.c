/* Chapter 8: how many bytes of the tree each shape takes. */
#define RT_IMPLEMENTATION
#include "tests/meshes.h"

static double bytes(const rt_scene *scene, int shapes)
{
    rt_bvh bvh;
    if (rt_build_bvh(scene, &bvh) != RT_OK)
        exit(1);
    const double size = (double)bvh.node_count * (double)sizeof(rt_bvh_node) +
                        (double)bvh.row_count * (double)sizeof(rt_bvh_row);
    rt_free_bvh(&bvh);
    return size / shapes;
}

int main(void)
{
    enum { COUNT = 1000000 };
    rt_sphere *spheres = need(calloc(COUNT, sizeof *spheres));
    rt_rng rng = rt_rng_start(0, 0, 0);
    for (int k = 0; k < COUNT; k++) {
        const float x = rt_random(&rng), y = rt_random(&rng), z = rt_random(&rng);
        spheres[k].center = rt_vec(x, y, z);
        spheres[k].radius = 0.3f / cbrtf(COUNT);
    }
    const rt_scene many = {.spheres = spheres, .sphere_count = COUNT};
    printf("sphere: %.0f\n", bytes(&many, COUNT));
    rt_mesh mesh = make_landscape(500);
    const rt_scene land = {.meshes = &mesh, .mesh_count = 1};
    printf("triangle: %.0f\n", bytes(&land, mesh.triangle_count));
    free_mesh(&mesh);
    free(spheres);
}

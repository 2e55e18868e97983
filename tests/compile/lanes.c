/* A build without -ffp-contract=off: packets still give the bits of single rays. */
#define RT_IMPLEMENTATION
#include "../../rt.h"

enum { N = 32 * 24 };

int main(void)
{
    static rt_vec3 one[N], many[N];
    const rt_sphere spheres[] = {
        {{0, 0, -5}, 1, {{0.85f, 0.10f, 0.08f}, false}},
        {{0, -101, -5}, 100, {{0.80f, 0.80f, 0.80f}, false}},
    };
    const rt_light light = {{3, 4, -2}, {150, 150, 150}};
    rt_scene scene;
    rt_camera camera;
    rt_options options;
    rt_image image;
    memset(&scene, 0, sizeof scene);
    memset(&camera, 0, sizeof camera);
    memset(&options, 0, sizeof options);
    scene.spheres = spheres;
    scene.sphere_count = 2;
    scene.lights = &light;
    scene.light_count = 1;
    options.bounces = 5;
    const int most = rt_lane_count(0);
    for (int lanes = 1; lanes != 0; lanes = lanes < most ? most : 0) {
        memset(&image, 0, sizeof image);
        image.width = 32;
        image.height = 24;
        image.pixels = lanes == 1 ? one : many;
        options.lanes = lanes;
        if (rt_render(&scene, &camera, &options, &image) != RT_OK)
            return 1;
        if (lanes > 1 && memcmp(one, many, sizeof one) != 0)
            return lanes;
    }
    return 0;
}

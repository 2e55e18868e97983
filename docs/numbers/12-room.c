/* Chapter 12: the room of demo 12. How much of its light comes from the lamp to a matt surface by
 * way of glass or a mirror, which was missing before; and how the noise depends on the size of the
 * lamp. */
#define RT_IMPLEMENTATION
#include "demos/scene.h"
#include <stdio.h>

enum { W = 64, H = 48, SAMPLES = 256 };
static rt_vec3 pixels[W * H], half[W * H];

static rt_image render(const rt_scene *scene, int samples)
{
    rt_image image = {.width = W, .height = H, .pixels = pixels, .half = half};
    const rt_options options = {.samples = samples, .bounces = 8};
    rt_render(scene, &room_camera, &options, &image);
    return image;
}

int main(void)
{
    /* Of what the pixels get: paths that end at the lamp by no choice, after a matt surface. */
    const rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 64, .bounces = 8};
    rt_vertex vertices[16];
    double by_glass = 0, by_mirror = 0, sum = 0;
    for (int y = 0; y < H; y++)
        for (int x = 0; x < W; x++)
            for (int k = 0; k < 64; k++) {
                rt_path path = {.vertices = vertices, .max_vertices = 16};
                rt_trace_pixel(&scene_lamps, &room_camera, &options, &image, x, y, k,
                               &path);
                bool matt = false, glass = false, mirror = false;
                for (int n = 0; n < path.vertex_count; n++) {
                    const rt_vertex *v = &vertices[n];
                    const rt_vec3 adds = rt_mul(v->throughput, v->light);
                    const double light = (double)(adds.x + adds.y + adds.z);
                    if (v->lamp < 0 || matt)
                        sum += light; /* but for the lamp itself, and its images */
                    if (v->lamp >= 0 && matt && glass)
                        by_glass += light;
                    else if (v->lamp >= 0 && matt && mirror)
                        by_mirror += light;
                    if (v->event == RT_EVENT_MATT) {
                        matt = true;
                        glass = mirror = false;
                    }
                    glass |=
                        v->event == RT_EVENT_REFRACTED || v->event == RT_EVENT_REFLECTED;
                    mirror |= v->event == RT_EVENT_MIRROR;
                }
            }
    printf("by-glass: %.1f\nby-mirror: %.1f\n", 100 * by_glass / sum,
           100 * by_mirror / sum);

    const float radii[] = {9, 6, 3, 1};
    printf("| radius of the lamp |");
    for (int i = 0; i < 4; i++)
        printf(" %g |", (double)radii[i]);
    printf("\n|---|---|---|---|---|\n| error |");
    for (int i = 0; i < 4; i++) {
        rt_lamp lamp = room_lamp;
        lamp.radius = radii[i];
        rt_scene scene = scene_lamps;
        scene.lamps = &lamp;
        /* the lamp itself is so bright that the mean would be that of its disc */
        const rt_image made = render(&scene, SAMPLES);
        double squares = 0, light = 0;
        int count = 0;
        for (int p = 0; p < W * H; p++) {
            const rt_ray ray = rt_camera_ray(&room_camera, W, H, (float)(p % W) + 0.5f,
                                             (float)(p / W) + 0.5f);
            rt_hit hit;
            if (!rt_intersect(&scene, &ray, &hit) || hit.shape == ROOM_MIRROR ||
                hit.shape >= ROOM_GLASS || rt_meet_lamp(&room_lamp, &ray, FLT_MAX) > 0)
                continue;
            const rt_vec3 d = rt_sub(made.half[p], made.pixels[p]);
            squares += (double)rt_dot(d, d) / 3;
            light += (double)(made.pixels[p].x + made.pixels[p].y + made.pixels[p].z) / 3;
            count++;
        }
        const double error = 100 * sqrt(squares / count) / (light / count);
        printf(" %.*f %% |", 0, error);
    }
    printf("\n");
}

/* What happens in one pixel, in words: the paths of its samples, as rt_trace_pixel writes them
 * down. For demos 7 to 9, whose pixels are rt_radiance's. */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "scene.h"
#include <stdio.h>

static const char *shape_name(int shape)
{
    static const char *const names[] = {
        "nothing",   "the red sphere", "the left wall", "the ceiling", "the right wall",
        "the floor", "the back wall",  "the mirror",    "the cube",
    };
    return names[shape + 1];
}

static void print_vec(const char *before, rt_vec3 v, const char *after)
{
    printf("%s(%.6g, %.6g, %.6g)%s", before, (double)v.x, (double)v.y, (double)v.z,
           after);
}

static void print_vertex(const rt_path *path, int n)
{
    const rt_vertex *v = &path->vertices[n];
    printf("  +- %s %s", n == 0 ? "camera ray meets" : "goes on to",
           shape_name(v->shape));
    if (v->shape < 0) {
        print_vec(", background ", v->light, "");
    } else {
        printf(" at t = %.6g\n", (double)v->hit.t);
        print_vec("  |    P ", v->hit.point, "");
        print_vec(", N ", v->hit.normal, "");
    }
    print_vec("\n  |    throughput ", v->throughput, "\n");
    bool asked = false;
    for (int i = 0; i < path->shadow_count; i++) {
        const rt_shadow *s = &path->shadows[i];
        if (s->vertex != n)
            continue;
        asked = true;
        printf("  |    lamp: cosine %.6g, d^2 %.6g, ", (double)s->cosine, (double)s->dd);
        if (s->blocker < 0)
            print_vec("seen, sends ", s->light_sent, "\n");
        else
            printf("hidden by %s, %.0f %% of the way\n", shape_name(s->blocker),
                   100.0 * (double)s->t);
    }
    if (!asked && v->shape >= 0)
        printf("  |    %s\n", v->hit.material->mirror
                                  ? "a mirror: the light comes from where it points"
                                  : "lamp: behind the surface");
    print_vec("  |    adds ", rt_mul(v->throughput, v->light), "\n");
}

static rt_status explain_indirect(const rt_options *options, const rt_image *image, int x,
                                  int y)
{
    enum { MOST = 100 };
    static rt_vertex vertices[MOST];
    static rt_shadow shadows[MOST];
    rt_path path = {.vertices = vertices,
                    .max_vertices = MOST,
                    .shadows = shadows,
                    .max_shadows = MOST};
    rt_vec3 mean = {0, 0, 0};
    for (int k = 0; k < options->samples; k++) {
        const rt_status status =
            rt_trace_pixel(&scene_indirect, &room_camera, options, image, x, y, k, &path);
        if (status != RT_OK)
            return status;
        printf("sample %d\n", k);
        for (int n = 0; n < path.vertex_count && n < MOST; n++)
            print_vertex(&path, n);
        if (path.vertex_count > MOST)
            printf("  +- and %d more\n", path.vertex_count - MOST);
        print_vec("  = ", path.value, "\n");
        mean = rt_add(mean, rt_scale(rt_sub(path.value, mean), 1.0f / (float)(k + 1)));
    }
    print_vec("mean: ", mean, "");
    printf(", as bytes %d, %d, %d\n", rt_encode(mean.x, 2.2), rt_encode(mean.y, 2.2),
           rt_encode(mean.z, 2.2));
    return RT_OK;
}

#endif

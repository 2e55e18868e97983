/* What happens in one pixel, in words: the paths of its samples, as rt_trace_pixel writes them
 * down. For demos 7 to 9, whose pixels are rt_radiance's. */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "scene.h"
#include "text.h"

static const char *shape_name(int shape)
{
    static const char *const names[] = {
        "nothing",   "the red sphere", "the left wall", "the ceiling", "the right wall",
        "the floor", "the back wall",  "the mirror",    "the cube",
    };
    return names[shape + 1];
}

static void print_vec(demo_text *out, const char *before, rt_vec3 v, const char *after)
{
    text_add(out, "%s(%.6g, %.6g, %.6g)%s", before, (double)v.x, (double)v.y, (double)v.z,
             after);
}

static void print_vertex(demo_text *out, const rt_path *path, int n)
{
    const rt_vertex *v = &path->vertices[n];
    text_add(out, "  +- %s %s", n == 0 ? "camera ray meets" : "goes on to",
             shape_name(v->shape));
    if (v->shape < 0) {
        print_vec(out, ", background ", v->light, "");
    } else {
        text_add(out, " at t = %.6g\n", (double)v->hit.t);
        print_vec(out, "  |    P ", v->hit.point, "");
        print_vec(out, ", N ", v->hit.normal, "");
    }
    print_vec(out, "\n  |    throughput ", v->throughput, "\n");
    bool asked = false;
    for (int i = 0; i < path->shadow_count; i++) {
        const rt_shadow *s = &path->shadows[i];
        if (s->vertex != n)
            continue;
        asked = true;
        text_add(out, "  |    lamp: cosine %.6g, d^2 %.6g, ", (double)s->cosine,
                 (double)s->dd);
        if (s->blocker < 0)
            print_vec(out, "seen, sends ", s->light_sent, "\n");
        else
            text_add(out, "hidden by %s, %.0f %% of the way\n", shape_name(s->blocker),
                     100.0 * (double)s->t);
    }
    if (!asked && v->shape >= 0)
        text_add(out, "  |    %s\n",
                 v->hit.material->mirror
                     ? "a mirror: the light comes from where it points"
                     : "lamp: behind the surface");
    print_vec(out, "  |    adds ", rt_mul(v->throughput, v->light), "\n");
}

/* One sample, as rt_trace_pixel has written it down. */
static void print_path(demo_text *out, const rt_path *path, int sample)
{
    text_add(out, "sample %d\n", sample);
    for (int n = 0; n < path->vertex_count && n < path->max_vertices; n++)
        print_vertex(out, path, n);
    if (path->vertex_count > path->max_vertices)
        text_add(out, "  +- and %d more\n", path->vertex_count - path->max_vertices);
    print_vec(out, "  = ", path->value, "\n");
}

/* A path of up to MOST_VERTICES, with memory of its own: one at a time. */
enum { MOST_VERTICES = 100 };
static rt_path empty_path(void)
{
    static rt_vertex vertices[MOST_VERTICES];
    static rt_shadow shadows[MOST_VERTICES];
    return (rt_path){.vertices = vertices,
                     .max_vertices = MOST_VERTICES,
                     .shadows = shadows,
                     .max_shadows = MOST_VERTICES};
}

enum { MOST_WORDS = 1 << 16 }; /* of one path */

static inline rt_status explain_indirect(const rt_options *options, const rt_image *image,
                                         int x, int y)
{
    static char words[MOST_WORDS];
    rt_path path = empty_path();
    rt_vec3 mean = {0, 0, 0};
    demo_text out;
    for (int k = 0; k < options->samples; k++) {
        const rt_status status =
            rt_trace_pixel(&scene_indirect, &room_camera, options, image, x, y, k, &path);
        if (status != RT_OK)
            return status;
        out = text_in(words, sizeof words);
        print_path(&out, &path, k);
        printf("%s", words);
        mean = rt_add(mean, rt_scale(rt_sub(path.value, mean), 1.0f / (float)(k + 1)));
    }
    out = text_in(words, sizeof words);
    print_vec(&out, "mean: ", mean, "");
    printf("%s, as bytes %d, %d, %d\n", words, rt_encode(mean.x, 2.2),
           rt_encode(mean.y, 2.2), rt_encode(mean.z, 2.2));
    return RT_OK;
}

#endif

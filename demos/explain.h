/* What happens in one sample of a pixel, in words. */
#ifndef EXPLAIN_H
#define EXPLAIN_H

#include "scene.h"
#include "text.h"

/* The first pictures stop before the chapters that bring these: */
enum { STAGE_LIGHT = 2, STAGE_SHADOWS = 4 };

/* What is told of a sample. */
typedef struct explanation {
    const rt_scene *scene;
    int stage;
    rt_path path; /* its value is that of the sample, as it is shown */
    rt_vec3 rest; /* the part of it that no point of the path adds: see find_rest */
} explanation;

/* What a path says adds up to its value. Something is left if the path has more points than there
 * is memory for, or if a function of the reader's own does what rt.h does not see. (Less than
 * 1e-5 of it is rounding; NaN is not.) */
static inline void find_rest(explanation *e)
{
    const rt_path *path = &e->path;
    rt_vec3 sum = {0, 0, 0};
    for (int n = 0; n < path->vertex_count && n < path->max_vertices; n++)
        sum = rt_add(sum, rt_mul(path->vertices[n].throughput, path->vertices[n].light));
    e->rest = rt_sub(path->value, sum);
    if (rt_length(e->rest) <= 1e-5f * (rt_length(sum) + rt_length(path->value)))
        e->rest = rt_vec(0, 0, 0);
}

/* Spheres come first, then the cube, the mesh, the pedestal, whichever of them there are. */
static const char *shape_name(const rt_scene *scene, int shape)
{
    static const char *const names[] = {
        "nothing",       "the red sphere", "the left wall",
        "the ceiling",   "the right wall", "the floor",
        "the back wall", "the mirror",     "the glass ball",
    };
    const int other = shape - scene->sphere_count;
    return other < 0                                      ? names[shape + 1]
           : other < scene->box_count                     ? "the cube"
           : other < scene->box_count + scene->mesh_count ? room_model.name
                                                          : "the pedestal";
}

/* How the path goes on, from glass also on which side of it. */
static const char *event_name(const rt_vertex *v)
{
    switch (v->event) {
    case RT_EVENT_MATT: return "matt";
    case RT_EVENT_GLOSS: return "gloss";
    case RT_EVENT_MIRROR: return "mirror";
    case RT_EVENT_REFLECTED: return v->inside ? "reflected inside" : "reflected";
    case RT_EVENT_REFRACTED: return v->inside ? "refracted, out" : "refracted, in";
    case RT_EVENT_LAMP: return "lamp";
    default: return "gone";
    }
}

static void print_vec(demo_text *out, const char *before, rt_vec3 v, const char *after)
{
    text_add(out, "%s(%.6g, %.6g, %.6g)%s", before, (double)v.x, (double)v.y, (double)v.z,
             after);
}

static bool is_mesh(const rt_scene *scene, const rt_vertex *v)
{
    const int mesh = v->shape - scene->sphere_count - scene->box_count;
    return mesh >= 0 && mesh < scene->mesh_count;
}

/* Where on it, if it is a mesh: the triangle and the parts of its corners. */
static void print_place(demo_text *out, const rt_scene *scene, const rt_vertex *v)
{
    if (is_mesh(scene, v))
        text_add(out, "triangle %d, u %.3f, v %.3f", v->hit.part, (double)v->hit.u,
                 (double)v->hit.v);
}

/* What came of the question for a light. */
static void print_shadow(demo_text *out, const explanation *e, const rt_shadow *s)
{
    text_add(out, "  |    lamp: cosine %.6g, d^2 %.6g, ", (double)s->cosine,
             (double)s->dd);
    if (s->blocker >= 0) {
        text_add(out, "hidden by %s, %.0f %% of the way\n",
                 shape_name(e->scene, s->blocker), 100.0 * (double)s->t);
        return;
    }
    if (s->lamp >= 0)
        text_add(out, "aimed at, weight %.3f, ", (double)s->weight);
    print_vec(out, e->stage < STAGE_SHADOWS ? "sends " : "seen, sends ", s->light_sent,
              e->stage < STAGE_SHADOWS ? ", whatever is in the way\n" : "\n");
}

/* Nobody has asked for a light at this point. Is that because all are behind the surface? */
static bool lights_are_behind(const explanation *e, const rt_vertex *v)
{
    if (e->stage < STAGE_LIGHT || !rt_is_zero(v->light))
        return false;
    for (int i = 0; i < e->scene->light_count; i++)
        if (rt_dot(v->hit.normal, rt_sub(e->scene->lights[i].position, v->hit.point)) >
            0.0f)
            return false;
    return true;
}

static void print_vertex(demo_text *out, const explanation *e, int n)
{
    const rt_scene *scene = e->scene;
    const rt_path *path = &e->path;
    const rt_vertex *v = &path->vertices[n];
    const bool lamp = v->event == RT_EVENT_LAMP;
    text_add(out, "  +- %s %s", n == 0 ? "camera ray meets" : "goes on to",
             lamp ? "the lamp" : shape_name(scene, v->shape));
    if (lamp) {
        if (n > 0)
            text_add(out, ", by chance, weight %.3f", (double)v->weight);
        print_vec(out, ", sends ", v->light, "");
    } else if (v->shape < 0) {
        print_vec(out, scene->sky ? ", sky " : ", background ", v->light, "");
    } else {
        text_add(out, is_mesh(scene, v) ? ", " : "");
        print_place(out, scene, v);
        text_add(out, " at t = %.6g\n", (double)v->hit.t);
        print_vec(out, "  |    P ", v->hit.point, "");
        print_vec(out, ", N ", v->hit.normal, "");
    }
    print_vec(out, "\n  |    throughput ", v->throughput, "\n");
    bool asked = false;
    for (int i = 0; i < path->shadow_count && i < path->max_shadows; i++)
        if (path->shadows[i].vertex == n) {
            asked = true;
            print_shadow(out, e, &path->shadows[i]);
        }
    if (v->shape >= 0 && v->event == RT_EVENT_MIRROR)
        text_add(out, "  |    a mirror: the light comes from where it points\n");
    else if (v->shape >= 0 &&
             (v->event == RT_EVENT_REFLECTED || v->event == RT_EVENT_REFRACTED))
        text_add(out, "  |    glass: %s\n", event_name(v));
    else if (v->shape >= 0 && e->stage < STAGE_LIGHT)
        text_add(out, "  |    its colour as it is: there is no lamp yet\n");
    else if (v->shape >= 0 && !asked && lights_are_behind(e, v))
        text_add(out, "  |    lamp: behind the surface\n");
    if (v->density > 0.0f)
        text_add(out, "  |    goes on by %s, density %.6g\n",
                 v->event == RT_EVENT_GLOSS ? "the gloss" : "the matt body",
                 (double)v->density);
    print_vec(out, "  |    adds ", rt_mul(v->throughput, v->light), "\n");
}

static inline void print_sample(demo_text *out, const explanation *e, int number)
{
    const rt_path *path = &e->path;
    const int more = path->vertex_count - path->max_vertices;
    text_add(out, "sample %d\n", number);
    for (int n = 0; n < path->vertex_count && n < path->max_vertices; n++)
        print_vertex(out, e, n);
    if (more > 0)
        text_add(out, "  +- and %d more\n", more);
    if (!rt_is_zero(e->rest))
        print_vec(out, more > 0 ? "  |    adds " : "  +- a function of your own adds ",
                  e->rest, "\n");
    print_vec(out, "  = ", path->value, "\n");
}

/* A path of up to MOST_VERTICES, with memory of its own: one at a time. */
enum { MOST_VERTICES = 100 };
static inline rt_path empty_path(void)
{
    static rt_vertex vertices[MOST_VERTICES];
    static rt_shadow shadows[MOST_VERTICES];
    return (rt_path){.vertices = vertices,
                     .max_vertices = MOST_VERTICES,
                     .shadows = shadows,
                     .max_shadows = MOST_VERTICES};
}

enum { MOST_WORDS = 1 << 16 }; /* of one path */

#endif

/* A wall of triangles by the student's rt_hit_triangle, in which every eighth row and column of
 * rays, and a diagonal, run along edges: cc -DSUBMISSION='"file.c"' show_edges.c program.a. What
 * gets through is red. */
#include SUBMISSION

#include "../../demos/demo.h"

enum { CELLS = 16, RAYS = 8 * CELLS }; /* along one side */

static rt_vec3 positions[(CELLS + 1) * (CELLS + 1)];
static int indices[6 * CELLS * CELLS];
static rt_mesh wall = {positions,
                       indices,
                       (CELLS + 1) * (CELLS + 1),
                       2 * CELLS *CELLS,
                       {{0.8f, 0.8f, 0.8f}, false}};

/* Where the ray of this column or row meets the plane at distance 1: -1/2 to 1/2. */
static float film(int ray)
{
    return ((float)ray - 4 * CELLS) / RAYS;
}

/* The corners lie on rays, every one at another distance: in the left half they are rounded, so
 * that rays pass within a rounding of edges, in the right half not, and rays go exactly along. */
static void make_wall(void)
{
    for (int y = 0; y <= CELLS; y++)
        for (int x = 0; x <= CELLS; x++) {
            const uint32_t any = rt_hash((uint32_t)(x + 100 * y));
            const float far = x < CELLS / 2 ? 8 + (float)(any >> 10) / 16777216
                                            : 8 + (float)(any >> 28) / 64;
            positions[y * (CELLS + 1) + x] =
                rt_scale(rt_vec(film(8 * x), film(8 * y), -1), far);
        }
    for (int cell = 0; cell < CELLS * CELLS; cell++) {
        const int a = cell / CELLS * (CELLS + 1) + cell % CELLS, b = a + CELLS + 2;
        const int corners[6] = {a, a + 1, b, a, b, b - 1};
        memcpy(indices + 6 * cell, corners, sizeof corners);
    }
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const int column = (int)(x * RAYS / (float)view->width);
    const int row = RAYS - 1 - (int)(y * RAYS / (float)view->height);
    const rt_ray ray = {{0, 0, 0}, {film(column), film(row), -1}};
    rt_hit nearest = {.t = FLT_MAX};
    bool found = false;
    rng->rays++;
    for (int i = 0; i < wall.triangle_count; i++)
        found |= rt_hit_triangle(&wall, i, &ray, nearest.t, &nearest);
    if (!found)
        return rt_vec(1, 0.02f, 0.02f);
    return rt_lambert(rt_vec(0.8f, 0.8f, 0.8f), nearest.normal, rt_vec(0.6f, 0.9f, 1.2f),
                      rt_vec(6, 6, 6));
}

int main(int argc, char **argv)
{
    make_wall();
    return demo_main(argc, argv,
                     &(demo){.name = "edges",
                             .title = "Along the edges",
                             .pixel = pixel,
                             .encode = demo_gamma,
                             .samples = 1});
}

/* Meshes by formula, for tests and measurements. All but the landscape are closed, with every
 * triangle counterclockwise as seen from outside. What make_... returns, free_mesh frees. */
#ifndef MESHES_H
#define MESHES_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "../rt.h"

/* A mesh in the making: its arrays have room for all that will come. */
typedef struct growing_mesh {
    rt_vec3 *positions;
    int *indices;
    int position_count, triangle_count;
} growing_mesh;

static inline void *need(void *memory)
{
    if (memory)
        return memory;
    fprintf(stderr, "out of memory\n");
    exit(1);
}

static inline growing_mesh new_mesh(int positions, int triangles)
{
    growing_mesh m = {NULL, NULL, 0, 0};
    m.positions = need(malloc((size_t)positions * sizeof *m.positions));
    m.indices = need(malloc((size_t)triangles * 3 * sizeof *m.indices));
    return m;
}

static inline int add_corner(growing_mesh *m, double x, double y, double z)
{
    m->positions[m->position_count] = rt_vec((float)x, (float)y, (float)z);
    return m->position_count++;
}

static inline void add_triangle(growing_mesh *m, int a, int b, int c)
{
    int *those = m->indices + 3 * (size_t)m->triangle_count++;
    those[0] = a;
    those[1] = b;
    those[2] = c;
}

static inline rt_mesh finished_mesh(growing_mesh m)
{
    const rt_mesh mesh = {m.positions,
                          m.indices,
                          m.position_count,
                          m.triangle_count,
                          {{0.8f, 0.8f, 0.8f}, false}};
    return mesh;
}

static inline void free_mesh(rt_mesh *mesh)
{
    free((void *)(uintptr_t)mesh->positions);
    free((void *)(uintptr_t)mesh->indices);
    memset(mesh, 0, sizeof *mesh);
}

/* Move each corner to center + size * corner; with jitter, up to so much nearer or
 * farther at random. */
static inline void place_mesh(rt_mesh *mesh, rt_vec3 center, float size, float jitter)
{
    rt_vec3 *p = (rt_vec3 *)(uintptr_t)mesh->positions;
    rt_rng rng = rt_rng_start(1, 0, 0);
    for (int i = 0; i < mesh->position_count; i++) {
        const float k = size * (1.0f + jitter * (rt_random(&rng) - 0.5f));
        p[i] = rt_add(center, rt_scale(p[i], k));
    }
}

/* ---- a sphere: an icosahedron, each triangle of which becomes four, again and again --- */

/* Whichever triangle comes first makes the middle of an edge: a hash table. */
typedef struct edge_middle {
    int a, b, middle; /* b 0: nothing here, since a < b */
} edge_middle;

static inline int middle_of(growing_mesh *m, edge_middle *table, size_t mask, int a,
                            int b)
{
    if (a > b)
        return middle_of(m, table, mask, b, a);
    size_t k = rt_hash((uint32_t)a ^ rt_hash((uint32_t)b)) & mask;
    while (table[k].b != 0 && (table[k].a != a || table[k].b != b))
        k = (k + 1) & mask;
    if (table[k].b == 0) {
        const rt_vec3 sum = rt_add(m->positions[a], m->positions[b]);
        const rt_dvec3 p = rt_dnormalize(rt_to_double(sum));
        table[k].a = a;
        table[k].b = b;
        table[k].middle = add_corner(m, p.x, p.y, p.z);
    }
    return table[k].middle;
}

/* On the unit sphere; 20 * 4^levels triangles, levels <= 12. */
static inline rt_mesh make_icosphere(int levels)
{
    const double l = 0.85065080835204, s = 0.52573111211913; /* l = s (1 + sqrt 5) / 2 */
    const double corners[12][3] = {{-s, l, 0}, {s, l, 0}, {-s, -l, 0}, {s, -l, 0},
                                   {0, -s, l}, {0, s, l}, {0, -s, -l}, {0, s, -l},
                                   {l, 0, -s}, {l, 0, s}, {-l, 0, -s}, {-l, 0, s}};
    static const int faces[20][3] = {{0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10},
                                     {0, 10, 11}, {1, 5, 9},  {5, 11, 4}, {11, 10, 2},
                                     {10, 7, 6},  {7, 1, 8},  {3, 9, 4},  {3, 4, 2},
                                     {3, 2, 6},   {3, 6, 8},  {3, 8, 9},  {4, 9, 5},
                                     {2, 4, 11},  {6, 2, 10}, {8, 6, 7},  {9, 8, 1}};
    const int most = 1 << 2 * levels;
    const size_t entries = 16 * (size_t)most; /* of at most 7.5 edges for each of those */
    growing_mesh m = new_mesh(10 * most + 2, 20 * most);
    edge_middle *table = need(malloc(entries * sizeof *table));
    for (int k = 0; k < 12; k++)
        add_corner(&m, corners[k][0], corners[k][1], corners[k][2]);
    memcpy(m.indices, faces, sizeof faces);
    m.triangle_count = 20;
    for (int level = 0; level < levels; level++) {
        memset(table, 0, entries * sizeof *table);
        const int count = m.triangle_count;
        for (int k = count - 1; k >= 0; k--) { /* each into the place of its four */
            const int *those = m.indices + 3 * (size_t)k;
            const int a = those[0], b = those[1], c = those[2];
            const int ab = middle_of(&m, table, entries - 1, a, b);
            const int bc = middle_of(&m, table, entries - 1, b, c);
            const int ca = middle_of(&m, table, entries - 1, c, a);
            m.triangle_count = 4 * k;
            add_triangle(&m, a, ab, ca);
            add_triangle(&m, ab, b, bc);
            add_triangle(&m, ca, bc, c);
            add_triangle(&m, ab, bc, ca);
        }
        m.triangle_count = 4 * count;
    }
    free(table);
    return finished_mesh(m);
}

/* ---- a globe: thin triangles where there are few rows --------------------------------- */

/* On the unit sphere, the poles on y: rows >= 2, columns >= 3; 2 (rows - 1) columns triangles. */
static inline rt_mesh make_globe(int rows, int columns)
{
    const double pi = 3.14159265358979;
    growing_mesh m = new_mesh(2 + (rows - 1) * columns, 2 * (rows - 1) * columns);
    for (int r = 1; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            const double down = pi * r / rows, round = 2 * pi * c / columns;
            add_corner(&m, sin(down) * cos(round), cos(down), sin(down) * sin(round));
        }
    const int north = add_corner(&m, 0, 1, 0), south = add_corner(&m, 0, -1, 0);
    for (int r = 0; r < rows; r++)
        for (int c = 0; c < columns; c++) {
            const int next = (c + 1) % columns, above = (r - 1) * columns;
            const int a = r > 0 ? above + c : north, b = r > 0 ? above + next : north;
            const int below = above + columns;
            if (r < rows - 1)
                add_triangle(&m, a, below + next, below + c);
            if (r > 0)
                add_triangle(&m, a, b, r < rows - 1 ? below + next : south);
        }
    return finished_mesh(m);
}

/* ---- what is made of cubes ------------------------------------------------------------ */

typedef bool cell_function(int x, int y, int z);

/* A cube from -1 to 1 of n^3 cells, some of them full: two triangles wherever a full one
 * has no full neighbour. n <= 400. */
static inline rt_mesh make_cells(int n, cell_function *is_full)
{
    const int side = n + 1;
    growing_mesh m = {NULL, NULL, 0, 0};
    for (int pass = 0; pass < 2; pass++) { /* first they are only counted */
        int count = 0;
        for (int cell = 0; cell < n * n * n; cell++)
            for (int face = 0; face < 6; face++) {
                const int at[3] = {cell / n / n, cell / n % n, cell % n};
                const int axis = face / 2, up = face % 2;
                int by[3] = {at[0], at[1], at[2]};
                by[axis] += up ? 1 : -1;
                if (!is_full(at[0], at[1], at[2]) ||
                    (by[axis] >= 0 && by[axis] < n && is_full(by[0], by[1], by[2])))
                    continue;
                count += 2;
                if (pass == 0)
                    continue;
                const int steps[3] = {side * side, side, 1};
                const int s = steps[(axis + 1) % 3], t = steps[(axis + 2) % 3];
                const int a = (at[0] * side + at[1]) * side + at[2] + up * steps[axis];
                add_triangle(&m, a, up ? a + s : a + t, a + s + t);
                add_triangle(&m, a, a + s + t, up ? a + t : a + s);
            }
        if (pass == 0)
            m = new_mesh(side * side * side, count);
    }
    for (int i = 0; i < side * side * side; i++) /* some are of no triangle */
        add_corner(&m, 2.0 * (i / side / side) / n - 1, 2.0 * (i / side % side) / n - 1,
                   2.0 * (i % side) / n - 1);
    return finished_mesh(m);
}

static inline bool is_any_cell(int x, int y, int z)
{
    (void)(x + y + z);
    return true;
}

/* Menger's sponge: without the cells in the middle of two or three axes, on any scale. */
static inline bool is_sponge(int x, int y, int z)
{
    for (; x > 0 || y > 0 || z > 0; x /= 3, y /= 3, z /= 3)
        if ((x % 3 == 1) + (y % 3 == 1) + (z % 3 == 1) >= 2)
            return false;
    return true;
}

/* ---- turned on a lathe, and a ring ------------------------------------------------------ */

/* A profile of radius and height, turned about the y axis, from the bottom up; it begins
 * and ends on the axis, with radius 0. rings >= 3, columns >= 3; 2 (rings - 2) columns
 * triangles. */
static inline rt_mesh make_lathe(const double (*profile)[2], int rings, int columns)
{
    growing_mesh m = new_mesh(2 + (rings - 2) * columns, 2 * (rings - 2) * columns);
    const int bottom = add_corner(&m, 0, profile[0][1], 0);
    const int top = add_corner(&m, 0, profile[rings - 1][1], 0);
    for (int r = 1; r < rings - 1; r++)
        for (int c = 0; c < columns; c++) {
            const double turn = 2 * 3.14159265358979 * c / columns;
            add_corner(&m, profile[r][0] * cos(turn), profile[r][1],
                       -profile[r][0] * sin(turn));
        }
    const int last = 2 + (rings - 3) * columns;
    for (int c = 0; c < columns; c++) {
        const int next = (c + 1) % columns;
        add_triangle(&m, bottom, 2 + next, 2 + c);
        for (int low = 2; low < last; low += columns) {
            add_triangle(&m, low + c, low + next, low + columns + next);
            add_triangle(&m, low + c, low + columns + next, low + columns + c);
        }
        add_triangle(&m, last + c, last + next, top);
    }
    return finished_mesh(m);
}

/* A ring that lies flat, of this radius, and half its thickness. */
static inline rt_mesh make_ring(double radius, double half, int columns, int rows)
{
    const double pi = 3.14159265358979;
    growing_mesh m = new_mesh(columns * rows, 2 * columns * rows);
    for (int c = 0; c < columns; c++)
        for (int r = 0; r < rows; r++) {
            const double turn = 2 * pi * c / columns, up = 2 * pi * r / rows;
            const double out = radius + half * cos(up);
            add_corner(&m, out * cos(turn), half * sin(up), -out * sin(turn));
        }
    for (int c = 0; c < columns; c++)
        for (int r = 0; r < rows; r++) {
            const int a = c * rows + r, b = c * rows + (r + 1) % rows;
            const int on = (c + 1) % columns * rows, d = on + r, e = on + (r + 1) % rows;
            add_triangle(&m, a, d, e);
            add_triangle(&m, a, e, b);
        }
    return finished_mesh(m);
}

/* ---- a landscape ---------------------------------------------------------------------- */

/* n^2 squares from -1 to 1: waves of all lengths, each half as long as the last. */
static inline rt_mesh make_landscape(int n)
{
    growing_mesh m = new_mesh((n + 1) * (n + 1), 2 * n * n);
    for (int i = 0; i < (n + 1) * (n + 1); i++) {
        const double x = 2.0 * (i % (n + 1)) / n - 1, z = 2.0 * (i / (n + 1)) / n - 1;
        double y = 0;
        for (int wave = 0, k = 3; wave < 8; wave++, k *= 2)
            y += sin(k * (0.8 * x + 0.6 * z) + wave) * cos(k * (0.8 * z - 0.6 * x)) / k;
        add_corner(&m, x, 0.5 * y, z);
    }
    for (int z = 0; z < n; z++)
        for (int x = 0; x < n; x++) {
            const int a = z * (n + 1) + x, b = a + n + 1;
            add_triangle(&m, a, b, b + 1);
            add_triangle(&m, a, b + 1, a + 1);
        }
    return finished_mesh(m);
}

#endif

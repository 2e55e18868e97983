/* Meshes from files, demos 16 and 17: what is read, and what is refused in one line. */
#define _DARWIN_C_SOURCE  /* mkdtemp on macOS */
#define _XOPEN_SOURCE 700 /* mkdtemp, popen, mkfifo, nftw */
#include <time.h>

#include "programs.h"
#include "scene_file.h"

#include "../demos/scene.h"

enum { W = 40, H = 30 };
static const char small[] =
    "40 30 --samples 2 --bounces 3 --no-denoise --no-window --quiet";

/* A roof over a square, and a part of it again, twice as high. */
static const rt_vec3 positions[] = {{0, 0, 0},    {2, 0, 0},       {2, 0, 2},
                                    {0, 0, 2},    {1, 1.25f, 1},   {0.5f, 0.5f, 3},
                                    {1.5f, 0, 3}, {1.5f, 2.5f, 3}, {0.5f, 0, 3}};
static const int indices[] = {0, 4, 1, 1, 4, 2, 2, 4, 3, 3, 4, 0, 8, 6, 7};
static const rt_mesh roof = {positions, indices, 9, 5, {{0, 0, 0}, false}};

static bool has_assimp(void)
{
    run("\"$DEMOS\"/demo16 4 3 --samples 1 --quiet --no-window --mesh none.obj");
    if (!strstr(said, "compiled without assimp"))
        return true;
    print_message("note: no assimp here (make -B, with libassimp-dev): no meshes read\n");
    return false;
}

/* Does the demo make of the file what rt_render makes of the roof? */
static void shows_the_roof(const char *demo, const rt_scene *scene, const char *file)
{
    static rt_vec3 pixels[W * H];
    char arguments[200];
    rt_image image = {.width = W, .height = H, .pixels = pixels};
    const rt_options options = {.samples = 2, .bounces = 3};
    assert_int_equal(rt_render(scene, &room_camera, &options, &image), RT_OK);
    snprintf(arguments, sizeof arguments, "%s %s --out own.pfm --mesh %s", demo, small,
             file);
    expect(0, "", arguments);
    assert_string_equal(said, "");
    rt_vec3 *own = read_pfm("own.pfm", W, H);
    assert_non_null(own);
    if (memcmp(own, pixels, sizeof pixels) != 0)
        fail_msg("%s: %s is another mesh", demo, file);
    free(own);
}

static void write_obj(const char *name, float scale)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    for (int i = 0; i < roof.position_count; i++) {
        const rt_vec3 p = rt_scale(positions[i], scale);
        fprintf(file, "v %.9g %.9g %.9g\n", (double)p.x, (double)p.y, (double)p.z);
    }
    for (int i = 0; i < roof.triangle_count; i++)
        fprintf(file, "f %d %d %d\n", indices[3 * i] + 1, indices[3 * i + 1] + 1,
                indices[3 * i + 2] + 1);
    fclose(file);
}

static void write_ply(const char *name)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fprintf(
        file,
        "ply\nformat ascii 1.0\nelement vertex %d\nproperty float x\nproperty float y\n"
        "property float z\nelement face %d\nproperty list uchar int vertex_indices\n"
        "end_header\n",
        roof.position_count, roof.triangle_count);
    for (int i = 0; i < roof.position_count; i++)
        fprintf(file, "%.9g %.9g %.9g\n", (double)positions[i].x, (double)positions[i].y,
                (double)positions[i].z);
    for (int i = 0; i < roof.triangle_count; i++)
        fprintf(file, "3 %d %d %d\n", indices[3 * i], indices[3 * i + 1],
                indices[3 * i + 2]);
    fclose(file);
}

static void write_stl(const char *name)
{
    FILE *file = fopen(name, "wb");
    assert_non_null(file);
    fprintf(file, "solid roof\n");
    for (int i = 0; i < roof.triangle_count; i++) {
        fprintf(file, "facet normal 0 0 0\nouter loop\n");
        for (int k = 0; k < 3; k++) {
            const rt_vec3 p = rt_corner(&roof, i, k);
            fprintf(file, "vertex %.9g %.9g %.9g\n", (double)p.x, (double)p.y,
                    (double)p.z);
        }
        fprintf(file, "endloop\nendfacet\n");
    }
    fprintf(file, "endsolid roof\n");
    fclose(file);
}

/* With the numbers in another file; and half as large, in a node that makes it twice as large. */
static void write_gltf(const char *name)
{
    FILE *file = fopen("roof.bin", "wb");
    assert_non_null(file);
    for (int i = 0; i < roof.position_count; i++) {
        const rt_vec3 p = rt_scale(positions[i], 0.5f);
        const float xyz[3] = {p.x, p.y, p.z};
        fwrite(xyz, sizeof xyz, 1, file);
    }
    for (size_t i = 0; i < COUNT(indices); i++)
        fputc(indices[i], file);
    fputc(0, file);
    fclose(file);
    write_text(
        name,
        "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
        "\"nodes\":[{\"mesh\":0,\"scale\":[2,2,2]}],\"meshes\":[{\"primitives\":[{"
        "\"attributes\":{\"POSITION\":0},\"indices\":1}]}],"
        "\"buffers\":[{\"uri\":\"roof.bin\",\"byteLength\":124}],\"bufferViews\":["
        "{\"buffer\":0,\"byteOffset\":0,\"byteLength\":108},"
        "{\"buffer\":0,\"byteOffset\":108,\"byteLength\":15}],\"accessors\":["
        "{\"bufferView\":0,\"componentType\":5126,\"count\":9,\"type\":\"VEC3\"},"
        "{\"bufferView\":1,\"componentType\":5121,\"count\":15,\"type\":\"SCALAR\"}]}");
}

static void test_four_formats_are_the_mesh(void **state)
{
    (void)state;
    if (!has_assimp())
        return;
    room_take_mesh(&roof);
    room_prepare(ON_THE_FLOOR);
    room_prepare(ON_THE_PEDESTAL);
    write_obj("roof.obj", 1);
    write_obj("LARGE.OBJ", 1024); /* it is scaled to the size of any other */
    write_ply("roof.ply");
    write_stl("roof.stl");
    write_gltf("roof.gltf");
    static const char *const files[] = {"roof.obj", "LARGE.OBJ", "roof.ply", "roof.stl",
                                        "roof.gltf"};
    for (size_t i = 0; i < COUNT(files); i++)
        shows_the_roof("demo16", &scene_triangles, files[i]);
    shows_the_roof("demo17", &scene_own_shape, "roof.obj");
    expect(0, "the mesh, triangle ",
           "demo16 40 30 --samples 1 --explain 31,23 --mesh roof.obj");
}

/* Lowest point on the floor, or the pedestal; as wide, high or deep as it may be. */
static void test_a_mesh_finds_its_place(void **state)
{
    (void)state;
    room_take_mesh(&roof);
    for (int which = 0; which < MESH_SCENES; which++) {
        room_prepare(which);
        const rt_mesh *mesh = &room_meshes[which];
        rt_vec3 low = mesh->positions[0], high = low;
        for (int i = 0; i < mesh->position_count; i++) {
            const rt_vec3 p = mesh->positions[i];
            low = rt_vec(fminf(low.x, p.x), fminf(low.y, p.y), fminf(low.z, p.z));
            high = rt_vec(fmaxf(high.x, p.x), fmaxf(high.y, p.y), fmaxf(high.z, p.z));
        }
        const rt_vec3 size = rt_sub(high, low), at = room_mesh_place(which);
        assert_float_equal(fmaxf(fmaxf(size.x, size.y), size.z), 22, 1e-4);
        assert_vec(rt_vec((low.x + high.x) / 2, low.y, (low.z + high.z) / 2), at.x, at.y,
                   at.z, 1e-4);
    }
}

static void test_polygons_are_cut_into_triangles(void **state)
{
    (void)state;
    if (!has_assimp())
        return;
    /* an arrow, whose corner goes inward: as two triangles, and as one polygon */
    write_text("two.obj", "v 0 0 0\nv 2 2 0\nv 4 0 0\nv 2 5 0\nf 1 2 4\nf 2 3 4\n");
    write_text("one.obj", "v 0 0 0\nv 2 2 0\nv 4 0 0\nv 2 5 0\nf 1 2 3 4\n");
    write_text("some.obj", "v 0 0 0\nv 2 2 0\nv 4 0 0\nv 2 5 0\nl 1 2\np 3\nf 3 4 1 2\n");
    char arguments[200];
    for (int i = 0; i < 3; i++) {
        static const char *const names[] = {"two", "one", "some"};
        snprintf(arguments, sizeof arguments, "demo16 %s --out %s.png --mesh %s.obj",
                 small, names[i], names[i]);
        expect(0, "", arguments);
    }
    assert_int_equal(run("cmp two.png one.png && cmp two.png some.png"), 0);
}

/* ---- what is no mesh: one line, status 1 ------------------------------------------------ */

static void refused(const char *name, const char *words)
{
    char arguments[400];
    snprintf(arguments, sizeof arguments, "demo16 %s --mesh %s --out refused.png", small,
             name);
    expect(1, words, arguments);
    const char *newline = strchr(said, '\n');
    if (!newline || newline[1] != '\0')
        fail_msg("%s: not one line: %s", name, said);
    char head[200];
    snprintf(head, sizeof head, "demo16: --mesh: cannot read '%s' as a mesh: ", name);
    assert_memory_equal(said, head, strlen(head));
    assert_false(exists("refused.png"));
}

static void test_what_is_no_file(void **state)
{
    (void)state;
    expect(2, "demo16: --mesh: a file name is missing", "demo16 --mesh");
    expect(2, "demo15: --mesh: only chapters 16 and 17 can do that",
           "demo15 --mesh a.obj");
    if (!has_assimp())
        return;
    write_text("empty.obj", "");
    write_text("text.txt", "hello\n");
    write_text("text", "hello\n");
    assert_int_equal(mkdir("folder.obj", 0777), 0);
    assert_int_equal(mkfifo("pipe.obj", 0600), 0);
    assert_int_equal(run("truncate -s 2G large.obj"), 0);
    refused("none.obj", "No such file");
    refused("empty.obj", "it is empty");
    refused("text.txt", "its name does not end in .obj, .ply, .stl, .gltf or .glb");
    refused("text", "its name does not end in");
    refused("folder.obj", "Is a directory");
    refused("pipe.obj", "it is not a file");
    refused("/dev/zero", "it is not a file");
    refused("large.obj", "it is larger than 500 MB");
    remove("large.obj");
}

#define SQUARE "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n"
#define PLY_HEAD(vertices)                                                               \
    "ply\nformat ascii 1.0\nelement vertex " vertices                                    \
    "\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"           \
    "property list uchar int vertex_indices\nend_header\n"

static void test_what_is_no_mesh(void **state)
{
    (void)state;
    if (!has_assimp())
        return;
    static const char no_corner[] = "a triangle has a corner that does not exist";
    static const char no_number[] = "a position is not a number, or larger than 1e15";
    static const struct {
        const char *name, *text, *words;
    } cases[] = {
        {"comment.obj", "# nothing at all, but long enough\n", ""},
        {"noise.obj", "\x89PNG\r\n\x1a\n\1\2\3\4\5\6\7\x80\x90\xff\n\xfe\n", ""},
        {"points.obj", SQUARE, "triangles"},
        {"line.obj", SQUARE "f 1 2\nl 1 2\nf 3\n", "there are no triangles in it"},
        {"one-point.obj", "v 1 1 1\nv 1 1 1\nv 1 1 1\nf 1 2 3\n",
         "all its points are the same"},
        {"tiny.obj", "v 0 0 0\nv 1e-40 0 0\nv 0 1e-40 0\nf 1 2 3\n", "are the same"},
        {"far.obj", SQUARE "f 1 2 99999999\n", "out of range"},
        {"before.obj", SQUARE "f -9 -3 -2\n", "out of range"},
        {"zero.obj", SQUARE "f 0 1 2\n", "nvalid face index"},
        {"int.obj", SQUARE "f 1 2 4294967297\n", "out of range"},
        {"long.obj", SQUARE "f 1 2 18446744073709551617\n", "out of range"},
        {"nan.obj", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", no_number},
        {"large.obj", "v 0 0 0\nv 1e30 0 0\nv 0 1 0\nf 1 2 3\n", no_number},
        {"infinite.obj", "v 0 0 0\nv 1e39 0 0\nv 0 1 0\nf 1 2 3\n", no_number},
        {"index.ply", PLY_HEAD("3") "0 0 0\n1 0 0\n0 1 0\n3 0 1 77\n", no_corner},
        {"nan.ply", PLY_HEAD("3") "0 0 0\nnan 0 0\n0 1 0\n3 0 1 2\n", no_number},
#ifndef __SANITIZE_ADDRESS__ /* there is no limit with that */
        {"short.ply", PLY_HEAD("1000000000") "0 0 0\n", ""},
#endif
        {"short.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0", ""},
        {"empty.gltf", "{}", ""},
        {"deep.gltf", "[[[[[[[[[[[[[[[[[[[[[[[[[[[[", ""},
        {"loop.gltf",
         "{\"asset\":{\"version\":\"2.0\"},\"scene\":0,\"scenes\":[{\"nodes\":[0]}],"
         "\"nodes\":[{\"children\":[1]},{\"children\":[0]}]}",
         ""},
        {"short.glb", "glTF\2", ""},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        write_text(cases[i].name, cases[i].text);
        refused(cases[i].name, cases[i].words);
    }
}

static void test_large_things_are_refused_at_once(void **state)
{
    (void)state;
    if (!has_assimp())
        return;
    FILE *file = fopen("polygon.obj", "wb");
    assert_non_null(file);
    fputs(SQUARE "f", file);
    for (int i = 0; i < 1000000; i++)
        fprintf(file, " %d", i % 4 + 1);
    fputs("\n", file);
    fclose(file);
    const time_t from = time(NULL);
    refused("polygon.obj", "a polygon has more than 1000 corners");
    assert_in_range(time(NULL) - from, 0, 10); /* cut into triangles: minutes */

    unsigned char stl[134] = {
        0}; /* four thousand million triangles, it says, and has one */
    memset(stl + 80, 0xee, 4);
    file = fopen("many.stl", "wb");
    assert_non_null(file);
    fwrite(stl, sizeof stl, 1, file);
    fclose(file);
    refused("many.stl", "");
}

static void test_without_assimp_there_is_the_teapot(void **state)
{
    (void)state;
    expect(0, "", "demo16 8 6 --samples 1 --quiet --no-window --out pot.png");
    run("\"$DEMOS\"/demo16 8 6 --samples 1 --quiet --no-window --mesh none.obj --out "
        "same.png");
    if (!strstr(said, "compiled without assimp"))
        return;
    assert_non_null(strstr(said, "apt-get install libassimp-dev"));
    assert_int_equal(run("cmp pot.png same.png"), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_four_formats_are_the_mesh),
        cmocka_unit_test(test_a_mesh_finds_its_place),
        cmocka_unit_test(test_polygons_are_cut_into_triangles),
        cmocka_unit_test(test_what_is_no_file),
        cmocka_unit_test(test_what_is_no_mesh),
        cmocka_unit_test(test_large_things_are_refused_at_once),
        cmocka_unit_test(test_without_assimp_there_is_the_teapot),
    };
    return cmocka_run_group_tests_name("meshes from files", tests, set_up, tear_down);
}

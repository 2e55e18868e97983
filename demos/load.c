/* Meshes from files: see load.h. A file may contain anything, and the library is large.
 * So another process reads it, with limited memory and time, and what it hands over is
 * checked once more. */
#include "load.h"

#ifndef HAVE_ASSIMP

const char *load_lacks(void)
{
    return "compiled without assimp, which reads meshes (apt-get install libassimp-dev, "
           "dnf install assimp-devel, pacman or brew: assimp; then make -B)";
}

bool load_mesh(const char *who, const char *path, rt_mesh *mesh)
{
    (void)who, (void)path, (void)mesh;
    return false;
}

#else

#include "platform.h"

#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include <assimp/cimport.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>

/* Limits: more would be too much for this program, or a mistake. */
enum {
    BYTES = 500000000, /* of the file */
    MEMORY_GB = 4,     /* for reading it */
    SECONDS = 60,
    TRIANGLES = 20000000,
    CORNERS = 1000 /* of a polygon: cutting it up takes time in proportion to their
                      square */
};

/* What the other process hands over; then come positions and indices. */
typedef struct head {
    char why[200]; /* "": all is well */
    int position_count, triangle_count;
} head;

static const char no_triangles[] = "there are no triangles in it";
static const char no_such_corner[] = "a triangle has a corner that does not exist";

const char *load_lacks(void)
{
    return NULL;
}

/* -------------------------------------------------------------------------------------
 * The other process
 * ------------------------------------------------------------------------------------- */

/* NULL, or why assimp should not go on with it. */
static const char *fault_of(const struct aiScene *scene)
{
    bool some = false;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        const struct aiMesh *mesh = scene->mMeshes[m];
        for (unsigned f = 0; f < mesh->mNumFaces; f++) {
            some = some || mesh->mFaces[f].mNumIndices > 2;
            if (mesh->mFaces[f].mNumIndices > CORNERS)
                return "a polygon has more than 1000 corners";
            for (unsigned k = 0; k < mesh->mFaces[f].mNumIndices; k++)
                if (mesh->mFaces[f].mIndices[k] >= mesh->mNumVertices)
                    return no_such_corner;
        }
    }
    return some ? NULL : no_triangles;
}

/* Read the file as triangles: its parts where they belong, and equal corners only
 * once. */
static const struct aiScene *import(const char *path, char *why, size_t size)
{
    struct aiPropertyStore *wishes = aiCreatePropertyStore();
    aiSetImportPropertyInteger(
        wishes, AI_CONFIG_PP_RVC_FLAGS,
        aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
            aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
            aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS);
    const struct aiScene *scene = aiImportFileExWithProperties(path, 0, NULL, wishes);
    const char *bad = scene ? fault_of(scene) : NULL;
    if (bad) {
        snprintf(why, size, "%s", bad);
        return NULL;
    }
    if (scene)
        scene = aiApplyPostProcessing(
            scene, aiProcess_RemoveComponent | aiProcess_Triangulate |
                       aiProcess_PreTransformVertices | aiProcess_JoinIdenticalVertices);
    if (!scene) {
        const char *said = aiGetErrorString();
        snprintf(why, size, "%s", strstr(said, "bad_alloc") ? "not enough memory" : said);
        for (char *c = why; *c; c++) /* one line */
            if ((unsigned char)*c < 32)
                *c = ' ';
    }
    return scene;
}

static bool is_triangle(const struct aiFace *face)
{
    return face->mNumIndices == 3; /* others are points and lines */
}

/* Count all triangles, then write them. */
static void hand_over(const struct aiScene *scene, head *h, FILE *to)
{
    uint64_t positions = 0, triangles = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        positions += scene->mMeshes[m]->mNumVertices;
        for (unsigned f = 0; f < scene->mMeshes[m]->mNumFaces; f++)
            triangles += is_triangle(&scene->mMeshes[m]->mFaces[f]);
    }
    if (triangles == 0)
        snprintf(h->why, sizeof h->why, "%s", no_triangles);
    else if (triangles > TRIANGLES || positions > 3 * (uint64_t)TRIANGLES)
        snprintf(h->why, sizeof h->why, "more than %d triangles", TRIANGLES);
    if (*h->why)
        return;
    h->position_count = (int)positions;
    h->triangle_count = (int)triangles;
    fwrite(h, sizeof *h, 1, to);
    for (unsigned m = 0; m < scene->mNumMeshes; m++)
        for (unsigned i = 0; i < scene->mMeshes[m]->mNumVertices; i++) {
            const struct aiVector3D p = scene->mMeshes[m]->mVertices[i];
            const float xyz[3] = {(float)p.x, (float)p.y, (float)p.z};
            fwrite(xyz, sizeof xyz, 1, to);
        }
    unsigned first = 0;
    for (unsigned m = 0; m < scene->mNumMeshes; m++) {
        for (unsigned f = 0; f < scene->mMeshes[m]->mNumFaces; f++) {
            const struct aiFace *face = &scene->mMeshes[m]->mFaces[f];
            for (unsigned k = 0; k < 3 && is_triangle(face); k++) {
                const int index = (int)(first + face->mIndices[k]);
                fwrite(&index, sizeof index, 1, to);
            }
        }
        first += scene->mMeshes[m]->mNumVertices;
    }
}

/* Write the mesh, or why there is none, into the file. False: it could write neither. */
static bool read_here(const char *path, FILE *to)
{
    head h = {.why = ""};
    const struct aiScene *scene = import(path, h.why, sizeof h.why);
    if (scene)
        hand_over(scene, &h, to);
    else if (!*h.why)
        snprintf(h.why, sizeof h.why, "assimp does not say why");
    if (*h.why)
        fwrite(&h, sizeof h, 1, to);
    return fflush(to) == 0 && !ferror(to);
}

/* -------------------------------------------------------------------------------------
 * This one
 * ------------------------------------------------------------------------------------- */

/* NULL, or why it is no mesh for us. Checks every index and every number. */
static const char *fault(const rt_mesh *mesh)
{
    bool some = false;
    for (int i = 0; i < mesh->position_count; i++) {
        const rt_vec3 p = mesh->positions[i], q = mesh->positions[0];
        if (!(fabsf(p.x) <= 1e15f && fabsf(p.y) <= 1e15f && fabsf(p.z) <= 1e15f))
            return "a position is not a number, or larger than 1e15";
        const rt_vec3 d = rt_sub(p, q);
        some = some || fabsf(d.x) + fabsf(d.y) + fabsf(d.z) > 1e-30f;
    }
    for (size_t i = 0; i < 3 * (size_t)mesh->triangle_count; i++)
        if (mesh->indices[i] < 0 || mesh->indices[i] >= mesh->position_count)
            return no_such_corner;
    return some ? NULL : "all its points are the same";
}

static const char *take_over(FILE *file, rt_mesh *mesh)
{
    static head h;
    rewind(file);
    if (fread(&h, sizeof h, 1, file) != 1)
        return "what was read got lost";
    h.why[sizeof h.why - 1] = '\0';
    if (*h.why)
        return h.why;
    const size_t positions = (size_t)h.position_count;
    const size_t indices = 3 * (size_t)h.triangle_count;
    rt_vec3 *p = malloc(positions * sizeof *p);
    int *i = malloc(indices * sizeof *i);
    *mesh = (rt_mesh){.positions = p,
                      .indices = i,
                      .position_count = h.position_count,
                      .triangle_count = h.triangle_count};
    const char *why = !p || !i ? "not enough memory"
                      : fread(p, sizeof *p, positions, file) != positions ||
                              fread(i, sizeof *i, indices, file) != indices
                          ? "what was read got lost"
                          : fault(mesh);
    if (why) {
        free(p);
        free(i);
    }
    return why;
}

/* Large letters count as small ones. */
static bool ends_in(const char *path, const char *ending)
{
    const size_t length = strlen(path), n = strlen(ending);
    for (size_t i = 0; i < n && n <= length; i++)
        if (tolower((unsigned char)path[length - n + i]) != ending[i])
            return false;
    return n <= length;
}

/* NULL, or why not to read this file. */
static const char *refusal(const char *path)
{
    static const char *const endings[] = {".obj", ".ply", ".stl", ".gltf", ".glb"};
    platform_info info;
    switch (platform_look(path, &info)) {
    case NO_FILE: return strerror(errno);
    case A_FOLDER: return strerror(EISDIR);
    case A_DEVICE: return "it is not a file";
    case A_FILE: break;
    }
    if (info.size > BYTES)
        return "it is larger than 500 MB";
    for (size_t i = 0; i < sizeof endings / sizeof endings[0]; i++)
        if (ends_in(path, endings[i]))
            return info.size == 0 ? "it is empty" : NULL;
    return "its name does not end in .obj, .ply, .stl, .gltf or .glb";
}

bool load_mesh(const char *who, const char *path, rt_mesh *mesh)
{
    const char *why = refusal(path);
    FILE *file = why ? NULL : tmpfile();
    if (!why && !file)
        why = strerror(errno);
    if (!why)
        switch (platform_apart(read_here, path, file, MEMORY_GB, SECONDS)) {
        case WELL: why = take_over(file, mesh); break;
        case TOO_LONG: why = "reading it takes more than a minute"; break;
        case BADLY: why = "assimp gave up, or needs more than 4 GB"; break;
        }
    if (file)
        fclose(file);
    if (why) {
        fprintf(stderr, "%s: cannot read '", who);
        for (const char *c = path; *c; c++) /* one line, whatever it is called */
            putc((unsigned char)*c < 32 ? '?' : *c, stderr);
        fprintf(stderr, "' as a mesh: %s\n", why);
    }
    return !why;
}

#endif

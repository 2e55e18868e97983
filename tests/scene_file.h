/* Scenes from JSON files (references/scenes/SCHEMA.md) and images from and to PFM files, for
 * render_scene and for the tests that compare with the references. */
#ifndef SCENE_FILE_H
#define SCENE_FILE_H

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cJSON.h>

#include "../rt.h"

typedef struct scene_file {
    rt_scene scene; /* of the shapes and the light below */
    rt_sphere *spheres;
    rt_box *boxes;
    rt_mesh *meshes;
    rt_surface *surfaces;
    rt_light light; /* or, with a radius, */
    rt_lamp lamp;
    rt_lens lens;
    rt_camera camera;
    int width, height, bounces;
    bool mirror_direct; /* mirrors and direct light only: no diffuse bounce */
    char error[200];    /* what is wrong with the file, or "" */
} scene_file;

/* A whole file, with a 0 behind it, to be freed; NULL if it cannot be read. */
static inline char *read_whole_file(const char *path, size_t *size)
{
    FILE *file = fopen(path, "rb");
    char *text = NULL;
    size_t used = 0, room = 0;
    while (file) {
        if (used + 1 >= room) {
            char *more = realloc(text, room = 2 * room + 4096);
            if (!more)
                break;
            text = more;
        }
        const size_t n = fread(text + used, 1, room - used - 1, file);
        if (n == 0)
            break;
        used += n;
    }
    const bool good = file && text && feof(file) && !ferror(file);
    if (file)
        fclose(file);
    if (!good) {
        free(text);
        return NULL;
    }
    text[used] = '\0';
    *size = used;
    return text;
}

/* ---- JSON: the first thing that is wrong goes into file->error
 * ---------------------- */

static inline void scene_error(scene_file *file, const char *name, const char *what)
{
    if (!file->error[0])
        snprintf(file->error, sizeof file->error, "%s: %s", name, what);
}

static inline double json_number(scene_file *file, const cJSON *parent, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(parent, name);
    if (!cJSON_IsNumber(item))
        scene_error(file, name, "a number is missing");
    return cJSON_IsNumber(item) ? item->valuedouble : 0.0;
}

/* The same, 0 if it is not there. */
static inline float json_option(scene_file *file, const cJSON *parent, const char *name)
{
    return cJSON_GetObjectItemCaseSensitive(parent, name)
               ? (float)json_number(file, parent, name)
               : 0.0f;
}

static inline int json_count(scene_file *file, const cJSON *parent, const char *name)
{
    const double value = json_number(file, parent, name);
    if (!(value >= 0.0 && value <= 100000.0))
        scene_error(file, name, "must be 0 to 100000");
    return value >= 0.0 && value <= 100000.0 ? (int)value : 0;
}

static inline rt_vec3 json_vector(scene_file *file, const cJSON *parent, const char *name)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(parent, name);
    const cJSON *x = cJSON_GetArrayItem(item, 0), *y = cJSON_GetArrayItem(item, 1),
                *z = cJSON_GetArrayItem(item, 2);
    if (cJSON_GetArraySize(item) != 3 || !cJSON_IsNumber(x) || !cJSON_IsNumber(y) ||
        !cJSON_IsNumber(z)) {
        scene_error(file, name, "three numbers are missing");
        return rt_vec(0.0f, 0.0f, 0.0f);
    }
    return rt_vec((float)x->valuedouble, (float)y->valuedouble, (float)z->valuedouble);
}

static inline rt_material json_material(scene_file *file, const cJSON *shape)
{
    rt_material material;
    material.albedo = json_vector(file, shape, "albedo");
    material.mirror = cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(shape, "mirror"));
    const float shininess = json_option(file, shape, "shininess");
    if (material.mirror && !(shininess > 0.0f)) /* the schema: albedo ignored */
        material.albedo = rt_vec(1.0f, 1.0f, 1.0f);
    return material;
}

static inline rt_surface json_surface(scene_file *file, const cJSON *shape)
{
    rt_surface surface = {0};
    surface.eta = json_option(file, shape, "eta");
    surface.shininess = json_option(file, shape, "shininess");
    if (surface.eta != 0.0f || surface.shininess != 0.0f)
        file->scene.surfaces = file->surfaces; /* part two, chapters 11 and 13 */
    return surface;
}

static inline void json_mesh(scene_file *file, const cJSON *shape, rt_mesh *mesh)
{
    const cJSON *positions = cJSON_GetObjectItemCaseSensitive(shape, "positions");
    const cJSON *indices = cJSON_GetObjectItemCaseSensitive(shape, "indices");
    const int floats = cJSON_GetArraySize(positions), ints = cJSON_GetArraySize(indices);
    rt_vec3 *p = calloc((size_t)floats / 3 + 1, sizeof *p);
    int *corner = calloc((size_t)ints + 1, sizeof *corner);
    const cJSON *item;
    int i = 0;
    mesh->positions = p;
    mesh->indices = corner;
    mesh->material = json_material(file, shape);
    if (!p || !corner || floats % 3 != 0 || ints % 3 != 0) {
        scene_error(file, "meshes", "need three numbers for each position and triangle");
        return;
    }
    mesh->position_count = floats / 3;
    mesh->triangle_count = ints / 3;
    cJSON_ArrayForEach(item, positions)
    {
        rt_vec3 *v = &p[i / 3];
        *(i % 3 == 0 ? &v->x : i % 3 == 1 ? &v->y : &v->z) = (float)item->valuedouble;
        i++;
    }
    cJSON_ArrayForEach(item, indices) *corner++ = item->valueint;
}

static inline void free_scene(scene_file *file)
{
    free(file->surfaces);
    free(file->spheres);
    free(file->boxes);
    for (int i = 0; i < file->scene.mesh_count; i++) {
        free((void *)file->meshes[i].positions);
        free((void *)file->meshes[i].indices);
    }
    free(file->meshes);
    memset(file, 0, sizeof *file);
}

static inline void json_scene(scene_file *file, const cJSON *json)
{
    const cJSON *camera = cJSON_GetObjectItemCaseSensitive(json, "camera");
    const cJSON *light = cJSON_GetObjectItemCaseSensitive(json, "light");
    const cJSON *sphere_list = cJSON_GetObjectItemCaseSensitive(json, "spheres");
    const cJSON *box_list = cJSON_GetObjectItemCaseSensitive(json, "boxes");
    const cJSON *mesh_list = cJSON_GetObjectItemCaseSensitive(json, "meshes");
    const cJSON *integrator = cJSON_GetObjectItemCaseSensitive(json, "integrator");
    const cJSON *shape;

    file->width = json_count(file, json, "width");
    file->height = json_count(file, json, "height");
    file->bounces = json_count(file, json, "bounces");
    file->mirror_direct = cJSON_IsString(integrator) &&
                          strcmp(integrator->valuestring, "mirror_direct") == 0;
    if (integrator && !file->mirror_direct &&
        !(cJSON_IsString(integrator) && strcmp(integrator->valuestring, "path") == 0))
        scene_error(file, "integrator", "must be path or mirror_direct");

    file->camera.position = json_vector(file, camera, "position");
    file->camera.direction =
        rt_sub(json_vector(file, camera, "look_at"), file->camera.position);
    if (rt_is_zero(file->camera.direction))
        scene_error(file, "look_at", "must not be the position");
    file->camera.up = json_vector(file, camera, "up");
    file->camera.fov_y = (float)json_number(file, camera, "fov_y");
    file->light.position = json_vector(file, light, "position");
    file->light.intensity = json_vector(file, light, "intensity");
    file->lamp.center = file->light.position;
    file->lamp.intensity = file->light.intensity;
    file->lamp.radius = json_option(file, light, "radius");
    const bool lamp = file->lamp.radius != 0.0f;
    file->scene.lights = &file->light;
    file->scene.light_count = lamp ? 0 : 1;
    file->scene.lamps = &file->lamp;
    file->scene.lamp_count = lamp ? 1 : 0;
    file->lens.radius = json_option(file, camera, "lens_radius");
    file->lens.focus = json_option(file, camera, "focus");

    const size_t sphere_room = (size_t)cJSON_GetArraySize(sphere_list) + 1;
    const size_t box_room = (size_t)cJSON_GetArraySize(box_list) + 1;
    const size_t mesh_room = (size_t)cJSON_GetArraySize(mesh_list) + 1;
    file->spheres = calloc(sphere_room, sizeof *file->spheres);
    file->boxes = calloc(box_room, sizeof *file->boxes);
    file->meshes = calloc(mesh_room, sizeof *file->meshes);
    file->surfaces = calloc(sphere_room + box_room + mesh_room, sizeof *file->surfaces);
    file->scene.spheres = file->spheres;
    file->scene.boxes = file->boxes;
    file->scene.meshes = file->meshes;
    if (!file->spheres || !file->boxes || !file->meshes || !file->surfaces) {
        scene_error(file, "scene", "not enough memory");
        return;
    }
    cJSON_ArrayForEach(shape, sphere_list)
    {
        file->surfaces[file->scene.sphere_count] = json_surface(file, shape);
        rt_sphere *sphere = &file->spheres[file->scene.sphere_count++];
        sphere->center = json_vector(file, shape, "center");
        sphere->radius = (float)json_number(file, shape, "radius");
        sphere->material = json_material(file, shape);
    }
    cJSON_ArrayForEach(shape, box_list)
    {
        file->surfaces[file->scene.sphere_count + file->scene.box_count] =
            json_surface(file, shape);
        rt_box *box = &file->boxes[file->scene.box_count++];
        box->min = json_vector(file, shape, "min");
        box->max = json_vector(file, shape, "max");
        box->material = json_material(file, shape);
    }
    cJSON_ArrayForEach(shape, mesh_list)
    {
        rt_scene *scene = &file->scene;
        file->surfaces[scene->sphere_count + scene->box_count + scene->mesh_count] =
            json_surface(file, shape);
        json_mesh(file, shape, &file->meshes[scene->mesh_count++]);
    }
}

/* Read a scene into *file, which must stay where it is; free_scene afterwards. */
static inline bool read_scene(const char *path, scene_file *file)
{
    size_t size;
    char *text = read_whole_file(path, &size);
    cJSON *json = text ? cJSON_ParseWithLength(text, size) : NULL;
    memset(file, 0, sizeof *file);
    if (json)
        json_scene(file, json);
    else
        scene_error(file, "file", text ? "is not JSON" : "cannot be read");
    const rt_status scene = rt_check_scene(&file->scene, NULL);
    const rt_status view = rt_check_camera(&file->camera);
    if (scene != RT_OK || view != RT_OK)
        scene_error(file, "scene", rt_status_text(scene != RT_OK ? scene : view));
    cJSON_Delete(json);
    free(text);
    return !file->error[0];
}

/* ---- rendering ----------------------------------------------------------------------- */

static inline rt_vec3 scene_mirror_direct(const void *context, float x, float y,
                                          rt_rng *rng)
{
    const scene_file *file = context;
    rt_ray ray = rt_camera_ray(&file->camera, file->width, file->height, x, y);
    for (int bounce = 0; bounce <= file->bounces; bounce++) {
        rt_hit hit;
        rng->rays++;
        if (!rt_intersect(&file->scene, &ray, &hit))
            break;
        if (!hit.material->mirror)
            return rt_direct(&file->scene, &hit, rng);
        ray.direction = rt_reflect(ray.direction, hit.normal);
        ray.origin = rt_leave(hit.point, hit.normal, ray.direction);
    }
    return rt_vec(0.0f, 0.0f, 0.0f);
}

static inline rt_status render_scene(const scene_file *file, int samples, uint32_t seed,
                                     rt_image *image)
{
    rt_options options = {0};
    options.samples = samples;
    options.bounces = file->bounces;
    options.seed = seed;
    options.lens = file->lens;
    if (file->mirror_direct)
        return rt_render_pixels(scene_mirror_direct, file, &options, image);
    return rt_render(&file->scene, &file->camera, &options, image);
}

/* ---- PFM: linear floats, little endian, bottom row first ----------------------------- */

/* The pixels of a colour PFM of this size, top row first, to be freed; NULL if it is none. */
static inline rt_vec3 *read_pfm(const char *path, int width, int height)
{
    size_t size;
    char head[64];
    char *bytes = read_whole_file(path, &size);
    const size_t head_size =
        (size_t)snprintf(head, sizeof head, "PF\n%d %d\n-1.0\n", width, height);
    const size_t row = 12 * (size_t)width;
    rt_vec3 *pixels = NULL;
    if (bytes && size == head_size + row * (size_t)height &&
        memcmp(bytes, head, head_size) == 0)
        pixels = malloc(row * (size_t)height);
    for (int y = 0; pixels && y < height; y++)
        for (int x = 0; x < width; x++) {
            const unsigned char *p = (const unsigned char *)bytes + head_size +
                                     row * (size_t)(height - 1 - y) + 12 * (size_t)x;
            float rgb[3];
            for (int k = 0; k < 3; k++, p += 4) {
                const uint32_t bits = (uint32_t)p[0] | (uint32_t)p[1] << 8 |
                                      (uint32_t)p[2] << 16 | (uint32_t)p[3] << 24;
                memcpy(&rgb[k], &bits, 4);
            }
            pixels[y * width + x] = rt_vec(rgb[0], rgb[1], rgb[2]);
        }
    free(bytes);
    return pixels;
}

static inline bool write_pfm(const char *path, const rt_image *image)
{
    FILE *file = fopen(path, "wb");
    bool good =
        file && fprintf(file, "PF\n%d %d\n-1.0\n", image->width, image->height) > 0;
    for (int y = image->height - 1; good && y >= 0; y--)
        for (int x = 0; x < image->width; x++) {
            const rt_vec3 v = image->pixels[y * image->width + x];
            const float rgb[3] = {v.x, v.y, v.z};
            for (int k = 0; k < 3; k++) {
                uint32_t bits;
                memcpy(&bits, &rgb[k], 4);
                for (int shift = 0; shift < 32; shift += 8)
                    good = putc((int)(bits >> shift & 255), file) != EOF && good;
            }
        }
    return (!file || fclose(file) == 0) && good;
}

#endif

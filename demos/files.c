/* Pictures as files: see files.h. They are written under another name and renamed when complete. */
#include "files.h"
#include "platform.h"

#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#define STB_IMAGE_IMPLEMENTATION
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_NO_HDR
#define STBI_NO_LINEAR
#include <stb_image.h>

static bool file_error(const char *who, const char *path)
{
    fprintf(stderr, "%s: cannot write '%s': %s\n", who, path, strerror(errno));
    return false;
}

/* The picture takes its name. If it cannot, it stays under the other one. */
static bool replace(const char *who, const char *new, const char *path, const char *given)
{
    const char *why = platform_replace(new, path);
    if (why)
        fprintf(stderr, "%s: cannot write '%s': %s; the picture is in '%s'\n", who, given,
                why, new);
    return !why;
}

/* Open a new file in the folder of path, to be renamed; free *name. NULL, with errno, on
 * failure. */
static FILE *open_beside(const char *path, char **name)
{
    const int folder = platform_folder(path);
    const size_t size = (size_t)folder + 32;
    FILE *file = NULL;
    *name = strlen(path) < INT_MAX ? malloc(size) : NULL;
    for (int i = 1; *name && !file && i < 10000; i++) { /* many may write at once */
        snprintf(*name, size, "%.*s.rt-%d.part", folder, path, i);
        file = platform_open(*name, "wbx"); /* x: never an existing file */
        if (!file && errno != EEXIST)
            break;
    }
    return file;
}

/* Devices and pipes are written in place; renaming would replace them by a file. */
static bool written_in_place(const char *path)
{
    return platform_look(path, NULL) == A_DEVICE;
}

/* Asked before the rendering, not after it. */
bool files_can_write(const char *who, const char *path)
{
    const platform_kind kind = platform_look(path, NULL);
    if (kind == A_DEVICE)
        return true;
    if (kind == A_FOLDER)
        errno = EISDIR;
    if (kind == A_FOLDER || (kind == NO_FILE && errno != ENOENT)) /* a name too long */
        return file_error(who, path);
    char *name;
    FILE *file = open_beside(path, &name);
    const bool good = file != NULL || file_error(who, path);
    if (good) {
        fclose(file);
        platform_remove(name);
    }
    free(name);
    return good;
}

bool files_write(const char *who, const char *given, const void *bytes, size_t size)
{
    char *name = NULL, *real = platform_behind(given);
    const char *path = real ? real : given;
    const bool in_place = written_in_place(path);
    FILE *file = in_place ? platform_open(path, "wb") : open_beside(path, &name);
    bool good = file != NULL;
    if (good) {
        good = fwrite(bytes, 1, size, file) == size && fflush(file) == 0;
        const int error = errno;
        if (fclose(file) != 0)
            good = false;
        else
            errno = error;
        if (!good) {
            file_error(who, given);
            if (!in_place)
                platform_remove(name);
        } else if (!in_place) {
            good = replace(who, name, path, given);
        }
    } else {
        file_error(who, given);
    }
    free(name);
    free(real);
    return good;
}

/* PFM: linear floats, little endian (the -1), bottom row first. */
bool files_save_pfm(const char *who, const char *path, int width, int height,
                    const rt_vec3 *pixels)
{
    char head[64];
    const size_t head_size =
        (size_t)snprintf(head, sizeof head, "PF\n%d %d\n-1.0\n", width, height);
    const size_t size = head_size + (size_t)width * (size_t)height * 12;
    unsigned char *file = malloc(size);
    if (!file)
        return file_error(who, path);
    memcpy(file, head, head_size);
    unsigned char *p = file + head_size;
    for (int y = height - 1; y >= 0; y--)
        for (int i = y * width; i < (y + 1) * width; i++) {
            const float rgb[3] = {pixels[i].x, pixels[i].y, pixels[i].z};
            for (int k = 0; k < 3; k++) {
                uint32_t bits;
                memcpy(&bits, &rgb[k], 4);
                for (int shift = 0; shift < 32; shift += 8)
                    *p++ = (unsigned char)(bits >> shift);
            }
        }
    const bool good = files_write(who, path, file, size);
    free(file);
    return good;
}

bool files_save_png(const char *who, const char *path, int width, int height,
                    const unsigned char *bytes)
{
    int size = 0;
    unsigned char *file =
        stbi_write_png_to_mem(bytes, 3 * width, width, height, 3, &size);
    if (!file) {
        errno = ENOMEM;
        return file_error(who, path);
    }
    const bool good = files_write(who, path, file, (size_t)size);
    free(file);
    return good;
}

bool files_is_pfm(const char *path)
{
    return strcmp(strrchr(path, '.'), ".pfm") == 0;
}

/* The light of a byte is (byte / 255)^2.2, as in chapter 5. */
rt_vec3 *files_load(const char *who, const char *path, int *width, int *height)
{
    errno = 0;
    FILE *file = platform_open(path, "rb");
    unsigned char *bytes =
        file ? stbi_load_from_file(file, width, height, NULL, 3) : NULL;
    const char *why = !file || errno == EISDIR ? strerror(errno) : stbi_failure_reason();
    const size_t count = bytes ? (size_t)*width * (size_t)*height : 0;
    rt_vec3 *pixels = count > 0 ? malloc(count * sizeof *pixels) : NULL;
    float light[256];
    for (int i = 0; i < 256; i++)
        light[i] = (float)pow(i / 255.0, 2.2);
    for (size_t i = 0; pixels && i < count; i++)
        pixels[i] =
            rt_vec(light[bytes[3 * i]], light[bytes[3 * i + 1]], light[bytes[3 * i + 2]]);
    if (!bytes)
        fprintf(stderr, "%s: cannot read '%s' as PNG or JPEG: %s\n", who, path,
                why && *why ? why : "it is damaged");
    else if (!pixels)
        fprintf(stderr, "%s: '%s': no memory for %d x %d pixels\n", who, path, *width,
                *height);
    if (file)
        fclose(file);
    stbi_image_free(bytes);
    return pixels;
}

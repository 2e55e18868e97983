/* Parts of a picture as files: see parts.h. */
#include "parts.h"
#include "files.h"
#include "platform.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

enum { HEAD = 1000 /* bytes of text at most */, SUM = 8, MOST_COUNTED = 1000 };

void parts_cut(rt_image *image, int k, int n)
{
    const long long all = (long long)image->width * image->height;
    image->first = (int)(all * (k - 1) / n);
    image->count = (int)(all * k / n) - image->first;
}

char *parts_path(const char *picture, int k, int n)
{
    const size_t size = strlen(picture) + 50;
    char *path = malloc(size);
    const char *dot = strrchr(picture, '.');
    if (path)
        snprintf(path, size, "%.*s-part-%d-of-%d.part", (int)(dot - picture), picture, k,
                 n);
    return path;
}

size_t parts_pixels(const rt_image *image)
{
    return image->count > 0 ? (size_t)image->count
                            : (size_t)image->width * (size_t)image->height;
}

/* When its file was written, in seconds; -1: it is not there. */
static double written(const char *picture, int k, int n)
{
    platform_info info;
    char *path = parts_path(picture, k, n);
    const bool there = path && platform_look(path, &info) == A_FILE;
    free(path);
    return there ? (double)info.written : -1.0;
}

parts_progress parts_look(const char *picture, int k, int n, double took)
{
    const double window = fmax(8.0 * took, 10.0);
    const double now = written(picture, k, n);
    double first = now;
    int there = 0, lately = 0;
    if (n > MOST_COUNTED)
        return (parts_progress){-1, 0.0};
    for (int i = 1; i <= n; i++) {
        const double t = written(picture, i, n);
        there += t >= 0.0;
        if (t > now - window) {
            lately++;
            first = fmin(first, t);
        }
    }
    const double span = fmin(window, now - first + took);
    const bool known = k > 0 && span >= 2.0; /* files know only whole seconds */
    return (parts_progress){there, known ? span / lately * (n - there) : 0.0};
}

/* -------------------------------------------------------------------------------------
 * Floats as bytes, the lowest first, and their sum
 * ------------------------------------------------------------------------------------- */

/* What an image has for its pixels: arrays of floats, for pixels, half and guides. */
typedef struct floats {
    float *at;
    size_t count;
} floats;

enum { ARRAYS = 3 };

static size_t arrays_of(const rt_image *image, floats arrays[ARRAYS])
{
    const size_t pixels = parts_pixels(image), vec = sizeof(rt_vec3) / sizeof(float);
    const size_t guide = sizeof(rt_guide) / sizeof(float);
    arrays[0] = (floats){(float *)image->pixels, pixels * vec};
    arrays[1] = (floats){(float *)image->half, image->half ? pixels * vec : 0};
    arrays[2] = (floats){(float *)image->guides, image->guides ? pixels * guide : 0};
    return arrays[0].count + arrays[1].count + arrays[2].count;
}

static void put_bits(uint64_t bits, int bytes, unsigned char *to)
{
    for (int i = 0; i < bytes; i++)
        to[i] = (unsigned char)(bits >> 8 * i);
}

static uint64_t get_bits(const unsigned char *from, int bytes)
{
    uint64_t bits = 0;
    for (int i = 0; i < bytes; i++)
        bits |= (uint64_t)from[i] << 8 * i;
    return bits;
}

static void put_floats(floats f, unsigned char *to)
{
    for (size_t i = 0; i < f.count; i++, to += 4) {
        uint32_t bits;
        memcpy(&bits, &f.at[i], 4);
        put_bits(bits, 4, to);
    }
}

static void get_floats(floats f, const unsigned char *from)
{
    for (size_t i = 0; i < f.count; i++, from += 4) {
        const uint32_t bits = (uint32_t)get_bits(from, 4);
        memcpy(&f.at[i], &bits, 4);
    }
}

/* FNV-1a. It finds accidents, not forgeries. */
uint64_t parts_add(uint64_t sum, const void *bytes, size_t size)
{
    sum = sum ? sum : UINT64_C(0xcbf29ce484222325);
    for (size_t i = 0; i < size; i++)
        sum = (sum ^ ((const unsigned char *)bytes)[i]) * UINT64_C(0x100000001b3);
    return sum;
}

uint64_t parts_sum(const rt_image *image)
{
    floats arrays[ARRAYS];
    arrays_of(image, arrays);
    unsigned char *bytes = malloc(4 * arrays[0].count);
    uint64_t sum = 0;
    if (bytes) {
        put_floats(arrays[0], bytes);
        sum = parts_add(0, bytes, 4 * arrays[0].count);
    }
    free(bytes);
    return sum;
}

/* -------------------------------------------------------------------------------------
 * Files
 * ------------------------------------------------------------------------------------- */

void parts_describe(demo_text *lines, const char *demo, const rt_options *options,
                    const rt_image *image, uint64_t given, uint64_t scene)
{
    text_add(lines, "a part of a picture\nrt.h %d.%d.%d\n%s\n", RT_VERSION_MAJOR,
             RT_VERSION_MINOR, RT_VERSION_PATCH, demo);
    text_add(lines, "%d x %d\nsamples %d\nbounces %d\nsampler %s\nseed %llu\n",
             image->width, image->height, options->samples, options->bounces,
             options->sampler == RT_RANDOM ? "random" : "sobol",
             (unsigned long long)options->seed);
    text_add(lines, "half %s\nguides %s\ngiven %016llx\nscene %016llx\n",
             image->half ? "yes" : "no", image->guides ? "yes" : "no",
             (unsigned long long)given, (unsigned long long)scene);
}

/* The lines at the start of the file, up to the one that nobody knows before: the rays. */
static size_t head_of(const char *lines, const rt_image *part, char head[HEAD])
{
    demo_text text = text_in(head, HEAD);
    text_add(&text, "%sfirst %d\ncount %d\nrays ", lines, part->first, part->count);
    return text.used;
}

bool parts_write(const char *who, const char *path, const char *lines,
                 const rt_image *part)
{
    floats arrays[ARRAYS];
    const size_t bytes = 4 * arrays_of(part, arrays);
    char head[HEAD];
    unsigned char *file = malloc(HEAD + bytes + SUM);
    if (!file) {
        fprintf(stderr, "%s: cannot write '%s': not enough memory\n", who, path);
        return false;
    }
    head_of(lines, part, head);
    size_t used = (size_t)snprintf((char *)file, HEAD, "%s%llu\n", head,
                                   (unsigned long long)part->rays);
    for (int i = 0; i < ARRAYS; i++) {
        put_floats(arrays[i], file + used);
        used += 4 * arrays[i].count;
    }
    put_bits(parts_add(0, file, used), SUM, file + used);
    const bool good = files_write(who, path, file, used + SUM);
    free(file);
    return good;
}

/* The file; free it. NULL: it cannot be read, and errno says why. If it is longer than most bytes,
 * only so many are there, though size says its length. */
static unsigned char *load(const char *path, size_t most, size_t *size)
{
    platform_info info = {0, 0};
    const platform_kind kind = platform_look(path, &info);
    const size_t length = (size_t)info.size, wanted = length < most ? length : most;
    if (kind == A_FOLDER || kind == A_DEVICE)
        errno = kind == A_FOLDER ? EISDIR : EINVAL;
    FILE *file = kind == A_FILE ? platform_open(path, "rb") : NULL;
    unsigned char *bytes = file ? malloc(wanted + 1) : NULL;
    if (bytes) {
        const size_t got = fread(bytes, 1, wanted, file);
        *size = got < wanted ? got : length;
        bytes[got] = '\0';
        if (ferror(file)) {
            free(bytes);
            bytes = NULL;
        }
    }
    const int error = errno;
    if (file)
        fclose(file);
    errno = error;
    return bytes;
}

static const char letters[] = " .0123456789abcdefghijklmnopqrstuvwxyz"; /* of the lines */

/* The texts differ at this place: show the lines there. */
static void say_difference(const char *file, const char *head, size_t place,
                           demo_text *why)
{
    size_t line = place;
    while (line > 0 && head[line - 1] != '\n')
        line--;
    if (line == 0)
        text_add(why, "it is no part of a picture");
    else
        text_add(why, "it is another part, or of another picture: '%.*s' and not '%.*s'",
                 (int)strspn(file + line, letters), file + line,
                 (int)strcspn(head + line, "\n"), head + line);
}

/* The floats are there; are they light? */
static bool is_finite(floats f)
{
    for (size_t i = 0; i < f.count; i++)
        if (!(fabsf(f.at[i]) <= FLT_MAX))
            return false;
    return true;
}

static parts_state read_floats(const unsigned char *file, size_t size, size_t used,
                               rt_image *part, demo_text *why)
{
    floats arrays[ARRAYS];
    const size_t bytes = 4 * arrays_of(part, arrays);
    char *end;
    part->rays = strtoull((const char *)file + used, &end, 10);
    used = (size_t)((unsigned char *)end - file) + 1;
    const size_t wanted = used + bytes + SUM;
    if (size != wanted) {
        text_add(why, "it has %llu bytes instead of %llu", (unsigned long long)size,
                 (unsigned long long)wanted);
        return PART_DAMAGED;
    }
    if (parts_add(0, file, size - SUM) != get_bits(file + size - SUM, SUM)) {
        text_add(why, "it is damaged: its sum is wrong");
        return PART_DAMAGED;
    }
    for (int i = 0; i < ARRAYS; i++) {
        get_floats(arrays[i], file + used);
        used += 4 * arrays[i].count;
    }
    if (!is_finite(arrays[0]) || !is_finite(arrays[1])) {
        text_add(why, "it has pixels that are NaN or infinite");
        return PART_DAMAGED;
    }
    return PART_WHOLE;
}

parts_state parts_read(const char *path, const char *lines, rt_image *part,
                       demo_text *why)
{
    char head[HEAD];
    floats arrays[ARRAYS];
    const size_t length = head_of(lines, part, head);
    const size_t most = HEAD + 4 * arrays_of(part, arrays) + SUM;
    size_t size = 0, same = 0;
    errno = 0;
    unsigned char *file = load(path, most, &size);
    if (!file) {
        text_add(why, "%s", errno ? strerror(errno) : "not enough memory");
        return errno == ENOENT ? PART_MISSING : PART_OTHER;
    }
    while (same < size && same < length && file[same] == (unsigned char)head[same])
        same++;
    parts_state state;
    if (same == length) {
        state = read_floats(file, size, same, part, why);
    } else if (same == size) {
        text_add(why, "it ends after %llu bytes", (unsigned long long)size);
        state = PART_DAMAGED;
    } else {
        say_difference((const char *)file, head, same, why);
        state = PART_OTHER;
    }
    free(file);
    return state;
}

/* What the demos share; see demo.h. In this order: the command line, files, the state
 * of a run, progress, the window, demo_main. No ray tracing: the demo does that. */
#define _DEFAULT_SOURCE   /* winsize */
#define _DARWIN_C_SOURCE  /* the same on macOS */
#define _XOPEN_SOURCE 700 /* isatty, fileno, stat, sigaction, realpath */
#define RT_IMPLEMENTATION
#include "demo.h"

#include <errno.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/stat.h>
#include <unistd.h>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

enum { DONE = 0, FAILED = 1, WRONG_USE = 2, INTERRUPTED = 130 };

/* -------------------------------------------------------------------------------------
 * The command line
 * ------------------------------------------------------------------------------------- */

#define MAX_PIXELS 67108864 /* 8192 x 8192 */

typedef struct settings {
    long long width, height, bounces, threads, lanes, seed;
    long long samples;    /* 0: as many as error and seconds allow */
    float error, seconds; /* 0: not wanted */
    rt_sampler sampler;
    const char *out;
    bool window, preview, quiet, help, explain, denoise;
    long x, y; /* the pixel to explain */
} settings;

static void print_help(const demo *d)
{
    printf("%s - %s\n\n"
           "  build/%s [WIDTH HEIGHT] [options]        (default 640 480)\n"
           "  make %s ARGS=\"WIDTH HEIGHT options\"\n\n"
           "  --samples N   samples per pixel (default %d; with --error or --time no "
           "limit)\n"
           "  --error E     stop when the estimated error is E (0.01: one per cent)\n"
           "  --time S      stop after S seconds\n"
           "  --bounces N   how often a ray is sent on (default %d%s);\n"
           "                all: until nothing is left (from chapter 7)\n"
           "  --threads N   threads, 1 to 1024 (default 0: all cores)\n"
           "  --lanes N     rays at a time: 1, or all that this build has (default: %s)\n"
           "  --sampler S   random or sobol numbers (default %s)\n"
           "  --seed N      another seed, another noise (default 0)\n"
           "  --out FILE    where to write, .png or .pfm (default build/%s.png,\n"
           "                or %s.png where there is no folder build)\n"
           "  --explain X,Y only print what happens in this pixel (from chapter 7)\n"
           "  --denoise     finish the picture: chapter 10 (from chapter 7)\n"
           "  --no-window   only render and write\n"
           "  --preview     draw the picture in the terminal, too, as it refines\n"
           "  --quiet       print nothing but errors\n"
           "  --help        this\n\n"
           "In the window: h shows the keys; s saves, Esc or q ends. Ctrl-C saves what "
           "there is and ends.\n",
           d->name, d->title, d->name, d->name, d->samples, d->bounces,
           d->bounces == 0 ? "; this chapter has none yet" : "",
           d->render ? "as many as the machine can" : "1; this chapter has no more",
           d->sobol ? "sobol" : "random", d->name, d->name);
}

/* A whole number from low to high, digits only; otherwise one line that says so. */
static bool parse_number(const demo *d, const char *name, const char *text, long long low,
                         long long high, long long *value)
{
    bool good = text && *text && strspn(text, "0123456789") == strlen(text);
    if (good) {
        errno = 0;
        *value = strtoll(text, NULL, 10);
        good = errno == 0 && *value >= low && *value <= high;
    }
    if (!good && !text)
        fprintf(stderr, "%s: %s: a number is missing\n", d->name, name);
    else if (!good)
        fprintf(stderr, "%s: %s: '%s' is not a whole number from %lld to %lld\n", d->name,
                name, text, low, high);
    return good;
}

/* A decimal number above 0, digits and a point, whatever the locale says. */
static bool parse_decimal(const demo *d, const char *name, const char *text,
                          const char *what, float *value)
{
    bool good = text && strspn(text, "0123456789.") == strlen(text);
    if (good) {
        char *end;
        const double number = strtod(text, &end); /* nobody here calls setlocale */
        good = *end == '\0' && number <= (double)FLT_MAX && (float)number > 0.0f;
        *value = good ? (float)number : 0.0f;
    }
    if (!good && !text)
        fprintf(stderr, "%s: %s: a number is missing\n", d->name, name);
    else if (!good)
        fprintf(stderr, "%s: %s: '%s': the %s must be a decimal number above 0\n",
                d->name, name, text, what);
    return good;
}

/* Like parse_number, or all, where the demo's paths can end by roulette. */
static bool parse_bounces(const demo *d, const char *text, long long *value)
{
    if (!text || strcmp(text, "all") != 0)
        return parse_number(d, "--bounces", text, 0, INT_MAX - 1, value);
    if (!d->explain)
        fprintf(stderr, "%s: --bounces: 'all' is for chapter 7 and later\n", d->name);
    *value = RT_ALL_BOUNCES;
    return d->explain;
}

static bool parse_sampler(const demo *d, const char *text, rt_sampler *sampler)
{
    const bool random = text && strcmp(text, "random") == 0;
    const bool good = random || (text && strcmp(text, "sobol") == 0);
    if (good)
        *sampler = random ? RT_RANDOM : RT_SOBOL;
    else if (!text)
        fprintf(stderr, "%s: --sampler: a name is missing\n", d->name);
    else
        fprintf(stderr, "%s: --sampler: '%s' is not random or sobol\n", d->name, text);
    return good;
}

/* X,Y: column and row of a pixel. Whether it is in the picture is asked later. */
static bool parse_pixel(const demo *d, const char *text, settings *s)
{
    char *comma = NULL, *end = NULL;
    bool good = text && *text >= '0' && *text <= '9';
    if (good)
        s->x = strtol(text, &comma, 10);
    good = good && *comma == ',' && comma[1] >= '0' && comma[1] <= '9';
    if (good)
        s->y = strtol(comma + 1, &end, 10);
    s->explain = good && *end == '\0';
    if (!s->explain)
        fprintf(stderr, "%s: --explain: '%s' is not a pixel, X,Y\n", d->name,
                text ? text : "");
    return s->explain;
}

static bool parse(const demo *d, int argc, char **argv, settings *s)
{
    const struct {
        const char *name;
        long long low, high, *value;
    } numbers[] = {
        {"--samples", 1, INT_MAX, &s->samples},
        {"--threads", 0, 1024, &s->threads},
        {"--lanes", 0, 16, &s->lanes}, /* more about it below */
        {"--seed", 0, UINT32_MAX, &s->seed},
    };
    const size_t number_count = sizeof numbers / sizeof numbers[0];
    int positional = 0;
    for (int i = 1; i < argc; i++) {
        const char *arg = argv[i];
        size_t n = 0;
        while (n < number_count && strcmp(arg, numbers[n].name) != 0)
            n++;
        if (n < number_count) {
            if (!parse_number(d, arg, argv[++i], numbers[n].low, numbers[n].high,
                              numbers[n].value))
                return false;
        } else if (strcmp(arg, "--bounces") == 0) {
            if (!parse_bounces(d, argv[++i], &s->bounces))
                return false;
        } else if (strcmp(arg, "--error") == 0) {
            if (!parse_decimal(d, arg, argv[++i], "wanted error", &s->error))
                return false;
        } else if (strcmp(arg, "--time") == 0) {
            if (!parse_decimal(d, arg, argv[++i], "time in seconds", &s->seconds))
                return false;
        } else if (strcmp(arg, "--sampler") == 0) {
            if (!parse_sampler(d, argv[++i], &s->sampler))
                return false;
        } else if (strcmp(arg, "--explain") == 0) {
            if (!parse_pixel(d, argv[++i], s))
                return false;
        } else if (strcmp(arg, "--out") == 0) {
            s->out = argv[++i];
            if (!s->out)
                return fprintf(stderr, "%s: --out: a file name is missing\n", d->name),
                       false;
        } else if (strcmp(arg, "--no-window") == 0) {
            s->window = false;
        } else if (strcmp(arg, "--denoise") == 0) {
            s->denoise = true;
        } else if (strcmp(arg, "--preview") == 0) {
            s->preview = true;
        } else if (strcmp(arg, "--quiet") == 0) {
            s->quiet = true;
        } else if (strcmp(arg, "--help") == 0 || strcmp(arg, "-h") == 0) {
            s->help = true;
        } else if (arg[0] == '-' && (arg[1] < '0' || arg[1] > '9')) {
            fprintf(stderr, "%s: unknown option '%s' (--help lists them)\n", d->name,
                    arg);
            return false;
        } else if (positional == 2) {
            fprintf(stderr, "%s: '%s' is one argument too many\n", d->name, arg);
            return false;
        } else if (!parse_number(d, positional == 0 ? "WIDTH" : "HEIGHT", arg, 1,
                                 MAX_PIXELS, positional == 0 ? &s->width : &s->height)) {
            return false;
        } else {
            positional++;
        }
    }
    if (positional == 1)
        return fprintf(stderr, "%s: HEIGHT: a number is missing\n", d->name), false;
    if (s->width > MAX_PIXELS / s->height) {
        fprintf(stderr, "%s: %lld x %lld is too large: at most %d pixels in all\n",
                d->name, s->width, s->height, MAX_PIXELS);
        return false;
    }
    if (s->lanes > 0 && rt_lane_count((int)s->lanes) != s->lanes) {
        const int most = rt_lane_count(0);
        fprintf(stderr, "%s: --lanes: '%lld': this build has 1%s", d->name, s->lanes,
                most == 1 ? " only (was it compiled without -O?)\n" : "");
        if (most > 1)
            fprintf(stderr, " or %d\n", most);
        return false;
    }
    if (s->explain && (!d->explain || s->x >= s->width || s->y >= s->height)) {
        if (!d->explain)
            fprintf(stderr, "%s: --explain: chapter 7 and later can do that\n", d->name);
        else
            fprintf(stderr, "%s: --explain: %ld,%ld is not in a picture of %lld x %lld\n",
                    d->name, s->x, s->y, s->width, s->height);
        return false;
    }
    if (s->denoise && !d->explain)
        return fprintf(stderr, "%s: --denoise: chapter 7 and later can do that\n",
                       d->name),
               false;
    if (s->denoise && s->samples == 1)
        return fprintf(stderr, "%s: --samples: '1': --denoise takes 2 or more\n",
                       d->name),
               false;
    const char *dot = strrchr(s->out, '.');
    if (!dot || (strcmp(dot, ".png") != 0 && strcmp(dot, ".pfm") != 0)) {
        fprintf(stderr, "%s: --out: '%s' does not end in .png or .pfm\n", d->name,
                s->out);
        return false;
    }
    return true;
}

/* -------------------------------------------------------------------------------------
 * Files: written under another name and renamed when complete, so that an existing file is
 * either kept as it was or replaced by a whole new one.
 * ------------------------------------------------------------------------------------- */

static bool file_error(const demo *d, const char *path)
{
    fprintf(stderr, "%s: cannot write '%s': %s\n", d->name, path, strerror(errno));
    return false;
}

/* A new file in the folder of path, for rename; *name is to be freed. NULL, with errno, on
 * failure. */
static FILE *open_beside(const char *path, char **name)
{
    const char *slash = strrchr(path, '/');
    const int folder = slash ? (int)(slash - path) + 1 : 0;
    const size_t size = (size_t)folder + 32;
    FILE *file = NULL;
    *name = strlen(path) < INT_MAX ? malloc(size) : NULL;
    for (int i = 1; *name && !file && i < 100; i++) {
        snprintf(*name, size, "%.*s.rt-%d.part", folder, path, i);
        file = fopen(*name, "wbx"); /* x: never an existing file */
        if (!file && errno != EEXIST)
            break;
    }
    return file;
}

/* Devices and pipes are written in place; renaming would replace them by a file. */
static bool written_in_place(const char *path)
{
    struct stat info;
    return stat(path, &info) == 0 && !S_ISREG(info.st_mode) && !S_ISDIR(info.st_mode);
}

/* Said before the rendering, not after it. */
static bool can_write(const demo *d, const char *path)
{
    struct stat info;
    if (written_in_place(path))
        return true;
    if (stat(path, &info) == 0) {
        errno = EISDIR;
        if (S_ISDIR(info.st_mode))
            return file_error(d, path);
    } else if (errno != ENOENT) { /* a name that is too long, a file as folder */
        return file_error(d, path);
    }
    char *name;
    FILE *file = open_beside(path, &name);
    const bool good = file != NULL || file_error(d, path);
    if (good) {
        fclose(file);
        remove(name);
    }
    free(name);
    return good;
}

static bool write_file(const demo *d, const char *given, const void *bytes, size_t size)
{
    char *name = NULL, *real = realpath(given, NULL); /* behind a symbolic link */
    const char *path = real ? real : given;
    const bool in_place = written_in_place(path);
    FILE *file = in_place ? fopen(path, "wb") : open_beside(path, &name);
    bool good = file != NULL;
    if (good) {
        good = fwrite(bytes, 1, size, file) == size && fflush(file) == 0;
        const int error = errno;
        if (fclose(file) != 0)
            good = false;
        else
            errno = error;
        if (good && !in_place)
            good = rename(name, path) == 0;
        if (!good) {
            file_error(d, given);
            if (!in_place)
                remove(name);
        }
    } else {
        file_error(d, given);
    }
    free(name);
    free(real);
    return good;
}

/* -------------------------------------------------------------------------------------
 * A run: what was asked for, and how far it is
 * ------------------------------------------------------------------------------------- */

typedef struct run {
    const demo *d;
    settings s;
    demo_view view;
    rt_image image;
    rt_image clean; /* the same without noise, of so many samples; none: not yet there */
    float clean_error;    /* its estimated error; below 0: not yet known */
    unsigned char *bytes; /* the image encoded, 3 a pixel, for PNG and window */
    double started;       /* in seconds, like the others */
    double line_due;      /* when the progress line may be printed again */
    int quarters;         /* how many of the plain lines were printed */
    int preview_rows;     /* how many the preview has, once it is there */
    double draw_due;      /* when the window may be drawn again */
    struct window *win;   /* NULL: none */
    bool closed;          /* by Esc, q or the window's button */
} run;

static volatile sig_atomic_t interrupted; /* by Ctrl-C or SIGTERM; a second one kills */

static void interrupt(int signal)
{
    (void)signal;
    interrupted = 1;
}

static const char *plural(long long n)
{
    return n == 1 ? "" : "s";
}

/* "5 bounces" or "all bounces"; the text lasts until the next call. */
static const char *bounces_in_words(const run *r)
{
    static char text[40];
    const long long n = r->s.bounces;
    snprintf(text, sizeof text, n == RT_ALL_BOUNCES ? "all bounces" : "%lld bounce%s", n,
             plural(n));
    return text;
}

/* How many samples the image has, and, where it can be estimated, the error. */
static void describe(const rt_image *image, char *text, size_t size)
{
    const double error = (double)rt_image_error(image);
    const int n =
        snprintf(text, size, "%d sample%s", image->samples, plural(image->samples));
    if (error <= DBL_MAX)
        snprintf(text + n, size - (size_t)n, ", error %.2f %%", 100.0 * error);
    else if (image->half)
        snprintf(text + n, size - (size_t)n, ", error unknown");
}

/* Is this image what r->clean was made of? */
static bool is_clean(const run *r, const rt_image *image)
{
    const rt_image *clean = &r->clean;
    return clean->width == image->width && clean->samples == image->samples &&
           clean->done == image->done && clean->rays == image->rays;
}

/* What is to be saved. */
static const rt_image *picture(const run *r)
{
    return r->s.denoise && is_clean(r, &r->image) ? &r->clean : &r->image;
}

static unsigned char (*encoder(const run *r))(float value);

static void encode(run *r, const rt_image *image)
{
    unsigned char (*byte)(float value) = encoder(r);
    const rt_vec3 *pixels = image->pixels;
    const int width = image->width;
#ifdef _OPENMP
    const int threads = rt_thread_count((int)r->s.threads);
#pragma omp parallel for num_threads(threads)
#endif
    for (int y = 0; y < image->height; y++)
        for (int i = y * width; i < (y + 1) * width; i++) {
            r->bytes[3 * i + 0] = byte(pixels[i].x);
            r->bytes[3 * i + 1] = byte(pixels[i].y);
            r->bytes[3 * i + 2] = byte(pixels[i].z);
        }
}

/* PFM: linear floats, little endian (the -1), bottom row first. */
static bool save_pfm(const run *r)
{
    const int width = r->image.width, height = r->image.height;
    char head[64];
    const size_t head_size =
        (size_t)snprintf(head, sizeof head, "PF\n%d %d\n-1.0\n", width, height);
    const size_t size = head_size + (size_t)width * (size_t)height * 12;
    unsigned char *file = malloc(size);
    if (!file)
        return file_error(r->d, r->s.out);
    memcpy(file, head, head_size);
    unsigned char *p = file + head_size;
    for (int y = height - 1; y >= 0; y--)
        for (int i = y * width; i < (y + 1) * width; i++) {
            const rt_vec3 c = picture(r)->pixels[i];
            const float rgb[3] = {c.x, c.y, c.z};
            for (int k = 0; k < 3; k++) {
                uint32_t bits;
                memcpy(&bits, &rgb[k], 4);
                for (int shift = 0; shift < 32; shift += 8)
                    *p++ = (unsigned char)(bits >> shift);
            }
        }
    const bool good = write_file(r->d, r->s.out, file, size);
    free(file);
    return good;
}

static bool save_png(run *r)
{
    encode(r, picture(r));
    int size = 0;
    unsigned char *file = stbi_write_png_to_mem(
        r->bytes, 3 * r->image.width, r->image.width, r->image.height, 3, &size);
    if (!file) {
        errno = ENOMEM;
        return file_error(r->d, r->s.out);
    }
    const bool good = write_file(r->d, r->s.out, file, (size_t)size);
    free(file);
    return good;
}

/* How many pixels have a value that is NaN or infinite: a mistake in pixel(). */
static int bad_pixels(const rt_image *image)
{
    int count = 0;
    for (int i = 0; i < image->width * image->height; i++) {
        const rt_vec3 v = image->pixels[i];
        count +=
            !(fabsf(v.x) <= FLT_MAX && fabsf(v.y) <= FLT_MAX && fabsf(v.z) <= FLT_MAX);
    }
    return count;
}

static bool save(run *r)
{
    const int bad = bad_pixels(picture(r));
    if (bad > 0)
        fprintf(stderr, "%s: warning: %d of %d pixels are NaN or infinite\n", r->d->name,
                bad, r->image.width * r->image.height);
    return strcmp(strrchr(r->s.out, '.'), ".pfm") == 0 ? save_pfm(r) : save_png(r);
}

/* -------------------------------------------------------------------------------------
 * Progress: a bar on a terminal, else a plain line after every quarter
 * ------------------------------------------------------------------------------------- */

static bool on_terminal(void)
{
    const char *term = getenv("TERM");
    return isatty(fileno(stderr)) && (!term || strcmp(term, "dumb") != 0);
}

/* How many colours the terminal has: 0 (none, or no terminal), 256, or 2^24. */
static int terminal_colours(void)
{
    const char *term = getenv("TERM"), *colour = getenv("COLORTERM");
    if (!on_terminal() || !term)
        return 0;
    if ((colour && (strcmp(colour, "truecolor") == 0 || strcmp(colour, "24bit") == 0)) ||
        strstr(term, "-direct"))
        return 1 << 24;
    return strstr(term, "256color") ? 256 : 0;
}

/* The mean of the pixels in one of columns x rows parts of the image, as bytes. */
static void preview_colour(const run *r, int x, int y, int columns, int rows, int rgb[3])
{
    const int width = r->image.width, height = r->image.height;
    const int x0 = (int)((long long)x * width / columns);
    const int y0 = (int)((long long)y * height / rows);
    int x1 = (int)((long long)(x + 1) * width / columns);
    int y1 = (int)((long long)(y + 1) * height / rows);
    x1 = x1 > x0 ? x1 : x0 + 1;
    y1 = y1 > y0 ? y1 : y0 + 1;
    rt_vec3 sum = {0, 0, 0};
    for (int j = y0; j < y1; j++)
        for (int i = x0; i < x1; i++)
            sum = rt_add(sum, picture(r)->pixels[j * width + i]);
    const float part = 1.0f / (float)((x1 - x0) * (y1 - y0));
    rgb[0] = r->d->encode(part * sum.x);
    rgb[1] = r->d->encode(part * sum.y);
    rgb[2] = r->d->encode(part * sum.z);
}

/* The picture in half blocks: the upper half of a cell has the colour of the text, the lower
 * that of its background. Each row ends with the colours as they were, so there is nothing
 * to bring back when the program ends, in whatever way. */
static void print_preview(run *r)
{
    struct winsize size = {.ws_col = 80, .ws_row = 24};
    ioctl(fileno(stderr), TIOCGWINSZ, &size);
    int columns = size.ws_col > 1 ? size.ws_col - 1 : 1;
    const int most = size.ws_row > 3 ? size.ws_row - 3 : 1;
    int rows = (int)((double)columns * r->image.height / r->image.width / 2.0 + 0.5);
    if (rows > most) {
        rows = most;
        const double fitting = 2.0 * rows * r->image.width / r->image.height;
        columns = fitting < columns ? (int)(fitting + 0.5) : columns;
    }
    rows = rows > 0 ? rows : 1;
    columns = columns > 0 ? columns : 1;
    const bool all = terminal_colours() > 256;
    if (r->preview_rows == rows)
        fprintf(stderr, "\r\033[%dA", rows);
    r->preview_rows = rows;
    for (int y = 0; y < rows; y++) {
        fprintf(stderr, "\r\033[K");
        for (int x = 0; x < columns; x++) {
            int c[6];
            preview_colour(r, x, 2 * y, columns, 2 * rows, c);
            preview_colour(r, x, 2 * y + 1, columns, 2 * rows, c + 3);
            if (all)
                fprintf(stderr, "\033[38;2;%d;%d;%d;48;2;%d;%d;%dm\xe2\x96\x80", c[0],
                        c[1], c[2], c[3], c[4], c[5]);
            else /* the nearest of 6 x 6 x 6 */
                fprintf(stderr, "\033[38;5;%d;48;5;%dm\xe2\x96\x80",
                        16 + 36 * ((c[0] + 25) / 51) + 6 * ((c[1] + 25) / 51) +
                            (c[2] + 25) / 51,
                        16 + 36 * ((c[3] + 25) / 51) + 6 * ((c[4] + 25) / 51) +
                            (c[5] + 25) / 51);
        }
        fprintf(stderr, "\033[0m\n");
    }
}

static void print_progress(run *r, double part)
{
    const double now = demo_seconds();
    if (r->s.quiet)
        return;
    if (r->s.preview && (now >= r->line_due || part >= 1.0)) {
        print_preview(r);
        r->line_due = 0.0;
    }
    if (on_terminal()) {
        if (now < r->line_due)
            return;
        r->line_due = now + 0.1;
        char bar[31];
        for (int i = 0; i < 30; i++)
            bar[i] = i < (int)(30.0 * part) ? '#' : '.';
        bar[30] = '\0';
        fprintf(stderr, "\r\033[K[%s] %3.0f %%, ", bar, 100.0 * part);
        if (r->s.samples == 0 && part < 0.01) /* too early to tell */
            fprintf(stderr, "%d sample%s ", r->image.samples, plural(r->image.samples));
        else
            fprintf(stderr, "%.0f s left ", (now - r->started) * (1.0 - part) / part);
    } else if (part < 1.0 && (int)(4.0 * part) > r->quarters) {
        r->quarters = (int)(4.0 * part);
        fprintf(stderr, "%d %%\n", 25 * r->quarters);
    }
}

static void end_progress(const run *r)
{
    if (!r->s.quiet && on_terminal())
        fprintf(stderr, "\r\033[K");
}

/* -------------------------------------------------------------------------------------
 * A clean picture: chapter 10
 * ------------------------------------------------------------------------------------- */

/* What denoising needs, for an image of this size; false: not enough memory. */
static bool add_guides(rt_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    if (!image->half)
        image->half = calloc(count, sizeof *image->half);
    if (!image->guides)
        image->guides = calloc(count, sizeof *image->guides);
    return image->half && image->guides;
}

static rt_vec3 *new_pixels(int width, int height)
{
    return calloc((size_t)width * (size_t)height, sizeof(rt_vec3));
}

/* Finish an image into r->clean, if that has not been done yet. */
static rt_status denoise(run *r, const rt_image *image,
                         rt_status (*finish)(const rt_image *image, int threads,
                                             rt_image *result))
{
    rt_image *clean = &r->clean;
    if (!clean->pixels)
        clean->pixels = new_pixels(r->image.width, r->image.height);
    if (!clean->pixels)
        return RT_NO_MEMORY;
    if (is_clean(r, image))
        return RT_OK;
    clean->width = image->width;
    clean->height = image->height;
    r->clean_error = -1.0f;
    return finish(image, (int)r->s.threads, clean);
}

/* It takes a while, so once for a picture. */
static float clean_error(run *r)
{
    if (r->clean_error < 0.0f)
        r->clean_error = rt_denoised_error(&r->image, (int)r->s.threads);
    return r->clean_error;
}

/* The picture that is to be saved, by the demo's own function if it has one. */
static rt_status denoise_picture(run *r)
{
    r->clean.samples = 0;
    return denoise(r, &r->image, r->d->finish ? r->d->finish : rt_denoise);
}

#include "window.h"

/* Called by rt_render_pixels every few milliseconds. */
static bool progress(void *user, float part)
{
    run *r = user;
    if (!r->win || !r->win->disturbed)
        print_progress(r, (double)part);
    return r->win ? window_progress(r) : !interrupted;
}

/* -------------------------------------------------------------------------------------
 * The whole program
 * ------------------------------------------------------------------------------------- */

demo_renderer *const demo_rt_render = rt_render;

double demo_seconds(void)
{
    return (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

unsigned char demo_linear(float value)
{
    return rt_encode(value, 1.0);
}

unsigned char demo_gamma(float value)
{
    return rt_encode(value, 2.2);
}

static void print_job(const run *r)
{
    const settings *s = &r->s;
    const int threads = rt_thread_count((int)s->threads);
    printf("%s: %lld x %lld, ", r->d->name, s->width, s->height);
    if (s->samples == 0)
        printf("as many samples as it takes");
    else
        printf("%s%lld sample%s", s->error > 0.0f || s->seconds > 0.0f ? "at most " : "",
               s->samples, plural(s->samples));
    if (s->error > 0.0f)
        printf(", until the error is %g %%", 100.0 * (double)s->error);
    if (s->seconds > 0.0f)
        printf(", for %g s at most", (double)s->seconds);
    printf(", %s, %d thread%s", bounces_in_words(r), threads, plural(threads));
    if (r->d->render)
        printf(", %d at a time", rt_lane_count((int)s->lanes));
    printf("\n");
    fflush(stdout);
}

static rt_options options_of(run *r)
{
    return (rt_options){.samples = (int)r->s.samples,
                        .bounces = (int)r->s.bounces,
                        .threads = (int)r->s.threads,
                        .seed = (uint32_t)r->s.seed,
                        .progress = progress,
                        .user = r,
                        .sampler = r->s.sampler,
                        .error = r->s.error,
                        .seconds = r->s.seconds,
                        .lanes = (int)r->s.lanes};
}

static rt_status render(run *r, const rt_options *options)
{
    rt_image *image = &r->image;
    const int begun = image->samples;
    const rt_status status = render_own(r, options, image);
    if (r->d->render || !r->s.denoise || image->samples == begun)
        return status;
    /* These pixels have no guides. rt.h looks for them, with the same numbers. */
    rt_image same = {.width = image->width, .height = image->height};
    rt_options again = *options;
    again.samples = image->samples;
    again.error = again.seconds = 0.0f;
    again.progress = NULL;
    same.guides = image->guides;
    same.pixels = new_pixels(image->width, image->height);
    same.half = new_pixels(image->width, image->height);
    const bool good = same.pixels && same.half;
    const rt_status looked =
        good ? r->d->live->render(7, &r->view, &again, &same) : RT_NO_MEMORY;
    free(same.pixels);
    free(same.half);
    return looked == RT_OK ? status : looked;
}

/* What denoising has done to the pixel. */
static rt_status explain_denoising(run *r, rt_options options)
{
    const int i = (int)(r->s.y * r->s.width + r->s.x);
    options.progress = NULL;
    rt_status status = render(r, &options);
    if (status == RT_OK)
        status = denoise_picture(r);
    if (status != RT_OK)
        return status;
    const rt_guide *g = &r->image.guides[i];
    const rt_vec3 noisy = r->image.pixels[i], clean = r->clean.pixels[i];
    const struct {
        const char *name;
        rt_vec3 value;
    } lines[] = {
        {"normal", g->normal},
        {"point", g->point},
        {"albedo", g->albedo},
        {"direct light, kept", g->direct},
        {"light of others, noisy", rt_sub(noisy, g->direct)},
        {"light of others, finished", rt_sub(clean, g->direct)},
        {"pixel, noisy", noisy},
        {"pixel, finished", clean},
    };
    printf("denoising, with the guides of all samples\n");
    for (size_t k = 0; k < sizeof lines / sizeof lines[0]; k++)
        printf("  %-26s (%.6g, %.6g, %.6g)\n", lines[k].name, (double)lines[k].value.x,
               (double)lines[k].value.y, (double)lines[k].value.z);
    return RT_OK;
}

static int explain(run *r)
{
    rt_options options = options_of(r);
    if (options.samples == 0)
        options.samples = r->d->samples;
    if (!r->s.quiet)
        printf("%s: pixel %ld,%ld of %lld x %lld, %d sample%s, %s\n", r->d->name, r->s.x,
               r->s.y, r->s.width, r->s.height, options.samples, plural(options.samples),
               bounces_in_words(r));
    rt_status status = r->d->explain(&options, &r->image, (int)r->s.x, (int)r->s.y);
    if (status == RT_OK && r->s.denoise)
        status = explain_denoising(r, options);
    if (status != RT_OK)
        fprintf(stderr, "%s: %s\n", r->d->name, rt_status_text(status));
    return status == RT_OK ? DONE : FAILED;
}

/* The picture that the command line wanted is done, or was interrupted, or failed. */
static bool finish(run *r, rt_status status, double took)
{
    end_progress(r);
    if (status != RT_OK && status != RT_CANCELLED)
        return fprintf(stderr, "%s: %s\n", r->d->name, rt_status_text(status)), false;
    double finishing = demo_seconds();
    if (r->s.denoise && r->image.samples >= 2)
        status = denoise_picture(r) == RT_OK ? status : RT_NO_MEMORY;
    finishing = demo_seconds() - finishing;
    if (status == RT_NO_MEMORY)
        return fprintf(stderr, "%s: %s\n", r->d->name, rt_status_text(status)), false;
    if (r->s.preview && !r->s.quiet && picture(r) == &r->clean)
        print_preview(r);
    if (!save(r))
        return false;
    if (!r->s.quiet) {
        char result[100];
        describe(&r->image, result, sizeof result);
        printf("%s: %.2f s, %s, %.1f million rays per second, ", r->d->name, took, result,
               (double)r->image.rays / took * 1e-6);
        if (picture(r) == &r->clean)
            printf("finished in %.2f s: error at most %.2f %%, ", finishing,
                   100.0 * (double)clean_error(r));
        printf("wrote %s%s\n", r->s.out, status == RT_CANCELLED ? " (interrupted)" : "");
    }
    fflush(stdout);
    return true;
}

static int render_and_save(run *r)
{
    if (!r->s.quiet)
        print_job(r);
    r->started = demo_seconds();
    bool good;
    if (r->win) {
        good = run_window(r);
    } else {
        const rt_options options = options_of(r);
        const rt_status status = render(r, &options);
        good = finish(r, status, demo_seconds() - r->started);
    }
    return !good ? FAILED : interrupted ? INTERRUPTED : DONE;
}

#if defined(__x86_64__) && defined(__GNUC__)
/* Compiled for more than this machine has (-march=native, and then copied)? Asked before
 * main, in plain x86-64, as main itself may use what is not there. */
__attribute__((constructor, target("arch=x86-64"))) static void check_machine(void)
{
    const char *lacks = NULL;
    __builtin_cpu_init();
#ifdef __AVX2__
    lacks = __builtin_cpu_supports("avx2") ? lacks : "AVX2";
#endif
#ifdef __AVX512F__
    lacks = __builtin_cpu_supports("avx512f") ? lacks : "AVX-512";
#endif
    if (lacks) {
        fprintf(stderr,
                "compiled for a machine with %s, which this one lacks: make -B "
                "MACHINE= makes a program for any\n",
                lacks);
        exit(FAILED);
    }
}
#endif

int demo_main(int argc, char **argv, const demo *d)
{
    char out[64];
    struct stat info;
    const bool at_the_top = stat("build", &info) == 0 && S_ISDIR(info.st_mode);
    snprintf(out, sizeof out, "%s%s.png", at_the_top ? "build/" : "", d->name);
    run r = {.d = d,
             .s = {.width = 640,
                   .height = 480,
                   .bounces = d->bounces,
                   .sampler = d->sobol ? RT_SOBOL : RT_RANDOM,
                   .denoise = d->denoise,
                   .out = out,
                   .window = true}};
    if (!parse(d, argc, argv, &r.s))
        return WRONG_USE;
    if (r.s.help) {
        print_help(d);
        return fflush(stdout) == 0 ? DONE : FAILED;
    }
    if (!r.s.explain && !can_write(d, r.s.out))
        return FAILED;
    if (r.s.preview && terminal_colours() == 0) {
        if (!r.s.quiet)
            printf("%s: --preview: this is no terminal with colours\n", d->name);
        r.s.preview = false;
    }
    if (d->bounces == 0 && r.s.bounces > 0 && !r.s.quiet)
        printf("%s: this chapter has no bounces yet, --bounces changes nothing\n",
               d->name);
    if (!d->render && r.s.lanes > 0 && !r.s.quiet)
        printf("%s: this chapter traces one ray at a time, --lanes changes nothing\n",
               d->name);
    if (r.s.samples == 0 && r.s.error == 0.0f && r.s.seconds == 0.0f)
        r.s.samples = d->samples;

    const size_t count = (size_t)r.s.width * (size_t)r.s.height;
    r.image.width = (int)r.s.width;
    r.image.height = (int)r.s.height;
    r.view = (demo_view){r.image.width, r.image.height, (int)r.s.bounces};
    r.image.pixels = calloc(count, sizeof *r.image.pixels);
    r.bytes = malloc(count * 3);
    const bool guided = !r.s.denoise || add_guides(&r.image);
    const bool estimate = d->estimate || r.s.error > 0.0f;
    if (estimate && !r.image.half)
        r.image.half = calloc(count, sizeof *r.image.half);
    const bool many = r.s.samples == 0 || r.s.samples > 1000;
    if (many) /* their means need more digits; half may come later */
        r.image.rest = calloc(2 * count, sizeof *r.image.rest);
    const bool good = r.image.pixels && r.bytes && guided &&
                      (r.image.half || !estimate) && (r.image.rest || !many);
    int result = FAILED;
    if (good && r.s.explain) {
        result = explain(&r);
    } else if (good) {
        if (d->measure && !r.s.quiet)
            d->measure(rt_thread_count((int)r.s.threads));
        struct sigaction action = {.sa_handler = interrupt};
        action.sa_flags = (int)SA_RESETHAND;
        sigaction(SIGINT, &action, NULL);
        sigaction(SIGTERM, &action, NULL);
        signal(SIGPIPE, SIG_IGN); /* a closed pipe is an error like others, not the end */
        if (r.s.window)
            open_window(&r);
        /* The title says the error. With random numbers the picture is the same. */
        if (r.win && r.s.sampler == RT_RANDOM && !r.image.half)
            r.image.half = calloc(count, sizeof *r.image.half);
        result = render_and_save(&r);
        if (r.win)
            close_window(&r);
    } else {
        fprintf(stderr, "%s: not enough memory for %lld x %lld pixels\n", d->name,
                r.s.width, r.s.height);
    }
    free(r.image.pixels);
    free(r.image.half);
    free(r.image.rest);
    free(r.image.guides);
    free(r.clean.pixels);
    free(r.bytes);
    if (ferror(stdout) || fflush(stdout) != 0) {
        fprintf(stderr, "%s: cannot write to standard output\n", d->name);
        result = FAILED;
    }
    return result;
}

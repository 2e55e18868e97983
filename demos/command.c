/* The command line of the demos: see command.h. */
#include "command.h"

#include <errno.h>
#include <stdlib.h>
#include <string.h>

void command_help(const demo *d)
{
    printf("%s - %s\n\n"
           "  build/%s [WIDTH HEIGHT] [options]        (default 640 480)\n"
           "  make %s ARGS=\"WIDTH HEIGHT options\"\n\n"
           "  --samples N   samples per pixel (default %d; with --error or --time no "
           "limit)\n"
           "  --error E     stop when the estimated error is E (0.01: one per cent)\n"
           "  --time S      stop after S seconds\n"
           "  --bounces N   how often a ray is sent on (default %d%s);\n"
           "                all: until no light is left (from chapter 7)\n"
           "  --threads N   threads, 1 to 1024 (default 0: all cores)\n"
           "  --lanes N     rays at a time: 1, or all that this build has (default: %s)\n"
           "  --sampler S   random or sobol numbers (default %s)\n"
           "  --seed N      another seed gives other noise (default 0)\n"
           "  --out FILE    where to write, .png or .pfm (default build/%s.png,\n"
           "                or %s.png where there is no folder build)\n"
           "  --explain X,Y only print what happens in this pixel\n"
           "  --denoise     take out the noise at the end: chapter 10 (from chapter 7);\n"
           "                from chapter 10 the default; --no-denoise turns it off\n"
           "  --exposure EV brighter by EV stops, each twice the light; below 0 darker\n"
           "%s%s"
           "  --part K/N    only part K of N, in a file beside that of --out\n"
           "  --part all/N  all parts that are not there yet, one after the other\n"
           "  --join N      make the picture from its N parts, without rendering\n"
           "  --no-window   only render and write\n"
           "  --preview     draw the picture in the terminal, too, as it refines\n"
           "  --quiet       print nothing but errors\n"
           "  --help        print this list\n\n"
           "In the window: h shows the keys; s saves, Esc or q ends. Ctrl-C saves what "
           "there is and ends.\n",
           d->name, d->title, d->name, d->name, d->samples, d->bounces,
           d->bounces == 0 ? "; this chapter has none yet" : "",
           d->render ? "as many as possible" : "1; this chapter has only one",
           d->sobol ? "sobol" : "random", d->name, d->name,
           d->texture ? "  --texture FILE a picture for the ball, PNG or JPEG\n" : "",
           d->mesh ? "  --mesh FILE   your mesh as the teapot: OBJ, PLY, STL, glTF\n"
                   : "");
}

/* Chapter 7 and later: paths of more than one bounce, by chance. */
static bool has_paths(const demo *d)
{
    return d->stage >= 7;
}

/* A whole number from low to high, digits only; otherwise one line that says so. */
static bool parse_number(const demo *d, const char *name, const char *word, long long low,
                         long long high, long long *value)
{
    bool good = word && *word && strspn(word, "0123456789") == strlen(word);
    if (good) {
        errno = 0;
        *value = strtoll(word, NULL, 10);
        good = errno == 0 && *value >= low && *value <= high;
    }
    if (!good && !word)
        fprintf(stderr, "%s: %s: a number is missing\n", d->name, name);
    else if (!good)
        fprintf(stderr, "%s: %s: '%s' is not a whole number from %lld to %lld\n", d->name,
                name, word, low, high);
    return good;
}

/* Read digits and a point as a number, whatever the locale says. */
static bool read_decimal(const char *digits, double *number)
{
    char *end = NULL;
    if (digits && *digits && strspn(digits, "0123456789.") == strlen(digits))
        *number = strtod(digits, &end); /* nobody here calls setlocale */
    return end && *end == '\0';
}

/* A decimal number above 0. */
static bool parse_decimal(const demo *d, const char *name, const char *word,
                          const char *what, float *value)
{
    double number = 0.0;
    const bool good =
        read_decimal(word, &number) && number <= (double)FLT_MAX && (float)number > 0.0f;
    *value = good ? (float)number : 0.0f;
    if (!good && !word)
        fprintf(stderr, "%s: %s: a number is missing\n", d->name, name);
    else if (!good)
        fprintf(stderr, "%s: %s: '%s': the %s must be a decimal number above 0\n",
                d->name, name, word, what);
    return good;
}

/* A decimal number with or without a sign, -20 to 20. */
static bool parse_exposure(const demo *d, const char *word, float *value)
{
    const bool sign = word && (*word == '-' || *word == '+');
    double number = 0.0;
    const bool good = read_decimal(sign ? word + 1 : word, &number) && number <= 20.0;
    *value = good ? (float)(sign && *word == '-' ? -number : number) : 0.0f;
    if (!good && !word)
        fprintf(stderr, "%s: --exposure: a number is missing\n", d->name);
    else if (!good)
        fprintf(stderr, "%s: --exposure: '%s' is not a number of stops, -20 to 20\n",
                d->name, word);
    return good;
}

/* Like parse_number, or all, where the demo's paths can end by roulette. */
static bool parse_bounces(const demo *d, const char *word, long long *value)
{
    if (!word || strcmp(word, "all") != 0)
        return parse_number(d, "--bounces", word, 0, INT_MAX - 1, value);
    if (!has_paths(d))
        fprintf(stderr, "%s: --bounces: 'all' is for chapter 7 and later\n", d->name);
    *value = RT_ALL_BOUNCES;
    return has_paths(d);
}

static bool parse_sampler(const demo *d, const char *word, rt_sampler *sampler)
{
    const bool random = word && strcmp(word, "random") == 0;
    const bool good = random || (word && strcmp(word, "sobol") == 0);
    if (good)
        *sampler = random ? RT_RANDOM : RT_SOBOL;
    else if (!word)
        fprintf(stderr, "%s: --sampler: a name is missing\n", d->name);
    else
        fprintf(stderr, "%s: --sampler: '%s' is not random or sobol\n", d->name, word);
    return good;
}

/* X,Y: column and row of a pixel. Whether it is in the picture is checked later. */
static bool parse_pixel(const demo *d, const char *word, settings *s)
{
    char *comma = NULL, *end = NULL;
    bool good = word && *word >= '0' && *word <= '9';
    if (good)
        s->x = strtol(word, &comma, 10);
    good = good && *comma == ',' && comma[1] >= '0' && comma[1] <= '9';
    if (good)
        s->y = strtol(comma + 1, &end, 10);
    s->explain = good && *end == '\0';
    if (!s->explain)
        fprintf(stderr, "%s: --explain: '%s' is not a pixel, X,Y\n", d->name,
                word ? word : "");
    return s->explain;
}

/* K/N, with K from 1 to N, or all/N. */
static bool parse_part(const demo *d, const char *word, settings *s)
{
    const bool all = word && strncmp(word, "all/", 4) == 0;
    const size_t k = all ? 3 : word ? strspn(word, "0123456789") : 0;
    const bool good = k > 0 && word[k] == '/' && word[k + 1] != '\0' &&
                      strspn(word + k + 1, "0123456789") == strlen(word + k + 1);
    if (good) {
        s->part = all ? ALL_PARTS : strtoll(word, NULL, 10);
        s->parts = strtoll(word + k + 1, NULL, 10);
    }
    if (good && s->part != 0 && s->part <= s->parts && s->parts >= 1 &&
        s->parts <= COMMAND_PIXELS)
        return true;
    fprintf(stderr,
            "%s: --part: '%s' is not K/N, a part of so many: 1/4 to 4/4, or all/4\n",
            d->name, word ? word : "");
    return false;
}

/* What goes together with parts? */
static bool check_parts(const demo *d, const settings *s)
{
    const char *name = s->part != 0 ? "--part" : "--join", *why = NULL;
    if (s->parts == 0)
        return true;
    if (s->error > 0.0f || s->seconds > 0.0f)
        why = "not with --error or --time, by which each part would have other samples";
    else if (s->explain)
        why = "not with --explain";
    else if (s->part != 0 && s->preview)
        why = "not with --preview";
    else if (s->parts > s->width * s->height)
        why = "there are more parts than pixels";
    if (why)
        fprintf(stderr, "%s: %s: %s\n", d->name, name, why);
    return !why;
}

bool command_parse(const demo *d, int argc, char **argv, settings *s)
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
        } else if (strcmp(arg, "--part") == 0 || strcmp(arg, "--join") == 0) {
            if (s->parts > 0)
                return fprintf(stderr, "%s: %s: one part or one join at a time\n",
                               d->name, arg),
                       false;
            if (arg[2] == 'p'
                    ? !parse_part(d, argv[++i], s)
                    : !parse_number(d, arg, argv[++i], 1, COMMAND_PIXELS, &s->parts))
                return false;
        } else if (strcmp(arg, "--error") == 0) {
            if (!parse_decimal(d, arg, argv[++i], "wanted error", &s->error))
                return false;
        } else if (strcmp(arg, "--time") == 0) {
            if (!parse_decimal(d, arg, argv[++i], "time in seconds", &s->seconds))
                return false;
        } else if (strcmp(arg, "--exposure") == 0) {
            if (!parse_exposure(d, argv[++i], &s->exposure))
                return false;
        } else if (strcmp(arg, "--texture") == 0) {
            s->texture = argv[++i];
            if (!s->texture || !d->texture) {
                fprintf(stderr, "%s: --texture: %s\n", d->name,
                        s->texture ? "only chapter 15 can do that"
                                   : "a file name is missing");
                return false;
            }
        } else if (strcmp(arg, "--mesh") == 0) {
            s->mesh = argv[++i];
            if (!s->mesh || !d->mesh) {
                fprintf(stderr, "%s: --mesh: %s\n", d->name,
                        s->mesh ? "only chapters 16 and 17 can do that"
                                : "a file name is missing");
                return false;
            }
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
            s->denoise = s->told_to_denoise = true;
        } else if (strcmp(arg, "--no-denoise") == 0) {
            s->denoise = false;
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
                                 COMMAND_PIXELS,
                                 positional == 0 ? &s->width : &s->height)) {
            return false;
        } else {
            positional++;
        }
    }
    if (positional == 1)
        return fprintf(stderr, "%s: HEIGHT: a number is missing\n", d->name), false;
    if (s->width > COMMAND_PIXELS / s->height) {
        fprintf(stderr, "%s: %lld x %lld is too large: at most %d pixels in all\n",
                d->name, s->width, s->height, COMMAND_PIXELS);
        return false;
    }
    if (s->lanes > 0 && rt_lane_count((int)s->lanes) != s->lanes) {
        const int most = rt_lane_count(0);
        fprintf(stderr, "%s: --lanes: '%lld': this build has 1%s", d->name, s->lanes,
                most == 1 ? " only (compiled without -O?)\n" : "");
        if (most > 1)
            fprintf(stderr, " or %d\n", most);
        return false;
    }
    if (s->explain && (s->x >= s->width || s->y >= s->height)) {
        fprintf(stderr, "%s: --explain: %ld,%ld is not in a picture of %lld x %lld\n",
                d->name, s->x, s->y, s->width, s->height);
        return false;
    }
    if (s->denoise && !has_paths(d))
        return fprintf(stderr, "%s: --denoise: chapter 7 and later can do that\n",
                       d->name),
               false;
    if (s->denoise && s->samples == 1 && !s->told_to_denoise)
        s->denoise = false;
    if (s->denoise && s->samples == 1)
        return fprintf(stderr, "%s: --samples: '1': --denoise needs 2 or more\n",
                       d->name),
               false;
    if (!check_parts(d, s))
        return false;
    const char *dot = strrchr(s->out, '.');
    if (!dot || (strcmp(dot, ".png") != 0 && strcmp(dot, ".pfm") != 0)) {
        fprintf(stderr, "%s: --out: '%s' does not end in .png or .pfm\n", d->name,
                s->out);
        return false;
    }
    return true;
}

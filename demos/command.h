/* The command line of the demos. */
#ifndef COMMAND_H
#define COMMAND_H

#include "demo.h"

enum { COMMAND_PIXELS = 67108864 /* at most: 8192 x 8192 */, ALL_PARTS = -1 };

typedef struct settings {
    long long width, height, bounces, threads, lanes, seed;
    long long samples;    /* 0: as many as error and seconds allow */
    float error, seconds; /* 0: not wanted */
    float exposure;       /* in stops */
    rt_sampler sampler;
    const char *out, *texture, *mesh; /* files; NULL: none */
    long long part, parts; /* render part of so many parts, or ALL_PARTS of them; with
                              part 0, join them; 0, 0: neither */
    bool window, preview, quiet, help, explain, denoise;
    bool told_to_denoise; /* not only by default */
    long x, y;            /* the pixel to explain */
} settings;

/* Put what the words say into settings, which hold the defaults. False: a word is wrong,
 * and one line has said so. */
bool command_parse(const demo *d, int argc, char **argv, settings *s);
void command_help(const demo *d);

#endif

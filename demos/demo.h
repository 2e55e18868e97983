/* What a demo is. main.c is the program around it, viewer.h what the reader can do with
 * its picture. There is no ray tracing here.
 *
 * A demo supplies the colour of one point of the film, or renders the whole image, and
 * demo_main does the rest. */
#ifndef DEMO_H
#define DEMO_H

#include "../rt.h"
#include "text.h"

/* What pixel() may want to know about the picture. */
typedef struct demo_view {
    int width, height; /* in pixels */
    int bounces;
} demo_view;

/* A line of the ray inspector, in the room. */
typedef enum demo_kind {
    LINE_ROOM, /* outlines of the things */
    LINE_CAMERA,
    LINE_DIFFUSE, /* sent on by a matt surface, and by a mirror */
    LINE_MIRROR,
    LINE_NORMAL,
    LINE_LIT, /* to the lamp, and what is behind something on the way */
    LINE_BLOCKED,
    LINE_GLOSS, /* part two: sent on by a gloss; and by glass, or through it */
    LINE_GLASS,
    LINE_KINDS
} demo_kind;

typedef struct demo_line {
    rt_vec3 from, to;
    demo_kind kind;
    float weight; /* 0 to 1: how much of the light from here arrives */
} demo_line;

typedef struct demo_lines {
    demo_line *lines; /* memory for so many: */
    int most, count;
} demo_lines;

/* The name of a thing in the room, to stand in the plan: on it, or, if it is small, below it. */
typedef struct demo_label {
    rt_vec3 at;
    const char *name;
    bool below;
} demo_label;

/* The linear colour seen through the point (x, y) of the film. */
typedef rt_vec3 demo_pixel(const demo_view *view, float x, float y, rt_rng *rng);

/* One sample of a picture, to be explained. */
typedef struct demo_sample {
    int stage;
    const demo_view *view;
    const rt_options *options;
    const rt_image *image;
    int x, y, number;
    demo_pixel *own; /* the demo's function, if the picture is made by it; else NULL */
} demo_sample;

/* What the viewer can do with the scene of a demo; live.h gives it to the demos. */
enum {
    DEMO_STATE = 256, /* bytes, at most, for save */
    DEMO_LABELS = 16
};

/* The columns of the table that tells a path. */
enum {
    COLUMN_POINT,
    COLUMN_MEETS,
    COLUMN_PLACE, /* on a mesh */
    COLUMN_T,
    COLUMN_NORMAL,
    COLUMN_LAMP,
    COLUMN_GOES_ON,
    COLUMN_THROUGHPUT,
    COLUMN_ADDS,
    DEMO_COLUMNS
};

typedef struct demo_live {
    /* Render one of its pictures, see viewer_chapter; and only the direct light in it,
     * quickly. */
    rt_status (*render)(int stage, const demo_view *view, const rt_options *options,
                        rt_image *image);
    rt_status (*draft)(int stage, const demo_view *view, const rt_options *options,
                       rt_image *image);
    /* Call it before rendering pixels in another way: it puts what has moved in its
     * place. */
    void (*prepare)(int stage);
    /* The byte for one channel of a pixel of that picture. */
    unsigned char (*encode)(int stage, float value);
    /* Move the camera around the room, sideways, nearer by a factor; reset all that moves. */
    void (*orbit)(float right_turns, float up_turns);
    void (*pan)(const demo_view *view, float right_pixels, float up_pixels);
    void (*zoom)(float factor);
    void (*reset)(void);
    /* The thing under the point (x, y) of the film, 0 for none; its name; and move it. */
    int (*pick)(int stage, const demo_view *view, float x, float y);
    const char *(*name)(int thing);
    void (*drag)(int thing, const demo_view *view, float right_pixels, float up_pixels,
                 bool over_the_floor);
    /* By the wheel, change something else about the thing: the lamp's size, the ball's
     * gloss. False: there is nothing to change. Then say in words what it is now. */
    bool (*tune)(int stage, int thing, float notches);
    void (*say)(int stage, int thing, demo_text *out);
    /* C code that brings this view back. */
    void (*print)(demo_text *out);
    /* The things in the room, for a plan of it from above or from the side: lines, and their
     * names, of which it returns how many there are. */
    void (*outlines)(int stage, const demo_view *view, demo_lines *lines);
    int (*labels)(int stage, bool side, demo_label labels[DEMO_LABELS]);
    /* The path of a sample, and the sample's value: lines for the plan; a table, a row for each
     * point, after one with the names of the columns; and in words, as --explain has it. (NULL:
     * not wanted.) A row ends with a new line, a cell with a tab, unless it is the last. A cell
     * begins with the digit of the demo_kind whose colour belongs to it, or with 0. */
    rt_status (*path)(const demo_sample *sample, demo_lines *lines, demo_text *table,
                      demo_text *words, rt_vec3 *value);
    /* Save all that moves to memory, and load it; the number of bytes, at most
     * DEMO_STATE. */
    size_t (*save)(void *to);
    void (*load)(const void *from);
} demo_live;

typedef struct demo {
    const char *name;  /* "demo05": the picture goes to build/demo05.png */
    const char *title; /* for the window and --help */

    demo_pixel *pixel; /* is called on several threads */

    /* Or, in its place: add samples to the image, as rt_render does. */
    rt_status (*render)(const rt_options *options, rt_image *image);

    /* For --denoise: what finishes the picture; NULL: rt_denoise. */
    rt_status (*finish)(const rt_image *image, int threads, rt_image *result);

    /* For --part all/N: the number of the next part, from 1; first: nobody has asked
     * here yet. NULL: one after the other. */
    int (*next_part)(bool first);

    /* NULL, or what the demo measures and prints before its picture, unless --quiet. */
    void (*measure)(int threads);

    const demo_live *live; /* NULL: a window in which nothing moves; */
    int stage;             /* otherwise which of its pictures is the demo's */

    /* NULL, or takes the picture of --texture: linear, row by row from the top. It
     * stays. */
    void (*texture)(const rt_vec3 *pixels, int width, int height);

    /* NULL, or takes the mesh of --mesh. It stays. */
    void (*mesh)(const rt_mesh *mesh);

    /* The byte for one channel of a pixel: demo_linear, demo_gamma or the demo's own. */
    unsigned char (*encode)(float value);

    int samples;   /* per pixel, unless the command line says otherwise */
    int bounces;   /* likewise; 0: this chapter has no bounces yet */
    bool sobol;    /* likewise: chapter 9's numbers; false: chapter 7's random ones */
    bool estimate; /* say how large the error is, even if --error does not ask */
    bool denoise;  /* likewise, finish the picture */
} demo;

/* For encode: the byte in proportion to the light, and the byte that a screen wants. */
unsigned char demo_linear(float value);
unsigned char demo_gamma(float value);

/* Seconds since some moment. */
double demo_seconds(void);

/* The whole program: returns the exit status, 0 done, 1 failed, 2 wrong use, 130 Ctrl-C. */
int demo_main(int argc, char **argv, const demo *d);

#endif

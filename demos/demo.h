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

/* What the viewer can do with the scene of a demo; live.h gives it to the demos. */
enum { DEMO_STATE = 256 }; /* bytes, at most, for save */

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
    /* Lines: the things in the room; and the path of one sample of the pixel (x, y), which
     * is told in words, too, in short and as --explain does (NULL: not wanted). */
    int (*outlines)(int stage, const demo_view *view, demo_line *lines, int most);
    int (*path)(int stage, const demo_view *view, const rt_options *options,
                const rt_image *image, int x, int y, int sample, demo_line *lines,
                int most, demo_text *summary, demo_text *words);
    /* The paths of all samples of the pixel, and their mean, to stdout. */
    rt_status (*explain)(int stage, const rt_options *options, const rt_image *image,
                         int x, int y);
    /* Save all that moves to memory, and load it; the number of bytes, at most
     * DEMO_STATE. */
    size_t (*save)(void *to);
    void (*load)(const void *from);
} demo_live;

typedef struct demo {
    const char *name;  /* "demo05": the picture goes to build/demo05.png */
    const char *title; /* for the window and --help */

    /* The linear colour seen through the point (x, y) of the film; on several threads. */
    rt_vec3 (*pixel)(const demo_view *view, float x, float y, rt_rng *rng);

    /* Or, in its place: add samples to the image, as rt_render does. */
    rt_status (*render)(const rt_options *options, rt_image *image);

    /* For --denoise: what finishes the picture; NULL: rt_denoise. */
    rt_status (*finish)(const rt_image *image, int threads, rt_image *result);

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

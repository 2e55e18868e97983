/* What the nine demos share: command line, window, progress, files. No ray tracing here.
 *
 * A demo supplies the colour of one point of the film, or renders the whole image, and
 * demo_main does the rest. */
#ifndef DEMO_H
#define DEMO_H

#include "../rt.h"

/* What pixel() may want to know about the picture. */
typedef struct demo_view {
    int width, height; /* in pixels */
    int bounces;
} demo_view;

typedef struct demo {
    const char *name;  /* "demo05": the picture goes to build/demo05.png */
    const char *title; /* for the window and --help */

    /* The linear colour seen through the point (x, y) of the film; on several threads. */
    rt_vec3 (*pixel)(const demo_view *view, float x, float y, rt_rng *rng);

    /* Or, in its place: add samples to the image, as rt_render does. */
    rt_status (*render)(const rt_options *options, rt_image *image);

    /* NULL, or what the demo measures and prints before its picture, unless --quiet. */
    void (*measure)(int threads);

    /* NULL, or what --explain prints about the pixel (x, y). */
    rt_status (*explain)(const rt_options *options, const rt_image *image, int x, int y);

    /* The byte for one channel of a pixel: demo_linear, demo_gamma or the demo's own. */
    unsigned char (*encode)(float value);

    int samples;   /* per pixel, unless the command line says otherwise */
    int bounces;   /* likewise; 0: this chapter has no bounces yet */
    bool sobol;    /* likewise: chapter 9's numbers; false: chapter 7's random ones */
    bool estimate; /* say how large the error is, even if --error does not ask */
} demo;

/* For encode: the byte in proportion to the light, and the byte that a screen wants. */
unsigned char demo_linear(float value);
unsigned char demo_gamma(float value);

/* Seconds since some moment. */
double demo_seconds(void);

/* The whole program: returns the exit status, 0 done, 1 failed, 2 wrong use, 130 Ctrl-C. */
int demo_main(int argc, char **argv, const demo *d);

#endif

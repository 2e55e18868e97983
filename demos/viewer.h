/* What the reader does with the picture of a demo: it refines, its things move, it is compared
 * with others, and one of its pixels is explained. All of that lives here, and knows no window,
 * no page, no file and no rays: a shell (window.c, page.c) hands on pointer and keys, and draws
 * pixels and lines; the demo's demo_live traces (see demo.h). */
#ifndef VIEWER_H
#define VIEWER_H

#include "demo.h"

/* The pictures: chapter 1 to 7, then those of part two, 11 to 17. */
enum { VIEWER_INDIRECT = 7, VIEWER_STAGES = 14 };

/* What to compare with. */
typedef enum viewer_comparison {
    BEFORE, /* the chapter before */
    ONE_SAMPLE,
    BY_RT_H,       /* rt.h's own function in place of the demo's */
    OTHER_NUMBERS, /* random in place of Sobol's, or these in place of random */
    NOISY,         /* without denoising */
    COMPARISONS
} viewer_comparison;

/* What there is to be done next, until something happens. */
typedef enum viewer_task {
    NOTHING,
    DRAW_A_DRAFT, /* viewer_draft: something moves */
    REST,         /* a little, before it is rendered in earnest: until viewer.rests */
    REFINE        /* viewer_refine */
} viewer_task;

/* Keys are their characters; and those that have none: */
enum { KEY_LEFT = 256, KEY_RIGHT, KEY_UP, KEY_DOWN, KEY_NEARER, KEY_FARTHER };

enum { BUTTON_NONE, BUTTON_MAIN, BUTTON_OTHER };

typedef struct viewer {
    const demo *d;
    demo_view view;
    rt_options options; /* as the command line wants; bounces, lanes, threads and sampler
                           also as the reader does */
    rt_options first;   /* as they were, for r */
    bool denoise, denoise_first;
    rt_image image;
    rt_image other;    /* to compare with */
    rt_image draft;    /* while something moves */
    rt_image clean;    /* without noise, of so many samples; none: not yet there */
    float clean_error; /* its estimated error; below 0: not yet known */

    int stage;   /* 1 to VIEWER_STAGES */
    float gamma; /* of the bytes; 0: as the chapter has it */
    float first_exposure;
    float exposure; /* in stops: light counts 2^exposure times before it becomes bytes */
    int samples;    /* that the picture is to have */
    viewer_comparison comparison;
    bool hold;              /* the other picture is shown */
    bool inspect, side;     /* a path is shown, from the side and not from above */
    int x, y, sample;       /* whose path */
    bool help, glass;       /* shown over the picture, too */
    float mouse_x, mouse_y; /* in the picture, in its pixels */
    float slack;            /* pointers tremble: so far is no movement yet */

    bool finished;           /* the command line's picture is there, and written */
    bool disturbed;          /* what is shown is no longer that picture */
    bool changed;            /* what is seen has changed, so the pictures are void */
    bool stop;               /* let the rendering stop: something else is to be done */
    bool redraw;             /* let the shell draw, soon */
    bool closed, save, tell; /* what else was asked for: tell about the pixel in words */
    double rests;            /* until then, after a movement */
    double rendered, refining; /* seconds, for the rays of the image; since when */
    int shrink;                /* the draft is so many halves smaller, 2 to 8 */
    int drafts;                /* so far, and for so many seconds */
    double drafts_took;
    int button, thing; /* what is held by the pointer */
    int tuned;         /* the thing that the wheel has changed last */
    bool dragged;      /* since the button went down: it will be no click */
    float down_x, down_y;
} viewer;

/* A picture of this size, as the options want it. False: not enough memory. */
bool viewer_open(viewer *v, const demo *d, int width, int height,
                 const rt_options *options, bool denoise);
/* More that is needed where somebody looks at it. */
bool viewer_show(viewer *v);
void viewer_close(viewer *v);

/* The picture that the command line wants, by the demo itself. */
rt_status viewer_render(viewer *v, const rt_options *options);
/* Finish it into v->clean, by the demo's own function if it has one. */
rt_status viewer_finish(viewer *v);
/* What is to be saved: finished, if that is wanted and done. */
const rt_image *viewer_picture(const viewer *v);
float viewer_clean_error(viewer *v); /* it takes a while, so once for a picture */

/* ---- what happens; points are in the pixels of the picture ------------------------- */

void viewer_press(viewer *v, float x, float y, int button);
void viewer_move(viewer *v, float x, float y, bool over_the_floor);
void viewer_release(viewer *v);
void viewer_wheel(viewer *v, float notches);
void viewer_key(viewer *v, int key, bool repeated);
void viewer_key_up(viewer *v, int key);
/* The same as by a key, but to a given value: for sliders. */
void viewer_set_stage(viewer *v, int stage);
void viewer_set_samples(viewer *v, int samples);
void viewer_set_bounces(viewer *v, int bounces);
void viewer_set_exposure(viewer *v, float stops);
void viewer_inspect(viewer *v, int x, int y);
/* Move a thing, or 0, the camera, by one step. */
void viewer_nudge(viewer *v, int thing, float right, float up, bool over_the_floor);
/* Its gloss, size or whatever it has, more or less of it; if it has nothing, the camera comes
 * nearer. */
void viewer_tune(viewer *v, int thing, float notches);

/* ---- what is to be done ------------------------------------------------------------- */

viewer_task viewer_next(viewer *v, double now);
void viewer_begin_anew(viewer *v); /* before the draft */
void viewer_draft(viewer *v);
/* So long it took, and its drawing: sets the size of the next. */
void viewer_draft_took(viewer *v, double seconds);
/* What an image lacks, of half and guides. False: not enough memory. */
bool viewer_add_memory(rt_image *image, bool half, bool guides);
/* As many samples as are missing, or until progress returns false. */
rt_status viewer_refine(viewer *v, bool (*progress)(void *user, float part), void *user);
/* So many samples to an image of ours, or a part of it. */
rt_status viewer_add_samples(const viewer *v, bool other, const rt_options *options,
                             rt_image *image);

/* ---- what is to be seen ------------------------------------------------------------- */

bool viewer_is_draft(const viewer *v);
bool viewer_shows_other(const viewer *v); /* or has noise only to be left in? */
bool viewer_is_denoised(const viewer *v);
bool viewer_has_lanes(const viewer *v); /* or is it traced one ray at a time? */
/* The image to draw, finished if need be. */
const rt_image *viewer_shown(viewer *v);
/* Its bytes, so many for each pixel: 3, or 4 with opacity. other: of the one to compare with. */
void viewer_encode(const viewer *v, bool other, const rt_image *image, int channels,
                   unsigned char *bytes);
/* In a few words: how far it is, and how fast. error: of the image, see rt_image_error. */
void viewer_say_progress(viewer *v, const rt_image *shown, float error, double now,
                         demo_text *out);
/* How many samples, and, where it can be estimated, the error. */
void viewer_say_samples(const rt_image *image, float error, demo_text *out);
int viewer_chapter(int stage);               /* which chapter's picture it is */
const char *viewer_stage_name(int stage);    /* "shadows" */
const char *viewer_bounces(const viewer *v); /* "5 bounces"; until the next call */
const char *viewer_comparison_name(viewer_comparison comparison);
/* What stage it is, in words: "4 shadows (the demo's), held: one sample". */
void viewer_say_stage(const viewer *v, demo_text *out);

/* A line of the plan. None leaves it. */
typedef struct viewer_line {
    float x0, y0, x1, y1, width;
    demo_kind kind;
} viewer_line;

/* A name in the plan, about the point (x, y). */
typedef struct viewer_label {
    float x, y;
    const char *name;
} viewer_label;

/* The room from above (x to the right, z down) or from the side (z to the right, y up), as large as
 * width x height allows, with the path of the sample that is inspected. */
enum { VIEWER_LINES = 1000 };
typedef struct viewer_plan {
    float width, height, letter; /* given: the last is the height of the names' letters */
    int line_count, label_count;
    viewer_line lines[VIEWER_LINES];
    viewer_label labels[DEMO_LABELS];
} viewer_plan;

/* Draw the plan of the path, and tell it: a line that says which sample it is and its value, and
 * the table of demo_live's path. */
void viewer_draw_plan(const viewer *v, viewer_plan *plan, demo_text *table);
/* The same path in words, as --explain has it. */
rt_status viewer_explain(const viewer *v, demo_text *out, rt_vec3 *value);
/* The byte for one channel of a pixel. */
unsigned char viewer_byte(const viewer *v, int stage, float value);
const char *viewer_kind_name(demo_kind kind); /* for the legend; "": none */

/* The pixel under the pointer: linear, and encoded to these bytes. */
void viewer_say_pixel(const viewer *v, const rt_image *shown, const unsigned char *bytes,
                      demo_text *out);

const char *viewer_plural(long long n);

#endif

/* The demos in a web page: what main.c and window.c are on a desk. It is compiled with a demo to one
 * WebAssembly module, and docs/live/live.js calls what is exported here.
 *
 * The page has one instance, whose viewer hears pointer and keys and says what is to be done. Each
 * of its workers has another: it is told what is to be seen (page_wish, page_obey) and renders some
 * parts of the picture. No memory is shared. Times are in seconds, points in pixels. */
#include "viewer.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

#define EXPORT(name) __attribute__((export_name(#name))) name

enum { PART = 4096, MOST_WORDS_SHOWN = 1 << 14 };

/* A part of the picture, or of the one to compare with. */
typedef struct part {
    rt_image image;
    double squares, sum; /* for the error: see rt_image_error */
} part;

static viewer v;
static part *parts[2];       /* of the picture; of the other one */
static unsigned char *bytes; /* of what was encoded last, 4 a pixel */
static viewer_plan plan;
static char words[MOST_WORDS_SHOWN];

double demo_seconds(void)
{
    struct timespec now;
    timespec_get(&now, TIME_UTC);
    return (double)now.tv_sec + 1e-9 * (double)now.tv_nsec;
}

int main(int argc, char **argv); /* the demo's; it calls this: */

static const demo *the_demo;
static int picture_width, picture_height;

int demo_main(int argc, char **argv, const demo *d)
{
    (void)argc, (void)argv;
    static demo kept; /* its own is gone when main returns */
    kept = *d;
    the_demo = &kept;
    const rt_options options = {.samples = d->samples,
                                .bounces = d->bounces,
                                .sampler = d->sobol ? RT_SOBOL : RT_RANDOM};
    return viewer_open(&v, the_demo, picture_width, picture_height, &options,
                       d->denoise) &&
                   viewer_show(&v)
               ? 0
               : 1;
}

/* 0: all is well; 1: not enough memory. */
int EXPORT(page_start)(int width, int height)
{
    const size_t count = (size_t)width * (size_t)height;
    picture_width = width;
    picture_height = height;
    const size_t part_count = (count - 1) / PART + 1;
    bytes = calloc(count, 4);
    parts[0] = calloc(part_count, sizeof *parts[0]);
    parts[1] = calloc(part_count, sizeof *parts[1]);
    if (!bytes || !parts[0] || !parts[1] || main(0, NULL) != 0)
        return 1;
    v.disturbed = true; /* there is no command line */
    v.changed = true;   /* a draft comes first, */
    v.shrink = 4;       /* and a small one, as nobody knows yet how fast it is here */
    return 0;
}

/* -------------------------------------------------------------------------------------
 * What is to be seen
 * ------------------------------------------------------------------------------------- */

/* All that a worker has to know. Plain numbers, the same in every instance. */
static struct wish {
    int stage, comparison, denoise, shrink, bounces, lanes, sampler;
    float gamma, exposure;
    unsigned char room[DEMO_STATE];
} wish;

struct wish *EXPORT(page_wish)(void)
{
    wish.stage = v.stage;
    wish.comparison = (int)v.comparison;
    wish.denoise = v.denoise;
    wish.shrink = v.shrink;
    wish.bounces = v.options.bounces;
    wish.lanes = v.options.lanes;
    wish.sampler = (int)v.options.sampler;
    wish.gamma = v.gamma;
    wish.exposure = v.exposure;
    the_demo->live->save(wish.room);
    return &wish;
}

int EXPORT(page_wish_size)(void)
{
    return (int)sizeof wish;
}

/* The wish, written to page_wish(), is what this instance shows from now on. */
void EXPORT(page_obey)(void)
{
    v.stage = wish.stage;
    v.comparison = (viewer_comparison)wish.comparison;
    v.denoise = wish.denoise != 0;
    v.shrink = wish.shrink;
    v.options.bounces = v.view.bounces = wish.bounces;
    v.options.lanes = wish.lanes;
    v.options.sampler = (rt_sampler)wish.sampler;
    v.gamma = wish.gamma;
    v.exposure = wish.exposure;
    the_demo->live->load(wish.room);
}

int EXPORT(page_stage)(void)
{
    return v.stage;
}

int EXPORT(page_chapter)(int stage)
{
    return viewer_chapter(stage);
}

const char *EXPORT(page_stage_name)(int stage)
{
    return viewer_stage_name(stage);
}

float EXPORT(page_exposure)(void)
{
    return v.exposure;
}

int EXPORT(page_samples)(void)
{
    return v.samples;
}

int EXPORT(page_bounces)(void)
{
    return v.options.bounces;
}

int EXPORT(page_lanes)(void)
{
    return viewer_has_lanes(&v) ? rt_lane_count(v.options.lanes) : 1;
}

int EXPORT(page_sobol)(void)
{
    return v.options.sampler == RT_SOBOL;
}

int EXPORT(page_denoises)(void)
{
    return viewer_is_denoised(&v);
}

int EXPORT(page_inspects)(void)
{
    return v.inspect;
}

/* Which sample. */
int EXPORT(page_x)(void)
{
    return v.x;
}

int EXPORT(page_y)(void)
{
    return v.y;
}

int EXPORT(page_sample)(void)
{
    return v.sample;
}

/* For sliders and the like; keys do the same. */
void EXPORT(page_set_stage)(int stage)
{
    viewer_set_stage(&v, stage);
}

void EXPORT(page_set_samples)(int samples)
{
    viewer_set_samples(&v, samples);
}

void EXPORT(page_set_bounces)(int bounces)
{
    viewer_set_bounces(&v, bounces);
}

void EXPORT(page_set_exposure)(float stops)
{
    viewer_set_exposure(&v, stops);
}

void EXPORT(page_set_gamma)(float gamma)
{
    v.gamma = gamma;
}

void EXPORT(page_set_comparison)(int comparison)
{
    v.comparison = (viewer_comparison)comparison;
}

/* -------------------------------------------------------------------------------------
 * Pointer and keys
 * ------------------------------------------------------------------------------------- */

void EXPORT(page_press)(float x, float y, int button, float slack)
{
    v.slack = slack;
    viewer_press(&v, x, y, button);
}

void EXPORT(page_move)(float x, float y, int over_the_floor)
{
    viewer_move(&v, x, y, over_the_floor != 0);
}

void EXPORT(page_release)(void)
{
    viewer_release(&v);
}

/* It is no click, and no drag any more. */
void EXPORT(page_let_go)(void)
{
    v.button = BUTTON_NONE;
}

void EXPORT(page_key)(int key)
{
    viewer_key(&v, key, false);
}

/* The thing's size, gloss or whatever it has; of the camera, how near it is. */
void EXPORT(page_tune)(int thing, float notches)
{
    viewer_tune(&v, thing, notches);
}

/* What the thing is now, if it can be tuned. */
const char *EXPORT(page_thing)(int thing)
{
    static char words[80];
    demo_text out = text_in(words, sizeof words);
    the_demo->live->say(v.stage, thing, &out);
    return words;
}

int EXPORT(page_pick)(float x, float y)
{
    return the_demo->live->pick(v.stage, &v.view, x, y);
}

/* Move a thing without a pointer; 0 is the camera. */
void EXPORT(page_nudge)(int thing, float right, float up, int over_the_floor)
{
    viewer_nudge(&v, thing, right, up, over_the_floor != 0);
}

/* -------------------------------------------------------------------------------------
 * What is to be done: in the page ...
 * ------------------------------------------------------------------------------------- */

int EXPORT(page_next)(double now)
{
    return (int)viewer_next(&v, now);
}

double EXPORT(page_rests)(void)
{
    return v.rests;
}

/* Before a draft: the pictures so far are void. Those of the workers; here there are none. */
void EXPORT(page_begin_anew)(void)
{
    rt_image_clear(&v.image);
    rt_image_clear(&v.clean);
    v.changed = false;
}

void EXPORT(page_draft_took)(double seconds)
{
    viewer_draft_took(&v, seconds);
}

/* The workers have so many samples of the picture. */
void EXPORT(page_progress)(int samples, double rays, double rendered)
{
    v.image.samples = samples;
    v.image.rays = (uint64_t)rays;
    v.rendered = rendered;
}

/* -------------------------------------------------------------------------------------
 * ... and in a worker
 * ------------------------------------------------------------------------------------- */

/* The draft, encoded. */
const unsigned char *EXPORT(page_draft)(void)
{
    viewer_draft(&v);
    v.rests = 1.0; /* so that it is what is shown */
    viewer_encode(&v, false, viewer_shown(&v), 4, bytes);
    return bytes;
}

int EXPORT(page_draft_width)(void)
{
    return v.draft.width;
}

int EXPORT(page_draft_height)(void)
{
    return v.draft.height;
}

static bool allot(rt_image *image, int number)
{
    const int all = picture_width * picture_height, first = number * PART;
    image->width = picture_width;
    image->height = picture_height;
    image->first = first;
    image->count = all - first < PART ? all - first : PART;
    image->pixels = calloc((size_t)image->count, sizeof *image->pixels);
    return image->pixels != NULL;
}

/* The part begins anew. */
void EXPORT(page_forget)(int number, int other)
{
    part *p = &parts[other][number];
    if (p->image.pixels)
        rt_image_clear(&p->image);
    p->squares = p->sum = 0.0;
}

/* What rt_image_error wants to know of all parts. */
static void measure(part *p)
{
    p->squares = p->sum = 0.0;
    for (int i = 0; i < p->image.count; i++) {
        const rt_vec3 mean = p->image.pixels[i];
        p->sum += (double)mean.x + (double)mean.y + (double)mean.z;
        if (p->image.half) {
            const rt_vec3 e = rt_sub(p->image.half[i], mean);
            p->squares += (double)e.x * (double)e.x + (double)e.y * (double)e.y +
                          (double)e.z * (double)e.z;
        }
    }
}

/* Add a sample to a part; its bytes, or NULL if there is not enough memory. */
const unsigned char *EXPORT(page_refine)(int number, int other)
{
    part *p = &parts[other][number];
    rt_image *image = &p->image;
    if (!image->pixels && !allot(image, number))
        return NULL;
    /* As the command line: the samples of chapter 8 are not in halves. */
    const bool halves = the_demo->estimate || v.options.sampler == RT_RANDOM ||
                        viewer_is_denoised(&v) || other;
    if (image->samples == 0 && !viewer_add_memory(image, halves, viewer_is_denoised(&v)))
        return NULL;
    rt_options options = v.options;
    options.samples = 1;
    if (viewer_add_samples(&v, other != 0, &options, image) != RT_OK)
        return NULL;
    measure(p);
    viewer_encode(&v, other != 0, image, 4, bytes);
    return bytes;
}

/* The part, encoded once more: gamma has changed. */
const unsigned char *EXPORT(page_encode)(int number, int other)
{
    rt_image *image = &parts[other][number].image;
    if (image->pixels || allot(image, number))
        viewer_encode(&v, other != 0, image, 4, bytes);
    return bytes;
}

double EXPORT(page_rays)(int number, int other)
{
    return (double)parts[other][number].image.rays;
}

double EXPORT(page_squares)(int number, int other)
{
    return parts[other][number].squares;
}

double EXPORT(page_sum)(int number, int other)
{
    return parts[other][number].sum;
}

/* -------------------------------------------------------------------------------------
 * Finishing: one worker gets the parts of all
 * ------------------------------------------------------------------------------------- */

/* Where the pixels, means of every second sample and guides of a part are; the whole picture's for
 * number -1. NULL: it has none. */
static const rt_image *image_of(int number)
{
    if (number < 0)
        viewer_add_memory(&v.image, true, true);
    return number < 0 ? &v.image : &parts[0][number].image;
}

const void *EXPORT(page_pixels)(int number)
{
    return image_of(number)->pixels;
}

const void *EXPORT(page_half)(int number)
{
    return image_of(number)->half;
}

const void *EXPORT(page_guides)(int number)
{
    return image_of(number)->guides;
}

int EXPORT(page_guide_size)(void)
{
    return (int)sizeof(rt_guide);
}

/* The whole picture has been put together, of so many samples: finish it. Its bytes, or NULL. */
const unsigned char *EXPORT(page_finish)(int samples)
{
    v.image.samples = samples;
    v.clean.samples = 0;
    v.rests = 0.0;
    const rt_image *shown = viewer_shown(&v);
    if (shown != &v.clean)
        return NULL;
    viewer_encode(&v, false, shown, 4, bytes);
    return bytes;
}

/* Of what was finished last; it takes twice as long. */
float EXPORT(page_finished_error)(void)
{
    return viewer_clean_error(&v);
}

/* -------------------------------------------------------------------------------------
 * Words and lines; a text lasts until the next one
 * ------------------------------------------------------------------------------------- */

/* error: of the picture with its noise; of so many samples it was finished, 0: not yet. */
const char *EXPORT(page_say_progress)(double error, int finished, double finished_error)
{
    demo_text out = text_in(words, sizeof words);
    v.clean.samples = finished;
    v.clean.rays = v.image.rays;
    v.clean_error = (float)finished_error;
    viewer_say_progress(&v, finished > 0 ? &v.clean : &v.image, (float)error, 0.0, &out);
    return words;
}

/* The path of a sample of the pixel, from above or from the side: it returns the number of lines
 * that page_lines() has; page_label() has names; page_table() tells the path. */
int EXPORT(page_plan)(float width, float height, float letter, int side)
{
    demo_text table = text_in(words, sizeof words);
    v.side = side != 0;
    plan.width = width;
    plan.height = height;
    plan.letter = letter;
    viewer_draw_plan(&v, &plan, &table);
    return plan.line_count;
}

const viewer_line *EXPORT(page_lines)(void)
{
    return plan.lines;
}

int EXPORT(page_labels)(void)
{
    return plan.label_count;
}

const char *EXPORT(page_label)(int number)
{
    return plan.labels[number].name;
}

float EXPORT(page_label_x)(int number)
{
    return plan.labels[number].x;
}

float EXPORT(page_label_y)(int number)
{
    return plan.labels[number].y;
}

const char *EXPORT(page_table)(void)
{
    return words;
}

/* The same path as --explain tells it. */
const char *EXPORT(page_explain)(void)
{
    demo_text out = text_in(words, sizeof words);
    rt_vec3 value;
    viewer_explain(&v, &out, &value);
    return words;
}

const char *EXPORT(page_kind)(int kind)
{
    return viewer_kind_name((demo_kind)kind);
}

const char *EXPORT(page_comparison)(int comparison)
{
    return viewer_comparison_name((viewer_comparison)comparison);
}

void EXPORT(page_inspect)(int x, int y, int sample)
{
    viewer_inspect(&v, x, y);
    v.sample = sample;
}

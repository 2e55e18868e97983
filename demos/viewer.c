/* What the reader does with a picture: see viewer.h. In this order: memory, the picture that the
 * command line wants, what is to be shown, pointer and keys, what is to be done, words, lines. */
#define RT_IMPLEMENTATION
#include "viewer.h"

#include <stdlib.h>
#include <string.h>

unsigned char demo_linear(float value)
{
    return rt_encode(value, 1.0);
}

unsigned char demo_gamma(float value)
{
    return rt_encode(value, 2.2);
}

/* -------------------------------------------------------------------------------------
 * Memory
 * ------------------------------------------------------------------------------------- */

static size_t pixel_count(const rt_image *image)
{
    return image->count > 0 ? (size_t)image->count
                            : (size_t)image->width * (size_t)image->height;
}

static rt_vec3 *new_pixels(const rt_image *image)
{
    return calloc(pixel_count(image), sizeof(rt_vec3));
}

static bool add_half(rt_image *image)
{
    if (!image->half)
        image->half = new_pixels(image);
    return image->half != NULL;
}

/* What denoising needs. */
static bool add_guides(rt_image *image)
{
    if (!image->guides)
        image->guides = calloc(pixel_count(image), sizeof *image->guides);
    return image->guides && add_half(image);
}

bool viewer_add_memory(rt_image *image, bool half, bool guides)
{
    return (!half || add_half(image)) && (!guides || add_guides(image));
}

static void free_image(rt_image *image)
{
    free(image->pixels);
    free(image->half);
    free(image->rest);
    free(image->guides);
    memset(image, 0, sizeof *image);
}

/* All black, with what memory it has. */
static void forget(rt_image *image)
{
    const size_t count = pixel_count(image);
    memset(image->pixels, 0, count * sizeof *image->pixels);
    if (image->half)
        memset(image->half, 0, count * sizeof *image->half);
    if (image->guides)
        memset(image->guides, 0, count * sizeof *image->guides);
    rt_image_clear(image);
}

static int wanted_samples(const viewer *v)
{
    return v->options.samples > 0 ? v->options.samples : v->d->samples;
}

bool viewer_open(viewer *v, const demo *d, int width, int height,
                 const rt_options *options, bool denoise)
{
    memset(v, 0, sizeof *v);
    v->d = d;
    v->view = (demo_view){width, height, options->bounces};
    v->options = v->first = *options;
    v->denoise = v->denoise_first = denoise;
    v->image.width = v->other.width = v->draft.width = width;
    v->image.height = v->other.height = v->draft.height = height;
    v->stage = v->d->stage;
    v->samples = wanted_samples(v);
    v->comparison = denoise ? NOISY : BEFORE;
    v->shrink = 2;
    v->slack = 4.0f;
    v->image.pixels = new_pixels(&v->image);
    bool good = v->image.pixels != NULL;
    if (denoise)
        good = add_guides(&v->image) && good;
    if (d->estimate || options->error > 0.0f)
        good = add_half(&v->image) && good;
    if (options->samples == 0 || options->samples > 1000) {
        /* their means need more digits; half may come later */
        v->image.rest = calloc(2 * pixel_count(&v->image), sizeof *v->image.rest);
        good = good && v->image.rest;
    }
    if (!good)
        viewer_close(v);
    return good;
}

bool viewer_show(viewer *v)
{
    v->other.pixels = new_pixels(&v->other);
    v->draft.pixels = new_pixels(&v->draft);
    if (v->d->live)
        v->d->live->reset();
    /* With random numbers the picture is the same with half, and its error is known. */
    return v->other.pixels && v->draft.pixels &&
           (v->options.sampler != RT_RANDOM || add_half(&v->image));
}

void viewer_close(viewer *v)
{
    free_image(&v->image);
    free_image(&v->other);
    free_image(&v->draft);
    free_image(&v->clean);
}

/* -------------------------------------------------------------------------------------
 * The picture that the command line wants
 * ------------------------------------------------------------------------------------- */

typedef struct own_pixel {
    const demo *d;
    const demo_view *view;
} own_pixel;

static rt_vec3 call_pixel(const void *context, float x, float y, rt_rng *rng)
{
    const own_pixel *own = context;
    return own->d->pixel(own->view, x, y, rng);
}

/* By the demo itself. */
static rt_status render_own(const viewer *v, const demo_view *view,
                            const rt_options *options, rt_image *image)
{
    const own_pixel own = {v->d, view};
    if (v->d->live)
        v->d->live->prepare(v->d->stage);
    return v->d->render ? v->d->render(options, image)
                        : rt_render_pixels(call_pixel, &own, options, image);
}

rt_status viewer_render(viewer *v, const rt_options *options)
{
    rt_image *image = &v->image;
    const int begun = image->samples;
    const rt_status status = render_own(v, &v->view, options, image);
    if (v->d->render || !v->denoise || image->samples == begun)
        return status;
    /* These pixels have no guides. rt.h looks for them, with the same numbers. */
    rt_image same = {.width = image->width,
                     .height = image->height,
                     .first = image->first,
                     .count = image->count};
    rt_options again = *options;
    again.samples = image->samples;
    again.error = again.seconds = 0.0f;
    again.progress = NULL;
    same.guides = image->guides;
    same.pixels = new_pixels(image);
    same.half = new_pixels(image);
    const bool good = same.pixels && same.half;
    const rt_status looked =
        good ? v->d->live->render(v->d->stage, &v->view, &again, &same) : RT_NO_MEMORY;
    free(same.pixels);
    free(same.half);
    return looked == RT_OK ? status : looked;
}

/* Is this image what v->clean was made of? */
static bool is_clean(const viewer *v, const rt_image *image)
{
    const rt_image *clean = &v->clean;
    return clean->width == image->width && clean->samples == image->samples &&
           clean->done == image->done && clean->rays == image->rays;
}

const rt_image *viewer_picture(const viewer *v)
{
    return v->denoise && is_clean(v, &v->image) ? &v->clean : &v->image;
}

/* Finish an image into v->clean, if that has not been done yet. */
static rt_status denoise(viewer *v, const rt_image *image,
                         rt_status (*finish)(const rt_image *image, int threads,
                                             rt_image *result))
{
    rt_image *clean = &v->clean;
    if (!clean->pixels)
        clean->pixels = new_pixels(&v->image);
    if (!clean->pixels)
        return RT_NO_MEMORY;
    if (is_clean(v, image))
        return RT_OK;
    clean->width = image->width;
    clean->height = image->height;
    v->clean_error = -1.0f;
    return finish(image, v->options.threads, clean);
}

rt_status viewer_finish(viewer *v)
{
    v->clean.samples = 0;
    return denoise(v, &v->image, v->d->finish ? v->d->finish : rt_denoise);
}

float viewer_clean_error(viewer *v)
{
    if (v->clean_error < 0.0f)
        v->clean_error = rt_denoised_error(&v->image, v->options.threads);
    return v->clean_error;
}

/* -------------------------------------------------------------------------------------
 * What is to be shown
 * ------------------------------------------------------------------------------------- */

/* Is noise taken out of the picture that is seen? */
bool viewer_is_denoised(const viewer *v)
{
    return v->denoise && v->d->live && v->stage >= VIEWER_INDIRECT && !v->hold;
}

/* A demo's own pixels have no guides: where they are wanted, rt.h renders. */
static bool is_own(const viewer *v, int stage)
{
    return !v->d->live || (stage == v->d->stage &&
                           !(v->d->pixel && stage >= VIEWER_INDIRECT && v->denoise));
}

/* Is another picture rendered, to compare with? Noise has only to be left in. */
bool viewer_shows_other(const viewer *v)
{
    return v->hold && v->comparison != NOISY;
}

bool viewer_has_lanes(const viewer *v)
{
    return v->stage >= VIEWER_INDIRECT && !(v->d->pixel && is_own(v, v->stage));
}

static int stage_of(const viewer *v, bool other)
{
    return v->stage - (other && v->comparison == BEFORE && v->stage > 1);
}

bool viewer_is_draft(const viewer *v)
{
    const rt_image *image = viewer_shows_other(v) ? &v->other : &v->image;
    return v->rests > 0.0 || (v->disturbed && image->samples == 0);
}

const rt_image *viewer_shown(viewer *v)
{
    const rt_image *image = viewer_is_draft(v)      ? &v->draft
                            : viewer_shows_other(v) ? &v->other
                                                    : &v->image;
    if (viewer_is_denoised(v) && image->guides && image->samples >= 2 &&
        denoise(v, image, rt_denoise) == RT_OK)
        return &v->clean;
    return image;
}

unsigned char viewer_byte(const viewer *v, int stage, float value)
{
    return v->gamma > 0.0f    ? rt_encode(value, (double)v->gamma)
           : is_own(v, stage) ? v->d->encode(value)
                              : v->d->live->encode(stage, value);
}

void viewer_encode(const viewer *v, bool other, const rt_image *image, int channels,
                   unsigned char *bytes)
{
    const rt_vec3 *pixels = image->pixels;
    const int count = (int)pixel_count(image), stage = stage_of(v, other);
    const float brighter = exp2f(v->exposure);
#ifdef _OPENMP
    const int threads = rt_thread_count(v->options.threads);
#pragma omp parallel for num_threads(threads)
#endif
    for (int i = 0; i < count; i++) {
        const rt_vec3 light = rt_scale(pixels[i], brighter);
        const float rgb[3] = {light.x, light.y, light.z};
        unsigned char *to = bytes + (size_t)i * (size_t)channels;
        for (int k = 0; k < 3; k++)
            to[k] = viewer_byte(v, stage, rgb[k]);
        if (channels == 4)
            to[3] = 255;
    }
}

/* -------------------------------------------------------------------------------------
 * Pointer and keys
 * ------------------------------------------------------------------------------------- */

/* What is seen has changed: draw drafts for a while, and begin anew. */
static void change(viewer *v)
{
    v->changed = v->stop = v->disturbed = true;
}

/* The speed is counted anew. */
static void count_anew(viewer *v)
{
    v->stop = true;
    v->rendered = 0.0;
    v->image.rays = v->other.rays = 0;
}

static bool is_inside(const viewer *v, float x, float y)
{
    return x >= 0.0f && y >= 0.0f && x < (float)v->view.width &&
           y < (float)v->view.height;
}

void viewer_inspect(viewer *v, int x, int y)
{
    if (!v->d->live || !is_inside(v, (float)x, (float)y))
        return;
    if (!v->inspect)
        v->sample = 0;
    v->inspect = v->redraw = true;
    v->x = x;
    v->y = y;
}

void viewer_press(viewer *v, float x, float y, int button)
{
    viewer_move(v, x, y, false);
    if (!is_inside(v, x, y))
        return;
    v->button = button;
    v->dragged = false;
    v->down_x = x;
    v->down_y = y;
    v->thing = v->d->live ? v->d->live->pick(v->stage, &v->view, x, y) : 0;
}

void viewer_move(viewer *v, float x, float y, bool over_the_floor)
{
    const demo_live *live = v->d->live;
    if (v->button != 0 && fabsf(x - v->down_x) + fabsf(y - v->down_y) > v->slack)
        v->dragged = true;
    if (v->button != 0 && !v->dragged) /* it may still become a click */
        return;
    const float right = x - v->mouse_x, up = v->mouse_y - y;
    v->mouse_x = x;
    v->mouse_y = y;
    v->redraw = v->redraw || v->glass;
    if (v->button != 0 && live) {
        const float turn = 0.5f / (float)v->view.width;
        if (v->button != BUTTON_MAIN)
            live->pan(&v->view, -right, -up);
        else if (v->thing != 0)
            live->drag(v->thing, &v->view, right, up, over_the_floor);
        else
            live->orbit(-turn * right, -turn * up);
        change(v);
    } else if (v->inspect && v->button == 0 && is_inside(v, x, y)) {
        viewer_inspect(v, (int)x, (int)y);
    }
}

void viewer_release(viewer *v)
{
    if (v->d->live && v->button == BUTTON_MAIN && !v->dragged) {
        viewer_inspect(v, (int)v->mouse_x, (int)v->mouse_y);
        v->tell = true;
    }
    v->button = BUTTON_NONE;
}

void viewer_wheel(viewer *v, float notches)
{
    if (!v->d->live)
        return;
    viewer_tune(v, v->d->live->pick(v->stage, &v->view, v->mouse_x, v->mouse_y), notches);
}

void viewer_tune(viewer *v, int thing, float notches)
{
    v->tuned = v->d->live->tune(v->stage, thing, notches) ? thing : 0;
    if (v->tuned == 0)
        v->d->live->zoom(powf(0.9f, notches));
    change(v);
}

void viewer_set_samples(viewer *v, int samples)
{
    v->samples = samples < 1 ? 1 : samples < 1 << 20 ? samples : 1 << 20;
    v->stop = v->disturbed = true; /* what there is already, stays */
}

void viewer_set_stage(viewer *v, int stage)
{
    v->tuned = 0;
    v->stage = stage < 1 ? 1 : stage < VIEWER_STAGES ? stage : VIEWER_STAGES;
    change(v);
}

void viewer_set_exposure(viewer *v, float stops)
{
    v->exposure = stops < -20.0f ? -20.0f : stops < 20.0f ? stops : 20.0f;
    v->redraw = true;
}

void viewer_set_bounces(viewer *v, int bounces)
{
    v->options.bounces = v->view.bounces = bounces;
    change(v);
}

/* 0 to 90, and then all that there are. */
static void more_bounces(viewer *v, int more)
{
    const int now = v->options.bounces < 91 ? v->options.bounces : 91, next = now + more;
    viewer_set_bounces(v, next < 0 ? 0 : next < 91 ? next : RT_ALL_BOUNCES);
}

static void reset(viewer *v)
{
    v->d->live->reset();
    v->options = v->first;
    v->view.bounces = v->options.bounces;
    v->denoise = v->denoise_first;
    v->stage = v->d->stage;
    v->samples = wanted_samples(v);
    v->gamma = 0.0f;
    v->exposure = v->first_exposure;
    v->tuned = 0;
    v->glass = v->help = v->side = false;
    v->comparison = v->denoise ? NOISY : BEFORE;
    change(v);
}

static void toggle_denoising(viewer *v)
{
    if (v->stage < VIEWER_INDIRECT)
        return;
    v->denoise = !v->denoise;
    v->comparison = v->denoise ? NOISY : BEFORE;
    if (!v->image.guides)
        change(v);
    v->stop = true;
}

/* The keys that work in every window. False: it is none of them. */
static bool handle_common_key(viewer *v, int key, bool repeated)
{
    const int threads = rt_thread_count(v->options.threads);
    switch (key) {
    case 27:
    case 'q': v->closed = true; return true;
    case 's': v->save = v->save || !repeated; return true;
    case 'z': v->glass = !v->glass; return true;
    case 'g': v->gamma = v->gamma > 0.0f ? 0.0f : 1.0f; return true;
    case 'e': viewer_set_exposure(v, v->exposure + 0.5f); return true;
    case 'w': viewer_set_exposure(v, v->exposure - 0.5f); return true;
    case 'h': v->help = !v->help; return true;
    case '+':
    case '=': viewer_set_samples(v, 2 * v->samples); return true;
    case '-': viewer_set_samples(v, v->samples / 2); return true;
    case 't':
        v->options.threads = threads < rt_thread_count(0) ? threads + 1 : 1;
        count_anew(v);
        return true;
    case 'p':
        v->options.lanes = v->options.lanes == 1 ? 0 : 1;
        count_anew(v);
        return true;
    default: return false;
    }
}

void viewer_nudge(viewer *v, int thing, float right, float up, bool over_the_floor)
{
    const float pixels = (float)v->view.width / 40.0f, turns = 1.0f / 64.0f;
    if (thing != 0)
        v->d->live->drag(thing, &v->view, right * pixels, up * pixels, over_the_floor);
    else
        v->d->live->orbit(right * turns, up * turns);
    change(v);
}

/* Those that move the camera. */
static bool handle_camera_key(viewer *v, int key)
{
    switch (key) {
    case KEY_LEFT: viewer_nudge(v, 0, -1, 0, false); return true;
    case KEY_RIGHT: viewer_nudge(v, 0, 1, 0, false); return true;
    case KEY_UP: viewer_nudge(v, 0, 0, 1, false); return true;
    case KEY_DOWN: viewer_nudge(v, 0, 0, -1, false); return true;
    case KEY_NEARER: viewer_wheel(v, 1); return true;
    case KEY_FARTHER: viewer_wheel(v, -1); return true;
    default: return false;
    }
}

void viewer_key(viewer *v, int key, bool repeated)
{
    v->redraw = true;
    if (handle_common_key(v, key, repeated) || !v->d->live)
        return;
    if (v->inspect && (key == KEY_LEFT || key == KEY_RIGHT)) {
        v->sample += key == KEY_RIGHT ? 1 : v->sample > 0 ? -1 : 0;
        return;
    }
    if (handle_camera_key(v, key))
        return;
    if (key >= '0' && key <= '9') { /* 0 is 10 */
        viewer_set_stage(v, key > '0' ? key - '0' : 10);
        return;
    }
    switch (key) {
    case '.': viewer_set_stage(v, v->stage + 1); break;
    case ',': viewer_set_stage(v, v->stage - 1); break;
    case 'd': toggle_denoising(v); break;
    case 'v': v->side = !v->side; break;
    case 'i': v->inspect = false; break;
    case 'b':
        if (!v->hold)
            count_anew(v);
        v->hold = true;
        break;
    case 'o':
        v->comparison = (v->comparison + 1) % (v->denoise ? COMPARISONS : NOISY);
        forget(&v->other);
        v->stop = true;
        break;
    case 'l':
        v->options.sampler = v->options.sampler == RT_RANDOM ? RT_SOBOL : RT_RANDOM;
        change(v);
        break;
    case ']': /* no key of a French keyboard, so also: */
    case 'm': more_bounces(v, 1); break;
    case '[':
    case 'n': more_bounces(v, -1); break;
    case 'r': reset(v); break;
    default: break;
    }
}

void viewer_key_up(viewer *v, int key)
{
    if (key != 'b' || !v->hold)
        return;
    v->hold = false;
    v->redraw = true;
    count_anew(v);
}

/* -------------------------------------------------------------------------------------
 * What is to be done
 * ------------------------------------------------------------------------------------- */

viewer_task viewer_next(viewer *v, double now)
{
    const rt_image *image = viewer_shows_other(v) ? &v->other : &v->image;
    const int wanted = v->hold && v->comparison == ONE_SAMPLE ? 1 : v->samples;
    v->stop = false;
    if (v->changed) {
        v->rests = now + 0.15;
        return DRAW_A_DRAFT;
    }
    if (now < v->rests)
        return REST;
    v->rests = 0.0;
    const bool missing =
        v->disturbed || viewer_shows_other(v) ? image->samples < wanted : !v->finished;
    return missing ? REFINE : NOTHING;
}

void viewer_begin_anew(viewer *v)
{
    add_half(&v->image); /* from here on, say how large the error is */
    if (v->denoise && !add_guides(&v->image))
        v->denoise = false;
    forget(&v->image);
    forget(&v->other);
    rt_image_clear(&v->clean);
    v->rendered = 0.0;
    v->changed = false;
}

/* Direct light, or two samples without their noise, at once. */
void viewer_draft(viewer *v)
{
    rt_image *image = &v->draft;
    image->width = (2 * v->view.width - 1) / v->shrink + 1;
    image->height = (2 * v->view.height - 1) / v->shrink + 1;
    const bool clean = viewer_is_denoised(v) && add_guides(image);
    forget(image);
    rt_image_clear(&v->clean);
    const demo_view view = {image->width, image->height, v->view.bounces};
    rt_options options = v->options;
    options.samples = clean ? 2 : 1;
    options.error = options.seconds = 0.0f;
    options.progress = NULL;
    const int stage = stage_of(v, v->hold);
    if (clean)
        v->d->live->render(stage, &view, &options, image);
    else if (is_own(v, stage) && v->d->pixel && stage < VIEWER_INDIRECT)
        render_own(v, &view, &options, image);
    else
        v->d->live->draft(stage, &view, &options, image);
}

void viewer_draft_took(viewer *v, double seconds)
{
    /* not longer than that, and as large as that allows */
    const double most = viewer_is_denoised(v) ? 0.050 : 0.025;
    const double larger = (v->shrink - 1.0) / v->shrink;
    if (seconds > most && v->shrink < 8)
        v->shrink++;
    else if (seconds < 0.95 * most * larger * larger && v->shrink > 2)
        v->shrink--;
    v->drafts++;
    v->drafts_took += seconds;
}

/* Is the picture, or the other one, made by the demo's own function? */
static bool is_made_by_demo(const viewer *v, bool other)
{
    return is_own(v, stage_of(v, other)) &&
           !(other && v->comparison == BY_RT_H && v->d->live);
}

static rt_options options_for(const viewer *v, bool other, const rt_options *options)
{
    rt_options o = *options;
    if (other && v->comparison == OTHER_NUMBERS)
        o.sampler = o.sampler == RT_RANDOM ? RT_SOBOL : RT_RANDOM;
    return o;
}

rt_status viewer_add_samples(const viewer *v, bool other, const rt_options *options,
                             rt_image *image)
{
    const rt_options o = options_for(v, other, options);
    return is_made_by_demo(v, other)
               ? render_own(v, &v->view, &o, image)
               : v->d->live->render(stage_of(v, other), &v->view, &o, image);
}

rt_status viewer_refine(viewer *v, bool (*progress)(void *user, float part), void *user)
{
    rt_image *image = viewer_shows_other(v) ? &v->other : &v->image;
    rt_options options = v->options;
    options.progress = progress;
    options.user = user;
    if (v->disturbed)
        options.error = options.seconds = 0.0f;
    if (v->disturbed || options.samples > 0)
        options.samples = (v->disturbed ? v->samples : options.samples) - image->samples;
    if (v->hold && v->comparison == ONE_SAMPLE)
        options.samples = 1;
    v->refining = demo_seconds();
    const rt_status status = viewer_add_samples(v, v->hold, &options, image);
    v->rendered += demo_seconds() - v->refining;
    v->refining = 0.0;
    return status;
}

/* -------------------------------------------------------------------------------------
 * Words
 * ------------------------------------------------------------------------------------- */

const char *viewer_plural(long long n)
{
    return n == 1 ? "" : "s";
}

const char *viewer_bounces(const viewer *v)
{
    static char words[40];
    const int n = v->options.bounces;
    snprintf(words, sizeof words, n == RT_ALL_BOUNCES ? "all bounces" : "%d bounce%s", n,
             viewer_plural(n));
    return words;
}

const char *viewer_comparison_name(viewer_comparison comparison)
{
    static const char *const names[COMPARISONS] = {"the chapter before", "one sample",
                                                   "rt.h's own function", "other numbers",
                                                   "with its noise"};
    return names[comparison];
}

int viewer_chapter(int stage)
{
    return stage <= VIEWER_INDIRECT ? stage : stage + 3;
}

const char *viewer_stage_name(int stage)
{
    static const char *const names[VIEWER_STAGES] = {
        "sphere",       "walls",          "cube",      "shadows",       "gamma",
        "mirror",       "indirect light", "glass",     "lamps",         "gloss",
        "lens and sky", "patterns",       "triangles", "your own shape"};
    return names[stage - 1];
}

void viewer_say_stage(const viewer *v, demo_text *out)
{
    if (v->d->live)
        text_add(out, "%d %s%s, ", viewer_chapter(v->stage), viewer_stage_name(v->stage),
                 is_own(v, v->stage) ? " (the demo's)" : "");
    if (v->tuned != 0) {
        v->d->live->say(v->stage, v->tuned, out);
        text_add(out, ", ");
    }
    if (v->exposure != 0.0f)
        text_add(out, "exposure %+g, ", (double)v->exposure);
    if (v->hold)
        text_add(out, "held: %s, ", viewer_comparison_name(v->comparison));
}

void viewer_say_samples(const rt_image *image, float error, demo_text *out)
{
    text_add(out, "%d sample%s", image->samples, viewer_plural(image->samples));
    if (error <= FLT_MAX)
        text_add(out, ", error %.2f %%", 100.0 * (double)error);
    else if (image->half)
        text_add(out, ", error unknown");
}

void viewer_say_progress(viewer *v, const rt_image *shown, float error, double now,
                         demo_text *out)
{
    if (viewer_is_draft(v)) {
        text_add(out, "%s, %.0f a second",
                 viewer_is_denoised(v) ? "2 samples" : "direct light",
                 v->drafts / fmax(v->drafts_took, 1e-9));
        return;
    }
    const bool clean = shown == &v->clean;
    const double since = v->refining > 0.0 ? now - v->refining : 0.0;
    viewer_say_samples(clean ? &v->image : shown, error, out);
    if (clean)
        text_add(out, ", finished");
    if (clean && shown->samples >= v->samples)
        text_add(out, ": at most %.2f %%", 100.0 * (double)viewer_clean_error(v));
    if (shown->samples < v->samples && !v->hold)
        text_add(out, " (%d wanted)", v->samples);
    text_add(out, ", %.1f Mrays/s",
             (double)shown->rays * 1e-6 / fmax(v->rendered + since, 1e-3));
}

void viewer_say_pixel(const viewer *v, const rt_image *shown, const unsigned char *bytes,
                      demo_text *out)
{
    const int x = (int)(v->mouse_x * (float)shown->width / (float)v->view.width);
    const int y = (int)(v->mouse_y * (float)shown->height / (float)v->view.height);
    if (x < 0 || y < 0 || x >= shown->width || y >= shown->height)
        return;
    const rt_vec3 c = shown->pixels[y * shown->width + x];
    const unsigned char *b = bytes + 3 * (y * shown->width + x);
    text_add(out, "%d,%d: %.4g %.4g %.4g -> %d %d %d", x, y, (double)c.x, (double)c.y,
             (double)c.z, b[0], b[1], b[2]);
}

/* -------------------------------------------------------------------------------------
 * Lines: the path of a pixel in the room
 * ------------------------------------------------------------------------------------- */

const char *viewer_kind_name(demo_kind kind)
{
    static const char *const names[LINE_KINDS] = {
        "", "camera", "matt", "mirror", "normal", "lamp", "in shadow", "gloss", "glass"};
    return names[kind];
}

/* A point of the room in the plan. */
static void flatten(bool side, rt_vec3 p, float q[2])
{
    q[0] = side ? p.z : p.x;
    q[1] = side ? -p.y : p.z;
}

/* The sample that is inspected, of the picture that is shown. */
static rt_status trace(const viewer *v, demo_lines *lines, demo_text *table,
                       demo_text *words, rt_vec3 *value)
{
    const rt_options options = options_for(v, v->hold, &v->options);
    const demo_sample sample = {.stage = stage_of(v, v->hold),
                                .view = &v->view,
                                .options = &options,
                                .image = viewer_shows_other(v) ? &v->other : &v->image,
                                .x = v->x,
                                .y = v->y,
                                .number = v->sample,
                                .own = is_made_by_demo(v, v->hold) ? v->d->pixel : NULL};
    return v->d->live->path(&sample, lines, table, words, value);
}

rt_status viewer_explain(const viewer *v, demo_text *out, rt_vec3 *value)
{
    return trace(v, NULL, NULL, out, value);
}

/* The scale and the place at which these lines fill the plan. False: they have no size. */
static bool fit(const viewer *v, const demo_lines *room, const viewer_plan *plan,
                float *scale, float at[2])
{
    float low[2] = {FLT_MAX, FLT_MAX}, high[2] = {-FLT_MAX, -FLT_MAX};
    for (int i = 0; i < 2 * room->count; i++) {
        float q[2];
        flatten(v->side, i % 2 ? room->lines[i / 2].to : room->lines[i / 2].from, q);
        for (int k = 0; k < 2; k++) {
            low[k] = fminf(low[k], q[k]);
            high[k] = fmaxf(high[k], q[k]);
        }
    }
    *scale = 0.94f *
             fminf(plan->width / (high[0] - low[0]), plan->height / (high[1] - low[1]));
    at[0] = 0.5f * (plan->width - *scale * (low[0] + high[0]));
    at[1] = 0.5f * (plan->height - *scale * (low[1] + high[1]));
    return *scale > 0.0f && *scale < 1e6f;
}

/* Cut the line off where it leaves the plan. False: nothing of it is inside. */
static bool cut(viewer_line *l, const viewer_plan *plan)
{
    const float from[2] = {l->x0, l->y0}, by[2] = {l->x1 - l->x0, l->y1 - l->y0};
    const float size[2] = {plan->width, plan->height};
    float in = 0.0f, out = 1.0f; /* the part of it that is inside */
    for (int k = 0; k < 2; k++) {
        if (by[k] == 0.0f && !(from[k] >= 0.0f && from[k] <= size[k]))
            return false;
        if (by[k] == 0.0f)
            continue;
        const float a = -from[k] / by[k], b = (size[k] - from[k]) / by[k];
        in = fmaxf(in, fminf(a, b));
        out = fminf(out, fmaxf(a, b));
    }
    l->x0 = from[0] + in * by[0];
    l->y0 = from[1] + in * by[1];
    l->x1 = from[0] + out * by[0];
    l->y1 = from[1] + out * by[1];
    return in <= out;
}

static bool overlap(const viewer_label *a, const viewer_label *b, float letter)
{
    const float width = 0.3f * (float)(strlen(a->name) + strlen(b->name) + 1);
    return fabsf(a->x - b->x) < width * letter && fabsf(a->y - b->y) < 1.2f * letter;
}

/* Put the last label where it is whole, and on none of the others if that can be had nearby. */
static void place(viewer_plan *plan)
{
    viewer_label *label = &plan->labels[plan->label_count - 1];
    const float half = 0.32f * plan->letter * (float)strlen(label->name);
    const float y = fmaxf(plan->letter, fminf(plan->height - plan->letter, label->y));
    label->x = fmaxf(half, fminf(plan->width - half, label->x));
    for (int i = 0; i < 9; i++) { /* there, one line down, one up, two down ... */
        const float rows = (float)((i + 1) / 2 * (i % 2 ? 1 : -1));
        bool free = true;
        label->y = y + 1.2f * plan->letter * rows;
        for (const viewer_label *other = plan->labels; other < label; other++)
            free = free && !overlap(label, other, plan->letter);
        if (free && label->y >= 0.6f * plan->letter &&
            label->y <= plan->height - 0.6f * plan->letter)
            return;
    }
    label->y = y;
}

void viewer_draw_plan(const viewer *v, viewer_plan *plan, demo_text *table)
{
    static demo_line memory[VIEWER_LINES];
    static char told[1 << 14];
    demo_lines room = {memory, VIEWER_LINES, 0};
    demo_text rows = text_in(told, sizeof told);
    demo_label labels[DEMO_LABELS];
    rt_vec3 value = {0, 0, 0};
    float scale, at[2];
    const int stage = stage_of(v, v->hold);
    v->d->live->outlines(stage, &v->view, &room);
    const bool good = fit(v, &room, plan, &scale, at);
    trace(v, &room, &rows, NULL, &value);
    text_add(table, "pixel %d,%d, sample %d = %.4f %.4f %.4f, from %s (v)\n%s", v->x,
             v->y, v->sample, (double)value.x, (double)value.y, (double)value.z,
             v->side ? "the side" : "above", told);
    plan->line_count = plan->label_count = 0;
    for (int i = 0; i < room.count && good; i++) {
        const demo_line *l = &room.lines[i];
        const bool path =
            l->kind != LINE_ROOM && l->kind != LINE_NORMAL && l->kind != LINE_BLOCKED;
        float from[2], to[2];
        flatten(v->side, l->from, from);
        flatten(v->side, l->to, to);
        viewer_line line = {at[0] + scale * from[0],
                            at[1] + scale * from[1],
                            at[0] + scale * to[0],
                            at[1] + scale * to[1],
                            path ? 1.0f + 3.0f * l->weight : 1.0f,
                            l->kind};
        if (cut(&line, plan))
            plan->lines[plan->line_count++] = line;
    }
    const int names = v->d->live->labels(stage, v->side, labels);
    for (int i = 0; i < names && good; i++) {
        float q[2];
        flatten(v->side, labels[i].at, q);
        const float x = at[0] + scale * q[0], y = at[1] + scale * q[1];
        const float down = labels[i].below ? plan->letter : 0.0f;
        viewer_label *label = &plan->labels[plan->label_count++];
        *label = (viewer_label){x, y + down, labels[i].name};
        place(plan);
        const viewer_line tie = {x, y, label->x, label->y, 1.0f, LINE_ROOM};
        if (fabsf(label->y - y) > 2.0f * plan->letter && plan->line_count < VIEWER_LINES)
            plan->lines[plan->line_count++] = tie; /* it had to go away from its thing */
    }
}

/* The program around a demo: it does what the command line wants, with or without a
 * window. demo.h says what a demo is, viewer.h what can be done with its picture. */
#include "command.h"
#include "files.h"
#include "load.h"
#include "parts.h"
#include "platform.h"
#include "progress.h"
#include "viewer.h"
#include "window.h"

#include <signal.h>
#include <stdio.h>
#include <stdlib.h>

enum { WORDS = 1 << 16 };
enum { DONE = 0, FAILED = 1, WRONG_USE = 2, INTERRUPTED = 130 };

typedef struct run {
    settings s;
    viewer v;
    progress p;
    window *win;          /* NULL: none */
    unsigned char *bytes; /* of what is saved */
    uint64_t given;       /* a sum of what was read from files: the texture, the mesh */
    int first;            /* the first part that was rendered; 0: none yet */
    double done;          /* how much of the work, 0 to 1 */
    double before, share; /* of it: what was done before this part, and this part */
} run;

static volatile sig_atomic_t interrupted; /* by Ctrl-C or SIGTERM; a second one kills */

static void interrupt(int signal)
{
    (void)signal;
    interrupted = 1;
}

/* One line on stderr. */
static bool failed(const run *r, rt_status status)
{
    fprintf(stderr, "%s: %s\n", r->v.d->name, rt_status_text(status));
    return false;
}

/* -------------------------------------------------------------------------------------
 * The picture that the command line wants
 * ------------------------------------------------------------------------------------- */

/* How many pixels have a value that is NaN or infinite: a mistake in pixel(). */
static int bad_pixels(const rt_image *image)
{
    int count = 0;
    const size_t all = parts_pixels(image);
    for (size_t i = 0; i < all; i++) {
        const rt_vec3 v = image->pixels[i];
        count +=
            !(fabsf(v.x) <= FLT_MAX && fabsf(v.y) <= FLT_MAX && fabsf(v.z) <= FLT_MAX);
    }
    return count;
}

static bool save(run *r)
{
    const rt_image *image = viewer_picture(&r->v);
    const int bad = bad_pixels(image);
    if (bad > 0)
        fprintf(stderr, "%s: warning: %d of %d pixels are NaN or infinite\n",
                r->v.d->name, bad, image->width * image->height);
    if (files_is_pfm(r->s.out))
        return files_save_pfm(r->v.d->name, r->s.out, image->width, image->height,
                              image->pixels);
    viewer_encode(&r->v, false, image, 3, r->bytes);
    return files_save_png(r->v.d->name, r->s.out, image->width, image->height, r->bytes);
}

/* Give what a key asked for: the file; the camera as C code; the pixel in words. */
static void attend(run *r)
{
    viewer *v = &r->v;
    static char words[WORDS];
    demo_text out = text_in(words, sizeof words);
    const bool there = !(v->disturbed && v->image.samples == 0);
    const bool tells = v->tell && !r->s.quiet, saves = v->save && there;
    v->tell = false;
    if (!tells && !saves)
        return;
    progress_end(&r->p);
    if (tells) {
        rt_vec3 value;
        text_add(&out, "%s: pixel %d,%d of %d x %d, %s\n", v->d->name, v->x, v->y,
                 v->view.width, v->view.height, viewer_bounces(v));
        viewer_explain(v, &out, &value);
    }
    if (saves) {
        v->save = false;
        window_was_away(r->win); /* it writes the file */
        viewer_shown(v);         /* finished, if it is to be */
        if (save(r)) {
            text_add(&out, "%s: saved %s\n", v->d->name, r->s.out);
            if (v->d->live)
                v->d->live->print(&out);
        }
    }
    if (!r->s.quiet)
        printf("%s", words);
    fflush(stdout);
}

/* Called by rt_render every few milliseconds. In a window: no thread writes to the image
 * meanwhile, so it may be drawn. */
static bool keep_going(void *user, float part)
{
    run *r = user;
    viewer *v = &r->v;
    const bool short_part = r->s.part > 0 && demo_seconds() - r->p.started < 10.0;
    if (!v->disturbed && !short_part) {
        const bool early = r->s.samples == 0 && part < 0.01f;
        r->p.picture = viewer_picture(v);
        r->done = r->before + r->share * (double)part;
        progress_print(&r->p, demo_seconds(), r->done, early ? v->image.samples : 0);
    }
    if (r->win) {
        window_poll(r->win, v);
        if (!v->stop) /* otherwise once it has stopped, and all is in its new place */
            attend(r);
        if (!v->closed && !v->stop && window_is_due(r->win)) {
            if (viewer_is_denoised(v)) /* on all cores, so not while they render */
                v->stop = true;
            else
                window_draw_in_time(r->win, v, 20.0);
        }
    }
    return !interrupted && !v->closed && !v->stop;
}

static void print_job(const run *r)
{
    const settings *s = &r->s;
    const int threads = rt_thread_count((int)s->threads);
    printf("%s: %lld x %lld, ", r->v.d->name, s->width, s->height);
    if (s->samples == 0)
        printf("as many samples as it takes");
    else
        printf("%s%lld sample%s", s->error > 0.0f || s->seconds > 0.0f ? "at most " : "",
               s->samples, viewer_plural(s->samples));
    if (s->error > 0.0f)
        printf(", until the error is %g %%", 100.0 * (double)s->error);
    if (s->seconds > 0.0f)
        printf(", for %g s at most", (double)s->seconds);
    printf(", %s, %d thread%s", viewer_bounces(&r->v), threads, viewer_plural(threads));
    if (r->v.d->render)
        printf(", %d at a time", rt_lane_count((int)s->lanes));
    printf("\n");
    fflush(stdout);
}

/* Finish the picture and write it; how says in words how it was made. */
static bool finish_and_save(run *r, const char *how, const char *end)
{
    viewer *v = &r->v;
    double finishing = demo_seconds();
    if (r->s.denoise && v->image.samples >= 2 && viewer_finish(v) != RT_OK)
        return failed(r, RT_NO_MEMORY);
    finishing = demo_seconds() - finishing;
    const bool clean = viewer_picture(v) == &v->clean;
    if (r->s.preview && !r->s.quiet && clean) {
        r->p.picture = &v->clean;
        progress_preview(&r->p);
    }
    if (!save(r))
        return false;
    if (!r->s.quiet) {
        printf("%s: %s, ", v->d->name, how);
        if (clean)
            printf("finished in %.2f s: error at most %.2f %%, ", finishing,
                   100.0 * (double)viewer_clean_error(v));
        printf("wrote %s%s\n", r->s.out, end);
    }
    fflush(stdout);
    return true;
}

/* Finish up: the rendering is done, was interrupted, or failed. */
static bool complete(run *r, rt_status status, double took)
{
    const rt_image *image = &r->v.image;
    char how[200], end[40] = "";
    demo_text out = text_in(how, sizeof how);
    progress_end(&r->p);
    if (status != RT_OK && status != RT_CANCELLED)
        return failed(r, status);
    if (!r->s.quiet) {
        text_add(&out, "%.2f s, ", took);
        if (image->samples > 0) { /* else it was interrupted before */
            viewer_say_samples(image, rt_image_error(image), &out);
            text_add(&out, ", ");
        }
        text_add(&out, "%.1f million rays per second", (double)image->rays / took * 1e-6);
    }
    if (status == RT_CANCELLED)
        snprintf(end, sizeof end, " (interrupted at %.0f %%)", 100.0 * r->done);
    return finish_and_save(r, how, end);
}

/* -------------------------------------------------------------------------------------
 * A part of it, and the picture of all parts
 * ------------------------------------------------------------------------------------- */

enum { LINES = 500 };

/* The lines that parts of this picture begin with. */
static rt_status describe(const run *r, demo_text *lines)
{
    viewer small;
    rt_options once = r->v.options;
    once.samples = 4;
    if (!viewer_open(&small, r->v.d, 64, 48, &once, false))
        return RT_NO_MEMORY;
    const rt_status status = viewer_render(&small, &once);
    parts_describe(lines, r->v.d->name, &r->v.options, &r->v.image, r->given,
                   parts_sum(&small.image));
    viewer_close(&small);
    return status;
}

/* Progress with all parts, if they are wanted: a part that was there took no time. */
static void note_part(run *r, int k)
{
    if (r->first == 0) {
        r->first = k;
        r->p.started = demo_seconds();
    }
    if (r->s.part == ALL_PARTS) {
        r->share = 1.0 / (double)(r->s.parts - r->first + 1);
        r->before = r->share * (k - r->first);
    }
}

static int render_missing_part(run *r, int k, const char *path, const char *lines)
{
    viewer *v = &r->v;
    rt_options options = v->options;
    if (!files_can_write(v->d->name, path))
        return FAILED;
    options.progress = keep_going;
    options.user = r;
    const double start = demo_seconds();
    note_part(r, k);
    const rt_status status = viewer_render(v, &options);
    progress_end(&r->p);
    const double took = demo_seconds() - start;
    const int bad = bad_pixels(&v->image);
    if (status == RT_CANCELLED) {
        if (!r->s.quiet)
            printf("%s: interrupted, part %d of %lld is not written\n", v->d->name, k,
                   r->s.parts);
        return INTERRUPTED;
    }
    if (status != RT_OK)
        return failed(r, status), FAILED;
    if (bad > 0)
        fprintf(stderr, "%s: '%s' is not written: %d of %d pixels are NaN or infinite\n",
                v->d->name, path, bad, v->image.count);
    if (bad > 0 || !parts_write(v->d->name, path, lines, &v->image))
        return FAILED;
    if (!r->s.quiet) {
        const parts_progress all = parts_look(r->s.out, k, (int)r->s.parts, took);
        printf("%s: part %d of %lld, %.2f s, wrote %s", v->d->name, k, r->s.parts, took,
               path);
        if (all.there >= 0)
            printf("; %d of %lld are there", all.there, r->s.parts);
        if (all.left > 0.0)
            printf(", %.0f s left", all.left);
        printf("\n");
        fflush(stdout);
    }
    return DONE;
}

static int render_part(run *r, int k, const char *lines)
{
    const char *name = r->v.d->name;
    char why[300];
    demo_text out = text_in(why, sizeof why);
    char *path = parts_path(r->s.out, k, (int)r->s.parts);
    if (!path)
        return failed(r, RT_NO_MEMORY), FAILED;
    parts_cut(&r->v.image, k, (int)r->s.parts);
    const parts_state state = parts_read(path, lines, &r->v.image, &out);
    int result = DONE;
    if (state == PART_WHOLE && !r->s.quiet)
        printf("%s: part %d of %lld is there already: %s\n", name, k, r->s.parts, path);
    if (state == PART_DAMAGED && !r->s.quiet)
        printf("%s: '%s': %s; once more\n", name, path, why);
    if (state == PART_OTHER) {
        fprintf(stderr, "%s: '%s': %s\n", name, path, why);
        result = FAILED;
    } else if (state != PART_WHOLE) {
        rt_image_clear(&r->v.image);
        result = render_missing_part(r, k, path, lines);
    }
    free(path);
    return result;
}

static int next_part(const demo *d, int before)
{
    return d->next_part ? d->next_part(before == 0) : before + 1;
}

/* All that nobody else takes, until one fails. */
static int render_all_parts(run *r, const char *lines)
{
    int result = DONE, k = 0;
    while (result == DONE && !interrupted && (k = next_part(r->v.d, k)) <= r->s.parts)
        result = render_part(r, k, lines);
    return interrupted ? INTERRUPTED : result;
}

/* " (3 of 4 parts are there)", if it is worth counting. */
static void say_how_many(const run *r, demo_text *out)
{
    const int there = parts_look(r->s.out, 0, (int)r->s.parts, 0.0).there;
    if (there >= 0)
        text_add(out, " (%d of %lld parts are there)", there, r->s.parts);
}

/* Read a part into its place in the picture. */
static bool read_part(run *r, int k, const char *lines)
{
    rt_image *image = &r->v.image, part = *image;
    char why[300];
    demo_text out = text_in(why, sizeof why);
    char *path = parts_path(r->s.out, k, (int)r->s.parts);
    if (!path)
        return failed(r, RT_NO_MEMORY);
    parts_cut(&part, k, (int)r->s.parts);
    part.pixels += part.first;
    part.half = part.half ? part.half + part.first : NULL;
    part.guides = part.guides ? part.guides + part.first : NULL;
    const parts_state state = parts_read(path, lines, &part, &out);
    if (state == PART_WHOLE) {
        image->rays += part.rays;
    } else {
        if (state == PART_MISSING)
            say_how_many(r, &out);
        fprintf(stderr, "%s: cannot join '%s': %s\n", r->v.d->name, path, why);
    }
    free(path);
    return state == PART_WHOLE;
}

static int join_parts(run *r, const char *lines)
{
    viewer *v = &r->v;
    char how[200];
    demo_text out = text_in(how, sizeof how);
    for (int k = 1; k <= r->s.parts; k++) {
        if (interrupted) {
            fprintf(stderr, "%s: interrupted, %s is not written\n", v->d->name, r->s.out);
            return INTERRUPTED;
        }
        if (!read_part(r, k, lines))
            return FAILED;
    }
    v->image.samples = v->options.samples;
    text_add(&out, "%lld part%s, ", r->s.parts, viewer_plural(r->s.parts));
    viewer_say_samples(&v->image, rt_image_error(&v->image), &out);
    text_add(&out, ", %.1f million rays", (double)v->image.rays * 1e-6);
    return finish_and_save(r, how, "") ? DONE : FAILED;
}

static int part_or_join(run *r)
{
    char lines[LINES];
    demo_text out = text_in(lines, sizeof lines);
    const rt_status status = describe(r, &out);
    if (status != RT_OK)
        return failed(r, status), FAILED;
    platform_on_interrupt(interrupt);
    return r->s.part == 0           ? join_parts(r, lines)
           : r->s.part == ALL_PARTS ? render_all_parts(r, lines)
                                    : render_part(r, (int)r->s.part, lines);
}

/* -------------------------------------------------------------------------------------
 * One pixel in words
 * ------------------------------------------------------------------------------------- */

/* What denoising has done to it. */
static rt_status explain_denoising(run *r, const rt_options *options)
{
    viewer *v = &r->v;
    const int i = (int)(r->s.y * r->s.width + r->s.x);
    rt_status status = viewer_render(v, options);
    if (status == RT_OK)
        status = viewer_finish(v);
    if (status != RT_OK)
        return status;
    const rt_guide *g = &v->image.guides[i];
    const rt_vec3 noisy = v->image.pixels[i], clean = v->clean.pixels[i];
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

/* Its samples, and their mean. */
static rt_status explain_samples(const run *r, int samples)
{
    static char words[WORDS];
    rt_vec3 mean = {0, 0, 0};
    viewer v = r->v;
    v.denoise = false; /* that comes later */
    v.x = (int)r->s.x;
    v.y = (int)r->s.y;
    for (v.sample = 0; v.sample < samples; v.sample++) {
        demo_text out = text_in(words, sizeof words);
        rt_vec3 value;
        const rt_status status = viewer_explain(&v, &out, &value);
        if (status != RT_OK)
            return status;
        printf("%s", words);
        mean = rt_add(mean, rt_scale(rt_sub(value, mean), 1.0f / (float)(v.sample + 1)));
    }
    printf("mean: (%.6g, %.6g, %.6g), as bytes %d, %d, %d\n", (double)mean.x,
           (double)mean.y, (double)mean.z, viewer_byte(&v, v.stage, mean.x),
           viewer_byte(&v, v.stage, mean.y), viewer_byte(&v, v.stage, mean.z));
    return RT_OK;
}

static int explain(run *r)
{
    const demo *d = r->v.d;
    rt_options options = r->v.options;
    if (options.samples == 0)
        options.samples = d->samples;
    if (!r->s.quiet)
        printf("%s: pixel %ld,%ld of %lld x %lld, %d sample%s, %s\n", d->name, r->s.x,
               r->s.y, r->s.width, r->s.height, options.samples,
               viewer_plural(options.samples), viewer_bounces(&r->v));
    rt_status status = explain_samples(r, options.samples);
    if (status == RT_OK && r->s.denoise)
        status = explain_denoising(r, &options);
    return status == RT_OK || failed(r, status) ? DONE : FAILED;
}

/* -------------------------------------------------------------------------------------
 * In a window
 * ------------------------------------------------------------------------------------- */

static run *open_run; /* the run that has a window */

/* Xlib ends the program when the display is lost. Then at least save what there is. */
static void display_lost(void)
{
    if (open_run && !open_run->v.disturbed && !open_run->v.finished) {
        fprintf(stderr, "%s: the display is gone\n", open_run->v.d->name);
        complete(open_run, RT_CANCELLED, demo_seconds() - open_run->p.started);
    }
}

static void open_window(run *r)
{
    const char *why = "not enough memory";
    if (viewer_show(&r->v))
        r->win = window_open(&r->v, &why);
    if (r->win) {
        open_run = r;
        atexit(display_lost);
        if (why && !r->s.quiet)
            printf("%s: no text in the window (%s)\n", r->v.d->name, why);
    } else if (!r->s.quiet) {
        printf("%s: no window (%s)\n", r->v.d->name, why);
    }
}

static void draw_draft(run *r)
{
    const double start = demo_seconds();
    viewer_begin_anew(&r->v);
    viewer_draft(&r->v);
    window_poll(r->win, &r->v);
    window_draw(r->win, &r->v);
    viewer_draft_took(&r->v, demo_seconds() - start);
}

/* Add the missing samples, or stop when something else is to be done. False: it
 * failed. */
static bool refine(run *r)
{
    viewer *v = &r->v;
    const bool wanted = !v->disturbed && !viewer_shows_other(v); /* by the command line */
    const rt_status status = viewer_refine(v, keep_going, r);
    if (status != RT_OK && status != RT_CANCELLED)
        return complete(r, status, 0.0);
    if (viewer_is_denoised(v) && !v->changed) /* else old pixels get new words */
        window_draw_in_time(r->win, v, 4.0);
    if (!viewer_is_denoised(v) || status == RT_OK)
        v->redraw = true;
    if (!wanted || v->disturbed || (status != RT_OK && !interrupted))
        return true;
    v->finished = true;
    const bool good = complete(r, status, demo_seconds() - r->p.started);
    v->samples = v->image.samples;
    window_was_away(r->win); /* it was writing the file */
    return good;
}

/* Run the window until it is closed. */
static bool run_window(run *r)
{
    viewer *v = &r->v;
    bool good = true;
    while (!v->closed && !interrupted && good) {
        window_poll(r->win, v);
        attend(r);
        switch (viewer_next(v, demo_seconds())) {
        case DRAW_A_DRAFT: draw_draft(r); break;
        case REST:
            window_wait(r->win, (int)(1000.0 * (v->rests - demo_seconds())) + 1);
            break;
        case REFINE: good = refine(r); break;
        case NOTHING: window_rest(r->win, v); break;
        }
    }
    if (!r->s.quiet && !v->finished && good)
        printf("%s: closed after %.2f s, before the end\n", v->d->name,
               demo_seconds() - r->p.started);
    if (!r->s.quiet && v->drafts > 0)
        printf("%s: %d pictures in motion, %.0f a second; the longest wait for the "
               "keyboard: %.0f ms\n",
               v->d->name, v->drafts, v->drafts / v->drafts_took,
               1e3 * window_slowest(r->win));
    return good;
}

/* -------------------------------------------------------------------------------------
 * The whole program
 * ------------------------------------------------------------------------------------- */

static int render_and_save(run *r)
{
    if (!r->s.quiet)
        print_job(r);
    r->p.started = demo_seconds();
    bool good;
    if (r->win) {
        good = run_window(r);
    } else {
        rt_options options = r->v.options;
        options.progress = keep_going;
        options.user = r;
        const rt_status status = viewer_render(&r->v, &options);
        good = complete(r, status, demo_seconds() - r->p.started);
    }
    return !good ? FAILED : interrupted ? INTERRUPTED : DONE;
}

static int show(run *r)
{
    if (r->v.d->measure && !r->s.quiet)
        r->v.d->measure(rt_thread_count(r->v.options.threads));
    platform_on_interrupt(interrupt);
    if (r->s.window)
        open_window(r);
    const int result = render_and_save(r);
    open_run = NULL;
    if (r->win)
        window_close(r->win);
    return result;
}

/* Say what the command line asks for that this demo, or this terminal, does not have. */
static void say_what_is_not(run *r)
{
    const demo *d = r->v.d;
    if (r->s.preview && platform_colours() == 0) {
        r->s.preview = false;
        if (!r->s.quiet)
            printf("%s: --preview: this is no terminal with colours\n", d->name);
    }
    if (d->bounces == 0 && r->s.bounces > 0 && !r->s.quiet)
        printf("%s: this chapter has no bounces yet, --bounces changes nothing\n",
               d->name);
    if (!d->render && r->s.lanes > 0 && !r->s.quiet)
        printf("%s: this chapter traces one ray at a time, --lanes changes nothing\n",
               d->name);
}

static rt_options options_of(const settings *s)
{
    return (rt_options){.samples = (int)s->samples,
                        .bounces = (int)s->bounces,
                        .threads = (int)s->threads,
                        .seed = (uint32_t)s->seed,
                        .sampler = s->sampler,
                        .error = s->error,
                        .seconds = s->seconds,
                        .lanes = (int)s->lanes};
}

/* The picture stays until the program ends. */
static bool wrap_texture(run *r, const char *path)
{
    const demo *d = r->v.d;
    int width, height;
    char who[80];
    snprintf(who, sizeof who, "%s: --texture", d->name);
    const rt_vec3 *pixels = files_load(who, path, &width, &height);
    if (pixels) {
        r->given = parts_add(0, pixels, sizeof *pixels * (size_t)width * (size_t)height);
        d->texture(pixels, width, height);
    }
    return pixels != NULL;
}

/* So does the mesh. Without assimp the demo shows a mesh of its own. */
static bool take_mesh(run *r, const char *path)
{
    const demo *d = r->v.d;
    rt_mesh mesh;
    char who[80];
    snprintf(who, sizeof who, "%s: --mesh", d->name);
    if (load_lacks()) {
        fprintf(stderr, "%s: %s\n", who, load_lacks());
        return true;
    }
    if (!load_mesh(who, path, &mesh))
        return false;
    const size_t positions = (size_t)mesh.position_count;
    r->given = parts_add(0, mesh.positions, positions * sizeof *mesh.positions);
    r->given = parts_add(r->given, mesh.indices,
                         3 * (size_t)mesh.triangle_count * sizeof *mesh.indices);
    d->mesh(&mesh);
    return true;
}

static int run_demo(int argc, char **argv, const demo *d)
{
    char out[64];
    const bool at_the_top = platform_look("build", NULL) == A_FOLDER;
    snprintf(out, sizeof out, "%s%s.png", at_the_top ? "build/" : "", d->name);
    run r = {.v = {.d = d},
             .share = 1.0,
             .s = {.width = 640,
                   .height = 480,
                   .bounces = d->bounces,
                   .sampler = d->sobol ? RT_SOBOL : RT_RANDOM,
                   .denoise = d->denoise,
                   .out = out,
                   .window = true}};
    if (!command_parse(d, argc, argv, &r.s))
        return WRONG_USE;
    if (r.s.help) {
        command_help(d);
        return fflush(stdout) == 0 ? DONE : FAILED;
    }
    if (!r.s.explain && r.s.part == 0 && !files_can_write(d->name, r.s.out))
        return FAILED;
    if (r.s.texture && !wrap_texture(&r, r.s.texture))
        return FAILED;
    if (r.s.mesh && !take_mesh(&r, r.s.mesh))
        return FAILED;
    say_what_is_not(&r);
    if (r.s.samples == 0 && r.s.error == 0.0f && r.s.seconds == 0.0f)
        r.s.samples = d->samples;

    int result = FAILED;
    const rt_options options = options_of(&r.s);
    r.p = (progress){.quiet = r.s.quiet, .preview = r.s.preview, .encode = d->encode};
    r.bytes = malloc((size_t)r.s.width * (size_t)r.s.height * 3);
    if (r.bytes &&
        viewer_open(&r.v, d, (int)r.s.width, (int)r.s.height, &options, r.s.denoise)) {
        r.v.exposure = r.v.first_exposure = r.s.exposure;
        result = r.s.explain ? explain(&r) : r.s.parts > 0 ? part_or_join(&r) : show(&r);
        viewer_close(&r.v);
    } else {
        fprintf(stderr, "%s: not enough memory for %lld x %lld pixels\n", d->name,
                r.s.width, r.s.height);
    }
    free(r.bytes);
    if (ferror(stdout) || fflush(stdout) != 0) {
        fprintf(stderr, "%s: cannot write to standard output\n", d->name);
        result = FAILED;
    }
    return result;
}

int demo_main(int argc, char **argv, const demo *d)
{
    char **words = platform_begin(&argc, argv);
    const int result = run_demo(argc, words, d);
    platform_end(result == DONE || result == INTERRUPTED);
    return result;
}

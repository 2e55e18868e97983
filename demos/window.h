/* The window of the demos, a part of demo.c: a picture that refines, a camera and things that
 * move, the chapters' stages side by side, and the ray inspector. It knows nothing of rays:
 * the demo's demo_live does (see demo.h). Text, and lines that are smooth, need SDL2_gfx;
 * without it the window works, and the title says what is to be said. */

static rt_options options_of(run *r);
static bool finish(run *r, rt_status status, double took);

#ifdef HAVE_GFX
#include <SDL2_gfxPrimitives.h>
#endif

static const char *const window_help[] = {
    "drag        the ball, the cube, the mirror, the lamp; elsewhere: go round",
    "  + Shift   over the floor and not up",
    "right drag  the camera sideways;  wheel, PgUp, PgDn: nearer, farther",
    "arrows      go round (left, right: the sample, while a ray is shown)",
    "1 ... 7     the same view in chapter 1 ... 7",
    "b (hold)    the other picture; o: which one that is",
    "click       show the ray of this pixel; i: and no more",
    "v           the plan from above, or from the side",
    "z           a magnifying glass, with the numbers of the pixel",
    "+  -        samples        ]  [   bounces",
    "d           without noise (chapter 7);  b (hold): as it was",
    "g  gamma    l  numbers     p  packets     t  threads",
    "r           all as at first",
    "s           save the picture, and print the camera as C code",
    "h           these lines            q, Esc   the end",
};

enum { BEFORE, ONE_SAMPLE, BY_RT_H, NOISY, COMPARISONS };
static const char *const comparison_names[COMPARISONS] = {
    "the chapter before", "one sample", "rt.h's own function", "with its noise"};

enum { MOST_LINES = 1000 };

typedef struct window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    SDL_Rect area;  /* of the picture, in pixels of the screen */
    float density;  /* such pixels for one of the mouse's */
    rt_image draft; /* while something moves */
    rt_image other; /* to compare with */
    settings first; /* what the command line wanted, for r */
    bool finished;  /* it is there, and written */
    bool disturbed; /* it is no longer the picture that the command line wanted */
    bool changed;   /* what is seen has changed, so the pictures are void */
    bool save;      /* s was pressed */
    bool stop;      /* let the rendering stop: something else is to be done */
    int stage;      /* 1 to 7 */
    bool plain;     /* bytes without gamma */
    int samples;    /* that the picture is to have */
    double moving;  /* until then only drafts */
    int shrink;     /* the draft is so many halves smaller, 2 to 8 */
    double rendered, refining; /* seconds, for the rays of the image; since when */
    bool help, hold, glass;
    int comparison;
    bool inspect, side;
    int x, y, sample;       /* of the inspector */
    int button, thing;      /* what is held by the mouse, 0: nothing */
    bool dragged;           /* since the button went down: it will be no click */
    float down_x, down_y;   /* where that was, on the screen */
    float mouse_x, mouse_y; /* in the picture, in its pixels */
    int drafts;             /* so far, and for so many seconds */
    double drafts_took;
    double polled, slowest; /* the longest time between two looks at the keyboard */
} window;

/* -------------------------------------------------------------------------------------
 * What is to be shown
 * ------------------------------------------------------------------------------------- */

/* The stage in which the demo's own function stands: 5 for demo05, 7 from demo07 on. */
static int own_stage(const run *r)
{
    const int chapter = atoi(r->d->name + strcspn(r->d->name, "0123456789"));
    return chapter >= 1 && chapter < 7 ? chapter : 7;
}

/* Is noise taken out of the picture that is seen? */
static bool is_denoised(const run *r)
{
    return r->s.denoise && r->d->live && r->win->stage == 7 && !r->win->hold;
}

/* A demo's own pixels have no guides: where they are wanted, rt.h renders. */
static bool is_own(const run *r, int stage)
{
    return !r->d->live ||
           (stage == own_stage(r) && !(r->d->pixel && stage == 7 && r->s.denoise));
}

/* Is another picture rendered, to compare with? Noise has only to be left in. */
static bool shows_other(const run *r)
{
    return r->win->hold && r->win->comparison != NOISY;
}

static int wanted_samples(const run *r)
{
    return r->s.samples > 0 ? (int)r->s.samples : r->d->samples;
}

static unsigned char (*encoder(const run *r))(float value)
{
    const window *w = r->win;
    if (!w)
        return r->d->encode;
    if (w->plain)
        return demo_linear;
    const int stage = w->stage - (w->hold && w->comparison == BEFORE);
    return is_own(r, stage) ? r->d->encode : stage < 5 ? demo_linear : demo_gamma;
}

static void forget(rt_image *image)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    memset(image->pixels, 0, count * sizeof *image->pixels);
    if (image->half)
        memset(image->half, 0, count * sizeof *image->half);
    if (image->guides)
        memset(image->guides, 0, count * sizeof *image->guides);
    rt_image_clear(image);
}

/* What is seen has changed: draw drafts for a while, and begin anew. */
static void change(run *r)
{
    r->win->changed = r->win->stop = r->win->disturbed = true;
}

static void begin_anew(run *r)
{
    window *w = r->win;
    const size_t count = (size_t)r->image.width * (size_t)r->image.height;
    if (!r->image.half) /* from here on, say how large the error is */
        r->image.half = calloc(count, sizeof *r->image.half);
    if (r->s.denoise && !add_guides(&r->image))
        r->s.denoise = false;
    forget(&r->image);
    forget(&w->other);
    rt_image_clear(&r->clean);
    w->rendered = 0.0;
    w->changed = false;
}

/* -------------------------------------------------------------------------------------
 * Drawing
 * ------------------------------------------------------------------------------------- */

static void draw_text(run *r, int x, int y, const char *text, bool dark)
{
#ifdef HAVE_GFX
    const window *w = r->win;
    const float k = w->density > 1.5f ? roundf(w->density) : 1.0f;
    const unsigned char c = dark ? 40 : 240;
    SDL_RenderSetScale(w->renderer, k, k);
    stringRGBA(w->renderer, (Sint16)((float)x / k), (Sint16)((float)y / k), text, c, c, c,
               255);
    SDL_RenderSetScale(w->renderer, 1.0f, 1.0f);
#else
    (void)r, (void)x, (void)y, (void)text, (void)dark;
#endif
}

static int text_height(const run *r)
{
    return 11 * (r->win->density > 1.5f ? (int)roundf(r->win->density) : 1);
}

static void draw_line(SDL_Renderer *renderer, float x0, float y0, float x1, float y1,
                      float width, SDL_Color c)
{
#ifdef HAVE_GFX
    if (width < 2.0f)
        aalineRGBA(renderer, (Sint16)x0, (Sint16)y0, (Sint16)x1, (Sint16)y1, c.r, c.g,
                   c.b, 255);
    else
        thickLineRGBA(renderer, (Sint16)x0, (Sint16)y0, (Sint16)x1, (Sint16)y1,
                      (Uint8)width, c.r, c.g, c.b, 255);
#else
    (void)width;
    SDL_SetRenderDrawColor(renderer, c.r, c.g, c.b, 255);
    SDL_RenderDrawLine(renderer, (int)x0, (int)y0, (int)x1, (int)y1);
#endif
}

/* Where things are on the screen: the picture, and beside it, if rays are shown, the plan
 * and words below it. */
static void lay_out(run *r, SDL_Rect *plan, SDL_Rect *words)
{
    window *w = r->win;
    int width = 1, height = 1, points = 1, ignored;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_GetWindowSize(w->window, &points, &ignored);
    w->density = points > 0 ? (float)width / (float)points : 1.0f;
    const int left = w->inspect && width > 1 ? width / 2 : width;
    const double zoom =
        fmin((double)left / r->image.width, (double)height / r->image.height);
    w->area.w = (int)fmax(1.0, zoom * r->image.width);
    w->area.h = (int)fmax(1.0, zoom * r->image.height);
    w->area.x = (left - w->area.w) / 2;
    w->area.y = (height - w->area.h) / 2;
    *plan = (SDL_Rect){left, 0, width - left, height * 6 / 10};
    *words = (SDL_Rect){left, plan->h, plan->w, height - plan->h};
}

static void draw_words(run *r, char *text, SDL_Rect words)
{
    int y = words.y + 4;
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n")) {
        draw_text(r, words.x + 6, y, line, true);
        y += text_height(r);
    }
}

static const SDL_Color line_colours[] = {/* as demo_kind */
                                         {170, 170, 170, 255}, {33, 113, 181, 255},
                                         {190, 30, 140, 255},  {0, 140, 130, 255},
                                         {90, 160, 60, 255},   {230, 170, 0, 255},
                                         {30, 30, 30, 255}};

static void draw_legend(run *r, SDL_Rect plan)
{
    static const char *const names[] = {"",       "camera", "matt",     "mirror",
                                        "normal", "lamp",   "in shadow"};
    int x = plan.x + 6;
    for (int kind = LINE_CAMERA; kind <= LINE_BLOCKED; kind++) {
        const SDL_Color c = line_colours[kind];
        const int size = text_height(r) - 3;
        const SDL_Rect box = {x, plan.y + 6, size, size};
        SDL_SetRenderDrawColor(r->win->renderer, c.r, c.g, c.b, 255);
        SDL_RenderFillRect(r->win->renderer, &box);
        draw_text(r, x + size + 4, plan.y + 6, names[kind], true);
        x += size * ((int)strlen(names[kind]) + 3);
    }
}

/* The lines, seen from above (x to the right, z down) or from the side (z to the right, y
 * up), as large as the outlines of the room allow. */
static void draw_lines(run *r, const demo_line *lines, int outlines, int count,
                       SDL_Rect at)
{
    const bool side = r->win->side;
    float low[2] = {FLT_MAX, FLT_MAX}, high[2] = {-FLT_MAX, -FLT_MAX};
    for (int i = 0; i < outlines; i++)
        for (int end = 0; end < 2; end++) {
            const rt_vec3 p = end ? lines[i].to : lines[i].from;
            const float q[2] = {side ? p.z : p.x, side ? -p.y : p.z};
            for (int k = 0; k < 2; k++) {
                low[k] = fminf(low[k], q[k]);
                high[k] = fmaxf(high[k], q[k]);
            }
        }
    const float scale = fminf(0.94f * (float)at.w / (high[0] - low[0]),
                              0.94f * (float)at.h / (high[1] - low[1]));
    const float x = (float)at.x + 0.5f * ((float)at.w - scale * (low[0] + high[0]));
    const float y = (float)at.y + 0.5f * ((float)at.h - scale * (low[1] + high[1]));
    if (!(scale > 0.0f && scale < 1e6f))
        return;
    SDL_RenderSetClipRect(r->win->renderer, &at);
    for (int i = 0; i < count; i++) {
        const demo_line *l = &lines[i];
        const bool path = l->kind == LINE_CAMERA || l->kind == LINE_DIFFUSE ||
                          l->kind == LINE_MIRROR || l->kind == LINE_LIT;
        const float ends[4] = {side ? l->from.z : l->from.x,
                               side ? -l->from.y : l->from.z, side ? l->to.z : l->to.x,
                               side ? -l->to.y : l->to.z};
        float q[4];
        for (int k = 0; k < 4; k++) /* Sint16 is what SDL2_gfx takes */
            q[k] = fmaxf(-9999.0f, fminf(9999.0f, (k % 2 ? y : x) + scale * ends[k]));
        draw_line(r->win->renderer, q[0], q[1], q[2], q[3],
                  path ? 1.0f + 3.0f * l->weight : 1.0f, line_colours[l->kind]);
    }
    SDL_RenderSetClipRect(r->win->renderer, NULL);
}

/* The inspector: plan and words; the same in words, as --explain does, to where it is asked
 * (NULL: nowhere). */
static void draw_path(run *r, SDL_Rect plan, SDL_Rect at, FILE *words)
{
    static demo_line lines[MOST_LINES];
    window *w = r->win;
    const rt_options options = options_of(r);
    char *text = NULL;
    size_t size = 0;
    FILE *summary = open_memstream(&text, &size);
    const demo_live *live = r->d->live;
    const int outlines = live->outlines(w->stage, &r->view, lines, MOST_LINES);
    if (summary)
        fprintf(summary, "pixel %d,%d, sample %d, from %s (v)\n", w->x, w->y, w->sample,
                w->side ? "the side" : "above");
    const int count = outlines + live->path(w->stage, &r->view, &options, &r->image, w->x,
                                            w->y, w->sample, lines + outlines,
                                            MOST_LINES - outlines, summary, words);
    if (w->renderer && !words) {
        SDL_SetRenderDrawColor(w->renderer, 250, 250, 250, 255);
        SDL_RenderFillRect(w->renderer, &plan);
        SDL_RenderFillRect(w->renderer, &at);
        draw_legend(r, plan);
        plan.y += 2 * text_height(r);
        plan.h -= 2 * text_height(r);
        draw_lines(r, lines, outlines, count, plan);
    }
    if (summary && fclose(summary) == 0 && !words)
        draw_words(r, text, at);
    free(text);
}

/* Eleven by eleven pixels about the mouse, magnified. */
static void draw_glass(run *r, const rt_image *shown)
{
    enum { SIDE = 11, SIZE = 12 };
    const window *w = r->win;
    const int cx = (int)(w->mouse_x * (float)shown->width / (float)r->image.width);
    const int cy = (int)(w->mouse_y * (float)shown->height / (float)r->image.height);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int x = cx + i - SIDE / 2, y = cy + j - SIDE / 2;
            const bool inside = x >= 0 && y >= 0 && x < shown->width && y < shown->height;
            const unsigned char *c = r->bytes + (inside ? 3 * (y * shown->width + x) : 0);
            const SDL_Rect at = {w->area.x + 8 + i * SIZE, w->area.y + 8 + j * SIZE, SIZE,
                                 SIZE};
            SDL_SetRenderDrawColor(w->renderer, inside ? c[0] : 0, inside ? c[1] : 0,
                                   inside ? c[2] : 0, 255);
            SDL_RenderFillRect(w->renderer, &at);
        }
    const int half = SIDE / 2 * SIZE + 8;
    const SDL_Rect middle = {w->area.x + half, w->area.y + half, SIZE, SIZE};
    SDL_SetRenderDrawColor(w->renderer, 255, 255, 255, 255);
    SDL_RenderDrawRect(w->renderer, &middle);
}

/* The numbers of the pixel under the glass: linear, and encoded. */
static void describe_pixel(const run *r, const rt_image *shown, char *text, size_t size)
{
    const window *w = r->win;
    const int x = (int)(w->mouse_x * (float)shown->width / (float)r->image.width);
    const int y = (int)(w->mouse_y * (float)shown->height / (float)r->image.height);
    text[0] = '\0';
    if (x < 0 || y < 0 || x >= shown->width || y >= shown->height)
        return;
    const rt_vec3 c = shown->pixels[y * shown->width + x];
    const unsigned char *b = r->bytes + 3 * (y * shown->width + x);
    snprintf(text, size, "%d,%d: %.4g %.4g %.4g -> %d %d %d", x, y, (double)c.x,
             (double)c.y, (double)c.z, b[0], b[1], b[2]);
}

static bool is_draft(const run *r)
{
    const window *w = r->win;
    const rt_image *image = shows_other(r) ? &w->other : &r->image;
    return w->moving > 0.0 || (w->disturbed && image->samples == 0);
}

static void set_title(run *r, const rt_image *shown, const char *pixel)
{
    static const char *const names[] = {"",        "sphere", "walls",  "cube",
                                        "shadows", "gamma",  "mirror", "indirect light"};
    const window *w = r->win;
    char title[400] = "";
    FILE *t = fmemopen(title, sizeof title, "w");
    if (!t)
        return;
    fprintf(t, "%s - ", r->d->title);
    if (r->d->live)
        fprintf(t, "%d %s%s, ", w->stage, names[w->stage],
                is_own(r, w->stage) ? " (the demo's)" : "");
    if (w->hold)
        fprintf(t, "held: %s, ", comparison_names[w->comparison]);
    if (is_draft(r)) {
        fprintf(t, "%s, %.0f a second", is_denoised(r) ? "2 samples" : "direct light",
                w->drafts / fmax(w->drafts_took, 1e-9));
    } else {
        char result[100];
        const double since = w->refining > 0.0 ? demo_seconds() - w->refining : 0.0;
        describe(shown == &r->clean ? &r->image : shown, result, sizeof result);
        fprintf(t, "%s", result);
        if (shown == &r->clean)
            fprintf(t, ", finished");
        if (shown == &r->clean && shown->samples >= w->samples)
            fprintf(t, ": at most %.2f %%", 100.0 * (double)clean_error(r));
        if (shown->samples < w->samples && !w->hold)
            fprintf(t, " (%d wanted)", w->samples);
        fprintf(t, ", %.1f Mrays/s",
                (double)shown->rays * 1e-6 / fmax(w->rendered + since, 1e-3));
    }
    if (w->stage == 7 && !(r->d->pixel && is_own(r, 7)))
        fprintf(t, ", %d at a time", rt_lane_count((int)r->s.lanes));
    const int threads = rt_thread_count((int)r->s.threads);
    fprintf(t, ", %d thread%s, %s, %s%s%s (h: keys)", threads, plural(threads),
            bounces_in_words(r), r->s.sampler == RT_RANDOM ? "random" : "sobol",
            *pixel ? " - " : "", pixel);
    fclose(t);
    SDL_SetWindowTitle(w->window, title);
}

static const rt_image *shown_image(run *r)
{
    const rt_image *image = is_draft(r)      ? &r->win->draft
                            : shows_other(r) ? &r->win->other
                                             : &r->image;
    if (is_denoised(r) && image->guides && image->samples >= 2 &&
        denoise(r, image, rt_denoise) == RT_OK)
        return &r->clean;
    return image;
}

static void draw(run *r)
{
    window *w = r->win;
    SDL_Rect plan, words;
    char pixel[120] = "";
    const rt_image *shown = shown_image(r);
    const SDL_Rect part = {0, 0, shown->width, shown->height};
    lay_out(r, &plan, &words);
    encode(r, shown);
    SDL_UpdateTexture(w->texture, &part, r->bytes, 3 * shown->width);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 255);
    SDL_RenderClear(w->renderer);
    SDL_RenderCopy(w->renderer, w->texture, &part, &w->area);
    if (w->inspect) {
        const float zoom = (float)w->area.w / (float)r->image.width;
        const int x = w->area.x + (int)(zoom * ((float)w->x + 0.5f));
        const int y = w->area.y + (int)(zoom * ((float)w->y + 0.5f));
        const SDL_Rect cross[2] = {{x - 8, y, 17, 1}, {x, y - 8, 1, 17}};
        SDL_SetRenderDrawColor(w->renderer, 255, 255, 255, 255);
        SDL_RenderFillRects(w->renderer, cross, 2);
        draw_path(r, plan, words, NULL);
    }
    if (w->glass) {
        draw_glass(r, shown);
        describe_pixel(r, shown, pixel, sizeof pixel);
        draw_text(r, w->area.x + 8, w->area.y + 146, pixel, false);
    }
    if (w->help) {
        const int lines = (int)(sizeof window_help / sizeof window_help[0]);
        const SDL_Rect box = {w->area.x, w->area.y, 620 * text_height(r) / 11,
                              (lines + 1) * text_height(r)};
        SDL_SetRenderDrawBlendMode(w->renderer, SDL_BLENDMODE_BLEND);
        SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 190);
        SDL_RenderFillRect(w->renderer, &box);
        for (int i = 0; i < lines; i++)
            draw_text(r, box.x + 8, box.y + 6 + i * text_height(r), window_help[i],
                      false);
    }
    set_title(r, shown, pixel);
    SDL_RenderPresent(w->renderer);
}

/* -------------------------------------------------------------------------------------
 * Events
 * ------------------------------------------------------------------------------------- */

static void say_what_is_under(run *r)
{
    SDL_Rect plan = {0, 0, 1, 1};
    if (r->s.quiet)
        return;
    end_progress(r);
    printf("%s: pixel %d,%d of %d x %d, %s\n", r->d->name, r->win->x, r->win->y,
           r->image.width, r->image.height, bounces_in_words(r));
    draw_path(r, plan, plan, stdout);
    fflush(stdout);
}

static void inspect(run *r, int x, int y)
{
    window *w = r->win;
    SDL_Rect desk;
    int width, height;
    if (x < 0 || y < 0 || x >= r->image.width || y >= r->image.height)
        return;
    if (!w->inspect && SDL_GetDisplayUsableBounds(0, &desk) == 0) {
        SDL_GetWindowSize(w->window, &width, &height);
        SDL_SetWindowSize(w->window, 2 * width < desk.w ? 2 * width : desk.w, height);
        SDL_SetWindowPosition(w->window, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED);
    }
    if (!w->inspect)
        w->sample = 0;
    w->inspect = true;
    w->x = x;
    w->y = y;
}

static void inspect_no_more(run *r)
{
    int width, height;
    SDL_GetWindowSize(r->win->window, &width, &height);
    SDL_SetWindowSize(r->win->window, width / 2, height);
    r->win->inspect = false;
}

static void save_view(run *r)
{
    r->win->save = false;
    r->win->polled = 0.0; /* it writes the file */
    if (is_denoised(r) && r->image.guides && r->image.samples >= 2)
        denoise(r, &r->image, rt_denoise);
    if (!save(r) || r->s.quiet)
        return;
    end_progress(r);
    printf("%s: saved %s\n", r->d->name, r->s.out);
    if (r->d->live)
        r->d->live->print();
    fflush(stdout);
}

static void show_help(run *r)
{
    r->win->help = !r->win->help;
#ifndef HAVE_GFX
    for (size_t i = 0; i < sizeof window_help / sizeof window_help[0] && r->win->help;
         i++)
        printf("%s\n", window_help[i]);
    fflush(stdout);
#endif
}

/* The speed is counted anew. */
static void count_anew(run *r)
{
    r->win->stop = true;
    r->win->rendered = 0.0;
    r->image.rays = r->win->other.rays = 0;
}

static void set_samples(run *r, int samples)
{
    r->win->samples = samples < 1 ? 1 : samples < 1 << 20 ? samples : 1 << 20;
    r->win->stop = r->win->disturbed = true; /* what there is already, stays */
}
/* 0 to 90, and then all that there are. */
static void more_bounces(run *r, int more)
{
    const long long now = r->s.bounces < 91 ? r->s.bounces : 91, next = now + more;
    r->s.bounces = next < 0 ? 0 : next < 91 ? next : RT_ALL_BOUNCES;
}

/* Keys that move the camera or change what is seen. False: it is none of them. */
static bool change_by_key(run *r, SDL_Keycode key)
{
    window *w = r->win;
    const demo_live *live = r->d->live;
    const float step = 1.0f / 64.0f; /* of a turn */
    switch (key) {
    case SDLK_1:
    case SDLK_2:
    case SDLK_3:
    case SDLK_4:
    case SDLK_5:
    case SDLK_6:
    case SDLK_7: w->stage = (int)(key - SDLK_0); break;
    case SDLK_LEFT: live->orbit(-step, 0); break;
    case SDLK_RIGHT: live->orbit(step, 0); break;
    case SDLK_UP: live->orbit(0, step); break;
    case SDLK_DOWN: live->orbit(0, -step); break;
    case SDLK_PAGEUP: live->zoom(0.9f); break;
    case SDLK_PAGEDOWN: live->zoom(1.0f / 0.9f); break;
    case SDLK_l: r->s.sampler = r->s.sampler == RT_RANDOM ? RT_SOBOL : RT_RANDOM; break;
    case SDLK_RIGHTBRACKET: more_bounces(r, 1); break;
    case SDLK_LEFTBRACKET: more_bounces(r, -1); break;
    case SDLK_r:
        live->reset();
        r->s = w->first;
        w->stage = own_stage(r);
        w->samples = wanted_samples(r);
        w->plain = w->glass = w->help = w->side = false;
        w->comparison = r->s.denoise ? NOISY : BEFORE;
        break;
    default: return false;
    }
    r->view.bounces = (int)r->s.bounces;
    return true;
}

static void handle_key(run *r, SDL_Keycode key, bool repeated)
{
    window *w = r->win;
    const int threads = rt_thread_count((int)r->s.threads);
    r->draw_due = 0.0;
    switch (key) {
    case SDLK_ESCAPE:
    case SDLK_q: r->closed = true; return;
    case SDLK_s: w->save = w->save || !repeated; return;
    case SDLK_z: w->glass = !w->glass; return;
    case SDLK_g: w->plain = !w->plain; return;
    case SDLK_h: show_help(r); return;
    case SDLK_PLUS:
    case SDLK_EQUALS:
    case SDLK_KP_PLUS: set_samples(r, 2 * w->samples); return;
    case SDLK_MINUS:
    case SDLK_KP_MINUS: set_samples(r, w->samples / 2); return;
    case SDLK_t:
        r->s.threads = threads < rt_thread_count(0) ? threads + 1 : 1;
        count_anew(r);
        return;
    case SDLK_p:
        r->s.lanes = r->s.lanes == 1 ? 0 : 1;
        count_anew(r);
        return;
    default: break;
    }
    if (!r->d->live)
        return;
    switch (key) {
    case SDLK_d:
        if (w->stage != 7)
            return;
        r->s.denoise = !r->s.denoise;
        w->comparison = r->s.denoise ? NOISY : BEFORE;
        if (!r->image.guides)
            change(r);
        w->stop = true;
        return;
    case SDLK_v: w->side = !w->side; return;
    case SDLK_i:
        if (w->inspect)
            inspect_no_more(r);
        return;
    case SDLK_b:
        if (!w->hold)
            count_anew(r);
        w->hold = true;
        return;
    case SDLK_o:
        w->comparison = (w->comparison + 1) % (r->s.denoise ? COMPARISONS : NOISY);
        forget(&w->other);
        w->stop = true;
        return;
    default: break;
    }
    if (w->inspect && (key == SDLK_LEFT || key == SDLK_RIGHT))
        w->sample += key == SDLK_RIGHT ? 1 : w->sample > 0 ? -1 : 0;
    else if (change_by_key(r, key))
        change(r);
}

static bool on_picture(const run *r)
{
    const window *w = r->win;
    return w->mouse_x >= 0.0f && w->mouse_y >= 0.0f &&
           w->mouse_x < (float)r->image.width && w->mouse_y < (float)r->image.height;
}

static void handle_motion(run *r, float x, float y)
{
    window *w = r->win;
    const demo_live *live = r->d->live;
    if (w->area.w == 0) /* nothing is drawn yet */
        return;
    if (w->button != 0 && fabsf(x - w->down_x) + fabsf(y - w->down_y) > 4.0f)
        w->dragged = true;
    if (w->button != 0 && !w->dragged) /* it may still become a click */
        return;
    const float old_x = w->mouse_x, old_y = w->mouse_y;
    w->mouse_x = (x - (float)w->area.x) * (float)r->image.width / (float)w->area.w;
    w->mouse_y = (y - (float)w->area.y) * (float)r->image.height / (float)w->area.h;
    const float right = w->mouse_x - old_x, up = old_y - w->mouse_y;
    if (w->glass)
        r->draw_due = 0.0;
    if (w->button != 0 && live) {
        const float turn = 0.5f / (float)r->image.width;
        if (w->button != SDL_BUTTON_LEFT)
            live->pan(&r->view, -right, -up);
        else if (w->thing != 0)
            live->drag(w->thing, &r->view, right, up,
                       (SDL_GetModState() & KMOD_SHIFT) != 0);
        else
            live->orbit(-turn * right, -turn * up);
        change(r);
    } else if (w->inspect && w->button == 0 && on_picture(r)) {
        inspect(r, (int)w->mouse_x, (int)w->mouse_y);
        r->draw_due = 0.0;
    }
}

static void handle(run *r, const SDL_Event *e)
{
    window *w = r->win;
    const demo_live *live = r->d->live;
    switch (e->type) {
    case SDL_QUIT: r->closed = true; break;
    case SDL_WINDOWEVENT:
    case SDL_RENDER_TARGETS_RESET: r->draw_due = 0.0; break;
    case SDL_KEYDOWN:
        if (!(e->key.keysym.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI)))
            handle_key(r, e->key.keysym.sym, e->key.repeat != 0);
        break;
    case SDL_KEYUP:
        if (e->key.keysym.sym == SDLK_b && w->hold) {
            w->hold = false;
            count_anew(r);
            r->draw_due = 0.0;
        }
        break;
    case SDL_MOUSEBUTTONDOWN:
        handle_motion(r, w->density * (float)e->button.x,
                      w->density * (float)e->button.y);
        if (!on_picture(r))
            break;
        w->button = e->button.button;
        w->dragged = false;
        w->down_x = w->density * (float)e->button.x;
        w->down_y = w->density * (float)e->button.y;
        w->thing = live ? live->pick(w->stage, &r->view, w->mouse_x, w->mouse_y) : 0;
        break;
    case SDL_MOUSEBUTTONUP:
        if (live && w->button == SDL_BUTTON_LEFT && !w->dragged) {
            inspect(r, (int)w->mouse_x, (int)w->mouse_y);
            say_what_is_under(r);
            r->draw_due = 0.0;
        }
        w->button = 0;
        break;
    case SDL_MOUSEMOTION:
        handle_motion(r, w->density * (float)e->motion.x,
                      w->density * (float)e->motion.y);
        break;
    case SDL_MOUSEWHEEL:
        if (live && e->wheel.y != 0) {
            live->zoom(powf(0.9f, (float)e->wheel.y));
            change(r);
        }
        break;
    default: break;
    }
}

static void poll_events(run *r)
{
    window *w = r->win;
    SDL_Event event;
    const double now = demo_seconds();
    if (w->polled > 0.0 && now - w->polled > w->slowest)
        w->slowest = now - w->polled;
    while (!r->closed && SDL_PollEvent(&event))
        handle(r, &event);
    w->polled = demo_seconds();
    if (w->save && !(w->disturbed && r->image.samples == 0)) /* not before there is one */
        save_view(r);
}

/* Draw, and not again before so many times as long: 20 are 5 % of the time. */
static void draw_in_time(run *r, double pause)
{
    const double now = demo_seconds();
    draw(r);
    const double took = demo_seconds() - now;
    r->draw_due = now + took + (pause * took > 0.033 ? pause * took : 0.033);
}

/* Every few milliseconds, while no thread writes to the image: so the window answers, and the
 * image may be read. False: stop. */
static bool window_progress(run *r)
{
    poll_events(r);
    if (!r->closed && !r->win->stop && demo_seconds() >= r->draw_due) {
        if (is_denoised(r)) /* on all cores, so not while they render */
            r->win->stop = true;
        else
            draw_in_time(r, 20.0);
    }
    return !r->closed && !interrupted && !r->win->stop;
}

/* -------------------------------------------------------------------------------------
 * The window from its opening to its end
 * ------------------------------------------------------------------------------------- */

static run *open_run; /* which has a window */

/* Xlib ends the program when the display is lost. Then at least save what there is. */
static void display_lost(void)
{
    if (open_run && !open_run->win->disturbed && !open_run->win->finished) {
        fprintf(stderr, "%s: the display is gone\n", open_run->d->name);
        finish(open_run, RT_CANCELLED, demo_seconds() - open_run->started);
    }
}

static void close_window(run *r)
{
    window *w = r->win;
    open_run = NULL;
    SDL_DestroyTexture(w->texture);
    SDL_DestroyRenderer(w->renderer);
    SDL_DestroyWindow(w->window);
    free(w->draft.pixels);
    free(w->draft.half);
    free(w->draft.guides);
    free(w->other.pixels);
    r->win = NULL;
    SDL_Quit();
}

/* Without a display SDL succeeds all the same, with a driver that shows nothing, and the
 * libraries that it asks complain on stderr: on Linux look before asking. */
static bool have_display(void)
{
#ifdef __linux__
    if (!getenv("DISPLAY") && !getenv("WAYLAND_DISPLAY"))
        return false;
#endif
    SDL_SetHint(SDL_HINT_NO_SIGNAL_HANDLERS, "1"); /* Ctrl-C is ours */
    SDL_SetMainReady();
    if (SDL_Init(SDL_INIT_VIDEO) != 0)
        return false;
    const char *driver = SDL_GetCurrentVideoDriver();
    return driver && strcmp(driver, "offscreen") != 0 && strcmp(driver, "dummy") != 0;
}

static rt_image new_image(const run *r)
{
    rt_image image = {.width = r->image.width, .height = r->image.height};
    image.pixels = new_pixels(image.width, image.height);
    return image;
}

static void open_window(run *r)
{
    static window the_window;
    window *w = &the_window;
    const int width = r->image.width, height = r->image.height;
    const char *why = "no display";
    r->win = w;
    w->stage = own_stage(r);
    w->shrink = 2;
    w->samples = wanted_samples(r);
    w->comparison = r->s.denoise ? NOISY : BEFORE;
    w->first = r->s;
    if (have_display()) {
        SDL_Rect desk = {0, 0, width, height};
        SDL_GetDisplayUsableBounds(0, &desk);
        /* small pictures are enlarged, large ones fitted to the desk */
        double zoom = 1.0;
        while (width * zoom < 160.0 && height * zoom < 160.0)
            zoom *= 2.0;
        SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, zoom > 1.0 ? "nearest" : "linear");
        if (width * zoom > 0.9 * desk.w)
            zoom = 0.9 * desk.w / width;
        if (height * zoom > 0.9 * desk.h)
            zoom = 0.9 * desk.h / height;
        w->window = SDL_CreateWindow(
            r->d->title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
            1 + (int)(width * zoom - 0.5), 1 + (int)(height * zoom - 0.5),
            SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
        if (w->window)
            SDL_SetWindowMinimumSize(w->window, 160, 120);
        if (w->window)
            w->renderer = SDL_CreateRenderer(w->window, -1, 0);
        if (w->renderer)
            w->texture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_RGB24,
                                           SDL_TEXTUREACCESS_STREAMING, width, height);
        why = SDL_GetError();
        w->draft = new_image(r);
        w->other = new_image(r);
    }
    if (w->texture && w->draft.pixels && w->other.pixels) {
        open_run = r;
        atexit(display_lost);
        if (r->d->live)
            r->d->live->reset();
        return;
    }
    if (!r->s.quiet)
        printf("%s: no window (%s)\n", r->d->name, why);
    close_window(r);
}

static rt_vec3 call_pixel(const void *context, float x, float y, rt_rng *rng)
{
    const run *r = context;
    return r->d->pixel(&r->view, x, y, rng);
}

/* By the demo itself. */
static rt_status render_own(run *r, const rt_options *options, rt_image *image)
{
    return r->d->render ? r->d->render(options, image)
                        : rt_render_pixels(call_pixel, r, options, image);
}

/* Direct light, or two samples without their noise, at once; smaller, where that takes
 * long. */
static void draw_draft(run *r)
{
    window *w = r->win;
    const double start = demo_seconds();
    rt_image *image = &w->draft;
    image->width = (2 * r->image.width - 1) / w->shrink + 1;
    image->height = (2 * r->image.height - 1) / w->shrink + 1;
    const bool clean = is_denoised(r) && add_guides(image);
    forget(image);
    rt_image_clear(&r->clean);
    run small = *r;
    small.view.width = image->width;
    small.view.height = image->height;
    rt_options options = options_of(r);
    options.samples = clean ? 2 : 1;
    options.error = options.seconds = 0.0f;
    options.progress = NULL;
    const int stage = w->stage - (w->hold && w->comparison == BEFORE && w->stage > 1);
    if (clean)
        r->d->live->render(stage, &small.view, &options, image);
    else if (is_own(r, stage) && r->d->pixel && stage < 7)
        rt_render_pixels(call_pixel, &small, &options, image);
    else
        r->d->live->draft(stage, &small.view, &options, image);
    poll_events(r);
    draw(r);
    const double took = demo_seconds() - start;
    /* not longer than that, and as large as that allows */
    const double most = clean ? 0.050 : 0.025, larger = (w->shrink - 1.0) / w->shrink;
    if (took > most && w->shrink < 8)
        w->shrink++;
    else if (took < 0.95 * most * larger * larger && w->shrink > 2)
        w->shrink--;
    w->drafts++;
    w->drafts_took += took;
}

/* As many samples as are missing, or until something else is to be done. */
static rt_status refine(run *r)
{
    window *w = r->win;
    rt_image *image = shows_other(r) ? &w->other : &r->image;
    rt_options options = options_of(r);
    int stage = w->stage;
    if (w->disturbed)
        options.error = options.seconds = 0.0f;
    if (w->disturbed || options.samples > 0)
        options.samples = (w->disturbed ? w->samples : options.samples) - image->samples;
    if (w->hold && w->comparison == BEFORE && stage > 1)
        stage--;
    if (w->hold && w->comparison == ONE_SAMPLE)
        options.samples = 1;
    w->refining = demo_seconds();
    rt_status status;
    if (!is_own(r, stage) || (w->hold && w->comparison == BY_RT_H && r->d->live))
        status = r->d->live->render(stage, &r->view, &options, image);
    else
        status = render_own(r, &options, image);
    w->rendered += demo_seconds() - w->refining;
    w->refining = 0.0;
    return status;
}

/* Until it is closed. True, if all went well. */
static bool run_window(run *r)
{
    window *w = r->win;
    bool good = true;
    const double started = demo_seconds();
    r->draw_due = 0.0;
    while (!r->closed && !interrupted) {
        w->stop = false;
        poll_events(r);
        const double now = demo_seconds();
        const rt_image *image = shows_other(r) ? &w->other : &r->image;
        const int wanted = w->hold && w->comparison == ONE_SAMPLE ? 1 : w->samples;
        if (w->changed) {
            begin_anew(r);
            w->moving = now + 0.15;
            draw_draft(r);
        } else if (w->moving > 0.0) { /* a little rest, and then in earnest */
            if (now < w->moving)
                SDL_WaitEventTimeout(NULL, (int)(1000.0 * (w->moving - now)) + 1);
            else
                w->moving = 0.0;
            w->polled = 0.0;
        } else if (w->disturbed || shows_other(r) ? image->samples < wanted
                                                  : !w->finished) {
            const rt_status status = refine(r);
            if (status != RT_OK && status != RT_CANCELLED) {
                finish(r, status, 0.0);
                return false;
            }
            if (is_denoised(r))
                draw_in_time(r, 4.0);
            if (!w->disturbed && !shows_other(r) && (status == RT_OK || interrupted)) {
                w->finished = true;
                good = finish(r, status, demo_seconds() - started);
                w->samples = r->image.samples;
                w->polled = 0.0; /* it was writing the file */
            }
            if (!is_denoised(r) || status == RT_OK)
                r->draw_due = 0.0;
        } else {
            if (r->draw_due == 0.0)
                draw(r);
            r->draw_due = 1.0;
            SDL_WaitEventTimeout(NULL, 100);
            w->polled = 0.0; /* nobody had to wait */
        }
    }
    if (!r->s.quiet && !w->finished)
        printf("%s: closed after %.2f s, before the end\n", r->d->name,
               demo_seconds() - started);
    if (!r->s.quiet && w->drafts > 0)
        printf("%s: %d pictures in motion, %.0f a second; the longest wait for the "
               "keyboard: "
               "%.0f ms\n",
               r->d->name, w->drafts, w->drafts / w->drafts_took, 1e3 * w->slowest);
    return good;
}

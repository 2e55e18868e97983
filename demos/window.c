/* The window of the demos: see window.h. It draws what viewer.h says and hands on keys and mouse.
 * Text, and lines that are smooth, need SDL2_gfx; without it the window works, and the title says
 * what is to be said. */
#include "window.h"

#include <stdlib.h>
#include <string.h>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#ifdef HAVE_GFX
#include <SDL2_gfxPrimitives.h>
#endif

static const char *const window_help[] = {
    "drag        a ball, the cube, the teapot, the lamp; elsewhere: go round",
    "  + Shift   over the floor and not up",
    "right drag  the camera sideways;  wheel, PgUp, PgDn: nearer, farther",
    "  wheel     on the lamp its size, on gloss its sharpness, on glass its index",
    "arrows      go round (left, right: the sample, while a ray is shown)",
    "1 ... 7     the same view in chapter 1 ... 7;  8 glass, 9 lamps, 0 gloss;",
    ",  .         one picture back, one on: also to those that have no key",
    "b (hold)    the other picture; o: which one that is",
    "click       show the ray of this pixel; i: and no more",
    "v           the plan from above, or from the side",
    "z           a magnifying glass, with the numbers of the pixel",
    "+  -        samples        ]  [   bounces",
    "d           without noise (chapter 7);  b (hold): as it was",
    "g  gamma    w  e  exposure, down and up",
    "l  numbers  p  packets     t  threads",
    "r           all as at first",
    "s           save the picture, and print the camera as C code",
    "h           these lines            q, Esc   the end",
};

struct window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    SDL_Rect area;        /* of the picture, in pixels of the screen */
    float density;        /* such pixels for one of the mouse's */
    unsigned char *bytes; /* of the picture, 3 for each pixel */
    bool wide;            /* with room for the plan */
    bool said_help;       /* in the terminal */
    double due;           /* when it may be drawn again */
    double polled, slowest;
};

double demo_seconds(void)
{
    return (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

/* -------------------------------------------------------------------------------------
 * Drawing
 * ------------------------------------------------------------------------------------- */

static void draw_text(const window *w, int x, int y, const char *words, bool dark)
{
#ifdef HAVE_GFX
    const float k = w->density > 1.5f ? roundf(w->density) : 1.0f;
    const unsigned char c = dark ? 40 : 240;
    SDL_RenderSetScale(w->renderer, k, k);
    stringRGBA(w->renderer, (Sint16)((float)x / k), (Sint16)((float)y / k), words, c, c,
               c, 255);
    SDL_RenderSetScale(w->renderer, 1.0f, 1.0f);
#else
    (void)w, (void)x, (void)y, (void)words, (void)dark;
#endif
}

static int text_height(const window *w)
{
    return 11 * (w->density > 1.5f ? (int)roundf(w->density) : 1);
}

static void draw_words(const window *w, char *words, SDL_Rect at)
{
    int y = at.y + 4;
    for (char *line = strtok(words, "\n"); line; line = strtok(NULL, "\n")) {
        draw_text(w, at.x + 6, y, line, true);
        y += text_height(w);
    }
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

/* Where things are on the screen: the picture, and beside it, if a path is shown, the plan
 * and words below it. */
static void lay_out(window *w, viewer *v, SDL_Rect *plan, SDL_Rect *words)
{
    int width = 1, height = 1, points = 1, ignored;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_GetWindowSize(w->window, &points, &ignored);
    w->density = points > 0 ? (float)width / (float)points : 1.0f;
    const int left = v->inspect && width > 1 ? width / 2 : width;
    const double zoom =
        fmin((double)left / v->view.width, (double)height / v->view.height);
    w->area.w = (int)fmax(1.0, zoom * v->view.width);
    w->area.h = (int)fmax(1.0, zoom * v->view.height);
    w->area.x = (left - w->area.w) / 2;
    w->area.y = (height - w->area.h) / 2;
    v->slack = 4.0f * (float)v->view.width / (float)w->area.w;
    *plan = (SDL_Rect){left, 0, width - left, height * 6 / 10};
    *words = (SDL_Rect){left, plan->h, plan->w, height - plan->h};
}

static const SDL_Color line_colours[] = {/* as demo_kind */
                                         {170, 170, 170, 255}, {33, 113, 181, 255},
                                         {190, 30, 140, 255},  {0, 140, 130, 255},
                                         {90, 160, 60, 255},   {230, 170, 0, 255},
                                         {30, 30, 30, 255},    {230, 110, 40, 255},
                                         {120, 90, 220, 255}};

static void draw_legend(const window *w, const viewer *v, SDL_Rect plan)
{
    int x = plan.x + 6;
    const int kinds = v->stage > VIEWER_INDIRECT ? LINE_KINDS : LINE_GLOSS;
    for (int kind = LINE_CAMERA; kind < kinds; kind++) {
        const SDL_Color c = line_colours[kind];
        const char *name = viewer_kind_name((demo_kind)kind);
        const int size = text_height(w) - 3;
        const SDL_Rect box = {x, plan.y + 6, size, size};
        SDL_SetRenderDrawColor(w->renderer, c.r, c.g, c.b, 255);
        SDL_RenderFillRect(w->renderer, &box);
        draw_text(w, x + size + 4, plan.y + 6, name, true);
        x += size * ((int)strlen(name) + 3);
    }
}

static void draw_plan(const window *w, const viewer *v, SDL_Rect plan, SDL_Rect at)
{
    static viewer_line lines[VIEWER_LINES];
    static char words[1 << 14];
    demo_text summary = text_in(words, sizeof words);
    SDL_SetRenderDrawColor(w->renderer, 250, 250, 250, 255);
    SDL_RenderFillRect(w->renderer, &plan);
    SDL_RenderFillRect(w->renderer, &at);
    draw_legend(w, v, plan);
    plan.y += 2 * text_height(w);
    plan.h -= 2 * text_height(w);
    const int count = viewer_plan(v, (float)plan.w, (float)plan.h, lines, &summary);
    SDL_RenderSetClipRect(w->renderer, &plan);
    for (int i = 0; i < count; i++) {
        const viewer_line *l = &lines[i];
        float q[4] = {l->x0, l->y0, l->x1, l->y1};
        for (int k = 0; k < 4; k++) { /* Sint16 is what SDL2_gfx takes */
            q[k] += (float)(k % 2 ? plan.y : plan.x);
            q[k] = fmaxf(-9999.0f, fminf(9999.0f, q[k]));
        }
        draw_line(w->renderer, q[0], q[1], q[2], q[3], l->width, line_colours[l->kind]);
    }
    SDL_RenderSetClipRect(w->renderer, NULL);
    draw_words(w, words, at);
}

/* A cross on the pixel whose path is shown, and the plan. */
static void draw_inspector(const window *w, const viewer *v, SDL_Rect plan,
                           SDL_Rect words)
{
    const float zoom = (float)w->area.w / (float)v->view.width;
    const int x = w->area.x + (int)(zoom * ((float)v->x + 0.5f));
    const int y = w->area.y + (int)(zoom * ((float)v->y + 0.5f));
    const SDL_Rect cross[2] = {{x - 8, y, 17, 1}, {x, y - 8, 1, 17}};
    SDL_SetRenderDrawColor(w->renderer, 255, 255, 255, 255);
    SDL_RenderFillRects(w->renderer, cross, 2);
    draw_plan(w, v, plan, words);
}

/* Eleven by eleven pixels about the mouse, magnified. */
static void draw_glass(const window *w, const viewer *v, const rt_image *shown)
{
    enum { SIDE = 11, SIZE = 12 };
    const int cx = (int)(v->mouse_x * (float)shown->width / (float)v->view.width);
    const int cy = (int)(v->mouse_y * (float)shown->height / (float)v->view.height);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int x = cx + i - SIDE / 2, y = cy + j - SIDE / 2;
            const bool inside = x >= 0 && y >= 0 && x < shown->width && y < shown->height;
            const unsigned char *c = w->bytes + (inside ? 3 * (y * shown->width + x) : 0);
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

static void draw_help(const window *w)
{
    const int lines = (int)(sizeof window_help / sizeof window_help[0]);
    const int height = text_height(w);
    const SDL_Rect box = {w->area.x, w->area.y, 620 * height / 11, (lines + 1) * height};
    SDL_SetRenderDrawBlendMode(w->renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 190);
    SDL_RenderFillRect(w->renderer, &box);
    for (int i = 0; i < lines; i++)
        draw_text(w, box.x + 8, box.y + 6 + i * height, window_help[i], false);
}

static void set_title(const window *w, viewer *v, const rt_image *shown,
                      const char *pixel)
{
    char words[400];
    demo_text t = text_in(words, sizeof words);
    const rt_image *noisy = shown == &v->clean ? &v->image : shown;
    const int threads = rt_thread_count(v->options.threads);
    text_add(&t, "%s - ", v->d->title);
    viewer_say_stage(v, &t);
    viewer_say_progress(v, shown, rt_image_error(noisy), demo_seconds(), &t);
    if (viewer_has_lanes(v))
        text_add(&t, ", %d at a time", rt_lane_count(v->options.lanes));
    text_add(&t, ", %d thread%s, %s, %s%s%s (h: keys)", threads, viewer_plural(threads),
             viewer_bounces(v), v->options.sampler == RT_RANDOM ? "random" : "sobol",
             *pixel ? " - " : "", pixel);
    SDL_SetWindowTitle(w->window, words);
}

/* The plan needs as much room again, if the screen has it. */
static void widen(window *w, const viewer *v)
{
    SDL_Rect desk;
    int width, height;
    if (w->wide == v->inspect)
        return;
    w->wide = v->inspect;
    SDL_GetWindowSize(w->window, &width, &height);
    if (!v->inspect) {
        SDL_SetWindowSize(w->window, width / 2, height);
    } else if (SDL_GetDisplayUsableBounds(0, &desk) == 0) {
        SDL_SetWindowSize(w->window, 2 * width < desk.w ? 2 * width : desk.w, height);
        SDL_SetWindowPosition(w->window, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED);
    }
}

void window_draw(window *w, viewer *v)
{
    SDL_Rect plan, words;
    char numbers[120];
    demo_text pixel = text_in(numbers, sizeof numbers);
    const rt_image *shown = viewer_shown(v);
    const SDL_Rect part = {0, 0, shown->width, shown->height};
    v->redraw = false;
    widen(w, v);
    lay_out(w, v, &plan, &words);
    viewer_encode(v, v->hold, shown, 3, w->bytes);
    SDL_UpdateTexture(w->texture, &part, w->bytes, 3 * shown->width);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 255);
    SDL_RenderClear(w->renderer);
    SDL_RenderCopy(w->renderer, w->texture, &part, &w->area);
    if (v->inspect)
        draw_inspector(w, v, plan, words);
    if (v->glass) {
        draw_glass(w, v, shown);
        viewer_say_pixel(v, shown, w->bytes, &pixel);
        draw_text(w, w->area.x + 8, w->area.y + 146, numbers, false);
    }
    if (v->help)
        draw_help(w);
    set_title(w, v, shown, numbers);
    SDL_RenderPresent(w->renderer);
}

void window_draw_in_time(window *w, viewer *v, double pause)
{
    const double now = demo_seconds();
    window_draw(w, v);
    const double took = demo_seconds() - now;
    w->due = now + took + (pause * took > 0.033 ? pause * took : 0.033);
}

bool window_is_due(const window *w)
{
    return demo_seconds() >= w->due;
}

/* -------------------------------------------------------------------------------------
 * Events
 * ------------------------------------------------------------------------------------- */

/* The viewer's name of a key; 0: none. Where digits need Shift, as on a French keyboard, the keys
 * of the row count by their place. */
static int key_of(SDL_Keysym key)
{
    switch (key.sym) {
    case SDLK_LEFT: return KEY_LEFT;
    case SDLK_RIGHT: return KEY_RIGHT;
    case SDLK_UP: return KEY_UP;
    case SDLK_DOWN: return KEY_DOWN;
    case SDLK_PAGEUP: return KEY_NEARER;
    case SDLK_PAGEDOWN: return KEY_FARTHER;
    case SDLK_KP_PLUS: return '+';
    case SDLK_KP_MINUS: return '-';
    default: break;
    }
    const bool row = key.scancode >= SDL_SCANCODE_1 && key.scancode <= SDL_SCANCODE_0;
    const bool sign = key.sym == '-' || key.sym == '=' || key.sym == '+'; /* also there */
    if (row && (!sign || (key.mod & KMOD_SHIFT) != 0))
        return '0' + (int)(key.scancode - SDL_SCANCODE_1 + 1) % 10;
    return key.sym > 0 && key.sym < 128 ? (int)key.sym : 0;
}

static void handle_key(window *w, viewer *v, SDL_Keysym key, bool repeated)
{
    if (key.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI))
        return;
    w->due = 0.0;
    viewer_key(v, key_of(key), repeated);
#ifndef HAVE_GFX
    for (size_t i = 0; i < sizeof window_help / sizeof window_help[0] && v->help; i++)
        if (!w->said_help)
            printf("%s\n", window_help[i]);
    fflush(stdout);
    w->said_help = v->help;
#endif
}

/* A place in the window as one in the picture. */
static float picture_x(const window *w, const viewer *v, int x)
{
    return (w->density * (float)x - (float)w->area.x) * (float)v->view.width /
           (float)w->area.w;
}

static float picture_y(const window *w, const viewer *v, int y)
{
    return (w->density * (float)y - (float)w->area.y) * (float)v->view.height /
           (float)w->area.h;
}

static void handle(window *w, viewer *v, const SDL_Event *e)
{
    switch (e->type) {
    case SDL_QUIT: v->closed = true; break;
    case SDL_WINDOWEVENT:
    case SDL_RENDER_TARGETS_RESET: w->due = 0.0; break;
    case SDL_KEYDOWN: handle_key(w, v, e->key.keysym, e->key.repeat != 0); break;
    case SDL_KEYUP: viewer_key_up(v, key_of(e->key.keysym)); break;
    case SDL_MOUSEBUTTONDOWN:
        if (w->area.w > 0) /* it was drawn */
            viewer_press(v, picture_x(w, v, e->button.x), picture_y(w, v, e->button.y),
                         e->button.button == SDL_BUTTON_LEFT ? BUTTON_MAIN
                                                             : BUTTON_OTHER);
        break;
    case SDL_MOUSEBUTTONUP: viewer_release(v); break;
    case SDL_MOUSEMOTION:
        if (w->area.w > 0)
            viewer_move(v, picture_x(w, v, e->motion.x), picture_y(w, v, e->motion.y),
                        (SDL_GetModState() & KMOD_SHIFT) != 0);
        break;
    case SDL_MOUSEWHEEL:
        if (e->wheel.y != 0)
            viewer_wheel(v, (float)e->wheel.y);
        break;
    default: break;
    }
}

void window_poll(window *w, viewer *v)
{
    SDL_Event event;
    const double now = demo_seconds();
    if (w->polled > 0.0 && now - w->polled > w->slowest)
        w->slowest = now - w->polled;
    while (!v->closed && SDL_PollEvent(&event))
        handle(w, v, &event);
    if (v->redraw)
        w->due = 0.0;
    w->polled = demo_seconds();
}

void window_wait(window *w, int milliseconds)
{
    /* not SDL_WaitEventTimeout: in SDL 2.26 it may call upon a window that is gone, and then
     * X ends the program */
    for (int i = 0; i < milliseconds && !SDL_PollEvent(NULL); i += 4)
        SDL_Delay(4);
    w->polled = 0.0;
}

void window_rest(window *w, viewer *v)
{
    if (w->due == 0.0)
        window_draw(w, v);
    w->due = 1.0; /* long ago, but not asked for */
    window_wait(w, 100);
}

double window_slowest(const window *w)
{
    return w->slowest;
}

void window_was_away(window *w)
{
    w->polled = 0.0;
}

/* -------------------------------------------------------------------------------------
 * From its opening to its end
 * ------------------------------------------------------------------------------------- */

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

/* Small pictures are enlarged, large ones fitted to the desk. */
static void create(window *w, const char *title, int width, int height)
{
    SDL_Rect desk = {0, 0, width, height};
    SDL_GetDisplayUsableBounds(0, &desk);
    double zoom = 1.0;
    while (width * zoom < 160.0 && height * zoom < 160.0)
        zoom *= 2.0;
    SDL_SetHint(SDL_HINT_RENDER_SCALE_QUALITY, zoom > 1.0 ? "nearest" : "linear");
    if (width * zoom > 0.9 * desk.w)
        zoom = 0.9 * desk.w / width;
    if (height * zoom > 0.9 * desk.h)
        zoom = 0.9 * desk.h / height;
    w->window =
        SDL_CreateWindow(title, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED,
                         1 + (int)(width * zoom - 0.5), 1 + (int)(height * zoom - 0.5),
                         SDL_WINDOW_RESIZABLE | SDL_WINDOW_ALLOW_HIGHDPI);
    if (w->window)
        SDL_SetWindowMinimumSize(w->window, 160, 120);
    if (w->window)
        w->renderer = SDL_CreateRenderer(w->window, -1, 0);
    if (w->renderer)
        w->texture = SDL_CreateTexture(w->renderer, SDL_PIXELFORMAT_RGB24,
                                       SDL_TEXTUREACCESS_STREAMING, width, height);
}

window *window_open(const viewer *v, const char **why)
{
    static window the_window;
    window *w = &the_window;
    const int width = v->view.width, height = v->view.height;
    memset(w, 0, sizeof *w);
    *why = "no display";
    if (have_display()) {
        create(w, v->d->title, width, height);
        *why = SDL_GetError();
        w->bytes = malloc((size_t)width * (size_t)height * 3);
    }
    if (w->texture && w->bytes)
        return w;
    static char said[200]; /* SDL forgets it when it ends */
    snprintf(said, sizeof said, "%s", *why);
    *why = said;
    window_close(w);
    return NULL;
}

void window_close(window *w)
{
    SDL_DestroyTexture(w->texture);
    SDL_DestroyRenderer(w->renderer);
    SDL_DestroyWindow(w->window);
    free(w->bytes);
    SDL_Quit();
}

/* The window of the demos: see window.h. It draws what viewer.h says and hands on keys and mouse.
 * Text needs SDL2_ttf and a font. Without them the window works, and the terminal says what is to
 * be said. */
#include "window.h"
#include "platform.h"

#include <stdlib.h>
#include <string.h>

#define SDL_MAIN_HANDLED
#include <SDL.h>

#ifdef HAVE_TTF
#include <SDL_ttf.h>
#endif

/* All of these keys are on every keyboard. */
static const struct {
    const char *keys, *what;
} window_help[] = {
    {"drag", "move a thing; elsewhere, go round the room"},
    {"Shift + drag", "move it over the floor, not up"},
    {"right drag", "move the camera sideways"},
    {"wheel, PgUp, PgDn", "nearer, farther"},
    {"wheel on a thing", "its size, its gloss, or its refractive index"},
    {"arrows", "go round; left, right: other samples of a pixel"},
    {"1 ... 7", "the same view in chapter 1 ... 7"},
    {"8  9  0", "glass, lamps, gloss"},
    {",  .", "previous picture, next picture"},
    {"click", "show the path of a pixel; i: hide it"},
    {"v", "the plan from above, or from the side"},
    {"z", "a magnifying glass, with numbers"},
    {"b, held down", "compare with another picture; o: choose which"},
    {"+  -", "twice as many samples, half as many"},
    {"m  n", "one bounce more, one fewer"},
    {"d", "without noise, from chapter 7 on"},
    {"g  e  w", "gamma on, off; brighter, darker"},
    {"l  p  t", "other numbers; packets of rays; threads"},
    {"r", "start again with the first view"},
    {"s", "save the picture, print the camera as C code"},
    {"h     q, Esc", "hide these lines     quit"},
};

enum { HELP_LINES = sizeof window_help / sizeof window_help[0] };

struct window {
    SDL_Window *window;
    SDL_Renderer *renderer;
    SDL_Texture *texture;
    SDL_Rect area;        /* of the picture, in pixels of the screen */
    SDL_Rect plan, table; /* beside it and below it, while a path is shown */
    float density;        /* such pixels for one of the mouse's */
    int letter;           /* the size of text, in pixels of the screen */
    bool text;            /* is there a font? */
    unsigned char *bytes; /* of the picture, 3 for each pixel */
    bool wide;            /* with room for the plan; before that it was */
    int width, height;    /* so large */
    bool said_help;       /* in the terminal */
    bool repeated;        /* the key that is held, once more */
    int digit;            /* by the place of the key that went down last, or 0 */
    int held;             /* modifier keys, as of the event: SDL knows of later ones */
    short keys[SDL_NUM_SCANCODES]; /* what the keys that are down meant then */
    double due;                    /* when it may be drawn again */
    double polled, slowest;
};

double demo_seconds(void)
{
    return (double)SDL_GetPerformanceCounter() / (double)SDL_GetPerformanceFrequency();
}

/* -------------------------------------------------------------------------------------
 * Drawing
 * ------------------------------------------------------------------------------------- */

/* ---- text, in one font of any size -------------------------------------------------- */

enum { DARK = 40, LIGHT = 240, SMALLEST = 8 }; /* greys; the smallest letters */

#ifdef HAVE_TTF

static TTF_Font *font; /* NULL: none */

/* False: there is none, and why. */
static bool open_font(const char **why)
{
    char path[1000];
    char *folder = strchr(FONT, '/') ? NULL : SDL_GetBasePath(); /* beside the program */
    snprintf(path, sizeof path, "%s%s", folder ? folder : "", FONT);
    SDL_free(folder);
    if (TTF_Init() == 0)
        font = TTF_OpenFont(path, SMALLEST);
    *why = font ? NULL : TTF_GetError();
    return font != NULL;
}

static void close_font(void)
{
    if (font)
        TTF_CloseFont(font);
    font = NULL;
    if (TTF_WasInit())
        TTF_Quit();
}

/* The size of letters from now on. (SDL2_ttf empties its cache even if the size is the same.) */
static void set_letter(int letter)
{
    static int now;
    if (letter != now)
        TTF_SetFontSize(font, letter);
    now = letter;
}

static int text_width(int letter, const char *words)
{
    int width = 0;
    if (!font)
        return 0;
    set_letter(letter);
    TTF_SizeUTF8(font, words, &width, NULL);
    return width;
}

/* Its left end, and the middle of its height. */
static void draw_text(const window *w, int letter, int x, int y, const char *words,
                      Uint8 grey)
{
    const SDL_Color colour = {grey, grey, grey, 255};
    if (!font || !*words)
        return;
    set_letter(letter);
    SDL_Surface *surface = TTF_RenderUTF8_Blended(font, words, colour);
    if (!surface)
        return;
    SDL_Texture *texture = SDL_CreateTextureFromSurface(w->renderer, surface);
    const SDL_Rect at = {x, y - surface->h / 2, surface->w, surface->h};
    SDL_RenderCopy(w->renderer, texture, NULL, &at);
    SDL_DestroyTexture(texture);
    SDL_FreeSurface(surface);
}

#else

static bool open_font(const char **why)
{
    *why = NULL; /* make has said it */
    return false;
}

static void close_font(void)
{
}

static int text_width(int letter, const char *words)
{
    (void)letter, (void)words;
    return 0;
}

static void draw_text(const window *w, int letter, int x, int y, const char *words,
                      Uint8 grey)
{
    (void)w, (void)letter, (void)x, (void)y, (void)words, (void)grey;
}

#endif

/* From one line to the next. */
static int line_height(int letter)
{
    return (5 * letter + 3) / 4;
}

/* ---- shapes ------------------------------------------------------------------------- */

static const SDL_Color line_colours[] = {/* as demo_kind */
                                         {170, 170, 170, 255}, {33, 113, 181, 255},
                                         {190, 30, 140, 255},  {0, 140, 130, 255},
                                         {90, 160, 60, 255},   {230, 170, 0, 255},
                                         {30, 30, 30, 255},    {230, 110, 40, 255},
                                         {120, 90, 220, 255}};

static void fill(const window *w, SDL_Rect rect, Uint8 grey, Uint8 alpha)
{
    SDL_SetRenderDrawColor(w->renderer, grey, grey, grey, alpha);
    SDL_RenderFillRect(w->renderer, &rect);
}

/* A line whose edges fade out over a pixel. */
static void draw_line(const window *w, const viewer_line *l)
{
    enum { ACROSS = 4 };
    const float dx = l->x1 - l->x0, dy = l->y1 - l->y0, length = sqrtf(dx * dx + dy * dy);
    const float half = 0.5f * l->width;
    const float across[ACROSS] = {-half - 0.5f, -half + 0.5f, half - 0.5f, half + 0.5f};
    SDL_Vertex points[2 * ACROSS];
    int corners[6 * (ACROSS - 1)], count = 0;
    if (!(length > 0.0f))
        return;
    for (int i = 0; i < 2 * ACROSS; i++) {
        const int k = i % ACROSS;
        const bool end = i >= ACROSS;
        points[i].position.x =
            (float)w->plan.x + (end ? l->x1 : l->x0) - across[k] * dy / length;
        points[i].position.y =
            (float)w->plan.y + (end ? l->y1 : l->y0) + across[k] * dx / length;
        points[i].tex_coord = (SDL_FPoint){0.0f, 0.0f};
        points[i].color = line_colours[l->kind];
        points[i].color.a = k == 0 || k == ACROSS - 1 ? 0 : 255;
    }
    for (int k = 0; k < ACROSS - 1; k++) {
        const int four[6] = {k, k + 1, k + ACROSS, k + 1, k + ACROSS, k + ACROSS + 1};
        for (int i = 0; i < 6; i++)
            corners[count++] = four[i];
    }
    SDL_RenderGeometry(w->renderer, NULL, points, 2 * ACROSS, corners, count);
}

/* Draw the square that stands before words of this kind; returns its width. */
static int draw_mark(const window *w, int letter, int x, int y, demo_kind kind)
{
    const SDL_Color c = line_colours[kind];
    const int side = letter * 2 / 3;
    const SDL_Rect box = {x, y - side / 2, side, side};
    SDL_SetRenderDrawColor(w->renderer, c.r, c.g, c.b, 255);
    SDL_RenderFillRect(w->renderer, &box);
    return letter;
}

/* ---- where things are --------------------------------------------------------------- */

/* The picture; and if a path is shown, the plan beside it, and the table below them, as high as
 * 2/7 of the window. */
static void lay_out(window *w, viewer *v)
{
    int width = 1, height = 1, points = 1, ignored;
    SDL_GetRendererOutputSize(w->renderer, &width, &height);
    SDL_GetWindowSize(w->window, &points, &ignored);
    w->density = points > 0 ? (float)width / (float)points : 1.0f;
    w->letter = height / 40 > SMALLEST ? height / 40 : SMALLEST + 1;
    const int left = v->inspect && width > 1 ? width / 2 : width;
    const int top = v->inspect && w->text ? height * 5 / 7 : height;
    const double zoom = fmin((double)left / v->view.width, (double)top / v->view.height);
    w->area.w = (int)fmax(1.0, zoom * v->view.width);
    w->area.h = (int)fmax(1.0, zoom * v->view.height);
    w->area.x = (left - w->area.w) / 2;
    w->area.y = (top - w->area.h) / 2;
    v->slack = 4.0f * (float)v->view.width / (float)w->area.w;
    w->plan = (SDL_Rect){left, 0, width - left, top};
    w->table = (SDL_Rect){0, top, width, height - top};
}

/* The plan needs as much room again, if the screen has it, and the table some more. */
static void widen(window *w, const viewer *v)
{
    SDL_Rect desk;
    if (w->wide == v->inspect)
        return;
    w->wide = v->inspect;
    if (!v->inspect) {
        SDL_SetWindowSize(w->window, w->width, w->height);
    } else if (SDL_GetDisplayUsableBounds(0, &desk) == 0) {
        SDL_GetWindowSize(w->window, &w->width, &w->height);
        const int width = 2 * w->width;
        const int height = w->text ? (7 * w->height + 4) / 5 : w->height;
        SDL_SetWindowSize(w->window, width < desk.w ? width : desk.w,
                          height < desk.h ? height : desk.h);
        SDL_SetWindowPosition(w->window, SDL_WINDOWPOS_CENTERED, SDL_WINDOWPOS_CENTERED);
    }
}

/* ---- the path of a pixel ------------------------------------------------------------ */

/* Draw the names of the lines, in as many rows as they need; returns the height of these. */
static int draw_legend(const window *w, const viewer *v)
{
    const int letter = w->letter, height = line_height(letter);
    const int kinds = v->stage > VIEWER_INDIRECT ? LINE_KINDS : LINE_GLOSS;
    int x = w->plan.x + letter / 2, y = height;
    for (int kind = LINE_CAMERA; kind < kinds && w->text; kind++) {
        const char *name = viewer_kind_name((demo_kind)kind);
        const int width = text_width(letter, name) + 2 * letter;
        if (x + width > w->plan.x + w->plan.w) {
            x = w->plan.x + letter / 2;
            y += height;
        }
        draw_mark(w, letter, x, y, (demo_kind)kind);
        draw_text(w, letter, x + letter, y, name, DARK);
        x += width;
    }
    return y + height / 2;
}

static void draw_plan(window *w, const viewer *v, demo_text *table)
{
    static viewer_plan plan;
    fill(w, w->plan, 250, 255);
    const int legend = draw_legend(w, v);
    w->plan.y += legend;
    w->plan.h -= legend;
    plan.width = (float)w->plan.w;
    plan.height = (float)w->plan.h;
    plan.letter = (float)w->letter;
    viewer_draw_plan(v, &plan, table);
    for (int i = 0; i < plan.line_count; i++)
        draw_line(w, &plan.lines[i]);
    for (int i = 0; i < plan.label_count; i++) {
        const viewer_label *l = &plan.labels[i];
        const int width = text_width(w->letter, l->name), height = w->letter;
        const int x = w->plan.x + (int)l->x - width / 2, y = w->plan.y + (int)l->y;
        const SDL_Rect behind = {x - 2, y - height / 2, width + 4, height};
        if (w->text)
            fill(w, behind, 250, 190);
        draw_text(w, w->letter, x, y, l->name, DARK);
    }
}

enum { TABLE_ROWS = 128 };

typedef struct table {
    int rows, letter;
    char *cells[TABLE_ROWS][DEMO_COLUMNS]; /* NULL: none */
    int widths[DEMO_COLUMNS];              /* 0: the column is not shown */
} table;

/* Cut off and return what comes before the next `end`. */
static char *next_part(char **text, char end)
{
    char *part = *text, *stop = strchr(part, end);
    *text = stop ? stop + 1 : part + strlen(part);
    if (stop)
        *stop = '\0';
    return part;
}

static void cut_up(table *t, char *text)
{
    for (t->rows = 0; *text && t->rows < TABLE_ROWS; t->rows++) {
        char *row = next_part(&text, '\n');
        for (int k = 0; k < DEMO_COLUMNS; k++)
            t->cells[t->rows][k] = *row ? next_part(&row, '\t') : NULL;
    }
}

static demo_kind cell_kind(const char *cell)
{
    return (demo_kind)(*cell - '0');
}

/* Find the width of each column; returns that of the table. A column that says nothing has 0. */
static int measure(table *t)
{
    int sum = t->letter;
    for (int k = 0; k < DEMO_COLUMNS; k++) {
        int widest = 0, says = 0;
        for (int i = 0; i < t->rows; i++) {
            const char *cell = t->cells[i][k];
            const int mark = cell && cell_kind(cell) != LINE_ROOM ? t->letter : 0;
            const int width = cell ? mark + text_width(t->letter, cell + 1) : 0;
            widest = width > widest ? width : widest;
            says += i > 0 && width > 0;
        }
        t->widths[k] = says ? widest : 0;
        sum += says ? widest + t->letter : 0;
    }
    return sum;
}

/* How many rows of the table fit below the line that says which sample it is. */
static int rows_that_fit(const window *w, const table *t)
{
    const int height = line_height(t->letter);
    return (4 * w->table.h - 5 * height) / (4 * height);
}

/* Make the letters smaller until all columns fit, and, down to 3/4, until all rows do. If the
 * smallest are still too large, drop columns. */
static void arrange(const window *w, table *t)
{
    const int width = w->table.w, least = w->letter * 3 / 4;
    static const int spare[] = {COLUMN_PLACE,      COLUMN_NORMAL,  COLUMN_T,
                                COLUMN_THROUGHPUT, COLUMN_GOES_ON, COLUMN_LAMP};
    t->letter = w->letter;
    while (rows_that_fit(w, t) < t->rows && t->letter > least && t->letter > SMALLEST)
        t->letter--;
    int sum = measure(t);
    while (sum > width && t->letter > SMALLEST) {
        t->letter--;
        sum = measure(t);
    }
    for (size_t i = 0; i < sizeof spare / sizeof spare[0] && sum > width; i++) {
        sum -= t->widths[spare[i]] > 0 ? t->widths[spare[i]] + t->letter : 0;
        t->widths[spare[i]] = 0;
    }
}

/* Numbers are aligned on the right, words on the left. */
static bool is_number(int column)
{
    return column == COLUMN_T || column == COLUMN_NORMAL || column == COLUMN_THROUGHPUT ||
           column == COLUMN_ADDS;
}

static void draw_row(const window *w, const table *t, int row, int y)
{
    int x = w->table.x + t->letter;
    for (int k = 0; k < DEMO_COLUMNS; k++) {
        const char *cell = t->cells[row][k];
        if (t->widths[k] == 0)
            continue;
        if (cell) {
            const bool mark = cell_kind(cell) != LINE_ROOM;
            const int width = text_width(t->letter, cell + 1) + (mark ? t->letter : 0);
            int from = is_number(k) ? x + t->widths[k] - width : x;
            if (mark)
                from += draw_mark(w, t->letter, from, y, cell_kind(cell));
            draw_text(w, t->letter, from, y, cell + 1, row == 0 ? 110 : DARK);
        }
        x += t->widths[k] + t->letter;
    }
}

static void draw_table(const window *w, char *text)
{
    static table t;
    const char *sample = next_part(&text, '\n');
    fill(w, w->table, 250, 255);
    cut_up(&t, text);
    arrange(w, &t);
    const int height = line_height(t.letter), room = rows_that_fit(w, &t);
    const int rows = t.rows <= room ? t.rows : room - 1;
    int y = w->table.y + height * 3 / 4;
    draw_text(w, t.letter, w->table.x + t.letter, y, sample, DARK);
    for (int i = 0; i < rows; i++)
        draw_row(w, &t, i, y += height);
    if (rows < t.rows) {
        char more[80];
        demo_text out = text_in(more, sizeof more);
        text_add(&out, "and %d more: a click prints all of them", t.rows - rows);
        draw_text(w, t.letter, w->table.x + t.letter, y + height, more, 110);
    }
}

/* A cross on the pixel whose path is shown, the plan, and the table. */
static void draw_inspector(window *w, const viewer *v)
{
    static char words[1 << 14];
    demo_text told = text_in(words, sizeof words);
    const float zoom = (float)w->area.w / (float)v->view.width;
    const int x = w->area.x + (int)(zoom * ((float)v->x + 0.5f));
    const int y = w->area.y + (int)(zoom * ((float)v->y + 0.5f));
    fill(w, (SDL_Rect){x - 8, y, 17, 1}, 255, 255);
    fill(w, (SDL_Rect){x, y - 8, 1, 17}, 255, 255);
    draw_plan(w, v, &told);
    if (w->text)
        draw_table(w, words);
}

/* Eleven by eleven pixels about the mouse, magnified, and its numbers below. */
static void draw_glass(const window *w, const viewer *v, const rt_image *shown,
                       const char *numbers)
{
    enum { SIDE = 11 };
    const int size = w->letter > 12 ? w->letter : 12, x0 = w->area.x + 8;
    const int y0 = w->area.y + 8;
    const int cx = (int)(v->mouse_x * (float)shown->width / (float)v->view.width);
    const int cy = (int)(v->mouse_y * (float)shown->height / (float)v->view.height);
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int x = cx + i - SIDE / 2, y = cy + j - SIDE / 2;
            const bool inside = x >= 0 && y >= 0 && x < shown->width && y < shown->height;
            const unsigned char *c = w->bytes + (inside ? 3 * (y * shown->width + x) : 0);
            const SDL_Rect at = {x0 + i * size, y0 + j * size, size, size};
            SDL_SetRenderDrawColor(w->renderer, inside ? c[0] : 0, inside ? c[1] : 0,
                                   inside ? c[2] : 0, 255);
            SDL_RenderFillRect(w->renderer, &at);
        }
    const SDL_Rect middle = {x0 + SIDE / 2 * size, y0 + SIDE / 2 * size, size, size};
    SDL_SetRenderDrawColor(w->renderer, 255, 255, 255, 255);
    SDL_RenderDrawRect(w->renderer, &middle);
    const int width = text_width(w->letter, numbers), height = line_height(w->letter);
    const SDL_Rect behind = {x0, y0 + SIDE * size, width + w->letter, height};
    if (width > 0)
        fill(w, behind, 0, 190);
    draw_text(w, w->letter, x0 + w->letter / 2, behind.y + height / 2, numbers, LIGHT);
}

/* The keys in one column and what they do in another, as large as the window allows. */
static void draw_help(const window *w)
{
    int window_width = 0, window_height = 0, keys = 0, what = 0, letter;
    SDL_GetRendererOutputSize(w->renderer, &window_width, &window_height);
    for (letter = window_height / 25; letter > SMALLEST - 2; letter--) {
        keys = what = 0;
        for (int i = 0; i < HELP_LINES; i++) {
            const int k = text_width(letter, window_help[i].keys);
            const int h = text_width(letter, window_help[i].what);
            keys = k > keys ? k : keys;
            what = h > what ? h : what;
        }
        if (keys + what + 3 * letter <= window_width &&
            HELP_LINES * line_height(letter) + letter <= window_height)
            break;
    }
    const int height = line_height(letter);
    const SDL_Rect box = {0, 0, keys + what + 3 * letter, HELP_LINES * height + letter};
    fill(w, box, 0, 230);
    for (int i = 0; i < HELP_LINES; i++) {
        const int y = letter / 2 + i * height + height / 2;
        draw_text(w, letter, letter, y, window_help[i].keys, LIGHT);
        draw_text(w, letter, 2 * letter + keys, y, window_help[i].what, LIGHT);
    }
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

void window_draw(window *w, viewer *v)
{
    char numbers[120];
    demo_text pixel = text_in(numbers, sizeof numbers);
    const rt_image *shown = viewer_shown(v);
    const SDL_Rect part = {0, 0, shown->width, shown->height};
    v->redraw = false;
    widen(w, v);
    lay_out(w, v);
    viewer_encode(v, v->hold, shown, 3, w->bytes);
    SDL_UpdateTexture(w->texture, &part, w->bytes, 3 * shown->width);
    SDL_SetRenderDrawBlendMode(w->renderer, SDL_BLENDMODE_BLEND);
    SDL_SetRenderDrawColor(w->renderer, 0, 0, 0, 255);
    SDL_RenderClear(w->renderer);
    SDL_RenderCopy(w->renderer, w->texture, &part, &w->area);
    if (v->inspect)
        draw_inspector(w, v);
    if (v->glass) {
        viewer_say_pixel(v, shown, w->bytes, &pixel);
        draw_glass(w, v, shown, numbers);
    }
    if (v->help && w->text)
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

/* The signs and digits that are typed, whatever keys that takes on this keyboard. */
static const char typed_keys[] = "0123456789+-=,.[]";

/* What other keys mean, 0: nothing. A letter is what the key types, wherever it is; where that is
 * no Latin letter, the key counts by its place. */
static int key_of(SDL_Keysym key)
{
    const SDL_Scancode place = key.scancode;
    const bool other = key.sym > 127 && !(key.sym & SDLK_SCANCODE_MASK);
    switch (key.sym) {
    case SDLK_LEFT: return KEY_LEFT;
    case SDLK_RIGHT: return KEY_RIGHT;
    case SDLK_UP: return KEY_UP;
    case SDLK_DOWN: return KEY_DOWN;
    case SDLK_PAGEUP: return KEY_NEARER;
    case SDLK_PAGEDOWN: return KEY_FARTHER;
    case SDLK_ESCAPE: return 27;
    default: break;
    }
    if (key.sym >= 'a' && key.sym <= 'z')
        return (int)key.sym;
    if (other && place >= SDL_SCANCODE_A && place <= SDL_SCANCODE_Z)
        return 'a' + (int)(place - SDL_SCANCODE_A);
    return 0;
}

static void handle_key(window *w, viewer *v, int key)
{
    w->due = 0.0;
    viewer_key(v, key, w->repeated);
    for (int i = 0; i < HELP_LINES && v->help && !w->said_help && !w->text; i++)
        printf("%-18s %s\n", window_help[i].keys, window_help[i].what);
    fflush(stdout);
    w->said_help = v->help;
}

static void handle_key_down(window *w, viewer *v, const SDL_KeyboardEvent *e)
{
    const SDL_Keysym key = e->keysym;
    const bool row = key.scancode >= SDL_SCANCODE_1 && key.scancode <= SDL_SCANCODE_0;
    w->repeated = e->repeat != 0;
    w->digit = 0;
    if (key.mod & (KMOD_CTRL | KMOD_ALT | KMOD_GUI | KMOD_MODE))
        return;
    if (row && !(key.mod & KMOD_SHIFT))
        w->digit = '0' + (int)(key.scancode - SDL_SCANCODE_1 + 1) % 10;
    w->keys[key.scancode] = (short)key_of(key);
    if (w->keys[key.scancode] != 0)
        handle_key(w, v, w->keys[key.scancode]);
}

/* A key that goes up is what it was when it went down: the layout may have changed since. */
static void handle_key_up(window *w, viewer *v, SDL_Scancode place)
{
    viewer_key_up(v, w->keys[place]);
    w->keys[place] = 0;
}

/* The key that types a digit elsewhere counts as that if it types nothing that means something:
 * on a French keyboard digits need Shift. AltGr, which types signs, is Ctrl and Alt on some
 * systems. */
static void handle_text(window *w, viewer *v, const char *text)
{
    const bool alt_gr = (w->held & (KMOD_RALT | KMOD_MODE)) != 0;
    if ((w->held & KMOD_GUI) != 0 ||
        ((w->held & (KMOD_CTRL | KMOD_LALT)) != 0 && !alt_gr))
        return;
    const bool typed = text[0] != '\0' && text[1] == '\0' && strchr(typed_keys, text[0]);
    const int key = typed ? text[0] : w->digit;
    if (key != 0)
        handle_key(w, v, key);
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
    case SDL_KEYDOWN:
        w->held = e->key.keysym.mod;
        handle_key_down(w, v, &e->key);
        break;
    case SDL_KEYUP:
        w->held = e->key.keysym.mod;
        handle_key_up(w, v, e->key.keysym.scancode);
        break;
    case SDL_TEXTINPUT: handle_text(w, v, e->text.text); break;
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
                        (w->held & KMOD_SHIFT) != 0);
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

/* Without a display SDL succeeds all the same, with a driver that shows nothing. */
static bool have_display(void)
{
    if (!platform_may_have_display())
        return false;
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
    if (w->texture && w->bytes) {
        SDL_StartTextInput();
        w->text = open_font(why);
        return w;
    }
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
    close_font();
    SDL_Quit();
}

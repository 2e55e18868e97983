/* Progress on a terminal: see progress.h. */
#include "progress.h"
#include "platform.h"

#include <stdio.h>

/* The mean of the pixels in one of columns x rows parts of the image, as bytes. */
static void preview_colour(const progress *p, int x, int y, int columns, int rows,
                           int rgb[3])
{
    const int width = p->picture->width, height = p->picture->height;
    const int x0 = (int)((long long)x * width / columns);
    const int y0 = (int)((long long)y * height / rows);
    int x1 = (int)((long long)(x + 1) * width / columns);
    int y1 = (int)((long long)(y + 1) * height / rows);
    x1 = x1 > x0 ? x1 : x0 + 1;
    y1 = y1 > y0 ? y1 : y0 + 1;
    rt_vec3 sum = {0, 0, 0};
    for (int j = y0; j < y1; j++)
        for (int i = x0; i < x1; i++)
            sum = rt_add(sum, p->picture->pixels[j * width + i]);
    const float part = 1.0f / (float)((x1 - x0) * (y1 - y0));
    rgb[0] = p->encode(part * sum.x);
    rgb[1] = p->encode(part * sum.y);
    rgb[2] = p->encode(part * sum.z);
}

/* Draw the picture in half blocks: the upper half of a cell has the colour of the text,
 * the lower half that of its background. Each row restores the colours at its end, so
 * there is nothing to restore when the program ends, however it ends. */
void progress_preview(progress *p)
{
    int columns = 80, rows_there = 24;
    platform_terminal_size(&columns, &rows_there);
    columns = columns > 1 ? columns - 1 : 1;
    const int most = rows_there > 3 ? rows_there - 3 : 1;
    int rows =
        (int)((double)columns * p->picture->height / p->picture->width / 2.0 + 0.5);
    if (rows > most) {
        rows = most;
        const double fitting = 2.0 * rows * p->picture->width / p->picture->height;
        columns = fitting < columns ? (int)(fitting + 0.5) : columns;
    }
    rows = rows > 0 ? rows : 1;
    columns = columns > 0 ? columns : 1;
    const bool all = platform_colours() > 256;
    if (p->preview_rows == rows)
        fprintf(stderr, "\r\033[%dA", rows);
    p->preview_rows = rows;
    for (int y = 0; y < rows; y++) {
        fprintf(stderr, "\r\033[K");
        for (int x = 0; x < columns; x++) {
            int c[6];
            preview_colour(p, x, 2 * y, columns, 2 * rows, c);
            preview_colour(p, x, 2 * y + 1, columns, 2 * rows, c + 3);
            if (all)
                fprintf(stderr, "\033[38;2;%d;%d;%d;48;2;%d;%d;%dm\xe2\x96\x80", c[0],
                        c[1], c[2], c[3], c[4], c[5]);
            else /* the nearest of 6 x 6 x 6 */
                fprintf(stderr, "\033[38;5;%d;48;5;%dm\xe2\x96\x80",
                        16 + 36 * ((c[0] + 25) / 51) + 6 * ((c[1] + 25) / 51) +
                            (c[2] + 25) / 51,
                        16 + 36 * ((c[3] + 25) / 51) + 6 * ((c[4] + 25) / 51) +
                            (c[5] + 25) / 51);
        }
        fprintf(stderr, "\033[0m\n");
    }
}

void progress_print(progress *p, double now, double part, int samples)
{
    if (p->quiet)
        return;
    if (p->preview && (now >= p->due || part >= 1.0)) {
        progress_preview(p);
        p->due = 0.0;
    }
    char left[40] = "";
    if (samples > 0)
        snprintf(left, sizeof left, ", %d sample%s", samples, samples == 1 ? "" : "s");
    else if (part > 0.0)
        snprintf(left, sizeof left, ", %.0f s left",
                 (now - p->started) * (1.0 - part) / part);
    if (platform_has_terminal()) {
        if (now < p->due)
            return;
        p->due = now + 0.1;
        char bar[31];
        for (int i = 0; i < 30; i++)
            bar[i] = i < (int)(30.0 * part) ? '#' : '.';
        bar[30] = '\0';
        fprintf(stderr, "\r\033[K[%s] %3.0f %%%s ", bar, 100.0 * part, left);
    } else if (part < 1.0) {
        const int quarters = (int)(4.0 * part);
        const bool another = quarters > p->quarters;
        if (!another && now < fmax(p->started, p->due) + 60.0)
            return;
        fprintf(stderr, "%d %%%s\n", another ? 25 * quarters : (int)(100.0 * part), left);
        p->quarters = quarters;
        p->due = now;
    }
}

void progress_end(const progress *p)
{
    if (!p->quiet && platform_has_terminal())
        fprintf(stderr, "\r\033[K");
}

/* The window around a viewer, by SDL. There is one, or none. */
#ifndef WINDOW_H
#define WINDOW_H

#include "viewer.h"

typedef struct window window;

/* NULL where there is no display; then *why says what is missing. Otherwise it says why there is no
 * text in the window, or is NULL. */
window *window_open(const viewer *v, const char **why);
void window_close(window *w);

/* Hand on what keys and pointer did. Call it every few milliseconds. */
void window_poll(window *w, viewer *v);
/* Nothing is to be done: draw, if that was asked for, and wait a little. */
void window_rest(window *w, viewer *v);
/* Wait for something to happen, so long at most: nobody waits for us. */
void window_wait(window *w, int milliseconds);
void window_draw(window *w, viewer *v);
/* Not again before so many times as long as it took: 20 are 5 % of the time. */
void window_draw_in_time(window *w, viewer *v, double pause);
bool window_is_due(const window *w); /* to be drawn */
/* The longest time between two polls, in seconds; and do not count the present one. */
double window_slowest(const window *w);
void window_was_away(window *w);

#endif

/* How far a picture is, on stderr: a bar on a terminal, else a plain line after every quarter; and
 * the picture itself, if it is wanted. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include "../rt.h"

typedef struct progress {
    bool quiet, preview;
    const rt_image *picture; /* for the preview, with its bytes: */
    unsigned char (*encode)(float value);
    double started; /* in seconds, like the others */
    double due;     /* when the line may be printed again */
    int quarters;   /* how many of the plain lines were printed */
    int preview_rows;
} progress;

/* part: 0 to 1, of what is wanted; so many samples: where it is too early to tell the time that
 * is left, as nobody knows how many there will be. 0: it can be told. */
void progress_print(progress *p, double now, double part, int samples);
void progress_end(const progress *p); /* the bar goes */
void progress_preview(progress *p);
/* How many colours the terminal has: 0 (none, or no terminal), 256, or 2^24. */
int progress_colours(void);

#endif

/* Shows on stderr how far a picture is: a bar on a terminal, elsewhere a plain line after
 * every quarter and every minute; and the picture itself, if wanted. */
#ifndef PROGRESS_H
#define PROGRESS_H

#include "../rt.h"

typedef struct progress {
    bool quiet, preview;
    const rt_image *picture; /* for the preview, and its encoding: */
    unsigned char (*encode)(float value);
    double started; /* in seconds, like the others */
    double due;     /* when the bar may be printed again; when the last plain line was */
    int quarters;   /* how many of the plain lines were printed */
    int preview_rows;
} progress;

/* part, 0 to 1, of the work is done. samples is 0 if that tells the time left; while it
 * is too early to know how many samples there will be, it is how many there are. */
void progress_print(progress *p, double now, double part, int samples);
void progress_end(const progress *p); /* remove the bar */
void progress_preview(progress *p);

#endif

/* pupil.c in a page of the site: the student's routines, to be asked by grade_page.c. The
 * compiler in the page (docs/live/edit-worker.js) makes a WebAssembly module of this file, with
 * -DSUBMISSION='"my_hit_sphere.c"', and of the objects that docs/live/build-edit.sh was given.
 *
 * Each kind of input is asked in a new instance, as natively in a new process. Nothing that it
 * says is believed: it can only answer rightly or wrongly. */
#include SUBMISSION

#include "routines.h"

#include <stdio.h>
#include <stdlib.h>

#define EXPORT(name) __attribute__((export_name(#name))) name

static const routine *asked;
static int inputs;
static float *in, *out;

/* Which routine, and how many inputs? Where to put them; NULL if there is not enough memory. */
float *EXPORT(pupil_inputs)(int number, int count)
{
    asked = &routines[number];
    inputs = count;
    in = calloc((size_t)(count * field_count(asked->in)), sizeof *in);
    out = calloc((size_t)(count * field_count(asked->out)), sizeof *out);
    return in && out ? in : NULL;
}

/* Answer them; where the answers are. */
const float *EXPORT(pupil_answers)(void)
{
    const int ins = field_count(asked->in), outs = field_count(asked->out);
    for (int k = 0; k < inputs; k++)
        asked->call(in + k * ins, out + k * outs);
    fflush(NULL);
    return out;
}

/* pupil.c in a page of the site: the student's routines, to be asked by grade_page.c. The
 * compiler in the page (docs/live/edit-worker.js) makes a WebAssembly module of this file, with
 * -DSUBMISSION='"my_hit_sphere.c"', and of the viewer (demos/viewer.c, page.c), compiled before: so
 * it is the live picture, too.
 * After this file comes, for each routine that the student replaces, and only for these, for
 * the rest would take most of the time,
 *
 *     PUPIL_ANSWERS(rt_hit_sphere, call_hit_sphere)
 *
 * Each kind of input is asked in a new instance, as natively in a new process. Nothing that it
 * says is believed: it can only answer rightly or wrongly. */
#include "show.c" /* the submission, and the room by it */

#include "routines.h"

#include <stdio.h>
#include <stdlib.h>

static float *pupil_in, *pupil_out;

/* Make room for so many numbers; where the inputs are to be put. */
__attribute__((export_name("pupil_inputs"))) float *pupil_inputs(int ins, int outs)
{
    pupil_in = calloc((size_t)ins, sizeof *pupil_in);
    pupil_out = calloc((size_t)outs, sizeof *pupil_out);
    return pupil_in;
}

/* Answer inputs of so many numbers each with so many; where the answers are. */
#define PUPIL_ANSWERS(name, call)                                                        \
    __attribute__((export_name("answer_" #name)))                                        \
    const float *answer_##name(int count, int ins, int outs)                             \
    {                                                                                    \
        for (int k = 0; k < count; k++)                                                  \
            call(pupil_in + k * ins, pupil_out + k * outs);                              \
        fflush(NULL);                                                                    \
        return pupil_out;                                                                \
    }

/* A module has memory at address 0, too: who does not ask whether there was enough memory would
 * write there, where a program crashes. So it crashes here, before (wasm-ld --wrap). */
#define OR_CRASH(name, parameters, values)                                               \
    void *__real_##name parameters;                                                      \
    void *__wrap_##name parameters                                                       \
    {                                                                                    \
        void *const p = __real_##name values;                                            \
        if (!p)                                                                          \
            __builtin_trap();                                                            \
        return p;                                                                        \
    }
OR_CRASH(malloc, (size_t size), (size))
OR_CRASH(calloc, (size_t count, size_t size), (count, size))
OR_CRASH(realloc, (void *old, size_t size), (old, size))

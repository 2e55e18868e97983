/* judge.h in a page of the site, where docs/live/edit-worker.js asks it; compiled to WebAssembly:
 *
 *     clang --target=wasm32-wasi -mexec-model=reactor -O2 -o grade.wasm grade_page.c
 *
 * What it prints are the lines of "make try". For each routine of the student's: page_begin; for
 * each of its kinds of input page_ask, then the inputs go to the student's module (pupil_page.c),
 * its answers come to page_answers or what became of it to page_why, and page_judge; page_end. */
#include "judge.h"

#define EXPORT(name) __attribute__((export_name(#name))) name

static question asked;
static char why[200];
static int all, right, by_doing_nothing;

/* ---- the tables -------------------------------------------------------------------------- */

int EXPORT(page_routines)(void)
{
    return ROUTINES;
}

const char *EXPORT(page_name)(int routine)
{
    return routines[routine].name;
}

int EXPORT(page_chapter)(int routine)
{
    return routines[routine].chapter;
}

int EXPORT(page_kinds)(void)
{
    return KINDS;
}

bool EXPORT(page_is_of)(int kind, int routine)
{
    return strcmp(kinds[kind].routine, routines[routine].name) == 0;
}

/* ---- asking and judging ------------------------------------------------------------------ */

void EXPORT(page_begin)(int routine)
{
    all = right = by_doing_nothing = 0;

    for (int k = 0; k < KINDS; k++)
        all += strcmp(kinds[k].routine, routines[routine].name) == 0;
    printf("%s, chapter %d\n", routines[routine].name, routines[routine].chapter);
}

/* Make the inputs of a kind; how many, 0 if there is not enough memory. */
int EXPORT(page_ask)(int kind, uint32_t seed)
{
    forget(&asked);
    return make_question(&asked, kind, seed) ? asked.count : 0;
}

const float *EXPORT(page_inputs)(void)
{
    return asked.in;
}

float *EXPORT(page_answers)(void)
{
    return asked.out;
}

/* How many numbers are one input, and one answer? */
int EXPORT(page_ins)(void)
{
    return asked.ins;
}

int EXPORT(page_outs)(void)
{
    return asked.outs;
}

/* Where to write why it did not get to its end, and how much fits. */
char *EXPORT(page_why)(void)
{
    return why;
}

int EXPORT(page_why_size)(void)
{
    return sizeof why;
}

/* Are there more kinds to be asked? After one without an end the rest would take as long. */
bool EXPORT(page_judge)(bool ended)
{
    if (ended)
        why[0] = '\0';
    why[sizeof why - 1] = '\0';
    const verdict v = judge(&asked, ended, why, sizeof why, NULL, true);
    right += v == RIGHT;
    by_doing_nothing += v == RIGHT_BY_DOING_NOTHING;
    return v != NO_END;
}

/* The marks of "make grade" for the routine, and in words. */
int EXPORT(page_end)(void)
{
    const int marks = marks_for(right, by_doing_nothing);
    if (marks == all)
        printf("all right: %d of %d kinds of input\n", marks, all);
    else
        printf("%d of %d kinds of input right\n", marks, all);
    if (marks == 0 && by_doing_nothing > 0)
        printf("(%s good also by a routine that does nothing)\n",
               by_doing_nothing == 1 ? "one is" : "some are");
    return marks;
}

int EXPORT(page_all)(void)
{
    return all;
}

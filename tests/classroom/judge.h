/* What decides about a student's answers, and says it: grade.c has it in a program, grade_page.c
 * in a page of the site. Who runs the student's routine, and keeps it from harm, is another
 * matter: sandbox.h there, docs/live/edit-run.js here. */
#ifndef JUDGE_H
#define JUDGE_H

#include "cases.h"

#include <stdlib.h>

/* What became of a kind of input. Where one answer is right for all inputs (every ray misses),
 * a routine that does nothing may know it, and that is no merit by itself. */
typedef enum verdict { WRONG, CRASHED, NO_END, RIGHT, RIGHT_BY_DOING_NOTHING } verdict;

/* All inputs of a kind, and room for the answers. */
typedef struct question {
    const kind *kind;
    const routine *routine;
    int count, ins,
        outs; /* how many inputs, and how many numbers in each and its answer */
    float *in, *out;
} question;

static void forget(question *q)
{
    free(q->in);
    free(q->out);
    q->in = q->out = NULL;
}

/* False if there is not enough memory. */
static bool make_question(question *q, int number, uint32_t seed)
{
    memset(q, 0, sizeof *q);
    q->kind = &kinds[number];
    for (int i = 0; i < ROUTINES; i++)
        if (strcmp(routines[i].name, q->kind->routine) == 0)
            q->routine = &routines[i];
    q->count = q->kind->count ? q->kind->count : CASES;
    q->ins = field_count(q->routine->in);
    q->outs = field_count(q->routine->out);
    q->in = calloc((size_t)(q->count * q->ins), sizeof *q->in);
    q->out = calloc((size_t)(q->count * q->outs), sizeof *q->out);
    if (!q->in || !q->out)
        return forget(q), false;
    uint32_t state = first_state = rt_hash(seed + rt_hash((uint32_t)number));
    for (int k = 0; k < q->count; k++) {
        float in[MAX_IN]; /* a kind for several routines makes what the longest takes */
        q->kind->make(in, k, &state);
        memcpy(q->in + k * q->ins, in, (size_t)q->ins * sizeof *in);
    }
    return true;
}

static void print_fields(const field *fields, const float *v)
{
    for (int i = 0; i < MAX_FIELDS && fields[i].name; i++) {
        printf(i == 0 ? "%s " : ", %s ", fields[i].name);
        for (int k = 0; k < fields[i].size; k++)
            printf("%s%.9g", k > 0 ? " " : "", (double)*v++);
    }
    printf("\n");
}

static bool close_enough(const float *actual, const float *expected, int count)
{
    for (int i = 0; i < count; i++)
        if (!(fabsf(actual[i] - expected[i]) <= 1e-4f * (1.0f + fabsf(expected[i]))))
            return false;
    return true;
}

/* The names of the fields that are wrong. */
static void print_differences(const field *fields, const float *actual,
                              const float *expected)
{
    const char *before = "         wrong: ";
    for (int i = 0; i < MAX_FIELDS && fields[i].name; i++) {
        if (!close_enough(actual, expected, fields[i].size)) {
            printf("%s%s", before, fields[i].name);
            before = ", ";
        }
        actual += fields[i].size;
        expected += fields[i].size;
    }
    printf("\n");
}

/* The k-th input, what was answered, and what would have been right, where there is just one
 * right answer. */
static void print_answer(const question *q, int k)
{
    const float *in = q->in + k * q->ins, *out = q->out + k * q->outs;
    float expected[MAX_OUT];
    q->routine->call(in, expected);
    printf("         input %d of %d: ", k + 1, q->count);
    print_fields(q->routine->in, in);
    printf("         yours: ");
    print_fields(q->routine->out, out);
    if (q->kind->judge && q->kind->judge != judge_encode)
        return;
    printf("         right: ");
    print_fields(q->routine->out, expected);
    if (!q->kind->judge)
        print_differences(q->routine->out, out, expected);
}

/* The first wrong answer, as a judge of cases.h tells it. same says whether one answer is right
 * for all inputs. */
static int find_wrong(const question *q, char *why, size_t size, bool *same)
{
    float expected[MAX_OUT], first[MAX_OUT];
    *same = !q->kind->judge || q->kind->judge == judge_again ||
            q->kind->judge == judge_side || q->kind->judge == judge_length ||
            q->kind->judge == judge_mirror || q->kind->judge == judge_focus;
    if (q->kind->judge)
        return q->kind->judge(q->in, q->out, q->count, why, size);
    for (int k = 0; k < q->count; k++) {
        q->routine->call(q->in + k * q->ins, expected);
        if (k == 0)
            memcpy(first, expected, sizeof first);
        *same = *same && memcmp(first, expected, (size_t)q->outs * sizeof *first) == 0;
        if (!close_enough(q->out + k * q->outs, expected, q->outs))
            return k;
    }
    return q->count;
}

/* Judge the answers, and tell: to the student every kind of input; to a teacher, for whom the
 * lines begin with the name of who it is, only the first wrong one. If the student's routine
 * did not get to its end, why says so in place of answers. */
static verdict judge(const question *q, bool ended, char *why, size_t size,
                     const char *who, bool tell)
{
    bool same = false;
    const int wrong = ended ? find_wrong(q, why, size, &same) : -1;
    const bool good = wrong == q->count;
    if (!who)
        printf("  %s  %s", good ? "good " : "WRONG", q->kind->what);
    else if (!good && tell)
        printf("%s: %s: %s", who, q->routine->name, q->kind->what);
    if (!who || (!good && tell))
        printf("%s%s\n", !good && *why ? ": " : "", good ? "" : why);
    if (!good && wrong >= 0 && (!who || tell))
        print_answer(q, wrong);
    if (good)
        return same ? RIGHT_BY_DOING_NOTHING : RIGHT;
    return ended ? WRONG : strncmp(why, "no end", 6) == 0 ? NO_END : CRASHED;
}

/* How many kinds of input of one routine count as right. */
static int marks_for(int right, int by_doing_nothing)
{
    return right > 0 ? right + by_doing_nothing : 0;
}

#endif

/* Chapter 18: what is around the loop of demo18. Machine 0 runs the demo, as always. The others
 * wait until it tells them of a picture, and then all call the same function; or of parts as files,
 * and then all run the demo. */
#ifndef MACHINES_H
#define MACHINES_H

#include "demo.h"

#ifdef HAVE_MPI
#include "platform.h"

#include <mpi.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>

/* What machine 0 tells the others to do. */
typedef enum order { END, A_PICTURE, THE_PARTS } order;

typedef struct task {
    order order;
    int width, height; /* of a picture */
    bool rest;         /* it has image.rest */
    rt_options options;
} task;

static int machine, machines = 1; /* which one is this, and of how many? */
static MPI_Win counter;           /* the memory on machine 0 that all count in */

/* Progress in a part of the picture as progress in all of it. The parts come one after the other,
 * whoever takes them. */
typedef struct whole {
    const rt_options *options;
    int first, count, all;
} whole;

static bool of_the_whole(void *user, float part)
{
    const whole *w = user;
    int mail; /* let MPI look: the others may be waiting for this machine's counter */
    MPI_Iprobe(MPI_ANY_SOURCE, MPI_ANY_TAG, MPI_COMM_WORLD, &mail, MPI_STATUS_IGNORE);
    const float done = (float)w->first + part * (float)w->count;
    return !w->options->progress ||
           w->options->progress(w->options->user, done / (float)w->all);
}

/* The same options, with that progress. */
static rt_options attentive(whole *w)
{
    rt_options options = *w->options;
    options.progress = of_the_whole;
    options.user = w;
    return options;
}

static int take(int step); /* the demo has it */

/* Send the task from machine 0 to all others. MPI's own wait would keep their cores busy. */
static void share(task *t)
{
    MPI_Request request;
    int shared;
    MPI_Ibcast(t, sizeof *t, MPI_BYTE, 0, MPI_COMM_WORLD, &request);
    while (MPI_Test(&request, &shared, MPI_STATUS_IGNORE), !shared)
        platform_sleep(2);
}

/* On machine 0, which then does it, too: the count begins at 0. (At the end others may still be at
 * work on their last part: for them it stays where it is.) */
static void tell(task t)
{
    const int zero = 0;
    if (t.order != END)
        MPI_Accumulate(&zero, 1, MPI_INT, 0, 0, 1, MPI_INT, MPI_REPLACE, counter);
    MPI_Win_flush(0, counter);
    share(&t);
}

static void tell_of_picture(const rt_options *options, const rt_image *image)
{
    const bool rest = image->rest != NULL;
    tell((task){A_PICTURE, image->width, image->height, rest, *options});
}

/* For --part all/N: the next one. */
static int next_number(bool first)
{
    if (first && machine == 0)
        tell((task){.order = THE_PARTS});
    return take(1) + 1;
}

/* They can help with a whole new picture. */
static bool others_can_help(const rt_options *options, const rt_image *image)
{
    return machine == 0 && machines > 1 && image->count == 0 && image->samples == 0 &&
           image->done == 0 && !image->half && !image->guides && options->error <= 0 &&
           options->seconds <= 0;
}

static volatile sig_atomic_t stopped; /* mpirun passes on Ctrl-C as SIGTERM */

static void stop(int signal)
{
    (void)signal;
    stopped = 1;
}

static bool not_stopped(void *user, float part)
{
    (void)user;
    (void)part;
    return !stopped;
}

static void help_with_picture(rt_status (*render)(const rt_options *, rt_image *), task t)
{
    rt_image image = {.width = t.width, .height = t.height};
    const size_t all = (size_t)t.width * (size_t)t.height;
    image.pixels = calloc(all, sizeof *image.pixels);
    image.rest = t.rest ? calloc(all, sizeof *image.rest) : NULL;
    if (!image.pixels || (t.rest && !image.rest))
        MPI_Abort(MPI_COMM_WORLD, 1); /* all of them */
    t.options.progress = not_stopped;
    render(&t.options, &image);
    free(image.pixels);
    free(image.rest);
}

/* As machine 0 does, but that one speaks for all. */
static int help_with_parts(int argc, char **argv, const demo *d)
{
    static char quiet[] = "--quiet";
    char **words = calloc((size_t)argc + 2, sizeof *words);
    if (!words)
        MPI_Abort(MPI_COMM_WORLD, 1);
    memcpy(words, argv, (size_t)argc * sizeof *words);
    words[argc] = quiet;
    const int result = demo_main(argc + 1, words, d);
    free(words);
    return result;
}

/* On all others: help until there is nothing more to do. */
static int help(int argc, char **argv, const demo *d,
                rt_status (*render)(const rt_options *, rt_image *))
{
    int result = 0;
    task t;
    platform_on_interrupt(stop);
    while (share(&t), t.order != END) {
        if (t.order == A_PICTURE)
            help_with_picture(render, t);
        else
            result = help_with_parts(argc, argv, d);
    }
    return result;
}

static int run_on_all(int argc, char **argv, const demo *d,
                      rt_status (*render)(const rt_options *, rt_image *))
{
    int result, *memory;
#if defined OMPI_MAJOR_VERSION && OMPI_MAJOR_VERSION == 4
    /* What is the default between machines fails there: open-mpi/ompi, issues 9871 and 11466. */
    platform_set_default("OMPI_MCA_osc", "^rdma");
#endif
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &machine);
    MPI_Comm_size(MPI_COMM_WORLD, &machines);
    MPI_Win_allocate(sizeof *memory, sizeof *memory, MPI_INFO_NULL, MPI_COMM_WORLD,
                     &memory, &counter);
    MPI_Win_lock_all(0, counter);
    if (machine == 0) {
        result = demo_main(argc, argv, d);
        take(1 << 30); /* no parts after a failure */
        tell((task){.order = END});
    } else {
        result = help(argc, argv, d, render);
    }
    MPI_Win_unlock_all(counter);
    MPI_Win_free(&counter);
    MPI_Finalize();
    return result;
}
#else
#define next_number NULL
#endif

#endif

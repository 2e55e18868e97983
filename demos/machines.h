/* Chapter 18: what is around the loop of demo18. Machine 0 runs the demo, as always. The others
 * wait until it tells them of a picture, and then all call the same function. */
#ifndef MACHINES_H
#define MACHINES_H

#include "demo.h"

#include <stdlib.h>

#ifdef HAVE_MPI
#include <mpi.h>

typedef struct job {
    int width, height; /* 0, 0: there are no more */
    rt_options options;
} job;

static int machine, machines = 1; /* which one is this, and of how many? */

/* Progress in a part of the picture as progress in all of it. The parts come one after the other,
 * whoever takes them. */
typedef struct whole {
    const rt_options *options;
    int first, count, all;
} whole;

static bool of_the_whole(void *user, float part)
{
    const whole *w = user;
    const float done = (float)w->first + part * (float)w->count;
    return !w->options->progress ||
           w->options->progress(w->options->user, done / (float)w->all);
}

/* On machine 0: tell all the others, and join in. They can help with a whole new picture. */
static rt_status call_all(rt_status (*render)(const rt_options *, rt_image *),
                          const rt_options *options, rt_image *image)
{
    job j = {image->width, image->height, *options};
    j.options.progress = NULL;
    MPI_Bcast(&j, sizeof j, MPI_BYTE, 0, MPI_COMM_WORLD);
    return render(options, image);
}

static bool others_can_help(const rt_options *options, const rt_image *image)
{
    return machines > 1 && image->count == 0 && image->samples == 0 && image->done == 0 &&
           !image->half && !image->guides && options->error <= 0 && options->seconds <= 0;
}

/* On all others: help until there are no more pictures. */
static void help(rt_status (*render)(const rt_options *, rt_image *))
{
    job j;
    while (MPI_Bcast(&j, sizeof j, MPI_BYTE, 0, MPI_COMM_WORLD), j.width > 0) {
        rt_image image = {.width = j.width, .height = j.height};
        image.pixels = calloc((size_t)j.width * (size_t)j.height, sizeof *image.pixels);
        if (!image.pixels)
            MPI_Abort(MPI_COMM_WORLD, 1); /* all of them */
        render(&j.options, &image);
        free(image.pixels);
    }
}

static int run_on_all(int argc, char **argv, const demo *d,
                      rt_status (*render)(const rt_options *, rt_image *))
{
    int result = 0;
    MPI_Init(&argc, &argv);
    MPI_Comm_rank(MPI_COMM_WORLD, &machine);
    MPI_Comm_size(MPI_COMM_WORLD, &machines);
    if (machine == 0) {
        job none = {0, 0, {0}};
        result = demo_main(argc, argv, d);
        MPI_Bcast(&none, sizeof none, MPI_BYTE, 0, MPI_COMM_WORLD);
    } else {
        help(render);
    }
    MPI_Finalize();
    return result;
}
#endif

#endif

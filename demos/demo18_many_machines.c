/* Demo 18: many machines.
 *
 * Before  one machine, with all its cores.
 * Now     any number, by messages: each takes the next part of the picture from a counter
 *         that all share, and in the end the picture is their sum.
 * Run     make deps-mpi cluster                    (or ARGS="--samples 256") */
#include "live.h"
#include "machines.h"

#ifdef HAVE_MPI
enum { PART = 1024 }; /* pixels */

/* Add to the counter, which is in the memory of machine 0; what was it before? */
static int take(int step)
{
    int number;
    MPI_Fetch_and_op(&step, &number, MPI_INT, 0, 0, MPI_SUM, counter);
    MPI_Win_flush(0, counter);
    return number;
}

/* What all machines have, put together on machine 0. */
static void bring_home(void *mine, int count, MPI_Datatype type, MPI_Op how)
{
    MPI_Reduce(machine == 0 ? MPI_IN_PLACE : mine, mine, count, type, how, 0,
               MPI_COMM_WORLD);
}

/* All machines call this at the same time. */
static rt_status render_together(const rt_options *options, rt_image *image)
{
    const int all = image->width * image->height, parts = (all - 1) / PART + 1;
    int status = RT_OK, k, step = 1; /* parts at a time */
    while (status == RT_OK && (k = take(step)) < parts) {
        rt_image part = *image; /* its size, and its rays so far */
        const double start = demo_seconds();
        part.first = k * PART;
        part.count = k + step < parts ? step * PART : all - part.first;
        part.pixels += part.first;
        whole w = {options, part.first, part.count, all};
        const rt_options mine = attentive(&w);
        status = rt_render(&scene_indirect, &room_camera, &mine, &part);
        image->rays = part.rays;
        if (demo_seconds() - start < 0.1)
            step *= 2; /* to ask takes time, too */
    }
    if (status != RT_OK)
        take(parts); /* the others may stop, too */
    /* A number is 0 except on the machine that has computed it, so the sums are exact. */
    bring_home(image->pixels, 3 * all, MPI_FLOAT, MPI_SUM);
    bring_home(&image->rays, 1, MPI_UINT64_T, MPI_SUM);
    bring_home(&status, 1, MPI_INT, MPI_MAX); /* RT_OK is the least */
    image->samples = status == RT_OK ? options->samples : 0;
    return (rt_status)status;
}
#endif

static rt_status render(const rt_options *options, rt_image *image)
{
#ifdef HAVE_MPI
    if (others_can_help(options, image)) {
        tell_of_picture(options, image);
        return render_together(options, image);
    }
    whole w = {options, 0, 1, 1};
    const rt_options mine = attentive(&w);
    options = &mine;
#endif
    return rt_render(&scene_indirect, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    const demo d = {.name = "demo18",
                    .title = "18. Many machines",
                    .render = render,
                    .next_part = next_number,
                    .live = &live_room,
                    .stage = 7,
                    .encode = demo_gamma,
                    .samples = 64,
                    .bounces = 5,
                    .sobol = true};
#ifdef HAVE_MPI
    return run_on_all(argc, argv, &d, render_together);
#else
    fprintf(stderr, "demo18: made without MPI: alone (make deps-mpi, make cluster)\n");
    return demo_main(argc, argv, &d);
#endif
}

/* Demo 08: faster.
 *
 * Before  rt.h's loop ran on all cores; in the report OpenMP "did not work".
 * Now     why it did not, measured; then the room, 4 to 16 rays at a time.
 * Run     make demo08                          (or ARGS="--threads 1 --lanes 1") */
#include "live.h"
#include "loops.h"

/* Wrong: the threads start and stop for each pixel. */
static void inner_loop(void)
{
    for (int i = 0; i < COUNT; i++)
#pragma omp parallel for num_threads(workers)
        for (int k = 0; k < SAMPLES; k++)
            value[i][k] = trace(i, k);
}

/* Wrong: all threads want their numbers from the same place. */
static void one_generator(void)
{
#pragma omp parallel for num_threads(workers)
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < SAMPLES; k++)
            value[i][k] = trace_by_rand(i);
}

/* Wrong: all threads share a variable from outside. (Without "atomic" C would promise
 * nothing.) */
static volatile int pixel; /* volatile: read it each time */
static void one_variable(void)
{
    int mine;
#pragma omp parallel for num_threads(workers) private(mine)
    for (int i = 0; i < COUNT; i++) {
#pragma omp atomic write
        pixel = i;
        for (int k = 0; k < SAMPLES; k++) {
#pragma omp atomic read
            mine = pixel; /* is it? */
            value[i][k] = trace(mine, k);
        }
    }
}

/* Right: the outer loop, and for each thread its own numbers and variables. */
static void right_loop(void)
{
#pragma omp parallel for num_threads(workers) schedule(dynamic, 32)
    for (int i = 0; i < COUNT; i++)
        for (int k = 0; k < SAMPLES; k++)
            value[i][k] = trace(i, k);
}

static void measure(int threads)
{
    const loop loops[] = {{"pragma on the inner loop", inner_loop},
                          {"one generator for all threads", one_generator},
                          {"one variable for all threads", one_variable},
                          {"right", right_loop}};
    print_table(loops, 4, threads);
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_indirect, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo08",
                             .title = "8. Faster",
                             .render = render,
                             .measure = measure,
                             .live = &live_room,
                             .stage = 7,
                             .encode = demo_gamma,
                             .samples = 64,
                             .bounces = 5,
                             .sobol = true});
}

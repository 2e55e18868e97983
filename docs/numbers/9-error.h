/* The error of pictures with so many samples, over some seeds. */
#include "9-room.h"

/* Root of the mean square over some seeds: of the true error, and of the estimated one. */
static double error_of(int samples, rt_sampler sampler, bool halves, double *estimate)
{
    double true_squares = 0, squares = 0;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        const rt_image image =
            render(picture, halves ? half : NULL, samples, seed, sampler);
        true_squares += pow(distance_from_truth(), 2);
        if (halves)
            squares += pow((double)rt_image_error(&image), 2);
    }
    if (estimate)
        *estimate = sqrt(squares / SEEDS);
    return sqrt(true_squares / SEEDS);
}

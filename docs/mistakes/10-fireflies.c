/* Blots from fireflies
 *
 * Symptom: no grain, but soft stains of colour, and the shadow under the ball is gone
 * Cause:   the guides alone decide which neighbours count, so light that differs by far
 *          more than noise explains is mixed in
 * Cure:    weigh a difference in light by the variance of the two pixels
 * Options: --denoise
 */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdlib.h>

/* Halves so far apart that anything passes for noise. */
static rt_status my_denoise(const rt_image *image, int threads, rt_image *result)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    rt_image mine = *image;
    mine.half = malloc(count * sizeof *mine.half);
    for (size_t i = 0; i < count; i++)
        mine.half[i] = rt_add(image->pixels[i], rt_vec(1e6f, 1e6f, 1e6f));
    const rt_status status = rt_denoise(&mine, threads, result);
    free(mine.half);
    return status;
}

#define rt_denoise my_denoise

/* The sum, and not the light of others
 *
 * Symptom: shadows are washed out at their edges, and so are highlights
 * Cause:   the filter smooths all light. It takes the shadows of the lamp, which have no
 *          noise, for noise
 * Cure:    keep the direct light apart, and add it afterwards
 * Options: --denoise
 */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdlib.h>

static rt_status my_denoise(const rt_image *image, int threads, rt_image *result)
{
    const size_t count = (size_t)image->width * (size_t)image->height;
    rt_image mine = *image;
    mine.guides = malloc(count * sizeof *mine.guides);
    for (size_t i = 0; i < count; i++) {
        mine.guides[i] = image->guides[i];
        mine.guides[i].direct = mine.guides[i].half = rt_vec(0, 0, 0);
    }
    const rt_status status = rt_denoise(&mine, threads, result);
    free(mine.guides);
    return status;
}

#define rt_denoise my_denoise

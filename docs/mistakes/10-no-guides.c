/* Without guides
 *
 * Symptom: no noise anywhere, but the corners, the ball and the cube are blurred: their
 *          light runs over their edges
 * Cause:   the filter gives all neighbours the same weight, whatever they see
 * Cure:    a pixel that sees another surface, by its normal and point, counts little
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
        mine.guides[i].normal = mine.guides[i].point = rt_vec(0, 0, 0);
        mine.guides[i].albedo = rt_vec(1, 1, 1);
    }
    const rt_status status = rt_denoise(&mine, threads, result);
    free(mine.guides);
    return status;
}

#define rt_denoise my_denoise

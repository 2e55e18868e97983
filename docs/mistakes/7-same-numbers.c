/* The same numbers in every pixel
 *
 * Symptom: no grain but ghosts: edges of light that are not there, the same in the whole
 *          picture
 * Cause:   each pixel, or each thread, starts its generator with the same seed
 * Cure:    a seed made from pixel and sample
 * Options:
 */
#define rt_random my_random
#include "rt.h"

static inline float my_random(rt_rng *rng)
{
    const uint32_t bits = rt_hash(rng->sample * 16 + rng->dimension); /* no pixel in it */
    rng->dimension++;
    return ((float)(bits >> 9) + 0.5f) / 8388608.0f;
}

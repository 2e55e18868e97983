/* The weights the wrong way round
 *
 * Symptom: black with sparks, as if no surface aimed: only chance finds the lamp. With
 *          very many samples it would be right
 * Cause:   other^2 / (density^2 + other^2) gives nearly all the weight to the way that is
 *          bad at finding the lamp. The two weights still sum to 1, so the mean is right
 * Cure:    density^2 in the numerator
 * Options:
 */
#define rt_mis my_mis
#include "rt.h"

static inline float my_mis(float density, float other)
{
    const float ratio = density / (other + FLT_MIN);
    return 1 / (1 + ratio * ratio);
}

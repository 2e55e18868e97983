/* The weights the wrong way round
 *
 * Symptom: black with sparks, as if nobody aimed: only chance finds the lamp. With
 *          very many samples it would be right
 * Cause:   other^2 / (density^2 + other^2): who is bad at finding the lamp has all the
 *          say. The two weights are still 1 together, so the mean is right
 * Cure:    density^2 above
 * Options:
 */
#define rt_mis my_mis
#include "rt.h"

static inline float my_mis(float density, float other)
{
    const float ratio = density / (other + FLT_MIN);
    return 1 / (1 + ratio * ratio);
}

/* The lamp counted twice
 *
 * Symptom: twice as bright in the mean: the picture as it should be, with white sparks
 *          all over it. The sparks are the second time
 * Cause:   a surface aims at the lamp, and then the path goes on and meets it as well:
 *          both count in full
 * Cure:    weights that sum to 1, or count only one of the two
 * Options:
 */
#define rt_mis my_mis
#include "rt.h"

static inline float my_mis(float density, float other)
{
    (void)density, (void)other;
    return 1;
}

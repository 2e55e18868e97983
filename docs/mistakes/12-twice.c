/* The lamp counted twice
 *
 * Symptom: twice as bright in the mean: the picture as it should be, with white
 *          sparks all over it, which are the second time
 * Cause:   a surface aims at the lamp, and the path that goes on meets it, too: both
 *          count in full
 * Cure:    weights that are 1 together, or count only one of the two
 * Options:
 */
#define rt_mis my_mis
#include "rt.h"

static inline float my_mis(float density, float other)
{
    (void)density, (void)other;
    return 1;
}

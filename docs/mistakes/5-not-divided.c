/* Not divided by n
 *
 * Symptom: burnt out, nearly everything white or in pure colours: the sum of 16 samples
 *          in place of their mean
 * Cause:   the division by the number of samples is missing
 * Cure:    sum / n
 * Options:
 */
#define rt_encode my_encode
#include "rt.h"

static inline unsigned char my_encode(float value, double gamma)
{
    value *= 16; /* what the sum would be */
    return (unsigned char)(255 * pow(value > 0 ? (value < 1 ? value : 1) : 0, 1 / gamma) +
                           0.5);
}

/* No clamp
 *
 * Symptom: rings of odd colours where it is bright
 * Cause:   values above 1 give numbers above 255, of which a byte keeps the last
 *          eight bits
 * Cure:    clamp to 0 ... 1 first
 * Options:
 */
#define rt_encode my_encode
#include "rt.h"

static inline unsigned char my_encode(float value, double gamma)
{
    return (unsigned char)((int)(255 * pow((double)value, 1 / gamma) + 0.5) & 255);
}

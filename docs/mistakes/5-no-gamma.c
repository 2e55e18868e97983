/* No gamma
 *
 * Symptom: dark, with hard shadows; then the lamp is made brighter, and the ball
 *          burns out
 * Cause:   the bytes are in proportion to the light, but the screen raises them to the
 *          power of 2.2
 * Cure:    the power 1/2.2 before the byte
 * Options:
 */
#define rt_encode my_encode
#include "rt.h"

static inline unsigned char my_encode(float value, double gamma)
{
    (void)gamma;
    return (unsigned char)(255 * (value > 0 ? (value < 1 ? value : 1) : 0) + 0.5f);
}

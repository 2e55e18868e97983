/* A private copy, in a file that uses next to nothing of it, beside the names that other
 * headers are known to define as macros. */
#define min(a, b) ((a) < (b) ? (a) : (b))
#define max(a, b) ((a) > (b) ? (a) : (b))
#define near
#define far
#define small char
#define PI 3.14
#define I _Complex_I
#define RT_STATIC
#define RT_IMPLEMENTATION
#include "../../rt.h"

int main(void)
{
    return rt_status_text(RT_OK) == 0;
}

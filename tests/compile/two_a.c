/* Two files, one of them with the implementation: linked with two_b.c, at -O0, too. */
#define RT_IMPLEMENTATION
#include "../../rt.h"

float length_in_b(rt_vec3 v);

int main(void)
{
    const rt_vec3 v = rt_vec(3.0f, 4.0f, 0.0f);
    return !(length_in_b(v) == rt_length(v));
}

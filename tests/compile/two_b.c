/* The other file: declarations and chapters only. */
#include "../../rt.h"

float length_in_b(rt_vec3 v);

float length_in_b(rt_vec3 v)
{
    return rt_status_text(RT_OK) ? rt_length(v) : 0.0f;
}

/* A demo with a mistake: some of its pixels are NaN. For tests/29_parts.c. */
#include "../demos/demo.h"

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    (void)view, (void)y, (void)rng;
    const float root = sqrtf(x - 3.0f); /* the first three columns */
    return (rt_vec3){root, 1, 1};
}

int main(int argc, char **argv)
{
    return demo_main(
        argc, argv,
        &(demo){.name = "broken", .pixel = pixel, .encode = demo_linear, .samples = 1});
}

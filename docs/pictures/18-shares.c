/* Chapter 18: which of eight machines renders which part, in its colour: with a fixed share for
 * each, and with a counter.
 * Options: 640 240 --samples 64 --threads 1 */
#define RT_STATIC
#include "../numbers/18-shares.h"
#include "../../demos/demo.h"

static const rt_vec3 colours[MACHINES] = {
    {1.0f, 0.3f, 0.3f}, {0.3f, 1.0f, 0.3f}, {0.4f, 0.4f, 1.0f}, {1.0f, 1.0f, 0.3f},
    {1.0f, 0.3f, 1.0f}, {0.3f, 1.0f, 1.0f}, {1.0f, 0.6f, 0.3f}, {0.6f, 0.6f, 0.6f}};

static rt_status render(const rt_options *options, rt_image *image)
{
    static shares s;
    const rt_status status = render_parts(options, &s);
    for (int i = 0; i < ROWS * COLUMNS; i++) {
        rt_vec3 *to = image->pixels + 2 * COLUMNS * (i / COLUMNS) + i % COLUMNS;
        to[0] = rt_mul(s.pixels[i], colours[s.fixed[i / SIZE]]);
        to[COLUMNS] = rt_mul(s.pixels[i], colours[s.counted[i / SIZE]]);
    }
    image->samples = options->samples;
    return status;
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "shares",
                             .title = "Who renders which part",
                             .render = render,
                             .encode = demo_gamma,
                             .samples = 64,
                             .bounces = 5});
}

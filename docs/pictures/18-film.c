/* Chapter 18: six frames of the film of 60.
 * Options: 720 360 --threads 1 */
#define RT_STATIC
#define main film
#include "../machines/frame.c"
#undef main
#include "../../demos/demo.h"

static rt_status render(const rt_options *options, rt_image *image)
{
    rt_status status = RT_OK;
    for (int i = 0; i < 6 && status == RT_OK; i++) {
        const int wide = image->width / 3, high = image->height / 2;
        const rt_camera camera = camera_at(6.2831853f * (float)(10 * i + 10) / 60);
        rt_image frame = {.width = wide, .height = high, .pixels = pixels};
        rt_options its_own = *options;
        its_own.seed = (uint32_t)(10 * i + 10);
        status = rt_render(&scene, &camera, &its_own, &frame);
        for (int y = 0; y < high; y++)
            memcpy(image->pixels + image->width * (i / 3 * high + y) + i % 3 * wide,
                   pixels + y * wide, (size_t)wide * sizeof *pixels);
    }
    image->samples = options->samples;
    return status;
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "film",
                             .title = "A film",
                             .render = render,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 5});
}

/* The room by the student's routines, to look at: cc -DRT_STATIC -DSUBMISSION='"file.c"' show.c
 * demo.o; static, since demo.o has another rt_render, with rt.h's routines. */
#include SUBMISSION

#define RT_IMPLEMENTATION
#include "../../demos/live.h"

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_indirect, &room_camera, options, image);
}

static rt_status finish(const rt_image *image, int threads, rt_image *result)
{
    return rt_denoise(image, threads, result);
}

static unsigned char encode(float value)
{
    return rt_encode(value, 2.2);
}

/* What the window compares with: rt.h's own. */
static rt_status right(int stage, const demo_view *view, const rt_options *options,
                       rt_image *image)
{
    if (stage < 7)
        return live_render(stage, view, options, image);
    return demo_rt_render(&scene_indirect, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    demo_live live = live_room;
    live.render = right;
    return demo_main(argc, argv,
                     &(demo){.name = "try",
                             .title = "Your own routine",
                             .render = render,
                             .live = &live,
                             .finish = finish,
                             .explain = explain_indirect,
                             .encode = encode,
                             .samples = 16,
                             .bounces = 5});
}

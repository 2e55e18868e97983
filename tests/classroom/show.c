/* The room by the student's routines, to look at: cc -DRT_STATIC -DSUBMISSION='"file.c"' show.c
 * demo.o; static, since demo.o has another rt_render, with rt.h's routines. */
#include SUBMISSION

#define RT_IMPLEMENTATION
#include "../../demos/demo.h"
#include "../../demos/scene.h"

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_indirect, &room_camera, options, image);
}

static unsigned char encode(float value)
{
    return rt_encode(value, 2.2);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "try",
                             .title = "Your own routine",
                             .render = render,
                             .encode = encode,
                             .samples = 16,
                             .bounces = 5});
}

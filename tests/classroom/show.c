/* The room by the student's routines, to look at: cc -DSUBMISSION='"file.c"' show.c program.a. */
#include SUBMISSION

#include "../../demos/live.h"

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    return rt_radiance(&scene_indirect, &ray, view->bounces, rng);
}

static rt_status finish(const rt_image *image, int threads, rt_image *result)
{
    return rt_denoise(image, threads, result);
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
                             .pixel = pixel,
                             .live = &live_room,
                             .finish = finish,
                             .explain = explain_indirect,
                             .encode = encode,
                             .samples = 16,
                             .bounces = 5});
}

/* The room by the student's routines, to look at: cc -DSUBMISSION='"file.c"' show.c program.a. */
#include SUBMISSION

#include "../../demos/live.h"

/* The picture in which the routine can be seen. */
#ifndef STAGE
#if defined(rt_fresnel) || defined(rt_refract)
#define STAGE STAGE_GLASS
#elif defined(rt_sample_lamp) || defined(rt_lamp_density) || defined(rt_mis)
#define STAGE STAGE_LAMPS
#elif defined(rt_sample_gloss) || defined(rt_gloss)
#define STAGE STAGE_GLOSS
#elif defined(rt_lens_ray)
#define STAGE STAGE_SKY
#elif defined(rt_hit_triangle)
#define STAGE STAGE_TRIANGLES
#else
#define STAGE STAGE_INDIRECT
#endif
#endif

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const live_context stage = live_stage(STAGE, view);
    return live_pixel(&stage, x, y, rng);
}

static rt_status finish(const rt_image *image, int threads, rt_image *result)
{
    return rt_denoise(image, threads, result);
}

static unsigned char encode(float value)
{
    return live_encode(STAGE, value);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "try",
                             .title = "Your own routine",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = STAGE,
                             .finish = finish,
                             .encode = encode,
                             .samples = 16,
                             .bounces = STAGE == STAGE_INDIRECT ? 5 : 8});
}

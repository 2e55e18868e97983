/* Demo 05: gamma.
 *
 * Before  the light is right, but the picture is too dark: a screen does not show byte 128
 *         half as bright as byte 255, but about a fifth.
 * Now     the same light, encoded for the screen: clamp to 0..1, power 1/2.2, round. The
 *         numbers in the image do not change, only the bytes that show them: with
 *         --out light.pfm this demo and demo04 write the same light.
 * Run     make demo05 */
#include "live.h"

/* In this order: NaN is not greater than 0, so it becomes 0; nothing negative reaches pow;
 * nothing above 1 reaches the byte; and + 0.5 rounds instead of cutting off. */
static unsigned char encode(float value)
{
    float clamped = value > 0.0f ? value : 0.0f;
    if (clamped > 1.0f)
        clamped = 1.0f;
    return (unsigned char)(255.0 * pow((double)clamped, 1.0 / 2.2) + 0.5);
}

static rt_vec3 pixel(const demo_view *view, float x, float y, rt_rng *rng)
{
    const rt_ray ray = rt_camera_ray(&room_camera, view->width, view->height, x, y);
    rt_hit hit;
    rng->rays++;
    if (!rt_intersect(&scene_cube, &ray, &hit))
        return rt_vec(0, 0, 0);
    return rt_direct(&scene_cube, &hit, rng);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo05",
                             .title = "5. Gamma",
                             .pixel = pixel,
                             .live = &live_room,
                             .stage = 5,
                             .encode = encode,
                             .samples = 16});
}

/* Demo 15: patterns.
 *
 * Before  a surface has one colour.
 * Now     its colour is a function of the point: tiles on the floor, a cube of marble, and on
 *         the ball a picture of your own, if you give one. The other functions are in
 *         patterns.h.
 * Run     make demo15                              (or ARGS="--texture docs/images/demo09.png") */
#include "live.h"

/* Tiles on the floor, as large as room_tiles says, in two alternating colours. floorf
 * rounds down on both sides of 0, which (int) alone does not. */
static rt_vec3 tile(const void *data, rt_vec3 P, rt_vec3 N)
{
    const pattern_checks *checks = data;
    const int column = (int)floorf(P.x / checks->size);
    const int row = (int)floorf(P.z / checks->size);
    (void)N;
    return (column + row) % 2 == 0 ? checks->even : checks->odd;
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_patterns, &room_camera, options, image);
}

static void wrap(const rt_vec3 *pixels, int width, int height)
{
    room_picture.pixels = pixels;
    room_picture.width = width;
    room_picture.height = height;
}

int main(int argc, char **argv)
{
    pattern_surfaces[ROOM_FLOOR].pattern = tile;
    return demo_main(argc, argv,
                     &(demo){.name = "demo15",
                             .title = "15. Patterns",
                             .render = render,
                             .texture = wrap,
                             .live = &live_room,
                             .stage = 12,
                             .encode = demo_gamma,
                             .samples = 64,
                             .bounces = 8,
                             .sobol = true,
                             .denoise = true});
}

/* Demo 10: a clean picture from few rays.
 *
 * Before  64 samples per pixel, and each pixel on its own.
 * Now     16 samples, and neighbours that help each other: a filter that knows, from the
 *         camera rays, which pixels see the same surface.
 * Run     make demo10                                     (or ARGS="--samples 4") */
#include "clean.h"
#include "live.h"

/* How unlike two pixels are by what they see: 0 in one plane, 1 if better not asked. */
static float unlike(const clean_pixel *a, const clean_pixel *b)
{
    const rt_vec3 turned = rt_sub(a->normal, b->normal), way = rt_sub(b->point, a->point);
    const float off_a = rt_dot(a->normal, way), off_b = rt_dot(b->normal, way);
    return 20 * rt_dot(turned, turned) +
           50 * (off_a * off_a + off_b * off_b) / (rt_dot(way, way) + FLT_MIN);
}

/* How much b has to say to a: about e^-x, where x is how unlike they are, plus d^2 /
 * noise. d is the difference of their light, and noise is six deviations of it,
 * squared. */
static float say(const clean_pixel *a, const clean_pixel *b)
{
    const float d = mean_of(a->light) - mean_of(b->light);
    const float noise = 36 * (a->variance + b->variance) + FLT_MIN;
    const float root = noise / (noise * (1 + unlike(a, b) / 4) + d * d / 4);
    return root * root * root * root;
}

/* The mean over 5 x 5 pixels, step apart, each weighted by what it has to say. */
static clean_pixel smooth(const clean_picture *p, int x, int y, int step)
{
    static const float spline[5] = {0.0625f, 0.25f, 0.375f, 0.25f, 0.0625f};
    const clean_pixel *here = pixel_at(p, x, y);
    clean_pixel result = *here;
    rt_vec3 light = {0, 0, 0};
    float variance = 0, weights = 0;
    for (int dy = -2; dy <= 2; dy++)
        for (int dx = -2; dx <= 2; dx++) {
            const int X = x + dx * step, Y = y + dy * step;
            if (!is_inside(p, X, Y) || !pixel_at(p, X, Y)->known)
                continue;
            const clean_pixel *there = pixel_at(p, X, Y);
            const float weight = spline[dx + 2] * spline[dy + 2] * say(here, there);
            light = rt_add(light, rt_scale(there->light, weight));
            variance += weight * weight * there->variance;
            weights += weight;
        }
    const float w = 1 / (weights + FLT_MIN);
    result.light = rt_scale(light, w);
    result.variance = variance * w * w;
    return result;
}

static rt_status finish(const rt_image *image, int threads, rt_image *result)
{
    return clean(image, threads, unlike, smooth, result);
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_indirect, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo10",
                             .title = "10. A clean picture from few rays",
                             .render = render,
                             .finish = finish,
                             .live = &live_room,
                             .stage = 7,
                             .encode = demo_gamma,
                             .samples = 16,
                             .bounces = 5,
                             .sobol = true,
                             .denoise = true});
}

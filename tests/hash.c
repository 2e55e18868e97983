/* Prints "demoNN hash" for the demo that DEMO names: 64 x 48 pixels, 4 samples, the FNV-1a hash
 * of the bits of every float and of every byte. It must be the same for every compiler, level
 * of optimisation, C library, processor, number of threads and number of rays at a time:
 * tests/references/hashes.txt. Needs nothing but rt.h, so that it runs where there is no
 * cmocka. For many demos: without DEMO it is all but the demo, and with LINKED only that. */
#ifdef LINKED
#include "../demos/demo.h"
#else
#include <stdio.h>
#include <string.h>

#define RT_IMPLEMENTATION
#include "../demos/demo.h"

enum { W = 64, H = 48 };

static const demo *the_demo;

static rt_vec3 pixel_of_the_demo(const void *view, float x, float y, rt_rng *rng)
{
    return the_demo->pixel(view, x, y, rng);
}

unsigned char demo_linear(float value)
{
    return rt_encode(value, 1.0);
}

unsigned char demo_gamma(float value)
{
    return rt_encode(value, 2.2);
}

double demo_seconds(void)
{
    return 0.0;
}

static uint64_t hash_float(uint64_t hash, float value)
{
    uint32_t bits;
    memcpy(&bits, &value, 4);
    for (int shift = 0; shift < 32; shift += 8)
        hash = (hash ^ (bits >> shift & 255)) * 1099511628211u;
    return (hash ^ the_demo->encode(value)) * 1099511628211u;
}

/* The demo's main calls this. */
int demo_main(int argc, char **argv, const demo *d)
{
    static rt_vec3 pixels[W * H], half[W * H], clean[W * H], by_hand[W * H];
    static rt_guide guides[W * H];
    const demo_view view = {W, H, d->bounces};
    uint64_t first = 0;
    (void)argc;
    (void)argv;
    the_demo = d;
    for (int threads = 1; threads <= 8; threads++) {
        rt_image image = {.width = W, .height = H, .pixels = pixels};
        const rt_options options = {.samples = 4,
                                    .bounces = d->bounces,
                                    .threads = threads,
                                    .sampler = d->sobol ? RT_SOBOL : RT_RANDOM,
                                    .lanes = rt_lane_count(2 * threads)}; /* 1 to 16 */
        image.half = d->estimate || d->finish ? half : NULL;
        image.guides = d->finish ? guides : NULL;
        const rt_status status =
            d->render ? d->render(&options, &image)
                      : rt_render_pixels(pixel_of_the_demo, &view, &options, &image);
        if (status != RT_OK)
            return 1;
        if (d->finish) { /* one pixel and sixteen at a time */
            rt_image result = {.width = W, .height = H, .pixels = clean};
            rt_image plain = {.width = W, .height = H, .pixels = by_hand};
            if (rt_denoise(&image, threads, &result) != RT_OK ||
                d->finish(&image, threads, &plain) != RT_OK ||
                memcmp(clean, by_hand, sizeof clean) != 0)
                return fprintf(stderr, "%s: not as by hand\n", d->name), 1;
            memcpy(pixels, clean, sizeof pixels);
        }
        uint64_t hash = 14695981039346656037u;
        for (int i = 0; i < W * H; i++) {
            hash = hash_float(hash, pixels[i].x);
            hash = hash_float(hash, pixels[i].y);
            hash = hash_float(hash, pixels[i].z);
        }
        if (threads > 1 && hash != first)
            return fprintf(stderr, "%s: %d threads, %d lanes: another hash\n", d->name,
                           threads, options.lanes),
                   1;
        first = hash;
    }
    printf("%s %08lx%08lx\n", d->name, (unsigned long)(first >> 32),
           (unsigned long)(first & 0xffffffffu));
    return 0;
}
#endif

#ifdef DEMO
#define LIVE_H /* nobody looks through a window here: less to compile */
#include "../demos/explain.h"
#include "../demos/scene.h"
static const demo_live live_room;
#include DEMO /* NOLINT(bugprone-suspicious-include) */
#endif

/* Demo 09: less noise.
 *
 * Before  random numbers, which fall in clumps and leave gaps.
 * Now     numbers that fill the square evenly: Sobol's points, scrambled. The same rays
 *         make less noise, and the picture knows how large its error is.
 * Run     make demo09                                       (or ARGS="--error 0.05") */
#include "live.h"
#include "noise.h"

static uint32_t reverse(uint32_t bits)
{
    uint32_t result = 0;
    for (int i = 0; i < 32; i++)
        result |= (bits >> i & 1u) << (31 - i);
    return result;
}

/* Owen's scrambling of reversed bits: the key and the bits below decide whether a bit is
 * flipped. (Additions and multiplications carry upwards only.) */
static uint32_t scramble(uint32_t v, uint32_t key)
{
    v ^= v * 0x3d20adeau;
    v += key;
    v *= (key >> 16) | 1u;
    v ^= v * 0x05526c56u;
    return v ^ v * 0x53a22864u;
}

/* Sobol's second coordinate, reversed: for each bit that is set, a row of Pascal's triangle
 * modulo 2: 1, 11, 101, 1111, 10001 ... */
static uint32_t second(uint32_t index)
{
    uint32_t sum = 0;
    for (uint32_t row = 1; index != 0; index >>= 1, row ^= row << 1)
        if ((index & 1u) != 0)
            sum ^= row;
    return sum;
}

/* The number that rt_random gives for this dimension of a sample; dimensions 0 and 1, 2 and
 * 3, ... are pairs, and each pair takes the samples in another order: its index. */
static float sobol(uint32_t key, uint32_t sample, uint32_t dimension)
{
    const uint32_t pair = rt_hash(key + dimension / 2);
    const uint32_t index = reverse(scramble(reverse(sample), pair));
    const uint32_t number = dimension % 2 == 0
                                ? scramble(index, rt_hash(pair + 1))
                                : scramble(second(index), rt_hash(pair + 2));
    return ((float)(reverse(number) >> 9) + 0.5f) / 8388608.0f;
}

static void measure(int threads)
{
    print_points(sobol);
    print_errors(threads);
}

static rt_status render(const rt_options *options, rt_image *image)
{
    return rt_render(&scene_indirect, &room_camera, options, image);
}

int main(int argc, char **argv)
{
    return demo_main(argc, argv,
                     &(demo){.name = "demo09",
                             .title = "9. Less noise",
                             .render = render,
                             .measure = measure,
                             .live = &live_room,
                             .stage = 7,
                             .encode = demo_gamma,
                             .samples = 64,
                             .bounces = 5,
                             .sobol = true,
                             .estimate = true});
}

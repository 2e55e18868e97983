/* Chapter 9 and the options that go with it: Sobol's numbers, the estimated error, and when to
 * stop. */
#define DEMO "../demos/demo09_less_noise.c"
#include "test.h"

static const rt_options defaults; /* all zero */

/* ---- the numbers -------------------------------------------------------------------- */

static void test_reverse(void **state)
{
    (void)state;
    for (int i = 0; i < 32; i++)
        assert_int_equal(rt__reverse(1u << i), 1u << (31 - i));
    assert_int_equal(rt__reverse(0x00c0ffeeu), 0x77ff0300u);
}

static void test_the_second_coordinate_is_sobols(void **state)
{
    /* By direction numbers, as in the papers: coordinate n is the sum modulo 2 of the
     * numbers for the bits that are set in n, with v = v ^ v / 2 for the second
     * dimension. */
    (void)state;
    for (uint32_t i = 0; i < 300000; i++) {
        const uint32_t n = i < 100000 ? i : rt_hash(i);
        uint32_t expected = 0, direction = 1u << 31;
        for (int bit = 0; bit < 32; bit++) {
            if (n >> bit & 1u)
                expected ^= direction;
            direction ^= direction >> 1;
        }
        assert_int_equal(rt__reverse(rt__second(n)), expected);
    }
    assert_int_equal(rt__reverse(rt__second(1)), 1u << 31); /* 1/2, 3/4, 1/4 */
    assert_int_equal(rt__reverse(rt__second(2)), 3u << 30);
    assert_int_equal(rt__reverse(rt__second(3)), 1u << 30);
}

static void test_scramble_flips_bits_by_those_below_only(void **state)
{
    /* When bit j of v is flipped, so is bit j of the result, and none below. It follows that
     * scrambling is one to one. */
    (void)state;
    for (uint32_t i = 0; i < 20000; i++) {
        const uint32_t v = rt_hash(2 * i), key = rt_hash(2 * i + 1);
        for (int j = 0; j < 32; j++) {
            const uint32_t changed =
                rt__scramble(v, key) ^ rt__scramble(v ^ 1u << j, key);
            assert_int_equal(changed & ((2u << j) - 1u), 1u << j);
        }
    }
}

static void test_scramble_is_one_to_one(void **state)
{
    /* The lower 16 bits make a permutation of their own. */
    (void)state;
    static unsigned char seen[1 << 16];
    for (uint32_t key = 0; key < 20; key++) {
        memset(seen, 0, sizeof seen);
        for (uint32_t v = 0; v < 1u << 16; v++)
            seen[rt__scramble(v, rt_hash(key)) & 0xffffu]++;
        for (int v = 0; v < 1 << 16; v++)
            assert_int_equal(seen[v], 1);
    }
}

static void test_scramble_flips_every_bit_half_of_the_time(void **state)
{
    (void)state;
    enum { N = 20000 };
    int flips[32] = {0};
    for (uint32_t i = 0; i < N; i++) {
        const uint32_t v = rt_hash(2 * i),
                       flipped = v ^ rt__scramble(v, rt_hash(2 * i + 1));
        for (int j = 0; j < 32; j++)
            flips[j] += (int)(flipped >> j & 1u);
    }
    for (int j = 0; j < 32; j++)
        assert_close(flips[j] / (double)N, 0.5, 4 * 0.5 / sqrt(N));
}

/* The numbers 2 pair and 2 pair + 1 of a sample, as rt_random gives them. */
static void numbers(uint32_t pixel, uint32_t sample, uint32_t seed, int pair, float *r)
{
    rt_rng rng = rt_sobol_start(pixel, sample, seed);
    for (int i = 0; i < 2 * pair; i++)
        rt_random(&rng);
    r[0] = rt_random(&rng);
    r[1] = rt_random(&rng);
}

static void test_sobols_numbers_are_between_zero_and_one(void **state)
{
    (void)state;
    float smallest = 1, largest = 0;
    for (uint32_t i = 0; i < 200000; i++) {
        float r[2];
        numbers(i / 64, i % 64, 9, (int)(i % 5), r);
        for (int k = 0; k < 2; k++) {
            assert_true(r[k] > 0 && r[k] < 1);
            assert_true(r[k] * 8388608.0f - 0.5f ==
                        floorf(r[k] * 8388608.0f)); /* exact */
            smallest = r[k] < smallest ? r[k] : smallest;
            largest = r[k] > largest ? r[k] : largest;
        }
    }
    assert_true(smallest < 1e-4f && largest > 0.9999f);
}

static void test_every_part_of_the_square_gets_its_sample(void **state)
{
    /* Of the first 2^k samples, exactly one in each of the 2^k rectangles, for all shapes of
     * rectangles and all k up to 10. */
    (void)state;
    enum { MOST = 10 };
    static float r[1 << MOST][2];
    const uint32_t pixels[] = {0, 1, 2, 639, 640, 307199, 4000000000u};
    for (size_t p = 0; p < COUNT(pixels); p++)
        for (int pair = 0; pair < 12; pair++) {
            for (uint32_t i = 0; i < 1u << MOST; i++)
                numbers(pixels[p], i, (uint32_t)p, pair, r[i]);
            for (int k = 0; k <= MOST; k++)
                for (int across = 0; across <= k; across++) {
                    const int columns = 1 << across, rows = 1 << (k - across);
                    unsigned char seen[1 << MOST] = {0};
                    for (int i = 0; i < 1 << k; i++) {
                        const int x = (int)(r[i][0] * (float)columns);
                        const int y = (int)(r[i][1] * (float)rows);
                        if (seen[y * columns + x]++)
                            fail_msg("pixel %u, pair %d: two of %d in one of %d x %d",
                                     pixels[p], pair, 1 << k, columns, rows);
                    }
                }
        }
}

/* chi-square of pairs of numbers in a grid of 16 x 16. Sixteen samples in turn have one
 * in each row and one in each column: random permutations give a mean of 256 * 15/16 =
 * 240, and a standard deviation of some 60, since Owen's scrambling only swaps halves,
 * and so keeps neighbours together. If the orders were the same, it would be 60 000. */
static double chi_square(const int *bins, int n)
{
    double sum = 0;
    for (int i = 0; i < 256; i++)
        sum += pow(bins[i] - n / 256.0, 2) / (n / 256.0);
    return sum;
}

static int cell(float x, float y)
{
    return (int)(x * 16) * 16 + (int)(y * 16);
}

static void test_pairs_take_the_samples_in_orders_of_their_own(void **state)
{
    /* Within one pixel: the 1st number of one pair with the 1st or 2nd of another. */
    (void)state;
    enum { N = 4096 };
    double worst = 0;
    for (uint32_t pixel = 0; pixel < 3; pixel++)
        for (int a = 0; a < 5; a++)
            for (int b = 0; b < 5; b++) {
                int bins[2][256] = {{0}};
                for (uint32_t i = 0; i < N && a != b; i++) {
                    float r[2], s[2];
                    numbers(pixel, i, 3, a, r);
                    numbers(pixel, i, 3, b, s);
                    bins[0][cell(r[0], s[0])]++;
                    bins[1][cell(r[0], s[1])]++;
                }
                for (int k = 0; k < 2 && a != b; k++) {
                    const double off = fabs(chi_square(bins[k], N) - 240);
                    worst = off > worst ? off : worst;
                }
            }
    print_message("chi-square of two pairs: 240, the worst of 120 is %.0f off\n", worst);
    assert_true(worst < 300);
}

static void test_pixels_and_seeds_have_numbers_of_their_own(void **state)
{
    /* Kinds 0 to 3: the next pixel, the pixel below, the next seed, seed + 2^31 (which is
     * where the second half of the samples comes from). Over the samples of one pixel, and
     * over the pixels of one sample. */
    (void)state;
    enum { N = 4096 };
    for (int kind = 0; kind < 8; kind++) {
        int bins[256] = {0};
        for (uint32_t i = 0; i < N; i++) {
            float r[2], s[2];
            const uint32_t pixel = kind < 4 ? 77 : i, sample = kind < 4 ? i : 5;
            numbers(pixel, sample, 3, 1, r);
            numbers(pixel + (kind % 4 == 0   ? 1
                             : kind % 4 == 1 ? 640
                                             : 0),
                    sample,
                    kind % 4 == 2   ? 4
                    : kind % 4 == 3 ? 3u ^ 1u << 31
                                    : 3,
                    1, s);
            bins[cell(r[0], s[0])]++;
        }
        assert_close(chi_square(bins, N), kind < 4 ? 240 : 255, kind < 4 ? 300 : 100);
    }
}

static void test_sobol_is_the_default(void **state)
{
    (void)state;
    rt_options options = defaults;
    rt_image a = new_image(16, 12), b = new_image(16, 12), c = new_image(16, 12);
    options.samples = 4;
    options.bounces = 2;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &a), RT_OK);
    options.sampler = RT_SOBOL;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &b), RT_OK);
    options.sampler = RT_RANDOM;
    assert_int_equal(rt_render(&scene_indirect, &room_camera, &options, &c), RT_OK);
    assert_true(same_pixels(&a, &b));
    assert_false(same_pixels(&a, &c));
    free(a.pixels);
    free(b.pixels);
    free(c.pixels);
}

static rt_vec3 place_and_number(const void *context, float x, float y, rt_rng *rng)
{
    (void)context;
    return rt_vec(x, y, rt_random(rng));
}

static void test_render_pixels_hands_out_the_same_numbers(void **state)
{
    /* The first pair is the place in the pixel, the next is for the function. */
    (void)state;
    rt_options options = defaults;
    for (int kind = 0; kind < 2; kind++) {
        rt_image image = new_image(5, 3);
        options.samples = 1;
        options.seed = 8;
        options.sampler = kind == 0 ? RT_SOBOL : RT_RANDOM;
        assert_int_equal(rt_render_pixels(place_and_number, NULL, &options, &image),
                         RT_OK);
        for (int i = 0; i < 15; i++) {
            rt_rng rng = kind == 0 ? rt_sobol_start((uint32_t)i, 0, 8)
                                   : rt_rng_start((uint32_t)i, 0, 8);
            const float dx = rt_random(&rng);
            const float dy = rt_random(&rng);
            const float r = rt_random(&rng);
            assert_vec(image.pixels[i], (float)(i % 5) + dx, (float)(i / 5) + dy, r, 0);
        }
        free(image.pixels);
    }
}

/* ---- how noisy pictures are --------------------------------------------------------- */

/* What the noise of a scene is measured on. */
typedef struct subject {
    const char *name;
    const rt_scene *scene;
    rt_camera camera;
    int width, height, bounces;
} subject;

static const rt_sphere furnace_sphere = {{0, 0, 0}, 10, {{0.7f, 0.5f, 0.3f}, false}};
static const rt_light furnace_light = {{3, -5, 1}, {60, 90, 120}};
static const rt_scene furnace = {.spheres = &furnace_sphere,
                                 .sphere_count = 1,
                                 .lights = &furnace_light,
                                 .light_count = 1};
static const rt_scene sky = {.background = {0.1f, 0.2f, 0.3f}};

static const subject room = {
    "room", &scene_indirect, {{0, 8, 105}, {0, -1, -105}, {0, 1, 0}, 46}, 32, 24, 5};
static const subject oven = {
    "furnace", &furnace, {{-4, 2, 5}, {4, -2, -5}, {0, 1, 0}, 70}, 32, 24, 5};
static const subject mirrors = {
    "mirrors", &scene_mirror, {{0, 8, 105}, {0, -1, -105}, {0, 1, 0}, 46}, 32, 24, 1};
static const subject background = {
    "background", &sky, {{0, 0, 0}, {0, 0, 0}, {0, 0, 0}, 0}, 16, 12, 3};

static rt_image picture_of(const subject *s, rt_options options, bool half)
{
    rt_image image = new_image(s->width, s->height);
    if (half)
        image.half = new_image(s->width, s->height).pixels;
    options.bounces = s->bounces;
    assert_int_equal(rt_render(s->scene, &s->camera, &options, &image), RT_OK);
    return image;
}

static void free_picture(rt_image *image)
{
    free(image->pixels);
    free(image->half);
}

static double component(rt_vec3 v, int k)
{
    return (double)(k == 0 ? v.x : k == 1 ? v.y : v.z);
}

/* Pictures of the same scene with different seeds. No reference is needed to tell how far
 * they are from the truth: they are as far from each other. */
typedef struct survey {
    double mean;  /* over pictures, pixels and channels */
    double error; /* the standard deviation over pictures, as rt_image_error has it */
    double sigma; /* of mean, relative */
} survey;

static survey survey_of(const rt_image *images, int count)
{
    survey result = {0, 0, 0};
    const int values = 3 * images[0].width * images[0].height;
    double variance = 0;
    for (int i = 0; i < values; i++) {
        double sum = 0, squares = 0;
        for (int s = 0; s < count; s++)
            sum += component(images[s].pixels[i / 3], i % 3) / count;
        for (int s = 0; s < count; s++)
            squares += pow(component(images[s].pixels[i / 3], i % 3) - sum, 2);
        variance += squares / (count - 1) / values;
        result.mean += sum / values;
    }
    result.error = sqrt(variance) / result.mean;
    result.sigma =
        result.error / sqrt((double)count * values / 3); /* channels go together */
    return result;
}

enum { SEEDS = 8 };

static survey noise_of(const subject *s, rt_sampler sampler, int samples, bool half,
                       int seeds, double *estimate)
{
    rt_image images[SEEDS];
    memset(images, 0, sizeof images);
    double sum = 0;
    for (int i = 0; i < seeds; i++) {
        rt_options options = defaults;
        options.samples = samples;
        options.sampler = sampler;
        options.seed = (uint32_t)i;
        images[i] = picture_of(s, options, half);
        sum += (double)rt_image_error(&images[i]) / seeds;
    }
    if (estimate)
        *estimate = sum;
    const survey result = survey_of(images, seeds);
    for (int i = 0; i < seeds; i++)
        free_picture(&images[i]);
    return result;
}

static void test_sobol_needs_half_of_the_samples(void **state)
{
    /* The error of n random numbers falls as 1/sqrt(n), so 16 and 64 of them tell what
     * 256 will give. So the ratio of the squares of the errors is the ratio of samples
     * for the same error. */
    (void)state;
    subject large = room;
    large.width = 64;
    large.height = 48;
    const survey few = noise_of(&large, RT_RANDOM, 16, false, 5, NULL);
    const survey random = noise_of(&large, RT_RANDOM, 64, false, 5, NULL);
    assert_close(few.error / random.error, 2, 0.1);
    const int samples[] = {64, 256};
    const double wanted[] = {2.0, 2.8};
    for (size_t i = 0; i < COUNT(samples); i++) {
        const survey sobol = noise_of(&large, RT_SOBOL, samples[i], false, 3, NULL);
        const double as_many = random.error * sqrt(64.0 / samples[i]);
        const double gain = pow(as_many / sobol.error, 2);
        print_message("%d samples: error %.2f %% random, %.2f %% Sobol: as good as %.2f "
                      "times as many\n",
                      samples[i], 100 * as_many, 100 * sobol.error, gain);
        assert_true(gain >= wanted[i]);
        /* and both have the same mean */
        const double sigma =
            sqrt(random.sigma * random.sigma + sobol.sigma * sobol.sigma);
        assert_close(sobol.mean / random.mean, 1, 4 * sigma);
        assert_true(sigma < 0.002);
    }
}

static void test_pixels_have_the_same_mean_with_both(void **state)
{
    /* Not only the picture: each block of 8 x 8 pixels. */
    (void)state;
    enum { BLOCK = 8, BLOCKS = (32 / BLOCK) * (24 / BLOCK), PASSES = 6 };
    static double sum[2][BLOCKS], squares[2][BLOCKS];
    memset(sum, 0, sizeof sum);
    memset(squares, 0, sizeof squares);
    for (int kind = 0; kind < 2; kind++)
        for (int pass = 0; pass < PASSES; pass++) {
            rt_options options = defaults;
            options.samples = 32;
            options.sampler = kind == 0 ? RT_SOBOL : RT_RANDOM;
            options.seed = (uint32_t)(100 + pass);
            rt_image image = picture_of(&room, options, false);
            double blocks[BLOCKS] = {0};
            for (int i = 0; i < 32 * 24; i++)
                blocks[i / 32 / BLOCK * (32 / BLOCK) + i % 32 / BLOCK] +=
                    (double)image.pixels[i].y;
            for (int b = 0; b < BLOCKS; b++) {
                sum[kind][b] += blocks[b] / PASSES;
                squares[kind][b] += blocks[b] * blocks[b] / PASSES;
            }
            free_picture(&image);
        }
    double chi2 = 0;
    for (int b = 0; b < BLOCKS; b++) {
        double variance = 0;
        for (int kind = 0; kind < 2; kind++)
            variance += (squares[kind][b] - sum[kind][b] * sum[kind][b]) / (PASSES - 1);
        chi2 += pow(sum[0][b] - sum[1][b], 2) / variance;
        assert_close(sum[0][b], sum[1][b], 6 * sqrt(variance)); /* Student: few passes */
    }
    /* the squares of Student's t with some 8 degrees of freedom: mean 8/6 */
    print_message("blocks of both samplers: mean square %.2f sigma\n", chi2 / BLOCKS);
    assert_true(chi2 / BLOCKS < 8.0 / 6 + 4 * 3.0 / sqrt(BLOCKS));
}

/* ---- the estimated error ------------------------------------------------------------ */

static void test_the_estimate_covers_the_true_error(void **state)
{
    (void)state;
    const subject *const subjects[] = {&room, &oven, &mirrors};
    const int samples[] = {16, 7};
    for (size_t i = 0; i < COUNT(subjects); i++)
        for (int kind = 0; kind < 2; kind++)
            for (size_t k = 0; k < COUNT(samples); k++) {
                double estimate;
                const survey truth =
                    noise_of(subjects[i], kind == 0 ? RT_SOBOL : RT_RANDOM, samples[k],
                             true, SEEDS, &estimate);
                print_message("%s, %s, %d samples: error %.3f %%, estimated %.3f %%\n",
                              subjects[i]->name, kind == 0 ? "Sobol" : "random",
                              samples[k], 100 * truth.error, 100 * estimate);
                assert_close(estimate / truth.error, 1, 0.1);
            }
}

static void test_one_estimate_is_not_far_off_either(void **state)
{
    /* Not only their mean over seeds. */
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        const rt_sampler sampler = kind == 0 ? RT_SOBOL : RT_RANDOM;
        const survey truth = noise_of(&room, sampler, 16, true, SEEDS, NULL);
        for (int i = 0; i < SEEDS; i++) {
            rt_options options = defaults;
            options.samples = 16;
            options.sampler = sampler;
            options.seed = (uint32_t)i;
            rt_image image = picture_of(&room, options, true);
            assert_close((double)rt_image_error(&image) / truth.error, 1, 0.1);
            free_picture(&image);
        }
    }
}

static void test_no_noise_no_error(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.samples = 5;
    rt_image image = picture_of(&background, options, true);
    assert_close(rt_image_error(&image), 0, 0);
    memset(image.pixels, 0, 16 * 12 * sizeof *image.pixels);
    memset(image.half, 0, 16 * 12 * sizeof *image.half);
    assert_close(rt_image_error(&image), 0, 0); /* black */
    free_picture(&image);
}

static void test_the_error_of_two_pixels_by_hand(void **state)
{
    /* Mean 2, and 3 of 5 samples with a mean of 2.3 and 1.6: the sum of squares is 3 (0.09 +
     * 0.16), times 3/2, over 6 values: sqrt(0.1875); relative to 2. */
    (void)state;
    rt_vec3 pixels[2] = {{2, 2, 2}, {2, 2, 2}};
    rt_vec3 half[2] = {{2.3f, 2.3f, 1.7f}, {1.6f, 2.4f, 1.6f}};
    rt_image image = {
        .width = 2, .height = 1, .pixels = pixels, .samples = 5, .half = half};
    assert_close(rt_image_error(&image), sqrt(0.1875) / 2, 1e-6);
    image.samples = 6; /* 3 of 6 */
    assert_close(rt_image_error(&image), sqrt(0.125) / 2, 1e-6);
}

static void test_the_error_is_unknown(void **state)
{
    (void)state;
    rt_vec3 pixel = {1, 1, 1}, half = {1, 1, 1};
    rt_image image = {
        .width = 1, .height = 1, .pixels = &pixel, .samples = 2, .half = &half};
    assert_close(rt_image_error(&image), 0, 0);
    image.samples = 1;
    assert_true(rt_image_error(&image) == INFINITY);
    image.samples = 0;
    assert_true(rt_image_error(&image) == INFINITY);
    image.samples = 2;
    image.half = NULL;
    assert_true(rt_image_error(&image) == INFINITY);
    image.half = &half;
    image.pixels = NULL;
    assert_true(rt_image_error(&image) == INFINITY);
    assert_true(rt_image_error(NULL) == INFINITY);
}

static rt_vec3 sample_squared(const void *context, float x, float y, rt_rng *rng)
{
    (void)context;
    const float n = (float)rng->sample;
    return rt_vec(n * n, x, y);
}

static void test_half_is_the_mean_of_the_even_samples(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.sampler = RT_RANDOM;
    const int samples[] = {1, 2, 5, 6};
    const double all[] = {0, 0.5, 6, 55.0 / 6}, even[] = {0, 0, 20.0 / 3, 20.0 / 3};
    for (size_t i = 0; i < COUNT(samples); i++) {
        rt_vec3 pixel, half;
        rt_image image = {.width = 1, .height = 1, .pixels = &pixel, .half = &half};
        options.samples = samples[i];
        assert_int_equal(rt_render_pixels(sample_squared, NULL, &options, &image), RT_OK);
        assert_close(pixel.x, all[i], 1e-5);
        assert_close(half.x, even[i], 1e-5);
    }
}

static void test_half_does_not_change_random_pictures(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.samples = 7;
    options.sampler = RT_RANDOM;
    rt_image with = picture_of(&room, options, true);
    rt_image without = picture_of(&room, options, false);
    assert_true(same_pixels(&with, &without));
    assert_int_equal(with.rays, without.rays);
    free_picture(&with);
    free_picture(&without);
}

static void test_half_costs_sobol_little(void **state)
{
    /* Two sequences of 32 samples spread less evenly than one of 64, and much more evenly than
     * 64 random ones. */
    (void)state;
    const survey one = noise_of(&room, RT_SOBOL, 32, false, SEEDS, NULL);
    const survey two = noise_of(&room, RT_SOBOL, 32, true, SEEDS, NULL);
    const survey random = noise_of(&room, RT_RANDOM, 32, true, SEEDS, NULL);
    print_message(
        "32 samples: error %.2f %% in one sequence, %.2f %% in two, %.2f %% random\n",
        100 * one.error, 100 * two.error, 100 * random.error);
    assert_true(two.error < 1.15 * one.error);
    assert_true(two.error < 0.8 * random.error);
}

/* ---- when to stop ------------------------------------------------------------------- */

static void test_stop_at_a_wanted_error(void **state)
{
    /* The true error, from pictures that all wanted the same error, is at most that, and
     * not much less: the samples are counted in steps of an eighth. */
    (void)state;
    const double wanted[] = {0.08, 0.12};
    for (int kind = 0; kind < 2; kind++) {
        rt_image images[SEEDS];
        int samples = 0;
        for (int i = 0; i < SEEDS; i++) {
            rt_options options = defaults;
            options.error = (float)wanted[kind];
            options.samples = 400; /* more than it takes */
            options.sampler = kind == 0 ? RT_SOBOL : RT_RANDOM;
            options.seed = (uint32_t)i;
            images[i] = picture_of(&room, options, true);
            assert_true((double)rt_image_error(&images[i]) <= wanted[kind]);
            assert_int_equal(images[i].done, 0);
            assert_int_equal(images[i].samples % 2, 0);
            samples += images[i].samples;
        }
        const survey truth = survey_of(images, SEEDS);
        for (int i = 0; i < SEEDS; i++)
            free_picture(&images[i]);
        print_message("%s: error %.2f %% wanted, %.2f %% after %.0f samples\n",
                      kind == 0 ? "Sobol" : "random", 100 * wanted[kind],
                      100 * truth.error, (double)samples / SEEDS);
        assert_true(truth.error <= 1.05 * wanted[kind]);
        assert_true(truth.error >= 0.8 * wanted[kind]);
        assert_true(samples > 20 * SEEDS); /* otherwise there was nothing to decide */
    }
}

static void test_samples_are_a_limit_to_the_wanted_error(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.samples = 18;
    options.error = 1e-6f;
    rt_image image = picture_of(&room, options, true);
    assert_int_equal(image.samples, 18);
    free_picture(&image);
    options.samples = 400;
    options.error = 10;
    image = picture_of(&room, options, true);
    assert_in_range(image.samples, 2, 16); /* at the first look */
    free_picture(&image);
}

static void test_an_image_that_is_good_enough_gets_little_more(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.samples = 20;
    rt_image image = picture_of(&room, options, true);
    options.samples = 0;
    options.error = 1;
    options.bounces = room.bounces;
    assert_int_equal(rt_render(room.scene, &room.camera, &options, &image), RT_OK);
    assert_in_range(image.samples, 20, 36);
    free_picture(&image);
}

static void test_stop_after_some_time(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.seconds = 0.15f;
    const double start = rt__seconds();
    rt_image image = picture_of(&room, options, false);
    const double took = rt__seconds() - start;
    print_message("0.15 s wanted, %.3f s, %d samples and %d pixels\n", took,
                  image.samples, image.done);
    assert_true(took >= 0.15 && took < 1.2); /* the machine may be busy */
    assert_true(image.samples >= 1);
    free_picture(&image);
}

static void test_one_sample_whatever_the_time(void **state)
{
    (void)state;
    rt_options options = defaults;
    const subject large = {
        "large", &scene_indirect, {{0, 8, 105}, {0, -1, -105}, {0, 1, 0}, 46}, 320, 240,
        5};
    options.seconds = 1e-6f;
    rt_image image = picture_of(&large, options, false);
    assert_int_equal(image.samples, 1);
    assert_int_equal(image.done, 0);
    free_picture(&image);
}

static void test_samples_are_a_limit_to_the_time(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.samples = 3;
    options.seconds = 1000;
    rt_image image = picture_of(&background, options, false);
    assert_int_equal(image.samples, 3);
    free_picture(&image);
}

static void test_error_and_time_together(void **state)
{
    (void)state;
    rt_options options = defaults;
    options.error = 1e-9f;
    options.seconds = 0.02f;
    rt_image image = picture_of(&room, options, true); /* returns */
    assert_true(image.samples >= 1);
    free_picture(&image);
    options.error = 0.5f;
    options.seconds = 1000;
    image = picture_of(&room, options, true); /* returns, too */
    assert_in_range(image.samples, 2, 32);
    free_picture(&image);
}

static void test_a_picture_that_was_out_of_time_goes_on_to_the_same_bits(void **state)
{
    (void)state;
    enum { N = 6 };
    for (int half = 0; half < 2; half++) {
        rt_options options = defaults;
        options.samples = N;
        rt_image whole = picture_of(&room, options, half == 1),
                 pieces = new_image(32, 24);
        if (half == 1)
            pieces.half = new_image(32, 24).pixels;
        options.bounces = room.bounces;
        int calls = 0;
        for (; pieces.samples < N; calls++) {
            options.samples = N - pieces.samples;
            options.seconds = 1e-6f;
            options.threads = 1 + calls % 2;
            assert_int_equal(rt_render(room.scene, &room.camera, &options, &pieces),
                             RT_OK);
        }
        assert_true(calls > 1);
        assert_int_equal(pieces.samples, N);
        assert_int_equal(pieces.rays, whole.rays);
        assert_true(same_pixels(&whole, &pieces));
        if (half == 1)
            assert_memory_equal(whole.half, pieces.half, 32 * 24 * sizeof *whole.half);
        free_picture(&whole);
        free_picture(&pieces);
    }
}

typedef struct watch {
    int calls;
    float before, last;
} watch;

static bool watch_progress(void *user, float part)
{
    watch *w = user;
    assert_true(part >= w->last && part <= 1);
    w->before = w->last;
    w->last = part;
    w->calls++;
    return true;
}

static void test_progress_ends_at_one_however_it_ends(void **state)
{
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        watch w = {0, 0, 0};
        rt_options options = defaults;
        options.progress = watch_progress;
        options.user = &w;
        if (kind == 0)
            options.error = 0.03f; /* 0.1 s or so */
        else
            options.seconds = 0.1f;
        rt_image image = picture_of(&room, options, true);
        assert_close(w.last, 1, 0);
        assert_true(w.calls > 1);
        assert_true(w.before > 0.3f); /* and it was on its way there */
        free_picture(&image);
    }
}

static void test_black_is_not_good_enough_if_no_error_is_wanted(void **state)
{
    (void)state;
    rt_options options = defaults;
    const rt_scene nothing = {0};
    const subject black = {"black", &nothing, {{0, 0, 0}, {0, 0, -1}, {0, 1, 0}, 46},
                           4,       3,        0};
    options.samples = 100;
    rt_image image = picture_of(&black, options, true);
    assert_int_equal(image.samples, 100);
    free_picture(&image);
}

/* ---- bad input ---------------------------------------------------------------------- */

static void test_bad_samplers_errors_and_times_are_refused(void **state)
{
    (void)state;
    const struct {
        int sampler;
        float error, seconds;
        bool half;
        rt_status status;
    } cases[] = {
        {2, 0, 0, true, RT_BAD_SAMPLER},       {-1, 0, 0, true, RT_BAD_SAMPLER},
        {0, NAN, 0, true, RT_BAD_ERROR},       {0, -0.01f, 0, true, RT_BAD_ERROR},
        {0, -INFINITY, 0, true, RT_BAD_ERROR}, {0, 0.01f, 0, false, RT_BAD_ERROR},
        {1, 1e-30f, 0, false, RT_BAD_ERROR},   {0, 0, NAN, true, RT_BAD_SECONDS},
        {0, 0, -1, true, RT_BAD_SECONDS},      {0, 0, -INFINITY, false, RT_BAD_SECONDS},
        {0, -0.0f, -0.0f, false, RT_OK},
    };
    for (size_t i = 0; i < COUNT(cases); i++) {
        rt_vec3 pixel = {7, 7, 7}, half = {7, 7, 7};
        rt_image image = {.width = 1,
                          .height = 1,
                          .pixels = &pixel,
                          .half = cases[i].half ? &half : NULL};
        rt_options options = defaults;
        options.samples = 1;
        options.sampler = (rt_sampler)cases[i].sampler;
        options.error = cases[i].error;
        options.seconds = cases[i].seconds;
        assert_int_equal(rt_render(&sky, &room_camera, &options, &image),
                         cases[i].status);
        if (cases[i].status != RT_OK)
            assert_int_equal(rt_render_pixels(sample_squared, NULL, &options, &image),
                             cases[i].status);
        const bool untouched_image = pixel.x == 7 && half.x == 7 && image.samples == 0;
        assert_true(untouched_image == (cases[i].status != RT_OK));
    }
}

/* ---- the demo ----------------------------------------------------------------------- */

static void test_demo_numbers_are_those_of_rt_random(void **state)
{
    (void)state;
    for (uint32_t i = 0; i < 20000; i++) {
        const uint32_t sample = i < 10000 ? i % 100 : rt_hash(i);
        rt_rng rng = rt_sobol_start(rt_hash(i), sample, i % 7);
        const uint32_t key = rng.key;
        for (uint32_t dimension = 0; dimension < 14; dimension++)
            assert_close(sobol(key, sample, dimension), rt_random(&rng), 0);
    }
}

static void test_demo_picture_is_that_of_rt_render(void **state)
{
    (void)state;
    rt_image theirs = render_the_demo(32, 24, 3, 5);
    rt_options options = defaults;
    options.samples = 3;
    options.seed = 5;
    rt_image ours = picture_of(&room, options, true);
    assert_true(same_pixels(&theirs, &ours));
    free_picture(&theirs);
    free_picture(&ours);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_reverse),
        cmocka_unit_test(test_the_second_coordinate_is_sobols),
        cmocka_unit_test(test_scramble_flips_bits_by_those_below_only),
        cmocka_unit_test(test_scramble_is_one_to_one),
        cmocka_unit_test(test_scramble_flips_every_bit_half_of_the_time),
        cmocka_unit_test(test_sobols_numbers_are_between_zero_and_one),
        cmocka_unit_test(test_every_part_of_the_square_gets_its_sample),
        cmocka_unit_test(test_pairs_take_the_samples_in_orders_of_their_own),
        cmocka_unit_test(test_pixels_and_seeds_have_numbers_of_their_own),
        cmocka_unit_test(test_sobol_is_the_default),
        cmocka_unit_test(test_render_pixels_hands_out_the_same_numbers),
        cmocka_unit_test(test_sobol_needs_half_of_the_samples),
        cmocka_unit_test(test_pixels_have_the_same_mean_with_both),
        cmocka_unit_test(test_the_estimate_covers_the_true_error),
        cmocka_unit_test(test_one_estimate_is_not_far_off_either),
        cmocka_unit_test(test_no_noise_no_error),
        cmocka_unit_test(test_the_error_of_two_pixels_by_hand),
        cmocka_unit_test(test_the_error_is_unknown),
        cmocka_unit_test(test_half_is_the_mean_of_the_even_samples),
        cmocka_unit_test(test_half_does_not_change_random_pictures),
        cmocka_unit_test(test_half_costs_sobol_little),
        cmocka_unit_test(test_stop_at_a_wanted_error),
        cmocka_unit_test(test_samples_are_a_limit_to_the_wanted_error),
        cmocka_unit_test(test_an_image_that_is_good_enough_gets_little_more),
        cmocka_unit_test(test_stop_after_some_time),
        cmocka_unit_test(test_one_sample_whatever_the_time),
        cmocka_unit_test(test_samples_are_a_limit_to_the_time),
        cmocka_unit_test(test_error_and_time_together),
        cmocka_unit_test(test_a_picture_that_was_out_of_time_goes_on_to_the_same_bits),
        cmocka_unit_test(test_progress_ends_at_one_however_it_ends),
        cmocka_unit_test(test_black_is_not_good_enough_if_no_error_is_wanted),
        cmocka_unit_test(test_bad_samplers_errors_and_times_are_refused),
        cmocka_unit_test(test_demo_numbers_are_those_of_rt_random),
        cmocka_unit_test(test_demo_picture_is_that_of_rt_render),
    };
    return cmocka_run_group_tests_name("9 less noise", tests, NULL, NULL);
}

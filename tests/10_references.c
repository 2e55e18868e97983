/* rt.h against independent renderers: every scene in references/scenes that has an image
 * in references/ref. To add one, put NAME.json and NAME.pfm there. NAME.se.pfm, the
 * standard error of each value, tells its noise; without it the image counts as exact. */
#define _POSIX_C_SOURCE 200809L /* scandir */
#include <dirent.h>

#include "scene_file.h"
#include "test.h"

/* RENDER_ONLY is for tests/check, once gcc's pictures are compared: two passes, and no comparison. */
#ifdef RENDER_ONLY
enum { PASSES = 2 };
#else
enum { PASSES = 32 };
#endif
enum { SAMPLES = 4, MORE_SAMPLES = 16, BLOCK = 8 };

static double channel(rt_vec3 v, int k)
{
    return (double)(k == 0 ? v.x : k == 1 ? v.y : v.z);
}

/* The sum of one channel over a block of pixels, or of its square. */
static double block_sum(const rt_vec3 *pixels, int width, int block, int k, int power)
{
    const int columns = width / BLOCK, x0 = block % columns * BLOCK;
    const int y0 = block / columns * BLOCK;
    double sum = 0;
    for (int y = y0; y < y0 + BLOCK; y++)
        for (int x = x0; x < x0 + BLOCK; x++)
            sum += pow(channel(pixels[y * width + x], k), power);
    return sum;
}

/* The mean of some numbers, and the standard error of that mean. */
static double mean_of(const double *values, double *error)
{
    double sum = 0, squares = 0;
    for (int i = 0; i < PASSES; i++)
        sum += values[i] / PASSES;
    for (int i = 0; i < PASSES; i++)
        squares += (values[i] - sum) * (values[i] - sum);
    *error = sqrt(squares / PASSES / (PASSES - 1));
    return sum;
}

/* Is the scene as rt.h renders it the reference but for noise? It is rendered PASSES
 * times with different seeds; their differences tell how noisy their mean is. Per
 * channel, - the mean of the image: |ratio - 1| <= 3 standard errors, theirs and ours, +
 * 0.0005; - the means of 8 x 8 blocks: at most 1 % of them further off than 3 standard
 * errors. */
static void compare(const char *name, int width, int height, const rt_image *images,
                    const rt_vec3 *reference, const rt_vec3 *error)
{
    const int blocks = (width / BLOCK) * (height / BLOCK);
    double total = 0;
    for (int block = 0; block < blocks; block++)
        for (int k = 0; k < 3; k++)
            total += block_sum(reference, width, block, k, 1) / (3.0 * blocks);
    int outside = 0;
    double worst = 0;
    for (int k = 0; k < 3; k++) {
        double all[PASSES] = {0}, expected_all = 0, variance_all = 0;
        for (int block = 0; block < blocks; block++) {
            double ours[PASSES], ours_error;
            for (int pass = 0; pass < PASSES; pass++) {
                ours[pass] = block_sum(images[pass].pixels, width, block, k, 1);
                all[pass] += ours[pass];
            }
            const double expected = block_sum(reference, width, block, k, 1);
            const double variance = error ? block_sum(error, width, block, k, 2) : 0.0;
            const double difference = mean_of(ours, &ours_error) - expected;
            const double sigma = sqrt(variance + ours_error * ours_error);
            outside += !(fabs(difference) <= 3 * sigma + 1e-4 * total);
            expected_all += expected;
            variance_all += variance;
        }
        double all_error;
        const double mean = mean_of(all, &all_error);
        const double sigma = sqrt(variance_all + all_error * all_error) / expected_all;
        if (!(fabs(mean / expected_all - 1) <= 3 * sigma + 0.0005))
            fail_msg("%s: mean of channel %d is %.5f of the reference's, sigma %.5f",
                     name, k, mean / expected_all, sigma);
        worst = fmax(worst, fabs(mean / expected_all - 1));
    }
    print_message("%s: mean within %.3f %%, %d of %d blocks beyond 3 sigma\n", name,
                  100 * worst, outside, 3 * blocks);
    if (outside * 100 > 3 * blocks)
        fail_msg("%s: %d of %d blocks are more than 3 sigma off", name, outside,
                 3 * blocks);
}

static void check_scene(const char *name)
{
    char path[300];
    static scene_file file;
    snprintf(path, sizeof path, "tests/references/scenes/%s.json", name);
    if (!read_scene(path, &file))
        fail_msg("%s: %s", path, file.error);
    const int width = file.width, height = file.height;
    snprintf(path, sizeof path, "tests/references/ref/%s.pfm", name);
    rt_vec3 *reference = read_pfm(path, width, height);
    if (!reference)
        fail_msg("%s: no PFM of %d x %d", path, width, height);
    snprintf(path, sizeof path, "tests/references/ref/%s.se.pfm", name);
    rt_vec3 *error = read_pfm(path, width, height);
    rt_image images[PASSES];
    /* what only chance finds, such as light by way of a mirror, is rare and bright: a few
     * samples do not tell sigma well enough */
    const int samples = file.scene.lamp_count > 0 ? MORE_SAMPLES : SAMPLES;
    for (int pass = 0; pass < PASSES; pass++) {
        images[pass] = new_image(width, height);
        assert_int_equal(render_scene(&file, samples, (uint32_t)pass, &images[pass]),
                         RT_OK);
    }
    if (PASSES > 2)
        compare(name, width, height, images, reference, error);
    for (int pass = 0; pass < PASSES; pass++)
        free(images[pass].pixels);
    free(reference);
    free(error);
    free_scene(&file);
}

static void test_scene(void **state)
{
    check_scene(*state);
}

static int is_scene(const struct dirent *entry)
{
    const size_t length = strlen(entry->d_name);
    return length > 5 && strcmp(entry->d_name + length - 5, ".json") == 0;
}

int main(void)
{
    struct dirent **entries;
    struct CMUnitTest tests[100];
    const int count = scandir("tests/references/scenes", &entries, is_scene, alphasort);
    if (count < 1 || count > (int)COUNT(tests))
        return fprintf(stderr,
                       "no scenes in tests/references/scenes, or more than 100\n"),
               1;
    for (int i = 0; i < count; i++) {
        char *name = entries[i]->d_name;
        name[strlen(name) - 5] = '\0';
        tests[i] = (struct CMUnitTest){name, test_scene, NULL, NULL, name};
    }
    const int failed =
        _cmocka_run_group_tests("references", tests, (size_t)count, NULL, NULL);
    for (int i = 0; i < count; i++)
        free(entries[i]);
    free(entries);
    return failed;
}

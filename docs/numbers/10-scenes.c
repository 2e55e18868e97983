/* Chapter 10: the error of twelve scenes, noisy and finished, against pictures with 1024
 * samples of another seed, whose noise is subtracted. Slow: some minutes. */
#include "10-scenes.h"

enum { W = 320, H = 240, PIXELS = W * H, COUNTS = 4 };
static rt_vec3 true_pixels[PIXELS], true_half[PIXELS], pixels[PIXELS], half[PIXELS];
static rt_vec3 finished[PIXELS];
static rt_guide guides[PIXELS];
static rt_image truth = {W, H, true_pixels, .half = true_half};
static rt_image image = {W, H, pixels, .half = half, .guides = guides};
static rt_image result = {W, H, finished};

static double error_of(const rt_image *a)
{
    double squares = 0, sum = 0;
    const double noise = rt_image_error(&truth);
    for (int i = 0; i < PIXELS; i++) {
        const rt_vec3 d = rt_sub(a->pixels[i], truth.pixels[i]), c = truth.pixels[i];
        squares += rt_dot(d, d);
        sum += c.x + c.y + c.z;
    }
    const double error = sqrt(squares / (3 * PIXELS)) / (sum / (3 * PIXELS));
    return sqrt(fmax(0, error * error - noise * noise));
}

/* As bytes show it: the mean of the channels, encoded. */
static double shown(const rt_image *a, int i)
{
    const rt_vec3 c = a->pixels[i];
    return pow(fmin(1, (c.x + c.y + c.z) / 3), 1 / 2.2);
}

/* Structural similarity to the truth, 1 at most: Z. Wang et al., "Image quality assessment",
 * 2004, with a Gaussian window of 11 x 11 and standard deviation 1.5. */
static double similarity(const rt_image *a)
{
    double sum = 0;
    int count = 0;
    for (int y = 5; y < H - 5; y++)
        for (int x = 5; x < W - 5; x++, count++) {
            double w = 0, p = 0, q = 0, pp = 0, qq = 0, pq = 0;
            for (int dy = -5; dy <= 5; dy++)
                for (int dx = -5; dx <= 5; dx++) {
                    const int i = (y + dy) * W + x + dx;
                    const double g = exp(-(dx * dx + dy * dy) / 4.5);
                    const double u = shown(a, i), v = shown(&truth, i);
                    w += g, p += g * u, q += g * v;
                    pp += g * u * u, qq += g * v * v, pq += g * u * v;
                }
            p /= w, q /= w;
            pp = pp / w - p * p, qq = qq / w - q * q, pq = pq / w - p * q;
            sum += (2 * p * q + 1e-4) * (2 * pq + 9e-4) /
                   ((p * p + q * q + 1e-4) * (pp + qq + 9e-4));
        }
    return sum / count;
}

typedef struct outcome {
    double noisy, clean, similar_noisy, similar_clean;
} outcome;

static outcome measure(const test_scene *s, int samples, rt_sampler sampler)
{
    const rt_options options = {
        .samples = samples, .bounces = s->bounces, .seed = 7, .sampler = sampler};
    outcome o;
    rt_image_clear(&image);
    rt_render(&s->scene, &s->camera, &options, &image);
    rt_denoise(&image, 0, &result);
    o.noisy = error_of(&image);
    o.clean = error_of(&result);
    o.similar_noisy = similarity(&image);
    o.similar_clean = similarity(&result);
    return o;
}

int main(void)
{
    static test_scene s;
    static outcome all[SCENES][COUNTS + 1]; /* the last: random numbers, 16 samples */
    int above_half = 0, compared = 0, not_similar = 0, similar = 0;
    for (int i = 0; i < SCENES; i++) {
        make_scene(i, &s);
        rt_image_clear(&truth);
        const rt_options options = {.samples = 1024, .bounces = s.bounces, .seed = 99};
        rt_render(&s.scene, &s.camera, &options, &truth);
        for (int k = 0, samples = 4; k < COUNTS; k++, samples *= 4)
            all[i][k] = measure(&s, samples, RT_SOBOL);
        all[i][COUNTS] = measure(&s, 16, RT_RANDOM);
    }
    printf("| samples | 4 | 16 | 64 | 256 | 16, random numbers "
           "|\n|---|---|---|---|---|---|\n");
    for (int i = 0; i < SCENES; i++) {
        printf("| %s%s |", all_scenes[i].name, i < CHOSEN_WITH ? " *" : "");
        for (int k = 0; k < 5; k++) {
            const outcome *o = &all[i][k < 4 ? k : COUNTS];
            printf(" %.1f → %.*f %% |", 100 * o->noisy, o->clean < 0.01 ? 2 : 1,
                   100 * o->clean);
            compared++;
            above_half += o->clean > 0.5 * o->noisy;
        }
        printf("\n");
    }
    for (int i = 0; i < SCENES; i++)
        for (int k = 0; k < 2; k++) { /* 16 times as many samples */
            similar++;
            not_similar += all[i][k].similar_clean < all[i][k + 2].similar_noisy;
        }
    for (int k = 0, samples = 4; k < COUNTS; k++, samples *= 4)
        printf("room%d: %.1f → %.*f %%\n", samples, 100 * all[0][k].noisy,
               all[0][k].clean < 0.01 ? 2 : 1, 100 * all[0][k].clean);
    printf("room16-noisy: %.0f %%\nroom16-finished: %.1f %%\nroom16-times: %.1f\n",
           100 * all[0][1].noisy, 100 * all[0][1].clean,
           all[0][1].noisy / all[0][1].clean);
    printf("similar4: %.3f\nsimilar16: %.3f\nsimilar16-noisy: %.3f\nsimilar256-noisy: "
           "%.3f\n",
           all[0][0].similar_clean, all[0][1].similar_clean, all[0][1].similar_noisy,
           all[0][3].similar_noisy);
    make_scene(0, &s);
    rt_image_clear(&truth);
    const rt_options options = {.samples = 4096, .bounces = 5, .seed = 99};
    rt_render(&s.scene, &s.camera, &options, &truth);
    const outcome far = measure(&s, 1024, RT_SOBOL),
                  farther = measure(&s, 4096, RT_SOBOL);
    printf("room1024: %.2f → %.2f %%\n", 100 * far.noisy, 100 * far.clean);
    printf("room4096: %.2f → %.2f %%\n", 100 * farther.noisy, 100 * farther.clean);
    double worst = 0;
    for (int i = 0; i < SCENES; i++)
        for (int k = 0; k < COUNTS; k++)
            worst = fmax(worst, all[i][k].clean / all[i][k].noisy);
    printf("compared: %d\nabove-half: %d\nworst: %.2f\n", compared, above_half, worst);
    printf("not-as-16-times: %d of %d\n", not_similar, similar);
}

/* Chapter 9: the trap. Sobol's points with the samples in the same order in each pair. */
#define rt_random my_random
#include "9-room.h"
#undef rt_random

static bool trapped; /* false: the numbers that rt.h would give */

float my_random(rt_rng *rng)
{
    const uint32_t pair = rt_hash(rng->key + rng->dimension / 2);
    const uint32_t index = rng->sample; /* the trap: not shuffled for each pair */
    uint32_t bits = rng->sobol ? rt__sobol(rng) : rt_hash(rng->key + rng->dimension);
    if (trapped)
        bits = rt__reverse(rng->dimension % 2 == 0
                               ? rt__scramble(index, rt_hash(pair + 1))
                               : rt__scramble(rt__second(index), rt_hash(pair + 2)));
    rng->dimension++;
    return ((float)(bits >> 9) + 0.5f) * (1.0f / 8388608.0f);
}

int main(void)
{
    render(truth, NULL, 1024, 1000, RT_SOBOL);
    printf("| samples | 4 | 16 | 64 | 256 | 1024 |\n|---|---|---|---|---|---|\n");
    for (int which = 0; which < 2; which++) {
        trapped = which == 1;
        printf("| error, %s |", trapped ? "pairs in the same order" : "random numbers");
        for (int n = 4; n <= 1024; n *= 4) {
            render(picture, NULL, n, 0, trapped ? RT_SOBOL : RT_RANDOM);
            printf(" %.1f %% |", 100 * distance_from_truth());
        }
        printf("\n");
    }
}

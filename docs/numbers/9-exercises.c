/* Chapter 9, exercises 2 and 3: four of Sobol's points, and pi once more. */
#include "rt.h"
#include <stdio.h>

static double error_of_pi(uint32_t n, rt_rng (*begin)(uint32_t, uint32_t, uint32_t))
{
    double squares = 0;
    for (uint32_t seed = 0; seed < 1000; seed++) {
        int inside = 0;
        for (uint32_t k = 0; k < n; k++) {
            rt_rng rng = begin(0, k, seed);
            const float x = rt_random(&rng);
            const float y = rt_random(&rng);
            inside += x * x + y * y < 1;
        }
        squares += pow(4.0 * inside / n - 3.14159265358979, 2);
    }
    return sqrt(squares / 1000);
}

int main(void)
{
    printf("| points | 16 | 256 | 4096 |\n|---|---|---|---|\n| error, random numbers |");
    for (uint32_t n = 16; n <= 4096; n *= 16)
        printf(" %.3g |", error_of_pi(n, rt_rng_start));
    printf("\n| error, Sobol's points |");
    for (uint32_t n = 16; n <= 4096; n *= 16)
        printf(" %.2g |", error_of_pi(n, rt_sobol_start));
    printf("\n");
}

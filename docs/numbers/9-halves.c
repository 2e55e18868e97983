/* Chapter 9: the estimate from two halves, held against the true error. */
#include "9-error.h"

static void row(const char *what, rt_sampler sampler, bool halves, bool estimated)
{
    printf("| %s |", what);
    for (int n = 4; n <= 1024; n *= 4) {
        double estimate;
        const double error = error_of(n, sampler, halves, &estimate);
        printf(" %.1f %% |", 100 * (estimated ? estimate : error));
    }
    printf("\n");
}

int main(void)
{
    render(truth, NULL, 8192, 1000, RT_SOBOL);
    printf("| samples | 4 | 16 | 64 | 256 | 1024 |\n|---|---|---|---|---|---|\n");
    row("random: true error", RT_RANDOM, true, false);
    row("random: estimate", RT_RANDOM, true, true);
    row("Sobol's, one sequence: true error", RT_SOBOL, false, false);
    row("Sobol's, two halves: true error", RT_SOBOL, true, false);
    row("Sobol's, two halves: estimate", RT_SOBOL, true, true);
}

/* Chapter 9: the estimate from two halves, held against the true error. */
#include "9-error.h"

enum { COLUMNS = 5 }; /* 4 samples, 16, ... 1024 */

static void row(const char *what, const double values[COLUMNS])
{
    printf("| %s |", what);
    for (int i = 0; i < COLUMNS; i++)
        printf(" %.1f %% |", 100 * values[i]);
    printf("\n");
}

int main(void)
{
    double random[2][COLUMNS], halves[2][COLUMNS],
        one[COLUMNS]; /* true error, estimate */
    render(truth, NULL, 8192, 1000, RT_SOBOL);
    for (int i = 0, n = 4; i < COLUMNS; i++, n *= 4) {
        random[0][i] = error_of(n, RT_RANDOM, true, &random[1][i]);
        halves[0][i] = error_of(n, RT_SOBOL, true, &halves[1][i]);
        one[i] = error_of(n, RT_SOBOL, false, NULL);
    }
    printf("| samples | 4 | 16 | 64 | 256 | 1024 |\n|---|---|---|---|---|---|\n");
    row("random: true error", random[0]);
    row("random: estimate", random[1]);
    row("Sobol's, one sequence: true error", one);
    row("Sobol's, two halves: true error", halves[0]);
    row("Sobol's, two halves: estimate", halves[1]);
}

/* Chapter 9: the error with random numbers and with Sobol's points. */
#include "9-error.h"

int main(void)
{
    double random[6], sobol[6];
    render(truth, NULL, 8192, 1000, RT_SOBOL);
    printf("| samples |");
    for (int i = 0, n = 1; i < 6; i++, n *= 4) {
        random[i] = error_of(n, RT_RANDOM, false, NULL);
        sobol[i] = error_of(n, RT_SOBOL, false, NULL);
        printf(" %d |", n);
    }
    printf("\n|---|---|---|---|---|---|---|\n| random numbers |");
    for (int i = 0; i < 6; i++)
        printf(" %.1f %% |", 100 * random[i]);
    printf("\n| Sobol's points |");
    for (int i = 0; i < 6; i++)
        printf(" %.1f %% |", 100 * sobol[i]);
    printf("\n| random samples needed for the same error, as a multiple |");
    for (int i = 0; i < 6; i++)
        printf(" %.1f |", pow(random[i] / sobol[i], 2));
    printf("\ngain64: %.1f\ngain256: %.1f\n", pow(random[3] / sobol[3], 2),
           pow(random[4] / sobol[4], 2));
}

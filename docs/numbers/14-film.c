/* Chapter 14: light, and the bytes that the curve of a film makes of it, against clamping. */
#define RT_IMPLEMENTATION
#include "rt.h"
#include <stdio.h>

int main(void)
{
    static const float light[] = {0.01f, 0.1f, 0.25f, 0.5f, 1, 2, 4, 8};
    printf("| light |");
    for (int i = 0; i < 8; i++)
        printf(" %g |", (double)light[i]);
    printf("\n|---|---|---|---|---|---|---|---|---|\n| cut off at 1 |");
    for (int i = 0; i < 8; i++)
        printf(" %d |", rt_encode(light[i], 2.2));
    printf("\n| film |");
    for (int i = 0; i < 8; i++)
        printf(" %d |", rt_encode((float)(1 - exp(-(double)light[i])), 2.2));
    printf("\n| film, one stop less |");
    for (int i = 0; i < 8; i++)
        printf(" %d |", rt_encode((float)(1 - exp(-(double)light[i] / 2)), 2.2));
    int v = 0;
    while (rt_encode((float)(1 - exp(-v / 100.0)), 2.2) < 255)
        v++;
    printf("\nwhite: %.1f\n", v / 100.0);
}

/* Chapter 9: the first 16 of Sobol's points on a map, numbered from 0 to f. */
#include "rt.h"
#include <stdio.h>

int main(void)
{
    char map[16][16];
    memset(map, '.', sizeof map);
    for (uint32_t k = 0; k < 16; k++)
        map[rt__reverse(rt__second(k)) >> 28][rt__reverse(k) >> 28] =
            "0123456789abcdef"[k];
    printf("```\n");
    for (int y = 15; y >= 0; y--) {
        for (int x = 0; x < 16; x++)
            printf("%s %c", x > 0 && x % 4 == 0 ? " |" : "", map[y][x]);
        printf("\n%s",
               y % 4 == 0 && y > 0 ? "---------+---------+---------+---------\n" : "");
    }
    printf("```\n");
}

/* Chapter 9: the first of Sobol's points, in digits, and the first 16 on a map. */
#include "rt.h"
#include <stdio.h>

static void digits(char *text, uint32_t v, int count) /* the highest ones */
{
    for (int i = 0; i < count; i++)
        text[i] = (v >> (31 - i) & 1u) ? '1' : '0';
    text[count] = '\0';
}

static void cell(uint32_t v, int count)
{
    char text[4];
    digits(text, v, count);
    const int over = 1 << count;
    int part = (int)(v >> (32 - count)), shrink = 1;
    while (part % 2 == 0 && shrink < over) {
        part /= 2;
        shrink *= 2;
    }
    if (part == 0)
        printf(" 0.%s | 0 |", text);
    else
        printf(" 0.%s | %d/%d |", text, part, over / shrink);
}

int main(void)
{
    printf("| sample | binary | first coordinate | | second coordinate | |\n"
           "|---|---|---|---|---|---|\n");
    for (uint32_t k = 0; k < 8; k++) {
        char binary[4];
        const int count = k < 2 ? 1 : k < 4 ? 2 : 3;
        digits(binary, k << (32 - count), count);
        printf("| %u | %s |", k, binary);
        cell(rt__reverse(k), k == 0 ? 3 : count);
        cell(rt__reverse(rt__second(k)), k == 0 ? 3 : count);
        printf("\n");
    }
}

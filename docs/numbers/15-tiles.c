/* Chapter 15: a row of tiles around 0, by three formulas; and C's % and (int). */
#include <math.h>
#include <stdio.h>

static int right(float x)
{
    return (int)floorf(x / 10);
}
static int cut(float x)
{
    return (int)(x / 10);
} /* towards 0, not down */

int main(void)
{
    printf("| | tiles from -40 to 40, a letter for 5 units |\n|---|---|\n| floor, `% 2 "
           "== 0` | `");
    for (int i = -8; i < 8; i++)
        putchar(right((float)i * 5 + 2.5f) % 2 == 0 ? '#' : '.');
    printf("` |\n| `(int)`, `%% 2 == 0` | `");
    for (int i = -8; i < 8; i++)
        putchar(cut((float)i * 5 + 2.5f) % 2 == 0 ? '#' : '.');
    printf("` |\n| floor, `%% 2 == 1` for the other | `");
    for (int i = -8; i < 8; i++)
        putchar(right((float)i * 5 + 2.5f) % 2 == 1 ? '.' : '#');
    printf("` |\nremainder: %d\nint: %d\nfloor: %g\n", -3 % 2, (int)-0.5f, floorf(-0.5f));
}

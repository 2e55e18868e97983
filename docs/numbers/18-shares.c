/* Chapter 18: how long the first and the last of eight machines are busy, with a fixed share for
 * each, and with a counter. */
#include "18-shares.h"

static shares s;

static void print_row(const char *name, const int *who)
{
    double busy[MACHINES] = {0}, sum = 0, least, most;
    for (int k = 0; k < PARTS; k++) {
        busy[who[k]] += (double)s.rays[k];
        sum += (double)s.rays[k];
    }
    least = most = busy[0];
    for (int m = 1; m < MACHINES; m++) {
        least = busy[m] < least ? busy[m] : least;
        most = busy[m] > most ? busy[m] : most;
    }
    printf("| %s | %.2f | %.2f | %.1f |\n", name, least * MACHINES / sum,
           most * MACHINES / sum, sum / most);
}

int main(void)
{
    const rt_options options = {.samples = 16, .bounces = 5, .threads = 1};
    if (render_parts(&options, &s) != RT_OK)
        return 1;
    puts("| 8 machines | the first is ready after | the last after | times as fast as "
         "one |\n"
         "|---|---|---|---|");
    print_row("a fixed share for each", s.fixed);
    print_row("the next part for whoever is ready", s.counted);
}

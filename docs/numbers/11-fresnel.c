/* Chapter 11: how much glass of index 1.5 reflects, from outside and from inside; the mean over
 * all directions; and how far Schlick's approximation is off, with the right angle and with the
 * wrong one. Also a table of F by angle. */
#include "rt.h"
#include <stdio.h>

enum { N = 1000000 };
static const double pi = 3.14159265358979;

static double fresnel(double cosine, double eta)
{
    return (double)rt_fresnel((float)cosine, (float)eta);
}

/* C. Schlick, 1994. */
static double schlick(double cosine, double eta)
{
    const double f0 = pow((1 - eta) / (1 + eta), 2);
    return f0 + (1 - f0) * pow(1 - cosine, 5);
}

/* For light that comes equally from all directions: the weights are 2 cos d(cos). */
static double mean(double eta)
{
    double sum = 0;
    for (int i = 0; i < N; i++)
        sum += fresnel((i + 0.5) / N, eta) * 2 * (i + 0.5) / N;
    return sum / N;
}

static void row(const char *name, double eta, int schlicks)
{
    const double angles[] = {0, 20, 30, 40, 41.5, 45, 60, 75, 85};
    printf("| %s |", name);
    for (size_t i = 0; i < sizeof angles / sizeof *angles; i++) {
        const double cosine = cos(angles[i] * pi / 180);
        const double f = schlicks ? schlick(cosine, 1.5) : fresnel(cosine, eta);
        printf(" %.3f |", f);
    }
    printf("\n");
}

int main(void)
{
    printf("| angle of the ray to N | 0° | 20° | 30° | 40° | 41.5° | 45° | 60° | 75° | "
           "85° |\n"
           "|---|---|---|---|---|---|---|---|---|---|\n");
    row("from air into glass", 1.5, 0);
    row("from glass into air", 1 / 1.5, 0);

    printf("straight: %.4f\n", fresnel(1, 1.5));
    printf("water: %.2f\ndiamond: %.2f\n", fresnel(1, 1.33), fresnel(1, 2.42));
    printf("hand: %.4f\n", fresnel(sqrt(0.5), 1.5));
    const double brewster = atan(1.5), through = asin(sin(brewster) / 1.5);
    printf("brewster: %.2f\nbrewster-both: %.4f\n", brewster * 180 / pi,
           fresnel(cos(brewster), 1.5));
    printf("brewster-sum: %.2f\n", (brewster + through) * 180 / pi);
    printf("critical: %.2f\ncritical-water: %.2f\ncritical-diamond: %.2f\n",
           asin(1 / 1.5) * 180 / pi, asin(1 / 1.33) * 180 / pi,
           asin(1 / 2.42) * 180 / pi);

    const double outside = mean(1.5), inside = mean(1 / 1.5);
    printf("outside: %.4f\ninside: %.4f\nidentity: %.4f\n", outside, inside,
           1 - (1 - outside) / 2.25);

    double air = 0, outer_angle = 0, inner_angle = 0, at = 0;
    for (int i = 0; i <= N; i++) {
        const double cosine = (double)i / N, sin2 = 2.25 * (1 - cosine * cosine);
        air = fmax(air, fabs(schlick(cosine, 1.5) - fresnel(cosine, 1.5)));
        if (sin2 >= 1) /* total reflection: even the wrong listing has that */
            continue;
        const double f = fresnel(cosine, 1 / 1.5);
        outer_angle = fmax(outer_angle, fabs(schlick(sqrt(1 - sin2), 1.5) - f));
        if (fabs(schlick(cosine, 1.5) - f) > inner_angle) {
            inner_angle = fabs(schlick(cosine, 1.5) - f);
            at = acos(cosine) * 180 / pi;
        }
    }
    printf("schlick-air: %.3f\nschlick-right: %.3f\nschlick-wrong: %.3f\n", air,
           outer_angle, inner_angle);
    printf("schlick-at: %.1f\n", at);
    for (int k = 0; k < 2; k++) {
        const double degrees = k ? 41.5 : 40, c = cos(degrees * pi / 180);
        printf("inside%g: %.3f\nschlick%g: %.3f\n", degrees, fresnel(c, 1 / 1.5), degrees,
               schlick(c, 1.5));
    }
}

/* Chapter 13: the white furnace. Light 1 comes from everywhere; what a white lobe sends
 * to an eye at this angle, by quadrature: the integral of value . cosine over the
 * hemisphere. And how wide the lobes of the same shininess are. */
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

enum { PHONG, BLINN, BLINN_8, GGX };
static const double pi = 3.14159265358979323846;

/* In the plane of N = (0, 0, 1) and the eye: its angle, and what a lobe of exponent n sends of
 * the light from (x, y, z), times the cosine z. */
static double lobe(int model, double n, double eye, double x, double y, double z)
{
    const double ex = sin(eye), ez = cos(eye);
    const double mirror = z * ez - x * ex; /* <R, L> */
    double hx = x + ex, hy = y, hz = z + ez;
    const double length = sqrt(hx * hx + hy * hy + hz * hz), up = hz / length;
    if (model == PHONG)
        return mirror > 0 ? (n + 2) / (2 * pi) * pow(mirror, n) * z : 0;
    if (model == BLINN)
        return (n + 2) * (n + 4) / (8 * pi * (pow(2, -n / 2) + n)) * pow(up, n) * z;
    if (model == BLINN_8)
        return (n + 8) / (8 * pi) * pow(up, n) * z;
    const double a2 = 2 / (n + 2), k = up * up * (a2 - 1) + 1;
    const double D = a2 / (pi * k * k);
    const double seen = 2 * ez / (ez + sqrt(a2 + (1 - a2) * ez * ez));
    const double lit = 2 * z / (z + sqrt(a2 + (1 - a2) * z * z));
    return D * seen * lit / (4 * ez);
}

static double albedo(int model, double n, double eye)
{
    enum { ROWS = 600, COLUMNS = 1200 };
    double sum = 0;
    for (int i = 0; i < ROWS; i++)
        for (int k = 0; k < COLUMNS; k++) {
            const double theta = (i + 0.5) / ROWS * pi / 2;
            const double phi = (k + 0.5) / COLUMNS * pi; /* the other half is the same */
            sum += lobe(model, n, eye, sin(theta) * cos(phi), sin(theta) * sin(phi),
                        cos(theta)) *
                   sin(theta);
        }
    return 2 * sum * (pi / 2 / ROWS) * (pi / COLUMNS);
}

/* How far from the mirror's direction half of the maximum is left, in degrees. */
static double half_width(int model, double n)
{
    double low = 0, high = 60;
    for (int i = 0; i < 50; i++) {
        const double middle = (low + high) / 2, a = middle * pi / 180;
        const double now = lobe(model, n, 0, sin(a), 0, cos(a)) / cos(a);
        if (now > lobe(model, n, 0, 0, 0, 1) / 2)
            low = middle;
        else
            high = middle;
    }
    return low;
}

int main(void)
{
    static const struct {
        const char *name, *key;
        int model;
        double n;
    } rows[] = {{"Phong, n = 50", "phong", PHONG, 50},
                {"Blinn, n = 50", "blinn", BLINN, 50},
                {"Blinn, n = 10, with (n + 8)/8π", "eight", BLINN_8, 10},
                {"facets, n = 50", "sharp", GGX, 50},
                {"facets, n = 10", "middle", GGX, 10},
                {"facets, n = 2", "rough", GGX, 2}};
    static const double degrees[] = {0, 30, 60, 75, 85};
    printf("| the eye at | 0° | 30° | 60° | 75° | 85° |\n|---|---|---|---|---|---|\n");
    for (int r = 0; r < 6; r++) {
        printf("| %s |", rows[r].name);
        double value[5];
        for (int i = 0; i < 5; i++) {
            value[i] = albedo(rows[r].model, rows[r].n, degrees[i] * pi / 180);
            printf(" %.3f |", value[i]);
        }
        printf("\n%s-0: %.3f\n%s-60: %.3f\n", rows[r].key, value[0], rows[r].key,
               value[2]);
    }
    const int models[] = {PHONG, BLINN, GGX};
    const char *const names[] = {"phong", "blinn", "metal"};
    for (int i = 0; i < 3; i++)
        printf("%s-width: %.1f\n", names[i], half_width(models[i], 60));
    printf("lacquer-width: %.1f\nsharp-width: %.1f\n", half_width(GGX, 300),
           half_width(GGX, 2000));
}

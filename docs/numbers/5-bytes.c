/* Chapter 5, exercises 2 to 4: bytes for dark tones, a bright sample, the standard curve. */
#include "rt.h"
#include <stdio.h>

static int encode_srgb(float c)
{
    const double s = c <= 0.0031308f ? 12.92 * c : 1.055 * pow(c, 1 / 2.4) - 0.055;
    return (int)(255 * s + 0.5);
}

int main(void)
{
    for (int which = 0; which < 2; which++) {
        bool used[256] = {false};
        int count = 0;
        for (int i = 0; i <= 100000; i++)
            used[rt_encode(i / 1e6f, which ? 2.2 : 1)] = true;
        for (int i = 0; i < 256; i++)
            count += used[i];
        printf("%s: %d\n", which ? "with" : "without", count);
    }
    const int first = rt_encode(4, 2.2) / 4;
    printf("mean-first: %d\nbytes-first: %d\n", rt_encode(4.0f / 4, 2.2), first);
    printf("light: %.3f\n", pow(first / 255.0, 2.2));

    int most = 0;
    double at = 0;
    for (int i = 0; i <= 1000000; i++) {
        const int apart = abs(rt_encode(i / 1e6f, 2.2) - encode_srgb(i / 1e6f));
        if (apart > most) {
            most = apart;
            at = i / 1e6;
        }
    }
    printf("half: %d\nhalf-gamma: %d\n", encode_srgb(0.5f), rt_encode(0.5f, 2.2));
    printf("dark: %d\ndark-gamma: %d\n", encode_srgb(0.001f), rt_encode(0.001f, 2.2));
    printf("apart: %d\nwhere: %.4f\n", most, at);
}

/* Is what is told of a sample that sample? For tests that have a viewer. */
#ifndef EXPLAINED_H
#define EXPLAINED_H

#include <string.h>

enum { EXPLAINED = 200 }; /* pixels for each stage */

static rt_vec3 told_vec(const char *words)
{
    double x = 0, y = 0, z = 0;
    if (sscanf(strchr(words, '('), "(%lf, %lf, %lf)", &x, &y, &z) != 3)
        fail_msg("no three numbers in '%s'", words);
    return rt_vec((float)x, (float)y, (float)z);
}

static bool about(rt_vec3 a, rt_vec3 b)
{
    return rt_length(rt_sub(a, b)) <= 3e-5f * (1 + rt_length(a));
}

/* Sample 0 of this pixel of the picture, which has no more: what is told adds up to it, and nothing
 * is told of which there is nothing yet. True: a part comes from a function of the reader's own. */
static bool expect_explained(viewer *v, int x, int y)
{
    static char words[1 << 16];
    demo_text out = text_in(words, sizeof words);
    rt_vec3 value = {0, 0, 0}, sum = {0, 0, 0};
    const rt_vec3 shown = v->image.pixels[y * v->image.width + x];
    v->x = x;
    v->y = y;
    v->sample = 0;
    assert_int_equal(viewer_explain(v, &out, &value), RT_OK);
    for (const char *line = words; line; line = strchr(line, '\n')) {
        line += *line == '\n';
        if (strstr(line, " adds (") && strstr(line, " adds (") < strchr(line, '\n'))
            sum = rt_add(sum, told_vec(strstr(line, " adds (")));
        if (strncmp(line, "  = (", 5) == 0 && !about(told_vec(line), value))
            fail_msg("it is (%g, %g, %g), and not %s", (double)value.x, (double)value.y,
                     (double)value.z, line);
    }
    if (memcmp(&value, &shown, sizeof shown) != 0 || !about(sum, value))
        fail_msg("stage %d, pixel %d,%d: shown (%g, %g, %g), value (%g, %g, %g), points "
                 "(%g, %g, %g):\n%s",
                 v->stage, x, y, (double)shown.x, (double)shown.y, (double)shown.z,
                 (double)value.x, (double)value.y, (double)value.z, (double)sum.x,
                 (double)sum.y, (double)sum.z, words);
    const char *const too_early[] = {"lamp:", "seen, ", "hidden by", "behind", "mirror:"};
    const int from[] = {2, 4, 4, 2, 6};
    for (int i = 0; i < 5; i++)
        if (v->stage < from[i] && strstr(words, too_early[i]))
            fail_msg("stage %d knows no '%s':\n%s", v->stage, too_early[i], words);
    return strstr(words, "a function of your own") != NULL;
}

/* Some pixels of the stage; of how many of them a function of the reader's own brings a part. */
static int expect_stage_explained(viewer *v)
{
    rt_rng rng = rt_rng_start((uint32_t)v->stage, 0, 19);
    int own = 0;
    for (int i = 0; i < EXPLAINED; i++) {
        const int x = (int)(rt_random(&rng) * (float)v->image.width);
        const int y = (int)(rt_random(&rng) * (float)v->image.height);
        own += expect_explained(v, x, y);
    }
    return own;
}

#endif

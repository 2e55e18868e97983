/* The student's routines, asked by grade.c: cc -DSUBMISSION='"file.c"' pupil.c.
 *
 *     pupil NAME COUNT    reads COUNT inputs of the routine, answers them
 *
 * Numbers are floats as they are in memory, from channel 0 to channel 3. Nothing that this
 * program says is believed: it can only answer rightly or wrongly. */
#include SUBMISSION

#include "routines.h"

#include <stdlib.h>
#include <unistd.h>

/* All of it, in or out; false at the end or on an error. */
static bool move(bool in, int channel, char *bytes, size_t size)
{
    while (size > 0) {
        const ssize_t n = in ? read(channel, bytes, size) : write(channel, bytes, size);
        if (n <= 0)
            return false;
        bytes += n;
        size -= (size_t)n;
    }
    return true;
}

int main(int argc, char **argv)
{
    if (argc != 3)
        return 2;
    const size_t count = strtoul(argv[2], NULL, 10);
    for (int i = 0; i < ROUTINES; i++) {
        const routine *r = &routines[i];
        if (strcmp(r->name, argv[1]) != 0)
            continue;
        const size_t ins = (size_t)field_count(r->in), outs = (size_t)field_count(r->out);
        float *in = malloc(count * ins * sizeof *in);
        float *out = calloc(count * outs, sizeof *out);
        if (!in || !out || !move(true, 0, (char *)in, count * ins * sizeof *in))
            return 1;
        for (size_t k = 0; k < count; k++)
            r->call(in + k * ins, out + k * outs);
        return move(false, 3, (char *)out, count * outs * sizeof *out) ? 0 : 1;
    }
    return 2;
}

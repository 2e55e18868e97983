/* Text that is put together bit by bit in the caller's memory. What is too long is cut
 * off. */
#ifndef TEXT_H
#define TEXT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

typedef struct demo_text {
    char *at;
    size_t size, used; /* used < size: there is always a 0 at the end */
} demo_text;

/* For an array: demo_text t = text_in(array, sizeof array). */
static inline demo_text text_in(char *at, size_t size)
{
    at[0] = '\0';
    return (demo_text){at, size, 0};
}

/* Like printf, but adds to the text. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
static inline void
text_add(demo_text *t, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int n = vsnprintf(t->at + t->used, t->size - t->used, format, values);
    va_end(values);
    if (n > 0)
        t->used += (size_t)n < t->size - t->used ? (size_t)n : t->size - t->used - 1;
}

#endif

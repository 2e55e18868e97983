/* Text that is put together bit by bit, in memory of the caller's. What is too long is cut off. */
#ifndef TEXT_H
#define TEXT_H

#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

typedef struct text {
    char *at;
    size_t size, used; /* used < size: there is always a 0 at the end */
} text;

/* For an array: text t = text_in(array, sizeof array). */
static inline text text_in(char *at, size_t size)
{
    at[0] = '\0';
    return (text){at, size, 0};
}

/* As printf, after what there is. */
#ifdef __GNUC__
__attribute__((format(printf, 2, 3)))
#endif
static inline void
text_add(text *t, const char *format, ...)
{
    va_list values;
    va_start(values, format);
    const int n = vsnprintf(t->at + t->used, t->size - t->used, format, values);
    va_end(values);
    if (n > 0)
        t->used += (size_t)n < t->size - t->used ? (size_t)n : t->size - t->used - 1;
}

#endif

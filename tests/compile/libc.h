/* What rt.h and small programs use of the C library and of OpenMP 2.0, as the standards declare
 * it. "tests/check msvc" has this file as math.h, stdio.h and so on, since Visual Studio's own
 * headers are only where Visual Studio is. */
#ifndef LIBC_H
#define LIBC_H

#include <stddef.h>

#ifdef __cplusplus
extern "C" {
#endif

#define NAN __builtin_nanf("")
#define INFINITY __builtin_inff()
#define isnan(x) __builtin_isnan(x)
#define isinf(x) __builtin_isinf(x)
#define isfinite(x) __builtin_isfinite(x)
double fabs(double x), sqrt(double x), floor(double x), pow(double x, double y);
double exp(double x), fmin(double x, double y), fmax(double x, double y);
float fabsf(float x), sqrtf(float x), floorf(float x);
float fminf(float x, float y), fmaxf(float x, float y);

int memcmp(const void *a, const void *b, size_t size);
void *memcpy(void *to, const void *from, size_t size);
void *memset(void *to, int byte, size_t size);
void *malloc(size_t size), *calloc(size_t count, size_t size);
void free(void *memory);
void srand(unsigned seed);
int rand(void);

#define assert(condition) ((void)(condition))

#define CLOCKS_PER_SEC 1000 /* as Visual Studio has it */
typedef long clock_t;
clock_t clock(void);

typedef struct file FILE;
FILE *__acrt_iob_func(unsigned number); /* as Visual Studio has it */
#define stderr __acrt_iob_func(2)
FILE *fopen(const char *name, const char *mode);
int fclose(FILE *file), putc(int byte, FILE *file), printf(const char *format, ...);
int fprintf(FILE *file, const char *format, ...);
int vsnprintf(char *text, size_t size, const char *format, __builtin_va_list values);
void perror(const char *what);

#ifdef _OPENMP
typedef void *omp_lock_t;
void omp_init_lock(omp_lock_t *lock), omp_destroy_lock(omp_lock_t *lock);
void omp_set_lock(omp_lock_t *lock), omp_unset_lock(omp_lock_t *lock);
int omp_get_max_threads(void), omp_get_thread_num(void);
double omp_get_wtime(void);
#endif

#ifdef __cplusplus
}
#endif
#endif

/* What answers single rays: rt.h, or a library that it is compared with. See rays.c. */
#ifndef CANDIDATE_H
#define CANDIDATE_H
#include "../../rt.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct candidate {
    const char *name;
    /* Make ready for a scene of spheres, or of one mesh: all that is not work of the build. */
    void *(*open)(const rt_scene *scene, int threads);
    void (*build)(void *tree);
    size_t (*bytes)(
        void *tree); /* held after the build, without the arrays of the user */
    /* t of the nearest hit, INFINITY for none; 1 if there is any with t < 1, else INFINITY. */
    void (*nearest)(void *tree, const rt_ray *rays, int count, float *t);
    void (*blocked)(void *tree, const rt_ray *rays, int count, float *t);
    void (*close)(void *tree);
} candidate;

extern const candidate embree, embree_robust; /* embree.c */
extern const candidate tinybvh_wide;          /* tinybvh.cpp */

#ifdef __cplusplus
}
#endif
#endif

/* Parts of a picture as files, so that many machines can share its work, and one that was stopped
 * loses little. A file begins with lines of text that say what it is a part of, and then come its
 * floats, and a sum over all of it. */
#ifndef PARTS_H
#define PARTS_H

#include "../rt.h"
#include "text.h"

/* Make the image part k of n, 1 to n: it gets first and count. */
void parts_cut(rt_image *image, int k, int n);
/* The name of its file, beside the picture's: "build/demo08-part-3-of-60.part". Free it. */
char *parts_path(const char *picture, int k, int n);

/* How many pixels the image holds: all, or its part. */
size_t parts_pixels(const rt_image *image);

typedef struct parts_progress {
    int there;   /* how many files; -1 with more than 1000 parts, as it would take long */
    double left; /* seconds until all are there; 0: nobody can tell */
} parts_progress;

/* k is the part that was just written, and took the seconds for it; 0: none. The time left is
 * for parts that come as quickly as the last ones did, on all machines together. */
parts_progress parts_look(const char *picture, int k, int n, double took);

/* The lines that say which picture it is; parts with other lines are not joined. given is the sum of
 * what was read from files, the texture or the mesh. scene is parts_sum of the same picture in
 * small: it stands for the scene, the camera, and the code, and finds most changes of them, not
 * all. */
void parts_describe(demo_text *lines, const char *demo, const rt_options *options,
                    const rt_image *image, uint64_t given, uint64_t scene);
uint64_t parts_sum(const rt_image *image);
/* The sum so far, which begins with 0, with these bytes, too. */
uint64_t parts_add(uint64_t sum, const void *bytes, size_t size);

typedef enum parts_state {
    PART_WHOLE,
    PART_MISSING,
    PART_DAMAGED, /* it is this part, but not whole */
    PART_OTHER    /* it is something else, or cannot be read */
} parts_state;

/* Read a part's floats and rays into the memory of the image, whose first and count say which part
 * it must be. Unless it is whole, why says what is wrong. */
parts_state parts_read(const char *path, const char *lines, rt_image *part,
                       demo_text *why);
bool parts_write(const char *who, const char *path, const char *lines,
                 const rt_image *part);

#endif

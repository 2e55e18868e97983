/* Pictures as files, which are either kept as they were or replaced by whole new ones. Who is
 * the name of the program, for the message on stderr when something fails. */
#ifndef FILES_H
#define FILES_H

#include "../rt.h"

/* Can such a file be written? Said before the rendering, not after it. */
bool files_can_write(const char *who, const char *path);
/* PNG, of 3 bytes for each pixel; PFM, if the name ends in .pfm, of the pixels themselves. */
bool files_is_pfm(const char *path);
bool files_save_png(const char *who, const char *path, int width, int height,
                    const unsigned char *bytes);
bool files_save_pfm(const char *who, const char *path, int width, int height,
                    const rt_vec3 *pixels);
/* A PNG or JPEG as linear light, row by row from the top: to be freed. NULL: it was not to be
 * read. */
rt_vec3 *files_load(const char *who, const char *path, int *width, int *height);

#endif

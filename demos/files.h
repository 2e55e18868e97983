/* Pictures as files. A file is either kept as it was or replaced by a whole new one. who
 * is the name of the program, for the message on stderr when something fails. */
#ifndef FILES_H
#define FILES_H

#include "../rt.h"

/* Can this file be written? Asked before the rendering, not after it. */
bool files_can_write(const char *who, const char *path);
bool files_write(const char *who, const char *given, const void *bytes, size_t size);
/* PNG, from 3 bytes per pixel; PFM, if the name ends in .pfm, from the pixels
 * themselves. */
bool files_is_pfm(const char *path);
bool files_save_png(const char *who, const char *path, int width, int height,
                    const unsigned char *bytes);
bool files_save_pfm(const char *who, const char *path, int width, int height,
                    const rt_vec3 *pixels);
/* Read a PNG or JPEG as linear light, row by row from the top; free the result. NULL: it
 * could not be read. */
rt_vec3 *files_load(const char *who, const char *path, int *width, int *height);

#endif

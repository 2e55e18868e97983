/* Pictures as files, which are either kept as they were or replaced by whole new ones. Who is
 * the name of the program, for the message on stderr when something fails. */
#ifndef FILES_H
#define FILES_H

#include "../rt.h"

/* Can such a file be written? Said before the rendering, not after it. */
bool files_can_write(const char *who, const char *path);
/* As the name ends: .png, from bytes, 3 for each pixel; .pfm, from pixels. */
bool files_save(const char *who, const char *path, int width, int height,
                const unsigned char *bytes, const rt_vec3 *pixels);

#endif

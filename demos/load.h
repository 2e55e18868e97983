/* Meshes from files: OBJ, PLY, STL and glTF, which the library assimp reads, if it was there when this
 * was compiled. Who is the name of the program, for the message on stderr when something fails. */
#ifndef LOAD_H
#define LOAD_H

#include "../rt.h"

/* NULL, or what is missing, in words. */
const char *load_lacks(void);
/* All triangles of the file as one mesh, checked; its arrays are to be freed. False: there is none,
 * and one line has said why. */
bool load_mesh(const char *who, const char *path, rt_mesh *mesh);

#endif

/* Meshes from files: OBJ, PLY, STL and glTF, read by the library assimp, if it was there
 * when this was compiled. who is the name of the program, for the message on stderr when
 * something fails. */
#ifndef LOAD_H
#define LOAD_H

#include "../rt.h"

/* NULL, or what is missing, in words. */
const char *load_lacks(void);
/* Read all triangles of the file as one mesh, checked; free its arrays. False: there is
 * none, and one line has said why. */
bool load_mesh(const char *who, const char *path, rt_mesh *mesh);

#endif

/* mesh_picture.h - a mesh as a picture, with its size and what is open. */
#ifndef CLAST_COMMAND_MESH_PICTURE_H
#define CLAST_COMMAND_MESH_PICTURE_H

#include <stdbool.h>

#include "meshes/mesh.h"

typedef struct mesh_picture {
    const char *title;
    double from[3];    /* direction towards the eye, any length > 0 */
    int width, height; /* pixels */
} mesh_picture;

/* False with a message on standard error. */
bool mesh_draw(const mesh_picture *p, const mesh_surface *surface, const mesh_report *report,
               const char *path);

#endif

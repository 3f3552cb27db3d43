/* make.h: what the makers of shapes share. */
#ifndef CLAST_MESHES_MAKE_H
#define CLAST_MESHES_MAKE_H

#include "meshes/status.h"

/* Room for a surface; false with the failure filled in, and nothing allocated. */
bool mesh_allocate(mesh_surface *s, size_t vertices, size_t triangles);

/* Cosine and sine by series: libm's last bit depends on the processor, and a scene must not.
 * |angle| <= pi, rad. */
void mesh_direction(double angle, double *cosine, double *sine);

/* Writes one triangle, and returns where the next goes. */
int32_t *mesh_put(int32_t *to, int32_t a, int32_t b, int32_t c);

#endif

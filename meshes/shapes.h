/* shapes.h: meshes made from a few measures. All lengths in metres. */
#ifndef CLAST_MESHES_SHAPES_H
#define CLAST_MESHES_SHAPES_H

#include "meshes/mesh.h"

/* A vertical cylinder, open at the top, with a flat bottom at z = 0: what a silo shows to the
 * grains. It faces inwards. The corners lie on the radius, so flat sides are inside it by radius (1
 * - cos(pi / segments)). segments (2 bands + 1) triangles. */
typedef struct mesh_cylinder {
    double radius, height; /* m */
    int segments;          /* around, >= 3 */
    int bands;             /* rows of rectangles up the wall, >= 1 */
} mesh_cylinder;

MESH_MUST_CHECK mesh_status mesh_make_cylinder(const mesh_cylinder *shape, mesh_surface *surface);

/* A closed box around the origin, 12 triangles, facing outwards. */
MESH_MUST_CHECK mesh_status mesh_make_box(const double size[3], mesh_surface *surface);

#endif

/* lathe.h - triangles of a surface of revolution. */
#ifndef CLAST_SHAPES_LATHE_H
#define CLAST_SHAPES_LATHE_H

#include "shapes/mesh.h"

/* Turns `count` points (x, rho >= 0), from left to right over the top of the body, about the x
 * axis in `around` steps. Where the outline ends on the axis, or in its own beginning, the mesh is
 * closed; points on the axis become one vertex. */
shape_mesh shape_lathe(double (*at)[2], int count, int around);

#endif

/* solid_outline.h - what distance and drawing share about a solid: its outline in the half plane
 * through the axis, and the corners of a tetrahedron. */
#ifndef CLAST_SHAPES_SOLID_OUTLINE_H
#define CLAST_SHAPES_SOLID_OUTLINE_H

#include "shapes/solid.h"

enum { OUTLINE_ROOM = 6 };

/* Corners (x, rho) from left to right over the top; piece i leads from at[i] to at[i + 1]. Of
 * cylinder, cone, double cone, hyperboloid, barrel and disc. */
typedef struct shape_outline {
    int pieces;
    int curve; /* the piece that is one, else -1 */
    double at[OUTLINE_ROOM][2];
} shape_outline;

shape_outline shape_outline_of(const shape_solid *solid);

/* rho of the side of a hyperboloid or a barrel, and its slope. */
double shape_curve_height(const shape_solid *solid, double x, double *slope);

extern const int SHAPE_TETRAHEDRON_FACES[4][3];
void shape_tetrahedron_corners(double edge, shape_vec corner[4]);

#endif

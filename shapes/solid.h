/* solid.h - the thirteen particle shapes of S12 2.9.1, with closed forms for their mass.
 *
 * Every solid has its centre of mass at the origin. Those with an axis have it along x, the torus
 * along z, as in S12; a cone points to +x, a tetrahedron has its corners at every other corner of a
 * cube. `length` is that of the whole body, also of the double cone, where S12 has half of it.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012. Its closed forms are corrected where
 * quadrature shows them wrong (README.md). */
#ifndef CLAST_SHAPES_SOLID_H
#define CLAST_SHAPES_SOLID_H

#include "shapes/mass.h"
#include "shapes/mesh.h"

typedef enum shape_kind {
    SHAPE_SPHERE,         /* radius */
    SHAPE_ELLIPSOID,      /* half axes a, b, c along x, y, z */
    SHAPE_CYLINDER,       /* radius, length */
    SHAPE_CUBE,           /* edge */
    SHAPE_BLOCK,          /* length, height, width along x, y, z */
    SHAPE_PARALLELEPIPED, /* length, side: S12's special case, a block with two equal sides */
    SHAPE_TETRAHEDRON,    /* edge; regular */
    SHAPE_CONE,           /* radius, length */
    SHAPE_DOUBLE_CONE,    /* radius, length from tip to tip */
    SHAPE_HYPERBOLOID,    /* end_radius, waist_radius, length */
    SHAPE_BARREL,         /* end_radius, middle_radius, length; its side is a parabola */
    SHAPE_DISC,           /* outer_radius, inner_radius (0: no hole), thickness */
    SHAPE_TORUS,          /* tube_radius, ring_radius */
    SHAPE_KINDS
} shape_kind;

enum { SHAPE_SIZES = 3 };

typedef struct shape_solid {
    shape_kind kind;
    double size[SHAPE_SIZES]; /* m, in the order of the comments above */
} shape_solid;

typedef struct shape_solid_info {
    const char *name;               /* as scenes have it: "double-cone" */
    const char *sizes[SHAPE_SIZES]; /* "radius"; NULL behind the last */
    bool zero[SHAPE_SIZES];         /* may be 0 */
} shape_solid_info;

const shape_solid_info *shape_solid_info_of(shape_kind kind);

/* SHAPE_KINDS when there is no such name. */
shape_kind shape_kind_of(const char *name);

/* NULL, or what is wrong with the sizes: "tube_radius above ring_radius: it would cut itself". */
const char *shape_solid_fault(const shape_solid *solid);

/* Exact to rounding. */
shape_mass shape_solid_mass(const shape_solid *solid);

/* Distance (m) to the surface, negative inside. `nearest` is the nearest point of the surface,
 * `normal` the outward normal of the face that it lies in; both may be NULL. Of several points
 * alike, one. */
double shape_solid_distance(const shape_solid *solid, shape_vec point, shape_vec *nearest,
                            shape_vec *normal);

/* The surface as triangles with their corners on it, for drawing and for sampling; `fine` >= 1
 * multiplies their number along every curve. */
shape_mesh shape_solid_mesh(const shape_solid *solid, int fine);

#endif

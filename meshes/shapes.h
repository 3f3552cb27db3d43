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

/* A bar of a grate: 190 x 30 x 1000 mm in S12 Table 3.3, which prints none of its other measures.
 * Its profile lies in x and z and is the same along y. The origin is below its foremost point, in
 * the plane of the underside and half-way along y: it reaches from -length to 0 in x, from 0 to
 * height in z. Closed, convex, facing outwards. */
typedef struct mesh_bar {
    double length, height, width; /* m, > 0, along x, z, y */
    double nose_radius;           /* m, >= 0: rounding between top and front */
    double nose_angle; /* rad, -1 to 1: front against the direction of the height; above 0 it leans
                          back towards the underside, below 0 the foot is foremost */
    double undercut;   /* m, >= 0: the edge between front and underside is cut off so far above the
                          underside and so far along it */
    int segments; /* of the rounding, 1 to 1000: its corners lie on the circle, its sides inside
                     by nose_radius (1 - cos((pi/2 + nose_angle) / 2 segments)) */
} mesh_bar;

/* S12 Table 3.3, nose of 5 mm in 8 segments, front at right angles, no undercut. */
mesh_bar mesh_bar_default(void);
MESH_MUST_CHECK mesh_status mesh_make_bar(const mesh_bar *shape, mesh_surface *surface);

/* Where the flat sides of a pipe lie against the round one that they stand for. The error in the
 * radius falls with the square of the segments in each. */
typedef enum mesh_fit {
    MESH_FIT_AREA,   /* the same cross-section; corners outside, sides inside of the circle */
    MESH_FIT_INSIDE, /* corners on the circle, sides inside of it by radius (1 - cos(pi / segments))
                      */
    MESH_FIT_OUTSIDE /* sides touch the circle, corners are outside of it */
} mesh_fit;

/* A straight pipe, cylindrical or conical: the tube of S12 2.9.2. Without thickness a single
 * surface that faces inwards, open at both ends; with thickness a closed body, whose inner surface
 * is the same one. 2 segments triangles, or 8. */
typedef struct mesh_tube {
    double from[3], to[3];     /* m, centres of the ends; not the same */
    double radius, end_radius; /* m, inner, > 0, at `from` and at `to` */
    double thickness;          /* m, >= 0, across the axis */
    int segments;              /* around, >= 3 */
    mesh_fit fit;
} mesh_tube;

MESH_MUST_CHECK mesh_status mesh_make_tube(const mesh_tube *shape, mesh_surface *surface);

/* A pipe around an arc: the bend of S12 2.9.2. Surfaces as of the tube; over 2 pi it has no ends.
 * Along the arc, rings lie on it: the error falls with the square of their number too. 2 segments
 * rings triangles, or twice as many and 4 segments at the ends. */
typedef struct mesh_bend {
    double centre[3]; /* m, of the arc */
    double mouth[3];  /* m, centre of one end; its distance is the bending radius */
    double axis[3];   /* of the arc, any length > 0, at right angles to the way to the mouth */
    double angle;     /* rad, from the mouth, right-handed about the axis, above 0 to 2 pi */
    double radius;    /* m, inner, > 0; with the thickness less than the bending radius */
    double thickness; /* m, >= 0 */
    int segments;     /* around, >= 3 */
    int rings;        /* pieces along the arc, >= 1; over pi >= 2, over 2 pi >= 3 */
    mesh_fit fit;
} mesh_bend;

MESH_MUST_CHECK mesh_status mesh_make_bend(const mesh_bend *shape, mesh_surface *surface);

#endif

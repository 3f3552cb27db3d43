/* mass.h - volume, centre of mass and inertia at unit density; principal axes. */
#ifndef CLAST_SHAPES_MASS_H
#define CLAST_SHAPES_MASS_H

#include <stdbool.h>

#include "shapes/vec.h"

/* Of a body of density 1: multiply volume and inertia by the density. */
typedef struct shape_mass {
    double volume;        /* m3 */
    shape_vec centre;     /* m */
    double inertia[3][3]; /* m5, about the centre */
    double volume_bound;  /* the volume is off by no more, relative to itself */
    double inertia_bound; /* no entry is off by more, relative to the largest moment */
} shape_mass;

/* Integrals over a body of 1, x and x x about `about`: what every method here sums up. */
typedef struct shape_moments {
    shape_vec about;
    double volume;
    shape_vec first;
    double second[3][3];
} shape_moments;

/* `doubtful` (m3) is the volume that may have been left out or counted in wrongly, `reach` (m) how
 * far from `about` it lies at most. */
shape_mass shape_mass_of(const shape_moments *moments, double doubtful, double reach);

/* Adds a tensor s * (a b + b a) / 2. */
void shape_second_add(double second[3][3], double s, shape_vec a, shape_vec b);

typedef struct shape_frame {
    double axis[3][3]; /* rows: the principal axes as x, y, z of the body; a rotation */
    double moment[3];  /* m5, about them */
    double bound;      /* no moment and no product of inertia about them is off by more, relative
                          to the largest: that of the mass, and what was left out or made equal */
} shape_frame;

/* Principal axes, each taken as the axis of the body that it is nearest to. Products of inertia
 * below twice the mass's bound (or 1e-9, for masses that state less) are left out, so that an
 * aligned body is not turned at all, and moments that agree within it are made equal; how much that
 * was is in the bound of the frame. */
shape_frame shape_principal(const shape_mass *mass);

/* The spheres as seen from the frame with its origin at `centre`. */
void shape_to_frame(const shape_frame *frame, shape_vec centre, shape_sphere *spheres, int count);

/* A point as seen from the frame. */
shape_vec shape_point_to_frame(const shape_frame *frame, shape_vec centre, shape_vec point);

/* ---- overlapping spheres ----------------------------------------------------------------------
 */

/* Of the union of `count` >= 1 spheres that may overlap, touch, or lie in each other.
 *
 * Centres on one line: the body is axisymmetric and cut by the radical planes into zones of
 * spheres, whose moments are polynomials: exact to rounding.
 *
 * Otherwise by the divergence theorem over the exposed part of every sphere, which is bounded by
 * arcs of circles: volume, first and second moments become sums over arcs in closed form. To keep
 * arcs from coinciding, spheres are moved and grown at random by up to 1e-11 of the largest radius;
 * what that can change is bounded (the symmetric difference of the two unions lies within twice
 * that distance of the spheres) and is, with the rounding of each arc, the bound that comes back.
 * O(n k^2) for spheres that overlap k others. */
shape_mass shape_union_mass(const shape_sphere *spheres, int count);

/* The second method whatever the centres, for tests of the one against the other. */
shape_mass shape_union_mass_by_arcs(const shape_sphere *spheres, int count);

#endif

/* union.h - between the two methods of shape_union_mass(). */
#ifndef CLAST_SHAPES_UNION_H
#define CLAST_SHAPES_UNION_H

#include "shapes/mass.h"

/* Radius about `from` that holds all spheres. */
double shape_spheres_reach(const shape_sphere *spheres, int count, shape_vec from);

/* Sum of all surfaces, hidden parts too, of spheres grown by `more` (m). */
double shape_spheres_area(const shape_sphere *spheres, int count, double more);

/* A malloc'ed copy without the spheres that lie inside another one. */
shape_sphere *shape_spheres_that_count(const shape_sphere *spheres, int count, int *kept);

/* union_arcs.c: spheres of which none lies inside another. */
shape_mass shape_arcs_mass(const shape_sphere *spheres, int count);

#endif

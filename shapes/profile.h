/* profile.h - axisymmetric bodies from their profile, and A00's way to put spheres on it.
 *
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_SHAPES_PROFILE_H
#define CLAST_SHAPES_PROFILE_H

#include "shapes/mass.h"
#include "shapes/mesh.h"

/* Points (x, rho) of the outline from left to right, x rising, rho >= 0; the first and the last lie
 * on the axis. Where two pieces meet at less than 30 degrees the outline is taken as a smooth
 * curve, and its normal turns evenly along a piece. */
typedef struct shape_profile {
    int count;
    double (*at)[2];     /* m */
    double (*normal)[4]; /* of each piece: at its beginning (x, rho) and at its end */
} shape_profile;

enum { SHAPE_PROFILE_MAX = 20000 };

/* NULL, or what is wrong with point *which (from 0). Ends off the axis are allowed: they get a flat
 * end. */
const char *shape_profile_fault(double (*at)[2], int count, int *which);

/* Of `count` points without faults; shape_profile_free() it. */
shape_profile shape_profile_new(double (*at)[2], int count);

/* Of a function rho(x) on [from, to], at `points` places that lie closer towards the ends, where
 * round bodies are steep. */
shape_profile shape_profile_of(double height(const void *context, double x), const void *context,
                               double from, double to, int points);
void shape_profile_free(shape_profile *profile);

shape_mass shape_profile_mass(const shape_profile *profile);
double shape_profile_distance(const shape_profile *profile, shape_vec p, shape_vec *nearest,
                              shape_vec *normal);
shape_mesh shape_profile_mesh(const shape_profile *profile);

/* Spheres on the axis by A00 2.2.2: the outline is cut by `count` points into chords of equal
 * length, and every point carries the sphere that touches the outline there (A00 2.3). Returns how
 * many there are: fewer than `count` where the outline at a point is a flat end, which no sphere on
 * the axis touches. */
int shape_profile_fit(const shape_profile *profile, int count, shape_sphere *spheres);

#endif

/* symmetry.h - rotations and reflections that leave a target as it is: spheres are placed in whole
 * orbits, so that a clump has the symmetry, the centre and the axes of what it stands for. */
#ifndef CLAST_SHAPES_SYMMETRY_H
#define CLAST_SHAPES_SYMMETRY_H

#include "shapes/target.h"

enum { SYMMETRY_ROOM = 64, SYMMETRY_RINGS = 5 };

typedef struct shape_symmetry {
    int count; /* >= 1: the identity comes first */
    int ring;  /* spheres in a ring, of targets of revolution */
    double matrix[SYMMETRY_ROOM][3][3];
} shape_symmetry;

/* Targets of revolution have one group for each number of spheres in a ring (4, 6, 8, 16, 32);
 * `ring` counts them from 0. Returns false past the last. */
bool shape_symmetry_of(const shape_target *target, int ring, shape_symmetry *symmetry);

/* What all of these groups have in common: every clump of whole orbits has it too. */
void shape_common_symmetry(const shape_target *target, shape_symmetry *symmetry);

/* One part in `count` of space, whose images under the symmetry fill all of it. */
bool shape_in_first_part(shape_symmetry *symmetry, shape_vec p);

/* True for targets of revolution; *axis is then 0, 1 or 2. */
bool shape_has_axis(const shape_target *target, int *axis);

shape_vec shape_image(double matrix[3][3], shape_vec p);

#endif

/* quality.h - how well a clump stands for its target, and what it costs.
 *
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_SHAPES_QUALITY_H
#define CLAST_SHAPES_QUALITY_H

#include "shapes/target.h"

typedef struct shape_quality {
    double deviation_mean; /* m, of the surface of the target from the clump */
    double deviation_max;  /* m, by shape_deviation_max() */
    double protrusion;     /* m, by which the clump sticks out of the target */
    /* rad: a sphere as large as the smallest of the clump comes down on the clump along the normal
     * of the target; by how much the normal of the contact differs (A00 3.8, for any clump) */
    double normal_max;
    double normal_95; /* on 95 % of the surface it is less */
    double friction;  /* tan(normal_95 / 2): mean slope that a body has to climb out of a hollow
                         whose walls are so steep; A00 Appendix E has 0.02 for 2.31 degrees */
    double contacts;  /* expected number of sub-contacts of two such clumps that meet in any
                         orientation, once they overlap by 1 % of the radius of a sphere of the same
                         volume: what a step costs, for a sphere 1 */
    double pairs;     /* expected number of their pairs in the list of neighbours, at 10 % of it */
    double step;      /* critical step over that of a sphere of the same volume: the smallest
                         sphere's radius over that sphere's */
    double cost;      /* of a simulated second: contacts / step; a sphere costs 1 */
} shape_quality;

/* Spheres in the frame of the target. */
shape_quality shape_quality_of(const shape_target *target, const shape_sphere *spheres, int count);

/* A00 3.16-3.22: two neighbouring spheres of a row, r1 <= r2, their distance, and a sphere of
 * radius rs that touches both: deviation (rad) of either contact from the normal of the straight
 * line that touches both. False when the sphere falls through between them, or one lies in the
 * other. */
bool shape_row_deviation(double r1, double r2, double distance, double rs, double deviation[2]);

#endif

/* numbers.h - elementary functions whose bits do not depend on the machine: a scene builds its
 * clumps when it is loaded, and glibc picks variants of sin and atan by processor. Only sqrt, which
 * is correctly rounded, is taken from there. */
#ifndef CLAST_SHAPES_NUMBERS_H
#define CLAST_SHAPES_NUMBERS_H

#include <stdint.h>

#define SHAPE_PI 3.14159265358979323846

/* Angle of (x, y) in (-pi, pi], to a few units in the last place; 0 at the origin. */
double shape_atan2(double y, double x);

/* Of x in [-1, 1]; beyond that by rounding: as at the end. */
double shape_acos(double x);
double shape_asin(double x);

/* |angle| <= 1e4 rad. */
void shape_sincos(double angle, double *sine, double *cosine);

/* Uniform in [0, 1): a pure function of its place in a stream. */
double shape_random(uint64_t stream, uint64_t place);

/* Fraction of the golden and the plastic number: point `i` of a sequence that fills the line, the
 * square (k = 0, 1 of 2) or the cube (k = 0, 1, 2 of 3) evenly. */
double shape_even(int dimensions, int k, uint64_t i);

#endif

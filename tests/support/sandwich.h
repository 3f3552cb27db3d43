/* sandwich.h - a ball pressed between two planes so that it never leaves either: with the linear
 * law a damped harmonic oscillator, whatever the scheme (S12 3.9.1 with both contacts closed). */
#ifndef CLAST_TESTS_SANDWICH_H
#define CLAST_TESTS_SANDWICH_H

#include "tests/support/scene.h"

typedef struct sandwich {
    clast_law law;
    clast_scheme scheme;
    double restitution; /* 0 reads as 1 */
    double step;        /* omega dt */
    double x, v;        /* m, m/s, at the start, from the middle */
    double press;       /* of the radius, overlap with each plane at rest; 0 reads as 0.1 */
    double max_overlap; /* 0 reads as 0.5 */
    clast_guard_mode guards;
} sandwich;

typedef struct oscillator {
    clast_world *world;
    double omega, zeta; /* rad/s; damping ratio: of the linear law */
    double radius, mass;
} oscillator;

oscillator sandwich_new(const sandwich *s);

/* Where the ball is, from the middle. */
double sandwich_position(const oscillator *o);
double sandwich_velocity(const oscillator *o);

/* The solution for the linear law. */
double sandwich_exact(const oscillator *o, const sandwich *s, double time, double *velocity);

#endif

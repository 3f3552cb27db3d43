/* amplification.h - what a time stepping scheme does to a linear spring-dashpot, exactly.
 *
 * A contact that stays closed, x'' = -w0^2 x - 2 z w0 x', turns every scheme of the engine into a
 * matrix: the state of the next step is the matrix times the state of this one. Its largest
 * eigenvalue says whether an error dies out or grows, and how fast. Everything depends on two pure
 * numbers:
 *
 *     step     h = w0 dt; an undamped contact lasts pi / h steps
 *     damping  z = c / (2 sqrt(k m)), the damping ratio
 *
 * The matrices are written down here from the printed equations of S12 (sections 2.7 and 3.3), not
 * from the engine's table of schemes, so that the two check each other.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012. */
#ifndef CLAST_THEORY_AMPLIFICATION_H
#define CLAST_THEORY_AMPLIFICATION_H

#include <stdbool.h>

#include "engine/clast.h"

enum {
    SCHEME_SIZE_MAX = 16,  /* numbers in the state of a scheme: four per step that it remembers */
    SCHEME_RANGES_MAX = 8, /* more pieces than any of the schemes has */
    SCHEME_COUNT = CLAST_SCHEME_NUMEROV_CENTRAL + 1
};

/* The equations of S12 that the matrix is made of. */
const char *scheme_source(clast_scheme scheme);

/* The state: position, velocity times dt, elastic and dashpot part of the acceleration times dt^2;
 * then the same of the step before, as far back as the scheme looks. Returns its size. */
int scheme_size(clast_scheme scheme);

/* matrix: size x size, row by row. step > 0; damping >= 0. */
void scheme_matrix(clast_scheme scheme, double step, double damping, double *matrix);

/* Largest magnitude of the eigenvalues: the factor of growth per step. */
double scheme_growth(clast_scheme scheme, double step, double damping);

/* The eigenvalue that stands for the motion itself: the one nearest to exp(h (-z + i sqrt(1-z^2))).
 * Its distance from that falls as h^(order + 1). damping < 1. */
typedef struct scheme_motion {
    double decay,
        angle;    /* magnitude; rad per step: where the exact motion turns by h sqrt(1-z^2) */
    double error; /* the distance */
} scheme_motion;
scheme_motion scheme_motion_of(clast_scheme scheme, double step, double damping);

/* Steps h at which no error grows, as ranges in rising order; a range may begin at 0 and end at
 * INFINITY. Looked for up to h = 100 at distances of one per cent, then bisected to 1e-10: a
 * narrower gap is missed. Without damping the sign of the growth at h = 0.05 is taken to hold below
 * it (it is a power of h there); with damping, schemes are stable near zero because they are
 * consistent. damping must be 0 or at least 1e-4, below which growth is not told from rounding.
 * Returns their number, at most SCHEME_RANGES_MAX. */
typedef struct scheme_range {
    double from, to;
} scheme_range;
int scheme_ranges(clast_scheme scheme, double damping, scheme_range ranges[SCHEME_RANGES_MAX]);

/* The end of the range that begins at 0: the limit of the step. 0 when every step is too large,
 * INFINITY when none is. */
double scheme_limit(clast_scheme scheme, double damping);

/* Steps until an error has grown by the factor `ratio` > 1; INFINITY when it does not grow. */
double scheme_steps_to_grow(clast_scheme scheme, double step, double damping, double ratio);

/* The state of an exact free oscillation (damping < 1) that passes position x at velocity v at the
 * latest step, with the steps before it as far back as the scheme looks. x in any unit, v in that
 * unit per dt. The accelerations are those that the exact motion has. */
void scheme_start(clast_scheme scheme, double step, double damping, double x, double v,
                  double state[SCHEME_SIZE_MAX]);

/* One step by the matrix; state[0] is the position, state[1] the velocity times dt. */
void scheme_advance(clast_scheme scheme, const double *matrix, double state[SCHEME_SIZE_MAX]);

#endif

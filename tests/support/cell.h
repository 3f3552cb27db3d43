/* cell.h - bodies of several shapes in a domain that repeats itself, on a grid of exact numbers:
 * all coordinates are between 1 and 2 m and the lengths are powers of two, so that a way around the
 * cell does not round. */
#ifndef CLAST_TESTS_CELL_H
#define CLAST_TESTS_CELL_H

#include "tests/support/scene.h"

#define CELL_LOW    1.25   /* m, lowest corner of the domain */
#define CELL_LENGTH 0.0625 /* m */

typedef struct cell_wish {
    bool periodic[3];
    clast_vec3 shift; /* m, of everything that moves; multiples of 2^-40 m */
    int doubled;      /* 1, 2, 3: twice the length along x, y, z, with every body twice; 0: not */
    bool spheres;     /* alone; else clumps among them */
    bool no_plates;
    clast_law law;
    clast_scheme scheme;
    clast_clump_contact clump_contact;
    clast_precision precision;
    clast_isa isa;
    clast_motion motion;
    int threads;
    double skin; /* m; 0: default */
} cell_wish;

enum { CELL_BODIES = 27 };

/* NULL never comes back: a cell that cannot be made stops the program. */
clast_world *cell_new(const cell_wish *wish);

uint64_t cell_hash(const cell_wish *wish, uint64_t steps);

#endif

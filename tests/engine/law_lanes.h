/* law_lanes.h - the copies of the law that law_lanes.c compares. */
#ifndef CLAST_TESTS_LAW_LANES_H
#define CLAST_TESTS_LAW_LANES_H

#include "engine/contact_law.h"

enum { NEEDS = 24, EQUAL = 16 }; /* from EQUAL on: equal spheres */

/* What runs around the law: kinds of worlds that need it. */
enum { YIELDS = 1, ROLLS = 2, VISCOELASTIC = 4, MAW = 8, HOOKE = 16, AROUNDS = 6 };

/* A batch with its histories: overlap, normal force, spring, plastic overlap. */
typedef struct lanes {
    batch b;
    real history[HISTORY_COLUMNS][LANES];
} lanes;

static inline law_need need_of(int k) {
    return (law_need){(k & 1) != 0, (k & 2) != 0, (k & 4) != 0, (k & 8) != 0, k >= EQUAL};
}

/* Geometry and law over the first `count` lanes; need: bits as in need_of(). */
typedef void law_run(lanes *l, int count, law_choice choice, int need, int around);
law_run law_run_scalar, law_run_baseline, law_run_avx2, law_run_avx512;

#endif

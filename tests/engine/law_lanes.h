/* law_lanes.h - the copies of the law that law_lanes.c compares. */
#ifndef CLAST_TESTS_LAW_LANES_H
#define CLAST_TESTS_LAW_LANES_H

#include "engine/contact_law.h"

typedef void law_run(batch *b, law_choice choice, double dt);
law_run law_run_scalar, law_run_baseline, law_run_avx2, law_run_avx512;

#endif

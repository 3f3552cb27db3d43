/* bed.h - a small bed with everything in it, for tests of determinism and threads: clumps of
 * several sizes, friction, a moving wall, a belt, a part that is removed, bodies that leave. */
#ifndef CLAST_TESTS_BED_H
#define CLAST_TESTS_BED_H

#include "engine/clast.h"

typedef struct bed_wish {
    int threads;
    double skin; /* m; 0 = default */
    bool alone;  /* among several processes */
    clast_isa isa;
    clast_law law;
    clast_motion motion;
    int bodies; /* 0 reads as 63 */
    double rolling;
    clast_tangent tangent;
    clast_clump_contact clump_contact;
    clast_precision precision;
    clast_scheme scheme;
} bed_wish;

/* NULL never comes back: a bed that cannot be made stops the program. */
clast_world *bed_new(const bed_wish *wish);

/* Hash after that many steps; stops the program when the run fails. */
uint64_t bed_hash(const bed_wish *wish, uint64_t steps);

#endif

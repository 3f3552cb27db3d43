/* side.h - independent pieces of work on all cores, each core with a process of its own. */
#ifndef CLAST_PARTICLE_CHECKS_SIDE_H
#define CLAST_PARTICLE_CHECKS_SIDE_H

#include <stddef.h>

/* Fills one result; keeps nothing, writes nothing else. */
typedef void side_work(int index, const void *context, void *result);

/* work(i, context, the i-th of `results`) for i = 0 ... count - 1, on jobs_processes() processes.
 * `size`: bytes of a result, which holds no pointer. Results do not depend on the number of
 * processes. Exits with code 4 when a piece fails. */
void side_by_side(int count, side_work *work, const void *context, void *results, size_t size);

#endif

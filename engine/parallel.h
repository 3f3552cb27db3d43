/* parallel.h - the one parallel primitive. Only parallel.c knows OpenMP. */
#ifndef CLAST_PARALLEL_H
#define CLAST_PARALLEL_H

#include <stddef.h>

/* Works on items [begin, end); `thread` is in [0, threads). */
typedef void parallel_body(void *context, size_t begin, size_t end, int thread);

/* Cuts [0, count) into one contiguous range per thread. What a range computes must not depend on
 * where it is cut: that is what makes results independent of the number of threads. */
void parallel_for(int threads, size_t count, parallel_body *body, void *context);

int parallel_max_threads(void);

#endif

/* parallel.h - the one parallel primitive. Only parallel.c knows how threads are made. */
#ifndef CLAST_PARALLEL_H
#define CLAST_PARALLEL_H

/* The work of one thread in [0, threads). What the threads compute together must not depend on
 * how many there are. */
typedef void parallel_body(void *context, int thread);

void parallel_run(int threads, parallel_body *body, void *context);

int parallel_max_threads(void);

#endif

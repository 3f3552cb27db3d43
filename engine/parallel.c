#include "engine/parallel.h"

#include "engine/check.h"

#ifdef _OPENMP
#include <omp.h>
#endif

int parallel_max_threads(void) {
#ifdef _OPENMP
    return omp_get_num_procs();
#else
    return 1;
#endif
}

/* The run time may give fewer threads than asked for: then some of them work twice. */
void parallel_run(int threads, parallel_body *body, void *context) {
    CLAST_ASSERT(threads >= 1);
#ifdef _OPENMP
    if (threads > 1) {
#pragma omp parallel num_threads(threads)
        for (int t = omp_get_thread_num(); t < threads; t += omp_get_num_threads())
            body(context, t);
        return;
    }
#endif
    for (int t = 0; t < threads; t++) body(context, t);
}

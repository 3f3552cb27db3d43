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

void parallel_for(int threads, size_t count, parallel_body *body, void *context) {
    CLAST_ASSERT(threads >= 1);
#ifdef _OPENMP
    if (threads > 1) {
#pragma omp parallel num_threads(threads)
        {
            size_t t = (size_t)omp_get_thread_num(), n = (size_t)omp_get_num_threads();
            size_t begin = count * t / n, end = count * (t + 1) / n;
            if (begin < end) body(context, begin, end, (int)t);
        }
        return;
    }
#endif
    if (count > 0) body(context, 0, count, 0);
}

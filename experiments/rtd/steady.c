/* steady.c - where the start-up ends.
 *
 * MSER-5: values are averaged in batches of five, and as many leading batches are dropped as make
 * the standard error of the mean of the rest smallest (K. P. White, An effective truncation
 * heuristic for bias reduction in simulation output, Simulation 69, 1997, 323-334; K. P. White, M.
 * J. Cobb and S. C. Spratt, A comparison of five steady-state truncation heuristics, Winter
 * Simulation Conference 2000). Only the first half is searched: at the end a few batches are alike
 * by chance. A minimum at the far edge of it (beyond 0.45 of the record) is what a drift without an
 * end gives: the record is too short, and the rule has no answer.
 */
#include "experiments/rtd/rtd.h"

#include <math.h>
#include <stdlib.h>

#include "engine/check.h"

enum { BATCH = 5 };

long mser5(const double *x, size_t n) {
    CLAST_ASSERT(x && n >= 2 * BATCH);
    long batches = (long)(n / BATCH), best = -1;
    double sum = 0, squares = 0, least = INFINITY, *mean = calloc((size_t)batches, sizeof *mean);
    CLAST_ASSERT(mean);
    for (long i = 0; i < batches; i++)
        for (int k = 0; k < BATCH; k++) mean[i] += x[i * BATCH + k] / BATCH;
    /* from the back: no sum is taken apart again */
    double shift = mean[batches - 1];
    for (long i = batches - 1; i >= 0; i--) {
        double y = mean[i] - shift;
        sum += y, squares += y * y;
        double left = (double)(batches - i), error = (squares - sum * sum / left) / (left * left);
        if (2 * i <= batches && error <= least) least = error, best = i;
    }
    free(mean);
    return (double)best <= 0.45 * (double)batches ? best * BATCH : -1;
}

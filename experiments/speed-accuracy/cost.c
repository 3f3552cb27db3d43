/* cost.c - processor time of work that is too short to be timed once. */
#include <math.h>
#include <time.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "engine/check.h"
#include "experiments/speed-accuracy/chart.h"

double processor_seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

chart_cost cost_of(double *samples, int n) {
    CLAST_ASSERT(n >= 0 && (samples || n == 0));
    size_t kept = 0;
    for (int i = 0; i < n; i++)
        if (isfinite(samples[i])) samples[kept++] = samples[i];
    if (kept == 0) return (chart_cost){NAN, NAN, NAN};
    gsl_sort(samples, 1, kept);
    return (chart_cost){gsl_stats_quantile_from_sorted_data(samples, 1, kept, 0.5),
                        gsl_stats_quantile_from_sorted_data(samples, 1, kept, 0.25),
                        gsl_stats_quantile_from_sorted_data(samples, 1, kept, 0.75)};
}

chart_cost cost_measure(work_pass *pass, const void *what, double least, double *evaluations) {
    CLAST_ASSERT(pass && least >= 0 && evaluations);
    double samples[COST_BATCHES];
    int passes = 0, batches = least > 0 ? COST_BATCHES : 1;
    for (int k = 0; k < batches; k++) {
        work_done batch = {0, 0, 0};
        do {
            work_done one = pass(what, passes++);
            batch.seconds += one.seconds;
            batch.simulated += one.simulated;
            if (passes == 1) *evaluations = one.evaluations / one.simulated; /* all are alike */
        } while (batch.seconds < least / COST_BATCHES);
        samples[k] = batch.seconds / batch.simulated;
    }
    return cost_of(samples, least > 0 ? batches : 0);
}

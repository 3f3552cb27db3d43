#include "experiments/speed-accuracy/front.h"

#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/study/statistics.h"

typedef struct entry {
    double cost, error;
    int index;
} entry;

/* By cost, then by error, then in the order given. */
static int compare_entries(const void *left, const void *right) {
    const entry *a = left, *b = right;
    if (a->cost != b->cost) return a->cost < b->cost ? -1 : 1;
    if (a->error != b->error) return a->error < b->error ? -1 : 1;
    return a->index - b->index;
}

void pareto_front(const double *cost, const double *error, int n, bool *on_front) {
    CLAST_ASSERT(n >= 0 && ((cost && error && on_front) || n == 0));
    entry *entries = calloc((size_t)n + 1, sizeof *entries);
    CLAST_ASSERT(entries);
    int count = 0;
    for (int i = 0; i < n; i++) {
        on_front[i] = false;
        if (isfinite(cost[i]) && isfinite(error[i]))
            entries[count++] = (entry){cost[i], error[i], i};
    }
    qsort(entries, (size_t)count, sizeof *entries, compare_entries);
    double best = INFINITY;
    for (int k = 0; k < count; k++) {
        if (entries[k].error >= best) continue;
        best = entries[k].error;
        on_front[entries[k].index] = true;
    }
    free(entries);
}

double front_order(const double *cost, const double *error, const bool *use, int n) {
    CLAST_ASSERT(n >= 0 && ((cost && error && use) || n == 0));
    double *x = calloc(2 * (size_t)n + 1, sizeof *x), *y = x + n;
    CLAST_ASSERT(x);
    int count = 0;
    for (int i = 0; i < n; i++) {
        if (!use[i]) continue;
        CLAST_ASSERT(cost[i] > 0 && error[i] > 0);
        x[count] = log(cost[i]), y[count++] = -log(error[i]);
    }
    double slope = count < 3 ? NAN : line_fit(x, y, count).slope;
    free(x);
    return slope;
}

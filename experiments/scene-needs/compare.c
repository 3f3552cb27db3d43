/* compare.c - runs with and without a feature, pair by pair of the same seed. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/scene-needs/study.h"
#include "experiments/tune/paired.h"

/* ---- one variant ----------------------------------------------------------------------------- */

static void read_run(const job *j, const needs_observable *o, double *value, double *cost) {
    char why[RESULTS_ERROR_MAX];
    char *path = path_in(j->folder, FILE_SERIES);
    csv *series = csv_read(path, why);
    free(path);
    if (!series) {
        fprintf(stderr, "%s\n", why);
        exit(4);
    }
    const double *time = csv_column(series, "time_s");
    *value = o->read(series);
    if (time && series->rows > 1)
        *cost = jobs_processor_time(j) / (time[series->rows - 1] - time[0]);
    csv_free(series);
}

needs_values needs_read_values(const needs_runs *r, int observable, int variant) {
    const needs_observable *o = &r->scene->observable[observable];
    double layers = variant > 0 ? r->scene->without[variant - 1].layers : 0;
    needs_values v;
    for (int k = 0; k < r->replicates; k++) {
        const job *j = &r->jobs[o->leg][k * r->variants + variant];
        v.value[k] = v.cost[k] = NAN;
        if (j->done) read_run(j, o, &v.value[k], &v.cost[k]);
        if (o->rate && layers > 0) v.value[k] *= layers;
    }
    return v;
}

/* ---- against the scene as it stands ---------------------------------------------------------- */

static interval cost_ratio(const needs_values *with, const needs_values *without, int count) {
    double ratio[REPLICATES_MAX];
    int n = 0;
    for (int k = 0; k < count; k++) {
        double one = without->cost[k] / with->cost[k];
        if (isfinite(one)) ratio[n++] = one;
    }
    return mean_interval(ratio, n);
}

need needs_compare(const needs_runs *r, int observable, int variant) {
    CLAST_ASSERT(variant > 0 && variant < r->variants && observable < r->scene->observables);
    const needs_switch *off = &r->scene->without[variant - 1];
    needs_values with = needs_read_values(r, observable, 0);
    needs_values without = needs_read_values(r, observable, variant);
    paired p = paired_compare(with.value, without.value, r->replicates, 0.05);
    interval cost = cost_ratio(&with, &without, r->replicates);
    need n = {.feature = off->feature,
              .error = p.difference,
              .error_low = p.difference - p.half,
              .error_high = p.difference + p.half,
              .cost = cost.mean,
              .cost_half = cost.half,
              .replicates = p.n - p.lost,
              .lost = p.lost};
    snprintf(n.study, NEED_TEXT, "%s", r->scene->name);
    snprintf(n.observable, NEED_TEXT, "%s", r->scene->observable[observable].name);
    snprintf(n.without, NEED_TEXT, "%s", off->without);
    return n;
}

interval needs_difference(const needs_runs *r, int observable, int variant) {
    needs_values with = needs_read_values(r, observable, 0);
    needs_values without = needs_read_values(r, observable, variant);
    double mean = mean_interval(with.value, r->replicates).mean, difference[REPLICATES_MAX];
    for (int k = 0; k < r->replicates; k++)
        difference[k] = 100 * (without.value[k] - with.value[k]) / fabs(mean);
    return mean_interval(difference, r->replicates);
}

/* compare.c - one group of tracks against another, and how the tracks of a group part. */
#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "experiments/pool-ball-piston/piston.h"

/* ---- permutation test ------------------------------------------------------------------------ */

typedef struct means {
    track a, b;
} means;

static double distance_of_means(const track *const *all, int na, int nb, means *m) {
    track_mean(all, na, &m->a);
    track_mean(all + na, nb, &m->b);
    return track_distance(&m->a, &m->b);
}

double permutation_p(const track *const *a, int na, const track *const *b, int nb, int trials,
                     unsigned long seed) {
    const track *all[2 * REPLICATES_MAX];
    means *m = malloc(sizeof *m);
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    if (!m) abort();
    gsl_rng_set(g, seed);
    for (int i = 0; i < na; i++) all[i] = a[i];
    for (int i = 0; i < nb; i++) all[na + i] = b[i];
    double seen = distance_of_means(all, na, nb, m);
    int as_far = 0;
    for (int i = 0; i < trials; i++) {
        gsl_ran_shuffle(g, all, (size_t)(na + nb), sizeof *all);
        as_far += distance_of_means(all, na, nb, m) >= seen * (1 - 1e-12);
    }
    gsl_rng_free(g);
    free(m);
    return (1.0 + as_far) / (1.0 + trials);
}

/* ---- growth ---------------------------------------------------------------------------------- */

/* The exponential part: from the least spread to where it is a tenth of the particles' size; after
 * that it cannot grow as it did. */
growth growth_of(const group *g) {
    static const double LARGE = 0.1 * 0.0722; /* m */
    double time[TRACK_POINTS], spread[TRACK_POINTS];
    int least = 0, end = 0;
    for (int k = 0; k < TRACK_POINTS; k++) {
        time[k] = k * TRACK_S;
        spread[k] = track_spread(g->list, g->replicates, k);
        if (spread[k] < spread[least]) least = k;
    }
    for (end = least; end < TRACK_POINTS && spread[end] < LARGE; end++) {
    }
    growth r = {.errors = g->def->errors,
                .first = spread[0],
                .last = spread[TRACK_POINTS - 1],
                .rate = NAN,
                .rate_half = NAN,
                .from = time[least],
                .to = end > least ? time[end - 1] : time[least]};
    if (end - least < LINEAR_PART_SAMPLES || !(spread[least] > 0)) return r;
    for (int k = least; k < end; k++) spread[k] = log(spread[k]);
    fitted_line line = line_fit(time + least, spread + least, end - least);
    r.rate = line.slope;
    r.rate_half = 1.96 * line.slope_error;
    return r;
}

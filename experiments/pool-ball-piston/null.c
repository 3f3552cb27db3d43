/* null.c - what the agreement score is worth: its distribution when there is nothing to disagree
 * about.
 *
 * The interval of A00 4.2 is made for the mean of the ensemble, not for one more experiment: a new
 * draw x lies within it when |x - mean| / (sd sqrt(1 + 1/n)) <= 1.96 / sqrt(n + 1), the exact mean
 * when |mean - mu| / (sd / sqrt(n)) <= 1.96; both left sides follow Student's t with n - 1 degrees
 * of freedom. */
#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>
#include <gsl/gsl_sort.h>

#include "experiments/pool-ball-piston/piston.h"

double null_probability(null_kind kind, int n) {
    double t = kind == NULL_NEW_DRAW ? 1.96 / sqrt(n + 1) : 1.96;
    return 2 * gsl_cdf_tdist_P(t, n - 1) - 1;
}

static gsl_rng *generator(unsigned long seed) {
    gsl_rng *g = gsl_rng_alloc(gsl_rng_mt19937);
    gsl_rng_set(g, seed);
    return g;
}

/* One ensemble of standard normal draws, and whether what is held against it agrees. */
static bool agrees(gsl_rng *g, null_kind kind, int n) {
    double x[REPLICATES_MAX];
    for (int i = 0; i < n; i++) x[i] = gsl_ran_gaussian_ziggurat(g, 1);
    return score_agrees(x, n, kind == NULL_NEW_DRAW ? gsl_ran_gaussian_ziggurat(g, 1) : 0);
}

interval null_probability_drawn(null_kind kind, int n, int trials, unsigned long seed) {
    gsl_rng *g = generator(seed);
    int hits = 0;
    for (int i = 0; i < trials; i++) hits += agrees(g, kind, n);
    gsl_rng_free(g);
    double p = (double)hits / trials, sd = sqrt(p * (1 - p));
    return (interval){p, sd, 1.96 * sd / sqrt(trials), trials};
}

/* ---- whole experiments ----------------------------------------------------------------------- */

/* With one draw for all frames, one frame has all the points. */
static double mean_score(gsl_rng *g, null_kind kind, bool whole) {
    int frames = whole ? 1 : VIDEO_FRAMES, hits = 0, all = PARTICLES * ITEMS * frames;
    for (int i = 0; i < all; i++) hits += agrees(g, kind, ENSEMBLE);
    return 100.0 * hits / all;
}

void null_scores(null_kind kind, bool whole, double *out, int trials, unsigned long seed) {
    gsl_rng *g = generator(seed);
    for (int i = 0; i < trials; i++) out[i] = mean_score(g, kind, whole);
    gsl_sort(out, 1, (size_t)trials);
    gsl_rng_free(g);
}

void null_scores_of(null_kind kind, const track *const *tracks, int n, double *out, int trials,
                    unsigned long seed) {
    const track *shuffled[REPLICATES_MAX];
    track *mean = malloc(sizeof *mean);
    if (!mean) abort();
    for (int i = 0; i < n; i++) shuffled[i] = tracks[i];
    gsl_rng *g = generator(seed);
    for (int i = 0; i < trials; i++) {
        gsl_ran_shuffle(g, shuffled, (size_t)n, sizeof *shuffled);
        if (kind == NULL_EXACT_MEAN) track_mean(shuffled + ENSEMBLE, n - ENSEMBLE, mean);
        const track *held = kind == NULL_NEW_DRAW ? shuffled[ENSEMBLE] : mean;
        out[i] = score_against(shuffled, ENSEMBLE, held).mean;
    }
    gsl_sort(out, 1, (size_t)trials);
    gsl_rng_free(g);
    free(mean);
}

double part_at_least(const double *sorted, int n, double x) {
    int below = 0;
    while (below < n && sorted[below] < x) below++;
    return (double)(n - below) / n;
}

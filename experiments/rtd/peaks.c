/* peaks.c - has the distribution more than one peak?
 *
 * The wider the kernel of a density estimate, the fewer its peaks. The critical width is the
 * smallest that leaves one; it is large when a second peak is real. How large it gets by chance is
 * found by drawing from that very one-peaked estimate, scaled back to the variance of the data (B.
 * W. Silverman, Using kernel density estimates to investigate multimodality, J. R. Stat. Soc. B 43,
 * 1981, 97-99). A small P speaks for a second peak; the test errs on the side of one peak. */
#include "experiments/rtd/rtd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_randist.h>
#include <gsl/gsl_rng.h>

#include "engine/check.h"

enum { CELLS = 512, REACH = 4 }; /* kernel widths to which a kernel reaches */

typedef struct grid {
    double from, cell;
    double mass[CELLS]; /* share of the tracers at each point, split between neighbours */
} grid;

static void grid_add(grid *g, double t, double share) {
    double at = (t - g->from) / g->cell;
    if (!(at >= 0 && at < CELLS - 1)) return;
    int i = (int)at;
    g->mass[i] += share * (i + 1 - at);
    g->mass[i + 1] += share * (at - i);
}

static void density_of(const grid *g, double width, double density[CELLS]) {
    int reach = (int)ceil(REACH * width / g->cell);
    double kernel[CELLS];
    if (reach > CELLS - 1) reach = CELLS - 1;
    for (int k = 0; k <= reach; k++) {
        double u = k * g->cell / width;
        kernel[k] = exp(-0.5 * u * u);
    }
    memset(density, 0, CELLS * sizeof *density);
    for (int i = 0; i < CELLS; i++) {
        if (g->mass[i] == 0) continue;
        int low = i > reach ? i - reach : 0, high = i + reach < CELLS ? i + reach : CELLS - 1;
        for (int k = low; k <= high; k++) density[k] += g->mass[i] * kernel[abs(k - i)];
    }
}

/* Peaks of the estimate, their cells in at (the first RTD_PEAKS_MAX of them). */
static int peaks_at(const grid *g, double width, int *at) {
    double density[CELLS], top = 0;
    density_of(g, width, density);
    for (int i = 0; i < CELLS; i++) top = fmax(top, density[i]);
    int count = 0;
    bool rising = true;
    for (int i = 1; i < CELLS; i++) {
        if (rising && density[i] < density[i - 1] && density[i - 1] > 1e-9 * top) {
            if (at && count < RTD_PEAKS_MAX) at[count] = i - 1;
            count++, rising = false;
        } else if (density[i] > density[i - 1]) {
            rising = true;
        }
    }
    return count;
}

/* Smallest width with one peak, by halving: the number of peaks falls with the width. */
static double critical_width(const grid *g, double low, double high) {
    for (int i = 0; i < 30; i++) {
        double middle = sqrt(low * high);
        if (peaks_at(g, middle, NULL) > 1)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* Share of samples of as many tracers, drawn from the estimate at the critical width, that have
 * more than one peak there. */
static double chance_of_more(const tracer *t, size_t n, const double *w, const grid *g,
                             double width, rtd_moments m, uint64_t seed, int resamples) {
    gsl_ran_discrete_t *draw = gsl_ran_discrete_preproc(n, w);
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    CLAST_ASSERT(draw && rng);
    gsl_rng_set(rng, (unsigned long)seed);
    size_t left = 0;
    for (size_t i = 0; i < n; i++) left += t[i].left;
    double shrink = 1 / sqrt(1 + width * width / m.variance);
    int more = 0;
    for (int k = 0; k < resamples; k++) {
        grid sample = {.from = g->from, .cell = g->cell};
        for (size_t i = 0; i < left; i++) {
            double x = t[gsl_ran_discrete(rng, draw)].time + gsl_ran_gaussian(rng, width);
            grid_add(&sample, m.mean + shrink * (x - m.mean), 1.0 / (double)left);
        }
        more += peaks_at(&sample, width, NULL) > 1;
    }
    gsl_rng_free(rng);
    gsl_ran_discrete_free(draw);
    return (double)more / resamples;
}

rtd_peaks peaks_of(const tracer *sorted, size_t n, const double *w, uint64_t seed, int resamples) {
    CLAST_ASSERT(sorted && w && n > 0 && resamples > 0);
    rtd_moments m = moments_of_weights(sorted, n, w);
    double sd = sqrt(m.variance);
    rtd_peaks found = {.width = NAN, .p = NAN};
    if (!(sd > 1e-9 * m.mean)) return found;
    size_t last = n - 1;
    while (last > 0 && w[last] == 0) last--; /* those still inside may be much older */
    double low = sorted[0].time - 3 * sd, high = sorted[last].time + 3 * sd;
    grid g = {.from = low, .cell = (high - low) / (CELLS - 1)};
    for (size_t i = 0; i < n; i++)
        if (w[i] > 0) grid_add(&g, sorted[i].time, w[i]);
    found.width = critical_width(&g, 0.5 * g.cell, 2 * sd);
    found.p = chance_of_more(sorted, n, w, &g, found.width, m, seed, resamples);
    int at[RTD_PEAKS_MAX];
    int count = peaks_at(&g, 0.97 * found.width, at);
    found.count = count < RTD_PEAKS_MAX ? count : RTD_PEAKS_MAX;
    for (int i = 0; i < found.count; i++) found.at[i] = g.from + at[i] * g.cell;
    return found;
}

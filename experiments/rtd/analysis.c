/* analysis.c - from passages to the distribution and its numbers, with intervals.
 *
 * Intervals come from a circular block bootstrap (D. N. Politis and J. P. Romano, A circular
 * block-resampling procedure for stationary data, in R. LePage and L. Billard, Exploring the Limits
 * of Bootstrap, 1992): tracers in the order of entry are drawn in blocks, because neighbours travel
 * through the same bed and share its fate. A block holds what is fed in two mean residence times,
 * or a tenth of all tracers if that is less; the standard error then gets the Student factor of so
 * few blocks. */
#include "experiments/rtd/rtd.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_rng.h>

#include "engine/check.h"

const struct rtd_number_name RTD_NUMBER[RTD_NUMBERS] = {
    [RTD_MEAN] = {"mean residence time", "s"},
    [RTD_VARIANCE] = {"variance", "s2"},
    [RTD_SKEWNESS] = {"skewness", ""},
    [RTD_SPREAD] = {"variance over squared mean", ""},
    [RTD_TANKS] = {"tanks in series, from the variance", ""},
    [RTD_PECLET_OPEN] = {"Peclet number, open vessel, from the variance", ""},
    [RTD_PECLET_CLOSED] = {"Peclet number, closed vessel, from the variance", ""},
    [RTD_INSIDE] = {"share that never left", ""},
    [RTD_SIZE_SLOPE] = {"residence time against diameter, slope", "s/m"},
    [RTD_SIZE_RANK] = {"residence time against diameter, rank correlation", ""},
};

enum { LOOKS = 1000, BATCHES_LEAST = 4 };
static const double BLOCK_MEANS = 2; /* mean residence times in a block */
static const double SAMPLING = 180;  /* s, S12 4.7.2 */

static void *room_for(size_t count, size_t size) {
    void *p = calloc(count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

/* ---- the window ------------------------------------------------------------------------------ */

/* Entry of the first tracer: where the hold-up has become steady. */
static double steady_from(const passages *p, bool *steady) {
    double inside[LOOKS];
    for (int i = 0; i < LOOKS; i++) inside[i] = holdup_at(p, p->end * (i + 1) / LOOKS);
    long drop = mser5(inside, LOOKS);
    *steady = drop >= 0;
    return drop > 0 ? p->end * (double)drop / LOOKS : 0;
}

static int by_time(const void *a, const void *b) {
    const tracer *x = a, *y = b;
    if (x->time != y->time) return x->time < y->time ? -1 : 1;
    if (x->left != y->left) return x->left ? -1 : 1; /* who left was at risk with those inside */
    return (x->id > y->id) - (x->id < y->id);
}

static int by_diameter(const void *a, const void *b) {
    const tracer *const *x = a, *const *y = b;
    return ((*x)->diameter > (*y)->diameter) - ((*x)->diameter < (*y)->diameter);
}

/* Ranks from 1; equal ones share the mean rank. */
static void rank_all(tracer *t, size_t n) {
    tracer **order = room_for(n, sizeof *order);
    for (size_t i = 0; i < n; i++) order[i] = &t[i];
    qsort(order, n, sizeof *order, by_diameter);
    for (size_t i = 0, k; i < n; i = k) {
        for (k = i; k < n && order[k]->diameter == order[i]->diameter;) k++;
        for (size_t j = i; j < k; j++) order[j]->rank = 0.5 * (double)(i + 1 + k);
    }
    free(order);
    for (size_t i = 0, k; i < n; i = k) { /* these are in the order of time */
        for (k = i; k < n && t[k].time == t[i].time;) k++;
        for (size_t j = i; j < k; j++) t[j].time_rank = 0.5 * (double)(i + 1 + k);
    }
}

/* Who is still inside may yet leave by another outlet, so it is not at risk for this one: the
 * product-limit weights would be wrong. */
static bool is_one_way_out(const rtd *r, const passages *p, char why[RTD_ERROR_MAX]) {
    size_t others = 0;
    for (size_t i = 0; i < p->other_count; i++)
        others += p->other_in[i] >= r->from && p->other_in[i] <= r->until;
    if (others == 0 || r->inside == 0) return true;
    snprintf(why, RTD_ERROR_MAX,
             "of the bodies fed between %g s and %g s found %zu still inside and %zu that left by "
             "another outlet than the one asked for, expected either none inside (until an earlier "
             "time) or all "
             "outlets",
             r->from, r->until, r->inside, others);
    return false;
}

static bool take_tracers(rtd *r, const passages *p, char why[RTD_ERROR_MAX]) {
    r->items = room_for(p->count, sizeof *r->items);
    for (size_t i = 0; i < p->count; i++) {
        const passage *one = &p->items[i];
        if (one->in < r->from || one->in > r->until) continue;
        bool left = one->out <= p->end;
        r->items[r->tracers++] = (tracer){.time = (left ? one->out : p->end) - one->in,
                                          .mass = one->mass,
                                          .diameter = one->diameter,
                                          .entry = one->in,
                                          .id = one->id,
                                          .left = left};
        r->inside += !left;
    }
    if (r->tracers - r->inside < RTD_TRACERS_LEAST) {
        snprintf(why, RTD_ERROR_MAX,
                 "%zu of the %zu bodies fed between %g s and %g s have left, expected at least %d",
                 r->tracers - r->inside, r->tracers, r->from, r->until, RTD_TRACERS_LEAST);
        return false;
    }
    if (!is_one_way_out(r, p, why)) return false;
    qsort(r->items, r->tracers, sizeof *r->items, by_time);
    rank_all(r->items, r->tracers);
    r->weight = room_for(r->tracers, sizeof *r->weight);
    return true;
}

/* ---- all numbers of one set of weights ------------------------------------------------------- */

static void numbers_of(const tracer *t, size_t n, const double *w, double inside,
                       double number[RTD_NUMBERS]) {
    rtd_moments m = moments_of_weights(t, n, w);
    by_size s = by_size_of_weights(t, n, w);
    number[RTD_MEAN] = m.mean;
    number[RTD_VARIANCE] = m.variance;
    number[RTD_SKEWNESS] = m.skewness;
    number[RTD_SPREAD] = m.spread;
    number[RTD_TANKS] = tanks_of_spread(m.spread);
    number[RTD_PECLET_OPEN] = peclet_open(m.spread);
    number[RTD_PECLET_CLOSED] = peclet_closed(m.spread);
    number[RTD_INSIDE] = inside;
    number[RTD_SIZE_SLOPE] = s.slope;
    number[RTD_SIZE_RANK] = s.correlation;
}

/* F at the ends of the intervals (4.12); of all that was fed. */
static void shares_of(const rtd *r, const double *w, double *share) {
    memset(share, 0, r->bins * sizeof *share);
    for (size_t i = 0; i < r->tracers; i++) {
        size_t j = (size_t)(r->items[i].time / r->options.sampling);
        if (w[i] > 0 && j < r->bins) share[j] += w[i];
    }
    for (size_t j = 1; j < r->bins; j++) share[j] += share[j - 1];
}

/* Change of the residence time from the first entry of the window to the last, over its mean: it
 * ought to be nothing. Only what entered early enough for all to have left can tell. */
static double drift_of(const rtd *r, const double *w) {
    double all = 0, x = 0, y = 0, xx = 0, xy = 0, complete = r->until;
    for (size_t i = 0; i < r->tracers; i++)
        if (!r->items[i].left) complete = fmin(complete, r->items[i].entry);
    for (size_t i = 0; i < r->tracers; i++) {
        if (r->items[i].entry >= complete) continue;
        all += w[i], x += w[i] * r->items[i].entry, y += w[i] * r->items[i].time;
    }
    for (size_t i = 0; i < r->tracers; i++) {
        double dx = r->items[i].entry - x / all;
        if (r->items[i].entry >= complete) continue;
        xx += w[i] * dx * dx, xy += w[i] * dx * (r->items[i].time - y / all);
    }
    return xy / xx * (complete - r->from) / (y / all);
}

/* ---- resampling ------------------------------------------------------------------------------ */

/* Running mean and sum of squares. */
typedef struct spread {
    double n, mean, squares;
} spread;

static void spread_add(spread *s, double x) {
    if (!isfinite(x)) return;
    double off = x - s->mean;
    s->n++;
    s->mean += off / s->n;
    s->squares += off * (x - s->mean);
}

static double standard_error(const spread *s) {
    return s->n > 1 ? sqrt(s->squares / (s->n - 1)) : (double)NAN;
}

/* A standard error with the Student factor and the loss of a degree of freedom of so few blocks. */
static interval interval_of(double value, double error, size_t blocks) {
    double k = (double)blocks, corrected = error * sqrt(k / (k - 1));
    return (interval){value, corrected * sqrt(k), gsl_cdf_tdist_Pinv(0.975, k - 1) * corrected,
                      (int)blocks};
}

static int by_entry(const void *a, const void *b) {
    const tracer *const *x = a, *const *y = b;
    if ((*x)->entry != (*y)->entry) return (*x)->entry < (*y)->entry ? -1 : 1;
    return ((*x)->id > (*y)->id) - ((*x)->id < (*y)->id);
}

/* places[k]: where the k-th tracer to enter stands in the order of time. */
static size_t *places_by_entry(const rtd *r) {
    tracer **order = room_for(r->tracers, sizeof *order);
    size_t *place = room_for(r->tracers, sizeof *place);
    for (size_t i = 0; i < r->tracers; i++) order[i] = &r->items[i];
    qsort(order, r->tracers, sizeof *order, by_entry);
    for (size_t i = 0; i < r->tracers; i++) place[i] = (size_t)(order[i] - r->items);
    free(order);
    return place;
}

static void draw_blocks(const rtd *r, const size_t *place, gsl_rng *rng, int *times) {
    memset(times, 0, r->tracers * sizeof *times);
    for (size_t drawn = 0; drawn < r->tracers;) {
        size_t start = gsl_rng_uniform_int(rng, r->tracers);
        for (size_t k = 0; k < r->block && drawn < r->tracers; k++, drawn++)
            times[place[(start + k) % r->tracers]]++;
    }
}

typedef struct scatter {
    spread number[RTD_NUMBERS], drift;
    spread *share, *step; /* by interval */
} scatter;

static void add_resample(const rtd *r, const double *w, double inside, double *share, scatter *s) {
    double number[RTD_NUMBERS];
    numbers_of(r->items, r->tracers, w, inside, number);
    for (int k = 0; k < RTD_NUMBERS; k++) spread_add(&s->number[k], number[k]);
    spread_add(&s->drift, drift_of(r, w));
    shares_of(r, w, share);
    for (size_t j = 0; j < r->bins; j++) {
        spread_add(&s->share[j], share[j]);
        spread_add(&s->step[j], share[j] - (j ? share[j - 1] : 0));
    }
}

static void take_intervals(rtd *r, const scatter *s, const double *number) {
    for (int k = 0; k < RTD_NUMBERS; k++)
        r->of[k] = interval_of(number[k], standard_error(&s->number[k]), r->blocks);
    r->drift = interval_of(drift_of(r, r->weight), standard_error(&s->drift), r->blocks);
    for (size_t j = 0; j < r->bins; j++) {
        double step = r->share[j] - (j ? r->share[j - 1] : 0);
        r->density[j] = step / r->options.sampling;
        r->share_half[j] = interval_of(0, standard_error(&s->share[j]), r->blocks).half;
        r->density_half[j] =
            interval_of(0, standard_error(&s->step[j]), r->blocks).half / r->options.sampling;
    }
}

static void resample(rtd *r, const double *number) {
    gsl_rng *rng = gsl_rng_alloc(gsl_rng_mt19937);
    CLAST_ASSERT(rng);
    gsl_rng_set(rng, (unsigned long)r->options.seed);
    int *times = room_for(r->tracers, sizeof *times);
    double *w = room_for(r->tracers, sizeof *w), *share = room_for(r->bins, sizeof *share);
    scatter s = {.share = room_for(r->bins, sizeof *s.share),
                 .step = room_for(r->bins, sizeof *s.step)};
    size_t *place = places_by_entry(r);
    for (int k = 0; k < r->options.resamples; k++) {
        draw_blocks(r, place, rng, times);
        double inside = product_limit(r->items, r->tracers, times, w);
        add_resample(r, w, inside, share, &s);
    }
    take_intervals(r, &s, number);
    free(place), free(s.share), free(s.step), free(share), free(w), free(times);
    gsl_rng_free(rng);
}

/* ---- hold-up (S12 4.1) ----------------------------------------------------------------------- */

/* kg, mean over a time: every body counts as long as it is inside. */
static double mean_inside(const passages *p, double from, double to) {
    double sum = p->bed * (to - from);
    for (size_t i = 0; i < p->bed_count; i++)
        sum -= p->bed_mass[i] * fmax(0, to - fmax(from, p->bed_out[i]));
    for (size_t i = 0; i < p->count; i++) {
        double stay = fmin(to, p->items[i].out) - fmax(from, p->items[i].in);
        if (stay > 0) sum += p->items[i].mass * stay;
    }
    return sum / (to - from);
}

static double relative_error(const interval *x) {
    return x->sd / sqrt(x->n) / x->mean;
}

/* The mean and the hold-up of one window share their bodies, so their errors cancel in part; taken
 * as independent they make the interval too wide, not too narrow. */
static void take_little(rtd *r) {
    const interval *mean = &r->of[RTD_MEAN], *inside = &r->holdup;
    double little = r->feed * mean->mean / inside->mean;
    int n = mean->n < inside->n ? mean->n : inside->n;
    double error = little * hypot(relative_error(mean), relative_error(inside));
    r->little = (interval){little, error * sqrt(n), gsl_cdf_tdist_Pinv(0.975, n - 1) * error, n};
}

static interval times(double factor, const interval *x) {
    return (interval){factor * x->mean, factor * x->sd, factor * x->half, x->n};
}

/* S12 4.1: bulk density = feed x mean residence time over length, width and height. */
static void take_heights(rtd *r) {
    double per_kg = (double)NAN;
    if (r->options.footprint > 0 && r->options.bulk_density > 0)
        per_kg = 1 / (r->options.footprint * r->options.bulk_density);
    r->height_fed = times(per_kg * r->feed, &r->of[RTD_MEAN]);
    r->height_held = times(per_kg, &r->holdup);
}

static void take_holdup(rtd *r, const passages *p) {
    double fed = 0, span = r->until - r->from;
    for (size_t i = 0; i < r->tracers; i++) fed += r->items[i].mass;
    r->feed = fed / span;
    int batches = (int)(span / (BLOCK_MEANS * r->of[RTD_MEAN].mean));
    if (batches < BATCHES_LEAST) batches = BATCHES_LEAST;
    if (batches > 100) batches = 100;
    double part[100];
    for (int k = 0; k < batches; k++)
        part[k] = mean_inside(p, r->from + span * k / batches, r->from + span * (k + 1) / batches);
    r->holdup = mean_interval(part, batches);
    take_little(r);
    take_heights(r);
}

/* ---- the whole ------------------------------------------------------------------------------- */

static void take_blocks(rtd *r, double mean) {
    double first = INFINITY, last = -INFINITY;
    for (size_t i = 0; i < r->tracers; i++) {
        first = fmin(first, r->items[i].entry);
        last = fmax(last, r->items[i].entry);
    }
    double most = (double)r->tracers / RTD_BLOCKS_LEAST;
    double fed = BLOCK_MEANS * mean / (last - first) * (double)r->tracers;
    r->block = (size_t)fmax(1, floor(fmin(fed, most)));
    r->blocks = r->tracers / r->block;
}

bool rtd_sampling_fits(const passages *p, double sampling, char why[RTD_ERROR_MAX]) {
    CLAST_ASSERT(p && why && sampling >= 0);
    double longest = 0, width = sampling > 0 ? sampling : SAMPLING;
    for (size_t i = 0; i < p->count; i++)
        if (p->items[i].out <= p->end) longest = fmax(longest, p->items[i].out - p->items[i].in);
    if (longest / width + 1 <= RTD_BINS_MOST) return true;
    snprintf(why, RTD_ERROR_MAX,
             "found %.3g intervals of the sampling of %g s in the longest residence time of %g s, "
             "expected at most %d: a sampling of %.2g s or more",
             longest / width + 1, width, longest, RTD_BINS_MOST, longest / (RTD_BINS_MOST - 1.));
    return false;
}

/* Intervals of the sampling up to the last tracer that left. */
static void take_bins(rtd *r) {
    double last = 0;
    for (size_t i = 0; i < r->tracers; i++)
        if (r->items[i].left) last = fmax(last, r->items[i].time);
    r->bins = (size_t)(last / r->options.sampling) + 1;
    r->share = room_for(r->bins, sizeof *r->share);
    r->share_half = room_for(r->bins, sizeof *r->share_half);
    r->density = room_for(r->bins, sizeof *r->density);
    r->density_half = room_for(r->bins, sizeof *r->density_half);
}

static void take_models(rtd *r, const double *number) {
    double sampling = r->options.sampling, mean = number[RTD_MEAN];
    double *left = room_for(r->bins, sizeof *left); /* F of those that leave: it ends at one */
    for (size_t j = 0; j < r->bins; j++) left[j] = r->share[j] / (1 - number[RTD_INSIDE]);
    r->tanks = model_fit(tanks_share, left, r->bins, sampling, mean, number[RTD_TANKS]);
    r->dispersion =
        model_fit(dispersion_share, left, r->bins, sampling, mean, number[RTD_PECLET_OPEN]);
    free(left);
    r->peaks = peaks_of(r->items, r->tracers, r->weight, r->options.seed, r->options.resamples);
}

rtd *rtd_new(const passages *p, const rtd_options *o, char why[RTD_ERROR_MAX]) {
    CLAST_ASSERT(p && o && why && o->sampling >= 0 && o->resamples >= 0);
    if (!rtd_sampling_fits(p, o->sampling, why)) return NULL;
    rtd *r = room_for(1, sizeof *r);
    r->options = *o;
    if (r->options.sampling == 0) r->options.sampling = SAMPLING;
    if (r->options.resamples == 0) r->options.resamples = 1000;
    if (r->options.seed == 0) r->options.seed = 1;
    r->end = p->end;
    r->from = o->from > 0 ? o->from : steady_from(p, &r->steady);
    if (o->from > 0) r->steady = true;
    r->until = o->until > 0 ? fmin(o->until, p->end) : p->end;
    if (!take_tracers(r, p, why)) {
        rtd_free(r);
        return NULL;
    }
    double number[RTD_NUMBERS], inside = product_limit(r->items, r->tracers, NULL, r->weight);
    numbers_of(r->items, r->tracers, r->weight, inside, number);
    take_blocks(r, number[RTD_MEAN]);
    take_bins(r);
    shares_of(r, r->weight, r->share);
    resample(r, number);
    take_models(r, number);
    take_holdup(r, p);
    r->balance = p->balance;
    r->strays = p->strays;
    return r;
}

static double fitted_share(const rtd *r, rtd_model *model, const rtd_fit *fit, double t) {
    if (!isfinite(fit->mean)) return NAN;
    return (1 - r->of[RTD_INSIDE].mean) * model(t, fit->mean, fit->shape);
}

rtd_fitted rtd_fitted_bin(const rtd *r, rtd_model *model, const rtd_fit *fit, size_t j) {
    CLAST_ASSERT(r && model && fit && j < r->bins);
    double step = r->options.sampling, from = step * (double)j;
    double before = fitted_share(r, model, fit, from);
    double share = fitted_share(r, model, fit, from + step);
    return (rtd_fitted){(share - before) / step, share};
}

void rtd_free(rtd *r) {
    if (!r) return;
    free(r->items), free(r->weight);
    free(r->share), free(r->share_half), free(r->density), free(r->density_half);
    free(r);
}

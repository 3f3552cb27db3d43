/* measure.c - the runs into numbers, and numbers of different runs beside each other. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>

#include "engine/check.h"
#include "experiments/grate-rtd/grate.h"

/* ---- one run --------------------------------------------------------------------------------- */

static results *run_open(const grate_result *g) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(g->folder, why);
    if (r) return r;
    fprintf(stderr, "grate-rtd: %s\n", why);
    exit(4);
}

/* Who came and who went. */
static void measure_mass(grate_result *g) {
    char why[RTD_ERROR_MAX];
    g->passages = passages_read(g->folder, &(rtd_options){0}, why);
    if (!g->passages) fprintf(stderr, "grate-rtd: %s: %s\n", g->of->name, why);
}

static void measure_grate(grate_result *g) {
    char why[RTD_ERROR_MAX] = "";
    measure_mass(g);
    if (!g->passages) return;
    passages_scale(g->passages, g->speed_up);
    g->rtd = rtd_new(g->passages, &(rtd_options){.sampling = SAMPLING}, why);
    if (!g->rtd) {
        fprintf(stderr, "grate-rtd: %s: %s\n", g->of->name, why);
        return;
    }
    results *r = run_open(g);
    g->steps = results_series(r, "step")[results_rows(r) - 1];
    g->bed = bed_of(r, g->of, g->rtd->from / g->speed_up);
    results_free(r);
}

static const double AT_REST = 3.5; /* s, of a poured bed: its last frame */

static void measure_packing(grate_result *g) {
    results *r = run_open(g);
    g->bed = bed_of(r, g->of, AT_REST);
    results_free(r);
}

void grate_measure(grate_study *s) {
    for (int i = 0; i < s->count; i++)
        if (s->jobs[i].done) {
            grate_result *g = &s->results[i];
            g->processor_time = jobs_processor_time(&s->jobs[i]);
            if (g->of->group == GROUP_PACKING)
                measure_packing(g);
            else if (g->of->group == GROUP_FILM)
                measure_mass(g);
            else
                measure_grate(g);
        }
}

void grate_forget(grate_study *s) {
    for (int i = 0; i < s->count; i++) {
        rtd_free(s->results[i].rtd);
        passages_free(s->results[i].passages);
        free((char *)s->jobs[i].scene);
    }
}

/* ---- two runs -------------------------------------------------------------------------------- */

static double error_of(interval a) {
    return a.n > 1 ? a.sd / sqrt(a.n) : 0;
}

/* A value with a standard error and as many degrees of freedom as the side with fewer has. */
static interval with_error(double value, double error, interval a, interval b) {
    int n = a.n < b.n ? a.n : b.n;
    interval r = {value, NAN, NAN, n};
    if (n > 1) {
        r.sd = error * sqrt(n);
        r.half = gsl_cdf_tdist_Pinv(0.975, n - 1) * error;
    }
    return r;
}

interval difference_of(interval a, interval b) {
    return with_error(a.mean - b.mean, hypot(error_of(a), error_of(b)), a, b);
}

interval ratio_of(interval a, interval b) {
    double ratio = a.mean / b.mean;
    double error = fabs(ratio) * hypot(error_of(a) / a.mean, error_of(b) / b.mean);
    return with_error(ratio, error, a, b);
}

interval relative_difference(interval a, interval b) {
    interval r = ratio_of(a, b);
    r.mean -= 1;
    return r;
}

/* ---- the scan of the feed -------------------------------------------------------------------- */

bool in_scan(const grate_case *c, bool hurried) {
    if (hurried) return c->group == GROUP_FEED_10X;
    return c->group == GROUP_FEED || !strcmp(c->name, "backward clay");
}

/* Weighted least squares of ln t_m on ln feed. Where the means scatter about the line by more than
 * their errors say, the error of the slope grows by the root of chi2 over the degrees of freedom:
 * the curve need not be a power of the feed. */
interval slope_with_feed(const grate_study *s, bool hurried) {
    double x[CASES_MAX], y[CASES_MAX], w[CASES_MAX], c0, c1, c00, c01, c11, chi2;
    size_t n = 0;
    for (int i = 0; i < s->count; i++) {
        const grate_result *g = &s->results[i];
        if (!in_scan(g->of, hurried) || !g->rtd) continue;
        interval mean = g->rtd->of[RTD_MEAN];
        double error = error_of(mean) / mean.mean;
        x[n] = log(g->of->feed), y[n] = log(mean.mean), w[n++] = 1 / (error * error);
    }
    if (n < 3) return (interval){NAN, NAN, NAN, (int)n};
    gsl_fit_wlinear(x, 1, w, 1, y, 1, n, &c0, &c1, &c00, &c01, &c11, &chi2);
    double free = (double)n - 2, error = sqrt(c11 * fmax(1, chi2 / free));
    return (interval){c1, error * sqrt(n), gsl_cdf_tdist_Pinv(0.975, free) * error, (int)n};
}

/* ---- sampling -------------------------------------------------------------------------------- */

/* Moments as S12 4.7.2 takes them: every residence time is the middle of its interval. */
static rtd_moments sampled(const rtd *r, double sampling) {
    double all = 0, sum = 0, squares = 0;
    for (size_t i = 0; i < r->tracers; i++) {
        double t = (floor(r->items[i].time / sampling) + 0.5) * sampling;
        all += r->weight[i], sum += r->weight[i] * t, squares += r->weight[i] * t * t;
    }
    double mean = sum / all;
    return (rtd_moments){.mean = mean, .variance = squares / all - mean * mean};
}

double sampled_mean(const rtd *r, double sampling) {
    CLAST_ASSERT(r && sampling > 0);
    return sampled(r, sampling).mean;
}

double sampled_variance(const rtd *r, double sampling) {
    CLAST_ASSERT(r && sampling > 0);
    return sampled(r, sampling).variance;
}

/* ---- bulk density ---------------------------------------------------------------------------- */

double packing_published(double across) {
    if (across == 1) return 2 * 3.14159265358979323846 / 12; /* 4.10: 0.52 */
    if (isinf(across)) return 0.28 * 2.05;                   /* 4.9 */
    return 0.28 * (2.05 * across - 1) / across;              /* 4.8 */
}

interval packing_over(const grate_study *s, const char *name) {
    double value[CASES_MAX];
    int n = 0;
    for (int i = 0; i < s->count; i++)
        if (!strcmp(s->results[i].of->name, name) && s->results[i].bed.frames > 0)
            value[n++] = s->results[i].bed.packing.mean;
    return mean_interval(value, n);
}

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_fit.h>
#include <gsl/gsl_statistics_double.h>

#include "engine/check.h"
#include "experiments/study/statistics.h"

static const double PI = 3.14159265358979323846;

/* ---- means ----------------------------------------------------------------------------------- */

interval mean_interval(const double *x, int n) {
    CLAST_ASSERT(n >= 0 && (x || n == 0));
    interval r = {NAN, NAN, NAN, n};
    if (n > 0) r.mean = gsl_stats_mean(x, 1, (size_t)n);
    if (n > 1) {
        r.sd = gsl_stats_sd_m(x, 1, (size_t)n, r.mean);
        r.half = gsl_cdf_tdist_Pinv(0.975, n - 1) * r.sd / sqrt(n);
    }
    return r;
}

interval interval_exact(double value) {
    return (interval){value, NAN, NAN, 1};
}

interval interval_of_none(double value) {
    return (interval){value, NAN, NAN, 0};
}

/* ---- straight lines -------------------------------------------------------------------------- */

fitted_line line_fit(const double *x, const double *y, int n) {
    CLAST_ASSERT(n >= 0 && ((x && y) || n == 0));
    fitted_line r = {NAN, NAN, NAN, NAN, NAN, NAN, n};
    if (n < 2 || gsl_stats_variance(x, 1, (size_t)n) == 0) return r;
    double c00, c01, c11, left;
    gsl_fit_linear(x, 1, y, 1, (size_t)n, &r.intercept, &r.slope, &c00, &c01, &c11, &left);
    double total = gsl_stats_tss(y, 1, (size_t)n);
    if (total > 0) r.r2 = 1 - left / total;
    if (n > 2) {
        r.intercept_error = sqrt(c00);
        r.slope_error = sqrt(c11);
        r.covariance = c01;
    }
    return r;
}

/* Running means and central moments: no large sums that cancel. */
typedef struct moments {
    double n, t, m, tt, tm, mm;
} moments;

static void moments_add(moments *s, double t, double m) {
    s->n++;
    double dt = t - s->t, dm = m - s->m;
    s->t += dt / s->n;
    s->m += dm / s->n;
    s->tt += dt * (t - s->t);
    s->tm += dt * (m - s->m);
    s->mm += dm * (m - s->m);
}

linear_window linear_part(const double *t, const double *m, int n, double r2_min) {
    CLAST_ASSERT(n >= 0 && ((t && m) || n == 0));
    CLAST_ASSERT(r2_min > 0 && r2_min < 1);
    linear_window best = {NAN, NAN, NAN, NAN, 0, 0};
    double most = 0;
    for (int i = 0; i < n; i++) {
        moments s = {0};
        for (int j = i; j < n; j++) {
            CLAST_ASSERT(j == i || (t[j] > t[j - 1] && m[j] >= m[j - 1]));
            moments_add(&s, t[j], m[j]);
            double mass = m[j] - m[i];
            if (j - i + 1 < LINEAR_PART_SAMPLES || !(mass > 0) || mass < most) continue;
            double r2 = s.tm * s.tm / (s.tt * s.mm);
            if (r2 < r2_min || (mass == most && r2 <= best.r2)) continue;
            most = mass;
            best = (linear_window){t[i], t[j], s.tm / s.tt, r2, i, j - i + 1};
        }
    }
    return best;
}

/* ---- Beverloo -------------------------------------------------------------------------------- */

beverloo beverloo_fit(const double *D, const double *q, int n, double d) {
    CLAST_ASSERT(n >= 0 && ((D && q) || n == 0) && d > 0);
    double *y = calloc(n > 0 ? (size_t)n : 1, sizeof *y);
    CLAST_ASSERT(y);
    for (int i = 0; i < n; i++) {
        CLAST_ASSERT(q[i] >= 0);
        y[i] = cbrt(q[i] * q[i]);
    }
    beverloo r = {.fit = line_fit(D, y, n), .kd_half = NAN};
    free(y);
    const fitted_line *f = &r.fit;
    r.kd = -f->intercept / f->slope;
    if (n > 2) { /* variance of -intercept/slope to first order */
        double var = f->intercept_error * f->intercept_error + 2 * r.kd * f->covariance +
                     r.kd * r.kd * f->slope_error * f->slope_error;
        r.kd_half = gsl_cdf_tdist_Pinv(0.975, n - 2) * sqrt(fmax(0, var)) / fabs(f->slope);
    }
    r.k = r.kd / d;
    r.k_half = r.kd_half / d;
    return r;
}

double beverloo_c(double q, double rho, double D, double kd, double d) {
    CLAST_ASSERT(d > 0);
    const double g = 981; /* cm/s2 */
    if (!(D > kd) || !(rho > 0)) return NAN;
    return q / (4 * sqrt(2) / PI * sqrt(g) * rho * d * pow(D - kd, 1.5));
}

/* ---- numbers made of several means ------------------------------------------------------------
 */

estimate estimate_of(double value, const interval *part, const double *slope, int count) {
    CLAST_ASSERT(part && slope && count > 0 && count <= ESTIMATE_PARTS);
    estimate e = {value, NAN, NAN, part[0].n};
    double sum = 0, below = 0; /* of Satterthwaite's quotient */
    for (int i = 0; i < count; i++) {
        e.n = part[i].n < e.n ? part[i].n : e.n;
        if (slope[i] == 0) continue;
        double v = part[i].n > 1 ? slope[i] * slope[i] * part[i].sd * part[i].sd / part[i].n : NAN;
        sum += v;
        below += v * v / (part[i].n - 1);
    }
    e.error = sqrt(sum);
    e.df = below > 0 ? sum * sum / below : NAN;
    return e;
}

interval estimate_interval(estimate e) {
    interval r = {e.value, NAN, NAN, e.n};
    if (e.error > 0) r.half = gsl_cdf_tdist_Pinv(0.975, e.df) * e.error;
    if (e.error == 0) r.half = 0;
    return r;
}

double estimate_above_p(estimate e) {
    if (e.error > 0) return gsl_cdf_tdist_Q(e.value / e.error, e.df);
    if (e.error == 0 && e.value != 0) return e.value > 0 ? 0 : 1;
    return NAN;
}

interval fall_percent(interval a, interval b) {
    if (a.mean == 0) return (interval){NAN, NAN, NAN, 0};
    double rest = b.mean / a.mean, slope[2] = {100 * rest / a.mean, -100 / a.mean};
    return estimate_interval(estimate_of(100 * (1 - rest), (interval[]){a, b}, slope, 2));
}

/* ---- tests of two means ---------------------------------------------------------------------- */

static t_test t_from(double difference, double error, double df) {
    if (error == 0)
        return (t_test){difference == 0 ? 0 : copysign(INFINITY, difference), df, difference == 0};
    double t = difference / error;
    return (t_test){t, df, 2 * gsl_cdf_tdist_Q(fabs(t), df)};
}

t_test t_test_pooled(interval a, interval b) {
    if (a.n < 2 || b.n < 2) return (t_test){NAN, NAN, NAN};
    double df = a.n + b.n - 2;
    double var = ((a.n - 1) * a.sd * a.sd + (b.n - 1) * b.sd * b.sd) / df;
    return t_from(a.mean - b.mean, sqrt(var * (1.0 / a.n + 1.0 / b.n)), df);
}

/* Squared standard error of a - b and its degrees of freedom; a side with n < 2 has no spread. */
static double welch(interval a, interval b, double *df) {
    double va = a.n > 1 ? a.sd * a.sd / a.n : 0, vb = b.n > 1 ? b.sd * b.sd / b.n : 0;
    double below = (a.n > 1 ? va * va / (a.n - 1) : 0) + (b.n > 1 ? vb * vb / (b.n - 1) : 0);
    *df = below > 0 ? (va + vb) * (va + vb) / below : 1;
    return va + vb;
}

t_test t_test_welch(interval a, interval b) {
    if (a.n < 2 && b.n < 2) return (t_test){NAN, NAN, NAN};
    double df, var = welch(a, b, &df);
    return t_from(a.mean - b.mean, sqrt(var), df);
}

equivalence equivalence_test(interval a, interval b, double margin) {
    CLAST_ASSERT(margin >= 0);
    double df, error = sqrt(welch(a, b, &df));
    equivalence r = {.difference = a.mean - b.mean, .df = df};
    if (error > 0)
        r.p = gsl_cdf_tdist_Q((margin - fabs(r.difference)) / error,
                              df); /* the nearer side decides */
    else
        r.p = fabs(r.difference) <= margin ? 0 : 1;
    if (isnan(r.difference)) r.p = NAN;
    r.equal = r.p < 0.05;
    return r;
}

/* ---- arches ---------------------------------------------------------------------------------- */

arches arch_events(const double *t, const double *count, int n, double min_gap_s, arch *events,
                   int room) {
    CLAST_ASSERT(n >= 0 && ((t && count) || n == 0) && min_gap_s > 0);
    CLAST_ASSERT(room >= 0 && (events || room == 0));
    arches r = {.last = NAN, .silent = n > 0 ? t[n - 1] - t[0] : NAN};
    for (int i = 1; i < n; i++) {
        CLAST_ASSERT(t[i] > t[i - 1]);
        if (count[i] == count[i - 1]) continue;
        double gap = t[i] - r.last; /* NAN before the first discharge */
        if (gap >= min_gap_s) {
            if (r.n < room) events[r.n] = (arch){r.last, gap};
            r.n++;
            r.total += gap;
            r.longest = fmax(r.longest, gap);
        }
        r.last = t[i];
        r.silent = t[n - 1] - t[i];
    }
    return r;
}

bool arch_is_permanent(const arches *a, double min_gap_s, int above_heap) {
    CLAST_ASSERT(a && above_heap >= 0);
    return above_heap > 0 && a->silent >= min_gap_s;
}

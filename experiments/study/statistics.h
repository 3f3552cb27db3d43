/* statistics.h - what a study does with its samples. GSL does the numbers; the same input gives the
 * same output. All intervals are two-sided, 95 %, Student.
 *
 *     interval q = mean_interval(rates, 5);
 *     printf("%.1f +/- %.1f g/s\n", q.mean, q.half);
 *
 * Too few samples, or samples without spread, are not an error: what cannot be known is NAN. */
#ifndef CLAST_STUDY_STATISTICS_H
#define CLAST_STUDY_STATISTICS_H

#include <stdbool.h>

/* ---- means ----------------------------------------------------------------------------------- */

typedef struct interval {
    double mean;
    double sd;   /* of the samples; NAN when n < 2 */
    double half; /* half width of the 95 % interval of the mean; NAN when n < 2 */
    int n;
} interval;

interval mean_interval(const double *x, int n); /* n >= 0 */
interval interval_exact(double value);          /* one sample, its spread not known: n = 1 */
interval interval_of_none(double value);        /* of no sample at all, as a P is: n = 0 */

/* ---- straight lines -------------------------------------------------------------------------- */

typedef struct fitted_line {
    double slope, intercept;
    double slope_error, intercept_error, covariance; /* standard errors; NAN when n < 3 */
    double r2;                                       /* part of the variance explained */
    int n;
} fitted_line;

/* Least squares; all NAN when n < 2 or all x are equal. */
fitted_line line_fit(const double *x, const double *y, int n);

typedef struct linear_window {
    double from, to; /* s, first and last sample */
    double slope;    /* least squares over the window */
    double r2;
    int first, count; /* samples; count = 0: no such window */
} linear_window;

enum { LINEAR_PART_SAMPLES = 5 }; /* fewer points lie on a line by chance */

/* The contiguous run of samples that discharges most while a straight line explains r2_min of its
 * variance.
 *
 * A00 takes the steady rate from "the linear segment" of the cumulative curve (Fig. 4.14) and chose
 * that segment by eye. This is the objective stand-in. Longest by mass, not by time: a flow that
 * has stopped is a perfect straight line too, and must not win. Of windows with the same mass the
 * straighter one is taken, which drops the flat ends. The one free number is r2_min, so a study
 * reports its rates at more than one value of it. Rejected: fixed fractions of the mass (10-90 %
 * holds the start-up at 10 cm and a dying arch at 5 cm).
 *
 * t rises strictly, m does not fall. O(n^2). */
linear_window linear_part(const double *t, const double *m, int n, double r2_min);

/* ---- Beverloo in two dimensions (A00 4.5) ---------------------------------------------------- */

typedef struct beverloo {
    fitted_line fit; /* of q^(2/3) on D */
    double kd;       /* where the line meets q = 0 */
    double kd_half;  /* 95 %, delta method; NAN when n < 3 */
    double k, k_half;
} beverloo;

/* D and d in one unit of length; q >= 0. Replicates go in as points of their own. */
beverloo beverloo_fit(const double *D, const double *q, int n, double d);

/* C = q / (4 sqrt(2)/pi sqrt(g) rho d (D - kd)^(3/2)), lengths in cm, q in g/s, rho of the sheet in
 * g/cm2, g = 981 cm/s2, as A00 printed it. With an areal density the formula has one length too
 * many: C comes out per cm, and C d is the pure number. NAN when D <= kd. */
double beverloo_c(double q, double rho, double D, double kd, double d);

/* ---- numbers made of several means ------------------------------------------------------------
 */

typedef struct estimate {
    double value, error, df; /* standard error; NAN when the spread of a part is not known */
    int n;                   /* the fewest samples of a part */
} estimate;

enum { ESTIMATE_PARTS = 16 };

/* `value` is a function of the means of independent samples, slope[i] its derivative by the i-th.
 * To first order: the squared error is the sum of (slope sd)^2 / n, its degrees of freedom those of
 * Welch and Satterthwaite. 1 to ESTIMATE_PARTS parts; one with the slope 0 counts for nothing but
 * n. */
estimate estimate_of(double value, const interval *part, const double *slope, int count);

interval estimate_interval(estimate e); /* sd NAN: there is no one sample */
double estimate_above_p(estimate e);    /* one-sided P that it is not above 0; NAN when unknown */
interval fall_percent(interval a, interval b); /* from a to b, percent of a; NAN from 0 */

/* ---- tests of two means ---------------------------------------------------------------------- */

typedef struct t_test {
    double t, df, p; /* two-sided; NAN when neither sample has a spread to go by */
} t_test;

t_test t_test_pooled(interval a, interval b); /* one variance for both, as in A00 Table 4.6 */
t_test t_test_welch(interval a, interval b);

typedef struct equivalence {
    double difference; /* a - b */
    double p;          /* the larger of the two one-sided P values */
    double df;
    bool equal; /* p < 0.05: |difference| < margin is shown, not just not contradicted */
} equivalence;

/* Two one-sided Welch tests. A side with n < 2 is a known value without spread; when both are, it
 * is a plain comparison (p = 0 or 1). */
equivalence equivalence_test(interval a, interval b, double margin);

/* ---- velocity profile (A00 4.8) -------------------------------------------------------------- */

typedef struct kinematic {
    double v0, v0_half; /* v0_half = 0 when v0 was given */
    double b,
        b_half; /* kinematic constant, same unit of length as x and h; NAN when the fit failed */
    double rms; /* of what the model leaves unexplained */
    int n;
    bool
        found; /* false: too few samples, or the profile is flatter or narrower than any B can be */
} kinematic;

/* v = v0 exp(-x^2 / (4 B h)), B by least rms with v0 given, as A00 4.3.2.6 did it. */
kinematic kinematic_fit(const double *x, const double *v, int n, double h, double v0);

/* The same with v0 free: a centre line with three buttons on it is a poor witness. */
kinematic kinematic_fit_free(const double *x, const double *v, int n, double h, double v0_start);

/* Mean velocity of the samples with |x| <= width / 2; NAN when there are none. */
double centre_velocity(const double *x, const double *v, int n, double width);

/* ---- arches ---------------------------------------------------------------------------------- */

typedef struct arch {
    double start, length; /* s; known to one sampling interval */
} arch;

typedef struct arches {
    int n;                 /* temporary arches: discharge stopped and later went on */
    double total, longest; /* s; 0 when there were none */
    double last;           /* s, the last discharge; NAN when nothing ever came out */
    double silent;         /* s from there to the last sample */
} arches;

/* Every change of `count` (bodies out, or bodies left) is a discharge. Pauses of at least min_gap_s
 * between two of them are arches; the wait before the first and the silence after the last are not.
 * The first `room` arches are stored in events, which may be NULL when room is 0. */
arches arch_events(const double *t, const double *count, int n, double min_gap_s, arch *events,
                   int room);

/* Ended in an arch that holds: silent, with bodies above the heap that stays for good. How many
 * those are is for the caller to count. */
bool arch_is_permanent(const arches *a, double min_gap_s, int above_heap);

#endif

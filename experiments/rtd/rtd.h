/* rtd.h - the residence time distribution of any run with an inlet and an outlet.
 *
 *     char why[RTD_ERROR_MAX];
 *     passages *p = passages_read("build/forward", &(rtd_options){0}, why);
 *     rtd *r = p ? rtd_new(p, &(rtd_options){.sampling = 180}, why) : NULL;
 *     printf("%.0f +/- %.0f s\n", r->of[RTD_MEAN].mean, r->of[RTD_MEAN].half);
 *
 * A tracer is a body that a feed put in after the run had become steady; its residence time runs
 * from there to the outlet. S12: K. Samiei, PhD thesis, University of Luxembourg, 2012, sections
 * 4.5 and 4.7.2. README.md says how each number is made and why so. GSL does the numerics; the same
 * input and seed give the same output. */
#ifndef CLAST_RTD_H
#define CLAST_RTD_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

#include "experiments/study/statistics.h"

enum {
    RTD_ERROR_MAX = 1024,
    RTD_TRACERS_LEAST = 20,
    RTD_BLOCKS_LEAST = 10,
    RTD_BINS_MOST = 100000
};

typedef struct rtd_options {
    double sampling;           /* s, of E and F; 0 = 180, S12 4.7.2 */
    double from, until;        /* s, entries looked at; 0 = where the run is steady, its end */
    const char *feed, *outlet; /* names; NULL = all */
    uint64_t seed;             /* of the resampling; 0 = 1 */
    int resamples;             /* 0 = 1000 */
    double footprint;          /* m2, length x width of the bed; 0 = not known: no bed height */
    double bulk_density;       /* kg/m3 of the bed; 0 = not known */
} rtd_options;

/* ---- who came and went ----------------------------------------------------------------------- */

typedef struct passage {
    uint32_t id;
    double in, out;        /* s; out is INFINITY while the body is inside at the end of the run */
    double mass, diameter; /* kg, m */
} passage;

/* The bodies of the first bed, which no feed put in, are no passages but part of the hold-up. */
typedef struct passages {
    passage *items; /* in the order of entry */
    size_t count;
    double *other_in; /* s, entries of those that left by an outlet not asked for */
    size_t other_count;
    double end;       /* s, of the run */
    double bed;       /* kg of the first bed */
    double *bed_out;  /* s, when a body of it left, rising */
    double *bed_mass; /* kg, of that body */
    size_t bed_count;
    double balance;  /* kg: in minus out minus inside at the end, by the tables or by the run's own
                        count, whichever is farther from 0; NAN when the series has no inside_kg */
    double lightest; /* kg, of the bodies in the tables */
    size_t strays; /* left the domain (outlet `domain`) where there are other outlets, and count as
                      having left; 0 when an outlet is asked for */
} passages;

/* Reads feeds.csv, outlets.csv and series.csv of a run. NULL with a reason when there is no such
 * run, feed or outlet, or a record makes no sense. */
passages *passages_read(const char *folder, const rtd_options *o, char why[RTD_ERROR_MAX]);

/* From columns; rows need not be in order. out[i] = INFINITY: still inside. Copies. */
passages *passages_new(const passage *items, size_t count, double end);
void passages_free(passages *p);

/* All times as if a run had gone `factor` times slower; factor > 0. */
void passages_scale(passages *p, double factor);

/* Whether the balance is nothing within rounding: nearer to 0 than half the lightest body. True
 * when it is not known. */
bool passages_balanced(const passages *p);

/* kg inside at a moment. */
double holdup_at(const passages *p, double time);

/* ---- when it is steady (steady.c) ------------------------------------------------------------ */

/* Number of leading values to drop, by the marginal standard error rule with batches of five
 * (MSER-5), less than half of them; -1 when the record is not steady by then. n >= 10 */
long mser5(const double *x, size_t n);

/* ---- weights under censoring (weights.c) ----------------------------------------------------- */

/* One tracer: its residence time, or its age while it is inside. */
typedef struct tracer {
    double time;           /* s */
    double mass;           /* kg */
    double diameter, rank; /* m; rank of the diameter among all */
    double time_rank;
    double entry; /* s */
    uint32_t id;
    bool left;
} tracer;

/* Product-limit weights (Kaplan and Meier 1958) of tracers in rising order of time: w[i] is the
 * share of the fed mass that leaves at time i, 0 for those still inside. Returns the share that
 * never left as far as the run can tell. times[i]: how often tracer i counts; NULL: once each. When
 * all have left, w[i] = m_i / sum m (S12 3.58). */
double product_limit(const tracer *sorted, size_t n, const int *times, double *w);

/* Of the tracers that leave. */
typedef struct rtd_moments {
    double mean, variance, skewness; /* s, s2, 1 */
    double spread;                   /* variance over squared mean */
} rtd_moments;

rtd_moments moments_of_weights(const tracer *sorted, size_t n, const double *w);

/* Residence time against diameter. */
typedef struct by_size {
    double slope;       /* s/m; NAN when all have one size */
    double correlation; /* of the ranks (Spearman) */
} by_size;

by_size by_size_of_weights(const tracer *sorted, size_t n, const double *w);

/* ---- models (models.c) ----------------------------------------------------------------------- */

double tanks_of_spread(double spread);     /* n = 1 / spread */
double peclet_open(double spread);         /* 2 / spread: first passage, inverse Gaussian */
double peclet_closed(double spread);       /* Danckwerts' vessel; NAN for a spread outside (0, 1) */
double spread_of_peclet_closed(double pe); /* 2/Pe - 2 (1 - exp(-Pe)) / Pe2 */

/* Share that has left by time t; mean in s. */
double tanks_share(double t, double mean, double tanks);
double dispersion_share(double t, double mean, double peclet);

typedef double rtd_model(double t, double mean, double shape);

typedef struct rtd_fit {
    double mean, shape; /* s; number of tanks, or Pe. NAN when the fit failed */
    double misfit;      /* root mean square of what is left of F, of those that leave */
} rtd_fit;

/* Least squares on the share that leaves in each interval of the sampling. share[j]: share of those
 * that leave that has left by (j + 1) sampling; it ends at 1, as the models do. */
rtd_fit model_fit(rtd_model *model, const double *share, size_t n, double sampling, double mean,
                  double shape);

/* ---- peaks (peaks.c) ------------------------------------------------------------------------- */

enum { RTD_PEAKS_MAX = 8 };
typedef struct rtd_peaks {
    int count;                /* peaks of the density at a width just below the critical one */
    double at[RTD_PEAKS_MAX]; /* s */
    double width;             /* s, critical: any wider kernel leaves a single peak */
    double p;                 /* of that width, were there a single peak (Silverman 1981) */
} rtd_peaks;

rtd_peaks peaks_of(const tracer *sorted, size_t n, const double *w, uint64_t seed, int resamples);

/* ---- all of it ------------------------------------------------------------------------------- */

typedef enum rtd_number {
    RTD_MEAN,
    RTD_VARIANCE,
    RTD_SKEWNESS,
    RTD_SPREAD,
    RTD_TANKS,
    RTD_PECLET_OPEN,
    RTD_PECLET_CLOSED,
    RTD_INSIDE, /* share that never left */
    RTD_SIZE_SLOPE,
    RTD_SIZE_RANK,
    RTD_NUMBERS
} rtd_number;

extern const struct rtd_number_name { const char *name, *unit; } RTD_NUMBER[RTD_NUMBERS];

typedef struct rtd {
    rtd_options options;     /* as used */
    double from, until, end; /* s, of the entries; of the run */
    bool steady;             /* false: the rule found no steady part; all entries were taken */
    size_t tracers, inside;  /* tracers; those of them still inside at the end */
    size_t block;            /* tracers in a row, of the resampling */
    size_t blocks;
    interval of[RTD_NUMBERS];       /* block bootstrap; n = number of blocks */
    interval drift;                 /* relative change of the residence time over the window */
    size_t bins;                    /* of E and F */
    double *share;                  /* F at (j + 1) sampling (4.12) */
    double *share_half;             /* half width of its 95 % interval */
    double *density, *density_half; /* 1/s, E in interval j (4.11) */
    rtd_fit tanks, dispersion;      /* least squares, of those that leave */
    rtd_peaks peaks;
    double feed;          /* kg/s in the window */
    interval holdup;      /* kg, mean over the time of the window; batch means */
    interval little;      /* feed x mean residence time over hold-up (4.1); on the wide side */
    interval height_fed;  /* m, of the bed by (4.1): feed x mean residence time over footprint and
                             bulk density, which count as exact; NAN where they are not known */
    interval height_held; /* m, likewise from the hold-up */
    double balance;       /* kg, strays: of all passages */
    size_t strays;
    tracer *items; /* rising time */
    double *weight;
} rtd;

/* Whether E and F of all passages fit into RTD_BINS_MOST intervals of the sampling (s, > 0; 0 =
 * 180). False with a reason. */
bool rtd_sampling_fits(const passages *p, double sampling, char why[RTD_ERROR_MAX]);

/* NULL with a reason when there are fewer than RTD_TRACERS_LEAST tracers that left, the sampling
 * does not fit, or of one outlet of several while some tracers are still inside. */
rtd *rtd_new(const passages *p, const rtd_options *o, char why[RTD_ERROR_MAX]);
void rtd_free(rtd *r);

/* What a fit of r has over bin j, as shares of all that was fed, beside `density` and `share`; NAN
 * when the fit failed. */
typedef struct rtd_fitted {
    double density; /* 1/s, mean over the bin */
    double share;   /* that has left by its end */
} rtd_fitted;

rtd_fitted rtd_fitted_bin(const rtd *r, rtd_model *model, const rtd_fit *fit, size_t j);

/* ---- out ------------------------------------------------------------------------------------- */

void rtd_print(const rtd *r, FILE *to);
/* rtd.csv, curve.csv, tracers.csv; 0 or 4 (said on stderr). */
int rtd_write(const rtd *r, const char *folder);

#endif

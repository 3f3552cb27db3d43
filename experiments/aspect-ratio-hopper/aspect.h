/* aspect.h - the hopper of A00 chapter 5: what is run, what is read off the runs, what is written.
 *
 * plan.c says which runs there are, chain.c has the numbers of the particles; grid.c, bed.c,
 * flow.c, shear.c, walls.c, heap.c and motion.c read one run each, summary.c and trends.c draw them
 * together, settings.c and contrasts.c compare settings and families of shapes, tables.c, maps.c,
 * pictures.c and verdicts.c write them down.
 *
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_ASPECT_H
#define CLAST_ASPECT_H

#include <stdbool.h>
#include <stdio.h>

#include "experiments/run/results.h"
#include "experiments/study/command.h"
#include "experiments/study/jobs.h"
#include "experiments/study/output.h"
#include "experiments/study/statistics.h"

/* ---- constants of the source (A00 5.2, Table 5.1) -------------------------------------------- */

#define EQUAL_RADIUS  0.01 /* m, of the sphere whose volume every particle has */
#define DENSITY       2650.0
#define ORIFICE       0.7 /* of the width */
#define CELL          0.1 /* m, of the grid of solid fractions, for a hopper 1 m wide */
#define SNAPSHOT      1.4 /* s, Fig. 5.17 */
#define GRAVITY       9.81
#define WALL_FRICTION 0.5

/* ---- what we chose (README.md, "How it is read") --------------------------------------------- */

#define STABLE_WITHIN  0.02  /* of the last co-ordination number */
#define FORCE_OVER     0.25  /* s, at the end of the consolidation */
#define DELAY_SHARE    0.01  /* of the particles: the discharge has begun */
#define LINEAR_R2      0.999 /* of the linear part of the discharge */
#define BIN_S          0.025 /* s, that the rate is counted over */
#define ARCH_RATE      0.5   /* of the steady rate: below it in BIN_S there is an arch somewhere */
#define SHEAR_TIME     0.2   /* s after the opening */
#define SHEAR_BAND     0.3   /* of the fastest speed: lower limit of the middle band of Fig. 5.18 */
#define PULSE_UNTIL    0.5   /* s after the opening */
#define PRESSURE_FROM  0.1   /* s */
#define PRESSURE_UNTIL 0.3
#define RESTS_BELOW    0.5   /* of the speed of free fall from the orifice: on the heap */
#define BED_SAMPLE     0.01  /* s, series of bed.yaml */
#define FLOW_SAMPLE    0.005 /* s, series of flow.yaml */
#define CHAMBER_FULL   0.95  /* of its depth: the heap below the orifice leaves no room to flow */

enum {
    MAIN_SHAPES = 4,
    SHAPES = 9,
    SECTIONS = 10,
    REGIONS = 3,
    TRACKED = 9,
    TRACK_MAX = 200,
    CELLS_MAX = 400,
    SHEAR_TIMES = 5,
    HEAP_BINS = 20,
    REPLICATES_MAX = 20,
    CASES_MAX = 200,
    SUBCONTACTS = 4
};

/* ---- particles ------------------------------------------------------------------------------- */

/* A straight row of equal spheres with the volume of one of EQUAL_RADIUS. */
typedef struct chain {
    const char *name;
    double aspect;
    int spheres;
    double density;         /* q of A00 3.7: diameter over distance of centres; 1: they touch */
    double radius, spacing; /* m */
    double area;            /* m2, of the side view */
    double across;          /* m2, moment about an axis across it, over the mass */
} chain;

/* The first MAIN_SHAPES are those of the source. */
chain chain_of(int shape);
double chain_length(const chain *c);

/* ---- sizes ----------------------------------------------------------------------------------- */

/* Step and stiffness of the source, and what saves time: README.md, "The cheaper setting". */
enum { THESIS, CHEAP, SETTINGS };

typedef struct aspect_size {
    const char *name;
    int count;                       /* particles */
    double half_width, chamber, top; /* m */
    int replicates[SETTINGS];
    int variants;    /* replicates of each variant */
    int further;     /* replicates of each shape behind the main ones */
    int in_space;    /* replicates in three dimensions, aspects 1 and 2 */
    int space_count; /* particles there */
    bool films;
} aspect_size;

extern const aspect_size SIZES[4];

typedef struct variant {
    const char *assumption, *name;
    int shape;
    const char *bed[3], *flow[3]; /* settings, up to NULL */
} variant;

extern const variant VARIANTS[];
extern const int VARIANT_COUNT; /* the first is the baseline */

/* ---- what is read off a run ------------------------------------------------------------------ */

/* Solid fractions of square cells, row by row from below. */
typedef struct cells {
    int columns, rows;
    double size;               /* m */
    double counted[CELLS_MAX]; /* as the source: number of centroids times area of a particle */
    double exact[CELLS_MAX];   /* area of the discs in the cell */
    double number[CELLS_MAX];  /* centroids */
} cells;

typedef struct bed_facts {
    double height;                      /* m, mean of the surface */
    double weight;                      /* N */
    double phi, phi_exact;              /* mean over cells that lie below the surface */
    double per_cell;                    /* particles in such a cell */
    double phi_all, skewness, kurtosis; /* over all cells with a particle, as Fig. 5.4 */
    double coordination, with_walls;
    double force_rest;               /* as force, of the bed at rest */
    double stable;                   /* s */
    double force, force_last;        /* relative difference from the weight: mean, last value */
    double subcontacts[SUBCONTACTS]; /* shares of the pairs that touch at 1, 2, 3, more points */
    double residual;                 /* of the energy put in */
} bed_facts;

typedef struct flow_facts {
    double delay, first;              /* s: DELAY_SHARE out, first particle out */
    double meets;                     /* s, where the line of the linear part meets zero */
    linear_window linear;             /* percent of the particles per s */
    double linear_share;              /* of what flows out */
    double rate, rate_kg;             /* percent/s, kg/s */
    double rate_r2[2];                /* percent/s with R2 0.99 and 0.9995 */
    double start_up;                  /* s from the first particle to the linear part */
    double fluctuation;               /* relative standard deviation of the rate over BIN_S */
    double arches;                    /* stretches below ARCH_RATE */
    double lowest, lowest_at;         /* lowest rate over BIN_S over the mean; s */
    double left;                      /* share that stays above the bottom */
    double ratio[REGIONS], ratio_all; /* log10 of summed rotational over translational energy */
    double ratio_mean[REGIONS];       /* log10 of the mean over particles of their own ratio */
    double ratio_mean_all;
    double angle[SHEAR_TIMES], angle_70; /* deg, at SHEAR_BAND; at 70 % and SHEAR_TIME */
    double pulse;                        /* largest force over that at rest, mean over partitions */
    double pressure[SECTIONS];           /* N/m, both walls, from below */
    double pressure_mean;
    double janssen_k, janssen_r2;
    double heap_slope, heap_end; /* deg, at SNAPSHOT and at the end */
    double heap[HEAP_BINS];      /* m above the ground, at SNAPSHOT */
    double level, level_end;     /* of the heap below the orifice over the depth of the chamber */
    double fastest;              /* m/s, at SNAPSHOT */
    double turned;               /* rad, mean path of the angle of the tracked particles */
    double residual;
} flow_facts;

extern const double SHEAR_AT[SHEAR_TIMES]; /* s; the middle one is SHEAR_TIME */

/* ---- runs ------------------------------------------------------------------------------------ */

typedef struct aspect_case {
    int shape, setting, variant, replicate;
    bool in_space; /* three dimensions */
    chain chain;
    double half_width, chamber; /* m */
    int count;
    const char *bed_folder, *rest_folder, *flow_folder;
    bool has_bed, ran; /* false: the run itself failed */
    bed_facts bed;
    flow_facts flow;
} aspect_case;

typedef struct aspect_study {
    const aspect_size *size;
    study_folders to;
    job *beds, *rests, *flows;
    aspect_case cases[CASES_MAX]; /* one per bed and flow */
    int count;
} aspect_study;

/* plan.c: beds, which then come to rest, and, as the partitions of the side walls hang on their
 * heights, flows. What matters most stands first. */
void aspect_plan(aspect_study *s);
/* Number of cases that failed; measures what ran. With CLAST_KEPT in the environment no run is
 * started: what there is, is measured. */
int aspect_run_all(aspect_study *s);
/* NULL when there is none or it failed. */
const aspect_case *case_of(const aspect_study *s, int shape, int setting, int variant,
                           int replicate);
/* The first replicate at the setting of the source, or else at the cheaper one. */
const aspect_case *shown_case(const aspect_study *s, int shape);
results *run_open(const char *folder);     /* exits with code 4 when it cannot be read */
frame *run_frame(results *r, double time); /* the nearest in time; likewise */
const double *run_column(const results *r, const char *name);

/* ---- measures, one run each ------------------------------------------------------------------ */

/* Area of a disc of radius r about (x, z) in [x0, x1] x [z0, z1]. */
double disc_in_cell(double x, double z, double r, double x0, double x1, double z0, double z1);
/* Above the bottom; cells scale with the width of the hopper. */
cells cells_of(const frame *f, const aspect_case *c);
/* Mean height of the surface above the bottom. */
double surface_of(const frame *f, const aspect_case *c);

void bed_measure(aspect_case *c);
void flow_measure(aspect_case *c);
/* Parts of it. */
void discharge_measure(aspect_case *c, const results *r);
/* Fluctuation, arches and lowest rate of a discharge in percent whose linear part is known; NAN
 * where that is too short to hold two bins of BIN_S. */
void roughness_measure(flow_facts *f, const double *t, const double *out);
void walls_measure(aspect_case *c, const results *r);
double janssen_load(const aspect_case *c, double k, double depth); /* N/m */
void ratios_measure(aspect_case *c, results *r);
double shear_angle(const frame *f, const aspect_case *c, double band);
void heap_of(const frame *f, const aspect_case *c, double top[HEAP_BINS]);
double heap_slope(const double top[HEAP_BINS], double half_width); /* deg */
/* Mean height of the heap below the orifice over the depth of the chamber, m: 0 to 1. */
double heap_level(const double top[HEAP_BINS], double chamber);

typedef struct ratio_at {
    double summed[REGIONS + 1], mean[REGIONS + 1]; /* not logarithms; the last: everywhere */
} ratio_at;
ratio_at ratios_of(const frame *f, const aspect_case *c);

/* Angle of the x axis of a body in the plane, rad, from the horizontal, upwards; q: w x y z. */
double body_angle(const double q[4]);

typedef struct track {
    int count;
    double time[TRACK_MAX], x[TRACK_MAX], z[TRACK_MAX], angle[TRACK_MAX], vx[TRACK_MAX];
} track;
/* Left, centre, right; of each the upper, middle, lower one. Up to the frame before it leaves. */
void tracks_of(results *r, const aspect_case *c, track tracks[TRACKED]);
double turned_by(const track *t); /* rad, path of the angle above the bottom */

/* ---- summaries ------------------------------------------------------------------------------- */

typedef double fact(const aspect_case *c);

/* Values of one setting and variant; how many. */
int values_at(const aspect_study *s, int shape, int setting, int of_variant, fact *of,
              double value[REPLICATES_MAX]);
/* Over the replicates of a shape at the cheaper setting (the source's where there are none). Of a
 * time that is read off a series, no interval is narrower than a sample of it. */
interval over(const aspect_study *s, int shape, fact *of);
/* The same over the replicates of a variant. */
interval over_variant(const aspect_study *s, int of_variant, fact *of);
/* The source's setting alone; n = 0 without. */
interval at_thesis(const aspect_study *s, int shape, fact *of);

/* Tests with the replicates of each shape as the unit; NAN with fewer than two of a shape. Welch
 * and Satterthwaite's degrees of freedom throughout.
 *
 * One-sided P that the fact does not rise (sign 1) or fall (-1) over the aspect ratio, by the slope
 * of the means of the main shapes up to `shapes`. */
double trend_p(const aspect_study *s, fact *of, int sign, int shapes);
/* The same of each step from a shape to the next: the largest of their P, so that a small one shows
 * that every step goes that way. */
double steps_p(const aspect_study *s, fact *of, int sign, int shapes);
/* One-sided P that the fact of spheres is not above that of each longer main shape; the largest. */
double spheres_above_p(const aspect_study *s, fact *of);
/* One-sided P that shape a is not above shape b. */
double above_p(const aspect_study *s, fact *of, int a, int b);
/* One-sided P that the mean of the fact is not above 0 for each main shape; the largest. */
double positive_p(const aspect_study *s, fact *of);

/* Slope of the means over the aspect ratio; two-sided P, and that of every step going its way. */
typedef struct trend {
    interval slope;
    double p, p_steps;
} trend;
trend trend_of(const aspect_study *s, fact *of);

/* ---- the two settings, families of shapes ---------------------------------------------------- */

/* One fact at the source's setting less that at the cheaper one, over the main shapes: each shape
 * gives one difference, of its run at the source's setting from the mean of its replicates. */
typedef struct setting_fact {
    const char *row, *fact; /* of published.csv, where the margin stands; of FACTS */
    bool relative;          /* in percent of the mean of the replicates */
} setting_fact;
extern const setting_fact SETTING_FACTS[];
extern const int SETTING_FACT_COUNT;
interval setting_difference(const aspect_study *s, const setting_fact *f);

/* What tells shape from roughness: a is compared with b. */
typedef struct group {
    int shape, variant;
} group;
typedef struct contrast {
    const char *name, *what; /* what is varied */
    group a, b;
} contrast;
extern const contrast CONTRASTS[];
extern const int CONTRAST_COUNT;

typedef struct contrasted {
    interval a, b;
    double change, half, p; /* of a from b, 95 % and two-sided P by the pooled scatter */
    double df;              /* of that; 0: nothing to go by, all NAN */
} contrasted;
/* relative: change and scatter in percent; else as they are. There is no percentage of a mean of 0:
 * such a group adds nothing to the scatter, and a change from it is NAN. */
contrasted contrast_of(const aspect_study *s, const contrast *k, fact *of, bool relative);

/* One run beside replicates: does it lie outside of what one more of them would lie in (95 %)? */
bool stands_apart(interval replicates, double one);

/* A fact by name, with its unit, for tables. */
typedef struct named_fact {
    const char *name, *unit;
    fact *of;
} named_fact;
extern const named_fact FACTS[];
extern const int FACT_COUNT;
fact *fact_named(const char *name); /* aborts when there is none */

/* ---- writing --------------------------------------------------------------------------------- */

int aspect_write_tables(const aspect_study *s);
int aspect_write_maps(const aspect_study *s);
int aspect_pictures(const aspect_study *s);
int aspect_verdicts(const aspect_study *s);

#endif

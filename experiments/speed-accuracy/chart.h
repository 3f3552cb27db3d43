/* chart.h - error against cost: the points of the chart, their fronts, and what to pick.
 *
 * The chart has four parts: one collision (part_collision.c), a ball between two walls
 * (part_sandwich.c), the hopper discharge of S12 3.9.3 (part_discharge.c) and the button hopper of
 * A00 4.3 (part_buttons.c). tables.c writes all down, verdicts.c judges.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012.
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_SPEED_ACCURACY_CHART_H
#define CLAST_SPEED_ACCURACY_CHART_H

#include <stdbool.h>
#include <stdint.h>

#include "experiments/study/command.h"

/* ---- cost ------------------------------------------------------------------------------------ */

/* s of processor time per simulated second: median of batches or replicates, and the quartiles. All
 * NAN where nothing was timed. */
typedef struct chart_cost {
    double median, low, high;
} chart_cost;

/* n >= 0; what is not finite is left out. Sorts the samples. */
chart_cost cost_of(double *samples, int n);

/* One pass of a piece of work that is too short to be timed once. */
typedef struct work_done {
    double seconds;     /* of processor time, without setting it up */
    double simulated;   /* s */
    double evaluations; /* of forces */
} work_done;
typedef work_done work_pass(const void *what, int pass);

double processor_seconds(void); /* of this process so far */

/* Repeats passes until `least` s of processor time are measured, in COST_BATCHES batches at least;
 * least = 0: one pass, not timed. *evaluations: force evaluations per simulated second. */
enum { COST_BATCHES = 5 };
chart_cost cost_measure(work_pass *pass, const void *what, double least, double *evaluations);

/* ---- points ---------------------------------------------------------------------------------- */

/* One setting of one scene, judged by one quantity. */
typedef struct chart_point {
    const char *part;     /* "collision", "sandwich", "hopper-discharge", "button-hopper" */
    const char *scene;    /* which of the part's */
    const char *quantity; /* what the error is of */
    char family[32];      /* a scheme, or what is changed */
    char setting[48];     /* in words */
    double level;         /* steps per contact, or the factor of what is changed */
    double step;          /* s */
    chart_cost cost;
    double evaluations;      /* of forces, per simulated second; hopper-discharge: per run;
                                button-hopper: of element spheres of one body */
    double difference;       /* with its sign, where there is one; NAN */
    double error, low, high; /* relative; what the error lies between: `statistical`, the 95 %
                                interval of the size of the mean, else where in a step the contact
                                begins */
    bool statistical;
    bool reference;    /* what others are compared with: its error is 0 by definition */
    int samples;       /* pairs, or places in a step */
    double overlap;    /* largest, of a radius; NAN where it was not looked at */
    char message[160]; /* why there is no error, or why nobody should run it so; "" */
    /* set by chart_finish() */
    double bound; /* what the error can be said to be at most; INFINITY without one */
    bool front_cost, front_evaluations;
} chart_point;

typedef struct chart {
    chart_point *points;
    int count, room;
    uint64_t hash; /* of the last states of all runs */
} chart;

/* Returns the place of a copy. */
chart_point *chart_add(chart *c, const chart_point *p);
void chart_free(chart *c);

/* The interval of the mean difference does not hold zero. True of what is not statistical. */
bool chart_is_distinct(const chart_point *p);

bool chart_same_panel(const chart_point *a, const chart_point *b);

void chart_fold_hash(chart *c, uint64_t hash);

/* When all points are there: bounds, and the fronts of bound against either cost in every panel.
 *
 * Luck must not make a setting look good. The bound of a statistical error is the end of its
 * interval; of another one, the largest error of the same family at this level and all higher ones
 * (finer steps), because an error that happens to change its sign between two steps is no merit.
 * Bounds that agree in three digits are alike. References and points with a
 * message are on no front. */
void chart_finish(chart *c);

/* Slope of a front of bounds against force evaluations, points with `from` to `to` steps per
 * contact, as far as the scheme that is cheapest at the finest step goes. */
double chart_front_order(const chart *c, const chart_point *panel, double from, double to);

/* ---- what to pick ---------------------------------------------------------------------------- */

typedef enum chart_axis { CHART_COST, CHART_EVALUATIONS } chart_axis;
typedef bool chart_filter(const chart_point *p);

/* The cheapest setting of a panel whose bound is at most `tolerance`; NULL when there is none. The
 * reference of a panel counts, a point with a message does not. filter may be NULL. */
const chart_point *chart_pick(const chart *c, const chart_point *panel, double tolerance,
                              chart_axis axis, chart_filter *filter);

/* First point of a panel; NULL when there is none. */
const chart_point *chart_panel(const chart *c, const char *part, const char *scene,
                               const char *quantity);

/* ---- parts ----------------------------------------------------------------------------------- */

typedef struct chart_size {
    study_size size;
    const char *name;
    double least; /* s that short work is timed for */
    /* collision: steps per contact 2^(i/2) from 2 on; places in a step where it begins */
    int resolutions, places;
    /* sandwich: steps per decade, and the smallest, s */
    int per_decade;
    double finest;
    /* button hopper */
    int replicates;
    double button_step; /* s, of the reference: the thesis's 4.5 us; quick: twice that */
    const char *settle, *latest;
} chart_size;

extern const char *const PART_COLLISION, *const PART_SANDWICH, *const PART_DISCHARGE,
                                                                   *const PART_BUTTONS;

/* timed: false leaves processor time out. */
void collision_points(chart *c, const chart_size *size, bool timed);
void sandwich_points(chart *c, const chart_size *size, bool timed);

/* Reads runs.csv of the study hopper-discharge, of this size or the largest there is. Writes into
 * *note which one it was, or that there is none; what was compared goes into folder/discharge.csv.
 * 0, or 4 when that cannot be written. */
int discharge_points(chart *c, const chart_size *size, const char *studies, const char *folder,
                     char note[200]);

/* Runs what is not kept from an earlier start below `root`; writes one line per run into
 * folder/button_runs.csv. Returns the number of runs that failed for another reason than their
 * setting. */
int button_points(chart *c, const chart_size *size, const char *root, const char *folder);

/* ---- the study ------------------------------------------------------------------------------- */

/* Error that can be accepted. */
enum { TOLERANCES = 3 };
extern const double TOLERANCE[TOLERANCES];

/* tables.c: 0, or 4 when a file cannot be written. */
int chart_write_tables(const chart *c, const chart_size *size, const char *discharge_note,
                       const char *folder);

/* verdicts.c: prints and writes the comparison; 0 when none is missed. */
int chart_verdicts(const chart *c, const char *csv);

#endif

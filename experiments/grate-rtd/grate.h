/* grate.h - the moving grates of S12 section 3.9.4 and chapter 4: what is run, what is read off the
 * runs, what is written.
 *
 * plan.c lists the cases; bed.c reads height and bulk density off the frames of one run, measure.c
 * puts them beside its residence times (experiments/rtd); verdicts.c, tables.c and pictures.c write
 * down what came out.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012. */
#ifndef CLAST_GRATE_H
#define CLAST_GRATE_H

#include <stdbool.h>
#include <stdio.h>

#include "experiments/rtd/rtd.h"
#include "experiments/run/results.h"
#include "experiments/study/command.h"
#include "experiments/study/jobs.h"
#include "experiments/study/statistics.h"

enum { CASE_SETTINGS = 8, CASES_MAX = 120, SIZES = 4 };

/* ---- cases ----------------------------------------------------------------------------------- */

typedef enum grate_group {
    GROUP_MAIN,     /* S12 4.6.1 to 4.6.3 */
    GROUP_FEED,     /* 4.6.4, the scan of the feed; at 20 kg/h it is a case of the first group */
    GROUP_FEED_10X, /* the same at ten times the speed, 20 kg/h too */
    GROUP_SEED,     /* what another seed does to a case of the first group */
    GROUP_WIDTH,    /* 4.7.1 */
    GROUP_FAST,     /* 3.9.4, bars at 35 mm/s */
    GROUP_PACKING,  /* 4.3, poured beds between side walls */
    GROUP_FILM,     /* none of its numbers is used */
    GROUP_VARIANT   /* what an assumption does to a case of the first group */
} grate_group;

typedef enum grate_device { FORWARD, BACKWARD, STAIRS } grate_device; /* Tables 4.1 and 4.7 */

typedef struct grate_case {
    const char *name;
    grate_group group;
    grate_device device;
    const char *scene;              /* file of this folder */
    const char *set[CASE_SETTINGS]; /* "name=value" up to NULL */
    double hours[SIZES]; /* of the published speed of the bars, at each size; 0: not part of it */
    double feed;         /* kg/h: of 1 m of grate; in GROUP_FAST of the channel; 0: no grate */
    double diameter;     /* m, the largest */
    double across;       /* width in largest diameters */
    int replicates;      /* by seed; 0 reads as 1 */
    double pitch;        /* m; 0: bars lie on each other */
    const char *assumption; /* GROUP_VARIANT, GROUP_SEED: what is varied, and of which case */
    const char *of;
} grate_case;

extern const grate_case CASES[];
extern const int CASE_COUNT;

#define SAMPLING 180.0 /* s, S12 4.7.2 */

/* Of the bars that lie on each other: height / sin(20 deg), m. */
#define PITCH 0.087714

double case_slope(const grate_case *c); /* rad, of the grate, rising towards +x */
double case_pitch(const grate_case *c);
double case_width(const grate_case *c); /* m */

/* Bars, pauses and feed run so many times faster than published, and times count so many times: a
 * bed that creeps from stroke to stroke knows no other clock. 1: as published. */
double case_speed_up(const grate_case *c, study_size size);

double case_bar_speed(const grate_case *c, study_size size); /* m/s, in the run */

/* ---- what is read off ------------------------------------------------------------------------ */

/* Means over the frames of the steady part. Bodies that fall in the air are no part of the bed. */
typedef struct grate_bed {
    interval height;  /* m, across the grate, from the bars to the tops of the bodies */
    interval outline; /* m, to the outline, dips between the topmost bodies included */
    interval bodies;
    interval packing; /* solid volume over that below the tops */
    interval lying;   /* of the bodies, those slower than 10 mm/s: what bars at 3.5 mm/s carry */
    int frames;
} grate_bed;

/* Frames from `from` (s) on. */
grate_bed bed_of(results *r, const grate_case *c, double from);

/* One frame: m, m, number, share of the volume, number. */
typedef struct bed_look {
    double height, outline, bodies, packing, lying;
} bed_look;

bed_look bed_look_at(const grate_case *c, const stage *s, const frame *f);

/* One run. */
typedef struct grate_result {
    const grate_case *of;
    int replicate; /* from 0 */
    const char *folder;
    double speed_up;       /* times below are as at the published speed */
    double processor_time; /* s; NAN when it was not done in one piece */
    passages *passages;
    rtd *rtd; /* NULL: no run, or too few tracers */
    grate_bed bed;
    double steps;
} grate_result;

typedef struct grate_study {
    study_size size;
    char root[600], data[640], frames[640];
    job jobs[CASES_MAX];
    int count;
    grate_result results[CASES_MAX];
} grate_study;

void grate_plan(grate_study *s);
int grate_run_all(grate_study *s); /* number of failed runs */
void grate_measure(grate_study *s);
void grate_forget(grate_study *s);

/* NULL when the size has no such case, or it failed, or has no distribution. */
const grate_result *result_of(const grate_study *s, const char *name);

/* ---- comparisons ----------------------------------------------------------------------------- */

/* a - b of independent runs, as an interval over blocks. */
interval difference_of(interval a, interval b);
/* (a - b) / b, to first order in the errors. */
interval relative_difference(interval a, interval b);
/* a / b, likewise. */
interval ratio_of(interval a, interval b);

/* Whether a case is one of the feeds of clay on the backward grate: at the published speed (at
 * `brief` at ten times the speed, like its other cases), or of the scan at ten times. */
bool in_scan(const grate_case *c, bool hurried);

/* Slope of ln(mean residence time) on ln(feed), weighted by the errors of the means; wider where
 * these do not explain the scatter about the line. */
interval slope_with_feed(const grate_study *s, bool hurried);

/* Mean from a sampled curve over that from another (S12 4.7.2): middles of the intervals. */
double sampled_mean(const rtd *r, double sampling);
double sampled_variance(const rtd *r, double sampling);

/* ---- poured beds (S12 4.3) ------------------------------------------------------------------- */

double packing_published(double across); /* of the solid density: 4.8, 4.10; INFINITY: 4.9 */
interval packing_over(const grate_study *s, const char *name); /* over replicates */

/* ---- writing --------------------------------------------------------------------------------- */

int grate_write_tables(const grate_study *s);
int grate_pictures(const grate_study *s);
int grate_verdicts(const grate_study *s, const char *path);

#endif

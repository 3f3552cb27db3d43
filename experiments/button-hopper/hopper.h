/* hopper.h - the button hopper of A00 section 4.3: what is run, what is measured, what is written.
 *
 * plan.c says which runs there are, measure.c reads one run as the experimenter read his video,
 * summary.c turns replicates into the numbers of the source, tables.c and pictures.c write them
 * down, verdicts.c puts them beside the published ones. */
#ifndef CLAST_BUTTON_HOPPER_H
#define CLAST_BUTTON_HOPPER_H

#include "experiments/study/jobs.h"
#include "experiments/study/statistics.h"

/* ---- constants of the source (A00 section 4.3.1, Table 4.3) ---------------------------------- */

#define BUTTON_A_CM                                                                                \
    0.69 /* half axes: Table 4.3 calls them diameters, eq. 4.6 uses them as halves */
#define BUTTON_B_CM      0.53
#define BUTTON_MASS_G    0.332
#define BUTTON_DIAMETER  1.2 /* cm, 2 sqrt(a b) as A00 rounds it, eq. 4.6 */
#define BIN_WIDTH_CM     15.0
#define BAND_HEIGHT_CM   9.0  /* Fig. 4.18 */
#define VIDEO_FRAME_S    0.04 /* 25 frames/s */
#define KD_EXPERIMENT_CM 0.89 /* 4.3.2.5; all C of Tables 4.4 and 4.5 are for it */

enum { BUTTONS = 200, ORIFICES = 5, FILLS = 2, REPLICATES_MAX = 20, VARIANTS_MAX = 32 };
enum { FRICTIONLESS, FRICTIONAL };

extern const double ORIFICE_CM[ORIFICES];
extern const char *const FILL_NAME[FILLS];

/* ---- what we chose (README.md, "Assumptions") ------------------------------------------------ */

#define LINEAR_R2   0.99          /* the linear part of a cumulative curve */
#define ARCH_MIN_S  VIDEO_FRAME_S /* a pause that leaves a video frame without a discharge */
#define PAUSE_MIN_S 0.015         /* the longest of these is reported and drawn, arch or not */
#define ARCH_PART                                                                                  \
    0.8 /* of what flows out in all: behind it the last buttons trickle from the heap */
#define BLOCKED_LEFT 50 /* more left than this, and nothing moves: the orifice is blocked */

/* ---- sizes ----------------------------------------------------------------------------------- */

typedef struct hopper_size {
    const char *name;
    int replicates[FILLS];
    bool orifice[ORIFICES];
    const char *step;           /* of the time step, with unit */
    const char *settle;         /* time to settle, with unit */
    int sensitivity_replicates; /* 0: no sensitivity table */
} hopper_size;

/* NULL when there is no such size. */
const hopper_size *hopper_size_named(const char *name);

/* ---- one run --------------------------------------------------------------------------------- */

typedef struct hopper_run {
    int fill, orifice, replicate;
    int bed;            /* index of its filling among the beds */
    const char *folder; /* of the discharge */
    bool ran;           /* false: the run itself failed */
    /* as measured */
    linear_window steady;          /* g/s */
    int middle_first, middle_last; /* samples of the middle half of it, by mass */
    double middle_from, middle_to; /* s */
    double rate[3]; /* g/s at LINEAR_R2, and at a looser and a stricter one; NAN without a linear
                       part */
    bool blocked;
    int left; /* buttons above the orifice at the end */
    double phi_rest,
        phi_rest_top; /* solid fraction before the flow: mean outline, and top of each section */
    double phi_flow, rho_flow; /* mean over the middle half; rho in g/cm2 */
    double c;                  /* A00 4.5 with kd = 0.89 cm, per cm */
    int arch_count;            /* pauses of ARCH_MIN_S and more while the bed flows */
    arch pause;                /* the longest pause then; length 0 without one */
    double residual; /* largest |energy residual| over the energy put in so far, at the end */
    int velocity_count;
    double *velocity_x, *velocity; /* cm, m/s: band at 9 cm, displacement over one video frame */
} hopper_run;

extern const double RATE_R2[3];

typedef struct hopper_study {
    const hopper_size *size;
    char root[500], data[560]; /* folders */
    job *beds, *flows;
    int bed_count, flow_count;
    hopper_run *runs; /* one per flow */
    int processes;
    double seconds; /* of wall time spent */
} hopper_study;

/* plan.c */
void hopper_plan(hopper_study *s);
int hopper_run_all(hopper_study *s); /* number of failed runs */

/* measure.c */
void hopper_measure(hopper_run *r);

/* ---- summaries ------------------------------------------------------------------------------- */

/* Over the replicates of one fill and orifice that have a rate. */
typedef struct hopper_mean {
    interval q, rho, phi, c;
    interval q_r2[3];
    int runs, blocked, with_arch;
    double longest_pause; /* s */
} hopper_mean;

typedef struct hopper_profile {
    interval mean, sd, b_cm; /* m/s, m/s, cm: over the replicates */
    double v0, pooled_b_cm;  /* kinematic fit of all samples as A00 did it */
    kinematic free;          /* the same with v0 free */
} hopper_profile;

typedef struct hopper_summary {
    hopper_mean mean[FILLS][ORIFICES];
    interval rest[FILLS], rest_top[FILLS];
    beverloo fit, fit_wide; /* frictionless fill, all replicates; D >= 7.5 cm alone */
    interval c_all;         /* mean C of the five orifices: A00 averages over orifices */
    interval error_percent; /* mean |error| of the rates, with the interval of the replicates */
    hopper_profile profile[ORIFICES];
    double worst_residual;
} hopper_summary;

/* Published numbers that the summary and the tables need (published.csv). */
typedef struct hopper_published {
    double q_experiment[ORIFICES], q_thesis[ORIFICES];
    double rho_experiment[ORIFICES], rho_thesis[ORIFICES];
    double c_experiment[ORIFICES], c_thesis[ORIFICES];
} hopper_published;

hopper_summary hopper_summarise(const hopper_study *s, const hopper_published *p);

/* ---- sensitivity ----------------------------------------------------------------------------- */

typedef struct hopper_variant {
    int orifice;
    char assumption[64], variant[64];
    interval q, rest;
    int blocked;
} hopper_variant;

typedef struct hopper_sensitivity {
    int count;
    hopper_variant variants[VARIANTS_MAX]; /* the first of each orifice is its baseline */
} hopper_sensitivity;

/* Runs and measures all variants; count = 0 when the size has none. */
int hopper_sensitivity_run(const hopper_study *s, hopper_sensitivity *out);

/* ---- writing --------------------------------------------------------------------------------- */

/* tables.c: all of data/ (figures/README.md lists the columns). Returns 0, or 4 when a file cannot
 * be written. */
int hopper_write_tables(const hopper_study *s, const hopper_summary *m, const hopper_published *p,
                        const hopper_sensitivity *v);

/* pictures.c: frames of chosen runs, through the `clast render` command beside this program. */
int hopper_pictures(const hopper_study *s);

/* verdicts.c: prints the comparison and writes it; 0 when none is missed. */
int hopper_verdicts(const hopper_study *s, const hopper_summary *m, const hopper_published *p,
                    const char *csv);
hopper_published hopper_read_published(void);

#endif

/* collision.h - single head-on collisions of a sphere with a wall, S12 sections 2.6, 2.7 and 3.4:
 * what is run, what it is held against, what is written.
 *
 * trial.c runs the engine, impacts.c the impact models beside their closed forms, schemes.c the
 * time stepping schemes at a few steps per contact beside the exact solution, statements.c what S12
 * says of them, tables.c writes all down, verdicts.c judges. */
#ifndef CLAST_COLLISION_H
#define CLAST_COLLISION_H

#include <stdio.h>

#include "engine/clast.h"
#include "experiments/theory/amplification.h"
#include "experiments/theory/impact.h"

/* ---- one collision in the engine ------------------------------------------------------------- */

/* A sphere of 10 mm comes down on a plane of the same material. */
#define BALL_RADIUS  0.005 /* m */
#define BALL_DENSITY 2500.0
#define BALL_POISSON 0.25
#define BALL_YOUNG   1e8 /* Pa, where it is not varied */
#define LINEAR_STIFF 1e5 /* N/m, likewise */
#define IMPACT_SPEED 0.5 /* m/s, likewise */

typedef struct trial {
    clast_law law;
    clast_scheme scheme;
    double young, stiffness; /* Pa, N/m */
    double restitution;      /* that the engine is asked for */
    double dissipation;      /* s, Brilliantov alone */
    double speed;            /* m/s */
    double step;             /* s */
    int lead;                /* whole steps of free flight before the first touch */
    double late;             /* of a step, after which the touch comes still; in [0, 1) */
    int steps;               /* in all */
} trial;

typedef struct trial_point {
    double time;                 /* s, from the first touch */
    double overlap, rate, force; /* m, m/s, N; overlap < 0 while apart */
} trial_point;

/* points: room for steps + 1. */
void trial_run(const trial *t, trial_point *points);

/* Balls side by side that do not meet: the touches come in `count` places of a step, equally far
 * from each other; t->late is not read. points: those of the first ball, then those of the next,
 * steps + 1 of each; without forces. trial_row_new(): before the first step, for
 * clast_world_free(). */
void trial_row_run(const trial *t, int count, trial_point *points);
clast_world *trial_row_new(const trial *t, int count);

double trial_mass(void);            /* kg */
double trial_modulus(double young); /* Pa, E* of two bodies of that material */

/* Hash of the last states of all trials so far, in their order. */
uint64_t trials_hash(void);

/* ---- impact models --------------------------------------------------------------------------- */

/* One law at one speed, resolved finely, beside theory. */
typedef struct impact_case {
    char name[32]; /* of the law, as in the tables */
    trial trial;
    impact theory; /* closed form, or the reference integration */
    bool closed;   /* it is a closed form */
    impact measured;
    double worst_overlap, worst_rate; /* largest differences of the curves, of the largest overlap
                                         and the speed */
} impact_case;

enum { IMPACT_RESOLUTION = 1000 }; /* steps per contact */

/* Fills theory and measured of a case whose law, speed and materials are set; writes the curve
 * beside it into `curve` (series, label) when it is not NULL. */
void impact_case_run(impact_case *c, FILE *curve, const char *series);

/* What theory says of a trial, whatever its step and scheme; and how long the contact would last
 * without damping, s. */
impact trial_theory(const trial *t);
double trial_contact_time(const trial *t);

/* ---- schemes --------------------------------------------------------------------------------- */

enum { SCHEME_POINTS = 64 };

/* How the collision is set up: what S12 leaves open, README.md. */
typedef struct scheme_setup {
    const char *name;
    bool solved_dashpot; /* the dashpot rebounds with e; else S12 2.21 */
    bool short_contact;  /* contact resolution of the time until the force ends; else S12 2.22 */
    double late;         /* where in a step the touch comes */
} scheme_setup;

extern const scheme_setup SCHEME_SETUPS[];
extern const int SCHEME_SETUP_COUNT; /* the first is the one of the figures */

typedef struct scheme_run {
    clast_scheme scheme;
    double resolution, restitution;
    int count;   /* steps from the touch until the exact contact ends, and two more */
    double step; /* s */
    double time[SCHEME_POINTS];                         /* s */
    double overlap[SCHEME_POINTS], rate[SCHEME_POINTS]; /* of the engine; m, m/s */
    double exact_overlap[SCHEME_POINTS], exact_rate[SCHEME_POINTS];
    double overlap_unit, speed;       /* m, m/s: what the figures are normalised by */
    double overlap_error, rate_error; /* largest during the contact, in these units */
    double overlap_max, overlap_max_exact;
    double loading_error, unloading_error; /* of the overlap, before and after it is largest */
    double overlap_last_error;             /* at the last step within the exact contact */
    double first_rate_excess; /* at the first step within it: |rate| less the exact one */
    double first_overlap_excess;
    double rebound, rebound_exact; /* m/s */
    double map_difference; /* of the overlap from the amplification matrix while both hold, in units
                              of overlap_unit */
} scheme_run;

scheme_run scheme_collide(clast_scheme scheme, double resolution, double restitution,
                          const scheme_setup *setup);

/* Every scheme at contact resolutions 4 and 8, e = 1 and 0.5: Figs 2.24 to 2.31 and 3.1 to 3.3. */
typedef struct scheme_set {
    scheme_run run[2][2][CLAST_SCHEMES];
} scheme_set;
extern const double SCHEME_RESOLUTION[2], SCHEME_RESTITUTION[2];

/* One set per set-up, for free(). */
scheme_set *scheme_sets_run(void);

/* What S12 says of these collisions, as a number that a set of them has (statements.c). */
typedef struct statement {
    const char *quantity; /* row of published.csv */
    double (*value)(const scheme_set *s);
} statement;
extern const statement STATEMENTS[];
extern const int STATEMENT_COUNT;

/* Rebound over the exact one, mean of the error, worst and spread over many places within a step
 * where the contact can begin. */
typedef struct onset_error {
    double mean, rms, worst;
} onset_error;
onset_error scheme_onset_error(clast_scheme scheme, double resolution, double restitution,
                               int places);

/* ---- the study ------------------------------------------------------------------------------- */

typedef struct collision_study {
    const char *size;
    int places; /* of onset */
    char data[560];
} collision_study;

/* tables.c: runs everything, writes data/. Returns 0, or 4 when a file cannot be written. */
int collision_write_tables(const collision_study *s);

/* verdicts.c: runs what is judged, prints and writes the comparison; 0 when none is missed. */
int collision_verdicts(const char *csv);

#endif

/* sandwich.h - a ball between two walls, S12 sections 3.9.1 and 3.9.2, and the limits and orders of
 * every scheme on it.
 *
 * ball.c runs the engine, oscillation.c the sandwich of S12 3.9.1, approach.c the touch of 3.9.2,
 * limits.c the largest steps beside those of theory, orders.c the orders of convergence; tables.c
 * writes all down, verdicts.c judges. SI units. */
#ifndef CLAST_SANDWICH_H
#define CLAST_SANDWICH_H

#include <stdio.h>

#include "engine/clast.h"
#include "experiments/study/command.h"
#include "experiments/theory/amplification.h"
#include "experiments/theory/impact.h"

/* ---- the ball, S12 Table 3.1 ----------------------------------------------------------------- */

#define BALL_RADIUS    0.004  /* m */
#define BALL_DENSITY   2520.0 /* kg/m3 */
#define BALL_STIFFNESS 250.0  /* N/m, of one contact */

double ball_mass(void);      /* kg */
double ball_frequency(void); /* rad/s, sqrt(k/m): of one contact */
double ball_contact(void);   /* s, pi over it: S12 2.22 without damping */

typedef struct ball_def {
    clast_scheme scheme;
    double restitution;      /* of one collision */
    double step;             /* s */
    double gap;              /* m, from the middle to each wall; below the radius: pressed */
    bool single;             /* the lower wall alone */
    double x, v;             /* m, m/s, at the start, up from the middle */
    double max_overlap;      /* of the radius: what the guard lets pass */
    double max_displacement; /* of the radius in a step, likewise; 0: any */
    double max_residual;     /* of the energy, likewise; 0: any */
    int row;                 /* balls side by side that all do the same; 0: one */
} ball_def;

clast_world *ball_new(const ball_def *def);

/* Pressed by a tenth of the radius on either side, so that neither contact opens: an oscillator of
 * frequency sqrt(2 k/m) with the damping ratio of one contact of that restitution. h: frequency
 * times step. The guard lets the overlap grow by `room` of the radius. */
ball_def ball_pressed(clast_scheme scheme, double restitution, double h, double room);
double ball_pressed_frequency(void); /* rad/s */

void ball_free(clast_world *w);
double ball_x(clast_world *w);
double ball_v(clast_world *w);

/* Hash of the last states of all runs so far, in their order. */
uint64_t ball_hashes(void);

/* ---- S12 3.9.1: one wall at a time ----------------------------------------------------------- */

#define OSCILLATION_TIME  0.45 /* s */
#define OSCILLATION_FROM  0.4  /* s, where the source looks */
#define OSCILLATION_START 0.15 /* of the radius */
#define STEP_SMALL        1e-4 /* s */
#define STEP_LARGE        1e-3
#define STEP_TOO_LARGE    3.5e-3

typedef struct oscillation {
    clast_scheme scheme;
    double step;         /* s */
    int count;           /* points: the start, and one per step */
    double *x;           /* m */
    bool thrown;         /* the centre has passed a wall: the guard on the overlap ended the run */
    double error;        /* largest of x, of the amplitude; INFINITY when thrown */
    double window_error; /* likewise, from OSCILLATION_FROM on */
    double window_most;  /* largest |x| there, of the amplitude */
    double angle;        /* rad per step, that x turns by; NAN when it cannot be told */
    double decay;        /* factor per step, likewise */
} oscillation;

oscillation oscillation_run(clast_scheme scheme, double step);
void oscillation_free(oscillation *o);
double oscillation_exact(double time); /* m: S12 3.56 */

/* rad by which a motion that turns by `angle` per step is ahead of the exact one: per period of the
 * latter, and at a time. */
double lead_per_period(double step, double angle);
double lead_at(double step, double angle, double time);

/* The same as a reader of one figure sees it: in (-pi, pi]. */
double lead_seen(double lead);

/* ---- S12 3.9.2: a ball meets a wall ---------------------------------------------------------- */

#define APPROACH_SPEED      0.5 /* m/s */
#define APPROACH_RESOLUTION 1.2

/* Largest overlap at any step over that of the exact solution; fraction: of a step before the
 * touch (S12 3.57), in [0, 1]. */
double approach_overlap(clast_scheme scheme, double resolution, double fraction);

/* ---- limits ---------------------------------------------------------------------------------- */

/* Both contacts closed: a linear oscillator. Its steps are h = w dt, its damping ratio is that of
 * one contact with the restitution of the map. */
typedef struct step_limit {
    clast_scheme scheme;
    double restitution, damping;
    bool upper;              /* stable below, failing above; else the other way round */
    double theory, measured; /* h */
    double resolution_theory, resolution_measured; /* steps in a contact */
    int steps; /* at 1.05 of the limit, or its inverse, until the guard stops the run; -1: never */
    double predicted; /* the same by the growth per step */
} step_limit;

enum { LIMITS_PER_SCHEME = 2 * SCHEME_RANGES_MAX };

/* All limits of a scheme at a restitution, in rising order; those of theory are looked for. budget:
 * steps after which a run is taken for one that holds. Returns their number. */
int limits_measure(clast_scheme scheme, double restitution, int budget,
                   step_limit limits[LIMITS_PER_SCHEME]);

/* h times this is steps per contact: w times the duration of a collision, S12 2.22 where the force
 * ends when it would pull. */
double contact_phase(double restitution);

typedef struct quiet_run {
    double step;     /* h: a tenth of the limit without damping */
    int steps;       /* done */
    bool alarm;      /* of a guard, all of them as set by default but for the press */
    bool deserved;   /* the scheme has lost that much energy in theory, too */
    double residual; /* of the energy put in */
    double lost;     /* the part of it that the scheme loses in theory */
    char words[200]; /* of the alarm */
} quiet_run;

/* Only where the limit is a number above 0. */
quiet_run quiet_at_a_tenth(clast_scheme scheme, int steps);

/* ---- orders ---------------------------------------------------------------------------------- */

enum { ORDER_POINTS = 12 };
#define ORDER_RESTITUTION 0.7 /* with damping */

typedef struct convergence {
    clast_scheme scheme;
    double restitution;
    bool onset; /* a collision; else both contacts closed */
    int count;
    double resolution[ORDER_POINTS];         /* steps per contact, or per half period */
    double x[ORDER_POINTS], v[ORDER_POINTS]; /* errors, of the amplitude */
    double order_x, order_v;                 /* slopes of the finest steps above rounding */
} convergence;

/* finest: power of two of the most steps, <= ORDER_POINTS + 1. */
convergence converge_smooth(clast_scheme scheme, double restitution, int finest);
convergence converge_onset(clast_scheme scheme, double restitution, int finest);

/* ---- the study ------------------------------------------------------------------------------- */

typedef struct sandwich_size {
    int fractions;    /* of a step before the touch */
    int restitutions; /* of the map */
    int curve;        /* of its lines of theory */
    int budget;       /* steps that a run at a limit may take */
    int quiet;        /* steps at a tenth of the step_limit */
    int finest;
} sandwich_size;

typedef struct sandwich_map {
    int count;
    step_limit *limits; /* for free() */
} sandwich_map;

sandwich_map map_measure(const sandwich_size *size);

/* tables.c: runs everything, writes the folder. Returns 0, or 4 when a file cannot be written. */
int sandwich_write_tables(const sandwich_size *size, const char *name, const char *folder);

/* verdicts.c: runs what is judged, prints and writes the comparison; 0 when none is missed. */
int sandwich_verdicts(const sandwich_size *size, const char *csv);

#endif

/* discharge.h - 2010 steel spheres leave a hopper, an explicit scheme beside an implicit one, S12
 * section 3.9.3.
 *
 * bed.c builds the hopper and settles its filling, flow.c runs one discharge, network.c finds the
 * largest frequency of a bed, history.c follows it, kept.c works many results out side by side,
 * plan.c says which there are, limits.c looks for the steps at which runs fail, price.c for what
 * they cost; summary.c draws them together, tables.c, pictures.c and verdicts.c write them down.
 * SI units.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012. */
#ifndef CLAST_HOPPER_DISCHARGE_H
#define CLAST_HOPPER_DISCHARGE_H

#include <stdio.h>

#include "engine/clast.h"
#include "experiments/study/command.h"
#include "experiments/study/side.h"
#include "experiments/study/statistics.h"

/* ---- the spheres, S12 Table 3.2 -------------------------------------------------------------- */

#define STEEL_DENSITY  7850.0 /* kg/m3 */
#define STIFFNESS      1000.0 /* N/m, of a contact */
#define DIAMETER_LEAST 0.008  /* m */
#define DIAMETER_MOST  0.012  /* m */
#define GRAVITY        9.81   /* m/s2 */

enum {
    COLUMNS = 30, /* of the lattice that the filling falls from: README.md, "Assumptions" */
    ROWS = 67,
    SPHERES = COLUMNS * ROWS, /* 2010 */
    SIZES = 200,              /* classes of diameters, 0.02 mm apart */
    TRACER_EVERY = 10,        /* 201 tracers */
    TRACERS = SPHERES / TRACER_EVERY
};

double sphere_radius(int size); /* m, of a class */
double sphere_mass(int size);   /* kg */

/* s: of two of the smallest spheres, S12 2.22. */
double shortest_contact(void);

/* ---- the hopper ------------------------------------------------------------------------------ */

typedef enum filling {
    FILL_SETTLED, /* from a lattice into the closed hopper, until it is at rest */
    FILL_LOOSE    /* the lattice itself, which begins to fall when the orifice opens */
} filling;

typedef enum size_law {
    SIZES_UNIFORM, /* of diameters */
    SIZES_INVERSE  /* 1/d is uniform: as many of each size by area */
} size_law;

typedef struct hopper {
    double orifice; /* m, between the walls where the spheres leave, at z = 0 */
    double slope;   /* m outwards per m upwards, of the funnel's walls */
    double funnel;  /* m, its height; vertical walls above */
    bool flat;      /* no funnel: a flat bottom, and side walls as far apart as the funnel's top */
    bool solid;     /* walls are half-spaces, and spheres are gone below the orifice; else plates
                       that end there, and spheres that fall on */
    filling filling;
    size_law sizes;
    int rows; /* of the lattice */
} hopper;

hopper hopper_usual(int rows);
double hopper_latest(const hopper *h); /* s, that a discharge is watched for */

typedef struct hopper_wall {
    const char *name;
    double nx, nz; /* unit normal, towards the spheres */
    double px, pz; /* m, where the wall ends at the bottom */
    double length; /* m, from there upwards: what plates have */
} hopper_wall;

enum { HOPPER_WALLS = 4 };

void hopper_walls(const hopper *h, hopper_wall walls[HOPPER_WALLS]);

/* Of the radius: 1 where the centre is on a wall, 2 where the sphere is wholly behind it. */
double wall_overlap(const hopper_wall walls[HOPPER_WALLS], double x, double z, double radius);

/* ---- beds and worlds ------------------------------------------------------------------------- */

/* Plain data: kept on disk as it is. */
typedef struct bed {
    int count;
    int size[SPHERES];             /* class of each sphere, by id */
    double x[SPHERES], z[SPHERES]; /* m */
    bool tracer[SPHERES];
    double fastest; /* m/s, when the damping was taken away and all spheres were stopped */
    double settled; /* s, until then */
} bed;

/* Everything random is drawn from the seed. */
void bed_make(const hopper *h, uint64_t seed, bed *b);

double bed_mass(const bed *b); /* kg */

typedef struct world_plan {
    clast_scheme scheme;
    double step;      /* s */
    double tolerance; /* of Newton's method, of the smallest radius; 0: as the engine has it */
    bool relaxes;     /* Gauss-Seidel, as in S12, in place of conjugate gradients */
} world_plan;

/* Of the radius: a sphere is then wholly behind a wall, or wholly in another. */
#define OVERLAP_LIMIT 2.0

/* The open hopper, all spheres at rest, no dissipation; ids as in the bed. */
clast_world *world_open(const hopper *h, const bed *b, const world_plan *plan);

/* ---- the contact network --------------------------------------------------------------------- */

typedef struct network {
    double largest;      /* rad/s: the fastest vibration that the closed contacts allow */
    double alone;        /* rad/s: likewise of one sphere while its neighbours stand still */
    double coordination; /* contacts per sphere, those with walls once */
    double overlap;      /* mean, of the mean radius */
    int spheres;
} network;

/* The spheres as masses, every closed contact as its stiffness along its normal and, between
 * spheres, minus force over distance across it. Largest eigenvalue by Lanczos' method: the bed is
 * stable in a scheme while largest * step is below the scheme's limit. */
network network_of(clast_world *w, double stiffness);

typedef struct network_moment {
    double time; /* s */
    network network;
} network_moment;

enum { HISTORY_POINTS = 101 };

typedef struct network_history {
    int count;
    network_moment moment[HISTORY_POINTS];
} network_history;

/* While the bed flows, at a step that resolves every contact. */
void history_run(const hopper *h, const bed *b, double every, network_history *out);

/* ---- one discharge --------------------------------------------------------------------------- */

typedef enum failure {
    FAILED_NOT,
    FAILED_WALL,   /* spheres are through the walls, as many as MANY_THROUGH */
    FAILED_SPHERE, /* a sphere is wholly in another, or a force is not a number */
    FAILED_NEWTON, /* Newton's method did not converge */
    FAILED_ENERGY, /* ten times the energy of the bed was made */
    FAILED_LEFT,   /* more than that are still inside at the end */
    FAILURES
} failure;

extern const char *const FAILURE_NAME[FAILURES];

#define HEATED_AT        0.05 /* of the bed's energy: what the engine's guard lets pass, too */
#define MANY_THROUGH     0.01 /* of the spheres */
#define SPAN_PART        0.95 /* of the mass is out when counting and timing end */
#define RESIDENCE_LATEST 3.0  /* s, by when all are out but a few that bounce alone */
#define FLAT_LATEST      10.0 /* s, likewise where they have to find the orifice */

/* Plain data: kept on disk as it is. */
typedef struct flow {
    double residence, residence_sd; /* s, of the tracers, by mass (S12 3.58); NAN when stopped */
    double residence_all;           /* s, of all spheres, likewise */
    double bed_energy;    /* J: height above the orifice and elastic energy, at the start */
    double energy_error;  /* at the end, of that: made > 0, lost < 0 */
    double energy_worst;  /* the largest at any look, without sign */
    double heated;        /* s, when it first passed HEATED_AT; NAN: never */
    failure failed;       /* what stopped the run, and when */
    double stopped;       /* s; NAN: it came to its end */
    double overlap;       /* with a wall, of the radius, largest */
    double first_through; /* s; NAN: no sphere is through a wall */
    int through, trapped; /* spheres, at the end */
    double span;          /* s, that the next five are counted over */
    double cpu;           /* s, of the engine's steps */
    double evaluations, newton, linear, steps;
    double unconverged; /* steps of the whole run */
} flow;

typedef struct flow_plan {
    const hopper *hopper;
    const bed *bed;
    world_plan world;
    double until; /* s */
} flow_plan;

void flow_run(const flow_plan *plan, flow *out);

/* Which came first: "", "energy", or the name of what stopped it. */
const char *flow_failure(const flow *f);

/* ---- results that are kept ------------------------------------------------------------------- */

enum { NAME_MAX_TEXT = 120 };

typedef struct kept_task {
    const char *what; /* for the line of progress */
    size_t size;      /* bytes of a result: plain data */
    int processes;    /* at a time; 0: as many as there are processors */
    const void *context;
    /* What makes the result what it is, beside this program. */
    void (*name)(const void *context, int which, char name[NAME_MAX_TEXT]);
    side_work *work;
} kept_task;

/* Fills results[0..count): from the disk what an earlier start of the same program has left, the
 * rest side by side, each in a process of its own. Exits with 4 when a process dies. */
void kept_results(const kept_task *task, int count, void *results);

/* ---- what is run ----------------------------------------------------------------------------- */

enum { LEAPFROG, EXPLICIT, IMPLICIT, METHODS };
enum { STEPS = 5, SCANS = 12, STATES_MAX = 12, VARIANTS = 10, CRITERIA = 3 };
enum { BY_WALL, BY_STOP, BY_ENERGY };

extern const clast_scheme METHOD_SCHEME[METHODS];
extern const double STEP[STEPS]; /* s, of the residence times */
extern const double SCAN[SCANS]; /* s, beyond, where runs fail */
extern const char *const CRITERION_NAME[CRITERIA];

typedef struct discharge_size {
    int rows, states;
    int first_step;     /* in STEP */
    int scans;          /* of SCAN */
    int halvings;       /* of the last interval of the scan */
    int variant_states; /* 0: no sensitivity table */
} discharge_size;

typedef struct hopper_variant {
    const char *assumption, *taken;
    hopper hopper;
} hopper_variant;

typedef struct discharge_run {
    int method, variant, state;
    double step;
    flow flow;
} discharge_run;

/* The smallest step that fails; 0 where none of the scan does. */
typedef struct failure_step {
    int method, variant, state, criterion;
    double holds, fails; /* s */
} failure_step;

/* Of the three methods, and of Numerov with a coarser tolerance and with Gauss-Seidel. */
enum { PRICE_KINDS = METHODS + 2 };
extern const char *const PRICE_NAME[PRICE_KINDS];

typedef struct price {
    int kind;
    double step;                             /* s */
    double evaluations, newton, linear, cpu; /* per simulated second */
} price;

typedef struct discharge_study {
    const discharge_size *size;
    const char *size_name;
    char root[500], data[560]; /* folders */
    int variants, beds, runs, limits, prices;
    int always_through[VARIANTS];     /* spheres at the smallest step, in the state with most */
    hopper_variant variant[VARIANTS]; /* the first is the usual one */
    bed *bed;                         /* study_bed() says which */
    network_history *history;         /* by state, of the usual hopper */
    discharge_run *run;
    failure_step *limit;
    price *price;
} discharge_study;

/* plan.c: makes the beds and runs everything. */
void study_run(discharge_study *s);
void study_forget(discharge_study *s);
const char *method_name(int method);
const bed *study_bed(const discharge_study *s, int variant, int state);
int study_states(const discharge_study *s, int variant);

/* NULL where there is no such run. */
const flow *study_flow(const discharge_study *s, int method, int variant, int state, double step);

/* limits.c, price.c */
void limits_find(discharge_study *s);
void prices_find(discharge_study *s);

/* ---- summaries ------------------------------------------------------------------------------- */

/* Over the states in which both runs exist; n = 0 where there are none. */
interval residence_at(const discharge_study *s, int method, int variant, double step);
interval residence_ratio(const discharge_study *s, int method, int other, int variant, double step);
interval residence_drift(const discharge_study *s, int method, int variant, double from,
                         double step); /* of the one at `from` */
interval limit_at(const discharge_study *s, int method, int variant, int criterion); /* s */

/* Of the limits in the same states. */
interval limit_ratio(const discharge_study *s, int method, int other, int variant, int criterion);

/* Largest frequency of the bed at the start (rad/s), and the limit of the step that it makes. */
double predicted_limit(const discharge_study *s, int method, int state);
double predicted_at(int method, double frequency); /* s */
interval predicted_ratio(const discharge_study *s, int method, int criterion);

/* ---- writing --------------------------------------------------------------------------------- */

/* tables.c: all of data/; 0, or 4 when a file cannot be written. */
int discharge_write_tables(const discharge_study *s);

/* pictures.c: likewise, frames/. */
int discharge_pictures(const discharge_study *s);

/* verdicts.c: prints and writes the comparison; 0 when none is missed. */
int discharge_verdicts(const discharge_study *s, const char *csv);

#endif

/* handling.h - the worked scenes of A00 Appendix D and the bin of section 3.9.4: what is run, what
 * is read off the runs, what is written.
 *
 * plan.c says which runs there are, shapes.c has the numbers of the templates, conveyed.c,
 * singled.c, turned.c and flow.c read one run each, summary.c draws them together, tables.c,
 * pictures.c and verdicts.c write them down.
 *
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_HANDLING_H
#define CLAST_HANDLING_H

#include <stdbool.h>
#include <stdio.h>

#include "experiments/run/results.h"
#include "experiments/study/command.h"
#include "experiments/study/jobs.h"
#include "experiments/study/output.h"
#include "experiments/study/statistics.h"

/* ---- constants of the source (A00 Appendix D) ------------------------------------------------ */

#define CONVEYOR_SPEED 0.25 /* m/s, MOV 25.0 -25.0 */
#define SLOW_SPEED     0.20 /* m/s, MOV 20.0 60.0 */
#define FAST_SPEED     0.60
#define DISC_SPIN      10.0 /* FAN 10.0, read as rad/s */

/* ---- what we chose (README.md, "Assumptions") ------------------------------------------------ */

#define SPEED_TAKEN   0.10 /* a particle has the speed of a belt within this part of it */
#define CARRIED_FOR   0.25 /* s that it keeps it: README.md, "Assumptions" */
#define SINGLED_AT    1.3  /* m, x at which a spheroid is looked at: README.md, "Assumptions" */
#define ARCH_HALF     0.5  /* of the orifice, its middle: spheres at rest above it are an arch */
#define EVERY_STEPS   50   /* 3.9.2 */
#define COLLISION_GAP 1e-3 /* s without contact between two collisions */
#define QUIET_FOR     0.2  /* s without a discharge at the end of a run: its flow has stopped */

enum { SHAPES = 5, ORIFICES = 3, REPLICATES_MAX = 40, RUNS_MAX = 1200 };

typedef enum scene_kind {
    TAPERED,
    IRREGULAR,
    BUNCH,
    SINGULATION,
    DISC,
    BIN,
    MIXTURE,
    KINDS
} scene_kind;

extern const char *const KIND_NAME[KINDS];
extern const double ASPECT[SHAPES];       /* ours: Fig. 3.29 alone has those of the source */
extern const double ORIFICE_CM[ORIFICES]; /* the first is the source's */

/* ---- sizes ----------------------------------------------------------------------------------- */

typedef struct handling_size {
    const char *name;
    int replicates[KINDS];
    int shapes, orifices; /* of the bin */
    int variants;         /* replicates of each at most, but for those of the disc */
} handling_size;

extern const handling_size SIZES[4];

/* ---- templates ------------------------------------------------------------------------------- */

/* Two equal spheres whose union has the volume of a sphere of radius 1 cm; aspect: length over
 * diameter, in [1, 2]. cm and cm2. */
typedef struct pair_shape {
    double radius, half;  /* half: of the distance of the centres */
    double axial, across; /* moments of inertia over the mass */
} pair_shape;

pair_shape pair_of(double aspect);

/* ---- runs ------------------------------------------------------------------------------------ */

typedef struct handling_run {
    scene_kind kind;
    int variant;        /* 0: as the scene stands; else an index into VARIANTS */
    int replicate;      /* from 0 */
    int shape, orifice; /* of the bin */
    const char *folder;
    bool ran; /* false: the run itself failed */
} handling_run;

typedef struct variant {
    scene_kind kind;
    const char *assumption, *name;
    const char *bed[3]; /* settings of the settling run, up to NULL */
    const char *run[3]; /* of the run itself */
} variant;

extern const variant VARIANTS[];
extern const int VARIANT_COUNT; /* the first is the baseline of all scenes */

typedef struct handling_study {
    const handling_size *size;
    study_folders to;
    job *beds, *jobs;
    int bed_count, run_count;
    handling_run runs[RUNS_MAX]; /* one per job */
} handling_study;

/* plan.c */
void handling_plan(handling_study *s);
int handling_run_all(handling_study *s); /* number of failed runs */

/* The i-th run of these, in the order of replicates; NULL behind the last or when it failed. */
const handling_run *run_of(const handling_study *s, scene_kind kind, int variant, int replicate);
const handling_run *flow_of(const handling_study *s, int variant, int shape, int orifice,
                            int replicate);
/* The spin of the disc in a variant, rad/s. */
double spin_of(int of_variant);
results *run_open(const handling_run *r); /* exits with code 4 when it cannot be read */
const double *run_column(const results *r, const char *name);

/* ---- particles over two conveyors (3.9.1 to 3.9.3) ------------------------------------------- */

/* Shares of the particles of a run. */
typedef struct conveyed {
    double carried;  /* kept the speed of the upper conveyor above it, of those that start there */
    double dropped;  /* ended below it */
    double returned; /* kept the speed of the lower conveyor there */
} conveyed;

conveyed conveyed_of(results *r, scene_kind kind);

/* A particle at one look. *since: from when on it has had the speed of a belt at every look;
 * < 0: it had not at the last. True once that is CARRIED_FOR ago. */
bool keeps_speed(double time, bool has_it, double *since);

/* s, when the first particle is below the upper conveyor; the end of the run when it never is. */
double fall_time(results *r, scene_kind kind);

/* Collisions with the lower conveyor, of a run that recorded every step. */
typedef struct drop {
    int collisions;         /* with the lower conveyor, COLLISION_GAP apart */
    double peak, seen;      /* N, largest normal force, and that of every fiftieth record */
    double shear;           /* N, largest tangential force */
    double at, duration;    /* s, of the peak, and of the collision that it belongs to */
    bool first_is_largest;  /* that collision is the first one */
    bool shear_with_normal; /* and has the largest tangential force, too */
} drop;

drop drop_of(const results *r);

/* ---- singulation (3.9.5) --------------------------------------------------------------------- */

enum { SPHEROIDS = 20 };

typedef struct singled {
    int start;                                /* spheroids that are before SINGLED_AT at first */
    int count;                                /* of them, those that passed it */
    double time[SPHEROIDS], speed[SPHEROIDS]; /* s, m/s, of each then, in the order of passing */
    bool alone[SPHEROIDS];                    /* touched no other one */
    double ahead[SPHEROIDS]; /* m from the one before, along the belt; NAN for the first */
    double before;           /* share that touched another one on the slow conveyor, at the start */
} singled;

singled singled_of(results *r);

/* Share that passed of those that were before SINGLED_AT; NAN where none was. */
double singled_share(const singled *s);

/* ---- rotating disc (Appendix D(e)) ----------------------------------------------------------- */

typedef struct turned {
    int bodies, left; /* on the disc at the end */
    double frequency; /* of the velocity of the one sphere of a run with one, over the spin: 2/7
                         when it rolls; NAN otherwise */
} turned;

turned turned_of(results *r, double spin);

/* ---- bin (3.9.4) ----------------------------------------------------------------------------- */

typedef struct flow {
    int out, left;
    bool rests;          /* nothing came out at last */
    bool arched;         /* and spheres stay above the middle of the orifice */
    double rate;         /* 1/s, steady; NAN without a linear part */
    double coordination; /* of the bed at the start */
} flow;

flow flow_measured(results *r, double orifice_m);

/* ---- summary --------------------------------------------------------------------------------- */

/* Over the replicates of one kind and variant. */
typedef struct conveyed_summary {
    interval carried, dropped, returned;
    interval first_is_largest, shear_with_normal; /* 0 or 1 each; IRREGULAR alone, as the rest */
    interval seen_part;                           /* seen over peak */
    interval peak, duration;                      /* N, s */
} conveyed_summary;

typedef struct singled_summary {
    interval passed, alone, speed, ahead, before; /* share, share, m/s, m, share */
} singled_summary;

typedef struct disc_summary {
    interval stay, frequency; /* share of the spheres, of the spin */
} disc_summary;

typedef struct bin_summary {
    interval arched, out, rate, coordination;
    int runs;
} bin_summary;

conveyed_summary conveyed_over(const handling_study *s, scene_kind kind, int of_variant);
singled_summary singled_over(const handling_study *s, int of_variant);
disc_summary disc_over(const handling_study *s, int of_variant);
bin_summary bin_over(const handling_study *s, int of_variant, int shape, int orifice);

/* ---- writing --------------------------------------------------------------------------------- */

int handling_write_tables(const handling_study *s);
int handling_pictures(const handling_study *s);
int handling_verdicts(const handling_study *s);

#endif

/* piston.h - the pool-ball rig of A00 section 4.2: what is run, what is measured, what is written.
 *
 * plan.c says which runs there are, place.c lays the particles of a replicate, track.c reads where
 * they went, score.c is the agreement score of the source and null.c what that score is worth,
 * compare.c holds tracks against tracks, summary.c puts all together; tables.c, pictures.c and
 * verdicts.c write it down. SI units unless a name says otherwise. */
#ifndef CLAST_POOL_BALL_PISTON_H
#define CLAST_POOL_BALL_PISTON_H

#include "experiments/study/jobs.h"
#include "experiments/study/statistics.h"

/* ---- the source ------------------------------------------------------------------------------ */

enum { PARTICLES = 10, VIDEO_FRAMES = 25, ENSEMBLE = 5, DEGREES = 4, FRICTIONS = 4 };
#define VIDEO_FRAME_S 0.2 /* A00 4.2.3 */

extern const double FRICTION[FRICTIONS];            /* of the scan, A00 4.2.2 */
extern const int THESIS_DEGREE[PARTICLES][DEGREES]; /* A00 Table 4.2: frames of each degree */

/* What the input file and the text say of the rig: A00 Appendix D(f), cm. */
typedef struct rig {
    double radius, half; /* of an element sphere; from the middle to each centre */
    double top;          /* height at which a slope reaches the side of the workspace */
    double gap;          /* between the sheets */
} rig;

#define RIG_COLUMN 15.0 /* cm */
#define RIG_THROAT 31.0
#define RIG_RUN    22.5

extern const rig RIG_INPUT; /* of the input file */

double pair_volume(double radius, double half); /* of the union of both spheres */

/* ---- a particle and where it lies ------------------------------------------------------------ */

enum { ITEMS = 3 }; /* x, z, orientation: what the source scores */
enum { ITEM_X, ITEM_Z, ITEM_ANGLE };

typedef struct particle {
    double radius, half; /* m */
    double x, y, z;      /* m, of its middle */
    double angle;        /* rad, of its long axis above the horizontal */
} particle;

/* The bed that a finished run of settle.yaml has left; false with a message on stderr. */
bool bed_read(const char *folder, const rig *r, particle bed[PARTICLES]);

/* What a hand and a workshop make of it: half widths of uniform errors (README.md, "Errors"). */
#define ERROR_RADIUS   1e-4               /* m */
#define ERROR_HALF     2e-4               /* m */
#define ERROR_POSITION 5e-4               /* m, along x, y and z */
#define ERROR_ANGLE    0.0174532925199433 /* rad, a degree */

/* Changes the bed by errors of that many times these, which depend on the replicate alone (along y
 * only where the run is not flat); then what overlaps gives way. */
void bed_lay_by_hand(const rig *r, double errors, bool flat, int replicate,
                     particle bed[PARTICLES]);

/* m: the least distance of any two particles, of any particle from a wall; below 0: overlap. */
double bed_clearance(const rig *r, const particle bed[PARTICLES]);

/* ---- tracks ---------------------------------------------------------------------------------- */

/* Every 0.05 s from the start of the piston. */
enum { TRACK_PER_FRAME = 4, TRACK_POINTS = VIDEO_FRAMES * TRACK_PER_FRAME + 1 };
#define TRACK_S (VIDEO_FRAME_S / TRACK_PER_FRAME)

typedef struct track {
    double at[TRACK_POINTS][PARTICLES][ITEMS]; /* m, m, rad: followed through whole turns */
} track;

/* rad: of the long axis above the horizontal, from an orientation (w x y z). A half turn does not
 * show on such a particle: of the possible angles, the one nearest to `near`. */
double angle_of(const double orientation[4], double near);

/* From the frames of a run; of the possible angles at first, those
 * nearest to `near`. False with a message on stderr. */
bool track_read(const char *folder, const double near[PARTICLES], track *out);

void track_mean(const track *const *tracks, int n, track *out);

/* m: root mean square over particles and video frames of the distance in the plane. */
double track_distance(const track *a, const track *b);

/* m: root mean square over particles of the standard deviation in the plane, at a point. */
double track_spread(const track *const *tracks, int n, int point);

/* ---- the agreement score, A00 4.2 and 4.3 ---------------------------------------------------- */

/* Within mean +- 1.96 sd/sqrt(n) of the ensemble, A00 4.2, with the deviation of a sample. n >= 2.
 */
bool score_agrees(const double *ensemble, int n, double value);

typedef struct scores {
    int degree[PARTICLES][DEGREES]; /* video frames of each degree of agreement */
    double percent[PARTICLES];
    double mean; /* % */
} scores;

/* Degree of agreement: how many items lie within mean +- 1.96 sd/sqrt(n) of the ensemble. */
scores score_against(const track *const *ensemble, int n, const track *t);

/* %: A00 4.3 over three points for every frame. */
double score_percent(const int degree[DEGREES]);

/* ---- what the score is worth ----------------------------------------------------------------- */

typedef enum null_kind { NULL_NEW_DRAW, NULL_EXACT_MEAN, NULL_KINDS } null_kind;

/* Probability that one item lies within the interval of an ensemble of n when all are independent
 * normal draws: closed form, by Student's t with n - 1 degrees of freedom. */
double null_probability(null_kind kind, int n);

/* The same by Monte Carlo; mean and 95 % interval. */
interval null_probability_drawn(null_kind kind, int n, int trials, unsigned long seed);

/* Mean scores in %, sorted, of as many whole experiments as trials. Items of a particle are
 * independent from frame to frame, or (whole) the same draw in all frames. */
void null_scores(null_kind kind, bool whole, double *out, int trials, unsigned long seed);

/* The same from tracks: of every trial, ENSEMBLE of them are the ensemble; the new draw is one of
 * the others, the exact mean that of the others. n >= ENSEMBLE + 2. */
void null_scores_of(null_kind kind, const track *const *tracks, int n, double *out, int trials,
                    unsigned long seed);

/* Part of sorted values that are at least x. */
double part_at_least(const double *sorted, int n, double x);

/* ---- groups of tracks against each other ------------------------------------------------------
 */

/* P of a permutation test: the distance of the mean tracks of two groups is no larger than that of
 * a random division of all of them. */
double permutation_p(const track *const *a, int na, const track *const *b, int nb, int trials,
                     unsigned long seed);

/* ---- runs ------------------------------------------------------------------------------------ */

enum { REPLICATES_MAX = 100, GROUPS_MAX = 64 };

typedef enum section {
    SECTION_BASE,       /* the model's friction of the source, 0.1; as many as the size has */
    SECTION_RIG,        /* measured static friction: ours in place of the experiment */
    SECTION_FRICTION,   /* the rest of the scan */
    SECTION_STEP,       /* at the critical step */
    SECTION_ERRORS,     /* of other size: how deviations grow */
    SECTION_ASSUMPTION, /* the sensitivity table */
    SECTIONS
} section;

typedef struct group_def {
    section section;
    const char *assumption, *variant;
    const char *all;             /* settings "a=1,b=2" of all scenes, */
    const char *bed, *lay, *run; /* of settle.yaml, of lay.yaml, of the two of the piston */
    rig rig;
    double errors; /* of the placing, in units of ERROR_... */
} group_def;

typedef struct group {
    const group_def *def;
    int replicates;
    job bed, model;  /* the model runs from the bed itself, */
    job *lay, *laid; /* a replicate from what was laid by hand and came to rest */
    bool complete;   /* all of them ran */
    track model_track, *tracks;
    const track **list; /* pointers to tracks */
} group;

/* ---- arches ---------------------------------------------------------------------------------- */

enum { SLOPES = 2, ARCH_ABOVE = 2 };

extern const char *const SLOPE_NAME[SLOPES];

typedef struct arch_row {
    int runs, held; /* more than ARCH_ABOVE particles are above the throat in the end */
    int above;      /* particles there, all runs together */
} arch_row;

typedef struct piston_size {
    const char *fraction; /* of the critical step, where a group does not say its own */
    int replicates[SECTIONS];
    int arrangements; /* beds of which arches are counted */
    int trials;       /* of Monte Carlo */
} piston_size;

typedef struct piston_study {
    const piston_size *size;
    const char *name;
    char root[500], data[560]; /* folders */
    group groups[GROUPS_MAX];
    int count;
    arch_row arches[SLOPES][FRICTIONS];
} piston_study;

/* Runs all, reads all tracks; number of failed runs. */
int piston_run_all(piston_study *s, int processes);

/* Runs and counts; number of failed runs. */
int piston_arches(piston_study *s, int processes);

/* The n-th group of a section; NULL when the size has none or a run of it failed. */
const group *piston_group(const piston_study *s, section which, int n);

/* The group of that friction in the scan. */
const group *piston_friction(const piston_study *s, int which);

/* ---- summary --------------------------------------------------------------------------------- */

typedef struct friction_row {
    bool found;
    double model_to_base, model_to_rig; /* m: RMS of the model run */
    interval laid_to_base, laid_to_rig; /* m: of its replicates */
    double score_base, score_rig;       /* %: of the model run */
    double p_base;                      /* of its replicates against the base group */
} friction_row;

typedef struct group_row {
    double distance; /* m: of its mean track from that of the base group, same number of both */
    double p;        /* permutation */
    double score;    /* %: of its model run against the ensemble */
    double own;      /* %: of its model run against its own first five replicates */
    double model;    /* m: RMS of its model run from that of the base group */
    double end;      /* m: spread in the last frame */
} group_row;

typedef struct null_row {
    double probability[NULL_KINDS];
    interval drawn[NULL_KINDS];
    double *independent[NULL_KINDS], *whole[NULL_KINDS], *tracks[NULL_KINDS]; /* sorted; or NULL */
    int trials;
} null_row;

typedef struct growth {
    double errors, first, last; /* m: spread when the piston starts, in the last frame */
    double rate, rate_half;     /* 1/s: of the exponential, least squares; NAN without a part */
    double from, to;            /* s */
} growth;

typedef struct piston_summary {
    scores base, rig; /* of the model run at friction 0.1 against both ensembles */
    friction_row friction[FRICTIONS];
    double best, order; /* part of the draws in which 0.1 is best; ... the order is the source's */
    group_row step;
    group_row rows[GROUPS_MAX]; /* by group */
    null_row null;
} piston_summary;

void piston_summarise(const piston_study *s, piston_summary *m);
void piston_summary_free(piston_summary *m);

/* How the spread of a group grows. */
growth growth_of(const group *g);

/* ---- writing --------------------------------------------------------------------------------- */

/* Returns 0, or 4 when a file cannot be written. */
int piston_write_tables(const piston_study *s, const piston_summary *m);
int piston_pictures(const piston_study *s);

/* Prints and writes the comparison; 0 when none is missed. */
int piston_verdicts(const piston_study *s, const piston_summary *m, const char *csv);

#endif

/* checks.h - single particles in situations that have an answer, A00 chapter 3: what is run, what
 * it is held against, what is written.
 *
 * particle.c has the particles and their world; weight.c is A00 3.2, collision.c 3.3, slide.c 3.4,
 * belt.c 3.5, blow.c 3.6, pseudo.c 3.7, direction.c 3.8 and Appendix E, bed.c 3.10; law.c is a
 * contact law that 3.4 needs, side.c runs independent pieces on all cores; tables.c writes all
 * down, verdicts.c judges. SI units. */
#ifndef CLAST_PARTICLE_CHECKS_H
#define CLAST_PARTICLE_CHECKS_H

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

#include "engine/clast.h"

#define CHECKS_PI 3.14159265358979323846
#define GRAVITY   9.81            /* m/s2, A00 Appendix D */
#define POISSON   0.3             /* A00 4.3 and 5.2; chapter 3 prints none */
#define SLOPE     (CHECKS_PI / 6) /* 30 degrees, A00 3.4 and 3.7 */

/* ---- particles and their world --------------------------------------------------------------- */

/* kg/m3: five spheres of 1 cm that weigh 0.427 N, A00 3.7. */
double matter_density(void);

/* Pa: with it A00 1.28 gives this critical step (s) for spheres of this radius (m). */
double matter_young(double radius, double critical_step);

double critical_step(double radius, double young); /* s, A00 1.28 */

/* Equal spheres in a row along x; mass properties are those of the solid that they stand for, a
 * cylinder with round ends. */
typedef struct capsule {
    int spheres;
    double radius, spacing; /* m; between the centres of neighbours */
    double mass;            /* kg */
    clast_vec3 inertia;     /* kg m2 */
} capsule;

double capsule_volume(double radius, double straight); /* m3; straight: m, without the ends */
capsule capsule_of(int spheres, double radius, double straight, double mass);

/* The particle of A00 3.2 and 3.3: two spheres, 0.2105 N; centres a radius apart (assumed). */
capsule pair_particle(void);
#define PAIR_WEIGHT        0.2105   /* N, caption of Fig. 3.2 */
#define PAIR_CRITICAL_STEP 1.044e-5 /* s, A00 3.2 */
double pair_young(void);

/* The particles of A00 3.4 and 3.5, 3 to 9 spheres of 1 cm in the place of one solid. */
capsule sliding_particle(int spheres);
double sliding_young(void); /* Pa, of the same matter as pair_particle() */

#define RIGID 1e4 /* over the particle's modulus: deforms by a ten-thousandth of what it does */

/* A world of one matter and one shape (both 0), gravity along -z when the slope is 0. */
typedef struct setting {
    clast_law law;       /* CLAST_LAW_USER: law.c */
    double young, step;  /* Pa, s */
    double damping;      /* over critical, A00 1.21 */
    double slip_damping; /* of the tangential dashpot; the engine's laws take 0, or the same */
    double friction;     /* - */
    double slope;        /* rad, falling along +x */
    double belt;         /* m/s along +x, of the floor */
    bool weightless;
    bool in_plane;       /* bodies move in x and z and turn about y */
    bool shared;         /* one dashpot for all spheres that touch, else each its own */
    bool mixed;          /* precision */
    bool rigid_wall;     /* RIGID times as stiff as the particle, else of its matter */
    bool guards_look_on; /* runs with steps that are too large on purpose */
} setting;

clast_world *matter_new(const setting *s, const capsule *p);
void floor_add(clast_world *w, const setting *s); /* z = 0 */
void body_put(clast_world *w, const clast_body_def *body);
void world_step(clast_world *w); /* the next, or an end of the program with the engine's words */

/* Adds the hash of the last state to the study's, and frees. */
void world_end(clast_world *w);
uint64_t checks_hash(void);
void checks_hash_add(uint64_t hash); /* of a run in another process */

/* The axis of a capsule along z. */
clast_quat upright(void);

/* Sum over the contacts of a body with walls or bodies of lower id. */
typedef struct touch {
    int contacts;
    double elastic, dashpot; /* N, normal; the parts of a Hertz contact */
    double overlap;          /* m, largest */
    clast_vec3 force;        /* N, on the body */
} touch;
touch touch_of(clast_world *w, uint32_t id, const setting *s, const capsule *p);

/* ---- A00 3.2: at rest ------------------------------------------------------------------------ */

#define REST_TIME 0.005 /* s, A00 3.2 */

typedef struct rest_case {
    bool horizontal;
    double damping, step;
    bool shared, mixed;
    bool soft_floor; /* of the particle's matter; A00 3.2 has a rigid one */
    double radius;   /* m; 0: that of pair_particle() */
} rest_case;

typedef struct rest {
    double error;   /* N, of the contact force */
    double overlap; /* m */
} rest;

enum { REST_CASES = 9 };
extern const rest_case REST_CASE[REST_CASES]; /* Tables 3.1 to 3.3, in their order */

enum { REST_NAME = 96 };
/* Row of published.csv: "vertical, damping 0.5, 10.44 us: <what>". */
void rest_name(const rest_case *c, const char *what, char name[REST_NAME]);

/* Writes the history of Fig. 3.2 into `trace` when it is not NULL. */
rest rest_run(const rest_case *c, FILE *trace);

/* ---- A00 3.3: collisions --------------------------------------------------------------------- */

typedef struct drop_case {
    bool horizontal;
    double damping, step, height; /* height: m, of the fall */
    bool shared;
} drop_case;

typedef struct drop {
    double force_most; /* N, of one contact in the first collision */
    double impulse;    /* N s, of all contacts in the first collision */
    double bounce;     /* m, highest rise after it */
} drop;

#define DROP_HEIGHT  0.01 /* m, assumed */
#define DROP_DAMPING 0.1  /* A00 3.3 */
#define DROP_STEP    1e-6 /* s, caption of Fig. 3.3 */

/* Writes heights and forces when trace is not NULL. */
drop drop_run(const drop_case *c, FILE *trace);

/* Upright and elastic; fraction: of the critical step, late: of a step, after which the touch
 * comes. */
typedef struct elastic_case {
    double fraction, height, late;
    bool weight;     /* gravity acts */
    bool soft_floor; /* of the particle's matter; A00 3.3 has a rigid one */
} elastic_case;

/* Error of half the area under the force against m v, A00 3.5. */
double elastic_impulse_error(const elastic_case *c, FILE *trace);

/* ---- A00 3.4: on a slope --------------------------------------------------------------------- */

typedef struct slide_case {
    int spheres;
    double friction, damping, slip_damping;
    bool printed; /* law.c */
    bool shared;
    double fraction; /* of the critical step */
} slide_case;

#define SLIDE_TIME 0.5 /* s, assumed */

double slide_exact(double friction, double time); /* m: A00 3.6 twice integrated, from rest */

/* Ways at `count` equal times up to SLIDE_TIME. */
void slide_run(const slide_case *c, int count, double *way);

/* Rebound of a flat landing over the speed before it. */
double landing_rebound(int spheres, double damping, bool shared);

/* ---- A00 3.5: on a belt ---------------------------------------------------------------------- */

typedef struct belt_case {
    double fraction, damping, friction, height;
    bool shared;
} belt_case;

#define BELT_SPEED  0.01 /* m/s, A00 3.5 */
#define BELT_TIME   0.3  /* s, assumed */
#define BELT_HEIGHT 1e-3 /* m, assumed */
extern const belt_case BELT_BASE;

typedef struct belt {
    double speed;   /* m/s, mean of the last tenth */
    double settled; /* s, from where on the speed stays within a tenth of the belt's */
} belt;
belt belt_run(const belt_case *c, FILE *trace);

/* ---- A00 3.6: a blow off the centre ---------------------------------------------------------- */

typedef struct blow {
    double speed, spin;             /* m/s, rad/s, after it */
    double acceleration, turning;   /* m/s2, rad/s2, while it acts */
    double speed_after, spin_after; /* once the particle has met the surface */
} blow;

#define BLOW_FORCE   1000.0  /* N, A00 3.6 like all of these */
#define BLOW_STEP    8.61e-6 /* s */
#define BLOW_ARM     0.015   /* m */
#define BLOW_MASS    2.43e-2 /* kg */
#define BLOW_INERTIA 2.43e-5 /* kg m2 */

/* damping: of the surface that it meets. */
blow blow_run(double damping, FILE *trace);

/* ---- A00 3.7: pseudo-friction ---------------------------------------------------------------- */

typedef struct pseudo_case {
    double q;     /* spheres per diameter; 4 q is a whole number */
    double start; /* [0, 1): of the spacing, downhill from a nest of the row below */
    double damping;
    double fraction; /* of the critical step; from q = 4 on times 4 / q */
    double softer;   /* than the matter, 1: not */
    bool shared;
} pseudo_case;

enum { PSEUDO_WAYS = 6 };
extern const double PSEUDO_WAY_TO[PSEUDO_WAYS]; /* m; the last is all of PSEUDO_WAY */

typedef struct pseudo {
    double by_way[PSEUDO_WAYS]; /* friction when only so much of the way is looked at */
    double friction;            /* of the slope of t^2 over the way, A00 3.13 */
    double friction_end;        /* of the time that the whole way takes */
    double deviation; /* degrees, largest between a contact force and the normal of the slope
                         while the first sphere is passed */
    double force;     /* N, mean against the way, likewise */
    double contacts, candidates; /* mean, of the upper particle; of the list */
    double seconds;              /* of processor time per step */
    double time;                 /* s, that the way takes */
    uint64_t hash;
} pseudo;

#define PSEUDO_RADIUS  0.01  /* m, A00 3.7 */
#define PSEUDO_WEIGHT  0.427 /* N, A00 3.7, below 3.13 */
#define PSEUDO_WAY     0.17  /* m: what the box leaves, whatever the start */
#define PSEUDO_DAMPING 0.5   /* assumed: DAMP of A00 Appendix D */
#define PSEUDO_GOOD    0.03  /* friction that A00 3.7 calls negligible */

extern const double PSEUDO_Q[];
extern const int PSEUDO_QS;

double pseudo_normal_off(double q);    /* degrees: of a nest */
double pseudo_density(double degrees); /* the inverse */

/* Writes paths, or forces while the first sphere is passed, when they are not NULL. */
pseudo pseudo_run(const pseudo_case *c, FILE *path, FILE *forces);

/* A00 3.14 and 3.15: mean force against the way over the weight's part normal to the slope. */
double pseudo_friction_by_force(const pseudo *p);

/* Over start positions. */
typedef struct pseudo_range {
    double q;
    int n;
    double mean, sd, least, most; /* of `friction` */
    double end_mean, end_least, end_most;
    double contacts, candidates, seconds; /* means */
} pseudo_range;

/* ranges: room for PSEUDO_QS, of which as many are filled as have q <= densest. Returns how many.
 * Runs are kept in `all` (PSEUDO_QS times `starts`) when it is not NULL. */
int pseudo_scan(int starts, double densest, const pseudo_case *base, pseudo_range *ranges,
                pseudo *all);

/* ---- A00 3.8: direction of a contact --------------------------------------------------------- */

/* Angles in degrees, lengths in m; names are the source's. */
typedef struct direction {
    double theta;              /* 3.16 */
    double alpha, beta, gamma; /* 3.18 */
    double gamma1, gamma2;     /* 3.19: off the normal, at either sphere */
    double dx, dy;             /* 3.21, of the contact point at sphere 1 */
} direction;

/* Two neighbours of a particle, L apart, and the smallest sphere in the nest between them. */
direction direction_of(double r1, double r2, double smallest, double distance);

/* The end of the button of A00 4.3 and Appendix E: fitted, not rounded. */
typedef struct button_end {
    double r1, r2, distance; /* m */
} button_end;
button_end button_end_of(void);

/* gamma1 and gamma2 of that nest from the contact forces of the engine; degrees. */
void direction_measured(double *gamma1, double *gamma2);

/* ---- A00 3.10: what a step costs ------------------------------------------------------------- */

typedef struct bed_case {
    int particles, spheres; /* of one particle; aspect ratio 2 where there is more than one */
} bed_case;

enum { BED_CASES = 8, BED_PRINTED = 6 };
extern const bed_case BED_CASE[BED_CASES]; /* Table 3.5, 3.6, then denser ones of ours */

typedef struct bed {
    double seconds;    /* of processor time per step */
    double contacts;   /* at the end */
    double candidates; /* likewise */
    double overlap;    /* largest, of the radius */
    double sunk;       /* m, mean height of the centres at the end */
    uint64_t hash;
} bed;
bed bed_run(const bed_case *c, int steps);
void bed_run_all(int steps, bed *beds);

/* ---- the study ------------------------------------------------------------------------------- */

typedef struct checks_size {
    int starts;         /* positions per sphere density */
    int variant_starts; /* likewise where an assumption is varied */
    double densest;     /* largest sphere density */
    int bed_steps;
} checks_size;

/* tables.c: runs everything, writes the folder. Returns 0, or 4 when a file cannot be written. */
int checks_write_tables(const checks_size *size, const char *name, const char *folder);

/* verdicts.c: runs what is judged, prints and writes the comparison; 0 when none is missed. */
int checks_verdicts(const checks_size *size, const char *csv);

#endif

/* clast.h - the public interface of the Clast discrete element engine.
 *
 * Rigid clumps of spheres, plane walls in moving or removable parts, contact laws with tangential
 * history, the same bits for any number of threads. SI units everywhere: m, kg, s, N, J, rad.
 *
 *     clast_world_def def = clast_world_def_default();
 *     def.gravity = (clast_vec3){0, 0, -9.81};
 *     clast_world *w = clast_world_new(&def);
 *     int glass = clast_material_add(w, &(clast_material_def){"glass", 2500, 70e9, 0.22});
 *     clast_pair_set(w, glass, glass, &(clast_pair_def){.restitution = 0.9, .friction = 0.3});
 *     int ball = clast_shape_add_sphere(w, "ball", 0.005, glass);
 *     int floor = clast_part_add(w, &(clast_part_def){.name = "floor"});
 *     clast_wall_add(w, floor, &(clast_wall_def){"floor", CLAST_WALL_PLANE, glass,
 *                                                .normal = {0, 0, 1}});
 *     clast_body_add(w, &(clast_body_def){.shape = ball, .position = {0, 0, 0.1}});
 *     if (clast_world_run(w, 1.0)) puts(clast_world_error(w));
 *     clast_world_free(w);
 *
 * Failures come in three kinds. A broken promise of the caller (a null pointer, an index that was
 * never handed out) stops the program with file and line. A definition that makes no physical sense
 * (a negative mass) and a run that fails (a guard, a full disk) return a negative number or a
 * clast_status other than CLAST_OK; clast_world_error() then says what, who, where and when.
 *
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000.
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012.
 */
#ifndef CLAST_H
#define CLAST_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "engine/clast_law.h"

#define CLAST_VERSION "0.1.0"

typedef struct clast_vec3 {
    double x, y, z;
} clast_vec3;

typedef struct clast_quat {
    double w, x, y, z; /* unit quaternion, body frame to world frame; {0} is read as no rotation */
} clast_quat;

typedef struct clast_world clast_world;

typedef enum clast_status {
    CLAST_OK = 0,
    CLAST_ERR_ARGUMENT, /* a definition out of its range */
    CLAST_ERR_GUARD,    /* the run failed: see clast_world_error() */
    CLAST_ERR_OPEN,     /* a file or folder cannot be opened */
    CLAST_ERR_WRITE,    /* a file cannot be written in full: disk full, no permission */
    CLAST_ERR_FORMAT,   /* a file is not what it should be */
    CLAST_ERR_VERSION,  /* a file of another format version */
    CLAST_ERR_MISMATCH  /* a checkpoint of another scene */
} clast_status;

/* ---- the world ------------------------------------------------------------------------------ */

typedef enum clast_law {
    CLAST_LAW_HERTZ_A00,     /* Hertz with pressure-dependent tangential stiffness, A00 1.8-1.10,
                                1.14, 1.21; tangential spring incremental */
    CLAST_LAW_HERTZ_MINDLIN, /* Hertz-Mindlin with Tsuji's damping, S12 2.41-2.46 */
    CLAST_LAW_LINEAR,        /* linear spring-dashpot, S12 2.15-2.23; stiffness from the pair */
    CLAST_LAW_MAW,           /* the same; stiffness of the elastic energy of a Hertz contact at
                                impact_speed, S12 2.29-2.35 */
    CLAST_LAW_HOOKE,         /* the same; stiffness 4/3 E* R*, S12 2.36 */
    CLAST_LAW_HERTZ_BRILLIANTOV, /* viscoelastic Hertz: restitution falls with speed, S12 2.37 */
    CLAST_LAW_WALTON_BRAUN,      /* plastic: loads at the pair's stiffness k1, unloads and loads
                                    again at k2 = k1 / e^2; no normal dashpot, S12 2.47-2.52 */
    CLAST_LAW_USER               /* of your own: clast_world_use_law() */
} clast_law;

/* What is friction before it slides. */
typedef enum clast_tangent {
    CLAST_TANGENT_BY_LAW, /* as the source has it: viscous for Hooke, Brilliantov and Walton-Braun,
                             else a spring (also for the linear law, where S12 2.28 is viscous) */
    CLAST_TANGENT_SPRING, /* spring and dashpot, S12 2.33 */
    CLAST_TANGENT_VISCOUS /* dashpot alone, S12 2.28: holds nothing at rest */
} clast_tangent;

typedef enum clast_friction_limit {
    CLAST_LIMIT_TOTAL, /* mu times spring and dashpot force, A00 1.72 */
    CLAST_LIMIT_SPRING /* mu times the spring force alone, A00 1.73 */
} clast_friction_limit;

typedef enum clast_unloading {
    CLAST_UNLOAD_RESCALE,   /* the tangential spring shrinks with its stiffness: no energy is made
                               (Elata and Berryman); default */
    CLAST_UNLOAD_AS_PRINTED /* A00 1.14 as printed: can create energy when the normal load falls */
} clast_unloading;

/* Dashpots where two bodies, or a body and a wall, touch at several spheres at once. Either way
 * every sphere keeps its own elastic force, and single spheres see no difference. */
typedef enum clast_clump_contact {
    CLAST_CLUMP_EACH,  /* every contact has a dashpot of its own with the whole masses of the
                          bodies, A00 2.2: damping grows with the number of spheres that touch,
                          A00 3.4 */
    CLAST_CLUMP_SHARED /* one dashpot for all of them, of their stiffness together and the effective
                          mass where they push, arms and moments of inertia included; shared out by
                          elastic force. For laws whose clast_law_info says `shares` */
} clast_clump_contact;

typedef enum clast_motion { CLAST_MOTION_3D, CLAST_MOTION_IN_PLANE } clast_motion;
typedef enum clast_guard_mode { CLAST_GUARD_STOP, CLAST_GUARD_REPORT } clast_guard_mode;
typedef enum clast_outside { CLAST_OUTSIDE_STOP, CLAST_OUTSIDE_REMOVE } clast_outside;
typedef enum clast_isa {
    CLAST_ISA_AUTO,
    CLAST_ISA_BASELINE,
    CLAST_ISA_AVX2,
    CLAST_ISA_AVX512
} clast_isa;

typedef enum clast_precision {
    CLAST_PRECISION_DOUBLE,
    CLAST_PRECISION_MIXED /* positions, overlaps and sums double; velocities at contacts, springs
                             and forces single */
} clast_precision;

/* How the world is integrated (clast_scheme_info_of() has the equations). The leapfrog is fast and
 * the default; the others serve studies of accuracy and stability. In a world of theirs velocities
 * are those at the time of the positions, and the first steps of a scheme that looks back are ones
 * of the classical Runge-Kutta scheme. Implicit schemes solve for the translations of all bodies;
 * rotation goes by the mean of the torques at both ends of a step (S12 3.8.5). */
typedef enum clast_scheme {
    CLAST_SCHEME_LEAPFROG,
    CLAST_SCHEME_SYMPLECTIC_EULER, /* S12 2.7.1 */
    CLAST_SCHEME_TAYLOR,           /* S12 2.7.2 */
    CLAST_SCHEME_POSITION_VERLET,  /* S12 2.7.3; dashpots feel the velocity of the step before */
    CLAST_SCHEME_VELOCITY_VERLET,  /* S12 2.7.4, predictor and corrector */
    CLAST_SCHEME_GEAR4,            /* S12 2.7.5 */
    CLAST_SCHEME_BACKWARD_EULER,   /* implicit from here on: S12 3.3.1 */
    CLAST_SCHEME_BEEMAN,           /* S12 3.3.2 */
    CLAST_SCHEME_NEWMARK_BETA,     /* S12 3.3.3 */
    CLAST_SCHEME_BDF2,             /* S12 3.3.4 */
    CLAST_SCHEME_BDF4,             /* S12 3.3.5 */
    CLAST_SCHEME_ADAMS_MOULTON,    /* S12 3.3.6, third order */
    CLAST_SCHEME_TRAPEZOID,        /* S12 3.3.7 */
    CLAST_SCHEME_NUMEROV_BACKWARD, /* S12 3.25 with the dashpots of 3.29 */
    CLAST_SCHEME_NUMEROV_FORWARD,  /* of 3.30 */
    CLAST_SCHEME_NUMEROV_CENTRAL   /* of 3.31 */
} clast_scheme;

enum {
    CLAST_SCHEMES = CLAST_SCHEME_NUMEROV_CENTRAL + 1,
    CLAST_LEVELS = 4 /* times that a scheme looks at: now, a step before, ... */
};

typedef enum clast_linear_solver {
    CLAST_SOLVER_CONJUGATE_GRADIENT, /* preconditioned with the blocks of the diagonal */
    CLAST_SOLVER_GAUSS_SEIDEL        /* S12 3.8.3 */
} clast_linear_solver;

typedef struct clast_world_def {
    clast_vec3 gravity;         /* m/s2 */
    clast_law law;              /* one contact law per world */
    clast_tangent tangent;      /* tangential force below the Coulomb limit */
    clast_friction_limit limit; /* what the Coulomb limit is taken of */
    clast_unloading unloading;  /* Hertz laws only */
    clast_clump_contact clump_contact;
    clast_motion motion;   /* in-plane: no velocity along plane_axis, spin about it alone */
    int plane_axis;        /* 0 x, 1 y, 2 z: normal of the plane of motion */
    double global_damping; /* 1/s, f of A00 1.81; >= 0 */

    clast_scheme scheme;
    double newton_tolerance; /* of the smallest radius: an implicit step ends when no body moves
                                farther in an iteration; typical 1e-10 */
    int newton_iterations;   /* most in a step; not to converge is a failure for the guards */
    clast_linear_solver linear_solver;

    double time_step;          /* s; 0 asks for the smaller of the next two limits */
    double rayleigh_fraction;  /* of the Rayleigh step, A00 1.28; in (0, 1] */
    double contact_resolution; /* steps in the shortest expected contact; >= 5 */
    double impact_speed; /* m/s, fastest expected impact; 0 takes the fastest body at the start
                            after a fall through the domain. Maw's stiffness is that of this speed
                            */

    clast_vec3 domain_min, domain_max; /* m; bodies stay inside */
    clast_outside outside;             /* what happens to a body whose centre leaves the domain */
    bool periodic[3]; /* along x, y, z: the two faces of the domain are one. What leaves by one
                         comes in by the other, and is felt across it */

    clast_guard_mode guards; /* report is for stability experiments */
    double max_overlap;      /* of the smaller radius of a contact; typical 0.05 */
    double max_displacement; /* of the smallest radius, in one step; typical 0.1 */
    double max_residual;     /* of the energy put in; typical 0.05 */

    double skin;   /* m, extra reach of the pair list; 0 lets the engine choose: never observable */
    int threads;   /* at most so many in each process, 0: as many as there are cores. Those that pay
                      are used, counted at the start, by the leapfrog at every list: same bits */
    int spheres_per_thread; /* so many spheres keep a thread busy, typical 500;  1: all threads,
                               whether they pay or not, for tests of threads */
    bool alone;    /* among several processes: this one keeps the world for itself */
    clast_isa isa; /* vector lanes; never observable */
    clast_precision precision;
    bool turn_spheres; /* keep track of the orientation of single spheres, which only drawings of
                          marked ones show; costs some 7 %. Their spin is always kept */
    uint64_t seed;     /* the only source of randomness of a run */
    uint32_t magic;    /* set by clast_world_def_default(): catches a def that was built by hand */
} clast_world_def;

/* Hertz-Mindlin, 3-D, guards on, Rayleigh fraction 0.2, 30 steps per contact, domain +-10 m. */
clast_world_def clast_world_def_default(void);

/* NULL with a message in *error (a static string) when the definition is out of range. */
clast_world *clast_world_new(const clast_world_def *def);
const char *clast_world_new_error(void);
void clast_world_free(clast_world *w);

/* The last failure of this world in one or more lines; "" when there was none. */
const char *clast_world_error(const clast_world *w);

/* ---- what a scene is made of: every add returns an index >= 0, or -1 with clast_world_error() --
 */

typedef struct clast_material_def {
    const char *name;
    double density; /* kg/m3, > 0 */
    double young;   /* Pa, > 0 */
    double poisson; /* in (-1, 0.5) */
} clast_material_def;

int clast_material_add(clast_world *w, const clast_material_def *def);

typedef struct clast_pair_def {
    double restitution;      /* measured rebound of a single collision, in (0.01, 1]; Brilliantov:
                                at reference_speed, not used where dissipation is given */
    double friction;         /* Coulomb coefficient, >= 0 */
    double cohesion;         /* N, C of A00 1.71 in the friction limit; >= 0 */
    double stiffness;        /* N/m, laws linear and Walton-Braun (loading) only; > 0 */
    double tangential_ratio; /* k_t / k_n, laws that are linear in the overlap; 0 reads as 2/7 with
                                a tangential spring, as 1 without */
    double tangential_restitution; /* e_t of S12 2.34-2.35 for the tangential dashpot, in (0, 1],
                                      not for Brilliantov; 0 takes the normal damping ratio */
    double rolling_friction; /* mu_r of S12 2.53, a couple of mu_r F_n R* against the relative spin;
                                >= 0 */
    double dissipation;      /* s, A of S12 2.37, Brilliantov only (3/2 of the A of Brilliantov et
                                al.); 0 solves it for restitution at reference_speed */
    double reference_speed;  /* m/s, Brilliantov only; 0 reads as the impact speed of the world */
    double parameter[CLAST_LAW_PARAMETERS]; /* of a law of the user's own, which reads friction and
                                               cohesion beside them and no restitution */
} clast_pair_def;

/* Every pair of materials that can touch must be set before the first step. */
clast_status clast_pair_set(clast_world *w, int material_a, int material_b,
                            const clast_pair_def *def);

/* Loads the law of a world of CLAST_LAW_USER, before the first step: `name` is a clast_law_entry in
 * the shared object `path` (clast_law.h; without a slash it is looked for where the system keeps
 * libraries). In double precision, with the leapfrog or an explicit scheme. The same bits are not
 * promised in such a world. CLAST_ERR_OPEN, CLAST_ERR_FORMAT (nothing of that name),
 * CLAST_ERR_VERSION or CLAST_ERR_ARGUMENT. */
clast_status clast_world_use_law(clast_world *w, const char *path, const char *name);

typedef struct clast_shape_def {
    const char *name;
    int material;
    int spheres;              /* >= 1 */
    const clast_vec3 *centre; /* m, body frame: origin at the centre of mass, principal axes */
    const double *radius;     /* m, > 0 */
    double mass;              /* kg; 0 works it out from the density: spheres must not overlap */
    clast_vec3 inertia;    /* kg m2, principal; {0} works it out likewise: then the centre of mass
                              of the spheres must be at the origin, their axes principal */
    int outline_points;    /* target profile for drawing, may be 0 */
    const double *outline; /* m, outline_points pairs (x, z) in the body frame */
} clast_shape_def;

int clast_shape_add(clast_world *w, const clast_shape_def *def);
int clast_shape_add_sphere(clast_world *w, const char *name, double radius, int material);

/* Element spheres tangent to an ellipse of half axes a >= b (m) about the body x axis, by
 * A00 2.2.2: the profile is cut in spheres + 1 chords of equal length and every inner point carries
 * one sphere that touches the profile there (A00 2.3). centre[i] is along x from left to right. A00
 * Appendix E prints the result for a = 0.69 cm, b = 0.53 cm and 7 spheres. */
clast_status clast_fit_ellipse(double a, double b, int spheres, clast_vec3 *centre, double *radius);

/* How a part moves: what is given of the following adds up. Each is a function of the time since
 * move_from, so the part never drifts; at move_until it stops where it is, and before move_from it
 * stands where it will start. A speed may jump, as at the ends of a stroke. */

/* Out along `travel` and back, with a pause at either end. */
typedef struct clast_stroke {
    clast_vec3 travel; /* m, from one end to the other; {0}: no stroke */
    double speed;      /* m/s, on the way; > 0 */
    double pause;      /* s, at each end; >= 0 */
    double phase;      /* in [0, 1): where it starts, of out, pause, back, pause */
} clast_stroke;

/* amplitude sin(2 pi (frequency t + phase)) */
typedef struct clast_oscillation {
    clast_vec3 amplitude; /* m; {0}: none */
    double frequency;     /* 1/s, > 0 */
    double phase;         /* in [0, 1), of a period */
} clast_oscillation;

/* Right-handed by speed t + swing sin(2 pi (frequency t + phase)). */
typedef struct clast_rotation {
    clast_vec3 point; /* m, of the axis, in the part as it is given; the axis goes with the part */
    clast_vec3 axis;  /* any length > 0 */
    double speed;     /* rad/s */
    double swing;     /* rad; 0: none */
    double frequency; /* 1/s, > 0, of the swing */
    double phase;     /* in [0, 1), of a period of it */
} clast_rotation;

/* Straight from row to row; before the first and behind the last it stands. The world has a copy.
 */
typedef struct clast_motion_table {
    int rows;                 /* 0: no table */
    const double *time;       /* s since move_from, rising */
    const clast_vec3 *offset; /* m */
    const double *angle;      /* rad, about the axis of the rotation; may be NULL */
} clast_motion_table;

typedef struct clast_part_def {
    const char *name;
    clast_vec3 velocity; /* m/s, constant while moving */
    double move_from;    /* s; the belts of its walls run in the same time */
    double move_until;   /* s; 0 reads as never ending */
    double removed_at;   /* s; 0 reads as never */
    clast_stroke stroke;
    clast_oscillation oscillation;
    clast_rotation rotation;
    clast_motion_table table;
} clast_part_def;

int clast_part_add(clast_world *w, const clast_part_def *def);

typedef enum clast_wall_kind {
    CLAST_WALL_PLANE, /* infinite, material behind it: pushes along +normal */
    CLAST_WALL_PLATE, /* rectangle without thickness, pushes from both sides, has edges and corners
                       */
    CLAST_WALL_PATCH  /* flat piece of a mesh, likewise; made by clast_mesh_add() alone */
} clast_wall_kind;

typedef struct clast_wall_def {
    const char *name;
    clast_wall_kind kind;
    int material;
    clast_vec3 point;         /* m, a point of the plane, or the centre of the plate */
    clast_vec3 normal;        /* any length > 0; normalised */
    clast_vec3 side;          /* plate: direction of its first side, across the normal */
    double half_side[2];      /* m, plate: half lengths along side and normal x side; > 0 */
    clast_vec3 belt_velocity; /* m/s, surface velocity without motion (conveyor) */
} clast_wall_def;

int clast_wall_add(clast_world *w, int part, const clast_wall_def *def);

typedef struct clast_mesh_def {
    const char *name;
    int material;
    int vertices, triangles;
    const clast_vec3 *vertex; /* m */
    const int32_t *triangle;  /* three indices each; a vertex that two triangles share joins them */
    clast_vec3 belt_velocity; /* m/s */
    double smooth_angle;      /* rad, < pi/2: flat pieces that meet at less are one surface; 0 reads
                                 as CLAST_SMOOTH_ANGLE, below 0: every piece for itself */
} clast_mesh_def;

/* 35 degrees: joins the sides of a cylinder of 11 facets and more, the seams that a round nose is
 * cut into, a steep hopper and its silo; keeps apart the sides of a decagon and of every prism with
 * fewer, and whatever a user would call an edge. A number between the common 30 and 36, so that no
 * usual shape hangs on the last bit of its vertices. */
#define CLAST_SMOOTH_ANGLE 0.6108652381980153

/* A surface of triangles without thickness. Triangles that join and lie in one plane become one
 * wall (a patch) named NAME/0, NAME/1, ...: a sphere feels one contact per patch, whatever the
 * triangles, and an edge or corner only where no face is felt. Where patches go on smoothly in each
 * other it feels one contact with all of them, the deepest, whose history goes along from patch to
 * patch; where such a seam is hollow and turns by less than 16 degrees, it is felt rounded, up to
 * 1 % of the radius of the sphere above the triangles (engine/README.md). Places whose normals
 * differ by more than smooth_angle are felt side by side. Returns the
 * number of patches; their walls have the indices before clast_world_wall_count(). A triangle
 * without area is an error. */
int clast_mesh_add(clast_world *w, int part, const clast_mesh_def *def);

typedef struct clast_body_def {
    int shape;
    clast_vec3 position; /* m, centre of mass */
    clast_quat orientation;
    clast_vec3 velocity; /* m/s */
    clast_vec3 spin;     /* rad/s, world frame */
} clast_body_def;

/* Returns the body's id: 0, 1, 2, ... in the order of adding, stable for the whole run. */
int clast_body_add(clast_world *w, const clast_body_def *def);

/* ---- feeds and outlets: bodies that come and go while the world runs --------------------------
 */

typedef enum clast_full {
    CLAST_FULL_WAIT, /* what is owed is kept and comes as soon as there is room */
    CLAST_FULL_STOP  /* no room for a body that is due is a failure of the run */
} clast_full;

/* Body k is due when rate times time reaches what was fed before: at no time has more been fed than
 * rate times time and one body. It gets a place where its bounding sphere touches no other and no
 * wall. Everything is a function of the seed and the state, so a restart goes on alike. In worlds
 * of the leapfrog alone. */
typedef struct clast_feed_def {
    const char *name;
    clast_vec3 region_min, region_max; /* m, of the centres; equal in a direction: one layer */
    int shapes;                        /* number of kinds */
    const int *shape;                  /* kinds, drawn at random for each body */
    const double *share;               /* of the number of bodies, > 0, any sum; NULL: alike */
    double mass_rate;                  /* kg/s; or ... */
    double number_rate;                /* ... 1/s: one of the two is above zero */
    double from, until;                /* s; until 0 reads as never ending */
    clast_vec3 velocity, spin;         /* m/s, rad/s, on arrival */
    bool turned;                       /* at random, in a plane of motion about its normal ... */
    clast_quat orientation;            /* ... or all like this; {0}: not turned */
    int attempts; /* places tried for a body; then it waits for a hundred steps. 0 reads as 100 */
    clast_full full;
} clast_feed_def;

int clast_feed_add(clast_world *w, const clast_feed_def *def);

typedef enum clast_outlet_kind { CLAST_OUTLET_PLANE, CLAST_OUTLET_BOX } clast_outlet_kind;

/* A body whose centre is in an outlet at the end of a step leaves the world. */
typedef struct clast_outlet_def {
    const char *name;
    clast_outlet_kind kind;
    clast_vec3 point, normal; /* m, plane: what is beyond it, on the side of the normal, leaves */
    clast_vec3 min, max;      /* m, box */
} clast_outlet_def;

int clast_outlet_add(clast_world *w, const clast_outlet_def *def);

#define CLAST_OUTLET_DOMAIN (-1) /* left the domain, where that removes bodies */

/* One body that came or went. */
typedef struct clast_passage {
    uint32_t id;
    int32_t shape;
    int32_t gate;                  /* index of the feed, or of the outlet */
    uint64_t step;                 /* that it came or went in */
    double time;                   /* s, at the end of that step */
    double mass;                   /* kg */
    clast_vec3 position, velocity; /* m, m/s (of a body that went: in the middle of that step) */
} clast_passage;

/* Copies the oldest `room` records that have not been read and forgets them; returns how many. With
 * no room: how many there are. What is not read stays in memory and goes into checkpoints. */
size_t clast_world_arrivals(clast_world *w, clast_passage *to, size_t room);
size_t clast_world_departures(clast_world *w, clast_passage *to, size_t room);

/* So far. */
typedef struct clast_flow {
    uint64_t bodies;
    double mass;      /* kg */
    double owed;      /* kg, or bodies of a number rate, due and not fed; feeds */
    uint64_t refused; /* times that no place was found; feeds */
} clast_flow;

clast_flow clast_world_feed_flow(const clast_world *w, int feed);
clast_flow clast_world_outlet_flow(const clast_world *w, int outlet); /* or CLAST_OUTLET_DOMAIN */
int clast_world_feed_count(const clast_world *w);
int clast_world_outlet_count(const clast_world *w);
clast_feed_def clast_world_feed(const clast_world *w, int feed);
clast_outlet_def clast_world_outlet(const clast_world *w, int outlet); /* normalised */

/* ---- running -------------------------------------------------------------------------------- */

/* Checks the whole scene, picks kernel, time step and skin. Called by the first step if not before.
 * Fails on missing pairs, on bodies that overlap each other or a wall by more than max_overlap, on
 * bodies outside the domain; the message names all of them up to ten. */
clast_status clast_world_prepare(clast_world *w);

/* One time step; CLAST_ERR_GUARD when a guard stopped the run. */
clast_status clast_world_step(clast_world *w);

/* Steps until clast_world_time() >= time - dt/2. */
clast_status clast_world_run(clast_world *w, double time);

double clast_world_time(const clast_world *w);      /* s: step count times step, never summed up */
double clast_world_time_step(const clast_world *w); /* s */
uint64_t clast_world_steps(const clast_world *w);

/* Hash of the whole state (bodies by id, contacts by key, parts, clock): the same for any number of
 * threads, skin, instruction set and after a restart. */
uint64_t clast_world_hash(const clast_world *w);

/* Changes the friction of a pair in a running world (A00 4.3.2.1 settles without friction). */
clast_status clast_pair_set_friction(clast_world *w, int material_a, int material_b,
                                     double friction);

/* ---- reading a world ------------------------------------------------------------------------- */

/* Columns of the bodies in storage order, which changes when cells are sorted: identify by id.
 * Velocities are those at the time of the positions. Valid until the next step. */
typedef struct clast_bodies {
    size_t count;
    const uint32_t *id;
    const int32_t *shape;
    const double *x, *y, *z;         /* m */
    const double *qw, *qx, *qy, *qz; /* body to world */
    const double *vx, *vy, *vz;      /* m/s */
    const double *wx, *wy, *wz;      /* rad/s, world frame */
    const double *mass;              /* kg */
    const int32_t *rank;     /* number of the process that has it; NULL in a world of one */
    const int32_t *image[3]; /* along a periodic axis, else NULL: times that the body has left by
                                the upper face less those by the lower one. Position plus image
                                times length is a track without jumps */
} clast_bodies;

clast_bodies clast_world_bodies(clast_world *w);

/* Element spheres, grouped by body in the order of clast_bodies. */
typedef struct clast_spheres {
    size_t count;
    const double *x, *y, *z, *radius; /* m */
    const int32_t *body;              /* index into clast_bodies, not an id */
} clast_spheres;

clast_spheres clast_world_spheres(clast_world *w);

/* Contacts that touch now. a < b are body ids; b = CLAST_WALL_ID + wall index for walls. */
#define CLAST_WALL_ID 0x80000000u
typedef struct clast_contact {
    uint32_t a, b;
    int32_t sphere_a, sphere_b; /* index in the shape; sphere_b is 0 for walls */
    double overlap;             /* m */
    clast_vec3 point;           /* m */
    clast_vec3 force;           /* N, on a */
    double normal_force;        /* N, compression positive, with damping */
} clast_contact;

/* Copies at most `room` contacts, sorted by (a, b, sphere_a, sphere_b); returns how many there are.
 */
size_t clast_world_contacts(clast_world *w, clast_contact *contacts, size_t room);

typedef struct clast_energy {
    double kinetic, rotational; /* J */
    double gravity;             /* J, against the domain's lowest corner, bodies present. A fall
                                   along a periodic axis goes on across its faces */
    double elastic;             /* J, in contacts */
    double damping, friction;   /* J, dissipated so far: by normal dashpots and yielding; by
                                   tangential forces and rolling friction */
    double global;              /* J, dissipated so far by global damping */
    double wall_work;           /* J, done so far by moving walls on the bodies */
    double removed;             /* J, carried off by bodies that left */
    double fed;                 /* J, brought in by bodies that came */
    double input;               /* J, put in: motion and elastic energy at the start and of what
                                   came, height lost since, and all that walls did, back and
                                   forth */
    double residual;            /* J, what the sum misses: error of integrating normal contacts.
                                   Energy made elsewhere shows as friction or damping below zero */
} clast_energy;

clast_energy clast_world_energy(clast_world *w);

typedef struct clast_part_load {
    clast_vec3 force;  /* N, of the bodies on the part, now */
    clast_vec3 torque; /* N m, about `about`, of these forces (no rolling couples) */
    clast_vec3 about;  /* m: where the point of its rotation is now; the world origin without one */
    double power;      /* W, of the part on the bodies, now */
    double work;       /* J, done by the part on the bodies so far */
} clast_part_load;

clast_part_load clast_world_part_load(clast_world *w, int part);
bool clast_world_part_present(const clast_world *w, int part);
clast_vec3 clast_world_part_offset(const clast_world *w, int part); /* m, moved so far */

/* Where a part is: what is at x (m) in the walls as they are given is at turn(x) + shift. */
typedef struct clast_pose {
    clast_quat turn;
    clast_vec3 shift; /* m */
} clast_pose;

clast_pose clast_world_part_pose(const clast_world *w, int part);
clast_vec3 clast_pose_apply(clast_pose pose, clast_vec3 place);

/* Names and counts, for output and drawing. */
int clast_world_shape_count(const clast_world *w);
int clast_world_part_count(const clast_world *w);
int clast_world_wall_count(const clast_world *w);
int clast_world_material_count(const clast_world *w);
clast_shape_def clast_world_shape(const clast_world *w, int shape); /* with mass and inertia */
clast_part_def clast_world_part(const clast_world *w, int part);
clast_wall_def clast_world_wall(const clast_world *w, int wall); /* as at t = 0, normalised */
int clast_world_wall_part(const clast_world *w, int wall);
const clast_world_def *
clast_world_definition(const clast_world *w); /* with automatic values filled in */

/* ---- what the engine picked and what it cost ---------------------------------------------------
 */

typedef struct clast_plan {
    double time_step;     /* s, the one in use */
    double rayleigh_step; /* s, A00 1.28, smallest sphere */
    double contact_time;  /* s, shortest contact at the expected speed: of a clump that on its
                             outermost sphere, or flat on several at once */
    double critical_step; /* s, 2 / omega of the stiffest contact on the lightest body, likewise;
                             with the tangential spring of friction that sticks, undamped */
    double impact_speed;  /* m/s, that the contact time was taken at */
    double resolution;    /* contact_time / time_step */
    double skin;          /* m */
    int threads;        /* in use now */
    const char *isa;    /* "baseline", "avx2", "avx512" */
    const char *kernel; /* what was specialised, in words */
} clast_plan;

clast_plan clast_world_plan(const clast_world *w);

typedef struct clast_counters { /* seconds: below 1000 bodies of every 17th step, for all 17 */
    uint64_t steps, rebuilds, refreshes; /* of the reach list, of the contact list */
    size_t bodies, spheres;              /* now */
    size_t pairs;                        /* within the skin */
    size_t candidates;                   /* near enough to be looked at in every step */
    size_t contacts;
    uint64_t wall_tests; /* boxes and walls looked at to make lists, so far */
    double seconds_walls, seconds_neighbours, seconds_contacts, seconds_bodies, seconds_measure;
    size_t bytes;                            /* held by the engine now */
    double overlap_max;                      /* of the smaller radius, largest so far */
    size_t removed;                          /* bodies that left, by outlets too */
    size_t fed;                              /* bodies that came */
    uint64_t force_evaluations;              /* that the scheme asked for */
    uint64_t newton_iterations, newton_most; /* in all, in one step */
    uint64_t linear_iterations;              /* in all */
    uint64_t unconverged;                    /* steps in which Newton's method did not converge */
    uint64_t guard_trips;                    /* failures that `report` let pass */
    size_t ghosts;                           /* of other processes here, now */
    uint64_t ghosts_sent;                    /* rows of bodies to other processes, so far */
    uint64_t messages, message_bytes;        /* that this process sent them in steps, so far */
    uint64_t divisions, migrated;            /* of the world among processes; bodies that went */
} clast_counters;

clast_counters clast_world_counters(const clast_world *w);

/* The last step of an implicit scheme: how far the body moved that moved farthest, per iteration.
 * Valid until the next step; no iterations where the last step was not an implicit one. */
typedef struct clast_newton {
    bool converged;
    int iterations;
    const double *move; /* m */
} clast_newton;

clast_newton clast_world_newton(const clast_world *w);

/* ---- schemes ---------------------------------------------------------------------------------
 * One step, with x[0], v[0], a[0] at its start, x[1] a step before, ..., and a(next) the forces at
 * its end over the mass:
 *
 *     position = sum x[i] X[i] + dt sum v[i] V[i] + dt^2 (a_next A(next) + sum a[i] A[i])
 *     velocity = (x_next X(next) + sum x[i] X[i]) / dt + sum v[i] V[i]
 *                + dt (a_next A(next) + sum a[i] A[i])
 *
 * Explicit: `predict` and `felt` (with a_next = 0) are where the forces are taken, `keep` and
 * `kept` what is kept. Implicit: `keep` is solved for, forces feel its velocity by `felt`. */
typedef struct clast_scheme_position {
    double x[CLAST_LEVELS], v[CLAST_LEVELS], a[CLAST_LEVELS], a_next;
} clast_scheme_position;

typedef struct clast_scheme_velocity {
    double x_next, x[CLAST_LEVELS], v[CLAST_LEVELS], a[CLAST_LEVELS], a_next;
} clast_scheme_velocity;

typedef struct clast_scheme_info {
    const char *name; /* as scene files have it */
    bool implicit;
    int order, order_damped; /* of position and velocity, for smooth motion */
    int past;                /* levels behind x[0] */
    clast_scheme_position predict, keep;
    clast_scheme_velocity felt, kept;
    bool splits; /* a[i] and a_next are without dashpots; of these dt^2 (dashpot_next those of
                    `felt` at the end + dashpot those of `felt` at the start) is added to the
                    position and half of that over dt to the velocity */
    double dashpot, dashpot_next;
    double turn;      /* rotation: torque at the start, times dt, in the momentum it goes by */
    double felt_kick; /* the same in the momentum that forces feel */
    double kept_kick; /* share of the torque at the end in the momentum that is kept */
} clast_scheme_info;

const clast_scheme_info *clast_scheme_info_of(clast_scheme scheme);

/* ---- files ------------------------------------------------------------------------------------
 */

/* Writes everything the next step depends on (HDF5), atomically: a temporary file, then a rename.
 * `note` is a text of the caller that comes back on load (scene text, output clock); may be NULL.
 */
clast_status clast_checkpoint_save(clast_world *w, const char *path, const char *note);

/* Loads a state into a world that was built from the same scene and has not stepped yet: the run
 * then goes on as if it had never stopped, to the bit. *note is malloc'ed for the caller; may be
 * NULL. */
clast_status clast_checkpoint_load(clast_world *w, const char *path, char **note);

/* Takes over bodies (with pose, velocity, spin) and the tangential history of their contacts from a
 * checkpoint of another scene with the same shapes; the clock starts at zero. Wall contacts are
 * matched by wall name. The world must not have bodies yet. */
clast_status clast_checkpoint_inherit(clast_world *w, const char *path);

/* One frame (bodies, element spheres, contacts if asked) as group "/" of a new HDF5 file,
 * atomically. */
clast_status clast_frame_write(clast_world *w, const char *path, bool with_contacts);

/* ---- many processes -----------------------------------------------------------------------------
 * Started by mpirun, all build the same world, which is divided among them, and call the same in
 * the same order, readers too. Answers and failures are those of the whole world, on all, as one
 * process has them (but times, pairs, messages of clast_world_counters()); the first one writes
 * files. CLAST_ERR_ARGUMENT: schemes beside the leapfrog, laws of the user's own. See MPI.md. */

/* Before the first world; in the library clast_ranks. CLAST_ERR_ARGUMENT, after a message on the
 * error stream, where there are several processes and this build knows no MPI. */
clast_status clast_ranks_begin(void);
void clast_ranks_end(void);

int clast_ranks_number(void); /* of this process, 0 for the first; 0 without clast_ranks_begin() */
int clast_ranks_count(void);  /* 1 without clast_ranks_begin() */

/* The largest of what the processes say. All have to ask. */
double clast_ranks_most(double value);
/* What the first one says to all. */
void clast_ranks_tell(void *bytes, size_t size);

/* ---- helpers that scenes and studies need, with the engine's own bits ---------------- */

/* Uniform in [0, 1): a pure function of (seed, stream, counter), Philox 4x32-10. */
double clast_random(uint64_t seed, uint64_t stream, uint64_t counter);

/* sin and cos without libm, the same bits on every machine; |angle| <= 1e5 rad. */
void clast_sincos(double angle, double *sine, double *cosine);

/* A rotation drawn from all, for three numbers uniform in [0, 1). */
clast_quat clast_quat_uniform(double u, double v, double w);

/* Rotation by `angle` about unit `axis`. */
clast_quat clast_quat_axis_angle(clast_vec3 axis, double angle);

/* Damping ratio (c over critical, at the tangent stiffness) whose single collision, cut off where
 * the contact force would pull, rebounds with restitution e in (0.01, 1]. Solved with GSL.
 * Brilliantov: the number A (k^2 v / m^2)^(1/5) with k = 4/3 E* sqrt(R*) and impact speed v, which
 * the restitution depends on alone. Walton-Braun, which has no normal dashpot: that of the linear
 * law, for its tangential one. */
double clast_damping_ratio(clast_law law, double restitution);

/* The restitution that a given damping ratio yields: inverse of the above. */
double clast_restitution(clast_law law, double damping_ratio);

/* A of S12 2.37 (s) with which a collision at `speed` (m/s) of effective mass (kg), effective
 * radius (m) and modulus E* (Pa) rebounds with restitution e in (0.01, 1]; all > 0. */
double clast_dissipation(double restitution, double speed, double mass, double radius,
                         double e_star);

/* What a law is and which numbers of a pair it reads. */
typedef struct clast_law_info {
    const char *name; /* as scene files have it */
    bool linear;      /* force linear in the overlap: the Rayleigh step does not bind */
    bool stiffness;   /* reads stiffness; else it follows from the materials */
    bool dissipation; /* reads dissipation and reference_speed */
    bool yields;      /* keeps a plastic overlap */
    bool spring;      /* its own tangential force has a spring */
    bool shares;      /* its dashpots go with the mass of the bodies: CLAST_CLUMP_SHARED */
} clast_law_info;

const clast_law_info *clast_law_info_of(clast_law law);

#endif

/* world.h - how a world is laid out in memory. Private to engine/.
 *
 * Bodies move; their state lives in columns declared in ONE list, which drives store, sort,
 * checkpoint and hash. Velocities are those of the half step before the positions (leapfrog).
 * Element spheres are derived from body pose and shape at every step.
 * A pair is a body with a body or a wall within reach; a candidate is a pair of element spheres (or
 * a sphere and a wall) of a pair. Candidates carry the contact's history in place.
 */
#ifndef CLAST_WORLD_H
#define CLAST_WORLD_H

#include "engine/check.h"
#include "engine/clast.h"
#include "engine/sum.h"
#include "engine/vec.h"

/* ---- columns ----------------------------------------------------------------------------------
 */

#define BODY_COLUMNS(X)                                                     \
    X(uint32_t, id)      /* stable name of the body */                      \
    X(int32_t, shape)    /* index into shapes */                            \
    X(double, x)         /* m, centre of mass */                            \
    X(double, y)                                                            \
    X(double, z)                                                            \
    X(double, qw)        /* orientation, body to world */                   \
    X(double, qx)                                                           \
    X(double, qy)                                                           \
    X(double, qz)                                                           \
    X(double, vx)        /* m/s, at the half step before the position */    \
    X(double, vy)                                                           \
    X(double, vz)                                                           \
    X(double, lx)        /* J s, angular momentum, world frame, likewise */ \
    X(double, ly)                                                           \
    X(double, lz)                                                           \
    X(double, wx)        /* rad/s, spin that goes with l */                 \
    X(double, wy)                                                           \
    X(double, wz)

typedef struct body_store {
    size_t count, capacity;
#define X(type, name) type *name;
    BODY_COLUMNS(X)
#undef X
} body_store;

/* Pose of a body when the pair list was built. */
typedef struct built_pose {
    double x, y, z, qw, qx, qy, qz;
    double arm; /* m, from the centre of mass to the farthest centre of a sphere */
} built_pose;

typedef struct sphere_store {
    size_t count, capacity;
    double *x, *y, *z, *radius;
    int32_t *body;                       /* slot */
    size_t *first;                       /* first sphere of each body, count of bodies + 1 */
} sphere_store;

/* ---- what a scene is made of ----------------------------------------------------------------- */

typedef struct material {
    char *name;
    double density, young, poisson;
} material;

/* Everything a contact law needs that depends on the two materials only. */
typedef struct pair_coef {
    bool set;
    double e_star, g_star;            /* Pa; 1/E* = sum (1-nu^2)/E, 1/G* = sum (2-nu)/G */
    double stiffness, tangential;     /* N/m, linear law */
    double damping;                   /* ratio, solved for the restitution */
    double friction, cohesion, restitution;
} pair_coef;

typedef struct shape {
    char *name;
    int material, spheres, outline_points;
    vec3 *centre;
    double *offset[3]; /* the centres again, by coordinate */
    double *radius, *outline;
    double mass, bound;   /* bound: radius of the bounding sphere about the centre of mass */
    double arm;           /* farthest centre of a sphere from the centre of mass */
    vec3 inertia;
    double inverse_mass;
    vec3 inverse_inertia;
    bool round_inertia;   /* three equal moments: spin and angular momentum are parallel */
} shape;

typedef struct part {
    char *name;
    clast_part_def def;
    bool present;
    vec3 offset, velocity; /* now */
    vec3 built_offset;     /* when the pair list was built */
    double work_total;     /* J, done on the bodies so far */
} part;

typedef struct wall {
    char *name;
    int part;
    clast_wall_def def;    /* at t = 0 */
    vec3 u, v, n;          /* plate: sides and normal */
    vec3 point;            /* now */
    vec3 surface_velocity; /* now: part and belt */
    int *coplanar;         /* plates in the same plane that share a border with this one */
    int coplanar_count;
} wall;

/* ---- pairs and contacts ---------------------------------------------------------------------- */

typedef struct pair {
    int32_t a;         /* slot of the body with the lower id */
    int32_t b;         /* slot of the other body, or -1 - wall */
    int32_t coef;      /* index into coefs */
    uint32_t first;    /* first candidate */
    double mass;       /* kg, effective */
} pair;

typedef struct pair_force {
    vec3 force;        /* N, on a */
    vec3 torque_a, torque_b; /* N m, about the two centres of mass */
    int touching;      /* number of candidates that touch */
} pair_force;

/* What a contact remembers. overlap > 0 means that it touched at the last evaluation. */
typedef struct history {
    double overlap; /* m */
    vec3 spring;    /* N, tangential spring force on a */
    vec3 force;     /* N, whole force on a at the last evaluation */
} history;

/* Candidates are columns, for the vector lanes of the narrow phase. */
typedef struct candidate_store {
    size_t count, capacity;
    int32_t *a, *b;          /* indices into spheres; b = -1 - wall */
    double *radius;          /* m, effective */
    history *histories;
    unsigned char *touching; /* history.overlap > 0 */
} candidate_store;

/* A body's side of a pair, for the gather; sorted by partner id, walls last. */
typedef struct incidence {
    uint32_t pair;
    int32_t side; /* +1: the body is a, -1: it is b */
} incidence;

typedef struct partner {
    uint32_t id;
    int32_t slot;
} partner;

typedef struct pair_list {
    size_t pair_count, pair_capacity;
    pair *pairs;             /* body pairs in slot order of a, then walls; one more as a stop */
    pair_force *forces;
    candidate_store candidates;
    size_t wall_pairs;       /* index of the first wall pair */
    incidence *incidences;
    size_t *incidence_first; /* per slot, count of bodies + 1 */
    size_t incidence_capacity, slot_capacity;
    size_t *block_first;     /* pair index where each block of the contact pass begins */
    size_t block_count, block_capacity;
    partner *partners;       /* scratch of the search, one body's at a time */
    size_t partner_room;
    bool stale;
} pair_list;

/* One touching contact by names instead of places: what survives a rebuild and goes into files. */
typedef struct contact_record {
    uint32_t a, b;                /* ids; b = CLAST_WALL_ID + wall */
    int32_t sphere_a, sphere_b;   /* within the shapes */
    history history;
} contact_record;

typedef struct record_list {
    size_t count, capacity;
    contact_record *items;
    size_t *first; /* per id of a: first record; next_id + 1 entries */
    size_t first_capacity;
} record_list;

/* ---- the contact kernel ---------------------------------------------------------------------- */

/* What one thread finds out during a contact pass. */
typedef struct contact_tally {
    exact_sum elastic, dashpot;  /* J, work of the normal forces */
    exact_sum *part_work;        /* J, per part */
    double overlap_max;          /* of the smaller radius; infinite when a force is not a number */
    size_t contacts;
    char pad[64];                /* threads do not share a cache line */
} contact_tally;

/* What one thread finds out while it moves bodies. */
typedef struct body_tally {
    exact_sum global;  /* J, lost to global damping */
    exact_sum contact; /* J, work of the contact forces */
    double step2_max;  /* m2, longest way of a sphere in this step, squared; infinite when not a
                          number */
    bool stale, outside;
    char pad[64];
} body_tally;

typedef void contact_kernel(clast_world *w, size_t block_begin, size_t block_end,
                            contact_tally *tally);

/* A grid of cubic cells over the bodies, remade at every rebuild. */
typedef struct cell_grid {
    vec3 low;
    double size; /* m */
    int nx, ny, nz;
} cell_grid;

typedef struct ledger {
    sum_scale scale;
    double work;                                 /* J, of the contact forces on all bodies so far */
    double elastic, dashpot;                     /* J, of that by normal springs and dashpots */
    double global, wall_work;                    /* J, so far */
    double wall_input;                           /* J, of the wall work without sign, per step */
    double start_tangential; /* J in tangential springs at step 0, less what has left */
    double removed, removed_gravity;             /* J carried off: in all, and by height alone */
    double start_total, start_gravity;           /* J at step 0 */
} ledger;

struct clast_world {
    clast_world_def def;
    bool prepared;
    uint64_t step;
    double dt;

    material *materials;
    shape *shapes;
    part *parts;
    wall *walls;
    pair_coef *coefs; /* material_count squared */
    int material_count, shape_count, part_count, wall_count;

    body_store bodies;
    sphere_store spheres;
    built_pose *built; /* per slot */
    size_t built_capacity;
    pair_list list;
    record_list records;
    uint32_t next_id;
    int32_t *slot_of_id; /* -1 = gone */
    size_t slot_of_id_capacity;

    contact_kernel *kernel;
    const char *isa_name;
    int threads;
    double skin, smallest_radius, largest_bound;
    double overlap_now; /* of the smaller radius, largest at the last evaluation */
    double
        contact_dt; /* s, step that the springs of the current evaluation have been loaded over */
    contact_tally *tallies;
    body_tally *body_tallies, found;
    exact_sum *tally_work;
    ledger ledger;

    struct { /* synchronised velocities for readers */
        double *vx, *vy, *vz, *wx, *wy, *wz, *mass;
        size_t capacity;
        double kinetic, rotational; /* J */
        double half_global;         /* J, half of what global damping takes in the next kick */
        double
            work_arrived; /* J, the part of the next kick's work that belongs to the way so far */
    } view;

    struct { /* scratch of the neighbour search */
        cell_grid grid;
        uint32_t *cell_of, *cell_first, *order;
        size_t body_capacity, cell_capacity;
        void *permute;
        size_t permute_capacity;
    } cells;

    clast_counters counters;
    clast_plan plan;
    bool failed, parts_changed;
    char error[4096];
};

/* ---- who does what --------------------------------------------------------------------------- */

/* memory.c: growing arrays; all memory of a world is counted. Stops the program when there is none.
 */
void *memory_grow(clast_world *w, void *old, size_t old_count, size_t count, size_t size);
void *memory_copy(clast_world *w, const void *from, size_t count, size_t size);
char *memory_text(clast_world *w, const char *text);
void memory_release(void *p);

/* error.c */
int world_fail(clast_world *w, clast_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void world_complain(clast_world *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* body.c */
void body_reserve(clast_world *w, size_t count);
void body_permute(clast_world *w, const uint32_t *order);
void body_remove(clast_world *w, size_t slot);
void spheres_layout(clast_world *w);
void spheres_place(clast_world *w, size_t body_begin, size_t body_end);
vec3 body_position(const clast_world *w, size_t slot);
quat body_orientation(const clast_world *w, size_t slot);
bool body_is_outside(const clast_world *w, size_t slot);
vec3 body_spin_of(const clast_world *w, int32_t shape, quat q, vec3 angular_momentum);

/* wall.c */
void walls_link(clast_world *w);
void walls_move(clast_world *w);

/* cells.c, pairs.c, records.c */
void cells_sort(clast_world *w, double reach);
void pairs_rebuild(clast_world *w);
void records_collect(clast_world *w);
void records_apply(clast_world *w);
void records_sort(clast_world *w);
void records_reserve(clast_world *w, size_t count);

/* contact.c: runs the kernel on all blocks, adds up tallies */
void contacts_evaluate(clast_world *w);
void contacts_restore(clast_world *w);
void contacts_choose_kernel(clast_world *w);
typedef struct stored_energy {
    double normal, tangential; /* J */
} stored_energy;
stored_energy contact_stored_energy(const clast_world *w, const pair *p, size_t candidate);
stored_energy contacts_stored_energy(const clast_world *w);

/* motion.c */
void bodies_advance(clast_world *w);
void body_load(const clast_world *w, size_t slot, vec3 *force, vec3 *torque);
void plane_advance(clast_world *w, size_t slot, body_tally *tally);
void plane_place_spheres(clast_world *w, size_t body_begin, size_t body_end);
void velocities_start(clast_world *w);
void velocities_synchronise(clast_world *w);

/* ledger.c, guard.c, timestep.c */
void ledger_set_scale(clast_world *w);
void ledger_start(clast_world *w);
void ledger_remove_body(clast_world *w, size_t slot);
void ledger_remove_contacts(clast_world *w, stored_energy before);
clast_status guards_check(clast_world *w);
clast_status guards_check_start(clast_world *w);
clast_status guards_check_energy(clast_world *w);
clast_status guards_outside(clast_world *w);
clast_status timestep_choose(clast_world *w);
double timestep_rayleigh(const clast_world *w);

double world_seconds(void);

#endif

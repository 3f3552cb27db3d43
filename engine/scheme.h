/* scheme.h - what the schemes beside the leapfrog share. Private to engine/.
 *
 * At a step boundary such a world holds x(n), v(n), q(n), L(n) in the columns of the bodies,
 * histories and loads of the contacts at this very state, and in columns of its own what the scheme
 * remembers. A step tries states: it writes them into the columns of the bodies and asks for the
 * forces there (scheme_trial.c), which are a function of that state and of the histories at the
 * start of the step. Sources: S12 2.7 and 3.3, by equation in scheme.c. */
#ifndef CLAST_ENGINE_SCHEME_H
#define CLAST_ENGINE_SCHEME_H

#include "engine/sparse.h"
#include "engine/world.h"

/* ---- columns --------------------------------------------------------------------------------- */

/* Three columns each, world frame. */
typedef enum triple {
    X_AGO,                        /* m, positions at the start of the step, a step before, ... */
    V_AGO = X_AGO + CLAST_LEVELS, /* m/s, likewise */
    A_AGO = V_AGO + CLAST_LEVELS, /* m/s2, likewise; without dashpots where the scheme splits */
    A_NEXT = A_AGO + CLAST_LEVELS,
    TORQUE, /* N m, that the scheme takes at the start of the step, global damping included */
    TORQUE_NEXT,
    MOMENTUM, /* J s, at the start of the step */
    TURN,     /* vector part of the orientation there */
    FORCE,    /* N, of the contacts there */
    COUPLE,   /* N m, of the contacts there */
    DASHPOT,  /* m/s2, of the dashpots: schemes that split */
    KNOWN,    /* m, the new position but for the forces at it: implicit schemes */
    STAGE,    /* m/s2, of the starter */
    STAGE_2,
    TRIPLES
} triple;

/* qw at the start of the step stands behind the triples. */
enum { TURN_W = 3 * TRIPLES, SCHEME_COLUMNS };

/* ---- what a trial must not touch ------------------------------------------------------------- */

typedef struct list_copy {
    void *column[HISTORY_COLUMNS];
    size_t capacity;
} list_copy;

typedef struct book_copy {
    ledger ledger;
    double overlap_max, overlap_now;
    size_t contacts;
    part_push *push; /* per part */
    double *work;    /* J, per part */
} book_copy;

/* Where everything was when the lists were made. */
typedef struct list_reference {
    uint64_t rebuild; /* counter of rebuilds then */
    size_t capacity;
    double *x[3], *q[4];
    part_place *part;
} list_reference;

/* ---- Newton's method ------------------------------------------------------------------------- */

/* What a touching contact adds to the Jacobian. */
typedef struct bond {
    contact_record name; /* first: bonds are sorted as records are */
    vec3 n;
    double along, across; /* kg, against displacements along n and across it */
} bond;

typedef struct newton_store {
    sparse_matrix matrix;
    bond *bonds;
    size_t bond_room, bond_count;
    uint32_t *rank; /* row of the body of an id */
    size_t rank_room, rows;
    double *residual, *move, *last; /* kg m, m, m made last: three per row, by rank */
    double *reach;       /* m that a body may move, iterations that it has gone on: two per row */
    double *base;        /* m: the best places so far, where they are searched for; by rank */
    double missed, part; /* kg2 m2, the square of the residual there; of the ways from there */
    double *scratch;     /* of the linear solver */
    size_t row_room;
    double *history;            /* m, largest move made in each iteration of the last step */
    int iterations, held_until; /* until then bodies are held one by one */
    size_t pinned;              /* rows of bodies at a jump of their force */
    size_t farthest;            /* row of the body that went farthest in the last iteration, */
    double way;                 /* m, so far; or that wants to, where the iterations ended */
    bool converged;
} newton_store;

struct integrator {
    const clast_scheme_info *info;
    size_t capacity;
    double *column[SCHEME_COLUMNS];
    list_copy *lists; /* two per share */
    book_copy books;
    list_reference reference;
    size_t touching; /* contacts of the last trial */
    newton_store newton;
};

static inline vec3 triple_at(const integrator *s, int t, size_t i) {
    double *const *c = &s->column[3 * t];
    return v3(c[0][i], c[1][i], c[2][i]);
}

static inline void triple_put(integrator *s, int t, size_t i, vec3 a) {
    double *const *c = &s->column[3 * t];
    c[0][i] = a.x, c[1][i] = a.y, c[2][i] = a.z;
}

static inline void body_place(clast_world *w, size_t i, vec3 x) {
    w->bodies.x[i] = x.x, w->bodies.y[i] = x.y, w->bodies.z[i] = x.z;
}

static inline vec3 body_velocity(const clast_world *w, size_t i) {
    return v3(w->bodies.vx[i], w->bodies.vy[i], w->bodies.vz[i]);
}

static inline void body_speed_up(clast_world *w, size_t i, vec3 v) {
    w->bodies.vx[i] = v.x, w->bodies.vy[i] = v.y, w->bodies.vz[i] = v.z;
}

static inline vec3 body_momentum(const clast_world *w, size_t i) {
    return v3(w->bodies.lx[i], w->bodies.ly[i], w->bodies.lz[i]);
}

static inline void body_spin_up(clast_world *w, size_t i, vec3 l) {
    w->bodies.lx[i] = l.x, w->bodies.ly[i] = l.y, w->bodies.lz[i] = l.z;
}

/* scheme_columns.c */
void columns_grow_older(integrator *s);
void columns_wrap(clast_world *w);

/* scheme_trial.c */
void trial_preload(clast_world *w);
void trial_begin(clast_world *w);
void trial_keep_books(clast_world *w);
void trial_undo(clast_world *w);
void trial_try(clast_world *w, double spring_time);
void trial_accept(clast_world *w);
clast_status trial_rebuild(clast_world *w);
bool trial_needs_velocity(const clast_world *w);
void trial_free(clast_world *w);

/* scheme_step.c: the rules of the table for one body, and what all schemes do */
vec3 rule_position(const integrator *s, const clast_scheme_position *r, size_t i, double dt,
                   vec3 a_next);
vec3 rule_velocity(const integrator *s, const clast_scheme_velocity *r, size_t i, double dt, vec3 x,
                   vec3 a_next);
vec3 gravity_felt(const clast_world *w);
void take_accelerations(clast_world *w, int accelerations);
void elastic_forces(clast_world *w, double spring_time);
void split_forces(clast_world *w);
void split_forces_kept(clast_world *w);
void feel_velocities(clast_world *w);
void turn_bodies(clast_world *w, double fraction);
void correct_momenta(clast_world *w);
clast_status step_settle(clast_world *w, bool with_velocities);

/* scheme_explicit.c, scheme_implicit.c: from the start of a step to its end */
clast_status step_start(clast_world *w);
clast_status step_explicit(clast_world *w);
clast_status step_implicit(clast_world *w);

/* scheme_bonds.c */
void bonds_rank(clast_world *w);
void bonds_assemble(clast_world *w, const clast_scheme_info *info);
void bonds_free(newton_store *n);

#endif

/* world_data.h - how a world is laid out in memory. Private to engine/.
 *
 * Bodies move; their state lives in columns declared in ONE list, which drives store, sort,
 * checkpoint and hash. Velocities are those of the half step before the positions (leapfrog).
 * What the contact pass reads of a body stands in rows of one cache line, derived at every step:
 * centres of its element spheres, velocity and spin. What it writes are loads: sums of forces and
 * torques in 64-bit fixed point, which have no order (loads.h).
 * Two lists lead to the contacts. The reach list holds the pairs of spheres within the skin and is
 * rebuilt when something has moved half of it; the contact list holds those of them that touch or
 * nearly touch and is refreshed, from the reach list, much more often. Contacts carry their history
 * in place. Every thread owns a range of bodies with their lists: a share.
 *
 * The kernel frame: for motion in a plane the rows, loads and histories have the axis of the plane
 * as third coordinate (a cyclic change of names); everywhere else it is the world frame.
 */
#ifndef CLAST_WORLD_DATA_H
#define CLAST_WORLD_DATA_H

#include "engine/clast.h"
#include "engine/sum.h"
#include "engine/vec.h"

/* ---- columns --------------------------------------------------------------------------------- */

#define BODY_COLUMNS(X)                                                                            \
    X(uint32_t, id)   /* stable name of the body */                                                \
    X(int32_t, shape) /* index into shapes */                                                      \
    X(double, x)      /* m, centre of mass */                                                      \
    X(double, y)                                                                                   \
    X(double, z)                                                                                   \
    X(double, qw) /* orientation, body to world */                                                 \
    X(double, qx)                                                                                  \
    X(double, qy)                                                                                  \
    X(double, qz)                                                                                  \
    X(double, vx) /* m/s, at the half step before the position */                                  \
    X(double, vy)                                                                                  \
    X(double, vz)                                                                                  \
    X(double, lx) /* J s, angular momentum, world frame, likewise */                               \
    X(double, ly)                                                                                  \
    X(double, lz)

typedef struct body_store {
    size_t count, capacity;
#define X(type, name) type *name;
    BODY_COLUMNS(X)
#undef X
    int32_t *image[3]; /* lengths of the domain that it has come back by; periodic axes alone */
} body_store;

/* ---- rows of the contact pass, kernel frame -------------------------------------------------- */

enum { LINE = 64 }; /* bytes of a cache line */

typedef struct centre_row {
    double x, y, z, radius; /* m */
} centre_row;

static inline vec3 centre_at(const centre_row *c) {
    return v3(c->x, c->y, c->z);
}

typedef struct motion_row {
    double v[3]; /* m/s */
    double mass; /* kg */
    double w[3]; /* rad/s */
    int64_t material;
} motion_row;

typedef struct arm_row {
    double arm[3]; /* m, from the centre of mass to the centre of the sphere */
    int64_t body;  /* slot */
} arm_row;

typedef struct inertia_row { /* 1/(kg m2), of the inverse moments */
    double xx, yy, zz, none;
    double yz, zx, xy, nothing;
} inertia_row;

typedef struct load_row { /* fixed point; [3] is not used */
    int64_t force[4];
    int64_t torque[4]; /* about the centre of mass */
} load_row;

typedef struct row_store {
    size_t bodies, spheres; /* room */
    motion_row *motion;     /* per body */
    load_row *loads;        /* per body; zero between the kick and the contact pass */
    centre_row *centre;     /* per sphere */
    arm_row *arm;           /* per sphere; worlds of clumps alone */
    inertia_row *inertia;   /* per body; worlds of shared dashpots alone */
    uint32_t *first;        /* per body and one more: its first sphere; worlds of clumps alone */
} row_store;

/* Where a sphere was when the lists were made, m; kernel frame. */
typedef struct place_row {
    float reach[3], contacts[3];
} kept_place;

typedef struct way_bound {
    double bound; /* m: half of what two things can have come nearer since the list was made */
    double walls; /* m: no wall has moved farther */
} way_bound;

typedef struct way_store {
    way_bound reach, contacts;
    kept_place *places; /* per sphere */
    size_t capacity;
    bool knows_reach, knows_contacts; /* the places are of these lists */
} way_store;

/* Quanta of the loads. A contact's force is at most limit; the sums wrap beyond four of them. */
typedef struct load_scale {
    double force, torque; /* quanta per N, per N m: powers of two */
    double force_quantum, torque_quantum;
    double limit; /* quanta */
} load_scale;

/* Axes along which the domain repeats itself. */
typedef struct period {
    bool any;
    double length[3], half[3]; /* m; 0 and endless along the other axes */
} period;

/* ---- what a scene is made of ----------------------------------------------------------------- */

typedef struct material {
    char *name;
    double density, young, poisson;
} material;

/* Everything a contact law needs that depends on the two materials only. */
typedef struct pair_coef {
    bool set;
    double e_star, g_star;   /* Pa; 1/E* = sum (1-nu^2)/E, 1/G* = sum (2-nu)/G */
    double stiffness, ratio; /* N/m as given; tangential over normal, 0: as law.c has it */
    double damping;          /* ratio, solved for the restitution */
    double tangential_restitution;
    double dissipation, reference_speed; /* s, m/s; dissipation is solved in preparing */
    bool dissipation_given;
    double friction, cohesion, restitution, rolling;
    double k_normal, k_tangent; /* per a = sqrt(R d): 2 E*, 8 G* in Pa; linear: N/m per law_scale()
                                 */
    double c_normal, c_tangent; /* dashpots per sqrt(a m): 2 ratio sqrt(k); Brilliantov: per a */
    double yield;               /* Walton-Braun: plastic over largest overlap, 1 - k1 / k2 */
    double parameter[CLAST_LAW_PARAMETERS]; /* of a law of the user's own */
} pair_coef;

typedef struct shape {
    char *name;
    int material, spheres, outline_points;
    vec3 *centre;
    double *radius, *outline;
    double mass, bound; /* bound: radius of the bounding sphere about the centre of mass */
    double arm;         /* farthest centre of a sphere from the centre of mass */
    vec3 inertia;
    double inverse_mass;
    vec3 inverse_inertia;
    bool round_inertia; /* three equal moments: spin and angular momentum are parallel */
    double turning; /* kg m2, what rolling friction may bring to rest in one step, per contact */
} shape;

/* Against t = 0 of a part that has not moved; turned about the axis of its rotation. */
typedef struct part_place {
    vec3 offset, velocity; /* m, m/s */
    double angle, spin;    /* rad, rad/s, about the axis */
} part_place;

/* What a part does to the bodies, by the forces of one evaluation. Kernel frame. */
typedef struct part_push {
    vec3 force;    /* N */
    double moment; /* N m, about its axis; parts that turn alone */
    double belt;   /* W, of surfaces that run without motion */
} part_push;

typedef struct part_sums {
    exact_sum force[3], moment, belt;
} part_sums;

/* The forces of the walls of a part, quanta of the loads: sums of the lower and of the upper halves
 * of each force and PUSH_OFFSET, which have room for a thousand million of them. [3] counts: it is
 * that of no force. */
typedef struct push_row {
    uint64_t low[4], high[4];
} push_row;
#define PUSH_OFFSET INT64_C(0x4000000000000000)

/* For walls of parts that stay: contacts of two walls do not wait for each other. */
enum { NOBODYS_ROWS = 4 };

/* Boxes around the plates and patches of a part, where they stand at t = 0 (wall_tree.c). */
typedef struct wall_tree {
    int walls, leaves;  /* leaves: a power of two */
    int *wall;          /* those with an end, in the order of a curve through their middles */
    float *box;         /* 6 per node: low and high corner; node k has 2 k + 1 and 2 k + 2 */
    int planes, *plane; /* those without an end */
    vec3 anchor_low, anchor_high; /* m, of the box around the anchors of the former */
} wall_tree;

typedef struct part {
    char *name;
    clast_part_def def;
    bool present, running;
    bool turns, shifts; /* ever */
    bool steady;        /* moves by its velocity alone, if at all */
    vec3 axis;          /* unit */
    mat3 turn;          /* now, of a part that turns */
    part_place at;      /* now; velocities at the time that those of the bodies are of */
    part_place end;     /* at the end of this step */
    part_place start;   /* at its start */
    double lever;       /* m: a turn by a radian moves no place of its walls near bodies farther */
    double tilt;        /* of that, per m of offset: planes alone */
    double reach;       /* m, of plates and patches from the axis */
    double wall_way;    /* m, that the lists must allow for the last move */
    double wall_step;   /* m, that no place of its plates and patches has moved farther by it */
    int *walls, wall_count;
    int *near, near_count, near_capacity; /* those in the reach lists, of a part that moves */
    part_push push;                       /* of the last evaluation */
    double work_total;                    /* J, done on the bodies so far */
    wall_tree tree;
} part;

/* The triangles of a flat piece of a mesh, in the plane of its wall: coordinates along u and v. */
typedef struct patch {
    int triangles;
    double *corner; /* m, from the wall's point: 3 x (u, v) per triangle */
} patch;

/* How a hollow seam of a smooth patch is rounded, as one of its two facets has it (fillet.c): in
 * the plane of its wall, on one of its sides. */
typedef struct fillet {
    double from[2]; /* m, where the seam begins */
    double way[2];  /* unit, where it goes */
    double inward;  /* 1: the facet is to the left of it; -1 */
    double side;    /* 1: hollow where the normal of the facet points to; -1 */
    double tangent; /* of half the angle between the two facets */
    double cap;     /* radii of a sphere, that it is wide at most */
    double length;  /* m */
    double width;   /* m, from the seam into the facet, but for its ends */
    double rise[2]; /* m, over which it comes to that from either end */
    double endless; /* m, its width where its facets have no ends */
} fillet;

typedef struct fillet_list {
    int count;
    fillet *item;
    double width, cap; /* the largest of them */
} fillet_list;

/* Of a plate, or of the whole mesh of a patch; for periodic axes. */
typedef struct wall_extent {
    vec3 half;     /* m, of the box about the anchor, in the frame of the part */
    bool ruled[3]; /* the same in every section across this axis, but for its ends */
} wall_extent;

typedef struct wall {
    char *name;
    int part;
    clast_wall_def def;  /* at t = 0 */
    vec3 u, v, n;        /* now, where it is near; plate, patch: sides and normal */
    vec3 u_home, v_home; /* the sides in the frame of the part; the normal is that of def */
    vec3 point;          /* likewise */
    vec3 belt;           /* m/s, likewise */
    bool pushes;         /* its part moves or it has a belt: its work is booked */
    bool drives;         /* its part turns or it has a belt */
    bool near;           /* in the near ones of its part */
    double bound;        /* m, plate, patch: radius about the point that holds it all */
    vec3 half_box;       /* m, of the box about the point, likewise */
    vec3 anchor;         /* m, likewise: spheres feel it in their image nearest to this place */
    vec3 anchor_start;   /* m, in the frame of the part */
    wall_extent extent;
    patch patch;
    bool is_rectangle; /* a patch that fills the rectangle of half_side about its point */
    double rim; /* m: farther inside its box than this is inside a patch; WALL_ENDLESS: nowhere */
    int family; /* those of a mesh, or plates in one plane: one may hide another; -1: none does */
    int smooth; /* facets of one smooth patch: the first of its walls; -1: for itself */
    double smooth_cosine; /* of the angle within which they are felt as one */
    fillet_list fillets;
} wall;

/* m, half a side of what has no end; its square is a number. */
#define WALL_ENDLESS 0x1p500

/* What the contact pass reads of a wall, kernel frame (wall_lanes.h). Zeros, so that the row of a
 * sphere less that of a wall keeps what stands behind its vector. */
typedef struct wall_row {
    double point[3], zero;  /* m, now */
    double motion[3], none; /* m/s, of the surface, now; without what comes by turning */
    double n[3], half_u;    /* m */
    double u[3], half_v;    /* m; endless: a plane, which has one side */
    double v[3], rim;       /* m: nearer to the border another wall may hold the point; more than
                               endless: a facet with fillets */
} wall_row;

/* ---- lists ----------------------------------------------------------------------------------- */

/* What a contact remembers, world frame, as seen by a. overlap > 0: it touched when last evaluated.
 */
typedef struct history {
    double overlap; /* m */
    double normal;  /* N, elastic and dashpot */
    vec3 spring;    /* N, tangential spring force on a */
    double plastic; /* m, overlap at which unloading ends; 0 but for Walton-Braun. A law of the
                       user's own keeps its memory here */
} history;

/* Columns of a history: overlap, normal force, spring in the kernel frame, and in worlds with a law
 * that yields the plastic overlap. A world without it has HISTORY_PLASTIC columns. */
enum { HISTORY_SPRING = 2, HISTORY_PLASTIC = 5, HISTORY_COLUMNS = 6 };

/* Pairs that touch or nearly touch, sorted by a. Columns of double, or of float in a world of mixed
 * precision, with room for a whole batch behind the last. */
typedef struct contact_list {
    size_t count, capacity;
    int32_t *a, *b;                /* spheres, a < b; b is a wall in a list of walls */
    void *column[HISTORY_COLUMNS]; /* the last is NULL where there is none */
} contact_list;

enum { ENTRIES_BEHIND = 64 };
#define NOT_CARRIED UINT32_MAX

/* Entries to be, and where their histories stand (carry.c). */
typedef struct found_list {
    size_t count, capacity;
    int32_t *a, *b;
    uint32_t *source;
} found_list;

/* Spheres of higher index within the skin, sphere by sphere. */
typedef struct reach_list {
    size_t count, capacity, first_capacity, ahead_capacity;
    int32_t *partner;
    uint32_t *first; /* per sphere of the share and one more */
    int32_t *ahead;  /* scratch: bodies ahead of one body */
} reach_list;

/* Contacts that share a dashpot (shared.c): of two or more, by body. */
typedef struct contact_groups {
    size_t count, capacity;
    uint32_t *first;  /* per group and one more: its first place in member */
    uint32_t *member; /* entries of the contact list, in an order of names */
} contact_groups;

typedef struct group_item {
    uint32_t partner, entry;
    uint64_t place; /* of the two spheres in their shapes */
} group_item;

typedef struct wall_reach {
    size_t count, capacity;
    int32_t *sphere, *wall;
} wall_reach;

/* What one thread finds out during a contact pass. */
typedef struct contact_tally {
    exact_sum elastic, dashpot; /* J, work of the normal forces */
    double overlap_max;         /* of the smaller radius; infinite when a force is not a number or
                                   too large for the loads */
    size_t contacts;
} contact_tally;

/* What one thread finds out while it moves bodies. */
typedef struct body_tally {
    exact_sum global;    /* J, lost to global damping */
    exact_sum contact;   /* J, work of the contact forces */
    exact_sum unwrapped; /* J, as in the ledger */
    double way;          /* m, longest way of a point of a body in this step; infinite when not a
                            number */
    bool outside;
} body_tally;

/* Per contact, for readers: filled on request by a contact pass that changes nothing. */
typedef struct contact_report {
    vec3 normal, force; /* kernel frame; normal from b to a, force on a */
    double lever;       /* m, from the centre of a to the contact point */
} contact_report;

typedef struct share {
    _Alignas(LINE) size_t body_begin;
    size_t body_end, sphere_begin, sphere_end;
    reach_list reach;
    wall_reach wall_reach;
    contact_list contacts, walls;
    found_list found[2];      /* while they are made */
    contact_groups groups[2]; /* of contacts and of walls; worlds of shared dashpots alone */
    int32_t *around;          /* scratch: walls around one body */
    size_t around_capacity;
    struct wall_touch *touches; /* scratch: of one sphere, or one body */
    size_t touch_capacity;
    uint64_t wall_tests; /* boxes and walls that were looked at to make lists */
    group_item *items;   /* scratch: contacts of one body */
    void *batches;       /* scratch: shared_batch, for the contacts of one body */
    size_t item_capacity;
    load_row *overhang; /* of bodies from body_end on that this share's contacts load */
    size_t overhang_count, overhang_capacity;
    contact_tally contact_tally;
    body_tally body_tally;
    double way_reach[2], way_contacts[2]; /* m, the two longest, measured by way.c */
    part_sums *pushes;                    /* per part */
    push_row *push_rows;                  /* per part, and NOBODYS_ROWS */
    contact_report *report, *wall_report; /* when asked for, per contact */
    bool across; /* pairs of own bodies and ghosts that their own process books (ranks.h) */
} share;

/* One entry of a list of contacts. */
typedef struct contact_place {
    const contact_list *list;
    size_t index;
    bool with_wall;
} contact_place;

/* One touching contact by names instead of places: what survives a rebuild and goes into files. */
typedef struct contact_record {
    uint32_t a, b;              /* ids; b = CLAST_WALL_ID + wall */
    int32_t sphere_a, sphere_b; /* within the shapes */
    history history;
} contact_record;

typedef struct record_list {
    size_t count, capacity;
    contact_record *items;
} record_list;

/* Lists of the shares from before a rebuild: spheres and walls in turn. */
typedef struct carry_store {
    int lists, list_capacity;
    contact_list *list;
    uint32_t *base;  /* per list and one more: number of its first entry */
    uint32_t *first; /* per sphere and two more: its first place in the order */
    uint32_t *order; /* entries by their sphere of lower index */
    size_t entries;
} carry_store;

typedef struct carried {
    int32_t partner;
    bool with_wall;
} carried;

/* ---- kernels --------------------------------------------------------------------------------- */

/* again: forces of the state as it is, once more; changes nothing but loads. */
typedef enum contact_mode { CONTACTS_ADVANCE, CONTACTS_AGAIN, CONTACTS_REPORT } contact_mode;
typedef void contact_kernel(const clast_world *w, share *s, contact_mode mode);
typedef void body_kernel(clast_world *w, share *s);

/* What the kernels need not do in this scene. */
typedef struct speciality {
    bool flat;     /* centres and wall normals in one plane: no third coordinate */
    bool clumps;   /* some body has several spheres, or one off its centre */
    bool tangent;  /* friction or cohesion somewhere */
    bool one_kind; /* all spheres alike: radius, mass, material */
    bool one_material, one_shape;
    bool one_wall; /* spheres of one kind, walls of one material */
    bool round;    /* all bodies have three equal moments */
    bool oriented; /* it matters how bodies are turned: clumps, or asked for */
    bool spring;   /* tangential force: spring and dashpot, else the dashpot alone */
    bool rolling;  /* rolling friction somewhere */
    bool shared;   /* clumps, whose dashpots are shared */
    bool turning;  /* some part turns */
    bool pushing;  /* some part moves or has a belt */
    bool driving;  /* some part turns or has a belt */
    bool facets;   /* walls that may hide each other */
    bool fillets;  /* facets with fillets */
} speciality;

/* A grid of cells over the bodies, remade at every rebuild; cubic but along periodic axes. */
typedef struct cell_axis {
    double low, size; /* m */
    int count;
    bool round; /* periodic: the last cell is next to the first */
} cell_axis;

typedef struct cell_grid {
    cell_axis x, y, z;
} cell_grid;

typedef struct ledger {
    sum_scale scale;
    double work;                       /* J, of the contact forces on all bodies so far */
    double elastic, dashpot;           /* J, of that by normal springs and dashpots */
    double global, wall_work;          /* J, so far */
    double wall_input;                 /* J, of the wall work without sign, per step */
    double start_tangential;           /* J in tangential springs at step 0, less what has left */
    double removed, removed_gravity;   /* J carried off: in all, and by height alone */
    double unwrapped;                  /* J of gravity, of the lengths that bodies have come back by
                                          across periodic faces: their falls go on */
    double fed, fed_gravity;           /* J brought in, likewise */
    double start_total, start_gravity; /* J at step 0 */
} ledger;

/* What a scheme beside the leapfrog remembers (scheme.h). */
typedef struct integrator integrator;

/* Feeds, outlets, and what passed through them (flow.h). */
typedef struct flow flow;

/* A law that the user brought, and where it came from. */
typedef struct user_law {
    void *library;
    clast_law_function *force;
    uint64_t hash; /* of the file */
} user_law;

struct clast_world {
    clast_world_def def;
    period period, kernel_period; /* of the domain, by the axes of world and kernel frame */
    user_law user_law;
    bool prepared;
    int history_columns; /* HISTORY_COLUMNS, or HISTORY_PLASTIC */
    uint64_t step;
    double dt;

    material *materials;
    shape *shapes;
    part *parts;
    wall *walls;
    wall_row *wall_rows; /* once prepared */
    int32_t *push_index; /* likewise: the row of a wall in push_rows */
    pair_coef *coefs;    /* material_count squared */
    int material_count, shape_count, part_count, wall_count, wall_room;

    body_store bodies;
    integrator *integrator; /* NULL in a world of the leapfrog */
    flow *flow;
    row_store rows;
    size_t sphere_count;
    load_scale load_scale;
    share *shares; /* one per thread, and in a shared world one more for pairs booked elsewhere */
    int threads, lists;           /* lists: shares in use */
    int share_room;               /* shares in all */
    struct ranks *ranks;          /* NULL in a world that one process has for itself */
    size_t ghosts, ghost_spheres; /* bodies of other processes: slots from bodies.count on */
    size_t arrived;               /* bodies of feeds behind the ghosts, until the next rebuild */
    double *pass_record;          /* what a contact pass found, to be added up */
    record_list records;
    carry_store carry;
    uint32_t scene_ids;            /* bodies that the scene began with */
    uint32_t next_id, name_stride; /* of a name: id times this plus the place in the shape */
    int32_t *slot_of_id;           /* -1 = gone */
    size_t slot_of_id_capacity;
    int axes[3]; /* world axis of each axis of the kernel frame */

    speciality special;
    contact_kernel *contact_kernel;
    body_kernel *body_kernel;
    const char *isa_name;
    double smallest_radius, largest_bound;
    double skin, margin; /* m, of the reach list and of the contact list */
    double most_skin;    /* m, where walls have images */
    double wall_way;     /* m, that a part has moved in this step */
    double wall_step;    /* m, the same of walls with an end */
    int wall_who;        /* whose wall_step that is */
    way_store way;
    uint64_t steps_reach, steps_contacts; /* step when they were made */
    bool stale;                           /* the reach list is */
    double overlap_now; /* of the smaller radius, largest at the last evaluation */
    double
        contact_dt; /* s, step that the springs of the current evaluation have been loaded over */
    body_tally found;
    part_sums *push_room;
    push_row *push_row_room;
    sum_scale moment_scale, belt_scale; /* of what parts do to bodies */
    ledger ledger;

    struct { /* synchronised velocities and centres for readers */
        double *vx, *vy, *vz, *wx, *wy, *wz, *mass;
        size_t capacity;
        double *sx, *sy, *sz, *radius;
        int32_t *body;
        size_t sphere_capacity;
    } view;

    struct { /* of the neighbour search */
        cell_grid grid;
        uint32_t *cell_first;
        size_t cell_capacity;
        size_t bodies;         /* that were sorted: the first so many slots */
        uint32_t *ghost_first; /* the same of ghosts, as slots */
        size_t ghost_capacity;
    } cells;

    clast_counters counters;
    clast_plan plan;
    bool failed, parts_changed;
    char error[4096];
};

/* ---- frames ---------------------------------------------------------------------------------- */

static inline vec3 to_kernel(const clast_world *w, vec3 a) {
    if (w->axes[0] == 0) return a; /* the frames are one */
    return v3(v3_at(a, w->axes[0]), v3_at(a, w->axes[1]), v3_at(a, w->axes[2]));
}

static inline vec3 from_kernel(const clast_world *w, vec3 a) {
    if (w->axes[0] == 0) return a;
    double world[3];
    world[w->axes[0]] = a.x, world[w->axes[1]] = a.y, world[w->axes[2]] = a.z;
    return v3(world[0], world[1], world[2]);
}

/* ---- places ---------------------------------------------------------------------------------- */

static inline size_t body_of_sphere(const clast_world *w, size_t sphere) {
    return w->special.clumps ? (size_t)w->rows.arm[sphere].body : sphere;
}

static inline size_t first_sphere(const clast_world *w, size_t slot) {
    return w->special.clumps ? w->rows.first[slot] : slot;
}

#endif

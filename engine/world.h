/* world.h - who does what to a world: functions of engine/ that several of its files call. What a
 * world is made of is in world_data.h, which is all that the kernels see: they take minutes to
 * compile, so nothing stands there that they need not know. Private to engine/.
 */
#ifndef CLAST_WORLD_H
#define CLAST_WORLD_H

#include "engine/check.h"
#include "engine/world_data.h"

/* memory.c: growing arrays; all memory of a world is counted. Stops the program when there is none.
 * memory_lines() starts at a cache line, is not kept when it grows, and is zero. */
void *memory_grow(clast_world *w, void *old, size_t old_count, size_t count, size_t size);
void *memory_lines(clast_world *w, void *old, size_t old_bytes, size_t bytes);
void *memory_copy(clast_world *w, const void *from, size_t count, size_t size);
char *memory_text(clast_world *w, const char *text);
void memory_release(void *p);
void memory_adopt(clast_world *w, size_t bytes);  /* what was made elsewhere, to the count */
void memory_return(clast_world *w, size_t bytes); /* what is released, from the count */

/* error.c */
int world_fail(clast_world *w, clast_status status, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
void world_complain(clast_world *w, const char *format, ...) __attribute__((format(printf, 2, 3)));

/* feed.c, outlet.c */
void flow_free(clast_world *w);
clast_status flow_check(clast_world *w);
clast_status feeds_deliver(clast_world *w);
bool outlets_hold_any(const clast_world *w);
void bodies_leave(clast_world *w);

/* body.c */
size_t body_store_new(clast_world *w, const clast_body_def *def);
void body_forget_arrived(clast_world *w, size_t slot);
void body_reserve(clast_world *w, size_t count);
void body_permute(clast_world *w, const uint32_t *order);
void body_remove(clast_world *w, size_t slot);
void ids_reserve(clast_world *w, uint32_t ids);
vec3 body_position(const clast_world *w, size_t slot);
quat body_orientation(const clast_world *w, size_t slot);
bool body_is_outside(const clast_world *w, size_t slot);
vec3 body_spin_of(const clast_world *w, int32_t shape, quat q, vec3 angular_momentum);
vec3 body_spin(const clast_world *w, size_t slot);

/* law.c */
bool law_has_spring(const clast_world *w);
double law_scale(clast_law law, double radius, double mass);
double law_elastic_force(const clast_world *w, const pair_coef *c, double radius, double mass,
                         double overlap);
typedef struct stored_energy {
    double normal, tangential; /* J */
} stored_energy;
stored_energy law_stored_energy(const clast_world *w, const pair_coef *c, double radius,
                                double mass, const history *h);
typedef struct expected_contact {
    const pair_coef *coef;
    const shape *a, *b; /* b: NULL for a wall */
    double radius;      /* m, effective */
} expected_contact;
double law_effective_mass(double a, double b);
double law_whole_mass(const expected_contact *e);
typedef void law_visitor(const clast_world *w, const expected_contact *e, void *context);
void law_each_contact(const clast_world *w, law_visitor *visit, void *context);
void law_prepare_pair(clast_world *w, int material_a, int material_b);
void law_prepare(clast_world *w);

/* contact_user.c */
void user_law_free(clast_world *w);
double user_law_elastic_force(const clast_world *w, const pair_coef *c, double radius, double mass,
                              double overlap);
stored_energy user_law_stored_energy(const clast_world *w, const pair_coef *c, double radius,
                                     double mass, const history *h);
double user_law_stiffness(const clast_world *w, const pair_coef *c, double radius, double mass,
                          double speed);
double user_law_tangent_ratio(const clast_world *w, const pair_coef *c, double radius, double mass,
                              double speed);

/* shared.c */
clast_status shared_check(clast_world *w);
void shared_group(clast_world *w, share *s);
void shared_free(share *s);

/* rows.c */
void rows_layout(clast_world *w);
void rows_fill(clast_world *w, size_t body_begin, size_t body_end);

/* special.c */
void special_choose(clast_world *w);
void special_choose_kernels(clast_world *w);
void special_choose_scale(clast_world *w);

/* A side of a triangle at which its facet ends. */
typedef struct border {
    int32_t facet, other; /* -1: no facet goes on there, or more than one does */
    int32_t low, high;    /* vertices */
    vec3 inward;          /* unit, into the facet, in its plane */
} border;

/* wall.c, mesh.c */
void mesh_extend(clast_world *w, int first_wall, const clast_mesh_def *def);
wall *wall_new(clast_world *w, int part, const clast_wall_def *def);
void walls_link(clast_world *w);
void walls_make_rows(clast_world *w);
void walls_drop_rows(clast_world *w); /* before walls are added after a start that was refused */
void walls_group(clast_world *w);
void walls_move(clast_world *w);
void walls_move_to(clast_world *w, double time);
const wall *wall_now(const clast_world *w, int wall_index, wall *room);
void walls_list_near(clast_world *w);
bool wall_pushes(const clast_world *w, const wall *l);
bool wall_drives(const clast_world *w, const wall *l);

/* fillet.c, fillet_make.c: hollow seams of smooth patches */
void fillets_make(clast_world *w, int first_wall, const clast_mesh_def *d, border *borders,
                  int count);
void fillets_unend(wall *l, vec3 along);

/* wall_tree.c: which walls are where */
void walls_plant(clast_world *w);
size_t walls_around(clast_world *w, share *s, vec3 centre, double reach);

/* entry.c */
void entry_hand_over(const clast_world *w, const contact_list *l, size_t to, size_t from);
double entry_overlap(const clast_world *w, const contact_list *l, size_t k);
size_t entry_number_size(const clast_world *w);
void entry_reserve(clast_world *w, contact_list *l, size_t count);
void entry_push(clast_world *w, contact_list *l, int32_t a, int32_t b, const history *h);
void entry_clear(clast_world *w, contact_list *l, size_t k);
void entries_clear_behind(clast_world *w, contact_list *l);
void entry_clear_spring(clast_world *w, contact_list *l, size_t k);
void entry_turn(clast_world *w, contact_list *l, size_t k);
void entry_move(const clast_world *w, contact_list *l, size_t to, size_t from, size_t n);
void entry_free(clast_world *w, contact_list *l);
bool contact_touches(const clast_world *w, const contact_list *l, size_t k);
history contact_history(const clast_world *w, const contact_list *l, size_t k, bool with_wall);

static inline size_t entry_room(size_t count) {
    return count + count / 16 + 2 * ENTRIES_BEHIND;
}

/* carry.c */
void carry_lists(clast_world *w);
void carry_records(clast_world *w);
void carry_place(clast_world *w);
carried carry_at(const clast_world *w, uint32_t k);
uint32_t carry_find(const clast_world *w, size_t sphere, int32_t partner, bool with_wall);
const void *carry_number(const clast_world *w, uint32_t entry, int column);
void carry_drop_places(clast_world *w);
void carry_drop_column(clast_world *w, int column);
void carry_end(clast_world *w);
void carry_free(clast_world *w);

/* cells.c, shares.c, reach.c, near.c, records.c */
void cells_sort(clast_world *w, double reach);
void shares_make(clast_world *w);
void shares_fit(clast_world *w);
void shares_cut(clast_world *w);
void shares_free(clast_world *w);
void reach_build(clast_world *w, share *s);
void lists_rebuild(clast_world *w);
void lists_refresh(clast_world *w);
/* view.c: places in columns of readers, in the order of ids; malloc'ed. */
uint32_t *bodies_by_id(const clast_world *w, const clast_bodies *b);

contact_record record_of(const clast_world *w, const contact_list *l, size_t k, bool with_wall);
int record_compare(const void *left, const void *right);
void records_collect(clast_world *w);
void records_collect_here(clast_world *w);
void records_sort(clast_world *w);
void records_reserve(clast_world *w, size_t count);
void records_forget(clast_world *w);

/* What a contact pass finds, as numbers that processes add up: the largest overlap, five sums of
 * two numbers (elastic, dashpot; of the bodies before: global, contact, unwrapped), contacts; and
 * of each part five sums. */
enum { PASS_NUMBERS = 12, PART_NUMBERS = sizeof(part_sums) / sizeof(double) };

/* contact.c: runs the kernel on all shares, adds up tallies */
void contacts_evaluate(clast_world *w);
void contacts_restore(clast_world *w);
void contacts_forget_springs(clast_world *w);
stored_energy contacts_stored_energy(const clast_world *w);

/* step.c */
clast_status world_rebuild(clast_world *w);

/* way.c */
typedef struct way_verdict {
    bool reach, contacts; /* these lists are stale */
} way_verdict;

way_verdict way_judge(clast_world *w);
void way_restart(clast_world *w, bool reach);
void way_forget(clast_world *w);
void way_remember(clast_world *w);

/* scheme_columns.c, scheme_step.c: schemes beside the leapfrog */
void integrator_make(clast_world *w);
void integrator_free(clast_world *w);
void integrator_permute(clast_world *w, const uint32_t *order, void *scratch);
void integrator_move(clast_world *w, size_t to, size_t from);
double *integrator_kept(const clast_world *w, int k);
void integrator_start(clast_world *w);
clast_status integrator_step(clast_world *w);

typedef void contact_visitor(const clast_world *w, const contact_place *at, void *context);
void contacts_visit(const clast_world *w, contact_visitor *visit, void *context);
stored_energy contact_stored_energy(const clast_world *w, const contact_place *at);
double contact_smaller_radius(const clast_world *w, const contact_place *at);
typedef struct contact_kind {
    const pair_coef *coef;
    double radius, mass; /* effective */
} contact_kind;
contact_kind contact_kind_of(const clast_world *w, const contact_place *at);

/* Records with what the law says of them now, in the order of names. */
typedef struct contact_reading {
    contact_record record;
    vec3 point, normal, force; /* world frame; normal towards a, force on a */
} contact_reading;
size_t contacts_read(clast_world *w, contact_reading **readings); /* for free() */

/* motion.c */
void bodies_advance(clast_world *w);
void body_load(const clast_world *w, size_t slot, vec3 *force, vec3 *torque);
void loads_clear(clast_world *w);
quat body_turned(const clast_world *w, size_t slot, quat q, vec3 momentum, double time);
void velocities_start(clast_world *w);
void velocities_synchronise(clast_world *w);
typedef struct motion_books {
    double kinetic, rotational; /* J */
    double half_global;         /* J, half of what global damping takes in the next kick */
    double work_arrived; /* J, the part of the next kick's work that belongs to the way so far */
} motion_books;
motion_books motion_balance(const clast_world *w);

/* ledger.c, guard.c, timestep.c, landing.c */
void ledger_set_scale(clast_world *w);
void ledger_start(clast_world *w);
void ledger_add_body(clast_world *w, size_t slot);
void ledger_remove_body(clast_world *w, size_t slot);
void ledger_remove_contacts(clast_world *w, stored_energy before);
clast_status guards_check(clast_world *w);
int guards_complain_of_outside(clast_world *w);
clast_status guards_check_start(clast_world *w, int faults);
clast_status guards_check_energy(clast_world *w);
clast_status guards_outside(clast_world *w);
clast_status guards_unconverged(clast_world *w, size_t slot, int iterations, double move);
clast_status timestep_choose(clast_world *w);
/* landing.c. kg: mass over stiffness in the stiffest landing of a shape, on one sphere or flat
 * along a principal axis, in units of the stiffness of one contact. That of a sphere is its mass.
 */
double landing_lightest(const clast_world *w, const shape *s);
/* 1/kg: the square of the largest frequency over the normal stiffness of one contact, where
 * friction sticks and its spring has `ratio` times that stiffness. */
double landing_stuck_rate(const clast_world *w, const shape *s, double ratio);
double timestep_rayleigh(const clast_world *w);
double timestep_impact_speed(const clast_world *w);

double world_seconds(void);

#endif

/* ledger.c - where the energy is and what went where.
 *
 * Kept exactly for the leapfrog. The kinetic energy is v(n-1/2).v(n+1/2)/2 and what the contact
 * forces do to a body in one kick is force times mean velocity: these two agree to rounding (with
 * three different moments of inertia: to dt^2, by the rotation between kicks). Of this work, the
 * normal forces do the mean of the forces at the two ends of a step times the change of the
 * overlap; what walls and tangential springs do not account for of the rest is friction. Elastic
 * energy is a function of the overlap. What does not add up is then the error of integrating the
 * normal contact (order dt^2 inside, dt^2.5 at the onset), and it is what grows when a step is too
 * large: the residual is the failure detector. What a contact law makes shows as friction or
 * damping below zero instead, and guard.c looks there too. Rejected: the work of every tangential
 * force by itself. Contact points travel, so it is of first order unless the old point is kept or
 * found again (a third more work per contact). */
#include "engine/flow.h"
#include "engine/numbers.h"
#include "engine/part.h"
#include "engine/ranks.h"

/* Gravity against the lowest corner of the domain. */
static double gravity_of(const clast_world *w) {
    exact_sum sum = {0, 0};
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 above = v3_sub(body_position(w, i), w->def.domain_min);
        double mass = w->shapes[w->bodies.shape[i]].mass;
        sum_add(&sum, &w->ledger.scale, -mass * v3_dot(above, w->def.gravity));
    }
    ranks_sum(w, &sum, 1);
    return sum_value(&sum);
}

typedef struct largest {
    double energy, count;
} largest;

static void find_largest(const clast_world *w, const contact_place *at, void *context) {
    largest *l = context;
    stored_energy e = contact_stored_energy(w, at);
    l->energy = fmax(l->energy, e.normal + e.tangential);
    l->count++;
}

/* The largest elastic energy of a contact times their number: has no order. */
static double elastic_bound(const clast_world *w) {
    largest l = {0, 0};
    contacts_visit(w, find_largest, &l);
    ranks_reduce(w, &l.energy, 1, 1);
    return l.energy * l.count;
}

/* kg. Counted by shape, so that it does not depend on the order of the bodies. */
static double mass_of_all(clast_world *w) {
    double mass = 0, *count = memory_grow(w, NULL, 0, (size_t)w->shape_count, sizeof *count);
    for (size_t i = 0; i < w->bodies.count; i++) count[w->bodies.shape[i]]++;
    ranks_reduce(w, count, 0, w->shape_count);
    for (int s = 0; s < w->shape_count; s++) mass += count[s] * w->shapes[s].mass;
    memory_release(count), memory_return(w, (size_t)w->shape_count * sizeof *count);
    return mass;
}

/* m2/s2, of any point of a body. */
static double fastest_body(const clast_world *w) {
    const body_store *b = &w->bodies;
    double fastest2 = 0;
    for (size_t i = 0; i < b->count; i++) {
        double v2 = b->vx[i] * b->vx[i] + b->vy[i] * b->vy[i] + b->vz[i] * b->vz[i];
        vec3 spin = body_spin(w, i);
        double s2 = v3_dot(spin, spin), arm = w->shapes[b->shape[i]].bound;
        if (v2 + s2 * arm * arm > fastest2) fastest2 = v2 + s2 * arm * arm;
    }
    ranks_reduce(w, &fastest2, 1, 0);
    return fastest2;
}

/* A power of two that no total of this scene should exceed by much: sets the quanta of the sums. */
static double energy_scale(clast_world *w) {
    double mass = mass_of_all(w), fastest2 = fastest_body(w);
    double extent = v3_norm(v3_sub(w->def.domain_max, w->def.domain_min));
    for (int l = 0; l < w->wall_count; l++) {
        const part *p = &w->parts[w->walls[l].part];
        double v = v3_norm(v3_add(w->walls[l].def.belt_velocity, p->def.velocity));
        v += part_speed_bound(p, p->reach);
        fastest2 = fmax(fastest2, v * v);
    }
    mass += feeds_mass_expected(w, &fastest2);
    double scale = mass * (fastest2 + v3_norm(w->def.gravity) * extent) + elastic_bound(w);
    return number_power_of_two_above(scale > 1e-200 ? scale : 1e-200);
}

clast_energy clast_world_energy(clast_world *w) {
    CLAST_ASSERT(w && w->prepared);
    const ledger *l = &w->ledger;
    motion_books m = motion_balance(w);
    stored_energy stored = contacts_stored_energy(w);
    double tangential_work = l->work + m.work_arrived - l->wall_work - l->elastic - l->dashpot;
    clast_energy e = {.kinetic = m.kinetic,
                      .rotational = m.rotational,
                      .gravity = gravity_of(w) + l->unwrapped,
                      .elastic = stored.normal + stored.tangential,
                      .damping = -l->dashpot,
                      .friction = -tangential_work - (stored.tangential - l->start_tangential),
                      .global = l->global + m.half_global,
                      .wall_work = l->wall_work,
                      .removed = l->removed,
                      .fed = l->fed};
    double total = e.kinetic + e.rotational + e.gravity + e.elastic + e.damping + e.friction +
                   e.global + e.removed - e.fed - e.wall_work;
    double fallen = l->start_gravity + l->fed_gravity - (e.gravity + l->removed_gravity);
    double begun = l->start_total - l->start_gravity + l->fed - l->fed_gravity;
    e.input = begun + (fallen > 0 ? fallen : 0) + l->wall_input;
    e.residual = total - l->start_total;
    return e;
}

void ledger_set_scale(clast_world *w) {
    w->ledger.scale = sum_scale_for(energy_scale(w));
}

/* Books the state at step 0 as the start. */
void ledger_start(clast_world *w) {
    ledger *l = &w->ledger;
    *l = (ledger){.scale = l->scale};
    for (int p = 0; p < w->part_count; p++) w->parts[p].work_total = 0;
    clast_energy e = clast_world_energy(w);
    motion_books m = motion_balance(w);
    l->global = -m.half_global; /* a step is half of the kick at either end */
    l->work = -m.work_arrived;
    l->start_tangential = contacts_stored_energy(w).tangential;
    l->start_gravity = e.gravity;
    l->start_total = e.kinetic + e.rotational + e.gravity + e.elastic;
}

/* J of a body that touches nothing, at the half step it is in: by height, and in all. */
static double energy_of(const clast_world *w, size_t slot, double *by_height) {
    const body_store *b = &w->bodies;
    double mass = w->shapes[b->shape[slot]].mass;
    vec3 v = v3(b->vx[slot], b->vy[slot], b->vz[slot]),
         l = v3(b->lx[slot], b->ly[slot], b->lz[slot]);
    vec3 spin = body_spin(w, slot);
    vec3 above = v3_sub(body_position(w, slot), w->def.domain_min);
    /* v is that of half a step before, but for other schemes */
    vec3 next = w->integrator ? v : v3_add(v, v3_scale(w->dt, w->def.gravity));
    *by_height = -mass * v3_dot(above, w->def.gravity);
    return *by_height + 0.5 * mass * v3_dot(v, next) + 0.5 * v3_dot(l, spin);
}

void ledger_remove_body(clast_world *w, size_t slot) {
    double gravity;
    w->ledger.removed += energy_of(w, slot, &gravity);
    w->ledger.removed_gravity += gravity;
}

void ledger_add_body(clast_world *w, size_t slot) {
    double gravity;
    w->ledger.fed += energy_of(w, slot, &gravity);
    w->ledger.fed_gravity += gravity;
}

/* Contacts whose partner has gone take what they stored along. Needs the list without them. */
void ledger_remove_contacts(clast_world *w, stored_energy before) {
    stored_energy now = contacts_stored_energy(w);
    w->ledger.removed += (before.normal - now.normal) + (before.tangential - now.tangential);
    w->ledger.start_tangential -= before.tangential - now.tangential;
}

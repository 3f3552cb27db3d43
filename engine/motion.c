/* motion.c - moves all bodies by one step (body_kernel.c), and reads their motion at the time of
 * the positions. */
#include <string.h>

#include "engine/body_lanes.h"
#include "engine/parallel.h"
#include "engine/ranks.h"

static turning turning_of(const clast_world *w) {
    if (w->def.motion == CLAST_MOTION_IN_PLANE) return TURN_IN_PLANE;
    return w->special.round ? TURN_ROUND : TURN_ANY;
}

static void add_wrapped(int64_t *to, const int64_t *from) {
    for (int k = 0; k < 3; k++) to[k] = (int64_t)((uint64_t)to[k] + (uint64_t)from[k]);
}

/* Force and torque of all contacts, kernel frame. Gravity is not in it. */
void body_load(const clast_world *w, size_t slot, vec3 *force, vec3 *torque) {
    load_row sum = w->rows.loads[slot];
    for (int t = 0; t < w->threads; t++) {
        const share *s = &w->shares[t];
        if (slot < s->body_end || slot - s->body_end >= s->overhang_count) continue;
        const load_row *more = &s->overhang[slot - s->body_end];
        add_wrapped(sum.force, more->force);
        add_wrapped(sum.torque, more->torque);
    }
    double f = w->load_scale.force_quantum, t = w->load_scale.torque_quantum;
    *force = v3(f * (double)sum.force[0], f * (double)sum.force[1], f * (double)sum.force[2]);
    *torque = v3(t * (double)sum.torque[0], t * (double)sum.torque[1], t * (double)sum.torque[2]);
}

/* All rows and all of the overhang: what lies beyond the count comes alive when that grows. */
void loads_clear(clast_world *w) {
    memset(w->rows.loads, 0, w->rows.bodies * sizeof *w->rows.loads);
    for (int t = 0; t < w->threads; t++) {
        share *s = &w->shares[t];
        if (s->overhang) memset(s->overhang, 0, s->overhang_capacity * sizeof *s->overhang);
    }
}

/* Everything below reads in the kernel frame. */
static moving moving_of(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    vec3 turn = to_kernel(w, v3(b->qx[i], b->qy[i], b->qz[i]));
    return (moving){to_kernel(w, v3(b->vx[i], b->vy[i], b->vz[i])),
                    to_kernel(w, v3(b->lx[i], b->ly[i], b->lz[i])),
                    {b->qw[i], turn.x, turn.y, turn.z}};
}

static vec3 inverse_inertia_of(const clast_world *w, size_t i) {
    return to_kernel(w, w->shapes[w->bodies.shape[i]].inverse_inertia);
}

/* q after that time (s) with that mean momentum, where it matters how bodies are turned. World
 * frame. */
quat body_turned(const clast_world *w, size_t i, quat q, vec3 momentum, double time) {
    if (!w->special.oriented) return q;
    vec3 turn = to_kernel(w, v3(q.x, q.y, q.z));
    quat k = turned_by(turning_of(w), (quat){q.w, turn.x, turn.y, turn.z}, to_kernel(w, momentum),
                       inverse_inertia_of(w, i), time);
    turn = from_kernel(w, v3(k.x, k.y, k.z));
    return (quat){k.w, turn.x, turn.y, turn.z};
}

static kick kick_of(const clast_world *w, size_t i) {
    const shape *s = &w->shapes[w->bodies.shape[i]];
    vec3 force, torque;
    body_load(w, i, &force, &torque);
    body_choice c = {w->dt, 0.5 * w->def.global_damping * w->dt, to_kernel(w, w->def.gravity)};
    return kicked(turning_of(w), c, moving_of(w, i), force, torque, s->mass, s->inverse_mass,
                  inverse_inertia_of(w, i));
}

/* ---- the step -------------------------------------------------------------------------------- */

static void advance_share(void *context, int thread) {
    clast_world *w = context;
    w->body_kernel(w, &w->shares[thread]);
}

/* From x(n), v(n-1/2), loads(n) to x(n+1), v(n+1/2) and rows; the loads are empty afterwards. What
 * it found is booked with the contacts. */
void bodies_advance(clast_world *w) {
    parallel_run(w->threads, advance_share, w);
    w->found = (body_tally){.way = 0};
    for (int t = 0; t < w->threads; t++) {
        const body_tally *b = &w->shares[t].body_tally;
        sum_merge(&w->found.global, &b->global);
        sum_merge(&w->found.contact, &b->contact);
        sum_merge(&w->found.unwrapped, &b->unwrapped);
        w->found.outside |= b->outside;
        if (b->way > w->found.way) w->found.way = b->way;
    }
}

static void store_half_step(clast_world *w, size_t i, vec3 v, vec3 l) {
    body_store *b = &w->bodies;
    v = from_kernel(w, v), l = from_kernel(w, l);
    b->vx[i] = v.x, b->vy[i] = v.y, b->vz[i] = v.z;
    b->lx[i] = l.x, b->ly[i] = l.y, b->lz[i] = l.z;
}

/* Half a step back: from v(0) to v(-1/2), so that the mean of v(-1/2) and v(1/2) is v(0). */
void velocities_start(clast_world *w) {
    double back = 1 + 0.5 * w->def.global_damping * w->dt, half = 0.5 * w->dt;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 force, torque;
        body_load(w, i, &force, &torque);
        vec3 a = v3_add(v3_scale(w->shapes[w->bodies.shape[i]].inverse_mass, force),
                        to_kernel(w, w->def.gravity));
        if (w->def.motion == CLAST_MOTION_IN_PLANE) a.z = torque.x = torque.y = 0;
        moving m = moving_of(w, i);
        store_half_step(w, i, v3_sub(v3_scale(back, m.v), v3_scale(half, a)),
                        v3_sub(v3_scale(back, m.l), v3_scale(half, torque)));
    }
}

/* ---- readers --------------------------------------------------------------------------------- */

static void reserve_view(clast_world *w) {
    size_t old = w->view.capacity, now = w->bodies.capacity;
    if (old >= now) return;
    double **columns[] = {&w->view.vx, &w->view.vy, &w->view.vz,  &w->view.wx,
                          &w->view.wy, &w->view.wz, &w->view.mass};
    for (size_t i = 0; i < sizeof columns / sizeof *columns; i++)
        *columns[i] = memory_grow(w, *columns[i], old, now, sizeof(double));
    w->view.capacity = now;
}

static void view_body(clast_world *w, size_t i, vec3 v, vec3 spin) {
    w->view.vx[i] = v.x, w->view.vy[i] = v.y, w->view.vz[i] = v.z;
    w->view.wx[i] = spin.x, w->view.wy[i] = spin.y, w->view.wz[i] = spin.z;
    w->view.mass[i] = w->shapes[w->bodies.shape[i]].mass;
}

/* Velocities at the time of the positions, without touching the state: the mean of the half steps
 * before and after. Before the first evaluation, and with a scheme beside the leapfrog, they are
 * what the columns hold. */
void velocities_synchronise(clast_world *w) {
    reserve_view(w);
    const body_store *b = &w->bodies;
    for (size_t i = 0; i < b->count; i++) {
        if (!w->prepared || w->integrator) {
            view_body(w, i, v3(b->vx[i], b->vy[i], b->vz[i]), body_spin(w, i));
            continue;
        }
        kick k = kick_of(w, i);
        moving m = moving_of(w, i);
        vec3 v = v3_scale(0.5, v3_add(m.v, k.velocity)), l = v3_scale(0.5, v3_add(m.l, k.momentum));
        vec3 spin = spin_of(turning_of(w), m.q, l, inverse_inertia_of(w, i));
        view_body(w, i, from_kernel(w, v), from_kernel(w, spin));
    }
}

/* Where the columns hold the velocities at the time of the positions. */
static motion_books plain_balance(const clast_world *w) {
    exact_sum kinetic = {0, 0}, rotational = {0, 0};
    const body_store *b = &w->bodies;
    for (size_t i = 0; i < b->count; i++) {
        vec3 v = v3(b->vx[i], b->vy[i], b->vz[i]), l = v3(b->lx[i], b->ly[i], b->lz[i]);
        double mass = w->shapes[b->shape[i]].mass;
        sum_add(&kinetic, &w->ledger.scale, 0.5 * mass * v3_dot(v, v));
        sum_add(&rotational, &w->ledger.scale, 0.5 * v3_dot(l, body_spin(w, i)));
    }
    return (motion_books){.kinetic = sum_value(&kinetic), .rotational = sum_value(&rotational)};
}

/* The kinetic energies as v-.v+ and L-.w+, which the discrete motion goes by (the mean of squares
 * would be off by the square of the kick). */
motion_books motion_balance(const clast_world *w) {
    if (w->integrator) return plain_balance(w);
    enum { KINETIC, ROTATIONAL, GLOBAL, WORK, SUMS };
    exact_sum sums[SUMS] = {{0, 0}};
    const sum_scale *scale = &w->ledger.scale;
    for (size_t i = 0; i < w->bodies.count; i++) {
        kick k = kick_of(w, i);
        moving m = moving_of(w, i);
        vec3 force, torque, inverse = inverse_inertia_of(w, i);
        turning turn = turning_of(w);
        body_load(w, i, &force, &torque);
        if (turn == TURN_IN_PLANE) force.z = torque.x = torque.y = 0;
        vec3 after = spin_of(turn, m.q, k.momentum, inverse);
        vec3 before = spin_of(turn, m.q, m.l, inverse);
        double mass = w->shapes[w->bodies.shape[i]].mass;
        sum_add(&sums[KINETIC], scale, 0.5 * mass * v3_dot(m.v, k.velocity));
        sum_add(&sums[ROTATIONAL], scale, 0.5 * v3_dot(m.l, after));
        sum_add(&sums[GLOBAL], scale, 0.5 * k.global_loss);
        sum_add(&sums[WORK], scale, 0.5 * w->dt * (v3_dot(force, m.v) + v3_dot(torque, before)));
    }
    ranks_sum(w, sums, SUMS);
    return (motion_books){sum_value(&sums[KINETIC]), sum_value(&sums[ROTATIONAL]),
                          sum_value(&sums[GLOBAL]), sum_value(&sums[WORK])};
}

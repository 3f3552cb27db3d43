/* scheme_step.c - what every scheme beside the leapfrog does in a step: its rules for one body, the
 * rotation, the books, the state that is kept.
 *
 * Energy: kinetic energy is that of the velocities at the time of the positions; what the contacts
 * do to a body in a step is the mean of their forces at its two ends times its way. Where the
 * scheme moves bodies otherwise the residual shows it: of the order of the scheme, and of second
 * order at best because of the mean. A scheme that damps by itself (backward Euler, BDF) shows a
 * residual below zero. */
#include "engine/flow.h"
#include "engine/scheme.h"

/* ---- rules ----------------------------------------------------------------------------------- */

/* Positions enter as differences from the one at the start: their weights add up to one, and a
 * coordinate that does not move stays to the bit. */
vec3 rule_position(const integrator *s, const clast_scheme_position *r, size_t i, double dt,
                   vec3 a_next) {
    vec3 x = triple_at(s, X_AGO, i), way = v3_scale(dt * dt * r->a_next, a_next);
    for (int k = 0; k <= s->info->past; k++) {
        if (k > 0) way = v3_add(way, v3_scale(r->x[k], v3_sub(triple_at(s, X_AGO + k, i), x)));
        way = v3_add(way, v3_scale(dt * r->v[k], triple_at(s, V_AGO + k, i)));
        way = v3_add(way, v3_scale(dt * dt * r->a[k], triple_at(s, A_AGO + k, i)));
    }
    return v3_add(x, way);
}

/* Weights of positions add up to zero; `x` is the new one. */
vec3 rule_velocity(const integrator *s, const clast_scheme_velocity *r, size_t i, double dt, vec3 x,
                   vec3 a_next) {
    vec3 start = triple_at(s, X_AGO, i);
    vec3 way = v3_scale(r->x_next, v3_sub(x, start)), v = v3_scale(dt * r->a_next, a_next);
    for (int k = 0; k <= s->info->past; k++) {
        if (k > 0) way = v3_add(way, v3_scale(r->x[k], v3_sub(triple_at(s, X_AGO + k, i), start)));
        v = v3_add(v, v3_scale(r->v[k], triple_at(s, V_AGO + k, i)));
        v = v3_add(v, v3_scale(dt * r->a[k], triple_at(s, A_AGO + k, i)));
    }
    return v3_add(v, v3_scale(1 / dt, way));
}

/* ---- forces ---------------------------------------------------------------------------------- */

/* Force and torque of the contacts at the last pass, without what a plane of motion takes up. */
static void contact_load(const clast_world *w, size_t i, vec3 *force, vec3 *torque) {
    body_load(w, i, force, torque);
    if (w->def.motion == CLAST_MOTION_IN_PLANE) force->z = torque->x = torque->y = 0;
    *force = from_kernel(w, *force), *torque = from_kernel(w, *torque);
}

/* What a plane of motion leaves of it. */
vec3 gravity_felt(const clast_world *w) {
    vec3 g = to_kernel(w, w->def.gravity);
    if (w->def.motion == CLAST_MOTION_IN_PLANE) g.z = 0;
    return from_kernel(w, g);
}

/* From the last pass and the velocities in the columns of the bodies; into the given columns, and
 * torques into TORQUE_NEXT. Global damping is A00 1.81. */
void take_accelerations(clast_world *w, int accelerations) {
    integrator *s = w->integrator;
    vec3 gravity = gravity_felt(w);
    double f = w->def.global_damping;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 force, torque;
        contact_load(w, i, &force, &torque);
        vec3 a = v3_add(v3_scale(w->shapes[w->bodies.shape[i]].inverse_mass, force), gravity);
        triple_put(s, accelerations, i, v3_sub(a, v3_scale(f, body_velocity(w, i))));
        triple_put(s, TORQUE_NEXT, i, v3_sub(torque, v3_scale(f, body_momentum(w, i))));
    }
}

/* Velocities and momenta that the forces at the end of the step feel, from the positions there. */
void feel_velocities(clast_world *w) {
    integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 x = body_position(w, i);
        body_speed_up(w, i, rule_velocity(s, &s->info->felt, i, w->dt, x, v3(0, 0, 0)));
        body_spin_up(w, i,
                     v3_add(triple_at(s, MOMENTUM, i),
                            v3_scale(s->info->felt_kick * w->dt, triple_at(s, TORQUE, i))));
    }
}

/* Accelerations of everything but dashpots at the positions in the columns of the bodies, into
 * A_NEXT. Velocities and momenta are spent. */
void elastic_forces(clast_world *w, double spring_time) {
    for (size_t i = 0; i < w->bodies.count; i++)
        body_speed_up(w, i, v3(0, 0, 0)), body_spin_up(w, i, v3(0, 0, 0));
    trial_try(w, spring_time);
    take_accelerations(w, A_NEXT);
}

/* For schemes that split: the same, and those of the dashpots with the velocities that the scheme
 * feels into DASHPOT. */
void split_forces(clast_world *w) {
    integrator *s = w->integrator;
    elastic_forces(w, 0.5 * w->dt);
    if (!trial_needs_velocity(w)) return; /* DASHPOT stays zero */
    feel_velocities(w);
    trial_try(w, 0.5 * w->dt);
    take_accelerations(w, DASHPOT);
    for (size_t i = 0; i < w->bodies.count; i++)
        triple_put(s, DASHPOT, i, v3_sub(triple_at(s, DASHPOT, i), triple_at(s, A_NEXT, i)));
}

/* The same of the state that ends this step, which stays. */
void split_forces_kept(clast_world *w) {
    integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        triple_put(s, STAGE, i, body_velocity(w, i));
        triple_put(s, STAGE_2, i, body_momentum(w, i));
    }
    split_forces(w);
    for (size_t i = 0; i < w->bodies.count; i++) {
        body_speed_up(w, i, triple_at(s, STAGE, i));
        body_spin_up(w, i, triple_at(s, STAGE_2, i));
    }
}

/* ---- rotation -------------------------------------------------------------------------------- */

static quat turn_at_start(const integrator *s, size_t i) {
    vec3 q = triple_at(s, TURN, i);
    return (quat){s->column[TURN_W][i], q.x, q.y, q.z};
}

/* Orientations and felt momenta when that part of the step is over, from the torques at its start.
 */
void turn_bodies(clast_world *w, double fraction) {
    const integrator *s = w->integrator;
    body_store *b = &w->bodies;
    double time = fraction * w->dt;
    for (size_t i = 0; i < b->count; i++) {
        vec3 l = triple_at(s, MOMENTUM, i), torque = triple_at(s, TORQUE, i);
        vec3 mean = v3_add(l, v3_scale(s->info->turn * time, torque));
        quat q = body_turned(w, i, turn_at_start(s, i), mean, time);
        b->qw[i] = q.w, b->qx[i] = q.x, b->qy[i] = q.y, b->qz[i] = q.z;
        body_spin_up(w, i, v3_add(l, v3_scale(s->info->felt_kick * time, torque)));
    }
}

/* Momenta that are kept, from the torques at both ends. */
void correct_momenta(clast_world *w) {
    const integrator *s = w->integrator;
    double kick = s->info->kept_kick * w->dt, rest = w->dt - kick;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 torque = v3_add(v3_scale(rest, triple_at(s, TORQUE, i)),
                             v3_scale(kick, triple_at(s, TORQUE_NEXT, i)));
        body_spin_up(w, i, v3_add(triple_at(s, MOMENTUM, i), torque));
    }
}

/* ---- books ----------------------------------------------------------------------------------- */

/* Angle times axis that a body turns by in the step. */
static vec3 turn_of(const clast_world *w, size_t i) {
    const integrator *s = w->integrator;
    vec3 mean =
        v3_add(triple_at(s, MOMENTUM, i), v3_scale(s->info->turn * w->dt, triple_at(s, TORQUE, i)));
    return v3_scale(w->dt, body_spin_of(w, w->bodies.shape[i], turn_at_start(s, i), mean));
}

/* Half of what contacts and global damping do in a step: that of the forces at one of its ends. */
static void book_half(clast_world *w, bool at_end) {
    const integrator *s = w->integrator;
    exact_sum work = {0, 0}, global = {0, 0};
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 way = v3_sub(body_position(w, i), triple_at(s, X_AGO, i)), turn = turn_of(w, i);
        vec3 force = triple_at(s, FORCE, i), couple = triple_at(s, COUPLE, i);
        vec3 v = triple_at(s, V_AGO, i), l = triple_at(s, MOMENTUM, i);
        if (at_end) {
            contact_load(w, i, &force, &couple);
            v = body_velocity(w, i), l = body_momentum(w, i);
        }
        double mass = w->shapes[w->bodies.shape[i]].mass;
        sum_add(&work, &w->ledger.scale, 0.5 * (v3_dot(force, way) + v3_dot(couple, turn)));
        sum_add(&global, &w->ledger.scale,
                0.5 * w->def.global_damping * (mass * v3_dot(v, way) + v3_dot(l, turn)));
    }
    w->ledger.work += sum_value(&work);
    w->ledger.global += sum_value(&global);
}

static void find_way(clast_world *w) {
    const integrator *s = w->integrator;
    w->found = (body_tally){.way = 0};
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 spin = body_spin(w, i);
        double way = v3_norm(v3_sub(body_position(w, i), triple_at(s, X_AGO, i))) +
                     w->dt * v3_norm(spin) * w->shapes[w->bodies.shape[i]].bound;
        if (!(way < 1e300)) way = INFINITY;
        if (way > w->found.way) w->found.way = way;
        w->found.outside |= body_is_outside(w, i);
    }
    w->found.outside |= outlets_hold_any(w);
}

/* Where velocities wait for the forces at the end of the step: bodies that leave feel gravity and
 * global damping alone. */
static void fly_out(clast_world *w) {
    const integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        if (outlet_of(w, i) == NO_OUTLET) continue;
        vec3 slows = v3_scale(w->def.global_damping, triple_at(s, V_AGO, i));
        vec3 a = v3_sub(gravity_felt(w), slows), x = body_position(w, i);
        body_speed_up(w, i, rule_velocity(s, &s->info->kept, i, w->dt, x, a));
    }
}

/* Bodies that have left go, with their forces. */
static clast_status settle_without(clast_world *w, bool with_velocities) {
    if (!with_velocities) fly_out(w);
    clast_status status = trial_rebuild(w);
    if (status) return status;
    if (w->integrator->info->splits) split_forces_kept(w);
    return CLAST_OK;
}

/* Takes the state in the columns of the bodies as that at the end of the step, with its velocities
 * or before they are known. The forces there are those of the last pass. */
clast_status step_settle(clast_world *w, bool with_velocities) {
    find_way(w);
    book_half(w, false);
    trial_keep_books(w);
    clast_status status = w->found.outside ? settle_without(w, with_velocities) : CLAST_OK;
    if (status) return status;
    trial_accept(w);
    return CLAST_OK;
}

/* ---- the step -------------------------------------------------------------------------------- */

static void remember_start(clast_world *w) {
    integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        quat q = body_orientation(w, i);
        vec3 force, torque;
        contact_load(w, i, &force, &torque);
        triple_put(s, X_AGO, i, body_position(w, i));
        triple_put(s, V_AGO, i, body_velocity(w, i));
        triple_put(s, MOMENTUM, i, body_momentum(w, i));
        triple_put(s, TURN, i, v3(q.x, q.y, q.z));
        s->column[TURN_W][i] = q.w;
        triple_put(s, FORCE, i, force);
        triple_put(s, COUPLE, i, torque);
    }
}

static clast_status begin(clast_world *w) {
    remember_start(w);
    trial_preload(w);
    trial_begin(w);
    w->step++;
    walls_move(w);
    w->found.outside = false;
    return w->stale ? trial_rebuild(w) : CLAST_OK;
}

clast_status integrator_step(clast_world *w) {
    integrator *s = w->integrator;
    double since = world_seconds();
    if (w->period.any) columns_wrap(w);
    uint64_t begun = w->step;
    clast_status status = begin(w);
    if (status) return status;
    if (begun < (uint64_t)s->info->past)
        status = step_start(w);
    else
        status = s->info->implicit ? step_implicit(w) : step_explicit(w);
    if (status) return status;
    book_half(w, true);
    columns_grow_older(s);
    w->counters.seconds_contacts += world_seconds() - since;
    return guards_check(w);
}

/* Accelerations and torques at the start, from the loads of the first evaluation, which are there
 * again afterwards. */
void integrator_start(clast_world *w) {
    integrator *s = w->integrator;
    remember_start(w);
    take_accelerations(w, A_NEXT);
    if (s->info->splits) {
        trial_begin(w);
        elastic_forces(w, 0);
        for (size_t i = 0; i < w->bodies.count; i++) {
            body_speed_up(w, i, triple_at(s, V_AGO, i));
            body_spin_up(w, i, triple_at(s, MOMENTUM, i));
        }
        trial_undo(w);
    }
    columns_grow_older(s);
}

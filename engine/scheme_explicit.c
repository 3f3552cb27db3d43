/* scheme_explicit.c - steps that ask for the forces at a state known before: predictor, forces,
 * corrector; and the starter of schemes that look back. */
#include <string.h>

#include "engine/scheme.h"

static const vec3 NOTHING = {0, 0, 0};

/* ---- predictor and corrector ----------------------------------------------------------------- */

static void predict(clast_world *w) {
    const integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 x = rule_position(s, &s->info->predict, i, w->dt, NOTHING);
        body_place(w, i, x);
        body_speed_up(w, i, rule_velocity(s, &s->info->felt, i, w->dt, x, NOTHING));
    }
    turn_bodies(w, 1);
}

static void correct(clast_world *w) {
    const integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 a = triple_at(s, A_NEXT, i);
        vec3 x = rule_position(s, &s->info->keep, i, w->dt, a);
        body_place(w, i, x);
        body_speed_up(w, i, rule_velocity(s, &s->info->kept, i, w->dt, x, a));
    }
    correct_momenta(w);
}

/* Whether the forces at the predicted state are those at the state that is kept: then one pass
 * serves both. */
static bool predicts_what_is_kept(const clast_world *w) {
    const clast_scheme_info *info = w->integrator->info;
    if (memcmp(&info->predict, &info->keep, sizeof info->keep) != 0) return false;
    bool velocity_too = memcmp(&info->felt, &info->kept, sizeof info->kept) == 0;
    return velocity_too || !trial_needs_velocity(w);
}

clast_status step_explicit(clast_world *w) {
    predict(w);
    if (predicts_what_is_kept(w)) {
        clast_status status = step_settle(w, false);
        if (status) return status;
        w->counters.force_evaluations++;
        take_accelerations(w, A_NEXT);
        correct(w);
        return CLAST_OK;
    }
    trial_try(w, 0.5 * w->dt);
    take_accelerations(w, A_NEXT);
    correct(w);
    clast_status status = step_settle(w, true);
    if (status) return status;
    if (w->found.outside) take_accelerations(w, A_NEXT); /* without what has left */
    return CLAST_OK;
}

/* ---- the starter ----------------------------------------------------------------------------- */

/* At the start of the step with dashpots, whatever the scheme keeps. */
static vec3 acceleration_at_start(const clast_world *w, size_t i) {
    const integrator *s = w->integrator;
    vec3 force = triple_at(s, FORCE, i), v = triple_at(s, V_AGO, i);
    vec3 a = v3_scale(w->shapes[w->bodies.shape[i]].inverse_mass, force);
    a = v3_add(a, v3_sub(gravity_felt(w), v3_scale(w->def.global_damping, v)));
    return a;
}

/* x = x0 + t v0 + t ways_a a, v = v0 + t b: Runge and Kutta's stages for x'' = a(x, v). */
static void put_stage(clast_world *w, double time, double way, int way_of, int kick_of) {
    const integrator *s = w->integrator;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 start = acceleration_at_start(w, i);
        vec3 a = way_of == FORCE ? start : triple_at(s, way_of, i);
        vec3 b = kick_of == FORCE ? start : triple_at(s, kick_of, i);
        vec3 x = v3_add(triple_at(s, X_AGO, i), v3_scale(time, triple_at(s, V_AGO, i)));
        body_place(w, i, v3_add(x, v3_scale(way, a)));
        body_speed_up(w, i, v3_add(triple_at(s, V_AGO, i), v3_scale(time, b)));
    }
}

/* Half of the springs' load is that of the start; the other half is felt at the end alone. */
static void try_stage(clast_world *w, double fraction, int into) {
    walls_move_to(w, ((double)w->step - 1 + fraction) * w->dt);
    turn_bodies(w, fraction);
    trial_try(w, fraction < 1 ? 0 : 0.5 * w->dt);
    take_accelerations(w, into);
}

static void end_stages(clast_world *w) {
    const integrator *s = w->integrator;
    double dt = w->dt;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 a1 = acceleration_at_start(w, i), a2 = triple_at(s, STAGE, i),
             a3 = triple_at(s, STAGE_2, i), a4 = triple_at(s, A_NEXT, i);
        vec3 way = v3_add(a1, v3_add(a2, a3));
        vec3 kick = v3_add(v3_add(a1, a4), v3_scale(2, v3_add(a2, a3)));
        vec3 x = v3_add(triple_at(s, X_AGO, i), v3_scale(dt, triple_at(s, V_AGO, i)));
        body_place(w, i, v3_add(x, v3_scale(dt * dt / 6, way)));
        body_speed_up(w, i, v3_add(triple_at(s, V_AGO, i), v3_scale(dt / 6, kick)));
    }
}

/* A step of the classical Runge-Kutta scheme, whose local error is of fifth order: the first steps
 * of a scheme that looks back do not spoil its order. In free flight it is exact. Rotation goes as
 * in all other steps. */
clast_status step_start(clast_world *w) {
    double dt = w->dt;
    bool splits = w->integrator->info->splits;
    put_stage(w, 0.5 * dt, 0, FORCE, FORCE);
    try_stage(w, 0.5, STAGE);
    put_stage(w, 0.5 * dt, 0.25 * dt * dt, FORCE, STAGE);
    try_stage(w, 0.5, STAGE_2);
    put_stage(w, dt, 0.5 * dt * dt, STAGE, STAGE_2);
    try_stage(w, 1, A_NEXT);
    end_stages(w);
    correct_momenta(w);
    if (splits) split_forces_kept(w);
    clast_status status = step_settle(w, true);
    if (status) return status;
    w->counters.force_evaluations++;
    take_accelerations(w, splits ? KNOWN : A_NEXT);
    return CLAST_OK;
}

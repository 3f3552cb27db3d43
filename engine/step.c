/* step.c - preparing a world and the time step, which reads as the method section of a paper.
 *
 * At a step boundary the world holds x(n), v(n-1/2) and the contact forces f(n). */
#include "engine/periodic.h"
#include "engine/ranks.h"
#include "engine/world.h"

/* ---- preparing ------------------------------------------------------------------------------- */

static void choose_sizes(clast_world *w) {
    w->smallest_radius = INFINITY;
    for (int i = 0; i < w->shape_count; i++) {
        const shape *s = &w->shapes[i];
        if (s->bound > w->largest_bound) w->largest_bound = s->bound;
        if ((uint32_t)s->spheres > w->name_stride) w->name_stride = (uint32_t)s->spheres;
        for (int k = 0; k < s->spheres; k++)
            if (s->radius[k] < w->smallest_radius) w->smallest_radius = s->radius[k];
    }
    w->skin = w->def.skin > 0 ? w->def.skin : 0.15 * w->smallest_radius;
    w->margin = 0.02 * w->smallest_radius < w->skin ? 0.02 * w->smallest_radius : w->skin;
    if (w->def.scheme != CLAST_SCHEME_LEAPFROG) w->margin = w->skin; /* scheme_trial.c */
}

static bool shape_is_of(const clast_world *w, int m) {
    for (int i = 0; i < w->shape_count; i++)
        if (w->shapes[i].material == m) return true;
    return false;
}

static bool wall_is_of(const clast_world *w, int m) {
    for (int i = 0; i < w->wall_count; i++)
        if (w->walls[i].def.material == m) return true;
    return false;
}

static clast_status check_pairs(clast_world *w) {
    w->error[0] = '\0';
    int faults = 0;
    for (int a = 0; a < w->material_count; a++)
        for (int b = 0; b < w->material_count; b++) {
            bool said = b < a && shape_is_of(w, b);
            if (!shape_is_of(w, a) || !(shape_is_of(w, b) || wall_is_of(w, b)) || said) continue;
            if (w->coefs[a * w->material_count + b].set) continue;
            world_complain(w, "pair %s / %s is not set", w->materials[a].name,
                           w->materials[b].name);
            faults++;
        }
    return faults ? CLAST_ERR_ARGUMENT : CLAST_OK;
}

static bool plane_is_principal(const clast_world *w, size_t i) {
    mat3 r = q_matrix(body_orientation(w, i));
    double along = v3_at(r.row[w->def.plane_axis], w->def.plane_axis);
    return along > 1 - 1e-9; /* motion_plane.c knows turns about the axis, not bodies upside down */
}

static clast_status check_plane(clast_world *w) {
    if (w->def.motion != CLAST_MOTION_IN_PLANE) return CLAST_OK;
    const body_store *b = &w->bodies;
    for (size_t i = 0; i < b->count; i++) {
        double across = v3_at(v3(b->vx[i], b->vy[i], b->vz[i]), w->def.plane_axis);
        vec3 spin = v3(b->lx[i], b->ly[i], b->lz[i]);
        double about = v3_at(spin, w->def.plane_axis);
        if (across != 0)
            return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                            "body %u moves across the plane of motion", b->id[i]);
        if (v3_dot(spin, spin) != about * about)
            return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                            "body %u spins out of the plane of motion", b->id[i]);
        if (!plane_is_principal(w, i))
            return (clast_status)world_fail(
                w, CLAST_ERR_ARGUMENT, "body %u is tilted out of the plane of motion", b->id[i]);
    }
    return CLAST_OK;
}

static clast_status prepare_checked(clast_world *w) {
    if (w->shape_count == 0)
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "the scene has no shape");
    if (w->def.law == CLAST_LAW_USER && !w->user_law.force)
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                        "the contact law is missing: clast_world_use_law()");
    clast_status s = check_pairs(w);
    if (s) return s;
    s = check_plane(w);
    if (s) return s;
    choose_sizes(w);
    w->scene_ids = w->next_id;
    s = period_check(w);
    if (s) return s;
    s = flow_check(w);
    if (s) return s;
    s = ranks_join(w);
    if (s) return s;
    shares_make(w);
    walls_link(w);
    special_choose(w);
    s = shared_check(w);
    if (s) return s;
    special_choose_kernels(w);
    special_choose_scale(w);
    if ((uint64_t)w->next_id * w->name_stride >= UINT32_MAX)
        return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "more spheres than can be named");
    return timestep_choose(w);
}

clast_status clast_world_prepare(clast_world *w) {
    CLAST_ASSERT(w);
    if (w->prepared) return CLAST_OK;
    if (w->failed) return CLAST_ERR_GUARD;
    clast_status s = prepare_checked(w);
    if (s) return s;
    exact_sum nothing_yet = {0, 0};
    if (w->period.any) bodies_wrap(w, 0, w->bodies.count, &nothing_yet);
    if (w->def.scheme != CLAST_SCHEME_LEAPFROG) integrator_make(w);
    walls_group(w);
    walls_plant(w);
    walls_make_rows(w);
    walls_move(w);
    int outside = guards_complain_of_outside(w); /* before the bodies go to their processes */
    ranks_scatter(w);
    carry_records(w);
    lists_rebuild(w);
    s = guards_check_start(w, outside);
    if (s && w->ranks) w->failed = true; /* the bodies have gone to their processes */
    if (s) return walls_drop_rows(w), s; /* walls may be added before another try */
    w->prepared = true;
    w->contact_dt = 0;
    contacts_evaluate(w); /* books nothing: no time has passed */
    ledger_set_scale(w);
    contacts_restore(w); /* the same forces; sums in the ledger's quanta */
    if (w->integrator)
        integrator_start(w), rows_fill(w, 0, w->bodies.count);
    else
        velocities_start(w); /* rows stay as contacts felt them: readers change nothing */
    w->contact_dt = w->dt;
    ledger_start(w);
    return CLAST_OK;
}

/* ---- stepping -------------------------------------------------------------------------------- */

/* Six looks at the clock cost as much as ten contacts: with few bodies it is read in every
 * CLOCK_EVERY-th step, which stands for the others. */
enum { CLOCKED_BODIES = 1000, CLOCK_EVERY = 17 };

typedef struct stage_clock {
    double since;
    int steps; /* that this one stands for; 0: is not read */
} stage_clock;

static stage_clock clock_start(const clast_world *w) {
    bool few = w->bodies.count < CLOCKED_BODIES, read = !few || w->step % CLOCK_EVERY == 0;
    return (stage_clock){read ? world_seconds() : 0, read ? few ? CLOCK_EVERY : 1 : 0};
}

static void lap(stage_clock *c, double *into) {
    if (c->steps == 0) return;
    double now = world_seconds();
    *into += c->steps * (now - c->since);
    c->since = now;
}

/* What came in the step of a failure stands behind the ghosts as yet, and is told by nobody: it
 * takes its place, so that the state at the failure has it. */
static clast_status settle_arrivals(clast_world *w, clast_status failure) {
    double arrived = (double)w->arrived;
    ranks_reduce(w, &arrived, 1, 0);
    if (arrived > 0) carry_lists(w), ranks_forget_ghosts(w), lists_rebuild(w);
    return failure;
}

/* Contacts whose partner has left take their elastic energy along. */
clast_status world_rebuild(clast_world *w) {
    bool leaving = w->found.outside || w->parts_changed;
    stored_energy before = leaving ? contacts_stored_energy(w) : (stored_energy){0, 0};
    clast_status s = w->found.outside ? guards_outside(w) : CLAST_OK;
    if (s) return settle_arrivals(w, s);
    bool divide = ranks_wish_to_divide(w);
    if (divide)
        records_collect_here(w);
    else
        carry_lists(w);
    ranks_forget_ghosts(w);
    if (w->found.outside) bodies_leave(w);
    if (divide) ranks_divide(w), carry_records(w);
    lists_rebuild(w);
    if (leaving) ledger_remove_contacts(w, before);
    w->parts_changed = false;
    return CLAST_OK;
}

/* Lists are made in a few steps only, so their time is taken in each of those. */
static clast_status refresh_neighbours(clast_world *w, stage_clock *stages) {
    way_verdict old = way_judge(w);
    lap(stages, &w->counters.seconds_neighbours);
    bool rebuild = w->stale || old.reach || w->found.outside;
    if (!rebuild && !old.contacts) return CLAST_OK;
    stage_clock making = {world_seconds(), 1};
    clast_status s = rebuild ? world_rebuild(w) : CLAST_OK;
    if (!rebuild) lists_refresh(w);
    lap(&making, &w->counters.seconds_neighbours);
    stages->since = making.since;
    return s;
}

clast_status clast_world_step(clast_world *w) {
    CLAST_ASSERT(w);
    clast_status s = clast_world_prepare(w);
    if (s || w->failed) return s ? s : CLAST_ERR_GUARD;
    if (w->integrator) return integrator_step(w);
    clast_counters *c = &w->counters;
    stage_clock clock = clock_start(w);

    bodies_advance(w); /* gather f(n), kick, drift: x(n+1), v(n+1/2) */
    w->found.outside |= outlets_hold_any(w);
    w->step++;
    ranks_swap(w);
    lap(&clock, &c->seconds_bodies);
    walls_move(w);
    ranks_agree(w);
    clast_status fed = feeds_deliver(w); /* who is due */
    lap(&clock, &c->seconds_walls);
    s = refresh_neighbours(w, &clock); /* if something has moved half the skin, come or left */
    if (s || fed) return s ? s : fed;
    contacts_evaluate(w); /* narrow phase, law, sums per pair: f(n+1) */
    lap(&clock, &c->seconds_contacts);
    s = guards_check(w);
    lap(&clock, &c->seconds_measure);
    return s;
}

clast_status clast_world_run(clast_world *w, double time) {
    clast_status s = clast_world_prepare(w);
    while (!s && clast_world_time(w) < time - 0.5 * w->dt) s = clast_world_step(w);
    return s;
}

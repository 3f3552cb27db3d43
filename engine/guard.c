/* guard.c - a run that fails says what, who, where and when, and stops. */
#include <stdio.h>

#include "engine/geometry.h"

enum { NAMED = 10, ENERGY_EVERY = 1000 };

static void describe_body(const clast_world *w, size_t slot, char *text, size_t room) {
    const body_store *b = &w->bodies;
    snprintf(text, room, "body %u (%s) at (%.6g, %.6g, %.6g) m, velocity (%.4g, %.4g, %.4g) m/s",
             b->id[slot], w->shapes[b->shape[slot]].name, b->x[slot], b->y[slot], b->z[slot],
             b->vx[slot], b->vy[slot], b->vz[slot]);
}

static clast_status trip(clast_world *w, const char *what) {
    world_fail(w, CLAST_ERR_GUARD, "run failed at step %llu, t = %.9g s: %s",
               (unsigned long long)w->step, (double)w->step * w->dt, what);
    if (w->def.guards == CLAST_GUARD_REPORT) {
        w->counters.guard_trips++;
        return CLAST_OK;
    }
    w->failed = true;
    return CLAST_ERR_GUARD;
}

/* ---- overlap --------------------------------------------------------------------------------- */

static double smaller_radius(const clast_world *w, size_t c) {
    const candidate_store *k = &w->list.candidates;
    double a = w->spheres.radius[k->a[c]];
    return k->b[c] >= 0 && w->spheres.radius[k->b[c]] < a ? w->spheres.radius[k->b[c]] : a;
}

/* The pair of the worst contact, by relative overlap and, among equals, by name. */
static size_t worst_contact(const clast_world *w, size_t *worst_pair) {
    const pair_list *l = &w->list;
    double most = -1;
    size_t worst = 0;
    for (size_t p = 0; p < l->pair_count; p++)
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++) {
            const history *h = &l->candidates.histories[c];
            if (!l->candidates.touching[c]) continue;
            double sum = h->force.x + h->force.y + h->force.z;
            double overlap = sum - sum == 0 ? h->overlap / smaller_radius(w, c) : INFINITY;
            if (overlap > most) most = overlap, worst = c, *worst_pair = p;
        }
    return worst;
}

static void describe_pair(const clast_world *w, size_t p, char *text, size_t room) {
    const pair *q = &w->list.pairs[p];
    char a[200], b[200];
    describe_body(w, (size_t)q->a, a, sizeof a);
    if (q->b >= 0) describe_body(w, (size_t)q->b, b, sizeof b);
    else snprintf(b, sizeof b, "wall %s", w->walls[-1 - q->b].name);
    snprintf(text, room, "%s against %s", a, b);
}

static clast_status overlap_failure(clast_world *w) {
    char who[512], what[1024];
    size_t p = 0, c = worst_contact(w, &p);
    describe_pair(w, p, who, sizeof who);
    const history *h = &w->list.candidates.histories[c];
    snprintf(what, sizeof what,
             "overlap %.3g mm, %.3g of the smaller radius (limit %.3g), force %.3g N: %s",
             1e3 * h->overlap, h->overlap / smaller_radius(w, c), w->def.max_overlap,
             v3_norm(h->force), who);
    return trip(w, what);
}

/* ---- motion ---------------------------------------------------------------------------------- */

/* Called when the bound of the hot loop is above the limit; looks whether a body really is. */
static clast_status motion_failure(clast_world *w) {
    const body_store *b = &w->bodies;
    double most = -1;
    size_t who = 0;
    for (size_t i = 0; i < b->count; i++) {
        double v2 = b->vx[i] * b->vx[i] + b->vy[i] * b->vy[i] + b->vz[i] * b->vz[i];
        double s2 = b->wx[i] * b->wx[i] + b->wy[i] * b->wy[i] + b->wz[i] * b->wz[i];
        double bound = w->shapes[b->shape[i]].bound, speed = sqrt(v2) + sqrt(s2) * bound;
        if (!(speed <= most)) most = speed == speed ? speed : INFINITY, who = i;
    }
    if (most * w->dt <= w->def.max_displacement * w->smallest_radius) return CLAST_OK;
    char name[256], what[512];
    describe_body(w, who, name, sizeof name);
    snprintf(what, sizeof what,
             "a sphere moves %.3g mm in one step (limit %.3g of the smallest radius"
             " %.3g mm): %s",
             1e3 * most * w->dt, w->def.max_displacement, 1e3 * w->smallest_radius, name);
    return trip(w, what);
}

/* ---- energy ---------------------------------------------------------------------------------- */

/* The residual against the energy put in; a bed at rest is measured against the weight times a
 * radius. */
clast_status guards_check_energy(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    double floor_energy = 0;
    for (int s = 0; s < w->shape_count; s++)
        floor_energy = fmax(floor_energy, w->shapes[s].mass);
    floor_energy *= (double)w->bodies.count * v3_norm(w->def.gravity) * w->smallest_radius;
    double input = fmax(e.input, floor_energy);
    char what[256];
    double made = fmin(e.damping, e.friction);
    if (made < -w->def.max_residual * input) {
        snprintf(what, sizeof what,
                 "contacts have made energy: %.4g J by %s, %.3g of the %.4g J put in (limit %.3g)",
                 -made, e.damping < e.friction ? "dashpots" : "tangential springs", -made / input,
                 input, w->def.max_residual);
        return trip(w, what);
    }
    if (fabs(e.residual) <= w->def.max_residual * input) return CLAST_OK;
    snprintf(what, sizeof what, "energy residual %.4g J is %.3g of the %.4g J put in (limit %.3g)",
             e.residual, e.residual / input, input, w->def.max_residual);
    return trip(w, what);
}

clast_status guards_check(clast_world *w) {
    double longest = w->def.max_displacement * w->smallest_radius;
    if (!(w->found.step2_max <= longest * longest)) {
        clast_status s = motion_failure(w);
        if (s) return s;
    }
    if (!(w->overlap_now <= w->def.max_overlap)) {
        clast_status s = overlap_failure(w);
        if (s) return s;
    }
    return w->step % ENERGY_EVERY == 0 ? guards_check_energy(w) : CLAST_OK;
}

/* ---- outside --------------------------------------------------------------------------------- */

/* Bodies that left the domain end the run or, where the scene says so, leave it. Lowest id first,
 * so that the books do not depend on the order of storage. Histories must have been collected
 * before. */
clast_status guards_outside(clast_world *w) {
    for (uint32_t id = 0; id < w->next_id; id++) {
        int32_t slot = w->slot_of_id[id];
        if (slot < 0 || !body_is_outside(w, (size_t)slot)) continue;
        if (w->def.outside == CLAST_OUTSIDE_STOP) {
            char who[256], what[320];
            describe_body(w, (size_t)slot, who, sizeof who);
            snprintf(what, sizeof what, "outside the domain: %s", who);
            clast_status s = trip(w, what);
            if (s) return s;
        }
        ledger_remove_body(w, (size_t)slot);
        body_remove(w, (size_t)slot);
        w->list.stale = true;
    }
    return CLAST_OK;
}

/* ---- the start ------------------------------------------------------------------------------- */

static int complain_of_outside(clast_world *w) {
    int faults = 0;
    for (uint32_t id = 0; id < w->next_id; id++) {
        int32_t slot = w->slot_of_id[id];
        if (slot < 0 || !body_is_outside(w, (size_t)slot)) continue;
        char who[256];
        describe_body(w, (size_t)slot, who, sizeof who);
        if (faults++ < NAMED) world_complain(w, "starts outside the domain: %s", who);
    }
    return faults;
}

static int complain_of_overlaps(clast_world *w) {
    const pair_list *l = &w->list;
    int faults = 0;
    for (size_t p = 0; p < l->pair_count; p++)
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++) {
            double overlap = touch_of(w, &l->pairs[p], c).overlap, small = smaller_radius(w, c);
            if (!(overlap > w->def.max_overlap * small)) continue;
            char who[512];
            describe_pair(w, p, who, sizeof who);
            if (faults++ < NAMED)
                world_complain(w, "starts with an overlap of %.3g mm, %.3g of the smaller radius "
                               "(limit %.3g): %s", 1e3 * overlap, overlap / small,
                               w->def.max_overlap, who);
            break;
        }
    return faults;
}

/* Needs a built pair list. */
clast_status guards_check_start(clast_world *w) {
    w->error[0] = '\0';
    int faults = complain_of_outside(w) + complain_of_overlaps(w);
    if (faults == 0) return CLAST_OK;
    if (faults > NAMED) world_complain(w, "... %d faults in all", faults);
    return CLAST_ERR_ARGUMENT;
}

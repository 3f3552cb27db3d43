/* scheme_trial.c - forces at a state that may not become the next one. A trial is a function of the
 * state in the columns of the bodies and of the histories at the start of the step: whatever a pass
 * over the contacts changes (histories, books, lists) is put back before the next.
 *
 * The kernel loads tangential springs with the velocity at the end of the step, which is of first
 * order. So they are loaded in halves: over half a step with the velocities at its start, before it
 * (trial_preload), and over the other half with those at its end. */
#include <string.h>

#include "engine/part.h"
#include "engine/scheme.h"

/* ---- copies ---------------------------------------------------------------------------------- */

static void copy_list(clast_world *w, list_copy *to, const contact_list *from) {
    size_t size = entry_number_size(w);
    for (int k = 0; k < w->history_columns; k++) {
        if (from->count > to->capacity)
            to->column[k] = memory_grow(w, to->column[k], to->capacity, from->capacity, size);
        if (from->count > 0) memcpy(to->column[k], from->column[k], from->count * size);
    }
    if (from->count > to->capacity) to->capacity = from->capacity;
}

static void put_list_back(const clast_world *w, contact_list *to, const list_copy *from,
                          bool springs) {
    size_t size = entry_number_size(w);
    for (int k = 0; k < w->history_columns; k++) {
        bool spring = k >= HISTORY_SPRING && k < HISTORY_PLASTIC;
        if (to->count > 0 && (springs || !spring))
            memcpy(to->column[k], from->column[k], to->count * size);
    }
}

static void keep_histories(clast_world *w) {
    integrator *s = w->integrator;
    size_t lists = 2 * (size_t)w->threads;
    if (!s->lists) s->lists = memory_grow(w, NULL, 0, lists, sizeof *s->lists);
    for (int t = 0; t < w->threads; t++) {
        copy_list(w, &s->lists[2 * t], &w->shares[t].contacts);
        copy_list(w, &s->lists[2 * t + 1], &w->shares[t].walls);
    }
}

static void put_histories_back(clast_world *w, bool springs) {
    const integrator *s = w->integrator;
    for (int t = 0; t < w->threads; t++) {
        put_list_back(w, &w->shares[t].contacts, &s->lists[2 * t], springs);
        put_list_back(w, &w->shares[t].walls, &s->lists[2 * t + 1], springs);
    }
}

/* What is booked from here on is that of trials, unless it is accepted. */
void trial_keep_books(clast_world *w) {
    book_copy *b = &w->integrator->books;
    size_t parts = (size_t)w->part_count;
    if (!b->push) {
        b->push = memory_grow(w, NULL, 0, parts + 1, sizeof *b->push);
        b->work = memory_grow(w, NULL, 0, parts + 1, sizeof *b->work);
    }
    b->ledger = w->ledger;
    b->overlap_max = w->counters.overlap_max, b->overlap_now = w->overlap_now;
    b->contacts = w->counters.contacts;
    for (size_t p = 0; p < parts; p++)
        b->push[p] = w->parts[p].push, b->work[p] = w->parts[p].work_total;
}

static void put_books_back(clast_world *w) {
    const book_copy *b = &w->integrator->books;
    w->ledger = b->ledger;
    w->counters.overlap_max = b->overlap_max, w->overlap_now = b->overlap_now;
    w->counters.contacts = b->contacts;
    for (int p = 0; p < w->part_count; p++)
        w->parts[p].push = b->push[p], w->parts[p].work_total = b->work[p];
}

void trial_free(clast_world *w) {
    integrator *s = w->integrator;
    list_reference *r = &s->reference;
    memory_release(s->books.push), memory_release(s->books.work), memory_release(r->part);
    for (int k = 0; k < 3; k++) memory_release(r->x[k]);
    for (int k = 0; k < 4; k++) memory_release(r->q[k]);
    for (int l = 0; s->lists && l < 2 * w->threads; l++)
        for (int k = 0; k < HISTORY_COLUMNS; k++) memory_release(s->lists[l].column[k]);
    memory_release(s->lists);
}

/* ---- lists ----------------------------------------------------------------------------------- */

static void take_reference(clast_world *w) {
    list_reference *r = &w->integrator->reference;
    const body_store *b = &w->bodies;
    size_t old = r->capacity, now = b->count + 1;
    if (!r->part) r->part = memory_grow(w, NULL, 0, (size_t)w->part_count + 1, sizeof *r->part);
    if (now > old) {
        for (int k = 0; k < 3; k++) r->x[k] = memory_grow(w, r->x[k], old, now, sizeof(double));
        for (int k = 0; k < 4; k++) r->q[k] = memory_grow(w, r->q[k], old, now, sizeof(double));
        r->capacity = now;
    }
    const double *x[3] = {b->x, b->y, b->z}, *q[4] = {b->qw, b->qx, b->qy, b->qz};
    for (int k = 0; k < 3; k++) memcpy(r->x[k], x[k], b->count * sizeof(double));
    for (int k = 0; k < 4; k++) memcpy(r->q[k], q[k], b->count * sizeof(double));
    for (int p = 0; p < w->part_count; p++) r->part[p] = w->parts[p].at;
    r->rebuild = w->counters.rebuilds;
}

/* Of the farthest sphere of a body since the reference; at most 2 sin(half the angle) by turning.
 */
static double way_of(const clast_world *w, const list_reference *r, size_t i) {
    vec3 was = v3(r->x[0][i], r->x[1][i], r->x[2][i]);
    double way = v3_norm(v3_sub(body_position(w, i), was));
    double arm = w->shapes[w->bodies.shape[i]].arm;
    if (arm == 0) return way;
    quat q = body_orientation(w, i);
    double same = q.w * r->q[0][i] + q.x * r->q[1][i] + q.y * r->q[2][i] + q.z * r->q[3][i];
    double sine2 = 1 - same * same;
    return way + 2 * arm * sqrt(sine2 > 0 ? sine2 : 0);
}

/* Nothing has moved half the margin since the lists were made. In these worlds the contact list has
 * all pairs of the reach list, so there is nothing to refresh in between. */
static bool lists_hold(const clast_world *w) {
    const list_reference *r = &w->integrator->reference;
    if (w->stale || r->capacity == 0 || r->rebuild != w->counters.rebuilds) return false;
    double most = 0;
    for (size_t i = 0; i < w->bodies.count; i++) {
        double way = way_of(w, r, i);
        if (!(way <= most)) most = way;
    }
    for (int i = 0; i < w->part_count; i++) most = fmax(most, part_way(&w->parts[i], &r->part[i]));
    return 2 * most < w->margin;
}

/* Needs the histories of the start of the step, which cross with it. */
static void lists_renew(clast_world *w) {
    carry_lists(w);
    w->margin = INFINITY; /* held to the skin when it is tuned */
    lists_rebuild(w);
    take_reference(w);
    keep_histories(w);
}

/* ---- passes ---------------------------------------------------------------------------------- */

static void pass(clast_world *w, double time) {
    put_histories_back(w, true);
    if (lists_hold(w))
        rows_fill(w, 0, w->bodies.count);
    else
        lists_renew(w);
    loads_clear(w);
    w->contact_dt = time;
    contacts_evaluate(w);
}

/* Keeps what the trials of this step begin from. */
void trial_begin(clast_world *w) {
    keep_histories(w);
    trial_keep_books(w);
}

/* Where bodies or parts leave, with the books of that; trials begin from there. */
clast_status trial_rebuild(clast_world *w) {
    put_histories_back(w, true);
    w->margin = INFINITY;
    clast_status status = world_rebuild(w);
    if (status) return status;
    take_reference(w);
    trial_begin(w);
    return CLAST_OK;
}

/* Loads of the contacts at the state in the columns of the bodies, with springs loaded for that
 * time (s) at the velocities there. */
void trial_try(clast_world *w, double spring_time) {
    pass(w, spring_time);
    w->integrator->touching = w->counters.contacts;
    put_books_back(w);
    w->counters.force_evaluations++;
}

static bool has_springs(const clast_world *w) {
    return w->special.tangent && law_has_spring(w);
}

/* The same for the state that is kept, with its books: overlaps are booked over the whole step,
 * springs loaded over its second half. */
void trial_accept(clast_world *w) {
    pass(w, w->dt);
    if (!has_springs(w)) return;
    double elastic = w->ledger.elastic, dashpot = w->ledger.dashpot;
    put_books_back(w);
    pass(w, 0.5 * w->dt);
    w->ledger.elastic = elastic, w->ledger.dashpot = dashpot;
}

/* First half of the springs' load, at the state at the start of the step; the loads are spent. */
void trial_preload(clast_world *w) {
    if (!has_springs(w)) return;
    trial_begin(w);
    loads_clear(w);
    w->contact_dt = 0.5 * w->dt;
    contacts_evaluate(w);
    put_books_back(w);
    put_histories_back(w, false);
}

/* Histories, rows and loads of the state in the columns of the bodies, which trials began from. */
void trial_undo(clast_world *w) {
    put_histories_back(w, true);
    rows_fill(w, 0, w->bodies.count);
    contacts_restore(w);
}

/* Whether any force of this world depends on velocities. */
bool trial_needs_velocity(const clast_world *w) {
    if (w->def.law == CLAST_LAW_USER) return true;
    if (w->special.tangent || w->special.rolling || w->def.global_damping > 0) return true;
    for (int i = 0; i < w->material_count * w->material_count; i++)
        if (w->coefs[i].set && (w->coefs[i].c_normal > 0 || w->coefs[i].yield > 0)) return true;
    return false;
}

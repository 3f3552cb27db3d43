/* guard.c - a run that fails says what, who, where and when, and stops. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/flow.h"
#include "engine/geometry.h"
#include "engine/ranks.h"
#include "engine/facets.h"
#include "engine/world.h"

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

typedef struct worst {
    contact_place at;
    double overlap; /* of the smaller radius */
    contact_record record;
} worst;

/* By relative overlap and, among equals, by name. Only numbers count: a force that is not one shows
 * in the motion of its bodies. */
static void find_worst(const clast_world *w, const contact_place *at, void *context) {
    worst *so_far = context;
    contact_record r = record_of(w, at->list, at->index, at->with_wall);
    double overlap = r.history.overlap / contact_smaller_radius(w, at);
    if (!(r.history.normal - r.history.normal == 0)) overlap = INFINITY;
    bool first = overlap == so_far->overlap && record_compare(&r, &so_far->record) < 0;
    if (overlap > so_far->overlap || first) *so_far = (worst){*at, overlap, r};
}

static void describe_pair(const clast_world *w, const contact_record *r, char *text, size_t room) {
    char a[200], b[200];
    describe_body(w, (size_t)w->slot_of_id[r->a], a, sizeof a);
    if (r->b < CLAST_WALL_ID)
        describe_body(w, (size_t)w->slot_of_id[r->b], b, sizeof b);
    else
        snprintf(b, sizeof b, "wall %s", w->walls[r->b - CLAST_WALL_ID].name);
    snprintf(text, room, "%s against %s", a, b);
}

static clast_status overlap_failure(clast_world *w) {
    char who[512] = "", what[1024];
    worst found = {.overlap = -1};
    contacts_visit(w, find_worst, &found);
    if (found.overlap >= 0) describe_pair(w, &found.record, who, sizeof who);
    const contact_record *r = &found.record;
    const history *h = &r->history;
    snprintf(what, sizeof what,
             "overlap %.3g mm, %.3g of the smaller radius (limit %.3g), force %.3g N: %s",
             1e3 * h->overlap, found.overlap, w->def.max_overlap, h->normal, who);
    double keys[] = {found.overlap, -(double)r->a, -(double)r->b, -r->sphere_a, -r->sphere_b};
    ranks_elect(w, keys, 5, what, sizeof what);
    return trip(w, keys[0] < 0 ? "a contact force is not a number" : what);
}

/* ---- motion ---------------------------------------------------------------------------------- */

/* m/s, of any point of a body; without end where it is no number. */
static double speed_of(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    double v2 = b->vx[i] * b->vx[i] + b->vy[i] * b->vy[i] + b->vz[i] * b->vz[i];
    vec3 spin = body_spin(w, i);
    double speed = sqrt(v2) + sqrt(v3_dot(spin, spin)) * w->shapes[b->shape[i]].bound;
    return speed == speed ? speed : INFINITY;
}

/* The own body that is fastest, of equals the one of lowest id. Returns its speed, or -1. */
static double find_fastest(const clast_world *w, size_t *who) {
    const uint32_t *id = w->bodies.id;
    double most = -1;
    for (size_t i = 0; i < w->bodies.count; i++) {
        double speed = speed_of(w, i);
        if (speed > most || (speed == most && id[i] < id[*who])) most = speed, *who = i;
    }
    return most;
}

/* Called when the bound of the hot loop is above the limit; looks whether a body really is. */
static clast_status motion_failure(clast_world *w) {
    size_t who = 0;
    double most = find_fastest(w, &who);
    char name[256] = "", what[512];
    if (most >= 0) describe_body(w, who, name, sizeof name);
    snprintf(what, sizeof what,
             "a sphere moves %.3g mm in one step (limit %.3g of the smallest radius"
             " %.3g mm): %s",
             1e3 * most * w->dt, w->def.max_displacement, 1e3 * w->smallest_radius, name);
    double keys[] = {most, most >= 0 ? -(double)w->bodies.id[who] : 0};
    ranks_elect(w, keys, 2, what, sizeof what);
    if (keys[0] * w->dt <= w->def.max_displacement * w->smallest_radius) return CLAST_OK;
    return trip(w, what);
}

/* Walls must not step over bodies either. A plane has no other side to come out of. */
static clast_status wall_failure(clast_world *w) {
    char what[512];
    snprintf(what, sizeof what,
             "part %s moves %.3g mm in one step (limit %.3g of the smallest radius %.3g mm)",
             w->parts[w->wall_who].name, 1e3 * w->wall_step, w->def.max_displacement,
             1e3 * w->smallest_radius);
    return trip(w, what);
}

/* ---- Newton's method ------------------------------------------------------------------------- */

clast_status guards_unconverged(clast_world *w, size_t slot, int iterations, double move) {
    char who[256], what[512];
    describe_body(w, slot, who, sizeof who);
    snprintf(
        what, sizeof what,
        "Newton's method has not converged in %d iterations: %.3g m still to go (limit %.3g m) for "
        "%s",
        iterations, move, w->def.newton_tolerance * w->smallest_radius, who);
    return trip(w, what);
}

/* ---- energy ---------------------------------------------------------------------------------- */

/* The residual against the energy put in; a bed at rest is measured against the weight times a
 * radius. */
clast_status guards_check_energy(clast_world *w) {
    clast_energy e = clast_world_energy(w);
    double floor_energy = 0;
    for (int s = 0; s < w->shape_count; s++) floor_energy = fmax(floor_energy, w->shapes[s].mass);
    double bodies = (double)w->bodies.count;
    ranks_reduce(w, &bodies, 0, 1);
    floor_energy *= bodies * v3_norm(w->def.gravity) * w->smallest_radius;
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
    if (!(w->found.way <= w->def.max_displacement * w->smallest_radius)) {
        clast_status s = motion_failure(w);
        if (s) return s;
    }
    if (!(w->wall_step <= w->def.max_displacement * w->smallest_radius)) {
        clast_status s = wall_failure(w);
        if (s) return s;
    }
    if (!(w->overlap_now <= w->def.max_overlap)) {
        clast_status s = overlap_failure(w);
        if (s) return s;
    }
    return w->step % ENERGY_EVERY == 0 ? guards_check_energy(w) : CLAST_OK;
}

/* ---- outside --------------------------------------------------------------------------------- */

/* The lowest id above `after` of an own body outside the domain, or UINT32_MAX. */
static uint32_t next_outside(const clast_world *w, uint32_t from) {
    for (uint32_t id = from; id < w->next_id; id++) {
        int32_t slot = w->slot_of_id[id];
        bool own = slot >= 0 && (size_t)slot < w->bodies.count;
        if (own && outlet_of(w, (size_t)slot) == CLAST_OUTLET_DOMAIN) return id;
    }
    return UINT32_MAX;
}

/* Bodies that left the domain end the run or, where the scene says so, leave it: lowest id first,
 * so that the books do not depend on the order of storage. */
clast_status guards_outside(clast_world *w) {
    if (w->def.outside != CLAST_OUTSIDE_STOP) return CLAST_OK;
    for (uint32_t id = 0;; id++) {
        char who[256] = "", what[320];
        id = next_outside(w, id);
        if (id != UINT32_MAX) describe_body(w, (size_t)w->slot_of_id[id], who, sizeof who);
        snprintf(what, sizeof what, "outside the domain: %s", who);
        double first = -(double)id;
        ranks_elect(w, &first, 1, what, sizeof what);
        id = (uint32_t)-first;
        if (id == UINT32_MAX) return CLAST_OK;
        clast_status s = trip(w, what);
        if (s) return s;
    }
}

/* ---- the start ------------------------------------------------------------------------------- */

/* Of how many bodies. Begins the message. */
int guards_complain_of_outside(clast_world *w) {
    int faults = 0;
    w->error[0] = '\0';
    for (uint32_t id = 0; id < w->next_id; id++) {
        int32_t slot = w->slot_of_id[id];
        if (slot < 0 || !body_is_outside(w, (size_t)slot)) continue;
        char who[256];
        describe_body(w, (size_t)slot, who, sizeof who);
        if (faults++ < NAMED) world_complain(w, "starts outside the domain: %s", who);
    }
    return faults;
}

static double gap_of(const clast_world *w, const contact_place *at) {
    const centre_row *a = &w->rows.centre[at->list->a[at->index]];
    const centre_row *b = &w->rows.centre[at->list->b[at->index]];
    vec3 apart = separation(&w->kernel_period, centre_at(a), centre_at(b));
    return v3_norm(apart) - (a->radius + b->radius);
}

/* Of a sphere and a wall that it feels; the touches of the sphere are those of the share. */
static double wall_overlap(const clast_world *w, const share *s, size_t k, size_t *run) {
    if (k == 0 || s->walls.a[k] != s->walls.a[k - 1]) {
        facets_settle(w, &s->walls, k, facets_run_end(&s->walls, k), false, s->touches);
        *run = k;
    }
    const wall_touch *t = &s->touches[k - *run];
    return t->hidden ? 0 : t->overlap;
}

/* Two bodies, or a body and a wall, that start too deep in each other; where at several places, the
 * deepest. There may be as many as contacts, so texts are made of those alone that are told. */
typedef struct start_fault {
    uint32_t a, b;
    double overlap, depth; /* m, of the smaller radius */
} start_fault;

typedef struct start_faults {
    start_fault *items;
    size_t count, room;
} start_faults;

typedef struct told_fault {
    start_fault fault; /* first: sorted as faults are */
    char text[640];
} told_fault;

static void add_fault(clast_world *w, start_faults *f, start_fault fault) {
    if (f->count == f->room) {
        f->items = memory_grow(w, f->items, f->room, 2 * f->room + 16, sizeof *f->items);
        f->room = 2 * f->room + 16;
    }
    f->items[f->count++] = fault;
}

static void find_faults(clast_world *w, const share *s, bool with_wall, start_faults *f) {
    const contact_list *l = with_wall ? &s->walls : &s->contacts;
    size_t run = 0;
    for (size_t k = 0; k < l->count; k++) {
        contact_place at = {l, k, with_wall};
        double overlap = with_wall ? wall_overlap(w, s, k, &run) : -gap_of(w, &at);
        double small = contact_smaller_radius(w, &at);
        if (!(overlap > w->def.max_overlap * small)) continue;
        contact_record r = record_of(w, l, k, with_wall);
        add_fault(w, f, (start_fault){r.a, r.b, overlap, overlap / small});
    }
}

static told_fault tell(const clast_world *w, const start_fault *f) {
    told_fault told = {.fault = *f};
    char who[512];
    describe_pair(w, &(contact_record){.a = f->a, .b = f->b}, who, sizeof who);
    snprintf(told.text, sizeof told.text,
             "starts with an overlap of %.3g mm, %.3g of the smaller radius (limit %.3g): %s",
             1e3 * f->overlap, f->depth, w->def.max_overlap, who);
    return told;
}

static int compare_names(const start_fault *x, const start_fault *y) {
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    return x->b == y->b ? 0 : x->b < y->b ? -1 : 1;
}

static int compare_depths(const start_fault *x, const start_fault *y) {
    if (x->depth != y->depth) return x->depth > y->depth ? -1 : 1;
    return x->overlap == y->overlap ? 0 : x->overlap > y->overlap ? -1 : 1;
}

static int by_name(const void *left, const void *right) {
    int order = compare_names(left, right);
    return order ? order : compare_depths(left, right);
}

static int deepest_first(const void *left, const void *right) {
    int order = compare_depths(left, right);
    return order ? order : compare_names(left, right);
}

/* Of things that begin with a fault, one of each pair, the deepest first. Returns how many. */
static size_t keep_one_of_each(void *items, size_t count, size_t size) {
    char *at = items;
    size_t kept = 0;
    if (count > 1) qsort(items, count, size, by_name);
    for (size_t k = 0; k < count; k++) {
        char *now = at + k * size, *last = kept > 0 ? at + (kept - 1) * size : NULL;
        if (last && compare_names((start_fault *)now, (start_fault *)last) == 0) continue;
        memmove(at + kept++ * size, now, size);
    }
    if (kept > 1) qsort(items, kept, size, deepest_first);
    return kept;
}

/* `own`: one of each pair, the deepest first. Returns how many there are in all processes. */
static size_t complain_of_deepest(clast_world *w, const start_faults *own, int most) {
    told_fault told[NAMED];
    size_t mine = 0, told_count, count;
    while (mine < NAMED && mine < own->count) told[mine] = tell(w, &own->items[mine]), mine++;
    told_fault *texts = ranks_gather(w, told, mine, sizeof *told, &told_count);
    start_fault *all = ranks_gather(w, own->items, own->count, sizeof *all, &count);
    told_count = keep_one_of_each(texts, told_count, sizeof *texts);
    count = keep_one_of_each(all, count, sizeof *all);
    for (size_t k = 0; k < told_count && (int)k < most; k++) world_complain(w, "%s", texts[k].text);
    free(texts), free(all);
    return count;
}

static int complain_of_overlaps(clast_world *w, int faults) {
    start_faults own = {0};
    for (int t = 0; t < w->threads; t++) {
        find_faults(w, &w->shares[t], false, &own);
        find_faults(w, &w->shares[t], true, &own);
    }
    own.count = keep_one_of_each(own.items, own.count, sizeof *own.items);
    size_t more = complain_of_deepest(w, &own, NAMED - faults);
    memory_return(w, own.room * sizeof *own.items), memory_release(own.items);
    return faults + (int)more;
}

/* Needs built lists; `faults` have been complained of. */
clast_status guards_check_start(clast_world *w, int faults) {
    faults = complain_of_overlaps(w, faults);
    if (faults == 0) return CLAST_OK;
    if (faults > NAMED) world_complain(w, "... %d faults in all", faults);
    return CLAST_ERR_ARGUMENT;
}

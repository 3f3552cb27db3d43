/* outlet.c - bodies that leave: through an outlet, or out of a domain that removes them. */
#include <stdlib.h>

#include "engine/flow.h"
#include "engine/ranks.h"

static bool is_finite(vec3 a) {
    return isfinite(a.x) && isfinite(a.y) && isfinite(a.z);
}

static const char *fault_of(const clast_outlet_def *d) {
    if (d->kind == CLAST_OUTLET_BOX) {
        if (!is_finite(d->min) || !is_finite(d->max)) return "has a corner that is not finite";
        bool below = d->min.x < d->max.x && d->min.y < d->max.y && d->min.z < d->max.z;
        return below ? NULL : "is an empty box";
    }
    if (d->kind != CLAST_OUTLET_PLANE) return "is of no known kind";
    if (!is_finite(d->point) || !is_finite(d->normal))
        return "has a point or normal that is not finite";
    return v3_norm(d->normal) > 0 ? NULL : "has no normal";
}

int clast_outlet_add(clast_world *w, const clast_outlet_def *def) {
    CLAST_ASSERT(w && def && !w->prepared);
    const char *fault = fault_of(def), *name = def->name ? def->name : "?";
    if (fault) return world_fail(w, CLAST_ERR_ARGUMENT, "outlet %s %s", name, fault), -1;
    flow *f = w->flow;
    size_t n = (size_t)f->outlet_count;
    f->outlets = memory_grow(w, f->outlets, n, n + 1, sizeof *f->outlets);
    outlet *o = &f->outlets[n];
    *o = (outlet){.def = *def};
    o->def.name = memory_text(w, name);
    if (def->kind == CLAST_OUTLET_PLANE)
        o->def.normal = v3_scale(1 / v3_norm(def->normal), def->normal);
    return f->outlet_count++;
}

/* ---- who leaves ------------------------------------------------------------------------------ */

static bool holds(const clast_outlet_def *d, vec3 p) {
    if (d->kind == CLAST_OUTLET_PLANE) return v3_dot(v3_sub(p, d->point), d->normal) > 0;
    return p.x >= d->min.x && p.x <= d->max.x && p.y >= d->min.y && p.y <= d->max.y &&
           p.z >= d->min.z && p.z <= d->max.z;
}

/* The first that was added, where several hold it. */
int outlet_of(const clast_world *w, size_t slot) {
    const flow *f = w->flow;
    vec3 p = body_position(w, slot);
    for (int i = 0; i < f->outlet_count; i++)
        if (holds(&f->outlets[i].def, p)) return i;
    return body_is_outside(w, slot) ? CLAST_OUTLET_DOMAIN : NO_OUTLET;
}

bool outlets_hold_any(const clast_world *w) {
    const flow *f = w->flow;
    if (f->outlet_count == 0) return false;
    for (size_t i = 0; i < w->bodies.count; i++) {
        vec3 p = body_position(w, i);
        for (int k = 0; k < f->outlet_count; k++)
            if (holds(&f->outlets[k].def, p)) return true;
    }
    return false;
}

static int by_number(const void *left, const void *right) {
    uint32_t a = *(const uint32_t *)left, b = *(const uint32_t *)right;
    return (a > b) - (a < b);
}

static size_t find_leaving(clast_world *w) {
    flow *f = w->flow;
    size_t count = 0;
    for (size_t i = 0; i < w->bodies.count; i++) {
        if (outlet_of(w, i) == NO_OUTLET) continue;
        if (count == f->leaving_room) {
            size_t now = 2 * count + 16;
            f->leaving = memory_grow(w, f->leaving, count, now, sizeof *f->leaving);
            f->leaving_room = now;
        }
        f->leaving[count++] = w->bodies.id[i];
    }
    if (count > 1) qsort(f->leaving, count, sizeof *f->leaving, by_number);
    return count;
}

static void leave(clast_world *w, size_t slot) {
    flow *f = w->flow;
    int gate = outlet_of(w, slot);
    outlet_state *s = gate == CLAST_OUTLET_DOMAIN ? &f->domain : &f->outlets[gate].state;
    passage_note(w, &f->departures, slot, gate);
    s->bodies++;
    s->mass += w->shapes[w->bodies.shape[slot]].mass;
    ledger_remove_body(w, slot);
}

static int by_id(const void *left, const void *right) {
    return by_number(&((const traveller *)left)->id, &((const traveller *)right)->id);
}

/* Those of all processes; malloc'ed. */
static traveller *gather_leaving(clast_world *w, size_t own, size_t *all) {
    traveller *mine = malloc((own + 1) * sizeof *mine);
    CLAST_ASSERT(mine);
    for (size_t k = 0; k < own; k++)
        mine[k] = ranks_body_at(w, (size_t)w->slot_of_id[w->flow->leaving[k]]);
    traveller *leaving = ranks_gather(w, mine, own, sizeof *mine, all);
    free(mine);
    if (*all > 1) qsort(leaving, *all, sizeof *leaving, by_id);
    return leaving;
}

/* Every process books all that leave: a body of another one stands here for that long. */
static void leave_shared(clast_world *w, size_t own) {
    size_t count;
    traveller *leaving = gather_leaving(w, own, &count);
    for (size_t k = 0; k < count; k++) {
        int32_t slot = w->slot_of_id[leaving[k].id];
        if (slot >= 0) {
            leave(w, (size_t)slot);
            body_remove(w, (size_t)slot);
            continue;
        }
        size_t guest = w->bodies.count;
        body_reserve(w, guest + 1);
        ranks_put_body(w, guest, &leaving[k]);
        leave(w, guest);
        w->slot_of_id[leaving[k].id] = -1;
        w->counters.removed++;
    }
    free(leaving);
}

/* In the order of ids, so that the books do not depend on the order of storage. Histories must be
 * carried, and ghosts forgotten. */
void bodies_leave(clast_world *w) {
    size_t count = find_leaving(w);
    if (w->ranks) {
        leave_shared(w, count);
        return;
    }
    for (size_t k = 0; k < count; k++) {
        size_t slot = (size_t)w->slot_of_id[w->flow->leaving[k]];
        leave(w, slot);
        body_remove(w, slot);
    }
}

/* pairs.c - the list of pairs within reach, rebuilt when a body or a part has moved half the skin.
 *
 * Everything here is unobservable: the contact forces of a body are added up in the order of its
 * partners' ids, pairs that do not touch add nothing, and histories move by name (records.c). */
#include <stdlib.h>

#include "engine/geometry.h"
#include "engine/parallel.h"

enum { BLOCK_CANDIDATES = 256 };

/* ---- growing --------------------------------------------------------------------------------- */

static pair *pair_push(clast_world *w) {
    pair_list *l = &w->list;
    if (l->pair_count == l->pair_capacity) {
        size_t old = l->pair_capacity, now = 2 * old + 64;
        l->pairs = memory_grow(w, l->pairs, old, now, sizeof *l->pairs);
        l->forces = memory_grow(w, l->forces, old, now, sizeof *l->forces);
        l->pair_capacity = now;
    }
    return &l->pairs[l->pair_count++];
}

static void candidate_push(clast_world *w, int32_t a, int32_t b, double radius) {
    candidate_store *c = &w->list.candidates;
    if (c->count == c->capacity) {
        size_t old = c->capacity, now = 2 * old + 256;
        c->a = memory_grow(w, c->a, old, now, sizeof *c->a);
        c->b = memory_grow(w, c->b, old, now, sizeof *c->b);
        c->radius = memory_grow(w, c->radius, old, now, sizeof *c->radius);
        c->histories = memory_grow(w, c->histories, old, now, sizeof *c->histories);
        c->touching = memory_grow(w, c->touching, old, now, 1);
        c->capacity = now;
    }
    c->a[c->count] = a, c->b[c->count] = b, c->radius[c->count] = radius;
    c->histories[c->count] = (history){0};
    c->touching[c->count] = 0;
    c->count++;
}

/* ---- pairs of bodies ------------------------------------------------------------------------- */

static int by_id(const void *a, const void *b) {
    uint32_t x = ((const partner *)a)->id, y = ((const partner *)b)->id;
    return (x > y) - (x < y);
}

static double bound_of(const clast_world *w, int32_t slot) {
    return w->shapes[w->bodies.shape[slot]].bound;
}

/* Bodies of higher id within reach of slot a, from the cells around it. */
static size_t find_partners(const clast_world *w, int32_t a, partner *found, size_t room) {
    const body_store *b = &w->bodies;
    const cell_grid *g = &w->cells.grid;
    int ci = (int)((b->x[a] - g->low.x) / g->size), cj = (int)((b->y[a] - g->low.y) / g->size),
        ck = (int)((b->z[a] - g->low.z) / g->size);
    size_t count = 0;
    for (int k = ck > 0 ? ck - 1 : 0; k <= ck + 1 && k < g->nz; k++)
        for (int j = cj > 0 ? cj - 1 : 0; j <= cj + 1 && j < g->ny; j++) {
            int i0 = ci > 0 ? ci - 1 : 0, i1 = ci + 1 < g->nx ? ci + 1 : g->nx - 1;
            size_t row = ((size_t)k * (size_t)g->ny + (size_t)j) * (size_t)g->nx;
            uint32_t from = w->cells.cell_first[row + (size_t)i0];
            uint32_t to = w->cells.cell_first[row + (size_t)i1 + 1];
            for (uint32_t s = from; s < to; s++) {
                if (b->id[s] <= b->id[a]) continue;
                double dx = b->x[s] - b->x[a], dy = b->y[s] - b->y[a], dz = b->z[s] - b->z[a];
                double reach = bound_of(w, a) + bound_of(w, (int32_t)s) + w->skin;
                if (dx * dx + dy * dy + dz * dz >= reach * reach) continue;
                if (count < room) found[count] = (partner){b->id[s], (int32_t)s};
                count++;
            }
        }
    return count;
}

static void add_sphere_candidates(clast_world *w, int32_t a, int32_t b) {
    const sphere_store *s = &w->spheres;
    for (size_t i = s->first[a]; i < s->first[a + 1]; i++)
        for (size_t j = s->first[b]; j < s->first[b + 1]; j++) {
            double dx = s->x[i] - s->x[j], dy = s->y[i] - s->y[j], dz = s->z[i] - s->z[j];
            double ri = s->radius[i], rj = s->radius[j], reach = ri + rj + w->skin;
            if (dx * dx + dy * dy + dz * dz >= reach * reach) continue;
            candidate_push(w, (int32_t)i, (int32_t)j, ri * rj / (ri + rj));
        }
}

static int32_t coef_of(const clast_world *w, int material_a, int material_b) {
    return (int32_t)(material_a * w->material_count + material_b);
}

static void push_body_pair(clast_world *w, int32_t a, int32_t b, uint32_t first) {
    const shape *sa = &w->shapes[w->bodies.shape[a]], *sb = &w->shapes[w->bodies.shape[b]];
    *pair_push(w) = (pair){a, b, coef_of(w, sa->material, sb->material), first,
                           sa->mass * sb->mass / (sa->mass + sb->mass)};
}

static void push_wall_pair(clast_world *w, int32_t a, int wall_index, uint32_t first) {
    const shape *sa = &w->shapes[w->bodies.shape[a]];
    *pair_push(w) =
        (pair){a, -1 - wall_index, coef_of(w, sa->material, w->walls[wall_index].def.material),
               first, sa->mass};
}

static void add_body_pair(clast_world *w, int32_t a, int32_t b) {
    uint32_t first = (uint32_t)w->list.candidates.count;
    add_sphere_candidates(w, a, b);
    if (w->list.candidates.count > first) push_body_pair(w, a, b, first);
}

static void grow_partners(clast_world *w, size_t room) {
    pair_list *l = &w->list;
    l->partners = memory_grow(w, l->partners, l->partner_room, room, sizeof *l->partners);
    l->partner_room = room;
}

static void add_body_pairs(clast_world *w) {
    if (w->list.partner_room == 0) grow_partners(w, 64);
    for (size_t a = 0; a < w->bodies.count; a++) {
        size_t count = find_partners(w, (int32_t)a, w->list.partners, w->list.partner_room);
        if (count > w->list.partner_room) {
            grow_partners(w, 2 * count);
            find_partners(w, (int32_t)a, w->list.partners, w->list.partner_room);
        }
        const partner *found = w->list.partners;
        qsort(w->list.partners, count, sizeof *found, by_id);
        for (size_t i = 0; i < count; i++) add_body_pair(w, (int32_t)a, found[i].slot);
    }
}

/* ---- pairs of a body and a wall -------------------------------------------------------------- */

static void add_wall_pair(clast_world *w, int32_t a, int wall_index) {
    const wall *l = &w->walls[wall_index];
    if (wall_approach(l, body_position(w, (size_t)a)).distance >= bound_of(w, a) + w->skin) return;
    const sphere_store *s = &w->spheres;
    uint32_t first = (uint32_t)w->list.candidates.count;
    for (size_t i = s->first[a]; i < s->first[a + 1]; i++) {
        vec3 centre = v3(s->x[i], s->y[i], s->z[i]);
        if (wall_approach(l, centre).distance >= s->radius[i] + w->skin) continue;
        candidate_push(w, (int32_t)i, -1 - wall_index, s->radius[i]);
    }
    if (w->list.candidates.count > first) push_wall_pair(w, a, wall_index, first);
}

static void add_wall_pairs(clast_world *w) {
    w->list.wall_pairs = w->list.pair_count;
    for (int l = 0; l < w->wall_count; l++) {
        if (!w->parts[w->walls[l].part].present) continue;
        for (size_t a = 0; a < w->bodies.count; a++) add_wall_pair(w, (int32_t)a, l);
    }
}

/* ---- contacts that have just moved out of reach
 -----------------------------------------------------------

 * A contact that touched at the last evaluation and is now farther apart than the skin gets a pair
 of
 * its own: the law books its end, as it would with a wider skin. */

static void keep_body_contact(clast_world *w, const contact_record *r) {
    int32_t a = w->slot_of_id[r->a], b = w->slot_of_id[r->b];
    if (a < 0 || b < 0) return;
    const sphere_store *s = &w->spheres;
    size_t i = s->first[a] + (size_t)r->sphere_a, j = s->first[b] + (size_t)r->sphere_b;
    vec3 between = v3_sub(body_position(w, (size_t)a), body_position(w, (size_t)b));
    double reach = bound_of(w, a) + bound_of(w, b) + w->skin, ri = s->radius[i], rj = s->radius[j];
    double dx = s->x[i] - s->x[j], dy = s->y[i] - s->y[j], dz = s->z[i] - s->z[j];
    double near = ri + rj + w->skin;
    if (v3_dot(between, between) < reach * reach && dx * dx + dy * dy + dz * dz < near * near)
        return;
    uint32_t first = (uint32_t)w->list.candidates.count;
    candidate_push(w, (int32_t)i, (int32_t)j, ri * rj / (ri + rj));
    push_body_pair(w, a, b, first);
}

static void keep_wall_contact(clast_world *w, const contact_record *r) {
    int32_t a = w->slot_of_id[r->a];
    int wall_index = (int)(r->b - CLAST_WALL_ID);
    const wall *l = &w->walls[wall_index];
    if (a < 0 || !w->parts[l->part].present) return;
    const sphere_store *s = &w->spheres;
    size_t i = s->first[a] + (size_t)r->sphere_a;
    double reach = bound_of(w, a) + w->skin, near = s->radius[i] + w->skin;
    if (wall_approach(l, body_position(w, (size_t)a)).distance < reach &&
        wall_approach(l, v3(s->x[i], s->y[i], s->z[i])).distance < near)
        return;
    uint32_t first = (uint32_t)w->list.candidates.count;
    candidate_push(w, (int32_t)i, -1 - wall_index, s->radius[i]);
    push_wall_pair(w, a, wall_index, first);
}

static void keep_contacts(clast_world *w, bool with_walls) {
    for (size_t i = 0; i < w->records.count; i++) {
        const contact_record *r = &w->records.items[i];
        if (with_walls != (r->b >= CLAST_WALL_ID)) continue;
        if (with_walls) keep_wall_contact(w, r);
        else keep_body_contact(w, r);
    }
}

/* ---- each body's pairs in the order of its partners' ids ------------------------------------- */

static uint32_t partner_id(const clast_world *w, const incidence *i) {
    const pair *p = &w->list.pairs[i->pair];
    if (i->side < 0) return w->bodies.id[p->a];
    return p->b >= 0 ? w->bodies.id[p->b] : CLAST_WALL_ID + (uint32_t)(-1 - p->b);
}

static void sort_incidences(clast_world *w, size_t from, size_t to) {
    incidence *list = w->list.incidences;
    for (size_t i = from + 1; i < to; i++) {
        incidence moving = list[i];
        uint32_t key = partner_id(w, &moving);
        size_t j = i;
        for (; j > from && partner_id(w, &list[j - 1]) > key; j--) list[j] = list[j - 1];
        list[j] = moving;
    }
}

static void reserve_incidences(clast_world *w) {
    pair_list *l = &w->list;
    size_t need = 2 * l->pair_count;
    if (need > l->incidence_capacity) {
        size_t capacity = need + need / 2;
        l->incidences = memory_grow(w, l->incidences, l->incidence_capacity, capacity,
                                    sizeof *l->incidences);
        l->incidence_capacity = capacity;
    }
}

static void build_incidences(clast_world *w) {
    reserve_incidences(w);
    pair_list *l = &w->list;
    size_t *first = l->incidence_first, n = w->bodies.count;
    for (size_t i = 0; i <= n + 1; i++) first[i] = 0;
    for (size_t p = 0; p < l->pair_count; p++) {
        first[l->pairs[p].a + 2]++;
        if (l->pairs[p].b >= 0) first[l->pairs[p].b + 2]++;
    }
    for (size_t i = 2; i <= n + 1; i++) first[i] += first[i - 1];
    for (size_t p = 0; p < l->pair_count; p++) {
        const pair *q = &l->pairs[p];
        l->incidences[first[q->a + 1]++] = (incidence){(uint32_t)p, 1};
        if (q->b >= 0) l->incidences[first[q->b + 1]++] = (incidence){(uint32_t)p, -1};
    }
    for (size_t i = 0; i < n; i++) sort_incidences(w, first[i], first[i + 1]);
}

/* ---- blocks of the contact pass: whole pairs, about 256 candidates, walls apart -------------- */

static void block_begin(clast_world *w, size_t pair_index) {
    pair_list *l = &w->list;
    if (l->block_count + 1 >= l->block_capacity) {
        size_t now = 2 * l->block_capacity + 64;
        l->block_first = memory_grow(w, l->block_first, l->block_capacity, now,
                                     sizeof *l->block_first);
        l->block_capacity = now;
    }
    l->block_first[l->block_count++] = pair_index;
}

static void build_blocks(clast_world *w) {
    pair_list *l = &w->list;
    l->block_count = 0;
    size_t begun = 0;
    for (size_t p = 0; p < l->pair_count; p++) {
        size_t end = l->pairs[p + 1].first;
        bool full = p > 0 && end - begun > BLOCK_CANDIDATES;
        if (p > 0 && !full && p != l->wall_pairs) continue;
        block_begin(w, p);
        begun = l->pairs[p].first;
    }
    block_begin(w, l->pair_count);
    l->block_count--;
}

/* ---- the whole ------------------------------------------------------------------------------- */

static void reserve_slots(clast_world *w) {
    sphere_store *s = &w->spheres;
    static const size_t extra = 2;
    if (s->first && w->list.slot_capacity >= w->bodies.count + extra) return;
    size_t old = s->first ? w->list.slot_capacity : 0, now = w->bodies.capacity + extra;
    s->first = memory_grow(w, s->first, old, now, sizeof *s->first);
    w->list.incidence_first = memory_grow(w, w->list.incidence_first, w->list.slot_capacity, now,
                                          sizeof *w->list.incidence_first);
    w->list.slot_capacity = now;
}

static void remember_poses(clast_world *w) {
    const body_store *b = &w->bodies;
    if (w->built_capacity < b->capacity) {
        w->built = memory_grow(w, w->built, w->built_capacity, b->capacity, sizeof *w->built);
        w->built_capacity = b->capacity;
    }
    for (size_t i = 0; i < b->count; i++)
        w->built[i] = (built_pose){b->x[i],  b->y[i],  b->z[i],  b->qw[i],
                                   b->qx[i], b->qy[i], b->qz[i], w->shapes[b->shape[i]].arm};
    for (int i = 0; i < w->part_count; i++) w->parts[i].built_offset = w->parts[i].offset;
}

/* Needs w->records to hold the contacts that touched at the last evaluation. */
void pairs_rebuild(clast_world *w) {
    pair_list *l = &w->list;
    l->pair_count = l->candidates.count = 0;
    reserve_slots(w);
    if (w->bodies.count > 0) cells_sort(w, 2 * w->largest_bound + w->skin);
    spheres_layout(w);
    spheres_place(w, 0, w->bodies.count);
    remember_poses(w);
    add_body_pairs(w);
    keep_contacts(w, false);
    add_wall_pairs(w);
    keep_contacts(w, true);
    *pair_push(w) = (pair){.first = (uint32_t)l->candidates.count};
    l->pair_count--;
    build_incidences(w);
    build_blocks(w);
    for (size_t p = 0; p < l->pair_count; p++) l->forces[p] = (pair_force){0};
    records_apply(w);
    l->stale = false;
    w->counters.rebuilds++;
    w->counters.pairs = l->pair_count;
    w->counters.candidates = l->candidates.count;
}

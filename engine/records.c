/* records.c - touching contacts by name (ids, place within the shape) instead of by place in
 * memory: how histories survive a rebuild, and what checkpoint, hash and readers see. */
#include <stdlib.h>

#include "engine/world.h"

static uint32_t id_of_b(const clast_world *w, const pair *p) {
    return p->b >= 0 ? w->bodies.id[p->b] : CLAST_WALL_ID + (uint32_t)(-1 - p->b);
}

static contact_record record_of(const clast_world *w, const pair *p, size_t c) {
    const candidate_store *k = &w->list.candidates;
    const sphere_store *s = &w->spheres;
    int32_t within_b = p->b >= 0 ? k->b[c] - (int32_t)s->first[p->b] : 0;
    return (contact_record){w->bodies.id[p->a], id_of_b(w, p), k->a[c] - (int32_t)s->first[p->a],
                            within_b, k->histories[c]};
}

static int by_name(const void *left, const void *right) {
    const contact_record *x = left, *y = right;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    if (x->b != y->b) return x->b < y->b ? -1 : 1;
    if (x->sphere_a != y->sphere_a) return x->sphere_a < y->sphere_a ? -1 : 1;
    return (x->sphere_b > y->sphere_b) - (x->sphere_b < y->sphere_b);
}

/* Sorts the records by name and notes where each id begins. */
void records_sort(clast_world *w) {
    record_list *r = &w->records;
    if (r->count > 1) qsort(r->items, r->count, sizeof *r->items, by_name);
    size_t ids = (size_t)w->next_id + 1;
    if (ids > r->first_capacity) {
        r->first = memory_grow(w, r->first, r->first_capacity, ids + ids / 2, sizeof *r->first);
        r->first_capacity = ids + ids / 2;
    }
    size_t place = 0;
    for (uint32_t id = 0; id <= w->next_id; id++) {
        while (place < r->count && r->items[place].a < id) place++;
        r->first[id] = place;
    }
}

void records_reserve(clast_world *w, size_t count) {
    record_list *r = &w->records;
    if (count <= r->capacity) return;
    size_t now = count + count / 2 + 64;
    r->items = memory_grow(w, r->items, r->capacity, now, sizeof *r->items);
    r->capacity = now;
}

/* Fills w->records with the contacts that touch. */
void records_collect(clast_world *w) {
    const pair_list *l = &w->list;
    size_t count = 0;
    for (size_t c = 0; c < l->candidates.count; c++) count += l->candidates.touching[c];
    records_reserve(w, count);
    w->records.count = 0;
    for (size_t p = 0; p < l->pair_count; p++)
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++)
            if (l->candidates.touching[c])
                w->records.items[w->records.count++] = record_of(w, &l->pairs[p], c);
    records_sort(w);
}

static const contact_record *find(const clast_world *w, const contact_record *name) {
    const record_list *r = &w->records;
    if (r->count == 0 || name->a >= w->next_id) return NULL;
    for (size_t i = r->first[name->a]; i < r->first[name->a + 1]; i++)
        if (by_name(&r->items[i], name) == 0) return &r->items[i];
    return NULL;
}

/* Puts the records back into a new list. A record without a place (its wall or body is gone) ends
 * here. */
void records_apply(clast_world *w) {
    pair_list *l = &w->list;
    for (size_t p = 0; p < l->pair_count; p++)
        for (size_t c = l->pairs[p].first; c < l->pairs[p + 1].first; c++) {
            contact_record name = record_of(w, &l->pairs[p], c);
            const contact_record *old = find(w, &name);
            if (!old) continue;
            l->candidates.histories[c] = old->history;
            l->candidates.touching[c] = 1;
        }
}

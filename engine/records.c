/* records.c - touching contacts by name (ids, place within the shape) instead of by place in
 * memory: what checkpoint, hash and readers see. */
#include <stdlib.h>

#include "engine/ranks.h"

contact_record record_of(const clast_world *w, const contact_list *l, size_t k, bool with_wall) {
    size_t a = body_of_sphere(w, (size_t)l->a[k]);
    contact_record r = {.a = w->bodies.id[a],
                        .sphere_a = l->a[k] - (int32_t)first_sphere(w, a),
                        .history = contact_history(w, l, k, with_wall)};
    if (with_wall) {
        r.b = CLAST_WALL_ID + (uint32_t)l->b[k];
        return r;
    }
    size_t b = body_of_sphere(w, (size_t)l->b[k]);
    uint32_t id = w->bodies.id[b];
    int32_t within = l->b[k] - (int32_t)first_sphere(w, b);
    if (id > r.a)
        r.b = id, r.sphere_b = within;
    else
        r.b = r.a, r.sphere_b = r.sphere_a, r.a = id, r.sphere_a = within;
    return r;
}

void records_reserve(clast_world *w, size_t count) {
    record_list *r = &w->records;
    if (count <= r->capacity) return;
    r->items = memory_grow(w, r->items, r->capacity, count, sizeof *r->items);
    r->capacity = count;
}

static size_t count_touching(const clast_world *w, int lists) {
    size_t count = 0;
    for (int t = 0; t < lists; t++) {
        const share *s = &w->shares[t];
        for (size_t k = 0; k < s->contacts.count; k++) count += contact_touches(w, &s->contacts, k);
        for (size_t k = 0; k < s->walls.count; k++) count += contact_touches(w, &s->walls, k);
    }
    return count;
}

static void collect(clast_world *w, const contact_list *l, bool with_wall) {
    for (size_t k = 0; k < l->count; k++)
        if (contact_touches(w, l, k))
            w->records.items[w->records.count++] = record_of(w, l, k, with_wall);
}

static void collect_lists(clast_world *w, int lists) {
    records_reserve(w, count_touching(w, lists));
    w->records.count = 0;
    for (int t = 0; t < lists; t++) {
        collect(w, &w->shares[t].contacts, false);
        collect(w, &w->shares[t].walls, true);
    }
}

/* Fills w->records with the contacts of own bodies that touch, in no order: those with ghosts are
 * here and there. */
void records_collect_here(clast_world *w) {
    collect_lists(w, w->lists);
}

/* Fills w->records with the contacts that touch, in no order: all of the world. */
void records_collect(clast_world *w) {
    collect_lists(w, w->threads);
    if (!w->ranks) return;
    size_t count;
    contact_record *all = ranks_gather(w, w->records.items, w->records.count, sizeof *all, &count);
    records_forget(w);
    w->records = (record_list){count, count, all};
    memory_adopt(w, count * sizeof *all);
}

int record_compare(const void *left, const void *right) {
    const contact_record *x = left, *y = right;
    if (x->a != y->a) return x->a < y->a ? -1 : 1;
    if (x->b != y->b) return x->b < y->b ? -1 : 1;
    if (x->sphere_a != y->sphere_a) return x->sphere_a < y->sphere_a ? -1 : 1;
    return (x->sphere_b > y->sphere_b) - (x->sphere_b < y->sphere_b);
}

void records_sort(clast_world *w) {
    record_list *r = &w->records;
    if (r->count > 1) qsort(r->items, r->count, sizeof *r->items, record_compare);
}

void records_forget(clast_world *w) {
    memory_return(w, w->records.capacity * sizeof *w->records.items);
    memory_release(w->records.items);
    w->records = (record_list){0};
}

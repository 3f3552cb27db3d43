/* carry.c - takes the histories of touching contacts across a rebuild: the old lists stay as they
 * are, but for their indices. Before bodies move in memory a and b become names (id and place in
 * the shape), afterwards the spheres that the names stand for now. */
#include "engine/world.h"

/* ---- names ----------------------------------------------------------------------------------- */

static uint32_t name_of(const clast_world *w, int32_t sphere) {
    size_t body = body_of_sphere(w, (size_t)sphere);
    return w->bodies.id[body] * w->name_stride + (uint32_t)((size_t)sphere - first_sphere(w, body));
}

/* The sphere of a name now, or -1. */
static int32_t sphere_of(const clast_world *w, uint32_t name) {
    int32_t slot = w->slot_of_id[name / w->name_stride];
    return slot < 0 ? -1 : (int32_t)(first_sphere(w, (size_t)slot) + name % w->name_stride);
}

static void begin(clast_world *w, int lists) {
    carry_store *c = &w->carry;
    CLAST_ASSERT(c->lists == 0);
    if (lists > c->list_capacity) {
        size_t old = (size_t)c->list_capacity, now = (size_t)lists;
        c->list = memory_grow(w, c->list, old, now, sizeof *c->list);
        c->base = memory_grow(w, c->base, old ? old + 1 : 0, now + 1, sizeof *c->base);
        c->list_capacity = lists;
    }
    c->lists = lists;
}

/* Touching contacts alone, by names. */
static void name_list(const clast_world *w, contact_list *l, bool with_wall) {
    size_t count = 0;
    for (size_t k = 0; k < l->count; k++) {
        if (!contact_touches(w, l, k)) continue;
        if (count != k) entry_move(w, l, count, k, 1);
        l->a[count] = (int32_t)name_of(w, l->a[count]);
        if (!with_wall) l->b[count] = (int32_t)name_of(w, l->b[count]);
        count++;
    }
    l->count = count;
}

/* The shares' lists become the carried ones and are empty. */
void carry_lists(clast_world *w) {
    begin(w, 2 * w->lists);
    for (int t = 0; t < w->lists; t++) {
        share *s = &w->shares[t];
        name_list(w, &s->contacts, false);
        name_list(w, &s->walls, true);
        w->carry.list[2 * t] = s->contacts, w->carry.list[2 * t + 1] = s->walls;
        s->contacts = s->walls = (contact_list){0};
    }
}

/* The records instead, which are gone afterwards. */
void carry_records(clast_world *w) {
    for (int t = 0; t < w->lists; t++)
        entry_free(w, &w->shares[t].contacts), entry_free(w, &w->shares[t].walls);
    begin(w, 2);
    w->carry.list[0] = w->carry.list[1] = (contact_list){0};
    for (size_t k = 0; k < w->records.count; k++) {
        const contact_record *r = &w->records.items[k];
        uint32_t a = r->a * w->name_stride + (uint32_t)r->sphere_a;
        bool with_wall = r->b >= CLAST_WALL_ID;
        uint32_t b =
            with_wall ? r->b - CLAST_WALL_ID : r->b * w->name_stride + (uint32_t)r->sphere_b;
        entry_push(w, &w->carry.list[with_wall], (int32_t)a, (int32_t)b, &r->history);
    }
    records_forget(w);
}

/* ---- places ---------------------------------------------------------------------------------- */

static void place_entry(clast_world *w, contact_list *l, size_t k, bool with_wall) {
    l->a[k] = sphere_of(w, (uint32_t)l->a[k]);
    if (with_wall) return;
    l->b[k] = sphere_of(w, (uint32_t)l->b[k]);
    if (l->b[k] < 0) l->a[k] = -1; /* the contact ends with a body */
    if (l->a[k] > l->b[k]) entry_turn(w, l, k);
    if (l->a[k] >= (int32_t)w->sphere_count) l->a[k] = -1; /* of two ghosts */
}

static void make_places(clast_world *w, size_t entries) {
    carry_store *c = &w->carry;
    c->entries = entries;
    c->first = memory_grow(w, NULL, 0, w->sphere_count + 2, sizeof *c->first);
    c->order = memory_grow(w, NULL, 0, entries + 1, sizeof *c->order);
}

static void drop_places(clast_world *w) {
    carry_store *c = &w->carry;
    memory_return(w, (w->sphere_count + 2 + c->entries + 1) * sizeof *c->first);
    memory_release(c->first), memory_release(c->order);
    c->first = c->order = NULL;
}

/* Names become spheres; entries are sorted by their sphere of lower index. Needs rows laid out. */
void carry_place(clast_world *w) {
    carry_store *c = &w->carry;
    size_t entries = 0;
    for (int l = 0; l < c->lists; l++) {
        c->base[l] = (uint32_t)entries;
        entries += c->list[l].count;
    }
    c->base[c->lists] = (uint32_t)entries;
    make_places(w, entries);
    for (int l = 0; l < c->lists; l++)
        for (size_t k = 0; k < c->list[l].count; k++) {
            place_entry(w, &c->list[l], k, l % 2 == 1);
            if (c->list[l].a[k] >= 0) c->first[c->list[l].a[k] + 2]++;
        }
    for (size_t i = 2; i < w->sphere_count + 2; i++) c->first[i] += c->first[i - 1];
    for (int l = 0; l < c->lists; l++)
        for (size_t k = 0; k < c->list[l].count; k++) {
            int32_t a = c->list[l].a[k];
            if (a >= 0) c->order[c->first[a + 1]++] = c->base[l] + (uint32_t)k;
        }
}

static int list_of(const carry_store *c, uint32_t entry) {
    int l = 0;
    while (entry >= c->base[l + 1]) l++;
    return l;
}

/* The k-th entry of the order: its partner, which is a wall or not. */
carried carry_at(const clast_world *w, uint32_t k) {
    const carry_store *c = &w->carry;
    uint32_t entry = c->order[k];
    int l = list_of(c, entry);
    return (carried){c->list[l].b[entry - c->base[l]], l % 2 == 1};
}

/* Entry of sphere and partner, or NOT_CARRIED. */
uint32_t carry_find(const clast_world *w, size_t sphere, int32_t partner, bool with_wall) {
    const carry_store *c = &w->carry;
    for (uint32_t k = c->first[sphere]; k < c->first[sphere + 1]; k++) {
        carried at = carry_at(w, k);
        if (at.partner == partner && at.with_wall == with_wall) return c->order[k];
    }
    return NOT_CARRIED;
}

const void *carry_number(const clast_world *w, uint32_t entry, int column) {
    int l = list_of(&w->carry, entry);
    size_t k = entry - w->carry.base[l];
    return (const char *)w->carry.list[l].column[column] + k * entry_number_size(w);
}

/* Found: histories go by entry from here on. */
void carry_drop_places(clast_world *w) {
    drop_places(w);
    for (int l = 0; l < w->carry.lists; l++) {
        contact_list *list = &w->carry.list[l];
        memory_return(w, 2 * list->capacity * sizeof *list->a);
        memory_release(list->a), memory_release(list->b);
        list->a = list->b = NULL;
    }
}

void carry_drop_column(clast_world *w, int column) {
    for (int l = 0; l < w->carry.lists; l++) {
        contact_list *list = &w->carry.list[l];
        memory_return(w, list->capacity * entry_number_size(w));
        memory_release(list->column[column]);
        list->column[column] = NULL;
    }
}

/* Needs places and all columns dropped. */
void carry_end(clast_world *w) {
    w->carry.lists = 0;
}

void carry_free(clast_world *w) {
    memory_release(w->carry.list), memory_release(w->carry.base);
}

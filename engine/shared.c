/* shared.c - which contacts share a dashpot: groups of entries of a contact list between the same
 * two bodies, or the same body and wall. Made with the list and at every refresh of it, in an order
 * of names: storage, lists and threads do not decide in which order a group is summed up. */
#include "engine/shared_lanes.h"
#include "engine/world.h"

/* Laws whose dashpots do not go with the mass of the bodies have nothing to share. */
clast_status shared_check(clast_world *w) {
    const clast_law_info *law = clast_law_info_of(w->def.law);
    if (!w->special.shared || law->shares) return CLAST_OK;
    return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT,
                                    "law %s has no dashpot that clumps could share: its "
                                    "clump_contact is each",
                                    law->name);
}

/* ---- one body -------------------------------------------------------------------------------- */

/* Spheres within their shapes, that of the body of lower id first. */
static uint64_t place_of(const clast_world *w, const contact_list *l, size_t k, bool with_wall) {
    size_t a = (size_t)l->a[k], body_a = body_of_sphere(w, a);
    uint64_t place_a = a - first_sphere(w, body_a);
    if (with_wall) return place_a << 32 | (uint32_t)l->b[k];
    size_t b = (size_t)l->b[k], body_b = body_of_sphere(w, b);
    uint64_t place_b = b - first_sphere(w, body_b);
    bool reversed = w->bodies.id[body_a] > w->bodies.id[body_b];
    return reversed ? place_b << 32 | place_a : place_a << 32 | place_b;
}

/* Facets of a smooth patch are one wall. */
static uint32_t surface_of(const clast_world *w, int32_t wall_index) {
    int smooth = w->walls[wall_index].smooth;
    return (uint32_t)(smooth >= 0 ? smooth : wall_index);
}

static group_item item_of(const clast_world *w, const contact_list *l, size_t k, bool with_wall) {
    int32_t b = l->b[k];
    uint32_t partner = with_wall ? surface_of(w, b) : (uint32_t)body_of_sphere(w, (size_t)b);
    return (group_item){
        .partner = partner, .entry = (uint32_t)k, .place = place_of(w, l, k, with_wall)};
}

static bool comes_first(const group_item *a, const group_item *b) {
    if (a->partner != b->partner) return a->partner < b->partner;
    return a->place < b->place;
}

/* Shell's: a body has a dozen contacts, seldom hundreds, and a library's may ask for memory. */
static void sort_items(group_item *item, size_t n) {
    static const size_t gaps[] = {701, 301, 132, 57, 23, 10, 4, 1};
    for (size_t g = 0; g < sizeof gaps / sizeof *gaps; g++)
        for (size_t i = gaps[g]; i < n; i++) {
            group_item now = item[i];
            size_t k = i;
            for (; k >= gaps[g] && comes_first(&now, &item[k - gaps[g]]); k -= gaps[g])
                item[k] = item[k - gaps[g]];
            item[k] = now;
        }
}

static void push_group(contact_groups *g, const group_item *item, size_t n) {
    uint32_t end = g->first[g->count];
    for (size_t k = 0; k < n; k++) g->member[end + k] = item[k].entry;
    g->first[++g->count] = end + (uint32_t)n;
}

/* Runs of at least two with one partner. */
static void push_groups(contact_groups *g, const group_item *item, size_t n) {
    for (size_t from = 0, to; from < n; from = to) {
        to = from + 1;
        while (to < n && item[to].partner == item[from].partner) to++;
        if (to - from > 1) push_group(g, item + from, to - from);
    }
}

/* ---- lists ----------------------------------------------------------------------------------- */

static void reserve_groups(clast_world *w, contact_groups *g, size_t entries) {
    g->count = 0;
    if (g->first && entries <= g->capacity) return;
    size_t now = entries + entries / 8 + 16;
    g->member = memory_grow(w, g->member, g->capacity, now, sizeof *g->member);
    /* a group has two members at least */
    g->first =
        memory_grow(w, g->first, g->first ? g->capacity / 2 + 1 : 0, now / 2 + 1, sizeof *g->first);
    g->capacity = now;
}

/* Room for the contacts of one body: to be sorted, and their batches in a pass. */
static void reserve_body(clast_world *w, share *s, size_t entries) {
    if (s->items && entries <= s->item_capacity) return;
    size_t old = s->item_capacity, now = entries + LANES;
    size_t size = sizeof(shared_batch);
    s->items = memory_grow(w, s->items, old, now, sizeof *s->items);
    s->batches = memory_lines(w, s->batches, s->batches ? (old / LANES + 1) * size : 0,
                              (now / LANES + 1) * size);
    s->item_capacity = now;
}

static void group_list(clast_world *w, share *s, bool with_wall) {
    const contact_list *l = with_wall ? &s->walls : &s->contacts;
    contact_groups *g = &s->groups[with_wall];
    reserve_groups(w, g, l->count);
    for (size_t from = 0, to; from < l->count; from = to) {
        int64_t body = owner_of(w, l, from);
        for (to = from + 1; to < l->count && owner_of(w, l, to) == body;) to++;
        reserve_body(w, s, to - from);
        for (size_t k = from; k < to; k++) s->items[k - from] = item_of(w, l, k, with_wall);
        sort_items(s->items, to - from);
        push_groups(g, s->items, to - from);
    }
}

/* Needs the lists of the share as they are passed over next. */
void shared_group(clast_world *w, share *s) {
    if (!w->special.shared) return;
    reserve_body(w, s, 1);
    group_list(w, s, false);
    group_list(w, s, true);
}

void shared_free(share *s) {
    for (int k = 0; k < 2; k++)
        memory_release(s->groups[k].first), memory_release(s->groups[k].member);
    memory_release(s->items), memory_release(s->batches);
}

/* flow.c - records of the bodies that came and went, and readers of feeds and outlets. */
#include <string.h>

#include "engine/flow.h"

void flow_free(clast_world *w) {
    flow *f = w->flow;
    if (!f) return;
    for (int i = 0; i < f->feed_count; i++) {
        feed *d = &f->feeds[i];
        memory_release((void *)d->def.name), memory_release((void *)d->def.shape);
        memory_release((void *)d->def.share), memory_release(d->below);
    }
    for (int i = 0; i < f->outlet_count; i++) memory_release((void *)f->outlets[i].def.name);
    memory_release(f->feeds), memory_release(f->outlets), memory_release(f->leaving);
    memory_release(f->arrivals.items), memory_release(f->departures.items);
    memory_release(f);
}

/* ---- records --------------------------------------------------------------------------------- */

static void make_room(clast_world *w, passage_list *l) {
    if (l->count < l->capacity) return;
    if (l->read > l->count / 2) {
        l->count -= l->read;
        memmove(l->items, l->items + l->read, l->count * sizeof *l->items);
        l->read = 0;
        return;
    }
    size_t now = 2 * l->capacity + 64;
    l->items = memory_grow(w, l->items, l->capacity, now, sizeof *l->items);
    l->capacity = now;
}

/* A body on its way in or out, with the velocity in its columns. */
void passage_note(clast_world *w, passage_list *l, size_t slot, int gate) {
    const body_store *b = &w->bodies;
    make_room(w, l);
    l->items[l->count++] = (clast_passage){.id = b->id[slot],
                                           .shape = b->shape[slot],
                                           .gate = gate,
                                           .step = w->step,
                                           .time = clast_world_time(w),
                                           .mass = w->shapes[b->shape[slot]].mass,
                                           .position = body_position(w, slot),
                                           .velocity = {b->vx[slot], b->vy[slot], b->vz[slot]}};
}

/* The list takes the records over. */
void passages_install(clast_world *w, passage_list *l, size_t count, clast_passage *items) {
    memory_return(w, l->capacity * sizeof *l->items), memory_release(l->items);
    *l = (passage_list){.count = count, .capacity = count, .items = items};
    memory_adopt(w, count * sizeof *items);
}

static size_t read_passages(passage_list *l, clast_passage *to, size_t room) {
    size_t left = l->count - l->read, n = left < room ? left : room;
    if (n == 0) return left;
    memcpy(to, l->items + l->read, n * sizeof *to);
    l->read += n;
    if (l->read == l->count) l->read = l->count = 0;
    return n;
}

size_t clast_world_arrivals(clast_world *w, clast_passage *to, size_t room) {
    CLAST_ASSERT(w && (to || room == 0));
    return read_passages(&w->flow->arrivals, to, room);
}

size_t clast_world_departures(clast_world *w, clast_passage *to, size_t room) {
    CLAST_ASSERT(w && (to || room == 0));
    return read_passages(&w->flow->departures, to, room);
}

/* ---- names and sums -------------------------------------------------------------------------- */

int clast_world_feed_count(const clast_world *w) {
    return w->flow->feed_count;
}
int clast_world_outlet_count(const clast_world *w) {
    return w->flow->outlet_count;
}

clast_feed_def clast_world_feed(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->flow->feed_count);
    return w->flow->feeds[i].def;
}

clast_outlet_def clast_world_outlet(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= 0 && i < w->flow->outlet_count);
    return w->flow->outlets[i].def;
}

clast_flow clast_world_outlet_flow(const clast_world *w, int i) {
    CLAST_ASSERT(w && i >= CLAST_OUTLET_DOMAIN && i < w->flow->outlet_count);
    const outlet_state *s =
        i == CLAST_OUTLET_DOMAIN ? &w->flow->domain : &w->flow->outlets[i].state;
    return (clast_flow){.bodies = s->bodies, .mass = s->mass};
}

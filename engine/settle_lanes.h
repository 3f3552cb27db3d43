/* settle_lanes.h - what the lanes of a batch of walls could not tell, asked of facets.c: several
 * walls of a family that one sphere touches at once, one that is uneven, or a facet at which a
 * contact has ended while it may go on at another. So the walls of a sphere stand in one batch or,
 * where they are too many for it, all of them are settled ahead. */
#ifndef CLAST_SETTLE_LANES_H
#define CLAST_SETTLE_LANES_H

#include "engine/facets.h"
#include "engine/geometry.h"
#include "engine/wall_lanes.h"

typedef struct settling {
    const clast_world *w;
    const contact_list *list;
    wall_touch *touch; /* scratch */
    bool advance;      /* histories go along */
} settling;

/* Lanes from .. to - 1, those of one sphere. */
static inline bool needs_settling(const settling *s, const batch *b, const wall_batch *l,
                                  size_t begin, int from, int to) {
    const real *was = (const real *)s->list->column[0] + begin;
    int touched = 0, ended = 0, uneven = 0;
    for (int i = from; i < to; i++) {
        bool touches = b->overlap[i] > 0, of_family = l->v[3][i] > -WALL_ENDLESS; /* its rim */
        touched += touches && of_family;
        ended += was[i] > 0 && !touches;
        if (l->look[i] != 0 && touches)
            uneven += wall_is_uneven(&s->w->walls[s->list->b[begin + (size_t)i]]);
    }
    return touched > 1 || uneven > 0 || (touched > 0 && ended > 0);
}

/* The lanes know rectangles, and theirs are the numbers that count, however many walls there are:
 * the last bits of an edge are others in facets.c. */
static inline void take_touches(const settling *s, const wall_touch *touch, batch *b, int from,
                                int to) {
    for (int i = from; i < to; i++) {
        const wall_touch *t = &touch[i - from];
        if (t->hidden) b->overlap[i] = 0;
        if (!wall_is_uneven(t->wall)) continue;
        vec3 n = to_kernel(s->w, t->normal);
        b->n[0][i] = n.x, b->n[1][i] = n.y, b->n[2][i] = n.z;
        b->overlap[i] = t->hidden ? 0 : t->overlap;
    }
}

/* One wall alone, as most are, hides nothing and hands nothing over. */
static inline bool is_clear_case(const settling *s, const batch *b, const int32_t *sphere, int i,
                                 int count, size_t begin) {
    bool company =
        (i > 0 && sphere[i - 1] == sphere[i]) || (i + 1 < count && sphere[i + 1] == sphere[i]);
    return !company &&
           !(b->overlap[i] > 0 && wall_is_uneven(&s->w->walls[s->list->b[begin + (size_t)i]]));
}

static inline void settle_walls(const settling *s, batch *b, const wall_batch *l, size_t begin,
                                int count) {
    const int32_t *sphere = s->list->a + begin;
    for (int i = 0; i < count; i++) {
        if (l->look[i] == 0 || is_clear_case(s, b, sphere, i, count, begin)) continue;
        int from = i, to = i + 1;
        while (from > 0 && sphere[from - 1] == sphere[i]) from--;
        while (to < count && sphere[to] == sphere[i]) to++;
        i = to - 1;
        if (!needs_settling(s, b, l, begin, from, to)) continue;
        facets_settle(s->w, s->list, begin + (size_t)from, begin + (size_t)to, s->advance,
                      s->touch);
        take_touches(s, s->touch, b, from, to);
    }
}

/* All spheres of entries that no batch holds: their touches stay until the last is taken. */
static __attribute__((noinline)) void settle_ahead(const settling *s, size_t begin, size_t end) {
    for (size_t from = begin, to; from < end; from = to) {
        to = facets_run_end(s->list, from);
        facets_settle(s->w, s->list, from, to, s->advance, s->touch + (from - begin));
    }
}

/* The last end of a sphere within a batch, or beyond it where one sphere fills more than that. */
static inline size_t sphere_block_end(const contact_list *l, size_t begin) {
    if (l->count - begin <= LANES) return l->count;
    size_t end = begin + LANES;
    while (end > begin && l->a[end - 1] == l->a[end]) end--;
    return end > begin ? end : facets_run_end(l, begin);
}

#endif

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

/* What `look` says of lanes that may be on a fillet, which the lanes do not know. */
enum { LOOK_AT_FILLET = 2 };

/* All that facets.c finds on one are among these, whatever they round. Fillets are within their
 * facet, to what single precision leaves of its sides. */
static inline bool may_be_on_fillet(const settling *s, const batch *b, const wall_batch *l, int i,
                                    size_t begin) {
    double radius = b->ra[i];
    if (!(l->v[3][i] > WALL_ENDLESS && b->overlap[i] > -FILLET_RAISE * radius)) return false;
    const wall *met = &s->w->walls[s->list->b[begin + (size_t)i]];
    if (!met->is_rectangle) return true;
    double cap = met->fillets.cap * radius, width = met->fillets.width, u = 0, v = 0;
    double half_u = l->n[3][i], half_v = l->u[3][i];
    double rim = 1.000001 * (width < cap ? width : cap) + wall_rim(met), over = 0.1 * width;
    for (int k = 0; k < 3; k++) u += b->d[k][i] * l->u[k][i], v += b->d[k][i] * l->v[k][i];
    u = fabs(u), v = fabs(v);
    return (u > half_u - rim || v > half_v - rim) && u < half_u + over && v < half_v + over;
}

static inline void look_for_fillets(const settling *s, const batch *b, wall_batch *l, size_t begin,
                                    int count) {
    for (int i = 0; i < count; i++)
        if (may_be_on_fillet(s, b, l, i, begin)) l->look[i] = LOOK_AT_FILLET;
}

typedef enum settling_need { SETTLE_NONE, SETTLE_FILLET, SETTLE_ALL } settling_need;

/* Lanes from .. to - 1, those of one sphere. What may be on a fillet may touch or not. */
static inline settling_need need_of(const settling *s, const batch *b, const wall_batch *l,
                                    size_t begin, int from, int to) {
    const real *was = (const real *)s->list->column[0] + begin;
    int touched = 0, ended = 0, uneven = 0, fillets = 0;
    for (int i = from; i < to; i++) {
        bool touches = b->overlap[i] > 0, of_family = l->v[3][i] > -WALL_ENDLESS; /* its rim */
        if (l->look[i] != 0 && (touches || l->look[i] == LOOK_AT_FILLET))
            uneven += wall_is_uneven(&s->w->walls[s->list->b[begin + (size_t)i]]);
        if (l->look[i] == LOOK_AT_FILLET) {
            fillets++;
            continue;
        }
        touched += touches && of_family;
        ended += was[i] > 0 && !touches;
    }
    if (uneven > 0 || touched + fillets > 1 || (touched + fillets > 0 && ended > 0))
        return SETTLE_ALL;
    return fillets > 0 ? SETTLE_FILLET : SETTLE_NONE;
}

/* The lanes know rectangles, and theirs are the numbers that count, however many walls there are:
 * the last bits of an edge are others in facets.c. */
static inline void take_touches(const settling *s, const wall_touch *touch, batch *b, int from,
                                int to) {
    for (int i = from; i < to; i++) {
        const wall_touch *t = &touch[i - from];
        if (t->hidden) b->overlap[i] = 0;
        if (!wall_is_uneven(t->wall) && !t->raised) continue;
        vec3 n = to_kernel(s->w, t->normal);
        b->n[0][i] = n.x, b->n[1][i] = n.y, b->n[2][i] = n.z;
        b->overlap[i] = t->hidden ? 0 : t->overlap;
    }
}

/* One wall alone, as most are, hides nothing and hands nothing over. */
static inline bool is_clear_case(const settling *s, const batch *b, const wall_batch *l,
                                 const int32_t *sphere, int i, int count, size_t begin) {
    bool company =
        (i > 0 && sphere[i - 1] == sphere[i]) || (i + 1 < count && sphere[i + 1] == sphere[i]);
    return !company && l->look[i] != LOOK_AT_FILLET &&
           !(b->overlap[i] > 0 && wall_is_uneven(&s->w->walls[s->list->b[begin + (size_t)i]]));
}

/* One wall that may be touched on a fillet, and nothing else that matters. */
static inline void settle_fillet(const settling *s, batch *b, const wall_batch *l, size_t begin,
                                 int from, int to) {
    int i = from;
    while (i + 1 < to && l->look[i] != LOOK_AT_FILLET) i++;
    fillet_touch touch;
    if (!facets_fillet(s->w, s->list, begin + (size_t)i, &touch)) return;
    vec3 n = to_kernel(s->w, touch.normal);
    b->n[0][i] = n.x, b->n[1][i] = n.y, b->n[2][i] = n.z;
    b->overlap[i] = touch.overlap;
}

static inline void settle_walls(const settling *s, batch *b, wall_batch *l, size_t begin,
                                int count) {
    const int32_t *sphere = s->list->a + begin;
    if (s->w->special.fillets) look_for_fillets(s, b, l, begin, count);
    for (int i = 0; i < count; i++) {
        if (l->look[i] == 0 || is_clear_case(s, b, l, sphere, i, count, begin)) continue;
        int from = i, to = i + 1;
        while (from > 0 && sphere[from - 1] == sphere[i]) from--;
        while (to < count && sphere[to] == sphere[i]) to++;
        i = to - 1;
        settling_need need = need_of(s, b, l, begin, from, to);
        if (need == SETTLE_FILLET) settle_fillet(s, b, l, begin, from, to);
        if (need != SETTLE_ALL) continue;
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

/* cells.h - which cell of the grid a place is in. */
#ifndef CLAST_CELLS_H
#define CLAST_CELLS_H

#include "engine/world.h"

typedef struct cell_place {
    int i, j, k;
} cell_place;

/* What is outside the grid counts into the cells at its edge, what is no number into the first:
 * two places within a cell's width of each other stay in the same or neighbouring cells. */
static inline int cell_along(const cell_axis *c, double at) {
    double n = (at - c->low) / c->size;
    return n > 0 ? n < c->count ? (int)n : c->count - 1 : 0;
}

static inline cell_place cell_at(const cell_grid *g, double x, double y, double z) {
    return (cell_place){cell_along(&g->x, x), cell_along(&g->y, y), cell_along(&g->z, z)};
}

/* Layers across a periodic z stand in the order 0, n - 1, 1, n - 2, ...: neighbours are two layers
 * apart in storage at most, also across the face, so that the contacts of a share load few bodies
 * of other shares. */
static inline int layer_of(const cell_axis *z, int k) {
    if (!z->round) return k;
    return 2 * k < z->count ? 2 * k : 2 * (z->count - 1 - k) + 1;
}

/* The row of cells along x that holds the first one of (j, k). */
static inline size_t row_of_cells(const cell_grid *g, int j, int k) {
    return ((size_t)layer_of(&g->z, k) * (size_t)g->y.count + (size_t)j) * (size_t)g->x.count;
}

/* Cells first .. last. */
typedef struct cell_span {
    int first, last;
} cell_span;

/* The cells from .. to as they are in the grid, each once: none or one span, or two across a
 * periodic face. Needs from in -count .. 2 count - 1. */
static inline int cells_between(const cell_axis *c, int from, int to, cell_span out[2]) {
    int last = c->count - 1;
    if (!c->round) {
        out[0] = (cell_span){from > 0 ? from : 0, to < last ? to : last};
        return out[0].first <= out[0].last;
    }
    if (to - from >= last) return out[0] = (cell_span){0, last}, 1;
    int shift = from < 0 ? c->count : from > last ? -c->count : 0;
    from += shift, to += shift;
    if (to <= last) return out[0] = (cell_span){from, to}, 1;
    out[0] = (cell_span){0, to - c->count}, out[1] = (cell_span){from, last};
    return 2;
}

/* A cell and those next to it, each once: three at most. */
static inline int cells_next_to(const cell_axis *c, int at, int out[3]) {
    cell_span span[2];
    int spans = cells_between(c, at - 1, at + 1, span), count = 0;
    for (int s = 0; s < spans; s++)
        for (int i = span[s].first; i <= span[s].last; i++) out[count++] = i;
    return count;
}

#endif

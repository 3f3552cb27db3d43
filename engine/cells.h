/* cells.h - which cell of the grid a place is in. */
#ifndef CLAST_CELLS_H
#define CLAST_CELLS_H

#include "engine/world.h"

typedef struct cell_place {
    int i, j, k;
} cell_place;

/* What is outside the grid counts into the cells at its edge, what is no number into the first:
 * two places within a cell's width of each other stay in the same or neighbouring cells. */
static inline int cell_along(double at, double low, double size, int cells) {
    double n = (at - low) / size;
    return n > 0 ? n < cells ? (int)n : cells - 1 : 0;
}

static inline cell_place cell_at(const cell_grid *g, double x, double y, double z) {
    return (cell_place){cell_along(x, g->low.x, g->size, g->nx),
                        cell_along(y, g->low.y, g->size, g->ny),
                        cell_along(z, g->low.z, g->size, g->nz)};
}

#endif

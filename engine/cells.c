/* cells.c - sorts bodies by the cell they are in. The order of storage is never observable. */
#include <string.h>

#include "engine/cells.h"

/* Where the bodies are along an axis, within the domain: a run that has blown up under
 * `guards = report` asks for no grid without end. What is no number is nowhere. */
typedef struct span {
    double low, high;
} span;

static span span_of(const double *x, size_t count, double low, double high) {
    span s = {high, low};
    for (size_t i = 0; i < count; i++) {
        double at = x[i] < low ? low : x[i] > high ? high : x[i];
        s.low = at < s.low ? at : s.low;
        s.high = at > s.high ? at : s.high;
    }
    return s;
}

static int cells_along(span s, double size) {
    double n = floor((s.high - s.low) / size) + 1;
    return n > 2048 ? 2048 : n > 1 ? (int)n : 1; /* one, too, when there is nothing to span */
}

/* Cells at least `reach` wide, and no more of them than a few per body. */
static cell_grid cells_grid(const clast_world *w, double reach) {
    const body_store *b = &w->bodies;
    vec3 from = w->def.domain_min, to = w->def.domain_max;
    span x = span_of(b->x, b->count, from.x, to.x), y = span_of(b->y, b->count, from.y, to.y),
         z = span_of(b->z, b->count, from.z, to.z);
    cell_grid g = {.low = v3(x.low, y.low, z.low), .size = reach};
    for (;; g.size *= 1.25) {
        g.nx = cells_along(x, g.size);
        g.ny = cells_along(y, g.size);
        g.nz = cells_along(z, g.size);
        size_t cells = (size_t)g.nx * (size_t)g.ny * (size_t)g.nz;
        bool wide = g.nx < 2048 && g.ny < 2048 && g.nz < 2048;
        if (wide && cells <= 4 * b->count + 64) return g;
    }
}

static uint32_t cell_of(const cell_grid *g, double x, double y, double z) {
    cell_place p = cell_at(g, x, y, z);
    return ((uint32_t)p.k * (uint32_t)g->ny + (uint32_t)p.j) * (uint32_t)g->nx + (uint32_t)p.i;
}

static void reserve(clast_world *w, size_t cells) {
    if (w->cells.cell_capacity >= cells + 1) return;
    w->cells.cell_first =
        memory_grow(w, w->cells.cell_first, w->cells.cell_capacity, cells + 1, sizeof(uint32_t));
    w->cells.cell_capacity = cells + 1;
}

/* Counting sort of the bodies by cell; afterwards cell c holds slots cell_first[c] ..
 * cell_first[c+1]. */
void cells_sort(clast_world *w, double reach) {
    body_store *b = &w->bodies;
    cell_grid g = cells_grid(w, reach);
    size_t cells = (size_t)g.nx * (size_t)g.ny * (size_t)g.nz;
    reserve(w, cells);
    size_t scratch = 2 * b->count * sizeof(uint32_t);
    uint32_t *first = w->cells.cell_first, *cell = memory_grow(w, NULL, 0, scratch, 1);
    uint32_t *order = cell + b->count;
    memset(first, 0, (cells + 1) * sizeof *first);
    for (size_t i = 0; i < b->count; i++) {
        cell[i] = cell_of(&g, b->x[i], b->y[i], b->z[i]);
        first[cell[i] + 1]++;
    }
    for (size_t c = 0; c < cells; c++) first[c + 1] += first[c];
    for (size_t i = 0; i < b->count; i++) order[first[cell[i]]++] = (uint32_t)i;
    for (size_t c = cells; c > 0; c--) first[c] = first[c - 1];
    first[0] = 0;
    body_permute(w, order);
    memory_release(cell), memory_return(w, scratch);
    w->cells.grid = g;
}

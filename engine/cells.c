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

/* Of at least that size; a periodic axis has cells over its whole length, and no rest. */
static cell_axis axis_of(span s, double size, double length) {
    if (length == 0) return (cell_axis){s.low, size, cells_along(s, size), false};
    double n = floor(length / size);
    int count = n > 2048 ? 2048 : n > 1 ? (int)n : 1;
    return (cell_axis){s.low, length / count, count, true};
}

static span span_along(const clast_world *w, const double *x, int axis) {
    double low = v3_at(w->def.domain_min, axis), high = v3_at(w->def.domain_max, axis);
    if (w->period.length[axis] > 0) return (span){low, high};
    return span_of(x, w->bodies.count, low, high);
}

/* Cells at least `reach` wide, and no more of them than a few per body. */
static cell_grid cells_grid(const clast_world *w, double reach) {
    const body_store *b = &w->bodies;
    const double *length = w->period.length;
    span x = span_along(w, b->x, 0), y = span_along(w, b->y, 1), z = span_along(w, b->z, 2);
    for (double size = reach;; size *= 1.25) {
        cell_grid g = {axis_of(x, size, length[0]), axis_of(y, size, length[1]),
                       axis_of(z, size, length[2])};
        size_t cells = (size_t)g.x.count * (size_t)g.y.count * (size_t)g.z.count;
        bool wide = g.x.count < 2048 && g.y.count < 2048 && g.z.count < 2048;
        if (wide && cells <= 4 * b->count + 64) return g;
    }
}

static uint32_t cell_of(const cell_grid *g, double x, double y, double z) {
    cell_place p = cell_at(g, x, y, z);
    return (uint32_t)(row_of_cells(g, p.j, p.k) + (size_t)p.i);
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
    size_t cells = (size_t)g.x.count * (size_t)g.y.count * (size_t)g.z.count;
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

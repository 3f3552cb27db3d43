/* cells.c - sorts bodies by the cell they are in. The order of storage is never observable. */
#include <string.h>

#include "engine/world.h"

static void bounds_of(const body_store *b, vec3 *low, vec3 *high) {
    *low = *high = v3(b->x[0], b->y[0], b->z[0]);
    for (size_t i = 1; i < b->count; i++) {
        low->x = b->x[i] < low->x ? b->x[i] : low->x,
        high->x = b->x[i] > high->x ? b->x[i] : high->x;
        low->y = b->y[i] < low->y ? b->y[i] : low->y,
        high->y = b->y[i] > high->y ? b->y[i] : high->y;
        low->z = b->z[i] < low->z ? b->z[i] : low->z,
        high->z = b->z[i] > high->z ? b->z[i] : high->z;
    }
}

static int cells_along(double length, double size) {
    double n = floor(length / size) + 1;
    return n > 2048 ? 2048 : (int)n;
}

/* Cells at least `reach` wide, and no more of them than a few per body. */
static cell_grid cells_grid(const clast_world *w, double reach) {
    cell_grid g = {.size = reach};
    vec3 high;
    bounds_of(&w->bodies, &g.low, &high);
    vec3 extent = v3_sub(high, g.low);
    for (;; g.size *= 1.25) {
        g.nx = cells_along(extent.x, g.size);
        g.ny = cells_along(extent.y, g.size);
        g.nz = cells_along(extent.z, g.size);
        size_t cells = (size_t)g.nx * (size_t)g.ny * (size_t)g.nz;
        bool wide = g.nx < 2048 && g.ny < 2048 && g.nz < 2048;
        if (wide && cells <= 4 * w->bodies.count + 64) return g;
    }
}

static uint32_t cell_of(const cell_grid *g, double x, double y, double z) {
    int i = (int)((x - g->low.x) / g->size), j = (int)((y - g->low.y) / g->size),
        k = (int)((z - g->low.z) / g->size);
    return ((uint32_t)k * (uint32_t)g->ny + (uint32_t)j) * (uint32_t)g->nx + (uint32_t)i;
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

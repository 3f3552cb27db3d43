/* Vertices kept so far lie in a hashed grid; each new one asks the cells within reach for the
 * lowest kept vertex that is near. A sort along one axis would be shorter, and quadratic for a flat
 * wall. */
#include "meshes/status.h"
#include "meshes/work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct grid {
    const double *vertex; /* the kept ones, from 0 on */
    const double *low;
    double reach, side; /* m */
    size_t mask;
    int32_t *head, *next; /* chains of kept vertices; -1 ends */
} grid;

static size_t bucket(const grid *g, const int64_t cell[3]) {
    uint64_t h = 0;
    for (int k = 0; k < 3; k++) {
        h = (h ^ (uint64_t)cell[k]) * 0x9e3779b97f4a7c15u;
        h ^= h >> 32;
    }
    return (size_t)h & g->mask;
}

static int64_t cell_of(const grid *g, double x, int k) {
    return (int64_t)floor((x - g->low[k]) / g->side);
}

static double distance(const double *a, const double *b) {
    double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
    return sqrt(x * x + y * y + z * z);
}

static int32_t nearest_first(const grid *g, const int64_t cell[3], const double *p, int32_t best) {
    for (int32_t v = g->head[bucket(g, cell)]; v >= 0; v = g->next[v])
        if ((best < 0 || v < best) && distance(g->vertex + 3 * (size_t)v, p) <= g->reach) best = v;
    return best;
}

/* The lowest kept vertex within reach of p, or -1. */
static int32_t find(const grid *g, const double *p) {
    int64_t from[3], to[3], cell[3];
    for (int k = 0; k < 3; k++) {
        from[k] = cell_of(g, p[k] - g->reach, k);
        to[k] = cell_of(g, p[k] + g->reach, k);
    }
    int32_t best = -1;
    for (cell[0] = from[0]; cell[0] <= to[0]; cell[0]++)
        for (cell[1] = from[1]; cell[1] <= to[1]; cell[1]++)
            for (cell[2] = from[2]; cell[2] <= to[2]; cell[2]++)
                best = nearest_first(g, cell, p, best);
    return best;
}

static void keep(grid *g, int32_t vertex) {
    int64_t cell[3];
    for (int k = 0; k < 3; k++) cell[k] = cell_of(g, g->vertex[3 * (size_t)vertex + (size_t)k], k);
    size_t b = bucket(g, cell);
    g->next[vertex] = g->head[b];
    g->head[b] = vertex;
}

static void join(mesh_report *r, double apart) {
    r->joined++;
    if (apart > 0) r->moved++;
    if (apart > r->farthest_move) r->farthest_move = apart;
}

/* Kept vertices move to the front; map[old] = new. */
static size_t weld_all(mesh_work *w, grid *g, int32_t *map) {
    int32_t kept = 0;
    for (size_t v = 0; v < w->vertex_count; v++) {
        const double *p = w->vertex + 3 * v;
        if (map[v] < 0) continue;
        int32_t first = find(g, p);
        map[v] = first >= 0 ? first : kept;
        if (first >= 0) {
            join(w->report, distance(p, w->vertex + 3 * (size_t)first));
            continue;
        }
        memmove(w->vertex + 3 * (size_t)kept, p, 3 * sizeof *p);
        keep(g, kept++);
    }
    return (size_t)kept;
}

/* A vertex in no triangle may be anywhere, even nowhere: it joins nobody. */
static void mark_used(const mesh_work *w, int32_t *map) {
    for (size_t v = 0; v < w->vertex_count; v++) map[v] = -1;
    for (size_t at = 0; at < 3 * w->count; at++) map[w->corner[at]] = 0;
    for (size_t v = 0; v < w->vertex_count; v++) w->report->unused += map[v] < 0;
}

mesh_status mesh_weld(mesh_work *w) {
    double reach = w->report->weld_distance;
    grid g = {.vertex = w->vertex, .low = w->report->low, .reach = reach, .mask = 1};
    g.side = reach > 0 ? 8 * reach : 1;
    while (g.mask < w->vertex_count) g.mask = 2 * g.mask + 1;
    g.head = mesh_array(g.mask + 1, sizeof *g.head);
    g.next = mesh_array(w->vertex_count, sizeof *g.next);
    int32_t *map = mesh_array(w->vertex_count, sizeof *map);
    bool ready = g.head && g.next && map;
    if (ready) {
        for (size_t b = 0; b <= g.mask; b++) g.head[b] = -1;
        mark_used(w, map);
        w->vertex_count = weld_all(w, &g, map);
        for (size_t at = 0; at < 3 * w->count; at++) w->corner[at] = map[w->corner[at]];
    }
    free(g.head);
    free(g.next);
    free(map);
    return ready ? MESH_OK : MESH_ERR_MEMORY;
}

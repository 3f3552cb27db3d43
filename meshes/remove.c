#include "meshes/status.h"
#include "meshes/work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

void mesh_note(mesh_finding *finding, int32_t source) {
    size_t triangle = (size_t)source + 1;
    if (finding->count == 0 || triangle < finding->first) finding->first = triangle;
    finding->count++;
}

static double longest_edge(const mesh_work *w, size_t t) {
    double longest = 0;
    for (int k = 0; k < 3; k++) {
        const double *a = w->vertex + 3 * (size_t)w->corner[3 * t + (size_t)k];
        const double *b = w->vertex + 3 * (size_t)w->corner[3 * t + (size_t)(k + 1) % 3];
        double x = a[0] - b[0], y = a[1] - b[1], z = a[2] - b[2];
        longest = fmax(longest, x * x + y * y + z * z);
    }
    return sqrt(longest);
}

static bool is_sliver(const mesh_work *w, size_t t) {
    double n[3];
    mesh_normal(w, t, n);
    double twice_area = sqrt(n[0] * n[0] + n[1] * n[1] + n[2] * n[2]);
    return twice_area <= w->report->weld_distance * longest_edge(w, t);
}

/* Moves the triangles that are not marked to the front. */
static void drop_marked(mesh_work *w, const bool *marked) {
    size_t kept = 0;
    for (size_t t = 0; t < w->count; t++) {
        if (marked[t]) continue;
        memmove(w->corner + 3 * kept, w->corner + 3 * t, 3 * sizeof *w->corner);
        w->source[kept++] = w->source[t];
    }
    w->count = kept;
}

static void mark_flat(mesh_work *w, bool *marked) {
    for (size_t t = 0; t < w->count; t++) {
        const int32_t *c = w->corner + 3 * t;
        bool collapsed = c[0] == c[1] || c[1] == c[2] || c[2] == c[0];
        bool sliver = !collapsed && is_sliver(w, t);
        if (collapsed) mesh_note(&w->report->collapsed, w->source[t]);
        if (sliver) mesh_note(&w->report->slivers, w->source[t]);
        marked[t] = collapsed || sliver;
    }
}

typedef struct key {
    int32_t low, middle, high, triangle;
} key;

static int compare(const void *left, const void *right) {
    const int32_t *a = left, *b = right;
    for (int k = 0; k < 4; k++)
        if (a[k] != b[k]) return a[k] < b[k] ? -1 : 1;
    return 0;
}

static key key_of(const mesh_work *w, size_t t) {
    const int32_t *c = w->corner + 3 * t;
    int32_t low = c[0] < c[1] ? c[0] : c[1], high = c[0] < c[1] ? c[1] : c[0];
    if (c[2] < low) low = c[2];
    if (c[2] > high) high = c[2];
    int32_t middle = (int32_t)((int64_t)c[0] + c[1] + c[2] - low - high);
    return (key){low, middle, high, (int32_t)t};
}

static void mark_duplicates(mesh_work *w, key *keys, bool *marked) {
    for (size_t t = 0; t < w->count; t++) keys[t] = key_of(w, t);
    qsort(keys, w->count, sizeof *keys, compare);
    memset(marked, 0, w->count * sizeof *marked);
    for (size_t i = 1; i < w->count; i++) {
        const key *a = &keys[i - 1], *b = &keys[i];
        if (a->low != b->low || a->middle != b->middle || a->high != b->high) continue;
        marked[b->triangle] = true;
        mesh_note(&w->report->duplicates, w->source[b->triangle]);
    }
}

mesh_status mesh_remove(mesh_work *w) {
    bool *marked = mesh_array(w->count, sizeof *marked);
    key *keys = mesh_array(w->count, sizeof *keys);
    bool ready = marked && keys;
    if (ready) {
        mark_flat(w, marked);
        drop_marked(w, marked);
        mark_duplicates(w, keys, marked);
        drop_marked(w, marked);
    }
    free(marked);
    free(keys);
    return ready ? MESH_OK : MESH_ERR_MEMORY;
}

mesh_status mesh_drop_unused(mesh_work *w) {
    int32_t *map = mesh_array(w->vertex_count, sizeof *map);
    if (!map) return MESH_ERR_MEMORY;
    for (size_t at = 0; at < 3 * w->count; at++) map[w->corner[at]] = 1;
    size_t kept = 0;
    for (size_t v = 0; v < w->vertex_count; v++) {
        if (map[v] == 0) continue;
        memmove(w->vertex + 3 * kept, w->vertex + 3 * v, 3 * sizeof *w->vertex);
        map[v] = (int32_t)kept++;
    }
    w->report->unused += w->vertex_count - kept;
    w->vertex_count = kept;
    for (size_t at = 0; at < 3 * w->count; at++) w->corner[at] = map[w->corner[at]];
    free(map);
    return MESH_OK;
}

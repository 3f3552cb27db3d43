#include "meshes/status.h"
#include "meshes/work.h"

#include <stdlib.h>

/* A side is 3 * triangle + k: from corner k to the next. */
enum { OPEN = -1, BRANCHING = -2 };

typedef struct side {
    int32_t low, high, at; /* the two vertices, the side */
} side;

typedef struct edges {
    mesh_work *w;
    side *sides;
    int32_t *partner; /* the side across the edge, OPEN or BRANCHING */
    int32_t *queue;   /* triangles of the piece at hand */
    int8_t *turned;   /* -1 not seen, 0, 1 */
} edges;

static int32_t start(const mesh_work *w, int32_t at) {
    return w->corner[at];
}
static int32_t end(const mesh_work *w, int32_t at) {
    return w->corner[at % 3 == 2 ? at - 2 : at + 1];
}

static int compare(const void *left, const void *right) {
    const side *a = left, *b = right;
    if (a->low != b->low) return a->low < b->low ? -1 : 1;
    if (a->high != b->high) return a->high < b->high ? -1 : 1;
    return a->at < b->at ? -1 : a->at > b->at;
}

/* All sides, those of one edge next to each other. */
static void sort_sides(const mesh_work *w, side *sides) {
    size_t count = 3 * w->count;
    for (size_t i = 0; i < count; i++) {
        int32_t a = start(w, (int32_t)i), b = end(w, (int32_t)i);
        sides[i] = (side){a < b ? a : b, a < b ? b : a, (int32_t)i};
    }
    qsort(sides, count, sizeof *sides, compare);
}

/* Past the last side of the edge that begins at `from`. */
static size_t end_of_run(const side *sides, size_t from, size_t count) {
    size_t to = from + 1;
    while (to < count && sides[to].low == sides[from].low && sides[to].high == sides[from].high)
        to++;
    return to;
}

static void link_run(edges *e, const side *run, size_t length) {
    mesh_report *r = e->w->report;
    int32_t source = e->w->source[run->at / 3];
    if (length == 2) {
        e->partner[run[0].at] = run[1].at;
        e->partner[run[1].at] = run[0].at;
        return;
    }
    mesh_note(length == 1 ? &r->open_edges : &r->branching_edges, source);
    for (size_t i = 0; i < length; i++) e->partner[run[i].at] = length == 1 ? OPEN : BRANCHING;
}

static void link_sides(edges *e) {
    size_t count = 3 * e->w->count;
    sort_sides(e->w, e->sides);
    for (size_t i = 0, next; i < count; i = next) {
        next = end_of_run(e->sides, i, count);
        link_run(e, e->sides + i, next - i);
    }
}

/* What is known of one connected piece. */
typedef struct piece {
    size_t size, turned;
    bool closed;
} piece;

/* Neighbours agree when they run along their edge in opposite directions. */
static void visit_side(edges *e, int32_t at, piece *p) {
    int32_t partner = e->partner[at], t = at / 3, next = partner / 3;
    if (partner < 0) {
        p->closed = false;
        return;
    }
    int8_t want = (int8_t)(e->turned[t] ^ (start(e->w, at) == start(e->w, partner)));
    if (e->turned[next] < 0) {
        e->turned[next] = want;
        e->queue[p->size++] = next;
    } else if (e->turned[next] != want) {
        p->closed = false;
        if (at < partner) mesh_note(&e->w->report->twisted_edges, e->w->source[t]);
    }
}

static piece collect_piece(edges *e, int32_t seed) {
    piece p = {.size = 1, .closed = true};
    e->queue[0] = seed;
    e->turned[seed] = 0;
    for (size_t i = 0; i < p.size; i++) {
        for (int32_t k = 0; k < 3; k++) visit_side(e, 3 * e->queue[i] + k, &p);
        p.turned += e->turned[e->queue[i]] == 1;
    }
    return p;
}

/* Six times the volume when all marked triangles are turned. */
static double piece_volume(const edges *e, const piece *p) {
    double sum = 0;
    const double *origin = e->w->vertex + 3 * (size_t)e->w->corner[3 * e->queue[0]];
    for (size_t i = 0; i < p->size; i++) {
        size_t t = (size_t)e->queue[i];
        double volume = mesh_six_volumes(e->w, t, origin);
        sum += e->turned[t] == 1 ? -volume : volume;
    }
    return sum;
}

/* The majority is right; in a tie, outwards where there is an outside. */
static void settle_piece(edges *e, piece *p) {
    double volume = p->closed ? piece_volume(e, p) : 0;
    bool tie = 2 * p->turned == p->size;
    if (2 * p->turned > p->size || (tie && volume < 0)) {
        for (size_t i = 0; i < p->size; i++) e->turned[e->queue[i]] ^= 1;
        volume = -volume;
    }
    if (volume < 0) e->w->report->inward++;
    e->w->report->pieces++;
}

static void check_winding(edges *e, bool mend) {
    mesh_work *w = e->w;
    for (size_t t = 0; t < w->count; t++) e->turned[t] = -1;
    for (size_t t = 0; t < w->count; t++) {
        if (e->turned[t] >= 0) continue;
        piece p = collect_piece(e, (int32_t)t);
        settle_piece(e, &p);
    }
    for (size_t t = 0; t < w->count; t++) {
        if (e->turned[t] != 1) continue;
        mesh_note(&w->report->flipped, w->source[t]);
        if (mend) mesh_turn(w->corner + 3 * t);
    }
    mesh_report *r = w->report;
    r->mended = mend && r->flipped.count > 0;
    r->closed = r->open_edges.count == 0 && r->branching_edges.count == 0 &&
                r->twisted_edges.count == 0 && (mend || r->flipped.count == 0);
}

mesh_status mesh_check_edges(mesh_work *w, bool mend) {
    edges e = {.w = w};
    e.sides = mesh_array(3 * w->count, sizeof *e.sides);
    e.partner = mesh_array(3 * w->count, sizeof *e.partner);
    e.queue = mesh_array(w->count, sizeof *e.queue);
    e.turned = mesh_array(w->count, sizeof *e.turned);
    bool ready = e.sides && e.partner && e.queue && e.turned;
    if (ready) {
        link_sides(&e);
        check_winding(&e, mend);
    }
    free(e.sides);
    free(e.partner);
    free(e.queue);
    free(e.turned);
    return ready ? MESH_OK : MESH_ERR_MEMORY;
}

mesh_status mesh_loose_edges(const mesh_surface *surface, int32_t **ends, size_t *count) {
    MESH_ASSERT(surface && ends && count);
    const mesh_work w = {.corner = surface->triangle, .count = surface->triangle_count};
    size_t sides_count = 3 * w.count;
    side *sides = mesh_array(sides_count, sizeof *sides);
    *ends = mesh_array(sides_count, 2 * sizeof **ends);
    *count = 0;
    if (sides && *ends) {
        sort_sides(&w, sides);
        for (size_t i = 0, next; i < sides_count; i = next) {
            next = end_of_run(sides, i, sides_count);
            if (next - i == 2) continue;
            (*ends)[2 * *count] = sides[i].low, (*ends)[2 * (*count)++ + 1] = sides[i].high;
        }
        free(sides);
        return MESH_OK;
    }
    free(sides);
    free(*ends);
    *ends = NULL;
    return MESH_ERR_MEMORY;
}

/* Triangles that pass through each other, found with a tree of boxes. */
#include "meshes/status.h"
#include "meshes/vector.h"
#include "meshes/work.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Triangles in a leaf; pairs looked at before a hopeless mesh is given up: about half a minute. */
enum { LEAF = 4 };
static const size_t PAIRS_MAX = 1000000000;

/* Bits of a place along each axis; three of them fit into a key. */
enum { PLACE_BITS = 20 };

typedef struct key {
    uint64_t place; /* along a curve that keeps neighbours together */
    int32_t triangle;
} key;

typedef struct box {
    double low[3], high[3];
} box;

/* Triangles in the order of their keys, `LEAF` to a leaf; node 0 is the root, children of n are 2n
 * + 1 and 2n + 2, leaves are the last `leaves` nodes. */
typedef struct tree {
    mesh_work *w;
    key *order;
    box *boxes;     /* of nodes */
    box *triangles; /* of triangles, in their order */
    size_t leaves;
    size_t pairs;
    int32_t first[2]; /* triangles of the file, from 0: the lowest pair found */
} tree;

/* ---- vectors --------------------------------------------------------------------------------- */

static const double *corner(const mesh_work *w, int32_t t, int k) {
    return w->vertex + 3 * (size_t)w->corner[3 * (size_t)t + (size_t)k];
}

static void unit_normal(const mesh_work *w, int32_t t, double n[3]) {
    mesh_normal(w, (size_t)t, n);
    double length = sqrt(mesh_dot(n, n));
    for (int k = 0; k < 3; k++) n[k] /= length;
}

/* ---- two triangles --------------------------------------------------------------------------- */

/* Heights of the corners of t above the plane of `other`; what is within the weld distance lies in
 * it. True where some are above and some below. */
static bool straddles(const mesh_work *w, int32_t t, int32_t other, const double n[3],
                      double height[3]) {
    bool above = false, below = false;
    double offset = mesh_dot(n, corner(w, other, 0));
    for (int k = 0; k < 3; k++) {
        height[k] = mesh_dot(n, corner(w, t, k)) - offset;
        if (fabs(height[k]) <= w->report->weld_distance) height[k] = 0;
        above = above || height[k] > 0;
        below = below || height[k] < 0;
    }
    return above && below;
}

/* From where to where a straddling triangle meets the plane, along a direction in it. */
static void span(const mesh_work *w, int32_t t, const double height[3], const double along[3],
                 double *from, double *to) {
    *from = INFINITY, *to = -INFINITY;
    for (int k = 0; k < 3; k++) {
        int next = (k + 1) % 3;
        double a = mesh_dot(along, corner(w, t, k)), b = mesh_dot(along, corner(w, t, next)),
               at = a;
        if (height[k] * height[next] < 0)
            at = a + (b - a) * height[k] / (height[k] - height[next]);
        else if (height[k] != 0)
            continue;
        *from = fmin(*from, at), *to = fmax(*to, at);
    }
}

/* Whether both go through the plane of the other along a common stretch of more than the weld
 * distance (T. Moeller, A fast triangle-triangle intersection test, J. Graphics Tools 2, 1997).
 * What only touches, neighbours among it, has no such stretch; neither have triangles that lie on
 * each other in one plane. */
static bool cross_each_other(const mesh_work *w, int32_t a, int32_t b) {
    double na[3], nb[3], ha[3], hb[3], along[3], from[2], to[2];
    unit_normal(w, b, nb);
    if (!straddles(w, a, b, nb, ha)) return false;
    unit_normal(w, a, na);
    if (!straddles(w, b, a, na, hb)) return false;
    mesh_cross(na, nb, along);
    double length = sqrt(mesh_dot(along, along));
    for (int k = 0; k < 3; k++) along[k] /= length;
    span(w, a, ha, along, &from[0], &to[0]);
    span(w, b, hb, along, &from[1], &to[1]);
    return fmin(to[0], to[1]) - fmax(from[0], from[1]) > w->report->weld_distance;
}

/* ---- the tree -------------------------------------------------------------------------------- */

/* Every third bit, from the lowest on. */
static uint64_t spread(uint64_t x) {
    uint64_t out = 0;
    for (int i = 0; i < PLACE_BITS; i++) out |= (x >> i & 1) << 3 * i;
    return out;
}

static key key_of(const mesh_work *w, int32_t t) {
    const mesh_report *r = w->report;
    key out = {.triangle = t};
    for (int k = 0; k < 3; k++) {
        double middle = (corner(w, t, 0)[k] + corner(w, t, 1)[k] + corner(w, t, 2)[k]) / 3;
        double size = r->high[k] - r->low[k];
        double share = size > 0 ? fmin(fmax((middle - r->low[k]) / size, 0), 1) : 0;
        out.place |= spread((uint64_t)(share * ((1 << PLACE_BITS) - 1))) << k;
    }
    return out;
}

static int by_place(const void *left, const void *right) {
    const key *a = left, *b = right;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    return a->triangle < b->triangle ? -1 : a->triangle > b->triangle;
}

static const box NOTHING = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};

static void widen(box *b, const double low[3], const double high[3]) {
    for (int k = 0; k < 3; k++) {
        b->low[k] = fmin(b->low[k], low[k]);
        b->high[k] = fmax(b->high[k], high[k]);
    }
}

static void fill_boxes(tree *t) {
    size_t inner = t->leaves - 1;
    for (size_t i = 0; i < inner + t->leaves; i++) t->boxes[i] = NOTHING;
    for (size_t i = 0; i < t->w->count; i++) {
        t->triangles[i] = NOTHING;
        for (int k = 0; k < 3; k++) {
            const double *p = corner(t->w, t->order[i].triangle, k);
            widen(&t->triangles[i], p, p);
        }
        widen(&t->boxes[inner + i / LEAF], t->triangles[i].low, t->triangles[i].high);
    }
    for (size_t i = inner; i-- > 0;)
        for (size_t child = 2 * i + 1; child <= 2 * i + 2; child++)
            widen(&t->boxes[i], t->boxes[child].low, t->boxes[child].high);
}

static bool are_apart(const box *a, const box *b) {
    for (int k = 0; k < 3; k++)
        if (a->low[k] > b->high[k] || b->low[k] > a->high[k]) return true;
    return false;
}

/* ---- all pairs ------------------------------------------------------------------------------- */

static void found(tree *t, int32_t a, int32_t b) {
    int32_t x = t->w->source[a], y = t->w->source[b];
    int32_t low = x < y ? x : y, high = x < y ? y : x;
    mesh_finding *f = &t->w->report->crossings;
    bool first = f->count++ == 0 || low < t->first[0] || (low == t->first[0] && high < t->first[1]);
    if (first) t->first[0] = low, t->first[1] = high;
}

static void visit_leaves(tree *t, size_t a, size_t b) {
    for (size_t i = a * LEAF; i < (a + 1) * LEAF && i < t->w->count; i++)
        for (size_t j = a == b ? i + 1 : b * LEAF; j < (b + 1) * LEAF && j < t->w->count; j++) {
            t->pairs++;
            if (are_apart(&t->triangles[i], &t->triangles[j])) continue;
            if (cross_each_other(t->w, t->order[i].triangle, t->order[j].triangle))
                found(t, t->order[i].triangle, t->order[j].triangle);
        }
}

/* Nodes are of one depth, so both are leaves or neither is. */
static void visit(tree *t, size_t a, size_t b) {
    size_t inner = t->leaves - 1;
    if (t->pairs > PAIRS_MAX || are_apart(&t->boxes[a], &t->boxes[b])) return;
    if (a >= inner) {
        visit_leaves(t, a - inner, b - inner);
        return;
    }
    visit(t, 2 * a + 1, 2 * b + 1);
    visit(t, 2 * a + 2, 2 * b + 2);
    visit(t, 2 * a + 1, 2 * b + 2);
    if (a != b) visit(t, 2 * a + 2, 2 * b + 1);
}

mesh_status mesh_find_crossings(mesh_work *w) {
    tree t = {.w = w, .leaves = 1};
    while (t.leaves * LEAF < w->count) t.leaves *= 2;
    t.order = mesh_array(w->count, sizeof *t.order);
    t.boxes = mesh_array(2 * t.leaves, sizeof *t.boxes);
    t.triangles = mesh_array(w->count, sizeof *t.triangles);
    bool ready = t.order && t.boxes && t.triangles;
    if (ready) {
        for (size_t i = 0; i < w->count; i++) t.order[i] = key_of(w, (int32_t)i);
        qsort(t.order, w->count, sizeof *t.order, by_place);
        fill_boxes(&t);
        visit(&t, 0, 0);
        mesh_report *r = w->report;
        r->crossings_sought = true;
        r->crossings_given_up = t.pairs > PAIRS_MAX;
        if (r->crossings.count > 0) {
            r->crossings.first = (size_t)t.first[0] + 1;
            r->crossings_partner = (size_t)t.first[1] + 1;
        }
    }
    free(t.order);
    free(t.boxes);
    free(t.triangles);
    return ready ? MESH_OK : MESH_ERR_MEMORY;
}

/* wall_tree.c - which walls are around a body: a tree of boxes over the plates and patches of each
 * part. It stands in the frame of the part, where walls never move: a body is taken into that frame
 * instead, so what a search costs hangs neither on how many walls there are far away nor on how
 * the part moves. */
#include <stdlib.h>

#include "engine/part.h"
#include "engine/world.h"

enum { BOX = 6, DEPTH = 32 }; /* numbers of a box; nodes that wait */

/* ---- planting -------------------------------------------------------------------------------- */

typedef struct placed {
    uint64_t place;
    int wall;
} placed;

static int by_place(const void *left, const void *right) {
    const placed *a = left, *b = right;
    if (a->place != b->place) return a->place < b->place ? -1 : 1;
    return (a->wall > b->wall) - (a->wall < b->wall);
}

/* Every third bit, of 21. */
static uint64_t spread(uint64_t x) {
    x = (x | x << 32) & UINT64_C(0x1f00000000ffff);
    x = (x | x << 16) & UINT64_C(0x1f0000ff0000ff);
    x = (x | x << 8) & UINT64_C(0x100f00f00f00f00f);
    x = (x | x << 4) & UINT64_C(0x10c30c30c30c30c3);
    return (x | x << 2) & UINT64_C(0x1249249249249249);
}

/* Along a curve that fills the box (Morton's): what is near on it is near in space. */
static uint64_t place_of(vec3 p, vec3 low, double per_size) {
    double x[3] = {(p.x - low.x) * per_size, (p.y - low.y) * per_size, (p.z - low.z) * per_size};
    uint64_t place = 0;
    for (int k = 0; k < 3; k++) place |= spread((uint64_t)(x[k] * 0x1p20)) << k;
    return place;
}

/* Single precision, and never smaller than the wall is. */
static void box_of_wall(const wall *l, float box[BOX]) {
    double middle[3] = {l->def.point.x, l->def.point.y, l->def.point.z};
    double half[3] = {l->half_box.x, l->half_box.y, l->half_box.z};
    for (int k = 0; k < 3; k++) {
        box[k] = nextafterf((float)(middle[k] - half[k]), -INFINITY);
        box[3 + k] = nextafterf((float)(middle[k] + half[k]), INFINITY);
    }
}

static void widen(float *box, const float *more) {
    for (int k = 0; k < 3; k++) {
        if (more[k] < box[k]) box[k] = more[k];
        if (more[3 + k] > box[3 + k]) box[3 + k] = more[3 + k];
    }
}

static size_t first_of_leaf(const wall_tree *t, int leaf) {
    return (size_t)leaf * (size_t)t->walls / (size_t)t->leaves;
}

static void fill_boxes(const clast_world *w, wall_tree *t) {
    for (int leaf = 0; leaf < t->leaves; leaf++) {
        float *box = t->box + (size_t)BOX * (size_t)(t->leaves - 1 + leaf);
        box[0] = box[1] = box[2] = INFINITY, box[3] = box[4] = box[5] = -INFINITY;
        for (size_t k = first_of_leaf(t, leaf); k < first_of_leaf(t, leaf + 1); k++) {
            float own[BOX];
            box_of_wall(&w->walls[t->wall[k]], own);
            widen(box, own);
        }
    }
    for (int node = t->leaves - 2; node >= 0; node--) {
        float *box = t->box + (size_t)BOX * (size_t)node;
        const float *left = t->box + (size_t)BOX * (size_t)(2 * node + 1);
        for (int k = 0; k < BOX; k++) box[k] = left[k];
        widen(box, left + BOX);
    }
}

static void order_walls(const clast_world *w, wall_tree *t) {
    vec3 low = {INFINITY, INFINITY, INFINITY}, high = {-INFINITY, -INFINITY, -INFINITY};
    for (int k = 0; k < t->walls; k++) {
        vec3 p = w->walls[t->wall[k]].def.point;
        low = v3(fmin(low.x, p.x), fmin(low.y, p.y), fmin(low.z, p.z));
        high = v3(fmax(high.x, p.x), fmax(high.y, p.y), fmax(high.z, p.z));
    }
    double size = fmax(high.x - low.x, fmax(high.y - low.y, high.z - low.z));
    placed *order = malloc((size_t)t->walls * sizeof *order);
    CLAST_ASSERT(order);
    for (int k = 0; k < t->walls; k++)
        order[k] = (placed){place_of(w->walls[t->wall[k]].def.point, low, size > 0 ? 1 / size : 0),
                            t->wall[k]};
    qsort(order, (size_t)t->walls, sizeof *order, by_place);
    for (int k = 0; k < t->walls; k++) t->wall[k] = order[k].wall;
    free(order);
}

static void plant(clast_world *w, wall_tree *t) {
    t->leaves = 1;
    while (2 * t->leaves < t->walls) t->leaves *= 2;
    if (t->walls == 0) return;
    size_t nodes = 2 * (size_t)t->leaves - 1;
    t->box = memory_grow(w, NULL, 0, BOX * nodes, sizeof *t->box);
    order_walls(w, t);
    fill_boxes(w, t);
}

static void span_anchors(const clast_world *w, wall_tree *t) {
    t->anchor_low = v3(INFINITY, INFINITY, INFINITY);
    t->anchor_high = v3(-INFINITY, -INFINITY, -INFINITY);
    for (int k = 0; k < t->walls; k++) {
        vec3 p = w->walls[t->wall[k]].anchor_start, *low = &t->anchor_low, *high = &t->anchor_high;
        *low = v3(fmin(low->x, p.x), fmin(low->y, p.y), fmin(low->z, p.z));
        *high = v3(fmax(high->x, p.x), fmax(high->y, p.y), fmax(high->z, p.z));
    }
}

/* Needs all walls where they stand in the frames of their parts. */
void walls_plant(clast_world *w) {
    for (int i = 0; i < w->wall_count; i++) {
        wall_tree *t = &w->parts[w->walls[i].part].tree;
        if (w->walls[i].def.kind == CLAST_WALL_PLANE)
            t->planes++;
        else
            t->walls++;
    }
    for (int p = 0; p < w->part_count; p++) {
        wall_tree *t = &w->parts[p].tree;
        t->wall = memory_grow(w, NULL, 0, (size_t)t->walls + 1, sizeof *t->wall);
        t->plane = memory_grow(w, NULL, 0, (size_t)t->planes + 1, sizeof *t->plane);
        t->walls = t->planes = 0;
    }
    for (int i = 0; i < w->wall_count; i++) {
        wall_tree *t = &w->parts[w->walls[i].part].tree;
        if (w->walls[i].def.kind == CLAST_WALL_PLANE)
            t->plane[t->planes++] = i;
        else
            t->wall[t->walls++] = i;
    }
    for (int p = 0; p < w->part_count; p++) {
        plant(w, &w->parts[p].tree);
        span_anchors(w, &w->parts[p].tree);
    }
}

/* ---- searching ------------------------------------------------------------------------------- */

static double square_from(const float *box, vec3 p) {
    double x[3] = {p.x, p.y, p.z}, sum = 0;
    for (int k = 0; k < 3; k++) {
        double off = x[k] < (double)box[k]       ? (double)box[k] - x[k]
                     : x[k] > (double)box[3 + k] ? x[k] - (double)box[3 + k]
                                                 : 0;
        sum += off * off;
    }
    return sum;
}

static void found(clast_world *w, share *s, size_t count, int wall_index) {
    if (count == s->around_capacity) {
        size_t now = 2 * count + 64;
        s->around = memory_grow(w, s->around, count, now, sizeof *s->around);
        s->around_capacity = now;
    }
    s->around[count] = wall_index;
}

/* Walls of one part whose boxes are within reach of a place in its frame, behind `count` others. */
static size_t search(clast_world *w, share *s, const wall_tree *t, vec3 at, double reach,
                     size_t count) {
    int waiting[DEPTH], left = 0;
    waiting[left++] = 0;
    while (left > 0) {
        int node = waiting[--left];
        s->wall_tests++;
        if (square_from(t->box + (size_t)BOX * (size_t)node, at) >= reach * reach) continue;
        if (node < t->leaves - 1) {
            waiting[left++] = 2 * node + 2, waiting[left++] = 2 * node + 1;
            continue;
        }
        int leaf = node - (t->leaves - 1);
        for (size_t k = first_of_leaf(t, leaf); k < first_of_leaf(t, leaf + 1); k++)
            found(w, s, count++, t->wall[k]);
    }
    return count;
}

static bool are_equal(vec3 a, vec3 b) {
    return a.x == b.x && a.y == b.y && a.z == b.z;
}

/* The same in one image of the place: walls that are felt in it. */
static size_t search_image(clast_world *w, share *s, const part *p, vec3 centre, vec3 way,
                           double reach, size_t count) {
    vec3 at = part_in(p, v3_sub(centre, way));
    size_t end = search(w, s, &p->tree, at, reach, count);
    for (size_t k = count; k < end; k++) {
        vec3 anchor = part_out(p, w->walls[s->around[k]].anchor_start);
        if (are_equal(way_to_image(&w->period, anchor, centre), way))
            s->around[count++] = s->around[k];
    }
    return count;
}

/* Across periodic faces: in all images that are nearest to a place where an anchor may be. */
static size_t search_images(clast_world *w, share *s, const part *p, vec3 centre, double reach,
                            size_t count) {
    const double *length = w->period.length;
    const wall_tree *t = &p->tree;
    vec3 half = v3_scale(0.5, v3_sub(t->anchor_high, t->anchor_low));
    vec3 middle = part_out(p, v3_add(t->anchor_low, half));
    if (p->turns) half = v3(v3_norm(half), v3_norm(half), v3_norm(half));
    double first[3], last[3];
    for (int k = 0; k < 3; k++) {
        double d = v3_at(v3_sub(centre, middle), k), slack = v3_at(half, k) + 1e-9 * length[k];
        first[k] = lengths_in(d - slack, length[k]), last[k] = lengths_in(d + slack, length[k]);
    }
    for (double x = first[0]; x <= last[0]; x++)
        for (double y = first[1]; y <= last[1]; y++)
            for (double z = first[2]; z <= last[2]; z++)
                count = search_image(w, s, p, centre,
                                     v3(length[0] * x, length[1] * y, length[2] * z), reach, count);
    return count;
}

/* Writes the walls that may be within reach (m) of a place into s->around and returns how many. */
size_t walls_around(clast_world *w, share *s, vec3 centre, double reach) {
    size_t count = 0;
    for (int i = 0; i < w->part_count; i++) {
        const part *p = &w->parts[i];
        if (!p->present) continue;
        for (int k = 0; k < p->tree.planes; k++) found(w, s, count++, p->tree.plane[k]);
        if (p->tree.walls == 0) continue;
        if (w->period.any)
            count = search_images(w, s, p, centre, reach, count);
        else
            count = search(w, s, &p->tree, part_in(p, centre), reach, count);
    }
    s->wall_tests += count;
    return count;
}

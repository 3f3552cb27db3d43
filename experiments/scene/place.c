/* place.c - many bodies from one entry: on a grid, in closest packing, or at random where there is
 * room. Random numbers are a pure function of the seed, the place of the entry and that in it.
 */
#include "experiments/scene/build.h"

#include <math.h>
#include <stdlib.h>

#define FAULT(node, key, ...) scene_fault_at(r->arena, r->faults, (node), (key), __VA_ARGS__)

static const double BODIES_MAX = 1e7; /* of one entry: beyond, a unit is wrong */
static const double TURN = 6.283185307179586;

double crowd_draw(const crowd *c, int source, draw_purpose purpose, uint64_t counter) {
    SCENE_ASSERT(c && source >= 0);
    uint64_t stream = UINT64_C(0x5343454e00000000) + 4 * (uint64_t)source + (uint64_t)purpose;
    return clast_random(c->seed, stream, counter);
}

/* ---- the crowd ------------------------------------------------------------------------------- */

static void *grow(void *memory, int room, size_t size) {
    void *larger = realloc(memory, (size_t)room * size);
    if (!larger) abort();
    return larger;
}

void crowd_add(crowd *c, const clast_body_def *body, int source) {
    SCENE_ASSERT(c && body && body->shape >= 0);
    if (c->count == c->room) {
        c->room = c->room ? 2 * c->room : 64;
        c->bodies = grow(c->bodies, c->room, sizeof *c->bodies);
        c->reach = grow(c->reach, c->room, sizeof *c->reach);
        c->source = grow(c->source, c->room, sizeof *c->source);
    }
    c->bodies[c->count] = *body;
    c->reach[c->count] = c->shape_reach[body->shape];
    c->source[c->count++] = source;
}

void crowd_free(crowd *c) {
    free(c->bodies);
    free(c->reach);
    free(c->source);
    *c = (crowd){0};
}

/* ---- orientation ----------------------------------------------------------------------------- */

clast_quat scene_turn(const rotation *turn, const tree_node *node) {
    if (!node) return (clast_quat){1, 0, 0, 0};
    if (tree_get(node, "quaternion")) {
        const double *q = turn->quaternion;
        double norm = sqrt(q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3]);
        return (clast_quat){q[0] / norm, q[1] / norm, q[2] / norm, q[3] / norm};
    }
    clast_vec3 a = turn->axis;
    double norm = sqrt(a.x * a.x + a.y * a.y + a.z * a.z);
    return clast_quat_axis_angle((clast_vec3){a.x / norm, a.y / norm, a.z / norm}, turn->angle);
}

static clast_quat orientation(const crowd *c, const generator *g, const tree_node *node, int source,
                              int index) {
    if (g->orientation == ORIENT_FIXED) return scene_turn(&g->turn, tree_get(node, "turn"));
    uint64_t at = 3 * (uint64_t)index;
    double u = crowd_draw(c, source, DRAW_TURN, at);
    if (c->plane_axis >= 0) {
        clast_vec3 normal = {c->plane_axis == 0, c->plane_axis == 1, c->plane_axis == 2};
        return clast_quat_axis_angle(normal, TURN * u);
    }
    return clast_quat_uniform(u, crowd_draw(c, source, DRAW_TURN, at + 1),
                              crowd_draw(c, source, DRAW_TURN, at + 2));
}

static void add(crowd *c, const generator *g, const tree_node *node, int source, int index,
                int shape, const double at[3]) {
    crowd_add(c,
              &(clast_body_def){.shape = shape,
                                .position = {at[0], at[1], at[2]},
                                .orientation = orientation(c, g, node, source, index),
                                .velocity = g->velocity,
                                .spin = g->spin},
              source);
}

/* ---- the region ------------------------------------------------------------------------------ */

/* Where centres may be. A region without thickness in a direction holds one layer of centres. */
typedef struct free_room {
    double low[3], high[3];
    bool thin[3];
    double reach;
} free_room;

static free_room room_for(const generator *g, double reach) {
    const double low[3] = {g->region_min.x, g->region_min.y, g->region_min.z};
    const double high[3] = {g->region_max.x, g->region_max.y, g->region_max.z};
    free_room out = {.reach = reach};
    for (int i = 0; i < 3; i++) {
        out.thin[i] = low[i] == high[i];
        double margin = out.thin[i] ? 0 : reach;
        out.low[i] = low[i] + margin;
        out.high[i] = high[i] - margin;
    }
    return out;
}

/* For the largest body that the entry may place. */
static bool make_room(scene_reader *r, const crowd *c, const generator *g, const tree_node *node,
                      free_room *out) {
    *out = room_for(g, scene_pick_reach(c, g));
    for (int i = 0; i < 3; i++)
        if (out->high[i] < out->low[i]) {
            FAULT(node, "region",
                  "found %g m along %c, expected at least the diameter of the "
                  "bounding sphere, %g m (or 0 for one layer)",
                  out->high[i] - out->low[i] + 2 * out->reach, "xyz"[i], 2 * out -> reach);
            return false;
        }
    return true;
}

/* How many steps of `spacing` fit; as a double, for it may be absurd. */
static double fitting(const free_room *room, int axis, double spacing) {
    if (room->thin[axis]) return 1;
    return floor((room->high[axis] - room->low[axis]) / spacing + 1e-9) + 1;
}

static bool enough(scene_reader *r, const tree_node *node, const generator *g, double capacity) {
    double wanted = g->count > 0 ? g->count : capacity;
    if (wanted > capacity)
        FAULT(node, "count", "placed %.0f of %d: the region holds no more at this spacing",
              capacity, g->count);
    else if (wanted > BODIES_MAX)
        FAULT(node, "count", "found room for %.3g bodies, expected at most %.0e", wanted,
              BODIES_MAX);
    return wanted <= capacity && wanted <= BODIES_MAX;
}

static double clamp(double x, double low, double high) {
    return x < low ? low : x > high ? high : x;
}

/* Shifts by at most half the gap, so bounding spheres that did not touch still do not. */
static void jitter(const crowd *c, const generator *g, const free_room *room,
                   const double spacing[3], int source, int index, double at[3]) {
    if (g->jitter == 0) return;
    for (int i = 0; i < 3; i++) {
        double gap = spacing[i] - 2 * room->reach;
        if (room->thin[i] || gap <= 0) continue;
        double u = crowd_draw(c, source, DRAW_JITTER, 3 * (uint64_t)index + (uint64_t)i);
        at[i] = clamp(at[i] + (u - 0.5) * g->jitter * gap, room->low[i], room->high[i]);
    }
}

static bool may_turn_freely(scene_reader *r, const tree_node *node, const generator *g,
                            const free_room *room, double spacing) {
    bool safe = g->orientation == ORIENT_FIXED || spacing >= 2 * room->reach;
    if (!safe)
        FAULT(node, "spacing",
              "found %g m, expected at least the diameter of the bounding sphere, "
              "%g m, for a random orientation",
              spacing, 2 * room->reach);
    return safe;
}

/* ---- grid ------------------------------------------------------------------------------------ */

void scene_place_grid(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                      int source) {
    SCENE_ASSERT(r && c && node && g);
    free_room room;
    if (!make_room(r, c, g, node, &room)) return;
    const double spacing[3] = {g->spacing.x, g->spacing.y, g->spacing.z};
    double steps[3], start[3];
    for (int i = 0; i < 3; i++) {
        if (!room.thin[i] && !may_turn_freely(r, node, g, &room, spacing[i])) return;
        steps[i] = fitting(&room, i, spacing[i]);
        double used = (steps[i] - 1) * spacing[i];
        bool centred = i < 2 && !room.thin[i]; /* z starts at the floor */
        start[i] = room.low[i] + (centred ? (room.high[i] - room.low[i] - used) / 2 : 0);
    }
    double capacity = steps[0] * steps[1] * steps[2];
    if (!enough(r, node, g, capacity)) return;
    int count = g->count > 0 ? g->count : (int)capacity;
    const int *shapes = scene_pick(r, c, g, source, count, PICK_SHUFFLED);
    double nx = steps[0], ny = steps[1];
    for (int index = 0; index < count; index++) {
        double layer = floor(index / (nx * ny)), row = floor((index - layer * nx * ny) / nx);
        double at[3] = {start[0] + (index - layer * nx * ny - row * nx) * spacing[0],
                        start[1] + row * spacing[1], start[2] + layer * spacing[2]};
        jitter(c, g, &room, spacing, source, index, at);
        add(c, g, node, source, index, shapes[index], at);
    }
}

/* ---- hexagonal ------------------------------------------------------------------------------- */

/* Closest packing as steps and shifts along three axes: u in a row, v from row to row, w from layer
 * to layer. One layer (w thin) is the closest packing of discs. */
typedef struct packing {
    int u, v, w;
    double spacing, row, layer;
} packing;

static packing make_packing(const free_room *room, double spacing) {
    packing p = {.u = 0, .v = 1, .w = 2, .spacing = spacing};
    int thin = room->thin[1] ? 1 : room->thin[0] ? 0 : 2;
    if (room->thin[thin])
        p = (packing){
            .u = thin == 0 ? 1 : 0, .v = thin == 2 ? 1 : 2, .w = thin, .spacing = spacing};
    p.row = spacing * (sqrt(3) / 2);
    p.layer = spacing * sqrt(2.0 / 3.0);
    return p;
}

static void packing_place(const packing *p, const free_room *room, int i, int j, int k,
                          double at[3]) {
    at[p->u] = room->low[p->u] + p->spacing * (i + 0.5 * ((j + k) % 2));
    at[p->v] = room->low[p->v] + p->row * (j + (k % 2) / 3.0);
    at[p->w] = room->low[p->w] + p->layer * k;
}

static bool is_inside(const free_room *room, const double at[3], double slack) {
    for (int i = 0; i < 3; i++)
        if (at[i] > room->high[i] + slack) return false;
    return true;
}

/* Where the search for the next place goes on: i in a row, j rows, k layers. */
typedef struct site {
    int i, j, k;
} site;

/* The next place of the packing that is inside the room; false behind the last one. */
static bool next_site(const packing *p, const free_room *room, double nu, double nv, double nw,
                      site *s, double at[3]) {
    for (; s->k < (int)nw; s->k++, s->j = 0)
        for (; s->j < (int)nv; s->j++, s->i = 0)
            while (s->i < (int)nu) {
                packing_place(p, room, s->i++, s->j, s->k, at);
                if (is_inside(room, at, 1e-9 * p->spacing)) return true;
            }
    return false;
}

void scene_place_hexagonal(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                           int source) {
    SCENE_ASSERT(r && c && node && g);
    free_room room;
    double s = g->spacing.x;
    if (!make_room(r, c, g, node, &room) || !may_turn_freely(r, node, g, &room, s)) return;
    packing p = make_packing(&room, s);
    double nu = fitting(&room, p.u, s), nv = fitting(&room, p.v, p.row);
    double nw = fitting(&room, p.w, p.layer);
    if (nu * nv * nw > BODIES_MAX) {
        enough(r, node, &(generator){.count = 0}, nu * nv * nw);
        return;
    }
    int capacity = 0, wanted = g->count > 0 ? g->count : (int)BODIES_MAX;
    site last = {0};
    double at[3];
    while (capacity < wanted && next_site(&p, &room, nu, nv, nw, &last, at)) capacity++;
    const int *shapes = scene_pick(r, c, g, source, capacity, PICK_SHUFFLED);
    const double spacing[3] = {s, s, s};
    last = (site){0};
    for (int placed = 0; placed < capacity; placed++) {
        next_site(&p, &room, nu, nv, nw, &last, at);
        jitter(c, g, &room, spacing, source, placed, at);
        add(c, g, node, source, placed, shapes[placed], at);
    }
    if (capacity < g->count) enough(r, node, g, capacity);
}

/* ---- random ---------------------------------------------------------------------------------- */

/* Cells hold the bodies so far; a cell is as wide as two centres that conflict can be apart. */
typedef struct cell_grid {
    double width;
    uint32_t mask;
    int *head, *next; /* -1 ends a chain */
} cell_grid;

static uint32_t cell_of(const cell_grid *cells, const int64_t at[3]) {
    uint64_t h = (uint64_t)at[0] * UINT64_C(0x9e3779b97f4a7c15) ^
                 (uint64_t)at[1] * UINT64_C(0xc2b2ae3d27d4eb4f) ^
                 (uint64_t)at[2] * UINT64_C(0x165667b19e3779f9);
    return (uint32_t)(h >> 29) & cells->mask;
}

static void cell_at(const cell_grid *cells, const double at[3], int64_t cell[3]) {
    for (int i = 0; i < 3; i++) cell[i] = (int64_t)clamp(floor(at[i] / cells->width), -1e15, 1e15);
}

static void cells_put(cell_grid *cells, const crowd *c, int body) {
    clast_vec3 p = c->bodies[body].position;
    int64_t cell[3];
    cell_at(cells, (double[3]){p.x, p.y, p.z}, cell);
    uint32_t bucket = cell_of(cells, cell);
    cells->next[body] = cells->head[bucket];
    cells->head[bucket] = body;
}

static cell_grid cells_new(const crowd *c, int more, double reach, double gap) {
    int total = c->count + more;
    cell_grid out = {.mask = 1};
    while (out.mask < (uint32_t)total) out.mask = 2 * out.mask + 1;
    out.head = grow(NULL, (int)out.mask + 1, sizeof *out.head);
    out.next = grow(NULL, total, sizeof *out.next);
    for (uint32_t i = 0; i <= out.mask; i++) out.head[i] = -1;
    double widest = reach;
    for (int i = 0; i < c->count; i++) widest = c->reach[i] > widest ? c->reach[i] : widest;
    out.width = reach + widest + gap;
    for (int i = 0; i < c->count; i++) cells_put(&out, c, i);
    return out;
}

static bool conflicts(const crowd *c, int body, const double at[3], double reach, double gap) {
    clast_vec3 p = c->bodies[body].position;
    double dx = p.x - at[0], dy = p.y - at[1], dz = p.z - at[2];
    double apart = c->reach[body] + reach + gap;
    return dx * dx + dy * dy + dz * dz < apart * apart;
}

static bool is_free(const cell_grid *cells, const crowd *c, const double at[3], double reach,
                    double gap) {
    int64_t centre[3];
    cell_at(cells, at, centre);
    for (int n = 0; n < 27; n++) {
        int64_t cell[3] = {centre[0] + n % 3 - 1, centre[1] + n / 3 % 3 - 1, centre[2] + n / 9 - 1};
        for (int body = cells->head[cell_of(cells, cell)]; body >= 0; body = cells->next[body])
            if (conflicts(c, body, at, reach, gap)) return false;
    }
    return true;
}

/* One body; false when no free place was found. *counter runs on through all tries of the entry. */
static bool place_one(crowd *c, cell_grid *cells, const generator *g, const tree_node *node,
                      int source, int index, int shape, uint64_t *counter) {
    const free_room own = room_for(g, c->shape_reach[shape]), *room = &own;
    for (int attempt = 0; attempt < g->attempts; attempt++) {
        double at[3];
        for (int i = 0; i < 3; i++) {
            double u = crowd_draw(c, source, DRAW_PLACE, (*counter)++);
            at[i] = clamp(room->low[i] + u * (room->high[i] - room->low[i]), room->low[i],
                          room->high[i]);
        }
        if (!is_free(cells, c, at, room->reach, g->gap)) continue;
        add(c, g, node, source, index, shape, at);
        cells_put(cells, c, c->count - 1);
        return true;
    }
    return false;
}

void scene_place_random(scene_reader *r, crowd *c, const tree_node *node, const generator *g,
                        int source) {
    SCENE_ASSERT(r && c && node && g && g->count > 0);
    free_room room;
    if (!make_room(r, c, g, node, &room)) return;
    const int *shapes = scene_pick(r, c, g, source, g->count, PICK_LARGE_FIRST);
    cell_grid cells = cells_new(c, g->count, room.reach, g->gap);
    uint64_t counter = 0;
    int placed = 0;
    while (placed < g->count &&
           place_one(c, &cells, g, node, source, placed, shapes[placed], &counter))
        placed++;
    if (placed < g->count)
        FAULT(node, "count",
              "placed %d of %d: no free place for the next one in %d attempts "
              "(a larger region, a smaller gap, or hexagonal)",
              placed, g->count, g->attempts);
    free(cells.head);
    free(cells.next);
}

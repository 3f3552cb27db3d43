/* ranks_ghosts.c - bodies of other processes that are within reach of own ones: who they are, found
 * out when the lists are made, and where they are, in every step. */
#include <string.h>

#include "engine/cells.h"
#include "engine/numbers.h"
#include "engine/ranks.h"
#include "engine/rows.h"

/* ---- boxes ----------------------------------------------------------------------------------- */

/* The middle of places on a circle of that length, within half of it about the origin: what has
 * crossed a periodic face still is beside those that have not. */
static double middle_of(const double *x, size_t count, double length) {
    double sines = 0, cosines = 0;
    for (size_t i = 0; i < count; i++) {
        double angle = 2 * NUMBER_PI * (x[i] / length);
        sines += sin(angle), cosines += cos(angle);
    }
    return atan2(sines, cosines) / (2 * NUMBER_PI) * length;
}

/* Around the images that are nearest to the middle. */
static void span_own(const double *x, size_t count, double length, double *low, double *high) {
    double middle = length > 0 ? middle_of(x, count, length) : 0;
    for (size_t i = 0; i < count; i++) {
        double at = length > 0 ? x[i] - length * rint((x[i] - middle) / length) : x[i];
        if (!(at >= *low)) *low = at == at ? at : -INFINITY;
        if (!(at <= *high)) *high = at == at ? at : INFINITY;
    }
}

static rank_box box_of_own(const clast_world *w) {
    const double *x[3] = {w->bodies.x, w->bodies.y, w->bodies.z};
    rank_box b = {{INFINITY, INFINITY, INFINITY}, {-INFINITY, -INFINITY, -INFINITY}};
    for (int k = 0; k < 3; k++)
        span_own(x[k], w->bodies.count, w->period.length[k], &b.low[k], &b.high[k]);
    return b;
}

static double outside(double x, double low, double high) {
    return x < low ? low - x : x > high ? x - high : 0;
}

/* To what lies from low to high, or the image of it whose middle is nearest. */
static double away_along(double x, double low, double high, double length) {
    if (length > 0 && high - low < INFINITY)
        x -= length * rint((x - 0.5 * (low + high)) / length);
    return outside(x, low, high);
}

/* m2 from a place to the nearest image of a box; nothing where the place is no number. */
double ranks_away(const clast_world *w, const rank_box *b, vec3 place) {
    double away = 0;
    for (int k = 0; k < 3; k++) {
        double d = away_along(v3_at(place, k), b->low[k], b->high[k], w->period.length[k]);
        away += d * d;
    }
    return away == away ? away : 0;
}

/* From one box to the nearest image of another, along an axis. */
static double gap_along(const rank_box *a, const rank_box *b, int axis, double length) {
    double gap = INFINITY;
    for (int image = -1; image <= 1; image++) {
        double shift = image * length;
        gap = fmin(
            gap, fmax(b->low[axis] + shift - a->high[axis], a->low[axis] - b->high[axis] - shift));
    }
    return gap;
}

/* No body in one can be within reach of the other. */
static bool are_apart(const clast_world *w, const rank_box *a, const rank_box *b, double reach) {
    for (int k = 0; k < 3; k++)
        if (gap_along(a, b, k, w->period.length[k]) >= reach) return true;
    return false;
}

static bool is_empty(const rank_box *b) {
    return b->low[0] == INFINITY && b->high[0] == -INFINITY;
}

static void gather_boxes(clast_world *w) {
    ranks *r = w->ranks;
    rank_box own = box_of_own(w);
    size_t count;
    rank_box *all = ranks_gather(w, &own, 1, sizeof own, &count);
    memcpy(r->boxes, all, count * sizeof own);
    memory_release(all);
}

/* ---- who goes ----------------------------------------------------------------------------------
 */

static void send_body(clast_world *w, size_t slot) {
    ranks *r = w->ranks;
    if (r->out_count == r->out_room) {
        size_t now = 2 * r->out_room + 256;
        r->out_slot = memory_grow(w, r->out_slot, r->out_room, now, sizeof *r->out_slot);
        r->out_room = now;
    }
    r->out_slot[r->out_count++] = (uint32_t)slot;
}

/* A contact that has touched is kept until its end is booked: its bodies may be farther apart than
 * the skin by what they have gone in one step. */
static double reach_of_lists(const clast_world *w) {
    double way = 2 * w->found.way;
    return w->largest_bound + (way > w->skin ? way : w->skin);
}

static void choose(clast_world *w) {
    ranks *r = w->ranks;
    const rank_box *own = &r->boxes[r->by->number];
    double more = reach_of_lists(w), most = w->largest_bound + more;
    r->out_count = 0;
    for (int q = 0; q < r->by->count; q++) {
        size_t before = r->out_count;
        bool asks =
            q != r->by->number && !is_empty(&r->boxes[q]) && !are_apart(w, own, &r->boxes[q], most);
        for (size_t i = 0; i < w->bodies.count && asks; i++) {
            double reach = w->shapes[w->bodies.shape[i]].bound + more;
            if (!(ranks_away(w, &r->boxes[q], body_position(w, i)) >= reach * reach))
                send_body(w, i);
        }
        r->out_bodies[q] = r->out_count - before;
    }
}

traveller ranks_body_at(const clast_world *w, size_t slot) {
    const body_store *b = &w->bodies;
    traveller t = {.image = {0}};
#define X(type, name) t.name = b->name[slot];
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) t.image[k] = b->image[k][slot];
    return t;
}

void ranks_put_body(clast_world *w, size_t slot, const traveller *t) {
    body_store *b = &w->bodies;
#define X(type, name) b->name[slot] = t->name;
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) b->image[k][slot] = t->image[k];
    w->slot_of_id[t->id] = (int32_t)slot;
}

/* malloc'ed */
static traveller *send_all(clast_world *w) {
    ranks *r = w->ranks;
    traveller *out = memory_grow(w, NULL, 0, r->out_count + 1, sizeof *out);
    for (size_t k = 0; k < r->out_count; k++) out[k] = ranks_body_at(w, r->out_slot[k]);
    for (int q = 0; q < r->by->count; q++) r->out_bytes[q] = r->out_bodies[q] * sizeof *out;
    traveller *in = (traveller *)r->by->exchange(out, r->out_bytes, r->in_bytes);
    memory_return(w, (r->out_count + 1) * sizeof *out), memory_release(out);
    r->in_count = 0;
    for (int q = 0; q < r->by->count; q++) {
        r->in_bodies[q] = r->in_bytes[q] / sizeof *in;
        r->in_count += r->in_bodies[q];
    }
    return in;
}

/* ---- where they stand ---------------------------------------------------------------------------
 * Behind the own bodies, by the cells of these. */

static size_t cell_of(const clast_world *w, const traveller *t) {
    const cell_grid *g = &w->cells.grid;
    cell_place p = cell_at(g, t->x, t->y, t->z);
    return row_of_cells(g, p.j, p.k) + (size_t)p.i;
}

static uint32_t *room_for_cells(clast_world *w) {
    const cell_grid *g = &w->cells.grid;
    size_t cells = (size_t)g->x.count * (size_t)g->y.count * (size_t)g->z.count;
    if (w->cells.ghost_capacity < cells + 1) {
        w->cells.ghost_first = memory_grow(w, w->cells.ghost_first, w->cells.ghost_capacity,
                                           cells + 1, sizeof(uint32_t));
        w->cells.ghost_capacity = cells + 1;
    }
    memset(w->cells.ghost_first, 0, (cells + 1) * sizeof(uint32_t));
    return w->cells.ghost_first + cells;
}

static void sort_ghosts(clast_world *w, const traveller *in) {
    ranks *r = w->ranks;
    if (w->bodies.count == 0 || r->in_count == 0) return;
    uint32_t *last = room_for_cells(w), *first = w->cells.ghost_first;
    uint32_t before = (uint32_t)w->bodies.count;
    for (size_t k = 0; k < r->in_count; k++) first[cell_of(w, &in[k]) + 1]++;
    first[0] = before;
    for (uint32_t *c = first; c < last; c++) c[1] += c[0];
    for (size_t k = 0; k < r->in_count; k++) r->in_slot[k] = first[cell_of(w, &in[k])]++;
    for (uint32_t *c = last; c > first; c--) c[0] = c[-1];
    first[0] = before;
}

static void reserve_in(clast_world *w) {
    ranks *r = w->ranks;
    if (r->in_count <= r->in_room) return;
    size_t now = r->in_count + r->in_count / 4;
    r->in_slot = memory_grow(w, r->in_slot, r->in_room, now, sizeof *r->in_slot);
    r->in_room = now;
}

/* Numbers of a body in a step: places and velocities, and the orientation where it matters. */
static size_t numbers_of(const clast_world *w) {
    return w->special.oriented ? 13 : 9;
}

static void size_messages(clast_world *w) {
    ranks *r = w->ranks;
    size_t out = 0, in = 0, numbers = numbers_of(w);
    for (int q = 0; q < r->by->count; q++) {
        size_t sends = r->out_bodies[q] * numbers;
        size_t takes = r->in_bodies[q] * numbers;
        r->out_bytes[q] = sends * sizeof(double), r->in_bytes[q] = takes * sizeof(double);
        out += sends, in += takes;
    }
    if (out > r->out_numbers)
        r->out = memory_grow(w, r->out, r->out_numbers, out, sizeof(double)), r->out_numbers = out;
    if (in > r->in_numbers)
        r->in = memory_grow(w, r->in, r->in_numbers, in, sizeof(double)), r->in_numbers = in;
}

/* Needs own bodies sorted and no ghosts. */
void ranks_list_ghosts(clast_world *w) {
    if (!w->ranks) return;
    ranks *r = w->ranks;
    CLAST_ASSERT(w->ghosts == 0 && w->arrived == 0);
    gather_boxes(w);
    choose(w);
    traveller *in = send_all(w);
    reserve_in(w);
    body_reserve(w, w->bodies.count + r->in_count);
    sort_ghosts(w, in);
    for (size_t k = 0; k < r->in_count; k++) ranks_put_body(w, r->in_slot[k], &in[k]);
    memory_release(in);
    w->ghosts = w->counters.ghosts = r->in_count;
    size_messages(w);
}

/* Names must have been taken (carry.c). Bodies of feeds, which stand behind the ghosts, move up. */
void ranks_forget_ghosts(clast_world *w) {
    body_store *b = &w->bodies;
    for (size_t i = b->count; i < b->count + w->ghosts; i++) w->slot_of_id[b->id[i]] = -1;
    for (size_t k = 0; k < w->arrived; k++) {
        size_t from = b->count + w->ghosts, to = b->count++;
        traveller t = ranks_body_at(w, from);
        ranks_put_body(w, to, &t);
    }
    w->ghosts = w->ghost_spheres = w->arrived = 0;
}

/* ---- a step -----------------------------------------------------------------------------------
 */

static double *pack(const clast_world *w, double *to, size_t i) {
    const body_store *b = &w->bodies;
    const double numbers[] = {b->x[i],  b->y[i],  b->z[i],  b->vx[i], b->vy[i], b->vz[i], b->lx[i],
                              b->ly[i], b->lz[i], b->qw[i], b->qx[i], b->qy[i], b->qz[i]};
    size_t count = numbers_of(w);
    memcpy(to, numbers, count * sizeof *to);
    return to + count;
}

static const double *unpack(clast_world *w, const double *from, size_t i) {
    body_store *b = &w->bodies;
    b->x[i] = from[0], b->y[i] = from[1], b->z[i] = from[2];
    b->vx[i] = from[3], b->vy[i] = from[4], b->vz[i] = from[5];
    b->lx[i] = from[6], b->ly[i] = from[7], b->lz[i] = from[8];
    if (w->special.oriented)
        b->qw[i] = from[9], b->qx[i] = from[10], b->qy[i] = from[11], b->qz[i] = from[12];
    return from + numbers_of(w);
}

static void pack_all(clast_world *w) {
    ranks *r = w->ranks;
    double *to = r->out;
    for (size_t k = 0; k < r->out_count; k++) to = pack(w, to, r->out_slot[k]);
}

static void unpack_all(clast_world *w) {
    ranks *r = w->ranks;
    const double *from = r->in;
    for (size_t k = 0; k < r->in_count; k++) from = unpack(w, from, r->in_slot[k]);
}

/* Ghosts go where their bodies have gone. */
void ranks_swap(clast_world *w) {
    if (!w->ranks) return;
    ranks *r = w->ranks;
    clast_counters *c = &w->counters;
    pack_all(w);
    c->messages += (uint64_t)r->by->swap(r->out, r->out_bytes, r->in, r->in_bytes);
    for (int q = 0; q < r->by->count; q++) c->message_bytes += r->out_bytes[q];
    c->ghosts_sent += r->out_count;
    unpack_all(w);
    rows_fill(w, w->bodies.count, w->bodies.count + w->ghosts);
}

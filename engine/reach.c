/* reach.c - the reach list: every pair of spheres, and of a sphere and a wall, that is closer than
 * the skin, found through the cells. A pair stands with its sphere of lower index. Nothing here is
 * observable. */
#include "engine/cells.h"
#include "engine/geometry.h"
#include "engine/periodic.h"

/* ---- growing --------------------------------------------------------------------------------- */

static void reserve_partners(clast_world *w, reach_list *l, size_t count) {
    if (count <= l->capacity) return;
    size_t now = count + count / 8 + 256;
    l->partner = memory_grow(w, l->partner, l->capacity, now, sizeof *l->partner);
    l->capacity = now;
}

static void reserve_first(clast_world *w, reach_list *l, size_t spheres) {
    if (spheres + 1 <= l->first_capacity) return;
    l->first = memory_grow(w, l->first, l->first_capacity, spheres + 1, sizeof *l->first);
    l->first_capacity = spheres + 1;
}

static void push_wall(clast_world *w, wall_reach *l, size_t sphere, int wall_index) {
    if (l->count == l->capacity) {
        size_t now = 2 * l->capacity + 64;
        l->sphere = memory_grow(w, l->sphere, l->capacity, now, sizeof *l->sphere);
        l->wall = memory_grow(w, l->wall, l->capacity, now, sizeof *l->wall);
        l->capacity = now;
    }
    l->sphere[l->count] = (int32_t)sphere, l->wall[l->count] = wall_index;
    l->count++;
}

/* ---- bodies ahead ---------------------------------------------------------------------------- */

typedef struct range {
    size_t begin, end; /* slots */
} range;

enum { RANGES = 18 };

static double bound_of(const clast_world *w, size_t slot) {
    return w->shapes[w->bodies.shape[slot]].bound;
}

/* Slots behind `a` in its own row of cells and in the rows after it that its neighbours can be in.
 */
static int ranges_ahead(const clast_world *w, size_t a, range out[RANGES]) {
    const cell_grid *g = &w->cells.grid;
    const body_store *b = &w->bodies;
    cell_place p = cell_at(g, b->x[a], b->y[a], b->z[a]);
    int last = g->x.count - 1, i0 = p.i > 0 ? p.i - 1 : 0, i1 = p.i < last ? p.i + 1 : last;
    int count = 0;
    static const int dj[5] = {0, 1, -1, 0, 1}, dk[5] = {0, 0, 1, 1, 1};
    for (int r = 0; r < 5; r++) {
        int jr = p.j + dj[r], kr = p.k + dk[r];
        if (jr < 0 || jr >= g->y.count || kr >= g->z.count) continue;
        size_t row = row_of_cells(g, jr, kr);
        size_t from = r == 0 ? a + 1 : w->cells.cell_first[row + (size_t)i0];
        size_t to = w->cells.cell_first[row + (size_t)i1 + 1];
        if (from < to) out[count++] = (range){from, to};
    }
    return count;
}

/* The same where rows and layers may go round: of all that are next to it, in two spans each, the
 * slots behind `a`. So a pair is found once, whatever the order of storage; ghosts, which have
 * cells of their own, stand behind every `a`. */
static int ranges_around(const clast_world *w, const uint32_t *cell_first, size_t a,
                         range out[RANGES]) {
    const cell_grid *g = &w->cells.grid;
    const body_store *b = &w->bodies;
    cell_place p = cell_at(g, b->x[a], b->y[a], b->z[a]);
    cell_span x[2];
    int j[3], k[3], count = 0, spans = cells_between(&g->x, p.i - 1, p.i + 1, x);
    int rows = cells_next_to(&g->y, p.j, j), layers = cells_next_to(&g->z, p.k, k);
    for (int r = 0; r < rows * layers; r++) {
        const uint32_t *first = cell_first + row_of_cells(g, j[r % rows], k[r / rows]);
        for (int s = 0; s < spans; s++) {
            size_t from = first[x[s].first], to = first[x[s].last + 1];
            from = from > a ? from : a + 1;
            if (from < to) out[count++] = (range){from, to};
        }
    }
    return count;
}

/* Writes the slots of a range that are within reach; room for all of them. No branch, because there
 * is nothing to predict. */
CLAST_INLINE static inline size_t scan_as(const clast_world *w, size_t a, range r, int32_t *found,
                                          bool periodic) {
    const body_store *b = &w->bodies;
    vec3 at = body_position(w, a);
    double own = bound_of(w, a) + w->skin;
    size_t count = 0;
    for (size_t s = r.begin; s < r.end; s++) {
        vec3 d = v3(b->x[s] - at.x, b->y[s] - at.y, b->z[s] - at.z);
        if (periodic) d = nearest_image(&w->period, d);
        double reach = own + (w->special.one_shape ? w->largest_bound : bound_of(w, s));
        found[count] = (int32_t)s;
        count += d.x * d.x + d.y * d.y + d.z * d.z < reach * reach;
    }
    return count;
}

static size_t scan(const clast_world *w, size_t a, range r, int32_t *found) {
    return w->period.any ? scan_as(w, a, r, found, true) : scan_as(w, a, r, found, false);
}

static size_t scan_all(clast_world *w, reach_list *l, size_t a, const range *ranges, int rows,
                       size_t found) {
    for (int r = 0; r < rows; r++) {
        reserve_partners(w, l, found + (ranges[r].end - ranges[r].begin));
        found += scan(w, a, ranges[r], l->partner + found);
    }
    return found;
}

/* Which share a pair with a ghost stands in: where it is booked, or apart. */
static bool is_of_share(const clast_world *w, const share *s, size_t own, size_t ghost) {
    return (w->bodies.id[own] > w->bodies.id[ghost]) == s->across;
}

static size_t append_ghosts(clast_world *w, share *s, size_t a, size_t found) {
    range ranges[RANGES];
    int rows = ranges_around(w, w->cells.ghost_first, a, ranges);
    size_t end = scan_all(w, &s->reach, a, ranges, rows, found);
    int32_t *partner = s->reach.partner;
    for (size_t k = found; k < end; k++)
        if (is_of_share(w, s, a, (size_t)partner[k])) partner[found++] = partner[k];
    return found;
}

/* Appends the bodies ahead within reach and returns how many there are. */
static size_t append_bodies(clast_world *w, share *s, size_t a) {
    range ranges[RANGES];
    reach_list *l = &s->reach;
    size_t begin = l->count, found = begin;
    int rows = s->across       ? 0
               : w->period.any ? ranges_around(w, w->cells.cell_first, a, ranges)
                               : ranges_ahead(w, a, ranges);
    found = scan_all(w, l, a, ranges, rows, found);
    if (w->ghosts > 0) found = append_ghosts(w, s, a, found);
    return found - begin;
}

/* ---- spheres of clumps ----------------------------------------------------------------------- */

static size_t scan_spheres(const clast_world *w, size_t i, size_t body, int32_t *found) {
    const centre_row *c = w->rows.centre, *own = &c[i];
    size_t count = 0;
    for (size_t j = w->rows.first[body]; j < w->rows.first[body + 1]; j++) {
        vec3 d = separation(&w->kernel_period, centre_at(&c[j]), centre_at(own));
        double reach = own->radius + c[j].radius + w->skin;
        found[count] = (int32_t)j;
        count += d.x * d.x + d.y * d.y + d.z * d.z < reach * reach;
    }
    return count;
}

/* ---- contacts that have just moved out of reach ----------------------------------------------
 * A contact that touched at the last evaluation and is now farther apart than the skin stays: the
 * law books its end, as it would with a wider skin. */

static bool is_kept_here(const clast_world *w, const share *s, size_t sphere, size_t partner) {
    size_t a = body_of_sphere(w, sphere), b = body_of_sphere(w, partner);
    return b < w->bodies.count ? !s->across : is_of_share(w, s, a, b);
}

static void keep_touching(clast_world *w, share *s, size_t sphere, size_t begin) {
    reach_list *l = &s->reach;
    for (uint32_t k = w->carry.first[sphere]; k < w->carry.first[sphere + 1]; k++) {
        carried contact = carry_at(w, k);
        if (contact.with_wall) continue;
        size_t at = begin;
        while (at < l->count && l->partner[at] != contact.partner) at++;
        if (at < l->count) continue;
        if (w->ranks && !is_kept_here(w, s, sphere, (size_t)contact.partner)) continue;
        reserve_partners(w, l, l->count + 1);
        l->partner[l->count++] = contact.partner;
    }
}

static void build_for_sphere_body(clast_world *w, share *s, size_t slot) {
    reach_list *l = &s->reach;
    size_t begin = l->count;
    l->first[slot - s->sphere_begin] = (uint32_t)begin;
    l->count += append_bodies(w, s, slot);
    keep_touching(w, s, slot, begin);
}

static size_t bodies_ahead(clast_world *w, share *s, size_t slot) {
    reach_list *l = &s->reach;
    size_t bodies = append_bodies(w, s, slot);
    if (bodies > l->ahead_capacity) {
        size_t now = 2 * bodies;
        l->ahead = memory_grow(w, l->ahead, l->ahead_capacity, now, sizeof *l->ahead);
        l->ahead_capacity = now;
    }
    for (size_t k = 0; k < bodies; k++) l->ahead[k] = l->partner[l->count + k];
    return bodies;
}

static void build_for_clump(clast_world *w, share *s, size_t slot) {
    reach_list *l = &s->reach;
    size_t bodies = bodies_ahead(w, s, slot);
    for (size_t i = w->rows.first[slot]; i < w->rows.first[slot + 1]; i++) {
        size_t begin = l->count;
        l->first[i - s->sphere_begin] = (uint32_t)begin;
        for (size_t k = 0; k < bodies; k++) {
            size_t body = (size_t)l->ahead[k];
            size_t most = w->rows.first[body + 1] - w->rows.first[body];
            reserve_partners(w, l, l->count + most);
            l->count += scan_spheres(w, i, body, l->partner + l->count);
        }
        keep_touching(w, s, i, begin);
    }
}

/* ---- walls ----------------------------------------------------------------------------------- */

static bool is_within_reach(const clast_world *w, int wall_index, size_t sphere) {
    wall room;
    const wall *l = wall_now(w, wall_index, &room);
    const centre_row *c = &w->rows.centre[sphere];
    vec3 centre = from_kernel(w, centre_at(c));
    return wall_approach(l, image_at_wall(w, l, centre)).distance <
           c->radius + w->skin + wall_raise(l, c->radius);
}

/* Contacts with walls that are not even around the body any more. */
static void keep_touching_walls(clast_world *w, share *s, size_t sphere, size_t begin) {
    const wall_reach *l = &s->wall_reach;
    for (uint32_t k = w->carry.first[sphere]; k < w->carry.first[sphere + 1]; k++) {
        carried contact = carry_at(w, k);
        if (!contact.with_wall || !w->parts[w->walls[contact.partner].part].present) continue;
        size_t at = begin;
        while (at < l->count && l->wall[at] != contact.partner) at++;
        if (at == l->count) push_wall(w, &s->wall_reach, sphere, contact.partner);
    }
}

/* Sphere by sphere: what a sphere feels of walls hangs on all that it touches. */
static void build_walls(clast_world *w, share *s) {
    s->wall_reach.count = 0;
    for (size_t slot = s->body_begin; slot < s->body_end; slot++) {
        double bound = bound_of(w, slot), raise = w->special.fillets ? FILLET_RAISE * bound : 0;
        size_t count = walls_around(w, s, body_position(w, slot), bound + w->skin + raise);
        for (size_t i = first_sphere(w, slot); i < first_sphere(w, slot + 1); i++) {
            size_t begin = s->wall_reach.count;
            for (size_t k = 0; k < count; k++)
                if (is_within_reach(w, s->around[k], i))
                    push_wall(w, &s->wall_reach, i, s->around[k]);
            keep_touching_walls(w, s, i, begin);
        }
    }
}

/* Needs cells, rows and placed contacts. */
void reach_build(clast_world *w, share *s) {
    reach_list *l = &s->reach;
    size_t spheres = s->sphere_end - s->sphere_begin;
    l->count = 0;
    reserve_first(w, l, spheres);
    for (size_t slot = s->body_begin; slot < s->body_end; slot++) {
        if (w->special.clumps)
            build_for_clump(w, s, slot);
        else
            build_for_sphere_body(w, s, slot);
    }
    l->first[spheres] = (uint32_t)l->count;
    if (!s->across) build_walls(w, s);
}

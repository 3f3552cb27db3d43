/* near.c - the contact list: pairs of the reach list that touch or are closer than the margin, and
 * the ones whose end has not been booked yet. Made anew with the reach list (histories come by name
 * from the records) and refreshed from it, in place, when something has moved half the margin. Not
 * observable. */
#include <string.h>

#include "engine/geometry.h"
#include "engine/parallel.h"

enum { ROOM_BEHIND = 64 }; /* a pass works on whole batches */

static size_t number_size(const clast_world *w) {
    return w->def.precision == CLAST_PRECISION_MIXED ? sizeof(float) : sizeof(double);
}

/* ---- entries --------------------------------------------------------------------------------- */

void contact_reserve(clast_world *w, contact_list *l, size_t count) {
    if (count + ROOM_BEHIND <= l->capacity) return;
    size_t old = l->capacity, now = count + count / 8 + 2 * ROOM_BEHIND;
    l->a = memory_grow(w, l->a, old, now, sizeof *l->a);
    l->b = memory_grow(w, l->b, old, now, sizeof *l->b);
    for (int k = 0; k < HISTORY_COLUMNS; k++)
        l->column[k] = memory_grow(w, l->column[k], old, now, number_size(w));
    l->capacity = now;
}

static double column_at(const clast_world *w, const contact_list *l, int k, size_t i) {
    if (w->def.precision == CLAST_PRECISION_MIXED) return (double)((const float *)l->column[k])[i];
    return ((const double *)l->column[k])[i];
}

static void set_column(const clast_world *w, contact_list *l, int k, size_t i, double value) {
    if (w->def.precision == CLAST_PRECISION_MIXED)
        ((float *)l->column[k])[i] = (float)value;
    else
        ((double *)l->column[k])[i] = value;
}

bool contact_touches(const clast_world *w, const contact_list *l, size_t i) {
    return column_at(w, l, 0, i) > 0;
}

static bool name_is_reversed(const clast_world *w, const contact_list *l, size_t i) {
    size_t a = body_of_sphere(w, (size_t)l->a[i]), b = body_of_sphere(w, (size_t)l->b[i]);
    return w->bodies.id[a] > w->bodies.id[b];
}

/* As seen by the body of lower id, or by the body where b is a wall. */
history contact_history(const clast_world *w, const contact_list *l, size_t i, bool with_wall) {
    vec3 spring = v3(column_at(w, l, 2, i), column_at(w, l, 3, i), column_at(w, l, 4, i));
    double sign = !with_wall && name_is_reversed(w, l, i) ? -1 : 1;
    spring = v3_scale(sign, from_kernel(w, spring));
    /* adding nothing makes one zero of two: the sign of a zero hangs on who was a */
    return (history){column_at(w, l, 0, i), column_at(w, l, 1, i), v3_add(spring, v3(0, 0, 0))};
}

void contact_clear_spring(clast_world *w, contact_list *l, size_t i) {
    for (int k = 2; k < HISTORY_COLUMNS; k++) set_column(w, l, k, i, 0);
}

static void push(clast_world *w, contact_list *l, int32_t a, int32_t b, bool with_wall,
                 const history *h) {
    contact_reserve(w, l, l->count + 1);
    size_t i = l->count++;
    l->a[i] = a, l->b[i] = b;
    double sign = !with_wall && name_is_reversed(w, l, i) ? -1 : 1;
    vec3 spring = h ? to_kernel(w, v3_scale(sign, h->spring)) : v3(0, 0, 0);
    double values[HISTORY_COLUMNS] = {h ? h->overlap : 0, h ? h->normal : 0, spring.x, spring.y,
                                      spring.z};
    for (int k = 0; k < HISTORY_COLUMNS; k++) set_column(w, l, k, i, values[k]);
}

/* ---- who is near ----------------------------------------------------------------------------- */

static bool spheres_are_near(const clast_world *w, size_t i, size_t j) {
    const centre_row *a = &w->rows.centre[i], *b = &w->rows.centre[j];
    double dx = a->x - b->x, dy = a->y - b->y, dz = a->z - b->z;
    double reach = a->radius + b->radius + w->margin;
    return !(dx * dx + dy * dy + dz * dz >= reach * reach);
}

static bool wall_is_near(const clast_world *w, size_t sphere, int wall_index) {
    const wall *l = &w->walls[wall_index];
    const centre_row *c = &w->rows.centre[sphere];
    if (!w->parts[l->part].present) return false;
    vec3 centre = from_kernel(w, v3(c->x, c->y, c->z));
    return !(wall_approach(l, centre).distance >= c->radius + w->margin);
}

/* ---- made anew, histories from the records --------------------------------------------------- */

static const history *history_of(const clast_world *w, size_t sphere, size_t partner) {
    const record_list *r = &w->records;
    for (uint32_t k = r->first[sphere]; k < r->first[sphere + 1]; k++) {
        const contact_record *record = &r->items[r->order[k]];
        if (record->b >= CLAST_WALL_ID) continue;
        size_t a = first_sphere(w, (size_t)w->slot_of_id[record->a]) + (size_t)record->sphere_a;
        size_t b = first_sphere(w, (size_t)w->slot_of_id[record->b]) + (size_t)record->sphere_b;
        if ((a == sphere && b == partner) || (b == sphere && a == partner)) return &record->history;
    }
    return NULL;
}

static const history *history_of_wall(const clast_world *w, size_t sphere, int wall_index) {
    const record_list *r = &w->records;
    for (uint32_t k = r->first[sphere]; k < r->first[sphere + 1]; k++) {
        const contact_record *record = &r->items[r->order[k]];
        if (record->b == CLAST_WALL_ID + (uint32_t)wall_index) return &record->history;
    }
    return NULL;
}

static void build(clast_world *w, share *s) {
    const reach_list *l = &s->reach;
    s->contacts.count = s->walls.count = 0;
    for (size_t i = s->sphere_begin; i < s->sphere_end; i++)
        for (uint32_t k = l->first[i - s->sphere_begin]; k < l->first[i - s->sphere_begin + 1];
             k++) {
            size_t j = (size_t)l->partner[k];
            const history *h = history_of(w, i, j);
            if (!h && !spheres_are_near(w, i, j)) continue;
            push(w, &s->contacts, (int32_t)i, (int32_t)j, false, h);
        }
    for (size_t k = 0; k < s->wall_reach.count; k++) {
        int32_t i = s->wall_reach.sphere[k], l_index = s->wall_reach.wall[k];
        const history *h = history_of_wall(w, (size_t)i, l_index);
        if (h || wall_is_near(w, (size_t)i, l_index)) push(w, &s->walls, i, l_index, true, h);
    }
}

/* ---- refreshed in place ----------------------------------------------------------------------
 * The old entries are pushed to the end of their room and read from there, in the order of the
 * reach list, while the new ones are written from the front. */

typedef struct refresh {
    contact_list *l;
    size_t read, end, write;
} refresh;

static void move_entries(const clast_world *w, contact_list *l, size_t to, size_t from, size_t n) {
    size_t size = number_size(w);
    memmove(l->a + to, l->a + from, n * sizeof *l->a);
    memmove(l->b + to, l->b + from, n * sizeof *l->b);
    for (int k = 0; k < HISTORY_COLUMNS; k++)
        memmove((char *)l->column[k] + to * size, (char *)l->column[k] + from * size, n * size);
}

static void push_back(clast_world *w, refresh *r, size_t room) {
    contact_list *l = r->l;
    size_t left = r->end - r->read;
    contact_reserve(w, l, r->write + left + room);
    size_t end = l->capacity;
    move_entries(w, l, end - left, r->read, left);
    r->read = end - left, r->end = end;
}

static void refresh_pair(clast_world *w, refresh *r, int32_t a, int32_t b, bool near) {
    contact_list *l = r->l;
    bool known = r->read < r->end && l->a[r->read] == a && l->b[r->read] == b;
    if (!near && !(known && contact_touches(w, l, r->read))) {
        r->read += known;
        return;
    }
    if (known) {
        if (r->write != r->read) move_entries(w, l, r->write, r->read, 1);
        r->read++;
    } else {
        if (r->write == r->read) push_back(w, r, 1 + (r->end - r->read) / 8);
        l->a[r->write] = a, l->b[r->write] = b;
        for (int k = 0; k < HISTORY_COLUMNS; k++) set_column(w, l, k, r->write, 0);
    }
    r->write++;
}

static refresh refresh_begin(clast_world *w, contact_list *l) {
    refresh r = {l, 0, l->count, 0};
    push_back(w, &r, ROOM_BEHIND);
    return r;
}

static void refresh_end(clast_world *w, const refresh *r) {
    r->l->count = r->write;
    contact_reserve(w, r->l, r->write); /* the old entries may have stood in the room behind */
}

static void refresh_share(clast_world *w, share *s) {
    const reach_list *l = &s->reach;
    refresh r = refresh_begin(w, &s->contacts);
    for (size_t i = s->sphere_begin; i < s->sphere_end; i++)
        for (uint32_t k = l->first[i - s->sphere_begin]; k < l->first[i - s->sphere_begin + 1]; k++)
            refresh_pair(w, &r, (int32_t)i, l->partner[k],
                         spheres_are_near(w, i, (size_t)l->partner[k]));
    refresh_end(w, &r);
    r = refresh_begin(w, &s->walls);
    for (size_t k = 0; k < s->wall_reach.count; k++) {
        int32_t i = s->wall_reach.sphere[k], wall_index = s->wall_reach.wall[k];
        refresh_pair(w, &r, i, wall_index, wall_is_near(w, (size_t)i, wall_index));
    }
    refresh_end(w, &r);
}

/* ---- loads that reach beyond the share ------------------------------------------------------- */

static void reserve_overhang(clast_world *w, share *s) {
    size_t last = s->body_end;
    for (size_t k = 0; k < s->reach.count; k++) {
        size_t body = body_of_sphere(w, (size_t)s->reach.partner[k]);
        last = body + 1 > last ? body + 1 : last;
    }
    s->overhang_count = last - s->body_end;
    if (s->overhang_count <= s->overhang_capacity) return;
    size_t now = s->overhang_count + s->overhang_count / 4;
    s->overhang = memory_lines(w, s->overhang, s->overhang_capacity * sizeof *s->overhang,
                               now * sizeof *s->overhang);
    s->overhang_capacity = now;
}

/* ---- the whole ------------------------------------------------------------------------------- */

static void rebuild_share(void *context, int thread) {
    clast_world *w = context;
    share *s = &w->shares[thread];
    reach_build(w, s);
    build(w, s);
    if (w->threads > 1) reserve_overhang(w, s);
}

/* Steps between two rebuilds or refreshes, and the share of a radius that suits them: what is done
 * often gets a wider skin. Never observable. */
static double tuned(double skin, uint64_t steps, uint64_t few, uint64_t many, double least,
                    double most) {
    if (steps < few) skin *= 1.25;
    if (steps > many) skin *= 0.9;
    return skin < least ? least : skin > most ? most : skin;
}

static void tune(clast_world *w, uint64_t since_reach) {
    double r = w->smallest_radius;
    if (w->def.skin == 0 && w->prepared && since_reach > 0)
        w->skin = tuned(w->skin, since_reach, 100, 400, 0.08 * r, 0.5 * r);
    if (w->margin > w->skin) w->margin = w->skin;
}

/* Needs w->records to hold the contacts that touched at the last evaluation. */
void lists_rebuild(clast_world *w) {
    tune(w, w->step - w->steps_reach);
    if (w->bodies.count > 0) cells_sort(w, 2 * w->largest_bound + w->skin);
    rows_layout(w);
    rows_fill(w, 0, w->bodies.count);
    records_place(w);
    shares_cut(w);
    parallel_run(w->threads, rebuild_share, w);
    w->way_reach = w->way_contacts = 0;
    w->steps_reach = w->steps_contacts = w->step;
    w->stale = false;
    w->counters.rebuilds++;
}

static void refresh_thread(void *context, int thread) {
    clast_world *w = context;
    refresh_share(w, &w->shares[thread]);
}

void lists_refresh(clast_world *w) {
    double r = w->smallest_radius, most = w->skin < 0.1 * r ? w->skin : 0.1 * r;
    w->margin = tuned(w->margin, w->step - w->steps_contacts, 12, 40, 0.001 * r, most);
    parallel_run(w->threads, refresh_thread, w);
    w->way_contacts = 0;
    w->steps_contacts = w->step;
    w->counters.refreshes++;
}

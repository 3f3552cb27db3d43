/* near.c - the contact list: pairs of the reach list that touch or are closer than the margin, and
 * the ones whose end has not been booked yet. Made anew with the reach list (histories come from
 * the list before, carry.c) and refreshed from it, in place, when something has moved half the
 * margin. Not observable. */
#include <string.h>

#include "engine/geometry.h"
#include "engine/parallel.h"
#include "engine/periodic.h"
#include "engine/ranks.h"
#include "engine/facets.h"
#include "engine/world.h"

/* ---- who is near ----------------------------------------------------------------------------- */

static bool spheres_are_near(const clast_world *w, size_t i, size_t j) {
    const centre_row *a = &w->rows.centre[i], *b = &w->rows.centre[j];
    vec3 d = separation(&w->kernel_period, centre_at(a), centre_at(b));
    double reach = a->radius + b->radius + w->margin;
    return !(d.x * d.x + d.y * d.y + d.z * d.z >= reach * reach);
}

static bool wall_is_near(const clast_world *w, size_t sphere, int wall_index) {
    wall room;
    const wall *l = wall_now(w, wall_index, &room);
    const centre_row *c = &w->rows.centre[sphere];
    if (!w->parts[l->part].present) return false;
    vec3 centre = image_at_wall(w, l, from_kernel(w, centre_at(c)));
    return !(wall_approach(l, centre).distance >= c->radius + w->margin + wall_raise(l, c->radius));
}

/* ---- made anew -------------------------------------------------------------------------------
 * First who, and where the history of each stands in the lists before; then the histories, one
 * column at a time, so that there is only one column twice at any moment. */

static void find(clast_world *w, found_list *f, size_t a, size_t b, uint32_t source) {
    if (f->count == f->capacity) {
        size_t old = f->capacity, now = old + old / 8 + 1024;
        f->a = memory_grow(w, f->a, old, now, sizeof *f->a);
        f->b = memory_grow(w, f->b, old, now, sizeof *f->b);
        f->source = memory_grow(w, f->source, old, now, sizeof *f->source);
        f->capacity = now;
    }
    f->a[f->count] = (int32_t)a, f->b[f->count] = (int32_t)b, f->source[f->count] = source;
    f->count++;
}

static void find_contacts(clast_world *w, share *s) {
    const reach_list *l = &s->reach;
    for (size_t i = s->sphere_begin; i < s->sphere_end; i++)
        for (uint32_t k = l->first[i - s->sphere_begin]; k < l->first[i - s->sphere_begin + 1];
             k++) {
            size_t j = (size_t)l->partner[k];
            uint32_t source = carry_find(w, i, l->partner[k], false);
            if (source == NOT_CARRIED && !spheres_are_near(w, i, j)) continue;
            find(w, &s->found[0], i, j, source);
        }
    for (size_t k = 0; k < s->wall_reach.count; k++) {
        size_t i = (size_t)s->wall_reach.sphere[k];
        int wall_index = s->wall_reach.wall[k];
        uint32_t source = carry_find(w, i, wall_index, true);
        if (source == NOT_CARRIED && !wall_is_near(w, i, wall_index)) continue;
        find(w, &s->found[1], i, (size_t)wall_index, source);
    }
}

/* The found entries become the list; the columns are empty. */
static void adopt(clast_world *w, contact_list *l, found_list *f) {
    size_t room = entry_room(f->count), old = f->capacity > room ? room : f->capacity;
    l->a = memory_grow(w, f->a, old, room, sizeof *l->a);
    l->b = memory_grow(w, f->b, old, room, sizeof *l->b);
    memory_return(w, 2 * (f->capacity - old) * sizeof *l->a);
    l->count = f->count, l->capacity = room;
    for (size_t k = f->count; k < room; k++) l->a[k] = l->b[k] = 0;
}

static void fill_column(clast_world *w, contact_list *l, const found_list *f, int column) {
    size_t size = entry_number_size(w);
    char *to = memory_grow(w, NULL, 0, l->capacity, size);
    for (size_t k = 0; k < f->count; k++)
        if (f->source[k] != NOT_CARRIED)
            memcpy(to + k * size, carry_number(w, f->source[k], column), size);
    l->column[column] = to;
}

typedef struct column_order {
    clast_world *w;
    int column;
} column_order;

static void fill_share(void *context, int thread) {
    const column_order *o = context;
    for (int t = thread; t < o->w->lists; t += o->w->threads) {
        share *s = &o->w->shares[t];
        fill_column(o->w, &s->contacts, &s->found[0], o->column);
        fill_column(o->w, &s->walls, &s->found[1], o->column);
    }
}

static void forget_found(clast_world *w, found_list *f) {
    memory_return(w, f->capacity * sizeof *f->source);
    memory_release(f->source);
    *f = (found_list){0};
}

static void take_histories(clast_world *w) {
    carry_drop_places(w);
    for (int k = 0; k < w->history_columns; k++) {
        column_order o = {w, k};
        parallel_run(w->threads, fill_share, &o);
        carry_drop_column(w, k);
    }
    for (int t = 0; t < w->lists; t++) {
        forget_found(w, &w->shares[t].found[0]);
        forget_found(w, &w->shares[t].found[1]);
    }
    carry_end(w);
}

/* ---- refreshed in place ----------------------------------------------------------------------
 * The old entries are pushed to the end of their room and read from there, in the order of the
 * reach list, while the new ones are written from the front. */

typedef struct refresh {
    contact_list *l;
    size_t read, end, write;
} refresh;

static void push_back(clast_world *w, refresh *r, size_t room) {
    contact_list *l = r->l;
    size_t left = r->end - r->read;
    entry_reserve(w, l, r->write + left + room);
    size_t end = l->capacity;
    entry_move(w, l, end - left, r->read, left);
    r->read = end - left, r->end = end;
}

/* One entry; a call of memmove() for each number would cost more than all the rest. */
static void move_one(const clast_world *w, contact_list *l, size_t to, size_t from) {
    l->a[to] = l->a[from], l->b[to] = l->b[from];
    for (int k = 0; k < w->history_columns; k++) {
        if (w->def.precision == CLAST_PRECISION_MIXED)
            ((float *)l->column[k])[to] = ((float *)l->column[k])[from];
        else
            ((double *)l->column[k])[to] = ((double *)l->column[k])[from];
    }
}

static void refresh_pair(clast_world *w, refresh *r, int32_t a, int32_t b, bool near) {
    contact_list *l = r->l;
    bool known = r->read < r->end && l->a[r->read] == a && l->b[r->read] == b;
    if (!near && !(known && contact_touches(w, l, r->read))) {
        r->read += known;
        return;
    }
    if (known) {
        if (r->write != r->read) move_one(w, l, r->write, r->read);
        r->read++;
    } else {
        if (r->write == r->read) push_back(w, r, 1 + (r->end - r->read) / 8);
        l->a[r->write] = a, l->b[r->write] = b;
        entry_clear(w, l, r->write);
    }
    r->write++;
}

static refresh refresh_begin(clast_world *w, contact_list *l) {
    refresh r = {l, 0, l->count, 0};
    push_back(w, &r, ENTRIES_BEHIND);
    return r;
}

static void refresh_end(clast_world *w, const refresh *r) {
    r->l->count = r->write;
    entry_reserve(w, r->l, r->write);
    entries_clear_behind(w, r->l); /* the old entries may have stood there */
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

/* The last body that a share loads, and one more: of all, and of those that are this process' own.
 */
typedef struct beyond {
    size_t own, all;
} beyond;

static void look_beyond(const clast_world *w, const share *s, beyond *last) {
    for (size_t k = 0; k < s->reach.count; k++) {
        size_t body = body_of_sphere(w, (size_t)s->reach.partner[k]) + 1;
        last->all = body > last->all ? body : last->all;
        if (body <= w->bodies.count && body > last->own) last->own = body;
    }
}

/* Loads of ghosts stand behind those of own bodies, and nobody reads them. */
static void reserve_overhang(clast_world *w, share *s, share *across) {
    beyond last = {s->body_end, s->body_end};
    look_beyond(w, s, &last);
    if (across) look_beyond(w, across, &last);
    s->overhang_count = last.own - s->body_end;
    size_t need = last.all - s->body_end;
    if (need > s->overhang_capacity) {
        size_t now = need + need / 4;
        s->overhang = memory_lines(w, s->overhang, s->overhang_capacity * sizeof *s->overhang,
                                   now * sizeof *s->overhang);
        s->overhang_capacity = now;
    } else if (across && s->overhang) {
        memset(s->overhang, 0, s->overhang_capacity * sizeof *s->overhang); /* no ghost's */
    }
    if (across) across->overhang = s->overhang;
}

/* ---- the whole ------------------------------------------------------------------------------- */

static void rebuild_list(clast_world *w, share *s) {
    reach_build(w, s);
    find_contacts(w, s);
    adopt(w, &s->contacts, &s->found[0]);
    adopt(w, &s->walls, &s->found[1]);
    facets_reserve(w, s);
    shared_group(w, s);
}

static void rebuild_share(void *context, int thread) {
    clast_world *w = context;
    share *s = &w->shares[thread], *across = w->ranks ? s + w->threads : NULL;
    rebuild_list(w, s);
    if (across) rebuild_list(w, across);
    if (w->threads > 1 || across) reserve_overhang(w, s, across);
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
        w->skin = fmin(tuned(w->skin, since_reach, 100, 400, 0.08 * r, 0.5 * r), w->most_skin);
    if (w->margin > w->skin) w->margin = w->skin;
}

/* Needs the contacts that touched at the last evaluation to be carried. */
void lists_rebuild(clast_world *w) {
    tune(w, w->step - w->steps_reach);
    way_forget(w);
    if (w->bodies.count > 0) cells_sort(w, 2 * w->largest_bound + w->skin);
    w->cells.bodies = w->bodies.count;
    ranks_list_ghosts(w);
    rows_layout(w);
    rows_fill(w, 0, w->bodies.count + w->ghosts);
    shares_fit(w);
    carry_place(w);
    shares_cut(w);
    parallel_run(w->threads, rebuild_share, w);
    walls_list_near(w);
    take_histories(w);
    way_restart(w, true);
    way_remember(w);
    w->steps_reach = w->steps_contacts = w->step;
    w->stale = false;
    ranks_count_all(w);
    w->counters.rebuilds++;
}

static void refresh_thread(void *context, int thread) {
    clast_world *w = context;
    for (int t = thread; t < w->lists; t += w->threads) {
        refresh_share(w, &w->shares[t]);
        facets_reserve(w, &w->shares[t]);
        shared_group(w, &w->shares[t]);
    }
}

void lists_refresh(clast_world *w) {
    double r = w->smallest_radius, most = w->skin < 0.1 * r ? w->skin : 0.1 * r;
    w->margin = tuned(w->margin, w->step - w->steps_contacts, 16, 60, 0.001 * r, most);
    parallel_run(w->threads, refresh_thread, w);
    way_restart(w, false);
    way_remember(w);
    w->steps_contacts = w->step;
    w->counters.refreshes++;
}

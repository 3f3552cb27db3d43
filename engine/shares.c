/* shares.c - which thread owns which bodies. Ranges of storage order, cut so that contacts are
 * about equal in number; the cut is not observable. */
#include <string.h>

#include "engine/parallel.h"
#include "engine/ranks.h"
#include "engine/world.h"

static void free_contacts(contact_list *l) {
    memory_release(l->a), memory_release(l->b);
    for (int k = 0; k < HISTORY_COLUMNS; k++) memory_release(l->column[k]);
}

void shares_free(clast_world *w) {
    for (int t = 0; t < w->share_room; t++) {
        share *s = &w->shares[t];
        if (s->across) s->overhang = NULL; /* that of the share before */
        memory_release(s->reach.partner), memory_release(s->reach.first);
        memory_release(s->reach.ahead);
        memory_release(s->wall_reach.sphere), memory_release(s->wall_reach.wall);
        free_contacts(&s->contacts), free_contacts(&s->walls);
        memory_release(s->overhang), memory_release(s->around), memory_release(s->touches);
        shared_free(s);
    }
    memory_release(w->shares), memory_release(w->push_room), memory_release(w->pass_record);
    memory_release(w->push_row_room);
    w->shares = NULL, w->push_room = NULL, w->pass_record = NULL, w->push_row_room = NULL;
    w->threads = w->lists = w->share_room = 0;
}

/* ---- how many -------------------------------------------------------------------------------- */

static size_t push_rows(const clast_world *w) {
    return (size_t)w->part_count + NOBODYS_ROWS;
}

static void make_room(clast_world *w, int lists) {
    size_t old = (size_t)w->share_room, now = (size_t)lists, rows = push_rows(w);
    bool first = !w->push_room;
    share *more = memory_lines(w, NULL, old * sizeof *more, now * sizeof *more);
    if (old > 0) memcpy(more, w->shares, old * sizeof *more);
    memory_release(w->shares);
    w->shares = more;
    w->push_room =
        memory_grow(w, w->push_room, first ? 0 : old * rows, now * rows, sizeof *w->push_room);
    w->push_row_room = memory_lines(w, w->push_row_room, old * rows * sizeof *w->push_row_room,
                                    now * rows * sizeof *w->push_row_room);
    w->share_room = lists;
}

/* Loads beyond the share: of own bodies' shares alone, the others have those of the share before.
 */
static void drop_overhang(clast_world *w, share *s) {
    if (!s->across) {
        memory_return(w, s->overhang_capacity * sizeof *s->overhang);
        memory_release(s->overhang);
    }
    s->overhang = NULL;
    s->overhang_capacity = s->overhang_count = 0;
}

/* Between carry_lists() or carry_records() and shares_cut(): then a share is room and no more, and
 * may be any thread's. Shares that are not in use keep their room. */
static void use(clast_world *w, int threads) {
    int lists = w->ranks ? 2 * threads : threads;
    for (int t = 0; t < w->share_room; t++) drop_overhang(w, &w->shares[t]);
    if (lists > w->share_room) make_room(w, lists);
    w->threads = threads, w->lists = lists;
    for (int t = 0; t < w->share_room; t++) {
        share *s = &w->shares[t];
        s->across = t >= threads && t < lists;
        size_t row = (size_t)(t % threads) * push_rows(w);
        s->pushes = w->push_room + row, s->push_rows = w->push_row_room + row;
        s->reach.count = s->wall_reach.count = 0;
    }
}

void shares_make(clast_world *w) {
    shares_free(w);
    size_t numbers = PASS_NUMBERS + (size_t)w->part_count * PART_NUMBERS;
    w->pass_record = memory_grow(w, NULL, 0, numbers, sizeof(double));
    use(w, 1);
}

static int most_threads(const clast_world *w) {
    if (w->def.threads > 0) return w->def.threads;
    int cores = parallel_max_threads() / (w->ranks ? ranks_beside() : 1);
    return cores > 1 ? cores : 1;
}

/* A thread too many is kept until a fifth of what keeps it busy is missing: a bed whose size goes
 * up and down by a few spheres does not change all the time. */
static int threads_that_pay(const clast_world *w) {
    size_t each = (size_t)w->def.spheres_per_thread, spheres = w->sphere_count;
    size_t most = (size_t)most_threads(w), now = (size_t)w->threads;
    size_t pay = spheres / each;
    if (pay < now && 5 * spheres >= 4 * each * now) pay = now;
    return (int)(pay < 1 ? 1 : pay > most ? most : pay);
}

/* As many threads as pay for the spheres that there are, by count and never by the clock. Needs
 * rows laid out. Schemes beside the leapfrog keep lists by thread: they stay with what they began
 * with. */
void shares_fit(clast_world *w) {
    if (w->integrator && w->prepared) return;
    int threads = threads_that_pay(w);
    if (threads != w->threads) use(w, threads);
}

/* ---- who has what ---------------------------------------------------------------------------- */

/* Work of a body: its spheres and, twice as dear, the contacts that it owns. */
static size_t work_of(const clast_world *w, size_t slot) {
    size_t from = first_sphere(w, slot), to = first_sphere(w, slot + 1);
    return (to - from) + 2 * (w->carry.first[to] - w->carry.first[from]);
}

/* Needs rows laid out and carried contacts placed. */
void shares_cut(clast_world *w) {
    size_t n = w->bodies.count, all = 0, done = 0, slot = 0;
    for (size_t i = 0; i < n; i++) all += work_of(w, i);
    for (int t = 0; t < w->threads; t++) {
        share *s = &w->shares[t];
        size_t target = all * ((size_t)t + 1) / (size_t)w->threads;
        s->body_begin = slot;
        while (slot < n && (done < target || t == w->threads - 1)) done += work_of(w, slot++);
        s->body_end = slot;
        s->sphere_begin = first_sphere(w, s->body_begin);
        s->sphere_end = first_sphere(w, s->body_end);
    }
    for (int t = w->threads; t < w->lists; t++) {
        const share *from = &w->shares[t - w->threads];
        share *s = &w->shares[t];
        s->body_begin = from->body_begin, s->body_end = from->body_end;
        s->sphere_begin = from->sphere_begin, s->sphere_end = from->sphere_end;
    }
}

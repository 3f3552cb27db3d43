/* shares.c - which thread owns which bodies. Ranges of storage order, cut so that contacts are
 * about equal in number; the cut is not observable. */
#include <string.h>

#include "engine/world.h"

static void free_contacts(contact_list *l) {
    memory_release(l->a), memory_release(l->b);
    for (int k = 0; k < HISTORY_COLUMNS; k++) memory_release(l->column[k]);
}

void shares_free(clast_world *w) {
    for (int t = 0; t < w->lists; t++) {
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
    w->shares = NULL, w->push_room = NULL, w->pass_record = NULL;
}

void shares_make(clast_world *w, int threads) {
    shares_free(w);
    w->threads = threads, w->lists = w->ranks ? 2 * threads : threads;
    size_t count = (size_t)w->lists, parts = (size_t)w->part_count;
    w->shares = memory_lines(w, NULL, 0, count * sizeof *w->shares);
    w->push_room = memory_grow(w, NULL, 0, (size_t)threads * parts + 1, sizeof *w->push_room);
    w->pass_record = memory_grow(w, NULL, 0, PASS_NUMBERS + parts * PART_NUMBERS, sizeof(double));
    for (int t = 0; t < w->lists; t++) {
        w->shares[t].across = t >= threads;
        w->shares[t].pushes = w->push_room + (size_t)(t % threads) * parts;
    }
}

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

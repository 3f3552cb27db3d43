/* ranks.c - the life of a shared world, and what its processes agree on. */
#include "engine/ranks.h"

#include <stdlib.h>
#include <string.h>

const rank_transport *ranks_transport;
size_t ranks_piece = (size_t)1 << 30;

int clast_ranks_number(void) {
    return ranks_transport ? ranks_transport->number : 0;
}

int clast_ranks_count(void) {
    return ranks_transport ? ranks_transport->count : 1;
}

double clast_ranks_most(double value) {
    if (ranks_transport) ranks_transport->reduce(&value, 1, 0);
    return value;
}

void clast_ranks_tell(void *bytes, size_t size) {
    if (ranks_transport) ranks_transport->tell(bytes, size, 0);
}

int ranks_beside(void) {
    return ranks_transport ? ranks_transport->beside : 1;
}

/* ---- life ------------------------------------------------------------------------------------ */

static const char *what_is_refused(const clast_world *w) {
    if (w->def.scheme != CLAST_SCHEME_LEAPFROG)
        return "a scheme beside the leapfrog runs on one process: it looks at all bodies at once";
    if (w->def.law == CLAST_LAW_USER)
        return "a law of the user's own runs on one process: nothing says that it changes its sign "
               "exactly when two bodies change places";
    return NULL;
}

/* Before threads are chosen. */
clast_status ranks_join(clast_world *w) {
    if (!ranks_transport || w->def.alone || w->ranks) return CLAST_OK;
    const char *refused = what_is_refused(w);
    if (refused) return (clast_status)world_fail(w, CLAST_ERR_ARGUMENT, "%s", refused);
    size_t count = (size_t)ranks_transport->count;
    ranks *r = w->ranks = memory_grow(w, NULL, 0, 1, sizeof *r);
    r->by = ranks_transport;
    r->boxes = memory_grow(w, NULL, 0, count, sizeof *r->boxes);
    size_t **sizes[] = {&r->out_bodies, &r->in_bodies, &r->out_bytes, &r->in_bytes};
    for (int i = 0; i < 4; i++) *sizes[i] = memory_grow(w, NULL, 0, count, sizeof **sizes[i]);
    return CLAST_OK;
}

void ranks_leave(clast_world *w) {
    ranks *r = w->ranks;
    if (!r) return;
    for (int k = 0; k < RANK_READS; k++) free(r->read[k]);
    free(r->boxes), free(r->out_slot), free(r->in_slot), free(r->out), free(r->in);
    free(r->out_bodies), free(r->in_bodies), free(r->out_bytes), free(r->in_bytes);
    free(r);
    w->ranks = NULL;
}

/* ---- agreeing -------------------------------------------------------------------------------- */

void ranks_reduce(const clast_world *w, double *values, int most, int sums) {
    if (w->ranks) w->ranks->by->reduce(values, most, sums);
}

void ranks_sum(const clast_world *w, exact_sum *sums, int count) {
    _Static_assert(sizeof *sums == 2 * sizeof(double), "a sum is two numbers that add up");
    if (w->ranks) w->ranks->by->reduce(&sums->coarse, 0, 2 * count);
}

void ranks_add_words(const clast_world *w, uint64_t *words, int count) {
    if (w->ranks) w->ranks->by->add_words(words, count);
}

/* In the middle of a step: the ways of the fastest body and wall, whether somebody is outside,
 * whether lists have to be made. From here on all processes judge their lists alike, so that none
 * waits for the others where they do not come. */
void ranks_agree(clast_world *w) {
    if (!w->ranks) return;
    double says[4] = {w->found.way, w->wall_way, w->found.outside, w->stale};
    w->ranks->by->reduce(says, 4, 0);
    w->found.way = says[0], w->wall_way = says[1];
    w->found.outside = says[2] > 0, w->stale = says[3] > 0;
}

void ranks_count_all(clast_world *w) {
    double count[2] = {(double)w->bodies.count, (double)w->sphere_count};
    if (!w->ranks) return;
    w->ranks->by->reduce(count, 0, 2);
    w->ranks->bodies = (size_t)count[0], w->ranks->spheres = (size_t)count[1];
}

bool ranks_speaks(const clast_world *w) {
    return !w->ranks || w->ranks->by->number == 0;
}

void ranks_elect(const clast_world *w, double *keys, int count, char *text, size_t room) {
    if (!w->ranks) return;
    const rank_transport *t = w->ranks->by;
    bool in = true;
    for (int k = 0; k < count; k++) {
        double most = in ? keys[k] : -INFINITY;
        t->reduce(&most, 1, 0);
        in = in && keys[k] == most;
        keys[k] = most;
    }
    double first = in ? -(double)t->number : -(double)t->count;
    t->reduce(&first, 1, 0);
    t->tell(text, room, (int)-first);
}

/* The first failure in the order of processes is that of all. */
clast_status ranks_agree_status(clast_world *w, clast_status status) {
    if (!w->ranks) return status;
    double failed = status != CLAST_OK;
    ranks_elect(w, &failed, 1, w->error, sizeof w->error);
    if (failed == 0) return status;
    double worst = (double)status;
    w->ranks->by->reduce(&worst, 1, 0);
    return (clast_status)worst;
}

void *ranks_gather(const clast_world *w, const void *own, size_t count, size_t size, size_t *all) {
    if (!w->ranks) {
        void *copy = malloc(count * size + 1);
        CLAST_ASSERT(copy);
        if (count > 0) memcpy(copy, own, count * size);
        *all = count;
        return copy;
    }
    const rank_transport *t = w->ranks->by;
    size_t *sizes = malloc((size_t)t->count * sizeof *sizes), bytes = 0;
    CLAST_ASSERT(sizes);
    char *what = t->gather(own, count * size, sizes);
    for (int q = 0; q < t->count; q++) bytes += sizes[q];
    free(sizes);
    *all = bytes / size;
    return what;
}

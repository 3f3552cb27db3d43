/* ranks_read.c - what readers see of a shared world: everything, on every process. Valid until the
 * next such reading. */
#include <stdlib.h>

#include "engine/ranks.h"

enum { READS = RANK_READS };

/* Instead of what was read into this place before. */
static const void *put(const clast_world *w, int *place, void *column) {
    ranks *r = w->ranks;
    CLAST_ASSERT(*place < READS);
    free(r->read[*place]);
    return r->read[(*place)++] = column;
}

/* An own column becomes that of all. */
#define GATHER(field)                                                                              \
    if (own.field) {                                                                               \
        size_t all;                                                                                \
        void *column = ranks_gather(w, own.field, own.count, sizeof *own.field, &all);             \
        to.field = put(w, &place, column);                                                         \
        to.count = all;                                                                            \
    }

static int32_t *filled(size_t count, int32_t value) {
    int32_t *column = malloc((count + 1) * sizeof *column);
    CLAST_ASSERT(column);
    for (size_t i = 0; i < count; i++) column[i] = value;
    return column;
}

clast_bodies ranks_bodies(clast_world *w, clast_bodies own) {
    clast_bodies to = own;
    int place = 0;
    if (!w->ranks) return own;
    int32_t *number = filled(own.count, w->ranks->by->number);
    own.rank = number;
    GATHER(id)
    GATHER(shape)
    GATHER(x) GATHER(y) GATHER(z) GATHER(qw) GATHER(qx) GATHER(qy) GATHER(qz) GATHER(vx) GATHER(vy)
        GATHER(vz) GATHER(wx) GATHER(wy) GATHER(wz) GATHER(mass) GATHER(rank) GATHER(image[0])
            GATHER(image[1]) GATHER(image[2]) free(number);
    return to;
}

/* Bodies before those of this process. */
static size_t bodies_before(clast_world *w) {
    ranks *r = w->ranks;
    size_t count, before = 0, *all = ranks_gather(w, &w->bodies.count, 1, sizeof *all, &count);
    for (int q = 0; q < r->by->number; q++) before += all[q];
    free(all);
    return before;
}

clast_spheres ranks_spheres(clast_world *w, clast_spheres own) {
    clast_spheres to = own;
    int place = READS / 2;
    if (!w->ranks) return own;
    int32_t before = (int32_t)bodies_before(w);
    for (size_t i = 0; i < own.count; i++) w->view.body[i] += before;
    GATHER(x) GATHER(y) GATHER(z) GATHER(radius) GATHER(body) return to;
}

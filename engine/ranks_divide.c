/* ranks_divide.c - who has which bodies: boxes with equal counted work, made by recursive bisection
 * (Zoltan), and the bodies and their contact histories on their way to where they belong. Which
 * process has a body is not observable. */
#include <stdlib.h>
#include <string.h>

#include "engine/ranks.h"

/* ---- when ------------------------------------------------------------------------------------ */

/* Making a division costs as much as so many steps. */
enum { STEPS_OF_A_DIVISION = 50 };

/* Work of a step here: spheres and, twice as dear, what is looked at for contacts. */
double ranks_work(const clast_world *w) {
    double pairs = 0;
    for (int t = 0; t < w->lists; t++)
        pairs += (double)(w->shares[t].contacts.count + w->shares[t].walls.count);
    return (double)w->sphere_count + 2 * pairs;
}

/* Counts alone decide, never the clock: what the largest share of the work has been above the mean,
 * and the ghosts that there were beyond those of a new division, step by step, against the price of
 * a new one. Before the lists are taken apart. */
bool ranks_wish_to_divide(clast_world *w) {
    if (!w->ranks) return false;
    ranks *r = w->ranks;
    double says[3] = {ranks_work(w), 0, (double)w->ghosts};
    says[1] = says[0];
    r->by->reduce(says, 1, 2);
    double count = (double)r->by->count, mean = says[1] / count, ghosts = says[2];
    double steps = (double)(w->step - r->since);
    if (r->ghosts_new < 0) r->ghosts_new = ghosts; /* the first lists after a division */
    r->since = w->step;
    r->waste += steps * (says[0] - mean + (ghosts - r->ghosts_new) / count);
    if (r->waste < 0) r->waste = 0;
    return r->waste > STEPS_OF_A_DIVISION * mean;
}

/* ---- work ------------------------------------------------------------------------------------ */

static void add_end(const clast_world *w, float *work, uint32_t id) {
    int32_t slot = w->slot_of_id[id];
    if (slot >= 0) work[slot] += 1;
}

/* Of every own body: its spheres, and twice its share of the contacts. Needs records. */
static float *work_of_bodies(clast_world *w) {
    float *work = malloc((w->bodies.count + 1) * sizeof *work);
    CLAST_ASSERT(work);
    for (size_t i = 0; i < w->bodies.count; i++)
        work[i] = (float)w->shapes[w->bodies.shape[i]].spheres;
    for (size_t k = 0; k < w->records.count; k++) {
        const contact_record *c = &w->records.items[k];
        add_end(w, work, c->a);
        if (c->b < CLAST_WALL_ID) add_end(w, work, c->b);
    }
    return work;
}

/* ---- parcels --------------------------------------------------------------------------------- */

typedef struct parcels {
    size_t *sizes; /* bytes for each process, and of each */
    char *bytes;
} parcels;

static size_t *sizes_for(const ranks *r) {
    size_t *sizes = calloc((size_t)r->by->count, sizeof *sizes);
    CLAST_ASSERT(sizes);
    return sizes;
}

static size_t sum_of(const ranks *r, const size_t *sizes) {
    size_t sum = 0;
    for (int q = 0; q < r->by->count; q++) sum += sizes[q];
    return sum;
}

/* Parcels for all in one piece; where the next thing for each goes. */
static char **open_parcels(const ranks *r, parcels *p) {
    char **at = malloc((size_t)r->by->count * sizeof *at);
    p->bytes = malloc(sum_of(r, p->sizes) + 1);
    CLAST_ASSERT(at && p->bytes);
    char *to = p->bytes;
    for (int q = 0; q < r->by->count; q++) at[q] = to, to += p->sizes[q];
    return at;
}

static parcels send_parcels(const ranks *r, parcels *out) {
    parcels in = {.sizes = sizes_for(r)};
    in.bytes = r->by->exchange(out->bytes, out->sizes, in.sizes);
    free(out->bytes), free(out->sizes);
    return in;
}

/* ---- records -----------------------------------------------------------------------------------
 */

/* Who has a body from now on; -1 where it is not an own one. */
static int owner_of(const clast_world *w, const int *owner, uint32_t id) {
    int32_t slot = id < CLAST_WALL_ID ? w->slot_of_id[id] : -1;
    return slot < 0 ? -1 : owner[slot];
}

/* The other processes that a record goes to: none, one or two. */
static int goals_of(const clast_world *w, const int *owner, const contact_record *c, int goal[2]) {
    int self = w->ranks->by->number, count = 0;
    int a = owner_of(w, owner, c->a), b = owner_of(w, owner, c->b);
    if (a >= 0 && a != self) goal[count++] = a;
    if (b >= 0 && b != self && b != a) goal[count++] = b;
    return count;
}

static parcels send_records(clast_world *w, const int *owner) {
    const ranks *r = w->ranks;
    parcels out = {.sizes = sizes_for(r)};
    int goal[2];
    for (size_t k = 0; k < w->records.count; k++)
        for (int g = goals_of(w, owner, &w->records.items[k], goal); g-- > 0;)
            out.sizes[goal[g]] += sizeof(contact_record);
    char **at = open_parcels(r, &out);
    for (size_t k = 0; k < w->records.count; k++)
        for (int g = goals_of(w, owner, &w->records.items[k], goal); g-- > 0;) {
            memcpy(at[goal[g]], &w->records.items[k], sizeof(contact_record));
            at[goal[g]] += sizeof(contact_record);
        }
    free(at);
    return send_parcels(r, &out);
}

static bool is_here(const clast_world *w, uint32_t id) {
    return id < CLAST_WALL_ID && w->slot_of_id[id] >= 0;
}

/* Those of own bodies, each once: what two processes have sent is the same to the bit. */
static void sift_records(clast_world *w) {
    record_list *r = &w->records;
    size_t count = 0;
    records_sort(w);
    for (size_t k = 0; k < r->count; k++) {
        const contact_record *c = &r->items[k];
        if (!is_here(w, c->a) && !is_here(w, c->b)) continue;
        if (count > 0 && record_compare(c, &r->items[count - 1]) == 0) continue;
        r->items[count++] = *c;
    }
    r->count = count;
}

static void take_records(clast_world *w, parcels *in) {
    size_t more = sum_of(w->ranks, in->sizes) / sizeof(contact_record);
    records_reserve(w, w->records.count + more + 1);
    memcpy(w->records.items + w->records.count, in->bytes, more * sizeof(contact_record));
    w->records.count += more;
    free(in->bytes), free(in->sizes);
    sift_records(w);
}

/* ---- bodies ------------------------------------------------------------------------------------
 */

static void move_body(clast_world *w, size_t to, size_t from) {
    if (to == from) return;
    traveller t = ranks_body_at(w, from);
    ranks_put_body(w, to, &t);
}

/* Those that stay move up; the columns end with them. */
static void drop_others(clast_world *w, const int *owner) {
    size_t count = 0;
    for (size_t i = 0; i < w->bodies.count; i++) {
        if (owner[i] == w->ranks->by->number)
            move_body(w, count++, i);
        else
            w->slot_of_id[w->bodies.id[i]] = -1;
    }
    w->bodies.count = count;
}

static parcels send_bodies(clast_world *w, const int *owner) {
    const ranks *r = w->ranks;
    parcels out = {.sizes = sizes_for(r)};
    int self = r->by->number;
    for (size_t i = 0; i < w->bodies.count; i++)
        if (owner[i] != self) out.sizes[owner[i]] += sizeof(traveller);
    w->counters.migrated += sum_of(r, out.sizes) / sizeof(traveller);
    char **at = open_parcels(r, &out);
    for (size_t i = 0; i < w->bodies.count; i++) {
        if (owner[i] == self) continue;
        traveller t = ranks_body_at(w, i);
        memcpy(at[owner[i]], &t, sizeof t);
        at[owner[i]] += sizeof t;
    }
    free(at);
    return send_parcels(r, &out);
}

static void take_bodies(clast_world *w, parcels *in) {
    size_t more = sum_of(w->ranks, in->sizes) / sizeof(traveller);
    body_reserve(w, w->bodies.count + more);
    for (size_t k = 0; k < more; k++) {
        traveller t;
        memcpy(&t, in->bytes + k * sizeof t, sizeof t);
        ranks_put_body(w, w->bodies.count++, &t);
    }
    free(in->bytes), free(in->sizes);
}

/* ---- the whole ---------------------------------------------------------------------------------
 */

/* Boxes anew. Needs records of all contacts that an own body has, and no ghosts. */
void ranks_divide(clast_world *w) {
    ranks *r = w->ranks;
    const body_store *b = &w->bodies;
    CLAST_ASSERT(w->ghosts == 0 && w->arrived == 0);
    r->waste = 0, r->ghosts_new = -1, r->since = w->step;
    double all = (double)b->count;
    r->by->reduce(&all, 0, 1);
    if (all == 0) return;
    float *work = work_of_bodies(w);
    int *owner = malloc((b->count + 1) * sizeof *owner);
    CLAST_ASSERT(owner);
    double failed = !r->by->divide(b->count, b->x, b->y, b->z, work, owner);
    r->by->reduce(&failed, 1, 0);
    if (!(failed > 0)) {
        parcels records = send_records(w, owner), bodies = send_bodies(w, owner);
        drop_others(w, owner);
        take_bodies(w, &bodies);
        take_records(w, &records);
    }
    free(work), free(owner);
    w->counters.divisions++;
}

/* Every process has all bodies: it keeps an even piece, whichever, and the world is divided. */
void ranks_scatter(clast_world *w) {
    if (!w->ranks) return;
    size_t all = w->bodies.count, count = (size_t)w->ranks->by->count;
    int *owner = malloc((all + 1) * sizeof *owner);
    CLAST_ASSERT(owner);
    for (size_t i = 0; i < all; i++) owner[i] = (int)(i * count / all);
    drop_others(w, owner);
    free(owner);
    sift_records(w);
    ranks_divide(w);
}

/* The process whose box is nearest: the same answer everywhere. */
int ranks_nearest(const clast_world *w, vec3 place) {
    int best = 0;
    double least = INFINITY;
    for (int q = 0; w->ranks && q < w->ranks->by->count; q++) {
        double away = ranks_away(w, &w->ranks->boxes[q], place);
        if (away < least) least = away, best = q;
    }
    return best;
}

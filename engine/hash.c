/* hash.c - one number for the whole state: bodies by id, contacts by name, clock, books. FNV-1a
 * over 64-bit words with an extra mixing step: any bit of the state reaches all bits of it.
 * Bodies and contacts are hashed one by one and added up, which has no order. */
#include <string.h>

#include "engine/flow.h"
#include "engine/ranks.h"

static const uint64_t START = 0xcbf29ce484222325u;

static uint64_t mix(uint64_t hash, uint64_t word) {
    hash = (hash ^ word) * 0x100000001b3u;
    return hash ^ (hash >> 29);
}

static uint64_t mix_double(uint64_t hash, double value) {
    uint64_t word;
    memcpy(&word, &value, sizeof word);
    return mix(hash, word);
}

static uint64_t mix_vec(uint64_t hash, vec3 a) {
    return mix_double(mix_double(mix_double(hash, a.x), a.y), a.z);
}

#define mix_of(type)       mix_##type
#define mix_uint32_t(h, x) mix(h, x)
#define mix_int32_t(h, x)  mix(h, (uint64_t)(int64_t)(x))

static void add_contact(const clast_world *w, const contact_place *at, void *context) {
    contact_record r = record_of(w, at->list, at->index, at->with_wall);
    uint64_t h = mix(mix(START, r.a), r.b);
    h = mix(mix(h, (uint64_t)r.sphere_a), (uint64_t)r.sphere_b);
    h = mix_double(mix_double(h, r.history.overlap), r.history.normal);
    if (w->history_columns > HISTORY_PLASTIC) h = mix_double(h, r.history.plastic);
    *(uint64_t *)context += mix(mix_vec(h, r.history.spring), 0);
}

static uint64_t mix_flow(uint64_t h, const flow *f) {
    for (int i = 0; i < f->feed_count; i++) {
        const feed_state *s = &f->feeds[i].state;
        h = mix(mix(h, s->bodies), s->refused);
        h = mix_double(mix(mix(h, s->places), s->rest_until), s->mass);
    }
    for (int i = 0; i < f->outlet_count; i++)
        h = mix_double(mix(h, f->outlets[i].state.bodies), f->outlets[i].state.mass);
    return h;
}

/* With all that a scheme remembers of it. */
static uint64_t hash_of_body(const clast_world *w, size_t i) {
    const body_store *b = &w->bodies;
    const double *kept;
    uint64_t h = START;
#define X(type, name) h = mix_of(type)(h, b->name[i]);
    BODY_COLUMNS(X)
#undef X
    for (int k = 0; k < 3; k++)
        if (b->image[k]) h = mix_int32_t(h, b->image[k][i]);
    for (int k = 0; (kept = integrator_kept(w, k)) != NULL; k++) h = mix_double(h, kept[i]);
    return mix(h, 0);
}

uint64_t clast_world_hash(const clast_world *w) {
    CLAST_ASSERT(w && w->prepared);
    uint64_t sums[2] = {0, 0}; /* bodies, contacts */
    for (size_t i = 0; i < w->bodies.count; i++) sums[0] += hash_of_body(w, i);
    contacts_visit(w, add_contact, &sums[1]);
    ranks_add_words(w, sums, 2);
    uint64_t h = mix_double(mix(START, w->step), w->dt);
    h = mix(mix(h, sums[0]), sums[1]);
    for (int i = 0; i < w->part_count; i++) h = mix_double(h, w->parts[i].work_total);
    h = mix_flow(h, w->flow);
    double books[sizeof(ledger) / sizeof(double)];
    memcpy(books, &w->ledger, sizeof books);
    for (size_t i = 0; i < sizeof books / sizeof *books; i++) h = mix_double(h, books[i]);
    return h;
}

/* hash.c - one number for the whole state: bodies by id, contacts by name, clock, books. FNV-1a
 * over 64-bit words with an extra mixing step: any bit of the state reaches all bits of it. */
#include <string.h>

#include "engine/world.h"

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

uint64_t clast_world_hash(const clast_world *world) {
    clast_world *w = (clast_world *)world; /* collecting records fills scratch, not state */
    CLAST_ASSERT(w && w->prepared);
    const body_store *b = &w->bodies;
    uint64_t h = mix_double(mix(0xcbf29ce484222325u, w->step), w->dt);
    for (uint32_t id = 0; id < w->next_id; id++) {
        int32_t i = w->slot_of_id[id];
        if (i < 0) continue;
#define X(type, name) h = mix_of(type)(h, b->name[i]);
        BODY_COLUMNS(X)
#undef X
    }
    records_collect(w);
    records_sort(w);
    for (size_t i = 0; i < w->records.count; i++) {
        const contact_record *r = &w->records.items[i];
        h = mix(mix(mix(mix(h, r->a), r->b), (uint64_t)r->sphere_a), (uint64_t)r->sphere_b);
        h = mix_double(mix_double(h, r->history.overlap), r->history.normal);
        h = mix_vec(h, r->history.spring);
    }
    for (int i = 0; i < w->part_count; i++) h = mix_double(h, w->parts[i].work_total);
    double books[sizeof(ledger) / sizeof(double)];
    memcpy(books, &w->ledger, sizeof books);
    for (size_t i = 0; i < sizeof books / sizeof *books; i++) h = mix_double(h, books[i]);
    return h;
}

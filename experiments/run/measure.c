#include "experiments/run/measure.h"

#include <stdlib.h>
#include <string.h>

#include "engine/check.h"

static const measure_class *const CLASSES[] = {
    &MEASURE_DISCHARGED_CLASS,    &MEASURE_REMAINING_CLASS,    &MEASURE_SOLID_FRACTION_CLASS,
    &MEASURE_BAND_VELOCITY_CLASS, &MEASURE_COORDINATION_CLASS, &MEASURE_PART_LOAD_CLASS,
    &MEASURE_LOAD_PROFILE_CLASS,
};

const measure_class *measure_class_of(measure_kind kind) {
    for (size_t i = 0; i < sizeof CLASSES / sizeof *CLASSES; i++)
        if (CLASSES[i]->kind == kind) return CLASSES[i];
    CLAST_ASSERT(!"measure kind");
    return NULL;
}

/* ---- moments --------------------------------------------------------------------------------- */

static const uint32_t *sort_ids; /* qsort has no context; runs are one at a time in a process */

static int by_id(const void *a, const void *b) {
    uint32_t x = sort_ids[*(const size_t *)a], y = sort_ids[*(const size_t *)b];
    return (x > y) - (x < y);
}

static void order_bodies(moment *m) {
    size_t n = m->bodies.count;
    if (n + 1 > m->room) {
        m->room = 2 * n + 1;
        m->order = realloc(m->order, m->room * sizeof *m->order);
        m->first_sphere = realloc(m->first_sphere, m->room * sizeof *m->first_sphere);
        CLAST_ASSERT(m->order && m->first_sphere);
    }
    for (size_t i = 0; i < n; i++) m->order[i] = i;
    sort_ids = m->bodies.id;
    qsort(m->order, n, sizeof *m->order, by_id);
}

static void find_spheres(moment *m) {
    size_t e = 0;
    for (size_t i = 0; i < m->bodies.count; i++) {
        m->first_sphere[i] = e;
        while (e < m->spheres.count && (size_t)m->spheres.body[e] == i) e++;
    }
    m->first_sphere[m->bodies.count] = e;
    CLAST_ASSERT(e == m->spheres.count);
}

static void take_contacts(moment *m) {
    m->contact_count = clast_world_contacts(m->world, m->contacts, m->contact_room);
    if (m->contact_count <= m->contact_room) return;
    m->contact_room = 2 * m->contact_count;
    m->contacts = realloc(m->contacts, m->contact_room * sizeof *m->contacts);
    CLAST_ASSERT(m->contacts);
    clast_world_contacts(m->world, m->contacts, m->contact_room);
}

void moment_take(moment *m, clast_world *w, bool with_contacts) {
    CLAST_ASSERT(m && w);
    m->world = w;
    m->time = clast_world_time(w);
    m->step = clast_world_steps(w);
    m->bodies = clast_world_bodies(w);
    m->spheres = clast_world_spheres(w);
    order_bodies(m);
    find_spheres(m);
    m->with_contacts = with_contacts;
    m->contact_count = 0;
    if (with_contacts) take_contacts(m);
}

void moment_free(moment *m) {
    free(m->order);
    free(m->first_sphere);
    free(m->contacts);
    *m = (moment){0};
}

/* ---- memory ---------------------------------------------------------------------------------- */

void measure_start(measure_memory *memory, const moment *start, uint32_t ids) {
    *memory = (measure_memory){.ids = ids, .samples = {.descriptor = -1}};
    memory->mass = calloc((size_t)ids + 1, sizeof *memory->mass);
    memory->below = calloc((size_t)ids + 1, 1);
    CLAST_ASSERT(memory->mass && memory->below);
    memset(memory->below, BELOW_ABSENT, ids);
    for (size_t i = 0; i < start->bodies.count; i++) {
        uint32_t id = start->bodies.id[i];
        CLAST_ASSERT(id < ids);
        memory->mass[id] = start->bodies.mass[i];
        memory->below[id] = BELOW_NOT_YET;
    }
}

void measure_stop(measure_memory *memory) {
    if (memory->sampling) table_close(&memory->samples);
    free(memory->mass);
    free(memory->below);
    *memory = (measure_memory){.samples = {.descriptor = -1}};
}

/* Cumulative mass and number of bodies that have been below the level. Bodies that left the world
 * count too; one that bounces back above the level stays discharged. Looked at when a row is
 * written. */
#include "engine/check.h"
#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    fprintf(to, ",%s_kg,%s_count", m->name, m->name);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    size_t next = 0;
    double kg = 0, count = 0;
    for (uint32_t id = 0; id < memory->ids; id++) {
        bool here = next < now->bodies.count && now->bodies.id[now->order[next]] == id;
        bool below = !here || now->bodies.z[now->order[next]] < m->level;
        if (below && memory->below[id] == BELOW_NOT_YET) memory->below[id] = BELOW_ONCE;
        next += here;
        if (memory->below[id] != BELOW_ONCE) continue;
        kg += memory->mass[id];
        count += 1;
    }
    values[0] = kg;
    values[1] = count;
    return 2;
}

const measure_class MEASURE_DISCHARGED_CLASS = {
    .kind = MEASURE_DISCHARGED, .word = "discharged", .header = header, .values = values};

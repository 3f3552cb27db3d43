/* Number and mass of the bodies with their centre above the level. */
#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    fprintf(to, ",%s_count,%s_kg", m->name, m->name);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    (void)memory;
    double count = 0, kg = 0;
    for (size_t i = 0; i < now->bodies.count; i++) {
        size_t k = now->order[i];
        if (!(now->bodies.z[k] > m->level)) continue;
        count += 1;
        kg += now->bodies.mass[k];
    }
    values[0] = count;
    values[1] = kg;
    return 2;
}

const measure_class MEASURE_REMAINING_CLASS = {
    .kind = MEASURE_REMAINING, .word = "remaining", .header = header, .values = values};

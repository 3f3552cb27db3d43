/* Mean number of partners that a body touches, several sub-contacts with one partner counted once:
 * bodies alone, and bodies and walls. */
#include "engine/check.h"
#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    fprintf(to, ",%s_bodies,%s_bodies_and_walls", m->name, m->name);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    (void)m, (void)memory;
    CLAST_ASSERT(now->with_contacts);
    double body_pairs = 0, wall_pairs = 0;
    for (size_t i = 0; i < now->contact_count; i++) {
        const clast_contact *c = &now->contacts[i];
        if (i > 0 && c[-1].a == c->a && c[-1].b == c->b) continue; /* sorted by (a, b) */
        if (c->b >= CLAST_WALL_ID)
            wall_pairs += 1;
        else
            body_pairs += 1;
    }
    double n = now->bodies.count > 0 ? (double)now->bodies.count : 1;
    values[0] = 2 * body_pairs / n;
    values[1] = (2 * body_pairs + wall_pairs) / n;
    return 2;
}

const measure_class MEASURE_COORDINATION_CLASS = {.kind = MEASURE_COORDINATION,
                                                  .word = "coordination",
                                                  .needs_contacts = true,
                                                  .header = header,
                                                  .values = values};

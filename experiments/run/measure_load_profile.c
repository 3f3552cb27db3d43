/* Normal force of the bodies on one part, by equal sections of its height: the partitions of a side
 * wall of A00 5.3.3.1. A contact belongs to the section that holds its point; what touches the part
 * below or above them is left out. */
#include <math.h>

#include "engine/check.h"
#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    for (int i = 0; i < m->sections; i++) fprintf(to, ",%s_normal_%d_N", m->name, i + 1);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    (void)memory;
    CLAST_ASSERT(now->with_contacts && m->sections <= MEASURE_SECTIONS_MAX && m->height > 0);
    for (int i = 0; i < m->sections; i++) values[i] = 0;
    for (size_t i = 0; i < now->contact_count; i++) {
        const clast_contact *c = &now->contacts[i];
        if (c->b < CLAST_WALL_ID) continue;
        if (clast_world_wall_part(now->world, (int)(c->b - CLAST_WALL_ID)) != m->part) continue;
        double section = floor((c->point.z - m->level) / m->height * m->sections);
        if (section >= 0 && section < m->sections) values[(int)section] += c->normal_force;
    }
    return m->sections;
}

const measure_class MEASURE_LOAD_PROFILE_CLASS = {.kind = MEASURE_LOAD_PROFILE,
                                                  .word = "load profile",
                                                  .needs_contacts = true,
                                                  .header = header,
                                                  .values = values};

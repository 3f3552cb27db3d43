/* Vertical velocity of the bodies whose centre lies in a horizontal band, A00 4.3.1 (iii): mean,
 * standard deviation (n - 1) and number. Every body of the band goes into <name>.samples.csv, for
 * the profile across the width. */
#include <math.h>

#include "experiments/run/measure.h"

static void header(const measure *m, FILE *to) {
    fprintf(to, ",%s_mean_m_per_s,%s_sd_m_per_s,%s_count", m->name, m->name, m->name);
}

static bool is_in_band(const measure *m, double x, double z) {
    return fabs(z - (m->level + m->height)) <= 0.5 * m->thickness && x >= m->x_min && x <= m->x_max;
}

static void sample(table *t, const moment *now, size_t k) {
    table_begin(t, now->time, now->step);
    table_number(t, now->bodies.id[k]);
    table_number(t, now->bodies.x[k]);
    table_number(t, now->bodies.vz[k]);
    table_end(t);
}

static int values(const measure *m, measure_memory *memory, const moment *now, double *values) {
    const clast_bodies *b = &now->bodies;
    double count = 0, sum = 0, squares = 0;
    for (size_t i = 0; i < b->count; i++) {
        size_t k = now->order[i];
        if (!is_in_band(m, b->x[k], b->z[k])) continue;
        count += 1;
        sum += b->vz[k];
        if (memory->sampling) sample(&memory->samples, now, k);
    }
    double mean = sum / count; /* not a number when the band is empty */
    for (size_t i = 0; i < b->count; i++) {
        size_t k = now->order[i];
        if (is_in_band(m, b->x[k], b->z[k])) squares += (b->vz[k] - mean) * (b->vz[k] - mean);
    }
    values[0] = mean;
    values[1] = count > 1 ? sqrt(squares / (count - 1)) : (double)NAN;
    values[2] = count;
    return 3;
}

const measure_class MEASURE_BAND_VELOCITY_CLASS = {.kind = MEASURE_BAND_VELOCITY,
                                                   .word = "band velocity",
                                                   .writes_samples = true,
                                                   .header = header,
                                                   .values = values,
                                                   .samples_header =
                                                       "time_s,step,id,x_m,vz_m_per_s"};

/* bed.c - what is read off a consolidation: A00 5.3.1. */
#include <gsl/gsl_statistics_double.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "engine/clast.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

/* ---- solid fraction -------------------------------------------------------------------------- */

static double bed_volume(const aspect_case *c, const frame *f) {
    return 4 * c->half_width * c->half_width * surface_of(f, c);
}

/* In three dimensions one number: volume of the particles over that below the surface. */
static void measure_volume(aspect_case *c, const frame *f) {
    double particle = 4.0 / 3 * 3.14159265358979 * EQUAL_RADIUS * EQUAL_RADIUS * EQUAL_RADIUS;
    c->bed.phi = c->bed.phi_exact = c->bed.phi_all = c->count * particle / bed_volume(c, f);
    c->bed.skewness = c->bed.kurtosis = c->bed.per_cell = NAN;
}

/* Cells below the surface: those of the rows that end below its lowest tenth. */
static int full_rows(const cells *g, const aspect_case *c) {
    int rows = (int)floor((c->bed.height - 0.5 * g->size) / g->size);
    return rows < 1 ? 1 : rows > g->rows ? g->rows : rows;
}

static void measure_cells(aspect_case *c, const frame *f) {
    bed_facts *b = &c->bed;
    cells g = cells_of(f, c);
    double filled[CELLS_MAX];
    int full = full_rows(&g, c) * g.columns, n = 0;
    for (int i = 0; i < g.rows * g.columns; i++)
        if (g.number[i] > 0) filled[n++] = g.counted[i];
    b->phi = gsl_stats_mean(g.counted, 1, (size_t)full);
    /* discs that overlap would count twice */
    b->phi_exact = c->chain.density > 1 ? (double)NAN : gsl_stats_mean(g.exact, 1, (size_t)full);
    b->per_cell = gsl_stats_mean(g.number, 1, (size_t)full);
    b->phi_all = gsl_stats_mean(filled, 1, (size_t)n);
    b->skewness = gsl_stats_skew(filled, 1, (size_t)n);
    b->kurtosis = gsl_stats_kurtosis(filled, 1, (size_t)n); /* 0 for the normal distribution */
}

/* ---- contacts -------------------------------------------------------------------------------- */

/* Contacts of a frame are sorted by pair. */
static void measure_subcontacts(bed_facts *b, const frame *f) {
    double pairs = 0, count[SUBCONTACTS] = {0};
    for (size_t i = 0; i < f->contacts;) {
        size_t first = i;
        while (i < f->contacts && f->contact_a[i] == f->contact_a[first] &&
               f->contact_b[i] == f->contact_b[first])
            i++;
        if (f->contact_b[first] >= CLAST_WALL_ID) continue;
        size_t n = i - first;
        count[n < SUBCONTACTS ? n - 1 : SUBCONTACTS - 1] += 1;
        pairs += 1;
    }
    for (int k = 0; k < SUBCONTACTS; k++) b->subcontacts[k] = pairs > 0 ? count[k] / pairs : NAN;
}

static void measure_rest(bed_facts *b, const results *r) {
    int last = (int)results_rows(r) - 1;
    b->coordination = run_column(r, "z_bodies")[last];
    b->with_walls = run_column(r, "z_bodies_and_walls")[last];
    b->force_rest = fabs(-run_column(r, "floor_force_z_N")[last] / b->weight - 1);
}

/* Of the consolidation itself, which rings. */
static void measure_series(bed_facts *b, const results *r) {
    int n = (int)results_rows(r), stable = n - 1;
    const double *t = run_column(r, "time_s"), *z = run_column(r, "z_bodies");
    const double *force = run_column(r, "floor_force_z_N"), *input = run_column(r, "input_J");
    while (stable > 0 && fabs(z[stable - 1] / z[n - 1] - 1) < STABLE_WITHIN) stable--;
    b->stable = t[stable];
    double sum = 0, count = 0;
    for (int i = 0; i < n; i++)
        if (t[i] >= t[n - 1] - FORCE_OVER) sum -= force[i], count++;
    b->force = fabs(sum / count / b->weight - 1);
    b->force_last = fabs(-force[n - 1] / b->weight - 1);
    b->residual = fabs(run_column(r, "residual_J")[n - 1]) / input[n - 1];
}

void bed_measure(aspect_case *c) {
    CLAST_ASSERT(c && c->has_bed);
    const double PI = 3.14159265358979;
    results *r = run_open(c->bed_folder), *rest = run_open(c->rest_folder);
    frame *f = run_frame(rest, 1e9);
    c->bed.weight = c->count * DENSITY * 4 / 3 * PI * pow(EQUAL_RADIUS, 3) * GRAVITY;
    c->bed.height = surface_of(f, c);
    if (c->in_space)
        measure_volume(c, f);
    else
        measure_cells(c, f);
    measure_subcontacts(&c->bed, f);
    measure_series(&c->bed, r);
    measure_rest(&c->bed, rest);
    frame_free(f);
    results_free(rest), results_free(r);
}

/* drift.c - energy of small beds over a million steps. */
#include "tests/counts/grains.h"
#include "tests/precision/precision.h"

#include <math.h>
#include <stdio.h>

static const grains BEDS[] = {{"bounce", GRAINS_BOUNCE, 125, 0},
                              {"flow", GRAINS_FLOW, 125, 4000},
                              {"rest", GRAINS_BOX, 125, 20000}};

typedef struct drift_start {
    double total, height; /* J, m */
} drift_start;

static double total_energy(const clast_energy *e) {
    return e->kinetic + e->rotational + e->gravity + e->elastic;
}

static double mean_height(clast_world *w) {
    clast_bodies b = clast_world_bodies(w);
    double sum = 0;
    for (size_t i = 0; i < b.count; i++) sum += b.z[i];
    return sum / (double)b.count;
}

static void write_rows(const precision_table *t, const grains *g, const char *precision,
                       clast_world *w, const drift_start *start) {
    clast_energy e = clast_world_energy(w);
    double n = (double)clast_world_steps(w);
    precision_row(t, "residual", g->name, precision, n, e.residual / e.input, NAN);
    if (g->kind == GRAINS_BOUNCE)
        precision_row(t, "energy", g->name, precision, n,
                      (total_energy(&e) - start->total) / e.input, NAN);
    if (g->kind != GRAINS_BOX) return;
    clast_shape_def s = clast_world_shape(w, 0);
    double fall = s.mass * 9.81 * GRAINS_RADIUS * (double)g->bodies;
    precision_row(t, "sinking", g->name, precision, n,
                  (start->height - mean_height(w)) / GRAINS_RADIUS, NAN);
    precision_row(t, "motion", g->name, precision, n, (e.kinetic + e.rotational) / fall, NAN);
}

static void follow(const precision_table *t, const grains *g, clast_precision p, const char *path) {
    grains_wish wish = {.threads = 1, .precision = p};
    clast_world *w = grains_open(g, &wish, path);
    clast_energy e = clast_world_energy(w);
    drift_start start = {total_energy(&e), mean_height(w)};
    static const double MARKS[3] = {1, 2, 5};
    for (double decade = 1000; decade <= t->steps; decade *= 10)
        for (int k = 0; k < 3; k++) {
            double until = fmin(decade * MARKS[k], t->steps);
            uint64_t done = clast_world_steps(w);
            if (until <= (double)done) continue;
            grains_steps(w, (uint64_t)until - done);
            write_rows(t, g, PRECISION_NAMES[p], w, &start);
        }
    clast_world_free(w);
}

void measure_drift(const precision_table *t) {
    for (size_t i = 0; i < sizeof BEDS / sizeof *BEDS; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/precision-%s.h5", t->scratch, BEDS[i].name);
        grains_settle(&BEDS[i], path);
        for (int p = 0; p < 2; p++) follow(t, &BEDS[i], (clast_precision)p, path);
        remove(path);
    }
}

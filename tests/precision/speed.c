/* speed.c - nanoseconds of processor time per sphere-step, runs of all variants in turn. */
#include "tests/counts/grains.h"
#include "tests/precision/precision.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { ROUNDS = 7, WARM = 40, STEPS = 120, LANES = 3 };
static const char *const LANE_NAMES[LANES] = {"baseline", "avx2", "avx512"};

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static int by_size(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return x < y ? -1 : x > y;
}

/* NAN when the processor lacks the lanes. */
static double time_once(const grains *g, int lane, int precision, const char *path) {
    grains_wish wish = {1, (clast_isa)(CLAST_ISA_BASELINE + lane), (clast_precision)precision};
    clast_world *w = grains_open(g, &wish, path);
    double each = NAN;
    if (strcmp(clast_world_plan(w).isa, LANE_NAMES[lane]) == 0) {
        grains_steps(w, WARM);
        double start = seconds();
        grains_steps(w, STEPS);
        each = 1e9 * (seconds() - start) / STEPS / (double)clast_world_counters(w).spheres;
    }
    clast_world_free(w);
    return each;
}

static void measure_bed(const precision_table *t, const grains *g, const char *path) {
    static double ns[LANES][2][ROUNDS];
    for (int round = 0; round < ROUNDS; round++)
        for (int lane = 0; lane < LANES; lane++)
            for (int p = 0; p < 2; p++) ns[lane][p][round] = time_once(g, lane, p, path);
    for (int lane = 0; lane < LANES; lane++)
        for (int p = 0; p < 2; p++) {
            char of[40];
            double *runs = ns[lane][p];
            qsort(runs, ROUNDS, sizeof *runs, by_size);
            snprintf(of, sizeof of, "%s %s", g->name, LANE_NAMES[lane]);
            if (!isnan(runs[0]))
                precision_row(t, "speed", of, PRECISION_NAMES[p], (double)g->bodies,
                              runs[ROUNDS / 2], 0.5 * (runs[ROUNDS * 3 / 4] - runs[ROUNDS / 4]));
        }
}

void measure_speed(const precision_table *t) {
    static const grains BEDS[] = {{"box", GRAINS_BOX, 5000, 4000},
                                  {"layer", GRAINS_LAYER, 5000, 6000}};
    for (size_t i = 0; i < sizeof BEDS / sizeof *BEDS; i++) {
        char path[4096];
        snprintf(path, sizeof path, "%s/precision-speed-%s.h5", t->scratch, BEDS[i].name);
        grains_settle(&BEDS[i], path);
        measure_bed(t, &BEDS[i], path);
        remove(path);
    }
}

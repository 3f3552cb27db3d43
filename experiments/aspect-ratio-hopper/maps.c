/* maps.c - solid fractions of the cells: maps of the beds and of the flow, and their distribution
 * (A00 Figs 5.3, 5.4 and 5.9). */
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/output.h"

static const double MAP_AT[] = {0, 0.25, 0.5, 1, 1.5, 2}; /* s */
static const double BAND = 0.05;                          /* of the distribution */

static void write_cells(FILE *f, const aspect_case *c, const cells *g, double time) {
    for (int i = 0; i < g->rows * g->columns; i++)
        fprintf(f, "%s,%g,%.4g,%.4g,%.4g,%.4g\n", c->chain.name, time,
                100 * ((i % g->columns + 0.5) * g->size - c->half_width),
                100 * (i / g->columns + 0.5) * g->size, g->counted[i], g->exact[i]);
}

static int write_maps(const aspect_study *s) {
    FILE *f = output_table(s->to.data, "cells.csv", "shape,time_s,x_cm,z_cm,counted,exact");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        const aspect_case *c = shown_case(s, shape);
        if (!c) continue;
        results *r = run_open(c->flow_folder);
        for (size_t i = 0; i < sizeof MAP_AT / sizeof *MAP_AT; i++) {
            frame *now = run_frame(r, MAP_AT[i]);
            cells g = cells_of(now, c);
            if (fabs(now->time - MAP_AT[i]) < 0.03) write_cells(f, c, &g, MAP_AT[i]);
            frame_free(now);
        }
        results_free(r);
    }
    return output_close(f);
}

/* Percent of the cells with a particle, over all replicates at the cheaper setting. */
static int write_distribution(const aspect_study *s) {
    enum { BANDS = 24 };
    FILE *f = output_table(s->to.data, "distribution.csv", "shape,from,percent");
    if (!f) return 4;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        double count[BANDS] = {0}, all = 0;
        for (int k = 0; k < REPLICATES_MAX; k++) {
            const aspect_case *c = case_of(s, shape, CHEAP, 0, k);
            if (!c) continue;
            results *r = run_open(c->bed_folder);
            frame *end = run_frame(r, 1e9);
            cells g = cells_of(end, c);
            for (int i = 0; i < g.rows * g.columns; i++) {
                if (!(g.number[i] > 0)) continue;
                int band = (int)(g.counted[i] / BAND);
                count[band < BANDS ? band : BANDS - 1] += 1;
                all += 1;
            }
            frame_free(end);
            results_free(r);
        }
        for (int i = 0; i < BANDS && all > 0; i++)
            fprintf(f, "%s,%.2f,%.4g\n", chain_of(shape).name, i * BAND, 100 * count[i] / all);
    }
    return output_close(f);
}

int aspect_write_maps(const aspect_study *s) {
    CLAST_ASSERT(s);
    return write_maps(s) | write_distribution(s) ? 4 : 0;
}

/* arches.c - how often the particles hold each other above the throat: model runs from beds of many
 * seeds, for both readings of the slopes. */
#include <stdio.h>
#include <stdlib.h>

#include "experiments/pool-ball-piston/piston.h"
#include "experiments/run/results.h"

const char *const SLOPE_NAME[SLOPES] = {"60 deg", "70 deg"};
/* settings of all scenes; of the bed: the steeper V takes a narrower grid */
static const char *const TOP[SLOPES] = {"top=70 cm", "top=92.82 cm"};
static const char *const COLUMNS[SLOPES] = {"columns=5", "columns=3"};

static void plan_bed(job *j, const piston_study *s, int slope, int seed) {
    *j = (job){.scene = SCENES "/settle.yaml", .label = "arch-bed"};
    job_set(j, "seed=%d", seed);
    job_set(j, "%s", TOP[slope]);
    job_set(j, "%s", COLUMNS[slope]);
    jobs_name(j, s->root);
}

static void plan_model(job *j, const piston_study *s, int slope, const job *bed, int friction) {
    *j = (job){.scene = SCENES "/piston.yaml", .label = "arch"};
    job_set(j, "bed=%s", bed->folder);
    job_set(j, "%s", TOP[slope]);
    job_set(j, "fraction=0.5");
    job_set(j, "friction=%g", FRICTION[friction]);
    job_set(j, "wall_friction=%g", FRICTION[friction]);
    jobs_name(j, s->root);
}

/* Particles above the throat when the piston has gone all its way; -1 without a result. A bed as
 * dense as can be leaves one or two. */
static int held_above(const char *folder) {
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(folder, why);
    frame *f = r && results_frames(r) ? results_frame(r, results_frames(r) - 1) : NULL;
    int above = f ? 0 : -1;
    for (size_t i = 0; f && i < f->bodies; i++) above += f->position[3 * i + 2] > 0.01 * RIG_THROAT;
    frame_free(f);
    results_free(r);
    return above;
}

static int run_beds(const piston_study *s, job *beds, int n, int processes) {
    for (int i = 0; i < SLOPES * n; i++) plan_bed(&beds[i], s, i / n, 1 + i % n);
    return jobs_run(beds, SLOPES * n, processes, "settling, arches");
}

int piston_arches(piston_study *s, int processes) {
    int n = s->size->arrangements, count = SLOPES * n * FRICTIONS;
    if (n == 0) return 0;
    job *beds = calloc((size_t)(SLOPES * n), sizeof *beds);
    job *models = calloc((size_t)count, sizeof *models);
    if (!beds || !models) abort();
    int failed = run_beds(s, beds, n, processes);
    for (int i = 0; i < count; i++)
        plan_model(&models[i], s, i / (n * FRICTIONS), &beds[i / FRICTIONS], i % FRICTIONS);
    failed += jobs_run(models, count, processes, "piston, arches");
    for (int i = 0; i < count; i++) {
        arch_row *row = &s->arches[i / (n * FRICTIONS)][i % FRICTIONS];
        int above = models[i].done ? held_above(models[i].folder) : -1;
        if (above < 0) continue;
        row->runs++;
        row->held += above > ARCH_ABOVE;
        row->above += above;
    }
    free(beds);
    free(models);
    return failed;
}

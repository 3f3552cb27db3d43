/* part_buttons.c - the button hopper of A00 4.3 (experiments/button-hopper), orifice 10 cm: what
 * time step, stiffness, spheres per button and precision do to the flow rate and to the density of
 * the flowing bed. One thing at a time is changed from the thesis's setting.
 *
 * The flow is chaotic: two runs from one bed differ by several per cent whatever is changed. So the
 * error is the mean of paired differences (same seed of the filling), with its interval. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/button-hopper/hopper.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "experiments/scene/scene.h"
#include "experiments/speed-accuracy/chart.h"
#include "experiments/study/output.h"
#include "experiments/tune/edit.h"
#include "experiments/tune/paired.h"

enum { WIDEST = ORIFICES - 1, SPHERES = 7, REPLICATE_LIMIT = 256, FITS = 6 };

static const int FIT[FITS] = {SPHERES, 1, 3, 5, 11, 15}; /* spheres per button */

/* Settings that the guards would stop, or a step that the scene check refuses, are charted too:
 * what the guards watch stands beside the error. */
static const char GUARDS[] = "{mode: report}";
#define GUARD_OVERLAP  0.05 /* of a radius; by default */
#define GUARD_RESIDUAL 0.05 /* of the energy put in */

/* One thing changed. A softer contact lasts longer, as E^-2/5 by Hertz's theory (S12 2.41), so the
 * step is longer by as much: that is what softening is done for. */
typedef struct variant {
    const char *factor, *words;
    double level;             /* as the figures count it */
    double step_times, young; /* of the thesis's; Pa */
    int spheres;
    bool mixed;
    study_size from; /* the smallest size that has it */
} variant;

static const variant VARIANTS[] = {
    {"reference", "the thesis's setting", 1, 1, 3.5e9, SPHERES, false, STUDY_QUICK},
    {"step", "step / 4", 0.25, 0.25, 3.5e9, SPHERES, false, STUDY_PUBLISHED},
    {"step", "step / 2", 0.5, 0.5, 3.5e9, SPHERES, false, STUDY_PUBLISHED},
    {"step", "step x 1.5", 1.5, 1.5, 3.5e9, SPHERES, false, STUDY_FULL},
    {"step", "step x 2", 2, 2, 3.5e9, SPHERES, false, STUDY_QUICK},
    {"step", "step x 3", 3, 3, 3.5e9, SPHERES, false, STUDY_PUBLISHED},
    {"step", "step x 4", 4, 4, 3.5e9, SPHERES, false, STUDY_PUBLISHED},
    {"stiffness", "E / 10", 10, 2.511886, 3.5e8, SPHERES, false, STUDY_PUBLISHED},
    {"stiffness", "E / 100", 100, 6.309573, 3.5e7, SPHERES, false, STUDY_QUICK},
    {"stiffness", "E / 1000", 1000, 15.84893, 3.5e6, SPHERES, false, STUDY_PUBLISHED},
    {"stiffness", "E / 10000", 10000, 39.81072, 3.5e5, SPHERES, false, STUDY_PUBLISHED},
    {"spheres", "1 sphere", 1, 1, 3.5e9, 1, false, STUDY_PUBLISHED},
    {"spheres", "3 spheres", 3, 1, 3.5e9, 3, false, STUDY_QUICK},
    {"spheres", "5 spheres", 5, 1, 3.5e9, 5, false, STUDY_PUBLISHED},
    {"spheres", "11 spheres", 11, 1, 3.5e9, 11, false, STUDY_PUBLISHED},
    {"spheres", "15 spheres", 15, 1, 3.5e9, 15, false, STUDY_PUBLISHED},
    {"precision", "mixed precision", 1, 1, 3.5e9, SPHERES, true, STUDY_QUICK},
};
enum { VARIANT_COUNT = sizeof VARIANTS / sizeof *VARIANTS };

/* One discharge, read as the experimenter read his video. */
typedef struct flow {
    double rate, density; /* g/s, g/cm2; NAN without a linear part */
    double cost;          /* s of processor time per simulated second; NAN: not known */
    double overlap;       /* largest, of a radius */
    double residual;      /* of the energy put in */
} flow;

typedef struct button_study {
    const chart_size *size;
    char root[600];
    char scene[2][700]; /* of the discharge: double, mixed */
    job *beds;          /* by fit and replicate */
    job *flows;         /* by variant and replicate; only of those that are run */
    int runs;           /* of them */
    flow *found;        /* by variant and replicate */
} button_study;

static bool is_run(const button_study *s, int v) {
    return VARIANTS[v].from <= s->size->size;
}

static bool fit_is_run(const button_study *s, int spheres) {
    bool run = false;
    for (int v = 0; v < VARIANT_COUNT; v++) run |= is_run(s, v) && VARIANTS[v].spheres == spheres;
    return run;
}

static void *list(int count, size_t size) {
    void *p = calloc((size_t)count + 1, size);
    CLAST_ASSERT(p);
    return p;
}

/* ---- scenes ---------------------------------------------------------------------------------- */

static char *read_whole(const char *path) {
    FILE *f = fopen(path, "rb");
    if (!f) {
        fprintf(stderr, "%s: cannot be read\n", path);
        exit(4);
    }
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    for (int c; (c = getc(f)) != EOF;) putc(c, to);
    CLAST_ASSERT(fclose(to) == 0);
    fclose(f);
    return text;
}

/* The scene of the study button-hopper with two keys that are no parameters of it. */
static void write_scene(button_study *s, bool mixed) {
    scene_arena arena = {0};
    char *source = read_whole(BUTTON_SCENES "/discharge.yaml");
    scene_edit e = scene_edit_start(&arena, source);
    bool good = e.root && scene_edit_put(&e, NULL, "guards", GUARDS);
    if (mixed) good &= scene_edit_put(&e, NULL, "precision", "mixed");
    char *text = good ? scene_edit_finish(&e) : NULL;
    snprintf(s->scene[mixed], sizeof s->scene[mixed], "%s/discharge-%s.yaml", s->root,
             mixed ? "mixed" : "double");
    if (!text || file_write_text(s->scene[mixed], text)) {
        fprintf(stderr, "%s: cannot be written\n", s->scene[mixed]);
        exit(4);
    }
    free(text);
    free(source);
    scene_arena_free(&arena);
}

/* ---- runs ------------------------------------------------------------------------------------ */

static job *bed_of(const button_study *s, int spheres, int replicate) {
    for (int i = 0; i < FITS; i++)
        if (FIT[i] == spheres) return &s->beds[i * s->size->replicates + replicate];
    abort();
}

static void plan_beds(button_study *s, job *jobs, int *count) {
    for (int i = 0; i < FITS; i++)
        for (int k = 0; k < s->size->replicates && fit_is_run(s, FIT[i]); k++) {
            job *j = bed_of(s, FIT[i], k);
            *j = (job){.scene = BUTTON_SCENES "/fill.yaml"};
            snprintf(j->label, sizeof j->label, "bed-%02d-%03d", FIT[i], k + 1);
            job_set(j, "seed=%d", 1 + k);
            job_set(j, "spheres=%d", FIT[i]);
            job_set(j, "step=%.9g s", s->size->button_step);
            job_set(j, "settle=%s", s->size->settle);
            jobs_name(j, s->root);
            jobs[(*count)++] = *j;
        }
}

static void plan_flow(const button_study *s, job *j, const variant *v, int replicate) {
    *j = (job){.scene = s->scene[v->mixed], .quiet = true};
    snprintf(j->label, sizeof j->label, "flow-%s-%g-%03d", v->factor, v->level, replicate + 1);
    job_set(j, "bed=%s", bed_of(s, v->spheres, replicate)->folder);
    job_set(j, "orifice=%g cm", ORIFICE_CM[WIDEST]);
    job_set(j, "step=%.9g s", v->step_times * s->size->button_step);
    job_set(j, "young=%.9g Pa", v->young);
    job_set(j, "spheres=%d", v->spheres);
    job_set(j, "latest=%s", s->size->latest);
    job_set(j, "frame_every=1 s");
    jobs_name(j, s->root);
}

static int run_all(button_study *s) {
    int beds = 0, processes = jobs_processes();
    job *fillings = list(FITS * s->size->replicates, sizeof *fillings);
    plan_beds(s, fillings, &beds);
    int failed = jobs_run(fillings, beds, processes, "filling");
    free(fillings);
    for (int v = 0; v < VARIANT_COUNT; v++)
        for (int k = 0; k < s->size->replicates && is_run(s, v); k++)
            plan_flow(s, &s->flows[s->runs++], &VARIANTS[v], k);
    jobs_run(s->flows, s->runs, processes, "discharge"); /* a setting may fail: it is charted */
    return failed;
}

/* ---- reading --------------------------------------------------------------------------------- */

static void read_series(flow *f, const job *j) {
    char *path = path_in(j->folder, FILE_SERIES), why[RESULTS_ERROR_MAX];
    csv *series = csv_read(path, why);
    free(path);
    if (!series) {
        fprintf(stderr, "%s\n", why);
        exit(4);
    }
    const double *time = csv_column(series, "time_s"), *most = csv_column(series, "overlap_max");
    size_t last = series->rows - 1;
    CLAST_ASSERT(time && most && series->rows > 1);
    f->cost = jobs_processor_time(j) / (time[last] - time[0]);
    f->overlap = most[last];
    csv_free(series);
}

static flow flow_of(const job *j) {
    flow f = {NAN, NAN, NAN, NAN, NAN};
    if (!j->done) return f;
    hopper_run r = {.orifice = WIDEST, .folder = j->folder};
    hopper_measure(&r);
    f.rate = r.rate[0], f.density = r.rho_flow, f.residual = r.residual;
    free(r.velocity);
    free(r.velocity_x);
    read_series(&f, j);
    return f;
}

/* The first line that a run left when it failed; false when it did not say why. */
static bool read_reason(const job *j, char *text, size_t room) {
    char *path = text_format("%s.log", j->folder);
    FILE *f = fopen(path, "r");
    free(path);
    bool found = f && fgets(text, (int)room, f) != NULL;
    if (f) fclose(f);
    if (found) text[strcspn(text, "\n")] = '\0';
    return found;
}

static int write_runs(const button_study *s, const char *folder) {
    FILE *f = output_table(folder, "button_runs.csv",
                           "factor,level,setting,replicate,rate_g_s,density_g_cm2,"
                           "cpu_s_per_s,overlap_max,residual");
    if (!f) return 4;
    for (int v = 0, i = 0; v < VARIANT_COUNT; v++)
        for (int k = 0; k < s->size->replicates && is_run(s, v); k++, i++) {
            const flow *one = &s->found[v * s->size->replicates + k];
            fprintf(f, "%s,%g,%s,%d,%.6g,%.6g,%.4g,%.4g,%.3g\n", VARIANTS[v].factor,
                    VARIANTS[v].level, VARIANTS[v].words, k + 1, one->rate, one->density, one->cost,
                    one->overlap, one->residual);
        }
    return output_close(f);
}

/* ---- points ---------------------------------------------------------------------------------- */

static double rate_of(const flow *f) {
    return f->rate;
}
static double density_of(const flow *f) {
    return f->density;
}
static double cost_per_second(const flow *f) {
    return f->cost;
}
static double overlap_of(const flow *f) {
    return f->overlap;
}

static double residual_of(const flow *f) {
    return f->residual;
}

static void column_of(const button_study *s, int v, double of(const flow *f), double *to) {
    for (int k = 0; k < s->size->replicates; k++)
        to[k] = of(&s->found[v * s->size->replicates + k]);
}

static void compare(chart_point *p, const button_study *s, int v, double of(const flow *f)) {
    double reference[REPLICATE_LIMIT], changed[REPLICATE_LIMIT];
    column_of(s, 0, of, reference);
    column_of(s, v, of, changed);
    paired d = paired_compare(reference, changed, s->size->replicates, 0.05);
    p->samples = d.n;
    p->difference = d.difference;
    p->error = fabs(d.difference);
    p->low = fmax(0, p->error - d.half), p->high = p->error + d.half;
    if (!isfinite(d.half)) p->error = p->low = p->high = INFINITY;
    if (!p->message[0] && d.lost > 0)
        snprintf(p->message, sizeof p->message, "%d of %d runs have no steady rate", d.lost, d.n);
}

/* s; of the scene as the job has set it. NAN when it cannot be read: then the job failed, too. */
static double critical_step_of(const job *j) {
    const char *set[JOB_SETTINGS];
    char *faults = NULL;
    for (int i = 0; i < j->set_count; i++) set[i] = j->set[i];
    scene_options options = {.set = set, .set_count = j->set_count, .threads = 1};
    scene *of = scene_load(j->scene, &options, &faults);
    free(faults);
    if (!of) return NAN;
    double step = clast_world_plan(of->world).critical_step;
    scene_free(of);
    return step;
}

/* What a reader should know of a setting: it did not run, or the check of its scene or the guards
 * would not let it. */
static void remark(chart_point *p, const button_study *s, int v, const job *flows) {
    double residuals[REPLICATE_LIMIT], worst = 0;
    int replicates = s->size->replicates;
    column_of(s, v, residual_of, residuals);
    for (int k = 0; k < replicates; k++) worst = fmax(worst, residuals[k]);
    if (p->overlap > GUARD_OVERLAP || worst > GUARD_RESIDUAL)
        snprintf(p->message, sizeof p->message,
                 "guards would stop it: overlap up to %.2g of a radius, energy off by up to %.2g",
                 p->overlap, worst);
    double critical = critical_step_of(&flows[0]);
    if (p->step > critical)
        snprintf(p->message, sizeof p->message, "refused: its step is %.2g of the critical step",
                 p->step / critical);
    for (int k = replicates - 1; k >= 0; k--)
        if (!flows[k].done && !read_reason(&flows[k], p->message, sizeof p->message))
            snprintf(p->message, sizeof p->message, "killed");
}

static void add_variant(chart *c, const button_study *s, int v, const job *flows) {
    double samples[REPLICATE_LIMIT];
    const variant *of = &VARIANTS[v];
    chart_point p = {.part = PART_BUTTONS,
                     .scene = "10 cm",
                     .level = of->level,
                     .step = of->step_times * s->size->button_step,
                     .statistical = true,
                     .reference = v == 0,
                     .overlap = NAN};
    snprintf(p.family, sizeof p.family, "%s", of->factor);
    snprintf(p.setting, sizeof p.setting, "%s", of->words);
    p.evaluations = of->spheres / p.step;
    column_of(s, v, overlap_of, samples);
    for (int k = 0; k < s->size->replicates; k++) p.overlap = fmax(p.overlap, samples[k]);
    column_of(s, v, cost_per_second, samples);
    p.cost = cost_of(samples, s->size->replicates);
    remark(&p, s, v, flows);
    p.quantity = "rate";
    compare(&p, s, v, rate_of);
    chart_add(c, &p);
    p.quantity = "density";
    compare(&p, s, v, density_of);
    chart_add(c, &p);
}

int button_points(chart *c, const chart_size *size, const char *root, const char *folder) {
    button_study s = {.size = size};
    CLAST_ASSERT(size->replicates <= REPLICATE_LIMIT);
    snprintf(s.root, sizeof s.root, "%s", root);
    output_folder(s.root);
    write_scene(&s, false);
    write_scene(&s, true);
    s.beds = list(FITS * size->replicates, sizeof *s.beds);
    s.flows = list(VARIANT_COUNT * size->replicates, sizeof *s.flows);
    s.found = list(VARIANT_COUNT * size->replicates, sizeof *s.found);
    int failed = run_all(&s);
    for (int v = 0, i = 0; v < VARIANT_COUNT; v++)
        for (int k = 0; k < size->replicates && is_run(&s, v); k++, i++) {
            s.found[v * size->replicates + k] = flow_of(&s.flows[i]);
            chart_fold_hash(c, s.flows[i].hash);
        }
    for (int v = 0, i = 0; v < VARIANT_COUNT; v++) {
        if (!is_run(&s, v)) continue;
        add_variant(c, &s, v, &s.flows[i]);
        i += size->replicates;
    }
    failed += write_runs(&s, folder) != 0;
    free(s.beds);
    free(s.flows);
    free(s.found);
    return failed;
}

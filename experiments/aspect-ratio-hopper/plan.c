/* plan.c - which runs each size is made of. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

/* `quick` is a hopper of a quarter of the width with 300 particles: it tests the study, and says
 * nothing of the source's hopper. */
const aspect_size SIZES[4] = {
    [STUDY_QUICK] = {"quick", 300, 0.125, 0.5, 4, {0, 1}, 0, 0, 0, false},
    [STUDY_BRIEF] = {"brief", 5000, 0.5, 2, 14, {0, 1}, 0, 0, 0, true},
    [STUDY_PUBLISHED] = {"published", 5000, 0.5, 2, 14, {1, 4}, 1, 0, 0, true},
    [STUDY_FULL] = {"full", 5000, 0.5, 2, 14, {1, 10}, 3, 2, 1, true},
};

/* README.md, "The cheaper setting". */
static const char *const SETTING[SETTINGS][2] = {
    [THESIS] = {"step=10 us", "young=3.5 GPa"},
    [CHEAP] = {"step=25 us", "young=0.35 GPa"},
};
static const char *const SETTING_NAME[SETTINGS] = {"thesis", "cheap"};

/* Rows of tables read better as they stand here. */
/* clang-format off */
const variant VARIANTS[] = {
    {"(baseline)", "", 0, {NULL}, {NULL}},
    {"damping of clumps", "shared", 1, {"clump=shared"}, {"clump=shared"}},
    {"time step", "a half", 1, {"step=12.5 us"}, {"step=12.5 us"}},
    {"Young's modulus", "35 MPa", 1, {"young=35 MPa"}, {"young=35 MPa"}},
    {"damping ratio", "0.21", 1, {"restitution=0.5337"}, {"restitution=0.5337"}},
    {"friction limit", "spring alone", 1, {NULL}, {"friction_limit=spring"}},
    {"tangential spring", "as printed", 1, {NULL}, {"unloading=as-printed"}},
    {"grid at the start", "20 % wider", 1, {"tolerance=1.2"}, {NULL}},
    {"grid at the start", "20 % wider", 0, {"tolerance=1.2"}, {NULL}},
    {"grid at the start", "no random shift", 1, {"jitter=0"}, {NULL}},
    {"depth of the chamber", "4 m", 1, {NULL}, {"chamber=4 m"}},
};
/* clang-format on */
const int VARIANT_COUNT = sizeof VARIANTS / sizeof *VARIANTS;

/* ---- jobs ------------------------------------------------------------------------------------ */

static void set_all(job *j, const char *const *settings, int most) {
    for (int i = 0; i < most && settings[i]; i++) job_set(j, "%s", settings[i]);
}

/* A parameter that is set twice counts as it was set last: variants come behind. */
static void set_common(job *j, const aspect_case *c) {
    job_set(j, "spheres=%d", c->chain.spheres);
    job_set(j, "radius=%.9g mm", 1e3 * c->chain.radius);
    job_set(j, "spacing=%.9g mm", 1e3 * c->chain.spacing);
    job_set(j, "half_width=%g m", c->half_width);
}

static void set_setting(job *j, const aspect_case *c, const char *const *own) {
    for (int i = 0; i < 2; i++) {
        size_t word = strcspn(SETTING[c->setting][i], "=") + 1;
        bool replaced = false;
        for (int k = 0; k < 3 && own[k]; k++)
            replaced |= !strncmp(own[k], SETTING[c->setting][i], word);
        if (!replaced) job_set(j, "%s", SETTING[c->setting][i]);
    }
    set_all(j, own, 3);
}

static void label(job *j, const aspect_case *c, const char *what) {
    snprintf(j->label, sizeof j->label, "%s-%s-%s%s-%02d", what, c->chain.name,
             SETTING_NAME[c->setting], c->in_space ? "-3d" : "", c->replicate + 1);
    for (char *p = j->label; *p; p++)
        if (*p == ' ') *p = '-';
}

/* s: the fall through the whole grid, and a second more. */
static double consolidation(const aspect_study *s, const aspect_case *c) {
    double columns = floor(2 * c->half_width / (1.01 * chain_length(&c->chain)));
    double height = ceil(c->count / columns) * 1.01 * chain_length(&c->chain);
    return 1 + sqrt(2 * fmin(height, s->size->top) / GRAVITY);
}

static void plan_bed(aspect_study *s, aspect_case *c) {
    job *j = &s->beds[s->count];
    j->scene = c->in_space ? SCENES "/bed-3d.yaml" : SCENES "/bed.yaml";
    label(j, c, "bed");
    set_common(j, c);
    job_set(j, "length=%.9g mm", 1e3 * chain_length(&c->chain));
    job_set(j, "count=%d", c->count);
    if (!c->in_space) {
        job_set(j, "height=%g m", s->size->top);
        job_set(j, "latest=%.3f s", consolidation(s, c));
    }
    job_set(j, "seed=%d", 1 + c->replicate);
    set_setting(j, c, VARIANTS[c->variant].bed);
    jobs_name(j, s->root);
    c->bed_folder = c->rest_folder = j->folder;
}

/* What the consolidation was made with, but for how it began. */
static void plan_rest(aspect_study *s, aspect_case *c) {
    if (c->in_space) return;
    job *j = &s->rests[s->count];
    j->scene = SCENES "/rest.yaml";
    label(j, c, "rest");
    set_common(j, c);
    job_set(j, "bed=%s", c->bed_folder);
    job_set(j, "top=%g m", s->size->top);
    const char *own[3] = {NULL};
    int n = 0;
    for (int i = 0; i < 3 && VARIANTS[c->variant].bed[i]; i++) {
        const char *set = VARIANTS[c->variant].bed[i];
        if (strncmp(set, "tolerance=", 10) && strncmp(set, "jitter=", 7)) own[n++] = set;
    }
    set_setting(j, c, own);
    jobs_name(j, s->root);
    c->rest_folder = j->folder;
}

static void plan_case(aspect_study *s, aspect_case c) {
    CLAST_ASSERT(s->count < CASES_MAX);
    c.chain = chain_of(c.shape);
    c.wave = s->waves;
    c.half_width = c.in_space ? 0.2 : s->size->half_width;
    c.chamber = c.in_space ? 1.5 : s->size->chamber;
    c.count = c.in_space ? 20000 : s->size->count;
    s->cases[s->count] = c;
    plan_bed(s, &s->cases[s->count]);
    plan_rest(s, &s->cases[s->count]);
    s->count++;
}

/* Cases of a wave are run side by side, one wave after the other: a study that is cut off has whole
 * cases. The dearest of a wave stands first: the last ones then end together. */
static void plan_set(aspect_study *s, int setting, int replicate, int first, int count) {
    for (int shape = first + count - 1; shape >= first; shape--)
        plan_case(s, (aspect_case){.shape = shape, .setting = setting, .replicate = replicate});
    s->waves++;
}

static void plan_variants(aspect_study *s, int replicate) {
    for (int v = 1; v < VARIANT_COUNT; v++)
        plan_case(s, (aspect_case){.shape = VARIANTS[v].shape,
                                   .setting = CHEAP,
                                   .variant = v,
                                   .replicate = replicate});
    s->waves++;
}

static void plan_in_space(aspect_study *s, int replicate) {
    for (int shape = 1; shape >= 0; shape--)
        plan_case(s,
                  (aspect_case){
                      .shape = shape, .setting = CHEAP, .replicate = replicate, .in_space = true});
    s->waves++;
}

void aspect_plan(aspect_study *s) {
    const aspect_size *z = s->size;
    s->beds = calloc(CASES_MAX, sizeof *s->beds);
    s->rests = calloc(CASES_MAX, sizeof *s->rests);
    s->flows = calloc(CASES_MAX, sizeof *s->flows);
    if (!s->beds || !s->rests || !s->flows) abort();
    for (int k = 0; k < z->replicates[CHEAP]; k++) plan_set(s, CHEAP, k, 0, MAIN_SHAPES);
    for (int k = 0; k < z->replicates[THESIS]; k++) plan_set(s, THESIS, k, 0, MAIN_SHAPES);
    for (int k = 0; k < z->variants; k++) plan_variants(s, k);
    for (int k = 0; k < z->further; k++) plan_set(s, CHEAP, k, MAIN_SHAPES, SHAPES - MAIN_SHAPES);
    for (int k = 0; k < z->in_space; k++) plan_in_space(s, k);
}

static void plan_flow(aspect_study *s, int which) {
    aspect_case *c = &s->cases[which];
    job *j = &s->flows[which];
    j->scene = c->in_space ? SCENES "/flow-3d.yaml" : SCENES "/flow.yaml";
    label(j, c, "flow");
    set_common(j, c);
    job_set(j, "bed=%s", c->rest_folder);
    job_set(j, "height=%.4f m", c->bed.height);
    if (!c->in_space) job_set(j, "top=%g m", s->size->top);
    bool own_chamber = false;
    for (int i = 0; i < 3 && VARIANTS[c->variant].flow[i]; i++) {
        const char *set = VARIANTS[c->variant].flow[i];
        if (strncmp(set, "chamber=", 8)) continue;
        own_chamber = true;
        c->chamber = strtod(set + 8, NULL); /* m: the heap is measured from its ground */
    }
    if (!own_chamber) job_set(j, "chamber=%g m", c->chamber);
    set_setting(j, c, VARIANTS[c->variant].flow);
    jobs_name(j, s->root);
    c->flow_folder = j->folder;
}

/* Runs those of the jobs whose case is marked, and marks those that were done. */
static int run_marked(aspect_study *s, job *jobs, bool *marked, const char *what) {
    static int of[CASES_MAX];
    int count = 0;
    job *list = calloc(CASES_MAX, sizeof *list);
    CLAST_ASSERT(list);
    for (int i = 0; i < s->count; i++)
        if (marked[i]) of[count] = i, list[count++] = jobs[i];
    int failed = jobs_run(list, count, jobs_processes(), what);
    for (int i = 0; i < count; i++) {
        marked[of[i]] = list[i].done;
        jobs[of[i]].hash = list[i].hash;
    }
    free(list);
    return failed;
}

static int run_wave(aspect_study *s, int wave) {
    bool here[CASES_MAX], layer[CASES_MAX];
    for (int i = 0; i < s->count; i++) here[i] = s->cases[i].wave == wave;
    int failed = run_marked(s, s->beds, here, "consolidation");
    for (int i = 0; i < s->count; i++) layer[i] = here[i] && !s->cases[i].in_space;
    failed += run_marked(s, s->rests, layer, "rest");
    for (int i = 0; i < s->count; i++) {
        here[i] = here[i] && (layer[i] || s->cases[i].in_space);
        if (!here[i]) continue;
        s->cases[i].has_bed = true;
        bed_measure(&s->cases[i]);
        plan_flow(s, i);
    }
    failed += run_marked(s, s->flows, here, "discharge");
    for (int i = 0; i < s->count; i++) {
        if (!here[i]) continue;
        s->cases[i].ran = true;
        flow_measure(&s->cases[i]);
    }
    return failed;
}

int aspect_run_all(aspect_study *s) {
    int failed = 0;
    for (int wave = 0; wave < s->waves; wave++) failed += run_wave(s, wave);
    return failed;
}

/* ---- looking runs up ------------------------------------------------------------------------- */

const aspect_case *case_of(const aspect_study *s, int shape, int setting, int of_variant,
                           int replicate) {
    for (int i = 0; i < s->count; i++) {
        const aspect_case *c = &s->cases[i];
        if (c->ran && !c->in_space && c->shape == shape && c->setting == setting &&
            c->variant == of_variant && c->replicate == replicate)
            return c;
    }
    return NULL;
}

const aspect_case *shown_case(const aspect_study *s, int shape) {
    const aspect_case *c = case_of(s, shape, THESIS, 0, 0);
    return c ? c : case_of(s, shape, CHEAP, 0, 0);
}

results *run_open(const char *folder) {
    char why[RESULTS_ERROR_MAX];
    results *all = results_open(folder, why);
    if (all) return all;
    fprintf(stderr, "aspect-ratio-hopper: %s\n", why);
    exit(4);
}

frame *run_frame(results *r, double time) {
    frame *f = results_frame(r, results_frame_at(r, time));
    if (f) return f;
    fprintf(stderr, "aspect-ratio-hopper: %s\n", results_error(r));
    exit(4);
}

const double *run_column(const results *r, const char *name) {
    const double *c = results_series(r, name);
    if (c) return c;
    fprintf(stderr,
            "aspect-ratio-hopper: a run has no column %s: was it made by another version?\n", name);
    exit(4);
}

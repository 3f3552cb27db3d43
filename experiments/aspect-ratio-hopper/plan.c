/* plan.c - which runs each size is made of. */
#include <fcntl.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"
#include "experiments/study/side.h"

/* `quick` is a hopper of a quarter of the width with 300 particles: it tests the study, and says
 * nothing of the source's hopper. */
/* clang-format off */
const aspect_size SIZES[4] = {
    [STUDY_QUICK] = {"quick", 300, 0.125, 0.5, 4, {0, 1}, 0, 0, 0, 0, false},
    [STUDY_BRIEF] = {"brief", 5000, 0.5, 2, 14, {0, 1}, 0, 0, 0, 0, true},
    [STUDY_PUBLISHED] = {"published", 5000, 0.5, 2, 14, {1, 4}, 1, 1, 1, 20000, true},
    [STUDY_FULL] = {"full", 5000, 0.5, 2, 14, {1, 10}, 3, 3, 2, 20000, true},
};
/* clang-format on */

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
    {"depth of the chamber", "4 m", 2, {NULL}, {"chamber=4 m"}},
    {"depth of the chamber", "4 m", 3, {NULL}, {"chamber=4 m"}},
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
    /* as many dashpots as spheres that touch would be one more thing that differs between smooth
     * and touching chains */
    if (c->shape >= MAIN_SHAPES) job_set(j, "clump=shared");
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

/* m: of the grid and the domain. The grid of the longest chains is higher than those of the main
 * shapes. */
static double top_of(const aspect_study *s, const aspect_case *c) {
    if (c->in_space) return 5;
    return c->shape >= MAIN_SHAPES ? 1.5 * s->size->top : s->size->top;
}

/* s: the fall through the whole grid, and a second more. */
static double consolidation(const aspect_study *s, const aspect_case *c) {
    double columns = floor(2 * c->half_width / (1.01 * chain_length(&c->chain)));
    if (c->in_space) columns *= columns;
    double height = ceil(c->count / columns) * 1.01 * chain_length(&c->chain);
    return 1 + sqrt(2 * fmin(height, top_of(s, c)) / GRAVITY);
}

static void plan_bed(aspect_study *s, aspect_case *c) {
    job *j = &s->beds[s->count];
    j->scene = c->in_space ? SCENES "/bed-3d.yaml" : SCENES "/bed.yaml";
    label(j, c, "bed");
    set_common(j, c);
    job_set(j, "length=%.9g mm", 1e3 * chain_length(&c->chain));
    job_set(j, "count=%d", c->count);
    if (!c->in_space) job_set(j, "height=%g m", top_of(s, c));
    job_set(j, "latest=%.3f s", consolidation(s, c));
    job_set(j, "seed=%d", 1 + c->replicate);
    set_setting(j, c, VARIANTS[c->variant].bed);
    jobs_name(j, s->to.runs);
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
    job_set(j, "top=%g m", top_of(s, c));
    const char *own[3] = {NULL};
    int n = 0;
    for (int i = 0; i < 3 && VARIANTS[c->variant].bed[i]; i++) {
        const char *set = VARIANTS[c->variant].bed[i];
        if (strncmp(set, "tolerance=", 10) && strncmp(set, "jitter=", 7)) own[n++] = set;
    }
    set_setting(j, c, own);
    jobs_name(j, s->to.runs);
    c->rest_folder = j->folder;
}

static void plan_case(aspect_study *s, aspect_case c) {
    CLAST_ASSERT(s->count < CASES_MAX);
    c.chain = chain_of(c.shape);
    c.half_width = c.in_space ? 0.2 : s->size->half_width;
    c.chamber = c.in_space ? 1.5 : s->size->chamber;
    c.count = c.in_space ? s->size->space_count : s->size->count;
    s->cases[s->count] = c;
    plan_bed(s, &s->cases[s->count]);
    plan_rest(s, &s->cases[s->count]);
    s->count++;
}

/* The dearest stands first: the last ones then end together. */
static void plan_set(aspect_study *s, int setting, int replicate, int first, int last) {
    for (int shape = last; shape >= first; shape--)
        plan_case(s, (aspect_case){.shape = shape, .setting = setting, .replicate = replicate});
}

static void plan_variants(aspect_study *s, int replicate, int first, int last) {
    for (int v = first; v <= last; v++)
        plan_case(s, (aspect_case){.shape = VARIANTS[v].shape,
                                   .setting = CHEAP,
                                   .variant = v,
                                   .replicate = replicate});
}

static void plan_in_space(aspect_study *s, int replicate) {
    for (int shape = 1; shape >= 0; shape--)
        plan_case(s,
                  (aspect_case){
                      .shape = shape, .setting = CHEAP, .replicate = replicate, .in_space = true});
}

/* A study that is cut off has what matters most: so many replicates that there is an interval, the
 * source's own setting, more replicates, shape against roughness (with touching chains of two that
 * share a dashpot, variant 1, beside them), three dimensions, assumptions. */
void aspect_plan(aspect_study *s) {
    const aspect_size *z = s->size;
    const int smooth_five = SHAPES - 2, few = 3;
    s->beds = calloc(CASES_MAX, sizeof *s->beds);
    s->rests = calloc(CASES_MAX, sizeof *s->rests);
    s->flows = calloc(CASES_MAX, sizeof *s->flows);
    if (!s->beds || !s->rests || !s->flows) abort();
    for (int k = 0; k < z->replicates[CHEAP] && k < few; k++)
        plan_set(s, CHEAP, k, 0, MAIN_SHAPES - 1);
    for (int k = 0; k < z->replicates[THESIS]; k++) plan_set(s, THESIS, k, 0, MAIN_SHAPES - 1);
    for (int k = few; k < z->replicates[CHEAP]; k++) plan_set(s, CHEAP, k, 0, MAIN_SHAPES - 1);
    for (int k = 0; k < z->further; k++) {
        plan_set(s, CHEAP, k, SHAPES - 1, SHAPES - 1);
        plan_set(s, CHEAP, k, MAIN_SHAPES, smooth_five - 1);
        if (k < z->variants) plan_variants(s, k, 1, 1);
    }
    for (int k = 0; k < z->in_space; k++) plan_in_space(s, k);
    for (int k = 0; k < z->further; k++) plan_set(s, CHEAP, k, smooth_five, smooth_five);
    for (int k = 0; k < z->variants; k++)
        plan_variants(s, k, k < z->further ? 2 : 1, VARIANT_COUNT - 1);
}

static void plan_flow(aspect_study *s, int which) {
    aspect_case *c = &s->cases[which];
    job *j = &s->flows[which];
    j->scene = c->in_space ? SCENES "/flow-3d.yaml" : SCENES "/flow.yaml";
    label(j, c, "flow");
    set_common(j, c);
    job_set(j, "bed=%s", c->rest_folder);
    job_set(j, "height=%.4f m", c->bed.height);
    if (!c->in_space) job_set(j, "top=%g m", top_of(s, c));
    bool own_chamber = false;
    for (int i = 0; i < 3 && VARIANTS[c->variant].flow[i]; i++) {
        const char *set = VARIANTS[c->variant].flow[i];
        if (strncmp(set, "chamber=", 8)) continue;
        own_chamber = true;
        c->chamber = strtod(set + 8, NULL); /* m: the heap is measured from its ground */
    }
    if (!own_chamber) job_set(j, "chamber=%g m", c->chamber);
    if (c->in_space) job_set(j, "latest=1.6 s"); /* the linear part is over */
    set_setting(j, c, VARIANTS[c->variant].flow);
    jobs_name(j, s->to.runs);
    c->flow_folder = j->folder;
}

/* ---- running --------------------------------------------------------------------------------- */

/* Variants of the flow alone have the bed of another case: whoever comes second waits for the
 * first. The lock goes with the process. */
static int lock_of(const char *folder) {
    char path[JOB_FOLDER + 8];
    snprintf(path, sizeof path, "%s.lock", folder);
    int file = open(path, O_CREAT | O_RDWR | O_CLOEXEC, 0666);
    if (file < 0 || flock(file, LOCK_EX)) {
        perror(path);
        exit(4);
    }
    return file;
}

static bool run_job(job *j, int processes) {
    int lock = processes > 0 ? lock_of(j->folder) : -1;
    jobs_run(j, 1, processes, NULL);
    if (lock >= 0) close(lock);
    return j->done;
}

/* Bed, rest and flow, one after the other; measures what there is. processes: 0 or 1. */
static void run_case(aspect_study *s, int which, int processes) {
    aspect_case *c = &s->cases[which];
    if (!run_job(&s->beds[which], processes)) return;
    if (!c->in_space && !run_job(&s->rests[which], processes)) return;
    c->has_bed = true;
    bed_measure(c);
    plan_flow(s, which);
    if (run_job(&s->flows[which], processes)) c->ran = true;
}

static void run_aside(const void *context, int index, void *result) {
    aspect_study *s = (aspect_study *)context; /* what it changes, no other process sees */
    run_case(s, index, 1);
    *(bool *)result = s->cases[index].ran;
}

int aspect_run_all(aspect_study *s) {
    static bool ran[CASES_MAX];
    int failed = 0;
    bool kept = getenv("CLAST_KEPT");
    side_task task = {
        .what = "aspect-ratio-hopper, cases", .work = run_aside, .context = s, .size = sizeof *ran};
    if (!kept) side_by_side(&task, s->count, ran);
    for (int i = 0; i < s->count; i++) {
        run_case(s, i, 0);
        if (s->cases[i].ran) flow_measure(&s->cases[i]);
        failed += !kept && !s->cases[i].ran;
    }
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

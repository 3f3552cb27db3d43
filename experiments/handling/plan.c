/* plan.c - which runs each size is made of. */
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/handling/handling.h"

const char *const KIND_NAME[KINDS] = {"tapered", "irregular", "bunch",  "singulation",
                                      "disc",    "bin",       "mixture"};
const double ORIFICE_CM[ORIFICES] = {5, 6.5, 8};

enum { MIDDLE_SHAPE = 2 };

const handling_size SIZES[4] = {
    [STUDY_QUICK] = {"quick", {2, 1, 1, 1, 1, 1, 0}, 1, 1, 0},
    [STUDY_BRIEF] = {"brief", {5, 2, 1, 1, 1, 2, 1}, SHAPES, ORIFICES, 0},
    [STUDY_PUBLISHED] = {"published", {20, 20, 10, 20, 1, 5, 1}, SHAPES, ORIFICES, 2},
    [STUDY_FULL] = {"full", {40, 40, 20, 40, 1, 20, 1}, SHAPES, ORIFICES, 20},
};

/* Young's modulus of the button and of chapter 5, with the Rayleigh step that belongs to it. */
#define SOFT   "young=3.5 GPa"
#define SHARED "clump=shared"

/* Rows of tables read better as they stand here: */
/* clang-format off */
const variant VARIANTS[] = {
    {KINDS, "(baseline)", "", {NULL}, {NULL}},
    {TAPERED, "Young's modulus", "3.5 GPa", {NULL}, {SOFT, "step=19.6 us"}},
    {TAPERED, "time step", "a tenth", {NULL}, {"step=1.19 us"}},
    {TAPERED, "spheres 7 and 14", "where the cone has them", {NULL},
     {"seventh=0.79 cm", "fourteenth=5.76 cm"}},
    {TAPERED, "centre of mass", "of the union", {NULL}, {"offset=2.56 mm"}},
    {TAPERED, "damping of clumps", "shared", {NULL}, {SHARED}},
    {IRREGULAR, "Young's modulus", "3.5 GPa", {SOFT, "step=82.4 us"},
     {SOFT, "step=82.4 us", "sample=82.4 us"}},
    {IRREGULAR, "time step", "a tenth", {NULL}, {"step=5 us", "sample=50 us"}},
    {IRREGULAR, "centre of mass", "of the union", {"offset=3.22 mm"},
     {"offset=3.22 mm", "sample=50 us"}},
    {IRREGULAR, "damping of clumps", "shared", {SHARED}, {SHARED, "sample=50 us"}},
    {BUNCH, "Young's modulus", "3.5 GPa", {SOFT, "step=19.6 us"}, {SOFT, "step=19.6 us"}},
    {BUNCH, "orifice while settling", "open", {"opened=1 us"}, {NULL}},
    {BUNCH, "damping of clumps", "shared", {SHARED}, {SHARED}},
    {SINGULATION, "Young's modulus", "3.5 GPa", {SOFT, "step=84 us"}, {SOFT, "step=84 us"}},
    {SINGULATION, "between the conveyors", "closed", {NULL}, {"opened=1000 s"}},
    {SINGULATION, "damping of clumps", "shared", {SHARED}, {SHARED}},
    {DISC, "one sphere", "", {NULL}, {"count=1"}},
    {DISC, "disc", "as wide as the box", {NULL}, {"radius=70 cm"}},
    {DISC, "spin", "10 rpm", {NULL}, {"spin=10 rpm"}},
    {BIN, "Young's modulus", "3.5 GPa", {SOFT}, {SOFT}},
    {BIN, "time step", "a half", {"step=5 us"}, {"step=5 us"}},
    {BIN, "friction while settling", "0.5", {"friction=0.5", "wall_friction=0.5"}, {NULL}},
    {BIN, "friction while flowing", "0.2", {NULL}, {"friction=0.2", "wall_friction=0.2"}},
    {BIN, "orifice", "5 x 5 cm", {NULL}, {"ledges=1000 s"}},
    {BIN, "damping of clumps", "shared", {SHARED}, {SHARED}},
};
/* clang-format on */
const int VARIANT_COUNT = sizeof VARIANTS / sizeof *VARIANTS;

/* ---- jobs ------------------------------------------------------------------------------------ */

static const char *const BED_SCENE[KINDS] = {NULL,
                                             SCENES "/irregular-settle.yaml",
                                             SCENES "/bunch-settle.yaml",
                                             SCENES "/singulation-fill.yaml",
                                             NULL,
                                             SCENES "/bin-fill.yaml",
                                             NULL};
static const char *const SCENE[KINDS] = {SCENES "/tapered.yaml", SCENES "/irregular.yaml",
                                         SCENES "/bunch.yaml",   SCENES "/singulation.yaml",
                                         SCENES "/disc.yaml",    SCENES "/bin-flow.yaml",
                                         SCENES "/mixture.yaml"};

static void set_all(job *j, const char *const *settings) {
    for (int i = 0; i < 3 && settings[i]; i++) job_set(j, "%s", settings[i]);
}

static void set_shape(job *j, const handling_run *r) {
    if (r->kind != BIN) return;
    pair_shape p = pair_of(ASPECT[r->shape]);
    job_set(j, "radius=%.9g mm", 10 * p.radius);
    job_set(j, "half=%.9g mm", 10 * p.half);
    job_set(j, "axial=%.9g cm2", p.axial);
    job_set(j, "across=%.9g cm2", p.across);
}

static const char *plan_bed(handling_study *s, const handling_run *r) {
    job *j = &s->beds[s->bed_count++];
    j->scene = BED_SCENE[r->kind];
    snprintf(j->label, sizeof j->label, "%s-bed-%02d", KIND_NAME[r->kind], r->replicate + 1);
    job_set(j, "seed=%d", 1 + r->replicate);
    set_shape(j, r);
    set_all(j, VARIANTS[r->variant].bed);
    jobs_name(j, s->to.runs);
    return j->folder;
}

static void plan_run(handling_study *s, handling_run *r) {
    const variant *v = &VARIANTS[r->variant];
    job *j = &s->jobs[s->run_count];
    j->scene = SCENE[r->kind];
    snprintf(j->label, sizeof j->label, "%s-%02d", KIND_NAME[r->kind], r->replicate + 1);
    if (BED_SCENE[r->kind])
        job_set(j, "bed=%s", plan_bed(s, r));
    else
        job_set(j, "seed=%d", 1 + r->replicate);
    set_shape(j, r);
    if (r->kind == BIN) job_set(j, "orifice=%g cm", ORIFICE_CM[r->orifice]);
    if (r->kind == IRREGULAR && r->variant == 0) job_set(j, "sample=50 us");
    if (r->kind == SINGULATION && s->size == &SIZES[STUDY_QUICK]) job_set(j, "latest=8 s");
    set_all(j, v->run);
    jobs_name(j, s->to.runs);
    r->folder = j->folder;
    s->runs[s->run_count++] = *r;
}

static void plan_kind(handling_study *s, scene_kind kind, int of_variant, int replicates) {
    bool all = kind == BIN && of_variant == 0;
    int shapes = all ? s->size->shapes : 1, orifices = all ? s->size->orifices : 1;
    for (int shape = 0; shape < shapes; shape++)
        for (int orifice = 0; orifice < orifices; orifice++)
            for (int k = 0; k < replicates; k++) {
                bool one = kind == BIN && shapes == 1;
                CLAST_ASSERT(s->run_count < RUNS_MAX);
                plan_run(s, &(handling_run){.kind = kind,
                                            .variant = of_variant,
                                            .replicate = k,
                                            .shape = one ? MIDDLE_SHAPE : shape,
                                            .orifice = orifice});
            }
}

void handling_plan(handling_study *s) {
    s->beds = calloc(RUNS_MAX, sizeof *s->beds);
    s->jobs = calloc(RUNS_MAX, sizeof *s->jobs);
    if (!s->beds || !s->jobs) abort();
    for (int kind = 0; kind < KINDS; kind++)
        plan_kind(s, (scene_kind)kind, 0, s->size->replicates[kind]);
    for (int v = 1; v < VARIANT_COUNT; v++) {
        scene_kind kind = VARIANTS[v].kind;
        int replicates = s->size->replicates[kind], most = s->size->variants;
        if (kind == DISC) most = 1; /* half a second each: at every size */
        plan_kind(s, kind, v, replicates < most ? replicates : most);
    }
}

int handling_run_all(handling_study *s) {
    int processes = jobs_processes();
    int failed = jobs_run(s->beds, s->bed_count, processes, "settling");
    failed += jobs_run(s->jobs, s->run_count, processes, "handling");
    for (int i = 0; i < s->run_count; i++) s->runs[i].ran = s->jobs[i].done;
    return failed;
}

/* ---- looking runs up ------------------------------------------------------------------------- */

static const handling_run *find(const handling_study *s, scene_kind kind, int of_variant, int shape,
                                int orifice, int replicate) {
    for (int i = 0; i < s->run_count; i++) {
        const handling_run *r = &s->runs[i];
        if (r->ran && r->kind == kind && r->variant == of_variant && r->replicate == replicate &&
            (shape < 0 || r->shape == shape) && (orifice < 0 || r->orifice == orifice))
            return r;
    }
    return NULL;
}

const handling_run *run_of(const handling_study *s, scene_kind kind, int of_variant,
                           int replicate) {
    return find(s, kind, of_variant, -1, -1, replicate);
}

const handling_run *flow_of(const handling_study *s, int of_variant, int shape, int orifice,
                            int replicate) {
    return find(s, BIN, of_variant, shape, orifice, replicate);
}

double spin_of(int of_variant) {
    bool slow = VARIANTS[of_variant].kind == DISC && !strcmp(VARIANTS[of_variant].name, "10 rpm");
    return slow ? DISC_SPIN * 6.283185307179586 / 60 : DISC_SPIN;
}

results *run_open(const handling_run *r) {
    char why[RESULTS_ERROR_MAX];
    results *all = results_open(r->folder, why);
    if (all) return all;
    fprintf(stderr, "handling: %s\n", why);
    exit(4);
}

const double *run_column(const results *r, const char *name) {
    const double *c = results_series(r, name);
    if (c) return c;
    fprintf(stderr, "handling: a run has no column %s: was it made by another version?\n", name);
    exit(4);
}

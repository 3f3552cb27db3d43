/* plan.c - which discharges there are, and all of them run. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/output.h"

const clast_scheme METHOD_SCHEME[METHODS] = {
    [LEAPFROG] = CLAST_SCHEME_LEAPFROG,
    [EXPLICIT] = CLAST_SCHEME_POSITION_VERLET, /* S12 3.9: the pair that it compares */
    [IMPLICIT] = CLAST_SCHEME_NUMEROV_CENTRAL};

/* From 32 steps per shortest contact to 4; the source begins above 25. */
const double STEP[STEPS] = {1e-4, 2e-4, 4e-4, 6e-4, 8e-4};
const double SCAN[SCANS] = {0.9e-3, 1.0e-3, 1.1e-3, 1.2e-3, 1.3e-3, 1.4e-3,
                            1.5e-3, 1.6e-3, 1.7e-3, 1.8e-3, 1.9e-3, 2.0e-3};
const char *const CRITERION_NAME[CRITERIA] = {"through walls", "stopped", "energy"};

enum { COARSE_FIRST = 1, COARSE_STRIDE = 2 }; /* of SCAN, for the other variants */
#define HISTORY_EVERY 0.01                    /* s */

const char *method_name(int method) {
    return clast_scheme_info_of(METHOD_SCHEME[method])->name;
}

/* ---- what is there --------------------------------------------------------------------------- */

static hopper *take(const discharge_size *size, hopper_variant *v, const char *assumption,
                    const char *taken) {
    *v = (hopper_variant){assumption, taken, hopper_usual(size->rows)};
    return &v->hopper;
}

static int variants_of(const discharge_size *size, hopper_variant *out) {
    int n = 0;
    take(size, &out[n++], "as assumed", "");
    if (size->variant_states == 0) return n;
    take(size, &out[n++], "orifice", "75 mm")->orifice = 0.075;
    take(size, &out[n++], "orifice", "115 mm")->orifice = 0.115;
    take(size, &out[n++], "walls, from the vertical", "20°")->slope = 0.364;
    take(size, &out[n++], "walls, from the vertical", "35°")->slope = 0.700;
    take(size, &out[n++], "sizes", "uniform in 1/d")->sizes = SIZES_INVERSE;
    take(size, &out[n++], "walls", "half-spaces")->solid = true;
    take(size, &out[n++], "filling", "1500 spheres")->rows = 50;
    take(size, &out[n++], "filling", "loose")->filling = FILL_LOOSE;
    take(size, &out[n++], "shape", "rectangular, flat bottom")->flat = true;
    CLAST_ASSERT(n == VARIANTS);
    return n;
}

int study_states(const discharge_study *s, int variant) {
    return variant == 0 ? s->size->states : s->size->variant_states;
}

/* Beds stand one after the other, those of the usual hopper first. */
const bed *study_bed(const discharge_study *s, int variant, int state) {
    CLAST_ASSERT(state >= 0 && state < study_states(s, variant));
    if (variant == 0) return &s->bed[state];
    return &s->bed[s->size->states + (variant - 1) * s->size->variant_states + state];
}

static int variant_of_bed(const discharge_study *s, int which, int *state) {
    *state = which;
    if (which < s->size->states) return 0;
    which -= s->size->states;
    *state = which % s->size->variant_states;
    return 1 + which / s->size->variant_states;
}

const flow *study_flow(const discharge_study *s, int method, int variant, int state, double step) {
    for (int i = 0; i < s->runs; i++) {
        const discharge_run *r = &s->run[i];
        if (r->method == method && r->variant == variant && r->state == state && r->step == step)
            return &r->flow;
    }
    return NULL;
}

static void *grown(void *list, int count, size_t size) {
    void *p = realloc(list, ((size_t)count + 1) * size);
    CLAST_ASSERT(p);
    return p;
}

static void plan_run(discharge_study *s, int method, int variant, double step) {
    for (int state = 0; state < study_states(s, variant); state++) {
        s->run = grown(s->run, s->runs, sizeof *s->run);
        s->run[s->runs++] =
            (discharge_run){.method = method, .variant = variant, .state = state, .step = step};
    }
}

static void plan_limits(discharge_study *s, int variant) {
    for (int method = EXPLICIT; method <= IMPLICIT; method++)
        for (int state = 0; state < study_states(s, variant); state++)
            for (int k = 0; k < CRITERIA; k++) {
                if (k == BY_ENERGY && s->variant[variant].hopper.solid) continue;
                s->limit = grown(s->limit, s->limits, sizeof *s->limit);
                s->limit[s->limits++] = (failure_step){method, variant, state, k, 0, 0};
            }
}

/* Implicit steps cost about ten times as much; the longest go first. */
static double cost_of(const discharge_run *r) {
    return (r->method == IMPLICIT ? 10 : r->method == EXPLICIT ? 1 : 0.1) / r->step;
}

static int dearer_first(const void *a, const void *b) {
    double ca = cost_of(a), cb = cost_of(b);
    return ca > cb ? -1 : ca < cb;
}

static void plan(discharge_study *s) {
    for (int i = s->size->first_step; i < STEPS; i++)
        for (int method = 0; method < METHODS; method++) plan_run(s, method, 0, STEP[i]);
    for (int i = 0; i < s->size->scans; i++)
        for (int method = EXPLICIT; method <= IMPLICIT; method++) plan_run(s, method, 0, SCAN[i]);
    plan_limits(s, 0);
    for (int v = 1; v < s->variants; v++) {
        for (int method = EXPLICIT; method <= IMPLICIT; method++) {
            plan_run(s, method, v, STEP[1]), plan_run(s, method, v, STEP[STEPS - 1]);
            for (int i = COARSE_FIRST; i < SCANS; i += COARSE_STRIDE)
                plan_run(s, method, v, SCAN[i]);
        }
        plan_limits(s, v);
    }
    qsort(s->run, (size_t)s->runs, sizeof *s->run, dearer_first);
}

/* ---- beds ------------------------------------------------------------------------------------ */

static void name_bed(const void *context, int which, char name[NAME_MAX_TEXT]) {
    const discharge_study *s = context;
    int state, variant = variant_of_bed(s, which, &state);
    snprintf(name, NAME_MAX_TEXT, "bed, variant %d, state %d, %d rows", variant, state,
             s->size->rows);
}

static void make_bed(const void *context, int which, void *result) {
    const discharge_study *s = context;
    int state, variant = variant_of_bed(s, which, &state);
    bed_make(&s->variant[variant].hopper, 1 + (uint64_t)state, result);
}

static void make_beds(discharge_study *s) {
    s->beds = s->size->states + (s->variants - 1) * s->size->variant_states;
    s->bed = calloc((size_t)s->beds, sizeof *s->bed);
    CLAST_ASSERT(s->bed);
    kept_results(&(kept_task){"beds", sizeof *s->bed, 0, s, name_bed, make_bed}, s->beds, s->bed);
}

/* ---- networks -------------------------------------------------------------------------------- */

static void name_history(const void *context, int which, char name[NAME_MAX_TEXT]) {
    const discharge_study *s = context;
    snprintf(name, NAME_MAX_TEXT, "network, state %d, %d rows", which, s->size->rows);
}

static void make_history(const void *context, int which, void *result) {
    const discharge_study *s = context;
    history_run(&s->variant[0].hopper, study_bed(s, 0, which), HISTORY_EVERY, result);
}

static void follow_networks(discharge_study *s) {
    s->history = calloc((size_t)s->size->states, sizeof *s->history);
    CLAST_ASSERT(s->history);
    kept_results(&(kept_task){"networks", sizeof *s->history, 0, s, name_history, make_history},
                 s->size->states, s->history);
}

/* ---- discharges ------------------------------------------------------------------------------ */

static void name_flow(const void *context, int which, char name[NAME_MAX_TEXT]) {
    const discharge_study *s = context;
    const discharge_run *r = &s->run[which];
    snprintf(name, NAME_MAX_TEXT, "%s, variant %d, state %d, step %.17g, %d rows",
             method_name(r->method), r->variant, r->state, r->step, s->size->rows);
}

static void make_flow(const void *context, int which, void *result) {
    const discharge_study *s = context;
    const discharge_run *r = &s->run[which];
    flow_plan p = {.hopper = &s->variant[r->variant].hopper,
                   .bed = study_bed(s, r->variant, r->state),
                   .world = {.scheme = METHOD_SCHEME[r->method], .step = r->step},
                   .until = hopper_latest(&s->variant[r->variant].hopper)};
    flow_run(&p, result);
}

static void discharge(discharge_study *s) {
    flow *flows = calloc((size_t)s->runs + 1, sizeof *flows);
    CLAST_ASSERT(flows);
    kept_results(&(kept_task){"discharges", sizeof *flows, 0, s, name_flow, make_flow}, s->runs,
                 flows);
    for (int i = 0; i < s->runs; i++) s->run[i].flow = flows[i];
    free(flows);
}

void study_run(discharge_study *s) {
    output_folder(BUILD_FOLDER "/studies/hopper-discharge/kept");
    s->variants = variants_of(s->size, s->variant);
    plan(s);
    make_beds(s);
    follow_networks(s);
    discharge(s);
    limits_find(s);
    prices_find(s);
}

void study_forget(discharge_study *s) {
    free(s->bed), free(s->history), free(s->run), free(s->limit), free(s->price);
}

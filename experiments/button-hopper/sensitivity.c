/* sensitivity.c - what each assumption does to the rate and to the bed.
 *
 * At 7.5 cm, the smallest orifice that flowed smoothly in the experiment; and, for what could
 * explain the low rate there, at 5 cm. All variants run at twice the time step of the study (a row
 * of its own shows what that does) and end when the linear part is over. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/button-hopper/hopper.h"

enum { NARROW = 0, MIDDLE = 2 }; /* 5 and 7.5 cm */

/* Without fill settings the beds are those of the baseline. */
static const struct {
    int orifice;
    const char *assumption, *variant, *fill, *flow;
} VARIANTS[] = {
    {MIDDLE, "(baseline)", "step 4.5 us", "", ""},
    {MIDDLE, "friction while flowing", "0.1", "", "friction=0.1,wall_friction=0.1"},
    {MIDDLE, "friction while flowing", "0.4", "", "friction=0.4,wall_friction=0.4"},
    {MIDDLE, "friction while flowing", "0.61 / 0.67 (static)", "",
     "friction=0.61,wall_friction=0.67"},
    {MIDDLE, "wall friction while settling", "0.2", "wall_friction=0.2", ""},
    {MIDDLE, "restitution while settling", "0.27 (Appendix D)", "restitution=0.27", ""},
    {MIDDLE, "grid before settling", "10 columns", "columns=10", ""},
    {MIDDLE, "friction while settling", "0.2", "friction=0.2,wall_friction=0.2", ""},
    {MIDDLE, "restitution while flowing", "0.5", "", "restitution=0.5"},
    {MIDDLE, "restitution while flowing", "0.9", "", "restitution=0.9"},
    {MIDDLE, "time step", "2.3 us", "step=2.3 us", "step=2.3 us"},
    {MIDDLE, "time step", "1.15 us", "", "step=1.15 us"},
    {MIDDLE, "Young's modulus while flowing", "350 MPa", "", "young=350 MPa"},
    {MIDDLE, "Young's modulus while flowing", "35 MPa", "", "young=35 MPa"},
    {MIDDLE, "inertia of a button", "ellipsoid (/5)", "inertia_divisor=5", "inertia_divisor=5"},
    {MIDDLE, "spheres per button", "5", "spheres=5", "spheres=5"},
    {MIDDLE, "spheres per button", "15", "spheres=15", "spheres=15"},
    {MIDDLE, "front and back sheets", "leaning 5 deg", "", "gravity=9.602 m/s2"},
    {MIDDLE, "friction limit", "spring alone (1.73)", "", "friction_limit=spring"},
    {MIDDLE, "tangential spring", "as printed (1.14)", "", "unloading=as-printed"},
    {NARROW, "(baseline)", "step 4.5 us", "", ""},
    {NARROW, "friction while flowing", "0", "", "friction=0,wall_friction=0"},
    {NARROW, "friction while flowing", "0.1", "", "friction=0.1,wall_friction=0.1"},
    {NARROW, "friction while settling", "0.2", "friction=0.2,wall_friction=0.2", ""},
    {NARROW, "spheres per button", "15", "spheres=15", "spheres=15"},
    {NARROW, "restitution while flowing", "0.9", "", "restitution=0.9"},
};

/* "a=1,b=2" replaces settings of that name or adds them. */
static void apply(job *j, const char *settings) {
    char copy[200], *rest = NULL;
    snprintf(copy, sizeof copy, "%s", settings);
    for (char *one = strtok_r(copy, ",", &rest); one; one = strtok_r(NULL, ",", &rest)) {
        size_t name = (size_t)(strchr(one, '=') - one) + 1;
        int i = 0;
        while (i < j->set_count && strncmp(j->set[i], one, name)) i++;
        if (i == j->set_count)
            job_set(j, "%s", one);
        else
            snprintf(j->set[i], JOB_TEXT, "%s", one);
    }
}

static void plan_bed(job *j, const hopper_study *s, int replicate, const char *extra) {
    *j = (job){.scene = SCENES "/fill.yaml"};
    snprintf(j->label, sizeof j->label, "variant-bed-%02d", replicate + 1);
    job_set(j, "seed=%d", 1 + replicate);
    job_set(j, "step=4.5 us");
    job_set(j, "settle=%s", s->size->settle);
    apply(j, extra);
    jobs_name(j, s->root);
}

static void plan_flow(job *j, const hopper_study *s, const job *bed, int replicate, int variant) {
    int orifice = VARIANTS[variant].orifice;
    *j = (job){.scene = SCENES "/discharge.yaml"};
    snprintf(j->label, sizeof j->label, "variant-flow-%02d", replicate + 1);
    job_set(j, "bed=%s", bed->folder);
    job_set(j, "orifice=%g cm", ORIFICE_CM[orifice]);
    job_set(j, "step=4.5 us");
    job_set(j, "latest=%s", orifice == NARROW ? "1.7 s" : "0.8 s");
    apply(j, VARIANTS[variant].flow);
    jobs_name(j, s->root);
}

static void measure_variant(hopper_variant *v, const job *flows, int replicates) {
    double q[REPLICATES_MAX], rest[REPLICATES_MAX];
    int n = 0, beds = 0;
    for (int k = 0; k < replicates; k++) {
        if (!flows[k].done) continue;
        hopper_run r = {.orifice = v->orifice, .folder = flows[k].folder};
        hopper_measure(&r);
        if (isfinite(r.rate[0])) q[n++] = r.rate[0];
        v->blocked += !isfinite(r.rate[0]);
        rest[beds++] = r.phi_rest;
        free(r.velocity);
        free(r.velocity_x);
    }
    v->q = mean_interval(q, n);
    v->rest = mean_interval(rest, beds);
}

int hopper_sensitivity_run(const hopper_study *s, hopper_sensitivity *out) {
    int count = sizeof VARIANTS / sizeof *VARIANTS, replicates = s->size->sensitivity_replicates;
    *out = (hopper_sensitivity){.count = 0};
    if (replicates == 0) return 0;
    size_t runs = (size_t)(count * replicates);
    job *beds = calloc(runs, sizeof *beds), *flows = calloc(runs, sizeof *flows);
    if (!beds || !flows) abort();
    for (int v = 0; v < count; v++)
        for (int k = 0; k < replicates; k++)
            plan_bed(&beds[v * replicates + k], s, k, VARIANTS[v].fill);
    int failed = jobs_run(beds, (int)runs, s->processes, "filling, sensitivity");
    for (int v = 0; v < count; v++)
        for (int k = 0; k < replicates; k++)
            plan_flow(&flows[v * replicates + k], s, &beds[v * replicates + k], k, v);
    failed += jobs_run(flows, (int)runs, s->processes, "discharge, sensitivity");
    out->count = count;
    for (int v = 0; v < count; v++) {
        hopper_variant *to = &out->variants[v];
        to->orifice = VARIANTS[v].orifice;
        snprintf(to->assumption, sizeof to->assumption, "%s", VARIANTS[v].assumption);
        snprintf(to->variant, sizeof to->variant, "%s", VARIANTS[v].variant);
        measure_variant(to, flows + v * replicates, replicates);
    }
    free(beds);
    free(flows);
    return failed;
}

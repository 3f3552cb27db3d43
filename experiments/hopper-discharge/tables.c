/* tables.c - the data folder: plain CSV that the figures are drawn from (README.md has the
 * columns). */
#include <inttypes.h>
#include <math.h>

#include "engine/fnv.h"
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

/* ---- discharges ------------------------------------------------------------------------------ */

/* One row per run; read by the study of speed against accuracy. */
static void put_run(FILE *f, const discharge_run *r) {
    const flow *w = &r->flow;
    const char *words = flow_failure(w);
    fprintf(f, "%s,%g,%d,%.8g,%.6g,%.4g,%.0f,%.0f,%.4g,%d,", method_name(r->method), r->step,
            1 + r->state, w->residence, w->residence_sd, w->energy_error, w->evaluations, w->newton,
            w->cpu / w->span, *words != 0);
    csv_put(f, words);
    fputc('\n', f);
}

static bool is_of_table(const discharge_study *s, const discharge_run *r) {
    return r->variant == 0 && r->step >= STEP[s->size->first_step] && r->step <= STEP[STEPS - 1];
}

static int write_runs(const discharge_study *s) {
    FILE *f = output_table(s->data, "runs.csv",
                           "method,step_s,seed,mean_residence_s,sd_residence_s,energy_error,"
                           "force_evaluations,newton_iterations,cpu_s_per_s,failed,failure");
    if (!f) return 4;
    for (int method = 0; method < METHODS; method++)
        for (int i = s->size->first_step; i < STEPS; i++)
            for (int k = 0; k < s->runs; k++)
                if (is_of_table(s, &s->run[k]) && s->run[k].method == method &&
                    s->run[k].step == STEP[i])
                    put_run(f, &s->run[k]);
    return output_close(f);
}

/* What runs.csv has no room for, of all runs. */
static int write_flows(const discharge_study *s) {
    FILE *f = output_table(s->data, "flows.csv",
                           "method,variant,step_s,seed,residence_s,residence_all_s,energy_error,"
                           "energy_worst,heated_s,failed,stopped_s,wall_overlap,first_through_s,"
                           "through,trapped,span_s,steps,"
                           "linear_iterations,unconverged,bed_energy_J");
    if (!f) return 4;
    for (int i = 0; i < s->runs; i++) {
        const discharge_run *r = &s->run[i];
        const flow *w = &r->flow;
        fprintf(f, "%s,%d,%g,%d,%.8g,%.8g,%.4g,%.4g,%.4g,", method_name(r->method), r->variant,
                r->step, 1 + r->state, w->residence, w->residence_all, w->energy_error,
                w->energy_worst, w->heated);
        csv_put(f, FAILURE_NAME[w->failed]);
        fprintf(f, ",%.4g,%.4g,%.4g,%d,%d,%.4g,%.0f,%.0f,%.0f,%.5g\n", w->stopped, w->overlap,
                w->first_through, w->through, w->trapped, w->span, w->steps, w->linear,
                w->unconverged, w->bed_energy);
    }
    return output_close(f);
}

/* ---- residence times ------------------------------------------------------------------------- */

static void put_residence(FILE *f, const discharge_study *s, int method, double step) {
    interval mean = residence_at(s, method, 0, step);
    interval drift = residence_drift(s, method, 0, STEP[s->size->first_step], step);
    interval ratio = residence_ratio(s, method, EXPLICIT, 0, step);
    if (mean.n == 0) return;
    fprintf(f, "%s,%g,%.4g,%d,%.6g,%.4g,%.4g,%.4g,%.6g,%.4g\n", method_name(method), step,
            shortest_contact() / step, mean.n, mean.mean, mean.half, drift.mean, drift.half,
            ratio.mean, ratio.half);
}

/* Beyond the five steps as far as runs come to their end. */
static int write_residence(const discharge_study *s) {
    FILE *f = output_table(s->data, "residence.csv",
                           "method,step_s,resolution,n,mean_s,half_s,drift,drift_half,"
                           "over_explicit,over_explicit_half");
    if (!f) return 4;
    for (int method = 0; method < METHODS; method++) {
        for (int i = s->size->first_step; i < STEPS; i++) put_residence(f, s, method, STEP[i]);
        for (int i = 0; i < s->size->scans; i++) put_residence(f, s, method, SCAN[i]);
    }
    return output_close(f);
}

/* ---- limits ---------------------------------------------------------------------------------- */

static int write_limits(const discharge_study *s) {
    FILE *f = output_table(s->data, "limits.csv",
                           "method,variant,seed,criterion,holds_s,fails_s,limit_s,predicted_s");
    if (!f) return 4;
    for (int i = 0; i < s->limits; i++) {
        const failure_step *l = &s->limit[i];
        double predicted = l->variant == 0 ? predicted_limit(s, l->method, l->state) : NAN;
        fprintf(f, "%s,%d,%d,%s,%.6g,%.6g,%.6g,%.6g\n", method_name(l->method), l->variant,
                1 + l->state, CRITERION_NAME[l->criterion], l->holds, l->fails,
                0.5 * (l->holds + l->fails), predicted);
    }
    return output_close(f);
}

static int write_networks(const discharge_study *s) {
    FILE *f = output_table(s->data, "networks.csv",
                           "seed,time_s,spheres,largest_rad_s,alone_rad_s,coordination,overlap,"
                           "explicit_limit_s,implicit_limit_s");
    if (!f) return 4;
    for (int state = 0; state < s->size->states; state++)
        for (int k = 0; k < s->history[state].count; k++) {
            const network_moment *m = &s->history[state].moment[k];
            fprintf(f, "%d,%.4g,%d,%.6g,%.6g,%.4g,%.4g,%.6g,%.6g\n", 1 + state, m->time,
                    m->network.spheres, m->network.largest, m->network.alone,
                    m->network.coordination, m->network.overlap,
                    predicted_at(EXPLICIT, m->network.largest),
                    predicted_at(IMPLICIT, m->network.largest));
        }
    return output_close(f);
}

/* ---- prices and assumptions ------------------------------------------------------------------ */

static int write_prices(const discharge_study *s) {
    FILE *f = output_table(s->data, "prices.csv",
                           "kind,step_s,force_evaluations_per_s,newton_iterations_per_s,"
                           "linear_iterations_per_s,cpu_s_per_s");
    if (!f) return 4;
    for (int i = 0; i < s->prices; i++) {
        const price *p = &s->price[i];
        csv_put(f, PRICE_NAME[p->kind]);
        fprintf(f, ",%g,%.6g,%.6g,%.6g,%.4g\n", p->step, p->evaluations, p->newton, p->linear,
                p->cpu);
    }
    return output_close(f);
}

static void put_interval(FILE *f, interval x) {
    fprintf(f, ",%.5g,%.3g", x.mean, x.half);
}

static int write_sensitivity(const discharge_study *s) {
    FILE *f = output_table(s->data, "sensitivity.csv",
                           "assumption,variant,n,residence_s,residence_half,drift_explicit,"
                           "drift_explicit_half,drift_implicit,drift_implicit_half,"
                           "through_explicit_s,through_explicit_half,through_implicit_s,"
                           "through_implicit_half,stop_explicit_s,stop_explicit_half,"
                           "stop_implicit_s,stop_implicit_half,energy_explicit_s,"
                           "energy_explicit_half,energy_implicit_s,energy_implicit_half");
    if (!f) return 4;
    for (int v = 0; s->variants > 1 && v < s->variants; v++) {
        const double from = STEP[1], to = STEP[STEPS - 1];
        csv_put(f, s->variant[v].assumption), fputc(',', f);
        csv_put(f, s->variant[v].taken);
        fprintf(f, ",%d", study_states(s, v));
        put_interval(f, residence_at(s, EXPLICIT, v, from));
        put_interval(f, residence_drift(s, EXPLICIT, v, from, to));
        put_interval(f, residence_drift(s, IMPLICIT, v, from, to));
        for (int k = 0; k < CRITERIA; k++)
            for (int method = EXPLICIT; method <= IMPLICIT; method++)
                put_interval(f, limit_at(s, method, v, k));
        fputc('\n', f);
    }
    return output_close(f);
}

/* ---- all ------------------------------------------------------------------------------------- */

/* Of all results, in the order of the runs. */
static uint64_t hash_of(const discharge_study *s) {
    uint64_t hash = FNV_START;
    for (int i = 0; i < s->runs; i++) {
        const double numbers[2] = {s->run[i].flow.residence_all, s->run[i].flow.energy_worst};
        hash = fnv_bytes(hash, numbers, sizeof numbers);
    }
    return hash;
}

static int write_about(const discharge_study *s) {
    FILE *f = output_table(s->data, "about.txt", "study=hopper-discharge");
    if (!f) return 4;
    const bed *b = study_bed(s, 0, 0);
    fprintf(f, "size=%s\nreplicates=%d initial states\nhash=0x%016" PRIx64 "\nengine=%s\n",
            s->size_name, s->size->states, hash_of(s), CLAST_VERSION);
    fprintf(f, "spheres=%d\ntracers=%d\nruns=%d\n", b->count, b->count / TRACER_EVERY, s->runs);
    fprintf(f, "mass_kg=%.4g\nsettled_s=%.3g\n", bed_mass(b), b->settled);
    fprintf(f, "shortest_contact_ms=%.4g\n", 1e3 * shortest_contact());
    return output_close(f);
}

int discharge_write_tables(const discharge_study *s) {
    int bad = write_runs(s) | write_flows(s) | write_residence(s) | write_limits(s);
    bad |= write_networks(s) | write_prices(s) | write_sensitivity(s) | write_about(s);
    return bad ? 4 : 0;
}

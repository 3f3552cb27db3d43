/* summary.c - replicates into the numbers that the source prints. */
#include <math.h>
#include <stdlib.h>

#include "engine/clast.h"
#include "experiments/button-hopper/hopper.h"

typedef double pick(const hopper_run *r);

/* A run that never had a linear part has delivered nothing: it counts as 0, it is not dropped. */
static double pick_q(const hopper_run *r) {
    return isfinite(r->rate[0]) ? r->rate[0] : 0;
}
static double pick_q_loose(const hopper_run *r) {
    return r->rate[1];
}
static double pick_q_strict(const hopper_run *r) {
    return r->rate[2];
}
static double pick_rho(const hopper_run *r) {
    return r->rho_flow;
}
static double pick_phi(const hopper_run *r) {
    return r->phi_flow;
}
static double pick_c(const hopper_run *r) {
    return r->c;
}
static double pick_rest(const hopper_run *r) {
    return r->phi_rest;
}
static double pick_rest_top(const hopper_run *r) {
    return r->phi_rest_top;
}

/* Over the runs of a fill at an orifice (-1: of the first orifice that was run, one per bed). */
static interval mean_of(const hopper_study *s, int fill, int orifice, pick *value) {
    double x[REPLICATES_MAX];
    int n = 0;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        bool first = i == 0 || s->runs[i - 1].bed != r->bed;
        if (!r->ran || r->fill != fill || (orifice >= 0 ? r->orifice != orifice : !first)) continue;
        double v = value(r);
        if (isfinite(v) && n < REPLICATES_MAX) x[n++] = v;
    }
    return mean_interval(x, n);
}

static hopper_mean mean_at(const hopper_study *s, int fill, int orifice) {
    hopper_mean m = {.q = mean_of(s, fill, orifice, pick_q)};
    m.q_r2[0] = m.q;
    m.q_r2[1] = mean_of(s, fill, orifice, pick_q_loose);
    m.q_r2[2] = mean_of(s, fill, orifice, pick_q_strict);
    m.rho = mean_of(s, fill, orifice, pick_rho);
    m.phi = mean_of(s, fill, orifice, pick_phi);
    m.c = mean_of(s, fill, orifice, pick_c);
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != fill || r->orifice != orifice) continue;
        m.runs++;
        m.blocked += r->blocked;
        m.with_arch += r->arch_count > 0;
        m.longest_pause = fmax(m.longest_pause, r->pause.length);
    }
    return m;
}

/* A00 4.5 over all replicates with a rate, from one orifice on. */
static beverloo fit_from(const hopper_study *s, int first_orifice) {
    double d[REPLICATES_MAX * ORIFICES], q[REPLICATES_MAX * ORIFICES];
    int n = 0;
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != FRICTIONLESS || !isfinite(r->rate[0])) continue;
        if (r->orifice < first_orifice) continue;
        d[n] = ORIFICE_CM[r->orifice];
        q[n++] = r->rate[0];
    }
    return beverloo_fit(d, q, n, BUTTON_DIAMETER);
}

/* A00 averages C over the orifices and takes the scatter between them (Tables 4.4 to 4.6). */
static interval mean_c(const hopper_summary *m) {
    double c[ORIFICES];
    int n = 0;
    for (int d = 0; d < ORIFICES; d++)
        if (m->mean[FRICTIONLESS][d].c.n > 0) c[n++] = m->mean[FRICTIONLESS][d].c.mean;
    return mean_interval(c, n);
}

/* Rates of one replicate after another, orifice by orifice; those of a replicate share its bed. */
typedef struct rate_table {
    double q[REPLICATES_MAX][ORIFICES];
    bool orifice[ORIFICES];
    int replicates;
} rate_table;

static rate_table rates_of(const hopper_study *s) {
    rate_table t = {.replicates = 0};
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != FRICTIONLESS) continue;
        t.q[r->replicate][r->orifice] = pick_q(r);
        t.orifice[r->orifice] = true;
        if (r->replicate >= t.replicates) t.replicates = r->replicate + 1;
    }
    return t;
}

/* Mean over the orifices of |mean rate of these replicates - experiment|, in percent. */
static double error_of(const rate_table *t, const int *which, const hopper_published *p) {
    double sum = 0;
    int n = 0;
    for (int d = 0; d < ORIFICES; d++) {
        if (!t->orifice[d]) continue;
        double q = 0;
        for (int k = 0; k < t->replicates; k++) q += t->q[which[k]][d] / t->replicates;
        sum += 100 * fabs(q / p->q_experiment[d] - 1);
        n++;
    }
    return n ? sum / n : NAN;
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* The interval is a bootstrap over whole replicates, because their orifices share a bed. */
static interval mean_error(const hopper_study *s, const hopper_published *p) {
    enum { DRAWS = 4000 };
    static double draws[DRAWS];
    rate_table t = rates_of(s);
    int which[REPLICATES_MAX];
    for (int k = 0; k < t.replicates; k++) which[k] = k;
    interval e = {error_of(&t, which, p), NAN, NAN, t.replicates};
    if (t.replicates < 2) return e;
    for (int i = 0; i < DRAWS; i++) {
        for (int k = 0; k < t.replicates; k++)
            which[k] = (int)(t.replicates * clast_random(1, 1, (uint64_t)(i * REPLICATES_MAX + k)));
        draws[i] = error_of(&t, which, p);
    }
    qsort(draws, DRAWS, sizeof *draws, ascending);
    e.half = 0.5 * (draws[(int)(0.975 * DRAWS)] - draws[(int)(0.025 * DRAWS)]);
    return e;
}

/* The profile of all samples, for the fit that is drawn; means, deviations and B per replicate, for
 * their intervals: buttons of one run are no replicates. */
static hopper_profile profile_at(const hopper_study *s, int orifice) {
    int room = 0, n = 0, runs = 0;
    for (int i = 0; i < s->flow_count; i++) room += s->runs[i].velocity_count;
    double *x = calloc((size_t)room + 1, sizeof *x), *v = calloc((size_t)room + 1, sizeof *v);
    double mean[REPLICATES_MAX], sd[REPLICATES_MAX], b[REPLICATES_MAX];
    if (!x || !v) abort();
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        bool ours = r->ran && r->fill == FRICTIONLESS && r->orifice == orifice;
        if (!ours || r->velocity_count < 5) continue;
        interval one = mean_interval(r->velocity, r->velocity_count);
        double v0 = centre_velocity(r->velocity_x, r->velocity, r->velocity_count, BUTTON_DIAMETER);
        mean[runs] = one.mean, sd[runs] = one.sd;
        b[runs++] =
            kinematic_fit(r->velocity_x, r->velocity, r->velocity_count, BAND_HEIGHT_CM, v0).b;
        for (int k = 0; k < r->velocity_count; k++)
            x[n] = r->velocity_x[k], v[n++] = r->velocity[k];
    }
    hopper_profile p = {.mean = mean_interval(mean, runs), .sd = mean_interval(sd, runs),
                        .b_cm = mean_interval(b, runs)};
    p.v0 = centre_velocity(x, v, n, BUTTON_DIAMETER);
    p.pooled_b_cm = kinematic_fit(x, v, n, BAND_HEIGHT_CM, p.v0).b;
    p.free = kinematic_fit_free(x, v, n, BAND_HEIGHT_CM, p.v0);
    free(x);
    free(v);
    return p;
}

hopper_summary hopper_summarise(const hopper_study *s, const hopper_published *p) {
    hopper_summary m = {.worst_residual = 0};
    for (int fill = 0; fill < FILLS; fill++) {
        for (int d = 0; d < ORIFICES; d++) m.mean[fill][d] = mean_at(s, fill, d);
        m.rest[fill] = mean_of(s, fill, -1, pick_rest);
        m.rest_top[fill] = mean_of(s, fill, -1, pick_rest_top);
    }
    m.fit = fit_from(s, 0);
    m.fit_wide = fit_from(s, 2);
    m.c_all = mean_c(&m);
    m.error_percent = mean_error(s, p);
    for (int d = 0; d < ORIFICES; d++) m.profile[d] = profile_at(s, d);
    for (int i = 0; i < s->flow_count; i++)
        if (s->runs[i].ran) m.worst_residual = fmax(m.worst_residual, s->runs[i].residual);
    return m;
}

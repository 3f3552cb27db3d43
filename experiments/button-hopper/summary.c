/* summary.c - replicates into the numbers that the source prints. */
#include <math.h>
#include <stdlib.h>

#include "experiments/button-hopper/hopper.h"

typedef double pick(const hopper_run *r);

static double pick_q(const hopper_run *r) {
    return r->rate[0];
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

/* Mean over the orifices of |mean rate - experiment| in percent. Its half width: the intervals of
 * the means carried through, as if independent. */
static interval mean_error(const hopper_summary *m, const hopper_published *p) {
    double sum = 0, variance = 0;
    int n = 0;
    for (int d = 0; d < ORIFICES; d++) {
        interval q = m->mean[FRICTIONLESS][d].q;
        if (q.n == 0) continue;
        sum += 100 * fabs(q.mean / p->q_experiment[d] - 1);
        double half = 100 * q.half / p->q_experiment[d];
        variance += half * half;
        n++;
    }
    return (interval){n ? sum / n : NAN, NAN, n ? sqrt(variance) / n : NAN, n};
}

static hopper_profile profile_at(const hopper_study *s, int orifice) {
    int room = 0, n = 0;
    for (int i = 0; i < s->flow_count; i++) room += s->runs[i].velocity_count;
    double *x = calloc((size_t)room + 1, sizeof *x), *v = calloc((size_t)room + 1, sizeof *v);
    if (!x || !v) abort();
    hopper_profile p = {.replicates = 0};
    for (int i = 0; i < s->flow_count; i++) {
        const hopper_run *r = &s->runs[i];
        if (!r->ran || r->fill != FRICTIONLESS || r->orifice != orifice) continue;
        for (int k = 0; k < r->velocity_count; k++)
            x[n] = r->velocity_x[k], v[n++] = r->velocity[k];
        p.replicates += r->velocity_count > 0;
    }
    p.v = mean_interval(v, n);
    p.v0 = centre_velocity(x, v, n, BUTTON_DIAMETER);
    p.b_cm = kinematic_fit(x, v, n, BAND_HEIGHT_CM, p.v0).b;
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
    m.error_percent = mean_error(&m, p);
    for (int d = 0; d < ORIFICES; d++) m.profile[d] = profile_at(s, d);
    for (int i = 0; i < s->flow_count; i++)
        if (s->runs[i].ran) m.worst_residual = fmax(m.worst_residual, s->runs[i].residual);
    return m;
}

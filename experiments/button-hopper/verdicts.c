/* verdicts.c - every number that the source prints, ours beside it. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/button-hopper/hopper.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

static published_table *read_table(void) {
    char why[PUBLISHED_ERROR_MAX];
    published_table *t = published_read(SCENES "/published.csv", why);
    if (!t) {
        fprintf(stderr, "%s\n", why);
        exit(4);
    }
    return t;
}

/* "rate at 6.5 cm" and the like. */
static const published *need_at(const published_table *t, const char *what, int orifice) {
    char name[80];
    snprintf(name, sizeof name, "%s at %g cm", what, ORIFICE_CM[orifice]);
    return published_need(t, name);
}

hopper_published hopper_read_published(void) {
    published_table *t = read_table();
    hopper_published p;
    for (int d = 0; d < ORIFICES; d++) {
        const published *q = need_at(t, "rate", d), *rho = need_at(t, "bulk density in flow", d),
                        *c = need_at(t, "C", d);
        p.q_experiment[d] = q->experiment, p.q_thesis[d] = q->thesis;
        p.rho_experiment[d] = rho->experiment, p.rho_thesis[d] = rho->thesis;
        p.c_experiment[d] = c->experiment, p.c_thesis[d] = c->thesis;
    }
    published_free(t);
    return p;
}

static interval nothing(void) {
    return mean_interval(NULL, 0);
}

static void add_orifices(verdict_table *v, const published_table *t, const hopper_summary *m,
                         const hopper_study *s) {
    for (int d = 0; d < ORIFICES; d++)
        verdict_published(v, need_at(t, "rate", d), m->mean[FRICTIONLESS][d].q,
                          s->size->orifice[d]);
    for (int d = 0; d < ORIFICES; d++)
        verdict_published(v, need_at(t, "bulk density in flow", d), m->mean[FRICTIONLESS][d].rho,
                          s->size->orifice[d]);
    for (int d = 0; d < ORIFICES; d++)
        verdict_published(v, need_at(t, "C", d), m->mean[FRICTIONLESS][d].c, s->size->orifice[d]);
}

static interval in_diameters(interval b) {
    double k = 1 / BUTTON_DIAMETER;
    return (interval){k * b.mean, k * b.sd, k * b.half, b.n};
}

static void add_profiles(verdict_table *v, const published_table *t, const hopper_summary *m) {
    static const int MEASURED[] = {2, 4};
    for (int i = 0; i < 2; i++) {
        const hopper_profile *p = &m->profile[MEASURED[i]];
        bool have = p->mean.n > 0;
        verdict_published(v, need_at(t, "velocity mean", MEASURED[i]), p->mean, have);
        verdict_published(v, need_at(t, "velocity sd", MEASURED[i]), p->sd, have);
        verdict_published(v, need_at(t, "B", MEASURED[i]), in_diameters(p->b_cm), have);
    }
}

/* What the source does not count, said all the same. */
static void print_blocked(const hopper_summary *m) {
    for (int fill = 0; fill < FILLS; fill++)
        for (int d = 0; d < ORIFICES; d++) {
            const hopper_mean *h = &m->mean[fill][d];
            if (h->runs == 0) continue;
            printf(
                "%s, %g cm: %d runs, %d blocked, %d without a rate, %d with an arch, longest pause"
                " %.0f ms; rate at R2 0.98 / 0.99 / 0.995: %.1f / %.1f / %.1f g/s\n",
                FILL_NAME[fill], ORIFICE_CM[d], h->runs, h->blocked, h->runs - h->q.n, h->with_arch,
                1000 * h->longest_pause, h->q_r2[1].mean, h->q_r2[0].mean, h->q_r2[2].mean);
        }
}

/* A00 Table 4.6: C over the orifices, ours against the experiment and against the thesis. */
static void print_c_test(const hopper_summary *m, const hopper_published *p) {
    const double *against[] = {p->c_experiment, p->c_thesis};
    static const char *const NAME[] = {"experiment", "thesis"};
    for (int i = 0; i < 2; i++) {
        t_test t = t_test_pooled(m->c_all, mean_interval(against[i], ORIFICES));
        printf("C over the orifices, t-test against the %s: t = %.2f, P = %.2f\n", NAME[i], t.t,
               t.p);
    }
}

int hopper_verdicts(const hopper_study *s, const hopper_summary *m, const hopper_published *p,
                    const char *csv) {
    published_table *t = read_table();
    verdict_table *v = verdict_new("button-hopper");
    bool frictional = s->size->replicates[FRICTIONAL] > 0;
    verdict_published(v, published_need(t, "mean |error| of the rates"), m->error_percent, true);
    verdict_published(v, published_need(t, "solid fraction at rest frictionless fill"),
                      m->rest[FRICTIONLESS], true);
    verdict_published(v, published_need(t, "solid fraction at rest frictional fill"),
                      m->rest[FRICTIONAL], frictional);
    verdict_published(v, published_need(t, "solid fraction at rest placed one by one"), nothing(),
                      false);
    verdict_published(v, published_need(t, "C mean of the orifices"), m->c_all, true);
    verdict_published(v, published_need(t, "C equal to the experiment"), m->c_all, m->c_all.n > 1);
    verdict_published(v, published_need(t, "kd"),
                      (interval){m->fit.kd, NAN, m->fit.kd_half, m->fit.fit.n}, true);
    verdict_published(v, published_need(t, "k"),
                      (interval){m->fit.k, NAN, m->fit.k_half, m->fit.fit.n}, true);
    verdict_published(v, published_need(t, "k from D >= 7.5 cm"), interval_exact(m->fit_wide.k),
                      true);
    add_orifices(v, t, m, s);
    add_profiles(v, t, m);
    print_blocked(m);
    print_c_test(m, p);
    printf(
        "solid fraction at rest with the top of each section as its height: %.3f frictionless, %.3f"
        " frictional\n",
        m->rest_top[FRICTIONLESS].mean, m->rest_top[FRICTIONAL].mean);
    printf("largest energy residual of a discharge: %.2g of the energy put in\n",
           m->worst_residual);
    int code = verdict_finish(v, csv, stdout);
    verdict_free(v);
    published_free(t);
    return code;
}

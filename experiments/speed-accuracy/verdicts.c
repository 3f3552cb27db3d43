/* verdicts.c - what theory and S12 3.10 say of the chart, ours beside it. Force evaluations are
 * counted, so nothing here depends on a clock. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include <gsl/gsl_cdf.h>

#include "experiments/speed-accuracy/chart.h"
#include "experiments/speed-accuracy/picks.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

enum { PAIRS_LEAST = 8, STATES_LEAST = 4 }; /* fewer say nothing of a difference */

static const char *const COLLISIONS[4] = {"linear e=1", "linear e=0.5", "Hertz e=1", "Hertz e=0.5"};

typedef struct court {
    const chart *chart;
    published_table *published;
    verdict_table *table;
} court;

static void say(const court *c, const char *quantity, double value) {
    verdict_named(c->table, c->published, quantity, value);
}

/* ---- orders of the fronts -------------------------------------------------------------------- */

static void judge_orders(const court *c) {
    char name[100];
    for (int i = 0; i < 4; i++) {
        const chart_point *panel = chart_panel(c->chart, PART_COLLISION, COLLISIONS[i], "duration");
        snprintf(name, sizeof name, "%s: order of the front of the duration", COLLISIONS[i]);
        say(c, name, chart_front_order(c->chart, panel, 30, 600));
    }
    const chart_point *phase = chart_panel(c->chart, PART_SANDWICH, "e=1", "phase");
    say(c, "sandwich: order of the front of the phase",
        chart_front_order(c->chart, phase, 10, 100));
}

/* Two schemes with the same positions have the same durations. */
static void judge_twins(const court *c) {
    double worst = 0;
    for (int i = 0; i < c->chart->count; i++) {
        const chart_point *p = &c->chart->points[i];
        if (strcmp(p->quantity, "duration") != 0 || strcmp(p->family, "leapfrog") != 0) continue;
        for (int k = 0; k < c->chart->count; k++) {
            const chart_point *q = &c->chart->points[k];
            bool twin = chart_same_panel(p, q) && q->level == p->level &&
                        !strcmp(q->family, "velocity-verlet");
            if (twin && isfinite(p->error)) worst = fmax(worst, fabs(q->error - p->error));
        }
    }
    say(c, "leapfrog and velocity Verlet: errors of the duration apart", worst);
}

/* ---- S12 3.10: explicit against implicit ----------------------------------------------------- */

/* Largest step that keeps 1 %; 0 without one. */
static double largest_step(const chart *c, const chart_point *panel, chart_filter *filter) {
    double step = 0;
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        if (chart_same_panel(p, panel) && filter(p) && p->bound <= TOLERANCE[1])
            step = fmax(step, p->step);
    }
    return step;
}

static void judge_pair(const court *c, const char *part, const char *scene, const char *quantity,
                       const char *words) {
    const chart_point *panel = chart_panel(c->chart, part, scene, quantity);
    const chart_point *e =
        chart_pick(c->chart, panel, TOLERANCE[1], CHART_EVALUATIONS, point_is_explicit);
    const chart_point *i =
        chart_pick(c->chart, panel, TOLERANCE[1], CHART_EVALUATIONS, point_is_implicit);
    char name[120];
    snprintf(name, sizeof name, "%s: largest step at 1 %%, implicit over explicit", words);
    say(c, name,
        largest_step(c->chart, panel, point_is_implicit) /
            largest_step(c->chart, panel, point_is_explicit));
    snprintf(name, sizeof name, "%s: force evaluations at 1 %%, implicit over explicit", words);
    say(c, name, e && i ? i->evaluations / e->evaluations : (double)NAN);
}

/* At 10 %, which the few initial states can show; nothing where that study has not been run, or at
 * quick size. */
static void judge_discharge(const court *c) {
    static const char NAME[] =
        "hopper discharge, residence time: force evaluations at 10 %, implicit over explicit";
    const chart_point *panel = chart_panel(c->chart, PART_DISCHARGE, "S12 3.9.3", "residence");
    const chart_point *e = NULL, *i = NULL;
    if (panel) {
        e = chart_pick(c->chart, panel, TOLERANCE[0], CHART_EVALUATIONS, point_is_explicit);
        i = chart_pick(c->chart, panel, TOLERANCE[0], CHART_EVALUATIONS, point_is_implicit);
    }
    interval ratio = interval_exact(e && i ? i->evaluations / e->evaluations : (double)NAN);
    verdict_published(c->table, published_need(c->published, NAME), ratio,
                      panel && panel->samples >= STATES_LEAST);
}

static void judge_schemes(const court *c) {
    for (int i = 0; i < 4; i++)
        judge_pair(c, PART_COLLISION, COLLISIONS[i], "largest", COLLISIONS[i]);
    judge_pair(c, PART_SANDWICH, "e=1", "phase", "sandwich, phase");
    judge_pair(c, PART_SANDWICH, "e=1", "largest", "sandwich, phase and energy");
}

/* ---- the button hopper ----------------------------------------------------------------------- */

static const chart_point *button(const chart *c, const char *setting, const char *quantity) {
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        if (!strcmp(p->part, PART_BUTTONS) && !strcmp(p->setting, setting) &&
            !strcmp(p->quantity, quantity))
            return p;
    }
    return NULL;
}

/* The paired difference as an interval, for the test of equivalence. */
static interval difference_of(const chart_point *p) {
    interval x = {NAN, NAN, NAN, 0};
    if (!p || !isfinite(p->difference) || p->samples < 2) return x;
    x.mean = p->difference, x.half = p->high - p->error, x.n = p->samples;
    x.sd = x.half * sqrt(x.n) / gsl_cdf_tdist_Pinv(0.975, x.n - 1);
    return x;
}

static void judge_buttons(const court *c) {
    static const char *const SETTING[3] = {"mixed precision", "step / 2", "step / 4"};
    static const char *const QUANTITY[2] = {"rate", "density"};
    for (int i = 0; i < 3; i++)
        for (int q = 0; q < 2; q++) {
            char name[120];
            snprintf(name, sizeof name, "button hopper: %s, %s", QUANTITY[q], SETTING[i]);
            const published *row = published_need(c->published, name);
            interval x = difference_of(button(c->chart, SETTING[i], QUANTITY[q]));
            verdict_published(c->table, row, x, x.n >= PAIRS_LEAST);
        }
}

/* ---- all ------------------------------------------------------------------------------------- */

int chart_verdicts(const chart *points, const char *csv) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {points, published_read(SCENES "/published.csv", why), verdict_new("speed-accuracy")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_orders(&c);
    judge_twins(&c);
    judge_schemes(&c);
    judge_discharge(&c);
    judge_buttons(&c);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}

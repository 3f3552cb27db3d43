/* verdicts.c - what theory and the source say, ours beside it. */
#include <math.h>
#include <stdlib.h>

#include "experiments/hopper-discharge/discharge.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    const discharge_study *study;
    published_table *published;
    verdict_table *table;
} court;

static void say(const court *c, const char *quantity, interval ours) {
    verdict_measured(c->table, c->published, quantity, ours);
}

static void say_number(const court *c, const char *quantity, double ours) {
    verdict_named(c->table, c->published, quantity, ours);
}

static interval times(interval x, double by) {
    x.mean *= by, x.sd *= by, x.half *= by;
    return x;
}

/* ---- steps that fail ------------------------------------------------------------------------- */

static void judge_failures(const court *c) {
    const discharge_study *s = c->study;
    say_number(c, "shortest contact", shortest_contact());
    say_number(c, "steps in the shortest contact at 1.0 ms", shortest_contact() / 1.0e-3);
    say_number(c, "steps in the shortest contact at 1.2 ms", shortest_contact() / 1.2e-3);
    for (int method = EXPLICIT; method <= IMPLICIT; method++) {
        const char *who = method == EXPLICIT ? "explicit" : "implicit";
        char row[100];
        snprintf(row, sizeof row, "%s: step at which spheres are through walls", who);
        say(c, row, times(limit_at(s, method, 0, BY_WALL), 1e3));
        snprintf(row, sizeof row, "%s: step at which energy is made", who);
        say(c, row, times(limit_at(s, method, 0, BY_ENERGY), 1e3));
        snprintf(row, sizeof row, "%s: step at which energy is made, over the network's", who);
        say(c, row, predicted_ratio(s, method, BY_ENERGY));
        snprintf(row, sizeof row, "%s: step at which the run stops, over the network's", who);
        say(c, row, predicted_ratio(s, method, BY_STOP));
    }
    say(c, "through walls, implicit over explicit", limit_ratio(s, IMPLICIT, EXPLICIT, 0, BY_WALL));
    say(c, "energy made, implicit over explicit", limit_ratio(s, IMPLICIT, EXPLICIT, 0, BY_ENERGY));
    say(c, "stops, implicit over explicit", limit_ratio(s, IMPLICIT, EXPLICIT, 0, BY_STOP));
}

/* ---- residence times ------------------------------------------------------------------------- */

static void judge_residences(const court *c) {
    const discharge_study *s = c->study;
    const double first = STEP[s->size->first_step], last = STEP[STEPS - 1];
    char row[100];
    double apart = 0, drift = 0;
    for (int i = s->size->first_step; i < STEPS; i++) {
        interval ratio = residence_ratio(s, IMPLICIT, EXPLICIT, 0, STEP[i]);
        snprintf(row, sizeof row, "%g ms: residence time, implicit over explicit", 1e3 * STEP[i]);
        say(c, row, ratio);
        if (shortest_contact() / STEP[i] < 5) continue;
        apart = fmax(apart, fabs(ratio.mean - 1));
        drift = fmax(drift, fabs(residence_drift(s, EXPLICIT, 0, first, STEP[i]).mean));
    }
    for (int method = EXPLICIT; method <= IMPLICIT; method++) {
        interval d = residence_drift(s, method, 0, first, last);
        say_number(c,
                   method == EXPLICIT ? "explicit: drift at 0.8 ms over its interval"
                                      : "implicit: drift at 0.8 ms over its interval",
                   fabs(d.mean) / d.half);
    }
    say_number(c, "5 steps per contact and more: residence times apart", apart);
    say_number(c, "5 steps per contact and more: drift of the explicit scheme", drift);
}

/* ---- prices ---------------------------------------------------------------------------------- */

static const price *price_at(const discharge_study *s, int kind, double step) {
    for (int i = 0; i < s->prices; i++)
        if (s->price[i].kind == kind && s->price[i].step == step) return &s->price[i];
    return NULL;
}

/* Both at the largest step of the five; the implicit scheme's price at the 1.22 times larger step
 * that it may take is lower by no more than that. */
static void judge_prices(const court *c) {
    const discharge_study *s = c->study;
    double evaluations = INFINITY;
    for (int i = s->size->first_step; i < STEPS; i++)
        evaluations = fmin(evaluations, price_at(s, IMPLICIT, STEP[i])->evaluations /
                                            price_at(s, EXPLICIT, STEP[i])->evaluations);
    say_number(c, "force evaluations, implicit over explicit at the same step; least", evaluations);
    double larger = limit_ratio(s, IMPLICIT, EXPLICIT, 0, BY_ENERGY).mean;
    double cpu = price_at(s, IMPLICIT, STEP[STEPS - 1])->cpu /
                 price_at(s, EXPLICIT, STEP[STEPS - 1])->cpu / larger;
    say_number(
        c, "processor time, implicit over explicit at 0.8 ms, over the ratio of their limits", cpu);
}

/* ---- what is printed beside ------------------------------------------------------------------ */

static void print_residence(const discharge_study *s, int method, double step) {
    char mean[40], drift[40], ratio[40];
    interval x[3] = {residence_at(s, method, 0, step),
                     times(residence_drift(s, method, 0, STEP[s->size->first_step], step), 100),
                     residence_ratio(s, method, EXPLICIT, 0, step)};
    if (x[0].n == 0) return;
    interval_text(&x[0], mean, sizeof mean);
    interval_text(&x[1], drift, sizeof drift);
    interval_text(&x[2], ratio, sizeof ratio);
    printf("%-16s %6g %6.2f %18s %18s %18s\n", method_name(method), 1e3 * step,
           shortest_contact() / step, mean, drift, ratio);
}

static void print_residences(const discharge_study *s) {
    printf("%-16s %6s %6s %18s %18s %18s\n", "method", "ms", "steps", "residence, s", "drift, %",
           "over explicit");
    for (int method = 0; method < METHODS; method++) {
        for (int i = s->size->first_step; i < STEPS; i++) print_residence(s, method, STEP[i]);
        for (int i = 0; i < s->size->scans; i++) print_residence(s, method, SCAN[i]);
    }
}

static void print_limits(const discharge_study *s) {
    printf("%-16s %5s %10s %9s %9s %9s\n", "method", "state", "criterion", "holds, ms", "fails",
           "predicted");
    for (int i = 0; i < s->limits; i++) {
        const failure_step *l = &s->limit[i];
        if (l->variant > 0) continue;
        printf("%-16s %5d %10s %9.4g %9.4g %9.4g\n", method_name(l->method), 1 + l->state,
               CRITERION_NAME[l->criterion], 1e3 * l->holds, 1e3 * l->fails,
               1e3 * predicted_limit(s, l->method, l->state));
    }
}

static void print_prices(const discharge_study *s) {
    printf("%-32s %6s %12s %12s %12s %12s\n", "per simulated second", "ms", "evaluations", "Newton",
           "linear", "cpu, s");
    for (int i = 0; i < s->prices; i++) {
        const price *p = &s->price[i];
        printf("%-32s %6g %12.0f %12.0f %12.0f %12.4g\n", PRICE_NAME[p->kind], 1e3 * p->step,
               p->evaluations, p->newton, p->linear, p->cpu);
    }
}

int discharge_verdicts(const discharge_study *s, const char *csv) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {s, published_read(SCENES "/published.csv", why), verdict_new("hopper-discharge")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    print_residences(s), print_limits(s), print_prices(s);
    judge_failures(&c);
    judge_residences(&c);
    judge_prices(&c);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}

/* summary.c - discharges of the same states, compared one by one. */
#include <math.h>

#include "experiments/hopper-discharge/discharge.h"
#include "experiments/theory/amplification.h"

typedef struct samples {
    double x[STATES_MAX];
    int n, lost; /* states without a number */
} samples;

static void add(samples *s, double x) {
    if (isfinite(x))
        s->x[s->n++] = x;
    else
        s->lost++;
}

/* No mean of those that are left: what did not fail or did not end would be judged by the rest. */
static interval mean_of(const samples *s) {
    return mean_interval(s->x, s->lost > 0 ? 0 : s->n);
}

/* ---- residence times ------------------------------------------------------------------------- */

static double residence_of(const discharge_study *s, int method, int variant, int state,
                           double step) {
    const flow *f = study_flow(s, method, variant, state, step);
    return f ? f->residence : NAN;
}

interval residence_at(const discharge_study *s, int method, int variant, double step) {
    samples all = {.n = 0};
    for (int i = 0; i < study_states(s, variant); i++)
        add(&all, residence_of(s, method, variant, i, step));
    return mean_of(&all);
}

interval residence_ratio(const discharge_study *s, int method, int other, int variant,
                         double step) {
    samples all = {.n = 0};
    for (int i = 0; i < study_states(s, variant); i++)
        add(&all,
            residence_of(s, method, variant, i, step) / residence_of(s, other, variant, i, step));
    return mean_of(&all);
}

interval residence_drift(const discharge_study *s, int method, int variant, double from,
                         double step) {
    samples all = {.n = 0};
    for (int i = 0; i < study_states(s, variant); i++)
        add(&all,
            residence_of(s, method, variant, i, step) / residence_of(s, method, variant, i, from) -
                1);
    return mean_of(&all);
}

/* ---- steps that fail ------------------------------------------------------------------------- */

static double limit_of(const discharge_study *s, int method, int variant, int state,
                       int criterion) {
    for (int i = 0; i < s->limits; i++) {
        const failure_step *l = &s->limit[i];
        if (l->method == method && l->variant == variant && l->state == state &&
            l->criterion == criterion)
            return 0.5 * (l->holds + l->fails);
    }
    return NAN;
}

interval limit_at(const discharge_study *s, int method, int variant, int criterion) {
    samples all = {.n = 0};
    for (int i = 0; i < study_states(s, variant); i++)
        add(&all, limit_of(s, method, variant, i, criterion));
    return mean_of(&all);
}

interval limit_ratio(const discharge_study *s, int method, int other, int variant, int criterion) {
    samples all = {.n = 0};
    for (int i = 0; i < study_states(s, variant); i++)
        add(&all,
            limit_of(s, method, variant, i, criterion) / limit_of(s, other, variant, i, criterion));
    return mean_of(&all);
}

double predicted_at(int method, double frequency) {
    return scheme_limit(METHOD_SCHEME[method], 0) / frequency;
}

double predicted_limit(const discharge_study *s, int method, int state) {
    return predicted_at(method, s->history[state].moment[0].network.largest);
}

interval predicted_ratio(const discharge_study *s, int method, int criterion) {
    samples all = {.n = 0};
    for (int i = 0; i < s->size->states; i++)
        add(&all, limit_of(s, method, 0, i, criterion) / predicted_limit(s, method, i));
    return mean_of(&all);
}

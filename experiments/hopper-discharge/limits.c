/* limits.c - the smallest step at which a discharge fails. The steps of the runs are gone through
 * upwards, as the source did, and the interval before the first failure is halved.
 *
 * A wall without thickness stops a sphere of radius R that meets it with less than k R^2 / 2: a few
 * spheres pass at any step, however small. Failure is when more pass than at the smallest step. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"

static bool has_failed(const discharge_study *s, const flow *f, const failure_step *l) {
    if (f->failed != FAILED_NOT) return true;
    if (l->criterion == BY_WALL) return f->through > s->always_through[l->variant];
    return l->criterion == BY_ENERGY && !isnan(f->heated);
}

static double smallest_step(const discharge_study *s, int variant) {
    double least = INFINITY;
    for (int i = 0; i < s->runs; i++)
        if (s->run[i].variant == variant) least = fmin(least, s->run[i].step);
    return least;
}

static void find_always_through(discharge_study *s, int variant) {
    double least = smallest_step(s, variant);
    int most = 0;
    for (int i = 0; i < s->runs; i++) {
        const discharge_run *r = &s->run[i];
        if (r->variant == variant && r->step == least && r->flow.through > most)
            most = r->flow.through;
    }
    s->always_through[variant] = most;
}

static bool is_of(const discharge_run *r, const failure_step *l) {
    return r->method == l->method && r->variant == l->variant && r->state == l->state;
}

/* holds: the largest step below the first that fails; 0 where the smallest does. */
static void bracket(const discharge_study *s, failure_step *l) {
    l->fails = INFINITY, l->holds = 0;
    for (int i = 0; i < s->runs; i++) {
        const discharge_run *r = &s->run[i];
        if (is_of(r, l) && has_failed(s, &r->flow, l)) l->fails = fmin(l->fails, r->step);
    }
    for (int i = 0; i < s->runs; i++) {
        const discharge_run *r = &s->run[i];
        if (is_of(r, l) && r->step < l->fails) l->holds = fmax(l->holds, r->step);
    }
}

static void name_limit(const void *context, int which, char name[NAME_MAX_TEXT]) {
    const discharge_study *s = context;
    const failure_step *l = &s->limit[which];
    snprintf(name, NAME_MAX_TEXT, "limit %s, %d, %d, %s, %g to %g, %d times, %d rows",
             method_name(l->method), l->variant, l->state, CRITERION_NAME[l->criterion], l->holds,
             l->fails, s->size->halvings, s->size->rows);
}

static void halve(const void *context, int which, void *result) {
    const discharge_study *s = context;
    failure_step l = s->limit[which];
    bool inside = l.holds > 0 && isfinite(l.fails);
    int halvings = l.variant == 0 ? s->size->halvings : 0;
    for (int i = 0; inside && i < halvings; i++) {
        flow f;
        double middle = 0.5 * (l.holds + l.fails);
        flow_plan p = {.hopper = &s->variant[l.variant].hopper,
                       .bed = study_bed(s, l.variant, l.state),
                       .world = {.scheme = METHOD_SCHEME[l.method], .step = middle},
                       .until = hopper_latest(&s->variant[l.variant].hopper)};
        flow_run(&p, &f);
        *(has_failed(s, &f, &l) ? &l.fails : &l.holds) = middle;
    }
    memcpy(result, &l, sizeof l);
}

void limits_find(discharge_study *s) {
    for (int v = 0; v < s->variants; v++) find_always_through(s, v);
    for (int i = 0; i < s->limits; i++) bracket(s, &s->limit[i]);
    kept_results(&(kept_task){"limits", sizeof *s->limit, 0, s, name_limit, halve}, s->limits,
                 s->limit);
}

/* price.c - what a simulated second costs while the hopper is nearly full: one run after the other
 * on an otherwise idle processor, unlike the discharges, which run side by side. */
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/hopper-discharge/discharge.h"

#define PRICE_TIME 0.2 /* s, simulated */

const char *const PRICE_NAME[PRICE_KINDS] = {[LEAPFROG] = "leapfrog",
                                             [EXPLICIT] = "position-verlet",
                                             [IMPLICIT] = "numerov-central",
                                             [METHODS] = "numerov-central, tolerance 1e-6",
                                             [METHODS + 1] = "numerov-central, Gauss-Seidel"};

static world_plan plan_of(const price *p) {
    world_plan plan = {.step = p->step};
    plan.scheme = METHOD_SCHEME[p->kind < METHODS ? p->kind : IMPLICIT];
    plan.tolerance = p->kind == METHODS ? 1e-6 : 0;
    plan.relaxes = p->kind == METHODS + 1;
    return plan;
}

static price price_of(const discharge_study *s, int which) {
    int steps = STEPS - s->size->first_step;
    return (price){.kind = which / steps, .step = STEP[s->size->first_step + which % steps]};
}

static void name_price(const void *context, int which, char name[NAME_MAX_TEXT]) {
    const discharge_study *s = context;
    price p = price_of(s, which);
    snprintf(name, NAME_MAX_TEXT, "price %s, step %g, %d rows", PRICE_NAME[p.kind], p.step,
             s->size->rows);
}

static void measure(const void *context, int which, void *result) {
    const discharge_study *s = context;
    price p = price_of(s, which);
    flow f;
    flow_plan plan = {.hopper = &s->variant[0].hopper,
                      .bed = study_bed(s, 0, 0),
                      .world = plan_of(&p),
                      .until = PRICE_TIME};
    flow_run(&plan, &f);
    p.evaluations = f.evaluations / f.span, p.newton = f.newton / f.span;
    p.linear = f.linear / f.span, p.cpu = f.cpu / f.span;
    *(price *)result = p;
}

void prices_find(discharge_study *s) {
    s->prices = PRICE_KINDS * (STEPS - s->size->first_step);
    s->price = calloc((size_t)s->prices, sizeof *s->price);
    CLAST_ASSERT(s->price);
    kept_results(&(kept_task){"prices", sizeof *s->price, 1, s, name_price, measure}, s->prices,
                 s->price);
}

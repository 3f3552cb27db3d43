/* advice.c - the head of the page: what to pick and what it costs, one sentence for each choice.
 * Every number is computed from the points. */
#include <math.h>
#include <string.h>

#include "experiments/speed-accuracy/picks.h"

/* What is said, for an error that most readers can accept. */
static const double FINE = 0.01, COARSE = 0.1;

typedef struct range {
    double least, most;
} range;

static const range NOTHING = {INFINITY, -INFINITY};

static void widen(range *r, double value) {
    r->least = fmin(r->least, value), r->most = fmax(r->most, value);
}

static void say_range(FILE *f, range r) {
    fprintf(f, "%.2g to %.2g", r.least, r.most);
}

static const chart_point *cheapest(const chart *c, const char *part, const char *scene,
                                   const char *quantity, double accepted, chart_filter *filter) {
    const chart_point *panel = chart_panel(c, part, scene, quantity);
    return panel ? chart_pick(c, panel, accepted, CHART_COST, filter) : NULL;
}

/* ---- collisions ------------------------------------------------------------------------------ */

enum { LAWS = 2 };
static const char *const ELASTIC[LAWS] = {"linear e=1", "Hertz e=1"};
static const char *const DAMPED[LAWS] = {"linear e=0.5", "Hertz e=0.5"};

/* Steps per contact without a dashpot and with one, and how much dearer the latter is. */
static void say_steps(FILE *f, const chart *c) {
    range elastic = NOTHING, damped = NOTHING, dearer = NOTHING;
    for (int i = 0; i < LAWS; i++) {
        const chart_point *e = cheapest(c, PART_COLLISION, ELASTIC[i], "largest", FINE, NULL);
        const chart_point *d = cheapest(c, PART_COLLISION, DAMPED[i], "largest", FINE, NULL);
        if (!e || !d) {
            fprintf(f, "not every collision is within %g %% with what was tried", 100 * FINE);
            return;
        }
        widen(&elastic, e->level), widen(&damped, d->level);
        widen(&dearer, d->cost.median / e->cost.median);
    }
    fputs("where nothing is lost, ", f);
    say_range(f, elastic);
    fputs(" steps per contact; with a restitution of 0.5, ", f);
    say_range(f, damped);
    fputs(" steps, which cost ", f);
    say_range(f, dearer);
    fputs(" times as much", f);
}

/* ---- explicit or implicit -------------------------------------------------------------------- */

/* 0 where one of the two has no setting. */
static double implicit_over_explicit(const chart *c, const char *part, const char *scene,
                                     const char *quantity, double accepted) {
    const chart_point *e = cheapest(c, part, scene, quantity, accepted, point_is_explicit);
    const chart_point *i = cheapest(c, part, scene, quantity, accepted, point_is_implicit);
    return e && i ? i->cost.median / e->cost.median : 0;
}

static void say_implicit(FILE *f, const chart *c) {
    range ratio = NOTHING;
    for (int i = 0; i < 2 * LAWS; i++) {
        const char *scene = i < LAWS ? ELASTIC[i] : DAMPED[i - LAWS];
        double one = implicit_over_explicit(c, PART_COLLISION, scene, "largest", FINE);
        if (one > 0) widen(&ratio, one);
    }
    double swing = implicit_over_explicit(c, PART_SANDWICH, "e=1", "largest", FINE);
    double flow = implicit_over_explicit(c, PART_DISCHARGE, "S12 3.9.3", "residence", COARSE);
    say_range(f, ratio);
    fprintf(f, " times the processor time for a collision within %g %%", 100 * FINE);
    if (swing > 0) fprintf(f, ", %.2g times for the ball between two walls", swing);
    if (flow > 0) fprintf(f, ", %.2g times for the hopper within %g %%", flow, 100 * COARSE);
}

/* ---- a flow ---------------------------------------------------------------------------------- */

static const chart_point *twin(const chart *c, const chart_point *p, const char *quantity) {
    for (int i = 0; i < c->count; i++) {
        const chart_point *q = &c->points[i];
        bool same = !strcmp(q->part, p->part) && !strcmp(q->setting, p->setting);
        if (same && !strcmp(q->quantity, quantity)) return q;
    }
    return NULL;
}

/* The cheapest setting of the buttons that keeps rate and density; the reference has both. */
static const chart_point *keeps_both(const chart *c, double accepted) {
    const chart_point *best = NULL;
    for (int i = 0; i < c->count; i++) {
        const chart_point *p = &c->points[i];
        if (strcmp(p->part, PART_BUTTONS) != 0 || strcmp(p->quantity, "rate") != 0) continue;
        const chart_point *d = twin(c, p, "density");
        if (p->message[0] || !(p->bound <= accepted) || !d || !(d->bound <= accepted)) continue;
        if (!best || p->cost.median < best->cost.median) best = p;
    }
    return best;
}

static void say_one_flow(FILE *f, const chart *c, double accepted, double whole) {
    const chart_point *p = keeps_both(c, accepted);
    fprintf(f, "within %g %%: ", 100 * accepted);
    if (!p || p->reference)
        fputs("nothing cheaper is shown to keep it", f);
    else
        fprintf(f, "%s, %.0f %% of the processor time (rate at most %.2g %% off, density %.2g %%)",
                p->setting, 100 * p->cost.median / whole, 100 * p->bound,
                100 * twin(c, p, "density")->bound);
}

static void say_flow(FILE *f, const chart *c) {
    const chart_point *reference = chart_panel(c, PART_BUTTONS, "10 cm", "rate");
    static const double ACCEPTED[3] = {0.1, 0.05, 0.02};
    for (int i = 0; i < 3 && reference; i++) {
        if (i > 0) fputs("; ", f);
        say_one_flow(f, c, ACCEPTED[i], reference->cost.median);
    }
}

void advice_write(FILE *f, const chart *c) {
    fputs("advice_steps=", f);
    say_steps(f, c);
    fputs("\nadvice_implicit=", f);
    say_implicit(f, c);
    fputs("\nadvice_flow=", f);
    say_flow(f, c);
    fputc('\n', f);
}

/* verdicts.c - what theory and the source say, ours beside it. */
#include <math.h>
#include <stdlib.h>

#include "experiments/sandwich/sandwich.h"
#include "experiments/study/published.h"
#include "experiments/study/verdict.h"

typedef struct court {
    published_table *published;
    verdict_table *table;
} court;

/* The pair that S12 compares throughout (3.9). */
static const clast_scheme EXPLICIT = CLAST_SCHEME_POSITION_VERLET,
                          IMPLICIT = CLAST_SCHEME_NUMEROV_CENTRAL;

static void say(const court *c, const char *quantity, double value) {
    verdict_named(c->table, c->published, quantity, value);
}

static const char *name_of(clast_scheme scheme) {
    return clast_scheme_info_of(scheme)->name;
}

/* ---- S12 3.9.1 ------------------------------------------------------------------------------- */

/* Of a run, without its points. */
static oscillation numbers_of(clast_scheme scheme, double step) {
    oscillation o = oscillation_run(scheme, step);
    oscillation_free(&o);
    return o;
}

/* Behind the exact motion, as the window of Fig. 3.7 shows it: mean over the window, radians. */
static double lag_seen(const oscillation *o) {
    double middle = 0.5 * (OSCILLATION_FROM + OSCILLATION_TIME);
    return -lead_seen(lead_at(o->step, o->angle, middle));
}

static void judge_small_and_large(const court *c) {
    oscillation fine_e = numbers_of(EXPLICIT, STEP_SMALL);
    oscillation fine_i = numbers_of(IMPLICIT, STEP_SMALL);
    oscillation large_e = numbers_of(EXPLICIT, STEP_LARGE);
    oscillation large_i = numbers_of(IMPLICIT, STEP_LARGE);
    say(c, "duration of a contact", ball_contact());
    say(c, "steps in a contact at 0.1 ms", ball_contact() / STEP_SMALL);
    say(c, "steps in a contact at 1 ms", ball_contact() / STEP_LARGE);
    say(c, "0.1 ms: largest error of the explicit scheme", fine_e.window_error);
    say(c, "0.1 ms: largest error of the implicit scheme", fine_i.window_error);
    say(c, "1 ms: largest error of the explicit scheme", large_e.window_error);
    say(c, "1 ms: largest error of the implicit scheme", large_i.window_error);
    say(c, "1 ms: explicit behind the exact solution, as the figure shows it", lag_seen(&large_e));
    say(c, "1 ms: explicit behind the exact solution, counted from the start",
        -lead_at(STEP_LARGE, large_e.angle, OSCILLATION_TIME));
    say(c, "1 ms: largest position of the explicit scheme", large_e.window_most);
}

static double most_out(clast_scheme scheme) {
    oscillation o = oscillation_run(scheme, STEP_TOO_LARGE);
    double most = 0;
    for (int n = 0; n < o.count; n++) most = fmax(most, fabs(o.x[n]) / BALL_RADIUS);
    oscillation_free(&o);
    return most;
}

/* Fig. 3.8, whose steps are not printed: up to the largest that the text names and both hold, and
 * up to the explicit scheme's limit. */
static void judge_steps(const court *c) {
    double named = INFINITY, all = INFINITY, growth = INFINITY, before[2] = {0, 0};
    for (int n = -3; n <= 15; n++) {
        double step = STEP_SMALL * pow(10, n / 10.0);
        double e = numbers_of(EXPLICIT, step).error, i = numbers_of(IMPLICIT, step).error;
        all = fmin(all, e / i);
        if (step < 1.01 * STEP_LARGE) named = fmin(named, e / i);
        if (before[0] > 0 && e < 1) growth = fmin(growth, fmin(e / before[0], i / before[1]));
        before[0] = e, before[1] = i;
    }
    say(c, "error of the explicit over that of the implicit scheme; least up to 1 ms", named);
    say(c, "error of the explicit over that of the implicit scheme; least up to 3.2 ms", all);
    say(c, "error at a step over that at 0.8 of it; least of all", growth);
}

static void judge_limits_of_sandwich(const court *c) {
    say(c, "3.5 ms: explicit, farthest way of the centre", most_out(EXPLICIT));
    say(c, "3.5 ms: implicit, farthest way of the centre", most_out(IMPLICIT));
    say(c, "largest step of the implicit scheme over the duration of a contact",
        scheme_limit(IMPLICIT, 0) / contact_phase(1));
}

/* Theory and engine: radians per period of all schemes where the eigenvalue is of the motion. */
static void judge_leads(const court *c) {
    double worst = 0;
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int i = 0; i < 2; i++) {
            double step = i ? STEP_LARGE : STEP_SMALL;
            scheme_motion theory = scheme_motion_of((clast_scheme)k, ball_frequency() * step, 0);
            double ours = lead_per_period(step, numbers_of((clast_scheme)k, step).angle);
            worst = fmax(worst, fabs(ours - lead_per_period(step, theory.angle)));
        }
    say(c, "all schemes: lead per period, largest difference from theory", worst);
}

/* ---- S12 3.9.2 ------------------------------------------------------------------------------- */

typedef struct spread {
    double least, most, worst_at; /* overlaps; fraction of the one farthest from the exact */
} spread;

static spread over_fractions(clast_scheme scheme, int fractions) {
    spread s = {INFINITY, 0, NAN};
    double worst = 0;
    for (int i = 0; i < fractions; i++) {
        double fraction = i / (fractions - 1.0);
        double overlap = approach_overlap(scheme, APPROACH_RESOLUTION, fraction);
        s.least = fmin(s.least, overlap), s.most = fmax(s.most, overlap);
        if (fabs(overlap - 1) > worst) worst = fabs(overlap - 1), s.worst_at = fraction;
    }
    return s;
}

static double depth_apart(double resolution) {
    return fabs(approach_overlap(EXPLICIT, resolution, 0) -
                approach_overlap(IMPLICIT, resolution, 0));
}

static void judge_approach(const court *c, int fractions) {
    spread e = over_fractions(EXPLICIT, fractions), i = over_fractions(IMPLICIT, fractions);
    say(c, "resolution 1.2: what the fraction does to the explicit over the implicit scheme",
        (e.most - e.least) / (i.most - i.least));
    say(c, "explicit: fraction of the worst, from the nearer end of the step",
        fmin(e.worst_at, 1 - e.worst_at));
    say(c, "implicit: fraction of the worst, from the nearer end of the step",
        fmin(i.worst_at, 1 - i.worst_at));
    double apart = 0, off = 0;
    for (double r = 5; r < 50; r *= 1.02) {
        apart = fmax(apart, depth_apart(r));
        off = fmax(off, fabs(approach_overlap(EXPLICIT, r, 0) - 1));
        off = fmax(off, fabs(approach_overlap(IMPLICIT, r, 0) - 1));
    }
    say(c, "resolution 5 and more: largest overlaps of the two schemes apart", apart);
    say(c, "resolution 5 and more: error of the largest overlap", off);
    say(c, "largest overlaps apart at resolution 1.2 over those at 5 and more",
        depth_apart(APPROACH_RESOLUTION) / apart);
}

/* ---- limits ---------------------------------------------------------------------------------- */

static double measured_at(const sandwich_map *map, clast_scheme scheme) {
    for (int i = 0; i < map->count; i++) {
        const step_limit *l = &map->limits[i];
        if (l->scheme == scheme && l->restitution == 1 && l->upper) return l->measured;
    }
    return NAN;
}

/* Not a number where one of the two is not. */
static double larger(double a, double b) {
    return isnan(a) || a >= b ? a : b;
}

/* A step at either end of the count cannot be told. */
static double time_off(const step_limit *l) {
    return fmax(0, fabs(l->steps - l->predicted) - 2) / l->predicted;
}

static void judge_map(const court *c, const sandwich_size *size) {
    sandwich_map map = map_measure(size);
    double off = 0, late = 0;
    int missed = 0;
    printf("%-17s %5s %6s %9s %9s %8s %9s %8s\n", "scheme", "e", "side", "theory", "engine", "%",
           "predicted", "steps");
    for (int i = 0; i < map.count; i++) {
        const step_limit *l = &map.limits[i];
        printf("%-17s %5g %6s %9.4f %9.4f %8.2f %9.0f %8d\n", name_of(l->scheme), l->restitution,
               l->upper ? "above" : "below", l->theory, l->measured,
               100 * (l->measured / l->theory - 1), l->predicted, l->steps);
        off = larger(off, fabs(l->measured / l->theory - 1));
        if (l->steps < 0)
            missed++;
        else
            late = larger(late, time_off(l));
    }
    say(c, "limits: largest difference of the engine from theory", off);
    say(c, "Numerov's limit over position Verlet's",
        measured_at(&map, IMPLICIT) / measured_at(&map, EXPLICIT));
    say(c, "failures at 1.05 of a limit that no guard caught", missed);
    say(c, "steps until a failure is caught, largest difference from theory", late);
    free(map.limits);
}

static void judge_quiet(const court *c, const sandwich_size *size) {
    int alarms = 0;
    for (int k = 0; k < CLAST_SCHEMES; k++) {
        double most = scheme_limit((clast_scheme)k, 0);
        if (!(most > 0 && isfinite(most))) continue;
        quiet_run q = quiet_at_a_tenth((clast_scheme)k, size->quiet);
        printf("%-17s at a tenth of its limit: %d steps, residual %.2g, lost in theory %.2g%s%s\n",
               name_of((clast_scheme)k), q.steps, q.residual, q.lost, q.alarm ? ": " : "", q.words);
        alarms += q.alarm && !q.deserved;
    }
    say(c, "false alarms at a tenth of the limit", alarms);
}

/* ---- orders ---------------------------------------------------------------------------------- */

static double off_order(const convergence *m) {
    const clast_scheme_info *info = clast_scheme_info_of(m->scheme);
    int order = m->restitution < 1 ? info->order_damped : info->order;
    return fabs(m->order_x - order);
}

static void judge_orders(const court *c, const sandwich_size *size) {
    double smooth = 0, onset[2] = {0, 0};
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int damped = 0; damped < 2; damped++) {
            double e = damped ? ORDER_RESTITUTION : 1;
            convergence s = converge_smooth((clast_scheme)k, e, size->finest);
            convergence b = converge_onset((clast_scheme)k, e, size->finest);
            smooth = larger(smooth, off_order(&s));
            onset[damped] = larger(onset[damped], b.order_x);
            printf("%-17s e = %g: order %.3f smooth, %.3f with an onset\n",
                   name_of((clast_scheme)k), e, s.order_x, b.order_x);
        }
    say(c, "order of the positions on smooth motion, largest difference from theory", smooth);
    say(c, "order with an onset, without damping: largest", onset[0]);
    say(c, "order with an onset, with damping: largest", onset[1]);
}

/* ---- all ------------------------------------------------------------------------------------- */

int sandwich_verdicts(const sandwich_size *size, const char *csv) {
    char why[PUBLISHED_ERROR_MAX];
    court c = {published_read(SCENES "/published.csv", why), verdict_new("sandwich")};
    if (!c.published) {
        fprintf(stderr, "%s\n", why);
        return 4;
    }
    judge_small_and_large(&c);
    judge_limits_of_sandwich(&c);
    judge_steps(&c);
    judge_leads(&c);
    judge_approach(&c, size->fractions);
    judge_map(&c, size);
    judge_quiet(&c, size);
    judge_orders(&c, size);
    int code = verdict_finish(c.table, csv, stdout);
    verdict_free(c.table);
    published_free(c.published);
    return code;
}

/* impacts.c - one law at one speed: what theory says, what the engine does. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "experiments/collision/collision.h"

enum { POINTS = 3 * IMPACT_RESOLUTION, DRAWN = 100, MARKS = 20 };

static const double PI = 3.14159265358979323846;

/* ---- theory ---------------------------------------------------------------------------------- */

static double linear_stiffness(const trial *t) {
    double modulus = trial_modulus(t->young);
    if (t->law == CLAST_LAW_MAW) return maw_stiffness(modulus, BALL_RADIUS, trial_mass(), t->speed);
    if (t->law == CLAST_LAW_HOOKE) return hooke_stiffness(modulus, BALL_RADIUS);
    return t->stiffness;
}

/* The dashpot with which the asked-for restitution is the measured one: what the engine solves for.
 */
static linear_contact linear_of(const trial *t) {
    double k = linear_stiffness(t), m = trial_mass();
    double z = linear_damping_ratio(t->restitution, true);
    return (linear_contact){m, k, 2 * z * sqrt(k * m), true};
}

static hysteretic_contact hysteretic_of(const trial *t) {
    double e = t->restitution;
    return (hysteretic_contact){trial_mass(), t->stiffness, t->stiffness / (e * e)};
}

static double hertz_time(const trial *t) {
    double k = hertz_stiffness(trial_modulus(t->young), BALL_RADIUS);
    return hertz_impact(trial_mass(), k, t->speed).duration;
}

static hertz_contact hertz_of(const trial *t) {
    double k = hertz_stiffness(trial_modulus(t->young), BALL_RADIUS), m = trial_mass();
    hertz_contact c = {k, sqrt(k * m)};
    if (t->restitution == 1)
        c.dashpot = 0;
    else
        impact_solve(hertz_force, &c, &c.dashpot, m, t->speed, hertz_time(t), t->restitution);
    return c;
}

/* States at equal times from the touch on: closed forms, or the trace of the reference. */
typedef struct solution {
    impact all;
    bool closed;
    impact_point points[POINTS];
    int count;
} solution;

static void trace_law(solution *s, const trial *t, impact_law *law, const void *constants) {
    impact_trace trace = {s->points, POINTS, 0, t->step};
    s->all = impact_integrate(law, constants, trial_mass(), t->speed, hertz_time(t), &trace);
    s->count = trace.count - 1; /* the last is the end itself */
}

static void fill_closed(solution *s, const trial *t) {
    linear_contact l = linear_of(t);
    hysteretic_contact h = hysteretic_of(t);
    bool yields = t->law == CLAST_LAW_WALTON_BRAUN;
    s->closed = true;
    s->all = yields ? hysteretic_impact(&h, t->speed) : linear_impact(&l, t->speed);
    for (s->count = 0; s->count * t->step <= s->all.duration; s->count++) {
        double time = s->count * t->step;
        impact_state at = yields ? hysteretic_impact_at(&h, t->speed, time)
                                 : linear_impact_at(&l, t->speed, time);
        s->points[s->count] = (impact_point){time, at.overlap, at.rate};
    }
}

static void solve(solution *s, const trial *t) {
    s->closed = false;
    if (t->law == CLAST_LAW_HERTZ_BRILLIANTOV) {
        viscous_contact c = {hertz_stiffness(trial_modulus(t->young), BALL_RADIUS), t->dissipation};
        trace_law(s, t, viscous_force, &c);
    } else if (t->law == CLAST_LAW_HERTZ_A00 || t->law == CLAST_LAW_HERTZ_MINDLIN) {
        hertz_contact c = hertz_of(t);
        trace_law(s, t, hertz_force, &c);
        s->closed = c.dashpot == 0;
        if (s->closed) s->all = hertz_impact(trial_mass(), c.stiffness, t->speed);
    } else {
        fill_closed(s, t);
    }
}

double trial_contact_time(const trial *t) {
    switch (t->law) {
    case CLAST_LAW_HERTZ_A00:
    case CLAST_LAW_HERTZ_MINDLIN:
    case CLAST_LAW_HERTZ_BRILLIANTOV:
        return hertz_time(t);
    default:
        return PI * sqrt(trial_mass() / linear_stiffness(t));
    }
}

impact trial_theory(const trial *t) {
    trial fine = *t;
    fine.step = trial_contact_time(t) / IMPACT_RESOLUTION;
    solution *s = malloc(sizeof *s);
    if (!s) abort();
    solve(s, &fine);
    impact all = s->all;
    free(s);
    return all;
}

/* ---- the engine ------------------------------------------------------------------------------ */

static impact measure(const trial *t, const trial_point *points) {
    impact found = {0};
    for (int i = 0; i <= t->steps; i++) {
        if (points[i].overlap > found.overlap_max) {
            found.overlap_max = points[i].overlap;
            found.time_max = points[i].time;
        }
        if (points[i].force > 0) {
            found.duration = points[i].time + 0.5 * t->step;
            found.overlap_end = points[i].overlap;
        }
    }
    found.rebound = -points[t->steps].rate;
    return found;
}

static void compare(impact_case *c, const solution *s, const trial_point *points) {
    for (int i = 0; i < s->count; i++) {
        const trial_point *p = &points[c->trial.lead + i];
        double x = fabs(p->overlap - s->points[i].overlap) / s->all.overlap_max;
        double v = fabs(p->rate - s->points[i].rate) / c->trial.speed;
        c->worst_overlap = fmax(c->worst_overlap, x);
        c->worst_rate = fmax(c->worst_rate, v);
    }
}

/* N, from the rates a step before and after. */
static double force_at(const solution *s, int i) {
    int before = i > 0 ? i - 1 : 0, after = i + 1 < s->count ? i + 1 : i;
    const impact_point *a = &s->points[before], *b = &s->points[after];
    return -trial_mass() * (b->rate - a->rate) / (b->time - a->time);
}

/* SI units; the figures normalise. A line of theory, marks of the engine. */
static void write_curves(const impact_case *c, const solution *s, const trial_point *points,
                         FILE *f, const char *series) {
    int stride = s->count / DRAWN + 1, marks = s->count / MARKS + 1;
    for (int i = 0; i < s->count; i += stride) {
        const impact_point *p = &s->points[i];
        fprintf(f, "%s,theory,%.8g,%.8g,%.8g,%.8g\n", series, p->time, p->overlap, p->rate,
                force_at(s, i));
    }
    fprintf(f, "%s,theory,%.8g,%.8g,%.8g,0\n", series, s->all.duration, s->all.overlap_end,
            -s->all.rebound);
    for (int i = 0; i < s->count; i += marks) {
        const trial_point *p = &points[c->trial.lead + i];
        fprintf(f, "%s,engine,%.8g,%.8g,%.8g,%.8g\n", series, p->time, p->overlap, p->rate,
                p->force);
    }
}

void impact_case_run(impact_case *c, FILE *curve, const char *series) {
    trial *t = &c->trial;
    t->step = trial_contact_time(t) / IMPACT_RESOLUTION;
    t->lead = 2;
    t->steps = POINTS - 1;
    solution *s = malloc(sizeof *s);
    trial_point *points = malloc((size_t)(t->steps + 1) * sizeof *points);
    if (!s || !points) abort();
    solve(s, t);
    trial_run(t, points);
    c->theory = s->all, c->closed = s->closed;
    c->measured = measure(t, points);
    c->worst_overlap = c->worst_rate = 0;
    compare(c, s, points);
    if (curve) write_curves(c, s, points, curve, series);
    free(s), free(points);
}

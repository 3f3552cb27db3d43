/* limits.c - the largest steps of every scheme. Walls nearer than a diameter keep both contacts
 * closed, so that the engine is a linear oscillator and the amplification matrix is exact; what
 * fails is found by the guard on the overlap, which stops the run. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/sandwich/sandwich.h"

/* Of the radius, what must come to the press for the guard to stop a run. So small that no dashpot
 * ever pulls a wall's force to zero, where the engine cuts it off. */
static const double TRIP = 1e-5;

typedef struct oscillator {
    clast_scheme scheme;
    double restitution; /* of one contact with the damping ratio of the oscillator */
} oscillator;

static clast_world *start(const oscillator *o, double h, double amplitude) {
    ball_def def = ball_pressed(o->scheme, o->restitution, h, TRIP);
    def.x = amplitude, def.v = 0.3 * ball_pressed_frequency() * amplitude;
    return ball_new(&def);
}

/* ---- what holds and what fails --------------------------------------------------------------- */

/* A motion that has all but died out holds. Schemes that look back are started with a Runge-Kutta
 * scheme, which may be beyond its own limit: room for that. */
static bool holds(const oscillator *o, double h, int budget) {
    const double most = TRIP * BALL_RADIUS, way = 1e-17;
    double room = clast_scheme_info_of(o->scheme)->past > 0 ? 1e6 : 20;
    clast_world *w = start(o, h, most / room);
    bool failed = false, gone = false;
    for (int n = 0; n < budget && !failed && !gone; n++) {
        failed = clast_world_step(w) != CLAST_OK;
        gone = fabs(ball_x(w)) < way && fabs(ball_v(w)) < way * ball_pressed_frequency();
    }
    ball_free(w);
    return !failed;
}

/* Bisected to 0.1 %; NAN where the ends of the bracket behave alike. */
static double measured_limit(const oscillator *o, bool upper, double low, double high, int budget) {
    if (holds(o, low, budget) != upper || holds(o, high, budget) == upper) return NAN;
    while (high > 1.001 * low) {
        double middle = sqrt(low * high);
        if (holds(o, middle, budget) == upper)
            low = middle;
        else
            high = middle;
    }
    return sqrt(low * high);
}

/* The next power of 1.3 that is at least a tenth away, so that the bisection does not end at theory
 * by the choice of its bracket. */
static double below(double h) {
    return pow(1.3, floor(log(h / 1.1) / log(1.3)));
}

static double above(double h) {
    return pow(1.3, ceil(log(h * 1.1) / log(1.3)));
}

/* ---- the time to detection ------------------------------------------------------------------- */

/* Steps from the first that shows LEVEL, once the fastest growth has taken over, to the guard. */
static void detect(step_limit *l) {
    const double level = 1e-13, most = TRIP * BALL_RADIUS, small = l->upper ? 1e-15 : 1e-17;
    const oscillator o = {l->scheme, l->restitution};
    double h = l->theory * (l->upper ? 1.05 : 1 / 1.05), from = 0;
    clast_world *w = start(&o, h, small);
    double growth = log(scheme_growth(l->scheme, h, l->damping));
    double enough = 4 * log(most / level) / growth + 100;
    int since = 0, n = 0;
    bool failed = false;
    while (!failed && n < enough) {
        failed = clast_world_step(w) != CLAST_OK;
        n++;
        if (from == 0 && fabs(ball_x(w)) > level) from = fabs(ball_x(w)), since = n;
    }
    ball_free(w);
    l->steps = failed ? n - since : -1;
    l->predicted = from > 0 ? log(most / from) / growth : NAN;
}

/* ---- all limits of a scheme ------------------------------------------------------------------ */

double contact_phase(double restitution) {
    double z = linear_damping_ratio(restitution, true);
    const linear_contact c = {.mass = 1, .stiffness = 1, .dashpot = 2 * z, .cut_off = true};
    return linear_impact(&c, 1).duration;
}

static double between(double a, double b) {
    return sqrt(a * b);
}

int limits_measure(clast_scheme scheme, double restitution, int budget,
                   step_limit limits[LIMITS_PER_SCHEME]) {
    scheme_range ranges[SCHEME_RANGES_MAX];
    double damping = restitution < 1 ? linear_damping_ratio(restitution, true) : 0;
    int pieces = scheme_ranges(scheme, damping, ranges), count = 0;
    for (int i = 0; i < 2 * pieces; i++) {
        double at = i % 2 ? ranges[i / 2].to : ranges[i / 2].from;
        if (!(at > 0) || isinf(at)) continue;
        limits[count++] = (step_limit){.scheme = scheme,
                                       .restitution = restitution,
                                       .damping = damping,
                                       .upper = i % 2 == 1,
                                       .theory = at};
    }
    const oscillator o = {scheme, restitution};
    double phase = contact_phase(restitution);
    for (int i = 0; i < count; i++) {
        step_limit *l = &limits[i];
        double low = below(l->theory), high = above(l->theory);
        if (i > 0) low = fmax(low, between(l[-1].theory, l->theory));
        if (i + 1 < count) high = fmin(high, between(l->theory, l[1].theory));
        l->measured = measured_limit(&o, l->upper, low, high, budget);
        l->resolution_theory = phase / l->theory;
        l->resolution_measured = phase / l->measured;
        detect(l);
    }
    return count;
}

static const double RESTITUTIONS[] = {1, 0.7, 0.9, 0.8, 0.5, 0.35, 0.2, 0.1};

sandwich_map map_measure(const sandwich_size *size) {
    sandwich_map map = {0, calloc((size_t)(size->restitutions * CLAST_SCHEMES * LIMITS_PER_SCHEME),
                                  sizeof *map.limits)};
    if (!map.limits) abort();
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int i = 0; i < size->restitutions; i++)
            map.count += limits_measure((clast_scheme)k, RESTITUTIONS[i], size->budget,
                                        map.limits + map.count);
    return map;
}

/* ---- no false alarm -------------------------------------------------------------------------- */

/* Part of the energy put in that a scheme loses by itself: of that of the motion, which is the
 * elastic energy at the start less that of the press alone. */
static double lost_by_theory(clast_scheme scheme, double h, const ball_def *def, int steps) {
    double rest = BALL_RADIUS - def->gap, a = rest + def->x, b = rest - def->x;
    double moving = 1 - 2 * rest * rest / (a * a + b * b);
    return moving * (1 - pow(scheme_motion_of(scheme, h, 0).decay, 2.0 * steps));
}

quiet_run quiet_at_a_tenth(clast_scheme scheme, int steps) {
    const clast_world_def usual = clast_world_def_default();
    quiet_run q = {.step = 0.1 * scheme_limit(scheme, 0)};
    ball_def def = ball_pressed(scheme, 1, q.step, usual.max_overlap);
    def.x = 0.04 * BALL_RADIUS;
    def.max_displacement = usual.max_displacement, def.max_residual = usual.max_residual;
    clast_world *w = ball_new(&def);
    while (q.steps < steps && !q.alarm) {
        q.alarm = clast_world_step(w) != CLAST_OK;
        q.steps++;
    }
    clast_energy e = clast_world_energy(w);
    q.residual = e.residual / e.input;
    q.lost = lost_by_theory(scheme, q.step, &def, q.steps);
    q.deserved = q.alarm && q.lost > 0.9 * usual.max_residual;
    snprintf(q.words, sizeof q.words, "%s", q.alarm ? clast_world_error(w) : "");
    ball_free(w);
    return q;
}

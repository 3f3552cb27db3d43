/* orders.c - errors of every scheme against its step: on smooth motion, and on a collision, whose
 * force (damped) or its slope jumps within a step. */
#include <math.h>

#include "experiments/sandwich/sandwich.h"

static const double PI = 3.14159265358979323846;

typedef struct errors {
    double x, v; /* of the amplitude */
} errors;

/* ---- smooth ---------------------------------------------------------------------------------- */

/* Displacement and rate of x'' = -x - 2 z x' from (x, v) after time t. */
static errors swing(double z, double x, double v, double t) {
    double w = sqrt(1 - z * z), c = cos(w * t), s = sin(w * t), decay = exp(-z * t);
    return (errors){decay * (x * c + (v + z * x) / w * s), decay * (v * c - (x + z * v) / w * s)};
}

/* Largest errors over 2.4 periods; n steps in half of one. */
static errors smooth(clast_scheme scheme, double restitution, double n) {
    const double amplitude = 0.04 * BALL_RADIUS, omega = ball_pressed_frequency(), kick = 0.8;
    double z = linear_damping_ratio(restitution, true), h = PI / n;
    ball_def def = ball_pressed(scheme, restitution, h, 0.4);
    def.x = amplitude, def.v = kick * omega * amplitude;
    clast_world *w = ball_new(&def);
    errors e = {0, 0};
    for (int i = 1; i <= (int)(4.8 * n); i++) {
        if (clast_world_step(w)) {
            e = (errors){INFINITY, INFINITY};
            break;
        }
        errors exact = swing(z, 1, kick, i * h);
        e.x = fmax(e.x, fabs(ball_x(w) / amplitude - exact.x));
        e.v = fmax(e.v, fabs(ball_v(w) / (omega * amplitude) - exact.v));
    }
    ball_free(w);
    return e;
}

/* ---- with an onset --------------------------------------------------------------------------- */

/* Errors at a fifth of a contact after its end, n steps in it: the largest over the places of the
 * touch within a step. */
static errors bounce(clast_scheme scheme, double restitution, double n) {
    enum { PLACES = 8, LEAD = 6 };
    const double omega = ball_frequency(), speed = APPROACH_SPEED, unit = speed / omega;
    double z = linear_damping_ratio(restitution, true), step = ball_contact() / n;
    const linear_contact c = {ball_mass(), BALL_STIFFNESS, 2 * z * ball_mass() * omega, true};
    errors e = {0, 0};
    for (int i = 0; i < PLACES; i++) {
        double lead = LEAD + (i + 0.37) / PLACES;
        ball_def def = {.scheme = scheme,
                        .restitution = restitution,
                        .step = step,
                        .gap = BALL_RADIUS,
                        .single = true,
                        .x = lead * speed * step,
                        .v = -speed,
                        .max_overlap = 1.9};
        clast_world *w = ball_new(&def);
        int steps = LEAD + 1 + (int)ceil(1.2 * n);
        for (int k = 0; k < steps; k++) clast_world_step(w);
        impact_state exact = linear_impact_at(&c, speed, (steps - lead) * step);
        e.x = fmax(e.x, fabs(-ball_x(w) - exact.overlap) / unit);
        e.v = fmax(e.v, fabs(-ball_v(w) - exact.rate) / speed);
        ball_free(w);
    }
    return e;
}

/* ---- slopes ---------------------------------------------------------------------------------- */

/* Least squares through the logarithms of the finest points above what rounding leaves. */
static double slope(const convergence *c, const double *error) {
    enum { FITTED = 3 };
    const double rounding = 1e-9;
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    int n = 0;
    for (int i = c->count - 1; i >= 0 && n < FITTED; i--) {
        if (!(error[i] > rounding && error[i] < 1)) continue;
        double x = log(c->resolution[i]), y = -log(error[i]);
        sx += x, sy += y, sxx += x * x, sxy += x * y, n++;
    }
    return n > 1 ? (n * sxy - sx * sy) / (n * sxx - sx * sx) : NAN;
}

typedef errors trial(clast_scheme scheme, double restitution, double n);

static void refine(convergence *c, trial *run, double odd, int finest) {
    for (int k = 2; k <= finest; k++) {
        double n = ldexp(1, k) + odd;
        errors e = run(c->scheme, c->restitution, n);
        c->resolution[c->count] = n, c->x[c->count] = e.x, c->v[c->count++] = e.v;
    }
    c->order_x = slope(c, c->x), c->order_v = slope(c, c->v);
}

convergence converge_smooth(clast_scheme scheme, double restitution, int finest) {
    convergence c = {.scheme = scheme, .restitution = restitution};
    refine(&c, smooth, 0, finest);
    return c;
}

/* The same part of a step over in every contact: none at all would cancel errors of its ends. */
convergence converge_onset(clast_scheme scheme, double restitution, int finest) {
    convergence c = {.scheme = scheme, .restitution = restitution, .onset = true};
    refine(&c, bounce, 0.37, finest);
    return c;
}

/* oscillation.c - S12 3.9.1: the walls are a diameter apart, so that the ball always touches one of
 * them, and released from an overlap it swings as a harmonic oscillator. */
#include <math.h>
#include <stdlib.h>

#include "experiments/sandwich/sandwich.h"

static const double PI = 3.14159265358979323846, AMPLITUDE = OSCILLATION_START * BALL_RADIUS;

double oscillation_exact(double time) {
    return AMPLITUDE * cos(ball_frequency() * time);
}

double lead_per_period(double step, double angle) {
    double exact = ball_frequency() * step;
    return 2 * PI * (angle - exact) / exact;
}

double lead_at(double step, double angle, double time) {
    return (angle / step - ball_frequency()) * time;
}

double lead_seen(double lead) {
    return lead - 2 * PI * ceil((lead - PI) / (2 * PI));
}

/* ---- what turns, and how fast ---------------------------------------------------------------- */

/* A motion r^n cos(n a + b) obeys x(n+1) = p x(n) + q x(n-1) with p = 2 r cos a and q = -r^2: least
 * squares over the run, after what the scheme starts with has died out and before rounding. */
static void take_turn(oscillation *o) {
    enum { SETTLED = 12 };
    double aa = 0, ab = 0, bb = 0, ay = 0, by = 0;
    for (int n = SETTLED; n + 1 < o->count; n++) {
        double a = o->x[n], b = o->x[n - 1], y = o->x[n + 1];
        if (hypot(a, b) < 1e-7 * AMPLITUDE) break;
        aa += a * a, ab += a * b, bb += b * b, ay += a * y, by += b * y;
    }
    double det = aa * bb - ab * ab;
    double p = (ay * bb - by * ab) / det, q = (by * aa - ay * ab) / det;
    o->decay = q < 0 ? sqrt(-q) : NAN;
    o->angle = acos(p / (2 * o->decay));
}

static void take_errors(oscillation *o) {
    for (int n = 0; n < o->count; n++) {
        double t = n * o->step, off = fabs(o->x[n] - oscillation_exact(t)) / AMPLITUDE;
        o->error = fmax(o->error, off);
        if (t < OSCILLATION_FROM - 1e-9) continue;
        o->window_error = fmax(o->window_error, off);
        o->window_most = fmax(o->window_most, fabs(o->x[n]) / AMPLITUDE);
    }
    if (o->thrown) o->error = o->window_error = o->window_most = INFINITY;
}

/* ---- the run --------------------------------------------------------------------------------- */

oscillation oscillation_run(clast_scheme scheme, double step) {
    int steps = (int)floor(OSCILLATION_TIME / step + 1e-6);
    oscillation o = {.scheme = scheme, .step = step, .angle = NAN, .decay = NAN};
    o.x = malloc((size_t)(steps + 1) * sizeof *o.x);
    if (!o.x) abort();
    ball_def def = {.scheme = scheme,
                    .restitution = 1,
                    .step = step,
                    .gap = BALL_RADIUS,
                    .x = AMPLITUDE,
                    .max_overlap = 1};
    clast_world *w = ball_new(&def);
    o.x[o.count++] = ball_x(w);
    while (o.count <= steps && !o.thrown) {
        o.thrown = clast_world_step(w) != CLAST_OK;
        o.x[o.count++] = ball_x(w);
    }
    ball_free(w);
    take_errors(&o);
    take_turn(&o);
    return o;
}

void oscillation_free(oscillation *o) {
    free(o->x);
    o->x = NULL;
}

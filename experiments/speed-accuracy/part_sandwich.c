/* part_sandwich.c - the ball between two walls of S12 3.9.1 (experiments/sandwich): 44 oscillations
 * without loss. Every scheme and step: by what part of a period it is out of phase at the end, and
 * by how much its energy ever was off. Nothing here is left to chance or to where a step falls. */
#include <math.h>
#include <stdio.h>

#include "experiments/sandwich/sandwich.h"
#include "experiments/speed-accuracy/chart.h"

enum { TIMED = 32, TIMED_STEPS = 300 }; /* balls in a row; most steps of a pass */

static const double PI = 3.14159265358979323846, AMPLITUDE = OSCILLATION_START * BALL_RADIUS;

/* s, the largest step; the text of the source names 0.1, 1 and 3.5 ms. */
static const double COARSEST = 3.5e-3;

typedef struct setting {
    clast_scheme scheme;
    double step; /* s */
} setting;

static clast_world *world_of(const setting *s, int balls) {
    ball_def def = {.scheme = s->scheme,
                    .restitution = 1,
                    .step = s->step,
                    .gap = BALL_RADIUS,
                    .x = AMPLITUDE,
                    .max_overlap = 1,
                    .row = balls};
    return ball_new(&def);
}

static int steps_of(const setting *s) {
    return (int)floor(OSCILLATION_TIME / s->step + 1e-6);
}

/* ---- errors ---------------------------------------------------------------------------------- */

/* Of a period, at the end. INFINITY where the ball is thrown out or does not swing. */
static double phase_error(const setting *s) {
    oscillation o = oscillation_run(s->scheme, s->step);
    double lead = lead_at(s->step, o.angle, OSCILLATION_TIME) / (2 * PI);
    bool lost = o.thrown;
    oscillation_free(&o);
    return lost || !isfinite(lead) ? INFINITY : fabs(lead);
}

/* Largest change, of what was put in. */
static double energy_error(const setting *s) {
    clast_world *w = world_of(s, 1);
    double most = 0;
    for (int i = 0; i < steps_of(s); i++) {
        if (clast_world_step(w)) {
            most = INFINITY;
            break;
        }
        double x = ball_x(w) / AMPLITUDE, v = ball_v(w) / (AMPLITUDE * ball_frequency());
        most = fmax(most, fabs(x * x + v * v - 1));
    }
    ball_free(w);
    return most;
}

/* ---- cost ------------------------------------------------------------------------------------ */

/* Of one ball: that of a row over their number. */
static work_done swing(const void *what, int pass) {
    (void)pass;
    const setting *s = what;
    clast_world *w = world_of(s, TIMED);
    double from = processor_seconds();
    for (int i = 0; i < steps_of(s) && i < TIMED_STEPS; i++)
        if (clast_world_step(w)) break;
    clast_counters counters = clast_world_counters(w);
    work_done done = {processor_seconds() - from, TIMED * clast_world_time(w),
                      TIMED * (double)counters.force_evaluations};
    clast_world_free(w); /* not into the hash: how many passes there are is up to the clock */
    return done;
}

/* ---- the part -------------------------------------------------------------------------------- */

static void add(chart *c, const setting *s, double least) {
    chart_point p = {.part = PART_SANDWICH,
                     .scene = "e=1",
                     .level = ball_contact() / s->step,
                     .step = s->step,
                     .difference = NAN,
                     .samples = 1,
                     .overlap = NAN};
    snprintf(p.family, sizeof p.family, "%s", clast_scheme_info_of(s->scheme)->name);
    snprintf(p.setting, sizeof p.setting, "%.3g steps per contact", p.level);
    p.cost = cost_measure(swing, s, least, &p.evaluations);
    p.quantity = "phase";
    p.error = p.low = p.high = phase_error(s);
    chart_add(c, &p);
    double phase = p.error;
    p.quantity = "energy";
    p.error = p.low = p.high = energy_error(s);
    chart_add(c, &p);
    p.quantity = "largest";
    p.error = p.low = p.high = fmax(phase, p.error);
    chart_add(c, &p);
}

void sandwich_points(chart *c, const chart_size *size, bool timed) {
    double range = size->finest / COARSEST;
    int steps = (int)ceil(-size->per_decade * log10(range));
    for (int k = 0; k < CLAST_SCHEMES; k++)
        for (int i = 0; i <= steps; i++) {
            setting s = {(clast_scheme)k, COARSEST * pow(range, (double)i / steps)};
            add(c, &s, timed ? size->least : 0);
        }
    chart_fold_hash(c, ball_hashes());
}

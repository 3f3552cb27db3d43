/* schemes.c - the collision of S12 2.7.6 and 3.4: a linear spring-dashpot at a few steps per
 * contact, every scheme of the engine beside the exact solution. */
#include <math.h>
#include <stdlib.h>

#include "experiments/collision/collision.h"

static const double PI = 3.14159265358979323846;

enum { LEAD = 6 }; /* steps of free flight: more than any scheme remembers */

/* S12 gives every scheme the positions of its first two steps and does not say which: those before
 * and at the touch. "late" shifts the touch within the step; between are the schemes' worst places.
 */
const scheme_setup SCHEME_SETUPS[] = {
    {"as printed", false, false, 0},
    {"dashpot solved for e", true, false, 0},
    {"shorter contact", false, true, 0},
    {"both", true, true, 0},
    {"a quarter step late", false, false, 0.25},
    {"half a step late", false, false, 0.5},
    {"three quarters late", false, false, 0.75},
};
const int SCHEME_SETUP_COUNT = sizeof SCHEME_SETUPS / sizeof *SCHEME_SETUPS;

/* ---- the set-up ------------------------------------------------------------------------------ */

typedef struct problem {
    linear_contact contact;
    impact exact;
    double damping, frequency, step; /* -, 1/s, s */
} problem;

static problem problem_of(double resolution, double restitution, const scheme_setup *setup) {
    double m = trial_mass(), k = LINEAR_STIFF;
    double z = linear_damping_ratio(restitution, setup->solved_dashpot);
    problem p = {
        .contact = {m, k, 2 * z * sqrt(k * m), true}, .damping = z, .frequency = sqrt(k / m)};
    p.exact = linear_impact(&p.contact, IMPACT_SPEED);
    double printed = PI / (p.frequency * sqrt(1 - z * z)); /* S12 2.22 */
    p.step = (setup->short_contact ? p.exact.duration : printed) / resolution;
    return p;
}

static trial trial_of(const problem *p, clast_scheme scheme, double late, int steps) {
    return (trial){.law = CLAST_LAW_LINEAR,
                   .scheme = scheme,
                   .young = BALL_YOUNG,
                   .stiffness = LINEAR_STIFF,
                   .restitution = p->exact.rebound / IMPACT_SPEED,
                   .speed = IMPACT_SPEED,
                   .step = p->step,
                   .lead = LEAD,
                   .late = late,
                   .steps = steps};
}

/* ---- the engine beside the exact solution ---------------------------------------------------- */

/* Position Verlet has the velocity of S12 2.68, a step behind; the engine's view would be that of
 * 2.70. */
static double rate_of(clast_scheme scheme, const trial_point *p, double step) {
    if (scheme != CLAST_SCHEME_POSITION_VERLET) return p->rate;
    return (p->overlap - p[-2].overlap) / (2 * step);
}

static void take_points(scheme_run *r, const problem *p, const trial_point *points, double late) {
    int first = LEAD + (late > 0);
    r->count = 0;
    for (int i = first; r->count < SCHEME_POINTS; i++) {
        double t = points[i].time;
        if (t > p->exact.duration + 2.5 * p->step) break;
        impact_state exact = linear_impact_at(&p->contact, IMPACT_SPEED, fmax(t, 0));
        int n = r->count++;
        r->time[n] = t;
        r->overlap[n] = points[i].overlap, r->rate[n] = rate_of(r->scheme, &points[i], p->step);
        r->exact_overlap[n] = exact.overlap, r->exact_rate[n] = exact.rate;
    }
}

/* Errors while the exact contact lasts, the touch itself left out. */
static void take_errors(scheme_run *r, const problem *p) {
    bool first = true;
    for (int n = 0; n < r->count; n++) {
        double t = r->time[n], x = (r->overlap[n] - r->exact_overlap[n]) / r->overlap_unit;
        double v = (r->rate[n] - r->exact_rate[n]) / r->speed;
        r->overlap_max = fmax(r->overlap_max, r->overlap[n] / r->overlap_unit);
        if (t < 0.01 * p->step || t > p->exact.duration * (1 + 1e-9)) continue;
        r->overlap_error = fmax(r->overlap_error, fabs(x));
        r->rate_error = fmax(r->rate_error, fabs(v));
        double *phase = t <= p->exact.time_max ? &r->loading_error : &r->unloading_error;
        *phase = fmax(*phase, fabs(x));
        r->overlap_last_error = fabs(x);
        if (first) r->first_overlap_excess = x, r->first_rate_excess = v;
        first = false;
    }
}

/* ---- the engine beside the matrix ------------------------------------------------------------ */

/* Free flight up to the touch: no forces yet. */
static void start_in_flight(clast_scheme scheme, const problem *p, double state[SCHEME_SIZE_MAX]) {
    double way = IMPACT_SPEED * p->step;
    for (int i = 0; i < SCHEME_SIZE_MAX; i++) state[i] = 0;
    for (int i = 0; i < scheme_size(scheme); i += 4) state[i] = -way * (i / 4), state[i + 1] = way;
}

/* Largest difference of the overlaps as long as the matrix, which knows no cut-off, repels. The
 * backward difference of Numerov's dashpot reaches from the step before the touch, where the engine
 * has no contact yet and the matrix does: NAN. */
static double difference_from_map(const scheme_run *r, const problem *p, double late) {
    bool early = r->scheme == CLAST_SCHEME_NUMEROV_BACKWARD && p->damping > 0;
    if (early || late > 0) return NAN;
    double state[SCHEME_SIZE_MAX], matrix[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], worst = 0;
    scheme_matrix(r->scheme, p->frequency * p->step, p->damping, matrix);
    start_in_flight(r->scheme, p, state);
    for (int n = 1; n < r->count; n++) {
        scheme_advance(r->scheme, matrix, state);
        if (state[0] <= 0 || state[2] + state[3] >= 0) break; /* apart, or it would pull */
        worst = fmax(worst, fabs(state[0] - r->overlap[n]) / r->overlap_unit);
    }
    return worst;
}

scheme_run scheme_collide(clast_scheme scheme, double resolution, double restitution,
                          const scheme_setup *setup) {
    problem p = problem_of(resolution, restitution, setup);
    scheme_run r = {.scheme = scheme,
                    .resolution = resolution,
                    .restitution = restitution,
                    .step = p.step,
                    .speed = IMPACT_SPEED,
                    .overlap_unit = IMPACT_SPEED / p.frequency,
                    .rebound_exact = p.exact.rebound};
    trial_point points[LEAD + SCHEME_POINTS + 64];
    trial t = trial_of(&p, scheme, setup->late, LEAD + (int)(3 * resolution) + 12);
    if (t.steps > LEAD + SCHEME_POINTS + 62) t.steps = LEAD + SCHEME_POINTS + 62;
    trial_run(&t, points);
    take_points(&r, &p, points, setup->late);
    take_errors(&r, &p);
    r.overlap_max_exact = p.exact.overlap_max / r.overlap_unit;
    r.rebound = -points[t.steps].rate;
    r.map_difference = difference_from_map(&r, &p, setup->late);
    return r;
}

/* ---- the onset ------------------------------------------------------------------------------- */

onset_error scheme_onset_error(clast_scheme scheme, double resolution, double restitution,
                               int places) {
    problem p = problem_of(resolution, restitution, &SCHEME_SETUPS[0]);
    onset_error e = {0};
    int steps = LEAD + (int)(3 * resolution) + 12;
    trial_point points[LEAD + 3 * 256 + 14];
    for (int i = 0; i < places; i++) {
        trial t = trial_of(&p, scheme, (i + 0.5) / places, steps);
        trial_run(&t, points);
        double off = -points[steps].rate / p.exact.rebound - 1;
        e.mean += off / places;
        e.rms += off * off / places;
        e.worst = fmax(e.worst, fabs(off));
    }
    e.rms = sqrt(e.rms);
    return e;
}

/* ---- all of them ----------------------------------------------------------------------------- */

const double SCHEME_RESOLUTION[2] = {4, 8}, SCHEME_RESTITUTION[2] = {1, 0.5};

static void run_set(scheme_set *s, const scheme_setup *setup) {
    for (int r = 0; r < 2; r++)
        for (int e = 0; e < 2; e++)
            for (int k = 0; k < CLAST_SCHEMES; k++)
                s->run[r][e][k] = scheme_collide((clast_scheme)k, SCHEME_RESOLUTION[r],
                                                 SCHEME_RESTITUTION[e], setup);
}

scheme_set *scheme_sets_run(void) {
    scheme_set *sets = malloc((size_t)SCHEME_SETUP_COUNT * sizeof *sets);
    if (!sets) abort();
    for (int i = 0; i < SCHEME_SETUP_COUNT; i++) run_set(&sets[i], &SCHEME_SETUPS[i]);
    return sets;
}

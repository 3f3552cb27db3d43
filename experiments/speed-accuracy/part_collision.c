/* part_collision.c - one collision of a sphere with a wall (experiments/collision): every scheme,
 * from two steps per contact on, beside a closed form or a reference integration.
 *
 * A contact begins anywhere within a step, so a row of balls meets the wall in many places of it:
 * the error is the root of the mean square over them. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include <gsl/gsl_sort.h>
#include <gsl/gsl_statistics.h>

#include "engine/check.h"
#include "experiments/collision/collision.h"
#include "experiments/speed-accuracy/chart.h"

enum { LEAD = 6, PLACES_MAX = 64 }; /* steps of free flight: more than any scheme remembers */
enum { REBOUND, DURATION, OVERLAP, LARGEST, QUANTITIES };

static const char *const QUANTITY[QUANTITIES] = {"rebound", "duration", "overlap", "largest"};

static const struct {
    const char *name;
    clast_law law;
    double restitution;
} CASES[] = {
    {"linear e=1", CLAST_LAW_LINEAR, 1},
    {"linear e=0.5", CLAST_LAW_LINEAR, 0.5},
    {"Hertz e=1", CLAST_LAW_HERTZ_MINDLIN, 1},
    {"Hertz e=0.5", CLAST_LAW_HERTZ_MINDLIN, 0.5},
};

/* What is seen of a collision from outside, and the largest overlap. The duration lasts until the
 * overlap would be zero again, also where the force ends earlier (S12 2.23): it is read off the
 * free flight, not off the steps that happen to have a force. */
typedef struct encounter {
    double of[LARGEST]; /* m/s, s, m */
} encounter;

static encounter encounter_in_theory(const trial *t) {
    impact exact = trial_theory(t);
    return (encounter){
        {exact.rebound, exact.duration + exact.overlap_end / exact.rebound, exact.overlap_max}};
}

/* ---- one place in a step --------------------------------------------------------------------- */

/* Largest value of the cubic through two points with their slopes, of which the first is > 0 and
 * the second is not: what is largest between two steps is no error of the scheme. */
static double top_between(const trial_point *a, const trial_point *b, double step) {
    double first = step * a->rate, last = step * b->rate, rise = b->overlap - a->overlap;
    double square = 3 * rise - 2 * first - last, cube = first + last - 2 * rise;
    double root = sqrt(square * square - 3 * cube * first), s = first / (root - square);
    return a->overlap + s * (first + s * (square + s * cube));
}

static double largest_overlap(const trial *t, const trial_point *points) {
    double most = 0;
    for (int i = 0; i < t->steps; i++) {
        const trial_point *a = &points[i], *b = &points[i + 1];
        most = fmax(most, b->overlap);
        if (a->overlap > 0 && a->rate > 0 && b->rate <= 0)
            most = fmax(most, top_between(a, b, t->step));
    }
    return most;
}

/* Something not finite where the ball has not come off. */
static encounter encounter_of(const trial *t, const trial_point *points) {
    const trial_point *last = &points[t->steps];
    bool off = last->overlap < 0 && last->rate < 0;
    return (encounter){{-last->rate, off ? last->time - last->overlap / last->rate : INFINITY,
                        largest_overlap(t, points)}};
}

/* ---- all places ------------------------------------------------------------------------------ */

typedef struct scattered {
    double rms, low, high; /* low, high: a tenth of the places is better, none is worse */
} scattered;

static scattered scatter_of(double *errors, int n) {
    scattered s = {0, INFINITY, INFINITY};
    for (int i = 0; i < n; i++) s.rms += errors[i] * errors[i] / n;
    s.rms = sqrt(s.rms);
    if (!isfinite(s.rms)) return (scattered){INFINITY, INFINITY, INFINITY};
    gsl_sort(errors, 1, (size_t)n);
    s.low = gsl_stats_quantile_from_sorted_data(errors, 1, (size_t)n, 0.1);
    s.high = errors[n - 1];
    return s;
}

typedef struct setting {
    trial trial;
    int places;
} setting;

static void measure_errors(const setting *s, const encounter *exact, scattered to[QUANTITIES]) {
    double errors[QUANTITIES][PLACES_MAX];
    size_t each = (size_t)s->trial.steps + 1, places = (size_t)s->places;
    trial_point *points = malloc(places * each * sizeof *points);
    CLAST_ASSERT(points && s->places <= PLACES_MAX);
    trial_row_run(&s->trial, s->places, points);
    for (size_t i = 0; i < places; i++) {
        encounter e = encounter_of(&s->trial, points + i * each);
        errors[LARGEST][i] = 0;
        for (int q = 0; q < LARGEST; q++) {
            double off = fabs(e.of[q] / exact->of[q] - 1);
            errors[q][i] = isfinite(off) ? off : INFINITY;
            errors[LARGEST][i] = fmax(errors[LARGEST][i], errors[q][i]);
        }
    }
    free(points);
    for (int q = 0; q < QUANTITIES; q++) to[q] = scatter_of(errors[q], s->places);
}

/* ---- cost ------------------------------------------------------------------------------------ */

/* Of one ball: that of the row over their number. */
static work_done collide(const void *what, int pass) {
    (void)pass;
    const setting *s = what;
    clast_world *w = trial_row_new(&s->trial, s->places);
    double from = processor_seconds();
    for (int i = 0; i < s->trial.steps; i++)
        if (clast_world_step(w)) break;
    work_done done = {processor_seconds() - from, s->places * s->trial.steps * s->trial.step,
                      s->places * (double)clast_world_counters(w).force_evaluations};
    clast_world_free(w);
    return done;
}

/* ---- the part -------------------------------------------------------------------------------- */

static void add_points(chart *c, const char *scene, clast_scheme scheme, double resolution,
                       const setting *s, const scattered found[QUANTITIES], double least) {
    chart_point p = {.part = PART_COLLISION,
                     .scene = scene,
                     .level = resolution,
                     .step = s->trial.step,
                     .difference = NAN,
                     .samples = s->places,
                     .overlap = NAN};
    snprintf(p.family, sizeof p.family, "%s", clast_scheme_info_of(scheme)->name);
    snprintf(p.setting, sizeof p.setting, "%.3g steps per contact", resolution);
    p.cost = cost_measure(collide, s, least, &p.evaluations);
    for (int q = 0; q < QUANTITIES; q++) {
        p.quantity = QUANTITY[q];
        p.error = found[q].rms, p.low = found[q].low, p.high = found[q].high;
        chart_add(c, &p);
    }
}

/* Powers of sqrt(2), and the same part of a step over in every contact: with none at all, the
 * errors of its two ends would cancel. */
static double resolution_of(int i) {
    return round(2 * pow(2, 0.5 * i)) + 0.37;
}

/* As long in flight after the contact as in it, at least: a scheme may come off late. */
static int steps_of(const encounter *exact, double step) {
    return LEAD + 7 + (int)ceil(2 * exact->of[DURATION] / step);
}

void collision_points(chart *c, const chart_size *size, bool timed) {
    for (size_t k = 0; k < sizeof CASES / sizeof *CASES; k++) {
        trial t = {.law = CASES[k].law,
                   .restitution = CASES[k].restitution,
                   .young = BALL_YOUNG,
                   .stiffness = LINEAR_STIFF,
                   .speed = IMPACT_SPEED,
                   .lead = LEAD};
        encounter exact = encounter_in_theory(&t);
        for (int i = 0; i < size->resolutions; i++) {
            double resolution = resolution_of(i);
            t.step = trial_contact_time(&t) / resolution;
            t.steps = steps_of(&exact, t.step);
            for (int scheme = 0; scheme < CLAST_SCHEMES; scheme++) {
                t.scheme = (clast_scheme)scheme;
                setting s = {t, size->places};
                scattered found[QUANTITIES];
                measure_errors(&s, &exact, found);
                add_points(c, CASES[k].name, t.scheme, resolution, &s, found,
                           timed ? size->least : 0);
            }
        }
    }
    chart_fold_hash(c, trials_hash());
}

/* statements.c - sentences of S12 sections 2.7.6, 3.4.1 and 3.4.2 as numbers. Where one says that a
 * scheme is better than others, the number is the ratio of errors that then is above 1. */
#include <math.h>

#include "experiments/collision/collision.h"

enum { ELASTIC, DAMPED }; /* e = 1 and 0.5 */
enum { COARSE, FINE };    /* contact resolution 4 and 8 */
enum { FIVE = 5, NUMEROVS = 3 };

static const clast_scheme EXPLICIT[FIVE] = {CLAST_SCHEME_TAYLOR, CLAST_SCHEME_SYMPLECTIC_EULER,
                                            CLAST_SCHEME_POSITION_VERLET,
                                            CLAST_SCHEME_VELOCITY_VERLET, CLAST_SCHEME_GEAR4};
enum { TAYLOR, EULER, POSITION_VERLET, VELOCITY_VERLET, GEAR };

typedef double number_of(const scheme_run *r);

static double overlap_error(const scheme_run *r) {
    return r->overlap_error;
}
static double rate_error(const scheme_run *r) {
    return r->rate_error;
}
static double both_errors(const scheme_run *r) {
    return r->overlap_error + r->rate_error;
}
static double first_rate(const scheme_run *r) {
    return r->first_rate_excess;
}
static double first_overlap(const scheme_run *r) {
    return r->first_overlap_excess;
}
static double last_rate(const scheme_run *r) {
    return r->rebound / r->rebound_exact - 1;
}
static double largest_overlap(const scheme_run *r) {
    return r->overlap_max - r->overlap_max_exact;
}

/* Of the explicit schemes from .. to - 1 at contact resolution 4. */
static double most(const scheme_set *s, int e, number_of *number, int from, int to) {
    double found = -INFINITY;
    for (int i = from; i < to; i++) found = fmax(found, number(&s->run[COARSE][e][EXPLICIT[i]]));
    return found;
}

static double least(const scheme_set *s, int e, number_of *number, int from, int to) {
    double found = INFINITY;
    for (int i = from; i < to; i++) found = fmin(found, number(&s->run[COARSE][e][EXPLICIT[i]]));
    return found;
}

static double of(const scheme_set *s, int e, number_of *number, int which) {
    return number(&s->run[COARSE][e][EXPLICIT[which]]);
}

/* ---- 2.7.6, without dissipation -------------------------------------------------------------- */

static double taylor_positions(const scheme_set *s) {
    return of(s, ELASTIC, overlap_error, TAYLOR) /
           most(s, ELASTIC, overlap_error, TAYLOR + 1, FIVE);
}

static double taylor_velocities(const scheme_set *s) {
    return of(s, ELASTIC, rate_error, TAYLOR) / most(s, ELASTIC, rate_error, TAYLOR + 1, FIVE);
}

static double euler_beside_taylor(const scheme_set *s) {
    return of(s, ELASTIC, both_errors, TAYLOR) / of(s, ELASTIC, both_errors, EULER);
}

static double verlets_apart(const scheme_set *s) {
    const scheme_run *a = &s->run[COARSE][ELASTIC][CLAST_SCHEME_POSITION_VERLET];
    const scheme_run *b = &s->run[COARSE][ELASTIC][CLAST_SCHEME_VELOCITY_VERLET];
    double worst = 0;
    for (int n = 0; n < a->count && n < b->count; n++)
        worst = fmax(worst, fabs(a->overlap[n] - b->overlap[n]) / a->overlap_unit);
    return worst;
}

static double verlet_velocities(const scheme_set *s) {
    return of(s, ELASTIC, rate_error, POSITION_VERLET) /
           of(s, ELASTIC, rate_error, VELOCITY_VERLET);
}

static double best_two(const scheme_set *s) {
    return least(s, ELASTIC, both_errors, TAYLOR, VELOCITY_VERLET) /
           most(s, ELASTIC, both_errors, VELOCITY_VERLET, FIVE);
}

/* ---- 2.7.6, with dissipation ----------------------------------------------------------------- */

static double dissipation_costs(const scheme_set *s) {
    double found = INFINITY;
    for (int i = 0; i < FIVE; i++)
        found = fmin(found, of(s, DAMPED, both_errors, i) / of(s, ELASTIC, both_errors, i));
    return found;
}

static double first_velocity(const scheme_set *s) {
    return least(s, DAMPED, first_rate, 0, FIVE);
}

static double last_velocity(const scheme_set *s) {
    return least(s, DAMPED, last_rate, 0, FIVE);
}

static double first_velocity_of_best(const scheme_set *s) {
    return least(s, DAMPED, first_rate, 0, VELOCITY_VERLET) -
           most(s, DAMPED, first_rate, VELOCITY_VERLET, FIVE);
}

static double last_velocity_of_best(const scheme_set *s) {
    return least(s, DAMPED, last_rate, 0, VELOCITY_VERLET) -
           most(s, DAMPED, last_rate, VELOCITY_VERLET, FIVE);
}

static double first_position(const scheme_set *s) {
    return least(s, DAMPED, first_overlap, 0, FIVE);
}

static double deepest(const scheme_set *s) {
    return least(s, DAMPED, largest_overlap, 0, FIVE);
}

static double finer_is_better(const scheme_set *s) {
    double found = 0;
    for (int e = 0; e < 2; e++)
        for (int i = 0; i < FIVE; i++)
            found = fmax(found, both_errors(&s->run[FINE][e][EXPLICIT[i]]) /
                                    both_errors(&s->run[COARSE][e][EXPLICIT[i]]));
    return found;
}

/* ---- 3.4 ------------------------------------------------------------------------------------- */

static const scheme_run *numerov(const scheme_set *s, int e, clast_scheme which) {
    return &s->run[COARSE][e][which];
}

static double numerov_beside_gear(const scheme_set *s) {
    return numerov(s, ELASTIC, CLAST_SCHEME_NUMEROV_CENTRAL)->overlap_error /
           of(s, ELASTIC, overlap_error, GEAR);
}

static double gear_goes_deep_right(const scheme_set *s) {
    return fabs(largest_overlap(numerov(s, ELASTIC, CLAST_SCHEME_NUMEROV_CENTRAL))) /
           fabs(of(s, ELASTIC, largest_overlap, GEAR));
}

static double numerov_ends_right(const scheme_set *s) {
    return s->run[COARSE][ELASTIC][CLAST_SCHEME_GEAR4].overlap_last_error /
           numerov(s, ELASTIC, CLAST_SCHEME_NUMEROV_CENTRAL)->overlap_last_error;
}

static double backward_is_worst(const scheme_set *s) {
    return numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_BACKWARD)->overlap_error /
           fmax(numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_FORWARD)->overlap_error,
                numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_CENTRAL)->overlap_error);
}

static double forward_loads_best(const scheme_set *s) {
    return numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_CENTRAL)->loading_error /
           numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_FORWARD)->loading_error;
}

static double central_unloads_best(const scheme_set *s) {
    return numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_FORWARD)->unloading_error /
           numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_CENTRAL)->unloading_error;
}

static double central_beats_explicit(const scheme_set *s) {
    return least(s, DAMPED, overlap_error, 0, FIVE) /
           numerov(s, DAMPED, CLAST_SCHEME_NUMEROV_CENTRAL)->overlap_error;
}

const statement STATEMENTS[] = {
    {"e = 1: error of Taylor's positions over the largest of the others", taylor_positions},
    {"e = 1: error of Taylor's velocities over the largest of the others", taylor_velocities},
    {"e = 1: errors of Taylor over those of symplectic Euler", euler_beside_taylor},
    {"e = 1: positions of the two Verlet schemes apart", verlets_apart},
    {"e = 1: error of position Verlet's velocities over velocity Verlet's", verlet_velocities},
    {"e = 1: errors of the best of the others over velocity Verlet and Gear", best_two},
    {"e = 0.5: errors over those at e = 1; least of the schemes", dissipation_costs},
    {"e = 0.5: first velocity too large; least of the schemes", first_velocity},
    {"e = 0.5: last velocity too large; least of the schemes", last_velocity},
    {"e = 0.5: first velocity of the others above velocity Verlet and Gear",
     first_velocity_of_best},
    {"e = 0.5: last velocity of the others above velocity Verlet and Gear", last_velocity_of_best},
    {"e = 0.5: first overlap too large; least of the schemes", first_position},
    {"e = 0.5: largest overlap too large; least of the schemes", deepest},
    {"errors at resolution 8 over those at 4; largest of the schemes", finer_is_better},
    {"e = 1: error of Numerov's positions over Gear's", numerov_beside_gear},
    {"e = 1: error of Numerov's largest overlap over Gear's", gear_goes_deep_right},
    {"e = 1: error of Gear's last overlap over Numerov's", numerov_ends_right},
    {"e = 0.5: error of Numerov backward over the larger of the others", backward_is_worst},
    {"e = 0.5: loading error of Numerov central over forward", forward_loads_best},
    {"e = 0.5: unloading error of Numerov forward over central", central_unloads_best},
    {"e = 0.5: error of the best explicit scheme over Numerov central", central_beats_explicit},
};
const int STATEMENT_COUNT = sizeof STATEMENTS / sizeof *STATEMENTS;

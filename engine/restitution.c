/* The damping ratio that gives a wanted rebound.
 *
 * One collision in units of mass 1, stiffness 1 and impact speed 1:
 *     linear       x'' = -x       - 2 beta x'
 *     Hertz        x'' = -x^(3/2) - 2 beta sqrt(3/2) x^(1/4) x'   (c = 2 beta sqrt(k_n m), k_n =
 *                                                                  dF/dx)
 *     Brilliantov  x'' = -x^(3/2) - A x^(1/2) x'                  (A in units of time)
 * cut off where the force would pull (S12 2.23). So the restitution does not depend on the speed,
 * but for Brilliantov's law, where the unit of time does. The closed forms S12 2.21 and A00 1.20
 * leave the cut-off out and rebound too fast (FACTS 1). Fixed steps of a GSL Runge-Kutta scheme and
 * Brent's bracketing: arithmetic and sqrt only, so the result has the same bits on every machine.
 * The only file that knows GSL. */
#include <math.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_roots.h>

#include "engine/check.h"
#include "engine/clast.h"

enum { STEPS_PER_CONTACT = 4000, STEPS_MAX = 4000000 };

typedef struct collision {
    bool linear, viscoelastic;
    double beta;
} collision;

static double spring(const collision *c, double x) {
    return c->linear ? x : x > 0 ? x * sqrt(x) : 0;
}

static double dashpot(const collision *c, double x) {
    if (c->linear) return 2 * c->beta;
    if (!(x > 0)) return 0;
    return c->viscoelastic ? c->beta * sqrt(x) : 2 * c->beta * sqrt(1.5 * sqrt(x));
}

static double force(const collision *c, const double y[2]) {
    return spring(c, y[0]) + dashpot(c, y[0]) * y[1];
}

static int rates(double t, const double y[], double dydt[], void *params) {
    (void)t;
    dydt[0] = y[1];
    dydt[1] = -force(params, y);
    return GSL_SUCCESS;
}

/* Bisects the last step for the moment at which the force vanishes; returns the speed there. */
static double speed_at_release(const gsl_odeiv2_system *system, gsl_odeiv2_step *stepper,
                               const double before[2], double h) {
    double low = 0, high = h, y[2] = {before[0], before[1]}, error[2];
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        y[0] = before[0], y[1] = before[1];
        gsl_odeiv2_step_reset(stepper);
        gsl_odeiv2_step_apply(stepper, 0, middle, y, error, NULL, NULL, system);
        if (y[1] < 0 && force(system->params, y) <= 0)
            high = middle;
        else
            low = middle;
    }
    return -y[1];
}

double clast_restitution(clast_law law, double damping_ratio) {
    CLAST_ASSERT(damping_ratio >= 0);
    const clast_law_info *info = clast_law_info_of(law);
    collision c = {info->linear, info->dissipation, damping_ratio};
    if (damping_ratio == 0) return 1;
    gsl_odeiv2_system system = {rates, NULL, 2, &c};
    gsl_odeiv2_step *stepper = gsl_odeiv2_step_alloc(gsl_odeiv2_step_rk4, 2);
    double h = 3.2 / STEPS_PER_CONTACT / (1 + damping_ratio);
    double y[2] = {0, 1}, before[2] = {0, 1}, error[2];
    for (int i = 0; i < STEPS_MAX; i++) {
        before[0] = y[0], before[1] = y[1];
        gsl_odeiv2_step_apply(stepper, 0, h, y, error, NULL, NULL, &system);
        if (y[1] < 0 && force(&c, y) <= 0) break;
    }
    double e = speed_at_release(&system, stepper, before, h);
    gsl_odeiv2_step_free(stepper);
    return e;
}

typedef struct target {
    clast_law law;
    double restitution;
} target;

static double excess(double damping_ratio, void *params) {
    const target *t = params;
    return clast_restitution(t->law, damping_ratio) - t->restitution;
}

double clast_damping_ratio(clast_law law, double restitution) {
    CLAST_ASSERT(restitution > 0.01 && restitution <= 1);
    if (restitution == 1) return 0;
    target t = {law, restitution};
    gsl_function function = {excess, &t};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    double high = 1;
    while (excess(high, &t) > 0) high *= 2;
    gsl_root_fsolver_set(solver, &function, 0, high);
    for (int i = 0; i < 200; i++) {
        gsl_root_fsolver_iterate(solver);
        double low = gsl_root_fsolver_x_lower(solver), up = gsl_root_fsolver_x_upper(solver);
        if (gsl_root_test_interval(low, up, 0, 1e-13) == GSL_SUCCESS) break;
    }
    double root = gsl_root_fsolver_root(solver);
    gsl_root_fsolver_free(solver);
    return root;
}

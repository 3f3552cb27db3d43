/* models.c - tanks in series and axial dispersion.
 *
 * O. Levenspiel, Chemical Reaction Engineering, 3rd ed. 1999, chapters 13 and 14: n equal stirred
 * tanks in series have a gamma distribution with variance over squared mean 1/n (n need not be
 * whole). Plug flow with axial dispersion, Pe = u L / D, depends on the ends of the vessel. Ours
 * records the first passage of the outlet, so what fits is the inverse Gaussian distribution
 * (first passage of a Brownian motion with drift, open at the inlet), 2/Pe. Danckwerts' closed
 * vessel, 2/Pe - 2 (1 - exp(-Pe)) / Pe2, stands beside it: the two differ by about 1 in Pe. */
#include "experiments/rtd/rtd.h"

#include <math.h>
#include <stdlib.h>

#include <gsl/gsl_cdf.h>
#include <gsl/gsl_errno.h>
#include <gsl/gsl_multifit_nlinear.h>
#include <gsl/gsl_roots.h>
#include <gsl/gsl_sf_erf.h>

#include "engine/check.h"

/* ---- from the variance ----------------------------------------------------------------------- */

double tanks_of_spread(double spread) {
    return spread > 0 ? 1 / spread : (double)NAN;
}

double peclet_open(double spread) {
    return spread > 0 ? 2 / spread : (double)NAN;
}

double spread_of_peclet_closed(double pe) {
    CLAST_ASSERT(pe > 0);
    if (pe < 1e-3) return 1 - pe / 3; /* the next term is Pe2/12: 1e-7 */
    return 2 / pe + 2 * expm1(-pe) / (pe * pe);
}

static double closed_excess(double log_pe, void *spread) {
    return spread_of_peclet_closed(exp(log_pe)) - *(double *)spread;
}

double peclet_closed(double spread) {
    if (!(spread > 1e-9 && spread < 1 - 1e-6)) return NAN;
    gsl_function f = {closed_excess, &spread};
    gsl_root_fsolver *solver = gsl_root_fsolver_alloc(gsl_root_fsolver_brent);
    CLAST_ASSERT(solver);
    gsl_root_fsolver_set(solver, &f, log(1e-6), log(1e10)); /* it falls strictly in between */
    int status = GSL_CONTINUE;
    for (int i = 0; i < 200 && status == GSL_CONTINUE; i++) {
        gsl_root_fsolver_iterate(solver);
        status = gsl_root_test_interval(gsl_root_fsolver_x_lower(solver),
                                        gsl_root_fsolver_x_upper(solver), 1e-12, 0);
    }
    double pe = exp(gsl_root_fsolver_root(solver));
    gsl_root_fsolver_free(solver);
    return pe;
}

/* ---- shares that have left ------------------------------------------------------------------- */

double tanks_share(double t, double mean, double tanks) {
    CLAST_ASSERT(mean > 0 && tanks > 0);
    return t > 0 ? gsl_cdf_gamma_P(t, tanks, mean / tanks) : 0;
}

double dispersion_share(double t, double mean, double peclet) {
    CLAST_ASSERT(mean > 0 && peclet > 0);
    if (!(t > 0)) return 0;
    double theta = t / mean, root = sqrt(peclet / (2 * theta));
    /* the second term is exp(Pe) times a tail: both in logarithms, or it overflows */
    double back = peclet - M_LN2 + gsl_sf_log_erfc(root * (theta + 1) / M_SQRT2);
    return gsl_cdf_ugaussian_P(root * (theta - 1)) + exp(back);
}

/* ---- least squares --------------------------------------------------------------------------- */

typedef struct task {
    rtd_model *model;
    const double *share;
    size_t n;
    double sampling;
} task;

/* Share that leaves in each interval, model minus data: the intervals are as wide as they are, so
 * nothing is lost by a coarse sampling. Parameters are logarithms: both stay above zero. */
static int residuals(const gsl_vector *x, void *context, gsl_vector *f) {
    const task *of = context;
    double mean = exp(gsl_vector_get(x, 0)), shape = exp(gsl_vector_get(x, 1));
    if (!(mean > 1e-9 && mean < 1e12 && shape > 1e-6 && shape < 1e7)) return GSL_EDOM;
    double before = 0, before_model = 0;
    for (size_t j = 0; j < of->n; j++) {
        double model = of->model((double)(j + 1) * of->sampling, mean, shape);
        gsl_vector_set(f, j, (model - before_model) - (of->share[j] - before));
        before = of->share[j], before_model = model;
    }
    return GSL_SUCCESS;
}

static double misfit_of(const task *of, double mean, double shape) {
    double sum = 0;
    for (size_t j = 0; j < of->n; j++) {
        double off = of->model((double)(j + 1) * of->sampling, mean, shape) - of->share[j];
        sum += off * off;
    }
    return sqrt(sum / (double)of->n);
}

rtd_fit model_fit(rtd_model *model, const double *share, size_t n, double sampling, double mean,
                  double shape) {
    rtd_fit none = {NAN, NAN, NAN};
    if (n < 3 || !(mean > 0) || !(shape > 0)) return none;
    task of = {model, share, n, sampling};
    gsl_multifit_nlinear_parameters parameters = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_fdf f = {.f = residuals, .n = n, .p = 2, .params = &of};
    gsl_error_handler_t *old = gsl_set_error_handler_off();
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &parameters, n, 2);
    gsl_vector *start = gsl_vector_alloc(2);
    CLAST_ASSERT(w && start);
    gsl_vector_set(start, 0, log(mean)), gsl_vector_set(start, 1, log(shape));
    int info, status = gsl_multifit_nlinear_init(start, &f, w);
    if (!status) status = gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0, NULL, NULL, &info, w);
    double found[2] = {exp(gsl_vector_get(gsl_multifit_nlinear_position(w), 0)),
                       exp(gsl_vector_get(gsl_multifit_nlinear_position(w), 1))};
    gsl_vector_free(start);
    gsl_multifit_nlinear_free(w);
    gsl_set_error_handler(old);
    if (status) return none;
    return (rtd_fit){found[0], found[1], misfit_of(&of, found[0], found[1])};
}

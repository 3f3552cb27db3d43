/* The kinematic model of a velocity profile, v = v0 exp(-x^2 / (4 B h)). */
#include <math.h>

#include <gsl/gsl_blas.h>
#include <gsl/gsl_cdf.h>
#include <gsl/gsl_min.h>
#include <gsl/gsl_multifit_nlinear.h>

#include "engine/check.h"
#include "experiments/study/statistics.h"

typedef struct profile {
    const double *x, *v;
    int n;
    double h, v0;
} profile;

/* Sum of squares that B = exp(ln_b) leaves. */
static double left_over(double ln_b, void *data) {
    const profile *p = data;
    double below = 4 * exp(ln_b) * p->h, sum = 0;
    for (int i = 0; i < p->n; i++) {
        double r = p->v[i] - p->v0 * exp(-p->x[i] * p->x[i] / below);
        sum += r * r;
    }
    return sum;
}

/* Fills b by Brent's method between the neighbours of the best point of a grid: the sum of squares
 * of scattered samples may have more than one dip. The search runs over ln B from profiles a
 * thousandth as wide as the samples reach to a hundred times as wide. */
static bool search(profile *p, double *ln_b) {
    enum { POINTS = 400 };
    double reach = 0;
    for (int i = 0; i < p->n; i++) reach = fmax(reach, fabs(p->x[i]));
    if (!(reach > 0)) return false;
    double unit = log(reach * reach / (4 * p->h));
    double low = unit + 2 * log(1e-3), step = 2 * log(1e5) / POINTS;
    int best = 0;
    for (int k = 1; k <= POINTS; k++)
        if (left_over(low + k * step, p) < left_over(low + best * step, p)) best = k;
    if (best == 0 || best == POINTS) return false;
    double a = low + (best - 1) * step, b = low + best * step, c = low + (best + 1) * step;
    *ln_b = b;
    double at_b =
        left_over(b, p); /* a valley that flat needs no Brent, who insists on a strict one */
    if (!(left_over(a, p) > at_b && left_over(c, p) > at_b)) return true;
    gsl_function f = {left_over, p};
    gsl_min_fminimizer *s = gsl_min_fminimizer_alloc(gsl_min_fminimizer_brent);
    CLAST_ASSERT(s);
    gsl_min_fminimizer_set(s, &f, b, a, c);
    for (int k = 0; k < 200; k++) {
        if (gsl_min_fminimizer_iterate(s)) break;
        a = gsl_min_fminimizer_x_lower(s), c = gsl_min_fminimizer_x_upper(s);
        if (gsl_min_test_interval(a, c, 1e-10, 0) == GSL_SUCCESS) break;
    }
    *ln_b = gsl_min_fminimizer_x_minimum(s);
    gsl_min_fminimizer_free(s);
    return true;
}

kinematic kinematic_fit(const double *x, const double *v, int n, double h, double v0) {
    CLAST_ASSERT(n >= 0 && ((x && v) || n == 0) && h > 0);
    kinematic r = {v0, 0, NAN, NAN, NAN, n, false};
    profile p = {x, v, n, h, v0};
    double ln_b;
    if (n < 2 || !(fabs(v0) > 0) || !search(&p, &ln_b)) return r;
    double left = left_over(ln_b, &p), slopes = 0;
    r.found = true;
    r.b = exp(ln_b);
    r.rms = sqrt(left / n);
    for (int i = 0; i < n; i++) { /* (dv/dB)^2 */
        double u = x[i] * x[i] / (4 * r.b * h), dv = v0 * exp(-u) * u / r.b;
        slopes += dv * dv;
    }
    r.b_half = gsl_cdf_tdist_Pinv(0.975, n - 1) * sqrt(left / (n - 1) / slopes);
    return r;
}

/* ---- both v0 and B free ---------------------------------------------------------------------- */

/* Parameters: v0 and ln B, so that B stays positive. */
static int residuals(const gsl_vector *at, void *data, gsl_vector *out) {
    const profile *p = data;
    double v0 = gsl_vector_get(at, 0), below = 4 * exp(gsl_vector_get(at, 1)) * p->h;
    for (int i = 0; i < p->n; i++)
        gsl_vector_set(out, (size_t)i, v0 * exp(-p->x[i] * p->x[i] / below) - p->v[i]);
    return GSL_SUCCESS;
}

static int slopes_of(const gsl_vector *at, void *data, gsl_matrix *out) {
    const profile *p = data;
    double v0 = gsl_vector_get(at, 0), below = 4 * exp(gsl_vector_get(at, 1)) * p->h;
    for (int i = 0; i < p->n; i++) {
        double u = p->x[i] * p->x[i] / below, e = exp(-u);
        gsl_matrix_set(out, (size_t)i, 0, e);
        gsl_matrix_set(out, (size_t)i, 1, v0 * e * u);
    }
    return GSL_SUCCESS;
}

/* Reads parameters, errors and rms out of a solver that has converged. */
static void read_solution(gsl_multifit_nlinear_workspace *w, kinematic *r) {
    gsl_matrix *cov = gsl_matrix_alloc(2, 2);
    CLAST_ASSERT(cov);
    gsl_multifit_nlinear_covar(gsl_multifit_nlinear_jac(w), 0, cov);
    double norm = gsl_blas_dnrm2(gsl_multifit_nlinear_residual(w));
    double spread = gsl_cdf_tdist_Pinv(0.975, r->n - 2) * norm / sqrt(r->n - 2);
    r->found = true;
    r->v0 = gsl_vector_get(gsl_multifit_nlinear_position(w), 0);
    r->b = exp(gsl_vector_get(gsl_multifit_nlinear_position(w), 1));
    r->v0_half = spread * sqrt(gsl_matrix_get(cov, 0, 0));
    r->b_half = spread * sqrt(gsl_matrix_get(cov, 1, 1)) * r->b;
    r->rms = norm / sqrt(r->n);
    gsl_matrix_free(cov);
}

kinematic kinematic_fit_free(const double *x, const double *v, int n, double h, double v0_start) {
    kinematic start = kinematic_fit(x, v, n, h, v0_start);
    kinematic r = {NAN, NAN, NAN, NAN, NAN, n, false};
    if (n < 3 || !start.found) return r;
    profile p = {x, v, n, h, v0_start};
    gsl_multifit_nlinear_fdf f = {
        .f = residuals, .df = slopes_of, .n = (size_t)n, .p = 2, .params = &p};
    gsl_multifit_nlinear_parameters how = gsl_multifit_nlinear_default_parameters();
    gsl_multifit_nlinear_workspace *w =
        gsl_multifit_nlinear_alloc(gsl_multifit_nlinear_trust, &how, (size_t)n, 2);
    CLAST_ASSERT(w);
    double guess[2] = {v0_start, log(start.b)};
    gsl_vector_const_view at = gsl_vector_const_view_array(guess, 2);
    int why, status = gsl_multifit_nlinear_init(&at.vector, &f, w);
    if (!status) status = gsl_multifit_nlinear_driver(200, 1e-10, 1e-10, 0, NULL, NULL, &why, w);
    if (!status) read_solution(w, &r);
    gsl_multifit_nlinear_free(w);
    return r;
}

double centre_velocity(const double *x, const double *v, int n, double width) {
    CLAST_ASSERT(n >= 0 && ((x && v) || n == 0) && width > 0);
    double sum = 0;
    int count = 0;
    for (int i = 0; i < n; i++)
        if (fabs(x[i]) <= width / 2) sum += v[i], count++;
    return count ? sum / count : NAN;
}

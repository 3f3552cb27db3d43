/* trends.c - what the source says in words of how things change, as one-sided tests. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

enum { POINTS = MAIN_SHAPES * REPLICATES_MAX };

/* Values of a main shape at the setting that replicates have; how many. */
static int values_of(const aspect_study *s, int shape, fact *of, double *value) {
    int setting = s->size->replicates[CHEAP] > 0 ? CHEAP : THESIS, n = 0;
    for (int k = 0; k < REPLICATES_MAX; k++) {
        const aspect_case *c = case_of(s, shape, setting, 0, k);
        if (c && isfinite(of(c))) value[n++] = of(c);
    }
    return n;
}

/* Over the replicates of the first `shapes`. */
static fitted_line line_over(const aspect_study *s, fact *of, int shapes) {
    double aspect[POINTS] = {0}, value[POINTS] = {0};
    int n = 0;
    for (int shape = 0; shape < shapes; shape++) {
        int more = values_of(s, shape, of, value + n);
        for (int k = 0; k < more; k++) aspect[n + k] = chain_of(shape).aspect;
        n += more;
    }
    return line_fit(aspect, value, n);
}

double trend_p(const aspect_study *s, fact *of, int sign, int shapes) {
    CLAST_ASSERT(shapes <= MAIN_SHAPES && (sign == 1 || sign == -1));
    fitted_line line = line_over(s, of, shapes);
    if (line.n < 3 || !(line.slope_error > 0)) return NAN;
    return gsl_cdf_tdist_Q(sign * line.slope / line.slope_error, line.n - 2);
}

trend trend_of(const aspect_study *s, fact *of) {
    fitted_line line = line_over(s, of, MAIN_SHAPES);
    trend t = {NAN, NAN, NAN, line.n};
    if (line.n < 3 || !(line.slope_error > 0)) return t;
    t.slope = line.slope;
    t.half = gsl_cdf_tdist_Pinv(0.975, line.n - 2) * line.slope_error;
    t.p = 2 * gsl_cdf_tdist_Q(fabs(line.slope) / line.slope_error, line.n - 2);
    return t;
}

/* Welch's test, one-sided. */
static double above(interval a, interval b) {
    if (a.n < 2 || b.n < 2) return NAN;
    t_test t = t_test_welch(a, b);
    return gsl_cdf_tdist_Q(t.t, t.df);
}

double spheres_above_p(const aspect_study *s, fact *of) {
    double sphere[REPLICATES_MAX], longer[POINTS];
    int few = values_of(s, 0, of, sphere), many = 0;
    for (int shape = 1; shape < MAIN_SHAPES; shape++)
        many += values_of(s, shape, of, longer + many);
    return above(mean_interval(sphere, few), mean_interval(longer, many));
}

double above_p(const aspect_study *s, fact *of, int a, int b) {
    return above(over(s, a, of), over(s, b, of));
}

double positive_p(const aspect_study *s, fact *of) {
    double value[POINTS];
    int n = 0;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) n += values_of(s, shape, of, value + n);
    interval all = mean_interval(value, n);
    if (n < 2) return NAN;
    return gsl_cdf_tdist_Q(all.mean / (all.sd / sqrt(n)), n - 1);
}

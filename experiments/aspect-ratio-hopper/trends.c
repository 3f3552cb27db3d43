/* trends.c - what the source says in words of how things change, as one-sided tests. The unit is
 * the replicate: what shapes differ by is what is asked for, and no scatter to test it against. */
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

/* The slope of the line through the means of the first `shapes`, each weighing the same. A linear
 * contrast: its error is that of the means, not what they lie off the line by. */
static estimate slope_over(const aspect_study *s, fact *of, int shapes) {
    interval mean[MAIN_SHAPES];
    double weight[MAIN_SHAPES], middle = 0, squares = 0, slope = 0;
    for (int i = 0; i < shapes; i++) middle += chain_of(i).aspect / shapes;
    for (int i = 0; i < shapes; i++) squares += pow(chain_of(i).aspect - middle, 2);
    for (int i = 0; i < shapes; i++) {
        mean[i] = over(s, i, of);
        weight[i] = (chain_of(i).aspect - middle) / squares;
        slope += weight[i] * mean[i].mean;
    }
    return estimate_of(slope, mean, weight, shapes);
}

static estimate times(estimate e, int sign) {
    e.value *= sign;
    return e;
}

double trend_p(const aspect_study *s, fact *of, int sign, int shapes) {
    CLAST_ASSERT(shapes > 1 && shapes <= MAIN_SHAPES && (sign == 1 || sign == -1));
    return estimate_above_p(times(slope_over(s, of, shapes), sign));
}

double above_p(const aspect_study *s, fact *of, int a, int b) {
    static const double DIFFERENCE[] = {1, -1};
    interval both[] = {over(s, a, of), over(s, b, of)};
    return estimate_above_p(estimate_of(both[0].mean - both[1].mean, both, DIFFERENCE, 2));
}

/* What is claimed of each of several is shown when it is shown of the one that shows it least; NAN
 * when it cannot be known of one (intersection-union: no correction for their number). */
static double least_shown(double p, double other) {
    return isnan(p) || isnan(other) ? (double)NAN : fmax(p, other);
}

double steps_p(const aspect_study *s, fact *of, int sign, int shapes) {
    CLAST_ASSERT(shapes > 1 && shapes <= MAIN_SHAPES && (sign == 1 || sign == -1));
    double p = 0;
    for (int i = 1; i < shapes; i++)
        p = least_shown(p, sign > 0 ? above_p(s, of, i, i - 1) : above_p(s, of, i - 1, i));
    return p;
}

double spheres_above_p(const aspect_study *s, fact *of) {
    double p = 0;
    for (int i = 1; i < MAIN_SHAPES; i++) p = least_shown(p, above_p(s, of, 0, i));
    return p;
}

double positive_p(const aspect_study *s, fact *of) {
    static const double ONE = 1;
    double p = 0;
    for (int i = 0; i < MAIN_SHAPES; i++) {
        interval mean = over(s, i, of);
        p = least_shown(p, estimate_above_p(estimate_of(mean.mean, &mean, &ONE, 1)));
    }
    return p;
}

trend trend_of(const aspect_study *s, fact *of) {
    estimate e = slope_over(s, of, MAIN_SHAPES);
    double rises = estimate_above_p(e), falls = estimate_above_p(times(e, -1));
    int sign = e.value < 0 ? -1 : 1;
    return (trend){.slope = estimate_interval(e),
                   .p = 2 * fmin(rises, falls),
                   .p_steps = steps_p(s, of, sign, MAIN_SHAPES)};
}

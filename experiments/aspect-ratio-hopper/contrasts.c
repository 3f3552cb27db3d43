/* contrasts.c - shape against roughness. Touching spheres (q = 1) change both with the aspect
 * ratio; chains of q = 4 are as smooth as one another (A00 3.7), so that spheres beside them show
 * shape alone and touching chains of the same aspect ratio roughness alone. All of them have one
 * dashpot per pair of bodies, for the number of spheres that touch is no part of either.
 *
 * Smooth chains have few replicates. Their scatter is taken from all groups that have two and more
 * (one-way analysis of variance: pooled, in percent of the mean of the group). */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

enum { SMOOTH_2 = 6, SMOOTH_5 = 7, TOUCHING_5 = 8, SHARED = 1 }; /* shapes; a variant */

const contrast CONTRASTS[] = {
    {"smooth 1.25 over spheres", "shape", {4, 0}, {0, 0}},
    {"smooth 1.5 over spheres", "shape", {5, 0}, {0, 0}},
    {"smooth 2 over spheres", "shape", {SMOOTH_2, 0}, {0, 0}},
    {"smooth 5 over spheres", "shape", {SMOOTH_5, 0}, {0, 0}},
    {"touching 2 over smooth 2", "roughness", {1, SHARED}, {SMOOTH_2, 0}},
    {"touching 5 over smooth 5", "roughness", {TOUCHING_5, 0}, {SMOOTH_5, 0}},
    {"touching 2: dashpot of each sphere over a shared one", "dashpots", {1, 0}, {1, SHARED}},
};
const int CONTRAST_COUNT = sizeof CONTRASTS / sizeof *CONTRASTS;

static interval of_group(const aspect_study *s, group g, fact *of) {
    double value[REPLICATES_MAX];
    return mean_interval(value, values_at(s, g.shape, CHEAP, g.variant, of, value));
}

static void add_squares(interval x, bool relative, double *sum, double *df) {
    if (x.n < 2 || (relative && x.mean == 0)) return;
    double sd = relative ? 100 * x.sd / fabs(x.mean) : x.sd;
    *sum += (x.n - 1) * sd * sd, *df += x.n - 1;
}

contrasted contrast_of(const aspect_study *s, const contrast *k, fact *of, bool relative) {
    CLAST_ASSERT(s && k && of);
    double sum = 0, df = 0;
    contrasted r = {of_group(s, k->a, of), of_group(s, k->b, of), NAN, NAN, NAN, 0};
    for (int shape = 0; shape < SHAPES; shape++)
        add_squares(of_group(s, (group){shape, 0}, of), relative, &sum, &df);
    add_squares(of_group(s, (group){1, SHARED}, of), relative, &sum, &df);
    if (r.a.n == 0 || r.b.n == 0 || (relative && r.b.mean == 0)) return r;
    r.change = relative ? 100 * (r.a.mean / r.b.mean - 1) : r.a.mean - r.b.mean;
    if (df < 1) return r;
    double grown = relative ? r.a.mean / r.b.mean : 1; /* of a ratio, to first order */
    double error = fabs(grown) * sqrt(sum / df * (1.0 / r.a.n + 1.0 / r.b.n));
    r.df = df;
    r.half = gsl_cdf_tdist_Pinv(0.975, df) * error;
    r.p = 2 * gsl_cdf_tdist_Q(fabs(r.change) / error, df);
    return r;
}

/* settings.c - the source's step and stiffness beside the cheaper setting that the replicates have:
 * are they shown to be equal? Margins stand in published.csv, and stood
 * there before three of the four shapes ran at the source's setting. */
#include <gsl/gsl_cdf.h>
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

const setting_fact SETTING_FACTS[] = {
    {"setting: bed height", "bed height", true},
    {"setting: solid fraction", "solid fraction", true},
    {"setting: co-ordination number", "co-ordination number", true},
    {"setting: start-up delay", "start-up delay", false},
    {"setting: rate", "rate", true},
    {"setting: log10 of the energy ratio", "energy ratio", false},
    {"setting: angle of the shear band", "shear angle", false},
    {"setting: wall load", "wall load", true},
    {"setting: wall pulse", "wall pulse", true},
};
const int SETTING_FACT_COUNT = sizeof SETTING_FACTS / sizeof *SETTING_FACTS;

interval setting_difference(const aspect_study *s, const setting_fact *f) {
    CLAST_ASSERT(s && f);
    double apart[MAIN_SHAPES];
    int n = 0;
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        fact *of = fact_named(f->fact);
        interval thesis = at_thesis(s, shape, of), cheap = over(s, shape, of);
        if (thesis.n < 1 || s->size->replicates[CHEAP] < 2 || cheap.n < 2) continue;
        double by = f->relative ? 100 / cheap.mean : 1;
        apart[n++] = (thesis.mean - cheap.mean) * by;
    }
    return mean_interval(apart, n);
}

bool stands_apart(interval replicates, double one) {
    if (replicates.n < 2 || !isfinite(one)) return false;
    double reach = gsl_cdf_tdist_Pinv(0.975, replicates.n - 1) * replicates.sd;
    return fabs(one - replicates.mean) > reach * sqrt(1 + 1.0 / replicates.n);
}

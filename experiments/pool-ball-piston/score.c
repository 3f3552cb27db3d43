/* score.c - the agreement score of A00 4.2.3: how much of a run lies within the confidence
 * intervals of five replicates. */
#include <math.h>

#include <gsl/gsl_statistics_double.h>

#include "experiments/pool-ball-piston/piston.h"

/* A00 Table 4.2. */
const int THESIS_DEGREE[PARTICLES][DEGREES] = {
    {0, 0, 17, 8}, {0, 2, 13, 10}, {0, 2, 15, 8}, {0, 3, 2, 20},  {0, 1, 4, 20},
    {0, 4, 7, 14}, {0, 3, 8, 14},  {0, 4, 8, 13}, {0, 1, 11, 13}, {0, 3, 4, 18},
};

double score_percent(const int degree[DEGREES]) {
    int points = 0, frames = 0;
    for (int k = 0; k < DEGREES; k++) points += k * degree[k], frames += degree[k];
    return 100.0 * points / ((DEGREES - 1) * frames);
}

bool score_agrees(const double *ensemble, int n, double value) {
    double mean = gsl_stats_mean(ensemble, 1, (size_t)n);
    double sd = gsl_stats_sd_m(ensemble, 1, (size_t)n, mean);
    return fabs(value - mean) <= 1.96 * sd / sqrt(n);
}

static bool agrees(const track *const *ensemble, int n, const track *t, int point, int p,
                   int item) {
    double x[REPLICATES_MAX];
    for (int i = 0; i < n; i++) x[i] = ensemble[i]->at[point][p][item];
    return score_agrees(x, n, t->at[point][p][item]);
}

scores score_against(const track *const *ensemble, int n, const track *t) {
    scores s = {.mean = 0};
    for (int p = 0; p < PARTICLES; p++) {
        for (int f = 1; f <= VIDEO_FRAMES; f++) {
            int degree = 0;
            for (int i = 0; i < ITEMS; i++)
                degree += agrees(ensemble, n, t, f * TRACK_PER_FRAME, p, i);
            s.degree[p][degree]++;
        }
        s.percent[p] = score_percent(s.degree[p]);
        s.mean += s.percent[p] / PARTICLES;
    }
    return s;
}

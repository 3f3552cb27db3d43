/* weights.c - tracers into a distribution, though some of them are still inside when the run ends.
 *
 * To leave those out would take the slow ones out and make the mean too small. In a steady state
 * the moment of entry tells nothing of the residence time, so the tracers still inside are censored
 * at random and the product-limit estimate (E. L. Kaplan and P. Meier, Nonparametric estimation
 * from incomplete observations, J. Am. Stat. Assoc. 53, 1958, 457-481) is unbiased. */
#include "experiments/rtd/rtd.h"

#include <math.h>

#include "engine/check.h"

double product_limit(const tracer *sorted, size_t n, const int *times, double *w) {
    CLAST_ASSERT((sorted && w) || n == 0);
    double at_risk = 0, survive = 1;
    for (size_t i = n; i-- > 0;) { /* w holds the mass at risk first: sums from the far end */
        CLAST_ASSERT(i + 1 == n || sorted[i].time <= sorted[i + 1].time);
        at_risk += sorted[i].mass * (times ? times[i] : 1);
        w[i] = at_risk;
    }
    for (size_t i = 0; i < n; i++) {
        double mass = sorted[i].mass * (times ? times[i] : 1);
        double share = sorted[i].left && mass > 0 ? survive * (mass / w[i]) : 0;
        w[i] = share;
        survive -= share;
    }
    return survive > 1e-12 ? survive : 0;
}

rtd_moments moments_of_weights(const tracer *sorted, size_t n, const double *w) {
    double all = 0, sum = 0, second = 0, third = 0;
    for (size_t i = 0; i < n; i++) all += w[i], sum += w[i] * sorted[i].time;
    rtd_moments m = {.mean = sum / all};
    for (size_t i = 0; i < n; i++) {
        double off = sorted[i].time - m.mean;
        second += w[i] * off * off, third += w[i] * off * off * off;
    }
    m.variance = second / all;
    m.skewness = third / all / pow(m.variance, 1.5);
    m.spread = m.variance / (m.mean * m.mean);
    return m;
}

/* Weighted covariances of two columns of a tracer. */
typedef struct covariances {
    double xx, xy, yy;
} covariances;

static covariances covariances_of(const tracer *t, size_t n, const double *w, bool ranks) {
    double all = 0, x = 0, y = 0;
    covariances c = {0};
    for (size_t i = 0; i < n; i++) {
        all += w[i];
        x += w[i] * (ranks ? t[i].rank : t[i].diameter);
        y += w[i] * (ranks ? t[i].time_rank : t[i].time);
    }
    for (size_t i = 0; i < n; i++) {
        double dx = (ranks ? t[i].rank : t[i].diameter) - x / all;
        double dy = (ranks ? t[i].time_rank : t[i].time) - y / all;
        c.xx += w[i] * dx * dx, c.xy += w[i] * dx * dy, c.yy += w[i] * dy * dy;
    }
    return c;
}

/* A resample may hold a single size where the whole does not. */
static bool is_one_size(const tracer *t, size_t n, const double *w) {
    double least = INFINITY, most = -INFINITY;
    for (size_t i = 0; i < n; i++)
        if (w[i] > 0) least = fmin(least, t[i].diameter), most = fmax(most, t[i].diameter);
    return !(least < most);
}

by_size by_size_of_weights(const tracer *sorted, size_t n, const double *w) {
    if (is_one_size(sorted, n, w)) return (by_size){NAN, NAN};
    covariances of_values = covariances_of(sorted, n, w, false);
    covariances of_ranks = covariances_of(sorted, n, w, true);
    return (by_size){of_values.xy / of_values.xx, of_ranks.xy / sqrt(of_ranks.xx * of_ranks.yy)};
}

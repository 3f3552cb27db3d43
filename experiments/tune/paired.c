#include "experiments/tune/paired.h"

#include <math.h>

#include <gsl/gsl_cdf.h>

#include "engine/check.h"

paired paired_compare(const double *reference, const double *candidate, int n, double alpha) {
    CLAST_ASSERT(n >= 0 && ((reference && candidate) || n == 0) && alpha > 0 && alpha < 1);
    paired p = {NAN, NAN, NAN, 0, 0};
    double sum = 0, difference = 0, squares = 0;
    for (int i = 0; i < n; i++) {
        if (!isfinite(reference[i])) continue;
        sum += reference[i];
        difference += candidate[i] - reference[i];
        p.lost += !isfinite(candidate[i]);
        p.n++;
    }
    if (p.n > 0) p.reference = sum / p.n;
    if (p.n < 2 || p.lost > 0 || p.reference == 0) return p;
    difference /= p.n;
    for (int i = 0; i < n; i++) {
        double off = candidate[i] - reference[i] - difference;
        if (isfinite(reference[i])) squares += off * off;
    }
    double error = sqrt(squares / (p.n - 1) / p.n);
    p.difference = difference / fabs(p.reference);
    p.half = gsl_cdf_tdist_Qinv(alpha / 2, p.n - 1) * error / fabs(p.reference);
    return p;
}

paired_answer paired_judge(const paired *p, double tolerance) {
    CLAST_ASSERT(p && tolerance > 0);
    if (p->lost > 0) return PAIRED_OUTSIDE;
    if (!isfinite(p->difference)) return PAIRED_OPEN;
    double size = fabs(p->difference);
    if (size + p->half <= tolerance) return PAIRED_WITHIN;
    return size - p->half > tolerance ? PAIRED_OUTSIDE : PAIRED_OPEN;
}

int paired_looks(int first, int most, int pairs[TUNE_LOOKS]) {
    CLAST_ASSERT(first >= 1 && most >= first && pairs);
    int looks = 0;
    for (int n = first; looks < TUNE_LOOKS; n *= 2) {
        pairs[looks++] = n < most ? n : most;
        if (n >= most) break;
    }
    return looks;
}

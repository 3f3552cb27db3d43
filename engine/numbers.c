#include "engine/numbers.h"

#include <math.h>

#include "engine/check.h"
#include "engine/clast.h"

double number_power_of_two_above(double x) {
    CLAST_ASSERT(x > 0 && x < 1e300);
    int exponent;
    double mantissa = frexp(x, &exponent); /* exact */
    return ldexp(1.0, mantissa == 0.5 ? exponent - 1 : exponent);
}

double number_fifth_root(double x) {
    CLAST_ASSERT(x > 1e-300 && x < 1e300);
    return number_fifth_root_lane(x);
}

/* ln(2^n f) = n ln 2 + 2 (z + z^3/3 + ...) with z = (f - 1) / (f + 1), f in [sqrt(1/2), sqrt(2)]:
 * z^2 < 0.0295, so the first term left out is below 1e-18. */
double number_log(double x) {
    CLAST_ASSERT(x > 1e-300 && x < 1e300);
    int exponent;
    double fraction = frexp(x, &exponent); /* exact, in [1/2, 1) */
    if (fraction < 0.70710678118654752440) fraction *= 2, exponent--;
    double z = (fraction - 1) / (fraction + 1), square = z * z, sum = 0;
    for (int k = 23; k >= 1; k -= 2) sum = 1.0 / k + square * sum;
    return exponent * 0.69314718055994530942 + 2 * z * sum;
}

void clast_sincos(double angle, double *sine, double *cosine) {
    CLAST_ASSERT(fabs(angle) <= 1e5);
    double quarter = floor(angle * (2 / NUMBER_PI) + 0.5);
    /* pi/2 in three parts of 33 bits: the products with |quarter| < 2^17 are exact (Cody, Waite) */
    double rest = angle - quarter * 1.57079632673412561417e+00;
    rest = rest - quarter * 6.07710050630396597660e-11;
    rest = rest - quarter * 2.02226624879595063154e-21;
    double s, c;
    number_sincos_small(rest, &s, &c);
    switch ((long)quarter & 3) {
    case 0:
        *sine = s, *cosine = c;
        break;
    case 1:
        *sine = c, *cosine = -s;
        break;
    case 2:
        *sine = -s, *cosine = -c;
        break;
    default:
        *sine = -c, *cosine = s;
        break;
    }
}

clast_quat clast_quat_axis_angle(clast_vec3 axis, double angle) {
    double s, c;
    clast_sincos(0.5 * angle, &s, &c);
    return (clast_quat){c, s * axis.x, s * axis.y, s * axis.z};
}

/* numbers.h - elementary functions whose bits do not depend on the machine: glibc picks variants of
 * sin, exp, pow by processor, so none of them may reach the state. */
#ifndef CLAST_NUMBERS_H
#define CLAST_NUMBERS_H

#include "engine/lanes.h"

#define NUMBER_PI 3.14159265358979323846

/* x^(1/5) for a normal x > 0, to the last bits: a fifth of the exponent and of the fraction behind
 * it (within 4 %), two steps of Halley's method and one of Newton's. */
LANE_INLINE double number_fifth_root_lane(double x) {
    int64_t high = (int64_t)((uint64_t)bits_of(x) >> 32);
    double place = double_of(high | bits_of(0x1p52)) - 0x1p52; /* the same number, in any lane */
    double fifth = 0.2 * place + 0.8 * 0x3ff00000p0;
    double y = double_of((int64_t)((uint64_t)bits_of(fifth + 0x1p52) << 32));
    for (int i = 0; i < 2; i++) {
        double power = y * y * y * y * y;
        y = y * ((2 * power + 3 * x) / (3 * power + 2 * x));
    }
    return y - 0.2 * (y - x / (y * y * y * y));
}

/* The same where x need not be in a lane; stops the program when it is not in (0, 1e300). */
double number_fifth_root(double x);

/* Natural logarithm of a normal x > 0, to a few units in the last place. */
double number_log(double x);

/* Smallest power of two >= x > 0. */
double number_power_of_two_above(double x);

/* sin and cos of |angle| <= pi/4 by their series: used inside the step, where a call would keep the
 * loop over lanes scalar. Taylor series to x^17 and x^16: the first term left out is below 1e-19 at
 * pi/4. */
__attribute__((always_inline)) static inline void number_sincos_small(double angle, double *sine,
                                                                      double *cosine) {
    double z = angle * angle;
    double p = 1.0 / 355687428096000.0;
    p = -1.0 / 1307674368000.0 + z * p;
    p = 1.0 / 6227020800.0 + z * p;
    p = -1.0 / 39916800.0 + z * p;
    p = 1.0 / 362880.0 + z * p;
    p = -1.0 / 5040.0 + z * p;
    p = 1.0 / 120.0 + z * p;
    p = -1.0 / 6.0 + z * p;
    *sine = angle + angle * (z * p);
    double q = 1.0 / 20922789888000.0;
    q = -1.0 / 87178291200.0 + z * q;
    q = 1.0 / 479001600.0 + z * q;
    q = -1.0 / 3628800.0 + z * q;
    q = 1.0 / 40320.0 + z * q;
    q = -1.0 / 720.0 + z * q;
    q = 1.0 / 24.0 + z * q;
    *cosine = 1.0 - 0.5 * z + z * (z * q);
}

#endif

/* numbers.h - elementary functions whose bits do not depend on the machine: glibc picks variants of
 * sin, exp, pow by processor, so none of them may reach the state. */
#ifndef CLAST_NUMBERS_H
#define CLAST_NUMBERS_H

#define NUMBER_PI 3.14159265358979323846

/* x^(1/5) for x > 0, to the last bits, by Newton's method from a power-of-two start. */
double number_fifth_root(double x);

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

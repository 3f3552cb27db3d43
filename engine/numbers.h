/* numbers.h - elementary functions whose bits do not depend on the machine: glibc picks variants of
 * sin, exp, pow by processor, so none of them may reach the state. */
#ifndef CLAST_NUMBERS_H
#define CLAST_NUMBERS_H

#define NUMBER_PI 3.14159265358979323846

/* x^(1/5) for x > 0, to the last bits, by Newton's method from a power-of-two start. */
double number_fifth_root(double x);

/* Smallest power of two >= x > 0. */
double number_power_of_two_above(double x);

/* sin and cos of |angle| <= pi/4 by their series: used inside the step. */
void number_sincos_small(double angle, double *sine, double *cosine);

#endif

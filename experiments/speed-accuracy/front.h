/* front.h - which of many settings are worth considering: those that no other one beats both in
 * cost and in error (the Pareto front). */
#ifndef CLAST_SPEED_ACCURACY_FRONT_H
#define CLAST_SPEED_ACCURACY_FRONT_H

#include <stdbool.h>

/* Marks the points of which no other one has neither a larger cost nor a larger error. Of points
 * that are equal in both the first is taken; points with a number that is not finite never are.
 * n >= 0. */
void pareto_front(const double *cost, const double *error, int n, bool *on_front);

/* Least squares slope of -log(error) against log(cost) over the points for which `use` holds: p of
 * error ~ cost^-p. NAN with fewer than three of them. Costs and errors > 0 where `use` holds. */
double front_order(const double *cost, const double *error, const bool *use, int n);

#endif

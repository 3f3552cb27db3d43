/* shapes.c - the two-sphere particles of A00 3.9.4. */
#include <math.h>

#include "engine/check.h"
#include "experiments/handling/handling.h"

const double ASPECT[SHAPES] = {1.2, 1.4, 1.6, 1.8, 2.0};

/* Three points of Gauss and Legendre: exact for the polynomials below. */
static const double POINT[3] = {-0.77459666924148337704, 0, 0.77459666924148337704};
static const double WEIGHT[3] = {5.0 / 9, 8.0 / 9, 5.0 / 9};

/* Half of a union of two spheres of radius r, h off the middle: disc upon disc from the middle to
 * the end of one sphere, u from its centre. */
pair_shape pair_of(double aspect) {
    CLAST_ASSERT(aspect >= 1 && aspect <= 2);
    double k = aspect - 1, r = cbrt(2 / (2 + 3 * k - k * k * k)), h = k * r;
    double volume = 0, axial = 0, across = 0;
    for (int i = 0; i < 3; i++) {
        double half = 0.5 * (r + h), u = -h + half * (1 + POINT[i]);
        double square = r * r - u * u, weight = half * WEIGHT[i];
        volume += weight * square;
        axial += weight * 0.5 * square * square;
        across += weight * (0.25 * square * square + square * (u + h) * (u + h));
    }
    return (pair_shape){r, h, axial / volume, across / volume};
}

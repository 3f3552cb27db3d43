/* fill.h - spheres that stand for a target.
 *
 * Candidates. From points spread over the surface, a sphere that touches the surface there is blown
 * up along the inward normal until it touches a second place: Ferellec and McDowell, A method to
 * model realistic particle shape and inertia in DEM, Granular Matter 12, 459-467, 2010; the ball is
 * found by shrinking (Ma, Bae, Choi, The Visual Computer 28, 7-19, 2012). Their starting points are
 * taken at random; ours are an even sequence, and a sphere comes with its images under the symmetry
 * of the target.
 *
 * Choice. Greedy: the orbit that lowers the sum of squared distances from the surface to the clump
 * most, per sphere. What remains after n spheres is at most 1/e above the best that n spheres of
 * the candidates could take away (Nemhauser, Wolsey, Fisher 1978; the sum is submodular), and
 * levels of detail are nested.
 *
 * The sum is taken over some 1500 places of the surface, which pass corners by. Where a largest
 * deviation is asked for and these have it, the places beyond it are found by branch and bound, and
 * filled with the same choice among these candidates and new ones beside those places, until there
 * are none. All other fillings do without. */
#ifndef CLAST_SHAPES_FILL_H
#define CLAST_SHAPES_FILL_H

#include "shapes/target.h"

enum { SHAPE_SPHERES_MAX = 1000 };

/* Sub-shape packing density q (S12 2.4.2 names it and leaves open what it is). Here: the clump is
 * as near to its target, on average over the surface, as a row of equal spheres with q centres to a
 * diameter is to the cylinder around it, where the radius is that of the largest sphere inside the
 * target. For such a row it is the sphere density of A00 2.2 and 3.7. */
double shape_density_deviation(double density); /* mean distance over the radius; density >= 1 */

/* When to stop: at the first that is met; 0 asks for nothing. At least one must be given. */
typedef struct shape_stops {
    int spheres;      /* no more than these; at most SHAPE_SPHERES_MAX */
    double density;   /* packing density is reached; >= 1 */
    double deviation; /* m, no place of the surface is farther from the clump (deviation.h); never
                         met below shape_deviation_least() */
    double smallest;  /* m, no sphere is smaller */
} shape_stops;

/* What was reached. */
typedef struct shape_filling {
    int count;
    double inscribed; /* m, radius of the largest sphere inside */
    double density;   /* the packing density reached; 0 below 1 */
    bool met; /* false: candidates or room ran out before `density` or `deviation` was met */
} shape_filling;

/* `spheres` has room for SHAPE_SPHERES_MAX. `level[i]`, when given, is the number of the orbit that
 * sphere i came with, so that any beginning that ends with an orbit is a level of detail. */
shape_filling shape_fill(const shape_target *target, const shape_stops *stops,
                         shape_sphere *spheres, int *level);

/* Spheres on the axis of a profile by A00 2.2.2: so many, or as many as the stops ask for. */
shape_filling shape_fill_row(const shape_target *target, const shape_stops *stops,
                             shape_sphere *spheres);

#endif

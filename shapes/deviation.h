/* deviation.h - the largest distance from the surface of a target to a clump: what is printed, and
 * what a filling is held to.
 *
 * Found by branch and bound over the triangles of the surface and their quarters. The distance from
 * one sphere is convex, so over a triangle it is largest at a corner, and no place of the triangle
 * is farther from the clump than the sphere with the nearest farthest corner says. On curved
 * surfaces corners are moved out to the surface, and the bound grows by as much as they moved: that
 * is proven for meshes and flat faces, and not for curved solids, where tests hold it. */
#ifndef CLAST_SHAPES_DEVIATION_H
#define CLAST_SHAPES_DEVIATION_H

#include "shapes/target.h"

/* Metres by which a place that was not looked at may be farther than a deviation that was found: a
 * thousandth of it and a hundred-thousandth of the target's size. */
double shape_deviation_error(const shape_target *target, double deviation);

/* The least deviation (m) that a clump can be held to: ten times what is left open of the size. */
double shape_deviation_least(const shape_target *target);

/* The largest deviation (m, >= 0) that was found; count >= 1. No place is farther than this by more
 * than shape_deviation_error(). */
double shape_deviation_max(const shape_target *target, const shape_sphere *spheres, int count);

/* Places farther than `limit` (m, > 0) from the clump, less shape_deviation_error(), `room` at
 * most and no two nearer to each other than `limit`; limit >= shape_deviation_least(). 0: no place
 * is farther than `limit`. */
int shape_places_beyond(const shape_target *target, const shape_sphere *spheres, int count,
                        double limit, shape_vec *place, int room);

#endif

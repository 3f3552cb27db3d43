/* rebound.h - what a pair of materials does in a single collision at the scene's own time step. */
#ifndef CLAST_SCENE_REBOUND_H
#define CLAST_SCENE_REBOUND_H

#include "experiments/scene/scene.h"

/* Drops nothing and measures: two equal spheres with the mass of the lightest body and the radius
 * of the largest element sphere meet head-on at the speed and the step of the plan. Returns the
 * rebound over impact speed, or a negative number when they do not part again (a step far too
 * large). */
double scene_rebound(const scene *s, const scene_pair *pair);

#endif

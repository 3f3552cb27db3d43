/* landing.h - where a shape can land, and how readily it gives way there. */
#ifndef CLAST_ENGINE_LANDING_H
#define CLAST_ENGINE_LANDING_H

#include "engine/world.h"

/* Unit normals of planes that it can land on flat, away from the plane; returns how many. */
enum { LANDING_SIDES = 54 };
int landing_sides(const clast_world *w, const shape *s, vec3 normals[LANDING_SIDES]);

#endif

/* clump.h - what a shape of a scene, or `clast shape`, is made from: solids, profiles and meshes
 * become targets of shapes/. Faults are reported with the file and line that they are in. */
#ifndef CLAST_SCENE_CLUMP_H
#define CLAST_SCENE_CLUMP_H

#include "experiments/scene/fault.h"
#include "shapes/clump.h"
#include "shapes/target.h"

/* A table with the heading x,radius (or radius,x): the outline of a body of revolution from left to
 * right, in `unit` metres. NULL after a report. */
shape_target *scene_profile_target(scene_faults *faults, const char *path, double unit);

/* A closed mesh in any format that meshes/ reads, in `unit` metres. NULL after a report. */
shape_target *scene_mesh_target(scene_faults *faults, const char *path, double unit);

#endif

/* target.h - what a clump stands for: a solid, a body with a profile, or a closed mesh, all asked
 * in the same way. */
#ifndef CLAST_SHAPES_TARGET_H
#define CLAST_SHAPES_TARGET_H

#include "shapes/mesh.h"
#include "shapes/profile.h"
#include "shapes/solid.h"

typedef enum shape_source { SHAPE_FROM_SOLID, SHAPE_FROM_PROFILE, SHAPE_FROM_MESH } shape_source;

typedef struct shape_target {
    shape_source source;
    shape_solid solid;
    shape_profile profile;
    shape_tree *tree;   /* of a mesh */
    shape_mesh surface; /* for drawing and sampling */
    shape_mass mass;    /* of the solid */
    double size;        /* m, diagonal of its box */
    double slack;       /* m, by which inscribed spheres may stick out: facets of a mesh are not
                           meant as corners */
} shape_target;

shape_target *shape_target_of_solid(const shape_solid *solid);
shape_target *shape_target_of_profile(double (*at)[2], int count);

/* Takes the mesh over, and turns it when it faces inwards. NULL, and the mesh is freed, when it has
 * no volume; *fault then says so. */
shape_target *shape_target_of_mesh(shape_mesh *mesh, const char **fault);
void shape_target_free(shape_target *target);

/* As shape_solid_distance(). */
double shape_target_distance(const shape_target *target, shape_vec p, shape_vec *nearest,
                             shape_vec *normal);

/* `count` points spread evenly over the surface, with its outward normals: the same ones on every
 * machine. */
void shape_target_samples(const shape_target *target, int count, shape_vec *point,
                          shape_vec *normal);

#endif

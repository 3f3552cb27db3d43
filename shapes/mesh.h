/* mesh.h - closed triangle meshes: mass, nearest point, and what is inside. */
#ifndef CLAST_SHAPES_MESH_H
#define CLAST_SHAPES_MESH_H

#include <stddef.h>
#include <stdint.h>

#include "shapes/mass.h"

/* Triangles run counter-clockwise seen from outside. The arrays are malloc'ed. */
typedef struct shape_mesh {
    size_t vertex_count;
    shape_vec *vertex; /* m */
    size_t triangle_count;
    int32_t *triangle; /* three vertex numbers each */
} shape_mesh;

/* Zeroed arrays of that size. */
shape_mesh shape_mesh_new(size_t vertices, size_t triangles);
shape_mesh shape_mesh_copy(const double *vertex, size_t vertices, const int32_t *triangle,
                           size_t triangles);
void shape_mesh_free(shape_mesh *mesh);

/* Inside out. */
void shape_mesh_turn(shape_mesh *mesh);

/* Volume with its sign (negative: triangles face inwards). */
double shape_mesh_volume(const shape_mesh *mesh);

/* Of a closed mesh with a volume above zero; exact to rounding. */
shape_mass shape_mesh_mass(const shape_mesh *mesh);

void shape_mesh_corners(const shape_mesh *mesh, size_t triangle, shape_vec corner[3]);

/* Point of a triangle nearest to p. */
shape_vec shape_triangle_nearest(const shape_vec corner[3], shape_vec p);

/* A tree over the triangles of a mesh, which must outlive it. */
typedef struct shape_tree shape_tree;

shape_tree *shape_tree_new(const shape_mesh *mesh);
void shape_tree_free(shape_tree *tree);

/* Distance to the surface (>= 0), the nearest point and its triangle. */
double shape_tree_nearest(const shape_tree *tree, shape_vec p, shape_vec *nearest,
                          size_t *triangle);

/* How often the surface winds about p: 1 inside, 0 outside, in between near a hole. Far groups of
 * triangles count as one dipole (Barill, Dickson, Schmidt, Levin, Jacobson, Fast winding numbers
 * for soups and clouds, ACM Transactions on Graphics 37, 2018), with an error below 0.1: half is
 * what decides. */
double shape_tree_winding(const shape_tree *tree, shape_vec p);

#endif

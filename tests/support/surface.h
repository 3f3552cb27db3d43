/* surface.h - surfaces of triangles for the engine's tests, and what a sphere feels of them. */
#ifndef CLAST_TESTS_SURFACE_H
#define CLAST_TESTS_SURFACE_H

#include "tests/support/scene.h"

enum { MOST_VERTICES = 20000, MOST_TRIANGLES = 20000 };

typedef struct surface {
    int vertices, triangles;
    clast_vec3 vertex[MOST_VERTICES];
    int32_t corner[3 * MOST_TRIANGLES];
} surface;

/* The one surface of a test program, empty: it is too large for a stack. */
surface *empty_surface(void);
int32_t add_vertex(surface *s, clast_vec3 p);
void add_face(surface *s, int32_t a, int32_t b, int32_t c);

/* A parallelogram in n x m cells of two triangles. Irregular with dice: inner vertices moved,
 * diagonals and windings at random. */
void add_sheet(surface *s, clast_vec3 from, clast_vec3 along, clast_vec3 across, int n, int m,
               dice *d);

/* Vertices that are equal to 1e-12 m become one, as a reader of STL does it. */
void weld(surface *s);

/* A box about the origin; n cells along every side of a face. */
surface *box_surface(clast_vec3 half, int n, dice *d);

/* A tube of n facets about the z axis, closed with two lids when asked for. */
surface *tube_surface(double radius, double half_height, int n, bool lids);

void turn_surface(surface *s, clast_quat q, clast_vec3 offset);

/* Adds it to a part; smooth_angle as in clast_mesh_def. Returns the number of patches. */
int mesh_with(clast_world *w, int group, int of, const surface *s, double smooth_angle);
int mesh_on(clast_world *w, int group, int of, const surface *s, clast_vec3 belt);

/* What a sphere at rest feels of all walls. */
typedef struct feeling {
    clast_vec3 push; /* m^1.5, sum of the normals by overlap^1.5 */
    double deepest;  /* m, overlap */
    int walls;
} feeling;
feeling feel(const clast_world *w, clast_vec3 centre, double radius);

/* A prepared world of one shape, for meshes that are only felt. */
clast_world *feeling_world(const surface *s, double smooth_angle, int *patches);

#endif

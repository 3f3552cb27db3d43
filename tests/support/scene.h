/* scene.h - builders of the small scenes that engine tests need. */
#ifndef CLAST_TESTS_SCENE_H
#define CLAST_TESTS_SCENE_H

#include "engine/clast.h"
#include "tests/support/check.h"

/* A world definition without gravity and with wide guards (overlap 0.5 of a radius). */
clast_world_def bare_def(clast_law law);

/* clast_world_new() that must succeed. */
clast_world *new_world(const clast_world_def *def);

/* Two materials that nobody would choose, and all pairs of them set alike. */
typedef struct two_materials {
    int soft, hard;
} two_materials;
two_materials add_materials(clast_world *w, const clast_pair_def *pair);

/* The pair that most tests use; the stiffness is for the linear law. */
clast_pair_def pair_of(double restitution, double friction);

/* Must succeed; returns the id. */
int add_body(clast_world *w, int shape, clast_vec3 position, clast_vec3 velocity, clast_vec3 spin);
int add_plane(clast_world *w, int part, int material, clast_vec3 point, clast_vec3 normal);

/* Steps that must succeed. */
void steps(clast_world *w, uint64_t count);
void run_to(clast_world *w, double time);

/* One body by its id. */
typedef struct body_state {
    bool present;
    clast_vec3 position, velocity, spin;
    clast_quat orientation;
    double mass;
    int shape;
} body_state;
body_state body_of(clast_world *w, int id);

/* Kinetic and rotational energy of all bodies. */
double motion_energy(clast_world *w);

size_t contact_count(clast_world *w);
double elastic_energy(clast_world *w);

/* Elements of clumps that do not overlap within themselves, any sizes between `small` and `large`,
 * placed about the centre of mass with principal axes: sphere, rod of two, triangle of three. */
int add_rod(clast_world *w, int material, double radius);
int add_triangle(clast_world *w, int material, double radius);
int add_uneven_rod(clast_world *w, int material, double radius);

clast_vec3 vec(double x, double y, double z);
clast_vec3 plus(clast_vec3 a, clast_vec3 b);
clast_vec3 minus(clast_vec3 a, clast_vec3 b);
clast_vec3 times(double s, clast_vec3 a);
double dot(clast_vec3 a, clast_vec3 b);
clast_vec3 cross(clast_vec3 a, clast_vec3 b);
double norm(clast_vec3 a);

/* A unit quaternion, uniform over rotations. */
clast_quat any_orientation(dice *d);

#endif

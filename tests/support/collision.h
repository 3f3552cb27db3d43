/* collision.h - one collision of two bodies, or of a body and a plane, in the running engine. */
#ifndef CLAST_TESTS_COLLISION_H
#define CLAST_TESTS_COLLISION_H

#include "tests/support/scene.h"

typedef struct collision {
    clast_law law;
    clast_tangent tangent;
    clast_unloading unloading;
    clast_friction_limit limit;
    clast_pair_def pair;
    bool against_plane;
    double radius_a, radius_b; /* m; a is soft, b is hard; 0 reads as 3.1 and 5.3 mm */
    double speed;              /* m/s, of the impact; 0 reads as 0.83 */
    double angle;              /* rad, from head-on */
    double spin;               /* rad/s of a, about the y axis */
    double resolution;         /* steps per contact */
    double phase;              /* of a step, where in it the contact begins; in [0, 1) */
} collision;

typedef struct rebound {
    bool touched;
    double restitution;        /* of the normal velocities */
    double energy_before,
        energy_after;          /* J, in the frame of the centre of mass (plane: of the world) */
    double duration;           /* s, counted in whole steps */
    double overlap_max;        /* m */
    double normal_impulse, tangential_impulse; /* N s, on a */
    clast_vec3 velocity, spin; /* of a, afterwards */
    double residual;           /* J */
    double effective_mass, effective_radius;
} rebound;

rebound collide(const collision *c);

/* Linear: pi sqrt(m/k); Walton-Braun: S12 2.52; Hertz: S12 2.41 with its constant worked out;
 * without dashpots. */
double contact_time(const collision *c);

/* N/m, of first loading, laws that are linear in the overlap: S12 2.29 at the impact speed of
 * bare_def(), S12 2.36, or that of the pair. */
double contact_stiffness(const collision *c);

/* Pa, of the two materials of the collision. */
double contact_modulus(void);

/* The first three have a history of the tangential spring and nothing besides. */
enum { LAW_COUNT = 7 };
extern const clast_law LAWS[LAW_COUNT];
extern const char *const LAW_NAMES[LAW_COUNT];

#endif

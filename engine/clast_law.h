/* clast_law.h - a contact law of your own, in a shared object that a world loads by name.
 *
 *     #include <math.h>
 *
 *     #include "engine/clast_law.h"
 *
 *     static void spring(const clast_law_pair *pair, const clast_law_touch *touch,
 *                        clast_law_history *history, clast_law_force *force) {
 *         (void)history;
 *         force->elastic = pair->parameter[0] * touch->overlap;
 *         force->normal = fmax(0, force->elastic + pair->parameter[1] * touch->rate);
 *         force->normal_energy = 0.5 * force->elastic * touch->overlap;
 *     }
 *     const clast_law_entry my_spring = {CLAST_LAW_VERSION, spring};
 *
 *     cc -shared -fPIC -I <folder of engine/> spring.c -o spring.so
 *
 *     def.law = CLAST_LAW_USER;
 *     clast_world_use_law(w, "./spring.so", "my_spring");
 *     clast_pair_set(w, glass, glass, &(clast_pair_def){.parameter = {2e4, 0.3}});
 *
 * The function is pure: what it returns depends on its arguments alone, and it keeps nothing; it is
 * called from several threads at once. It is exempt from the engine's promise of the same bits
 * everywhere: a shared object may have been compiled in any way.
 */
#ifndef CLAST_LAW_H
#define CLAST_LAW_H

#include <stdint.h>

#define CLAST_LAW_VERSION 1

enum { CLAST_LAW_PARAMETERS = 8 };

/* What does not change while two bodies touch. */
typedef struct clast_law_pair {
    const double *parameter;   /* CLAST_LAW_PARAMETERS numbers of clast_pair_def */
    double friction, cohesion; /* -, N: of clast_pair_def */
    double e_star, g_star;     /* Pa; 1/E* = sum (1 - nu^2)/E, 1/G* = sum (2 - nu)/G */
    double radius, mass;       /* m, kg; 1/R = 1/R_a + 1/R_b, likewise the mass; those of the sphere
                                  against a wall */
} clast_law_pair;

typedef struct clast_law_touch {
    double overlap; /* m, > 0 */
    double rate;    /* m/s, of the overlap: > 0 while the bodies close */
    double slip[3]; /* m/s, of a against b at the contact, in the tangent plane */
    double dt;      /* s, since the last call for this contact; 0: the force of the state as it is,
                       which must leave the history alone and give the same force again */
} clast_law_touch;

/* What a contact remembers; zero when it begins, and updated by the function. */
typedef struct clast_law_history {
    double spring[3]; /* a vector in the tangent plane. When the plane turns it is turned along at
                         its length, when a and b change places its sign changes */
    double memory;    /* a number that does not depend on who is a */
} clast_law_history;

/* Zero before every call. */
typedef struct clast_law_force {
    double normal;            /* N, repulsion > 0 */
    double elastic;           /* N, the part of it that has an energy; the rest is a dashpot's */
    double tangential[3];     /* N, on a, in the tangent plane */
    double normal_energy;     /* J, that the elastic part has stored */
    double tangential_energy; /* J, likewise of the spring */
} clast_law_force;

typedef void clast_law_function(const clast_law_pair *pair, const clast_law_touch *touch,
                                clast_law_history *history, clast_law_force *force);

/* What the shared object has under the name of the law. */
typedef struct clast_law_entry {
    uint32_t version; /* CLAST_LAW_VERSION */
    clast_law_function *force;
} clast_law_entry;

#endif

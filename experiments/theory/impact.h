/* impact.h - one head-on impact of two bodies, without a time stepping scheme: closed forms where
 * there are any, and a reference integration for every other law.
 *
 * Two spheres, or a sphere and a wall, are one body of the reduced mass m that meets a wall at
 * `speed` v. delta is the overlap, rate its derivative, > 0 while they close. A force is a
 * repulsion, > 0. Units are SI.
 *
 * S12: K. Samiei, PhD thesis, University of Luxembourg, 2012, section 2.6, with these errata: the
 * signs of 2.21 and 2.43, the branch of the arctangent in 2.25, and R in place of sqrt(R) in the
 * row of Hooke's law in Table 2.1.
 * A00: M. H. Abbaspour-Fard, PhD thesis, University of Newcastle upon Tyne, 2000. */
#ifndef CLAST_THEORY_IMPACT_H
#define CLAST_THEORY_IMPACT_H

#include <stdbool.h>

typedef struct impact_state {
    double overlap; /* m */
    double rate;    /* m/s */
} impact_state;

typedef struct impact {
    double overlap_max; /* m */
    double time_max;    /* s, from the first touch */
    double duration;    /* s, until the force ends */
    double overlap_end; /* m, left then */
    double rebound;     /* m/s, >= 0 */
} impact;

/* ---- linear spring-dashpot, S12 2.15 to 2.26 ------------------------------------------------- */

typedef struct linear_contact {
    double mass;      /* kg, reduced */
    double stiffness; /* N/m */
    double dashpot;   /* N s/m */
    bool cut_off;     /* the force ends where it would pull (2.23), not where the overlap ends */
} linear_contact;

/* speed > 0. Without the cut-off the dashpot must be below critical: the overlap never ends beyond.
 */
impact linear_impact(const linear_contact *c, double speed);

/* At t >= 0 s; after the end of the force, free flight. */
impact_state linear_impact_at(const linear_contact *c, double speed, double t);

/* Dashpot, in units of the critical one 2 sqrt(k m), whose rebound is e times the speed of impact;
 * 0 < e <= 1. With the cut-off it is solved for; without, it is S12 2.21 with its sign put right.
 */
double linear_damping_ratio(double restitution, bool cut_off);

/* Stiffness of the linear laws: Maw's, from the reduced radius, modulus and mass and the speed of
 * impact (S12 2.29); Hooke's (2.36). */
double maw_stiffness(double modulus, double radius, double mass, double speed);
double hooke_stiffness(double modulus, double radius);

/* ---- Hertz, S12 2.37 to 2.41 ----------------------------------------------------------------- */

double hertz_stiffness(double modulus, double radius); /* N/m^1.5: 4/3 E sqrt(R) */

/* Without damping: (5/4)^(2/5) = 1.093 in S12 2.40, and with it 3.218 in 2.41, where 3.21 stands.
 */
impact hertz_impact(double mass, double stiffness, double speed);

/* ---- Walton and Braun, S12 2.47 to 2.52 ------------------------------------------------------ */

typedef struct hysteretic_contact {
    double mass;               /* kg, reduced */
    double loading, unloading; /* N/m; unloading >= loading */
} hysteretic_contact;

impact hysteretic_impact(const hysteretic_contact *c, double speed);
impact_state hysteretic_impact_at(const hysteretic_contact *c, double speed, double t);

/* ---- any law: a reference integration -------------------------------------------------------- */

/* Repulsion at an overlap >= 0, before the cut-off. */
typedef double impact_law(const void *constants, double overlap, double rate);

/* k delta^(3/2) + c delta^(1/4) rate: Hertz-Mindlin (S12 2.42, Tsuji) and A00 1.20 to 1.22. */
typedef struct hertz_contact {
    double stiffness, dashpot;
} hertz_contact;
double hertz_force(const void *hertz, double overlap, double rate);

/* k (delta^(3/2) + A delta^(1/2) rate): Hertz-Brilliantov, S12 2.37. */
typedef struct viscous_contact {
    double stiffness;
    double dissipation; /* s, A */
} viscous_contact;
double viscous_force(const void *viscous, double overlap, double rate);

double linear_force(const void *linear, double overlap, double rate);

typedef struct impact_point {
    double time, overlap, rate;
} impact_point;

/* States at equal times from the first touch on, for drawing; the last is where the force ends. */
typedef struct impact_trace {
    impact_point *point; /* of the caller */
    int room, count;
    double every; /* s, > 0 */
} impact_trace;

/* Runge-Kutta of order eight with adaptive steps (relative 1e-13), turning point and end bisected.
 * `scale`: s, about the duration of the contact. The force ends where it would pull. trace may be
 * NULL. */
impact impact_integrate(impact_law *law, const void *constants, double mass, double speed,
                        double scale, impact_trace *trace);

/* Sets *parameter, one of the constants, so that the rebound is `restitution` times the speed;
 * 0.01 < restitution < 1. The rebound must fall from 1 as the parameter rises from 0; *parameter
 * holds a first guess > 0. */
void impact_solve(impact_law *law, const void *constants, double *parameter, double mass,
                  double speed, double scale, double restitution);

#endif

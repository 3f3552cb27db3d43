/* scheme.c - the table of schemes. Every scheme is a pair of rules, linear in what it remembers,
 * for the new position and the new velocity; the amplification matrices of the tests are made from
 * the same rows.
 *
 * Gear's third derivative is corrected with the whole difference of the accelerations (S12 2.78),
 * so after any step it is (a(n) - a(n-1)) / dt, and the scheme is the two-step one that stands
 * here. Position Verlet is written with the central velocity of S12 2.68; the forces feel the one
 * that is known when they are asked for, that of the step before. Newmark-beta with a constant mean
 * acceleration and the trapezoid rule are one scheme. */
#include "engine/world.h"

/* Velocities of S12 2.70. */
#define MEAN_KICK                                                                                  \
    { .v = {1}, .a = {0.5}, .a_next = 0.5 }

/* S12 3.25. Its velocity is the derivative of the parabola through the accelerations at three
 * times, of the order of the positions; S12 3.26 would be of first order. */
#define NUMEROV                                                                                    \
    .implicit = true, .past = 1, .order = 4,                                                       \
    .keep = {.x = {2, -1}, .a = {10.0 / 12, 1.0 / 12}, .a_next = 1.0 / 12},                        \
    .kept = {.x_next = 1, .x = {-1}, .a = {1.0 / 4, -1.0 / 24}, .a_next = 7.0 / 24},               \
    .splits = true, .turn = 0.5, .felt_kick = 1, .kept_kick = 0.5

static const clast_scheme_info SCHEMES[CLAST_SCHEMES] = {
    /* v is that of half a step before: then these are the equations of symplectic Euler */
    [CLAST_SCHEME_LEAPFROG] = {.name = "leapfrog",
                               .order = 2,
                               .order_damped = 1,
                               .predict = {.x = {1}, .v = {1}, .a = {1}},
                               .keep = {.x = {1}, .v = {1}, .a = {1}},
                               .felt = {.v = {1}, .a = {1}},
                               .kept = {.v = {1}, .a = {1}},
                               .turn = 1,
                               .felt_kick = 1},
    /* S12 2.56, 2.58 */
    [CLAST_SCHEME_SYMPLECTIC_EULER] = {.name = "symplectic-euler",
                                       .order = 1,
                                       .order_damped = 1,
                                       .predict = {.x = {1}, .v = {1}, .a = {1}},
                                       .keep = {.x = {1}, .v = {1}, .a = {1}},
                                       .felt = {.v = {1}, .a = {1}},
                                       .kept = {.v = {1}, .a = {1}},
                                       .turn = 1,
                                       .felt_kick = 1},
    /* S12 2.59, 2.60 */
    [CLAST_SCHEME_TAYLOR] = {.name = "taylor",
                             .order = 1,
                             .order_damped = 1,
                             .predict = {.x = {1}, .v = {1}, .a = {0.5}},
                             .keep = {.x = {1}, .v = {1}, .a = {0.5}},
                             .felt = {.v = {1}, .a = {1}},
                             .kept = {.v = {1}, .a = {1}},
                             .turn = 0.5,
                             .felt_kick = 1},
    /* S12 2.67, 2.68 */
    [CLAST_SCHEME_POSITION_VERLET] = {.name = "position-verlet",
                                      .order = 2,
                                      .order_damped = 1,
                                      .predict = {.x = {1}, .v = {1}, .a = {0.5}},
                                      .keep = {.x = {1}, .v = {1}, .a = {0.5}},
                                      .felt = {.v = {1}},
                                      .kept = MEAN_KICK,
                                      .turn = 0.5,
                                      .kept_kick = 0.5},
    /* S12 2.69 - 2.71 */
    [CLAST_SCHEME_VELOCITY_VERLET] = {.name = "velocity-verlet",
                                      .order = 2,
                                      .order_damped = 1,
                                      .predict = {.x = {1}, .v = {1}, .a = {0.5}},
                                      .keep = {.x = {1}, .v = {1}, .a = {0.5}},
                                      .felt = {.v = {1}, .a = {0.5}},
                                      .kept = MEAN_KICK,
                                      .turn = 0.5,
                                      .felt_kick = 0.5,
                                      .kept_kick = 0.5},
    /* S12 2.72 - 2.78 */
    [CLAST_SCHEME_GEAR4] =
        {.name = "gear4",
         .order = 3,
         .order_damped = 3,
         .past = 1,
         .predict = {.x = {1}, .v = {1}, .a = {2.0 / 3, -1.0 / 6}},
         .keep = {.x = {1}, .v = {1}, .a = {1.0 / 2, -1.0 / 12}, .a_next = 1.0 / 12},
         .felt = {.v = {1}, .a = {1.5, -0.5}},
         .kept = {.v = {1}, .a = {2.0 / 3, -1.0 / 12}, .a_next = 5.0 / 12},
         .turn = 0.5,
         .felt_kick = 1,
         .kept_kick = 0.5},
    /* S12 3.2, 3.3 */
    [CLAST_SCHEME_BACKWARD_EULER] = {.name = "backward-euler",
                                     .implicit = true,
                                     .order = 1,
                                     .order_damped = 1,
                                     .keep = {.x = {1}, .v = {1}, .a_next = 1},
                                     .felt = {.x_next = 1, .x = {-1}},
                                     .kept = {.x_next = 1, .x = {-1}},
                                     .turn = 0.5,
                                     .felt_kick = 1,
                                     .kept_kick = 0.5},
    /* S12 3.5, 3.6 */
    [CLAST_SCHEME_BEEMAN] = {.name = "beeman",
                             .implicit = true,
                             .order = 2,
                             .order_damped = 2,
                             .keep = {.x = {1}, .v = {1}, .a = {1.0 / 3}, .a_next = 1.0 / 6},
                             .felt = {.x_next = 3, .x = {-3}, .v = {-2}, .a = {-0.5}},
                             .kept = {.x_next = 3, .x = {-3}, .v = {-2}, .a = {-0.5}},
                             .turn = 0.5,
                             .felt_kick = 1,
                             .kept_kick = 0.5},
    /* S12 3.7, 3.8 */
    [CLAST_SCHEME_NEWMARK_BETA] = {.name = "newmark-beta",
                                   .implicit = true,
                                   .order = 2,
                                   .order_damped = 2,
                                   .keep = {.x = {1}, .v = {1}, .a = {0.25}, .a_next = 0.25},
                                   .felt = {.x_next = 2, .x = {-2}, .v = {-1}},
                                   .kept = {.x_next = 2, .x = {-2}, .v = {-1}},
                                   .turn = 0.5,
                                   .felt_kick = 1,
                                   .kept_kick = 0.5},
    /* S12 3.12, 3.13 */
    [CLAST_SCHEME_BDF2] = {.name = "bdf2",
                           .implicit = true,
                           .order = 2,
                           .order_damped = 2,
                           .past = 1,
                           .keep = {.x = {4.0 / 3, -1.0 / 3},
                                    .v = {8.0 / 9, -2.0 / 9},
                                    .a_next = 4.0 / 9},
                           .felt = {.x_next = 1.5, .x = {-2, 0.5}},
                           .kept = {.x_next = 1.5, .x = {-2, 0.5}},
                           .turn = 0.5,
                           .felt_kick = 1,
                           .kept_kick = 0.5},
    /* S12 3.17, 3.18 */
    [CLAST_SCHEME_BDF4] = {.name = "bdf4",
                           .implicit = true,
                           .order = 4,
                           .order_damped = 4,
                           .past = 3,
                           .keep = {.x = {48.0 / 25, -36.0 / 25, 16.0 / 25, -3.0 / 25},
                                    .v = {576.0 / 625, -432.0 / 625, 192.0 / 625, -36.0 / 625},
                                    .a_next = 144.0 / 625},
                           .felt = {.x_next = 25.0 / 12, .x = {-4, 3, -4.0 / 3, 1.0 / 4}},
                           .kept = {.x_next = 25.0 / 12, .x = {-4, 3, -4.0 / 3, 1.0 / 4}},
                           .turn = 0.5,
                           .felt_kick = 1,
                           .kept_kick = 0.5},
    /* S12 3.19, 3.20 */
    [CLAST_SCHEME_ADAMS_MOULTON] = {.name = "adams-moulton",
                                    .implicit = true,
                                    .order = 3,
                                    .order_damped = 3,
                                    .past = 1,
                                    .keep = {.x = {1},
                                             .v = {13.0 / 12, -1.0 / 12},
                                             .a = {5.0 / 18, -5.0 / 144},
                                             .a_next = 25.0 / 144},
                                    .felt = {.x_next = 2.4, .x = {-2.4}, .v = {-1.6, 0.2}},
                                    .kept = {.x_next = 2.4, .x = {-2.4}, .v = {-1.6, 0.2}},
                                    .turn = 0.5,
                                    .felt_kick = 1,
                                    .kept_kick = 0.5},
    /* S12 3.3.7 */
    [CLAST_SCHEME_TRAPEZOID] = {.name = "trapezoid",
                                .implicit = true,
                                .order = 2,
                                .order_damped = 2,
                                .keep = {.x = {1}, .v = {1}, .a = {0.25}, .a_next = 0.25},
                                .felt = {.x_next = 2, .x = {-2}, .v = {-1}},
                                .kept = {.x_next = 2, .x = {-2}, .v = {-1}},
                                .turn = 0.5,
                                .felt_kick = 1,
                                .kept_kick = 0.5},
    /* S12 3.29: the dashpots of a step are those of its start */
    [CLAST_SCHEME_NUMEROV_BACKWARD] = {.name = "numerov-backward",
                                       NUMEROV,
                                       .order_damped = 1,
                                       .felt = {.x_next = 1, .x = {-1}},
                                       .dashpot = 1},
    /* S12 3.30 */
    [CLAST_SCHEME_NUMEROV_FORWARD] = {.name = "numerov-forward",
                                      NUMEROV,
                                      .order_damped = 1,
                                      .felt = {.x_next = 1, .x = {-1}},
                                      .dashpot_next = 1},
    /* S12 3.31 */
    [CLAST_SCHEME_NUMEROV_CENTRAL] = {.name = "numerov-central",
                                      NUMEROV,
                                      .order_damped = 2,
                                      .felt = {.x_next = 0.5, .x = {0, -0.5}},
                                      .dashpot_next = 1},
};

const clast_scheme_info *clast_scheme_info_of(clast_scheme scheme) {
    CLAST_ASSERT((unsigned)scheme < CLAST_SCHEMES);
    return &SCHEMES[scheme];
}

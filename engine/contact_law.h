/* contact_law.h - the contact laws, one lane at a time: coefficients, touch and history in, force
 * out.
 *
 *   elastic   Hertz   F = 4/3 E* sqrt(R*) d^(3/2)              A00 1.1-1.4; k_n = 2 E* a is
 * A00 1.8-1.9 linear  F = k d                                  S12 2.15 dashpot   c_n = 2 beta
 * sqrt(k_n m*), c_t likewise          A00 1.21 with beta solved (restitution.c) no pull   F_n =
 * max(0, elastic + dashpot)                  S12 2.23 tangent   dS = -k_t v_t dt, k_t = 8 G* a
 * A00 1.14 (equal to S12 2.44) Coulomb   |S|, |S - c_t v_t| <= mu F_n + C A00 1.71-1.73
 *
 * Energy cannot be made: the spring is clipped before the dashpot is added (clipping the sum alone
 * can leave a spring longer than the limit), and it shrinks with its stiffness when the load falls.
 * Everything is arithmetic, sqrt and selects, so that the loop over lanes turns into vector code
 * with the bits of the scalar one.
 */
#ifndef CLAST_CONTACT_LAW_H
#define CLAST_CONTACT_LAW_H

#include "engine/world.h"

enum { LANES = 64 };

/* A call left in the loop over lanes would keep it scalar. */
#define LANE_INLINE __attribute__((always_inline)) static inline

/* Columns of one batch of contacts. */
typedef struct batch {
    int count;
    /* touch */
    double nx[LANES], ny[LANES], nz[LANES], overlap[LANES], radius[LANES], mass[LANES];
    double vx[LANES], vy[LANES], vz[LANES]; /* m/s, of a against b at the contact */
    /* coefficients of the pair of materials */
    double e_star[LANES], g_star[LANES], stiffness[LANES], tangential[LANES];
    double damping[LANES], friction[LANES], cohesion[LANES];
    /* history: in and out */
    double old_overlap[LANES], sx[LANES], sy[LANES], sz[LANES];
    double old_fx[LANES], old_fy[LANES], old_fz[LANES];
    /* out */
    double fx[LANES], fy[LANES], fz[LANES], work_elastic[LANES], work_dashpot[LANES];
} batch;

typedef struct law_choice {
    clast_law law;
    clast_unloading unloading;
    clast_friction_limit limit;
} law_choice;

/* Elastic state at one overlap. */
typedef struct elastic {
    double force, k_n, k_t;
} elastic;

LANE_INLINE elastic elastic_at(const batch *b, int i, double overlap, bool linear) {
    if (linear) {
        double on = overlap > 0 ? 1.0 : 0.0;
        return (elastic){b->stiffness[i] * overlap, on * b->stiffness[i], on * b->tangential[i]};
    }
    double a = sqrt(b->radius[i] * overlap);
    double k_n = 2 * b->e_star[i] * a;
    return (elastic){2.0 / 3.0 * k_n * overlap, k_n, 8 * b->g_star[i] * a};
}

/* What becomes of the tangential spring when the normal load has changed. */
LANE_INLINE double spring_factor(law_choice choice, double k_t, double old_k_t) {
    double ratio = old_k_t > 0 ? k_t / old_k_t : 0.0;
    if (choice.unloading == CLAST_UNLOAD_RESCALE) return ratio < 1 ? ratio : 1.0;
    if (choice.law == CLAST_LAW_HERTZ_MINDLIN) return ratio; /* the displacement is kept */
    return 1.0;                                              /* the force is kept, A00 1.14 */
}

LANE_INLINE double limited(double square, double limit) {
    return square > limit * limit ? limit / sqrt(square) : 1.0;
}

LANE_INLINE void contact_law(batch *b, int i, law_choice choice, double dt) {
    double nx = b->nx[i], ny = b->ny[i], nz = b->nz[i];
    double overlap = b->overlap[i] > 0 ? b->overlap[i] : 0.0;
    bool linear = choice.law == CLAST_LAW_LINEAR;
    elastic now = elastic_at(b, i, overlap, linear);
    elastic old = elastic_at(b, i, b->old_overlap[i], linear);

    double v_n = b->vx[i] * nx + b->vy[i] * ny + b->vz[i] * nz; /* > 0: moving apart */
    double tx = b->vx[i] - v_n * nx, ty = b->vy[i] - v_n * ny, tz = b->vz[i] - v_n * nz;
    double f_n = now.force - 2 * b->damping[i] * sqrt(now.k_n * b->mass[i]) * v_n;
    f_n = f_n > 0 ? f_n : 0.0;

    /* turn the spring into the tangent plane of now, at its length */
    double sx = b->sx[i], sy = b->sy[i], sz = b->sz[i];
    double length2 = sx * sx + sy * sy + sz * sz, along = sx * nx + sy * ny + sz * nz;
    sx -= along * nx, sy -= along * ny, sz -= along * nz;
    double flat2 = sx * sx + sy * sy + sz * sz;
    double keep = flat2 > 0 ? sqrt(length2 / flat2) : 0.0;
    keep *= spring_factor(choice, now.k_t, old.k_t);

    double k_dt = now.k_t * dt;
    sx = keep * sx - k_dt * tx, sy = keep * sy - k_dt * ty, sz = keep * sz - k_dt * tz;
    double load = choice.limit == CLAST_LIMIT_TOTAL ? f_n : now.force;
    double limit = overlap > 0 ? b->friction[i] * load + b->cohesion[i] : 0.0;
    double clip = limited(sx * sx + sy * sy + sz * sz, limit);
    sx *= clip, sy *= clip, sz *= clip;
    double c_t = 2 * b->damping[i] * sqrt(now.k_t * b->mass[i]);
    double fx = sx - c_t * tx, fy = sy - c_t * ty, fz = sz - c_t * tz;
    clip = limited(fx * fx + fy * fy + fz * fz, limit);
    fx = clip * fx + f_n * nx, fy = clip * fy + f_n * ny, fz = clip * fz + f_n * nz;

    /* Work of the normal force over the last step: mean of the forces at its ends times the change
     * of the overlap (ledger.c). Where a contact begins or ends there is a way, but not all of it
     * is overlap. */
    double old_f_n = b->old_fx[i] * nx + b->old_fy[i] * ny + b->old_fz[i] * nz;
    bool lasting = overlap > 0 && b->old_overlap[i] > 0;
    double way = lasting ? overlap - b->old_overlap[i] : -dt * v_n;
    b->work_elastic[i] = -0.5 * (old.force + now.force) * way;
    b->work_dashpot[i] = -0.5 * ((old_f_n - old.force) + (f_n - now.force)) * way;
    b->fx[i] = fx, b->fy[i] = fy, b->fz[i] = fz;
    b->sx[i] = sx, b->sy[i] = sy, b->sz[i] = sz;
    b->old_overlap[i] = overlap;
}

#endif

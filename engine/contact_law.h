/* contact_law.h - the contact laws, one lane at a time: touch and history in, force out.
 *
 *   elastic   Hertz   F = 4/3 E* a d, a = sqrt(R* d)             A00 1.1-1.4; k_n = 2 E* a 1.8-1.9
 *             linear  F = k d                                    S12 2.15; k: Maw 2.29, Hooke 2.36
 *             plastic F = k2 (d - p), p >= (1 - k1/k2) d grows   S12 2.47-2.50
 *   dashpot   c_n = 2 beta sqrt(k_n m*), c_t likewise            A00 1.21, beta by restitution.c
 *             c_n = 4/3 E* A a                                   S12 2.37
 *   no pull   F_n = max(0, elastic + dashpot)                    S12 2.23
 *   tangent   dS = -k_t v_t dt, k_t = 8 G* a                     A00 1.14 (equal to S12 2.44)
 *             or no spring                                       S12 2.28
 *   Coulomb   |S|, |S - c_t v_t| <= mu F_n + C                   A00 1.71-1.73
 *   rolling   M = -mu_r F_n R* w / |w|, w the relative spin      S12 2.53 with its erratum
 *
 * Energy cannot be made: the spring is clipped before the dashpot is added (clipping the sum alone
 * can leave a spring longer than the limit), and it shrinks with its stiffness when the load falls.
 * Everything is arithmetic, sqrt and selects, so that the loop over lanes turns into vector code
 * with the bits of the scalar one, and every expression changes its sign exactly when the two
 * bodies change places. What a scene does not need is a constant of law_need and vanishes.
 */
#ifndef CLAST_CONTACT_LAW_H
#define CLAST_CONTACT_LAW_H

#include "engine/lanes.h"
#include "engine/numbers.h"
#include "engine/world_data.h"

/* Precision of velocities, springs and forces; positions, overlaps and sums are always double. */
#ifdef CLAST_SINGLE
typedef float real;
#define REAL_SQRT sqrtf
#else
typedef double real;
#define REAL_SQRT sqrt
#endif

enum { LANES = 64 };

/* What the compiler knows of a scene. */
typedef struct law_need {
    bool linear;  /* else Hertz */
    bool tangent; /* else no friction and no cohesion: no spring, no torque */
    bool flat;    /* no third coordinate */
    bool clumps;  /* arms from the centres of mass */
    bool equal;   /* spheres of one radius and mass: wa is the sum of their spins, ta serves both */
} law_need;

/* What does not change within a pass. Choices are weights of 0 and 1: products and sums with them
 * are exact, and lanes cannot branch. */
typedef struct law_choice {
    real dt;             /* s */
    real again, advance; /* again: forces of this state once more, the spring stays */
    real rescale, keep_displacement, keep_force; /* clast_unloading */
    real limit_total, limit_elastic;             /* clast_friction_limit */
} law_choice;

/* Columns of one batch of contacts, kernel frame. a is the sphere of lower index. */
typedef struct batch {
    _Alignas(64) double d[3][LANES]; /* m, from centre b to centre a */
    double ra[LANES], rb[LANES];     /* m */
    double n[3][LANES];              /* unit, from b to a */
    double overlap[LANES];           /* m; <= 0: apart */
    real depth[LANES];               /* m, overlap or 0 */
    double la[LANES], lb[LANES];     /* m, from the centres to the contact point */
    real v[3][LANES];                /* m/s, of a against b, both taken at their centres of mass */
    real wa[3][LANES], wb[3][LANES]; /* rad/s */
    real oa[3][LANES], ob[3][LANES]; /* m, arms of the two spheres; clumps alone */
    real ma[LANES], mb[LANES];       /* kg */
    real radius[LANES], mass[LANES]; /* effective */
    real k_normal[LANES], k_tangent[LANES], c_normal[LANES], c_tangent[LANES]; /* pair_coef */
    real friction[LANES], cohesion[LANES];
    double per_small[LANES]; /* 1/m, of the smaller radius */
    real slip[3][LANES];     /* m/s, in the tangent plane at the contact point */
    real limit[LANES], k_dt[LANES], c_t[LANES], factor[LANES]; /* of the spring and its dashpot */
    real f[3][LANES];                                          /* N, on a */
    real ta[3][LANES], tb[3][LANES];     /* N m, on a and on b about their centres of mass */
    real elastic[LANES], dashpot[LANES]; /* J, work of the normal force over the last step */
    /* of laws that yield: pair_coef, then growth of the plastic overlap (m) and the part of it at
     * an onset, and the force before (N) */
    real yield[LANES], growth[LANES], onset[LANES], before[LANES];
    real rolling[LANES], hold[LANES]; /* pair_coef; N m s, couple over spin below its limit */
} batch;

/* History of the contacts of a batch, in place. */
typedef struct history_lanes {
    real *restrict overlap, *restrict normal, *restrict sx, *restrict sy, *restrict sz;
    real *restrict plastic; /* NULL but in laws that yield */
} history_lanes;

typedef struct three {
    real x, y, z;
} three;

LANE_INLINE real dot3(law_need need, three a, three b) {
    return need.flat ? a.x * b.x + a.y * b.y : a.x * b.x + a.y * b.y + a.z * b.z;
}

LANE_INLINE three add3(law_need need, three a, real s, three b) { /* a + s b */
    return (three){a.x + s * b.x, a.y + s * b.y, need.flat ? 0 : a.z + s * b.z};
}

LANE_INLINE three scale3(law_need need, real s, three a) {
    return (three){s * a.x, s * a.y, need.flat ? 0 : s * a.z};
}

/* Of two vectors in the plane: along its axis. */
LANE_INLINE three cross3(law_need need, three a, three b) {
    if (need.flat) return (three){0, 0, a.x * b.y - a.y * b.x};
    return (three){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/* A spin and a vector; in the plane the spin is along its axis. */
LANE_INLINE three swing3(law_need need, three w, three a) {
    if (need.flat) return (three){-w.z * a.y, w.z * a.x, 0};
    return cross3(need, w, a);
}

/* A macro, since C does not let columns of a const batch pass as const. */
#define COLUMN3(c, i) ((three){(c)[0][i], (c)[1][i], (c)[2][i]})

/* ---- geometry: two spheres ------------------------------------------------------------------- */

LANE_INLINE void touch_lane(batch *b, int i, law_need need) {
    double dx = b->d[0][i], dy = b->d[1][i], dz = need.flat ? 0 : b->d[2][i];
    double square = need.flat ? dx * dx + dy * dy : dx * dx + dy * dy + dz * dz;
    double distance = sqrt(square), inverse = 1 / distance;
    double overlap = (b->ra[i] + b->rb[i]) - distance;
    b->n[0][i] = inverse * dx, b->n[1][i] = inverse * dy, b->n[2][i] = inverse * dz;
    b->overlap[i] = overlap;
    b->depth[i] = (real)(overlap > 0 ? overlap : 0);
    b->la[i] = b->ra[i] - 0.5 * overlap, b->lb[i] = b->rb[i] - 0.5 * overlap;
}

/* Effective radius and mass of two spheres that are not like all others. */
LANE_INLINE void effective_lane(batch *b, int i) {
    double ra = b->ra[i], rb = b->rb[i];
    b->radius[i] = (real)(ra * rb / (ra + rb));
    b->mass[i] = b->ma[i] * b->mb[i] / (b->ma[i] + b->mb[i]);
    b->per_small[i] = 1 / (ra < rb ? ra : rb);
}

/* Stiffnesses of a pair, and the dashpots that go with their roots, become those of a contact. */
LANE_INLINE void scale_lane(batch *b, int i, double scale) {
    real k = (real)scale, c = (real)sqrt(scale);
    b->k_normal[i] *= k, b->k_tangent[i] *= k;
    b->c_normal[i] *= c, b->c_tangent[i] *= c;
}

/* law_scale() of S12 2.36 and 2.29. */
LANE_INLINE void hooke_lane(batch *b, int i) {
    scale_lane(b, i, (double)b->radius[i]);
}

LANE_INLINE void maw_lane(batch *b, int i) {
    double radius = (double)b->radius[i];
    scale_lane(b, i, number_fifth_root_lane(radius * radius * (double)b->mass[i]));
}

/* A dashpot per a instead of sqrt(a m): a in the place of m. */
LANE_INLINE void viscoelastic_lane(batch *b, int i) {
    b->mass[i] = REAL_SQRT(b->radius[i] * b->depth[i]);
}

/* ---- the law --------------------------------------------------------------------------------- */

/* Elastic state at one overlap. */
typedef struct elastic {
    real a;     /* m; linear: 1 while touching */
    real force; /* N */
} elastic;

LANE_INLINE elastic elastic_at(const batch *b, int i, real overlap, law_need need) {
    if (need.linear) return (elastic){overlap > 0 ? 1 : 0, b->k_normal[i] * overlap};
    real a = REAL_SQRT(b->radius[i] * overlap);
    return (elastic){a, (real)2 / 3 * (b->k_normal[i] * a) * overlap};
}

/* What becomes of the tangential spring when the normal load has changed. */
LANE_INLINE real spring_factor(law_choice c, real a, real old_a) {
    real ratio = old_a > 0 ? a / old_a : 0;
    real rescaled = ratio < 1 ? ratio : 1;
    return c.rescale * rescaled + c.keep_displacement * ratio + c.keep_force;
}

LANE_INLINE real limited(real square, real limit) {
    return square > limit * limit ? limit / REAL_SQRT(square) : 1;
}

/* Velocity of a against b at the contact point. */
LANE_INLINE three slip_of(const batch *b, int i, three n, law_need need) {
    three v = COLUMN3(b->v, i), wa = COLUMN3(b->wa, i), wb = COLUMN3(b->wb, i);
    real la = (real)b->la[i], lb = (real)b->lb[i];
    if (need.clumps) {
        three oa = COLUMN3(b->oa, i), ob = COLUMN3(b->ob, i);
        three at_a = swing3(need, wa, add3(need, oa, -la, n));
        three at_b = swing3(need, wb, add3(need, ob, lb, n));
        return add3(need, v, 1, add3(need, at_a, -1, at_b));
    }
    three u = {0, 0, need.equal ? la * wa.z : la * wa.z + lb * wb.z};
    if (!need.flat) {
        u.x = need.equal ? la * wa.x : la * wa.x + lb * wb.x;
        u.y = need.equal ? la * wa.y : la * wa.y + lb * wb.y;
    }
    return add3(need, v, -1, swing3(need, u, n));
}

LANE_INLINE void store3(real (*to)[LANES], int i, three a) {
    to[0][i] = a.x, to[1][i] = a.y, to[2][i] = a.z;
}

/* Torques of the force f = normal and tangential: only the tangential part turns a sphere. */
LANE_INLINE void store_torques(batch *b, int i, three n, three f, three f_t, law_need need) {
    real la = (real)b->la[i], lb = (real)b->lb[i];
    if (need.clumps) {
        three on_a = add3(need, COLUMN3(b->oa, i), -la, n);
        three on_b = add3(need, COLUMN3(b->ob, i), lb, n);
        store3(b->ta, i, cross3(need, on_a, f));
        store3(b->tb, i, cross3(need, on_b, (three){-f.x, -f.y, -f.z}));
        return;
    }
    three m = cross3(need, n, f_t);
    store3(b->ta, i, (three){-la * m.x, -la * m.y, -la * m.z});
    if (!need.equal) store3(b->tb, i, (three){-lb * m.x, -lb * m.y, -lb * m.z});
}

/* Work of the normal force over the last step: mean of the forces at its ends times the change of
 * the overlap (ledger.c). Where a contact begins or ends there is a way, but not all of it is
 * overlap. */
LANE_INLINE void book_work(batch *b, int i, elastic now, elastic old, real f_n, real old_f_n,
                           real way) {
    b->elastic[i] = (real)-0.5 * (old.force + now.force) * way;
    b->dashpot[i] = (real)-0.5 * ((old_f_n - old.force) + (f_n - now.force)) * way;
}

/* The law in three loops over the lanes: in one, every lane would wait for a chain of a dozen roots
 * and divisions, and a processor looks ahead over one or two groups of lanes only. */
LANE_INLINE void law_normal(batch *b, history_lanes h, int i, law_choice c, law_need need) {
    three n = {(real)b->n[0][i], (real)b->n[1][i], (real)b->n[2][i]};
    real overlap = b->depth[i], old_overlap = h.overlap[i];
    elastic now = elastic_at(b, i, overlap, need), old = elastic_at(b, i, old_overlap, need);
    three slip = slip_of(b, i, n, need);
    real v_n = dot3(need, slip, n); /* > 0: moving apart */
    real root = REAL_SQRT(now.a * b->mass[i]);
    real f_n = now.force - b->c_normal[i] * root * v_n;
    f_n = f_n > 0 ? f_n : 0;
    bool lasting = (overlap > 0) & (old_overlap > 0); /* a branch would keep lanes scalar */
    real way = lasting ? overlap - old_overlap : -c.dt * v_n;
    book_work(b, i, now, old, f_n, h.normal[i], way);
    h.overlap[i] = overlap;
    h.normal[i] = f_n;
    if (!need.tangent) return;
    real load = c.limit_total * f_n + c.limit_elastic * now.force, touching = overlap > 0 ? 1 : 0;
    b->limit[i] = touching * (b->friction[i] * load + b->cohesion[i]);
    b->k_dt[i] = b->k_tangent[i] * now.a * c.dt;
    b->c_t[i] = b->c_tangent[i] * root;
    b->factor[i] = spring_factor(c, now.a, old.a);
    store3(b->slip, i, add3(need, slip, -v_n, n));
}

/* The spring turned into the tangent plane of now at its length, loaded and clipped. */
LANE_INLINE void law_spring(batch *b, history_lanes h, int i, law_choice c, law_need need) {
    three n = {(real)b->n[0][i], (real)b->n[1][i], (real)b->n[2][i]};
    three s = {h.sx[i], h.sy[i], need.flat ? 0 : h.sz[i]};
    real length2 = dot3(need, s, s), along = c.advance * dot3(need, s, n);
    s = add3(need, s, -along, n);
    real flat2 = dot3(need, s, s);
    real keep = flat2 > 0 ? REAL_SQRT(length2 / flat2) : 0;
    keep = c.advance * (keep * b->factor[i]) + c.again;
    s = add3(need, scale3(need, keep, s), -b->k_dt[i], COLUMN3(b->slip, i));
    real clip = limited(dot3(need, s, s), b->limit[i]);
    s = scale3(need, c.advance * clip + c.again, s);
    h.sx[i] = s.x, h.sy[i] = s.y;
    if (!need.flat) h.sz[i] = s.z;
}

LANE_INLINE void law_force(batch *b, history_lanes h, int i, law_need need) {
    three n = {(real)b->n[0][i], (real)b->n[1][i], (real)b->n[2][i]}, f_t = {0, 0, 0};
    if (need.tangent) {
        three s = {h.sx[i], h.sy[i], need.flat ? 0 : h.sz[i]};
        f_t = add3(need, s, -b->c_t[i], COLUMN3(b->slip, i));
        f_t = scale3(need, limited(dot3(need, f_t, f_t), b->limit[i]), f_t);
    }
    three f = add3(need, f_t, h.normal[i], n);
    store3(b->f, i, f);
    store_torques(b, i, n, f, f_t, need);
}

/* ---- around the law: worlds that do not ask for it do not come here -------------------------- */

/* Plastic overlap, S12 2.47-2.50: F = k2 (d - p) where p, the overlap at which unloading ends, is
 * at least (1 - k1/k2) d. That is k1 d wherever d is the largest so far, and k2 on the way back and
 * forth below. (2.47 as printed goes back to k1 d whenever the spheres approach: a jump, which
 * makes energy.) The linear law sees d - p in the place of d; p lasts as long as the spheres
 * touch. */
LANE_INLINE void yield_before(batch *b, history_lanes h, int i) {
    real overlap = b->depth[i], old = h.plastic[i], old_rest = h.overlap[i] - old;
    real grown = b->yield[i] * overlap;
    real plastic = overlap > 0 ? (grown > old ? grown : old) : 0, rest = overlap - plastic;
    b->growth[i] = overlap > 0 ? plastic - old : 0;
    b->onset[i] = old_rest > 0 ? 0 : b->growth[i];
    b->before[i] = h.normal[i];
    b->depth[i] = rest > 0 ? rest : 0;
    h.overlap[i] = old_rest > 0 ? old_rest : 0;
    h.plastic[i] = plastic;
}

/* The law has booked the way of d - p (at an onset, that of d): the way of p is lost. */
LANE_INLINE void yield_after(batch *b, history_lanes h, int i) {
    double overlap = b->overlap[i];
    real mean = (real)0.5 * (b->before[i] + h.normal[i]);
    b->elastic[i] += mean * b->onset[i];
    b->dashpot[i] = -mean * b->growth[i];
    h.overlap[i] = (real)(overlap > 0 ? overlap : 0);
}

/* Rolling friction: a couple against the relative spin, equal and opposite on the two. Up to a spin
 * of mu_r F_n R* / hold it grows with the spin, and never so much that it would turn round within a
 * step (law.c): what does not spin is not driven, and what spins comes to rest and makes no energy.
 */
LANE_INLINE void rolling_lane(batch *b, history_lanes h, int i, law_need need) {
    three w = {0, 0, need.equal ? b->wa[2][i] : b->wa[2][i] - b->wb[2][i]};
    if (!need.flat) {
        w.x = need.equal ? b->wa[0][i] : b->wa[0][i] - b->wb[0][i];
        w.y = need.equal ? b->wa[1][i] : b->wa[1][i] - b->wb[1][i];
    }
    real size = REAL_SQRT(w.x * w.x + w.y * w.y + w.z * w.z);
    real most = b->rolling[i] * h.normal[i] * b->radius[i], hold = b->hold[i];
    real couple = size * hold > most ? most / size : hold;
    couple = h.normal[i] > 0 ? couple : 0;
    for (int k = need.flat ? 2 : 0; k < 3; k++) {
        real m = couple * (k == 0 ? w.x : k == 1 ? w.y : w.z);
        b->ta[k][i] -= m;
        if (!need.equal) b->tb[k][i] += m;
    }
}

#endif

/* body_lanes.h - kick and rotation of one body, one lane at a time: leapfrog, second order.
 *
 *     v(n+1/2) = v(n-1/2) + a(n) dt        x(n+1) = x(n) + v(n+1/2) dt
 *
 * Rotation keeps the angular momentum L in the world frame (exactly constant without torque) and
 * turns the body by the symmetric splitting of Dullweber, Leimkuhler and McLachlan (J. Chem. Phys.
 * 107, 1997, 5840): rotations about the principal axes x, y, z, y, x. Bodies with three equal
 * moments and bodies in a plane need one rotation only. Kernel frame: in a plane the third axis is
 * that of the plane. */
#ifndef CLAST_BODY_LANES_H
#define CLAST_BODY_LANES_H

#include "engine/numbers.h"
#include "engine/vec.h"

typedef enum turning {
    TURN_IN_PLANE, /* motion in a plane: spin about the third axis alone */
    TURN_ROUND,    /* three equal moments */
    TURN_ANY
} turning;

/* What is the same for all bodies in a pass. */
typedef struct body_choice {
    double dt;      /* s */
    double damping; /* f dt / 2 of A00 1.82-1.83 */
    vec3 gravity;   /* m/s2 */
} body_choice;

typedef struct moving {
    vec3 v, l; /* m/s, J s, at the half step */
    quat q;
} moving;

typedef struct kick {
    vec3 velocity, momentum; /* after */
    double global_loss;      /* J */
    double contact_work;     /* J, of the contact forces in this kick: exact */
} kick;

CLAST_INLINE static inline vec3 spin_of(turning turn, quat q, vec3 l, vec3 inverse_inertia) {
    if (turn == TURN_IN_PLANE) return v3(0, 0, inverse_inertia.z * l.z);
    if (turn == TURN_ROUND) return v3_mul(inverse_inertia, l);
    mat3 r = q_matrix(q);
    return m3_apply(&r, v3_mul(inverse_inertia, m3_apply_transposed(&r, l)));
}

/* A00 1.82-1.83 with the errata of FACTS 1; damping = 0 gives the plain kick. */
CLAST_INLINE static inline kick kicked(turning turn, body_choice c, moving m, vec3 force,
                                       vec3 torque, double mass, double inverse_mass,
                                       vec3 inverse_inertia) {
    vec3 a = v3_add(v3_scale(inverse_mass, force), c.gravity);
    if (turn == TURN_IN_PLANE) a.z = force.z = torque.x = torque.y = 0;
    double f = c.damping, g = 1 / (1 + f);
    kick k;
    k.velocity = v3_scale(g, v3_add(v3_scale(1 - f, m.v), v3_scale(c.dt, a)));
    k.momentum = v3_scale(g, v3_add(v3_scale(1 - f, m.l), v3_scale(c.dt, torque)));
    vec3 middle = v3_scale(0.5, v3_add(m.v, k.velocity));
    vec3 turned = v3_scale(0.5, v3_add(m.l, k.momentum));
    vec3 spin = spin_of(turn, m.q, turned, inverse_inertia);
    k.contact_work = c.dt * (v3_dot(force, middle) + v3_dot(torque, spin));
    k.global_loss = 2 * f * (mass * v3_dot(middle, middle) + v3_dot(turned, spin));
    return k;
}

/* ---- rotation -------------------------------------------------------------------------------- */

CLAST_INLINE static inline quat turned_round(quat q, vec3 axis_angle) {
    double angle = v3_norm(axis_angle), s, c;
    number_sincos_small(0.5 * angle, &s, &c);
    double k = angle == 0 ? 0 : s / angle;
    quat t = q_mul((quat){c, k * axis_angle.x, k * axis_angle.y, k * axis_angle.z}, q);
    t = q_renormalise(t);
    bool still = angle == 0;
    return (quat){still ? q.w : t.w, still ? q.x : t.x, still ? q.y : t.y, still ? q.z : t.z};
}

CLAST_INLINE static inline quat turned_in_plane(quat q, double angle) {
    double s, c;
    number_sincos_small(0.5 * angle, &s, &c);
    double w = c * q.w - s * q.z, z = c * q.z + s * q.w;
    double unit = 1.5 - 0.5 * (w * w + z * z);
    return (quat){unit * w, 0, 0, unit * z};
}

/* Rotates the body by `angle` about its own principal axis; its local momentum turns the other way.
 */
CLAST_INLINE static inline void turn_about(int axis, double angle, quat *q, vec3 *local) {
    double s, c;
    number_sincos_small(0.5 * angle, &s, &c);
    *q = q_mul(*q, (quat){c, axis == 0 ? s : 0, axis == 1 ? s : 0, axis == 2 ? s : 0});
    double cs = c * c - s * s, sn = 2 * s * c;
    vec3 l = *local;
    if (axis == 0)
        *local = v3(l.x, cs * l.y + sn * l.z, cs * l.z - sn * l.y);
    else if (axis == 1)
        *local = v3(cs * l.x - sn * l.z, l.y, cs * l.z + sn * l.x);
    else
        *local = v3(cs * l.x + sn * l.y, cs * l.y - sn * l.x, l.z);
}

CLAST_INLINE static inline quat turned_any(quat q, vec3 momentum, vec3 inverse, double dt) {
    mat3 r = q_matrix(q);
    vec3 l = m3_apply_transposed(&r, momentum);
    turn_about(0, 0.5 * dt * (l.x * inverse.x), &q, &l);
    turn_about(1, 0.5 * dt * (l.y * inverse.y), &q, &l);
    turn_about(2, dt * (l.z * inverse.z), &q, &l);
    turn_about(1, 0.5 * dt * (l.y * inverse.y), &q, &l);
    turn_about(0, 0.5 * dt * (l.x * inverse.x), &q, &l);
    return q_renormalise(q);
}

CLAST_INLINE static inline quat turned_by(turning turn, quat q, vec3 momentum, vec3 inverse,
                                          double dt) {
    vec3 spin = spin_of(turn, q, momentum, inverse);
    if (turn == TURN_IN_PLANE) return turned_in_plane(q, dt * spin.z);
    if (turn == TURN_ROUND) return turned_round(q, v3_scale(dt, spin));
    return turned_any(q, momentum, inverse, dt);
}

#endif

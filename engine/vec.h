/* vec.h - small vectors and unit quaternions, inline: arithmetic and sqrt only, so the bits are the
 * same on every machine. */
#ifndef CLAST_VEC_H
#define CLAST_VEC_H

#include <math.h>

#include "engine/clast.h"

/* A call left in a loop over lanes would keep it scalar. */
#define CLAST_INLINE __attribute__((always_inline))

typedef clast_vec3 vec3;
typedef clast_quat quat;

CLAST_INLINE static inline vec3 v3(double x, double y, double z) {
    return (vec3){x, y, z};
}
CLAST_INLINE static inline vec3 v3_add(vec3 a, vec3 b) {
    return v3(a.x + b.x, a.y + b.y, a.z + b.z);
}
CLAST_INLINE static inline vec3 v3_sub(vec3 a, vec3 b) {
    return v3(a.x - b.x, a.y - b.y, a.z - b.z);
}
CLAST_INLINE static inline vec3 v3_scale(double s, vec3 a) {
    return v3(s * a.x, s * a.y, s * a.z);
}
CLAST_INLINE static inline double v3_dot(vec3 a, vec3 b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
CLAST_INLINE static inline double v3_norm(vec3 a) {
    return sqrt(v3_dot(a, a));
}
CLAST_INLINE static inline vec3 v3_mul(vec3 a, vec3 b) {
    return v3(a.x * b.x, a.y * b.y, a.z * b.z);
}

CLAST_INLINE static inline vec3 v3_cross(vec3 a, vec3 b) {
    return v3(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

CLAST_INLINE static inline double v3_at(vec3 a, int axis) {
    return axis == 0 ? a.x : axis == 1 ? a.y : a.z;
}

CLAST_INLINE static inline vec3 v3_axis(int axis, double length) {
    return v3(axis == 0 ? length : 0, axis == 1 ? length : 0, axis == 2 ? length : 0);
}

CLAST_INLINE static inline quat q_mul(quat a, quat b) {
    return (quat){a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z,
                  a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
                  a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x,
                  a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}

/* One Newton step towards unit length: exact to rounding for the drift of one time step. */
CLAST_INLINE static inline quat q_renormalise(quat q) {
    double s = 1.5 - 0.5 * (q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (quat){s * q.w, s * q.x, s * q.y, s * q.z};
}

CLAST_INLINE static inline quat q_unit(quat q) {
    double n = sqrt(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z);
    return (quat){q.w / n, q.x / n, q.y / n, q.z / n};
}

typedef struct mat3 {
    vec3 row[3];
} mat3;

/* Body frame to world frame. */
CLAST_INLINE static inline mat3 q_matrix(quat q) {
    double xx = q.x * q.x, yy = q.y * q.y, zz = q.z * q.z;
    double xy = q.x * q.y, xz = q.x * q.z, yz = q.y * q.z;
    double wx = q.w * q.x, wy = q.w * q.y, wz = q.w * q.z;
    return (mat3){{{1 - 2 * (yy + zz), 2 * (xy - wz), 2 * (xz + wy)},
                   {2 * (xy + wz), 1 - 2 * (xx + zz), 2 * (yz - wx)},
                   {2 * (xz - wy), 2 * (yz + wx), 1 - 2 * (xx + yy)}}};
}

CLAST_INLINE static inline vec3 m3_apply(const mat3 *m, vec3 a) {
    return v3(v3_dot(m->row[0], a), v3_dot(m->row[1], a), v3_dot(m->row[2], a));
}

CLAST_INLINE static inline vec3 m3_apply_transposed(const mat3 *m, vec3 a) {
    return v3(m->row[0].x * a.x + m->row[1].x * a.y + m->row[2].x * a.z,
              m->row[0].y * a.x + m->row[1].y * a.y + m->row[2].y * a.z,
              m->row[0].z * a.x + m->row[1].z * a.y + m->row[2].z * a.z);
}

#endif

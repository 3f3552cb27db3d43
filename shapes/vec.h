/* vec.h - points and directions, and the sphere that clumps are made of. */
#ifndef CLAST_SHAPES_VEC_H
#define CLAST_SHAPES_VEC_H

#include <math.h>

typedef struct shape_vec {
    double x, y, z; /* m, or a direction */
} shape_vec;

typedef struct shape_sphere {
    shape_vec centre; /* m */
    double radius;    /* m, > 0 */
} shape_sphere;

static inline shape_vec sv(double x, double y, double z) {
    return (shape_vec){x, y, z};
}

static inline shape_vec sv_add(shape_vec a, shape_vec b) {
    return sv(a.x + b.x, a.y + b.y, a.z + b.z);
}

static inline shape_vec sv_sub(shape_vec a, shape_vec b) {
    return sv(a.x - b.x, a.y - b.y, a.z - b.z);
}

static inline shape_vec sv_scale(double s, shape_vec a) {
    return sv(s * a.x, s * a.y, s * a.z);
}

/* a + s b */
static inline shape_vec sv_along(shape_vec a, double s, shape_vec b) {
    return sv(a.x + s * b.x, a.y + s * b.y, a.z + s * b.z);
}

static inline double sv_dot(shape_vec a, shape_vec b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static inline shape_vec sv_cross(shape_vec a, shape_vec b) {
    return sv(a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x);
}

static inline double sv_norm(shape_vec a) {
    return sqrt(sv_dot(a, a));
}

static inline double sv_distance(shape_vec a, shape_vec b) {
    return sv_norm(sv_sub(a, b));
}

/* Of a vector that is not zero. */
static inline shape_vec sv_unit(shape_vec a) {
    return sv_scale(1 / sv_norm(a), a);
}

/* Two directions that make a right-handed frame with the unit vector u: u = first x second. */
static inline void sv_frame(shape_vec u, shape_vec *first, shape_vec *second) {
    double x = fabs(u.x), y = fabs(u.y), z = fabs(u.z);
    shape_vec other = x <= y && x <= z ? sv(1, 0, 0) : y <= z ? sv(0, 1, 0) : sv(0, 0, 1);
    *first = sv_unit(sv_cross(other, u));
    *second = sv_cross(u, *first);
}

#endif

/* rows.h - the rows that the contact pass reads, from the columns of one body. Kernel frame. */
#ifndef CLAST_ROWS_H
#define CLAST_ROWS_H

#include "engine/world_data.h"

/* Columns of the bodies by the axes of the kernel frame. */
typedef struct kernel_columns {
    double *x[3], *q[3], *v[3], *l[3], *qw; /* q: vector part of the orientation */
} kernel_columns;

static inline kernel_columns columns_of(const clast_world *w) {
    const body_store *b = &w->bodies;
    double *x[3] = {b->x, b->y, b->z}, *q[3] = {b->qx, b->qy, b->qz};
    double *v[3] = {b->vx, b->vy, b->vz}, *l[3] = {b->lx, b->ly, b->lz};
    kernel_columns c = {.qw = b->qw};
    for (int k = 0; k < 3; k++) {
        c.x[k] = x[w->axes[k]], c.q[k] = q[w->axes[k]];
        c.v[k] = v[w->axes[k]], c.l[k] = l[w->axes[k]];
    }
    return c;
}

static inline void put_arm(arm_row *to, vec3 arm) {
    to->arm[0] = arm.x, to->arm[1] = arm.y, to->arm[2] = arm.z;
}

/* R I^-1 R^T */
static inline void put_inertia(inertia_row *to, const mat3 *r, vec3 inverse) {
    vec3 x = v3_mul(inverse, r->row[0]), y = v3_mul(inverse, r->row[1]);
    vec3 z = v3_mul(inverse, r->row[2]);
    to->xx = v3_dot(x, r->row[0]), to->yy = v3_dot(y, r->row[1]), to->zz = v3_dot(z, r->row[2]);
    to->yz = v3_dot(y, r->row[2]), to->zx = v3_dot(z, r->row[0]), to->xy = v3_dot(x, r->row[1]);
}

static inline void place_in_plane(const clast_world *w, const kernel_columns *c, size_t i) {
    const shape *s = &w->shapes[w->bodies.shape[i]];
    double qw = c->qw[i], qa = c->q[2][i];
    double cosine = 1 - 2 * (qa * qa), sine = 2 * (qw * qa);
    size_t e = w->rows.first[i];
    for (int k = 0; k < s->spheres; k++, e++) {
        vec3 o = to_kernel(w, s->centre[k]);
        vec3 arm = v3(cosine * o.x - sine * o.y, sine * o.x + cosine * o.y, o.z);
        centre_row *to = &w->rows.centre[e];
        put_arm(&w->rows.arm[e], arm);
        to->x = c->x[0][i] + arm.x, to->y = c->x[1][i] + arm.y, to->z = c->x[2][i] + arm.z;
    }
}

static inline void place_in_space(const clast_world *w, const kernel_columns *c, size_t i) {
    const shape *s = &w->shapes[w->bodies.shape[i]];
    mat3 r = q_matrix((quat){c->qw[i], c->q[0][i], c->q[1][i], c->q[2][i]});
    if (w->special.shared) put_inertia(&w->rows.inertia[i], &r, s->inverse_inertia);
    size_t e = w->rows.first[i];
    for (int k = 0; k < s->spheres; k++, e++) {
        vec3 arm = m3_apply(&r, s->centre[k]);
        centre_row *to = &w->rows.centre[e];
        put_arm(&w->rows.arm[e], arm);
        to->x = c->x[0][i] + arm.x, to->y = c->x[1][i] + arm.y, to->z = c->x[2][i] + arm.z;
    }
}

/* Centres (and arms) of the spheres of bodies begin .. end - 1. */
static inline void place_spheres(const clast_world *w, const kernel_columns *c, size_t begin,
                                 size_t end) {
    if (!w->special.clumps) {
        for (size_t i = begin; i < end; i++) {
            centre_row *to = &w->rows.centre[i];
            to->x = c->x[0][i], to->y = c->x[1][i], to->z = c->x[2][i];
        }
    } else if (w->def.motion == CLAST_MOTION_IN_PLANE) {
        for (size_t i = begin; i < end; i++) place_in_plane(w, c, i);
    } else {
        for (size_t i = begin; i < end; i++) place_in_space(w, c, i);
    }
}

#endif

/* constant_lanes.h - columns of a batch that are the same for all of its contacts. */
#ifndef CLAST_CONSTANT_LANES_H
#define CLAST_CONSTANT_LANES_H

#include "engine/contact_law.h"

static inline void fill_coefficients(batch *b, int i, const pair_coef *c) {
    b->k_normal[i] = (real)c->k_normal, b->k_tangent[i] = (real)c->k_tangent;
    b->c_normal[i] = (real)c->c_normal, b->c_tangent[i] = (real)c->c_tangent;
    b->friction[i] = (real)c->friction, b->cohesion[i] = (real)c->cohesion;
}

/* From the stiffness of a pair to that of each contact. */
static inline void scale_stiffness(batch *b, clast_law law, int count) {
    if (law == CLAST_LAW_HOOKE) {
#pragma omp simd
        for (int i = 0; i < count; i++) hooke_lane(b, i);
    }
    if (law == CLAST_LAW_MAW) {
#pragma omp simd
        for (int i = 0; i < count; i++) maw_lane(b, i);
    }
}

/* What a flat scene does not fill. */
static inline void clear_third(batch *b, int lanes) {
    for (int i = 0; i < lanes; i++) b->n[2][i] = 0, b->v[2][i] = b->f[2][i] = 0;
}

/* Spin and arm of a wall. */
static inline void clear_other(batch *b, int lanes) {
    for (int k = 0; k < 3; k++)
        for (int i = 0; i < lanes; i++) b->wb[k][i] = b->ob[k][i] = 0;
}

#endif

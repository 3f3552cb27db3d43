/* wall_lanes.h - where spheres meet walls, one lane at a time: planes, plates and patches that fill
 * a rectangle. A plane is a plate without end that has one side. What lanes cannot tell, whether
 * another wall that the sphere touches hides this one and where an uneven patch ends, they ask
 * facets.c for (`look`). Kernel frame. */
#ifndef CLAST_WALL_LANES_H
#define CLAST_WALL_LANES_H

#include "engine/contact_law.h"

/* Columns of one batch beside those of contact_law.h, where d is the way from the point of the wall
 * to the centre of the sphere. Behind each vector stands what does in its row. */
typedef struct wall_batch {
    _Alignas(64) double n[4][LANES]; /* and half side along u, m */
    double u[4][LANES];              /* and half side along v, m */
    double v[4][LANES];              /* and rim, m */
    double look[LANES];              /* 1: may have to be asked about */
} wall_batch;

LANE_INLINE double beyond(double x, double limit) {
    double inside = x > limit ? limit : x < -limit ? -limit : x;
    return x - inside;
}

/* A sphere with its centre on the surface is pushed along the normal. */
LANE_INLINE void wall_lane(batch *b, wall_batch *l, const real *restrict was, int i) {
    double x = b->d[0][i], y = b->d[1][i], z = b->d[2][i];
    double height = x * l->n[0][i] + y * l->n[1][i] + z * l->n[2][i];
    double s = x * l->u[0][i] + y * l->u[1][i] + z * l->u[2][i];
    double t = x * l->v[0][i] + y * l->v[1][i] + z * l->v[2][i];
    double half_u = l->n[3][i], half_v = l->u[3][i], rim = l->v[3][i];
    double way_s = beyond(s, half_u), way_t = beyond(t, half_v);
    double apart = sqrt(height * height + way_s * way_s + way_t * way_t);
    double per = apart > 0 ? 1 / apart : 0, up = apart > 0 ? height / apart : 1;
    double one = half_v >= WALL_ENDLESS ? 1 : 0, distance = one * height + (1 - one) * apart;
    up = one + (1 - one) * up, way_s *= per, way_t *= per;
    for (int k = 0; k < 3; k++)
        b->n[k][i] = up * l->n[k][i] + way_s * l->u[k][i] + way_t * l->v[k][i];
    double overlap = b->ra[i] - distance;
    int clear = (fabs(s) < half_u - rim) & (fabs(t) < half_v - rim);
    b->overlap[i] = overlap;
    int ended = (overlap <= 0) & (was[i] > 0) & (rim >= WALL_ENDLESS);
    int look = ((overlap > 0) & !clear) | ended;
    l->look[i] = look ? 1 : 0;
}

/* The overlap stands. */
LANE_INLINE void wall_overlap_lane(batch *b, int i) {
    double overlap = b->overlap[i];
    b->depth[i] = (real)(overlap > 0 ? overlap : 0);
    b->la[i] = b->ra[i] - 0.5 * overlap, b->lb[i] = 0;
}

#endif

/* shared_lanes.h - one dashpot for all spheres with which two bodies, or a body and a wall, touch
 * (clump_contact shared). A group is the contacts of one such pair. With the shares w_i = F_i / F
 * of the elastic force F = sum F_i, normals n_i, arms r_i and the mean direction of the force
 * J = sum w_i (n_i, r_i x n_i) on either body:
 *
 *     1 / m_eff = J M^-1 J^T      of both bodies, moments of inertia included
 *     c = 2 beta sqrt(k m_eff)    k = sum k_i, the stiffnesses
 *     c_i = w_i c                 on the velocity at contact i, tangential dashpot alike
 *
 * which is what the law makes of a contact with the mass
 *
 *     m_i = w_i^2 (k / k_i) m_eff
 *
 * in the place of the bodies' effective mass. So all that changes is a column of masses, and it is
 * a function of positions alone: the law, its history, its books and its schemes stay as they are.
 * The masses take the elastic forces of all contacts of a group, so batches end where bodies do;
 * a body with more contacts than a batch holds is looked at twice. Sums go in an order of names
 * (shared.c), so they have one value whatever the lists hold. */
#ifndef CLAST_SHARED_LANES_H
#define CLAST_SHARED_LANES_H

#include "engine/column_lanes.h"

/* Columns of one batch beside those of contact_law.h. */
typedef struct shared_batch {
    _Alignas(64) real force[LANES], stiffness[LANES]; /* N, N/m, elastic */
    real n[3][LANES];                                 /* of the group: sum w_i n_i */
    real ta[3][LANES], tb[3][LANES];                  /* m, sum w_i r_i x n_i on a and on b */
    real part[LANES];                                 /* w_i^2 k / k_i */
    real ia[6][LANES], ib[6][LANES]; /* 1/(kg m2), inverse moments as in inertia_row */
} shared_batch;

/* Where a pass over one list is. */
typedef struct sharing {
    bool on;
    const contact_groups *groups;
    size_t next;         /* group */
    size_t begin, end;   /* entries whose groups are whole */
    shared_batch *batch; /* of the entries from begin on */
    real whole_mass;     /* kg, effective, where it is the same for all contacts */
} sharing;

/* ---- batches --------------------------------------------------------------------------------- */

LANE_INLINE int64_t owner_of(const clast_world *w, const contact_list *l, size_t entry) {
    return w->rows.arm[l->a[entry]].body;
}

/* The last end of a body within a batch, or beyond it where one body fills more than that. */
static inline size_t block_end(const clast_world *w, const contact_list *l, size_t begin) {
    if (l->count - begin <= LANES) return l->count;
    size_t end = begin + LANES;
    int64_t body = owner_of(w, l, end);
    while (end > begin && owner_of(w, l, end - 1) == body) end--;
    if (end > begin) return end;
    end = begin + LANES;
    while (end < l->count && owner_of(w, l, end) == body) end++;
    return end;
}

/* ---- lanes ----------------------------------------------------------------------------------- */

LANE_INLINE void weigh_lane(const batch *b, shared_batch *g, int i, law_need need) {
    elastic now = elastic_at(b, i, b->depth[i], need);
    three n = {(real)b->n[0][i], (real)b->n[1][i], (real)b->n[2][i]};
    g->force[i] = now.force;
    g->stiffness[i] = b->k_normal[i] * now.a;
    g->part[i] = 1;
    store3(g->n, i, n);
    store3(g->ta, i, cross3(need, COLUMN3(b->oa, i), n));
    store3(g->tb, i, cross3(need, COLUMN3(b->ob, i), n));
}

/* t I^-1 t: 1/kg by which the group gives way in turning the body. */
LANE_INLINE real turn_per_force(real (*const in)[LANES], int i, three t, law_need need) {
    if (need.flat) return in[2][i] * (t.z * t.z);
    real diagonal = in[0][i] * (t.x * t.x) + in[1][i] * (t.y * t.y) + in[2][i] * (t.z * t.z);
    real across = in[3][i] * (t.y * t.z) + in[4][i] * (t.z * t.x) + in[5][i] * (t.x * t.y);
    return diagonal + 2 * across;
}

/* From the effective mass of the whole bodies to that of the law, and never above it: normals that
 * oppose each other (a ball between the teeth of a fork) would leave a mass without end. Two equal
 * spheres meet that bound where their normals lie 90 degrees apart. */
LANE_INLINE void shared_mass_lane(batch *b, shared_batch *g, int i, law_need need) {
    three n = COLUMN3(g->n, i);
    real turning = turn_per_force(g->ia, i, COLUMN3(g->ta, i), need) +
                   turn_per_force(g->ib, i, COLUMN3(g->tb, i), need);
    real whole = b->mass[i], shared = g->part[i] / (dot3(need, n, n) / whole + turning);
    b->mass[i] = shared < whole ? shared : whole;
}

/* ---- rows into columns ----------------------------------------------------------------------- */

LANE_INLINE const inertia_row *moments_of(const row_store *r, int32_t sphere) {
    return &r->inertia[r->arm[sphere].body];
}

LANE_INLINE void load_moments(real (*to)[LANES], const row_store *r, const int32_t *sphere,
                              int count, law_need need) {
    int i = 0;
#ifdef LANE_ROWS
    for (; i + 4 <= count && !need.flat; i += 4) {
        rows4 diagonal[4], across[4];
        for (int k = 0; k < 4; k++) {
            const inertia_row *row = moments_of(r, sphere[i + k]);
            diagonal[k] = row_at(&row->xx), across[k] = row_at(&row->yz);
        }
        put_vector(to, i, diagonal, need), put_vector(to + 3, i, across, need);
    }
#endif
    for (; i < count; i++) {
        const inertia_row *row = moments_of(r, sphere[i]);
        to[2][i] = (real)row->zz;
        if (need.flat) continue;
        to[0][i] = (real)row->xx, to[1][i] = (real)row->yy;
        to[3][i] = (real)row->yz, to[4][i] = (real)row->zx, to[5][i] = (real)row->xy;
    }
}

LANE_INLINE void clear_moments(real (*to)[LANES], int from, int end) {
    for (int k = 0; k < 6; k++)
        for (int i = from; i < end; i++) to[k][i] = 0;
}

/* ---- groups ---------------------------------------------------------------------------------- */

/* Sums over one group, at every contact of it. One that touches alone stays as it is, so that what
 * is listed beside it and apart is not seen. */
static inline void join_group(const sharing *s, const uint32_t *member, size_t count) {
    double force = 0, stiffness = 0, sum[3][3] = {{0}};
    int touching = 0;
    for (size_t k = 0; k < count; k++) {
        size_t at = member[k] - s->begin, i = at % LANES;
        shared_batch *g = &s->batch[at / LANES];
        real(*const columns[3])[LANES] = {g->n, g->ta, g->tb};
        double f = (double)g->force[i];
        touching += f > 0;
        force += f, stiffness += (double)g->stiffness[i];
        for (int j = 0; j < 3; j++)
            for (int c = 0; c < 3; c++) sum[j][c] += f * (double)columns[j][c][i];
    }
    if (touching < 2) return;
    for (size_t k = 0; k < count; k++) {
        size_t at = member[k] - s->begin, i = at % LANES;
        shared_batch *g = &s->batch[at / LANES];
        real(*const columns[3])[LANES] = {g->n, g->ta, g->tb};
        if (!(g->force[i] > 0)) continue;
        double w = (double)g->force[i] / force;
        g->part[i] = (real)(w * w * (stiffness / (double)g->stiffness[i]));
        for (int j = 0; j < 3; j++)
            for (int c = 0; c < 3; c++) columns[j][c][i] = (real)(sum[j][c] / force);
    }
}

/* All groups of the entries begin .. end - 1. */
static inline void join_groups(sharing *s) {
    const contact_groups *g = s->groups;
    for (; s->next < g->count; s->next++) {
        const uint32_t *member = g->member + g->first[s->next];
        if (member[0] >= s->end) return;
        join_group(s, member, g->first[s->next + 1] - g->first[s->next]);
    }
}

#endif

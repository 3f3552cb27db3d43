/* pair_lanes.h - two spheres of a contact: their rows into the columns of a batch. */
#ifndef CLAST_PAIR_LANES_H
#define CLAST_PAIR_LANES_H

#include "engine/column_lanes.h"

/* Lanes behind the last contact repeat it, and are told apart from it by their overlap. */
LANE_INLINE int lane_or_last(int i, int count) {
    return i < count ? i : count - 1;
}

/* Where the numbers of one sphere stand. */
typedef struct side {
    const double *centre, *v, *w, *arm;
} side;

LANE_INLINE side side_of(const row_store *r, int32_t sphere, law_need need) {
    size_t s = (size_t)sphere, body = need.clumps ? (size_t)r->arm[s].body : s;
    const motion_row *m = &r->motion[body];
    return (side){&r->centre[s].x, m->v, m->w, need.clumps ? r->arm[s].arm : NULL};
}

LANE_INLINE void load_vector(real (*to)[LANES], int i, const double *from, law_need need) {
    to[0][i] = (real)from[0], to[1][i] = (real)from[1];
    if (!need.flat) to[2][i] = (real)from[2];
}

LANE_INLINE void load_spin(real (*to)[LANES], int i, const double *w, law_need need) {
    if (!need.flat) to[0][i] = (real)w[0], to[1][i] = (real)w[1];
    to[2][i] = (real)w[2];
}

LANE_INLINE void load_pair(batch *b, int i, side sa, side sb, law_need need) {
    for (int k = 0; k < (need.flat ? 2 : 3); k++) {
        b->d[k][i] = sa.centre[k] - sb.centre[k];
        b->v[k][i] = (real)(sa.v[k] - sb.v[k]);
    }
    if (need.equal) {
        double sum[3] = {sa.w[0] + sb.w[0], sa.w[1] + sb.w[1], sa.w[2] + sb.w[2]};
        load_spin(b->wa, i, sum, need);
        return;
    }
    load_spin(b->wa, i, sa.w, need), load_spin(b->wb, i, sb.w, need);
    if (!need.clumps) return;
    load_vector(b->oa, i, sa.arm, need), load_vector(b->ob, i, sb.arm, need);
}

#ifdef LANE_ROWS
LANE_INLINE void load_four(batch *b, int i, const side *sa, const side *sb, law_need need) {
    rows4 d[4], v[4], wa[4], wb[4], oa[4] = {{0}}, ob[4] = {{0}};
    for (int k = 0; k < 4; k++) {
        d[k] = row_at(sa[k].centre) - row_at(sb[k].centre);
        v[k] = row_at(sa[k].v) - row_at(sb[k].v);
        wa[k] = row_at(sa[k].w), wb[k] = row_at(sb[k].w);
        if (need.equal) wa[k] += wb[k];
        if (need.clumps) oa[k] = row_at(sa[k].arm), ob[k] = row_at(sb[k].arm);
    }
    put_places(b->d, i, d, need);
    put_vector(b->v, i, v, need);
    put_spin(b->wa, i, wa, need);
    if (!need.equal) put_spin(b->wb, i, wb, need);
    if (need.clumps) put_vector(b->oa, i, oa, need), put_vector(b->ob, i, ob, need);
}
#endif

#endif

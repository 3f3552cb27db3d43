/* column_lanes.h - rows of four numbers into columns, four rows at a time. */
#ifndef CLAST_COLUMN_LANES_H
#define CLAST_COLUMN_LANES_H

#include "engine/contact_law.h"

#ifdef LANE_ROWS
#ifdef CLAST_SINGLE
typedef float real4 __attribute__((vector_size(16), aligned(4), may_alias));
#else
typedef rows4 real4;
#endif

LANE_INLINE rows4 row_at(const double *p) {
    return *(const rows4 *)p;
}

LANE_INLINE void put4(real *to, rows4 from) {
#ifdef CLAST_SINGLE
    *(real4 *)to = __builtin_convertvector(from, real4);
#else
    *(real4 *)to = from;
#endif
}

/* Four rows into three columns, or those of them that a flat scene has. */
LANE_INLINE void put_vector(real (*to)[LANES], int i, const rows4 *r, law_need need) {
    rows4 c[4];
    TRANSPOSE4(rows4, r, c);
    put4(&to[0][i], c[0]), put4(&to[1][i], c[1]);
    if (!need.flat) put4(&to[2][i], c[2]);
}

LANE_INLINE void put_spin(real (*to)[LANES], int i, const rows4 *r, law_need need) {
    rows4 c[4];
    TRANSPOSE4(rows4, r, c);
    if (!need.flat) put4(&to[0][i], c[0]), put4(&to[1][i], c[1]);
    put4(&to[2][i], c[2]);
}

LANE_INLINE void put_places(double (*to)[LANES], int i, const rows4 *r, law_need need) {
    rows4 c[4];
    TRANSPOSE4(rows4, r, c);
    *(rows4 *)&to[0][i] = c[0], *(rows4 *)&to[1][i] = c[1];
    if (!need.flat) *(rows4 *)&to[2][i] = c[2];
}

LANE_INLINE void put_row(double (*to)[LANES], int i, const rows4 *r) {
    rows4 c[4];
    TRANSPOSE4(rows4, r, c);
    for (int k = 0; k < 4; k++) *(rows4 *)&to[k][i] = c[k];
}
#endif

#endif

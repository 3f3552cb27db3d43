/* Geometry and contact law over one batch, compiled with other flags under other names (LAW_RUN).
 */
#include "tests/engine/law_lanes.h"

LANE_INLINE void before_law(batch *b, history_lanes h, int count, int around) {
    if (around & HOOKE) {
#pragma omp simd
        for (int i = 0; i < count; i++) hooke_lane(b, i);
    }
    if (around & MAW) {
#pragma omp simd
        for (int i = 0; i < count; i++) maw_lane(b, i);
    }
    if (around & VISCOELASTIC) {
#pragma omp simd
        for (int i = 0; i < count; i++) viscoelastic_lane(b, i);
    }
    if (around & YIELDS) {
#pragma omp simd
        for (int i = 0; i < count; i++) yield_before(b, h, i);
    }
}

LANE_INLINE void after_law(batch *b, history_lanes h, int count, int around, law_need need) {
    if (around & YIELDS) {
#pragma omp simd
        for (int i = 0; i < count; i++) yield_after(b, h, i);
    }
    if (around & ROLLS) {
#pragma omp simd
        for (int i = 0; i < count; i++) rolling_lane(b, h, i, need);
    }
}

LANE_INLINE void run(lanes *l, int count, law_choice choice, law_need need, int around) {
    batch *b = &l->b;
    history_lanes h = {l->history[0], l->history[1], l->history[2],
                       l->history[3], l->history[4], l->history[HISTORY_PLASTIC]};
#pragma omp simd
    for (int i = 0; i < count; i++) touch_lane(b, i, need);
#pragma omp simd
    for (int i = 0; i < count; i++) effective_lane(b, i);
    before_law(b, h, count, around);
#pragma omp simd
    for (int i = 0; i < count; i++) law_normal(b, h, i, choice, need);
    if (need.tangent) {
#pragma omp simd
        for (int i = 0; i < count; i++) law_spring(b, h, i, choice, need);
    }
#pragma omp simd
    for (int i = 0; i < count; i++) law_force(b, h, i, need);
    after_law(b, h, count, around, need);
}

void LAW_RUN(lanes *l, int count, law_choice choice, int need, int around) {
#define CASE(k)                                                                                    \
    case k:                                                                                        \
        run(l, count, choice, need_of(k), around);                                                 \
        break;
#define EIGHT(k)                                                                                   \
    CASE(k) CASE(k + 1) CASE(k + 2) CASE(k + 3) CASE(k + 4) CASE(k + 5) CASE(k + 6) CASE(k + 7)
    switch (need) { EIGHT(0) EIGHT(8) EIGHT(16) }
}

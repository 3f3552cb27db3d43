/* Geometry and contact law over one batch, compiled with other flags under other names (LAW_RUN).
 */
#include "tests/engine/law_lanes.h"

LANE_INLINE void run(lanes *l, int count, law_choice choice, law_need need) {
    batch *b = &l->b;
    history_lanes h = {l->history[0], l->history[1], l->history[2], l->history[3], l->history[4]};
#pragma omp simd
    for (int i = 0; i < count; i++) touch_lane(b, i, need);
#pragma omp simd
    for (int i = 0; i < count; i++) effective_lane(b, i);
#pragma omp simd
    for (int i = 0; i < count; i++) law_normal(b, h, i, choice, need);
    if (need.tangent) {
#pragma omp simd
        for (int i = 0; i < count; i++) law_spring(b, h, i, choice, need);
    }
#pragma omp simd
    for (int i = 0; i < count; i++) law_force(b, h, i, need);
}

void LAW_RUN(lanes *l, int count, law_choice choice, int need) {
#define CASE(k)                                                                                    \
    case k:                                                                                        \
        run(l, count, choice, need_of(k));                                                         \
        break;
#define EIGHT(k)                                                                                   \
    CASE(k) CASE(k + 1) CASE(k + 2) CASE(k + 3) CASE(k + 4) CASE(k + 5) CASE(k + 6) CASE(k + 7)
    switch (need) { EIGHT(0) EIGHT(8) EIGHT(16) }
}

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
    for (int i = 0; i < count; i++) contact_law(b, h, i, choice, need);
}

void LAW_RUN(lanes *l, int count, law_choice choice, int need) {
    switch (need) {
#define CASE(k)                                                                                    \
    case k:                                                                                        \
        run(l, count, choice, need_of(k));                                                         \
        break;
        CASE(0)
        CASE(1) CASE(2) CASE(3) CASE(4) CASE(5) CASE(6) CASE(7) CASE(8) CASE(9) CASE(10) CASE(11)
            CASE(12) CASE(13) CASE(14) default : CASE(15)
    }
}

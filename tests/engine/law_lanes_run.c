/* The contact law over one batch, compiled with other flags under other names (LAW_RUN). */
#include "tests/engine/law_lanes.h"

void LAW_RUN(batch *b, law_choice choice, double dt) {
#pragma omp simd
    for (int i = 0; i < b->count; i++) contact_law(b, i, choice, dt);
}

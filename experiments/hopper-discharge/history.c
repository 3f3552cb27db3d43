/* history.c - the contact network of a bed while it flows. */
#include "experiments/hopper-discharge/discharge.h"

#include <string.h>

#include "engine/check.h"

#define FINE_STEP 1e-4 /* s: 32 steps in the shortest contact */

void history_run(const hopper *h, const bed *b, double every, network_history *out) {
    CLAST_ASSERT(h && b && every >= FINE_STEP && out);
    memset(out, 0, sizeof *out);
    const world_plan plan = {.scheme = CLAST_SCHEME_LEAPFROG, .step = FINE_STEP};
    clast_world *w = world_open(h, b, &plan);
    bool runs = true;
    for (int k = 0; runs && k < HISTORY_POINTS; k++) {
        runs = k == 0 || clast_world_run(w, k * every) == CLAST_OK;
        runs = runs && clast_world_bodies(w).count > 0;
        if (runs)
            out->moment[out->count++] =
                (network_moment){clast_world_time(w), network_of(w, STIFFNESS)};
    }
    clast_world_free(w);
}

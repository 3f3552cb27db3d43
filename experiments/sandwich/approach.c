/* approach.c - S12 3.9.2: a ball flies at a wall, and the touch comes within a step. */
#include <math.h>

#include "experiments/sandwich/sandwich.h"

double approach_overlap(clast_scheme scheme, double resolution, double fraction) {
    enum { LEAD = 6 }; /* steps of free flight: more than any scheme remembers */
    double step = ball_contact() / resolution, way = APPROACH_SPEED * step;
    /* A touch that falls on a step would have an overlap of either sign by rounding. */
    double late = fmin(fmax(fraction, 1e-9), 1 - 1e-9);
    ball_def def = {.scheme = scheme,
                    .restitution = 1,
                    .step = step,
                    .gap = BALL_RADIUS,
                    .single = true,
                    .x = (LEAD + late) * way,
                    .v = -APPROACH_SPEED,
                    .max_overlap = 1.9};
    clast_world *w = ball_new(&def);
    double most = 0;
    for (int n = 0; n < LEAD + (int)(2 * resolution) + 6; n++) {
        if (clast_world_step(w)) break;
        most = fmax(most, -ball_x(w));
    }
    ball_free(w);
    return most / (APPROACH_SPEED / ball_frequency());
}

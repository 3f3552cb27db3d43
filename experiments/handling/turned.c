/* turned.c - spheres on a rotating disc. A sphere that rolls on it without slipping runs in a
 * circle with 2/7 of its spin, wherever it started (the turntable problem; I = 2/5 m r^2 enters as
 * (2/5) / (1 + 2/5)). */
#include <math.h>
#include <stdlib.h>

#include "experiments/handling/handling.h"

static const double ON_DISC = 0.0245; /* m, height of a centre: 25 mm on the disc, 24 mm off it */
static const double ROLLS_FROM = 1.0; /* s: it has stopped slipping long before */

static bool is_on_disc(const frame *f, size_t body) {
    return f->position[3 * body + 2] > ON_DISC;
}

/* Angle by which the velocity of the first body turned between two frames. */
static double turn_between(const double from[3], const double to[3]) {
    return atan2(from[0] * to[1] - from[1] * to[0], from[0] * to[0] + from[1] * to[1]);
}

turned turned_of(results *r, double spin) {
    turned out = {.frequency = NAN};
    double angle = 0, before[3] = {0}, since = NAN, time = NAN;
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *f = results_frame(r, i);
        if (!f) {
            fprintf(stderr, "handling: %s\n", results_error(r));
            exit(4);
        }
        out.bodies = (int)f->bodies, out.left = 0;
        for (size_t k = 0; k < f->bodies; k++) out.left += is_on_disc(f, k);
        if (f->time >= ROLLS_FROM && out.left == out.bodies) {
            if (isnan(since))
                since = f->time;
            else
                angle += turn_between(before, f->velocity);
            for (int k = 0; k < 3; k++) before[k] = f->velocity[k];
            time = f->time;
        }
        frame_free(f);
    }
    if (out.bodies == 1 && time > since) out.frequency = angle / (time - since) / spin;
    return out;
}

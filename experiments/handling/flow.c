/* flow.c - two-sphere particles out of a bin (A00 3.9.4). */
#include <math.h>
#include <stdlib.h>

#include "experiments/handling/handling.h"

/* Spheres above the middle part of the orifice, in the last frame. */
static bool is_bridged(results *r, double orifice) {
    frame *f = results_frame(r, results_frames(r) - 1);
    if (!f) {
        fprintf(stderr, "handling: %s\n", results_error(r));
        exit(4);
    }
    bool bridged = false;
    for (size_t i = 0; i < f->spheres; i++)
        bridged |= f->centre[3 * i + 2] > 0 && fabs(f->centre[3 * i]) < ARCH_HALF * orifice / 2;
    frame_free(f);
    return bridged;
}

flow flow_measured(results *r, double orifice_m) {
    int n = (int)results_rows(r);
    const double *t = run_column(r, "time_s"), *out = run_column(r, "out_count");
    int last = n - 1;
    while (last > 0 && out[last - 1] == out[n - 1]) last--;
    linear_window w = linear_part(t, out, n, 0.99);
    double part = w.count > 0 ? out[w.first + w.count - 1] - out[w.first] : 0;
    flow f = {.out = (int)out[n - 1],
              .left = (int)run_column(r, "left_count")[n - 1],
              .rests = t[n - 1] - t[last] >= QUIET_FOR,
              .rate = part >= 20 ? w.slope : NAN,
              .coordination = run_column(r, "z_bodies")[0]};
    f.arched = f.rests && is_bridged(r, orifice_m);
    return f;
}

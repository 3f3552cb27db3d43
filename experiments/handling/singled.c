/* singled.c - spheroids that a faster conveyor draws apart (A00 3.9.5). */
#include <math.h>
#include <stdlib.h>

#include "engine/check.h"
#include "experiments/handling/handling.h"

static const double SLOW_END = 0.96; /* m, BOT 96.0: where the slow conveyor ends */

static bool touches_another(const frame *f, uint32_t id) {
    for (size_t c = 0; c < f->contacts; c++)
        if (f->contact_b[c] < CLAST_WALL_ID && (f->contact_a[c] == id || f->contact_b[c] == id))
            return true;
    return false;
}

/* Distance along the belt to the nearest one ahead; NAN without one. */
static double ahead_of(const frame *f, size_t body) {
    double nearest = INFINITY, x = f->position[3 * body];
    for (size_t i = 0; i < f->bodies; i++) {
        double way = f->position[3 * i] - x;
        if (i != body && way > 0) nearest = fmin(nearest, way);
    }
    return isfinite(nearest) ? nearest : NAN;
}

static void pass(singled *s, const frame *f, size_t body) {
    CLAST_ASSERT(s->count < SPHEROIDS);
    int n = s->count++;
    s->time[n] = f->time;
    s->speed[n] = f->velocity[3 * body];
    s->alone[n] = !touches_another(f, f->id[body]);
    s->ahead[n] = ahead_of(f, body);
}

static double crowded(const frame *f) {
    int on = 0, touching = 0;
    for (size_t i = 0; i < f->bodies; i++) {
        if (f->position[3 * i] > SLOW_END) continue;
        on++;
        touching += touches_another(f, f->id[i]);
    }
    return on ? (double)touching / on : NAN;
}

double singled_share(const singled *s) {
    return s->start > 0 ? (double)s->count / s->start : NAN;
}

singled singled_of(results *r) {
    singled out = {0};
    bool passed[SPHEROIDS] = {false};
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *f = results_frame(r, i);
        if (!f || f->bodies != SPHEROIDS || !f->contact_b) {
            fprintf(stderr, "handling: a frame of the singulation cannot be used\n");
            exit(4);
        }
        if (i == 0) out.before = crowded(f);
        for (size_t k = 0; k < f->bodies; k++) {
            bool beyond = f->position[3 * k] >= SINGLED_AT;
            if (i == 0) out.start += !beyond;
            if (passed[f->id[k]] || !beyond) continue;
            passed[f->id[k]] = true;
            if (i > 0) pass(&out, f, k);
        }
        frame_free(f);
    }
    return out;
}

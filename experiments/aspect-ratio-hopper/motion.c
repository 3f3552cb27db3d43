/* motion.c - nine particles that are followed through the discharge: A00 5.3.2.2, Figs 5.10 to
 * 5.13. Their exact places stand in a figure alone. */
#include <math.h>

#include "engine/check.h"
#include "experiments/aspect-ratio-hopper/aspect.h"

static const double ACROSS[REGIONS] = {-0.8, 0, 0.8}; /* of the half width */
static const double UP[3] = {0.75, 0.5, 0.25};        /* of the height of the bed */

static uint32_t nearest(const frame *f, double x, double z) {
    double least = INFINITY;
    uint32_t id = 0;
    for (size_t i = 0; i < f->bodies; i++) {
        double dx = f->position[3 * i] - x, dz = f->position[3 * i + 2] - z;
        if (dx * dx + dz * dz < least) least = dx * dx + dz * dz, id = f->id[i];
    }
    return id;
}

/* Frames have bodies in the order of ids; none leaves this world. */
static size_t place_of(const frame *f, uint32_t id) {
    size_t i = id < f->bodies ? id : f->bodies - 1;
    while (i > 0 && f->id[i] > id) i--;
    CLAST_ASSERT(f->id[i] == id);
    return i;
}

double body_angle(const double q[4]) {
    double x = 1 - 2 * (q[2] * q[2] + q[3] * q[3]), z = 2 * (q[1] * q[3] - q[0] * q[2]);
    return atan2(z, x);
}

/* Without the jumps of atan2. */
static double unwound(double angle, double before) {
    const double turn = 6.283185307179586;
    return angle + turn * round((before - angle) / turn);
}

static void add_frame(track *t, const frame *f, size_t i) {
    if (t->count == TRACK_MAX) return;
    const double *p = &f->position[3 * i];
    int k = t->count++;
    double angle = body_angle(&f->orientation[4 * i]);
    t->time[k] = f->time, t->x[k] = p[0], t->z[k] = p[2], t->vx[k] = f->velocity[3 * i];
    t->angle[k] = k > 0 ? unwound(angle, t->angle[k - 1]) : angle;
}

void tracks_of(results *r, const aspect_case *c, track tracks[TRACKED]) {
    uint32_t id[TRACKED];
    for (size_t i = 0; i < results_frames(r); i++) {
        frame *f = results_frame(r, i);
        CLAST_ASSERT(f);
        for (int k = 0; k < TRACKED; k++) {
            if (i == 0) {
                tracks[k].count = 0;
                id[k] = nearest(f, ACROSS[k / 3] * c->half_width, UP[k % 3] * c->bed.height);
            }
            add_frame(&tracks[k], f, place_of(f, id[k]));
        }
        frame_free(f);
    }
}

double turned_by(const track *t) {
    double path = 0;
    for (int i = 1; i < t->count && t->z[i] > 0; i++) path += fabs(t->angle[i] - t->angle[i - 1]);
    return path;
}

/* conveyed.c - particles that a conveyor carries and drops on another (A00 3.9.1 to 3.9.3). */
#include <math.h>
#include <stdlib.h>

#include "experiments/handling/handling.h"

/* m, height of the middle wall (BOT): what is below has been dropped. */
static const double LEVEL[KINDS] = {[TAPERED] = 0.30, [IRREGULAR] = 0.40, [BUNCH] = 0.30};
static const double EDGE = 0.30; /* m, where the upper conveyor ends (BOT) */

/* ---- where they go --------------------------------------------------------------------------- */

typedef struct track {
    bool on_top, carried, returned;
    double with_upper, with_lower; /* s, since when it has had that belt's speed; < 0: it has not */
} track;

static bool has_speed(double v, double belt) {
    return fabs(v - belt) < SPEED_TAKEN * fabs(belt);
}

bool keeps_speed(double time, bool has_it, double *since) {
    if (!has_it)
        *since = -1;
    else if (*since < 0)
        *since = time;
    return has_it && time - *since >= CARRIED_FOR * (1 - 1e-9);
}

static void follow(const frame *f, double level, bool first, track *tracks) {
    for (size_t i = 0; i < f->bodies; i++) {
        track *t = &tracks[f->id[i]];
        bool above = f->position[3 * i + 2] > level;
        double v = f->velocity[3 * i];
        if (first) *t = (track){above && f->position[3 * i] < EDGE, false, false, -1, -1};
        bool with_upper = above && has_speed(v, CONVEYOR_SPEED);
        bool with_lower = !above && has_speed(v, -CONVEYOR_SPEED);
        t->carried |= keeps_speed(f->time, with_upper, &t->with_upper);
        t->returned |= keeps_speed(f->time, with_lower, &t->with_lower);
    }
}

conveyed conveyed_of(results *r, scene_kind kind) {
    conveyed out = {0};
    size_t frames = results_frames(r), bodies = 0, on_top = 0, below = 0;
    track *tracks = NULL;
    for (size_t i = 0; i < frames; i++) {
        frame *f = results_frame(r, i);
        if (!f) {
            fprintf(stderr, "handling: %s\n", results_error(r));
            exit(4);
        }
        if (i == 0) {
            bodies = f->bodies;
            tracks = calloc(bodies + 1, sizeof *tracks);
            if (!tracks) abort();
        }
        follow(f, LEVEL[kind], i == 0, tracks);
        for (size_t k = 0; k < f->bodies && i + 1 == frames; k++)
            below += f->position[3 * k + 2] < LEVEL[kind];
        frame_free(f);
    }
    for (size_t k = 0; k < bodies; k++) {
        on_top += tracks[k].on_top;
        out.carried += tracks[k].on_top && tracks[k].carried;
        out.returned += tracks[k].returned;
    }
    free(tracks);
    out.carried = on_top ? out.carried / (double)on_top : NAN;
    out.returned /= (double)bodies;
    out.dropped = (double)below / (double)bodies;
    return out;
}

double fall_time(results *r, scene_kind kind) {
    double time = 0;
    bool below = false;
    for (size_t i = 0; i < results_frames(r) && !below; i++) {
        frame *f = results_frame(r, i);
        if (!f) break;
        time = f->time;
        below = f->position[2] < LEVEL[kind];
        frame_free(f);
    }
    return time;
}

/* ---- how hard they land ---------------------------------------------------------------------- */

/* One collision is a stretch of records with a force on the lower conveyor. */
typedef struct stretch {
    double from, to, last; /* s */
    double normal, shear;  /* N, largest in it */
    double at;             /* s, of the largest normal force */
} stretch;

typedef struct landing {
    stretch now, hardest, most_sheared;
    int count;
    double first_normal; /* N, of the first collision */
} landing;

static void close_stretch(landing *l) {
    if (l->count == 0) return;
    if (l->count == 1) l->first_normal = l->now.normal;
    if (l->now.normal > l->hardest.normal) l->hardest = l->now;
    if (l->now.shear > l->most_sheared.shear) l->most_sheared = l->now;
}

static void take(landing *l, double time, double normal, double shear) {
    if (normal <= 0) return;
    if (l->count == 0 || time - l->now.last > COLLISION_GAP) {
        close_stretch(l);
        l->count++;
        l->now = (stretch){.from = time};
    }
    l->now.to = l->now.last = time;
    if (normal > l->now.normal) l->now.normal = normal, l->now.at = time;
    l->now.shear = fmax(l->now.shear, shear);
}

drop drop_of(const results *r) {
    const double *t = run_column(r, "time_s"), *x = run_column(r, "lower_force_x_N");
    const double *y = run_column(r, "lower_force_y_N"), *z = run_column(r, "lower_force_z_N");
    landing l = {0};
    double seen = 0;
    for (size_t i = 0; i < results_rows(r); i++) {
        take(&l, t[i], -z[i], hypot(x[i], y[i]));
        if (i % EVERY_STEPS == 0) seen = fmax(seen, -z[i]);
    }
    close_stretch(&l);
    return (drop){.collisions = l.count,
                  .peak = l.hardest.normal,
                  .seen = seen,
                  .shear = l.most_sheared.shear,
                  .at = l.hardest.at,
                  .duration = l.hardest.to - l.hardest.from,
                  .first_is_largest = l.count > 0 && l.first_normal == l.hardest.normal,
                  .shear_with_normal = l.count > 0 && l.most_sheared.from == l.hardest.from};
}

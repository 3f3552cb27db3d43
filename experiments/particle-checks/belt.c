/* belt.c - A00 3.5: a capsule of five spheres is dropped on a belt that runs at 0.01 m/s. */
#include <math.h>

#include "experiments/particle-checks/checks.h"

const belt_case BELT_BASE = {
    .fraction = 0.1, .damping = 0.21, .friction = 0.3, .height = BELT_HEIGHT};

static setting setting_of(const belt_case *c) {
    double young = sliding_young();
    return (setting){.law = CLAST_LAW_HERTZ_A00,
                     .young = young,
                     .step = c->fraction * critical_step(sliding_particle(5).radius, young),
                     .damping = c->damping,
                     .slip_damping = c->damping,
                     .friction = c->friction,
                     .belt = BELT_SPEED,
                     .in_plane = true,
                     .shared = c->shared};
}

belt belt_run(const belt_case *c, FILE *trace) {
    enum { POINTS = 3000 };
    capsule p = sliding_particle(5);
    setting s = setting_of(c);
    clast_world *w = matter_new(&s, &p);
    floor_add(w, &s);
    body_put(w, &(clast_body_def){.shape = 0, .position = {0, 0, p.radius + c->height}});
    belt found = {.speed = 0};
    int last = 0;
    for (int i = 1; i <= POINTS; i++) {
        double until = BELT_TIME * i / POINTS;
        while (clast_world_time(w) < until - 0.5 * s.step) world_step(w);
        double speed = clast_world_bodies(w).vx[0];
        if (fabs(speed / BELT_SPEED - 1) > 0.1) found.settled = until;
        if (i > POINTS - POINTS / 10) found.speed += speed, last++;
        if (trace)
            fprintf(trace, "%g,%g,%g,%.6g,%.6g\n", c->fraction, c->damping, c->friction, until,
                    speed);
    }
    found.speed /= last;
    world_end(w);
    return found;
}

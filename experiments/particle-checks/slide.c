/* slide.c - A00 3.4: capsules slide down a slope of 30 degrees, their axis along the way; and what
 * a flat landing gives back, which is where the number of dashpots shows. */
#include <math.h>

#include "experiments/particle-checks/checks.h"

double slide_exact(double friction, double time) {
    return 0.5 * GRAVITY * (sin(SLOPE) - friction * cos(SLOPE)) * time * time;
}

static setting setting_of(const slide_case *c) {
    double young = sliding_young();
    return (setting){.law = c->printed ? CLAST_LAW_USER : CLAST_LAW_HERTZ_A00,
                     .young = young,
                     .step = c->fraction * critical_step(sliding_particle(3).radius, young),
                     .damping = c->damping,
                     .slip_damping = c->slip_damping,
                     .friction = c->friction,
                     .slope = SLOPE,
                     .in_plane = true,
                     .shared = c->shared};
}

void slide_run(const slide_case *c, int count, double *way) {
    capsule p = sliding_particle(c->spheres);
    setting s = setting_of(c);
    clast_world *w = matter_new(&s, &p);
    floor_add(w, &s);
    body_put(w, &(clast_body_def){.shape = 0, .position = {0, 0, p.radius}});
    for (int i = 0; i < count; i++) {
        double until = SLIDE_TIME * (i + 1) / count;
        while (clast_world_time(w) < until - 0.5 * s.step) world_step(w);
        /* on a grid of times that steps need not hit: the way at the exact one */
        clast_bodies b = clast_world_bodies(w);
        way[i] = b.x[0] + b.vx[0] * (until - clast_world_time(w));
    }
    world_end(w);
}

double landing_rebound(int spheres, double damping, bool shared) {
    const double speed = 0.1; /* m/s */
    slide_case base = {.spheres = spheres, .damping = damping, .fraction = 0.02, .shared = shared};
    capsule p = sliding_particle(spheres);
    setting s = setting_of(&base);
    s.weightless = true;
    clast_world *w = matter_new(&s, &p);
    floor_add(w, &s);
    double gap = 0.5 * speed * s.step;
    body_put(w, &(clast_body_def){
                    .shape = 0, .position = {0, 0, p.radius + gap}, .velocity = {0, 0, -speed}});
    clast_bodies b;
    do {
        world_step(w);
        b = clast_world_bodies(w);
    } while (b.z[0] < p.radius || b.vz[0] < 0);
    double rebound = b.vz[0] / speed;
    world_end(w);
    return rebound;
}

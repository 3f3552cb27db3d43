/* weight.c - A00 3.2: a particle is put on a floor, gravity sets in, and after 5 ms the contact
 * force should be its weight. */
#include <math.h>

#include "experiments/particle-checks/checks.h"

#define CRITICAL PAIR_CRITICAL_STEP

const rest_case REST_CASE[REST_CASES] = {
    {.damping = 0.5, .step = CRITICAL},
    {.damping = 0.5, .step = 0.1 * CRITICAL},
    {.damping = 0.5, .step = 0.01 * CRITICAL},
    {.damping = 0.21, .step = CRITICAL},
    {.damping = 0.21, .step = 0.1 * CRITICAL},
    {.damping = 0.21, .step = 0.01 * CRITICAL},
    {.horizontal = true, .damping = 0.5, .step = CRITICAL},
    {.horizontal = true, .damping = 0.5, .step = 0.1 * CRITICAL},
    {.horizontal = true, .damping = 0.5, .step = 0.01 * CRITICAL},
};

static const char *orientation_of(const rest_case *c) {
    return c->horizontal ? "horizontal" : "vertical";
}

void rest_name(const rest_case *c, const char *what, char name[REST_NAME]) {
    snprintf(name, REST_NAME, "%s, damping %g, %g us: %s", orientation_of(c), c->damping,
             1e6 * c->step, what);
}

static setting setting_of(const rest_case *c, double young) {
    return (setting){.law = CLAST_LAW_HERTZ_A00,
                     .young = young,
                     .step = c->step,
                     .damping = c->damping,
                     .shared = c->shared,
                     .mixed = c->mixed,
                     .rigid_wall = !c->soft_floor};
}

/* Of another radius, the matter is the one whose critical step is the printed one again. */
static capsule particle_of(const rest_case *c) {
    capsule p = pair_particle();
    if (c->radius > 0) {
        double straight =
            p.mass / matter_density() / (CHECKS_PI * c->radius * c->radius) - 4.0 / 3 * c->radius;
        p = capsule_of(2, c->radius, straight, p.mass);
    }
    return p;
}

static void put_on_floor(clast_world *w, const capsule *p, bool horizontal) {
    double half = horizontal ? 0 : 0.5 * (p->spheres - 1) * p->spacing;
    clast_quat turn = horizontal ? (clast_quat){1, 0, 0, 0} : upright();
    body_put(w, &(clast_body_def){
                    .shape = 0, .position = {0, 0, p->radius + half}, .orientation = turn});
}

static void write_state(FILE *f, clast_world *w, const rest_case *c, const touch *t) {
    fprintf(f, "%s,%g,%g,%.8g,%.6g,%.8g,%.6g,%.8g\n", orientation_of(c), c->damping, c->step,
            clast_world_time(w), -clast_world_bodies(w).vz[0], t->elastic, t->dashpot, t->force.z);
}

rest rest_run(const rest_case *c, FILE *trace) {
    enum { POINTS = 480 };
    capsule p = particle_of(c);
    setting s = setting_of(c, matter_young(p.radius, PAIR_CRITICAL_STEP));
    clast_world *w = matter_new(&s, &p);
    floor_add(w, &s);
    put_on_floor(w, &p, c->horizontal);
    int steps = (int)lround(REST_TIME / c->step), every = steps / POINTS > 0 ? steps / POINTS : 1;
    for (int n = 1; n <= steps; n++) {
        world_step(w);
        if (!trace || n % every) continue;
        touch t = touch_of(w, 0, &s, &p);
        write_state(trace, w, c, &t);
    }
    touch t = touch_of(w, 0, &s, &p);
    world_end(w);
    return (rest){.error = fabs(t.force.z - PAIR_WEIGHT), .overlap = t.overlap};
}

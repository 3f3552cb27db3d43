/* blow.c - A00 3.6: 1 kN for one step, 1.5 cm off the centre of a capsule of nine spheres, and the
 * surface that it then meets.
 *
 * The engine has no loads of the user's. The force comes from a small plate that is driven into one
 * element sphere in one step, until the elastic force is 1 kN, and is gone in the next. */
#include <math.h>

#include "experiments/particle-checks/checks.h"

static const double RADIUS = 0.01;            /* m, assumed */
static const double SPACING = 0.5 * BLOW_ARM; /* so that a sphere is where the force acts */
static const double FLIGHT = 0.05;            /* m, to the surface; assumed */
static const double WATCHED = 0.3;            /* s */

static capsule particle(void) {
    return (capsule){.spheres = 9,
                     .radius = RADIUS,
                     .spacing = SPACING,
                     .mass = BLOW_MASS,
                     .inertia = {BLOW_INERTIA, BLOW_INERTIA, BLOW_INERTIA}};
}

static setting setting_of(void) {
    return (setting){.law = CLAST_LAW_HERTZ_A00,
                     .young = matter_young(RADIUS, BLOW_STEP),
                     .step = BLOW_STEP,
                     .weightless = true,
                     .in_plane = true,
                     .guards_look_on = true}; /* one step of contact is no energy balance */
}

/* m: at which a Hertz contact of one matter presses with that force. */
static double overlap_of(double force, double young) {
    double modulus = young / (2 * (1 - POISSON * POISSON));
    return pow(force / (4.0 / 3 * modulus * sqrt(RADIUS)), 2.0 / 3);
}

/* At the first step it overlaps the sphere as asked, at the second it is not there any more. */
static void add_hammer(clast_world *w, const setting *s) {
    double depth = overlap_of(BLOW_FORCE, s->young), gap = 0.5 * depth;
    clast_part_def hammer = {
        .name = "hammer", .velocity = {0, 0, (gap + depth) / s->step}, .removed_at = 1.5 * s->step};
    clast_wall_def plate = {.name = "plate",
                            .kind = CLAST_WALL_PLATE,
                            .material = 0,
                            .point = {BLOW_ARM, 0, -RADIUS - gap},
                            .normal = {0, 0, 1},
                            .side = {1, 0, 0},
                            .half_side = {0.2 * RADIUS, 0.2 * RADIUS}};
    clast_wall_add(w, clast_part_add(w, &hammer), &plate);
}

/* The matter strikes elastically; what is met has the damping. */
static void add_surface(clast_world *w, double damping) {
    clast_pair_def pair = {.restitution =
                               damping > 0 ? clast_restitution(CLAST_LAW_HERTZ_A00, damping) : 1};
    clast_pair_set(w, 0, 1, &pair);
    int part = clast_part_add(w, &(clast_part_def){.name = "surface"});
    clast_wall_def plane = {
        .name = "surface", .material = 1, .point = {0, 0, RADIUS + FLIGHT}, .normal = {0, 0, -1}};
    clast_wall_add(w, part, &plane);
}

static double turned(const clast_bodies *b) {
    return -2 * atan2(b->qy[0], b->qw[0]);
}

blow blow_run(double damping, FILE *trace) {
    capsule p = particle();
    setting s = setting_of();
    clast_world *w = matter_new(&s, &p);
    add_surface(w, damping);
    add_hammer(w, &s);
    body_put(w, &(clast_body_def){.shape = 0, .position = {0, 0, 0}});
    int steps = (int)lround(WATCHED / s.step);
    blow found = {.speed = 0};
    for (int n = 1; n <= steps; n++) {
        world_step(w);
        clast_bodies b = clast_world_bodies(w);
        if (n == 3) {
            found.speed = b.vz[0], found.spin = -b.wy[0];
            found.acceleration = found.speed / s.step, found.turning = found.spin / s.step;
        }
        if (trace && n % 50 == 0)
            fprintf(trace, "%g,%.6g,%.6g,%.6g\n", damping, n * s.step, b.z[0], turned(&b));
        found.speed_after = b.vz[0], found.spin_after = -b.wy[0];
    }
    world_end(w);
    return found;
}

/* Orders of convergence of every scheme: on smooth motion they are those of the table, at the onset
 * of a contact those of a force with a kink. */
#include "tests/support/sandwich.h"

typedef struct errors {
    double x, v; /* largest so far, of the amplitude */
} errors;

/* ---- smooth motion --------------------------------------------------------------------------- */

static errors smooth(clast_scheme scheme, double restitution, double steps_per_period) {
    sandwich s = {.law = CLAST_LAW_LINEAR,
                  .scheme = scheme,
                  .restitution = restitution,
                  .step = 2 * 3.14159265358979323846 / steps_per_period,
                  .x = 2.1e-4,
                  .v = 0.013};
    oscillator o = sandwich_new(&s);
    errors e = {0, 0};
    for (int i = 0; i < (int)(2.4 * steps_per_period); i++) {
        steps(o.world, 1);
        double v, x = sandwich_exact(&o, &s, clast_world_time(o.world), &v);
        e.x = fmax(e.x, fabs(sandwich_position(&o) - x) / s.x);
        e.v = fmax(e.v, fabs(sandwich_velocity(&o) - v) / (o.omega * s.x));
    }
    clast_world_free(o.world);
    return e;
}

/* Where the next order no longer shows. Without dashpots the errors of third order all but cancel
 * in Gear's velocity, so that the fourth shows down to steps a hundred times smaller. */
static double asymptotic(clast_scheme scheme, double restitution, int order) {
    if (scheme == CLAST_SCHEME_GEAR4 && restitution == 1) return 4500;
    return order == 1 ? 800 : order == 2 ? 100 : order == 3 ? 240 : 60;
}

static void check_smooth(clast_scheme scheme, double restitution, int order) {
    double coarse = asymptotic(scheme, restitution, order);
    errors a = smooth(scheme, restitution, coarse), b = smooth(scheme, restitution, 2 * coarse);
    double x = order_of(a.x, b.x, 2), v = order_of(a.v, b.v, 2);
    print_message("%-17s e = %.1f: error %.1e at %4.0f steps per period, orders %.3f in x, "
                  "%.3f in v\n",
                  clast_scheme_info_of(scheme)->name, restitution, b.x, 2 * coarse, x, v);
    CHECK_NEAR(x, order, 0.1);
    CHECK_NEAR(v, order, 0.1);
}

/* The leapfrog is of second order without dashpots, and of first with them: its own tests. */
static void smooth_motion_without_damping(void **state) {
    (void)state;
    for (int s = 0; s < CLAST_SCHEMES; s++)
        check_smooth((clast_scheme)s, 1, clast_scheme_info_of((clast_scheme)s)->order);
}

static void smooth_motion_with_damping(void **state) {
    (void)state;
    for (int s = 0; s < CLAST_SCHEMES; s++)
        check_smooth((clast_scheme)s, 0.7, clast_scheme_info_of((clast_scheme)s)->order_damped);
}

/* ---- the onset of a contact ------------------------------------------------------------------ */

/* A ball flies at a plane with a linear spring, in contact for half a period and away: the largest
 * error after it over places of the onset within a step. */
static errors bounce(clast_scheme scheme, double steps_per_contact) {
    enum { PHASES = 8 };
    const double r = 0.005, k = 310, pi = 3.14159265358979323846, speed = 0.1;
    errors most = {0, 0};
    for (int i = 0; i < PHASES; i++) {
        double mass = 1130 * 4.0 / 3 * pi * r * r * r, omega = sqrt(k / mass), t = pi / omega;
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.scheme = scheme, def.time_step = t / steps_per_contact;
        def.max_residual = 1e9;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        pair.stiffness = k;
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", r, m.soft);
        add_plane(w, clast_part_add(w, &(clast_part_def){.name = "plane"}), m.hard, vec(0, 0, 0),
                  vec(0, 0, 1));
        double gap = speed * def.time_step * (5 + (i + 0.37) / PHASES);
        add_body(w, ball, vec(0, 0, r + gap), vec(0, 0, -speed), vec(0, 0, 0));
        run_to(w, gap / speed + 1.2 * t);
        body_state b = body_of(w, 0);
        double after = clast_world_time(w) - gap / speed - t;
        most.x = fmax(most.x, fabs(b.position.z - r - speed * after) / (speed / omega));
        most.v = fmax(most.v, fabs(b.velocity.z - speed) / speed);
        clast_world_free(w);
    }
    return most;
}

/* In the step in which the spring begins to push its force is off by dt: a velocity is off by dt^2,
 * whatever the order of the scheme. */
static void an_onset_costs_order(void **state) {
    (void)state;
    for (int s = 0; s < CLAST_SCHEMES; s++) {
        int order = clast_scheme_info_of((clast_scheme)s)->order;
        double coarse = order == 1 ? 206.3 : 205.37; /* no whole number: it would cancel errors */
        errors a = bounce((clast_scheme)s, coarse), b = bounce((clast_scheme)s, 4 * coarse);
        double x = order_of(a.x, b.x, 4), v = order_of(a.v, b.v, 4);
        print_message("%-17s bounce: %.1e in x, %.1e in v at %4.0f steps, orders %.2f, %.2f\n",
                      clast_scheme_info_of((clast_scheme)s)->name, b.x, b.v, 4 * coarse, x, v);
        double want = order < 2 ? 1 : 2;
        CHECK_BELOW(want - 0.1, x);
        CHECK_BELOW(want - 0.1, v);
    }
}

TEST_MAIN(cmocka_unit_test(smooth_motion_without_damping),
          cmocka_unit_test(smooth_motion_with_damping), cmocka_unit_test(an_onset_costs_order))

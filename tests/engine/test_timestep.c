/* The limits of the time step, by hand and as printed. */
#include "tests/support/collision.h"

static const double PI = 3.14159265358979323846;

static clast_world *chain_world(int n, double fraction, double speed) {
    clast_world_def def = clast_world_def_default();
    def.rayleigh_fraction = fraction, def.impact_speed = speed, def.threads = 1;
    clast_world *w = new_world(&def);
    int m = clast_material_add(w, &(clast_material_def){"stone", 2650, 3.5e9, 0.3});
    assert_int_equal(clast_pair_set(w, m, m, &(clast_pair_def){.restitution = 0.5}), CLAST_OK);
    double r = 0.01 * cbrt(1.0 / n), radius[4] = {r, r, r, r};
    clast_vec3 centre[4];
    for (int i = 0; i < n; i++) centre[i] = vec(2 * r * (i - 0.5 * (n - 1)), 0, 0);
    int shape = clast_shape_add(
        w, &(clast_shape_def){"chain", m, n, centre, radius, 0, {0, 0, 0}, 0, NULL});
    assert_true(shape >= 0);
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* A00 ch. 5: 4.8, 3.8, 3.3, 3.0 x 1e-5 s for chains of 1 to 4 spheres. */
static void rayleigh_steps_of_the_chains(void **state) {
    (void)state;
    static const double printed[4] = {4.8e-5, 3.8e-5, 3.3e-5, 3.0e-5};
    for (int n = 1; n <= 4; n++) {
        clast_world *w = chain_world(n, 0.2, 1);
        double r = 0.01 * cbrt(1.0 / n), shear = 3.5e9 / 2.6;
        double want = PI * r / (0.1631 * 0.3 + 0.8766) * sqrt(2650 / shear);
        CHECK_CLOSE(clast_world_plan(w).rayleigh_step, want, 1e-13);
        CHECK_NEAR(clast_world_plan(w).rayleigh_step, printed[n - 1], 0.05e-5);
        clast_world_free(w);
    }
}

static void auto_takes_the_smaller_limit(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 0.03, 0.01);
    clast_plan p = clast_world_plan(w);
    CHECK_CLOSE(p.time_step, 0.03 * p.rayleigh_step, 1e-15);
    assert_true(p.resolution > 30);
    clast_world_free(w);
    w = chain_world(1, 1, 2000);
    p = clast_world_plan(w);
    CHECK_CLOSE(p.time_step, p.contact_time / 30, 1e-15);
    CHECK_CLOSE(p.resolution, 30.0, 1e-14);
    assert_true(p.time_step < p.rayleigh_step);
    clast_world_free(w);
}

/* The contact time of the plan is that of the collision that it foresees. */
static void contact_time_is_that_of_a_collision(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 1, 3.7);
    double m = 2650 * 4.0 / 3 * PI * 1e-6, e = 3.5e9 / (2 * 0.91), r = 0.005;
    double want = 2.9432751 * pow(15 * m / 2 / (16 * sqrt(r) * e), 0.4) * pow(3.7, -0.2);
    CHECK_CLOSE(clast_world_plan(w).contact_time, want, 1e-7);
    clast_world_free(w);
}

/* Without an expected speed: the fall through the domain. */
static void the_impact_speed_of_a_fall(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 1, 0);
    CHECK_CLOSE(clast_world_plan(w).impact_speed, sqrt(2 * 9.81 * 20), 1e-14);
    clast_world_free(w);
}

/* An undamped linear contact under leapfrog is stable up to the critical step, and not beyond. */
static void the_critical_step_is_the_limit_of_stability(void **state) {
    (void)state;
    for (int over = 0; over < 2; over++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        double r = 0.005, k = 310, mass = 1130 * 4.0 / 3 * PI * r * r * r;
        def.time_step = (over ? 1.02 : 0.98) * 2 / sqrt(2 * k / mass); /* two contacts at once */
        def.guards = CLAST_GUARD_REPORT;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        pair.stiffness = k;
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", r, m.soft);
        int part = clast_part_add(w, &(clast_part_def){.name = "press"});
        add_plane(w, part, m.hard, vec(0, 0, -0.9 * r), vec(0, 0, 1));
        add_plane(w, part, m.hard, vec(0, 0, 0.9 * r), vec(0, 0, -1));
        add_body(w, ball, vec(0, 0, 1e-6), vec(0, 0, 0), vec(0, 0, 0));
        double most = 0;
        for (int i = 0; i < 100; i++) {
            steps(w, 1);
            most = fmax(most, fabs(body_of(w, 0).position.z));
        }
        /* the plan foresees that two such balls meet: half the mass */
        CHECK_CLOSE(clast_world_plan(w).critical_step, 2 / sqrt(2 * k / mass), 1e-12);
        if (over)
            CHECK_BELOW(1e-4, most);
        else
            CHECK_BELOW(most, 1e-5);
        clast_world_free(w);
    }
}

/* ---- chains ---------------------------------------------------------------------------------- */

enum { CHAIN = 10 };

typedef struct press {
    clast_world *world;
    double mass, k; /* of the chain, of one contact */
} press;

/* Ten touching spheres, pressed between two plates along their whole length. */
static press press_chain(double step) {
    press p = {.k = 310};
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.contact_resolution = 5, def.time_step = step, def.guards = CLAST_GUARD_REPORT;
    p.world = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    pair.stiffness = p.k;
    two_materials m = add_materials(p.world, &pair);
    double r = 0.005, radius[CHAIN];
    clast_vec3 centre[CHAIN];
    for (int i = 0; i < CHAIN; i++) radius[i] = r, centre[i] = vec(r * (2 * i - CHAIN + 1), 0, 0);
    int chain = clast_shape_add(
        p.world, &(clast_shape_def){"chain", m.soft, CHAIN, centre, radius, 0, {0, 0, 0}, 0, NULL});
    int part = clast_part_add(p.world, &(clast_part_def){.name = "press"});
    add_plane(p.world, part, m.hard, vec(0, 0, -0.9 * r), vec(0, 0, 1));
    add_plane(p.world, part, m.hard, vec(0, 0, 0.9 * r), vec(0, 0, -1));
    add_body(p.world, chain, vec(0, 0, 1e-6), vec(0, 0, 0), vec(0, 1e-3, 0));
    p.mass = body_of(p.world, 0).mass;
    assert_int_equal(clast_world_prepare(p.world), CLAST_OK);
    return p;
}

/* m, how far the chain gets from the middle in 100 steps. */
static double excursion(clast_world *w) {
    double most = 0;
    for (int i = 0; i < 100; i++) {
        steps(w, 1);
        most = fmax(most, fabs(body_of(w, 0).position.z));
    }
    return most;
}

/* A fifth of the contact of a sphere that carries the whole mass of the chain is 2.8 times over the
 * square root of 20 contacts on it: beyond 2. The engine knows that ten touch at once. */
static void a_chain_is_lighter_than_its_mass(void **state) {
    (void)state;
    press p = press_chain(0);
    double alone = PI * sqrt(p.mass / p.k), inertia = 0;
    for (int i = 0; i < CHAIN; i++)
        inertia += p.mass / CHAIN * (0.4 + pow(2 * i - CHAIN + 1, 2)) * 0.005 * 0.005;
    clast_plan plan = clast_world_plan(p.world);
    double turning = 330 * 0.005 * 0.005 / inertia; /* sum of the arms squared, over I */
    CHECK_BELOW(turning, CHAIN / p.mass);           /* so the motion of the centre counts */
    CHECK_CLOSE(plan.contact_time, PI * sqrt(0.5 * p.mass / CHAIN / p.k), 1e-12);
    CHECK_CLOSE(plan.time_step, plan.contact_time / 5, 1e-12);
    CHECK_BELOW(excursion(p.world), 1e-5);
    clast_world_free(p.world);
    p = press_chain(alone / 5);
    CHECK_BELOW(1e-4, excursion(p.world));
    clast_world_free(p.world);
}

/* One sphere at the end of a lever: 1/m + a^2 / I, and in a plane about its axis alone. */
static void an_arm_makes_a_contact_lighter(void **state) {
    (void)state;
    for (int plane = 0; plane < 2; plane++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.motion = plane ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D, def.plane_axis = 1;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        clast_vec3 centre = {0.013, 0.004, 0}, inertia = {3e-8, 5e-8, 6e-8};
        double r = 0.005, mass = 1.3e-3;
        int shape = clast_shape_add(
            w, &(clast_shape_def){"lever", m.soft, 1, &centre, &r, mass, inertia, 0, NULL});
        add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, -1),
                  vec(0, 0, 1));
        add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        /* across x and y the normal z swings the arm about both axes: the stiffest direction is z
         * or lies in the plane of x and y, about z */
        double z = 0.004 * 0.004 / 3e-8 + 0.013 * 0.013 / 5e-8;
        double flat = (0.013 * 0.013 + 0.004 * 0.004) / 6e-8;
        double turning = plane ? 0.013 * 0.013 / 5e-8 : fmax(z, flat), one = 1 / mass + turning;
        double lightest = 0.5 / one; /* two of them meet */
        CHECK_CLOSE(clast_world_plan(w).contact_time, PI * sqrt(lightest / pair.stiffness), 1e-12);
        clast_world_free(w);
    }
}

static void time_is_counted_not_summed(void **state) {
    (void)state;
    clast_world *w = chain_world(1, 0.2, 1);
    steps(w, 12345);
    assert_true(clast_world_time(w) == 12345 * clast_world_time_step(w));
    double t = clast_world_time(w), dt = clast_world_time_step(w);
    run_to(w, t + 10 * dt);
    assert_true(clast_world_steps(w) == 12355);
    run_to(w, t); /* the past is no reason to step */
    assert_true(clast_world_steps(w) == 12355);
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(rayleigh_steps_of_the_chains),
          cmocka_unit_test(auto_takes_the_smaller_limit),
          cmocka_unit_test(contact_time_is_that_of_a_collision),
          cmocka_unit_test(the_impact_speed_of_a_fall),
          cmocka_unit_test(the_critical_step_is_the_limit_of_stability),
          cmocka_unit_test(a_chain_is_lighter_than_its_mass),
          cmocka_unit_test(an_arm_makes_a_contact_lighter),
          cmocka_unit_test(time_is_counted_not_summed))

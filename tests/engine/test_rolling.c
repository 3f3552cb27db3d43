/* Rolling friction (S12 2.53 with its erratum): what it takes from a rolling sphere, that it stops
 * spheres and drives none, and that action is reaction. */
#include "tests/support/bed.h"
#include "tests/support/collision.h"

static const double G = 9.79, RADIUS = 0.0043;

/* A sphere that rolls along x on a floor, sunk in as deep as its weight presses it. */
static clast_world *rolling_ball(clast_law law, double rolling, double speed, bool in_plane,
                                 clast_precision precision) {
    clast_world_def def = bare_def(law);
    def.gravity = vec(0, 0, -G), def.precision = precision;
    def.rayleigh_fraction = 1, def.contact_resolution = 60, def.impact_speed = 0.2;
    if (in_plane) def.motion = CLAST_MOTION_IN_PLANE;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.55, 0.6);
    pair.stiffness = 21000, pair.rolling_friction = rolling, pair.tangential_restitution = 0.3;
    two_materials m = add_materials(w, &pair);
    int shape = clast_shape_add_sphere(w, "ball", RADIUS, m.soft);
    int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_body(w, shape, vec(0, 0, RADIUS * 0.9999), vec(speed, 0, 0), vec(0, speed / RADIUS, 0));
    return w;
}

static double arm_of(clast_world *w) {
    clast_contact c;
    assert_int_equal(clast_world_contacts(w, &c, 1), 1);
    return RADIUS - 0.5 * c.overlap;
}

/* The couple mu m g R acts beside a friction f that keeps the sphere rolling: m a = -f and
 * I a / arm = f arm - mu m g R, so a = -mu m g R arm / (I + m arm^2), 5/7 mu g for a rigid
 * sphere. */
static void a_rolling_ball_slows_by_five_sevenths(void **state) {
    (void)state;
    double mu = 0.03;
    for (int l = 0; l < LAW_COUNT; l++)
        for (int kind = 0; kind < 3; kind++) {
            clast_world *w =
                rolling_ball(LAWS[l], mu, 0.12, kind == 1, (clast_precision)(kind == 2));
            run_to(w, 0.1);
            double v = body_of(w, 0).velocity.x, t = clast_world_time(w);
            run_to(w, 0.3);
            double a = (body_of(w, 0).velocity.x - v) / (clast_world_time(w) - t), arm = arm_of(w);
            CHECK_CLOSE(a, -mu * G * RADIUS * arm / (0.4 * RADIUS * RADIUS + arm * arm),
                        LAWS[l] == CLAST_LAW_WALTON_BRAUN ? 2e-3 : 1e-6); /* that one bobs on */

            assert_int_equal(contact_count(w), 1);
            clast_world_free(w);
        }
}

/* It stops where v^2 / (2 a) says, does not turn back, and lies still for good; what it had is
 * booked as friction, and at no time is there more than before. */
static void it_comes_to_rest_and_stays_there(void **state) {
    (void)state;
    for (int l = 0; l < LAW_COUNT; l++) {
        clast_world *w = rolling_ball(LAWS[l], 0.05, 0.05, false, CLAST_PRECISION_DOUBLE);
        assert_int_equal(clast_world_prepare(w), CLAST_OK);
        /* at the end the tangential spring lets go: its force over its stiffness, at least 5 kN/m
         */
        double recoil = 0.05 * body_of(w, 0).mass * G / 5e3;
        double start = motion_energy(w), energy = INFINITY, x = -1;
        for (int i = 0; i < 60; i++) {
            run_to(w, 0.005 * (i + 1));
            clast_energy e = clast_world_energy(w);
            double now = e.kinetic + e.rotational + e.gravity + e.elastic;
            CHECK_BELOW(now, energy + 1e-6 * start); /* error of integrating the bobbing */
            energy = now;
            CHECK_BELOW(x, body_of(w, 0).position.x + recoil);
            x = body_of(w, 0).position.x;
        }
        CHECK_CLOSE(x, 0.05 * 0.05 / (2 * 5.0 / 7 * 0.05 * G), 2e-2);
        body_state still = body_of(w, 0);
        CHECK_BELOW(hypot(still.velocity.x, still.velocity.y), 1e-9);
        CHECK_BELOW(norm(still.spin), 1e-7);
        clast_energy e = clast_world_energy(w);
        CHECK_CLOSE(e.friction, start, 2e-2);
        run_to(w, 1);
        CHECK_NEAR(body_of(w, 0).position.x, still.position.x, 1e-12);
        clast_world_free(w);
    }
}

/* A sphere at rest is not driven: not a bit of spin, of way, or of work. */
static void what_does_not_spin_is_not_driven(void **state) {
    (void)state;
    clast_world *w = rolling_ball(CLAST_LAW_HERTZ_MINDLIN, 0.7, 0, false, CLAST_PRECISION_DOUBLE);
    run_to(w, 0.2);
    body_state b = body_of(w, 0);
    assert_true(norm(b.spin) == 0 && b.position.x == 0 && b.position.y == 0);
    CHECK_BELOW(fabs(clast_world_energy(w).friction), 1e-12 * b.mass * G * RADIUS);
    clast_world_free(w);
}

/* ---- two spheres ----------------------------------------------------------------------------- */

/* Pressed together along z between smooth plates; spins about z see no sliding friction. */
static clast_world *pressed_pair(double ra, double rb, double mu, double spin_a, double spin_b) {
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.time_step = 2e-6;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.4), smooth = pair_of(0.5, 0);
    pair.rolling_friction = mu;
    two_materials m = add_materials(w, &pair);
    int plate = clast_material_add(w, &(clast_material_def){"plate", 1000, 1e7, 0.3});
    assert_int_equal(clast_pair_set(w, plate, m.soft, &smooth), CLAST_OK);
    assert_int_equal(clast_pair_set(w, plate, m.hard, &smooth), CLAST_OK);
    int a = clast_shape_add_sphere(w, "a", ra, m.soft),
        b = clast_shape_add_sphere(w, "b", rb, m.hard);
    int press = clast_part_add(w, &(clast_part_def){.name = "press"});
    double d = 0.01 * ra; /* overlap of each of the three equal contacts */
    add_plane(w, press, plate, vec(0, 0, 0), vec(0, 0, 1));
    add_plane(w, press, plate, vec(0, 0, 2 * ra + 2 * rb - 3 * d), vec(0, 0, -1));
    add_body(w, a, vec(0, 0, ra - d), vec(0, 0, 0), vec(0, 0, spin_a));
    add_body(w, b, vec(0, 0, 2 * ra + rb - 2 * d), vec(0, 0, 0), vec(0, 0, spin_b));
    return w;
}

/* The couple is mu F R* against the relative spin, equal and opposite on the two. */
static void two_spheres_share_their_spin(void **state) {
    (void)state;
    double ra = 0.004, rb = 0.0061, mu = 0.2;
    clast_world *w = pressed_pair(ra, rb, mu, 90, -40);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    body_state a = body_of(w, 0), b = body_of(w, 1);
    double ia = 0.4 * a.mass * ra * ra, ib = 0.4 * b.mass * rb * rb, all = 90 * ia - 40 * ib;
    double couple = mu * 31700 * 0.01 * ra * (ra * rb / (ra + rb)), t = 0;
    steps(w, 100);
    a = body_of(w, 0), b = body_of(w, 1), t = clast_world_time(w);
    CHECK_CLOSE(a.spin.z, 90 - couple * t / ia, 1e-9);
    CHECK_CLOSE(b.spin.z, -40 + couple * t / ib, 1e-9);
    assert_true(a.spin.x == 0 && a.spin.y == 0);
    run_to(w, 0.1);
    a = body_of(w, 0), b = body_of(w, 1);
    CHECK_CLOSE(a.spin.z, b.spin.z, 1e-9);
    CHECK_CLOSE(a.spin.z, all / (ia + ib), 1e-9);
    double lost = 0.5 * (ia * 8100 + ib * 1600) - 0.5 * all * all / (ia + ib);
    CHECK_CLOSE(clast_world_energy(w).friction, lost, 1e-5); /* half a kick at the start: README */
    clast_world_free(w);
}

/* Equal spheres, where the engine otherwise keeps the sum of the spins alone. */
static void equal_spheres_that_spin_alike_feel_nothing(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.4);
    pair.rolling_friction = 0.3;
    two_materials m = add_materials(w, &pair);
    int shape = clast_shape_add_sphere(w, "ball", RADIUS, m.soft);
    add_body(w, shape, vec(0, 0, 0.99 * RADIUS), vec(0, 0, 0), vec(0, 0, 70));
    add_body(w, shape, vec(0, 0, -0.99 * RADIUS), vec(0, 0, 0), vec(0, 0, 70));
    steps(w, 400);
    CHECK_CLOSE(body_of(w, 0).spin.z, 70.0, 1e-15);
    CHECK_CLOSE(body_of(w, 1).spin.z, 70.0, 1e-15);
    assert_true(contact_count(w) == 0); /* they have flown apart */
    clast_world_free(w);
}

/* ---- beds ------------------------------------------------------------------------------------ */

/* A heap of spheres and clumps loses more to friction with rolling friction than without, and
 * never gains: friction only grows. */
static void a_bed_only_loses(void **state) {
    (void)state;
    for (int l = 0; l < LAW_COUNT; l++) {
        bed_wish wish = {.threads = 1, .law = LAWS[l], .bodies = 40, .rolling = 0.4};
        clast_world *w = bed_new(&wish);
        double most = 0;
        for (int i = 0; i < 60; i++) {
            steps(w, 20);
            clast_energy e = clast_world_energy(w);
            CHECK_BELOW(most - 1e-4 * e.input, e.friction);
            most = fmax(most, e.friction);
        }
        assert_true(most > 0);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(a_rolling_ball_slows_by_five_sevenths),
          cmocka_unit_test(it_comes_to_rest_and_stays_there),
          cmocka_unit_test(what_does_not_spin_is_not_driven),
          cmocka_unit_test(two_spheres_share_their_spin),
          cmocka_unit_test(equal_spheres_that_spin_alike_feel_nothing),
          cmocka_unit_test(a_bed_only_loses))

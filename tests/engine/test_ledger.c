/* The energy ledger: its terms by hand, and a residual that falls with the step. */
#include "tests/support/collision.h"

static const double G = 9.81;

static clast_world *ball_over_floor(double restitution, double resolution, double height) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    def.domain_min = vec(-1, -1, -0.25), def.domain_max = vec(1, 1, 1);
    def.contact_resolution = resolution, def.rayleigh_fraction = 1;
    def.impact_speed = sqrt(2 * G * height);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(restitution, 0.3);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, 0.005 + height), vec(0, 0, 0), vec(0, 0, 0));
    return w;
}

/* Drop, hit, rise: every term against the formula. */
static void one_bounce_by_hand(void **state) {
    (void)state;
    double h = 0.0123, e = 0.72;
    clast_world *w = ball_over_floor(e, 1000, h);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double m = body_of(w, 0).mass;
    clast_energy start = clast_world_energy(w);
    CHECK_CLOSE(start.gravity, m * G * (0.25 + 0.005 + h), 1e-14);
    assert_true(start.elastic == 0 && start.damping == 0 && start.residual == 0);
    CHECK_NEAR(start.input, 0, 1e-6 * m * G * h);
    /* v(-1/2) v(1/2) / 2: minus the square of half a kick, which every later step shares */
    double half_kick = 0.5 * G * clast_world_time_step(w), offset = 0.5 * m * half_kick * half_kick;
    CHECK_CLOSE(start.kinetic, -offset, 1e-6); /* to the quantum of the sums */

    run_to(w, 0.9 * sqrt(2 * h / G));
    double t = clast_world_time(w);
    clast_energy falling = clast_world_energy(w);
    CHECK_CLOSE(falling.kinetic, 0.5 * m * G * G * t * t - offset, 1e-9);
    CHECK_CLOSE(falling.input, 0.5 * m * G * G * t * t - offset, 1e-9);
    assert_true(falling.damping == 0);
    CHECK_BELOW(fabs(falling.friction), 1e-12 * m * G * h);

    run_to(w, sqrt(2 * h / G) * (1 + 0.5 * e));
    clast_energy up = clast_world_energy(w);
    assert_true(up.elastic == 0 && contact_count(w) == 0 && body_of(w, 0).velocity.z > 0);
    double sunk =
        0.005 * clast_world_counters(w).overlap_max; /* gravity goes on working meanwhile */
    CHECK_CLOSE(up.damping, m * G * h * (1 - e * e), 1.2 * sunk / h);
    assert_true(up.rotational == 0 && up.wall_work == 0 && up.global == 0);
    CHECK_BELOW(fabs(up.friction), 1e-9 * m * G * h); /* the rest of the books: zero to rounding */
    CHECK_BELOW(fabs(up.residual), 1e-6 * m * G * h);
    clast_world_free(w);
}

/* Elastic energy at the deepest point: all of it, less what the weight adds. */
static void elastic_energy_at_the_turning_point(void **state) {
    (void)state;
    clast_world *w = ball_over_floor(1, 2000, 0.0123);
    run_to(w, 0.99 * sqrt(2 * 0.0123 / G));
    double m = body_of(w, 0).mass;
    while (body_of(w, 0).velocity.z <= 0) steps(w, 1);
    double sunk = 0.005 - body_of(w, 0).position.z;
    assert_true(sunk > 0);
    CHECK_CLOSE(elastic_energy(w), m * G * (0.0123 + sunk), 1e-5);
    clast_world_free(w);
}

/* Sliding to rest: all of the speed goes into friction, mu m g times the way. */
static void friction_is_booked_where_it_is_lost(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.23);
    two_materials m = add_materials(w, &pair);
    int sled = add_triangle(w, m.soft, 0.004);
    int part = clast_part_add(w, &(clast_part_def){.name = "floor"});
    add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    clast_body_add(w, &(clast_body_def){.shape = sled, .position = {0, 0, 0.004 * 0.9999},
                                        .orientation = {sqrt(0.5), sqrt(0.5), 0, 0},
                                        .velocity = {0.2, 0, 0}});
    run_to(w, 0.3);
    body_state b = body_of(w, 0);
    CHECK_NEAR(b.velocity.x, 0, 1e-7);
    CHECK_CLOSE(b.position.x, 0.2 * 0.2 / (2 * 0.23 * G), 1e-2);
    clast_energy e = clast_world_energy(w);
    CHECK_CLOSE(e.friction, 0.5 * b.mass * 0.2 * 0.2, 1e-2);
    CHECK_BELOW(fabs(e.residual), 1e-3 * e.input);
    clast_world_free(w);
}

/* ---- a settling bed -------------------------------------------------------------------------- */

enum { GRAINS = 36 };

static double settling_residual(double step, bool clumps) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    def.time_step = step;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.4);
    two_materials m = add_materials(w, &pair);
    int shapes[2] = {clast_shape_add_sphere(w, "ball", 0.005, m.soft),
                     clumps ? add_uneven_rod(w, m.hard, 0.0043)
                            : clast_shape_add_sphere(w, "b", 0.004, m.hard)};
    int part = clast_part_add(w, &(clast_part_def){.name = "box"});
    add_plane(w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    for (int i = 0; i < 4; i++) {
        double x = i < 2 ? (i ? 1 : -1) : 0, y = i < 2 ? 0 : (i - 2 ? 1 : -1);
        add_plane(w, part, m.hard, vec(-0.02 * x, -0.02 * y, 0), vec(x, y, 0.02));
    }
    dice d = {6, 0};
    for (int i = 0; i < GRAINS; i++) {
        clast_vec3 at = {0.0125 * (i % 3 - 1) + roll(&d, -4e-4, 4e-4),
                         0.0125 * (i / 3 % 3 - 1) + roll(&d, -4e-4, 4e-4),
                         0.0062 + 0.0125 * (i / 9)};
        clast_body_def b = {shapes[i % 2], at, any_orientation(&d), {0, 0, -0.3}, {0, 0, 0}};
        assert_true(clast_body_add(w, &b) >= 0);
    }
    run_to(w, 0.12);
    clast_energy e = clast_world_energy(w);
    double residual = fabs(e.residual) / e.input;
    clast_world_free(w);
    return residual;
}

/* With the work of old forces taken at the new contact points, clumps came to order 1.4. */
static void the_residual_of_a_bed_falls_with_the_step(void **state) {
    (void)state;
    for (int clumps = 0; clumps < 2; clumps++) {
        double a = settling_residual(2e-5, clumps), b = settling_residual(5e-6, clumps),
               c = settling_residual(1.25e-6, clumps);
        print_message(
            "bed of %s: residual %.1e at 20 us, %.1e at 5 us, %.1e at 1.25 us, order %.2f\n",
            clumps ? "clumps" : "spheres", a, b, c, order_of(a, c, 16));
        CHECK_BELOW(a, 5e-3);
        CHECK_NEAR(order_of(a, c, 16), 2, 0.1);
    }
}

/* One damped oblique impact: second order in the step, both limits. */
static void the_residual_of_an_impact_is_second_order(void **state) {
    (void)state;
    for (int l = 0; l < LAW_COUNT; l++) {
        /* of a law that yields, the place of the largest overlap within a step scatters more */
        bool yields = clast_law_info_of(LAWS[l])->yields;
        double sum[2] = {0, 0}, resolution[2] = {yields ? 100 : 50, yields ? 3200 : 400};
        for (int fine = 0; fine < 2; fine++)
            for (int i = 0; i < 8; i++) {
                collision c = {.law = LAWS[l], .pair = pair_of(0.6, 0.3), .angle = 0.7, .spin = 140,
                               .resolution = resolution[fine], .phase = 0.06 + 0.125 * i};
                rebound r = collide(&c);
                sum[fine] += fabs(r.residual) / r.energy_before / 8;
            }
        double order = order_of(sum[0], sum[1], resolution[1] / resolution[0]);
        print_message("%s: residual of an impact %.1e at %g steps, %.1e at %g, order %.2f\n",
                      LAW_NAMES[l], sum[0], resolution[0], sum[1], resolution[1], order);
        CHECK_BELOW(1.75, order);
        CHECK_BELOW(sum[0], 1e-3);
    }
}

TEST_MAIN(cmocka_unit_test(one_bounce_by_hand),
          cmocka_unit_test(elastic_energy_at_the_turning_point),
          cmocka_unit_test(friction_is_booked_where_it_is_lost),
          cmocka_unit_test(the_residual_of_a_bed_falls_with_the_step),
          cmocka_unit_test(the_residual_of_an_impact_is_second_order))

/* Oblique impacts and moving contacts against rigid-body formulas. */
#include "tests/support/collision.h"

static const double PI = 3.14159265358979323846, G = 9.79;

/* ---- oblique impact -----------------------------------------------------------------------------
 */

/* Grazing impacts slide all along: the tangential impulse is mu times the normal one, and the spin
 * gains 5/2 of it over m r (Walton's sliding branch); the arm is shorter by at most half the
 * overlap. */
static void a_grazing_impact_slides(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        collision c = {.law = LAWS[l], .pair = pair_of(0.72, 0.13), .against_plane = true,
                       .angle = 71 * PI / 180, .resolution = 400, .phase = 0.6};
        rebound r = collide(&c);
        CHECK_CLOSE(r.tangential_impulse, -0.13 * r.normal_impulse, 1e-12);
        double mass = r.effective_mass, radius = r.effective_radius;
        double spin = 2.5 * 0.13 * r.normal_impulse / (mass * radius);
        CHECK_BELOW(r.spin.y, spin);
        CHECK_BELOW(spin * (1 - 0.5 * r.overlap_max / radius), r.spin.y);
    }
}

/* Two unequal spheres: the same in the frame of the pair. */
static void unequal_spheres_slide_likewise(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_HERTZ_MINDLIN, .pair = pair_of(0.9, 0.07), .angle = 1.2,
                   .resolution = 300, .phase = 0.1};
    rebound r = collide(&c);
    /* during the contact the line of centres turns by about speed * duration / distance */
    double turn = 0.83 * sin(1.2) * r.duration / 0.0084;
    CHECK_CLOSE(r.tangential_impulse, -0.07 * r.normal_impulse, 2 * turn / 0.07);
}

/* A spinning ball dropped without sideways speed kicks off with mu times the normal impulse. */
static void a_spinning_ball_kicks_off(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_HERTZ_A00, .pair = pair_of(0.55, 0.11), .against_plane = true,
                   .spin = 900, .resolution = 400};
    rebound r = collide(&c);
    CHECK_CLOSE(r.tangential_impulse, 0.11 * r.normal_impulse, 1e-12);
}

/* Sticking throughout needs enough friction: then the rebound no longer depends on it. */
static void a_sticking_impact_forgets_the_coefficient(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_LINEAR, .pair = pair_of(1, 40), .against_plane = true,
                   .angle = 0.2, .resolution = 400};
    double a = collide(&c).tangential_impulse;
    c.pair.friction = 57;
    CHECK_CLOSE(collide(&c).tangential_impulse, a, 1e-9);
    CHECK_BELOW(fabs(a), 0.13 * collide(&c).normal_impulse * 40);
}

/* A00 1.73: the limit of friction counts the spring of the normal force, not its dashpot. Of a
 * linear contact that is J = m v (1 + e) - 2 zeta^2 e m v: the dashpot's share until the force ends
 * is c delta = c^2 e v / k, and half of it comes back while the spring, at rest, comes out. */
static void the_limit_may_leave_out_the_dashpot(void **state) {
    (void)state;
    for (double e = 0.35; e < 1; e += 0.3) {
        collision c = {.law = CLAST_LAW_LINEAR, .pair = pair_of(e, 0.13), .against_plane = true,
                       .limit = CLAST_LIMIT_SPRING, .angle = 71 * PI / 180, .resolution = 3000};
        rebound r = collide(&c);
        double zeta = clast_damping_ratio(CLAST_LAW_LINEAR, e);
        double towards = r.normal_impulse / (1 + e); /* m v */
        double want = 0.13 * towards * (1 + e - 2 * zeta * zeta * e);
        CHECK_CLOSE(r.tangential_impulse, -want, 1e-3);
        CHECK_BELOW(-r.tangential_impulse, 0.13 * r.normal_impulse * (1 - zeta * zeta * e / 2));
    }
}

/* A00 1.71: C counts for as long as the spheres touch. */
static void cohesion_adds_to_the_limit(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        collision c = {.law = LAWS[l], .pair = pair_of(0.72, 0.13), .against_plane = true,
                       .angle = 71 * PI / 180, .resolution = 3000, .phase = 0.6};
        rebound without = collide(&c);
        double mean = without.normal_impulse / without.duration; /* N */
        c.pair.cohesion = 0.21 * mean;
        rebound with = collide(&c);
        CHECK_CLOSE(with.normal_impulse, without.normal_impulse, 1e-12);
        CHECK_CLOSE(with.tangential_impulse, -(0.13 + 0.21) * without.normal_impulse, 1e-3);
    }
}

/* ---- an incline ------------------------------------------------------------------------------ */

typedef struct slope {
    clast_world *w;
    double radius;
} slope;

/* A ball on a plane that is tilted by turning gravity; x points downhill. */
static slope ball_on_slope(clast_law law, double angle, double friction, double cohesion,
                           double resolution) {
    clast_world_def def = bare_def(law);
    def.gravity = vec(G * sin(angle), 0, -G * cos(angle));
    def.contact_resolution = resolution;
    def.rayleigh_fraction = 1;
    slope s = {new_world(&def), 0.0043};
    clast_pair_def pair = pair_of(0.55, friction);
    pair.stiffness = 2100, pair.cohesion = cohesion;
    two_materials m = add_materials(s.w, &pair);
    int ball = clast_shape_add_sphere(s.w, "ball", s.radius, m.soft);
    int part = clast_part_add(s.w, &(clast_part_def){.name = "slope"});
    add_plane(s.w, part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_body(s.w, ball, vec(0, 0, s.radius * 0.9999), vec(0, 0, 0), vec(0, 0, 0));
    return s;
}

/* Mean acceleration along x between two times, after the settling. */
static double acceleration(clast_world *w, double from, double until) {
    run_to(w, from);
    double v0 = body_of(w, 0).velocity.x, t0 = clast_world_time(w);
    run_to(w, until);
    return (body_of(w, 0).velocity.x - v0) / (clast_world_time(w) - t0);
}

/* 5/7 g sin for a rigid ball; the contact point is half the overlap nearer to the centre. */
static void a_ball_rolls_with_five_sevenths(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        slope s = ball_on_slope(LAWS[l], 0.21, 0.61, 0, 40);
        double a = acceleration(s.w, 0.1, 0.3);
        clast_contact c;
        assert_int_equal(clast_world_contacts(s.w, &c, 1), 1);
        double arm = s.radius - 0.5 * c.overlap, inertia = 0.4 * s.radius * s.radius / (arm * arm);
        CHECK_CLOSE(a, G * sin(0.21) / (1 + inertia), 2e-6);
        CHECK_CLOSE(a, 5.0 / 7 * G * sin(0.21), 1e-3);
        body_state b = body_of(s.w, 0);
        CHECK_CLOSE(b.spin.y * arm, b.velocity.x, 1e-5);
        clast_world_free(s.w);
    }
}

static void a_ball_slides_down_a_steep_slope(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        double mu = 0.09, angle = 0.63; /* tan 0.63 = 0.73 > 7/2 mu: slips */
        slope s = ball_on_slope(LAWS[l], angle, mu, 0, 40);
        CHECK_CLOSE(acceleration(s.w, 0.05, 0.2), G * (sin(angle) - mu * cos(angle)), 1e-6);
        clast_world_free(s.w);
    }
}

/* A00 1.71: mu N + C holds back. */
static void cohesion_brakes_a_sliding_ball(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        double mu = 0.09, angle = 0.63, pull = 0.37; /* m/s2, of cohesion over mass */
        double mass = 1130 * 4.0 / 3 * PI * pow(0.0043, 3);
        slope s = ball_on_slope(LAWS[l], angle, mu, pull * mass, 40);
        double want = G * (sin(angle) - mu * cos(angle)) - pull;
        CHECK_CLOSE(acceleration(s.w, 0.05, 0.2), want, 1e-6);
        clast_world_free(s.w);
    }
}

/* The spin of the slipping ball grows with 5/2 mu g cos / r. */
static void a_slipping_ball_spins_up(void **state) {
    (void)state;
    slope s = ball_on_slope(CLAST_LAW_HERTZ_MINDLIN, 0.63, 0.09, 0, 40);
    run_to(s.w, 0.05);
    double w0 = body_of(s.w, 0).spin.y, t0 = clast_world_time(s.w);
    run_to(s.w, 0.2);
    double rate = (body_of(s.w, 0).spin.y - w0) / (clast_world_time(s.w) - t0);
    CHECK_CLOSE(rate, 2.5 * 0.09 * G * cos(0.63) / s.radius, 1e-3);
    clast_world_free(s.w);
}

/* ---- belts and moving plates ----------------------------------------------------------------- */

typedef struct carried {
    clast_world *w;
    int part;
    double radius;
} carried;

static carried block_on(clast_vec3 belt, clast_vec3 part_velocity, double move_until) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    def.rayleigh_fraction = 1;
    carried s = {.w = new_world(&def), .radius = 0.0037};
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(s.w, &pair);
    int block = add_triangle(s.w, m.soft, s.radius);
    s.part = clast_part_add(s.w, &(clast_part_def){.name = "carrier", .velocity = part_velocity,
                                                   .move_until = move_until});
    clast_wall_add(s.w, s.part, &(clast_wall_def){"plate", CLAST_WALL_PLATE, m.hard, {0, 0, 0},
                                                  {0, 0, 2}, {3, 0, 0}, {5, 5}, belt});
    clast_body_add(s.w, &(clast_body_def){.shape = block, .position = {0, 0, s.radius * 1.01},
                                          .orientation = {sqrt(0.5), sqrt(0.5), 0, 0}});
    return s;
}

/* A00 3.5: a body put down on a belt reaches the speed of the belt. */
static void a_belt_carries_a_clump(void **state) {
    (void)state;
    carried s = block_on(vec(0.01, 0.004, 0), vec(0, 0, 0), 0);
    run_to(s.w, 0.4);
    body_state b = body_of(s.w, 0);
    CHECK_NEAR(b.velocity.x, 0.01, 1e-8);
    CHECK_NEAR(b.velocity.y, 0.004, 1e-8);
    CHECK_NEAR(norm(b.spin), 0, 1e-6);
    clast_vec3 offset = clast_world_part_offset(s.w, s.part);
    assert_true(offset.x == 0 && offset.y == 0);
    clast_world_free(s.w);
}

static void a_moving_plate_carries_a_clump(void **state) {
    (void)state;
    carried s = block_on(vec(0, 0, 0), vec(0, 0.013, 0), 0);
    run_to(s.w, 0.4);
    CHECK_NEAR(body_of(s.w, 0).velocity.y, 0.013, 1e-8);
    CHECK_CLOSE(clast_world_part_offset(s.w, s.part).y, 0.013 * clast_world_time(s.w), 1e-14);
    /* what the plate did went into motion and friction */
    clast_energy e = clast_world_energy(s.w);
    CHECK_CLOSE(clast_world_part_load(s.w, s.part).work, e.wall_work, 1e-12);
    double mass = body_of(s.w, 0).mass;
    CHECK_CLOSE(e.wall_work, mass * 0.013 * 0.013, 2e-3); /* half of it is lost in sliding */
    clast_world_free(s.w);
}

static void a_plate_that_stops_lets_the_clump_stop(void **state) {
    (void)state;
    carried s = block_on(vec(0, 0, 0), vec(0.02, 0, 0), 0.2);
    run_to(s.w, 0.6);
    CHECK_NEAR(norm(body_of(s.w, 0).velocity), 0, 1e-8);
    CHECK_NEAR(clast_world_part_offset(s.w, s.part).x, 0.004, 1e-15);
    clast_energy e = clast_world_energy(s.w);
    CHECK_BELOW(fabs(e.residual), 2e-3 * e.input);
    clast_world_free(s.w);
}

/* A wall that lifts a ball: its work is the ball's gain in height and motion. */
static void lifting_work_is_energy_gained(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.3, 0.4);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    int lift = clast_part_add(w, &(clast_part_def){.name = "lift", .velocity = {0, 0, 0.03},
                                                   .move_from = 0.01, .move_until = 0.21});
    add_plane(w, lift, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, 0.005), vec(0, 0, 0), vec(0, 0, 0));
    run_to(w, 0.009);
    double low = body_of(w, 0).position.z;
    run_to(w, 0.4);
    body_state b = body_of(w, 0);
    CHECK_NEAR(b.position.z - low, 0.006, 2e-7);
    clast_energy e = clast_world_energy(w);
    CHECK_BELOW(fabs(e.residual), 1e-3 * b.mass * G * 0.006);
    CHECK_CLOSE(e.wall_work - e.damping, b.mass * G * (b.position.z - 0.005) + e.elastic, 1e-2);
    clast_part_load load = clast_world_part_load(w, lift);
    CHECK_CLOSE(load.force.z, -b.mass * G, 1e-6);
    CHECK_CLOSE(load.work, e.wall_work, 1e-12);
    clast_world_free(w);
}

/* The wall comes to a ball at rest, far outside of the pair list that was built at the start. */
static void a_wall_finds_a_body_at_rest(void **state) {
    (void)state;
    for (int kind = 0; kind < 2; kind++) {
        clast_world_def def = bare_def(CLAST_LAW_LINEAR);
        def.contact_resolution = 200;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
        int ram = clast_part_add(w, &(clast_part_def){.name = "ram", .velocity = {0.31, 0, 0}});
        clast_wall_add(w, ram, &(clast_wall_def){"face", kind ? CLAST_WALL_PLATE : CLAST_WALL_PLANE,
                                                 m.hard, {-0.05, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                                 {0.1, 0.1}, {0, 0, 0}});
        add_body(w, ball, vec(0, 0, 0), vec(0, 0, 0), vec(0, 0, 0));
        run_to(w, 0.2);
        CHECK_CLOSE(body_of(w, 0).velocity.x, 0.62, 3e-6); /* elastic: twice the wall's speed */
        clast_energy e = clast_world_energy(w);
        CHECK_CLOSE(e.wall_work, 0.5 * body_of(w, 0).mass * 0.62 * 0.62, 1e-5);
        clast_world_free(w);
    }
}

TEST_MAIN(cmocka_unit_test(a_grazing_impact_slides),
          cmocka_unit_test(unequal_spheres_slide_likewise),
          cmocka_unit_test(a_spinning_ball_kicks_off),
          cmocka_unit_test(a_sticking_impact_forgets_the_coefficient),
          cmocka_unit_test(the_limit_may_leave_out_the_dashpot),
          cmocka_unit_test(cohesion_adds_to_the_limit),
          cmocka_unit_test(a_ball_rolls_with_five_sevenths),
          cmocka_unit_test(cohesion_brakes_a_sliding_ball),
          cmocka_unit_test(a_ball_slides_down_a_steep_slope),
          cmocka_unit_test(a_slipping_ball_spins_up), cmocka_unit_test(a_belt_carries_a_clump),
          cmocka_unit_test(a_moving_plate_carries_a_clump),
          cmocka_unit_test(a_plate_that_stops_lets_the_clump_stop),
          cmocka_unit_test(lifting_work_is_energy_gained),
          cmocka_unit_test(a_wall_finds_a_body_at_rest))

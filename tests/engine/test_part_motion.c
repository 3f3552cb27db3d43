/* Parts that move: places by formula, what they do to bodies by analytic solutions, and books that
 * close. */
#include "tests/support/scene.h"

static const double G = 9.81, R = 0.005;
#define TURN 6.283185307179586

/* ---- places ---------------------------------------------------------------------------------- */

typedef struct stand {
    clast_world *w;
    int part, ball;
} stand;

/* One part of this motion with a floor at z = 0, and a ball. */
static stand new_stand(const clast_part_def *part, clast_law law, double friction, double step,
                       clast_vec3 gravity) {
    clast_world_def def = bare_def(law);
    def.gravity = gravity;
    def.time_step = step;
    def.domain_min = vec(-1, -1, -1), def.domain_max = vec(1, 1, 1);
    stand s = {.w = new_world(&def)};
    clast_pair_def pair = pair_of(0.5, friction);
    two_materials m = add_materials(s.w, &pair);
    s.ball = clast_shape_add_sphere(s.w, "ball", R, m.soft);
    s.part = clast_part_add(s.w, part);
    if (s.part < 0) fail_msg("%s", clast_world_error(s.w));
    add_plane(s.w, s.part, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    return s;
}

static stand empty_stand(const clast_part_def *part) {
    stand s = new_stand(part, CLAST_LAW_LINEAR, 0, 1e-3, vec(0, 0, 0));
    add_body(s.w, s.ball, vec(0, 0, 0.9), vec(0, 0, 0), vec(0, 0, 0));
    return s;
}

/* Out, pause, back, pause, written down a second time. */
static double stroke_place(double t, double length, double speed, double pause, double phase) {
    double leg = length / speed, period = 2 * (leg + pause);
    double s = fmod(t + phase * period, period);
    if (s < leg) return speed * s;
    if (s < leg + pause) return length;
    if (s < 2 * leg + pause) return length - speed * (s - leg - pause);
    return 0;
}

static void a_stroke_goes_out_and_back(void **state) {
    (void)state;
    clast_part_def part = {.name = "bar", .move_from = 0.2, .move_until = 31.7,
                           .stroke = {{0.018, 0, 0.024}, 0.021, 0.35, 0.15}};
    stand s = empty_stand(&part);
    for (int i = 0; i < 400; i++) {
        steps(s.w, 100);
        double t = clast_world_time(s.w), u = fmin(fmax(t - 0.2, 0), 31.5);
        double want = stroke_place(u, 0.03, 0.021, 0.35, 0.15);
        clast_vec3 at = clast_world_part_offset(s.w, s.part);
        CHECK_NEAR(at.x, 0.6 * want, 1e-15);
        CHECK_NEAR(at.z, 0.8 * want, 1e-15);
    }
    clast_world_free(s.w);
}

static void an_oscillation_is_a_sine(void **state) {
    (void)state;
    clast_part_def part = {.name = "shaker", .velocity = {0.01, 0, 0},
                           .oscillation = {{0, 0.002, 0.001}, 3.7, 0.3}};
    stand s = empty_stand(&part);
    for (int i = 0; i < 100; i++) {
        steps(s.w, 37);
        double t = clast_world_time(s.w), sine = sin(TURN * (3.7 * t + 0.3));
        clast_vec3 at = clast_world_part_offset(s.w, s.part);
        CHECK_NEAR(at.x, 0.01 * t, 1e-15);
        CHECK_NEAR(at.y, 0.002 * sine, 1e-15);
        CHECK_NEAR(at.z, 0.001 * sine, 1e-15);
    }
    clast_world_free(s.w);
}

/* A point of the part turns about its axis, which the part takes along. */
static void a_rotation_turns_about_its_axis(void **state) {
    (void)state;
    clast_part_def part = {.name = "drum", .velocity = {0, 0.02, 0},
                           .rotation = {{0.1, 0.2, 0.3}, {0, 0, 3}, 2.5, 0.4, 1.3, 0.1}};
    stand s = empty_stand(&part);
    for (int i = 0; i < 100; i++) {
        steps(s.w, 91);
        double t = clast_world_time(s.w);
        double angle = 2.5 * t + 0.4 * sin(TURN * (1.3 * t + 0.1));
        clast_pose pose = clast_world_part_pose(s.w, s.part);
        clast_vec3 at = clast_pose_apply(pose, vec(0.1 + 0.05, 0.2, 0.7));
        CHECK_NEAR(at.x, 0.1 + 0.05 * cos(angle), 1e-14);
        CHECK_NEAR(at.y, 0.2 + 0.05 * sin(angle) + 0.02 * t, 1e-14);
        CHECK_NEAR(at.z, 0.7, 1e-15);
    }
    clast_world_free(s.w);
}

/* ---- a table is what it says ----------------------------------------------------------------- */

static clast_vec3 carried_by(const clast_part_def *part) {
    stand s = new_stand(part, CLAST_LAW_HERTZ_MINDLIN, 0.5, 2e-5, vec(0, 0, -G));
    add_body(s.w, s.ball, vec(0, 0, R), vec(0, 0, 0), vec(0, 0, 0));
    run_to(s.w, 0.9);
    clast_vec3 at = body_of(s.w, 0).position;
    assert_true(clast_world_part_load(s.w, s.part).work > 0);
    clast_world_free(s.w);
    return at;
}

static void a_table_can_say_what_a_stroke_does(void **state) {
    (void)state;
    static const double time[5] = {0, 0.25, 0.35, 0.6, 0.7};
    static const clast_vec3 offset[5] = {
        {0, 0, 0}, {0.005, 0, 0}, {0.005, 0, 0}, {0, 0, 0}, {0, 0, 0}};
    clast_part_def stroke = {.name = "bar", .move_from = 0.1,
                             .stroke = {{0.005, 0, 0}, 0.02, 0.1, 0}};
    clast_part_def table = {.name = "bar", .move_from = 0.1, .table = {5, time, offset, NULL}};
    clast_vec3 a = carried_by(&stroke), b = carried_by(&table);
    assert_true(fabs(a.x) > 1e-4);
    /* the stroke sets out again at 0.8 s, behind the end of the table */
    clast_part_def once = stroke;
    once.move_until = 0.8;
    clast_vec3 c = carried_by(&once);
    CHECK_NEAR(b.x, c.x, 1e-9);
    CHECK_NEAR(b.z, c.z, 1e-12);
    assert_true(fabs(a.x - b.x) > 1e-5);
}

/* ---- what they do to bodies ------------------------------------------------------------------ */

/* A ball that rolls on a turntable goes round in circles at 2/7 of its speed, wherever it starts:
 * the contact moves with the table, and the moment of inertia is 2/5 m r^2. The rate is a / (1 + a)
 * of it with a = 2/5 r^2 / l^2 and l the height of its centre over the contact, which is half the
 * overlap below r. */
static void check_turntable(clast_precision precision, double tolerance) {
    double spin = 7, weight = 2610 * TURN * 2 / 3 * R * R * R;
    double e_star = 61e6 / (2 * (1 - 0.23 * 0.23));
    double overlap = pow(0.75 * weight / (e_star * sqrt(R)), 2.0 / 3), lever = R - 0.5 * overlap;
    double a = 0.4 * R * R / (lever * lever), rate = spin * a / (1 + a), period = TURN / rate;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -1);
    def.precision = precision;
    def.time_step = 2e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.5, 0.8);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.hard);
    clast_part_def part = {.name = "table", .rotation = {.axis = {0, 0, 1}, .speed = spin}};
    int table = clast_part_add(w, &part);
    add_plane(w, table, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    clast_vec3 r = vec(0.03, 0.01, R - overlap), v = vec(0.02, -0.05, 0);
    /* v + w x (-l z) is the velocity of the table there */
    clast_vec3 surface = cross(vec(0, 0, spin), r), slip = minus(surface, v);
    add_body(w, ball, r, v, vec(slip.y / lever, -slip.x / lever, 0));
    clast_vec3 centre = vec(r.x - v.y / rate, r.y + v.x / rate, R);
    for (int quarter = 1; quarter <= 4; quarter++) {
        run_to(w, 0.25 * quarter * period);
        double turned = rate * clast_world_time(w), c = cos(turned), s = sin(turned);
        clast_vec3 arm = minus(r, centre);
        body_state b = body_of(w, 0);
        double x = centre.x + c * arm.x - s * arm.y, y = centre.y + s * arm.x + c * arm.y;
        CHECK_BELOW(hypot(b.position.x - x, b.position.y - y), tolerance);
    }
    clast_world_free(w);
}

static void a_ball_circles_on_a_turntable(void **state) {
    (void)state;
    check_turntable(CLAST_PRECISION_DOUBLE, 5e-6); /* 3e-5 of the way */
    check_turntable(CLAST_PRECISION_MIXED, 5e-6);
}

/* A paddle through the axis pushes a smooth ball outwards: x'' = W^2 x along it, by the force
 * m (2 W x' - W^2 R) on its centre, which is R in front of the axis. */
static void a_paddle_throws_a_ball_out(void **state) {
    (void)state;
    double spin = 3.1, x0 = 0.05, v0 = 0.06; /* fast enough for the force to push */
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.time_step = 1e-5;
    def.max_overlap = 0.5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.05, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_part_def part = {.name = "paddle", .rotation = {.axis = {0, 0, 1}, .speed = spin}};
    int paddle = clast_part_add(w, &part);
    clast_wall_def plate = {"blade", CLAST_WALL_PLATE, m.hard, {0.2, 0, 0}, {0, 1, 0},
                            {1, 0, 0}, {0.2, 0.05}, {0, 0, 0}};
    assert_true(clast_wall_add(w, paddle, &plate) >= 0);
    add_body(w, ball, vec(x0, R, 0), vec(v0 - spin * R, spin * x0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double start = motion_energy(w);
    for (int i = 1; i <= 5; i++) {
        run_to(w, 0.1 * i);
        double t = clast_world_time(w), c = cos(spin * t), s = sin(spin * t);
        double x = x0 * cosh(spin * t) + v0 / spin * sinh(spin * t);
        double v = spin * x0 * sinh(spin * t) + v0 * cosh(spin * t);
        body_state b = body_of(w, 0);
        CHECK_NEAR(b.position.x, c * x - s * R, 2e-5);
        CHECK_NEAR(b.position.y, s * x + c * R, 2e-5);
        clast_part_load load = clast_world_part_load(w, paddle);
        double force = b.mass * (2 * spin * v - spin * spin * R);
        CHECK_CLOSE(load.power, force * spin * x, 1e-3);
        CHECK_CLOSE(load.torque.z * spin, -load.power, 1e-9);
        clast_energy e = clast_world_energy(w);
        CHECK_CLOSE(load.work, e.wall_work, 1e-12);
        CHECK_NEAR(e.wall_work - e.damping - e.friction - e.elastic, e.kinetic - start,
                   1e-4 * e.kinetic);
        CHECK_NEAR(e.friction, 0, 1e-7 * e.kinetic); /* there is none */
    }
    clast_world_free(w);
}

/* A sphere that stands off from the wall of a turning drum is felt where the wall is now. */
static void a_turning_plane_sweeps(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.time_step = 1e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_part_def part = {.name = "door", .rotation = {.axis = {0, 0, 1}, .speed = 2}};
    int door = clast_part_add(w, &part);
    add_plane(w, door, m.hard, vec(0, 0, 0), vec(0, 1, 0));
    add_body(w, ball, vec(0.1, 0.03, 0), vec(0, 0, 0), vec(0, 0, 0));
    run_to(w, 0.12); /* reached at about 0.12 s: (0.03 - R) = 0.1 tan(2 t) */
    CHECK_NEAR(norm(body_of(w, 0).velocity), 0, 0);
    run_to(w, 0.2);
    body_state b = body_of(w, 0);
    /* elastic: twice the speed of the wall where it struck, along its normal there */
    double angle = atan2(0.03, 0.1) - asin(R / hypot(0.1, 0.03));
    double speed = 2 * 2 * sqrt(0.1 * 0.1 + 0.03 * 0.03 - R * R);
    CHECK_NEAR(b.velocity.x, -speed * sin(angle), 2e-3 * speed);
    CHECK_NEAR(b.velocity.y, speed * cos(angle), 2e-3 * speed);
    clast_world_free(w);
}

/* ---- books ----------------------------------------------------------------------------------- */

typedef struct books {
    double friction, residual; /* of the work without sign */
    double work;               /* J */
} books;

/* A smooth ball bounces on a shaken floor: nothing rubs, so what the books call friction is what
 * they lost of the floor's work. That is a term of third order in the step at the onset of a
 * contact, whose way is booked by the speed in the middle of the step. */
static books shaken(double step, clast_scheme scheme) {
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    def.gravity = vec(0, 0, -G);
    def.time_step = step;
    def.scheme = scheme;
    def.domain_min = vec(-1, -1, -1), def.domain_max = vec(1, 1, 1);
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.6, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", R, m.soft);
    clast_part_def part = {.name = "floor", .oscillation = {{0, 0, 0.0012}, 31, 0}};
    int floor = clast_part_add(w, &part);
    add_plane(w, floor, m.hard, vec(0, 0, 0), vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, R), vec(0, 0, 0), vec(0, 0, 0));
    run_to(w, 1);
    clast_energy e = clast_world_energy(w);
    double change = e.kinetic + e.gravity + e.elastic + e.damping + e.friction;
    books b = {fabs(e.friction) / e.input, fabs(e.residual) / e.input, e.wall_work};
    CHECK_CLOSE(clast_world_part_load(w, floor).work, e.wall_work, 1e-12);
    assert_true(e.damping > 0 && e.wall_work > 0 && change > 0);
    clast_world_free(w);
    return b;
}

static void a_shaken_floor_gives_what_it_books(void **state) {
    (void)state;
    books coarse = shaken(2e-5, CLAST_SCHEME_LEAPFROG), fine = shaken(1e-5, CLAST_SCHEME_LEAPFROG);
    print_message("shaken floor: residual %.2e and %.2e, friction %.1e and %.1e of the input\n",
                  coarse.residual, fine.residual, coarse.friction, fine.friction);
    CHECK_BELOW(coarse.friction, 1e-6);
    CHECK_BELOW(fine.friction, 1e-6);
    CHECK_BELOW(fine.residual, 1e-3);
    /* velocity Verlet books an onset by the speed at its end, on a floor at rest likewise */
    books other = shaken(2e-5, CLAST_SCHEME_VELOCITY_VERLET);
    CHECK_BELOW(other.friction, 5e-3);
    CHECK_BELOW(other.residual, 1e-3);
}

/* A belt runs in the time of its part. */
static void a_belt_starts_and_stops(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -G);
    def.time_step = 2e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.3, 0.5);
    two_materials m = add_materials(w, &pair);
    int block = add_triangle(w, m.soft, R);
    clast_part_def part = {.name = "conveyor", .move_from = 0.1, .move_until = 0.5};
    int conveyor = clast_part_add(w, &part);
    clast_wall_def belt = {.name = "belt", .material = m.hard, .normal = {0, 0, 1},
                           .belt_velocity = {0.05, 0, 0}};
    assert_true(clast_wall_add(w, conveyor, &belt) >= 0);
    clast_body_def lies = {.shape = block, .position = {0, 0, R * 1.001},
                           .orientation = {sqrt(0.5), sqrt(0.5), 0, 0}};
    assert_true(clast_body_add(w, &lies) >= 0);
    run_to(w, 0.1);
    CHECK_NEAR(body_of(w, 0).velocity.x, 0, 1e-6);
    run_to(w, 0.5);
    CHECK_CLOSE(body_of(w, 0).velocity.x, 0.05, 1e-4);
    run_to(w, 0.8);
    CHECK_NEAR(body_of(w, 0).velocity.x, 0, 1e-6);
    clast_energy e = clast_world_energy(w);
    CHECK_CLOSE(clast_world_part_load(w, conveyor).work, e.wall_work, 1e-12);
    CHECK_BELOW(0, e.wall_work);
    clast_world_free(w);
}

/* ---- what is refused ------------------------------------------------------------------------- */

static void a_wall_that_leaps_stops_the_run(void **state) {
    (void)state;
    clast_part_def part = {.name = "ram", .velocity = {0, 0, 300}, .move_from = 0.01};
    stand s = new_stand(&part, CLAST_LAW_LINEAR, 0, 1e-5, vec(0, 0, 0));
    clast_wall_def plate = {"face", CLAST_WALL_PLATE, 1, {0, 0, -0.5}, {0, 0, 1},
                            {1, 0, 0}, {0.1, 0.1}, {0, 0, 0}};
    assert_true(clast_wall_add(s.w, s.part, &plate) >= 0);
    add_body(s.w, s.ball, vec(0, 0, 0.9), vec(0, 0, 0), vec(0, 0, 0));
    assert_int_equal(clast_world_run(s.w, 0.02), CLAST_ERR_GUARD);
    assert_non_null(strstr(clast_world_error(s.w), "part ram moves"));
    clast_world_free(s.w);
}

TEST_MAIN(cmocka_unit_test(a_stroke_goes_out_and_back), cmocka_unit_test(an_oscillation_is_a_sine),
          cmocka_unit_test(a_rotation_turns_about_its_axis),
          cmocka_unit_test(a_table_can_say_what_a_stroke_does),
          cmocka_unit_test(a_ball_circles_on_a_turntable),
          cmocka_unit_test(a_paddle_throws_a_ball_out), cmocka_unit_test(a_turning_plane_sweeps),
          cmocka_unit_test(a_shaken_floor_gives_what_it_books),
          cmocka_unit_test(a_belt_starts_and_stops),
          cmocka_unit_test(a_wall_that_leaps_stops_the_run))

/* The leapfrog: orders, bounded errors, and the free top against an adaptive reference. */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "tests/support/scene.h"

static const double PI = 3.14159265358979323846;

/* ---- a smooth problem: a ball between two springs -------------------------------------------- */

/* A ball pressed between two planes of the linear law never leaves them: a harmonic oscillator. */
static double oscillator_error(double steps_per_period) {
    clast_world_def def = bare_def(CLAST_LAW_LINEAR);
    double r = 0.005, k = 310, mass = 1130 * 4.0 / 3 * PI * r * r * r, omega = sqrt(2 * k / mass);
    def.time_step = 2 * PI / omega / steps_per_period;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    pair.stiffness = k;
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", r, m.soft);
    int part = clast_part_add(w, &(clast_part_def){.name = "press"});
    add_plane(w, part, m.hard, vec(0, 0, -0.9 * r), vec(0, 0, 1));
    add_plane(w, part, m.hard, vec(0, 0, 0.9 * r), vec(0, 0, -1));
    add_body(w, ball, vec(0, 0, 2.1e-4), vec(0, 0, 0.013), vec(0, 0, 0));
    steps(w, (uint64_t)(3.4 * steps_per_period + 0.5));
    double t = clast_world_time(w), c = cos(omega * t), s = sin(omega * t);
    body_state b = body_of(w, 0);
    double x = 2.1e-4 * c + 0.013 / omega * s, v = 0.013 * c - 2.1e-4 * omega * s;
    clast_world_free(w);
    return hypot(b.position.z - x, (b.velocity.z - v) / omega) / 2.1e-4;
}

static void leapfrog_is_second_order(void **state) {
    (void)state;
    double a = oscillator_error(50), b = oscillator_error(100), c = oscillator_error(400);
    print_message("oscillator: %.2e, %.2e, %.2e, orders %.3f, %.3f\n", a, b, c, order_of(a, b, 2),
                  order_of(b, c, 4));
    CHECK_NEAR(order_of(a, b, 2), 2, 0.02);
    CHECK_NEAR(order_of(b, c, 4), 2, 0.01);
}

/* Free fall is exact: positions and synchronised velocities are those of the parabola. */
static void free_fall_is_exact(void **state) {
    (void)state;
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_A00);
    def.gravity = vec(0.3, -1.1, -9.6);
    def.time_step = 1.7e-4;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    add_body(w, ball, vec(0, 0, 0), vec(0.2, 0.1, 2.3), vec(0, 0, 0));
    steps(w, 3000);
    double t = clast_world_time(w);
    body_state b = body_of(w, 0);
    CHECK_NEAR(b.position.z, 2.3 * t - 4.8 * t * t, 1e-14 * 3000);
    CHECK_NEAR(b.velocity.z, 2.3 - 9.6 * t, 1e-15 * 3000);
    CHECK_NEAR(clast_world_energy(w).residual, 0, 1e-12 * clast_world_energy(w).input);
    clast_world_free(w);
}

/* A00 1.76-1.83: with global damping and no force, speed falls as exp(-f t). */
static void global_damping_is_exponential(void **state) {
    (void)state;
    double error[2], residual[2];
    for (int i = 0; i < 2; i++) {
        clast_world_def def = bare_def(CLAST_LAW_HERTZ_A00);
        def.global_damping = 3.7;
        def.time_step = i ? 1e-3 : 2e-3;
        clast_world *w = new_world(&def);
        clast_pair_def pair = pair_of(1, 0);
        two_materials m = add_materials(w, &pair);
        add_body(w, add_uneven_rod(w, m.soft, 0.005), vec(0, 0, 0), vec(0.4, 0, 0), vec(3, 1, 2));
        steps(w, i ? 400 : 200);
        error[i] = body_of(w, 0).velocity.x - 0.4 * exp(-3.7 * clast_world_time(w));
        clast_energy e = clast_world_energy(w);
        residual[i] = e.residual / e.input;
        clast_world_free(w);
    }
    print_message("global damping: order %.2f, residual %.1e and %.1e\n",
                  order_of(error[0], error[1], 2), residual[0], residual[1]);
    CHECK_NEAR(order_of(error[0], error[1], 2), 2, 0.05);
    CHECK_NEAR(order_of(residual[0], residual[1], 2), 2, 0.05);
}

/* ---- the free top ---------------------------------------------------------------------------- */

static const clast_vec3 START_SPIN = {3.1, 41, 0.7}; /* near the middle axis: it tumbles */

static clast_world *top(double dt, clast_vec3 *inertia) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_A00);
    def.time_step = dt;
    def.max_displacement = 10;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(1, 0);
    two_materials m = add_materials(w, &pair);
    int shape = add_uneven_rod(w, m.soft, 0.005);
    *inertia = clast_world_shape(w, shape).inertia;
    add_body(w, shape, vec(0, 0, 0), vec(0, 0, 0), START_SPIN);
    return w;
}

static int euler(double t, const double y[], double f[], void *params) {
    (void)t;
    const clast_vec3 *i = params;
    f[0] = (i->y - i->z) / i->x * y[1] * y[2];
    f[1] = (i->z - i->x) / i->y * y[2] * y[0];
    f[2] = (i->x - i->y) / i->z * y[0] * y[1];
    double w = y[3], x = y[4], v = y[5], z = y[6]; /* dq/dt = q (0, omega) / 2 */
    f[3] = 0.5 * (-x * y[0] - v * y[1] - z * y[2]);
    f[4] = 0.5 * (w * y[0] + v * y[2] - z * y[1]);
    f[5] = 0.5 * (w * y[1] + z * y[0] - x * y[2]);
    f[6] = 0.5 * (w * y[2] + x * y[1] - v * y[0]);
    return GSL_SUCCESS;
}

static clast_quat reference_orientation(clast_vec3 inertia, double time) {
    gsl_odeiv2_system system = {euler, NULL, 7, &inertia};
    gsl_odeiv2_driver *d =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-5, 1e-13, 1e-13);
    double y[7] = {START_SPIN.x, START_SPIN.y, START_SPIN.z, 1, 0, 0, 0}, t = 0;
    gsl_odeiv2_driver_apply(d, &t, time, y);
    gsl_odeiv2_driver_free(d);
    return (clast_quat){y[3], y[4], y[5], y[6]};
}

static double orientation_error(double dt) {
    clast_vec3 inertia;
    clast_world *w = top(dt, &inertia);
    run_to(w, 0.8);
    clast_quat q = body_of(w, 0).orientation,
               r = reference_orientation(inertia, clast_world_time(w));
    clast_world_free(w);
    double same = fabs(q.w * r.w + q.x * r.x + q.y * r.y + q.z * r.z);
    return 2 * sqrt(fmax(0, 1 - same * same));
}

static void a_free_top_follows_the_reference(void **state) {
    (void)state;
    double a = orientation_error(4e-4), b = orientation_error(2e-4), c = orientation_error(5e-5);
    print_message("top after 0.8 s at 41 rad/s: %.2e, %.2e, %.2e rad, orders %.2f, %.2f\n", a, b, c,
                  order_of(a, b, 2), order_of(b, c, 4));
    CHECK_NEAR(order_of(a, b, 2), 2, 0.05);
    CHECK_NEAR(order_of(b, c, 4), 2, 0.05);
}

/* Largest relative error of the energy over a long flight; the angular momentum must not move. */
static double energy_error(double dt, double *momentum_error) {
    clast_vec3 i;
    clast_world *w = top(dt, &i);
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double start = motion_energy(w), worst = 0;
    clast_vec3 s = START_SPIN, l0 = {i.x * s.x, i.y * s.y, i.z * s.z};
    *momentum_error = 0;
    while (clast_world_time(w) < 8) {
        steps(w, 37);
        worst = fmax(worst, fabs(motion_energy(w) / start - 1));
        body_state b = body_of(w, 0);
        clast_quat q = b.orientation;
        double n2 = q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z;
        CHECK_NEAR(n2, 1, 1e-15 * 4);
        /* energy = L . omega / 2 with the same L all the time */
        *momentum_error = fmax(*momentum_error, fabs(dot(l0, b.spin) / 2 / motion_energy(w) - 1));
    }
    clast_world_free(w);
    return worst;
}

static void a_free_top_keeps_momentum_and_energy(void **state) {
    (void)state;
    double l, ignored, coarse = energy_error(8e-4, &l), fine = energy_error(4e-4, &ignored);
    print_message("top, 8 s: energy off by %.2e and %.2e, order %.2f; momentum by %.1e\n", coarse,
                  fine, order_of(coarse, fine, 2), l);
    CHECK_NEAR(order_of(coarse, fine, 2), 2, 0.1);
    CHECK_BELOW(l, 1e-12);
}

/* ---- in a plane and in space ----------------------------------------------------------------- */

enum { BODIES = 12 };

static clast_world *layer(clast_motion motion) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.motion = motion;
    def.plane_axis = 1;
    def.rayleigh_fraction = 0.5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.7, 0.3);
    two_materials m = add_materials(w, &pair);
    int shapes[3] = {clast_shape_add_sphere(w, "ball", 0.0051, m.soft), add_rod(w, m.hard, 0.0043),
                     add_triangle(w, m.soft, 0.0037)};
    int part = clast_part_add(w, &(clast_part_def){.name = "box"});
    add_plane(w, part, m.hard, vec(0, 0, 0), vec(0.1, 0, 1));
    add_plane(w, part, m.hard, vec(-0.03, 0, 0), vec(1, 0, 0));
    add_plane(w, part, m.hard, vec(0.03, 0, 0), vec(-1, 0, 0));
    dice d = {1234, 0};
    for (int i = 0; i < BODIES; i++) {
        double angle = roll(&d, -3, 3);
        clast_body_def b = {shapes[i % 3],
                            {0.019 * (i % 3 - 1), 0, 0.02 + 0.019 * (i / 3)},
                            clast_quat_axis_angle(vec(0, 1, 0), angle),
                            {roll(&d, -.1, .1), 0, roll(&d, -.1, .1)},
                            {0, roll(&d, -30, 30), 0}};
        if (clast_body_add(w, &b) < 0) fail_msg("%s", clast_world_error(w));
    }
    return w;
}

/* A pile is chaotic: rounding grows, so the comparison ends soon after the bodies have met. */
static void in_a_plane_is_in_space(void **state) {
    (void)state;
    clast_world *a = layer(CLAST_MOTION_IN_PLANE), *b = layer(CLAST_MOTION_3D);
    run_to(a, 0.11), run_to(b, 0.11);
    assert_true(clast_world_steps(a) == clast_world_steps(b));
    print_message("%zu contacts\n", contact_count(a));
    assert_true(contact_count(a) > 2 && contact_count(a) == contact_count(b));
    double worst = 0;
    for (int i = 0; i < BODIES; i++) {
        body_state p = body_of(a, i), q = body_of(b, i);
        assert_true(p.position.y == 0 && p.velocity.y == 0 && p.spin.x == 0 && p.spin.z == 0);
        worst = fmax(worst, norm(minus(p.position, q.position)) / 0.005);
        worst = fmax(worst, norm(minus(p.spin, q.spin)) / 30);
    }
    print_message("plane against space: off by %.1e\n", worst);
    CHECK_BELOW(worst, 1e-6);
    clast_world_free(a), clast_world_free(b);
}

/* (along u, along v, along the axis a) with (u, v, a) right-handed. */
static clast_vec3 turned_axes(int a, double u, double v, double along) {
    double c[3];
    c[(a + 1) % 3] = u, c[(a + 2) % 3] = v, c[a] = along;
    return vec(c[0], c[1], c[2]);
}

/* A rod falls on a floor and tumbles: where it ends, in the coordinates of its plane. */
static clast_vec3 tumbled(int a, clast_motion motion, double *spin) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = turned_axes(a, 0, -9.81, 0);
    def.motion = motion, def.plane_axis = a, def.time_step = 2.8e-5;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.7, 0.3);
    two_materials m = add_materials(w, &pair);
    clast_vec3 one = turned_axes(a, 0.005, 0.001, 0), centre[2] = {one, times(-1, one)};
    double radius[2] = {0.004, 0.004}, mass = 7e-4, i = 2 * mass * 16e-6;
    int rod = clast_shape_add(
        w, &(clast_shape_def){"rod", m.soft, 2, centre, radius, mass, {i, i, i}, 0, NULL});
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              turned_axes(a, 0.1, 1, 0));
    clast_body_def b = {rod, turned_axes(a, 0, 0.02, 0),
                        clast_quat_axis_angle(turned_axes(a, 0, 0, 1), 0.6),
                        turned_axes(a, 0.2, -0.1, 0), turned_axes(a, 0, 0, 12)};
    assert_true(clast_body_add(w, &b) >= 0);
    run_to(w, 0.12);
    body_state s = body_of(w, 0);
    clast_world_free(w);
    *spin = dot(s.spin, turned_axes(a, 0, 0, 1));
    return vec(dot(s.position, turned_axes(a, 1, 0, 0)), dot(s.position, turned_axes(a, 0, 1, 0)),
               dot(s.position, turned_axes(a, 0, 0, 1)));
}

static void any_plane_of_motion(void **state) {
    (void)state;
    double spin, other;
    clast_vec3 want = tumbled(1, CLAST_MOTION_3D, &spin);
    for (int a = 0; a < 3; a++) {
        clast_vec3 got = tumbled(a, CLAST_MOTION_IN_PLANE, &other);
        CHECK_NEAR(norm(minus(got, want)), 0, 1e-10);
        CHECK_NEAR(other, spin, 1e-8 * fabs(spin));
        assert_true(got.z == 0);
    }
}

/* A ball falls on a floor and rolls off: where it is after 0.3 s. */
static body_state rolled(bool turned, clast_motion motion) {
    clast_world_def def = bare_def(CLAST_LAW_HERTZ_MINDLIN);
    def.gravity = vec(0, 0, -9.81);
    def.turn_spheres = turned, def.motion = motion, def.plane_axis = 1;
    clast_world *w = new_world(&def);
    clast_pair_def pair = pair_of(0.4, 0.5);
    two_materials m = add_materials(w, &pair);
    int ball = clast_shape_add_sphere(w, "ball", 0.005, m.soft);
    add_plane(w, clast_part_add(w, &(clast_part_def){.name = "floor"}), m.hard, vec(0, 0, 0),
              vec(0, 0, 1));
    add_body(w, ball, vec(0, 0, 0.005), vec(0.05, 0, 0), vec(0, 0, 0));
    run_to(w, 0.3);
    body_state s = body_of(w, 0);
    clast_world_free(w);
    return s;
}

/* The orientation of a sphere is followed where it is asked for, and changes nothing else. */
static void spheres_turn_when_asked(void **state) {
    (void)state;
    for (int k = 0; k < 2; k++) {
        clast_motion motion = k ? CLAST_MOTION_IN_PLANE : CLAST_MOTION_3D;
        body_state marked = rolled(true, motion), plain = rolled(false, motion);
        assert_memory_equal(&marked.position, &plain.position, sizeof marked.position);
        assert_memory_equal(&marked.spin, &plain.spin, sizeof marked.spin);
        assert_true(plain.orientation.w == 1);
        double angle = 2 * atan2(marked.orientation.y, marked.orientation.w);
        CHECK_NEAR(angle, marked.position.x / 0.005, 0.05 * angle); /* it slid at first */
        assert_true(angle > 1);
    }
}

TEST_MAIN(cmocka_unit_test(spheres_turn_when_asked), cmocka_unit_test(leapfrog_is_second_order),
          cmocka_unit_test(free_fall_is_exact), cmocka_unit_test(global_damping_is_exponential),
          cmocka_unit_test(a_free_top_follows_the_reference),
          cmocka_unit_test(a_free_top_keeps_momentum_and_energy),
          cmocka_unit_test(in_a_plane_is_in_space), cmocka_unit_test(any_plane_of_motion))

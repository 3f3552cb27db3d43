/* Amplification matrices of the schemes against limits that follow from their characteristic
 * polynomials by hand, and against the printed equations carried out step by step. */
#include <complex.h>

#include <gsl/gsl_poly.h>

#include "experiments/theory/amplification.h"
#include "tests/support/check.h"

#define SCHEME(s) ((clast_scheme)(s))
static const double DAMPINGS[5] = {0, 0.013, 0.2, 0.71, 1.6};

/* ---- limits in closed form ------------------------------------------------------------------- */

/* Without damping: 2 for the Verlet family (S12 2.67), sqrt(2) for Gear (2.72 to 2.78), sqrt(6) for
 * Numerov (3.25), sqrt(12) for Beeman (3.5, 3.6), from the equations at the eigenvalue -1. */
static void undamped_limits(void **state) {
    (void)state;
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_LEAPFROG, 0), 2.0, 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_SYMPLECTIC_EULER, 0), 2.0, 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_POSITION_VERLET, 0), 2.0, 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_VELOCITY_VERLET, 0), 2.0, 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_GEAR4, 0), sqrt(2), 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_BEEMAN, 0), sqrt(12), 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_BACKWARD, 0), sqrt(6), 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_FORWARD, 0), sqrt(6), 1e-8);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_CENTRAL, 0), sqrt(6), 1e-8);
    double ratio = scheme_limit(CLAST_SCHEME_NUMEROV_CENTRAL, 0) /
                   scheme_limit(CLAST_SCHEME_POSITION_VERLET, 0);
    print_message("limit of Numerov over that of position Verlet: %.4f (S12 3.9.3 saw 1.2)\n",
                  ratio);
    CHECK_NEAR(ratio, 1.2247, 5e-5);
}

/* The eigenvalue -1 once more, with damping: h^2 + 4 z h = 4 for the symplectic Euler scheme and
 * all that move like it, 4 z h = h^2 or z h = 1 for Taylor, 3 h^2 + 22 z h = 6 for Gear, h^2 = 12
 * for Beeman, h^2 = 6 and h^2 -+ 6 z h = 6 for Numerov with central, forward and backward
 * difference.
 */
static void damped_limits(void **state) {
    (void)state;
    for (int i = 1; i < 5; i++) {
        double z = DAMPINGS[i], euler = 2 * sqrt(z * z + 1) - 2 * z, root = sqrt(9 * z * z + 6);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_LEAPFROG, z), euler, 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_SYMPLECTIC_EULER, z), euler, 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_VELOCITY_VERLET, z), euler, 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_TAYLOR, z), fmin(4 * z, 1 / z), 1e-6);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_GEAR4, z), hypot(11 * z / 3, sqrt(2)) - 11 * z / 3,
                    1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_BEEMAN, z), sqrt(12), 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_CENTRAL, z), sqrt(6), 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_FORWARD, z), root + 3 * z, 1e-8);
        CHECK_CLOSE(scheme_limit(CLAST_SCHEME_NUMEROV_BACKWARD, z), root - 3 * z, 1e-8);
    }
}

/* However small the damping is, it turns into growth beyond sqrt(2): there the velocity of
 * S12 2.68, a step behind, is more than a quarter period old. Roots of the cubic of x(t+1) = (2 -
 * h^2 - z h) x(t) - x(t-1) + z h x(t-2), by another library function and another path. */
static double verlet_growth(double h, double z) {
    const double a[4] = {-z * h, 1, -(2 - h * h - z * h), 1};
    double packed[6], most = 0;
    gsl_poly_complex_workspace *room = gsl_poly_complex_workspace_alloc(4);
    gsl_poly_complex_solve(a, 4, room, packed);
    gsl_poly_complex_workspace_free(room);
    for (int i = 0; i < 3; i++) most = fmax(most, hypot(packed[2 * i], packed[2 * i + 1]));
    return most;
}

static void position_verlet_with_damping_is_a_cubic(void **state) {
    (void)state;
    for (int i = 1; i < 5; i++) {
        double z = DAMPINGS[i], limit = scheme_limit(CLAST_SCHEME_POSITION_VERLET, z);
        for (double h = 0.07; h < 3; h *= 1.31)
            CHECK_CLOSE(scheme_growth(CLAST_SCHEME_POSITION_VERLET, h, z), verlet_growth(h, z),
                        1e-11);
        print_message("position Verlet, z = %.3f: limit %.4f\n", z, limit);
        CHECK_BELOW(verlet_growth(0.999 * limit, z), 1);
        CHECK_BELOW(1, verlet_growth(1.001 * limit, z));
        CHECK_BELOW(limit, sqrt(2));
    }
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_POSITION_VERLET, 1e-3), sqrt(2), 1e-3);
}

static void schemes_without_a_limit(void **state) {
    (void)state;
    static const clast_scheme NONE[4] = {CLAST_SCHEME_BACKWARD_EULER, CLAST_SCHEME_TRAPEZOID,
                                         CLAST_SCHEME_NEWMARK_BETA, CLAST_SCHEME_BDF2};
    for (int i = 0; i < 5; i++)
        for (int s = 0; s < 4; s++) assert_true(isinf(scheme_limit(NONE[s], DAMPINGS[i])));
    assert_true(scheme_limit(CLAST_SCHEME_TAYLOR, 0) == 0);
}

/* ---- schemes whose stable steps are ranges --------------------------------------------------- */

/* On the boundary of the stable region of BDF4, with the eigenvalue exp(i theta), the real part is
 * (cos theta - 1)^3 (2 cos theta + 2/3): the imaginary axis leaves the region at 0 and comes back
 * at cos theta = -1/3, where h = 10 sqrt(2) / 3. */
static void bdf4_is_unstable_in_between(void **state) {
    (void)state;
    scheme_range r[SCHEME_RANGES_MAX];
    assert_int_equal(scheme_ranges(CLAST_SCHEME_BDF4, 0, r), 1);
    CHECK_CLOSE(r[0].from, 10 * sqrt(2) / 3, 1e-8);
    assert_true(isinf(r[0].to));
    assert_true(scheme_limit(CLAST_SCHEME_BDF4, 0) == 0);
    assert_int_equal(scheme_ranges(CLAST_SCHEME_BDF4, 0.05, r), 2);
    print_message("BDF4, z = 0.05: stable up to %.4f and from %.4f\n", r[0].to, r[1].from);
    assert_true(r[0].from == 0 && r[0].to < r[1].from && isinf(r[1].to));
    assert_true(isinf(scheme_limit(CLAST_SCHEME_BDF4, 0.71)));
}

/* The third-order Adams-Moulton scheme is stable down to -6 on the real axis, where overdamped
 * contacts live; without damping it grows by h^4/24 per step, from the error constant -1/24. */
static void adams_moulton_has_a_limit(void **state) {
    (void)state;
    scheme_range r[SCHEME_RANGES_MAX];
    assert_int_equal(scheme_ranges(CLAST_SCHEME_ADAMS_MOULTON, 0, r), 0);
    for (double h = 0.05; h < 0.3; h *= 2)
        CHECK_CLOSE(scheme_growth(CLAST_SCHEME_ADAMS_MOULTON, h, 0) - 1, h * h * h * h / 24, h * h);
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_ADAMS_MOULTON, 1.6), 6 / (1.6 + sqrt(1.6 * 1.6 - 1)),
                1e-8);
}

static double complex adams_moulton_locus(double theta) {
    double complex q = cexp(I * theta);
    return (q * q - q) / (5.0 / 12 * q * q + 2.0 / 3 * q - 1.0 / 12);
}

/* Below critical damping: where the boundary of the stable region, h lambda as a function of the
 * angle of the eigenvalue, has the direction -z + i sqrt(1 - z^2). */
static void adams_moulton_limit_lies_on_its_locus(void **state) {
    (void)state;
    double z = 0.2, low = 0.3, high = 3;
    for (int i = 0; i < 60; i++) {
        double middle = 0.5 * (low + high);
        double complex l = adams_moulton_locus(middle);
        if (-creal(l) / cabs(l) < z)
            low = middle;
        else
            high = middle;
    }
    CHECK_CLOSE(scheme_limit(CLAST_SCHEME_ADAMS_MOULTON, z), cabs(adams_moulton_locus(low)), 1e-7);
}

/* ---- the printed equations, step by step ----------------------------------------------------- */

/* S12 2.69 to 2.71: state x, v dt, a dt^2, the last with the predicted velocity. */
static void verlet_step(double s[3], double h, double z) {
    double x = s[0] + s[1] + 0.5 * s[2], predicted = s[1] + 0.5 * s[2];
    double a = -h * h * x - 2 * z * h * predicted;
    s[1] += 0.5 * (s[2] + a);
    s[0] = x, s[2] = a;
}

/* S12 2.72 to 2.78: and b dt^3. */
static void gear_step(double s[4], double h, double z) {
    double x = s[0] + s[1] + s[2] / 2 + s[3] / 6, v = s[1] + s[2] + s[3] / 2, a = s[2] + s[3];
    double off = -h * h * x - 2 * z * h * v - a;
    s[0] = x + off / 12, s[1] = v + 5 * off / 12, s[2] = a + off, s[3] += off;
}

/* Accelerations of the start are those of the exact motion, so that third derivatives are
 * differences of them. */
static void matrices_are_the_printed_steps(void **state) {
    (void)state;
    double h = 0.61, z = 0.17, verlet[SCHEME_SIZE_MAX], gear[SCHEME_SIZE_MAX];
    double m[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], n[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX];
    scheme_matrix(CLAST_SCHEME_VELOCITY_VERLET, h, z, m);
    scheme_matrix(CLAST_SCHEME_GEAR4, h, z, n);
    scheme_start(CLAST_SCHEME_VELOCITY_VERLET, h, z, 1.3, -0.4, verlet);
    scheme_start(CLAST_SCHEME_GEAR4, h, z, 1.3, -0.4, gear);
    double a = gear[2] + gear[3], before = gear[6] + gear[7];
    double v3[3] = {verlet[0], verlet[1], verlet[2] + verlet[3]};
    double g4[4] = {gear[0], gear[1], a, a - before};
    for (int i = 0; i < 40; i++) {
        verlet_step(v3, h, z), gear_step(g4, h, z);
        scheme_advance(CLAST_SCHEME_VELOCITY_VERLET, m, verlet);
        scheme_advance(CLAST_SCHEME_GEAR4, n, gear);
        for (int k = 0; k < 2; k++) {
            CHECK_NEAR(verlet[k], v3[k], 1e-14);
            CHECK_NEAR(gear[k], g4[k], 1e-14);
        }
    }
}

/* The velocity Verlet scheme with its predicted velocity and the symplectic Euler scheme with a
 * velocity half a step older pass the same positions. */
static void velocity_verlet_is_a_leapfrog(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++)
        for (double h = 0.1; h < 4; h *= 1.7)
            CHECK_CLOSE(scheme_growth(CLAST_SCHEME_VELOCITY_VERLET, h, DAMPINGS[i]),
                        scheme_growth(CLAST_SCHEME_LEAPFROG, h, DAMPINGS[i]), 1e-12);
}

/* The trapezoid rule is Newmark's scheme with mean accelerations. */
static void trapezoid_is_newmark(void **state) {
    (void)state;
    for (int i = 0; i < 5; i++)
        for (double h = 0.1; h < 20; h *= 1.7)
            CHECK_CLOSE(scheme_growth(CLAST_SCHEME_TRAPEZOID, h, DAMPINGS[i]),
                        scheme_growth(CLAST_SCHEME_NEWMARK_BETA, h, DAMPINGS[i]), 1e-9);
}

/* ---- the motion itself ----------------------------------------------------------------------- */

/* Turns per step without damping: Verlet's 2 asin(h/2) runs ahead, the trapezoid rule's 2 atan(h/2)
 * behind; Numerov's cosine is (1 - 5 h^2/12) / (1 + h^2/12). */
static void angles(void **state) {
    (void)state;
    for (double h = 0.05; h < 1.5; h *= 1.3) {
        double numerov = acos((1 - 5 * h * h / 12) / (1 + h * h / 12));
        CHECK_CLOSE(scheme_motion_of(CLAST_SCHEME_POSITION_VERLET, h, 0).angle, 2 * asin(h / 2),
                    1e-9);
        CHECK_CLOSE(scheme_motion_of(CLAST_SCHEME_TRAPEZOID, h, 0).angle, 2 * atan(h / 2), 1e-9);
        CHECK_CLOSE(scheme_motion_of(CLAST_SCHEME_NUMEROV_CENTRAL, h, 0).angle, numerov, 1e-9);
        CHECK_CLOSE(scheme_motion_of(CLAST_SCHEME_BACKWARD_EULER, h, 0).decay, 1 / sqrt(1 + h * h),
                    1e-9);
    }
}

/* ---- orders ---------------------------------------------------------------------------------- */

static double motion_error(clast_scheme scheme, double h, double z) {
    return scheme_motion_of(scheme, h, z).error;
}

/* The motion that a scheme makes of an oscillation, against the exact one, per unit of time. Gear's
 * errors of third order, in the rates of position and velocity, cancel in it without damping. */
static void orders(void **state) {
    (void)state;
    static const struct {
        clast_scheme scheme;
        int undamped, damped;
    } EXPECTED[] = {
        {CLAST_SCHEME_LEAPFROG, 2, 1},
        {CLAST_SCHEME_SYMPLECTIC_EULER, 2, 1},
        {CLAST_SCHEME_TAYLOR, 1, 1},
        {CLAST_SCHEME_POSITION_VERLET, 2, 1},
        {CLAST_SCHEME_VELOCITY_VERLET, 2, 1},
        {CLAST_SCHEME_GEAR4, 4, 3},
        {CLAST_SCHEME_BACKWARD_EULER, 1, 1},
        {CLAST_SCHEME_BEEMAN, 2, 2},
        {CLAST_SCHEME_NEWMARK_BETA, 2, 2},
        {CLAST_SCHEME_BDF2, 2, 2},
        {CLAST_SCHEME_BDF4, 4, 4},
        {CLAST_SCHEME_ADAMS_MOULTON, 3, 3},
        {CLAST_SCHEME_TRAPEZOID, 2, 2},
        {CLAST_SCHEME_NUMEROV_BACKWARD, 4, 1},
        {CLAST_SCHEME_NUMEROV_FORWARD, 4, 1},
        {CLAST_SCHEME_NUMEROV_CENTRAL, 4, 2},
    };
    for (size_t i = 0; i < sizeof EXPECTED / sizeof *EXPECTED; i++) {
        clast_scheme s = EXPECTED[i].scheme;
        double free = order_of(motion_error(s, 0.08, 0), motion_error(s, 0.04, 0), 2) - 1;
        double damped = order_of(motion_error(s, 0.02, 0.3), motion_error(s, 0.01, 0.3), 2) - 1;
        print_message("scheme %2d (%s): order %.3f, with damping %.3f\n", (int)s, scheme_source(s),
                      free, damped);
        CHECK_NEAR(free, EXPECTED[i].undamped, 0.1);
        CHECK_NEAR(damped, EXPECTED[i].damped, 0.1);
    }
}

/* ---- growth ---------------------------------------------------------------------------------- */

/* Beyond the limit the run of the map takes the predicted number of steps to grow. */
static void growth_predicts_the_time_to_detection(void **state) {
    (void)state;
    for (int s = 0; s < SCHEME_COUNT; s++) {
        double limit = scheme_limit(SCHEME(s), 0.05), h = 1.05 * limit;
        if (!isfinite(limit) || limit == 0) continue;
        double m[SCHEME_SIZE_MAX * SCHEME_SIZE_MAX], at[SCHEME_SIZE_MAX], size = 0;
        scheme_matrix(SCHEME(s), h, 0.05, m);
        scheme_start(SCHEME(s), h, 0.05, 1, 0, at);
        double many = scheme_steps_to_grow(SCHEME(s), h, 0.05, 1e12);
        int steps = 0;
        for (; size < 1e12 && steps < 1000000; steps++) {
            scheme_advance(SCHEME(s), m, at);
            size = hypot(at[0], at[1] / h);
        }
        print_message("scheme %2d: limit %.4f, growth %.5f, %d steps to 1e12, predicted %.0f\n", s,
                      limit, scheme_growth(SCHEME(s), h, 0.05), steps, many);
        CHECK_NEAR(steps, many, 0.15 * many + 5);
    }
}

TEST_MAIN(cmocka_unit_test(undamped_limits), cmocka_unit_test(damped_limits),
          cmocka_unit_test(position_verlet_with_damping_is_a_cubic),
          cmocka_unit_test(schemes_without_a_limit), cmocka_unit_test(bdf4_is_unstable_in_between),
          cmocka_unit_test(adams_moulton_has_a_limit),
          cmocka_unit_test(adams_moulton_limit_lies_on_its_locus),
          cmocka_unit_test(matrices_are_the_printed_steps),
          cmocka_unit_test(velocity_verlet_is_a_leapfrog), cmocka_unit_test(trapezoid_is_newmark),
          cmocka_unit_test(angles), cmocka_unit_test(orders),
          cmocka_unit_test(growth_predicts_the_time_to_detection))

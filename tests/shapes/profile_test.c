/* Bodies of revolution from a function or a table, and spheres on them by A00 2.2.2. */
#include "engine/clast.h"
#include "shapes/fill.h"
#include "shapes/numbers.h"
#include "shapes/profile.h"
#include "shapes/quality.h"
#include "shapes/solid.h"
#include "tests/support/check.h"

static const double DEGREE = SHAPE_PI / 180;

typedef struct half_axes {
    double a, b;
} half_axes;

static double ellipse(const void *context, double x) {
    const half_axes *e = context;
    double square = 1 - x * x / (e->a * e->a);
    return square > 0 ? e->b * sqrt(square) : 0;
}

static shape_profile ellipse_profile(double a, double b, int points) {
    return shape_profile_of(ellipse, &(half_axes){a, b}, -a, a, points);
}

static void a_fine_profile_is_the_solid(void **state) {
    (void)state;
    shape_profile p = ellipse_profile(1.3, 0.6, 2000);
    shape_solid solid = {SHAPE_ELLIPSOID, {1.3, 0.6, 0.6}};
    shape_mass a = shape_profile_mass(&p), b = shape_solid_mass(&solid);
    CHECK_CLOSE(a.volume, b.volume, 1e-5);
    for (int k = 0; k < 3; k++) CHECK_CLOSE(a.inertia[k][k], b.inertia[k][k], 2e-5);
    dice d = {.seed = 8};
    for (int i = 0; i < 300; i++) {
        double x = roll(&d, -1.5, 1.5), y = roll(&d, -1, 1);
        shape_vec at = sv(x, y, roll(&d, -1, 1)), q, n, q2, n2;
        double one = shape_profile_distance(&p, at, &q, &n);
        double other = shape_solid_distance(&solid, at, &q2, &n2);
        CHECK_NEAR(one, other, 2e-6);
        if (fabs(other) > 0.4) continue; /* near the axis the nearest point may be another one */
        CHECK_NEAR(sv_distance(n, n2), 0, 5e-3);
    }
    shape_profile_free(&p);
}

/* A cylinder and a cone as tables of corners are exact. */
static void tables_of_corners_are_exact(void **state) {
    (void)state;
    double cylinder[3][2] = {{-0.7, 0.4}, {0.1, 0.4}, {0.7, 0.4}};
    double cone[3][2] = {{0, 0.5}, {1, 0.25}, {2, 0}};
    shape_profile p = shape_profile_new(cylinder, 3), q = shape_profile_new(cone, 3);
    shape_mass a = shape_profile_mass(&p), b = shape_profile_mass(&q);
    shape_mass want_a = shape_solid_mass(&(shape_solid){SHAPE_CYLINDER, {0.4, 1.4}});
    shape_mass want_b = shape_solid_mass(&(shape_solid){SHAPE_CONE, {0.5, 2}});
    CHECK_CLOSE(a.volume, want_a.volume, 1e-14);
    CHECK_CLOSE(b.volume, want_b.volume, 1e-14);
    CHECK_NEAR(b.centre.x, 0.5, 1e-14);
    for (int k = 0; k < 3; k++) {
        CHECK_CLOSE(a.inertia[k][k], want_a.inertia[k][k], 1e-13);
        CHECK_CLOSE(b.inertia[k][k], want_b.inertia[k][k], 1e-13);
    }
    CHECK_NEAR(shape_profile_distance(&p, sv(0.65, 0, 0.1), NULL, NULL), -0.05, 1e-15);
    CHECK_NEAR(shape_profile_distance(&p, sv(0.2, 0.3, 0), NULL, NULL), -0.1, 1e-15);
    CHECK_NEAR(shape_profile_distance(&p, sv(1, 0.8, 0), NULL, NULL), 0.5, 1e-15);
    shape_profile_free(&p), shape_profile_free(&q);
}

/* A00 Appendix E: 7 spheres on an ellipse of 0.69 and 0.53 cm have R_1 = 0.433 and R_2 = 0.481 cm,
 * 0.07 cm apart. Printed to that many digits; the engine's own fit has the same numbers. */
static void the_button_of_appendix_e(void **state) {
    (void)state;
    shape_profile p = ellipse_profile(0.69, 0.53, 4000);
    shape_sphere s[7];
    clast_vec3 centre[7];
    double radius[7];
    assert_int_equal(shape_profile_fit(&p, 7, s), 7);
    assert_int_equal(clast_fit_ellipse(0.69, 0.53, 7, centre, radius), CLAST_OK);
    for (int i = 0; i < 7; i++) {
        CHECK_NEAR(s[i].centre.x, centre[i].x, 2e-6);
        CHECK_NEAR(s[i].radius, radius[i], 2e-6);
    }
    CHECK_NEAR(s[0].radius, 0.433, 0.0005);
    CHECK_NEAR(s[1].radius, 0.481, 0.0005);
    CHECK_NEAR(s[1].centre.x - s[0].centre.x, 0.07, 0.005);
    shape_profile_free(&p);
}

/* The angle between two contacts by their places in the plane. */
static double by_places(double r1, double r2, double l, double rs, double slope_side) {
    double a = r1 + rs, b = r2 + rs, x = (a * a - b * b + l * l) / (2 * l), y = sqrt(a * a - x * x);
    double theta = asin((r2 - r1) / l); /* of the line that touches both */
    double nx = -sin(theta), ny = cos(theta);
    double cx = slope_side < 0 ? x : x - l, length = slope_side < 0 ? a : b;
    return acos((cx * nx + y * ny) / length);
}

/* Its contact normal. A00 prints 1.79 and 2.31 degrees, together 4.10; the lengths that it prints
 * allow no more than 3.8 together, whatever was rounded off. */
static void the_contact_normal_of_appendix_e(void **state) {
    (void)state;
    clast_vec3 centre[7];
    double radius[7], angle[2], most = 0;
    clast_fit_ellipse(0.69, 0.53, 7, centre, radius);
    double l = centre[1].x - centre[0].x;
    assert_true(shape_row_deviation(radius[0], radius[1], l, radius[0], angle));
    print_message("R1 %.5f, R2 %.5f, L %.5f: %.3f and %.3f degrees\n", radius[0], radius[1], l,
                  angle[0] / DEGREE, angle[1] / DEGREE);
    CHECK_NEAR(angle[0], by_places(radius[0], radius[1], l, radius[0], -1), 1e-9);
    CHECK_NEAR(angle[1], by_places(radius[0], radius[1], l, radius[0], 1), 1e-9);
    for (int i = 0; i < 8; i++) {
        double r1 = 0.433 + (i & 1 ? 0.0005 : -0.0005), r2 = 0.481 + (i & 2 ? 0.0005 : -0.0005);
        assert_true(shape_row_deviation(r1, r2, 0.07 + (i & 4 ? 0.005 : -0.005), r1, angle));
        most = fmax(most, (angle[0] + angle[1]) / DEGREE);
    }
    CHECK_BELOW(most, 3.8);
}

/* A00 3.7: rows of equal spheres with q centres to a diameter, 30, 14.3 and 7.16 degrees. The first
 * and the last are arcsin(1 / (2 q)) to their digits; the second is 14.48 and was read off a plot.
 */
static void rows_of_equal_spheres(void **state) {
    (void)state;
    const double density[3] = {1, 2, 4}, printed[3] = {30, 14.3, 7.16};
    for (int i = 0; i < 3; i++) {
        double angle[2], l = 2 / density[i] * (1 - 1e-12);
        assert_true(shape_row_deviation(1, 1, l, 1, angle));
        CHECK_NEAR(angle[0], angle[1], 1e-9);
        CHECK_NEAR(angle[0], asin(0.5 / density[i]), 1e-9);
        CHECK_NEAR(angle[0] / DEGREE, printed[i], 0.2);
    }
    double angle[2];
    assert_false(shape_row_deviation(1, 1, 4.1, 1, angle)); /* falls through */
    assert_false(shape_row_deviation(1, 2, 0.9, 1, angle)); /* one lies in the other */
}

/* The mean distance that a packing density stands for is that of a row, counted out. */
static void density_is_that_of_a_row(void **state) {
    (void)state;
    for (double q = 1; q < 9; q *= 1.7) {
        double sum = 0;
        for (int i = 0; i < 100000; i++) {
            double x = (i + 0.5) / 100000 / q;
            sum += (1 - sqrt(1 - x * x)) / 100000;
        }
        CHECK_CLOSE(shape_density_deviation(q), sum, 1e-4);
    }
}

/* More spheres come nearer; a table asks for what it gets. */
static void a_row_meets_what_is_asked(void **state) {
    (void)state;
    double at[41][2];
    for (int i = 0; i <= 40; i++) {
        double x = -1 + i / 20.0;
        at[i][0] = x, at[i][1] = sqrt(fmax(0, 1 - x * x)) * (0.45 - 0.15 * x); /* a pear */
    }
    shape_target *pear = shape_target_of_profile(at, 41);
    shape_sphere s[SHAPE_SPHERES_MAX];
    double last = HUGE_VAL;
    for (int n = 3; n <= 24; n *= 2) {
        shape_filling f = shape_fill_row(pear, &(shape_stops){.spheres = n}, s);
        assert_int_equal(f.count, n);
        shape_quality q = shape_quality_of(pear, s, f.count);
        CHECK_BELOW(q.deviation_mean, last);
        last = q.deviation_mean;
    }
    shape_filling f = shape_fill_row(pear, &(shape_stops){.density = 3}, s);
    assert_true(f.met);
    CHECK_BELOW(3 - 1e-9, f.density);
    shape_target_free(pear);
}

static void faults_of_a_table_are_named(void **state) {
    (void)state;
    int which;
    double back[3][2] = {{0, 0}, {1, 1}, {0.5, 0}}, below[3][2] = {{0, 0}, {1, -1}, {2, 0}};
    double cut[4][2] = {{0, 0}, {1, 0}, {2, 1}, {3, 0}}, flat[3][2] = {{0, 0}, {1, 0.1}, {2, NAN}};
    assert_non_null(shape_profile_fault(back, 3, &which));
    assert_int_equal(which, 2);
    assert_non_null(shape_profile_fault(below, 3, &which));
    assert_int_equal(which, 1);
    assert_non_null(shape_profile_fault(cut, 4, &which));
    assert_int_equal(which, 1);
    assert_non_null(shape_profile_fault(flat, 3, &which));
    assert_non_null(shape_profile_fault(back, 2, &which));
}

TEST_MAIN(cmocka_unit_test(a_fine_profile_is_the_solid),
          cmocka_unit_test(tables_of_corners_are_exact), cmocka_unit_test(the_button_of_appendix_e),
          cmocka_unit_test(the_contact_normal_of_appendix_e),
          cmocka_unit_test(rows_of_equal_spheres), cmocka_unit_test(density_is_that_of_a_row),
          cmocka_unit_test(a_row_meets_what_is_asked),
          cmocka_unit_test(faults_of_a_table_are_named))

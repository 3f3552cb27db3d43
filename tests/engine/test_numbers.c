/* The arithmetic under everything: sums without order, elementary functions, random numbers, the
 * fit of spheres to an ellipse. */
#include "engine/numbers.h"
#include "engine/sum.h"
#include "tests/support/scene.h"

/* ---- sums -------------------------------------------------------------------------------------
 */

enum { TERMS = 420000 };

static double sum_of(const double *terms, const int *order, int threads, double scale) {
    sum_scale s = sum_scale_for(scale);
    exact_sum total = {0, 0};
    for (int t = 0; t < threads; t++) {
        exact_sum part = {0, 0};
        for (int i = t * (TERMS / threads); i < (t + 1) * (TERMS / threads); i++)
            sum_add(&part, &s, terms[order[i]]);
        sum_merge(&total, &part);
    }
    return sum_value(&total);
}

static void shuffle(int *order, uint64_t seed) {
    dice d = {seed, 0};
    for (int i = TERMS - 1; i > 0; i--) {
        int j = (int)roll(&d, 0, i + 1), keep = order[i];
        order[i] = order[j], order[j] = keep;
    }
}

static void check_order(double (*term)(dice *), const char *name) {
    double *terms = malloc(TERMS * sizeof *terms);
    int *order = malloc(TERMS * sizeof *order);
    dice d = {4711, 0};
    for (int i = 0; i < TERMS; i++) terms[i] = term(&d), order[i] = i;
    double want = sum_of(terms, order, 1, 8.0);
    for (uint64_t seed = 1; seed <= 8; seed++) {
        shuffle(order, seed);
        double got = sum_of(terms, order, 1 + (int)(seed % 5), 8.0);
        if (memcmp(&got, &want, sizeof got) != 0)
            fail_msg("%s: order %llu gives %.17g, not %.17g", name, (unsigned long long)seed, got,
                     want);
    }
    free(terms), free(order);
}

static double mixed(dice *d) { return roll(d, -1, 1) * pow(10, roll(d, -18, 0)); }

/* Losses have one sign, and just under half a coarse quantum all of them land in the fine bin. */
static double one_sided(dice *d) { return 8.0 * 0x1p-31 * roll(d, 0.8, 0.999); }
static double one_sided_39(dice *d) { return 8.0 * 0x1p-39 * roll(d, 0.8, 0.999); }
static double large(dice *d) { return roll(d, 0, 1); }

static void a_sum_has_no_order(void **state) {
    (void)state;
    check_order(mixed, "mixed");
    check_order(one_sided, "just below 2^-31");
    check_order(one_sided_39, "just below 2^-39");
    check_order(large, "large");
}

static void a_sum_is_right(void **state) {
    (void)state;
    sum_scale s = sum_scale_for(2.0);
    exact_sum sum = {0, 0};
    for (int i = 1; i <= 100000; i++) sum_add(&sum, &s, 1.0 / i);
    CHECK_CLOSE(sum_value(&sum), 12.090146129863428, 1e-15);
    for (int i = 100000; i >= 1; i--) sum_add(&sum, &s, -1.0 / i);
    CHECK_NEAR(sum_value(&sum), 0, 0);
}

/* ---- elementary functions -------------------------------------------------------------------- */

static void sincos_agrees_with_libm(void **state) {
    (void)state;
    dice d = {90210, 0};
    double worst = 0, worst_small = 0;
    for (int i = 0; i < 400000; i++) {
        double x = roll(&d, -1, 1) * pow(10, roll(&d, -8, 5)), s, c;
        clast_sincos(x, &s, &c);
        worst = fmax(worst, fmax(fabs(s - sin(x)), fabs(c - cos(x))));
        if (fabs(x) <= 1e-3) worst_small = fmax(worst_small, fabs(s / sin(x) - 1));
    }
    CHECK_BELOW(worst, 2.3e-16);
    CHECK_BELOW(worst_small, 2.3e-16);
}

static void sincos_keeps_the_unit_circle(void **state) {
    (void)state;
    for (int i = -2000; i <= 2000; i++) {
        double s, c;
        clast_sincos(0.777 * i, &s, &c);
        CHECK_NEAR(s * s + c * c, 1, 4.5e-16);
    }
}

static void fifth_root_is_exact_to_two_ulps(void **state) {
    (void)state;
    dice d = {5, 0};
    for (int i = 0; i < 20000; i++) {
        double x = pow(10, roll(&d, -250, 250)), r = number_fifth_root(x);
        CHECK_CLOSE((double)powl((long double)r, 5), x, 2e-15);
    }
    assert_true(number_fifth_root(32) == 2);
}

/* The lane alone, without the call around it, over all normal numbers. */
static void fifth_root_in_a_lane(void **state) {
    (void)state;
    dice d = {12, 0};
    for (int i = 0; i < 20000; i++) {
        double x = pow(2, roll(&d, -1020, 1020)), r = number_fifth_root_lane(x);
        CHECK_CLOSE(r, (double)powl((long double)x, 1 / 5.0L), 4.5e-16);
    }
}

static void logarithm_is_exact_to_a_few_ulps(void **state) {
    (void)state;
    dice d = {13, 0};
    for (int i = 0; i < 20000; i++) {
        double x = i % 2 ? pow(10, roll(&d, -250, 250)) : roll(&d, 0.01, 1);
        CHECK_NEAR(number_log(x), log(x), 4e-16 * fmax(fabs(log(x)), 0.02));
    }
    assert_true(number_log(1) == 0);
}

static void powers_of_two(void **state) {
    (void)state;
    assert_true(number_power_of_two_above(1) == 1);
    assert_true(number_power_of_two_above(1.0000001) == 2);
    assert_true(number_power_of_two_above(0.3) == 0.5);
    assert_true(number_power_of_two_above(1e-200) < 2e-200);
}

/* ---- random numbers -------------------------------------------------------------------------- */

/* Known answers of Philox 4x32-10 (Random123, kat_vectors): the first two words of counter and key.
 */
static void philox_gives_the_published_words(void **state) {
    (void)state;
    double zero = (double)(0x6627e8d5e169c58dull >> 11) * 0x1p-53;
    double ones = (double)(0x408f276d41c83b0eull >> 11) * 0x1p-53;
    double digits = (double)(0xd16cfe0994fdccebull >> 11) * 0x1p-53;
    assert_true(clast_random(0, 0, 0) == zero);
    assert_true(clast_random(UINT64_MAX, UINT64_MAX, UINT64_MAX) == ones);
    assert_true(clast_random(0x299f31d0a4093822ull, 0x0370734413198a2eull, 0x85a308d3243f6a88ull) ==
                digits);
}

static void random_numbers_are_uniform(void **state) {
    (void)state;
    int bins[10] = {0}, n = 100000;
    double mean = 0, product = 0;
    for (int i = 0; i < n; i++) {
        double x = clast_random(3, 14, (uint64_t)i), y = clast_random(3, 15, (uint64_t)i);
        assert_true(x >= 0 && x < 1);
        bins[(int)(10 * x)]++;
        mean += x / n, product += (x - 0.5) * (y - 0.5) / n;
    }
    double chi2 = 0;
    for (int i = 0; i < 10; i++) chi2 += (bins[i] - n / 10) * (bins[i] - n / 10) / (n / 10.0);
    CHECK_BELOW(chi2, 27.9); /* nine degrees of freedom, 0.1 % */
    CHECK_NEAR(mean, 0.5, 3.3 * sqrt(1.0 / 12 / n));
    CHECK_NEAR(product, 0, 3.3 / 12 / sqrt(n));
}

/* ---- spheres on an ellipse, A00 2.2.2 -------------------------------------------------------- */

/* Appendix E: the button in seven spheres. Lengths in cm as printed there. */
static void the_button_of_appendix_e(void **state) {
    (void)state;
    clast_vec3 c[7];
    double r[7];
    assert_int_equal(clast_fit_ellipse(0.69, 0.53, 7, c, r), CLAST_OK);
    CHECK_NEAR(r[0], 0.433, 6e-4);
    CHECK_NEAR(r[1], 0.481, 6e-4);
    CHECK_NEAR(c[1].x - c[0].x, 0.07, 5e-3);
}

/* Every point of the model lies on or inside the ellipse, and each sphere touches it. */
static void fitted_spheres_touch_the_profile_from_inside(void **state) {
    (void)state;
    clast_vec3 c[9];
    double r[9], a = 0.0117, b = 0.0074;
    assert_int_equal(clast_fit_ellipse(a, b, 9, c, r), CLAST_OK);
    for (int i = 0; i < 9; i++) {
        double most = -1;
        for (int k = 0; k < 20000; k++) {
            double t = 2 * NUMBER_PI * k / 20000, x = c[i].x + r[i] * cos(t), z = r[i] * sin(t);
            most = fmax(most, x * x / (a * a) + z * z / (b * b));
        }
        CHECK_NEAR(most, 1, 1e-7);
    }
}

static void the_fit_mirrors_itself(void **state) {
    (void)state;
    for (int n = 1; n <= 24; n++) {
        clast_vec3 c[24];
        double r[24];
        assert_int_equal(clast_fit_ellipse(0.0213, 0.0134, n, c, r), CLAST_OK);
        for (int i = 0; i < n; i++) {
            assert_true(c[i].x == -c[n - 1 - i].x && r[i] == r[n - 1 - i]);
            assert_true(c[i].y == 0 && c[i].z == 0);
        }
    }
}

static void the_fit_refuses_nonsense(void **state) {
    (void)state;
    clast_vec3 c[3];
    double r[3];
    assert_int_equal(clast_fit_ellipse(1, 2, 3, c, r), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_fit_ellipse(1, 0, 3, c, r), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_fit_ellipse(1, 0.5, 0, c, r), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_fit_ellipse(NAN, 0.5, 3, c, r), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_fit_ellipse(INFINITY, 0.5, 3, c, r), CLAST_ERR_ARGUMENT);
    assert_int_equal(clast_fit_ellipse(1, 0.5, 1001, c, r), CLAST_ERR_ARGUMENT);
}

TEST_MAIN(cmocka_unit_test(a_sum_has_no_order), cmocka_unit_test(a_sum_is_right),
          cmocka_unit_test(sincos_agrees_with_libm), cmocka_unit_test(sincos_keeps_the_unit_circle),
          cmocka_unit_test(fifth_root_is_exact_to_two_ulps),
          cmocka_unit_test(fifth_root_in_a_lane),
          cmocka_unit_test(logarithm_is_exact_to_a_few_ulps), cmocka_unit_test(powers_of_two),
          cmocka_unit_test(philox_gives_the_published_words),
          cmocka_unit_test(random_numbers_are_uniform), cmocka_unit_test(the_button_of_appendix_e),
          cmocka_unit_test(fitted_spheres_touch_the_profile_from_inside),
          cmocka_unit_test(the_fit_mirrors_itself), cmocka_unit_test(the_fit_refuses_nonsense))

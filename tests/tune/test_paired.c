/* Paired differences against arithmetic done by hand, and what the sequential rule promises against
 * many experiments with a known truth. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "experiments/tune/paired.h"

#define NEAR(a, b, tolerance)                                                                      \
    do {                                                                                           \
        double a_ = (a), b_ = (b);                                                                 \
        if (!(fabs(a_ - b_) <= (tolerance)))                                                       \
            fail_msg("%s = %.10g, want %.10g within %g", #a, a_, b_, (double)(tolerance));         \
    } while (0)

/* Differences 1, 2, 3, 4 on a mean of 25: sd 1.29099, t(0.975, 3) = 3.18245. */
static void a_known_case(void **state) {
    (void)state;
    const double reference[] = {10, 20, 30, 40}, candidate[] = {11, 22, 33, 44};
    paired p = paired_compare(reference, candidate, 4, 0.05);
    assert_int_equal(p.n, 4);
    NEAR(p.reference, 25, 0);
    NEAR(p.difference, 0.1, 1e-15);
    NEAR(p.half, 3.182446305284 * 1.290994448736 / 2 / 25, 1e-12);
    paired q = paired_compare(reference, candidate, 4, 0.05 / 3); /* t(0.991667, 3) = 4.856656 */
    NEAR(q.half, 4.856656 * 1.290994448736 / 2 / 25, 1e-6);
    assert_int_equal(paired_judge(&p, 0.19), PAIRED_WITHIN);
    assert_int_equal(paired_judge(&p, 0.18), PAIRED_OPEN);
    assert_int_equal(paired_judge(&p, 0.02), PAIRED_OPEN);
    assert_int_equal(paired_judge(&p, 0.017), PAIRED_OUTSIDE);
}

/* Pairing is the point: what both runs of a pair share drops out. */
static void a_common_spread_drops_out(void **state) {
    (void)state;
    const double reference[] = {1, 5, 9}, candidate[] = {0.95, 4.95, 8.95};
    paired p = paired_compare(reference, candidate, 3, 0.05);
    NEAR(p.difference, -0.01, 1e-15);
    NEAR(p.half, 0, 1e-15);
}

static void a_negative_reference_keeps_the_sign(void **state) {
    (void)state;
    const double reference[] = {-10, -10, -10}, candidate[] = {-9, -9, -9};
    NEAR(paired_compare(reference, candidate, 3, 0.05).difference, 0.1, 1e-15);
}

static void missing_values(void **state) {
    (void)state;
    const double reference[] = {10, NAN, 10, 12}, candidate[] = {11, 7, 11, 13};
    paired p = paired_compare(reference, candidate, 4, 0.05);
    assert_int_equal(p.n, 3);
    assert_int_equal(p.lost, 0);
    assert_true(isfinite(p.difference));
    const double lost[] = {11, NAN, NAN, 13};
    p = paired_compare(reference, lost, 4, 0.05);
    assert_int_equal(p.lost, 1);
    assert_int_equal(paired_judge(&p, 0.5), PAIRED_OUTSIDE);
    const double zero[] = {-1, 1};
    p = paired_compare(zero, candidate, 2, 0.05);
    assert_int_equal(paired_judge(&p, 0.5), PAIRED_OPEN);
    p = paired_compare(reference, candidate, 1, 0.05);
    assert_int_equal(paired_judge(&p, 0.5), PAIRED_OPEN);
}

static void looks_double_up_to_the_bound(void **state) {
    (void)state;
    int n[TUNE_LOOKS];
    assert_int_equal(paired_looks(4, 16, n), 3);
    assert_true(n[0] == 4 && n[1] == 8 && n[2] == 16);
    assert_int_equal(paired_looks(4, 7, n), 2);
    assert_true(n[0] == 4 && n[1] == 7);
    assert_int_equal(paired_looks(5, 5, n), 1);
    assert_int_equal(n[0], 5);
}

/* ---- promises -------------------------------------------------------------------------------- */

static uint64_t random_state = 0x9e3779b97f4a7c15u;

static double uniform(void) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return ((double)(random_state >> 11) + 0.5) * 0x1p-53;
}

static double normal(void) {
    double r = sqrt(-2 * log(uniform()));
    return r * cos(6.283185307179586 * uniform());
}

typedef struct outcome {
    int kept, outside, open;
    int missed; /* experiments in which some look's interval misses the truth */
} outcome;

enum { EXPERIMENTS = 4000, FIRST = 4, MOST = 16 };

/* Experiments with a true relative difference, paired noise of `sd` and a tolerance of 2 %. */
static outcome experiment(double truth, double sd) {
    outcome all = {0};
    int pairs[TUNE_LOOKS], looks = paired_looks(FIRST, MOST, pairs);
    for (int i = 0; i < EXPERIMENTS; i++) {
        double reference[MOST], candidate[MOST];
        for (int k = 0; k < MOST; k++) {
            reference[k] = 50;
            candidate[k] = 50 * (1 + truth + sd * normal());
        }
        paired_answer answer = PAIRED_OPEN;
        bool missed = false;
        for (int look = 0; look < looks; look++) {
            paired p = paired_compare(reference, candidate, pairs[look], 0.05 / looks);
            missed = missed || fabs(p.difference - truth) > p.half;
            if (answer == PAIRED_OPEN) answer = paired_judge(&p, 0.02);
        }
        all.kept += answer == PAIRED_WITHIN;
        all.outside += answer == PAIRED_OUTSIDE;
        all.open += answer == PAIRED_OPEN;
        all.missed += missed;
    }
    return all;
}

/* 5 % of 4000 is 200; four standard deviations are 55. Looks overlap, so the rule is stricter. */
static void all_looks_together_miss_in_five_per_cent(void **state) {
    (void)state;
    outcome o = experiment(0.005, 0.01);
    assert_true(o.missed <= 255);
    assert_true(o.missed >= 60); /* not by being useless */
}

static void what_is_too_far_is_seldom_kept(void **state) {
    (void)state;
    const double spread[] = {0.003, 0.01, 0.03};
    for (int i = 0; i < 3; i++)
        assert_true(experiment(0.0201, spread[i]).kept <= 100 + 40); /* 2.5 %: one side alone */
}

static void what_is_near_is_kept_and_what_is_far_is_not(void **state) {
    (void)state;
    assert_true(experiment(0, 0.01).kept >= 0.95 * EXPERIMENTS);
    assert_true(experiment(0.06, 0.01).outside >= 0.95 * EXPERIMENTS);
    assert_true(experiment(0.015, 0.05).open >= 0.8 * EXPERIMENTS); /* noise is no evidence */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_known_case),
        cmocka_unit_test(a_common_spread_drops_out),
        cmocka_unit_test(a_negative_reference_keeps_the_sign),
        cmocka_unit_test(missing_values),
        cmocka_unit_test(looks_double_up_to_the_bound),
        cmocka_unit_test(all_looks_together_miss_in_five_per_cent),
        cmocka_unit_test(what_is_too_far_is_seldom_kept),
        cmocka_unit_test(what_is_near_is_kept_and_what_is_far_is_not),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

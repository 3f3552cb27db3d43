/* Statistics against the arithmetic of the source (A00 §4.3.2.5, Tables 4.4-4.7) and against
 * answers known beforehand. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include "engine/clast.h"
#include "experiments/study/statistics.h"

#define NEAR(a, b, tolerance)                                                                      \
    do {                                                                                           \
        double a_ = (a), b_ = (b);                                                                 \
        if (!(fabs(a_ - b_) <= (tolerance)))                                                       \
            fail_msg("%s = %.10g, want %.10g within %g", #a, a_, b_, (double)(tolerance));         \
    } while (0)

enum { ORIFICES = 5 };
static const double D[ORIFICES] = {5, 6.5, 7.5, 8.5, 10};
static const double q_exp[ORIFICES] = {52.91, 76.84, 103.75, 126.32, 168.85}; /* Table 4.4 */
static const double q_sim[ORIFICES] = {41.95, 56.72, 108.96, 124.03, 169.56}; /* Table 4.5 */
static const double rho_exp[ORIFICES] = {0.237, 0.23, 0.226, 0.226, 0.227};   /* Table 4.4 */
static const double rho_sim[ORIFICES] = {0.217, 0.217, 0.215, 0.208, 0.205};  /* Table 4.5 */
static const double c_exp[ORIFICES] = {0.39, 0.37, 0.40, 0.39, 0.40};
static const double c_sim[ORIFICES] = {0.34, 0.30, 0.44, 0.41, 0.44};

/* ---- the source's own numbers
 * ---------------------------------------------------------------------- */

static void kd_of_the_thesis(void **state) {
    (void)state;
    beverloo e = beverloo_fit(D, q_exp, ORIFICES, 1.2), s = beverloo_fit(D, q_sim, ORIFICES, 1.2);
    NEAR(e.kd, 0.889, 0.0005);
    NEAR(s.kd, 2.10, 0.005);
    NEAR(e.k, 0.74, 0.005);
    NEAR(s.k, 1.75, 0.005);
    assert_true(e.kd_half > 0 && s.kd_half > e.kd_half); /* the simulation scatters more */
}

static void wide_orifices_do_not_give_k_066(void **state) {
    (void)state;
    double both_D[6], both_q[6];
    for (int i = 0; i < 3; i++) {
        both_D[i] = both_D[i + 3] = D[i + 2];
        both_q[i] = q_exp[i + 2];
        both_q[i + 3] = q_sim[i + 2];
    }
    NEAR(beverloo_fit(D + 2, q_exp + 2, 3, 1.2).k, 0.87, 0.005);
    NEAR(beverloo_fit(D + 2, q_sim + 2, 3, 1.2).k, 0.39, 0.005);
    NEAR(beverloo_fit(both_D, both_q, 6, 1.2).k, 0.64, 0.005);
}

static void c_of_the_thesis(void **state) {
    (void)state;
    for (int i = 0; i < ORIFICES; i++) { /* printed to two digits, one of them 0.291 as 0.3 */
        NEAR(beverloo_c(q_exp[i], rho_exp[i], D[i], 0.89, 1.2), c_exp[i], 0.01);
        NEAR(beverloo_c(q_sim[i], rho_sim[i], D[i], 0.89, 1.2), c_sim[i], 0.01);
    }
    interval e = mean_interval(c_exp, ORIFICES), s = mean_interval(c_sim, ORIFICES);
    NEAR(e.mean, 0.390, 0.0005);
    NEAR(e.sd, 0.0122, 0.00006);
    NEAR(s.mean, 0.386, 0.0005);
    NEAR(s.sd, 0.0631, 0.00006);
    t_test pooled = t_test_pooled(e, s), welch = t_test_welch(e, s);
    NEAR(pooled.t, 0.14, 0.005);
    NEAR(pooled.df, 8, 0);
    NEAR(pooled.p, 0.90, 0.01);
    NEAR(welch.t, pooled.t, 1e-12); /* equal n */
    NEAR(welch.p, 0.90, 0.01);
    assert_true(welch.df < 5);
}

/* P = 0.90 did not show that the two C are equal: at a margin of 0.05 the data cannot. */
static void missing_significance_is_not_equality(void **state) {
    (void)state;
    interval e = mean_interval(c_exp, ORIFICES), s = mean_interval(c_sim, ORIFICES);
    assert_false(equivalence_test(s, e, 0.05).equal);
    assert_true(equivalence_test(s, e, 0.08).equal);
}

static void mean_error_of_the_thesis(void **state) {
    (void)state;
    double error[ORIFICES];
    for (int i = 0; i < ORIFICES; i++) error[i] = 100 * fabs(q_sim[i] / q_exp[i] - 1);
    NEAR(mean_interval(error, ORIFICES).mean, 10.8, 0.05);
}

/* ---- known answers --------------------------------------------------------------------------- */

static void mean_with_interval(void **state) {
    (void)state;
    const double x[4] = {1.7, 2.9, 3.1, 4.7};
    interval r = mean_interval(x, 4);
    NEAR(r.mean, 3.1, 1e-12);
    NEAR(r.sd, sqrt(4.56 / 3), 1e-12);
    NEAR(r.half, 3.182446305 * sqrt(4.56 / 3) / 2, 1e-8); /* t(0.975, 3) from a table */
    assert_true(isnan(mean_interval(x, 1).half) && mean_interval(x, 1).mean == 1.7);
    assert_true(isnan(mean_interval(NULL, 0).mean));
}

static void line_through_points(void **state) {
    (void)state;
    const double x[5] = {-1.3, 0.4, 2.2, 3.9, 7.1}, e[5] = {0.1, -0.3, 0.2, 0.1, -0.1};
    double y[5];
    for (int i = 0; i < 5; i++) y[i] = 2.7 * x[i] - 13.1;
    fitted_line exact = line_fit(x, y, 5);
    NEAR(exact.slope, 2.7, 1e-12);
    NEAR(exact.intercept, -13.1, 1e-12);
    NEAR(exact.r2, 1, 1e-12);
    for (int i = 0; i < 5; i++) y[i] += e[i];
    fitted_line r = line_fit(x, y, 5); /* textbook formulas, written out */
    double mx = 2.46, my = 0, sxx = 0, sxy = 0, left = 0;
    for (int i = 0; i < 5; i++) my += y[i] / 5;
    for (int i = 0; i < 5; i++) sxx += (x[i] - mx) * (x[i] - mx), sxy += (x[i] - mx) * (y[i] - my);
    for (int i = 0; i < 5; i++) left += pow(y[i] - my - sxy / sxx * (x[i] - mx), 2);
    NEAR(r.slope, sxy / sxx, 1e-12);
    NEAR(r.slope_error, sqrt(left / 3 / sxx), 1e-12);
    NEAR(r.intercept_error, sqrt(left / 3 * (1.0 / 5 + mx * mx / sxx)), 1e-12);
}

static void line_without_enough_points(void **state) {
    (void)state;
    const double x[3] = {2.2, 2.2, 2.2}, y[3] = {1, 2, 3};
    assert_true(isnan(line_fit(x, y, 3).slope));
    assert_true(isnan(line_fit(y, x, 1).slope));
    assert_true(isnan(line_fit(NULL, NULL, 0).slope));
    fitted_line two = line_fit(y, y, 2);
    NEAR(two.slope, 1, 1e-12);
    assert_true(isnan(two.slope_error));
    assert_true(isnan(line_fit(y, x, 3).r2)); /* a flat line: no variance to explain */
}

/* A discharge with start-up, steady part, dying end and silence. */
enum { SAMPLES = 400 };
static double discharged(double t) {
    if (t < 0.3) return 0;
    if (t < 0.5) return 73.0 / 0.4 * (t - 0.3) * (t - 0.3); /* meets the steady slope */
    if (t < 1.1) return 7.3 + 73 * (t - 0.5);
    return 51.1 + 6.4 * (1 - exp(-(t - 1.1) * 73 / 6.4));
}

static void linear_part_of_a_discharge(void **state) {
    (void)state;
    double t[SAMPLES], m[SAMPLES];
    for (int i = 0; i < SAMPLES; i++) t[i] = 0.01 * i, m[i] = discharged(t[i]);
    linear_window w = linear_part(t, m, SAMPLES, 0.9999);
    NEAR(w.slope, 73, 1);
    NEAR(w.from, 0.47, 0.05);
    NEAR(w.to, 1.13, 0.05);
    assert_true(w.r2 >= 0.9999 && t[w.first] == w.from && t[w.first + w.count - 1] == w.to);
    linear_window loose = linear_part(t, m, SAMPLES, 0.99);
    assert_true(m[loose.first + loose.count - 1] - m[loose.first] >
                m[w.first + w.count - 1] - m[w.first]);
    assert_true(loose.to < 1.6); /* not the silence */
}

/* Two implementations, one answer: every window by its own least squares. */
static void linear_part_by_brute_force(void **state) {
    (void)state;
    enum { N = 40 };
    for (uint64_t seed = 1; seed <= 30; seed++) {
        double t[N], m[N];
        for (int i = 0; i < N; i++) {
            t[i] = 17.3 + 0.013 * i;
            m[i] = i ? m[i - 1] + 3 * (clast_random(seed, 1, (uint64_t)i) > 0.4) : 1200;
        }
        double most = 0, straightest = 0;
        int first = 0, count = 0;
        for (int i = 0; i < N; i++)
            for (int j = i + LINEAR_PART_SAMPLES - 1; j < N; j++) {
                double r2 = line_fit(t + i, m + i, j - i + 1).r2, mass = m[j] - m[i];
                if (!(r2 >= 0.98) || mass < most || (mass == most && r2 <= straightest + 1e-12))
                    continue;
                most = mass, straightest = r2, first = i, count = j - i + 1;
            }
        linear_window w = linear_part(t, m, N, 0.98);
        if (w.first != first || w.count != count)
            fail_msg("seed %d: %d+%d, want %d+%d", (int)seed, w.first, w.count, first, count);
        if (count) NEAR(w.slope, line_fit(t + first, m + first, count).slope, 1e-9);
    }
}

static void linear_part_of_nothing(void **state) {
    (void)state;
    const double t[6] = {0, 1, 2, 3, 4, 5}, still[6] = {7, 7, 7, 7, 7, 7};
    assert_int_equal(linear_part(t, still, 6, 0.99).count, 0);
    assert_true(isnan(linear_part(t, still, 6, 0.99).slope));
    assert_int_equal(linear_part(t, t, 4, 0.99).count, 0); /* too few */
    assert_int_equal(linear_part(t, t, 6, 0.99).count, 6);
    assert_int_equal(linear_part(NULL, NULL, 0, 0.99).count, 0);
}

static void beverloo_recovered(void **state) {
    (void)state;
    double q[ORIFICES], narrow[1] = {4};
    for (int i = 0; i < ORIFICES; i++) q[i] = 5.7 * pow(D[i] - 1.31, 1.5);
    beverloo b = beverloo_fit(D, q, ORIFICES, 1.21);
    NEAR(b.kd, 1.31, 1e-9);
    NEAR(b.k, 1.31 / 1.21, 1e-9);
    NEAR(b.kd_half, 0, 1e-6);
    assert_true(isnan(beverloo_fit(narrow, q, 1, 1.2).kd));
    assert_true(isnan(beverloo_fit(D, q, 2, 1.2).kd_half));
    double C = 0.4;
    double one = C * 4 * sqrt(2) / acos(-1) * sqrt(981) * 0.23 * 1.2 * pow(7.5 - 0.9, 1.5);
    NEAR(beverloo_c(one, 0.23, 7.5, 0.9, 1.2), C, 1e-12);
    assert_true(isnan(beverloo_c(one, 0.23, 0.8, 0.9, 1.2)));
}

/* The delta method against 4000 repeated experiments with noise. */
static void beverloo_interval_covers(void **state) {
    (void)state;
    int inside = 0, runs = 4000;
    for (int r = 0; r < runs; r++) {
        double q[ORIFICES];
        for (int i = 0; i < ORIFICES; i++) {
            double noise = 0; /* nearly normal, sd 1 */
            for (int k = 0; k < 12; k++)
                noise += clast_random(71, (uint64_t)r, (uint64_t)(12 * i + k)) - 0.5;
            q[i] = pow(3.3 * (D[i] - 0.9) + 0.4 * noise, 1.5);
        }
        beverloo b = beverloo_fit(D, q, ORIFICES, 1.2);
        inside += fabs(b.kd - 0.9) <= b.kd_half;
    }
    NEAR(100.0 * inside / runs, 95, 1.5);
}

static void tests_of_means(void **state) {
    (void)state;
    interval a = {0.2, 0.05, NAN, 5}, b = {0.23, 0.02, NAN, 9};
    t_test p = t_test_pooled(a, b), w = t_test_welch(a, b);
    NEAR(p.t, -0.03 / sqrt((4 * 0.0025 + 8 * 0.0004) / 12 * (1 / 5.0 + 1 / 9.0)), 1e-12);
    NEAR(p.df, 12, 0);
    double va = 0.0025 / 5, vb = 0.0004 / 9;
    NEAR(w.t, -0.03 / sqrt(va + vb), 1e-12);
    NEAR(w.df, (va + vb) * (va + vb) / (va * va / 4 + vb * vb / 8), 1e-9);
    NEAR(t_test_welch(a, a).p, 1, 1e-12);
    interval ten = {1.4, 2, NAN, 16}; /* 1.4/(2/4) = 2.8; P(|t15| > 2.8) from a table is 0.0134 */
    NEAR(t_test_welch(ten, interval_exact(0)).p, 0.0134, 0.0001);
    assert_true(isnan(t_test_pooled(a, interval_exact(1)).p));
    assert_true(isnan(t_test_welch(interval_exact(2), interval_exact(1)).p));
    interval still = {1, 0, 0, 3};
    assert_true(t_test_welch(still, still).p == 1);
    assert_true(isinf(t_test_welch(still, interval_exact(0.9)).t));
}

static void tests_of_equality(void **state) {
    (void)state;
    interval a = {0.84, 0.011, NAN, 5};
    /* |t| of the nearer bound: (0.02 - 0.003)/(0.011/sqrt 5) = 3.456, P(t4 > 3.456) = 0.01294 */
    equivalence e = equivalence_test(a, interval_exact(0.837), 0.02);
    NEAR(e.p, 0.01294, 0.0002);
    assert_true(e.equal);
    NEAR(equivalence_test(interval_exact(0.837), a, 0.02).p, e.p, 1e-12); /* either way round */
    assert_false(equivalence_test(a, interval_exact(0.83), 0.015).equal);
    assert_false(equivalence_test(a, interval_exact(0.9), 0.02).equal);
    NEAR(equivalence_test(a, interval_exact(0.86), 0.02).p, 0.5, 1e-9); /* on the bound */
    assert_true(equivalence_test(interval_exact(1), interval_exact(1.01), 0.02).equal);
    assert_false(equivalence_test(interval_exact(NAN), interval_exact(1), 0.02).equal);
}

/* Worked by hand: a fall from 5 (sd 0.2, 4 runs) to 4 (sd 0.1, 2 runs) is 20 %. Slopes 100*4/25 =
 * 16 and -100/5 = -20; squared errors (16*0.2)^2/4 = 2.56 and (20*0.1)^2/2 = 2, together 4.56;
 * degrees of freedom 4.56^2 / (2.56^2/3 + 2^2/1) = 20.7936/6.184533 = 3.36219. */
static void a_fall_has_welch_and_satterthwaite(void **state) {
    (void)state;
    interval a = {5, 0.2, NAN, 4}, b = {4, 0.1, NAN, 2};
    double slope[2] = {16, -20};
    estimate e = estimate_of(20, (interval[]){a, b}, slope, 2);
    NEAR(e.error, sqrt(4.56), 1e-12);
    NEAR(e.df, 3.36219, 1e-5);
    interval fall = fall_percent(a, b);
    NEAR(fall.mean, 20, 1e-12);
    NEAR(fall.half, 2.995 * sqrt(4.56), 0.01); /* t between 3.182 (3) and 2.776 (4) */
    assert_true(fall.n == 2 && isnan(fall.sd));
    assert_true(isnan(fall_percent(a, interval_exact(4)).half));
    fall = fall_percent(interval_exact(0), b);
    assert_true(isnan(fall.mean) && isnan(fall.half));
}

/* With the same spread and number on both sides it is the pooled test; beside that of one mean. */
static void an_estimate_is_tested_as_a_difference(void **state) {
    (void)state;
    interval a = {0.2, 0.05, NAN, 5}, b = {0.23, 0.02, NAN, 9}, zero = interval_exact(0);
    double apart[2] = {1, -1}, alone[2] = {1, 0};
    estimate e = estimate_of(-0.03, (interval[]){a, b}, apart, 2);
    NEAR(2 * (1 - estimate_above_p(e)), t_test_welch(a, b).p, 1e-12);
    estimate one = estimate_of(0.2, (interval[]){a, zero}, alone, 2);
    NEAR(one.df, 4, 1e-12);
    NEAR(one.error, 0.05 / sqrt(5), 1e-15);
    assert_true(one.n == 1);
    interval still = {1, 0, 0, 3};
    assert_true(estimate_above_p(estimate_of(1, &still, apart, 1)) == 0);
    assert_true(estimate_interval(estimate_of(1, &still, apart, 1)).half == 0);
    assert_true(isnan(estimate_above_p(estimate_of(0, &still, apart, 1))));
}

enum { PROFILE = 61 };
static void profile_of(double x[PROFILE], double v[PROFILE], double v0, double b, double noise) {
    for (int i = 0; i < PROFILE; i++) {
        x[i] = -7.1 + 14.2 * i / (PROFILE - 1);
        v[i] =
            v0 * exp(-x[i] * x[i] / (4 * b * 9)) + noise * (clast_random(5, 3, (uint64_t)i) - 0.5);
    }
}

static void kinematic_recovered(void **state) {
    (void)state;
    double x[PROFILE], v[PROFILE];
    profile_of(x, v, -0.43, 0.71, 0);
    kinematic k = kinematic_fit(x, v, PROFILE, 9, -0.43),
              f = kinematic_fit_free(x, v, PROFILE, 9, -0.3);
    assert_true(k.found && f.found);
    NEAR(k.b, 0.71, 1e-6);
    NEAR(k.rms, 0, 1e-7);
    NEAR(f.b, 0.71, 1e-6);
    NEAR(f.v0, -0.43, 1e-7);
    profile_of(x, v, -0.43, 0.71, 0.08);
    k = kinematic_fit(x, v, PROFILE, 9, -0.43), f = kinematic_fit_free(x, v, PROFILE, 9, -0.6);
    NEAR(k.b, 0.71, 2 * k.b_half);
    NEAR(f.b, 0.71, 2 * f.b_half);
    NEAR(f.v0, -0.43, 2 * f.v0_half);
    NEAR(k.rms, 0.08 / sqrt(12), 0.004);
    assert_true(k.b_half > 0 && f.b_half > k.b_half && f.rms <= k.rms);
}

/* No B near the one found leaves less. */
static void kinematic_is_the_least(void **state) {
    (void)state;
    double x[PROFILE], v[PROFILE];
    profile_of(x, v, -0.4, 0.9, 0.1);
    kinematic k = kinematic_fit(x, v, PROFILE, 9, -0.37);
    for (int i = -50; i <= 50; i++) {
        double b = k.b * (1 + 0.01 * i), sum = 0;
        for (int j = 0; j < PROFILE; j++)
            sum += pow(v[j] + 0.37 * exp(-x[j] * x[j] / (4 * b * 9)), 2);
        assert_true(sqrt(sum / PROFILE) >= k.rms * (1 - 1e-12));
    }
}

static void kinematic_of_nothing(void **state) {
    (void)state;
    const double x[3] = {-1, 0.2, 1.4}, flat[3] = {0.3, 0.3, 0.3}, centre[2] = {0, 0};
    assert_false(kinematic_fit(x, flat, 3, 9, 0.3).found); /* B would be infinite */
    assert_false(kinematic_fit(x, flat, 3, 9, 0).found);
    assert_false(kinematic_fit(centre, flat, 2, 9, 0.3).found);
    assert_false(kinematic_fit(NULL, NULL, 0, 9, 0.3).found);
    assert_false(kinematic_fit_free(x, flat, 2, 9, 0.3).found);
    assert_true(isnan(kinematic_fit(x, flat, 3, 9, 0.3).b));
    NEAR(centre_velocity(x, flat, 3, 1), 0.3, 1e-12);
    assert_true(isnan(centre_velocity(x, flat, 3, 0.2)));
}

static void arches_found(void **state) {
    (void)state;
    const double t[12] = {0, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1};
    const double out[12] = {0, 0, 0, 2, 3, 3, 3, 3, 7, 8, 8, 8};
    arch events[4];
    arches a = arch_events(t, out, 12, 0.25, events, 4);
    assert_int_equal(a.n, 1); /* neither the wait at the start nor the silence at the end */
    NEAR(events[0].start, 0.4, 1e-12);
    NEAR(events[0].length, 0.4, 1e-12);
    NEAR(a.total, 0.4, 1e-12);
    NEAR(a.longest, 0.4, 1e-12);
    NEAR(a.last, 0.9, 1e-12);
    NEAR(a.silent, 0.2, 1e-12);
    assert_false(arch_is_permanent(&a, 0.25, 50)); /* not silent long enough to say so */
    assert_true(arch_is_permanent(&a, 0.15, 50));
    assert_false(arch_is_permanent(&a, 0.15, 0)); /* only the heap is left */
    double left[12];
    for (int i = 0; i < 12; i++) left[i] = 200 - out[i];
    assert_int_equal(arch_events(t, left, 12, 0.25, NULL, 0).n, 1);  /* bodies left do as well */
    assert_int_equal(arch_events(t, out, 12, 0.05, events, 1).n, 3); /* counted beyond the room */
    arches none = arch_events(t, out, 2, 0.25, NULL, 0);
    assert_true(none.n == 0 && isnan(none.last) && none.silent == 0.1);
    assert_int_equal(arch_events(NULL, NULL, 0, 0.25, NULL, 0).n, 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(kd_of_the_thesis),
        cmocka_unit_test(wide_orifices_do_not_give_k_066),
        cmocka_unit_test(c_of_the_thesis),
        cmocka_unit_test(missing_significance_is_not_equality),
        cmocka_unit_test(mean_error_of_the_thesis),
        cmocka_unit_test(mean_with_interval),
        cmocka_unit_test(line_through_points),
        cmocka_unit_test(line_without_enough_points),
        cmocka_unit_test(linear_part_of_a_discharge),
        cmocka_unit_test(linear_part_by_brute_force),
        cmocka_unit_test(linear_part_of_nothing),
        cmocka_unit_test(beverloo_recovered),
        cmocka_unit_test(beverloo_interval_covers),
        cmocka_unit_test(tests_of_means),
        cmocka_unit_test(tests_of_equality),
        cmocka_unit_test(a_fall_has_welch_and_satterthwaite),
        cmocka_unit_test(an_estimate_is_tested_as_a_difference),
        cmocka_unit_test(kinematic_recovered),
        cmocka_unit_test(kinematic_is_the_least),
        cmocka_unit_test(kinematic_of_nothing),
        cmocka_unit_test(arches_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

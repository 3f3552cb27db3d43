/* test_closed_forms.c - distributions whose numbers are known: by quantiles, so without noise. */
#include "tests/support/check.h"

#include <gsl/gsl_cdf.h>

#include "experiments/rtd/rtd.h"

static const double PI = 3.14159265358979323846;

enum { TRACERS = 4000 };
static const double MEAN = 612.3, SPACING = 1.7; /* s */

/* Enters tracers one by one, with residence times in an order that mixes fast and slow. */
static rtd *analysed(const double *residence, const double *diameter, double mass,
                     const rtd_options *o) {
    static passage all[TRACERS];
    double end = 0;
    for (size_t i = 0; i < TRACERS; i++) {
        double in = SPACING * (double)(i + 1), out = in + residence[i * 1237 % TRACERS];
        double d = diameter ? diameter[i * 1237 % TRACERS] : 0.013;
        all[i] = (passage){(uint32_t)i, in, out, mass, d};
        if (isfinite(out)) end = fmax(end, out);
    }
    char why[RTD_ERROR_MAX] = "";
    passages *p = passages_new(all, TRACERS, end + 20 * MEAN);
    rtd *r = rtd_new(p, o, why);
    passages_free(p);
    if (!r) fail_msg("%s", why);
    return r;
}

static const rtd_options PLAIN = {
    .sampling = 60, .from = 1e-3, .until = SPACING * (TRACERS + 1), .resamples = 50};

static void of_plug_flow(void **state) {
    (void)state;
    static double t[TRACERS];
    for (int i = 0; i < TRACERS; i++) t[i] = MEAN;
    rtd *r = analysed(t, NULL, 2e-3, &PLAIN);
    CHECK_CLOSE(r->of[RTD_MEAN].mean, MEAN, 1e-12);
    CHECK_NEAR(r->of[RTD_SPREAD].mean, 0, 1e-20);
    assert_int_equal(r->bins, 11); /* 612.3 s lie in the eleventh minute */
    CHECK_NEAR(r->share[9], 0, 0);
    CHECK_NEAR(r->share[10], 1, 1e-12);
    CHECK_CLOSE(r->density[10], 1.0 / 60, 1e-12);
    assert_true(isnan(r->of[RTD_SIZE_SLOPE].mean)); /* one size */
    CHECK_CLOSE(r->little.mean, 1.0,
                0.06); /* it fills and empties: half a mean at each end is missing */
    rtd_free(r);
}

static void of_stirred_tanks(void **state) {
    (void)state;
    static double t[TRACERS];
    const double tanks[3] = {1, 3.4, 40};
    for (int k = 0; k < 3; k++) {
        double n = tanks[k];
        for (int i = 0; i < TRACERS; i++)
            t[i] = gsl_cdf_gamma_Pinv((i + 0.5) / TRACERS, n, MEAN / n);
        rtd *r = analysed(t, NULL, 2e-3, &PLAIN);
        /* quantiles miss a little of the tail: most of an exponential's */
        CHECK_CLOSE(r->of[RTD_MEAN].mean, MEAN, 2e-4);
        CHECK_CLOSE(r->of[RTD_TANKS].mean, n, 4e-3);
        CHECK_CLOSE(r->of[RTD_SKEWNESS].mean, 2 / sqrt(n), 3e-2);
        CHECK_CLOSE(r->tanks.shape, n, 2e-3);
        CHECK_CLOSE(r->tanks.mean, MEAN, 1e-3);
        for (size_t j = 0; j < r->bins; j++) {
            double wanted = tanks_share(60 * (double)(j + 1), MEAN, n);
            CHECK_NEAR(r->share[j], wanted, 1.0 / TRACERS);
            CHECK_CLOSE(r->density[j], (r->share[j] - (j ? r->share[j - 1] : 0)) / 60, 1e-12);
        }
        rtd_free(r);
    }
}

/* Time by which a share has left, by halving. */
static double quantile(double share, double peclet) {
    double low = 0, high = 100 * MEAN;
    for (int i = 0; i < 200; i++) {
        double middle = 0.5 * (low + high);
        if (dispersion_share(middle, MEAN, peclet) < share)
            low = middle;
        else
            high = middle;
    }
    return high;
}

/* The share itself against the density of the first passage, summed up by Simpson's rule. */
static void of_first_passages(void **state) {
    (void)state;
    const double peclet = 13.7, step = MEAN / 20000;
    double share = 0;
    for (int i = 1; i <= 40000; i++) {
        double part = 0;
        for (int k = 0; k < 3; k++) {
            double theta = (i - 1 + 0.5 * k) * step / MEAN;
            if (theta == 0) continue;
            part += (k == 1 ? 4 : 1) * sqrt(peclet / (4 * PI * theta * theta * theta)) / MEAN *
                    exp(-peclet * (1 - theta) * (1 - theta) / (4 * theta));
        }
        share += part * step / 6;
        if (i % 4000 == 0) CHECK_NEAR(dispersion_share(i * step, MEAN, peclet), share, 1e-9);
    }
    CHECK_NEAR(dispersion_share(MEAN, MEAN, 1e6), 0.5, 1e-3); /* no overflow: a step at the mean */
    CHECK_NEAR(dispersion_share(0.99 * MEAN, MEAN, 1e6), 0, 1e-9);
    CHECK_NEAR(dispersion_share(1.01 * MEAN, MEAN, 1e6), 1, 1e-9);
}

static void of_axial_dispersion(void **state) {
    (void)state;
    static double t[TRACERS];
    const double peclet[2] = {17.3, 220};
    for (int k = 0; k < 2; k++) {
        for (int i = 0; i < TRACERS; i++) t[i] = quantile((i + 0.5) / TRACERS, peclet[k]);
        rtd *r = analysed(t, NULL, 2e-3, &PLAIN);
        CHECK_CLOSE(r->of[RTD_MEAN].mean, MEAN, 2e-4);
        CHECK_CLOSE(r->of[RTD_PECLET_OPEN].mean, peclet[k], 4e-3);
        CHECK_CLOSE(r->dispersion.shape, peclet[k], 3e-3);
        CHECK_CLOSE(r->dispersion.mean, MEAN, 1e-3);
        /* the wrong model fits worse */
        CHECK_BELOW(3 * r->dispersion.misfit, r->tanks.misfit);
        rtd_free(r);
    }
}

/* A tenth never leaves: the rest has the numbers that it has alone. */
static void of_those_that_leave(void **state) {
    (void)state;
    static double tanks[TRACERS], flow[TRACERS];
    enum { LEAVE = TRACERS / 10 * 9 };
    const double n = 3.4, peclet = 17.3;
    for (int i = 0, k = 0; i < TRACERS; i++) {
        bool stays = i % 10 == 9;
        double share = (k + 0.5) / LEAVE;
        tanks[i] = stays ? INFINITY : gsl_cdf_gamma_Pinv(share, n, MEAN / n);
        flow[i] = stays ? INFINITY : quantile(share, peclet);
        k += !stays;
    }
    rtd *in_tanks = analysed(tanks, NULL, 2e-3, &PLAIN),
        *in_flow = analysed(flow, NULL, 2e-3, &PLAIN);
    CHECK_CLOSE(in_tanks->of[RTD_INSIDE].mean, 0.1, 1e-9);
    CHECK_CLOSE(in_tanks->of[RTD_TANKS].mean, n, 4e-3);
    CHECK_CLOSE(in_tanks->tanks.shape, n, 2e-3);
    CHECK_CLOSE(in_tanks->tanks.mean, MEAN, 1e-3);
    CHECK_CLOSE(in_flow->of[RTD_PECLET_OPEN].mean, peclet, 4e-3);
    CHECK_CLOSE(in_flow->dispersion.shape, peclet, 3e-3);
    CHECK_CLOSE(in_flow->dispersion.mean, MEAN, 1e-3);
    for (size_t j = 0; j < in_flow->bins; j++) {
        rtd_fitted fitted = rtd_fitted_bin(in_flow, dispersion_share, &in_flow->dispersion, j);
        CHECK_NEAR(fitted.share, in_flow->share[j], 1e-3); /* both of all that was fed */
    }
    rtd_free(in_tanks), rtd_free(in_flow);
}

static void of_the_closed_vessel(void **state) {
    (void)state;
    /* 2/Pe - 2 (1 - exp(-Pe)) / Pe2 worked out with 30 digits */
    CHECK_CLOSE(spread_of_peclet_closed(1), 0.735758882342884644, 1e-12);
    CHECK_CLOSE(spread_of_peclet_closed(10), 0.180000907998595249, 1e-12);
    for (double spread = 0.003; spread < 0.99; spread *= 1.7)
        CHECK_CLOSE(spread_of_peclet_closed(peclet_closed(spread)), spread, 1e-9);
    CHECK_NEAR(peclet_open(0.01) - peclet_closed(0.01), 1, 0.02);
    assert_true(isnan(peclet_closed(1.2)) && isnan(peclet_closed(0)));
}

/* S12 3.58 by hand: (1 x 10 + 2 x 20 + 3 x 40) / 6. */
static void of_the_mean_by_mass(void **state) {
    (void)state;
    const tracer t[3] = {{.time = 10, .mass = 1, .left = true},
                         {.time = 20, .mass = 2, .left = true},
                         {.time = 40, .mass = 3, .left = true}};
    double w[3];
    CHECK_NEAR(product_limit(t, 3, NULL, w), 0, 1e-15);
    CHECK_CLOSE(w[1], 1.0 / 3, 1e-14);
    rtd_moments m = moments_of_weights(t, 3, w);
    CHECK_CLOSE(m.mean, 170.0 / 6, 1e-14);
    CHECK_CLOSE(m.variance, (100.0 + 800 + 4800) / 6 - 170.0 * 170 / 36, 1e-12);
}

/* t = 500 s - 2e4 s/m (d - 12 mm), shaken by a tenth. */
static void of_sizes(void **state) {
    (void)state;
    static double t[TRACERS], d[TRACERS];
    dice die = {.seed = 5};
    printf("seed %d\n", (int)die.seed);
    for (int i = 0; i < TRACERS; i++) {
        d[i] = roll(&die, 0.012, 0.021);
        t[i] = 500 - 2e4 * (d[i] - 0.012) + roll(&die, -50, 50);
    }
    rtd_options o = PLAIN;
    o.resamples = 300;
    rtd *r = analysed(t, d, 2e-3, &o);
    CHECK_NEAR(r->of[RTD_SIZE_SLOPE].mean, -2e4, r->of[RTD_SIZE_SLOPE].half);
    CHECK_BELOW(r->of[RTD_SIZE_SLOPE].half, 1e3);
    CHECK_NEAR(r->of[RTD_SIZE_RANK].mean, -0.87, 0.02); /* sd 52 of the line, 29 of the noise */
    rtd_free(r);
}

TEST_MAIN(cmocka_unit_test(of_plug_flow), cmocka_unit_test(of_stirred_tanks),
          cmocka_unit_test(of_first_passages), cmocka_unit_test(of_axial_dispersion),
          cmocka_unit_test(of_those_that_leave), cmocka_unit_test(of_the_closed_vessel),
          cmocka_unit_test(of_the_mean_by_mass), cmocka_unit_test(of_sizes))

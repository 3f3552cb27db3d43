/* The rebound that the scene asks for: the solved damping ratio against closed form and an adaptive
 * reference, then the running engine, with its order of convergence. Rejected as a reference: the
 * closed forms S12 2.21 and A00 1.20, which leave the cut-off out (FACTS 1). */
#include <gsl/gsl_errno.h>
#include <gsl/gsl_integration.h>
#include <gsl/gsl_odeiv2.h>

#include "tests/support/collision.h"

static const double ASKED[6] = {0.1, 0.3, 0.55, 0.72, 0.9, 1.0};

/* ---- the solved damping ratio ---------------------------------------------------------------- */

/* S12 2.18 with the cut-off 2.23: released where the force vanishes, not where the overlap does. */
static double linear_closed_form(double z) {
    if (z < 1) {
        double w = sqrt(1 - z * z);
        return exp(-z / w * atan2(2 * z * w, 2 * z * z - 1));
    }
    double w = sqrt(z * z - 1);
    return exp(-z / w * log((z + w) / (z - w))); /* the same, continued past critical damping */
}

static void linear_restitution_has_a_closed_form(void **state) {
    (void)state;
    for (double z = 0.013; z < 4; z *= 1.37) {
        if (fabs(z - 1) < 1e-3) continue;
        CHECK_CLOSE(clast_restitution(CLAST_LAW_LINEAR, z), linear_closed_form(z), 1e-9);
    }
}

static int hertz_rates(double t, const double y[], double f[], void *params) {
    (void)t;
    double x = y[0] > 0 ? y[0] : 0, beta = *(double *)params;
    f[0] = y[1];
    f[1] = -x * sqrt(x) - 2 * beta * sqrt(1.5 * sqrt(x)) * y[1];
    return GSL_SUCCESS;
}

/* Rebound by an adaptive eighth-order scheme, stepped until the force pulls, then bisected. */
static double hertz_reference(double beta) {
    gsl_odeiv2_system system = {hertz_rates, NULL, 2, &beta};
    gsl_odeiv2_driver *d =
        gsl_odeiv2_driver_alloc_y_new(&system, gsl_odeiv2_step_rk8pd, 1e-6, 1e-14, 1e-13);
    double y[2] = {0, 1}, before[2] = {0, 1}, t = 0, dt = 2e-3, rates[2];
    for (;;) {
        before[0] = y[0], before[1] = y[1];
        double until = t + dt;
        gsl_odeiv2_driver_apply(d, &t, until, y);
        hertz_rates(t, y, rates, &beta);
        if (!(y[1] < 0 && rates[1] >= 0)) continue;
        if (dt < 1e-10) break;
        t -= dt, dt /= 4;
        y[0] = before[0], y[1] = before[1];
        gsl_odeiv2_driver_reset(d);
    }
    gsl_odeiv2_driver_free(d);
    return -y[1];
}

/* The engine's fixed steps meet x^(1/4) at the onset: 9e-7 is theirs. */
static void hertz_restitution_agrees_with_an_adaptive_integration(void **state) {
    (void)state;
    double worst = 0;
    for (double beta = 0.021; beta < 1.5; beta *= 2.1)
        worst = fmax(worst, fabs(clast_restitution(CLAST_LAW_HERTZ_MINDLIN, beta) -
                                 hertz_reference(beta)));
    print_message("Hertz: solved restitution off by %.1e at most\n", worst);
    CHECK_BELOW(worst, 1e-6);
}

static void the_damping_ratio_inverts_the_restitution(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++)
        for (int l = 1; l < 3; l++) {
            double beta = clast_damping_ratio(LAWS[l], ASKED[i]);
            CHECK_NEAR(clast_restitution(LAWS[l], beta), ASKED[i], 1e-11);
            if (ASKED[i] == 1) assert_true(beta == 0);
        }
    assert_true(clast_damping_ratio(CLAST_LAW_HERTZ_A00, 0.72) ==
                clast_damping_ratio(CLAST_LAW_HERTZ_MINDLIN, 0.72));
}

/* ---- the running engine ---------------------------------------------------------------------- */

/* Worst error over four places within a step where the contact can begin. */
static double error_at(collision c, double resolution) {
    double worst = 0;
    for (int i = 0; i < 4; i++) {
        c.resolution = resolution;
        c.phase = 0.03 + 0.25 * i;
        worst = fmax(worst, fabs(collide(&c).restitution - c.pair.restitution));
    }
    return worst;
}

/* Leapfrog takes the dashpot's velocity half a step late: first order with damping, with a small
 * coefficient near e = 1. Without damping the onset of the contact decides: 2.5 (Hertz), 3
 * (linear). */
static void check_convergence(clast_law law, const char *name, double e, bool against_plane) {
    collision c = {.law = law, .pair = pair_of(e, 0.3), .against_plane = against_plane};
    double coarse = error_at(c, 80), fine = error_at(c, 640), order = order_of(coarse, fine, 8);
    print_message("%s %s e %.2f: error %.2e at 80 steps per contact, %.2e at 640, order %.2f\n",
                  name, against_plane ? "plane " : "sphere", e, coarse, fine, order);
    if (e == 1) CHECK_NEAR(order, law == CLAST_LAW_LINEAR ? 3 : 2.5, 0.05);
    else CHECK_BELOW(0.97, order);
    CHECK_BELOW(fine, 8.0e-4);
}

static void every_law_rebounds_as_asked(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++)
        for (int i = 0; i < 6; i++) check_convergence(LAWS[l], LAW_NAMES[l], ASKED[i], i % 2);
}

/* Spheres among themselves and against a plane differ in masses and radii only. */
static void planes_rebound_like_spheres(void **state) {
    (void)state;
    for (int l = 0; l < 3; l++) {
        collision c = {.law = LAWS[l], .pair = pair_of(0.55, 0), .phase = 0.4};
        double sphere = collide(&c).restitution;
        c.against_plane = true;
        CHECK_NEAR(collide(&c).restitution, sphere, 1e-9);
    }
}

static void hertz_rebounds_alike_at_any_speed(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_HERTZ_MINDLIN, .pair = pair_of(0.72, 0), .phase = 0.2};
    double slow = (c.speed = 0.017, collide(&c).restitution);
    double fast = (c.speed = 2.9, collide(&c).restitution);
    CHECK_NEAR(slow, fast, 1e-9);
    c.speed = 0.83, c.radius_a = 0.0009, c.radius_b = 0.021;
    CHECK_NEAR(collide(&c).restitution, fast, 1e-9);
}

/* ---- duration and largest overlap ------------------------------------------------------------ */

/* S12 2.22 and 2.26, damped linear contact with the cut-off: largest overlap v/w0 exp(-z/w
 * atan(w/z)); the force ends at atan2(2zw, 2z^2-1)/(w w0), and the rest of the overlap, 2z e v/w0,
 * is left behind at speed e v. */
static void linear_duration_and_overlap(void **state) {
    (void)state;
    for (int i = 1; i < 6; i++) {
        collision c = {.law = CLAST_LAW_LINEAR, .pair = pair_of(ASKED[i], 0), .resolution = 3000};
        rebound r = collide(&c);
        double z = clast_damping_ratio(CLAST_LAW_LINEAR, ASKED[i]), w = sqrt(1 - z * z);
        double w0 = sqrt(c.pair.stiffness / r.effective_mass);
        double overlap = 0.83 / w0 * exp(-z / w * atan2(w, z));
        CHECK_CLOSE(r.overlap_max, overlap, 1e-3);
        CHECK_CLOSE(r.duration, (atan2(2 * z * w, 2 * z * z - 1) / w + 2 * z) / w0, 1e-3);
    }
}

static double inverse_speed(double x, void *params) {
    (void)params;
    return 4 * x * x * x / sqrt(1 - pow(x, 10)); /* ds of s = x^4, so that the root is tame */
}

/* Duration of an elastic Hertz contact over d/v: 2 int_0^1 ds / sqrt(1 - s^(5/2)). */
static double hertz_integral(void) {
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(2000);
    gsl_function f = {inverse_speed, NULL};
    double value, error;
    gsl_integration_qags(&f, 0, 1, 0, 1e-10, 2000, w, &value, &error);
    gsl_integration_workspace_free(w);
    return 2 * value;
}

static void hertz_constants_come_from_quadrature(void **state) {
    (void)state;
    /* m v^2 / 2 = 2/5 k d^(5/2) with F = k d^(3/2) */
    double overlap = pow(5.0 / 4, 0.4), duration = overlap * hertz_integral();
    print_message("Hertz: overlap %.4f, duration %.4f (S12 2.40 and 2.41 print 1.09 and 3.21)\n",
                  overlap, duration);
    CHECK_NEAR(hertz_integral(), 2.9432751, 1e-7); /* the number in timestep.c */
    CHECK_NEAR(overlap, 1.09, 0.005);
    CHECK_NEAR(duration, 3.218, 0.001); /* 3.21 is cut, not rounded */
}

static void hertz_duration_and_overlap(void **state) {
    (void)state;
    collision c = {.law = CLAST_LAW_HERTZ_MINDLIN, .pair = pair_of(1, 0), .resolution = 3000};
    rebound r = collide(&c);
    CHECK_CLOSE(r.duration, contact_time(&c), 1e-3);
    CHECK_CLOSE(r.overlap_max * hertz_integral() / 0.83, contact_time(&c), 1e-4);
}

TEST_MAIN(cmocka_unit_test(linear_restitution_has_a_closed_form),
          cmocka_unit_test(hertz_restitution_agrees_with_an_adaptive_integration),
          cmocka_unit_test(the_damping_ratio_inverts_the_restitution),
          cmocka_unit_test(every_law_rebounds_as_asked),
          cmocka_unit_test(planes_rebound_like_spheres),
          cmocka_unit_test(hertz_rebounds_alike_at_any_speed),
          cmocka_unit_test(linear_duration_and_overlap),
          cmocka_unit_test(hertz_constants_come_from_quadrature),
          cmocka_unit_test(hertz_duration_and_overlap))

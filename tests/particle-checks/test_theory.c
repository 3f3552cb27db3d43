/* Formulas of the study: capsules by quadrature, directions of contacts against plain geometry,
 * the source's law against the engine's. */
#include <gsl/gsl_integration.h>

#include "experiments/particle-checks/checks.h"
#include "tests/support/check.h"

/* ---- capsules -------------------------------------------------------------------------------- */

typedef struct profile {
    double radius, straight;
    int moment; /* 0 volume, 1 about the axis, 2 across */
} profile;

static double disc(double x, void *context) {
    const profile *p = context;
    double beyond = fmax(0, fabs(x) - 0.5 * p->straight);
    double r2 = p->radius * p->radius - beyond * beyond, area = CHECKS_PI * r2;
    return p->moment == 0 ? area : p->moment == 1 ? area * r2 / 2 : area * (r2 / 4 + x * x);
}

static double integral(double radius, double straight, int moment) {
    profile p = {radius, straight, moment};
    gsl_function f = {disc, &p};
    gsl_integration_workspace *w = gsl_integration_workspace_alloc(1000);
    double end = 0.5 * straight + radius, value, error;
    gsl_integration_qag(&f, -end, end, 0, 1e-10, 1000, GSL_INTEG_GAUSS61, w, &value, &error);
    gsl_integration_workspace_free(w);
    return value;
}

static void test_capsule(void **state) {
    (void)state;
    const double r = 0.0113, straight = 0.0371, mass = 0.0271;
    capsule c = capsule_of(7, r, straight, mass);
    double volume = integral(r, straight, 0);
    CHECK_CLOSE(capsule_volume(r, straight), volume, 1e-9);
    CHECK_CLOSE(c.inertia.x, mass * integral(r, straight, 1) / volume, 1e-9);
    CHECK_CLOSE(c.inertia.y, mass * integral(r, straight, 2) / volume, 1e-9);
    CHECK_CLOSE(6 * c.spacing, straight, 1e-12);
}

/* What is printed comes out again. */
static void test_matter(void **state) {
    (void)state;
    capsule p = pair_particle();
    CHECK_CLOSE(p.mass * GRAVITY, PAIR_WEIGHT, 1e-12);
    CHECK_CLOSE(matter_density() * capsule_volume(p.radius, p.spacing), p.mass, 1e-9);
    CHECK_CLOSE(critical_step(p.radius, pair_young()), PAIR_CRITICAL_STEP, 1e-12);
}

/* ---- directions ------------------------------------------------------------------------------ */

/* A probe in the nest of two circles, by coordinates. */
static void test_direction(void **state) {
    (void)state;
    const double r1 = 0.31, r2 = 0.47, rs = 0.23, l = 0.29;
    direction d = direction_of(r1, r2, rs, l);
    double alpha = d.alpha * CHECKS_PI / 180, theta = asin((r2 - r1) / l);
    double x = (r1 + rs) * cos(alpha), y = (r1 + rs) * sin(alpha);
    CHECK_CLOSE(hypot(x - l, y), r2 + rs, 1e-12);
    double normal = CHECKS_PI / 2 + theta; /* of the common tangent */
    CHECK_NEAR(d.gamma1, (normal - atan2(y, x)) * 180 / CHECKS_PI, 1e-9);
    CHECK_NEAR(d.gamma2, (atan2(y, x - l) - normal) * 180 / CHECKS_PI, 1e-9);
}

static void test_nests(void **state) {
    (void)state;
    for (double q = 1; q < 20; q *= 1.7) {
        direction d = direction_of(0.5, 0.5, 0.5, 1 / q);
        CHECK_NEAR(d.gamma1, pseudo_normal_off(q), 1e-9);
        CHECK_NEAR(d.gamma2, d.gamma1, 1e-9);
        CHECK_CLOSE(pseudo_density(pseudo_normal_off(q)), q, 1e-12);
    }
}

/* ---- the source's law ------------------------------------------------------------------------ */

/* Without a tangential dashpot and above the angle of repose it slides like the engine's own. */
static void test_printed_law(void **state) {
    (void)state;
    enum { POINTS = 5 };
    double own[POINTS], printed[POINTS];
    slide_case c = {.spheres = 5, .friction = 0.27, .damping = 0.21, .fraction = 1};
    slide_run(&c, POINTS, own);
    c.printed = true;
    slide_run(&c, POINTS, printed);
    for (int i = 0; i < POINTS; i++) CHECK_CLOSE(printed[i], own[i], 1e-4);
}

/* The dashpot alone decides the speed in the end: the drive over n c_t. */
static void test_terminal_speed(void **state) {
    (void)state;
    enum { POINTS = 10 };
    double way[POINTS];
    slide_case c = {.spheres = 5,
                    .friction = 0.27,
                    .damping = 0.21,
                    .slip_damping = 0.21,
                    .printed = true,
                    .fraction = 0.5};
    slide_run(&c, POINTS, way);
    capsule p = sliding_particle(5);
    double young = sliding_young(), load = p.mass * GRAVITY * cos(SLOPE) / 5;
    double e_star = young / (2 * (1 - POISSON * POISSON));
    double g_star = young / (2 * (1 + POISSON)) / (2 * (2 - POISSON));
    double a = cbrt(0.75 * p.radius * load / e_star);
    double c_t = 2 * 0.21 * sqrt(8 * g_star * a * p.mass);
    double drive = p.mass * GRAVITY * (sin(SLOPE) - 0.27 * cos(SLOPE));
    double speed = (way[POINTS - 1] - way[4]) / (SLIDE_TIME * (POINTS - 5) / POINTS);
    CHECK_CLOSE(speed, drive / (5 * c_t), 0.02); /* loads are not quite equal */
}

/* ---- what a run must give -------------------------------------------------------------------- */

static void test_blow(void **state) {
    (void)state;
    blow b = blow_run(0, NULL);
    CHECK_CLOSE(b.speed, BLOW_FORCE * BLOW_STEP / BLOW_MASS, 1e-9);
    CHECK_CLOSE(b.spin, BLOW_FORCE * BLOW_ARM * BLOW_STEP / BLOW_INERTIA, 1e-9);
}

/* At rest: Hertz turned round. */
static void test_rest(void **state) {
    (void)state;
    rest r = rest_run(&REST_CASE[0], NULL);
    capsule p = pair_particle();
    double e_star = pair_young() / ((1 - POISSON * POISSON) * (1 + 1 / RIGID));
    double overlap = pow(PAIR_WEIGHT / (4.0 / 3 * e_star * sqrt(p.radius)), 2.0 / 3);
    CHECK_CLOSE(r.overlap, overlap, 1e-7);
    CHECK_BELOW(r.error, 1e-9 * PAIR_WEIGHT);
}

/* Exact where the touch falls on a step and steps are small: second order and better. */
static void test_impulse(void **state) {
    (void)state;
    elastic_case c = {.fraction = 0.1, .height = DROP_HEIGHT};
    double coarse = elastic_impulse_error(&c, NULL);
    c.fraction = 0.025;
    CHECK_BELOW(elastic_impulse_error(&c, NULL), coarse / 16);
}

TEST_MAIN(cmocka_unit_test(test_capsule), cmocka_unit_test(test_matter),
          cmocka_unit_test(test_direction), cmocka_unit_test(test_nests),
          cmocka_unit_test(test_printed_law), cmocka_unit_test(test_terminal_speed),
          cmocka_unit_test(test_blow), cmocka_unit_test(test_rest), cmocka_unit_test(test_impulse))

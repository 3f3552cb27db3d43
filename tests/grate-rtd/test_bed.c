/* test_bed.c - the height of beds made by hand, the geometry of the cases, and comparisons. */
#include "tests/support/check.h"

#include "experiments/grate-rtd/grate.h"

/* ---- comparisons ----------------------------------------------------------------------------- */

static interval known(double mean, double error, int n) {
    return (interval){mean, error * sqrt(n), NAN, n};
}

static void errors_of_two_runs_add_up(void **state) {
    (void)state;
    interval a = known(10, 0.3, 30), b = known(8, 0.4, 40);
    interval d = difference_of(a, b), q = ratio_of(a, b), r = relative_difference(a, b);
    CHECK_CLOSE(d.mean, 2.0, 1e-14);
    CHECK_CLOSE(d.sd / sqrt(d.n), 0.5, 1e-14);
    assert_int_equal(d.n, 30); /* the side that knows less */
    CHECK_CLOSE(q.mean, 1.25, 1e-14);
    CHECK_CLOSE(q.sd / sqrt(q.n), 1.25 * hypot(0.03, 0.05), 1e-14);
    CHECK_CLOSE(r.mean, 0.25, 1e-14);
    CHECK_CLOSE(d.half / 0.5, 2.0452, 1e-4); /* Student, 29 degrees of freedom */
}

/* ---- geometry -------------------------------------------------------------------------------- */

/* S12 Table 3.3 and the inclinations of Tables 4.1 and 4.7: bars 30 mm high lie on each other. */
static void bars_lie_on_each_other(void **state) {
    (void)state;
    CHECK_NEAR(PITCH * sin(20 * 3.14159265358979 / 180), 0.030, 1e-6);
    for (int i = 0; i < CASE_COUNT; i++) {
        const grate_case *c = &CASES[i];
        if (c->group == GROUP_PACKING) continue;
        double lean = case_slope(c) * 180 / 3.14159265358979 + 20;
        const double printed[] = {[FORWARD] = 7, [BACKWARD] = 45, [STAIRS] = 0};
        CHECK_NEAR(lean, printed[c->device], 1e-9);
    }
}

/* ---- published formulas ---------------------------------------------------------------------- */

static void bulk_densities_of_the_source(void **state) {
    (void)state;
    CHECK_NEAR(packing_published(1), 0.52, 0.005);
    CHECK_NEAR(packing_published(2), 0.434, 0.0005);
    CHECK_NEAR(packing_published(INFINITY), 0.574, 0.0005);
    CHECK_BELOW(packing_published(5), packing_published(1)); /* 5 wide: no better than 1 (4.3) */
    CHECK_BELOW(packing_published(1), packing_published(6));
}

/* ---- sampling -------------------------------------------------------------------------------- */

static void sampling_takes_the_middles(void **state) {
    (void)state;
    tracer t[3] = {{.time = 100}, {.time = 170}, {.time = 400}};
    double w[3] = {0.25, 0.25, 0.5};
    rtd r = {.tracers = 3, .items = t, .weight = w};
    CHECK_CLOSE(sampled_mean(&r, 180), 0.5 * 90 + 0.5 * 450, 1e-14);
    CHECK_CLOSE(sampled_variance(&r, 180), 180.0 * 180, 1e-12);
    CHECK_CLOSE(sampled_mean(&r, 60), 0.25 * 90 + 0.25 * 150 + 0.5 * 390, 1e-14);
}

/* ---- beds ------------------------------------------------------------------------------------ */

static const grate_case *case_named(const char *name) {
    for (int i = 0; i < CASE_COUNT; i++)
        if (!strcmp(CASES[i].name, name)) return &CASES[i];
    fail_msg("no case %s", name);
    return NULL;
}

enum { ROW = 90 };

/* Touching spheres in a row along the grate, `lift` above its line; the last flies. */
static frame row_of_spheres(const grate_case *c, double lift) {
    static double centre[3 * (ROW + 1)], radius[ROW + 1], speed[ROW + 1];
    double d = c->diameter, slope = case_slope(c), r = d / 2;
    for (int i = 0; i <= ROW; i++) {
        double x = d * (i - 10), z = lift + r + (i == ROW ? 10 * d : 0);
        if (i == ROW) x = 20 * d;
        centre[3 * i] = x * cos(slope) - z * sin(slope);
        centre[3 * i + 1] = 0;
        centre[3 * i + 2] = x * sin(slope) + z * cos(slope);
        radius[i] = r, speed[i] = i == ROW ? 2 : 0;
    }
    return (frame){
        .spheres = ROW + 1, .bodies = ROW + 1, .centre = centre, .radius = radius, .speed = speed};
}

/* Tops of touching spheres are one diameter up; their outline is 5/3 pi r3 over each one's cell. */
static void check_row(const grate_case *c, const stage *s, double lift) {
    frame f = row_of_spheres(c, lift);
    bed_look l = bed_look_at(c, s, &f);
    double d = c->diameter, r = d / 2, cell = d * case_width(c);
    CHECK_CLOSE(l.height, d, 0.01); /* a tenth of a diameter to a column */
    CHECK_CLOSE(l.outline, 5.0 / 3 * 3.14159265 * r * r * r / cell, 0.02);
    CHECK_CLOSE(l.packing, 4.0 / 3 * 3.14159265 * r * r * r / (cell * d), 0.02);
}

static void a_row_on_the_floor(void **state) {
    (void)state;
    stage s = {.mesh_count = 0};
    check_row(case_named("packing 1"), &s, 0);
}

/* A plate 10 mm above the line of the backward grate up to x = `end`, and one below it that is not
 * felt. */
static void check_row_on_a_bar(double end) {
    const grate_case *c = case_named("backward wood");
    double vertex[24], slope = case_slope(c);
    uint32_t triangle[12] = {0, 1, 2, 1, 3, 2, 4, 5, 6, 5, 7, 6};
    for (int i = 0; i < 8; i++) {
        double x = i % 2 ? end : -1, z = i < 4 ? 0.01 : -0.03;
        vertex[3 * i] = x * cos(slope) - z * sin(slope);
        vertex[3 * i + 1] = i / 2 % 2 ? 0.05 : -0.04;
        vertex[3 * i + 2] = x * sin(slope) + z * cos(slope);
    }
    stage_mesh mesh = {
        .wall = 0, .vertex_count = 8, .triangle_count = 4, .vertex = vertex, .triangle = triangle};
    stage_wall wall = {.name = "bar"};
    stage s = {.mesh_count = 1, .meshes = &mesh, .wall_count = 1, .walls = &wall};
    check_row(c, &s, 0.01);
}

static void a_row_on_a_bar(void **state) {
    (void)state;
    check_row_on_a_bar(2);
}

/* The last bar draws back: what is left counts. */
static void a_row_on_a_bar_that_ends_early(void **state) {
    (void)state;
    check_row_on_a_bar(0.7);
}

TEST_MAIN(cmocka_unit_test(errors_of_two_runs_add_up), cmocka_unit_test(bars_lie_on_each_other),
          cmocka_unit_test(bulk_densities_of_the_source),
          cmocka_unit_test(sampling_takes_the_middles), cmocka_unit_test(a_row_on_the_floor),
          cmocka_unit_test(a_row_on_a_bar), cmocka_unit_test(a_row_on_a_bar_that_ends_early))

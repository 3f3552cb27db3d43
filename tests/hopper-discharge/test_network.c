/* The fastest vibration of a chain of spheres between two walls, against its closed form, and the
 * step at which the running engine fails on it, against the scheme's limit. */
#include "experiments/hopper-discharge/discharge.h"
#include "experiments/theory/amplification.h"

#include "tests/support/check.h"

static const double PI = 3.14159265358979323846;

enum { CHAIN = 7 };
static const double RADIUS = 0.0037, PRESS = 0.00021, K = 730, DENSITY = 2700;

/* n equal spheres along x, every contact pressed by the same overlap, no gravity. */
static clast_world *chain_new(clast_scheme scheme, double step, double push) {
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, 0};
    d.law = CLAST_LAW_LINEAR;
    d.motion = CLAST_MOTION_IN_PLANE;
    d.plane_axis = 1;
    d.scheme = scheme;
    d.time_step = step;
    d.impact_speed = 1;
    d.max_overlap = 0.2;
    d.max_displacement = d.max_residual = 1e9;
    d.threads = 1;
    clast_world *w = clast_world_new(&d);
    assert_non_null(w);
    int m = clast_material_add(w, &(clast_material_def){"glass", DENSITY, 70e9, 0.22});
    clast_pair_def pair = {.restitution = 1, .stiffness = K};
    assert_int_equal(clast_pair_set(w, m, m, &pair), CLAST_OK);
    int part = clast_part_add(w, &(clast_part_def){.name = "walls"});
    double pitch = 2 * RADIUS - PRESS, end = RADIUS - PRESS;
    clast_wall_def left = {
        .name = "left", .material = m, .point = {-end, 0, 0}, .normal = {1, 0, 0}};
    clast_wall_def right = {.name = "right",
                            .material = m,
                            .point = {(CHAIN - 1) * pitch + end, 0, 0},
                            .normal = {-1, 0, 0}};
    clast_wall_add(w, part, &left);
    clast_wall_add(w, part, &right);
    int ball = clast_shape_add_sphere(w, "ball", RADIUS, m);
    for (int i = 0; i < CHAIN;
         i++) { /* every other one is pushed the other way: the fastest mode */
        double x = i * pitch + (i % 2 ? -push : push);
        clast_body_add(w, &(clast_body_def){.shape = ball, .position = {x, 0, 0}});
    }
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    return w;
}

/* n masses between n + 1 springs. */
static double chain_frequency(void) {
    double mass = DENSITY * 4.0 / 3 * PI * RADIUS * RADIUS * RADIUS;
    return 2 * sqrt(K / mass) * sin(0.5 * PI * CHAIN / (CHAIN + 1.0));
}

static void the_largest_frequency_of_a_chain(void **state) {
    (void)state;
    clast_world *w = chain_new(CLAST_SCHEME_LEAPFROG, 1e-5, 0);
    network n = network_of(w, K);
    assert_int_equal(n.spheres, CHAIN);
    CHECK_NEAR(n.largest / chain_frequency(), 1, 1e-9);
    /* a sphere between two that stand still has both springs */
    double mass = DENSITY * 4.0 / 3 * PI * RADIUS * RADIUS * RADIUS;
    CHECK_NEAR(n.alone / sqrt(2 * K / mass), 1, 1e-9);
    CHECK_NEAR(n.coordination, 2, 1e-12);
    CHECK_NEAR(n.overlap, PRESS / RADIUS, 1e-9);
    clast_world_free(w);
}

static bool chain_holds(clast_scheme scheme, double part_of_limit) {
    double step = part_of_limit * scheme_limit(scheme, 0) / chain_frequency();
    clast_world *w = chain_new(scheme, step, 1e-7);
    clast_status status = CLAST_OK;
    for (int i = 0; i < 4000 && !status; i++) status = clast_world_step(w);
    clast_world_free(w);
    return status == CLAST_OK;
}

static void a_chain_fails_at_the_limit_of_the_scheme(void **state) {
    (void)state;
    const clast_scheme scheme[3] = {CLAST_SCHEME_LEAPFROG, CLAST_SCHEME_POSITION_VERLET,
                                    CLAST_SCHEME_NUMEROV_CENTRAL};
    for (int i = 0; i < 3; i++) {
        assert_true(chain_holds(scheme[i], 0.99));
        assert_false(chain_holds(scheme[i], 1.01));
    }
}

/* Three spheres in a triangle, held by nothing: they fly apart, but at this instant the springs are
 * known. The fastest mode is breathing, which turns no normal: sqrt(3 k/m). */
static void the_fastest_mode_of_a_triangle_is_breathing(void **state) {
    (void)state;
    clast_world_def d = clast_world_def_default();
    d.gravity = (clast_vec3){0, 0, 0};
    d.law = CLAST_LAW_LINEAR;
    d.motion = CLAST_MOTION_IN_PLANE;
    d.plane_axis = 1;
    d.impact_speed = 1;
    d.max_overlap = 0.2;
    clast_world *w = clast_world_new(&d);
    int m = clast_material_add(w, &(clast_material_def){"glass", DENSITY, 70e9, 0.22});
    clast_pair_def pair = {.restitution = 1, .stiffness = K};
    assert_int_equal(clast_pair_set(w, m, m, &pair), CLAST_OK);
    int ball = clast_shape_add_sphere(w, "ball", RADIUS, m);
    double side = 2 * RADIUS - PRESS;
    const double x[3] = {0, side, 0.5 * side}, z[3] = {0, 0, side * sqrt(0.75)};
    for (int i = 0; i < 3; i++)
        clast_body_add(w, &(clast_body_def){.shape = ball, .position = {x[i], 0, z[i]}});
    assert_int_equal(clast_world_prepare(w), CLAST_OK);
    double mass = DENSITY * 4.0 / 3 * PI * RADIUS * RADIUS * RADIUS;
    CHECK_NEAR(network_of(w, K).largest / sqrt(3 * K / mass), 1, 1e-9);
    clast_world_free(w);
}

TEST_MAIN(cmocka_unit_test(the_largest_frequency_of_a_chain),
          cmocka_unit_test(a_chain_fails_at_the_limit_of_the_scheme),
          cmocka_unit_test(the_fastest_mode_of_a_triangle_is_breathing))

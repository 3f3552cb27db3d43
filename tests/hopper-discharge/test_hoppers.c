/* The two hoppers: where their walls are, and what rests in the flat one and leaves it. */
#include "experiments/hopper-discharge/discharge.h"
#include "tests/support/check.h"

static const double RADIUS = 0.0046;

static void walls_of_the_funnel(void **state) {
    (void)state;
    hopper h = hopper_usual(6);
    hopper_wall walls[HOPPER_WALLS];
    hopper_walls(&h, walls);
    /* half-way up the left slope, a centre on it and one wholly behind */
    double steep = sqrt(1 + h.slope * h.slope), z = 0.25, x = -0.5 * h.orifice - h.slope * z;
    CHECK_NEAR(wall_overlap(walls, x, z, RADIUS), 1, 1e-12);
    CHECK_NEAR(wall_overlap(walls, x - RADIUS / steep, z - RADIUS * h.slope / steep, RADIUS), 2,
               1e-12);
    CHECK_BELOW(wall_overlap(walls, 0, 0.5, RADIUS), 0);
}

static void walls_of_the_flat_hopper(void **state) {
    (void)state;
    hopper funnel = hopper_usual(6), h = funnel;
    h.flat = true;
    hopper_wall walls[HOPPER_WALLS], steep[HOPPER_WALLS];
    hopper_walls(&h, walls), hopper_walls(&funnel, steep);
    double lip = 0.5 * h.orifice;
    CHECK_NEAR(walls[3].px, steep[3].px, 0); /* as wide as the funnel's top */
    CHECK_NEAR(wall_overlap(walls, lip + RADIUS, -RADIUS, RADIUS), 2, 1e-12);
    CHECK_NEAR(wall_overlap(walls, -lip - RADIUS, 0, RADIUS), 1, 1e-12);
    CHECK_NEAR(wall_overlap(walls, walls[2].px, 0.3, RADIUS), 1, 1e-12);
    CHECK_BELOW(wall_overlap(walls, 0.9 * lip, -RADIUS, RADIUS), 0); /* over the orifice */
}

/* Without friction all that lie on the flat bottom leave it, but for a few that bounce alone. */
static void the_flat_hopper_empties(void **state) {
    (void)state;
    hopper h = hopper_usual(15);
    h.flat = true;
    static bed b;
    bed_make(&h, 1, &b);
    double lowest = INFINITY, weight = bed_mass(&b) * GRAVITY;
    for (int i = 0; i < b.count; i++) lowest = fmin(lowest, b.z[i] - sphere_radius(b.size[i]));
    CHECK_BELOW(lowest, 0);
    CHECK_BELOW(-0.5 * weight / STIFFNESS, lowest); /* nobody bears half of the bed */
    flow f;
    flow_run(&(flow_plan){.hopper = &h,
                          .bed = &b,
                          .world = {CLAST_SCHEME_LEAPFROG, .step = 4e-4},
                          .until = 2 * hopper_latest(&h)},
             &f);
    printf("flat: residence %.3f s, %d trapped, %d through, energy %.1e\n", f.residence, f.trapped,
           f.through, f.energy_worst);
    assert_int_equal(f.failed, FAILED_NOT);
    assert_int_equal(f.through, 0);
    CHECK_BELOW(f.energy_worst, 0.01);
    CHECK_BELOW(f.overlap, 1);
}

TEST_MAIN(cmocka_unit_test(walls_of_the_funnel), cmocka_unit_test(walls_of_the_flat_hopper),
          cmocka_unit_test(the_flat_hopper_empties))

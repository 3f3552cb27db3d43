/* test_measures.c - particles of the study against slices, and its measures on frames made by
 * hand. */
#include "tests/support/check.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/aspect-ratio-hopper/aspect.h"

static const double PI = 3.14159265358979323846;

/* ---- particles ------------------------------------------------------------------------------- */

/* Half the height of the side view of a chain at x from its middle. */
static double profile(const chain *c, double x) {
    double square = 0;
    for (int i = 0; i < c->spheres; i++) {
        double u = x - 0.5 * (2 * i - c->spheres + 1) * c->spacing;
        square = fmax(square, c->radius * c->radius - u * u);
    }
    return sqrt(square);
}

static void particles_are_what_their_slices_are(void **state) {
    (void)state;
    enum { SLICES = 200000 };
    for (int shape = 0; shape < SHAPES; shape++) {
        chain c = chain_of(shape);
        double from = -0.5 * chain_length(&c), dx = chain_length(&c) / SLICES;
        double volume = 0, area = 0, moment = 0;
        for (int i = 0; i < SLICES; i++) {
            double x = from + (i + 0.5) * dx, r = profile(&c, x), r2 = r * r;
            volume += PI * r2 * dx, area += 2 * r * dx;
            moment += PI * (0.25 * r2 * r2 + r2 * x * x) * dx;
        }
        assert_true(fabs(volume / (4 * PI / 3 * pow(EQUAL_RADIUS, 3)) - 1) < 1e-6);
        assert_true(fabs(c.area / area - 1) < 1e-6);
        assert_true(fabs(c.across / (moment / volume) - 1) < 1e-6);
        assert_true(fabs(chain_length(&c) / (2 * c.radius) - c.aspect) < 1e-12);
    }
    for (int n = 1; n <= MAIN_SHAPES; n++) /* A00 5.1 */
        assert_true(fabs(chain_of(n - 1).radius - EQUAL_RADIUS * cbrt(1.0 / n)) < 1e-15);
}

/* ---- cells ----------------------------------------------------------------------------------- */

static void discs_are_cut_by_cells(void **state) {
    (void)state;
    assert_true(fabs(disc_in_cell(0, 0, 1, -2, 2, -2, 2) - PI) < 1e-14);
    assert_true(fabs(disc_in_cell(0, 0, 1, 0, 2, 0, 2) - PI / 4) < 1e-14);
    assert_true(fabs(disc_in_cell(0, 0, 1, -2, 2, 0.5, 2) - (PI / 3 - sqrt(3) / 4)) < 1e-14);
    assert_true(disc_in_cell(0, 0, 1, 0.8, 2, 0.8, 2) < 1e-15); /* the corner is outside */
    assert_true(fabs(disc_in_cell(0, 0, 1, -0.1, 0.2, -0.3, 0.1) - 0.12) < 1e-14);
    for (int k = 0; k < 200; k++) { /* any cutting adds up to the disc */
        double u[6], sum = 0;
        for (int i = 0; i < 6; i++) u[i] = clast_random(11, (uint64_t)k, (uint64_t)i);
        double r = 0.1 + u[0], x = 2 * u[1] - 1, z = 2 * u[2] - 1;
        double xs[4] = {-9, fmin(u[3], u[4]) - 0.5, fmax(u[3], u[4]) - 0.5, 9};
        double zs[3] = {-9, u[5] - 0.5, 9};
        for (int i = 0; i < 3; i++)
            for (int j = 0; j < 2; j++) {
                double part = disc_in_cell(x, z, r, xs[i], xs[i + 1], zs[j], zs[j + 1]);
                assert_true(part > -1e-12);
                sum += part;
            }
        assert_true(fabs(sum - PI * r * r) < 1e-12);
    }
}

/* A frame of single spheres on a square lattice, one radius apart from walls and bottom. */
static frame *lattice(int columns, int rows, double radius) {
    frame *f = calloc(1, sizeof *f);
    size_t n = (size_t)(columns * rows);
    assert_non_null(f);
    f->bodies = f->spheres = n;
    f->id = calloc(n, sizeof *f->id), f->position = calloc(3 * n, sizeof *f->position);
    f->velocity = calloc(3 * n, sizeof *f->velocity), f->spin = calloc(3 * n, sizeof *f->spin);
    f->centre = calloc(3 * n, sizeof *f->centre), f->radius = calloc(n, sizeof *f->radius);
    for (size_t i = 0; i < n; i++) {
        double x = (2 * (double)((int)i % columns) + 1 - columns) * radius;
        double z = (2 * (double)((int)i / columns) + 1) * radius;
        f->id[i] = (uint32_t)i, f->radius[i] = radius;
        f->position[3 * i] = f->centre[3 * i] = x,
                        f->position[3 * i + 2] = f->centre[3 * i + 2] = z;
    }
    return f;
}

static aspect_case hopper(void) {
    return (aspect_case){.chain = chain_of(0), .half_width = 0.5, .chamber = 2, .count = 5000};
}

static void a_square_lattice_has_its_solid_fraction(void **state) {
    (void)state;
    aspect_case c = hopper();
    frame *f = lattice(50, 40, 0.01);
    cells g = cells_of(f, &c);
    assert_int_equal(g.rows, 8);
    for (int i = 0; i < g.rows * g.columns; i++) {
        assert_true(g.number[i] == 25);
        assert_true(fabs(g.counted[i] - PI / 4) < 1e-12);
        assert_true(fabs(g.exact[i] - PI / 4) < 1e-9);
    }
    /* the surface: half circles on a plane a radius below the tops */
    assert_true(fabs(surface_of(f, &c) - (0.79 + 0.01 * PI / 4)) < 1e-3);
    frame_free(f);
}

/* ---- motion ---------------------------------------------------------------------------------- */

static void set_speed(frame *f, size_t i, double speed) {
    f->velocity[3 * i + 2] = -speed;
}

/* A flowing zone whose sides lean by a known angle. */
static void the_shear_band_has_its_angle(void **state) {
    (void)state;
    aspect_case c = hopper();
    static const double ANGLES[] = {90, 75, 55, 110};
    for (int k = 0; k < 4; k++) {
        frame *f = lattice(200, 160, 0.0025);
        double slope = 1 / tan(ANGLES[k] * PI / 180);
        for (size_t i = 0; i < f->bodies; i++) {
            double x = f->position[3 * i], z = f->position[3 * i + 2];
            set_speed(f, i, 1 / (1 + exp((fabs(x) - 0.25 - slope * z) / 0.02)));
        }
        double found = shear_angle(f, &c, SHEAR_BAND);
        if (fabs(found - ANGLES[k]) > 2.5) fail_msg("found %g, wanted %g", found, ANGLES[k]);
        for (size_t i = 0; i < f->bodies; i++) set_speed(f, i, 1);
        assert_true(isnan(shear_angle(f, &c, SHEAR_BAND))); /* all flows: no band */
        frame_free(f);
    }
}

static void a_heap_has_its_slope(void **state) {
    (void)state;
    aspect_case c = hopper();
    double top[HEAP_BINS], wanted = 20;
    frame *f = lattice(100, 200, 0.005);
    for (size_t i = 0; i < f->bodies;
         i++) { /* shifted into the chamber, what is above falls fast */
        double *p = &f->position[3 * i], height = 0.6 - tan(wanted * PI / 180) * fabs(p[0]);
        bool above = p[2] > height;
        p[2] -= c.chamber;
        if (above) set_speed(f, i, sqrt(2 * GRAVITY * fmax(0, -p[2])) + 0.1);
    }
    heap_of(f, &c, top);
    double found = heap_slope(top, c.half_width);
    if (fabs(found - wanted) > 1.5) fail_msg("found %g, wanted %g", found, wanted);
    frame_free(f);
}

static void a_full_chamber_has_a_level_of_one(void **state) {
    (void)state;
    double top[HEAP_BINS];
    for (int k = 0; k < HEAP_BINS; k++) top[k] = k < 3 || k >= 17 ? 0.5 : 2; /* 0.7 of the width */
    assert_true(fabs(heap_level(top, 2) - 1) <
                1e-12); /* what lies beside the orifice is no matter */
    for (int k = 0; k < HEAP_BINS; k++) top[k] = 0.1 * k;
    assert_true(fabs(heap_level(top, 2) - 0.475) < 1e-12);
}

/* 100 %/s in steps of 5 ms, of which the 12 behind `gap` stand still. */
static flow_facts rough_discharge(int rows, int gap) {
    enum { MOST = 100 };
    double t[MOST], out[MOST];
    for (int i = 0; i < rows; i++) {
        t[i] = 0.005 * i;
        out[i] = 0.5 * (i <= gap ? i : i < gap + 12 ? gap : i - 12);
    }
    flow_facts f = {.linear = {.first = 0, .count = rows}, .rate = 100};
    roughness_measure(&f, t, out);
    return f;
}

static void a_gap_in_the_discharge_is_an_arch(void **state) {
    (void)state;
    flow_facts even = rough_discharge(100, 100), gap = rough_discharge(100, 40);
    assert_true(even.arches == 0 && fabs(even.lowest - 1) < 1e-9 && even.fluctuation < 1e-9);
    assert_true(gap.arches == 1 && fabs(gap.lowest) < 1e-9);
    assert_true(gap.lowest_at > 0.2 && gap.lowest_at < 0.26);
    flow_facts few = rough_discharge(8, 100); /* too short to say anything: not "no arches" */
    assert_true(isnan(few.arches) && isnan(few.lowest) && isnan(few.lowest_at));
    assert_true(isnan(few.fluctuation));
}

static void rolling_spheres_have_their_energy_ratio(void **state) {
    (void)state;
    aspect_case c = hopper();
    frame *f = lattice(30, 20, 0.01);
    for (size_t i = 0; i < f->bodies;
         i++) { /* left rolls, the middle slides, the right is at rest */
        f->velocity[3 * i] = i % 30 < 20 ? 0.5 : 0;
        f->spin[3 * i + 1] = i % 30 < 10 ? 50 : 0;
        f->position[3 * i] *= 0.5 / 0.3; /* over the whole width */
    }
    ratio_at at = ratios_of(f, &c);
    assert_true(fabs(at.summed[0] - 0.4) < 1e-12 && fabs(at.mean[0] - 0.4) < 1e-12);
    assert_true(at.summed[1] == 0 && isnan(at.summed[2]) && isnan(at.mean[2]));
    assert_true(fabs(at.summed[REGIONS] - 0.2) < 1e-12);
    frame_free(f);
}

static void janssen_goes_from_weight_to_friction(void **state) {
    (void)state;
    aspect_case c = hopper();
    c.bed.weight = 540, c.bed.height = 1.8;                                         /* 300 N/m2 */
    assert_true(fabs(janssen_load(&c, 0.5, 1e-6) / (0.5 * 300 * 1e-6) - 1) < 1e-5); /* K rho g y */
    assert_true(fabs(janssen_load(&c, 0.5, 100) - 300 / (2 * WALL_FRICTION)) < 1e-9);
    assert_true(janssen_load(&c, 0.5, -1) == 0);
}

static void a_track_is_turned_by_its_path(void **state) {
    (void)state;
    track t = {.count = 4, .z = {1, 1, 1, -1}, .angle = {0, 1, 0.5, 9}};
    assert_true(fabs(turned_by(&t) - 1.5) < 1e-15); /* up to where it leaves */
}

/* ---- runs beside one another ----------------------------------------------------------------- */

static void add_case(aspect_study *s, int shape, int setting, int of_variant, double rate) {
    aspect_case *c = &s->cases[s->count];
    *c = (aspect_case){.shape = shape, .setting = setting, .variant = of_variant, .ran = true};
    c->replicate = s->count++;
    c->flow.rate = rate;
}

static void a_setting_differs_by_its_mean_over_the_shapes(void **state) {
    (void)state;
    static aspect_study s;
    s = (aspect_study){.size = &SIZES[STUDY_PUBLISHED]};
    static const double CHANGE[MAIN_SHAPES] = {1, -3, 2, 4}; /* % */
    for (int shape = 0; shape < MAIN_SHAPES; shape++) {
        double mean = 50 + 10 * shape;
        add_case(&s, shape, CHEAP, 0, mean - 1), add_case(&s, shape, CHEAP, 0, mean + 1);
        add_case(&s, shape, THESIS, 0, mean * (1 + CHANGE[shape] / 100));
    }
    const setting_fact rate = {"setting: rate", "rate", true};
    interval apart = setting_difference(&s, &rate);
    assert_int_equal(apart.n, MAIN_SHAPES);
    assert_true(fabs(apart.mean - 1) < 1e-12);
    assert_true(fabs(apart.half - 3.182446305 * apart.sd / 2) < 1e-6);
}

static void smooth_chains_have_the_scatter_of_the_others(void **state) {
    (void)state;
    static aspect_study s;
    s = (aspect_study){.size = &SIZES[STUDY_PUBLISHED]};
    add_case(&s, 0, CHEAP, 0, 98), add_case(&s, 0, CHEAP, 0, 102);    /* sd 2.83 % */
    add_case(&s, 1, CHEAP, 0, 49.5), add_case(&s, 1, CHEAP, 0, 50.5); /* 1.41 % */
    add_case(&s, 6, CHEAP, 0, 80);
    const contrast shape = {"smooth 2 over spheres", "shape", {6, 0}, {0, 0}};
    contrasted c = contrast_of(&s, &shape, fact_named("rate"), true);
    assert_true(c.df == 2 && fabs(c.change + 20) < 1e-12);
    double pooled = sqrt((8.0 + 2.0) / 2), error = 0.8 * pooled * sqrt(1 + 0.5);
    assert_true(fabs(c.half - 4.302652730 * error) < 1e-6);
    assert_true(c.p > 0.011 && c.p < 0.013); /* t = 9.13 of 2 */
    const contrast none = {"smooth 5 over spheres", "shape", {7, 0}, {0, 0}};
    assert_true(isnan(contrast_of(&s, &none, fact_named("rate"), true).half));
}

/* Two runs of each shape, 1 above and below 10, 8, 6 and 4: each mean has the squared error 1. The
 * slope -2 has 0.2, its degrees of freedom are 0.04/0.0164 = 2.44. A step of 2 has 2, of which P(t2
 * > 2/sqrt 2) = 1/2 - sqrt 2/4. */
static void a_trend_is_tested_by_its_replicates(void **state) {
    (void)state;
    static aspect_study s;
    s = (aspect_study){.size = &SIZES[STUDY_PUBLISHED]};
    for (int shape = 0; shape < MAIN_SHAPES; shape++)
        for (int up = -1; up <= 1; up += 2) add_case(&s, shape, CHEAP, 0, 10 - 2 * shape + up);
    fact *rate = fact_named("rate");
    trend t = trend_of(&s, rate);
    double step = 0.5 - sqrt(2) / 4, p = trend_p(&s, rate, -1, 4);
    assert_true(fabs(t.slope.mean + 2) < 1e-12 && t.slope.n == 2);
    assert_true(p > 0.0104 && p < 0.0233); /* t = 4.472 of 3 and of 2 */
    assert_true(fabs(t.p - 2 * p) < 1e-12 && fabs(trend_p(&s, rate, 1, 4) - (1 - p)) < 1e-12);
    assert_true(fabs(t.p_steps - step) < 1e-9 && fabs(steps_p(&s, rate, -1, 2) - step) < 1e-9);
    assert_true(fabs(spheres_above_p(&s, rate) - step) < 1e-9);
    add_case(&s, 3, CHEAP, 0, 13); /* a mean of 7: the last step rises */
    assert_true(steps_p(&s, rate, -1, 4) > 0.5 && fabs(steps_p(&s, rate, -1, 3) - step) < 1e-9);
}

static void a_time_is_known_to_a_sample(void **state) {
    (void)state;
    static aspect_study s;
    s = (aspect_study){.size = &SIZES[STUDY_PUBLISHED]};
    for (int k = 0; k < 3; k++) add_case(&s, 0, CHEAP, 0, 50);
    for (int k = 0; k < 3; k++) s.cases[k].flow.delay = 0.045;
    assert_true(over(&s, 0, fact_named("start-up delay")).half == FLOW_SAMPLE);
    assert_true(over(&s, 0, fact_named("rate")).half == 0);
}

static void nothing_is_a_percentage_of_nought(void **state) {
    (void)state;
    static aspect_study s;
    s = (aspect_study){.size = &SIZES[STUDY_PUBLISHED]};
    add_case(&s, 0, CHEAP, 0, 0), add_case(&s, 0, CHEAP, 0, 0);
    add_case(&s, 1, CHEAP, 0, 49.5), add_case(&s, 1, CHEAP, 0, 50.5);
    add_case(&s, 6, CHEAP, 0, 40);
    const contrast over_spheres = {"", "", {6, 0}, {0, 0}}, over_two = {"", "", {6, 0}, {1, 0}};
    assert_true(isnan(contrast_of(&s, &over_spheres, fact_named("rate"), true).change));
    assert_true(contrast_of(&s, &over_spheres, fact_named("rate"), false).change == 40);
    assert_true(contrast_of(&s, &over_two, fact_named("rate"), true).half > 0);
}

static void one_run_stands_apart_from_replicates(void **state) {
    (void)state;
    interval four = {100, 2, NAN, 4}; /* 3.18 * 2 * sqrt(1.25) = 7.12 */
    assert_true(stands_apart(four, 107.2) && !stands_apart(four, 107.0));
    assert_true(stands_apart(four, 92.8) && !stands_apart(four, NAN));
    assert_false(stands_apart(interval_exact(1), 2));
}

/* Touching chains of two in space that turn about their own axis, and across it. */
static void chains_in_space_turn_about_either_axis(void **state) {
    (void)state;
    aspect_case c = {.chain = chain_of(1), .half_width = 0.5, .in_space = true, .count = 1};
    frame *f = lattice(1, 1, 0.01);
    f->orientation = calloc(4, sizeof *f->orientation);
    f->orientation[0] = f->orientation[3] = sqrt(0.5); /* x turned to y */
    f->velocity[2] = 1;
    double r = c.chain.radius;
    f->spin[1] = 10;
    assert_true(fabs(ratios_of(f, &c).summed[REGIONS] - 0.4 * r * r * 100) < 1e-12);
    f->spin[1] = 0, f->spin[0] = 10;
    assert_true(fabs(ratios_of(f, &c).summed[REGIONS] - 1.4 * r * r * 100) < 1e-12);
    frame_free(f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(particles_are_what_their_slices_are),
        cmocka_unit_test(discs_are_cut_by_cells),
        cmocka_unit_test(a_square_lattice_has_its_solid_fraction),
        cmocka_unit_test(the_shear_band_has_its_angle),
        cmocka_unit_test(a_heap_has_its_slope),
        cmocka_unit_test(a_full_chamber_has_a_level_of_one),
        cmocka_unit_test(a_gap_in_the_discharge_is_an_arch),
        cmocka_unit_test(rolling_spheres_have_their_energy_ratio),
        cmocka_unit_test(janssen_goes_from_weight_to_friction),
        cmocka_unit_test(a_track_is_turned_by_its_path),
        cmocka_unit_test(a_setting_differs_by_its_mean_over_the_shapes),
        cmocka_unit_test(smooth_chains_have_the_scatter_of_the_others),
        cmocka_unit_test(one_run_stands_apart_from_replicates),
        cmocka_unit_test(a_trend_is_tested_by_its_replicates),
        cmocka_unit_test(a_time_is_known_to_a_sample),
        cmocka_unit_test(nothing_is_a_percentage_of_nought),
        cmocka_unit_test(chains_in_space_turn_about_either_axis),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The parts of the study of the pool-ball rig, against closed forms and by hand. */
#include "engine/clast.h"
#include "experiments/pool-ball-piston/piston.h"
#include "tests/support/check.h"

enum { SEED = 7, TRIALS = 40000 };

/* ---- the score ------------------------------------------------------------------------------- */

/* A00 Table 4.2: points 58, 58, ... of 75; the ninth particle is printed as 63 and has 62. */
static void points_of_the_table(void **state) {
    (void)state;
    static const int POINTS[PARTICLES] = {58, 58, 56, 67, 69, 60, 61, 59, 62, 65};
    for (int p = 0; p < PARTICLES; p++) {
        int frames = 0;
        for (int k = 0; k < DEGREES; k++) frames += THESIS_DEGREE[p][k];
        assert_int_equal(frames, VIDEO_FRAMES);
        CHECK_NEAR(score_percent(THESIS_DEGREE[p]), POINTS[p] / 0.75, 1e-12);
    }
}

/* Five values 1 ... 5: mean 3, sd sqrt(5/2), half width 1.96 sqrt(1/2). */
static void interval_of_five(void **state) {
    (void)state;
    static const double X[5] = {4, 1, 5, 3, 2};
    const double edge = 1.96 * sqrt(0.5);
    assert_true(score_agrees(X, 5, 3 + edge - 1e-9));
    assert_true(score_agrees(X, 5, 3 - edge + 1e-9));
    assert_false(score_agrees(X, 5, 3 + edge + 1e-9));
    assert_false(score_agrees(X, 5, 3 - edge - 1e-9));
}

/* Tracks that differ by a constant in all items. */
static void shifted_tracks(track *tracks, int n) {
    for (int t = 0; t < n; t++)
        for (int k = 0; k < TRACK_POINTS; k++)
            for (int p = 0; p < PARTICLES; p++)
                for (int i = 0; i < ITEMS; i++)
                    tracks[t].at[k][p][i] = 0.01 * t + 0.1 * p + 0.001 * k + i;
}

static void degrees_of_agreement(void **state) {
    (void)state;
    static track t[6];
    const track *ensemble[5] = {&t[0], &t[1], &t[2], &t[3], &t[4]};
    shifted_tracks(t, 6);
    t[5] = t[2];
    scores same = score_against(ensemble, 5, &t[5]);
    CHECK_NEAR(same.mean, 100, 1e-12);
    for (int k = 0; k < TRACK_POINTS; k++) t[5].at[k][3][ITEM_ANGLE] += 1;
    t[5].at[2 * TRACK_PER_FRAME][3][ITEM_X] += 1;     /* one video frame */
    t[5].at[2 * TRACK_PER_FRAME + 1][3][ITEM_Z] += 1; /* none: between two */
    t[5].at[0][3][ITEM_Z] += 1;                       /* none: before the first */
    scores off = score_against(ensemble, 5, &t[5]);
    assert_int_equal(off.degree[3][2], 24);
    assert_int_equal(off.degree[3][1], 1);
    CHECK_NEAR(off.percent[3], 49 / 0.75, 1e-12);
    CHECK_NEAR(off.percent[4], 100, 1e-12);
    CHECK_NEAR(off.mean, 90 + 4.9 / 0.75, 1e-12);
}

/* ---- the null distribution ------------------------------------------------------------------- */

/* Student's t with four degrees of freedom in closed form: P(|t| < x) = u (3 - u^2) / 2 with
 * u = x / sqrt(4 + x^2). */
static double student_four(double x) {
    double u = x / sqrt(4 + x * x);
    return u * (3 - u * u) / 2;
}

static void null_closed_form(void **state) {
    (void)state;
    CHECK_NEAR(null_probability(NULL_NEW_DRAW, 5), student_four(1.96 / sqrt(6)), 1e-12);
    CHECK_NEAR(null_probability(NULL_EXACT_MEAN, 5), student_four(1.96), 1e-12);
    CHECK_NEAR(null_probability(NULL_NEW_DRAW, 5), 0.53, 0.005); /* what the study quotes */
    CHECK_NEAR(null_probability(NULL_EXACT_MEAN, 5), 0.88, 0.005);
}

/* Within four standard errors: one such test in sixteen thousand would fail by chance, and the seed
 * is fixed. */
static void null_by_monte_carlo(void **state) {
    (void)state;
    for (int kind = 0; kind < NULL_KINDS; kind++)
        for (int n = 3; n <= 8; n += 5) {
            interval v = null_probability_drawn((null_kind)kind, n, TRIALS, SEED);
            CHECK_NEAR(v.mean, null_probability((null_kind)kind, n), 4 * v.half / 1.96);
            CHECK_BELOW(v.half, 0.006);
        }
}

/* Mean over 30 draws, or over 750: same mean, spreads of a binomial distribution. */
static void null_of_whole_experiments(void **state) {
    (void)state;
    enum { N = 3000 };
    static double drawn[N];
    for (int kind = 0; kind < NULL_KINDS; kind++)
        for (int whole = 0; whole < 2; whole++) {
            double p = null_probability((null_kind)kind, ENSEMBLE);
            int draws = PARTICLES * ITEMS * (whole ? 1 : VIDEO_FRAMES);
            double sd = 100 * sqrt(p * (1 - p) / draws);
            null_scores((null_kind)kind, whole, drawn, whole ? N : N / 10, SEED);
            interval v = mean_interval(drawn, whole ? N : N / 10);
            CHECK_NEAR(v.mean, 100 * p, 4 * sd / sqrt(v.n));
            CHECK_CLOSE(v.sd, sd, 4 / sqrt(2.0 * v.n));
        }
}

/* Tracks of which each is a constant: their null must be that of whole tracks, but that a draw from
 * few is not a draw from many; so only what holds exactly is asked. */
static void null_of_tracks(void **state) {
    (void)state;
    static track t[8];
    const track *list[8];
    double drawn[50];
    shifted_tracks(t, 8);
    for (int i = 0; i < 8; i++) list[i] = &t[i];
    null_scores_of(NULL_NEW_DRAW, list, 8, drawn, 50, SEED);
    for (int i = 0; i < 50; i++) assert_true(drawn[i] == 0 || fabs(drawn[i] - 100) < 1e-9);
    assert_true(drawn[0] == 0 && drawn[49] > 99);
    CHECK_NEAR(part_at_least(drawn, 50, -1), 1, 0);
    CHECK_NEAR(part_at_least(drawn, 50, 101), 0, 0);
}

/* ---- tracks ---------------------------------------------------------------------------------- */

/* Rotation about y by -a lifts the long axis by a; a half turn does not show. */
static void angles(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846;
    for (double a = -7; a < 7; a += 0.37) {
        clast_quat q = clast_quat_axis_angle((clast_vec3){0, -1, 0}, a);
        const double array[4] = {q.w, q.x, q.y, q.z};
        CHECK_NEAR(angle_of(array, a), a, 1e-12);
        CHECK_NEAR(angle_of(array, a + 2 * pi), a + 2 * pi, 1e-12);
        CHECK_NEAR(angle_of(array, a - pi + 0.4), a - pi, 1e-12);
        CHECK_BELOW(fabs(angle_of(array, 0)), pi / 2 + 1e-12);
    }
}

static void distances(void **state) {
    (void)state;
    static track t[2], mean;
    const track *list[2] = {&t[0], &t[1]};
    shifted_tracks(t, 2);
    CHECK_NEAR(track_distance(&t[0], &t[1]), 0.01 * sqrt(2), 1e-12);
    track_mean(list, 2, &mean);
    CHECK_NEAR(track_distance(&t[0], &mean), 0.005 * sqrt(2), 1e-12);
    CHECK_NEAR(track_spread(list, 2, 17), 0.01, 1e-12); /* sd 0.01/sqrt(2) in x and in z */
}

/* Five and five that are apart: 2 of the 252 divisions are as far apart as that one. */
static void permutations(void **state) {
    (void)state;
    static track t[10];
    const track *near[10];
    for (int i = 0; i < 10; i++) near[i] = &t[i];
    shifted_tracks(t, 10);
    for (int k = 0; k < TRACK_POINTS; k++)
        for (int i = 5; i < 10; i++) t[i].at[k][0][ITEM_X] += 10;
    double p = permutation_p(near, 5, near + 5, 5, 20000, SEED);
    CHECK_NEAR(p, 2.0 / 252, 4 * sqrt(2.0 / 252 / 20000));
    shifted_tracks(t, 10); /* alternating: as mixed as can be */
    const track *odd[5], *even[5];
    for (int i = 0; i < 5; i++) even[i] = &t[2 * i], odd[i] = &t[2 * i + 1];
    CHECK_BELOW(0.5, permutation_p(odd, 5, even, 5, 2000, SEED));
}

/* A spread that grows with exp(3 t) from 1 um. */
static void exponential_growth(void **state) {
    (void)state;
    static track t[2];
    static const group_def DEF = {.errors = 1};
    const track *list[2] = {&t[0], &t[1]};
    memset(t, 0, sizeof t);
    for (int k = 0; k < TRACK_POINTS; k++)
        for (int p = 0; p < PARTICLES; p++) t[1].at[k][p][ITEM_X] = 1e-6 * exp(3 * k * TRACK_S);
    growth g = growth_of(&(group){.def = &DEF, .replicates = 2, .list = list});
    CHECK_NEAR(g.rate, 3, 1e-9);
    CHECK_NEAR(g.first, 1e-6 / sqrt(2), 1e-15);
    CHECK_BELOW(g.to, 3.15); /* 7.2 mm are reached at 3.08 s */
    CHECK_BELOW(2.9, g.to);
}

/* ---- placing --------------------------------------------------------------------------------- */

/* Two spheres less the lens that they share; 142 g of it are what FRIC and the text would need. */
static void volume_of_a_pair(void **state) {
    (void)state;
    const double pi = 3.14159265358979323846;
    for (double h = 0.1; h < 1; h += 0.17) {
        double d = 2 * h, lens = pi * (4 + d) * (2 - d) * (2 - d) / 12;
        CHECK_CLOSE(pair_volume(1, h), 8 * pi / 3 - lens, 1e-12);
    }
    CHECK_NEAR(142 / pair_volume(RIG_INPUT.radius, RIG_INPUT.half), 1.700, 0.0005);
    CHECK_NEAR(142 / pair_volume(2.25, 1.6875), 1.555, 0.0005);
    CHECK_NEAR(1.8 * pair_volume(RIG_INPUT.radius, RIG_INPUT.half), 150.4, 0.05);
}

/* Ten in two columns, each pair end to end, 3 mm from each other and more from the walls. */
static void lay_out(particle bed[PARTICLES]) {
    const double r = 0.01 * RIG_INPUT.radius, h = 0.01 * RIG_INPUT.half;
    for (int i = 0; i < PARTICLES; i++)
        bed[i] = (particle){.radius = r,
                            .half = h,
                            .x = (i % 2 ? 1 : -1) * (r + h + 0.0015),
                            .z = 0.01 * RIG_THROAT + 0.06 + (2 * r + 0.003) * (i / 2)};
}

static void clearance(void **state) {
    (void)state;
    particle bed[PARTICLES];
    lay_out(bed);
    CHECK_NEAR(bed_clearance(&RIG_INPUT, bed), 0.000775, 1e-12); /* of the sheets */
    bed[0].y = 0.0007;
    CHECK_NEAR(bed_clearance(&RIG_INPUT, bed), 0.000075, 1e-12);
    lay_out(bed);
    bed[1].x -= 0.0032;
    CHECK_NEAR(bed_clearance(&RIG_INPUT, bed), -0.0002, 1e-12);
    lay_out(bed);
    bed[0].z -= 0.0385; /* 0.725 mm into the piston: 60 - 38.5 - 22.225 */
    CHECK_NEAR(bed_clearance(&RIG_INPUT, bed), -0.000725, 1e-12);
    lay_out(bed);
    bed[9].angle = 1.5707963267948966; /* upright: its lower sphere is 5.4 mm into the one below */
    CHECK_BELOW(bed_clearance(&RIG_INPUT, bed), -0.001);
}

/* Errors depend on the replicate alone, scale, and leave nothing that overlaps. A thousandth of
 * them lets two particles overlap by at most 2 (0.1 + 0.2 + 0.7 + 36 mm x 1 degree) um = 3.3 um; no
 * way leads through more than ten particles, so none gives way by more than 33 um, less its own
 * error of 1. */
static void laid_by_hand(void **state) {
    (void)state;
    particle settled[PARTICLES], one[PARTICLES], again[PARTICLES], small[PARTICLES];
    lay_out(settled);
    for (int i = 0; i < PARTICLES; i++) settled[i].x *= 1 - 0.0015 / 0.0376; /* touch */
    for (int k = 1; k <= 20; k++) {
        memcpy(one, settled, sizeof one);
        memcpy(again, settled, sizeof again);
        memcpy(small, settled, sizeof small);
        bed_lay_by_hand(&RIG_INPUT, 1, false, k, one);
        bed_lay_by_hand(&RIG_INPUT, 1, false, k, again);
        bed_lay_by_hand(&RIG_INPUT, 1e-3, false, k, small);
        assert_memory_equal(one, again, sizeof one);
        assert_true(bed_clearance(&RIG_INPUT, one) >= 0);
        assert_true(bed_clearance(&RIG_INPUT, small) >= 0);
        for (int i = 0; i < PARTICLES; i++) {
            double error = one[i].radius - settled[i].radius;
            CHECK_BELOW(fabs(error), ERROR_RADIUS * (1 + 1e-9));
            CHECK_NEAR(small[i].radius - settled[i].radius, 1e-3 * error, 1e-12);
            CHECK_BELOW(hypot(small[i].x - settled[i].x, small[i].z - settled[i].z), 3.4e-5);
        }
    }
    bed_lay_by_hand(&RIG_INPUT, 1, false, 21, again);
    assert_true(one[3].radius != again[3].radius);
}

TEST_MAIN(cmocka_unit_test(points_of_the_table), cmocka_unit_test(interval_of_five),
          cmocka_unit_test(degrees_of_agreement), cmocka_unit_test(null_closed_form),
          cmocka_unit_test(null_by_monte_carlo), cmocka_unit_test(null_of_whole_experiments),
          cmocka_unit_test(null_of_tracks), cmocka_unit_test(angles), cmocka_unit_test(distances),
          cmocka_unit_test(permutations), cmocka_unit_test(exponential_growth),
          cmocka_unit_test(volume_of_a_pair), cmocka_unit_test(clearance),
          cmocka_unit_test(laid_by_hand))

/* Bars and pipes made from measures against the round bodies that they stand for. */
#include "meshes/shapes.h"
#include "tests/support/check.h"

static const double PI = 3.141592653589793;

/* Made, measured, thrown away; the text of the failure when it is refused. */
static mesh_report measured(mesh_status status, mesh_surface *raw) {
    mesh_surface clean;
    mesh_report r;
    mesh_options options = mesh_options_default();
    if (status != MESH_OK) fail_msg("%s", mesh_error_text());
    assert_int_equal(mesh_build("shape", raw, &options, &clean, &r), MESH_OK);
    assert_int_equal(r.flipped.count + r.collapsed.count + r.slivers.count + r.duplicates.count, 0);
    assert_int_equal(r.branching_edges.count + r.unused, 0);
    assert_int_equal(r.pieces, 1);
    mesh_free(raw);
    mesh_free(&clean);
    return r;
}

static void refused(mesh_status status, const char *want) {
    assert_int_equal(status, MESH_ERR_ARGUMENT);
    if (!strstr(mesh_error_text(), want))
        fail_msg("\"%s\" is not in \"%s\"", want, mesh_error_text());
}

/* ---- the bar --------------------------------------------------------------------------------- */

/* Of the bar with a round nose: the profile with a sharp edge, less what lies between that edge and
 * the circle that touches both of its sides, less the cut-off triangle at the foot. */
static double bar_volume(const mesh_bar *b) {
    double turn = PI / 2 + b->nose_angle, tangent = tan(b->nose_angle);
    double arm = b->nose_radius * tan(turn / 2); /* from the sharp edge to the circle */
    double foremost = b->nose_angle >= 0
                          ? arm - b->nose_radius
                          : (b->height - b->undercut) * tangent; /* behind the edge */
    double top = b->length + foremost;                           /* up to the sharp edge */
    double area = top * b->height - tangent * b->height * b->height / 2;
    area -= b->nose_radius * (arm - b->nose_radius * turn / 2);
    area -= b->undercut * b->undercut * (1 - tangent) / 2;
    return b->width * area;
}

static mesh_report bar_of(const mesh_bar *b) {
    mesh_surface s;
    mesh_status status = mesh_make_bar(b, &s);
    return measured(status, &s);
}

static const mesh_bar BARS[] = {
    {0.19, 0.03, 1, 0.005, 0, 0, 8},       {0.19, 0.03, 1, 0.015, 0, 0, 11},
    {0.19, 0.03, 0.024, 0.004, 0.3, 0, 5}, {0.17, 0.028, 0.5, 0.006, -0.25, 0, 7},
    {0.19, 0.03, 1, 0.007, 0.4, 0.003, 9}, {0.19, 0.031, 1, 0.002, -0.4, 0.004, 3},
};

static void bars_are_closed_and_as_large_as_asked(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        mesh_report r = bar_of(&BARS[i]);
        assert_true(r.closed && r.inward == 0);
        CHECK_CLOSE(r.low[0], -BARS[i].length, 1e-15);
        CHECK_NEAR(r.low[2], 0, 0);
        CHECK_CLOSE(r.high[1], BARS[i].width / 2, 1e-15);
        CHECK_CLOSE(r.high[2], BARS[i].height, 1e-15);
        /* corners are on the circle, so a flat side may cut its foremost point off */
        CHECK_BELOW(r.high[0], 1e-15);
        double most = BARS[i].nose_radius * (1 - cos(PI / 3 / BARS[i].segments));
        CHECK_BELOW(-most - 1e-15, r.high[0]);
    }
}

static void noses_converge(void **state) {
    (void)state;
    for (int i = 0; i < 6; i++) {
        double missing[2];
        for (int k = 0; k < 2; k++) {
            mesh_bar b = BARS[i];
            b.segments = 20 << k;
            missing[k] = bar_volume(&b) - bar_of(&b).volume;
            CHECK_BELOW(0, missing[k]); /* a polygon inside a circle */
        }
        CHECK_NEAR(order_of(missing[0], missing[1], 2), 2, 0.01);
    }
}

static void a_sharp_bar_is_exact(void **state) {
    (void)state;
    mesh_bar b = mesh_bar_default();
    b.nose_radius = 0;
    mesh_report r = bar_of(&b);
    assert_int_equal(r.triangles_read, 12);
    CHECK_CLOSE(r.volume, 0.19 * 0.03 * 1, 1e-14);
    b.nose_angle = 0.2, b.undercut = 0.004;
    CHECK_CLOSE(bar_of(&b).volume, bar_volume(&b), 1e-13);
}

static void impossible_bars_are_refused(void **state) {
    (void)state;
    mesh_surface s;
    mesh_bar b = mesh_bar_default();
    b.height = NAN;
    refused(mesh_make_bar(&b, &s), "length, height and width must be above 0");
    b = mesh_bar_default(), b.nose_radius = 0.03;
    refused(mesh_make_bar(&b, &s), "nose radius and undercut leave nothing of the front");
    b = mesh_bar_default(), b.undercut = 0.026;
    refused(mesh_make_bar(&b, &s), "leave nothing of the front");
    b = mesh_bar_default(), b.nose_angle = 1.2;
    refused(mesh_make_bar(&b, &s), "the nose angle must be in [-1, 1] rad");
    b = mesh_bar_default(), b.length = 0.004;
    refused(mesh_make_bar(&b, &s), "it is shorter than its nose");
    b = mesh_bar_default(), b.segments = 0;
    refused(mesh_make_bar(&b, &s), "segments must be in [1, 1000]");
    b = mesh_bar_default(), b.undercut = -1e-3;
    refused(mesh_make_bar(&b, &s), "must not be below 0");
}

/* ---- tube and bend --------------------------------------------------------------------------- */

/* S12 2.9.2: the volume of the wall of a tube with radii r1 and r2 at its ends. */
static double tube_volume(const mesh_tube *t, double length) {
    double c = t->thickness, r1 = t->radius, r2 = t->end_radius, a = r1 + c, b = r2 + c;
    return PI / 3 * length * (a * a + a * b + b * b - r1 * r1 - r1 * r2 - r2 * r2);
}

/* S12 2.9.2; alpha in degrees there. */
static double bend_volume(const mesh_bend *b, double bending_radius) {
    double outer = b->radius + b->thickness, degrees = b->angle * 180 / PI;
    return PI * PI * bending_radius * degrees / 180 * (outer * outer - b->radius * b->radius);
}

static mesh_report tube_of(const mesh_tube *t) {
    mesh_surface s;
    mesh_status status = mesh_make_tube(t, &s);
    return measured(status, &s);
}

static mesh_report bend_of(const mesh_bend *b) {
    mesh_surface s;
    mesh_status status = mesh_make_bend(b, &s);
    return measured(status, &s);
}

static const mesh_tube FUNNEL = {{0.1, -0.2, 0.4}, {-0.2, 0.3, 1.1}, 0.11, 0.23, 0.012, 37,
                                 MESH_FIT_AREA};
static const mesh_bend ELBOW = {
    {0.1, 0.2, -0.3}, {0.4, 0.2, -0.3}, {0, 3, -4}, 1.9, 0.08, 0.011, 31, 17, MESH_FIT_AREA};

/* With the cross-section kept the prism has the volume of the tube, whatever the segments. */
static void tubes_have_the_volume_of_the_source(void **state) {
    (void)state;
    const double length = sqrt(0.3 * 0.3 + 0.5 * 0.5 + 0.7 * 0.7);
    mesh_report r = tube_of(&FUNNEL);
    assert_true(r.closed && r.inward == 0);
    assert_int_equal(r.triangles_read, 8 * 37);
    CHECK_CLOSE(r.volume, tube_volume(&FUNNEL, length), 1e-11);
    double error[2][2];
    for (int fit = 0; fit < 2; fit++)
        for (int k = 0; k < 2; k++) {
            mesh_tube t = FUNNEL;
            t.fit = fit ? MESH_FIT_OUTSIDE : MESH_FIT_INSIDE;
            t.segments = 40 << k;
            error[fit][k] = tube_of(&t).volume - tube_volume(&t, length);
        }
    CHECK_BELOW(error[0][1], 0);
    CHECK_BELOW(0, error[1][1]);
    CHECK_NEAR(order_of(-error[0][0], -error[0][1], 2), 2, 0.01);
    CHECK_NEAR(order_of(error[1][0], error[1][1], 2), 2, 0.01);
}

static void bends_converge_to_the_volume_of_the_source(void **state) {
    (void)state;
    double error[2];
    for (int k = 0; k < 2; k++) {
        mesh_bend b = ELBOW;
        b.segments <<= k, b.rings <<= k;
        mesh_report r = bend_of(&b);
        assert_true(r.closed && r.inward == 0);
        assert_int_equal(r.triangles_read, 4 * b.segments * (b.rings + 1));
        error[k] = bend_volume(&b, 0.3) - r.volume;
    }
    CHECK_NEAR(order_of(error[0], error[1], 2), 2, 0.02);
    CHECK_BELOW(fabs(error[1]), 2e-3 * bend_volume(&ELBOW, 0.3));
}

/* All around it is S12's torus, seen from inside. */
static void a_whole_ring_has_no_ends(void **state) {
    (void)state;
    mesh_bend b = ELBOW;
    b.angle = 2 * PI, b.rings = 90, b.segments = 60, b.thickness = 0;
    mesh_report r = bend_of(&b);
    assert_true(r.closed);
    assert_int_equal(r.inward, 1);
    assert_int_equal(r.triangles_read, 2 * 60 * 90);
    CHECK_CLOSE(-r.volume, 2 * PI * PI * 0.3 * 0.08 * 0.08, 2e-3);
}

static double distance_to_axis(const mesh_tube *t, const double *p) {
    double along[3], way[3], length = 0, dot = 0, square = 0;
    for (int k = 0; k < 3; k++) {
        along[k] = t->to[k] - t->from[k], way[k] = p[k] - t->from[k];
        length += along[k] * along[k], dot += along[k] * way[k], square += way[k] * way[k];
    }
    return sqrt(square - dot * dot / length);
}

static void corners_lie_where_the_fit_says(void **state) {
    (void)state;
    mesh_tube t = {{0, 0.1, 0.2}, {1, 0.5, -0.3}, 0.2, 0.2, 0, 9, MESH_FIT_INSIDE};
    const double want[] = {sqrt(2 * PI / 9 / sin(2 * PI / 9)), 1, 1 / cos(PI / 9)};
    for (int fit = 0; fit < 3; fit++) {
        mesh_surface s;
        t.fit = (mesh_fit)fit;
        assert_int_equal(mesh_make_tube(&t, &s), MESH_OK);
        assert_int_equal(s.vertex_count, 18);
        assert_int_equal(s.triangle_count, 18);
        for (size_t v = 0; v < 18; v++)
            CHECK_CLOSE(distance_to_axis(&t, s.vertex + 3 * v), 0.2 * want[fit], 1e-14);
        mesh_free(&s);
    }
}

static void impossible_pipes_are_refused(void **state) {
    (void)state;
    mesh_surface s;
    mesh_tube t = FUNNEL;
    memcpy(t.to, t.from, sizeof t.to);
    refused(mesh_make_tube(&t, &s), "its ends must be apart");
    t = FUNNEL, t.end_radius = -0.1;
    refused(mesh_make_tube(&t, &s), "the radius must be above 0");
    t = FUNNEL, t.segments = 2;
    refused(mesh_make_tube(&t, &s), "segments must be 3 or more");
    t = FUNNEL, t.thickness = INFINITY;
    refused(mesh_make_tube(&t, &s), "the thickness must not be below 0");
    mesh_bend b = ELBOW;
    b.radius = 0.29;
    refused(mesh_make_bend(&b, &s), "the bending radius must be above pipe radius and thickness");
    b = ELBOW, b.axis[0] = 1;
    refused(mesh_make_bend(&b, &s), "the axis must be at right angles");
    b = ELBOW, b.angle = 6.3;
    refused(mesh_make_bend(&b, &s), "the angle must be above 0, 2 pi at most");
    b = ELBOW, b.angle = 4, b.rings = 1;
    refused(mesh_make_bend(&b, &s), "too few rings along the arc");
    b = ELBOW, memset(b.axis, 0, sizeof b.axis);
    refused(mesh_make_bend(&b, &s), "the axis must be at right angles");
}

TEST_MAIN(cmocka_unit_test(bars_are_closed_and_as_large_as_asked), cmocka_unit_test(noses_converge),
          cmocka_unit_test(a_sharp_bar_is_exact), cmocka_unit_test(impossible_bars_are_refused),
          cmocka_unit_test(tubes_have_the_volume_of_the_source),
          cmocka_unit_test(bends_converge_to_the_volume_of_the_source),
          cmocka_unit_test(a_whole_ring_has_no_ends),
          cmocka_unit_test(corners_lie_where_the_fit_says),
          cmocka_unit_test(impossible_pipes_are_refused))

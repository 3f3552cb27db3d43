/* Shapes there and back through files, against formulas. */
#include "meshes/shapes.h"
#include "tests/support/check.h"

static const double PI = 3.141592653589793;

static mesh_report there_and_back(mesh_surface *shape, const mesh_options *options,
                                  mesh_surface *read) {
    mesh_report report;
    assert_int_equal(mesh_write_stl(shape, "shape.stl"), MESH_OK);
    if (mesh_load("shape.stl", options, read, &report) != MESH_OK)
        fail_msg("%s", mesh_error_text());
    return report;
}

static void box_there_and_back(void **state) {
    (void)state;
    const double size[3] = {0.19, 1.0, 0.03};
    mesh_surface box, read;
    mesh_options options = mesh_options_default();
    assert_int_equal(mesh_make_box(size, &box), MESH_OK);
    mesh_report r = there_and_back(&box, &options, &read);
    assert_int_equal(r.triangles_read, 12);
    assert_int_equal(r.vertices_read, 36);
    assert_int_equal(r.joined, 28);
    assert_int_equal(r.moved + r.unused + r.loader_warnings + r.against.count + r.flipped.count, 0);
    assert_int_equal(read.vertex_count, 8);
    assert_int_equal(read.triangle_count, 12);
    assert_true(r.closed);
    assert_int_equal(r.pieces, 1);
    CHECK_CLOSE(r.volume, 0.19 * 1.0 * 0.03, 1e-6); /* single precision in the file */
    CHECK_CLOSE(r.area, 2 * (0.19 * 1.0 + 1.0 * 0.03 + 0.03 * 0.19), 1e-6);
    for (int k = 0; k < 3; k++) {
        CHECK_CLOSE(r.low[k], -size[k] / 2, 1e-7);
        CHECK_CLOSE(r.high[k], size[k] / 2, 1e-7);
    }
    mesh_free(&box);
    mesh_free(&read);
}

/* Area of the wall and of the bottom of the polygon that stands for the circle. */
static double wall_area(const mesh_cylinder *c) {
    return c->height * 2 * c->radius * sin(PI / c->segments) * c->segments;
}
static double bottom_area(const mesh_cylinder *c) {
    return 0.5 * c->segments * c->radius * c->radius * sin(2 * PI / c->segments);
}

static void cylinder_there_and_back(void **state) {
    (void)state;
    const mesh_cylinder shapes[] = {{0.1, 1.2, 80, 12}, {0.37, 0.11, 3, 1}, {12.3, 0.7, 17, 3}};
    for (int i = 0; i < 3; i++) {
        const mesh_cylinder *c = &shapes[i];
        mesh_surface cylinder, read;
        mesh_options options = mesh_options_default();
        assert_int_equal(mesh_make_cylinder(c, &cylinder), MESH_OK);
        mesh_report r = there_and_back(&cylinder, &options, &read);
        assert_int_equal(r.triangles_read, c->segments * (2 * c->bands + 1));
        assert_int_equal(read.triangle_count, r.triangles_read);
        assert_int_equal(read.vertex_count, 1 + c->segments * (c->bands + 1));
        assert_int_equal(r.open_edges.count, c->segments);
        assert_int_equal(r.branching_edges.count + r.flipped.count + r.against.count, 0);
        assert_int_equal(r.pieces, 1);
        assert_false(r.closed);
        CHECK_CLOSE(r.area, wall_area(c) + bottom_area(c), 1e-6);
        CHECK_CLOSE(r.high[2] - r.low[2], c->height, 1e-6);
        mesh_free(&cylinder);
        mesh_free(&read);
    }
}

static double signed_to_inside(const mesh_surface *s, size_t t, const double inside[3]) {
    const double *a = s->vertex + 3 * s->triangle[3 * t],
                 *b = s->vertex + 3 * s->triangle[3 * t + 1],
                 *c = s->vertex + 3 * s->triangle[3 * t + 2];
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        sum += (inside[k] - a[k]) * ((b[i] - a[i]) * (c[j] - a[j]) - (b[j] - a[j]) * (c[i] - a[i]));
    }
    return sum;
}

static void cylinder_faces_its_inside(void **state) {
    (void)state;
    mesh_surface s;
    assert_int_equal(mesh_make_cylinder(&(mesh_cylinder){0.2, 0.5, 31, 4}, &s), MESH_OK);
    for (size_t t = 0; t < s.triangle_count; t++)
        CHECK_BELOW(0, signed_to_inside(&s, t, (double[3]){0.01, -0.02, 0.21}));
    mesh_free(&s);
}

/* Corners are on the circle to the last bits; the missing area falls with the square. */
static void cylinder_converges(void **state) {
    (void)state;
    double missing[2];
    for (int i = 0; i < 2; i++) {
        mesh_cylinder c = {0.3, 1, 40 << i, 1};
        mesh_surface s;
        assert_int_equal(mesh_make_cylinder(&c, &s), MESH_OK);
        for (size_t v = 1; v < s.vertex_count; v++)
            CHECK_CLOSE(hypot(s.vertex[3 * v], s.vertex[3 * v + 1]), 0.3, 1e-14);
        mesh_report r;
        mesh_surface clean;
        mesh_options options = mesh_options_default();
        assert_int_equal(mesh_build("cylinder", &s, &options, &clean, &r), MESH_OK);
        missing[i] = 2 * PI * 0.3 + PI * 0.09 - r.area;
        mesh_free(&s);
        mesh_free(&clean);
    }
    CHECK_NEAR(order_of(missing[0], missing[1], 2), 2, 0.01);
}

static void units_and_axes(void **state) {
    (void)state;
    mesh_surface box, read;
    assert_int_equal(mesh_make_box((double[3]){190, 1000, 30}, &box), MESH_OK);
    for (size_t v = 0; v < 8; v++) box.vertex[3 * v + 1] += 700; /* y from 200 to 1200 */
    const char *const axes[] = {"xyz", "x -z y", "-y,x,z", "yxz", "-x -y -z"};
    const double low[][3] = {{-0.095, 0.2, -0.015},
                             {-0.095, -0.015, 0.2},
                             {-1.2, -0.095, -0.015},
                             {0.2, -0.095, -0.015},
                             {-0.095, -1.2, -0.015}};
    for (int i = 0; i < 5; i++) {
        mesh_options options = mesh_options_default();
        assert_int_equal(mesh_unit_parse("mm", &options.unit), MESH_OK);
        assert_int_equal(mesh_axes_parse(axes[i], options.axis), MESH_OK);
        mesh_report r = there_and_back(&box, &options, &read);
        for (int k = 0; k < 3; k++) CHECK_NEAR(r.low[k], low[i][k], 1e-7);
        CHECK_CLOSE(r.volume, 0.19 * 0.03, 1e-6); /* outsides stay outside in a mirror */
        assert_int_equal(r.inward, 0);
        mesh_free(&read);
    }
    mesh_free(&box);
}

static void refused(mesh_status status, const char *want) {
    assert_int_equal(status, MESH_ERR_ARGUMENT);
    assert_string_equal(mesh_error_text(), want);
}

static void options_out_of_range(void **state) {
    (void)state;
    mesh_surface box, read;
    double unit = 0;
    int axis[3];
    assert_int_equal(mesh_make_box((double[3]){1, 1, 1}, &box), MESH_OK);
    assert_int_equal(mesh_unit_parse("inch", &unit), MESH_OK);
    CHECK_CLOSE(unit, 0.0254, 0);
    assert_int_equal(mesh_unit_parse("0.3048", &unit), MESH_OK);
    CHECK_CLOSE(unit, 0.3048, 0);
    refused(mesh_unit_parse("ells", &unit),
            "mesh unit \"ells\": expected mm, cm, m, inch, or metres above 0");
    refused(mesh_unit_parse("-1", &unit),
            "mesh unit \"-1\": expected mm, cm, m, inch, or metres above 0");
    refused(mesh_axes_parse("xyy", axis),
            "mesh axes \"xyy\": expected x, y and z once each, such as \"x -z y\"");
    refused(mesh_axes_parse("xyz-", axis),
            "mesh axes \"xyz-\": expected x, y and z once each, such as \"x -z y\"");
    mesh_options o = mesh_options_default();
    o.unit = NAN;
    refused(mesh_build("box", &box, &o, &read, NULL), "mesh unit of nan m: it must be above 0");
    o = mesh_options_default();
    o.axis[2] = -1;
    refused(mesh_build("box", &box, &o, &read, NULL),
            "mesh axes 1 2 -1: x, y and z must each be there once");
    o = mesh_options_default();
    o.weld = 0;
    refused(mesh_load("box.stl", &o, &read, NULL), "mesh weld of 0: it must be in [1e-12, 1e-2]");
    refused(mesh_make_cylinder(&(mesh_cylinder){0, 1, 8, 1}, &read),
            "cylinder of radius 0 m, height 1 m: both must be above 0");
    mesh_free(&box);
}

TEST_MAIN(cmocka_unit_test(box_there_and_back), cmocka_unit_test(cylinder_there_and_back),
          cmocka_unit_test(cylinder_faces_its_inside), cmocka_unit_test(cylinder_converges),
          cmocka_unit_test(units_and_axes), cmocka_unit_test(options_out_of_range))

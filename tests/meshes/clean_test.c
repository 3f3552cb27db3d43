/* Cleaning of arrays: what is joined, removed, turned, and what is only reported. */
#include "meshes/shapes.h"
#include "tests/support/check.h"

#include <stdbool.h>

typedef struct soup {
    mesh_surface raw;
    size_t room;
} soup;

/* Every triangle with corners of its own, as in an STL. */
static void add(soup *s, const double a[3], const double b[3], const double c[3]) {
    if (s->raw.triangle_count == s->room) {
        s->room = 2 * s->room + 64;
        s->raw.vertex = realloc(s->raw.vertex, 9 * s->room * sizeof(double));
        s->raw.triangle = realloc(s->raw.triangle, 3 * s->room * sizeof(int32_t));
        assert_true(s->raw.vertex && s->raw.triangle);
    }
    size_t t = s->raw.triangle_count++;
    memcpy(s->raw.vertex + 9 * t, a, 3 * sizeof *a);
    memcpy(s->raw.vertex + 9 * t + 3, b, 3 * sizeof *b);
    memcpy(s->raw.vertex + 9 * t + 6, c, 3 * sizeof *c);
    for (size_t k = 0; k < 3; k++) s->raw.triangle[3 * t + k] = (int32_t)(3 * t + k);
    s->raw.vertex_count += 3;
}

static void add_surface(soup *s, const mesh_surface *m, const double at[3], double scale) {
    for (size_t t = 0; t < m->triangle_count; t++) {
        double p[3][3];
        for (int k = 0; k < 3; k++)
            for (int i = 0; i < 3; i++)
                p[k][i] = at[i] + scale * m->vertex[3 * m->triangle[3 * t + (size_t)k] + i];
        add(s, p[0], p[1], p[2]);
    }
}

static void add_box(soup *s, double x, double scale) {
    mesh_surface box;
    assert_int_equal(mesh_make_box((double[3]){1, 1, 1}, &box), MESH_OK);
    add_surface(s, &box, (double[3]){x, 0, 0}, scale);
    mesh_free(&box);
}

static void turn(soup *s, size_t triangle) {
    int32_t *c = s->raw.triangle + 3 * triangle, held = c[1];
    c[1] = c[2];
    c[2] = held;
}

static mesh_report cleaned(const soup *s, const mesh_options *wish, mesh_surface *out) {
    mesh_options options = wish ? *wish : mesh_options_default();
    mesh_surface made;
    mesh_report r;
    if (mesh_build("soup", &s->raw, &options, &made, &r) != MESH_OK)
        fail_msg("%s", mesh_error_text());
    if (out)
        *out = made;
    else
        mesh_free(&made);
    return r;
}

static void found(mesh_finding f, size_t count, size_t first) {
    assert_int_equal(f.count, count);
    assert_int_equal(f.first, first);
}

/* Corners of one place, scattered within a third of the weld distance, become one again. */
static void scattered_corners_join(void **state) {
    (void)state;
    soup s = {0};
    dice d = {.seed = 11};
    mesh_options options = mesh_options_default();
    options.weld = 1e-4;
    add_box(&s, 0.3, 1.7);
    double distance = options.weld * 1.7 * sqrt(3);
    for (size_t i = 0; i < 3 * s.raw.vertex_count; i++)
        s.raw.vertex[i] += roll(&d, -1, 1) * 0.28 * distance;
    mesh_surface out;
    mesh_report r = cleaned(&s, &options, &out);
    assert_int_equal(out.vertex_count, 8);
    assert_int_equal(r.joined, 28);
    assert_int_equal(r.moved, 28);
    assert_true(r.closed);
    CHECK_BELOW(0, r.farthest_move);
    CHECK_BELOW(r.farthest_move, r.weld_distance);
    CHECK_CLOSE(r.volume, 1.7 * 1.7 * 1.7, 1e-3);
    mesh_free(&out);
    options.weld = 1e-7;
    r = cleaned(&s, &options, NULL);
    assert_int_equal(r.joined, 0);
    assert_int_equal(r.open_edges.count, 36);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

static size_t kept_by_brute_force(const mesh_surface *raw, double distance) {
    size_t *kept = malloc(raw->vertex_count * sizeof *kept), count = 0;
    assert_non_null(kept);
    for (size_t v = 0; v < raw->vertex_count; v++) {
        const double *p = raw->vertex + 3 * v;
        bool near = false;
        for (size_t i = 0; i < count && !near; i++) {
            const double *q = raw->vertex + 3 * kept[i];
            double x = p[0] - q[0], y = p[1] - q[1], z = p[2] - q[2];
            near = sqrt(x * x + y * y + z * z) <= distance;
        }
        if (!near) kept[count++] = v;
    }
    free(kept);
    return count;
}

/* The grid against all pairs, on clouds dense enough that most corners have somebody near. */
static void weld_by_brute_force(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 20; seed++) {
        soup s = {0};
        dice d = {.seed = seed};
        double flat = seed % 2 ? 1 : 0;
        for (int i = 0; i < 300; i++) {
            double p[3][3];
            for (int k = 0; k < 9; k++)
                p[k / 3][k % 3] = roll(&d, -1, 1) * (k % 3 == 2 ? flat : 1) + 3;
            add(&s, p[0], p[1], p[2]);
        }
        mesh_options options = mesh_options_default();
        options.weld = 0.01;
        mesh_report r = cleaned(&s, &options, NULL);
        size_t kept = kept_by_brute_force(&s.raw, r.weld_distance);
        if (r.vertices_read - r.joined != kept)
            fail_msg("seed %d: %zu kept, all pairs keep %zu", (int)seed, r.vertices_read - r.joined,
                     kept);
        CHECK_BELOW(0, (double)r.joined);
        free(s.raw.vertex);
        free(s.raw.triangle);
    }
}

static void removals(void **state) {
    (void)state;
    soup s = {0};
    const double o[3] = {-0.5, -0.5, -0.5}, x[3] = {0.5, -0.5, -0.5}, m[3] = {0.1, -0.5, -0.5},
                 near[3] = {0.1 + 1e-7, -0.5, -0.5}, above[3] = {0.1, -0.5, -0.5 + 1e-6};
    add_box(&s, 0, 1);    /* 1 to 12 */
    add(&s, o, m, x);     /* 13: a sliver, its corners in one line */
    add(&s, o, near, m);  /* 14: two corners become one */
    add(&s, o, above, x); /* 15: a sliver to the weld, 1e-6 high */
    add_box(&s, 0, 1);    /* 16 to 27: all there already, ... */
    turn(&s, 15 + 4);     /* ... one of them the other way round */
    mesh_surface out;
    mesh_report r = cleaned(&s, NULL, &out);
    found(r.slivers, 2, 13);
    found(r.collapsed, 1, 14);
    found(r.duplicates, 12, 16);
    assert_int_equal(r.unused, 1); /* `m`, which took `near` and `above` in */
    assert_int_equal(r.moved, 2);
    assert_int_equal(out.vertex_count, 8);
    assert_int_equal(out.triangle_count, 12);
    assert_true(r.closed);
    CHECK_CLOSE(r.volume, 1.0, 1e-12);
    mesh_free(&out);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

/* What an absolute limit on areas would drop. */
static void small_parts_stay(void **state) {
    (void)state;
    const double size[] = {1e-9, 1e-5, 1, 1e4};
    for (int i = 0; i < 4; i++) {
        soup s = {0};
        add_box(&s, 0, size[i]);
        mesh_report r = cleaned(&s, NULL, NULL);
        assert_int_equal(r.joined, 28);
        assert_true(r.closed);
        CHECK_CLOSE(r.volume, size[i] * size[i] * size[i], 1e-12);
        free(s.raw.vertex);
        free(s.raw.triangle);
    }
}

static void winding_is_mended(void **state) {
    (void)state;
    for (size_t turned = 0; turned <= 12; turned++) {
        soup s = {0};
        add_box(&s, 5, 1);
        for (size_t t = 0; t < turned; t++) turn(&s, t);
        mesh_report r = cleaned(&s, NULL, NULL);
        size_t minority = turned <= 6 ? turned : 12 - turned;
        size_t first = turned == 0 || turned == 12 ? 0 : turned <= 6 ? 1 : turned + 1;
        found(r.flipped, minority, first);
        assert_int_equal(r.mended, minority > 0);
        assert_true(r.closed);
        assert_int_equal(r.inward, turned > 6); /* the majority decides; in a tie, outwards */
        CHECK_CLOSE(r.volume, turned > 6 ? -1.0 : 1.0, 1e-12);
        free(s.raw.vertex);
        free(s.raw.triangle);
    }
}

static void winding_is_left_on_request(void **state) {
    (void)state;
    soup s = {0};
    mesh_options options = mesh_options_default();
    options.mend_winding = false;
    add_box(&s, 0, 1);
    turn(&s, 6);
    mesh_surface out;
    mesh_report r = cleaned(&s, &options, &out);
    found(r.flipped, 1, 7);
    assert_false(r.mended);
    assert_false(r.closed);
    CHECK_NEAR(r.volume, 0, 0);
    assert_int_equal(out.triangle_count, 12);
    mesh_free(&out);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

/* A box with a cavity: two closed pieces, one of which faces inwards and is right. */
static void cavity(void **state) {
    (void)state;
    soup s = {0};
    add_box(&s, 0, 1);
    add_box(&s, 0.1, 0.5);
    for (size_t t = 12; t < 24; t++) turn(&s, t);
    mesh_report r = cleaned(&s, NULL, NULL);
    assert_int_equal(r.pieces, 2);
    assert_int_equal(r.inward, 1);
    assert_true(r.closed);
    CHECK_CLOSE(r.volume, 1 - 0.125, 1e-12);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

static void open_and_branching_edges(void **state) {
    (void)state;
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, a[3] = {0, 1, 0}, b[3] = {0, 0, 1},
                 c[3] = {0, -1, -1};
    soup s = {0};
    add(&s, o, x, a);
    add(&s, x, o, b);
    mesh_report r = cleaned(&s, NULL, NULL);
    found(r.open_edges, 4, 1);
    found(r.branching_edges, 0, 0);
    assert_int_equal(r.pieces, 1);
    add(&s, o, x, c);
    r = cleaned(&s, NULL, NULL);
    found(r.open_edges, 6, 1);
    found(r.branching_edges, 1, 1);
    assert_int_equal(r.pieces, 3);
    assert_false(r.closed);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

static void moebius_band(void **state) {
    (void)state;
    enum { N = 12 };
    soup s = {0};
    double rim[N + 1][2][3];
    for (int i = 0; i <= N; i++)
        for (int side = 0; side < 2; side++) {
            double turn_angle = 6.283185307179586 * i / N, w = side ? -0.2 : 0.2;
            double out = 1 + w * cos(turn_angle / 2);
            memcpy(
                rim[i][side],
                (double[3]){out * cos(turn_angle), out * sin(turn_angle), w * sin(turn_angle / 2)},
                sizeof rim[i][side]);
        }
    for (int i = 0; i < N; i++) {
        add(&s, rim[i][0], rim[i + 1][0], rim[i][1]);
        add(&s, rim[i][1], rim[i + 1][0], rim[i + 1][1]);
    }
    mesh_report r = cleaned(&s, NULL, NULL);
    assert_int_equal(r.twisted_edges.count, 1);
    assert_int_equal(r.open_edges.count, 2 * N);
    assert_int_equal(r.pieces, 1);
    assert_false(r.closed);
    free(s.raw.vertex);
    free(s.raw.triangle);
}

static void wrong(soup *s, const char *want) {
    mesh_options options = mesh_options_default();
    mesh_surface out;
    assert_int_equal(mesh_build("soup", &s->raw, &options, &out, NULL), MESH_ERR_FORMAT);
    assert_string_equal(mesh_error_text(), want);
    assert_null(out.vertex);
    assert_int_equal(out.triangle_count, 0);
}

static void impossible_arrays(void **state) {
    (void)state;
    soup s = {0};
    const double o[3] = {0, 0, 0}, x[3] = {1, 0, 0}, xx[3] = {2, 0, 0};
    wrong(&s, "soup: no triangles in it, 0 vertices, 0 points and lines");
    add(&s, o, x, xx);
    wrong(&s,
          "soup: none of the 1 triangles has an area: 0 have corners that coincide, 1 are flat, "
          "within 2e-06 m");
    s.raw.vertex[7] = NAN;
    wrong(&s, "soup: triangle 1, corner 3 at (2, nan, 0) m: not a place");
    s.raw.vertex[7] = -2e6;
    wrong(&s, "soup: triangle 1, corner 3 at (2, -2e+06, 0) m: more than 1e6 m away");
    s.raw.triangle[1] = 3;
    wrong(&s, "soup: triangle 1, corner 2: no vertex 3 among 3");
    s.raw.triangle[1] = -1;
    wrong(&s, "soup: triangle 1, corner 2: no vertex -1 among 3");
    memset(s.raw.vertex, 0, 9 * sizeof(double));
    s.raw.triangle[1] = 1;
    wrong(&s,
          "soup: none of the 1 triangles has an area: 1 have corners that coincide, 0 are flat, "
          "within 0 m");
    free(s.raw.vertex);
    free(s.raw.triangle);
}

TEST_MAIN(cmocka_unit_test(scattered_corners_join), cmocka_unit_test(weld_by_brute_force),
          cmocka_unit_test(removals), cmocka_unit_test(small_parts_stay),
          cmocka_unit_test(winding_is_mended), cmocka_unit_test(winding_is_left_on_request),
          cmocka_unit_test(cavity), cmocka_unit_test(open_and_branching_edges),
          cmocka_unit_test(moebius_band), cmocka_unit_test(impossible_arrays))

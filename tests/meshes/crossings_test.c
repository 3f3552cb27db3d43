/* Triangles that pass through each other: against another method, and where there are none. */
#include "meshes/shapes.h"
#include "tests/support/check.h"

#include <stdbool.h>

static mesh_report sought(const mesh_surface *raw) {
    mesh_options options = mesh_options_default();
    options.find_crossings = true;
    options.mend_winding = false;
    mesh_surface clean;
    mesh_report r;
    if (mesh_build("soup", raw, &options, &clean, &r) != MESH_OK) fail_msg("%s", mesh_error_text());
    mesh_free(&clean);
    assert_true(r.crossings_sought && !r.crossings_given_up);
    return r;
}

/* ---- random triangles, against edges that pierce triangles ----------------------------------- */

enum { TRIANGLES = 40 };

static const double *corner(const mesh_surface *s, int t, int k) {
    return s->vertex + 3 * s->triangle[3 * t + k % 3];
}

static double volume(const double *a, const double *b, const double *c, const double *d) {
    double sum = 0;
    for (int k = 0; k < 3; k++) {
        int i = (k + 1) % 3, j = (k + 2) % 3;
        sum += (a[k] - d[k]) * ((b[i] - d[i]) * (c[j] - d[j]) - (b[j] - d[j]) * (c[i] - d[i]));
    }
    return sum;
}

/* The ends lie on different sides, and the line passes all sides of the triangle alike. */
static bool pierces(const mesh_surface *s, int edge_of, int k, int t) {
    const double *p = corner(s, edge_of, k), *q = corner(s, edge_of, k + 1);
    const double *a = corner(s, t, 0), *b = corner(s, t, 1), *c = corner(s, t, 2);
    if (volume(a, b, c, p) * volume(a, b, c, q) >= 0) return false;
    double x = volume(p, q, a, b), y = volume(p, q, b, c), z = volume(p, q, c, a);
    return (x > 0 && y > 0 && z > 0) || (x < 0 && y < 0 && z < 0);
}

static bool cross_each_other(const mesh_surface *s, int a, int b) {
    for (int k = 0; k < 3; k++)
        if (pierces(s, a, k, b) || pierces(s, b, k, a)) return true;
    return false;
}

static void random_triangles_agree_with_all_pairs(void **state) {
    (void)state;
    static double vertex[9 * TRIANGLES];
    static int32_t triangle[3 * TRIANGLES];
    mesh_surface s = {3 * TRIANGLES, vertex, TRIANGLES, triangle};
    for (int i = 0; i < 3 * TRIANGLES; i++) triangle[i] = i;
    size_t all = 0;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        dice d = {.seed = seed};
        for (int t = 0; t < TRIANGLES; t++) {
            double size = roll(&d, 0.05, 0.8), at[3];
            for (int k = 0; k < 3; k++) at[k] = roll(&d, 0, 1);
            for (int k = 0; k < 9; k++) vertex[9 * t + k] = at[k % 3] + roll(&d, 0, size);
        }
        size_t want = 0, first[2] = {0, 0};
        for (int a = 0; a < TRIANGLES; a++)
            for (int b = a + 1; b < TRIANGLES; b++)
                if (cross_each_other(&s, a, b) && want++ == 0)
                    first[0] = (size_t)a + 1, first[1] = (size_t)b + 1;
        mesh_report r = sought(&s);
        if (r.crossings.count != want || r.crossings.first != first[0] ||
            r.crossings_partner != first[1])
            fail_msg("seed %d: %zu pairs, first %zu %zu, expected %zu, %zu %zu", (int)seed,
                     r.crossings.count, r.crossings.first, r.crossings_partner, want, first[0],
                     first[1]);
        all += want;
    }
    CHECK_BELOW(1000, all); /* else nothing was tested */
}

/* ---- bodies ---------------------------------------------------------------------------------- */

/* `to` with `other` behind it, moved. */
static void append(mesh_surface *to, const mesh_surface *other, double x, double y, double z) {
    const double by[3] = {x, y, z};
    size_t v = to->vertex_count, t = to->triangle_count;
    to->vertex_count += other->vertex_count, to->triangle_count += other->triangle_count;
    to->vertex = realloc(to->vertex, 3 * to->vertex_count * sizeof *to->vertex);
    to->triangle = realloc(to->triangle, 3 * to->triangle_count * sizeof *to->triangle);
    assert_true(to->vertex && to->triangle);
    for (size_t i = 0; i < 3 * other->vertex_count; i++)
        to->vertex[3 * v + i] = other->vertex[i] + by[i % 3];
    for (size_t i = 0; i < 3 * other->triangle_count; i++)
        to->triangle[3 * t + i] = other->triangle[i] + (int32_t)v;
}

/* What a mesh of neighbours, of stacked boxes and of bars that lie on each other may not show. */
static void what_touches_does_not_cross(void **state) {
    (void)state;
    mesh_surface box, bar, tube, all = {0}, grate = {0};
    assert_int_equal(mesh_make_box((double[3]){1, 1, 1}, &box), MESH_OK);
    const double at[][3] = {{0, 0, 0},   {1, 0, 0},    {0, 0, 1},   {0.3, 1, 0.2},
                            {-1, -1, 0}, {-1, -1, -1}, {0.5, -1, 1}};
    for (int i = 0; i < 7; i++) append(&all, &box, at[i][0], at[i][1], at[i][2]);
    assert_int_equal(sought(&all).crossings.count, 0);
    mesh_bar measures = mesh_bar_default();
    assert_int_equal(mesh_make_bar(&measures, &bar), MESH_OK);
    for (int i = 0; i < 11; i++) append(&grate, &bar, 0.0824 * i, 0, -0.03 * i);
    assert_int_equal(sought(&grate).crossings.count, 0);
    mesh_tube funnel = {{0, 0, 0}, {1, 2, 3}, 0.4, 0.1, 0.03, 200, MESH_FIT_AREA};
    assert_int_equal(mesh_make_tube(&funnel, &tube), MESH_OK);
    assert_int_equal(sought(&tube).crossings.count, 0);
    mesh_free(&box), mesh_free(&bar), mesh_free(&tube), mesh_free(&all), mesh_free(&grate);
}

/* A bar pushed into the next one by a tenth of a millimetre. */
static void what_lies_in_another_does(void **state) {
    (void)state;
    mesh_surface bar, grate = {0};
    mesh_bar measures = mesh_bar_default();
    assert_int_equal(mesh_make_bar(&measures, &bar), MESH_OK);
    append(&grate, &bar, 0, 0, 0);
    append(&grate, &bar, 0.0824, 0, -0.0299);
    mesh_report r = sought(&grate);
    CHECK_BELOW(0, r.crossings.count);
    CHECK_BELOW(r.crossings.first, bar.triangle_count + 1);
    CHECK_BELOW(bar.triangle_count, r.crossings_partner);
    mesh_free(&bar), mesh_free(&grate);
}

/* Two wide triangles in a cross that share a corner: beyond it they part, or they do not. */
static void neighbours_may_cross(void **state) {
    (void)state;
    double vertex[] = {0, 0, 0, 1, -1, 0, 1, 1, 0, 1, 0, -1, 1, 0, 1, -1, 0, -1, -1, 0, 1};
    int32_t through[] = {0, 1, 2, 0, 3, 4}, away[] = {0, 1, 2, 0, 5, 6};
    mesh_surface s = {7, vertex, 2, through};
    assert_int_equal(sought(&s).crossings.count, 1);
    s.triangle = away;
    assert_int_equal(sought(&s).crossings.count, 0);
}

/* Whether a mesh is large or fine does not matter: 100 000 triangles, and one that goes through. */
static void one_pair_is_found_in_a_fine_mesh(void **state) {
    (void)state;
    mesh_surface fine, nail;
    mesh_bend elbow = {{0, 0, 0}, {300, 0, 0}, {0, 1, 0}, 1.5, 80, 0, 250, 200, MESH_FIT_AREA};
    assert_int_equal(mesh_make_bend(&elbow, &fine), MESH_OK);
    assert_int_equal(sought(&fine).crossings.count, 0);
    double vertex[] = {376.1, 0.3, -30.3, 376.2, 0.35, -30.3, 390, 0.32, -30.31};
    int32_t triangle[] = {0, 1, 2};
    nail = (mesh_surface){3, vertex, 1, triangle};
    append(&fine, &nail, 0, 0, 0);
    mesh_report r = sought(&fine);
    assert_int_equal(r.crossings.count, 1);
    assert_int_equal(r.crossings_partner, 100001);
    mesh_free(&fine);
}

TEST_MAIN(cmocka_unit_test(random_triangles_agree_with_all_pairs),
          cmocka_unit_test(what_touches_does_not_cross),
          cmocka_unit_test(what_lies_in_another_does), cmocka_unit_test(neighbours_may_cross),
          cmocka_unit_test(one_pair_is_found_in_a_fine_mesh))

/* Triangle meshes: mass, nearest point beside all triangles, winding number, holes. */
#include "shapes/deviation.h"
#include "shapes/mesh.h"
#include "shapes/numbers.h"
#include "shapes/solid.h"
#include "shapes/target.h"
#include "tests/support/check.h"

static shape_vec any_point(dice *d, double reach) {
    double x = roll(d, -reach, reach), y = roll(d, -reach, reach);
    return sv(x, y, roll(d, -reach, reach));
}

static const shape_solid TORUS = {SHAPE_TORUS, {0.3, 0.8}};
static const shape_solid BLOCK = {SHAPE_BLOCK, {1.4, 0.6, 0.9}};

static void mass_of_a_block_wherever_it_is(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&BLOCK, 1);
    shape_mass want = shape_solid_mass(&BLOCK), got = shape_mesh_mass(&mesh);
    CHECK_CLOSE(got.volume, want.volume, 1e-15);
    for (size_t i = 0; i < mesh.vertex_count; i++)
        mesh.vertex[i] = sv_add(mesh.vertex[i], sv(700, -300, 50));
    got = shape_mesh_mass(&mesh);
    CHECK_CLOSE(got.volume, want.volume, 1e-12);
    CHECK_NEAR(sv_distance(got.centre, sv(700, -300, 50)), 0, 1e-12);
    for (int k = 0; k < 3; k++) CHECK_CLOSE(got.inertia[k][k], want.inertia[k][k], 1e-11);
    shape_mesh_turn(&mesh);
    CHECK_CLOSE(shape_mesh_volume(&mesh), -want.volume, 1e-12);
    shape_mesh_free(&mesh);
}

static void the_tree_finds_the_nearest_triangle(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&TORUS, 1);
    shape_tree *tree = shape_tree_new(&mesh);
    dice d = {.seed = 21};
    for (int i = 0; i < 300; i++) {
        shape_vec p = any_point(&d, 1.4), q, c[3];
        size_t triangle;
        double got = shape_tree_nearest(tree, p, &q, &triangle), want = HUGE_VAL;
        for (size_t t = 0; t < mesh.triangle_count; t++) {
            shape_mesh_corners(&mesh, t, c);
            want = fmin(want, sv_distance(p, shape_triangle_nearest(c, p)));
        }
        CHECK_NEAR(got, want, 1e-15);
        CHECK_NEAR(sv_distance(p, q), got, 1e-15);
        shape_mesh_corners(&mesh, triangle, c);
        CHECK_NEAR(sv_distance(q, shape_triangle_nearest(c, p)), 0, 1e-15);
    }
    shape_tree_free(tree);
    shape_mesh_free(&mesh);
}

/* Nearest point of a triangle beside a fine grid of its points. */
static void nearest_point_of_a_triangle(void **state) {
    (void)state;
    dice d = {.seed = 22};
    for (int i = 0; i < 200; i++) {
        shape_vec c[3] = {any_point(&d, 1), any_point(&d, 1), any_point(&d, 1)};
        shape_vec p = any_point(&d, 2), q = shape_triangle_nearest(c, p);
        double got = sv_distance(p, q), best = HUGE_VAL;
        enum { N = 60 };
        for (int u = 0; u <= N; u++)
            for (int v = 0; u + v <= N; v++) {
                shape_vec at = sv_along(c[0], (double)u / N, sv_sub(c[1], c[0]));
                at = sv_along(at, (double)v / N, sv_sub(c[2], c[0]));
                best = fmin(best, sv_distance(p, at));
            }
        CHECK_BELOW(got, best + 1e-12);
        CHECK_BELOW(best - 4.0 / N, got);
    }
}

/* Triangles without an area, flat or shrunk to a point: they are where their corners are, and
 * change neither mass nor inside nor the largest deviation. */
static void triangles_of_no_area(void **state) {
    (void)state;
    const shape_vec flat[3] = {{0, 0, 0}, {1, 0, 0}, {3, 0, 0}},
                    point[3] = {{2, 1, 0}, {2, 1, 0}, {2, 1, 0}};
    CHECK_NEAR(sv_distance(shape_triangle_nearest(flat, sv(2, 5, 0)), sv(2, 0, 0)), 0, 1e-15);
    CHECK_NEAR(sv_distance(shape_triangle_nearest(point, sv(9, 9, 9)), sv(2, 1, 0)), 0, 0);
    shape_mesh block = shape_solid_mesh(&BLOCK, 1);
    shape_mesh more = shape_mesh_new(block.vertex_count, block.triangle_count + 2);
    memcpy(more.vertex, block.vertex, block.vertex_count * sizeof *more.vertex);
    memcpy(more.triangle, block.triangle, 3 * block.triangle_count * sizeof *more.triangle);
    int32_t *added = more.triangle + 3 * block.triangle_count; /* a side there and back, a corner */
    added[0] = added[2] = block.triangle[0], added[1] = block.triangle[1];
    added[3] = added[4] = added[5] = block.triangle[2];
    const char *fault;
    shape_target *a = shape_target_of_mesh(&block, &fault),
                 *b = shape_target_of_mesh(&more, &fault);
    CHECK_CLOSE(b->mass.volume, a->mass.volume, 1e-15);
    dice d = {.seed = 5};
    for (int i = 0; i < 200; i++) {
        shape_vec p = any_point(&d, 1);
        CHECK_NEAR(shape_target_distance(b, p, NULL, NULL), shape_target_distance(a, p, NULL, NULL),
                   1e-15);
    }
    const shape_sphere one = {{0.1, 0, 0}, 0.2};
    CHECK_NEAR(shape_deviation_max(b, &one, 1), shape_deviation_max(a, &one, 1), 0);
    shape_target_free(a), shape_target_free(b);
}

static void winding_tells_inside_from_outside(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&TORUS, 2);
    shape_tree *tree = shape_tree_new(&mesh);
    dice d = {.seed = 23};
    for (int i = 0; i < 3000; i++) {
        shape_vec p = any_point(&d, 1.3);
        double distance = shape_solid_distance(&TORUS, p, NULL, NULL);
        if (fabs(distance) < 0.01) continue; /* between the torus and its triangles */
        CHECK_NEAR(shape_tree_winding(tree, p), distance < 0, 0.1);
    }
    shape_tree_free(tree);
    /* with every twentieth triangle gone, what is well inside is still inside */
    size_t kept = 0;
    for (size_t t = 0; t < mesh.triangle_count; t++)
        if (t % 20 != 7) memcpy(mesh.triangle + 3 * kept++, mesh.triangle + 3 * t, 12);
    mesh.triangle_count = kept;
    tree = shape_tree_new(&mesh);
    for (int i = 0; i < 2000; i++) {
        shape_vec p = any_point(&d, 1.3);
        double distance = shape_solid_distance(&TORUS, p, NULL, NULL);
        if (fabs(distance) < 0.12) continue;
        assert_int_equal(shape_tree_winding(tree, p) > 0.5, distance < 0);
    }
    shape_tree_free(tree);
    shape_mesh_free(&mesh);
}

static void a_target_turns_a_mesh_that_faces_inwards(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&BLOCK, 1);
    shape_mesh_turn(&mesh);
    const char *fault = NULL;
    shape_target *t = shape_target_of_mesh(&mesh, &fault);
    assert_non_null(t);
    CHECK_CLOSE(t->mass.volume, 1.4 * 0.6 * 0.9, 1e-14);
    CHECK_NEAR(shape_target_distance(t, sv(0.1, 0.2, 0), NULL, NULL), -0.1, 1e-14);
    shape_target_free(t);
    mesh = shape_solid_mesh(&BLOCK, 1);
    for (size_t i = 0; i < mesh.vertex_count; i++) mesh.vertex[i].z = 0;
    assert_null(shape_target_of_mesh(&mesh, &fault));
    assert_string_equal(fault, "no volume");
}

/* Every eighth of the surface of a block gets its share of the samples, on the surface. */
static void samples_are_even(void **state) {
    (void)state;
    enum { COUNT = 4000 };
    static shape_vec p[COUNT], n[COUNT];
    shape_target *t = shape_target_of_solid(&BLOCK);
    shape_target_samples(t, COUNT, p, n);
    int octant[8] = {0};
    for (int i = 0; i < COUNT; i++) {
        octant[(p[i].x > 0) + 2 * (p[i].y > 0) + 4 * (p[i].z > 0)]++;
        CHECK_NEAR(shape_target_distance(t, p[i], NULL, NULL), 0, 1e-14);
    }
    for (int k = 0; k < 8; k++) CHECK_NEAR(octant[k], COUNT / 8, 0.05 * COUNT / 8);
    shape_target_free(t);
}

TEST_MAIN(cmocka_unit_test(mass_of_a_block_wherever_it_is),
          cmocka_unit_test(the_tree_finds_the_nearest_triangle),
          cmocka_unit_test(nearest_point_of_a_triangle), cmocka_unit_test(triangles_of_no_area),
          cmocka_unit_test(winding_tells_inside_from_outside),
          cmocka_unit_test(a_target_turns_a_mesh_that_faces_inwards),
          cmocka_unit_test(samples_are_even))

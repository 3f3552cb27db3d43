/* Filling: inside, symmetric, nested, the same every time; what is asked for is met; how good it is
 * is measured right where a formula knows it. */
#include <stdlib.h>
#include <time.h>

#include "shapes/clump.h"
#include "shapes/deviation.h"
#include "shapes/fill.h"
#include "shapes/numbers.h"
#include "shapes/quality.h"
#include "tests/support/check.h"

static const double DEGREE = SHAPE_PI / 180;

static const shape_solid SOLIDS[] = {
    {SHAPE_SPHERE, {0.73}},           {SHAPE_ELLIPSOID, {1.31, 0.57, 0.83}},
    {SHAPE_CYLINDER, {0.5, 2.3}},     {SHAPE_CUBE, {0.87}},
    {SHAPE_BLOCK, {1.7, 0.6, 0.9}},   {SHAPE_PARALLELEPIPED, {1.9, 0.7}},
    {SHAPE_TETRAHEDRON, {1.3}},       {SHAPE_CONE, {0.66, 1.4}},
    {SHAPE_DOUBLE_CONE, {0.58, 2.1}}, {SHAPE_HYPERBOLOID, {0.9, 0.5, 1.7}},
    {SHAPE_BARREL, {0.5, 0.8, 1.9}},  {SHAPE_DISC, {1.1, 0.45, 0.4}},
    {SHAPE_TORUS, {0.3, 0.95}},
};

static shape_sphere spheres[SHAPE_SPHERES_MAX], again[SHAPE_SPHERES_MAX];
static int level[SHAPE_SPHERES_MAX];

/* At density 1.3: inscribed, dense enough, centred and aligned as the solid is. */
static void every_solid_is_filled(void **state) {
    (void)state;
    for (int kind = 0; kind < SHAPE_KINDS; kind++) {
        shape_target *t = shape_target_of_solid(&SOLIDS[kind]);
        shape_filling f = shape_fill(t, &(shape_stops){.density = 1.3}, spheres, NULL);
        shape_quality q = shape_quality_of(t, spheres, f.count);
        shape_mass u = shape_union_mass(spheres, f.count);
        print_message("%-15s %4d spheres, density %.2f, volume %.3f, mean deviation %.4f\n",
                      shape_solid_info_of(SOLIDS[kind].kind)->name, f.count, f.density,
                      u.volume / t->mass.volume, q.deviation_mean);
        assert_true(f.met && f.count >= 1);
        CHECK_NEAR(q.protrusion, 0, 1e-8);
        CHECK_BELOW(u.volume, t->mass.volume * (1 + 1e-6));
        if (kind != SHAPE_CONE) CHECK_NEAR(sv_norm(u.centre), 0, 1e-7);
        double largest = u.inertia[0][0];
        for (int k = 0; k < 3; k++) CHECK_NEAR(u.inertia[k][(k + 1) % 3], 0, 1e-6 * largest);
        shape_target_free(t);
    }
}

static void more_is_nearer(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_CYLINDER]);
    double last = HUGE_VAL;
    int count = 0;
    for (double q = 1; q <= 3; q += 0.5) {
        shape_filling f = shape_fill(t, &(shape_stops){.density = q}, spheres, NULL);
        double mean = shape_quality_of(t, spheres, f.count).deviation_mean;
        assert_true(f.met && f.count > count);
        CHECK_BELOW(mean, last);
        /* measured on other samples than those that stopped it */
        CHECK_BELOW(mean, 1.05 * shape_density_deviation(q) * f.inscribed);
        last = mean, count = f.count;
    }
    CHECK_NEAR(shape_fill(t, &(shape_stops){.spheres = 1}, spheres, NULL).inscribed, 0.5, 1e-9);
    shape_target_free(t);
}

static void levels_are_nested_and_repeat(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_BLOCK]);
    shape_filling f = shape_fill(t, &(shape_stops){.spheres = 60}, spheres, level);
    assert_true(f.count <= 60 && f.count > 52); /* orbits have 8 at most */
    shape_filling g = shape_fill(t, &(shape_stops){.spheres = 60}, again, NULL);
    assert_int_equal(f.count, g.count);
    assert_memory_equal(spheres, again, (size_t)f.count * sizeof *spheres);
    int seventh = 0;
    while (level[seventh] < 4) seventh++;
    g = shape_fill(t, &(shape_stops){.spheres = seventh}, again, NULL);
    assert_int_equal(g.count, seventh);
    assert_memory_equal(spheres, again, (size_t)seventh * sizeof *spheres);
    shape_target_free(t);
}

static void other_stops(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_BARREL]);
    shape_filling f = shape_fill(t, &(shape_stops){.deviation = 0.08}, spheres, NULL);
    assert_true(f.met);
    CHECK_BELOW(shape_quality_of(t, spheres, f.count).deviation_max, 0.08);
    f = shape_fill(t, &(shape_stops){.density = 6, .smallest = 0.3}, spheres, NULL);
    for (int i = 0; i < f.count; i++) CHECK_BELOW(0.3, spheres[i].radius);
    assert_false(f.met); /* the rim cannot be reached by such spheres, and it says so */
    f = shape_fill(t, &(shape_stops){.density = 2, .smallest = 1}, spheres, NULL);
    assert_int_equal(f.count, 0);
    shape_target_free(t);
}

static double distance_of(shape_vec p, const shape_sphere *of, int count) {
    double nearest = HUGE_VAL;
    for (int i = 0; i < count; i++)
        nearest = fmin(nearest, sv_distance(p, of[i].centre) - of[i].radius);
    return fmax(nearest, 0);
}

/* Forty thousand places and the corners of the triangles: the filling looked at 1500. */
static double largest_of_many(const shape_target *t, const shape_sphere *of, int count) {
    enum { MANY = 40000 };
    shape_vec *point = malloc(MANY * sizeof *point), *normal = malloc(MANY * sizeof *normal);
    double largest = 0;
    shape_target_samples(t, MANY, point, normal);
    for (int i = 0; i < MANY; i++) largest = fmax(largest, distance_of(point[i], of, count));
    for (size_t i = 0; i < t->surface.vertex_count; i++)
        largest = fmax(largest, distance_of(t->surface.vertex[i], of, count));
    free(point), free(normal);
    return largest;
}

/* The bound is one of every place, so places chosen without it may come near it but not beyond:
 * nothing is allowed for sampling. They miss the worst by no more than their distance from it,
 * which for 40 000 on a surface of 6 size^2 at most is some size / 80. */
static int hold_deviation(shape_target *t, const char *name, double deviation) {
    shape_filling f = shape_fill(t, &(shape_stops){.deviation = deviation}, spheres, level);
    double found = shape_deviation_max(t, spheres, f.count);
    double many = largest_of_many(t, spheres, f.count);
    print_message("%-10s %.3f asked for: %d spheres, %.4f, of many places %.4f\n", name, deviation,
                  f.count, found, many);
    assert_true(f.met);
    CHECK_BELOW(many, deviation);
    CHECK_BELOW(found, deviation);
    CHECK_BELOW(many, found + shape_deviation_error(t, found));
    CHECK_BELOW(found, many + t->size / 80);
    for (int i = 1; i < f.count; i++) assert_in_range(level[i] - level[i - 1], 0, 1);
    return f.count;
}

/* Of the rim of a cylinder about x, which the triangles cut short. */
static double largest_on_rim(double radius, double length, const shape_sphere *of, int count) {
    double largest = 0;
    for (int i = 0; i < 20000; i++) {
        double a = 2 * SHAPE_PI * i / 10000, x = i % 2 ? 0.5 * length : -0.5 * length;
        shape_vec at = {x, radius * cos(a), radius * sin(a)};
        largest = fmax(largest, distance_of(at, of, count));
    }
    return largest;
}

static shape_target *mesh_target(shape_mesh mesh) {
    const char *fault;
    shape_target *t = shape_target_of_mesh(&mesh, &fault);
    assert_non_null(t);
    return t;
}

/* A block, as a solid and as a mesh of twelve triangles; a cylinder, whose rim is no edge of its
 * triangles; a disc with a hole as a mesh, which is not convex. */
static void a_largest_deviation_is_kept(void **state) {
    (void)state;
    const shape_solid block = {SHAPE_BLOCK, {2.0, 1.5, 1.0}};
    const shape_solid cylinder = {SHAPE_CYLINDER, {0.5, 2.0}};
    const shape_solid disc = {SHAPE_DISC, {1.0, 0.5, 0.4}};
    struct {
        const char *name;
        shape_target *target;
    } all[] = {{"block", shape_target_of_solid(&block)},
               {"block mesh", mesh_target(shape_solid_mesh(&block, 1))},
               {"cylinder", shape_target_of_solid(&cylinder)},
               {"disc mesh", mesh_target(shape_solid_mesh(&disc, 1))}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        for (double deviation = 0.2; deviation > 0.04; deviation /= 2) {
            int count = hold_deviation(all[i].target, all[i].name, deviation);
            if (all[i].target->solid.kind != SHAPE_CYLINDER) continue;
            CHECK_BELOW(largest_on_rim(0.5, 2.0, spheres, count), deviation);
        }
        shape_target_free(all[i].target);
    }
}

/* One sphere in a cylinder: the rim is farthest, sqrt(r^2 + l^2 / 4) - r. In a cube: corners. */
static void the_largest_deviation_of_one_sphere(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&(shape_solid){SHAPE_CYLINDER, {0.7, 2.3}});
    const shape_sphere one = {{0, 0, 0}, 0.7};
    double found = shape_deviation_max(t, &one, 1), want = sqrt(0.49 + 2.3 * 2.3 / 4) - 0.7;
    CHECK_NEAR(found, want, shape_deviation_error(t, want));
    shape_target_free(t);
    t = shape_target_of_solid(&(shape_solid){SHAPE_CUBE, {1.3}});
    const shape_sphere half = {{0.05, 0, 0}, 0.6};
    want = sqrt(0.7 * 0.7 + 2 * 0.65 * 0.65) - 0.6;
    CHECK_NEAR(shape_deviation_max(t, &half, 1), want, 1e-14);
    shape_vec place[8];
    assert_int_equal(shape_places_beyond(t, &half, 1, 1.01 * want, place, 8), 0);
    assert_true(shape_places_beyond(t, &half, 1, 0.99 * want, place, 8) > 0);
    CHECK_NEAR(place[0].x, -0.65, 0.2);
    shape_target_free(t);
}

/* Places beyond a deviation are beyond it and spread: those beside one are filled with it. */
static void places_beyond_are_spread(void **state) {
    (void)state;
    enum { ROOM = 64 };
    shape_target *t = shape_target_of_solid(&(shape_solid){SHAPE_BLOCK, {2.0, 1.5, 1.0}});
    const shape_sphere one = {{0, 0, 0}, 0.5};
    const double limit = 0.3;
    shape_vec place[ROOM];
    int count = shape_places_beyond(t, &one, 1, limit, place, ROOM);
    assert_true(count > 8);
    for (int i = 0; i < count; i++) {
        CHECK_BELOW(limit - shape_deviation_error(t, limit), sv_norm(place[i]) - 0.5);
        for (int j = 0; j < i; j++) CHECK_BELOW(limit, sv_distance(place[i], place[j]));
    }
    shape_target_free(t);
}

/* Edges of ten degrees: beyond one of them a sphere may touch the surface from without. */
static void a_wedge_holds_its_spheres(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&(shape_solid){SHAPE_BLOCK, {1.0, 0.35, 2.0}}, 1);
    for (size_t i = 0; i < mesh.vertex_count; i++)
        if (mesh.vertex[i].z > 0) mesh.vertex[i].y *= 0.01;
    shape_target *t = mesh_target(mesh);
    for (double deviation = 0.08; deviation > 0.03; deviation /= 2) {
        shape_filling f = shape_fill(t, &(shape_stops){.deviation = deviation}, spheres, NULL);
        shape_quality q = shape_quality_of(t, spheres, f.count);
        print_message("wedge, %g: %d spheres, off by %.3g, sticks out %.2g\n", deviation, f.count,
                      q.deviation_max, q.protrusion / t->size);
        CHECK_BELOW(q.protrusion, 1.01 * t->slack);
        assert_true(f.met == (q.deviation_max <= deviation));
    }
    shape_target_free(t);
}

/* Less than the search can tell: refused to be called met, and at once. */
static void a_deviation_below_what_can_be_told(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_SPHERE]);
    assert_false(shape_fill(t, &(shape_stops){.deviation = 1e-10}, spheres, NULL).met);
    shape_target_free(t);
}

/* A bound that so few spheres cannot keep is not said to be kept. */
static void a_deviation_that_is_missed(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&(shape_solid){SHAPE_BLOCK, {2.0, 1.5, 1.0}});
    shape_filling f = shape_fill(t, &(shape_stops){.spheres = 20, .deviation = 0.1}, spheres, NULL);
    assert_true(f.count <= 20 && !f.met);
    shape_target_free(t);
}

/* Ten thousand triangles in seconds; spheres inside but for the slack of the facets. */
static void a_mesh_is_filled(void **state) {
    (void)state;
    shape_mesh mesh = shape_solid_mesh(&SOLIDS[SHAPE_ELLIPSOID], 2);
    for (size_t i = 0; i < mesh.vertex_count; i++) { /* a stone: dents in an ellipsoid */
        shape_vec v = mesh.vertex[i];
        double dent = 1 + 0.08 * sin(3 * v.x + 1) * cos(4 * v.y) + 0.05 * sin(5 * v.z);
        mesh.vertex[i] = sv_add(sv_scale(dent, v), sv(3, -1, 2));
    }
    print_message("%zu triangles\n", mesh.triangle_count);
    const char *fault;
    clock_t start = clock();
    shape_target *t = shape_target_of_mesh(&mesh, &fault);
    shape_filling f = shape_fill(t, &(shape_stops){.spheres = 31}, spheres, NULL);
    double seconds = (double)(clock() - start) / CLOCKS_PER_SEC;
    shape_quality q = shape_quality_of(t, spheres, f.count);
    print_message("%d spheres in %.2f s: density %.2f, mean deviation %.2g, sticks out %.2g\n",
                  f.count, seconds, f.density, q.deviation_mean / t->size, q.protrusion / t->size);
    assert_int_equal(f.count, 31);
    CHECK_BELOW(q.protrusion, 1.01 * t->slack);
    CHECK_BELOW(q.deviation_mean, 0.01 * t->size);
    CHECK_BELOW(seconds, 10);
    shape_clump c = shape_clump_of(spheres, f.count, &t->mass, SHAPE_MASS_SOLID);
    CHECK_CLOSE(c.as_union.volume, c.as_solid.volume, 0.1);
    CHECK_BELOW(c.as_union.volume_bound, 1e-6);
    shape_clump_free(&c);
    shape_target_free(t);
}

/* A row of equal spheres in a long cylinder with rounded ends: A00 3.8 knows the angle. The largest
 * of 4000 places misses the bottom of a hollow by little. */
static void the_contact_normal_of_a_row(void **state) {
    (void)state;
    for (int q = 1; q <= 4; q *= 2) {
        int count = 5 * q - q + 1;
        static double at[4000][2];
        int points = 0;
        for (int i = 0; i <= 600; i++, points++) { /* capsule: aspect ratio 5 */
            double a = SHAPE_PI / 2 * i / 600;
            at[points][0] = -4 - cos(a), at[points][1] = sin(a);
        }
        for (int i = 0; i <= 600; i++, points++) {
            double a = SHAPE_PI / 2 * i / 600;
            at[points][0] = 4 + sin(a), at[points][1] = cos(a);
        }
        at[0][1] = at[points - 1][1] = 0;
        shape_target *capsule = shape_target_of_profile(at, points);
        for (int i = 0; i < count; i++)
            spheres[i] = (shape_sphere){{-4 + 8.0 * i / (count - 1), 0, 0}, 1};
        shape_quality of = shape_quality_of(capsule, spheres, count);
        double want = asin(0.5 / q);
        print_message("q = %d: %.2f and %.2f degrees, friction %.3f, mean %.4f\n", q,
                      of.normal_max / DEGREE, of.normal_95 / DEGREE, of.friction,
                      of.deviation_mean);
        CHECK_NEAR(of.normal_max, want, 0.03 * want);
        CHECK_BELOW(of.normal_95, want);
        CHECK_CLOSE(of.friction, tan(0.5 * of.normal_95), 1e-12);
        CHECK_NEAR(of.step, 1 / cbrt(capsule->mass.volume / (4 * SHAPE_PI / 3)), 1e-12);
        shape_target_free(capsule);
    }
}

static void a_sphere_costs_one(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_SPHERE]);
    shape_filling f = shape_fill(t, &(shape_stops){.density = 8}, spheres, NULL);
    assert_int_equal(f.count, 1);
    shape_quality q = shape_quality_of(t, spheres, 1);
    CHECK_NEAR(q.contacts, 1, 0);
    CHECK_NEAR(q.cost, 1, 1e-12);
    CHECK_NEAR(q.normal_max, 0, 1e-7);
    shape_target_free(t);
}

/* A clump of a cone, whose union has its centre elsewhere: each is at rest in its own frame. */
static void clumps_are_centred_by_the_mass_chosen(void **state) {
    (void)state;
    shape_target *t = shape_target_of_solid(&SOLIDS[SHAPE_CONE]);
    shape_filling f = shape_fill(t, &(shape_stops){.density = 1.3}, spheres, NULL);
    shape_clump solid = shape_clump_of(spheres, f.count, &t->mass, SHAPE_MASS_SOLID);
    shape_clump unite = shape_clump_of(spheres, f.count, &t->mass, SHAPE_MASS_UNION);
    CHECK_NEAR(sv_distance(solid.sphere[0].centre, spheres[0].centre), 0, 0);
    assert_true(sv_norm(unite.origin) > 1e-3);
    CHECK_NEAR(sv_norm(shape_union_mass(unite.sphere, f.count).centre), 0, 1e-7);
    CHECK_CLOSE(solid.volume, t->mass.volume, 0);
    CHECK_CLOSE(unite.volume, unite.as_union.volume, 0);
    assert_true(solid.frame.moment[1] == solid.frame.moment[2]);
    shape_clump_free(&solid), shape_clump_free(&unite);
    shape_target_free(t);
}

TEST_MAIN(cmocka_unit_test(every_solid_is_filled), cmocka_unit_test(more_is_nearer),
          cmocka_unit_test(levels_are_nested_and_repeat), cmocka_unit_test(other_stops),
          cmocka_unit_test(a_largest_deviation_is_kept),
          cmocka_unit_test(the_largest_deviation_of_one_sphere),
          cmocka_unit_test(places_beyond_are_spread), cmocka_unit_test(a_wedge_holds_its_spheres),
          cmocka_unit_test(a_deviation_below_what_can_be_told),
          cmocka_unit_test(a_deviation_that_is_missed), cmocka_unit_test(a_mesh_is_filled),
          cmocka_unit_test(the_contact_normal_of_a_row), cmocka_unit_test(a_sphere_costs_one),
          cmocka_unit_test(clumps_are_centred_by_the_mass_chosen))

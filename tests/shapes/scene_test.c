/* Shapes of scenes that are given as a solid, a profile or a mesh, or whose mass is worked out. */
#include "experiments/scene/scene.h"
#include "shapes/clump.h"
#include "shapes/numbers.h"
#include "shapes/solid.h"
#include "tests/support/check.h"

/* A scene of one body of the shape `text`; density 2000. */
static void write_scene(const char *path, const char *text) {
    FILE *f = fopen(path, "w");
    assert_non_null(f);
    fprintf(f,
            "scene: one shape\n"
            "materials: {stone: {density: 2000 kg/m3, young: 5 MPa, poisson: 0.3}}\n"
            "pairs: [{between: [stone, stone], restitution: 0.5, friction: 0.3}]\n"
            "shapes:\n  it: {material: stone, %s}\n"
            "bodies: [{shape: it, position: [0, 0, 0]}]\n"
            "time: {end: 1 ms}\n",
            text);
    assert_int_equal(fclose(f), 0);
}

/* Its shape in the world; *s stays open. Fails with the faults. */
static clast_shape_def load(const char *text, scene **s) {
    scratch_name file = scratch_file("shape.yaml");
    write_scene(file.text, text);
    char *faults = NULL;
    *s = scene_load(file.text, NULL, &faults);
    if (!*s) fail_msg("%s", faults);
    free(faults);
    remove(file.text);
    return clast_world_shape((*s)->world, 0);
}

/* What is said of a scene that cannot be; malloc'ed. */
static char *refused(const char *text) {
    scratch_name file = scratch_file("shape.yaml");
    write_scene(file.text, text);
    char *faults = NULL;
    assert_null(scene_load(file.text, NULL, &faults));
    remove(file.text);
    return faults;
}

static void check_refused(const char *text, const char *want) {
    char *said = refused(text);
    if (!strstr(said, want)) fail_msg("'%s' is missing in: %s", want, said);
    free(said);
}

/* Keys of scenes are the names of shapes/solid.c, in that order. */
static void every_solid_has_its_keys(void **state) {
    (void)state;
    for (int kind = 0; kind < SHAPE_KINDS; kind++) {
        const shape_solid_info *info = shape_solid_info_of((shape_kind)kind);
        shape_solid solid = {(shape_kind)kind, {0.011, 0.009, 0.017}};
        if (kind == SHAPE_BARREL || kind == SHAPE_TORUS) solid.size[0] = 0.006;
        char text[400];
        int used = snprintf(text, sizeof text, "solid: {%s: {", info->name);
        for (int k = 0; k < SHAPE_SIZES && info->sizes[k]; k++)
            used += snprintf(text + used, sizeof text - (size_t)used, "%s%s: %.17g mm",
                             k ? ", " : "", info->sizes[k], 1e3 * solid.size[k]);
        snprintf(text + used, sizeof text - (size_t)used, "}}, fill: {density: 1.1}");
        scene *s;
        clast_shape_def shape = load(text, &s);
        shape_mass want = shape_solid_mass(&solid);
        CHECK_CLOSE(shape.mass, 2000 * want.volume, 1e-12);
        CHECK_CLOSE(shape.inertia.x, 2000 * want.inertia[0][0], 1e-9);
        CHECK_CLOSE(shape.inertia.y, 2000 * want.inertia[1][1], 1e-9);
        CHECK_CLOSE(shape.inertia.z, 2000 * want.inertia[2][2], 1e-9);
        assert_true(shape.spheres >= 1);
        scene_free(s);
    }
}

static void two_overlapping_spheres_by_their_union(void **state) {
    (void)state;
    scene *s;
    clast_shape_def shape = load("mass_from: union, spheres: [{centre: [3 mm, 4 mm, 1 mm], radius: "
                                 "5 mm}, {centre: [3 mm, 4 mm, 7 mm], radius: 5 mm}]",
                                 &s);
    /* two spheres less the lens of two caps of height 2 mm */
    double v = 8 * SHAPE_PI / 3 * 125e-9 - 2 * SHAPE_PI * 4e-6 * (15e-3 - 2e-3) / 3;
    CHECK_CLOSE(shape.mass, 2000 * v, 1e-13);
    CHECK_NEAR(shape.centre[0].z, -3e-3, 1e-15);
    CHECK_NEAR(shape.centre[1].z, 3e-3, 1e-15);
    CHECK_NEAR(shape.centre[0].x, 0, 1e-15);
    assert_non_null(strstr(s->clumps, "it: union "));
    scene_free(s);
}

/* A brick has its own mass, centre and axes wherever its file puts it. */
static void a_mesh_beside_the_same_solid(void **state) {
    (void)state;
    scene *s;
    clast_shape_def shape =
        load("mesh: " SHAPES_FOLDER "/brick.obj, unit: 1 mm, fill: {spheres: 12}", &s);
    CHECK_CLOSE(shape.mass, 2000 * 6e-6, 1e-6);
    CHECK_CLOSE(shape.inertia.x, 0.012 / 12 * (4e-4 + 1e-4), 1e-6);
    CHECK_CLOSE(shape.inertia.y, 0.012 / 12 * (9e-4 + 1e-4), 1e-6);
    CHECK_CLOSE(shape.inertia.z, 0.012 / 12 * (9e-4 + 4e-4), 1e-6);
    assert_int_equal(shape.spheres, 12);
    for (int i = 0; i < 12; i++) {
        CHECK_BELOW(fabs(shape.centre[i].x) + shape.radius[i], 15.1e-3);
        CHECK_BELOW(fabs(shape.centre[i].y) + shape.radius[i], 10.1e-3);
        CHECK_BELOW(fabs(shape.centre[i].z) + shape.radius[i], 5.1e-3);
    }
    scene_free(s);
}

static void levels_of_a_profile(void **state) {
    (void)state;
    for (int level = 1; level <= 3; level++) {
        char text[400];
        snprintf(text, sizeof text,
                 "profile: " SHAPES_FOLDER "/pear.csv, unit: 1 mm, fill: {levels: [3, 7, 15], "
                 "level: %d}, mass_from: union",
                 level);
        scene *s;
        clast_shape_def shape = load(text, &s);
        assert_int_equal(shape.spheres, (1 << (level + 1)) - 1);
        scene_free(s);
    }
}

/* A mass that is given scales the inertia; both given are taken as they are. */
static void a_mass_that_was_weighed(void **state) {
    (void)state;
    scene *s;
    clast_shape_def shape = load("solid: {cube: {edge: 1 cm}}, fill: {density: 1}, mass: 5 g", &s);
    CHECK_CLOSE(shape.mass, 5e-3, 1e-15);
    CHECK_CLOSE(shape.inertia.y, 5e-3 * 1e-4 / 6, 1e-9);
    scene_free(s);
    shape = load("fit: {ellipse: [6.9 mm, 5.3 mm], spheres: 7}, mass_from: solid", &s);
    CHECK_CLOSE(shape.mass, 2000 * 4 * SHAPE_PI / 3 * 6.9e-3 * 5.3e-3 * 5.3e-3, 1e-12);
    CHECK_CLOSE(shape.inertia.x, 0.4 * shape.mass * 5.3e-3 * 5.3e-3, 1e-12);
    scene_free(s);
}

static void the_same_bits_twice(void **state) {
    (void)state;
    scene *a, *b;
    const char *text = "solid: {barrel: {end_radius: 3 mm, middle_radius: 4 mm, length: 1 cm}}, "
                       "mass_from: union";
    clast_shape_def p = load(text, &a), q = load(text, &b);
    assert_int_equal(p.spheres, q.spheres);
    assert_memory_equal(p.centre, q.centre, (size_t)p.spheres * sizeof *p.centre);
    assert_memory_equal(&p.inertia, &q.inertia, sizeof p.inertia);
    scene_free(a), scene_free(b);
}

/* A scene whose shape is `text`, of which something is warned: at line 5, with these words. */
static void check_warned(const char *text, const char *want) {
    scratch_name file = scratch_file("shape.yaml");
    write_scene(file.text, text);
    char *said = NULL;
    scene *s = scene_load(file.text, NULL, &said);
    if (!s || !said) fail_msg("no scene or no warning: %s", said ? said : "");
    if (!strstr(said, want) || !strstr(said, "shape.yaml:5: ")) fail_msg("'%s' in: %s", want, said);
    scene_free(s), free(said), remove(file.text);
}

static void what_is_missed_has_numbers(void **state) {
    (void)state;
    /* one sphere in a cube: the corners are sqrt(3) - 1 half edges off */
    check_warned("solid: {cube: {edge: 2 cm}}, fill: {spheres: 1, deviation: 1 mm}",
                 "not met with 1 spheres: deviation 1 mm asked for, 7.321 mm reached");
    check_warned("solid: {sphere: {radius: 1 cm}}, fill: {deviation: 1 nm}", "cannot be told");
    check_warned("solid: {cube: {edge: 2 cm}}, fill: {spheres: 1, density: 3}",
                 "not met with 1 spheres: packing density 3 asked for, ");
}

static void what_cannot_be_is_refused(void **state) {
    (void)state;
    check_refused("solid: {hyperboloid: {end_radius: 1 mm, waist_radius: 2 mm, length: 1 cm}}",
                  "shapes.it.solid.hyperboloid: found waist_radius above end_radius");
    check_refused("solid: {cone: {radius: 1 mm}}", "shapes.it.solid.cone.length: missing");
    check_refused("solid: {cylindre: {radius: 1 mm}}", "did you mean 'cylinder'?");
    check_refused("solid: {cube: {edge: 1 cm}, sphere: {radius: 1 cm}}", "expected one of the two");
    check_refused("spheres: [{centre: [0, 0, 0], radius: 1 mm}], mass_from: solid",
                  "shapes.it.mass_from: found solid, expected union");
    check_refused("solid: {cube: {edge: 1 cm}}, fill: {levels: [3, 7], level: 3}",
                  "shapes.it.fill.level: found 3, expected at most 2");
    check_refused("solid: {cube: {edge: 1 cm}}, fill: {levels: [3, 7.5]}", "found 7.5, expected");
    check_refused("solid: {cube: {edge: 1 cm}}, fill: {levels: [3], spheres: 4}",
                  "found beside 'spheres'");
    check_refused("solid: {cube: {edge: 1 cm}}, fill: {smallest: 2 cm}",
                  "found no sphere that is large enough");
    check_refused("profile: " SHAPES_FOLDER "/broken.csv", "broken.csv:5: found 'abc' for radius");
    check_refused("mesh: no-such.stl", "shapes.it.mesh: found");
}

TEST_MAIN(cmocka_unit_test(every_solid_has_its_keys),
          cmocka_unit_test(two_overlapping_spheres_by_their_union),
          cmocka_unit_test(a_mesh_beside_the_same_solid), cmocka_unit_test(levels_of_a_profile),
          cmocka_unit_test(a_mass_that_was_weighed), cmocka_unit_test(the_same_bits_twice),
          cmocka_unit_test(what_is_missed_has_numbers), cmocka_unit_test(what_cannot_be_is_refused))

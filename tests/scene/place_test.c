/* place_test.c - bodies placed by generators: no overlap, inside their region, the same bits for a
 * seed. */
#include "tests/scene/testing.h"

#include "experiments/scene/build.h"

enum { SHAPES = 2 };
static const double REACH[SHAPES] = {0.0041, 0.0067};

typedef struct fixture {
    scene_arena arena;
    scene_faults faults;
    scene_reader reader;
    const tree_node *node;
} fixture;

/* Generators look at their node for the line of a fault and for `turn` alone. */
static void fixture_open(fixture *f) {
    static const char TEXT[] = "bodies:\n  - random: {count: 1}\n";
    *f = (fixture){.faults = {.arena = &f->arena, .file = "test.yaml"}};
    const tree_node *root = scene_tree_load(&f->arena, &f->faults, TEXT, strlen(TEXT));
    f->reader = (scene_reader){.arena = &f->arena, .faults = &f->faults, .root = root};
    f->node = root->first->first->first;
}

static crowd crowd_of(uint64_t seed, int plane_axis) {
    return (crowd){.shape_reach = REACH, .plane_axis = plane_axis, .seed = seed};
}

static double coordinate(const crowd *c, int body, int axis) {
    clast_vec3 p = c->bodies[body].position;
    return axis == 0 ? p.x : axis == 1 ? p.y : p.z;
}

static double distance(const crowd *c, int i, int j) {
    double sum = 0;
    for (int axis = 0; axis < 3; axis++) {
        double d = coordinate(c, i, axis) - coordinate(c, j, axis);
        sum += d * d;
    }
    return sqrt(sum);
}

static void no_overlap(const crowd *c, double gap, uint64_t seed) {
    for (int i = 0; i < c->count; i++)
        for (int j = 0; j < i; j++)
            if (distance(c, i, j) < (c->reach[i] + c->reach[j] + gap) * (1 - 1e-12))
                fail_msg("seed %llu: bodies %d and %d", (unsigned long long)seed, i, j);
}

static void inside(const crowd *c, const generator *g) {
    const double low[3] = {g->region_min.x, g->region_min.y, g->region_min.z};
    const double high[3] = {g->region_max.x, g->region_max.y, g->region_max.z};
    for (int i = 0; i < c->count; i++)
        for (int axis = 0; axis < 3; axis++) {
            double margin = low[axis] == high[axis] ? 0 : c->reach[i], x = coordinate(c, i, axis);
            assert_true(x >= low[axis] + margin - 1e-12 && x <= high[axis] - margin + 1e-12);
        }
}

static generator random_generator(int shape, int count, bool layer) {
    return (generator){.shape = shape,
                       .count = count,
                       .region_min = {-0.05, layer ? 0 : -0.04, 0.01},
                       .region_max = {0.06, layer ? 0 : 0.05, 0.13},
                       .gap = 0.0003,
                       .attempts = 5000,
                       .orientation = ORIENT_RANDOM};
}

static void random_bodies_do_not_overlap(void **state) {
    (void)state;
    for (uint64_t seed = 1; seed <= 40; seed++) {
        fixture f;
        fixture_open(&f);
        bool layer = seed % 2;
        crowd c = crowd_of(seed, layer ? 1 : -1);
        generator small = random_generator(0, layer ? 40 : 150, layer);
        generator large = random_generator(1, layer ? 8 : 40, layer);
        scene_place_random(&f.reader, &c, f.node, &small, 0);
        scene_place_random(&f.reader, &c, f.node, &large, 1);
        assert_int_equal(f.faults.errors, 0);
        assert_int_equal(c.count, small.count + large.count);
        no_overlap(&c, small.gap, seed);
        inside(&c, &small);
        crowd_free(&c);
        scene_arena_free(&f.arena);
    }
}

static void same_seed_same_bits(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    crowd a = crowd_of(9, -1), b = crowd_of(9, -1), other = crowd_of(10, -1);
    generator g = random_generator(0, 100, false);
    scene_place_random(&f.reader, &a, f.node, &g, 3);
    scene_place_random(&f.reader, &b, f.node, &g, 3);
    scene_place_random(&f.reader, &other, f.node, &g, 3);
    assert_int_equal(a.count, 100);
    for (int i = 0; i < a.count; i++) {
        assert_memory_equal(&a.bodies[i].position, &b.bodies[i].position, sizeof(clast_vec3));
        assert_memory_equal(&a.bodies[i].orientation, &b.bodies[i].orientation, sizeof(clast_quat));
        assert_true(a.bodies[i].position.x != other.bodies[i].position.x);
    }
    crowd_free(&a);
    crowd_free(&b);
    crowd_free(&other);
    scene_arena_free(&f.arena);
}

/* On the rotation group each matrix entry has mean 0 and mean square 1/3. */
static void random_rotations_are_uniform(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    crowd c = crowd_of(4, -1);
    generator g = {.shape = 0,
                   .count = 20000,
                   .region_max = {1, 1, 1},
                   .spacing = {0.02, 0.02, 0.02},
                   .orientation = ORIENT_RANDOM};
    scene_place_grid(&f.reader, &c, f.node, &g, 0);
    assert_int_equal(c.count, g.count);
    double sum[4] = {0}, square[4] = {0};
    for (int i = 0; i < c.count; i++) {
        clast_quat q = c.bodies[i].orientation;
        assert_true(fabs(q.w * q.w + q.x * q.x + q.y * q.y + q.z * q.z - 1) < 1e-14);
        double entry[4] = {1 - 2 * (q.y * q.y + q.z * q.z), 2 * (q.x * q.y - q.w * q.z),
                           2 * (q.x * q.z + q.w * q.y), 1 - 2 * (q.x * q.x + q.y * q.y)};
        for (int k = 0; k < 4; k++) {
            sum[k] += entry[k];
            square[k] += entry[k] * entry[k];
        }
    }
    for (int k = 0; k < 4; k++) { /* five standard errors */
        assert_true(fabs(sum[k] / c.count) < 5 * sqrt(1 / 3.0 / c.count));
        assert_true(fabs(square[k] / c.count - 1 / 3.0) < 5 * 0.3 / sqrt(c.count));
    }
    crowd_free(&c);
    scene_arena_free(&f.arena);
}

static void in_plane_bodies_turn_about_the_normal(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    crowd c = crowd_of(4, 1);
    generator g = random_generator(1, 12, true);
    scene_place_random(&f.reader, &c, f.node, &g, 0);
    for (int i = 0; i < c.count; i++)
        assert_true(c.bodies[i].orientation.x == 0 && c.bodies[i].orientation.z == 0);
    assert_true(c.bodies[0].orientation.y != c.bodies[1].orientation.y);
    crowd_free(&c);
    scene_arena_free(&f.arena);
}

static void jitter_keeps_bodies_apart(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    crowd c = crowd_of(11, -1);
    generator g = {.shape = 1,
                   .region_min = {0, 0, 0},
                   .region_max = {0.1, 0.08, 0.07},
                   .spacing = {0.015, 0.0137, 0.016},
                   .jitter = 1,
                   .orientation = ORIENT_RANDOM};
    scene_place_grid(&f.reader, &c, f.node, &g, 0);
    assert_int_equal(f.faults.errors, 0);
    assert_int_equal(c.count, 6 * 5 * 4);
    no_overlap(&c, 0, 11);
    inside(&c, &g);
    crowd_free(&c);
    scene_arena_free(&f.arena);
}

static void hexagonal_is_the_closest_packing(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    generator g = {.shape = 0, .spacing = {2 * REACH[0], 0, 0}, .region_max = {0.2, 0.2, 0.2}};
    crowd c = crowd_of(1, -1);
    scene_place_hexagonal(&f.reader, &c, f.node, &g, 0);
    no_overlap(&c, -1e-12, 1);
    inside(&c, &g);
    double solid = c.count * 4.0 / 3 * 3.14159265 * REACH[0] * REACH[0] * REACH[0] / 0.008;
    assert_true(solid > 0.66 && solid < 0.7405); /* 0.7405 without faces */
    crowd_free(&c);
    g.region_min.y = g.region_max.y = 0.1;
    c = crowd_of(1, 1);
    scene_place_hexagonal(&f.reader, &c, f.node, &g, 0);
    no_overlap(&c, -1e-12, 1);
    assert_true(c.count * 3.14159265 * REACH[0] * REACH[0] / 0.04 > 0.84); /* 0.907 without edges */
    crowd_free(&c);
    scene_arena_free(&f.arena);
}

static void what_does_not_fit_is_a_fault(void **state) {
    (void)state;
    fixture f;
    fixture_open(&f);
    crowd c = crowd_of(1, -1);
    generator g = random_generator(1, 5000, false);
    scene_place_random(&f.reader, &c, f.node, &g, 0);
    assert_int_equal(f.faults.errors, 1);
    char *text = scene_faults_text(&f.faults), expected[100];
    snprintf(expected, sizeof expected, "placed %d of 5000", c.count);
    assert_non_null(strstr(text, expected));
    free(text);
    crowd_free(&c);
    scene_arena_free(&f.arena);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(random_bodies_do_not_overlap),
        cmocka_unit_test(same_seed_same_bits),
        cmocka_unit_test(random_rotations_are_uniform),
        cmocka_unit_test(in_plane_bodies_turn_about_the_normal),
        cmocka_unit_test(jitter_keeps_bodies_apart),
        cmocka_unit_test(hexagonal_is_the_closest_packing),
        cmocka_unit_test(what_does_not_fit_is_a_fault),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

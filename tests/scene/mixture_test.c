/* mixture_test.c - shapes and sizes mixed: counts that are exact, distributions that are kept, and
 * an order that only the seed decides. */
#include "tests/scene/testing.h"

#include <gsl/gsl_cdf.h>

#include "experiments/scene/build.h"
#include "experiments/scene/scene.h"

static const char MIXTURE[] = CLAST_SCENES "/mixture.yaml";

enum { EVEN, BELL, SKEWED, CUT, COUNTED, SIEVED, ENTRIES, EACH_COUNT = 400, MIXED = 333 };
enum { ROD = 6, BEAD, MARBLE, SHAPES }; /* in the order of the scene */
static const char *const NAMES[SHAPES] = {"even",   "bell", "skewed", "cut",   "counted",
                                          "sieved", "rod",  "bead",   "marble"};

static scene *load(const char *path, const char *set, bool prepare) {
    char *faults = NULL;
    scene_options options = {.set = &set, .set_count = set ? 1 : 0, .parse_only = !prepare};
    scene *s = scene_load(path, &options, &faults);
    if (!s || faults) fail_msg("%s", faults ? faults : "no scene, no faults");
    return s;
}

/* What a body is and how large, by id. */
typedef struct sized {
    int kind; /* in NAMES */
    double scale, mass, reach;
} sized;

static int kind_of(const char *name) {
    for (int i = 0; i < SHAPES; i++) {
        size_t length = strlen(NAMES[i]);
        if (!strncmp(name, NAMES[i], length) && (name[length] == '*' || !name[length])) return i;
    }
    fail_msg("no shape %s", name);
    return -1;
}

static sized *take(const scene *s, size_t *count) {
    clast_bodies b = clast_world_bodies(s->world);
    sized *out = calloc(b.count, sizeof *out);
    assert_non_null(out);
    for (size_t i = 0; i < b.count; i++) {
        clast_shape_def d = clast_world_shape(s->world, b.shape[i]);
        sized *one = &out[b.id[i]];
        one->kind = kind_of(d.name);
        double whole = one->kind == BEAD ? 0.7e-3 : one->kind == MARBLE ? 2.1e-3 : 1e-3;
        one->scale = d.radius[0] / whole;
        one->mass = d.mass;
        one->reach = fabs(d.centre[0].x) + d.radius[0];
    }
    *count = b.count;
    return out;
}

/* ---- sizes ----------------------------------------------------------------------------------- */

typedef double below_fn(double size);

static double even_below(double size) {
    return (size - 0.6) / (1.3 - 0.6);
}

static double bell_below(double size) {
    double low = gsl_cdf_gaussian_P(0.5 - 1, 0.2), high = gsl_cdf_gaussian_P(1.4 - 1, 0.2);
    return (gsl_cdf_gaussian_P(size - 1, 0.2) - low) / (high - low);
}

static double skewed_below(double size) {
    return gsl_cdf_lognormal_P(size, log(0.8), log(1.3));
}

static double cut_below(double size) {
    double low = skewed_below(0.7), high = skewed_below(1.2);
    return (skewed_below(size) - low) / (high - low);
}

static double between(const double (*rows)[2], int count, double size) {
    for (int i = 1; i < count; i++)
        if (size <= rows[i][0])
            return rows[i - 1][1] + (rows[i][1] - rows[i - 1][1]) * (size - rows[i - 1][0]) /
                                        (rows[i][0] - rows[i - 1][0]);
    return 1;
}

static double counted_below(double size) {
    static const double ROWS[5][2] = {{0.5, 0}, {0.7, 0.1}, {0.8, 0.55}, {1.2, 0.9}, {1.5, 1}};
    return between(ROWS, 5, size);
}

static int ascending(const void *a, const void *b) {
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Largest distance between the share of the sample and that of the distribution (Kolmogorov and
 * Smirnov). */
static double distance(const double *sorted, int n, below_fn *below) {
    double most = 0;
    for (int i = 0; i < n; i++) {
        double share = below(sorted[i]);
        most = fmax(most, fmax(fabs(share - (double)i / n), fabs(share - (i + 1.0) / n)));
    }
    return most;
}

/* 40 classes of 10 bodies each: a step of 1/40 with the curve through its middle. */
static void sizes_follow_their_distribution(void **state) {
    (void)state;
    static below_fn *const BELOW[] = {even_below, bell_below, skewed_below, cut_below,
                                      counted_below};
    scene *s = load(MIXTURE, NULL, false);
    size_t count;
    sized *bodies = take(s, &count);
    for (int e = EVEN; e <= COUNTED; e++) {
        double scale[EACH_COUNT];
        for (int i = 0; i < EACH_COUNT; i++) {
            assert_int_equal(bodies[e * EACH_COUNT + i].kind, e);
            scale[i] = bodies[e * EACH_COUNT + i].scale;
        }
        qsort(scale, EACH_COUNT, sizeof *scale, ascending);
        double d = distance(scale, EACH_COUNT, BELOW[e]);
        print_message("%s: distance %.7f\n", NAMES[e], d);
        assert_true(fabs(d - 1 / 80.0) < 1e-6);
    }
    free(bodies);
    scene_free(s);
}

/* Of 400 classes, one for each body: the mass below a row is off by one body at most. */
static void a_grading_curve_by_mass(void **state) {
    (void)state;
    static const double ROWS[4][2] = {{0.5, 0}, {0.8, 0.3}, {0.9, 0.3}, {1.25, 1}};
    scene *s = load(MIXTURE, NULL, false);
    size_t count;
    sized *bodies = take(s, &count);
    const sized *sieved = &bodies[SIEVED * EACH_COUNT];
    double all = 0, heaviest = 0;
    for (int i = 0; i < EACH_COUNT; i++) {
        all += sieved[i].mass;
        heaviest = fmax(heaviest, sieved[i].mass);
        assert_true(sieved[i].scale < 0.8 || sieved[i].scale > 0.9);
    }
    for (double size = 0.5; size <= 1.25; size += 0.025) {
        double below = 0;
        for (int i = 0; i < EACH_COUNT; i++)
            if (sieved[i].scale <= size) below += sieved[i].mass;
        assert_true(fabs(below / all - between(ROWS, 4, size)) < heaviest / all);
    }
    free(bodies);
    scene_free(s);
}

/* A body 1.1 times as large weighs 1.1^3 and turns as hard as 1.1^5 of it. */
static void classes_are_scaled_bodies(void **state) {
    (void)state;
    scene *s = load(MIXTURE, NULL, false);
    int seen = 0;
    for (int i = 0; i < clast_world_shape_count(s->world); i++) {
        clast_shape_def d = clast_world_shape(s->world, i);
        if (kind_of(d.name) != ROD) continue;
        double k = d.radius[0] / 1e-3, wanted = 0.5 + 0.6 * (seen + 0.5) / 7;
        assert_true(fabs(k - wanted) < 1e-12);
        assert_true(fabs(d.centre[1].x - k * 0.9e-3) < 1e-15);
        assert_true(fabs(d.mass / 20e-6 - k * k * k) < 1e-12);
        assert_true(fabs(d.inertia.x / 10e-9 - k * k * k * k * k) < 1e-9);
        assert_true(fabs(d.inertia.y / 30e-9 - k * k * k * k * k) < 1e-9);
        assert_true(fabs(d.outline[0] - k * 2e-3) < 1e-15);
        seen++;
    }
    assert_int_equal(seen, 7);
    scene_free(s);
}

/* ---- mixtures -------------------------------------------------------------------------------- */

/* 61, 25 and 14 % of 333 are 203.13, 83.25 and 46.62: the last has the largest remainder. */
static void numbers_are_exact(void **state) {
    (void)state;
    static const char *const SEEDS[] = {"seed=3", "seed=4", "seed=5"};
    for (int k = 0; k < 3; k++) {
        scene *s = load(MIXTURE, SEEDS[k], false);
        size_t count;
        sized *bodies = take(s, &count);
        int kinds[SHAPES] = {0}, classes[8] = {0};
        for (int i = ENTRIES * EACH_COUNT; i < ENTRIES * EACH_COUNT + MIXED; i++) {
            kinds[bodies[i].kind]++;
            if (bodies[i].kind == ROD) classes[(int)((bodies[i].scale - 0.5) * 7 / 0.6)]++;
        }
        assert_int_equal(kinds[BEAD], 203);
        assert_int_equal(kinds[ROD], 83);
        assert_int_equal(kinds[MARBLE], 47);
        for (int c = 0; c < 7; c++) assert_true(classes[c] == 11 || classes[c] == 12);
        free(bodies);
        scene_free(s);
    }
}

static void masses_are_kept_to_a_body(void **state) {
    (void)state;
    scene *s = load(MIXTURE, NULL, false);
    size_t count;
    sized *bodies = take(s, &count);
    double mass[SHAPES] = {0}, all = 0, heaviest[SHAPES] = {0};
    for (size_t i = ENTRIES * EACH_COUNT + MIXED; i < count; i++) {
        mass[bodies[i].kind] += bodies[i].mass;
        heaviest[bodies[i].kind] = fmax(heaviest[bodies[i].kind], bodies[i].mass);
        all += bodies[i].mass;
    }
    double one = fmax(heaviest[MARBLE], heaviest[ROD]) / all;
    assert_true(all > 0 && one < 0.002);
    assert_true(fabs(mass[BEAD] / all - 0.2) < one);
    assert_true(fabs(mass[ROD] / all - 0.5) < one);
    assert_true(fabs(mass[MARBLE] / all - 0.3) < one);
    free(bodies);
    scene_free(s);
}

static void random_places_large_bodies_first(void **state) {
    (void)state;
    scene *s = load(MIXTURE, NULL, false);
    size_t count;
    sized *bodies = take(s, &count);
    for (int i = ENTRIES * EACH_COUNT + 1; i < ENTRIES * EACH_COUNT + MIXED; i++)
        assert_true(bodies[i].reach <= bodies[i - 1].reach);
    clast_bodies b = clast_world_bodies(s->world);
    for (size_t i = 0; i < b.count; i++)
        for (size_t j = 0; j < i; j++) {
            double dx = b.x[i] - b.x[j], dy = b.y[i] - b.y[j], dz = b.z[i] - b.z[j];
            double apart = bodies[b.id[i]].reach + bodies[b.id[j]].reach;
            assert_true(dx * dx + dy * dy + dz * dz > apart * apart * (1 - 1e-12));
        }
    free(bodies);
    scene_free(s);
}

/* Runs of bodies above or below the median in the order of the grid (Wald and Wolfowitz): for 400
 * of them 201 +- 10 in a random order. */
static int runs_of(const sized *bodies, double median) {
    int runs = 1;
    for (int i = 1; i < EACH_COUNT; i++)
        runs += (bodies[i].scale > median) != (bodies[i - 1].scale > median);
    return runs;
}

static void a_grid_is_shuffled_by_the_seed(void **state) {
    (void)state;
    size_t count;
    scene *s = load(MIXTURE, NULL, false), *again = load(MIXTURE, NULL, false);
    scene *other = load(MIXTURE, "seed=4", false);
    sized *a = take(s, &count), *b = take(again, &count), *c = take(other, &count);
    int runs = runs_of(a, 0.95), moved = 0;
    print_message("%d runs\n", runs);
    assert_true(runs > 201 - 40 && runs < 201 + 40);
    for (int i = 0; i < EACH_COUNT; i++) {
        assert_true(a[i].scale == b[i].scale);
        moved += a[i].scale != c[i].scale;
    }
    assert_true(moved > EACH_COUNT / 2);
    free(a), free(b), free(c);
    scene_free(s), scene_free(again), scene_free(other);
}

/* Sizes belong to shapes so that a scene which goes on from a run knows its templates. */
static void bodies_of_many_sizes_are_inherited(void **state) {
    (void)state;
    static const char CHECKPOINT[] = CLAST_SCENE_SCRATCH "/mixture.h5";
    static const char PATH[] = CLAST_SCENE_SCRATCH "/goes-on.yaml";
    scene *first = load(MIXTURE, NULL, true);
    assert_int_equal(clast_checkpoint_save(first->world, CHECKPOINT, NULL), CLAST_OK);
    char *text = read_all(MIXTURE, NULL), *bodies = strstr(text, "bodies:\n");
    char *rest = strstr(text, "seed: $seed");
    assert_true(bodies && rest);
    char whole[8000];
    snprintf(whole, sizeof whole, "%.*sbodies: [{from: %s}]\n%s", (int)(bodies - text), text,
             CHECKPOINT, rest);
    for (char *at = strstr(whole, "table: "); at; at = strstr(at + 1, "table: ")) {
        char *name = at + strlen("table: "), moved[8000];
        snprintf(moved, sizeof moved, "%s", name);
        snprintf(name, sizeof whole - (size_t)(name - whole), "%s/%s", CLAST_SCENES, moved);
    }
    write_all(PATH, whole, strlen(whole));
    scene *second = load(PATH, NULL, true);
    size_t had, has;
    sized *before = take(first, &had), *after = take(second, &has);
    assert_int_equal(has, had);
    assert_true(had > 3000);
    assert_memory_equal(before, after, had * sizeof *before);
    free(before), free(after), free(text);
    scene_free(first), scene_free(second);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(sizes_follow_their_distribution),
        cmocka_unit_test(a_grading_curve_by_mass),
        cmocka_unit_test(classes_are_scaled_bodies),
        cmocka_unit_test(numbers_are_exact),
        cmocka_unit_test(masses_are_kept_to_a_body),
        cmocka_unit_test(random_places_large_bodies_first),
        cmocka_unit_test(a_grid_is_shuffled_by_the_seed),
        cmocka_unit_test(bodies_of_many_sizes_are_inherited),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

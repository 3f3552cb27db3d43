/* mutation_test.c - a good scene with bytes deleted, swapped, doubled and replaced always ends with
 * faults or with a scene: it never crashes and never hangs. Run it with the sanitizers on (preset
 * asan). CLAST_MUTATIONS and CLAST_SEED in the environment ask for more and for others.
 */
#include "tests/scene/testing.h"

#include "experiments/scene/scene.h"

#include <time.h>

static uint64_t state_of_random;

static uint64_t next(uint64_t below) {
    state_of_random =
        state_of_random * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    return (state_of_random >> 33) % below;
}

/* One change at a random place; `text` has room for 64 bytes more. */
static void mutate(char *text, size_t *length) {
    static const char SIGNS[] = "{}[]:,-#&*!|>'\"%@`$ \n\t0123456789.eE+/^()mskgPaN~?\xff\xc3";
    size_t at = next(*length), span = 1 + next(next(4) ? 4 : 40);
    if (span > *length - at) span = *length - at;
    switch (next(5)) {
    case 0: /* delete */
        memmove(text + at, text + at + span, *length - at - span);
        *length -= span;
        break;
    case 1: /* double */
        memmove(text + at + span, text + at, *length - at);
        *length += span;
        break;
    case 2: { /* swap two bytes */
        size_t other = next(*length);
        char c = text[at];
        text[at] = text[other];
        text[other] = c;
        break;
    }
    case 3:
        text[at] = SIGNS[next(sizeof SIGNS - 1)];
        break;
    default: /* insert */
        memmove(text + at + 1, text + at, *length - at);
        text[at] = SIGNS[next(sizeof SIGNS - 1)];
        ++*length;
    }
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static long from_environment(const char *name, long otherwise) {
    const char *text = getenv(name);
    return text ? strtol(text, NULL, 10) : otherwise;
}

/* True when the damaged scene still made a world. */
static bool load_damaged(const char *path, long number) {
    char *faults = NULL;
    double start = seconds();
    scene *s = scene_load(path, NULL, &faults);
    if (!s && !faults) fail_msg("mutation %ld: neither a scene nor a fault (%s)", number, path);
    if (seconds() - start > 20)
        fail_msg("mutation %ld took %g s (%s)", number, seconds() - start, path);
    bool good = s != NULL;
    scene_free(s);
    free(faults);
    return good;
}

/* Damages one file of the two and loads the scene, many times. */
static void damage(const char *victim, long count) {
    long good = 0, seed = from_environment("CLAST_SEED", 1984);
    char scene_path[] = CLAST_SCENE_SCRATCH "/damaged.yaml";
    char csv_path[] = CLAST_SCENE_SCRATCH "/start.csv";
    size_t lengths[2];
    char *texts[2] = {read_all(CLAST_SCENES "/good.yaml", &lengths[0]),
                      read_all(CLAST_SCENES "/start.csv", &lengths[1])};
    write_all(scene_path, texts[0], lengths[0]);
    write_all(csv_path, texts[1], lengths[1]);
    size_t length;
    char *grading = read_all(CLAST_SCENES "/grading-mass.csv", &length);
    write_all(CLAST_SCENE_SCRATCH "/grading-mass.csv", grading, length);
    free(grading);
    int which = strcmp(victim, "scene") ? 1 : 0;
    char *damaged = malloc(lengths[which] + 1000);
    assert_non_null(damaged);
    state_of_random = (uint64_t)seed;
    print_message("seed %ld, %ld mutations of the %s\n", seed, count, victim);
    for (long n = 0; n < count; n++) {
        size_t now = lengths[which];
        memcpy(damaged, texts[which], now);
        for (uint64_t changes = 1 + next(next(3) ? 1 : 8); changes > 0; changes--)
            mutate(damaged, &now);
        write_all(which ? csv_path : scene_path, damaged, now);
        good += load_damaged(scene_path, n);
    }
    print_message("%ld of them still made a scene\n", good);
    assert_true(good > 0 && good < count);
    free(damaged);
    free(texts[0]);
    free(texts[1]);
}

static void damaged_scenes_end_in_faults_or_a_scene(void **state) {
    (void)state;
    damage("scene", from_environment("CLAST_MUTATIONS", 1000));
}

static void damaged_tables_end_in_faults_or_a_scene(void **state) {
    (void)state;
    damage("table", from_environment("CLAST_MUTATIONS", 1000) / 3);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(damaged_scenes_end_in_faults_or_a_scene),
        cmocka_unit_test(damaged_tables_end_in_faults_or_a_scene),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* mutation_test.c - a good scene with bytes deleted, swapped, doubled and replaced always ends with
 * faults or with a scene: it never crashes and never hangs. Run it with the sanitizers on (preset
 * asan). CLAST_MUTATIONS and CLAST_SEED in the environment ask for more and for others.
 */
#include "tests/scene/testing.h"

#include "experiments/scene/scene.h"

#include <time.h>
#include <unistd.h>

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

static void damaged_scenes_end_in_faults_or_a_scene(void **state) {
    (void)state;
    long count = from_environment("CLAST_MUTATIONS", 1500), good = 0;
    long seed = from_environment("CLAST_SEED", 1984);
    size_t length;
    char *scene_text = read_all(CLAST_SCENES "/good.yaml", &length);
    char *csv = read_all(CLAST_SCENES "/start.csv", NULL), path[500];
    print_message("seed %ld, %ld mutations\n", seed, count);
    write_all(CLAST_SCENE_SCRATCH "/start.csv", csv, strlen(csv));
    snprintf(path, sizeof path, "%s/damaged-%ld.yaml", CLAST_SCENE_SCRATCH, (long)getpid());
    char *damaged = malloc(length + 1000);
    assert_non_null(damaged);
    state_of_random = (uint64_t)seed;
    for (long n = 0; n < count; n++) {
        size_t now = length;
        memcpy(damaged, scene_text, length);
        for (uint64_t changes = 1 + next(next(3) ? 1 : 8); changes > 0; changes--)
            mutate(damaged, &now);
        write_all(path, damaged, now);
        good += load_damaged(path, n);
    }
    print_message("%ld of them still made a scene\n", good);
    assert_true(good > 0 && good < count);
    remove(path);
    free(damaged);
    free(csv);
    free(scene_text);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(damaged_scenes_end_in_faults_or_a_scene)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* test_jobs.c - runs are cached by name: what makes another run makes another name. */
#include <string.h>

#include "experiments/study/jobs.h"
#include "tests/support/check.h"

static const char SCENE[] = CLAST_STUDIES "/grate-rtd/packing.yaml"; /* any file */

static void name(job *j, const char *setting) {
    *j = (job){.scene = SCENE};
    strcpy(j->label, "run");
    job_set(j, "%s", setting);
    jobs_name(j, "/root");
}

static bool same(const char *a, const char *b) {
    static job first, second;
    name(&first, a), name(&second, b);
    return !strcmp(first.folder, second.folder);
}

/* A unit with a slash is no path. */
static void every_part_of_a_value_counts(void **state) {
    (void)state;
    assert_true(same("rate=20 kg/h", "rate=20 kg/h"));
    assert_false(same("rate=20 kg/h", "rate=40 kg/h"));
    assert_false(same("rate=20 kg/h", "other=20 kg/h"));
    assert_false(same("step=1 ms", "step=2 ms"));
}

/* The last part of a path has the hash of what is in it. */
static void a_build_folder_may_move(void **state) {
    (void)state;
    assert_true(same("bed=/here/runs/bed-1234", "bed=/there/bed-1234"));
    assert_false(same("bed=/here/runs/bed-1234", "bed=/here/runs/bed-1235"));
    assert_false(same("bed=/here/bed-1234", "base=/here/bed-1234"));
}

TEST_MAIN(cmocka_unit_test(every_part_of_a_value_counts), cmocka_unit_test(a_build_folder_may_move))

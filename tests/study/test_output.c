/* Folders, tables and the exit code of a study. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "experiments/study/output.h"

static void folders_are_made(void **state) {
    (void)state;
    study_folders to = study_folders_below(CLAST_STUDY_SCRATCH "/output", "hopper", STUDY_BRIEF);
    assert_string_equal(to.runs, CLAST_STUDY_SCRATCH "/output/studies/hopper/runs");
    assert_string_equal(to.data, CLAST_STUDY_SCRATCH "/output/studies/hopper/brief/data");
    assert_string_equal(to.frames, CLAST_STUDY_SCRATCH "/output/studies/hopper/brief/frames");
    assert_string_equal(to.verdicts, CLAST_STUDY_SCRATCH "/output/validate/hopper.csv");
    assert_int_equal(access(to.runs, W_OK) | access(to.data, W_OK) | access(to.frames, W_OK), 0);
    assert_int_equal(access(CLAST_STUDY_SCRATCH "/output/validate", W_OK), 0);
    study_folders again = study_folders_below(CLAST_STUDY_SCRATCH "/output", "hopper", STUDY_BRIEF);
    assert_string_equal(again.runs, to.runs);
}

static void a_table_has_its_header(void **state) {
    (void)state;
    char line[80];
    FILE *f = output_table(CLAST_STUDY_SCRATCH, "table.csv", "a,b");
    assert_non_null(f);
    fputs("1,2\n", f);
    assert_int_equal(output_close(f), 0);
    f = fopen(CLAST_STUDY_SCRATCH "/table.csv", "r");
    assert_non_null(f);
    assert_non_null(fgets(line, sizeof line, f));
    assert_string_equal(line, "a,b\n");
    fclose(f);
    assert_null(output_table(CLAST_STUDY_SCRATCH "/nowhere", "table.csv", "a,b"));
}

static void what_is_bad_counts_before_runs_that_failed(void **state) {
    (void)state;
    assert_int_equal(study_end("hopper", 0, 0), 0);
    assert_int_equal(study_end("hopper", 3, 0), 1);
    assert_int_equal(study_end("hopper", 3, 4), 4);
    assert_int_equal(study_end("hopper", 0, 1), 1);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(folders_are_made),
        cmocka_unit_test(a_table_has_its_header),
        cmocka_unit_test(what_is_bad_counts_before_runs_that_failed),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

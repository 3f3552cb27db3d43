/* Tables that grow row by row, the reader of tables, schedules, and files that appear whole or not.
 */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "engine/hdf5_io.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "experiments/run/schedule.h"
#include "experiments/run/table.h"
#include "tests/run/fixture.h"

static char *folder;

static void write_rows(table *t, uint64_t from, uint64_t to) {
    for (uint64_t step = from; step < to; step++) {
        table_begin(t, 0.1 * (double)step, step);
        table_number(t, sqrt((double)step));
        table_number(t, step % 3 ? (double)step : (double)NAN);
        table_end(t);
    }
}

static bool before(uint64_t step, const void *context) {
    return step < *(const uint64_t *)context;
}

static void tables_come_back_to_the_bit(void **state) {
    (void)state;
    char *path = path_in(folder, "t.csv"), why[RESULTS_ERROR_MAX];
    table t;
    table_create(&t, path, "time_s,step,root,third");
    write_rows(&t, 0, 300);
    table_close(&t);
    assert_int_equal(t.failure, 0);
    csv *c = csv_read(path, why);
    assert_non_null(c);
    assert_int_equal(c->rows, 300);
    assert_int_equal(c->columns, 4);
    const double *root = csv_column(c, "root"), *third = csv_column(c, "third");
    for (size_t i = 0; i < 300; i++) {
        assert_true(root[i] == sqrt((double)i));
        assert_true(i % 3 ? third[i] == (double)i : third[i] != third[i]);
    }
    assert_null(csv_column(c, "roo"));
    csv_free(c);
    free(path);
}

static void a_continued_table_equals_an_unbroken_one(void **state) {
    (void)state;
    char *whole = path_in(folder, "whole.csv"), *broken = path_in(folder, "broken.csv");
    table t;
    table_create(&t, whole, "time_s,step,root,third");
    write_rows(&t, 0, 50);
    table_close(&t);
    table_create(&t, broken, "time_s,step,root,third");
    write_rows(&t, 0, 37);
    table_close(&t);
    FILE *f = fopen(broken, "a");
    assert_non_null(f);
    fputs("3.7,37,6.0", f); /* killed while writing */
    fclose(f);
    uint64_t limit = 20;
    table_continue(&t, broken, "time_s,step,root,third", before, &limit);
    assert_int_equal(t.failure, 0);
    write_rows(&t, 20, 50);
    table_close(&t);
    size_t n, m;
    char *a = slurp(whole, &n), *b = slurp(broken, &m);
    assert_int_equal(n, m);
    assert_memory_equal(a, b, n);
    table_continue(&t, broken, "time_s,step,other", before, &limit);
    assert_int_equal(t.failure, EINVAL);
    table_close(&t);
    free(a), free(b), free(whole), free(broken);
}

static void a_full_device_is_an_error(void **state) {
    (void)state;
    if (access("/dev/full", W_OK) != 0) skip();
    table t;
    table_create(&t, "/dev/full", "time_s,step");
    assert_int_equal(t.failure, ENOSPC);
    write_rows(&t, 0, 3);
    table_close(&t);
    assert_int_equal(t.failure, ENOSPC);
}

static void schedules_depend_on_the_step_alone(void **state) {
    (void)state;
    static const schedule all[] = {
        {0.01, 1.3e-5}, {0.1, 0.03}, {0.002, 0.002}, {1e-5, 3e-5}, {0.25, 0.1}};
    for (size_t s = 0; s < sizeof all / sizeof *all; s++) {
        int64_t index = -1;
        for (uint64_t step = 0; step < 5000; step++) {
            uint64_t next = schedule_next(&all[s], step);
            assert_true(next > step);
            assert_true(schedule_is_due(&all[s], next));
            for (uint64_t between = step + 1; between < next; between++)
                assert_false(schedule_is_due(&all[s], between));
            if (!schedule_is_due(&all[s], step)) continue;
            int64_t k = schedule_index(&all[s], step);
            assert_true(k > index);
            assert_true(fabs((double)k * all[s].every - (double)step * all[s].dt) <=
                        0.5001 * all[s].dt);
            index = k;
        }
    }
    schedule never = {0, 0.1};
    assert_false(schedule_is_due(&never, 0));
    assert_true(schedule_next(&never, 5) == SCHEDULE_NEVER);
}

static void arrays_come_back_from_hdf5(void **state) {
    (void)state;
    char *path = path_in(folder, "a.h5");
    enum { N = 30000 };
    double *d = malloc(N * sizeof *d);
    for (int i = 0; i < N; i++) d[i] = sin(i);
    uint64_t big = UINT64_MAX;
    h5_file *f = h5_create(path);
    h5_write(f, "/deep/down/d", H5_F64, 2, (size_t[]){N / 3, 3}, d);
    h5_write_column(f, "/u", H5_U64, 1, &big);
    h5_write_column(f, "/nothing", H5_I32, 0, d);
    h5_write_text(f, "/text", "two\nlines");
    h5_attribute_text(f, "/deep", "name", "caf\xc3\xa9");
    h5_attribute_u64(f, "/", "big", big);
    assert_int_equal(h5_publish(f), CLAST_OK);
    h5_free(f);
    f = h5_open(path);
    double *back = malloc(N * sizeof *back);
    h5_read(f, "/deep/down/d", H5_F64, N, back);
    assert_memory_equal(d, back, N * sizeof *d);
    size_t extent[H5_RANK_MAX];
    assert_int_equal(h5_extent(f, "/deep/down/d", extent), 2);
    assert_int_equal(extent[0], N / 3);
    assert_int_equal(h5_count(f, "/nothing"), 0);
    char *text = h5_read_text(f, "/text"), *name = h5_text_attribute(f, "/deep", "name");
    assert_string_equal(text, "two\nlines");
    assert_string_equal(name, "caf\xc3\xa9");
    assert_true(h5_u64_attribute(f, "/", "big") == big);
    assert_false(h5_has(f, "/deep/up/d"));
    assert_int_equal(h5_status(f), CLAST_OK);
    h5_read(f, "/u", H5_U64, 2, back);
    assert_int_equal(h5_status(f), CLAST_ERR_FORMAT);
    assert_non_null(strstr(h5_error(f), "'/u' holds 1 numbers, expected 2"));
    h5_free(f);
    free(text), free(name), free(d), free(back), free(path);
}

/* A file that is not published leaves no trace, and the old one as it was. */
static void an_unpublished_file_leaves_no_trace(void **state) {
    (void)state;
    char *path = path_in(folder, "old.h5"), *temporary = path_in(folder, "old.h5.tmp");
    for (int round = 0; round < 2; round++) {
        h5_file *f = h5_create(path);
        h5_attribute_u64(f, "/", "round", (uint64_t)round);
        assert_true(path_exists(temporary));
        if (round == 0) assert_int_equal(h5_publish(f), CLAST_OK);
        h5_free(f);
        assert_false(path_exists(temporary));
    }
    h5_file *f = h5_open(path);
    assert_true(h5_u64_attribute(f, "/", "round") == 0);
    h5_free(f);
    f = h5_create("/nowhere/at/all.h5");
    assert_int_equal(h5_publish(f), CLAST_ERR_WRITE);
    assert_non_null(strstr(h5_error(f), "/nowhere/at/all.h5"));
    assert_non_null(strstr(h5_error(f), "No such file or directory"));
    h5_free(f);
    free(path), free(temporary);
}

static int begin(void **state) {
    (void)state;
    folder = test_folder("table");
    return 0;
}

static int end(void **state) {
    (void)state;
    remove_folder(folder);
    free(folder);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(tables_come_back_to_the_bit),
        cmocka_unit_test(a_continued_table_equals_an_unbroken_one),
        cmocka_unit_test(a_full_device_is_an_error),
        cmocka_unit_test(schedules_depend_on_the_step_alone),
        cmocka_unit_test(arrays_come_back_from_hdf5),
        cmocka_unit_test(an_unpublished_file_leaves_no_trace),
    };
    return cmocka_run_group_tests(tests, begin, end);
}

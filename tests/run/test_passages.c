/* Who came and who went: the tables of a run against its series, and read back. */
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <setjmp.h>
#include <cmocka.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/hdf5_io.h"
#include "experiments/run/folder.h"
#include "experiments/run/passage.h"
#include "experiments/run/results.h"
#include "experiments/run/run.h"
#include "tests/run/fixture.h"

static char *folder;

static transits *read_table(const char *name) {
    char why[RESULTS_ERROR_MAX], *path = path_in(folder, name);
    transits *t = transits_read(path, why);
    if (!t) fail_msg("%s", why);
    free(path);
    return t;
}

static double sum_until(const transits *t, double time) {
    double kg = 0;
    for (size_t i = 0; i < t->count && t->time[i] <= time + 1e-12; i++) kg += t->mass[i];
    return kg;
}

static void masses_balance_in_every_row(void **state) {
    (void)state;
    char why[RESULTS_ERROR_MAX];
    results *r = results_open(folder, why);
    if (!r) fail_msg("%s", why);
    transits *in = read_table(FILE_FEEDS), *out = read_table(FILE_OUTLETS);
    const double *time = results_series(r, "time_s"), *fed = results_series(r, "fed_kg");
    const double *left = results_series(r, "out_kg"), *inside = results_series(r, "inside_kg");
    assert_true(time && fed && left && inside && in->count > 20 && out->count > 5);
    double began = inside[0];
    for (size_t i = 0; i < results_rows(r); i++) {
        assert_true(fabs(began + fed[i] - left[i] - inside[i]) < 1e-15);
        assert_true(fabs(fed[i] - sum_until(in, time[i])) < 1e-15);
        assert_true(fabs(left[i] - sum_until(out, time[i])) < 1e-15);
    }
    transits_free(in), transits_free(out);
    results_free(r);
}

static void records_say_who_and_what(void **state) {
    (void)state;
    transits *in = read_table(FILE_FEEDS), *out = read_table(FILE_OUTLETS);
    size_t domain = 0, fed = 0;
    for (size_t i = 0; i < in->count; i++) {
        assert_int_equal(in->id[i], 24 + i);
        assert_string_equal(in->gate[i], "rain");
        bool ball = !strcmp(in->shape[i], "ball");
        assert_true(ball || !strcmp(in->shape[i], "dumb-bell"));
        /* one sphere: its own; two: of their mass and density */
        double want = ball ? 0.012 : cbrt(6 * 1.1e-3 / (3.14159265358979323846 * 1200));
        assert_true(fabs(in->diameter[i] - want) < 1e-15);
    }
    for (size_t i = 0; i < out->count; i++) {
        domain += !strcmp(out->gate[i], "domain");
        for (size_t k = 0; k < in->count; k++) {
            if (in->id[k] != out->id[i]) continue;
            fed++;
            assert_true(in->time[k] < out->time[i] && in->mass[k] == out->mass[i]);
            assert_string_equal(in->shape[k], out->shape[i]);
        }
        assert_true(i == 0 || out->step[i] >= out->step[i - 1]);
    }
    assert_true(domain < out->count);
    print_message("%zu came, %zu left (%zu by the domain), %zu of these had come\n", in->count,
                  out->count, domain, fed);
    transits_free(in), transits_free(out);
}

static void the_archive_has_them_too(void **state) {
    (void)state;
    char *path = path_in(folder, FILE_RUN);
    h5_file *f = h5_open(path);
    transits *in = read_table(FILE_FEEDS);
    assert_int_equal(h5_count(f, "/feeds/id"), in->count);
    uint32_t *id = malloc(in->count * sizeof *id);
    double *time = malloc(in->count * sizeof *time);
    h5_read(f, "/feeds/id", H5_U32, in->count, id);
    h5_read(f, "/feeds/time_s", H5_F64, in->count, time);
    assert_memory_equal(id, in->id, in->count * sizeof *id);
    assert_memory_equal(time, in->time, in->count * sizeof *time);
    assert_true(h5_has(f, "/outlets/gate") && h5_status(f) == CLAST_OK);
    free(id), free(time), free(path);
    transits_free(in);
    h5_free(f);
}

static void put(const char *name, const char *text) {
    char *path = path_in(folder, name);
    assert_int_equal(file_write_text(path, text), 0);
    free(path);
}

static void broken_tables_are_told(void **state) {
    (void)state;
    char why[RESULTS_ERROR_MAX], *path = path_in(folder, "t.csv");
    assert_null(transits_read(path, why));
    put("t.csv", "id,time_s\n");
    assert_null(transits_read(path, why));
    assert_non_null(strstr(why, "t.csv:1: found 'id,time_s', expected"));
    put("t.csv", FEEDS_HEADER "\n0.1,3,1,f,s,1,2\n0.1,3,one,f,s,1,2\n");
    assert_null(transits_read(path, why));
    assert_non_null(strstr(why, "t.csv:3: found '0.1,3,one"));
    put("t.csv", FEEDS_HEADER "\n0.1,3,1,f,s,1,2\n0.1,3,2,f,s,1"); /* killed while it wrote */
    transits *t = transits_read(path, why);
    assert_true(t && t->count == 1 && t->id[0] == 1 && t->diameter[0] == 2);
    transits_free(t);
    free(path);
}

static int set_up(void **state) {
    (void)state;
    folder = test_folder("passages");
    scene *s = bed_scene(&(bed_options){.latest = 0.45});
    run_report r = run_scene(s, &(run_options){.out = folder, .force = true, .talk = RUN_SILENT});
    bed_free(s);
    if (r.end != RUN_DONE) print_error("%s\n", r.message);
    return r.end == RUN_DONE ? 0 : -1;
}

static int tear_down(void **state) {
    (void)state;
    remove_folder(folder);
    free(folder);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(masses_balance_in_every_row),
                                       cmocka_unit_test(records_say_who_and_what),
                                       cmocka_unit_test(the_archive_has_them_too),
                                       cmocka_unit_test(broken_tables_are_told)};
    return cmocka_run_group_tests(tests, set_up, tear_down);
}

/* Observables by name, and their values on a table made by hand. argv[2] is the folder of this
 * file. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>
#include <string.h>

#include "experiments/run/folder.h"
#include "experiments/tune/observable.h"

static const char *sources;

static scene *bounce(void) {
    char *path = path_in(sources, "bounce.yaml"), *faults = NULL;
    scene *s = scene_load(path, NULL, &faults);
    assert_non_null(s);
    free(faults);
    free(path);
    return s;
}

static void expect_refused(const scene *s, const char *name, const char *why) {
    observable o;
    char *message = observable_find(&o, s, name);
    assert_non_null(message);
    assert_non_null(strstr(message, why));
    assert_non_null(strstr(message, "\n  out.kg\n")); /* what there is */
    assert_non_null(strstr(message, "\n  left.count\n"));
    free(message);
}

static void names(void **state) {
    (void)state;
    scene *s = bounce();
    observable o;
    assert_null(observable_find(&o, s, "out.kg"));
    assert_string_equal(o.name, "out.kg:rate");
    assert_string_equal(o.column, "out_kg");
    assert_null(observable_find(&o, s, "left.count"));
    assert_string_equal(o.name, "left.count:final");
    assert_null(observable_find(&o, s, "left.kg:mean"));
    assert_int_equal(o.how, REDUCE_MEAN);
    expect_refused(s, "out", "expected MEASURE.COLUMN");
    expect_refused(s, "in.kg", "expected MEASURE.COLUMN");
    expect_refused(s, "out.k", "column");
    expect_refused(s, "out.kg:median", "reduction");
    expect_refused(s, "left.kg:rate", "discharged alone");
    scene_free(s);
}

enum { ROWS = 11 };

static void values(void **state) {
    (void)state;
    double t[ROWS], x[ROWS], empty[ROWS];
    for (int i = 0; i < ROWS; i++) {
        t[i] = 0.5 + 0.1 * i;
        x[i] = i < 3 ? 0 : i < 8 ? 0.7 * (i - 2) : 3.5; /* waits, flows at 7 per s, has stopped */
        empty[i] = i % 2 ? NAN : x[i];
    }
    char *columns[] = {"time_s", "out_kg", "band_mean"};
    double *all[] = {t, x, empty};
    csv series = {.rows = ROWS, .columns = 3, .names = columns, .values = all};
    observable o = {.column = "out_kg", .how = REDUCE_FINAL};
    assert_true(observable_reduce(&o, &series) == 3.5);
    o.how = REDUCE_MEAN; /* rows 5 to 10: 2.1, 2.8, 3.5 four times */
    assert_true(fabs(observable_reduce(&o, &series) - (2.1 + 2.8 + 4 * 3.5) / 6) < 1e-14);
    o.how = REDUCE_RATE;
    assert_true(fabs(observable_reduce(&o, &series) - 7) < 0.35); /* r2 0.99 takes in an end */
    strcpy(o.column, "band_mean");
    o.how = REDUCE_MEAN; /* rows 6, 8, 10 */
    assert_true(fabs(observable_reduce(&o, &series) - (2.8 + 3.5 + 3.5) / 3) < 1e-14);
    strcpy(o.column, "none");
    assert_true(isnan(observable_reduce(&o, &series)));
    series.rows = 0;
    strcpy(o.column, "out_kg");
    assert_true(isnan(observable_reduce(&o, &series)));
}

int main(int argc, char **argv) {
    if (argc != 3) return 2;
    sources = argv[2];
    const struct CMUnitTest tests[] = {cmocka_unit_test(names), cmocka_unit_test(values)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* Verdicts: each kind of tolerance on both sides of its bound, the printed table, the file, the
 * exit code. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "experiments/study/verdict.h"

static const tolerance NONE = {TOLERANCE_NONE, 0, false};
static const tolerance NEAR = {TOLERANCE_MEAN, 0.02, false};
static const tolerance TENTH = {TOLERANCE_MEAN, 10.8, true};
static const tolerance EQUAL = {TOLERANCE_EQUAL, 0.02, false};
static const tolerance MOST = {TOLERANCE_AT_MOST, 10.8, false};
static const tolerance LEAST = {TOLERANCE_AT_LEAST, 1, false};

static interval five(double mean, double sd) {
    return (interval){mean, sd, 2.776 * sd / sqrt(5), 5};
}

static void decisions(void **state) {
    (void)state;
    static const struct {
        double target, mean, sd;
        const tolerance *allowed;
        verdict want;
    } cases[] = {
        {0.39, 0.37, 0.0161, &NEAR, VERDICT_MET},  /* on the bound, ± 0.01999 */
        {0.39, 0.37, 0.0162, &NEAR, VERDICT_OPEN}, /* ± 0.02011: wider than what is allowed */
        {0.39, 0.39, 0.5, &NEAR, VERDICT_OPEN},    /* on the target, and shows nothing */
        {0.39, 0.3699, 0, &NEAR, VERDICT_MISSED},
        {0.39, 0.36, 0.0161, &NEAR, VERDICT_MISSED}, /* narrow enough: the mean decides, here too */
        {0.39, 0.36, 0.0162, &NEAR, VERDICT_OPEN},   /* reaches inside */
        {0.39, 0.349, 0.0162, &NEAR,
         VERDICT_MISSED}, /* up to 0.3691: wide, and all of it outside */
        {-0.409, -0.46, 0.1, &TENTH, VERDICT_OPEN},
        {0.39, 0.411, 0, &NEAR, VERDICT_MISSED},
        {-0.409, -0.409 * 1.108, 0, &TENTH, VERDICT_MET}, /* per cent of a negative target */
        {-0.409, -0.409 * 1.109, 0, &TENTH, VERDICT_MISSED},
        {0.84, 0.837, 0.011, &EQUAL, VERDICT_MET},
        {0.84, 0.837, 0.030, &EQUAL, VERDICT_MISSED}, /* near, but not shown */
        {0.84, 0.80, 0.001, &EQUAL, VERDICT_MISSED},
        {NAN, 10.8, 0, &MOST, VERDICT_MET},
        {10.8, 10.81, 0, &MOST, VERDICT_MISSED},
        {NAN, 9.5, 1, &MOST, VERDICT_MET},    /* 9.5 + 1.24 */
        {NAN, 9.7, 1, &MOST, VERDICT_MISSED}, /* 9.7 + 1.24: the mean alone would do */
        {NAN, 1, 0, &LEAST, VERDICT_MET},
        {NAN, 0.9, 0, &LEAST, VERDICT_MISSED},
        {NAN, 2.3, 1, &LEAST, VERDICT_MET},
        {NAN, 2.2, 1, &LEAST, VERDICT_MISSED},
        {0.39, NAN, NAN, &NEAR, VERDICT_MISSED}, /* every run blocked */
        {NAN, 0.39, 0.01, &NEAR, VERDICT_NOT_COMPARABLE},
        {0.39, 0.39, 0.01, &NONE, VERDICT_NOT_COMPARABLE},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        verdict got =
            verdict_of(cases[i].target, five(cases[i].mean, cases[i].sd), *cases[i].allowed, true);
        if (got != cases[i].want) fail_msg("case %d: %d", (int)i, (int)got);
    }
    assert_int_equal(verdict_of(1, five(1, 0.1), NEAR, false), VERDICT_NOT_COMPARABLE);
    /* one run has no interval: it is compared as it is */
    assert_int_equal(verdict_of(NAN, interval_exact(1), LEAST, true), VERDICT_MET);
    assert_int_equal(verdict_of(1, interval_exact(1), EQUAL, true),
                     VERDICT_MISSED); /* one run shows nothing */
}

static void text_of(double mean, double half, int n, const char *want) {
    interval x = {mean, NAN, half, n};
    char got[64];
    interval_text(&x, got, sizeof got);
    assert_string_equal(got, want);
}

static void intervals_as_text(void **state) {
    (void)state;
    text_of(103.7512, 4.136, 5, "103.8 ± 4.1");
    text_of(0.390123, 0.01219, 5, "0.390 ± 0.012");
    text_of(-0.2341, 0.1, 5, "-0.23 ± 0.10");
    text_of(1234.5, 321.9, 3, "1234 ± 322");
    text_of(0.84, 0, 3, "0.840 ± 0.000");
    text_of(0.79123, NAN, 1, "0.7912 (n = 1)");
    text_of(0.0213, NAN, 0, "0.0213"); /* a P has no samples */
    text_of(NAN, NAN, 0, "none");
}

static char *slurp(FILE *f) {
    static char text[4096];
    rewind(f);
    text[fread(text, 1, sizeof text - 1, f)] = '\0';
    return text;
}

static int finish(const verdict_table *v, const char *csv, char **printed) {
    FILE *out = tmpfile();
    assert_non_null(out);
    int code = verdict_finish(v, csv, out);
    *printed = slurp(out);
    fclose(out);
    return code;
}

static void table_file_and_code(void **state) {
    (void)state;
    const char *csv = CLAST_STUDY_SCRATCH "/deep/down/hopper.csv";
    char *printed;
    verdict_table *v = verdict_new("hopper");
    verdict_add(v, "rate", "g/s", 103.75, 108.96, five(101.3, 3.1), TENTH, true);
    verdict_add(v, "kd, by eye", "cm", 0.89, NAN, interval_exact(0.7), NONE, true);
    assert_int_equal(finish(v, csv, &printed), 0);
    assert_string_equal(
        printed, "quantity        ours (95 %)  experiment  thesis  tolerance  verdict\n"
                 "rate, g/s       101.3 ± 3.8      103.75  108.96  ± 10.8 %   met\n"
                 "kd, by eye, cm  0.7 (n = 1)        0.89       -             not comparable\n"
                 "hopper: 1 of 1 met\n");
    FILE *f = fopen(csv, "r");
    assert_non_null(f);
    assert_string_equal(
        slurp(f),
        "quantity,published,ours,tolerance,verdict,unit,half,sd,n,experiment,thesis,source\n"
        "rate,103.75,101.3,10.8 %,met,g/s,3.84854,3.1,5,103.75,108.96,\n"
        "\"kd, by eye\",0.89,0.7,,not comparable,cm,,,1,0.89,,\n");
    fclose(f);
    verdict_add(v, "C", "1/cm", 0.39, 0.386, five(NAN, NAN), NEAR, true);
    assert_int_equal(finish(v, csv, &printed), 1);
    assert_non_null(strstr(printed, "hopper: 1 of 2 met\n"));
    verdict_add(v, "B", "d", 1.02, NAN, five(1.08, 0.4), (tolerance){TOLERANCE_MEAN, 0.4, false},
                true);
    assert_int_equal(finish(v, csv, &printed), 1);
    assert_non_null(strstr(printed, "hopper: 1 of 3 met, 1 open\n"));
    verdict_free(v);
}

/* Too few runs are no failure and no success. */
static void open_rows(void **state) {
    (void)state;
    char *printed;
    verdict_table *v = verdict_new("open");
    verdict_add(v, "B", "d", 1.02, NAN, five(1.08, 0.4), NEAR, true);
    assert_int_equal(finish(v, CLAST_STUDY_SCRATCH "/open.csv", &printed), 1);
    assert_non_null(strstr(printed, "open: 0 of 1 met, 1 open\n"));
    verdict_add(v, "C", "1/cm", 0.39, 0.386, five(0.38, 0.001), NEAR, true);
    assert_int_equal(finish(v, CLAST_STUDY_SCRATCH "/open.csv", &printed), 0);
    assert_non_null(strstr(printed, "open: 1 of 2 met, 1 open\n"));
    verdict_free(v);
}

static void nothing_counted_is_not_success(void **state) {
    (void)state;
    char *printed;
    verdict_table *v = verdict_new("empty");
    assert_int_equal(finish(v, CLAST_STUDY_SCRATCH "/empty.csv", &printed), 1);
    assert_non_null(strstr(printed, "empty: 0 of 0 met\n"));
    verdict_free(v);
}

/* A file where a folder should be: the earlier file stays, no draft is left. */
static void unwritable(void **state) {
    (void)state;
    char *printed;
    verdict_table *v = verdict_new("hopper");
    verdict_add(v, "C", "1/cm", 0.39, 0.386, interval_exact(0.39), NEAR, true);
    assert_int_equal(finish(v, CLAST_STUDY_SCRATCH "/plain.csv", &printed), 0);
    assert_int_equal(finish(v, CLAST_STUDY_SCRATCH "/plain.csv/hopper.csv", &printed), 4);
    assert_int_equal(access(CLAST_STUDY_SCRATCH "/plain.csv", R_OK), 0);
    assert_int_not_equal(access(CLAST_STUDY_SCRATCH "/plain.csv.part", F_OK), 0);
    verdict_free(v);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(decisions),           cmocka_unit_test(intervals_as_text),
        cmocka_unit_test(table_file_and_code), cmocka_unit_test(nothing_counted_is_not_success),
        cmocka_unit_test(unwritable),          cmocka_unit_test(open_rows),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

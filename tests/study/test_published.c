/* published.csv: the real one, and damaged ones with the message each must give. */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "experiments/study/published.h"

#define HEADING "quantity,unit,experiment,thesis,tolerance,source,note\n"

static const char *const SCRATCH = CLAST_STUDY_SCRATCH "/published.csv";

static published_table *read_text(const char *text, char why[PUBLISHED_ERROR_MAX]) {
    FILE *f = fopen(SCRATCH, "w");
    assert_non_null(f);
    fputs(text, f);
    fclose(f);
    why[0] = '\0';
    return published_read(SCRATCH, why);
}

static void numbers_of_the_button_hopper(void **state) {
    (void)state;
    char why[PUBLISHED_ERROR_MAX] = "";
    published_table *t = published_read(CLAST_STUDIES "/button-hopper/published.csv", why);
    if (!t) fail_msg("%s", why);
    const published *q = published_find(t, "rate at 6.5 cm"), *rest;
    assert_non_null(q);
    assert_true(q->experiment == 76.84 && q->thesis == 56.72);
    assert_true(q->tolerance.kind == TOLERANCE_MEAN && q->tolerance.percent);
    assert_true(q->tolerance.value == 10.8);
    rest = published_find(t, "solid fraction at rest frictionless fill");
    assert_non_null(rest);
    assert_true(isnan(rest->experiment) && published_target(rest) == 0.84);
    assert_null(published_find(t, "rate at 7 cm"));
    for (int i = 0; i < t->count; i++)
        if (strncmp(t->rows[i].source, "A00 ", 4) != 0) fail_msg("%s: source", t->rows[i].quantity);
    published_free(t);
}

static void quotes_comments_and_ends_of_lines(void **state) {
    (void)state;
    char why[PUBLISHED_ERROR_MAX];
    published_table *t = read_text("# a comment, with a comma\n" HEADING
                                   "\n\"a, \"\"b\"\"\",cm,1.5,,,\"x, y\",\"\"\r\n"
                                   "c,,,-2e-3,equal 5 %,s,n",
                                   why);
    if (!t) fail_msg("%s", why);
    assert_int_equal(t->count, 2);
    assert_string_equal(t->rows[0].quantity, "a, \"b\"");
    assert_string_equal(t->rows[0].source, "x, y");
    assert_string_equal(t->rows[0].note, "");
    assert_true(t->rows[0].experiment == 1.5 && isnan(t->rows[0].thesis));
    assert_true(published_target(&t->rows[1]) == -2e-3);
    assert_true(t->rows[1].tolerance.kind == TOLERANCE_EQUAL && t->rows[1].tolerance.value == 5);
    published_free(t);
}

static void damaged_files(void **state) {
    (void)state;
    static const struct {
        const char *text, *says;
    } cases[] = {
        {"", "no quantities"},
        {HEADING, "no quantities"},
        {"quantity,unit\n", ":1: found 2 columns"},
        {"quantity,unit,experiment,theses,tolerance,source,note\n",
         "found 'theses', expected 'thesis'"},
        {HEADING "a,cm,1,2,3,s\n", ":2: found 6 fields, expected 7"},
        {HEADING "a,cm,1,2,3,s,n,\n", "found 8 fields"},
        {HEADING ",cm,1,2,3,s,n\n", "quantity: found nothing"},
        {HEADING "a,cm,1,2,3,s,n\na,cm,1,2,3,s,n\n", ":3: quantity: 'a' is there already"},
        {HEADING "a,cm,1.x,2,3,s,n\n", "experiment: found '1.x'"},
        {HEADING "a,cm,1,nan,3,s,n\n", "thesis: found 'nan'"},
        {HEADING "a,cm,1,2,-3,s,n\n", "tolerance: found '-3'"},
        {HEADING "a,cm,1,2,5%,s,n\n", "tolerance: found '5%'"},
        {HEADING "a,cm,1,2,at most 5 %,s,n\n", "tolerance: found 'at most 5 %'"},
        {HEADING "a,cm,1,2,about 5,s,n\n", "tolerance: found 'about 5'"},
        {HEADING "a,cm,1,2,3,,n\n", "source: found nothing"},
        {HEADING "a,cm,1,2,3,s,\n", "note: found nothing"},
        {HEADING "a,cm,,,3,s,n\n", "without an experiment or a thesis value"},
        {HEADING "a,cm,1,2,3,\"s,n\n", "a quote is not closed"},
        {HEADING "a,cm,1,2,3,\"s\"t,n\n", "a quote is not closed, or"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char why[PUBLISHED_ERROR_MAX];
        assert_null(read_text(cases[i].text, why));
        if (!strstr(why, cases[i].says)) fail_msg("case %d says: %s", (int)i, why);
        assert_true(strncmp(why, SCRATCH, strlen(SCRATCH)) == 0);
    }
    char why[PUBLISHED_ERROR_MAX];
    assert_null(published_read(CLAST_STUDY_SCRATCH "/no/such/file.csv", why));
    assert_non_null(strstr(why, "No such file"));
}

static void tolerances_there_and_back(void **state) {
    (void)state;
    static const char *const texts[] = {"",          "0.02",       "10.8 %",    "equal 0.05",
                                        "equal 5 %", "at most 10", "at least 1"};
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        tolerance t;
        char back[64];
        assert_true(tolerance_parse(texts[i], &t));
        tolerance_text(&t, back, sizeof back);
        assert_string_equal(back, texts[i]);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(numbers_of_the_button_hopper),
        cmocka_unit_test(quotes_comments_and_ends_of_lines),
        cmocka_unit_test(damaged_files),
        cmocka_unit_test(tolerances_there_and_back),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}

/* The table of what features are worth: its text, what is built in, and how it is quoted. */
#include "tests/support/check.h"

#include "experiments/scene-needs/study.h"

static const char GOOD[] = NEEDS_HEADER
    "\n"
    "heap,angle of repose,tangential history,contact.tangent: "
    "viscous,-0.312,-0.35,-0.274,0.98,0.02,12,0\n"
    "heap,angle of repose,double precision,precision: mixed,0.004,-0.01,0.018,0.9,0.03,12,0\n"
    "silo,discharge rate,tangential history,contact.tangent: "
    "viscous,0.012,0.003,0.021,0.97,0.01,11,0\n"
    "heap,angle of repose,friction,friction: 0,nan,nan,nan,0.7,0.02,1,11\n";

static void a_table_is_read(void **state) {
    (void)state;
    char error[NEEDS_ERROR_MAX];
    need_table *t = needs_parse(GOOD, error);
    assert_non_null(t);
    assert_int_equal(t->count, 4);
    assert_string_equal(t->rows[2].study, "silo");
    assert_string_equal(t->rows[2].observable, "discharge rate");
    assert_int_equal(t->rows[2].feature, NEED_HISTORY);
    assert_string_equal(t->rows[1].without, "precision: mixed");
    CHECK_NEAR(t->rows[0].error, -0.312, 0);
    CHECK_NEAR(t->rows[0].error_low, -0.35, 0);
    CHECK_NEAR(t->rows[0].cost, 0.98, 0);
    assert_true(isnan(t->rows[3].error));
    assert_int_equal(t->rows[3].lost, 11);
    assert_int_equal(t->rows[3].replicates, 1);
    needs_free(t);
}

static void refuses(const char *body, const char *says) {
    char text[1000], error[NEEDS_ERROR_MAX];
    snprintf(text, sizeof text, "%s\n%s\n", NEEDS_HEADER, body);
    assert_null(needs_parse(text, error));
    if (!strstr(error, says)) fail_msg("'%s' does not say '%s'", error, says);
}

static void a_broken_table_is_refused(void **state) {
    (void)state;
    char error[NEEDS_ERROR_MAX];
    assert_null(needs_parse("study,error\n", error));
    assert_non_null(strstr(error, "line 1: found 'study,error', expected the header"));
    refuses("heap,angle,rotation,x,0.1,0,0.2,1,0.1,12", "line 2: found 10 fields, expected 11");
    refuses("heap,angle,gravity,x,0.1,0,0.2,1,0.1,12,0", "found 'gravity', expected a switch");
    refuses("heap,angle,rotation,x,much,0,0.2,1,0.1,12,0", "found 'much', expected a number");
    refuses("heap,angle,rotation,x,0.3,0,0.2,1,0.1,12,0", "an error outside its interval");
    refuses("heap,angle,rotation,x,0.1,0,0.2,1,0.1,1.5,0", "found '1.5', expected a whole number");
    refuses(",angle,rotation,x,0.1,0,0.2,1,0.1,12,0", "expected a text");
}

/* ---- quoting --------------------------------------------------------------------------------- */

enum { QUOTE_ROOM = 4000 };

static void quote(const need_table *t, const bool uses[NEED_FEATURES], char text[QUOTE_ROOM]) {
    FILE *to = fmemopen(text, QUOTE_ROOM, "w");
    assert_non_null(to);
    text[0] = '\0';
    needs_quote(t, uses, to);
    assert_int_equal(fclose(to), 0);
}

static void what_is_used_is_quoted(void **state) {
    (void)state;
    char error[NEEDS_ERROR_MAX], text[QUOTE_ROOM];
    need_table *t = needs_parse(GOOD, error);
    bool uses[NEED_FEATURES] = {[NEED_HISTORY] = true,
                                [NEED_FRICTION] = true,
                                [NEED_ROLLING] = true,
                                [NEED_PRECISION] = true};
    quote(t, uses, text);
    assert_non_null(strstr(text, "nothing of it is carried over to this scene"));
    const char *body = strstr(text, "):\n") + 3;
    assert_string_equal(
        body, "  tangential history\n"
              "    with contact.tangent: viscous:\n"
              "      heap, angle of repose: -31.2 ± 3.8 % (12 pairs), at 0.98 of the cost\n"
              "      silo, discharge rate: +1.20 ± 0.90 % (11 pairs), at 0.97 of the cost\n"
              "  friction\n"
              "    with friction: 0:\n"
              "      heap, angle of repose: none in 11 of 12 runs, at 0.70 of the cost\n"
              "  double precision\n"
              "    with precision: mixed:\n"
              "      heap, angle of repose: +0.4 ± 1.4 % (12 pairs, not told from 0), at 0.90 "
              "of the cost\n");
    needs_free(t);
}

static void nothing_is_said_of_what_is_not_there(void **state) {
    (void)state;
    char error[NEEDS_ERROR_MAX];
    need_table *t = needs_parse(GOOD, error);
    const bool none[NEED_FEATURES] = {false}, unmeasured[NEED_FEATURES] = {[NEED_ROLLING] = true};
    char text[QUOTE_ROOM], again[QUOTE_ROOM];
    quote(t, none, text);
    quote(t, unmeasured, again);
    assert_string_equal(text, "");
    assert_string_equal(again, "");
    needs_free(t);
}

/* ---- what is built in ------------------------------------------------------------------------ */

static const need *row_of(const need_table *t, const needs_scene *s, int observable, int k) {
    const need *found = NULL;
    for (int i = 0; i < t->count; i++) {
        const need *n = &t->rows[i];
        bool same =
            !strcmp(n->study, s->name) && !strcmp(n->observable, s->observable[observable].name) &&
            n->feature == s->without[k].feature && !strcmp(n->without, s->without[k].without);
        assert_true(!same || !found);
        if (same) found = n;
    }
    return found;
}

/* Every row of the study as it is now, measured with enough pairs, and no other. */
static void the_table_that_is_built_in_is_that_of_the_study(void **state) {
    (void)state;
    need_table *t = needs_measured();
    int rows = 0;
    for (int i = 0; i < SCENES_COUNT; i++)
        for (int o = 0; o < NEEDS_SCENES[i].observables; o++)
            for (int k = 0; k < NEEDS_SCENES[i].switches; k++, rows++) {
                const need *n = row_of(t, &NEEDS_SCENES[i], o, k);
                if (!n)
                    fail_msg("no row of %s without %s", NEEDS_SCENES[i].name,
                             NEEDS_SCENES[i].without[k].key);
                assert_true(n->replicates + n->lost >= 6);
                assert_true(n->cost > 0 && n->cost_half >= 0);
                assert_true(isfinite(n->error) == (n->lost == 0));
            }
    assert_int_equal(t->count, rows);
    needs_free(t);
}

TEST_MAIN(cmocka_unit_test(a_table_is_read), cmocka_unit_test(a_broken_table_is_refused),
          cmocka_unit_test(what_is_used_is_quoted),
          cmocka_unit_test(nothing_is_said_of_what_is_not_there),
          cmocka_unit_test(the_table_that_is_built_in_is_that_of_the_study))

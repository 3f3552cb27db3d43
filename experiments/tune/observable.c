#include "experiments/tune/observable.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/run/measure.h"
#include "experiments/study/statistics.h"

#define LINEAR_R2 0.99 /* of the linear part, as the button hopper reads its rates */

static const char *const REDUCTIONS[] = {"final", "mean", "rate"};
enum { REDUCTION_COUNT = sizeof REDUCTIONS / sizeof *REDUCTIONS };

const char *reduction_name(reduction how) {
    CLAST_ASSERT((int)how >= 0 && (int)how < REDUCTION_COUNT);
    return REDUCTIONS[how];
}

/* ---- names ----------------------------------------------------------------------------------- */

/* The columns of one measure, ",out_kg,out_count"; malloc'ed. */
static char *columns_of(const measure *m) {
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    measure_class_of(m->kind)->header(m, to);
    CLAST_ASSERT(fclose(to) == 0);
    return text;
}

static bool has_column(const measure *m, const char *column) {
    char *columns = columns_of(m), *rest = NULL;
    bool found = false;
    for (char *one = strtok_r(columns, ",", &rest); one; one = strtok_r(NULL, ",", &rest))
        found = found || !strcmp(one, column);
    free(columns);
    return found;
}

static reduction usual(const measure *m) {
    if (m->kind == MEASURE_DISCHARGED) return REDUCE_RATE;
    return m->kind == MEASURE_REMAINING ? REDUCE_FINAL : REDUCE_MEAN;
}

static void list_measure(FILE *to, const measure *m) {
    char *columns = columns_of(m), *rest = NULL;
    for (char *one = strtok_r(columns, ",", &rest); one; one = strtok_r(NULL, ",", &rest))
        fprintf(to, "  %s.%s\n", m->name, one + strlen(m->name) + 1);
    free(columns);
}

/* What was found, what was expected, and what there is; malloc'ed. */
static char *refuse(const scene *s, const char *text, const char *expected) {
    char *message;
    size_t length;
    FILE *to = open_memstream(&message, &length);
    CLAST_ASSERT(to);
    fprintf(to, "--observable %s: expected %s\n", text, expected);
    if (s->measure_count == 0)
        fprintf(to, "%s has no section measures: what is not measured cannot be kept\n", s->path);
    else
        fprintf(to, "the measures of %s:\n", s->path);
    for (int i = 0; i < s->measure_count; i++) list_measure(to, &s->measures[i]);
    CLAST_ASSERT(fclose(to) == 0);
    return message;
}

static const measure *measure_named(const scene *s, const char *name, size_t length) {
    for (int i = 0; i < s->measure_count; i++)
        if (strlen(s->measures[i].name) == length && !strncmp(s->measures[i].name, name, length))
            return &s->measures[i];
    return NULL;
}

char *observable_find(observable *o, const scene *s, const char *text) {
    CLAST_ASSERT(o && s && text);
    static const char FORM[] = "MEASURE.COLUMN, :final, :mean or :rate behind it";
    char copy[OBSERVABLE_NAME];
    if (strlen(text) + sizeof ":final" > sizeof copy) return refuse(s, text, FORM);
    strcpy(copy, text);
    char *how = strrchr(copy, ':'), *dot = strchr(copy, '.');
    if (how) *how++ = '\0';
    const measure *m = dot ? measure_named(s, copy, (size_t)(dot - copy)) : NULL;
    if (!m) return refuse(s, text, FORM);
    *dot = '_';
    if (!has_column(m, copy)) return refuse(s, text, "a column of that measure");
    o->how = usual(m);
    if (how) {
        int i = 0;
        while (i < REDUCTION_COUNT && strcmp(REDUCTIONS[i], how)) i++;
        if (i == REDUCTION_COUNT) return refuse(s, text, "a reduction final, mean or rate");
        o->how = (reduction)i;
    }
    if (o->how == REDUCE_RATE && m->kind != MEASURE_DISCHARGED)
        return refuse(s, text, "rate for a measure of kind discharged alone: it never falls");
    memcpy(o->column, copy, sizeof copy);
    *dot = '.';
    snprintf(o->name, sizeof o->name, "%.*s:%s", OBSERVABLE_NAME - 8, copy, REDUCTIONS[o->how]);
    return NULL;
}

/* ---- values ---------------------------------------------------------------------------------- */

static double mean_of_second_half(const double *t, const double *x, size_t n) {
    double middle = t[0] + 0.5 * (t[n - 1] - t[0]), sum = 0, count = 0;
    for (size_t i = 0; i < n; i++) {
        if (t[i] < middle || !isfinite(x[i])) continue;
        sum += x[i];
        count += 1;
    }
    return sum / count; /* not a number when there is none */
}

static double rate(const double *t, const double *x, size_t n) {
    linear_window w = linear_part(t, x, (int)n, LINEAR_R2);
    return w.count > 0 ? w.slope : (double)NAN;
}

double observable_reduce(const observable *o, const csv *series) {
    CLAST_ASSERT(o && series);
    const double *t = csv_column(series, "time_s"), *x = csv_column(series, o->column);
    size_t n = series->rows;
    if (!t || !x || n == 0) return NAN;
    switch (o->how) {
    case REDUCE_FINAL:
        return x[n - 1];
    case REDUCE_MEAN:
        return mean_of_second_half(t, x, n);
    case REDUCE_RATE:
        return rate(t, x, n);
    }
    return NAN;
}

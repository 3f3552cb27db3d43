/* table.c - the table of what features are worth: read from its text, which is built in. */
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/scene-needs/needs.h"
#include "experiments/study/published.h"

enum { FIELDS = 11, LINE_ROOM = 1000 };

static const char MEASURED[] = {
#include "measured.inc"
};

static const char *const NAMES[NEED_FEATURES] = {
    [NEED_HISTORY] = "tangential history",
    [NEED_ROTATION] = "rotation",
    [NEED_FRICTION] = "friction",
    [NEED_ROLLING] = "rolling friction",
    [NEED_DAMPING] = "contact damping",
    [NEED_DEPTH] = "third dimension",
    [NEED_HERTZ] = "Hertz",
    [NEED_SPHERES] = "spheres per body",
    [NEED_PRECISION] = "double precision",
};

const char *need_feature_name(need_feature feature) {
    CLAST_ASSERT((int)feature >= 0 && feature < NEED_FEATURES);
    return NAMES[feature];
}

/* ---- one row --------------------------------------------------------------------------------- */

typedef struct reader {
    char *error;
    int line;
} reader;

static bool fail(const reader *r, const char *format, ...) {
    int used = snprintf(r->error, NEEDS_ERROR_MAX, "line %d: ", r->line);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(r->error + used, (size_t)(NEEDS_ERROR_MAX - used), format, arguments);
    va_end(arguments);
    return false;
}

static bool take_text(const reader *r, const char *field, char text[NEED_TEXT]) {
    if (!field[0] || strlen(field) >= NEED_TEXT)
        return fail(r, "found '%.90s', expected a text of less than %d bytes", field, NEED_TEXT);
    strcpy(text, field);
    return true;
}

static bool take_feature(const reader *r, const char *field, need_feature *feature) {
    for (int i = 0; i < NEED_FEATURES; i++)
        if (!strcmp(field, NAMES[i])) {
            *feature = (need_feature)i;
            return true;
        }
    return fail(r, "found '%.90s', expected a switch such as %s", field, NAMES[0]);
}

static bool take_number(const reader *r, const char *field, double *value) {
    char *end;
    *value = strtod(field, &end);
    if (end != field && !*end) return true;
    return fail(r, "found '%.90s', expected a number", field);
}

static bool take_count(const reader *r, const char *field, int *count) {
    double value;
    if (!take_number(r, field, &value)) return false;
    *count = value >= 0 && value <= 1e6 && value == floor(value) ? (int)value : -1;
    return *count >= 0 || fail(r, "found '%.90s', expected a whole number", field);
}

static bool take_row(const reader *r, char *line, need *n) {
    char *f[FIELDS];
    int fields = csv_split(line, f, FIELDS);
    if (fields != FIELDS) return fail(r, "found %d fields, expected %d", fields, FIELDS);
    bool good = take_text(r, f[0], n->study) && take_text(r, f[1], n->observable) &&
                take_feature(r, f[2], &n->feature) && take_text(r, f[3], n->without) &&
                take_number(r, f[4], &n->error) && take_number(r, f[5], &n->error_low) &&
                take_number(r, f[6], &n->error_high) && take_number(r, f[7], &n->cost) &&
                take_number(r, f[8], &n->cost_half) && take_count(r, f[9], &n->replicates) &&
                take_count(r, f[10], &n->lost);
    if (good && isfinite(n->error) && !(n->error_low <= n->error && n->error <= n->error_high))
        return fail(r, "found an error outside its interval");
    return good;
}

/* ---- the table ------------------------------------------------------------------------------- */

static int count_lines(const char *text) {
    int lines = 1;
    for (; *text; text++) lines += *text == '\n';
    return lines;
}

static bool take_line(reader *r, need_table *t, const char *at, size_t length) {
    char line[LINE_ROOM];
    if (length >= LINE_ROOM) return fail(r, "found a line of %zu bytes", length);
    memcpy(line, at, length);
    line[length] = '\0';
    if (r->line > 1) return take_row(r, line, &t->rows[t->count]) && ++t->count;
    if (!strcmp(line, NEEDS_HEADER)) return true;
    return fail(r, "found '%.90s', expected the header " NEEDS_HEADER, line);
}

need_table *needs_parse(const char *text, char error[NEEDS_ERROR_MAX]) {
    CLAST_ASSERT(text && error);
    need_table *t = calloc(1, sizeof *t);
    CLAST_ASSERT(t);
    t->rows = calloc((size_t)count_lines(text), sizeof *t->rows);
    CLAST_ASSERT(t->rows);
    reader r = {error, 0};
    error[0] = '\0';
    while (*text) {
        size_t length = strcspn(text, "\n");
        r.line++;
        if (!take_line(&r, t, text, length)) {
            needs_free(t);
            return NULL;
        }
        text += length + (text[length] == '\n');
    }
    return t;
}

need_table *needs_measured(void) {
    char error[NEEDS_ERROR_MAX];
    need_table *t = needs_parse(MEASURED, error);
    if (!t) clast_panic(__FILE__, __LINE__, error);
    return t;
}

void needs_free(need_table *t) {
    if (!t) return;
    free(t->rows);
    free(t);
}

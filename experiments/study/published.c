#include <errno.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/study/published.h"

enum column { QUANTITY, UNIT, EXPERIMENT, THESIS, TOLERANCE, SOURCE, NOTE, COLUMNS };
static const char *const NAMES[COLUMNS] = {"quantity",  "unit",   "experiment", "thesis",
                                           "tolerance", "source", "note"};

/* ---- tolerances ------------------------------------------------------------------------------ */

static const char *const PREFIX[TOLERANCE_KINDS] = {"", "", "equal ", "at most ", "at least "};

bool tolerance_parse(const char *text, tolerance *out) {
    CLAST_ASSERT(text && out);
    *out = (tolerance){TOLERANCE_NONE, 0, false};
    if (!*text) return true;
    out->kind = TOLERANCE_MEAN;
    for (int k = TOLERANCE_EQUAL; k < TOLERANCE_KINDS; k++)
        if (strncmp(text, PREFIX[k], strlen(PREFIX[k])) == 0) out->kind = (tolerance_kind)k;
    bool near = out->kind == TOLERANCE_MEAN || out->kind == TOLERANCE_EQUAL;
    text += strlen(PREFIX[out->kind]);
    char *end;
    out->value = strtod(text, &end);
    out->percent = strcmp(end, " %") == 0;
    if (end == text || !isfinite(out->value) || (near && out->value < 0)) return false;
    return *end == '\0' || (near && out->percent);
}

void tolerance_text(const tolerance *t, char *text, size_t room) {
    CLAST_ASSERT(t && text && room > 0);
    if (t->kind == TOLERANCE_NONE)
        text[0] = '\0';
    else
        snprintf(text, room, "%s%g%s", PREFIX[t->kind], t->value, t->percent ? " %" : "");
}

/* ---- CSV ------------------------------------------------------------------------------------- */

/* Takes the quotes off a field in place; the character after the closing quote, NULL when there is
 * none. */
static char *unquote(char *in) {
    char *out = in++;
    for (;; in++) {
        if (*in == '\0') return NULL;
        if (*in == '"' && *++in != '"') break;
        *out++ = *in;
    }
    *out = '\0'; /* at or before the closing quote */
    return in;
}

int csv_split(char *record, char **fields, int room) {
    CLAST_ASSERT(record && fields && room >= 0);
    int count = 0;
    for (char *at = record;;) {
        char *field = at;
        if (*at == '"') {
            at = unquote(at);
            if (!at || (*at && *at != ',')) return -1;
            at = *at ? at + 1 : NULL;
        } else {
            at = strchr(at, ',');
            if (at) *at++ = '\0';
        }
        if (count < room) fields[count] = field;
        count++;
        if (!at) return count;
    }
}

void csv_put(FILE *f, const char *field) {
    CLAST_ASSERT(f && field);
    if (!strpbrk(field, ",\"\n")) {
        fputs(field, f);
        return;
    }
    fputc('"', f);
    for (; *field; field++) {
        if (*field == '"') fputc('"', f);
        fputc(*field, f);
    }
    fputc('"', f);
}

/* ---- published.csv --------------------------------------------------------------------------- */

typedef struct reader {
    const char *path;
    char *error; /* PUBLISHED_ERROR_MAX */
    int line;
} reader;

static bool fail(const reader *r, const char *format, ...) {
    int used = snprintf(r->error, PUBLISHED_ERROR_MAX, "%s:%d: ", r->path, r->line);
    CLAST_ASSERT(used >= 0);
    va_list list;
    va_start(list, format);
    if (used < PUBLISHED_ERROR_MAX)
        vsnprintf(r->error + used, (size_t)(PUBLISHED_ERROR_MAX - used), format, list);
    va_end(list);
    return false;
}

static char *copy_of(const char *text) {
    char *c = strdup(text);
    CLAST_ASSERT(c);
    return c;
}

static bool read_number(const reader *r, enum column column, const char *text, double *out) {
    char *end;
    *out = NAN;
    if (!*text) return true;
    *out = strtod(text, &end);
    if (end == text || *end || !isfinite(*out))
        return fail(r, "%s: found '%s', expected a number or nothing", NAMES[column], text);
    return true;
}

static bool read_heading(const reader *r, char **fields, int count) {
    if (count != COLUMNS)
        return fail(
            r,
            "found %d columns, expected %d: quantity,unit,experiment,thesis,tolerance,source,note",
            count, COLUMNS);
    for (int k = 0; k < COLUMNS; k++)
        if (strcmp(fields[k], NAMES[k]) != 0)
            return fail(r, "column %d: found '%s', expected '%s'", k + 1, fields[k], NAMES[k]);
    return true;
}

static bool read_record(const reader *r, char **fields, int count, published_table *t) {
    published p = {0};
    if (count != COLUMNS)
        return fail(r, "found %d fields, expected %d (quote a field that holds a comma)", count,
                    COLUMNS);
    if (!*fields[QUANTITY]) return fail(r, "quantity: found nothing, expected a name");
    if (published_find(t, fields[QUANTITY]))
        return fail(r, "quantity: '%s' is there already", fields[QUANTITY]);
    if (!read_number(r, EXPERIMENT, fields[EXPERIMENT], &p.experiment)) return false;
    if (!read_number(r, THESIS, fields[THESIS], &p.thesis)) return false;
    if (!tolerance_parse(fields[TOLERANCE], &p.tolerance))
        return fail(
            r,
            "tolerance: found '%s', expected nothing, '0.02', '5 %%', 'equal 0.02', 'equal 5 %%', "
            "'at most 3' or 'at least 3'",
            fields[TOLERANCE]);
    if (!*fields[SOURCE])
        return fail(r, "source: found nothing, expected document and section or table");
    bool judged = p.tolerance.kind != TOLERANCE_NONE;
    if (judged && !*fields[NOTE])
        return fail(r, "note: found nothing, expected where the tolerance comes from");
    bool near = p.tolerance.kind == TOLERANCE_MEAN || p.tolerance.kind == TOLERANCE_EQUAL;
    if (near && isnan(published_target(&p)))
        return fail(r,
                    "tolerance: found '%s' without an experiment or a thesis value to be near to",
                    fields[TOLERANCE]);
    p.quantity = copy_of(fields[QUANTITY]);
    p.unit = copy_of(fields[UNIT]);
    p.source = copy_of(fields[SOURCE]);
    p.note = copy_of(fields[NOTE]);
    t->rows = realloc(t->rows, ((size_t)t->count + 1) * sizeof *t->rows);
    CLAST_ASSERT(t->rows);
    t->rows[t->count++] = p;
    return true;
}

static bool read_lines(reader *r, FILE *f, published_table *t) {
    char *text = NULL;
    size_t room = 0;
    bool good = true, heading = false;
    for (ssize_t length; good && (length = getline(&text, &room, f)) > 0;) {
        r->line++;
        while (length > 0 && (text[length - 1] == '\n' || text[length - 1] == '\r'))
            text[--length] = '\0';
        if (length == 0 || text[0] == '#') continue;
        char *fields[COLUMNS];
        int count = csv_split(text, fields, COLUMNS);
        if (count < 0)
            good = fail(r, "a quote is not closed, or is followed by more than a comma");
        else if (!heading)
            good = heading = read_heading(r, fields, count);
        else
            good = read_record(r, fields, count, t);
    }
    free(text);
    if (good && t->count == 0) good = fail(r, "no quantities");
    return good;
}

published_table *published_read(const char *path, char error[PUBLISHED_ERROR_MAX]) {
    CLAST_ASSERT(path && error);
    FILE *f = fopen(path, "r");
    if (!f) {
        snprintf(error, PUBLISHED_ERROR_MAX, "%s: cannot be opened: %s", path, strerror(errno));
        return NULL;
    }
    published_table *t = calloc(1, sizeof *t);
    CLAST_ASSERT(t);
    reader r = {path, error, 0};
    bool good = read_lines(&r, f, t);
    if (good && ferror(f)) good = fail(&r, "cannot be read: %s", strerror(errno));
    fclose(f);
    if (good) return t;
    published_free(t);
    return NULL;
}

void published_free(published_table *t) {
    if (!t) return;
    for (int i = 0; i < t->count; i++) {
        free(t->rows[i].quantity);
        free(t->rows[i].unit);
        free(t->rows[i].source);
        free(t->rows[i].note);
    }
    free(t->rows);
    free(t);
}

const published *published_find(const published_table *t, const char *quantity) {
    CLAST_ASSERT(t && quantity);
    for (int i = 0; i < t->count; i++)
        if (strcmp(t->rows[i].quantity, quantity) == 0) return &t->rows[i];
    return NULL;
}

const published *published_need(const published_table *t, const char *quantity) {
    const published *p = published_find(t, quantity);
    if (p) return p;
    fprintf(stderr, "published.csv has no row '%s'\n", quantity);
    exit(4);
}

double published_target(const published *p) {
    CLAST_ASSERT(p);
    return isnan(p->experiment) ? p->thesis : p->experiment;
}

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "engine/check.h"
#include "experiments/study/verdict.h"

typedef struct row {
    char *quantity, *unit, *source;
    double experiment, thesis, target;
    interval ours;
    tolerance allowed;
    verdict verdict;
} row;

struct verdict_table {
    char *study;
    row *rows;
    int count;
};

static const char *const WORDS[VERDICTS] = {"met", "missed", "open", "not comparable"};

static char *copy_of(const char *text) {
    char *c = strdup(text);
    CLAST_ASSERT(c);
    return c;
}

verdict_table *verdict_new(const char *study) {
    CLAST_ASSERT(study && *study && !strchr(study, '/'));
    verdict_table *v = calloc(1, sizeof *v);
    CLAST_ASSERT(v);
    v->study = copy_of(study);
    return v;
}

void verdict_free(verdict_table *v) {
    if (!v) return;
    for (int i = 0; i < v->count; i++) {
        free(v->rows[i].quantity);
        free(v->rows[i].unit);
        free(v->rows[i].source);
    }
    free(v->rows);
    free(v->study);
    free(v);
}

/* ---- the decision ---------------------------------------------------------------------------- */

/* A mean near a target: an interval that is wider than the tolerance cannot say that it is. With
 * one that is not, the mean decides both ways: met, or missed. */
static verdict near_target(double off, double margin, double half) {
    if (half <= margin) return off <= margin ? VERDICT_MET : VERDICT_MISSED;
    return off - half > margin ? VERDICT_MISSED : VERDICT_OPEN;
}

verdict verdict_of(double target, interval ours, tolerance allowed, bool comparable) {
    bool near = allowed.kind == TOLERANCE_MEAN || allowed.kind == TOLERANCE_EQUAL;
    if (!comparable || allowed.kind == TOLERANCE_NONE || (near && !isfinite(target)))
        return VERDICT_NOT_COMPARABLE;
    if (!isfinite(ours.mean)) return VERDICT_MISSED;
    double margin = allowed.percent ? fabs(target) * allowed.value / 100 : allowed.value;
    /* 0.37 lies 0.02 from 0.39, whatever binary fractions say */
    double rounding = near ? 1e-12 * (fabs(target) + margin) : 0;
    double half = isfinite(ours.half) ? ours.half : 0;
    bool met = false;
    switch (allowed.kind) {
    case TOLERANCE_MEAN:
        return near_target(fabs(ours.mean - target), margin + rounding, half);
    case TOLERANCE_EQUAL:
        met = ours.n > 1 && equivalence_test(ours, interval_exact(target), margin + rounding).equal;
        break;
    case TOLERANCE_AT_MOST:
        met = ours.mean + half <= allowed.value;
        break;
    case TOLERANCE_AT_LEAST:
        met = ours.mean - half >= allowed.value;
        break;
    default:
        CLAST_ASSERT(!"a kind of tolerance");
    }
    return met ? VERDICT_MET : VERDICT_MISSED;
}

static verdict add(verdict_table *v, const published *p, interval ours, bool comparable) {
    double target = published_target(p);
    row r = {.quantity = copy_of(p->quantity),
             .unit = copy_of(p->unit),
             .source = copy_of(p->source),
             .experiment = p->experiment,
             .thesis = p->thesis,
             .target = target,
             .ours = ours,
             .allowed = p->tolerance,
             .verdict = verdict_of(target, ours, p->tolerance, comparable)};
    v->rows = realloc(v->rows, ((size_t)v->count + 1) * sizeof *v->rows);
    CLAST_ASSERT(v->rows);
    v->rows[v->count++] = r;
    return r.verdict;
}

verdict verdict_add(verdict_table *v, const char *quantity, const char *unit, double experiment,
                    double thesis, interval ours, tolerance allowed, bool comparable) {
    CLAST_ASSERT(v && quantity && *quantity && unit);
    char name[256], unit_name[64], none[] = "";
    snprintf(name, sizeof name, "%s", quantity);
    snprintf(unit_name, sizeof unit_name, "%s", unit);
    published p = {name, unit_name, experiment, thesis, allowed, none, none};
    return add(v, &p, ours, comparable);
}

verdict verdict_published(verdict_table *v, const published *p, interval ours, bool comparable) {
    CLAST_ASSERT(v && p);
    return add(v, p, ours, comparable);
}

verdict verdict_measured(verdict_table *v, const published_table *numbers, const char *quantity,
                         interval ours) {
    return verdict_published(v, published_need(numbers, quantity), ours, true);
}

verdict verdict_named(verdict_table *v, const published_table *numbers, const char *quantity,
                      double ours) {
    return verdict_measured(v, numbers, quantity, interval_exact(ours));
}

/* ---- numbers as text ------------------------------------------------------------------------- */

void interval_text(const interval *x, char *text, size_t room) {
    CLAST_ASSERT(x && text && room > 0);
    if (!isfinite(x->mean)) {
        snprintf(text, room, "none");
    } else if (x->n == 0) {
        snprintf(text, room, "%.4g", x->mean);
    } else if (!isfinite(x->half)) {
        snprintf(text, room, "%.4g (n = %d)", x->mean, x->n);
    } else { /* two digits of the interval */
        int decimals = x->half > 0 ? 1 - (int)floor(log10(x->half) + 1e-9) : 3;
        decimals = decimals < 0 ? 0 : decimals > 8 ? 8 : decimals;
        snprintf(text, room, "%.*f ± %.*f", decimals, x->mean, decimals, x->half);
    }
}

static void value_text(double x, char *text, size_t room) {
    if (isnan(x))
        snprintf(text, room, "-");
    else
        snprintf(text, room, "%g", x);
}

/* ---- the printed table ----------------------------------------------------------------------- */

enum { QUANTITY, OURS, EXPERIMENT, THESIS, ALLOWED, SAYS, CELLS, CELL = 320 };
typedef struct cells {
    char text[CELLS][CELL];
} cells;

static cells cells_of(const row *r) {
    cells c;
    snprintf(c.text[QUANTITY], CELL, "%.200s%s%.60s", r->quantity, *r->unit ? ", " : "", r->unit);
    interval_text(&r->ours, c.text[OURS], CELL);
    value_text(r->experiment, c.text[EXPERIMENT], CELL);
    value_text(r->thesis, c.text[THESIS], CELL);
    tolerance_text(&r->allowed, c.text[ALLOWED], CELL);
    if (r->allowed.kind == TOLERANCE_MEAN) {
        char plain[CELL - 8];
        tolerance_text(&r->allowed, plain, sizeof plain);
        snprintf(c.text[ALLOWED], CELL, "± %s", plain);
    }
    snprintf(c.text[SAYS], CELL, "%s", WORDS[r->verdict]);
    return c;
}

/* Characters on the screen, not bytes: ± has two. */
static int width_of(const char *text) {
    int n = 0;
    for (; *text; text++) n += ((unsigned char)*text & 0xC0) != 0x80;
    return n;
}

static void print_cells(const cells *c, const int *width, FILE *out) {
    for (int k = 0; k < CELLS; k++) {
        int pad = width[k] - width_of(c->text[k]);
        bool right = k == EXPERIMENT || k == THESIS;
        if (right) fprintf(out, "%*s", pad, "");
        fputs(c->text[k], out);
        if (k == CELLS - 1)
            fputc('\n', out);
        else
            fprintf(out, "%*s", (right ? 0 : pad) + 2, "");
    }
}

static void print_table(const verdict_table *v, FILE *out) {
    cells heading = {{"quantity", "ours (95 %)", "experiment", "thesis", "tolerance", "verdict"}};
    int width[CELLS];
    for (int k = 0; k < CELLS; k++) width[k] = width_of(heading.text[k]);
    for (int i = 0; i < v->count; i++) {
        cells c = cells_of(&v->rows[i]);
        for (int k = 0; k < CELLS; k++)
            if (width_of(c.text[k]) > width[k]) width[k] = width_of(c.text[k]);
    }
    print_cells(&heading, width, out);
    for (int i = 0; i < v->count; i++) {
        cells c = cells_of(&v->rows[i]);
        print_cells(&c, width, out);
    }
}

/* ---- the file -------------------------------------------------------------------------------- */

static void put_number(FILE *f, double x) {
    if (isfinite(x)) fprintf(f, "%.6g", x);
}

static void write_rows(const verdict_table *v, FILE *f) {
    fputs("quantity,published,ours,tolerance,verdict,unit,half,sd,n,experiment,thesis,source\n", f);
    for (int i = 0; i < v->count; i++) {
        const row *r = &v->rows[i];
        char allowed[64];
        tolerance_text(&r->allowed, allowed, sizeof allowed);
        csv_put(f, r->quantity), fputc(',', f);
        put_number(f, r->target), fputc(',', f);
        put_number(f, r->ours.mean), fputc(',', f);
        fprintf(f, "%s,%s,", allowed, WORDS[r->verdict]);
        csv_put(f, r->unit), fputc(',', f);
        put_number(f, r->ours.half), fputc(',', f);
        put_number(f, r->ours.sd), fprintf(f, ",%d,", r->ours.n);
        put_number(f, r->experiment), fputc(',', f);
        put_number(f, r->thesis), fputc(',', f);
        csv_put(f, r->source), fputc('\n', f);
    }
}

/* All folders above a file. */
static bool make_folders(char *path) {
    for (char *at = strchr(path + 1, '/'); at; at = strchr(at + 1, '/')) {
        *at = '\0';
        bool made = mkdir(path, 0777) == 0 || errno == EEXIST;
        *at = '/';
        if (!made) return false;
    }
    return true;
}

static bool write_file(const verdict_table *v, const char *path) {
    char draft[4096];
    int length = snprintf(draft, sizeof draft, "%s.part", path);
    if (length < 0 || (size_t)length >= sizeof draft) {
        errno = ENAMETOOLONG;
        return false;
    }
    if (!make_folders(draft)) return false;
    FILE *f = fopen(draft, "w");
    if (!f) return false;
    write_rows(v, f);
    bool good = fflush(f) == 0 && !ferror(f);
    good = fclose(f) == 0 && good;
    good = good && rename(draft, path) == 0;
    if (!good) {
        int why = errno;
        unlink(draft);
        errno = why;
    }
    return good;
}

int verdict_finish(const verdict_table *v, const char *csv, FILE *out) {
    CLAST_ASSERT(v && csv && *csv && out);
    int count[VERDICTS] = {0};
    for (int i = 0; i < v->count; i++) count[v->rows[i].verdict]++;
    int counted = v->count - count[VERDICT_NOT_COMPARABLE];
    print_table(v, out);
    bool written = write_file(v, csv);
    if (!written) fprintf(stderr, "%s: cannot be written: %s\n", csv, strerror(errno));
    fprintf(out, "%s: %d of %d met", v->study, count[VERDICT_MET], counted);
    if (count[VERDICT_OPEN] > 0) fprintf(out, ", %d open", count[VERDICT_OPEN]);
    fputc('\n', out);
    fflush(out);
    if (!written) return 4;
    return count[VERDICT_MISSED] == 0 && count[VERDICT_MET] > 0 ? 0 : 1;
}

/* passages.c - who came in and who went out, from the tables of a run. */
#include "experiments/rtd/rtd.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/run/results.h"
#include "experiments/study/published.h"

/* ---- one table of records -------------------------------------------------------------------- */

typedef struct record {
    uint32_t id;
    double time, mass, diameter;
    bool wanted; /* of the feed or outlet asked for */
    bool stray;  /* it left the domain, by no outlet */
} record;

typedef struct records {
    record *items;
    size_t count, room;
    bool named; /* the wanted name is there */
} records;

enum { FIELDS = 32 };
enum { ID, TIME, NAME, MASS, DIAMETER, COLUMNS };

static bool columns_of(char *header, const char *name, int at[COLUMNS]) {
    const char *const words[COLUMNS] = {"id", "time_s", name, "mass_kg", "diameter_m"};
    char *field[FIELDS];
    int count = csv_split(header, field, FIELDS);
    for (int k = 0; k < COLUMNS; k++) {
        at[k] = -1;
        for (int i = 0; i < count && i < FIELDS; i++)
            if (!strcmp(field[i], words[k])) at[k] = i;
        if (at[k] < 0) return false;
    }
    return true;
}

static bool number_of(const char *text, double *value) {
    char *end;
    *value = strtod(text, &end);
    return end != text && !*end && isfinite(*value);
}

/* False when the line is no record. */
static bool record_of(char *line, const int at[COLUMNS], const char *wanted, records *all) {
    char *field[FIELDS];
    record r;
    double id;
    int count = csv_split(line, field, FIELDS);
    for (int k = 0; k < COLUMNS; k++)
        if (at[k] >= count) return false;
    if (!number_of(field[at[ID]], &id) || !number_of(field[at[TIME]], &r.time) ||
        !number_of(field[at[MASS]], &r.mass) || !number_of(field[at[DIAMETER]], &r.diameter) ||
        id < 0 || !(r.mass > 0))
        return false;
    r.id = (uint32_t)id;
    r.stray = !strcmp(field[at[NAME]], "domain");
    r.wanted = !wanted || !strcmp(field[at[NAME]], wanted);
    all->named = all->named || r.wanted;
    if (all->count == all->room) {
        all->room = 2 * all->room + 256;
        all->items = realloc(all->items, all->room * sizeof *all->items);
        CLAST_ASSERT(all->items);
    }
    all->items[all->count++] = r;
    return true;
}

static int by_id(const void *a, const void *b) {
    const record *x = a, *y = b;
    return (x->id > y->id) - (x->id < y->id);
}

/* By id. A last line without an end is of a run that was killed: left out. */
static bool records_read(const char *folder, const char *file, const char *name, const char *wanted,
                         records *all, char why[RTD_ERROR_MAX]) {
    char *path = path_in(folder, file), *line = NULL;
    size_t room = 0, number = 0;
    int at[COLUMNS];
    FILE *f = fopen(path, "r");
    why[0] = '\0';
    if (!f)
        snprintf(why, RTD_ERROR_MAX, "%s: cannot be opened: %s; has the scene %ss?", path,
                 strerror(errno), name);
    for (ssize_t n; f && !why[0] && (n = getline(&line, &room, f)) > 0 && line[n - 1] == '\n';) {
        line[n - 1] = '\0';
        number++;
        if (number == 1 ? !columns_of(line, name, at) : !record_of(line, at, wanted, all))
            snprintf(why, RTD_ERROR_MAX,
                     "%s:%zu: found no %s, expected id, time_s, %s, mass_kg "
                     "and diameter_m",
                     path, number, number == 1 ? "such columns" : "record", name);
    }
    if (f) fclose(f);
    if (!why[0] && wanted && !all->named)
        snprintf(why, RTD_ERROR_MAX, "%s: no record of %s '%s'", path, name, wanted);
    free(line);
    free(path);
    if (why[0]) return false;
    if (all->count > 0) qsort(all->items, all->count, sizeof *all->items, by_id);
    return true;
}

/* ---- passages -------------------------------------------------------------------------------- */

static int by_entry(const void *a, const void *b) {
    const passage *x = a, *y = b;
    if (x->in != y->in) return x->in < y->in ? -1 : 1;
    return (x->id > y->id) - (x->id < y->id);
}

static int by_time(const void *a, const void *b) {
    const record *x = a, *y = b;
    return (x->time > y->time) - (x->time < y->time);
}

passages *passages_new(const passage *items, size_t count, double end) {
    CLAST_ASSERT((items || count == 0) && isfinite(end));
    passages *p = calloc(1, sizeof *p);
    CLAST_ASSERT(p);
    p->items = calloc(count + 1, sizeof *p->items);
    CLAST_ASSERT(p->items);
    if (count > 0) memcpy(p->items, items, count * sizeof *items);
    qsort(p->items, count, sizeof *p->items, by_entry);
    p->count = count;
    p->end = end;
    p->balance = NAN;
    return p;
}

void passages_free(passages *p) {
    if (!p) return;
    free(p->items);
    free(p->other_in);
    free(p->bed_out);
    free(p->bed_mass);
    free(p);
}

void passages_scale(passages *p, double factor) {
    CLAST_ASSERT(p && factor > 0);
    for (size_t i = 0; i < p->count; i++) p->items[i].in *= factor, p->items[i].out *= factor;
    for (size_t i = 0; i < p->bed_count; i++) p->bed_out[i] *= factor;
    for (size_t i = 0; i < p->other_count; i++) p->other_in[i] *= factor;
    p->end *= factor;
}

double holdup_at(const passages *p, double time) {
    CLAST_ASSERT(p);
    double sum = p->bed;
    for (size_t i = 0; i < p->bed_count && p->bed_out[i] <= time; i++) sum -= p->bed_mass[i];
    for (size_t i = 0; i < p->count && p->items[i].in <= time; i++)
        if (p->items[i].out > time) sum += p->items[i].mass;
    return sum;
}

/* Bodies that left and that no feed put in. Takes `out` in the order of time. */
static void take_bed(passages *p, records *out, const bool *fed) {
    size_t n = 0;
    for (size_t i = 0; i < out->count; i++)
        if (!fed[i]) out->items[n++] = out->items[i];
    qsort(out->items, n, sizeof *out->items, by_time);
    p->bed_out = calloc(n + 1, sizeof *p->bed_out);
    p->bed_mass = calloc(n + 1, sizeof *p->bed_mass);
    CLAST_ASSERT(p->bed_out && p->bed_mass);
    p->bed_count = n;
    for (size_t i = 0; i < n; i++)
        p->bed_out[i] = out->items[i].time, p->bed_mass[i] = out->items[i].mass;
}

/* Both tables by id. False when a body left before it came. */
static bool join(const records *in, records *out, passages **made, double end,
                 char why[RTD_ERROR_MAX]) {
    passage *all = calloc(in->count + 1, sizeof *all);
    bool *fed = calloc(out->count + 1, sizeof *fed);
    double *other = calloc(in->count + 1, sizeof *other);
    CLAST_ASSERT(all && fed && other);
    size_t n = 0, others = 0;
    why[0] = '\0';
    for (size_t i = 0, k = 0; i < in->count && !why[0]; i++) {
        const record *r = &in->items[i];
        while (k < out->count && out->items[k].id < r->id) k++;
        bool left = k < out->count && out->items[k].id == r->id;
        if (left) fed[k] = true;
        if (left && out->items[k].time < r->time)
            snprintf(why, RTD_ERROR_MAX, "body %u left at %g s and was fed at %g s",
                     (unsigned)r->id, out->items[k].time, r->time);
        bool through = !left || out->items[k].wanted; /* else it took another outlet */
        if (r->wanted && through)
            all[n++] = (passage){r->id, r->time, left ? out->items[k].time : INFINITY, r->mass,
                                 r->diameter};
        else if (r->wanted)
            other[others++] = r->time;
    }
    if (!why[0]) {
        *made = passages_new(all, n, end);
        (*made)->other_in = other, (*made)->other_count = others;
        take_bed(*made, out, fed);
    } else {
        free(other);
    }
    free(all);
    free(fed);
    return !why[0];
}

/* The end of the run, what it began with and its own balance, from the series. */
static csv *series_of(const char *folder, double *end, char why[RTD_ERROR_MAX]) {
    char *path = path_in(folder, FILE_SERIES), reason[RESULTS_ERROR_MAX] = "";
    csv *t = csv_read(path, reason);
    const double *time = t ? csv_column(t, "time_s") : NULL;
    if (!t)
        snprintf(why, RTD_ERROR_MAX, "%.900s", reason);
    else if (!time || t->rows == 0)
        snprintf(why, RTD_ERROR_MAX, "%.900s: holds no rows with time_s", path);
    else
        *end = time[t->rows - 1];
    free(path);
    if (t && (!time || t->rows == 0)) csv_free(t), t = NULL;
    return t;
}

/* What both tables hold up to the end of the run. */
typedef struct tally {
    double in, out, lightest; /* kg */
    size_t strays, others;    /* of those that left */
} tally;

static double mass_until(const records *all, double end, tally *t) {
    double sum = 0;
    for (size_t i = 0; i < all->count; i++) {
        t->lightest = fmin(t->lightest, all->items[i].mass);
        if (all->items[i].time <= end * (1 + 1e-12)) sum += all->items[i].mass;
    }
    return sum;
}

static tally tally_of(const records *in, const records *out, double end) {
    tally t = {.lightest = INFINITY};
    t.in = mass_until(in, end, &t);
    t.out = mass_until(out, end, &t);
    for (size_t i = 0; i < out->count; i++) out->items[i].stray ? t.strays++ : t.others++;
    return t;
}

static void take_series(passages *p, const csv *s, const tally *t) {
    const double *inside = csv_column(s, "inside_kg"), *fed = csv_column(s, "fed_kg");
    const double *out = csv_column(s, "out_kg");
    size_t last = s->rows - 1;
    double left = 0, counted = 0;
    for (size_t i = 0; i < p->bed_count; i++) left += p->bed_mass[i];
    p->bed = inside ? inside[0] : left;
    if (!inside) return;
    if (fed && out) counted = p->bed + fed[last] - out[last] - inside[last];
    p->balance = p->bed + t->in - t->out - inside[last];
    if (fabs(counted) > fabs(p->balance)) p->balance = counted;
}

bool passages_balanced(const passages *p) {
    CLAST_ASSERT(p);
    return isnan(p->balance) || fabs(p->balance) < 0.5 * p->lightest;
}

passages *passages_read(const char *folder, const rtd_options *o, char why[RTD_ERROR_MAX]) {
    CLAST_ASSERT(folder && o && why);
    records in = {0}, out = {0};
    passages *p = NULL;
    double end = 0;
    why[0] = '\0';
    csv *series = series_of(folder, &end, why);
    bool read = series && records_read(folder, "feeds.csv", "feed", o->feed, &in, why) &&
                records_read(folder, "outlets.csv", "outlet", o->outlet, &out, why);
    tally t = read ? tally_of(&in, &out, end) : (tally){0};
    if (read && join(&in, &out, &p, end, why)) {
        p->lightest = t.lightest;
        p->strays = !o->outlet && t.others > 0 ? t.strays : 0;
        take_series(p, series, &t);
    }
    csv_free(series);
    free(in.items);
    free(out.items);
    return p;
}

/* part_discharge.c - the hopper discharge of S12 3.9.3, whose runs are those of the study
 * hopper-discharge: its data/runs.csv is read, nothing is run here.
 *
 * The flow is chaotic, so a run is held against the run of the same method from the same initial
 * state with the smallest step, and the differences are averaged over the states. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/speed-accuracy/chart.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"
#include "experiments/study/statistics.h"
#include "experiments/tune/paired.h"

enum { COLUMNS_MAX = 40, STATES_MAX = 64, LINE_ROOM = 4000 };

/* ---- the file -------------------------------------------------------------------------------- */

enum { METHOD, STEP, SEED, RESIDENCE, ENERGY, EVALUATIONS, CPU, FAILED, FIELDS };

static const char *const FIELD[FIELDS] = {"method",           "step_s",       "seed",
                                          "mean_residence_s", "energy_error", "force_evaluations",
                                          "cpu_s_per_s",      "failed"};

typedef struct discharge_run {
    char method[32];
    double number[FIELDS]; /* of `method` it has none */
} discharge_run;

typedef struct discharge_runs {
    discharge_run *rows;
    int count, room;
} discharge_runs;

/* False when one of the fields is not there. */
static bool find_columns(char *header, int column[FIELDS]) {
    char *names[COLUMNS_MAX];
    int n = csv_split(header, names, COLUMNS_MAX);
    for (int f = 0; f < FIELDS; f++) {
        column[f] = -1;
        for (int i = 0; i < n && i < COLUMNS_MAX; i++)
            if (!strcmp(names[i], FIELD[f])) column[f] = i;
        if (column[f] < 0) return false;
    }
    return true;
}

static void add_row(discharge_runs *runs, char *line, const int column[FIELDS]) {
    char *texts[COLUMNS_MAX];
    int n = csv_split(line, texts, COLUMNS_MAX);
    discharge_run row = {.method = ""};
    for (int f = 0; f < FIELDS; f++) {
        if (column[f] >= n) return; /* cut off while it was written */
        char *end;
        row.number[f] = strtod(texts[column[f]], &end);
        if (end == texts[column[f]]) row.number[f] = NAN;
    }
    snprintf(row.method, sizeof row.method, "%s", texts[column[METHOD]]);
    if (runs->count == runs->room) {
        runs->room = 2 * runs->room + 64;
        runs->rows = realloc(runs->rows, (size_t)runs->room * sizeof *runs->rows);
        CLAST_ASSERT(runs->rows);
    }
    runs->rows[runs->count++] = row;
}

/* False when there is no such file, or it is another table. */
static bool read_runs(discharge_runs *runs, const char *path) {
    FILE *f = fopen(path, "r");
    if (!f) return false;
    char line[LINE_ROOM];
    int column[FIELDS];
    bool good = fgets(line, sizeof line, f) != NULL;
    if (good) {
        line[strcspn(line, "\r\n")] = '\0';
        good = find_columns(line, column);
    }
    while (good && fgets(line, sizeof line, f)) {
        line[strcspn(line, "\r\n")] = '\0';
        add_row(runs, line, column);
    }
    fclose(f);
    return good;
}

/* Of this size: another one has other steps and states. */
static bool find_runs(discharge_runs *runs, const char *size, const char *studies, char note[200]) {
    char path[1000];
    snprintf(path, sizeof path, "%s/hopper-discharge/%s/data/runs.csv", studies, size);
    bool found = read_runs(runs, path) && runs->count > 0;
    if (found)
        snprintf(note, 200, "%d runs of the study hopper-discharge at size %s", runs->count, size);
    else
        snprintf(note, 200, "not there: the study hopper-discharge has not been run at size %s",
                 size);
    return found;
}

/* ---- one method at one step ------------------------------------------------------------------ */

static bool failed(const discharge_run *r) {
    return !(r->number[FAILED] == 0) || !isfinite(r->number[RESIDENCE]);
}

static const discharge_run *find(const discharge_runs *runs, const char *method, double step,
                                 double seed) {
    for (int i = 0; i < runs->count; i++) {
        const discharge_run *r = &runs->rows[i];
        if (!strcmp(r->method, method) && r->number[STEP] == step && r->number[SEED] == seed)
            return r;
    }
    return NULL;
}

static double smallest_step(const discharge_runs *runs, const char *method) {
    double step = INFINITY;
    for (int i = 0; i < runs->count; i++)
        if (!strcmp(runs->rows[i].method, method)) step = fmin(step, runs->rows[i].number[STEP]);
    return step;
}

/* All states of a method and step, beside those of the smallest step. */
typedef struct states {
    int count, failed;
    double reference[STATES_MAX], residence[STATES_MAX], energy[STATES_MAX], cpu[STATES_MAX];
    double evaluations; /* mean */
} states;

static states states_of(const discharge_runs *runs, const discharge_run *first) {
    states s = {.count = 0};
    double finest = smallest_step(runs, first->method);
    for (int i = 0; i < runs->count && s.count < STATES_MAX; i++) {
        const discharge_run *r = &runs->rows[i];
        if (strcmp(r->method, first->method) != 0 || r->number[STEP] != first->number[STEP])
            continue;
        const discharge_run *fine = find(runs, r->method, finest, r->number[SEED]);
        if (!fine || failed(fine)) continue;
        s.reference[s.count] = fine->number[RESIDENCE];
        s.residence[s.count] = failed(r) ? NAN : r->number[RESIDENCE];
        s.energy[s.count] = failed(r) ? NAN : fabs(r->number[ENERGY]);
        s.cpu[s.count] = failed(r) ? NAN : r->number[CPU];
        s.evaluations += r->number[EVALUATIONS];
        s.failed += failed(r);
        s.count++;
    }
    s.evaluations /= s.count;
    return s;
}

static void set_residence(chart_point *p, const states *s) {
    paired d = paired_compare(s->reference, s->residence, s->count, 0.05);
    p->quantity = "residence";
    p->difference = d.difference;
    p->error = fabs(d.difference);
    p->low = fmax(0, p->error - d.half), p->high = p->error + d.half;
    if (!isfinite(d.half)) p->error = p->low = p->high = INFINITY;
}

static void set_energy(chart_point *p, const states *s) {
    interval e = mean_interval(s->energy, s->count);
    p->quantity = "energy";
    p->reference = false;
    p->difference = NAN;
    p->error = s->failed ? INFINITY : e.mean;
    p->low = fmax(0, p->error - e.half), p->high = p->error + e.half;
    if (!isfinite(e.half)) p->low = p->high = p->error;
}

/* What was compared. Without runs there is no table, and an older one goes: no figure is drawn of
 * runs that are not there. */
static int write_runs(const discharge_runs *runs, const char *folder) {
    if (runs->count == 0) {
        char path[1000];
        snprintf(path, sizeof path, "%s/discharge.csv", folder);
        remove(path);
        return 0;
    }
    FILE *f = output_table(folder, "discharge.csv",
                           "method,step_s,seed,failed,mean_residence_s,reference_s,energy_error,"
                           "force_evaluations,cpu_s_per_s");
    if (!f) return 4;
    for (int i = 0; i < runs->count; i++) {
        const discharge_run *r = &runs->rows[i];
        const discharge_run *fine =
            find(runs, r->method, smallest_step(runs, r->method), r->number[SEED]);
        fprintf(f, "%s,%.6g,%.17g,%d,%.8g,%.8g,%.6g,%.10g,%.6g\n", r->method, r->number[STEP],
                r->number[SEED], failed(r), r->number[RESIDENCE],
                fine ? fine->number[RESIDENCE] : (double)NAN, r->number[ENERGY],
                r->number[EVALUATIONS], r->number[CPU]);
    }
    return output_close(f);
}

static void add_setting(chart *c, const discharge_runs *runs, const discharge_run *first) {
    states s = states_of(runs, first);
    chart_point p = {.part = PART_DISCHARGE,
                     .scene = "S12 3.9.3",
                     .level = first->number[STEP],
                     .step = first->number[STEP],
                     .statistical = true,
                     .reference = first->number[STEP] == smallest_step(runs, first->method),
                     .samples = s.count,
                     .evaluations = s.evaluations,
                     .overlap = NAN};
    snprintf(p.family, sizeof p.family, "%s", first->method);
    snprintf(p.setting, sizeof p.setting, "step %.3g ms", 1e3 * p.step);
    if (s.failed > 0)
        snprintf(p.message, sizeof p.message, "%d of %d runs failed", s.failed, s.count);
    p.cost = cost_of(s.cpu, s.count);
    set_residence(&p, &s);
    chart_add(c, &p);
    set_energy(&p, &s);
    chart_add(c, &p);
}

int discharge_points(chart *c, const chart_size *size, const char *studies, const char *folder,
                     char note[200]) {
    discharge_runs runs = {0};
    find_runs(&runs, size->name, studies, note);
    int bad = write_runs(&runs, folder);
    for (int i = 0; i < runs.count; i++) {
        const discharge_run *r = &runs.rows[i];
        bool seen = false;
        for (int k = 0; k < i; k++)
            seen |= !strcmp(runs.rows[k].method, r->method) &&
                    runs.rows[k].number[STEP] == r->number[STEP];
        if (!seen) add_setting(c, &runs, r);
    }
    free(runs.rows);
    return bad;
}

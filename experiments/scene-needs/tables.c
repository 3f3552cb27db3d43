/* tables.c - the data folder (README.md has the columns). */
#include "engine/clast.h"
#include "experiments/scene-needs/study.h"
#include "experiments/study/output.h"
#include "experiments/study/published.h"

typedef void per_observable(FILE *f, const needs_runs *r, int observable);

static int write_table(const needs_study *s, const char *name, const char *header,
                       per_observable *write) {
    FILE *f = output_table(s->data, name, header);
    if (!f) return 4;
    for (int i = 0; i < SCENES_COUNT; i++)
        for (int o = 0; o < s->runs[i].scene->observables; o++) write(f, &s->runs[i], o);
    return output_close(f);
}

static void write_needs(FILE *f, const needs_runs *r, int observable) {
    for (int v = 1; v < r->variants; v++) {
        need n = needs_compare(r, observable, v);
        fprintf(f, "%s,%s,%s,", n.study, n.observable, need_feature_name(n.feature));
        csv_put(f, n.without);
        fprintf(f, ",%.5g,%.5g,%.5g,%.4g,%.2g,%d,%d\n", n.error, n.error_low, n.error_high, n.cost,
                n.cost_half, n.replicates, n.lost);
    }
}

static void write_reference(FILE *f, const needs_runs *r, int observable) {
    const needs_observable *o = &r->scene->observable[observable];
    needs_values v = needs_read_values(r, observable, 0);
    interval value = mean_interval(v.value, r->replicates);
    interval cost = mean_interval(v.cost, r->replicates);
    fprintf(f, "%s,%s,%s,%.6g,%.3g,%.4g,%d\n", r->scene->name, o->name, o->unit, value.mean,
            value.half, cost.mean, value.n);
}

static void write_runs(FILE *f, const needs_runs *r, int observable) {
    const needs_observable *o = &r->scene->observable[observable];
    for (int v = 0; v < r->variants; v++) {
        needs_values values = needs_read_values(r, observable, v);
        for (int k = 0; k < r->replicates; k++) {
            const job *j = &r->jobs[o->leg][k * r->variants + v];
            fprintf(f, "%s,%s,", r->scene->name, o->name);
            csv_put(f, v ? r->scene->without[v - 1].without : "as it stands");
            fprintf(f, ",%d,%.8g,%.5g,%d,0x%016llx\n", k + 1, values.value[k], values.cost[k],
                    j->done, (unsigned long long)(j->done ? j->hash : 0));
        }
    }
}

static int write_about(const needs_study *s) {
    FILE *f = output_table(s->data, "about.txt", "study=scene-needs");
    if (!f) return 4;
    uint64_t hash = 0;
    for (int i = 0; i < SCENES_COUNT; i++) {
        const needs_runs *r = &s->runs[i];
        for (int leg = 0; leg < r->scene->legs; leg++)
            for (int k = 0; k < r->variants * r->replicates; k++)
                hash = (hash * 31) ^ r->jobs[leg][k].hash;
    }
    fprintf(f, "size=%s\nreplicates=", s->size_name);
    for (int i = 0; i < SCENES_COUNT; i++)
        fprintf(f, "%s%d %s", i ? ", " : "", s->runs[i].replicates, s->runs[i].scene->name);
    fprintf(f, "\nhash=0x%016llx\nengine=%s\n", (unsigned long long)hash, CLAST_VERSION);
    return output_close(f);
}

int needs_write_tables(const needs_study *s) {
    int bad = write_table(s, "needs.csv", NEEDS_HEADER, write_needs);
    bad |= write_table(s, "reference.csv",
                       "study,observable,unit,mean,half,cost_s_per_s,replicates", write_reference);
    bad |=
        write_table(s, "runs.csv",
                    "study,observable,without,replicate,value,cost_s_per_s,done,hash", write_runs);
    bad |= write_about(s);
    return bad ? 4 : 0;
}

#include "experiments/run/recorder.h"

#include <stdlib.h>
#include <string.h>

#include "engine/check.h"
#include "experiments/run/folder.h"
#include "experiments/run/passage.h"

void recorder_start(recorder *r, const scene *s) {
    CLAST_ASSERT(r && s);
    const table closed = {.descriptor = -1};
    *r = (recorder){.scene = s, .series = closed, .feeds = closed, .outlets = closed};
    r->memories = calloc((size_t)s->measure_count + 1, sizeof *r->memories);
    CLAST_ASSERT(r->memories);
    moment_take(&r->now, s->world, false);
    size_t n = r->now.bodies.count;
    uint32_t ids = n > 0 ? r->now.bodies.id[r->now.order[n - 1]] + 1 : 0;
    for (int i = 0; i < s->measure_count; i++) {
        measure_start(&r->memories[i], &r->now, ids);
        r->needs_contacts |= measure_class_of(s->measures[i].kind)->needs_contacts;
    }
}

static bool has_flow(const scene *s) {
    return passage_has_feeds(s) || passage_has_outlets(s);
}

static char *series_header(const scene *s) {
    char *text;
    size_t length;
    FILE *to = open_memstream(&text, &length);
    CLAST_ASSERT(to);
    fputs("time_s,step,kinetic_J,rotational_J,gravity_J,elastic_J,damping_J,friction_J,global_J,"
          "wall_work_J,removed_J,input_J,residual_J,bodies,overlap_max,contacts",
          to);
    if (has_flow(s)) fputs(",fed_kg,out_kg,inside_kg", to);
    for (int i = 0; i < s->measure_count; i++)
        measure_class_of(s->measures[i].kind)->header(&s->measures[i], to);
    CLAST_ASSERT(fclose(to) == 0);
    return text;
}

typedef struct keeping {
    keep_row_fn *keep, *keep_passage; /* NULL: a new file */
    const void *context;
} keeping;

static int open_table(table *t, const char *folder, const char *file, const char *header,
                      const keeping *k) {
    char *path = path_in(folder, file);
    if (k)
        table_continue(t, path, header, k->keep, k->context);
    else
        table_create(t, path, header);
    free(path);
    return t->failure;
}

static int open_passages(recorder *r, const char *folder, const keeping *k) {
    keeping passages = {k ? k->keep_passage : NULL, NULL, k ? k->context : NULL};
    const keeping *p = k ? &passages : NULL;
    int failure = 0;
    if (passage_has_feeds(r->scene))
        failure = open_table(&r->feeds, folder, FILE_FEEDS, FEEDS_HEADER, p);
    if (passage_has_outlets(r->scene) && !failure)
        failure = open_table(&r->outlets, folder, FILE_OUTLETS, OUTLETS_HEADER, p);
    return failure;
}

static int open_tables(recorder *r, const char *folder, const keeping *k) {
    const scene *s = r->scene;
    char *header = series_header(s);
    int failure = open_table(&r->series, folder, FILE_SERIES, header, k);
    free(header);
    if (!failure) failure = open_passages(r, folder, k);
    for (int i = 0; i < s->measure_count && !failure; i++) {
        const measure_class *c = measure_class_of(s->measures[i].kind);
        if (!c->writes_samples) continue;
        char *file = text_format("%s.samples.csv", s->measures[i].name);
        r->memories[i].sampling = true;
        failure = open_table(&r->memories[i].samples, folder, file, c->samples_header, k);
        free(file);
    }
    return failure;
}

int recorder_create(recorder *r, const char *folder) {
    return open_tables(r, folder, NULL);
}

int recorder_continue(recorder *r, const char *folder, keep_row_fn *keep, keep_row_fn *keep_passage,
                      const void *context) {
    return open_tables(r, folder, &(keeping){keep, keep_passage, context});
}

/* ---- rows ------------------------------------------------------------------------------------ */

static void write_energy(table *t, clast_world *w) {
    clast_energy e = clast_world_energy(w);
    const double terms[] = {e.kinetic, e.rotational, e.gravity, e.elastic, e.damping, e.friction,
                            e.global,  e.wall_work,  e.removed, e.input,   e.residual};
    for (size_t i = 0; i < sizeof terms / sizeof *terms; i++) table_number(t, terms[i]);
}

/* kg that came, that left by whichever way, and that is there. */
static void write_flow(table *t, const moment *now) {
    double fed = 0, out = 0, inside = 0;
    for (int i = 0; i < clast_world_feed_count(now->world); i++)
        fed += clast_world_feed_flow(now->world, i).mass;
    for (int i = CLAST_OUTLET_DOMAIN; i < clast_world_outlet_count(now->world); i++)
        out += clast_world_outlet_flow(now->world, i).mass;
    for (size_t i = 0; i < now->bodies.count; i++) inside += now->bodies.mass[now->order[i]];
    table_number(t, fed), table_number(t, out), table_number(t, inside);
}

int recorder_passages(recorder *r) {
    return passage_write(r->scene, &r->feeds, &r->outlets);
}

int recorder_row(recorder *r) {
    const scene *s = r->scene;
    double values[MEASURE_COLUMNS_MAX];
    moment_take(&r->now, s->world, r->needs_contacts);
    clast_counters c = clast_world_counters(s->world);
    table_begin(&r->series, r->now.time, r->now.step);
    write_energy(&r->series, s->world);
    table_number(&r->series, (double)c.bodies);
    table_number(&r->series, c.overlap_max);
    table_number(&r->series, (double)c.contacts);
    if (has_flow(s)) write_flow(&r->series, &r->now);
    int failure = 0;
    for (int i = 0; i < s->measure_count; i++) {
        const measure_class *k = measure_class_of(s->measures[i].kind);
        int n = k->values(&s->measures[i], &r->memories[i], &r->now, values);
        CLAST_ASSERT(n <= MEASURE_COLUMNS_MAX);
        for (int j = 0; j < n; j++) table_number(&r->series, values[j]);
        if (r->memories[i].sampling && !failure) failure = r->memories[i].samples.failure;
    }
    table_end(&r->series);
    return failure ? failure : r->series.failure;
}

int recorder_sync(recorder *r) {
    table *all[] = {&r->series, &r->feeds, &r->outlets};
    int failure = 0;
    for (int i = 0; i < 3; i++) {
        if (all[i]->descriptor >= 0) table_sync(all[i]);
        if (!failure) failure = all[i]->failure;
    }
    for (int i = 0; i < r->scene->measure_count; i++) {
        if (!r->memories[i].sampling) continue;
        table_sync(&r->memories[i].samples);
        if (!failure) failure = r->memories[i].samples.failure;
    }
    return failure;
}

void recorder_stop(recorder *r) {
    for (int i = 0; r->scene && i < r->scene->measure_count; i++) measure_stop(&r->memories[i]);
    free(r->memories);
    table_close(&r->series), table_close(&r->feeds), table_close(&r->outlets);
    moment_free(&r->now);
    const table closed = {.descriptor = -1};
    *r = (recorder){.series = closed, .feeds = closed, .outlets = closed};
}

/* ---- memory: "below <measure> <one digit per body>" ------------------------------------------ */

void recorder_write_memory(const recorder *r, FILE *to) {
    for (int i = 0; i < r->scene->measure_count; i++) {
        const measure_memory *m = &r->memories[i];
        if (r->scene->measures[i].kind != MEASURE_DISCHARGED) continue;
        fprintf(to, "below %s ", r->scene->measures[i].name);
        for (uint32_t id = 0; id < m->ids; id++) fputc('0' + m->below[id], to);
        fputc('\n', to);
    }
}

static void read_below(measure_memory *m, const char *digits) {
    for (uint32_t id = 0; id < m->ids && digits[id] >= '0' && digits[id] <= '2'; id++)
        m->below[id] = (unsigned char)(digits[id] - '0');
}

void recorder_read_memory(recorder *r, const char *note) {
    for (int i = 0; i < r->scene->measure_count; i++) {
        if (r->scene->measures[i].kind != MEASURE_DISCHARGED) continue;
        char *head = text_format("\nbelow %s ", r->scene->measures[i].name);
        const char *line = strstr(note, head);
        if (line) read_below(&r->memories[i], line + strlen(head));
        free(head);
    }
}
